"""Shafts in space: Hooke's joint, two of them in a row, a rotating shaft with masses off its axis, a differential.

Bearings are chosen so that all reactions are unique: each shaft's thrust and each misalignment is taken once. Every
link is described as it is drawn, its axes parallel to ground's.
"""

from __future__ import annotations

from math import cos, pi, radians, sin
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library.compass import FULL_TURN
from dalembert.model.library.tree_parts import build_mechanism, positive, turning
from dalembert.model.quantities.vectors import Vector

if TYPE_CHECKING:
    from dalembert.model import Mechanism

X: Vector = (1.0, 0.0, 0.0)
Y: Vector = (0.0, 1.0, 0.0)


def hooke_joint(
    *,
    angle: float = 30.0,
    arm: float = 0.2,
    torque: float = 20.0,
    shaft_mass: float = 4.0,
    shaft_radius: float = 0.02,
    speed: float = 10 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""A universal joint between two shafts: output turns at w cos(angle) / (1 - (sin(angle) sin(turn))^2).

    ::

                        __/ output, at the angle
        input ----- O _/
                 bearings `arm` from O on both shafts

    `angle` between the shafts in degrees, bearings `arm` from the joint's centre in metres; `torque` in N m resists
    on the output shaft. Each shaft a cylinder of `shaft_mass` in kg and `shaft_radius` in metres; the input's bearing
    is a hinge, the output's a ball that may slide. At 0 the pin of the input's fork lies across both shafts.
    Gravity along -z; `speed` of the input in rad/s, `sweep` in radians.

    >>> from dalembert.model.library import hooke_joint
    >>> hooke_joint().joints["O"].type
    'universal'
    """
    positive("hooke_joint", arm=arm, shaft_radius=shaft_radius)
    positive("hooke_joint", "kg", shaft_mass=shaft_mass)
    _slanted("hooke_joint", angle)
    e = _slant(angle)
    ends = arm * e[0], arm * e[1], arm * e[2]
    return build_mechanism(
        "Hooke's joint",
        gravity="standard",
        space="space",
        links={
            "ground": {"points": {"I": [-arm, 0.0, 0.0], "E": list(ends)}},
            "input": shaft(shaft_mass, shaft_radius, I=(-arm, 0.0, 0.0), O=(0.0, 0.0, 0.0)),
            "output": shaft(shaft_mass, shaft_radius, O=(0.0, 0.0, 0.0), E=ends),
        },
        joints={
            "I": {"type": "revolute", "links": ["ground", "input"], "axis": list(X)},
            "O": fork("input", "output", Y, _square(e)),
            "E": {"type": "sphere_in_cylinder", "links": ["ground", "output"], "axis": list(e)},
        },
        drives={"I": turning(sweep, positions, speed)},
        loads={"torque": _torque("output", tuple(-torque * x for x in e))},
    )


def double_cardan(
    *,
    angle: float = 30.0,
    length: float = 0.3,
    arm: float = 0.2,
    torque: float = 20.0,
    shaft_mass: float = 4.0,
    shaft_radius: float = 0.02,
    speed: float = 10 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Two universal joints with a shaft between them, input and output parallel: the output turns as the input does.

    ::

                      B -----[]-- output
                   /  middle
        input -[]- A

    `angle` between the middle shaft of `length` A B and the other two in degrees, their bearings `arm` from A and B in
    metres; `torque` in N m resists on the output. The forks of the middle shaft lie in one plane. Shafts are cylinders
    of `shaft_mass` in kg and `shaft_radius` in metres; the input's bearing is a hinge, the output's lets it slide.
    Gravity along -z; `speed` of the input in rad/s, `sweep` in radians.

    >>> from dalembert.model.library import double_cardan
    >>> sorted(double_cardan().links)
    ['ground', 'input', 'middle', 'output']
    """
    positive("double_cardan", length=length, arm=arm, shaft_radius=shaft_radius)
    positive("double_cardan", "kg", shaft_mass=shaft_mass)
    _slanted("double_cardan", angle)
    e = _slant(angle)
    b = length * e[0], length * e[1], length * e[2]
    end = (b[0] + arm, b[1], b[2])
    return build_mechanism(
        "Double Cardan shaft",
        gravity="standard",
        space="space",
        links={
            "ground": {"points": {"I": [-arm, 0.0, 0.0], "E": list(end)}},
            "input": shaft(shaft_mass, shaft_radius, I=(-arm, 0.0, 0.0), A=(0.0, 0.0, 0.0)),
            "middle": shaft(shaft_mass, shaft_radius, A=(0.0, 0.0, 0.0), B=b),
            "output": shaft(shaft_mass, shaft_radius, B=b, E=end),
        },
        joints={
            "I": {"type": "revolute", "links": ["ground", "input"], "axis": list(X)},
            "A": fork("input", "middle", Y, _square(e)),
            "B": fork("middle", "output", _square(e), Y),
            "E": {"type": "cylindrical", "links": ["ground", "output"], "axis": list(X)},
        },
        drives={"I": turning(sweep, positions, speed)},
        loads={"torque": _torque("output", (-torque, 0.0, 0.0))},
    )


def rotating_shaft(
    *,
    length: float = 0.6,
    masses: tuple[float, float] = (0.3, 0.2),
    radii: tuple[float, float] = (0.05, 0.08),
    angles: tuple[float, float] = (0.0, 120.0),
    places: tuple[float, float] = (0.2, 0.45),
    shaft_mass: float = 6.0,
    shaft_radius: float = 0.02,
    speed: float = 100 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""A shaft on two bearings with two masses off its axis: dynamic bearing reactions.

    ::

             m1 o
        A ======|==========|====== B     z along the shaft
                         m2 o

    Bearings A and B are `length` apart in metres along z; `masses` in kg lie at `radii` from the axis in metres, at
    `angles` from x in degrees, `places` from A in metres. The reactions turn with the shaft: on it,
    B = - sum of m r w^2 z / length and A = - sum of m r w^2 (1 - z / length), each outwards along its r. The shaft is
    a cylinder of `shaft_mass` in kg and `shaft_radius` in metres; A is a ball that holds it along z, B a ball that may
    slide. No gravity; `speed` in rad/s, `sweep` in radians.

    >>> from dalembert.model.library import rotating_shaft
    >>> sorted(rotating_shaft().links)
    ['first', 'ground', 'second', 'shaft']
    """
    positive("rotating_shaft", length=length, shaft_radius=shaft_radius)
    positive("rotating_shaft", radius=radii[0], second_radius=radii[1])
    positive("rotating_shaft", "kg", mass=masses[0], second_mass=masses[1], shaft_mass=shaft_mass)
    spots = [
        (r * cos(radians(angle)), r * sin(radians(angle)), z)
        for r, angle, z in zip(radii, angles, places, strict=True)
    ]
    origin, far = (0.0, 0.0, 0.0), (0.0, 0.0, length)
    links: Tree = {
        "ground": {"points": {"A": list(origin), "B": list(far)}},
        "shaft": shaft(shaft_mass, shaft_radius, A=origin, B=far),
    }
    joints: Tree = {
        "A": {"type": "spherical", "links": ["ground", "shaft"]},
        "B": {"type": "sphere_in_cylinder", "links": ["ground", "shaft"], "axis": [0.0, 0.0, 1.0]},
    }
    for name, mass, spot in zip(("first", "second"), masses, spots, strict=True):
        links["shaft"]["points"][name] = list(spot)
        links[name] = {"points": {name: list(spot)}, "mass": mass, "center": list(spot)}
        joints[name] = {"type": "weld", "links": ["shaft", name]}
    return build_mechanism(
        "Rotating shaft with masses off its axis",
        gravity="none",
        space="space",
        links=links,
        joints=joints,
        drives={"A": {"freedom": "turn", "axis": [0.0, 0.0, 1.0]} | turning(sweep, positions, speed)},
    )


def bevel_differential(
    *,
    side_radius: float = 0.06,
    planet_radius: float = 0.03,
    torque: float = 40.0,
    side_mass: float = 1.2,
    planet_mass: float = 0.3,
    carrier_mass: float = 2.0,
    speed: float = 20.0,
    sweep: tuple[float, float] = FULL_TURN,
    second_sweep: tuple[float, float] = (0.0, 2.4 * pi),
    positions: int = 72,
) -> Mechanism:
    r"""A bevel differential: the carrier turns by half the sum of both side wheels' turns.

    ::

            planet
        left |X| right    all about z but the planet, about x of the carrier
            carrier

    Pitch radii `side_radius` and `planet_radius` in metres; `torque` in N m turns the carrier about z, and the side
    wheels, whose turns are prescribed (a car in a curve), hold it with half of it each. Wheels are discs of
    `side_mass` and `planet_mass` in kg, the carrier a ring of `carrier_mass` at the planet; `speed` of the left wheel
    in rad/s through `sweep`, the right one goes as much faster or slower as `second_sweep` (radians) is longer or
    shorter. Gravity along -z.

    >>> from dalembert.model.library import bevel_differential
    >>> sorted(bevel_differential().drives)
    ['left', 'right']
    """
    positive("bevel_differential", side_radius=side_radius, planet_radius=planet_radius)
    positive(
        "bevel_differential", "kg", side_mass=side_mass, planet_mass=planet_mass, carrier_mass=carrier_mass
    )
    if sweep[0] == sweep[1]:
        what = "bevel_differential: the sweep of the left wheel begins where it ends"
        raise ModelError(what, "give two different angles")
    z, size, place = [0.0, 0.0, 1.0], side_radius**2, [side_radius, 0.0, 0.0]
    low, high = [0.0, 0.0, -planet_radius], [0.0, 0.0, planet_radius]
    mesh: Tree = {
        "type": "gear",
        "radii": [side_radius, planet_radius],
        "axes": {"i": {"z": z}, "j": {"z": list(X)}},
    }
    ring = [carrier_mass * size / 2, carrier_mass * size / 2, carrier_mass * size]
    other = speed * (second_sweep[1] - second_sweep[0]) / (sweep[1] - sweep[0])
    return build_mechanism(
        "Bevel differential",
        gravity="standard",
        space="space",
        links={
            "ground": {"points": {"left": low, "right": high, "carrier": [0.0, 0.0, 0.0]}},
            "left": _disc(side_mass, side_radius, "left", low),
            "right": _disc(side_mass, side_radius, "right", high),
            "carrier": {
                "points": {"carrier": [0.0, 0.0, 0.0], "planet": place},
                "mass": carrier_mass,
                "inertia": ring,
            },
            "planet": _disc(planet_mass, planet_radius, "planet", place, axis=0),
        },
        joints={
            "left": {"type": "revolute", "links": ["ground", "left"], "axis": z},
            "right": {"type": "revolute", "links": ["ground", "right"], "axis": z},
            "carrier": {"type": "revolute", "links": ["ground", "carrier"], "axis": z},
            "planet": {"type": "revolute", "links": ["carrier", "planet"], "axis": list(X)},
            "left_mesh": {**mesh, "links": ["left", "planet"], "at": ["left", "planet"]},
            "right_mesh": {**mesh, "links": ["right", "planet"], "at": ["right", "planet"]},
        },
        drives={
            "left": turning(sweep, positions, speed),
            "right": turning(second_sweep, positions, other),
        },
        loads={"torque": _torque("carrier", (0.0, 0.0, torque))},
    )


def _disc(mass: float, radius: float, name: str, at: list[float], axis: int = 2) -> Tree:
    """A thin disc about one of its link's axes, at a point."""
    size = mass * radius**2
    inertia = [size / (2 if k == axis else 4) for k in range(3)]
    return {"points": {name: at}, "mass": mass, "center": at, "inertia": inertia}


def shaft(mass: float, radius: float, **ends: Vector) -> Tree:
    """A uniform cylinder between two points, as drawn.

    >>> round(shaft(2.0, 0.02, A=(0.0, 0.0, 0.0), B=(0.0, 0.0, 0.6))["inertia"][2][2], 12)
    0.0004
    """
    (first, p), (last, r) = ends.items()
    line = [b - a for a, b in zip(p, r, strict=True)]
    square = sum(x * x for x in line)
    along, across = mass * radius**2 / 2, mass * (radius**2 / 4 + square / 12)
    inertia = [
        [across * (i == j) + (along - across) * line[i] * line[j] / square for j in range(3)]
        for i in range(3)
    ]
    center = [(a + b) / 2 for a, b in zip(p, r, strict=True)]
    return {"points": {first: list(p), last: list(r)}, "mass": mass, "center": center, "inertia": inertia}


def fork(i: str, j: str, on_i: Vector, on_j: Vector) -> Tree:
    """A universal joint with the directions of its two pins."""
    axes = {"i": {"z": list(on_i)}, "j": {"z": list(on_j)}}
    return {"type": "universal", "links": [i, j], "axes": axes}


def _torque(on: str, value: tuple[float, ...]) -> Tree:
    return {"type": "couple", "on": on, "value": list(value)}


def _slant(angle: float) -> Vector:
    """Direction at an angle (degrees) from x, towards z."""
    return cos(radians(angle)), 0.0, sin(radians(angle))


def _square(e: Vector) -> Vector:
    """Across it, in the plane of x and z."""
    return -e[2], 0.0, e[0]


def _slanted(name: str, angle: float) -> None:
    if not 0 < angle < 90:
        raise ModelError(f"{name}: angle is {angle:g} degrees", "give one between 0 and 90 degrees")
