"""`dalembert check` and `dalembert validate`: answers compared."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

import dalembert as da
from dalembert.analysis.result.quantity_catalogue import CATALOGUE
from dalembert.bundled import examples
from dalembert.cli.check_command import _print_verdict
from dalembert.model.stated_answers import StatedAnswer
from tests.cli.conftest import Run
from tests.progress_lines import only_progress

ANSWERS = """
answers:
  - {quantity: effort, of: O2, value: 243.23 lbf*in, exact: 243.2375907612, tolerance: 0.01 %, why: five digits}
  - {quantity: reaction, of: A, on: crank, value: 154.99 @ 40.35 lbf, tolerance: 0.3 %, why: the book rounds the masses}
  - {quantity: reaction, of: A, by: coupler, component: direction, value: 40.35, tolerance: 0.1 deg}
  - {quantity: speed, of: coupler, value: -5.87 rad/s, tolerance: 0.005 rad/s}
  - {quantity: point, of: crank.A, value: "[2.5 in, 4.330127 in]"}
  - {quantity: turn, of: B, value: 83.4924964081, tolerance: 1e-6 deg}
  - {quantity: mobility, value: 1}
  - {quantity: count, value: 1}
  - {quantity: status, at: 60 deg, value: ok}
  - {quantity: moment, of: A, at: 1, value: 0, tolerance: 1e-9}
