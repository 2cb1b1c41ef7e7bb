"""Motions under forces with every kind of event: contacts, stops, friction, brakes, clutches, corners, laws."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import dalembert as da
from dalembert.bundled import cases
from tests.approved.read_out import read_out, told
from tests.elements import test_landing as landing
from tests.machine import test_corners as corners
from tests.machine import test_elastic_stops as elastic
from tests.machine import test_stick as stick
from tests.machine import test_stops as stops
from tests.machine.published_calls import CAR, CLUTCH

HAMMER = Path(__file__).parents[2] / "docs" / "drop-hammer.yaml"
BRAKED = """
units: {length: mm}
links:
  ground: {points: {O: [0, 0]}}
  drum: {points: {O: [0, 0]}, inertia: 1.5 kg*m^2}
joints:
  O: {type: pin, links: [ground, drum]}
  D: {type: disc, links: [ground, drum], at: O, radii: [50, 100], force: 300, faces: 2, friction: {coefficient: 0.3},
      heat: {mass: 2 kg, capacity: 460 J/(kg*K)}}
drives: {O: {effort: 0}}
start: {O: {position: 0, speed: 40 rad/s}}
"""
BELT = """
links:
  ground: {points: {O: [0, 0], Q: [0.5, 0]}}
  small: {points: {O: [0, 0]}, inertia: 0.02}
  large: {points: {Q: [0, 0]}, inertia: 0.3}
joints:
  O: {type: pin, links: [ground, small]}
  Q: {type: pin, links: [ground, large]}
  belt: {type: belt, links: [small, large], at: [O, Q], radii: [0.06, 0.18], tension: 350, friction: {coefficient: 0.3}}
drives: {O: {effort: 30}}
start: {O: {position: 0, speed: 0}}
"""
LED = """
links:
  ground: {points: {O: [0, 0]}}
  slide: {points: {O: [0, 0]}, mass: 2}
  bob: {points: {O: [0, 0], P: [0.4, 0]}, mass: 1, center: [0.3, 0], inertia: 0.01}
gravity: standard
joints:
  S: {type: slider, links: [ground, slide], at: [O, O], direction: 0}
  P: {type: pin, links: [slide, bob], at: [O, O]}
drives:
  S: {law: {segments: [{dwell: 0.1 s}, {to: 0.2 m, in: 0.3 s, by: harmonic}, {dwell: 0.2 s}]}}
  P: {effort: 0}
start: {P: {position: -80 deg, speed: 0}}
"""


def run(text: Any, until: Any = "1 s", count: int = 7, **more: Any) -> Any:
    return lambda: da.simulate(
        da.loads(text) if isinstance(text, str) else text(), until, count=count, **more
    )


ROUNDED = re.compile(r"(?<![\w.])-?\d(?:\.\d+)?e-(?:1\d|[2-9]\d|\d{3})\b")
"""Speeds and forces that are 0 but for rounding."""
SIMULATED: dict[str, Callable[[], Any]] = {
    "ladder": run(
        landing.LADDER % (4 * math.cos(math.radians(70))),
        "1.1 s",
        events=["reaction.floor.y = 100 N", "normal.wall = 10 N", "gap.wall = 5 mm", "angle.ladder = 40 deg"],
    ),
    "dome": run(
        landing.DISC,
        ["0.8 s", "energy.kinetic = 9 J"],
        events=["normal.dome = 5 N", "reaction.O.magnitude = 3 N", "time = 0.2 s"],
    ),
    "ball": run(landing.BALL % 0.3, "3 s"),
    "slope": run(
        landing.SLOPE % ("{coefficient: 0.1}", "{effort: 0}") + "\nstart: {track: {position: 0, speed: 0}}",
    ),
    "follower": run(landing.JUMPING.replace("FOLLOWER", "{roller: 0.01}"), "0.04 s"),
    "hammer": run(lambda: da.load(HAMMER), "2 s"),
    "piston-on-a-stop": run(stops.CRANK % "", "3 s"),
    "piston-on-a-stop-with-friction": run(
        stops.CRANK % ", friction: {coefficient: 0.2, radius: 20 mm}", "1 s"
    ),
    "five-bar": run(stops.FIVE_BAR % ("", 0.4), "0.3 s"),
    "carts": run(stops.TWO_CARTS % ("0.1 m", "-1 m/s", "-1 m/s"), "0.3 s"),
    "motor-on-a-stop": run(
        stops.ONE
        % (
            ", stops: {to: 90 deg, restitution: 0.3}",
            "motor: {stall: 4 N*m, no_load: 30 rad/s}, brake: 1 N*m",
        ),
        "2 s",
    ),
    "elastic-cart": run(elastic.CART.format(damping=3, end="to: 1 m", speed="4 m/s", effort="0 N")),
    "elastic-lever": run(elastic.LEVER),
    "elastic-and-rough": run(elastic.RUBBING.replace("SPEED", "12"), "0.2 s"),
    "rotors": run(lambda: stick.rotors("0", 100), "3 s"),
    "rotors-slip": run(lambda: stick.rotors("40*time", 0, ", static: 0.15"), "6 s"),
    "blocks": run(stick.BLOCKS, "3 s"),
    "corners": run(lambda: corners.bar("-20*sign(O) - 3*sign(O - 0.1) N*m"), "1.2 s"),
    "car": run(CAR % (0.3, 0.6), ["4 s", "rear.speed = 0 ft/s"]),
    "clutch": run(CLUTCH, "3 s"),
    "disc-brake": run(BRAKED, ["6 s", "O.speed = 0 rad/s"]),
    "belt": run(BELT, "0.2 s"),
    "led-pendulum": run(LED, "0.6 s"),
    "hooke": run(lambda: freed("sp-06a-hooke-joint-with-flywheel"), "0.1 s"),
}


def freed(name: str) -> Any:
    """A case whose first drive an effort moves."""
    m = da.load(cases()[name])
    drive = next(iter(m.drives))
    tree = m.to_tree()
    tree["drives"] = {drive: {"effort": "2*cos(time*10) N*m"}}
    tree["start"] = {drive: {"position": "30 deg", "speed": "20 rad/s"}}
    tree["loads"] = {}
    return da.mechanism({k: v for k, v in tree.items() if k != "answers"})


def text_of(call: Callable[[], Any]) -> str:
    """What a motion says, its columns, events and what it lost where."""
    s = call()
    events = [[e.name, e.of, e.sentence, e.time, e.lost, e.speed] for e in s.events]
    more = {"events": events, "works": s.works, "heat": s.heat, "joint stops": s.joint_stop_force}
    return ROUNDED.sub("0", "\n".join([told(s), *read_out(more, "more")]))


MOVED = {f"simulated-{n}": lambda call=call: text_of(call) for n, call in SIMULATED.items()}
