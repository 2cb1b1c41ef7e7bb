"""A separate process that solves texts, so that one that takes too long or too much memory ends with a sentence."""

from __future__ import annotations

import base64
import gc
import json
import multiprocessing
import signal
import tempfile
import warnings
from collections.abc import Iterable
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple

from dalembert.arrays import Tree
from dalembert.errors import DalembertError

if TYPE_CHECKING:
    from dalembert.model.files.source import FileSource

SECONDS, REPORT_SECONDS, START_SECONDS = 5.0, 60.0, 60.0
"""Longest solution, longest report, and longest start of the process, which counts for neither."""
MEMORY = 4 << 30
"""Bytes of address space."""
IDLE = 0.3
"""Seconds without a question after which what an answer has left is freed."""


class Question(NamedTuple):
    """Request about a text: ``data`` of its page, its answers compared (``check``), or a file to download."""

    ask: str
    text: str
    form: str
    name: str
    static: bool = False
    friction: bool = True
    read: tuple[Tree, FileSource] | None = None
    """The text as it is read, where it is: parsing takes a quarter of a small answer."""
    of: str = ""
    """Text and options of the answer, sent with it."""

    def refusal(self, sentence: str, path: Iterable[str | int] = ()) -> Tree:
        """The answer where there is none: of page data what is missing, else an error."""
        return {"missing" if self.ask == "data" else "error": sentence, "path": [*path]}


class Solver:
    """The process, started when it is first needed and again after it was ended."""

    def __init__(self, seconds: float = SECONDS) -> None:
        self.seconds = seconds
        self._lock, self._process = Lock(), None
        self._pipe: Connection | None = None
        self._started = False

    def start(self) -> None:
        """Start the process, which takes a second, before the first request."""
        with self._lock:
            self._connection()

    def ask(self, question: Question) -> str:
        """The answer of one question, in JSON; a ``refusal`` where there is none."""
        with self._lock:
            limit = self.seconds if question.ask in ("data", "check") else REPORT_SECONDS
            try:
                pipe = self._connection()
                if not self._started and pipe.poll(START_SECONDS):
                    self._started = pipe.recv_bytes() == STARTED
                pipe.send(question)
                if self._started and pipe.poll(limit):
                    return pipe.recv_bytes().decode()
                reason = f"no answer within {limit:g} s"
            except (EOFError, OSError):
                reason = "the solver ended: out of memory"
            self._end()
            return written(question.refusal(f"{reason}; use fewer positions or a smaller mechanism"))

    def close(self) -> None:
        """End the process."""
        with self._lock:
            self._end()

    def _connection(self) -> Connection:
        if self._pipe is None:
            context = multiprocessing.get_context("spawn")
            self._pipe, there = context.Pipe()
            process: Any = context.Process(target=_serve, args=(there,), daemon=True)
            process.start()
            there.close()
            self._process = process
        return self._pipe

    def _end(self) -> None:
        if self._pipe is not None:
            self._pipe.close()
        if self._process is not None:
            self._process.kill()
            self._process.join()
        self._process = self._pipe = None
        self._started = False


STARTED = b"started"
"""What the process says once it can answer."""


def _serve(pipe: Connection) -> None:
    """Answers questions until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C ends the server, which ends this process
    warnings.simplefilter("ignore", RuntimeWarning)  # of texts half typed; the page has the sentence
    _limit_memory()
    _warm_up(pipe)
    collect_rarely()
    while True:
        try:
            if not pipe.poll(IDLE):
                gc.collect()
            question = pipe.recv()
            pipe.send_bytes(written(answered(question)).encode())
        except (EOFError, OSError):
            return


def collect_rarely() -> None:
    """What is imported is never looked at again for what can be freed, and new objects seldom: nearly all that an
    answer makes are needed until it is given."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000, 20, 20)


def written(answer: Tree) -> str:
    """An answer as text."""
    return json.dumps(answer, separators=(",", ":"))


def _warm_up(pipe: Connection) -> None:
    """Import what the first request needs, which is the start, and run one unless it has come."""
    from dalembert.model.library import template_text
    from dalembert.pages import page_data as _imported  # noqa: F401

    pipe.send_bytes(STARTED)
    if not pipe.poll():
        answered(Question("data", template_text("four_bar"), "yaml", "four_bar"))


def _limit_memory() -> None:
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    except (ImportError, OSError, ValueError):
        return  # not on this system


def answered(question: Question) -> Tree:
    """The answer of a question, in this process."""
    from dalembert.model.description import mechanism
    from dalembert.model.files.model_files import read_text

    try:
        m = mechanism(*(question.read or read_text(question.text, question.form, question.name)))
        if not question.friction:
            m = m.with_values({"friction.enabled": False})
        return _ASKED[question.ask](m, question)
    except DalembertError as error:
        what, remedy = getattr(error, "what", str(error)), getattr(error, "remedy", "")
        return question.refusal(f"{what}; {remedy}" if remedy else what, getattr(error, "path", ()))
    except MemoryError:
        return question.refusal("too little memory; use fewer positions or a smaller mechanism")
    except Exception as error:  # a fault of the program ends no session
        return question.refusal(f"the analysis failed ({type(error).__name__}); please report this file")


def _data(m: Any, question: Question) -> Tree:
    from dalembert.pages.page_data import page_data

    return {"data": page_data(m, question.static, quick=True)}


def _check(m: Any, _: Question) -> Tree:
    from dalembert.grading.file_answers import check

    rows = check(m)
    return {
        "rows": [
            {
                "quantity": r.quantity,
                "published": r.published,
                "computed": r.computed,
                "ok": r.ok,
                "why": r.why,
            }
            for r in rows
        ]
    }


def _report(m: Any, question: Question) -> Tree:
    from dalembert.analysis.solution import solve
    from dalembert.reports import report

    return _saved(report(solve(m, static=question.static)))


def _saved(written: Any) -> Tree:
    """The HTML of a report as a download."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "report.html"
        written.save(path)
        return _download(path.read_bytes(), "html")


def _design(m: Any, question: Question) -> Tree:
    from dalembert.machine.whole_cycle import solved_over_a_turn
    from dalembert.reports import report

    return _saved(report(solved_over_a_turn(m, question.static), design=True))


def _modes(m: Any, _: Question) -> Tree:
    from dalembert.studio.side_answers import assembly_modes

    return assembly_modes(m)


def _equilibria(m: Any, question: Question) -> Tree:
    from dalembert.model.files.model_files import read_text
    from dalembert.studio.side_answers import resting_positions

    tree, _ = question.read or read_text(question.text, question.form, question.name)
    return resting_positions(m, tree)


def _superposition(m: Any, question: Question) -> Tree:
    from dalembert.analysis.solution import solve
    from dalembert.studio.side_answers import shares

    return shares(solve(m, static=question.static))


def _page(m: Any, question: Question) -> Tree:
    from dalembert.pages.html_page import page

    return _download(page(m, static=question.static).encode(), "html")


def _download(content: bytes, ending: str) -> Tree:
    return {"file": base64.b64encode(content).decode(), "ending": ending}


_ASKED = {
    "data": _data,
    "check": _check,
    "report": _report,
    "design": _design,
    "page": _page,
    "modes": _modes,
    "equilibria": _equilibria,
    "superposition": _superposition,
}
ASKED = frozenset(_ASKED) - {"data"}
"""What a tab may ask for; the page's data come unasked."""
