"""Closed-form placement of planar linkages group by group (``assur_plan``): two-link groups (dyads).

At known angles the conditions of a group are linear in the places of its links, so that only its angles are unknown.
Links that slide on each other share an angle. PRP and RPP dyads have no unknown angle; RRP, RPR and a pin in a slot
have one, where the determinant of the conditions is a trigonometric polynomial of it; RRR has two, where two circles
intersect and one angle follows from the other. Larger groups (triads) are solved by Newton from many angles.

S  poses that are placed together
side  sign of the determinant of a group's Jacobian, which distinguishes its two branches

Mechanics: docs/theory.md 3.1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.arrays import Array, Flags, Index, Ints
from dalembert.core.linear import apply, generalized_inverse, solve_square
from dalembert.core.position.assur_plan import AssurGroup, PlacementPlan
from dalembert.core.position.newton import LONGEST_TURN

TOUCHING = 1e-8
"""Excess of a cosine over 1 up to which circles are treated as touching; Newton then decides."""

NEGLIGIBLE = 1e-9
"""Part of the largest coefficient of a trigonometric polynomial that counts as 0."""

STARTS, STEPS = 64, 40
"""Starts and steps of Newton for a group that has no closed form."""

CLOSE = 1e-9
"""Gap over the group's size above which such a group does not close."""


class Laid(NamedTuple):
    """Partly placed poses (S, L+1, ...), NaN where not yet placed; the sides of their groups (S, G), 0 if unknown."""

    point: Array
    turn: Array
    side: Array

    def at(self, index: Index) -> Laid:
        return Laid(*(part[index] for part in self))


class GroupPart(NamedTuple):
    """Part of the poses (S,) that a group involves: places and angles of its links, their angles relative to their
    leaders (S, n), and the targets of its conditions (S, K)."""

    point: Array
    turn: Array
    off: Array
    target: Array

    def at(self, index: Index) -> GroupPart:
        return GroupPart(*(part[index] for part in self))


def place_ground(p: PlacementPlan, target: Array) -> Laid:
    """Places the ground and the links whose angles follow from it, at targets (S, K + D)."""
    count = len(target)
    turn = np.full((count, p.links + 1), np.nan)
    point = np.full((count, p.links + 1, 2), np.nan)
    turn[:, -1], point[:, -1] = 0.0, 0.0
    for new, known, sign, row in p.turns:
        turn[:, new] = turn[:, known] + sign * target[:, row]
    return Laid(point, turn, np.zeros((count, 0)))


def offsets(p: PlacementPlan, target: Array) -> Array:
    """Angles of the links relative to their leaders (S, L+1)."""
    off = np.zeros((len(target), p.links + 1))
    for new, known, sign, row in p.turns:
        off[:, new] = off[:, known] + sign * target[:, row]
    return off


def place_group(group: AssurGroup, placed: Laid, target: Array, off: Array) -> tuple[Ints, Laid]:
    """All branches of a group: the index of the pose (S,) that each starts from, and the poses with it placed."""
    part = _part(group, placed, target, off)
    if group.separate:
        placed.point[:, group.links[group.link], group.axis] = _places(group, part)
        return np.arange(len(target)), placed._replace(
            side=np.column_stack([placed.side, np.zeros(len(target))])
        )
    branches = _branches(group, part)
    which, branch = np.nonzero(np.isfinite(branches).all(axis=-1))
    part = part.at(which)
    _turn(group, part, branches[which, branch])
    _place_links(group, part, _places(group, part))
    if group.closed:
        side = np.sign(np.linalg.det(jacobian(group, part)))
    else:
        good = np.flatnonzero(_newton(group, part))
        kept = good[_distinct(group, which[good], part.at(good))]
        which, part, side = which[kept], part.at(kept), np.zeros(len(kept))
    new = placed.at(which)
    new.point[:, group.links], new.turn[:, group.links] = part.point, part.turn
    return which, new._replace(side=np.column_stack([new.side, side]))


