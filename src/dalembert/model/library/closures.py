"""Points of the planar templates for one value of the drive, for which every pair of links must meet.

Each function is named after its template, takes its dimensions (metres, radians, points and ranges as tuples), and
returns a ``Closure``, or only raises an error for impossible dimensions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import cos, pi, sin
from types import SimpleNamespace
from typing import NamedTuple

from dalembert.errors import ModelError
from dalembert.model.library.compass import GapError, Points, meet, reach, vector_at
from dalembert.model.library.tree_parts import positive
from dalembert.model.quantities.vectors import Vector, dot, length, less

Sizes = SimpleNamespace
"""A template's dimensions by name."""


class Closure(NamedTuple):
    """The points at one value of the drive, and the angle of each link: from one point to another, or in degrees."""

    place: Callable[[float], Points]
    angles: Mapping[str, str | float]
    drive: str = "crank"


def _four_bar_points(s: Sizes, turn: float) -> Points:
    a, o4 = vector_at(s.crank, turn), complex(s.ground)
    return {"A": a, "B": meet(a, ("coupler", s.coupler), o4, ("rocker", s.rocker)), "O2": 0j, "O4": o4}


FOUR_BAR: dict[str, str | float] = {"coupler": "A B", "rocker": "O4 B"}


def _on_link(start: complex, end: complex, local: complex) -> complex:
    """Point of the link from start to end, given in link axes."""
    return start + local * (end - start) / abs(end - start)


def four_bar(s: Sizes) -> Closure:
    return Closure(lambda turn: _four_bar_points(s, turn), FOUR_BAR)


def slider_crank(s: Sizes) -> Closure:
    def place(turn: float) -> Points:
        a = vector_at(s.crank, turn)
        return {"A": a, "B": reach(a, ("rod", s.rod), 1j * s.offset)}

    return Closure(place, {"rod": "A B", "piston": 0.0})


def inverted_slider_crank(s: Sizes) -> Closure:
    gap = abs(s.ground - s.crank)
    if gap <= abs(s.offset) or not gap:
        raise ModelError(
            f"the crank pin passes O4 at {gap:.3g} m, not farther than the slide's offset of {abs(s.offset):g} m",
            "let ground and crank differ by more, or take a smaller offset",
        )
    _slot_holds("rocker", s.rocker, s.ground + s.crank)

    def place(turn: float) -> Points:
        """D is where the rocker's line through O4 would be, had it no offset from the block."""
        lever = vector_at(s.crank, turn) - s.ground
        along = (abs(lever) ** 2 - s.offset**2) ** 0.5
        return {"O4": 0j, "D": lever * complex(along, -s.offset)}

    return Closure(place, dict.fromkeys(("rocker", "block"), "O4 D"))


def whitworth(s: Sizes) -> Closure:
    if s.crank <= s.ground:
        raise ModelError(
            f"the crank {s.crank:g} m is not longer than the ground O2 O4 {s.ground:g} m, "
            "so the arm would not go round",
            "lengthen the crank, or take the template crank_shaper",
        )
    _slot_holds("slot", s.slot, s.ground + s.crank)
    return _quick_return(s, "arm", -s.throw, 0.0, forward=True)


def crank_shaper(s: Sizes) -> Closure:
    if s.crank >= s.ground:
        raise ModelError(
            f"the crank {s.crank:g} m is not shorter than the ground O2 O4 {s.ground:g} m, "
            "so the lever would not swing to and fro",
            "shorten the crank, or take the template whitworth",
        )
    _slot_holds("lever", s.lever, s.ground + s.crank)
    return _quick_return(s, "lever", s.lever, s.height, forward=False)


def _quick_return(s: Sizes, arm: str, size: float, height: float, forward: bool) -> Closure:
    """A slotted arm about O4 follows the crank pin A, and its point C, of that size along it, drives the ram D."""

    def place(turn: float) -> Points:
        a, o4 = vector_at(s.crank, turn), -1j * s.ground
        c = o4 + size * (a - o4) / abs(a - o4)
        return {"A": a, "O4": o4, "C": c, "D": reach(c, ("rod", s.rod), o4 + 1j * height, forward=forward)}

    return Closure(place, {"block": "O4 A", arm: "O4 A", "rod": "C D", "ram": 0.0})


def watt_1(s: Sizes) -> Closure:
    return _upper_dyad(s, ("A", "B"), s.coupler_point, left=False)


