"""Bearings: equivalent load and life in closed form, catalogue ratings of the books, pressure, choice, bad input."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.machine.bearings.bearing_load import BearingLoad
from dalembert.machine.bearings.compiled_life import life_expression
from dalembert.printing import number
from tests.machine.cranks import crank_machine
from tests.tiers import over, tiers

SHAFT = """
units: {{length: mm, angle: rad}}
links:
  ground: {{points: {{O: [0, 0]}}}}
  shaft: {{points: {{O: [0, 0]}}, mass: 0}}
joints:
  O: {{type: pin, links: [ground, shaft], bearing: {bearing}}}
drives:
  O: {{position: {{from: 0, to: {turn}, count: 72}}, speed: 300 rpm}}
loads:
  F: {{type: force, on: shaft, at: O, value: [{load}, 0]}}
"""


def shaft(load: str, bearing: str = "{rating: 12 kN}") -> Any:
    return da.dynamics(da.loads(SHAFT.format(load=load, bearing=bearing, turn=2 * math.pi)))


@over(4, 200)
def test_pressure_and_life_against_sums_of_ones_own(seed: int) -> None:
    """By the angles of the links, not by their rates: a finer cycle, and differences of the relative angle."""
    m = crank_machine(seed, 360)
    rating = {"rating": 3000.0, "diameter": 0.02, "length": 0.03}
    r = da.dynamics(m.with_values({"joints.A.bearing": rating}))
    b = da.bearing(r, "A")
    force = np.hypot(*r.reaction("A").T)
    assert np.allclose(b.pressure, force / 6e-4)
    phi = np.unwrap(r.angle("rod") - r.angle("crank"))
    turned = np.abs(np.diff(np.append(phi, phi[0] + 2 * np.pi * round((phi[-1] - phi[0]) / (2 * np.pi)))))
    mean = (force + np.roll(force, -1)) / 2
    own = ((mean**3 * turned).sum() / turned.sum()) ** (1 / 3)
    assert b.equivalent == pytest.approx(own, rel=2e-3)
    period = 2 * np.pi / abs(r.drive_speed("O")[0])
    assert b.hours == pytest.approx(b.turns / (turned.sum() / 2 / np.pi) * period / 3600, rel=2e-3)
    assert b.mean_pv == pytest.approx(float((b.pressure * 0.01 * np.abs(b.rate)).mean()), rel=1e-9)


@pytest.mark.parametrize(
    ("units", "of_pressure", "of_pv"),
    [
        ("{length: mm, angle: rad}", ("N/mm^2", 1e6), ("MPa*m/s", 1e6)),
        ("{angle: rad}", ("MPa", 1e6), ("MPa*m/s", 1e6)),
        (
            "{length: in, force: lbf, angle: rad}",
            ("lbf/in^2", 6894.757293168361),
            ("lbf/in^2*ft/min", 35.02536704929527),
        ),
    ],
)
def test_pressure_and_pv_are_printed_in_usual_units(
    units: str, of_pressure: tuple[str, float], of_pv: tuple[str, float]
) -> None:
    text = SHAFT.format(load="9000 N", bearing="{diameter: 20 mm, length: 15 mm}", turn=2 * math.pi)
    t = da.bearings(da.dynamics(da.loads(text.replace("{length: mm, angle: rad}", units))))
    said, b = str(t), t.loads["O"]
    assert f" {of_pressure[0]} " in said
    assert f" {of_pv[0]}" in said
    row = next(line.split() for line in said.splitlines() if line.startswith("O ") and len(line.split()) == 4)
    sizes = b.pressure.max() / of_pressure[1], b.pv.max() / of_pv[1], b.mean_pv / of_pv[1]
    assert [float(cell) for cell in row[1:]] == pytest.approx(sizes, rel=1e-5)


def test_a_couple_across_the_axis_is_printed() -> None:
    """That of a crank whose pin is in the plane of its bearing is what bends it there, out of that plane."""
    r = da.dynamics(da.load(examples()["rssr"]))
    t = da.bearings(r)
    bent = da.member_forces(r, "crank").at(0.0)["bending y"]
    assert t.loads["O"].couple == pytest.approx(np.abs(bent), rel=1e-9)
    said = " ".join(str(t).split())
    assert "O (629.005 N*mm), C (519.761 N*mm): a couple normal to the axis" in said
    assert da.bearings(da.dynamics(da.four_bar())).loads["O2"].tilting == 0


def test_a_bearing_in_space_has_axial_factors() -> None:
    m, joint = da.rssr(), "O"
    values = {"gravity": [0.0, -9.8, -3.0], f"joints.{joint}.bearing": {"rating": 5000.0}}
    r = da.dynamics(m.with_values(values))
    b = da.bearing(r, joint)
    assert b.axial.max() > 1
    assert math.isnan(b.equivalent)
    assert f"{joint}, C: an axial force, but the bearing has no axial_factor" in str(da.bearings(r))
    factors = {"rating": 5000.0, "radial_factor": 0.56, "axial_factor": 1.5, "diameter": 0.02, "length": 0.03}
    b = da.bearing(da.dynamics(r.mechanism.with_values({f"joints.{joint}.bearing": factors})), joint)
    assert np.allclose(b.load, np.maximum(b.radial, 0.56 * b.radial + 1.5 * b.axial))
    assert math.isfinite(b.hours)
    assert np.allclose(b.result[f"pressure.{joint}"], b.radial / 6e-4)


SPATIAL = {
    "kind": "roller",
    "rating": 5000.0,
    "static_rating": 900.0,
    "radial_factor": 0.56,
    "axial_factor": 0.2,
    "diameter": 0.02,
    "length": 0.03,
}


def test_every_number_of_a_bearing_in_space_is_that_of_its_formula() -> None:
    """From the reaction, the axis and the speeds of the links; the axis is no axis of the ground."""
    m = da.rssr().with_values({"gravity": [3.0, 9.8, -4.0], "joints.C.bearing": SPATIAL})
    rough = {"friction.coefficient": 0.3, "joints.C.friction": {"radius": 0.02}}
    r = da.dynamics(m.with_values(rough))
    t = da.bearings(r, ["C"], hours=5000.0, factor=1.3)
    b, e = t.loads["C"], np.array([0.1, 1.0, 0.0]) / math.hypot(0.1, 1.0)
    force, moment, rate = r.reaction("C"), r.reaction_moment("C"), r.speed("rocker") @ e
    radial = np.linalg.norm(np.cross(e, force), axis=1)
    axial = np.abs(force @ e)
    assert (force @ e < 0).any()
    assert np.abs(moment @ e).max() > 1e-3
    across = np.linalg.norm(np.cross(e, moment), axis=1)
    steady = np.maximum(radial, 0.56 * radial + 0.2 * axial)
    assert 0 < (steady == radial).sum() < 72
    turned = np.abs(rate)  # at even times
    equivalent = ((steady ** (10 / 3) * turned).sum() / turned.sum()) ** 0.3
    turns = 1e6 * (5000 / equivalent) ** (10 / 3)
    speed, pv = turned.mean(), radial / 6e-4 * 0.01 * turned
    for mine, own in (
        *((b.radial, radial), (b.axial, axial), (b.couple, across), (b.rate, rate), (b.load, steady)),
        *((b.time, np.full(72, 0.5 / 72)), (b.pressure, radial / 6e-4), (b.pv, pv), (b.mean_pv, pv.mean())),
        *((b.tilting, across.max()), (b.exponent, 10 / 3), (b.equivalent, equivalent), (b.speed, speed)),
        *((b.turns, turns), (b.hours, turns * 2 * np.pi / speed / 3600), (b.swings, True)),
        (b.static_safety, 900 / steady.max()),
    ):
        np.testing.assert_allclose(mine, own, rtol=1e-9)
    lives = 5000 * 3600 * speed / (2 * np.pi) / 1e6
    needed = 1.3 * equivalent * lives**0.3
    assert b.rating_for(5000, 1.3) == pytest.approx(needed)
    record = t.record(lambda kind, value: {kind: value})
    assert {name: record[name] for name in ("hours", "factor")} == {"hours": 5000.0, "factor": 1.3}
    assert record["bearings"]["C"].pop("sampling").keys() >= {"radial force", "mean PV"}
    assert record["bearings"]["C"] == {
        "equivalent_load": {"force": pytest.approx(equivalent)},
        "swings": True,
        "couple_not_counted": {"moment": pytest.approx(across.max())},
        "mean_turning": {"angular_speed": pytest.approx(speed)},
        "pressure": {"pressure": pytest.approx(radial.max() / 6e-4)},
        "mean_PV": pytest.approx(pv.mean()),
        "PV": pytest.approx(pv.max()),
        "turns": pytest.approx(turns),
        "hours": pytest.approx(turns * 2 * np.pi / speed / 3600),
        "static_safety": pytest.approx(900 / steady.max()),
        "rating_needed": {"force": pytest.approx(needed)},
        "chosen": None,
    }
    columns = {c.name: (c.kind, c.values) for c in t.columns()}
    assert {k: kind for k, (kind, _) in columns.items() if k.endswith(("C", "m^2"))} == {
        "radial_force.C": "force",
        "axial_force.C": "force",
        "couple_across.C": "moment",
        "turning_speed.C": "angular_speed",
        "pressure.C": "pressure",
        "pv.C": "pressure_speed",
    }
    for name, own in (("axial_force", axial), ("couple_across", across), ("turning_speed", rate)):
        np.testing.assert_allclose(columns[f"{name}.C"][1], own, rtol=1e-9)


def test_a_shaft_turns_one_way_and_the_other_joint_exchanged_alike() -> None:
    """Of two links that both turn, the rate is that of j against i."""
    m = crank_machine(1, 48)
    r, joint = da.dynamics(m), m.joints["A"]
    i, j = joint.links
    b = da.bearing(r, "A")
    np.testing.assert_allclose(b.rate, r.speed(j) - r.speed(i), rtol=1e-12)
    assert not da.bearing(shaft("1898"), "O").swings
    assert da.bearing(shaft("1898"), "O").speed == pytest.approx(10 * np.pi)
    assert da.bearing(shaft("1898"), "O").static_safety is None
    assert da.bearing(shaft("0"), "O").hours == math.inf


def test_each_position_counts_for_its_time_and_its_turn() -> None:
    """Uneven positions, from the last to the first: means are over time, the equivalent load is over the turn."""
    places = (2.0, 1.9, 1.1, 0.5, 0.4, 0.1)
    rating = {"rating": 3000.0, "diameter": 0.02, "length": 0.03}
    m = da.four_bar().with_values(
        {"drives.O2.position": places, "drives.O2.speed": -7.0, "joints.A.bearing": rating}
    )
    r = da.dynamics(m)
    b, time = da.bearing(r, "A"), np.array([0.05, 0.45, 0.7, 0.35, 0.2, 0.15]) / 7
    force, rate = np.hypot(*r.reaction("A").T), np.abs(r.speed("coupler") - r.speed("crank"))
    np.testing.assert_allclose(b.time, time)
    assert b.mean_pv == pytest.approx((force / 6e-4 * 0.01 * rate * time).sum() / time.sum())
    assert b.speed == pytest.approx((rate * time).sum() / time.sum())
    assert b.equivalent == pytest.approx(((force**3 * rate * time).sum() / (rate * time).sum()) ** (1 / 3))


def test_a_bearing_between_links_that_both_move_in_space() -> None:
    r = da.dynamics(da.spherical_four_bar())
    joint = next(n for n, j in r.mechanism.joints.items() if "ground" not in j.links and j.hinge)
    rate = r.freedom(joint, "turn")[1]
    assert np.ptp(rate) > 1
    np.testing.assert_allclose(da.bearing(r, joint).rate, rate, rtol=1e-9, atol=1e-9)


def test_the_rating_for_a_reliability_is_that_of_weibull() -> None:
    """Budynas and Nisbett, example 11-3: 413 lbf, 300 rpm, 30 kh, factor 1.2, reliability 0.99."""
    b = da.bearing(shaft("1898"), "O")
    lives = 30e3 * 3600 * 5 / 1e6
    own = 1.2 * 1898 * (lives / (0.02 + 4.439 * math.log(1 / 0.99) ** (1 / 1.483))) ** (1 / 3)
    assert b.rating_for(30e3, 1.2, 0.99, (0.02, 4.439, 1.483)) == pytest.approx(own)
    with pytest.raises(ModelError, match=r"life of a reliability of 0\.99; give the catalogue's weibull"):
        b.rating_for(30e3, reliability=0.99)


LIMITS = SHAFT.format(load="1000", bearing="{rating: 12 kN, diameter: 20 mm}", turn=2 * math.pi)
NEEDED = 1.5 * 1000 * (4000 * 3600 * 5 / 1e6) ** (1 / 3)


@pytest.mark.parametrize(
    ("rows", "chosen"),
    [
        ([(1.000001, 1.000001, 20)], 0),
        ([(0.999999, 9, 20)], None),  # its dynamic rating
        ([(9, 0.999999, 20)], None),  # its static one
        ([(9, 9, 19.99)], None),  # the pin does not go in
        ([(9, 9, 30), (9, 9, 20), (3, 3, 20), (2, 2, 25)], 2),  # by bore, then by rating
    ],
)
def test_a_row_is_enough_from_its_limits_on(
    rows: list[tuple[float, float, float]], chosen: int | None, tmp_path: Path
) -> None:
    """C in parts of the rating needed, C0 in parts of 2 x 1.5 x the largest load."""
    lines = [f"b{k},{c * NEEDED!r},{c0 * 3000!r},{d}" for k, (c, c0, d) in enumerate(rows)]
    (tmp_path / "t.csv").write_text("\n".join(["name,C [N],C0 [N],d [mm]", *lines]))
    r = da.dynamics(da.loads(LIMITS))
    t = da.bearings(r, hours=4000, table=tmp_path / "t.csv", factor=1.5, safety=2.0)
    row = t.chosen["O"]
    assert (row.name if row else None) == (None if chosen is None else f"b{chosen}")
    assert t.rows == len(rows)


def test_pressure_is_an_output_of_compiled_analyses() -> None:
    """With the bearing's own size as a varied number; nothing need turn for it."""
    sized = da.slider_crank(crank=0.05, rod=0.2).with_values(
        {"joints.A.bearing": {"diameter": 0.02, "length": 0.015}}
    )
    r = da.statics(
        sized.with_values({"loads": {"F": {"type": "force", "on": "rod", "at": "B", "value": [900.0, 50.0]}}})
    )
    assert np.allclose(r["pressure.A"], np.hypot(*r.reaction("A").T) / 3e-4)
    k = da.compile(sized, vary=["joints.A.bearing.diameter"], outputs=["pressure.A"], derivatives=True)
    wide, force = k([[0.04]]), np.hypot(*da.dynamics(sized).reaction("A").T)
    assert np.allclose(wide.value("pressure.A")[0], force / 6e-4)
    assert np.allclose(wide.gradient("pressure.A")[0, :, 0], -force / 6e-4 / 0.04)
    with pytest.raises(ModelError, match=r"unknown output 'pressure.B'; did you mean 'pressure.A'"):
        da.compile(sized, outputs=["pressure.B"])


