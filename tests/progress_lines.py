"""Progress on standard error, which appears where work is slow: on a loaded machine also where tests expect none."""

from __future__ import annotations

import re

LINES = re.compile(r"([^\n]*( so far| left| take about [^\n]*, by the first [\d,]+)\n?)*")


def only_progress(text: str) -> bool:
    """True for a text of progress alone, and for an empty one.

    >>> only_progress("Checking st-01: 3 of 60, 30.0 per minute, 2 min left\\n"), only_progress("Written: a.csv\\n")
    (True, False)
    """
    return LINES.fullmatch(text) is not None
