"""A sheet of figures as a student writes it: a list as in a model file, or names with values by quantity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Tree
from dalembert.errors import Locator, ModelError, errors_at
from dalembert.grading.quantities import QUANTITIES, WHOLE, WORDS
from dalembert.grading.tolerance import percent
from dalembert.grading.written_figure import readings_of
from dalembert.model.stated_answers import parts_of_name
from dalembert.wording import closest, quote_value

if TYPE_CHECKING:
    from dalembert.model import StatedAnswer

KNOWN = (*QUANTITIES, *WORDS, *WHOLE)
"""Quantities that a figure may have."""

ABOUT = ("student", "variant", "tolerance")
"""Keys of a sheet beside its figures."""


@dataclass(frozen=True)
class AnswerSheet:
    """Figures, their lines, the tolerance of those that give none, the student and the variant."""

    answers: tuple[StatedAnswer, ...]
    lines: tuple[int, ...] = ()
    tolerance: str | None = None
    student: str = ""
    variant: str = ""
    file: str = ""

    def line(self, number: int) -> int:
        """The line of a figure; 0 without a file."""
        return self.lines[number] if self.lines else 0


def read_sheet(tree: object, source: Locator | None = None) -> AnswerSheet:
    """The sheet of a file's tree; ModelError with file and line where it is wrong.

    In the short form a single number for a vector is its magnitude, and `at` is the position of all figures.

    >>> read_sheet({"tolerance": "3 %", "reactions": {"A": "155 N"}}).answers[0].component
    'magnitude'
    """
    try:
        about = about_sheet(tree)
        if isinstance(tree, Mapping) and tree.get("tolerance") is not None:
            percent(tree["tolerance"])
        items, answers = list(sheet_items(tree)), []
        for path, item in items:
            with errors_at(*path):
                answers.append(answer_of(_as_read(item)))
    except ModelError as error:
        raise error.at_source(source) from None
    lines = tuple(source.line(path) for path, _ in items) if source else ()
    name, tolerance = source.name if source else "", about["tolerance"] or None
    return AnswerSheet(tuple(answers), lines, tolerance, about["student"], about["variant"], name)


def _as_read(item: Tree) -> Tree:
    """The keys of a figure with its value as a model file writes it."""
    value = item.get("value")
    if value in (None, "") or item.get("quantity") in (*WHOLE, *WORDS):
        return item
    readings = readings_of(value).readings
    if len(readings) > 1:
        text = " or ".join(map(str, readings))
        raise ModelError(f"{quote_value(value)} may be {text}", "write one of them", ("value",))
    return item | {"value": readings[0]} if readings else item


def about_sheet(tree: object) -> dict[str, str]:
    """Keys of a sheet beside its figures; empty where it has none."""
    entries = {key: tree.get(key) for key in ABOUT} if isinstance(tree, Mapping) else dict.fromkeys(ABOUT)
    return {key: "" if value is None else str(value) for key, value in entries.items()}


def without_value(answer: StatedAnswer) -> StatedAnswer:
    """The subject of an answer, without the file's values for it."""
    return answer.model_copy(update=dict.fromkeys(("value", "exact", "tolerance", "exact_tolerance", "why")))


def figures(tree: object) -> list[StatedAnswer]:
    """The answers of a sheet, as in a model file's `answers` or {efforts: {O2: 27.5}, reactions: {A: 155 @ 40}}."""
    return list(read_sheet(tree).answers)


Path = tuple[str | int, ...]


def sheet_items(tree: object) -> Iterator[tuple[Path, Tree]]:
    """Every figure as the keys of an answer, and its path."""
    base: Path = ()
    if isinstance(tree, Mapping) and "answers" in tree:
        tree, base = tree["answers"], ("answers",)
    if isinstance(tree, Mapping):
        place = {"at": tree["at"]} if "at" in tree else {}
        short = {key: value for key, value in tree.items() if key not in (*ABOUT, "at")}
        for path, item in _short(short):
            yield path, item if item["quantity"] in WHOLE else item | place
        return
    if not isinstance(tree, list) or not all(isinstance(item, Mapping) for item in tree):
        what = "the answers are neither a mapping nor a list of mappings"
        raise ModelError(what, "write efforts: {O2: 243 lbf*in} and reactions: {A: 155 @ 220 deg}")
    yield from (((*base, k), dict(item)) for k, item in enumerate(tree))


def answer_of(item: Tree) -> StatedAnswer:
    """The answer of its keys; ModelError where they are wrong."""
    from dalembert.model import StatedAnswer

    if item.get("quantity") not in KNOWN:
        problem = f"unknown quantity {item.get('quantity')!r}"
        raise ModelError(problem, closest(str(item.get("quantity")), [*KNOWN], 40))
    return StatedAnswer(**item)


VECTORS = ("reaction", "center", "velocity", "position", "point")
"""Quantities of which a single number can only be the magnitude (in space more of them are vectors)."""


def _short(tree: Mapping[Any, object]) -> Iterator[tuple[Path, Tree]]:
    """The figures of {efforts: {O2: 27.5}, reactions: {A: 155 @ 40}, mobility: 1}, without their position."""
    for name, values in tree.items():
        quantity = str(name).removesuffix("s") if name != "status" else name
        if quantity in (*WHOLE, *WORDS) and not isinstance(values, Mapping):
            yield (name,), {"quantity": quantity, "value": values}
            continue
        if not isinstance(values, Mapping):
            what = f"{name} needs names, of the things that the figures belong to"
            raise ModelError(what, f"write {name}: {{NAME: {quote_value(values)}}}", (name,))
        for of, value in values.items():
            yield (name, of), short_item(quantity, str(of), value)


def short_item(quantity: str, of: str, value: object) -> Tree:
    """A figure of a name and a value: a single number for a vector is its magnitude."""
    return with_size({"quantity": quantity, "of": of, "value": value})


def with_size(keys: Tree) -> Tree:
    """The keys of a figure; a single number for a vector is its magnitude."""
    value = keys.get("value")
    single = isinstance(value, int | float) or (isinstance(value, str) and "@" not in value)
    is_size = str(keys.get("quantity")).startswith(VECTORS) and single and value != ""
    return {"component": "magnitude"} | keys if is_size else keys


def named_figure(name: str, value: object) -> dict[str, object]:
    """A figure by the name of its column: a quantity, of a reaction with the link acted on; or a word, as `mobility`.

    >>> named_figure("reaction.A.coupler", "155 @ 220")
    {'quantity': 'reaction', 'of': 'A', 'value': '155 @ 220', 'on': 'coupler'}
    >>> named_figure("angle.rod.speed", 3)
    {'quantity': 'speed', 'of': 'rod', 'value': 3}
    """
    if "." not in name:
        return {"quantity": name, "value": value}
    item: dict[str, object] = dict(parts_of_name(name))
    thing = str(item.get("of", ""))
    of, _, on = thing.partition(".")
    acts = {"of": of, "on": on} if on and item["quantity"] in ("reaction", "moment") else {}
    return short_item(str(item["quantity"]), thing, value) | item | acts