SIZED = {f"joints.{j}.bearing": {"diameter": 0.02, "length": 0.015, "rating": 9e3} for j in ("O2", "A", "B")}


def sized() -> da.Mechanism:
    section = {"circle": 0.03, "endurance": 1e8, "ultimate": 4e8}
    return da.slider_crank(crank=0.05, rod=0.2).with_values(SIZED | {"links.rod.section": section})


@cache
def fine_cycle() -> da.Result:
    return da.dynamics(sized(), positions=2400)


@pytest.mark.parametrize("count", tiers([12], [24, 72]))
def test_what_half_of_the_positions_would_change_is_printed_and_no_less_than_the_error(count: int) -> None:
    """Against a cycle so fine that its error does not count; the rate of B, which swings, has kinks in PV."""
    m = sized()
    r, fine = da.dynamics(m, positions=count), fine_cycle()
    for joint in ("O2", "A", "B"):
        b, true = da.bearing(r, joint), da.bearing(fine, joint)
        changes = b.sampling()
        for name, value in true._summary().items():
            off = abs(b._summary()[name] / value - 1)
            assert off <= 1.05 * changes[name] + 1e-12, (joint, name)
        assert changes["mean PV"] < 0.5
    f, true_f = (da.member_forces(x, "rod").stress().fatigue() for x in (r, fine))
    assert abs(f.amplitude / true_f.amplitude - 1) <= f.sampling
    c, true_c = (da.motor(x, inertia=1e-3) for x in (r, fine))
    for name, value in true_c._summary().items():
        assert abs(c._summary()[name] / value - 1) <= 1.05 * c.sampling()[name] + 1e-9, name
    said = " ".join(str(da.bearings(r)).split())
    worst = max(x for j in ("O2", "A", "B") for x in da.bearing(r, j).sampling().values())
    start = (
        f"Means and greatest values are those of the {count} positions, not of the motion between them: with"
    )
    assert f"{start} every other position they differ by {number(100 * worst, 2)} % at most (" in said
    assert start in " ".join(str(c).split())


