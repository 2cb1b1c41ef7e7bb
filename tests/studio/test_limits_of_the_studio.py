"""Limits of the studio: steps of undo, sizes of texts and files, messages that are refused, poses that are two."""

from __future__ import annotations

import asyncio
import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.errors import AnalysisError, ModelError
from dalembert.model.files.model_files import loads, read_text
from dalembert.studio import access, document, side_answers, stored_file
from dalembert.studio.access import FASTEST, Access, Rate
from dalembert.studio.document import EMPTY, LONGEST, Document, Reading
from dalembert.studio.problems import problem_text
from dalembert.studio.session import Session
from dalembert.studio.solver import Question, Solver
from dalembert.studio.stored_file import StoredFile
from dalembert.studio.tab_messages import read_message, sentence
from tests.studio.served import apart

FOUR_BAR = problem_text("example", "four_bar")


def refusal(act: Any) -> str:
    with pytest.raises(ModelError) as error:
        act()
    return str(error.value)


# the text and its history


def test_a_new_step_forgets_what_was_undone() -> None:
    d = Document("a: 1\n")
    assert d.can == (False, False)
    assert d.replace("a: 2\n")
    assert not d.replace("a: 2\n")
    assert d.can == (True, False)
    assert d.undo()
    assert d.can == (False, True)
    assert not d.undo()
    assert d.redo()
    assert d.text == "a: 2\n"
    d.undo()
    d.replace("a: 3\n")
    assert d.can == (True, False)
    assert not d.redo()
    assert d.undo()
    assert d.text == "a: 1\n"


def test_a_hundred_steps_are_kept_and_a_text_has_a_longest_length() -> None:
    d = Document("0")
    for k in range(1, 105):
        d.replace(str(k))
    assert sum(d.undo() for _ in range(200)) == 100
    assert d.text == "4"
    assert sum(d.redo() for _ in range(200)) == 100
    d.replace("x" * LONGEST)
    said = "the text has more than 256000 characters; keep large tables in a file beside it"
    assert refusal(lambda: d.replace("x" * (LONGEST + 1))) == said


def test_typed_edits_lie_within_the_text_and_beside_each_other() -> None:
    d = Document("abcdef")
    assert d.edit([(4, 6, "Z"), (0, 1, "X"), (1, 4, "")])
    assert d.text == "XZ"
    assert d.edit([(2, 2, "!")])
    assert not d.edit([])
    for wrong in ([(0, 4, "")], [(-1, 1, "")], [(2, 1, "")], [(0, 2, "a"), (1, 3, "b")]):
        assert refusal(lambda w=wrong: d.edit(w)) == "an edit is outside the text; reload the page"
    assert d.text == "XZ!"


class Wrong:
    """A gesture that ends with an error, or writes a text."""

    def __init__(self, what: Any) -> None:
        self.what = what

    def apply(self, d: Any) -> None:
        if isinstance(self.what, Exception):
            raise self.what
        d.text = self.what


@pytest.mark.parametrize(
    "error",
    [
        AssertionError(),
        AttributeError(),
        KeyError(),
        IndexError(),
        TypeError(),
        ValueError(),
        ZeroDivisionError(),
    ],
)
def test_a_gesture_that_does_not_fit_the_text_is_refused(error: Exception) -> None:
    d = Document(FOUR_BAR)
    said = "the text is written in a form that this gesture cannot change; edit the text"
    assert refusal(lambda: d.do(Wrong(error))) == said  # type: ignore[arg-type]
    with pytest.raises(AnalysisError, match="as it is"):
        d.do(Wrong(AnalysisError("as it is")))  # type: ignore[arg-type]
    assert d.can == (False, False)


def test_a_gesture_is_done_on_a_text_that_can_be_read_and_stays_so() -> None:
    d = Document(FOUR_BAR)
    broken = FOUR_BAR.replace("type: pin", "type: pn", 1)
    assert "pn" in refusal(lambda: d.do(Wrong(broken)))  # type: ignore[arg-type]
    assert d.text == FOUR_BAR
    longer = FOUR_BAR.replace("Four-bar", "Longer")
    d.do(Wrong(longer))  # type: ignore[arg-type]
    assert (d.text, d.can, d.reading.drawing["title"][:6]) == (longer, (True, False), "Longer")
    d.replace(broken)
    line = broken[: broken.index("type: pn")].count("\n") + 1
    said = f"line {line} of the text is wrong; correct it before you go on drawing"
    assert refusal(lambda: d.do(Wrong(FOUR_BAR))) == said  # type: ignore[arg-type]
    assert d.reading.drawing["title"][:6] == "Longer", "the drawing of the last good text stays"
    space = Document((Path(__file__).parents[1] / "model" / "rssr.yaml").read_text(encoding="utf-8"))
    said = "the studio draws plane mechanisms; edit the text of one in space"
    assert refusal(lambda: space.do(Wrong(FOUR_BAR))) == said  # type: ignore[arg-type]
    assert space.reading.drawing["space"] is True
    assert space.reading.sketch is None


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (
            OverflowError(),
            "a length or an angle of the file exceeds the range of numbers; correct it or its unit",
        ),
        (RuntimeError("x"), "the studio failed (RuntimeError); please report what you did"),
        (AnalysisError("it jams"), "it jams"),
        (ModelError("a", "b"), "a; b"),
    ],
)
def test_a_text_that_cannot_be_drawn_says_why(
    error: Exception, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: Any) -> Any:
        raise error

    monkeypatch.setattr(document, "mechanism", failing)
    before = Reading(None, None, {"title": "before"})
    for old, drawing in ((before, {"title": "before"}), (None, {})):
        found = document.read(FOUR_BAR, "yaml", "m", old)
        assert (found.mechanism, found.sketch, found.drawing, found.error, found.line) == (
            None,
            None,
            drawing,
            said,
            1,
        )


