"""dalembert's Python call against students' scripts of seven mechanisms, one thread, same run.

Templates with gravity and an accelerated crank. A script has closed forms of two-link groups with all rates, and at
each position all equations of motion in one matrix for ``np.linalg.solve``: all reactions, the torque. It is in
functions as one writes them for a course: 13.6 ms for a slider-crank's nine equations, 9.9 written out in four_bar.py.
Torques and forces in pins must agree to 1e-9 of the largest. dalembert's columns are as there. The crank's mass equals
no other number: equal ones are one in a kept program, and the change that parts them costs a call as if met first.
Medians of 15 in turns, one core free; after each of dalembert's, how many times as long the script takes:

    720 positions           student      met first           kept  other numbers  gap
    slider-crank                 13.4     4.88   2.7     0.89  14.9     0.82  16.4  5e-16
    Watt I six-bar               21.5     7.42   2.9     1.47  14.6     1.27  16.9  2e-15
    Stephenson III six-bar       20.2     7.22   2.8     1.36  14.8     1.27  15.9  1e-15
    Whitworth quick return       20.1     7.18   2.8     1.50  13.3     1.26  15.9  9e-16
    crank shaper                 20.2     8.42   2.4     1.48  13.6     1.35  15.0  1e-15
    engine of 4 cylinders        36.3     9.94   3.7     2.12  17.1     1.93  18.8  6e-16
    engine of 16 cylinders      160.5    31.50   5.1     6.12  26.2     5.76  27.9  2e-15

    python -m benchmarks.by_hand [--repeat 15]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from cmath import rect  # noqa: E402
from collections.abc import Callable, Iterable  # noqa: E402
from math import sqrt  # noqa: E402
from typing import Any  # noqa: E402

import numpy as np  # noqa: E402
from benchmarks.four_bar import timed  # noqa: E402

import dalembert as da  # noqa: E402
from dalembert.analysis.engine.structures import STRUCTURES  # noqa: E402

COUNT = 720
Point = tuple[complex, complex, complex]  # position, velocity, acceleration: x + iy, as all vectors here
Body = tuple[complex, complex, complex, complex, float, float]  # of its origin; x axis, w, alpha
Inertia = tuple[float, complex, float]  # mass, its centre in the link's axes, inertia about it
Pin = tuple[complex, int, int]  # where it is; its links by number, -1 the ground
Slide = tuple[complex, complex, int, int]  # the same, with the normal
Force = tuple[complex, int, complex]  # where it acts, on which link, its value


def point(body: Body, local: complex) -> Point:
    """A point of a link, given in its axes."""
    r, v, a, u, w, al = body
    s = u * local
    return r + s, v + 1j * w * s, a + (1j * al - w * w) * s


def dot(p: complex, q: complex) -> float:
    return p.real * q.real + p.imag * q.imag


def cross(p: complex, q: complex) -> float:
    return p.real * q.imag - p.imag * q.real


def two_bars(p: Point, q: Point, a: float, b: float, side: int) -> tuple[Body, Body]:
    """Bars of a from P and of b from Q that meet at the left (1) or right (-1) of P Q: circle and circle."""
    gap = q[0] - p[0]
    e = abs(gap)
    x = (a * a - b * b + e * e) / (2 * e)
    s = complex(x, side * sqrt(a * a - x * x)) * gap / e
    t = s - gap
    d = cross(s, t)  # v_P + i w1 s = v_Q + i w2 t, two equations by Cramer's rule; the same for alpha
    dv = q[1] - p[1]
    w1, w2 = dot(dv, t) / d, dot(dv, s) / d
    da_ = q[2] - p[2] + w1 * w1 * s - w2 * w2 * t
    return (*p, s / a, w1, dot(da_, t) / d), (*q, t / b, w2, dot(da_, s) / d)


def bar_on_line(p: Point, length: float, line: complex, forward: int) -> Body:
    """A bar from P whose end is on the line along x through a fixed point: circle and line."""
    y = line.imag - p[0].imag
    s = complex(forward * sqrt(length * length - y * y), y)
    w = -p[1].imag / s.real
    return *p, s / length, w, (w * w * y - p[2].imag) / s.real


def slotted_arm(p: Point, pivot: complex) -> Body:
    """An arm about a fixed pivot whose line goes through P."""
    s = p[0] - pivot
    e = abs(s)
    u = s / e
    w = cross(u, p[1]) / e
    return pivot, 0j, 0j, u, w, (cross(u, p[2]) - 2 * w * dot(u, p[1])) / e


def pin(m: np.ndarray, column: int, centers: list[complex], at: complex, first: int, second: int) -> None:
    """A force at a point on the second link, its opposite on the first (-1: the ground)."""
    for k, sign in ((first, -1.0), (second, 1.0)):
        if k >= 0:
            s = at - centers[k]
            m[3 * k, column] = m[3 * k + 1, column + 1] = sign
            m[3 * k + 2, column], m[3 * k + 2, column + 1] = -sign * s.imag, sign * s.real


def slide(
    m: np.ndarray, column: int, centers: list[complex], at: complex, normal: complex, first: int, second: int
) -> None:
    """A force along the normal and a couple on the second link, their opposites on the first."""
    for k, sign in ((first, -1.0), (second, 1.0)):
        if k >= 0:
            m[3 * k, column], m[3 * k + 1, column] = sign * normal.real, sign * normal.imag
            m[3 * k + 2, column] = sign * cross(at - centers[k], normal)
            m[3 * k + 2, column + 1] = sign


def solve(
    inertias: list[Inertia], bodies: list[Body], g: complex, pins: list[Pin], slides: list[Slide],
    forces: list[Force], couple: float = 0.0,
) -> np.ndarray:  # fmt: skip
    """All reactions and last the torque on link 0, the crank: three equations a link, moments about its mass centre.

    `couple`: on the last link.
    """
    n = 3 * len(bodies)
    m, b, centers = np.zeros((n, n)), np.zeros(n), []
    for k, ((mass, local, inertia), body) in enumerate(zip(inertias, bodies, strict=True)):
        c, _, a = point(body, local)
        f = mass * (a - g)
        b[3 * k], b[3 * k + 1], b[3 * k + 2] = f.real, f.imag, inertia * body[5]
        centers.append(c)
    for k, (at, first, second) in enumerate(pins):
        pin(m, 2 * k, centers, at, first, second)
    for k, (at, normal, first, second) in enumerate(slides, len(pins)):
        slide(m, 2 * k, centers, at, normal, first, second)
    for at, k, force in forces:
        b[3 * k] -= force.real
        b[3 * k + 1] -= force.imag
        b[3 * k + 2] -= cross(at - centers[k], force)
    b[-1] -= couple
    m[2, -1] = 1
    return np.linalg.solve(m, b)


class Numbers:
    """Those of a description, read before the loop; angles, lengths and vectors as the student wants them."""

    def __init__(self, m: da.Mechanism) -> None:
        self.links: dict[str, Any] = dict(m.links)
        self.loads: dict[str, Any] = dict(m.loads)
        self.g = complex(*m.gravity_vector[:2])
        drive: Any = next(iter(m.drives.values()))
        self.w, self.al = float(drive.speed), float(drive.acceleration)

    def inertias(self, names: Iterable[str]) -> list[Inertia]:
        links = [self.links[name] for name in names]
        return [(k.mass or 0.0, complex(*(k.center or (0, 0))), k.inertia) for k in links]

    def at(self, link: str, name: str) -> complex:
        return complex(*self.links[link].points[name])

    def crank(self, t: float) -> Body:
        return 0j, 0j, 0j, rect(1, t), self.w, self.al


ByHand = tuple[Callable[..., np.ndarray], list[str]]
"""All unknowns at an angle of the crank, given the values there of the loads with these names."""


def student(m: da.Mechanism, by_hand: ByHand, angles: np.ndarray) -> list[np.ndarray]:
    """The script's loop over the positions."""
    position, names = by_hand
    loads: dict[str, Any] = dict(m.loads)
    tables = [loads[name].value for name in names]
    forces = [np.interp(angles % v.period, v.x, v.y).tolist() for v in tables]
    return [position(*given) for given in zip(angles.tolist(), *forces, strict=True)]


