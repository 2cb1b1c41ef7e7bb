"""A sheet's wrong figures: what explains them best, how certain that is, and which sentence each of them has."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.explanation import Explanation, _Option, _said, _Sheet
from dalembert.grading.own_figures import OwnFigures
from dalembert.grading.value_slips import ValueSlip, coincidence
from dalembert.grading.wrong.wrong_problems import WrongProblem
from tests.grading.test_slips_of_figures import made

NONE = Explanation("none of the usual mistakes explains it", "unknown")


def problem(sentence: str = "load F is left out", order: int = 2) -> WrongProblem:
    return WrongProblem(order, sentence, lambda: None)


def slip(sentence: str = "the sense is opposite", chance: float = 1e-4, kind: str = "sign") -> ValueSlip:
    return ValueSlip(sentence, kind, np.array(1.0), chance)


def option(*explained: int, values: dict[int, Any] | None = None, **more: Any) -> _Option:
    """A mistake that explains some figures exactly."""
    known = {n: np.array(130.0 + n) for n in explained} | (values or {})
    return _Option(more.pop("problem", problem()), dict.fromkeys(explained, 0.0), known, **more)


def sheet(
    count: int = 3, slips: dict[int, ValueSlip] | None = None, given: float = 150.0, **own: Any
) -> _Sheet:
    """Wrong numbers of 100, each with so many digits, and what their slips and the student's own figures say."""
    figures = [made(given, 100.0, (0.05 * (n + 1),), answer={"of": f"D{n}"}) for n in range(count)]
    out = _Sheet(figures, list(range(count)), None, OwnFigures(**own))
    out.__dict__["slips"] = slips or {}
    return out


def test_a_mistake_costs_one_each_slip_beside_it_one_and_each_open_figure_one_and_a_half() -> None:
    some = {3: slip("x"), 4: slip("x"), 5: slip("y")}
    assert option(0, 1).cost == 1
    assert option(0, slips=some).cost == 3
    assert option(0, slips=some, open=[6, 7, 8]).cost == 7.5


@pytest.mark.parametrize(
    ("other", "same"),
    [
        (option(0, 2, values={0: np.array(130.14)}), True),
        (option(0, 2, values={0: np.array(129.91)}), True),
        (option(0, 2, values={0: np.array(130.15)}), True),  # a part in a thousand is the last digit of 100
        (option(0, 2, values={2: np.array(133.0)}), False),
        (option(0, 1), False),
        (option(0), False),
        (option(0, 2, open=[1]), False),
    ],
)
def test_two_mistakes_are_the_same_where_all_figures_are_alike(other: _Option, same: bool) -> None:
    one = sheet(given=100.0)
    one.figures = [made(100.0, 50.0, (0.08,)) for _ in range(3)]
    assert one._same(option(0, 2), other) is same


@pytest.mark.parametrize(
    ("order", "explained", "count"),
    [(1, 2, 2), (2, 2, 2), (3, 2, 3), (3, 3, 1), (3, 1, 4), (1, 4, 1)],
)
def test_expected_are_the_mistakes_as_usual_that_move_as_many_figures(
    order: int, explained: int, count: int
) -> None:
    one = sheet(4)
    known = option(*range(explained), problem=problem(order=order))
    expected = one._expected(known, [(1, 1), (2, 2), (2, 3), (3, 2)])
    assert expected == pytest.approx(count * one._chance(known), rel=1e-12)


@pytest.mark.parametrize(
    ("own", "count", "independent"),
    [
        ({}, 3, 2),
        ({}, 1, 1),
        ({"numbers": {0: 2, 1: 1}}, 3, 3),
        ({"numbers": {0: 2, 1: 1}, "slip": "moments on rod"}, 3, 1),
        ({"slip": "moments on rod"}, 3, 1),
    ],
)
def test_chance_multiplies_as_many_of_the_likeliest_numbers_as_are_independent(
    own: dict[str, Any], count: int, independent: int
) -> None:
    one = sheet(count, **own)
    assert one.independent == independent
    known = option(*range(count))
    each = [coincidence(one.figures[n], known.values[n], 0.0) for n in range(count)]
    assert each == sorted(each)  # of more digits, less likely
    assert one._chance(known) == pytest.approx(np.prod(each[-independent:]), rel=1e-12)


def test_a_vector_alone_has_two_independent_numbers() -> None:
    one = _Sheet([made([60, 80], [1, 2], (0.1, 0.1))], [0], None, None)
    assert one.independent == 2
    known = option(0, values={0: np.array([60.0, 80.0])})
    assert one._chance(known) == pytest.approx(coincidence(one.figures[0], known.values[0], 0.0) ** 2)


