"""Problems of machine design (machine_cases.json), each through a model and the calls that a user would make.

A call gives the quantities of its problem in their order and units, `None` for one that waits for a machine element.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import dalembert as da
from dalembert.bundled import cases
from tests.machine.test_balance import FOUR_BAR
from tests.machine.test_bearings import shaft
from tests.machine.test_flywheel import shaft as turned_by
from tests.machine.test_gyroscopes import BEARINGS, HINGE, rotor
from tests.machine.test_members import ARM
from tests.machine.test_simulate import rotor as free_rotor

MODELS = sorted((Path(__file__).parent / "models").glob("*.yaml"))
POUND, INCH, FOOT = 0.45359237, 0.0254, 0.3048
RPM, HP = math.pi / 30, 550 * POUND * 9.80665 * FOOT


def case(problem: str, **values: Any) -> Any:
    """The file of a problem, bundled or beside the tests, values replaced (__ for the dots of a path)."""
    files = [*MODELS, *cases().values()]
    m = da.load(next(file for file in files if file.stem.startswith(problem.lower() + "-")))
    return m.with_values({path.replace("__", "."): value for path, value in values.items()}) if values else m


def harmonic(r: Any, series: Any, orders: int = 4) -> Any:
    return da.harmonics(series, r.drive_position(r.drives[0]), orders)


# balancing


def cylinder() -> list[Any]:
    """The mass that balances what turns and two thirds of what goes to and fro; the force that is left."""
    m = case("BAL-1")
    turning = {"links.balance.mass": 0.0, "links.crosshead.mass": 0.0, "links.pin.mass": 70 + 120 * 2 / 3}
    b = da.balance(m.with_values(turning), {"crank": {"radius": 0.15}}, positions=8)
    return [b.placed["crank"].mass, np.hypot(*da.shaking(da.dynamics(m)).force[0])]


WHEEL = """
links:
  ground: {points: {O: [0, 0]}}
  wheel: {points: {O: [0, 0]}, mass: 69.625, center: [1, 0]}
