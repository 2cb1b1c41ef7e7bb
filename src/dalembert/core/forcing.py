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
from dalembert.arrays import Array, Flags, Ints, Numeric
from dalembert.core import gear_rows
from dalembert.core.branchless import any_traced, sign
from dalembert.core.constraints import measure, rates, system
from dalembert.core.elements import belt_pulls
from dalembert.core.elements.belt_pulls import BeltPulls
from dalembert.core.elements.force_laws import TurningFrame as TurningFrame
from dalembert.core.elements.force_laws import by_tables, gas_push
from dalembert.core.elements.strand_limits import RopeGrips, belt_margins, rope_margins
from dalembert.core.geometry import arm, span
from dalembert.core.layout import BeltMesh, ConstraintRows, Gearing, Layout, Mesh, Pose

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

    Their numbers have the names of the loads' keys (``analysis.compile.load_arrays``). Gas springs push with A (p (V/(V
    - A (length - l)))^n - p_out). Tables: ``start`` (2, k), the tension before the first bend over l - l0 and over
    dl/dt, ``bends`` and ``slopes`` (2, B, k), changes of slope.
    """

    a: Ints
    b: Ints
    at_a: Array
    at_b: Array
    stiffness: Array
    free_length: Array
    damping: Array
    force: Array
    area: Array
    volume: Array
    pressure: Array
    length: Array
    exponent: Array
    outside: Array
    start: Array
    bends: Array
    slopes: Array


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
    belts: BeltPulls | None = None
    turning: TurningFrame | None = None
    ropes: RopeGrips | None = None
    pushes: WrenchSource | None = None  # along freedoms of joints, as elastic stops do

    @property
    def follows_reactions(self) -> bool:
        """True if some load follows the size of a reaction: teeth pushed apart, belts with the tension of a strand."""
        some = self.belts is not None and bool(np.any(self.belts.share))
        return some or bool(self.separation.size and self.separation.any())


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
    length = np.sqrt(square)
    extended, rate = length - springs.free_length, g.dot(e, vb - va)
    tension = springs.stiffness * extended + springs.force + springs.damping * rate
    tension = (
        tension + by_tables(springs, 0, extended) + by_tables(springs, 1, rate) - gas_push(springs, length)
    )
    pull = tension[..., None] * e
    return WrenchSource(
        np.concatenate([springs.a, springs.b]),
        np.concatenate([_wrench(g, ra, pull), _wrench(g, rb, -pull)], axis=-2),
    )


def table_margins(layout: Layout, springs: Springs, pose: Pose, twist: Array) -> list[Numeric]:
    """Changes of length, and rates of it, less the bends of the tables of springs and dampers, at a single state."""
    g = layout.algebra
    ra, rb, line, square = _spans(layout, springs, pose)
    va = twist[..., springs.a, : g.d] + g.spin(twist[..., springs.a, g.d :], ra)
    vb = twist[..., springs.b, : g.d] + g.spin(twist[..., springs.b, g.d :], rb)
    length = np.sqrt(square)
    at = length - springs.free_length, g.dot(line, vb - va) / length
    places = np.argwhere(np.array(springs.slopes != 0, bool))
    return [at[which][..., k] - springs.bends[which, bend, k] for which, bend, k in places]


def _spans(layout: Layout, springs: Springs, pose: Pose) -> tuple[Array, Array, Array, Array]:
    """Arms of both ends (..., k, d), the vectors from a to b (..., k, d), and their squared lengths (..., k)."""
    g = layout.algebra
    ra, rb = arm(g, pose, springs.a, springs.at_a), arm(g, pose, springs.b, springs.at_b)
    span = pose.point[..., springs.b, :] + rb - pose.point[..., springs.a, :] - ra
    return ra, rb, span, (span * span).sum(axis=-1)


def _direction(layout: Layout, springs: Springs, span: Array, square: Array, rate: Array) -> Array:
    """Unit vectors (..., k, d) from a to b.

    Where b passes a, a damper takes the direction of their relative motion: its force is the same just before and just
    after. The force of a preloaded spring reverses at zero length: NaN. A spring without force at zero length needs no
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
    tabled = (springs.start[0] != 0) | (springs.slopes[0] != 0).any(axis=0)
    return np.array(compressed | tabled | (springs.force != 0) | (springs.area != 0), bool)