""".replace('"[2.5 in, 4.330127 in]"', "[2.5 in, 4.330127 in]")


WITHOUT_THING = ("shaking_force", "shaking_couple", "residual", "power_balance", "time")
NAMES_OF_RESULTS = [
    ".".join(filter(None, (word, "" if word in WITHOUT_THING else "T", rate)))
    for word, quantity in CATALOGUE.items()
    for rate in quantity.rates
    if quantity.of != "frames"
]


@pytest.mark.parametrize("name", NAMES_OF_RESULTS)
def test_an_answer_takes_each_name_of_a_result(name: str) -> None:
    assert StatedAnswer(quantity=name, value=0).name == name


def with_answers(folder: Path, answers: str, name: str = "claims.yaml") -> str:
    text = (folder / "four_bar.yaml").read_text(encoding="utf-8")
    (folder / name).write_text(text + answers, encoding="utf-8")
    return name


def test_answers_that_agree(run: Run, folder: Path) -> None:
    ran = run("check", with_answers(folder, ANSWERS))
    assert ran.err == ""
    assert ran.status == 0
    lines = ran.out.splitlines()
    assert lines[0].split() == ["quantity", "published", "exact", "computed", "tolerance", "deviation", "ok"]
    effort = "effort of O2 243.23 lbf*in 243.2376 243.2376 0.01 % 0.0031 % yes"
    assert " ".join(lines[2].split()) == effort
    assert lines[-1] == "10 answers, 1 with an exact value; all met."


def test_an_answer_that_disagrees(run: Run, folder: Path) -> None:
    claim = "answers:\n  - {quantity: effort, of: O2, value: 250, tolerance: 1 %, why: a slip}\n"
    ran = run("check", with_answers(folder, claim))
    assert ran.status == 1
    assert "claims, line 33: effort of O2: published 250, computed 243.2376, 2.7 %" in ran.out.replace(
        "\n  ", " "
    )
    assert ran.out.splitlines()[-1] == "1 answer, 0 with an exact value; 1 not met."


@pytest.mark.parametrize(
    "claim",
    [
        "quantity: status, at: 60 deg, value: jammed",
        "quantity: mobility, value: 2",
        "quantity: count, value: 7",
    ],
)
def test_a_word_or_a_count_that_disagrees(run: Run, folder: Path, claim: str) -> None:
    ran = run("check", with_answers(folder, f"answers:\n  - {{{claim}, why: a slip}}\n"))
    assert ran.status == 1
    assert ran.out.splitlines()[-1] == "1 answer, 0 with an exact value; 1 not met."


def test_an_exact_value_that_is_missed(run: Run, folder: Path) -> None:
    claim = "answers:\n  - {quantity: effort, of: O2, value: 243.2, exact: 243.2, tolerance: 1 %}\n"
    ran = run("check", with_answers(folder, claim))
    assert ran.status == 1
    assert "The exact value is missed." in ran.out


@pytest.mark.parametrize(
    ("claim", "said"),
    [
        (
            "{quantity: effort, of: A, value: 1}",
            "claims.yaml:33: unknown drive 'A'; the only one is 'O2'",
        ),
        ("{quantity: effort, value: 1}", "claims.yaml:33: effort needs `of`; the only one is 'O2'"),
        (
            "{quantity: effort, of: O2, value: 1 lbf}",
            "claims.yaml:33: '1 lbf' is a force, but a moment is needed",
        ),
        (
            "{quantity: speed, of: crank, at: 70 deg, value: 1 rad/s}",
            "claims.yaml:33: no position has O2 = 70 deg",
        ),
        (
            "{quantity: speed, of: crank, at: 2, value: 1 rad/s}",
            "claims.yaml:33: position 2 does not exist; this result has 1 position, numbered from 1",
        ),
        (
            "{quantity: point, of: crank, value: [1, 2]}",
            "claims.yaml:33: 'crank' names no point of a moving link",
        ),
        (
            "{quantity: effort, of: O2, value: 1, tolerance: x %}",
            "claims.yaml:33: 'x %' is not a tolerance in percent",
        ),
        (
            "{quantity: reaction, of: A, by: rocker, value: [1, 2]}",
            "claims.yaml:33: joint 'A' does not join 'rocker'; it joins crank and coupler",
        ),
    ],
)
def test_answers_that_ask_for_nothing(run: Run, folder: Path, claim: str, said: str) -> None:
    ran = run("check", with_answers(folder, f"answers:\n  - {claim}\n"))
    assert ran.status == 2
    assert ran.err.startswith(said)


def test_a_folder_one_line_a_file(run: Run, folder: Path) -> None:
    with_answers(folder, ANSWERS, "a.yaml")
    with_answers(folder, "answers:\n  - {quantity: effort, of: O2, value: 250}\n", "b.yaml")
    ran = run("check", str(folder))
    assert ran.status == 1
    cases = {line.split()[0]: line.split()[1:] for line in ran.out.splitlines()[2:4]}
    assert cases == {"a": ["10", "1", "10", "yes"], "b": ["1", "0", "0", "NO"]}


def test_a_wrong_file_does_not_stop_the_others(run: Run, folder: Path, edited: Callable[..., str]) -> None:
    wrong = edited(("type: pin", "type: pim"))
    ran = run("check", wrong, with_answers(folder, ANSWERS))
    assert ran.status == 2
    assert ran.err.startswith("edited.yaml:19: ")
    assert "10 answers" in ran.out


def test_extremes_over_a_turn(run: Run, folder: Path) -> None:
    text = (folder / "four_bar.yaml").read_text(encoding="utf-8")
    text = text.replace("position: 60 deg", "position: {from: 60, to: 420, count: 72}")
    r = da.dynamics(da.loads(text))
    most = float(r.effort("O2").max()) / 0.1129848290276167
    claim = f"answers:\n  - {{quantity: effort, of: O2, extreme: max, value: {most!r}}}\n"
    (folder / "turn.yaml").write_text(text + claim, encoding="utf-8")
    assert run("check", "turn.yaml").status == 0


def test_files_without_answers(run: Run) -> None:
    assert run("check", "four_bar.yaml") == (0, "No answers to compare.\n", "")


@pytest.mark.parametrize("size", ["9.81", "1.01 m/s^2", "29.9 m/s^2", "0.99 m/s^2", "30.1 m/s^2", "0"])
def test_a_gravity_in_another_unit_is_doubted_in_every_answer(run: Run, folder: Path, size: str) -> None:
    """-9.81 in a file in millimetres is 9.81 mm/s2."""
    doubted = {"9.81": "0.00981", "0.99 m/s^2": "0.99", "30.1 m/s^2": "30.1"}.get(size)
    text = (folder / "four_bar.yaml").read_text(encoding="utf-8").replace("length: in", "length: mm")
    (folder / "g.yaml").write_text(text.replace("gravity: none", f"gravity: [0, -{size}]"), encoding="utf-8")
    m = da.load(folder / "g.yaml")
    said = f"{doubted} m/s2 is not between 1 and 30 m/s2: write gravity: standard, or [0, -9.81 m/s^2]"
    told = [
        da.statics(m).assumptions["gravity"],
        da.statics(m).to_dict()["assumptions"]["gravity"],
        " ".join(run("solve", "g.yaml").out.split()),
        run("check", "g.yaml").err,
    ]
    assert [said in text for text in told] == [doubted is not None] * 4
    assert told[-1] == (f"g.yaml: note: the acceleration of gravity of {said}\n" if doubted else "")


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ("by: rocker", "joint 'A' does not join 'rocker'; it joins crank and coupler"),
        ("on: rocker", "joint 'A' does not join 'rocker'; it joins crank and coupler"),
        ("on: crank, by: ground", "joint 'A' does not join 'ground'; it joins crank and coupler"),
        ("on: crank, by: crank", "'crank' exerts no reaction on itself; leave out on, or by"),
    ],
)
@pytest.mark.parametrize("quantity", ["reaction", "moment"])
def test_a_reaction_between_links_that_the_joint_does_not_join(
    run: Run, folder: Path, keys: str, says: str, quantity: str
) -> None:
    claim = f"answers:\n  - {{quantity: {quantity}, of: A, {keys}, value: 1}}\n"
    ran = run("check", with_answers(folder, claim))
    assert ran == (2, "", f"claims.yaml:33: {says}\n")


def test_a_case_that_cannot_be_read_is_no_pass(
    run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = folder / with_answers(folder, ANSWERS)
    (folder / "wrong.yaml").write_text("links: {ground: {}", encoding="utf-8")
    monkeypatch.setattr("dalembert.bundled.cases", lambda: {"right": right, "wrong": folder / "wrong.yaml"})
    ran = run("validate")
    assert ran.status == 1
    assert "wrong.yaml:1: this is not valid YAML" in ran.err
    assert ran.out.splitlines()[-1].startswith("FAILED: 2 problems, 1 of them not read, 10 answers, ")
    monkeypatch.setattr("dalembert.bundled.cases", lambda: {"right": right})
    assert run("validate").status == 0
    monkeypatch.setattr("dalembert.bundled.cases", dict)
    assert run("validate").out.splitlines()[-1].startswith("FAILED: 0 problems, 0 answers, ")


@pytest.mark.long
def test_this_installation(run: Run) -> None:
    ran = run("validate")
    assert only_progress(ran.err)
    assert ran.status == 0, ran.out
    *_, where, verdict = ran.out.splitlines()
    assert where.startswith("dalembert 0.1.0, Python 3.")
    assert verdict.startswith("PASSED: ")


def test_the_comparison_as_json(run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = folder / with_answers(folder, ANSWERS)
    monkeypatch.setattr("dalembert.bundled.cases", lambda: {"right": right})
    ran = run("validate", "--json", "-")
    printed = json.loads(ran.out)
    assert (ran.status, printed["passed"], printed["problems"], printed["not_read"]) == (0, True, 1, 0)
    assert len(printed["answers"]) == 10
    assert {"quantity", "published", "computed", "deviation", "ok"} <= printed["answers"][0].keys()
    (folder / "wrong.yaml").write_text("links: {ground: {}", encoding="utf-8")
    monkeypatch.setattr("dalembert.bundled.cases", lambda: {"right": right, "wrong": folder / "wrong.yaml"})
    ran = run("validate", "--json", "all.json")
    assert (ran.status, ran.out.splitlines()[-1][:18]) == (1, "FAILED: 2 problems")
    written = json.loads((folder / "all.json").read_text(encoding="utf-8"))
    assert (written["passed"], written["not_read"], written["answers"]) == (False, 1, printed["answers"])
    monkeypatch.setattr("dalembert.bundled.cases", lambda: {"right": 1 / 0})  # refused before the work
    again = run("validate", "--json", "all.json")
    assert (again.status, again.err) == (
        2,
        "all.json exists; name another file, or overwrite it: --force, in Python overwrite=True\n",
    )


def test_a_verdict_has_a_line_for_each_answer_and_its_counts(capsys: pytest.CaptureFixture[str]) -> None:
    from dalembert.grading.file_answers import check

    rows = check(da.load(examples()["rssr"]))
    _print_verdict(rows, 3, 1, 1.25, False)
    said = capsys.readouterr().out
    assert "effort of O, at 30 deg" in said
    assert "6 answers, 0 with an exact value; all met." in said
    assert said.endswith("FAILED: 3 problems, 1 of them not read, 6 answers, 1.2 s\n")