joints: {O: {type: pin, links: [ground, wheel]}}
drives: {O: {position: {from: 0, to: 360, count: 72}, speed: 29.411764705882355 rad/s}}
"""


def locomotive() -> list[Any]:
    blow = np.abs(da.shaking(da.dynamics(da.loads(WHEEL))).force[:, 1]).max()
    part = 40e3 / blow
    left = 300 * (1 - part)
    s = da.shaking(da.dynamics(case("BAL-3", links__left__mass=left, links__right__mass=left)))
    return [part, np.abs(s.force[:, 0]).max(), np.abs(s.couple[:, 1]).max()]


def four_cranks() -> list[Any]:
    """The last step: two masses as far apart as the resultant arm says, on opposite cranks."""
    arm, points = 1.2727922061357857, "links.axle.points."
    sides = {"links.left.mass": 900.0, "links.right.mass": 900.0, "drives.O.speed": 90 * RPM}
    places = {"links.left.place": arm / 2, "links.right.place": -arm / 2}
    throws = {points + "A": [0.45, 0], points + "B": [-0.45, 0]}
    s = da.shaking(da.dynamics(case("BAL-3").with_values(sides | places | throws)))
    return [np.abs(s.couple[:, 1]).max() / 1e3]


def radial() -> list[Any]:
    r = da.dynamics(da.radial_engine(cylinders=3, crank=0.06, rod=0.24, piston_mass=1.0, speed=80 * math.pi))
    s, book = da.shaking(r), harmonic(r, da.engine_series(r).force)
    exact = s.harmonics(4)
    one, two = [abs(h.forward[1]) for h in (book, exact)], [abs(h.backward[2]) for h in (book, exact)]
    return [*one, *two, np.hypot(*s.force.T).max()]


def four_bar() -> list[Any]:
    return list(da.balance(da.loads(FOUR_BAR), ["crank", "rocker"]).numbers[:, 1:3].ravel())


def v_twin() -> list[Any]:
    b = da.balance(da.v_engine(crank=0.03, rod=0.03 / 0.28, piston_mass=0.5, speed=200 * math.pi), ["crank"])
    book = harmonic(b.after.result, da.engine_series(b.after.result).force, 2)
    left = harmonic(b.after.result, b.after.force, 2)
    assert left.amplitude[1].max() < 1e-8
    return [b.placed["crank"].moment, book.amplitude[2].max(), left.amplitude[2].max()]


def one_plane() -> list[Any]:
    found = da.balance(case("BA-01"), {"shaft": {"radius": 0.1}}).placed["shaft"]
    return [found.mass, math.degrees(found.angle) % 360]


def one_plane_in_inches() -> list[Any]:
    found = da.balance(case("BA-03"), {"shaft": {"radius": 24 * INCH}}).placed["shaft"]
    return [found.mass / POUND * 386.4 / (9.80665 / INCH), math.degrees(found.angle) % 360 - 180]


def half_balanced() -> list[Any]:
    """What turns and half of what goes to and fro, 180 + 75 lb; then the force that is left all the way round."""
    m = case(
        "BA-04",
        links__balance__weight="0 lbf",
        links__crosshead__weight="0 lbf",
        links__pin__weight="255 lbf",
    )
    b = da.balance(m.with_values({"drives.O.position": 0.0}), {"crank": {"radius": 6 * INCH}}, positions=8)
    weight = b.placed["crank"].mass / POUND * 386.4 / (9.80665 / INCH)
    force = np.hypot(*da.shaking(da.dynamics(case("BA-04"))).force.T) / (POUND * 9.80665)
    assert force == pytest.approx(np.full(3, force[0]), rel=1e-12)
    return [weight, force[0]]


def two_corrections() -> list[Any]:
    """The place of plane D at which the mass in A stands at 190 deg from B; the angles count from there."""
    m = case("BA-08")

    def corrected(place: float) -> Any:
        return da.balance_rotor(m, (0.0, place), (0.08, 0.08))

    place = brentq(lambda z: math.degrees(corrected(z).angle[0]) % 360 - 190, 0.2, 0.6, xtol=1e-14)
    b = corrected(place)
    return [*b.masses, math.degrees(b.angle[1]) % 360, 1e3 * place]


def broad_arrow() -> list[Any]:
    """Twelve cylinders, four throws in one plane, three lines 60 deg apart: the book's secondary force."""
    links, joints, assembly, throws = (
        [],
        [],
        [],
        {"A": "[3, 0]", "B": "[-3, 0]", "C": "[-3, 0]", "D": "[3, 0]"},
    )
    mass = 6 * POUND * 9.80665 / (32.2 * FOOT)
    for line in (-60, 0, 60):
        for throw in throws:
            name = f"{throw}{line}".replace("-", "m")
            links.append(f"  rod_{name}: {{points: {{{throw}: [0, 0], P: [11, 0]}}}}")
            links.append(f"  piston_{name}: {{points: {{P: [0, 0]}}, mass: {mass!r}}}")
            joints.append(f"  big_{name}: {{type: pin, links: [crank, rod_{name}], at: {throw}}}")
            joints.append(f"  small_{name}: {{type: pin, links: [rod_{name}, piston_{name}], at: P}}")
            joints.append(
                f"  in_{name}: {{type: slider, links: [ground, piston_{name}], at: [O, P], direction: {line}}}"
            )
            assembly.append(f"  rod_{name}: {line}")
    points = ", ".join(f"{name}: {at}" for name, at in throws.items())
    text = "\n".join([
        "units: {length: in}", "links:", "  ground: {points: {O: [0, 0]}}",
        f"  crank: {{points: {{O: [0, 0], {points}}}}}",
        *links, "joints:", "  O: {type: pin, links: [ground, crank]}", *joints,
        "drives: {O: {position: {from: 0, to: 360, count: 24}, speed: 2000 rpm}}", "assembly:", *assembly,
    ])  # fmt: skip
    r = da.dynamics(da.loads(text))
    return list(np.sort(harmonic(r, da.engine_series(r).force, 2).amplitude[2]) / (POUND * 9.80665))


def across_the_stroke() -> list[Any]:
    return [abs(da.shaking(da.dynamics(case("BA-07"))).force[0, 1])]


# flywheels


def double_acting() -> list[Any]:
    f = da.flywheel(da.dynamics(case("FW-04")), Cs=0.015)
    return [
        100 * f.coefficient_of_energy,
        f.size.mass(1.75),
        math.degrees(f.slowest),
        math.degrees(f.fastest),
    ]


def gas_engine() -> list[Any]:
    """Expansion three times the work of compression; the book takes what stands above the mean in the expansion."""
    work = 20e3 / (300 / 60) * 2  # a cycle, of two turns
    peak, low = 2 * 1.5 * work / math.pi, 2 * 0.5 * work / math.pi
    table = f"{{against: O, periodic: 720 deg, x: [0, 90, 180, 540, 630, 720], y: [0, {peak!r}, 0, 0, {-low!r}, 0]}}"
    f = da.flywheel(turned_by(table, 300, 720), Cs=0.04)
    return [da.flywheel_size(max(abs(p) for p in f.size.pulses), 300 * RPM, Cs=0.04).inertia]


