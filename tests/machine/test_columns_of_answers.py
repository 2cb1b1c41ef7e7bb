"""Columns, records and tables of answers of machine design against closed forms, and sizes computed back."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.answer.column import Scale
from dalembert.arrays import first_largest
from dalembert.machine.elements.pin_stresses import moment_along
from dalembert.machine.members.member_table import member_table
from dalembert.printing import number
from tests.elements.test_pins import FORK, hung
from tests.machine.test_members import ARM

SI = Scale(None)


@pytest.mark.parametrize("speed", [50.0, -50.0])
def test_sizes_of_a_flywheel_have_its_inertia(speed: float) -> None:
    """I = pi rho t R^4/2 of a disc, rho 2 pi R b h (R^2 + h^2/4) of a rim, whichever size is given; m k^2."""
    f = da.flywheel_size([200.0, -260.0, 150.0, -90.0], speed=speed, Cs=0.05)
    assert f.energy == pytest.approx(260.0)
    assert f.inertia == pytest.approx(260 / (0.05 * 2500), rel=1e-12)
    assert f.limits == pytest.approx((48.75, 51.25), rel=1e-12)
    assert f.mass(0.3) * 0.3**2 == pytest.approx(f.inertia, rel=1e-12)
    for given in ({"radius": 0.2}, {"thickness": 0.03}):
        radius, thickness = f.disc(7850.0, **given)
        assert (radius if "radius" in given else thickness) == next(iter(given.values()))
        assert math.pi * 7850 * thickness * radius**4 / 2 == pytest.approx(f.inertia, rel=1e-12)
    for mean in (0.15, 0.25):
        height = f.rim(7850.0, mean, breadth=0.06)
        assert 7850 * 2 * math.pi * mean * 0.06 * height * (mean**2 + height**2 / 4) == pytest.approx(
            f.inertia, rel=1e-12
        )
        assert f.rim(7850.0, mean, height=height) == pytest.approx(0.06, rel=1e-12)
    assert da.flywheel_size(260.0, speed, inertia=f.inertia).fluctuation == pytest.approx(0.05, rel=1e-12)


def test_the_drawn_moment_of_a_bolt() -> None:
    """In a fork F/2 times the way from the cheek's middle, less an even pressure in the eye; one plane a triangle."""
    fork, single = (da.pin(da.statics(hung({**FORK, "planes": n})), "A") for n in (2, 1))
    eye, cheek, gap = 0.04, 0.022, 0.001
    lead, each = cheek / 2 + gap, float(fork.force[0]) / 2
    s, m = moment_along(fork, 0)
    assert [s[0], s[1], s[-2], s[-1]] == pytest.approx([0, lead, lead + eye, 2 * lead + eye])
    u = np.clip(s - lead, 0, eye)
    assert m == pytest.approx(
        np.where((s == 0) | (s == s[-1]), 0, each * lead + each * u - each * u**2 / eye)
    )
    assert m.max() == pytest.approx(each * (lead + eye / 4), rel=1e-12)
    s, m = moment_along(single, 0)
    total = (cheek + eye) / 2 + gap
    assert s == pytest.approx([0, total / 2, total])
    assert m == pytest.approx([0, float(single.force[0]) * total / 2, 0])
    layers = [0, 0.018, 0.04]
    stack = da.pin(
        da.statics(hung({"diameter": "20 mm", "stack": ["left", "hook", "right"], "layers": layers})), "A"
    )
    s, m = moment_along(stack, 0)
    left = stack.result.reaction("A", on="left")[0]
    hook = stack.result.reaction("B", on="hook")[0]
    vectors = np.minimum(s, 0.018)[:, None] * left + np.maximum(s - 0.018, 0)[:, None] * (left + hook)
    assert m == pytest.approx(np.hypot(*vectors.T), rel=1e-12)
    assert (s[0], s[-1], len(s)) == (0, 0.04, 51)


