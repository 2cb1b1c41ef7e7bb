"""Tables whose columns stand in a file beside the model: the same as the table inline, and whatever a file may hold."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from dalembert.analysis import dynamics
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.model import Mechanism, convert, load, loads
from dalembert.model.quantities import column_files

ENGINE = """\
units: {length: mm}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [45, 0]}}
  rod: {points: {A: [0, 0], B: [150, 0]}}
  piston: {points: {B: [0, 0]}, mass: 1}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  guide: {type: slider, links: [ground, piston], at: [O, B], direction: 0}
drives:
  O: {position: {from: 0, to: 360, count: 12}, speed: 1500 rpm}
loads:
  gas: {type: force, on: piston, at: B, direction: 180, value: VALUE}
assembly: {rod: 0, piston: 0}
"""
INLINE = (
    "{against: O, x: [0, 90, 180, 270], y: [1 bar, 5.25 bar, 3 bar, 2 bar], times: 50 cm^2, periodic: true}"
)
POINTS = [("0", "1"), ("90", "5.25"), ("180", "3"), ("270", "2")]
WRITTEN = {
    "head": "angle [deg],pressure [bar]\n" + "\n".join(map(",".join, POINTS)),
    "brackets, blanks, quotes": '# measured\n\n"angle (deg)" , "pressure (bar)"\n'
    + "\n".join(map(" , ".join, POINTS)),
    "semicolons and decimal commas": "angle [°];pressure [bar]\r\n"
    + "\r\n".join(f"{a};{p.replace('.', ',')}" for a, p in POINTS),
    "tabs, a row of units": "\ufeffangle\tpressure\ndeg\tbar\n" + "\n".join(map("\t".join, POINTS)) + "\n",
    "another column between": "angle [deg],torque [N*m],pressure [bar]\n"
    + "\n".join(f"{a},7,{p}" for a, p in POINTS),
}


def model(folder: Path, value: str) -> Path:
    path = folder / "engine.yaml"
    path.write_text(ENGINE.replace("VALUE", value), encoding="utf-8")
    return path


def with_file(folder: Path, text: str | bytes, keys: str = "columns: [angle, pressure]") -> Path:
    (folder / "p.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    return model(folder, f"{{file: p.csv, {keys}, times: 50 cm^2, periodic: true}}")


@pytest.mark.parametrize("text", WRITTEN.values(), ids=WRITTEN)
def test_a_file_is_the_same_table_to_the_bit(tmp_path: Path, text: str) -> None:
    m, inline = load(with_file(tmp_path, text)), loads(ENGINE.replace("VALUE", INLINE))
    assert m == inline
    assert dynamics(m).effort("O").tobytes() == dynamics(inline).effort("O").tobytes()


def test_columns_without_a_head_have_numbers_and_their_units_stand_in_the_model(tmp_path: Path) -> None:
    keys = "columns: [1, 2], units: [deg, bar]"
    m = load(with_file(tmp_path, "\n".join(map(" ".join, POINTS)), keys))
    assert m == loads(ENGINE.replace("VALUE", INLINE))
    m = load(with_file(tmp_path, "\n".join(map(",".join, POINTS)), "units: ['', bar], against: O"))
    assert m == loads(ENGINE.replace("VALUE", INLINE))


REFUSED = {
    "": "p.csv:1: it has no rows",
    "angle [deg],pressure [bar]\n": "p.csv:1: a table has too few points: 0",
    "angle [deg],pressure [bar]\n0,1\n90,x\n": "p.csv:3: 'x' in column 'pressure' is not a finite number",
    "angle [deg],pressure [bar]\n0,1\n90,nan\n": "p.csv:3: 'nan' in column 'pressure' is not a finite number",
    "angle [deg],pressure [bar]\n0,1\n90,1e999\n": "p.csv:3: '1e999' in column 'pressure' is not a finite number",
    "angle [deg],pressure [bar]\n0,1\n90,\n": "p.csv:3: '' in column 'pressure' is not a finite number",
    "angle [deg],pressure [bar]\n0,1\n\n90,1,2\n": "p.csv:4: 3 columns where the first row has 2",
    "angle [deg],pressure [bar]\n0,1\n90\n": "p.csv:3: 1 columns where the first row has 2",
    "angle [deg],pressure [bar]\n0,1\n90,5\n90,6\n": "p.csv:4: x of a table does not increase from its item 2 to 3",
    "angle [deg],pressure [bar]\n0,1\n90,5\n80,6\n": "p.csv:4: x of a table does not increase from its item 2 to 3",
    "angle [deg],pressure [mm]\n0,1\n90,5\n": "p.csv:1: '50 cm^2' is an area, but a stiffness is needed",
    "angle [mm],pressure [bar]\n0,1\n90,5\n": "p.csv:1: 'mm' is a length, but an angle is needed",
    "angle [deg],pressure [baz]\n0,1\n90,5\n": "p.csv:1: unknown unit 'baz'",
    "angle,p\n0,1\n90,5\n": "p.csv:1: the column 'pressure' is not in its head",
    "angle,pressure,pressure\n0,1,1\n90,5,5\n": "p.csv:1: the column 'pressure' is twice in its head",
    'angle,pressure\n0,"1\n90,5\n': "p.csv:2: it cannot be read: unexpected end of data",
    b"angle,pressure\n\x00\x01,2\n": "p.csv:2: not UTF-8 text",
    b"angle,pressure\n0,1\n\xff\xfe,2\n": "p.csv:3: not UTF-8 text",
}


@pytest.mark.parametrize("text", REFUSED, ids=range(len(REFUSED)))
def test_a_wrong_file_is_refused_at_its_line_with_a_remedy(tmp_path: Path, text: str | bytes) -> None:
    with pytest.raises(ModelError) as caught:
        load(with_file(tmp_path, text))
    said = str(caught.value)
    assert f"{tmp_path}{os.sep}{REFUSED[text]}" in said
    assert "(read for value of load 'gas'" in said
    assert caught.value.remedy


def test_a_huge_file_is_refused_before_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(column_files, "MOST", 3)
    with pytest.raises(ModelError, match=r"p\.csv:4: more than 3 rows"):
        load(with_file(tmp_path, WRITTEN["head"]))
    monkeypatch.setattr(column_files, "LARGEST", 20)
    with pytest.raises(ModelError, match=r"p\.csv:1: more than 20 bytes"):
        load(with_file(tmp_path, WRITTEN["head"]))


@pytest.mark.parametrize("name", ["../p.csv", "sub/../../p.csv", "LINK.csv", "ABSOLUTE"])
def test_only_files_of_the_models_folder_are_read_unless_another_is_allowed(
    tmp_path: Path, name: str
) -> None:
    inner = tmp_path / "inner"
    (inner / "sub").mkdir(parents=True)
    (tmp_path / "p.csv").write_text(WRITTEN["head"], encoding="utf-8")
    (inner / "LINK.csv").symlink_to(tmp_path / "p.csv")
    name = name.replace("ABSOLUTE", str(tmp_path / "p.csv"))
    path = model(inner, f"{{file: '{name}', columns: [angle, pressure], times: 50 cm^2, periodic: true}}")
    with pytest.raises(ModelError) as caught:
        load(path)
    assert "outside the model file's folder; move it into that folder, or allow its folder" in str(
        caught.value
    )
    assert str(caught.value).startswith(f"{path}:15: ")
    m = load(path, data=tmp_path)
    assert m == loads(ENGINE.replace("VALUE", INLINE))
    assert (main(["solve", str(path)]), main(["--data", str(tmp_path), "solve", str(path)])) == (2, 0)
    assert main(["solve", str(path), f"--data={tmp_path}"]) == 0
    assert main([f"--data={tmp_path}", "solve", str(path)]) == 0
    assert main(["--data", str(tmp_path), "solve", str(path), "--static"]) == 0
    changed = m.with_values({"links.piston.mass": 2.0})
    changed.save(inner / "changed.yaml")
    assert load(inner / "changed.yaml", data=tmp_path) == changed


@pytest.mark.parametrize("name", ["no.csv", "engine.yaml", "p.exe", "a\0.csv", "folder.csv", "fifo.csv"])
def test_what_is_no_text_file_of_columns_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder.csv").mkdir()
    os.mkfifo(tmp_path / "fifo.csv")
    value = {"file": name, "columns": [1, 2]}
    m = loads(ENGINE.replace("VALUE", "1"))
    os.chdir(tmp_path)
    with pytest.raises(ModelError) as caught:
        m.with_values({"loads.gas.value": value})
    assert caught.value.remedy


def test_saving_keeps_the_file_beside_it_and_writes_the_columns_out_elsewhere(tmp_path: Path) -> None:
    path = with_file(tmp_path, WRITTEN["head"])
    m, there = load(path), tmp_path / "there"
    there.mkdir()
    m.save(tmp_path / "again.yaml")
    assert (tmp_path / "again.yaml").read_text() == path.read_text()
    changed = m.with_values({"loads.gas.direction": "170 deg"})
    for name in ("a.yaml", "a.json"):
        changed.save(tmp_path / name)
        assert "p.csv" in (tmp_path / name).read_text()
        assert load(tmp_path / name) == changed
        changed.save(there / name)
        assert "p.csv" not in (there / name).read_text()
        assert load(there / name) == changed
    convert(path, there / "c.json")
    assert load(there / "c.json") == m
    convert(path, tmp_path / "c.json")
    assert "p.csv" in (tmp_path / "c.json").read_text()
    assert load(tmp_path / "c.json") == m
    assert Mechanism.model_validate(m.to_tree()) == m


def test_a_shift_comes_later_and_a_factor_multiplies() -> None:
    x, y = "x: [0, 90, 180, 270]", "y: [1, 5.5, 3, 2]"
    tables = [
        loads(ENGINE.replace("VALUE", f"{{{x}, {y}, periodic: true, {more}}}")).loads["gas"].value
        for more in ("against: O", "shift: 540 deg", "times: 3")
    ]
    q = np.linspace(-10, 10, 101)
    plain, shifted, larger = (lambda q, t=t: t.at({"O": q}) for t in tables)
    assert shifted(q) == pytest.approx(plain(q - 3 * np.pi), abs=1e-12)
    assert larger(q) == pytest.approx(3 * plain(q), rel=1e-15)


def test_an_example_is_written_with_its_columns_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "engine.yaml"
    assert main(["examples", "four_cylinder", "-o", str(path)]) == 0
    assert (
        main(["examples", "four_cylinder", "-o", str(tmp_path / "other.yaml")]) == 2
    )  # pressure.csv is there
    assert load(path) == load(examples()["four_cylinder"])