def harmonic_engine() -> list[Any]:
    """Against a constant load, and against the varying one of the file."""
    results = (turned_by("5000 + 1500*sin(3*O)", 300), da.dynamics(case("FW-08")))
    found = [da.flywheel(r, inertia=1000.0) for r in results]
    power = -found[0].mean * 300 * RPM / 1e3
    return [power, 100 * found[0].size.fluctuation, found[1].size.energy, 100 * found[1].size.fluctuation]


def speed_limits() -> list[Any]:
    return sorted(
        (w / RPM for w in da.flywheel_size(56e3, 120 * RPM, inertia=6500 * 1.8**2).limits), reverse=True
    )


def areas() -> list[Any]:
    pulses = [31.416 * a for a in (52, -124, 92, -140, 85, -72, 107)]
    size = da.flywheel_size(pulses, 600 * RPM, Cs=0.03)
    return [size.energy, size.mass(0.5)]


def pulses() -> list[Any]:
    size = da.flywheel_size([200.73, -261.05, 153.88, -92.02], 50, Cs=0.05)
    return [size.energy, size.inertia]


# motion under forces


def flywheel_from_rest() -> list[Any]:
    s = da.simulate(
        free_rotor(2500, "drives: {O: {effort: 1500 N*m}}\nstart: {O: {position: 0, speed: 0}}"),
        "10 s",
        count=3,
    )
    assert s.works["O"][-1] == pytest.approx(s.kinetic[-1], rel=1e-10)
    return [s.acceleration("O")[-1], s.kinetic[-1] / 1e3]


def run_up() -> list[Any]:
    m = free_rotor(
        0.8, "drives: {O: {motor: {stall: 40 N*m, no_load: 150 rad/s}}}\nstart: {O: {position: 0}}"
    )
    s = da.simulate(m, "2 s", count=3)
    return [s.speed("O")[-1], s.position("O")[-1], da.simulate(m, "O.speed = 142.5 rad/s", count=3).time[-1]]


PENDULUM = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  bar: {points: {O: [0, 0], A: [1, 0]}, mass: 2 kg, shape: {type: bar, between: [O, A]}}
joints: {O: {type: pin, links: [ground, bar]}}
drives: {O: {effort: 0}}
start: {O: {position: 30 deg, speed: 0}}
"""


def pendulum() -> list[Any]:
    """Released 120 deg from hanging."""
    s = da.simulate(da.loads(PENDULUM), ["5 s", "O.speed = 0 rad/s"], events=["O.position = -90 deg"])
    k = int(np.argmin(np.abs(s.time - s.event("condition")[0].time)))
    force = np.linalg.norm(s.result.reaction("O")[k])
    return [2 * s.time[-1], abs(s.speed("O")[k]), force / (2 * 9.80665)]


BLOCK = """
gravity: standard
links:
  ground: {points: {O: [0, 0], W: [-10, 0]}}
  block: {points: {O: [0, 0]}, mass: %g kg}
joints: {S: {type: slider, links: [ground, block], at: [O, O], direction: 0 deg, %s}}
drives: {S: {effort: 0}}
start: {S: {position: %g m, speed: 0}}
loads: {spring: {type: spring, between: [ground.W, block.O], stiffness: %g N/m, free_length: 10 m}}
"""


def rubbing_block() -> list[Any]:
    s = da.simulate(da.loads(BLOCK % (2, "friction: {coefficient: 0.3}", 0.1, 800)), "2 s")
    (rest,) = s.event("rest")
    swings = len(s.event("reversal")) + 1
    return [swings, rest.time, s.position("S")[-1], -s.works["friction"][-1]]


DOUBLE_FOUR_BAR = """
gravity: [0, -9.81]
links:
  ground: {points: {A: [0, 0], B: [1, 0], C: [2, 0]}}
  one:   {points: {A: [0, 0], D: [1, 0]}, mass: 1, shape: {type: bar, between: [A, D]}}
  two:   {points: {B: [0, 0], E: [1, 0]}, mass: 1, shape: {type: bar, between: [B, E]}}
  three: {points: {C: [0, 0], F: [1, 0]}, mass: 1, shape: {type: bar, between: [C, F]}}
  bars:  {points: {D: [0, 0], E: [1, 0], F: [2, 0]}, mass: 2, shape: {type: bar, between: [D, F]}}
  level: {points: {G: [0, 0]}}
