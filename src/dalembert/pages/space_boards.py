"""What a page shows of a mechanism in space: the same as of one in the plane, seen through a camera that turns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, joint_place, magnitude
from dalembert.analysis.output.columns import drive_kinds, load_kind
from dalembert.analysis.result.result import Result
from dalembert.arrays import Numeric, Tree
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES, PAIRS
from dalembert.pages.boards import Boards
from dalembert.pages.mechanism_items import Items
from dalembert.pages.rows import Rows
from dalembert.views.paper.frame import Frame, force_scale
from dalembert.views.plane.mechanism_view import is_drawn, role_of, unit_size
from dalembert.views.plane.outline import load_places
from dalembert.views.symbols import plane_symbols

SHAPES = {
    **dict.fromkeys(("revolute", "cylindrical", "screw", "slotted_cylinder"), "round"),
    "prismatic": "block",
}
"""Pairs drawn along their axis, as a cylinder or a block; all others are balls."""


class SpaceItems(Items):
    """Links as bars and plates between their points, pairs as cylinders, blocks and balls along their axes."""

    def corners(self, link: str) -> list[list[int]]:
        """Rows of a link's joints and of the points that carry loads, each once."""
        m, points = self.mechanism, list[list[int]]()
        for name, joint in m.joints.items():
            for end, u in zip(joint.links, m.joint_points(name), strict=True):
                if end == link:
                    points.append(self.rows.place(link, u))
        points += [self.rows.place(link, u) for u in load_places(m, link).values()]
        return [list(p) for p in dict.fromkeys(map(tuple, points))]

    def link(self, link: str) -> list[Tree]:
        points = self.corners(link)
        if len(points) == 1 and self.known.mechanism.mass(link):
            points.append(self.rows.place(link, self.mechanism.center(link)))
        self.roles |= {"link-area"}
        return [self.path("hull", "link", points, link=link)]

    def joint(self, name: str, link: str | None = None) -> list[Tree]:
        """A pair along its main axis."""
        joint: Any = self.mechanism.joints[name]
        self.roles |= {"block", "support", "pin"}
        pair = PAIRS.get(joint.type)
        shape = SHAPES.get(joint.type, "ball")
        axis = self.r.joint_axes(name)[0] if pair is not None else np.eye(3)
        main = axis[AXES.index("z" if joint.wheels else pair.main if pair is not None else "z")]
        at = self.rows.vector(joint_place(self.r, name)[0]) if joint.wheels else self.at(name)
        fixed = link is None and GROUND in joint.links
        return [{"t": "pair", "shape": shape, "p": at, "e": self.rows.vector(main), "fixed": fixed}]

    def center(self, link: str) -> list[Tree]:
        if not self.known.mechanism.mass(link):
            return []
        at = self.rows.place(link, self.mechanism.center(link))
        return [self.symbol(plane_symbols.mass_center((0, 0)), at)]


