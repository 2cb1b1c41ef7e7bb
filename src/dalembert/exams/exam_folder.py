"""Variants on disk: a folder that appears whole or not at all, and that replaces only one made in the same way."""

from __future__ import annotations

import csv
import json
import secrets
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.exams.asked import COLUMNS
from dalembert.exams.question_sheet import question_sheet, solution_sheet
from dalembert.exams.variant import key_rows
from dalembert.grading.file_answers import describe_answer
from dalembert.saving import check_installed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dalembert.exams.variant import Progress, Variant
    from dalembert.model import Answer, Mechanism

RECORD = "variants.json"
"""The seed, what was asked and the values of each variant: the mark of such a folder."""

PARTS = {
    "problems": (".yaml",),
    "questions": (".pdf", ".html"),
    "answers": (".csv",),
    "solutions": (".pdf", ".html"),
}
"""Folders of a variant's files, and their endings."""

ALONE = ("key.csv", "key.json", RECORD)
SHEET = ("variant", "quantity", "of", "on", "at", "extreme", "component", "axes", "value", "unit")
"""Columns of the table that a student may fill in."""


def check_folder(folder: Path, overwrite: bool) -> None:
    """Raise where a folder cannot be written, before the work: one that exists is kept, unless it is empty."""
    check_installed("typst", "writing question sheets", "report")
    if not folder.parent.is_dir():
        raise ModelError(
            f"cannot write {folder}: there is no folder {folder.parent}", "make it, or name another"
        )
    if folder.exists() and not folder.is_dir():
        raise ModelError(f"{folder} is a file", "name a folder")
    if not folder.is_dir() or not any(folder.iterdir()):
        return
    if not overwrite:
        raise ModelError(
            f"{folder} exists", "name another folder, or replace it: --force, in Python overwrite=True"
        )
    strange = _strange(folder)
    if strange:
        raise ModelError(f"{folder} has {strange}, which would be lost", "move it, or name another folder")


def _strange(folder: Path) -> str:
    """A file that is none of those that variants write."""
    if not (folder / RECORD).is_file():
        return next(iter(sorted(p.name for p in folder.iterdir())))
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        endings = PARTS.get(inside.parts[0], ())
        made = len(inside.parts) == 2 and path.suffix in endings and path.stem.isdigit()
        made |= inside.parts[0] == "problems" and (path.suffix.lower() == ".stl" or path.is_dir())
        if not (made or inside.as_posix() in ALONE or (path.is_dir() and inside.as_posix() in PARTS)):
            return inside.as_posix()
    return ""


def write_folder(
    found: Sequence[Variant],
    asked: Sequence[Answer],
    seed: int,
    folder: Path,
    overwrite: bool,
    progress: Progress | None = None,
) -> None:
    """Write all sheets beside the folder and put them in its place when all is there."""
    check_folder(folder, overwrite)
    beside = folder.parent / f".{folder.name[:40]}.{secrets.token_hex(8)}"
    try:
        for part in PARTS:
            (beside / part).mkdir(parents=True)
        for k, one in enumerate(found):
            _write_variant(one, asked, beside)
            if progress is not None:
                progress("sheets written", k + 1, len(found))
        _write_key(found, asked, seed, beside)
        _put_in_place(beside, folder)
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def _put_in_place(beside: Path, folder: Path) -> None:
    old = folder.parent / f"{beside.name}.old"
    if folder.exists():
        folder.rename(old)
    try:
        beside.rename(folder)
    except BaseException:
        if old.exists() and not folder.exists():
            old.rename(folder)
        raise
    shutil.rmtree(old, ignore_errors=True)


def _write_variant(v: Variant, asked: Sequence[Answer], folder: Path) -> None:
    v.mechanism.save(folder / "problems" / f"{v.name}.yaml")
    _copy_meshes(v.mechanism, folder / "problems")
    for part, sheet in (("questions", question_sheet), ("solutions", solution_sheet)):
        made = sheet(v.result, asked, v.name)
        for ending in PARTS[part]:
            made.save(folder / part / f"{v.name}{ending}")
    rows = [{**row, "variant": v.name, "value": ""} for row in v.key]
    _write_csv(folder / "answers" / f"{v.name}.csv", SHEET, rows)


def _copy_meshes(m: Mechanism, folder: Path) -> None:
    """The STL files that shapes name, beside the problem as they were beside its file."""
    for mesh in (getattr(s, "file", None) for link in m.links.values() for s in link.shapes):
        if mesh is None or Path(mesh.written).is_absolute():
            continue
        if ".." in Path(mesh.written).parts:
            what = f"the mesh {mesh.written} lies outside the folder of the problem"
            raise ModelError(what, "put it beside the model file, or name it by its whole path")
        target = folder / mesh.written
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(mesh.path, target)


def _write_key(found: Sequence[Variant], asked: Sequence[Answer], seed: int, folder: Path) -> None:
    key = key_rows(found, "problems")
    _write_csv(folder / "key.csv", COLUMNS, key)
    (folder / "key.json").write_text(json.dumps(key, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    record = {
        "title": found[0].mechanism.title,
        "seed": seed,
        "asked": [describe_answer(a) for a in asked],
        "variants": {v.name: dict(v.values) for v in found},
    }
    (folder / RECORD).write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _write_csv(path: Path, columns: tuple[str, ...], rows: list[dict[str, object]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, columns, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
