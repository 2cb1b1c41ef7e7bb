"""The table of pairs: what each type of joint in space carries, how it moves, and what describes its friction.

Mechanics: docs/theory.md 2.2.
"""

from __future__ import annotations

from typing import NamedTuple

AXES = "xyz"


class Pair(NamedTuple):
    """Local axes along which a joint carries forces, and about which moments; how j slides and turns in i.

    slides: axes of i, in the order of the freedoms; turns: axes about which j's axes are those of i turned one after
    the other, the first fixed in i, a second one in j, all three of a ball; local: what the axes are, in words.
    """

    forces: str
    moments: str
    slides: str = ""
    turns: str = ""
    local: str = ""
    main: str = "x"
    """The local axis that the short form `axis` means."""
    friction: tuple[str, ...] = ()
    """Keys of its friction beside the coefficients; of a pair without any, friction is not analysed."""
    radius: str = ""
    """Part whose radius its friction needs."""
    threaded: bool = False
    """It advances by a lead as it turns: with the force along its axis comes a couple."""
    pins: bool = False
    """Its axes are given by two pins, z of each link."""

    @property
    def reactions(self) -> tuple[str, ...]:
        """Forces, then moments: Fx, Fy, Mz."""
        return (*(f"F{a}" for a in self.forces), *(f"M{a}" for a in self.moments))

    @property
    def ball(self) -> bool:
        """True if it can turn about any axis."""
        return len(self.turns) == 3

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Freedoms that a drive can prescribe, slides first but in a screw; the turn of a ball needs an `axis`."""
        if self.threaded:
            return ("turn", "slide")
        slides = ("slide",) if len(self.slides) == 1 else ("slide1", "slide2")[: len(self.slides)]
        return (*slides, *(("turn1", "turn2") if len(self.turns) == 2 else ("turn",)[: len(self.turns)]))

    @property
    def damped(self) -> tuple[str, ...]:
        """Freedoms that can be damped: for a ball its slides, because it has no fixed axis of turning.

        >>> PAIRS["sphere_in_cylinder"].damped
        ('slide',)
        """
        return tuple(f for f in self.freedoms if not self.ball or f.startswith("slide"))


PAIRS: dict[str, Pair] = {
    "weld": Pair("xyz", "xyz", local="any"),
    "revolute": Pair(
        "xyz",
        "xy",
        turns="z",
        local="z along the axis",
        main="z",
        friction=("radius", "circle", "guide", "thrust_radius"),
        radius="journal",
    ),
    "prismatic": Pair("yz", "xyz", slides="x", local="x along the slide", friction=("guide",)),
    "screw": Pair(
        "xyz",
        "yz",
        turns="x",
        local="x along the axis; with Fx comes Mx = -lead Fx / 2 pi",
        friction=("radius", "thread_angle"),
        radius="thread, the mean one",
        threaded=True,
    ),
    "cylindrical": Pair(
        "yz", "yz", slides="x", turns="x", local="x along the axis", friction=("radius", "circle", "guide")
    ),
    "universal": Pair(
        "xyz", "x", turns="yz", local="y the pin of i, z the pin of j, x across both", pins=True
    ),
    "spherical": Pair("xyz", "", turns="xyz", local="any", friction=("radius", "circle"), radius="ball"),
    "plane": Pair("x", "yz", slides="yz", turns="x", local="x across the plane"),
    "sphere_between_planes": Pair("x", "", slides="yz", turns="xyz", local="x across the planes"),
    "sphere_in_cylinder": Pair("yz", "", slides="x", turns="xyz", local="x along the cylinder"),
    "cylinder_between_planes": Pair(
        "x", "y", slides="yz", turns="xz", local="x across the planes, z along the cylinder"
    ),
    "slotted_sphere": Pair("xyz", "x", turns="yz", local="x the blocked turn (another: blocked)"),
    "torus": Pair("xyz", "x", turns="yz", local="x the blocked turn"),
    "slotted_cylinder": Pair("yz", "xy", slides="x", turns="z", local="x along the slot, z along the pin"),
    "slotted_sphere_in_cylinder": Pair(
        "yz",
        "x",
        slides="x",
        turns="yz",
        local="x along the cylinder, the blocked turn (another: blocked)",
    ),
}
"""The classic table; ``blocked`` of a slotted sphere turns the local axes of its moment and turns."""

TEETH = Pair("", "", local="x radial, y tangential, z along the axis of i")
"""Pair of a gear: one force, along none of its local axes."""


def freedoms_of(kind: str) -> tuple[str, ...]:
    """The freedoms of a type of joint in space, none of an unknown one."""
    return PAIRS[kind].freedoms if kind in PAIRS else ()