def stephenson_1(s: Sizes) -> Closure:
    return _upper_dyad(s, ("O2", "A"), s.crank_point, left=True)


def _upper_dyad(s: Sizes, link: tuple[str, str], point: tuple[float, float], left: bool) -> Closure:
    """A four-bar of which a point C and one of the rocker, D, carry a dyad C E D."""

    def place(turn: float) -> Points:
        at = _four_bar_points(s, turn)
        c = _on_link(at[link[0]], at[link[1]], complex(*point))
        d = _on_link(at["O4"], at["B"], complex(*s.rocker_point))
        ends = (c, ("upper coupler", s.upper_coupler)), (d, ("upper rocker", s.upper_rocker))
        e = meet(*ends[0], *ends[1]) if left else meet(*ends[1], *ends[0])
        return at | {"C": c, "D": d, "E": e}

    return Closure(place, FOUR_BAR | {"upper_coupler": "C E", "upper_rocker": "D E"})


def watt_2(s: Sizes) -> Closure:
    return _second_loop(s, ("O4", "B"), complex(*s.rocker_point))


def stephenson_3(s: Sizes) -> Closure:
    return _second_loop(s, ("A", "B"), complex(*s.coupler_point))


def _second_loop(s: Sizes, link: tuple[str, str], point: complex) -> Closure:
    """A four-bar of which a point C drives an output about O6 through a second coupler."""

    def place(turn: float) -> Points:
        at = _four_bar_points(s, turn)
        c = _on_link(at[link[0]], at[link[1]], point)
        d = meet(c, ("second coupler", s.second_coupler), complex(*s.second_ground), ("output", s.output))
        return at | {"C": c, "D": d, "O6": complex(*s.second_ground)}

    return Closure(place, FOUR_BAR | {"second_coupler": "C D", "output": "O6 D"})


def toggle_press(s: Sizes) -> Closure:
    def place(turn: float) -> Points:
        a = complex(*s.center) + vector_at(s.crank, turn)
        k = meet(a, ("rod", s.rod), 0, ("upper", s.upper))
        return {"O4": 0j, "A": a, "K": k, "D": reach(k, ("lower", s.lower), 0, -pi / 2)}

    return Closure(place, {"rod": "A K", "upper": "O4 K", "lower": "K D", "ram": -90.0})


def five_bar(s: Sizes) -> Closure:
    _refuse_no_sweep(s, "crank")
    (start, stop), (second, last) = s.sweep, s.second_sweep
    ratio = (last - second) / (stop - start)

    def place(turn: float) -> Points:
        a = vector_at(s.crank, turn)
        b = s.ground + vector_at(s.second_crank, second + ratio * (turn - start))
        c = meet(a, ("coupler", s.coupler), b, ("second coupler", s.second_coupler))
        return {"A": a, "B": b, "C": c}

    return Closure(place, {"coupler": "A C", "second_coupler": "B C"})


def _refuse_no_sweep(s: Sizes, drive: str) -> None:
    if s.sweep[0] == s.sweep[1]:
        raise ModelError(f"the sweep of the {drive} begins where it ends", "give two different angles")


def bucket(s: Sizes) -> Closure:
    positive("bucket", height_of_the_ear=abs(complex(*s.ear).imag))

    def place(stroke: float) -> Points:
        j = meet(complex(*s.base), ("cylinder", stroke), complex(*s.rocker_pivot), ("rocker", s.rocker))
        h = meet(j, ("coupler", s.coupler), 0, ("ear of the bucket", abs(complex(*s.ear))))
        return {
            "P": 0j,
            "Q": complex(*s.base),
            "R": complex(*s.rocker_pivot),
            "J": j,
            "H": h,
            "T": h / complex(*s.ear),
        }

    angles = {"cylinder": "Q J", "rod": "Q J", "rocker": "R J", "coupler": "J H", "bucket": "P T"}
    return Closure(place, angles, "cylinder")


