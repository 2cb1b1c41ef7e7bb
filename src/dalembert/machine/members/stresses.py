"""Stress of a section along a member, safety against yield, and fatigue of each fibre.

sigma = N/A - M_z y / I_z + M_y z / I_y at a fibre (y, z); von Mises at the outer fibres with torsion, and at the axis
with shear and torsion, the larger. A notch factor K_f multiplies mean and amplitude of fatigue, not the stress.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.rounding import PART
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Tree, first_largest
from dalembert.errors import ModelError
from dalembert.machine.link_axes import in_space
from dalembert.machine.members.link_balance import BESIDE
from dalembert.machine.members.member_forces import MemberCurve
from dalembert.machine.whole_cycle import sampling
from dalembert.model.links.sections import Section

if TYPE_CHECKING:
    from dalembert.machine.members.member_forces import MemberForces

SAMPLES, ROUNDS = 33, 8
"""Places on each piece of a member where a stress is looked at, and how often, closer each time about the greatest."""
STATIONS = 129
"""Places along a member where fatigue is looked at, three times, closer each time about the worst."""
ANYWHERE = -1.0
"""Key of a notch factor that holds at every place."""
FIBRES = 72
"""Fibres round a circle that bends in both planes, looked at three times as the stations."""


@dataclass(frozen=True)
class Fatigue:
    """Worst fibre over the cycle: place (m) on a member, mean and amplitude of its stress, Pa, and the safety.

    By Goodman 1 / n = amplitude / endurance + mean / ultimate, a mean in compression left out; None without these. The
    extremes are those of the positions: half of these would change the stress' range by the part ``sampling``.
    """

    member: str
    place: float
    mean: float
    amplitude: float
    safety: float | None
    sampling: float = math.nan


@dataclass(frozen=True, eq=False)
class Stresses(Compared):
    """Greatest von Mises stress (P,) of a link, Pa, with its member and place (P,), m; ``normal`` (P,) is sigma at that
    place.

    ``largest``: over the cycle, ``position`` (from 0) where; ``safety`` against yield, None without a yield stress.
    """

    forces: MemberForces = field(repr=False)
    section: Section
    equivalent: Array = field(repr=False)
    member: tuple[str, ...] = field(repr=False)
    place: Array = field(repr=False)
    normal: Array = field(repr=False)

    @property
    def position(self) -> int:
        """Position of the largest stress, from 0."""
        return first_largest(self.equivalent) if np.isfinite(self.equivalent).any() else 0

    @property
    def largest(self) -> float:
        """The largest of the cycle, Pa."""
        return float(self.equivalent[self.position])

    @property
    def safety(self) -> float | None:
        """Yield stress over the largest."""
        limit = self.section.yield_stress
        return None if limit is None else limit / self.largest if self.largest else math.inf

    def parts(self) -> tuple[float, float]:
        """Contributions of N and of M to the normal stress at the largest, Pa."""
        k = self.position
        comps = self.forces.curve(self.member[k]).at(float(self.place[k]))[k, 0]
        direct = float(comps[0] / self.section.area_of)
        return direct, float(self.normal[k]) - direct

    def fatigue(self) -> Fatigue:
        """The fibre that is worst over the cycle, by Goodman where endurance and ultimate stress are given, else by the
        amplitude alone. NaN where a position has no answer.
        """
        fibres = [_fatigue(self.forces, curve, self.section) for curve in self.forces.curves]
        use = [_utilisation(self.section, f.mean, f.amplitude) for f in fibres]
        return fibres[int(np.argmax(use))]


def section_of(forces: MemberForces, section: Section | Tree | None) -> Section:
    """The section asked for, or that of the file."""
    if isinstance(section, Mapping):
        return Section(**section)
    chosen = section or forces.result.mechanism.links[forces.link].section
    if chosen is None:
        remedy = "give it one: section: {rectangle: [20 mm, 40 mm]}"
        raise ModelError(f"link {forces.link!r} has no section", remedy, ("links", forces.link))
    return chosen


def fibre_stress(s: Section, comps: Array, plane: bool, places: Array | None = None) -> Array:
    """Normal stress (..., F) of inner forces (..., 6) at fibres (F, 2), by default the outer ones."""
    direct = comps[..., 0] / s.area_of
    (iy, iz), y = s.second_moments, s.reach[0]
    if places is None and s.round and not plane:
        bend = np.hypot(comps[..., 4], comps[..., 5]) * y / iz
        return np.stack([direct + bend, direct - bend], axis=-1)
    at = outer_fibres(s, plane) if places is None else places
    bent = comps[..., 4, None] * at[:, 1] / iy - comps[..., 5, None] * at[:, 0] / iz
    return np.asarray(direct[..., None] + bent)


def outer_fibres(s: Section, plane: bool, middle: float = 0.0, half: float = math.pi) -> Array:
    """Places (F, 2) of the fibres with the largest stress: y = +-, in space the corners, or on a circle by angles from
    y on both sides of a middle, rad."""
    y, z = s.reach
    if plane:
        return np.array([[y, 0.0], [-y, 0.0]])
    if s.round:
        angle = middle + half * np.linspace(-1.0, 1.0, FIBRES + 1)
        return y * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    s.torsion  # noqa: B018  numbers alone say nothing of bending two ways: refused
    return np.array([[a * y, b * z] for a in (1, -1) for b in (1, -1)])


def equivalent_stress(s: Section, comps: Array, plane: bool) -> Array:
    """Von Mises stress (...): at the outer fibre with torsion, at the axis with shear and torsion, the larger."""
    sigma = np.abs(fibre_stress(s, comps, plane)).max(axis=-1)
    twist = 0.0 if plane else np.abs(comps[..., 3]) / s.torsion
    shear = np.hypot(s.shear[0] * comps[..., 1], s.shear[1] * comps[..., 2])
    axis = (comps[..., 0] / s.area_of) ** 2 + 3 * (shear + twist) ** 2
    return np.asarray(np.sqrt(np.maximum(sigma**2 + 3 * twist**2, axis)))


def stresses(forces: MemberForces, section: Section | Tree | None = None) -> Stresses:
    """The greatest stress of a link at every position."""
    s, plane = section_of(forces, section), forces.result.mechanism.dimension == 2
    largest = [_greatest(curve, lambda comps: equivalent_stress(s, comps, plane)) for curve in forces.curves]
    values, places, comps = (np.array(some) for some in zip(*largest, strict=True))
    k, every = (
        np.argmax(values, axis=0),
        np.arange(values.shape[1]),
    )  # one that is not known before all others
    sigma = fibre_stress(s, comps[k, every], plane)
    normal = sigma[every, np.argmax(np.abs(sigma), axis=1)]
    names = tuple(forces.curves[j].name for j in k)
    return Stresses(forces, s, values[k, every], names, places[k, every], normal)


def _greatest(curve: MemberCurve, f: Callable[[Array], Array]) -> tuple[Array, Array, Array]:
    """Greatest value (P,) of f of the inner forces along a member, its place (P,), and the forces at it (P, 6)."""
    low, high, every = curve.edges[:, :-1], curve.edges[:, 1:], np.arange(len(curve.edges))
    first = np.where(np.isnan(low[:, 0]), np.nan, -np.inf)
    best = (first, np.full(len(low), np.nan), np.full((len(low), 6), np.nan))
    for j in range(low.shape[1]):
        a, b, inside = low[:, j], high[:, j], high[:, j] > low[:, j]
        linear = not curve.cubics[:, j, :, 2:].any()  # f is a norm, and convex: largest at an end
        samples, rounds = (2, 1) if linear else (SAMPLES, ROUNDS)
        for _ in range(rounds):
            s = a[:, None] + (b - a)[:, None] * np.linspace(0, 1, samples)
            comps = (curve.cubics[:, j, None] * s[..., None, None] ** np.arange(4)).sum(axis=-1)
            values = f(comps)
            k = np.argmax(values, axis=1)
            better = inside & ((values[every, k] > best[0]) | np.isnan(values[every, k]))
            place = np.where(np.isnan(values[every, k]), np.nan, s[every, k])
            for into, new in zip(best, (values[every, k], place, comps[every, k]), strict=True):
                into[better] = new[better]
            a, b = s[every, np.maximum(k - 1, 0)], s[every, np.minimum(k + 1, samples - 1)]
    return best


def _utilisation(s: Section, mean: Array | float, amplitude: Array | float) -> Array:
    """1 / n by Goodman, or the amplitude where the material is not given."""
    if s.endurance is None or s.ultimate is None:
        return np.asarray(amplitude)
    return np.asarray(np.asarray(amplitude) / s.endurance + np.maximum(mean, 0.0) / s.ultimate)


def _notches(forces: MemberForces, curve: MemberCurve, s: Section) -> dict[float, float]:
    """Notch factors by place along a member, m; of all others under ``ANYWHERE``."""
    out, link = dict[float, float](), forces.result.mechanism.links[forces.link]
    for point, factor in (s.notch or {}).items():
        if not point:
            out[ANYWHERE] = factor
            continue
        foot, off = curve.member.foot(in_space(link.point(point)))
        if float(off) <= BESIDE * curve.member.length:
            out[float(foot)] = factor
    return out


def _fatigue(forces: MemberForces, curve: MemberCurve, s: Section) -> Fatigue:
    """The worst fibre of a member: at even stations and on both sides of every force, then closer about the worst."""
    plane, length = forces.result.mechanism.dimension == 2, curve.member.length
    notches = _notches(forces, curve, s)
    jumps = np.union1d(curve.jumps, [x for x in notches if x != ANYWHERE])
    low, high, round_it = 0.0, length, (0.0, math.pi)
    best, worst = (-math.inf, 0.0, math.nan, math.nan), np.zeros(0)
    for _ in range(3):
        places = np.union1d(np.linspace(low, high, STATIONS), jumps[(jumps >= low) & (jumps <= high)])
        at = outer_fibres(s, plane, *round_it)
        for side in ("before", "behind"):
            inner = places[(places > 0) if side == "before" else (places < length)]
            factors = [notches.get(x, notches.get(ANYWHERE, 1.0)) for x in inner.tolist()]
            sigma = fibre_stress(s, curve.at(inner, side), plane, at) * np.array(factors)[:, None]
            mean, swing = (sigma.max(axis=0) + sigma.min(axis=0)) / 2, np.ptp(sigma, axis=0) / 2
            swing = np.where(swing <= PART * np.abs(sigma).max(), 0.0, swing)
            use = _utilisation(s, mean, swing)
            if np.isnan(use).any():
                return Fatigue(curve.name, math.nan, math.nan, math.nan, None)
            k = np.unravel_index(np.argmax(use), use.shape)
            if use[k] > best[0]:
                best = (float(use[k]), float(inner[k[0]]), float(mean[k]), float(swing[k]))
                worst = sigma[:, k[0], k[1]]
                round_it = math.atan2(at[k[1], 1], at[k[1], 0]), round_it[1]
        step = (high - low) / (STATIONS - 1)
        low, high = max(0.0, best[1] - step), min(length, best[1] + step)
        round_it = round_it[0], round_it[1] * 2 / FIBRES
    if not best[3]:
        worst = np.full_like(worst, best[2])
    goodman = s.endurance is not None and s.ultimate is not None
    safety = (1 / best[0] if best[0] > 0 else math.inf) if goodman else None
    peaks = {"range": worst - (worst.min() + worst.max()) / 2}
    change = sampling(forces.result, lambda at: {"range": float(np.ptp(worst[at]))}, peaks)["range"]
    return Fatigue(curve.name, best[1], best[2], best[3], safety, change)
