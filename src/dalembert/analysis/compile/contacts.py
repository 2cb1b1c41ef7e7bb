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
from dalembert.analysis.compile.elements.belt_arrays import SUMS
from dalembert.analysis.compile.elements.cam_joints import cam_numbers
from dalembert.analysis.compile.elements.cam_shapes import CamShape
from dalembert.arrays import Array, Ints, Numeric, Tree
from dalembert.core.elements.cam_family import CamSlip
from dalembert.core.elements.strand_family import Strand, StrandSum
from dalembert.core.forcing import Resistances
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Along, Distance, Rows, Turn
from dalembert.model import Mechanism
from dalembert.model.joints.elements.belts import Belt
from dalembert.model.joints.elements.ropes import Sheave
from dalembert.model.joints.plane_joints import Gear, Joint

Row = tuple[type, Mapping[str, object]]
"""Kind of a row and its numbers."""

Read = Mapping[Any, float]
"""A sum of reactions of the joint: factor by the name of each; in the plane by its place among the joint's rows."""


@dataclass(frozen=True)
class Contact:
    """One contact of a joint, with the keys of ``core.friction.contact_equations.Contacts``.

    ``read``: its arguments; ``leader``: which contact gives its sense, 0 for itself and -1 for the previous one;
    ``group`` of the contacts of the joint that share a slip, 0 for those that do not; ``given``: force that presses
    them, beside what they read; ``own``: the part of its friction that it bears itself; ``coefficient``: if not the
    joint's; ``viscous``: damping of the slide before it, whose force it carries, None where it carries none."""

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
    wrap: Numeric = 0.0
    blocks: int = 0
    given: Numeric = 0.0
    viscous: float | None = None
    own: Numeric = 0.0
    coefficient: Numeric | None = None
    wound: bool = False
    grounded: bool = False
    strands: tuple[str, str] | None = None
    way: int = 1


Kinds = Mapping[str, Callable[..., Iterator[Contact]]]
"""Contacts of a joint by its type, from its description, its geometry and whether its circles are of R sin(phi)."""

TURN: Row = (Turn, {})


def friction_on(m: Mechanism) -> bool:
    """True if some joint has friction and the file does not switch it off."""
    return any(has_friction(m, joint) for joint in m.joints.values())


def has_friction(m: Mechanism, joint: object) -> bool:
    """True if a joint has friction, or teeth with an efficiency, that is not switched off."""
    known = (getattr(joint, key, None) for key in ("friction", "efficiency"))
    return m.friction.enabled and any(value is not None for value in known)


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
    return str(getattr(getattr(joint, "friction", None), "circle", None) or m.friction.circle)


