"""Printed form of an answer in space: forces and moments by components, orientation of links."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.algebra.space import angle_and_axis
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.arrays import Array
from dalembert.printing import Part, TextTable, number, round_components, wrap

if TYPE_CHECKING:
    from dalembert.analysis.output.columns import JointReaction
    from dalembert.analysis.result.reaction_axes import Axes
    from dalembert.analysis.result.result import Result


NOT_UNIQUE = "Not unique; with the least sum of squares:"
AXES: dict[Axes, str] = {
    "ground": "ground axes",
    "link": "the axes of link j",
    "joint": "the joint's axes",
}


def space_reaction_tables(reactions: Sequence[JointReaction], to: Printed, axes: Axes) -> Iterator[Part]:
    """Forces, then moments, of reactions at one position (3,); what is not unique also with the least norm."""
    note = f"F_ij and M_ij are by link i on link j, in {AXES[axes]}; moments about the joint's point on j."
    yield from _tables(reactions, to, wrap(note))
    least = [
        r._replace(force=r.least_norm[0, :3], moment=r.least_norm[0, 3:])
        for r in reactions
        if r.least_norm is not None and np.isfinite(r.least_norm[0]).any()
    ]
    if least:
        yield NOT_UNIQUE
        yield from _tables(least, to)


def _tables(reactions: Sequence[JointReaction], to: Printed, note: str = "") -> Iterator[TextTable]:
    for letter, kind in (("F", "force"), ("M", "moment")):
        heads = [
            f"{head}\n{to.text(kind)}"
            for head in (*(f"{letter}_ij {axis}" for axis in "xyz"), f"|{letter}_ij|")
        ]
        rows = [[r.joint, r.by, r.on, *_components_and_size(to(kind, getattr(r, kind)))] for r in reactions]
        yield TextTable(["joint", "by i", "on j", *heads], rows, 3, note if kind == "moment" else "")


def _components_and_size(vector: Array) -> list[str]:
    """Components and size."""
    components = round_components(vector)
    return [number(v) for v in (*components, math.hypot(*components))]


def space_link_tables(result: Result, to: Printed) -> Iterator[TextTable]:
    """Orientation of every link, position of its mass centre, and their rates, at the first position."""
    turned = [f"turned\n{to.text('angle')}", "about x", "y", "z", *_heads("center", to.text("length"))]
    rates = (("ang. speed", "angular_speed"), ("ang. acc.", "angular_acceleration"))
    turning = [head for name, kind in rates for head in _heads(name, to.text(kind))]
    rows: list[list[list[str]]] = [[], [], []]
    read = (result.center, result.speed, result.acceleration, result.center_acceleration)
    kinds = ("length", "angular_speed", "angular_acceleration", "acceleration")
    vectors = [[to(kind, of(link)[0]) for link in result.links] for kind, of in zip(kinds, read, strict=True)]
    largest = [float(np.nan_to_num(np.abs(of)).max(initial=0.0)) for of in vectors]
    fast = (
        max((float(np.nan_to_num(np.abs(result.speed(n)[0])).max()) for n in result.links), default=0.0) ** 2
    )
    largest[0] = max(largest[0], float(to("length", result.compiled.layout.length)))
    largest[2] = max(largest[2], fast)
    largest[3] = max(largest[3], float(to("acceleration", fast * result.compiled.layout.length)))
    for n, link in enumerate(result.links):
        angle, axis = angle_and_axis(result.rotation(link)[0])
        place, speed, rate, moved = (
            round_components(of[n], size) for of, size in zip(vectors, largest, strict=True)
        )
        parts = ([float(to("angle", angle)), *round_components(axis), *place], [*speed, *rate], moved)
        for row, part in zip(rows, parts, strict=True):
            row.append([link, *(number(v, 5) for v in part)])
    heads = (turned, turning, _heads("acc. of center", to.text("acceleration")))
    note = wrap("Links are turned from ground's axes about the axis shown; vectors are in ground axes.")
    for head, cells, under in zip(heads, rows, ("", "", note), strict=True):
        yield TextTable(["link", *head], cells, 1, under)


def _heads(name: str, unit: str) -> list[str]:
    return [f"{name} {axis}\n{unit}" for axis in "xyz"]
