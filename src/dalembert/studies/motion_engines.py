"""Engines for a block of motions under forces: compiled ones, or where these do not apply simulations, one by one.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from dalembert.analysis.batch.batch_result import CODES
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.compiled_motion import compile_motion
from dalembert.machine.motion.many.motion_kernel import MotionKernel
from dalembert.machine.motion.many.one_design import alone
from dalembert.machine.motion.many.simulation_plan import SimulationPlan
from dalembert.model import Mechanism
from dalembert.model.drives.drives import SLIDE, TURN
from dalembert.studies.block_engines import AnalysisEngine, Block, Engine
from dalembert.wording import closest

AT_ONCE, MOST = 1 << 19, 4096
"""Instants of a block, and designs, that take some tenths of a second, beside which it takes little to store it."""
WHY = "; write it by `dalembert study design STORE N -o design.yaml`, and `dalembert simulate` says why."
SENTENCES = {
    "undecided": f"The steps of the motion became too small, or it comes near a dead centre{WHY}",
    "failed": f"The motion cannot begin, or stops where it cannot go on{WHY}",
}
"""Sentences for designs without numbers, by status."""


def end_kinds(m: Mechanism) -> dict[str, str]:
    """Names of what a motion ends with, and of which kind it is, of `units.KINDS`."""
    names = {"time": "time"}
    for name, drive in m.drives.items():
        kinds = TURN if drive.turns else SLIDE
        names |= {f"{name}.position": kinds[""], f"{name}.speed": kinds["speed"]}
    return names


def ends(m: Mechanism, time: Array, position: Array, speed: Array) -> Block:
    """The values of these, from the time (design,), positions and speeds (design, drive)."""
    return dict(
        zip(
            end_kinds(m), [time, *np.stack([position.T, speed.T], axis=1).reshape(-1, len(time))], strict=True
        )
    )


@dataclass(frozen=True)
class MotionEngine:
    """Compiled motions, on one thread."""

    kernel: MotionKernel
    outputs: tuple[str, ...]
    why: str = ""

    @property
    def positions(self) -> int:
        return self.kernel.block.instants

    @property
    def most_at_once(self) -> int:
        return max(1, min(MOST, AT_ONCE // self.positions))

    @property
    def text(self) -> str:
        return self.kernel.block.text

    def block(self, values: Array) -> Block:
        answer = self.kernel(values, threads=1)
        parts = ends(self.kernel.mechanism, answer.time, answer.position, answer.speed) | answer.arrays
        stopped = np.array([text.startswith(("stopped", "failed")) for text in answer.ended], bool)
        known = [np.isfinite(parts[n]).reshape(len(values), -1).all(axis=1) for n in self.outputs]
        marks = ("failed", "undecided", "at_rest")
        given = np.select([stopped, ~answer.ok, ~np.all(known, axis=0)], [CODES.index(x) for x in marks], 0)
        statuses = given.astype(np.uint8)
        return {name: np.ascontiguousarray(parts[name]) for name in self.outputs} | {"status": statuses}


@dataclass(frozen=True)
class SimulationEngine(AnalysisEngine):
    """`da.simulate` of one design after the other, with one equation: friction, brakes, stops, whatever it does."""

    motion: SimulationPlan

    @property
    def positions(self) -> int:
        return self.motion.count

    @property
    def shape(self) -> tuple[int, ...]:
        return ()

    @property
    def text(self) -> str:
        return f"simulations of {self.outputs}, {self.reduce}, {self.motion}"

    @cached_property
    def _shared(self) -> SharedMotion:
        return SharedMotion(self.mechanism, self.numbers)

    def one(self, m: Mechanism) -> tuple[Block, Array]:
        plan, along = self.motion, [name for name in self.outputs if name not in end_kinds(m)]
        found = alone(m, plan.until, along, self.reduce, plan.count, plan.tolerance, self._shared)
        last = (np.array([x]) for x in (found.time, found.position, found.speed))
        parts = {name: x[0] for name, x in ends(m, *last).items()} | found.outputs
        outputs = {name: np.asarray(parts[name]) for name in self.outputs}
        known = all(np.isfinite(x).all() for x in outputs.values())
        mark = "failed" if not found.known else "ok" if known else "at_rest"
        return outputs, np.array(CODES.index(mark), np.uint8)


def make_motion_engine(
    m: Mechanism,
    paths: Sequence[str],
    requested: Sequence[str] | None,
    reduce: str | None,
    motion: SimulationPlan,
) -> Engine:
    """Compiled motions where they reach, else simulations, with the sentence why; raises ModelError where neither."""
    names = tuple(end_kinds(m) if requested is None else requested)
    outputs = tuple(name for name in names if name not in end_kinds(m))
    if wrong := next((name for name in outputs if name.split(".")[0] in m.drives), ""):
        raise ModelError(f"unknown output {wrong!r}", closest(wrong, list(end_kinds(m))))
    try:
        kernel = compile_motion(m, motion.until, paths, outputs, reduce, None, motion.count, motion.tolerance)
    except ModelError as error:
        try:
            engine = SimulationEngine(m, tuple(paths), names, reduce, False, None, error.what, motion)
            _ = engine.shapes
        except ModelError:  # at its line of the model file, or else of what asks for it
            known = ModelError(error.what, error.remedy, error.path)
            raise known.at_source(m.source if error.path else None) from None
        return engine
    return MotionEngine(kernel, names)
