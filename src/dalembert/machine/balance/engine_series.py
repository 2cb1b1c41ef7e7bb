"""Engines as the books take them: each cylinder's primary and secondary force, beside the exact shaking force.

A piston on a line through the crank's axis, its rod on a crank pin at r from it: the book splits the rod's mass between
its ends and keeps two harmonics of the piston's acceleration, r w^2 (cos q + r / l cos 2 q), q from the dead centre.
The exact series of a centric cylinder has 1, A_2 = l + l^3 / 4 + ..., A_4, ... with l for r / l, so the book loses.

Mechanics: docs/theory.md 10.1.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.algebra.plane import across
from dalembert.analysis.methods.applied_forces import link_place
from dalembert.analysis.plane_only import refuse_space
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.machine.shaking import Shaking, shaking
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


class EngineCylinder(NamedTuple):
    """A piston, its rod and the link with its crank pin; joints between them; the crank's joint with the ground."""

    piston: str
    rod: str
    crank: str
    pin: str
    gudgeon: str
    guide: str
    axis: str


@dataclass(frozen=True, eq=False)
class EngineSeries(Compared):
    """Force and couple (P, 2) of the inertia by the book's two harmonics, and exact.

    >>> import dalembert as da
    >>> e = da.engine_series(da.dynamics(da.radial_engine(cylinders=3)))
    >>> e.force.shape, len(e.cylinders)
    ((72, 2), 3)
    """

    exact: Shaking = field(repr=False)
    cylinders: tuple[EngineCylinder, ...]
    force: Array = field(repr=False)
    couple: Array = field(repr=False)

    @property
    def loss(self) -> float:
        """Largest difference of the book's force, over the largest exact force; 0 where it is rounding."""
        exact = self.exact.parts["inertia"][0]
        off = greatest(exact - self.force)[0]
        return off / greatest(exact)[0] if off > self.exact.floor("force") else 0.0


def cylinders(m: Mechanism) -> tuple[EngineCylinder, ...]:
    """The cylinders of a plane mechanism: pistons that slide on the ground, rods, and what turns on the ground."""
    pins = {name: joint.links for name, joint in m.joints.items() if joint.hinge}
    sliders = {n: j.links for n, j in m.joints.items() if j.freedoms == ("slide",) and GROUND in j.links}
    on_ground = {_other(links, GROUND): name for name, links in pins.items() if GROUND in links}
    for i, j in (joint.links for joint in m.joints.values() if not joint.freedoms):
        for a, b in ((i, j), (j, i)):  # throws welded to the shaft turn with it
            if a in on_ground:
                on_ground.setdefault(b, on_ground[a])

    def joined(link: str) -> list[tuple[str, str]]:
        """Pins of a link with other links that move, and these."""
        return [(n, _other(ends, link)) for n, ends in pins.items() if link in ends and GROUND not in ends]

    return tuple(
        EngineCylinder(piston, rod, crank, pin, gudgeon, guide, on_ground[crank])
        for guide, piston in ((guide, _other(links, GROUND)) for guide, links in sliders.items())
        for gudgeon, rod in joined(piston)
        for pin, crank in joined(rod)
        if pin != gudgeon and crank in on_ground
    )


def engine_series(r: Result) -> EngineSeries:
    """The two textbook harmonics of every cylinder, with the rotating parts exact, beside the exact inertia force.

    Raises ModelError where the mechanism has no cylinder, one whose line misses the crank's axis, or one whose crank
    swings, as the knee of a toggle.

    >>> import dalembert as da
    >>> m = da.radial_engine(cylinders=3, crank=0.06, rod=0.24, piston_mass=1.0, rod_mass=0.0, speed=80 * np.pi)
    >>> e = da.engine_series(da.dynamics(m))
    >>> len(e.cylinders), f"{100 * e.loss:.1f} %"
    (3, '0.6 %')
    """
    refuse_space(r.mechanism, "the book's series of an engine", "ask for the shaking force: da.shaking")
    all_cylinders = cylinders(r.mechanism)
    if not all_cylinders:
        raise ModelError(
            "the mechanism has no cylinder: a piston on the ground, a rod and a crank",
            "compute the shaking force: da.shaking",
        )
    for c in all_cylinders:
        if (r.speed(c.crank) < 0).any() and (r.speed(c.crank) > 0).any():
            what = f"{c.crank}, the crank of {c.piston}, swings: this is not an engine"
            raise ModelError(what, "compute the shaking force: da.shaking")
    m, counted = r.mechanism, {link for c in all_cylinders for link in (c.piston, c.rod)}
    parts = [part for c in all_cylinders for part in _parts(r, c)]
    parts += [(n, -m.mass(n) * r.center_acceleration(n)) for n in r.links if n not in counted]
    force = np.sum([f for _, f in parts], axis=0)
    couple = np.sum([m.links[link].place * across(f) for link, f in parts], axis=0)
    return EngineSeries(shaking(r, all_cylinders[0].axis), all_cylinders, force, couple)


def _parts(r: Result, c: EngineCylinder) -> list[tuple[str, Array]]:
    """Inertia forces (P, 2) of the rod's end that turns, of the one that goes to and fro, and of the piston."""
    m = r.mechanism
    guide: Any = m.joints[c.guide]
    line = float(guide.direction or 0.0)
    along, center = np.array([np.cos(line), np.sin(line)]), _point(m, c.axis, GROUND)
    pin, gudgeon = (link_place(r, c.rod, _point(m, joint, c.rod)) for joint in (c.pin, c.gudgeon))
    arm, off = pin - center, gudgeon - center
    crank, length = (float(np.hypot(*v[0])) for v in (arm, gudgeon - pin))
    if length == 0:
        raise ModelError(f"{c.rod} has no length", "the book's series has the ratio of crank and rod")
    aside = np.abs(off[:, 0] * along[1] - off[:, 1] * along[0]).max()
    if aside > 1e-9 * length:
        raise ModelError(
            f"the line of {c.piston} passes the crank by {aside:.4g} m", "the book's series has no offset"
        )
    side, ratio = np.sign(float(off[0] @ along)) * along, crank / length
    q = np.arctan2(side[0] * arm[:, 1] - side[1] * arm[:, 0], arm @ side)
    w, alpha = r.speed(c.crank), r.acceleration(c.crank)
    going = w**2 * (np.cos(q) + ratio * np.cos(2 * q)) + alpha * (np.sin(q) + ratio / 2 * np.sin(2 * q))
    turning, to_and_fro = w[:, None] ** 2 * arm - alpha[:, None] * across(arm), crank * going[:, None] * side
    a, b = (_point(m, joint, c.rod) for joint in (c.pin, c.gudgeon))
    share = float((np.array(m.center(c.rod)) - a) @ (b - a)) / length**2  # of the rod's mass, to the piston
    at_pin, at_piston = m.mass(c.rod) * (1 - share), m.mass(c.rod) * share
    return [
        (c.rod, at_pin * turning),
        (c.rod, at_piston * to_and_fro),
        (c.piston, m.mass(c.piston) * to_and_fro),
    ]


def _other(links: tuple[str, str], link: str) -> str:
    return links[1] if links[0] == link else links[0]


def _point(m: Mechanism, joint: str, link: str) -> Array:
    return np.array(m.joint_points(joint)[m.joints[joint].links.index(link)])