@pytest.mark.parametrize(
    ("explained", "slip_cost", "follows", "better"),
    [
        (2, 1.0, {}, True),  # as cheap as the slips
        (2, 0.9, {}, False),
        (2, 1.0, {0: "x"}, False),  # figures that follow must be beaten
        (2, 1.19, {0: "x"}, False),
        (2, 1.21, {0: "x"}, True),
        (3, 1.0, {0: "x"}, True),  # all of them
        (3, 0.9, {}, False),
    ],
)
def test_a_mistake_must_explain_more_than_slips_and_carried_figures(
    explained: int, slip_cost: float, follows: dict[int, str], better: bool
) -> None:
    assert sheet(follows=follows)._better(option(*range(explained)), slip_cost) is better


def kinds(found: dict[int, Explanation]) -> dict[int, str]:
    return {n: found[n].kind for n in sorted(found)}


@pytest.mark.parametrize(
    ("chance", "open_", "said"),
    [
        (0.01, [], {0: "named", 1: "named", 2: "sign"}),
        (0.0101, [], {0: "may_be", 1: "may_be", 2: "sign"}),
        (0.3, [], {0: "may_be", 1: "may_be", 2: "sign"}),
        (0.31, [], {0: "unknown", 1: "unknown", 2: "sign"}),
        (0.01, [3], {0: "may_be", 1: "may_be", 2: "sign", 3: "unknown"}),
        (0.3, [3], {0: "may_be", 1: "may_be", 2: "sign", 3: "unknown"}),
        (0.01, [3, 4], {0: "unknown", 1: "unknown", 2: "sign", 3: "unknown", 4: "unknown"}),
    ],
)
def test_a_mistake_is_named_where_chance_is_no_explanation_and_possible_where_it_may_be(
    chance: float, open_: list[int], said: dict[int, str]
) -> None:
    one = sheet(3 + len(open_), {2: slip()})
    best = option(0, 1, slips={2: slip()}, open=open_)
    found = one._with(best, chance)
    assert kinds(found) == said
    assert set(found.values()) - {NONE, Explanation("the sense is opposite", "sign")} <= {
        Explanation("load F is left out", "named", "datum"),
        Explanation("may be: load F is left out", "may_be", "datum"),
    }


@pytest.mark.parametrize("own", [{"follows": {2: "moments about A on rod"}}, {"slip": "moments on rod"}])
def test_a_possible_mistake_is_beside_the_figures_that_follow(own: dict[str, Any]) -> None:
    one = sheet(3, {0: slip()}, **own)
    found = one._with(option(0, 1, open=[2]), 0.05)
    possible = Explanation("may be: load F is left out", "may_be", "datum")
    follows = Explanation("right with your own figures, by the moments about A on rod", "follow_through")
    assert found == {0: possible, 1: possible, 2: follows if "follows" in own else NONE}
    assert one._with(option(0, 1), 0.001)[0].kind == "named"


@pytest.mark.parametrize(
    ("count", "chance", "kind", "said"),
    [
        (1, 0.01, "named", "the sense is opposite, or load F is left out"),
        (1, 0.0101, "named", None),
        (1, 0.01, "may_be", None),
        (2, 0.01, "named", None),
    ],
)
def test_of_a_single_wrong_figure_a_slip_and_a_mistake_are_said_together(
    count: int, chance: float, kind: str, said: str | None
) -> None:
    found = sheet(count, {0: slip(chance=chance)})._alone(option(0), kind)
    assert found == (None if said is None else Explanation(said, "sign"))
    assert sheet(count)._alone(option(0), kind) is None


@pytest.mark.parametrize(
    ("mine", "others", "own", "count", "sure"),
    [
        (slip(chance=0.01), {}, {}, 1, True),
        (slip(chance=0.0101), {}, {}, 1, False),
        (slip(chance=5e-4), {}, {}, 2, True),  # beside what is open
        (slip(chance=5.1e-4), {}, {}, 2, False),
        (slip(chance=0.01), {}, {"follows": {1: "x"}}, 2, True),
        (slip(chance=0.01), {1: slip("y")}, {}, 2, True),
        (slip("a", kind="named"), {1: slip("b", kind="named"), 2: slip("b", kind="named")}, {}, 3, True),
        (slip("a", kind="named"), {1: slip("b", kind="named"), 2: slip("c", kind="named")}, {}, 3, False),
        (slip("a", kind="named"), {1: slip("b", kind="named"), 2: slip("c", kind="sign")}, {}, 3, True),
        (slip("a"), {1: slip("b", kind="named"), 2: slip("c", kind="named")}, {}, 3, True),
        (slip("a", kind="named"), {}, {"follows": {1: "x"}}, 2, False),
    ],
)
def test_a_slip_is_sure_where_neither_chance_nor_the_machine_explains_it(
    mine: ValueSlip, others: dict[int, ValueSlip], own: dict[str, Any], count: int, sure: bool
) -> None:
    assert sheet(count, {0: mine, **others}, **own)._is_sure(mine) is sure


