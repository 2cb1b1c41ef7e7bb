"""Gestures that change what is drawn: move, pose, values, names, and what is taken out."""

from __future__ import annotations

import math
import re
from typing import Annotated, Literal

from pydantic import Field

from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.model.files.model_files import loads
from dalembert.model.files.rewriting import text_of
from dalembert.model.files.source import Path
from dalembert.model.files.splicing import REMOVED
from dalembert.model.files.yaml_text import read
from dalembert.studio.editing.draft import STILL, Draft, End, Point
from dalembert.studio.editing.drawing_gestures import rooted, snapped
from dalembert.studio.editing.entries import remove
from dalembert.studio.editing.gesture import Coordinate, Gesture, Place, Text
from dalembert.studio.editing.references import rename, rename_point
from dalembert.units import quantity

HOLDING = ("pin", "weld", "slot", "slider")
"""Joints whose points move together."""
NUMBER_WITH_UNIT = re.compile(r"\s*[-+\d.eE]+\s*([^\W\d_]+|°)\s*")


class Move(Gesture):
    """A point moved to a place with all points that joints hold at it. A bar stays a bar: its length changes, and its
    angle."""

    op: Literal["move"]
    link: Text
    point: Text
    to: Place

    def apply(self, d: Draft) -> None:
        to = snapped(d, self.to)
        values: dict[Path, object] = {}
        poses: dict[str, tuple[float, float, float]] = {}
        for end in cluster(d, (self.link, self.point)):
            move_end(d, end, to, values, poses)
        d.splice(values)
        for link, pose in poses.items():
            d.assemble(link, *pose, joined=_joined(d, link))
        repose_drives(d, poses)


class PoseLinks(Gesture):
    """The pose that the mouse left: angles of links in ``assembly``, and the positions of drives of one number. Links
    that did not move change nothing."""

    op: Literal["pose"]
    links: Annotated[dict[Text, tuple[Coordinate, Coordinate, Coordinate]], Field(max_length=200)]
    drives: Annotated[dict[Text, Coordinate], Field(default_factory=dict, max_length=50)]

    def apply(self, d: Draft) -> None:
        if not any(self._moved(d, link) for link in self.links):
            return
        for link, (x, y, angle) in self.links.items():
            if link in d.entries("links") and link != GROUND:
                d.assemble(link, x, y, angle, _joined(d, link))
        for drive, position in self.drives.items():
            keys = d.entries("drives").get(drive) or {}
            written = keys.get("position")
            slides = joint_type(d, drive) == "slider" or keys.get("freedom") == "slide" or "cylinder" in keys
            kind = "length" if slides else "angle"
            text: object = d.number(position, kind, 6) if slides else d.angle_text(position)
            if isinstance(written, str) and (unit := NUMBER_WITH_UNIT.fullmatch(written)):
                d.splice({("drives", drive, "position"): d.with_unit(position, kind, unit[1])})
            elif is_number(written):
                d.splice({("drives", drive, "position"): text})

    def _moved(self, d: Draft, link: str) -> bool:
        """True if a link is elsewhere than it was drawn."""
        x, y, angle = self.links[link]
        if link not in d.placed:
            return True
        u, v, before = d.placed[link]
        return (
            math.hypot(x - u, y - v) > STILL * d.width
            or abs(math.remainder(angle - before, math.tau)) > STILL
        )


def _joined(d: Draft, link: str) -> bool:
    """True if the angle of a link is enough: joints lead from it to the ground, and its place is not stated."""
    return rooted(d, link) and not isinstance(d.entries("assembly").get(link), list)


class SetValue(Gesture):
    """A value of the file as it was typed, in the file's units or with a unit."""

    op: Literal["set"]
    path: Annotated[tuple[Text | int, ...], Field(min_length=1, max_length=8)]
    value: Annotated[str, Field(max_length=4000)] | float | bool | None

    def apply(self, d: Draft) -> None:
        value: object = self.value
        if isinstance(value, str):
            value = number_or_text(value)
        if value is None or value == "":
            value = REMOVED
        d.splice({tuple(self.path): value})


