"""Friction by a slow path of its own: multipliers of the Lagrange oracle, the scale of friction raised in small steps.

Newton on  J^T x + w + W(x, s) = 0  with a difference Jacobian over all multipliers at once; the branch from s = 0 is
followed while the determinant keeps its sign, and has ended where no step, however small, goes further.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from tests.oracles import lagrange
from tests.oracles.lagrange import Row, contact
from tests.oracles.reading import Array, Machine, Tree, machine, number
from tests.oracles.wrenches import known, placed, push, turned


class Branch(NamedTuple):
    """Where the branch ends (1: solved), reactions on j with friction, efforts."""

    scale: float
    forces: dict[str, Array]
    moments: dict[str, Array]
    efforts: dict[str, float]


class _Joint(NamedTuple):
    """A joint's reaction and contact as linear maps of the multipliers, its senses and the rate of its slide."""

    row: Row
    force: Array  # (2, R)
    moment: Array  # (R,)
    spot: Array
    slide: float
    turn: float
    slip: float
    along: Array


def branch(tree: Tree, guess: Array, step: float = 0.02, smallest: float = 1e-7) -> Branch:
    """The physical branch at the first position."""
    p = _Problem(tree, guess[:1])
    x, s, first = p.solved(np.linalg.solve(p.A, -p.w), 0.0), 0.0, None
    assert x is not None
    while s < 1 and step > smallest:
        aim = min(1.0, s + step)
        new = p.solved(x, aim)
        sign = np.nan if new is None else np.sign(np.linalg.det(p.jacobian(new, aim) @ p.inverse))
        near = new is not None and np.max(np.abs(new - x)) < 0.5 * np.max(np.abs(new))
        first = sign if first is None and near else first
        if near and sign > 0:
            x, s, step = new, aim, min(step * 1.5, 0.02)
        else:
            step /= 2
    return Branch(s, *p.reactions(x, s))


class _Problem:
    def __init__(self, tree: Tree, guess: Array) -> None:
        m = machine(tree)
        self.tree, self.m = tree, m
        self.rows = lagrange.rows(m, guess)
        every = [*self.rows, *lagrange._drive_rows(m)]
        every = [_first(row) for row in every]
        q = lagrange._closed(every, guess.astype(np.longdouble))
        J = lagrange._system(every, q, 0 * q)[1]
        v = lagrange._full(lagrange._solved(J, lagrange._stacked(every, "speed", q)))
        gamma = lagrange._system(every, q, v)[2] + lagrange._stacked(every, "acceleration", q)
        a = lagrange._full(lagrange._solved(J, gamma))
        self.w = lagrange._flat(known(m, q, v, a))[0].astype(float)
        self.A = J[0].T.astype(float)
        self.inverse = np.linalg.inv(self.A)
        self.q = q.astype(float)
        self.drives = [r.name for r in every[len(self.rows) :]]
        self.joints = self._maps(every, q.astype(float), v.astype(float))

    def _maps(self, every: list[Row], q: Array, v: Array) -> list[_Joint]:
        count = self.A.shape[1]
        many = np.repeat(q, count, 0)
        unit = lagrange._split(every, np.eye(count))
        forces, moments, _ = lagrange._reactions(every, {k: (x, np.zeros(2)) for k, x in unit.items()}, many)
        out = []
        for row in self.rows:
            j = row.joint
            e = turned(q[:, j.i, 2] + j.angle("direction"), (1.0, 0.0))[0]
            spot = placed(q, j.j, j.at_j)
            rate = (_velocity(q, v, j.j, spot) - _velocity(q, v, j.i, spot))[0] @ e
            turn = float(v[0, j.j, 2] - v[0, j.i, 2])
            out.append(
                _Joint(
                    row,
                    forces[row.name].T,
                    moments[row.name],
                    contact(row, q),
                    np.sign(rate),
                    np.sign(turn),
                    rate,
                    e,
                )
            )
        return out

    def friction(self, x: Array, s: float) -> dict[str, tuple[Array, Array]]:
        """Force (..., 2) and couple (...) of friction and tooth separation on j at scale s, of multipliers (..., R)."""
        return {j.row.name: self._of(j, x @ j.force.T, x @ j.moment, s) for j in self.joints}

    def _of(self, j: _Joint, force: Array, moment: Array, s: float) -> tuple[Array, Array]:
        t = self.tree["joints"][j.row.name]
        f = t.get("friction")
        none = np.zeros_like(force), np.zeros_like(moment)
        if t["type"] == "gear":
            return self._teeth(j, force, t, f, s)
        if f is None:
            return none
        top = self.tree["friction"]
        mu = s * f.get("coefficient", top["coefficient"])
        lever = mu / np.sqrt(1 + mu * mu) if f.get("circle", top["circle"]) == "sin" else mu
        size = np.hypot(force[..., 0], force[..., 1])
        if t["type"] == "pin":
            return none[0], -j.turn * lever * f["radius"] * size
        across = np.array([-j.along[1], j.along[0]])
        normal = force @ across
        bearing, couple = np.abs(normal), none[1]
        if "guide" in f:
            l1, l2 = f["guide"]
            bearing = np.maximum(bearing, np.abs(2 * moment - (l2 - l1) * normal) / (l1 + l2))
        if "half_height" in f:
            couple = -j.slide * mu * f["half_height"] * normal
        if t["type"] == "slot" and "radius" in f:
            slide = j.slide * mu * bearing + j.slip * number(t.get("damping", {}).get("slide", 0.0))
            couple = (
                -j.turn * lever * f["radius"] * np.hypot(normal, slide)
            )  # all between the pin and its block
        return -(j.slide * mu * bearing)[..., None] * j.along, couple

    def _teeth(self, j: _Joint, force: Array, t: Tree, f: Tree | None, s: float) -> tuple[Array, Array]:
        line = lagrange._line_of_centres(j.row, self.q)[0]
        tangential = np.abs(force[..., 1] * line[0] - force[..., 0] * line[1])
        alpha = np.radians(number(t.get("pressure_angle", 20.0)))
        sign = -1.0 if t.get("internal", False) else 1.0
        apart = (sign * np.tan(alpha) * tangential)[..., None] * line
        if f is None:
            return apart, 0 * tangential
        mu = s * f.get("coefficient", self.tree["friction"]["coefficient"])
        return apart, -j.turn * mu * f["arm"] * tangential / np.cos(alpha)

    def residual(self, x: Array, s: float) -> Array:
        """Out of balance (..., 3 L) at multipliers (..., R)."""
        flat = x.reshape(-1, x.shape[-1])
        w = np.zeros((len(flat), *self.q.shape[1:]))
        many = np.repeat(self.q, len(flat), 0)
        found = self.friction(flat, s)
        for j in self.joints:
            force, couple = found[j.row.name]
            spot = np.repeat(j.spot, len(flat), 0)
            push(w, many, j.row.joint.j, spot, force)
            push(w, many, j.row.joint.i, spot, -force)
            w[:, j.row.joint.j, 2] += couple
            w[:, j.row.joint.i, 2] -= couple
        return (flat @ self.A.T + self.w + lagrange._flat(w)).reshape((*x.shape[:-1], -1))

    def jacobian(self, x: Array, s: float) -> Array:
        """By central differences."""
        h = 1e-6 * max(float(np.max(np.abs(x))), 1e-6)
        unit = h * np.eye(len(x))
        return ((self.residual(x + unit, s) - self.residual(x - unit, s)) / (2 * h)).T

    def solved(self, x: Array, s: float) -> Array | None:
        """Newton from x; None where it does not arrive in a few steps, within what the terms of its sums round."""
        for _ in range(12):
            off = self.residual(x, s)
            if np.max(np.abs(off)) <= 1e-12 * max(float(np.max(np.abs(self.A) @ np.abs(x))), 1e-12):
                return x
            try:
                x = x - np.linalg.solve(self.jacobian(x, s), off)
            except np.linalg.LinAlgError:
                return None
        return None

    def reactions(self, x: Array, s: float) -> tuple[dict[str, Array], dict[str, Array], dict[str, float]]:
        """Constraint parts with friction, viscous parts left out."""
        found = self.friction(x, s)
        forces = {j.row.name: j.force @ x + found[j.row.name][0] for j in self.joints}
        moments = {j.row.name: j.moment @ x + found[j.row.name][1] for j in self.joints}
        efforts = dict(zip(self.drives, x[len(x) - len(self.drives) :], strict=True))
        return forces, moments, efforts


