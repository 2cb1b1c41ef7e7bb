"""Studies: design-positions stored and resumable, beside the kernel's own time and that of the drawing alone.

Method. The four-bar of 72 positions with ten numbers varied (normal, cut), the peak of its torque. Each row is the
best of three runs into a new store, with the time that its threads had a core; kernel and points are what one core
needs for as many designs, measured in the same run on one block, by the core's time too. Resident memory is the
largest so far. ``--kills`` kills a run of the last size at random moments (SIGKILL), resumes it each time, and compares
it with one that was not killed.

    python benchmarks/study.py [--largest 8] [--scheduler tcp://host:8786] [--kills 10]
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import signal
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da

VARY = {
    "links.coupler.mass": "± 5 %",
    "links.coupler.center.0": "± 1 mm",
    "links.coupler.points.B.0": "± 0.1 mm",
    "links.coupler.inertia": "± 5 %",
    "links.ground.points.O4.0": "± 0.1 mm",
    "links.crank.points.A.0": "± 0.1 mm",
    "links.rocker.mass": "± 5 %",
    "links.rocker.center.0": "± 1 mm",
    "links.rocker.inertia": "± 5 %",
    "links.rocker.points.B.0": "± 0.1 mm",
}
POSITIONS = 72


def study(designs: int) -> da.Study:
    return da.study(da.four_bar(), VARY, ["effort.O2"], designs=designs, seed=7)


def seconds(act: Any, times: int = 3) -> tuple[float, float]:
    """Seconds, and seconds of all cores together, each the best of some runs: others may use the cores meanwhile."""
    found = []
    for _ in range(times):
        begun, core = time.perf_counter(), time.process_time()
        act()
        found.append((time.perf_counter() - begun, time.process_time() - core))
    whole, cores = zip(*found, strict=True)
    return min(whole), min(cores)


def row(power: int, folder: Path, scheduler: str | None) -> None:
    s = study(max(1, 10**power // POSITIONS))
    _ = s.prints  # compiled before the clock starts
    store = folder / "s.zarr"

    def run() -> None:
        shutil.rmtree(store, ignore_errors=True)
        s.run(store, scheduler=scheduler)

    whole, cores = seconds(run)
    block = min(s.count, s.block_size())
    values = s.plan.values(0, block)
    points = seconds(lambda: s.plan.values(0, block))[1] * s.count / block
    kernel = seconds(lambda: s.engine.block(values))[1] * s.count / block
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    size = sum(p.stat().st_size for p in store.rglob("*") if p.is_file()) / 1e6
    times = " | ".join(f"{t:.2f}" for t in (whole, cores, kernel, points))
    print(f"| 1e{power} | {s.count:,} | {block:,} | {times} | {memory:.0f} | {size:.1f} |")


def killed(power: int, folder: Path, kills: int) -> None:
    """One store, killed again and again, and the same bits at the end."""
    s = study(10**power // POSITIONS)
    _ = s.prints
    chance, done = random.Random(1), 0
    for _ in range(kills):
        child = os.fork()
        if not child:
            s.run(folder / "k.zarr")
            os._exit(0)
        time.sleep(chance.uniform(0.1, 1.0))
        os.kill(child, signal.SIGKILL)
        done += os.waitpid(child, 0)[1] == signal.SIGKILL
    found = s.run(folder / "k.zarr")["effort.O2"]
    same = np.array_equal(found, s.run(folder / "w.zarr")["effort.O2"])
    print(f"killed {done} times on the way, resumed: {'the same bits' if same else 'OTHER BITS'}")


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--largest", type=int, default=8)
    arguments.add_argument("--scheduler")
    arguments.add_argument("--kills", type=int, default=0)
    given = arguments.parse_args()
    folder = Path(tempfile.mkdtemp())
    print(f"{len(os.sched_getaffinity(0))} cores, dalembert {da.__version__}")
    heads = ("design-positions", "designs", "block", "study, s", "core s", "kernel, core s", "points, core s")
    print("|", " | ".join((*heads, "RSS, MB", "store, MB")), "|")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    try:
        if given.kills:
            killed(given.largest, folder, given.kills)
        for power in range(6, given.largest + 1):
            row(power, folder, given.scheduler)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
