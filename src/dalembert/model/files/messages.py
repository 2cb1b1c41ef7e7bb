"""Turns the errors of a description, pydantic's and the model's, into sentences, most useful first."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from dalembert.errors import Locator, ModelError
from dalembert.wording import closest, quote_value

Path = tuple[str | int, ...]

SINGULAR = {
    "links": "link",
    "points": "point",
    "joints": "joint",
    "drives": "drive",
    "loads": "load",
    "forces": "force",
    "couples": "couple",
    "answers": "answer",
}
"""Collection -> what one of its members is called."""

HINTS = {
    "links": "name the two links it connects, links: [ground, crank]",
    "type": "say what it is, for example type: pin",
    "on": "name the link it acts on, on: coupler",
    "at": "name the point it acts at, at: P",
    "value": "give it a value, or value: unknown",
    "between": "name its two ends, between: [ground.A, rod.B]",
    "joint": "name the joint",
    "stiffness": "give it, for example stiffness: 2000 N/m",
    "damping": "give it, for example damping: 30 N*s/m",
    "direction": "give the angle it points at, direction: 30 deg",
    "quantity": "name the unknown quantity, quantity: effort",
}
"""Missing key -> what to write."""

MOST = 20
"""Largest number of errors listed one by one."""


class UnknownKey(ModelError):  # noqa: N818
    """A key that a part of the description does not have."""


class ModelErrors(ModelError):  # noqa: N818
    """Several errors of one description, the most useful first, one a line."""

    def __init__(self, errors: Sequence[ModelError]) -> None:
        first = errors[0]
        super().__init__(first.what, first.remedy, first.path, first.file, first.line)
        self.errors = tuple(errors)

    def __str__(self) -> str:
        more = len(self.errors) - MOST
        rest = [f"and {more} more"] if more > 0 else []
        return "\n".join([*map(str, self.errors[:MOST]), *rest])

    def at_source(self, source: Locator | None) -> ModelError:
        return ModelErrors([error.at_source(source) for error in self.errors])


def together(errors: Sequence[ModelError]) -> ModelError:
    """One error for several."""
    flat: dict[tuple[object, ...], ModelError] = {}
    for error in errors:
        for one in error.errors if isinstance(error, ModelErrors) else (error,):
            flat.setdefault((one.what, one.path), one)
    distinct = list(flat.values())
    return distinct[0] if len(distinct) == 1 else ModelErrors(distinct)


def of_originals(error: ModelError, copied: Mapping[Path, Path]) -> ModelError:
    """The errors but for those of copies, which repeat those of the originals; if there are others."""
    errors = error.errors if isinstance(error, ModelErrors) else (error,)
    originals = [one for one in errors if one.path[:2] not in copied]
    return together(originals) if originals else error


def place(path: Sequence[str | int]) -> str:
    """Place in a description, in words.

    >>> place(("links", "crank", "points", "A", "at", 0))
    "item 1 of at of point 'A' of link 'crank'"
    >>> place(("joints", "F", "profile", "points", "angle", 2))
    "item 3 of angle of points of profile of joint 'F'"
    """
    words: list[str] = []
    keys = list(path)
    while keys:
        key = keys.pop(0)
        listed = key == "links" and keys and isinstance(keys[0], int)
        if key in SINGULAR and keys and not listed and words[-1:] != ["profile"]:
            member = keys.pop(0)
            words.append(f"{SINGULAR[str(key)]} {member + 1 if isinstance(member, int) else repr(member)}")
        else:
            words.append(f"item {key + 1}" if isinstance(key, int) else str(key))
    return " of ".join(reversed(words))


def translate(error: ValidationError, tree: object) -> ModelError:
    """pydantic's findings about a tree as one ModelError, with paths down that tree."""
    errors = [_translate_one(one, tree) for one in error.errors(include_url=False)]
    ranked = sorted(enumerate(errors), key=lambda pair: (pair[1][0], pair[0]))
    return together([one for _, (_, one) in ranked])