# The mechanisms, one position each. Unknowns: forces of pins in the order of the file, of sliders, the torque.


def slider_crank(m: da.Mechanism) -> ByHand:
    n = Numbers(m)
    inertias = n.inertias(["crank", "rod", "piston"])
    a, b, line = n.at("crank", "A"), n.at("rod", "B"), n.at("ground", "C")
    load = complex(*n.loads["load"].value)

    def position(t: float) -> np.ndarray:
        crank = n.crank(t)
        pin_a = point(crank, a)
        rod = bar_on_line(pin_a, b.real, line, 1)
        pin_b = point(rod, b)
        bodies = [crank, rod, (*pin_b, 1, 0.0, 0.0)]
        pins = [(0j, -1, 0), (pin_a[0], 0, 1), (pin_b[0], 1, 2)]
        slides = [(pin_b[0], 1j, -1, 2)]
        return solve(inertias, bodies, n.g, pins, slides, [(pin_b[0], 2, load)])

    return position, []


def watt(m: da.Mechanism) -> ByHand:
    n = Numbers(m)
    inertias = n.inertias(["crank", "coupler", "rocker", "upper_coupler", "upper_rocker"])
    a, b, rocker_b = n.at("crank", "A"), n.at("coupler", "B").real, n.at("rocker", "B").real
    c, d, o4 = n.at("coupler", "C"), n.at("rocker", "D"), (n.at("ground", "O4"), 0j, 0j)
    load = complex(*n.loads["load"].value)
    upper_c, upper_r = n.at("upper_coupler", "E").real, n.at("upper_rocker", "E").real

    def position(t: float) -> np.ndarray:
        crank = n.crank(t)
        pin_a = point(crank, a)
        coupler, rocker = two_bars(pin_a, o4, b, rocker_b, 1)
        pin_b, pin_c, pin_d = coupler[0] + coupler[3] * b, point(coupler, c), point(rocker, d)
        upper_coupler, upper_rocker = two_bars(pin_c, pin_d, upper_c, upper_r, -1)
        pin_e = upper_coupler[0] + upper_coupler[3] * upper_c
        bodies = [crank, coupler, rocker, upper_coupler, upper_rocker]
        pins = [(0j, -1, 0), (pin_a[0], 0, 1), (pin_b, 1, 2), (o4[0], -1, 2)]
        pins += [(pin_c[0], 1, 3), (pin_d[0], 2, 4), (pin_e, 3, 4)]
        return solve(inertias, bodies, n.g, pins, [], [(pin_e, 4, load)])

    return position, []


