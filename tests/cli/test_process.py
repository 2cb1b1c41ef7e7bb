"""The command as a process of its own: start, pipes, signals, exit status."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import dalembert.progress
from dalembert.bundled import examples
from tests.tiers import tiers

COMMAND = [sys.executable, "-m", "dalembert"]
FOUR_BAR = str(examples()["four_bar"])
HANGS = 300
"""Seconds behind which a process that takes 2 is said to hang: far more, for machines that are busy."""


def test_status_and_streams() -> None:
    done = subprocess.run(
        [*COMMAND, "solve", FOUR_BAR], capture_output=True, text=True, stdin=subprocess.DEVNULL
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "243.2376 lbf*in" in done.stdout
    assert "\x1b" not in done.stdout
    done = subprocess.run([*COMMAND, "solve", "none.yaml"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "none.yaml: file not found\n"


@pytest.mark.long
def test_a_reader_that_goes_away_is_no_error() -> None:
    command = [*COMMAND, "solve", FOUR_BAR, "--positions", "5000", "--csv", "-"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.readline()
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(HANGS) == 0


INTERRUPTED = """
import os, pathlib, signal, sys
from dalembert.cli import main

def interrupting(done):
    def call(*arguments, **named):
        result = done(*arguments, **named)
        if "out" in str(arguments[0]):
            os.kill(os.getpid(), signal.SIGINT)
        return result
    return call

os.open, pathlib.Path.chmod = {
    "made": (interrupting(os.open), pathlib.Path.chmod),
    "written": (os.open, interrupting(pathlib.Path.chmod)),
}[sys.argv[1]]
raise SystemExit(main(sys.argv[2:]))
"""
"""The command that is sent SIGINT as soon as the new file is there, or when all is written but not yet in its place."""


WRITING = {
    "csv": ["solve", FOUR_BAR, "--csv"],
    "xlsx": ["solve", FOUR_BAR, "--xlsx"],
    "nc": ["solve", FOUR_BAR, "--netcdf"],
    "json": ["solve", FOUR_BAR, "--json"],
    "svg": ["draw", FOUR_BAR, "-o"],
    "png": ["draw", FOUR_BAR, "--view", "mechanism", "-o"],
    "gif": ["draw", FOUR_BAR, "--positions", "3", "-o"],
    "glb": ["draw", FOUR_BAR, "--positions", "3", "-o"],
    "dxf": ["draw", FOUR_BAR, "-o"],
    "pdf": ["report", FOUR_BAR, "-o"],
    "tex": ["report", FOUR_BAR, "-o"],
    "yaml": ["new", "four_bar", "-o"],
    "toml": ["convert", FOUR_BAR, "-o"],
}
"""Ending -> the command that writes such a file."""


@pytest.mark.parametrize(
    "case",
    tiers(
        [("csv", "written")],
        [
            ("csv", "made"),
            *((ending, moment) for ending in list(WRITING)[1:] for moment in ("made", "written")),
        ],
    ),
)
def test_interruption_is_quiet_and_leaves_nothing(tmp_path: Path, case: tuple[str, str]) -> None:
    ending, moment = case
    arguments = [*WRITING[ending], str(tmp_path / f"out.{ending}")]
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, moment, *arguments], capture_output=True, timeout=HANGS
    )
    assert (done.returncode, done.stderr) == (130, b"")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.long
def test_a_signal_from_outside_ends_long_work_quietly(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    command = [*COMMAND, "solve", FOUR_BAR, "--positions", "60000", "--csv", str(path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        while not any(tmp_path.iterdir()) and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=HANGS)
    if path.exists():  # it was done before the signal came: then the file is whole
        assert len(path.read_text().splitlines()) > 60_000
    else:
        assert process.returncode == 130
        assert all(
            line.startswith((b"Solving", b"Writing")) for line in err.splitlines()
        )  # progress of slow work
    assert set(tmp_path.iterdir()) <= {path}


WITHIN_EXEC = """
import dalembert.cli
def run(arguments):
    exec("raise KeyboardInterrupt")
dalembert.cli._run = run
raise SystemExit(dalembert.cli.main([]))
"""


def test_a_signal_within_exec_ends_with_the_same_status(tmp_path: Path) -> None:
    (tmp_path / "within_exec.py").write_text(WITHIN_EXEC, encoding="utf-8")
    command = [sys.executable, "-m", "within_exec"]
    done = subprocess.run(command, capture_output=True, timeout=HANGS, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (130, b"")


ON_A_TERMINAL = """
import os, signal, sys, time
import dalembert.progress, dalembert.analysis.solution as solution
dalembert.progress.DELAY = float(sys.argv[1])
solved = solution.dynamics
def slowly(*arguments, **named):
    time.sleep(0.6)
    if sys.argv[2] == "interrupted":
        os.kill(os.getpid(), signal.SIGINT)
    return solved(*arguments, **named)
