"""The numbers of a cam: its follower on the link that carries both, and its lift as a table of pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.elements.profile_tables import CURVES, in_mm, lift_table
from dalembert.arrays import Array, Numeric
from dalembert.core.elements.cam_curves import arctan2
from dalembert.core.elements.cam_family import FLAT, FLAT_SWINGS, SLIDES, SWINGS
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.joints.elements.cams import Cam


@dataclass(frozen=True)
class CamCarrier:
    """The link that carries both a cam and its follower, and the follower on it.

    In the carrier's axes from the cam's axis: at (2,) the follower's point at freedom 0 of a slide, and ``way`` (2,) in
    which it slides out as its freedom grows by ``sign``; of one that swings, ``at`` is its axis, and ``arm`` (2,) goes
    from there to its point in its own axes. turn: the follower's angle on the carrier at rest; freedom: its joint;
    pin: the cam's; up: 1 where its freedom grows as it goes out, else -1.
    """

    link: str
    pin: str
    freedom: str
    swings: bool
    at: Array
    way: Array
    sign: float
    turn: Numeric = 0.0
    arm: Array = field(default_factory=lambda: np.zeros(2))
    up: float = 1.0


@dataclass(frozen=True)
class CamShape:
    """The numbers of a row ``CamRow``; carrier: None where none is; joins: angles at which pieces join."""

    form: int
    normal: Array
    sense: float
    base: Numeric
    a: Numeric
    b: Numeric
    gamma: Numeric
    sigma: float
    curve: Array
    carrier: CamCarrier | None

    @property
    def numbers(self) -> dict[str, object]:
        """By the names of the row's fields."""
        names = ("form", "normal", "sense", "base", "a", "b", "gamma", "sigma", "curve")
        return {name: getattr(self, name) for name in names}


def cam_shape(m: Mechanism, name: str) -> CamShape:
    """The numbers of a cam; raises ModelError where its follower cannot be on it."""
    joint: Any = m.joints[name]
    assert isinstance(joint, Cam)
    form = joint.profile.form
    carrier = _carrier(m, name, joint)
    if form == "segments":
        shape = _by_lift(m, name, joint, carrier)
        return replace(shape, gamma=shape.gamma - joint.profile.start)
    kind = FLAT if joint.flat else SLIDES
    normal = _face_normal(name, joint, carrier) if joint.flat else np.zeros(2)
    turned = arctan2(normal[1], normal[0]) if joint.flat else 0.0
    zero = 0.0
    if joint.profile.tangent is not None:  # its flank begins at the follower
        zero = (
            _ahead(carrier)
            - joint.profile.start
            - (-1 if joint.profile.sense == "cw" else 1) * joint.profile.tangent.half_angle
        )
    table = CURVES[form](joint, name, zero)
    return CamShape(kind, normal, -1.0, 0.0, 1.0 if joint.flat else 0.0, 1.0, -turned, 1.0, table, carrier)


def _ahead(carrier: CamCarrier | None) -> Numeric:
    """Direction of the follower's point from the cam's axis."""
    if carrier is None:
        return 0.0
    along = carrier.at if carrier.swings else carrier.way
    return arctan2(along[1], along[0])


# the follower on the carrier


def _carrier(m: Mechanism, name: str, joint: Cam) -> CamCarrier | None:
    """The first link that the cam is pinned to, and on which the follower slides or swings."""
    cam, follower = joint.links
    pins = {_other(j.links, cam): n for n, j in m.joints.items() if j.hinge and cam in j.links}
    for freedom, guide in m.joints.items():
        if follower not in guide.links or not (guide.hinge or guide.guides):
            continue
        link = _other(guide.links, follower)
        pin = pins.get(link)
        if pin is not None and link != cam and pin != freedom:
            return _on_carrier(m, name, joint, link, pin, freedom)
    return None


def _other(links: tuple[str, str], one: str) -> str:
    return links[1] if links[0] == one else links[0]


def _ends(m: Mechanism, joint: str, link: str) -> tuple[Array, Array]:
    """Points of a joint on a link, and on its other link."""
    at = [np.array(u) for u in m.joint_points(joint)]
    return (at[0], at[1]) if m.joints[joint].links[0] == link else (at[1], at[0])


