"""Progress on a terminal and in a pipe, its words and when they come, at a clock of its own."""

from __future__ import annotations

import io
import sys
from typing import Any

import pytest

from dalembert import progress


class Finished:
    """Ends a work after so many pauses; every pause moves the clock."""

    def __init__(self, pauses: int) -> None:
        self.left, self.now, self.waited = pauses, 0.0, list[float]()

    def wait(self, seconds: float) -> bool:
        self.waited.append(seconds)
        self.now += seconds
        self.left -= 1
        return self.left < 0


def printed(
    state: dict[str, Any], pauses: int, monkeypatch: pytest.MonkeyPatch
) -> tuple[list[str], list[float]]:
    out, finished = io.StringIO(), Finished(pauses)
    monkeypatch.setattr(sys, "stderr", out)
    monkeypatch.setattr(progress, "monotonic", lambda: finished.now)
    progress._print_lines({"description": "Solving", "total": None, "start": 0} | state, finished)
    return out.getvalue().splitlines(), finished.waited


def test_lines_in_a_pipe_come_more_and_more_seldom(monkeypatch: pytest.MonkeyPatch) -> None:
    lines, waited = printed({"completed": 3}, 9, monkeypatch)
    assert lines == [f"Solving: {t} so far" for t in ("5 s", "15 s", "35 s", "75 s", "2 min")]
    assert waited == [1, 1, 1, 1, 1, 10, 20, 40, 60, 60]


def test_long_work_begins_with_an_estimate_and_short_work_says_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lines, waited = printed({"completed": 4, "total": 80}, 3, monkeypatch)
    assert lines == [
        "Solving: 80 take about 20 s, by the first 4",
        "Solving: 4 of 80, 40.0 per minute, 2 min left",
        "Solving: 4 of 80, 15.0 per minute, 5 min left",
    ]
    assert waited == [1, 5, 10, 20]
    assert printed({"completed": 40, "total": 80}, 3, monkeypatch) == ([], [1, 1, 1, 1])
    assert printed({"completed": 3}, 0, monkeypatch) == ([], [1])


@pytest.mark.parametrize("total", [None, 8])
def test_a_terminal_shows_what_is_done_until_the_work_ends(
    total: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.setenv("TERM", "xterm")
    for pauses, shown in ((0, False), (2, True)):
        out, finished = Terminal(), Finished(pauses)
        monkeypatch.setattr(sys, "stderr", out)
        monkeypatch.setattr(progress, "monotonic", lambda now=finished: now.now)
        state = {"completed": 4, "description": "Solving [a]", "total": total, "start": 0}
        progress._show(state, finished)
        assert ("Solving [a]" in out.getvalue()) == shown
        assert (total is not None and "6.7 per second, 1 s left" in out.getvalue()) == (
            shown and total is not None
        )
    assert finished.waited == [0.5, 0.1, 0.1]


def test_progress_without_a_standard_error_is_silent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", None)
    with progress.progress("Solving", 3) as step:
        step(1, "a", total=4, start=2)
