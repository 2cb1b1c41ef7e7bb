"""Inspection before calculation: class of each link, order of solution, concurrent lines, share of inertia.

Classes follow from the forces on a link: zero-force, two-force, two-force with couple, three-force, four-force,
general. The order of solution starts at the smallest group of links whose equations suffice for its unknowns.
Mechanics: docs/theory.md 7.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.algebra.lines import meeting_point
from dalembert.analysis.friction.friction_circles import NOTHING
from dalembert.analysis.friction.joint_friction import friction_circle_radius
from dalembert.analysis.methods.applied_forces import (
    Action,
    actions,
    full_actions,
    magnitude,
    on_link,
)
from dalembert.analysis.output.rounding import PART, sizes
from dalembert.analysis.plane_only import refuse_space
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.equality import Compared
from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


KINDS = {2: "two-force", 3: "three-force", 4: "four-force"}
ZERO = "zero-force"
"""Class of a link without forces at any position."""


@dataclass(frozen=True, eq=False)
class Member(Compared):
    """A link's class: what acts on it, and for a two-force member its tension (P,), negative in compression.

    ``forces`` and ``couples`` name what acts: joints, loads, `weight`, `inertia`; of a zero-force member ``forces``
    are its joints, which carry nothing. ``circles``: joints whose reaction
    dry friction moves off the pin's centre, onto a tangent of its friction circle.
    """

    link: str
    kind: str
    forces: tuple[str, ...]
    couples: tuple[str, ...]
    tension: Array | None
    circles: tuple[str, ...] = ()

    def state(self, k: int) -> str:
        """`tension`, `compression` or nothing, at position k."""
        if self.tension is None or not np.isfinite(self.tension[k]) or self.tension[k] == 0:
            return ""
        return "tension" if self.tension[k] > 0 else "compression"

    @property
    def sentence(self) -> str:
        """Why it has this class."""
        if self.kind == ZERO:
            nowhere = ", ".join(self.forces) or "no joint"
            return f"{self.link}: {self.kind} member (nothing in {nowhere}; no couple)"
        what = ", ".join(self.forces) or "no force"
        couples = f"; couples: {', '.join(self.couples)}" if self.couples else "; no couple"
        words = f"{self.link}: {self.kind} member (forces: {what}{couples})"
        return f"{words}; {self.touching}" if self.circles else words

    @property
    def touching(self) -> str:
        """Friction's effect on the lines of the reactions; empty without friction circles."""
        if not self.circles:
            return ""
        at = f"the friction circle{'s' if len(self.circles) > 1 else ''} at {', '.join(self.circles)}"
        if self.kind == "two-force" and len(self.circles) > 1:
            return f"both forces lie on one common tangent of {at}"
        if self.kind == "two-force":
            return f"both forces lie on one line, which touches {at} and passes the other pin's centre"
        each = f"each reaction touches {at}" if len(self.circles) > 1 else f"the reaction touches {at}"
        joints = [f for f in self.forces if f in self.circles]
        if len(self.forces) > len(joints) == 2:
            torques = (f"torque {n}" if n in joints else n for n in self.couples)
            rest = list(dict.fromkeys([*(f for f in self.forces if f not in joints), *torques]))
            verb = "acts" if len(rest) == 1 else "act"
            return f"not a two-force member, as {' and '.join(rest)} {verb} too: {each}, on different lines"
        return each


@dataclass(frozen=True)
class SolutionStep:
    """One step of the solution: links solved together, the unknowns it gives, and the reason why it can."""

    links: tuple[str, ...]
    finds: tuple[str, ...]
    equations: int
    why: str


@dataclass(frozen=True, eq=False)
class Displaced(Compared):
    """Inertia force (P, 2) of a link moved off its mass centre so that it makes the inertia couple too.

    ``offset`` h = I alpha / F (P,) and ``at`` a point of its line of action (P, 2).
    """

    link: str
    force: Array
    couple: Array
    offset: Array
    center: Array
    at: Array


