"""How a written figure was read: its name and notes, numbers with marks of thousands, units, and names of figures."""

from __future__ import annotations

import re
from typing import Any

import pytest

import dalembert as da
from dalembert.grading.marking.figure_names import FigureNames, columns_of, unit_of
from dalembert.grading.written_figure import decimal_comma, number, read_written, readings_of, written_unit

ABOUT, TURNED = "written as about", "its angle is counted clockwise"
OPPOSITE, BOTH = "a negative size is read as the opposite direction", "it has a sign and a sense"


@pytest.mark.parametrize(
    ("text", "readings", "name", "notes"),
    [
        ("155 @ 40 cw", ["155 @ -40"], "", [TURNED]),
        ("155 @ -40 deg clockwise", ["155 @ 40 deg"], "", [TURNED]),
        ("155 @ 40 ccw", ["155 @ 40"], "", []),
        ("-559 @ 119.5", ["559 @ 299.5"], "", [OPPOSITE]),
        ("~ -5 N @ 30 deg cw", ["5 N @ 150 deg"], "", [ABOUT, TURNED, OPPOSITE]),
        ("-559 @ 1 rad cw", ["559 @ 2.14159265358979 rad"], "", [TURNED, OPPOSITE]),
        ("-1,234 @ 20", ["1.234 @ 200", "1234 @ 200"], "", [OPPOSITE]),
        ("-44.2 cw", ["-44.2", "44.2"], "", [BOTH]),
        ("-44.2 counter-clockwise", ["-44.2", "44.2"], "", [BOTH]),
        ("+44.2 cw", ["-44.2"], "", []),
        ("44.2 anti-clockwise", ["44.2"], "", []),
        ("44.2 acw", ["44.2"], "", []),
        ("44.2 \u21ba", ["44.2"], "", []),
        ("44.2, clockwise.", ["-44.2"], "", []),
        ("1,234 cw", ["-1.234", "-1234"], "", []),
        ("approx. 31.5 N", ["31.5 N"], "", [ABOUT]),
        ("T12 = about 33.9 Nm", ["33.9 N*m"], "T12", [ABOUT]),
        ("M: -33.9", ["-33.9"], "M", []),
        ("Fx = 3 N; Fy = -4 N", [["3 N", "-4 N"]], "", []),
        ("[1, 2] kN", [["1 kN", "2 kN"]], "", []),
        ("[1; 2 N; 3 kN]", [["1 kN", "2 N", "3 kN"]], "", []),
        ("(1.5 | 2 N)", [["1.5 N", "2 N"]], "", []),
        ("{3; 4} N", [["3 N", "4 N"]], "", []),
        ("1 i - 2 j + 3 k N", [["1 N", "- 2 N", "3 N"]], "", []),
        ("[1,234; 5]", [["1.234", "5"], ["1234", "5"]], "", []),
        ("1; 2; 3; 4", [], "", []),
        ("[3; 4] cw", [], "", []),
        ("155 @ 40 deg N", ["155 N @ 40 deg"], "", []),
        ("155 @ 40 N deg", ["155 N @ 40 deg"], "", []),
        ("155 @ 40\u00b0 N \u00b0", [], "", []),
        ("155 @ 2 radians", ["155 @ 2 rad"], "", []),
        ("'155'", ["155"], "", []),
        ("9" * 200, ["9" * 200], "", []),
        ("9" * 201, [], "", []),
    ],
)
def test_a_cell_is_read_with_its_name_and_the_notes_on_how(
    text: str, readings: list[Any], name: str, notes: list[str]
) -> None:
    found = read_written(text)
    said = [[x.replace("- ", "-") for x in r] if isinstance(r, list) else r for r in found.readings]
    known = [[x.replace("- ", "-") for x in r] if isinstance(r, list) else r for r in readings]
    assert (said, found.name, list(found.notes), found.blank) == (known, name, notes, False)


