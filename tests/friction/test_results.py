"""What a result with friction answers: ends at rest, losses, efficiency, other solutions, tables, JSON."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from tests.friction.engines import engine, engine_by_hand, pushed_slider
from tests.friction.test_laws import CYCLES, cycle, solved
from tests.tiers import tiers

CASES = Path(__file__).parents[2] / "cases"
DRIVEN, DRIVING = engine_by_hand(1), engine_by_hand(-1)
"""The gas drives the crank, and the crank the gas."""
BARE = DRIVEN.iteration[0]
"""Effort without friction."""


@pytest.mark.parametrize("template", tiers(CYCLES.split()[::2], CYCLES.split()[1::2]))
def test_the_ends_at_rest_are_the_two_slow_motions(template: str) -> None:
    m = cycle(template)
    drive = next(iter(m.drives))
    slow = [da.statics(m.with_values({f"drives.{drive}.speed": v})) for v in (-1.0, 1.0)]
    rest = da.statics(m.with_values({f"drives.{drive}.speed": 0.0, f"drives.{drive}.acceleration": 0.0}))
    held = np.array([s == "at_rest" for s in rest.status])
    assert set(rest.status) <= {"at_rest", "ok"}  # ok where nothing is loaded, on an idle stroke
    scale = np.max(np.abs(rest.interval(drive)))
    for k, r in enumerate(slow):
        good = solved(r)
        assert np.allclose(rest.interval(drive)[good, k], r.effort(drive)[good], rtol=1e-9, atol=1e-9 * scale)
    bare = da.statics(m.with_values({"friction.enabled": False})).effort(drive)
    low, high = rest.interval(drive).T
    assert held.sum() > 20
    assert np.all((low < bare)[held] & (bare < high)[held])


def test_a_machine_that_moves_beside_a_joint_that_does_not_is_not_said_to_be_at_rest() -> None:
    m = pushed_slider(0.1)
    tree = m.to_tree()
    tree["links"]["ground"]["points"] |= {"P": [0.5, 0.5], "Q": [0.8, 0.5]}
    tree["links"]["bar"] = {"points": {"P": [0, 0], "Q": [0.3, 0]}}
    tree["loads"]["on bar"] = {"type": "couple", "on": "bar", "value": 3.0}
    tree["joints"] |= {
        "P": {"type": "pin", "links": ["ground", "bar"], "friction": {"coefficient": 0.1, "radius": 0.01}},
        "Q": {"type": "slot", "links": ["ground", "bar"], "direction": 0.0},
    }
    del tree["joints"]["guide"]["friction"]
    r = da.statics(da.mechanism(tree))
    assert r.status == ("at_rest",)
    assert str(r.reasons[0]).startswith("No relative motion in P at ")


def test_an_end_that_no_effort_reaches_is_null() -> None:
    r = da.statics(pushed_slider(1.2, speed=0.0))
    assert r.status == ("at_rest",)
    low, high = r.interval("rod")[0]
    assert low == pytest.approx(100 / (np.cos(np.pi / 4) + 1.2 * np.sin(np.pi / 4)), rel=1e-12)
    assert np.isnan(high)


def test_efficiency_of_the_engine() -> None:
    r = da.statics(engine())
    e = da.efficiency(r)
    assert e.reverse[0] == pytest.approx(DRIVEN.effort / BARE, rel=1e-9)
    assert e.forward[0] == pytest.approx(BARE / DRIVING.effort, rel=1e-9)
    assert e.cycle == pytest.approx(DRIVEN.effort / BARE, rel=1e-9)
    assert sum(e.share.values()) == pytest.approx(1 - e.cycle, rel=1e-9)
    assert sum(float(r.power_lost(j)[0]) for j in r.joints) == pytest.approx(e.lost, rel=1e-12)


def test_efficiency_with_damping() -> None:
    """A damped shaft under a couple M: M / (M + R_f F + c w) ahead; back the damping takes more than M gives."""
    pin = {"type": "pin", "links": ["ground", "shaft"], "friction": {"coefficient": 0.1, "radius": 0.05}}
    loads = {
        "F": {"type": "force", "on": "shaft", "at": "O", "value": [100, 0]},
        "M": {"type": "couple", "on": "shaft", "value": -3},
    }
    points = {"points": {"O": [0, 0]}}
    for damping, speed in ((0.0, 3.0), (5.0, 3.0), (5.0, -3.0), (0.5, 3.0)):
        tree = {
            "links": {"ground": points, "shaft": points},
            "joints": {"O": pin | {"damping": damping}},
            "drives": {"O": {"position": 0, "speed": f"{speed} rad/s"}},
            "loads": loads,
        }
        r = da.statics(da.mechanism(tree))
        taken = 100 * 0.05 * np.sin(np.arctan(0.1)) + damping * 3
        found = da.efficiency(r)
        assert found.forward[0] == pytest.approx(3 / (3 + taken), rel=1e-12)
        assert found.reverse[0] == pytest.approx((3 - taken) / 3, rel=1e-12)
        assert ("damping takes more" in str(r)) == (taken > 3), str(r)
        assert "self-locking" not in str(r)


def test_efficiency_of_a_screw_thread_on_its_incline() -> None:
    """A block on an incline of lead angle l: tan l / tan(l + phi) up, tan(l - phi) / tan l back."""
    for mu, lead in ((0.1, 20.0), (0.3, 7.0)):
        m = pushed_slider(mu, angle=0.0).with_values({"joints.guide.direction": np.radians(lead)})
        m = m.with_values({"loads.Q.value": (0.0, -100.0)})
        e = da.efficiency(da.statics(m))
        phi, tilt = np.arctan(mu), np.radians(lead)
        assert e.forward[0] == pytest.approx(np.tan(tilt) / np.tan(tilt + phi), rel=1e-9)
        assert e.reverse[0] == pytest.approx(np.tan(tilt - phi) / np.tan(tilt), rel=1e-9)


def test_other_solutions_beyond_the_fold() -> None:
    assert da.other_solutions(da.statics(pushed_slider(0.5))) == []
    (other,) = da.other_solutions(da.statics(pushed_slider(1.2, speed=-1.0)))
    assert other.unknowns["rod"] == pytest.approx(100 / (np.cos(np.pi / 4) * (1 - 1.2)), rel=1e-9)
    assert other.determinant == pytest.approx(-0.2, rel=1e-9)


def test_the_taught_table() -> None:
    table = da.fixed_point(da.statics(engine()))
    assert table.unknowns["O"] == pytest.approx(DRIVEN.iteration[: len(table.rows())], rel=1e-9)
    assert table.unknowns["O"][-1] == pytest.approx(DRIVEN.effort, rel=1e-9)
    assert table.arrived
    assert table.steps == len(table.rows()) - 1
    slow = da.fixed_point(da.statics(pushed_slider(0.9)))
    assert slow.arrived
    assert slow.rate == pytest.approx(0.9, rel=1e-4)
    assert not da.fixed_point(da.statics(pushed_slider(1.2, speed=-1.0))).arrived


def test_the_tangents_not_taken() -> None:
    """Four common tangents of the circles at A and B: each touches both; the one taken is that of the forces."""
    r = da.statics(engine())
    a = da.friction_circles(r, "A")
    b = da.friction_circles(r, "B")
    lines = [a.taken, *a.others]
    angles = set()
    for line in lines:
        for circle in (a, b):
            arm = circle.center[0] - line.point[0]
            distance = abs(arm[0] * line.direction[0, 1] - arm[1] * line.direction[0, 0])
            assert distance == pytest.approx(circle.radius, rel=1e-9)
        angles.add(round(float(np.arctan2(*line.direction[0, ::-1])), 6))
    assert len(angles) == 4
    assert a.reasons[0].startswith("rod turns clockwise against crank")


def test_json_with_friction(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(CASES / "seed-002-7a-engine-friction-circles.yaml"), "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["friction"] is True
    assert answer["assumptions"]["friction"] == "on, friction circles of mu R"
    (position,) = answer["positions"]
    guide, a = position["reaction"]["guide"], position["reaction"]["A"]
    assert position["friction_force"]["guide"][0] == pytest.approx(guide[0])
    assert position["contact"]["guide"]["lower"] == pytest.approx(guide[1])
    assert position["reaction_moment"]["A"] == pytest.approx(0.024 * np.hypot(*a))
    assert position["friction"]["only_solution"] is True
    assert position["friction"]["determinant_ratio"] == pytest.approx(DRIVEN.determinant, rel=1e-9)
    assert position["friction"]["critical_scale"] is None


def test_json_at_rest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(CASES / "seed-002-7d-engine-at-rest.yaml"), "--json", "-"]) == 1
    (position,) = json.loads(capsys.readouterr().out)["positions"]
    assert position["status"] == "at_rest"
    assert position["effort"]["O"] == pytest.approx([DRIVING.effort, DRIVEN.effort], rel=1e-9)
    assert position["reaction"]["A"] == [None, None]
    low = position["ends"]["O"]["low"]
    assert low["at_limit"] == ["O", "A", "B", "guide"]
    assert np.hypot(*low["reaction"]["A"]) == pytest.approx(DRIVING.rod, rel=1e-9)


def test_no_friction_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    path = str(CASES / "seed-002-7a-engine-friction-circles.yaml")
    assert main(["solve", path, "--json", "-", "--no-friction"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["friction"] is False
    assert answer["assumptions"]["friction"] == "off (switched off)"
    assert answer["positions"][0]["effort"]["O"] == pytest.approx(BARE, rel=1e-9)
    assert answer["positions"][0]["reaction_moment"]["A"] == 0


def test_printed(capsys: pytest.CaptureFixture[str]) -> None:
    main(["solve", str(CASES / "seed-002-7d-engine-at-rest.yaml")])
    out = capsys.readouterr().out
    assert "-7304.02 to -4521.85 N*m" in out
    assert "At the low end of O:" in out
    main(["solve", str(CASES / "seed-002-7g-engine-guide-100-mm.yaml")])
    out = capsys.readouterr().out
    assert "mu 0.07, lower ahead, upper behind" in out
    assert "mu 0.4, friction circle 0.028 m" in out


def test_the_taught_table_printed(capsys: pytest.CaptureFixture[str]) -> None:
    main(["solve", str(CASES / "seed-002-7a-engine-friction-circles.yaml"), "--method", "fixed-point"])
    out = capsys.readouterr().out
    smooth, table = "-5873.1362", out.partition("step")[2].splitlines()
    assert table[3].split() == ["0", smooth, *"0000", "-"]  # without friction, and no change yet
    assert "1     -4486.6005" in out
    assert "The textbook iteration converges after 11 steps; each step leaves 0.0588 of the" in out


def test_arrays_with_friction() -> None:
    r = da.statics(engine())
    data = r.to_xarray()
    assert float(data.power_lost.sum()) == pytest.approx(DRIVEN.effort - BARE, rel=1e-9)  # at 1 rad/s
    assert data.friction_force.attrs["units"] == "N"
    assert data.component.values.tolist() == ["x", "y"]
    assert "link_axis" not in data.coords
    assert any(name.startswith("friction_force.A") for name in r.to_dataframe().columns)
    rest = da.statics(engine(speed=0.0)).to_xarray()
    assert float(rest.effort_low[0, 0]) == pytest.approx(DRIVING.effort, rel=1e-9)


def test_gears_with_friction() -> None:
    """Two wheels on fixed centres: the input torque grows by the couple of both wheels' teeth."""
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0], "P": [0.15, 0]}},
                "pinion": {"points": {"O": [0, 0]}},
                "wheel": {"points": {"P": [0, 0]}},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "pinion"]},
                "P": {"type": "pin", "links": ["ground", "wheel"]},
                "mesh": {
                    "type": "gear",
                    "links": ["pinion", "wheel"],
                    "at": ["O", "P"],
                    "radii": [0.05, 0.1],
                    "friction": {"coefficient": 0.1, "arm": 0.004},
                },
            },
            "drives": {"O": {"position": 0, "speed": "10 rad/s"}},
            "loads": {"load": {"type": "couple", "on": "wheel", "value": 60}},
        }
    )
    r = da.statics(m)
    # wheel turns at -5 rad/s; relative turn -15 rad/s; couple +m on the wheel, -m on the pinion
    arm = 0.1 * 0.004 / np.cos(np.radians(20))
    tangential = 60 / (0.1 - arm)
    assert r.effort("O")[0] == pytest.approx(tangential * (0.05 + arm), rel=1e-9)
    assert r.power_lost("mesh")[0] == pytest.approx(tangential * arm * 15, rel=1e-9)