def _on_carrier(m: Mechanism, name: str, joint: Cam, link: str, pin: str, freedom: str) -> CamCarrier:
    axis, center = _ends(m, pin, link)
    guide: Any = m.joints[freedom]
    near, far = _ends(m, freedom, link)
    point = np.array(m.joint_points(name)[1])
    first = guide.links[0] == link
    if joint.profile.form == "segments" and _differ(center, np.array(m.joint_points(name)[0])):
        raise ModelError(
            f"cam {name!r}: its point is not where the cam turns, at joint {pin!r}",
            f"name the cam's point of joint {pin!r} in at",
            ("joints", name),
        )
    lift = joint.profile.segments
    up = 1.0 if lift is None else lift.sign
    if guide.hinge:
        if lift is not None and lift.kind == "length" and any(lift.targets):
            raise ModelError(
                f"cam {name!r}: its lift is a length, and its follower swings in joint {freedom!r}",
                "write lifts as angles, with their unit: {to: 20 deg, ...}",
                ("joints", name, "profile", "segments"),
            )
        onto = 1.0 if first else -1.0
        sign = up * onto if lift else _side_of_lever(m, joint, link, axis - near, point - far, onto)
        at, arm = near - axis, point - far
        return CamCarrier(link, pin, freedom, True, at, np.zeros(2), sign, 0.0, arm, sign * onto)
    if lift is not None and lift.kind == "angle":
        raise ModelError(
            f"cam {name!r}: its lift is an angle, and its follower slides in joint {freedom!r}",
            "write lifts as lengths: {to: 25 mm, ...}",
            ("joints", name, "profile", "segments"),
        )
    fixed = guide.direction + guide.angle
    turn = fixed if first else -fixed
    along = guide.direction if first else -guide.angle + math.pi
    slide, at = np.array([np.cos(along), np.sin(along)]), near - axis + _turned(point - far, turn)
    if lift is None:
        up = _side_of_stem(m, joint, link, axis, point, at, slide)
    return CamCarrier(link, pin, freedom, False, at, up * slide, up, turn, up=up)


# a follower on a cam given by its form touches it on either side: on the one on which the file assembles it


def _side_of_lever(m: Mechanism, joint: Cam, link: str, cam: Array, arm: Array, default: float) -> float:
    """1 where the assembled lever goes out as it turns counter-clockwise, else -1; the default of one not assembled."""
    follower = joint.links[1]
    u = _turned(arm, _assembled(m, follower)[2] - _assembled(m, link)[2])
    if joint.flat or follower not in m.assembly or object in (cam.dtype, u.dtype):
        return default
    return -1.0 if cam[0] * u[1] < cam[1] * u[0] else 1.0


def _side_of_stem(
    m: Mechanism, joint: Cam, link: str, axis: Array, point: Array, at: Array, slide: Array
) -> float:
    """1 where the assembled stem goes out as it slides along ``slide``, else -1; 1 of one not assembled."""
    follower = joint.links[1]
    if joint.flat or follower not in m.assembly or object in (axis.dtype, at.dtype, slide.dtype):
        return 1.0
    x, y, angle = _assembled(m, follower)
    if isinstance(m.assembly[follower], tuple) and link == "ground":
        at = np.array([x, y]) + _turned(point, angle) - axis
    return -1.0 if at @ slide < 0 else 1.0


def _assembled(m: Mechanism, link: str) -> tuple[Any, Any, Any]:
    """Pose of a link at which the file assembles it, 0 where it gives none."""
    pose = m.assembly.get(link, 0.0)
    return pose if isinstance(pose, tuple) else (0.0, 0.0, pose)


def _differ(a: Array, b: Array) -> bool:
    return a.dtype != object and b.dtype != object and math.dist(a, b) > 1e-9 * (1 + float(np.abs(a).max()))


def _turned(u: Array, angle: Numeric) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * u[0] - s * u[1], s * u[0] + c * u[1]])


def _face_normal(name: str, joint: Cam, carrier: CamCarrier | None) -> Array:
    """Unit normal of a face in the follower's axes, away from the cam."""
    if carrier is None:
        if joint.face is None:
            raise ModelError(
                f"cam {name!r}: no link carries both cam and follower, which would give the direction of the face",
                "write face: its direction in the follower's axes, the cam on its right",
                ("joints", name),
            )
        return np.array([-np.sin(joint.face), np.cos(joint.face)])
    outward = carrier.sign * np.array([-carrier.arm[1], carrier.arm[0]])
    if not carrier.swings:
        outward = _turned(carrier.way, -carrier.turn)
    if joint.face is None:
        size = np.sqrt(outward[0] * outward[0] + outward[1] * outward[1])
        if not isinstance(size, float) or size > 0:
            return np.asarray(outward / size)
        what = f"cam {name!r}: the face passes through the follower's axis, and its direction is not given"
        raise ModelError(what, "write face: its direction in the follower's axes", ("joints", name))
    face = np.array([-np.sin(joint.face), np.cos(joint.face)])
    along = face[0] * outward[0] + face[1] * outward[1]
    if isinstance(along, float) and abs(along) < 1e-6:
        what = f"cam {name!r}: the face is along the motion of the follower, which does not lift it"
        raise ModelError(what, "turn the face", ("joints", name, "face"))
    return np.asarray(face * (along / np.sqrt(along * along)))


