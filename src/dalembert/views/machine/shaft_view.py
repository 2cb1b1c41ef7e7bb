"""A shaft to scale with its bearings and masses, and below it its shape at each critical speed."""

from __future__ import annotations

import math

import numpy as np

from dalembert.machine.shafts.critical_speeds import CriticalSpeeds
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Circle, Line, Polygon, Scene, Text

LONG = 150.0
"""Length of a drawn shaft, mm."""
APART, HIGH = 26.0, 9.0
"""Distance of the shapes from each other, and their largest ordinate, mm."""


def shaft_scene(c: CriticalSpeeds, notation: Notation) -> Scene:
    """The shaft with its scale; mode shapes are not to scale."""
    shown, canvas = Shown(c.result, notation), Canvas()
    per_mm = round_up(c.beam.length / shown.size("length") / LONG) * shown.size("length")
    end = c.beam.length / per_mm
    half = _half_thickness(c) / per_mm
    canvas.add(Polygon(((0.0, -half), (end, -half), (end, half), (0.0, half)), "block"))
    canvas.add(Line(((-5.0, 0.0), (end + 5.0, 0.0)), "construction"))
    below = -half - 8.0
    for name, s in c.supports.items():
        x = s / per_mm
        canvas.add(Polygon(((x, -half), (x - 3.0, -half - 5.0), (x + 3.0, -half - 5.0)), "support"))
        canvas.add(Text((x, below - 2.0), name, 3.0))
    tall = half + 9.0
    for name, p in c.masses.items():
        x = p.place / per_mm
        canvas.add(Line(((x, half), (x, tall - 3.0)), "link"), Circle((x, tall), 3.0, "pin"))
        text = f"{name}, {shown.text('mass', p.mass)}"
        canvas.add(Text((x, tall + 6.0), text, 3.0))
    level = below - 4.0
    for k, (speed, shape) in enumerate(zip(c.speeds, c.shapes, strict=True)):
        y = level - APART * k - HIGH
        xs = c.places / per_mm
        canvas.add(Line(((0.0, y), (end, y)), "construction"))
        canvas.add(
            Line(tuple((float(a), y + HIGH * float(b)) for a, b in zip(xs, shape, strict=True)), "curve-1")
        )
        rpm = speed * 30 / math.pi
        canvas.add(Text((end + 6.0, y), f"{k + 1}: {rpm:.5g} rpm", 3.0, "text", "start"))
    title = f"Shaft {c.link} and its shapes at the critical speeds"
    note = f"1 mm = {shown.plain('length', per_mm)} along the shaft; the size of a shape is arbitrary."
    return canvas.scene(title, notes=[note], scales={"length": per_mm})


def _half_thickness(c: CriticalSpeeds) -> float:
    """Half of the section's height, m."""
    section = c.result.mechanism.links[c.link].section
    assert section is not None
    return float(np.max(section.reach))
