"""A scissor lift of n stages (2n links, one loop after another): how the time grows with the number of links.

Method. Each stage is two crossed bars; the foot of one is driven, that of the other runs in a slot, loads stand on
the top. ``da.dynamics(m)`` is called on the loaded description, after one warming call, at 1 and at 16 positions, one
thread; medians of the processor time, time a link, and the ratio of n = 400 to n = 50 (8 times the links) are printed.
The efforts are checked against virtual work on the closed form: every stage rises by sin(angle).

Measured (2 cores of a virtual x86-64 machine): 1 position 14 and 61 ms, ratio 4.2; 16 positions 50 and 192 ms, ratio
3.8. It was 13.1 while stations of the march had to be less than 1.7 links' lengths apart, which the top of a long chain
passes within a degree of the drive.

    python benchmarks/scissor.py [--stages 50 400]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from math import cos, radians  # noqa: E402
from statistics import median  # noqa: E402
from time import process_time  # noqa: E402
from typing import Any  # noqa: E402

MASS, LOAD, GRAVITY = 1.5, 400.0, 9.80665


def description(stages: int, count: int) -> dict[str, Any]:
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
    start = 30.0
    return {
        "gravity": "standard",
        "links": links,
        "joints": joints,
        "drives": {"U0": {"position": start if count == 1 else {"from": start, "to": 40, "count": count}}},
        "loads": {"P": {"type": "force", "on": f"up{stages}", "at": f"V{stages}", "value": [0, -LOAD]}},
        "assembly": {
            name: (start if name.startswith("up") else 180 - start) for name in links if name != "ground"
        },
    }


def exact_effort(stages: int) -> float:
    """Virtual work at 30 degrees: each bar's centre stands at (k + 1/2) sin, the load at n sin."""
    rise = 2 * MASS * GRAVITY * sum(k + 0.5 for k in range(stages)) + LOAD * stages
    return rise * cos(radians(30))


def measured(stages: int, count: int, repeat: int) -> float:
    import dalembert as da

    m = da.mechanism(description(stages, count))
    r = da.dynamics(m)
    if not all(r.ok):
        print(f"  n = {stages}: {r.problems()[:2]}")
    error = abs(r.effort("U0")[0] / exact_effort(stages) - 1)
    times = []
    for _ in range(repeat):
        start = process_time()
        da.dynamics(m)
        times.append(process_time() - start)
    seconds = median(times)
    a_link = seconds / count / (2 * stages)
    case = f"n = {stages:4} ({2 * stages:4} links), {count:2} positions"
    print(f"  {case}: {seconds * 1e3:10.2f} ms, {a_link * 1e6:8.2f} us a link; error {error:.1e}")
    return seconds


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--stages", type=int, nargs="+", default=[50, 400])
    parser.add_argument("--repeat", type=int, default=5)
    args = parser.parse_args()
    for count in (1, 16):
        times = [measured(n, count, args.repeat) for n in args.stages]
        print(f"  {count} positions: ratio of the last to the first {times[-1] / times[0]:.1f}")


if __name__ == "__main__":
    main()