def test_the_arm_of_full_depth_teeth() -> None:
    from dalembert.analysis.compile.contacts import contact_arm

    gear = da.Gear(links=("a", "b"), teeth=(20, 40), module=0.005, friction={"coefficient": 0.1})
    ra, rb, m, alpha = 0.05, 0.1, 0.005, np.radians(20)
    parts = [np.sqrt((r + m) ** 2 - (r * np.cos(alpha)) ** 2) - r * np.sin(alpha) for r in (ra, rb)]
    assert contact_arm(gear) == pytest.approx((parts[0] ** 2 + parts[1] ** 2) / 2 / sum(parts), rel=1e-12)


def test_each_effort_has_an_interval_of_its_own() -> None:
    """Five-bar robot: at an end of one effort the other one has one of its own interval, and all is balanced."""
    m = da.load(examples()["two_drives"])
    rub = {f"joints.{n}.friction": {"coefficient": 0.2, "radius": 0.01} for n in m.joints}
    r = da.statics(m.with_values(rub))
    assert set(r.status) == {"at_rest"}
    for n, name in enumerate(("O2", "O5")):
        low, high = r.interval(name).T
        for end, value in zip(r.ends[n], (low, high), strict=True):
            assert end.effort(name) == pytest.approx(value)
            assert np.max(end.residual) < 1e-9
            other = "O5" if name == "O2" else "O2"
            least, most = r.interval(other).T
            room = 1e-9 * np.abs(most)
            assert np.all((least - room <= end.effort(other)) & (end.effort(other) <= most + room))
    assert r.reasons[0] == (
        "At rest between 120 deg and 95 deg of O2, 60 deg and 50 deg of O5: O2 and O5 each lie in an interval. At the "
        "ends of each, the machine is about to move with the other drives held, and the other unknowns have the values "
        "shown for that end; not every combination of values within the intervals holds the machine. For O2, at both "
        "ends friction is at its limit in O2, A, C, B. For O5, at both ends friction is at its limit in A, C, B, O5."
    )