def needs_direction(springs: Springs) -> Flags:
    """Springs and dampers (k,) whose force at length zero depends on how it is reached."""
    damps = (springs.damping != 0) | (springs.start[1] != 0) | (springs.slopes[1] != 0).any(axis=0)
    return np.array(pushes_at_zero_length(springs) | damps, bool)


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
    every = [f for f in layout.constraints.families if isinstance(f, Mesh | Gearing)]
    return [f for f in every if not isinstance(f, BeltMesh)]


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


def belt_source(layout: Layout, pulls: BeltPulls, pose: Pose, twist: Array) -> WrenchSource:
    """Pull of belts on their shafts, without what follows from the torque."""
    f = belt_pulls.belts(layout)
    assert f is not None
    net = belt_pulls.net_sum(pulls, belt_pulls.belt_speed(layout, f, pose, twist), None)
    return WrenchSource(*belt_pulls.pull_wrench(layout, f, pose, belt_pulls.pull_on_j(layout, f, pose, net)))


def belt_share(layout: Layout, pulls: BeltPulls, pose: Pose, multiplier: Array) -> WrenchSource:
    """Part of the pull of belts that follows the difference of their tensions."""
    f = belt_pulls.belts(layout)
    assert f is not None
    net = pulls.share * np.abs(multiplier[..., f.row])
    return WrenchSource(*belt_pulls.pull_wrench(layout, f, pose, belt_pulls.pull_on_j(layout, f, pose, net)))


def belt_forces(
    layout: Layout, pulls: BeltPulls | None, pose: Pose, twist: Array, multiplier: Array
) -> list[tuple[Mesh | Gearing, Array, Array]]:
    """The belts with their pulls on j (..., k, d) and its centres (..., k, d), as in ``separation``."""
    f = belt_pulls.belts(layout)
    if f is None or pulls is None:
        return []
    speed = belt_pulls.belt_speed(layout, f, pose, twist)
    force = belt_pulls.pull_on_j(layout, f, pose, belt_pulls.net_sum(pulls, speed, multiplier[..., f.row]))
    return [(f, force, pose.point[..., f.j, :] + arm(layout.algebra, pose, f.j, f.uj))]


def following(layout: Layout, forcing: Forcing, pose: Pose, multiplier: Array) -> Array:
    """Total wrench (..., L, n) of the loads that follow the size of reactions."""
    sources = []
    if forcing.separation.size and forcing.separation.any():
        sources.append(separation_wrench(layout, pose, forcing.separation, multiplier))
    if forcing.belts is not None:
        sources.append(belt_share(layout, forcing.belts, pose, multiplier))
    return total_wrench(layout, *sources)


def between_wheels(
    layout: Layout, forcing: Forcing, pose: Pose, twist: Array, x: Array
) -> list[tuple[Mesh | Gearing, Array, Array]]:
    """Forces between wheels beside those of their rows, as ``separation``: teeth pushed apart, and belts' pull."""
    pushed = separation(layout, pose, forcing.separation, x)
    return [*pushed, *belt_forces(layout, forcing.belts, pose, twist, x)]


def limit_margins(layout: Layout, forcing: Forcing, pose: Pose, twist: Array, x: Array) -> Array:
    """Margins of belts and ropes, below zero where one slips or hangs slack."""
    belts = belt_margins(layout, forcing.belts, pose, twist, x)
    return np.concatenate([belts, rope_margins(layout, forcing.ropes, pose, x)], axis=-1)
