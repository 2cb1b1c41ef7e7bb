"""Expands `copies` of a file into links, joints, drives and loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.files.copies.copying import Copying
from dalembert.model.files.copies.images import Image
from dalembert.model.files.copies.likeness import Likeness
from dalembert.model.files.copies.space_copying import SpaceCopying
from dalembert.model.links.link import GROUND
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.values import (
    NAME_OR_NUMBER,
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    object_schema,
)
from dalembert.units import quantity
from dalembert.wording import closest, quote_value

Path = tuple[str | int, ...]

KEYS = ("of", "count", "phase", "mirror", "about", "shift", "names")
EXAMPLE = "{of: [rod, piston], phase: {crank: [0, 180, 180, 0]}, shift: [0, 540, 180, 360]}"
MOST = 100
"""Copies of one entry."""


def copies_schema() -> JsonSchema:
    """The JSON Schema of `copies`."""
    several = {"anyOf": [NUMBER_OR_TEXT, {"type": "array", "items": NUMBER_OR_TEXT}]}
    by_link = {"type": "object", "additionalProperties": NUMBER_OR_TEXT}
    names = {"type": "array", "items": NAME_OR_NUMBER}
    words = {
        "of": "links; their joints, drives, loads and assembly come along",
        "count": "how many there are then, with the original",
        "phase": "links that stay -> by which angles the copies' places on them are turned, or a step",
        "mirror": "the angle of the line that the copy is reflected in: of ground, or link -> angle",
        "about": "the point of these links that it goes through; default the origin",
        "shift": "how much later the copies' loads come, along the drive, or a step",
        "names": "what the copies' names end with; default 2, 3, ...",
    }
    kinds: JsonSchema = {"of": names, "count": {"type": "integer"}, "about": {"type": "string"}}
    kinds |= {"phase": by_link | {"additionalProperties": several}, "shift": several, "names": names}
    kinds["mirror"] = {"anyOf": [NUMBER_OR_TEXT, by_link]}
    keys = {key: kinds[key] | {"description": text} for key, text in words.items()}
    return {
        "type": "array",
        "items": object_schema(keys, "of"),
        "description": "parts written once and copied",
    }


def expand(
    tree: Mapping[str, object], rules: ReadingRules
) -> tuple[Mapping[str, object], dict[Path, Path], tuple[Likeness, ...]]:
    """The tree with its copies expanded; paths of the new parts -> path of the copy; relations of copies to
    originals."""
    entries = tree.get("copies")
    if not isinstance(entries, (list, tuple)):
        problem = f"expected a list, not {quote_value(entries)}"
        raise ModelError(problem, f"write copies: [{EXAMPLE}]", ("copies",))
    out: Tree = {key: value for key, value in tree.items() if key != "copies"}
    for key in ("links", "joints", "drives", "loads", "assembly", "start"):
        if isinstance(out.get(key), Mapping):
            out[key] = {str(name): value for name, value in out[key].items()}
    _state_against(out)
    copied: dict[Path, Path] = {}
    alike: list[Likeness] = []
    space = tree.get("space") == "space"
    for k, entry in enumerate(entries):
        try:
            for image in _images(entry, out, rules):
                kind = SpaceCopying if space else Copying
                copying = kind(out, [str(n) for n in entry["of"]], image, copied, ("copies", k))
                copying.run()
                alike += [] if space else [copying.likeness()]
        except ModelError as error:
            what = f"copies {k + 1}: {error.what}"
            raise ModelError(what, error.remedy, ("copies", k, *error.path)) from None
    return out, copied, tuple(alike)


def _state_against(tree: Tree) -> None:
    """Writes out what tables are against, the only drive, where they leave it out, before the drive is copied."""
    drives: object = tree.get("drives")
    if not isinstance(drives, Mapping) or len(drives) != 1:
        return
    only = next(iter(drives))
    for section, key in (("loads", "value"), ("drives", "effort")):
        parts = tree.get(section)
        if isinstance(parts, Mapping):
            tree[section] = {name: _part_against(part, key, only) for name, part in parts.items()}


def _part_against(part: object, key: str, drive: str) -> object:
    return {**part, key: _against(part[key], drive)} if isinstance(part, Mapping) and key in part else part


def _against(value: object, drive: str) -> object:
    if isinstance(value, list):
        return [_against(item, drive) for item in value]
    return (
        {"against": drive, **value} if isinstance(value, Mapping) and {"x", "file"} & value.keys() else value
    )


def _images(entry: object, tree: Tree, rules: ReadingRules) -> Iterator[Image]:
    keys = mapping(entry, list(KEYS), EXAMPLE)
    for key in ("mirror", "about") if tree.get("space") == "space" else ():
        if key in keys:
            what = "copies in space are turned about the z axis through the origins of the links that stay"
            raise ModelError(what, "write phase: {ground: 60 deg, platform: 60 deg}", (key,))
    of, links = (
        keys.get("of"),
        {str(name) for name in tree["links"]} if isinstance(tree.get("links"), Mapping) else set(),
    )
    if not isinstance(of, (list, tuple)) or not of:
        raise ModelError("it says no links", f"write {EXAMPLE}", ("of",) if of is not None else ())
    for k, name in enumerate(of):
        if str(name) not in links or name == GROUND:
            problem = f"unknown moving link {str(name)!r}"
            raise ModelError(problem, closest(str(name), sorted(links - {GROUND})), ("of", k))
    turned = _phases(keys, links - {str(name) for name in of})
    count = _count(keys, turned)
    phases = {link: at_item("phase", _steps, value, count, "angle", rules) for link, value in turned.items()}
    shift = keys.get("shift")
    names = keys.get("names", range(2, count + 1))
    if (
        not isinstance(names, (list, tuple, range))
        or len(names) != count - 1
        or len(set(map(str, names))) < len(names)
    ):
        what = f"{count - 1} names are needed, of the copies only"
        raise ModelError(what, "write names: [left, right]", ("names",))
    slides = set(rules.freedoms.values()) == {"slide"}
    shifts = (
        [0.0] * count
        if shift is None
        else at_item("shift", _steps, shift, count, "length" if slides else "angle", rules)
    )
    for k in range(1, count):
        phase = {link: values[k] for link, values in phases.items()}
        yield Image(f"_{names[k - 1]}", phase, "mirror" in keys, shifts[k], str(keys.get("about", "")), rules)


def _phases(keys: Mapping[str, object], links: set[str]) -> dict[str, object]:
    """Links that stay -> angles of their images."""
    if "phase" in keys and "mirror" in keys:
        raise ModelError("it is both turned and mirrored", "write phase or mirror", ("mirror",))
    which = "mirror" if "mirror" in keys else "phase"
    angles = keys.get(which, {})
    if which == "mirror" and not isinstance(angles, Mapping):
        angles = {GROUND: angles}
    if not isinstance(angles, Mapping):
        what = f"{quote_value(angles)} does not say on which link"
        raise ModelError(what, "write phase: {crank: [0, 180]}", (which,))
    for link in angles:
        if str(link) not in links:
            problem = f"{str(link)!r} is not a link outside the copies"
            raise ModelError(problem, closest(str(link), sorted(links)), (which,))
    return {str(link): [0, value] if which == "mirror" else value for link, value in angles.items()}


def _count(keys: Mapping[str, object], turned: Mapping[str, object]) -> int:
    listed = {len(value) for value in (*turned.values(), keys.get("shift")) if isinstance(value, list)}
    count = keys.get("count", next(iter(listed), 2 if "mirror" in keys else None))
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST:
        raise ModelError(
            f"it does not say how many, from 2 to {MOST}",
            "write count: 4, the original among them",
            ("count",) if "count" in keys else (),
        )
    if listed - {count}:
        what = f"count is {count}, but a list has {max(listed - {count})} values"
        raise ModelError(what, "give one value for each, the original's 0 first")
    return count


def _steps(value: object, count: int, kind: str, rules: ReadingRules) -> list[float]:
    """One for each, the original's first; a single value is a step."""
    if not isinstance(value, list):
        step = quantity(value, kind, rules.units)
        return [k * step for k in range(count)]
    steps = [at_item(k, quantity, x, kind, rules.units) for k, x in enumerate(value)]
    if steps[0]:
        what = f"a list begins with {quote_value(value[0])}, and the original stays"
        raise ModelError(what, "begin with 0", (0,))
    return steps
