"""How well and how fast a class is marked.

Method. 30 variants of each of three bundled problems; 200 sheets a class, drawn by chance, half CSV and half YAML, 60 %
of them with one known mistake that some figure shows: a wrong problem solved, or a slip in one figure, to 4 digits. A
mistake counts as named if one of the figures that are charged says so, or if all of them say one and the same other
mistake, which then gives the same figures. Times are those of `da.grade` and of writing, once. Run it from the
checkout.

    python -m benchmarks.grading [--sheets 200]
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from tests.grading.made_class import named_rate, write_class, write_variants

import dalembert as da
from dalembert.bundled import cases, examples

PROBLEMS = {
    "four_bar": ("loads.T_4.value", np.linspace(8, 16, 30)),
    "seed-002-3-four-link-three-forces": ("drives.A.position", np.linspace(0.8, 1.2, 30)),
    "seed-002-7a-engine-friction-circles": ("drives.O.position", np.linspace(0.6, 1.0, 30)),
}


def main(sheets: int) -> None:
    for name, (path, values) in PROBLEMS.items():
        m = da.load((cases() | examples())[name])
        with TemporaryDirectory() as folder:
            root = Path(folder)
            key = write_variants(root / "exam", m, path, values.tolist())
            students = write_class(root / "answers", key, sheets, 1)
            started = time.perf_counter()
            marks = da.grade(root / "answers", key)
            graded = time.perf_counter()
            marks.to_xlsx(root / "marks.xlsx")
            marks.save_feedback(root / "feedback")
            written = time.perf_counter() - graded
        wrong = sum(bool(s.mistake) for s in students)
        right = [s for s in marks.students if not next(t for t in students if t.name == s.student).mistake]
        full = sum(s.total == s.most for s in right)
        print(
            f"{name}: {sheets} sheets of {len(values)} variants in {graded - started:.1f} s, written in {written:.1f} s"
        )
        print(f"  {100 * named_rate(marks, students):.1f} % of {wrong} mistakes named")
        print(f"  {full} of {len(right)} true sheets have all marks")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--sheets", type=int, default=200)
    main(parser.parse_args().sheets)
