"""What masses, loads, springs and dampers do to the natural coordinates of ``natural``: arrays (P, 4 L, 3)."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.reading import Array, Tree, number


def momentum(m: Any, a: Array) -> Array:
    """M Q'': the moments of zeroth, first and second order of each link's mass."""
    out = np.zeros_like(a)
    for k, link in enumerate(m.links):
        t = m.tree["links"].get(link, {})
        mass, center = number(t.get("mass", 0.0)), np.asarray(t.get("center", [0.0, 0.0, 0.0]), float)
        about = np.asarray(t.get("inertia", [0.0, 0.0, 0.0]), float)
        about = np.diag(about) if about.ndim == 1 else about
        second = 0.5 * np.trace(about) * np.eye(3) - about + mass * np.outer(center, center)
        first = mass * center
        block = np.block([[np.array([[mass]]), first[None]], [first[:, None], second]])
        out[:, 4 * k : 4 * k + 4] = block @ a[:, 4 * k : 4 * k + 4]
    return out


def applied(m: Any, q: Array, v: Array) -> Array:
    """Weights, loads, springs and dampers on the coordinates."""
    gravity = m.tree.get("gravity", "none")
    g = np.zeros(3) if gravity == "none" else np.asarray(gravity, float)
    out = momentum(m, np.stack([g if k % 4 == 0 else 0 * g for k in range(m.size)])[None] + 0 * q)
    for load in m.tree.get("loads", {}).values():
        pulls = _line if "between" in load else _torsion
        {"force": _force, "couple": _couple}.get(load["type"], pulls)(m, load, out, q, v)
    for name, joint in m.tree["joints"].items():
        if "damping" in joint:
            _damping(m, name, joint, out, q, v)
    return out


def _turned(load: Tree, q: Array, k: int) -> Array:
    value = np.asarray(load["value"], float)
    if load.get("axes", "ground") == "link":
        return np.einsum("k,...kn->...n", value, q[:, k + 1 : k + 4])
    return value + 0 * q[:, 0]


def _force(m: Any, load: Tree, out: Array, q: Array, v: Array) -> None:
    out += m.point(load["on"], load["at"])[:, None] * _turned(load, q, 4 * m.links.index(load["on"]))[:, None]


def _couple(m: Any, load: Tree, out: Array, q: Array, v: Array) -> None:
    k = 4 * m.links.index(load["on"])
    _twist(out, q, k, _turned(load, q, k))


def _twist(out: Array, q: Array, k: int, couple: Array) -> None:
    """A couple M is 1/2 M x c on each axis c."""
    out[:, k + 1 : k + 4] += 0.5 * np.cross(couple[:, None], q[:, k + 1 : k + 4])


def _line(m: Any, load: Tree, out: Array, q: Array, v: Array) -> None:
    """A spring or damper pulls its ends together."""
    p, r = (m.point(*end.split(".")) for end in load["between"])
    line, rate = (r - p) @ q, (r - p) @ v
    length = np.linalg.norm(line, axis=-1)
    along = line / length[:, None]
    if "force" in load:
        tension = load["force"] + 0 * length
    elif load["type"] == "spring":
        tension = load["stiffness"] * (length - load.get("free_length", 0.0))
    else:
        tension = load["damping"] * _dot(rate, along)
    out += (p - r)[:, None] * (tension[:, None] * along)[:, None]


def _torsion(m: Any, load: Tree, out: Array, q: Array, v: Array) -> None:
    """A spring or damper in the turn of a joint; bare stiffness and damping are per radian."""
    axis, b, e, on_j = (s @ q for s in m.turning(load["joint"]))
    if load["type"] == "torsion_spring":
        size = -load["stiffness"] * (
            np.arctan2(_dot(on_j, e), _dot(on_j, b)) - np.radians(load.get("free_angle", 0))
        )
    else:
        size = -load["damping"] * _spin(m, load["joint"], axis, q, v)
    _twist_joint(m, load["joint"], out, q, size[:, None] * axis)


def _spin(m: Any, name: str, axis: Array, q: Array, v: Array) -> Array:
    """Relative rate of turn: w = 1/2 sum c x c'."""
    i, j = (4 * m.links.index(link) for link in m.tree["joints"][name]["links"])
    w_i, w_j = (0.5 * np.sum(np.cross(q[:, k + 1 : k + 4], v[:, k + 1 : k + 4]), 1) for k in (i, j))
    return _dot(w_j - w_i, axis)


def _twist_joint(m: Any, name: str, out: Array, q: Array, couple: Array) -> None:
    i, j = (4 * m.links.index(link) for link in m.tree["joints"][name]["links"])
    _twist(out, q, i, -couple)
    _twist(out, q, j, couple)


def _damping(m: Any, name: str, joint: Tree, out: Array, q: Array, v: Array) -> None:
    given = joint["damping"]
    if "turn" in given:
        axis = m.turning(name)[0] @ q
        _twist_joint(m, name, out, q, -given["turn"] * _spin(m, name, axis, q, v)[:, None] * axis)
    if "slide" in given:
        _, _, p_i, p_j = m.ends(name)
        x = m.axes(name)[0][0]
        rate = _dot((p_j - p_i) @ v, x @ q) + _dot((p_j - p_i) @ q, x @ v)
        force = -given["slide"] * rate[:, None] * (x @ q)
        k = 4 * m.links.index(joint["links"][0])
        out += p_j[:, None] * force[:, None]
        out[:, k] -= force
        _twist(out, q, k, -np.cross(p_j @ q - q[:, k], force))


def _dot(a: Array, b: Array) -> Array:
    return np.sum(a * b, -1)