def test_a_ground_alone_has_no_sketch() -> None:
    reading = Document(EMPTY).reading
    assert (reading.alone, reading.sketch, reading.error) == (True, None, "")
    assert [link["name"] for link in reading.drawing["links"]] == ["ground"]
    assert not Document(FOUR_BAR).reading.alone
    assert Document("links: {ground: }\n").reading.alone


# files


def test_a_stored_file_has_a_largest_size_and_is_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    assert (file.read(), file.known, file.outside(), file.kept()) == (None, "", None, None)
    file.path.write_bytes(b"x" * LONGEST)
    assert file.outside() == "x" * LONGEST
    assert len(file.read() or "") == LONGEST
    assert file.outside() is None
    file.path.write_bytes(b"x" * (LONGEST + 1))
    said = "m.yaml has 256001 bytes, more than 256000; the studio takes smaller files; keep tables in a file beside it"
    assert refusal(file.read) == said
    file.path.write_bytes(b"\xff\xfe")
    assert refusal(file.read) == "m.yaml is not UTF-8 text; save it as UTF-8"

    def denied(path: Path) -> bytes:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", denied)
    assert refusal(file.read) == "m.yaml cannot be read: Permission denied; check its permissions"


def test_a_file_is_saved_over_what_was_read_and_keeps_a_side_file(tmp_path: Path) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    file.keep("a: 1\n")
    assert (file.side.name, file.kept()) == (".m.yaml.autosave", "a: 1\n")
    file.save("a: 1\n")
    assert not file.side.exists()
    file.keep("a: 1\n")
    assert file.kept() is None
    file.discard()
    file.discard()
    file.path.write_text("a: 2\n", encoding="utf-8")
    said = (
        "m.yaml was changed by another program after it was opened here; load what is on disk, or save under "
    )
    assert refusal(lambda: file.save("a: 3\n")) == said + "another name"
    for name in ("", "../a.yaml", "b/a.yaml", "b\\a.yaml", ".a.yaml", "a\0.yaml"):
        said = f"{name!r} is not the name of a file in this folder; give a name without a folder"
        assert refusal(lambda n=name: file.elsewhere(n)) == said
    said = "a.toml has another format than m.yaml; keep the ending of the name"
    assert refusal(lambda: file.elsewhere("a.toml")) == said
    assert refusal(lambda: file.elsewhere("m.yaml")) == "m.yaml exists; choose another name"
    assert file.elsewhere("n.yaml") == stored_file.StoredFile(tmp_path / "n.yaml")


# messages


def test_only_this_server_is_spoken_to(monkeypatch: pytest.MonkeyPatch) -> None:
    a = Access(81, "secret")
    assert a.address == "http://127.0.0.1:81/#secret"
    for headers, socket, said in (
        ({"host": "127.0.0.1:81"}, False, ""),
        ({"host": "localhost:81", "origin": "http://localhost:81"}, True, ""),
        ({"host": "127.0.0.1:81"}, True, "the origin of the page is missing"),
        ({"host": "127.0.0.1:82"}, False, "this server is 127.0.0.1:81, not '127.0.0.1:82'"),
        ({}, False, "this server is 127.0.0.1:81, not ''"),
        ({"host": "h" * 61}, False, f"this server is 127.0.0.1:81, not '{'h' * 60}'"),
        ({"host": "localhost:81", "origin": "https://localhost:81"}, False,
         "pages of 'https://localhost:81' may not speak to this server"),
        ({"host": "localhost:81", "origin": "o" * 61}, True, f"pages of '{'o' * 60}' may not speak to this server"),
    ):  # fmt: skip
        assert a.refused(headers, socket) == said
    assert [a.knows(t) for t in ("secret", "secre", "", None, 3, b"secret")] == [True, *[False] * 5]
    assert "ws://127.0.0.1:81;" in a.headers()["content-security-policy"]
    assert Access(81).token != Access(81).token
    assert len(Access(81).token) >= 43
    assert a.token not in repr(a)
    now = [0.0]
    monkeypatch.setattr(access, "monotonic", lambda: now[0])
    rate = Rate()
    assert not any(rate.too_fast() for _ in range(FASTEST))
    now[0] = 0.999
    assert rate.too_fast()
    now[0] = 1.0
    assert not rate.too_fast()


