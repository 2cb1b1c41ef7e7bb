"""The joints' friction as contacts for the core: which multipliers each reads, along which row it acts.

To give a kind of joint friction, add the contacts it has to ``KINDS``, here for the plane, in ``space_contacts`` for
space.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dalembert.analysis.compile import plane_rows as table
from dalembert.arrays import Array, Ints, Numeric, Tree
from dalembert.core.forcing import Resistances
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Along, Distance, Rows, Turn
from dalembert.model import Mechanism
from dalembert.model.joints.plane_joints import Gear, Joint

Row = tuple[type, Mapping[str, object]]
"""Kind of a row and its numbers."""

Read = Mapping[Any, float]
"""A sum of reactions of the joint: factor by the name of each; in the plane by its place among the joint's rows."""


@dataclass(frozen=True)
class Contact:
    """One contact of a joint, with the keys of ``core.friction.contact_equations.Contacts``.

    ``read``: its arguments; ``leader``: which contact gives its sense, 0 for itself and -1 for the previous one;
    ``group`` of the contacts of the joint that share a slip, 0 for those that do not; ``viscous``: damping of the
    slide before it, whose force it carries, None where it carries none."""

    kind: str
    row: Row
    read: tuple[Read, ...]
    lever: float = 1.0
    circle: bool = False
    signed: bool = False
    ball: bool = False
    fixed: bool = False
    leader: int = 0
    reach: float = 0.0
    group: int = 0
    reckoned: float = 1.0
    around: bool = False
    viscous: float | None = None


Kinds = Mapping[str, Callable[..., Iterator[Contact]]]
"""Contacts of a joint by its type, from its description, its geometry and whether its circles are of R sin(phi)."""

TURN: Row = (Turn, {})


def friction_on(m: Mechanism) -> bool:
    """True if some joint has friction and the file does not switch it off."""
    return m.friction.enabled and any(getattr(j, "friction", None) is not None for j in m.joints.values())


def has_friction(m: Mechanism, joint: object) -> bool:
    """True if a joint has friction that is not switched off."""
    return m.friction.enabled and getattr(joint, "friction", None) is not None


def coefficient(m: Mechanism, joint: Any) -> Numeric:
    """Coefficient of friction in motion."""
    local, top = joint.friction.coefficient, m.friction.coefficient
    return (top or 0.0) if local is None else local


def resting_coefficient(m: Mechanism, joint: Any) -> Numeric:
    """Coefficient at rest: the joint's, else its coefficient of motion, else the file's."""
    f, top = joint.friction, m.friction
    if f.static is not None or f.coefficient is not None:
        return f.coefficient if f.static is None else f.static
    return (top.coefficient or 0.0) if top.static is None else top.static


def circle(m: Mechanism, joint: Any) -> str:
    """Convention of a pin's friction circle: sin or tan."""
    return str(getattr(joint.friction, "circle", None) or m.friction.circle)


def contacts(
    m: Mechanism,
    constraints: Rows,
    ends: list[tuple[int, int]],
    at: Sequence[object],
    arms: list[tuple[Array, Array]],
    damping: Resistances,
    kinds: Kinds,
    places: Callable[[Joint, int], Mapping[Any, int]],
) -> Contacts | None:
    """All contacts; None without friction.

    ends, at, arms: links, geometry and points of the joints, with their damping; places: row of each reaction of a
    joint whose first row is given.
    """
    if not friction_on(m):
        return None
    rows = table.RowBuilder(constraints.links, m.dimension)
    entries: list[tuple[int, Joint, Contact]] = []
    read: list[Array] = []
    for k, joint in enumerate(m.joints.values()):
        touching, rough = kinds.get(joint.type), has_friction(m, joint)
        if touching is None or not (rough or joint.TOOTHED):
            continue
        place = places(joint, int(np.flatnonzero(constraints.joint == k)[0]))
        for contact in touching(joint, at[k], rough and circle(m, joint) == "sin"):
            kind, columns = contact.row
            rows.add(kind, k, ends[k], **columns)
            entries.append((k, joint, contact))
            read.append(np.zeros((3, constraints.count), object))
            for part, sums in enumerate(contact.read):
                for name, factor in sums.items():
                    read[-1][part, place[name]] += factor
    numbers = table.numbers(np.array(read).reshape(-1, 3, constraints.count).swapaxes(0, 1).tolist())
    return Contacts(
        rows=rows.rows(),
        joint=np.array([k for k, _, _ in entries], np.intp),
        read=numbers.reshape(3, len(entries), -1),
        link=np.array(ends, np.intp)[:, 1],
        at=table.numbers([uj for _, uj in arms]),
        damping=damping,
        **_columns(m, entries),
    )


