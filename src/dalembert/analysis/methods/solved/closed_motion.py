"""Positions in closed form, then speeds and accelerations by components: link by link, each line with one unknown.

Driven links come first, then pairs of links (dyads) between points that are known: two pins and a pin by the diagonal
and the cosine law, with a guide or a slot by a sine. Speeds and accelerations follow from the relative equation of the
middle point, along the direction in which the other unknown has no part.

Mechanics: docs/theory.md 7.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import link_angle, link_place
from dalembert.analysis.methods.solved.relative_rates import (
    MotionLine,
    RelativeRates,
    ShownNumber,
    direction,
    distance,
    turned,
    written,
)
from dalembert.arrays import Array
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass
class MotionStep:
    """Links solved together: what they are between, in words, and the lines."""

    links: tuple[str, ...]
    words: str
    lines: list[MotionLine] = field(default_factory=list)


class ClosedMotion(RelativeRates):
    """The motion of position ``k`` as far as it is closed: ``steps``, and the links that are ``left``."""

    def __init__(self, r: Result, k: int = 0) -> None:
        super().__init__(r, k)
        self.known, self.steps = {GROUND}, list[MotionStep]()
        self.joints: dict[str, Any] = {n: j for n, j in self.m.joints.items() if self.kind(n)}
        while (step := self._driven() or self._welded() or self._single() or self._dyad()) is not None:
            self.steps.append(step)
            self.known |= set(step.links)
        self.left = [link for link in r.links if link not in self.known]

    def kind(self, joint: str) -> str:
        """R a pin, P a guide, S a pin in a straight slot; empty for what has no closed form here."""
        described = self.m.joints[joint]
        kinds: dict[tuple[str, ...], str] = {("turn",): "R", ("slide",): "P", ("slide", "turn"): "S", (): "W"}
        freedoms: tuple[str, ...] = tuple(described.freedoms)
        return "" if described.wheels else kinds.get(freedoms, "")

    # what is known

    def place(self, joint: str, link: str) -> Array:
        """Position of a joint's point of a link."""
        ends, points = self.m.joints[joint].links, self.m.joint_points(joint)
        return np.asarray(link_place(self.r, link, points[ends.index(link)])[self.k])

    def along(self, joint: str) -> Array:
        """Direction of a slide."""
        described = self.joints[joint]
        angle = float(link_angle(self.r, described.links[0])[self.k]) + float(described.direction or 0.0)
        return np.array([math.cos(angle), math.sin(angle)])

    def between(self, link: str) -> list[str]:
        """Joints of a link with links that are known."""
        return [n for n, j in self.joints.items() if link in j.links and self.other(n, link) in self.known]

    @property
    def free(self) -> list[str]:
        """Links that are still sought."""
        return [link for link in self.r.links if link not in self.known]

    # steps

    def _driven(self) -> MotionStep | None:
        for d, drive in self.m.drives.items():
            joint = drive.joint or d
            links = self.m.joints[joint].links
            new = [n for n in links if n not in self.known]
            if len(new) != 1 or joint not in self.joints or (self.r.schedule.unknown is not None):
                continue
            link = new[0]
            driven = [(f"theta_{{{self.tag(link)}}}", "angle", float(link_angle(self.r, link)[self.k]))]
            if self.kind(joint) == "P":
                driven = [(f"s_{{{written(joint)}}}", "length", float(self.r.drive_position(d)[self.k]))]
                driven.append((f"v_{{{written(joint)}}}", "speed", float(self.r.drive_speed(d)[self.k])))
            else:
                driven.append((f"omega_{{{self.tag(link)}}}", "angular_speed", self.spin(link)))
                driven.append((f"alpha_{{{self.tag(link)}}}", "angular_acceleration", self.spin(link, 2)))
            lines = [MotionLine("", "", (), name, ShownNumber(kind, v), v) for name, kind, v in driven]
            return MotionStep((link,), f"{self.tag(link)} is driven at {joint}:", lines)
        return None

    def _welded(self) -> MotionStep | None:
        for link in self.free:
            for joint in self.between(link):
                if self.kind(joint) == "W":
                    name, other = self.tag(link), self.tag(self.other(joint, link))
                    words = f"{name} is fixed to {other} in {joint}."
                    if self.m.joints[joint].outlined:
                        words = f"{name} is moved by the profile of {other} in {joint}:"
                        return MotionStep((link,), words, self._followed(link))
                    if getattr(self.m.joints[joint], "BRAKES", False):
                        words = f"{name} keeps the position in which its lining {joint} bears on {other}."
                    return MotionStep((link,), words)
        return None

    def _followed(self, link: str) -> list[MotionLine]:
        """Place and rates of a link by its guide to a link that is known, else its angle and rates."""
        guide = next((n for n in self.between(link) if self.kind(n) == "P"), None)
        if guide is None:
            found = [
                (f"theta_{{{self.tag(link)}}}", "angle", float(link_angle(self.r, link)[self.k])),
                (f"omega_{{{self.tag(link)}}}", "angular_speed", self.spin(link)),
                (f"alpha_{{{self.tag(link)}}}", "angular_acceleration", self.spin(link, 2)),
            ]
        else:
            slide = (float(v[self.k]) for v in self.r.freedom(guide, "slide"))
            kinds = zip("sva", ("length", "speed", "acceleration"), slide, strict=True)
            found = [(f"{letter}_{{{written(guide)}}}", kind, v) for letter, kind, v in kinds]
        return [MotionLine("", "", (), name, ShownNumber(kind, v), v) for name, kind, v in found]

    def _single(self) -> MotionStep | None:
        """A link between a pin and a slot."""
        for link in self.free:
            ends = self.between(link)
            if sorted(map(self.kind, ends)) != ["R", "S"]:
                continue
            pin, slot = sorted(ends, key=self.kind)
            if self.joints[slot].links[0] == link:
                target = self.other(slot, link)
                return self._led((link,), pin, slot, self.place(slot, target), target, slot)
            return self._guided((link,), pin, slot, slot)
        return None

    def _dyad(self) -> MotionStep | None:
        for a in self.free:
            for b in self.free:
                middle = [n for n, j in self.joints.items() if set(j.links) == {a, b}]
                first, last = self.between(a), self.between(b)
                if a == b or len(middle) != 1 or len(first) != 1 or len(last) != 1:
                    continue
                word = "".join(map(self.kind, (first[0], middle[0], last[0])))
                if word == "RRR":
                    return self._three_pins(a, b, first[0], middle[0], last[0])
                if word == "RRP":
                    return self._guided((a, b), first[0], middle[0], last[0])
                if word == "RPR":
                    target = self.other(last[0], b)
                    return self._led(
                        (a, b), first[0], middle[0], self.place(last[0], target), target, last[0]
                    )
        return None

    def _three_pins(self, a: str, b: str, ja: str, jm: str, jb: str) -> MotionStep:
        """Diagonal, cosine law, then the other link by its ends."""
        p, q, mid = self.place(ja, a), self.place(jb, b), self.place(jm, a)
        d, u, v = (float(np.linalg.norm(x)) for x in (q - p, mid - p, mid - q))
        delta, psi = direction(q - p), math.acos(max(-1.0, min(1.0, (u * u + d * d - v * v) / (2 * u * d))))
        theta = direction(mid - p)
        sign = min((1, -1), key=lambda s: abs(math.remainder(delta + s * psi - theta, math.tau)))
        step = MotionStep(
            (a, b), f"{self.tag(a)} and {self.tag(b)} between the pins {ja} and {jb}, with the pin {jm}:"
        )
        step.lines += self._diagonal(ja, jb, q - p)
        rates = list(self.two_links((a, ja, p), (b, jb, q), jm, mid))
        ja, jb, jm = written(ja), written(jb), written(jm)
        first = distance(ja, jm)
        name, line = f"theta_{{{ja}{jm}}}", f"theta_{{{jb}{jm}}}"
        squares = tuple(ShownNumber("length", x) for x in (u, d, v, u, d))
        step.lines.append(
            MotionLine(
                f"cos psi = frac({first}^{{2}} + d^{{2}} − {distance(jb, jm)}^{{2}}; 2 {first} d)",
                "frac(%0^{2} + %1^{2} − %2^{2}; 2 cdot %3 cdot %4)",
                squares,
                "psi",
                ShownNumber("angle", psi),
                abs(math.remainder(theta - delta, math.tau)),
            )
        )
        step.lines.append(self._sum(name, "delta", "psi", delta, sign, psi, theta))
        end = p + u * np.array([math.cos(delta + sign * psi), math.sin(delta + sign * psi)]) - q
        step.lines.append(self._end(line, jm, jb, end, direction(mid - q)))
        step.lines += rates
        return step

    def _diagonal(self, ja: str, jb: str, v: Array) -> Iterator[MotionLine]:
        """Length and direction of the line between two known points."""
        x, y, size = (
            ShownNumber("length", float(v[0])),
            ShownNumber("length", float(v[1])),
            float(np.linalg.norm(v)),
        )
        ja, jb = written(ja), written(jb)
        letters = f"sqrt((x_{{{jb}}} − x_{{{ja}}})^{{2}} + (y_{{{jb}}} − y_{{{ja}}})^{{2}})"
        shown = ShownNumber("length", size)
        yield MotionLine(
            f"d = {distance(ja, jb)} = {letters}", "sqrt((%0)^{2} + (%1)^{2})", (x, y), "d", shown, size
        )
        shown = ShownNumber("angle", direction(v))
        tangent = f"tan delta = frac(y_{{{jb}}} − y_{{{ja}}}; x_{{{jb}}} − x_{{{ja}}})"
        yield MotionLine(tangent, "frac(%0; %1)", (y, x), "delta", shown, shown.value)

    def _sum(
        self, name: str, first: str, second: str, a: float, sign: int, b: float, right: float
    ) -> MotionLine:
        numbers = (ShownNumber("angle", a), ShownNumber("angle", b))
        plus = "+" if sign > 0 else "−"
        shown = ShownNumber("angle", math.remainder(a + sign * b, math.tau))
        return MotionLine(
            f"{name} = {first} {plus} {second}", f"%0 deg {plus} %1 deg", numbers, name, shown, right
        )

    def _end(self, name: str, jm: str, jb: str, v: Array, right: float) -> MotionLine:
        x, y = (ShownNumber("length", float(c)) for c in v)
        letters = f"tan {name} = frac(y_{{{jm}}} − y_{{{jb}}}; x_{{{jm}}} − x_{{{jb}}})"
        return MotionLine(letters, "frac(%0; %1)", (y, x), name, ShownNumber("angle", direction(v)), right)

    def _guided(self, links: tuple[str, ...], ja: str, jm: str, guide: str) -> MotionStep:
        """A link from a known pin to a point on a known line: a sine, then the line's length."""
        a = links[0]
        fixed = self.other(guide, links[-1])
        p, mid, e = self.place(ja, a), self.place(jm, a), self.along(guide)
        n, u = turned(e), float(np.linalg.norm(mid - p))
        h, s, gamma = float((mid - p) @ n), float((mid - p) @ e), direction(e)
        beta, theta = math.asin(max(-1.0, min(1.0, h / u))), direction(mid - p)
        many = " and ".join(f"{self.tag(x)}" for x in links)
        step = MotionStep(links, f"{many} between the pin {ja} and the line of {guide}:")
        heights = (ShownNumber("length", h), ShownNumber("length", u))
        step.lines.append(
            MotionLine(
                f"sin beta = frac(h; {distance(ja, jm)})",
                "frac(%0; %1)",
                heights,
                "beta",
                ShownNumber("angle", beta),
                beta,
            )
        )
        first = gamma if s >= 0 else math.remainder(gamma + math.pi, math.tau)
        name = f"theta_{{{written(ja + jm)}}}"
        words = "gamma" if s >= 0 else "(gamma + 180°)"
        step.lines.append(self._sum(name, words, "beta", first, 1 if s >= 0 else -1, beta, theta))
        shown, sign = (
            ShownNumber("length", math.copysign(math.sqrt(max(u * u - h * h, 0.0)), s)),
            "−" if s < 0 else "",
        )
        squares = (heights[1], heights[0])
        step.lines.append(
            MotionLine(
                f"s = {sign}sqrt({distance(ja, jm)}^{{2}} − h^{{2}})",
                sign + "sqrt(%0^{2} − (%1)^{2})",
                squares,
                "s",
                shown,
                s,
            )
        )
        step.lines += self.guided(a, fixed, (ja, jm, guide), p, mid, e)
        return step

    def _led(
        self, links: tuple[str, ...], ja: str, slide: str, at: Array, target: str, jb: str
    ) -> MotionStep:
        """A link that turns about a known pin and carries a line through a known point: diagonal and sine."""
        a = links[0]
        p, e = self.place(ja, a), self.along(slide)
        n, d = turned(e), at - p
        off, along, size = float(d @ n), float(d @ e), float(np.linalg.norm(d))
        beta, delta = math.asin(max(-1.0, min(1.0, off / size))), direction(d)
        many = " and ".join(f"{self.tag(x)}" for x in links)
        step = MotionStep(links, f"{many}, with the line of {slide}, between {ja} and {jb}:")
        step.lines += self._diagonal(ja, jb, d)
        sides = (ShownNumber("length", off), ShownNumber("length", size))
        step.lines.append(
            MotionLine(
                "sin beta = frac(h; d)", "frac(%0; %1)", sides, "beta", ShownNumber("angle", beta), beta
            )
        )
        name = f"theta_{{{written(slide)}}}"
        first = delta if along >= 0 else math.remainder(delta + math.pi, math.tau)
        words = "delta" if along >= 0 else "(delta + 180°)"
        step.lines.append(self._sum(name, words, "beta", first, -1 if along >= 0 else 1, beta, direction(e)))
        step.lines += self.led(a, (ja, slide, jb), p, at, target, e)
        return step
