"""Motion and equilibrium at known poses: velocities, accelerations, A x + w = 0, residual, virtual work.

x   multipliers of the unknowns: constraints, then unknown drive efforts, then unknown loads
w   wrenches of everything else on the links (D'Alembert: inertia with the minus sign)
V   twists of the links per unit speed of each drive, the others held: virtual velocities

Mechanics: docs/theory.md 5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Flags, Ints
from dalembert.core import forcing as fc
from dalembert.core.constraints import dense, drift, rates, stack_rows
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.elements.strand_family import Strand
from dalembert.core.elements.turning_frame import centrifugal, turning_square
from dalembert.core.factor import SPARSE, factor, row_scale
from dalembert.core.forcing import Forcing, WrenchSource, pair, total_wrench
from dalembert.core.geometry import arm
from dalembert.core.layout import BeltMesh, ConstraintRows, Gearing, Helix, Layout, Mesh, Pose, Rows
from dalembert.core.linear import Factor, PseudoInverse, compliant, even_rcond
from dalembert.core.rank import singular_below


@dataclass(frozen=True)
class Known:
    """Known efforts of drives and unknown loads.

    effort (P, D), NaN where unknown; ``requested`` (D,) flags the unknown ones; unknown loads: unit force ``direction``
    (U, d) at ``at`` on ``link``, in link axes where ``follows``, or a unit couple ``about`` (U, n - d) where
    ``couple``.
    """

    requested: Flags
    effort: Array
    link: Ints
    at: Array
    direction: Array
    about: Array
    follows: Flags
    couple: Flags


class LinkMotions(NamedTuple):
    """Twists and accelerations of all links (..., L+1, n), V (..., D, L+1, n), and the scaled rcond of J (...)."""

    twist: Array
    acceleration: Array
    virtual: Array
    rcond: Array


class Equilibrium(NamedTuple):
    """Solved equilibrium: multipliers and their checks.

    constraint (..., K), effort (..., D), load (..., U), residual and power_balance (...), free (..., X, X) the
    projector on multipliers that load nothing where A has redundant columns, separation: radial tooth
    forces on j, by families of meshes, with the points they act at.
    """

    constraint: Array
    effort: Array
    load: Array
    residual: Array
    power_balance: Array
    rcond: Array
    free: Array | None
    separation: list[tuple[Mesh | Gearing, Array, Array]]


def with_ground(twist: Array) -> Array:
    """Twists with the ground's zeros as the last link."""
    return np.concatenate([twist, np.zeros_like(twist[..., :1, :])], axis=-2)


def motion(
    layout: Layout, pose: Pose, speed: Array, acceleration: Array
) -> tuple[LinkMotions, ConstraintRows, Factor]:
    """Velocities and accelerations from the drives' speeds and accelerations (..., D): A^T v = rates."""
    rows = stack_rows(layout, pose)
    solver = factor(layout, rows)
    count, lead = layout.constraints.count, pose.point.shape[:-2]

    def twists(right: Array) -> Array:
        solved = solver.motion(right)
        return with_ground(solved.reshape((*solved.shape[:-1], layout.links, layout.algebra.n)))

    def prescribed(drives: Array) -> Array:
        return np.concatenate(
            [np.zeros((*lead, count)), np.broadcast_to(drives, (*lead, len(layout.driven)))], axis=-1
        )

    v = twists(prescribed(speed))
    a = twists(prescribed(acceleration) - drift(layout.algebra, layout.stack, pose, v))
    unit = np.eye(len(layout.driven))
    virtual = [twists(prescribed(e)) for e in unit]
    stack = np.stack(virtual, axis=-3) if virtual else np.zeros((*lead, 0, *v.shape[-2:]))
    return LinkMotions(v, a, stack, solver.rcond), rows, solver