class SpaceBoards(Boards):
    """All that is shown of one mechanism in space; points, forces and couples have three rows."""

    def __init__(self, known: Result, rows: Rows, actions: Sequence[Action]) -> None:
        super().__init__(known, rows, actions, SpaceItems(rows.r, known, rows, Frame(1e-3)))

    def mechanism(self) -> Tree:
        d = self.items
        parts = [*d.traces(), *(x for n in self.known.links for x in d.link(n)), *d.spans()]
        parts += [x for n in self.known.joints for x in d.joint(n)]
        parts += [x for n in self.known.links for x in d.center(n)]
        mine = [k for k, a in enumerate(self.numbered) if self._drawn_once(a)]
        arrows = [x for k in mine for x in self.arrows(k)]
        names = self._names()
        return {
            "per_mm": 1e-3,
            "items": parts,
            "labels": names,
            "arrows": arrows,
            "force": self.scale(22.0, mine),
        }

    def _drawn_once(self, a: Action) -> bool:
        if a.kind == "joint":
            return a.link == self.known.mechanism.joints[a.of].links[1]
        return is_drawn(self.known, a)

    def _free_body(self, link: str) -> Tree:
        d, m = self.items, self.known.mechanism
        own = [n for n in self.known.joints if link in m.joints[n].links]
        labels: list[Tree] = [{"text": n, "p": d.at(n), "role": "title", "kind": "joint"} for n in own]
        mine = [k for k, a in enumerate(self.actions) if a.link == link]
        return {
            "link": link,
            "title": f"Link {self.shown.heading(link)}",
            "member": "",
            "per_mm": 1e-3,
            "about": d.corners(link),
            "items": [*d.link(link), *(x for n in own for x in d.joint(n, link)), *d.center(link)],
            "labels": labels,
            "arrows": [x for k in mine for x in self.arrows(k)],
            "force": self.scale(26.0),
            "equations": self._equations(link, mine, own),
        }

    def _equations(self, link: str, mine: Sequence[int], own: Sequence[str]) -> Tree:
        at = joint_place(self.rows.r, own[0])[0] if own else self.rows.r.center(link)[0]
        terms = []
        for k in mine:
            a = self.actions[k]
            if self._has(a.force[0]) or self._has(a.couple[0]):
                moment = a.couple[0] + np.cross(a.at[0] - at, a.force[0])
                turning = not self._has(a.force[0])
                named = self.shown.turning_symbol if turning else self.shown.symbol
                sign = named(self.numbered[k])
                terms.append({"name": sign, "f": self.rows.vector(a.force[0]), "m": self.rows.vector(moment)})
        return {"about": own[0] if own else "G", "terms": terms}

    def arrows(self, k: int, tangent: bool = False) -> list[Tree]:
        """Force and couple of an action; a couple is an arrow with two heads along its axis."""
        a, real, out = self.actions[k], self.numbered[k], list[Tree]()
        role = role_of(a.kind)
        self.items.roles.add(role)
        place = self.rows.vector(a.at[0])
        base: Tree = {"role": role, "of": a.of, "kind": a.kind, "link": a.link, "p": place}
        sizes = [float(np.nanmax(np.abs(x), initial=0.0)) for x in (real.force, real.couple)]
        if self._has(a.force[0]) and (sizes[0] > 0 or a.kind == "joint"):
            out.append(
                {"t": "force", "f": self.rows.vector(a.force[0]), "name": self.shown.symbol(real)} | base
            )
        if self._has(a.couple[0]) and sizes[1] > 1e-12 * max(1.0, sizes[0]):
            sign = self.shown.turning_symbol(real)
            out.append({"t": "moment", "f": self.rows.vector(a.couple[0]), "name": sign} | base)
        return out

    def scale(self, longest: float, some: Sequence[int] | None = None) -> float:
        with np.errstate(all="ignore"):
            sizes = [float(np.nanmax(magnitude(a.force), initial=0.0)) for a in self.numbered]
        sizes = sizes if some is None else [sizes[k] for k in some]
        return force_scale(sizes, longest, unit_size(self.known, "force"))

    def polygons(self) -> list[Tree]:
        """None: forces in space do not lie in a paper."""
        return []

    def charts(self) -> list[Tree]:
        return [
            chart | {"curves": [{key: x for key, x in c.items() if key != "f"} for c in chart["curves"]]}
            for chart in super().charts()
        ]

    def _force(self, k: int) -> Numeric:
        x, y, z = self.rows.r.force_array[0, k]
        return (x * x + y * y + z * z).sqrt()

    def table(self) -> list[Tree]:
        s, r, out = self.rows.r, self.known, list[Tree]()

        def add(name: str, kind: str, rows: Any) -> None:
            out.append({"name": name, "kind": kind, "rows": self.rows.vector(list(np.ravel(rows)))})

        for drive in r.drives:
            add(f"effort of {drive}", drive_kinds(r, drive)["effort"], s.effort(drive)[0])
        for name in r.unknown_loads:
            add(name, load_kind(r, name), s.unknown_load(name)[0])
        for k, joint in enumerate(r.joints):
            j = r.mechanism.joints[joint].links[1]
            add(f"{self.shown.reaction(joint, j)} in {joint}", "force", s.force_array[0, k])
            if self._has(s.moment_array[0, k]):
                add(f"{self.shown.joint_moment(joint, j)} in {joint}", "moment", s.moment_array[0, k])
        for k, link in enumerate(r.links):
            if s.inertia:
                add(f"speed of {self.shown.heading(link)}", "angular_speed", s.twist_array[0, k, 3:])
        return out
