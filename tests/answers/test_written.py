"""Every answer in every format that it has: written, read back, equal."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import openpyxl
import pytest
import xarray

import dalembert as da
from dalembert.answer.answer import Answer, Drawn, Labelled, Remade, Worked
from dalembert.answer.column import WORD, plain
from dalembert.errors import ModelError
from tests.answers.every_answer import MADE, made

ENDINGS = {".json", ".csv", ".xlsx", ".nc", ".svg", ".txt", ".yaml"}


def table(a: Answer, units: Any) -> tuple[list[str], list[list[Any]]]:
    """Heads and rows, from the columns alone."""
    to, some = a.scale(units), list(a.columns())
    parts = list(a.blocks(len(some[0].values)))
    columns = [
        plain([v for part in parts for v in np.asarray(to(c.kind, c.values[part])).tolist()]) for c in some
    ]
    numbers = [k + a.FIRST for part in parts for k in range(part.start, part.stop)]
    heads = [a.ROWS[:-1], *(f"{c.name} [{u}]" if (u := to.text(c.kind)) else c.name for c in some)]
    return heads, [list(row) for row in zip(numbers, *columns, strict=True)]


@pytest.mark.parametrize("name", [name for name in MADE if name != "CamDesign"])  # its CSV is its outline
def test_a_class_is_what_it_is_called_and_its_tables_are_its_columns(name: str, tmp_path: Path) -> None:
    a = made(name)
    assert type(a).__name__ == name
    heads, rows = table(a, "file")
    assert len(rows) > 1
    a.save(tmp_path / "a.csv")
    with open(tmp_path / "a.csv", encoding="utf-8", newline="") as file:
        first, *read = csv.reader(file)
    assert first == heads
    assert [[cell or None for cell in row] for row in read] == [
        [None if v in (None, "") else str(v) for v in row] for row in rows
    ]
    a.save(tmp_path / "a.xlsx")
    sheets = openpyxl.load_workbook(tmp_path / "a.xlsx").worksheets
    if name != "ClassMarks":
        found, *cells = [list(row) for row in sheets[0].values]
        assert found == heads
        for row, kept in zip(cells, rows, strict=True):  # openpyxl writes 16 digits
            assert row == [
                pytest.approx(v, rel=1e-14, abs=0) if isinstance(v, float) else (None if v == "" else v)
                for v in kept
            ]
    frame = a.to_dataframe("file")
    assert [frame.index.name, *frame.columns] == heads
    assert plain(frame.reset_index().to_numpy().tolist()) == rows


@pytest.mark.parametrize("name", MADE)
def test_json_reads_back(name: str, tmp_path: Path) -> None:
    a = made(name)
    a.save(tmp_path / "a.json")
    record = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert record == json.loads(json.dumps(a.to_dict()))
    assert (record["dalembert"], record["units"]) == (2, "SI")
    heads, rows = table(a, "SI")
    assert len(record[a.ROWS]) == len(rows)
    if name != "Result":
        assert [list(row.values()) for row in record[a.ROWS]] == [row[1:] for row in rows]
        assert [*record[a.ROWS][0]] == [head.partition(" [")[0] for head in heads[1:]]


def test_names_stand_in_json_as_they_are_written(tmp_path: Path) -> None:
    """In the title and in the rows, so that a text editor finds them."""
    tree = da.four_bar().to_tree() | {"title": "Prüfstand"}
    tree["joints"]["Ä"] = tree["joints"].pop("A") | {"at": "A"}
    da.statics(da.mechanism(tree)).save(tmp_path / "a.json")
    text = (tmp_path / "a.json").read_text(encoding="utf-8")
    assert all(word in text for word in ('"title": "Prüfstand"', '"Ä"'))
    assert "\\u" not in text


@pytest.mark.parametrize("name", [name for name in MADE if name not in ("ClassMarks", "System")])
def test_labelled_arrays_read_back(name: str, tmp_path: Path) -> None:
    a = made(name)
    assert isinstance(a, Labelled)
    a.save(tmp_path / "a.nc")
    with xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as read:
        assert read.attrs["title"] == a.basis()["title"]
        xarray.testing.assert_equal(read.load(), a.to_xarray())
    for c in a.columns():
        if c.name in read and c.kind != WORD and read[c.name].dims == (a.ROWS[:-1],):
            np.testing.assert_array_equal(read[c.name], c.values[:])


@pytest.mark.parametrize("name", MADE)
def test_drawings_reports_cards_and_models(name: str, tmp_path: Path) -> None:
    a = made(name)
    title = a.basis()["title"]
    assert title in str(a) or name == "ClassMarks"
    assert title in a._repr_html_()
    assert "<table" in a._repr_html_()
    if isinstance(a, Drawn):
        a.save(tmp_path / "a.svg")
        assert len(list(ElementTree.parse(tmp_path / "a.svg").iter())) > 10
        assert "<svg" in a._repr_html_()
    if isinstance(a, Worked):
        a.save(tmp_path / "a.txt")
        assert (tmp_path / "a.txt").read_text(encoding="utf-8") == str(da.report(a))
    if isinstance(a, Remade):
        a.save(tmp_path / "a.yaml")
        again, numbers = da.load(tmp_path / "a.yaml"), a.mechanism
        np.testing.assert_allclose(
            *(da.statics(m, positions=3).force_array for m in (again, numbers)), rtol=1e-12
        )


@pytest.mark.parametrize("name", MADE)
def test_what_an_answer_does_not_have_is_refused_with_what_it_has(name: str, tmp_path: Path) -> None:
    a = made(name)
    has = set(a.writers())
    expected = {".json", ".csv", ".xlsx"}
    for kind, ending in ((Labelled, ".nc"), (Drawn, ".svg"), (Worked, ".txt"), (Remade, ".yaml")):
        expected |= {ending} if isinstance(a, kind) else set()
    assert has & ENDINGS == expected
    for ending in (ENDINGS - has) | {".doc"}:
        with pytest.raises(ModelError) as error:
            a.save(tmp_path / f"a{ending}")
        assert (
            str(error.value)
            == f"a{ending}: {name} cannot be written in this format; use one of {' '.join(a.writers())}"
        )
    assert not list(tmp_path.iterdir())
    a.save(tmp_path / "a.csv")
    with pytest.raises(ModelError, match=r"a\.csv exists"):
        a.save(tmp_path / "a.csv")
