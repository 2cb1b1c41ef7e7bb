"""Cylinders: against closed forms, beam elements, the same machine driven otherwise, and wrong descriptions."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

import dalembert as da
from dalembert.machine.elements.stepped_column import FORMS, critical_load, euler
from tests.tiers import over

BOOM = """units: {length: mm, mass: kg, force: N}
gravity: standard
links:
  ground: {points: {O: [0, 0], A: [200, -400]}}
  boom: {points: {O: [0, 0], B: [900, 150]}, mass: 320, center: [1600, 0]}
joints: {O: {type: pin, links: [ground, boom]}}
drives: {C: {cylinder: {between: [ground.A, boom.B], bore: 80, rod: 45}, position: 1000}}
assembly: {boom: 10}
"""
SIZES = "bore: 80, rod: 45"
WRONG = {
    "bore: 80, rod: 80": "rod of cylinder of drive 'C': the rod is as thick as the bore, "
    "or thicker; the bore is the inner diameter of the barrel",
    "bore: 80, barrel: 70": "barrel of cylinder of drive 'C': the barrel is not thicker "
    "than its bore; barrel is its outer diameter, bore the inner "
    "one",
    "bore: 80, efficiency: 1.2": "efficiency of cylinder of drive 'C': an efficiency of 1.2 "
    "would give power; write one from 0 to 1, such as 0.94",
    "bore: 80, efficiency: 0.9, friction: 20": "friction of cylinder of drive 'C': an efficiency and a "
    "friction are given; leave one of them out",
    "bore: 80, stroke: 300": "cylinder of drive 'C': closed is missing; give closed and "
    "stroke together, or neither",
    "bore: 80, closed: 300, stroke: 300": "stroke of cylinder of drive 'C': its stroke is as long as the "
    "closed cylinder, or longer; closed is the distance of its ends "
    "with the rod in",
    "bore: 80, barrel: 95": "cylinder of drive 'C': the length of its barrel is not known, "
    "and is needed for its column; give closed and stroke, or "
    "barrel_length",
    "bore: 80, ends: [free, pin]": "cylinder of drive 'C': ends: [free, pin] is not a case that is "
    "known; write one of [pin, pin], [fixed, free], [fixed, pin]",
    "bore: 80, mass: [3, 2]": "mass of cylinder of drive 'C': where the masses of barrel and "
    "rod are does not follow; give closed and stroke",
    "bore: 80, mass: [3]": "mass of cylinder of drive 'C': 1 masses are given; write mass: "
    "[18 kg, 9 kg], of barrel and rod",
    "bore: 80, bor: 3": "unknown key 'bor' in cylinder of drive 'C'; did you mean 'bore'?",
    "rod: 45": "the key 'bore' is missing in cylinder of drive 'C'; write bore: ...",
}


@pytest.mark.parametrize("keys", WRONG)
def test_a_wrong_cylinder_is_told_where_and_what(keys: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(BOOM.replace(SIZES, keys), name="b.yaml")
    assert str(caught.value) == "b.yaml:7: " + WRONG[keys]


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "ground.A",
            "grund.A",
            "the cylinder is between points of the link 'grund', which does not exist; did you mean",
        ),
        ("boom.B", "boom.C", "link 'boom' has no point 'C'; "),
        (
            "position: 1000",
            "motor: {stall: 3, no_load: 4}",
            "a cylinder and a motor are given; leave one of them out",
        ),
        (
            "joints: {O:",
            "joints: {C: {type: weld, links: [ground, boom], at: O}, O:",
            "joint 'C' exists, and the cylinder",
        ),
        (
            "boom.B",
            "ground.O",
            "both ends of the cylinder are on ground, so that its length is fixed; name points of two links",
        ),
    ],
)
def test_what_a_cylinder_joins_is_checked(old: str, new: str, says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(BOOM.replace(old, new), name="b.yaml")
    assert says in str(caught.value)
    assert str(caught.value).startswith("b.yaml:7: ")


def test_a_link_of_its_own_cannot_have_another_mass() -> None:
    text = BOOM.replace(SIZES, f"{SIZES}, closed: 700, stroke: 290, mass: [3, 2]")
    heavy = text.replace("  boom:", "  C_rod: {points: {head: [0, 0]}, mass: 3}\n  boom:")
    with pytest.raises(da.ModelError) as caught:
        da.loads(heavy, name="b.yaml")
    assert str(caught.value) == (
        "b.yaml:8: link 'C_rod' exists, and the cylinder gives its rod and barrel their masses; leave out that link, "
        "or the masses of the cylinder"
    )
    m = da.loads(text)
    assert [m.mass(link) for link in ("C_barrel", "C_rod")] == [3.0, 2.0]


def test_out_of_stroke_says_by_how_much() -> None:
    m = da.loads(BOOM.replace(SIZES, f"{SIZES}, closed: 700, stroke: 290"))
    r = da.statics(m)
    assert r.status == ("out_of_stroke",)
    assert r.reasons[0] == (
        "Cylinder C would be 10 mm longer than it can be at C = 1000 mm: with its rod out it is 990 mm long. "
        "Change its closed length or its stroke, or the range of the motion."
    )
    assert np.isnan(r.effort("C")).all()
    assert da.statics(m.with_values({"drives.C.cylinder.stroke": "300 mm"})).status == ("ok",)
    short = da.statics(m.with_values({"drives.C.position": "699 mm"})).reasons[0]
    assert short is not None
    assert "1 mm shorter than it can be" in short
    k = da.compile(m, vary=["drives.C.cylinder.stroke"], outputs=["effort.C"])
    assert k([[0.29], [0.31]]).status[:, 0].tolist() == ["out_of_stroke", "ok"]


def test_pressures_follow_from_force_and_sense() -> None:
    m = da.loads(BOOM)
    area = math.pi * 0.08**2 / 4
    ring = area - math.pi * 0.045**2 / 4
    for speed, eta in (("50 mm/s", 0.9), ("-50 mm/s", 0.9), ("0 mm/s", 1.0)):
        c = da.statics(
            m.with_values({"drives.C.speed": speed, "drives.C.cylinder.efficiency": eta})
        ).cylinder("C")
        force = c.force[0]
        carried = {"5": force / eta, "-": force * eta, "0": force}[speed[0]]
        assert c.cap_pressure[0] == pytest.approx(carried / area, rel=1e-13)
        assert c.rod_pressure[0] == 0.0
        outer, inner = (area, ring) if speed[0] != "-" else (ring, area)
        assert c.flow_in[0] == pytest.approx(outer * abs(c.speed[0]), rel=1e-13)
        assert c.flow_out[0] == pytest.approx(inner * abs(c.speed[0]), rel=1e-13)
    still = da.statics(m.with_values({"drives.C.cylinder.friction": 300.0})).cylinder("C")
    assert (still.pressure_high - still.pressure_low)[0] == pytest.approx(600 / area, rel=1e-12)
    pulled = da.statics(m.with_values({"gravity": [0, 9.80665]})).cylinder("C")
    assert pulled.cap_pressure[0] == 0.0
    assert pulled.rod_pressure[0] == pytest.approx(-pulled.force[0] / ring, rel=1e-13)


def test_a_chamber_that_would_pull_is_said() -> None:
    keys = f"{SIZES}, rod_pressure: 0"
    text = da.statics(da.loads(BOOM.replace("standard", "[0, 9.81 m/s^2]").replace(SIZES, keys))).text()
    assert "Cylinder C pulls a vacuum: a chamber would need -2.3" in " ".join(text.split())


def test_both_pressures_are_a_known_force() -> None:
    known = f"{SIZES}, rod_pressure: 3 bar, cap_pressure: 26.02075732896913 bar, closed: 700, stroke: 450"
    m = da.loads(BOOM.replace(SIZES, known).replace("position: 1000", "position: unknown"))
    r = da.statics(m)
    assert r.drive_position("C")[-1] == pytest.approx(1.1021133803251525, rel=1e-9)
    assert da.loads(str(m)) == m
    low = BOOM.replace(SIZES, known.replace("26.02075732896913", "22")).replace(", position: 1000", "")
    free = f"{low}start: {{C: {{position: 1000, speed: 0}}}}\n"
    s = da.simulate(da.loads(free), until="3 s")
    assert s.position("C")[-1] == pytest.approx(0.7, rel=1e-12)  # it sinks onto its rod's end and stays
    assert s.speed("C")[-1] == 0.0


@over(quick=3, whole=200)
def test_a_cylinder_does_the_work_of_the_crank_that_moves_the_same_machine(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lengths: dict[str, Any] = {
        "crank": 0.1 + 0.1 * rng.random(),
        "coupler": 0.35 + 0.1 * rng.random(),
        "rocker": 0.3 + 0.1 * rng.random(),
        "ground": 0.4,
    }
    m = da.four_bar(**lengths)
    angle, omega, alpha = rng.uniform(0, 2 * np.pi), rng.uniform(1, 5), rng.uniform(-20, 20)
    turn = da.dynamics(
        m.with_values(
            {"drives.O2.position": angle, "drives.O2.speed": omega, "drives.O2.acceleration": alpha}
        )
    )
    tree = m.to_tree()
    foot = np.array([0.2, -0.7]) + 0.2 * rng.random(2)
    tree["links"]["ground"]["points"]["foot"] = [f"{x} m" for x in foot.tolist()]
    point, v, a = (f("rocker", "B")[0] for f in (turn.point, turn.point_velocity, turn.point_acceleration))
    line = point - foot
    length = float(np.hypot(*line))
    rate = float(line @ v) / length
    bend = (float(v @ v + line @ a) - rate**2) / length
    cylinder = {"between": ["ground.foot", "rocker.B"], "bore": "50 mm", "rod": "20 mm"}
    motion = {"position": f"{length} m", "speed": f"{rate} m/s", "acceleration": f"{bend} m/s^2"}
    tree["drives"] = {"C": {"cylinder": cylinder, **motion}}
    tree["assembly"] = {k: f"{float(turn.angle(k)[0])} rad" for k in ("crank", "coupler", "rocker")}
    pushed = da.dynamics(da.mechanism(tree))
    assert pushed.status == ("ok",)
    assert pushed.speed("crank")[0] == pytest.approx(omega, rel=1e-8)
    assert pushed.acceleration("crank")[0] == pytest.approx(alpha, rel=1e-6, abs=1e-6)
    work = turn.effort("O2")[0] * omega
    assert pushed.effort("C")[0] * rate == pytest.approx(work, rel=1e-7, abs=1e-9)
    force = pushed.reaction("C_head", on="rocker")[0]
    assert force == pytest.approx(pushed.effort("C")[0] * line / length, rel=1e-9, abs=1e-9)


PISTON = """units: {length: mm}
links:
  ground: {points: {O: [0, 0], F: [-500, -100]}}
  crank: {points: {O: [0, 0], A: [100, 0]}}
  rod: {points: {A: [0, 0], B: [300, 0]}}
  piston: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [O, B], direction: 0 deg}
