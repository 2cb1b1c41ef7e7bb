"""Random mechanisms in space, drawn as they close: chains of random pairs from link to link, back to another link.

Points and axes are given in ground axes; every link's own axes lie askew, and `assembly` says how. The joints' freedoms
are counted so that 6 a loop remain without the drives; what is not well driven there is drawn anew.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.reading import Array, Tree
from tests.oracles.space import natural
from tests.oracles.space.parts import inertia, plain, skew

FREEDOMS = {
    "revolute": 1, "prismatic": 1, "screw": 1, "cylindrical": 2, "universal": 2, "slotted_cylinder": 2, "torus": 2,
    "slotted_sphere": 2, "spherical": 3, "plane": 3, "slotted_sphere_in_cylinder": 3, "cylinder_between_planes": 4,
    "sphere_in_cylinder": 4, "sphere_between_planes": 5,
}  # fmt: skip
DRIVEN = {
    "revolute": ["turn"], "prismatic": ["slide"], "screw": ["turn", "slide"], "cylindrical": ["slide", "turn"],
    "universal": ["turn1", "turn2"], "torus": ["turn1", "turn2"], "slotted_cylinder": ["slide", "turn"],
    "plane": ["slide1", "slide2", "turn"], "slotted_sphere_in_cylinder": ["slide", "turn1", "turn2"],
    "cylinder_between_planes": ["slide1", "slide2", "turn1", "turn2"], "sphere_in_cylinder": ["slide"],
}  # fmt: skip
"""Freedoms that may be driven."""
STEPS = 3


def mechanism(seed: int) -> tuple[Tree, natural.Machine, Array]:
    """A tree, its machine, and its coordinates at every position of the drives."""
    rng = np.random.default_rng([2026, seed])
    while True:
        tree = _tree(rng)
        if tree is None:
            continue
        m = natural.Machine(tree)
        start = laid(m, tree)
        if natural.idle(m) or not _well_driven(m, start):
            continue
        path, gaps = natural.marched(tree, start)
        if max(gaps) < 1e-13 and all(_well_driven(m, q) for q in path):
            return tree, m, path


def _tree(rng: Any) -> Tree | None:
    """Loops one after another: each starts at a link there is and comes back to another one, or to the same."""
    links, joints, rotations = ["ground"], {}, {"ground": np.eye(3)}
    places: dict[str, Array] = {"ground": np.zeros(3)}
    drives = 0
    for _ in range(rng.integers(1, 3)):
        new = [f"link{len(links) + k}" for k in range(int(rng.integers(2, 5)))]
        ends = rng.choice(links, 2) if len(links) > 1 else ["ground", "ground"]
        kinds = _kinds(rng, len(new) + 1, 6 + (1 if drives == 0 else int(rng.integers(0, 2))))
        if kinds is None:
            return None
        drives += sum(FREEDOMS[k] for k in kinds) - 6
        chain = [str(ends[0]), *new, str(ends[1])]
        for link in new:
            places[link], rotations[link] = rng.uniform(-0.3, 0.3, 3), skew(int(rng.integers(1 << 30)))
        for k, kind in enumerate(kinds):
            joints[f"J{len(joints) + 1}"] = (kind, chain[k], chain[k + 1], rng.uniform(-0.4, 0.4, 3), rng)
        links += new
    drawn = {name: _joint(name, *joint, places, rotations) for name, joint in joints.items()}
    movable = [(name, f) for name, (joint, _) in drawn.items() for f in DRIVEN.get(joint["type"], [])]
    if len(movable) < drives:
        return None
    driven = [movable[k] for k in rng.choice(len(movable), drives, replace=False)]
    tree = _whole(rng, links, drawn, places, rotations)
    m = natural.Machine(tree)
    q = laid(m, tree)
    for joint, freedom in driven:
        tree["drives"][f"{joint} {freedom}"] = _drive(rng, joint, freedom, m.value(joint, freedom, q))
    return tree


def _kinds(rng: Any, count: int, freedoms: int) -> list[str] | None:
    """Pairs of a loop with this many freedoms together."""
    names = list(FREEDOMS)
    for _ in range(200):
        kinds = [str(k) for k in rng.choice(names, count)]
        if sum(FREEDOMS[k] for k in kinds) == freedoms:
            return kinds
    return None


def _joint(
    name: str,
    kind: str,
    i: str,
    j: str,
    at: Array,
    rng: Any,
    places: dict[str, Array],
    rotations: dict[str, Array],
) -> tuple[Tree, dict[str, tuple[str, Array]]]:
    """The joint and its points, by link; local axes agree as drawn, those of a universal's pins stand square."""
    axes = skew(int(rng.integers(1 << 30)))
    on = {}
    for side, link in (("i", i), ("j", j)):
        x, z = rotations[link].T @ axes[:, 0], rotations[link].T @ axes[:, 2]
        on[side] = {"x": plain(x), "z": plain(z)}
    if kind == "universal":
        on = {"i": {"z": on["i"]["z"]}, "j": {"z": on["j"]["x"]}}
    points = {link: rotations[link].T @ (at - places[link]) for link in (i, j)}
    tree: Tree = {"type": kind, "links": [i, j], "axes": on}
    if kind == "screw":
        tree["lead"] = float(rng.uniform(0.02, 0.3))
    damped = {
        "revolute": {"turn": 0.3},
        "prismatic": {"slide": 4.0},
        "cylindrical": {"slide": 3.0, "turn": 0.2},
    }
    if kind in damped and rng.random() < 0.5:
        tree["damping"] = damped[kind]
    return tree, points