def contacts(
    m: Mechanism,
    constraints: Rows,
    ends: list[tuple[int, int]],
    at: Sequence[object],
    arms: Sequence[tuple[Any, ...]],
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
    names = list(m.joints)
    first = {
        names[k]: int(np.argmax(constraints.joint == k)) for k in set(constraints.joint.tolist()) if k >= 0
    }
    opened = opened_multipliers(m, constraints)
    count = constraints.count + (len(m.drives) if opened else 0)
    for k, joint in enumerate(m.joints.values()):
        touching, rough = kinds.get(joint.type), has_friction(m, joint)
        if touching is None or not (rough or joint.TOOTHED or joint.WRAPPED):
            continue
        own = places(joint, first[names[k]]) if names[k] in first else {}
        of_own = opened.get(k) or {name: [(row, 1.0)] for name, row in own.items()}
        place = {**{name: [(row, 1.0)] for name, row in first.items()}, **of_own}
        for contact in touching(joint, at[k], (circle(m, joint) == "sin") if rough else None):
            kind, columns = contact.row
            rows.add(kind, k, (rows.links, ends[k][1]) if contact.grounded else ends[k], **columns)
            entries.append((k, joint, contact))
            read.append(np.zeros((3, count), object))
            for part, sums in enumerate(contact.read):
                for name, factor in sums.items():
                    for row, share in place[name]:
                        read[-1][part, row] += factor * share
    if not entries:
        return None
    numbers = table.numbers(np.array(read).reshape(-1, 3, count).swapaxes(0, 1).tolist())
    return Contacts(
        rows=rows.rows(),
        joint=np.array([k for k, _, _ in entries], np.intp),
        read=numbers.reshape(3, len(entries), -1),
        link=np.array(ends, np.intp)[:, 1],
        bends=_bends(constraints, first, [c for _, _, c in entries]),
        at=table.numbers([place[1] for place in arms]),
        damping=damping,
        **_columns(m, entries),
    )


def opened_multipliers(m: Mechanism, constraints: Rows) -> dict[int, dict[int, list[tuple[int, float]]]]:
    """Reactions of joints (by number) whose contact is opened, by their places among its rows: sums of multipliers, of
    the drives' efforts along its gaps among them; an effort of a guide's end is the force at that end."""
    first = constraints.count
    effort = {(d.joint, str(d.freedom)): first + k for k, d in enumerate(m.drives.values())}
    out: dict[int, dict[int, list[tuple[int, float]]]] = {}
    for k, (name, joint) in enumerate(m.joints.items()):
        if not joint.gaps:
            continue
        left = [[(int(row), 1.0)] for row in np.flatnonzero(constraints.joint == k)]
        sums = [[(effort[name, gap], 1.0)] if (name, gap) in effort else [] for gap in joint.gaps]
        if len(joint.gaps) == 2 and joint.slides and all(sums):
            (behind, _), (ahead, _) = sums[0][0], sums[1][0]
            guide: Any = joint
            l1, l2 = guide.friction.guide
            sums = [[(behind, 1.0), (ahead, 1.0)], [(behind, -l1), (ahead, l2)]]
        out[k] = dict(enumerate([*sums, *left]))
    return out


def _columns(m: Mechanism, entries: list[tuple[int, Joint, Contact]]) -> Tree:
    """Data of contacts that do not depend on others."""
    of = [c for _, _, c in entries]

    def coefficients(mu: Callable[[Mechanism, Joint], float]) -> Array:
        own = (0.0 if c.fixed else c.coefficient for _, _, c in entries)
        return table.numbers([mu(m, e[1]) if c is None else c for c, e in zip(own, entries, strict=True)])

    return {
        "kind": tuple(c.kind for c in of),
        "coefficient": coefficients(coefficient),
        "resting": coefficients(resting_coefficient),
        "way": np.array([c.way for c in of], np.intp),
        "leader": np.array([e + c.leader for e, c in enumerate(of)], np.intp),
        "group": _groups(entries),
        "carried": np.array([-1 if c.viscous is None else e - 1 for e, c in enumerate(of)], np.intp),
        "viscous": table.numbers([0.0 if c.viscous is None else c.viscous for c in of]),
        **{name: table.numbers([getattr(c, name) for c in of]) for name in NUMBERS},
        **{name: np.array([getattr(c, name) for c in of], bool) for name in FLAGS},
    }


NUMBERS = ("lever", "reach", "reckoned", "wrap", "blocks", "given", "own")


def _bends(rows: Rows, first: Mapping[str, int], of: list[Contact]) -> Ints:
    """Strands before and behind each contact of a rope, by their places in their family; -1 of others."""
    places = {int(row): k for f in rows.families if isinstance(f, Strand) for k, row in enumerate(f.row)}
    out = [[places[first[s]] for s in c.strands] if c.strands else [-1, -1] for c in of]
    return np.array(out, np.intp).reshape(-1, 2)


FLAGS = ("circle", "signed", "ball", "fixed", "around", "wound")


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
    if f.guide is not None and joint.contact.mode == "holds":  # else both ends bear on one face
        behind, ahead = f.guide
        tilting = {0: -(ahead - behind) / (behind + ahead), 1: 2 / (behind + ahead)}
    yield Contact("guide", _slide(joint, at), ({0: 1.0}, {}, tilting))
    if f.half_height:
        yield Contact("faces", TURN, ({0: 1.0},), f.half_height, signed=True, leader=-1)
    if f.force is not None and not (isinstance(f.force, float) and f.force == 0.0):
        yield Contact("sleeve", _slide(joint, at), ({},), given=f.force, coefficient=1.0)


def _slot(joint: Any, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    """The pin turns in a block that slides: its circle feels the normal force and what resists the slide together."""
    yield Contact("guide", _slide(joint, at), ({0: 1.0},))
    if joint.friction.radius:
        slide, _ = joint.damping
        yield Contact("pin", TURN, ({0: 1.0},), joint.friction.radius, sine, viscous=slide)


def _rolling(joint: Any, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    """Off its track, or sliding on it, a wheel rubs along it; one that rolls transmits what it must."""
    if joint.contact.opened == "drive":
        kind, numbers = table.opened_rows(joint, (0, 1), *at)[1]
        yield Contact("guide", (kind, numbers), ({0: 1.0},))


def _gear(joint: Gear, at: tuple[Array, Array], sine: bool | None) -> Iterator[Contact]:
    """The normal force of teeth, and with or without friction what of it pushes the wheels apart."""
    if joint.pressure_angle:
        ri, rj = table.signed_radii(joint)
        lever = np.tan(joint.pressure_angle) * (1.0 if ri * rj > 0 else -1.0)
        row = (Distance, {"ui": at[0], "uj": at[1]})
        yield Contact("separation", row, ({0: 1.0},), lever, fixed=True, reach=abs(ri + rj))
    if joint.friction is not None and sine is not None:
        yield Contact("mesh", TURN, ({0: 1 / np.cos(joint.pressure_angle)},), contact_arm(joint))
    if joint.efficiency is not None and sine is not None:
        yield _lossy(joint)


def _lossy(joint: Gear) -> Contact:
    """A couple between the wheels that makes the tangential force smaller where the power leaves, F_out = eta F_in.

    With a couple Z on j and -Z on i the tangential forces are F + Z/r_j and F - Z/r_i: their mean, F + own Z, times
    2 (1 - eta)/(1 + eta) is their difference.
    """
    ri, rj = table.signed_radii(joint)
    eta: Any = joint.efficiency
    lever = 2 / ((1 + eta) * abs(1 / ri + 1 / rj))
    return Contact("mesh", TURN, ({0: 1.0},), lever, own=(1 / rj - 1 / ri) / 2, coefficient=1 - eta)


def _sheave(joint: Sheave, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    """The rope on a pulley or a fixed wheel: its friction is the difference of both strands' tensions."""
    before, after = joint.strands
    slides = joint.efficiency is None
    yield Contact(
        "rope",
        TURN,
        ({before: 0.5, after: 0.5},),
        joint.lever,
        wound=slides,
        wrap=np.pi + 2 * np.pi * joint.turns if slides else 0.0,
        grounded=not joint.radius,
        strands=joint.strands if slides else None,
        way=1 if joint.side == "right" else -1,
    )


def _belt(joint: Belt, at: tuple[Array, Array], sine: bool) -> Iterator[Contact]:
    """The part of a belt's pull on its shafts that follows its torque, where one strand's tension is given."""
    share = SUMS[joint.stated_tension[0]][1]
    if share:
        ri, rj = joint.signed_radii
        row = (StrandSum, {"ui": at[0], "uj": at[1], "ri": ri, "rj": rj})
        yield Contact("belt", row, ({0: 1.0},), -share, fixed=True)


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


def _shoe(joint: Any, at: Any, sine: bool) -> Iterator[Contact]:
    """The friction of a lining: its normal force turned by 90 degrees, with a couple about the drum's axis."""
    yield Contact("lining", (at.kinds[1], {"ui": at.ui, "uj": at.uj, **at.friction}), ({0: 1.0},))


def _band(joint: Any, at: Any, sine: bool) -> Iterator[Contact]:
    """Half the difference of the tensions more in one strand, half of it less in the other."""
    row = (at.kinds[1], {"ui": at.ui, "uj": at.uj, **at.friction})
    blocks = 0 if joint.blocks is None else int(joint.blocks.count)
    yield Contact("band", row, ({0: 1.0},), wound=True, wrap=at.wrap, blocks=blocks)


def _faces(joint: Any, at: Any, sine: bool) -> Iterator[Contact]:
    """The couple of faces that a given force presses together."""
    if joint.clamped is not None:
        yield Contact("plates", TURN, ({},), joint.lever, given=joint.clamped)


def _cam(joint: Joint, at: tuple[Array, Array, CamShape], sine: bool) -> Iterator[Contact]:
    """A knife edge or a face that slides on its cam."""
    yield Contact("guide", (CamSlip, cam_numbers(at[2], at[0], at[1])), ({0: 1.0},))


KINDS: Kinds = {
    "pin": _pin,
    "slider": _slider,
    "slot": _slot,
    "rolling": _rolling,
    "gear": _gear,
    "sheave": _sheave,
    "belt": _belt,
    "shoe": _shoe,
    "band": _band,
    "disc": _faces,
    "cone": _faces,
    "cam": _cam,
}
"""Planar joints that can have friction."""
