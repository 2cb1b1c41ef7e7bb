"""The command as a process of its own: start, pipes, signals, exit status."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from dalembert.bundled import examples

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
    assert done.stderr == "none.yaml:1: there is no file none.yaml; check the name and the folder\n"


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


@pytest.mark.parametrize("moment", ["made", "written"])
def test_interruption_is_quiet_and_leaves_nothing(tmp_path: Path, moment: str) -> None:
    arguments = ["solve", FOUR_BAR, "--csv", str(tmp_path / "out.csv")]
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, moment, *arguments], capture_output=True, timeout=HANGS
    )
    assert (done.returncode, done.stderr) == (130, b"")
    assert list(tmp_path.iterdir()) == []


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
        assert (process.returncode, err) == (130, b"")
    assert set(tmp_path.iterdir()) <= {path}
