"""A cam as columns, as numbers by name, and in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.column import Column, Scale
from dalembert.arrays import Tree
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.machine.elements.cam_design import CamDesign

MEASURES = {
    "pressure_angle_peak": "angle",
    "pressure_angle_peak_at": "angle",
    "pressure_angle_return": "angle",
    "least_convex_radius": "length",
    "least_convex_radius_at": "angle",
    "largest_roller": "length",
    "least_base": "length",
    "face_half_width": "length",
}
"""Measures by name, with their kinds."""
FOLLOWERS = {"knife": "a knife edge", "flat": "a flat face", "roller": "a roller"}


def kind_of_lift(c: CamDesign) -> str:
    """angle of a follower that swings, else length."""
    return "angle" if c.motion.carrier.swings else "length"


def columns(c: CamDesign) -> Iterator[Column]:
    """Turn, lift and its derivatives, pressure angle, curvature radius, outline."""
    yield Column("turn", "angle", c.turn)
    for name, values in zip(("lift", "slope", "bend", "jerk"), c.lift(c.turn), strict=True):
        yield Column(name, kind_of_lift(c), values)
    yield Column("pressure_angle", "angle", c.pressure_angle(c.turn))
    yield Column("radius", "length", c.pitch_radius(c.turn))
    x, y = c.profile(c.turn).T
    yield Column("profile.x", "length", x)
    yield Column("profile.y", "length", y)


def record(c: CamDesign, to: Scale) -> Tree:
    """Measures over a turn."""
    return {"cam": {"joint": c.joint, **{k: float(to(kind, getattr(c, k))) for k, kind in MEASURES.items()}}}


def contents(c: CamDesign, to: Scale) -> Iterable[Part]:
    """Sentences about its form, and its measures."""
    where = "swings on" if c.motion.carrier.swings else "slides on"
    yield f"Cam {c.joint}: {FOLLOWERS[c.motion.joint.follower.kind]} {where} {c.motion.carrier.link}."
    yield TextTable(["", "value", "unit", "at", "unit"], list(_rows(c, to)))
    jumps = [number(float(to("angle", x))) for x in c.jumps]
    if jumps:
        yield f"The acceleration jumps at {', '.join(jumps)} {to.text('angle')}."


def _rows(c: CamDesign, to: Scale) -> Iterator[list[str]]:
    def row(name: str, kind: str, value: float, at: float = np.nan) -> list[str]:
        place = ["", ""] if np.isnan(at) else [number(float(to("angle", at))), to.text("angle")]
        return [name, number(float(to(kind, value))), to.text(kind), *place]

    yield row("lift", kind_of_lift(c), *c.highest)
    yield row("pressure angle, rising", "angle", c.pressure_angle_peak, c.pressure_angle_peak_at)
    yield row("pressure angle, returning", "angle", c.pressure_angle_return)
    yield row("least convex radius", "length", c.least_convex_radius, c.least_convex_radius_at)
    if not np.isnan(c.least_base):
        yield row("least base radius", "length", c.least_base, c.least_base_at)
    if c.motion.joint.flat:
        yield row("half width of the face", "length", c.face_half_width)
    radius = c.profile_radius(c.turn)
    if (radius < 0).any():
        yield row("largest cutter radius in hollows", "length", float((-radius[radius < 0]).min()))
