"""A dynamic four-bar: dalembert's Python call against a student's script, one thread, same run.

Method. Both solve the same crank-rocker with masses, inertia, gravity, a force on the coupler and a couple on the
rocker at the same positions, everything a student asks for: all rates, all reactions, the input torque. The script is
what a competent student writes: closed-form kinematics and the nine equations filled and solved in a loop over the
positions. dalembert is called as a user calls it on a description already loaded (``da.dynamics(m)``), with an
`assembly` read off a drawing to a degree, after one warming call; further rows are a structure met for the first time
(its kept program forgotten before each call), other numbers in each call (the crank's mass), and the careful path. Each
is repeated, in turns; medians and their ratio are printed, and the largest difference of torques. The last row is a
student who knows numpy's batches: everything over arrays, one stacked solve.

    python benchmarks/four_bar.py [--repeat 15]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from collections.abc import Callable  # noqa: E402
from math import acos, atan2, cos, hypot, sin  # noqa: E402
from statistics import median  # noqa: E402
from time import perf_counter  # noqa: E402
from typing import Any  # noqa: E402

import numpy as np  # noqa: E402

A, B, C, D = 0.12, 0.38, 0.25, 0.40
M2, M3, M4 = 1.2, 2.1, 1.7
I2, I3, I4 = 0.003, 0.02, 0.011
G2, G3, G4 = (0.04, 0.02), (0.2, 0.06), (0.1, -0.03)
W2, AL2, GRAVITY = 18.0, -40.0, 9.80665
FX, FY, COUPLE = 120.0, -75.0, -14.0


def description(count: int) -> dict[str, Any]:
    return {
        "gravity": "standard",
        "links": {
            "ground": {"points": {"O2": [0, 0], "O4": [D, 0]}},
            "crank": {"points": {"O2": [0, 0], "A": [A, 0]}, "mass": M2, "center": list(G2), "inertia": I2},
            "coupler": {"points": {"A": [0, 0], "B": [B, 0]}, "mass": M3, "center": list(G3), "inertia": I3},
            "rocker": {"points": {"O4": [0, 0], "B": [C, 0]}, "mass": M4, "center": list(G4), "inertia": I4},
        },
        "joints": {
            "O2": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "coupler"]},
            "B": {"type": "pin", "links": ["coupler", "rocker"]},
            "O4": {"type": "pin", "links": ["ground", "rocker"]},
        },
        "drives": {
            "O2": {
                "position": {"from": 0, "to": 360, "count": count},
                "speed": f"{W2} rad/s",
                "acceleration": f"{AL2} rad/s^2",
            }
        },
        "loads": {
            "F": {"type": "force", "on": "coupler", "at": "center", "value": [FX, FY]},
            "T": {"type": "couple", "on": "rocker", "value": COUPLE},
        },
        "assembly": {"coupler": 41, "rocker": 89},
    }


def student_position(t2: float) -> np.ndarray:
    """One position: F12 F23 F34 F14 and the torque."""
    ax, ay = A * cos(t2), A * sin(t2)
    e = hypot(D - ax, ay)
    t3 = atan2(-ay, D - ax) + acos((B * B + e * e - C * C) / (2 * B * e))
    t4 = atan2(ay + B * sin(t3), ax + B * cos(t3) - D)
    w3 = A * W2 * sin(t4 - t2) / (B * sin(t3 - t4))
    w4 = A * W2 * sin(t2 - t3) / (C * sin(t4 - t3))
    ex = -A * (AL2 * sin(t2) + W2**2 * cos(t2)) - B * w3**2 * cos(t3) + C * w4**2 * cos(t4)
    ey = A * (AL2 * cos(t2) - W2**2 * sin(t2)) - B * w3**2 * sin(t3) + C * w4**2 * sin(t4)
    al3 = -(ex * cos(t4) + ey * sin(t4)) / (B * sin(t4 - t3))
    al4 = -(ex * cos(t3) + ey * sin(t3)) / (C * sin(t4 - t3))
    x2, y2 = G2[0] * cos(t2) - G2[1] * sin(t2), G2[0] * sin(t2) + G2[1] * cos(t2)
    x3, y3 = G3[0] * cos(t3) - G3[1] * sin(t3), G3[0] * sin(t3) + G3[1] * cos(t3)
    x4, y4 = G4[0] * cos(t4) - G4[1] * sin(t4), G4[0] * sin(t4) + G4[1] * cos(t4)
    a2x, a2y = -AL2 * y2 - W2**2 * x2, AL2 * x2 - W2**2 * y2
    a3x = -AL2 * ay - W2**2 * ax - al3 * y3 - w3**2 * x3
    a3y = AL2 * ax - W2**2 * ay + al3 * x3 - w3**2 * y3
    a4x, a4y = -al4 * y4 - w4**2 * x4, al4 * x4 - w4**2 * y4
    bx, by = B * cos(t3), B * sin(t3)
    cx, cy = C * cos(t4), C * sin(t4)
    m = np.zeros((9, 9))
    m[0, 0], m[0, 2] = 1, -1
    m[1, 1], m[1, 3] = 1, -1
    m[2, 0], m[2, 1], m[2, 2], m[2, 3], m[2, 8] = y2, -x2, ay - y2, x2 - ax, 1
    m[3, 2], m[3, 4] = 1, -1
    m[4, 3], m[4, 5] = 1, -1
    m[5, 2], m[5, 3], m[5, 4], m[5, 5] = y3, -x3, by - y3, x3 - bx
    m[6, 4], m[6, 6] = 1, 1
    m[7, 5], m[7, 7] = 1, 1
    m[8, 4], m[8, 5], m[8, 6], m[8, 7] = y4 - cy, cx - x4, y4, -x4
    b = np.array([
        M2 * a2x, M2 * (a2y + GRAVITY), I2 * AL2,
        M3 * a3x - FX, M3 * (a3y + GRAVITY) - FY, I3 * al3,
        M4 * a4x, M4 * (a4y + GRAVITY), I4 * al4 - COUPLE,
    ])  # fmt: skip
    return np.linalg.solve(m, b)


def student(angles: np.ndarray) -> np.ndarray:
    """The script's loop."""
    out = np.zeros((len(angles), 9))
    for k, t2 in enumerate(angles):
        out[k] = student_position(t2)
    return out


