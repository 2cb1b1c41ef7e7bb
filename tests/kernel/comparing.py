"""Numbers of a description that may vary, and a kernel's answers beside those of the general executor."""

from __future__ import annotations

from typing import Any

import numpy as np

import dalembert as da
from dalembert.analysis.batch.tracing.symbolic_model import geometric, with_numbers

NAMES = {
    "links": ("mass", "inertia", "center"),
    "joints": ("direction", "angle", "radius", "radii", "pressure_angle", "damping", "axis", "lead"),
    "loads": ("stiffness", "free_length", "free_angle", "damping", "force", "direction", "value", "at"),
    "drives": ("speed", "acceleration", "effort"),
}

FRICTION = ("coefficient", "static", "radius", "guide", "half_height", "arm", "thrust_radius", "thread_angle")


def every_number(m: Any) -> list[str]:
    """Paths of all numbers that may vary."""
    out = []
    for group, keys in NAMES.items():
        for name, part in getattr(m, group).items():
            lawful = getattr(part, "law", None) is not None
            out += [f"{group}.{name}.{k}" for k in keys if _varies(getattr(part, k, None)) and not lawful]
            points = getattr(part, "points", {})
            out += [f"{group}.{name}.points.{p}" for p, at in points.items() if _varies(at)]
            out += [f"{group}.{name}.{path}" for path in _in_space(part)]
    return out + frictional(m) + (["gravity"] if isinstance(m.gravity, tuple) else [])


def _in_space(part: Any) -> list[str]:
    """Axes of a joint's two links, its damping by freedom, and a matrix of inertia."""
    axes, damping = getattr(part, "axes", None), getattr(part, "damping", None)
    inertia = getattr(part, "inertia", None)
    out = ["inertia"] if isinstance(inertia, tuple) and isinstance(inertia[0], tuple) else []
    out += [f"damping.{freedom}" for freedom in damping] if isinstance(damping, dict) else []
    ends = ("i", "j") if hasattr(axes, "i") else ()
    return out + [f"axes.{e}.{key}" for e in ends for key in "xz" if _varies(getattr(getattr(axes, e), key))]


def frictional(m: Any) -> list[str]:
    """Paths of the numbers of friction."""
    out = ["friction.coefficient"] if m.friction.enabled and _varies(m.friction.coefficient) else []
    for name, joint in m.joints.items():
        f = getattr(joint, "friction", None)
        keys = [key for key in FRICTION if _varies(getattr(f, key, None))] if m.friction.enabled else []
        out += [f"joints.{name}.friction.{key}" for key in keys]
    return out


def _varies(value: Any) -> bool:
    if isinstance(value, tuple):
        return bool(value) and all(isinstance(x, float) for x in value)
    return isinstance(value, float)


def changed(k: Any, seed: int, shape: float, rest: float = 0.3) -> np.ndarray:
    """The description's numbers changed at random: geometry by ``shape``, the rest by ``rest`` (relative)."""
    rng = np.random.default_rng(seed)
    size = np.array([shape if geometric(k.mechanism, n) else rest for n in k.numbers])
    return k.nominal * (1 + size * rng.uniform(-1, 1, len(k.numbers)))


def general(m: Any, k: Any, values: np.ndarray) -> Any:
    """The general executor's answer for one design."""
    design = with_numbers(m, k.trace.numbers, values.tolist())
    run = da.dynamics if k.trace.inertia else da.statics
    return run(design, method="careful")


def difference(k: Any, r: Any, d: int, g: Any) -> float:
    """Largest difference of compiled efforts and reactions of design ``d``, over the largest force, moments over
    lengths; infinite where one has a number and the other none."""
    force = np.nanmax(np.abs(g.force_array), initial=1e-300)
    scale, length = force, g.compiled.layout.length
    pairs = [(r.reaction(j)[d], g.reaction(j), scale) for j in g.joints if f"reaction.{j}" in k.outputs]
    angular = g.compiled.layout.freedoms.angular[g.compiled.layout.driven]
    pairs += [
        (r.effort(n)[d], g.effort(n), scale * (length if a else 1))
        for n, a in zip(g.drives, angular, strict=True)
        if f"effort.{n}" in k.outputs
    ]
    worst = 0.0
    for mine, other, size in pairs:
        if (np.isnan(mine) != np.isnan(other)).any():
            return float("inf")
        size = max(size, np.nanmax(np.abs(other), initial=0.0))
        worst = max(worst, float(np.nanmax(np.abs(mine - other), initial=0.0)) / size)
    return worst
