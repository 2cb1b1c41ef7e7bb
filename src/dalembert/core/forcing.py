"""Wrenches on the links that are known once the motion is: loads, weights, springs, dampers, inertia (D'Alembert).

Every function returns a ``WrenchSource``: wrenches (..., k, n) about the reference points of their links, one per
contribution, so that superposition and virtual work can separate them; ``total_wrench`` sums them per link.

Mechanics: docs/theory.md 4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Flags, Ints
from dalembert.core import gear_rows
from dalembert.core.branchless import any_traced, sign
from dalembert.core.constraints import measure, rates, system
from dalembert.core.geometry import arm, span
from dalembert.core.layout import ConstraintRows, Gearing, Layout, Mesh, Pose

MANY = 100
"""Contributions above which one indexed addition is faster than a loop over them."""

VANISHED = 1e-9
"""Spring length over characteristic length below which the spring has no direction; positions are not more accurate."""


@dataclass(frozen=True)
class Inertia:
    """Mass (L,), arm of the mass centre (L, d) in link axes, inertia about it (L, n - d), and gravity (d,)."""

    mass: Array
    center: Array
    inertia: Array
    gravity: Array


@dataclass(frozen=True)
class PointForces:
    """Forces on links at points: arms (k, d) in link axes; components (P, k, d), in link axes where ``follows``."""

    link: Ints
    at: Array
    follows: Flags
    value: Array


@dataclass(frozen=True)
class Couples:
    """Couples (P, k, n - d) on links, in link axes where ``follows``."""

    link: Ints
    value: Array
    follows: Flags


@dataclass(frozen=True)
class Springs:
    """Springs and dampers between points of two links: tension k (l - l0) + F + c dl/dt pulls them together.

    Their numbers have the names of the loads' keys (``analysis.compile.load_arrays``).
    """

    a: Ints
    b: Ints
    at_a: Array
    at_b: Array
    stiffness: Array
    free_length: Array
    damping: Array
    force: Array


@dataclass(frozen=True)
class Resistances:
    """Springs and dampers in freedoms: -k (q + turns - q0) - c dq/dt along freedom ``row``, on j; the opposite on i.

    ``turns`` (R,), or (P, R): angle added by counting whole turns (``analysis.compile.torsion_turns``).
    """

    row: Ints
    stiffness: Array
    free: Array
    damping: Array
    turns: Array


@dataclass(frozen=True)
class Forcing:
    """All loads on the links, except the drives' efforts."""

    inertia: Inertia
    forces: PointForces
    couples: Couples
    springs: Springs
    resistances: Resistances
    separation: Array  # tan(alpha) of each mesh


class WrenchSource(NamedTuple):
    """Wrenches (..., k, n) on links (k,), about their reference points."""

    link: Ints
    wrench: Array


def total_wrench(layout: Layout, *sources: WrenchSource) -> Array:
    """Total wrench on each moving link (..., L, n)."""
    lead = np.broadcast_shapes(*(s.wrench.shape[:-2] for s in sources))
    out = np.zeros((*lead, layout.links + 1, layout.algebra.n), np.result_type(*(s.wrench for s in sources)))
    for source in sources:
        if len(source.link) > MANY:
            wrench = np.broadcast_to(source.wrench, (*lead, *source.wrench.shape[-2:]))
            np.add.at(np.moveaxis(out, -2, 0), source.link, np.moveaxis(wrench, -2, 0))
            continue
        for k, link in enumerate(source.link):
            out[..., link, :] += source.wrench[..., k, :]
    return out[..., :-1, :]


def weight(layout: Layout, inertia: Inertia, pose: Pose) -> WrenchSource:
    """m g at the mass centres."""
    return _at_center(layout, inertia, pose, inertia.mass[..., None] * inertia.gravity, None)


def inertia_wrench(
    layout: Layout, inertia: Inertia, pose: Pose, twist: Array, acceleration: Array
) -> WrenchSource:
    """D'Alembert's wrench: -m a_G at the mass centre and -(I alpha + omega x I omega)."""
    g = layout.algebra
    _, _, a = center_motion(layout, inertia, pose, twist, acceleration)
    r, w, alpha = pose.rotation[..., :-1, :], twist[..., :-1, g.d :], acceleration[..., g.d :]
    couple = -g.angular_momentum_rate(r, alpha, inertia.inertia) - g.gyroscopic(r, w, inertia.inertia)
    return _at_center(layout, inertia, pose, -inertia.mass[..., None] * a, couple)