def batched_student(t2: np.ndarray) -> np.ndarray:
    """The same over arrays, by one who knows numpy: stacked 9 x 9, one call of ``solve``."""
    s, c = np.sin, np.cos
    ax, ay = A * c(t2), A * s(t2)
    e = np.hypot(D - ax, ay)
    t3 = np.arctan2(-ay, D - ax) + np.arccos((B * B + e * e - C * C) / (2 * B * e))
    t4 = np.arctan2(ay + B * s(t3), ax + B * c(t3) - D)
    w3 = A * W2 * s(t4 - t2) / (B * s(t3 - t4))
    w4 = A * W2 * s(t2 - t3) / (C * s(t4 - t3))
    ex = -A * (AL2 * s(t2) + W2**2 * c(t2)) - B * w3**2 * c(t3) + C * w4**2 * c(t4)
    ey = A * (AL2 * c(t2) - W2**2 * s(t2)) - B * w3**2 * s(t3) + C * w4**2 * s(t4)
    al3 = -(ex * c(t4) + ey * s(t4)) / (B * s(t4 - t3))
    al4 = -(ex * c(t3) + ey * s(t3)) / (C * s(t4 - t3))
    x2, y2 = G2[0] * c(t2) - G2[1] * s(t2), G2[0] * s(t2) + G2[1] * c(t2)
    x3, y3 = G3[0] * c(t3) - G3[1] * s(t3), G3[0] * s(t3) + G3[1] * c(t3)
    x4, y4 = G4[0] * c(t4) - G4[1] * s(t4), G4[0] * s(t4) + G4[1] * c(t4)
    a2x, a2y = -AL2 * y2 - W2**2 * x2, AL2 * x2 - W2**2 * y2
    a3x = -AL2 * ay - W2**2 * ax - al3 * y3 - w3**2 * x3
    a3y = AL2 * ax - W2**2 * ay + al3 * x3 - w3**2 * y3
    a4x, a4y = -al4 * y4 - w4**2 * x4, al4 * x4 - w4**2 * y4
    bx, by, cx, cy = B * c(t3), B * s(t3), C * c(t4), C * s(t4)
    m, b = np.zeros((len(t2), 9, 9)), np.zeros((len(t2), 9))
    for row, column, value in (
        (0, 0, 1), (0, 2, -1), (1, 1, 1), (1, 3, -1), (2, 0, y2), (2, 1, -x2), (2, 2, ay - y2), (2, 3, x2 - ax),
        (2, 8, 1), (3, 2, 1), (3, 4, -1), (4, 3, 1), (4, 5, -1), (5, 2, y3), (5, 3, -x3), (5, 4, by - y3),
        (5, 5, x3 - bx), (6, 4, 1), (6, 6, 1), (7, 5, 1), (7, 7, 1), (8, 4, y4 - cy), (8, 5, cx - x4), (8, 6, y4),
        (8, 7, -x4),
    ):  # fmt: skip
        m[:, row, column] = value
    for row, value in enumerate((
        M2 * a2x, M2 * (a2y + GRAVITY), I2 * AL2, M3 * a3x - FX, M3 * (a3y + GRAVITY) - FY, I3 * al3,
        M4 * a4x, M4 * (a4y + GRAVITY), I4 * al4 - COUPLE,
    )):  # fmt: skip
        b[:, row] = value
    return np.linalg.solve(m, b[..., None])[..., 0]


def timed(calls: dict[str, Callable[[], Any]], repeat: int) -> dict[str, float]:
    """Median seconds of each call, taken in turns after one warming call."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for call in calls.values():
        call()
    for _ in range(repeat):
        for name, call in calls.items():
            start = perf_counter()
            call()
            times[name].append(perf_counter() - start)
    return {name: median(values) for name, values in times.items()}


def compare(count: int, repeat: int) -> None:
    import dalembert as da

    m = da.mechanism(description(count))
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    gap = np.max(np.abs(da.dynamics(m).effort("O2") - student(angles)[:, 8]))
    print(f"{count} positions; torques differ by at most {gap:.1e} N m")
    from dalembert.analysis.engine.structures import STRUCTURES

    others = iter([m.with_values({"links.crank.mass": M2 + 0.01 * k}) for k in range(1, 1000)])

    def met_first() -> object:
        STRUCTURES.found.clear()
        return da.dynamics(m)

    calls = {
        "dalembert": lambda: da.dynamics(m),
        "other numbers": lambda: da.dynamics(next(others)),
        "met for the first time": met_first,
        "careful path": lambda: da.dynamics(m, method="careful"),
        "student's loop": lambda: student(angles),
        "student with batches": lambda: batched_student(angles),
    }
    found = timed(calls, repeat)
    for name, seconds in found.items():
        share = seconds / found["dalembert"]
        each = f"{seconds * 1e3:10.3f} ms  {seconds / count * 1e6:8.3f} us a position"
        print(f"  {name:22} {each}  {share:7.2f} x dalembert")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=15)
    repeat = parser.parse_args().repeat
    compare(1, repeat)
    compare(720, repeat)
    compare(100_000, max(3, repeat // 5))


if __name__ == "__main__":
    main()