def test_columns_of_a_bar_that_is_swung_round() -> None:
    """N = mu w^2 (L^2 - s^2)/2, V = mu a (L^2 - s^2)/2 and M = mu a (2 L^3 - 3 L^2 s + s^3)/6, held at O."""
    section = "rectangle: [20 mm, 40 mm], yield_stress: 250 MPa"
    t = member_table(da.dynamics(da.loads(ARM.replace(section, f"{section}, elasticity: 200 GPa"))))
    of = {c.name: c for c in t.columns()}
    length, mu, w, a = 0.6, 2 / 0.6, 100.0, 500.0
    names = [
        f"{n}.arm.{end}{place}"
        for n in ("axial", "shear", "bending")
        for end in ("low", "high")
        for place in ("", ".place")
    ]
    assert [*of] == [
        "drive.O", *names, "residual.arm", "stress.arm", "stress.arm.place", "compression.arm",
        "critical_load.arm", "effective_length.arm.in_plane", "effective_length.arm.across", "deflection.arm",
        "deflection.arm.place", "slope.arm.O",
    ]  # fmt: skip
    axial, shear, bend = mu * w**2 * length**2 / 2, mu * a * length**2 / 2, mu * a * length**3 / 3
    values = {n: float(c.values[0]) for n, c in of.items()}
    assert [values["axial.arm.high"], values["axial.arm.high.place"]] == pytest.approx([axial, 0], rel=1e-12)
    assert [values["axial.arm.low"], values["axial.arm.low.place"]] == pytest.approx([0, length], abs=1e-9)
    assert max(abs(values[f"shear.arm.{end}"]) for end in ("low", "high")) == pytest.approx(shear, rel=1e-12)
    assert max(abs(values[f"bending.arm.{end}"]) for end in ("low", "high")) == pytest.approx(bend, rel=1e-12)
    assert values["stress.arm"] == pytest.approx(axial / 8e-4 + bend * 6 / (0.02 * 0.04**2), rel=1e-9)
    assert values["stress.arm.place"] == 0.0
    weak, stiff = (200e9 * x for x in (0.04 * 0.02**3 / 12, 0.02 * 0.04**3 / 12))
    assert values["compression.arm"] == 0.0
    assert values["critical_load.arm"] == pytest.approx(math.pi**2 * weak / (2 * length) ** 2, rel=1e-9)
    assert [values[f"effective_length.arm.{x}"] for x in ("in_plane", "across")] == pytest.approx(
        [2, 2], rel=1e-9
    )
    assert values["deflection.arm"] == pytest.approx(11 * mu * a * length**5 / 120 / stiff, rel=1e-9)
    assert values["deflection.arm.place"] == pytest.approx(length)
    assert values["slope.arm.O"] == 0.0
    kinds = {
        n: of[n].kind
        for n in ("axial.arm.low", "shear.arm.low.place", "bending.arm.high", "stress.arm", "slope.arm.O")
    }
    assert [*kinds.values()] == ["force", "length", "moment", "pressure", "angle"]
    record: Any = t.record(SI)["members"]["arm"]["deflection"]
    assert record["largest"] == pytest.approx(values["deflection.arm"])
    assert (record["member"], record["position"], record["slopes"]) == ("O-A", 1, {"O": 0.0})


def test_errors_by_clearances_are_columns_and_a_table() -> None:
    """Where the forces press the journals; at worst each in its least favourable direction."""
    m = da.slider_crank(crank=0.05, rod=0.2)
    r = da.dynamics(m, positions=12)
    x = da.clearance_error(r, "piston", "B", {"A": 1e-5, "B": 2e-5})
    assert x.by_force == pytest.approx(x.of["A"] + x.of["B"], abs=1e-15)
    assert (np.abs(x.by_force) <= x.worst + 1e-15).all()
    of = {c.name: c for c in x.columns()}
    names = ["play.piston.B.x", "play.piston.B.y", "play.piston.B.worst.x", "play.piston.B.worst.y"]
    assert [*of] == ["drive.O2", *names]
    for k, name in enumerate(names):
        assert of[name].kind == "length"
        assert of[name].values.tolist() == (x.by_force if k < 2 else x.worst)[:, k % 2].tolist()
    sizes = {n: np.hypot(*v.T) for n, v in x.of.items()}
    record: Any = x.record(SI)["clearance"]
    assert {n: (v["clearance"], v["largest"]) for n, v in record.items()} == {
        n: (c, float(sizes[n].max())) for n, c in (("A", 1e-5), ("B", 2e-5))
    }
    rows = [line.split() for line in x.text().splitlines() if line.split()[:1] in (["A"], ["B"])]
    degrees = np.degrees(r.drive_position("O2"))
    for row, (n, c) in zip(rows, (("A", 1e-5), ("B", 2e-5)), strict=True):
        k = first_largest(sizes[n])
        worst = np.hypot(*x.single[n].T).max()
        assert row == [
            n,
            number(c),
            number(float(sizes[n][k]), 4),
            number(float(degrees[k])),
            "deg",
            number(float(worst), 4),
        ]


