"""What the page says of a position without an answer is what the analyses say: where, from where to where, how far."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.pages.sweep import with_cycle
from dalembert.studio.problems import problem_text
from tests.browser.opened import FILES

pytestmark = pytest.mark.long

FRICTION = "seed-002-7a-engine-friction-circles"
BROKEN: list[tuple[str, dict[str, float]]] = [
    ("four_bar", {"links.coupler.points.B.0": 0.03}),
    ("four_bar", {"links.crank.points.A.0": 0.3}),
    ("four_bar", {"links.ground.points.O4.0": 0.6}),
    ("four_bar", {"drives.O2.speed": 1e200}),
    ("engine", {"links.rod.points.B.0": 0.02}),
    ("four_bar", {"links.rocker.points.B.0": 0.05}),
    ("seed-001-cd-collar-250-mm", {}),
    (FRICTION, {}),
]
REFUSED: list[tuple[str, dict[str, float]]] = [
    ("gear_train", {"links.carrier.points.P.0": 0.2}),
    ("four_bar", {"links.ground.points.O4.0": 0.0, "links.ground.points.O4.1": 0.0}),
]


def said_at(page: Any, position: int) -> str:
    page.run(f"page.show({position})")
    return str(page.run("document.querySelector('.mark').textContent"))


@pytest.mark.parametrize(("name", "change"), BROKEN, ids=[f"{n}-{'-'.join(c)}" for n, c in BROKEN])
def test_a_position_has_the_sentence_of_the_analyses(
    opened: Any, name: str, change: dict[str, float]
) -> None:
    page = opened(name)
    page.page.evaluate("c => page.set(c)", change)
    page.frame()
    m = with_cycle(da.load(FILES[name])).with_values(change)
    r = da.dynamics(m) if m.has_speeds else da.statics(m)
    step = 1 if name == FRICTION else max(1, len(r.status) // 12)
    places = range(0, len(r.status), step)
    wrong = [(k, said, r.reasons[k]) for k in places if (said := said_at(page, k)) != (r.reasons[k] or "")]
    assert wrong == []
    assert any(r.reasons[k] for k in places)


@pytest.mark.parametrize(("name", "change"), REFUSED, ids=[name for name, _ in REFUSED])
def test_what_the_analyses_refuse_has_no_numbers(opened: Any, name: str, change: dict[str, float]) -> None:
    page = opened(name)
    page.page.evaluate("c => page.set(c)", change)
    page.frame()
    m = with_cycle(da.load(FILES[name])).with_values(change)
    with pytest.raises(ModelError) as refused:
        (da.dynamics if m.has_speeds else da.statics)(m)
    _, _, sentence = str(refused.value).partition(": ")
    assert said_at(page, 3) == sentence
    assert page.run("page.kernel.solved") is False
    assert not any(page.run("[...page.kernel.good]"))
    page.page.evaluate("page.set({})")
    page.frame()
    assert (said_at(page, 3), page.run("page.kernel.solved")) == ("", True)


def test_a_reversal_has_its_numbers_on_both_sides(opened: Any) -> None:
    """Drawn as a jump of the curve, not greyed; the numbers are those of the analysis just before and just after."""
    page = opened(FRICTION)
    m = with_cycle(da.load(FILES[FRICTION]))
    r = da.dynamics(m) if m.has_speeds else da.statics(m)
    assert r.after is not None
    places = [k for k, status in enumerate(r.status) if status == "reversal"]
    assert places
    row = "page.data.views.charts[0].curves[0].row"
    for k in places:
        said = said_at(page, k)
        assert "changes sense" in said
        assert page.run("document.querySelector('.dalembert').classList.contains('unsolved')") is False
        both = page.run(f"[page.kernel.here[{row}], page.kernel.hereAfter[{row}]]")
        assert both == pytest.approx([r.effort("O")[k], r.after.effort("O")[k]], rel=1e-9)
        over = page.run(
            f"[page.kernel.value({row}, {k}), page.kernel.onceAfter(() => page.kernel.value({row}, {k}))]"
        )
        assert over == pytest.approx(both, rel=1e-12)
    lines = page.run("document.querySelector('.chart path[class^=\"l-effort\"]').getAttribute('d')")
    assert lines.count("L") + lines.count("M") == sum(page.run("[...page.kernel.good]")) + len(places)


def test_a_contact_without_a_force_is_not_lost(opened: Any) -> None:
    """While the follower of a cam dwells and nothing loads it, its force is rounding of zero, of either sense."""
    text = problem_text("template", "disc_cam").replace("direction: 90", "direction: 113.2097")
    m = da.loads(text[: text.index("loads:")] + "assembly: {cam: 0, follower: 113.2097}")
    page = opened(html=da.page(m))
    r = da.dynamics(with_cycle(m))
    force = np.abs(r.reaction("F")).max(axis=1)
    still = np.flatnonzero(force < 1e-12 * np.nanmax(force))
    assert len(still) > 5
    assert [said for k in still if (said := said_at(page, k))] == []
    assert page.run("[...page.kernel.good]") == [int(status == "ok") for status in r.status]
