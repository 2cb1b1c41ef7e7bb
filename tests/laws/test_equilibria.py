"""Positions of equilibrium as roots: of functions whose roots are known, in place of efforts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis import equilibria

Q = np.linspace(0.0, 10.0, 41)


class Scan:
    """A function of the position, in place of an effort; it counts the calls."""

    def __init__(self, g: Callable[[np.ndarray], np.ndarray]) -> None:
        self.g, self.calls, self.range = g, 0, (0.0, 10.0)

    def excess(self, q: np.ndarray) -> tuple[np.ndarray, float]:
        self.calls += 1
        return self.g(q), 1.0


def crossings(g: Callable[[np.ndarray], np.ndarray], scale: float = 1.0) -> Any:
    scan: Any = Scan(g)
    with np.errstate(all="ignore"):
        return equilibria._crossings(scan, Q, g(Q), scale)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_roots_where_the_sign_changes(sign: float) -> None:
    roots = crossings(lambda q: sign * np.sin(q))
    assert np.sort(roots) == pytest.approx(np.pi * np.arange(4), abs=1e-15)
    exact = crossings(lambda q: sign * (q - Q[7]))
    assert exact.tolist() == [Q[7]]
    for pole in (lambda q: sign / (q - 3.1), lambda q: sign * np.where(q < 3.1, -1.0, 0.3)):
        assert crossings(pole).size == 0
    assert crossings(lambda q: 1.0 + 0 * q).size == 0
    hole = crossings(lambda q: np.where((q > 3.26) & (q < 3.3), np.nan, sign * (q - 3.4)))
    assert hole == pytest.approx([3.4], abs=1e-14)


HANGING = """gravity: standard
links: {ground: {points: {O: [0, 0]}}, rod: {points: {O: [0, 0]}, mass: 2, center: [CENTER, 0]}}
joints: {O: {type: pin, links: [ground, rod]}}
drives: {O: {position: unknown, effort: 0, range: RANGE}}
"""


@pytest.mark.parametrize(("low", "high", "found"), [
    (-90, 270, [-90, 90]), (-91, 269, [-90, 90]), (-90, 90, [-90, 90]), (0, 90, [90]), (90, 180, [90]),
    (90, 450, [90, 270]), (-90, 0, [-90]), (-450, -90, [-450, -270]), (-89, 89, []), (-90 + 1e-6, 90 - 1e-6, []),
])  # fmt: skip
@pytest.mark.parametrize("center", [0.1, -0.1])
def test_a_rod_hangs_or_stands_also_at_the_ends_of_its_range(
    low: float, high: float, found: list[float], center: float
) -> None:
    """A turn has them once; below its pin it is stable."""
    r = da.statics(da.loads(HANGING.replace("RANGE", f"[{low!r}, {high!r}]").replace("CENTER", str(center))))
    if not found:
        assert (r.status, r.stability) == (("no_balance",), (None,))
        return
    assert np.degrees(r.drive_position("O")) == pytest.approx(found, abs=1e-9)
    below = [np.sin(np.radians(q)) * center < 0 for q in found]
    assert r.stability == tuple("stable" if b else "unstable" for b in below)
    assert r.status == ("ok",) * len(found)


def test_a_rod_pinned_in_its_centre_stays_where_it_is_put() -> None:
    r = da.statics(da.loads(HANGING.replace("RANGE", "[20, 90]").replace("CENTER", "0")))
    assert (r.status, r.stability) == (("ok",), ("neutral",))
    assert r.reasons == ("Every position of the range is an equilibrium (indifferent): the first is given.",)
    assert np.degrees(r.angle("rod")) == pytest.approx([20.0])


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_roots_that_touch(sign: float) -> None:
    for g, expected in (
        (lambda q: sign * (1 - np.cos(q - 2.1)), [2.1, 2.1 + 2 * np.pi]),
        (lambda q: sign * (1.001 - np.cos(q - 2.1)), []),
        (lambda q: sign * (q - 2.125) ** 2 / 9, [2.125]),  # midway between two
        (lambda q: sign * np.sin(q), []),
        (lambda q: sign * (2 + q), []),
    ):
        scan: Any = Scan(g)
        assert equilibria._touches(scan, Q, g(Q), 1.0) == pytest.approx(expected, abs=1e-6)
        assert scan.calls < 150


def test_roots_stand_once_in_order_with_their_stability() -> None:
    roots = equilibria._distinct(np.array([3.0, 1.0, 3.0 + 1e-9, 2.0, 1.0]), -0.25)
    assert roots == pytest.approx([1, 2, 3])
    assert equilibria._distinct(np.zeros(0), 0.25).size == 0
    scan: Any = Scan(lambda q: (q - 1) * (q - 3) * (q - 5) ** 2)
    assert equilibria._stability(scan, np.array([1.0, 3.0, 5.0]), 100.0) == ("unstable", "stable", "neutral")


def test_what_does_not_close_is_searched_for_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a range that reaches beyond the linkage only the first scan looks there; the roots are those of its part."""
    tree = da.four_bar(coupler=0.25).to_tree()
    tree["drives"] = {"O4": {"position": "unknown", "range": [0.3, 6.0], "effort": 0}}
    tree["gravity"] = "standard"
    scans = list[int]()
    plain = equilibria.at_schedule

    def counted(m: Any, schedule: Any, inertia: bool) -> Any:
        r = plain(m, schedule, inertia)
        scans.append(sum(s == "not_assembled" for s in r.status))
        return r

    monkeypatch.setattr(equilibria, "at_schedule", counted)
    r = da.statics(da.mechanism(tree))
    assert r.stability is not None
    assert scans[0] > 100
    assert max(scans[1:]) <= 3


def held(effort: str, free: str) -> str:
    """A rod on a spring whose ends coincide at every position, with an effort that it never needs."""
    return f"""
links:
  ground: {{points: {{O: [0, 0]}}}}
  rod: {{points: {{O: [0, 0], A: [1, 0]}}, mass: 2, center: [1, 0]}}
joints: {{O: {{type: pin, links: [ground, rod]}}}}
drives: {{O: {{position: unknown, range: [0, 90], effort: {effort}}}}}
loads: {{s: {{type: spring, between: [rod.O, ground.O], stiffness: 9, free_length: {free}}}}}
gravity: standard
"""


def test_where_nothing_balances_it_is_said_why() -> None:
    r = da.statics(da.loads(held("100 N*m", "0 m")))
    assert r.status == ("no_balance",)
    assert "the effort needed differs from the given one by -100 N*m to -80.3867 N*m" in str(r.reasons[0])
    r = da.statics(da.loads(held("0 N*m", "1 m")))
    assert r.status == ("no_balance",)
    assert "No position of O in its range has an answer: The ends of spring s (9 N) coincide" in str(
        r.reasons[0]
    )
    for drawn in (da.draw.mechanism, da.draw.free_bodies, da.draw.question):
        with pytest.raises(da.AnalysisError, match="position 1: No position of O in its range has an answer"):
            drawn(r)
