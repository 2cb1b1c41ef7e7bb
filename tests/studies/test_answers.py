"""What the designs say together, against closed forms, and where a linear answer misleads."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import CODES
from dalembert.bundled import examples
from dalembert.studies import Study
from dalembert.studies.limits import read_limit
from dalembert.studies.output.study_text import summary
from dalembert.studies.study_result import failures
from tests.kernel.machines import turning_arm

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


@pytest.mark.parametrize("count", [12, 13, 14])
def test_the_worst_case_of_numbers_that_raise_and_lower(count: int) -> None:
    """Couples of either sign: up to a dozen by every corner, of more by the signs of the derivatives."""
    signs = [(-1) ** (k // 2) for k in range(count)]
    spread = {f"q{k}": f"uniform ± {k + 1} %" for k in range(count)}
    law = "-held" + "".join(f"{s:+d}*q{k}" for k, s in enumerate(signs))
    text = f"""
units: {{angle: rad}}
parameters: {{{", ".join(f"q{k}: {10 + k} N*m" for k in range(count))}, held: 500 N*m}}
links: {{ground: {{points: {{O: [0, 0]}}}}, arm: {{points: {{O: [0, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, arm]}}}}
drives: {{O: {{position: 0}}}}
loads: {{M: {{type: couple, on: arm, by: ground, value: "{law}"}}}}
"""
    found = da.study(da.loads(text), spread, ["effort.O"], designs=10).worst_case("effort.O")
    ends = {f"q{k}": (10 + k) * (1 - s * (k + 1) / 100) for k, s in enumerate(signs)}
    assert found.value == pytest.approx(500 - sum(s * ends[f"q{k}"] for k, s in enumerate(signs)))
    assert found.at == pytest.approx(ends)
    assert ("4096 corners" in found.assumed) == (count == 12)
    assert ("one corner, chosen by the signs of the derivatives" in found.assumed) == (count > 12)


def test_the_worst_case_says_which_corners_have_no_value() -> None:
    m = da.load(examples()["four_bar"])
    length = m.links["coupler"].points["B"][0]
    vary = {"links.coupler.points.B.0": [length, 0.2 * length], "links.coupler.weight": "± 5 %"}
    found = da.study(m, vary, ["effort.O2"], designs=10).worst_case("effort.O2")
    assert found.assumed.endswith("; 2 corners have no value")
    vary = {"links.coupler.points.B.0": [0.2 * length, 0.21 * length]}
    with pytest.raises(da.ModelError, match=r"no corner has a value of effort.O2; make the spreads smaller"):
        da.study(m, vary, ["effort.O2"], designs=10).worst_case("effort.O2")


def test_shares_need_two_designs_and_are_none_where_nothing_scatters() -> None:
    s = arm(designs=2)
    two = s.contributions("effort.O", "sobol", 2)
    assert two.sigma > 0
    assert s.contributions_along("effort.O", 2).sigma == pytest.approx(two.sigma)
    with pytest.raises(da.ModelError, match="designs is 1; give a whole number from 2 to"):
        s.contributions("effort.O", "sobol", 1)
    still = da.study(da.loads(ARM), {"pull": "± 5 %"}, ["angle.arm"]).contributions("angle.arm", "sobol", 2)
    assert (still.shares, still.total, still.sigma) == ({"pull": 0.0}, {"pull": 0.0}, 0.0)


def curved(part: float, reduce: str = "mean") -> Study:
    """x + part (x^2 - 1) in its spread, x normal: of variance 1 + 2 part^2."""
    text = f"""
units: {{angle: rad}}
parameters: {{x: {{value: 1 N*m}}}}
links: {{ground: {{points: {{O: [0, 0]}}}}, arm: {{points: {{O: [0, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, arm]}}}}
drives: {{O: {{position: 0}}}}
loads: {{M: {{type: couple, on: arm, by: ground, value: "-(x + {part}*(x - 1 N*m)*(x - 1 N*m)/(1 N*m))"}}}}
"""
    return da.study(da.loads(text), {"x": "normal 1 N*m"}, ["effort.O"], reduce=reduce, seed=5)


@pytest.mark.parametrize(("part", "told"), [(0.0, False), (0.3, False), (0.9, True)])
def test_a_curved_answer_is_said_from_a_quarter_on(part: float, told: bool) -> None:
    """The spread that the designs have is sqrt(1 + 2 part^2) times the linear one."""
    found = curved(part).contributions("effort.O")
    assert found.sigma == pytest.approx(1.0, rel=1e-6)
    assert ("it is not linear: the linear standard deviation is 1, of 256 designs" in found.note) == told
    numbers = [float(x) for x in re.findall(r"designs ([\d.]+)", found.note)]
    assert numbers == pytest.approx([(1 + 2 * part**2) ** 0.5] * told, rel=0.15)


def test_an_answer_that_spreads_less_than_its_slope_says_is_told_too() -> None:
    """sin x of x normal with 1: of variance (1 - exp(-2))/2, where the slope says 1."""
    m = da.loads(ARM.replace("[0, -pull]", '[0, "-1 N*sin((pull - 5 N)/(1 N))"]'))
    found = da.study(m, {"pull": "normal 1 N"}, ["effort.O"], seed=5).contributions("effort.O")
    assert found.sigma == pytest.approx(1.0, rel=1e-6)
    (sampled,) = [float(x) for x in re.findall(r"it is not linear: .*designs ([\d.]+)", found.note)]
    assert sampled == pytest.approx(((1 - np.exp(-2)) / 2) ** 0.5, rel=0.15)


def test_designs_that_keep_all_limits_keep_each() -> None:
    m = da.load(examples()["four_bar"])
    vary = {"loads.T_4.value": [f"{x} lbf*in" for x in (100, 110, 120, 130, 140)]}
    found = da.study(m, vary, ["effort.O2", "reaction.A.magnitude"], draw="factorial").run()
    low, high = (
        float(np.sort(found[name])[k]) for name, k in (("effort.O2", 1), ("reaction.A.magnitude", 3))
    )
    limits = {"effort.O2": f">= {low!r} N*m", "reaction.A.magnitude": f"<= {high!r} N"}
    r = da.study(m, vary, ["effort.O2", "reaction.A.magnitude"], draw="factorial", limits=limits).run()
    kept = r["effort.O2"] >= low, r["reaction.A.magnitude"] <= high
    assert [k.mean() for k in kept] == pytest.approx([0.8, 0.8])
    assert list(r.shares().values()) == pytest.approx([0.8, 0.8, float((kept[0] & kept[1]).mean())])
    assert list(r.shares())[-1] == "all"
    assert r.shares()["all"] < 0.8


@pytest.mark.parametrize(
    ("limit", "kept"),
    [
        ("< 3 N*m", [1, 1, 1, 0]),
        ("<3 N*m", [1, 1, 1, 0]),
        (">=2 N*m", [0, 1, 1, 1]),
        ("<= 2 N*m", [1, 1, 0, 0]),
        ("≤ 2.999 N*m", [1, 1, 0, 0]),
        ("> 2 N*m", [0, 1, 1, 1]),
        ("≥ 3000 N*mm", [0, 0, 1, 1]),
        (">= 4.001 N*m", [0, 0, 0, 0]),
        ("2..3 N*m", [0, 1, 1, 0]),
        ("<= 0.4 m*pull", [1, 1, 0, 0]),
        (">= 2*(1 N*m + 0.5 N*m)", [0, 0, 1, 1]),
        ("2 N*m..3000 N*mm", None),
        ("-9 N*m .. 1 N*m", [1, 0, 0, 0]),
    ],
)
def test_a_limit_is_kept_up_to_its_ends(limit: str, kept: list[int] | None) -> None:
    arm_ = da.loads(ARM)
    if kept is None:
        kept = [0, 1, 1, 0]
    found = read_limit("e", limit, {"e": "moment"}, arm_)
    values = np.array([1.0, 2.0, 3.0, 4.0])
    assert found.kept(values).astype(int).tolist() == kept
    assert found.text == limit
    assert not found.kept(np.array([np.nan])).any()
    both = np.stack([values, np.full(4, values[1])], axis=1)  # all components have to keep it
    assert found.kept(both).astype(int).tolist() == [k * kept[1] for k in kept]


@pytest.mark.parametrize(
    ("limit", "said"),
    [
        ("3..2 N*m", r"limit of e: '3..2 N\*m' leaves nothing between; write '< 45 N\*m'"),
        ("2..2 N*m", "leaves nothing between"),
        ("45 N*m", "limit of e: '45 N\\*m' is not a limit"),
        ("< 45 mm", "limit of e: "),
    ],
)
def test_a_limit_that_is_none(limit: str, said: str) -> None:
    with pytest.raises(da.ModelError, match=said):
        read_limit("e", limit, {"e": "moment"}, da.loads(ARM))


SEVEN = (0.1, 0.2, 0.15, 0.12, 0.16, 0.17, 0.18)


def test_the_first_of_the_failed_are_named_in_their_order() -> None:
    m = da.load(examples()["four_bar"])
    length = m.links["coupler"].points["B"][0]
    vary = {"links.coupler.points.B.0": [length, *(x * length for x in SEVEN)]}
    r = da.study(m, vary, ["effort.O2"], draw="factorial").run()
    (failure,) = r.failed()
    assert (failure.status, failure.designs, failure.first) == ("not_assembled", 7, (1, 2, 3, 4, 5))
    assert r.failed(2)[0].first == (1, 2)
    assert r.ok.tolist() == [True] + [False] * 7
    assert r.values("effort.O2").tolist() == [r["effort.O2"][0]]
    assert (r.worst("effort.O2"), r.best("effort.O2")) == (0, 0)
    assert r.share("effort.O2", "> -1e9 N*m") == 1 / 8


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


@pytest.mark.parametrize(("other", "places"), [("5 N*m", "2 and 4"), ("5.5 N*m", "4 and 2")])
def test_a_peak_that_jumps_between_positions_is_said(other: str, places: str) -> None:
    """From where it is mostly, to a later position or an earlier one."""
    m = da.loads(IN_TURN.replace("other: 5 N*m", f"other: {other}"))
    s = da.study(m, {"one": "± 20 %", "other": "± 20 %"}, ["effort.O"])
    assert s.contributions("effort.O").note.startswith(f"the peak jumps between positions {places} (in ")
    assert 'use by="sobol"' in s.contributions("effort.O").note


def test_a_peak_that_is_the_same_everywhere_does_not_jump() -> None:
    """The pin's reaction of an arm that turns evenly: which position is largest by its last digit differs."""
    numbers = {"links.arm.mass": "± 2 %", "links.arm.center.0": "± 2 %"}
    of = "reaction.O.magnitude"
    assert da.study(turning_arm(), numbers, [of]).contributions(of).note == ""


def test_a_peak_that_moves_to_the_next_position_does_not_jump() -> None:
    """From the first of a turn to the last."""
    text = IN_TURN.replace("[0, 1.5, 3, 4.5, 6]", "[0.3, 1.5, 3, 4.5, 5.983185307179586]")
    ends = "2*max(0, cos(O) - 0.5)*max(0, {}sin(O))"
    law = f'"one*{ends.format("")} + other*{ends.format("-")}"'
    text = re.sub(r'"one\*.*"', law, text)
    note = (
        da.study(da.loads(text), {"one": "± 20 %", "other": "± 20 %"}, ["effort.O"])
        .contributions("effort.O")
        .note
    )
    assert "jumps" not in note


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


LIMIT = 0.3 + 0.25 - 0.1
"""Longest ground on which the template's crank turns: coupler and rocker less the crank."""


@pytest.mark.long
def test_designs_without_an_answer_say_why_and_how_they_differ(tmp_path: Path) -> None:
    """The shares by reason, the first one's sentence, and the bias stand in the text and on the page."""
    m = da.four_bar(crank=0.1, coupler=0.3, rocker=0.25, ground=0.35)
    vary = {"links.coupler.mass": "± 10 %", "links.ground.points.O4.0": "0.3..0.5 m"}
    r = da.study(m, vary, ["effort.O2"], designs=1000, seed=1).run(tmp_path / "s")
    too_long = r.study.plan.values(0, 1000)[:, 1] > LIMIT
    assert list(r.status == "not_assembled") == too_long.tolist()
    (failure,) = r.failed()
    first = int(np.argmax(too_long))
    own = da.solve(r.study.mechanism_of(first)).problems()[0]
    assert failure.reason == f"position {own[0]}: {own[2]}"
    assert failure.share == too_long.mean()
    assert failure.differs is not None
    assert failure.differs._replace(value=0.0) == ("links.ground.points.O4.0", True, 0.0, 1.0, 0.0)
    assert failure.differs.value == pytest.approx(LIMIT, abs=1e-3)
    count = int((~too_long).sum())
    bias = (
        f"Means, sigmas and percentiles are of the {count} of 1,000 designs that have numbers ({count / 10:.2f}%); "
        f"the others have none: not_assembled {failure.share:.2%}. As these may differ from the rest, the figures may "
        "be biased."
    )
    differ = "These designs differ most in links.ground.points.O4.0: 100% of them have it above 0.45 m, and 0% of the"
    r.report().save(tmp_path / "s.html")
    r.report().save(tmp_path / "s.txt")
    texts = [summary(r), *((tmp_path / f"s.{kind}").read_text(encoding="utf-8") for kind in ("txt", "html"))]
    for text in texts:
        shown = " ".join(text.split())
        assert bias in shown
        assert differ in shown
        assert own[2] in shown


def test_failures_that_no_number_tells_apart_name_none() -> None:
    """A crank that is refused whatever else varies."""
    m = da.four_bar()
    s = da.study(
        m, {"links.coupler.mass": "± 10 %", "links.rocker.mass": "± 10 %"}, ["effort.O2"], designs=400, seed=2
    )
    r = s.run()
    marks = np.zeros(400, np.uint8)
    marks[::2] = CODES.index("failed")
    (failure,) = failures(r, marks, 5)
    assert (failure.designs, failure.share, failure.differs) == (200, 0.5, None)
    assert (
        failure.sentence
        == "The description refuses the values of these designs, or one of them is not finite."
    )
    (whole,) = failures(r, np.full(400, CODES.index("failed"), np.uint8), 5)
    assert (whole.designs, whole.share, whole.differs) == (400, 1.0, None)  # nothing to tell them apart from
    assert r.unsolved() == (400, 0)
    assert "biased" not in summary(r)


def test_designs_that_the_description_refuses_say_what_it_says() -> None:
    m = da.load(examples()["gear_train"])
    r = da.study(m, {"links.carrier.points.P.0": [0.036, 1.0]}, draw="factorial").run()
    (failure,) = r.failed()
    assert (failure.status, failure.first) == ("failed", (1,))
    assert "gear 'sun_mesh': centres 1 m apart, but pitch radii" in failure.reason


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
