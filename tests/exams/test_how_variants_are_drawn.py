"""How many sets of values are tried for variants, what a folder of them holds, and what each file of it says."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.exams import candidates, exam_folder
from dalembert.exams import variants as drawing
from dalembert.exams.asked import ExpectedValue
from dalembert.exams.candidates import Candidate, Unfit
from dalembert.exams.question_sheet import ExamText
from dalembert.reports.sheet import ReportSheet
from tests.exams.test_variants import bracket


@pytest.fixture
def tried(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Sizes of the force that are tried; those above 500 make no problem, and no mistake is looked for."""
    sizes: list[float] = []
    right = drawing.candidate(bracket(value=100, direction="30 deg"), {}, [REACTION])

    def candidate(m: da.Mechanism, values: dict[str, Any], *_: Any) -> Candidate:
        size = float(values["loads.F.value"])
        sizes.append(size)
        if size > 500:
            raise Unfit("it is too large")
        some = tuple(f._replace(value=f.value * size / 100) for f in right.figures)
        return Candidate(values, m, right.result, some, {})

    monkeypatch.setattr(drawing, "candidate", candidate)
    return sizes


REACTION = da.Answer(quantity="reaction", of="O", on="arm")


def drawn(values: list[float], count: int, **more: Any) -> Any:
    m = bracket(value=100, direction="30 deg").with_values({"title": "An arm"})
    return da.variants(m, {"loads.F.value": values}, count=count, seed=4, ask=["reaction.O"], **more)


def apart(count: int, first: float = 10.0) -> list[float]:
    return [first * 1.02**k for k in range(count)]


def test_no_more_sets_are_tried_than_are_needed(tried: list[float]) -> None:
    some = drawn(apart(60), 3)
    assert [v.values["loads.F.value"] for v in some] == tried
    assert len(tried) == 3


@pytest.mark.parametrize(("count", "possible", "tries"), [(1, 60, 20), (2, 60, 40), (4, 60, 60)])
def test_twenty_sets_are_tried_for_each_variant(
    count: int, possible: int, tries: int, tried: list[float]
) -> None:
    said = (
        f"0 of {count} variants were drawn from {tries} sets of values, of {possible} possible ones; rejected: "
        f"{tries} where it is too large; give other values, or ask for fewer"
    )
    with pytest.raises(da.ModelError) as refused:
        drawn(apart(possible, 501.0), count)
    assert str(refused.value) == said
    assert len(set(tried)) == tries


def test_all_possible_sets_may_be_needed(tried: list[float]) -> None:
    assert len(drawn(apart(5), 5)) == 5
    with pytest.raises(
        da.ModelError, match=r"^the values allow 5 different problems, but 6 are requested; give more"
    ):
        drawn(apart(5), 6)


@pytest.mark.parametrize(("count", "first", "last"), [(9, "01", "09"), (99, "01", "99"), (100, "001", "100")])
def test_names_have_two_digits_and_more_where_there_are_more(
    count: int, first: str, last: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drawing, "candidate", lambda m, values, *_: values)
    monkeypatch.setattr(drawing._Pool, "sound", lambda pool, _: pool.tried)
    monkeypatch.setattr(drawing, "_variant", lambda name, c, questions, tolerance: (name, c))
    some = drawn(apart(120), count)
    assert (some[0][0], some[-1][0], len(some), some.seed) == (first, last, count, 4)
    assert some.asked == (REACTION,)
    assert [name for name, _ in some[1:3]] == [f"{k:0{len(first)}}" for k in (2, 3)]


@pytest.mark.usefixtures("tried")
def test_a_tolerance_is_in_the_key_and_not_in_the_answers_of_the_problem() -> None:
    for stated in ("3 %", ""):
        (one,) = drawn(apart(5), 1, tolerance=stated)
        assert one.key[0].get("tolerance", "") == stated
        (answer,) = one.mechanism.answers
        assert (answer.quantity, answer.of, answer.on, answer.tolerance) == ("reaction", "O", "arm", None)
        size = float(one.values["loads.F.value"])
        assert str(answer.value).endswith(" @ -150.0 N")
        assert float(str(answer.value).partition(" ")[0]) == pytest.approx(size)


def test_the_tolerance_decides_which_figures_are_the_same(tried: list[float]) -> None:
    """100 and 102 N are one problem to 3 %, and two to 1 %."""
    assert len(drawn([100.0, 102.0], 2, tolerance="1 %")) == 2
    with pytest.raises(da.ModelError, match="rejected: 1 where the figures are those of another one"):
        drawn([100.0, 102.0], 2, tolerance="3 %")
    assert len(tried) == 4


class Sheet:
    """Writes into its file what it was made of."""

    def __init__(self, *made_of: Any) -> None:
        self.text, self.sheet = " ".join(map(str, made_of)), ReportSheet(str(made_of[-1]))

    def save(self, path: Path) -> None:
        path.write_text(self.text, encoding="utf-8")


