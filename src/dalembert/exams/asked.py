"""Quantities of a question: their figures in a result, and their words in a sheet and a key."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import effort_actions
from dalembert.analysis.output.rounding import least
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.grading.answer_sheet import named_figure, without_value
from dalembert.grading.file_answers import describe_answer, position_of, read, sides_of
from dalembert.grading.marking import table_files
from dalembert.grading.quantities import QUANTITIES
from dalembert.model import GROUND, StatedAnswer
from dalembert.model.stated_answers import NAMES
from dalembert.views.notation import Shown, pretty
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

CHECKS = ("residual", "power_balance")
"""Quantities that check an answer, and that are never part of a question."""

NOTHING = 1e-9
"""Part of the largest reaction below which a figure is none."""

FORMS = "write effort.O2, reaction.A, reaction.A.coupler, reaction.A.magnitude, angle.rocker.speed or point.rod.P.x"


class ExpectedValue(NamedTuple):
    """The value of a required quantity, SI: a number, a vector or a rotation, of a kind of ``units.KINDS``."""

    kind: str
    value: Array


def requested_quantities(r: Result, ask: Sequence[object], at: int | str | None) -> tuple[StatedAnswer, ...]:
    """Required quantities of a problem: those in ``ask``, else its ``answers``, else all efforts and reactions.

    ``at`` is the position of quantities that do not name one, the first one by default.
    """
    requested = [a for one in ask for a in _named(r, one)] or _of_file(r) or _forces(r)
    many = len(r.status) > 1
    out: list[StatedAnswer] = []
    for a in requested:
        change: dict[str, object] = {}
        if a.quantity in ("reaction", "moment") and a.of in r.joints and a.on is None:
            i, j = r.mechanism.joints[a.of].links
            change |= {"on": (j if a.by == i else i) if a.by else j if j != GROUND else i, "by": None}
        if many and a.at is None and a.extreme is None:
            change["at"] = 1 if at is None else int(at) if str(at).isdigit() else at
        a = a.model_copy(update=change)
        figure(r, a)
        out += [a] if a not in out else []
    if not out:
        raise ModelError("there is nothing to ask: no effort, no unknown load and no reaction", FORMS)
    return tuple(out)


def figure(r: Result, answer: StatedAnswer) -> ExpectedValue:
    """The required figure, just before a reversal where two values exist; rounding is 0."""
    side = sides_of(r, answer)[0]
    series = read(side, answer)
    k = position_of(side, answer, series)
    value = np.asarray(series.values[k], dtype=float)
    return ExpectedValue(
        series.kind, np.where(np.abs(value) < least(side, k).get(series.kind, 0.0), 0.0, value)
    )


def place_of_answer(r: Result, answer: StatedAnswer) -> int:
    """Position of an answer, from 0."""
    side = sides_of(r, answer)[0]
    return position_of(side, answer, read(side, answer))


def _named(r: Result, one: object) -> list[StatedAnswer]:
    """An answer itself, a mapping of its keys, or text: effort.O2."""
    if isinstance(one, StatedAnswer):
        return [one]
    if isinstance(one, Mapping):
        return [StatedAnswer(**one)]
    quantity, *words = str(one).split(".")
    if not words and quantity in ("efforts", "reactions"):
        return [a for a in _forces(r) if a.quantity.startswith(quantity[:-1])]
    known = {*QUANTITIES, *(name.partition(".")[0] for name in NAMES.values())}
    if quantity not in known:
        raise ModelError(f"--ask {one}: unknown quantity {quantity!r}", closest(quantity, sorted(known)))
    if not words:
        raise ModelError(f"--ask {one} does not say of what", FORMS)
    return [StatedAnswer(**named_figure(str(one), None))]


def _of_file(r: Result) -> list[StatedAnswer]:
    """Quantities of the file's answers, without their values."""
    some = (a for a in r.mechanism.answers if a.quantity in QUANTITIES and a.quantity not in CHECKS)
    return [without_value(a) for a in some]


