"""What must hold of every study: its designs are those of the analyses, and no bit depends on who computed it."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.studies import Study, StudyResult
from dalembert.studies.sampling import Plan, Sobol, permuted
from dalembert.studies.spreads import Spread

VARY = {"stroke": "± 0.5 mm", "bore": "uniform ± 2 %", "pressure": "5.5..6.5 MPa", "density": "normal 1 %"}
OUTPUTS = ["effort.O", "magnitude.A"]


def pump(**options: object) -> Study:
    return da.study(da.load(examples()["pump"]), VARY, OUTPUTS, **{"designs": 300, "seed": 7, **options})


def same(a: StudyResult, b: StudyResult) -> bool:
    return all(np.array_equal(a[n], b[n], equal_nan=n != "status") for n in [*a.study.outputs, "status"])


@pytest.mark.parametrize("draw", ["random", "sobol", "latin"])
def test_a_design_is_the_analysis_of_its_mechanism(draw: str) -> None:
    s = pump(draw=draw)
    r = s.run()
    for n in (0, 17, 299):
        own = da.dynamics(s.mechanism_of(n))
        assert r["effort.O"][n] == pytest.approx(np.abs(own.effort("O")).max(), rel=1e-12)
        assert r["magnitude.A"][n] == pytest.approx(
            np.linalg.norm(own.reaction("A"), axis=1).max(), rel=1e-12
        )


def test_a_block_is_the_call_of_the_kernel() -> None:
    s = pump()
    k = da.compile(s.mechanism, list(s.paths), OUTPUTS, "peak")
    found, _ = s.block(100, 200)
    assert np.array_equal(found["effort.O"], k(s.plan.values(100, 200)).value("effort.O"))


def test_no_bit_depends_on_blocks_threads_or_where_it_is_kept(tmp_path: Path) -> None:
    s = pump(designs=9000)
    r = s.run(threads=1)
    whole, _ = s.block(0, 9000)
    assert np.array_equal(r["effort.O"], whole["effort.O"])
    stored = s.run(tmp_path / "s.zarr", threads=3)
    assert len(stored.ledger) > 1
    assert same(r, stored)
    assert same(r, StudyResult.open(tmp_path / "s.zarr"))
    assert same(r, pickle.loads(pickle.dumps(s)).run())


def test_an_extended_study_is_the_longer_one(tmp_path: Path) -> None:
    for draw in ("random", "sobol"):
        pump(designs=5000, draw=draw).run(tmp_path / draw)
        longer = pump(designs=5000, draw=draw).extended(9500).run(tmp_path / draw)
        assert same(longer, pump(designs=9500, draw=draw).run())
    with pytest.raises(da.ModelError, match="a study drawn by latin is whole; only random and sobol"):
        pump(draw="latin").extended(400)


def test_a_number_drawn_at_random_does_not_depend_on_the_others() -> None:
    two = da.study(
        da.load(examples()["pump"]),
        {"bore": VARY["bore"], "stroke": VARY["stroke"]},
        OUTPUTS,
        designs=300,
        seed=7,
    )
    assert np.array_equal(two.plan.values(0, 300)[:, 1], pump().plan.values(0, 300)[:, 0])


def test_sobol_points_are_those_of_scipy() -> None:
    from scipy.stats import qmc

    row = qmc.Sobol(3, scramble=True, bits=30, rng=np.random.default_rng(5))
    expected = row.random(1 << 17)[65_000:] + 0.5 * 2.0**-30
    found = Sobol(5, 3, 1 << 17)(np.arange(65_000, 1 << 17)).T
    assert np.array_equal(found, expected)


def test_a_latin_hypercube_has_one_design_in_each_layer() -> None:
    plan = Plan(("a", "b"), (Spread("uniform", 0, 1), Spread("uniform", 0, 1)), "latin", 777, 3)
    layers = np.sort(np.floor(plan.values(0, 777) * 777), axis=0)
    assert np.array_equal(layers, np.stack([np.arange(777)] * 2, axis=1))
    assert not np.array_equal(permuted(np.arange(9), 9, 0, "a"), permuted(np.arange(9), 9, 0, "b"))


@pytest.mark.parametrize(
    "spread",
    [
        Spread("normal", 3, 0.2),
        Spread("tolerance", 3, 0.6),
        Spread("uniform", 1, 2),
        Spread("levels", levels=(1, 2, 4)),
    ],
)
def test_the_draw_has_the_spread(spread: Spread) -> None:
    values = Plan(("p",), (spread,), "latin", 20_000, 1).values(0, 20_000)[:, 0]
    assert values.std() == pytest.approx(spread.sigma, rel=2e-3)
    assert values.mean() == pytest.approx(3 if spread.a == 3 else values.mean(), rel=1e-4)
    if spread.kind != "normal":
        low, high = spread.ends
        assert low <= values.min() < values.max() <= high


def test_correlated_numbers_are() -> None:
    s = pump(designs=20_000, correlation={("stroke", "density"): 0.6})
    values = s.plan.values(0, 20_000)
    assert np.corrcoef(values[:, 0], values[:, 3])[0, 1] == pytest.approx(0.6, abs=0.02)
    assert np.array_equal(s.plan.values(5000, 5003), values[5000:5003])


def test_all_combinations_of_levels() -> None:
    s = da.study(
        da.load(examples()["pump"]),
        {"stroke": "50..60 mm in 3", "bore": ["40 mm", "50 mm"]},
        OUTPUTS,
        draw="factorial",
    )
    assert s.plan.values(0, 6).tolist() == [[a, b] for a in (0.05, 0.055, 0.06) for b in (0.04, 0.05)]
    assert s.run().counts() == {"ok": 6}


def test_a_table_of_designs() -> None:
    m = da.load(examples()["pump"])
    s = da.study(m, ["bore", "stroke"], OUTPUTS, draw={"bore": [0.04, 0.05], "stroke": ["50 mm", "60 mm"]})
    assert s.run()["effort.O"][1] == pytest.approx(np.abs(da.dynamics(m).effort("O")).max(), rel=1e-12)


def test_a_pickled_kernel_gives_the_same_bits() -> None:
    k = da.compile(da.four_bar(), ["links.coupler.mass"], ["effort.O2"], "peak")
    other = pickle.loads(pickle.dumps(k))
    assert np.array_equal(other([1.0, 2.0]).value("effort.O2"), k([1.0, 2.0]).value("effort.O2"))


def test_where_the_kernel_does_not_reach_designs_are_analysed_one_by_one(tmp_path: Path) -> None:
    m = da.load(examples()["balance_position"])
    path = next(f"links.{name}.mass" for name, link in m.links.items() if link.mass)
    s = da.study(m, {path: "uniform ± 20 %"}, designs=20)
    assert s.why_slow == "equilibrium positions cannot be compiled"
    r = s.run(tmp_path / "s", threads=2)
    assert len(r.ledger) > 1
    for n in (0, 19):
        own = da.solve(s.mechanism_of(n))
        name = s.outputs[0]
        kind, _, of = name.partition(".")
        expected = getattr(own, kind)(of)
        assert np.allclose(r[name][n], np.abs(expected).max(axis=0), rtol=1e-13)
    assert same(r, s.run())
