"""Text of a mechanism: its file's text with only the changed values changed, or a new one as a person would write
it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from copy import deepcopy
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Tree
from dalembert.model.files.source import FileSource, Path
from dalembert.model.files.splicing import REMOVED, Change, Renamed, changes_at_once, splice
from dalembert.model.files.yaml_text import scalar
from dalembert.model.quantities.figures import (
    SHORT,
    in_stated_unit,
    plain,
    polar_text,
    polar_units,
    si_quantity,
    with_kept_unit,
    without_fraction,
)
from dalembert.model.quantities.written_tables import FILE_FOLDER
from dalembert.units import NUMBER, Units

if TYPE_CHECKING:
    from dalembert.model.description import Mechanism

NOWHERE = "\0"
"""No folder: a text that may be saved anywhere has no file beside it."""

ROUNDS = 3
"""Largest number of rounds: a changed anchor changes its aliases, which get their old values back in a second round."""


def text_of(m: Mechanism, form: str, folder: str | None = None) -> str:
    """The text of a model file in a format: the text of the mechanism's file, changed as little as possible, if it has
    one.

    Columns of another file stay in it if it is in the ``folder`` of the text (default: that of the mechanism's file).
    """
    file_folder = m.source.folder if m.source is not None else ""
    token = FILE_FOLDER.set(file_folder if folder is None else folder)
    try:
        return _text_of(m, form)
    finally:
        FILE_FOLDER.reset(token)


def _text_of(m: Mechanism, form: str) -> str:
    from dalembert.model.files.model_files import read_text, tree_text

    text = _file_text(m, m.source) if m.source is not None and m.source.text else None
    if text is None:
        return tree_text(file_tree(m), form)
    assert m.source is not None
    if m.source.form == form:
        return text
    tree = read_text(text, m.source.form)[0]
    return tree_text({key: value for key, value in tree.items() if value is not None}, form)


def file_tree(m: Mechanism) -> Tree:
    """The description in the file's units, without default values."""
    tree: Tree = m.model_dump(mode="json", by_alias=True, context=m.units)
    for name, drive in tree.get("drives", {}).items():
        if len(m.joints[m.drive_joint(name)].freedoms) == 1:
            drive.pop("freedom", None)
    return tree


def _file_text(m: Mechanism, source: FileSource) -> str | None:
    """The source's text with the changes; None where that would not be read as this mechanism."""
    from dalembert.model.description import mechanism
    from dalembert.model.files.model_files import read_text

    mark = "\ufeff" if source.text.startswith("\ufeff") else ""
    text = source.text.removeprefix(mark)
    tree = read_text(text, source.form, source.name)[0]
    values = _every_value(m, tree)
    for _ in range(ROUNDS):
        try:
            changed = splice(text, source.form, values)
            anew, where = read_text(changed, source.form, source.name)
            read = mechanism(anew, replace(where, data=source.data))
        except (ValueError, LookupError, AssertionError):
            return None
        if read == m:
            return mark + changed
        values |= dict(_differences(m, read, tree))
    return None


def _every_value(m: Mechanism, tree: Mapping[str, object]) -> dict[Path, object]:
    """The changes, columns that have to be written out, and parameters that are no longer used."""
    known: Any = tree.get("parameters") or {}
    unused = {("parameters", name): REMOVED for name in known if name not in m.parameters}
    return dict(_values(m, tree)) | dict(listed_columns(m, tree)) | unused


def text_changes(m: Mechanism, text: str, form: str) -> list[Change] | None:
    """Changes of the text of a mechanism's file that make it describe this mechanism, columns of other files written
    out; None where one pass is not enough."""
    from dalembert.model.files.model_files import read_text

    token = FILE_FOLDER.set(NOWHERE)
    try:
        return changes_at_once(text, form, _every_value(m, read_text(text, form)[0]))
    except (ValueError, LookupError, AssertionError):
        return None
    finally:
        FILE_FOLDER.reset(token)


def listed_columns(m: Mechanism, tree: object) -> Iterator[tuple[Path, object]]:
    """Tables whose columns are in a file that is not beside the text to be written, written out."""
    written = file_tree(m)
    for part in ("loads", "drives"):
        for path in _tables_from_files(_at(tree, (part,), None), (part,)):
            table = _at(written, (part, str(path[1]), *path[2:]), None)
            if isinstance(table, Mapping) and "file" not in table:
                yield path, table


def in_folder(m: Mechanism, tree: Mapping[str, object], folder: str) -> Tree:
    """The tree of a mechanism's file for a file in another folder: columns that are not there are written out."""
    changed: Tree = deepcopy(dict(tree))
    token = FILE_FOLDER.set(folder)
    try:
        for path, value in listed_columns(m, tree):
            _at(changed, path[:-1], {})[path[-1]] = value
    finally:
        FILE_FOLDER.reset(token)
    return changed


def _tables_from_files(tree: object, path: Path) -> Iterator[Path]:
    if isinstance(tree, Mapping) and "file" in tree:
        yield path
    elif isinstance(tree, (Mapping, list)):
        for key, value in tree.items() if isinstance(tree, Mapping) else enumerate(tree):
            yield from _tables_from_files(value, (*path, key))


def _values(m: Mechanism, tree: Mapping[str, object]) -> Iterator[tuple[Path, object]]:
    """Changes as paths down the file's tree, with values in the file's words."""
    dumped = m.to_tree()
    for path, value in m.changes.items():
        yield from _value(m, tree, dumped, path.split("."), value)


def _differences(m: Mechanism, read: Mechanism, tree: Mapping[str, object]) -> Iterator[tuple[Path, object]]:
    """Differences of a text from the mechanism, leaf by leaf."""
    wanted = m.to_tree()
    for path in _differing(wanted, read.to_tree(), ()):
        yield from _value(m, tree, wanted, list(map(str, path)), _at(wanted, path, REMOVED), as_written=False)


def _differing(a: object, b: object, path: Path) -> Iterator[Path]:
    if isinstance(a, dict) and isinstance(b, dict):
        for key in dict.fromkeys([*a, *b]):
            yield from _differing(a.get(key), b.get(key), (*path, key))
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        for i, (x, y) in enumerate(zip(a, b, strict=True)):
            yield from _differing(x, y, (*path, i))
    elif a != b:
        yield path


def _value(
    m: Mechanism, tree: object, dumped: object, keys: list[str], new: object, as_written: bool = True
) -> Iterator[tuple[Path, object]]:
    """A change as paths and values of the tree; `as_written`: a given text is written unchanged."""
    if keys[0] == "parameters" and len(keys) == 2 and isinstance(_at(tree, tuple(keys), None), Mapping):
        keys, dumped = [*keys, "value"], _with_values(dumped, keys[1])
    path, old = _path_to_text(tree, keys)
    while keys[len(path) - 1].isdigit() and _at(dumped, path, REMOVED) is REMOVED:  # it is written otherwise
        path, old = path[:-1], _at(tree, path[:-1], None)
    text = new if as_written and len(path) == len(keys) else None
    if keys[0] == "loads" and keys[2:3] in (["value"], ["direction"]):
        changes = list(_of_load(m, tree, keys[1], text if keys[2:] == ["value"] else None))
        if changes:
            yield from changes
            return
    beside = (*path[:-1], {"mass": "weight", "weight": "mass"}.get(keys[-1], ""))
    if new is None or new is REMOVED:
        yield path, REMOVED
    elif keys[0] == "links" and _at(tree, beside, None) is not None:
        yield beside, Renamed(keys[-1], _value_text(m, text, _at(dumped, path, new), None))
    else:
        value = _value_text(m, text, _at(dumped, path, new), old)
        yield from _items(path, value, old) if as_written else [(path, value)]
        if "inertia" in keys and len(path) == 5:  # a product of inertia stands in two places
            other = (*path[:3], path[4], path[3])
            yield other, _value_text(m, text, _at(dumped, other, new), _at(tree, other, None))


def _with_values(dumped: Any, name: str) -> Tree:
    """The tree with a parameter as a mapping, as in its file."""
    entry = dumped["parameters"][name]
    mapping = entry if isinstance(entry, Mapping) else {"value": entry}
    return {**dumped, "parameters": {**dumped["parameters"], name: mapping}}


def _path_to_text(tree: object, keys: list[str]) -> tuple[Path, object]:
    """Path down the tree, as far as a value that is one text, and the value at that path."""
    path: Path = ()
    for key in keys:
        if isinstance(tree, list) and key.isdigit() and int(key) < len(tree):
            path, tree = (*path, int(key)), tree[int(key)]
        elif isinstance(tree, str):
            break
        else:
            path, tree = (*path, key), tree.get(key) if isinstance(tree, Mapping) else None
    return path, tree


def _at(tree: Any, path: Path, default: object) -> Any:
    """Value at a path of a tree."""
    for key in path:
        try:
            tree = tree[key]
        except (KeyError, IndexError, TypeError):
            return default
    return tree


def _items(path: Path, value: object, old: object) -> Iterator[tuple[Path, object]]:
    """Item by item where both have the same items, so that what is between them stays."""
    if isinstance(value, list) and isinstance(old, list) and len(value) == len(old):
        for i, (new, was) in enumerate(zip(value, old, strict=True)):
            yield from _items((*path, i), new, was)
    elif isinstance(value, dict) and isinstance(old, dict) and set(value) == set(old):
        for key, new in value.items():
            yield from _items((*path, key), new, old[key])
    elif value != old or type(value) is not type(old):
        yield path, value


def _value_text(m: Mechanism, new: object, si: object, old: object) -> object:
    """A value in the words of the one it replaces: as given where it is text, else its number in the same unit."""
    if isinstance(new, str):
        return scalar(new) if re.fullmatch(NUMBER, new) else new
    worded = isinstance(new, (list, tuple)) and any(isinstance(item, str) for item in new)
    if isinstance(si, list) and isinstance(old, str) and "@" in old and len(si) == 2 and not worded:
        return _polar(m, si, old)
    if isinstance(si, list):
        olds = old if isinstance(old, list) and len(old) == len(si) else [None] * len(si)
        items = new if isinstance(new, (list, tuple)) and len(new) == len(si) else [None] * len(si)
        return [_value_text(m, g, s, o) for g, s, o in zip(items, si, olds, strict=True)]
    if isinstance(new, Mapping):
        return {
            key: _value_text(m, item, _at(si, (key,), item), _at(old, (key,), None))
            for key, item in new.items()
        }
    if isinstance(si, dict):
        return {key: _value_text(m, None, value, _at(old, (key,), None)) for key, value in si.items()}
    quantity = si_quantity(si)
    if quantity:
        return _number(*quantity, old, m.units)
    if isinstance(si, float):
        return (
            with_kept_unit(si, "number", old, m.units) if isinstance(old, str) else None
        ) or without_fraction(si)
    return si


def _number(number: float, kind: str, old: object, units: Units) -> object:
    if isinstance(old, str):
        text = with_kept_unit(number, kind, old, units)
        if text is not None:
            return text
    elif old is not None and not units.refuses_bare(kind):
        text = in_stated_unit(number, kind, "", units)
        if text is not None:
            return scalar(text)
    return plain(number, kind, units)


def _polar(m: Mechanism, si: list[str | float], old: str) -> object:
    """A vector as polar text again, where some polar text is exactly this vector."""
    quantities = [si_quantity(x) or (float(x), "number") for x in si]
    vector, kind = tuple(number for number, _ in quantities), quantities[0][1]
    size, angle = polar_units(old, kind, m.units)
    polar = polar_text(vector, kind, m.units, size, angle)
    components = [plain(x, kind, m.units) for x in vector]
    return polar if polar and len(polar) <= max(2 * SHORT, len(str(components))) else components


def _of_load(m: Mechanism, tree: object, name: str, new: object) -> Iterator[tuple[Path, object]]:
    """Value and direction of a force, which may be written as one polar text, or as a vector without a direction."""
    load, was = m.loads[name], _at(tree, ("loads", name), {})
    path, old = ("loads", name, "value"), was.get("value") if isinstance(was, Mapping) else None
    value, direction = getattr(load, "value", None), getattr(load, "direction", None)
    if isinstance(value, tuple) and was.get("direction") is not None:
        yield ("loads", name, "direction"), REMOVED
        yield path, _value_text(m, new, m.to_tree()["loads"][name]["value"], None)
    elif isinstance(new, str) and "@" in new:
        yield path, new
        if was.get("direction") is not None:
            yield ("loads", name, "direction"), REMOVED
    elif (
        isinstance(old, str) and "@" in old and isinstance(direction, float) and not isinstance(value, tuple)
    ):
        size, angle = polar_units(old, "force", m.units)
        number = m.to_tree()["loads"][name]["value"]
        quantity = si_quantity(number)
        if quantity and (text := _polar_text(quantity[0], direction, size, angle, m.units)):
            yield path, text
            return
        for key, si in m.to_tree()["loads"][name].items():
            if key in ("value", "direction"):
                yield ("loads", name, key), _value_text(m, new if key == "value" else None, si, None)


def _polar_text(size: float, angle: float, size_unit: str, angle_unit: str, units: Units) -> str | None:
    r = in_stated_unit(size, "force", size_unit, units)
    turn = in_stated_unit(angle, "angle", angle_unit, units)
    return None if r is None or turn is None else f"{r} @ {turn}"