@dataclass(frozen=True)
class Share:
    """Largest contribution of inertia over the cycle, compared with the largest total value: shows whether inertia may
    be left out."""

    of: str
    quantity: str
    whole: float
    inertia: float

    @property
    def share(self) -> float:
        """Inertia's part, 0 to 1 and more."""
        return self.inertia / self.whole if self.whole > 0 else 0.0


def members(r: Result, limit: float = NOTHING) -> dict[str, Member]:
    """Class of every link over the positions of a result.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> found = da.members(da.statics(da.load(cases()["seed-000-a-four-bar-loaded-rocker"])))
    >>> {name: member.kind for name, member in found.items()}
    {'crank': 'two-force with couple', 'coupler': 'two-force', 'rocker': 'three-force'}
    """
    everything, split = full_actions(r), actions(r)
    largest = max((float(np.nanmax(magnitude(a.force), initial=0.0)) for a in everything), default=0.0)
    floor = limit * largest
    return {
        link: _member(r, link, on_link(everything, link), on_link(split, link), floor) for link in r.links
    }


def _member(r: Result, link: str, some: Sequence[Action], split: Sequence[Action], floor: float) -> Member:
    """The class of a link from its forces with friction in them, and from its couples without friction's."""
    forces = [a for a in some if a.kind == "joint" or np.nanmax(magnitude(a.force), initial=0.0) > floor]
    length = r.compiled.layout.length
    couples = [
        a
        for a in split
        if np.nanmax(np.abs(a.couple), initial=0.0) > floor * length
        and a.kind != "friction"
        and not (a.kind == "joint" and r.mechanism.joints[a.of].guides)
    ]
    if not couples and _nothing(r, forces, floor):
        return Member(link, ZERO, tuple(map(_name, forces)), (), None)
    if not couples:
        forces = [
            a
            for a in forces
            if np.nanmax(np.abs(a.couple), initial=0.0) > floor * length or not _nothing(r, [a], floor)
        ]
    kind = KINDS.get(len(forces), "general")
    if couples:
        kind = "two-force with couple" if kind == "two-force" else "general"
    tension = _tension(forces) if kind == "two-force" else None
    pins = [a for a in forces if a.kind == "joint" and np.nanmax(magnitude(a.force), initial=0.0) > floor]
    plane = r.mechanism.dimension == 2
    circles = tuple(a.of for a in pins if plane and friction_circle_radius(r, a.of))
    return Member(link, kind, tuple(map(_name, forces)), tuple(map(_name, couples)), tension, circles)


def _nothing(r: Result, forces: Sequence[Action], floor: float) -> bool:
    """True if all forces on a link are zero at every solved position, and unique."""
    answered = np.isfinite(r.power_balance)
    sizes = [magnitude(a.force)[answered] for a in forces]
    unique = [np.isfinite(r.reaction(a.of)[answered]).all() for a in forces if a.kind == "joint"]
    return bool(answered.any() and all(unique) and all((size <= floor).all() for size in sizes))


def _name(a: Action) -> str:
    return a.kind if a.kind in ("weight", "inertia") else a.of


def _tension(two: Sequence[Action]) -> Array:
    """Pull from the first point towards the second (P,); with friction its line passes beside them."""
    along = (two[1].force * (two[1].at - two[0].at)).sum(axis=-1)
    return np.asarray(magnitude(two[1].force) * np.sign(along))


def order_of_solution(r: Result, found: dict[str, Member] | None = None) -> tuple[SolutionStep, ...]:
    """The links in the order in which they can be solved, the fewest at a time.

    A link without loads and couples between two pins (in space two ball joints) is a two-force member: its forces are
    known in direction, one unknown is left of them. A group of links is solvable when its unknowns are no more than
    its equations.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> for step in da.order_of_solution(da.dynamics(da.load(examples()["four_bar"]))):
    ...     print(step.why)
    coupler and rocker together: 6 equations, 6 unknowns in A, B, O4
    crank: 3 equations, 3 unknowns in O2, torque O2
    """
    found = found or members(r)
    unknowns = _Unknowns(r, found)
    rods = unknowns.rods
    left = [link for link in r.links if link not in rods]
    steps: list[SolutionStep] = []
    while left:
        group = next(
            (g for size in range(1, len(left) + 1) for g in combinations(left, size) if unknowns.suffice(g)),
            tuple(left),
        )
        steps.append(unknowns.step(group))
        left = [link for link in left if link not in group]
    return tuple(steps)


