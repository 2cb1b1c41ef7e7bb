"""Any mechanism in space in natural coordinates: the origin and the three axes of each link, 12 numbers a link.

Every point and every axis of a link is then linear in the coordinates, every constraint (rigidity too) a dot product of
two of them, and the mass matrix is constant: no rotation is parametrised, no angular velocity and no gyroscopic term
appears (Garcia de Jalon and Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994, chapter 2).

Q (P, 4 L, 3): rows of link k are its origin and axes; a functional s (4 L,) gives the vector s Q; a row of constraints
is (s1 Q) . (s2 Q) - d with s2 and d jets, M Q'' = F + J' lambda.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.oracles.jets import Jet
from tests.oracles.reading import Array, Tree, drive
from tests.oracles.space.moving import local_axes, square
from tests.oracles.space.natural_loads import applied, momentum


@dataclass(frozen=True)
class Row:
    """(s1 Q) . (s2 Q) - d = 0, part of a joint, of a drive or, without a name, of a rigid link."""

    name: str
    s1: Array
    s2: Array | Jet
    d: float | Jet = 0.0


@dataclass(frozen=True)
class Thread(Row):
    """Of a screw: s1 Q . s2 Q less ``rise`` times the angle of p to b, towards c."""

    p: Array | None = None
    b: Array | None = None
    c: Array | None = None
    rise: float = 0.0


@dataclass
class Natural:
    """The answer: coordinates (P, 4 L, 3) and rates; reactions on j at j's point; efforts; rows left over."""

    links: tuple[str, ...]
    q: Array
    v: Array
    a: Array
    forces: dict[str, Array] = field(default_factory=dict)
    moments: dict[str, Array] = field(default_factory=dict)
    efforts: dict[str, Array] = field(default_factory=dict)