@pytest.mark.parametrize(
    ("text", "comma", "values"),
    [
        ("1,234", None, ("1.234", "1234")),
        ("1,234", True, ("1.234",)),
        ("1,234", False, ("1234", "1.234")),
        ("1.234", None, ("1.234",)),
        ("1.234", True, ("1234", "1.234")),
        ("1.234", False, ("1.234",)),
        ("-123,456", None, ("-123.456", "-123456")),
        ("+123,456", None, ("+123.456", "+123456")),
        ("0,123", None, ("0.123",)),
        ("1234,567", None, ("1234.567",)),
        ("1,2345", False, ("1.2345",)),
        ("1,23", False, ("1.23",)),
        (",5", None, (".5",)),
        ("12.", None, ("12",)),
        ("1.234.567", None, ("1234567",)),
        ("1,234,567.85", None, ("1234567.85",)),
        ("1.234.567,85", None, ("1234567.85",)),
        ("-12,345.6", None, ("-12345.6",)),
        ("1'234'567,5", None, ("1234567.5",)),
        ("12 345", None, ("12345",)),
        ("1 234 567.5", None, ("1234567.5",)),
        ("1.5*10^-3", None, ("1.5e-3",)),
        ("2,5 x 10^(4)", None, ("2.5e4",)),
        ("1.5E3", None, ("1.5e3",)),
        ("1,234e2", None, ("1.234e2", "1234e2")),
    ],
)
def test_a_number_has_one_value_or_two(text: str, comma: bool | None, values: tuple[str, ...]) -> None:
    assert number(text, comma) == values


@pytest.mark.parametrize(
    "text", ["1 23", "12 34 567", "1.234.56", "1,23,456", "1234,567.8", "1.234,567,8", "1e400"]
)
def test_a_number_with_marks_at_no_thousands_is_none(text: str) -> None:
    with pytest.raises(ValueError, match=re.escape(text)) as refused:
        number(text)
    assert text.startswith(str(refused.value))


@pytest.mark.parametrize(
    ("cells", "comma"),
    [
        (["41,03", "344,6 @ -164,8"], True),
        (["41.03", "1,234"], False),
        (["0,123"], True),
        (["0.123", 7], False),
        (["1,2345"], True),
        (["1.2345", "1,25"], None),
        (["1.25", "1,25", "2,5"], True),
        (["1.25", "1,25", "2.5"], False),
        (["1.234,5"], None),
        (["12", "1,234", "1.234"], None),
        ([], None),
    ],
)
def test_the_marks_of_most_cells_with_one_reading_tell(cells: list[object], comma: bool | None) -> None:
    assert decimal_comma(cells) is comma


@pytest.mark.parametrize(
    ("value", "comma", "readings"),
    [
        ("1.234 N", None, ["1.234 N"]),
        ("1.234 N", True, ["1234 N", "1.234 N"]),
        ("1.2345 N", True, ["1.2345 N"]),
        ("155 lbf @ 220 deg", None, ["155 lbf @ 220 deg"]),
        ("-155 lbf @ 220 deg", None, ["155 lbf @ 400 deg"]),
        ("5 apples", None, []),
        ("5 .", None, ["5"]),
        (-7.5, None, [-7.5]),
        (["1,5 N", 2], None, [["1.5 N", 2]]),
        (["1,234", 2], None, []),
        (["1,234", 2], True, [["1.234", 2]]),
        (["about", 2], None, []),
    ],
)
def test_what_a_model_file_may_hold_stays_as_it_is(
    value: Any, comma: bool | None, readings: list[Any]
) -> None:
    assert list(readings_of(value, comma).readings) == readings


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("kN", "kN"), ("Nm", "N*m"), ("N m", "N*m"), ("N\u00b7mm", "N*mm"), ("kNm", "kN*m"), ("lb", "lbf"),
        ("lbs", "lbf"), ("in-lb", "in*lbf"), ("ft lb", "ft*lbf"), ("lb ft", "lbf*ft"), ("deg/s", "deg/s"),
        ("W", "W"), ("rpm", "rpm"), ("m/s^2", "m/s^2"), ("rad/s^2", "rad/s^2"), ("mm.", "mm"), ("kg", ""),
        ("s", ""), ("", ""), ("apples", ""), ("Pa", ""),
    ],
)  # fmt: skip
def test_a_unit_is_one_of_what_figures_are_of(text: str, unit: str) -> None:
    assert written_unit(text) == unit


