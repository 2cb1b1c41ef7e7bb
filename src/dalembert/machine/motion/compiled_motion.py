"""``da.compile_motion``: motions under forces of many designs side by side in machine code, each with a separate step
sizes.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.checked_input import lanes_here
from dalembert.analysis.batch.tracing.symbolic_model import VariedNumber, with_numbers
from dalembert.analysis.batch.tracing.traced_parameters import symbol_functions
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.kernel.graph import Node
from dalembert.machine.motion.actuation import Actuation, actuation, drive_lengths, read_start
from dalembert.machine.motion.coded.rate_program import Corners
from dalembert.machine.motion.equation import Equation, StoppedError
from dalembert.machine.motion.equation_trace import trace_equation
from dalembert.machine.motion.many.event_kernel import EventKernel
from dalembert.machine.motion.many.event_machine import event_block, refuse_events
from dalembert.machine.motion.many.motion_block import MotionBlock
from dalembert.machine.motion.many.motion_kernel import ROWS, MotionKernel
from dalembert.machine.motion.occurrences import read_end
from dalembert.machine.motion.simulation import check_choices
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.model.drives.starting import Start
from dalembert.model.quantities.tables import Table

CORNERED = 0.01
"""Part of the tolerance for motors with corners: a step that goes over one errs by more than it says."""
REMEDY = "use da.simulate for such a machine"


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
    motion grows beyond it with the steps: compare with a tenth of it. Dry friction and brakes of one drive that forces
    move, switches of motors, corners and tables of loads and efforts, stops and clutches are events of each
    design; outputs have values at these instants too. Raises ModelError for laws, ratchets, gears with losses, and
    friction of several free drives.

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
    stopped = next((path for path in vary if path.split(".")[2:3] == ["stops"]), "")
    if stopped:
        raise ModelError(f"{stopped!r} cannot vary by its path", "write it as a parameter, and vary that")
    lanes = lanes_here()
    rubs = [name for name, joint in m.joints.items() if getattr(joint, "friction", None) is not None]
    rough = bool(rubs) or any(path.endswith(".brake") for path in driven)
    events = refuse_events(m, prescribed, moves, rough)
    inside = [path for path in vary if path not in driven]
    try:
        equation = trace_equation(prescribed, inside, outputs, acting=moves if events else None)
    except ModelError as error:
        why = f"joint {rubs[0]!r} has dry friction: " if rubs else ""
        raise ModelError(f"{why}{error.what}", REMEDY if rubs else error.remedy, error.path) from None
    traced = equation.kernel.trace.numbers[: -2 * len(moves.names)]
    _refuse_counts(equation)
    symbols = _symbols(m, equation, traced)
    corners, lines = _corners(symbols), _lines(m, moves).astype(float)
    formulas = {at: x for at, x in np.ndenumerate(_lines(symbols, moves)) if isinstance(x, Node)}
    where = (*traced, *(_number(moves, lines, path) for path in driven))
    places = tuple(k for path in vary for k, n in enumerate(where) if f"{n.path}.".startswith(f"{path}."))
    instants = 1 if reduce == "final" or not outputs else count
    parts = (m, lines, formulas, where, places, reduce)
    if events or equation.bends:
        block = event_block(equation, moves, conditions, corners, (end, tolerance, instants), lanes, reduce)
        return EventKernel(block, *parts, several(until), count, moves)
    code = equation.steps(moves.free, lanes, works=False, corners=corners)
    if code is None:
        raise ModelError("the motion has loads that no formula gives, so that it is not smooth", REMEDY)
    small = max(tolerance * CORNERED, 1e-14) if corners else tolerance
    smooth = MotionBlock(equation, code, tuple(conditions), end, small, instants, drive_lengths(prescribed))
    return MotionKernel(smooth, *parts)


def several(until: str | float | Sequence[str | float]) -> tuple[str | float, ...]:
    """Ends as given, one or several."""
    return (until,) if isinstance(until, (str, int, float)) else tuple(until)


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
            motor = drive.motor.at_drive
            points = list(zip(motor.speed, motor.effort, strict=True))
            slopes = [0.0, *((e - e0) / (u - u0) for (u0, e0), (u, e) in pairwise(points)), 0.0]
            out[k] = [(u, new - old) for (u, _), (old, new) in zip(points, pairwise(slopes), strict=True)]
    return out


def _refuse(moves: Actuation) -> None:
    """Refuses laws, and stops and efforts that the steps do not support."""
    for k, (name, drive) in enumerate(moves.m.drives.items()):
        if k in moves.laws:
            raise ModelError(f"drive {name!r} has a law of motion, whose acceleration changes", REMEDY)
        if isinstance(drive.effort, Table) and (drive.effort.period or drive.effort.outside == "zero"):
            raise ModelError(f"the table of the effort of drive {name!r} repeats, or ends at zero", REMEDY)
        if drive.motor is not None and drive.motor.efficiency < 1:
            raise ModelError(f"the gear of the motor of drive {name!r} has losses", REMEDY)


def _lines(m: Mechanism, moves: Actuation) -> Array:
    """``ROWS`` (6, D) of the drives: numbers, or symbols."""
    lines = np.zeros((6, len(moves.names)), object)
    for k, (name, drive) in enumerate(m.drives.items()):
        effort = 0.0 if drive.effort is None or hasattr(drive.effort, "at") else drive.effort
        start, line = m.start.get(name), (effort, np.inf)
        if drive.motor is not None and drive.effort is None:
            motor = drive.motor.at_drive
            line = motor.effort[0], motor.speed[1] if motor.straight else np.inf
        rate, speed = (np.ravel(np.array(x, object))[0] for x in (drive.acceleration, drive.speed))
        begin = (moves.position[k], speed) if start is None else (start.position, start.speed)
        lines[:, k] = *line, 0.0 if moves.free[k] else rate, *begin, drive.brake or 0.0
    return lines


def _of_drive(path: str) -> bool:
    """True if a path belongs to the actuation of a drive: given beside the equation, not in it."""
    return path.startswith("start.") or path.partition(".")[2].partition(".")[2].split(".")[0] in (
        "effort",
        "motor",
        "brake",
    )


def _varying(moves: Actuation, k: int) -> list[tuple[str, str]]:
    """Numbers of a drive that may vary outside the equation."""
    if k < 0 or not moves.free[k]:
        return []
    motor = moves.motors.get(k) if moves.drives[k].effort is None else None
    efforts = [] if hasattr(moves.drives[k].effort, "at") else ["effort"]
    if motor is not None:
        plain = motor.straight and not moves.drives[k].motor.geared  # type: ignore[union-attr]
        efforts = [f"motor.{key}" for key in ("stall", "no_load") if plain]
    return [("start", "position"), ("start", "speed"), *(("drives", each) for each in (*efforts, "brake"))]


def _number(moves: Actuation, lines: Array, path: str) -> VariedNumber:
    kind, name, *last = path.split(".")
    what, k = ".".join(last), moves.names.index(name) if name in moves.names else -1
    if (kind, what) not in (allowed := _varying(moves, k)):
        known = ", ".join(f"{of}.{name}.{each}" for of, each in allowed)
        raise ModelError(f"{path!r} is not a number of a drive that forces move", f"use {known or 'none'}")
    return VariedNumber(path, float(lines[ROWS[what], k]))
