"""Speeds and accelerations by components: the relative equation of a point, along the direction with one unknown.

Mechanics: docs/theory.md 7.2.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

RATES = (
    (1, "v", "omega", "angular_speed", "speed"),
    (2, "a", "alpha", "angular_acceleration", "acceleration"),
)
"""Order of a rate, symbols of a point's and a link's, kinds of a link's and a point's."""


class ShownNumber(NamedTuple):
    """A number (SI) of a kind; an ``arm`` makes a speed or an acceleration of an angular one."""

    kind: str
    value: float


@dataclass(frozen=True)
class MotionLine:
    """One line: letters, numbers at the places %0, %1 ... of ``pattern``, where @ is the unknown; its result
    beside the answer's.

    Letters have <n> for link n, ground being 0, as a reader may name them by numbers.
    """

    letters: str
    pattern: str
    numbers: tuple[ShownNumber, ...]
    name: str
    result: ShownNumber
    right: float

    @property
    def gap(self) -> float:
        """Difference to the answer; of angles within half a turn."""
        gap = self.result.value - self.right
        return abs(math.remainder(gap, math.tau) if self.result.kind == "angle" else gap)


class PointMotion(NamedTuple):
    """Velocity and acceleration (2,) of a point."""

    velocity: Array
    acceleration: Array


def turned(v: Array) -> Array:
    """A vector (2,) turned by a quarter, counter-clockwise."""
    return np.array([-v[1], v[0]])


def written(name: str) -> str:
    """A name as a formula prints it: without signs that have a meaning in formulas."""
    return re.sub(r"[^\w]", " ", name)


def distance(a: str, b: str) -> str:
    """Sign of the line between two joints: AB."""
    return f'"{written(a)}{written(b)}"'


def direction(v: Array) -> float:
    """Angle of a vector."""
    return math.atan2(float(v[1]), float(v[0]))


class RelativeRates:
    """Rates of the links of position ``k``, beside those of the answer."""

    def __init__(self, r: Result, k: int) -> None:
        self.r, self.k, self.m = r, k, r.mechanism

    def tag(self, link: str) -> str:
        """Place of a link's name in letters."""
        return f"<{(GROUND, *self.r.links).index(link)}>"

    def moving(self, link: str, at: Array) -> PointMotion:
        """Motion of the point of a link that is at a place."""
        if link == GROUND:
            return PointMotion(np.zeros(2), np.zeros(2))
        r, k = self.r, self.k
        q, w, alpha = at - r.center(link)[k], self.spin(link), self.spin(link, 2)
        v = r.center_velocity(link)[k] + w * turned(q)
        return PointMotion(v, r.center_acceleration(link)[k] + alpha * turned(q) - w * w * q)

    def spin(self, link: str, rate: int = 1) -> float:
        """Angular velocity, or acceleration, of a link."""
        if link == GROUND:
            return 0.0
        return float((self.r.speed(link) if rate == 1 else self.r.acceleration(link))[self.k])

    def other(self, joint: str, link: str) -> str:
        """The other link of a joint."""
        i, j = self.m.joints[joint].links
        return j if link == i else i

    def _equation(
        self,
        unknown: str,
        kind: str,
        coefficient: float | None,
        terms: list[tuple[str, str, float]],
        letters: str,
        right: float,
    ) -> MotionLine:
        """Sum of terms and of an unknown with its coefficient (m; 1 without one): 0."""
        value = -sum(value for *_, value in terms) / (1.0 if coefficient is None else coefficient)
        numbers = [ShownNumber(plain, value) for _, plain, value in terms]
        behind = "@" if coefficient is None else f"@ cdot %{len(numbers)}"
        pattern = " + ".join([*(f"%{n}" for n in range(len(numbers))), behind]) + " = 0"
        numbers += [] if coefficient is None else [ShownNumber(f"arm of {kind}", coefficient)]
        said = " + ".join([*(letter for letter, *_ in terms), letters]).replace("+ −", "− ")
        return MotionLine(f"{said} = 0", pattern, tuple(numbers), unknown, ShownNumber(kind, value), right)

    def two_links(
        self, first: tuple[str, str, Array], last: tuple[str, str, Array], jm: str, mid: Array
    ) -> Iterator[MotionLine]:
        """Angular velocities and accelerations of two links with a pin between: along one, the other has no part."""
        (a, ja, p), (b, jb, q) = first, last
        mp, mq = self.moving(self.other(ja, a), p), self.moving(self.other(jb, b), q)
        ja, jb, jm = written(ja), written(jb), written(jm)
        for rate, sign, symbol, kind, plain in self.rates():
            wa, wb = self.spin(a), self.spin(b)
            for link, joint, start, other, far in ((a, ja, p, jb, q), (b, jb, q, ja, p)):
                e = (mid - far) / np.linalg.norm(mid - far)
                near, away = (mp, mq) if link == a else (mq, mp)
                axis = f"{other}{jm}"
                terms = []
                if float(np.abs(near[rate - 1]).max()) > 0:
                    terms.append((f"{sign}_{{{joint},{axis}}}", plain, float(near[rate - 1] @ e)))
                if float(np.abs(away[rate - 1]).max()) > 0:
                    terms.append((f"−{sign}_{{{other},{axis}}}", plain, -float(away[rate - 1] @ e)))
                if rate == 2:
                    mine, others = (wa, wb) if link == a else (wb, wa)
                    far_link = b if link == a else a
                    terms.append(
                        (
                            f"−(omega_{{{self.tag(link)}}}^{{2}} {distance(joint, jm)})_{{{axis}}}",
                            plain,
                            -(mine**2) * float((mid - start) @ e),
                        )
                    )
                    terms.append(
                        (
                            f"omega_{{{self.tag(far_link)}}}^{{2}} {distance(other, jm)}",
                            plain,
                            others**2 * float((mid - far) @ e),
                        )
                    )
                arm = float(turned(mid - start) @ e)
                if abs(arm) < 1e-9 * float(np.linalg.norm(mid - start)):
                    return
                name = f"{symbol}_{{{self.tag(link)}}}"
                letters = f"({name} times {distance(joint, jm)})_{{{axis}}}"
                yield self._equation(name, kind, arm, terms, letters, self.spin(link, rate))

    def guided(
        self, a: str, fixed: str, names: tuple[str, str, str], p: Array, mid: Array, e: Array
    ) -> Iterator[MotionLine]:
        """A pin that is led by a line: across the line the link's turning, along it the sliding."""
        ja, jm, guide = names
        n, w, turn = turned(e), self.spin(a), self.spin(fixed)
        from_link = self.other(ja, a)
        mp, mq = self.moving(from_link, p), self.moving(fixed, mid)
        ja, jm, guide = map(written, names)
        arm = float(turned(mid - p) @ n)
        if abs(arm) < 1e-9 * float(np.linalg.norm(mid - p)):
            return
        v = float((mp.velocity + w * turned(mid - p) - mq.velocity) @ e)
        for rate, sign, symbol, kind, plain in self.rates():
            for unit, axis in ((n, "n"), (e, "t")):
                at_pin = from_link != GROUND
                terms = [(f"{sign}_{{{ja},{axis}}}", plain, float(mp[rate - 1] @ unit))] if at_pin else []
                if fixed != GROUND:
                    terms.append((f"−{sign}_{{{guide},{axis}}}", plain, -float(mq[rate - 1] @ unit)))
                if rate == 2:
                    terms.append(
                        (
                            f"−(omega_{{{self.tag(a)}}}^{{2}} {distance(ja, jm)})_{{{axis}}}",
                            plain,
                            -(w**2) * float((mid - p) @ unit),
                        )
                    )
                    if turn and axis == "n":
                        terms.append((f"−2 omega_{{{self.tag(fixed)}}} v_{{{guide}}}", plain, -2 * turn * v))
                name = f"{symbol}_{{{self.tag(a)}}}"
                if axis == "n":
                    yield self._equation(
                        name, kind, arm, terms, f"({name} times {distance(ja, jm)})_{{n}}", self.spin(a, rate)
                    )
                    continue
                terms.append(
                    (
                        f"({name} times {distance(ja, jm)})_{{t}}",
                        plain,
                        self.spin(a, rate) * float(turned(mid - p) @ e),
                    )
                )
                total = sum(value for *_, value in terms)
                letters = " + ".join(letter for letter, *_ in terms).replace("+ −", "− ")
                numbers = tuple(ShownNumber(plain, value) for *_, value in terms)
                pattern = " + ".join(f"%{n}" for n in range(len(numbers)))
                slid = f"{sign}_{{{guide}}}"
                yield MotionLine(
                    f"{slid} = {letters}", pattern, numbers, slid, ShownNumber(plain, total), total
                )

    def led(
        self, a: str, names: tuple[str, str, str], p: Array, at: Array, target: str, e: Array
    ) -> Iterator[MotionLine]:
        """A line through a known point: across it the turning, along it the sliding, with Coriolis' acceleration."""
        ja, slide, jb = names
        n, d, w = turned(e), at - p, self.spin(a)
        from_link = self.other(ja, a)
        mp, mq = self.moving(from_link, p), self.moving(target, at)
        ja, slide, jb = map(written, names)
        along, off = float(d @ e), float(d @ n)
        if abs(along) < 1e-9 * float(np.linalg.norm(d)):
            return
        v = float((mq.velocity - mp.velocity) @ e) + w * off
        for rate, sign, symbol, kind, plain in self.rates():
            moved = float((mq[rate - 1] - mp[rate - 1]) @ n)
            pin = (
                f"−({sign}_{{{jb}}} − {sign}_{{{ja}}})"
                if self.other(ja, a) != GROUND
                else f"−({sign}_{{{jb}}})"
            )
            terms = [(f"{pin}_{{n}}", plain, -moved)]
            if rate == 2:
                terms.append((f"2 omega_{{{self.tag(a)}}} v_{{{slide}}}", plain, 2 * w * v))
                terms += (
                    [(f"−omega_{{{self.tag(a)}}}^{{2}} h", plain, -w * w * off)]
                    if abs(off) > 1e-12 * abs(along)
                    else []
                )
            name = f"{symbol}_{{{self.tag(a)}}}"
            yield self._equation(name, kind, along, terms, f"{name} s", self.spin(a, rate))
            if rate == 1:
                slid = [(f"{pin}_{{t}}", "speed", -float((mq.velocity - mp.velocity) @ e))]
                slid += (
                    [(f"−omega_{{{self.tag(a)}}} h", "speed", -w * off)]
                    if abs(off) > 1e-12 * abs(along)
                    else []
                )
                yield self._equation(f"v_{{{slide}}}", "speed", None, slid, f"v_{{{slide}}}", v)

    def rates(self) -> Iterator[tuple[int, str, str, str, str]]:
        """The rows of ``RATES`` that are not 0."""
        for words in RATES:
            if not self.moves(words[0]):
                return
            yield words

    def moves(self, rate: int) -> bool:
        """True if anything moves at this position."""
        speeds = any(self.spin(n) for n in self.r.links) or bool(np.any(self.r.twist_array[self.k]))
        return speeds or (rate == 2 and bool(np.any(self.r.acceleration_array[self.k])))
