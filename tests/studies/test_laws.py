"""What must hold of every study: its designs are those of the analyses, and no bit depends on who computed it."""

from __future__ import annotations

import math
import pickle
import re
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.studies import Study, StudyResult, spreads
from dalembert.studies.sampling import DesignPlan, Sobol, permuted
from dalembert.studies.spreads import Spread, read_spread

VARY = {"stroke": "± 0.5 mm", "bore": "uniform ± 2 %", "pressure": "5.5..6.5 MPa", "density": "normal 1 %"}
OUTPUTS = ["effort.O", "reaction.A.magnitude"]


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
        assert r["reaction.A.magnitude"][n] == pytest.approx(
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
    with pytest.raises(
        da.ModelError, match="a study drawn by latin cannot be extended; only random and sobol"
    ):
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
    plan = DesignPlan(("a", "b"), (Spread("uniform", 0, 1), Spread("uniform", 0, 1)), "latin", 777, 3)
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
    values = DesignPlan(("p",), (spread,), "latin", 20_000, 1).values(0, 20_000)[:, 0]
    assert values.std() == pytest.approx(spread.sigma, rel=2e-3)
    assert values.mean() == pytest.approx(3 if spread.a == 3 else values.mean(), rel=1e-4)
    if spread.kind != "normal":
        low, high = spread.ends
        assert low <= values.min() < values.max() <= high


CUT_NORMAL = math.sqrt(1 - 6 * math.exp(-4.5) / math.sqrt(2 * math.pi) / math.erf(3 / math.sqrt(2)))


@pytest.mark.parametrize(
    ("said", "nominal", "kind", "ends", "sigma"),
    [
        ("± 5 %", -20.0, "tolerance", (-21.0, -19.0), CUT_NORMAL / 3),
        ("+- 0.6", 3.0, "tolerance", (2.4, 3.6), 0.2 * CUT_NORMAL),
        ("+/-0.6", 3.0, "tolerance", (2.4, 3.6), 0.2 * CUT_NORMAL),
        ("±5 %", -20.0, "tolerance", (-21.0, -19.0), CUT_NORMAL / 3),
        ("normal 2 %", -50.0, "normal", (-53.0, -47.0), 1.0),
        ("normal 0.5", 0.0, "normal", (-1.5, 1.5), 0.5),
        ("uniform ± 10 %", -4.0, "uniform", (-4.4, -3.6), 0.8 / math.sqrt(12)),
        ("-2..4", 9.0, "uniform", (-2.0, 4.0), 6 / math.sqrt(12)),
        ("70..90 in 3", 0.0, "levels", (70.0, 90.0), math.sqrt(200 / 3)),
        ("range", 0.0, "uniform", (5.0, 8.0), 3 / math.sqrt(12)),
        ([4.0, 1.0, 7.0], 0.0, "levels", (1.0, 7.0), math.sqrt(6)),
    ],
)
def test_what_a_spread_says(
    said: object, nominal: float, kind: str, ends: tuple[float, float], sigma: float
) -> None:
    """Its ends and its standard deviation; of a percentage the size of what it is one of."""
    found = read_spread(said, nominal, lambda x: float(str(x)), (5.0, 8.0))
    assert found.kind == kind
    assert found.ends == pytest.approx(ends)
    assert found.sigma == pytest.approx(sigma)
    low, width, a, b, normal = found.law
    share = NormalDist().cdf(-3) if kind == "tolerance" else 0.0
    assert (low, width) == pytest.approx((share, 1 - 2 * share))
    assert normal == (kind in ("tolerance", "normal"))
    if kind != "levels":
        assert (a, a + b) == pytest.approx((nominal, nominal + (ends[1] - nominal) / 3) if normal else ends)
    else:
        picked = found.pick(np.array([0.0, 0.3333, 0.3334, 0.9999, 1.0]))
        assert picked.tolist() == [found.levels[k] for k in (0, 0, 1, 2, 2)]


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ("± 5 %", "5 % of a number that is 0 is nothing"),
        ("± 0", "a tolerance of '0' is not positive"),
        ("± -2", "a tolerance of '-2' is not positive"),
        ("9..9", "the range from 9 to 9 is empty; write the smaller end first"),
        ("1..9 in 1", "levels=1 is out of range; use 2 to 1000000"),
        ("1..9 in 1000001", "levels=1000001 is out of range"),
        ("range", "it states no range"),
        ("normal ± 3", "'normal ± 3' says no spread"),
        ("uniform 3", "'uniform 3' says no spread"),
        ("3", "'3' says no spread"),
        ([], "a list of 0 values says no levels"),
        ([1.0, 2.0, 1.0], "a value occurs twice in the list"),
    ],
)
def test_what_is_no_spread(said: object, what: str) -> None:
    with pytest.raises(da.ModelError, match=re.escape(what)):
        read_spread(said, 0.0, lambda x: float(str(x)))


def test_a_number_has_as_many_levels_as_are_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spreads, "MOST", 3)
    assert read_spread([1.0, 5.0, 2.0], 0.0, float).levels == (1, 5, 2)
    assert read_spread("1..2 in 3", 0.0, lambda x: float(str(x))).levels == (1, 1.5, 2)
    with pytest.raises(da.ModelError, match="a list of 4 values says no levels; give 1 to 3"):
        read_spread([1.0, 5.0, 2.0, 3.0], 0.0, float)


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
    assert s.plan.values(0, 1).tolist() == [[0.04, 0.05]]


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
