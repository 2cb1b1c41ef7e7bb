"""Stress and buckling of straight links in a compiled analysis, as nodes of it, with exact derivatives.

In the plane, with all mass at its centre, N and V along a member are constant and M is linear between the feet of what
acts on it. The equivalent stress is convex in these: the largest is on one of both sides of a foot.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.load_arrays import point_of
from dalembert.arrays import Array, Numeric
from dalembert.core.branchless import above, larger, where
from dalembert.errors import ModelError
from dalembert.machine.link_axes import in_space
from dalembert.machine.members.straight_members import FLAT, members_of
from dalembert.model import Pin, Slider, Slot, Weld

if TYPE_CHECKING:
    from dalembert.analysis.batch.tracing.outputs import Catalogue
    from dalembert.analysis.result.result import Result

FIXED, ON_J = (Pin, Weld), (Slider, Slot)
"""Joints whose reaction acts at one place of both links, and of j alone."""
BESIDE = 1e-9
"""Part of a member's length within which two feet are one."""
LEAST = 1e-60
"""Square of a stress, Pa2, from which on it has a slope."""


def lacks(r: Result, link: str) -> str:
    """Why the forces inside a link are not compiled; empty where they are."""
    m, part = r.mechanism, r.mechanism.links[link]
    mine = {n: j for n, j in m.joints.items() if link in j.links}
    if m.dimension == 3:
        return "the mechanism is in space"
    if m.turning is not None or r.compiled.contacts is not None:
        return "it has friction or a plane that turns"
    if part.mass_along != "lumped":
        return f"the mass of {link!r} lies along it"
    others = [n for n, j in mine.items() if not isinstance(j, FIXED + ON_J * (j.links[1] == link))]
    others += [n for n, j in mine.items() if np.any(getattr(j, "damping", 0.0))]
    others += [n for n, load in m.loads.items() if link in _carriers(m, load) and not _plain(load)]
    others += [n for n, d in m.drives.items() if m.drive_joint(n) in mine and d.freedom == "slide"]
    if others:
        return f"it is loaded by {others[0]!r} otherwise than by forces at points and couples"
    try:
        _ends(r, link)
    except ModelError as error:
        return error.what
    return ""


def _plain(load: Any) -> bool:
    return load.ON in ("point", "link") and not load.unknown


def _carriers(m: Any, load: Any) -> tuple[str, ...]:
    """Links on which a load acts."""
    if load.ON in ("point", "link"):
        return (load.on,)
    if load.ON == "span":
        return tuple(link for link, _ in load.between)
    return tuple(m.joints[load.joint].links)


def _ends(r: Result, link: str) -> tuple[str, str]:
    """Points of a link at the ends of its only member; raises ModelError where it has none such."""
    m = r.mechanism
    places = np.array([in_space(_place(m, n, link)) for n, j in m.joints.items() if link in j.links])
    members = members_of(m, link, places.reshape(-1, 3))
    ends = members[0].ends
    if len(members) > 1 or not {*ends} <= m.links[link].points.keys():
        raise ModelError(f"link {link!r} is not one member between two of its points", "")
    size = FLAT * members[0].length
    if not m.links[link].members and len({tuple(np.round(p / size)) for p in places}) != 2:
        raise ModelError(f"the joints of {link!r} are not at two places", "name its members: members: [A, B]")
    return ends


def _place(m: Any, joint: str, link: str) -> Array:
    """A joint's place on a link, in its axes."""
    return np.array(m.joint_points(joint)[m.joints[joint].links.index(link)])


class LocalForce(NamedTuple):
    """A force at a place of a link, in its axes, and a couple."""

    place: Array
    force: Array
    couple: Numeric


class Cut(NamedTuple):
    """Forces inside a member at a cut: N, V and M."""

    axial: Numeric
    shear: Numeric
    bending: Numeric