def _part(group: AssurGroup, placed: Laid, target: Array, off: Array) -> GroupPart:
    links = group.links
    return GroupPart(
        placed.point[:, links], placed.turn[:, links], off[:, links], target[:, group.conditions.row]
    )


def _branches(group: AssurGroup, part: GroupPart) -> Array:
    """Unknown angles (S, branches, angles) of a group, NaN beyond its last branch; starting angles where it has no
    formula."""
    count = len(group.turning)
    if not group.closed:
        steps = np.modf(np.sqrt(np.arange(2, 2 + count) + 0.5) * 1.6180339887)[0]
        starts = 2 * np.pi * np.modf(0.5 + np.arange(STARTS)[:, None] * steps)[0] - np.pi
        return np.broadcast_to(starts, (len(part.turn), STARTS, count))
    if count == 0:
        return np.zeros((len(part.turn), 1, 0))
    if count == 1:
        degree = 1 + group.sliding
        angles = np.arange(2 * degree + 1) * 2 * np.pi / (2 * degree + 1)
        samples = [_determinant(group, part, angle) for angle in angles]
        return _roots(np.stack(samples, axis=-1))[..., None]
    return _circles(group, part)


def _determinant(group: AssurGroup, part: GroupPart, angle: float) -> Array:
    """Determinant (S,) of the conditions at an angle: 0 where they have a common solution."""
    part = part._replace(turn=part.turn.copy())
    _turn(group, part, np.full((len(part.turn), 1), angle))
    matrix, constant = _system(group, part, plane.rotation(part.turn))
    return np.asarray(np.linalg.det(np.concatenate([matrix, constant[..., None]], axis=-1)))


def _circles(group: AssurGroup, part: GroupPart) -> Array:
    """Two angles: after elimination of the places the conditions are w + M1 u1 + M2 u2 = 0 with unit vectors u."""
    none = plane.rotation(part.turn)
    for links in group.turning:
        none[:, links] = 0.0
    n, constant = _constant(group, part, none)
    ri, rj, _ = _arms(group, plane.rotation(part.off))
    arms = [_turned_arms(turned, ri, rj) for turned in group.turned]
    columns = [(n * _where(n, turned)).sum(axis=-1) for arm in arms for turned in (arm, plane.across(arm))]
    if group.link.size:
        matrix = _matrix(group, n)
        free = np.linalg.qr(matrix, mode="complete")[0][..., matrix.shape[-1] :]
        constant, *columns = (np.einsum("skc,sk->sc", free, k) for k in (constant, *columns))
    one, two = np.stack(columns[:2], axis=-1), np.stack(columns[2:], axis=-1)
    back = _inverse(two)

    def second(unit: Array) -> Array:
        """The second unit vectors (S, m, 2) by the first ones."""
        return -apply(back[:, None], apply(one[:, None], unit) + constant[:, None])

    samples = second(plane.rotation(np.arange(5) * 2 * np.pi / 5))
    first = _roots((samples**2).sum(axis=-1) - 1.0)
    u = second(plane.rotation(first))
    return np.stack([first, np.arctan2(u[..., 1], u[..., 0])], axis=-1)


def _inverse(matrix: Array) -> Array:
    """Inverses of matrices (S, 2, 2)."""
    (a, b), (c, d) = np.moveaxis(matrix, (-2, -1), (0, 1))
    turned = np.stack([np.stack([d, -b], axis=-1), np.stack([-c, a], axis=-1)], axis=-2)
    return np.asarray(turned / (a * d - b * c)[..., None, None])


