"""The server speaks to its own page on this machine, and to nobody else; every refusal is a sentence."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.studio.access import LARGEST, TABS, Access, Rate
from dalembert.studio.document import EMPTY, text_hash
from dalembert.studio.problems import problem_text, problems
from dalembert.studio.session import _DOES as DOES
from dalembert.studio.session import Session
from dalembert.studio.solver import Question, Solver
from dalembert.studio.stored_file import StoredFile
from tests.studio.served import apart, serving

httpx = pytest.importorskip("httpx")
client = pytest.importorskip("websockets.sync.client")
FOUR_BAR = problem_text("example", "four_bar")


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Any]:
    with serving(tmp_path / "m.yaml") as served:
        yield served


@contextmanager
def tab(studio: Any, token: object = None, origin: str = "") -> Iterator[Any]:
    """A socket that has said its token."""
    access = studio.access
    own = f"http://{access.hosts[0]}"
    with client.connect(f"ws://{access.hosts[0]}/tab", origin=origin or own, max_size=2**22) as ws:
        ws.send(json.dumps({"token": access.token if token is None else token}))
        yield ws


def until(ws: Any, key: str) -> Any:
    """The next message with a key."""
    while True:
        told = json.loads(ws.recv(timeout=20))
        if key in told:
            return told


def test_only_the_page_of_this_host_is_served(studio: Any) -> None:
    address, evil = f"http://{studio.access.hosts[0]}", {"host": "evil.example"}
    for headers, path, code, said in (
        ({}, "/", 200, "studio.js"),
        (evil, "/", 403, "not 'evil.example'"),
        (evil, "/anything", 403, "not 'evil.example'"),
        ({"origin": "http://evil.example"}, "/studio.js", 403, "may not speak"),
        ({}, "/../../etc/passwd", 404, "nothing here"),
        ({}, "/%2e%2e/pyproject.toml", 404, "nothing here"),
    ):
        answer = httpx.get(address + path, headers=headers)
        assert (answer.status_code, said in answer.text) == (code, True), (headers, path)
        assert studio.access.token not in answer.text
    policy = httpx.get(address + "/").headers
    assert "frame-ancestors 'none'" in policy["content-security-policy"]
    assert policy["x-content-type-options"] == "nosniff"
    assert httpx.post(address + "/").status_code in (404, 405)


def test_a_socket_needs_the_token_and_the_origin(studio: Any) -> None:
    wrong = [("wrong", "", "has no token"), (3, "", "has no token")]
    for origin in ("http://evil.example", "http://127.0.0.1:1", "null"):
        wrong.append((studio.access.token, origin, "may not speak"))
    for token, origin, said in wrong:
        with tab(studio, token, origin) as ws:
            assert said in until(ws, "refused")["refused"]
            with pytest.raises(Exception, match="4403"):
                ws.recv(timeout=5)
    assert not studio.tabs


MALFORMED = [
    "{",
    "[]",
    "{}",
    "[" * 100_000,
    '{"do": 3}',
    '{"do": {"op": "bar"}}',
    '{"do": {"op": "delete", "kind": "links", "name": "x", "more": 1}}',
    json.dumps({"edit": [["a", 2]], "base": text_hash(EMPTY)}),
    json.dumps({"edit": [[0, 99999, ""]], "base": text_hash(EMPTY)}),
    '{"edit": [[0, 0, "x"]], "base": "of another text"}',
    '{"open": {"kind": "problem", "name": "../../pyproject"}}',
    '{"save": "../elsewhere.yaml"}',
    '{"pull": {"link": "ground", "at": [0, 0], "path": [[1, 1]]}}',
    '{"undo": true, "redo": true}',
]


def test_malformed_messages_are_refused_and_change_nothing(studio: Any, tmp_path: Path) -> None:
    with tab(studio) as ws:
        until(ws, "text")
        for message in (*MALFORMED, b"\xff\x00", '{"ask": {}}', '{"edit": [[Infinity, 0, ""]]}'):
            ws.send(message)
            assert until(ws, "text")["text"] == EMPTY
            assert len(until(ws, "refused")["refused"]) > 15, message[:80]
    assert list(tmp_path.glob("*")) == []


def test_a_huge_message_and_too_many_end_the_tab(studio: Any) -> None:
    with tab(studio) as ws:
        until(ws, "text")
        ws.send(json.dumps({"edit": [[0, 0, "#" * 300_000]], "base": text_hash(EMPTY)}))
        assert "more than 256000" in until(ws, "refused")["refused"]
        ws.send("x" * (LARGEST + 1))
        with pytest.raises(Exception, match="1009"):
            until(ws, "never")
    rate = Rate()
    assert [rate.too_fast() for _ in range(302)].index(True) == 300


def test_tabs_agree_and_the_last_text_is_solved(studio: Any) -> None:
    with tab(studio) as one, tab(studio) as two:
        for ws in (one, two):
            until(ws, "text")
        one.send(json.dumps({"open": {"kind": "example", "name": "four_bar"}}))
        assert until(two, "data")["hash"] == until(one, "data")["hash"] == text_hash(FOUR_BAR)
        two.send(json.dumps({"n": 7, "undo": True}))
        assert until(two, "text")["text"] == EMPTY
        assert until(two, "n")["n"] == 7
        assert until(one, "text")["text"] == EMPTY
        assert "press B" in until(one, "missing")["missing"]
    assert len(studio.tabs) <= TABS


def test_forces_are_told_with_the_hash_of_the_text_they_are_of(tmp_path: Path) -> None:
    """Also where a gesture comes while the forces of the text before it are computed."""
    from dalembert.studio.server import StudioServer

    asked, told, release = list[str](), list[Any](), Event()

    class Slow(Solver):
        def ask(self, question: Question) -> str:
            asked.append(question.text)
            release.wait(10)
            return json.dumps({"data": question.text})

    class Tab:
        async def send_text(self, text: str) -> None:
            told.append(json.loads(text))
            if "n" in told[-1]:  # a tab that takes its reply slowly: the solver ends meanwhile
                release.set()
                await asyncio.sleep(0.2)

    async def run() -> None:
        session = Session(StoredFile(tmp_path / "m.yaml"))
        session.document.replace(FOUR_BAR)
        server = StudioServer(lambda: session, Access(1), Slow())
        ws: Any = Tab()
        server.tabs[ws] = 0
        running = asyncio.create_task(server._run())
        await server._begun.wait()
        server._wanted.set()
        while not asked:
            await asyncio.sleep(0.01)
        message = {"n": 1, "edit": [[0, 0, "# one line more\n"]], "base": session.document.hash}
        await server._message(ws, json.dumps(message))
        while not any("data" in m for m in told):
            await asyncio.sleep(0.01)
        running.cancel()

    apart(lambda: asyncio.run(run()))
    assert len(asked) == 2
    assert asked[0] != asked[1]
    assert [text_hash(m["data"]) for m in told if "data" in m] == [m["hash"] for m in told if "data" in m]
    assert [m["data"] for m in told if "data" in m] == asked[1:]


def test_a_question_is_answered_of_the_text_it_was_asked_of_and_holds_up_no_gesture(tmp_path: Path) -> None:
    release = Event()

    class Slow(Solver):
        def ask(self, question: Question) -> str:
            release.wait(10)
            return json.dumps({"rows": question.text})

    with serving(tmp_path / "m.yaml", solver=Slow()) as served, tab(served) as ws:
        first = until(ws, "text")
        for n in range(6):
            ws.send(json.dumps({"n": n, "ask": "check"}))
        assert "not yet answered" in until(ws, "refused")["refused"]
        ws.send(json.dumps({"n": 9, "edit": [[0, 0, "# more\n"]], "base": first["hash"]}))
        after = until(ws, "text")
        while after["text"] == EMPTY:
            after = until(ws, "text")
        release.set()
        answers = [until(ws, "rows") for _ in range(4)]
        assert [(a["n"], a["of"], a["rows"]) for a in answers] == [
            (n, first["analysed"], EMPTY) for n in range(4)
        ]
        ws.send(json.dumps({"n": 10, "ask": "check"}))
        again = until(ws, "rows")
        assert (again["of"], again["rows"]) == (after["analysed"], after["text"])
        ws.send(json.dumps({"n": 11, "options": {"static": True}}))
        assert until(ws, "text")["analysed"] not in (first["analysed"], after["analysed"])


def test_a_text_that_came_with_a_fault_is_told_and_solved_too(
    studio: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def choose(session: Session, *_: Any) -> None:
        session.document.replace(FOUR_BAR)
        raise OSError("the disk is gone")

    monkeypatch.setitem(DOES, "choose", choose)
    with tab(studio) as one, tab(studio) as two:
        for ws in (one, two):
            until(ws, "text")
        one.send(json.dumps({"choose": "disk"}))
        for ws in (one, two):
            while until(ws, "text")["text"] != FOUR_BAR:
                pass
            assert until(ws, "data")["hash"] == text_hash(FOUR_BAR)


def test_it_saves_reloads_and_never_overwrites(studio: Any, tmp_path: Path) -> None:
    path, side = tmp_path / "m.yaml", tmp_path / ".m.yaml.autosave"
    with tab(studio) as ws:
        until(ws, "text")
        ws.send(json.dumps({"open": {"kind": "example", "name": "four_bar"}}))
        end = time.monotonic() + 20
        while not side.exists() and time.monotonic() < end:
            time.sleep(0.05)
        assert side.read_text(encoding="utf-8") == FOUR_BAR, "kept within two seconds"
        again = Session(StoredFile(path))
        assert (again.document.text, again.kept, again.dirty) == (FOUR_BAR, FOUR_BAR, True)
        ws.send(json.dumps({"n": 1, "save": True}))
        assert until(ws, "said")["said"] == "Saved as m.yaml"
        path.write_text(FOUR_BAR + "# outside\n", encoding="utf-8")
        while until(ws, "text")["text"] != FOUR_BAR + "# outside\n":
            pass
        ws.send(json.dumps({"edit": [[0, 0, "# mine\n"]], "base": text_hash(FOUR_BAR + "# outside\n")}))
        path.write_text("# theirs\n" + FOUR_BAR, encoding="utf-8")
        while not until(ws, "outside")["outside"]:
            pass
        ws.send(json.dumps({"save": True}))
        assert "changed by another program" in until(ws, "refused")["refused"]
        assert path.read_text(encoding="utf-8") == "# theirs\n" + FOUR_BAR
        ws.send(json.dumps({"choose": "mine"}))
        ws.send(json.dumps({"n": 2, "save": True}))
        until(ws, "said")
        assert path.read_text(encoding="utf-8").startswith("# mine\n")


@pytest.mark.long
def test_the_solver_is_ended_after_its_time_and_works_again() -> None:
    solver = Solver(seconds=0.0)
    asked = Question("data", FOUR_BAR, "yaml", "m.yaml")

    def answer(**changed: Any) -> Any:
        return json.loads(solver.ask(asked._replace(**changed)))

    assert "no answer within 0 s" in answer()["missing"]
    solver.seconds = 60.0
    assert answer()["data"]["title"] == "Four-bar linkage, dynamic"
    assert "no drive" in answer(text="links: {a: {points: {A: [0, 0], B: [1, 0]}}}")["missing"]
    assert answer(ask="page")["ending"] == "html"
    solver.close()


def test_every_bundled_problem_can_be_opened() -> None:
    texts = [problem_text(p["kind"], p["name"]) for p in problems()]
    assert len(texts) > 150
    assert all("links" in text for text in texts)


def test_a_file_that_cannot_be_read_ends_the_studio_with_the_reason(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from dalembert.studio.launch import run

    wrong = tmp_path / "m.yaml"
    wrong.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ModelError, match=r"m.yaml is not UTF-8 text"):
        apart(lambda: run(wrong, browser=False))
    assert "http://127.0.0.1:" in capsys.readouterr().out


@pytest.mark.long
@pytest.mark.parametrize("typing", [0.1, 1.3])
def test_killed_at_any_moment_the_file_is_intact_and_the_side_file_a_text_that_was_typed(
    tmp_path: Path, typing: float
) -> None:
    path, side = tmp_path / "m.yaml", tmp_path / ".m.yaml.autosave"
    path.write_text(FOUR_BAR, encoding="utf-8")
    command = [sys.executable, "-m", "dalembert", "studio", str(path), "--no-browser"]
    texts = [FOUR_BAR]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as served:
        assert served.stdout is not None
        own, token = served.stdout.readline().split(": ")[1].strip().split("/#")
        with client.connect(own.replace("http", "ws") + "/tab", origin=own, max_size=2**22) as ws:
            ws.send(json.dumps({"token": token}))
            until(ws, "text")
            end = time.monotonic() + typing
            while time.monotonic() < end or (typing > 1 and not side.exists()):
                now = texts[-1]
                ws.send(json.dumps({"base": text_hash(now), "edit": [[len(now), len(now), "# more\n"]]}))
                texts.append(until(ws, "text")["text"])
                assert texts[-1] == now + "# more\n"
            served.kill()
    assert path.read_text(encoding="utf-8") == FOUR_BAR
    again = Session(StoredFile(path))
    assert again.document.text in texts
    assert (again.kept is not None) == side.exists() >= (typing > 1)
    assert {p.name for p in tmp_path.iterdir()} <= {path.name, side.name}
