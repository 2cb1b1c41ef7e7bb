"""Files beside a model file that say what to do with it: the model they name, and their plain options."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from dalembert.errors import ModelError, errors_at
from dalembert.model.description import Mechanism
from dalembert.model.files.model_files import load, read_file
from dalembert.model.part import check_keys
from dalembert.wording import quote_value

Task = TypeVar("Task")
LARGEST = 1e18


def load_task(
    path: str | os.PathLike[str],
    what: str,
    keys: Mapping[str, str],
    make: Callable[[Mapping[str, object], Mechanism, Path], Task],
) -> Task:
    """Result of ``make(tree, mechanism, folder)`` for a file with these keys, whose version is under the key ``what``;
    raises ModelError with file and line."""
    tree, source = read_file(path)
    folder = Path(path).parent
    try:
        if not isinstance(tree, Mapping):
            problem = f"expected a mapping, not {quote_value(tree)}"
            raise ModelError(problem, "write model: ... and vary: ...")
        if "links" in tree:
            raise ModelError(
                "this is a model file",
                f"write a separate file with the line model: {Path(path).name}",
                ("links",),
            )
        check_keys(tree, list(keys))
        if tree.get(what, 1) != 1 or isinstance(tree.get(what), bool):
            raise ModelError(f"unknown format version {quote_value(tree[what])}", f"write {what}: 1", (what,))
        return make(tree, _model(tree, folder), folder)
    except ModelError as error:
        raise error.at_source(source) from None


def _model(tree: Mapping[str, object], folder: Path) -> Mechanism:
    name = tree.get("model")
    if not isinstance(name, str) or not name:
        where = ("model",) * ("model" in tree)
        raise ModelError("the file names no model file", "write model: pump.yaml", where)
    path = folder / name
    if not path.is_file():
        raise ModelError(
            f"model file {path} does not exist", "give its path relative to this file", ("model",)
        )
    return load(path)


def plain_options(
    tree: Mapping[str, object], integers: Mapping[str, int], truths: tuple[str, ...]
) -> dict[str, object]:
    """Whole numbers, each with the least it may be, and true or false, of the keys that are given."""
    out: dict[str, object] = {
        key: _whole_number(tree[key], key, least) for key, least in integers.items() if key in tree
    }
    for key in truths:
        if key in tree:
            if not isinstance(tree[key], bool):
                raise ModelError(f"{key} is {quote_value(tree[key])}", f"write {key}: true, or false", (key,))
            out[key] = tree[key]
    return out


def _whole_number(value: Any, key: str, least: int) -> int:
    number = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < LARGEST
    if number and value == int(value) >= least:
        return int(value)
    what = f"{key} is {quote_value(value)}; it must be an integer of at least {least}"
    raise ModelError(what, f"write {key}: 1000", (key,))


def mapping_of(tree: Mapping[str, object], key: str, example: str) -> dict[str, object]:
    """The mapping of a key, which is not empty."""
    value = tree[key]
    if not isinstance(value, Mapping) or not value:
        what = f"{key} is empty" if value == {} else f"{key} is {quote_value(value)}, not a mapping"
        raise ModelError(what, f"write {key}: {{{example}}}", (key,))
    return dict(value)


def texts_of(value: Any) -> Any:
    """Bare numbers, in lists and mappings too, as texts, for which the file's units count."""
    if isinstance(value, Mapping):
        return {key: texts_of(value) for key, value in value.items()}
    if isinstance(value, list):
        return [texts_of(value) for value in value]
    number = isinstance(value, (int, float)) and not isinstance(value, bool) and value != 0
    return repr(value) if number else value


def motion_options(tree: Mapping[str, object]) -> dict[str, object]:
    """Settings of the motion of each design, ``simulate: {until: 2 s}``."""
    motion = mapping_of(tree, "simulate", "until: 2 s")
    texts = {key: texts_of(motion[key]) for key in motion if key in ("until", "start")}
    with errors_at("simulate"):
        return {**motion, **texts, **plain_options(motion, {"count": 2}, ())}
