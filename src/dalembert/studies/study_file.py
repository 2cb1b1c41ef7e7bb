"""study.yaml: a study beside its model file, in the words and units of that file."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.files.task_files import load_task, mapping_of, motion_options, plain_options, texts_of
from dalembert.studies.design_study import Study, study
from dalembert.studies.sampling import DRAWS
from dalembert.units import NUMBER
from dalembert.wording import closest, quote_value

KEYS = {
    "study": "version of this format, 1",
    "model": "the model file, beside this file",
    "title": "what the study is",
    "vary": "path or parameter -> its spread",
    "outputs": "names of quantities, as effort.O2",
    "reduce": "over the positions: peak, mean, rms, envelope, argpeak, norm8, refined_peak, refined_place, or none; "
    "of a motion final too",
    "designs": "how many",
    "draw": "random, sobol, latin or factorial",
    "table": "a .csv file of designs, instead of designs and draw: one column per path, with the head `path [unit]`",
    "seed": "an integer; the same seed draws the same designs again",
    "limits": "output -> what it has to keep, as < 45 N*m",
    "correlation": "'path, path' -> correlation of two numbers",
    "simulate": "motions under forces, {until: [2 s, 'O2.speed = 20 rad/s'], start: ..., count: 201, tolerance: 1e-9}",
    "static": "true leaves inertia out",
    "positions": "number of positions instead of the file's",
    "keep": "true stores the drawn numbers too",
}
LARGEST = 50_000_000
"""Bytes of a table of designs."""


def load_study(
    path: str | os.PathLike[str], changed: Callable[[Mechanism], Mechanism] = lambda m: m
) -> Study:
    """The study of a file, whose model is ``changed`` first; raises ModelError with file and line."""
    return load_task(path, "study", KEYS, lambda tree, m, folder: _study(tree, changed(m), folder))


def _study(tree: Mapping[str, object], mechanism: Mechanism, folder: Path) -> Study:
    options = _options(tree)
    vary: dict[str, object] = texts_of(mapping_of(tree, "vary", "stroke: ± 0.1 mm")) if "vary" in tree else {}
    table = tree.get("table")
    if table is not None:
        for key in ("designs", "draw", "seed"):
            if key in tree:
                raise ModelError(
                    f"table and {key} are both given", f"leave {key} out: the table is the designs", (key,)
                )
        if vary:
            raise ModelError(
                "table and vary are both given",
                "leave vary out: the table's heads say what varies",
                ("vary",),
            )
        options["draw"] = _table(folder / str(table))
    elif "vary" not in tree:
        raise ModelError("the key 'vary' is missing", "write vary: {stroke: ± 0.1 mm}", ())
    elif "designs" not in tree and tree.get("draw") != "factorial":
        raise ModelError("the key 'designs' is missing", "write designs: 10000", ())
    try:
        return study(mechanism, vary, **options)
    except ModelError as error:
        raise _placed(error, tree) from None


def _placed(error: ModelError, tree: Mapping[str, object]) -> ModelError:
    """The error at the key of the study that it is about."""
    if error.file or (error.path[:1] and error.path[0] in tree):
        return error
    place: tuple[str | int, ...] = ()
    outputs = tree.get("outputs")
    for k, name in enumerate(outputs if isinstance(outputs, list) else [outputs]):
        if name is not None and (repr(name) in error.what or str(name) in error.what):
            place = ("outputs", k) if isinstance(outputs, list) else ("outputs",)
    if not place:
        words = {
            "reduc": "reduce",
            "designs": "designs",
            "factorial": "draw",
            "draw": "draw",
            "position": "positions",
        }
        place = next(((key,) for word, key in words.items() if word in error.what and key in tree), ())
    return ModelError(error.what, error.remedy, place or ("vary",) * ("vary" in tree))


def _options(tree: Mapping[str, object]) -> Tree:
    """Arguments of `study` in a file."""
    out: Tree = plain_options(tree, {"designs": 1, "seed": 0, "positions": 1}, ("static", "keep"))
    outputs = tree.get("outputs")
    if outputs is not None:
        names = [outputs] if isinstance(outputs, str) else outputs
        if not isinstance(names, list) or not names or not all(isinstance(n, str) for n in names):
            what = "outputs are not a list of names"
            raise ModelError(what, "write outputs: [effort.O2, reaction.A.magnitude]", ("outputs",))
        out["outputs"] = names
    if "reduce" in tree:
        reduce = tree["reduce"]
        if reduce is not None and not isinstance(reduce, str):
            raise ModelError(
                f"{quote_value(reduce)} is not a reduction", "write reduce: peak, or none", ("reduce",)
            )
        out["reduce"] = None if reduce in (None, "none") else reduce
    if "draw" in tree:
        draw = tree["draw"]
        names = [d for d in DRAWS if d != "table"]
        if draw not in names:
            raise ModelError(
                f"unknown sampling method {quote_value(draw)}", closest(str(draw), names), ("draw",)
            )
        out["draw"] = draw
    if "limits" in tree:
        out["limits"] = mapping_of(tree, "limits", "effort.O2: < 45 N*m")
    if "simulate" in tree:
        out["simulate"] = motion_options(tree)
    if "correlation" in tree:
        out["correlation"] = dict(map(_pair, mapping_of(tree, "correlation", "'stroke, bore': 0.5").items()))
    return out


def _pair(item: tuple[Any, Any]) -> tuple[tuple[str, str], Any]:
    paths = [path.strip() for path in str(item[0]).split(",")]
    if len(paths) != 2:
        raise ModelError(
            f"{quote_value(item[0])} names no two paths",
            "write 'stroke, bore': 0.5",
            ("correlation", item[0]),
        )
    return (paths[0], paths[1]), item[1]


def _table(path: Path) -> dict[str, list[str]]:
    """Path -> values of a CSV file of designs, each with the unit of its column."""
    try:
        if path.stat().st_size > LARGEST:
            raise ModelError(f"{path} is larger than {LARGEST // 10**6} MB", "leave designs out", ("table",))
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8"
        raise ModelError(
            f"cannot read {path}: {str(reason).lower()}", "name a .csv file", ("table",)
        ) from None
    rows = [(k, row) for k, row in enumerate(csv.reader(lines), 1) if any(cell.strip() for cell in row)]
    if len(rows) < 2:
        raise ModelError(
            "the table has no designs", "write a head, `stroke [mm], bore [mm]`, and rows", (), str(path), 1
        )
    heads = [re.fullmatch(r"\s*([^\[\]]*?)\s*(?:\[(.*)\])?\s*", head) for head in rows[0][1]]
    if not all(h and h[1] for h in heads) or len({h[1] for h in heads if h}) < len(heads):
        raise ModelError(
            "a head is empty or occurs twice", "write `path [unit]` once each", (), str(path), rows[0][0]
        )
    out: dict[str, list[str]] = {h[1]: [] for h in heads if h}
    for line, row in rows[1:]:
        if len(row) != len(heads):
            raise ModelError(
                f"the row has {len(row)} numbers, but there are {len(heads)} heads",
                "give one below each",
                (),
                str(path),
                line,
            )
        for head, cell in zip(heads, row, strict=True):
            assert head is not None
            if not re.fullmatch(NUMBER, cell.strip()):
                raise ModelError(
                    f"{quote_value(cell)} is not a number",
                    "write one, its unit in the head",
                    (),
                    str(path),
                    line,
                )
            out[head[1]].append(f"{cell.strip()} {head[2] or ''}".strip())
    return out