def _columns(m: Mechanism, entries: list[tuple[int, Joint, Contact]]) -> Tree:
    """Data of contacts that do not depend on others."""
    of = [c for _, _, c in entries]

    def coefficients(mu: Callable[[Mechanism, Joint], float]) -> Array:
        return table.numbers([0.0 if c.fixed else mu(m, joint) for _, joint, c in entries])

    return {
        "kind": tuple(c.kind for c in of),
        "coefficient": coefficients(coefficient),
        "resting": coefficients(resting_coefficient),
        "leader": np.array([e + c.leader for e, c in enumerate(of)], np.intp),
        "group": _groups(entries),
        "carried": np.array([-1 if c.viscous is None else e - 1 for e, c in enumerate(of)], np.intp),
        "viscous": table.numbers([0.0 if c.viscous is None else c.viscous for c in of]),
        **{name: table.numbers([getattr(c, name) for c in of]) for name in ("lever", "reach", "reckoned")},
        **{name: np.array([getattr(c, name) for c in of], bool) for name in FLAGS},
    }


FLAGS = ("circle", "signed", "ball", "fixed", "around")


def _groups(entries: list[tuple[int, Joint, Contact]]) -> Ints:
    """One number for contacts of one joint and group; contacts of group 0 are separate."""
    keys = [(k, c.group, 0 if c.group else n) for n, (k, _, c) in enumerate(entries)]
    return np.array([keys.index(key) for key in keys], np.intp)


def _pin(joint: Any, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    yield Contact("pin", TURN, ({0: 1.0}, {1: 1.0}), joint.friction.radius, sine)


def _slide(joint: Joint, at: tuple[Array, Array]) -> Row:
    return Along, {"ui": at[0], "uj": at[1], "axis": table.direction(joint), "pitch": 0.0}


def _slider(joint: Any, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    f = joint.friction
    tilting: Read = {}
    if f.guide is not None:
        behind, ahead = f.guide
        tilting = {0: -(ahead - behind) / (behind + ahead), 1: 2 / (behind + ahead)}
    yield Contact("guide", _slide(joint, at), ({0: 1.0}, {}, tilting))
    if f.half_height:
        yield Contact("faces", TURN, ({0: 1.0},), f.half_height, signed=True, leader=-1)


def _slot(joint: Any, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    """The pin turns in a block that slides: its circle feels the normal force and what resists the slide together."""
    yield Contact("guide", _slide(joint, at), ({0: 1.0},))
    if joint.friction.radius:
        slide, _ = joint.damping
        yield Contact("pin", TURN, ({0: 1.0},), joint.friction.radius, sine, viscous=slide)


def _gear(joint: Gear, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    """The normal force of teeth, and with or without friction what of it pushes the wheels apart."""
    if joint.pressure_angle:
        ri, rj = table.signed_radii(joint)
        lever = np.tan(joint.pressure_angle) * (1.0 if ri * rj > 0 else -1.0)
        row = (Distance, {"ui": at[0], "uj": at[1]})
        yield Contact("separation", row, ({0: 1.0},), lever, fixed=True, reach=abs(ri + rj))
    if joint.friction is not None:
        yield Contact("mesh", TURN, ({0: 1 / np.cos(joint.pressure_angle)},), contact_arm(joint))


def contact_arm(joint: Any) -> Numeric:
    """Mean distance of the teeth's contact from the pitch point, both sides of it weighted by their length.

    Full-depth teeth: addendum one module, so that the path of contact reaches to the addendum circles.
    """
    if joint.friction.arm is not None:
        return joint.friction.arm
    inner = joint.pitch_radii[0] < joint.pitch_radii[1]
    signs = (1, 1) if not joint.internal else ((1, -1) if inner else (-1, 1))
    parts = [
        _path(r, joint.module, joint.pressure_angle, s) for r, s in zip(joint.pitch_radii, signs, strict=True)
    ]
    return sum(p * p for p in parts) / (2 * sum(parts))


def _path(radius: float, addendum: float, angle: float, sign: int) -> Numeric:
    """Length of the path of contact from the pitch point to the addendum circle of one wheel."""
    outer, base = radius + sign * addendum, radius * np.cos(angle)
    return abs(np.sqrt(max(outer * outer - base * base, 0.0)) - radius * np.sin(angle))


KINDS: Kinds = {"pin": _pin, "slider": _slider, "slot": _slot, "gear": _gear}
"""Planar joints that can have friction."""
