"""Screws of drives: against the equilibrium of a thread's flank, power, derivatives, rest, wrong keys; wedges."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da
from tests.tiers import over

COLLAR = "collar: {radius: 20, coefficient: 0.06}"
SCREW = f"{{lead: 8, radius: 15, thread_angle: 15 deg, friction: {{coefficient: 0.1}}, {COLLAR}}}"
FILE = """units: {length: mm, mass: kg, force: kN, moment: N*m}
links: {ground: {points: {O: [0, 0]}}, nut: {points: {N: [0, 0]}}}
joints: {S: {type: slider, links: [ground, nut], at: [O, N], direction: 90}}
drives: {S: {position: 0, speed: 10 mm/s, screw: SCREW}}
loads: {W: {type: force, on: nut, at: N, value: [0, -6.4]}}
"""


def flank_torque(force: float, lead: float, radius: float, angle: float, mu: float) -> float:
    """A flank that pushes with N: n is normal to the directions along the thread and along its axial section."""
    slope = math.atan(lead / (2 * math.pi * radius))
    along = np.array([0.0, math.cos(slope), math.sin(slope)])  # radial, around, axial
    section = np.array([math.cos(angle), 0.0, -math.sin(angle)])
    n = np.cross(section, along)
    n /= np.linalg.norm(n) * math.copysign(1, n[2])
    push = n - mu * along
    return -force * radius * float(push[1] / push[2])


@over(quick=4, whole=200)
def test_torque_is_that_of_the_flank(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lead, radius, angle = rng.uniform(2, 12), rng.uniform(8, 30), rng.uniform(0, 0.6)
    mu, way, load = rng.uniform(0.02, 0.3), rng.choice([-1, 1]), rng.choice([-1, 1]) * rng.uniform(1, 9)
    text = f"{{lead: {lead}, radius: {radius}, thread_angle: {angle} rad, friction: {{coefficient: {mu}}}}}"
    m = da.loads(
        FILE.replace("SCREW", text).replace("-6.4", f"{-load}").replace("10 mm/s", f"{10 * way} mm/s")
    )
    r = da.statics(m)
    s = r.screw("S")
    raising = way * load > 0
    size = flank_torque(abs(load) * 1e3, lead / 1e3, radius / 1e3, angle, mu if raising else -mu)
    assert s.torque[0] == pytest.approx(math.copysign(size, size * load), rel=1e-12)
    lost = s.torque * s.turning - s.force * 0.01 * way
    assert lost[0] > 0
    into = max(s.torque[0] * s.turning[0], 0) + max(-s.force[0] * 0.01 * way, 0)
    assert s.efficiency[0] == pytest.approx(1 - lost[0] / into, rel=1e-9, abs=1e-12)
    assert s.self_locking == (mu >= s.locking_coefficient)


def test_at_rest_it_is_held_within_an_interval() -> None:
    up, down, rest = (
        da.statics(da.loads(FILE.replace("SCREW", SCREW).replace("10 mm/s", v))).screw("S")
        for v in ("10 mm/s", "-10 mm/s", "0 mm/s")
    )
    assert (rest.torque_low[0], rest.torque_high[0]) == (down.torque[0], up.torque[0])
    assert rest.torque_low[0] < rest.torque[0] < rest.torque_high[0]
    assert rest.torque[0] == pytest.approx(6400 * 0.008 / (2 * math.pi), rel=1e-12)


@pytest.mark.parametrize(
    ("speed", "row"),
    [
        ("10 mm/s", ["0 mm", "3 kN", "12.1525 N*m", "0.3143"]),
        ("-10 mm/s", ["100 mm", "-6 kN", "-24.305 N*m", "0.3143"]),
        ("0 mm/s", ["100 mm", "-6 kN", "-24.305 to 8.86122 N*m", "-"]),
    ],
)
def test_the_table_has_the_position_of_its_greatest_torque(speed: str, row: list[str]) -> None:
    """In either sense; the load on the nut is -3 kN at 0 and 6 kN at the end. At rest no power goes in."""
    text = FILE.replace("SCREW", SCREW).replace("position: 0,", "position: {from: 0, to: 100, count: 3},")
    text = text.replace("value: [0, -6.4]", "direction: 90, value: {expression: 90*S - 3, unit: kN}")
    said = da.statics(da.loads(text.replace("10 mm/s", speed))).text().splitlines()
    assert [" ".join(line.split()) for line in said if line.startswith("S ")][-1] == " ".join(["S", *row])
    force = 1e3 * abs(float(row[1].split()[0]))
    size = flank_torque(force, 8e-3, 15e-3, math.radians(15), 0.1)
    torque = float(row[2].split()[0])
    assert abs(torque) == pytest.approx(size + 0.02 * 0.06 * force, rel=1e-5)


def test_its_torque_is_a_quantity_with_exact_derivatives() -> None:
    m = da.loads(FILE.replace("SCREW", SCREW))
    paths = [
        f"drives.S.screw.{k}"
        for k in ("lead", "radius", "thread_angle", "friction.coefficient", "collar.radius")
    ]
    k = da.compile(m, vary=paths, outputs=["screw_torque.S"], derivatives=True)
    at = k.nominal
    assert k([at])["screw_torque.S"][0, 0] == pytest.approx(da.statics(m)["screw_torque.S"][0], rel=1e-13)
    for j, h in enumerate(1e-6 * at):
        step = np.eye(len(at))[j] * h
        change = (k([at + step])["screw_torque.S"] - k([at - step])["screw_torque.S"])[0, 0] / (2 * h)
        assert k([at]).gradients["screw_torque.S"][0, 0, j] == pytest.approx(change, rel=1e-6)
    assert "does not lock by itself" in da.statics(m).text() or "is self-locking" in da.statics(m).text()
    assert da.loads(str(m)) == m


def test_pitch_and_starts_make_the_lead() -> None:
    both = (
        da.loads(FILE.replace("SCREW", SCREW.replace("lead: 8", x)))
        for x in ("lead: 8", "pitch: 4, starts: 2")
    )
    one, other = (da.statics(m).screw("S").torque[0] for m in both)
    assert one == other


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "lead: 8, ",
            "",
            "the lead of the screw is not clear; give either lead, or pitch and starts",
        ),
        ("lead: 8", "lead: -8", "lead of screw of drive 'S': -8 is not positive; write a positive one"),
        (
            "coefficient: 0.1",
            "coefficient: 30",
            "the thread jams: no torque raises a load; write a smaller lead",
        ),
        (
            "screw:",
            "motor: {stall: 1, no_load: 2 m/s}, screw:",
            "a screw and a motor are given; give the motor ratio: 785.398",
        ),
        (
            "type: slider, links: [ground, nut], at: [O, N], direction: 90}}\ndrives: {S: {position: 0, speed: 10 mm/s",
            "type: pin, links: [ground, nut], at: [O, N]}}\ndrives: {S: {position: 0, speed: 1 rad/s",
            "a screw moves a slide, and this drive turns; drive the slide",
        ),
    ],
)
def test_wrong_screws_are_told(old: str, new: str, says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(FILE.replace("SCREW", SCREW).replace(old, new), name="s.yaml")
    assert says in str(caught.value)
    assert str(caught.value).startswith("s.yaml:4: ")


WEDGE = """units: {length: mm, mass: kg, force: N}
links: {ground: {points: {O: [0, 0]}}, wedge: {points: {W: [0, 0]}}, block: {points: {B: [0, 0]}}}
joints:
  floor: {type: slider, links: [ground, wedge], at: [O, W], direction: 0, friction: {coefficient: 0.18}}
  face: {type: slider, links: [wedge, block], at: [W, B], direction: BACK, angle: -BACK, friction: {coefficient: 0.18}}
  guide: {type: slot, links: [ground, block], at: [O, B], direction: 90, friction: {coefficient: 0.18}}