def _sought_on(r: Result) -> set[str]:
    """Links on which an unknown effort or load acts."""
    drives = [d for d, unknown in zip(r.drives, r.compiled.known.requested, strict=True) if unknown]
    links = {n for d in drives for n in r.mechanism.joints[r.mechanism.drives[d].joint or d].links}
    loads: list[Any] = [r.mechanism.loads[n] for n in r.unknown_loads]
    return links | {load.on for load in loads}


class _Unknowns:
    """Unknown numbers by name, the links that each acts on, and those already solved."""

    def __init__(self, r: Result, by_link: dict[str, Member]) -> None:
        self.each, self.passive = r.compiled.layout.algebra.n, set(r.compiled.passive)
        rows = r.compiled.layout.constraints.joint
        self.idle = {link for link, m in by_link.items() if m.kind == ZERO}
        self.rods = rods = self._rods(r, by_link)
        self.count: dict[str, int] = {}
        self.on: dict[str, set[str]] = {}
        self.solved: set[str] = set()
        for k, joint in enumerate(r.joints):
            links = set(r.mechanism.joints[joint].links)
            between = links & rods
            name = f"the line of {next(iter(between))}" if between else joint
            self.count[name] = 1 if between else int((rows == k).sum())
            self.on.setdefault(name, set()).update(links - rods)
        for k, drive in enumerate(r.drives):
            if r.compiled.known.requested[k]:
                joint = r.mechanism.drives[drive].joint or drive
                angular = r.compiled.layout.freedoms.angular[r.compiled.layout.driven[k]]
                name = f"{'torque' if angular else 'force'} {drive}"
                self.count[name], self.on[name] = 1, set(r.mechanism.joints[joint].links)
        for load in r.unknown_loads:
            described: Any = r.mechanism.loads[load]
            self.count[load], self.on[load] = 1, {described.on}

    def _rods(self, r: Result, by_link: dict[str, Member]) -> set[str]:
        """Links whose equations leave one unknown of their two joints, whatever it is; no two of them touch.

        The three equations of a link in the plane leave one unknown of the four of two pins, none of a pin and a slot.
        """
        rows, sought = r.compiled.layout.constraints.joint, _sought_on(r)
        out: set[str] = set()
        for link, member in by_link.items():
            if member.kind not in ("two-force", ZERO) or link in sought:
                continue
            joints = [k for k, n in enumerate(r.joints) if link in r.mechanism.joints[n].links]
            touched = {n for k in joints for n in r.mechanism.joints[r.joints[k]].links}
            left = int(np.isin(rows, joints).sum()) - self.equations((link,))
            if len(joints) == 2 and left == 1 and not touched & out:
                out.add(link)
        return out

    def of(self, group: Sequence[str]) -> list[str]:
        return [n for n, links in self.on.items() if links & set(group) and n not in self.solved]

    def suffice(self, group: Sequence[str]) -> bool:
        return sum(self.count[n] for n in self.of(group)) <= self.equations(group)

    def equations(self, group: Sequence[str]) -> int:
        """Three a link, in space six; about the line of its two ball joints a link that could spin has none."""
        return int(self.each) * len(group) - len(self.passive & set(group))

    def step(self, group: Sequence[str]) -> SolutionStep:
        finds = self.of(group)
        self.solved |= set(finds)
        unknowns, equations = sum(self.count[n] for n in finds), self.equations(group)
        links = " and ".join(group) + (" together" if len(group) > 1 else "")
        noun = "unknown" if unknowns == 1 else "unknowns"
        zero = ", all zero" if self.idle >= set(group) else ""
        why = f"{links}: {equations} equations, {unknowns} {noun} in {', '.join(finds)}{zero}"
        return SolutionStep(tuple(group), tuple(finds), equations, why)


