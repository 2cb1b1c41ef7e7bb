"""The mechanism whose contacts may open: the normal constraint of each becomes a freedom, its gap.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.compile.joint_rows import stated_poses
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.core.constraints import measure
from dalembert.errors import ModelError
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.stops.gap_contacts import GapContact, contacts_of
from dalembert.model import Mechanism, Schedule
from dalembert.model.drives.drives import Drive
from dalembert.model.drives.end_stops import Stops


def opened(m: Mechanism, moves: Actuation) -> tuple[Mechanism, Actuation] | None:
    """The prescribed mechanism and its actuation with the gaps of all contacts that push; None without such."""
    pushing = [n for n, j in m.joints.items() if _mode(j) in ("pushes", "pulls") and j.lifted]
    names = pushing if m.dimension == 2 else []
    below = list(_below(m, moves))
    if not names and not below:
        return None
    driven = _of_drives(m, names)
    other = with_opened(m, [n for n in names if n not in driven], "stop")
    start = _at_start(other, moves)
    opened_m = with_opened(other, driven, "drive")
    count, contacts, drives = len(m.drives), list(below), dict(m.drives)
    for joint in names:
        wheel = "slip" in m.joints[joint].lifted
        for contact in contacts_of(opened_m, joint):
            if joint in driven:
                contact = replace(contact, drive=len(drives), slip=len(drives) + 1 if wheel else -1)
                drives[f"{joint} {contact.freedom}"] = _gap_drive(
                    joint, contact.freedom, contact.at, contact.stops
                )
            contacts.append(contact)
        if joint in driven and wheel:
            drives[f"{joint} slip"] = _gap_drive(joint, "slip", 0.0)
    opened_m = opened_m.model_copy(
        update={
            "drives": drives,
            "assembly": stated_poses(start.compiled.layout, start.links, full_pose(start, -1)),
        }
    )
    return _placed(opened_m, moves, start, count, contacts)


def _placed(
    m: Mechanism, moves: Actuation, start: Result, count: int, contacts: list[GapContact]
) -> tuple[Mechanism, Actuation]:
    """Both, with the positions of the gaps at the start; the first ``count`` drives are those of the description."""
    drives, gaps = dict(m.drives), list(m.drives)[count:]
    c = compile_mechanism(m, _schedule(m, np.concatenate([moves.position, np.zeros(len(gaps))])))
    values = measure(c.layout.algebra, c.layout.freedoms, full_pose(start))[0]
    for name in gaps:
        if str(drives[name].freedom) == "slip":
            row = c.freedoms.index((drives[name].joint or "", "slip"))
            drives[name] = drives[name].model_copy(update={"position": float(values[row])})
    m = m.model_copy(update={"drives": drives})
    steady = {"effort": None, "stops": None, "speed": 1.0}
    prescribed = {n: d.model_copy(update=steady) if n in gaps else d for n, d in drives.items()}
    own = {n: d for n, d in drives.items() if n in gaps}
    ends = {list(moves.m.drives)[c.drive]: c.stops for c in contacts if c.freedom == "slide"}
    own |= {n: moves.m.drives[n].model_copy(update={"stops": stops}) for n, stops in ends.items()}
    none = np.zeros(len(gaps))
    acting = replace(
        moves,
        m=moves.m.model_copy(update={"drives": {**moves.m.drives, **own}}),
        free=np.append(moves.free, np.ones(len(gaps), bool)),
        position=np.append(moves.position, [drives[n].position for n in gaps]),
        speed=np.append(moves.speed, none),
        acceleration=np.append(moves.acceleration, none),
        contacts=tuple(contacts),
    )
    return m.model_copy(update={"drives": prescribed}), acting


def _mode(joint: Any) -> str:
    contact = getattr(joint, "contact", None)
    return contact.mode if contact is not None and not joint.TOOTHED else ""


def _below(m: Mechanism, moves: Actuation) -> Iterator[GapContact]:
    """Contacts at the end of a guide, pushed along its slide."""
    for k, (name, drive) in enumerate(moves.m.drives.items()):
        joint = moves.m.drive_joint(name)
        contact = getattr(moves.m.joints.get(joint), "contact", None)
        if contact is not None and contact.below and drive.freedom == "slide":
            yield GapContact(joint, "slide", 1.0, 0.0, contact.restitution, k)


def with_opened(m: Mechanism, names: list[str], by: str) -> Mechanism:
    """The mechanism with the contacts of some joints opened."""
    joints: dict[str, Any] = dict(m.joints)
    for name in names:
        contact = replace(joints[name].contact, opened=by)
        joints[name] = joints[name].model_copy(update={"contact": contact})
    return m.model_copy(update={"joints": joints})


def _gap_drive(joint: str, freedom: str, at: float, stops: Stops | None = None) -> Drive:
    drive = Drive(joint=joint, freedom="slide", position=at, effort=0.0)
    return drive.model_copy(update={"freedom": freedom, "stops": stops})


def _of_drives(m: Mechanism, names: list[str]) -> list[str]:
    """Contacts whose gaps the drives do not determine: their gaps are coordinates, those of the others have stops."""
    every = with_opened(m, names, "stop")
    layout = compile_mechanism(every, _schedule(every, np.zeros(len(m.drives)))).layout
    needed = layout.unknowns - layout.constraints.count - len(m.drives)
    if needed <= 0:
        return []
    size = {n: len(m.joints[n].lifted) for n in names}
    chosen = [
        list(c)
        for k in range(len(names) + 1)
        for c in combinations(names, k)
        if sum(size[n] for n in c) == needed
    ]
    return chosen[0] if chosen else names


def _schedule(m: Mechanism, position: Array) -> Schedule:
    at = np.asarray(position, float)[None]
    return Schedule(tuple(m.drives), at, np.zeros_like(at), np.zeros_like(at), np.zeros(1))


def _at_start(m: Mechanism, moves: Actuation) -> Result:
    """Poses at the start, contacts whose gaps are coordinates closed."""
    r = at_schedule(m, _schedule(m, moves.position), inertia=False, forces=False)
    if not np.isfinite(r.point_array).all():
        raise ModelError(
            f"the motion cannot begin: {r.reasons[0] or r.status[0]}", "start elsewhere", ("start",)
        )
    return r
