"""How a drawing moves, by the screws of its joints; nothing of the product is used but, in ``seen``, its answers.

State: rotations (P, L, 3, 3) and origins (P, L, 3) of all links, ground first; twists about the origins (P, L, 6),
velocity before spin. The motion of j in i is a sum of the joint's screws, each (velocity of j's point, spin), so

    v_j - v_i = sum of q' (c - o_j x w terms), taken at the ground's origin: [v + o x w, w].

Unknown are the links' twists and the rates of all joints' freedoms; equations are six a joint and one a drive.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.random_space.drawing import AXES, BALLS, Array, Drawing, Joint, about
from tests.random_space.writing import ball_directions


@dataclass(frozen=True)
class State:
    """Where the links are, and how they move: twists and their rates, about the links' origins."""

    links: tuple[str, ...]
    rotation: Array
    origin: Array
    twist: Array
    rate: Array

    @property
    def count(self) -> int:
        return len(self.rotation)


def standing(d: Drawing) -> State:
    """As drawn."""
    rotation = np.array([r for r, _ in d.poses.values()])[None]
    origin = np.array([o for _, o in d.poses.values()])[None]
    still = np.zeros((1, len(d.links), 6))
    return State(d.links, rotation, origin, still, still)


def seen(r: Any, d: Drawing) -> State:
    """The state that a result tells."""
    count = len(r.status)
    rotation, origin = np.tile(np.eye(3), (count, len(d.links), 1, 1)), np.zeros((count, len(d.links), 3))
    twist, rate = np.zeros((count, len(d.links), 6)), np.zeros((count, len(d.links), 6))
    for k, link in enumerate(d.links):
        if link == "ground":
            continue
        rotation[:, k], origin[:, k] = r.rotation(link), r.position(link)
        w, alpha = r.speed(link), r.acceleration(link)
        arm = origin[:, k] - r.center(link)
        twist[:, k] = np.concatenate([r.velocity(link), w], axis=-1)
        a = r.center_acceleration(link) + np.cross(alpha, arm) + np.cross(w, np.cross(w, arm))
        rate[:, k] = np.concatenate([a, alpha], axis=-1)
    return State(d.links, rotation, origin, twist, rate)


class Places:
    """Points and directions of a drawing's links at the poses of a state."""

    def __init__(self, d: Drawing, s: State) -> None:
        self.d, self.s = d, s
        self.number = {name: k for k, name in enumerate(s.links)}

    def turn(self, link: str) -> Array:
        """Rotations (P, 3, 3) from the drawn pose."""
        return np.asarray(self.s.rotation[:, self.number[link]] @ self.d.poses[link][0].T)

    def vector(self, link: str, v: Array) -> Array:
        """A direction of the link (P, 3), drawn as v."""
        return np.asarray(self.turn(link) @ v)

    def point(self, link: str, p: Array) -> Array:
        """A point of the link (P, 3), drawn at p."""
        return self.s.origin[:, self.number[link]] + self.vector(link, p - self.d.poses[link][1])

    def ends(self, j: Joint) -> tuple[Array, Array]:
        return self.point(j.i, self.d.spots[j.i][j.at_i]), self.point(j.j, self.d.spots[j.j][j.at_j])

    def frames(self, j: Joint) -> tuple[Array, Array]:
        """Local axes (P, 3, 3) on i and on j, a row each."""
        return j.on_i @ np.swapaxes(self.turn(j.i), -1, -2), j.on_j @ np.swapaxes(self.turn(j.j), -1, -2)

    def velocity(self, link: str, p: Array) -> Array:
        """Of the link's point that is at p (P, 3)."""
        k = self.number[link]
        v, w = self.s.twist[:, k, :3], self.s.twist[:, k, 3:]
        return np.asarray(v + np.cross(w, p - self.s.origin[:, k]))

    def spin(self, link: str) -> Array:
        return np.asarray(self.s.twist[:, self.number[link], 3:])


