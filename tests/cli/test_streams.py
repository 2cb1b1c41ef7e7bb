"""Standard input, pipes, devices and files with several names: read once, and never replaced by another file."""

from __future__ import annotations

import io
import os
import stat
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.model import load, tree_text
from tests.cli.conftest import Run
from tests.tiers import tiers

pytestmark = pytest.mark.skipif(os.name == "nt", reason="pipes and devices as POSIX has them")

FOUR_BAR = load(examples()["four_bar"])
PLATE = "{forces: {F: {value: 600 @ 90 N}}}"
ANSWERS = "\nanswers: [{quantity: effort, of: O2, value: 243.23 lbf*in, tolerance: 0.01 %}]\n"
COMMANDS = {
    "solve": ["solve", "FILE"],
    "check": ["check", "FILE"],
    "check-answers": ["check-answers", "FILE", "mine.yaml"],
    "charts": ["draw", "FILE", "--view", "charts", "-o", "out.svg"],
    "report": ["report", "FILE", "-o", "out.txt"],
    "convert": ["convert", "FILE", "-o", "out.json"],
    "wrench": ["wrench", "FILE"],
}


@contextmanager
def pipe(path: Path, content: bytes) -> Iterator[None]:
    """A named pipe from which the content can be read once."""
    os.mkfifo(path)
    writer = threading.Thread(target=path.write_bytes, args=(content,), daemon=True)
    writer.start()
    yield
    writer.join(5)
    assert not writer.is_alive(), "it was not read"


@pytest.mark.parametrize("command", tiers([c for c in COMMANDS if c != "report"], ["report"]))
def test_every_command_reads_standard_input_and_pipes(
    run: Run, folder: Path, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "mine.yaml").write_text("efforts: {O2: 243.23 lbf*in}")
    content = (PLATE if command == "wrench" else (folder / "four_bar.yaml").read_text() + ANSWERS).encode()
    (folder / "whole.yaml").write_bytes(content)
    expected = run(*(word.replace("FILE", "whole.yaml") for word in COMMANDS[command]))
    assert expected.status == 0
    made = list(folder.glob("out.*"))
    written = [path.read_bytes() for path in made]
    for source in ("-", "piped"):
        for path in made:
            path.unlink()
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(content)))
        arguments = [word.replace("FILE", source) for word in COMMANDS[command]]
        if source == "piped":
            with pipe(folder / "piped", content):
                ran = run(*arguments)
        else:
            ran = run(*arguments)
        name = "standard input" if source == "-" else source
        assert (ran.status, ran.err, ran.out) == (0, expected.err, expected.out.replace("whole.yaml", name))
        assert [path.read_bytes() for path in made] == written