def test_records_of_designs_name_what_was_before_and_after() -> None:
    """A rocker of least effort, and a crank that brings the rocker to an angle."""
    path = "links.rocker.points.B.0"
    best = da.optimize(
        da.four_bar(positions=3),
        {path: (0.2, 0.28)},
        "effort.O2",
        "transmission.B >= 10 deg",
        starts=1,
        seed=1,
    )
    out: Any = best.record(SI)["optimum"]
    peaks = [float(np.abs(r.effort("O2")).max()) for r in (best.before, best.after)]
    margins = [float((r["transmission.B"] - math.radians(10)).min()) for r in (best.before, best.after)]
    assert out["numbers"] == {path: {"before": 0.24, "after": float(best.values[0]), "from": 0.2, "to": 0.28}}
    assert out["aim"] == {
        "of": "peak effort.O2",
        "before": pytest.approx(peaks[0]),
        "after": pytest.approx(peaks[1]),
    }
    assert out["margin"] == {
        "transmission.B >= 10 deg": {"before": pytest.approx(margins[0]), "after": pytest.approx(margins[1])}
    }
    assert (out["feasible"], out["started"], out["polished"]) == (True, best.started, best.polished)
    wanted = da.kinematics(da.four_bar(), positions=4).angle("rocker")
    turned = da.kinematics(da.four_bar(), positions=4).drive_position("O2")
    crank = "links.crank.points.A.0"
    found = da.synthesize(da.four_bar(), {crank: (0.06, 0.12)}, {"angle.rocker": wanted}, turned, starts=2)
    made: Any = found.record(SI)["synthesis"]
    own = float(da.four_bar().links["crank"].points["A"][0])  # type: ignore[index]
    assert made == {
        "numbers": {crank: {"before": own, "after": pytest.approx(own, rel=1e-9)}},
        "error": pytest.approx(0, abs=1e-12),
        "exact": found.exact,
        "started": 3,
    }
    of = {c.name: c for c in found.columns()}
    assert [*of] == ["drive.O2", "angle.rocker"]
    assert of["angle.rocker"].values == pytest.approx(wanted, abs=1e-12)
    assert of["drive.O2"].values == pytest.approx(turned, abs=1e-12)
    assert found.text().endswith(
        f"Rms error {number(found.error, 3)} of the targets' spread; of 3 starts {found.exact} are exact."
    )


def test_small_swings_about_stable_places_of_turns_and_slides() -> None:
    """A bob on a torsion spring, w^2 = (k + m g c sin(q - 90 deg)...)/J by its potential; a mass on a spring, k/m."""
    bob = """
gravity: standard
links: {ground: {points: {O: [0, 0]}}, bob: {points: {O: [0, 0]}, mass: 2, center: [0.5, 0], inertia: 0.1}}
joints: {O: {type: pin, links: [ground, bob]}}
loads: {S: {type: torsion_spring, joint: O, stiffness: 3 N*m/rad, free_angle: -60}}
drives: {O: {position: unknown, effort: 0, range: [-179, -1]}}
"""
    r = da.statics(da.loads(bob))
    q = r.drive_position("O")
    weight = 2 * 9.80665 * 0.5
    assert 3 * (q + math.pi / 3) + weight * np.cos(q) == pytest.approx(0, abs=1e-9)
    slope = 3 - weight * np.sin(q)
    assert [word == "stable" for word in r.stability or ()] == (slope > 0).tolist()
    assert da.small_swings(r) == pytest.approx(np.sqrt(slope[slope > 0] / (0.1 + 2 * 0.25)), rel=1e-8)
    mass = """
gravity: [0, -10]
links: {ground: {points: {O: [0, 0]}}, ram: {points: {O: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, ram], at: O, direction: 90}}
loads: {K: {type: spring, between: [ground.O, ram.O], stiffness: 500 N/m, free_length: 0.3 m}}
drives: {S: {position: unknown, effort: 0, range: [0.05 m, 1 m]}}
"""
    r = da.statics(da.loads(mass))
    assert r.drive_position("S") == pytest.approx([0.3 - 20 / 500], abs=1e-9)
    assert da.small_swings(r) == pytest.approx([math.sqrt(250)], rel=1e-8)