joints:
  A: {type: pin, links: [ground, one]}
  B: {type: pin, links: [ground, two]}
  C: {type: pin, links: [ground, three]}
  D: {type: pin, links: [one, bars]}
  E: {type: slot, links: [two, bars], direction: 0}
  F: {type: slot, links: [three, bars], direction: 0}
  G: {type: slider, links: [ground, level], at: [A, G], direction: 0}
  H: {type: slider, links: [level, bars], at: [G, D], direction: 90, angle: -90}
drives: {A: {effort: 0}}
start: {A: {position: 90 deg, speed: -1 rad/s}}
assembly: {one: 90, two: 90, three: 90, bars: 0}
"""
"""The double four-bar, its bars kept level by slides, so that it passes the positions where all bars are in line."""


def double_four_bar() -> list[Any]:
    s = da.simulate(da.loads(DOUBLE_FOUR_BAR), "10 s", count=2)
    assert s.energy_residual < 1e-9
    return [*s.result.point("one", "D")[-1], *s.result.point_velocity("one", "D")[-1]]


def damped_block() -> list[Any]:
    s = da.simulate(da.loads(BLOCK % (1, "damping: 3 N*s/m", 0.02, 225)), "0.5 s", events=["S.speed = 0 m/s"])
    return [s.position("S")[-1], s.position("S").min()]


YOKE = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [%.17g, 0]}, mass: 1 kg, inertia: 0.05 kg*m^2}
  yoke: {points: {S: [0, 0]}, mass: 3 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  slot: {type: slot, links: [yoke, crank], at: [S, A], direction: 90}
  guide: {type: slider, links: [ground, yoke], at: [O, S], direction: 0}
drives: {O: %s}
%s
"""


def free_yoke() -> list[Any]:
    m = da.loads(YOKE % (0.08, "{effort: 0}", "start: {O: {position: 0, speed: 20 rad/s}}"))
    marks = ["O.position = 90 deg", "O.position = 45 deg"]
    s = da.simulate(m, ["1 s", "O.position = 360 deg"], events=marks)
    at = {e.sentence: int(np.argmin(np.abs(s.time - e.time))) for e in s.events}
    return [*(s.speed("O")[at[mark]] for mark in marks), s.time[-1]]


CLUTCH = """
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, mass: 1 kg, inertia: 2 kg*m^2}
  two: {points: {O: [0, 0]}, mass: 1 kg, inertia: 3 kg*m^2}
joints:
  O: {type: pin, links: [ground, one]}
  C: {type: pin, links: [one, two], at: O}
drives: {O: {effort: 0}, C: {effort: 0, brake: 60 N*m}}
start: {O: {position: 0, speed: 100 rad/s}, C: {position: 0, speed: -100 rad/s}}
"""


def clutch() -> list[Any]:
    s = da.simulate(da.loads(CLUTCH), "3 s")
    (rest,) = [e for e in s.events if e.name == "rest"]
    assert s.result.effort("C")[50] == pytest.approx(60.0)
    assert abs(s.result.effort("C")[-1]) < 1e-9
    return [s.speed("O")[-1], rest.time, -s.works["brakes"][-1]]


# cams, as linkages that move in the same way


def arc_cam() -> list[Any]:
    """A flat face on an arc moves as a yoke on a crank from the cam's centre to the arc's: nose, then flank."""
    speed = 1200 * RPM

    def stroke(throw: float) -> Any:
        position = f"{{position: {{from: 0, to: 360, count: 8}}, speed: {speed!r} rad/s}}"
        return da.dynamics(da.loads(YOKE % (throw * INCH, position, "")))

    nose, flank = stroke(1.5), stroke(4.475944094820338)
    slide = [r.freedom("guide", "slide") for r in (nose, flank)]
    return [
        None,
        np.abs(slide[0][1]).max() / FOOT,
        np.abs(slide[0][2]).max() / FOOT,
        abs(slide[1][2][0]) / FOOT,
        None,
    ]


LIFT = """
links:
  ground: {points: {O: [0, 0]}}
  follower: {points: {O: [0, 0]}, mass: 1}
joints: {F: {type: slider, links: [ground, follower], at: O, direction: 90}}
drives: {F: {law: {type: %s, from: 0 m, to: %g m, duration: %.17g s, count: 721}}}
"""