def stephenson(m: da.Mechanism) -> ByHand:
    n = Numbers(m)
    inertias = n.inertias(["crank", "coupler", "rocker", "second_coupler", "output"])
    a, b, rocker_b = n.at("crank", "A"), n.at("coupler", "B").real, n.at("rocker", "B").real
    c, d, output_d = n.at("coupler", "C"), n.at("second_coupler", "D").real, n.at("output", "D").real
    o4, o6, torque = (n.at("ground", "O4"), 0j, 0j), (n.at("ground", "O6"), 0j, 0j), n.loads["torque"].value

    def position(t: float) -> np.ndarray:
        crank = n.crank(t)
        pin_a = point(crank, a)
        coupler, rocker = two_bars(pin_a, o4, b, rocker_b, 1)
        pin_b, pin_c = coupler[0] + coupler[3] * b, point(coupler, c)
        second_coupler, output = two_bars(pin_c, o6, d, output_d, 1)
        pin_d = second_coupler[0] + second_coupler[3] * d
        bodies = [crank, coupler, rocker, second_coupler, output]
        pins = [(0j, -1, 0), (pin_a[0], 0, 1), (pin_b, 1, 2), (o4[0], -1, 2)]
        pins += [(pin_c[0], 1, 3), (pin_d, 3, 4), (o6[0], -1, 4)]
        return solve(inertias, bodies, n.g, pins, [], [], torque)

    return position, []


def quick_return(m: da.Mechanism) -> ByHand:
    """Whitworth's, whose arm goes round and pushes the ram, and the shaper's, whose lever swings and pulls it."""
    n = Numbers(m)
    arm_name, forward = ("arm", 1) if "arm" in m.links else ("lever", -1)
    inertias = n.inertias(["crank", "block", arm_name, "rod", "ram"])
    a, c, d = n.at("crank", "A"), n.at(arm_name, "C"), n.at("rod", "D")
    o4, guide, along = n.at("ground", "O4"), n.at("ground", "G"), rect(1, n.loads["cutting"].direction)

    def position(t: float, force: float) -> np.ndarray:
        crank = n.crank(t)
        pin_a = point(crank, a)
        arm = slotted_arm(pin_a, o4)
        pin_c = point(arm, c)
        rod = bar_on_line(pin_c, d.real, guide, forward)
        pin_d = point(rod, d)
        bodies = [crank, (*pin_a, *arm[3:]), arm, rod, (*pin_d, 1, 0.0, 0.0)]
        pins = [(0j, -1, 0), (pin_a[0], 0, 1), (o4, -1, 2), (pin_c[0], 2, 3), (pin_d[0], 3, 4)]
        slides = [(pin_a[0], 1j * arm[3], 2, 1), (pin_d[0], 1j, -1, 4)]
        return solve(inertias, bodies, n.g, pins, slides, [(pin_d[0], 4, force * along)])

    return position, ["cutting"]