def _first(row: Row) -> Row:
    """The row at the first position."""
    prescribed = (np.ravel(x)[:1] for x in (row.position, row.speed, row.acceleration))
    return Row(row.name, row.kind, row.joint, row.parameters, *prescribed)


def _velocity(q: Array, v: Array, link: int, spot: Array) -> Array:
    arm, w = spot - q[:, link, :2], v[:, link, 2]
    return np.asarray(v[:, link, :2] + np.stack([-w * arm[:, 1], w * arm[:, 0]], -1))


def compared(r: Any, b: Branch, m: Machine) -> float:
    """Largest difference at the first position, relative to the largest force (times the machine's length)."""
    force = max(float(np.max(np.abs(f))) for f in b.forces.values())
    length = r.compiled.layout.length
    off = [0.0]
    for j in m.joints:
        dry = r.friction
        k = r.joints.index(j.name)
        off.append(np.max(np.abs(r.reaction(j.name)[0] - dry.viscous_force[0, k] - b.forces[j.name])) / force)
        off.append(
            abs(r.reaction_moment(j.name)[0] - dry.viscous_moment[0, k] - b.moments[j.name]) / force / length
        )
    for d in m.drives:
        off.append(
            abs(r.effort(d.name)[0] - b.efforts[d.name]) / force / (length if d.freedom == "turn" else 1.0)
        )
    return float(max(off))


def resting(tree: Tree, guess: Array, count: int, seed: int) -> dict[str, Array]:
    """Efforts of states of rest: every contact at a random part of its limit, half of them all at the limit itself.

    The parts are raised together from no friction; states on whose way Newton does not arrive are left out.
    """
    p, rng = _Problem(tree, guess[:1]), np.random.default_rng(seed)
    bare, moving = np.linalg.solve(p.A, -p.w), p.joints
    found = []
    for k in range(count):
        parts = rng.uniform(-1, 1, (len(moving), 2))
        parts = np.where(rng.random(parts.shape) < (0.8 if k % 2 else 2.0), np.sign(parts), parts)
        p.joints = [j._replace(slide=f, turn=g) for j, (f, g) in zip(moving, parts, strict=True)]
        x: Array | None = p.solved(bare, 0.0)
        for s in np.linspace(0.1, 1, 10):
            x = None if x is None else p.solved(x, s)
        if x is not None:
            found.append(x[len(x) - len(p.drives) :])
    return dict(zip(p.drives, np.array(found).T, strict=True))