def displaced_inertia(r: Result, link: str) -> Displaced:
    """The inertia force of a link on its displaced line: F = -m a_G, couple -I alpha, h = I alpha / F.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> found = da.displaced_inertia(da.dynamics(da.load(cases()["seed-000-b-crank-inertia-force"])), "crank")
    >>> f"{float(found.offset[0]) / 0.0254:.4f} in"
    '1.7995 in'
    """
    refuse_space(
        r.mechanism, "the displaced inertia force", "read the inertia force and couple of da.forces_on"
    )
    center = r.center(link)
    force = -r.mechanism.mass(link) * r.center_acceleration(link)
    couple = -r.mechanism.inertia(link) * r.acceleration(link)
    size = magnitude(force)
    with np.errstate(all="ignore"):
        offset = np.abs(couple) / size
        across = np.stack([-force[:, 1], force[:, 0]], axis=-1)
        at = center - across * (couple / size**2)[:, None]
    return Displaced(link, force, couple, np.asarray(offset), center, np.asarray(at))


def concurrency(some: Sequence[Action], k: int) -> tuple[float, float] | None:
    """Point where the lines of action of forces meet at position k: least squares; None where they are parallel."""
    if not some:
        return None
    meeting = meeting_point(np.array([a.at[k] for a in some]), np.array([a.force[k] for a in some]))
    return None if meeting is None else (float(meeting[0][0]), float(meeting[0][1]))


def components_along(r: Result, a: Action, k: int) -> tuple[float, float]:
    """A force along and across its link (its x axis), at position k."""
    refuse_space(r.mechanism, "components along and across a link", 'ask the reaction with axes="link"')
    angle = 0.0 if a.link == "ground" else float(r.angle(a.link)[k])
    c, s = np.cos(angle), np.sin(angle)
    fx, fy = a.force[k]
    return float(c * fx + s * fy), float(c * fy - s * fx)


def inertia_shares(r: Result) -> tuple[Share, ...]:
    """Share of inertia in every effort and joint force, over the cycle, the largest first.

    Where forces add it is inertia's part of the superposition, else the difference to the answer without inertia.
    Values that are only rounding beside the largest force or moment are left out.

    >>> from dalembert.bundled import examples
    >>> import dalembert as da
    >>> share = inertia_shares(da.dynamics(examples()["four_bar"]))[0]
    >>> share.of, round(share.inertia / share.whole, 2)
    ('O2', 0.77)
    """
    efforts, forces = _parts_of_inertia(r)
    rounding = {kind: PART * float(np.nanmax(size, initial=0.0)) for kind, size in sizes(r).items()}
    out = []
    for k, drive in enumerate(r.drives):
        share = _share(drive, "effort", np.abs(r.effort_array[:, k]), np.abs(efforts[:, k]))
        out += [share] if share.whole > rounding[drive_kinds(r, drive)["effort"]] else []
    for k, joint in enumerate(r.joints):
        share = _share(joint, "reaction", magnitude(r.force_array[:, k, :]), magnitude(forces[:, k, :]))
        out += [share] if share.whole > rounding["force"] else []
    return tuple(sorted(out, key=lambda s: round(-s.share, 9)))


def _parts_of_inertia(r: Result) -> tuple[Array, Array]:
    """Inertia's part of the efforts (P, D) and joint forces (P, J, 2)."""
    if r.friction is not None or r.compiled.forcing.follows_reactions:
        from dalembert.analysis.one_pass import at_schedule

        still = at_schedule(r.mechanism, r.schedule, inertia=False)
        return r.effort_array - still.effort_array, r.force_array - still.force_array
    from dalembert.analysis.methods.superposition import forces_of

    force, _, effort, _ = forces_of(r, "inertia")
    return effort, force


def _share(of: str, quantity: str, total: Array, part: Array) -> Share:
    return Share(of, quantity, float(np.nanmax(total, initial=0.0)), float(np.nanmax(part, initial=0.0)))
