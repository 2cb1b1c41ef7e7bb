"""What a page shows, as data: the mechanism, free bodies with their equations, polygons, charts, a table.

A row is a place among the kernel's outputs. An arrow is a force (two rows) at a point (two rows) with its sign, a
couple a row at a point. The page draws them to the scale that stands beside them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, joint_place, whole_actions
from dalembert.analysis.methods.members import members
from dalembert.analysis.output.columns import drive_kinds, load_kind
from dalembert.analysis.result.result import Result
from dalembert.arrays import Numeric, Tree
from dalembert.kernel.graph import CONSTANT, Node
from dalembert.pages.mechanism_items import Items
from dalembert.pages.rows import Rows
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.frame import FINE, force_scale, round_up
from dalembert.views.plane.mechanism_view import is_drawn, role_of, unit_size, whole_frame

CURVES = 6
"""Roles of curves."""


class Boards:
    """All that is shown of one mechanism; ``actions`` in nodes."""

    def __init__(
        self, known: Result, rows: Rows, actions: Sequence[Action], items: Items | None = None
    ) -> None:
        self.known, self.rows, self.actions = known, rows, actions
        self.items = items or Items(rows.r, known, rows, whole_frame(known, 0, 120.0, 90.0))
        self.frame = self.items.frame
        self.shown = Shown(known, Notation())
        self.numbered = _numbered(known, actions)

    def mechanism(self) -> Tree:
        """The whole mechanism: loads, efforts, and the force of each joint on its j."""
        d, m = self.items, self.known.mechanism
        parts = [*d.traces(), *(x for n in self.known.links for x in d.link(n)), *d.spans()]
        parts += [x for n in sorted(self.known.joints, key=lambda n: m.joints[n].hinge) for x in d.joint(n)]
        parts += [x for n in self.known.links for x in d.center(n)] + d.circles(self.known.joints)
        mine = [k for k, a in enumerate(self.numbered) if self._drawn_once(a)]
        return {
            "per_mm": self.frame.per_mm,
            "middle": list(self.frame.middle),
            "items": parts,
            "labels": self._names(),
            "arrows": [x for k in mine for x in self.arrows(k)],
            "force": self.scale(22.0, mine),
        }

    def _drawn_once(self, a: Action) -> bool:
        if a.kind == "joint":
            return a.link == self.known.mechanism.joints[a.of].links[1]
        return is_drawn(self.known, a)

    def _names(self) -> list[Tree]:
        d = self.items
        out: list[Tree] = [
            {"text": name, "p": d.at(name), "role": "title", "kind": "joint"} for name in self.known.joints
        ]
        for link in self.known.links:
            corners = d.corners(link)
            if corners:
                text = {"text": self.shown.link(link), "role": "note", "kind": "link", "link": link}
                out.append(text | {"p": corners[0], "q": corners[min(1, len(corners) - 1)]})
        return out

    def free_bodies(self) -> list[Tree]:
        """Every link by itself, with what acts on it and its three equations."""
        return [self._free_body(link) for link in self.known.links]

    def _free_body(self, link: str) -> Tree:
        d, m = self.items, self.known.mechanism
        parts, labels = d.link(link), list[Tree]()
        own = [n for n in self.known.joints if link in m.joints[n].links]
        for name in own:
            parts += d.joint(name, link)
            u = self.rows.r.mechanism.joint_points(name)[m.joints[name].links.index(link)]
            labels.append({"text": name, "p": self.rows.place(link, u), "role": "title", "kind": "joint"})
        parts += d.center(link) + d.circles(own)
        mine = [k for k, a in enumerate(self.actions) if a.link == link]
        return {
            "link": link,
            "title": f"Link {self.shown.heading(link)}",
            "member": members(self.known)[link].kind,
            "per_mm": self._size(link),
            "about": d.corners(link),
            "items": parts,
            "labels": labels,
            "arrows": [x for k in mine for x in self.arrows(k, tangent=True)],
            "force": self.scale(26.0),
            "equations": self._equations(link, mine, own),
        }

    def _size(self, link: str) -> float:
        """Metres a millimetre of a free body, round in the reader's unit."""
        k = int(np.argmax(self.known.ok))
        from dalembert.views.plane.outline import link_points

        places = [*link_points(self.known, link, k).values(), tuple(self.known.center(link)[k])]
        span = float(np.ptp(np.array(places), axis=0).max())
        size = unit_size(self.known, "length")
        return round_up(max(span, 5 * self.frame.per_mm) / 46.0 / size, FINE) * size

    def _equations(self, link: str, mine: Sequence[int], own: Sequence[str]) -> Tree:
        """Sums of forces and of moments about the link's first joint, or its mass centre: a term for each action."""
        r = self.rows.r
        at = joint_place(r, own[0])[0] if own else r.center(link)[0]
        terms = list[Tree]()
        for k in mine:
            a = self.actions[k]
            if self._has(a.force[0]) or self._has(np.ravel(a.couple)[:1]):
                x, y = a.force[0]
                arm_x, arm_y = a.at[0] - at
                moment = np.ravel(a.couple)[0] + arm_x * y - arm_y * x
                turning = not self._has(a.force[0])
                sign = (
                    self.shown.turning_symbol(self.numbered[k])
                    if turning
                    else self.shown.symbol(self.numbered[k])
                )
                terms.append({"name": sign, "f": self.rows.vector((x, y)), "m": self.rows.of(moment)})
        return {"about": own[0] if own else "G", "terms": terms}

    def _has(self, values: Iterable[Numeric]) -> bool:
        """Whether something is not exactly zero, whatever the numbers."""
        return any((x.level != CONSTANT or x.value != 0) if isinstance(x, Node) else x != 0 for x in values)

    def arrows(self, k: int, tangent: bool = False) -> list[Tree]:
        """Force and couple of an action; ``tangent``: a pin's force on its friction circle, without the couple."""
        a, real, out = self.actions[k], self.numbered[k], list[Tree]()
        role = role_of(a.kind)
        self.items.roles.add(role)
        at, force, couple = a.at[0], a.force[0], np.ravel(a.couple)[0]
        if tangent and a.kind == "joint" and self.items.circle_radius(a.of) is not None:
            x, y = force
            arm = couple / (x * x + y * y)
            at, couple = (at[0] + arm * y, at[1] - arm * x), 0.0
        base: Tree = {"role": role, "of": a.of, "kind": a.kind, "link": a.link, "p": self.rows.vector(at)}
        largest = max(1.0, _largest(real.force))
        if self._has(force) and (_largest(real.force) > 0 or a.kind == "joint"):
            out.append({"t": "force", "f": self.rows.vector(force), "name": self.shown.symbol(real)} | base)
        if self._has([couple]) and _largest(real.couple) > 1e-12 * largest:
            sign = self.shown.turning_symbol(real)
            out.append({"t": "couple", "m": self.rows.of(couple), "name": sign} | base)
        return out

    @cached_property
    def _sizes(self) -> list[float]:
        """Largest force of each action over the cycle."""
        return [_largest(np.hypot(*a.force.T)) for a in self.numbered]

    def scale(self, longest: float, some: Sequence[int] | None = None) -> float:
        """Newtons a millimetre over the whole cycle, round in the reader's unit."""
        sizes = self._sizes if some is None else [self._sizes[k] for k in some]
        return force_scale(sizes, longest, unit_size(self.known, "force"))

    def polygons(self) -> list[Tree]:
        """The forces on each link head to tail, loads first, joints last, at one scale for all."""
        out = []
        for link in self.known.links:
            mine = [k for k, a in enumerate(self.actions) if a.link == link]
            mine.sort(key=lambda k: self.numbered[k].kind == "joint")
            sides = [x for k in mine for x in self.arrows(k) if x["t"] == "force"]
            out.append({"link": link, "title": self.shown.heading(link), "sides": sides})
        return out

    def charts(self) -> list[Tree]:
        """Efforts and loads asked for, joint forces; each curve a row."""
        r, out, curves = self.known, list[Tree](), list[Tree]()
        asked = [d for d, a in zip(r.drives, r.compiled.known.asked, strict=True) if a]
        for drive in asked:
            row = self.rows.of(self.rows.r.effort(drive)[0])
            kind = drive_kinds(r, drive)["effort"]
            curve = {"row": row, "name": drive, "role": "effort", "of": f"effort.{drive}"}
            out.append({"title": f"Effort of {drive}", "kind": kind, "curves": [curve]})
        for name in r.unknown_loads:
            row = self.rows.of(self.rows.r.unknown_load(name)[0])
            curve = {"row": row, "name": name, "role": "load", "of": f"load.{name}"}
            out.append({"title": name, "kind": load_kind(r, name), "curves": [curve]})
        for k, joint in enumerate(r.joints):
            x, y, *_ = self.rows.r.force_array[0, k]
            role = f"curve-{k % CURVES + 1}"
            size = self.rows.of(self._force(k))
            curves.append(
                {
                    "row": size,
                    "name": joint,
                    "role": role,
                    "of": f"magnitude.{joint}",
                    "f": self.rows.vector((x, y)),
                }
            )
        self.items.roles |= {c["role"] for chart in out for c in chart["curves"]} | {
            c["role"] for c in curves
        }
        return [*out, {"title": "Joint forces", "kind": "force", "curves": curves}]

    def _force(self, k: int) -> Numeric:
        """Magnitude of the force of joint number k, a node."""
        x, y = self.rows.r.force_array[0, k]
        return (x * x + y * y).sqrt()

    def table(self) -> list[Tree]:
        """Numbers of a position: what is driven, efforts, loads asked for, joint forces, links' motion."""
        s, r, out = self.rows.r, self.known, []

        def add(name: str, kind: str, *rows: Numeric) -> None:
            out.append({"name": name, "kind": kind, "rows": self.rows.vector(rows)})

        for drive in r.drives:
            add(f"effort of {drive}", drive_kinds(r, drive)["effort"], s.effort(drive)[0])
        for name in r.unknown_loads:
            add(name, load_kind(r, name), s.unknown_load(name)[0])
        for k, joint in enumerate(r.joints):
            j = r.mechanism.joints[joint].links[1]
            add(f"{self.shown.reaction(joint, j)} in {joint}", "force", *s.force_array[0, k])
            moment = np.ravel(s.moment_array[0, k])[0]
            if self._has([moment]):
                add(f"{self.shown.joint_moment(joint, j)} in {joint}", "moment", moment)
        for k, link in enumerate(r.links):
            add(f"angle of {self.shown.heading(link)}", "angle", s.turn_array[0, k])
            if s.inertia:
                add(f"speed of {self.shown.heading(link)}", "angular_speed", s.twist_array[0, k, 2])
                add(
                    f"acceleration of {self.shown.heading(link)}",
                    "angular_acceleration",
                    s.acceleration_array[0, k, 2],
                )
        return out


def _numbered(known: Result, actions: Sequence[Action]) -> list[Action]:
    """The action of the result beside each of the nodes; what has no number in the file is nothing there."""
    there = {_key(a): a for a in whole_actions(known)}
    count = len(known.status)
    d = known._d
    couple = np.zeros(count if d == 2 else (count, 3))
    nothing: Tree = {"at": np.zeros((count, d)), "force": np.zeros((count, d)), "couple": couple}
    return [there.get(_key(a)) or replace(a, **nothing) for a in actions]


def _key(a: Action) -> tuple[str, str, str, str]:
    return a.of, a.kind, a.source, a.link


def _largest(values: Numeric) -> float:
    known = np.abs(values[np.isfinite(values)])
    return float(known.max(initial=0.0))
