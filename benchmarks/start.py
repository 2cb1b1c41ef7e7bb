"""From the start of the process to the answer: ``--version``, ``--help``, ``solve``.

Method. Fresh processes of this Python, one thread, in turns; one unmeasured round warms the file cache and compiles to
bytecode, as an installed package is. Medians, the slowest, and the median as a multiple of the empty process
(``python -c pass``). The floor is what nobody who imports these packages can undercut.

    python benchmarks/start.py [--repeat 9]
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

ROOT = Path(__file__).resolve().parent.parent
COMMAND = [sys.executable, "-m", "dalembert"]
FLOOR = "import cyclopts, numpy, pydantic, ruamel.yaml; type('Part', (pydantic.BaseModel,), {})"
EMPTY = "python -c pass"
RUNS = {
    EMPTY: ([sys.executable, "-c", "pass"], None),
    "import numpy": ([sys.executable, "-c", "import numpy"], None),
    "import the packages that solve needs": ([sys.executable, "-c", FLOOR], None),
    "import dalembert": ([sys.executable, "-c", "import dalembert"], 1.6),
    "dalembert --version": ([*COMMAND, "--version"], 1.6),
    "dalembert --help": ([*COMMAND, "--help"], 120 / 11),
    "dalembert solve examples/four_bar.yaml": (
        [*COMMAND, "solve", str(ROOT / "examples" / "four_bar.yaml")],
        250 / 11,
    ),
}
"""Name -> command and the limit as a multiple of the empty process."""


def seconds(command: list[str], bytecode: str) -> float:
    settings = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    settings |= {"PYTHONPYCACHEPREFIX": bytecode, "PYTHONDONTWRITEBYTECODE": ""}
    start = perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=os.environ | settings, cwd=ROOT)
    return perf_counter() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=9)
    repeat = parser.parse_args().repeat
    times: dict[str, list[float]] = {name: [] for name in RUNS}
    with TemporaryDirectory() as bytecode:
        for turn in range(repeat + 1):
            for name, (command, _) in RUNS.items():
                taken = seconds(command, bytecode)
                if turn:
                    times[name].append(taken)
    for name, values in times.items():
        limit, ratio = RUNS[name][1], median(values) / median(times[EMPTY])
        wanted = "" if limit is None else f"  limit {limit:.1f}: {'kept' if ratio < limit else 'MISSED'}"
        print(f"{name:40} median {median(values):.3f} s  slowest {max(values):.3f} s {ratio:6.1f}{wanted}")


if __name__ == "__main__":
    main()
