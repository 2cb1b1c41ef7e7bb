"""How the reader writes: names of links and forces, units, figures."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.columns import Scale, drive_kinds

if TYPE_CHECKING:
    from dalembert.analysis.actions import Action
    from dalembert.analysis.result import Result

GROUND = "ground"
RADIANS = {"angular_speed": "rad/s", "angular_acceleration": "rad/s^2"}
"""Angular rates have no bare unit in a file; they are shown in radians."""


@dataclass(frozen=True)
class Notation:
    """Signs and figures of drawings and reports.

    ``links``: by number (ground is 1) or name. ``order``: F_ij by i on j (`by-on`), or on i by j (`on-by`).
    ``letter``: F, or G as METU writes joint forces. ``units``: those of the file, or SI. ``figures``: significant
    figures; ``decimals`` in their place where given. ``torque``: 1 where counter-clockwise is positive, -1 where
    clockwise is. ``axes``: components in ground axes, or in each link's own (LRCS).
    """

    links: Literal["number", "name"] = "number"
    order: Literal["by-on", "on-by"] = "by-on"
    letter: str = "F"
    units: Literal["file", "SI"] = "file"
    figures: int = 4
    decimals: int | None = None
    torque: int = 1
    axes: Literal["ground", "link"] = "ground"

    def number(self, value: float) -> str:
        """A number for show.

        >>> Notation().number(243.23759), Notation(decimals=2).number(243.23759), Notation().number(-0.0)
        ('243.2', '243.24', '0')
        """
        if not math.isfinite(value):
            return "-"
        if self.decimals is not None:
            return f"{value + 0.0:.{self.decimals}f}".replace("-", "−")
        if value == 0:
            return "0"
        power = math.floor(math.log10(abs(float(f"{value:.{self.figures}g}"))))
        if power < -4 or power > 6:
            return f"{value:.{self.figures - 1}e}".replace("-", "−")
        return f"{value:.{max(self.figures - 1 - power, 0)}f}".replace("-", "−")


class Figures:
    """Numbers and units in a notation; ``units`` are the reader's own."""

    def __init__(self, units: object, notation: Notation) -> None:
        self.notation = notation
        self.scale = Scale(None if notation.units == "SI" else units)

    def unit(self, kind: str) -> str:
        """Unit of a kind as the reader writes it: N·m."""
        return pretty(RADIANS.get(kind) or self.scale.text(kind))

    def value(self, kind: str, value: float) -> float:
        """An SI number in the reader's unit."""
        sign = self.notation.torque if kind == "moment" else 1
        return sign * float(value if kind in RADIANS else self.scale(kind, value))

    def size(self, kind: str) -> float:
        """Size in SI of the reader's unit of a kind."""
        return 1.0 / abs(self.value(kind, 1.0))

    def number(self, kind: str, value: float, floor: float = 0.0) -> str:
        """The number in the reader's unit; rounding noise below ``floor`` (SI) is 0."""
        return self.notation.number(self.value(kind, 0.0 if abs(value) < floor else value))

    def text(self, kind: str, value: float, floor: float = 0.0) -> str:
        """The number with its unit."""
        unit = self.unit(kind)
        gap = "" if unit == "°" else " "
        return f"{self.number(kind, value, floor)}{gap}{unit}".strip()

    def plain(self, kind: str, value: float) -> str:
        """A round number with its unit, as a scale has."""
        return f"{self.value(kind, value):.6g} {self.unit(kind)}"

    def polar(self, force: tuple[float, float]) -> str:
        """A vector as magnitude and direction."""
        size, angle = math.hypot(*force), math.degrees(math.atan2(force[1], force[0]))
        return f"{self.text('force', size)} ∠ {angle:.2f}°".replace("-", "−")

    def symbol(self, a: Action) -> str:
        """Sign of an action: its own name."""
        return own_name(a.of)


