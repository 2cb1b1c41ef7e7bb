"""Variants on disk: a folder that appears complete or not at all, and that replaces only one made likewise."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.exams.asked import COLUMNS, figure
from dalembert.exams.question_sheet import NO_TEXT, ExamText, key_sheet, question_sheet, solution_sheet
from dalembert.progress import progress
from dalembert.reports.writers.typst_writer import typst_bytes
from dalembert.saving import check_installed, check_new_folder, new_folder

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dalembert.arrays import Tree
    from dalembert.exams.candidates import Variant
    from dalembert.model import Mechanism, StatedAnswer
    from dalembert.reports.sheet import ReportSheet

RECORD = "variants.json"
"""The seed, the required quantities and the values of each variant: identifies such a folder."""

PARTS = {
    "problems": (".yaml",),
    "questions": (".pdf", ".html"),
    "answers": (".csv",),
    "solutions": (".pdf", ".html"),
}
"""Folders of a variant's files, and their endings."""

ALONE = ("questions.pdf", "key.pdf", "key.csv", "key.json", RECORD)
SHEET = ("variant", "quantity", "of", "on", "at", "extreme", "component", "axes", "value", "unit")
"""Columns of the table that a student may fill in."""


def check_folder(folder: Path, overwrite: bool) -> None:
    """Raise where a folder cannot be written, before the work: one that exists is kept, unless it is empty."""
    check_installed("typst", "writing question sheets", "report")
    if not check_new_folder(folder, overwrite):
        return
    strange = _strange(folder)
    if strange:
        raise ModelError(f"{folder} has {strange}, which would be lost", "move it, or name another folder")


def _strange(folder: Path) -> str:
    """A file that is none of those that variants write."""
    if not (folder / RECORD).is_file():
        return min(p.name for p in folder.iterdir())
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        endings = PARTS.get(inside.parts[0], ())
        made = len(inside.parts) == 2 and path.suffix in endings and path.stem.isdigit()
        made |= inside.parts[0] == "problems" and (path.suffix.lower() == ".stl" or path.is_dir())
        if not (made or inside.as_posix() in ALONE or (path.is_dir() and inside.as_posix() in PARTS)):
            return inside.as_posix()
    return ""


def write_folder(
    problems: Sequence[Variant],
    questions: Sequence[StatedAnswer],
    key: list[Tree],
    record: Tree,
    folder: Path,
    overwrite: bool,
    exam: ExamText = NO_TEXT,
) -> None:
    """Writes all sheets beside the folder and moves them into place when all are complete."""
    check_folder(folder, overwrite)
    with new_folder(folder) as beside, progress("Sheets", len(problems)) as step:
        sheets: list[ReportSheet] = []
        for part in PARTS:
            (beside / part).mkdir()
        for k, one in enumerate(problems):
            step(k, one.name)
            sheets.append(_write_variant(one, questions, beside, exam))
        _write_key(key, record, beside)
        (beside / "questions.pdf").write_bytes(typst_bytes(sheets[0], "pdf", *sheets[1:]))
        values = {one.name: [figure(one.result, a) for a in questions] for one in problems}
        key_sheet(problems[0].result, values, questions, exam).save(beside / "key.pdf")


def _write_variant(
    v: Variant, questions: Sequence[StatedAnswer], folder: Path, exam: ExamText
) -> ReportSheet:
    """Writes a variant's files; returns its question sheet."""
    v.mechanism.save(folder / "problems" / f"{v.name}.yaml")
    _copy_meshes(v.mechanism, folder / "problems")
    question = question_sheet(v.result, questions, v.name, exam=exam)
    for part, made in (("questions", question), ("solutions", solution_sheet(v.result, questions, v.name))):
        for ending in PARTS[part]:
            made.save(folder / part / f"{v.name}{ending}")
    rows = [{**row, "variant": v.name, "value": ""} for row in v.key]
    _write_csv(folder / "answers" / f"{v.name}.csv", SHEET, rows)
    return question.sheet


def _copy_meshes(m: Mechanism, folder: Path) -> None:
    """The STL files that shapes name, beside the problem as they were beside its file."""
    for mesh in (getattr(s, "file", None) for link in m.links.values() for s in link.shapes):
        if mesh is None or Path(mesh.written).is_absolute():
            continue
        if ".." in Path(mesh.written).parts:
            what = f"the mesh {mesh.written} lies outside the folder of the problem"
            raise ModelError(what, "move it beside the model file, or give its absolute path")
        target = folder / mesh.written
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(mesh.path, target)


def _write_key(key: list[Tree], record: Tree, folder: Path) -> None:
    _write_csv(folder / "key.csv", COLUMNS, key)
    for name, tree in (("key.json", key), (RECORD, record)):
        text = json.dumps(tree, indent=1, ensure_ascii=False)
        (folder / name).write_text(f"{text}\n", encoding="utf-8")


def _write_csv(path: Path, columns: tuple[str, ...], rows: list[dict[str, object]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, columns, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
