"""The motion of kept programs: which way a linkage closes, whole turns, dead centres between listed positions."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile import compiled_mechanism
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.engine import structures
from dalembert.analysis.engine.flat_numbers import flat_numbers
from dalembert.analysis.engine.kept_program import TracedOutputs
from dalembert.analysis.engine.walk import walk_through
from tests.engine.comparing import both, counted, difference


def four_bar(positions: Any, assembly: Any = None, **lengths: float) -> Any:
    m = da.four_bar(**lengths)
    changes = {"drives.O2.position": positions}
    return m.with_values(changes | ({} if assembly is None else {"assembly": assembly}))


@pytest.mark.parametrize(
    ("assembly", "by_program"),
    [
        ({"coupler": 0.9, "rocker": 1.7}, True),
        ({"coupler": -0.9, "rocker": -1.7}, True),  # the other way it closes
        ({"rocker": -1.7}, True),
        ({"coupler": 7.2, "rocker": -4.6}, True),  # whole turns further
        ({"coupler": 0.1, "rocker": 0.2}, True),  # near neither: the nearest
        ({}, True),
    ],
)
def test_the_way_that_the_careful_path_takes(assembly: dict[str, float], by_program: bool) -> None:
    m = four_bar((0.3, 0.5, 1.0), assembly)
    first, again = both(m), both(m)
    assert first == again
    assert first[0] < 1e-12
    assert (first[1] == "all") == by_program


def test_whole_turns_are_counted_through_what_lies_between(monkeypatch: pytest.MonkeyPatch) -> None:
    """A drag link, all of whose links turn: three positions over five turns, in no order."""
    monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())
    m = four_bar(
        (0.2, 31.0, -9.0), {"coupler": 1.0, "rocker": 1.2}, ground=0.05, crank=0.2, coupler=0.18, rocker=0.22
    )
    off, by_program = both(m)
    assert off < 1e-11
    assert by_program == "all"
    assert np.ptp(da.dynamics(m).angle("rocker")) > 30


def test_a_dead_centre_between_two_positions_is_noticed() -> None:
    """A parallelogram passes its change points, where its way of closing changes: not to be jumped over."""
    parallel = {"ground": 0.3, "crank": 0.1, "coupler": 0.3, "rocker": 0.1}
    for positions in ((2.5, 3.6), (3.04, 3.24), (3.1, 3.2, 3.3), tuple(np.linspace(0.4, 2.7, 50))):
        m = four_bar(positions, {"coupler": 0.0, "rocker": positions[0]}, **parallel)
        off, by_program = both(m)
        assert off < 1e-9
        assert (by_program == "all") == (max(positions) < np.pi)


def test_gaps_are_left_to_the_careful_path() -> None:
    m = da.four_bar(ground=0.3, crank=0.2, coupler=0.15, rocker=0.12, sweep=(-0.5, 0.5))
    m = m.with_values({"drives.O2.position": tuple(np.linspace(-1.5, 1.5, 30)), "assembly": {"rocker": 1.8}})
    off, by_program = both(m)
    assert off < 1e-9
    assert not by_program
    assert "not_assembled" in da.dynamics(m).status


def test_one_trace_serves_all_numbers_of_a_structure(monkeypatch: pytest.MonkeyPatch) -> None:
    traced: list[int] = []
    own = structures.trace_structure
    monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())
    monkeypatch.setattr(structures, "trace_structure", lambda *given: traced.append(1) or own(*given))
    crank = da.slider_crank()
    for k in range(1, 6):
        m = crank.with_values(
            {
                "links.crank.points.A": (0.0517 + 0.00313 * k, 0.00113 * k),
                "drives.O2.position": tuple(np.arange(k) * 1.1),
            }
        )
        careful = da.dynamics(m, method="careful")
        assert difference(da.dynamics(m), careful) < 1e-11
    assert sum(traced) == 1


def test_structures_are_bounded_and_shared_by_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(structures, "KEPT", 1000)
    monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())
    made = [da.four_bar(), da.slider_crank(), da.toggle_press(), da.whitworth()]
    alone = [da.dynamics(m, method="careful") for m in made]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(da.dynamics, made * 4))
    assert all(difference(r, alone[k % 4]) < 1e-10 for k, r in enumerate(found))
    kept = structures.STRUCTURES
    assert kept.size == sum(map(structures._size, kept.found.values())) <= 1000


def test_residual_and_power_balance_would_show_a_wrong_program(monkeypatch: pytest.MonkeyPatch) -> None:
    """A program that gives a wrong effort is not believed."""
    m = da.four_bar()
    da.dynamics(m)
    with counted() as ways:
        evaluate = TracedOutputs.balance

        def corrupted(k: Any, layout: Any, out: Any) -> Any:
            out[k.rows["unbalanced"].start] += 1e-3 * np.abs(out[k.rows["force"]]).max()
            return evaluate(k, layout, out)

        monkeypatch.setattr(TracedOutputs, "balance", corrupted)
        r = da.dynamics(m)
    assert ways == [""]
    assert r.ok.all()


def test_places_between_listed_positions_are_even() -> None:
    """No step of the drive is longer than 0.2 rad, nor an eighth of the whole way."""
    m = four_bar((3.0, 0.0, 1.0))
    c = compile_mechanism(m, m.schedule())
    way = walk_through(c, 0.2)
    assert way is not None
    every = np.concatenate([c.schedule.position[:, 0], way.between[:, 0]])[way.order]
    steps = np.diff(every)
    assert steps == pytest.approx([1 / 5] * 5 + [2 / 10] * 10)
    assert set(way.before) == {1, 2}  # the list's places of 0 and 1
    short = walk_through(compile_mechanism(m2 := four_bar((0.0, 0.4)), m2.schedule()), 0.2)
    assert short is not None
    assert len(short.between) == 7


@pytest.mark.parametrize("template", ["four_bar", "slider_crank", "whitworth", "watt_1", "scotch_yoke"])
def test_a_layout_that_is_kept_moves_as_if_laid_out_anew(template: str) -> None:
    """Other points of the links: the same arms, lengths and whole numbers as of a description met first."""
    m = getattr(da, template)()
    compile_mechanism(m, m.schedule(1))
    for link in m.links:
        for point, (x, *_) in m.points(link).items():
            with suppress(da.ModelError):  # a point placed from another has no number of its own
                m = m.with_values({f"links.{link}.points.{point}.0": x + 0.003})
    moved = flat_numbers(compile_mechanism(m, m.schedule(1)))
    compiled_mechanism._geometry.cache_clear()
    compiled_mechanism._first_placed.cache_clear()
    anew = flat_numbers(compile_mechanism(m, m.schedule(1)))
    assert moved.key == anew.key
    for a, b in zip(moved[1:], anew[1:], strict=True):
        np.testing.assert_array_equal(a, b)