def center_motion(
    layout: Layout, inertia: Inertia, pose: Pose, twist: Array, acceleration: Array
) -> tuple[Array, Array, Array]:
    """Position, velocity, acceleration (..., L, d) of the mass centres; twist with ground, acceleration without."""
    g, links = layout.algebra, np.arange(layout.links)
    r = arm(g, pose, links, inertia.center)
    v, w, alpha = twist[..., :-1, : g.d], twist[..., :-1, g.d :], acceleration[..., g.d :]
    accelerated = acceleration[..., : g.d] + g.spin(alpha, r) + g.centripetal(w, r)
    return pose.point[..., :-1, :] + r, v + g.spin(w, r), accelerated


def _at_center(
    layout: Layout, inertia: Inertia, pose: Pose, force: Array, couple: Array | None
) -> WrenchSource:
    g, links = layout.algebra, np.arange(layout.links)
    r = arm(g, pose, links, inertia.center)
    return WrenchSource(links, _wrench(g, r, force, couple))


def _wrench(g: Algebra, r: Array, force: Array, couple: Array | None = None) -> Array:
    """Wrench about the reference point of a force with arm r and a couple."""
    moment = g.cross(r, force)
    if couple is not None:
        moment = moment + couple
    force = np.broadcast_to(force, (*moment.shape[:-1], g.d))
    return np.concatenate([force, moment], axis=-1)


def force_wrench(layout: Layout, forces: PointForces, pose: Pose) -> WrenchSource:
    """Forces at points of links."""
    g = layout.algebra
    r = arm(g, pose, forces.link, forces.at)
    turned = g.rotate(pose.rotation[..., forces.link, :], forces.value)
    return WrenchSource(forces.link, _wrench(g, r, np.where(forces.follows[:, None], turned, forces.value)))


def couple_wrench(layout: Layout, couples: Couples, pose: Pose) -> WrenchSource:
    """Couples on links."""
    turned = layout.algebra.rotate_couple(pose.rotation[..., couples.link, :], couples.value)
    value = np.where(couples.follows[:, None], turned, couples.value)
    zero = np.zeros((*value.shape[:-1], layout.algebra.d))
    return WrenchSource(couples.link, np.concatenate([zero, value], axis=-1))


def spring_wrench(layout: Layout, springs: Springs, pose: Pose, twist: Array) -> WrenchSource:
    """Springs and dampers between points: on a towards b, on b the opposite."""
    g = layout.algebra
    ra, rb, span, square = _spans(layout, springs, pose)
    va = twist[..., springs.a, : g.d] + g.spin(twist[..., springs.a, g.d :], ra)
    vb = twist[..., springs.b, : g.d] + g.spin(twist[..., springs.b, g.d :], rb)
    e = _direction(layout, springs, span, square, vb - va)
    extended = np.sqrt(square) - springs.free_length
    tension = springs.stiffness * extended + springs.force + springs.damping * g.dot(e, vb - va)
    pull = tension[..., None] * e
    return WrenchSource(
        np.concatenate([springs.a, springs.b]),
        np.concatenate([_wrench(g, ra, pull), _wrench(g, rb, -pull)], axis=-2),
    )


def _spans(layout: Layout, springs: Springs, pose: Pose) -> tuple[Array, Array, Array, Array]:
    """Arms of both ends (..., k, d), the vectors from a to b (..., k, d), and their squared lengths (..., k)."""
    g = layout.algebra
    ra, rb = arm(g, pose, springs.a, springs.at_a), arm(g, pose, springs.b, springs.at_b)
    span = pose.point[..., springs.b, :] + rb - pose.point[..., springs.a, :] - ra
    return ra, rb, span, (span * span).sum(axis=-1)