def peaks(law: str, rise: float = 1.0, duration: float = 1.0) -> list[float]:
    """Greatest speed and acceleration: of three instants about the largest sample the parabola's top."""
    r = da.dynamics(da.loads(LIFT % (law, rise, duration)))
    found = []
    for y in (np.abs(r.drive_speed("F")), np.abs(r.drive_acceleration("F"))):
        k = min(max(int(np.argmax(y)), 1), len(y) - 2)
        a, b, c = y[k - 1 : k + 2]
        bend = a - 2 * b + c
        top = b - (c - a) ** 2 / (8 * bend) if abs(c - a) < abs(bend) * 2 else max(a, c)
        found.append(float(top))
    return found


def valve() -> list[Any]:
    """A third and a sixth of a turn at 100 rpm."""
    up, down = (peaks("harmonic", 0.05, part * 0.6) for part in (1 / 3, 1 / 6))
    return [up[0], down[0], up[1], down[1]]


def rise_laws() -> list[Any]:
    three, cycloid, wave = (peaks(law) for law in ("polynomial345", "cycloidal", "harmonic"))
    return [*three, None, None, *cycloid, *wave, None, None, None, None]


def eccentric_disc() -> list[Any]:
    def pressed(speed: float) -> Any:
        m = case("CAM-4", drives__O__speed=speed)
        return da.dynamics(m).reaction("contact", on="follower")[:, 1]

    low, top = pressed(100.0)
    return [brentq(lambda w: pressed(w)[1], 50.0, 200.0, xtol=1e-12, rtol=1e-14), top, low]


# governors


def porter() -> list[Any]:
    """The speed at which the arm needs no effort, which goes with its square; and the place at that speed."""

    def speed(radius: float) -> float:
        angle = math.asin(radius / 12)
        still, turning = (
            da.dynamics(
                case("GOV-1", drives__turn__speed=w).with_values(
                    {"drives.O": {"position": angle, "speed": 0.0}}
                )
            ).effort("O")[0]
            for w in (0.0, 1.0)
        )
        return math.sqrt(still / (still - turning)) / RPM

    r = da.dynamics(case("GOV-1"))
    assert r.point("upper", "B")[0, 0] == pytest.approx(8 * INCH, rel=1e-8)
    return [speed(8), speed(10)]


LEVERS = """
units: {length: in, force: lbf, mass: lb, time: s, angle: deg}
links:
  ground: {points: {P: [0, 0], B: [5, %(long)g], S: [-2, -5]}}
  lever:  {points: {P: [0, 0]}}
  ball:   {points: {B: [0, 0]}}
  sleeve: {points: {S: [0, 0]}}
joints:
  P: {type: pin, links: [ground, lever]}
  ball_arm: {type: rolling, links: [ball, lever], at: [B, P], direction: 180, radius: %(long)g}
  sleeve_arm: {type: rolling, links: [sleeve, lever], at: [S, P], direction: -90, radius: 2}
  radius: {type: slot, links: [ground, ball], at: [B, B], direction: 0}
  lift: {type: slot, links: [ground, sleeve], at: [S, S], direction: 90}
drives: {radius: {freedom: slide, position: %(out)g, effort: 0}}
loads:
  turning: {type: force, on: ball, at: B, direction: 0, value: %(mass).17g*%(speed).17g^2*(%(least)g*0.0254 + radius) N}
  leaning: {type: couple, on: lever, value: %(lean).17g*radius N*m}
  spring: {type: force, on: sleeve, at: S, direction: -90, value: unknown}
assembly: {lever: 0, ball: [5, %(long)g, 0], sleeve: [-2, -5, 0]}
"""
"""Half a spring governor whose arms stay right-angled: racks on a wheel. Loads go by the ball's slide."""


def sleeve_force(out: float, rpm: float, **more: float) -> float:
    """lbf on the sleeve by half the governor, the ball that far out of its least radius."""
    given = {"long": 4.0, "mass": 3 * POUND * 9.80665 / (32.2 * FOOT), "least": 3.0, "lean": 0.0} | more
    r = da.statics(da.loads(LEVERS % (given | {"out": out, "speed": rpm * RPM})))
    return float(r.unknown_load("spring")[0]) / (POUND * 9.80665)


def hartnell() -> list[Any]:
    low, high, unit = sleeve_force(0, 300), sleeve_force(1.5, 318), sleeve_force(0.5, 1)
    rate = 2 * (high - low) / 0.75
    return [math.sqrt((low + rate / 2 * 0.25) / unit), rate]


def heavy_balls() -> list[Any]:
    """The balls' weight pulls them in as they lean out; 0.5 in of lift are 1.125 in of radius."""
    more = {"long": 4.5, "least": 2.5, "lean": 3 * POUND * 9.80665}
    low, high = sleeve_force(0, 240, **more), sleeve_force(1.125, 252, **more)
    return [2 * (high - low) / 0.5]