def known_sources(
    layout: Layout, forcing: Forcing, pose: Pose, moving: LinkMotions, inertia: bool
) -> dict[str, WrenchSource]:
    """Every known wrench by kind: dampers at the speeds of the motion, inertia where asked for."""
    twist = moving.twist
    sources = {
        "weight": fc.weight(layout, forcing.inertia, pose),
        "force": fc.force_wrench(layout, forcing.forces, pose),
        "couple": fc.couple_wrench(layout, forcing.couples, pose),
        "spring": fc.spring_wrench(layout, forcing.springs, pose, twist),
        "resistance": fc.resistance_wrench(layout, forcing.resistances, pose, twist),
    }
    if forcing.pushes is not None:
        sources["push"] = forcing.pushes
    if forcing.belts is not None:
        sources["belt"] = fc.belt_source(layout, forcing.belts, pose, twist)
    if inertia:
        sources["inertia"] = fc.inertia_wrench(
            layout, forcing.inertia, pose, moving.twist, moving.acceleration[..., :-1, :]
        )
    if forcing.turning is not None:
        square = turning_square(layout, forcing, pose, moving.virtual, sources)
        sources["turning"] = centrifugal(layout, forcing.inertia, forcing.turning, pose, square)
    return sources


class Statement(NamedTuple):
    """Equilibrium system A x + w = 0: the rows with unknown multipliers, A factored, and w with the known efforts (...,
    L, n)."""

    unknown: ConstraintRows
    forces: Factor
    w: Array


def statement(
    layout: Layout, known: Known, pose: Pose, rows: ConstraintRows, solver: Factor, w: Array
) -> Statement:
    """Unknowns and known terms, from total wrenches w (..., L, n) of loads."""
    unknown = _unknowns(layout, known, pose, rows)
    if known.requested.all() and not known.link.size:
        return Statement(unknown, _yielding(layout, unknown, solver), w)
    known_rows = rows.rows(layout.constraints.count + np.flatnonzero(~known.requested))
    w = w + total_wrench(layout, pair(known_rows, known.effort[..., ~known.requested]))
    return Statement(unknown, _yielding(layout, unknown, factor(layout, unknown)), w)


def _yielding(layout: Layout, unknown: ConstraintRows, forces: Factor) -> Factor:
    """The factored system with the joints' compliances, where reactions are not unique and some joint has a
    compliance."""
    if layout.compliance is None or not isinstance(forces, PseudoInverse):
        return forces
    rigid = np.zeros(len(unknown.i) - len(layout.compliance))
    return compliant(forces, np.concatenate([layout.compliance, rigid]))


def balance(
    layout: Layout,
    forcing: Forcing,
    known: Known,
    pose: Pose,
    moving: LinkMotions,
    rows: ConstraintRows,
    solver: Factor,
    w: Array,
) -> Equilibrium:
    """Solution of A x + w = 0 for total wrenches w (..., L, n)."""
    s = statement(layout, known, pose, rows, solver, w)
    x, total = _solve_balance(layout, forcing, pose, s.forces, s.w)
    return check_equilibrium(layout, forcing, known, pose, moving, s, x, total)


def check_equilibrium(
    layout: Layout,
    forcing: Forcing,
    known: Known,
    pose: Pose,
    moving: LinkMotions,
    s: Statement,
    x: Array,
    total: Array,
) -> Equilibrium:
    """Multipliers x by their meaning, with the residual and virtual power under total wrenches (..., L, n)."""
    count, count_efforts = layout.constraints.count, int(known.requested.sum())
    if layout.constraints.idle.size:
        x = x.copy()
        x[..., layout.constraints.idle] = 0.0
    effort = np.broadcast_to(known.effort, (*x.shape[:-1], len(known.requested))).copy()
    effort[..., known.requested] = x[..., count : count + count_efforts]
    sources = [pair(s.unknown, x)]
    residual, largest = _residual(layout, sources, total)
    power = _power(layout, known, moving, s.unknown, x, total, largest)
    free = s.forces.null if isinstance(s.forces, PseudoInverse) else None
    pushed = fc.between_wheels(layout, forcing, pose, moving.twist, x)
    parts = (x[..., :count], effort, x[..., count + count_efforts :])
    return Equilibrium(*parts, residual, power, s.forces.rcond, free, pushed)


NEAR = 1e-5
"""Squared pivot over its usual size below which programs leave a position to the careful path."""