class Machine:
    """A tree (SI, degrees) in functionals."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.links = ("ground", *(name for name in tree["links"] if name != "ground"))
        self.size = 4 * len(self.links)
        drives = {name: drive(name, t, tree["joints"]) for name, t in tree.get("drives", {}).items()}
        self.count = max((len(d.position) for d in drives.values()), default=1)
        self.drives = drives
        self.joint_rows = [row for name in tree["joints"] for row in self._joint(name)]
        self.drive_rows = [self._driven(name) for name in drives]
        self.rows = [*self._rigid(), *self.joint_rows, *self.drive_rows]

    def functional(self, link: str, local: Any, point: bool) -> Array:
        s = np.zeros(self.size)
        k = 4 * self.links.index(link)
        s[k], s[k + 1 : k + 4] = float(point), local
        return s

    def point(self, link: str, name: str | list[float]) -> Array:
        local = self.tree["links"].get(link, {}).get("points", {})[name] if isinstance(name, str) else name
        return self.functional(link, local, True)

    def ends(self, name: str) -> tuple[str, str, Array, Array]:
        """Links i and j of a joint and the functionals of its points."""
        t = self.tree["joints"][name]
        at = t.get("at", name)
        names = [at, at] if isinstance(at, str) else at
        i, j = t["links"]
        return i, j, self.point(i, names[0]), self.point(j, names[1])

    def axes(self, name: str) -> tuple[list[Array], list[Array]]:
        """Functionals of the local axes x, y, z on i and on j."""
        t = self.tree["joints"][name]
        return tuple(  # type: ignore[return-value]
            [self.functional(link, u, False) for u in local_axes(t, side).T]
            for link, side in zip(t["links"], "ij", strict=True)
        )

    def _rigid(self) -> list[Row]:
        e = np.eye(self.size)
        spots = [
            (4 * k + a, 4 * k + b) for k in range(1, len(self.links)) for a in (1, 2, 3) for b in range(a, 4)
        ]
        return [Row("", e[a], e[b], float(a == b)) for a, b in spots]

    def _joint(self, name: str) -> list[Row]:
        _, _, p_i, p_j = self.ends(name)
        (xi, yi, zi), (xj, yj, zj) = self.axes(name)
        gap = p_j - p_i
        pairs = {
            "weld": [(gap, xi), (gap, yi), (gap, zi), (xj, yi), (xj, zi), (yj, zi)],
            "revolute": [(gap, xi), (gap, yi), (gap, zi), (zj, xi), (zj, yi)],
            "prismatic": [(gap, yi), (gap, zi), (xj, yi), (xj, zi), (yj, zi)],
            "cylindrical": [(gap, yi), (gap, zi), (xj, yi), (xj, zi)],
            "slotted_cylinder": [(gap, yi), (gap, zi), (zj, xi), (zj, yi)],
            "universal": [(gap, xi), (gap, yi), (gap, zi), (zj, zi)],
            "spherical": [(gap, xi), (gap, yi), (gap, zi)],
            "plane": [(gap, xi), (xj, yi), (xj, zi)],
            "cylinder_between_planes": [(gap, xi), (zj, xi)],
            "sphere_in_cylinder": [(gap, yi), (gap, zi)],
            "sphere_between_planes": [(gap, xi)],
            "torus": [(gap, xi), (gap, yi), (gap, zi), (zj, yi)],
            "slotted_sphere": [(gap, xi), (gap, yi), (gap, zi), (zj, yi)],
            "slotted_sphere_in_cylinder": [(gap, yi), (gap, zi), (zj, yi)],
            "screw": [(gap, yi), (gap, zi), (xj, yi), (xj, zi)],
        }[self.tree["joints"][name]["type"]]
        rows = [Row(name, a, b) for a, b in pairs]
        if self.tree["joints"][name]["type"] == "screw":
            rise = self.tree["joints"][name]["lead"] / (2 * np.pi)
            rows.append(Thread(name, gap, xi, p=yj, b=yi, c=zi, rise=rise))
        return rows

    def _driven(self, name: str) -> Row:
        d = self.drives[name]
        (x, v, a) = (np.broadcast_to(x, (self.count,)) for x in (d.position, d.speed, d.acceleration))
        if d.freedom.startswith("slide"):
            _, _, p_i, p_j = self.ends(d.joint)
            return Row(name, p_j - p_i, self.along(d.joint, d.freedom), Jet(x, v, a))
        p, b, c, sense = self.angle(d.joint, d.freedom)
        cosine, sine = np.cos(x)[:, None], sense * np.sin(x)[:, None]
        across, along = cosine * c - sine * b, cosine * b + sine * c
        v, a = sense * v[:, None], sense * a[:, None]
        return Row(name, p, Jet(across, -v * along, -a * along - v**2 * across))

    def along(self, name: str, freedom: str) -> Array:
        """The axis of i that a slide goes along."""
        return self.axes(name)[0][{"slide": 0, "slide1": 1, "slide2": 2}[freedom]]

    def angle(self, name: str, freedom: str) -> tuple[Array, Array, Array, float]:
        """A turn: the direction p of one link whose angle from b towards c of the other it is, and its sense.

        Of two turns the first is about an axis of i, the second about one of j, seen from j the other way.
        """
        i, j = self.tree["joints"][name]["links"]
        if freedom == "turn":
            _, b, c, on_j = self.turning(name)
            return on_j, b, c, 1.0
        first, second, marks = self._two_turns(name)
        if freedom == "turn1":
            b = square(marks[1], first)
            return self.functional(j, second, False), *self._both(i, b, np.cross(first, b)), 1.0
        b = square(marks[0], second)
        return self.functional(i, first, False), *self._both(j, b, np.cross(second, b)), -1.0

    def _both(self, link: str, b: Array, c: Array) -> tuple[Array, Array]:
        return self.functional(link, b, False), self.functional(link, c, False)

    def _two_turns(self, name: str) -> tuple[Array, Array, tuple[Array, Array]]:
        """Local axis of the first turn on i and of the second on j; marks at 0: the first's on j, the second's on i."""
        t = self.tree["joints"][name]
        on_i, on_j = (local_axes(t, side).T for side in "ij")
        if t["type"] == "universal":
            return on_i[2], on_j[2], (on_i[2], on_j[2])
        k = 0 if t["type"] == "cylinder_between_planes" else 1
        return on_i[k], on_j[2], (on_j[k], on_i[2])

    def turning(self, name: str) -> tuple[Array, Array, Array, Array]:
        """Axis of a joint's turn and two axes across it on i, and on j the one that the first becomes."""
        on_i, on_j = self.axes(name)
        k = 0 if self.tree["joints"][name]["type"] in ("cylindrical", "plane", "screw") else 2
        return on_i[k], on_i[(k + 1) % 3], on_i[(k + 2) % 3], on_j[(k + 1) % 3]

    def value(self, name: str, freedom: str, q: Array) -> float:
        """A freedom of a joint at one pose (4 L, 3)."""
        if freedom.startswith("slide"):
            _, _, p_i, p_j = self.ends(name)
            return float(((p_j - p_i) @ q) @ (self.along(name, freedom) @ q))
        p, b, c, sense = self.angle(name, freedom)
        return float(sense * np.arctan2((p @ q) @ (c @ q), (p @ q) @ (b @ q)))


