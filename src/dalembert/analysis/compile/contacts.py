"""The joints' friction as contacts for the core: which multipliers each reads, along which row it acts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from dalembert.analysis.compile import plane_rows as table
from dalembert.arrays import Array
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Along, Distance, Rows, Turn
from dalembert.model import Mechanism


@dataclass(frozen=True)
class Contact:
    """One contact of a joint, with the keys of ``core.friction.contact_equations.Contacts``.

    ``along``: kind of row and its numbers; ``led``: which contact tells its sense, 0 for itself and -1 for the one
    before; ``viscous``: damping of the slide before it, whose force it carries, None where it carries none."""

    kind: str
    along: tuple[type, dict[str, Any]]
    first: int
    second: int = -1
    couple: int = -1
    tilt: tuple[Any, Any] = (0.0, 0.0)
    gain: Any = 1.0
    lever: Any = 1.0
    circle: bool = False
    signed: bool = False
    fixed: bool = False
    led: int = 0
    reach: Any = 0.0
    viscous: Any = None


TURN: tuple[type, dict[str, Any]] = (Turn, {})


def friction_on(m: Mechanism) -> bool:
    """Whether some joint has friction and the file does not switch it off."""
    return m.friction.enabled and any(getattr(j, "friction", None) is not None for j in m.joints.values())


def rubs(m: Mechanism, joint: Any) -> bool:
    """Whether a joint has friction that is not switched off."""
    return m.friction.enabled and getattr(joint, "friction", None) is not None


def coefficient(m: Mechanism, joint: Any) -> Any:
    """Coefficient of friction in motion."""
    own, top = joint.friction.coefficient, m.friction.coefficient
    return (top or 0.0) if own is None else own


def resting_coefficient(m: Mechanism, joint: Any) -> Any:
    """Coefficient at rest: the joint's own, else its coefficient of motion, else the file's."""
    f, top = joint.friction, m.friction
    if f.static is not None or f.coefficient is not None:
        return f.coefficient if f.static is None else f.static
    return (top.coefficient or 0.0) if top.static is None else top.static


def circle(m: Mechanism, joint: Any) -> str:
    """Convention of a pin's friction circle: sin or tan."""
    return str(joint.friction.circle or m.friction.circle)


def contacts(
    m: Mechanism, constraints: Rows, ends: list[tuple[int, int]], points: list[tuple[Array, Array]]
) -> tuple[Contacts, tuple[str, ...]] | None:
    """All contacts and the kind of each; None without friction. ``ends``, ``points``: links and arms of the joints."""
    if not friction_on(m):
        return None
    rows = table.RowBuilder(constraints.links)
    found: list[tuple[int, Contact, Any, Any]] = []
    for k, joint in enumerate(m.joints.values()):
        first = int(np.flatnonzero(constraints.joint == k)[0])
        for contact, mu, resting in _of(m, joint, first):
            kind, numbers = contact.along
            arms: dict[str, Any] = {} if kind is Turn else {"ui": points[k][0], "uj": points[k][1]}
            rows.add(kind, k, ends[k], **arms, **numbers)
            found.append((k, contact, mu, resting))
    return _stack(rows.rows(), found), tuple(contact.kind for _, contact, _, _ in found)


def _stack(rows: Rows, found: list[tuple[int, Contact, Any, Any]]) -> Contacts:
    def column(name: str, kind: type) -> Array:
        values = [getattr(c, name) for _, c, _, _ in found]
        return table.numbers(values) if kind is float else np.array(values, kind)

    return Contacts(
        rows=rows,
        joint=np.array([k for k, _, _, _ in found], np.intp),
        first=column("first", np.intp),
        second=column("second", np.intp),
        couple=column("couple", np.intp),
        tilt=column("tilt", float),
        gain=column("gain", float),
        lever=column("lever", float),
        coefficient=table.numbers([mu for _, _, mu, _ in found]),
        resting=table.numbers([mu for _, _, _, mu in found]),
        circle=column("circle", bool),
        signed=column("signed", bool),
        fixed=column("fixed", bool),
        led=np.arange(len(found)) + column("led", np.intp),
        reach=column("reach", float),
        carried=np.array(
            [e - 1 if c.viscous is not None else -1 for e, (_, c, _, _) in enumerate(found)], np.intp
        ),
        viscous=table.numbers([0.0 if c.viscous is None else c.viscous for _, c, _, _ in found]),
    )


def _of(m: Mechanism, joint: Any, first: int) -> Iterator[tuple[Contact, float, float]]:
    """Contacts of one joint with their coefficients; ``first`` is the joint's first constraint row."""
    if joint.type == "gear" and joint.pressure_angle:
        yield _separation(joint, first), 0.0, 0.0
    if getattr(joint, "friction", None) is None:
        return
    mu, resting = coefficient(m, joint), resting_coefficient(m, joint)
    for contact in KINDS[joint.type](joint, first, circle(m, joint) if joint.type in ROUND else "tan", mu):
        yield contact, mu, resting


def _pin(joint: Any, first: int, circle: str, mu: float) -> Iterator[Contact]:
    yield Contact("pin", TURN, first, first + 1, lever=joint.friction.radius, circle=circle == "sin")


def _slider(joint: Any, first: int, circle: str, mu: float) -> Iterator[Contact]:
    f = joint.friction
    slide = (Along, {"axis": table.direction(joint), "pitch": 0.0})
    couple, tilt = -1, (0.0, 0.0)
    if f.guide is not None:
        behind, ahead = f.guide
        couple, tilt = first + 1, (2 / (behind + ahead), -(ahead - behind) / (behind + ahead))
    yield Contact("guide", slide, first, couple=couple, tilt=tilt)
    if f.half_height:
        yield Contact("faces", TURN, first, lever=f.half_height, signed=True, led=-1)


def _slot(joint: Any, first: int, circle: str, mu: float) -> Iterator[Contact]:
    """The pin turns in a block that slides: its circle feels the normal force and what resists the slide together."""
    f = joint.friction
    yield Contact("guide", (Along, {"axis": table.direction(joint), "pitch": 0.0}), first)
    if f.radius:
        slide, _ = joint.damping
        yield Contact("pin", TURN, first, lever=f.radius, circle=circle == "sin", viscous=slide)


def _gear(joint: Any, first: int, circle: str, mu: float) -> Iterator[Contact]:
    yield Contact("mesh", TURN, first, gain=1 / np.cos(joint.pressure_angle), lever=contact_arm(joint))


def contact_arm(joint: Any) -> Any:
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


def _path(radius: Any, addendum: Any, angle: Any, sign: int) -> Any:
    """Length of the path of contact from the pitch point to the addendum circle of one wheel."""
    outer, base = radius + sign * addendum, radius * np.cos(angle)
    return abs(np.sqrt(max(outer * outer - base * base, 0.0)) - radius * np.sin(angle))


def _separation(joint: Any, first: int) -> Contact:
    ri, rj = table.signed_radii(joint)
    lever = np.tan(joint.pressure_angle) * (1.0 if ri * rj > 0 else -1.0)
    return Contact("separation", (Distance, {}), first, lever=lever, fixed=True, reach=abs(ri + rj))


KINDS: dict[str, Callable[[Any, int, str, float], Iterator[Contact]]] = {
    "pin": _pin,
    "slider": _slider,
    "slot": _slot,
    "gear": _gear,
}
"""Joints that can have friction."""

ROUND = ("pin", "slot")
"""Joints with a friction circle."""
