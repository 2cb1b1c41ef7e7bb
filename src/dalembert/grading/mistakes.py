"""A student's figures against ours, and the first usual mistake that explains a difference.

Each hypothesis is an answer computed as one would get it with that mistake: the value changed (sense, axis, unit),
parts of the superposition left out or scaled (inertia, weights, loads), or the problem solved with one datum wrong.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.errors import DalembertError, ModelError
from dalembert.grading.file_answers import (
    computed_text,
    describe_answer,
    position_of,
    read,
    sides_of,
    target,
    value_text,
)
from dalembert.grading.quantities import QUANTITIES, Series
from dalembert.grading.tolerance import Closeness, closeness
from dalembert.grading.value_errors import Hypothesis, of_units, of_value
from dalembert.grading.wrong_problems import Variants
from dalembert.units import file_units
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Answer, Mechanism


class Verdict(NamedTuple):
    """One figure compared: what it is of, as given, as computed, relative difference, and what explains it."""

    quantity: str
    given: str
    computed: str
    off: float
    right: bool
    mistake: str


def check_answers(mechanism: Mechanism, answers: Sequence[Answer], static: bool = False) -> list[Verdict]:
    """Verdicts on figures for a mechanism.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> mine = da.Answer(quantity="effort", of="O2", value="-243.2 lbf*in")
    >>> da.check_answers(da.load(examples()["four_bar"]), [mine])[0].mistake
    'the sense is opposite: action taken for reaction'
    """
    from dalembert.analysis.solution import solve

    result = solve(mechanism, static=static)
    variants = Variants(result)
    return [_verdict(result, answer, variants) for answer in answers]


def figures(tree: object) -> list[Answer]:
    """Answers of a file: a list as in a model file's `answers`, or {efforts: {O2: 27.5}, reactions: {A: 155 @ 40}}.

    In the short form a single number for a vector is its magnitude.

    >>> figures({"reactions": {"A": "155 N"}})[0].component
    'magnitude'
    """
    from dalembert.model import Answer

    if isinstance(tree, Mapping) and "answers" in tree:
        tree = tree["answers"]
    items = list(_short(tree)) if isinstance(tree, Mapping) else tree
    if not isinstance(items, list) or not all(isinstance(item, Mapping) for item in items):
        raise ModelError(
            "the answers are neither a mapping nor a list of mappings",
            "write efforts: {O2: 243 lbf*in} and reactions: {A: 155 @ 220 deg}",
        )
    for item in items:
        if item.get("quantity") not in QUANTITIES:
            raise ModelError(
                f"there is no quantity {item.get('quantity')!r}",
                closest(str(item.get("quantity")), [*QUANTITIES]),
            )
    return [Answer(**item) for item in items]


VECTORS = ("reaction", "center", "velocity", "position", "point")
"""Quantities of which a single number can only be the magnitude (in space more of them are vectors)."""


def _short(tree: Mapping[str, object]) -> Iterator[Tree]:
    """The items of {efforts: {O2: 27.5}, reactions: {A: 155 @ 40}}."""
    for name, values in tree.items():
        quantity = str(name).removesuffix("s") if name != "status" else name
        if not isinstance(values, Mapping):
            raise ModelError(
                f"{name} stands without names of what the figures are of", f"write {name}: {{NAME: {values}}}"
            )
        for of, value in values.items():
            item = {"quantity": quantity, "of": of, "value": value}
            single = isinstance(value, int | float) or (isinstance(value, str) and "@" not in value)
            whole = quantity.startswith(VECTORS) and single and value != ""
            yield item | ({"component": "magnitude"} if whole else {})


def _verdict(result: Result, answer: Answer, variants: Variants) -> Verdict:
    """Of either side of a reversal the one that the figure is of."""
    found = [_of_side(side, answer, variants) for side in sides_of(result, answer)]
    return next((v for v in found if v.right), found[0])


def _of_side(result: Result, answer: Answer, variants: Variants) -> Verdict:
    series = read(result, answer)
    k = position_of(result, answer, series)
    units = file_units(result.mechanism.units)
    given = target(answer.value, series, units, "value")
    right = np.asarray(series.values[k], dtype=float)
    close = closeness(answer, given, series.kind, units)
    met = close.holds(right)
    mistake = "" if met else _explain(variants, answer, series, k, right, close)
    return Verdict(
        describe_answer(answer),
        value_text(answer.value),
        computed_text(right, given, series.kind, units, answer.value),
        close.off(right),
        met,
        mistake,
    )


def _explain(
    variants: Variants, answer: Answer, series: Series, k: int, right: Array, close: Closeness
) -> str:
    """The likeliest mistake that gives the figure: close ones are taken in the order of likelihood.

    So many mistakes are tried that some come near any figure: one that is itself nearly right is explained only by a
    mistake that comes much nearer.
    """
    mine = close.off(right)
    small = mine <= SMALL
    found: list[tuple[float, str]] = []
    for hypothesis in _hypotheses(variants, answer, series, k, right):
        if hypothesis.value is None or not np.isfinite(hypothesis.value).all():
            continue
        off = close.off(hypothesis.value)
        if off <= mine / MUCH if small else close.holds(hypothesis.value):
            found.append((off, hypothesis.sentence))
    if not found:
        return ROUNDED if small else "none of the usual mistakes explains it"
    best = min(off for off, _ in found)
    return next(sentence for off, sentence in found if off <= 3 * best + 2e-4)


SMALL = 0.03
"""Relative difference up to which a figure is nearly right."""

MUCH = 5
"""How many times nearer than the right value a mistake must come to explain a figure that is nearly right."""

ROUNDED = "close: rounded too early, or a small slip"


def _hypotheses(
    variants: Variants, answer: Answer, series: Series, k: int, right: Array
) -> Iterator[Hypothesis]:
    yield from of_value(series, right)
    for sentence, result in variants.linear():
        yield Hypothesis(sentence, _read(result, answer, k))
    yield from _others(variants.result, answer, k)
    for sentence, make in variants.solutions():
        yield Hypothesis(sentence, _read(make(), answer, k))
    yield from of_units(series, right)


def _read(result: Result | None, answer: Answer, k: int) -> Array | None:
    """The quantity asked for in a variant."""
    if result is None:
        return None
    try:
        return np.asarray(read(result, answer).values[k], dtype=float)
    except (DalembertError, IndexError):
        return None


def _others(result: Result, answer: Answer, k: int) -> Iterator[Hypothesis]:
    """The right value of something else: another joint, component, or axes."""
    if answer.quantity in ("reaction", "moment"):
        for joint in result.joints:
            if joint != answer.of:
                yield _rename(result, answer, k, {"of": joint, "on": None}, f"this is joint {joint}")
        for link in result.mechanism.joints[str(answer.of)].links if answer.of in result.joints else ():
            change = {"axes": "link", "on": link}
            yield _rename(
                result, answer, k, change, f"components are along and across link {link}, not ground axes"
            )
    if answer.component in ("x", "y"):
        other = "y" if answer.component == "x" else "x"
        yield _rename(
            result, answer, k, {"component": other}, "the angle is counted from the other axis: x for y"
        )
        yield _rename(
            result, answer, k, {"component": "magnitude"}, "this is the magnitude, not the component"
        )
    if answer.quantity in ("angle", "speed", "acceleration", "center_acceleration", "center"):
        for link in result.links:
            if link != answer.of:
                yield _rename(result, answer, k, {"of": link}, f"this is link {link}")


def _rename(result: Result, answer: Answer, k: int, change: Tree, sentence: str) -> Hypothesis:
    return Hypothesis(sentence, _read(result, answer.model_copy(update=change), k))
