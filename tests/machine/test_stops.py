"""End stops and what is said of them: closed forms, momentum written by hand, and how a person meets them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import ModelError

HAMMER = Path(__file__).parents[2] / "docs" / "drop-hammer.yaml"

FLYWHEEL = """
units: {length: mm, angle: deg}
links:
  ground: {points: {O: [0, 0]}}
  rotor: {points: {O: [0, 0]}, mass: 1 kg, inertia: 0.5 kg*m^2}
joints: {O: {type: pin, links: [ground, rotor]}}
drives: {O: {effort: -0.5 N*m, stops: {from: 0, to: 90, restitution: 0.5}}}
start: {O: {position: 45 deg, speed: 0}}
"""


@pytest.mark.parametrize(
    ("path", "value", "found"),
    [
        ("drives.ram.stops.restitution", 0.7, lambda m: m.drives["ram"].stops.restitution == 0.7),
        ("drives.ram.stops.to", "800 mm", lambda m: m.drives["ram"].stops.greatest == 0.8),
        ("start.ram.position", 0.3, lambda m: m.start["ram"].position == 0.3),
        ("start.ram.speed", "-1 m/s", lambda m: m.start["ram"].speed == -1.0),
    ],
)
def test_numbers_of_stops_and_starts_change_by_path(path: str, value: object, found: Any) -> None:
    m = da.load(HAMMER)
    other = m.with_values({path: value})
    assert found(other)
    assert not found(m)
    assert da.loads(str(other)) == other
    assert other.drives["ram"].stops is not None
    assert (other.drives["ram"].stops.least, other.start["ram"].turns) == (0.0, False)


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (
            "drives.ram.stops.restituton",
            0.7,
            "drives.ram: unknown key 'restituton' in stops; did you mean 'restitution'",
        ),
        ("drives.ram.stops.restitution", 7, "restitution of stops: restitution is 7"),
        ("drives.ram.stops.restitution.x", 7, "goes into a single value"),
        ("start.ram.sped", 0.3, "unknown key 'sped' in start; did you mean 'speed'?"),
        ("start.rm.speed", 0.3, "'rm' does not exist in start"),
    ],
)
def test_what_is_no_such_path_says_so(path: str, value: object, sentence: str) -> None:
    with pytest.raises(ModelError) as raised:
        da.load(HAMMER).with_values({path: value})
    assert sentence in str(raised.value)


def test_sentences_have_the_units_of_the_tables() -> None:
    """w^2 = 2 alpha q: 45 deg at 1 rad/s2; 0.25 J at the first impact are lost for e = 0.5 to 3/4."""
    s = da.simulate(da.loads(FLYWHEEL), "4 s")
    speed = (2 * 0.7853981633974483) ** 0.5
    assert s.event("impact")[0].sentence.startswith(f"O strikes its stop at 0 rad with {speed:.6g} rad/s")
    text = s.text()
    assert f"in the first, O strikes its stop at 0 deg with {speed:.6g} rad/s" in " ".join(text.split())
    assert text.count("strikes") == 1
    assert s.record(s.scale("file"))["events"][0]["sentence"].startswith("O strikes its stop at 0 deg with ")


@pytest.mark.parametrize(("e", "impacts"), [(0.4, 16), (0.9, 132), (0.2507, 10)])
def test_infinitely_many_bounces_end_at_their_limit(e: float, impacts: int) -> None:
    """t0 (1 + 2 e + 2 e^2 + ...) = t0 (1 + e) / (1 - e). Bounces count until e^n is below a millionth: of the greatest
    speed, which is that of the first impact, wherever steps end."""
    m = da.load(HAMMER).with_values({"drives.ram.stops.restitution": e, "drives.ram.effort": 0.0})
    s = da.simulate(m, "10 s", count=11)
    first = math.sqrt(2 * 0.5 / 9.80665)
    assert s.event("ram stays on its stop")[0].time == pytest.approx(first * (1 + e) / (1 - e), rel=1e-12)
    assert sum(x.lost for x in s.event("impact")) == pytest.approx(80 * 9.80665 * 0.5, rel=1e-11)
    assert len(s.event("impact")) == impacts == math.ceil(math.log(1e-6) / math.log(e))


CRANK = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [100 mm, 0]}, mass: 1 kg, inertia: 0.2}
  rod: {points: {A: [0, 0], B: [300 mm, 0]}}
  piston: {points: {B: [0, 0]}, mass: 4 kg}
joints:
  O: {type: pin, links: [ground, crank]%s}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [O, B], direction: 0 deg, stops: {from: 250 mm, restitution: 0.5}}
drives: {O: {effort: 6 N*m}}
assembly: {rod: -10 deg}
start: {O: {position: 60 deg, speed: 0}}
"""


