"""Messages of a tab one by one: what they do to the document and its file, and what is answered."""

from __future__ import annotations

import socket
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.studio.access import HOST
from dalembert.studio.document import EMPTY, Document
from dalembert.studio.editing.gestures import gesture
from dalembert.studio.launch import run, unused_name
from dalembert.studio.problems import problem_text
from dalembert.studio.session import Session
from dalembert.studio.stored_file import StoredFile

FOUR_BAR = problem_text("example", "four_bar")


@pytest.fixture
def session(tmp_path: Path) -> Session:
    (tmp_path / "m.yaml").write_text(FOUR_BAR, encoding="utf-8")
    return Session(StoredFile(tmp_path / "m.yaml"))


def state(s: Session, *keys: str) -> list[Any]:
    told = s.state()
    return [told[key] for key in keys]


def test_what_is_opened_saved_and_undone_is_told(session: Session, tmp_path: Path) -> None:
    keys = "file", "dirty", "undo", "redo", "static", "friction", "kept", "outside", "error", "line", "form"
    assert state(session, *keys) == ["m.yaml", *[False] * 4, True, False, False, "", 0, "yaml"]
    session.handle({"open": "empty"})
    assert state(session, "text", "dirty", "undo", "redo") == [EMPTY, True, True, False]
    session.handle({"undo": True})
    assert state(session, "text", "dirty", "undo", "redo") == [FOUR_BAR, False, False, True]
    session.handle({"redo": True})
    session.look()
    assert (tmp_path / ".m.yaml.autosave").read_text(encoding="utf-8") == EMPTY
    assert session.handle({"save": "other.yaml"}) == {"said": "Saved as other.yaml"}
    assert session.document.name == str(tmp_path / "other.yaml")
    assert state(session, "file", "dirty") == ["other.yaml", False]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["m.yaml", "other.yaml"]
    assert (tmp_path / "m.yaml").read_text(encoding="utf-8") == FOUR_BAR
    plain = session.analysed
    session.handle({"options": {"static": True, "friction": False}})
    assert state(session, "static", "friction", "analysed") == [True, False, f"{plain} static frictionless"]
    asked = session.question("check")
    assert (asked.ask, asked.text, asked.static, asked.friction) == ("check", EMPTY, True, False)


def test_of_two_versions_one_is_chosen(session: Session, tmp_path: Path) -> None:
    path, theirs = tmp_path / "m.yaml", FOUR_BAR + "# theirs\n"
    path.write_text(theirs, encoding="utf-8")
    assert session.look(), "nothing here is lost: it is read"
    assert state(session, "text", "dirty", "outside") == [theirs, False, False]
    assert not session.look()
    session.handle({"open": "empty"})
    path.write_text(FOUR_BAR, encoding="utf-8")
    assert session.look()
    assert state(session, "text", "outside") == [EMPTY, True]
    session.handle({"choose": "disk"})
    assert state(session, "text", "dirty", "outside") == [FOUR_BAR, False, False]
    session.handle({"open": "empty"})
    path.write_text(theirs, encoding="utf-8")
    session.look()
    session.handle({"choose": "mine"})
    assert state(session, "text", "dirty", "outside") == [EMPTY, True, False]
    session.handle({"save": True})
    assert path.read_text(encoding="utf-8") == EMPTY


def test_what_an_earlier_run_did_not_save_is_kept_or_forgotten(session: Session, tmp_path: Path) -> None:
    session.handle({"open": "empty"})
    session.look()
    for choice, text in (("kept", EMPTY), ("forget", FOUR_BAR)):
        again = Session(StoredFile(tmp_path / "m.yaml"))
        assert state(again, "text", "kept", "dirty") == [EMPTY, True, True]
        again.handle({"choose": choice})
        assert state(again, "text", "kept") == [text, False]
    assert not (tmp_path / ".m.yaml.autosave").exists()


