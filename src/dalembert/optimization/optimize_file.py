"""optimize.yaml: an aim, bounds and conditions for a model file, with the names and units of that file."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.files.task_files import load_task, motion_options, plain_options
from dalembert.optimization.optimizing import optimize
from dalembert.optimization.optimum import Optimum
from dalembert.optimization.pareto_front import Front, pareto
from dalembert.wording import quote_value

KEYS = {
    "optimize": "version of this format, 1",
    "model": "the model file, beside this file",
    "title": "what it is about",
    "vary": "path or parameter -> [low, high], [low, high, step], or range",
    "least": "the aim, such as peak effort.O2; or two, in a list, of a Pareto front",
    "points": "number of designs of a front, such as 7",
    "where": "conditions at every position, such as transmission.B >= 33 deg",
    "starts": "number of random designs, such as 1000",
    "seed": "an integer; repeats the same random designs",
    "positions": "number of positions instead of the file's",
    "static": "true leaves inertia out",
    "method": "an optimizer by name, such as nlopt.slsqp or pymoo.de",
    "simulate": "motions under forces, {until: [2 s, 'O2.speed = 0 rad/s'], start: ..., count: 201}",
}


def optimize_file(
    path: str | os.PathLike[str],
    changed: Callable[[Mechanism], Mechanism] = lambda m: m,
    single: bool = False,
) -> Optimum | Front:
    """The optimum of a file, whose model is ``changed`` first, of two aims the front unless ``single``; raises
    ModelError with file and line."""

    def best(tree: Mapping[str, Any], m: Mechanism, _: object) -> Optimum | Front:
        options = _options(tree)
        if isinstance(options["least"], str):
            return optimize(changed(m), **options)
        if single:
            what = "two aims give several designs, and a model file has one"
            raise ModelError(what, "write .csv, .xlsx, .json or a report, or give one aim", ("least",))
        if "simulate" in options:
            what = "two aims along motions under forces give no front"
            raise ModelError(what, "give one aim, and a condition for the other", ("simulate",))
        points: Any = plain_options(tree, {"points": 2}, ())
        return pareto(changed(m), **options, **points)

    return load_task(path, "optimize", KEYS, best)


def _options(tree: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `optimize` that a file specifies."""
    vary, least = tree.get("vary"), tree.get("least")
    if not isinstance(vary, Mapping) or not vary:
        raise ModelError(
            "no number varies", "write vary: {stroke: [80 mm, 120 mm]}", ("vary",) * ("vary" in tree)
        )
    two = isinstance(least, list) and len(least) == 2 and all(isinstance(aim, str) for aim in least)
    if not (two or isinstance(least, str)):
        remedy = "write least: peak effort.O2, or two aims in a list"
        raise ModelError("no aim to minimize", remedy, ("least",) * ("least" in tree))
    if "points" in tree and not two:
        raise ModelError("points are those of a front", "give least two aims in a list", ("points",))
    where = tree.get("where", [])
    where = [where] if isinstance(where, str) else where
    if not isinstance(where, list):
        raise ModelError(
            f"where is {quote_value(where)}", "write a list: [transmission.B >= 33 deg]", ("where",)
        )
    for k, text in enumerate(where):
        if not isinstance(text, str):
            what = f"condition {k + 1} is {quote_value(text)}"
            raise ModelError(what, "write one like transmission.B >= 33 deg", ("where", k))
    bounds = {str(name): _bounds(str(name), ends) for name, ends in vary.items()}
    options = plain_options(tree, {"starts": 1, "seed": 0, "positions": 1}, ("static",))
    if "method" in tree:
        options["method"] = tree["method"]
    if "simulate" in tree:
        options["simulate"] = motion_options(tree)
    return {"vary": bounds, "least": least, "where": where, **options}


def _bounds(name: str, ends: object) -> Sequence[str]:
    """Texts, read as in the model file: for vectors [x, y]; or `range`."""
    if ends == "range":
        return "range"
    if not isinstance(ends, list) or len(ends) not in (2, 3):
        raise ModelError(
            f"the bounds of {name!r} are {quote_value(ends)}", "write [low, high], or range", ("vary", name)
        )
    return [str(end).replace("'", "") for end in ends]