def screws(at: Places, j: Joint) -> Array:
    """Motions (P, F, 6) that the joint allows j in i: velocity of j's point, spin."""
    on_i, on_j = at.frames(j)
    zero = np.zeros((*on_i.shape[:-2], 3))
    out = [np.concatenate([on_i[:, AXES.index(k)], zero], -1) for k in j.pair.slides]
    turns = j.pair.turns
    axes = [on_i[:, AXES.index(k)] for k in turns]
    if len(turns) == 2:
        axes[1] = on_j[:, AXES.index(turns[1])]
    pitch = j.lead / (2 * np.pi)
    out += [np.concatenate([pitch * u, u], -1) for u in axes]
    return np.stack(out, 1) if out else np.zeros((at.s.count, 0, 6))


def effort_screw(at: Places, j: Joint, freedom: str) -> Array:
    """Force at j's point and couple (P, 6) on j of a unit effort: its power is the freedom's rate."""
    on_i, on_j = at.frames(j)
    zero = np.zeros((*on_i.shape[:-2], 3))
    if freedom.startswith("slide"):
        place = (int(freedom[-1:]) if freedom[-1:].isdigit() else 1) - 1
        along = on_i[:, AXES.index((j.pair.slides or "x")[place])]
        return np.concatenate([along, zero], -1)
    if freedom == "turn2":
        couple = on_j[:, AXES.index(j.pair.turns[1])]
    elif j.type in BALLS:
        couple = _ball_couple(at, j)
    else:
        couple = on_i[:, AXES.index(j.pair.turns[0])]
    return np.concatenate([zero, couple], -1)


def _ball_couple(at: Places, j: Joint) -> Array:
    """Of the angle about an axis a of i of a direction p of j: p's part across a turns at couple . w."""
    assert j.axis is not None
    _, p = ball_directions(j.axis, j.on_i, j.on_j)
    a, p = at.vector(j.i, j.axis / np.linalg.norm(j.axis)), at.vector(j.j, p)
    across = p - np.sum(p * a, -1, keepdims=True) * a
    normal = np.cross(a, across)
    return np.asarray(np.cross(p, normal) / np.sum(across**2, -1, keepdims=True))


@dataclass(frozen=True)
class Equations:
    """Rows (P, 6 J + D + rods, 6 L + F) for the twists of the moving links at the ground's origin and the rates."""

    matrix: Array
    drives: tuple[str, ...]

    def solved(self, d: Drawing, rates: dict[str, float]) -> Array:
        """Twists (P, L, 6) at the ground's origin, ground first, at rates of the drives."""
        right = np.zeros(self.matrix.shape[:2])
        first = right.shape[1] - len(d.rods) - len(self.drives)
        for k, name in enumerate(self.drives):
            right[:, first + k] = rates.get(name, 0.0)
        x = np.array([np.linalg.lstsq(m, b, rcond=None)[0] for m, b in zip(self.matrix, right, strict=True)])
        links = len(d.links) - 1
        twists = np.zeros((len(x), links + 1, 6))
        twists[:, 1:] = x[:, : 6 * links].reshape(-1, links, 6)
        return twists


def equations(d: Drawing, s: State) -> Equations:
    at, count = Places(d, s), len(d.links) - 1
    free = sum(j.pair.count for j in d.joints.values())
    rows = np.zeros((s.count, 6 * len(d.joints) + len(d.drives) + len(d.rods), 6 * count + free))
    column, row = 6 * count, 0
    driven = 6 * len(d.joints)
    for name, j in d.joints.items():
        p = at.ends(j)[1]
        moving = screws(at, j)
        for link, sign in ((j.i, -1.0), (j.j, 1.0)):
            if link != "ground":
                k = 6 * (at.number[link] - 1)
                rows[:, row : row + 6, k : k + 6] += sign * np.eye(6)
        rows[:, row : row + 6, column : column + moving.shape[1]] = -np.swapaxes(
            at_origin(moving, p[:, None]), -1, -2
        )
        for n, drive in enumerate(x for x in d.drives.values() if x.joint == name):
            place = driven + [k for k, x in enumerate(d.drives.values()) if x.joint == name][n]
            unit = effort_screw(at, j, drive.freedom)
            rows[:, place, column : column + moving.shape[1]] = np.einsum("pfk,pk->pf", moving, unit)
        row, column = row + 6, column + moving.shape[1]
    for n, link in enumerate(d.rods):
        line = at.vector(link, rod_line(d, link))
        k = 6 * (at.number[link] - 1)
        rows[:, driven + len(d.drives) + n, k + 3 : k + 6] = line
    return Equations(rows, tuple(d.drives))


