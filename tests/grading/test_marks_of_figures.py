"""Marks of one figure by its verdict, what is lost once, which reading counts, and a neighbour's figures."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.marking.by_hand import ReadFigure
from dalembert.grading.marking.grade import _Marker, _Taken
from dalembert.grading.marking.key import Asked, ExamVariant, read_key
from dalembert.grading.marking.rubric import Rubric, read_rubric
from dalembert.grading.mistakes import Verdict, verdict_of, verdict_on_word
from tests.grading.test_slips_of_figures import made

EFFORT: dict[str, Any] = {"quantity": "effort", "of": "O2", "value": "3", "unit": "N*m"}
FORCE: dict[str, Any] = {"quantity": "reaction", "of": "A"}


def marker(rubric: Rubric | None = None, **row: Any) -> _Marker:
    return _Marker(read_key([EFFORT | row]), rubric or Rubric(), None)


def verdict(kind: str, mistake: str = "the sense is opposite", weight: str = "") -> Verdict:
    return Verdict("effort of O2", "-3 N*m", "3 N*m", 2.0, kind == "right", mistake, kind, weight=weight)


def taken(answer: dict[str, Any] | None = None, given: dict[str, Any] | None = None, **more: Any) -> _Taken:
    question = Asked(da.Answer(**(answer or {"quantity": "effort", "of": "O2"})), "", more.pop("marks", 4.0))
    reply = None if given is None else da.Answer(**given)
    return _Taken(question, reply, None, more.pop("sentence", ""), 7, more.pop("notes", ()))


@pytest.mark.parametrize(
    ("kind", "weight", "paid", "outcome", "marks", "then"),
    [
        ("right", "", set(), "right", 4.0, set()),
        ("sign", "", set(), "sign", 2.0, {"m"}),
        ("unit", "", set(), "unit", 2.0, {"m"}),
        ("named", "", set(), "named", 2.0, {"m"}),
        ("sign", "", {"m"}, "repeated", 4.0, {"m"}),
        ("named", "", {"m"}, "repeated", 4.0, {"m"}),
        ("sign", "", {"other"}, "sign", 2.0, {"m", "other"}),
        ("named", "datum", set(), "datum", 3.0, set()),
        ("named", "concept", {"m"}, "concept", 2.0, {"m"}),
        ("may_be", "datum", set(), "may_be", 1.0, set()),
        ("follow_through", "", set(), "follow_through", 4.0, set()),
        ("rounding", "", set(), "rounding", 3.5, set()),
        ("unknown", "", set(), "unknown", 0.0, set()),
    ],
)
def test_a_figure_has_the_marks_of_its_verdict_and_a_slip_is_paid_once(
    kind: str, weight: str, paid: set[str], outcome: str, marks: float, then: set[str]
) -> None:
    some = set(paid)
    found = marker()._mark(taken(), verdict(kind, "m", weight), some)
    assert (found.outcome, found.marks, found.most, found.line) == (outcome, marks, 4.0, 7)
    assert (found.quantity, found.given, found.computed) == ("effort of O2", "-3 N*m", "3 N*m")
    assert found.sentence == "m"
    assert some == then


def test_what_is_not_judged_not_given_or_not_read() -> None:
    own = marker()
    nothing = own._mark(taken(given=None), None, set())
    assert (nothing.outcome, nothing.sentence, nothing.given, nothing.marks, nothing.most) == (
        "missing", "no answer is given", "", 0.0, 4.0,
    )  # fmt: skip
    unread = taken(given={"quantity": "effort", "of": "O2", "value": "x"}, sentence="it has no reading")
    waits = own._mark(unread, None, set())
    assert (waits.outcome, waits.sentence, waits.given) == ("waits", "it has no reading", "'x'")
    assert (waits.marks, waits.most) == (0.0, 0.0)
    some = marker(read_rubric({"share": {"unreadable": 0.25, "missing": 0.5}}))
    assert [some._mark(t, None, set()).marks for t in (unread, taken())] == [1.0, 2.0]
    still = own._mark(taken(), verdict("open", "it cannot be judged"), set())
    assert (still.outcome, still.marks, still.most, still.computed) == ("open", 0.0, 0.0, "")


def test_marks_are_those_of_the_question_or_of_the_rubric() -> None:
    rubric = read_rubric({"marks": {"effort": 6, "default": 2}})
    assert marker(rubric)._mark(taken(marks=None), verdict("sign"), set()).most == 6.0
    assert marker(rubric)._mark(taken(marks=0.5), verdict("sign"), set()).most == 0.5
    assert marker(rubric)._mark(taken(FORCE, marks=None), verdict("right", ""), set()).marks == 2.0


@pytest.mark.parametrize(
    ("question", "given", "part"),
    [
        (FORCE, {"component": "magnitude"}, True),
        (FORCE | {"value": "[1, 2]"}, {"component": "magnitude"}, False),  # a text that is no vector
        (FORCE | {"value": ["1 N", "2 N"]}, {"component": "magnitude"}, True),
        (FORCE | {"value": "5 N @ 30"}, {"component": "magnitude"}, True),
        (FORCE | {"value": "5 N"}, {"component": "magnitude"}, False),
        (FORCE | {"component": "magnitude"}, {"component": "magnitude"}, False),
        (FORCE, {"component": "x"}, False),
        (FORCE, {}, False),
    ],
)
def test_of_a_vector_its_size_alone_is_a_part(
    question: dict[str, Any], given: dict[str, Any], part: bool
) -> None:
    t = taken(question, FORCE | {"value": "5 N"} | given, notes=("written as about",))
    assert t.part is part
    found = marker()._mark(t, verdict("right", ""), set())
    assert found.marks == (2.0 if part else 4.0)
    assert found.sentence == ("only its size; written as about" if part else "written as about")


def test_of_two_readings_the_nearer_to_the_right_value_counts() -> None:
    key = read_key([EFFORT])
    (variant,) = key.variants.values()
    own, problems = _Marker(key, Rubric(), None), list[str]()

    def read(*values: str) -> ReadFigure:
        answers = tuple(da.Answer(quantity="effort", of="O2", value=v) for v in values)
        return ReadFigure(answers, "", "a.csv:2: T: '3,1'", ("a.csv", 2), ("a note",))

    for values, best in (
        (("3.1", "31"), "3.1 N*m"),
        (("31", "3.1"), "3.1 N*m"),
        (("2", "3", "3.1"), "3 N*m"),
    ):
        found = own._best(variant, variant.asked[0], read(*values), problems)
        assert found.given is not None
        assert str(found.given.value).removesuffix(" N*m") == best.removesuffix(" N*m")
        assert (found.line, found.notes) == (2, ("a note",))
        said = best.removesuffix(" N*m")
        choice = f"a.csv:2: T: '3,1' may be {' or '.join(values)}: {said}, the nearer to the key, counts"
        assert problems.pop() == choice
    own._best(variant, variant.asked[0], read("3"), problems)
    assert problems == []
    bad = ReadFigure((), "it is read by hand", "", ("a.csv", 9))
    unread = own._best(variant, variant.asked[0], bad, problems)
    assert (unread.sentence, unread.line, unread.found) == ("it is read by hand", 9, None)


def test_a_students_figure_has_what_the_question_says_and_no_tolerance_of_its_own() -> None:
    row = FORCE | {"on": "rod", "value": "[3 N, 4 N]", "tolerance": "3 %", "at": "2"}
    key = read_key([row])
    (variant,) = key.variants.values()
    own = _Marker(key, Rubric(), None)

    def one(**given: Any) -> _Taken:
        answer = da.Answer(**FORCE, value=("3.05 N", "4 N"), tolerance="40 %", **given)
        return own._one(variant, variant.asked[0], answer, ("a.csv", 2))

    found = one()
    assert found.given is not None
    assert (found.given.on, found.given.at, found.given.tolerance) == ("rod", 2, "3 %")
    other = one(on="crank")
    assert other.given is not None
    assert (other.given.on, other.given.by) == ("crank", None)
    none = own._one(variant, variant.asked[0], None, ("a.csv", 2))
    assert (none.given, none.found, none.sentence, none.line) == (None, None, "", 2)
    empty = own._one(variant, variant.asked[0], da.Answer(**FORCE, value=""), ("a.csv", 2))
    assert (empty.found, empty.sentence) == (None, "")


@pytest.mark.parametrize(
    ("given", "right", "answered", "known", "off", "mistake", "kind"),
    [
        (1.0, 1, "1", "1", 0.0, "", "right"),
        ("1", 1, "1", "1", 0.0, "", "right"),
        (2, 1, "2", "1", 1.0, "another count", "unknown"),
        (" ok ", "ok", "ok", "ok", 0.0, "", "right"),
        ("jammed", "ok", "jammed", "ok", 1.0, "another word", "unknown"),
    ],
)
def test_words_and_counts_are_the_same_or_another(
    given: Any, right: Any, answered: str, known: str, off: float, mistake: str, kind: str
) -> None:
    v = verdict_on_word(da.Answer(quantity="mobility", value=given), right)
    assert (v.given, v.computed, v.off, v.right, v.mistake, v.kind) == (
        answered, known, off, not mistake, mistake, kind,
    )  # fmt: skip


def test_a_verdict_has_the_explanation_of_a_wrong_figure_alone() -> None:
    from dalembert.grading.explanation import Explanation

    said = Explanation("load F is left out", "named", "datum")
    right, wrong = verdict_of(made(3.0, 3.0), said), verdict_of(made(3.0, 4.0), said)
    assert (right.mistake, right.kind, right.weight, right.right) == ("", "right", "", True)
    assert (wrong.mistake, wrong.kind, wrong.weight, wrong.right) == (*said, False)
    assert verdict_of(made(3.0, 4.0), None).kind == "unknown"
    bare = made(3.0, 4.0)
    open_ = verdict_of(type(bare)(**{**vars(bare), "right": (), "reason": "it jams"}), None)
    assert (open_.kind, open_.mistake, open_.right) == ("open", "it cannot be judged: it jams", False)
    assert np.isnan(open_.off)
    assert ExamVariant("01").problem is None
