"""A student's figures against ours, and the first usual mistake that explains a difference.

Each hypothesis is an answer computed as one would get it with that mistake: the value changed (sense, axis, unit),
parts of the superposition left out or scaled (inertia, weights, loads), or the problem solved with one datum wrong.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.actions import actions, magnitude
from dalembert.analysis.answers import computed_text, named, position_of, target, value_text
from dalembert.analysis.quantities import QUANTITIES, Series, component
from dalembert.errors import DalembertError, ModelError
from dalembert.units import file_units
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result import Result
    from dalembert.model import Answer, Mechanism

Array = NDArray[Any]

NEAR = 0.005
"""Relative difference up to which a figure is right, or a mistake explains it, where the answer states no tolerance."""


class Verdict(NamedTuple):
    """One figure compared: what it is of, as given, as computed, relative difference, and what explains it."""

    quantity: str
    given: str
    computed: str
    off: float
    right: bool
    mistake: str


class Hypothesis(NamedTuple):
    """A mistake in words and the value (SI) that it leads to, None where it does not apply."""

    sentence: str
    value: Array | None


def check_answers(mechanism: Mechanism, answers: Sequence[Answer], static: bool = False) -> list[Verdict]:
    """Verdicts on figures for a mechanism.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> mine = da.Answer(quantity="effort", of="O2", value="-243.2 lbf*in")
    >>> da.check_answers(da.load(examples()["four_bar"]), [mine])[0].mistake
    'the sense is opposite: action taken for reaction'
    """
    from dalembert.analysis.solve import solve

    result = solve(mechanism, static=static)
    variants = _Variants(result)
    return [_verdict(result, answer, variants) for answer in answers]


def figures(tree: Any) -> list[Answer]:
    """Answers of a file: a list as in a model file's `answers`, or {efforts: {O2: 27.5}, reactions: {A: 155 @ 40}}."""
    from dalembert.model import Answer

    if isinstance(tree, dict) and "answers" in tree:
        tree = tree["answers"]
    if isinstance(tree, dict):
        tree = [
            {
                "quantity": quantity.removesuffix("s") if quantity != "status" else quantity,
                "of": of,
                "value": value,
            }
            for quantity, values in tree.items()
            for of, value in dict(values).items()
        ]
    for item in tree:
        if item.get("quantity") not in QUANTITIES:
            raise ModelError(
                f"there is no quantity {item.get('quantity')!r}",
                closest(str(item.get("quantity")), [*QUANTITIES]),
            )
    return [Answer(**item) for item in tree]


def _verdict(result: Result, answer: Answer, variants: _Variants) -> Verdict:
    series = _series(result, answer)
    k = position_of(result, answer, series)
    units = file_units(result.mechanism.units)
    given = target(answer.value, series, units, "value")
    right = np.asarray(series.values[k], dtype=float)
    near = _allowed(answer)
    off = _off(right, given.value, series.kind)
    mistake = "" if off <= near else _explained(variants, answer, series, k, right, given.value, near)
    return Verdict(
        named(answer),
        value_text(answer.value),
        computed_text(right, given, series.kind, units),
        off,
        off <= near,
        mistake,
    )


def _series(result: Result, answer: Answer) -> Series:
    return component(QUANTITIES[answer.quantity](result, answer), answer.component)


def _allowed(answer: Answer) -> float:
    text = str(answer.tolerance or "").strip()
    return float(text.removesuffix("%")) / 100 if text.endswith("%") else NEAR


def _off(right: Array, given: Array, kind: str) -> float:
    """Relative difference; of an angle the difference over one radian."""
    difference = np.atleast_1d(right - given)
    if kind == "angle":
        return float(np.abs(np.angle(np.exp(1j * difference))).max())
    scale = float(np.linalg.norm(np.atleast_1d(given))) or float(np.linalg.norm(np.atleast_1d(right))) or 1.0
    return float(np.linalg.norm(difference)) / scale


def _explained(
    variants: _Variants, answer: Answer, series: Series, k: int, right: Array, given: Array, near: float
) -> str:
    """The likeliest mistake that gives the figure: close ones are taken in the order of likelihood."""
    found: list[tuple[float, str]] = []
    for hypothesis in _hypotheses(variants, answer, series, k, right):
        if hypothesis.value is not None and np.isfinite(hypothesis.value).all():
            off = _off(hypothesis.value, given, series.kind)
            if off <= near:
                found.append((off, hypothesis.sentence))
    if not found:
        return "none of the usual mistakes explains it"
    best = min(off for off, _ in found)
    return next(sentence for off, sentence in found if off <= 3 * best + 2e-4)


