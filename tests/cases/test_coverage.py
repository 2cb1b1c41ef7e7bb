"""Every known problem is a model file, or a row of the list of those without one: held by a test, or not stored."""

from __future__ import annotations

import re
from pathlib import Path

CASES = Path(__file__).parents[2] / "cases"

SEED_NAMES = """
    000-A 000-B 000-C 001-A 001-B 001-C 001-D 001-E 002-1 002-2 002-3 002-4 002-5 002-6 002-7 002-7g F-2 F-4 002-9 003
"""

PUBLISHED_NAMES = """
    ST-01 ST-03 ST-04 ST-06 ST-08 ST-09 ST-11 ST-12 SU-01 SU-03 VW-01 VW-02 VW-04 VW-06 VW-07 FR-01 FR-03 FR-05 FR-06
    4B-01 4B-02 DK-01 DK-02 4B-06 ML-01 4B-08 DK-04 DK-05 SC-01 SC-02 SC-03 SC-04 SC-06 SC-07 SC-08 SC-11 SC-12 SC-13
    SC-14 SC-15 SC-16 SC-18 SC-21 SC-23 SC-24 SC-25 SC-28 QR-03 QR-04 QR-06 SP-01 SP-04 SP-05 SP-06 SP-07 SP-08 SP-11
    SP-12 FW-01 FW-02 FW-04 FW-06 FW-08 FW-09 BA-01 BA-03 BA-04 BA-06 BA-07 BA-08 ML-04 BAL-1 BAL-3
    BRK-1 BRK-4 BRK-5 BRK-7 BLT-1 BLT-2 CAM-4 CLU-4 FRI-1 GTR-1 GTR-3
    GOV-11 GOV-12 GOV-14
"""

SEEDS, PUBLISHED = SEED_NAMES.split(), PUBLISHED_NAMES.split()


def written() -> dict[str, list[str]]:
    """Problem -> its model files. A letter after the number of a file is a part of the problem."""
    slugs = {name: f"seed-{name.lower()}" for name in SEEDS} | {name: name.lower() for name in PUBLISHED}
    names = sorted(path.stem for path in CASES.glob("*.yaml"))
    return {
        name: [found for found in names if re.match(rf"{re.escape(slug)}[a-d]?(-|$)", found)]
        for name, slug in slugs.items()
    }


def without_file() -> list[tuple[str, str, str]]:
    """Rows of the problems without a file: problem, what is asked or missing, the test."""
    text = (CASES / "WAITING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([^|]+) \| ([^|]+) \| ([^|]*) ?\|$", text, re.MULTILINE)
    return [row for row in rows if row[0] != "id" and not row[0].startswith("-")]


def test_every_problem_is_a_file_or_a_row() -> None:
    files, rows = written(), {row[0] for row in without_file()}
    assert [name for name in files if not files[name] and name not in rows] == []


def test_no_problem_is_both() -> None:
    files = written()
    assert [row[0] for row in without_file() if files.get(row[0])] == []


def test_the_rows_name_known_problems_once() -> None:
    names = [row[0] for row in without_file()]
    assert sorted(set(names)) == sorted(names)
    assert set(names) <= set(SEEDS + PUBLISHED)


def test_every_file_belongs_to_one_problem() -> None:
    owned = [name for found in written().values() for name in found]
    assert sorted(owned) == sorted(path.stem for path in CASES.glob("*.yaml"))


def test_the_tests_that_hold_problems_exist_and_none_waits() -> None:
    text = (CASES / "WAITING.md").read_text(encoding="utf-8")
    files = set(re.findall(r"`(tests/[\w/]+\.py)`", text))
    assert files
    assert [f for f in sorted(files) if not (CASES.parent / f).is_file()] == []
    assert "|" not in text.partition("## Waiting")[2].partition("##")[0]