def test_a_structure_with_friction_says_what_can_be_asked() -> None:
    m = da.load(examples()["truss"])
    r = da.statics(m.with_values({"joints.A.friction": {"coefficient": 0.2, "radius": 0.01}}))
    assert r.status == ("at_rest",)
    assert r.reasons[0] == (
        "A structure does not move: it holds any load, and friction may carry any part of it within its limits. "
        "Switch friction off for the reactions without it. To compute what friction holds, replace the joint held by "
        "friction by a drive at rest."
    )
    with pytest.raises(da.ModelError, match="a structure holds any load: leave out the joint"):
        da.statics(m.with_values({"loads.at_B": {"type": "couple", "on": "AB", "value": "unknown"}}))


def test_printed_efficiency_and_virtual_work(capsys: pytest.CaptureFixture[str]) -> None:
    main(["solve", str(CASES / "seed-002-7a-engine-friction-circles.yaml"), "--method", "virtual-work"])
    out = " ".join(capsys.readouterr().out.split())
    assert (
        "Efficiency, without inertia: 80.41 % where the drive moves the load; 76.99 % where the load" in out
    )
    assert "friction in A 0 0 530.68 0 0 -1.1569 -613.96" in out
    assert "with friction virtual work checks that answer; it is not an independent solution." in out
    main(["solve", str(CASES / "seed-002-7d-engine-at-rest.yaml"), "--method", "virtual-work"])
    out = capsys.readouterr().out
    assert "At the low end of O:" in out
    assert "O = -7304.02 N*m" in out