FORCE_A, EFFORT = {"quantity": "reaction", "of": "A"}, {"quantity": "effort", "of": "O2"}
JOINTS = {"O2": ("ground", "crank"), "A": ("crank", "coupler"), "B": ("coupler", "rocker")}
FOUR_BAR = FigureNames(("ground", "crank", "coupler", "rocker"), JOINTS, {"O2": "O2"})
BARS = FigureNames(
    ("bar5", "ground", "bar3"), {"A": ("bar5", "bar3"), "O": ("ground", "bar5")}, {"motor": "O"}
)
PLACES = FigureNames(
    ("crank", "ground", "rod7"), {"A": ("crank", "rod7"), "O": ("ground", "crank")}, {"O": "O"}
)
TWICE = FigureNames(("ground", "arm"), {"A": ("ground", "arm"), "a": ("ground", "arm")}, {"M": "A", "N": "a"})


@pytest.mark.parametrize(
    ("names", "text", "keys"),
    [
        (BARS, "F53", FORCE_A | {"on": "bar3"}),
        (BARS, "F35", FORCE_A | {"on": "bar5"}),
        (BARS, "T15", {"quantity": "effort", "of": "motor"}),
        (BARS, "T53", None),
        (BARS, "F23", None),
        (PLACES, "F23", FORCE_A | {"on": "rod7"}),
        (PLACES, "F12", {"quantity": "reaction", "of": "O", "on": "crank"}),
        (PLACES, "T21", {"quantity": "effort", "of": "O"}),
        (TWICE, "F12", None),
        (TWICE, "T12", None),
        (TWICE, "Force at A", None),
        (TWICE, "torque", None),
        (TWICE, "torque at n", {"quantity": "effort", "of": "N"}),
        (FOUR_BAR, "torque", EFFORT),
        (FOUR_BAR, "Driving torque at o2", EFFORT),
        (FOUR_BAR, "moment of crank", None),
        (FOUR_BAR, "O2", None),  # its force or its effort
        (FOUR_BAR, "Force O2", {"quantity": "reaction", "of": "O2"}),
        (FOUR_BAR, "a", FORCE_A),
        (FOUR_BAR, "R_{A}", FORCE_A),
        (FOUR_BAR, "A size", FORCE_A | {"component": "magnitude"}),
        (FOUR_BAR, "A mag", FORCE_A | {"component": "magnitude"}),
        (FOUR_BAR, "A angle", FORCE_A | {"component": "direction"}),
        (FOUR_BAR, "A dir", FORCE_A | {"component": "direction"}),
        (FOUR_BAR, "A (y)", FORCE_A | {"component": "y"}),
        (FOUR_BAR, "A on the coupler", FORCE_A | {"on": "coupler"}),
        (FOUR_BAR, "A on the table", None),
        (FOUR_BAR, "T12 on crank", None),
        (FOUR_BAR, "Force at A, F12", None),
        (FOUR_BAR, "Force at A: F32", FORCE_A | {"on": "crank"}),
        (FOUR_BAR, "magnitude of the force at A", FORCE_A | {"component": "magnitude"}),
        (FOUR_BAR, "Force at A (kN)", FORCE_A),
        (FOUR_BAR, "mobility", {"quantity": "mobility"}),
        (FOUR_BAR, "effort.O2", EFFORT),
    ],
)
def test_a_name_means_one_figure_or_none(names: FigureNames, text: str, keys: dict[str, str] | None) -> None:
    assert names.keys(text) == keys


@pytest.mark.parametrize(
    ("asked", "keys"),
    [
        ({("reaction", "O2", None)}, {"quantity": "reaction", "of": "O2"}),
        ({("reaction", "O2", None), ("effort", "O2", None)}, None),
        ({("effort", "O2", None)}, None),
        ({("reaction", "A", None)}, None),
    ],
)
def test_a_name_of_a_joint_and_a_drive_is_that_which_alone_is_asked(
    asked: Any, keys: dict[str, str] | None
) -> None:
    assert FigureNames(FOUR_BAR.links, JOINTS, {"O2": "O2"}, frozenset(asked)).keys("O2") == keys


