"""One body joined to the ground in any axes, at a random value of the joint's freedoms."""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.algebra import space
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.arrays import Array
from dalembert.core.layout import Pose
from dalembert.model import Mechanism
from dalembert.model.description import mechanism


def frame(rng: np.random.Generator) -> dict[str, list[float]]:
    """Random x and z at a right angle."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return {"x": q[:, 0].tolist(), "z": q[:, 1].tolist()}


def joint(kind: str, rng: np.random.Generator, **keys: Any) -> dict[str, Any]:
    """A joint of a kind between ground and body with random axes on both."""
    axes = {"i": frame(rng), "j": frame(rng)}
    if kind == "screw":
        keys = {"lead": float(rng.uniform(0.1, 1.0)), **keys}
    return {"type": kind, "links": ["ground", "body"], "at": ["P", "P"], "axes": axes, **keys}


def body_on(kind: str, rng: np.random.Generator, **keys: Any) -> Mechanism:
    """Ground and one body, joined by a joint of a kind at random points in random axes."""
    points = {link: {"points": {"P": rng.normal(size=3).tolist()}} for link in ("ground", "body")}
    return mechanism({"space": "space", "links": points, "joints": {"P": joint(kind, rng, **keys)}})


def placed(m: Mechanism, rng: np.random.Generator) -> tuple[Compiled, Pose]:
    """The compiled mechanism and a pose (1, L+1, ...) that its joint allows."""
    c = compile_mechanism(m, m.schedule())
    guess: Any = c.guess
    values = rng.uniform(-1, 1, size=(1, sum(len(h.drives) for h in guess.hinges)))
    pose = guess._starting_poses(c.layout, np.zeros(c.layout.constraints.count), values, driven=True)
    return c, pose


def allowed(c: Compiled, pose: Pose, kind: str) -> Array:
    """Twists (F, 6) of the body about its reference point that the joint's slides and turns make, by their axes."""
    g = c.layout.algebra
    h = c.guess.hinges[0]  # type: ignore[union-attr]
    on_i = g.matrix(g.compose(pose.rotation[0, h.i], h.frame_i)).T
    on_j = g.matrix(g.compose(pose.rotation[0, h.j], h.frame_j)).T
    out = []
    for axis in h.slides:
        out.append(np.concatenate([on_i[axis], np.zeros(3)]))
    arm = -g.rotate(pose.rotation[0, h.j], h.uj)  # from the joint's point to the reference point
    turns = h.turns
    axes = [on_i[t] for t in turns] if len(turns) != 2 else [on_i[turns[0]], on_j[turns[1]]]
    for w in axes:
        out.append(np.concatenate([np.cross(w, arm), w]))
    if kind == "screw":
        lead = c.mechanism.joints["P"].lead / (2 * np.pi)
        out[-1] = out[-1] + np.concatenate([lead * on_i[0], np.zeros(3)])
    return np.array(out).reshape(-1, 6)


def moved(pose: Pose, twist: Array, step: float) -> Pose:
    """The body moved by a small displacement of its reference point."""
    point, rotation = pose.point.copy(), pose.rotation.copy()
    point[:, 0] += step * twist[:3]
    rotation[:, 0] = space.compose(space.exp(step * twist[3:]), rotation[:, 0])
    return Pose(point, pose.turn, rotation)