def _hypotheses(
    variants: _Variants, answer: Answer, series: Series, k: int, right: Array
) -> Iterator[Hypothesis]:
    yield from _values(series, right)
    for sentence, result in variants.linear():
        yield Hypothesis(sentence, _read(result, answer, k))
    yield from _others(variants.result, answer, k)
    for sentence, make in variants.solved():
        yield Hypothesis(sentence, _read(make(), answer, k))
    yield from _units(series, right)


def _read(result: Result | None, answer: Answer, k: int) -> Array | None:
    """The quantity asked for in a variant."""
    if result is None:
        return None
    try:
        return np.asarray(_series(result, answer).values[k], dtype=float)
    except (DalembertError, IndexError):
        return None


# the value itself


def _values(series: Series, right: Array) -> Iterator[Hypothesis]:
    """Senses, axes and components."""
    if series.kind == "angle":
        yield from _angles(right)
        return
    opposite = "the sense is opposite"
    if series.kind in ("force", "moment"):
        opposite += ": action taken for reaction"
    yield Hypothesis(opposite, -right)
    if right.ndim == 0:
        return
    x, y = (float(c) for c in right)
    yield Hypothesis("the angle is counted from the other axis: x and y are exchanged", np.array([y, x]))
    yield Hypothesis("the angle is counted clockwise: y has the wrong sign", np.array([x, -y]))
    yield Hypothesis("x has the wrong sign", np.array([-x, y]))
    yield Hypothesis("x and y are exchanged, one with the wrong sign", np.array([-y, x]))
    yield Hypothesis("x and y are exchanged, one with the wrong sign", np.array([y, -x]))
    size, angle = math.hypot(x, y), math.atan2(y, x)
    turned = math.degrees(angle)
    yield Hypothesis(
        "degrees are taken for radians in sine and cosine",
        size * np.array([math.cos(turned), math.sin(turned)]),
    )


def _angles(right: Array) -> Iterator[Hypothesis]:
    for sentence, value in (
        ("the sense is opposite: action taken for reaction", right + math.pi),
        ("the angle is counted from the other axis", math.pi / 2 - right),
        ("the angle is counted clockwise", -right),
        ("the angle is counted from the negative x axis", math.pi - right),
        ("the number is in radians, not degrees", np.radians(right)),
        ("the number is in degrees, not radians", np.degrees(right)),
    ):
        yield Hypothesis(sentence, np.asarray(value))


FACTORS: tuple[tuple[float, str, tuple[str, ...]], ...] = (
    (12.0, "inches and feet", ("length", "moment", "speed", "acceleration")),
    (25.4, "millimetres and inches", ("length", "moment", "speed", "acceleration")),
    (1000.0, "a factor of 1000 (mm and m, N and kN)", ()),
    (100.0, "centimetres and metres", ("length", "moment", "speed", "acceleration")),
    (10.0, "millimetres and centimetres", ("length", "moment", "speed", "acceleration")),
    (4.4482216152605, "pounds and newtons", ("force", "moment")),
    (9.80665, "g: kilograms and newtons", ("force", "moment")),
    (32.174, "g in ft/s2: pounds and slugs", ("force", "moment")),
    (386.089, "g in in/s2: pounds and blobs", ("force", "moment")),
    (30 / math.pi, "rpm and rad/s", ("angular_speed",)),
    (180 / math.pi, "degrees and radians", ("angular_speed", "angular_acceleration")),
    (2.0, "a factor of 2", ()),
)
"""Factors that units bring in, what they are, and of which kinds of numbers (all where none is named)."""


def _units(series: Series, right: Array) -> Iterator[Hypothesis]:
    for factor, words, kinds in FACTORS:
        if not kinds or series.kind in kinds:
            for f in (factor, 1 / factor):
                text = words if words.startswith("a factor") else f"units are mixed up: {words}"
                yield Hypothesis(text, right * f)


def _others(result: Result, answer: Answer, k: int) -> Iterator[Hypothesis]:
    """The right value of something else: another joint, component, or axes."""
    if answer.quantity in ("reaction", "moment"):
        for joint in result.joints:
            if joint != answer.of:
                yield _renamed(result, answer, k, {"of": joint, "on": None}, f"this is joint {joint}")
        for link in result.mechanism.joints[str(answer.of)].links if answer.of in result.joints else ():
            change = {"axes": "link", "on": link}
            yield _renamed(
                result, answer, k, change, f"components are along and across link {link}, not ground axes"
            )
    if answer.component in ("x", "y"):
        other = "y" if answer.component == "x" else "x"
        yield _renamed(
            result, answer, k, {"component": other}, "the angle is counted from the other axis: x for y"
        )
        yield _renamed(
            result, answer, k, {"component": "magnitude"}, "this is the magnitude, not the component"
        )
    if answer.quantity in ("angle", "speed", "acceleration", "center_acceleration", "center"):
        for link in result.links:
            if link != answer.of:
                yield _renamed(result, answer, k, {"of": link}, f"this is link {link}")


