"""What a wrong file or command line is answered with, word for word; always exit status 2, never a traceback."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.cli.conftest import Run


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["solve"], "dalembert: solve needs FILE; see `dalembert solve --help`"),
        (["solve", "none.yaml"], "none.yaml: file not found"),
        (
            ["report", "none.yaml", "-o", "a.docx"],  # before any work
            "a.docx: reports cannot be written in this format; use one of .pdf .html .tex .txt",
        ),
        (
            ["solve", "four_bar.yml"],
            "four_bar.yml: file not found; did you mean 'four_bar.yaml'?",
        ),
        (
            ["solve", "four_bar.yaml", "--xyzzy"],
            "dalembert: unknown option: --xyzzy; see `dalembert solve --help`",
        ),
        *(
            (
                ["solve", "four_bar.yaml", "--positions", text],
                f"dalembert: invalid value for --positions: '{text}' is not an integer of 1 or more; "
                "see `dalembert solve --help`",
            )
            for text in ("0", "-3", "2.5", "many")
        ),
        *(
            (
                ["report", "four_bar.yaml", "-o", "a.txt", f"--{option}", text],
                f"dalembert: invalid value for --{option}: '{text}' is not an integer from {least} to 15; "
                "see `dalembert report --help`",
            )
            for option, text, least in (("figures", "0", 1), ("figures", "40", 1), ("decimals", "-1", 0))
        ),
        (
            ["report", "four_bar.yaml", "-o", "a.txt", "--about", "O3"],
            "unknown joint 'O3' to take moments about; choose among O2, A, B, O4",
        ),
        (
            ["draw", "four_bar.yaml", "-o", "a.svg", "--at", "60", "deg"],
            "dalembert: 'deg' is an unexpected argument; quote arguments with spaces; see `dalembert draw --help`",
        ),
        (
            ["draw", "four_bar.yaml", "-o", "a.gif", "--view", "charts"],
            "a.gif: .gif holds an animation of the mechanism, and not charts; write .svg, .pdf or .png, or ask for "
            "--view animation",
        ),
        (["solve", "four_bar.yaml", "--csv", "."], ". is a folder; name a file in it"),
        (
            ["solve", "four_bar.yaml", "--csv", "a.xlsx"],
            "--csv a.xlsx: that is the name of another kind of file; end it with .csv, or write --xlsx a.xlsx",
        ),
        (
            ["solve", "four_bar.yaml", "--csv", "a", "--json", "a"],
            "--csv a: that is the file of --json already; name another file",
        ),
        (
            ["solve", "four_bar.yaml", "--json", "four_bar.yaml", "--force"],
            "--json four_bar.yaml: that is the model file; name another file",
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
            "dalembert: unknown command 'slove'; did you mean 'solve'? See `dalembert --help`",
        ),
        (
            ["Shaking", "four_bar.yaml"],
            "dalembert: unknown command 'Shaking'; did you mean 'shake'? See `dalembert --help`",
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
        (["examples", "four_bra"], "unknown example 'four_bra'; did you mean 'four_bar'?"),
        (
            ["new", "four_bar", "-o", "a.json"],
            "a.json is not named like YAML, which this is; end its name with .yaml; `dalembert convert` writes JSON "
            "and TOML",
        ),
        (["new", "four_bra"], "unknown template 'four_bra'; did you mean 'four_bar'?"),
        (
            ["convert", "four_bar.yaml"],
            "convert needs one output file; write dalembert convert FILE OUT",
        ),
        (
            ["convert", "four_bar.yaml", "-o", "four_bar.txt"],
            "four_bar.txt: '.txt' is not an extension of model files; use .yaml, .json or .toml",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_wrong_command_lines(run: Run, arguments: list[str], said: str) -> None:
    assert run(*arguments) == (2, "", said + "\n")


def test_virtual_work_needs_something_that_moves(run: Run) -> None:
    run("examples", "truss", "-o", "truss.yaml")
    assert run("solve", "truss.yaml", "--method", "virtual-work") == (
        2,
        "",
        "virtual work needs a drive, and this structure does not move; leave --method out\n",
    )


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "weight: 1.5",
            "wieght: 1.5",
            "10: unknown key 'wieght' in link 'crank'; did you mean 'weight'?",
        ),
        (
            "A: [5, 0]",
            "A: [5 lbf, 0]",
            "10: item 1 of point 'A' of link 'crank': '5 lbf' is a force, but a length is needed; write one, for "
            "example '127 mm'",
        ),
        (
            "links: [ground, rocker]",
            "links: [ground, rockr]",
            "22: joint 'O4' names the link 'rockr', which does not exist; did you mean 'rocker'?",
        ),
        (
            "speed: 25 rad/s",
            "speed: 25",
            "25: speed of drive 'O2': 25 is an angular speed without a unit; write rad/s, deg/s or rpm",
        ),
        (
            "  O2: {position: 60 deg",
            "  O3: {position: 60 deg",
            "25: drive 'O3' drives the joint 'O3', which does not exist; choose among O2, A, B, O4",
        ),
        (
            "drives:\n  O2: {position: 60 deg, speed: 25 rad/s, acceleration: -40 rad/s^2}\n",
            "",
            "18: the mechanism has 1 degree of freedom and no drive; add 1 drive at one of O2 (turn), A (turn), "
            "B (turn), O4 (turn), or constrain the links that can still move: crank, coupler, rocker",
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
    assert ran.err.startswith("edited.yaml:8: this is not valid YAML: ")
