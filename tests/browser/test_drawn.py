"""Templates and the plane problems of the lecture notes have the numbers of their files when drawn from nothing."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.studio.problems import problem_text, problems
from tests.browser.drawn_by_hand import Draughtsman, answers
from tests.browser.studio_tab import Studio
from tests.studio.served import serving
from tests.tiers import tiers

TEXT_ALONE = {"hoist": "a rope", "porter_governor": "a turning plane", "hartnell_governor": "a turning plane"}
TEXT_ALONE |= dict.fromkeys(
    ("block_brake", "band_brake", "plate_clutch", "ratchet"), "a joint without a tool"
)
TEXT_ALONE |= {"disc_cam": "a programme of lifts"}
"""Templates with something that is written in the text, and not drawn."""
KINDS = {p["name"]: p["kind"] for p in problems() if p["kind"] != "example"}
PLANE = [
    p["name"]
    for p in problems()
    if p["name"] in KINDS.keys() - TEXT_ALONE
    and (p["name"].startswith("seed-") or p["kind"] == "template")
    and not p["title"].startswith("in space")
]
QUICK = ("slider_crank",)
LONG = (
    *("whitworth", "stephenson_1", "scissor", "bucket", "planetary_train", "seed-000-b-crank-inertia-force"),
    *(
        "seed-001-cd-collar-250-mm",
        "seed-002-3-four-link-three-forces",
        "seed-002-5-slider-crank-force-on-rod",
    ),
    *("seed-002-7a-engine-friction-circles", "seed-003-norton-11-3-gravity", "seed-f-2a-rod-at-45-deg-03"),
)


@pytest.fixture(scope="module")
def board(browser: Any, tmp_path_factory: Any) -> Iterator[Studio]:
    """One studio in one tab for all drawings."""
    path: Path = tmp_path_factory.mktemp("board") / "m.yaml"
    with serving(path) as served:
        context = browser.new_context(viewport={"width": 1280, "height": 800})
        studio = Studio(context, served.access.address)
        yield studio
        context.close()
        assert studio.complaints == []


@pytest.mark.parametrize("name", tiers([], QUICK + LONG, [n for n in PLANE if n not in QUICK + LONG]))
def test_drawn_from_nothing_it_has_the_numbers_of_the_file(name: str, board: Studio) -> None:
    m = da.loads(problem_text(KINDS[name], name))
    board.empty()
    Draughtsman(board, m).draw()
    drawn, expected = answers(da.loads(board.text)), answers(m)
    near = {"rel": 1e-9, "abs": 1e-9 * (np.nanmax(np.abs([*expected, 0.0])) or 1.0), "nan_ok": True}
    assert drawn == pytest.approx(expected, **near)
    assert board.effort() == pytest.approx(expected[0], **near)