@pytest.mark.parametrize("form", ["yaml", "json", "toml"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_the_format_of_a_stream_is_seen_in_its_text(
    run: Run, form: str, mark: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = mark + tree_text({"links": {"ground": {}, "bar": {"mas": "2 kg"}}}, form)
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    ran = run("solve", "-")
    lines = {"yaml": 3, "json": 5, "toml": 4}
    assert ran.err == (
        f"standard input:{lines[form]}: unknown key 'mas' in link 'bar'; did you mean 'mass'?\n"
    )
    assert ran.status == 2


@pytest.mark.parametrize("output", ["-", "/dev/stdout"])
def test_a_file_on_the_screen(run: Run, output: str) -> None:
    assert run("new", "four_bar", "-o", output) == run("new", "four_bar")
    ran = run("draw", "four_bar.yaml", "-o", output)
    assert ran.err.startswith("stdout: the ending names no kind of drawing; use one of .svg")


@pytest.mark.parametrize("option", [["--xlsx", "-"], ["--netcdf=-"]])
def test_what_is_no_text_does_not_go_to_the_screen(run: Run, folder: Path, option: list[str]) -> None:
    ran = run("solve", "four_bar.yaml", *option)
    assert (ran.status, ran.out) == (2, "")
    assert "on the screen, which is not text; name a file" in ran.err


def test_standard_output_that_takes_no_more_is_named(folder: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("there is no /dev/full")
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "dalembert", "schema"], stdout=full, stderr=subprocess.PIPE, cwd=folder
        )
    assert (done.returncode, done.stderr) == (2, b"standard output: no space left on device\n")


Write = Callable[[Path], Any]


@cache
def solved() -> Any:
    return da.dynamics(FOUR_BAR)


WRITERS: dict[str, Write] = {
    "model.yaml": lambda path: FOUR_BAR.save(path, overwrite=True),
    "converted.json": lambda path: da.convert(examples()["four_bar"], path, overwrite=True),
    "answer.json": lambda path: solved().to_json(path, overwrite=True),
    "answer.csv": lambda path: solved().to_csv(path, overwrite=True),
    "drawing.svg": lambda path: da.draw.mechanism(solved()).save(path, overwrite=True),
    "report.txt": lambda path: da.report(solved()).save(path, overwrite=True),
}
SLOW: dict[str, Write] = {
    "report.tex": lambda path: da.report(solved()).save(path, overwrite=True),
    "answer.xlsx": lambda path: solved().to_xlsx(path, overwrite=True),
    "answer.nc": lambda path: solved().to_netcdf(path, overwrite=True),
    "model.glb": lambda path: da.draw.solid_model(da.dynamics(FOUR_BAR, positions=2)).save(
        path, overwrite=True
    ),
    "drawing.dxf": lambda path: da.draw.mechanism(solved()).save(path, overwrite=True),
    "drawing.pdf": lambda path: da.draw.mechanism(solved()).save(path, overwrite=True),
    "drawing.png": lambda path: da.draw.mechanism(solved()).save(path, overwrite=True),
    "report.html": lambda path: da.report(solved()).save(path, overwrite=True),
    "report.pdf": lambda path: da.report(solved()).save(path, overwrite=True),
}
EVERY = pytest.mark.parametrize("name", tiers(WRITERS, SLOW))


def read_by_another(path: Path, write: Callable[[], Any]) -> bytes:
    """What comes out of a named pipe while something is written into it."""
    found: list[bytes] = []
    reader = threading.Thread(target=lambda: found.append(path.read_bytes()), daemon=True)
    reader.start()
    write()
    reader.join(5)
    return found[0]


@EVERY
def test_a_pipe_and_a_file_with_two_names_stay_what_they_are(tmp_path: Path, name: str) -> None:
    write = {**WRITERS, **SLOW}[name]
    path, other, link = tmp_path / name, tmp_path / "other", tmp_path / f"link-{name}"
    path.write_bytes(b"mine" * 100_000)
    other.hardlink_to(path)
    link.symlink_to(path.name)
    for target in (path, link):
        other.write_bytes(b"mine")
        write(target)
        assert other.read_bytes() == path.read_bytes() != b"mine"
        assert other.samefile(path)
        assert link.is_symlink()
    os.mkfifo(tmp_path / f"pipe-{name}")
    came = read_by_another(tmp_path / f"pipe-{name}", lambda: write(tmp_path / f"pipe-{name}"))
    assert stat.S_ISFIFO((tmp_path / f"pipe-{name}").stat().st_mode)
    assert came[:4] == path.read_bytes()[:4]
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(
        [name, "other", f"link-{name}", f"pipe-{name}"]
    )


@EVERY
def test_a_device_stays_a_device(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 3))  # as /dev/null
        path.open("wb").close()
    except OSError as error:
        pytest.skip(f"no device can be made here: {error}")
    {**WRITERS, **SLOW}[name](path)
    assert stat.S_ISCHR(path.stat().st_mode)
    assert [*tmp_path.iterdir()] == [path]


def test_a_socket_is_refused(run: Run, folder: Path) -> None:
    import socket

    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind("out.csv")
        ran = run("solve", "four_bar.yaml", "--csv", "out.csv", "--force")
        assert ran.err == "out.csv is a socket; name a file\n"
        assert stat.S_ISSOCK(Path("out.csv").stat().st_mode)


def test_a_pipe_needs_no_force(run: Run, folder: Path) -> None:
    os.mkfifo("out.csv")
    came = read_by_another(Path("out.csv"), lambda: run("solve", "four_bar.yaml", "--csv", "out.csv"))
    assert came.startswith(b"position,status")


def test_a_second_name_keeps_what_was_there_where_writing_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from dalembert import saving

    path = tmp_path / "four.yaml"
    path.write_bytes(b"mine")
    (tmp_path / "other").hardlink_to(path)
    write_all, calls = saving._write_all, []

    def full(file: Any, content: bytes) -> None:
        calls.append(content)
        if len(calls) == 1:
            file.write(content[:50])
            raise OSError(28, "No space left on device")
        write_all(file, content)

    monkeypatch.setattr(saving, "_write_all", full)
    with pytest.raises(da.ModelError, match="no space left on device"):
        FOUR_BAR.save(path, overwrite=True)
    assert path.read_bytes() == b"mine"
    assert len(calls) == 2


def test_a_case_may_come_through_a_pipe(run: Run, folder: Path) -> None:
    """A file with a mesh or answers is read once too."""
    content = next(iter(cases().values())).read_bytes()
    with pipe(folder / "case.yaml", content):
        assert run("check", "case.yaml").status == 0
