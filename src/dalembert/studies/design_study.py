"""``da.study``: many designs of one mechanism, as a pure function from the number of a block to its arrays.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.batch_columns import output_kinds
from dalembert.analysis.batch.tracing.course import in_mode_of
from dalembert.analysis.batch.tracing.symbolic_model import number_kinds, of_motion
from dalembert.analysis.solution import solve
from dalembert.arrays import Array, Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.many.simulation_plan import SimulationPlan, read_motion
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.optimization.cycle_expressions import has_reductions, is_single
from dalembert.studies.block_engines import (
    Block,
    Engine,
    KernelEngine,
    make_engine,
    program_print,
    with_cycle_numbers,
)
from dalembert.studies.limits import Limit, read_limit
from dalembert.studies.motion_engines import end_kinds, make_motion_engine
from dalembert.studies.sampling import DesignPlan, triangle_of
from dalembert.studies.spreads import Spread
from dalembert.studies.varied_numbers import check_twofold, columns_of, spreads_of, varied_numbers

if TYPE_CHECKING:
    import os

    from dalembert.analysis.result.result import Result
    from dalembert.studies.study_result import StudyResult

BLOCK_BYTES = 64 << 20
"""Bytes that a block takes at most."""
MOST_BLOCKS = 5_000
"""Blocks of one store that are checked in a few seconds."""


def study(
    mechanism: ModelOrPath,
    vary: Mapping[str, object] | Sequence[str],
    outputs: Sequence[str] | str | None = None,
    reduce: str | None = "peak",
    designs: int = 10_000,
    draw: str | Mapping[str, Sequence[object]] = "random",
    seed: int = 0,
    *,
    limits: Mapping[str, str] | None = None,
    correlation: Mapping[tuple[str, str], float] | None = None,
    static: bool = False,
    positions: int | None = None,
    keep: bool = False,
    lanes: int | None = None,
    simulate: Mapping[str, object] | None = None,
) -> Study:
    """Many designs of a mechanism, each drawn by its number from the spreads of the numbers of the model file.

    ``vary``: path or parameter -> spread: ``"± 0.05 mm"`` (normal, truncated at three standard deviations), ``"normal 2
    %"``, ``"uniform ± 5 %"``, ``"70..90 N"``, ``"70..90 N in 5"``, a list, or ``"range"`` for a parameter that has one.
    A vector's path means each component. ``outputs``, ``reduce``, ``static``: as in `da.compile`. ``draw``: ``random``,
    ``sobol``, ``latin``, ``factorial`` (all combinations of levels), or the designs themselves, path -> values, with
    ``vary`` a list of paths or empty. ``limits``: output -> ``"< 45 N*m"``, an output also being ``range(slide.G)``.
    ``correlation``: of two paths, between -1 and 1, of their normal scores. ``keep``: store the drawn numbers too.
    ``simulate``: motions under forces, ``{"until": ["2 s", "O2.speed = 20 rad/s"], "start": ..., "count": 201,
    "tolerance": 1e-9}`` as in `da.compile_motion`, whose numbers vary too; outputs are also ``time``,
    ``O2.position`` and ``O2.speed``, those at the end, and ``reduce`` is over the instants, or ``final``. Raises
    ModelError.

    >>> import dalembert as da
    >>> s = da.study(da.four_bar(), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=1000, seed=7)
    >>> r = s.run()
    >>> r["effort.O2"].shape, int(r.ok.sum())
    ((1000,), 1000)
    """
    mechanism = as_mechanism(mechanism)
    motion = None
    if simulate is not None:
        _refuse_beside_motion(static=static, positions=positions, lanes=lanes)
        mechanism, motion = read_motion(mechanism, simulate)
    if motion is None or reduce != "final":
        over_positions.check(reduce)
    number = _checked_counts(designs, lanes=lanes, positions=positions, seed=seed)
    spread_texts = dict.fromkeys(vary, "") if not isinstance(vary, Mapping) else dict(vary)
    table = dict(draw) if isinstance(draw, Mapping) else None
    if table is None and not spread_texts:
        raise ModelError("no number varies", "give path: spread, as stroke: ± 0.1 mm", ("vary",))
    numbers, spreads, rows = (
        spreads_of(mechanism, spread_texts) if table is None else columns_of(mechanism, spread_texts, table)
    )
    check_twofold(mechanism, numbers)
    if motion is None and (of := next((n.path for n in numbers if of_motion(n.path)), "")):
        raise ModelError(f"{of!r} is of a motion under forces", "write simulate: {until: 2 s}", ("vary", of))
    paths = tuple(n.path for n in numbers)
    how = "table" if table is not None else str(draw)
    mixing = triangle_of(paths, correlation or {}, how)
    plan = DesignPlan(paths, spreads, how, number, int(seed), rows, mixing)
    names = (outputs,) if isinstance(outputs, str) else tuple(outputs) if outputs else None
    extra = tuple(filter(is_single, map(str, limits or ())))
    if extra and motion is None:  # a limit may name a number of the cycle that is not an output
        names = names or Study(mechanism, plan, None, reduce, static, positions).outputs
        names += tuple(name for name in extra if name not in names)
    if names and len(set(names)) < len(names):
        raise ModelError("an output is named twice", "leave one of them out", ("outputs",))
    planned = Study(mechanism, plan, names, reduce, static, positions, keep, lanes, motion=motion)
    _ = planned.engine  # what cannot be computed is refused here
    return planned.with_limits(limits or {})


def _checked_counts(designs: float, **counts: int | None) -> int:
    """The number of designs, an integer; every count is within its bounds."""
    number = int(designs) if isinstance(designs, float) and designs.is_integer() else designs
    for key, value in (counts | {"designs": number}).items():
        require(key, value, path=(key,))
    return int(number)


def _refuse_beside_motion(**options: object) -> None:
    for name, value in options.items():
        if value:
            raise ModelError(f"{name} is given, and the study simulates", f"leave {name} out", (name,))


@dataclass(frozen=True)
class Study:
    """Varied numbers, sampling and outputs of a study; `run` computes it. Two equal ones give the same bits
    anywhere.

    >>> import dalembert as da
    >>> s = da.study(da.four_bar(), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=100, seed=7)
    >>> s.plan.count
    100
    """

    mechanism: Mechanism
    plan: DesignPlan
    requested: tuple[str, ...] | None
    reduce: str | None = "peak"
    static: bool = False
    positions: int | None = None
    keep: bool = False
    lanes: int | None = None
    limits: tuple[Limit, ...] = ()
    cache: dict[str, Any] = field(default_factory=dict, repr=False, compare=False)
    motion: SimulationPlan | None = None

    def __getstate__(self) -> Tree:
        return {**self.__dict__, "cache": {}}

    def __repr__(self) -> str:
        what = f"{len(self.paths)} numbers, {self.count:,} designs by {self.plan.draw}"
        return f"<Study of {self.mechanism.title!r}: {what}, {', '.join(self.outputs)}>"

    @property
    def engine(self) -> Engine:
        """Engine that computes a block."""
        if "engine" not in self.cache:
            self.cache["engine"] = self.engine_for(self.requested, self.reduce)
        engine: Engine = self.cache["engine"]
        return engine

    def engine_for(self, outputs: Sequence[str] | None, reduce: str | None) -> Engine:
        """Engine that computes blocks of any outputs of the same designs."""
        if reduce == "squares":
            raise ModelError(
                "a study has no target for squares", 'reduce an expression by "rms"', ("reduce",)
            )
        if self.motion is not None:
            return make_motion_engine(self.mechanism, self.paths, outputs, reduce, self.motion)

        def make(names: Sequence[str] | None, by: str | None) -> Engine:
            return make_engine(self.mechanism, self.paths, names, by, self.static, self.positions, self.lanes)

        if outputs and any(map(has_reductions, outputs)):
            return with_cycle_numbers(outputs, reduce, self.answer(self.mechanism), make)
        return make(outputs, reduce)

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of the numbers that vary."""
        return self.plan.paths

    @property
    def outputs(self) -> tuple[str, ...]:
        """Outputs of each design."""
        return self.requested if self.requested is not None else self.engine.outputs

    @property
    def kinds(self) -> dict[str, str]:
        """Kind of each output, from `units.KINDS`."""
        if "kinds" not in self.cache:
            known = self.end_kinds
            rest = [name for name in self.outputs if name not in known]
            kinds = known | (output_kinds(self.answer(self.mechanism), rest, self.reduce) if rest else {})
            self.cache["kinds"] = {name: kinds[name] for name in self.outputs}
        return dict(self.cache["kinds"])

    @property
    def end_kinds(self) -> dict[str, str]:
        """Names of what a motion ends with, which no reduction changes, and what each is."""
        return {} if self.motion is None else end_kinds(self.mechanism)

    @property
    def number_kinds(self) -> dict[str, str]:
        """Kind of each number, from `units.KINDS`, by path."""
        numbers = [n for path in self.paths for n in varied_numbers(self.mechanism, path)]
        return dict(zip(self.paths, number_kinds(self.mechanism, numbers), strict=True))

    def answer(self, m: Mechanism) -> Result:
        """The analysis of one design, as of all of them: `mechanism_of` makes it; of a motion along it."""
        return self.motion.of(m).result if self.motion else solve(m, self.static, self.positions)

    def with_limits(self, limits: Mapping[str, str]) -> Study:
        """The same study with other limits: output -> what it has to keep, as ``"< 45 N*m"``."""
        read = tuple(read_limit(str(name), text, self.kinds, self.mechanism) for name, text in limits.items())
        return replace(self, limits=read, cache=self.cache)

    @property
    def count(self) -> int:
        """Number of designs."""
        return self.plan.count

    @property
    def why_slow(self) -> str:
        """Why the kernel does not reach, where designs are analysed one by one; else empty."""
        return self.engine.why

    def block_size(self) -> int:
        """Designs of a block of a new store: a power of two, of a tenth of a second, at most 64 MB."""
        kept = 1 if self.reduce else self.engine.positions
        each = 8 * (len(self.paths) + 3 * kept * len(self.outputs))
        most = min(self.engine.most_at_once, BLOCK_BYTES // each)
        size = 1 << max(0, min(most, max(self.count // 16, 16 if self.why_slow else 4096)).bit_length() - 1)
        while self.count / size > MOST_BLOCKS:
            size *= 2
        return size

    def block(self, start: int, stop: int) -> tuple[Block, float]:
        """Arrays of designs ``start`` to ``stop``, and the milliseconds they took."""
        begun = time.perf_counter()
        values = self.plan.values(start, stop)
        arrays = self.engine.block(values)
        if self.keep:
            arrays |= {path: np.ascontiguousarray(values[:, j]) for j, path in enumerate(self.paths)}
        return arrays, (time.perf_counter() - begun) * 1e3

    def design(self, n: int) -> dict[str, float]:
        """The numbers of a design by path, SI; designs are numbered from 0."""
        require("design", n)
        if n >= self.count:
            raise ModelError(f"design {n} does not exist", f"use 0 to {self.count - 1}")
        return dict(zip(self.paths, self.plan.values(n, n + 1)[0].tolist(), strict=True))

    def mechanism_of(self, n: int) -> Mechanism:
        """The mechanism of a design, to be analysed, drawn and saved as any other."""
        one = self.mechanism.with_values(self.design(n))
        shared = self.motion and SharedMotion(self.mechanism, self.paths)
        return shared.in_mode(one) if shared else in_mode_of(one, self.nominal, self.positions)

    @cached_property
    def nominal(self) -> Result:
        """The analysis of the file's numbers: designs have its assembly mode."""
        return self.answer(self.mechanism)

    def extended(self, designs: int) -> Study:
        """The same study of more designs; those that there are stay as they are."""
        if not self.plan.extendable:
            raise ModelError(
                f"a study drawn by {self.plan.draw} cannot be extended", "only random and sobol ones can"
            )
        require("designs", designs)
        if designs < self.count:
            raise ModelError(f"the study has {self.count} designs already", f"ask for more than {self.count}")
        return replace(self, plan=replace(self.plan, designs=designs), cache=self.cache)

    @cached_property
    def prints(self) -> dict[str, str]:
        """Fingerprint that may not change between the runs of one store: what is computed, and by which program."""
        tree = self.mechanism.to_tree()
        for key in ("title", "source", "answers"):
            tree.pop(key, None)
        for name, stated in tree.get("parameters", {}).items():
            tree["parameters"][name] = stated["value"] if isinstance(stated, dict) else stated
        question = self.tree()
        if self.plan.extendable:
            question.pop("designs")
        question.pop("limits")
        if self.plan.table is not None:
            question["table"] = _print(np.ascontiguousarray(self.plan.table).tobytes())
        first = self.plan.values(0, 64 if self.plan.extendable else min(64, self.count))
        return {
            "model": _print(json.dumps(tree, sort_keys=True).encode()),
            "study": _print(json.dumps(question, sort_keys=True).encode()),
            "program": program_print(self.engine, first),
        }

    def tree(self) -> Tree:
        """The study in plain values, from which `study_of_tree` restores it; a table of designs is separate."""
        p = self.plan
        return {
            "vary": list(p.paths),
            "spreads": [{"kind": s.kind, "a": s.a, "b": s.b, "levels": list(s.levels)} for s in p.spreads],
            "draw": p.draw,
            "designs": p.count,
            "seed": p.seed,
            "mixing": None if p.mixing is None else p.mixing.tolist(),
            "outputs": list(self.outputs),
            "reduce": self.reduce,
            "static": self.static,
            "positions": self.positions,
            "keep": self.keep,
            "lanes": self.engine.kernel.lanes if isinstance(self.engine, KernelEngine) else None,
            "limits": {limit.output: limit.text for limit in self.limits},
            **({} if self.motion is None else {"simulate": self.motion.tree()}),
        }

    def run(
        self,
        store: str | os.PathLike[str] | None = None,
        *,
        threads: int | None = None,
        scheduler: Any = None,
        progress: Callable[[int, int], object] | None = None,
        check: bool = True,
    ) -> StudyResult:
        """Computes the missing blocks, into a store on disk, which resumes a stopped run, or in memory.

        threads: default one per core. scheduler: the address of a dask scheduler or a dask client, whose workers then
        compute. progress: called with (designs done, designs). check: first compare the stored blocks with their
        checksums. The same bits whatever the workers, the order, and how often it was stopped. Ctrl-C finishes and
        keeps the blocks in progress.
        """
        from dalembert.studies.running import run_study

        return run_study(self, store, threads, scheduler, progress, check)

    def contributions(self, output: str, by: str = "linear", designs: int = 4096) -> Any:
        """Contribution of each number to the variance of an output, by ``linear`` or ``sobol``: `Contributions`."""
        from dalembert.studies.contributions import contributions

        return contributions(self, output, by, designs)

    def contributions_along(self, output: str, designs: int = 1024) -> Any:
        """Contribution of each number to the variance of an output at every position, by Sobol's indices of the same
        designs: `CourseContributions`, arrays over the positions whatever `reduce` is."""
        from dalembert.studies.contributions import course_contributions

        return course_contributions(self, output, designs)

    def worst_case(self, output: str) -> Any:
        """The largest value of an output over the corners of all spreads; a `WorstCase`."""
        from dalembert.studies.contributions import worst_case

        return worst_case(self, output)

    def response(self, output: str, *paths: str, count: int = 33) -> Any:
        """An output along one number, or over two, between the ends of their spreads, the others at the middle of
        theirs: a `ResponseCurve`."""
        from dalembert.studies.contributions import response

        return response(self, output, paths, count)

    def idle(self) -> tuple[str, ...]:
        """Numbers that change no output, moved one at a time to both ends of what they spread over."""
        from dalembert.studies.contributions import idle

        return idle(self)


def study_of_tree(m: Mechanism, tree: Tree, table: Array | None = None) -> Study:
    """The study that `Study.tree` describes."""
    spreads = tuple(Spread(s["kind"], s["a"], s["b"], tuple(s["levels"])) for s in tree["spreads"])
    mixing = None if tree["mixing"] is None else np.array(tree["mixing"])
    plan = DesignPlan(
        tuple(tree["vary"]), spreads, tree["draw"], tree["designs"], tree["seed"], table, mixing
    )
    options = (tree["reduce"], tree["static"], tree["positions"], tree["keep"], tree["lanes"])
    motion = read_motion(m, tree["simulate"])[1] if "simulate" in tree else None
    rebuilt = Study(m, plan, tuple(tree["outputs"]), *options, motion=motion)
    return rebuilt.with_limits(tree["limits"])


def _print(text: bytes) -> str:
    return hashlib.sha256(text).hexdigest()[:16]
