"""Axial force, shear, torsion and bending moment along the members of a link, at every position.

N = F.t (tension +), V_y = -F.y, V_z = F.z, T = M.t with F, M what the part beyond s exerts on the part before it, about
the cut; dN/ds = -q_t, dV_y/ds = q_y, dV_z/ds = -q_z, dM_z/ds = V_y, dM_y/ds = V_z with q = mu (g - a).

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.output.rounding import PART, sizes
from dalembert.answer.column import Column, Scale
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Flags, Tree, first_largest
from dalembert.core.equilibrium import UNIQUE
from dalembert.errors import ModelError
from dalembert.machine.members.link_balance import LinkBalance, Loads, Wrench, acting
from dalembert.machine.members.mass_along import mass_layout
from dalembert.machine.members.straight_members import Straight, beyond, members_of
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.methods.applied_forces import Action
    from dalembert.analysis.result.result import Result
    from dalembert.machine.members.buckling import Buckling, Factors
    from dalembert.machine.members.deflections import Deflections
    from dalembert.machine.members.stresses import Stresses
    from dalembert.model.links.sections import Section

ORDER = ("axial", "shear", "shear z", "torsion", "bending y", "bending")
"""Rows of the inner forces: N, V_y, V_z, T, M_y, M_z."""
IN_PLANE = ("axial", "shear", "bending")


def kind_of(of: str) -> str:
    """Kind of one of ``ORDER``."""
    return "force" if ORDER.index(of) < 3 else "moment"


@dataclass(frozen=True, eq=False)
class MemberCurve(Compared):
    """Inner forces of one straight member: ``edges`` (P, J + 1), m, and cubics (P, J, 6, 4) in s between them."""

    member: Straight
    edges: Array = field(repr=False)
    cubics: Array = field(repr=False)

    @property
    def name(self) -> str:
        """Its ends."""
        return "-".join(self.member.ends)

    @property
    def jumps(self) -> Array:
        """Ends of the pieces (J,) that keep their places."""
        known = self.edges[np.isfinite(self.edges).all(axis=1)]
        return known[0, np.ptp(known, axis=0) <= 1e-9 * self.member.length] if len(known) else known.ravel()

    def at(self, s: float | Array, side: Literal["before", "behind"] | None = None) -> Array:
        """All six (P, S, 6) at distances s (S,) from the start, m; at a force or couple on the side asked for.

        By default what is just behind it, at the end of the member what is before it.
        """
        places = self.member.rounded(np.atleast_1d(np.asarray(s, float)))
        if (places < 0).any() or (places > self.member.length).any():
            raise ModelError(f"{s} m is not along member {self.name}", f"give 0 to {self.member.length:g} m")
        before = (places == self.member.length) if side is None else np.full(len(places), side == "before")
        inner = self.edges[:, 1:-1, None]
        piece = np.where(before, (inner < places).sum(axis=1), (inner <= places).sum(axis=1))
        chosen = np.take_along_axis(self.cubics, piece[:, :, None, None], axis=1)
        return np.asarray((chosen * places[:, None, None] ** np.arange(4)).sum(axis=-1))

    def extremes(self, of: str) -> tuple[Array, Array, Array, Array]:
        """Least and greatest value (P,) of one of ``ORDER``, each with its place (P,), m: least, at, greatest, at.

        Exact: ends of the pieces and the zeros of the derivative, which is a quadratic. NaN where a piece has none.
        """
        c = self.cubics[:, :, ORDER.index(of), :]
        low, high = self.edges[:, :-1], self.edges[:, 1:]
        s = np.stack([low, high, *_stationary(c)], axis=-1)
        inside = (s >= low[..., None]) & (s <= high[..., None]) & (high > low)[..., None]
        s = np.where(inside, s, low[..., None])
        values = np.where(inside, (c[..., None, :] * s[..., None] ** np.arange(4)).sum(axis=-1), np.nan)
        hidden = (np.isnan(c).any(axis=-1) & (high > low)).any(axis=1)
        values[hidden], s[hidden] = np.nan, np.nan
        flat, places = values.reshape(len(values), -1), s.reshape(len(values), -1)
        every, none = np.arange(len(flat)), np.isnan(flat)
        down, up = np.where(none, np.inf, flat).argmin(axis=1), np.where(none, -np.inf, flat).argmax(axis=1)
        return flat[every, down], places[every, down], flat[every, up], places[every, up]

    def greatest(self, of: str) -> tuple[Array, Array]:
        """The value largest in size (P,) of one of ``ORDER`` and its place (P,), m."""
        least, at_least, most, at_most = self.extremes(of)
        down = -least > most
        return np.where(down, least, most), np.where(down, at_least, at_most)


def _stationary(c: Array) -> tuple[Array, Array]:
    """Zeros of the derivative of cubics (..., 4), NaN where it has none; a quadratic has one."""
    a, b, k = 3 * c[..., 3], 2 * c[..., 2], c[..., 1]
    with np.errstate(all="ignore"):
        q = -0.5 * (b + np.copysign(np.sqrt(b * b - 4 * a * k), b))
        return q / a, k / q


@dataclass(frozen=True, eq=False)
class MemberForces(Compared):
    """Internal forces of a link: a curve for each straight member; ``residual`` (P,), the equilibrium error.

    ``residual``: force and moment that do not close at the end, over the largest on the link, or over 1e-12 of the
    largest in the mechanism where that is more; NaN where unknown.
    ``brackets``: joints and loads beside the members, with the distance in m; the bracket is not analysed.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> f = da.member_forces(da.dynamics(da.load(examples()["four_bar"])), "rocker")
    >>> bool(f.residual.max() < 1e-9)
    True
    """

    result: Result = field(repr=False)
    link: str
    curves: tuple[MemberCurve, ...]
    residual: Array = field(repr=False)
    brackets: dict[str, float] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """The inner forces that there are, of ``ORDER``: three in the plane, six in space."""
        return IN_PLANE if self.result.mechanism.dimension == 2 else ORDER

    def curve(self, member: str | None = None) -> MemberCurve:
        """The curve of one member, by its name `A-B`; the only one by default."""
        known = {c.name: c for c in self.curves}
        if member is None and len(known) == 1:
            return self.curves[0]
        if member not in known:
            raise ModelError(f"link {self.link!r} has no member {member!r}", closest(str(member), [*known]))
        return known[member]

    def at(
        self, s: float | Array, member: str | None = None, side: Literal["before", "behind"] | None = None
    ) -> dict[str, Array]:
        """Inner forces by name, (P,) at a distance s from the start of a member, (P, S) at several."""
        values = self.curve(member).at(s, side)
        values = values[:, 0] if np.ndim(s) == 0 else values
        return {n: values[..., ORDER.index(n)] for n in self.names}

    def largest(self, of: str) -> tuple[float, str, float, int]:
        """Over the cycle: the value largest in size, its member, place (m) and position (from 0)."""
        values, places = np.moveaxis(np.array([curve.greatest(of) for curve in self.curves]), 1, 0)
        known = np.isfinite(values).all(axis=0)
        if not known.any():
            return math.nan, self.curves[0].name, math.nan, 0
        j, k = divmod(first_largest(np.where(known, np.abs(values), np.nan)), values.shape[1])
        return float(values[j, k]), self.curves[j].name, float(places[j, k]), int(k)

    def unknown(self) -> dict[str, list[str]]:
        """Positions ("3" or "3-7", from 1), and the inner forces that are not known at them all along the link."""
        values = {of: np.sum([curve.greatest(of)[0] for curve in self.curves], axis=0) for of in self.names}
        out = {}
        for which, _, _ in self.result.problems():
            first, _, last = which.partition("-")
            run = slice(int(first) - 1, int(last or first))
            out[which] = [of for of in self.names if np.isnan(values[of][run]).any()]
        return {which: some for which, some in out.items() if some}

    def stress(self, section: Section | Tree | None = None) -> Stresses:
        """Stresses of a section, by default that of the file, with safety against yield and fatigue."""
        from dalembert.machine.members.stresses import stresses

        return stresses(self, section)

    def buckling(
        self,
        section: Section | Tree | None = None,
        ends: Factors | None = None,
        length_factor: Factors | None = None,
    ) -> Buckling:
        """Critical compression of the link as a column, by Euler or Johnson, beside that of the cycle.

        ``ends`` or ``length_factor``: its effective length factor K, or (in the plane, across it), instead of that of
        its joints.
        """
        from dalembert.machine.members.buckling import buckling

        return buckling(self, section, length_factor if ends is None else ends)

    def deflection(self, section: Section | Tree | None = None, supports: Sequence[str] = ()) -> Deflections:
        """Deflection and slope of its members, by Young's modulus of the section, from the line through its supports.

        By default the tangent at a weld or a driven joint, else the chord through the two outermost joints.
        """
        from dalembert.machine.members.deflections import deflections

        return deflections(self, section, supports)

    def columns(self) -> Iterator[Column]:
        """Least and greatest of each inner force, with places."""
        for curve in self.curves:
            name = self.link if len(self.curves) == 1 else f"{self.link}.{curve.name}"
            for of in self.names:
                for k, values in enumerate(curve.extremes(of)):
                    word, kind = ("low", "high")[k // 2], "length" if k % 2 else kind_of(of)
                    yield Column(f"{of}.{name}.{word}{'.place' * (k % 2)}", kind, values)
        yield Column(f"residual.{self.link}", "number", self.residual)

    def record(self, to: Scale) -> Tree:
        """The largest over the cycle, by name, in the units of a scale."""
        out: Tree = {}
        for of in self.names:
            value, member, place, k = self.largest(of)
            entry = {"largest": to(kind_of(of), value), "member": member, "at": to("length", place)}
            out[of] = entry | {"position": None if math.isnan(value) else k + 1}
        if self.brackets:
            out["brackets"] = {of: to("length", size) for of, size in self.brackets.items()}
        unknown = self.unknown()
        return out | {"unknown": unknown} if unknown else out


def member_forces(r: Result, link: str) -> MemberForces:
    """Axial force, shear and bending moment inside a link, in space also torsion and both planes, at any place.

    The link is its `members`, straight lines between its points, or the line through its joints. Its mass lies along
    them as `mass_along` says; what of mass, centre and inertia that leaves over acts at the mass centre, so that every
    link is in balance (``residual``). What acts beside the line does so by a stiff bracket at its foot. Where reactions
    are not unique, an inner force is a number if all of them give the same, else NaN. Raises ModelError for a link
    without length, and for one whose joints are on no line.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> f = da.member_forces(da.dynamics(da.load(examples()["four_bar"])), "rocker")
    >>> bool(f.residual.max() < 1e-9), sorted(f.at(0.05))
    (True, ['axial', 'bending', 'shear'])
    """
    return forces_inside(r, link, acting(r))


def forces_inside(r: Result, link: str, sets: list[tuple[Action, ...]]) -> MemberForces:
    """The same with what acts on all links."""
    if link not in r.links:
        raise ModelError(f"unknown moving link {link!r}", closest(link, list(r.links)))
    if r.mechanism.turning is not None and r.mechanism.links[link].mass_along != "lumped":
        raise ModelError(
            f"the mass of link {link!r} lies along it, and in a plane that turns its centrifugal force is known "
            "only as a sum at the mass centre",
            "write mass_along: lumped; the inner forces are then those of a mass at its centre",
            ("links", link, "mass_along"),
        )
    body = LinkBalance(r, link, sets)
    members = members_of(r.mechanism, link, body.joints())
    loads, far = body.loads(members, mass_layout(r.mechanism, link, members)), beyond(members)
    curves = tuple(_curve(body, e, k, far[k], loads) for k, e in enumerate(members))
    return MemberForces(r, link, curves, _residual(body, curves, loads, far), body.brackets(members))


def _curve(body: LinkBalance, e: Straight, k: int, far: Flags, loads: Loads) -> MemberCurve:
    """Cubics of member number k: sums of what is beyond each piece, and the mass on it."""
    count, mine = len(body.rotation), [p for p, _ in loads.spread if p.member == k]
    masses = {0.0, e.length, *(x for p in mine for x in (p.start, p.end))}
    feet = [np.where(w.member == k, w.foot, 0.0) for w in loads.seated if (w.member == k).any()]
    fixed = [np.full(count, x) for x in masses]
    edges = np.sort(np.stack([*feet, *fixed], axis=1), axis=1)
    low, high = edges[:, :-1], edges[:, 1:]
    cubics, *free = (np.zeros((count, high.shape[1], 6, 4)) for _ in range(1 + len(loads.free)))
    for into, wrenches in zip((cubics, *free), (loads.seated, *loads.free), strict=True):
        for w in wrenches:
            on = (w.member == k)[:, None] & (w.foot[:, None] >= high)
            _add(into, e, np.asarray(on | far[w.member][:, None]), w)
    for p, w in loads.spread:
        if far[p.member]:
            _add(cubics, e, np.ones_like(high, bool), w)
    c0, c1 = (v @ e.axes.T for v in body.distributed(e))
    for p in mine:
        covered = np.asarray((low >= p.start) & (high <= p.end), float)
        _add_mass(cubics, edges, p.density * covered, c0, c1)
        couple = body.turning_couple(p.inertia) @ e.axes.T
        _add_couple(cubics, edges, covered[..., None] * couple[:, None, :])
    for moved in free:
        cubics[(np.abs(moved) > UNIQUE).any(axis=-1)] = np.nan
    placed = np.all([np.isfinite(w.foot) for w in loads.seated], axis=0)
    cubics[~placed] = np.nan  # nor is it known where they act
    return MemberCurve(e, edges, cubics)


def _add(cubics: Array, e: Straight, on: Flags, w: Wrench) -> None:
    """Inner forces of a wrench where it is beyond the cut (P, J)."""
    force, moment = w.force @ e.axes.T, w.about(e.start) @ e.axes.T
    n, y, z = (np.where(on, force[:, i, None], 0.0) for i in range(3))
    cubics[:, :, 0, 0] += n
    cubics[:, :, 1, 0] -= y
    cubics[:, :, 2, 0] += z
    cubics[:, :, 3:, 0] += np.where(on[..., None], moment[:, None, :], 0.0)
    cubics[:, :, 4, 1] += z
    cubics[:, :, 5, 1] -= y


def _add_mass(cubics: Array, edges: Array, density: Array, c0: Array, c1: Array) -> None:
    """Inner forces of mass (P, J) per length under q = density (c0 - c1 s), both (P, 3) in member axes."""
    low, u = edges[:, :-1], edges[:, 1:]
    on = [density * (u**n - low**n) / n for n in (1, 2, 3)]
    s0, s1, s2 = (
        np.cumsum(m[:, ::-1], axis=1)[:, ::-1] - m + density * u**n / n for n, m in enumerate(on, 1)
    )
    c0, c1 = c0[:, None, :], c1[:, None, :]
    s0, s1, s2, mu = (x[..., None] for x in (s0, s1, s2, density))
    force = np.stack([c0 * s0 - c1 * s1, -mu * c0, mu * c1 / 2, np.zeros_like(mu * c0)], axis=-1)
    arm = np.stack([c0 * s1 - c1 * s2, c1 * s1 - c0 * s0, mu * c0 / 2, -mu * c1 / 6], axis=-1)
    cubics[:, :, 0] += force[:, :, 0]
    cubics[:, :, 1] -= force[:, :, 1]
    cubics[:, :, 2] += force[:, :, 2]
    cubics[:, :, 4] -= arm[:, :, 2]
    cubics[:, :, 5] += arm[:, :, 1]


def _add_couple(cubics: Array, edges: Array, couple: Array) -> None:
    """Inner moments of a couple per length (P, J, 3) in member axes: the rotary inertia of the sections."""
    low, high = edges[:, :-1, None], edges[:, 1:, None]
    on = couple * (high - low)
    behind = np.cumsum(on[:, ::-1], axis=1)[:, ::-1] - on
    cubics[:, :, 3:, 0] += behind + couple * high
    cubics[:, :, 3:, 1] -= couple


def _residual(body: LinkBalance, curves: tuple[MemberCurve, ...], loads: Loads, far: Flags) -> Array:
    """Sum of all forces and moments on the link about its centre, and at both ends of each member the difference of
    its curves from all that acts beyond; over the largest of these forces and moments. Where these are rounding beside
    the forces of the mechanism, over what is."""
    wrenches = [*loads.seated, *(w for _, w in loads.spread)]
    forces = np.array([w.force for w in wrenches])
    moments = np.array([w.about(body.center) for w in wrenches])
    length = body.r.compiled.layout.length
    largest = [float(np.nanmax(np.abs(x), initial=0.0)) for x in (forces, moments)]
    rounding = PART * float(np.nanmax(sizes(body.r)["force"], initial=0.0))
    size = max(largest[0], largest[1] / length, rounding) or 1.0
    off = [np.abs(x.sum(axis=0)).max(axis=1) for x in (forces, moments)]
    gaps = [off[0], off[1] / length]
    for k, curve in enumerate(curves):
        for at_end in (False, True):
            gap = np.abs(_inner(curve, at_end) - _beyond(loads, curve.member, k, far[k], at_end))
            gaps += [gap[:, :3].max(axis=1), gap[:, 3:].max(axis=1) / length]
    return np.asarray(np.fmax.reduce(gaps) / size)


def _inner(curve: MemberCurve, at_end: bool) -> Array:
    """Force, then moment about the member's start (P, 6), on one of its ends by what is beyond, in member axes."""
    s = curve.member.length if at_end else 0.0
    inner = curve.at(s)[:, 0]
    force = inner[:, :3] * [1.0, -1.0, 1.0]
    return np.concatenate([force, inner[:, 3:] + np.cross([s, 0.0, 0.0], force)], axis=1)


def _beyond(loads: Loads, e: Straight, k: int, far: Flags, at_end: bool) -> Array:
    """The same by summing the forces beyond: all except those with their base point at the start, or only those at the
    end."""
    axes = np.kron(np.eye(2), e.axes.T)
    total = np.zeros((len(loads.seated[0].force), 6))
    for w in loads.seated:
        mine = (w.foot >= e.length) if at_end else (w.foot > 0.0)
        on = far[w.member] | ((w.member == k) & mine)
        total += np.where(on[:, None], np.concatenate([w.force, w.about(e.start)], axis=1) @ axes, 0.0)
    for p, w in loads.spread:
        if far[p.member] or (p.member == k and not at_end):
            total += np.concatenate([w.force, w.about(e.start)], axis=1) @ axes
    return total
