"""Shaking force and moment: what a machine exerts on its foundation, by momentum and by its reactions.

F_s = W + F_ext - dp/dt and M_s = M_W + M_ext - dH/dt need no reaction, so that they are unique where reactions are not;
the sum of all that joints, drives, springs and dampers do to the ground is the same, and the difference is the check.

Mechanics: docs/theory.md 10.1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.algebra.plane import across
from dalembert.analysis.methods.applied_forces import (
    Action,
    effort_actions,
    joint_actions,
    known_actions,
    magnitude,
    unknown_load_actions,
)
from dalembert.analysis.output.rounding import PART, sizes
from dalembert.analysis.result.transmission_lines import ground_points
from dalembert.answer.column import Axes, Column, Scale, parts
from dalembert.arrays import Array, Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.machine.harmonics import Harmonics, harmonics
from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.machine.whole_cycle import turning_angle
from dalembert.model import GROUND
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene

CAUSES = {"inertia": "inertia", "weight": "weight", "load": "external", "effort": "external"}
"""Kind of an action that reaches the ground through the machine -> the part of the shaking force it is."""

About = str | Sequence[float] | Array | None
"""A fixed point: a joint with the ground, a point of the ground, or a vector in ground axes (m)."""

Wrench = tuple[Array, Array]


@dataclass(frozen=True, eq=False)
class Shaking(MachineAnswer):
    """Force (P, d) and moment (P,), in space (P, 3), of some links on everything else, about a fixed point (d,).

    ``parts``: the same by cause: `inertia`, `weight`, `external`. ``residual`` (P,): difference to what the joints,
    drives, springs and dampers carry, over ``largest``, the largest single force of the cycle; NaN where unknown.
    ``outside_sizes``: by load or drive that is external, its greatest force, with its couple over the length, N.
    ``couple`` (P, 2), in the plane where links have a `place` z along the normal: sum of z k x F over the links.
    """

    result: Result = field(repr=False)
    links: tuple[str, ...]
    about: str
    point: Array
    force: Array = field(repr=False)
    moment: Array = field(repr=False)
    parts: dict[str, Wrench] = field(repr=False)
    residual: Array = field(repr=False)
    largest: float = field(repr=False)
    couple: Array | None = field(default=None, repr=False)
    outside_sizes: dict[str, float] = field(default_factory=dict, repr=False)

    def floor(self, kind: str) -> float:
        """Rounding level beside the largest force of the machine in the cycle: for a `force`, else a moment."""
        largest = max(self.largest, float(sizes(self.result)["force"].max(initial=0.0)))
        return PART * largest * (1.0 if kind == "force" else self.result.compiled.layout.length)

    @property
    def whole(self) -> bool:
        """True if all links are counted: then it is the force on the ground."""
        return len(self.links) == len(self.result.links)

    @property
    def outside(self) -> tuple[str, ...]:
        """Loads, and drives `by: outside`, whose force or moment on the ground is not 0: the part `external`."""
        return tuple(name for name, size in self.outside_sizes.items() if size > self.floor("force"))

    def harmonics(self, orders: int | Sequence[float] = 4, of: str = "force") -> Harmonics:
        """Harmonics of the `force`, the `moment` or the `couple` over full turns of the first drive.

        Raises ModelError for a couple where no link has a place.
        """
        values = {"force": self.force, "moment": self.moment, "couple": self.couple}.get(of)
        if values is None:
            raise ModelError(
                f"unknown shaking quantity {of!r}",
                "use force, moment, or couple, for which links need a place: 90 mm along the normal",
            )
        return harmonics(values, turning_angle(self.result), orders)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Every number: the first drives' positions, force and moment, and their parts."""
        yield from self.drive_columns()
        totals = {"shaking": (self.force, self.moment)}
        for name, wrench in (totals | self.parts).items():
            for kind, numbers in zip(("force", "moment"), wrench, strict=True):
                yield from (Column(f"{name}_{kind}{axis}", kind, v) for axis, v in parts(numbers))
        if self.couple is not None:
            yield from (Column(f"shaking_couple{axis}", "moment", v) for axis, v in parts(self.couple))
        yield Column("residual", "number", self.residual)

    def record(self, to: Scale) -> Tree:
        """Its other numbers by name, in the units of a scale."""
        stated = {"links": self.links, "about": self.about, "whole": self.whole, "outside": self.outside}
        return {"shaking": {**stated, "point": to("length", self.point)}}

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.shaking_text import shaking_parts

        return shaking_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.shaking_views import shaking_scenes

        return shaking_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.shaking_section import shaking_section

        shaking_section(sheet, self, shown)


