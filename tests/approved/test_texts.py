"""Worked solutions, sheets, reports and workbooks as they were read: words and numbers.

A file of `texts/` for each; numbers may differ by one in their last digit. `python -m tests.approved.test_texts` writes
those anew that have changed; read the difference before it is committed. Whether the numbers are right is tested
elsewhere.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Iterable, Iterator
from itertools import zip_longest
from pathlib import Path
from typing import Any

import openpyxl
import pytest

import dalembert as da
from dalembert.exams.question_sheet import ExamText, question_sheet
from dalembert.machine.members.member_table import member_table
from dalembert.model.library import TEMPLATES
from tests.answers.every_answer import made
from tests.approved.commands import COMMANDS
from tests.approved.design_parts import DESIGNED
from tests.approved.foreign_files import FOREIGN
from tests.approved.gestures import GESTURES
from tests.approved.printed import PRINTED
from tests.approved.read_out import READ, model
from tests.approved.simulated import MOVED
from tests.approved.worked import WORKED_OUT
from tests.tiers import tiers

TEXTS = Path(__file__).with_name("texts")
ROUNDING = re.compile(
    r"\b\d(?:\.\d+)?e[-−][1-9]\d{1,2}(?!\d)|(?<=within )0(?![\d.])"
    r"|(?<=Date)[ ]+\d{4}-\d\d-\d\d|[\d.]+ s of core time"
    r"|Out-of-balance force.*?(?=\n\n|\Z)",
    re.M | re.S,
)
"""What only rounding, the day or the machine makes: the checks, the date of a design report, the time of a study."""
NUMBER = re.compile(r"(?<![\w.])[-−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")


def worked(name: str, **options: Any) -> Callable[[], str]:
    return lambda: str(da.report(da.solve(model(name)), **options))


def designed(name: str) -> Callable[[], str]:
    return lambda: str(da.report(da.solve(model(name)), design=True))


def of_template(template: str) -> Callable[[], str]:
    return lambda: str(da.report(da.solve(getattr(da, template)())))


def in_latex(name: str) -> Callable[[], str]:
    """Formulas as LaTeX; the drawings, whose numbers are places on paper, are left out."""
    text = "tikzpicture"

    def written() -> str:
        tex = da.report(da.solve(model(name))).to_bytes("tex").decode()
        return re.sub(rf"\\begin{{{text}}}.*?\\end{{{text}}}", f"[{text}]", tex, flags=re.DOTALL)

    return written


def asked() -> str:
    exam = ExamText("ME 301", "Take g from the sheet.", {"effort.O2": 4, "default": 1})
    r = da.solve(model("four_bar"))
    questions = [da.Answer(quantity="effort", of="O2"), da.Answer(quantity="reaction", of="A", on="coupler")]
    return str(question_sheet(r, questions, "07", exam=exam))


def answered(call: Callable[[Any], Any], name: str = "four_bar", **options: Any) -> Callable[[], str]:
    return lambda: str(da.report(call(da.dynamics(model(name), **options))))


def studied() -> str:
    vary = {"links.coupler.weight": "± 10 %", "loads.T_4.value": "± 5 %"}
    study = da.study(model("four_bar"), vary, ["effort.O2", "reaction.A.magnitude"], designs=500, seed=3)
    return str(da.report(study.run()))


def in_cells() -> str:
    """The cells of a workbook, and of its charts the titles, axes and ranges."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "answer.xlsx"
        da.dynamics(model("quick_return"), positions=9).save(path)
        book = openpyxl.load_workbook(path)
        return "\n".join(line for sheet in book for line in cells(sheet))


def cells(sheet: Any) -> Iterator[str]:
    yield f"sheet {sheet.title}"
    for row in sheet.iter_rows(values_only=True):
        yield " | ".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in row if v is not None)
    for chart in sheet._charts:
        ranges = ", ".join(
            s.val.numRef.f if hasattr(s, "val") and s.val else s.yVal.numRef.f for s in chart.series
        )
        ends = [getattr(a.scaling, k) for a in (chart.x_axis, chart.y_axis) for k in ("min", "max")]
        yield f"chart of {ranges}; axes {' '.join('-' if x is None else f'{x:.5g}' for x in ends)}"


