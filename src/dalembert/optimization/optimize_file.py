"""optimize.yaml: an aim, bounds and conditions beside a model file, in the words and units of that file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from dalembert.errors import ModelError
from dalembert.model import Mechanism, load
from dalembert.model.files.model_files import read_file
from dalembert.model.part import check_keys
from dalembert.optimization.optimizing import optimize
from dalembert.optimization.optimum import Optimum
from dalembert.wording import quote_value

KEYS = {
    "optimize": "version of this format, 1",
    "model": "the model file, beside this file",
    "title": "what it is about",
    "vary": "path or parameter -> [low, high], or [low, high, step]",
    "least": "the aim, as peak effort.O2",
    "where": "conditions at every position, as transmission.B >= 33 deg",
    "starts": "designs drawn at random, 1000",
    "seed": "a whole number that draws the same designs again",
    "positions": "number of positions in place of the file's",
    "static": "true leaves inertia out",
}


def optimize_file(path: str | os.PathLike[str]) -> Optimum:
    """The optimum of a file; raises ModelError with file and line."""
    tree, source = read_file(path)
    try:
        if not isinstance(tree, Mapping):
            raise ModelError(
                f"{quote_value(tree)} stands where a mapping is needed",
                "write model: ..., vary: ... and least: ...",
            )
        if "links" in tree:
            raise ModelError("this is a model file", "name it in another one: model: FILE", ("links",))
        check_keys(tree, list(KEYS))
        options = _options(tree)
        return optimize(_model(tree, Path(path).parent), **options)
    except ModelError as error:
        raise error.at_source(source) from None


def _model(tree: Mapping[str, Any], folder: Path) -> Mechanism:
    name = tree.get("model")
    if not isinstance(name, str) or not (folder / name).is_file():
        what = (
            f"there is no model file {folder / name}" if isinstance(name, str) else "no model file is named"
        )
        raise ModelError(
            what, "write model: press.yaml, from the folder of this file", ("model",) * ("model" in tree)
        )
    return load(folder / name)


def _options(tree: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of `optimize` that stand in a file."""
    if tree.get("optimize", 1) != 1 or isinstance(tree.get("optimize"), bool):
        raise ModelError(
            f"{quote_value(tree['optimize'])} is no version of the format", "write optimize: 1", ("optimize",)
        )
    vary, least = tree.get("vary"), tree.get("least")
    if not isinstance(vary, Mapping) or not vary:
        raise ModelError(
            "nothing varies", "write vary: {stroke: [80 mm, 120 mm]}", ("vary",) * ("vary" in tree)
        )
    if not isinstance(least, str):
        raise ModelError(
            "nothing is to be least", "write least: peak effort.O2", ("least",) * ("least" in tree)
        )
    where = tree.get("where", [])
    where = [where] if isinstance(where, str) else where
    if not isinstance(where, list) or not all(isinstance(text, str) for text in where):
        raise ModelError(
            f"where is {quote_value(where)}", "write a list: [transmission.B >= 33 deg]", ("where",)
        )
    out: dict[str, Any] = {"least": least, "where": where}
    out["vary"] = {str(name): _bounds(str(name), given) for name, given in vary.items()}
    for key in ("starts", "seed", "positions"):
        if key in tree:
            value = tree[key]
            if isinstance(value, bool) or not isinstance(value, int) or value < (key != "seed"):
                raise ModelError(f"{key} is {quote_value(value)}", "write a whole number", (key,))
            out[key] = value
    if not isinstance(tree.get("static", False), bool):
        raise ModelError(f"static is {quote_value(tree['static'])}", "write true or false", ("static",))
    return {**out, "static": tree.get("static", False)}


def _bounds(name: str, given: object) -> list[str]:
    """Texts, as the model file reads them: of vectors [x, y]."""
    if not isinstance(given, list) or len(given) not in (2, 3):
        raise ModelError(
            f"the bounds of {name!r} are {quote_value(given)}", "write [low, high]", ("vary", name)
        )
    return [str(end).replace("'", "") for end in given]