def crank_numbers(x: float) -> tuple[float, float, float]:
    """Angle of the crank where the piston is at x, how far it goes with it, and the inertia seen from it."""
    r, rod = 0.1, 0.3
    q = math.acos((x * x + r * r - rod * rod) / (2 * x * r))
    ratio = -r * math.sin(q) * (1 + r * math.cos(q) / (x - r * math.cos(q)))
    return q, ratio, 0.2 + 4 * ratio**2


def test_a_piston_strikes_a_stop_and_rests_on_it() -> None:
    """No drive is at the stop: u+ = -e u- of the piston, J u^2 / 2 = T q before; at rest the stop holds T / (dx/dq)."""
    s = da.simulate(da.loads(CRANK % ""), "3 s")
    q, ratio, inertia = crank_numbers(0.25)
    given = 6 * (q - math.pi / 3)
    hit = s.event("impact")[0]
    assert hit.sentence.startswith("S strikes its stop at 0.25 m with ")
    assert hit.speed == pytest.approx(-ratio * math.sqrt(2 * given / inertia), rel=1e-10)
    assert hit.lost == pytest.approx(given * 0.75, rel=1e-10)
    at = int(np.flatnonzero(s.time == hit.time)[0])
    assert s.speed("O")[at] == pytest.approx(-0.5 * math.sqrt(2 * given / inertia), rel=1e-10)
    assert s.position("O")[-1] == pytest.approx(q, rel=1e-10)
    assert s.joint_stop_force["S"][-1] == pytest.approx(-6 / ratio, rel=1e-10)
    assert s.applied[-1, 0] == s.result.effort("O")[-1] == pytest.approx(6, rel=1e-10)
    assert -s.result.reaction("B")[-1, 0] == pytest.approx(-6 / ratio, rel=1e-10)
    assert "stop_force.S" in [c.name for c in s.columns()]
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_beside_friction_the_stop_gives_what_friction_does_not_hold() -> None:
    """Of the couple T, mu p R are held by the pin in O, R the force there: rod's and weight; the stop has the rest."""
    m = da.loads(CRANK % ", friction: {coefficient: 0.2, radius: 20 mm}")
    s = da.simulate(m.with_values({"joints.S.stops.restitution": 0.0}), "1 s", count=3)
    q, ratio, _ = crank_numbers(0.25)
    force = s.joint_stop_force["S"][-1]
    bearing = math.hypot(force, 9.80665 + force * 0.1 * math.sin(q) / (0.25 - 0.1 * math.cos(q)))
    assert 6 + ratio * force == pytest.approx(0.02 * math.sin(math.atan(0.2)) * bearing, rel=1e-9)
    text = s.event("impact")[0].sentence
    assert "left out" not in text  # of one freedom the restitution alone settles the speeds
    assert s.energy_residual < 1e-9


FIVE_BAR = """
gravity: standard
links:
  ground: {points: {O: [0, 0], E: [0.5, 0]}}
  a: {points: {O: [0, 0], A: [0.3, 0]}, mass: 2 kg, center: 0.15 @ 0, inertia: 0.02}
  b: {points: {A: [0, 0], C: [0.5, 0]}, mass: 1 kg, center: 0.2 @ 10, inertia: 0.03}
  c: {points: {D: [0, 0], C: [0.45, 0]}, mass: 1.5 kg, center: 0.2 @ 0, inertia: 0.02}
  d: {points: {E: [0, 0], D: [0.3, 0]}, mass: 2 kg, center: 0.1 @ 0, inertia: 0.02}
joints:
  O: {type: pin, links: [ground, a]%s}
  A: {type: pin, links: [a, b]}
  C: {type: pin, links: [b, c], stops: {to: 130 deg, restitution: %s}}
  D: {type: pin, links: [d, c]}
  E: {type: pin, links: [ground, d]}
drives: {O: {effort: -1 N*m}, E: {effort: 2 N*m}}
assembly: {b: 50, c: 120}
start: {O: {position: 110 deg, speed: 0}, E: {position: 70 deg, speed: 0}}
"""