def _roots(samples: Array) -> Array:
    """Angles (S, m) at which trigonometric polynomials are 0, given at evenly spaced angles (S, 2 degree + 1)."""
    factors = np.fft.rfft(samples, axis=-1) / samples.shape[-1]
    size = np.abs(factors).max(axis=-1, keepdims=True, initial=0.0)
    degree = int(np.flatnonzero((np.abs(factors) > NEGLIGIBLE * size).any(axis=0)).max(initial=1))
    if degree == 1:
        cosine = -factors[:, 0].real / (2 * np.abs(factors[:, 1]))
        cosine = np.where(np.abs(cosine) <= 1 + TOUCHING, np.clip(cosine, -1, 1), np.nan)
        middle = -np.angle(factors[:, 1])
        return np.stack([middle + np.arccos(cosine), middle - np.arccos(cosine)], axis=-1)
    out = np.full((len(samples), 2 * degree), np.nan)
    for k, one in enumerate(factors[:, : degree + 1]):
        if np.isfinite(one).all():
            z = np.roots(np.concatenate([one[:0:-1], one.conj()]))
            z = z[np.abs(np.abs(z) - 1) < np.sqrt(TOUCHING)]
            out[k, : len(z)] = np.angle(z)
    return out


def _turn(group: AssurGroup, part: GroupPart, angle: Array) -> None:
    """Sets the angles (S, angles) of a group's links."""
    for k, links in enumerate(group.turning):
        part.turn[:, links] = angle[:, k, None] + part.off[:, links]


def _place_links(group: AssurGroup, part: GroupPart, places: Array) -> None:
    part.point[:, group.link, group.axis] = places


def _arms(group: AssurGroup, rotation: Array) -> tuple[Array, Array, Array]:
    """Arms on i and j and the axes (S, K, 2), in ground axes."""
    c = group.conditions
    ri, rj, n = (
        np.where(some, plane.rotate(rotation[:, link], u), 0.0)
        for some, link, u in zip(group.some, (c.i, c.j, c.frame), (c.ui, c.uj, c.axis), strict=True)
    )
    return ri, rj, n


def _turned_arms(turned: tuple[Flags, ...], ri: Array, rj: Array) -> Array:
    """Arms (S, K, 2) of the links that turn with an unknown angle, those on i with the opposite sign."""
    return np.where(turned[1], rj, 0.0) - np.where(turned[0], ri, 0.0)


def _system(group: AssurGroup, part: GroupPart, rotation: Array) -> tuple[Array, Array]:
    """Conditions matrix (S, K, p) times places plus constant (S, K) are 0, at given rotations (S, n, 2)."""
    n, constant = _constant(group, part, rotation)
    return _matrix(group, n), constant


def _matrix(group: AssurGroup, n: Array) -> Array:
    """Derivatives (S, K, p) of the conditions by the places."""
    return _where(group.incidence, n[..., group.axis]) * group.incidence


def _constant(group: AssurGroup, part: GroupPart, rotation: Array) -> tuple[Array, Array]:
    """The axes (S, K, 2) of the conditions, and their values with all places at 0 (S, K)."""
    c = group.conditions
    point = part.point.copy()
    point[:, group.link, group.axis] = 0.0
    ri, rj, n = _arms(group, rotation)
    span = _where(n, point[:, c.j] + rj - point[:, c.i] - ri)
    return n, (n * span).sum(axis=-1) - part.target


def _where(factor: Array, value: Array) -> Array:
    """The value where its factor is not 0: unknown values do not matter elsewhere."""
    return np.where(factor == 0, 0.0, value)


def _places(group: AssurGroup, part: GroupPart) -> Array:
    """Places (S, p) at known angles, by least squares where there are more conditions than places."""
    if not group.link.size:
        return np.zeros((len(part.turn), 0))
    if group.separate:
        n, constant = _constant(group, part, plane.rotation(part.turn))
        diagonal = np.arange(len(group.link))
        return np.asarray(-constant / (n[:, diagonal, group.axis] * group.incidence[diagonal, diagonal]))
    near = ~group.conditions.far
    matrix, constant = _system(group, part, plane.rotation(part.turn))
    if near.sum() < len(group.link):
        return -apply(generalized_inverse(matrix[:, near]), constant[:, near])
    q, r = np.linalg.qr(matrix[:, near])
    return solve_square(r, -np.einsum("skp,sk->sp", q, constant[:, near]))


