"""Load on the bearing of a joint over the cycle, and its life.

p = F / (d l), PV = p (d / 2) |w|, P = (int F^e |dphi| / int |dphi|)^(1/e) with phi the turn of j against
i, e = 3 for balls and 10/3 for rollers, L10 = (C / P)^e million turns (ISO 281).

Mechanics: docs/theory.md 10.5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.bearing_ends import bearing_axis
from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Ints
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.machine.whole_cycle import durations, sampling
from dalembert.model import GROUND
from dalembert.model.joints.bearing_keys import Bearing
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

MILLION = 1e6
STILL = 1e-12
"""Part of the links' speeds below which the turn of one relative to the other is rounding."""


@dataclass(frozen=True, eq=False)
class BearingLoad(Compared):
    """Forces (P,) of a joint across its axis and along it, N, and its turning (P,), rad/s, of j against i.

    ``couple`` (P,), N m: across the axis, not counted in these loads: it needs two bearings. ``time`` (P,), s: duration
    represented by each position. ``bearing``: from the file, or by its kind alone.

    >>> import dalembert as da
    >>> b = da.bearing(da.dynamics(da.slider_crank()), "A")
    >>> b.radial.shape, b.sized
    ((72,), False)
    """

    result: Result = field(repr=False)
    joint: str
    bearing: Bearing | None
    radial: Array = field(repr=False)
    axial: Array = field(repr=False)
    couple: Array = field(repr=False)
    rate: Array = field(repr=False)
    time: Array = field(repr=False)

    @property
    def tilting(self) -> float:
        """The largest couple across the axis, N m; 0 where it is rounding."""
        length = self.result.compiled.layout.length
        most = float(np.nanmax(self.couple, initial=0.0))
        return most if most > 1e-9 * length * float(np.nanmax(self.radial, initial=0.0)) else 0.0

    @property
    def sized(self) -> bool:
        """True if it has a pressure."""
        return self.bearing is not None and self.bearing.area is not None

    @property
    def pressure(self) -> Array:
        """Force across the axis over the projected area (P,), Pa; raises ModelError without diameter and length."""
        if self.bearing is None or self.bearing.area is None:
            raise self._lacks("no size", "give diameter: 20 mm and length: 15 mm")
        return self.radial / self.bearing.area

    @property
    def pv(self) -> Array:
        """Pressure times the speed at the pin's surface (P,), W/m2."""
        p = self.pressure
        return np.asarray(p * np.abs(self.rate) * (self.bearing.diameter if self.bearing else 0) / 2)

    @property
    def mean_pv(self) -> float:
        """Its mean over time, by the positions: ``sampling`` says how much half of them would change it."""
        return float((self.pv * self.time).sum() / self.time.sum())

    @property
    def load(self) -> Array:
        """The radial load (P,), N, that does as much as both forces: X F_r + Y F_a, and never less than F_r."""
        b = self.bearing
        if b is None or b.axial_factor is None:
            thrust = np.nanmax(self.axial, initial=0.0) > 1e-9 * np.nanmax(self.radial, initial=0.0)
            return np.full_like(self.radial, np.nan) if thrust else self.radial
        return np.maximum(self.radial, b.radial_factor * self.radial + b.axial_factor * self.axial)

    def sampling(self) -> dict[str, float]:
        """By how much half of the positions would change its greatest values and means, as parts of these."""
        peaks = {"radial force": self.radial} | ({"greatest PV": self.pv} if self.sized else {})
        return sampling(self.result, lambda at: self._at(at)._summary(), peaks)

    def _at(self, at: Ints) -> BearingLoad:
        """The same at some positions alone."""
        arrays = {name: getattr(self, name)[at] for name in ("radial", "axial", "couple", "rate")}
        return replace(self, **arrays, time=_durations(self.result, at))

    def _summary(self) -> dict[str, float]:
        """The values that are over all positions."""
        out = {"equivalent load": self.equivalent, "mean turning": self.speed}
        out["radial force"] = float(np.max(self.radial, initial=0.0))
        return out | ({"mean PV": self.mean_pv, "greatest PV": float(self.pv.max())} if self.sized else {})

    @property
    def exponent(self) -> float:
        """Load exponent of the life equation: that of balls where no bearing is described."""
        return self.bearing.exponent if self.bearing else 3.0

    @property
    def equivalent(self) -> float:
        """P, N: the steady load of the same life, weighted by the turn, not by time; NaN where it does not turn, or has
        an axial force and no factor for it."""
        turned, largest = np.abs(self.rate) * self.time, float(np.max(self.load, initial=0.0))
        if not turned.sum() > 0 or not largest > 0:
            return 0.0 if largest == 0 else math.nan
        mean = ((self.load / largest) ** self.exponent * turned).sum() / turned.sum()
        return float(largest * mean ** (1 / self.exponent))

    @property
    def speed(self) -> float:
        """Mean of the turning's size over time, rad/s."""
        return float((np.abs(self.rate) * self.time).sum() / self.time.sum())

    @property
    def swings(self) -> bool:
        """True if it oscillates: its revolutions are then the angle swept over 2 pi."""
        return bool((self.rate > 0).any() and (self.rate < 0).any())

    @property
    def turns(self) -> float:
        """L10, turns that nine of ten bearings reach; raises ModelError without a rating."""
        if self.bearing is None or self.bearing.rating is None:
            raise self._lacks("no rating", "give rating: 12 kN")
        p = self.equivalent
        return MILLION * (self.bearing.rating / p) ** self.exponent if p else math.inf

    @property
    def hours(self) -> float:
        """The same by the mean speed."""
        return self.turns * 2 * math.pi / self.speed / 3600 if self.speed else math.inf

    @property
    def static_safety(self) -> float | None:
        """C0 over the largest load; None without C0."""
        most = float(np.max(self.load, initial=0.0))
        rating = self.bearing.static_rating if self.bearing else None
        return None if rating is None else rating / most if most else math.inf

    def rating_for(
        self,
        hours: float,
        factor: float = 1.0,
        reliability: float = 0.9,
        weibull: tuple[float, float, float] | None = None,
    ) -> float:
        """The rating C, N, for a life in hours, with the load times a factor.

        ``weibull``: (x0, theta - x0, b) of a catalogue, for the reliability of that life: C = a P (x / (x0 + (theta -
        x0) ln(1/R)^(1/b)))^(1/e), x in million turns; without it the life is L10. Budynas and Nisbett, section 11-4.
        """
        for key, value in (("hours", hours), ("factor", factor), ("reliability", reliability)):
            require(key, value)
        for key, value in zip(("x0", "theta - x0", "b"), weibull or (), strict=False):
            require(key, value, f"{key} of weibull")
        if weibull is None and reliability != 0.9:
            raise ModelError(
                f"life of a reliability of {reliability:g}", "give the catalogue's weibull numbers"
            )
        lives = hours * 3600 * self.speed / (2 * math.pi) / MILLION
        if weibull is not None:
            x0, scale, shape = weibull
            lives /= x0 + scale * math.log(1 / reliability) ** (1 / shape)
        return float(factor * self.equivalent * lives ** (1 / self.exponent))

    def _lacks(self, what: str, remedy: str) -> ModelError:
        return ModelError(f"the bearing of {self.joint!r} has {what}", remedy, ("joints", self.joint))


