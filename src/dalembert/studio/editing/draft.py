"""A text under a gesture: its tree, its units, the pose that is drawn, and the changes that gestures are made of."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from copy import deepcopy
from itertools import count
from string import ascii_uppercase
from typing import Any

from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.model.files.model_files import read_text
from dalembert.model.files.source import Path
from dalembert.model.files.splicing import REMOVED, splice
from dalembert.studio.editing.entries import add_entries
from dalembert.studio.editing.sketch_pose import Placed
from dalembert.units import Units, file_units, quantity

Point = tuple[float, float]
End = tuple[str, str]
"""A link and its point."""

DIGITS = 4
"""Figures of a drawn length beside the width of the drawing."""
FINE = 12
"""Significant figures of typed numbers."""
STILL = 1e-7
"""Turn, and distance over the width of the drawing, below which a link has not moved and two places are one."""


class Draft:
    """The text of a plane mechanism while a gesture changes it. Places are in ground axes, m and rad."""

    def __init__(self, text: str, form: str, tree: Any, placed: Placed) -> None:
        self._text, self.form, self.tree = text, form, deepcopy(tree)
        self.placed: dict[str, tuple[float, float, float]] = {**placed, GROUND: (0.0, 0.0, 0.0)}
        self.points: dict[End, Point] = {}
        self.units: Units = file_units(self.tree.get("units") or {})
        self._new: dict[tuple[str, str], Any] = {}
        self._values: dict[Path, object] = {}
        if self.tree.get("copies"):
            raise ModelError(
                "a mechanism with copies is edited as text", "change the original or the copies in the text"
            )

    # text

    @property
    def text(self) -> str:
        """The text with all changes so far."""
        if self._values:
            self._text = splice(self._text, self.form, self._values)
        if self._new:
            self._text = add_entries(self._text, self.form, self._new)
        self._new, self._values = {}, {}
        return self._text

    @text.setter
    def text(self, text: str) -> None:
        self._text = text
        self.tree = read_text(text, self.form)[0]

    def put(self, section: str, name: str, value: object) -> None:
        """A new entry behind the others of its section."""
        if name in self.entries(section):
            raise ModelError(f"the name {name!r} is already used in {section}", "choose another name")
        if not self.tree.get(section):
            self.tree[section] = {}
        self._new[section, name] = self.tree[section][name] = value

    def splice(self, values: Mapping[Path, object]) -> None:
        """Values replaced, added or taken out."""
        for path, value in values.items():
            holder: Any = self.tree
            added, last = path[:2] in self._new, path[-1]
            for key in path[:-1]:
                if isinstance(holder, dict) and holder.get(key) is None:
                    holder[key] = {}
                holder = holder[key]
            if value is not REMOVED:
                if isinstance(holder, list) and last == len(holder):
                    holder.append(value)
                else:
                    holder[last] = value
            elif isinstance(holder, list) or last in holder:
                del holder[last]  # type: ignore[arg-type]
            if added and len(path) == 2:
                self._new[path] = value  # type: ignore[index]
            elif not added:
                self._values[path] = value

    def entries(self, section: str) -> dict[str, Any]:
        """A section of the tree; empty where the file has none."""
        return self.tree.get(section) or {}

    # names

    def letter(self, *taken: str) -> str:
        """A letter that is the name of no joint and no point."""
        used = {*self.entries("joints"), *self.entries("drives"), *self.entries("loads"), *taken}
        for link in self.entries("links").values():
            used |= set((link or {}).get("points") or {})
        letters = (a + (str(n) if n else "") for n in count() for a in ascii_uppercase)
        return next(name for name in letters if name not in used and name not in ("E", "N"))

    def numbered(self, section: str, stem: str, first: int) -> str:
        """A name with a number that is free in a section."""
        return next(name for n in count(first) if (name := f"{stem}{n}") not in self.entries(section))

    # numbers

    def size(self, text: str, kind: str) -> float:
        """SI value of a typed quantity; `1,5` is read as 1.5."""
        return quantity(re.sub(r"^(\s*[-+]?\d*),(\d+)", r"\1.\2", text), kind, self.units)

    def number(self, si: float, kind: str = "length", digits: int = FINE) -> float | int:
        """A bare number of the file's units."""
        x = float(f"{si / quantity(1.0, kind, self.units):.{digits}g}")
        return int(x) if x == int(x) and abs(x) < 1e12 else x

    def with_unit(self, si: float, kind: str, unit: str, digits: int = 6) -> str:
        """A number with a unit."""
        x = float(f"{si / quantity(f'1 {unit}', kind):.{digits}g}")
        return f"{int(x) if x == int(x) else x} {unit}"

    def drawn(self, si: float, width: float) -> float:
        """A length rounded to what the drawing shows, m."""
        step = 10.0 ** (math.floor(math.log10(max(width, 1e-9))) - DIGITS + 1) * self.unit_step
        return round(si / step) * step

    @property
    def unit_step(self) -> float:
        """The file's unit of length over a power of ten of a metre, so that rounded numbers are short in the file."""
        one = quantity(1.0, "length", self.units)
        return float(one / 10.0 ** math.floor(math.log10(one)))

    @property
    def width(self) -> float:
        """Width of the drawing, m; 0.1 m where there is none."""
        places = [self.world(end) for end in self.ends()]
        spans = [max(p[k] for p in places) - min(p[k] for p in places) for k in (0, 1)] if places else [0.0]
        return max(spans) or 0.1

    # places

    def ends(self) -> Iterator[End]:
        """Every point of every link."""
        for link, part in self.entries("links").items():
            for point in (part or {}).get("points") or {}:
                if (link, point) in self.points:
                    yield link, point

    def world(self, end: End) -> Point:
        """Place of a point of a link."""
        if end not in self.points:
            raise ModelError(f"link {end[0]!r} has no point {end[1]!r}", "choose a point of the drawing")
        x, y, angle = self.placed.get(end[0], (0.0, 0.0, 0.0))
        u, v = self.points[end]
        return x + u * math.cos(angle) - v * math.sin(angle), y + u * math.sin(angle) + v * math.cos(angle)

    def local(self, link: str, at: Point) -> Point:
        """A place in the axes of a link."""
        x, y, angle = self.placed.get(link, (0.0, 0.0, 0.0))
        dx, dy = at[0] - x, at[1] - y
        return dx * math.cos(angle) + dy * math.sin(angle), dy * math.cos(angle) - dx * math.sin(angle)

    def vector(self, at: Point, digits: int = 8) -> list[float | int]:
        """A vector of lengths in the file's units."""
        small = 1e-9 * max(self.width, abs(at[0]), abs(at[1]))
        return [0 if abs(x) < small else self.number(x, "length", digits) for x in at]

    def has_point(self, link: str, name: str) -> bool:
        """True if a link has a point of this name."""
        return name in ((self.entries("links").get(link) or {}).get("points") or {})

    def add_point(self, link: str, name: str, at: Point) -> None:
        """A point of a link at a place."""
        local = self.local(link, at)
        if (self.entries("links").get(link) or {}).get("points"):
            self.splice({("links", link, "points", name): self.vector(local)})
        else:
            self.splice({("links", link, "points"): {name: self.vector(local)}})
        self.points[link, name] = local

    def angle_text(self, angle: float) -> float | int:
        """An angle of the file to 0.001 deg."""
        turn = math.remainder(angle, 2 * math.pi)
        return self.number(math.radians(round(math.degrees(turn), 3)), "angle", 9)

    def assemble(self, link: str, x: float, y: float, angle: float, joined: bool) -> None:
        """The approximate pose of a link in the file: an angle, of one that is not joined its place too."""
        self.placed[link] = (x, y, angle)
        text = self.angle_text(angle)
        value: object = text if joined else [*self.vector((x, y), 6), text]
        if link in self.entries("assembly"):
            self.splice({("assembly", link): value})
        else:
            self.put("assembly", link, value)
