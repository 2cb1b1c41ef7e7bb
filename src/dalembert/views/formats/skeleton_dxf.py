"""The skeleton of a mechanism at one position as DXF, 1:1 in the file's unit of length, one layer per link.

For sketches in CAD programs: lines between a link's points, its points, joints by name, slides as lines.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.friction.bearing_ends import bearing_axis
from dalembert.analysis.methods.applied_forces import joint_place, link_place, slide_direction
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.position_lookup import PositionChoice, position_at
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.link_axes import in_space
from dalembert.model import GROUND
from dalembert.saving import new_file

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

UNITS = {"in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6}
"""Unit of length -> its number in DXF ($INSUNITS)."""
JOINTS, SLIDES = "joints", "slides"
FORBIDDEN = re.compile(r'[<>/\\":;?*|=`,\x00-\x1f]')
TEXT = 0.02
"""Height of letters over the size of the mechanism."""


@dataclass(frozen=True)
class Skeleton:
    """Places (3,) in metres: ``points`` and ``lines`` of each link, ``joints`` by name, ``slides`` as lines; ``unit``
    of the file, ``size`` of it in metres."""

    points: dict[str, dict[str, Array]]
    lines: dict[str, list[tuple[Array, Array]]]
    joints: dict[str, Array]
    slides: dict[str, tuple[Array, Array]]
    unit: str
    size: float
    space: bool = field(default=False)

    def save(self, path: str | os.PathLike[str], overwrite: bool = False) -> None:
        """Write it as .dxf; raises ModelError for another ending."""
        if Path(path).suffix.lower() != ".dxf":
            raise ModelError(f"{Path(path).name}: a skeleton is a DXF file", "end its name in .dxf")
        with new_file(path, overwrite) as temporary:
            self._document().saveas(temporary)

    @property
    def extent(self) -> float:
        """Largest distance of two of its points along an axis, m."""
        some = np.array([p for named in self.points.values() for p in named.values()] or [np.zeros(3)])
        return float(np.ptp(some, axis=0).max()) or 1.0

    def layers(self) -> dict[str, str]:
        """Link -> layer: its name, with _ for signs that DXF forbids."""
        out: dict[str, str] = {}
        for link in self.points:
            name = FORBIDDEN.sub("_", link) or "_"
            while name.lower() in {JOINTS, SLIDES, "0", *(other.lower() for other in out.values())}:
                name += "_"
            out[link] = name
        return out

    def _document(self) -> Any:
        import ezdxf

        document = ezdxf.new("R2010", setup=True)
        document.units = UNITS.get(self.unit, UNITS["m"])
        space, layers = document.modelspace(), self.layers()
        for k, layer in enumerate(layers.values()):
            document.layers.add(layer, color=1 + k % 6)
        for layer in (JOINTS, SLIDES):
            document.layers.add(layer, color=8)

        def at(p: Array) -> tuple[float, ...]:
            x, y, z = (round(float(v) / self.size, 9) + 0.0 for v in p)
            return (x, y, z)

        for link, layer in layers.items():
            for a, b in self.lines[link]:
                space.add_line(at(a), at(b), dxfattribs={"layer": layer})
            for p in self.points[link].values():
                space.add_point(at(p), dxfattribs={"layer": layer})
        height = TEXT * self.extent / self.size
        for name, p in self.joints.items():
            space.add_point(at(p), dxfattribs={"layer": JOINTS})
            text = space.add_text(name, height=height, dxfattribs={"layer": JOINTS})
            text.set_placement(at(p + TEXT / 2 * self.extent * np.array([1.0, 1.0, 0.0])))
        for a, b in self.slides.values():
            space.add_line(at(a), at(b), dxfattribs={"layer": SLIDES, "linetype": "CENTER"})
        return document


def skeleton(r: Result, at: PositionChoice = None) -> Skeleton:
    """The skeleton at a position, the first solved one by default: ``skeleton(r).save("press.dxf")``.

    A link's lines are its `members`; else they join the places of its joints, closed where there are three or more.

    >>> import dalembert as da
    >>> bones = da.draw.skeleton(da.kinematics(da.four_bar()))
    >>> sorted(bones.lines), len(bones.lines["coupler"]), sorted(bones.joints)
    (['coupler', 'crank', 'ground', 'rocker'], 1, ['A', 'B', 'O2', 'O4'])
    """
    k, m = position_at(r, at), r.mechanism
    points, lines = {}, {}
    for link in (*r.links, GROUND):
        points[link] = {n: _place(r, link, u, k) for n, u in m.points(link).items()}
        lines[link] = list(_lines(r, link, points[link], k))
    joints = {name: in_space(joint_place(r, name)[k]) for name in r.joints}
    to = Printed(m.units)
    unit = to.text("length")
    size = 1 / float(to("length", 1.0)) if unit in UNITS else 1.0
    out = Skeleton(points, lines, joints, {}, unit if unit in UNITS else "m", size, m.dimension == 3)
    half = 0.25 * out.extent
    for name, direction in _slides(r, k):
        out.slides[name] = (joints[name] - half * direction, joints[name] + half * direction)
    return out


def _place(r: Result, link: str, u: Any, k: int) -> Array:
    return in_space(link_place(r, link, u)[k])


def _lines(r: Result, link: str, named: dict[str, Array], k: int) -> Iterator[tuple[Array, Array]]:
    """Lines of a link: its members, or between its joints' places; the ground has none."""
    m = r.mechanism
    if link == GROUND:
        return
    members = m.links[link].members
    if members:
        for a, b in members:
            if {a, b} <= named.keys():
                yield named[a], named[b]
        return
    corners: list[Array] = []
    for name, joint in m.joints.items():
        for end, u in zip(joint.links, m.joint_points(name), strict=True):
            place = _place(r, end, u, k)
            if end == link and not any(np.allclose(place, p, rtol=0, atol=1e-12) for p in corners):
                corners.append(place)
    corners = corners if len(corners) > 1 else [*named.values()]
    if len(corners) < 2:
        return
    arms = np.array(corners) - corners[0]
    t = arms[np.argmax(np.linalg.norm(arms, axis=1))]
    on_line = np.linalg.matrix_rank(arms, tol=1e-9 * np.linalg.norm(t)) < 2
    if on_line:
        corners.sort(key=lambda p: float(p @ t))
    yield from pairwise(corners)
    if not on_line:
        yield corners[-1], corners[0]


def _slides(r: Result, k: int) -> Iterator[tuple[str, Array]]:
    """Joints that slide along a straight line, with its direction (3,)."""
    for name, joint in r.mechanism.joints.items():
        if r.mechanism.dimension == 3:
            if joint.pair.slides == "x":
                yield name, np.asarray(bearing_axis(r, name)[k])
        elif "slide" in joint.freedoms and hasattr(joint, "direction"):
            yield name, in_space(slide_direction(r, name)[k])
