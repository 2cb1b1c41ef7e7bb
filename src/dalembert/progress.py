"""Progress of long work on standard error: a line that redraws itself on a terminal, single lines in a pipe.

Nothing in the first half second on a terminal, or in the first seconds in a pipe. With a total there are rate and time
left; in a pipe, work that will be long begins with an estimate, measured on what is done in its first second.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import Any

DELAY = 0.5
"""Seconds of silence on a terminal: shorter work shows nothing."""
FIRST, SLOWER, LONGEST = 5.0, 2.0, 60.0
"""In a pipe: seconds until the first line, the factor from one pause to the next, and the longest pause."""
MEASURED, LONG = 1.0, 10.0
"""In a pipe: seconds until work is estimated, and the estimate from which on it is printed."""

Step = Callable[..., None]


@contextmanager
def progress(what: str, total: int | None = None) -> Iterator[Step]:
    """Progress on standard error: what is done, for how long, with a total how fast and how long it still takes.

    What it gives is called with how much is done, and of what: ``step(3)``, ``step(3, "case.yaml")``; a total that is
    known only then follows, ``step(3, total=200)``; work that was resumed had ``start`` done before. An interruption
    passes through.

    >>> with progress("Solving", 2) as step:      # short work shows nothing
    ...     step(1)
    """
    if sys.stderr is None:
        yield lambda done, name="", total=None, start=0: None
        return
    import threading

    state: dict[str, Any] = {"completed": 0, "description": what, "total": total, "start": 0}
    finished = threading.Event()

    def step(done: int, name: str = "", total: int | None = None, start: int = 0) -> None:
        state.update(
            completed=done, description=f"{what} {name}".strip(), total=total or state["total"], start=start
        )

    show = _show if sys.stderr.isatty() else _print_lines
    shown = threading.Thread(target=show, args=(state, finished), daemon=True)
    shown.start()
    try:
        yield step
    finally:
        finished.set()
        shown.join()


def line(what: str, done: int, total: int | None, seconds: float, start: int = 0) -> str:
    """One line: done of total, rate and time left; without a total the time so far. ``start`` were done before.

    >>> line("Studying", 300, 1200, 60.0)
    'Studying: 300 of 1,200, 5.0 per second, 3 min left'
    >>> line("Studying", 900, 1200, 60.0, start=600)
    'Studying: 900 of 1,200, 5.0 per second, 60 s left'
    >>> line("Solving press.yaml", 0, None, 42.0)
    'Solving press.yaml: 42 s so far'
    """
    if not total or done <= start:
        return f"{what}: {duration(seconds)} so far"
    rate = (done - start) / seconds
    speed = f"{rate:,.{0 if rate >= 100 else 1}f} per second" if rate >= 1 else f"{60 * rate:.1f} per minute"
    return f"{what}: {done:,} of {total:,}, {speed}, {duration((total - done) / rate)} left"


def estimate(what: str, done: int, total: int | None, seconds: float, start: int = 0) -> str:
    """One line with the time that all of it will take, measured so far; empty where that is short or not known yet.

    >>> estimate("Studying", 40, 1200, 8.0)
    'Studying: 1,200 take about 4 min, by the first 40'
    >>> estimate("Studying", 640, 1200, 8.0, start=600)
    'Studying: 600 more take about 2 min, by the first 40'
    """
    if not total or done <= start or done >= total:
        return ""
    takes = (total - start) * seconds / (done - start)
    count = f"{total - start:,} more" if start else f"{total:,}"
    about = f"{what}: {count} take about {duration(takes)}, by the first {done - start:,}"
    return about if takes >= LONG else ""


def duration(seconds: float) -> str:
    """A time as a person says it.

    >>> duration(5.2), duration(200), duration(8000)
    ('5 s', '3 min', '2 h 13 min')
    """
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60} min"


def _print_lines(state: dict[str, Any], finished: Any) -> None:
    """An estimate of long work as soon as it can be measured, then a line from time to time until it is finished."""
    start, pause = monotonic(), FIRST

    def words(of: Callable[..., str]) -> str:
        seconds = monotonic() - start
        return of(state["description"], state["completed"], state["total"], seconds, state["start"])

    for _ in range(int(FIRST / MEASURED) - 1):
        if finished.wait(MEASURED):
            return
        if text := words(estimate):
            print(text, file=sys.stderr, flush=True)
            break
    else:
        pause = MEASURED
    while not finished.wait(pause):
        print(words(line), file=sys.stderr, flush=True)
        pause = min(SLOWER * max(pause, FIRST), LONGEST)


def _show(state: dict[str, Any], finished: Any) -> None:
    """Draw the line until the work is finished, if it takes long; rich is imported only then."""
    if finished.wait(DELAY):
        return
    from rich.console import Console
    from rich.markup import escape
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    total = state["total"]
    start, more = monotonic() - DELAY, [BarColumn(), TextColumn("{task.fields[rate]}")] if total else []
    columns = [SpinnerColumn(), TextColumn("{task.description}"), *more]
    console = Console(stderr=True)  # standard output is left alone: it may be a file
    with Progress(
        *columns, TimeElapsedColumn(), console=console, transient=True, redirect_stdout=False
    ) as bar:
        task = bar.add_task("", total=total, rate="")
        while True:
            done, seconds = state["completed"], monotonic() - start
            rate = line("", done, total, seconds, state["start"]).partition(", ")[2]
            bar.update(task, completed=done, description=escape(state["description"]), rate=rate)
            if finished.wait(0.1):
                return
