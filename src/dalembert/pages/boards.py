"""Contents of a page as data: the mechanism, free bodies with their equations, polygons, charts, a table.

A row is an index into the kernel's outputs. An arrow is a force (two rows) at a point (two rows) with its symbol; a
couple is one row at a point. The page draws them to the scale printed beside them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property

import numpy as np

from dalembert.algebra import plane, space
from dalembert.analysis.methods.applied_forces import Action, full_actions, joint_place, magnitude
from dalembert.analysis.methods.elements.belt_strands import pulls_of
from dalembert.analysis.methods.members import Member, members
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind
from dalembert.analysis.result.result import Result
from dalembert.arrays import Numeric, Tree
from dalembert.kernel.graph import CONSTANT, Node
from dalembert.model import GROUND
from dalembert.pages.mechanism_items import Items, of
from dalembert.pages.rows import NodeRows
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.frame import FINE, force_scale, round_up
from dalembert.views.plane.force_polygons import chain_order
from dalembert.views.plane.mechanism_view import full_frame, is_drawn, role_of, unit_size
from dalembert.views.plane.outline import link_points

CURVES = 6
"""Roles of curves."""


def whole(d: Items) -> list[Tree]:
    """The items of the complete mechanism, what lies in front last."""
    links, joints = d.known.links, d.known.mechanism.joints
    return [
        *d.traces(),
        *d.axis(),
        *(x for link in links for x in of("link", link, d.link(link))),
        *d.spans(),
        *(x for n in sorted(joints, key=lambda n: joints[n].hinge) for x in of("joint", n, d.joint(n))),
        *d.turns(),
        *(x for link in links for x in of("center", link, d.center(link))),
        *d.circles(d.known.joints),
    ]


def names(d: Items, shown: Shown) -> list[Tree]:
    """Names of the joints, and of the links along their first edge."""
    out: list[Tree] = [
        {"text": name, "p": d.at(name), "role": "title", "kind": "joint"} for name in d.known.joints
    ]
    for link in d.known.links:
        corners = d.corners(link)
        if corners:
            text = {"text": shown.link(link), "role": "note", "kind": "link", "link": link}
            out.append(text | {"p": corners[0], "q": corners[min(1, len(corners) - 1)]})
    return out


class Boards:
    """Complete contents for one mechanism; ``actions`` in nodes."""

    def __init__(
        self, known: Result, rows: NodeRows, actions: Sequence[Action], items: Items | None = None
    ) -> None:
        self.known, self.rows, self.actions, self.d = known, rows, actions, known._d
        self.items = items or Items(rows.r, known, rows, full_frame(known, 0, 120.0, 90.0))
        self.frame = self.items.frame
        self.shown = Shown(known, Notation())
        self.numbered = _numbered(known, actions)
        self.acting = [self._acting(a) for a in actions]

    def at_pose(self, rows: NodeRows, actions: Sequence[Action]) -> Boards:
        """The same contents, of the same result, at another pose in nodes, with the same arrows."""
        other = copy(self)
        other.rows, other.actions = rows, actions
        other.items = replace(self.items, r=rows.r, rows=rows)
        return other

    def mechanism(self) -> Tree:
        """The complete mechanism: loads, efforts, and the force of each joint on its j."""
        mine = [k for k, a in enumerate(self.numbered) if self._drawn_once(a)]
        return {
            "per_mm": self.frame.per_mm,
            "middle": list(self.frame.middle),
            "items": whole(self.items),
            "labels": names(self.items, self.shown),
            "arrows": [x for k in mine for x in self.arrows(k, tangent=True)],
            "force": self.scale(22.0, mine),
        }

    def rates(self) -> list[Tree]:
        """Velocity and acceleration of each joint's point on its moving link, and of each mass centre."""
        r, m, out = self.rows.r, self.known.mechanism, list[Tree]()
        if not r.inertia:
            return out
        places = [
            ("joint", name, j.links[1], r.mechanism.joint_points(name)[1]) for name, j in m.joints.items()
        ]
        places += [
            ("center", link, link, r.mechanism.center(link)) for link in self.known.links if m.mass(link)
        ]
        for kind, name, link, u in places:
            if link not in self.known.links or (
                kind == "joint" and GROUND in m.joints[name].links and m.joints[name].hinge
            ):
                continue
            at = np.asarray(u)
            out.append(
                {
                    "of": [kind, name],
                    "p": self.rows.place(link, at),
                    "v": self.rows.vector(r._velocity(link, at)[0]),
                    "a": self.rows.vector(r._acceleration(link, at)[0]),
                }
            )
        self.items.roles |= {"velocity", "acceleration"}
        return out

    def _drawn_once(self, a: Action) -> bool:
        if a.kind == "joint":
            return a.link == self.known.mechanism.joints[a.of].links[1]
        return is_drawn(self.known, a)

    def links_apart(self) -> list[Tree]:
        """Every link separately as it is drawn, without forces."""
        return [self._link_apart(link) for link in self.known.links]

    def _link_apart(self, link: str) -> Tree:
        d, m = self.items, self.known.mechanism
        parts, labels = of("link", link, d.link(link)), list[Tree]()
        joints = self._joints(link)
        for name in joints:
            parts += of("joint", name, d.joint(name, link))
            u = self.rows.r.mechanism.joint_points(name)[m.joints[name].links.index(link)]
            labels.append({"text": name, "p": self.rows.place(link, u), "role": "title", "kind": "joint"})
        parts += of("center", link, d.center(link)) + d.circles(joints)
        return {"about": d.corners(link), "items": parts, "labels": labels}

    def _joints(self, link: str) -> list[str]:
        return [n for n in self.known.joints if link in self.known.mechanism.joints[n].links]

    def free_bodies(self, drawn: Sequence[Tree]) -> list[Tree]:
        """Every link separately, with all actions on it and its three equations; ``drawn``: its ``links_apart``."""
        return [self._free_body(link) | body for link, body in zip(self.known.links, drawn, strict=True)]

    @cached_property
    def _members(self) -> dict[str, Member]:
        return members(self.known) if self.d == 2 else {}

    def _free_body(self, link: str) -> Tree:
        mine = [k for k, a in enumerate(self.actions) if a.link == link]
        return {
            "link": link,
            "title": f"Link {self.shown.heading(link)}",
            "member": self._members[link].kind if self._members else "",
            "per_mm": self._size(link),
            "arrows": [x for k in mine for x in self._arrows_apart(k)],
            "force": self.scale(26.0),
            "equations": self._equations(link, mine, self._joints(link)),
        }

    def _size(self, link: str) -> float:
        """Metres per millimetre of a free body, a round number in the reader's unit."""
        k = int(np.argmax(self.known.ok))
        places = [*link_points(self.known, link, k).values(), tuple(self.known.center(link)[k])]
        span = float(np.ptp(np.array(places), axis=0).max())
        size = unit_size(self.known, "length")
        return round_up(max(span, 5 * self.frame.per_mm) / 46.0 / size, FINE) * size

    def _equations(self, link: str, mine: Sequence[int], joints: Sequence[str]) -> Tree:
        """Sums of forces and of moments about the link's first joint, or its mass centre: a term for each action."""
        r, terms = self.rows.r, list[Tree]()
        cross = (plane if self.d == 2 else space).cross
        at = joint_place(r, joints[0])[0] if joints else r.center(link)[0]
        for k in mine:
            a, force = self.actions[k], self.actions[k].force[0]
            couple = np.ravel(a.couple)
            if self._has(force) or self._has(couple):
                sign = self.shown.symbol if self._has(force) else self.shown.turning_symbol
                moment = couple + cross(a.at[0] - at, force)
                terms.append(
                    {
                        "name": sign(self.numbered[k]),
                        "f": self.rows.vector(force),
                        "m": self.rows.vector(moment),
                    }
                )
        return {"about": joints[0] if joints else "G", "terms": terms}

    def _has(self, values: Iterable[Numeric]) -> bool:
        """True if any node is not identically zero."""
        return any((x.level != CONSTANT or x.value != 0) if isinstance(x, Node) else x != 0 for x in values)

    def _acting(self, a: Action) -> tuple[bool, bool]:
        """True for a force and for a couple that are not identically zero."""
        return self._has(a.force[0]), self._has(np.ravel(a.couple))

    def _arrows_apart(self, k: int) -> list[Tree]:
        """The arrows of an action on a free body; those of belts and ropes as the pulls of their strands."""
        a, real = self.actions[k], self.numbered[k]
        if a.kind != "joint" or not self.known.mechanism.joints[a.of].WRAPPED:
            return self.arrows(k, tangent=True)
        pulls = zip(pulls_of(self.rows.r, self.known, a), pulls_of(self.known, self.known, real), strict=True)
        return [x for one, number in pulls for x in self._arrows(one, number, self._acting(one))]

    def arrows(self, k: int, tangent: bool = False) -> list[Tree]:
        """Force and couple of an action; ``tangent``: a pin's force on its friction circle, without the couple."""
        return self._arrows(self.actions[k], self.numbered[k], self.acting[k], tangent)

    def _arrows(
        self, a: Action, real: Action, acting: tuple[bool, bool], tangent: bool = False
    ) -> list[Tree]:
        out, (pushes, turns) = list[Tree](), acting
        role = role_of(a.kind)
        self.items.roles.add(role)
        at, force, couple = a.at[0], a.force[0], np.ravel(a.couple)
        if tangent and a.kind == "joint" and self.items.circle_radius(a.of) is not None:
            x, y = force
            arm = couple[0] / (x * x + y * y).larger(1e-300)  # 0 where there is no force
            at, turns = (at[0] + arm * y, at[1] - arm * x), False
        base: Tree = {"role": role, "of": a.of, "kind": a.kind, "link": a.link, "p": self.rows.vector(at)}
        largest = _largest(real.force)
        if pushes and (largest > 0 or a.kind == "joint"):
            out.append({"t": "force", "f": self.rows.vector(force), "name": self.shown.symbol(real)} | base)
        if turns and _largest(real.couple) > 1e-12 * max(1.0, largest):
            sense = "couple" if self.d == 2 else "moment"
            out.append(
                {"t": sense, "m": self.rows.vector(couple), "name": self.shown.turning_symbol(real)} | base
            )
        return out

    @cached_property
    def _sizes(self) -> list[float]:
        """Largest force of each action over the cycle."""
        with np.errstate(all="ignore"):
            return [_largest(magnitude(a.force)) for a in self.numbered]

    def scale(self, longest: float, some: Sequence[int] | None = None) -> float:
        """Newtons per millimetre over the full cycle, a round number in the reader's unit."""
        sizes = self._sizes if some is None else [self._sizes[k] for k in some]
        return force_scale(sizes, longest, unit_size(self.known, "force"))

    def polygons(self) -> Tree:
        """The forces on each link head to tail, loads first, joints last; and the links in the order of solution."""
        out = []
        for link in self.known.links:
            mine = [k for k, a in enumerate(self.actions) if a.link == link]
            mine.sort(key=lambda k: self.numbered[k].kind == "joint")
            sides = [x for k in mine for x in self.arrows(k) if x["t"] == "force"]
            out.append({"link": link, "title": self.shown.heading(link), "sides": sides})
        order = chain_order(self.known, self._members)
        return {"links": out, "chain": [self.known.links.index(link) for link in order]}

    def charts(self) -> list[Tree]:
        """Efforts and unknown loads, joint forces; each curve is a row, for a joint force in the plane with
        its vector."""
        r, s, out = self.known, self.rows.r, list[Tree]()

        def one(of: str, name: str, kind: str, role: str, title: str, value: Numeric) -> None:
            curve = {"row": self.rows.of(value), "name": name, "role": role, "of": f"{of}.{name}"}
            out.append({"title": title, "kind": kind, "curves": [curve]})

        for drive, is_unknown in zip(r.drives, r.compiled.known.requested, strict=True):
            if is_unknown:
                kind = drive_kinds(r, drive)["effort"]
                one("effort", drive, kind, "effort", f"Effort of {drive}", s.effort(drive)[0])
        for name in r.unknown_loads:
            one("load", name, load_kind(r, name), "load", name, s.unknown_load(name)[0])
        curves = list[Tree]()
        for k, joint in enumerate(r.joints):
            force = s.force_array[0, k]
            row = self.rows.of((force * force).sum().sqrt())
            curve = {
                "row": row,
                "name": joint,
                "role": f"curve-{k % CURVES + 1}",
                "of": f"reaction.{joint}.magnitude",
            }
            curves.append(curve | ({"f": self.rows.vector(force)} if self.d == 2 else {}))
        out.append({"title": "Joint forces", "kind": "force", "curves": curves})
        self.items.roles |= {c["role"] for chart in out for c in chart["curves"]}
        return out

    def angles(self) -> list[list[int]]:
        """Row of the angle of each link; in space none."""
        return [self.rows.vector([x]) for x in self.rows.r.turn_array[0]] if self.d == 2 else []

    def table(self) -> list[Tree]:
        """Numbers of a position: drives, efforts, unknown loads, joint forces, motion of the links."""
        s, r, out = self.rows.r, self.known, list[Tree]()

        def add(name: str, kind: str, value: Numeric) -> None:
            out.append({"name": name, "kind": kind, "rows": self.rows.vector(np.ravel(value))})

        for drive in r.drives:
            add(f"effort of {drive}", drive_kinds(r, drive)["effort"], s.effort(drive)[0])
        for name in r.unknown_loads:
            add(name, load_kind(r, name), s.unknown_load(name)[0])
        for k, joint in enumerate(r.joints):
            j, moment = r.mechanism.joints[joint].links[1], np.ravel(s.moment_array[0, k])
            add(f"{self.shown.reaction(joint, j)} in {joint}", "force", s.force_array[0, k])
            if self._has(moment):
                add(f"{self.shown.joint_moment(joint, j)} in {joint}", "moment", moment)
        for k, link in enumerate(r.links):
            name = self.shown.heading(link)
            if self.d == 2:
                out.append({"name": f"angle of {name}", "kind": "angle", "rows": self.angles()[k]})
            if s.inertia:
                add(f"speed of {name}", "angular_speed", s.twist_array[0, k, self.d :])
                add(f"acceleration of {name}", "angular_acceleration", s.acceleration_array[0, k, self.d :])
        return out


def _numbered(known: Result, actions: Sequence[Action]) -> list[Action]:
    """The action of the result for each traced one; zero where it does not exist at the file's numbers."""
    by_key = {_key(a): a for a in full_actions(known)}
    count = len(known.status)
    d = known._d
    vector, couple = np.zeros((count, d)), np.zeros(count if d == 2 else (count, 3))
    nothing: Tree = {"at": vector, "force": vector, "couple": couple}
    return [by_key.get(_key(a)) or replace(a, **nothing) for a in actions]


def _key(a: Action) -> tuple[str, str, str, str]:
    return a.of, a.kind, a.source, a.link


def _largest(values: Numeric) -> float:
    known = np.abs(values[np.isfinite(values)])
    return float(known.max(initial=0.0))
