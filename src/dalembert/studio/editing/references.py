"""Places at which a file refers to a link, joint, load or drive by its name, and the name changed at all of them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from dalembert.errors import ModelError
from dalembert.model.files.places import Places, TextSpan, places
from dalembert.model.files.source import Path
from dalembert.model.files.splicing import Change, value_text, with_changes

REFERENCES: dict[str, tuple[str, ...]] = {
    "links": (
        "joints.*.links.#",
        "joints.*.ends.#",
        "joints.*.through.#",
        "joints.*.through.#.round",
        "loads.*.on",
        "loads.*.by",
        "loads.*.between.#",
        "drives.*.cylinder.between.#",
        "assembly.*",
        "answers.#.on",
        "answers.#.of",
        "answers.#.by",
        "links.*.like",
    ),
    "joints": (
        "drives.*",
        "drives.*.joint",
        "drives.*.law.over",
        "loads.*.joint",
        "start.*",
        "answers.#.of",
        "answers.#.at.*",
        "loads.*.value.against",
    ),
    "loads": ("answers.#.of",),
    "drives": ("answers.#.of", "answers.#.at.*", "loads.*.value.against", "drives.*.law.over", "start.*"),
}
"""Places of a name, as a key or as a value; ``#`` is a place in a list, ``*`` any key."""

QUANTITIES = {"links": ("angle", "links"), "joints": ("turn", "slide", "joints"), "drives": ("drive",)}
"""Words before a name in an expression: ``angle.rod``, ``joints.A.turn``."""


def rename(text: str, form: str, kind: str, old: str, new: str) -> str:
    """The text with another name for a link, joint, load or drive, here and wherever it is meant.

    Raises ModelError where the name is taken. A joint's drive has its name, and follows.

    >>> print(rename("links: {ground: {}, a: {mass: 1}}\\nassembly: {a: 30}", "yaml", "links", "a", "arm"))
    links: {ground: {}, arm: {mass: 1}}
    assembly: {arm: 30}
    """
    index = places(text, form)
    if (kind, new) in index:
        raise ModelError(f"the name {new!r} is already used in {kind}", "choose another name")
    if (kind, old) not in index:
        raise ModelError(f"{kind} has no {old!r}", "choose one that is in the file")
    changes = list(_changes(text, form, index, kind, old, new))
    return with_changes(text, set(changes))


def rename_point(text: str, form: str, link: str, old: str, new: str) -> str:
    """The text with another name for a point of a link; joints that find it by their name say ``at``."""
    index = places(text, form)
    if ("links", link, "points", new) in index:
        raise ModelError(f"link {link!r} already has a point {new!r}", "choose another name")
    if ("links", link, "points", old) not in index:
        raise ModelError(f"link {link!r} has no point {old!r}", "choose one that is in the file")
    changes = [_key(form, index["links", link, "points", old], new)]
    for path, place in index.items():
        words = _word(text, place) if place.form == "scalar" else ""
        if words == f"{link}.{old}" and (path[0] == "answers" or {"between", "ends", "through"} & {*path}):
            changes.append(_value(text, form, place, f"{link}.{new}"))
        elif words == old and _of_link(text, index, path, link):
            changes.append(_value(text, form, place, new))
        elif path[:-1] == ("links", link, "effective_length") and old in (ends := str(path[-1]).split("-")):
            changes.append(_key(form, place, "-".join(new if end == old else end for end in ends)))
    changes += _joints_at(text, form, index, link, old, new)
    return with_changes(text, set(changes))


def _changes(text: str, form: str, index: Places, kind: str, old: str, new: str) -> Iterator[Change]:
    yield _key(form, index[kind, old], new)
    if kind == "joints":
        yield from _kept_points(text, form, index, old)
    for path, place in index.items():
        for pattern in REFERENCES[kind]:
            if not _meant(path, pattern):
                continue
            if pattern.endswith("*") and path[-1] == old and place.key is not None:
                yield _key(form, place, new)
            elif place.form == "scalar" and not pattern.endswith("*"):
                words = _word(text, place)
                if words == old or (kind == "links" and words.startswith(old + ".")):
                    yield _value(text, form, place, new + words[len(old) :])
        if place.form == "scalar" and path[0] in ("loads", "drives", "parameters", "joints"):
            words = _word(text, place)
            changed = _in_expression(words, kind, old, new)
            if changed != words and not any(_meant(path, p) for p in REFERENCES[kind]):
                yield _value(text, form, place, changed)


