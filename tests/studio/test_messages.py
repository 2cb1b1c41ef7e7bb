"""Whatever comes in from a tab, the server answers, keeps its document, and touches no file but its own."""

from __future__ import annotations

import asyncio
import contextlib
import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

from dalembert.errors import DalembertError
from dalembert.studio.access import Access
from dalembert.studio.problems import problem_text
from dalembert.studio.session import Session
from dalembert.studio.solver import Question, Solver
from dalembert.studio.stored_file import StoredFile
from tests.studio.messages_at_random import text_of_message
from tests.studio.served import apart
from tests.tiers import tiers

pytest.importorskip("starlette")


class Nobody(Solver):
    """A solver that has no answer."""

    def ask(self, question: Question) -> str:
        return '{"error": "nobody solves here"}'


class Tab:
    """What a tab is told."""

    def __init__(self) -> None:
        self.told: list[Any] = []

    async def send_text(self, text: str) -> None:
        self.told.append(json.loads(text))


async def flooded(file: Path, seed: int, count: int) -> Session:
    """A session after messages at random; every one is answered, and a refusal is a sentence."""
    from dalembert.studio.server import StudioServer

    session, r, tab = Session(StoredFile(file)), Random(seed), Tab()
    studio = StudioServer(lambda: session, Access(1), Nobody())
    studio.session = session
    ws: Any = tab
    studio.tabs[ws] = 0
    for k in range(count):
        text = text_of_message(r, session.document)
        tab.told.clear()
        await studio._message(ws, text)
        async with asyncio.timeout(20):  # a question is answered later
            while not tab.told:
                await asyncio.sleep(0)
        for told in tab.told:
            refused = told.get("refused", "no matter of words, and long enough")
            assert len(refused) > 15, text[:300]
            assert "failed" not in refused, (refused, text[:300])
        reading = session.document.reading
        assert (reading.mechanism is None) == bool(reading.error), text[:300]
        assert reading.line >= bool(reading.error)
        if k % 10 == 0:
            with contextlib.suppress(
                DalembertError
            ):  # a text that cannot be written, such as half a character
                session.look()
    return session


async def told_beside_a_deaf_tab(file: Path) -> tuple[list[Any], int]:
    """What a tab is told while another one does not read, and how many tabs are left."""
    from dalembert.studio.server import StudioServer

    class Deaf(Tab):
        async def send_text(self, text: str) -> None:
            await asyncio.sleep(60)

    studio, tab = StudioServer(lambda: Session(StoredFile(file)), Access(1), Nobody()), Tab()
    studio.session = studio.begin()
    studio.tabs.update(dict.fromkeys((Deaf(), tab), 0))  # type: ignore[call-overload]
    ws: Any = tab
    await studio._message(ws, '{"n": 1, "open": {"kind": "template", "name": "four_bar"}}')
    return tab.told, len(studio.tabs)


def test_a_tab_that_does_not_read_keeps_no_other_from_its_answers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("dalembert.studio.server.PATIENCE", 0.05)
    told, left = apart(lambda: asyncio.run(told_beside_a_deaf_tab(tmp_path / "m.yaml")))
    assert [message.get("n") for message in told] == [None, 1]
    assert "four" in told[0]["text"].lower()
    assert left == 1


class Faulty(Solver):
    """A solver with a fault at its first question."""

    asked = 0

    def ask(self, question: Question) -> str:
        self.asked += 1
        if self.asked == 1:
            raise RuntimeError("a fault")
        return '{"missing": "solved again"}'


async def told_of_faults(file: Path) -> list[str]:
    """What is said of a solver with a fault and of a look at the disk with one, and what of the next text."""
    from dalembert.studio.server import StudioServer

    studio, tab = StudioServer(lambda: Session(StoredFile(file)), Access(1), Faulty()), Tab()
    ws: Any = tab
    studio.tabs[ws] = 0
    running = asyncio.create_task(studio._run())
    await studio._begun.wait()
    said = list[str]()
    for key, change in (
        ("missing", {"open": {"kind": "template", "name": "four_bar"}}),
        ("missing", {"options": {"static": True}}),
        ("refused", {"open": {"kind": "template", "name": "slider_crank"}}),
    ):
        tab.told.clear()
        if key == "refused":
            look, studio.session.look = studio.session.look, lambda: 1 // 0  # type: ignore[method-assign]
        await studio._message(ws, json.dumps({"n": 1, **change}))
        while not (found := [x[key] for x in tab.told if key in x]):
            await asyncio.sleep(0.01)
        said.append(found[0])
    studio.session.look = look  # type: ignore[method-assign]
    while studio.session.file.side.read_text(encoding="utf-8") != studio.session.document.text:
        await asyncio.sleep(0.01)
    assert not running.done()
    running.cancel()
    return said


def test_a_fault_of_the_program_is_a_sentence_and_the_next_text_is_solved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("dalembert.studio.server.LOOK", 0.01)
    report = "the studio failed ({}); please report what you did"
    told = apart(lambda: asyncio.run(asyncio.wait_for(told_of_faults(tmp_path / "m.yaml"), 30)))
    assert told == [
        report.format("RuntimeError"),
        "solved again",
        report.format("ZeroDivisionError"),
    ]


@pytest.mark.parametrize("count", tiers([120], [300], [10_000]))
def test_no_message_ends_the_server_or_leaves_its_folder(tmp_path: Path, count: int) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "m.yaml").write_text(problem_text("template", "four_bar"), encoding="utf-8")
    session = apart(lambda: asyncio.run(flooded(folder / "m.yaml", count, count)))
    assert [p.name for p in tmp_path.iterdir()] == ["mine"]
    ours = {"m.yaml", "other.yaml", ".m.yaml.autosave", ".other.yaml.autosave"}
    assert {p.name for p in folder.iterdir()} <= ours | {session.file.path.name, session.file.side.name}