def test_a_pull_goes_on_from_the_last_one_and_leaves_the_text(session: Session) -> None:
    """The crank turns to where it is pulled; its drive follows; a new pull begins at the text's pose."""
    at = [5 * 0.0254, 0.0]
    far, back, down = [0.0, 9.0], [-9.0, 0.0], [0.0, -9.0]
    first = session.handle({"pull": {"link": "crank", "at": at, "path": [far]}})
    assert first["pose"]["crank"][2] == pytest.approx(np.pi / 2, abs=0.1)
    assert first["drives"]["O2"] == pytest.approx(first["pose"]["crank"][2])
    session.handle({"pull": {"link": "crank", "at": at, "path": [back]}})
    on = session.handle({"pull": {"link": "crank", "at": at, "path": [down], "on": True}})
    anew = session.handle({"pull": {"link": "crank", "at": at, "path": [down]}})
    assert on["pose"]["crank"][2] == pytest.approx(3 * np.pi / 2, abs=0.1), "round by the left"
    assert anew["pose"]["crank"][2] == pytest.approx(-np.pi / 2, abs=0.1)
    assert session.document.text == FOUR_BAR
    last = session.handle({"pull": {"link": "crank", "at": at, "path": ["far", *[far] * 8]}})
    assert last["pose"]["crank"][2] == pytest.approx(np.pi / 2, abs=0.1), "of the last eight places"
    unread = {"link": "crank", "at": at, "path": ["far", *[far] * 7]}
    endless = {"link": "crank", "at": at, "path": [[float("inf"), 0.0]]}
    for wrong in (
        {"link": "crank", "at": [float("nan"), 0], "path": [far]},
        {"link": "crank"},
        3,
        unread,
        endless,
    ):
        with pytest.raises(ModelError, match="the pull cannot be read; reload the page"):
            session.handle({"pull": wrong})
    with pytest.raises(ModelError, match="this link cannot be pulled; choose a moving link"):
        session.handle({"pull": {"link": "ground", "at": at, "path": [far]}})


@pytest.mark.parametrize(
    ("message", "sentence"),
    [
        ({"edit": [[0, 0, "x"]], "base": "other"}, "the text has changed meanwhile; type it again"),
        ({"undo": True, "redo": True}, "the message cannot be read; reload the page"),
        ([], "the message cannot be read"),
        ({"open": {"kind": "template", "name": "none"}}, "'none' is not a bundled template"),
    ],
)
def test_a_message_that_says_nothing_is_refused(message: Any, sentence: str, session: Session) -> None:
    with pytest.raises(ModelError, match=sentence):
        session.handle(message)
    with pytest.raises(ModelError, match="the edit cannot be read"):
        session.handle({"edit": [["a", 0, "x"]], "base": session.document.hash})
    assert session.document.text == FOUR_BAR


def test_a_text_that_gestures_cannot_change_says_so() -> None:
    ground = gesture({"op": "ground", "where": {"at": [0.0, 0.0]}})
    space = Document(problem_text("example", "rssr"))
    assert space.reading.drawing["space"]
    with pytest.raises(ModelError, match="the studio draws plane mechanisms; edit the text of one in space"):
        space.do(ground)
    copies = FOUR_BAR + "copies: {c: {of: [rocker], turn: 90 deg}}\n"
    with pytest.raises(ModelError):
        Document(copies).do(ground)
    with pytest.raises(
        ModelError, match="the text has more than 256000 characters; keep large tables in a file"
    ):
        Document().replace("#" * 256_001)
    assert not Document().replace(EMPTY)


def test_a_new_mechanism_has_a_name_that_is_free(tmp_path: Path) -> None:
    assert unused_name(tmp_path).name == "mechanism.yaml"
    for name in ("mechanism.yaml", "mechanism_2.yaml"):
        (tmp_path / name).touch()
    assert unused_name(tmp_path).name == "mechanism_3.yaml"
    with socket.create_server((HOST, 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(ModelError, match=f"port {port} cannot be used; choose another one, or leave"):
            run(tmp_path / "m.yaml", port=port, browser=False)
