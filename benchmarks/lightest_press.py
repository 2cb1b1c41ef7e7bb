"""The lightest press of the guide: stress and buckling compiled beside the same designs analysed one by one.

Method. A condition that is a Python function, and always holds, makes the second problem one that is analysed one by
one. Both give values and derivatives of the same random designs in turn, and then the optimum of the file from the same
starts. Processor time of one core; medians, and the ratios of this run. Values differ by the largest difference over
the largest size, derivatives too: those one by one are differences.

    python -m benchmarks.lightest_press [--designs 8] [--starts 4]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

import dalembert as da
from dalembert.optimization.design_problem import DesignProblem
from dalembert.optimization.optimizing import problem_of

PRESS = Path(__file__).parents[1] / "docs" / "lightest-press.yaml"
VARY = {"crank": "range", "rod": "range", "diameter": "range", "web": ("20 mm", "80 mm")}
RULES = ["peak stress.rod <= 90 MPa", "peak stress.crank <= 160 MPa", "buckling.rod <= 1/5"]
RULES += ["range(slide.G) >= 100 mm", "transmission.B >= 75 deg"]


def holds(r: da.Result) -> float:
    """A condition that always holds."""
    return 1.0


def timed(of: Callable[[], Any]) -> tuple[float, Any]:
    """Processor time of a call, s, and what it gives."""
    start = time.process_time()
    made = of()
    return time.process_time() - start, made


def designs(fast: DesignProblem, slow: DesignProblem, count: int) -> None:
    """Print both times of a design, and how far values and derivatives differ."""
    places = np.random.default_rng(0).random((count + 1, len(fast.low)))
    fast.at(places[-1])  # compiles
    slow.at(places[-1])
    each = [(timed(lambda u=u: fast.at(u)), timed(lambda u=u: slow.at(u))) for u in places[:-1]]
    quick, careful = (median(pair[k][0] for pair in each) for k in (0, 1))
    print(
        f"a design: compiled {1e3 * quick:.2f} ms, one by one {1e3 * careful:.1f} ms, {careful / quick:.0f} times"
    )
    for name in ("margin", "margin_slope"):
        a, b = (np.array([getattr(pair[k][1], name) for pair in each]) for k in (0, 1))
        b = b[:, : a.shape[1]]
        axes = tuple(k for k in range(a.ndim) if k != 1)
        off = np.nanmax(np.abs(a - b), axis=axes) / np.nanmax(np.abs(b), axis=axes)
        print(f"  largest difference of {name.replace('_', ' ')}: {off.max():.1e}")


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--designs", type=int, default=8)
    parser.add_argument("--starts", type=int, default=4)
    arguments = parser.parse_args()
    m = da.load(PRESS)
    fast, slow = (problem_of(m, VARY, "mass", rules, None, False)[0] for rules in (RULES, [*RULES, holds]))
    designs(fast, slow, arguments.designs)
    for what, rules in (("compiled", RULES), ("one by one", [*RULES, holds])):
        seconds, best = timed(
            lambda rules=rules: da.optimize(m, VARY, "mass", rules, starts=arguments.starts)
        )
        numbers = ", ".join(f"{1e3 * x:.4f} mm" for x in best.values)
        print(f"{what}, {arguments.starts} starts: {seconds:.1f} s, {best.value:.5f} kg, {numbers}")


if __name__ == "__main__":
    main()
