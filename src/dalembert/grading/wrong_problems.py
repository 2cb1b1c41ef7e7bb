"""The same problem solved with one thing wrong: parts of the superposition changed, or a datum."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import actions, magnitude
from dalembert.arrays import Array, Tree
from dalembert.errors import DalembertError, ModelError
from dalembert.units import file_units

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class Variants:
    """Results with one mistake each, made once."""

    def __init__(self, result: Result) -> None:
        self.result = result
        self._linear: list[tuple[str, Result]] | None = None
        self._solved: dict[int, Result | None] = {}

    def linear(self) -> list[tuple[str, Result]]:
        """Parts of the superposition left out, reversed or scaled."""
        if self._linear is None:
            try:
                self._linear = list(_with_factor(self.result))
            except ModelError:
                self._linear = []
        return self._linear

    def solutions(self) -> Iterator[tuple[str, Callable[[], Result | None]]]:
        """Solved again with one datum changed, each when it is looked at."""
        for n, (sentence, change) in enumerate(_changes(self.result)):
            yield sentence, partial(self._solution, n, change)

    def _solution(self, n: int, change: Tree) -> Result | None:
        if n not in self._solved:
            self._solved[n] = _again(self.result, change)
        return self._solved[n]


def _with_factor(r: Result) -> Iterator[tuple[str, Result]]:
    from dalembert.analysis.methods.superposition import superposition

    parts = superposition(r)

    def with_weights(factor: dict[str, float]) -> Result:
        w = np.array([factor.get(s, 1.0) for s in parts.sources])

        def total(a: Array) -> Array:
            return np.asarray(np.tensordot(w, a, axes=1))

        return replace(
            r,
            force_array=total(parts.force),
            moment_array=total(parts.moment),
            effort_array=total(parts.efforts),
            load_array=total(parts.loads),
        )

    forces = [s for s in parts.sources if s.startswith("inertia force")]
    couples = [s for s in parts.sources if s.startswith("inertia couple")]
    weights = [s for s in parts.sources if s.startswith("weight of")]
    for sentence, some, factor in _weightings(r, forces, couples, weights, parts.sources):
        if some:
            yield sentence, with_weights(dict.fromkeys(some, factor))


def _weightings(
    r: Result, forces: list[str], couples: list[str], weights: list[str], sources: Iterable[str]
) -> Iterator[tuple[str, list[str], float]]:
    both = [*forces, *couples]
    if both:
        yield "inertia is left out: this is the static answer", both, 0.0
        yield "the inertia couples are left out", couples, 0.0
        yield "the inertia forces are left out", forces, 0.0
        yield "inertia forces and couples act along the accelerations, not against them", both, -1.0
        yield "the inertia couples have the sense of the accelerations, not against them", couples, -1.0
        yield "the inertia forces have the sense of the accelerations, not against them", forces, -1.0
        for g, unit in _gravities(r):
            yield f"weight is taken for mass: inertia forces are too large by g = {g:.5g} {unit}", forces, g
            yield f"weight is taken for mass: inertia is too large by g = {g:.5g} {unit}", both, g
        yield "g is in ft/s2 where lengths are inches: the masses are too large by 12", forces, 12.0
        yield "g is in in/s2 where lengths are feet: the masses are too small by 12", forces, 1 / 12
        yield "the moments of inertia are in the wrong unit of length: a factor of 12", couples, 12.0
        yield "the moments of inertia are in the wrong unit of length: a factor of 12", couples, 1 / 12
        yield "the moments of inertia are in the wrong unit of length: a factor of 144", couples, 1 / 144
    yield "gravity is left out", weights, 0.0
    yield "the weights act upwards", weights, -1.0
    for source in sources:
        words = f"the {source}" if " of " in source else f"load {source}"
        yield f"{words} is left out", [source], 0.0
        yield f"{words} has the wrong sense", [source], -1.0


def _gravities(r: Result) -> list[tuple[float, str]]:
    """g as a number in the file's units, and 9.81."""
    units = file_units(r.mechanism.units)
    own = units.unit("acceleration").of_si(r.mechanism.g)
    out = [(own, units.text("acceleration"))]
    return out if abs(own - 9.80665) < 0.1 else [*out, (9.80665, "m/s2")]


