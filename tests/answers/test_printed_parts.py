"""Lines of printed answers that few machines have, with numbers by hand; and what is read from answers by name."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model import loads
from dalembert.printing import number
from tests.elements.test_cam_cases import sliding
from tests.model.parts import FOUR_BAR

CONE = """units: {length: mm, mass: kg, force: N, moment: N*m}
links: {ground: {points: {O: [0, 0]}}, disc: {points: {O: [0, 0]}}}
joints:
  U: {type: pin, links: [ground, disc], at: O}
  cone: {type: cone, links: [ground, disc], at: O, radii: [50, 60], force: 100, half_angle: ANGLE,
         friction: {coefficient: 0.2}}
drives: {U: {position: 0, speed: 5 rad/s}}
"""


@pytest.mark.parametrize("angle", [8, 11, 12])
def test_a_cone_below_its_angle_of_friction_holds_itself_in(angle: float) -> None:
    """F (1 + mu/tan a) pushes it in, F (mu/tan a - 1) draws it off, M = mu F r/sin a."""
    lines = da.statics(loads(CONE.replace("ANGLE", str(angle)))).text().splitlines()
    grip = 0.2 / math.tan(math.radians(angle))
    drawn = f"{number(100 * (grip - 1))} N draw it off" if grip > 1 else "it comes off by itself"
    assert (
        f"cone: friction radius 55 mm; {number(100 * (1 + grip))} N push it in without slip, {drawn}."
        in lines
    )
    torque = 0.2 * 100 * 0.055 / math.sin(math.radians(angle))
    row = next(line.split() for line in lines if line.startswith("cone ") and line.endswith(" -  0.2"))
    assert row == ["cone", number(torque), "100", number(100 / (2 * math.pi * 50 * 10)), number(5 * 50 / math.pi / 10),
                   "-", "0.2"]  # fmt: skip


SLIDES = """units: {length: mm, mass: kg, force: N, moment: N*m}
links:
  ground: {points: {O: [0, 0], Q: [100, 0]}}
  a: {points: {O: [0, 0]}, mass: 2}
  b: {points: {Q: [0, 0]}, mass: 3}
joints:
  O: {type: slider, links: [ground, a], friction: {coefficient: 0.1, force: 5}}
  Q: {type: slider, links: [ground, b], damping: 3}
drives: {O: {position: 0, speed: 1 m/s}, Q: {position: 0, speed: 2 m/s}}
gravity: standard
"""


def test_what_rubs_is_said_in_a_word() -> None:
    """3 N s/mm at 2 m/s; 0.1 of the weight and 5 N."""
    r = da.dynamics(loads(SLIDES))
    lines = [line.split("  ") for line in r.text().splitlines()]
    rows = {row[0]: [cell.strip() for cell in row if cell.strip()] for row in lines}
    at = next(k for k, row in enumerate(lines) if row[0] == "friction")
    rubs = {row[0]: [cell.strip() for cell in row if cell.strip()] for row in lines[at + 3 : at + 5]}
    held = 5 + 0.1 * 2 * 9.80665
    assert rubs == {
        "O": ["O", "a", number(held), "0", number(held / 1e3), "mu 0.1, constant 5 N, lower face"],
        "Q": ["Q", "b", "0", "0", "12", "viscous"],
    }
    assert rows["F_ij is the force by link i on link j, in ground axes; moments about the joint's"]
    assert r.effort("O") == pytest.approx([held])
    assert r.effort("Q") == pytest.approx([6000])
    assert r.power_lost("Q") == pytest.approx([12e3])
    still = da.statics(loads(SLIDES.replace(", speed: 1 m/s", "").replace(", speed: 2 m/s", "")))
    assert still.interval("O")[0] == pytest.approx([-held, held])
    assert (
        f"O          0 mm  0 mm/s      0 mm/s^2  {number(-held)} to {number(held)} N"
        in still.text().splitlines()
    )
    assert "Efficiency" not in still.text()


def test_without_friction_nothing_is_lost() -> None:
    r = da.statics(da.four_bar(), positions=3)
    assert r.power_lost("A").tolist() == [0.0, 0.0, 0.0]
    assert np.array_equal(r.holding("O2"), np.stack([r.effort("O2")] * 2, axis=-1))


TURNING = """links:
  ground: {points: {O: [0.3, 0]}}
  rod: {points: {O: [0, 0]}, mass: 2, center: [0.5, 0], inertia: 0.1}
