"""Contacts of teeth in space: they know their axes once the wheels are in mesh at the first pose.

On skew axes (worms) teeth slide along their trace, with mu times the normal force. On parallel and intersecting ones
the wheels turn on each other about the common generator, with the couple of friction at the mean distance of the
contact, or of the efficiency: the mean of both tangential forces times 2 (1 - eta)/(1 + eta) is their difference.

Mechanics: docs/theory.md 5.4.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.contacts import contact_arm
from dalembert.arrays import Array
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.gear_rows import gains, gearings
from dalembert.core.layout import Family, Layout, Pose, ToothCouple, ToothForce
from dalembert.errors import ModelError
from dalembert.model import Mechanism

FITTED = ("ui", "uj", "ri", "rj", "direction", "cone", "outward", "ki", "kj")
"""Numbers of a mesh that follow from the first pose."""


def fitted_contacts(m: Mechanism, contacts: Contacts | None, layout: Layout, pose: Pose) -> Contacts | None:
    """The contacts with the teeth's places, directions and levers at a pose (L+1, ...), at which the wheels mesh."""
    teeth = [f for f in contacts.rows.families if isinstance(f, ToothForce | ToothCouple)] if contacts else []
    if contacts is None or not teeth:
        return contacts
    lever, own = contacts.lever.copy(), contacts.own.copy()
    families: list[Family] = []
    for f in contacts.rows.families:
        if not isinstance(f, ToothForce | ToothCouple):
            families.append(f)
            continue
        joints = contacts.rows.joint[f.row]
        out = [_numbers(layout, int(k)) for k in joints]
        fitted: Any = {name: np.array([numbers[name] for numbers in out]) for name in FITTED}
        f = replace(f, **fitted)
        families.append(f)
        first, second = (g[0] for g in gains(layout.algebra, f, pose.at(None)))
        for n, (row, k) in enumerate(zip(f.row, joints, strict=True)):
            skew = f.direction[n, 2] != 0
            name = list(m.joints)[k]
            if isinstance(f, ToothCouple):
                lever[row], own[row] = _levers(m, name, bool(skew), float(first[n]), float(second[n]))
            elif f.along[n, 0] and not skew:
                lever[row] = 0.0
    rows = replace(contacts.rows, families=tuple(families))
    return replace(contacts, rows=rows, lever=lever, own=own)


def _numbers(layout: Layout, joint: int) -> dict[str, Array]:
    """Numbers of the mesh of a joint."""
    for f in gearings(layout):
        places = np.flatnonzero(layout.constraints.joint[f.row] == joint)
        if places.size:
            return {name: getattr(f, name)[places[0]] for name in FITTED}
    raise AssertionError(joint)


def _levers(m: Mechanism, name: str, skew: bool, first: float, second: float) -> tuple[float, float]:
    """Strength of the couple of a mesh, and the part that it bears itself."""
    joint: Any = m.joints[name]
    if joint.efficiency is not None:
        if skew:
            what = f"gear {name!r}: teeth on skew axes slide, and their efficiency follows from it"
            raise ModelError(what, "write friction: {coefficient: 0.05}", ("joints", name, "efficiency"))
        return 2 / ((1 + float(joint.efficiency)) * abs(second - first)), (first + second) / 2
    if skew:
        return 0.0, 0.0
    if joint.friction.arm is None and joint.teeth is None:
        what = f"gear {name!r}: its friction needs the arm of the teeth's contact"
        raise ModelError(what, "give arm, or the size as teeth and module", ("joints", name, "friction"))
    return float(contact_arm(joint)), 0.0


def like_contacts(
    m: Mechanism, contacts: Contacts | None, known: Mechanism, fitted: Contacts | None
) -> Contacts | None:
    """Contacts on symbols with the places and levers that those of the description with numbers have."""
    if contacts is None or fitted is None:
        return contacts
    teeth: dict[type, Family] = {
        type(f): f for f in fitted.rows.families if isinstance(f, ToothForce | ToothCouple)
    }
    if not teeth:
        return contacts
    families = tuple(teeth.get(type(f), f) for f in contacts.rows.families)
    lever, own = contacts.lever.astype(object), contacts.own.copy()
    for f in teeth.values():
        for row in f.row:
            name = list(m.joints)[contacts.rows.joint[row]]
            now: Any = getattr(m.joints[name], "efficiency", None)
            then: Any = getattr(known.joints[name], "efficiency", None)
            share = (1 + then) / (1 + now) if now is not None and isinstance(f, ToothCouple) else 1.0
            lever[row], own[row] = fitted.lever[row] * share, fitted.own[row]
    return replace(contacts, rows=replace(contacts.rows, families=families), lever=lever, own=own)
