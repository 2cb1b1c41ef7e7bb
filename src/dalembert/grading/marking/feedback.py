"""Feedback: a text for each student, in plain sentences."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from dalembert.grading.marking.student_marks import Mark, StudentMarks
from dalembert.saving import check_new_folder, new_file, new_folder


def write_feedback(students: Sequence[StudentMarks], folder: str | Path, overwrite: bool = False) -> None:
    """A Markdown file for each student; a new folder appears complete or not at all."""
    folder = Path(folder)
    check_new_folder(folder, overwrite)
    texts = dict(zip(file_names([s.student for s in students]), map(feedback, students), strict=True))
    if folder.exists():
        for name, text in texts.items():
            with new_file(folder / name, overwrite=True) as temporary:
                temporary.write_text(text, encoding="utf-8")
        return
    with new_folder(folder) as beside:
        for name, text in texts.items():
            (beside / name).write_text(text, encoding="utf-8")


def file_names(students: list[str]) -> list[str]:
    """A file name for each student: letters, digits and hyphens, none twice.

    >>> file_names(["Ann Lee", "../ann lee", "=1+1"])
    ['Ann-Lee.md', 'ann-lee-2.md', '1-1.md']
    """
    out: list[str] = []
    seen: set[str] = set()
    for student in students:
        stem = re.sub(r"[^\w]+", "-", student).strip("-_")[:60] or "student"
        name, number = stem, 1
        while name.lower() in seen:
            number += 1
            name = f"{stem}-{number}"
        seen.add(name.lower())
        out.append(f"{name}.md")
    return out


def feedback(s: StudentMarks) -> str:
    """Feedback for a student: every figure with its marks and reason, and the parts of the sheet that were not
    counted."""
    lines = [f"# {_plain(s.student)}", ""]
    lines += [f"Variant {_plain(s.variant)}.", ""] if s.variant else []
    lines += [f"{s.total:.4g} of {s.most:.4g} marks{waits_text(s)}.", ""]
    lines += [f"- {_sentence(m)}" for m in s.marks]
    text = {m.sentence for m in s.marks}
    others = [f"- {_plain(problem)}" for problem in s.problems if problem not in text]
    lines += ["", "Not counted:", "", *others] if others else []
    return "\n".join(lines).replace(_plain(s.file), _plain(Path(s.file).name)).rstrip() + "\n"


def waits_text(s: StudentMarks) -> str:
    """The figures that a teacher must still read, after the marks."""
    return f", {s.waiting} {'waits' if s.waiting == 1 else 'wait'}" if s.waiting else ""


def _sentence(m: Mark) -> str:
    if m.outcome == "waits":
        return f"{_plain(m.quantity[:1].upper() + m.quantity[1:])} (waits): {_plain(m.sentence)}."
    counted = "not counted" if m.outcome == "open" else f"{m.marks:.4g} of {m.most:.4g}"
    head = f"{_plain(m.quantity[:1].upper() + m.quantity[1:])} ({counted}): "
    if m.outcome == "missing":
        return head + "no answer is given."
    answered = f"you have {_plain(m.given)}; " if m.given else ""
    if m.outcome == "right":
        return head + answered + ("right" + (f", but {m.sentence}" if m.sentence else "")) + "."
    tail = f" Computed: {m.computed}." if m.computed and m.outcome != "follow_through" else ""
    again = ", as before" if m.outcome == "repeated" else ""
    return f"{head}{answered}{_plain(m.sentence)}{again}.{tail}"


def _plain(text: str) -> str:
    """Text in which Markdown and HTML find nothing to do."""
    one_line = re.sub(r"\s+", " ", text)
    return re.sub(r"([\\`*_<>\[\]#|!])", r"\\\1", one_line)