drives: {floor: {position: 0, speed: 0.1 m/s}}
loads: {W: {type: force, on: block, at: B, value: [0, -4000]}}
"""


@pytest.mark.parametrize("angle", [4.0, 9.0, 15.0, 20.3, 20.5, 30.0, 60.0])
def test_a_wedge_with_three_rubbing_faces(angle: float) -> None:
    m = da.loads(WEDGE.replace("-BACK", str(angle - 180)).replace("BACK", str(180 - angle)))
    a, phi = math.radians(angle), math.atan(0.18)
    assert da.statics(m).effort("floor")[0] == pytest.approx(4000 * math.tan(a + 2 * phi), rel=1e-9)
    out = -da.statics(m.with_values({"drives.floor.speed": "-0.1 m/s"})).effort("floor")[0]
    pull = 4000 * (math.tan(2 * phi - a) if a > phi else math.sin(2 * phi - a) / math.cos(a))
    assert out == pytest.approx(pull, rel=1e-9)
    assert (out > 0) == (a < 2 * phi)  # it stays by itself below twice the angle of friction
    template = da.wedge(slope=angle, coefficient=0.18, mass=4000 / 9.80665, positions=2)
    assert da.statics(template).effort("floor") == pytest.approx(2 * [4000 * math.tan(a + 2 * phi)], rel=1e-9)


def test_a_wedge_jams_from_a_right_angle_less_twice_that_of_friction_on() -> None:
    for angle, status in ((69.5, "ok"), (69.7, "jammed")):
        m = da.loads(WEDGE.replace("-BACK", str(angle - 180)).replace("BACK", str(180 - angle)))
        assert da.statics(m).status == (status,)
