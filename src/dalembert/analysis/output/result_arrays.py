"""A result as labelled arrays over position, drive, joint, link and component."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.columns import (
    BY_FRICTION,
    CHECKS,
    ELEMENTS,
    GIVEN,
    MOTION,
    Entry,
    bounds,
    entries,
)
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.quantity_catalogue import CATALOGUE
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.answer.column import Scale
from dalembert.arrays import Tree

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def result_arrays(result: Result, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
    """Arrays and coordinates, each with its unit."""
    every = [
        *entries(result, (*GIVEN, *BY_FRICTION), axes, every=True),
        *entries(result, (*ELEMENTS, *MOTION, *CHECKS)),
        *bounds(result, axes, every=True),
    ]
    data: Tree = {"status": ("position", np.array(result.status, dtype=str))}
    data |= _arrays(every, to) | _reaction_links(result)
    coordinates: Tree = {
        "position": np.arange(1, len(result.status) + 1),
        "component": list("xyz"[: result.mechanism.dimension]),
        "link_axis": [] if result.mechanism.dimension == 2 else list("xyz"),
    }
    for e in every:
        if e.thing and e.thing not in (names := coordinates.setdefault(_dimension(e.word), [])):
            names.append(e.thing)
    present: Tree = {name: names for name, names in coordinates.items() if len(names)}
    for drive in result.drives:  # so that a position is found by the value of a drive
        kind = drive_kinds(result, drive)["position"]
        values = to(kind, result.drive_position(drive))
        present[f"drive_{drive}"] = ("position", values, {"units": to.text(kind)})
    return data, present


DIMENSIONS = {
    "drives": "drive_name",
    "pressed": "cylinder",
    "cylinders": "cylinder",
    "screws": "screw",
    "loads": "load_name",
    "joints": "joint",
    "links": "link",
    "points": "link_point",
    "slide": "sliding_joint",
    "turn": "turning_joint",  # a dimension is not called as a variable over it
}
"""Subjects of a quantity -> the dimension along which they are."""


def _dimension(word: str) -> str:
    of = CATALOGUE[word].of
    return DIMENSIONS.get(of, f"{of}_joint")


def _arrays(some: Iterable[Entry], to: Scale) -> Tree:
    """Quantities of all things of a sort side by side; drives that turn and that slide differ in their units."""
    groups: dict[tuple[str, str], list[Entry]] = {}
    for e in some:
        groups.setdefault((e.word, e.rate), []).append(e)
    out: Tree = {}
    for (word, rate), each in groups.items():
        units = [to.text(e.kind) for e in each]
        unit = (
            units[0]
            if len(set(units)) == 1
            else f"of each {_dimension(word).removesuffix('_name')}: " + ", ".join(units)
        )
        values = [to(e.kind, e.values) for e in each]
        things = [_dimension(word)] if each[0].thing else []
        array = np.stack(values, axis=1) if things else values[0]
        over = ("position", *things, "component", "link_axis")[: array.ndim]
        out["_".join(filter(None, (word, rate)))] = (over, array, {"units": unit or "1"})
    return out


def _reaction_links(result: Result) -> Tree:
    """The link that each joint's reaction is on, and the one it is by."""
    links = [result.mechanism.joints[joint].links for joint in result.joints]
    if not links:
        return {}
    return {"reaction_on": ("joint", [j for _, j in links]), "reaction_by": ("joint", [i for i, _ in links])}