def _changes(r: Result) -> Iterator[tuple[str, Tree]]:
    """Data changed one at a time: a sentence and what to put in their place."""
    m = r.mechanism
    for mode in _other_modes(r) if m.dimension == 2 else ():
        yield "this is the other assembly mode", {"assembly": mode}
    if not any(m.gravity_vector):
        yield "gravity is counted, and the problem has none", {"gravity": "standard"}
    for name, load in m.loads_on("point").items():
        if not load.unknown:
            yield from _force_changes(r, name)
    for drive in r.drives:
        speed, acceleration = r.drive_speed(drive)[0], r.drive_acceleration(drive)[0]
        path = f"drives.{drive}"
        if acceleration:
            yield f"the acceleration of drive {drive} is left out", {f"{path}.acceleration": 0.0}
            yield (
                f"the acceleration of drive {drive} has the wrong sense",
                {f"{path}.acceleration": -acceleration},
            )
        if speed:
            for factor, words in (
                (30 / math.pi, "rad/s taken for rpm"),
                (math.pi / 30, "rpm taken for rad/s"),
            ):
                yield f"the speed of drive {drive}: {words}", {f"{path}.speed": float(speed * factor)}
            yield f"the speed of drive {drive} is left out", {f"{path}.speed": 0.0}
    for link in r.links:
        yield from _link_changes(r, link)


def _force_changes(r: Result, name: str) -> Iterator[tuple[str, Tree]]:
    """A force at another point of its link, or in another direction."""
    m, load = r.mechanism, r.mechanism.loads[name]
    on = load.on  # type: ignore[union-attr]
    for point in [*m.points(on), "center"]:
        if point != load.at:  # type: ignore[union-attr]
            yield f"the moment arm of {name} is wrong: it is taken at {point}", {f"loads.{name}.at": point}
    other = "link" if load.axes == "ground" else "ground"  # type: ignore[union-attr]
    yield f"the direction of {name} is counted in {other} axes", {f"loads.{name}.axes": other}
    if m.dimension == 2:
        yield from _other_angle(r, name)


def _other_angle(r: Result, name: str) -> Iterator[tuple[str, Tree]]:
    """A force whose angle is counted from another axis or clockwise."""
    load: Any = r.mechanism.loads[name]
    a = next(a for a in actions(r) if a.of == name)
    slips = ("from the other axis", "clockwise", "from the negative x axis")
    if load.direction is not None:
        t = float(load.direction)
        for slip, angle in zip(slips, (math.pi / 2 - t, -t, math.pi - t), strict=True):
            yield f"the angle of {name} is counted {slip}", {f"loads.{name}.direction": angle}
    elif load.axes == "ground" and len(r.status) == 1:
        x, y = (float(c) for c in a.force[0])
        for slip, value in zip(slips, ([y, x], [x, -y], [-x, y]), strict=True):
            yield f"the angle of {name} is counted {slip}", {f"loads.{name}.value": value}


def _link_changes(r: Result, link: str) -> Iterator[tuple[str, Tree]]:
    """The mass centre or the moment of inertia of a link at the wrong point."""
    m = r.mechanism
    if not m.mass(link):
        return
    center = np.array(m.center(link))
    points = {n: np.array(p) for n, p in m.points(link).items()}
    for name, p in points.items() if m.dimension == 2 else ():
        shifted = m.inertia(link) + m.mass(link) * float(magnitude(p - center)) ** 2
        yield (
            f"the moment of inertia of {link} is taken about {name}, not its mass centre",
            {f"links.{link}.inertia": shifted},
        )
    for name, p in points.items():
        yield f"the mass centre of {link} is taken at {name}", {f"links.{link}.center": [*map(float, p)]}
    mirrored = [float(center[0]), -float(center[1])]
    if center[1] and m.dimension == 2:
        yield f"the mass centre of {link} is on the wrong side of it", {f"links.{link}.center": mirrored}
        along = [float(magnitude(center)), 0.0]
        yield f"the angle of the mass centre of {link} is left out", {f"links.{link}.center": along}


def _other_modes(r: Result) -> Iterator[dict[str, float]]:
    """Angles of the links in the other assembly modes of the first position."""
    from dalembert.core.position.first_pose_plane import Guess

    c = r.compiled
    shape = np.shape(c.layout.reference)
    found = Guess(np.full(shape[0], np.nan), np.full(shape, np.nan)).modes(c.layout, c.targets[0])
    if found is None:
        return
    for turn in found.pose.turn[:, :-1]:
        if np.abs(np.angle(np.exp(1j * (turn - r.turn_array[0])))).max() > 1e-6:
            yield dict(zip(r.links, map(float, turn), strict=True))


def _again(r: Result, change: Tree) -> Result | None:
    from dalembert.analysis.solution import dynamics, statics

    try:
        return (dynamics if r.inertia else statics)(r.mechanism.with_values(change))
    except DalembertError:
        return None