# gyroscopes


def disc_on_an_arm() -> list[Any]:
    """The precession at which the pivot has no moment across the arm: that goes by its first power."""
    inertia = 5 * 0.15**2 / 2
    still, turning = (
        rotor([0, 0, -9.81], (0.6, 0.6), 5, inertia, "[0, 0, 1]", w, 300 * RPM).reaction_moment("O")[0, 1]
        for w in (0.0, 1.0)
    )
    return [abs(still / (still - turning))]


def disc_in_bearings() -> list[Any]:
    r = rotor([0, 0, -9.81], (-0.05, 0.05), 5, 5 * 0.075**2 / 2, "[0, 0, 1]", 60 * RPM, 1000 * RPM, BEARINGS)
    pair = da.gyroscopic(r, "rotor", "yoke").bearing_force(0.1)[0]
    down, up = sorted(float(r.reaction(joint, on="rotor")[0, 2]) for joint in "AB")
    assert pair == pytest.approx((up - down) / 2, rel=1e-8)
    return [up, -down]


def ship() -> list[Any]:
    inertia, spin = 3500 * 0.45**2, 3000 * RPM
    steering = rotor("none", (0, 0), 3500, inertia, "[0, 0, 1]", 0.1, spin)
    w, most, t = 2 * math.pi / 40, math.radians(6), np.linspace(0, 40, 41)
    motion = [(most * w**k * np.sin(w * t + k * math.pi / 2)).tolist() for k in range(3)]
    pitching = rotor("none", (0, 0), 3500, inertia, "[0, 1, 0]", motion[1], spin, HINGE, motion[0], motion[2])
    return [
        np.linalg.norm(da.gyroscopic(r, "rotor", "yoke").couple, axis=1).max() / 1e3
        for r in (steering, pitching)
    ]


# brakes, clutches, friction

CAR = """
units: {length: ft, force: lbf, mass: lb, time: s, angle: deg}
gravity: [0, -32.2 ft/s^2]
links:
  ground: {points: {O: [0, 0]}}
  car: {points: {rear: [0, 0], front: [9.5, 0]}, mass: 3000, center: [4, 2], inertia: 40000}
joints:
  rear: {type: slot, links: [ground, car], at: [O, rear], direction: 0, friction: {coefficient: %g}}
  front: {type: slot, links: [ground, car], at: [O, front], direction: 0, friction: {coefficient: %g}}
drives: {rear: {freedom: slide, effort: 0}}
start: {rear: {position: 0, speed: 44 ft/s}}
"""


def braked_car() -> list[Any]:
    """Wheels that do not turn rub; the others roll without friction."""
    return [
        da.simulate(da.loads(CAR % (mu * rear, mu * front)), "rear.speed = 0 ft/s", count=3).position("rear")[
            -1
        ]
        / FOOT
        for mu in (0.1, 0.6)
        for rear, front in ((1, 0), (0, 1), (1, 1))
    ]


def lowering_brake() -> list[Any]:
    """The weight that 1000 N on the shoe hold; the speed of lowering with 2 m/s at the rim."""
    r = da.dynamics(case("BRK-8").with_values({"loads.push.value": [1000.0, 0.0]}))
    held, rim = r.unknown_load("weight")[0], abs(r.freedom("rim", "slide")[1][0])
    return [500 * 9.81 * 1000 / held, 0.375 * 2 / rim]


def collar() -> list[Any]:
    return [da.dynamics(case("CLU-1")).power_lost("O")[0] / HP]


def discs() -> list[Any]:
    r = da.dynamics(case("CLU-3"))
    return [abs(r.reaction("O")[0, 2]), r.effort("O")[0], r.power_lost("O")[0] / 1e3]


def centrifugal_clutch() -> list[Any]:
    """Both the spring and what presses go by the mass."""
    torque = da.dynamics(case("CLU-4", parameters__shoe_mass="1 kg")).effort("O")[0]
    return [20e3 / (750 * RPM) / (4 * torque)]


def eccentric() -> list[Any]:
    m, ton = case("FRI-1"), 2240 * POUND * 9.80665 * FOOT
    r = da.dynamics(m)
    bare = da.dynamics(m.with_values({"friction.enabled": False}))
    return [
        -bare.effort("O")[0] / ton,
        -r.effort("O")[0] / ton,
        100 * da.efficiency(r).reverse[0],
    ]


# rods and the two masses that move like them