# profiles by the lift


def _by_lift(m: Mechanism, name: str, joint: Cam, carrier: CamCarrier | None) -> CamShape:
    lift, profile = joint.profile.segments, joint.profile
    assert lift is not None
    if carrier is None:
        raise ModelError(
            f"cam {name!r}: its profile is a lift, and no link carries both cam and follower",
            "pin the cam to a link, and let the follower slide or swing on the same one; or give the profile as "
            "eccentric, arcs or points",
            ("joints", name),
        )
    sense = -1.0 if profile.sense == "cw" else 1.0
    table = lift_table(lift.programme.curve, lift.sign)
    least = profile.prime if profile.prime is not None else profile.base + joint.follower.roller  # type: ignore[operator]
    if joint.flat:
        return _flat(name, joint, carrier, sense, table, least)
    if carrier.swings:
        far, arm = (np.sqrt(u[0] * u[0] + u[1] * u[1]) for u in (carrier.at, carrier.arm))
        _reaches(name, least, far, arm)
        c = (arm * arm + far * far - least * least) / (2 * arm * far)
        base = math.acos(c) if isinstance(c, float) else np.arctan2(np.sqrt(1 - c * c), c)
        gamma = np.arctan2(carrier.at[1], carrier.at[0])
        return CamShape(SWINGS, np.zeros(2), sense, base, arm, far, gamma, carrier.sign, table, carrier)
    way = carrier.way
    aside = way[1] * carrier.at[0] - way[0] * carrier.at[1]
    if isinstance(aside, float) and isinstance(least, float) and abs(aside) >= least:
        raise ModelError(
            f"cam {name!r}: the offset is {in_mm(abs(aside))}, and the radius at lift 0 {in_mm(least)}",
            "make the base circle larger than the offset",
            ("joints", name, "profile"),
        )
    base = np.sqrt(least * least - aside * aside)
    gamma = np.arctan2(way[1], way[0])
    return CamShape(SLIDES, np.zeros(2), sense, base, aside, 1.0, gamma, 1.0, table, carrier)


def _reaches(name: str, least: Numeric, far: Numeric, arm: Numeric) -> None:
    sizes = (least, far, arm)
    if all(isinstance(x, float) for x in sizes) and not abs(far - arm) < least < far + arm:
        raise ModelError(
            f"cam {name!r}: an arm of {in_mm(arm)} about an axis {in_mm(far)} away does not reach a radius of "
            f"{in_mm(least)}",
            f"take an arm between {in_mm(abs(far - least))} and {in_mm(far + least)}",
            ("joints", name, "profile"),
        )


def _flat(name: str, joint: Cam, carrier: CamCarrier, sense: float, table: Array, least: Numeric) -> CamShape:
    normal = _face_normal(name, joint, carrier)
    turned = np.arctan2(normal[1], normal[0])
    if not carrier.swings:
        n = _turned(normal, carrier.turn)
        cosine = n[0] * carrier.way[0] + n[1] * carrier.way[1]
        return CamShape(FLAT, normal, sense, least / cosine, cosine, 1.0, carrier.turn, 1.0, table, carrier)
    height = normal[0] * carrier.arm[0] + normal[1] * carrier.arm[1]
    far = np.sqrt(carrier.at[0] * carrier.at[0] + carrier.at[1] * carrier.at[1])
    c = (least - height) / far
    if isinstance(c, float) and abs(c) >= 1:
        raise ModelError(
            f"cam {name!r}: its face does not touch a base circle of {in_mm(least)} in any position",
            f"take a radius between {in_mm(max(height - far, 0.0))} and {in_mm(height + far)}",
            ("joints", name, "profile", "base"),
        )
    base = -(math.acos(c) if isinstance(c, float) else np.arctan2(np.sqrt(1 - c * c), c))
    gamma = np.arctan2(carrier.at[1], carrier.at[0]) - turned
    return CamShape(FLAT_SWINGS, normal, sense, base, height, far, gamma, carrier.sign, table, carrier)