def closed(m: Machine, guess: Array, rcond: float = 1e-11) -> tuple[Array, float]:
    """Coordinates by Newton's method from others that nearly close, and the largest gap left."""
    q = guess.copy()
    for _ in range(10):
        phi, J, _, _ = system(m.rows, q, 0 * q)
        gap = float(np.max(np.abs(phi)))
        if gap < 5e-15:
            break
        q[:, 4:] -= _solved(J, phi, rcond).reshape(q[:, 4:].shape)
    return q, gap


def drawn(m: Machine) -> Array:
    """All links' axes in ground's (4 L, 3)."""
    return np.tile(np.vstack([np.zeros((1, 3)), np.eye(3)]), (len(m.links), 1))


def followed(tree: Tree) -> tuple[Machine, Array, list[float]]:
    """A linkage drawn with all links' axes in ground's, followed along its drives' positions one by one.

    Redundant constraints: singular values below 1e-5 belong to rows that agree once the linkage closes.
    """
    whole = Machine(tree)
    return whole, *marched(tree, drawn(whole))


def marched(tree: Tree, start: Array) -> tuple[Array, list[float]]:
    """Coordinates (P, 4 L, 3) along the drives' positions, each from the one before, and the gaps left."""
    whole, q = Machine(tree), start[None]
    path, gaps = [], []
    for k in range(whole.count):
        q, gap = closed(at_position(tree, whole, k), q, 1e-5)
        path.append(q[0])
        gaps.append(gap)
    return np.array(path), gaps


def at_position(tree: Tree, whole: Machine, k: int) -> Machine:
    """The machine with its drives at one of their positions only."""
    drives = {
        name: {**tree["drives"][name], "position": f"{d.position[k]} {_unit(d.freedom)}"}
        for name, d in whole.drives.items()
    }
    return Machine({**tree, "drives": drives})


def _unit(freedom: str) -> str:
    return "m" if freedom.startswith("slide") else "rad"


def solve(m: Machine, guess: Array, inertia: bool = True) -> Natural:
    """The answer at every position, from coordinates that nearly close."""
    q, _ = closed(m, guess)
    _, J, rate, _ = system(m.rows, q, 0 * q)
    v = _with_ground(_solved(_still(m, J, q), _padded(m, -rate)), q)
    _, J, _, drift = system(m.rows, q, v)
    a = _with_ground(_solved(_still(m, J, q), _padded(m, -drift)), q)
    found = Natural(m.links, q, v, a)
    wanted = momentum(m, a if inertia else 0 * a) - applied(m, q, v)
    multipliers = _solved(np.swapaxes(J, -1, -2), wanted[:, 4:].reshape(len(q), -1))
    _reactions(m, found, multipliers)
    return found


