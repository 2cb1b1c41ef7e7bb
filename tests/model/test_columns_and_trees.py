"""Columns of files with their heads and lines, trees of texts, sums of quantities: what is read and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model.files import yaml_text
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.column_files import read_columns
from dalembert.model.quantities.figures import in_stated_unit, polar_units, si_quantity, with_kept_unit
from dalembert.model.quantities.written_tables import table
from dalembert.units import Units

TEXT = "# measured\nangle [deg],pressure [bar],pressure [MPa],note\n0,1,0.1,5\n\n90,2.5,0.25,6\n180,3,0.3,7\n"


def columns(folder: Path, text: str | bytes, *wanted: str | int) -> Any:
    (folder / "p.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_columns("p.csv", wanted, ReadingRules(folder=str(folder)))


def refused(folder: Path, text: str | bytes, *wanted: str | int) -> tuple[str, int | None]:
    with pytest.raises(ModelError) as caught:
        columns(folder, text, *wanted)
    return f"{caught.value.what}; {caught.value.remedy}", caught.value.line


def test_columns_by_name_and_by_number(tmp_path: Path) -> None:
    angle, note, second = columns(tmp_path, TEXT, "angle", "note", 2)
    assert (angle.name, angle.unit, angle.head, angle.values, angle.lines) == (
        "angle",
        "deg",
        2,
        (0, 90, 180),
        (3, 5, 6),
    )
    assert (note.name, note.unit, note.values) == ("note", "", (5, 6, 7))
    assert (second.name, second.unit, second.values) == ("pressure", "bar", (1, 2.5, 3))
    first, last = columns(tmp_path, "0 \u22121\n1 2e3\n", 1, 2)
    assert (first.name, first.head, first.values, last.values, last.lines) == (
        "",
        1,
        (0, 1),
        (-1, 2000),
        (1, 2),
    )
    (below,) = columns(tmp_path, "a;b\n[deg];(bar)\n1,5;2\n3;4,25\n", "b")
    assert (below.unit, below.values, below.lines) == ("bar", (2, 4.25), (3, 4))


@pytest.mark.parametrize(
    ("text", "wanted", "says", "line"),
    [
        (TEXT, ("angel",), "the column 'angel' is not in its head; did you mean 'angle'?", 2),
        (TEXT, ("pressure",), "the column 'pressure' is twice in its head; write its number, from 1 to 4", 2),
        (TEXT, (0,), "the column 0 is not in its head; choose among angle, pressure, pressure, note", 2),
        (TEXT, (5,), "the column 5 is not in its head; choose among angle, pressure, pressure, note", 2),
        ("1,2\n3,4\n", (3,), "the column 3 is not in its head; write its number, from 1 to 2", 1),
        ("1,2\n3,4\n", ("a",), "the column 'a' is not in its head; write its number, from 1 to 2", 1),
        (
            "a,b\nnan,bar\n1,2\n",
            ("a",),
            "'nan' in column 'a' is not a finite number; correct it, or take the row out",
            2,
        ),
        (
            "a,b\n1,2\n\n3,x\n",
            ("b",),
            "'x' in column 'b' is not a finite number; correct it, or take the row out",
            4,
        ),
        ("1,2\n3,1e999\n", (2,), "'1e999' is not a finite number; correct it, or take the row out", 2),
        ("a,b\n1,2\n3\n", ("a",), "1 columns where the first row has 2; give every row the same", 3),
        ("a,b\n1,2,3\n", ("a",), "3 columns where the first row has 2; give every row the same", 2),
        ('a,b\n1,2\n"3,4\n', ("a",), "it cannot be read: unexpected end of data; close its quotes", 3),
        ("# a\n\n", ("a",), "it has no rows; give it a head and one row for each point", 1),
        (b"a,b\n1,2\n\x003,4\n", ("a",), "not UTF-8 text; save it as text, CSV UTF-8", 3),
        (b"a,b\n1,2\n3,4\xff\n", ("a",), "not UTF-8 text; save it as text, CSV UTF-8", 3),
    ],
)
def test_columns_that_cannot_be_read(
    tmp_path: Path, text: str | bytes, wanted: tuple[str | int, ...], says: str, line: int
) -> None:
    what, where = refused(tmp_path, text, *wanted)
    assert what.startswith(says)
    assert where == line


RULES = ReadingRules(Units(), freedoms={"O": "turn"})


def of_file(folder: Path, text: str, **keys: Any) -> Any:
    (folder / "p.csv").write_text(text, encoding="utf-8")
    rules = ReadingRules(Units(), freedoms={"O": "turn"}, folder=str(folder))
    return table({"file": "p.csv", **keys}, "force", rules)


def test_a_table_of_a_file(tmp_path: Path) -> None:
    text = "angle [deg],force [kN]\n0,1\n90,2.5\n"
    made = of_file(tmp_path, text)
    assert (made.against, made.y) == ("O", (1000.0, 2500.0))
    assert made.x == pytest.approx((0, 1.5707963267948966), rel=1e-15)
    assert of_file(tmp_path, "0,1\n90,2.5\n", units=["deg", "kN"]) == made
    assert of_file(tmp_path, "0,1\n90,2.5\n", units=["", "kN"]) == made
    assert (
        of_file(
            tmp_path,
            text.replace("angle [deg],force [kN]", "force [kN],angle [deg]").replace(
                "0,1\n90,2.5", "1,0\n2.5,90"
            ),
            columns=["angle", "force"],
        )
        == made
    )


@pytest.mark.parametrize(
    ("text", "keys", "says", "line"),
    [
        (
            "a [deg],f [N]\n0,1\n\n5,2\n5,3\n",
            {},
            "x of a table does not increase from its item 2 to 3; sort",
            5,
        ),
        ("a [deg],f [N]\n5,1\n\n0,2\n", {}, "x of a table does not increase from its item 1 to 2; sort", 4),
        ("a [deg],f [N]\n\n0,1\n", {}, "a table has too few points: 1; give at least 2", 3),
        (
            "a [deg],f [N]\n0,1\n9,2\n",
            {"units": ["deg", "kN"]},
            "the head of column 2 says 'N', and units 'kN'; leave one of them out",
            None,
        ),
        (
            "a [deg],f [N]\n0,1\n9,2\n",
            {"units": ["deg"]},
            "expected two units, not a list; write units: [deg, bar]",
            None,
        ),
        (
            "a [deg],f [N]\n0,1\n9,2\n",
            {"columns": "a"},
            "expected two columns, not 'a'; write columns: [angle, pressure]",
            None,
        ),
        ("a [deg],f [N]\n0,1\n9,2\n", {"y": [1]}, "both file and y are given; leave one of them out", None),
        (
            "a [deg],f [N]\n0,1\n9,2\n",
            {"periodic": "5 deg"},
            "a periodic table goes over 9 deg and repeats after 5 deg; leave out",
            None,
        ),
    ],
)
def test_a_table_of_a_file_that_cannot_be(
    tmp_path: Path, text: str, keys: dict[str, Any], says: str, line: int | None
) -> None:
    with pytest.raises(ModelError) as caught:
        of_file(tmp_path, text, **keys)
    assert f"{caught.value.what}; {caught.value.remedy}".startswith(says)
    assert caught.value.line == (line or 0)


def test_a_tree_is_read_anew_each_time() -> None:
    text = "a: {b: [1, 2]}\nc: 0x1F\nd: 0o17\ne: .5\nf: -1.5e3\ng: TRUE\nh: ~\ni: '1'\n"
    tree: Any = yaml_text.read(text)[0]
    assert tree == {
        "a": {"b": [1, 2]},
        "c": 31,
        "d": 15,
        "e": 0.5,
        "f": -1500.0,
        "g": True,
        "h": None,
        "i": "1",
    }
    tree["a"]["b"].append(3)
    again, lines = yaml_text.read(text)
    assert again["a"]["b"] == [1, 2]  # type: ignore[index]
    assert [lines[path] for path in (("a",), ("c",), ("i",))] == [1, 2, 8]


def test_words_that_are_too_long_for_a_file() -> None:
    long = "a: 1\nb: !" + "x" * 2000 + " 2\n"
    with pytest.raises(
        ModelError, match="is longer than any word of a model file; put text in quotes"
    ) as caught:
        yaml_text.read(long)
    assert caught.value.line == 2


@pytest.mark.parametrize(
    ("text", "kind", "number"),
    [
        ("3 mm + 2 mm*(1 rad)", "length", 0.005),
        ("2*(3 mm - 1 cm)", "length", -0.014),
        ("(4 m)^2/(2 m)", "length", 8.0),
        ("30 deg + 0.5 rad", "angle", 0.5 + 0.5235987755982988),
        ("3 N*2 mm", "moment", 0.006),
        ("6 m/2 s", "speed", 3.0),
    ],
)
def test_a_quantity_of_quantities(text: str, kind: str, number: float) -> None:
    assert ReadingRules().quantity(text, kind) == pytest.approx(number, rel=1e-14)


@pytest.mark.parametrize("text", ["3 mm + 2 s", "3 mm - 2 N", "3 mm*2 m"])
def test_a_sum_of_unlike_quantities(text: str) -> None:
    with pytest.raises(ModelError, match=r"cannot be evaluated|but a length is needed"):
        ReadingRules().quantity(text, "length")


def test_numbers_in_the_units_of_their_old_texts() -> None:
    units = Units(length="in")
    assert with_kept_unit(0.075, "length", " 60mm ", units) == " 75mm "
    assert with_kept_unit(0.0254, "length", "2", units) == "1"
    assert with_kept_unit(0.5, "length", "3 kg", units) is None
    assert with_kept_unit(0.5, "length", "two", units) is None
    assert in_stated_unit(0.5, "length", "mm", units) == "500 mm"
    assert in_stated_unit(0.3, "length", "", units) == "0.3 m"
    assert polar_units("3 mm @ 30 deg", "length", units) == ("mm", "deg")
    assert polar_units("3 @ 30", "length", units) == ("", "")
    assert polar_units("3 @ 30 mm", "length", units) == ("mm", "")
    assert si_quantity("0.127 m") == (0.127, "length")
    assert si_quantity("-3.5 rad/s") == (-3.5, "angular_speed")
    assert [si_quantity(x) for x in ("0.127 mm", "x m", 3.0, "3")] == [None] * 4
