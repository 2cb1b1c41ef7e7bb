"""Random mechanisms with friction in their joints, and what the laws of friction ask of a result."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

import dalembert as da
from tests.random_mechanisms import Rigid, random_mechanism, tree

Array = np.ndarray[Any, Any]
ROUGH = ("pin", "slider", "slot", "gear")
CYCLES = """
    four_bar slider_crank inverted_slider_crank whitworth crank_shaper scotch_yoke watt_1 watt_2 stephenson_1
    stephenson_2 stephenson_3 toggle_press
"""


def rough_tree(
    seed: int, most: float = 0.6, links: tuple[int, int] = (2, 12), motion: Rigid | None = None
) -> dict[str, Any]:
    """The model tree of a random mechanism with friction in most of its joints; coefficients up to ``most``."""
    made = tree(random_mechanism(seed, links), motion=motion)
    rng = np.random.default_rng(seed + 77)
    made["friction"] = {"circle": str(rng.choice(["sin", "tan"])), "coefficient": float(rng.uniform(0, most))}
    for joint in made["joints"].values():
        if joint["type"] in ROUGH and rng.random() < 0.8:
            joint["friction"] = _friction(joint["type"], rng, most)
    return made


def _friction(kind: str, rng: np.random.Generator, most: float) -> dict[str, Any]:
    made: dict[str, Any] = {}
    if rng.random() < 0.8:
        made["coefficient"] = float(rng.uniform(0, most))
    if kind in ("pin", "slot") and (kind == "pin" or rng.random() < 0.5):
        made["radius"] = float(rng.uniform(0.005, 0.08))
    if kind == "slider" and rng.random() < 0.7:
        made["guide"] = [float(x) for x in rng.uniform(0.02, 0.5, 2)]
        if rng.random() < 0.5:
            made["half_height"] = float(rng.uniform(0, 0.1))
    if kind == "gear":
        made["arm"] = float(rng.uniform(0.002, 0.02))
    return made


def still_tree(seed: int, most: float) -> dict[str, Any]:
    """A random mechanism without speed, at its first position."""
    tree = rough_tree(seed, most=most, links=(2, 8))
    for drive in tree["drives"].values():
        drive["speed"] = "0 rad/s" if isinstance(drive["speed"], str) else 0.0
        drive["acceleration"] = "0 rad/s^2" if isinstance(drive["acceleration"], str) else 0.0
        drive["position"] = drive["position"][:1]
    return tree


@lru_cache(maxsize=64)
def rough(seed: int) -> Any:
    """The mechanism of a seed."""
    return da.mechanism(rough_tree(seed))


def cycle(template: str, count: int = 90) -> Any:
    """A library mechanism with friction in all pins and guides, light enough to run, over one turn."""
    tree = getattr(da, template)().to_tree()
    tree["friction"] = {"coefficient": 0.08, "circle": "sin"}
    for joint in tree["joints"].values():
        if joint["type"] == "pin":
            joint["friction"] = {"radius": "6 mm"}
        if joint["type"] == "slider":
            joint["friction"] = {"guide": ["40 mm", "60 mm"], "half_height": "10 mm"}
        if joint["type"] == "slot":
            joint["friction"] = {"radius": "6 mm"}
    for drive in tree["drives"].values():
        drive["position"] = {"from": "3.7 deg", "to": "363.7 deg", "count": count}
    return da.mechanism(tree)


def unlawful(r: Any) -> Array:
    """How far each solved position is from the laws of its contacts, relative to the largest force (P,).

    Everything is read from the result's public numbers: reactions, parts of friction, relative rates.
    """
    m, off = r.mechanism, np.zeros(len(r.status))
    sizes = np.array([np.hypot(*r.reaction(j).T) for j in r.joints])
    largest = np.where(np.isnan(sizes).all(axis=0), np.nan, np.nan_to_num(sizes).max(axis=0))
    length = r.compiled.layout.length
    for name, joint in m.joints.items():
        for gap, scale in _gaps(r, name, joint, length):
            off = np.maximum(off, np.abs(gap) / (largest * scale))
    return off


def _mu(m: Any, joint: Any) -> float:
    own = joint.friction.coefficient
    return float(m.friction.coefficient if own is None else own)


def _gaps(r: Any, name: str, joint: Any, length: float) -> list[tuple[Array, float]]:
    if getattr(joint, "friction", None) is None:
        return [(r.friction_moment(name), length), (r.friction_force(name).sum(-1), 1.0)]
    f, mu = joint.friction, _mu(r.mechanism, joint)
    circle = f.circle if getattr(f, "circle", None) else r.mechanism.friction.circle
    lever = mu / np.hypot(1, mu) if circle == "sin" else mu
    if joint.type == "pin":
        sense = np.sign(r.freedom(name, "turn")[1])
        force = np.hypot(*r.reaction(name).T)
        return [(r.friction_moment(name) + sense * lever * f.radius * force, length)]
    if joint.type == "gear":
        rate = _turn_rate(r, joint)
        normal = _tooth_force(r, name, joint)
        return [(r.friction_moment(name) + np.sign(rate) * mu * f.arm * normal, length)]
    return _sliding(r, name, joint, mu, lever, length)


def _sliding(
    r: Any, name: str, joint: Any, mu: float, lever: float, length: float
) -> list[tuple[Array, float]]:
    f, i = joint.friction, joint.links[0]
    angle = joint.direction + (0.0 if i == "ground" else r.angle(i)) * np.ones(len(r.status))
    e = np.stack([np.cos(angle), np.sin(angle)], -1)
    across = np.stack([-e[:, 1], e[:, 0]], -1)
    force = r.reaction(name)
    normal = (force * across).sum(-1)
    sense = np.sign(r.freedom(name, "slide")[1])
    couple = r.reaction_moment(name)
    bearing, gaps = np.abs(normal), []
    if joint.type == "slider":
        faces = -sense * mu * (f.half_height or 0.0) * normal
        gaps.append((r.friction_moment(name) - faces, length))
        if f.guide is not None:
            l1, l2 = f.guide
            tilting = np.abs(2 * (couple - faces) - (l2 - l1) * normal) / (l1 + l2)
            bearing = np.maximum(bearing, tilting)
    elif f.radius:
        turn = np.sign(r.freedom(name, "turn")[1])
        gaps.append((r.friction_moment(name) + turn * lever * f.radius * np.hypot(*force.T), length))
    gaps.append(((r.friction_force(name) * e).sum(-1) + sense * mu * bearing, 1.0))
    gaps.append(((r.friction_force(name) * across).sum(-1), 1.0))
    return gaps


def _turn_rate(r: Any, joint: Any) -> Array:
    i, j = ((r.speed(k) if k != "ground" else 0.0) for k in joint.links)
    return np.asarray(j - i) * np.ones(len(r.status))


def _tooth_force(r: Any, name: str, joint: Any) -> Array:
    """Normal tooth force: the tangential part of the mesh's reaction over cos(pressure angle)."""
    spots = []
    for link, at in zip(joint.links, r.mechanism.joint_points(name), strict=True):
        turn = np.zeros(len(r.status)) if link == "ground" else r.angle(link)
        origin = np.zeros((len(turn), 2)) if link == "ground" else r.position(link)
        c, s = np.cos(turn), np.sin(turn)
        spots.append(origin + np.stack([c * at[0] - s * at[1], s * at[0] + c * at[1]], -1))
    line = spots[1] - spots[0]
    line /= np.hypot(line[:, 0], line[:, 1])[:, None]
    force = r.reaction(name)
    tangential = np.abs(force[:, 1] * line[:, 0] - force[:, 0] * line[:, 1])
    return tangential / np.cos(joint.pressure_angle)
