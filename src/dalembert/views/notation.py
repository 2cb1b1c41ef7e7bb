"""Notation of the reader: names of links and forces, units, figures."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from dalembert import unit_names
from dalembert.analysis.output.rounding import least
from dalembert.analysis.output.summary.printed_units import Printed, print_scale
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Numeric
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.methods.applied_forces import Action
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class Notation:
    """Signs and figures of drawings and reports.

    ``links``: by number (ground is 1) or name. ``order``: F_ij by i on j (`by-on`), or on i by j (`on-by`).
    ``letter``: F, or G as METU writes joint forces. ``units``: those of the file, or SI. ``figures``: significant
    figures; ``decimals`` instead where given. ``torque``: 1 where counter-clockwise is positive, -1 where
    clockwise is. ``axes``: components in ground axes, or in each link's local axes (LRCS).

    >>> Notation(letter="G", order="on-by", figures=4).letter
    'G'
    """

    links: Literal["number", "name"] = "number"
    order: Literal["by-on", "on-by"] = "by-on"
    letter: str = "F"
    units: Literal["file", "SI"] = "file"
    figures: int = 4
    decimals: int | None = None
    torque: int = 1
    axes: Literal["ground", "link"] = "ground"
    scaled: ClassVar[bool] = True
    """True if the largest number of the answer decides a unit's power of ten: kN for N."""

    def number(self, value: float) -> str:
        """A number as text.

        >>> Notation().number(243.23759), Notation(decimals=2).number(243.23759), Notation().number(-0.0)
        ('243.2', '243.24', '0')
        """
        if not math.isfinite(value):
            return "-"
        if self.decimals is not None:
            return f"{value + 0.0:.{self.decimals}f}".replace("-", "−")
        if value == 0:
            return "0"
        power = self._power(value)
        if power < -4 or power > 6:
            return f"{value:.{self.figures - 1}e}".replace("-", "−")
        return f"{value:.{max(self.figures - 1 - power, 0)}f}".replace("-", "−")

    def _power(self, value: float) -> int:
        """Power of ten of a number's leading digit after rounding."""
        return math.floor(math.log10(abs(float(f"{value:.{self.figures}g}"))))

    def degrees(self, angle: float) -> str:
        """An angle (rad) in degrees, with as many decimals as make it as accurate as a length with the same figures,
        and never fewer figures than requested; rounding errors next to a radian become 0.

        >>> [Notation().degrees(x) for x in (2.4011, 0.0015, -1e-16)], Notation(figures=7).degrees(2.4011)
        (['137.57', '0.08594', '0'], '137.57290')
        """
        if not math.isfinite(angle):
            return "-"
        degrees = math.degrees(angle)
        if self.decimals is not None:
            return self.number(degrees)
        if abs(angle) < 1e-12:
            return "0"
        power = self._power(degrees)
        if power < -4:
            return self.number(degrees)
        return f"{degrees:.{max(self.figures - 2, self.figures - 1 - power)}f}".replace("-", "−")

    def direction(self, x: float, y: float) -> str:
        """Direction of a vector in degrees; a component at rounding level next to the other counts as zero.

        >>> Notation().direction(-3.0, -1e-16), Notation().direction(0.0, -2.0)
        ('180.00', '−90.00')
        """
        size = 1e-12 * math.hypot(x, y)
        x, y = (0.0 if abs(c) <= size else c for c in (x, y))
        return self.degrees(math.atan2(y, x))

    def given(self, value: float) -> str:
        """A plain number of the file, with all its figures up to six, or up to the requested number.

        >>> Notation().given(0.15), Notation().given(1.0015)
        ('0.15', '1.0015')
        """
        return f"{value:.{max(6, self.figures)}g}".replace("-", "−")

    def percent(self, share: float) -> str:
        """A share in percent.

        >>> Notation().percent(0.0003), Notation().percent(0.9997)
        ('0.03000 %', '99.97 %')
        """
        return f"{self.number(100 * share)} %"


