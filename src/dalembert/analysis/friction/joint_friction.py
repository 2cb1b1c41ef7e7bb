"""Friction in each joint, read from a result: forces, losses, contact of guides, sizes of circles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.compile.contacts import circle
from dalembert.analysis.plane_only import refuse_space
from dalembert.arrays import Array
from dalembert.core.friction.contact_equations import Contacts, bearing, strength
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.force_arrays import Friction
    from dalembert.analysis.result.result import Result

Loss = Literal["dry", "viscous", "all"]


def assumption(result: Result) -> str:
    """Description of the friction: on or off, and the kind of pin circles: 'on, friction circles of R sin(phi)'."""
    m = result.mechanism
    if result.friction is None:
        keys = ("friction", "efficiency")
        has_friction = any(getattr(j, key, None) is not None for j in m.joints.values() for key in keys)
        if has_friction and not m.friction.enabled:
            return "off (switched off)"
        rubbing = [name for name, drive in m.drives.items() if drive.screw and drive.screw.friction]
        return f"off in the joints, on in the screw of {', '.join(rubbing)}" if rubbing else "off"
    circles: dict[str, list[str]] = {}
    for name, joint in m.joints.items():
        f = getattr(joint, "friction", None)
        if getattr(f, "radius", None):
            circles.setdefault("R sin(phi)" if circle(m, joint) == "sin" else "mu R", []).append(name)
    if len(circles) == 1:
        return f"on, friction circles of {next(iter(circles))}"
    parts = [f"of {kind} in {', '.join(names)}" for kind, names in circles.items()]
    return ", ".join(["on", *(["friction circles " + " and ".join(parts)] if parts else [])])


def interval(result: Result, name: str) -> Array:
    """Low and high end (P, 2) of an effort or unknown load; equal where it is a number."""
    unknowns = unknown_names(result)
    if name not in unknowns:
        raise ModelError(
            f"{name!r} is not an unknown effort or load",
            f"the unknowns are {', '.join(unknowns)}",
        )

    def value(r: Result) -> Array:
        return r.effort(name) if name in r.drives else r.unknown_load(name)

    both = np.stack(result.span(value), axis=-1)
    if not result.ends:
        return both
    ends = np.stack([value(end) for end in result.ends[unknowns.index(name)]], axis=-1)
    return np.where(result.reverses[:, None], both, ends)


def holding(result: Result, name: str) -> Array:
    """Low and high (P, 2) that friction can hold at rest for some history; the interval where it is a number."""
    ends = interval(result, name)
    if result.friction is None:
        return ends
    still = np.array([status == "at_rest" for status in result.status])
    return np.where(still[:, None], result.friction.holding[:, unknown_names(result).index(name)], ends)


def holds_beyond(ends: Array, held: Array) -> Array:
    """True where low and high (..., 2) of the range that friction can hold lie beyond those at which motion impends."""
    known = np.where(np.isnan(ends), [-np.inf, np.inf], ends)
    return np.asarray((held[..., 0] < known[..., 0]) | (held[..., 1] > known[..., 1]))


NO_END = "no value is large enough to move the mechanism in this sense"
"""Of an end of an interval that is none."""


def unknown_names(result: Result) -> list[str]:
    """Unknown efforts and loads, in the order of ``result.ends``."""
    requested = result.compiled.known.requested
    return [*(d for d, a in zip(result.drives, requested, strict=True) if a), *result.unknown_loads]


def joints_at_limit(result: Result, position: int = 0) -> tuple[str, ...]:
    """Joints whose friction is at its limit at one end of an interval: ask it of ``result.ends``."""
    f, contacts = friction_of(result)
    at_limit = (f.sense[position] != 0) & ~contacts.fixed
    return tuple(dict.fromkeys(result.joints[k] for k in contacts.joint[at_limit]))


def reversing_joints(result: Result, position: int) -> tuple[str, ...]:
    """Joints whose contacts reverse at a position; where accelerations jump the drives whose law does it, or cams."""
    if result.status[position] == "jump":
        led = zip(result.drives, result.schedule.jumps[position], strict=True)
        drives = tuple(name for name, jumps in led if jumps)
        return drives or tuple(n for n, joint in result.mechanism.joints.items() if joint.outlined)
    f, contacts = friction_of(result)
    return tuple(dict.fromkeys(result.joints[k] for k in contacts.joint[f.reversing[position]]))


def friction_of(result: Result) -> tuple[Friction, Contacts]:
    """Friction at each position, and its contacts; ModelError where the result has no friction."""
    if result.friction is None or result.compiled.contacts is None:
        raise ModelError("this result has no friction", "give a joint `friction`, and do not switch it off")
    return result.friction, result.compiled.contacts


def power_lost(result: Result, joint: str, kind: Loss = "all") -> Array:
    """Power (P,) that friction takes in a joint, W; zero without friction."""
    k = result.joints.index(joint)
    f = result.friction
    if f is None:
        return np.zeros(len(result.status))
    parts = {"dry": f.dry_loss, "viscous": f.viscous_loss, "all": f.dry_loss + f.viscous_loss}
    return np.asarray(parts[kind][:, k])


def bearing_contact(result: Result, joint: str, kind: str) -> int:
    """Index of a joint's contact of a kind."""
    for e in contacts_of(result, joint, kind):
        return e
    raise ModelError(
        f"joint {joint!r} has no friction of a {kind}", "ask a joint that has", ("joints", joint)
    )