joints: {O: {type: pin, links: [ground, rod]}}
drives: {O: {position: -40 deg}}
turning: {axis: AXIS, at: [0.1, 0], speed: 8 rad/s}
"""


@pytest.mark.parametrize(("axis", "words"), [("y", "the y axis"), ("60 deg", "a line at 60 deg")])
def test_a_turning_plane_says_about_which_line(axis: str, words: str) -> None:
    """m w^2 times the distance from the line is the force of the pin."""
    r = da.statics(loads(TURNING.replace("AXIS", axis)))
    angle = math.radians(90 if axis == "y" else 60)
    center = np.array([0.3 + 0.5 * math.cos(math.radians(-40)), 0.5 * math.sin(math.radians(-40))])
    across = np.array([math.sin(angle), -math.cos(angle)])
    force = 2 * 64 * ((center - [0.1, 0]) @ across) * across
    assert r.reaction("O", on="rod")[0] == pytest.approx(-force)
    said = (
        f"friction off, turning about {words} through [0.1, 0] m at {number(8 * 30 / math.pi)} rpm; rod as points, "
        "inertia about the axis left out"
    )
    assert said in " ".join(r.text().split())


def cam(contact: dict[str, Any], follower: Any) -> Any:
    """A disc of 40 mm, 12 mm off its axis, under 1 kg that its weight presses on, at 40 rad/s."""
    drive = {"position": {"from": 0, "to": 360, "count": 37}, "speed": "40 rad/s"}
    disc = {"eccentric": "12 mm", "radius": "40 mm"}
    tree = sliding(follower, disc, drive=drive, stem={"mass": 1}, gravity="standard")
    tree["joints"]["F"] |= contact
    return da.dynamics(da.mechanism(tree))


def test_a_follower_that_lifts_off_says_up_to_which_speed_it_stays() -> None:
    """Its acceleration is e w^2 sin(th): of the positions asked, it stays on at all up to
    w = sqrt(g/(e sin(th))), and is off where sin(th) > g/(e w^2)."""
    r = cam({}, "flat")
    limit = math.sqrt(9.80665 / (0.012 * np.sin(r.drive_position("O")).max()))
    text = " ".join(r.text().split())
    assert f"F stays in contact up to {float(f'{limit:.3g}'):g} rad/s (now 40 rad/s)." in text
    assert r.contact("F").lift_speed == pytest.approx(limit, rel=1e-9)
    assert np.array_equal(
        np.array(r.status) == "ok", np.sin(r.drive_position("O")) < 9.80665 / (0.012 * 1600)
    )


def test_a_follower_in_a_groove_says_where_it_changes_walls() -> None:
    r = cam({"contact": "holds"}, "flat")
    first = math.degrees(math.asin(9.80665 / (0.012 * 1600)))
    text = " ".join(r.text().split())
    assert np.degrees(r.contact("F").changes) == pytest.approx([first, 180 - first], abs=1e-2)
    at = ", ".join(number(math.degrees(x)) for x in r.contact("F").changes)
    assert f"F goes over from one wall to the other near O = {at} deg: with play it knocks there." in text


def test_a_disc_of_two_says_from_which_preload_on_both_stay_on() -> None:
    """Half the greatest force of the one roller that would hold it."""
    r = cam({"contact": "holds", "preload": "5 N"}, {"roller": "10 mm"})
    single = cam({"contact": "holds"}, {"roller": "10 mm"})
    at = ", ".join(number(math.degrees(x)) for x in r.contact("F").changes)
    least = number(float(np.abs(single.contact("F").force).max()) / 2)
    text = " ".join(r.text().split())
    assert (
        f"A disc of F comes off or on near O = {at} deg; from {least} N of preload on both stay on." in text
    )


def test_motions_are_read_by_name_with_their_rates() -> None:
    """A slider-crank with a long rod, by its formulas."""
    r = da.kinematics(da.slider_crank(crank=0.1, rod=0.3, speed=5.0, sweep=(0.2, 1.2), positions=4))
    a, w = r.drive("O2"), 5.0
    assert a == pytest.approx(np.linspace(0.2, 1.2, 4))
    assert r.drive("O2", "speed") == pytest.approx(np.full(4, w))
    assert r.drive("O2", "acceleration") == pytest.approx(np.zeros(4))
    sine, cosine = np.sin(a) / 3, np.sqrt(1 - np.sin(a) ** 2 / 9)
    slide = 0.1 * np.cos(a) + 0.3 * cosine
    rate = -0.1 * w * (np.sin(a) + np.cos(a) * sine / cosine)
    assert r.slide("guide") == pytest.approx(slide, rel=1e-12)
    assert r.slide("guide", "speed") == pytest.approx(rate, rel=1e-12)
    step = 1e-4
    near = [0.1 * np.cos(x) + np.sqrt(0.09 - (0.1 * np.sin(x)) ** 2) for x in (a - step, a, a + step)]
    assert r.slide("guide", "acceleration") == pytest.approx(
        w**2 * (near[0] - 2 * near[1] + near[2]) / step**2, rel=1e-6
    )
    assert r.turn("O2") == pytest.approx(a)
    assert r.turn("O2", "speed") == pytest.approx(np.full(4, w))


def test_a_batch_is_read_as_a_result_is() -> None:
    outputs = ["rotation.rod", "point.rod.origin.velocity", "point.rod.center", "point.rod.center.velocity"]
    m = da.rssr()
    b, r = da.compile(m, [], [*outputs, "point.rod.B.acceleration"])(), da.dynamics(m)
    pairs = (
        (b.rotation("rod")[0].reshape(-1, 3, 3), r.rotation("rod").reshape(-1, 3, 3)),
        (b.velocity("rod")[0], r.velocity("rod")),
        (b.center("rod")[0], r.center("rod")),
        (b.center_velocity("rod")[0], r.center_velocity("rod")),
        (b.point_acceleration("rod", "B")[0], r.point_acceleration("rod", "B")),
    )
    for found, wanted in pairs:
        assert found == pytest.approx(wanted, rel=1e-10, abs=1e-12 * np.abs(wanted).max())


IN_SPACE = """space: space
links:
  ground: {points: {O: [0, 0, 0]}}
  rod: {points: {O: [0, 0, 0], P: [0.4, 0.1, 0.2]}, mass: 2, center: [0.2, 0, 0]}