def shaking(r: Result, about: About = None, links: Iterable[str] | None = None) -> Shaking:
    """Shaking force and moment of a machine, or of some links of it, at every position.

    F_s = W + F_ext - sum m a_G, M_s(P) = sum of the moments of these about P, less sum (I alpha + w x I w), with P the
    point ``about``: by default the first joint with the ground. N and N m, ground axes. A load is external; one whose
    opposite acts on the ground has `by: ground` and does not count, neither does a drive's effort, but one `by:
    outside`. Norton, Design of Machinery, section 11.8.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> s = da.shaking(da.dynamics(da.load(cases()["4b-02-norton-11-3-shaking-force"])), about="O2")
    >>> s.force.round(2), float(s.moment[0].round(4)), bool(s.residual.max() < 1e-12)
    (array([[613.33, 134.04]]), -194.2917, True)
    """
    chosen, (name, point) = _chosen(r, links), fixed_point(r, about)
    loads, carried = _actions(r, chosen)
    causes = {p: _sum(r, [a for a in loads if CAUSES[a.kind] == p], point) for p in CAUSES.values()}
    force, moment = (np.sum([w[k] for w in causes.values()], axis=0) for k in (0, 1))
    through = _sum(r, carried, point)
    length = r.compiled.layout.length
    each = [magnitude(a.force) for a in loads] + [_size(a.couple) / length for a in loads]
    largest = max((float(np.nanmax(s, initial=0.0)) for s in each), default=0.0)
    off = [_size(a + b) for a, b in zip((force, moment), through, strict=True)]
    gap = np.maximum(off[0], off[1] / length) / (largest or 1.0)
    outside = [a for a in loads if CAUSES[a.kind] == "external"]
    named = {
        a.of: float(np.nanmax(magnitude(a.force) + _size(a.couple) / length, initial=0.0)) for a in outside
    }
    return Shaking(r, chosen, name, point, force, moment, causes, gap, largest, _couple(r, loads), named)


def _couple(r: Result, loads: Sequence[Action]) -> Array | None:
    """Couple (P, 2) about axes in the plane of what acts on links that lie beside it."""
    places = {link: r.mechanism.links[link].place for link in r.links}
    placed = any(places.values())
    none = np.zeros((len(r.status), 2))  # of no loads too
    return np.asarray(sum((places[a.link] * across(a.force) for a in loads), none)) if placed else None


def _chosen(r: Result, links: Iterable[str] | None) -> tuple[str, ...]:
    names = r.links if links is None else tuple([links] if isinstance(links, str) else links)
    for link in names:
        if link not in r.links:
            raise ModelError(f"unknown moving link {link!r}", closest(link, list(r.links)))
    return tuple(link for link in r.links if link in names)


def fixed_point(r: Result, about: About) -> tuple[str, Array]:
    """Name and place (d,) of a fixed point."""
    d, points = r.mechanism.dimension, ground_points(r.mechanism)
    if about is None:
        about = next((n for n in points if n in r.joints), (0.0,) * d)
    if isinstance(about, str):
        if about not in points:
            raise ModelError(
                f"{about!r} is neither a joint with the ground nor a point of the ground",
                closest(about, list(points)),
            )
        return about, np.array(points[about], float)
    for value in about:
        require("place", value, "about")
    place = np.array(about, float)
    if place.shape != (d,) or not np.isfinite(place).all():
        raise ModelError(f"{about} is not a point", f"give {d} numbers, in metres")
    return f"({', '.join(f'{x:g}' for x in place)}) m", place


def _actions(r: Result, links: tuple[str, ...]) -> tuple[list[Action], list[Action]]:
    """Actions on the links from outside and by their inertia; and those of the joints with other links."""
    named: Tree = {"load": r.mechanism.loads, "effort": r.mechanism.drives}
    loads: list[Action] = []
    carried = list(joint_actions(r, split=False))
    for a in (*known_actions(r), *unknown_load_actions(r), *effort_actions(r)):
        by = getattr(named.get(a.kind, {}).get(a.of), "by", None)
        outside = by == "outside" if a.kind == "effort" else a.kind in CAUSES and by != GROUND
        (loads if outside else carried).append(a)
    return [a for a in loads if a.link in links], [a for a in carried if a.link in links]


def _sum(r: Result, some: Sequence[Action], point: Array) -> Wrench:
    """Sum of forces, and of their moments about a fixed point."""
    count, d = len(r.status), r.mechanism.dimension
    force = sum((a.force for a in some), np.zeros((count, d)))
    moment = sum((a.moment(point) for a in some), np.zeros((count, 3) if d == 3 else count))
    return np.asarray(force), np.asarray(moment)


def _size(values: Array) -> Array:
    return np.abs(values) if values.ndim == 1 else magnitude(values)


def shaking_force(r: Result) -> Array:
    """Force of the complete machine on the ground (P, d), N."""
    return shaking(r).force
