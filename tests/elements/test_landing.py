"""Contacts that lift off and land in a motion under forces: closed forms, and laws that hold for any machine."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da
from dalembert.errors import ModelError
from tests.tiers import tiers

LADDER = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  ladder: {points: {F: [0, 0], W: [4, 0]}, mass: 20, center: [2, 0], inertia: 26.666666666666668}
joints:
  floor: {type: slot, links: [ground, ladder], at: [O, F], direction: 0, contact: pushes}
  wall: {type: slot, links: [ground, ladder], at: [O, W], direction: 90, contact: pushes, side: right}
drives: {floor: {freedom: slide, effort: 0}}
start: {floor: {position: %r, speed: 0}}
assembly: {ladder: 110}
"""
DISC = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], C: [0.5, 0]}}
  disc: {points: {C: [0, 0]}, mass: 3, inertia: 0.015}
joints:
  O: {type: pin, links: [ground, arm]}
  C: {type: slot, links: [arm, disc], direction: 0}
  dome: {type: rolling, links: [ground, disc], at: [O, C], radii: [0.4, 0.1]}
drives: {O: {effort: 0}}
start: {O: {position: 75 deg, speed: 0}}
"""
BALL = """
gravity: standard
links: {ground: {points: {O: [0, 0]}}, ball: {points: {B: [0, 0]}, mass: 1}}
joints:
  floor: {type: slot, links: [ground, ball], at: [O, B], contact: {pushes: true, restitution: %s}}
  up: {type: slider, links: [ground, ball], at: [O, B], direction: 90}
drives: {up: {effort: 0}}
start: {up: {position: 1.5, speed: 0}}
"""
G = 9.80665


BOX = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  a: {points: {O: [0, 0]}}
  b: {points: {O: [0, 0]}}
  box: {points: {G: [0, 0], A: [-0.3, -0.2], B: [0.3, -0.2], C: [0.3, 0.2], D: [-0.3, 0.2]}, mass: 2, inertia: 0.08}
joints:
  x: {type: slider, links: [ground, a], at: O}
  y: {type: slider, links: [a, b], at: O, direction: 90, angle: -90}
  t: {type: pin, links: [b, box], at: [O, G]}
%s
start: {x: {position: 0, speed: 0.3}, y: {position: %s, speed: 0}, t: {position: %s deg, speed: %s rad/s}}
"""
CORNER = (
    "  {n}: {{type: slot, links: [ground, box], at: [O, {n}], contact: {{pushes: true, restitution: {e}}}}}"
)
SLOPE = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  disc: {points: {C: [0, 0]}, mass: 3, inertia: 0.015}
joints:
  track: {type: rolling, links: [ground, disc], at: [O, C], radius: 0.1, direction: -30 deg, friction: %s}