def test_an_odd_number_or_a_single_position_has_no_halves() -> None:
    m = da.slider_crank(crank=0.05, rod=0.2).with_values(SIZED)
    odd, one = (da.bearings(da.dynamics(m, positions=n)) for n in (73, 1))
    assert "those of the 73 positions, not of the motion between them." in " ".join(str(odd).split())
    assert "Means and greatest values" not in str(one)
    assert all(math.isnan(x) for x in odd.loads["A"].sampling().values())


@pytest.mark.parametrize("count", [1, 2])
def test_curves_are_drawn_of_several_positions_and_of_sizes_that_are_given(count: int) -> None:
    """Forces and turning of all joints, pressures of those with a size."""
    crank = da.slider_crank(crank=0.05, rod=0.2)
    for m, pressures in (
        (crank, []),
        (crank.with_values({"joints.A.bearing": SIZED["joints.A.bearing"]}), ["A"]),
    ):
        r = da.dynamics(m, positions=count)
        scenes = da.bearings(r).drawings()
        curves = [s.title for s in scenes if s.title.endswith(" of the joints")]
        known = ["Radial force", "Turning", *(["Pressure"] if pressures else [])] if count > 1 else []
        assert [title.removesuffix(" of the joints") for title in curves] == known
        if pressures and count > 1:
            legend = {t.text for t in scenes[-1].texts()}
            assert legend & set(r.joints) == {"A"}


