"""Dry friction in space, link by link: Newton and Euler's equations, the laws of friction as the manual states them.

Motion is that of ``natural``. Unknown are the whole reaction of each joint on j about j's point, force and moment, the
efforts, and the spin of each rod that two balls alone hold. For each link two vector equations are written, for each
freedom of a joint that the reaction has along it what friction has. Newton's method, each joint's law differentiated by
a complex step; the scale of friction is raised in steps from 0, so that the solution is the one that friction leads to.

F, M  force and moment on j (..., 3), ground axes;  f the joint's axis;  e the ends of a bearing, behind and ahead
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.oracles.reading import Array, Tree
from tests.oracles.space import natural
from tests.oracles.space.natural_loads import applied

RUBS = ("revolute", "prismatic", "cylindrical", "spherical", "screw")
FREE = {
    "weld": ("", ""), "revolute": ("", "z"), "prismatic": ("x", ""), "cylindrical": ("x", "x"), "universal": ("", "zZ"),
    "spherical": ("", "xyz"), "plane": ("yz", "x"), "sphere_between_planes": ("yz", "xyz"), "screw": ("", "x"),
    "sphere_in_cylinder": ("x", "xyz"), "cylinder_between_planes": ("yz", "xZ"), "torus": ("", "yZ"),
    "slotted_sphere": ("", "yZ"), "slotted_cylinder": ("x", "Z"), "slotted_sphere_in_cylinder": ("x", "yZ"),
}  # fmt: skip
"""Slides and turns of each joint; capital: about an axis of j."""
FIRST, STEP = 0.05, 0.25
"""First and largest step of the scale of friction."""


@dataclass
class Rubbed:
    """Reactions on j with friction (P, 3), efforts, spins of rods; power lost in each joint; scale of
    friction (P,) that was reached, 1 where it is the answer."""

    forces: dict[str, Array]
    moments: dict[str, Array]
    efforts: dict[str, Array]
    spins: dict[str, Array]
    lost: dict[str, Array]
    scale: Array


@dataclass(frozen=True)
class Sliding:
    """A joint's point on j, axis f, frames (P, 3, 3; rows), rates along and about f, and relative angular velocity."""

    at: Array
    axis: Array
    on_i: Array
    on_j: Array
    slide: Array
    turn: Array
    spin: Array


def solve(
    m: natural.Machine, moving: natural.Natural, inertia: bool = True, smallest: float = 1e-6
) -> Rubbed:
    """Reactions, efforts and losses along a motion, as far as the branch from no friction goes.

    It goes on while the determinant keeps its sign; where no larger step than the smallest goes on it has ended.
    """
    p = Problem(m, moving, inertia)
    x = _least(p.A, -p.w)
    scale, step, sign = (np.full(len(x), value) for value in (0.0, FIRST, 0.0))
    while (on := (scale < 1) & (step > smallest)).any():
        aim = np.minimum(scale + np.where(on, step, 0.0), 1.0)
        new, arrived, there = p.newton(x, aim)
        near = np.max(np.abs(new - x), -1) < 0.5 * np.max(np.abs(new), -1)
        good = on & arrived & near & (there * sign >= 0)
        sign = np.where(good, there, sign)
        x, scale = np.where(good[:, None], new, x), np.where(good, aim, scale)
        step = np.where(good, np.minimum(1.5 * step, STEP), step / 2)
    return p.read(x, scale)


def _least(A: Array, b: Array) -> Array:
    """The smallest solution: without friction nothing tells the spin of a rod."""
    return np.einsum("pij,pj->pi", np.linalg.pinv(A), b)


