"""``da.compile_motion``: motions under forces of many designs side by side in machine code, each with a separate step
sizes.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.checked_input import numbers
from dalembert.analysis.batch.compiled_kernel import lanes_here
from dalembert.analysis.batch.tracing.symbolic_model import VariedNumber, with_numbers
from dalembert.analysis.batch.tracing.traced_parameters import symbol_functions
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.kernel.graph import Node
from dalembert.kernel.memory import available
from dalembert.machine.motion.actuation import Actuation, actuation, drive_lengths, joint_stops
from dalembert.machine.motion.coded.rate_program import Corners
from dalembert.machine.motion.equation import Equation, StoppedError
from dalembert.machine.motion.equation_trace import trace_equation
from dalembert.machine.motion.motion_block import MotionBlock, Motions
from dalembert.machine.motion.occurrences import read_end
from dalembert.machine.motion.simulation import check_choices, read_start
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.model.drives.starting import Start

AT_ONCE = 16_384
"""Instants of the designs computed at once."""
CORNERED = 0.01
"""Part of the tolerance for motors with corners: a step that goes over one errs by more than it says."""
REMEDY = "use da.simulate for such a machine"
UNDECIDED = "undecided: its steps became too small, or it comes near a dead centre; da.simulate says why"
ROWS = {"effort": 0, "motor.stall": 0, "motor.no_load": 1, "position": 3, "speed": 4}
"""Numbers of a drive that may vary outside the equation, as rows: effort at speed 0, speed without effort, acceleration
of a prescribed drive, position and speed at time 0."""


@dataclass(frozen=True)
class MotionBatch:
    """Motions of many designs: ``arrays`` by output, (design, instant[, component]), or without instants if reduced.

    ``time`` (design,): when each ended, s; ``ended``: by which condition; ``position``, ``speed`` (design, drive) at
    the end. NaN where the continuation of a motion is undecided: not ``ok``.
    """

    values: Array = field(repr=False)
    time: Array = field(repr=False)
    position: Array = field(repr=False)
    speed: Array = field(repr=False)
    ended: tuple[str, ...] = field(repr=False)
    arrays: dict[str, Array] = field(repr=False)

    @property
    def ok(self) -> Flags:
        """True for designs that have numbers."""
        return np.isfinite(self.time)

    def value(self, output: str) -> Array:
        """An output by the name it was compiled with."""
        if output not in self.arrays:
            raise ModelError(f"{output!r} was not compiled", f"compile with outputs=[..., {output!r}]")
        return self.arrays[output]


def compile_motion(
    mechanism: ModelOrPath,
    until: str | float | Sequence[str | float],
    vary: Sequence[str] = (),
    outputs: Sequence[str] = (),
    reduce: str | None = None,
    start: Mapping[str, object] | None = None,
    count: int = 201,
    tolerance: float = 1e-9,
) -> MotionKernel:
    """`da.simulate` of one structure as machine code, for any numbers at ``vary``: each design with separate step
    sizes.

    until: a time, and conditions such as ``"O2.speed = 0 rad/s"`` that end a design's motion before it. vary: paths as
    in `da.compile`, and ``drives.NAME.effort``, ``drives.NAME.motor.stall`` and ``.no_load``, ``start.NAME.position``
    and ``.speed``. outputs: names as in `da.compile`, at ``count`` instants evenly from a design's start to its end;
    reduce: over these instants, as in `da.compile`, or ``final``. tolerance: of each step, relative; the error of the
    motion grows beyond it with the steps: compare with a tenth of it. Raises ModelError for what is not smooth: dry
    friction, brakes, stops, motors with switches, efforts that depend on positions or time.

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2)
    >>> start = {"O2": {"position": "30 deg", "speed": "20 rad/s"}}
    >>> k = da.compile_motion(m, "0.5 s", ["links.piston.mass"], ["reaction.A.magnitude"], reduce="peak", start=start)
    >>> k([[1.0], [2.0]]).value("reaction.A.magnitude").shape
    (2,)
    """
    mechanism = as_mechanism(mechanism)
    if reduce != "final":
        over_positions.check(reduce)
    try:
        return _compile(mechanism, until, tuple(vary), tuple(outputs), reduce, start, count, tolerance)
    except StoppedError as error:
        raise ModelError(f"the motion cannot begin: {error}", path=("links",)).at_source(
            mechanism.source
        ) from None
    except ModelError as error:
        raise error.at_source(mechanism.source) from None


def _compile(
    m: Mechanism,
    until: str | float | Sequence[str | float],
    vary: tuple[str, ...],
    outputs: tuple[str, ...],
    reduce: str | None,
    start: Mapping[str, object] | None,
    count: int,
    tolerance: float,
) -> MotionKernel:
    m = m.model_copy(update={"start": {**m.start, **read_start(m, start)}})
    fixed = {n: Start(float(s.position), float(s.speed), s.turns) for n, s in m.start.items()}
    prescribed, moves = actuation(m, fixed)
    end, conditions = read_end(m, until, ())
    check_choices(count, tolerance)
    if not np.isfinite(end):
        raise ModelError("a motion whose condition is never met has no end", 'add a time: until=["5 s", ...]')
    _refuse(moves)
    driven = [path for path in vary if _of_drive(path)]
    placed = next((path for path in vary if path.startswith("drives.") and path.endswith(".position")), "")
    if placed:
        raise ModelError(f"{placed!r} moves along the motion", f"vary 'start{placed[6:]}'")
    lanes = lanes_here()
    rubs = [name for name, joint in m.joints.items() if getattr(joint, "friction", None) is not None]
    why = f"joint {rubs[0]!r} has dry friction" if rubs else "the motion has loads that no formula gives"
    try:
        equation = trace_equation(prescribed, [path for path in vary if path not in driven], outputs)
    except ModelError as error:
        raise ModelError(f"{why}: {error.what}", REMEDY, error.path) if rubs else error from None
    traced = equation.kernel.trace.numbers[: -2 * len(moves.names)]
    _refuse_counts(equation)
    symbols = _symbols(m, equation, traced)
    corners = _corners(symbols)
    code = None if equation.dry else equation.steps(moves.free, lanes, works=False, corners=corners)
    if code is None:
        raise ModelError(f"{why}, so that it is not smooth", REMEDY)
    lines = _lines(m, moves).astype(float)
    formulas = {at: x for at, x in np.ndenumerate(_lines(symbols, moves)) if isinstance(x, Node)}
    where = (*traced, *(_number(moves, lines, path) for path in driven))
    places = [k for path in vary for k, n in enumerate(where) if f"{n.path}.".startswith(f"{path}.")]
    instants = 1 if reduce == "final" or not outputs else count
    small = max(tolerance * CORNERED, 1e-14) if corners else tolerance
    block = MotionBlock(equation, code, tuple(conditions), end, small, instants, drive_lengths(prescribed))
    return MotionKernel(m, block, lines, formulas, where, tuple(places), reduce)


def _refuse_counts(equation: Equation) -> None:
    """Refuses an output that is followed from state to state, as an angle with its full turns: designs are not
    followed."""
    graph = equation.graph
    for name, nodes in equation.kernel.nodes.items():
        if any(graph.names.get(n.index, "").startswith("known ") for n in graph.order(nodes)):
            raise ModelError(f"the output {name!r} counts full turns along the motion", REMEDY)


def _symbols(m: Mechanism, equation: Equation, traced: Sequence[VariedNumber]) -> Mechanism:
    """The description with symbols for what follows from parameters that vary."""
    nodes = equation.kernel.number_nodes[: len(traced)]
    varied = {n: node for n, node in zip(traced, nodes, strict=True) if n.parameter}
    return with_numbers(m, varied, varied.values(), symbol_functions(equation.graph)) if varied else m


def _corners(m: Mechanism) -> dict[int, Corners]:
    """Corners of motors with a curve: the speeds of its points, and the change of slope at them; the curve is level
    beyond its ends."""
    out = dict[int, Corners]()
    for k, drive in enumerate(m.drives.values()):
        if drive.motor is not None and drive.effort is None and not drive.motor.straight:
            points = list(zip(drive.motor.speed, drive.motor.effort, strict=True))
            slopes = [0.0, *((e - e0) / (u - u0) for (u0, e0), (u, e) in pairwise(points)), 0.0]
            out[k] = [(u, new - old) for (u, _), (old, new) in zip(points, pairwise(slopes), strict=True)]
    return out


def _refuse(moves: Actuation) -> None:
    """Refuses efforts that the steps do not support: they must be functions of the drive's speed."""
    for joint, _ in joint_stops(moves.m):
        raise ModelError(f"joint {joint!r} has stops, which change speeds at once", REMEDY)
    for k, (name, drive) in enumerate(moves.m.drives.items()):
        motor = moves.motors.get(k)
        if k in moves.laws:
            raise ModelError(f"drive {name!r} has a law of motion, whose acceleration changes", REMEDY)
        if hasattr(drive.effort, "at"):
            raise ModelError(f"the effort of drive {name!r} depends on positions or time", REMEDY)
        if drive.brake:
            raise ModelError(f"drive {name!r} has a brake, which holds at rest", REMEDY)
        if drive.stops:
            raise ModelError(f"drive {name!r} has stops, which are met as events", REMEDY)
        if drive.motor is not None and drive.motor.geared:
            raise ModelError(f"the motor of drive {name!r} has a gear, inertia or an efficiency", REMEDY)
        if motor is not None and (motor.on or motor.off):
            raise ModelError(f"the motor of drive {name!r} has switches", REMEDY)


