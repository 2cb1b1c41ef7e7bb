"""Where a structure is met for the first time decides nothing: at a dead centre, with ends that coincide, without what
would balance it. Asked again, when its program is kept, it answers as the careful path does."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.engine.structures import STRUCTURES
from dalembert.bundled import cases
from dalembert.kernel.doubts import uncertain
from dalembert.kernel.graph import Graph

AGAIN = 5
"""A structure whose poses are known is traced when it is met for the third time."""


@pytest.fixture(autouse=True)
def met_by_none() -> Iterator[None]:
    STRUCTURES.found.clear()
    yield
    STRUCTURES.found.clear()


def changed(name: str, **values: Any) -> da.Mechanism:
    return da.load(cases()[name]).with_values({k.replace("__", "."): v for k, v in values.items()})


def spring(end: float) -> da.Mechanism:
    """A spring from a crank's pin to a point of the ground beside it, which is no place at the pin."""
    m = da.mechanism(
        {
            "units": {"length": "mm"},
            "links": {
                "ground": {"points": {"O": [0, 0], "S": [end, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [100, 0]}, "mass": 2, "center": [50, 0]},
            },
            "joints": {"O": {"type": "pin", "links": ["ground", "crank"]}},
            "drives": {"O": {"position": 0.5, "speed": "3 rad/s"}},
            "loads": {"s": {"type": "spring", "between": ["crank.O", "ground.S"], "stiffness": 900}},
        }
    )
    return m.with_values({"loads.s.free_length": 0.05})


def no_masses(mass: float) -> da.Mechanism:
    """An arm in a plane that turns at the speed that balances it: without mass nothing pulls outward."""
    return da.mechanism(
        {
            "turning": {"axis": "y", "speed": "unknown"},
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "arm": {"points": {"O": [0, 0], "A": [1, 0]}, "mass": mass, "center": [1, 0]},
            },
            "joints": {"O": {"type": "pin", "links": ["ground", "arm"]}},
            "drives": {"O": {"position": -0.8, "effort": 0}},
            "gravity": "standard",
        }
    )


def pushed(degrees: float) -> da.Mechanism:
    """Two bars, held by an unknown force along the second one, which has no power where both are in one line."""
    tree = da.load(cases()["vw-04-two-bars-held-at-the-foot"]).to_tree()
    tree["loads"]["Cx"] |= {"direction": 0, "axes": "link"}
    tree["drives"]["A"]["position"] = f"{degrees} deg"
    return da.mechanism(tree)


def yoke(*degrees: float) -> da.Mechanism:
    """A yoke that an unknown force along its guide moves: without power where the crank's pin is in line with it, where
    no entry of the crank's equation of moments is more than rounding."""
    tree = da.scotch_yoke().to_tree()
    tree["drives"]["O2"] = {"position": [f"{x} deg" for x in degrees], "speed": "60 rad/s", "effort": -0.02}
    tree["loads"]["put"] = {"type": "force", "on": "yoke", "at": "S", "value": "unknown", "direction": 0}
    return da.mechanism(tree)


PLATE = "dk-04-plate-on-two-links"
MET: dict[str, tuple[Any, str]] = {
    "dead centre": (lambda: changed(PLATE, drives__E__position=np.pi / 2), "singular"),
    "dead centre, twice": (
        lambda: changed(PLATE, drives__E__position=[np.pi / 2] * 2, drives__E__acceleration=-5.0),
        "singular",
    ),
    "beside it": (lambda: changed(PLATE, drives__E__position=np.pi / 2 - 0.02), "ok"),
    "ends coincide": (lambda: spring(0), "undefined_load"),
    "ends apart": (lambda: spring(1), "ok"),
    "nothing balances": (lambda: no_masses(0), "no_balance"),
    "a mass balances": (lambda: no_masses(1), "ok"),
    "a load without power": (lambda: pushed(180), "no_balance"),
    "a load with little": (lambda: pushed(179), "ok"),
    "a pin in line": (lambda: yoke(0), "no_balance"),
    "a pin beside the line": (lambda: yoke(1), "ok"),
}


@pytest.mark.parametrize("name", MET)
def test_asked_again_it_answers_the_same(name: str) -> None:
    made, status = MET[name]
    m = made()
    careful = (da.dynamics if m.has_speeds else da.statics)(m, method="careful")
    assert set(careful.status) == {status}
    for _ in range(AGAIN):
        r = (da.dynamics if m.has_speeds else da.statics)(m)
        assert r.status == careful.status
        assert r.reasons == careful.reasons
        assert r.force_array == pytest.approx(careful.force_array, rel=1e-9, abs=1e-9, nan_ok=True)
    if name == "nothing balances":
        with pytest.raises(da.ModelError, match="a mass that a compiled analysis divides by is zero"):
            da.compile(m, lanes=1)
    elif name != "dead centre, twice":
        assert tuple(da.compile(m, lanes=1)().status[0]) == careful.status


def test_over_a_turn_the_positions_without_power_have_no_force() -> None:
    m = yoke(0, 90, 180, 270)
    for _ in range(AGAIN):
        r = da.dynamics(m)
        assert r.status == ("no_balance", "ok", "no_balance", "ok")
        assert np.isnan(r.load_array[::2]).all()


@pytest.mark.parametrize(("first", "second"), [(0.0, -0.4), (-0.4, 0.0)])
def test_a_program_met_beside_a_dead_centre_serves_there_and_elsewhere(first: float, second: float) -> None:
    for turn in (first, second):
        m = changed(PLATE, drives__E__position=np.pi / 2 + turn)
        careful = da.dynamics(m, method="careful")
        for _ in range(AGAIN):
            assert da.dynamics(m).status == careful.status


def test_a_constant_that_is_not_negative_is_certain() -> None:
    g = Graph()
    x, below, unknown = g.input("number", "x", 1.0), g.constant(-1.0), g.constant(np.nan)
    assert uncertain([g.zero, g.one, x, below, unknown]) == (x, below, unknown)