class Problem:
    """A x + w = friction(x), rows: force and moment of each link, then one for each freedom of each joint."""

    def __init__(self, m: natural.Machine, moving: natural.Natural, inertia: bool) -> None:
        self.m, self.q, self.v = m, moving.q, moving.v
        self.names = list(m.tree["joints"])
        self.spun = natural.idle(m)
        self.joints = {name: self._sliding(name) for name in self.names}
        self.A, self.w = self._links(moving, inertia)
        self._freedoms()

    def _place(self, link: str) -> int:
        return 4 * self.m.links.index(link)

    def _turning(self, link: str) -> Array:
        """Angular velocity: half the sum of c x c'."""
        k = slice(self._place(link) + 1, self._place(link) + 4)
        return 0.5 * np.sum(np.cross(self.q[:, k], self.v[:, k]), 1)

    def _sliding(self, name: str) -> Sliding:
        i, j, p_i, p_j = self.m.ends(name)
        on_i, on_j = (np.stack([s @ self.q for s in side], 1) for side in self.m.axes(name))
        axis = 2 if self.m.tree["joints"][name]["type"] == "revolute" else 0
        f, spin = on_i[:, axis], self._turning(j) - self._turning(i)
        away, rate = (p_j - p_i) @ self.q, (p_j - p_i) @ self.v
        slide = _dots(rate - np.cross(self._turning(i), away), f)
        return Sliding(p_j @ self.q, f, on_i, on_j, slide, _dots(spin, f), spin)

    def _links(self, moving: natural.Natural, inertia: bool) -> tuple[Array, Array]:
        """Sums of the forces on each link and of the moments about its origin."""
        moved, P = self.m.links[1:], len(self.q)
        size = 6 * len(self.names) + len(self.m.drives) + len(self.spun)
        A, w = np.zeros((P, 6 * len(moved), size)), np.zeros((P, 6 * len(moved)))
        loads = applied(self.m, self.q, self.v)
        for n, link in enumerate(moved):
            row, origin = slice(6 * n, 6 * n + 6), self.q[:, self._place(link)]
            w[:, row] = self._wrench(loads, link)
            if inertia:
                w[:, row] -= self._newton_euler(link, moving.a)
            for k, name in enumerate(self.names):
                sign = self.m.tree["joints"][name]["links"]
                A[:, row, 6 * k : 6 * k + 6] += ((sign[1] == link) * 1.0 - (sign[0] == link)) * _carried(
                    self.joints[name].at - origin
                )
            for k, row_ in enumerate(self.m.drive_rows):
                gradient = natural._row(row_, self.q, self.v)[1]
                sense = -1.0 if list(self.m.drives.values())[k].freedom == "turn2" else 1.0
                A[:, row, 6 * len(self.names) + k] = sense * self._wrench(gradient, link)
        return A, w

    def _wrench(self, push: Array, link: str) -> Array:
        """Force, and moment about the origin, of forces on the natural coordinates of a link."""
        k = self._place(link)
        moment = np.sum(np.cross(self.q[:, k + 1 : k + 4], push[:, k + 1 : k + 4]), 1)
        return np.concatenate([push[:, k], moment], -1)

    def _newton_euler(self, link: str, a: Array) -> Array:
        """m a of the mass centre; I alpha + omega x I omega about it; both about the link's origin."""
        t, k = self.m.tree["links"][link], self._place(link)
        axes, second = self.q[:, k + 1 : k + 4], a[:, k + 1 : k + 4]
        center, about = (
            np.asarray(t.get("center", np.zeros(3)), float),
            np.asarray(t.get("inertia", np.zeros(3)), float),
        )
        about = np.diag(about) if about.ndim == 1 else about
        I = np.swapaxes(axes, 1, 2) @ about @ axes  # noqa: E741
        w, alpha = self._turning(link), 0.5 * np.sum(np.cross(axes, second), 1)
        force = t.get("mass", 0.0) * (a[:, k] + np.einsum("c,pcx->px", center, second))
        spin = np.einsum("pij,pj->pi", I, w)
        moment = np.einsum("pij,pj->pi", I, alpha) + np.cross(w, spin)
        arm = np.einsum("c,pcx->px", center, axes)
        return np.concatenate([force, moment + np.cross(arm, force)], -1)

    def _freedoms(self) -> None:
        """Rows for the freedoms; ``self.law``: (row, joint, direction (P, 6)) of each."""
        self.law: list[tuple[int, int, Array]] = []
        rows = []
        for k, name in enumerate(self.names):
            s, t = self.joints[name], self.m.tree["joints"][name]
            for d in self._directions(t, s):
                row = np.zeros((len(self.q), self.A.shape[2]))
                row[:, 6 * k : 6 * k + 6] = d
                self.law.append((self.A.shape[1] + len(rows), k, d))
                rows.append(row)
        self.A = np.concatenate([self.A, np.stack(rows, 1)], 1)
        self.w = np.concatenate([self.w, np.zeros((len(self.q), len(rows)))], 1)

    def _directions(self, t: Tree, s: Sliding) -> list[Array]:
        slides, turns = FREE[t["type"]]
        o = np.zeros_like(s.at)
        if t["type"] == "screw":
            return [np.concatenate([t["lead"] / (2 * np.pi) * s.axis, s.axis], -1)]
        out = [np.concatenate([s.on_i[:, "xyz".index(c)], o], -1) for c in slides]
        for c in turns:
            side = s.on_j if c.isupper() else s.on_i
            out.append(np.concatenate([o, side[:, "xyz".index(c.lower())]], -1))
        return out

    def spin(self, name: str, spins: Array) -> Array:
        """Relative angular velocity (..., 3) of j with the rods' spins (..., S)."""
        out = self.joints[name].spin + np.sum(0 * spins, -1, keepdims=True)
        i, j = self.m.tree["joints"][name]["links"]
        for n, (link, line) in enumerate(self.spun):
            u = line @ self.q
            u = u / np.linalg.norm(u, axis=-1, keepdims=True)
            out = out + ((j == link) * 1.0 - (i == link)) * spins[..., n, None] * u
        return out

    def friction(self, k: int, W: Array, spins: Array, scale: Array) -> Array:
        """Friction's wrench on j of joint k (..., P, 6)."""
        name = self.names[k]
        t, s = self.m.tree["joints"][name], self.joints[name]
        if t.get("friction") is None:
            return 0 * W
        mu = scale * t["friction"].get("coefficient", self.m.tree.get("friction", {}).get("coefficient", 0.0))
        kind = t["friction"].get("circle", self.m.tree.get("friction", {}).get("circle", "sin"))
        laws = {"revolute": journal, "prismatic": guide, "cylindrical": cylinder, "screw": thread}
        if t["type"] == "spherical":
            return ball(t["friction"], mu, kind, W, self.spin(name, spins))
        return laws[t["type"]]({**t, **t["friction"]}, mu, kind, W, s)

    def residual(self, x: Array, scale: Array) -> tuple[Array, Array]:
        """What is left of the equations (P, R), and their derivative (P, R, U)."""
        left = np.einsum("pij,pj->pi", self.A, x) + self.w
        J = self.A.copy()
        first, count = 6 * len(self.names) + len(self.m.drives), len(self.spun)
        for k in range(len(self.names)):
            rows = [(row, d) for row, joint, d in self.law if joint == k]
            columns = [*range(6 * k, 6 * k + 6), *range(first, first + count)]
            step = x[..., columns] + 1e-30j * np.eye(6 + count)[:, None]
            law = self.friction(k, step[..., :6], step[..., 6:], scale)
            for row, d in rows:
                along = _dots(law, d)
                left[:, row] -= along[0].real
                J[:, row, columns] -= along.imag.T / 1e-30
        return left, J

    def newton(self, x: Array, scale: Array) -> tuple[Array, Array, Array]:
        """Steps, halved where they make it worse; whether it arrived; sign of the determinant."""
        size = np.maximum(np.max(np.abs(x), -1), 1e-12)
        left, J = self.residual(x, scale)
        for _ in range(30):
            off = np.linalg.norm(left, axis=-1)
            if np.all(off < 1e-14 * size):
                break
            step, part = -np.linalg.solve(J, left[..., None])[..., 0], np.ones(len(x))
            for _ in range(10):
                new = x + part[:, None] * step
                left, J = self.residual(new, scale)
                worse = ~(np.linalg.norm(left, axis=-1) <= np.maximum(off, 1e-13 * size))
                if not worse.any():
                    break
                part = np.where(worse, part / 2, part)
            x = new
        return x, np.linalg.norm(left, axis=-1) < 1e-12 * size, np.linalg.slogdet(J)[0]

    def read(self, x: Array, scale: Array) -> Rubbed:
        first = 6 * len(self.names)
        spins = x[:, first + len(self.m.drives) :]
        out = Rubbed({}, {}, {}, {}, {}, scale)
        for k, name in enumerate(self.names):
            W, s = x[:, 6 * k : 6 * k + 6], self.joints[name]
            out.forces[name], out.moments[name] = W[:, :3], W[:, 3:]
            rub = self.friction(k, W, spins, np.ones(len(x)))
            spin = self.spin(name, spins)
            out.lost[name] = -_dots(rub[:, :3], s.axis) * s.slide - _dots(rub[:, 3:], spin)
        for k, name in enumerate(self.m.drives):
            out.efforts[name] = x[:, first + k]
        for k, (link, _) in enumerate(self.spun):
            out.spins[link] = spins[:, k]
        return out