def stephenson_2(s: Sizes) -> Closure:
    """By Newton's method on the lean of the first coupler, from its last value: no dyad begins it."""
    ends = (
        ("first coupler", s.first_coupler),
        ("second coupler", s.second_coupler),
        ("plate", s.plate_length),
    )
    last: list[float] = []

    def dyad(turn: float, lean: float) -> Points:
        a, b = vector_at(s.crank, turn), vector_at(1.0, turn) * complex(*s.crank_point)
        c = a + vector_at(s.first_coupler, lean)
        d = meet(c, ends[2], b, ends[1])
        e = _on_link(c, d, complex(*s.plate_point))
        return {"A": a, "B": b, "C": c, "D": d, "E": e, "O4": complex(s.ground)}

    def error(turn: float, lean: float) -> float:
        at = dyad(turn, lean)
        return abs(at["E"] - at["O4"]) - float(s.rocker)

    def place(turn: float) -> Points:
        lean = last[0] if last else _first_lean(lambda lean: error(turn, lean), s.rocker)
        for _ in range(20):
            miss = error(turn, lean)
            slope = (error(turn, lean + 1e-7) - miss) / 1e-7
            if abs(miss) < 1e-12 * s.rocker or slope == 0:
                break
            lean -= max(-0.2, min(0.2, miss / slope))
        if abs(miss) > 1e-9 * s.rocker:
            raise _no_rocker(s.rocker, abs(miss))
        last[:] = [lean]
        return dyad(turn, lean)

    return Closure(place, {"first_coupler": "A C", "second_coupler": "B D", "plate": "C D", "rocker": "O4 E"})


def _first_lean(error: Callable[[float], float], rocker: float) -> float:
    """The first lean from 0 to a full turn near which the error changes its sign upwards."""
    before, smallest = float("nan"), float("inf")
    for k in range(721):
        lean = k * pi / 360
        try:
            here = error(lean)
        except GapError:
            here = float("nan")
        if before <= 0 < here:
            return lean
        before, smallest = here, min(smallest, abs(here)) if here == here else smallest
    raise _no_rocker(rocker, smallest)


def _no_rocker(rocker: float, miss: float) -> GapError:
    what = f"rocker {rocker:g} m misses the point E of the plate by {miss:.3g} m"
    return GapError(miss, what, "change the rocker or the ground")


def _slot_holds(name: str, length: float, needed: float) -> None:
    """Refuse an arm that ends before the farthest place of its block."""
    if length < needed:
        raise ModelError(
            f"the block goes out to {needed:.4g} m from O4, and the {name} ends at {length:g} m",
            f"lengthen the {name} to {needed:.4g} m or more",
        )


def hooke_joint(s: Sizes) -> None:
    """Shafts at an angle, which is checked; they close whatever it is."""
    angle = s.angle * 180 / pi
    if not 1e-12 < angle < 90 - 1e-12:
        raise ModelError(f"angle is {angle:g} degrees", "give one between 0 and 90 degrees")


double_cardan = hooke_joint


def bevel_differential(s: Sizes) -> None:
    _refuse_no_sweep(s, "left wheel")


def rssr(s: Sizes) -> None:
    """B on the rocker's circle is at the rod's length from A all over the sweep."""

    def closes(gap: Vector, along: float) -> bool:
        square = dot(gap, gap)
        most = 2 * s.rocker * max(square - along**2, 0.0) ** 0.5
        return bool(abs(square + s.rocker**2 - s.rod**2) <= most)

    _closes_in_space(s, s.center, _direction("axis", s.axis), closes, "the rod or the rocker")


def rssp(s: Sizes) -> None:
    """B on the slider's line is at the rod's length from A all over the sweep."""

    def closes(gap: Vector, along: float) -> bool:
        return bool(s.rod**2 - dot(gap, gap) + along**2 >= 0)

    _closes_in_space(s, s.guide, _direction("direction", s.direction), closes, "the rod")


def _direction(key: str, vector: Vector) -> Vector:
    if not any(vector):
        raise ModelError(f"{key} has no direction", "give one component other than 0")
    size = length(vector)
    return vector[0] / size, vector[1] / size, vector[2] / size


def _closes_in_space(
    s: Sizes, start: Vector, e: Vector, closes: Callable[[Vector, float], bool], what: str
) -> None:
    """Checks the distance to A from a point of a line along e, at each turn of a crank about z, and with the crank at
    0."""

    def at(turn: float) -> bool:
        gap = less((s.crank * cos(turn), s.crank * sin(turn), 0.0), start)
        return closes(gap, dot(gap, e))

    first, last = s.sweep
    turns = [first + (last - first) * k / 360 for k in range(361)]
    gaps = [turn for turn in turns if not at(turn)] or ([] if at(0.0) else [0.0])
    if gaps:
        low, high = round(gaps[0] * 180 / pi), round(gaps[-1] * 180 / pi)
        raise ModelError(
            f"does not close from {low} to {high} degrees of the crank",
            f"change {what}, or give the crank a smaller range",
        )
