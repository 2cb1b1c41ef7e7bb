"""In space: loops of links whose sides, and their rates, sum to zero; by components in ground axes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES
from dalembert.reports.sections.kinematics import Ring, joint_end, rings
from dalembert.reports.sections.terms import Signed, join_signed
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

ORDERS = (("length", 0), ("speed", 1), ("acceleration", 2))


class Side(NamedTuple):
    """One side of a loop: its sign, the link it turns with, its vector (3,) and the first two rates of it, SI.

    ``slide``: index of the displacement s along the axis e of a joint's slide, and whether it is traversed backwards.
    """

    sign: str
    link: str
    vectors: tuple[Array, Array, Array]
    slide: str = ""
    backwards: bool = False


def closing_lines(sheet: ReportSheet, r: Result, k: int, shown: Shown, moving: bool) -> None:
    """Each loop in letters, and the components of its sides with their sums."""
    for n, ring in enumerate(rings(r)):
        sides = loop_sides(r, k, ring)
        names = " – ".join(shown.heading(after) for _, _, after in ring)
        slides = any(s.slide for s in sides)
        slid = "; s e is the displacement of a slide s along its direction e" if slides else ""
        sheet.text(f"Loop {n + 1} through links {names}: the sides sum to zero{slid}.")
        for kind, order in ORDERS[: 3 if moving else 1]:
            sheet.equations(_lines(sides, kind, order, shown))


def loop_sides(r: Result, k: int, ring: Ring) -> list[Side]:
    """Sides from joint to joint on each link, and along the slides between the two points of a joint."""
    sides: list[Side] = []
    for n, (joint, before, after) in enumerate(ring):
        following = ring[(n + 1) % len(ring)][0]
        sides += _slides(r, k, joint, before)
        span = joint_end(r, following, after, k) - joint_end(r, joint, after, k)
        w, alpha = rates_of(r, after, k)
        second = np.cross(alpha, span) + np.cross(w, np.cross(w, span))
        vectors = (span, np.cross(w, span), second)
        sides.append(Side(f"r_{{{joint}{following}}}", after, vectors))
    least = 1e-12 * max((float(np.abs(s.vectors[0]).max()) for s in sides), default=0.0)
    return [s for s in sides if s.slide or np.abs(s.vectors[0]).max() > least]


def rates_of(r: Result, link: str, k: int) -> tuple[Array, Array]:
    """Angular velocity and acceleration of a link, ground included (3,)."""
    if link == GROUND:
        return np.zeros(3), np.zeros(3)
    return r.speed(link)[k], r.acceleration(link)[k]


def _slides(r: Result, k: int, joint: str, before: str) -> list[Side]:
    """From the point of a joint on the link before to that on the link after, along each of its slides."""
    described = r.mechanism.joints[joint]
    i, axes = described.links[0], "x" if described.pair.threaded else described.pair.slides
    names = [name for name in getattr(described, "freedoms", ()) if name.startswith("slide")] if axes else []
    turn = np.eye(3) if i == GROUND else r.rotation(i)[k]
    backwards, (w, alpha), out = before != i, rates_of(r, i, k), []
    for name, axis in zip(names, axes, strict=True):
        e = (
            (-1.0 if backwards else 1.0)
            * turn
            @ r.compiled.geometries[r.joints.index(joint)].on_i[AXES.index(axis)]
        )
        s, rate, second = (float(v[k]) for v in r.freedom(joint, name))
        e1 = np.cross(w, e)
        e2 = np.cross(alpha, e) + np.cross(w, e1)
        vectors = (s * e, rate * e + s * e1, second * e + 2 * rate * e1 + s * e2)
        index = f"{joint}{axis if len(names) > 1 else ''}"
        out.append(Side(f"s_{{{index}}} e_{{{index}}}", i, vectors, index, backwards))
    return out


def _lines(sides: list[Side], kind: str, order: int, shown: Shown) -> list[Working]:
    """The sum in letters, then its components with their numbers; rounding is 0."""
    least = shown.least[kind]
    some = [s for s in sides if order == 0 or np.abs(s.vectors[order]).max() > least]
    if not some:
        return []
    lines = [Working(f"{join_signed([_letters(s, order, shown) for s in some])} = 0")]
    largest = max(float(np.abs(s.vectors[order]).max()) for s in some)
    for axis, letter in enumerate(AXES):
        values = [float(s.vectors[order][axis]) for s in some]
        total = math.fsum(values)
        numbers = join_signed([(v < -least, shown.number(kind, abs(v))) for v in values])
        total_shown = shown.number(kind, total, 1e-9 * largest)
        lines.append(Working(f"{letter}: quad {numbers} = {shown.with_unit(total_shown, kind)}"))
    return lines


def _letters(s: Side, order: int, shown: Shown) -> Signed:
    """A side, or its rates: omega x r of a fixed length, of a slide that along its axis too."""
    n = shown.link(s.link)
    turned = (
        "",
        f"omega_{{{n}}} times {s.sign}",
        f"alpha_{{{n}}} times {s.sign} + omega_{{{n}}} times (omega_{{{n}}} times {s.sign})",
    )[order]
    if order == 0:
        return s.backwards, s.sign
    if not s.slide:
        return False, turned
    e = f"e_{{{s.slide}}}"
    along = f"{'va'[order - 1]}_{{{s.slide}}} {e}"
    if s.link == GROUND:
        return s.backwards, along
    coriolis = f" + 2 omega_{{{n}}} times v_{{{s.slide}}} {e}" if order == 2 else ""
    return s.backwards, f"({along}{coriolis} + {turned})" if s.backwards else f"{along}{coriolis} + {turned}"