def _lines(m: Mechanism, moves: Actuation) -> Array:
    """``ROWS`` (5, D) of the drives: numbers, or symbols."""
    lines = np.zeros((5, len(moves.names)), object)
    for k, (name, drive) in enumerate(m.drives.items()):
        start, line = m.start.get(name), (0.0 if drive.effort is None else drive.effort, np.inf)
        if drive.motor is not None and drive.effort is None:
            line = drive.motor.effort[0], drive.motor.speed[1] if drive.motor.straight else np.inf
        rate, speed = (np.ravel(np.array(x, object))[0] for x in (drive.acceleration, drive.speed))
        begin = (moves.position[k], speed) if start is None else (start.position, start.speed)
        lines[:, k] = *line, 0.0 if moves.free[k] else rate, *begin
    return lines


def _of_drive(path: str) -> bool:
    """True if a path belongs to the actuation of a drive: given beside the equation, not in it."""
    return path.startswith("start.") or path.partition(".")[2].partition(".")[2].split(".")[0] in (
        "effort",
        "motor",
    )


def _varying(moves: Actuation, k: int) -> list[tuple[str, str]]:
    """Numbers of a drive that may vary outside the equation."""
    if k < 0 or not moves.free[k]:
        return []
    motor = moves.motors.get(k) if moves.drives[k].effort is None else None
    efforts = (
        ["effort"] if motor is None else [f"motor.{key}" for key in ("stall", "no_load") if motor.straight]
    )
    return [("start", "position"), ("start", "speed"), *(("drives", each) for each in efforts)]