def test_messages_are_read_and_errors_said() -> None:
    assert read_message('{"a": [1, 2]}') == {"a": [1, 2]}
    for text in ("{", "[" * 100_000):
        assert refusal(lambda t=text: read_message(t)) == "the message is not JSON; reload the page"
    assert sentence(ModelError("a")) == "a"
    assert sentence(AnalysisError("jams")) == "jams"
    assert sentence(KeyError("x")) == "the studio failed (KeyError); please report what you did"


def test_a_message_says_one_thing(tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_text(FOUR_BAR, encoding="utf-8")
    s = Session(StoredFile(tmp_path / "m.yaml"))
    for message in ({}, {"undo": 1, "redo": 1}, [], 3, {"n": 3}):
        assert refusal(lambda m=message: s.handle(m)) == "the message cannot be read; reload the page"
    assert s.handle({"undo": 1, "n": 4}) == {}
    said = "the text has changed meanwhile; type it again"
    assert refusal(lambda: s.handle({"edit": [], "base": "other"})) == said
    for edit in ([[1, 2]], [["a", 2, "b"]], 3, [[math.inf, 1, ""]]):
        message = {"edit": edit, "base": s.document.hash}
        assert refusal(lambda m=message: s.handle(m)) == "the edit cannot be read; reload the page"
    pull: dict[str, Any] = {"link": "crank", "at": [0.1, 0.0], "path": [[0.1, 0.1]]}
    for wrong in (
        {"at": [0.1]},
        {"path": [[1]]},
        {"path": [[1, math.nan]]},
        {"at": [math.inf, 1]},
        {"at": None},
    ):
        message = {"pull": {**pull, **wrong}}
        assert refusal(lambda m=message: s.handle(m)) == "the pull cannot be read; reload the page"
    said = "this link cannot be pulled; choose a moving link"
    assert refusal(lambda: s.handle({"pull": {**pull, "link": "x"}})) == said
    s.handle({"options": {}})
    assert (s.static, s.friction) == (False, True)
    s.handle({"options": 3})
    s.handle({"options": {"static": 1, "friction": 0}})
    assert (s.static, s.friction) == (True, False)


# answers beside the page


def test_poses_that_differ_by_a_millionth_of_the_size_are_two(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(side_answers, "outline", lambda r: [np.zeros((2, 2)), np.array(r, float)])
    c: Any = SimpleNamespace(layout=SimpleNamespace(length=2.0))
    at = [[3.0, 5.0], [7.0, 11.0]]
    near, far = np.array(at), np.array(at)
    near[1, 0] -= 1.9e-6
    far[1, 0] -= 2.1e-6
    beyond = np.array(at)
    beyond[0, 1] += 1.0
    some: list[Any] = [at, near, far, beyond]
    assert [id(r) for r in side_answers.distinct(c, some)] == [id(at), id(far), id(beyond)]


def test_no_more_modes_and_rests_are_listed_than_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    m, (tree, _) = loads(FOUR_BAR), read_text(FOUR_BAR)
    monkeypatch.setattr(side_answers, "MOST", 1)
    assert [mode["here"] for mode in side_answers.assembly_modes(m)["modes"]] == [True]
    resting = side_answers.resting_positions(m, tree)
    assert (resting["drive"], resting["count"], len(resting["rows"])) == ("O2", 2, 1)


def test_an_answer_that_fails_in_the_server_is_a_sentence(tmp_path: Path) -> None:
    pytest.importorskip("starlette")
    from dalembert.studio.server import StudioServer, joined

    class Failing(Solver):
        def ask(self, question: Question) -> str:
            raise ModelError("it is broken", "mend it")

    told: list[Any] = []

    class Tab:
        async def send_text(self, text: str) -> None:
            told.append(json.loads(text))

    async def act() -> None:
        studio = StudioServer(lambda: None, Access(1), Failing())  # type: ignore[arg-type, return-value]
        studio.session = Session(StoredFile(tmp_path / "m.yaml"))
        tab: Any = Tab()
        studio.tabs[tab] = 3
        studio._ask(tab, 7, "check")
        assert studio.tabs[tab] == 4
        with pytest.raises(
            ModelError, match="earlier questions are not yet answered; wait for their answers"
        ):
            studio._ask(tab, 8, "check")
        await asyncio.gather(*studio._answers)
        assert studio.tabs[tab] == 3
        assert studio._answers == set()

    apart(lambda: asyncio.run(act()))
    (message,) = told
    assert (message["n"], message["ask"], message["error"]) == (7, "check", "it is broken; mend it")
    assert joined({"a": 1}, '{"b":2}') == '{"a":1,"b":2}'