def _renamed(result: Result, answer: Answer, k: int, change: dict[str, Any], sentence: str) -> Hypothesis:
    return Hypothesis(sentence, _read(result, answer.model_copy(update=change), k))


# the same problem with one thing wrong


class _Variants:
    """Results with one mistake each, made once."""

    def __init__(self, result: Result) -> None:
        self.result = result
        self._linear: list[tuple[str, Result]] | None = None
        self._solved: dict[int, Result | None] = {}

    def linear(self) -> list[tuple[str, Result]]:
        """Parts of the superposition left out, reversed or scaled."""
        if self._linear is None:
            try:
                self._linear = list(_scaled(self.result))
            except ModelError:
                self._linear = []
        return self._linear

    def solved(self) -> Iterator[tuple[str, Callable[[], Result | None]]]:
        """Solved again with one datum changed, each when it is looked at."""
        for n, (sentence, change) in enumerate(_changes(self.result)):
            yield sentence, partial(self._made, n, change)

    def _made(self, n: int, change: dict[str, Any]) -> Result | None:
        if n not in self._solved:
            self._solved[n] = _again(self.result, change)
        return self._solved[n]


def _scaled(r: Result) -> Iterator[tuple[str, Result]]:
    from dalembert.analysis.superposition import superposition

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


def _changes(r: Result) -> Iterator[tuple[str, dict[str, Any]]]:
    """Data changed one at a time: a sentence and what to put in their place."""
    m = r.mechanism
    for mode in _other_modes(r):
        yield "this is the other assembly mode", {"assembly": mode}
    if not any(m.gravity_vector):
        yield "gravity is counted, and the problem has none", {"gravity": "standard"}
    for name, load in m.loads.items():
        if load.type == "force" and not load.unknown:
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


def _force_changes(r: Result, name: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """A force at another point of its link, or in another direction."""
    m, load = r.mechanism, r.mechanism.loads[name]
    on = load.on  # type: ignore[union-attr]
    for point in [*m.points(on), "center"]:
        if point != load.at:  # type: ignore[union-attr]
            yield f"the moment arm of {name} is wrong: it is taken at {point}", {f"loads.{name}.at": point}
    other = "link" if load.axes == "ground" else "ground"  # type: ignore[union-attr]
    yield f"the direction of {name} is counted in {other} axes", {f"loads.{name}.axes": other}
    a = next(a for a in actions(r) if a.of == name)
    if load.axes == "ground" and len(r.status) == 1:  # type: ignore[union-attr]
        x, y = (float(c) for c in a.force[0])
        path = f"loads.{name}.value"
        yield f"the angle of {name} is counted from the other axis", {path: [y, x]}
        yield f"the angle of {name} is counted clockwise", {path: [x, -y]}
        yield f"the angle of {name} is counted from the negative x axis", {path: [-x, y]}


def _link_changes(r: Result, link: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """The mass centre or the moment of inertia of a link at the wrong point."""
    m = r.mechanism
    if not m.mass(link):
        return
    center = np.array(m.center(link))
    points = {n: np.array(p) for n, p in m.points(link).items()}
    for name, p in points.items():
        shifted = m.inertia(link) + m.mass(link) * float(magnitude(p - center)) ** 2
        yield (
            f"the moment of inertia of {link} is taken about {name}, not its mass centre",
            {f"links.{link}.inertia": shifted},
        )
    for name, p in points.items():
        yield f"the mass centre of {link} is taken at {name}", {f"links.{link}.center": [*map(float, p)]}
    mirrored = [float(center[0]), -float(center[1])]
    if center[1]:
        yield f"the mass centre of {link} is on the wrong side of it", {f"links.{link}.center": mirrored}
        along = [float(magnitude(center)), 0.0]
        yield f"the angle of the mass centre of {link} is left out", {f"links.{link}.center": along}


def _other_modes(r: Result) -> Iterator[dict[str, float]]:
    """Angles of the links in the other assembly modes of the first position."""
    from dalembert.core.assembly import modes

    c = r.compiled
    free = replace(
        c.guess, turn=np.full_like(c.guess.turn, np.nan), point=np.full_like(c.guess.point, np.nan)
    )
    found = modes(c.layout, c.targets[0], free)
    if found is None:
        return
    for turn in found.pose.turn[:, :-1]:
        if np.abs(np.angle(np.exp(1j * (turn - r.turn_array[0])))).max() > 1e-6:
            yield dict(zip(r.links, map(float, turn), strict=True))


def _again(r: Result, change: dict[str, Any]) -> Result | None:
    from dalembert.analysis.solve import dynamics, statics

    try:
        return (dynamics if r.inertia else statics)(r.mechanism.with_values(change))
    except DalembertError:
        return None
