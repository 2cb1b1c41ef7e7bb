"""Couple of a one-way clutch or a ratchet, and the forces at its rollers or its pawl.

Mechanics: docs/theory.md 10.13.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.units import quantity
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NAN = float("nan")


@dataclass(frozen=True, eq=False)
class OneWayAnswer(Compared):
    """A one-way clutch or a ratchet along a result, arrays (P,) in SI; NaN what its description does not give.

    couple: on j, N m, in the free sense, 0 where it freewheels; roller_force: normal force of a roller at the ring,
    couple/(n R tan(wedge/2)); least_coefficient: tan(wedge/2), from which on the rollers grip, and whether they do
    (``grips``); pawl_force: couple/(R cos(angle)); friction_angle: greatest angle off the flank's normal at which the
    pawl stays in; pitch: of the teeth, the greatest lost motion, rad.
    """

    name: str
    couple: Array = field(repr=False)
    roller_force: Array = field(repr=False)
    least_coefficient: float
    grips: bool
    pawl_force: Array = field(repr=False)
    friction_angle: float
    pitch: float
    per_force: float = field(repr=False, default=NAN)

    def torque_for(self, force: float | str) -> float:
        """Couple, N m, of the clutch at a force of each roller, N."""
        return self.per_force * (quantity(force, "force", None) if isinstance(force, str) else force)


def one_way(r: Result, name: str) -> OneWayAnswer:
    """Couple and inner forces of a one-way clutch or a ratchet; raises ModelError for another joint.

    >>> import dalembert as da
    >>> links = {name: {"points": {"O": [0, 0]}} for name in ("ground", "one", "two")}
    >>> pins = {n: {"type": "pin", "links": ["ground", k], "at": "O"} for n, k in (("A", "one"), ("B", "two"))}
    >>> clutch = {"type": "one_way", "links": ["one", "two"], "at": "O", "free": "ccw"}
    >>> load = {"type": "couple", "on": "two", "value": -120}
    >>> m = {"links": links, "joints": pins | {"K": clutch}, "drives": {"A": {"position": 0}}, "loads": {"T": load}}
    >>> da.statics(da.mechanism(m)).one_way("K").couple
    array([120.])
    """
    joints = {n: j for n, j in r.mechanism.joints.items() if hasattr(j, "RELEASED")}
    if name not in joints:
        what = f"joint {name!r} is neither a one-way clutch nor a ratchet"
        raise ModelError(what, closest(name, list(joints)) if joints else "write type: one_way")
    joint: Any = joints[name]
    couple = joint.way * r.reaction_moment(name)
    rollers, pawl = getattr(joint, "rollers", None), getattr(joint, "pawl", None)
    per = rollers.count * rollers.radius * rollers.least_coefficient if rollers else NAN
    return OneWayAnswer(
        name,
        couple,
        couple / per,
        rollers.least_coefficient if rollers else NAN,
        bool(rollers is None or rollers.coefficient >= rollers.least_coefficient),
        couple / (pawl.radius * math.cos(pawl.angle)) if pawl else np.full(len(couple), NAN),
        math.atan(pawl.coefficient) if pawl else NAN,
        joint.pitch,
        per,
    )
