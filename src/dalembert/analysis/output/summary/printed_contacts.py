"""Contacts that only push or pull in the printed answer: their normal forces and the speeds at which they are lost."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.number_kinds import contact_kind, drive_kinds
from dalembert.arrays import Array
from dalembert.printing import Part, TextTable, wrap

if TYPE_CHECKING:
    from dalembert.analysis.methods.contact_force import ContactHistory
    from dalembert.analysis.result.result import Result

MOST_NAMED = 8
"""Places that are named one by one."""

LEAST = {"force": "least normal force", "moment": "least couple"}
"""What a contact pushes with, and a one-way clutch turns with."""

ENDS = (("behind", ", rear end"), ("ahead", ", front end"))


def contact_parts(r: Result, to: Printed) -> Iterator[Part]:
    """A row for each contact, of a guide with lengths for each end, of a one-way clutch its couple; and up to which
    speed one that is lost stays on."""
    yield from _held_parts(r, to)
    pushing = r.compiled.pushing
    if pushing is None or not r.inertia or not np.isfinite(r.force_array).any():
        return
    out = {joint: r.contact(joint) for joint in dict.fromkeys(r.joints[k] for k in pushing.joint)}
    rows: dict[str, list[list[str]]] = {kind: [] for kind in LEAST}
    lost = []
    for joint, c in out.items():
        speed = _speed(r, c, to) if c.lift_factor > 0 else ""
        kind = contact_kind(r, joint)
        for name, force in _forces(joint, c):
            ends = [float(np.nanmin(force)), float(np.nanmax(force))] if np.isfinite(force).any() else []
            rows[kind].append([name, *(to.number(kind, x) for x in ends or (np.nan, np.nan)), speed])
        if 0 < c.lift_factor < 1:
            lost.append(
                f"{joint} stays in contact up to {speed} (now {_speed(r, c, to, 1 / c.lift_factor)})."
            )
    for kind, some in rows.items():
        if some:
            unit = to.text(kind)
            yield TextTable(["contact", f"{LEAST[kind]}\n{unit}", f"greatest\n{unit}", "lost from"], some)
    if lost:
        yield "\n".join(map(wrap, lost))


def _held_parts(r: Result, to: Printed) -> Iterator[Part]:
    """Positions at which followers in grooves and on conjugate cams go over from one wall or disc to the other."""
    if not np.isfinite(r.force_array).any() or not r.drives:
        return
    for name, joint in r.mechanism.joints.items():
        if not joint.outlined or joint.contact.mode != "holds":  # type: ignore[union-attr]
            continue
        c = r.contact(name)
        if c.changes is None or not c.changes.size:
            continue
        kind = drive_kinds(r, r.drives[0])["position"]
        at = ", ".join(to.number(kind, x) for x in c.changes[:MOST_NAMED].tolist())
        more = f" and {len(c.changes) - MOST_NAMED} more" if len(c.changes) > MOST_NAMED else ""
        where = f"near {r.drives[0]} = {at}{more} {to.text(kind)}"
        if joint.preload is None:  # type: ignore[union-attr]
            yield wrap(f"{name} goes over from one wall to the other {where}: with play it knocks there.")
        else:
            least = to.quantity("force", float(np.nanmax(np.abs(c.force))) / 2)
            yield wrap(f"A disc of {name} comes off or on {where}; from {least} of preload on both stay on.")


def _forces(joint: str, c: ContactHistory) -> list[tuple[str, Array]]:
    ends = [(joint + words, getattr(c, end)) for end, words in ENDS if getattr(c, end) is not None]
    return ends or [(joint, c.needed)]


def _speed(r: Result, c: ContactHistory, to: Printed, times: float = 1.0) -> str:
    """The lift speed, that of the first drive that moves."""
    if not np.isfinite(c.lift_speed):
        return ""
    drive = r.drives[int(np.argmax((r.schedule.speed != 0).any(axis=0)))]
    return to.quantity(drive_kinds(r, drive)["speed"], times * c.lift_speed)
