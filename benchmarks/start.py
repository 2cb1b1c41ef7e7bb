"""From the start of the process to the answer: import, ``--help``, ``solve``.

Method. Fresh processes of this Python, one thread, in turns; one unmeasured round warms the file cache. Medians and
the slowest are printed beside the empty process (``python -c pass``) and ``import numpy``, which nobody can undercut.

    python benchmarks/start.py [--repeat 9]
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path
from statistics import median
from time import perf_counter

ROOT = Path(__file__).resolve().parent.parent
COMMAND = [sys.executable, "-m", "dalembert"]
RUNS = {
    "python -c pass": ([sys.executable, "-c", "pass"], None),
    "import numpy": ([sys.executable, "-c", "import numpy"], None),
    "import dalembert": ([sys.executable, "-c", "import dalembert"], 0.3),
    "dalembert --help": ([*COMMAND, "--help"], 0.5),
    "dalembert solve examples/four_bar.yaml": (
        [*COMMAND, "solve", str(ROOT / "examples" / "four_bar.yaml")],
        0.8,
    ),
}
"""Name -> command and the limit in seconds."""


def seconds(command: list[str]) -> float:
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    start = perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=os.environ | threads, cwd=ROOT)
    return perf_counter() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=9)
    repeat = parser.parse_args().repeat
    times: dict[str, list[float]] = {name: [] for name in RUNS}
    for turn in range(repeat + 1):
        for name, (command, _) in RUNS.items():
            taken = seconds(command)
            if turn:
                times[name].append(taken)
    for name, values in times.items():
        limit = RUNS[name][1]
        wanted = (
            "" if limit is None else f"  limit {limit} s: {'kept' if median(values) < limit else 'MISSED'}"
        )
        print(f"{name:40} median {median(values):.3f} s  slowest {max(values):.3f} s{wanted}")


if __name__ == "__main__":
    main()