TABLE = """name,C [kN],C0 [kN],d [mm]
light,20,9,15
medium,45,25,20
stiff,45.5,26,22
heavy,60,40,30
"""


def test_a_bearing_is_chosen_by_its_life_and_its_static_load(tmp_path: Any) -> None:
    """C = f P (60 n h/1e6)^(1/3); the smallest row that has it, and C0 of so many times the largest load."""
    (tmp_path / "table.csv").write_text(TABLE)
    r = da.dynamics(da.slider_crank(), positions=24)
    load = da.bearing(r, "A")
    rpm = load.speed * 30 / math.pi
    needed = load.equivalent * (60 * rpm * 2000 / 1e6) ** (1 / 3)
    assert 37e3 < needed < 38e3
    row = {"none": ["none", "is", "enough"], "medium": ["medium", "45000", "25000", "0.02"]}
    row |= {"stiff": ["stiff", "45500", "26000", "0.022"], "heavy": ["heavy", "60000", "40000", "0.03"]}
    largest = float(np.abs(load.load).max())
    for factor, safety, name in (
        (1.0, 1.0, "medium"), (1.2, 1.0, "medium"), (1.215, 1.0, "stiff"), (1.0, 25.5e3 / largest, "stiff"),
        (1.3, 1.0, "heavy"), (1.0, 39e3 / largest, "heavy"), (2.0, 1.0, "none"), (1.0, 41e3 / largest, "none"),
    ):  # fmt: skip
        t = da.bearings(r, ["A"], hours=2000, table=tmp_path / "table.csv", factor=factor, safety=safety)
        chosen = t.chosen["A"]
        assert (chosen.name if chosen else "none") == name
        said = next(part for part in t.text().split("\n\n") if "C needed" in part).splitlines()
        assert said[3].split() == ["A", number(factor * needed), *row[name]]
        assert (
            said[-1] == f"For 2000 hours{'' if factor == 1 else f', with {number(factor)} times the load'}."
        )
    bare = da.bearings(r, ["A"], hours=2000).text()
    assert ["A", number(needed), "no", "table", "given"] in [line.split() for line in bare.splitlines()]


def test_conditions_of_forces_velocities_and_energies_are_met_where_they_are() -> None:
    """A ball of 1 kg that falls: v = g t, E = v^2/2; a ladder by the laws of its analysis at those instants."""
    from tests.elements.test_landing import BALL, LADDER, G

    names = ["time = 0.2 s", "point.ball.B.velocity.y = -2 m/s", "energy.kinetic = 5 J"]
    s = da.simulate(da.loads(BALL % 0.0), "0.5 s", events=names, count=3)
    assert [e.sentence for e in s.event("condition")] == names
    assert [e.time for e in s.event("condition")] == pytest.approx([0.2, 2 / G, math.sqrt(10) / G], rel=1e-9)
    names = ["reaction.floor.y = 150 N", "normal.wall = 40 N"]
    s = da.simulate(da.loads(LADDER % (4 * math.cos(math.radians(70)))), "0.8 s", events=names, count=3)
    met = {e.sentence: int(np.flatnonzero(s.time == e.time)[0]) for e in s.event("condition")}
    assert {*met} == {*names}
    assert s.result.reaction("floor")[met[names[0]], 1] == pytest.approx(150, rel=1e-9)
    assert s.normals["wall"][met[names[1]]] == pytest.approx(40, rel=1e-9)
    assert np.hypot(*s.result.reaction("wall")[met[names[1]]]) == pytest.approx(40, rel=1e-9)