joints: {O: {type: revolute, links: [ground, rod], axis: [0, 0, 1]}}
drives: {O: {position: [0, 50, 200], effort: 3}}
loads: {F: {type: KIND, on: rod, direction: [1, 2, 2], value: unknown}}
gravity: [0, -9.81, 0]
"""


@pytest.mark.parametrize("follows", [False, True])
@pytest.mark.parametrize("kind", ["force", "couple"])
def test_an_unknown_load_in_space_has_its_direction_in_the_link_or_in_the_ground(
    kind: str, follows: bool
) -> None:
    """What is missing about the axis of the hinge, over the arm of one unit."""
    words = kind + (", at: P" if kind == "force" else "") + (", axes: link" if follows else "")
    r = da.statics(loads(IN_SPACE.replace("KIND", words)))
    turn = np.exp(1j * np.radians([0, 50, 200]))
    place, along = (0.4 + 0.1j) * turn, (1 + 2j) / 3 * (turn if follows else 1.0)
    arm = (place.conj() * along).imag if kind == "force" else np.full(3, 2 / 3)
    assert r.unknown_load("F") == pytest.approx((2 * 9.81 * 0.2 * turn.real - 3) / arm, rel=1e-10)
    for k in (1, 2, 3):
        assert da.wrench.on(r, "rod", at=k).equilibrium().holds


def test_how_far_a_linkage_is_from_opening() -> None:
    """Links in line, stretched or folded; of a slide, the line that just touches the rocker's circle."""
    m = da.four_bar(positions=7)
    r = da.kinematics(m)
    a, b = (np.linalg.norm(r.point(i, p) - r.point(j, q), axis=1)
            for i, p, j, q in (("crank", "A", "coupler", "B"), ("rocker", "O4", "coupler", "B")))  # fmt: skip
    d = np.linalg.norm(r.point("crank", "A") - r.point("rocker", "O4"), axis=1)
    assert r["closure.B"] == pytest.approx(np.minimum(a + b - d, d - np.abs(a - b)), rel=1e-12)
    slide = da.kinematics(loads(SLIDING.replace("ANGLES", "[10, 30, -20, 36]")))
    assert slide["closure.B"] == pytest.approx(0.3 - np.abs(0.5 * np.sin(slide.drive("O"))), abs=1e-12)