def five_bar(q: Any) -> tuple[Any, Any]:
    """Mass centres and angles of the four links, and the angle at C, by two circles."""
    o, e = q
    at_a, at_d = 0.3 * np.exp(1j * o), 0.5 + 0.3 * np.exp(1j * e)
    span = at_d - at_a
    along = (abs(span) ** 2 + 0.5**2 - 0.45**2) / (2 * abs(span))
    at_c = at_a + (along + 1j * math.sqrt(0.25 - along**2)) * span / abs(span)
    b, c = np.angle(at_c - at_a), np.angle(at_c - at_d)
    first, second = 0.15 * np.exp(1j * o), at_a + 0.2 * np.exp(1j * (b + math.radians(10)))
    centers = (first, second, at_d + 0.2 * np.exp(1j * c), 0.5 + 0.1 * np.exp(1j * e))
    return np.array([*np.real(centers), *np.imag(centers), o, b, c, e]), c - b


def test_two_freedoms_change_both_speeds_at_a_joint_without_a_drive() -> None:
    """M (u+ - u-) = n I with the momentum of all links, M and n by differences of the author's own positions."""
    m = da.loads(FIVE_BAR % ("", 0.4))
    s = da.simulate(m, "0.25 s", count=26)
    hit = s.event("impact")[0]
    free = m.with_values({"joints.C.stops": {"to": "350 deg"}})
    before = da.simulate(free, hit.time, count=2)
    at = int(np.flatnonzero(s.time == hit.time)[0])
    q, less = ([x.position(n)[k] for n in ("O", "E")] for x, k in ((s, at), (before, -1)))
    old, new = (np.array([x.speed(n)[k] for n in ("O", "E")]) for x, k in ((before, -1), (s, at)))
    assert q == pytest.approx(less, rel=1e-9)
    assert five_bar(q)[1] == pytest.approx(math.radians(130), rel=1e-9)
    steps = [(five_bar(q + h), five_bar(q - h)) for h in 1e-5 * np.eye(2)]
    rates = np.array([(up[0] - low[0]) / 2e-5 for up, low in steps]).T
    n = np.array([(up[1] - low[1]) / 2e-5 for up, low in steps])
    mass = rates.T @ (np.array([2, 1, 1.5, 2] * 2 + [0.02, 0.03, 0.02, 0.02])[:, None] * rates)
    assert n @ new == pytest.approx(-0.4 * (n @ old), rel=1e-7)
    impulse = mass @ (new - old)
    assert impulse / n == pytest.approx(np.full(2, impulse[0] / n[0]), rel=1e-7)
    assert hit.lost == pytest.approx((old @ mass @ old - new @ mass @ new) / 2, rel=1e-6)
    assert s.energy_residual < 1e-9


def test_while_it_rests_on_the_stop_it_moves_as_if_welded() -> None:
    s = da.simulate(da.loads(FIVE_BAR % ("", 0)), "0.5 s")
    hit, free = s.event("C stays on its stop")[0], s.event("C leaves its stop")[0]
    at, last = (int(np.flatnonzero(s.time == e.time)[0]) for e in (hit, free))
    rigid = da.loads(
        (FIVE_BAR % ("", 0))
        .replace(
            "pin, links: [b, c], stops: {to: 130 deg, restitution: 0}", "weld, links: [b, c], angle: 130 deg"
        )
        .replace(", E: {effort: 2 N*m}}", "}\nloads: {T: {type: couple, on: d, by: ground, value: 2 N*m}}")
        .replace(", E: {position: 70 deg, speed: 0}", "")
    )
    start = {"O": {"position": s.position("O")[at], "speed": s.speed("O")[at]}}
    w = da.simulate(rigid, free.time - hit.time, start=start, count=2)
    assert w.position("O")[-1] == pytest.approx(s.position("O")[last], rel=1e-9)
    assert w.speed("O")[-1] == pytest.approx(s.speed("O")[last], rel=1e-9)
    assert -s.joint_stop_force["C"][at] == pytest.approx(-w.result.reaction_moment("C", on="c")[0], rel=1e-8)
    assert w.result.reaction_moment("C")[-1] == pytest.approx(0, abs=1e-8)
    assert np.linalg.norm(s.result.reaction("A")[at]) == pytest.approx(
        np.linalg.norm(w.result.reaction("A")[0]), rel=1e-8
    )
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_with_friction_and_several_freedoms_what_is_left_out_is_said() -> None:
    s = da.simulate(
        da.loads(FIVE_BAR % (", friction: {coefficient: 0.1, radius: 10 mm}", 0.4)), "0.25 s", count=3
    )
    assert s.event("impact")[0].sentence.endswith("(friction during the impact is left out)")
    stuck = da.simulate(
        da.loads(FIVE_BAR % (", friction: {coefficient: 0.1, radius: 10 mm}", 0)), "0.3 s", count=3
    )
    assert stuck.ended.endswith(
        "C rests on its stop while other freedoms move, with friction: the force of the stop cannot be computed"
    )


