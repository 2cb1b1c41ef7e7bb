"""Force systems in files and on the command line: what is read, what is printed, what is refused."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.wrench import load, loads
from dalembert.wrench.reading import direction

PLATE = """\
dalembert: 1
title: A plate with four forces and a couple
source: Meriam and Kraige, Statics, Sample Problem 2/9
units: {length: m, force: N}
points: {O: [0, 0], A: [-7, 0]}
forces:
  F1: {value: [40, 0], at: A}
  F2: {size: 50, direction: 90, at: [-5, 4]}
  F3: {value: 60 @ 135, at: ["-700 cm", 4]}
  F4: {size: 80 N, direction: 30 deg}
couples: {M: 140}
"""
BOX = """\
space: space
units: {force: kN}
points: {A: [0, 0, 0], B: [8, 0, 0], C: [8, 4, 0], E: [0, 4, 0]}
forces:
  F1: {size: 20, from: A, to: [8, 4, 4]}
  F2: {size: 10, from: B, to: C}
  F3: {size: 30, angles: [90, 90, 0], at: E}
couples: {M: [0, 5, "200 N*m"]}
"""


def test_a_plate() -> None:
    s = loads(PLATE)
    assert s.resultant.round(1).tolist() == [66.9, 132.4]
    assert s.moment("O") == pytest.approx(-237.3, abs=0.05)
    assert s.moment("A") == pytest.approx(s.moment([-7, 0]))
    assert (s.title, s.source) == (
        "A plate with four forces and a couple",
        "Meriam and Kraige, Statics, Sample Problem 2/9",
    )


def test_a_direction_is_a_vector_of_any_length() -> None:
    plane = loads("forces: {F: {size: 20, direction: [3, -4], at: [1, 2]}}")
    assert plane["F"].vector == pytest.approx([12, -16])
    space = loads("space: space\nforces: {F: {size: 6 kN, direction: [2, 4, -4], at: [0, 0, 0]}}")
    assert space["F"].vector == pytest.approx([2000, 4000, -4000])
    with pytest.raises(ModelError) as refused:
        loads("space: space\nforces: {F: {size: 6, direction: 30, at: [0, 0, 0]}}")
    assert str(refused.value) == (
        "text:2: direction of force 'F': 30 is not a direction in space; write [x, y, z], or angles: [a, b, c]"
    )


def test_numbers_of_a_file_are_replaced_by_their_paths(tmp_path: Path) -> None:
    path = tmp_path / "plate.yaml"
    path.write_text(PLATE)
    s = load(path, {"forces.F1.value.1": 7, "forces.F4.size": "90 N", "couples.M": -3, "title": "Other"})
    assert s["F1"].vector.tolist() == [40, 7]
    assert s["F4"].size == pytest.approx(90)
    assert (s["M"].moment, s.title) == (-3, "Other")
    assert s["F2"].vector == pytest.approx(loads(PLATE)["F2"].vector)
    for name, says in {
        "forces.F9.value": "the file has no 'forces.F9.value'; choose among F1, F2, F3, F4",
        "forces.F1.value.2": "the file has no 'forces.F1.value.2'; choose among 0, 1",
        "couples.M.x": "the file has no 'couples.M.x'; there is none",
    }.items():
        with pytest.raises(ModelError) as refused:
            load(path, {name: 1})
        assert str(refused.value) == says


def test_no_zero_is_negative() -> None:
    s = loads("forces: {F: {value: [-0.0, 2], at: [-0.0, 0]}}")
    assert not np.signbit(s["F"].vector).any()
    assert not np.signbit(s["F"].at).any()


def test_a_direction_in_space_is_no_angle() -> None:
    for value in (30.0, "30 deg"):
        with pytest.raises(ModelError) as refused:
            direction(value, 3)
        assert str(refused.value) == f"{value!r} is not a direction in space; write [x, y, z]"


def test_a_box() -> None:
    s = loads(BOX)
    assert s["F1"].vector == pytest.approx(np.array([2, 1, 1]) * 20000 / np.sqrt(6))
    assert s["F2"].vector.tolist() == [0, 10000, 0]
    assert s["F2"].at.tolist() == [8, 0, 0]
    assert s["F3"].vector == pytest.approx([0, 0, 30000], abs=1e-9)
    assert s["M"].moment.tolist() == [0, 5000, 200]


@pytest.mark.parametrize(("form", "text"), [
    ("json", '{"forces": {"F": {"value": [3, 4], "at": [1, 0]}}}'),
    ("toml", "[forces.F]\nvalue = [3, 4]\nat = [1, 0]\n"),
])  # fmt: skip
def test_other_formats(form: str, text: str) -> None:
    assert loads(text, form).moment() == 4.0


WRONG = [
    (("F1: {value: [40, 0], at: A}", "F1: {value: [40, 0], at: B}"),
     "plate.yaml:7: force 'F1' names the point 'B'; choose among O, A"),
    (("F2: {size: 50, direction: 90,", "F2: {size: 50 kg, direction: 90,"),
     "plate.yaml:8: size of force 'F2': '50 kg' is a mass, but a force is needed; write one, for example '80 N'"),
    (("F2: {size: 50, direction: 90,", "F2: {size: 50, direktion: 90,"),
     "plate.yaml:8: unknown key 'direktion' in force 'F2'; did you mean 'direction'?"),
    (("F2: {size: 50, direction: 90,", "F2: {size: 50,"),
     "plate.yaml:8: force 'F2': it has no direction; "
     "give one of value, direction, angles (space), from and to"),
    (("F2: {size: 50, direction: 90,", "F2: {size: 50, value: 30 @ 3, "),
     "plate.yaml:8: force 'F2': size and value are both given; "
     "write value: [x, y], or size: with direction, angles, or from and to"),
    (("F2: {size: 50, direction: 90,", "F2: {size: 50, from: A, "),
     "plate.yaml:8: force 'F2': only one of from and to is given; give both points"),
    (("F2: {size: 50, direction: 90,", "F2: {size: 50, from: A, to: A, "),
     "plate.yaml:8: force 'F2': a vector of length 0 has no direction; write one along the line"),
    (("{M: 140}", "{M: [1, 2, 3]}"),
     "plate.yaml:11: couple 'M': a list is not a moment; write one, for example '12 N*m'"),
    (("forces:", "links:"),
     "plate.yaml:6: this is the model file of a mechanism; use dalembert solve, or da.load"),
    (("[-5, 4]", "[-5, 4, 0]"),
     "plate.yaml:8: at of force 'F2': a vector has 3 components where 2 are needed; "
     "write [x, y] or polar text r @ angle, or space: space at the top of the file"),
    (("points: {O: [0, 0], A: [-7, 0]}", "points:"),
     "plate.yaml:5: points has no value; write one, or leave it out"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "said"), WRONG, ids=[said[:60] for _, said in WRONG])
def test_what_is_wrong(change: tuple[str, str], said: str) -> None:
    assert change[0] in PLATE
    with pytest.raises(ModelError) as error:
        loads(PLATE.replace(*change), name="plate.yaml")
    assert str(error.value) == said


def test_nothing_in_it() -> None:
    with pytest.raises(ModelError) as error:
        loads("title: Nothing", name="none.yaml")
    assert str(error.value) == "none.yaml:1: the system has no force and no couple; give it at least one"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plate.yaml").write_text(PLATE, encoding="utf-8")
    (tmp_path / "box.yaml").write_text(BOX, encoding="utf-8")
    return tmp_path


Output = Callable[[], tuple[str, str]]


def test_command(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert load("plate.yaml").kind() == "single force"
    arguments = ["wrench", "plate.yaml", "--about", "A", "--drawing", "plate.svg", "--report", "plate.html"]
    assert main(arguments) == 0
    out, err = capsys.readouterr()
    assert "Meriam and Kraige, Statics, Sample Problem 2/9" in out
    assert "About A at (−7.000, 0) m" in out
    assert "d = M_A / R = 689.7 / 148.3 = 4.649 m" in out
    assert "Force and couple at A (−7.000, 0) m" in (here / "plate.svg").read_text(encoding="utf-8")
    assert err == "Written: plate.html\nWritten: plate.svg\n"
    assert main(arguments) == 2
    assert capsys.readouterr()[1].startswith("plate.html exists; name another file, or overwrite it")


def test_command_in_space(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["wrench", "box.yaml", "--camera", "top", "--drawing", "box.svg", "--units", "si"]) == 0
    assert "About A at (0, 0, 0) m" in capsys.readouterr()[0]
    assert main(["wrench", "box.yaml", "--about", "[1, 0, 0]", "--figures", "6"]) == 0
    assert "About O at (1.00000, 0, 0) m" in capsys.readouterr()[0]


def test_command_in_the_files_units_or_si(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "pipe.yaml").write_text(
        "units: {length: in, force: lbf}\nforces:\n  F: {at: [10, 0], value: [0, -20]}\n",
        encoding="utf-8",
    )
    found = {}
    for units in ([], ["--units", "file"], ["--units", "si"]):
        assert main(["wrench", "pipe.yaml", *units]) == 0
        found[" ".join(units)] = capsys.readouterr()[0]
    assert found[""] == found["--units file"]
    said = {"": ("= 20.00 lbf", "−200.0\n", "lbf·in"), "--units si": ("= 88.96 N", "−22.60\n", "N·m")}
    assert all(part in found[units] for units, parts in said.items() for part in parts)


def test_command_refused(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["wrench", "box.yaml", "--about", "D"]) == 2
    assert capsys.readouterr()[1] == "the system has no point 'D'; choose among A, B, C, E\n"
    assert main(["wrench", "bx.yaml"]) == 2
    assert capsys.readouterr()[1] == "bx.yaml: file not found; did you mean 'box.yaml'?\n"


@pytest.mark.parametrize("seed", range(8))
def test_changed_files_are_read_or_refused(seed: int) -> None:
    """Files with characters lost, added and moved: a system, or a sentence."""
    rng = random.Random(seed)
    for _ in range(25):
        text = rng.choice([PLATE, BOX])
        for _ in range(rng.randint(1, 4)):
            k = rng.randrange(len(text))
            added = rng.choice(
                ["1e308", "nan", ": ", "[", "]", "0", "-", "@", "null", "'", ", ", "{}", "\n", "  "]
            )
            text = text[:k] + rng.choice([added, ""]) + text[k + rng.randint(0, 5) :]
        with contextlib.suppress(ModelError):
            assert loads(text).equilibrium().sentence