class Figures:
    """Numbers and units in a notation; ``units`` are the reader's. ``least``: rounding level by kind (SI)."""

    def __init__(self, units: object, notation: Notation) -> None:
        self.notation = notation
        self.least: Mapping[str, float] = defaultdict(float)
        self.scale = Printed(None if notation.units == "SI" else units)

    def unit(self, kind: str) -> str:
        """Unit of a kind as the reader writes it: N·m."""
        return pretty(self.scale.text(kind))

    def value(self, kind: str, value: float) -> float:
        """An SI number in the reader's unit."""
        return float(self.values(kind, value))

    def values(self, kind: str, values: Numeric) -> Numeric:
        """SI numbers in the reader's unit."""
        return (self.notation.torque if kind == "moment" else 1) * self.scale(kind, values)

    def size(self, kind: str) -> float:
        """Size in SI of the reader's unit of a kind."""
        return 1.0 / abs(self.value(kind, 1.0))

    def number(self, kind: str, value: float, floor: float = 0.0) -> str:
        """The number in the reader's unit; rounding noise, or what is below ``floor`` (SI), is 0."""
        value = 0.0 if abs(value) < max(floor, self.least.get(kind, 0.0)) else value
        if kind == "angle" and self.unit(kind) == "°":
            return self.notation.degrees(value)
        return self.notation.number(self.value(kind, value))

    @property
    def arm(self) -> float:
        """SI size of the length that multiplies a force to give a moment, all in the reader's units."""
        return self.size("moment") / self.size("force")

    @property
    def arm_unit(self) -> str:
        """Unit of lever arms: that of lengths, unless moments have a separate unit."""
        if math.isclose(self.arm, self.size("length"), rel_tol=1e-9):
            return self.unit("length")
        names = ("m", "mm", "cm", "in", "ft")
        known = (n for n in names if math.isclose(unit_names.unit(n).si(1.0), self.arm, rel_tol=1e-9))
        return next(known, f"{self.unit('moment')}/{self.unit('force')}")

    def factor(self, kind: str, *of: str) -> float:
        """Factor that converts a product of numbers in the reader's units into the reader's unit of a kind; 1 where
        they agree.

        With mm, kg and N it is 0.001 from a mass times an acceleration to a force, as 1 N = 1000 kg mm/s2.
        """
        ratio = math.prod(map(self.size, of)) / self.size(kind)
        return 1.0 if math.isclose(ratio, 1.0, rel_tol=1e-9) else ratio

    def with_factor(self, numbers: str, kind: str, *of: str) -> str:
        """A product in the reader's units, followed by the conversion factor if needed: '−2 (−10, 4) / 1000'."""
        return self._with_factor(numbers, self.factor(kind, *of))

    def _with_factor(self, numbers: str, factor: float) -> str:
        if math.isclose(factor, 1.0, rel_tol=1e-9):
            return numbers
        if factor < 1:
            return f"{numbers} / {self.conversion(1 / factor)}"
        return f"{numbers} cdot {self.conversion(factor)}"

    def conversion(self, factor: float) -> str:
        """A factor between units as printed in a formula: 1000, 32.17, 10^{9}."""
        integer, power = round(factor), round(math.log10(factor))
        if power > 5 and math.isclose(factor, 10.0**power, rel_tol=1e-9):
            return f"10^{{{power}}}"
        return str(integer) if math.isclose(factor, integer, rel_tol=1e-9) else self.notation.number(factor)

    def text(self, kind: str, value: float, floor: float = 0.0) -> str:
        """The number with its unit."""
        number = self.number(kind, value, floor)
        return _with_gap(number, self._unit_behind(number, kind))

    def with_unit(self, number: str, kind: str, behind: str = "") -> str:
        """A number with its unit as printed in a formula."""
        return f'{number} "{self._unit_behind(number, kind)}{behind}"'

    def _unit_behind(self, number: str, kind: str) -> str:
        """Unit after a number; after 0 without a power of ten."""
        unit = self.unit(kind)
        return unit.partition(" ")[2] if number == "0" and unit.startswith("10") else unit

    def plain(self, kind: str, value: float) -> str:
        """A round number with its unit, as on a scale."""
        return _with_gap(f"{self.value(kind, value):.6g}", self.unit(kind))

    def polar(self, vector: tuple[float, float], kind: str = "force") -> str:
        """A vector as magnitude and direction."""
        return f"{self.text(kind, math.hypot(*vector))} ∠ {self.notation.direction(*vector)}°"

    def symbol(self, a: Action) -> str:
        """Symbol of an action: its name."""
        return load_sign(a.of)