class Length(Gesture):
    """The length of a bar."""

    op: Literal["length"]
    link: Text
    value: Text

    def apply(self, d: Draft) -> None:
        ends = [end for end in d.ends() if end[0] == self.link]
        if len(ends) != 2 or d.points[ends[0]] != (0.0, 0.0):
            raise ModelError(f"{self.link!r} is not a bar", "change its points instead")
        long = d.size(self.value, "length")
        if not long > 0:
            raise ModelError(f"a length of {self.value} is not possible", "give a length greater than 0")
        x, y = d.points[ends[1]]
        far = math.hypot(x, y) or 1.0
        point = [d.number(long * x / far), 0 if y == 0 else d.number(long * y / far)]
        d.splice({("links", self.link, "points", ends[1][1]): point})


class PageChanges(Gesture):
    """Numbers that the page changed, SI by path."""

    op: Literal["changes"]
    values: Annotated[dict[Text, float], Field(max_length=500)]

    def apply(self, d: Draft) -> None:
        from dalembert.pages.saved_text import with_changed_numbers  # a tenth of the studio's start

        m = loads(d.text, d.form)
        values = {path: _short(d, path, x) for path, x in self.values.items()}
        d.text = text_of(with_changed_numbers(m, values), d.form)


class Rename(Gesture):
    """Another name for a link, joint, load or drive, or (``link`` given) for a point of a link."""

    op: Literal["rename"]
    kind: Literal["links", "joints", "loads", "drives", "points"]
    name: Text
    to: Annotated[str, Field(min_length=1, max_length=60, pattern=r"^[^\W\d][\w-]*$")]
    link: Text = ""

    def apply(self, d: Draft) -> None:
        if self.kind == "points":
            d.text = rename_point(d.text, d.form, self.link, self.name, self.to)
        elif self.name == GROUND:
            raise ModelError("ground is the name of the fixed link", "rename another link")
        else:
            drive = d.entries("drives").get(self.name) if self.kind == "drives" else None
            if drive and self.name in d.entries("joints") and "joint" not in drive:
                d.splice(
                    {("drives", self.name, "joint"): self.name}
                )  # a drive without it has its joint's name
            d.text = rename(d.text, d.form, self.kind, self.name, self.to)


class Delete(Gesture):
    """A link, joint, drive, load or point taken out with all that needs it."""

    op: Literal["delete"]
    kind: Literal["links", "joints", "drives", "loads", "points"]
    name: Text
    link: Text = ""

    def apply(self, d: Draft) -> None:
        if self.kind == "points":
            self._point(d)
            return
        if self.name == GROUND:
            raise ModelError("the ground stays", "delete its points")
        d.text = remove(d.text, d.form, d.tree, self.kind, self.name)

    def _point(self, d: Draft) -> None:
        if not d.has_point(self.link, self.name):
            raise ModelError(
                f"link {self.link!r} has no point {self.name!r}", "choose a point of the drawing"
            )
        for joint, (i, j) in joint_ends(d).items():
            if (self.link, self.name) in (i, j):
                d.text = remove(d.text, d.form, d.tree, "joints", joint)
        for load, part in list(d.entries("loads").items()):
            between = [str(end) for end in part.get("between") or ()]
            at = (part.get("on"), part.get("at")) == (self.link, self.name)
            if at or f"{self.link}.{self.name}" in between:
                d.text = remove(d.text, d.form, d.tree, "loads", load)
        d.splice({("links", self.link, "points", self.name): REMOVED})


def _short(d: Draft, path: str, x: float) -> float:
    """A number that was dragged, to seven figures in the file's unit; one that was typed as it is."""
    length = ".points." in path or ".center." in path
    kind = (
        "length" if length else "angle" if path.startswith("assembly.") or path.endswith("direction") else ""
    )
    size = quantity(1.0, kind, d.units) if kind else 1.0
    y = x / size
    if abs(float(f"{y:.10g}") - y) <= 1e-14 * abs(y):
        return x
    rounded = float(f"{y:.7g}")
    return quantity(rounded, kind, d.units) if kind else rounded


