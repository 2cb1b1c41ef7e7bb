"""Brakes and clutches as rows and contacts: the normal pressure is one constraint, its friction one contact.

Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.arrays import Array, Numeric, Tree
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.layout import Distance
from dalembert.errors import ModelError
from dalembert.model import GROUND, Couple, Mechanism
from dalembert.model.joints.elements.brakes import Band, Shoe
from dalembert.model.joints.elements.clutches import Faces
from dalembert.model.quantities.values import Vector

if TYPE_CHECKING:
    from dalembert.analysis.compile.plane_rows import RowBuilder

ON_RIM = 1e-6
"""Part of the radius by which the point of a short shoe may be off the drum."""


class BrakePlace(NamedTuple):
    """Arms of a brake's points on i and j, and what its rows have beside: their kinds, the numbers of the normal row
    and of the row of its friction, none of faces on an axis; ``wrap`` of a band."""

    ui: Array
    uj: Array
    kinds: tuple[type, type] | None
    normal: Tree
    friction: Tree
    wrap: Numeric


class Seat(NamedTuple):
    """Closed position of a brake: the drum's axis, and points of j, in the axes of the link that both are pinned to."""

    carrier: str
    axis: Array
    hinge: Array
    turn: Numeric
    arm: Array

    def place(self, point: object) -> Array:
        """A point of j."""
        return np.asarray(self.hinge + plane.rotate(plane.rotation(np.asarray(self.turn)), point - self.arm))


def seat(m: Mechanism, name: str) -> Seat | None:
    """The seat of a brake at the angles of `assembly`, 0 where none is given; None where no link carries both."""
    joint = m.joints[name]
    (drum, pressed), (axis, _) = joint.links, m.joint_points(name)
    for carrier, on_drum, center in _hinges(m, drum):
        if not all(x is y or x == y for x, y in zip(on_drum, axis, strict=True)):
            continue
        if carrier == pressed:
            return Seat(carrier, np.asarray(center), np.zeros(2), 0.0, np.zeros(2))
        for link, on_pressed, hinge in _hinges(m, pressed):
            if link == carrier:
                turn = _angle(m, pressed) - _angle(m, carrier)
                return Seat(carrier, np.asarray(center), np.asarray(hinge), turn, np.asarray(on_pressed))
    return None


def _hinges(m: Mechanism, link: str) -> Iterator[tuple[str, Vector, Vector]]:
    """Links that a link is pinned to, with the pin's place on it and on them."""
    for name, joint in m.joints.items():
        if joint.hinge and link in joint.links:
            here = joint.links.index(link)
            at = m.joint_points(name)
            yield joint.links[1 - here], at[here], at[1 - here]


def _angle(m: Mechanism, link: str) -> Numeric:
    pose = m.assembly.get(link, 0.0)
    return pose[2] if isinstance(pose, tuple) else pose


def brake_place(
    m: Mechanism, name: str, index: Mapping[str, int], reference: Array, arms: tuple[Array, Array]
) -> BrakePlace:
    """The rows of a brake."""
    joint = m.joints[name]
    ui, uj = arms
    if isinstance(joint, Shoe):
        side = _side(m, name, joint)
        along, across = joint.load_direction(side)
        turned = -1.0 if joint.internal else 1.0
        friction = {"along": -turned * across, "across": turned * along, "couple": joint.friction_arm}
        if joint.end is None:  # its point stays on the rim
            return BrakePlace(ui, uj, (Distance, Lining), {"target": joint.radius}, friction, 0.0)
        return BrakePlace(
            ui, uj, (Lining, Lining), {"along": along, "across": across, "couple": 0.0}, friction, 0.0
        )
    if not isinstance(joint, Band):
        return BrakePlace(ui, uj, None, {}, {}, 0.0)
    ends = [end.split(".") for end in joint.ends]
    links = [index[link] for link, _ in ends]
    arms_ = [np.subtract(m.point(*end), reference[k]) for end, k in zip(ends, links, strict=True)]
    drawn: Tree = {
        "end_a": links[0],
        "end_b": links[1],
        "ua": arms_[0],
        "ub": arms_[1],
        "radius": joint.radius,
        "axis": np.zeros(2),
    }
    drawn["parallel"] = float(joint.wound is not None)
    normal, friction = {"first": 1.0, "last": 1.0} | drawn, {"first": 0.5, "last": -0.5} | drawn
    return BrakePlace(ui, uj, (BandStrands, BandStrands), normal, friction, _wrap(m, name, joint))


