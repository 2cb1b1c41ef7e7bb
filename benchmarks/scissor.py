"""Long mechanisms: how the time grows with the number of links, of scissor lifts and of chains of four-bars.

Method. Of a scissor of n stages (2n links), each is two crossed bars; the foot of one is driven, that of the other
runs in a slot. Of a chain of n parallel four-bars (2n + 1 links), n + 1 equal bars on the ground are joined by rods as
long as their pivots are apart, and the first is driven: a chain that closes at any length. (Of other two-link groups in
series each adds to the motion until one cannot follow: ``linkages.chain`` still turns with 80 groups, with 99 it does
not, and is refused.) A load stands at the end. ``da.dynamics(m)`` is called on the loaded description, after warming
calls, at 1, 16 and 720 positions, one thread; medians of the processor time, time a link, and the exponent p of
(links)^p from one number of links to the next are printed. The efforts are checked against virtual work on the closed
form. One position is measured on the careful path too.

Measured (2 cores of a virtual x86-64 machine, both busy), from 20 to 100 and from 100 to 400 links: scissors at 720
positions 5.1, 26 and 115 ms, exponents 1.01 and 1.08; chains 4.8, 21 and 94 ms, exponents 0.95 and 1.09. One position
of 2,000 links on the careful path: 65 ms, scissor and chain; 125 while matrices were not eliminated by narrow bands.

    python benchmarks/scissor.py [--stages 10 50 200] [--counts 1 16 720]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from collections.abc import Callable  # noqa: E402
from itertools import pairwise  # noqa: E402
from math import cos, log, radians  # noqa: E402
from statistics import median  # noqa: E402
from time import process_time  # noqa: E402
from typing import Any  # noqa: E402

MASS, LOAD, GRAVITY = 1.5, 400.0, 9.80665
START = 30.0
BAR, ROD = 0.1, 0.3


def scissor(stages: int, count: int) -> dict[str, Any]:
    links: dict[str, Any] = {"ground": {"points": {"U0": [0, 0], "V0": [0, 0]}}}
    joints: dict[str, Any] = {
        "U0": {"type": "pin", "links": ["ground", "up1"]},
        "V0": {"type": "slot", "links": ["ground", "down1"], "direction": 0},
    }
    for k in range(1, stages + 1):
        bar = {"mass": MASS, "center": [0.5, 0], "inertia": 0.12}
        links[f"up{k}"] = {"points": {f"U{k - 1}": [0, 0], "X": [0.5, 0], f"V{k}": [1, 0]}, **bar}
        links[f"down{k}"] = {"points": {f"V{k - 1}": [0, 0], "X": [0.5, 0], f"U{k}": [1, 0]}, **bar}
        joints[f"X{k}"] = {"type": "pin", "links": [f"up{k}", f"down{k}"], "at": "X"}
        if k < stages:
            joints[f"U{k}"] = {"type": "pin", "links": [f"down{k}", f"up{k + 1}"]}
            joints[f"V{k}"] = {"type": "pin", "links": [f"up{k}", f"down{k + 1}"]}
    return {
        "gravity": "standard",
        "links": links,
        "joints": joints,
        "drives": {"U0": {"position": START if count == 1 else {"from": START, "to": 40, "count": count}}},
        "loads": {"P": {"type": "force", "on": f"up{stages}", "at": f"V{stages}", "value": [0, -LOAD]}},
        "assembly": {
            name: (START if name.startswith("up") else 180 - START) for name in links if name != "ground"
        },
    }


def four_bars(groups: int, count: int) -> dict[str, Any]:
    links: dict[str, Any] = {"ground": {"points": {f"G{k}": [ROD * k, 0] for k in range(groups + 1)}}}
    joints: dict[str, Any] = {}
    mass = {"mass": MASS, "inertia": 0.01}
    for k in range(groups + 1):
        links[f"bar{k}"] = {"points": {f"G{k}": [0, 0], f"A{k}": [BAR, 0]}, "center": [BAR / 2, 0], **mass}
        joints[f"G{k}"] = {"type": "pin", "links": ["ground", f"bar{k}"]}
    for k in range(groups):
        rod = f"rod{k}"
        links[rod] = {"points": {f"A{k}": [0, 0], f"A{k + 1}": [ROD, 0]}, "center": [ROD / 2, 0], **mass}
        joints[f"P{k}"] = {"type": "pin", "links": [f"bar{k}", rod], "at": f"A{k}"}
        joints[f"Q{k}"] = {"type": "pin", "links": [rod, f"bar{k + 1}"], "at": f"A{k + 1}"}
    return {
        "gravity": "standard",
        "links": links,
        "joints": joints,
        "drives": {"G0": {"position": START if count == 1 else {"from": START, "to": 60, "count": count}}},
        "loads": {"P": {"type": "force", "on": f"bar{groups}", "at": f"A{groups}", "value": [0, -LOAD]}},
        "assembly": {name: START * name.startswith("bar") for name in links if name != "ground"},
    }


def scissor_effort(stages: int) -> float:
    """Virtual work at 30 degrees: each bar's centre stands at (k + 1/2) sin, the load at n sin."""
    rise = 2 * MASS * GRAVITY * sum(k + 0.5 for k in range(stages)) + LOAD * stages
    return rise * cos(radians(30))


def four_bars_effort(groups: int) -> float:
    """Virtual work at 30 degrees: bars rise by half of what the rods and the load do."""
    return ((groups + 1) * MASS * GRAVITY / 2 + groups * MASS * GRAVITY + LOAD) * BAR * cos(radians(START))


FAMILIES: dict[str, tuple[Callable[[int, int], Any], Callable[[int], float]]] = {
    "scissors": (scissor, scissor_effort),
    "chains of parallel four-bars": (four_bars, four_bars_effort),
}


def measured(family: str, size: int, count: int, repeat: int, method: Any = "auto") -> tuple[int, float]:
    """Links that move, and seconds."""
    import dalembert as da

    describe, exact = FAMILIES[family]
    m = da.mechanism(describe(size, count))
    links = len(m.links) - 1
    for _ in range(2 + links // 200):  # a structure of many links is met more often before it is traced
        r = da.dynamics(m, method=method)
    if not all(r.ok):
        print(f"  n = {size}: {r.problems()[:2]}")
    error = abs(r.effort(next(iter(m.drives)))[0] / exact(size) - 1)
    times = []
    for _ in range(repeat):
        start = process_time()
        da.dynamics(m, method=method)
        times.append(process_time() - start)
    seconds = median(times)
    case = f"n = {size:4} ({links:4} links), {count:3} positions"
    each = seconds / count / links
    print(f"  {case}: {seconds * 1e3:10.2f} ms, {each * 1e6:8.2f} us a link; error {error:.1e}")
    return links, seconds


def growth(family: str, sizes: list[int], count: int, repeat: int, method: Any = "auto") -> None:
    print(f"{family}, {method}")
    found = [measured(family, n, count, repeat, method) for n in sizes]
    for (few, a), (many, b) in pairwise(found):
        print(f"  from {few} to {many} links: exponent {log(b / a) / log(many / few):.2f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--stages", type=int, nargs="+", default=[10, 50, 200])
    parser.add_argument("--counts", type=int, nargs="+", default=[1, 16, 720])
    parser.add_argument("--repeat", type=int, default=5)
    args = parser.parse_args()
    for family in FAMILIES:
        for count in args.counts:
            growth(family, args.stages, count, args.repeat)
        growth(family, [*args.stages, 1000], 1, args.repeat, "careful")


if __name__ == "__main__":
    main()