def rod_line(d: Drawing, link: str) -> Array:
    """Direction, as drawn, between the two joint points of a rod."""
    ends = [d.spots[link][j.at_i if j.i == link else j.at_j] for j in d.joints.values() if link in (j.i, j.j)]
    line = ends[1] - ends[0]
    return np.asarray(line / np.linalg.norm(line))


def at_origin(motion: Array, p: Array) -> Array:
    """The same motions told at the ground's origin instead of p: v - w x p."""
    return np.concatenate([motion[..., :3] - np.cross(motion[..., 3:], p), motion[..., 3:]], -1)


def quality(d: Drawing, s: State) -> tuple[float, float]:
    """Condition number, infinite where something is left to move, and the largest speed of a link."""
    found = equations(d, s)
    values = np.linalg.svd(found.matrix[0], compute_uv=False)
    if found.matrix.shape[1] < found.matrix.shape[2] or values[-1] < 1e-9:
        return np.inf, np.inf
    twists = found.solved(d, {name: x.speed for name, x in d.drives.items()})
    kept = values[values > 1e-9]
    return float(kept[0] / kept[-1]), float(np.max(np.abs(twists)))


def redundant(d: Drawing) -> int:
    """Constraints too many, as drawn."""
    matrix = equations(d, standing(d)).matrix[0]
    return int(len(matrix) - np.linalg.matrix_rank(matrix, tol=1e-7))


def moved(d: Drawing, s: State, amounts: dict[str, float]) -> State:
    """The state after small amounts of the drives' freedoms, by the midpoint rule."""
    half = _carried(s, equations(d, s).solved(d, amounts) / 2)
    return _carried(s, equations(d, half).solved(d, amounts))


def _carried(s: State, twists: Array) -> State:
    """Every link moved by a finite displacement with these twists at the ground's origin."""
    v, w = twists[..., :3] + np.cross(twists[..., 3:], s.origin), twists[..., 3:]
    angle = np.linalg.norm(w, axis=-1)
    turned = [
        [about(u if a > 0 else np.eye(3)[0], a) for u, a in zip(us, angles, strict=True)]
        for us, angles in zip(w, angle, strict=True)
    ]
    return State(s.links, np.array(turned) @ s.rotation, s.origin + v, s.twist, s.rate)


def gaps(d: Drawing, s: State) -> dict[str, float]:
    """How far each joint is from closing: lengths, and sines of angles."""
    at, out = Places(d, s), {}
    for name, j in d.joints.items():
        (p, r), (on_i, on_j) = at.ends(j), at.frames(j)
        slid = ((r - p)[:, None] @ np.swapaxes(on_i, -1, -2))[:, 0]
        apart = [np.delete(slid, [AXES.index(k) for k in (j.pair.slides or "x" * (j.type == "screw"))], 1)]
        turns = [AXES.index(k) for k in j.pair.turns]
        cosines = on_i @ np.swapaxes(on_j, -1, -2)
        if len(turns) == 0:
            apart.append((cosines - np.eye(3)).reshape(len(p), -1))
        elif len(turns) == 1:
            apart.append(on_i[:, turns[0]] - on_j[:, turns[0]])
        elif len(turns) == 2:
            apart.append(cosines[:, turns[0], turns[1], None])
        if j.type == "screw":
            angle = np.arctan2(cosines[:, 2, 1], cosines[:, 1, 1])
            turn = np.angle(np.exp(1j * (2 * np.pi * slid[:, 0] / j.lead - angle)))
            apart.append(turn[:, None] * j.lead / (2 * np.pi))
        out[name] = max(float(np.max(np.abs(a), initial=0.0)) for a in apart)
    return out