def _with_gap(number: str, unit: str) -> str:
    return f"{number}{'' if unit == '°' else '·' if unit.startswith('10') else ' '}{unit}".strip()


class Shown(Figures):
    """Numbers, units and symbols of one result in a notation; at position k, values below rounding level are 0."""

    def __init__(self, r: Result, notation: Notation, k: int | None = None) -> None:
        super().__init__(r.mechanism.units, notation)
        if notation.scaled:
            self.scale = print_scale(r, notation.units)
        self.r = r
        self.least = least(r, k) if k is not None else self.least
        self.order = (GROUND, *r.links)

    def link(self, link: str) -> str:
        """A link's number or name."""
        return self._signs[link]

    @cached_property
    def _signs(self) -> dict[str, str]:
        """Sign of each link: its name if that is a number, else its place in the order; names where two agree."""
        names = {link: link for link in self.order}
        if self.notation.links == "name":
            return names
        numbered = {link for link in self.order if re.fullmatch(r"\d+", link)}
        signs = {n: n if n in numbered else str(k) for k, n in enumerate(self.order, 1)}
        return signs if len(set(signs.values())) == len(signs) else names

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
        """Index of a joint's action on a link, with the joint's name where another joint or load has the same index."""
        i, j = self.r.mechanism.joints[joint].links
        twin = [n for n, d in self.r.mechanism.joints.items() if set(d.links) == {i, j}]
        pair = self.pair(i if on == j else j, on)
        pairs = (self.pair(i, j), self.pair(j, i))
        signs = {f"{letter}_{{{p}}}" for letter in (self.notation.letter, "M") for p in pairs}
        loads = signs & {load_sign(n) for n in self.r.mechanism.loads}
        return pair + (f",{joint}" if len(twin) > 1 or loads else "")

    def symbol(self, a: Action) -> str:
        """Symbol of an action: F_{12}, T_{12}, W_{3}, F_{I3}, T_{I3}, D_{A} of damping, or the load's name."""
        turning = not np.nan_to_num(a.force).any()
        if a.kind == "joint":
            return self._part(self.reaction(a.of, a.link), a.part)
        if a.kind == "effort":
            extra = f"{'' if turning else ',d'}{self._drive(a)}"
            return f"{'T' if turning else 'F'}_{{{self.pair(a.by or GROUND, a.link)}{extra}}}"
        if a.kind == "friction":
            pulls = hasattr(self.r.mechanism.joints.get(a.of), "stated_tension")  # a belt's, not friction
            index = f"{'0,' if pulls else 'f'}{self.between(a.of, a.link)}"
            return f"{'M' if turning else self.notation.letter}_{{{index}}}"
        if a.kind == "damper" and a.of in self.r.joints:
            return f"D_{{{a.of}}}"
        if a.kind == "weight":
            return f"W_{{{self.link(a.link)}}}"
        if a.kind == "inertia":
            return f"{'T' if turning else 'F'}_{{I{self.link(a.link)}}}"
        return load_sign(a.of)

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
        """Name of a drive, where another drive acts in the same direction between the same links."""
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


def load_sign(name: str) -> str:
    """A load's name as a symbol: F_P gives F_{P}, T4 gives T_{4}.

    >>> load_sign("F_P"), load_sign("T_4"), load_sign("F2"), load_sign("gas")
    ('F_{P}', 'T_{4}', 'F_{2}', 'gas')
    """
    if match := re.fullmatch(r"([A-Za-z]+)_(\w+)", name):
        return f"{match[1]}_{{{match[2]}}}"
    if match := re.fullmatch(r"([A-Z])(\d\w*)", name):
        return f"{match[1]}_{{{match[2]}}}"
    return name


def pretty(unit: str) -> str:
    """A unit as it is printed: lbf*in*s^2 gives lbf·in·s².

    >>> pretty("lbf*in*s^2"), pretty("deg"), pretty("10^6 lbf")
    ('lbf·in·s²', '°', '10⁶ lbf')
    """
    raised = re.sub(r"\^\{?(-?\d+)\}?", lambda m: m[1].translate(SUPERSCRIPTS), unit)
    return raised.replace("*", "·").replace("deg", "°")


SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
