"""Progress of long work on a terminal: nothing in a pipe, in a notebook, or in the first half second."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

DELAY = 0.5
"""Seconds of silence: shorter work shows nothing."""

Step = Callable[..., None]


@contextmanager
def progress(what: str, total: int | None = None) -> Iterator[Step]:
    """A line on standard error, gone when done: what is done and for how long, with a total a bar.

    What it gives is called with how much is done, and of what: ``step(3)``, ``step(3, "case.yaml")``. An interruption
    passes through.

    >>> with progress("Solving", 2) as step:      # in a pipe nothing is shown
    ...     step(1)
    """
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda done, name="": None
        return
    import threading

    state: dict[str, Any] = {"completed": 0, "description": what}
    finished = threading.Event()

    def step(done: int, name: str = "") -> None:
        state.update(completed=done, description=f"{what} {name}".strip())

    shown = threading.Thread(target=_show, args=(state, total, finished), daemon=True)
    shown.start()
    try:
        yield step
    finally:
        finished.set()
        shown.join()


def _show(state: dict[str, Any], total: int | None, finished: Any) -> None:
    """Draw the line until the work is finished, if it takes long; rich is imported only then."""
    if finished.wait(DELAY):
        return
    from rich.console import Console
    from rich.markup import escape
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = [SpinnerColumn(), TextColumn("{task.description}"), *([BarColumn()] if total else [])]
    console = Console(stderr=True)  # standard output is left alone: it may be a file
    with Progress(
        *columns, TimeElapsedColumn(), console=console, transient=True, redirect_stdout=False
    ) as line:
        task = line.add_task("", total=total)
        while True:
            line.update(task, completed=state["completed"], description=escape(state["description"]))
            if finished.wait(0.1):
                return