SLIDING = """links:
  ground: {points: {O: [0, 0], C: [0.5, 0]}}
  crank: {points: {O: [0, 0], S: [0.1, 0]}}
  rocker: {points: {C: [0, 0], S: [0.3, 0]}}
  block: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  C: {type: pin, links: [ground, rocker]}
  B: {type: pin, links: [block, rocker], at: [B, S]}
  S: {type: slider, links: [crank, block], at: [S, B]}
drives: {O: {position: ANGLES}}
"""


def test_an_unknown_load_is_the_sum_of_its_parts() -> None:
    text = FOUR_BAR.replace("value: 120}", "value: unknown}").replace(
        "acceleration: -40 rad/s^2}", "effort: 3}"
    )
    r = da.dynamics(loads(text))
    parts = da.superposition(r).unknown_load("T_4")
    assert set(parts) >= {"F_P", "effort of O2"}
    assert sum(parts.values()) == pytest.approx(r.unknown_load("T_4"), rel=1e-10)
    twice = da.dynamics(loads(text.replace("effort: 3}", "effort: 6}")))
    grown = twice.unknown_load("T_4") - r.unknown_load("T_4")
    assert grown == pytest.approx(parts["effort of O2"], rel=1e-10)


GUIDED_TWICE = """links:
  ground: {points: {A: [0, 0], B: [0, 1]}}
  block: {points: {A: [0, 0], B: [0, 1], P: [0.5, 0.2]}}
joints:
  A: {type: slider, links: [ground, block]}
  B: {type: SECOND, links: [ground, block]}
drives: {A: {position: POSITIONS}}
loads: {F: {type: force, on: block, at: P, value: [3, -4]}}
"""


@pytest.mark.parametrize(("second", "positions", "said"), [
    ("slider", "[0, 1, 2]", True), ("slider", "[0, 1]", True), ("slot", "[0, 1, 2]", True), ("slider", "0", False),
])  # fmt: skip
def test_a_table_of_positions_says_what_is_not_unique(second: str, positions: str, said: bool) -> None:
    text = GUIDED_TWICE.replace("SECOND", second).replace("POSITIONS", positions)
    r = da.statics(loads(text))
    lines = r.text().splitlines()
    if second == "slider" and said:  # each has its part along the guides alone
        head = next(k for k, line in enumerate(lines) if line.startswith("no.  "))
        assert lines[head].split("  ")[-2:] == ["F A x", "F B x"]
        assert lines[head + 3].split() == ["1", "redundant", "0", "-3", "0", "0"]
    assert ("Least-norm values of what is not unique: --csv, --json, or a single position." in lines) == said
    alone = da.statics(
        loads(text.replace("  B: {type: " + second + ", links: [ground, block]}\n", ""))
    ).text()
    assert "Least-norm" not in alone
