"""What the designs say together, against closed forms, and where a linear answer misleads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.studies import Study

ARM = """
units: {angle: rad}
gravity: standard
parameters: {heavy: 2 kg, reach: 0.3 m, pull: 5 N}
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], P: [1, 0]}, mass: heavy, center: [reach, 0]}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: 0}}
loads: {F: {type: force, on: arm, at: P, by: ground, value: [0, -pull]}}
"""
"""A level arm: the drive's torque is heavy g reach + 1 m pull."""

IN_TURN = """
units: {angle: rad}
parameters: {one: 5 N*m, other: 5 N*m}
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0]}}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: [0, 1.5, 3, 4.5, 6]}}
loads: {M: {type: couple, on: arm, by: ground, value: "one*max(0, sin(O)) + other*max(0, -sin(O))"}}
"""
"""Two couples in turn, nearly equal: which of them is the peak is decided by their tolerances."""

WEIGHT = 2 * 9.80665


def arm(**options: object) -> Study:
    vary = {"heavy": "uniform ± 10 %", "reach": "uniform ± 10 %", "pull": "normal 0.2 N"}
    return da.study(
        da.loads(ARM), vary, ["effort.O"], **{"designs": 20_000, "seed": 2, "draw": "sobol", **options}
    )


def test_contributions_are_those_of_the_closed_form() -> None:
    """T = m g c + F: with r = 0.1 / sqrt(3) the parts of the variance are (W c r)^2 twice, sigma^2, and (W c r^2)^2."""
    big, small = (WEIGHT * 0.3) ** 2 / 300, 0.2**2
    linear = arm().contributions("effort.O")
    assert linear.sigma == pytest.approx((2 * big + small) ** 0.5, rel=1e-6)
    assert linear.shares["heavy"] == pytest.approx(big / (2 * big + small), rel=1e-6)
    assert linear.note == ""
    both = (WEIGHT * 0.3) ** 2 / 300**2
    total = 2 * big + small + both
    found = arm().contributions("effort.O", "sobol", 8192)
    assert found.sigma == pytest.approx(total**0.5, rel=1e-3)
    assert list(found.shares.values()) == pytest.approx([big / total, big / total, small / total], abs=2e-3)
    assert list(found.total.values()) == pytest.approx([(big + both) / total] * 2 + [small / total], abs=2e-3)


def test_the_worst_case_is_the_corner_of_the_closed_form() -> None:
    found = arm().worst_case("effort.O")
    assert found.value == pytest.approx(WEIGHT * 1.1 * 0.3 * 1.1 + 5.6, rel=1e-12)
    assert found.at == pytest.approx({"heavy": 2.2, "reach": 0.33, "pull": 5.6})
    assert "8 corners" in found.assumed


def test_shares_percentiles_and_extremes() -> None:
    r = arm(limits={"effort.O": "< 11 N*m"}).run()
    values = r["effort.O"]
    numbers = r.study.plan.values(0, 20_000)
    assert values == pytest.approx(9.80665 * numbers[:, 0] * numbers[:, 1] + numbers[:, 2], rel=1e-13)
    assert r.shares() == {"effort.O < 11 N*m": float((values < 11).mean())}
    assert r.share("effort.O", "10..11 N*m") == float(((values >= 10) & (values <= 11)).mean())
    assert r.percentiles("effort.O", (50,)) == {50: float(np.median(values))}
    assert values[r.worst("effort.O")] == values.max()
    assert values[r.best("effort.O")] == values.min()
    counts, ends = r.histogram("effort.O", 10)
    assert counts.sum() == 20_000
    assert (ends[0], ends[-1]) == (values.min(), values.max())


def test_a_number_that_changes_nothing_is_named() -> None:
    m = da.load(examples()["pump"])
    assert da.study(m, {"density": "± 1 %", "bore": "± 1 %"}, ["effort.O"], static=True).idle() == (
        "density",
    )
    assert da.study(m, {"density": "± 1 %", "bore": "± 1 %"}, ["effort.O"]).idle() == ()


def test_a_peak_that_jumps_between_positions_is_said() -> None:
    s = da.study(da.loads(IN_TURN), {"one": "± 20 %", "other": "± 20 %"}, ["effort.O"])
    assert s.contributions("effort.O").note.startswith("the peak jumps between positions ")
    assert 'trust by="sobol"' in s.contributions("effort.O").note


def test_failed_designs_are_counted_by_status_and_never_dropped(tmp_path: Path) -> None:
    """A coupler too short for the loop to close at every position."""
    m = da.load(examples()["four_bar"])
    length = m.links["coupler"].points["B"][0]
    vary = {"links.coupler.points.B.0": [length, 0.2 * length]}
    s = da.study(m, vary, ["effort.O2"], draw="factorial", limits={"effort.O2": "> -1e9 N*m"})
    r = s.run(tmp_path / "s")
    assert r.counts() == {"ok": 1, "not_assembled": 1}
    assert list(r.status) == ["ok", "not_assembled"]
    assert np.isnan(r["effort.O2"]).tolist() == [False, True]
    assert [(f.status, f.designs, f.first) for f in r.failed()] == [("not_assembled", 1, (1,))]
    assert r.shares() == {"effort.O2 > -1e9 N*m": 0.5}


def test_blocks_computed_by_a_dask_cluster_have_the_same_bits(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    s = arm(draw="random")
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None, protocol="inproc://"
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        found = s.run(tmp_path / "s", scheduler=client)
    assert len(found.ledger) > 1
    assert np.array_equal(found["effort.O"], s.run()["effort.O"])


def test_no_scheduler_is_a_sentence() -> None:
    pytest.importorskip("distributed")
    with pytest.raises(
        da.ModelError, match=r"no dask scheduler answers at nowhere://x:.*; start one: dask scheduler"
    ):
        arm(designs=10).run(scheduler="nowhere://x")


@pytest.mark.long
def test_a_worker_killed_on_the_way_changes_no_bit(tmp_path: Path) -> None:
    """Two processes, one of them killed when blocks are under way; a scheduler asked by its address."""
    distributed = pytest.importorskip("distributed")
    s = arm(draw="random", designs=400_000)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        victim = cluster.workers[0]

        def kill(done: int, of: int) -> None:
            if victim.process.is_alive():
                victim.process.process._process.kill()

        found = s.run(tmp_path / "s", scheduler=cluster.scheduler_address, progress=kill)
    assert np.array_equal(found["effort.O"], s.run()["effort.O"])


def test_a_number_at_its_default_has_its_kind() -> None:
    """A direction of 0, which a saved file leaves out, is an angle all the same."""
    m = da.load(examples()["engine"])
    s = da.study(m, {"joints.cylinder.direction": "uniform ± 1 deg"}, ["effort.O2"], designs=4)
    assert s.plan.spreads[0].ends == pytest.approx((-np.pi / 180, np.pi / 180))