def bearing(r: Result, joint: str) -> BearingLoad:
    """The load of a joint's bearing over the cycle: pressure, PV, equivalent load, L10.

    Of a pin or a revolute joint; raises ModelError for others. Where the drives have no speed, means and lives are NaN.

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2).with_values({"joints.A.bearing": {"rating": "12 kN"}})
    >>> b = da.bearing(da.dynamics(m), "A")
    >>> bool(b.radial.min() < b.equivalent < b.radial.max()), b.exponent
    (True, 3.0)
    """
    if joint not in r.joints:
        raise ModelError(f"unknown joint {joint!r}", closest(joint, list(r.joints)))
    if joint not in turning_joints(r):
        raise ModelError(f"joint {joint!r} does not turn about one axis", "ask for a pin or a revolute")
    force = r.reaction(joint)
    i, j = (np.zeros(1) if n == GROUND else r.speed(n) for n in r.mechanism.joints[joint].links)
    if r.mechanism.dimension == 2:
        radial, rate, axial = magnitude(force), j - i, np.zeros(len(force))
        couple = axial
    else:
        axis, moment = bearing_axis(r, joint), r.reaction_moment(joint)
        along, about = ((v * axis).sum(axis=1) for v in (force, moment))
        radial, couple = magnitude(force - along[:, None] * axis), magnitude(moment - about[:, None] * axis)
        axial, rate = np.abs(along), ((j - i) * axis).sum(axis=1)
    if np.nanmax(np.abs(rate), initial=0.0) <= STILL * max(np.nanmax(np.abs(w), initial=0.0) for w in (i, j)):
        rate = 0 * rate  # both links turn alike
    described = getattr(r.mechanism.joints[joint], "bearing", None)
    time = _durations(r)
    return BearingLoad(r, joint, described, radial, axial, couple, rate + 0.0 * (radial + time), time)


def _durations(r: Result, at: Ints | None = None) -> Array:
    """Time of each position; NaN where the drives have no speeds, so that loads and pressures are all there is."""
    try:
        return durations(r, at)
    except ModelError:
        return np.full(len(r.status) if at is None else len(at), np.nan)


def turning_joints(r: Result) -> list[str]:
    """Joints that can have a bearing."""
    joints = r.mechanism.joints
    return [n for n in r.joints if joints[n].hinge]
