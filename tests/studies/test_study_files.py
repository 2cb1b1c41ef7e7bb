"""study.yaml and `dalembert study`: the words, the units, and what is said of malformed ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.studies import StudyResult
from dalembert.studies.study_file import load_study

MODEL = str(examples()["pump"])
KEYS = {
    "study": "1",
    "model": MODEL,
    "vary": "{stroke: ± 0.5 mm}",
    "outputs": "[effort.O]",
    "designs": "100",
    "seed": "1",
}
"""A right study; each row below changes some of its lines, and None leaves one out."""

FORMS = "write '± 0.05 mm', 'normal 2 %', 'uniform ± 5 %', '70..90 N', '70..90 N in 5' or a list"
WRONG: list[tuple[dict[str, str | None], int, str]] = [
    ({"model": None}, 1, "the file names no model file; write model: pump.yaml"),
    ({"model": "missing.yaml"}, 2, "missing.yaml does not exist; give its path relative to this file"),
    ({"model": "/tmp"}, 2, "model file /tmp does not exist"),
    ({"model": "3"}, 2, "the file names no model file"),
    ({"study": "2"}, 1, "unknown format version 2; write study: 1"),
    ({"desings": "3"}, 7, "unknown key 'desings'; did you mean 'designs'?"),
    (
        {"links": "{a: {}}"},
        7,
        "this is a model file; write a separate file with the line model: s.yaml",
    ),
    ({"vary": None}, 1, "the key 'vary' is missing; write vary: {stroke: ± 0.1 mm}"),
    ({"vary": "{}"}, 3, "vary is empty; write vary: {stroke: ± 0.1 mm}"),
    ({"vary": "[stroke]"}, 3, "vary is a list, not a mapping; write vary: {stroke: ± 0.1 mm}"),
    ({"vary": "{stroke: }"}, 3, "stroke"),
    ({"vary": "{strok: ± 1 mm}"}, 3, "unknown parameter 'strok'; did you mean 'stroke'?"),
    ({"vary": "{links.crnk.mass: ± 1 %}"}, 3, "did you mean 'crank'?"),
    ({"vary": "{links.rod.mas: ± 1 %}"}, 3, "did you mean 'mass'?"),
    ({"vary": "{links.rod: ± 1 %}"}, 3, "'links.rod' is not a number; name a number, or a vector of numbers"),
    ({"vary": "{links.crank.mass: ± 1 %}"}, 3, "has no number; give mass a value in the model file first"),
    ({"vary": "{title: ± 1 %}"}, 3, "not a number; give it a number in the description first"),
    ({"vary": "{drives.O.position: ± 1 deg}"}, 3, "is not a single number; leave it out: a single position"),
    ({"vary": "{stroke: ± 0.5 kg}"}, 3, "stroke: '0.5 kg' is a mass, but a length is needed; write one"),
    ({"vary": "{stroke: 50..60 N}"}, 3, "stroke: '50 N' is a force, but a length is needed; write one"),
    ({"vary": "{stroke: ± 0.5 furl}"}, 3, "stroke: unknown unit 'furl'; units of length: m, meter"),
    ({"vary": "{stroke: ± -0.5 mm}"}, 3, "a tolerance of '-0.5 mm' is not positive; give one above zero"),
    ({"vary": "{stroke: ± 0 mm}"}, 3, "a tolerance of '0 mm' is not positive; give one above zero"),
    ({"vary": "{stroke: ± -5 %}"}, 3, "a tolerance of '-5 %' is not positive; give one above zero"),
    (
        {"vary": "{links.rod.points.A.0: ± 5 %}"},
        3,
        "5 % of a number that is 0 is nothing; give it with a unit",
    ),
    ({"vary": "{stroke: 60..50 mm}"}, 3, "the range from 60 to 50 is empty; write the smaller end first"),
    ({"vary": "{stroke: 60..60 mm}"}, 3, "the range from 60 to 60 is empty; write the smaller end first"),
    ({"vary": "{stroke: 50 mm..60 cm}"}, 3, "the range begins in mm and ends in cm; write one unit"),
    ({"vary": "{stroke: 50..60 mm in 1}"}, 3, "levels=1 is out of range; use 2 to 1000000"),
    ({"vary": "{stroke: 50..60 mm in 99999999}"}, 3, "levels=99999999 is out of range; use 2 to 1000000"),
    ({"vary": "{stroke: []}"}, 3, "a list of 0 values says no levels; give 1 to 1000000"),
    ({"vary": "{stroke: [50 mm, 50 mm]}"}, 3, "a value occurs twice in the list; leave one of them out"),
    ({"vary": "{stroke: [50 mm, long]}"}, 3, "'long' is not a length; write one, for example '127 mm'"),
    ({"vary": "{stroke: 60}"}, 3, f"'60' says no spread; {FORMS}"),
    ({"vary": "{stroke: 60 mm}"}, 3, f"'60 mm' says no spread; {FORMS}"),
    ({"vary": "{stroke: uniform 5 %}"}, 3, f"'uniform 5 %' says no spread; {FORMS}"),
    ({"vary": "{stroke: normal ± 5 %}"}, 3, f"'normal ± 5 %' says no spread; {FORMS}"),
    ({"vary": "{stroke: {a: 1}}"}, 3, f"a mapping says no spread; {FORMS}"),
    (
        {"vary": "{density: range}"},
        3,
        "density: it states no range; only a parameter with range: [LOW, HIGH]",
    ),
    (
        {"vary": "{stroke: ± 1 %, r: ± 1 %}"},
        3,
        "'r' follows from the parameter 'stroke', and both vary; leave",
    ),
    ({"vary": "{stroke: ± 1 %, parameters.stroke: ± 1 %}"}, 3, "'stroke' is varied twice; name it once"),
    ({"designs": None}, 1, "the key 'designs' is missing; write designs: 10000"),
    ({"designs": "0"}, 5, "designs is 0; it must be an integer of at least 1; write designs: 1000"),
    ({"designs": "1.5"}, 5, "designs is 1.5; it must be an integer of at least 1; write designs: 1000"),
    ({"designs": "many"}, 5, "designs is 'many'; it must be an integer of at least 1; write designs"),
    ({"designs": "true"}, 5, "designs is true; it must be an integer of at least 1; write designs: 1000"),
    ({"designs": "1e15"}, 5, "designs=1000000000000000 is out of range; use 1 to 1000000000000"),
    ({"draw": "sobol", "designs": "2e9"}, 5, "use 1 to 1073741824; more can be drawn at random"),
    ({"seed": "-1"}, 6, "seed is -1; it must be an integer of at least 0; write seed"),
    ({"draw": "sobel"}, 7, "unknown sampling method 'sobel'; did you mean 'sobol'?"),
    ({"draw": "factorial"}, 7, "stroke: a factorial needs levels; write a list, or 70..90 N in 5"),
    ({"outputs": "[efort.O]"}, 4, "unknown output 'efort.O'; did you mean 'effort.O'?"),
    ({"outputs": "[effort.P]"}, 4, "did you mean 'effort.O'?"),
    (
        {"outputs": "[]"},
        4,
        "outputs are not a list of names; write outputs: [effort.O2, reaction.A.magnitude]",
    ),
    (
        {"outputs": "{a: 1}"},
        4,
        "outputs are not a list of names; write outputs: [effort.O2, reaction.A.magnitude]",
    ),
    ({"outputs": "[effort.O, effort.O]"}, 4, "an output is named twice; leave one of them out"),
    ({"reduce": "highest"}, 7, "unknown reduction 'highest'; use one of peak"),
    ({"reduce": "3"}, 7, "3 is not a reduction; write reduce: peak, or none"),
    (
        {"limits": "{effort.O: < 5 kg}"},
        7,
        "limit of effort.O: '5 kg' is a mass, but a moment is needed; write",
    ),
    ({"limits": "{effort.P: < 5 N*m}"}, 7, "which is not an output of the study; did you mean 'effort.O'?"),
    ({"limits": "{effort.O: 5 N*m}"}, 7, "'5 N*m' is not a limit; write '< 45 N*m', '>= 3 kN', or '2..5 kN'"),
    ({"limits": "{effort.O: 9..5 N*m}"}, 7, "'9..5 N*m' leaves nothing between; write"),
    ({"limits": "[1]"}, 7, "limits is a list, not a mapping; write limits: {effort.O2: < 45 N*m}"),
    (
        {"correlation": "{'stroke, bore': 0.5}"},
        7,
        "correlation names 'bore', which does not vary; there are: stroke",
    ),
    ({"correlation": "{stroke: 0.5}"}, 7, "'stroke' names no two paths; write 'stroke, bore': 0.5"),
    ({"correlation": "{'stroke, stroke': 0.5}"}, 7, "correlation names 'stroke' with itself; name two paths"),
    (
        {"vary": "{stroke: ± 1 %, bore: ± 1 %}", "correlation": "{'stroke, bore': 2}"},
        7,
        "give one between -1 and 1",
    ),
    ({"static": "perhaps"}, 7, "static is 'perhaps'; write static: true, or false"),
    ({"keep": "1"}, 7, "keep is 1; write keep: true, or false"),
    ({"positions": "0"}, 7, "positions is 0; it must be an integer of at least 1; write positions: 1000"),
    ({"positions": "1e12"}, 7, "positions is 1000000000000; give a whole number from 1 to 10000000"),
    ({"table": "t.csv"}, 5, "table and designs are both given; leave designs out: the table is the designs"),
    ({"table": "t.csv", "designs": None, "seed": None}, 3, "table and vary are both given; leave vary out"),
    (
        {"table": "t.csv", "designs": None, "seed": None, "vary": None},
        4,
        "no such file or directory; name a .csv",
    ),
]


def write(folder: Path, **changed: str | None) -> Path:
    path = folder / "s.yaml"
    path.write_text(
        "".join(f"{key}: {value}\n" for key, value in {**KEYS, **changed}.items() if value is not None)
    )
    return path


@pytest.mark.parametrize(("changed", "line", "sentence"), WRONG)
def test_a_malformed_study_is_refused_with_line_and_remedy(
    tmp_path: Path, changed: dict[str, str | None], line: int, sentence: str
) -> None:
    path = write(tmp_path, **changed)
    with pytest.raises(da.ModelError) as said:
        load_study(path)
    assert str(said.value).startswith(f"{path}:{line}: ")
    assert sentence in str(said.value)


@pytest.mark.parametrize(
    ("text", "line", "sentence"),
    [
        (
            "stroke [mm], bore [mm]\n50\n",
            2,
            "the row has 1 numbers, but there are 2 heads; give one below each",
        ),
        ("stroke [mm]\n50\nlong\n", 3, "'long' is not a number; write one, its unit in the head"),
        ("stroke, stroke\n1, 2\n", 1, "a head is empty or occurs twice; write `path [unit]` once each"),
        ("stroke [mm]\n", 1, "the table has no designs; write a head"),
    ],
)
def test_a_malformed_table_is_refused_with_its_own_line(
    tmp_path: Path, text: str, line: int, sentence: str
) -> None:
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(da.ModelError) as said:
        load_study(write(tmp_path, table="t.csv", designs=None, seed=None, vary=None))
    assert str(said.value).startswith(f"{tmp_path / 't.csv'}:{line}: {sentence}")


def test_the_path_that_works_is_named_where_a_link_gives_its_weight() -> None:
    m = da.load(examples()["four_bar"])
    with pytest.raises(
        da.ModelError, match=r"the file gives 'links.coupler.weight'; vary links.coupler.weight"
    ):
        da.study(m, {"links.coupler.mass": "± 5 %"})
    assert da.study(m, {"links.coupler.weight": "± 5 %"}, ["effort.O2"], designs=10).run().counts() == {
        "ok": 10
    }


def test_the_words_are_those_of_the_model_file(tmp_path: Path) -> None:
    """The file's bare numbers are millimetres; in Python they are metres."""
    m = da.load(MODEL)
    for said, given in [
        ("[50, 60]", [0.05, 0.06]),
        ("50..60", "50..60 mm"),
        ("range", "30..100 mm"),
        ("2..3 in", "50.8..76.2 mm"),
        ("2..3 in in 5", "50.8..76.2 mm in 5"),
        ("50..60 in 3", "50..60 mm in 3"),
    ]:
        spread = load_study(write(tmp_path, vary=f"{{stroke: {said}}}")).plan.spreads[0]
        expected = da.study(m, {"stroke": given}).plan.spreads[0]
        assert (spread.kind, len(spread.levels)) == (expected.kind, len(expected.levels))
        assert spread.ends == pytest.approx(expected.ends, rel=1e-14)


