"""Each key of a copied link, joint, drive and load: turned by 30 deg, or mirrored in a line at 30 deg, by hand."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

import dalembert as da

BASE = """units: {length: mm, force: N, mass: kg, moment: N*m}
parameters: {k: 2 mm, f: 2 N}
links:
  ground: {points: {O: [0, 0], S: [10, 20]}}
  crank: {points: {O: [0, 0], A: [50, 20]}, mass: 2}
  drum: {points: {S: [0, 0], C: [0, 0]}}
  carrier: {points: {S: [0, 0], C: [60, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
drives: {O: {position: 20}}
loads: {}
copies: [{of: [crank], count: 2, HOW}]
"""
MIRROR, PHASE = "mirror: {ground: 30}", "phase: {ground: 30}"
PIN = "O: {type: pin, links: [ground, crank]}"
WELDED = (PIN, "O: {type: weld, links: [ground, crank], angle: 10}"), ("{O: {position: 20}}", "{}")
SLIDER = ("O: {type: pin, links: [ground, crank]}", "O: {type: slider, links: [ground, crank], direction: 20, "
          "stops: {from: -3, to: 5}}")  # fmt: skip
MOTOR = ("{position: 20}", "{motor: {stall: 3, no_load: 10 rad/s, on: 10 deg, off: 50 rad/s}}")
CURVE = (
    "{position: 20}",
    "{motor: {curve: {speed: [0, 10 rad/s, 20 rad/s], torque: [3, 2, 0]}, on: 0.1 s, off: 10 deg}}",
)
START = ("loads: {}", "start: {O: {position: 10, speed: 3 rad/s}}")
RANGE = ("position: 20", "position: unknown, effort: 0, range: [10, 50]")
STOPS = ("position: 20}", "position: 20, stops: {from: 10, restitution: 0.3}}")
PLACES = ("A: [50, 20]", "A: [50, 20], B: {from: A, at: [3, 4]}, C: {from: A, turn: 40, about: O}, "
          "D: {from: A, mirror: 40}")  # fmt: skip
SIDE = ("O: {type: pin, links: [ground, crank]}", "O: {type: pin, links: [ground, crank]}\n  W: {type: pin, links: "
        "[ground, drum], at: S}\n  P: {type: shoe, links: [drum, crank], at: [S, A], radius: 5, from: 20, to: 50, "
        "pressure: cosine, side: left, friction: {coefficient: 0.3}}")  # fmt: skip


BOTH = ("of: [crank]", "of: [crank, drum]")
CAM = (
    "O: {type: pin, links: [ground, crank]}",
    """O: {type: pin, links: [ground, crank]}
  G: {type: pin, links: [ground, carrier], at: S}
  Q: {type: pin, links: [carrier, crank], at: [S, A]}
  D: {type: pin, links: [carrier, drum], at: C}
  F: {type: cam, links: [drum, crank], at: [C, O], follower: knife, profile: {base: 30, start: 15, segments: [
      {to: 0.35 rad, in: 90 deg, by: cycloidal}, {dwell: 90 deg}, {to: 0, in: 180 deg, by: cycloidal}]}}""",
)


def couple(value: str) -> tuple[str, str]:
    return "loads: {}", f"loads: {{T: {{type: couple, on: crank, value: {value}}}}}"


def force(value: str) -> tuple[str, str]:
    return "loads: {}", f"loads: {{T: {{type: force, on: crank, at: A, value: {value}}}}}"


def deg(*angles: float) -> Any:
    out = [f"{math.radians(a)!r} rad" for a in angles]
    return out[0] if len(out) == 1 else out


def copied(how: str, *changes: tuple[str, str]) -> da.Mechanism:
    text = BASE.replace("HOW", how)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return da.loads(text, name="m.yaml")


def same(found: Any, wanted: Any) -> bool:
    """Equal, with numbers in texts to rounding."""
    if isinstance(wanted, dict):
        return found.keys() == wanted.keys() and all(same(found[n], wanted[n]) for n in wanted)
    if isinstance(wanted, list):
        return len(found) == len(wanted) and all(map(same, found, wanted))
    number = r"-?\d+\.?\d*(?:e-?\d+)?"
    if re.sub(number, "0", str(found)) != re.sub(number, "0", str(wanted)):
        return False
    return [float(x) for x in re.findall(number, str(found))] == pytest.approx(
        [float(x) for x in re.findall(number, str(wanted))], rel=1e-12, abs=1e-15
    )


C, S = math.cos(math.pi / 6), math.sin(math.pi / 6)
KEYS: dict[str, tuple[str, tuple[tuple[str, str], ...], str, Any]] = {
    "mirrored places": (
        MIRROR,
        (PLACES,),
        "links.crank_2.points",
        {
            "O": ["0.0 m", "0.0 m"],
            "A": ["0.05 m", "-0.02 m"],
            "B": {"from": "A", "at": ["0.003 m", "-0.004 m"]},
            "C": {"from": "A", "turn": deg(-40), "about": "O"},
            "D": {"from": "A", "mirror": deg(-40)},
        },
    ),
    "turned places": (
        PHASE,
        (PLACES,),
        "links.crank_2.points",
        {
            "O": ["0.0 m", "0.0 m"],
            "A": ["0.05 m", "0.02 m"],
            "B": {"from": "A", "at": ["0.003 m", "0.004 m"]},
            "C": {"from": "A", "turn": deg(40), "about": "O"},
            "D": {"from": "A", "mirror": deg(40)},
        },
    ),
    "a mirrored range": (MIRROR, (RANGE,), "drives.O_2.range", deg(10, 50)),
    "a turned range": (PHASE, (RANGE,), "drives.O_2.range", deg(40, 80)),
    "a mirrored stop": (MIRROR, (STOPS,), "drives.O_2.stops", {"to": deg(50), "restitution": 0.3}),
    "a turned stop": (PHASE, (STOPS,), "drives.O_2.stops", {"from": deg(40), "restitution": 0.3}),
    "a mirrored motor": (
        MIRROR,
        (MOTOR, START),
        "drives.O_2.motor",
        {"stall": "-3.0 N*m", "no_load": "-10.0 rad/s", "on": deg(50), "off": "-50.0 rad/s"},
    ),
    "a turned motor": (
        PHASE,
        (MOTOR, START),
        "drives.O_2.motor",
        {"stall": "3.0 N*m", "no_load": "10.0 rad/s", "on": deg(40), "off": "50.0 rad/s"},
    ),
    "a mirrored curve of a motor": (
        MIRROR,
        (CURVE, START),
        "drives.O_2.motor",
        {
            "curve": {
                "speed": ["-20.0 rad/s", "-10.0 rad/s", "0.0 rad/s"],
                "torque": ["0.0 N*m", "-2.0 N*m", "-3.0 N*m"],
            },
            "on": "0.1 s",
            "off": deg(50),
        },
    ),
    "a mirrored start": (MIRROR, (MOTOR, START), "start.O_2", {"position": deg(50), "speed": "-3.0 rad/s"}),
    "a turned start": (PHASE, (MOTOR, START), "start.O_2", {"position": deg(40), "speed": "3.0 rad/s"}),
    "a mirrored start of a slide": (
        MIRROR,
        (SLIDER, ("{position: 20}", "{motor: {stall: 3, no_load: 10 m/s, on: 10 mm, off: 3 m/s}}"),
         ("loads: {}", "start: {O: {position: 10, speed: 3 m/s}}")),
        "start.O_2",
        {"position": "0.01 m", "speed": "3.0 m/s"},
    ),
    "a mirrored motor of a slide": (
        MIRROR,
        (SLIDER, ("{position: 20}", "{motor: {stall: 3, no_load: 10 m/s, on: 10 mm, off: 3 m/s}}"),
         ("loads: {}", "start: {O: {position: 10, speed: 3 m/s}}")),
        "drives.O_2",
        {"freedom": "slide", "motor": {"stall": "3.0 N", "no_load": "10.0 m/s", "on": "0.01 m", "off": "3.0 m/s"}},
    ),
    "mirrored stops of a pin": (
        MIRROR, ((PIN, PIN[:-1] + ", stops: {from: 10, to: 20}}"),), "joints.O_2.stops",
        {"from": deg(40), "to": deg(50)},
    ),
    "turned stops of a pin": (
        PHASE, ((PIN, PIN[:-1] + ", stops: {from: 10}}"),), "joints.O_2.stops", {"from": deg(40)}
    ),
    "a mirrored weld": (MIRROR, WELDED, "joints.O_2.angle", deg(50)),
    "a turned weld": (PHASE, WELDED, "joints.O_2.angle", deg(40)),
    "a turned guide along the x axis": (
        PHASE, ((PIN, "O: {type: slider, links: [ground, crank]}"),), "joints.O_2.direction", deg(30)
    ),
    "a mirrored guide": (
        MIRROR,
        (SLIDER,),
        "joints.O_2",
        {"type": "slider", "links": ["ground", "crank_2"], "at": ["O_2", "O"], "direction": deg(40),
         "stops": {"from": "-0.003 m", "to": "0.005 m"}},
    ),
    "a turned expression beside a number": (
        PHASE,
        (force("['3*O', 4]"),),
        "loads.T_2.value",
        [
            {"expression": f"{C!r}*(3*(1*(O_2 - {math.pi / 6!r}))) + {-4 * S!r}", "unit": "N"},
            {"expression": f"{S!r}*(3*(1*(O_2 - {math.pi / 6!r}))) + {4 * C!r}", "unit": "N"},
        ],
    ),
    "a mirrored expression beside a number": (
        MIRROR,
        (force("['3*O', 4]"),),
        "loads.T_2.value",
        [
            {"expression": f"{S!r}*(3*(-1*(O_2 - {math.pi / 3!r}))) + {4 * C!r}", "unit": "N"},
            {"expression": f"{C!r}*(3*(-1*(O_2 - {math.pi / 3!r}))) + {-4 * S!r}", "unit": "N"},
        ],
    ),
    "a mirrored table": (
        MIRROR,
        (couple("{against: O, x: [0, 90], y: [1, 2], shift: 10}"),),
        "loads.T_2.value",
        {"against": "O_2", "x": deg(-90, 0), "y": ["2.0 N*m", "1.0 N*m"], "times": -1.0, "shift": deg(50)},
    ),
    **{
        f"a force in a line {how}": (
            how,
            (force("[3, 4]"),),
            "loads.T_2.value",
            [f"{x}.0 N", f"{y}.0 N"],
        )
        for how, x, y in (
            ("phase: {ground: 90}", -4, 3), ("phase: {ground: 180}", -3, -4), ("phase: {ground: 270}", 4, -3),
            ("phase: {ground: 360}", 3, 4), ("mirror: {ground: 0}", 3, -4), ("mirror: {ground: 45}", 4, 3),
            ("mirror: {ground: 90}", -3, 4), ("mirror: {ground: -45}", -4, -3),
        )
    },
    "a turned size and direction": (
        PHASE, (force("5 @ 10"),), "loads.T_2",
        {"type": "force", "on": "crank_2", "at": "A", "value": "5.0 N", "direction": deg(40)},
    ),
    "a mirrored size and direction": (
        MIRROR, (force("5 @ 10"),), "loads.T_2",
        {"type": "force", "on": "crank_2", "at": "A", "value": "5.0 N", "direction": deg(50)},
    ),
    "a force that follows its link": (
        MIRROR, (("loads: {}", "loads: {T: {type: force, on: crank, at: [3, 4], axes: link, value: [5, 6]}}"),),
        "loads.T_2",
        {"type": "force", "on": "crank_2", "at": ["0.003 m", "-0.004 m"], "axes": "link", "value": ["5.0 N", "-6.0 N"]},
    ),
    "a mirrored direction": (
        MIRROR, (("loads: {}", "loads: {T: {type: force, on: crank, at: A, value: 5, direction: 10}}"),),
        "loads.T_2", {"type": "force", "on": "crank_2", "at": "A", "value": "5.0 N", "direction": deg(50)},
    ),
    "a mirrored couple": (MIRROR, (couple("5"),), "loads.T_2.value", "-5.0 N*m"),
    "a turned couple": (PHASE, (couple("5"),), "loads.T_2.value", "5.0 N*m"),
    "a mirrored couple of parameters": (MIRROR, (couple("f*3 m"),), "loads.T_2.value", "-(f*3 m)"),
    "a mirrored spring about a pin": (
        MIRROR, (("loads: {}", "loads: {T: {type: torsion_spring, joint: O, stiffness: 7, free_angle: 10}}"),),
        "loads.T_2",
        {"type": "torsion_spring", "joint": "O_2", "stiffness": "7.0 N*m/rad", "free_angle": deg(50)},
    ),
    "a turned cam": (
        "phase: {ground: 30, carrier: 20}", (CAM, BOTH), "joints.F_2.profile",
        {"segments": [{"to": "0.35 rad", "by": "cycloidal", "in": deg(90)}, {"dwell": deg(90)},
                      {"to": "0.0 rad", "by": "cycloidal", "in": deg(180)}], "base": "0.03 m", "start": deg(35)},
    ),
    "a turned cam that begins at 0": (
        "phase: {ground: 30, carrier: 20}", (CAM, BOTH, ("start: 15, ", "")), "joints.F_2.profile.start", deg(20),
    ),
    "a mirrored cam": (
        "mirror: {ground: 30, carrier: 20}", (CAM, BOTH), "joints.F_2.profile",
        {"segments": [{"to": "-0.35 rad", "by": "cycloidal", "in": deg(90)}, {"dwell": deg(90)},
                      {"to": "0.0 rad", "by": "cycloidal", "in": deg(180)}],
         "base": "0.03 m", "start": deg(25), "sense": "cw"},
    ),
    "a turned table": (
        PHASE,
        (couple("{against: O, x: [0, 90], y: [1, 2], shift: 10}"),),
        "loads.T_2.value",
        {"against": "O_2", "x": deg(0, 90), "y": ["1.0 N*m", "2.0 N*m"], "shift": deg(40)},
    ),
    "a mirrored pose": (
        MIRROR,
        (("loads: {}", "assembly: {crank: [1, 2, 20]}"),),
        "assembly.crank_2",
        [f"{(S + 2 * C) / 1e3!r} m", f"{(C - 2 * S) / 1e3!r} m", deg(40)],
    ),
    "a turned pose": (
        PHASE,
        (("loads: {}", "assembly: {crank: [1, 2, 20]}"),),
        "assembly.crank_2",
        [f"{(C - 2 * S) / 1e3!r} m", f"{(S + 2 * C) / 1e3!r} m", deg(50)],
    ),
    "a pose not turned": (
        "phase: {ground: 0}",
        (("loads: {}", "assembly: {crank: [1, 2, 20]}"),),
        "assembly.crank_2",
        ["0.001 m", "0.002 m", deg(20)],
    ),
    "a pose mirrored about a point": (
        MIRROR + ", about: S",
        (("loads: {}", "assembly: {crank: [1, 2, 20]}"),),
        "assembly.crank_2",
        [f"{(10 - 9 * S - 18 * C) / 1e3!r} m", f"{(20 - 9 * C + 18 * S) / 1e3!r} m", deg(40)],
    ),
    "a pose turned about a point": (
        PHASE + ", about: S",
        (("loads: {}", "assembly: {crank: [1, 2, 20]}"),),
        "assembly.crank_2",
        [f"{(10 - 9 * C + 18 * S) / 1e3!r} m", f"{(20 - 9 * S - 18 * C) / 1e3!r} m", deg(50)],
    ),
    "the side of a mirrored lining": ("mirror: {ground: 30, drum: 30}", (SIDE,), "joints.P_2.side", "right"),
    "the side of a turned lining": (PHASE, (SIDE,), "joints.P_2.side", "left"),
    "a pose of a place that follows from parameters": (
        PHASE,
        (("loads: {}", "assembly: {crank: [k, 2, 20]}"),),
        "assembly",
        {"crank": ["k", "0.002 m", deg(20)], "crank_2": deg(50)},
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", KEYS)
def test_a_key_is_turned_or_mirrored_in_a_copy(name: str) -> None:
    how, changes, path, wanted = KEYS[name]
    found: Any = copied(how, *changes).to_tree()
    for key in path.split("."):
        found = found[key]
    assert same(found, wanted), found


INCOMPLETE = (
    "'3*(' is not an expression: it is incomplete; an expression is made of numbers, names of drives and parameters, "
    "pi, + - * / ^, brackets, comparisons in brackets and sin cos tan asin acos atan atan2 sqrt exp log abs sign min "
    "max"
)
ROPE = ("  O: {type: pin", "  R: {type: rope, through: [ground.S, crank.A, ground.O]}\n  O: {type: pin")
SHAPE = ("mass: 2", "shape: {type: mesh, file: a.stl, density: 3 kg/m^3}")
REFUSED: dict[str, tuple[str, tuple[str, str], str]] = {
    "a mirrored mesh": (
        MIRROR, SHAPE, "12: copies 1: a mesh cannot be mirrored; give mass, center and inertia instead of its shape"
    ),
    "a point of the copy's name": (
        MIRROR,
        ("S: [10, 20]", "S: [10, 20], O_2: [1, 2]"),
        "12: copies 1: link 'ground' has a point 'O_2' already; give the copies other names: names: [...]",
    ),
    "a rope": (
        PHASE,
        ROPE,
        "13: copies 1: rope 'R' touches copied links, and ropes are not copied; write the copies of its links out",
    ),
    "parameters beside a coordinate": (
        PHASE,
        force("['3*O', 'f*4']"),
        "12: copies 1: one component of a rotated vector uses parameters or units, and the other does not; write each "
        "component as a separate load, a value with a direction",
    ),
    "a table as a component": (
        PHASE,
        force("[{against: O, x: [0, 90], y: [1, 2]}, 4]"),
        "12: copies 1: a component of a rotated vector is a table; write each component as a separate load, a value "
        "with a direction",
    ),
    "columns of a file": (
        MIRROR,
        couple("{against: O, file: a.csv}"),
        "12: copies 1: the columns of a file are not mirrored; write that load's table as x and y, or as an expression",
    ),
    "a wrong component": (PHASE, force("['3*(', 4]"), f"11: item 1 of value of load 'T': {INCOMPLETE}"),
    "a wrong couple": (MIRROR, couple("3*("), f"11: value of load 'T': {INCOMPLETE}"),
    "a wrong switch": (
        MIRROR,
        ("{position: 20}", "{motor: {stall: 3, no_load: 10 rad/s, on: 3 kg}}"),
        "10: on of motor of drive 'O': '3 kg' says neither when, nor where, nor at which speed; write 0.5 s, 90 deg or "
        "300 rpm",
    ),
    "a motor that is a number": (
        MIRROR,
        ("{position: 20}", "{motor: 3}"),
        "10: motor of drive 'O': expected a mapping, not 3; write motor: {stall: 40 N*m, no_load: 30 rad/s}, or "
        "{curve: {speed: [0 rpm, 900 rpm], torque: [40, 0]}}",
    ),
    "a pose of no length": (
        PHASE,
        ("loads: {}", "assembly: {crank: [x, 2, 30]}"),
        "11: item 1 of crank of assembly: 'x' uses 'x', which is not a parameter; choose among k, f",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_copied_is_refused_at_its_line(name: str) -> None:
    how, change, says = REFUSED[name]
    with pytest.raises(da.ModelError) as refused:
        copied(how, change)
    assert str(refused.value) == f"m.yaml:{says}"


@pytest.mark.parametrize("form", ["arcs: [{center: [0, 0], radius: 30, to: 90}, {center: [0, 0], radius: 30, to: 360}]",
                                  "points: {angle: [0, 90, 180, 270], radius: [30, 31, 30, 29]}"])  # fmt: skip
def test_a_cam_of_arcs_or_points_is_turned_as_it_is_and_not_mirrored(form: str) -> None:
    cam = CAM[0], CAM[1][: CAM[1].index("profile")] + f"profile: {{{form}}}}}"
    with pytest.raises(da.ModelError) as refused:
        copied("mirror: {ground: 30, carrier: 20}", cam, BOTH)
    assert str(refused.value) == (
        "m.yaml:16: copies 1: the arcs or points of a cam are not mirrored; write that cam out"
    )
    tree = copied("phase: {ground: 30, carrier: 20}", cam, BOTH).to_tree()
    assert tree["joints"]["F_2"]["profile"] == tree["joints"]["F"]["profile"]
