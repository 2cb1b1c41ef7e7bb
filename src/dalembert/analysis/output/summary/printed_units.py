"""The units of what is printed and drawn, and what of its numbers is nothing but rounding."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.rounding import PART, largest, sizes
from dalembert.analysis.result.kept import kept
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind
from dalembert.answer.column import Scale, UnitChoice
from dalembert.arrays import Array, Numeric, Tree
from dalembert.printing import number
from dalembert.units import KINDS

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class Printed(Scale):
    """The units of the file; angular rates for which it gives no unit, in radians; powers and energies in W and J where
    its forces and lengths are metric and it gives no unit of them.

    ``powers``: kind -> power of ten that its unit has with it, as kN or 10^3 lbf.

    >>> to = Printed(None, {"force": 6})
    >>> to.text("force"), to("force", -7304020.0)
    ('MN', -7.30402)
    >>> Printed({"length": "mm"}).quantity("power", 250.0), Printed({"length": "in", "force": "lbf"}).text("energy")
    ('250 W', 'lbf*in')
    """

    def __init__(self, units: object, powers: Mapping[str, int] | None = None) -> None:
        super().__init__(units)
        self.powers = powers or {}
        u = self._units
        metric = u is not None and u.force in METRIC_FORCES and u.length in METRIC_LENGTHS
        self.in_si = frozenset(kind for kind in ("power", "energy") if u and metric and not u.own(kind))

    def text(self, kind: str) -> str:
        if kind in self.in_si:
            return unit_with_power(KINDS[kind].si, self.powers.get(kind, 0))
        unit = super().text(kind) if self.bare(kind) else RADIANS[kind]
        return unit_with_power(unit, self.powers.get(kind, 0))

    def __call__(self, kind: str, values: Numeric) -> Numeric:
        plain = kind in self.in_si or not self.bare(kind)
        converted = values if plain else super().__call__(kind, values)
        return converted / 10.0 ** self.powers[kind] if kind in self.powers else converted

    def number(self, kind: str, value: float) -> str:
        """One number in its unit, as text."""
        return number(float(self(kind, value)))

    def quantity(self, kind: str, value: float) -> str:
        """The same with the unit."""
        return f"{self.number(kind, value)} {self.text(kind)}"


PREFIXES = {3: "k", 6: "M", 9: "G", 12: "T"}
PREFIXED = ("N", "N*m", "W", "J", "Pa")
"""Units that take a prefix; for others the power itself is printed."""
PASCAL = {"N/m^2": "Pa"}
THOUSANDTHS = {("kN/mm^2", -3): "N/mm^2"}
"""A unit too large for stresses, with the power of ten that makes it the usual one."""
OF_METRES = {"N*mm": "N*m", "mm/s": "m/s", "mm/s^2": "m/s^2"}
"""Units of millimetres -> those of metres that are a thousand times larger."""


def unit_with_power(unit: str, power: int) -> str:
    """A unit times a power of ten.

    >>> unit_with_power("N*m", 3), unit_with_power("N*mm", 9), unit_with_power("lbf*in", 6)
    ('kN*m', 'MN*m', '10^6 lbf*in')
    >>> unit_with_power("N/m^2", 6), unit_with_power("kN/mm^2", -3)
    ('MPa', 'N/mm^2')
    """
    if (unit, power) in THOUSANDTHS:
        return THOUSANDTHS[unit, power]
    if power:
        unit = PASCAL.get(unit, unit)
    if power >= 3 and unit in OF_METRES:
        unit, power = OF_METRES[unit], power - 3
    if not power:
        return unit
    return (
        f"{PREFIXES[power]}{unit}" if unit in PREFIXED and power in PREFIXES else f"10^{power} {unit}".strip()
    )


METRIC_FORCES, METRIC_LENGTHS = ("N", "daN", "kN", "MN"), ("mm", "cm", "dm", "m")
RADIANS = {"angular_speed": "rad/s", "angular_acceleration": "rad/s^2"}


def print_scale(result: Result, units: UnitChoice) -> Printed:
    """The scale of a printed answer, the same in every table, drawing and report of the result."""
    return _scales(result)[units == "SI"]


@kept
def _scales(result: Result) -> tuple[Printed, Printed]:
    """The scales in the units of the file and in SI."""
    most = {kind: float(size[0]) for kind, size in _extents(result).items()}
    least = _smallest(result)
    return scale_for(result.mechanism.units, most, least), scale_for(None, most, least)


def scale_for(units: object, most: Mapping[str, float], least: float = math.inf) -> Printed:
    """The scale for answers whose largest numbers (SI) are known by kind: a kind whose largest would be printed with an
    exponent has it with its unit. Forces and moments have one power, so that arms stay in the unit of the file: kN
    times mm is N*m. ``least``: the smallest force (N), for which a lower power is taken where the largest allows it.
    Stresses and pressures in N/m^2 are in MPa, those in kN/mm^2 in N/mm^2."""
    plain = Printed(units)
    watts = plain.text("power") == "W"
    sizes = {"force": 0.0, "moment": 0.0} | {k: float(abs(plain(k, size))) for k, size in most.items()}
    powers = {
        k: p for k, size in sizes.items() if (p := _power(size, 1e4 if k == "power" and watts else 1e6))
    }
    common = max(powers.get("force", 0), 3 if "moment" in powers else 0, _power(sizes["moment"] / 1e3))
    small, large = float(abs(plain("force", least))), max(sizes["force"], sizes["moment"])
    while common > 3 and small < 1e-4 * 10.0**common and large < 1e6 * 10.0 ** (common - 3):
        common -= 3
    if common:
        powers |= {"force": common, "moment": common}
    if plain.text("pressure") in PASCAL:
        powers["pressure"] = 6
    elif (plain.text("pressure"), -3) in THOUSANDTHS:
        powers["pressure"] = -3
    return Printed(units, powers)


def _power(most: float, large_from: float = 1e6) -> int:
    """The power of ten, a multiple of three, of a number that would be printed with an exponent; else 0."""
    large = math.isfinite(most) and most >= large_from * (1 - 5e-7)
    return 3 * math.floor(math.log10(most * (1 + 1e-6)) / 3) if large else 0


@kept
def _extents(result: Result) -> Tree:
    """Largest number of the complete answer by kind (1,), 0 where all are rounding."""
    r, d = result.before, result.compiled.layout.algebra.d
    turns = np.array([drive_kinds(r, n)["effort"] == "moment" for n in r.drives], bool)
    couples = np.array([load_kind(r, n) == "moment" for n in r.unknown_loads], bool)
    arrays = {
        "force": (r.force_array, r.effort_array[:, ~turns], r.load_array[:, ~couples]),
        "moment": (r.moment_array, r.effort_array[:, turns], r.load_array[:, couples]),
        "power": (r.effort_array * r.schedule.speed,),
        "speed": (r.twist_array[..., :d],),
        "acceleration": (r.acceleration_array[..., :d],),
        "angular_speed": (r.twist_array[..., d:],),
        "angular_acceleration": (r.acceleration_array[..., d:],),
    }
    extents = {kind: largest(1, *(a.reshape(1, -1) for a in some)) for kind, some in arrays.items()}
    force = max(float(extents["force"][0]), float(extents["moment"][0]) / r.compiled.layout.length)
    noise = {"force": PART * force, "moment": PART * force * r.compiled.layout.length}
    return {kind: np.where(size > noise.get(kind, 0.0), size, 0.0) for kind, size in extents.items()}


def _smallest(result: Result) -> float:
    """The smallest joint force of the complete answer (N) that is not rounding."""
    sizes = np.linalg.norm(result.before.force_array, axis=-1)
    known = sizes[np.isfinite(sizes)]
    return float(known[known > PART * known.max(initial=0.0)].min(initial=math.inf))


def without_reactions(result: Result) -> bool:
    """True if the method gives no reactions, as virtual work does, at solved positions."""
    return bool(result.ok.any()) and not np.isfinite(result.force_array).any()


def motion_only(result: Result) -> bool:
    """True if forces were not requested."""
    return without_reactions(result) and not np.isfinite(result.effort_array).any()


def significant(result: Result, kind: str, values: Array) -> Array:
    """Numbers of a kind, (P,) or (P, ...), or of the first position; those that are nothing but rounding as 0.

    >>> from dalembert.analysis import statics
    >>> from dalembert.model.library import four_bar
    >>> significant(statics(four_bar()), "force", np.array([1e-30, 5.0]))
    array([0., 5.])
    """
    small: Array = PART * _largest(result).get(kind, np.zeros(len(result.status)))
    shape = np.shape(values)
    small = small.reshape(-1, *[1] * (len(shape) - 1)) if shape[:1] == small.shape else small[0]
    return np.where(np.abs(values) < small, 0.0, values)


@kept
def _largest(result: Result) -> Tree:
    """Largest number by kind at each position (P,): computed faster than all forces at it."""
    d, length, many = result.compiled.layout.algebra.d, result.compiled.layout.length, len(result.status)
    angular = [drive_kinds(result, drive)["effort"] == "moment" for drive in result.drives]
    efforts = np.where(angular, result.effort_array / length, result.effort_array)
    force = largest(many, result.force_array, result.moment_array / length, efforts)
    if many == 1 or (force < 1e-9 * force.max()).any():  # what is left where loads balance each other
        return sizes(result)
    turning = largest(many, result.twist_array[..., d:])
    sliding = largest(many, result.twist_array[..., :d])
    return {
        "power": force * np.maximum(sliding, length * turning),
        "force": force,
        "moment": force * length,
        "angular_speed": turning,
        "angular_acceleration": np.maximum(largest(many, result.acceleration_array[..., d:]), turning**2),
    }