drives: {C: {cylinder: {between: [ground.F, piston.B], bore: 50, rod: 20}, position: LENGTH mm, speed: 1 mm/s}}
assembly: {crank: CRANK rad, rod: ROD rad, piston: 0}
"""


@pytest.mark.parametrize("beside", [0.5, -0.03, 0.03, math.pi - 0.001, math.pi + 0.001])
def test_near_a_dead_centre_the_stated_crank_angle_chooses(beside: float) -> None:
    x, y = 100 * math.cos(beside), 100 * math.sin(beside)
    out, lean = x + math.sqrt(300**2 - y**2), math.asin(y / 300)
    text = PISTON.replace("LENGTH", repr(math.hypot(out + 500, 100)))

    def crank(error: float, side: int) -> tuple[float, str]:
        angle = side * (beside + error * math.sin(beside))
        stated = text.replace("CRANK", repr(angle)).replace("ROD", repr(-side * lean))
        r = da.kinematics(da.loads(stated))
        return math.sin(r.angle("crank")[0]), str(r.mode)

    for side in (1, -1):
        assert crank(0.0, side) == (pytest.approx(side * y / 100, rel=1e-6), "None")
        for error in (0.3, -0.3):  # the nearer mode is meant, and the other is named
            found, mode = crank(error, side)
            assert found == pytest.approx(side * y / 100, rel=1e-6)
            assert ("nearest" in mode and "other modes" in mode) == (abs(math.sin(beside)) < 0.1)


@over(quick=4, whole=200)
def test_the_column_is_that_of_beam_elements(seed: int) -> None:
    rng = np.random.default_rng(seed)
    l1, l2 = rng.uniform(0.2, 2.0, 2)
    e1, e2 = 10 ** rng.uniform(0, 2, 2)
    ends = list(FORMS)[seed % 3]
    found = critical_load(l1, l2, e1, e2, ends)
    assert found == pytest.approx(beam_load(l1, l2, e1, e2, ends), rel=2e-5)
    low, high = sorted(euler(l1 + l2, e, ends) for e in (e1, e2))
    assert low <= found <= high
    assert critical_load(l1, l2, e1, e1, ends) == pytest.approx(euler(l1 + l2, e1, ends), rel=1e-12)


def beam_load(l1: float, l2: float, e1: float, e2: float, ends: tuple[str, str], n: int = 16) -> float:
    """Least eigenvalue of stiffness and geometric stiffness of cubic beam elements."""
    size = 2 * (2 * n + 1)
    stiff, geometric = np.zeros((2, size, size))
    for k in range(2 * n):
        h, e = (l1 / n, e1) if k < n else (l2 / n, e2)
        at = slice(2 * k, 2 * k + 4)
        bend = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h]]
        bend += [[-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
        lean = [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h]]
        lean += [[-36, -3 * h, 36, -3 * h], [3 * h, -h * h, -3 * h, 4 * h * h]]
        stiff[at, at] += e / h**3 * np.array(bend)
        geometric[at, at] += np.array(lean) / (30 * h)
    held = {"pin": [0], "fixed": [0, 1], "free": []}
    out = [*held[ends[0]], *(size - 2 + j for j in held[ends[1]])]
    kept = np.setdiff1d(np.arange(size), out)
    loads = eigh(geometric[np.ix_(kept, kept)], stiff[np.ix_(kept, kept)], eigvals_only=True)
    return 1 / float(loads[-1])


def test_with_masses_it_is_two_bars_in_a_slider() -> None:
    text = BOOM.replace(SIZES, f"{SIZES}, closed: 700, stroke: 450, mass: [18, 9]")
    m = da.loads(text.replace("position: 1000", "position: 1000, speed: 2 m/s"))
    tree = da.loads(BOOM.replace("position: 1000", "position: 1000, speed: 2 m/s")).to_tree()
    tree["links"]["C_barrel"] |= {
        "mass": "18 kg",
        "center": ["287.5 mm", 0],
        "inertia": f"{18 * 0.575**2 / 12} kg*m^2",
    }
    tree["links"]["C_rod"] |= {
        "mass": "9 kg",
        "center": ["-287.5 mm", 0],
        "inertia": f"{9 * 0.575**2 / 12} kg*m^2",
    }
    by_hand, made = da.dynamics(da.mechanism(tree)), da.dynamics(m)
    assert made.effort("C")[0] == pytest.approx(by_hand.effort("C")[0], rel=1e-13)
    assert da.loads(str(m)) == m
    assert da.mechanism(m.to_tree()) == m
    with pytest.raises(da.ModelError, match="the mass of a cylinder's link follows from the cylinder"):
        m.with_values({"links.C_rod.mass": 3})
    with pytest.raises(da.ModelError, match=r"vary links.C_barrel.mass and links.C_rod.mass"):
        da.compile(m, vary=["drives.C.cylinder.mass"])
    k = da.compile(m, vary=["links.C_rod.mass"], outputs=["effort.C"])
    heavy = da.dynamics(m.with_values({"drives.C.cylinder.mass": ["18 kg", "10 kg"]}))
    light = k([[9.0]])["effort.C"][0, 0]
    assert light == pytest.approx(made.effort("C")[0], rel=1e-12)
    assert heavy.effort("C")[0] > light


def test_pressure_and_flow_have_exact_derivatives() -> None:
    keys = f"{SIZES}, rod_pressure: 3 bar, efficiency: 0.94"
    m = da.loads(BOOM.replace(SIZES, keys).replace("position: 1000", "position: 1000, speed: 60 mm/s"))
    paths = [f"drives.C.cylinder.{key}" for key in ("bore", "rod", "rod_pressure", "efficiency")]
    k = da.compile(m, vary=paths, outputs=["pressure.C", "flow.C"], derivatives=True)
    at = np.array([0.08, 0.045, 3e5, 0.94])
    slope = np.concatenate([k([at]).gradients[n][0] for n in ("pressure.C", "flow.C")])
    for j, h in enumerate(1e-6 * at):
        step = np.eye(4)[j] * h
        up, down = (k([at + s * step]) for s in (1, -1))
        for row, n in enumerate(("pressure.C", "flow.C")):
            change = (up[n] - down[n])[0, 0] / (2 * h)
            assert slope[row, j] == pytest.approx(change, rel=1e-6, abs=1e-9)
    r = da.dynamics(m)
    assert k([at])["pressure.C"][0, 0] == pytest.approx(r["pressure.C"][0], rel=1e-12)


@pytest.mark.parametrize("ends", FORMS)
def test_a_cylinder_shorter_than_its_barrel_is_a_column_of_its_section(ends: tuple[str, str]) -> None:
    """E pi (D^4 - d^4)/64 (pi/K L)^2 there; longer it has the rod's section too, and carries less than the barrel."""
    text = BOOM.replace(
        "rod: 45}, position: 1000}",
        f"rod: 45, barrel: 95, barrel_length: 1100, ends: [{', '.join(ends)}]"
        "}, position: [950, 1000, 1200]}",
    )
    c = da.statics(da.loads(text)).cylinder("C")
    barrel = 206e9 * math.pi / 64 * (0.095**4 - 0.08**4)
    rod = 206e9 * math.pi / 64 * 0.045**4
    assert c.critical[:2] == pytest.approx([euler(x, barrel, ends) for x in (0.95, 1.0)], rel=1e-12)
    assert c.critical[2] == pytest.approx(critical_load(1.1, 0.1, barrel, rod, ends), rel=1e-12)
    assert c.critical_barrel == pytest.approx([euler(x, barrel, ends) for x in (0.95, 1.0, 1.2)], rel=1e-12)
    assert c.critical_rod == pytest.approx([euler(x, rod, ends) for x in (0.95, 1.0, 1.2)], rel=1e-12)
    assert c.critical[2] < c.critical_barrel[2]
    assert c.critical[2] > c.critical_rod[2]
    pushes = c.force > 0
    assert c.safety[pushes] == pytest.approx((c.critical / c.force)[pushes], rel=1e-12)
    assert np.isinf(c.safety[~pushes]).all()
    idle = da.statics(da.loads(text.replace("mass: 320, center: [1600, 0]", "mass: 0"))).cylinder("C")
    assert not idle.force.any()
    assert np.isinf(idle.safety).all()
    assert critical_load(0.0, 2.0, barrel, rod, ends) == euler(2.0, rod, ends)
