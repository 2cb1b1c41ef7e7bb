"""Wheels that mesh or roll, belts and ropes, as items that follow the kernel's rows: strands, arcs on the wheels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place, link_place
from dalembert.analysis.methods.elements.belt_strands import left_of_tangent
from dalembert.arrays import Numeric, Tree
from dalembert.views.plane.outline import wheel_paths
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism
    from dalembert.pages.rows import NodeRows
    from dalembert.pages.symbolic_result import SymbolicResult
    from dalembert.views.paper.frame import PaperFrame
    from dalembert.views.paper.scene import Item


class Drawer(Protocol):
    """Drawing of the parts of a mechanism: ``r`` in nodes, ``known`` the same in the file's numbers."""

    r: SymbolicResult
    known: Result
    rows: NodeRows
    frame: PaperFrame

    @property
    def mechanism(self) -> Mechanism: ...

    def symbol(
        self, items: Sequence[Item], at: list[int], along: list[int] | None = None, sized: bool = False
    ) -> Tree:
        """A symbol at a place, along a direction."""
        ...

    def path(self, kind: str, role: str, points: list[list[int]], **more: object) -> Tree:
        """A line through points."""
        ...


Ends = tuple[list[int], list[int]]
"""Rows of the points at which a strand touches the wheels of i and j."""


def wheels(d: Drawer, name: str, link: str | None) -> list[Tree]:
    """The pitch circles of a joint, on both links or on one; what a wheel rolls on, if it is a line."""
    out = []
    points = dict(zip(d.mechanism.joints[name].links, d.mechanism.joint_points(name), strict=True))
    for on, _, radius in wheel_paths(d.known, name, d.known.mechanism.joints[name])[::-1]:
        if link in (None, on):
            wheel = plane_symbols.wheel((0, 0), d.frame.length(radius), 0.0)
            out.append(d.symbol(wheel, d.rows.place(on, points[on]), d.rows.axis(on), sized=True))
    if d.mechanism.joints[name].wheels == 1 and link is None:
        at = d.rows.vector(joint_place(d.r, name)[0])
        out.append(d.symbol(plane_symbols.hatch((0, 0), 0.0, 22.0), at, d.rows.direction(name)))
    return out


def belt(d: Drawer, name: str, link: str | None) -> list[Tree]:
    """Both wheels, and on the complete mechanism both strands and the arcs on the wheels."""
    if link is not None:
        return wheels(d, name, link)
    joint: Any = d.mechanism.joints[name]
    ri, rj = joint.signed_radii
    left, right = (_tangent(d, name, side * ri, -side * rj) for side in (1.0, -1.0))
    i, j = _centers(d, name)
    return [
        *wheels(d, name, None),
        *(d.path("path", "link", list(ends)) for ends in (left, right)),
        d.path("arc", "link", [i, left[0], right[0]], ccw=True),
        d.path("arc", "link", [j, right[1], left[1]], ccw=not joint.crossed),
    ]


def strand(d: Drawer, name: str, link: str | None) -> list[Tree]:
    """A straight strand of a rope, the wheels at its ends, and the arc on the wheel at which it begins."""
    if link is not None:
        return wheels(d, name, link)
    joint: Any = d.known.mechanism.joints[name]
    mine, ends = _strands(d, joint.rope), _ends(d, name)
    k = mine.index(name)
    out = [*wheels(d, name, None), d.path("path", "link", list(ends))]
    if joint.radii[0] and (k or d.known.mechanism.ropes[joint.rope].RING):
        before = _ends(d, mine[k - 1])[1]
        out.append(d.path("arc", "link", [_centers(d, name)[0], before, ends[0]], ccw=joint.radii[0] < 0))
    return out


def _strands(d: Drawer, rope: str) -> list[str]:
    """The strands of a rope in their order."""
    joints = d.known.mechanism.joints.items()
    return [n for n, j in joints if j.WRAPPED and getattr(j, "rope", "") == rope]


def _centers(d: Drawer, name: str) -> list[list[int]]:
    """Rows of a joint's point on each link."""
    both = zip(d.mechanism.joints[name].links, d.mechanism.joint_points(name), strict=True)
    return [d.rows.place(on, u) for on, u in both]


def _ends(d: Drawer, name: str) -> Ends:
    """Points at which a strand of a rope touches its wheels; of one that is drawn parallel to others, beside them."""
    joint: Any = d.mechanism.joints[name]
    if joint.direction is None:
        return _tangent(d, name, *joint.radii)
    rope = d.known.rope(joint.rope)
    x, y = rope.direction[int(np.argmax(d.known.ok)), _strands(d, joint.rope).index(name)]
    both = zip(joint.links, d.mechanism.joint_points(name), joint.radii, strict=True)
    places = [link_place(d.r, on, u)[0] + np.array([-y * radius, x * radius]) for on, u, radius in both]
    return d.rows.vector(places[0]), d.rows.vector(places[1])


def _tangent(d: Drawer, name: str, ra: Numeric, rb: Numeric) -> Ends:
    """Points at which a line touches circles about a joint's points, on its left where a radius is positive."""
    joint = d.mechanism.joints[name]
    a, b = (
        link_place(d.r, on, u)[0] for on, u in zip(joint.links, d.mechanism.joint_points(name), strict=True)
    )
    left = left_of_tangent((b - a)[None], ra - rb)[0]
    return d.rows.vector(a + ra * left), d.rows.vector(b + rb * left)