drives: {track: %s}
"""


def signs(s: da.Simulation) -> None:
    """No contact pulls, none is passed through, and N gap = 0."""
    for name, force in s.normals.items():
        gap = s.gaps[name]
        assert force.min() > -1e-9 * max(force.max(), 1.0)
        assert gap.min() > -1e-9
        assert np.abs(force * gap).max() <= 1e-9
    assert max(s.energy_residual, s.law_residual, s.closure) < 1e-9


def at_event(s: da.Simulation, name: str) -> int:
    return int(np.flatnonzero(s.time == s.event(name)[0].time)[0])


def test_a_ladder_leaves_the_wall_at_two_thirds_of_its_height() -> None:
    start = math.radians(70)
    s = da.simulate(da.loads(LADDER % (4 * math.cos(start))), "1.1 s")
    k = at_event(s, "lift-off")
    assert s.events[0].sentence == "wall lifts off"
    assert math.sin(s.result.angle("ladder")[k]) == pytest.approx(2 / 3 * math.sin(start), rel=1e-10)
    after = slice(k, None)
    assert not s.normals["wall"][after].any()
    assert not s.result.reaction("wall")[after].any()
    middle = s.result.point_velocity("ladder", "center")[after, 0]
    assert middle == pytest.approx(middle[0], rel=1e-10)  # nothing pushes it along the floor any more
    assert s.result.reaction("floor")[:, 1] == pytest.approx(s.normals["floor"])
    signs(s)


def test_a_disc_rolls_off_a_cylinder() -> None:
    s = da.simulate(da.loads(DISC), "0.8 s")
    k = at_event(s, "lift-off")
    assert math.sin(s.position("O")[k]) == pytest.approx(4 / 7 * math.cos(math.radians(15)), rel=1e-10)
    assert not s.result.reaction("dome")[k + 1 :].any()
    assert s.result.speed("disc")[-1] == pytest.approx(s.result.speed("disc")[k], rel=1e-10)
    signs(s)


@pytest.mark.parametrize("e", tiers([0.3], [0.8]))
def test_a_ball_bounces_to_rest(e: float) -> None:
    s = da.simulate(da.loads(BALL % e), "10 s", count=21)
    first = math.sqrt(2 * 1.5 / G)
    assert s.event("rest")[0].time == pytest.approx(first * (1 + e) / (1 - e), rel=1e-12)
    first_landing = s.event("landing")[0]
    assert first_landing.sentence.startswith("floor lands with 5.42402 m/s and rebounds at ")
    assert first_landing.of == "floor"
    assert s["normal.floor"][-1] == s.result.reaction("floor")[-1, 1] == pytest.approx(G)
    signs(s)


def box(e: float, height: float, angle: float, spin: float) -> str:
    return BOX % ("\n".join(CORNER.format(n=n, e=e) for n in "ABCD"), height, angle, spin)


@pytest.mark.parametrize("seed", tiers(range(1), range(1, 20), range(20, 200)))
def test_a_box_falls_on_its_corners(seed: int) -> None:
    """Bounces on all four corners, and at rest on two: sum of forces m g, no energy gained or lost unaccounted."""
    drawn = np.random.default_rng(seed)
    e, angle, spin = drawn.uniform(0, 0.6), drawn.uniform(-180, 180), drawn.uniform(-3, 3)
    s = da.simulate(da.loads(box(e, 0.6, angle, spin)), "3 s", count=11)
    assert s.status == "ended"
    signs(s)
    assert len(s.event("landing")) > 1
    weight = sum(s.result.reaction(n)[-1] for n in "ABCD")
    assert weight == pytest.approx([0.0, 2 * G], abs=1e-9)


def test_a_box_that_stands_stays() -> None:
    s = da.simulate(da.loads(box(0.5, 0.2, 0, 0)), "1 s", count=5)
    assert [s["normal.A"][-1], s["normal.B"][-1]] == pytest.approx([G, G])
    assert s.position("x")[-1] == pytest.approx(0.3)
    assert np.abs(s["gap.C"] - 0.4).max() < 1e-12


def test_a_disc_slides_on_a_slope_that_is_too_steep_for_its_friction() -> None:
    """Rolling needs tan(30 deg)/3; below it slides with mu N, above it rolls with two thirds of g sin(30 deg)."""
    start = "\nstart: {track: {position: 0, speed: 0}}"
    for mu, way, spin in (
        (0.1, G * (0.5 - 0.1 * math.sqrt(0.75)) / 2, -0.1 * 3 * G * math.sqrt(0.75) * 0.1 / 0.015),
        (0.3, G / 6, -G / 0.3),
    ):
        m = da.loads(SLOPE % (f"{{coefficient: {mu}}}", "{effort: 0}") + start)
        s = da.simulate(m, "1 s", count=5)
        c = s.result.point("disc", "C")
        assert math.dist(c[-1], c[0]) == pytest.approx(way, rel=1e-12)
        assert s.result.speed("disc")[-1] == pytest.approx(spin, rel=1e-12)
        assert s["normal.track"] == pytest.approx(3 * G * math.sqrt(0.75))
        signs(s)


def test_a_wheel_beyond_its_friction_has_the_status_slips() -> None:
    limit, drive = math.tan(math.pi / 6) / 3, f"{{position: 0, acceleration: {-G / 0.3} rad/s^2}}"
    for part, status in ((1 - 1e-6, "slips"), (1 + 1e-6, "ok")):
        m = da.loads(SLOPE % (f"{{coefficient: 0, static: {limit * part}}}", drive))
        r = da.dynamics(m)
        assert r.status == (status,)
        assert np.isnan(r.effort("track")[0]) == (status == "slips")
    sentence = str(da.dynamics(da.loads(SLOPE % ("{coefficient: 0.1}", drive))).reasons[0])
    assert sentence == (
        "track slips at track = 0 deg: to roll it needs a coefficient of friction of 0.19245 at rest and has 0.1. "
        "Load it more, or let forces move it (simulate), where it slides."
    )
    floating = da.loads((SLOPE % ("{coefficient: 0.1}", drive)).replace("standard", "none"))
    assert da.dynamics(floating).reasons[0] == (
        "track slips at track = 0 deg: its links are not pressed together. Load it, or let forces move it (simulate), "
        "where it slides."
    )
    with pytest.raises(
        ModelError, match="whether 'track' slips on its track is not checked in compiled analyses"
    ):
        da.compile(m, vary=["links.disc.mass"])


def test_without_friction_a_wheel_rolls() -> None:
    """Friction switched off: rolling is ideal, as in every other analysis."""
    text = SLOPE % ("{coefficient: 0.1}", "{effort: 0}") + "\nstart: {track: {position: 0, speed: 0}}"
    s = da.simulate(da.loads(text + "\nfriction: {enabled: false}"), "1 s", count=5)
    assert s.result.speed("disc")[-1] == pytest.approx(-G / 0.3, rel=1e-12)
    with pytest.raises(
        ModelError, match="a wheel that is held on its track on both sides has no limit of friction"
    ):
        da.loads(text.replace("friction: {coe", "contact: holds, friction: {coe"))


def test_with_enough_preload_all_is_as_if_the_contact_held() -> None:
    """A force presses the disc on its cylinder: no contact is lost, and all numbers are those of `holds`."""
    load = "loads: {F: {type: force, on: disc, at: C, value: [0, -300]}}\n"
    pushes, holds = (
        da.simulate(
            da.loads((DISC + load).replace("[0.4, 0.1]", f"[0.4, 0.1], contact: {mode}")), "0.05 s", count=11
        )
        for mode in ("pushes", "holds")
    )
    for name in (
        "drive.O",
        "effort.O",
        "reaction.dome",
        "reaction.O",
        "reaction.C",
        "angle.disc",
        "energy.kinetic",
    ):
        assert pushes[name] == pytest.approx(holds[name], rel=1e-9, abs=1e-9)
    assert pushes.events == ()


@pytest.mark.long
def test_a_mirrored_ladder_does_the_same() -> None:
    """At x -> -x the wall's contact is on its other side."""
    start = 4 * math.cos(math.radians(70))
    one = da.simulate(da.loads(LADDER % start), "1 s", count=11)
    text = (LADDER % -start).replace("side: right", "side: left").replace("[4, 0]", "[-4, 0]")
    other = da.simulate(da.loads(text.replace("[2, 0]", "[-2, 0]").replace("110", "-110")), "1 s", count=11)
    assert other.events[0].time == pytest.approx(one.events[0].time, rel=1e-10)
    assert other["drive.floor"] == pytest.approx(-one["drive.floor"], rel=1e-8)
    for name in ("normal.wall", "normal.floor", "gap.wall"):
        assert other[name] == pytest.approx(one[name], rel=1e-8, abs=1e-9)


