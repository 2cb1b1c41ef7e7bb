"""Equilibrium of every link at one position, in ground axes about the origin: C x + w = 0, joint by joint.

Friction and the separating force of teeth are put into the columns: a pin's force acts on the tangent point of its
friction circle, a guide's or a tooth's at its angle from the normal. So the equations stay linear in what is sought.

Mechanics: docs/theory.md 7.1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, full_actions, joint_place, other_actions, state
from dalembert.analysis.methods.band_actions import has_strands
from dalembert.arrays import Array
from dalembert.core.constraints import dense
from dalembert.core.equilibrium import known_sources, statement
from dalembert.core.forcing import total_wrench
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

ROUNDING = 1e-9
"""Part of the largest below which a coefficient or a force is rounding."""


@dataclass
class UnknownForce:
    """Unknowns of a joint, a drive or a load: c numbers, the last of its links being the one they act on.

    ``columns`` (L, n, c): the wrench of one of each on every link; ``force`` (d, c): on the last link; ``at``: where;
    ``value`` (c,): the answer's. ``turned``: why its line of action is not that of the frictionless joint.
    """

    name: str
    kind: Literal["joint", "effort", "load"]
    links: tuple[str, ...]
    columns: Array
    force: Array
    at: Array
    value: Array
    turned: Literal["", "circle", "angle"] = ""


def cross(place: Array, force: Array) -> Array:
    """Moment of forces (..., d, c) at a place (d,): (1 or 3, c)."""
    if len(place) == 2:
        return np.asarray(place[0] * force[..., 1:2, :] - place[1] * force[..., 0:1, :])
    return np.moveaxis(np.cross(place, np.moveaxis(force, -1, -2)), -1, -2)


def wrench_of(a: Action, k: int = 0) -> Array:
    """Wrench (n,) of an action about the origin."""
    couple = np.atleast_1d(a.couple[k])
    return np.concatenate([a.force[k], couple + cross(a.at[k], a.force[k][:, None])[:, 0]])


class ForceEquations:
    """Unknowns and known wrenches of all links of a result at position ``k``."""

    def __init__(self, r: Result, k: int = 0) -> None:
        self.r, self.k, self.links = r, k, r.links
        layout = r.compiled.layout
        self.d, self.n, self.length = layout.algebra.d, layout.algebra.n, layout.length
        self.unknowns: list[UnknownForce] = []
        self.friction: list[Action] = []
        raw = self._columns()
        self._joints(raw)
        self._others(raw[..., layout.constraints.count :])
        sought = {u.name for u in self.unknowns if u.kind != "joint"}
        others = [a for a in other_actions(r) if not (a.kind in ("effort", "load") and a.of in sought)]
        self.known = [a for a in (*others, *self.friction) if a.link != GROUND]

    def _columns(self) -> Array:
        """Columns (L, n, X) of all unknowns about the origin."""
        r, k = self.r, self.k
        c, s = r.compiled, state(r)
        w = total_wrench(c.layout, *known_sources(c.layout, c.forcing, s.pose, s.moving, r.inertia).values())
        w = np.broadcast_to(w, (len(r.status), *w.shape[1:]))
        with np.errstate(all="ignore"):
            stated = statement(c.layout, c.known, s.pose, s.rows, s.solver, w)
        a = dense(c.layout, stated.unknown)[k].T.reshape(len(self.links), self.n, -1).copy()
        for link in range(len(self.links)):
            place = r.point_array[k, link] + c.origin
            a[link, self.d :] += cross(place, a[link, : self.d])
        return np.asarray(a)

    def _joints(self, raw: Array) -> None:
        rows = self.r.compiled.layout.constraints.joint
        whole = {(a.of, a.link): a for a in full_actions(self.r) if a.kind == "joint"}
        for number, name in enumerate(self.r.joints):
            i, j = self.r.mechanism.joints[name].links
            which = np.flatnonzero(rows == number)
            columns = np.asarray(raw[..., which])
            end, sign = (j, 1.0) if j != GROUND else (i, -1.0)
            on_j = sign * columns[self.links.index(end)]
            at = joint_place(self.r, name)[self.k]
            u = UnknownForce(name, "joint", (i, j), columns, on_j[: self.d], at, np.zeros(len(which)))
            if has_strands(self.r, name):
                self._of_band(u, *(wrench_of(whole[name, n], self.k) for n in (i, j)))
            else:
                self._with_friction(u, on_j, wrench_of(whole[name, j], self.k))
            self.unknowns.append(u)

    def _with_friction(self, u: UnknownForce, on_j: Array, total: Array) -> None:
        """Its numbers in the answer; what the rows leave of its wrench is turned into its columns."""
        d, at, scale = self.d, u.at, np.ones(self.n)
        scale[d:] = 1 / self.length
        about = np.concatenate([on_j[:d], on_j[d:] - cross(at, on_j[:d])])
        mine = np.concatenate([total[:d], total[d:] - cross(at, total[:d, None])[:, 0]])
        u.value = np.linalg.pinv(scale[:, None] * about, 1e-9) @ (scale * mine)
        rest = mine - about @ u.value
        size = max(float(np.abs(scale * mine).max()), self.largest_force * ROUNDING)
        if float(np.abs(scale * rest).max(initial=0.0)) <= 1e-7 * size:
            return
        force = u.force @ u.value
        moment = np.concatenate([rest[:d], rest[d:] + cross(at, rest[:d, None])[:, 0]])
        pushed = np.hypot.reduce(u.force, axis=0) > 0.5
        if d == 2 and np.linalg.matrix_rank(u.force) == 2 and np.abs(rest[:2]).max() <= 1e-7 * size:
            shift = rest[2] * np.array([force[1], -force[0]]) / (force @ force)
            change = np.concatenate([0 * u.force, cross(shift, u.force)])
            u.at, u.turned = at + shift, "circle"
        elif d == 2 and pushed.sum() == 1 and abs(u.value[int(np.argmax(pushed))]) > 1e-7 * size:
            change = np.zeros_like(on_j)
            change[:, int(np.argmax(pushed))] = moment / u.value[int(np.argmax(pushed))]
            u.turned = "angle"
            u.force = u.force + change[:2]
        else:
            self._as_known(u, rest)
            return
        for end, sign in zip(u.links, (-1.0, 1.0), strict=True):
            if end != GROUND:
                u.columns[self.links.index(end)] += sign * change

    def _of_band(self, u: UnknownForce, on_drum: Array, on_lever: Array) -> None:
        """A band's wrenches on its drum and its lever are both in the ratio of its tension, which is the one number; an
        end on the ground keeps them from being opposite."""
        size = float(np.linalg.norm(on_lever[: self.d]))
        if size <= ROUNDING * self.largest_force:
            return
        u.value, u.turned = np.array([size]), "angle"
        u.force = on_lever[: self.d, None] / size
        for end, wrench in zip(u.links, (on_drum, on_lever), strict=True):
            if end != GROUND:
                u.columns[self.links.index(end)] = wrench[:, None] / size

    @cached_property
    def unpaired(self) -> dict[str, list[int]]:
        """Bands with an end on the ground, whose forces on both of their links are not opposite, and these links."""
        out = {}
        for u in self.unknowns:
            ends = [self.links.index(n) for n in u.links if n != GROUND]
            if len(ends) == 2 and has_strands(self.r, u.name):
                left, largest = u.columns[ends].sum(axis=0), np.abs(u.columns).max(initial=0.0)
                if np.abs(left).max(initial=0.0) > 1e-7 * largest:
                    out[u.name] = ends
        return out

    def paired(self, links: Sequence[int]) -> bool:
        """False for a free body with both links of a band whose forces do not cancel in it."""
        return not any(set(ends) <= set(links) for ends in self.unpaired.values())

    def _as_known(self, u: UnknownForce, rest: Array) -> None:
        """Sources that cannot be put into the columns are known from the answer, as friction of the last round."""
        count, couple = len(self.r.status), rest[self.d :] if self.d == 3 else rest[2]
        at, force, couple = (np.stack([np.asarray(v)] * count) for v in (u.at, rest[: self.d], couple))
        for on, by, sign in ((u.links[1], u.links[0], 1.0), (u.links[0], u.links[1], -1.0)):
            self.friction.append(Action(u.name, "friction", "", on, by, at, sign * force, sign * couple))

    @cached_property
    def largest_force(self) -> float:
        """Largest component of all forces of the answer."""
        sizes = [np.abs(a.force[self.k]).max() for a in full_actions(self.r)]
        return max((float(s) for s in sizes if np.isfinite(s)), default=0.0)

    def _others(self, raw: Array) -> None:
        """Efforts that are sought, and unknown loads."""
        r, known, m = self.r, self.r.compiled.known, self.r.mechanism
        drives = [d for d, sought in zip(r.drives, known.requested, strict=True) if sought]
        for n, name in enumerate((*drives, *r.unknown_loads)):
            column = np.asarray(raw[..., n : n + 1])
            if n < len(drives):
                joint = m.drives[name].joint or name
                links, at, value = tuple(m.joints[joint].links), joint_place(r, joint)[self.k], r.effort(name)
            else:
                load: Any = m.loads[name]
                links, value = (load.on,), r.unknown_load(name)
                at = next(a.at[self.k] for a in other_actions(r) if a.of == name)
            end = next(e for e in reversed(links) if e != GROUND)
            sign = 1.0 if end == links[-1] else -1.0
            force = sign * column[self.links.index(end), : self.d]
            kind: Literal["effort", "load"] = "effort" if n < len(drives) else "load"
            self.unknowns.append(
                UnknownForce(name, kind, links, column, force, at, value[self.k : self.k + 1])
            )

    @cached_property
    def wrenches(self) -> Array:
        """Known wrench (L, n) on every link."""
        w = np.zeros((len(self.links), self.n))
        for a in self.known:
            w[self.links.index(a.link)] += wrench_of(a, self.k)
        return w

    @cached_property
    def scale(self) -> Array:
        """Moments as forces, by the machine's length (n,)."""
        return np.concatenate([np.ones(self.d), np.full(self.n - self.d, 1 / self.length)])

    def connected(self, most: int, limit: int = 400) -> Iterator[tuple[int, ...]]:
        """Sets of links that joints connect, the small ones first."""
        near: dict[int, set[int]] = {n: set() for n in range(len(self.links))}
        for u in self.unknowns:
            ends = {self.links.index(e) for e in u.links if e != GROUND}
            for e in ends:
                near[e] |= ends - {e}
        level = {frozenset([n]) for n in near}
        for _ in range(most):
            if len(level) > limit:
                return
            yield from filter(self.paired, sorted(tuple(sorted(some)) for some in level))
            level = {some | {b} for some in level for a in some for b in near[a] - some}

    def place_of(self, name: str) -> Array:
        """Point at which the force of a joint acts."""
        return next(u.at for u in self.unknowns if u.kind == "joint" and u.name == name)


def on_links(e: ForceEquations, some: Sequence[int]) -> tuple[list[Array], Array]:
    """Columns of each unknown and the known wrench on a free body of some links; inner forces cancel."""
    which = list(some)
    return [u.columns[which].sum(axis=0) for u in e.unknowns], e.wrenches[which].sum(axis=0)