def test_of_many_joints_the_first_six_are_drawn() -> None:
    r = da.dynamics(da.load(examples()["scissor_lift"]), positions=2)
    *polar, force, turning = da.bearings(r).drawings()
    pins = [joint for joint in r.joints if "roller" not in joint]
    assert list(force.numbers) == list(turning.numbers) == pins[:6]
    assert len(polar) == 12


TABLE = "name, C [kN], C0 [kN], d [mm]\n6202, 7.8, 3.55, 15\n6205, 14, 7.8, 25\n6204, 12.7, 6.55, 20\n"


def test_the_smallest_that_is_enough_is_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "m.yaml").write_text(SHAFT.format(load="1898", bearing="{rating: 12 kN}", turn=2 * math.pi))
    (tmp_path / "b.csv").write_text(TABLE)
    arguments = ["bearings", str(tmp_path / "m.yaml"), "--hours", "5000", "--table", str(tmp_path / "b.csv")]
    outputs = [
        x for kind in ("json", "csv", "xlsx", "report") for x in (f"--{kind}", str(tmp_path / f"o.{kind}"))
    ]
    outputs[-1] = str(tmp_path / "o.txt")
    assert main([*arguments, *outputs]) == 0
    said = capsys.readouterr().out
    assert "6204" in said
    assert "6202" not in said
    read = json.loads((tmp_path / "o.json").read_text())["bearings"]["O"]
    assert read["chosen"] == "6204"
    assert read["rating_needed"] == pytest.approx(1898 * 90 ** (1 / 3))
    assert "radial_force.O [N]" in (tmp_path / "o.csv").read_text()
    book = openpyxl.load_workbook(tmp_path / "o.xlsx")
    assert book["positions"]["C1"].value == "radial_force.O [N]"
    assert book["positions"]["C2"].value == pytest.approx(1898)
    assert any("6204" in row for row in book["answer"].values)
    assert "L_10 = ((C)/(P))^e 10^6" in (tmp_path / "o.txt").read_text()
    assert main([*arguments, "--factor", "2"]) == 0
    assert "none is enough" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("rate", "swings", "mean"),
    [
        ([0.0, 2.0, 4.0], False, 2.0),
        ([0.0, -2.0, -4.0], False, 2.0),
        ([0.0, 0.0, 0.0], False, 0.0),
        ([0.5, 1.0, 1.0], False, 0.875),
        ([-1e-9, 0.0, 4.0], True, 1.0),
        ([-4.0, 2.0, 0.0], True, 2.0),
    ],
)
def test_a_bearing_swings_if_it_turns_one_way_and_the_other(
    rate: list[float], swings: bool, mean: float
) -> None:
    """A place at which it stands still is no turning back; each position counts for its time."""
    still, time = np.zeros(3), np.array([1.0, 2.0, 1.0])
    unknown: Any = None
    b = BearingLoad(unknown, "A", None, np.ones(3), still, still, np.array(rate), time)
    assert b.swings is swings
    assert b.speed == pytest.approx(mean, abs=1e-8)
    assert np.isnan(b.equivalent) if mean == 0 else b.equivalent == pytest.approx(1.0)