WORKED = (
    *("seed-002-7a-engine-friction-circles", "seed-002-7d-engine-at-rest", "seed-002-7gb-engine-guide-10-mm"),
    *("seed-f-4b-superposition-together", "st-06-slider-crank-40n", "sp-12-spatial-slider-crank", "pump"),
    *(
        "vw-02-drum-with-spring-and-weight",
        "gtr-3-compound-epicyclic-train",
        "gov-12-porter-governor-with-friction",
    ),
    *("quick_return", "gear_train", "truss", "brk-7-four-long-shoes", "cam-4-flat-follower-on-an-eccentric"),
)
LOOSE = "bennett", "rccc", "spherical_four_bar"
"""Overconstrained in space: a step may take another of several directions, by rounding."""
TEXT: dict[str, Callable[[], str]] = {
    **{f"solution-{n}": worked(n) for n in WORKED},
    **WORKED_OUT,
    **{f"template-{t}": of_template(t) for t in TEMPLATES if t not in LOOSE},
    **{f"latex-{n}": in_latex(n) for n in ("four_bar", "rssr")},
    "question-four_bar": asked,
    "design-toggle_press": designed("toggle_press"),
    "design-quick_return": designed("quick_return"),
    **{f"design-{n}": call for n, call in DESIGNED.items()},
    "shaking": answered(da.shaking, positions=24),
    "balance": answered(lambda r: da.balance(r, ["crank", "rocker"]), positions=24),
    "flywheel": answered(lambda r: da.flywheel(r, Cs=0.02), "fw-04-flywheel-of-a-double-acting-engine"),
    "members": answered(member_table, positions=12),
    "rotor": lambda: str(da.report(made("RotorBalance"))),
    "study": studied,
    "workbook": in_cells,
    **READ,
    **FOREIGN,
    **MOVED,
    **GESTURES,
    **COMMANDS,
    **PRINTED,
}


def unlike(was: str, now: str) -> list[str]:
    """Lines that say something else, as they were and as they are; numbers may differ by one in their last digit."""
    lines = [ROUNDING.sub("~", text).splitlines() for text in (was, now)]
    pairs = zip_longest(*lines, fillvalue="")
    return [f"- {a}\n+ {b}" for a, b in pairs if a != b and not alike(a, b)]


def alike(a: str, b: str) -> bool:
    numbers = [NUMBER.findall(line) for line in (a, b)]
    words = [re.sub(" +", " ", NUMBER.sub("#", re.sub("--+", "--", line))) for line in (a, b)]
    return words[0] == words[1] and all(map(near, *numbers))


def near(a: str, b: str) -> bool:
    """True if two printed numbers differ by one in the last digit at most.

    >>> near("3.142", "3.143"), near("3.142", "3.144"), near("-2", "2"), near("1.00e-5", "1.01e-5")
    (True, False, False, True)
    """
    x, y = (float(t.replace("−", "-")) for t in (a, b))
    digits, _, power = a.partition("e")
    last = 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
    whole = "." not in digits and not power and a.lstrip("-−").endswith("0")
    return abs(x - y) <= (1e-3 * abs(x) if whole else 1.01 * last)


def changed(name: str) -> list[str]:
    """What a text says otherwise than when it was read."""
    return unlike((TEXTS / f"{name}.txt").read_text(encoding="utf-8"), TEXT[name]())


GROUPS = (
    *("solution-", "template-", "design-", "simulated-", "answer-", "fields-"),
    *("wrong-", "cases-", "printed-", "element-", "troubled-"),
)


SLOW = {
    *("commands-documents", "commands-machines", "simulated-dome", "fields-mistakes", "wrong-quick-return"),
    *("solution-rough-joints", "template-bevel_differential", "design-cam", "design-start-up"),
    *[f"template-{t}" for t in TEMPLATES][::2],
}
"""Whose tests are long: those over a second, every other template's, and one that prints how far rounding has grown."""


def named(names: Iterable[str]) -> Any:
    some = list(names)
    quick, long = [n for n in some if n not in SLOW], [n for n in some if n in SLOW]
    return pytest.mark.parametrize("name", tiers(quick, long))


def texts_of(*groups: str) -> Any:
    return named(n for n in TEXT if n.startswith(groups))


@texts_of("solution-")
def test_solutions_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("template-")
def test_solutions_of_templates_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("design-")
def test_design_reports_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("simulated-")
def test_motions_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("answer-")
def test_answers_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("fields-")
def test_fields_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("wrong-")
def test_wrong_problems_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("cases-")
def test_printed_cases_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("printed-")
def test_printed_linkages_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("element-")
def test_printed_elements_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@texts_of("troubled-")
def test_printed_troubles_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


@named(n for n in TEXT if not n.startswith(GROUPS))
def test_texts_are_as_they_were_read(name: str) -> None:
    assert changed(name) == []


def test_another_word_or_number_is_seen() -> None:
    assert unlike("F = 3.142 N", "F = 3.143 N") == []
    assert unlike("F = 3.142 N", "F = 3.152 N") == ["- F = 3.142 N\n+ F = 3.152 N"]
    assert unlike("F = 3.142 N", "G = 3.142 N") != []
    assert unlike("a\nb", "a") == ["- b\n+ "]


if __name__ == "__main__":
    TEXTS.mkdir(exist_ok=True)
    for name, text in TEXT.items():
        path, now = TEXTS / f"{name}.txt", text()
        was = path.read_text(encoding="utf-8") if path.exists() else ""
        if unlike(was, now):
            path.write_text(now, encoding="utf-8", newline="\n")
            print(f"written: {path.name}")