def test_a_contact_lost_at_the_start_is_said() -> None:
    fast = DISC.replace("speed: 0}", "speed: 10 rad/s}")
    with pytest.raises(ModelError) as raised:
        da.simulate(da.loads(fast), "1 s")
    force = 3 * (100 * 0.5 - G * math.sin(math.radians(75)))
    assert f"dome would have to pull with {force:.6g} N at the start: the contact is lost" in str(
        raised.value
    )


@pytest.mark.parametrize(
    ("until", "words"),
    [
        ("normal.O = 0", "'normal.O' names no contact that only pushes or pulls; the only one is 'dome'"),
        ("reaction.dom.x = 4", "unknown quantity 'reaction.dom.x'; did you mean 'reaction.dome'"),
        ("reaction.dome = 3", "reaction.dome is a vector; a condition needs a number; write reaction.dome.x"),
        ("normal.dome = 3 mm", "'3 mm' is a length, but a force is needed"),
    ],
)
def test_conditions_that_make_no_sense(until: str, words: str) -> None:
    with pytest.raises(ModelError, match=re.escape(words)):
        da.simulate(da.loads(DISC), until)


def test_conditions_of_quantities() -> None:
    """m g h of the centre and (m + I/r^2) v^2/2; a reaction's size; the time."""
    m = da.loads(DISC)
    s = da.simulate(m, ["0.5 s", "energy.kinetic = 2 J"], events=["time = 0.1 s", "normal.dome = 25 N"])
    fallen = 0.5 * (math.sin(math.radians(75)) - math.sin(s.position("O")[-1]))
    assert 3 * G * fallen == pytest.approx(2.0, rel=1e-10)
    assert [e.sentence for e in s.events] == ["time = 0.1 s", "normal.dome = 25 N", "energy.kinetic = 2 J"]
    k = int(np.flatnonzero(s.time == s.events[1].time)[0])
    assert s["normal.dome"][k] == pytest.approx(25, rel=1e-10)


