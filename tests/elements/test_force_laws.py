"""Gas springs, and springs and dampers by tables: closed forms, energies, simulation, and wrong tables."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da
from tests.tiers import over

FILE = """units: {length: mm, force: N, mass: kg}
links: {ground: {points: {A: [0, 0], G: [0, 0]}}, block: {points: {B: [0, 0]}, mass: 2}}
joints: {G: {type: slider, links: [ground, block], at: [G, B]}}
drives: {G: {position: [180, 200, 240], speed: [300 mm/s, -200 mm/s, 0 mm/s]}}
loads: {s: LOAD}
"""
GAS = (
    "{type: gas_spring, between: [ground.A, block.B], rod: 20, volume: 0.05 l, pressure: 20 bar, length: 250}"
)
POINTS = "force: {x: [-30, -10, 0, 20], y: [-500, -40, 0, 0]}"
TABLE = f"{{type: spring, between: [ground.A, block.B], free_length: 200, {POINTS}}}"
DAMPER = (
    "{type: damper, between: [ground.A, block.B], force: {x: [-0.25 m/s, 0 m/s, 1 m/s], y: [-100, 0, 900]}}"
)


def gas(x: float, n: float = 1.35) -> float:
    area = math.pi * 0.02**2 / 4
    return area * (20e5 * (5e-5 / (5e-5 - area * x)) ** n - 101325.0)


def test_a_gas_spring_pushes_by_its_law() -> None:
    for n in (1.35, 1.0, 1.4142135):
        m = da.loads(FILE.replace("LOAD", GAS.replace("250}", f"250, exponent: {n}}}")))
        expected = [-gas(0.25 - at, n) for at in (0.18, 0.2, 0.24)]
        for method in ("careful", None):
            r = da.statics(m, method=method) if method else da.statics(m)
            assert r.effort("G") == pytest.approx(expected, rel=1e-12)
        k = da.compile(m, vary=["loads.s.pressure"], outputs=["effort.G"], derivatives=True)
        found = k([[20e5]])
        assert found["effort.G"][0] == pytest.approx(expected, rel=1e-12)
        assert found.gradients["effort.G"][0, :, 0] * 20e5 == pytest.approx(
            np.array(expected) - 31.831, rel=1e-4
        )


def test_tables_are_tension_over_change_of_length_and_over_its_rate() -> None:
    spring = da.statics(da.loads(FILE.replace("LOAD", TABLE)))
    assert spring.effort("G") == pytest.approx([-270.0, 0.0, 0.0], abs=1e-12)
    assert (
        spring.assumptions["table of s"]
        == "1 of 3 positions is beyond its ends, where its first or last force is kept"
    )
    damper = da.statics(da.loads(FILE.replace("LOAD", DAMPER)))
    assert damper.effort("G") == pytest.approx([270.0, -80.0, 0.0], abs=1e-9)


@over(quick=2, whole=60)
def test_energy_is_the_area_below_the_force(seed: int) -> None:
    """Gauss' quadrature between the points of the table, where its lines bend."""
    rng = np.random.default_rng(seed)
    x = np.sort(rng.uniform(-60, 60, 5))
    y = rng.uniform(-400, 400, 5)
    table = f"{{x: {np.round(x, 3).tolist()}, y: {np.round(y, 3).tolist()}}}"
    spring = f"{{type: spring, between: [ground.A, block.B], free_length: 200, force: {table}}}"
    for load in (spring, GAS):
        m = da.loads(FILE.replace("LOAD", load))
        bends = 0.2 + np.round(x, 3) / 1000 if load is spring else np.zeros(0)
        ends = np.array([0.16, *bends[(bends > 0.16) & (bends < 0.24)], 0.24])
        half, middle = np.diff(ends)[:, None] / 2, (ends[1:] + ends[:-1])[:, None] / 2
        nodes, weights = np.polynomial.legendre.leggauss(12)
        still = m.with_values({"drives.G.position": 0.2, "drives.G.speed": 0})
        effort = da.statics(still, positions=(middle + half * nodes).ravel().tolist()).effort("G")
        area = float((half * weights).ravel() @ effort)
        s = da.simulate(m, "0.1 s", {"G": {"position": "0.2 m", "speed": "0.4 m/s"}})
        assert s.energy_residual < 1e-8
        both = da.simulate(m, "1e-9 s", {"G": {"position": "0.16 m", "speed": 0}}, count=2).potential[0]
        end = da.simulate(m, "1e-9 s", {"G": {"position": "0.24 m", "speed": 0}}, count=2).potential[0]
        assert end - both == pytest.approx(area, rel=1e-9, abs=1e-9)


def test_a_bump_stop_with_play_throws_back() -> None:
    bump = TABLE.replace(
        "[-30, -10, 0, 20], y: [-500, -40, 0, 0]", "[-100, -20, 20, 100], y: [-8000, 0, 0, 8000]"
    )
    m = da.loads(FILE.replace("LOAD", bump))
    s = da.simulate(m, "2 s", {"G": {"position": "200 mm", "speed": "1 m/s"}})
    reach = 0.02 + 1 / math.sqrt(1e5 / 2)  # half of m v^2 is half of k d^2
    assert s.position("G").max() - 0.2 == pytest.approx(reach, rel=1e-3)
    assert s.energy_residual < 1e-8
    period = 4 * 0.02 / 1 + 2 * math.pi * math.sqrt(2 / 1e5)
    back = da.simulate(m, f"{period} s", {"G": {"position": "200 mm", "speed": "1 m/s"}})
    assert back.position("G")[-1] == pytest.approx(0.2, abs=1e-8)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "y: [-500, -40, 0, 0]",
            "y: [-500, -40, 0]",
            "the table has 4 values in x and 3 in y; give one y for each x",
        ),
        (
            "[-30, -10, 0, 20]",
            "[-30, -10, -10, 20]",
            "x of the table does not increase from its item 2 to 3; sort",
        ),
        (
            "free_length: 200",
            "stiffness: 3",
            "both a stiffness and a table of its force are given; leave one of them out",
        ),
        (", force: {x: [-30, -10, 0, 20], y: [-500, -40, 0, 0]}", "", "the key 'stiffness' is missing"),
    ],
)
def test_wrong_tables_are_told(old: str, new: str, says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(FILE.replace("LOAD", TABLE.replace(old, new)), name="s.yaml")
    assert says in str(caught.value)
    assert str(caught.value).startswith("s.yaml:5: ")
