"""The guide's page on space does what it shows, and its table is the program's."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

from dalembert.model.joints.pairs import PAIRS

PAGE = Path(__file__).parents[2] / "docs" / "space.md"


def test_its_examples_run() -> None:
    failed, tried = doctest.testfile(str(PAGE), module_relative=False)
    assert tried >= 8
    assert failed == 0


def test_its_table_is_the_programs() -> None:
    """Turns, slides, reactions and drives of every pair, as the analysis has them."""
    rows = re.findall(
        r"^\| (`.*?) \| (\d) \| (.*?) \| (.*?) \| (.*?) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE
    )
    named = {kind: row for row in rows for kind in re.findall(r"`(\w+)`", row[0])}
    assert set(named) == set(PAIRS)
    for kind, (_, turns, slides, reactions, drives) in named.items():
        pair = PAIRS[kind]
        assert len(pair.turns) == int(turns)
        assert kind == "screw" or len(pair.slides) == int(slides)
        assert tuple(re.findall(r"`(slide\d?|turn\d?)`", drives)) == PAIRS[kind].freedoms
        if kind not in ("weld", "universal", "screw"):
            carried = [*(f"F{a}" for a in pair.forces), *(f"M{a}" for a in pair.moments)]
            assert re.findall(r"\b[FM][xyz]\b", reactions) == carried