# the laws, as docs/friction.md and docs/space.md state them


def ends(t: Tree, W: Array, s: Sliding) -> list[Array]:
    """Forces across the axis on the ends of a bearing: N1 + N2 = F, ahead N2 - behind N1 = M x f."""
    F, M = W[..., :3], W[..., 3:]
    across = F - _dots(F, s.axis)[..., None] * s.axis
    if "guide" not in t:
        return [across]
    behind, ahead = t["guide"]
    last = (behind * across + np.cross(M, s.axis)) / (behind + ahead)
    return [across - last, last]


def journal(t: Tree, mu: float, kind: str, W: Array, s: Sliding) -> Array:
    """A friction circle for the force across, and a collar."""
    r = t["radius"] * (np.sin(np.arctan(mu)) if kind == "sin" else mu)
    size = sum(r * _size(n) for n in ends(t, W, s))
    size = size + mu * t.get("thrust_radius", 0.0) * _absolute(_dots(W[..., :3], s.axis))
    return _on_axis(0 * size, -np.sign(s.turn) * size, s)


def guide(t: Tree, mu: float, kind: str, W: Array, s: Sliding) -> Array:
    size = sum(mu * _size(n) for n in ends(t, W, s))
    return _on_axis(-np.sign(s.slide) * size, 0 * size, s)