def test_the_command_runs_resumes_extends_shows_and_exports(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write(tmp_path, vary="{stroke: ± 0.5 mm, density: ± 1 %}", static="true", limits="{effort.O: < 360 N*m}")
    assert main(["study", "run", "s.yaml"]) == 0
    said = capsys.readouterr()
    assert said.err == "Changes no output: density.\n"
    assert "100 of 100 designs (random, seed 1)" in said.out
    assert main(["study", "run", "s.yaml"]) == 2
    assert (
        capsys.readouterr().err
        == "s.zarr already exists; dalembert study resume s.zarr, or name another with -o\n"
    )
    assert main(["study", "resume", "s.yaml"]) == 0
    assert main(["study", "extend", "s.zarr", "--designs", "200"]) == 0
    capsys.readouterr()
    assert main(["study", "show", "s.zarr", "--contributions", "linear"]) == 0
    out = capsys.readouterr().out
    found = StudyResult.open("s.zarr")
    worst = found.worst("effort.O")
    assert f"({worst})" in out
    assert f"{found.share('effort.O', '< 360 N*m'):.4%}" in out
    assert "effort.O (linear): sigma" in out
    assert main(["study", "design", "s.zarr", str(worst), "-o", "worst.yaml"]) == 0
    own = np.abs(da.statics(da.load("worst.yaml")).effort("O")).max()
    assert own == pytest.approx(found["effort.O"][worst], rel=1e-12)
    assert main(["study", "show", "s.zarr", "--csv", "s.csv", "--units", "si"]) == 0
    head, *rows = Path("s.csv").read_text().splitlines()
    assert head == "design,stroke [m],density [kg/m^3],status,effort.O [N*m]"
    assert len(rows) == 200
    assert float(rows[worst].split(",")[-1]) == found["effort.O"][worst]