@pytest.mark.parametrize("speed", [30, -30])
def test_two_links_that_turn_alike_have_no_life_to_count(speed: float) -> None:
    """The pins of a triangle of links turn about nothing: rounding is no rate, and gives no life of 10^20 hours."""
    m = da.loads(
        """
links:
  ground: {points: {O: [0, 0]}}
  a: {points: {O: [0, 0], A: [0.3, 0], B: [0.1, 0.2]}, mass: 1}
  b: {points: {A: [0, 0], C: [0.3, 0]}, mass: 2}
  c: {points: {B: [0, 0], C: [0.4, 0]}, mass: 1}
joints:
  O: {type: pin, links: [ground, a]}
  A: {type: pin, links: [a, b], bearing: {rating: 9 kN}}
  B: {type: pin, links: [a, c]}
  C: {type: pin, links: [b, c]}
drives: {O: {position: {from: 0, to: 360, count: 12}, speed: 30 rad/s}}
assembly: {b: 60, c: 20}
"""
    )
    r = da.dynamics(m.with_values({"drives.O.speed": speed}))
    t = da.bearings(r)
    assert (t.loads["A"].rate == 0).all()
    assert life_expression(r, "A") == ""
    assert t.loads["A"].hours == math.inf
    assert not t.loads["A"].swings
    assert t.loads["O"].speed == pytest.approx(30)
    row = next(line for line in str(t).splitlines() if line.startswith("A "))
    assert row.split()[-1] == "-"