class CompiledMember:
    """A link of one member in a compiled analysis: its length and the forces inside it where they may be largest."""

    def __init__(self, c: Catalogue, r: Result, link: str) -> None:
        """``r``: an analysis of the file's numbers. Raises ModelError where it is not compiled."""
        if why := lacks(r, link):
            raise not_compiled(link, why)
        self.c, self.link, self.k = c, link, c.links.index(link)
        start, end = (np.array(c.mechanism.links[link].point(p)) for p in _ends(r, link))
        self.length = larger(np.sqrt(((end - start) ** 2).sum()), 0.0)[()]
        self.start, self.along = start, (end - start) / self.length
        self.actions = [*self._joints(), *self._efforts(), *self._loads()]

    def _to_link(self, v: Array) -> Array:
        return np.asarray(plane.rotate(self.c.rotation_array[self.k] * np.array([1.0, -1.0]), v))

    def _joints(self) -> Iterator[LocalForce]:
        for name, joint in self.c.mechanism.joints.items():
            if self.link in joint.links:
                sense = 1.0 if joint.links[1] == self.link else -1.0
                place = _place(self.c.mechanism, name, self.link)
                force = self._to_link(sense * self.c.reaction(name))
                yield LocalForce(place, force, sense * self.c.reaction_moment(name))

    def _efforts(self) -> Iterator[LocalForce]:
        m = self.c.mechanism
        for drive in self.c.drives:
            joint = m.drive_joint(drive)
            if self.link in m.joints[joint].links:
                sense = 1.0 if m.joints[joint].links[1] == self.link else -1.0
                place = _place(m, joint, self.link)
                yield LocalForce(place, np.zeros(2), sense * self.c.effort(drive))

    def _loads(self) -> Iterator[LocalForce]:
        """Weight and inertia at the mass centre, forces at their points, couples at theirs or the centre."""
        m = self.c.mechanism
        known = {"force": m.loads_on("point"), "couple": m.loads_on("link")}
        at: dict[str, list[Any]] = {
            kind: [getattr(load, "at", None) or "center" for load in some.values() if not load.unknown]
            for kind, some in known.items()
        }
        reference = self.c.compiled.layout.reference[self.k]
        for kind, source in self.c.traced.sources.items():
            for n, on in enumerate(source.link):
                if on != self.k:
                    continue
                if kind not in ("weight", "inertia", *at):
                    raise not_compiled(self.link, f"{kind} acts on it")
                place = point_of(m, self.link, at[kind][n] if kind in at else "center")
                w = source.wrench.reshape(-1, 3)[n]
                force = self._to_link(w[:2])
                yield LocalForce(place, force, w[2] - plane.cross(place - reference, force)[..., 0])

    def cuts(self) -> Iterator[Cut]:
        """The forces on both sides of each foot."""
        along, across = self.along, plane.across(self.along)
        feet = [
            larger(-larger(-((a.place - self.start) @ along), -self.length), 0.0)[()] for a in self.actions
        ]
        for s in feet:
            for side in (-BESIDE, BESIDE):
                beyond = [above(foot, s + side * self.length)[()] for foot in feet]
                acting = list(zip(beyond, self.actions, strict=True))
                n, v = (sum(on * (a.force @ t) for on, a in acting) for t in (along, across))
                about = self.start + s * along
                moments = (a.couple + plane.cross(a.place - about, a.force)[..., 0] for a in self.actions)
                yield Cut(n, -v, sum(on * moment for on, moment in zip(beyond, moments, strict=True)))


def not_compiled(link: str, why: str) -> ModelError:
    """Forces inside a link that a compiled analysis does not have."""
    remedy = "use da.dynamics, da.sweep, da.study or da.optimize, which analyse designs one by one"
    return ModelError(f"the forces inside {link!r} are not compiled: {why}", remedy)


def compiled_stress(c: Catalogue, r: Result, link: str) -> Numeric:
    """Greatest von Mises stress of a link, Pa, a node."""
    member, s = CompiledMember(c, r, link), c.mechanism.links[link].section
    assert s is not None
    stiff = s.reach[0] / s.second_moments[1]
    out = np.asarray(0.0)
    for cut in member.cuts():
        direct, shear = cut.axial / s.area_of, s.shear[0] * cut.shear
        outer = abs(direct) + abs(cut.bending) * stiff
        out = larger(larger(out, outer), np.sqrt(larger(direct * direct + 3.0 * shear * shear, LEAST)))
    return out[()]


def compiled_buckling(c: Catalogue, r: Result, link: str) -> Numeric:
    """Compression of a link over its critical load, a node; the factors K are those of the file's design."""
    member, s = CompiledMember(c, r, link), c.mechanism.links[link].section
    assert s is not None
    assert s.elasticity is not None
    compression, critical = np.asarray(0.0), None
    for cut in member.cuts():
        compression = larger(compression, 0.0 - cut.axial)
    for p, factor in enumerate(factors(r, link)):
        load = math.pi**2 * s.elasticity * s.second_moments[1 - p] / (factor * member.length) ** 2
        if s.yield_stress is not None:
            squash = s.area_of * s.yield_stress
            load = where(above(load, squash / 2), squash * (1.0 - squash / (4.0 * load)), load)
        critical = load if critical is None else -larger(-np.asarray(critical), -np.asarray(load))
    return np.asarray(compression / critical)[()]


def factors(r: Result, link: str) -> tuple[float, float]:
    """K in the plane and across it where it does not depend on the design: given, or of pins at both ends.

    Raises ModelError where it does.
    """
    from dalembert.machine.members.buckling import buckling
    from dalembert.machine.members.member_forces import member_forces

    given = r.mechanism.links[link].effective_length or {}
    if {*given} == {""}:
        return given[""]
    b = buckling(member_forces(r, link))
    known = b.factors[np.isfinite(b.factors).all(axis=1)]
    if (
        not len(known)
        or b.ends != ("pinned", "pinned")
        or b.moves_along
        or (np.ptp(known, axis=0) > 1e-9).any()
    ):
        raise not_compiled(link, "its effective length may depend on the design, unless the file gives it")
    return float(known[0, 0]), float(known[0, 1])