def _direction(layout: Layout, springs: Springs, span: Array, square: Array, rate: Array) -> Array:
    """Unit vectors (..., k, d) from a to b.

    Where b passes a, a damper takes the direction of their relative motion: its force is the same just before and just
    after. The force of a preloaded spring reverses there: NaN. A spring without force at zero length needs no
    direction.
    """
    needed = needs_direction(springs)
    if any_traced(span):  # no number at length zero, where the general executor decides
        return np.asarray(span / np.sqrt(square + np.where(needed, 0.0, 1e-300))[..., None])
    gone = (square == 0) | (needed & (square <= _vanished(layout)))
    speed = np.sqrt((rate * rate).sum(axis=-1))
    moving = rate / np.where(speed > 0, speed, 1.0)[..., None]
    at_zero = np.where(pushes_at_zero_length(springs)[..., None], np.nan, moving)
    return np.where(gone[..., None], at_zero, span / np.sqrt(np.where(gone, 1.0, square))[..., None])


def pushes_at_zero_length(springs: Springs) -> Flags:
    """Springs (k,) that push or pull at length zero."""
    compressed = (springs.stiffness != 0) & (springs.free_length != 0)
    return np.array(compressed | (springs.force != 0), bool)


def needs_direction(springs: Springs) -> Flags:
    """Springs and dampers (k,) whose force at length zero depends on how it is reached."""
    return np.array(pushes_at_zero_length(springs) | (springs.damping != 0), bool)


def _vanished(layout: Layout) -> float:
    """Square of the length below which a span has no direction."""
    least = VANISHED * layout.length
    return least * least


def away(layout: Layout, springs: Springs, pose: Pose) -> Array:
    """Squared length (..., k) minus the square of the shortest length with a direction: not positive at zero length."""
    return np.asarray(_spans(layout, springs, pose)[-1] - _vanished(layout))


def resistance_wrench(layout: Layout, resistances: Resistances, pose: Pose, twist: Array) -> WrenchSource:
    """Springs and dampers in freedoms."""
    rows = system(layout.algebra, layout.freedoms, pose).rows(resistances.row)
    value = measure(layout.algebra, layout.freedoms, pose)[..., resistances.row] + resistances.turns
    effort = -resistances.stiffness * (value - resistances.free) - resistances.damping * rates(rows, twist)
    return pair(rows, effort)


def pair(rows: ConstraintRows, multiplier: Array) -> WrenchSource:
    """Wrenches of rows on both their links for multipliers (..., K)."""
    both = [multiplier[..., None] * rows.on_i, multiplier[..., None] * rows.on_j]
    return WrenchSource(np.concatenate([rows.i, rows.j]), np.concatenate(both, axis=-2))


def separation_wrench(layout: Layout, pose: Pose, tangent: Array, multiplier: Array) -> WrenchSource:
    """Radial tooth forces |F_t| tan(alpha) on both wheels of each mesh; they push the wheels apart for either sense of
    F_t.

    ``tangent`` (k,) holds tan(alpha) of the mesh rows, ``multiplier`` (..., K) all constraints' multipliers.
    """
    g = layout.algebra
    links, parts = [], []
    for f, pushed, at in separation(layout, pose, tangent, multiplier):
        links += [f.i, f.j]
        for link, force in ((f.i, -pushed), (f.j, pushed)):
            parts.append(_wrench(g, at - pose.point[..., link, :], force))
    return WrenchSource(np.concatenate(links), np.concatenate(parts, axis=-2))


def meshes(layout: Layout) -> list[Mesh | Gearing]:
    """The families of gear meshes."""
    return [f for f in layout.constraints.families if isinstance(f, Mesh | Gearing)]


def separation(
    layout: Layout, pose: Pose, tangent: Array, multiplier: Array
) -> list[tuple[Mesh | Gearing, Array, Array]]:
    """Each family of meshes with its radial forces on j (..., k, d) and the points (..., k, d) they act at."""
    g = layout.algebra
    out: list[tuple[Mesh | Gearing, Array, Array]] = []
    start = 0
    for f in meshes(layout):
        tan = tangent[start : start + len(f.i)]
        start += len(f.i)
        if isinstance(f, Gearing):
            away, at = gear_rows.separation(g, f, pose)
            out.append((f, (np.abs(multiplier[..., f.row]) * tan)[..., None] * away, at))
            continue
        line = span(g, f, pose)
        length = np.sqrt((line * line).sum(axis=-1))
        tan = tan * sign(f.ri * f.rj) * np.abs(f.ri + f.rj)
        pushed = (np.abs(multiplier[..., f.row]) * tan / length**2)[..., None] * line
        out.append((f, pushed, pose.point[..., f.i, :] + arm(g, pose, f.i, f.ui)))
    return out