class Shown(Figures):
    """Numbers, units and symbols of one result in a notation."""

    def __init__(self, r: Result, notation: Notation) -> None:
        super().__init__(r.mechanism.units, notation)
        self.r = r
        self.order = (GROUND, *r.links)

    def link(self, link: str) -> str:
        """A link's number or name."""
        if self.notation.links == "name":
            return link
        if re.fullmatch(r"\d+", link) or all(re.fullmatch(r"\d+", n) for n in self.r.links):
            return "1" if link == GROUND and "1" not in self.r.links else link
        return str(self.order.index(link) + 1)

    def heading(self, link: str) -> str:
        """A link as a heading: 2 crank."""
        number = self.link(link)
        return link if number == link else f"{number} {link}"

    def pair(self, by: str, on: str) -> str:
        """Index of a force by one link on another."""
        first, second = (by, on) if self.notation.order == "by-on" else (on, by)
        signs = [self.link(first), self.link(second)]
        return ("," if any(len(sign) > 1 for sign in signs) else "").join(signs)

    def reaction(self, joint: str, on: str) -> str:
        """Sign of a joint's force on a link: F_{12}."""
        return f"{self.notation.letter}_{{{self.between(joint, on)}}}"

    def between(self, joint: str, on: str) -> str:
        """Index of what a joint does to a link, with its name where another joint is between the same links."""
        i, j = self.r.mechanism.joints[joint].links
        twin = [n for n, d in self.r.mechanism.joints.items() if set(d.links) == {i, j}]
        return self.pair(i if on == j else j, on) + (f",{joint}" if len(twin) > 1 else "")

    def symbol(self, a: Action) -> str:
        """Sign of an action: F_{12}, T_{12}, W_{3}, F_{I3}, T_{I3}, D_{A} of damping, or the load's own name."""
        turning = not np.nan_to_num(a.force).any()
        if a.kind == "joint":
            return self._part(self.reaction(a.of, a.link), a.part)
        if a.kind == "effort":
            extra = f"{'' if turning else ',d'}{self._drive(a)}"
            return f"{'T' if turning else 'F'}_{{{self.pair(a.by or GROUND, a.link)}{extra}}}"
        if a.kind == "friction":
            return f"{'M' if turning else self.notation.letter}_{{f{self.between(a.of, a.link)}}}"
        if a.kind == "damper" and a.of in self.r.joints:
            return f"D_{{{a.of}}}"
        if a.kind == "weight":
            return f"W_{{{self.link(a.link)}}}"
        if a.kind == "inertia":
            return f"{'T' if turning else 'F'}_{{I{self.link(a.link)}}}"
        return own_name(a.of)

    def _part(self, sign: str, part: str) -> str:
        """N_{14} for the normal part of F_{14}; F_{14,ahead} at a corner."""
        if part == "normal":
            return "N" + sign.removeprefix(self.notation.letter)
        return f"{sign[:-1]},{part}}}" if part else sign

    def effort(self, a: Action) -> str:
        """Sign of a drive's effort: T_{12}, or F_{14,d}, also where it is zero."""
        kind = drive_kinds(self.r, a.of)["effort"]
        return self.symbol(replace(a, force=np.full_like(a.force, kind == "force")))

    def _drive(self, a: Action) -> str:
        """The name of a drive where another one acts in the same way between the same links."""
        links = {a.link, a.by or GROUND}
        kind = drive_kinds(self.r, a.of)["effort"]
        m = self.r.mechanism
        twins = [
            d
            for d in self.r.drives
            if set(m.joints[m.drives[d].joint or d].links) == links
            and drive_kinds(self.r, d)["effort"] == kind
        ]
        return f",{a.of}" if len(twins) > 1 else ""

    def turning_symbol(self, a: Action) -> str:
        """Sign of an action's couple: M_{14} of a joint, T_{12} of a drive."""
        if a.kind == "joint":
            return self.joint_moment(a.of, a.link)
        return self.symbol(replace(a, force=np.zeros_like(a.force)))

    def joint_moment(self, joint: str, on: str) -> str:
        """Sign of a joint's couple on a link: M_{14}."""
        return f"M_{{{self.between(joint, on)}}}"


def along(sign: str, axis: str) -> str:
    """The sign of a vector's component along an axis.

    >>> along("F_{12}", "x"), along("F_{12,A}", "x'"), along("gas", "z")
    ('F_{12x}', "F_{12,A,x'}", 'gas_{z}')
    """
    head, _, index = sign.partition("_{")
    index = index.rstrip("}")
    return f"{head}_{{{index}{',' if ',' in index else ''}{axis}}}"


def own_name(name: str) -> str:
    """A load's own name as a sign: F_P gives F_{P}, T4 gives T_{4}.

    >>> own_name("F_P"), own_name("T_4"), own_name("F2"), own_name("gas")
    ('F_{P}', 'T_{4}', 'F_{2}', 'gas')
    """
    if match := re.fullmatch(r"([A-Za-z]+)_(\w+)", name):
        return f"{match[1]}_{{{match[2]}}}"
    if match := re.fullmatch(r"([A-Z])(\d\w*)", name):
        return f"{match[1]}_{{{match[2]}}}"
    return name


def pretty(unit: str) -> str:
    """A unit as it is printed: lbf*in*s^2 gives lbf·in·s².

    >>> pretty("lbf*in*s^2"), pretty("deg")
    ('lbf·in·s²', '°')
    """
    return unit.replace("*", "·").replace("^2", "²").replace("^3", "³").replace("deg", "°")
