"""Common parts of motions with events of many designs: machine code and guards of a machine.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from dalembert.errors import ModelError
from dalembert.kernel.graph import Node
from dalembert.machine.motion.actuation import Actuation, drive_lengths, joint_stops
from dalembert.machine.motion.coded.rate_program import Corners, MasslessError
from dalembert.machine.motion.corners.one_sided import has_corners
from dalembert.machine.motion.equation import Equation, StoppedError, no_inertia
from dalembert.machine.motion.many.course.course_state import EventMachine
from dalembert.machine.motion.many.course.guards import Guards
from dalembert.machine.motion.many.event_block import EventBlock
from dalembert.machine.motion.many.event_program import EventCode, event_code
from dalembert.machine.motion.occurrences import EventCondition
from dalembert.machine.motion.rest.dry_friction import sided
from dalembert.machine.motion.stops.opened_contacts import opened
from dalembert.model import Mechanism
from dalembert.model.drives.motors import MotorCurve
from dalembert.model.joints.elements.one_way_joints import Clutch
from dalembert.model.quantities.coordinates import TIME

REMEDY = "use da.simulate for such a machine"
Row = tuple[str, int, int, float | Node]
"""Kind, number, column and level of a guard."""


def refuse_events(m: Mechanism, prescribed: Mechanism, moves: Actuation, rough: bool) -> bool:
    """True if a motion of a machine has events, with dry friction or a brake that varies if ``rough``; raises
    ModelError for those that only motions alone have."""
    if any(getattr(joint, "pitch", 0.0) for joint in m.joints.values() if isinstance(joint, Clutch)):
        raise ModelError("a ratchet meets its teeth one by one", REMEDY)
    rests = rough or bool(moves.brake.any())
    if rests and moves.free.sum() > 1:
        raise ModelError(
            "two or more drives that move freely have dry friction or brakes, and each of them may stick",
            REMEDY,
        )
    if rests and _others_move(moves):
        raise ModelError("a prescribed drive moves beside dry friction or a brake", REMEDY)
    switched = False
    for k, motor in moves.motors.items():
        if motor.on or motor.off:
            switched = True
            if motor.kinks or moves.drives[k].effort is not None:
                raise ModelError(f"the motor of drive {moves.names[k]!r} has a curve, and switches", REMEDY)
    bent = any(has_corners(v) for load in m.loads.values() for v in getattr(load, "varying", ()))
    acts = any(
        d.stops is not None or hasattr(d.effort, "at") or (d.motor is not None and _acts(d.motor))
        for d in moves.drives
    )
    stopped = acts or bool(joint_stops(prescribed)) or opened(prescribed, moves) is not None
    return rests or switched or bent or stopped


def _others_move(moves: Actuation) -> bool:
    """True if a prescribed drive moves."""
    others = ~moves.free
    return bool((moves.speed[others] != 0).any() or (moves.acceleration[others] != 0).any())


def _acts(motor: MotorCurve) -> bool:
    """True if a motor's effort is more than a line over the speed."""
    return bool(motor.time_constant or motor.inertia)


def event_block(
    equation: Equation,
    moves: Actuation,
    conditions: Sequence[EventCondition],
    corners: Mapping[int, Corners],
    choices: tuple[float, float, int],
    lanes: int,
    reduce: str | None,
) -> EventBlock:
    """Motions with events until an end, to a tolerance, with a number of instants."""
    end, tolerance, instants = choices
    free = moves.free
    try:
        code = event_code(equation, free, corners, lanes)
    except MasslessError as massless:
        raise StoppedError(no_inertia(np.array(moves.names)[free][massless.drive])) from None
    if code is None:
        raise ModelError("the motion has loads that no formula gives, or too many contacts", REMEDY)
    rests = equation.dry is not None or bool(moves.brake.any())
    late = len(equation.late)
    rows = _rows(equation, moves, conditions, corners, code, rests)
    kinds = [row[0] for row in rows]
    machine = EventMachine(
        code,
        int(np.flatnonzero(free)[0]),
        free,
        free.sum() == 1 and not _others_move(moves),
        len(free),
        rests,
        len(equation.values),
        np.array(equation.sides, int),
        [stop.drive for stop in equation.stops],
        Guards.of([row[:3] for row in rows]),
        np.array([kind == "condition" for kind in kinds], bool),
        bool(late) or _by_time(moves.m),
        end,
        tolerance,
        drive_lengths(equation.kernel.mechanism),
        np.array([max(map(abs, moves.motors[k].effort)) for k in equation.late], float),
    )
    return EventBlock(equation, machine, tuple(conditions), tuple(row[3] for row in rows), instants, reduce)


def _by_time(m: Mechanism) -> bool:
    """True if a load or an effort depends on time."""
    varying = [v for load in m.loads.values() for v in getattr(load, "varying", ())]
    varying += [d.effort for d in m.drives.values()]
    return any(TIME in getattr(v, "names", ()) for v in varying)


def _rows(
    equation: Equation,
    moves: Actuation,
    conditions: Sequence[EventCondition],
    corners: Mapping[int, Corners],
    code: EventCode,
    rests: bool,
) -> list[Row]:
    """All guards; columns: positions, speeds, what is watched, and the time."""
    d, n, sides = len(moves.names), code.steps.n, len(equation.sides)
    margins, switching = n + code.place("margins"), n + code.place("corners")
    time, k = n + code.steps.watched, int(np.flatnonzero(moves.free)[0])
    rows: list[Row] = [("rest", k, d + k, 0.0)] if rests else []
    rows += [("contact", e, n + e, 0.0) for e in range(code.contacts)]
    for j, stop in enumerate(equation.stops):
        rows.append(("clutch" if stop.clutch else "stop", j, n + code.place("stops") + j * (2 + d), 0.0))
    rows += [("lost", j, n + code.place("lost") + j, 0.0) for j in range(code.lost)]
    rows += [("side", n, margins + n, 0.0) for n in _bearing(equation, code.margins)]
    rows += [("corner", j, switching + j, 0.0) for j in range(sides)]
    rows += [("kink", j, switching + j, 0.0) for j in range(sides, code.corners)]
    for j, bends in corners.items():
        rows += [("kink", j, d + j, speed) for speed, _ in bends]
    for j, motor in moves.motors.items():
        for kind, switch in (("on", motor.on), ("off", motor.off)):
            if switch is not None and moves.free[j]:
                rows.append((kind, j, {"time": time, "position": j, "speed": d + j}[switch[0]], switch[1]))
    return rows + [("condition", n, c.place(d), c.value) for n, c in enumerate(conditions)]


def _bearing(equation: Equation, margins: int) -> list[int]:
    """Margins of contacts that bear on sides; only one of those without a tilting force."""
    if equation.dry is None:
        return []
    contacts, count = equation.dry.contacts, margins // 2
    tilts = contacts.read[2, sided(contacts)]
    return [n for n in range(margins) if n < count or tilts[n - count].any()]