def _translate_one(one: ErrorDetails, tree: object) -> tuple[int, ModelError]:
    path = _path(one["loc"], tree, one["type"] == "missing")
    inner = one.get("ctx", {}).get("error")
    if isinstance(inner, ModelError):
        return _of_ours(inner, path)
    if one["type"] == "missing":
        return 3, _missing(path)
    what, remedy = _sentence(one)
    return 2, ModelError(f"{place(path)}: {what}" if path else what, remedy, path)


def _of_ours(inner: ModelError, path: Path) -> tuple[int, ModelError]:
    if isinstance(inner, UnknownKey):
        where = f" in {place(path)}" if path else ""
        return 0, ModelError(inner.what + where, inner.remedy, path + inner.path)
    full = path + inner.path
    if inner.file:  # another file, which the description names there
        what = f"{inner.what} (read for {place(path)})" if path else inner.what
        return 2, ModelError(what, inner.remedy, full, inner.file, inner.line)
    if not path:
        return 1, inner
    return 2, ModelError(f"{place(full)}: {inner.what}", inner.remedy, full)


def _path(loc: Sequence[str | int], tree: object, missing: bool) -> Path:
    """pydantic's location without the names of the alternatives it tried, which are not keys of the tree."""
    path: list[str | int] = []
    for step, key in enumerate(loc):
        inner = _inside(tree, key)
        if inner is not tree:
            tree = inner
        elif step < len(loc) - 1 or not missing:
            continue
        path.append(key)
    return tuple(path)


def _inside(tree: object, key: str | int) -> object:
    """Value at a key, or the tree itself if it does not have the key."""
    if isinstance(tree, Mapping):
        return tree.get(key, tree)
    if isinstance(tree, (list, tuple)) and isinstance(key, int) and key < len(tree):
        return tree[key]
    return tree


def _missing(path: Path) -> ModelError:
    key = str(path[-1])
    where = f" in {place(path[:-1])}" if path[:-1] else ""
    return ModelError(f"the key {key!r} is missing{where}", HINTS.get(key, f"write {key}: ..."), path[:-1])


def _sentence(one: ErrorDetails) -> tuple[str, str]:
    kind, value, ctx = one["type"], one.get("input"), one.get("ctx", {})
    if kind == "union_tag_invalid":
        word, choices = str(ctx["tag"]), _quote(ctx["expected_tags"])
        meant = [name for name in MEANT.get(word.lower().replace(" ", "_"), ()) if name in choices]
        remedy = f"write {' in the plane, '.join(meant)}" + (" in space" if len(meant) > 1 else "")
        return f"unknown type {quote_value(word)}", remedy if meant else closest(word, choices, 30)
    if kind == "union_tag_not_found":
        return "the key 'type' is missing", HINTS["type"]
    if kind == "literal_error":
        choices = _quote(ctx["expected"])
        return f"{quote_value(value)} is not a valid value", closest(str(value), choices)
    if kind in ("model_type", "model_attributes_type", "dict_type", "mapping_type"):
        return f"expected a mapping, not {quote_value(value)}", "write {key: value, ...}"
    if kind in ("tuple_type", "list_type"):
        return f"expected a list, not {quote_value(value)}", "write [..., ...]"
    if kind in ("bool_type", "bool_parsing"):
        return f"{quote_value(value)} is neither true nor false", "write true or false"
    if kind == "string_type":
        return f"{quote_value(value)} is not text", "put it in quotes"
    return f"{quote_value(value)}: {one['msg'].lower()}", ""


MEANT: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("hinge", "bearing", "rotary"), ("pin", "revolute")),
    **dict.fromkeys(("sliding", "translational", "translation", "guide"), ("slider", "prismatic")),
    **dict.fromkeys(("ball", "ball_joint", "sphere"), ("spherical",)),
    **dict.fromkeys(("cardan", "hooke", "u_joint", "u-joint"), ("universal",)),
    **dict.fromkeys(("helical", "helix", "thread"), ("screw",)),
    **dict.fromkeys(("fixed", "rigid", "clamp"), ("weld",)),
    **dict.fromkeys(("torque", "moment"), ("couple",)),
}
"""Names of the types in other programs and books: in the plane, in space."""


def _quote(choices: str) -> list[str]:
    return re.findall(r"'([^']*)'", choices)