solution.dynamics = slowly
from dalembert.cli import main
raise SystemExit(main(sys.argv[3:]))
"""
"""The command with an analysis that takes its time, behind this many seconds of silence."""


def on_a_terminal(folder: Path, delay: float, end: str) -> tuple[int, str, bytes]:
    """Exit status, standard output in a file, and what a terminal as standard error has got."""
    import pty

    ours, theirs = pty.openpty()
    command = [sys.executable, "-c", ON_A_TERMINAL, str(delay), end, "solve", FOUR_BAR]
    command += ["--csv", str(folder / "out.csv")]
    with open(folder / "printed", "w") as printed:
        environment = {**os.environ, "TERM": "xterm", "COLUMNS": "80"}
        done = subprocess.run(command, stdout=printed, stderr=theirs, timeout=HANGS, env=environment)
    os.close(theirs)
    got = b""
    try:
        while chunk := os.read(ours, 65536):
            got += chunk
    except OSError:  # how Linux says that nothing comes any more
        pass
    os.close(ours)
    return done.returncode, (folder / "printed").read_text(encoding="utf-8"), got


@pytest.mark.skipif(os.name == "nt", reason="terminals as POSIX has them")
@pytest.mark.parametrize(
    "case",
    tiers([(0.0, "interrupted", True)], [(0.0, "whole", True), (30.0, "whole", False)]),
)
def test_long_work_shows_itself_on_a_terminal_only(tmp_path: Path, case: tuple[float, str, bool]) -> None:
    delay, end, shown = case
    status, printed, got = on_a_terminal(tmp_path, delay, end)
    assert (b"Solving " in got) == shown
    assert (b"\x1b[2K" in got) == shown, "the line is wiped"
    if end == "interrupted":
        assert (status, printed) == (130, "")
        assert b"Traceback" not in got
        assert not (tmp_path / "out.csv").exists()
    else:
        assert status == 0
        assert "243.2376 lbf*in" in printed
        assert "\x1b" not in printed
        assert len((tmp_path / "out.csv").read_text().splitlines()) == 2
    assert {p.name for p in tmp_path.iterdir()} <= {"out.csv", "printed"}


@pytest.mark.parametrize(
    ("environment", "title"),
    [
        ({"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}, "Антрия ×"),
        pytest.param(
            {"PYTHONIOENCODING": "cp1252"}, r"\u0410\u043d\u0442\u0440\u0438\u044f ×", marks=pytest.mark.long
        ),
    ],
)
def test_what_a_pipe_is_written_in(environment: dict[str, str], title: str, tmp_path: Path) -> None:
    """UTF-8, whatever the system's encoding; one that was asked for writes what it lacks by numbers."""
    text = Path(FOUR_BAR).read_text(encoding="utf-8").replace("Four-bar linkage, dynamic", "Антрия ×")
    (tmp_path / "m.yaml").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [*COMMAND, "solve", str(tmp_path / "m.yaml")], capture_output=True, env={**os.environ, **environment}
    )
    assert done.returncode == 0
    assert done.stdout.decode(environment.get("PYTHONIOENCODING", "utf-8")).startswith(title)


class Waits:
    """Stands for the end of some work, that comes after a number of waits."""

    def __init__(self, count: int) -> None:
        self.left, self.pauses = count, list[float]()

    def wait(self, seconds: float) -> bool:
        self.left -= 1
        self.pauses.append(seconds)
        return self.left < 0


def test_slow_work_says_in_a_pipe_how_fast_it_is_and_what_is_left(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = iter([0.0, 1.0, 2.0, 10.0, 40.0])
    state = {"completed": 0, "description": "Studying", "total": 1200, "start": 0}

    def now() -> float:
        seconds = next(clock)
        state["completed"] = 0 if seconds < 2 else 40 if seconds == 2 else 300
        return seconds

    monkeypatch.setattr(dalembert.progress, "monotonic", now)
    work = Waits(4)
    dalembert.progress._print_lines(state, work)
    lines = capsys.readouterr().err.splitlines()
    assert lines == [
        "Studying: 1,200 take about 60 s, by the first 40",
        "Studying: 300 of 1,200, 30.0 per second, 30 s left",
        "Studying: 300 of 1,200, 7.5 per second, 2 min left",
    ]
    assert work.pauses[1] < work.pauses[2] < work.pauses[3] < work.pauses[4]


def test_short_work_in_a_pipe_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    with dalembert.progress.progress("Solving", 2) as step:
        step(1)
    assert capsys.readouterr().err == ""
