"""Quick returns: a ram that works slowly one way and comes back fast."""

from __future__ import annotations

from math import asin, degrees, pi
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library.compass import FULL_TURN, Points, angle, reach, start_points, vector_at
from dalembert.model.library.tree_parts import (
    block,
    build_mechanism,
    force,
    pin,
    positive,
    slender,
    slider,
    slot_holds,
    turning,
)

if TYPE_CHECKING:
    from dalembert.model import Mechanism

RAMP = 10.0
"""Degrees of the crank over which the cutting force comes and goes."""


def whitworth(
    *,
    ground: float = 0.06,
    crank: float = 0.12,
    slot: float = 0.21,
    throw: float = 0.09,
    rod: float = 0.36,
    cutting_force: float = 1500.0,
    ram_mass: float = 6.0,
    block_mass: float = 0.3,
    mass_per_length: float = 2.0,
    speed: float = 2 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""Whitworth's quick return: the slotted arm goes right round, unevenly, and its throw drives the ram.

    ::

            A [block]
             \  O2
              \  |
        slot    \O4 ................[ram] D
                  C ----____ rod _--

    `ground` is O2 O4 (O4 below O2) and shorter than `crank`, O2 A; `slot` is the length of the arm from O4 on the
    block's side, `throw` from O4 to C on the other; in metres. The ram slides on the level of O4, to its right;
    `cutting_force` in N resists its slow stroke. Masses in kg, `mass_per_length` in kg/m; `speed` in rad/s; `sweep`
    in radians.

    >>> from dalembert.model.library import whitworth
    >>> list(whitworth().links)
    ['ground', 'crank', 'block', 'arm', 'rod', 'ram']
    """
    positive("whitworth", ground=ground, crank=crank, slot=slot, throw=throw, rod=rod)
    positive("whitworth", "kg", ram_mass=ram_mass, block_mass=block_mass, mass_per_length=mass_per_length)
    if crank <= ground:
        raise ModelError(
            f"whitworth: the crank {crank:g} m is not longer than the ground O2 O4 {ground:g} m, "
            "so the arm would not go round",
            "lengthen the crank, or take the template crank_shaper",
        )
    slot_holds("whitworth", "slot", slot, ground + crank)

    def place(turn: float) -> Points:
        a, o4 = vector_at(crank, turn), -1j * ground
        c = o4 - throw * (a - o4) / abs(a - o4)
        return {"A": a, "O4": o4, "C": c, "D": reach(c, ("rod", rod), o4)}

    at = start_points("whitworth", place, sweep)
    early = degrees(asin(ground / crank))
    return build_mechanism(
        "Whitworth quick return",
        links=_links(ground, crank, -ground, mass_per_length, ram_mass, block_mass)
        | {
            "arm": slender(mass_per_length, C=-throw, O4=0.0, end=slot),
            "rod": slender(mass_per_length, C=0.0, D=rod),
            "ram": {"points": {"D": [0.0, 0.0]}, "mass": ram_mass},
        },
        joints=_joints("arm"),
        drives={"O2": turning(sweep, positions, speed)},
        loads={"cutting": force("ram", "D", _stroke(cutting_force, early), direction=180.0)},
        assembly={
            "block": angle(at, "O4", "A"),
            "arm": angle(at, "O4", "A"),
            "rod": angle(at, "C", "D"),
            "ram": 0.0,
        },
    )


def crank_shaper(
    *,
    ground: float = 0.18,
    crank: float = 0.09,
    lever: float = 0.36,
    rod: float = 0.15,
    height: float = 0.336,
    cutting_force: float = 1500.0,
    ram_mass: float = 6.0,
    block_mass: float = 0.3,
    mass_per_length: float = 2.0,
    speed: float = 2 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    r"""The quick return of a shaping machine: a slotted lever swings about O4 and its end pulls the ram.

    ::

        [ram] D ----- C      level of the ram: `height` above O4
                 rod   \
                        \ A [block]
                  lever  \ / crank
                          \ O2
                           O4

    `ground` is O2 O4 (O4 below O2) and longer than `crank`, O2 A; `lever` is O4 C; in metres. The ram is on the
    left of C; `cutting_force` in N resists its slow stroke, to the left. Masses in kg, `mass_per_length` in kg/m;
    `speed` in rad/s; `sweep` in radians.

    >>> from dalembert.model.library import crank_shaper
    >>> crank_shaper().loads["cutting"].on
    'ram'
    """
    positive("crank_shaper", ground=ground, crank=crank, lever=lever, rod=rod, height=height)
    positive("crank_shaper", "kg", ram_mass=ram_mass, block_mass=block_mass, mass_per_length=mass_per_length)
    if crank >= ground:
        raise ModelError(
            f"crank_shaper: the crank {crank:g} m is not shorter than the ground O2 O4 {ground:g} m, "
            "so the lever would not swing to and fro",
            "shorten the crank, or take the template whitworth",
        )
    slot_holds("crank_shaper", "lever", lever, ground + crank)

    def place(turn: float) -> Points:
        a, o4 = vector_at(crank, turn), -1j * ground
        c = o4 + lever * (a - o4) / abs(a - o4)
        return {"A": a, "O4": o4, "C": c, "D": reach(c, ("rod", rod), o4 + 1j * height, forward=False)}

    at = start_points("crank_shaper", place, sweep)
    early = degrees(asin(crank / ground))
    return build_mechanism(
        "Crank shaper quick return",
        links=_links(ground, crank, height - ground, mass_per_length, ram_mass, block_mass)
        | {
            "lever": slender(mass_per_length, O4=0.0, C=lever),
            "rod": slender(mass_per_length, C=0.0, D=rod),
            "ram": {"points": {"D": [0.0, 0.0]}, "mass": ram_mass},
        },
        joints=_joints("lever"),
        drives={"O2": turning(sweep, positions, speed)},
        loads={"cutting": force("ram", "D", _stroke(cutting_force, early), direction=0.0)},
        assembly={
            "block": angle(at, "O4", "A"),
            "lever": angle(at, "O4", "A"),
            "rod": angle(at, "C", "D"),
            "ram": 0.0,
        },
    )


def _links(
    ground: float, crank: float, level: float, mass_per_length: float, ram_mass: float, block_mass: float
) -> Tree:
    return {
        "ground": {"points": {"O2": [0.0, 0.0], "O4": [0.0, -ground], "G": [0.0, level]}},
        "crank": slender(mass_per_length, O2=0.0, A=crank),
        "block": block(block_mass, 0.06, A=(0.0, 0.0)),
    }


def _joints(arm: str) -> Tree:
    return {
        "O2": pin("ground", "crank"),
        "A": pin("crank", "block"),
        "slide": slider(arm, "block", ("O4", "A")),
        "O4": pin("ground", arm),
        "C": pin(arm, "rod"),
        "D": pin("rod", "ram"),
        "guide": slider("ground", "ram", ("G", "D")),
    }


def _stroke(value: float, early: float) -> Tree:
    """The force while the crank goes from `early` degrees before 0 to as much past 180, nothing on the way back."""
    ends = [0.0, 180 + early - RAMP, 180 + early, 360 - early, 360 - early + RAMP, 360.0]
    return {"against": "O2", "x": ends, "y": [value, value, 0.0, 0.0, value, value], "periodic": True}