def test_each_figure_by_itself_has_the_first_sentence_that_fits() -> None:
    first, wide = slip("a", 1e-4), slip("b", 0.2)
    follows = {0: "moments about A on rod"}
    both = sheet(2, {0: first, 1: first}, follows=follows)
    assert (
        both._one(0, option(0), True).sentence == "right with your own figures, by the moments about A on rod"
    )
    assert both._one(1, option(1), True) == Explanation("may be: load F is left out", "may_be", "datum")
    assert both._one(1, option(0), True) == Explanation("a", "sign")
    assert sheet(1, {0: wide})._one(0, None, True) == Explanation("may be: b", "may_be")
    close = Explanation("close: rounded too early, or a small slip", "rounding")
    assert sheet(2, {0: wide})._one(0, None, True) == close
    behind = sheet(3, first={0: [1, 2]})._one(0, None, False)
    assert behind == Explanation("look here first: right with it are effort of D1, effort of D2", "unknown")
    assert sheet(2)._one(0, None, False) == NONE


@pytest.mark.parametrize(
    ("right", "stated", "more"),
    [
        (105.0, False, "; it is 5 % off, which a drawing may be: state a tolerance if it is one"),
        (95.9, False, "; it is 4.1 % off, which a drawing may be: state a tolerance if it is one"),
        (105.1, False, ""),
        (104.0, True, ""),
    ],
)
def test_what_is_off_by_little_may_be_drawn(right: float, stated: bool, more: str) -> None:
    one = _Sheet([made(100.0, right, (0.05,), stated=stated)], [0], None, None)
    one.__dict__["slips"] = {}
    assert one._by_parts(None) == {0: Explanation(NONE.sentence + more, "unknown")}


@pytest.mark.parametrize(("right", "kind"), [(103.0, "rounding"), (103.1, "unknown"), (97.5, "rounding")])
def test_all_figures_within_three_percent_are_close(right: float, kind: str) -> None:
    figures = [made(100.0, 101.0, (0.05,)), made(100.0, right, (0.05,))]
    one = _Sheet(figures, [0, 1], None, None)
    one.__dict__["slips"] = {}
    assert {e.kind for e in one._by_parts(None).values()} == {kind}


@pytest.mark.parametrize(
    ("right", "stated", "moved"),
    [
        (100.0, False, [False, False, False, True, True]),
        (-100.0, False, [True] * 5),
        (100.0, True, [True] * 5),
    ],
)
def test_a_mistake_moves_a_figure_from_two_parts_in_a_thousand(
    right: float, stated: bool, moved: list[bool]
) -> None:
    one = _Sheet([made(150.0, right, stated=stated)], [0], None, None)
    values = [100.0, 100.199, 99.801, 100.201, 99.799]
    assert [one._moves(0, [np.array(x)]) for x in values] == moved
    assert one._moves(0, [np.array(170.0), np.array(right)]) is stated
    assert not one._moves(0, [])


def test_three_mistakes_with_the_same_figures_are_said_and_more_are_counted_as_one() -> None:
    words = ["load F is left out", "gravity is left out", "load F is left out", "c", "d"]
    best = option(0, problem=problem(words[0]), also=[problem(w) for w in words[1:4]])
    three = "load F is left out, or gravity is left out, or c"
    assert _said(best, "named") == Explanation(three, "named", "datum")
    best.also.append(problem("d"))
    more = f"may be: {three}, or another mistake with the same figures"
    assert _said(best, "may_be") == Explanation(more, "may_be", "datum")
    assert _said(option(0, problem=problem("gravity is left out")), "named").weight == "concept"


def test_figures_that_are_judged_and_met_are_right_and_impossible_ones_are_said() -> None:
    figures = [made(100.0, 100.0), made(100.0, 150.0), made(-100.0, 150.0, answer={"component": "magnitude"})]
    one = _Sheet(figures, [1], None, None)
    assert (one.right, one.places) == ([0], {0: 0, 1: 0, 2: 0})
    m = da.four_bar(positions=1)
    answers = [da.Answer(quantity="reaction", of="A", component="magnitude", value="-7 N")]
    (found,) = da.check_answers(m, answers)
    said = "a magnitude is never negative; the direction or the components give the sense"
    assert (found.mistake, found.kind) == (said, "sign")
