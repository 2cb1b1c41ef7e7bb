"""How often `check-answers` names the mistake that was made, and how long a sheet takes.

Method. For each bundled case and each mistake that is known for it, the wrong problem is solved and its efforts,
unknown loads and joint forces are written down as a student would, to 4 figures; besides, the true sheet with each
figure slipped in turn (sense, axis, unit). A sheet counts if some figure of it is called wrong. It is right if the
first wrong figure's sentence is the mistake, or if one other mistake gives all the wrong figures. The same for sheets
of the first figure alone. The stricter rates count the very sentence only. True figures are
rounded to 3. Run it from the checkout.

    python -m benchmarks.mistakes [CASE ...]
"""

from __future__ import annotations

import sys
import time
from statistics import median

from tests.grading.marked_sheets import Made, mistaken_sheets, named_first, slipped_sheets, true_sheet

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.grading.mistakes import SolvedProblem

TRUE = "true figures called right"


class Rate:
    """Good ones of all."""

    def __init__(self) -> None:
        self.good = self.all = 0

    def add(self, good: bool | None) -> None:
        if good is not None:
            self.good, self.all = self.good + good, self.all + 1

    def __str__(self) -> str:
        return f"{self.good} of {self.all}, {100 * self.good / max(self.all, 1):.2f} %"


def main(names: list[str]) -> None:
    kinds = ("whole sheets", "slips", "first figure alone")
    rates = {name: Rate() for name in (*kinds, *(f"{k}, by this very sentence" for k in kinds), TRUE)}
    first, again = [], []
    for name in names:
        problem = SolvedProblem(da.load((cases() | examples())[name]))
        place = min(1, len(problem.result.status) - 1)
        sheet = true_sheet(problem, place, 3)
        for verdict in problem.verdicts(sheet):
            rates[TRUE].add(verdict.right)
        made = [*mistaken_sheets(problem, place, 4)]
        slips = [*slipped_sheets(problem, place, 4)]
        alone = [Made(one.mistake, one.answers[:1]) for one in made]
        for kind, some in zip(kinds, (made, slips, alone), strict=True):
            for one in some:
                started = time.perf_counter()
                verdicts = problem.verdicts(one.answers)
                (again if first and first[-1][0] == name else first).append(
                    (name, time.perf_counter() - started)
                )
                found = named_first(one, verdicts)
                rates[kind].add(found)
                said = next((v.mistake for v in verdicts if not v.right), "")
                rates[f"{kind}, by this very sentence"].add(None if found is None else said == one.mistake)
                if found is False:
                    print(f"{name}: {one.mistake}", file=sys.stderr)
    for name, rate in rates.items():
        print(f"{name}: {rate}")
    for words, times in (("a first sheet of a problem", first), ("a further one", again)):
        seconds = [t for _, t in times]
        print(f"{words}: median {1e3 * median(seconds):.0f} ms, slowest {1e3 * max(seconds):.0f} ms")


if __name__ == "__main__":
    main(sys.argv[1:] or sorted(cases() | examples()))