def test_other_solutions_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    """Only where they are asked for, beside the contract's own keys."""
    case = str(CASES / "seed-f-2d-rod-at-45-deg-12.yaml")
    main(["solve", case, "--other-solutions", "--json", "-"])
    jammed, moved = (p["friction"] for p in json.loads(capsys.readouterr().out)["positions"])
    assert jammed["other_solutions"] == []
    (other,) = moved["other_solutions"]
    assert other["load"]["rod"] == pytest.approx(100 / (np.cos(np.pi / 4) * (1 - 1.2)), rel=1e-9)
    assert other["determinant_ratio"] == pytest.approx(-0.2, rel=1e-9)
    main(["solve", case, "--json", "-"])
    assert "other_solutions" not in capsys.readouterr().out
    main(["solve", case, "--other-solutions"])
    assert "\n2                -707.107         -0.2\n" in capsys.readouterr().out
    for name, said in (
        ("seed-002-7a-engine-friction-circles", "Other solutions of friction: proved not to exist"),
        ("seed-002-7d-engine-at-rest", "at no position of this result"),
    ):
        main(["solve", str(CASES / f"{name}.yaml"), "--other-solutions"])
        assert said in capsys.readouterr().out.replace("\n", " ")
    assert main(["solve", str(CASES / "seed-001-a-four-bar-rocker-force.yaml"), "--other-solutions"]) == 2


