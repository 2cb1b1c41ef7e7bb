"""Groups of links that a drawing grows by: driven links, loops through any pairs, overconstrained ones, rods."""

from __future__ import annotations

import numpy as np

from tests.random_space.drawing import AXES, BALLS, PAIRS, Array, Drawing, Drive, rotation

POSITIONS = 3
MOVABLE = [kind for kind in PAIRS if kind != "weld"]


def place(rng: np.random.Generator) -> Array:
    return rng.uniform(-1, 1, 3)


def some(d: Drawing, rng: np.random.Generator) -> str:
    """An existing link that may be joined to, often the ground."""
    names = [name for name in d.poses if name not in d.rods]
    return names[int(rng.integers(len(names)))] if rng.random() < 0.6 else "ground"


def joined(
    d: Drawing, rng: np.random.Generator, kind: str, i: str, j: str, p: Array, swap: bool = True
) -> str:
    """A joint at p in any axes, with i and j in either order; its freedoms at any value, or at 0 where not posed."""
    if swap and rng.random() < 0.5:
        i, j = j, i
    pair = PAIRS[kind]
    slides = rng.uniform(-0.5, 0.5, len(pair.slides))
    turns = (
        rng.uniform(-1, 1, len(pair.turns)) if len(pair.turns) > 1 else rng.uniform(-3, 3, len(pair.turns))
    )
    values = tuple(float(x) for x in (*slides, *turns)) if d.posed else (0.0,) * pair.count
    more = {"lead": float(rng.choice([-1, 1]) * rng.uniform(0.2, 1.0))} if kind == "screw" else {}
    if kind.startswith("slotted_sphere") and rng.random() < 0.5:
        more["blocked"] = str(rng.choice(["x", "y", "z"]))
    name = d.join(kind, i, j, p, rotation(rng), values, **more)
    if kind == "weld":
        return name
    free = [f for f in pair.freedoms if kind not in BALLS or f != "turn"]
    if free and kind != "screw" and rng.random() < 0.25:
        d.joints[name].damping[str(rng.choice(free))] = float(rng.uniform(0.1, 2.0))
    return name


def drive(d: Drawing, rng: np.random.Generator, joint: str, freedom: str) -> None:
    """Prescribe a freedom; the turn of a ball gets an axis, not far from across its other turns."""
    j = d.joints[joint]
    if j.type in BALLS and freedom == "turn":
        d.joints[joint] = type(j)(**{**vars(j), "axis": rng.normal(size=3)})
    size = 0.005 if freedom.startswith("slide") else 0.01
    steps = (0.0, *np.cumsum(rng.uniform(0.3, 1.0, POSITIONS - 1) * size).tolist())
    speed = float(rng.choice([-1, 1]) * rng.uniform(0.5, 2))
    d.drives[f"{joint}_{freedom}"] = Drive(joint, freedom, steps, speed, float(rng.uniform(-5, 5)))


def driven(d: Drawing, rng: np.random.Generator) -> None:
    """One link on a joint whose freedoms are all driven."""
    kind = str(rng.choice([
        "revolute", "revolute", "prismatic", "screw", "cylindrical", "universal", "torus", "slotted_sphere",
        "slotted_cylinder",
    ]))  # fmt: skip
    p = place(rng)
    joint = joined(d, rng, kind, some(d, rng), d.link(rng, p), p)
    freedoms = PAIRS[kind].freedoms
    for freedom in [str(rng.choice(freedoms))] if kind == "screw" else freedoms:
        drive(d, rng, joint, freedom)


def loop(d: Drawing, rng: np.random.Generator) -> None:
    """A chain of new links between two others: its freedoms are six and those of its drives."""
    a, b = some(d, rng), some(d, rng)
    if a == b:
        return
    links, drives = int(rng.integers(1, 5)), int(rng.random() < 0.25)
    while True:
        kinds = [str(k) for k in rng.choice(MOVABLE, links + 1)]
        if sum(PAIRS[k].count for k in kinds) == 6 + drives:
            break
    joints = chain(d, rng, a, b, kinds)
    if drives:
        joint = joints[int(rng.integers(len(joints)))]
        drive(d, rng, joint, str(rng.choice(PAIRS[d.joints[joint].type].freedoms)))


