"""Random machines whose crank turns through: crank-rockers and slider-cranks with masses and loads of all kinds."""

from __future__ import annotations

from typing import Any

import numpy as np

import dalembert as da

TEXT = """
units: {{length: m, angle: rad}}
gravity: [{g[0]}, {g[1]}]
links:
  ground: {{points: {{O: [0, 0], C: [{frame}, 0.05]}}}}
  crank: {{points: {{O: [0, 0], A: [{crank}, 0]}}, mass: {m[0]}, center: [{c[0]}, {c[1]}], inertia: {j[0]}}}
  rod: {{points: {{A: [0, 0], B: [{rod}, 0]}}, mass: {m[1]}, center: [{c[2]}, {c[3]}], inertia: {j[1]}}}
  last: {{points: {{B: [{last}, 0], C: [0, 0]}}, mass: {m[2]}, center: [{c[4]}, {c[5]}], inertia: {j[2]}}}
joints:
  O: {{type: pin, links: [ground, crank], damping: {damping}}}
  A: {{type: pin, links: [crank, rod]}}
  B: {{type: pin, links: [rod, last]}}
  C: {output}
drives:
  O: {{position: {{from: {start}, to: {end}, count: {count}}}, speed: {speed} rad/s}}
loads:
  F: {{type: force, on: rod, at: B, value: [{f[0]}, {f[1]}*cos(O)]}}
  S: {{type: spring, between: [ground.C, rod.A], stiffness: {k}, free_length: 0.3}}
assembly: {{rod: {guess}}}
"""


def crank_machine(seed: int, count: int = 24, damped: bool = False) -> Any:
    """The description of a random machine driven at one speed through one turn."""
    rng = np.random.default_rng(seed)
    crank = rng.uniform(0.05, 0.12)
    rod, last, frame = rng.uniform(0.3, 0.45, 3)
    slides = seed % 2 == 1
    output = (
        "{type: slider, links: [ground, last], at: [O, B], direction: 0.1}"
        if slides
        else "{type: pin, links: [ground, last]}"
    )
    start = rng.uniform(0, 6)
    numbers: dict[str, Any] = {
        "g": rng.uniform(-10, 10, 2),
        "m": rng.uniform(0.2, 2, 3),
        "c": rng.uniform(-0.1, 0.2, 6),
        "j": rng.uniform(0, 0.01, 3),
        "f": rng.uniform(-50, 50, 2),
    }
    return da.loads(
        TEXT.format(
            **numbers, crank=crank, rod=rod, last=0.0 if slides else last, frame=max(frame, 0.2), output=output,
            start=start, end=start + 2 * np.pi, count=count, speed=rng.choice([-1, 1]) * rng.uniform(5, 30),
            k=rng.uniform(0, 300), damping=0.02 if damped else 0.0, guess=0.0 if slides else 0.6,
        )
    )  # fmt: skip