TWO_CARTS = """
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, mass: 3 kg}
  two: {points: {O: [0, 0]}, mass: 1 kg}
joints:
  A: {type: slider, links: [ground, one], at: [O, O], direction: 0 deg, stops: {from: 0 m}}
  B: {type: slider, links: [one, two], at: [O, O], direction: 0 deg}
drives: {A: {effort: 0}, B: {effort: 0 N, stops: {from: 0 m, restitution: 0.6}}}
start: {A: {position: %s, speed: %s}, B: {position: 0.1 m, speed: %s}}
"""


@pytest.mark.parametrize(
    ("start", "speed", "lost"),
    [
        (("0 m", "0 m/s", "-4 m/s"), 2.4, (5.12,)),  # one stands at the wall, which takes the impulse
        (("0.1 m", "-1 m/s", "-1 m/s"), 0.6, (2.8, 0.52)),  # wall and cart in one instant
        (("0 m", "-1 m/s", "0 m/s"), 0.6, (1.5, 0.32)),  # begins with an impact
    ],
)
def test_two_stops_at_once_are_not_gone_through(
    start: tuple[str, ...], speed: float, lost: tuple[float, ...]
) -> None:
    s = da.simulate(da.loads(TWO_CARTS % start), "0.15 s", count=4)
    assert [e.lost for e in s.event("impact")] == pytest.approx(lost, rel=1e-9)
    assert s.speed("A")[-1] == pytest.approx(0, abs=1e-12)
    assert s.speed("B")[-1] == pytest.approx(speed, rel=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9


TURNED = """
links:
  ground: {points: {O: [0, 0], P: [150 mm, 0]}}
  a: {points: {O: [0, 0]}, inertia: 0.1}
  b: {points: {P: [0, 0]}, inertia: 0.2}
joints:
  O: {type: pin, links: [ground, a]}
  P: {type: pin, links: [ground, b], stops: STOPS}
  G: {type: gear, links: [a, b], at: [O, P], radii: [50 mm, 100 mm]}
drives: {O: {effort: 0}}
start: {O: {position: 0, speed: SPEED rad/s}}
"""


def test_the_angle_of_a_joint_counts_whole_turns() -> None:
    """A wheel of half the speed, backwards: three turns after six of the other, and a half of the speed after."""
    stops = "{from: -1080 deg, to: 720 deg, restitution: 0.5}"
    s = da.simulate(
        da.loads(TURNED.replace("STOPS", stops).replace("SPEED", "10")),
        "5 s",
        count=3,
    )
    assert s.event("P strikes its stop at -18.8496 rad")[0].time == pytest.approx(1.2 * math.pi, rel=1e-12)
    assert s.position("O")[-1] == pytest.approx(12 * math.pi - 5 * (5 - 1.2 * math.pi), rel=1e-12)


def test_a_rocker_in_space_rests_on_its_stop_by_virtual_work() -> None:
    """The rod of the bundled RSSR keeps its length: dC/dO, and the stop of C holds the couple at O with the inverse."""
    m = da.load(examples()["rssr"]).with_values(
        {"gravity": None, "drives.O.speed": 0.0, "drives.O.position": 0.35}
    )
    ends = {"from": "-35 deg", "to": "10 deg"}
    tree = m.with_values({"joints.C.stops": ends}).to_tree()
    tree = {k: v for k, v in tree.items() if k not in ("answers", "loads")}
    tree |= {"drives": {"O": {"effort": "0.4 N*m"}}, "start": {"O": {"position": "20 deg", "speed": 0}}}
    s = da.simulate(da.mechanism(tree), "1 s", count=11)
    assert s.ended.startswith("at rest")
    q, turn = s.position("O")[-1], math.radians(-35)
    a, along = 40 * np.array([math.cos(q), math.sin(q), 0]), 40 * np.array([-math.sin(q), math.cos(q), 0])
    b = np.array([0, 150 - 90 * math.sin(turn), 90 * math.cos(turn)])
    up = 90 * np.array([0, -math.cos(turn), -math.sin(turn)])
    assert np.linalg.norm(a - b) == pytest.approx(math.hypot(40, 150, 90), rel=1e-9)
    assert s.joint_stop_force["C"][-1] == pytest.approx(-0.4 * ((a - b) @ up) / ((a - b) @ along), rel=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9


ONE = """
links:
  ground: {points: {O: [0, 0]}}
  a: {points: {O: [0, 0]}, inertia: 0.1}
joints:
  O: {type: pin, links: [ground, a]%s}
drives: {O: {%s}}
start: {O: {position: 0, speed: 0}}
"""


def test_a_motor_with_a_brake_rests_on_a_stop() -> None:
    """Of the stall torque 4 N m the brake holds 1 N m, the stop 3 N m."""
    drive = "motor: {stall: 4 N*m, no_load: 30 rad/s}, brake: 1 N*m"
    s = da.simulate(da.loads(ONE % (", stops: {to: 90 deg, restitution: 0.3}", drive)), "2 s", count=5)
    assert s.stop_force[-1, 0] == pytest.approx(-3)
    assert s.applied[-1, 0] == pytest.approx(0)
    assert max(s.energy_residual, s.law_residual) < 1e-9


@pytest.mark.parametrize(
    ("joint", "drive", "sentence"),
    [
        (
            ", stops: {to: 9 deg}",
            "effort: 0, stops: {to: 9 deg}",
            "text:6: joint 'O' and its drive have stops",
        ),
        (
            ", stops: {from: 9 deg, to: -9 deg}",
            "effort: 0",
            "text:6: from of stops of joint 'O': the stops go from",
        ),
        (", stops: {to: 9 mm}", "effort: 0", "text:6: to of stops of joint 'O': '9 mm' is a length"),
        (
            ", stops: {to: -9 deg}",
            "effort: 0",
            "text:8: O starts beyond its stops, at 0 deg; start between them",
        ),
    ],
)
def test_wrong_stops_say_so_at_their_line(joint: str, drive: str, sentence: str) -> None:
    with pytest.raises(ModelError) as raised:
        da.simulate(da.loads(ONE % (joint, drive)), "1 s")
    assert str(raised.value).startswith(sentence)


def test_a_prescribed_drive_has_no_stops() -> None:
    text = (ONE % ("", "position: 0, speed: 1 rad/s, stops: {to: 9 deg}")).replace("start: {O:", "start: {P:")
    text = text.replace(
        "O: {type: pin, links: [ground, a]}",
        "O: {type: pin, links: [ground, a]}\n  P: {type: pin, links: [a, b], at: O}",
    )
    text = text.replace("\njoints:", "\n  b: {points: {O: [0, 0]}, inertia: 0.1}\njoints:").replace(
        "drives: {", "drives: {P: {effort: 0}, "
    )
    with pytest.raises(
        ModelError, match=r"text:\d+: drive 'O' is prescribed, and its stops would be gone through"
    ):
        da.simulate(da.loads(text), "1 s")


@pytest.mark.parametrize(
    ("stops", "speed", "turn", "end"),
    [
        ("{to: -100 deg, restitution: 0.5}", -10, 260, -100),  # it stands at -360 deg
        ("{from: 100 deg, restitution: 0.5}", 10, -260, 100),  # at 360 deg
        ("{from: 100 deg, to: 500 deg, restitution: 0.5}", -10, 140, 500),
        ("{from: -500 deg, to: -100 deg, restitution: 0.5}", 10, -140, -500),
        ("{from: 900 deg, to: 1100 deg, restitution: 0.5}", -10, 20, 1100),  # at 1080 deg
    ],
)
def test_a_joint_starts_as_many_turns_away_as_lie_between_its_stops(
    stops: str, speed: float, turn: float, end: float
) -> None:
    """The wheel b turns with half the speed of a, the other way, until it has come from a full turn to its stop."""
    s = da.simulate(da.loads(TURNED.replace("STOPS", stops).replace("SPEED", str(speed))), "1.2 s", count=3)
    hit = s.event("impact")[0]
    assert hit.time == pytest.approx(math.radians(turn) / (-speed / 2), rel=1e-12)
    assert hit.sentence.startswith(f"P strikes its stop at {math.radians(end):.6g} rad with 5 rad/s")


def test_a_joint_that_no_turn_brings_between_its_stops_is_refused() -> None:
    text = TURNED.replace("STOPS", "{from: 100 deg, to: 200 deg}").replace("SPEED", "1")
    with pytest.raises(ModelError) as refused:
        da.simulate(da.loads(text), "1 s")
    assert str(refused.value) == "text:8: P starts beyond its stops, at 0 deg; start between them"