def joint_ends(d: Draft) -> dict[str, tuple[End, End]]:
    """Joint -> its two links with their points."""
    out: dict[str, tuple[End, End]] = {}
    for name, joint in d.entries("joints").items():
        links, at = list(joint.get("links") or []), joint.get("at", name)
        if len(links) == 2:
            first, second = [at, at] if isinstance(at, str) else list(at)
            out[name] = ((links[0], first), (links[1], second))
    return out


def joint_type(d: Draft, drive: str) -> str:
    """Type of the joint that a drive moves."""
    name = (d.entries("drives").get(drive) or {}).get("joint", drive)
    return str((d.entries("joints").get(name) or {}).get("type", ""))


def cluster(d: Draft, end: End) -> list[End]:
    """A point and all that joints hold at its place."""
    d.world(end)
    one, joints = [end], joint_ends(d)
    for here in one:
        for name, (i, j) in joints.items():
            if d.entries("joints")[name].get("type") not in HOLDING or here not in (i, j):
                continue
            other = j if here == i else i
            near = math.dist(d.world(other), d.world(here)) < 1e-6 * d.width
            if other not in one and near:
                one.append(other)
    return one


def move_end(
    d: Draft, end: End, to: Point, values: dict[Path, object], poses: dict[str, tuple[float, float, float]]
) -> None:
    """A point of a link brought to a place: a bar is turned and made longer, any other link keeps its pose."""
    link, point = end
    ends = [other for other in d.ends() if other[0] == link]
    written = ((d.entries("links").get(link) or {}).get("points") or {}).get(point)
    if not (isinstance(written, list) and all(is_number(x) for x in written)):
        raise ModelError(
            f"point {point!r} of {link!r} is an expression", "change its parameters, or its text"
        )
    bar = len(ends) == 2 and link != GROUND and all(abs(d.points[e][1]) < 1e-12 for e in ends)
    if len(ends) == 1 and link != GROUND and d.points[end] == (0.0, 0.0):
        poses[link] = (*to, d.placed.get(link, (0.0, 0.0, 0.0))[2])
    elif bar and d.points[ends[0]] == (0.0, 0.0) and d.points[ends[1]][0] > 0:
        other = d.world(ends[1] if end == ends[0] else ends[0])
        a, b = (to, other) if end == ends[0] else (other, to)
        long = math.dist(a, b)
        if not long > STILL * d.width:
            raise ModelError("a bar needs two ends that are apart", "move the point elsewhere")
        values["links", link, "points", ends[1][1]] = [d.number(long, "length", 8), 0]
        poses[link] = (*a, math.atan2(b[1] - a[1], b[0] - a[0]))
    else:
        values["links", link, "points", point] = d.vector(d.local(link, to))


def repose_drives(d: Draft, poses: dict[str, tuple[float, float, float]]) -> None:
    """Drives of pins that are at one position follow the links that were turned."""
    for drive, part in d.entries("drives").items():
        joint = d.entries("joints").get((part or {}).get("joint", drive)) or {}
        links = joint.get("links") or ()
        if joint.get("type") != "pin" or not set(links) & set(poses) or not is_number(part.get("position")):
            continue
        first, second = ((poses.get(k) or d.placed.get(k, (0.0, 0.0, 0.0)))[2] for k in links)
        d.splice({("drives", drive, "position"): d.angle_text(second - first)})


def is_number(x: object) -> bool:
    """True for a bare number of a file."""
    return isinstance(x, (int, float)) and not isinstance(x, bool)


def number_or_text(text: str) -> object:
    """A typed value as a file says it: numbers bare, `1,5` as 1.5, vectors as lists, `{...}` as in the file.

    >>> number_or_text("[1,5, 2 mm]"), number_or_text("{from: 0, to: 90, count: 10}")
    ([1.5, '2 mm'], {'from': 0, 'to': 90, 'count': 10})
    """
    typed = text.strip()
    text = re.sub(r"(?<=\d),(?=\d)", ".", typed)
    parts = re.fullmatch(r"\[\s*([^\[\],;]+)[,;]\s*([^\[\],;]+)\]", text)
    if parts:
        return [number_or_text(part) for part in parts.groups()]
    if typed[:1] in ("{", "["):
        return read(typed)[0]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text, text)
