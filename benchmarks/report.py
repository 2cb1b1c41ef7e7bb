"""The worked solution of the four-bar example as PDF and HTML: processor time, with solving.

Method. The description is loaded once; solving it and writing both is timed, after one warming call, on one thread.

Measured (2 cores of a virtual x86-64 machine): median 0.16 s; the first, which loads fonts and imports, 0.39 s.

    python benchmarks/report.py [--repeat 9]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from statistics import median  # noqa: E402
from time import process_time  # noqa: E402

import dalembert as da  # noqa: E402
from dalembert.bundled import examples  # noqa: E402

LIMIT = 1.0
"""Seconds, warm."""


def seconds(mechanism: da.Mechanism) -> float:
    start = process_time()
    report = da.report(da.solve(mechanism))
    for form in ("pdf", "html"):
        report.to_bytes(form)
    return process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=9)
    repeat = parser.parse_args().repeat
    mechanism = da.load(examples()["four_bar"])
    first, *rest = [seconds(mechanism) for _ in range(repeat + 1)]
    verdict = "kept" if median(rest) < LIMIT else "MISSED"
    print(
        f"first {first:.3f} s, median {median(rest):.3f} s, slowest {max(rest):.3f} s; limit {LIMIT} s: {verdict}"
    )


if __name__ == "__main__":
    main()
