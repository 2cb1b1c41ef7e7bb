"""Engines of any number of cylinders in line, in a V, or in a star; generated, because a file has a fixed number of
links.

All cylinders are drawn in one plane; `place` gives the position of each along the shaft, for the couples.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library.compass import FULL_TURN
from dalembert.model.library.tree_parts import build_mechanism, pin, positive, slider, turning

if TYPE_CHECKING:
    from dalembert.model import Mechanism

TWO_TURNS = (0.0, 4 * pi)

EVEN_FIRING = {
    1: (1,), 2: (1, 2), 3: (1, 3, 2), 4: (1, 3, 4, 2), 5: (1, 2, 4, 5, 3), 6: (1, 5, 3, 6, 2, 4),
    8: (1, 6, 2, 5, 8, 3, 7, 4),
}  # fmt: skip
"""Usual firing orders in line."""

GAS = ((0, 20, 40, 60, 80, 120, 160, 200, 360, 540, 580, 620, 660, 690, 720),
       (0.37, 1, 0.52, 0.28, 0.17, 0.09, 0.06, 0.02, 0, 0, 0, 0.01, 0.05, 0.17, 0.37))  # fmt: skip
"""Force of the gas on a piston of a four-stroke engine, of its largest, by degrees of the crank after it burns."""


def in_line_engine(
    *,
    cylinders: int = 4,
    firing_order: Sequence[int] = (),
    crank: float = 0.045,
    rod: float = 0.15,
    pitch: float = 0.09,
    piston_mass: float = 0.45,
    rod_mass: float = 0.6,
    gas: float = 22e3,
    speed: float = 100 * pi,
    sweep: tuple[float, float] = TWO_TURNS,
    positions: int = 144,
) -> Mechanism:
    """A four-stroke engine with its cylinders in line, which fire evenly in an order.

    `cylinders` in number; `firing_order` names each once and sets the throws of the crank and the phases of the gas
    (default: the usual one). `crank` radius, `rod` length and `pitch`, the distance of the cylinders, in metres; the
    rod's centre is a third of its length from the crank pin. `piston_mass` and `rod_mass` in kg. `gas`: the largest
    force on a piston in N, which falls off as in a petrol engine; 0 for none. `speed` in rad/s, `sweep` in radians.
    All cylinders are drawn on one another; `place` says where each lies along the shaft. What the engine does to its
    frame: dalembert shake; its flywheel: dalembert flywheel --Cs 0.02.

    >>> from dalembert.model.library import in_line_engine
    >>> in_line_engine(cylinders=3).links["piston_3"].place
    0.09
    """
    order = tuple(firing_order) or EVEN_FIRING.get(cylinders, tuple(range(1, cylinders + 1)))
    fires = _firing(order, cylinders)
    return _engine(
        f"In-line engine of {cylinders}", [0.0] * cylinders, [-fire for fire in fires], fires,
        [(k - (cylinders - 1) / 2) * pitch for k in range(cylinders)],
        crank, rod, piston_mass, rod_mass, gas, turning(sweep, positions, speed),
    )  # fmt: skip


def v_engine(
    *,
    cylinders: int = 2,
    angle: float = 90.0,
    throws: Sequence[float] = (),
    crank: float = 0.03,
    rod: float = 0.107,
    pitch: float = 0.0,
    piston_mass: float = 0.5,
    rod_mass: float = 0.0,
    gas: float = 0.0,
    speed: float = 200 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """Cylinders in two banks at an angle, lines at half of it either side of x; two rods on each throw.

    `cylinders` in number, even; `angle` between the banks in degrees; `throws`: angles of the crank's throws in degrees
    (default: evenly spread over a turn). `crank` radius, `rod` length and `pitch`, the distance of the throws, in
    metres; the rod's centre is a third of its length from the crank pin. `piston_mass` and `rod_mass` in kg. `gas`: the
    largest force on a piston in N, 0 for none; each cylinder fires at a different dead centre, every other throw a turn
    later. `speed` in rad/s, `sweep` in radians. Shaking forces on its frame: dalembert shake; counterweight of its
    crank: dalembert balance --on crank.

    >>> from dalembert.model.library import v_engine
    >>> sorted(v_engine().joints)[:3]
    ['A_1', 'A_2', 'B_1']
    """
    if cylinders % 2:
        raise ModelError(f"v_engine: {cylinders} cylinders are not pairs", "give an even number")
    count = cylinders // 2
    angles = list(throws) or [360.0 * k / count for k in range(count)]
    if len(angles) != count:
        what = f"v_engine: the number of throws is {len(angles)}, that of pairs of cylinders {count}"
        raise ModelError(what, "give one a pair")
    lines = [angle / 2, -angle / 2] * count
    each = [t for t in angles for _ in range(2)]
    fires = [
        (line - t) % 360 + 360 * (k // 2 % 2) for k, (line, t) in enumerate(zip(lines, each, strict=True))
    ]
    places = [(k // 2 - (count - 1) / 2) * pitch for k in range(cylinders)]
    title = f"V engine of {cylinders} at {angle:g} deg"
    drive = turning(sweep, positions, speed)
    return _engine(title, lines, each, fires, places, crank, rod, piston_mass, rod_mass, gas, drive)


def radial_engine(
    *,
    cylinders: int = 5,
    crank: float = 0.06,
    rod: float = 0.24,
    piston_mass: float = 1.0,
    rod_mass: float = 0.0,
    gas: float = 0.0,
    speed: float = 80 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """Cylinders in a star, all rods on one crank pin.

    `cylinders` in number, their lines evenly spread over a turn; an odd number fires every other one, evenly over two
    turns. `crank` radius and `rod` length in metres; the rod's centre is a third of its length from the crank pin, and
    every rod is on the pin itself, not on a master rod. `piston_mass` and `rod_mass` in kg. `gas`: the largest force on
    a piston in N, 0 for none. `speed` in rad/s, `sweep` in radians. What the engine does to its frame: dalembert shake;
    the counterweight of its crank: dalembert balance --on crank. The primary forces turn with the crank, the secondary
    ones of three cylinders against it.

    >>> from dalembert.model.library import radial_engine
    >>> radial_engine(cylinders=3).joints["cylinder_2"].type
    'slider'
    """
    lines = [360.0 * k / cylinders for k in range(cylinders)]
    fires = [line + 360 * (k % 2) for k, line in enumerate(lines)]
    drive = turning(sweep, positions, speed)
    none = [0.0] * cylinders
    title = f"Radial engine of {cylinders}"
    return _engine(title, lines, none, fires, none, crank, rod, piston_mass, rod_mass, gas, drive)


def _firing(order: Sequence[int], cylinders: int) -> list[float]:
    """Degrees of the crank at which each cylinder fires, evenly over two turns."""
    if sorted(order) != list(range(1, cylinders + 1)):
        raise ModelError(
            f"firing order {tuple(order)} of {cylinders} cylinders", "name each once: (1, 3, 4, 2)"
        )
    return [720.0 * order.index(k + 1) / cylinders for k in range(cylinders)]


def _engine(
    title: str,
    lines: Sequence[float],
    throws: Sequence[float],
    fires: Sequence[float],
    places: Sequence[float],
    crank: float,
    rod: float,
    piston_mass: float,
    rod_mass: float,
    gas: float,
    drive: Tree,
) -> Mechanism:
    positive("engine", crank=crank, rod=rod)
    positive("engine", "kg", piston_mass=piston_mass)
    if rod <= crank:
        raise ModelError(
            f"the rod of {rod:g} m is no longer than the crank of {crank:g} m", "give a longer rod"
        )
    points: Tree = {"O": [0.0, 0.0]}
    links: Tree = {
        "ground": {"points": {"O": [0.0, 0.0]}},
        "crank": {"points": points, "mass": 5.0, "inertia": 0.02},
    }
    joints: Tree = {"O": pin("ground", "crank")}
    loads: Tree = {}
    assembly: Tree = {}
    for k, (line, throw) in enumerate(zip(lines, throws, strict=True), 1):
        turned = throw % 360
        points[f"A_{k}"] = f"{crank!r} @ {turned!r}"
        placed = {"place": places[k - 1]} if places[k - 1] else {}
        inertia = rod_mass * rod**2 / 12
        links[f"rod_{k}"] = {
            "points": {f"A_{k}": [0.0, 0.0], f"B_{k}": [rod, 0.0]}, "mass": rod_mass, "center": [rod / 3, 0.0],
            "inertia": inertia, **placed,
        }  # fmt: skip
        links[f"piston_{k}"] = {"points": {f"B_{k}": [0.0, 0.0]}, "mass": piston_mass, **placed}
        joints |= {
            f"A_{k}": pin("crank", f"rod_{k}"),
            f"B_{k}": pin(f"rod_{k}", f"piston_{k}"),
            f"cylinder_{k}": slider("ground", f"piston_{k}", ("O", f"B_{k}"), line),
        }
        assembly[f"rod_{k}"] = line
        if gas:
            loads[f"gas_{k}"] = {
                "type": "force", "on": f"piston_{k}", "at": f"B_{k}", "by": "ground", "direction": line + 180,
                "value": _pressure(gas, fires[k - 1]),
            }  # fmt: skip
    return build_mechanism(
        title, links=links, joints=joints, drives={"O": drive}, loads=loads, assembly=assembly
    )


def _pressure(gas: float, fire: float) -> Tree:
    """The table of the gas force of a cylinder that fires at an angle (degrees), over two turns from 0."""
    rows = sorted(((x + fire) % 720, gas * y) for x, y in zip(*GAS, strict=True) if x < 720)
    if rows[0][0] > 0:  # a row at 0, between the last and the first
        (x, y), (u, v) = rows[-1], rows[0]
        rows.insert(0, (0.0, y + (v - y) * (720 - x) / (u + 720 - x)))
    rows.append((720.0, rows[0][1]))
    return {"against": "O", "periodic": "720 deg", "x": [x for x, _ in rows], "y": [y for _, y in rows]}
