"""Whatever someone does in the studio, its page stays silent, the file can be read or its fault is named, and what is
saved has the numbers that are shown."""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.pages.sweep import with_cycle
from dalembert.studio.problems import problem_text
from dalembert.studio.solver import Solver
from tests.browser.actions_at_random import ACTIONS
from tests.browser.studio_tab import Studio, tabs
from tests.browser.test_assembly import answer_of, same_as
from tests.studio.served import serving
from tests.tiers import tiers

__all__ = ["tabs"]

TEMPLATES = (
    "four_bar",
    "crank_shaper",
    "slider_crank",
    "toggle_press",
    "scissor",
    "bucket",
    "planetary_train",
)
TEMPLATES += ("watt_1", "belt_drive", "disc_cam")
LOOK = 5
"""Actions after which the file and its numbers are looked at. A mechanism without numbers, by then in pieces, is opened
anew, as it is after a letter that makes its file wrong."""


class Forces:
    """The page of forces of a studio, as `same_as` wants it."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio

    def run(self, script: str) -> Any:
        return self.studio.page.evaluate(f"(page => ({script}))(studio.page())")


def settled(s: Studio) -> bool:
    """Wait until all that was done is answered; True if forces are shown of the text as it is."""
    s.settled()
    return bool(s.page.evaluate("studio.solved() && !!studio.page().kernel"))


def looked_at(s: Studio, path: Path) -> bool:
    """The file is readable or its fault is named at a line; saved, it has the numbers shown. True if it had some."""
    shown = settled(s)
    text, said, line = (s.page.evaluate(f"studio.state().{key}") for key in ("text", "error", "line"))
    if said:
        assert len(said) > 15
        assert 1 <= line <= text.count("\n") + 1
        with pytest.raises(ModelError):
            da.loads(text)
        return False
    if not shown:
        assert s.page.inner_text(".verdict")
        return False
    s.page.keyboard.press("Control+s")
    s.until("!studio.state().dirty")
    m = da.load(path)
    if not s.page.evaluate("studio.state().friction"):
        m = m.with_values({"friction.enabled": False})
    static = s.page.evaluate("studio.state().static")
    return same_as(Forces(s), answer_of(with_cycle(m), static)) is not None


@pytest.mark.parametrize(
    "run",
    tiers([], [("four_bar", 40)], [(name, 1000) for name in TEMPLATES]),
    ids=lambda run: f"{run[0]}_{run[1]}",
)
def test_after_any_actions_what_is_saved_has_the_numbers_shown(
    run: tuple[str, int], tabs: Any, tmp_path: Path
) -> None:
    name, count = run
    r, path, compared = Random(name), tmp_path / "m.yaml", 0
    text = problem_text("template", name)
    path.write_text(text, encoding="utf-8")
    with serving(path, solver=Solver()) as served:  # one that gives up in time
        s = tabs(served)
        for k in range(count):
            anew = bool(s.page.evaluate("studio.state().error"))
            if k and k % LOOK == 0:
                numbers = looked_at(s, path)
                compared += numbers
                anew = not numbers
            if anew:
                s.send({"edit": [[0, len(s.text), text]], "base": s.page.evaluate("studio.state().hash")})
                settled(s)
            r.choice(ACTIONS)(s, r)
            assert not s.complaints, (k, s.complaints)
        looked_at(s, path)
    assert compared