def system(rows: list[Row], q: Array, v: Array) -> tuple[Array, Array, Array, Array]:
    """phi (P, R), J (P, R, 12 L), rates of phi at Q' = 0, and second rates at Q'' = 0."""
    parts = [_thread(row, q, v) if isinstance(row, Thread) else _row(row, q, v) for row in rows]
    phi, J, rate, drift = (np.stack([part[k] + 0 * parts[0][k] for part in parts], 1) for k in range(4))
    return phi, J[:, :, 4:].reshape(len(q), len(rows), -1), rate, drift


def _row(row: Row, q: Array, v: Array) -> tuple[Array, Array, Array, Array]:
    """phi, its gradient (P, 4 L, 3), its rate at Q' = 0 and its second rate at Q'' = 0."""
    s2 = row.s2 if isinstance(row.s2, Jet) else Jet(row.s2[None], 0 * row.s2[None], 0 * row.s2[None])
    d = row.d if isinstance(row.d, Jet) else Jet(np.full(1, row.d), np.zeros(1), np.zeros(1))
    a, a_v, b, b_v = row.s1 @ q, row.s1 @ v, _of(s2.x, q), _of(s2.x, v)
    gradient = row.s1[None, :, None] * b[:, None] + s2.x[..., None] * a[:, None]
    turning = _dot(a_v, _of(s2.v, q)) * 2 + _dot(a, _of(s2.a, q) + 2 * _of(s2.v, v))
    return _dot(a, b) - d.x, gradient, _dot(a, _of(s2.v, q)) - d.v, 2 * _dot(a_v, b_v) + turning - d.a


def _thread(row: Thread, q: Array, v: Array) -> tuple[Array, Array, Array, Array]:
    """A dot product less the rise times atan2(p . c, p . b)."""
    assert row.p is not None
    assert row.b is not None
    assert row.c is not None
    x, x_q, _, x_2 = _row(Row("", row.s1, row.s2), q, v)
    s, s_q, _, s_2 = _row(Row("", row.p, row.c), q, v)
    c, c_q, _, c_2 = _row(Row("", row.p, row.b), q, v)
    s_1, c_1 = (np.sum(gradient * v, (1, 2)) for gradient in (s_q, c_q))
    size = s * s + c * c
    angle_q = (c[:, None, None] * s_q - s[:, None, None] * c_q) / size[:, None, None]
    angle_1 = (c * s_1 - s * c_1) / size
    angle_2 = (c * s_2 - s * c_2) / size - 2 * angle_1 * (s * s_1 + c * c_1) / size
    return x - row.rise * np.arctan2(s, c), x_q - row.rise * angle_q, 0 * x, x_2 - row.rise * angle_2


def _of(s: Array, q: Array) -> Array:
    return np.einsum("...n,...nk->...k", s, q)


def _dot(a: Array, b: Array) -> Array:
    return np.sum(a * b, -1)


def _solved(J: Array, right: Array, rcond: float = 1e-11) -> Array:
    return np.einsum("...ij,...j->...i", np.linalg.pinv(J, rcond=rcond), right)


def _with_ground(x: Array, q: Array) -> Array:
    out = np.zeros_like(q)
    out[:, 4:] = x.reshape(q[:, 4:].shape)
    return out


def idle(m: Machine) -> list[tuple[str, Array]]:
    """Links held by two spheres only, with the functional of the line between them."""
    out = []
    for link in m.links[1:]:
        held = [(name, t) for name, t in m.tree["joints"].items() if link in t["links"]]
        if [t["type"] for _, t in held] == ["spherical", "spherical"]:
            p, r = (m.ends(name)[2 + t["links"].index(link)] for name, t in held)
            out.append((link, r - p))
    return out