@pytest.fixture
def plain_sheets(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sheets without what makes them take time."""
    made = {
        "question_sheet": lambda r, asked, name, exam: Sheet("question", len(asked), exam.course, name),
        "solution_sheet": lambda r, asked, name: Sheet("solution", len(asked), name),
        "key_sheet": lambda r, values, asked, exam: Sheet(
            "key", *values, *map(len, values.values()), exam.text
        ),
        "typst_bytes": lambda first, kind, *rest: " ".join(
            [kind, first.title, *(s.title for s in rest)]
        ).encode(),
    }
    for name, function in made.items():
        monkeypatch.setattr(exam_folder, name, function)


@pytest.mark.usefixtures("tried", "plain_sheets")
def test_a_folder_has_problems_questions_blank_tables_solutions_and_keys(tmp_path: Path) -> None:
    out = tmp_path / "exam"
    some = drawn([100.0, 150.0], 2)
    some.save(out, course="ME 301", text="Read all.", marks={"reaction.O": 2.5})
    one, two = (float(v.values["loads.F.value"]) for v in some)
    names = sorted(str(p.relative_to(out)) for p in out.rglob("*") if p.is_file())
    parts = {
        "answers": ["csv"],
        "problems": ["yaml"],
        "questions": ["html", "pdf"],
        "solutions": ["html", "pdf"],
    }
    files = [f"{part}/{n}.{end}" for part, ends in parts.items() for n in ("01", "02") for end in ends]
    assert names == sorted([*files, "key.csv", "key.json", "key.pdf", "questions.pdf", "variants.json"])
    assert (out / "questions.pdf").read_text() == "pdf 01 02"
    assert (out / "key.pdf").read_text() == "key 01 02 1 1 Read all."
    assert (out / "questions" / "02.html").read_text() == "question 1 ME 301 02"
    assert (out / "solutions" / "01.pdf").read_text() == "solution 1 01"
    blank = (out / "answers" / "02.csv").read_text(encoding="utf-8")
    assert blank == "variant,quantity,of,on,at,extreme,component,axes,value,unit\n02,reaction,O,arm,,,,,,N\n"
    rows = list(csv.DictReader((out / "key.csv").read_text(encoding="utf-8").splitlines()))
    heads = "variant,file,quantity,of,on,by,at,extreme,component,axes,value,unit,tolerance,marks"
    assert ",".join(rows[0]) == heads
    assert [{k: v for k, v in row.items() if v} for row in rows] == [
        {"variant": name, "file": f"problems/{name}.yaml", "quantity": "reaction", "of": "O", "on": "arm",
         "value": f"{size} @ -150.0", "unit": "N", "marks": "2.5"}
        for name, size in (("01", one), ("02", two))
    ]  # fmt: skip
    assert json.loads((out / "key.json").read_text(encoding="utf-8"))[1] == {
        k: (2.5 if k == "marks" else v) for k, v in rows[1].items() if v
    }
    record = (out / "variants.json").read_text(encoding="utf-8")
    assert json.loads(record) == {
        "title": "An arm",
        "seed": 4,
        "asked": ["reaction of O on arm"],
        "variants": {"01": {"loads.F.value": one}, "02": {"loads.F.value": two}},
    }
    assert record.endswith("}\n")
    for v in some:
        assert da.load(out / "problems" / f"{v.name}.yaml").answers == v.mechanism.answers


@pytest.mark.usefixtures("tried", "plain_sheets")
def test_a_key_without_marks_has_no_column_of_them_filled_in(tmp_path: Path) -> None:
    drawn([100.0, 150.0], 1).save(tmp_path / "exam")
    (row,) = json.loads((tmp_path / "exam" / "key.json").read_text(encoding="utf-8"))
    assert "marks" not in row
    assert (tmp_path / "exam" / "key.pdf").read_text() == "key 01 1 "


def test_marks_of_a_question_are_those_of_its_name_before_those_of_its_quantity() -> None:
    asked = da.Answer(quantity="speed", of="rocker")
    marks = {"angle.rocker.speed": 1, "speed.rocker": 2, "speed": 3, "default": 4}
    for worth, name in enumerate(list(marks), 1):
        assert ExamText(marks=marks).marks_of(asked) == worth
        del marks[name]
    assert ExamText(marks={"effort": 4}).marks_of(asked) is None


@pytest.mark.parametrize(
    ("course", "name", "line"),
    [
        ("ME 301", "07", "ME 301 · Variant 07"),
        ("ME 301", "", "ME 301"),
        ("", "07", "Variant 07"),
        ("", "", ""),
    ],
)
def test_the_line_under_the_title_names_course_and_variant(course: str, name: str, line: str) -> None:
    assert ExamText(course).subtitle(name) == line


@pytest.mark.parametrize(
    ("values", "off"), [([12.0, 9.5], 0.05), ([9.5, 12.0], 0.05), ([], math.inf), ([12.0], 0.2)]
)
def test_of_two_values_of_a_wrong_problem_the_nearer_one_hides_the_mistake(
    values: list[float], off: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(candidates, "values_of", lambda *_: (tuple(map(np.array, values)), False))
    right = ExpectedValue("force", np.array(10.0))
    problem: Any = None
    assert candidates._change(problem, REACTION, right, 0) == pytest.approx(off)


def test_a_wrong_problem_without_a_figure_is_as_far_off_as_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: Any) -> Any:
        raise IndexError

    monkeypatch.setattr(candidates, "values_of", none)
    problem: Any = None
    assert candidates._change(problem, REACTION, ExpectedValue("force", np.array(10.0)), 0) == math.inf