def chain(d: Drawing, rng: np.random.Generator, a: str, b: str, kinds: list[str]) -> list[str]:
    """New links in a row from a to b by joints of these kinds."""
    places = [place(rng) for _ in kinds]
    row = [a, *(d.link(rng, p) for p in places[1:]), b]
    return [
        joined(d, rng, kind, i, j, p) for kind, i, j, p in zip(kinds, row[:-1], row[1:], places, strict=True)
    ]


def rod(d: Drawing, rng: np.random.Generator) -> None:
    """A loop through a link that only two balls hold: it may spin about their line, and is set not to."""
    a, b = some(d, rng), some(d, rng)
    if a == b:
        return
    first, last = str(rng.choice(BALLS)), str(rng.choice(BALLS))
    rest = 7 - PAIRS[first].count - PAIRS[last].count
    kinds = {1: ["revolute", "prismatic", "screw"], 0: []}.get(rest)
    if kinds is None:
        return
    p, r = place(rng), place(rng)
    spinning = d.link(rng, p)
    joints = [joined(d, rng, first, a, spinning, p)]
    if kinds:
        middle = d.link(rng, r)
        joints += [joined(d, rng, last, spinning, middle, r)]
        joined(d, rng, str(rng.choice(kinds)), middle, b, place(rng))
    else:
        joints += [joined(d, rng, last, spinning, b, r)]
    for joint in joints:  # what resists along a rod's own guide would depend on the spin that is set
        if d.joints[joint].i == spinning:
            d.joints[joint].damping.clear()
    ends = [ball(d, joint, spinning) for joint in joints]
    d.rods[spinning] = ends[0], ends[1]


def ball(d: Drawing, name: str, link: str) -> Array:
    """Centre of a ball: j's point."""
    j = d.joints[name]
    return d.spots[j.j][j.at_j]


def welded(d: Drawing, rng: np.random.Generator) -> None:
    p = place(rng)
    joined(d, rng, "weld", some(d, rng), d.link(rng, p), p)


def flat(d: Drawing, rng: np.random.Generator) -> None:
    """A driven four-bar with parallel axes, or with axes through one point: three constraints too many."""
    base, e, apex = some(d, rng), rotation(rng), 2 * place(rng)
    parallel = rng.random() < 0.5
    points = [place(rng) for _ in range(4)]
    row = [base, *(d.link(rng, p) for p in points[:3]), base]
    for k, p in enumerate(points):
        axis = e[2] if parallel else p - apex
        value = float(rng.uniform(-3, 3)) if d.posed else 0.0
        name = d.join("revolute", row[k], row[k + 1], p, frame_about(axis), (value,))
        if k == 0:
            drive(d, rng, name, "turn")


def twin(d: Drawing, rng: np.random.Generator) -> None:
    """A second joint on the axis of one there is: a door on two hinges, a shaft in two bearings."""
    there = [j for j in d.joints.values() if j.type in ("revolute", "cylindrical", "prismatic")]
    there = [j for j in there if not {j.i, j.j} & set(d.rods)]
    if not there:
        return
    j = there[int(rng.integers(len(there)))]
    axis = j.on_i[AXES.index("z" if j.type == "revolute" else "x")]
    p = d.spots[j.i][j.at_i] + axis * float(rng.uniform(0.3, 1.0))
    d.join(j.type, j.i, j.j, p, j.on_i, j.values)


def frame_about(axis: Array) -> Array:
    """Axes (rows) with z along a direction."""
    z = axis / np.linalg.norm(axis)
    x = np.cross(z, np.eye(3)[np.abs(z).argmin()])
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(z, x), z])