def _whole(
    rng: Any,
    links: list[str],
    drawn: Any,
    places: dict[str, Array],
    rotations: dict[str, Array],
) -> Tree:
    points: dict[str, Tree] = {link: {"E": plain(rng.uniform(-0.2, 0.2, 3))} for link in links}
    for name, (_, at) in drawn.items():
        for link, spot in at.items():
            points[link][name] = plain(spot)
    bodies = {
        link: {
            "points": points[link], "mass": float(rng.uniform(0.5, 3)), "center": plain(rng.uniform(-0.1, 0.1, 3)),
            "inertia": plain(inertia(int(rng.integers(1 << 30)), 0.05)),
        }
        for link in links[1:]
    }  # fmt: skip
    return {
        "dalembert": 1, "space": "space", "gravity": plain(rng.uniform(-10, 10, 3)),
        "links": {"ground": {"points": points["ground"]}, **bodies},
        "joints": {name: joint for name, (joint, _) in drawn.items()},
        "drives": {},
        "loads": _loads(rng, links, [name for name, (joint, _) in drawn.items() if joint["type"] == "revolute"]),
        "assembly": {link: _pose(places[link], rotations[link]) for link in links[1:]},
    }  # fmt: skip


def _drive(rng: Any, joint: str, freedom: str, start: float) -> Tree:
    slides = freedom.startswith("slide")
    unit, size = ("m", 0.01) if slides else ("rad", 0.07)
    rate, gain = rng.uniform(-3, 3, 2)
    return {
        "joint": joint, "freedom": freedom, "speed": f"{rate} {unit}/s", "acceleration": f"{gain} {unit}/s^2",
        "position": {"from": f"{start} {unit}", "to": f"{start + rng.uniform(-size, size)} {unit}", "count": STEPS},
    }  # fmt: skip


def _loads(rng: Any, links: list[str], turning: list[str]) -> Tree:
    a, b = (str(x) for x in rng.choice(links, 2, replace=False))
    loads: Tree = {
        "F": {"type": "force", "on": links[-1], "at": "E", "value": plain(rng.uniform(-30, 30, 3))},
        "L": {"type": "force", "on": links[1], "at": plain(rng.uniform(-0.2, 0.2, 3)), "axes": "link",
              "value": plain(rng.uniform(-30, 30, 3))},
        "M": {"type": "couple", "on": links[-1], "value": plain(rng.uniform(-5, 5, 3))},
        "S": {"type": "spring", "between": [f"{a}.E", f"{b}.E"], "stiffness": 200.0, "free_length": 0.1},
        "D": {"type": "damper", "between": [f"{b}.E", f"{a}.E"], "damping": 5.0},
    }  # fmt: skip
    if turning:
        loads["T"] = {"type": "torsion_spring", "joint": turning[0], "stiffness": 3.0, "free_angle": 20.0}
        loads["R"] = {"type": "torsion_damper", "joint": turning[-1], "damping": 0.4}
    return loads


def _pose(place: Array, r: Array) -> Tree:
    w = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    angle = np.degrees(np.arctan2(np.linalg.norm(w), np.trace(r) - 1.0))
    return {"position": plain(place), "axis": plain(w / np.linalg.norm(w)), "angle": float(angle)}


def laid(m: natural.Machine, tree: Tree) -> Array:
    """Coordinates of the poses of `assembly`."""
    q = natural.drawn(m)
    for link, pose in tree["assembly"].items():
        k = 4 * m.links.index(link)
        u, t = np.array(pose["axis"]), np.radians(pose["angle"])
        skewed = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
        r = np.eye(3) + np.sin(t) * skewed + (1 - np.cos(t)) * skewed @ skewed
        q[k], q[k + 1 : k + 4] = pose["position"], r.T
    return q


def _well_driven(m: natural.Machine, q: Array) -> bool:
    """As many rows as coordinates, and far from singular."""
    path = np.repeat(q[None], m.count, 0)
    _, J, _, _ = natural.system(m.rows, path, 0 * path)
    if J.shape[1] != J.shape[2]:
        return False
    values = np.linalg.svd(J[0], compute_uv=False)
    return bool(values[-1] > 0.01 * values[0])