ROD = """
gravity: [0, -9.81]
links:
  ground: {points: {A: [0, 0], B: [%.17g, 0]}}
  rod: {points: {A: [0, 0], B: [%.17g, 0]}, mass: %.17g, center: [%.17g, 0], inertia: %.17g}
joints:
  A: {type: pin, links: [ground, rod]}
%s
"""


def two_masses(mass: float, inertia: float, arm: float) -> list[float]:
    """The other arm, and the masses, the first at the arm given: centre of percussion, and a rod on two supports."""
    text = ROD % (
        1.0,
        1.0,
        mass,
        arm,
        inertia,
        "drives: {A: {position: 0, speed: 0 rad/s, acceleration: 1 rad/s^2}}",
    )
    r = da.dynamics(da.loads(text).with_values({"gravity": None}))
    other = r.effort("A")[0] / np.hypot(*r.reaction("A")[0]) - arm
    support = "  B: {type: slot, links: [ground, rod], direction: 0}"
    lying = da.statics(da.loads(ROD % (arm + other, arm + other, mass, arm, inertia, support)))
    return [other, *(np.hypot(*lying.reaction(joint)[0]) / 9.81 for joint in "AB")]


def swinging(mass: float, inertia: float, arm: float) -> float:
    """Period of a small swing."""
    start = "drives: {A: {effort: 0}}\nstart: {A: {position: -1.5707 rad, speed: 0}}"
    s = da.simulate(da.loads(ROD % (1.0, 1.0, mass, arm, inertia, start)), "A.speed = 0 rad/s", count=2)
    return float(2 * s.time[-1])


def known_rod() -> list[Any]:
    other, *masses = two_masses(15, 0.007, 0.2)
    return [1e3 * other, *masses]


def rod_found_by_a_swing() -> list[Any]:
    inertia = brentq(lambda i: swinging(37.5, i, 0.65) - 1.87, 3.0, 9.0, xtol=1e-10)
    return two_masses(37.5, inertia, 0.625)


def rod_found_by_two_swings() -> list[Any]:
    """Swung from its bores, 0.9375 m apart at their far sides; one mass in the middle of the small bore."""
    far = 0.85 + 0.075 / 2 + 0.1 / 2

    def inertia(arm: float, period: float) -> float:
        return brentq(lambda i: swinging(55, i, arm) - period, 0.5, 15.0, xtol=1e-10)

    arm = brentq(lambda a: inertia(a, 1.83) - inertia(far - a, 1.68), 0.6, 0.7, xtol=1e-11)
    own = inertia(arm, 1.83)
    return [math.sqrt(own / 55), own, *two_masses(55, own, arm - 0.075 / 2)[1:]]


# members and bearings


def falling_rod() -> list[Any]:
    """Released at 0.7 rad from the vertical; the motion's first instant, prescribed, has the forces inside."""
    angle, weight = 0.7, 2 * 9.80665
    start = {"O": {"position": math.pi / 2 - angle, "speed": 0.0}}
    m = da.loads(ARM).with_values({"gravity": "standard"})
    s = da.simulate(m.with_values({"start": start, "drives.O": {"effort": 0.0}}), "1 ms", count=2)
    first = {key: float(getattr(s, key)("O")[0]) for key in ("position", "speed", "acceleration")}
    r = da.dynamics(m.with_values({"drives.O": first}))
    assert abs(r.effort("O")[0]) < 1e-12
    value, _, place, _ = da.member_forces(r, "arm").largest("bending")
    return [place / 0.6, abs(value) / (weight * 0.6 * math.sin(angle))]


def turning_arm() -> list[Any]:
    f = da.member_forces(da.dynamics(da.loads(ARM)), "arm")
    root = f.at(0.0)
    stress = f.stress()
    assert (stress.place[0], stress.safety) == pytest.approx((0, 250 / 30))
    return [
        root["axial"],
        f.at(0.3)["axial"],
        abs(root["bending"]),
        abs(root["shear"]),
        stress.largest / 1e6,
    ]


def ball_bearing() -> list[Any]:
    b = da.bearing(shaft("1898"), "O")
    turns = 30_000 * 3600 * b.speed / (2 * math.pi) / 1e6
    return [
        turns,
        b.rating_for(30_000, 1.2, 0.9, (0.02, 4.439, 1.483)) / 1e3,
        b.rating_for(30_000, 1.2) / 1e3,
    ]


def roller_bearing() -> list[Any]:
    b = da.bearing(shaft(f"{1650 * POUND * 9.80665!r}", "{rating: 12 kN, kind: roller}"), "O")
    return [b.rating_for(1440e6 / 300 / 60, 1.4) / 1e3]


