"""The solver of the studio: seconds of an answer, its memory, and the sentence where there is no answer."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any

import pytest

from dalembert.errors import AnalysisError, ModelError
from dalembert.model.files.model_files import read_text
from dalembert.studio import solver
from dalembert.studio.problems import problem_text
from dalembert.studio.solver import Question, Solver, answered

FOUR_BAR = problem_text("example", "four_bar")


class Pipe:
    """A pipe that has some messages, and keeps what is sent."""

    def __init__(self, *messages: bytes, wait: bool = False) -> None:
        self.messages, self.sent, self.polled, self.wait = list(messages), list[Any](), list[Any](), wait

    def poll(self, seconds: float = 0.0) -> bool:
        self.polled.append(seconds)
        return bool(self.messages) and not self.wait

    def recv_bytes(self) -> bytes:
        if not self.messages:
            raise EOFError
        return self.messages.pop(0)

    def send(self, what: Any) -> None:
        self.sent.append(what)

    def send_bytes(self, what: bytes) -> None:
        self.sent.append(what)

    def recv(self) -> Any:
        if not self.messages:
            raise EOFError
        return self.messages.pop(0)

    def close(self) -> None:
        self.sent.append("closed")


def asked(kind: str, *messages: bytes) -> tuple[dict[str, Any], Pipe, Solver]:
    s, pipe = Solver(2.5), Pipe(*messages)
    s._pipe = pipe  # type: ignore[assignment]
    return json.loads(s.ask(Question(kind, "text", "yaml", "m"))), pipe, s


def test_a_question_has_its_seconds_after_the_start() -> None:
    for kind, limit in (("data", 2.5), ("check", 2.5), ("report", 60.0), ("page", 60.0)):
        answer, pipe, s = asked(kind, b"started", b'{"x": 1}')
        assert (answer, pipe.polled, s._started) == ({"x": 1}, [60.0, limit], True)
        answer, pipe, s = asked(kind, b"started")
        key = "missing" if kind == "data" else "error"
        said = f"no answer within {limit:g} s; use fewer positions or a smaller mechanism"
        assert answer == {key: said, "path": []}
        assert pipe.sent[-1] == "closed"
        assert (s._pipe, s._process, s._started) == (None, None, False)
    answer, pipe, _ = asked("check", b"other", b'{"x": 1}')
    assert answer["error"].startswith("no answer within 2.5 s;")
    assert Solver().seconds == 5.0

    class Broken(Pipe):
        def send(self, what: Any) -> None:
            raise OSError

    s = Solver()
    s._pipe = Broken(b"started")  # type: ignore[assignment]
    said = "the solver ended: out of memory; use fewer positions or a smaller mechanism"
    assert json.loads(s.ask(Question("report", "", "yaml", "m"))) == {"error": said, "path": []}


@pytest.mark.parametrize(
    ("error", "said", "path"),
    [
        (ModelError("a is wrong", "mend it", ("links", "a")), "a is wrong; mend it", ["links", "a"]),
        (ModelError("a is wrong"), "a is wrong", []),
        (AnalysisError("it jams"), "it jams", []),
        (MemoryError(), "too little memory; use fewer positions or a smaller mechanism", []),
        (KeyError("x"), "the analysis failed (KeyError); please report this file", []),
    ],
)
def test_a_question_that_fails_is_answered_with_a_sentence(
    error: Exception, said: str, path: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(m: Any, question: Question) -> Any:
        raise error

    for kind, key in (("data", "missing"), ("check", "error")):
        monkeypatch.setitem(solver._ASKED, kind, failing)
        assert answered(Question(kind, FOUR_BAR, "yaml", "m")) == {key: said, "path": path}


def test_a_question_is_asked_with_friction_unless_it_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(solver._ASKED, "check", lambda m, q: m.to_tree().get("friction"))
    assert answered(Question("check", FOUR_BAR, "yaml", "m")) is None
    assert answered(Question("check", FOUR_BAR, "yaml", "m", friction=False))["enabled"] is False
    read = read_text(FOUR_BAR.replace("Four-bar", "Read"), "yaml", "m")
    monkeypatch.setitem(solver._ASKED, "check", lambda m, q: {"title": m.title})
    assert answered(Question("check", "", "yaml", "m", read=read))["title"].startswith("Read")


def test_the_process_of_the_solver_answers_until_its_pipe_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    collector = SimpleNamespace(
        collect=lambda: done.append("collect"), freeze=lambda: done.append("freeze"),
        set_threshold=lambda *t: done.append(f"threshold {t}"),
    )  # fmt: skip
    monkeypatch.setattr(solver, "gc", collector)
    monkeypatch.setattr(solver.signal, "signal", lambda *a: done.append("signal"))
    monkeypatch.setattr(solver.warnings, "simplefilter", lambda *a: done.append("warnings"))
    monkeypatch.setattr(solver, "_limit_memory", lambda: done.append("memory"))
    monkeypatch.setattr(solver, "_warm_up", lambda pipe: done.append("warm"))
    monkeypatch.setattr(solver, "answered", lambda question: {"of": question})
    pipe = Pipe("one", "two")  # type: ignore[arg-type]
    solver._serve(pipe)  # type: ignore[arg-type]
    assert pipe.sent == [b'{"of":"one"}', b'{"of":"two"}']
    begun = ["signal", "warnings", "memory", "warm", "collect", "freeze", "threshold (100000, 20, 20)"]
    assert done == [*begun, "collect"], "what is left is freed where no question comes within 0.3 s"
    assert pipe.polled == [0.3] * 3


def test_a_process_warms_up_unless_a_question_has_come(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Question] = []
    monkeypatch.setattr(solver, "answered", asked.append)
    for wait, count in ((True, 1), (False, 0)):
        pipe = Pipe(b"a question", wait=wait)
        solver._warm_up(pipe)  # type: ignore[arg-type]
        assert pipe.sent == [b"started"]
        assert len(asked) == count
        asked.clear()


def test_the_memory_of_the_solver_is_four_gibibytes(monkeypatch: pytest.MonkeyPatch) -> None:
    resource = pytest.importorskip("resource")
    limits: list[Any] = []
    monkeypatch.setattr(resource, "setrlimit", lambda *a: limits.append(a))
    solver._limit_memory()
    assert limits == [(resource.RLIMIT_AS, (4 << 30, 4 << 30))]
    for error in (OSError(), ValueError()):

        def refuse(*_: Any, error: Exception = error) -> None:
            raise error

        monkeypatch.setattr(resource, "setrlimit", refuse)
        assert solver._limit_memory() is None  # type: ignore[func-returns-value]
