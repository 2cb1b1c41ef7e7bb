"""Brakes and clutches of a result: torque, force, pressure, how far friction helps itself, from what mu on it grabs.

Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.contacts import coefficient, resting_coefficient
from dalembert.analysis.friction.self_help import self_help
from dalembert.analysis.methods.applied_forces import link_speed
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.model.joints.elements.brakes import OnDrum, Shoe
from dalembert.model.joints.elements.clutches import Cone, Disc, Faces
from dalembert.units import quantity
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True, eq=False)
class Brake(Compared):
    """A brake or clutch at every position (P,), SI; NaN at positions without an answer.

    torque: size of the couple of friction about the drum's axis, N m; force: normal force of a shoe, mean tension of a
    band, force that presses faces together, N; pressure: greatest on the lining, Pa, NaN without its size; pv: the
    greatest pressure times speed, W/m2; slip: rate of j against i, rad/s
    self_energising: force over the force that the same load would give without friction at this contact, 1 where
    friction does not act on it; locking_coefficient: from this coefficient on it grabs at the present forces, inf
    where it never does
    """

    joint: str
    torque: Array = field(repr=False)
    force: Array = field(repr=False)
    pressure: Array = field(repr=False)
    pv: Array = field(repr=False)
    slip: Array = field(repr=False)
    self_energising: Array = field(repr=False)
    locking_coefficient: float
    coefficient: float


@dataclass(frozen=True, eq=False)
class ShoeBrake(Brake):
    """A shoe; normal_moment, friction_moment (P,): moments of its normal and friction forces about its pivot, as
    magnitudes, N m; ``place``: angle of the greatest pressure from the line from drum axis to pivot, rad."""

    normal_moment: Array = field(repr=False)
    friction_moment: Array = field(repr=False)
    place: float = math.nan


@dataclass(frozen=True, eq=False)
class BandBrake(Brake):
    """A band; tight, slack (P,): its tensions, N; ratio (P,) of them; ``wrap``: its angle on the drum, rad."""

    tight: Array = field(repr=False)
    slack: Array = field(repr=False)
    ratio: Array = field(repr=False)
    wrap: float = math.nan


@dataclass(frozen=True, eq=False)
class FaceBrake(Brake):
    """Discs or a cone; friction_radius, m: couple of a face over mu times its force; force_radius, m: where the force
    of a pad acts, 0 for a complete ring; oil (P,): pressure in its cylinder, Pa; push_in, draw_off (P,): forces to
    move a cone in without slip and off again, N, NaN of discs."""

    friction_radius: float
    force_radius: float
    oil: Array = field(repr=False)
    push_in: Array = field(repr=False)
    draw_off: Array = field(repr=False)
    of: Faces = field(repr=False, compare=False)

    def force_for(self, pressure: float | str) -> float:
        """Force at which the greatest pressure is this one, N; a number in Pa, or a text with its unit."""
        return float(quantity(pressure, "pressure", None) * self.of.force_area)

    def torque_for(self, pressure: float | str) -> float:
        """Couple while slipping at this greatest pressure, N m."""
        return self.force_for(pressure) * self.coefficient * float(self.of.lever)


def brake(r: Result, joint: str) -> Any:
    """A brake or clutch of a result; also a slot with friction, whose block rubs.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "disc": {"points": {"O": [0, 0]}}}
    >>> pads = {"type": "disc", "links": ["ground", "disc"], "at": "O", "radii": [0.05, 0.1], "faces": 2}
    >>> joints = {"O": {"type": "pin", "links": ["ground", "disc"]}}
    >>> joints["pads"] = pads | {"force": "unknown", "friction": {"coefficient": 0.4}}
    >>> drives = {"O": {"position": 0, "speed": "10 rad/s", "effort": 120}}
    >>> r = da.statics(da.mechanism({"links": links, "joints": joints, "drives": drives}))
    >>> r.brake("pads").force
    array([2000.])
    """
    if joint not in r.joints:
        raise ModelError(f"unknown joint {joint!r}", closest(joint, list(r.joints)))
    described: Any = r.mechanism.joints[joint]
    if not (described.BRAKES or described.freedoms == ("slide", "turn")):
        rubbing = [name for name, part in r.mechanism.joints.items() if part.BRAKES]
        what = f"joint {joint!r} is a {described.type}, not a brake or clutch"
        raise ModelError(
            what, f"choose among {', '.join(rubbing)}" if rubbing else "add a shoe, band or disc"
        )
    if isinstance(described, Faces):
        return _faces(r, joint, described)
    return _pressed(r, joint, described)


def _slip(r: Result, joint: str) -> Array:
    i, j = r.mechanism.joints[joint].links
    return np.asarray(link_speed(r, j) - link_speed(r, i))


def _faces(r: Result, joint: str, part: Faces) -> FaceBrake:
    """Discs and cones: the torque is the friction's, or with an unknown force the given one's."""
    slip = _slip(r, joint)
    mu = float(coefficient(r.mechanism, part)) if part.friction else 0.0
    at_rest = float(resting_coefficient(r.mechanism, part)) if part.friction else 0.0
    if part.clamped is None and joint in r.unknown_loads:
        torque = np.abs(r.unknown_load(joint))
        force = torque / (np.where(slip == 0, at_rest, mu) * float(part.lever))
    else:
        torque = np.abs(r.friction_moment(joint))
        force = np.where(np.isnan(torque), np.nan, float(part.clamped or math.nan))
    pressure = force / float(part.force_area)
    fast = part.edges[0] if part.law == "wear" else part.edges[1]
    cone = part if isinstance(part, Cone) else None
    none = np.full_like(force, np.nan)
    return FaceBrake(
        joint=joint,
        torque=torque,
        force=force,
        pressure=pressure,
        pv=pressure * np.abs(slip) * float(fast),
        slip=slip,
        self_energising=np.ones_like(force),
        locking_coefficient=math.inf,
        coefficient=mu,
        friction_radius=float(part.friction_radius),
        force_radius=float(part.force_radius) if isinstance(part, Disc) else 0.0,
        oil=force / float(part.cylinder.area) if part.cylinder else none,
        push_in=force * cone.push_in if cone else none,
        draw_off=force * cone.draw_off if cone else none,
        of=part,
    )


def _pressed(r: Result, joint: str, part: Any) -> Brake:
    """Shoes, bands and slots: their normal force is a reaction."""
    slip = _slip(r, joint)
    count, none = len(r.status), np.full(len(r.status), np.nan)
    contacts = r.compiled.contacts
    k = r.joints.index(joint)
    mine = (
        []
        if contacts is None
        else [e for e in np.flatnonzero(contacts.joint == k) if contacts.kind[e] != "pin"]
    )
    if contacts is None or not mine or r.friction is None:
        raise ModelError(
            f"joint {joint!r} has no friction here", "give it friction: {coefficient: 0.3}", ("joints", joint)
        )
    e = int(mine[0])
    normal = np.abs(r.friction.argument[:, 0, e])
    rubbing = np.abs(r.friction.cz[:, e])
    helped, locking = self_help(r, e)
    radius = float(getattr(part, "radius", None) or math.nan)
    common: Tree = {
        "joint": joint,
        "slip": slip,
        "self_energising": helped,
        "locking_coefficient": locking,
        "coefficient": float(contacts.coefficient[e]),
    }
    if isinstance(part, Shoe):
        pressure = normal / part.area
        friction, total = r.friction_moment(joint), r.reaction_moment(joint)
        return ShoeBrake(
            **common,
            torque=rubbing * float(part.friction_arm),
            force=normal,
            pressure=pressure,
            pv=pressure * np.abs(slip) * radius,
            normal_moment=np.abs(total - friction),
            friction_moment=np.abs(friction),
            place=_peak(part),
        )
    if isinstance(part, OnDrum):
        tight, slack = normal + rubbing / 2, normal - rubbing / 2
        pressure = tight / (part.width * radius) if part.width else none
        wrap = float(contacts.wrap[e]) * (1.0 if part.groove is None else math.sin(part.groove / 2))  # type: ignore[attr-defined]
        return BandBrake(
            **common,
            torque=rubbing * radius,
            force=normal,
            pressure=pressure,
            pv=pressure * np.abs(slip) * radius,
            tight=tight,
            slack=slack,
            ratio=tight / slack,
            wrap=wrap,
        )
    return Brake(**common, torque=np.full(count, np.nan), force=normal, pressure=none, pv=none)


def _peak(part: Shoe) -> float:
    """Angle of the greatest pressure."""
    if part.end is None:
        return math.nan
    if part.pressure == "cosine":
        return float(part.middle)
    ends = (part.begin, part.end)
    return math.pi / 2 if ends[0] <= math.pi / 2 <= ends[1] else max(ends, key=math.sin)
