"""Lagrange multipliers: positions by Newton in extended precision, reactions as multipliers.

Every driven freedom is one more constraint, so J is square: J v = rates, J a = gamma + rates',
J^T lambda = -wrench. A joint's wrench on j is its rows' transpose times its multipliers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.oracles.constraints import compiled, size
from tests.oracles.reading import Array, Joint, Machine, Tree, machine, number
from tests.oracles.wrenches import cross, known, placed, push, turned


@dataclass(frozen=True)
class Answer:
    """Positions (P, L, 3) and rates; reactions on j at its point (gear, rolling: contact); efforts."""

    machine: Machine
    q: Array
    v: Array
    a: Array
    forces: dict[str, Array]
    moments: dict[str, Array]
    efforts: dict[str, Array]
    condition: float

    def length(self) -> float:
        """Largest distance in the machine, to put moments and forces on one scale."""
        return float(np.max(np.abs(self.q[..., :2]))) or 1.0

    def force_scale(self) -> float:
        return max(float(np.max(np.abs(f))) for f in self.forces.values()) or 1.0


@dataclass(frozen=True)
class Row:
    """One joint or drive in the Jacobian."""

    name: str
    kind: str
    joint: Joint
    parameters: tuple[Array | float, ...]
    position: Array | float = 0.0
    speed: Array | float = 0.0
    acceleration: Array | float = 0.0


def solve(tree: Tree, guess: Array, inertia: bool = True) -> Answer:
    """The answer at every position; ``guess`` (P, L, 3) chooses the assembly mode and the phase of meshes."""
    m = machine(tree)
    all_rows = [*rows(m, guess), *_drive_rows(m)]
    q = _closed(all_rows, guess.astype(np.longdouble))
    _, J, _ = _system(all_rows, q, np.zeros_like(q))
    v = _full(_solved(J, _stacked(all_rows, "speed", q)))
    _, _, gamma = _system(all_rows, q, v)
    a = _full(_solved(J, gamma + _stacked(all_rows, "acceleration", q)))
    w = known(m, q, v, a if inertia else None)
    multipliers = _multipliers(all_rows, J, w, q)
    forces, moments, efforts = _reactions(all_rows, multipliers, q)
    return Answer(
        m, q.astype(float), v.astype(float), a.astype(float), forces, moments, efforts, _condition(J, q)
    )


def quality(tree: Tree, pose: Array) -> tuple[float, Array, Array]:
    """Condition of J, speeds and accelerations at a pose (1, L, 3) that closes: cheap, in double precision."""
    m = machine(tree)
    drawn = [*rows(m, pose), *_drive_rows(m)]
    first = [
        Row(
            r.name,
            r.kind,
            r.joint,
            r.parameters,
            *(np.ravel(x)[0] for x in (r.position, r.speed, r.acceleration)),
        )
        for r in drawn
    ]
    J = _system(first, pose, 0 * pose)[1]
    v = _full(np.linalg.solve(J, _stacked(first, "speed", pose)[..., None])[..., 0])
    gamma = _system(first, pose, v)[2] + _stacked(first, "acceleration", pose)
    return _condition(J, pose), v, _full(np.linalg.solve(J, gamma[..., None])[..., 0])


def _condition(J: Array, q: Array) -> float:
    """Of the Jacobian with lengths divided by the machine's."""
    scale = np.tile([1.0, 1.0, 1.0 / float(np.max(np.abs(q[..., :2])) or 1.0)], J.shape[-1] // 3)
    scaled = J.astype(float) * scale
    return float(np.max(np.linalg.cond(scaled / np.linalg.norm(scaled, axis=-1, keepdims=True))))


def rows(m: Machine, guess: Array) -> list[Row]:
    """The joints' rows; ``guess`` gives the phase of meshes and rolling wheels."""
    return [_joint_row(joint, guess) for joint in m.joints]


def _joint_row(joint: Joint, guess: Array) -> Row:
    kind, ri, rj = _radii(joint)
    d = placed(guess, joint.j, joint.at_j) - placed(guess, joint.i, joint.at_i)
    start = np.arctan2(d[:, 1], d[:, 0])
    start = np.unwrap(start)
    parameters = [
        *joint.at_i,
        *joint.at_j,
        joint.angle("direction"),
        joint.angle("angle"),
        ri,
        rj,
        0.0,
        start,
    ]
    if kind in ("gear", "rolling", "rolling_circle"):
        at_first = _evaluate(Row(joint.name, kind, joint, tuple(parameters)), guess, 0 * guess)[0]
        parameters[8] = at_first[0, -1]
    return Row(joint.name, kind, joint, tuple(parameters))


def _radii(joint: Joint) -> tuple[str, float, float]:
    """Kind of the joint, signed radii (the ring of an internal pair counts against its wheel)."""
    t = joint.tree
    if joint.type == "rolling" and "radius" in t:
        return "rolling", 0.0, number(t["radius"])
    if joint.type == "circular_slot":
        return joint.type, number(t["radius"]), 0.0
    if "radii" not in t:
        return joint.type, 0.0, 0.0
    ri, rj = (number(r) for r in t["radii"])
    if t.get("internal", False):
        ri, rj = (ri, -rj) if ri > rj else (-ri, rj)
    return ("rolling_circle" if joint.type == "rolling" else "gear"), ri, rj


def _drive_rows(m: Machine) -> list[Row]:
    joints = {joint.name: joint for joint in m.joints}
    rows = []
    for d in m.drives:
        joint = joints[d.joint]
        parameters = (*joint.at_i, *joint.at_j, joint.angle("direction"), 0.0, 0.0, 0.0, 0.0, 0.0)
        rows.append(Row(d.name, d.freedom, joint, parameters, d.position, d.speed, d.acceleration))
    return rows


def _evaluate(row: Row, q: Array, v: Array) -> tuple[Array, Array, Array]:
    qs, vs = ([x[:, link, k] for link in (row.joint.i, row.joint.j) for k in range(3)] for x in (q, v))
    return compiled(row.kind)(qs, vs, row.parameters)  # type: ignore[no-any-return]


def _system(rows: list[Row], q: Array, v: Array) -> tuple[Array, Array, Array]:
    """Stacked phi, J over the moving links, gamma."""
    P, L, _ = q.shape
    phis, gammas, blocks = [], [], []
    for row in rows:
        phi, J, gamma = _evaluate(row, q, v)
        block = np.zeros((P, phi.shape[1], L, 3), q.dtype)
        block[:, :, row.joint.i] += J[..., :3]
        block[:, :, row.joint.j] += J[..., 3:]
        phis.append(phi - np.reshape(row.position, (-1, 1)))
        gammas.append(gamma)
        blocks.append(block[:, :, 1:].reshape(P, -1, 3 * (L - 1)))
    return np.concatenate(phis, 1), np.concatenate(blocks, 1), np.concatenate(gammas, 1)


def _closed(rows: list[Row], q: Array) -> Array:
    """Newton, until the residual no longer falls (full precision of the extended type)."""
    best = np.inf
    for _ in range(60):
        phi, J, _ = _system(rows, q, np.zeros_like(q))
        open_by = float(np.max(np.abs(phi)))
        if open_by < 1e-14 and open_by >= best / 4:
            return q
        best = min(best, open_by)
        q = q - _full(_solved(J, phi))
    raise ArithmeticError(f"the oracle does not close: residual {open_by}")


def _solved(A: Array, b: Array) -> Array:
    """A x = b with two refinements whose residual is in extended precision."""
    A64 = A.astype(float)
    x = np.zeros_like(b)
    for _ in range(3):
        r = b - np.einsum("pij,pj->pi", A, x)
        x = x + np.linalg.solve(A64, r.astype(float)[..., None])[..., 0]
    return x


def _full(moving: Array) -> Array:
    """Put ground, at rest, in front."""
    P = len(moving)
    return np.concatenate([np.zeros((P, 1, 3), moving.dtype), moving.reshape(P, -1, 3)], 1)


def _stacked(rows: list[Row], rate: str, q: Array) -> Array:
    columns = [np.broadcast_to(np.reshape(getattr(r, rate), (-1, 1)), (len(q), size(r.kind))) for r in rows]
    return np.concatenate(columns, 1).astype(q.dtype)


def _multipliers(rows: list[Row], J: Array, w: Array, q: Array) -> dict[tuple[str, str], tuple[Array, Array]]:
    """(name, kind) of a row -> (multipliers, extra wrench on j): the radial tooth force follows the tangential one."""
    across = _split(rows, _solved(np.swapaxes(J, 1, 2), -_flat(w)))
    zero = np.zeros(2)
    radial = {r.name: _radial(r, across[r.name, r.kind], q) for r in rows if r.kind == "gear"}
    total = w + sum((_on_both(r, radial[r.name], q) for r in rows if r.kind == "gear"), np.zeros_like(w))
    final = _split(rows, _solved(np.swapaxes(J, 1, 2), -_flat(total)))
    return {key: (value, radial.get(key[0], zero)) for key, value in final.items()}


def _flat(w: Array) -> Array:
    return w[:, 1:].reshape(len(w), -1)


def _split(rows: list[Row], multipliers: Array) -> dict[tuple[str, str], Array]:
    out, start = {}, 0
    for row in rows:
        out[row.name, row.kind] = multipliers[:, start : start + size(row.kind)]
        start += size(row.kind)
    return out


def contact(row: Row, q: Array) -> Array:
    """Where the reaction acts: the pitch point or contact, else j's point."""
    at_j = placed(q, row.joint.j, row.joint.at_j)
    if row.kind == "rolling":
        return at_j - float(row.parameters[7]) * turned(q[:, row.joint.i, 2] + row.parameters[4], (0.0, 1.0))
    if row.kind not in ("gear", "rolling_circle"):
        return at_j
    return at_j - row.parameters[7] * _line_of_centres(row, q)


def _line_of_centres(row: Row, q: Array) -> Array:
    d = placed(q, row.joint.j, row.joint.at_j) - placed(q, row.joint.i, row.joint.at_i)
    return d / np.hypot(d[:, 0], d[:, 1])[:, None]


def _radial(row: Row, multiplier: Array, q: Array) -> Array:
    """The tooth force on j along the line of centres: apart outside, towards each other inside a ring."""
    pressure = row.joint.tree.get("pressure_angle", 20.0)
    radial = np.abs(multiplier) * np.tan(np.radians(pressure))
    sign = -1.0 if row.joint.tree.get("internal", False) else 1.0
    return sign * radial * _line_of_centres(row, q)


def _on_both(row: Row, force: Array, q: Array) -> Array:
    w = np.zeros_like(q)
    spot = contact(row, q)
    push(w, q, row.joint.j, spot, force)
    push(w, q, row.joint.i, spot, -force)
    return w


def _reactions(
    rows: list[Row], multipliers: dict[tuple[str, str], tuple[Array, Array]], q: Array
) -> tuple[dict[str, Array], dict[str, Array], dict[str, Array]]:
    forces: dict[str, Array] = {}
    moments: dict[str, Array] = {}
    efforts: dict[str, Array] = {}
    for row in rows:
        values, extra = multipliers[row.name, row.kind]
        if row.kind in ("turn", "slide"):
            efforts[row.name] = values[:, 0].astype(float)
            continue
        wrench = np.einsum("pkc,pk->pc", _evaluate(row, q, 0 * q)[1][..., 3:], values)
        arm = contact(row, q) - q[:, row.joint.j, :2]
        forces[row.name] = (wrench[:, :2] + extra).astype(float)
        moments[row.name] = (wrench[:, 2] - cross(arm, wrench[:, :2])).astype(float)
    return forces, moments, efforts
