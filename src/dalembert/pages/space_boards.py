"""Contents of a page on a mechanism in space: as in the plane, seen through a rotatable camera."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, joint_place
from dalembert.analysis.result.result import Result
from dalembert.arrays import Tree
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES, PAIRS
from dalembert.pages.boards import Boards
from dalembert.pages.mechanism_items import Items
from dalembert.pages.rows import NodeRows
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.plane.outline import load_places
from dalembert.views.space.solids import circle
from dalembert.views.symbols.joint_solids import wheel_sizes

SHAPES = {
    **dict.fromkeys(("revolute", "cylindrical", "screw", "slotted_cylinder"), "round"),
    "prismatic": "block",
}
"""Pairs drawn along their axis, as a cylinder or a block; all others are balls."""


class SpaceItems(Items):
    """Links as bars and plates between their points, pairs as cylinders, blocks and balls along their axes."""

    def outline(self, link: str) -> list[list[int]]:
        """Rows of a link's joints and of the points that carry loads."""
        m, points = self.mechanism, list[list[int]]()
        for name, joint in m.joints.items():
            for end, u in zip(joint.links, m.joint_points(name), strict=True):
                if end == link:
                    points.append(self.rows.place(link, u))
        return points + [self.rows.place(link, u) for u in load_places(m, link).values()]

    def joint(self, name: str, link: str | None = None) -> list[Tree]:
        """A pair along its main axis."""
        joint: Any = self.mechanism.joints[name]
        self.roles |= {"block", "support", "pin"}
        pair = PAIRS.get(joint.type)
        shape = SHAPES.get(joint.type, "ball")
        axis = self.r.joint_axes(name)[0] if pair is not None else np.eye(3)
        main = axis[AXES.index("z" if joint.wheels else pair.main if pair is not None else "z")]
        at = self.rows.vector(joint_place(self.r, name)[0]) if joint.wheels else self.at(name)
        if joint.wheels:
            return self._wheels(name, link)
        fixed = link is None and GROUND in joint.links
        return [{"t": "pair", "shape": shape, "p": at, "e": self.rows.vector(main), "fixed": fixed}]

    def _wheels(self, name: str, link: str | None) -> list[Tree]:
        """The wheels of a joint to scale, each with a spoke that shows its turn."""
        self.roles |= {"link-area", "link"}
        out = list[Tree]()
        for on, center, axis, radius, half in wheel_sizes(self.known, name, self.frame.per_mm):
            if link not in (None, on):
                continue
            at, along = self.rows.place(on, center.tolist()), self.rows.along(on, axis.tolist())
            wheel = {"t": "pair", "shape": "round", "p": at, "e": along, "fixed": False}
            out.append(wheel | {"size": [radius, half]})
            rim = circle(center, axis, radius)[0]
            out.append(self.path("path", "link", [at, self.rows.place(on, rim.tolist())]))
        return out

    def circle_radius(self, name: str) -> Any:
        """None: in space no friction circle is drawn."""
        return None


class SpaceBoards(Boards):
    """Complete contents for one mechanism in space; points, forces and couples have three rows.

    A couple is an arrow with two heads along its axis.
    """

    def __init__(self, known: Result, rows: NodeRows, actions: Sequence[Action]) -> None:
        super().__init__(known, rows, actions, SpaceItems(rows.r, known, rows, PaperFrame(1e-3)))

    def _size(self, link: str) -> float:
        return self.frame.per_mm

    def polygons(self) -> Tree:
        """None: forces in space are not in one plane of paper."""
        return {"links": [], "chain": []}
