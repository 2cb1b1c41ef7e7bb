"""Studies: design-positions stored and resumable, beside the kernel's own time and that of the drawing alone.

Method. The four-bar of 72 positions with ten numbers varied (normal, cut), the peak of its torque. Each row is the
best of three runs into a new store, with the time that its threads had a core; kernel and points are what one core
needs for as many designs, measured in the same run on one block, by the core's time too. ``--workers`` runs each row on
as many dask workers of one thread beside it, with the same bits. Resident memory is the largest so far, of this process
and of a worker. ``--kills`` kills a run of the last size at random moments (SIGKILL), resumes it each time, kills a
worker on the way where there are some, and compares with a run that was not killed.

    python benchmarks/study.py [--largest 9] [--workers 2] [--scheduler tcp://host:8786]
    python benchmarks/study.py --only 10 --kills 10
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import signal
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da
from dalembert.kernel.parallel_runs import cores

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


def row(power: int, folder: Path, client: Any) -> None:
    s = study(max(1, 10**power // POSITIONS))
    _ = s.prints  # compiled before the clock starts
    store, checks = folder / "s.zarr", []

    def run(scheduler: Any = None) -> None:
        shutil.rmtree(store, ignore_errors=True)
        checks.append(s.run(store, scheduler=scheduler).ledger[:, 0])

    whole, cores = seconds(run)
    dask = seconds(lambda: run(client))[0] if client else np.nan
    if not all(np.array_equal(one, checks[0]) for one in checks):
        raise SystemExit("the runs differ in their bits")
    block = min(s.count, s.block_size())
    values = s.plan.values(0, block)
    points = seconds(lambda: s.plan.values(0, block))[1] * s.count / block
    kernel = seconds(lambda: s.engine.block(values))[1] * s.count / block
    memory = " and ".join(f"{size:.0f}" for size in (resident(), *sorted(on_workers(client).values())[-1:]))
    size = sum(p.stat().st_size for p in store.rglob("*") if p.is_file()) / 1e6
    times = " | ".join(f"{t:.2f}" for t in (whole, cores, kernel, points, dask))
    print(f"| 1e{power} | {s.count:,} | {block:,} | {times} | {memory} | {size:.1f} |", flush=True)


def resident() -> float:
    """Largest resident memory of this process, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def on_workers(client: Any) -> dict[str, float]:
    """The same of each worker."""
    return dict(client.run(resident)) if client else {}


def killed(power: int, folder: Path, kills: int, client: Any) -> None:
    """One store, killed again and again, and the same bits at the end."""
    s = study(10**power // POSITIONS)
    size = s.block_size()
    expected = s.block(0, size)[1] / 1e3 * s.count / size / cores()
    chance, done = random.Random(1), 0
    for _ in range(kills):
        child = os.fork()
        if not child:
            s.run(folder / "k.zarr")
            os._exit(0)
        time.sleep(chance.uniform(0.0, 1.2) * expected / kills)
        os.kill(child, signal.SIGKILL)
        done += os.waitpid(child, 0)[1] == signal.SIGKILL
    checks = [s.run(folder / name).ledger[:, 0] for name in ("k.zarr", "w.zarr")]
    print(f"killed {done} times, resumed: {said(checks)}, {resident():.0f} MB", flush=True)
    if client:
        workers = client.run(os.getpid)
        threading.Timer(expected / 2, os.kill, (min(workers.values()), signal.SIGKILL)).start()
        checks[0] = s.run(folder / "d.zarr", scheduler=client).ledger[:, 0]
        print(f"a worker of {len(workers)} killed on the way: {said(checks)}")


def said(checks: list[Any]) -> str:
    return "the same bits" if np.array_equal(*checks) else "OTHER BITS"


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--largest", type=int, default=8, help="power of ten of design-positions")
    arguments.add_argument("--only", type=int, help="this one alone")
    arguments.add_argument("--scheduler", help="address of a dask scheduler")
    arguments.add_argument("--workers", type=int, default=0, help="dask workers started here")
    arguments.add_argument("--kills", type=int, default=0)
    given = arguments.parse_args()
    folder, client = Path(tempfile.mkdtemp()), None
    if given.workers or given.scheduler:
        from distributed import Client

        own = {"n_workers": given.workers, "threads_per_worker": 1, "dashboard_address": None}
        client = Client(given.scheduler) if given.scheduler else Client(**own)
    print(f"{cores()} cores, dalembert {da.__version__}")
    last = given.only or given.largest
    try:
        if given.kills:
            killed(last, folder, given.kills, client)
            shutil.rmtree(folder)
            folder.mkdir()
        if given.kills and given.only:
            return
        heads = ("design-positions", "designs", "block", "threads, s", "their core s", "kernel, core s")
        print("|", " | ".join((*heads, "points, core s", "dask, s", "RSS, MB", "store, MB")), "|")
        print("|", " | ".join(["---"] * 10), "|")
        for power in range(given.only or 6, last + 1):
            row(power, folder, client)
    finally:
        shutil.rmtree(folder)
        if client:
            client.close()


if __name__ == "__main__":
    main()