def pulsing_load() -> list[Any]:
    bearings = (f"{{rating: 12 kN, kind: {kind}}}" for kind in ("ball", "roller"))
    ball, roller = (da.bearing(shaft("1000 + 500*cos(O)", bearing), "O") for bearing in bearings)
    rule = (ball.radial.min() + 2 * ball.radial.max()) / 3
    return [ball.equivalent, roller.equivalent, ball.turns / 1e6, rule]


# gears


def reverted_train() -> list[Any]:
    r = da.dynamics(case("GTR-1"))
    ratio = r.speed("arm")[0] / r.speed("wheel_D")[0]
    return [ratio, r.unknown_load("load")[0], r.effort("E")[0]]


def compound_train() -> list[Any]:
    """The load that 1.2 kW at 120 rpm overcome, and what holds the sun."""
    put_in = 1200 / (120 * RPM)
    drive = {"position": 0.0, "speed": 120 * RPM, "effort": put_in}
    m = case("GTR-3").with_values({"drives.E": drive, "loads.load.value": "unknown"})
    r = da.dynamics(m)
    return [r.speed("sun_D")[0] / RPM, r.effort("E")[0], r.unknown_load("load")[0], r.effort("A")[0]]


def worm() -> list[Any]:
    """The rim is a nut; from the coefficient on at which it cannot drive the worm, that is self-locking."""

    def effort(mu: float, speed: float) -> float:
        m = case("GTR-5", joints__mesh__friction__coefficient=mu, drives__O__speed=speed)
        return float(da.dynamics(m).effort("O")[0])

    m = case("GTR-5")
    asked = {"type": "force", "on": "rim", "at": "O", "direction": [1, 0, 0], "value": "unknown"}
    r = da.dynamics(m.with_values({"drives.O.effort": 20.0, "loads.wheel": asked}))
    axial = float(r.unknown_load("wheel")[0])
    lead = math.degrees(math.atan(m.joints["mesh"].lead / (2 * math.pi * 0.025)))
    locking = brentq(lambda mu: effort(mu, -10.0), 0.1, 0.3, xtol=1e-13)
    return [lead, 20 / 0.025, axial, None, 100 * effort(0.0, 10.0) / effort(0.05, 10.0), axial * 0.1, locking]


CALLS: dict[str, Callable[[], list[Any]]] = {
    "BAL-1": cylinder,
    "BAL-3": locomotive,
    "BAL-4": four_cranks,
    "BAL-5": radial,
    "BAL-7": four_bar,
    "BAL-9": v_twin,
    "BA-01": one_plane,
    "BA-03": one_plane_in_inches,
    "BA-04": half_balanced,
    "BA-06": broad_arrow,
    "BA-07": across_the_stroke,
    "BA-08": two_corrections,
    "FW-01": lambda: [da.flywheel_size(0.1 * 300e3 * 60 / 90, 90 * RPM, Cs=0.01).mass(2)],
    "FW-02": areas,
    "FW-04": double_acting,
    "FW-06": gas_engine,
    "FW-08": harmonic_engine,
    "FW-09": lambda: [da.flywheel_size(2500 * 32.2, 120 * RPM, Cs=0.01).mass(3.5) / 2240],
    "FLY-1": speed_limits,
    "FLY-2": flywheel_from_rest,
    "FLY-4": pulses,
    "MOT-1": run_up,
    "MOT-3": pendulum,
    "MOT-4": rubbing_block,
    "MOT-6": free_yoke,
    "MOT-8": clutch,
    "MOT-9": damped_block,
    "ML-01": double_four_bar,
    "SC-13": known_rod,
    "SC-14": rod_found_by_a_swing,
    "SC-15": rod_found_by_two_swings,
    "CAM-1": arc_cam,
    "CAM-2": valve,
    "CAM-3": rise_laws,
    "CAM-4": eccentric_disc,
    "GOV-1": porter,
    "GOV-3": hartnell,
    "GOV-5": heavy_balls,
    "GYR-1": disc_on_an_arm,
    "GYR-2": disc_in_bearings,
    "GYR-4": ship,
    "BRK-3": braked_car,
    "BRK-8": lowering_brake,
    "CLU-1": collar,
    "CLU-3": discs,
    "CLU-4": centrifugal_clutch,
    "FRI-1": eccentric,
    "STR-1": falling_rod,
    "STR-3": turning_arm,
    "BRG-1": ball_bearing,
    "BRG-3": roller_bearing,
    "BRG-4": pulsing_load,
    "GTR-1": reverted_train,
    "GTR-3": compound_train,
    "GTR-5": worm,
}