def contacts_of(result: Result, joint: str, kind: str | None = None) -> list[int]:
    """Indices of a joint's contacts with dry friction, of one kind or of all."""
    _, contacts = friction_of(result)
    mine = np.flatnonzero((contacts.joint == result.joints.index(joint)) & ~contacts.fixed)
    return [int(e) for e in mine if kind in (None, contacts.kind[e])]


def bears_on_faces(result: Result, joint: str) -> bool:
    """True if a joint is a slider with friction."""
    j = result.mechanism.joints[joint]
    return result.friction is not None and j.guides and getattr(j, "friction", None) is not None


@dataclass(frozen=True)
class GuideContact:
    """Contact of a guide, over P positions.

    normal, couple (P,): resultants of the contact forces about j's point; lower, upper (P,): loads on the two faces,
    both positive
    mode: `lower face`, `upper face`, or the diagonals `lower ahead, upper behind` and `lower behind, upper ahead`;
    empty where no force is known
    angle (P,): between the reaction and the normal, atan of friction over normal force
    """

    normal: Array
    couple: Array
    lower: Array
    upper: Array
    mode: tuple[str, ...]
    angle: Array


def guide_contact(result: Result, joint: str) -> GuideContact:
    """Contact of a slider with friction: which faces bear, and how much.

    The lower face pushes j to the left of the direction of the slide. S = max(|N|, |2M - (l2 - l1) N| / (l1 + l2)) is
    the sum of the contact forces, lower (S + N) / 2 and upper (S - N) / 2.

    >>> import dalembert as da
    >>> m = da.slider_crank().with_values({"joints.guide.friction": {"coefficient": 0.1}})
    >>> c = guide_contact(da.statics(m), "guide")
    >>> sorted(set(c.mode))
    ['lower face', 'upper face']
    """
    refuse_space(result.mechanism, "the contact of a guide", "ask friction_force and power_lost of the joint")
    f, _ = friction_of(result)
    e = bearing_contact(result, joint, "guide")
    normal, tilting = f.argument[:, 0, e], f.argument[:, 2, e]
    total = np.maximum(np.abs(normal), np.abs(tilting))
    couple = result.reaction_moment(joint) - result.friction_moment(joint)
    tilted = np.abs(tilting) > np.abs(normal)
    ahead = np.where(tilting > 0, "lower ahead, upper behind", "lower behind, upper ahead")
    mode = np.where(tilted, ahead, np.where(normal >= 0, "lower face", "upper face"))
    mode = np.where(np.isnan(total), "", mode)
    angle = np.arctan2(np.abs(f.cz[:, e]), np.abs(normal))
    lower, upper = (total + normal) / 2, (total - normal) / 2
    return GuideContact(normal, couple, lower, upper, tuple(str(m) for m in mode), angle)


def friction_circle_radius(result: Result, joint: str) -> float:
    """R sin(phi) or mu R of a pin or revolute, m; 0 without friction, and of other joints in space."""
    j = result.mechanism.joints[joint]
    f = getattr(j, "friction", None)
    if result.friction is None or getattr(f, "radius", None) is None:
        return 0.0
    if result.mechanism.dimension == 3 and not j.hinge:
        return 0.0
    _, contacts = friction_of(result)
    return float(strength(contacts, 1.0)[bearing_contact(result, joint, "pin")])


def friction_circle_radii(result: Result, joint: str) -> Array:
    """Radii at each position (P,): with the coefficient at rest where the sense is not known."""
    if not friction_circle_radius(result, joint):
        return np.zeros(len(result.status))
    f, contacts = friction_of(result)
    e = bearing_contact(result, joint, "pin")
    return np.asarray(strength(contacts, 1.0, f.open)[:, e])


def friction_coefficient(result: Result, joint: str, position: int) -> float:
    """Coefficient of a joint at a position: that at rest where the sense of its friction is not known."""
    return contact_forces(result, joint, position)[0].coefficient


def friction_sense(result: Result, joint: str, kind: str, position: int) -> float:
    """Sign of j's motion against i, actual or impending, at a joint's contact of a kind; 0 where there is none."""
    f, _ = friction_of(result)
    return float(f.sense[position, bearing_contact(result, joint, kind)])


def at_rest(result: Result, joint: str, kind: str, position: int) -> bool:
    """True if only the impending motion gives the sense of a joint's contact of a kind."""
    f, _ = friction_of(result)
    return bool(f.open[position, bearing_contact(result, joint, kind)])


@dataclass(frozen=True)
class ContactForce:
    """One contact of a joint at a position: what it bears and the friction that makes.

    kind: `pin`, `collar`, `guide`, `ball`, `thread`; coefficient mu; bearing S (N), the size of the forces it reads;
    part: sense of the slip, or the part of its direction along this contact's row; strength c: friction over bearing, m
    or 1; amount -part c S along its row on j, N or N m.
    """

    kind: str
    coefficient: float
    bearing: float
    part: float
    strength: float
    amount: float


def contact_forces(result: Result, joint: str, position: int) -> tuple[ContactForce, ...]:
    """The contacts of a joint's dry friction at a position, in the order of its law."""
    f, contacts = friction_of(result)
    mu = np.where(f.open[position], contacts.resting, contacts.coefficient)
    size, c = (
        bearing(contacts, f.argument[position]),
        strength(contacts, 1.0, f.open[position], f.sense[position]),
    )
    return tuple(
        ContactForce(
            kind=contacts.kind[e],
            coefficient=float(mu[e]),
            bearing=float(size[e]),
            part=float(f.sense[position, e]),
            strength=float(c[e]),
            amount=float(f.cz[position, e]),
        )
        for e in contacts_of(result, joint)
    )