def test_the_names_of_a_problem_are_those_of_its_mechanism_or_of_its_questions() -> None:
    asked = [da.Answer(**EFFORT), da.Answer(quantity="reaction", of="A", component="x")]
    wanted = frozenset({("effort", "O2", None), ("reaction", "A", "x")})
    assert FigureNames.of(None, asked) == FigureNames((), {"A": ("", "")}, {"O2": ""}, wanted)
    m = da.four_bar(positions=1)
    found = FigureNames.of(m, asked)
    assert (found.links, found.drives, found.asked) == (tuple(m.links), {"O2": "O2"}, wanted)
    assert found.joints == {**JOINTS, "O4": tuple(m.joints["O4"].links)}


@pytest.mark.parametrize(
    ("head", "unit"),
    [
        ("Force at A (kN)", "kN"), ("T12 in N m", "N m"), ("F23 (size)", ""), ("T12 in lbf in.", "lbf in"),
        ("A (kN) (x)", ""), ("T12", ""), ("(3) T12 (N)", "N"),
    ],
)  # fmt: skip
def test_the_unit_of_a_heading_is_behind_its_words(head: str, unit: str) -> None:
    assert unit_of(head) == unit


@pytest.mark.parametrize(
    ("heads", "student", "variant"),
    [
        (["E-mail", "Name", "Version", "T12"], ("Name",), "Version"),
        (["E-mail", "T12"], ("E-mail",), None),
        (["Surname", "First name", "E-mail", "T12"], ("First name", "Surname"), None),
        (["Last name", "Set", "T12"], ("Last name",), "Set"),
        (["Timestamp", "T12"], (), None),
        (["Student ID", "Full name", "T12"], ("Full name",), None),
    ],
)
def test_a_student_is_named_by_first_name_and_surname_or_by_one_column(
    heads: list[str], student: tuple[str, ...], variant: str | None
) -> None:
    found = columns_of(heads, FOUR_BAR, {})
    assert (found.student, found.variant, found.figures) == (student, variant, {"T12": EFFORT})


def test_what_a_heading_means_may_be_said() -> None:
    found = columns_of(
        ["who", "4711: Response 1", "x"], FOUR_BAR, {"who": "student", "4711: Response 1": "F23", "x": "-"}
    )
    assert (found.student, found.variant) == (("who",), None)
    assert found.figures == {"4711: Response 1": FORCE_A | {"on": "coupler"}}
    assert columns_of(["4711: T12", "Q2. F23", "3) A"], FOUR_BAR, {}).figures.keys() == {
        "4711: T12",
        "Q2. F23",
        "3) A",
    }


ASKED = FigureNames(
    FOUR_BAR.links, JOINTS, {"O2": "O2"}, frozenset({("reaction", "A", "x"), ("effort", "O2", None)})
)


@pytest.mark.parametrize(
    ("heads", "given", "names", "said"),
    [
        (["who?", "T12"], {}, FOUR_BAR, "no figure is known by the heading 'who?'; "
         'write --columns "who?=effort.NAME", or "who?=-" to ignore it'),
        (["who?", "T12", "why?"], {}, ASKED,
         "no figure is known by the headings 'who?', 'why?'; asked are effort.O2, reaction.A.x; "
         'write --columns "who?=effort.O2", or "who?=-" to ignore it, --columns once for each heading'),
        (["Name", "Score"], {}, ASKED, "no column is a figure: 'Name', 'Score'; asked are effort.O2, reaction.A.x; "
         'write --columns "Name=effort.O2", or "Name=-" to ignore it'),
        (["Name", "T12"], {"T13": "T12"}, FOUR_BAR, "unknown column 'T13'; the columns are 'Name', 'T12'"),
    ],
)  # fmt: skip
def test_headings_that_say_nothing_are_refused_with_what_to_write(
    heads: list[str], given: dict[str, str], names: FigureNames, said: str
) -> None:
    with pytest.raises(da.ModelError) as refused:
        columns_of(heads, names, given)
    assert str(refused.value) == said