def cylinder(t: Tree, mu: float, kind: str, W: Array, s: Sliding) -> Array:
    """Against the slip of the surface. With circles of R sin(phi) the force across has in it what friction has around:
    that squared and the normal force squared make the force squared."""
    if "radius" not in t:
        return guide(t, mu, kind, W, s)
    slip = np.hypot(s.slide, t["radius"] * s.turn)
    along, around = s.slide / slip, t["radius"] * s.turn / slip
    normal = sum(_size(n) for n in ends(t, W, s))
    if kind == "sin":
        normal = normal / np.sqrt(1 + (mu * around) ** 2)
    return _on_axis(-along * mu * normal, -around * mu * t["radius"] * normal, s)


def ball(t: Tree, mu: float, kind: str, W: Array, spin: Array) -> Array:
    r = t["radius"] * (np.sin(np.arctan(mu)) if kind == "sin" else mu)
    couple = -(r * _size(W[..., :3]) / _size(spin))[..., None] * spin
    return np.concatenate([0 * couple, couple], -1)


def thread(t: Tree, mu: float, kind: str, W: Array, s: Sliding) -> Array:
    """The force along the axis and that around it at the mean radius, in parts across the helix and along it."""
    climb = np.arctan(t["lead"] / (2 * np.pi * t["radius"]))
    F, M = W[..., :3], W[..., 3:]
    axial, around = _dots(F, s.axis), _dots(M, s.axis) / t["radius"]
    normal = axial * np.cos(climb) - around * np.sin(climb)
    size = _absolute(normal) / np.cos(np.radians(float(str(t.get("thread_angle", 0.0)).split()[0])))
    size = -np.sign(s.turn) * mu * (size + _size(F - axial[..., None] * s.axis))
    return _on_axis(size * np.sin(climb), size * t["radius"] * np.cos(climb), s)


def _on_axis(force: Array, couple: Array, s: Sliding) -> Array:
    return np.concatenate([force[..., None] * s.axis, couple[..., None] * s.axis], -1)


def _dots(a: Array, b: Array) -> Array:
    return np.sum(a * b, -1)


def _size(a: Array) -> Array:
    """Of complex vectors too."""
    return np.sqrt(_dots(a, a) + 1e-300)


def _absolute(a: Array) -> Array:
    return a * np.where(np.real(a) < 0, -1.0, 1.0)


def _carried(arm: Array) -> Array:
    """(P, 6, 6): force and moment about a point to those about another, seen from which the first is at the arm."""
    out = np.tile(np.eye(6), (len(arm), 1, 1))
    out[:, 3:, :3] = np.swapaxes(np.cross(arm[:, None], np.eye(3)), 1, 2)
    return out