def _still(m: Machine, J: Array, q: Array) -> Array:
    """J with a row w . u = 1/2 sum (u x c) . c' for each link that could spin idly; its drift is zero."""
    rows = []
    for link, line in idle(m):
        k = 4 * m.links.index(link)
        row = np.zeros_like(q)
        row[:, k + 1 : k + 4] = np.cross((line @ q)[:, None], q[:, k + 1 : k + 4])
        rows.append(row[:, 4:].reshape(len(q), 1, -1))
    return np.concatenate([J, *rows], 1)


def _padded(m: Machine, right: Array) -> Array:
    return np.concatenate([right, np.zeros((len(right), len(idle(m))))], 1)


def unique(m: Machine, path: Array) -> dict[str, Array]:
    """Which components of each joint's force and moment (P, 6), in ground axes, the equations determine.

    Those that every set of multipliers without any load on the coordinates leaves at zero.
    """
    out: dict[str, list[Array]] = {name: [] for name in m.tree["joints"]}
    _, J, _, _ = system(m.rows, path, 0 * path)
    for q, jacobian in zip(path, J, strict=True):
        found = _unloaded(m, q, jacobian)
        for name, masks in out.items():
            both = np.concatenate([found.forces[name], found.moments[name]], -1)
            masks.append(np.all(np.abs(both) < 1e-9, 0))
    return {name: np.array(masks) for name, masks in out.items()}


def null_reactions(m: Machine, q: Array) -> Natural:
    """Reactions of a basis of multipliers that load no coordinate, at one pose (1, 4 L, 3); drives not counted."""
    return _unloaded(
        m, q[0], system(m.rows, np.repeat(q, m.count, 0), np.zeros((m.count, *q.shape[1:])))[1][0]
    )


def _unloaded(m: Machine, q: Array, jacobian: Array) -> Natural:
    _, values, right = np.linalg.svd(jacobian.T)
    null = right[int(np.sum(values > 1e-9 * values[0])) :]
    found = Natural(m.links, np.repeat(q[None], len(null), 0), 0 * q[None], 0 * q[None])
    _reactions(m, found, null)
    return found


def _reactions(m: Machine, found: Natural, multipliers: Array) -> None:
    rigid = len(m.rows) - len(m.joint_rows) - len(m.drive_rows)
    size = multipliers.shape[0], m.size, 3
    pushes = {name: np.zeros(size) for name in m.tree["joints"]}
    for k, row in enumerate(m.joint_rows):
        gradient = (_thread if isinstance(row, Thread) else _row)(row, found.q, found.v)[1]  # type: ignore[arg-type]
        pushes[row.name] += multipliers[:, rigid + k, None, None] * gradient
    for name, push in pushes.items():
        _, j, _, p_j = m.ends(name)
        k = 4 * m.links.index(j)
        force = push[:, k]
        about_origin = np.sum(np.cross(found.q[:, k + 1 : k + 4], push[:, k + 1 : k + 4]), 1)
        arm = p_j @ found.q - found.q[:, k]
        found.forces[name], found.moments[name] = force, about_origin - np.cross(arm, force)
    for k, (name, d) in enumerate(m.drives.items()):
        sense = -1.0 if d.freedom == "turn2" else 1.0
        found.efforts[name] = sense * multipliers[:, rigid + len(m.joint_rows) + k]


def mobility(m: Machine, q: Array) -> tuple[int, int, float]:
    """Freedoms and redundant constraints without drives at one pose (4 L, 3), and the gap in the singular values.

    The gap: the smallest singular value counted over the largest not counted (over the largest of all if none is left).
    """
    held = m.rows[: len(m.rows) - len(m.drive_rows)]
    _, J, _, _ = system(held, q[None], 0 * q[None])
    J = J[0]
    values = np.linalg.svd(J, compute_uv=False)
    small = values < 1e-8 * values[0]
    rank = int(np.sum(~small))
    gap = values[~small][-1] / (values[small][0] if small.any() else 1e-16 * values[0])
    return J.shape[1] - rank, len(held) - rank, float(gap)
