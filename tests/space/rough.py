"""Random mechanisms in space with friction in most joints that can have it, and how far a result is from its laws."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

import dalembert as da
from tests.oracles.reading import Array, Tree
from tests.oracles.space import rubbing
from tests.random_space import SI, Drawing, Options, Style, random_drawing, tree
from tests.space.screw_motion import Places, State

SOLVED = ("ok", "self_locking")
MOST = 0.6
"""Largest coefficient; of two mechanisms in three 0.18 or 0.06, so that they do not jam."""


def roughened(made: Tree, seed: int, most: float = MOST, style: Style = SI, plain: bool = False) -> Tree:
    """A model tree with friction in most of its joints; ``plain``: no guides where they stand about a point of j's."""
    rng = np.random.default_rng([seed, 77])
    most *= float(rng.choice([0.1, 0.3, 1.0]))
    made["friction"] = {"circle": str(rng.choice(["sin", "tan"])), "coefficient": float(rng.uniform(0, most))}
    for name in sorted(made["joints"]):
        joint = made["joints"][name]
        if joint["type"] in rubbing.RUBS and rng.random() < 0.85:
            joint["friction"] = _friction(joint["type"], rng, most, style)
            if plain and joint["type"] in ("prismatic", "cylindrical"):
                joint["friction"].pop("guide", None)
    return made


def _friction(kind: str, rng: np.random.Generator, most: float, style: Style) -> Tree:
    def length(low: float, high: float) -> float:
        return float(style.kind(float(rng.uniform(low, high)), length=1))

    made: Tree = {"coefficient": float(rng.uniform(0, most))} if rng.random() < 0.8 else {}
    if kind in ("revolute", "spherical", "screw") or (kind == "cylindrical" and rng.random() < 0.7):
        made["radius"] = length(0.002, 0.04)
        if kind != "screw" and rng.random() < 0.5:
            made["circle"] = str(rng.choice(["sin", "tan"]))
    if kind in ("revolute", "prismatic", "cylindrical") and rng.random() < 0.6:
        made["guide"] = [length(0.02, 0.3), length(0.02, 0.3)]
    if kind == "revolute" and rng.random() < 0.5:
        made["thrust_radius"] = length(0.002, 0.04)
    if kind == "screw" and rng.random() < 0.6:
        made["thread_angle"] = f"{rng.uniform(0, 30)} deg"
    return made


@lru_cache(maxsize=64)
def drawing(seed: int) -> Drawing:
    """Determinate and without damping, so that all that the joints carry is a reaction or friction."""
    for k in range(9):
        with suppress(RuntimeError):
            d = random_drawing(seed + 1_000_000 * k, (2, 6), redundant=False)
            loads = {name: load for name, load in d.loads.items() if "damper" not in load.type}
            return replace(
                d, joints={name: replace(j, damping={}) for name, j in d.joints.items()}, loads=loads
            )
    raise RuntimeError(f"seed {seed}: no drawing")


def rough(seed: int, options: Options = Options(), most: float = MOST, plain: bool = False) -> Any:  # noqa: B008
    """The mechanism of a seed."""
    return da.mechanism(roughened(tree(drawing(seed), options), seed, most, options.style, plain))


def solved(r: da.Result) -> Array:
    """Positions with numbers."""
    return np.array([status in SOLVED for status in r.status])


def friction_laws(r: Any, d: Drawing, s: State) -> dict[str, Array]:
    """Friction of each joint (P, 6) on j as the laws have it, from its reaction and its slip.

    Of a ball of a rod that may spin only its part across the rod's line, the rest following the spin.
    """
    at, made = Places(d, s), roughened(tree(d), d.seed % 1_000_000)
    top, out = made["friction"], {}
    for name, j in d.joints.items():
        t = made["joints"][name]
        if "friction" not in t:
            out[name] = np.zeros((s.count, 6))
            continue
        mu, kind = (t["friction"].get(key, top[key]) for key in ("coefficient", "circle"))
        W = np.concatenate([r.reaction(name), r.reaction_moment(name)], -1)
        sliding = _sliding(at, j)
        if j.type == "spherical":
            out[name] = rubbing.ball(t["friction"], mu, kind, W, sliding.spin)
        else:
            out[name] = LAWS[j.type]({**t, **t["friction"]}, mu, kind, W, sliding)
    return out


LAWS = {
    "revolute": rubbing.journal,
    "prismatic": rubbing.guide,
    "cylindrical": rubbing.cylinder,
    "screw": rubbing.thread,
}


def _sliding(at: Places, j: Any) -> rubbing.Sliding:
    on_i, on_j = at.frames(j)
    f, p = on_i[:, 2 if j.type == "revolute" else 0], at.ends(j)[1]
    spin = at.spin(j.j) - at.spin(j.i)
    slide = np.sum((at.velocity(j.j, p) - at.velocity(j.i, p)) * f, -1)
    return rubbing.Sliding(p, f, on_i, on_j, slide, np.sum(spin * f, -1), spin)


def across_line(at: Places, rod: str, v: Array) -> Array:
    """The part of vectors across the line of a rod."""
    a, b = at.d.rods[rod]
    u = at.vector(rod, (b - a) / np.linalg.norm(b - a))
    return np.asarray(v - np.sum(v * u, -1, keepdims=True) * u)
