"""``da.sweep``: one mechanism with some values replaced, an analysis for each, one labelled answer."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.batch_result import CODES
from dalembert.analysis.batch.careful_path import solved_quantities
from dalembert.analysis.batch.compiled_kernel import compile as compile_kernel
from dalembert.analysis.batch.over_positions import check, reduce_positions
from dalembert.analysis.batch.tracing.course import in_mode_of
from dalembert.analysis.batch.tracing.symbolic_model import VariedNumber, number_kinds
from dalembert.analysis.result.named_quantities import Quantity, component, quantity, solved_names
from dalembert.analysis.result.number_kinds import in_plane
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import solve
from dalembert.answer.answer import Drawn, Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.answer.named_answer import NamedAnswer, counted
from dalembert.arrays import Array, Tree
from dalembert.errors import SOLVED, STATUSES, ModelError
from dalembert.model import AtPositions, Mechanism, ModelOrPath, as_mechanism
from dalembert.model.paths import value_at
from dalembert.model.quantities.parameters import Parameter
from dalembert.progress import progress as progress_line
from dalembert.units import KINDS
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.printing import Part
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

MANY, MOST = 500, 10_000_000
"""Designs from which on a compiled analysis pays for its tracing; and more of them than anybody means."""
KEPT = ("effort", "load", "reaction", "reaction_moment")
"""Quantities of each answer that are kept by default."""

Values = Mapping[str, Sequence[object]]
Done = Callable[[int, int], object]


def sweep(
    m: ModelOrPath,
    vary: str | Values,
    values: Sequence[object] | None = None,
    *,
    outputs: Sequence[str] | str | None = None,
    together: bool = False,
    static: bool = False,
    positions: AtPositions = None,
    progress: Done | None = None,
) -> Sweep:
    """The analyses of `solve` with the value at a path (of ``with_values``) replaced by each of some values.

    ``vary``: a path, with ``values``; or a mapping of paths to values: a grid, or with ``together`` value by value.
    Numbers are SI and radians, texts are read as in the file (``"3 lb"``). ``outputs``: names of quantities, default
    every effort, unknown load and reaction. Many numbers run compiled (`da.compile`), everything else by kept programs,
    with the same answers; all designs have the assembly mode of the first. ``progress``: called with (designs done,
    designs). Raises ModelError for a value that is refused.

    >>> import dalembert as da
    >>> s = da.sweep(da.four_bar(), "links.coupler.mass", [1.0, 2.0, 4.0], outputs="effort.O2")
    >>> s["effort.O2"].shape, s.over("effort.O2", "peak").shape
    ((3, 72), (3,))
    """
    m = as_mechanism(m)
    varied = _values_by_path(vary, values)
    shape = _shape(varied, together)
    designs = list(zip(*varied.values(), strict=True) if together else product(*varied.values()))
    labels = {path: _labels(m, path, of) for path, of in varied.items()}
    changes = (dict(zip(varied, design, strict=True)) for design in designs)
    nominal = _analysis(m, dict(zip(varied, designs[0], strict=True)), static, positions)
    wanted = [outputs] if isinstance(outputs, str) else outputs
    names = _kept(nominal) if wanted is None else wanted
    like = {name: quantity(nominal, name) for name in names}
    with progress_line("Sweeping", len(designs)) as step:

        def tell(done: int, designs: int) -> None:
            step(done)
            if progress is not None:
                progress(done, designs)

        compiled = positions is None and len(designs) >= MANY and _all_numbers(varied)
        if any(path.startswith("drives.") or path in m.parameters for path in varied):
            compiled = compiled and (
                nominal.inertia or static
            )  # else designs behind the first may have inertia
        answers = _compiled(nominal, tuple(varied), designs, like, tell) if compiled else None
        if answers is None:
            results = (_analysis(m, changed, static, positions, nominal) for changed in changes)
            answers = _collected(results, like, len(designs), tell)
    kinds = {name: q.kind for name, q in like.items()}
    return Sweep(m, dict(labels), together, kinds, nominal, answers.shaped(shape))


def _values_by_path(vary: str | Values, values: Sequence[object] | None) -> dict[str, list[object]]:
    """Values by path, as plain Python has them."""
    if isinstance(vary, str) == (values is None) or isinstance(values, str):
        raise ModelError("a sweep needs values for its path", 'da.sweep(m, "links.rod.mass", [1, 2, 3])')
    pairs = {vary: values} if isinstance(vary, str) else vary
    return {
        path: [v.item() if isinstance(v, np.generic) else v for v in ([] if of is None else of)]
        for path, of in pairs.items()
    }


def _shape(varied: Values, together: bool) -> tuple[int, ...]:
    counts = {path: len(of) for path, of in varied.items()}
    if not counts or not all(counts.values()):
        raise ModelError("a sweep needs at least one value for each path", "give a list of values")
    text = ", ".join(f"{count} of {path}" for path, count in counts.items())
    if together and len(set(counts.values())) > 1:
        raise ModelError(f"values cannot be paired: {text}", "give lists of equal length")
    shape = tuple(counts.values())[:1] if together else tuple(counts.values())
    if math.prod(shape) > MOST:
        raise ModelError(f"{math.prod(shape)} designs are too many: {text}", f"ask for at most {MOST}")
    return shape


class Labels(NamedTuple):
    """Values of a path, SI, with their kind from `units.KINDS`, or texts where they are not single numbers; and as they
    were given."""

    values: tuple[object, ...]
    kind: str
    inputs: tuple[object, ...]

    @property
    def unit(self) -> str:
        """SI unit of the values."""
        return KINDS[self.kind].si

    @property
    def texts(self) -> list[str]:
        """The values with their unit: a text as it was given."""
        return [f"{v:.6g} {self.unit}".strip() if _is_number(v) else str(v) for v in self.inputs]


def _labels(m: Mechanism, path: str, values: Sequence[Any]) -> Labels:
    plain = all(map(_is_number, values))
    changed = [m.with_values({path: v}) for v in ((min(values), max(values)) if plain else values)]
    name = path.removeprefix("parameters.")
    number = VariedNumber(name if name in m.parameters else path, 0.0, name in m.parameters)
    if plain and isinstance(value_at(changed[-1], number.keys), tuple):  # the first of a key's numbers alone
        number = VariedNumber(f"{path}.0", 0.0, False)
    shown = values if plain else [value_at(one, number.keys) for one in changed]
    shown = [value.value if isinstance(value, Parameter) else value for value in shown]
    if all(map(_is_number, shown)):
        return Labels(tuple(map(float, shown)), number_kinds(changed[-1], [number])[0], tuple(values))
    return Labels(tuple(map(str, values)), "number", tuple(values))


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _all_numbers(varied: Values) -> bool:
    """True if a compiled analysis can take them."""
    return all(map(_is_number, [v for of in varied.values() for v in of]))


def _kept(r: Result) -> list[str]:
    """Every effort, unknown load and reaction; of a pin in the plane that turns freely no moment."""
    names = solved_names(r, KEPT, compiled=True)
    free = [j for j in r.joints if in_plane(r) and r.friction is None and r.mechanism.joints[j].hinge]
    return [n for n in names if n not in {f"reaction_moment.{j}" for j in free}]


def _analysis(
    m: Mechanism, changes: Tree, static: bool, positions: AtPositions, like: Result | None = None
) -> Result:
    """One design, in the assembly mode of another that begins where it does."""
    one = m.with_values(changes)
    return solve(one if like is None else in_mode_of(one, like, positions), static, positions)


class _Answers(NamedTuple):
    """Answers of all designs: status and sentence, positions of the drives, quantities; those just after reversals."""

    status: Array
    reasons: Array
    drives: Array
    arrays: dict[str, Array]
    after: dict[str, Array]

    def shaped(self, shape: tuple[int, ...]) -> _Answers:
        """The designs along several axes."""

        def to(a: Array) -> Array:
            return a.reshape(shape + a.shape[1:])

        arrays, after = ({name: to(a) for name, a in of.items()} for of in (self.arrays, self.after))
        return _Answers(to(self.status), to(self.reasons), to(self.drives), arrays, after)


def _collected(results: Iterator[Result], like: Mapping[str, Quantity], count: int, tell: Done) -> _Answers:
    """The answers of analyses one by one."""
    parts: list[tuple[Any, ...]] = []
    for k, r in enumerate(results):
        if parts and len(r.status) != len(parts[0][0]):
            what = f"designs have {len(parts[0][0])} and {len(r.status)} positions"
            raise ModelError(what, "give the drives as many in each")
        values = [solved_quantities(side, like) for side in (r.sides[0], r.sides[-1])]
        parts.append((r.status, r.reasons, r.schedule.position, *values, r.after is not None))
        tell(k + 1, count)
    status, reasons, drives, first, last, two = zip(*parts, strict=True)
    arrays = [dict(zip(like, map(np.stack, zip(*of, strict=True)), strict=True)) for of in (first, last)]
    statuses, why = (np.array(of, object) for of in (status, reasons))
    return _Answers(statuses, why, np.stack(drives), arrays[0], arrays[1] if any(two) else {})


def _compiled(
    nominal: Result, paths: Sequence[str], designs: Sequence[object], like: Mapping[str, Quantity], tell: Done
) -> _Answers | None:
    """The same by a compiled analysis; nothing where there is none, or where it refuses a design."""
    try:
        kernel = compile_kernel(nominal.mechanism, paths, list(like), static=not nominal.inertia)
    except ModelError:
        return None
    if kernel.trace.redundant:
        return None  # a kernel's status is that of its outputs, a sweep's that of the analysis
    batch = kernel(np.array(designs, float), progress=tell)
    if (batch.code == CODES.index("failed")).any():
        return None  # the analysis of that design says why
    sides = [
        {n: of.value(n).reshape(batch.code.shape + q.values.shape[1:]) for n, q in like.items()}
        for of in (batch, batch.after)
        if of is not None
    ]
    position = nominal.schedule.position
    drives = np.broadcast_to(position, (len(designs), *position.shape))
    reasons = np.full(batch.code.shape, None, object)
    return _Answers(batch.status, reasons, drives, sides[0], sides[1] if len(sides) > 1 else {})


@dataclass(frozen=True, repr=False, eq=False)
class Sweep(NamedAnswer, Labelled, Drawn):
    """Answers along one axis a path (one for all paths that vary together), then position; SI and radians.

    ``s["effort.O2"]`` has the axes (values..., position), of a vector its components last; NaN where unsolved;
    ``status`` gives the reason. Where contacts reverse the numbers are those just before, ``answers.after`` has those
    just after.

    >>> import dalembert as da
    >>> s = da.sweep(da.four_bar(), "links.coupler.mass", [1.0, 2.0, 4.0], outputs="effort.O2")
    >>> s["effort.O2"].shape, set(s.status.ravel().tolist())
    ((3, 72), {'ok'})
    """

    mechanism: Mechanism
    labels: dict[str, Labels]
    together: bool
    kinds: dict[str, str]
    nominal: Result
    answers: _Answers

    @property
    def paths(self) -> tuple[str, ...]:
        """Varied paths."""
        return tuple(self.labels)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of designs along each axis."""
        return tuple(self.status.shape[:-1])

    @property
    def status(self) -> Array:
        """Code of each design and position."""
        return self.answers.status

    @property
    def ok(self) -> Array:
        """True where a design is solved."""
        return np.isin(self.status.astype(str), SOLVED)

    @property
    def designs(self) -> list[tuple[str, ...]]:
        """The values of each design as text with units, in the order of the axes."""
        texts = [of.texts for of in self.labels.values()]
        return list(zip(*texts, strict=True) if self.together else product(*texts))

    ROW = "design"
    ROWS = "rows"

    @property
    def codes(self) -> Array:
        """Statuses along the axes of the designs, then the positions."""
        return self.status

    def __len__(self) -> int:
        return math.prod(self.shape)

    @property
    def subject(self) -> str:
        """The paths that are varied."""
        return ", ".join(self.paths)

    @property
    def extent(self) -> str:
        """Designs along each axis, and their positions."""
        *front, last = self.shape
        many = "".join(f"{n} x " for n in front) + counted(last, "design")
        return f"{many} of {counted(self.status.shape[-1], 'position')}"

    def __getitem__(self, name: str) -> Array:
        """A quantity by its name, SI."""
        return self._kept(self.answers.arrays, name)

    def both_sides(self, name: str) -> list[Array]:
        """A quantity, and where contacts reverse also its values just after."""
        answers = self.answers
        return [self._kept(kept, name) for kept in (answers.arrays, answers.after) if kept]

    def _kept(self, kept: Mapping[str, Array], name: str) -> Array:
        vector, _, part = name.rpartition(".")
        if name in kept:
            return kept[name]
        if vector not in kept:
            what = f"{name!r} is not an output of this sweep"
            raise ModelError(what, f"name it in outputs=, or {closest(name, list(kept))}")
        return component(kept[vector], part, name, self.status.ndim)

    def keys(self) -> list[str]:
        """Names of the quantities that are kept."""
        return list(self.answers.arrays)

    def over(self, name: str, reduce: str = "peak") -> Array:
        """A number, or a vector's size, reduced over the positions: `peak` (largest magnitude), `mean`, `rms`,
        `envelope`, ...; both sides of reversals counted, NaN where some position has no value."""
        check(reduce)
        axis = len(self.shape)
        sizes = [np.linalg.norm(a, axis=-1) if a.ndim > axis + 1 else a for a in self.both_sides(name)]
        both = np.concatenate(sizes, axis)
        return reduce_positions(reduce, np.moveaxis(both, axis, 0))

    def problems(self) -> list[tuple[str, str, str]]:
        """Runs of positions that are not solved: design and positions (from 1), status, sentence."""
        out, count = [], self.status.shape[-1]
        reasons = self.answers.reasons.reshape(-1, count)
        for values, status, why in zip(self.designs, self.status.reshape(-1, count), reasons, strict=True):
            text = ", ".join(f"{path} = {value}" for path, value in zip(self.paths, values, strict=True))
            for (code, reason), run in groupby(enumerate(zip(status, why, strict=True), 1), lambda p: p[1]):
                where = [k for k, _ in run]
                if code not in SOLVED:
                    which = f"{where[0]}" + (f"-{where[-1]}" if where[1:] else "")
                    known = STATUSES[code].sentence if code in STATUSES else code
                    out.append((f"{text}: position {which}", code, reason or known))
        return out

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """A row a position of each design: number of both, what is varied, drives, status, quantities, reason."""
        from dalembert.analysis.batch.sweep_columns import sweep_columns

        return sweep_columns(self)

    def basis(self) -> dict[str, str]:
        """Title, source, and what the numbers of the first design rest on."""
        return super().basis() | self.nominal.assumptions

    def record(self, to: Scale) -> Tree:
        """Varied quantity, as it was given."""
        return {
            "vary": {path: list(of.inputs) for path, of in self.labels.items()},
            "together": self.together,
        }

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """A row a design: what was varied, the positions solved, the largest size of each quantity; problems."""
        from dalembert.analysis.batch.sweep_text import sweep_parts

        return sweep_parts(self, units)

    def labelled(self, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
        """Quantities over the values of the paths, position and component, and coordinates."""
        from dalembert.analysis.batch.sweep_columns import sweep_arrays

        return sweep_arrays(self, to)

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """Curves over the cycle of every quantity that has one number or a size, in the units of the file."""
        return [self.plot(name) for name, a in self.answers.arrays.items() if a.ndim - len(self.shape) < 3]

    def plot(self, name: str, reduce: str | None = None, ax: Any = None) -> Any:
        """Curves over the cycle, one a design; with ``reduce`` (`peak`, `mean`, `rms`) against the first path's values.

        A Scene, or drawn on matplotlib's ``ax``, in the units of the file."""
        from dalembert.notebook.plots import plot_sweep

        return plot_sweep(self, name, reduce, ax)