def test_what_idle_links_lose_is_printed_as_nothing() -> None:
    """Two massless links that bear no load turn with the rod: their pins lose 0 J, where rounding is 1e-50 J."""
    pin = {"type": "pin", "friction": {"radius": "1 cm", "coefficient": 0.2}}
    links = {
        "ground": {"O": [0, 0], "R": [0.9, 0.3]},
        "crank": {"O": [0, 0], "A": [0.1, 0]},
        "rod": {"A": [0, 0], "B": [0.4, 0], "C": [0.2, 0.05]},
        "block": {"B": [0, 0]},
        "idle": {"C": [0, 0], "D": [0.5, 0]},
        "last": {"D": [0, 0], "R": [0.7, 0]},
    }
    pairs = {"O": "ground crank", "A": "crank rod", "B": "rod block", "C": "rod idle", "D": "idle last"}
    joints = {name: pin | {"links": pair.split()} for name, pair in (pairs | {"R": "last ground"}).items()}
    guide = {"S": {"type": "slider", "links": ["ground", "block"], "at": ["O", "B"], "direction": 0}}
    tree = {
        "units": {"length": "m"},
        "links": {name: {"points": points} for name, points in links.items()},
        "joints": joints | guide,
        "drives": {"O": {"position": {"from": 0, "to": 330, "count": 12}, "speed": "10 rad/s"}},
        "loads": {"P": {"type": "force", "on": "block", "at": "B", "value": [-100, 0]}},
    }
    r = da.dynamics(da.mechanism(tree))
    assert np.abs(np.array([r.power_lost(j) for j in "CDR"])).max() < 1e-40 < r.power_lost("A").max()
    table = r.text().partition("friction over")[2].splitlines()[3:9]
    assert [line.split()[:3] for line in table[3:]] == [[j, "0", "0"] for j in "CDR"]
    assert [float(line.split()[1]) > 0.1 for line in table[:3]] == [True] * 3


@pytest.mark.parametrize(("couple", "speed"), [(0.2, 2.0), (-0.2, -2.0)])
def test_a_drive_and_a_load_that_both_put_work_in(couple: float, speed: float) -> None:
    """Against more friction than the load overcomes: nothing arrives, and the pin takes all that is put in."""
    tree = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "shaft": {"points": {"O": [0, 0]}}},
        "joints": {
            "O": {
                "type": "pin",
                "links": ["ground", "shaft"],
                "friction": {"coefficient": 0.1, "radius": 0.05, "circle": "tan"},
            }
        },
        "drives": {"O": {"position": [0, 1], "speed": f"{speed} rad/s"}},
        "loads": {
            "F": {"type": "force", "on": "shaft", "at": "O", "value": [100, 0]},
            "M": {"type": "couple", "on": "shaft", "value": couple},
        },
    }
    r = da.statics(da.mechanism(tree))
    assert r.effort("O") == pytest.approx([np.copysign(0.5 - 0.2, speed)] * 2)
    e = da.efficiency(r)
    assert (e.cycle, e.share) == (pytest.approx(0, abs=1e-15), {"O": pytest.approx(1)})
    assert e.put_in == pytest.approx(e.lost)
    assert "O      1.000           100.0 %" in str(da.report(r))


def test_a_pin_without_a_force_has_no_couple_to_speak_of() -> None:
    """Of two shafts that turn one is loaded: only its pin has a sense of friction in the report."""
    pin = {"type": "pin", "friction": {"coefficient": 0.1, "radius": 0.05, "circle": "tan"}}
    tree = {
        "links": {
            "ground": {"points": {"O": [0, 0], "Q": [1, 0]}},
            "a": {"points": {"O": [0, 0]}},
            "b": {"points": {"Q": [0, 0]}},
        },
        "joints": {"O": pin | {"links": ["ground", "a"]}, "Q": pin | {"links": ["b", "ground"]}},
        "drives": {
            "O": {"position": 0, "speed": "2 rad/s"},
            "Q": {"position": 0, "speed": "3 rad/s"},
        },
        "loads": {"F": {"type": "force", "on": "a", "at": "O", "value": [100, 0]}},
    }
    text = " ".join(str(da.report(da.statics(da.mechanism(tree)))).split())
    said = (
        "O: link 2 a turns counter-clockwise on 1 ground, so friction's couple on it is clockwise, and its force "
        "touches the circle on the side that makes this couple."
    )
    assert said in text
    assert "M_f12 = −r_O F_12 = −0.005000 · 100.0 = −0.5000 N·m, clockwise about O" in text
    assert "M_f13 = r_Q F_13 = 0.005000 · 0 = 0 N·m " in text
    assert text.count("so friction's couple on it is") == 1
    tree["loads"]["F"] |= {"on": "b", "at": "Q"}  # type: ignore[index]
    text = " ".join(str(da.report(da.statics(da.mechanism(tree)))).split())
    back = said.replace("O: link 2 a turns counter-clockwise", "Q: link 3 b turns clockwise")
    assert back.replace("it is clockwise", "it is counter-clockwise") in text
    assert text.count("so friction's couple on it is") == 1
