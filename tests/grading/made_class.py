"""A class that is made up: sheets of exam variants, most with one known mistake."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import dalembert as da
from dalembert.grading.mistakes import SolvedProblem
from tests.grading.marked_sheets import Made, mistaken_sheets, named_first, slipped_sheets, true_sheet


class Student(NamedTuple):
    """A student of a made class: name, variant, and the mistake; empty where there is none."""

    name: str
    variant: str
    mistake: str


def write_variants(folder: Path, mechanism: Any, path: str, values: list[Any]) -> Path:
    """Model files of variants and a key as `dalembert variants` writes it."""
    folder.mkdir(parents=True)
    with (folder / "key.csv").open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(["variant", "file", "quantity", "of", "on", "value", "unit"])
        for k, value in enumerate(values, 1):
            m = mechanism.with_values({path: value})
            m.save(folder / f"{k:02}.yaml")
            for answer in true_sheet(SolvedProblem(m), 0, 12):
                on = m.joints[answer.of].links[1] if answer.quantity == "reaction" else ""
                table.writerow([f"{k:02}", f"{k:02}.yaml", answer.quantity, answer.of, on, answer.value, ""])
    return folder / "key.csv"


def write_class(folder: Path, key: Path, count: int, seed: int, share: float = 0.6) -> list[Student]:
    """Sheets of a class as YAML and CSV, ``share`` of them with a mistake that some figure of theirs shows."""
    rng = np.random.default_rng(seed)
    folder.mkdir(parents=True)
    names = sorted(p.stem for p in key.parent.glob("*.yaml"))
    made: dict[str, tuple[list[da.Answer], list[Made]]] = {}
    students = []
    for k in range(count):
        variant = names[int(rng.integers(len(names)))]
        if variant not in made:
            problem = SolvedProblem(da.load(key.parent / f"{variant}.yaml"))
            some = [*mistaken_sheets(problem, 0, 4), *slipped_sheets(problem, 0, 4)]
            shown = [one for one in some if named_first(one, problem.verdicts(one.answers)) is not None]
            made[variant] = true_sheet(problem, 0, 4), shown
        true, mistaken = made[variant]
        wrong = mistaken[int(rng.integers(len(mistaken)))] if k < share * count else Made("", true)
        student = Student(f"Student {k:03}", variant, wrong.mistake)
        write_sheet(folder / f"s{k:03}", student, wrong.answers, k % 2 == 0)
        students.append(student)
    return students


def write_sheet(path: Path, student: Student, answers: list[da.Answer], as_csv: bool) -> None:
    if as_csv:
        with path.with_suffix(".csv").open("w", encoding="utf-8", newline="") as file:
            table = csv.writer(file)
            table.writerow(["student", "variant", "quantity", "of", "value"])
            table.writerows([student.name, student.variant, a.quantity, a.of, a.value] for a in answers)
        return
    lines = [f"student: {student.name}", f'variant: "{student.variant}"', "answers:"]
    lines += [f'- {{quantity: {a.quantity}, of: {a.of}, value: "{a.value}"}}' for a in answers]
    path.with_suffix(".yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")


def named_rate(marks: Any, students: list[Student]) -> float:
    """Share of the mistakes that are named, or another that explains all figures that are charged."""
    by = {s.student: s for s in marks.students}
    good = []
    for student in (s for s in students if s.mistake):
        charged = [
            m.sentence
            for m in by[student.name].marks
            if m.outcome not in ("right", "follow_through", "repeated")
        ]
        kinds = {m.outcome for m in by[student.name].marks}
        alone = len(set(charged)) == 1 and not kinds & {"unknown", "rounding", "unreadable", "missing"}
        good.append(student.mistake in charged or alone)
    return float(np.mean(good))
