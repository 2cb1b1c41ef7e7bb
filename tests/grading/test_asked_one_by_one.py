"""The dialogue of `check-answers --interactive`: every question in its words, and how the replies are read."""

from __future__ import annotations

from pathlib import Path

import pytest

import dalembert as da
from dalembert.cli import main


def dialogue(
    m: da.Mechanism, replies: list[str], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> tuple[int, list[str]]:
    """Exit status, and the questions; behind the last reply the input ends."""
    asked, left = [], iter(replies)

    def answered(question: str) -> str:
        asked.append(question)
        for reply in left:
            return reply
        raise EOFError

    monkeypatch.setattr("builtins.input", answered)
    m.save(folder / "m.yaml")
    return main(["check-answers", str(folder / "m.yaml"), "--interactive"]), asked


FORM = " (a number, or with its unit; empty to skip): "


@pytest.mark.long
def test_in_space_a_force_is_three_numbers_in_brackets_or_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    m = da.rssr().with_values({"drives.O.position": "1 rad"})
    r = da.dynamics(m)
    forces = [", ".join(f"{x:.5g}" for x in r.reaction(j)[0]) for j in ("O", "A", "B", "C")]
    replies = [f" {float(r.effort('O')[0]):.5g} N*m ", f"[{forces[0]}]", "", forces[2], "1, 2, 3"]
    status, asked = dialogue(m, replies, tmp_path, monkeypatch)
    assert asked == [
        f"Effort of O{FORM}",
        "Joint O, force of ground on crank (x, y, z): ",
        "Joint A, force of crank on rod (x, y, z): ",
        "Joint B, force of rod on rocker (x, y, z): ",
        "Joint C, force of ground on rocker (x, y, z): ",
    ]
    said = capsys.readouterr().out
    assert status == 1
    rows = {line.partition("  ")[0]: line.split()[-1] for line in said.splitlines() if " of " in line[:14]}
    assert [row for row in rows if row.startswith(("effort", "reaction"))][:4] == [
        "effort of O",
        "reaction of O",
        "reaction of B",
        "reaction of C",
    ]
    assert said.endswith("reaction of C: none of the usual mistakes explains it.\n3 of 4 right.\n")


LEVER = """links:
  ground: {points: {O: [0, 0]}}
  lever: {points: {O: [0, 0], P: [2, 0], Q: [1, 0]}}
joints: {O: {type: pin, links: [ground, lever]}}
drives: {O: {position: 0 deg, effort: 0}}
loads:
  F: {type: force, on: lever, at: P, value: [0, -30]}
  U: {type: force, on: lever, at: Q, direction: 90 deg, value: unknown}
"""


@pytest.mark.parametrize(("pin", "right"), [("30 N @ 270 deg", 3), ("[0, -30]", 3), ("0, 30", 2), ("30", 3)])
def test_in_the_plane_a_force_is_a_size_with_its_angle_or_two_components(
    pin: str, right: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The unknown load balances twice its own arm; the pin what is left, downwards on the lever."""
    status, asked = dialogue(da.loads(LEVER), ["0", "60 N", pin], tmp_path, monkeypatch)
    assert asked == [f"Effort of O{FORM}", "Load U: ", "Joint O, force of ground on lever (size @ angle): "]
    said = capsys.readouterr().out
    assert said.endswith(f"{right} of 3 right.\n")
    assert status == (right < 3)


def test_the_end_of_the_input_leaves_the_rest_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    status, asked = dialogue(da.loads(LEVER), ["", "60"], tmp_path, monkeypatch)
    assert (status, len(asked)) == (0, 3)
    assert capsys.readouterr().out == (
        "\nanswer             yours  computed  verdict\n"
        "-------------------------------------------\n"
        "unknown load of U     60        60    right\n\n1 of 1 right.\n"
    )