def _number(moves: Actuation, lines: Array, path: str) -> VariedNumber:
    kind, name, *last = path.split(".")
    what, k = ".".join(last), moves.names.index(name) if name in moves.names else -1
    if (kind, what) not in (allowed := _varying(moves, k)):
        known = ", ".join(f"{of}.{name}.{each}" for of, each in allowed)
        raise ModelError(f"{path!r} is not a number of a drive that forces move", f"use {known or 'none'}")
    return VariedNumber(path, float(lines[ROWS[what], k]))


@dataclass(frozen=True)
class MotionKernel:
    """Compiled motions; call it with values (design, number) in SI, in the order of ``numbers``."""

    mechanism: Mechanism = field(repr=False)
    block: MotionBlock = field(repr=False)
    lines: Array = field(repr=False)
    formulas: dict[tuple[int, int], Node] = field(repr=False)
    where: tuple[VariedNumber, ...] = field(repr=False)
    places: tuple[int, ...] = field(repr=False)
    reduce: str | None

    @property
    def equation(self) -> Equation:
        """That of the drives."""
        return self.block.equation

    @property
    def numbers(self) -> tuple[str, ...]:
        """Paths of the numbers, one a column of the values."""
        return tuple(self.where[k].path for k in self.places)

    @property
    def nominal(self) -> Array:
        """Values of the numbers in the description."""
        return np.array([self.where[k].value for k in self.places])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return tuple(self.equation.kernel.outputs)

    def __call__(self, values: ArrayLike | None = None, threads: int | None = None) -> MotionBatch:
        """Motions of many designs: values (design, number), default those of the description; ``threads``: number of
        threads, default one per core."""
        designs = self._values(values)
        if (
            8 * len(designs) * self.block.output_count * (1 if self.reduce else self.block.instants)
            > available()
        ):
            raise ModelError(
                "the results are too large for memory", "reduce them, or take fewer designs at once"
            )
        each = max(self.block.code.lanes, AT_ONCE // self.block.instants)
        self.block.machine  # noqa: B018  # compiled once, not by each thread
        with ThreadPoolExecutor(threads) as pool:
            chunks = list(
                pool.map(self._reduced, (designs[k : k + each] for k in range(0, len(designs), each)))
            )
        return self._answer(designs, Motions(*(np.concatenate(x) for x in zip(*chunks, strict=True))))

    def _values(self, values: ArrayLike | None) -> Array:
        count = len(self.where)
        designs = numbers("values", self.nominal if values is None else values)
        if designs.ndim < 2 and not designs.size % max(count, 1):
            designs = designs.reshape(-1, count) if count else np.zeros((1, 0))
        if (
            designs.ndim != 2
            or designs.shape[1] != count
            or not len(designs)
            or not np.isfinite(designs).all()
        ):
            raise ModelError(
                f"values of shape {designs.shape} do not fit {count} numbers, or are not all finite",
                "give (design, number) in the order of .numbers",
            )
        return designs

    def _reduced(self, values: Array) -> Motions:
        """Motions of some designs, their outputs reduced; each design's instants side by side, so that none depends on
        what others there are."""
        ordered = values[:, np.argsort(self.places)] if self.places else values
        with np.errstate(all="ignore"):
            motions = self.block(*self._begin(ordered))
            out = motions.out[:, -1] if self.reduce == "final" else motions.out
            if self.reduce not in (None, "final") and self.block.output_count:
                one = np.ascontiguousarray(np.moveaxis(out, 1, -1))
                out = over_positions.reduce_positions(self.reduce, np.moveaxis(one, -1, 0))
        return motions._replace(out=out, sure=motions.sure & ~self._other_branch(ordered))

    def _other_branch(self, values: Array) -> Flags:
        """Designs whose assembly mode may be another than the file's."""
        kernel = self.equation.kernel
        designs = np.tile(kernel.nominal, (len(values), 1))
        designs[:, : -2 * self.lines.shape[1]] = values[:, : designs.shape[1] - 2 * self.lines.shape[1]]
        changed = kernel.may_change_branch(designs)
        return np.zeros(len(values), bool) if changed is None else np.asarray(changed)

    def _begin(self, values: Array) -> tuple[Array, Array]:
        """States (M, n) at time 0, and values (M, ...) of the steps."""
        names, many = self.equation.names, (len(values), 1)
        count = len(self.equation.values) - 1 - 2 * len(names)
        base, parts = np.tile(self.equation.values, many), np.tile(self.lines, (len(values), 1, 1))
        base[:, :count] = values[:, :count]
        kernel, nodes = self.equation.kernel, list(self.formulas.values())
        along = {n.index: column for n, column in zip(kernel.number_nodes, values.T, strict=False)}
        for place, column in zip(
            self.formulas, kernel.trace.catalogue.graph.evaluate(nodes, along), strict=True
        ):
            parts[:, *place] = column
        for column, n in enumerate(self.where[count:], count):
            _, name, what = n.path.split(".", 2)
            parts[:, ROWS[what], names.index(name)] = values[:, column]
        first, ends, ahead, q, u = parts.swapaxes(0, 1)
        return np.concatenate([q, u], axis=1), np.concatenate(
            [base, first, -first / ends, 0 * first, ahead], axis=1
        )

    def _answer(self, designs: Array, motions: Motions) -> MotionBatch:
        d, axis, place, arrays = self.lines.shape[1], 1 if self.reduce else 2, 0, {}
        texts = [*(c.text for c in self.block.conditions), "time"]
        ended = [texts[k] if sure else UNDECIDED for k, sure in zip(motions.met, motions.sure, strict=True)]
        for x in (motions.out, motions.time, motions.state):
            x[~motions.sure] = np.nan
        for name, nodes in self.equation.kernel.nodes.items():
            part = np.take(motions.out, range(place, place + len(nodes)), axis=axis)
            arrays[name] = part if len(nodes) > 1 else part.squeeze(axis)
            place += len(nodes)
        return MotionBatch(
            designs, motions.time, motions.state[:, :d], motions.state[:, d:], tuple(ended), arrays
        )