def usual(layout: Layout, known: Known, pose: Pose) -> Flags:
    """True at poses (P, L+1, ...) from whose pivots those of other positions can be judged: so far from singular ones,
    and from those at which unknown loads have no power, that no pivot which is small beside theirs passes."""
    rows = stack_rows(layout, pose)
    rcond = _rcond(layout, rows)
    if known.link.size or not known.requested.all():
        rcond = np.minimum(rcond, _rcond(layout, _unknowns(layout, known, pose, rows)))
    return np.asarray(rcond > singular_below(layout) / np.sqrt(NEAR))


def _rcond(layout: Layout, rows: ConstraintRows) -> Array:
    """Reciprocal condition numbers (P,) of a square system with rows and columns of one size, whatever the unit of
    length, an arm that is next to none being none; of a large system, or one that is not square, as it is scaled to
    be solved."""
    if len(rows.i) != layout.unknowns or layout.unknowns > SPARSE:
        return factor(layout, rows).rcond
    scale = row_scale(layout, rows.angular)[:, None] * layout.column_scale
    return even_rcond(dense(layout, rows) * scale, singular_below(layout))


def _unknowns(layout: Layout, known: Known, pose: Pose, rows: ConstraintRows) -> ConstraintRows:
    """Rows with unknown multipliers."""
    count = layout.constraints.count
    kept = np.concatenate([np.arange(count), count + np.flatnonzero(known.requested)])
    unknown_rows = rows.rows(kept)
    return unknown_rows + load_rows(layout, known, pose) if known.link.size else unknown_rows


def load_rows(layout: Layout, known: Known, pose: Pose) -> ConstraintRows:
    """Unit unknown loads as rows between ground and their links."""
    g, size = layout.algebra, len(known.link)
    r = arm(g, pose, known.link, known.at)
    turned = g.rotate(pose.rotation[..., known.link, :], known.direction)
    force = np.where(known.follows[:, None], turned, known.direction)
    turned = g.rotate_couple(pose.rotation[..., known.link, :], known.about)
    about = np.where(known.follows[:, None], turned, known.about)
    wrench = np.concatenate([np.broadcast_to(force, r.shape), g.cross(r, force) + about], axis=-1)
    ground = np.full(size, layout.links)
    return ConstraintRows(ground, known.link, known.couple, np.zeros_like(wrench), wrench)


def _solve_balance(
    layout: Layout, forcing: Forcing, pose: Pose, forces: Factor, w: Array
) -> tuple[Array, Array]:
    """Multipliers and total wrenches with the teeth's separation.

    The radial tooth force depends on the tangential one by its magnitude only; where it does no work (centres at a
    fixed distance) the second solution is exact, else a few more are needed.
    """
    x = forces.forces(-w.reshape((*w.shape[:-2], -1)))
    if not forcing.follows_reactions:
        return x, w
    for _ in range(50):
        total = w + fc.following(layout, forcing, pose, x)
        new = forces.forces(-total.reshape((*total.shape[:-2], -1)))
        change = np.nan_to_num(np.abs(new - x)).max(initial=0.0)
        x = new
        if change <= 1e-14 * np.nan_to_num(np.abs(new)).max(initial=0.0):
            break
    return x, total


def _residual(layout: Layout, sources: list[WrenchSource], w: Array) -> tuple[Array, Array]:
    """Largest out-of-balance force or moment (over length) relative to the largest force, and that force."""
    scale = layout.wrench_scale
    out = np.abs((total_wrench(layout, *sources) + w) * scale).max(axis=(-2, -1), initial=0.0)
    largest = np.abs(w * scale).max(axis=(-2, -1), initial=0.0)
    for source in sources:
        largest = np.maximum(largest, np.abs(source.wrench * scale).max(axis=(-2, -1), initial=0.0))
    return relative(out, largest), largest


def relative(amount: Array, size: Array) -> Array:
    """An amount over a size; of a size 0 the amount itself."""
    return np.asarray(amount / np.where(size > 0, size, 1.0))


