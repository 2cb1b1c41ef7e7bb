"""Given data as the teacher wrote them in the file: its angles, units and letters, `3 ∠ 30°`, `300 rpm`, `p·A`."""

from __future__ import annotations

import copy
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.unit_names import unit
from dalembert.units import NUMBER, file_units
from dalembert.views.notation import pretty

if TYPE_CHECKING:
    from dalembert.model import Mechanism


@lru_cache(maxsize=8)
def _base(text: str, form: str) -> Tree:
    from dalembert.model.files.model_files import read_text

    tree: Tree = read_text(text, form)[0]
    return tree


class AsWritten:
    """The texts of a model file, with the values that replace some of them; every method is empty where a value is not
    written in a form that a reader understands alone."""

    def __init__(self, m: Mechanism) -> None:
        self.units = file_units(m.units)
        source = m.source
        self.tree: Any = copy.deepcopy(_base(source.text, source.form)) if source and source.text else {}
        for path, value in m.changes.items():
            *parents, last = path.split(".")
            at = self._at(parents)
            if isinstance(at, list) and last.isdigit() and int(last) < len(at):
                at[int(last)] = value
            elif isinstance(at, dict):
                at[last] = value

    def _at(self, keys: list[str]) -> Any:
        at = self.tree
        for key in keys:
            if isinstance(at, list):
                at = at[int(key)] if key.isdigit() and int(key) < len(at) else None
            else:
                at = at.get(key) if isinstance(at, Mapping) else None
        return at

    def point(self, link: str, name: str) -> str:
        """A point by size and angle, perhaps from another point."""
        raw = self._at(["links", link, "points", name])
        if isinstance(raw, Mapping) and set(raw) == {"from", "at"}:
            words = "centre" if raw["from"] == "center" else str(raw["from"])
            return f"{polar} from {words}" if (polar := _polar(raw["at"])) else ""
        return _polar(raw)

    def center(self, link: str) -> str:
        """A mass centre by size and angle."""
        return _polar(self._at(["links", link, "center"]))

    def of_link(self, link: str, key: str, kind: str) -> str:
        """A mass or a moment of inertia with its unit, where it is a number."""
        raw = self._at(["links", link, key])
        return _with_unit(raw, self.units.text(kind))

    def by_letters(self) -> list[str]:
        """Loads whose values are expressions of parameters."""
        loads = self._at(["loads"])
        names = list(loads) if isinstance(loads, Mapping) else []
        raw = {name: self._at(["loads", name, "value"]) for name in names}
        return [
            name for name in names if raw[name] is not None and any(map(_is_expression, _parts(raw[name])))
        ]

    def drive(self, name: str, kinds: Mapping[str, str]) -> str:
        """Position, speed and acceleration of a drive, each of a kind, with the units of the file."""
        raw = self._at(["drives", name])
        rates = ("position", "speed", "acceleration")
        if not isinstance(raw, Mapping) or "position" not in raw or raw.keys() - set(rates):
            return ""
        parts = [_with_unit(raw[key], self.units.text(kinds[key])) for key in rates if key in raw]
        return ", ".join(parts) if all(parts) else ""

    def load(self, name: str) -> str:
        """A force by size and direction, or components; a couple; with the letters of its parameters."""
        raw = self._at(["loads", name])
        if not isinstance(raw, Mapping) or "value" not in raw:
            return ""
        kind = {"force": "force", "couple": "moment"}.get(str(raw.get("type")), "")
        if not kind:
            return ""
        name_of = self.units.text(kind)
        value = _polar(raw["value"], name_of)
        if not value and "direction" in raw:
            size, angle = _with_unit(raw["value"], name_of), _angle(raw["direction"])
            value = f"{size} ∠ {angle}" if size and angle else ""
        elif not value and any(map(_is_expression, _parts(raw["value"]))) and isinstance(raw["value"], list):
            value = f"({', '.join(_with_unit(part, '') for part in raw['value'])})"
        elif not value and kind == "moment":
            value = _with_unit(raw["value"], name_of)
        return f"{value} in link axes" if value and raw.get("axes") == "link" else value


def _with_unit(raw: object, plain: str) -> str:
    """A number with its unit, or with one where it has none; an expression with signs of multiplication."""
    if isinstance(raw, bool) or not isinstance(raw, (str, int, float)):
        return ""
    text = str(raw).strip()
    match = re.fullmatch(rf"({NUMBER})\s*(.*)", text)
    if match is None or (match[2] and not _is_unit(match[2])):
        return _expression(text) if re.search("[A-Za-z]", text) else ""
    name = match[2] or plain
    number = match[1].replace("-", "−")
    return number + ("°" if name == "deg" else f" {pretty(name)}" if name else "")


def _parts(raw: object) -> list[object]:
    return list(raw) if isinstance(raw, list) else [*str(raw).split("@")]


def _is_expression(raw: object) -> bool:
    """True for letters that are not a unit behind a number."""
    text = str(raw).strip()
    match = re.fullmatch(rf"({NUMBER})\s*(.*)", text)
    return bool(re.search("[A-Za-z]", text)) and (match is None or not _is_unit(match[2]))


def _expression(text: str) -> str:
    """An expression with signs of multiplication, powers of two and three, and π."""
    for pattern, sign in (
        (r"\s*\*\*\s*|\^", "^"),
        (r"\^2(?!\d)", "²"),
        (r"\^3(?!\d)", "³"),
        (r"\bpi\b", "π"),
    ):
        text = re.sub(pattern, sign, text)
    return re.sub(r"\s*\*\s*", "·", text).replace("-", "−")


def _is_unit(text: str) -> bool:
    try:
        unit(text)
    except ModelError:
        return False
    return True


def _angle(raw: object) -> str:
    text = _with_unit(raw, "deg")
    return text if text and not re.search("[A-Za-z]", text.removesuffix(" rad")) else ""


def _polar(raw: object, plain: str = "") -> str:
    """`3 @ 30` as `3 ∠ 30°`; empty for another form."""
    if not isinstance(raw, str) or raw.count("@") != 1:
        return ""
    size, angle = raw.split("@")
    first, second = _with_unit(size, plain), _angle(angle)
    return f"{first} ∠ {second}" if first and second else ""
