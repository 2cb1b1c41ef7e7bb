"""The command as a process of its own: start, pipes, signals, exit status."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

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


def test_interruption_is_quiet(tmp_path: Path) -> None:
    """Interrupted while it writes; where it was done before it could be, it is given more to write."""
    path = tmp_path / "out.csv"
    for positions in ("30000", "100000", "300000"):
        command = [*COMMAND, "solve", FOUR_BAR, "--positions", positions, "--csv", str(path)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            while not any(tmp_path.iterdir()) and process.poll() is None:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=HANGS)
        if process.returncode:
            break
        path.unlink()
    assert (process.returncode, err) == (130, b"")
    assert list(tmp_path.iterdir()) == []