def test_a_bearing_in_space_is_chosen_by_both_forces(tmp_path: Path) -> None:
    """C = P (hours 3600 w / 2 pi / 10^6)^(1/3), C0 over the largest X F_r + Y F_a, and no bore below the pin's."""
    values = {
        "gravity": [0.0, -9.8, -3.0],
        "joints.O.bearing": {
            "kind": "ball",
            "axial_factor": 1.5,
            "diameter": 0.018,
            "radial_factor": 0.56,
            "length": 0.02,
        },
    }
    r = da.dynamics(da.rssr().with_values(values), positions=36)
    b = da.bearing(r, "O")
    force, axis = r.reaction("O"), np.array(r.mechanism.joints["O"].axis, float)
    axis /= np.linalg.norm(axis)
    along = force @ axis
    across = np.linalg.norm(force - along[:, None] * axis, axis=1)
    load = np.maximum(across, 0.56 * across + 1.5 * np.abs(along))
    assert b.load == pytest.approx(load, rel=1e-9)
    spin = np.abs(r.speed("crank") @ axis)
    mean = ((load**3 * spin).sum() / spin.sum()) ** (1 / 3)
    needed = mean * (500 * 3600 * spin.mean() / (2 * math.pi) / 1e6) ** (1 / 3)
    assert b.rating_for(500) == pytest.approx(needed, rel=1e-9)
    rows = [
        ("tight", needed * 2, 2 * load.max(), 0.017),
        ("weak", needed * 0.999, 2 * load.max(), 0.018),
        ("flat", needed * 2, load.max() * 0.999, 0.018),
        ("fits", needed * 1.001, load.max() * 1.001, 0.020),
        ("large", needed * 9, 9 * load.max(), 0.030),
    ]
    table = tmp_path / "b.csv"
    table.write_text(
        "name, C [N], C0 [N], d [m]\n"
        + "".join(
            f"{n}, {c!r}, {c0!r}, {d}\n"
            for n, c, c0, d in [(n, float(c), float(c0), d) for n, c, c0, d in rows]
        )
    )
    for safety, name in ((1.0, "fits"), (1.002, "large")):
        found = da.bearings(r, ["O"], hours=500, table=table, safety=safety).chosen["O"]
        assert found is not None
        assert found.name == name


