"""Counts of the tests that draw machines by number: laws, and machines on which they are tried, as JSON.

A law is a test with a seed; a block of seeds counts as many. Tests are collected, not run.

    python docs/site/law_counts.py
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
TIERS = ("exhaustive", "long")
"""Marks of a test that `make test-long` or `make test` leave out."""


class Counts:
    """The plugin: module -> what holds, its laws, machines by default, with the long tests, altogether."""

    def __init__(self) -> None:
        self.modules: dict[str, dict[str, Any]] = {}

    def pytest_collection_modifyitems(self, items: list[Any]) -> None:
        for item in items:
            drawn = getattr(item, "callspec", None)
            if drawn is None or "seed" not in drawn.params:
                continue
            seeds = drawn.params["seed"]
            count = len(seeds) if isinstance(seeds, range) else 1
            name = item.path.relative_to(ROOT).as_posix()
            said = (item.module.__doc__ or "").strip().splitlines()[0]
            part = self.modules.setdefault(name, {"said": said, "laws": [], "machines": [0, 0, 0]})
            part["laws"] = sorted({*part["laws"], item.originalname})
            marks = [item.get_closest_marker(mark) is not None for mark in TIERS]
            for tier in range(2 if marks[0] else 1 if marks[1] else 0, 3):
                part["machines"][tier] += count


def main() -> int:
    os.chdir(ROOT)
    counts = Counts()
    sys.path.insert(0, str(ROOT))
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        out, sys.stdout = sys.stdout, nowhere
        ended = pytest.main(["--collect-only", "-qq", "-m", "", "-p", "no:cacheprovider", "tests"], [counts])
        sys.stdout = out
    print(json.dumps(counts.modules, indent=1))
    return int(ended)


if __name__ == "__main__":
    sys.exit(main())