def _in_expression(said: str, kind: str, old: str, new: str) -> str:
    """An expression with another name: behind a quantity's word, and of a drive as a name alone."""
    name = re.escape(old)
    for word in QUANTITIES.get(kind, ()):
        said = re.sub(rf"\b{word}\.{name}(?![\w])", f"{word}.{new}", said)
    if kind in ("joints", "drives") and re.search(r"[-+*/^(]", said):
        said = re.sub(rf"(?<![\w.]){name}(?![\w])", new, said)
    return said


def _kept_points(text: str, form: str, index: Places, joint: str) -> Iterator[Change]:
    """A joint without ``at`` that names its points by its name gets an ``at``; a band names each of its points."""
    keys = {path[2] for path in index if path[:2] == ("joints", joint) and len(path) == 3}
    if "links" in keys and not keys & {"at", "around"}:
        yield _with_at(text, form, index, joint, value_text(joint, form))


def _joints_at(text: str, form: str, index: Places, link: str, old: str, new: str) -> Iterator[Change]:
    """Joints of a link at its point, which is one name on both links or the joint's name."""
    for path in index:
        if len(path) != 2 or (*path, "links", 0) not in index or (*path, "around") in index:
            continue
        ends = [_word(text, index[*path, "links", n]) for n in (0, 1)]
        at = index.get((*path, "at"))
        both = path[1] if at is None else _word(text, at) if at.form == "scalar" else None
        if link not in ends or both != old:
            continue
        words = value_text([new if end == link else old for end in ends], form)
        if at is None:
            yield _with_at(text, form, index, str(path[1]), words)
        else:
            yield Change(at.start, at.end, words)


def _with_at(text: str, form: str, index: Places, joint: str, said: str) -> Change:
    links = index["joints", joint, "links"]
    if form == "json":
        return Change(links.end, links.end, f', "at": {said}')
    if index["joints", joint].form == "flow":
        return Change(links.end, links.end, f", at{' =' if form == 'toml' else ':'} {said}")
    assert links.key is not None
    column = links.key[0] - text.rfind("\n", 0, links.key[0]) - 1
    head = "at = " if form == "toml" else "at: "
    end = f"{text}\n".index("\n", links.end)
    return Change(end, end, "\n" + " " * column + head + said)


def _of_link(text: str, index: Places, path: Path, link: str) -> bool:
    """True for a value that names a point of a link: a load's ``at``, one of a joint's list, a point's ``from``, an end
    of a member, the axis of a band's drum."""
    if _meant(path, "loads.*.at") or _meant(path, "answers.#.at"):
        on = index.get((*path[:-1], "on"))
        return on is not None and _word(text, on) == link
    if _meant(path, "joints.*.at.#"):
        return _word(text, index[*path[:2], "links", path[-1]]) == link
    if _meant(path, "joints.*.around"):
        return _word(text, index[*path[:2], "links", 0]) == link
    inside = path[-1] in ("from", "about") or bool({"between", "members"} & {*path})
    return path[:2] == ("links", link) and inside


def _meant(path: Path, pattern: str) -> bool:
    parts = pattern.split(".")
    return len(parts) == len(path) and all(
        part == "*" or (part == "#" and isinstance(key, int)) or part == key
        for part, key in zip(parts, path, strict=True)
    )


def _word(text: str, place: TextSpan) -> str:
    return text[place.start : place.end].strip("'\"")


def _key(form: str, place: TextSpan, new: str) -> Change:
    assert place.key is not None
    return Change(*place.key, value_text(new, form) if form != "toml" else new)


def _value(text: str, form: str, place: TextSpan, new: str) -> Change:
    return Change(place.start, place.end, value_text(new, form, text[place.start]))