def engine(m: da.Mechanism) -> ByHand:
    n = Numbers(m)
    cylinders = range(1, len(m.links) // 2)
    inertias = n.inertias(["crank", *(f"{name}_{k}" for k in cylinders for name in ("rod", "piston"))])
    throws, b = [n.at("crank", f"A_{k}") for k in cylinders], n.at("rod_1", "B_1")

    def position(t: float, *gas: float) -> np.ndarray:
        crank = n.crank(t)
        bodies, pins, slides, forces = [crank], [(0j, -1, 0)], [], []
        for k, (throw, force) in enumerate(zip(throws, gas, strict=True)):
            pin_a = point(crank, throw)
            rod = bar_on_line(pin_a, b.real, 0j, 1)
            pin_b = point(rod, b)
            bodies += [rod, (*pin_b, 1, 0.0, 0.0)]
            pins += [(pin_a[0], 0, 2 * k + 1), (pin_b[0], 2 * k + 1, 2 * k + 2)]
            slides.append((pin_b[0], 1j, -1, 2 * k + 2))
            forces.append((pin_b[0], 2 * k + 2, complex(-force)))
        return solve(inertias, bodies, n.g, pins, slides, forces)

    return position, [f"gas_{k}" for k in cylinders]


ROWS: dict[str, tuple[Callable[..., da.Mechanism], Callable[[da.Mechanism], ByHand]]] = {
    "slider-crank": (da.slider_crank, slider_crank),
    "Watt I six-bar": (da.watt_1, watt),
    "Stephenson III six-bar": (da.stephenson_3, stephenson),
    "Whitworth quick return": (da.whitworth, quick_return),
    "crank shaper": (da.crank_shaper, quick_return),
    "engine of 4 cylinders": (lambda **k: da.in_line_engine(cylinders=4, **k), engine),
    "engine of 16 cylinders": (lambda **k: da.in_line_engine(cylinders=16, **k), engine),
}


def gap_between(r: da.Result, found: np.ndarray, drive: str) -> float:
    """The largest difference of torques and of reactions in pins, each of its largest; refused over 1e-9."""
    pins = [name for name, joint in r.mechanism.joints.items() if joint.type == "pin"]
    pairs = [(r.effort(drive), found[:, -1])]
    pairs += [(r.reaction(name), found[:, 2 * k : 2 * k + 2]) for k, name in enumerate(pins)]
    gap = max(float(np.max(np.abs(ours - theirs)) / np.max(np.abs(ours))) for ours, theirs in pairs)
    if not r.ok.all() or not gap < 1e-9:
        raise SystemExit(f"{r.mechanism.title}: torques or reactions differ by {gap:.1e} of the largest")
    return gap


def compare(name: str, repeat: int) -> None:
    make, write = ROWS[name]
    m = make(positions=COUNT)
    drive, mass = next(iter(m.drives)), 1.037 * (m.links["crank"].mass or 0.0)
    changes = {"gravity": "standard", f"drives.{drive}.acceleration": -40.0, "links.crank.mass": mass}
    m = m.with_values(changes)
    by_hand, r = write(m), da.dynamics(m)
    angles = r.drive_position(drive)
    gap = gap_between(r, np.array(student(m, by_hand, angles)), drive)
    others = iter([m.with_values({"links.crank.mass": mass * (1 + 0.01 * k)}) for k in range(1, repeat + 2)])

    def met_first() -> object:
        STRUCTURES.found.clear()
        return da.dynamics(m)

    calls: dict[str, Callable[[], object]] = {
        "student": lambda: student(m, by_hand, angles),
        "met first": met_first,
        "kept": lambda: da.dynamics(m),
        "other numbers": lambda: da.dynamics(next(others)),
    }
    by_student, *ours = (1e3 * seconds for seconds in timed(calls, repeat).values())
    said = "".join(f"{ms:9.2f} {by_student / ms:5.1f}" for ms in ours)
    print(f"{name:24}{by_student:9.1f}{said}  {gap:.0e}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=15)
    repeat = parser.parse_args().repeat
    title = f"{COUNT} positions, ms"
    print(f"{title:26}student      met first           kept  other numbers  gap")
    for name in ROWS:
        compare(name, repeat)


if __name__ == "__main__":
    main()