def _lines(group: AssurGroup, part: GroupPart) -> tuple[Array, Array, Array, Array]:
    """Arms on i and j, the axes n and the vectors between the points of the conditions (S, K, 2)."""
    c = group.conditions
    ri, rj, n = _arms(group, plane.rotation(part.turn))
    span = part.point[:, c.j] + rj - part.point[:, c.i] - ri
    n = np.where(c.far[:, None], span / np.linalg.norm(span, axis=-1, keepdims=True), n)
    return ri, rj, n, span


def jacobian(group: AssurGroup, part: GroupPart) -> Array:
    """Derivatives (S, K, angles + p) of a group's conditions by its angles and places."""
    ri, rj, n, span = _lines(group, part)
    columns = []
    for turned in group.turned:
        arm = plane.across(_turned_arms(turned, ri, rj))
        column = (n * _where(n, arm)).sum(axis=-1)
        if turned[2].any():
            axis = np.where(turned[2], plane.across(n), 0.0)
            column = column + (axis * _where(axis, span)).sum(axis=-1)
        columns.append(column)
    places = _matrix(group, n)
    return np.concatenate([np.stack(columns, axis=-1), places], axis=-1) if columns else places


def _newton(group: AssurGroup, part: GroupPart) -> Flags:
    """Newton for a group without a closed form; flags for the poses (S,), changed in place, that close."""
    count, heads = len(group.turning), [links[0] for links in group.turning]
    for _ in range(STEPS):
        step = np.nan_to_num(-solve_square(jacobian(group, part), _gap(group, part)))
        step /= np.maximum(1.0, np.abs(step[:, :count]).max(axis=-1, initial=0.0) / LONGEST_TURN)[:, None]
        _turn(group, part, part.turn[:, heads] - part.off[:, heads] + step[:, :count])
        _place_links(group, part, part.point[:, group.link, group.axis] + step[:, count:])
    size = np.abs(_lines(group, part)[-1]).max(axis=(1, 2)) + np.abs(part.target).max(axis=1)
    return np.asarray(np.abs(_gap(group, part)).max(axis=-1) <= CLOSE * size)


def _gap(group: AssurGroup, part: GroupPart) -> Array:
    """Residuals of the conditions (S, K)."""
    _, _, n, span = _lines(group, part)
    return np.asarray((n * span).sum(axis=-1) - part.target)


def _distinct(group: AssurGroup, which: Ints, part: GroupPart) -> Ints:
    """Indices of distinct branches, where several starts have converged to the same one."""
    places = part.point[:, group.link, group.axis]
    turned = plane.rotation(part.turn[:, [links[0] for links in group.turning]])
    size = max(float(np.abs(places).max(initial=0.0)), 1e-300)
    rounded = np.column_stack(
        [which, turned.reshape(len(which), 2 * len(group.turning)), places / size]
    ).round(6)
    return np.sort(np.unique(rounded, axis=0, return_index=True)[1])


def sides(p: PlacementPlan, turn: Array, point: Array, target: Array) -> Array:
    """The side (S, G) of each group at given angles (S, L+1) and places, which need not close; 0 where not known.

    Unknown values are NaN; they do not matter where a side does not depend on them: that of an RRR dyad depends on its
    two angles alone.
    """
    point, side = point.copy(), np.zeros((len(turn), len(p.groups)))
    point[:, -1] = 0.0
    for k, group in enumerate(p.groups):
        part = _part(group, Laid(point, turn, side), target, turn)
        places = part.point[:, group.link, group.axis]
        _place_links(group, part, np.where(np.isnan(places), _places(group, part), places))
        point[:, group.links] = part.point
        if group.closed and not group.separate:
            side[:, k] = np.nan_to_num(np.sign(np.linalg.det(jacobian(group, part))))
    return side
