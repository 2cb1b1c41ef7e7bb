"""Quantities by name along a motion, for conditions: normal forces and gaps of contacts, energy, time, reactions.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.named_quantities import quantity
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.occurrences import Value
from dalembert.machine.motion.rest.standstill import at_state
from dalembert.machine.motion.stops.contact_answer import OpenedMotion
from dalembert.machine.motion.stops.gap_contacts import GapContact, added_drives
from dalembert.machine.motion.stops.touching import TouchState
from dalembert.model import Mechanism, Schedule
from dalembert.wording import closest

FORCES = ("normal", "force")
OWN = {"time": "time", "energy.kinetic": "energy"}
"""Names of what no analysis is needed for, with their kinds."""


def named_contacts(contacts: Sequence[GapContact], name: str) -> list[GapContact]:
    """The contacts of a name `normal.NAME`, `force.NAME` or `gap.NAME`: of a guide's joint, both its ends."""
    word, _, of = name.partition(".")
    if word in (*FORCES, "gap"):
        return [c for c in contacts if c.name == of] or [
            c for c in contacts if c.joint == of and word != "gap"
        ]
    return []


def watched_kind(m: Mechanism, acting: Actuation, name: str) -> str:
    """Kind of a quantity that a condition names; raises ModelError for one that does not exist."""
    if named_contacts(acting.contacts, name):
        return "length" if name.startswith("gap.") else "force"
    if name in OWN:
        return OWN[name]
    if name.partition(".")[0] in (*FORCES, "gap"):
        known = [c.name for c in acting.contacts]
        what = f"{name!r} names no contact that only pushes or pulls"
        raise ModelError(what, closest(name.partition(".")[2], known) if known else "write contact: pushes")
    at, none = acting.position[None], np.zeros((1, len(acting.position)))
    start = at_schedule(m, Schedule(tuple(m.drives), at, none, none, np.zeros(1)), inertia=True)
    found = quantity(start, name)
    if found.values.ndim > 1:
        raise ModelError(
            f"{name} is a vector; a condition needs a number", f"write {name}.x or {name}.magnitude"
        )
    return found.kind


def watched(state: TouchState, name: str) -> Value:
    """The quantity as a function of time and state."""
    contacts, d = named_contacts(state.acting.contacts, name), state.d
    if contacts and name.startswith("gap."):
        return lambda t, y: (
            contacts[0].side * (state.motion_of(state.gap_stops[contacts[0]], t, y)[0] - contacts[0].at)
        )
    if contacts:
        return lambda t, y: sum(state.contact_force(c, t, y) * state.normal_size(c, t, y) for c in contacts)
    if name == "time":
        return lambda t, y: t
    if name == "energy.kinetic":
        return lambda t, y: _kinetic(state, t, y[:d], y[d : 2 * d])
    return lambda t, y: _analysed(state, name, t, y)


def _kinetic(state: TouchState, t: float, q: Array, u: Array) -> float:
    return float(u @ state.equation(t, q, u).mass @ u / 2)


def _analysed(state: TouchState, name: str, t: float, y: Array) -> float:
    """A quantity of the analysis at a state."""
    d, acting = state.d, state.acting
    q, u, a = y[:d], y[d : 2 * d], state.at(t, y)[0]
    r = at_state(state.m, acting.position, t, q, u, a)
    if acting.contacts:
        s, count = r.compiled.schedule, state.d - added_drives(acting.contacts)
        own = Schedule(
            s.names[:count], s.position[:, :count], s.speed[:, :count], s.acceleration[:, :count], s.time
        )
        stops = {
            c.name: np.full(2, c.side * state.contact_force(c, t, y)) for c in acting.contacts if c.drive < 0
        }
        m = state.m.model_copy(update={"drives": dict(list(state.m.drives.items())[:count])})
        r = OpenedMotion(state.m, s, acting.contacts).of_description(r, m, own, r.effort_array, stops)
    return float(quantity(r, name).values[1])