JUMPING = """gravity: none
links:
  ground: {points: {O: [0, 0], top: [0, 0.3]}}
  cam: {points: {O: [0, 0]}, inertia: 0.05}
  stem: {points: {F: [0, 0]}, mass: 1.2}
joints:
  O: {type: pin, links: [ground, cam]}
  guide: {type: slider, links: [ground, stem], at: [O, F], direction: 90}
  F: {type: cam, links: [cam, stem], at: [O, F], follower: FOLLOWER, profile: {eccentric: 0.012, radius: 0.04},
      contact: {pushes: true, restitution: 0.4}}
drives: {O: {effort: 0}}
loads: {S: {type: spring, between: [ground.top, stem.F], stiffness: 8000, free_length: 0.28}}
start: {O: {position: 0, speed: 150 rad/s}}
"""


def lift_of_a_disc(roller: float | None, turn: float) -> tuple[float, float, float]:
    """Height of a follower over an eccentric disc, and its two derivatives by the turn."""
    s, c, e = math.sin(turn), math.cos(turn), 0.012
    if roller is None:
        return 0.04 + e * s, e * c, -e * s
    q = math.sqrt((0.04 + roller) ** 2 - (e * c) ** 2)
    first = e * e * c * s / q
    return e * s + q, e * c + first, -e * s + (e * e * (c * c - s * s) - first * first) / q


@pytest.mark.parametrize("roller", tiers([0.01], [None]))
def test_a_follower_jumps_off_its_cam_and_lands(roller: float | None) -> None:
    """Against both motions written out and integrated by scipy: on the cam by Lagrange, off it freely."""
    mass, inertia, e = 1.2, 0.05, 0.4

    def spring(y: float) -> float:
        return -8000 * (0.28 - (0.3 - y))

    def on(_: float, x: Any) -> list[float]:
        y, first, second = lift_of_a_disc(roller, x[0])
        push = spring(y) * first - mass * first * second * x[1] ** 2
        return [x[1], push / (inertia + mass * first**2)]

    def normal(t: float, x: Any) -> float:
        y, first, second = lift_of_a_disc(roller, x[0])
        return mass * (first * on(t, x)[1] + second * x[1] ** 2) - spring(y)

    def off(_: float, x: Any) -> list[float]:
        return [x[1], 0.0, x[3], spring(x[2]) / mass]

    def gap(_: float, x: Any) -> float:
        return float(x[2] - lift_of_a_disc(roller, x[0])[0])

    normal.terminal = gap.terminal = True  # type: ignore[attr-defined]
    gap.direction = -1  # type: ignore[attr-defined]
    exact = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}
    phase = solve_ivp(on, (0, 0.05), [0, 150], events=normal, **exact)
    expected, when, x = [phase.t[-1]], phase.t[-1], phase.y[:, -1]
    y, first, _ = lift_of_a_disc(roller, x[0])
    x = np.array([x[0], x[1], y, first * x[1]])
    for _ in range(2):
        phase = solve_ivp(off, (when, 0.05), x, events=gap, first_step=1e-6, **exact)
        when, x = phase.t[-1], phase.y[:, -1]
        first = lift_of_a_disc(roller, x[0])[1]
        rate = x[3] - first * x[1]
        expected += [when, -rate]
        impulse = -(1 + e) * rate / (1 / mass + first**2 / inertia)
        x[3], x[1] = x[3] + impulse / mass, x[1] - impulse * first / inertia
    m = da.loads(JUMPING.replace("FOLLOWER", "flat" if roller is None else f"{{roller: {roller}}}"))
    s = da.simulate(m, until="0.026 s" if roller else "0.03 s")
    found = [s.event("lift-off")[0].time, *(v for x in s.event("landing")[:2] for v in (x.time, x.speed))]
    assert found == pytest.approx(expected, rel=1e-9)
    assert s.energy_residual < 1e-9
    pushed = np.hypot(*s.result.reaction("F").T)
    assert s["normal.F"] == pytest.approx(pushed, abs=1e-9 * pushed.max())
    stop = da.simulate(m, until="normal.F = 100 N")
    assert stop["normal.F"][-1] == pytest.approx(100)
    held = da.simulate(m.with_values({"joints.F.contact": "holds"}), "0.004 s").result
    on_cam = da.simulate(m, "0.004 s").result
    assert on_cam.force_array == pytest.approx(held.force_array, abs=1e-8 * pushed.max())
    assert on_cam.moment_array == pytest.approx(held.moment_array, abs=1e-8 * pushed.max())


