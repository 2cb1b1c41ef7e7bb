"""Every drawing of every bundled file can be read: no text over another or over a line."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.reports.sheet import Drawings
from dalembert.views.paper.scene import Scene
from tests.methods.readable import text_over_lines, text_overlaps
from tests.tiers import sampled

FILES = cases() | examples()
QUICK = ["quick_return", "seed-002-7g-engine-guide-100-mm"]


def drawings(r: da.Result) -> Iterator[Scene]:
    """Those of the report, of the motion, and the charts where there are some."""
    yield da.draw.mechanism(r, forces=True)
    for block in da.report(r).sheet.blocks:
        if isinstance(block, Drawings):
            yield from block.scenes
    if r.mechanism.dimension == 2 and r.drives:
        yield da.draw.motion(r)
    if len(r.status) > 2 and r.drives and r.stability is None:
        yield da.draw.charts(r)


@pytest.mark.parametrize("name", sampled(QUICK, FILES))
def test_no_text_is_over_another_or_over_a_line(name: str) -> None:
    r = da.solve(da.load(FILES[name]))
    for scene in drawings(r):
        assert text_overlaps(scene) == [], scene.title
        assert text_over_lines(scene) == [], scene.title
