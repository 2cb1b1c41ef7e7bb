"""Every published problem of `cases/`: each answer, each position, each free body."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from dalembert.analysis.solution import solve
from dalembert.grading.file_answers import ComparedAnswer, check_file
from dalembert.model import load

FILES = sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))

every_case = pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)


def line(row: ComparedAnswer) -> str:
    """One answer that is missed, as a person reads it."""
    exact = f", exact {row.exact}" if row.exact else ""
    published = f"published {row.published} within {row.tolerance}{exact}"
    return f"{row.quantity}: computed {row.computed}, {published} {row.problem}"


@every_case
def test_answers(path: Path) -> None:
    rows = check_file(path)
    assert rows, "a case without answers"
    missed = [line(row) for row in rows if not row.ok]
    assert not missed, "\n".join([f"{path.name}: {len(missed)} of {len(rows)} answers are missed", *missed])


@pytest.mark.long
def test_every_answer_has_its_reason_and_every_case_its_source() -> None:
    every = {path.name: load(path) for path in FILES}
    assert [name for name, m in every.items() if not (m.title and m.source_text)] == []
    assert [(name, a.quantity) for name, m in every.items() for a in m.answers if not a.why] == []


@every_case
def test_bodies_balance_and_power_agrees(path: Path) -> None:
    result = solve(load(path))
    claimed = {answer.value for answer in result.mechanism.answers if answer.quantity == "status"}
    assert set(result.status) <= {"ok", *claimed}, result.problems()
    whole = [result] if np.isfinite(result.residual).any() else [end for ends in result.ends for end in ends]
    for solved in whole:
        assert np.max(solved.residual, initial=0.0, where=np.isfinite(solved.residual)) < 1e-9
        assert np.max(solved.power_balance, initial=0.0, where=np.isfinite(solved.power_balance)) < 1e-9