def test_a_shaft_and_a_flywheel_are_columns_and_records() -> None:
    """In the units of the file, of the shaft of a book; E(q) is the integral of the effort beyond its mean."""
    from tests.machine.test_shafts import SHAFT

    c = da.critical_speeds(da.statics(da.loads(SHAFT)), "shaft", count=2)
    of = {x.name: (x.kind, x.values.tolist()) for x in c.columns()}
    assert of == {
        "critical_speed.shaft": ("angular_speed", c.speeds.tolist()),
        "critical_speed.shaft.whirl": ("angular_speed", c.whirl.tolist()),
    }
    inch = Scale({"length": "in", "mass": "lb", "angle": "rad"})
    pound = 0.45359237
    out: Any = c.record(inch)["shaft"]
    assert (out["link"], out["change"]) == ("shaft", c.change)
    assert [out["dunkerley"], out["rayleigh"]] == pytest.approx([c.dunkerley, c.rayleigh], rel=1e-12)
    assert out["sag"] == pytest.approx(np.abs(c.sag).max() / 0.0254, rel=1e-12)
    assert out["supports"] == {"A": 0.0, "B": pytest.approx(31, rel=1e-12)}
    assert out["masses"] == {"gear_1": pytest.approx(35, rel=1e-9), "gear_2": pytest.approx(55, rel=1e-9)}
    assert [p.mass for p in c.masses.values()] == pytest.approx([35 * pound, 55 * pound], rel=1e-9)

    r = da.dynamics(da.slider_crank(), positions=720)
    f = da.flywheel(r, Cs=0.02)
    columns = {x.name: x for x in f.columns()}
    kinds = {"drive.O2": "angle", "effort.O2": "moment", "energy.flywheel": "energy"}
    assert {n: x.kind for n, x in columns.items()} == {**kinds, "drive.O2.speed": "angular_speed"}
    q, effort = r.drive_position("O2"), r.effort("O2")
    assert columns["drive.O2"].values.tolist() == q.tolist()
    assert columns["effort.O2"].values.tolist() == effort.tolist()
    above = effort - effort.mean()
    energy = np.concatenate([[0], np.cumsum((above[1:] + above[:-1]) / 2 * (q[1] - q[0]))])
    assert columns["energy.flywheel"].values == pytest.approx(energy, abs=2e-3 * np.ptp(energy))  # trapezoids
    speed = columns["drive.O2.speed"].values
    assert f.exact is not None
    assert 2 * np.ptp(speed) / (speed.max() + speed.min()) == pytest.approx(
        f.exact.fluctuation, rel=1e-4
    )  # at 720


LAW = """
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0]}, inertia: 1}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {law: %s}}
"""


def law_columns(law: str) -> tuple[Any, dict[str, Any]]:
    x = da.law(da.loads(LAW % law), "O")
    return x, {c.name: np.asarray(c.values) for c in x.columns()}


def test_columns_of_a_law_end_with_its_last_piece() -> None:
    """A constant acceleration of 8 rad/s^2 for half a second, the same back: the last value is that just before."""
    x, of = law_columns("{segments: [{dwell: 1 s}, {to: 2 rad, in: 1 s, by: parabolic}], count: 5}")
    t, late = of["time"], np.maximum(of["time"] - 1, 0)
    a = np.where(t < 1, 0.0, np.where(t < 1.5, 8.0, -8.0))
    position = np.where(late < 0.5, 4 * late**2, 2 - 4 * (1 - late) ** 2)
    speed = np.where(late < 0.5, 8 * late, 8 * (1 - late))
    for order, known in enumerate((position, speed, a, 0 * t)):
        name = ("drive.O", "drive.O.speed", "drive.O.acceleration", "drive.O.jerk")[order]
        assert of[name] == pytest.approx(known, abs=1e-12)
    assert (x.position == of["drive.O"]).all()
    assert (x.speed == of["drive.O.speed"]).all()
    assert (x.acceleration == of["drive.O.acceleration"]).all()
    assert (x.jerk == of["drive.O.jerk"]).all()
    assert (x.duration, x.peak_speed, x.peak_acceleration, x.peak_jerk) == pytest.approx((2, 4, 8, 0))


def test_a_law_by_a_table_is_a_cubic_through_its_points() -> None:
    """Through four points of one cubic it is that cubic, from the first time on."""
    cubic = np.polynomial.Polynomial([0.2, 0.5, -0.4, 0.1])
    at = np.array([0.0, 1.0, 2.0, 3.0])
    text = ", ".join(f"{y!r} rad" for y in cubic(at).tolist())
    x, of = law_columns(f"{{type: table, time: [1, 2, 3, 4], position: [{text}], count: 7}}")
    assert x.duration == 3
    for k, name in enumerate(("drive.O", "drive.O.speed", "drive.O.acceleration", "drive.O.jerk")):
        assert of[name] == pytest.approx(cubic.deriv(k)(of["time"]) if k else cubic(of["time"]), abs=1e-12)
    assert x.peak_jerk == pytest.approx(0.6)
    assert x.coefficients == {}