def _forces(r: Result) -> list[StatedAnswer]:
    """Efforts or, of equilibria, positions; unknown loads; reactions that are not zero throughout."""
    m, ends = r.mechanism, ("_low", "_high") if "at_rest" in r.status else ("",)
    out = [StatedAnswer(quantity="drive", of=d) for d in r.drives if m.drives[d].unknown]
    for end in ends:
        out += [StatedAnswer(quantity=f"effort{end}", of=d) for d in r.drives if m.drives[d].effort is None]
        out += [StatedAnswer(quantity=f"unknown_load{end}", of=u) for u in r.unknown_loads]
    if ends != ("",) or r.stability is not None:
        return out
    sizes = {j: float(np.nanmax(np.abs(r.least_norm(j)[:, : m.dimension]), initial=0.0)) for j in r.joints}
    large = max(sizes.values(), default=0.0)
    return out + [
        StatedAnswer(quantity="reaction", of=j)
        for j, s in sizes.items()
        if s > NOTHING * large and r.unique(j).all()
    ]


# in words and in a key


def question_words(shown: Shown, answer: StatedAnswer) -> str:
    """Question for a quantity, with its sign: 'Reaction of A on coupler, $F_{23}$'."""
    one = len(shown.r.status) == 1
    words = describe_answer(answer.model_copy(update={"component": None, "at": None if one else answer.at}))
    words = words[:1].upper() + words[1:]
    of = str(answer.of)
    if answer.quantity == "effort" and of in shown.r.drives:
        kind = "torque" if drive_kinds(shown.r, of)["effort"] == "moment" else "force"
        words = words.replace("Effort of", f"Driving {kind} at", 1)
    if answer.quantity == "reaction":
        words += f", ${shown.reaction(of, str(answer.on))}$"
    if answer.quantity.startswith("effort") and of in shown.r.drives:
        a = next(a for a in effort_actions(shown.r) if a.of == of)
        words += f", ${shown.effort(a)}$"
    return words + (f": {answer.component}" if answer.component else "")


def blanks(answer: StatedAnswer, right: ExpectedValue, units: object) -> tuple[tuple[str, str], ...]:
    """Blanks to fill in: the name of each number and its unit."""
    unit = pretty(Printed(units).text(right.kind))
    if right.value.ndim == 0:
        return (("", unit),)
    if right.value.shape == (2,):
        return (("size", unit), ("direction", "°"))
    return tuple(("xyz"[k] if right.value.ndim == 1 else f"row {k + 1}", unit) for k in range(3))


def key_value(right: ExpectedValue, units: object) -> str:
    """A figure in the file's units with all its digits: 243.23, 154.8 @ 220.32, [x, y, z]."""
    scale = Printed(units)

    def text(kind: str, x: float) -> str:
        return repr(float(f"{float(scale(kind, x)):.14g}") + 0.0)

    v = right.value
    if v.shape == (2,):
        return f"{text(right.kind, float(np.hypot(*v)))} @ {text('angle', float(np.arctan2(v[1], v[0])))}"
    if v.ndim == 2:
        return f"[{', '.join(key_value(ExpectedValue(right.kind, row), units) for row in v)}]"
    if v.ndim == 1:
        return f"[{', '.join(text(right.kind, float(x)) for x in v)}]"
    return text(right.kind, float(v))


def stated_value(right: ExpectedValue, units: object) -> object:
    """A figure as the `answers` of a model file have it; None of a rotation."""
    if right.value.ndim > 1:
        return None
    if right.value.shape == (3,):
        return [stated_value(ExpectedValue(right.kind, x), units) for x in right.value]
    return f"{key_value(right, units)} {Printed(units).text(right.kind)}".strip()


COLUMNS = table_files.COLUMNS[1:]
"""Columns of a key, one row an asked figure."""


def key_row(answer: StatedAnswer, right: ExpectedValue, units: object) -> dict[str, object]:
    """A required figure as a row of the key, without empty cells."""
    row = {name: getattr(answer, name) for name in table_files.KEYS}
    row["axes"] = None if answer.axes == "ground" else answer.axes
    row |= {"value": key_value(right, units), "unit": Printed(units).text(right.kind)}
    return {name: value for name, value in row.items() if value not in (None, "")}
