"""Runs benchmarks and keeps what each prints in benchmarks/kept, with date, machine and versions: the site shows that.

The figures of the site's page and of the paper are these. A benchmark that fails keeps the figures that it had.

    python benchmarks/keep.py [NAME ...]
"""

from __future__ import annotations

import argparse
import datetime
import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np

import dalembert as da

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "benchmarks" / "kept"
RUNS = {
    "kernel": ("benchmarks/kernel.py",),
    "kernel_friction": ("benchmarks/kernel_friction.py",),
    "kernel_rivals": ("benchmarks/kernel_rivals.py",),
    "rssr": ("benchmarks/rssr.py",),
    "stewart": ("benchmarks/stewart.py",),
    "by_hand": ("-m", "benchmarks.by_hand"),
    "four_bar": ("benchmarks/four_bar.py",),
    "simulate_designs": ("benchmarks/simulate.py", "designs"),
    "study": ("benchmarks/study.py", "--workers", "2"),
    "optimize": ("-m", "benchmarks.optimize"),
    "mistakes": ("-m", "benchmarks.mistakes"),
    "judged": ("-m", "benchmarks.judged"),
    "grading": ("-m", "benchmarks.grading"),
    "cross_check": ("benchmarks/cross_check.py", "--markdown"),
}
"""Name of the kept file -> arguments of Python."""


def machine() -> str:
    """Processor, cores and load average of this machine, as one line."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.is_file() else []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    busy = f", load average {os.getloadavg()[0]:.1f} at the start" if hasattr(os, "getloadavg") else ""
    return f"{models[0] if models else platform.processor()}, {os.cpu_count()} cores{busy}"


def keep(name: str) -> int:
    """Run one benchmark and keep its lines; its exit status."""
    head = [
        f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}, {machine()}",
        f"dalembert {da.__version__}, Python {platform.python_version()}, numpy {np.__version__}, {platform.system()}",
        f"$ python {' '.join(RUNS[name])}",
    ]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])}
    ended = subprocess.run(
        [sys.executable, *RUNS[name]],
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    if ended.returncode == 0:
        KEPT.mkdir(exist_ok=True)
        lines = [line.rstrip() for line in ended.stdout.rstrip().splitlines()]
        (KEPT / f"{name}.txt").write_text("\n".join([*head, "", *lines]) + "\n", encoding="utf-8")
    return ended.returncode


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", choices=[[], *RUNS], help="default: all")
    failed = [name for name in parser.parse_args().names or RUNS if keep(name)]
    print("failed: " + ", ".join(failed) if failed else "all kept")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
