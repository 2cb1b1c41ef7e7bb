"""A studio served in this process, and its solver too."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from typing import Any, TypeVar

import pytest

from dalembert.studio.access import HOST, LARGEST, Access
from dalembert.studio.session import Session
from dalembert.studio.solver import Question, Solver, answered, written
from dalembert.studio.stored_file import StoredFile

T = TypeVar("T")


class Here(Solver):
    """Answers in this process."""

    def ask(self, question: Question) -> str:
        return written(answered(question))


def apart(act: Callable[[], T]) -> T:
    """What an act returns that runs an event loop: in a thread, as this one may have the loop of a browser."""
    with ThreadPoolExecutor(1) as one:
        return one.submit(act).result()


@contextmanager
def serving(file: Path, port: int = 0, solver: Solver | None = None) -> Iterator[Any]:
    """The studio of a file on a port of this machine; by default it solves in this process."""
    uvicorn = pytest.importorskip("uvicorn")
    from dalembert.studio.server import StudioServer

    listening = socket.create_server((HOST, port))
    access = Access(listening.getsockname()[1])
    served = StudioServer(lambda: Session(StoredFile(file)), access, solver or Here())
    config = uvicorn.Config(
        served.app(),
        log_level="critical",
        ws="websockets-sansio",
        ws_max_size=LARGEST,
        timeout_graceful_shutdown=1,
    )
    server = uvicorn.Server(config)
    thread = Thread(target=server.run, kwargs={"sockets": [listening]})
    thread.start()
    try:
        yield served
    finally:
        server.should_exit = True
        thread.join(10)