def _power(
    layout: Layout,
    known: Known,
    moving: LinkMotions,
    unknown: ConstraintRows,
    x: Array,
    w: Array,
    largest: Array,
) -> Array:
    """Virtual power of all loads and efforts at unit speed of each drive, over force times velocity; no reactions."""
    if not moving.virtual.shape[-3]:
        return np.zeros_like(largest)
    power = virtual_power(layout, moving.virtual, unknown, x, w)
    fastest = np.abs(moving.virtual / layout.wrench_scale).max(axis=(-2, -1), initial=0.0)
    return np.asarray(np.abs(relative(power, largest[..., None] * fastest)).max(axis=-1))


def virtual_power(layout: Layout, v: Array, unknown: ConstraintRows, x: Array, w: Array) -> Array:
    """Virtual power (..., D) of all loads and efforts at unit speed of each drive."""
    count = layout.constraints.count
    power = (v[..., :-1, :] * w[..., None, :, :]).sum(axis=(-2, -1))
    requested = unknown.rows(slice(count, None))
    applied = ConstraintRows(*requested[:3], requested.on_i[..., None, :, :], requested.on_j[..., None, :, :])
    return np.asarray(power + (rates(applied, v) * x[..., None, count:]).sum(axis=-1))


def _screw_rows(
    g: Algebra, constraints: Rows, pose: Pose, rows: ConstraintRows
) -> Iterator[tuple[int, Array]]:
    """Row of each screw, belt, rope, brake and cam, and the couple that accompanies its force, at j's point."""
    for f in constraints.families:
        if isinstance(f, Helix | BeltMesh | Strand | Lining | BandStrands | CamRow):
            about = g.cross(arm(g, pose, f.j, f.uj), rows.on_j[..., f.row, : g.d])
            for k, row in enumerate(f.row):
                yield int(row), rows.on_j[..., row, g.d :] - about[..., k, :]


def reactions(
    layout: Layout, pose: Pose, rows: ConstraintRows, equilibrium: Equilibrium
) -> tuple[Array, Array]:
    """Force (..., joints, d) and couple (..., joints, n - d) of each joint on its link j, at j's point (contact)."""
    g, constraints = layout.algebra, layout.constraints
    lead = equilibrium.constraint.shape[:-1]
    dtype = equilibrium.constraint.dtype
    force = np.zeros((*lead, layout.joints, g.d), dtype)
    couple = np.zeros((*lead, layout.joints, g.n - g.d), dtype)
    for turns, lot in constraints.lots:
        into, kind = (couple, slice(g.d, None)) if turns else (force, slice(None, g.d))
        into[..., constraints.joint[lot], :] += (
            equilibrium.constraint[..., lot, None] * rows.on_j[..., lot, kind]
        )
    for row, part in _screw_rows(g, constraints, pose, rows):
        couple[..., constraints.joint[row], :] += equilibrium.constraint[..., row, None] * part
    for f, pushed, _ in equilibrium.separation:
        for k, row in enumerate(f.row):
            force[..., constraints.joint[row], :] += pushed[..., k, :]
    return force, couple


def unique(shift: Array) -> Array:
    """True for reaction components (..., joints, n) that no null vector of A changes, from their ``shifts``."""
    return np.asarray(np.abs(shift).max(axis=-1, initial=0.0) < UNIQUE)


def shifts(layout: Layout, pose: Pose, rows: ConstraintRows, free: Array) -> tuple[Array, Array]:
    """Change of the reactions (..., joints, n, X) with each free multiplier, and which other unknowns (..., X - K)
    none of them changes."""
    g, constraints = layout.algebra, layout.constraints
    shift = np.zeros((*free.shape[:-2], layout.joints, g.n, free.shape[-1]))
    for k, joint in enumerate(constraints.joint):
        if joint >= 0:
            part = slice(g.d, None) if constraints.angular[k] else slice(None, g.d)
            shift[..., joint, part, :] += rows.on_j[..., k, part, None] * free[..., k, None, :]
    for row, couple in _screw_rows(g, constraints, pose, rows):
        shift[..., constraints.joint[row], g.d :, :] += couple[..., None] * free[..., row, None, :]
    others = free[..., constraints.count :, :]
    return shift, np.abs(others).max(axis=-1, initial=0.0) < UNIQUE


UNIQUE = 1e-8
"""A component is unique where the projector on free multipliers moves it less than this (unit multipliers)."""
