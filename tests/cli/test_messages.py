"""What a wrong file or command line is answered with, word for word; always exit status 2, never a traceback."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.cli.conftest import Run


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["solve"], "dalembert: solve needs FILE; see `dalembert solve --help`"),
        (["solve", "none.yaml"], "none.yaml:1: there is no file none.yaml; check the name and the folder"),
        (
            ["solve", "four_bar.yml"],
            "four_bar.yml:1: there is no file four_bar.yml; did you mean 'four_bar.yaml'?",
        ),
        (
            ["solve", "four_bar.yaml", "--bogus"],
            "dalembert: unknown option: --bogus; see `dalembert solve --help`",
        ),
        (["solve", "four_bar.yaml", "--positions", "0"], "--positions is 0; give 1 or more"),
        (
            ["solve", "four_bar.yaml", "--positions", "many"],
            'dalembert: invalid value for --positions: unable to convert "many" into int; see `dalembert solve --help`',
        ),
        (
            ["solve", "four_bar.yaml", "--units", "imperial"],
            'dalembert: invalid value "imperial" for --units. Choose from: "si", "file"; see `dalembert solve --help`',
        ),
        (
            ["solve", "four_bar.yaml", "--json", "--csv"],
            "--json needs the name of a file; or - to print it: --json -",
        ),
        (
            ["solve", "four_bar.yaml", "--json", "-", "--csv", "-"],
            "--json - and --csv - both ask for the screen; name a file for one of them",
        ),
        (
            ["slove", "four_bar.yaml"],
            'dalembert: unknown command "slove". Did you mean "solve"? Available commands: solve, draw, report,'
            " check, check-answers, validate, schema, new; see `dalembert --help`",
        ),
        (
            ["draw", "four_bar.yaml"],
            "dalembert: draw needs --output; see `dalembert draw --help`",
        ),
        (
            ["report", "four_bar.yaml"],
            "dalembert: report needs --output; see `dalembert report --help`",
        ),
        (["check"], "check needs a file or a folder; for example: dalembert check four_bar.yaml"),
        (["examples", "four_bra"], "there is no example 'four_bra'; did you mean 'four_bar'?"),
        (["new", "four_bra"], "there is no template 'four_bra'; did you mean 'four_bar'?"),
        (
            ["convert", "four_bar.yaml"],
            "dalembert: convert needs --output; see `dalembert convert --help`",
        ),
        (
            ["convert", "four_bar.yaml", "-o", "four_bar.txt"],
            "four_bar.txt is named like no model file; end its name with .yaml, .json or .toml",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_wrong_command_lines(run: Run, arguments: list[str], said: str) -> None:
    assert run(*arguments) == (2, "", said + "\n")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "weight: 1.5",
            "wieght: 1.5",
            "10: there is no key 'wieght' in link 'crank'; did you mean 'weight'?",
        ),
        (
            "A: [5, 0]",
            "A: [5 lbf, 0]",
            "10: item 1 of point 'A' of link 'crank': '5 lbf' is a force, and a length is needed; write one, for "
            "example '127 mm'",
        ),
        (
            "links: [ground, rocker]",
            "links: [ground, rockr]",
            "22: joint 'O4' names the link 'rockr', which is not there; did you mean 'rocker'?",
        ),
        (
            "speed: 25 rad/s",
            "speed: 25",
            "25: speed of drive 'O2': 25 is an angular speed without a unit; write which: rad/s, deg/s or rpm",
        ),
        (
            "  O2: {position: 60 deg",
            "  O3: {position: 60 deg",
            "25: drive 'O3' drives the joint 'O3', which is not there; choose among O2, A, B, O4",
        ),
        (
            "drives:\n  O2: {position: 60 deg, speed: 25 rad/s, acceleration: -40 rad/s^2}\n",
            "",
            "18: the mechanism has 1 freedom and no drive; add 1 drive at one of O2 (turn), A (turn), B (turn), "
            "O4 (turn), or join the links that still move: crank, coupler, rocker",
        ),
    ],
)
def test_wrong_files_are_named_with_the_line(
    run: Run, edited: Callable[..., str], old: str, new: str, said: str
) -> None:
    assert run("solve", edited((old, new))) == (2, "", f"edited.yaml:{said}\n")


def test_broken_text_is_named_with_the_line(run: Run, edited: Callable[..., str]) -> None:
    ran = run("solve", edited(("gravity: none", "gravity: [")))
    assert (ran.status, ran.out) == (2, "")
    assert ran.err.startswith("edited.yaml:8: it is not YAML here: ")