@pytest.mark.parametrize(
    ("bearing", "said"),
    [
        (
            "{kind: ball}",
            "the bearing has no rating; give rating: 12 kN, or diameter: 20 mm and length: 15 mm",
        ),
        ("{diameter: 20 mm}", "the bearing has no length; give"),
        ("{rating: -3 kN}", "positive"),
    ],
)
def test_a_bearing_without_rating_or_size_has_its_line(bearing: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    file.write_text(SHAFT.format(load="1", bearing=bearing, turn=1))
    with pytest.raises(ModelError, match=r"m\.yaml:7: ") as error:
        da.load(file)
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("7.8, 3.55", "-7.8, 3.55", r"b\.csv:2: C is not positive; give a positive number"),
        ("7.8, 3.55", "0, 3.55", r"b\.csv:2: C is not positive; give a positive number"),
        ("6.55, 20", "6.55, 0", r"b\.csv:4: d is not positive; give a positive number"),
        ("3.55, 15", "3.55", r"b\.csv:2: 3 columns where the first row has 4"),
        ("14,", "much,", r"b\.csv:3: 'much' in column 'C' is not a finite number"),
        ("d [mm]", "D [mm]", r"b\.csv:1: the column 'd' is not in its head"),
        ("C [kN]", "C [mm]", r"b\.csv:1: "),
    ],
)
def test_a_bad_row_of_a_table_has_its_line(old: str, new: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "b.csv").write_text(TABLE.replace(old, new))
    with pytest.raises(ModelError, match=said):
        da.bearings(shaft("1898"), hours=5000, table=tmp_path / "b.csv")


def test_without_speeds_there_are_loads_and_pressures_but_no_lives() -> None:
    sized = "{diameter: 20 mm, length: 10 mm, rating: 12 kN}"
    moving = da.bearing(shaft("1898", sized), "O")
    table = da.bearings(
        da.statics(shaft("1898", sized).mechanism.with_values({"drives.O.speed": 0.0})), hours=100
    )
    still = table.loads["O"]
    np.testing.assert_allclose(still.pressure, still.radial / (0.02 * 0.01), rtol=1e-12)
    assert np.isfinite(moving.hours)
    assert np.isnan([still.hours, still.equivalent, still.mean_pv, still.rating_for(100)]).all()
    assert "so PV, equivalent loads and lives are not computed" in " ".join(table.text().split())


def test_what_has_no_life_is_refused() -> None:
    r = shaft("1898", "{diameter: 20 mm, length: 10 mm}")
    with pytest.raises(ModelError, match="the bearing of 'O' has no rating; give rating: 12 kN"):
        _ = da.bearing(r, "O").turns
    with pytest.raises(ModelError, match="a bearing is chosen from a table by its required life"):
        da.bearings(r, table="none.csv")
    engine = da.dynamics(da.in_line_engine(cylinders=1))
    with pytest.raises(ModelError, match="joint 'cylinder_1' does not turn about one axis"):
        da.bearing(engine, "cylinder_1")
