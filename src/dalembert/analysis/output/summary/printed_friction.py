"""Printed form of friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.contacts import coefficient
from dalembert.analysis.friction.joint_friction import bears_on_faces, friction_circle_radius, guide_contact
from dalembert.analysis.output.columns import friction_joints
from dalembert.analysis.output.summary.printed_units import Printed, significant
from dalembert.analysis.result.number_kinds import unknown_kinds
from dalembert.answer.column import Scale
from dalembert.arrays import Array
from dalembert.printing import Part, TextTable, number, range_text, with_unit

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def ends_text(result: Result, name: str, to: Printed, position: int = 0) -> str:
    """'-7304 to -4522 N*m', or '18006.1 N or more' where none is large enough to move the machine."""
    kind = unknown_kinds(result)[name]
    return range_text(_ends(to(kind, result.interval(name)[position])), to.text(kind))


def _ends(ends: Array, digits: int = 6) -> list[str | None]:
    return [number(float(end), digits) if np.isfinite(end) else None for end in ends]


def open_text(result: Result, name: str, to: Printed) -> str:
    """At the first position of two numbers: the interval at rest, both sides of a reversal; '' where there is one."""
    if result.status[0] == "at_rest":
        return ends_text(result, name, to)
    if not result.reverses[0]:
        return ""
    kind = unknown_kinds(result)[name]
    values = (
        side.effort(name) if name in result.drives else side.unknown_load(name) for side in result.sides
    )
    return " / ".join(number(float(to(kind, v[0]))) for v in values) + f" {to.text(kind)}"


def with_ends(result: Result, to: Printed, position: int, cells: list[str]) -> list[str]:
    """A row of the table of positions with intervals where friction leaves efforts and unknown loads open."""
    names = [*result.drives, *result.unknown_loads]
    out = list(cells)
    for k, name in enumerate(names, len(result.drives)):
        if result.ends and name in unknown_kinds(result):
            ends = to(unknown_kinds(result)[name], result.interval(name)[position])
            out[k] = range_text(_ends(ends, 5)) if np.isfinite(ends).any() else out[k]
    return out


def branch_note(result: Result) -> str:
    """Note on the positions where the solution is the physical one of possibly several."""
    f = result.friction
    if f is None:
        return ""
    several = ~f.single & np.isfinite(f.cz).all(axis=-1) & np.isnan(f.critical)
    if not several.any():
        return ""
    which = "here" if len(several) == 1 else f"at {int(several.sum())} positions"
    return (
        f"Friction is so strong {which} that its equations may have other solutions: given is the physical one, "
        "continued from no friction (`--other-solutions` seeks the others, in Python `da.other_solutions`)."
    )


def efficiency_note(result: Result) -> str:
    """Efficiency at a single position in both senses; without speed there is none."""
    from dalembert.analysis.friction.efficiency import efficiency

    if not (result.schedule.speed != 0).any():
        return ""
    shares = efficiency(result)
    senses = (
        (shares.forward[0], f"drive moves the load{shares.driven(0)}"),
        (shares.reverse[0], f"load moves the drive{shares.held(0)}"),
    )
    parts = [
        f"{number(100 * float(value), 4)} % where the {words}"
        for value, words in senses
        if np.isfinite(value)
    ]
    return f"Efficiency, without inertia: {'; '.join(parts)}." if parts else ""


def cycle_table(result: Result, to: Printed) -> Part:
    """Loss of each joint's friction over all positions, and the efficiency."""
    from dalembert.analysis.friction.efficiency import NOTHING, efficiency

    if result.friction is None or not (result.schedule.speed != 0).any():
        return ""
    values = efficiency(result)
    if not np.isfinite(values.cycle):
        return ""
    unit = to("energy", 1.0)
    shares = {
        joint: share if abs(share) >= NOTHING else 0.0
        for joint, share in values.share.items()
        if joint in friction_joints(result)
    }
    rows = [[j, number(x * values.put_in * unit), f"{number(100 * x, 4)} %"] for j, x in shares.items()]
    heads = ["friction over\nthe positions", f"work lost\n{to.text('energy')}", "of the work\nput in"]
    cycle = 0.0 if abs(values.cycle) < NOTHING else 100 * values.cycle
    words = f"Efficiency over the positions, inertia and all: {number(cycle, 4)} %."
    return TextTable(heads, rows, 1, words)


def friction_table(result: Result, to: Printed) -> TextTable:
    """Friction force, couple and lost power of each joint at the first position, and how guides bear."""
    heads = ["friction", "on j", f"force\n{to.text('force')}", f"couple\n{to.text('moment')}"]
    heads += [f"power lost\n{to.text('power')}", "law"]
    rows = []
    for joint in friction_joints(result):
        part = result.mechanism.joints[joint]
        turning = result.friction_moment(joint)[0]
        shown = {
            "force": np.linalg.norm(result.friction_force(joint)[0]),
            "moment": np.linalg.norm(turning) if np.ndim(turning) else turning,
            "power": result.power_lost(joint)[0],
        }
        cells = [number(float(to(k, significant(result, k, np.array([x]))[0]))) for k, x in shown.items()]
        bears = guide_contact(result, joint).mode[0] if bears_on_faces(result, joint) else ""
        law = ", ".join(part for part in (friction_text(result, joint, to), bears) if part)
        rows.append([joint, part.links[1], *cells, law])
    return TextTable(heads, rows, 2)


def friction_text(result: Result, joint: str, to: Scale) -> str:
    """The friction of a joint in words: 'mu 0.1, friction circle 2 mm', in space also 'collar 15 mm'."""
    part = result.mechanism.joints[joint]
    friction: Any = getattr(part, "friction", None)
    efficiency = getattr(part, "efficiency", None)
    if efficiency is not None:
        return f"efficiency {efficiency:.6g}"
    if friction is None:
        return "viscous"
    sizes = {
        "friction circle": friction_circle_radius(result, joint),
        "thread": friction.radius if part.pair.threaded else None,
        "collar": getattr(friction, "thrust_radius", None),
    }
    shown = [
        f"{name} {with_unit(to('length', size), to.text('length'))}" for name, size in sizes.items() if size
    ]
    constant = getattr(friction, "force", None)
    if constant:
        shown.append(f"constant {with_unit(to('force', constant), to.text('force'))}")
    return ", ".join([f"mu {coefficient(result.mechanism, part):.6g}", *shown])
