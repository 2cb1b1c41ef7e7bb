"""Mechanisms of one loop: four-bar, slider-cranks, inverted slider-crank, Scotch yoke."""

from __future__ import annotations

from cmath import phase
from math import asin, degrees, pi
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.model.library.compass import FULL_TURN, Points, angle, meet, reach, start_points, vector_at
from dalembert.model.library.tree_parts import (
    block,
    build_mechanism,
    couple,
    force,
    pin,
    positive,
    slender,
    slider,
    slot,
    slot_holds,
    turning,
)

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def four_bar(
    *,
    ground: float = 0.3,
    crank: float = 0.09,
    coupler: float = 0.3,
    rocker: float = 0.24,
    torque: float = -10.0,
    mass_per_length: float = 2.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""A four-bar linkage: the crank turns, the rocker swings against a torque.

    ::

                     ___________ B
              A ____/  coupler    \
         crank /                   \ rocker
            O2 ---- ground -------- O4

    Lengths in metres between pins; `torque` in N m on the rocker, counter-clockwise positive; links are uniform and
    slender, `mass_per_length` in kg/m; `speed` of the crank in rad/s; `sweep` of its angle in radians; `positions`
    in it. B is on the left of the way from A to O4. Raises ModelError where the four lengths do not close along the
    sweep.

    >>> from dalembert.model.library import four_bar
    >>> sorted(four_bar(crank=0.06).links)
    ['coupler', 'crank', 'ground', 'rocker']
    """
    positive("four_bar", ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    positive("four_bar", "kg/m", mass_per_length=mass_per_length)

    def place(turn: float) -> Points:
        a = vector_at(crank, turn)
        return {"A": a, "B": meet(a, ("coupler", coupler), ground, ("rocker", rocker)), "O4": complex(ground)}

    at = start_points("four_bar", place, sweep)
    return build_mechanism(
        "Four-bar linkage",
        links={
            "ground": {"points": {"O2": [0.0, 0.0], "O4": [ground, 0.0]}},
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "coupler": slender(mass_per_length, A=0.0, B=coupler),
            "rocker": slender(mass_per_length, O4=0.0, B=rocker),
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": pin("crank", "coupler"),
            "B": pin("coupler", "rocker"),
            "O4": pin("ground", "rocker"),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"torque": couple("rocker", torque)},
        assembly={"coupler": angle(at, "A", "B"), "rocker": angle(at, "O4", "B")},
    )


def slider_crank(
    *,
    crank: float = 0.06,
    rod: float = 0.24,
    offset: float = 0.0,
    load: float = -2000.0,
    piston_mass: float = 0.6,
    mass_per_length: float = 2.0,
    speed: float = 100 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """A slider-crank, the mechanism of engines, pumps and compressors; offset if wanted.

    ::

              A
        crank/   ----____ rod
           O2            ----____ B
           ......................[piston]...  y = offset

    `crank`, `rod` and `offset` (the height of the piston's line above O2) in metres; `load` on the piston in N,
    along x; `piston_mass` in kg; crank and rod are uniform and slender, `mass_per_length` in kg/m; `speed` of the
    crank in rad/s (100 pi is 3000 rpm); `sweep` in radians. The piston is on the right of O2. Raises ModelError
    where the rod does not reach the piston's line.

    >>> from dalembert.model.library import slider_crank
    >>> slider_crank(offset=0.03).joints["guide"].type
    'slider'
    """
    positive("slider_crank", crank=crank, rod=rod)
    positive("slider_crank", "kg", mass_per_length=mass_per_length, piston_mass=piston_mass)

    def place(turn: float) -> Points:
        a = vector_at(crank, turn)
        return {"A": a, "B": reach(a, ("rod", rod), 1j * offset)}

    at = start_points("slider_crank", place, sweep)
    return build_mechanism(
        "Slider-crank",
        links={
            "ground": {"points": {"O2": [0.0, 0.0], "C": [0.0, offset]}},
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "rod": slender(mass_per_length, A=0.0, B=rod),
            "piston": {"points": {"B": [0.0, 0.0]}, "mass": piston_mass},
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": pin("crank", "rod"),
            "B": pin("rod", "piston"),
            "guide": slider("ground", "piston", ("C", "B")),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"load": force("piston", "B", (load, 0.0))},
        assembly={"rod": angle(at, "A", "B"), "piston": 0.0},
    )


def inverted_slider_crank(
    *,
    ground: float = 0.24,
    crank: float = 0.09,
    rocker: float = 0.42,
    offset: float = 0.0,
    torque: float = -10.0,
    block_mass: float = 0.3,
    mass_per_length: float = 2.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """A slider-crank turned round: a block on the crank pin slides along an arm that swings about O4.

    ::

                  A [block]  _ _ _ _ _ end of the rocker
            crank /    ------
                O2 ------ O4    the slide passes O4 at the distance `offset`

    `ground` is O2 O4, `rocker` the length of the arm from O4, in metres; with a crank longer than the ground the
    arm goes round. `torque` in N m on the rocker; `block_mass` in kg; arm and crank are uniform and slender,
    `mass_per_length` in kg/m; `speed` in rad/s; `sweep` in radians. Raises ModelError where the block passes O4
    nearer than the offset or leaves the arm.

    >>> from dalembert.model.library import inverted_slider_crank
    >>> inverted_slider_crank().joints["slide"].links
    ('rocker', 'block')
    """
    name = "inverted_slider_crank"
    positive(name, ground=ground, crank=crank, rocker=rocker)
    positive(name, "kg", mass_per_length=mass_per_length, block_mass=block_mass)
    if abs(ground - crank) <= abs(offset) or ground == crank:
        raise ModelError(
            f"{name}: the crank pin passes O4 at {abs(ground - crank):.3g} m, "
            f"not farther than the slide's offset of {abs(offset):g} m",
            "let ground and crank differ by more, or take a smaller offset",
        )
    slot_holds(name, "rocker", rocker, ground + crank)
    lever = vector_at(crank, sweep[0]) - ground
    return build_mechanism(
        "Inverted slider-crank",
        links={
            "ground": {"points": {"O2": [0.0, 0.0], "O4": [ground, 0.0]}},
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "block": block(block_mass, 0.06, A=(0.0, 0.0)),
            "rocker": _slotted(mass_per_length, rocker, offset),
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": pin("crank", "block"),
            "slide": slider("rocker", "block", ("S", "A")),
            "O4": pin("ground", "rocker"),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"torque": couple("rocker", torque)},
        assembly=dict.fromkeys(
            ("rocker", "block"), round(degrees(phase(lever) - asin(offset / abs(lever))), 6)
        ),
    )


def scotch_yoke(
    *,
    crank: float = 0.06,
    load: float = -500.0,
    yoke_mass: float = 1.5,
    mass_per_length: float = 2.0,
    speed: float = 20 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """A Scotch yoke: the crank pin in a slot across the slide moves the yoke as the cosine of its angle.

    ::

              | A|
         crank|/ |=========  yoke, slides along x
            O2|  |

    `crank` in metres; `load` on the yoke in N, along x; `yoke_mass` in kg; the crank is uniform and slender,
    `mass_per_length` in kg/m; `speed` in rad/s; `sweep` in radians.

    >>> from dalembert.model.library import scotch_yoke
    >>> scotch_yoke().joints["A"].type
    'slot'
    """
    positive("scotch_yoke", crank=crank)
    positive("scotch_yoke", "kg", mass_per_length=mass_per_length, yoke_mass=yoke_mass)
    start_points("scotch_yoke", lambda turn: {"A": vector_at(crank, turn)}, sweep)
    return build_mechanism(
        "Scotch yoke",
        links={
            "ground": {"points": {"O2": [0.0, 0.0]}},
            "crank": slender(mass_per_length, O2=0.0, A=crank),
            "yoke": {"points": {"S": [0.0, 0.0]}, "mass": yoke_mass},
        },
        joints={
            "O2": pin("ground", "crank"),
            "A": slot("yoke", "crank", ("S", "A"), 90.0),
            "guide": slider("ground", "yoke", ("O2", "S")),
        },
        drives={"O2": turning(sweep, positions, speed)},
        loads={"load": force("yoke", "S", (load, 0.0))},
        assembly={"yoke": 0.0},
    )


def _slotted(mass_per_length: float, length: float, offset: float) -> dict[str, object]:
    link = slender(mass_per_length, O4=0.0, end=length)
    link["points"]["S"] = [0.0, offset]
    return link