def _side(m: Mechanism, name: str, joint: Shoe) -> float:
    """1 where the lining lies left of the line from the drum's axis to j's point, else -1."""
    at, link = seat(m, name), joint.links[1]
    if at is not None:
        own = at.place(m.joint_points(name)[1]) - at.axis
        _check_distance(name, joint, own)
    if joint.end is None or joint.side is not None:
        return -1.0 if joint.side == "right" else 1.0
    for point in m.points(link).values():
        if at is not None:
            x, y = at.place(point) - at.axis
            off, least = own[0] * y - own[1] * x, ON_RIM * (own @ own)
            if off > least or off < -least:
                return 1.0 if off > 0 else -1.0
    what = f"joint {name!r}: on which side of its point the lining lies is not clear"
    raise ModelError(what, "write side: left or side: right", ("joints", name))


def _check_distance(name: str, joint: Shoe, own: Array) -> None:
    """Refuse a short shoe whose point is off the rim, and an external one that is pinned inside the drum."""
    square, rim = own @ own, joint.radius * joint.radius
    if joint.end is None and not (rim * (1 - 2 * ON_RIM) <= square <= rim * (1 + 2 * ON_RIM)):
        what = f"joint {name!r}: its point is {_shown(square)} from the drum's axis and the drum's radius {_shown(rim)}"
        raise ModelError(what, "place it on the rim", ("joints", name))
    if joint.end is not None and joint.pressure == "pinned" and not joint.internal and square <= rim:
        what = f"joint {name!r}: its pin is {_shown(square)} from the drum's axis, inside the drum of {_shown(rim)}"
        raise ModelError(what, "move it out, or write internal: true", ("joints", name))


def _shown(square: Numeric) -> str:
    return f"{math.sqrt(float(square)):.6g} m"


def _wrap(m: Mechanism, name: str, joint: Band) -> Numeric:
    """Angle of the band on the drum, over sin(groove/2)."""
    grip = 1.0 if joint.groove is None else np.sin(joint.groove / 2)
    at = seat(m, name)
    if joint.wound is not None:
        return joint.wound / grip
    on_ground = any(end.split(".")[0] == GROUND for end in joint.ends)
    if at is None or (on_ground and at.carrier != GROUND):
        what = f"joint {name!r}: the angle of the band on the drum is not clear"
        raise ModelError(what, "write wrap: 270 deg", ("joints", name))
    ends = []
    for end in joint.ends:
        link, point = end.split(".")
        ends.append(m.point(link, point) if link == GROUND else at.place(np.asarray(m.point(link, point))))
    away = [np.asarray(at.axis - e) for e in ends]
    angles = []
    for d, s in zip(away, (1.0, -1.0), strict=True):
        square = d @ d
        if square <= joint.radius * joint.radius:
            what = f"joint {name!r}: an end of the band is inside the drum"
            raise ModelError(what, "move it out", ("joints", name, "ends"))
        free = np.sqrt(square - joint.radius * joint.radius)
        angles.append(_turn(d[1], d[0]) + s * _turn(joint.radius, free))
    turned = angles[0] - angles[1] - math.pi
    while turned < 0:
        turned = turned + 2 * math.pi
    while turned >= 2 * math.pi:
        turned = turned - 2 * math.pi
    return turned / grip


def _turn(y: Numeric, x: Numeric) -> Numeric:
    """Angle of a vector, of numbers or symbols."""
    return np.arctan2(y + 0.0 * x, x + 0.0 * y)


def add_brake(rows: RowBuilder, index: int, ends: tuple[int, int], place: BrakePlace) -> None:
    """The row of the normal pressure, or of the band's tension; none of faces on an axis."""
    if place.kinds is not None:
        rows.add(place.kinds[0], index, ends, ui=place.ui, uj=place.uj, **place.normal)


def with_unknown_clamps(m: Mechanism) -> Mechanism:
    """The mechanism with an unknown couple, of the brake's name, instead of each pair of faces of unknown force.

    The couple of faces does not depend on other reactions, so it is solved without friction, and gives the force.
    """
    out: dict[str, Couple] = {}
    for name, joint in m.joints.items():
        if isinstance(joint, Faces) and joint.clamped is None:
            first, second = joint.links
            if GROUND not in joint.links:
                what = f"joint {name!r} has an unknown force between two links that both move"
                raise ModelError(what, "give its force and leave a torque unknown", ("joints", name, "force"))
            if joint.friction is None:
                what = f"joint {name!r} has an unknown force and no friction"
                raise ModelError(what, "give it friction: {coefficient: 0.3}", ("joints", name))
            if name not in m.loads:
                out[name] = Couple(on=second if first == GROUND else first, by=GROUND, value="unknown")
    return m.model_copy(update={"loads": {**m.loads, **out}}) if out else m
