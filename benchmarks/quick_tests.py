"""Which of the default tests become long ones: those that run nothing which some quicker ones do not run as well.

Method. `mutants.py --measure-only` measures which statements each test runs; a run of the tests says how long each
takes beside the others. From the slowest on, a test is left to `make test-long` where every statement that it runs is
still run by more than --others of those that stay. Of each test one instance stays, unless it alone takes --alone
seconds; one that runs no statement here (it reads the sources, or starts a program) stays. The names go to
tests/left_to_long.txt, which tests/conftest.py reads; --every-quick runs them all the same.

    make test PYTEST_ARGS="--every-quick --durations=0 --durations-min=0.1" > build/durations.txt
    python benchmarks/mutants.py --measure-only && python benchmarks/quick_tests.py build/durations.txt
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from pathlib import Path

from mutants import ROOT, Tests, test_of

TO = ROOT / "tests" / "left_to_long.txt"
DURATION = re.compile(r"^\s*([\d.]+)s (?:call|setup|teardown)\s+(\S.*?)\s*$", re.MULTILINE)


def left(tests: Tests, seconds: Counter[str], others: int, least: float, alone: float) -> list[str]:
    """Names of those that are left to the long run."""
    place, count = {name: k for k, name in enumerate(tests.nodes)}, tests.ran.sum(axis=0)
    stay, out = Counter(map(test_of, tests.nodes)), []
    for name, size in seconds.most_common():
        if size < least or name not in place or not name.startswith("tests/"):
            continue
        ran, last = tests.ran[place[name]], stay[test_of(name)] == 1
        if (size >= alone or not last) and ran.any() and (count[ran] > others).all():
            count = count - ran
            stay[test_of(name)] -= 1
            out.append(name)
    return sorted(out)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("durations", type=Path)
    parser.add_argument("--others", type=int, default=2)
    parser.add_argument("--least", type=float, default=0.15, help="seconds of the tests that are looked at")
    parser.add_argument("--alone", type=float, default=0.3)
    asked = parser.parse_args()
    seconds = Counter[str]()
    for size, name in DURATION.findall(asked.durations.read_text(encoding="utf-8")):
        seconds[name] += float(size)
    names = left(Tests(), seconds, asked.others, asked.least, asked.alone)
    TO.write_text("".join(f"{name}\n" for name in names), encoding="utf-8")
    whole, less = sum(seconds.values()), sum(seconds[name] for name in names)
    print(f"{len(names)} tests, {less:.0f} s of {whole:.0f} s in the durations")


if __name__ == "__main__":
    main()
