"""Printed tables of machine elements: cylinders, at one position or the extremes over many."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.elements.cylinder_quantities import cylinders
from dalembert.analysis.methods.elements.screw_torques import ScrewAnswer, screws
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.arrays import first_largest
from dalembert.printing import Part, TextTable, number, range_text, with_unit, wrap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


VACUUM = (
    "Cylinder {name} pulls a vacuum{where}: a chamber would need {least}, less than the air's pressure below zero. "
    "Give the other chamber a higher pressure, or a larger area."
)
COLUMN = (
    "Column of {name}: {force} of {critical} (ends {ends}; between {rod} for the rod's section all along and {barrel} "
    "for the barrel's), safety {safety}. Play and misalignment are left out."
)


def element_parts(result: Result, to: Printed) -> Iterator[Part]:
    """Tables of the machine elements of a result, after its reactions."""
    yield from _screw_parts(result, to)
    known = [result.cylinder(name) for name in cylinders(result.mechanism)]
    known = [c for c in known if np.isfinite(c.force).any()]
    if not known:
        return
    yield _cylinder_table(known, to, len(result.status) > 1)
    for c in known:
        if c.vacuum.any():
            yield wrap(_vacuum(result, c, to))
        if np.isfinite(c.critical).any() and (c.force > 0).any():
            yield wrap(_column(result, c, to))


_LOCKS = "The screw of {name} {locks}: its thread alone holds any force from a coefficient of {least} on."


def locking_sentence(s: ScrewAnswer) -> str:
    """True if a screw locks by itself, and the coefficient from which on its thread alone does."""
    locks = "is self-locking" if s.self_locking else "does not lock by itself"
    return _LOCKS.format(name=s.name, locks=locks, least=f"{s.locking_coefficient:.4g}")


def _screw_parts(result: Result, to: Printed) -> Iterator[Part]:
    """Torque and efficiency of screws, where they turn most heavily."""
    rows, notes, many = [], [], len(result.status) > 1
    for name in screws(result.mechanism):
        s = result.screw(name)
        if np.isfinite(s.torque).any():
            k = first_largest(np.maximum(-s.torque_low, s.torque_high))
            torque = range_text(to.number("moment", float(x[k])) for x in (s.torque_low, s.torque_high))
            rows.append(
                [
                    name,
                    *([to.quantity("length", float(result.drive_position(name)[k]))] if many else []),
                    to.quantity("force", float(s.force[k])),
                    f"{torque} {to.text('moment')}",
                    number(s.efficiency[k], 4),
                ]
            )
            notes.append(wrap(locking_sentence(s)))
    if rows:
        heads = ["screw", "at", "force", "greatest\ntorque"] if many else ["screw", "force", "torque"]
        yield TextTable([*heads, "efficiency"], rows, 1)
        yield from notes


def _cylinder_table(known: list[Any], to: Printed, many: bool) -> TextTable:
    def cell(kind: str, values: object) -> str:
        value = np.asarray(values, float)
        return with_unit(float(to(kind, float(np.nanmax(value)))), to.text(kind))

    most = "greatest\n" if many else ""
    heads = ["cylinder", f"{most}force", f"{most}cap pressure", f"{most}rod pressure"]
    rows = [
        [
            c.name,
            cell("force", c.force),
            cell("pressure", c.cap_pressure),
            cell("pressure", c.rod_pressure),
            cell("flow", c.flow_in),
            cell("flow", c.flow_out),
        ]
        for c in known
    ]
    return TextTable([*heads, f"{most}flow in", f"{most}flow out"], rows, 1)


def _vacuum(result: Result, c: Any, to: Printed) -> str:
    least = np.fmin(c.cap_pressure, c.rod_pressure)
    where = f" at {_place(result, first_largest(-least), c, to)}" if len(least) > 1 else ""
    return VACUUM.format(name=c.name, where=where, least=to.quantity("pressure", float(np.nanmin(least))))


def _column(result: Result, c: Any, to: Printed) -> str:
    k = c.worst
    loads = {
        key: to.quantity("force", float(x[k]))
        for key, x in (("rod", c.critical_rod), ("barrel", c.critical_barrel))
    }
    at = f" at {_place(result, k, c, to)}" if len(c.force) > 1 else ""
    return COLUMN.format(
        name=c.name,
        force=to.quantity("force", float(c.force[k])) + at,
        critical=to.quantity("force", float(c.critical[k])),
        ends=" and ".join(cylinders(result.mechanism)[c.name].ends),
        safety=f"{c.safety[k]:.4g}",
        **loads,
    )


def _place(result: Result, k: int, c: Any, to: Printed) -> str:
    return f"{c.name} = {to.quantity('length', float(c.length[k]))}"