GUIDED = """gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  block: {points: {B: [0, 0], P: [AT, 0]}, mass: 2, inertia: 0.01}
joints:
  S: {type: slider, links: [ground, block], at: [O, B], contact: pushes,
      friction: {coefficient: MU, guide: [0.1, 0.12]}}
loads: {P: {type: force, on: block, at: P, direction: -90, value: 300*time}}
start: {S: {position: 0, speed: 0}}
"""


@pytest.mark.parametrize(("at", "end", "lifts"), [(0.25, 0.12, "rear"), (-0.25, -0.1, "front")])
def test_a_block_on_a_guide_of_two_ends_tips_about_one_of_them(at: float, end: float, lifts: str) -> None:
    """From P (at - end) = m g end on, by Lagrange's equation of the block whose end stays on the guide."""
    s = da.simulate(da.loads(GUIDED.replace("AT", str(at)).replace("MU", "0")), "0.12 s", count=7)
    weight, inertia = 2 * 9.80665, 0.01
    begins = weight * end / (300 * (at - end))
    assert [e.sentence for e in s.events] == [f"S lifts off at its {lifts} end"]
    assert s.events[0].time == pytest.approx(begins, rel=1e-9)

    def rates(t: float, state: Any) -> list[float]:
        turn, rate = state
        c, sine = math.cos(turn), math.sin(turn)
        moment = weight * end * c - 300 * t * (at - end) * c + 2 * end**2 * sine * c * rate**2
        return [rate, moment / (inertia + 2 * end**2 * c**2)]

    times = s.time[s.time > begins]
    motion = solve_ivp(rates, (begins, 0.12), [0.0, 0.0], t_eval=times, rtol=1e-11, atol=1e-13).y
    assert s.result.angle("block")[s.time > begins] == pytest.approx(motion[0], rel=1e-7, abs=1e-10)
    assert s.result.speed("block")[s.time > begins] == pytest.approx(motion[1], rel=1e-7, abs=1e-9)
    for gap, place in (("S.behind", -0.1), ("S.ahead", 0.12)):
        wanted = (place - end) * np.sin(motion[0])
        assert s.gaps[gap][s.time > begins] == pytest.approx(wanted, rel=1e-7, abs=1e-10)


def test_a_block_rubs_with_the_forces_at_both_ends_of_its_guide() -> None:
    """As both push, their sum is what presses: weight and load, wherever it acts."""
    text = GUIDED.replace("[0.1, 0.12]", "[0.12, 0.1]").replace("AT", "0.25").replace("MU", "0.2")
    s = da.simulate(da.loads(text.replace("speed: 0", "speed: 1")), "0.04 s", count=4)
    assert s.speed("S") == pytest.approx(1 - 0.2 * (9.80665 * s.time + 300 * s.time**2 / 4), rel=1e-9)


@pytest.mark.long
def test_a_block_that_tips_where_its_guide_rubs_is_not_followed() -> None:
    s = da.simulate(da.loads(GUIDED.replace("AT", "0.25").replace("MU", "0.2")), "0.12 s", count=3)
    assert s.ended == (
        "stopped at 0.06 s: S tips, and its guide has friction, which is not followed on one end; write two slots with "
        "contact: pushes and friction, one at each end"
    )


WHEEL = """
links:
  ground: {points: {W: [0, 0]}}
  wheel: {points: {W: [0, 0]}, mass: 1 kg}
joints:
  W: {type: rolling, links: [ground, wheel], at: W, KEYS}
drives: {W: {position: 0}}
"""


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        (
            "radii: [0.1, 0.1], internal: true",
            "a wheel is as large as the internal wheel around it; make one of",
        ),
        (
            "radius: 0.1, radii: [0.3, 0.1]",
            "its size is not clear; give either radius, for a wheel on a line",
        ),
        ("internal: true", "its size is not clear; give either radius"),
        ("radius: 0.1, internal: true", "a wheel on a line cannot be internal; leave it out"),
        ("radii: [0.3, 0.1], direction: 30", "a wheel on a circle has no direction; leave it out"),
    ],
)
def test_a_wheel_of_no_size_is_refused_at_its_line(keys: str, says: str) -> None:
    with pytest.raises(ModelError) as refused:
        da.loads(WHEEL.replace("KEYS", keys), name="wheel.yaml")
    assert str(refused.value).startswith("wheel.yaml:6: ")
    assert says in str(refused.value)
