"""Power through every joint and mesh of a machine: what goes in, what each link carries, what circulates.

Mechanics: docs/theory.md 5.6.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, effort_actions, full_actions, state
from dalembert.analysis.output.summary.printed_units import scale_for
from dalembert.answer.answer import Drawn, Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree
from dalembert.model import GROUND
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

MORE = 1 + 1e-9
"""Power over the input above which it circulates."""


@dataclass(frozen=True, eq=False)
class PowerFlow(Labelled, Drawn):
    """Powers (P,) of a result, W, each by name.

    sources: what drives, loads, weights and inertia put into the links, below 0 where they take it. through: by joint
    (P, 2), what leaves i and what reaches j; the difference is lost. links: what each link carries, the sum of all
    that comes in. meshes: the rolling power of each gear, seen from the line of centres of its wheels: that which its
    teeth transmit and of which they lose a part.
    """

    result: Result = field(repr=False)
    sources: dict[str, Array] = field(repr=False)
    through: dict[str, Array] = field(repr=False)
    links: dict[str, Array] = field(repr=False)
    meshes: dict[str, Array] = field(repr=False)

    @property
    def described(self) -> Any:
        """The description of what was analysed."""
        return self.result.mechanism

    @property
    def input(self) -> Array:
        """Power put in (P,), W."""
        return _sum([np.maximum(p, 0.0) for p in self.sources.values()], self.result)

    @property
    def output(self) -> Array:
        """Power taken out (P,), W."""
        return _sum([np.maximum(-p, 0.0) for p in self.sources.values()], self.result)

    @property
    def lost(self) -> Array:
        """Power lost at the joints (P,), W."""
        return _sum([p[:, 0] - p[:, 1] for p in self.through.values()], self.result)

    @property
    def rolling(self) -> Array:
        """The largest rolling power of a mesh (P,), W."""
        return np.asarray(np.max([*self.meshes.values(), np.zeros(len(self.result.status))], axis=0))

    @property
    def circulating(self) -> Array:
        """Power beyond the input (P,), W, that a link carries round in a circle; 0 where none does."""
        most = np.max([*self.links.values(), np.zeros(len(self.result.status))], axis=0)
        return np.where(most > MORE * self.input, most - self.input, 0.0)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Powers of sources, joints, links and meshes."""
        for word, some in (("source", self.sources), ("link", self.links), ("rolling", self.meshes)):
            yield from (Column(f"{word}.{name}", "power", values) for name, values in some.items())
        for name, both in self.through.items():
            yield Column(f"out_of_i.{name}", "power", both[:, 0])
            yield Column(f"into_j.{name}", "power", both[:, 1])
        for name in ("input", "output", "lost", "circulating"):
            yield Column(name, "power", getattr(self, name))

    def record(self, to: Scale) -> Tree:
        """Powers of the first position."""
        names = ("input", "output", "lost", "rolling", "circulating")
        return {"power_flow": {n: float(to("power", getattr(self, n)[0])) for n in names}}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Powers of the first position: sources, joints, links, and what circulates."""
        most = {"power": max(float(self.input[0]), float(self.rolling[0]), float(self.circulating[0]))}
        to = scale_for(None if units == "SI" else self.result.mechanism.units, most)
        unit = to.text("power")

        def shown(value: float) -> str:
            small = abs(value) <= 1e-12 * max(float(self.input[0]), 1e-300)
            return number(0.0 if small else float(to("power", value)))

        yield TextTable(["source", f"puts in\n{unit}"], [[n, shown(p[0])] for n, p in self.sources.items()])
        rows = []
        for name, (out, into) in ((n, p[0]) for n, p in self.through.items() if np.any(p[0])):
            i, j = self.result.mechanism.joints[name].links
            roll = shown(self.meshes[name][0]) if name in self.meshes else "-"
            rows.append([name, i, j, shown(out), shown(into), shown(out - into), roll])
        heads = [
            "joint",
            "from i",
            "to j",
            f"out of i\n{unit}",
            f"into j\n{unit}",
            f"lost\n{unit}",
            f"rolling\n{unit}",
        ]
        yield TextTable(heads, rows, 3)
        yield TextTable(
            ["link", f"carries\n{unit}"], [[n, shown(p[0])] for n, p in self.links.items() if p[0]]
        )
        if self.circulating[0] > 0:
            link = max(self.links, key=lambda n: self.links[n][0])
            part = self.links[link][0] / self.input[0]
            yield f"Power circulates: {link} carries {number(part, 4)} times the power that is put in."
        if self.rolling[0] > MORE * self.input[0] > 0:
            mesh = max(self.meshes, key=lambda n: self.meshes[n][0])
            part = self.rolling[0] / self.input[0]
            times = f"{number(part, 4)} times the power that is put in"
            yield f"The teeth of {mesh} roll with {times}, and lose a part of that."

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The powers of the first position as bands between the links."""
        from dalembert.views.machine.power_view import power_scene

        return [power_scene(self, notation)]


def _sum(some: list[Array], r: Result) -> Array:
    return np.asarray(np.sum([*some, np.zeros(len(r.status))], axis=0))


def power_flow(r: Result) -> PowerFlow:
    """Power through every joint, link and mesh of a result: ``r.power_flow()``.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> found = da.statics(da.load(cases()["gtr-1-epicyclic-reverted-train"])).power_flow()
    >>> bool(found.rolling[0] > 0), bool(abs(found.input - found.output - found.lost).max() < 1e-9 * found.input.max())
    (True, True)
    """
    motion = _Motion(r)
    through, sources = {}, dict[str, Array]()
    carried: dict[str, Array] = {link: np.zeros(len(r.status)) for link in r.links}

    def carry(a: Action, power: Array) -> None:
        if a.link != GROUND:
            carried[a.link] = carried[a.link] + np.maximum(power, 0.0)

    of_joints = {
        joint: [a for a in full_actions(r) if a.kind == "joint" and a.of == joint] for joint in r.joints
    }
    for joint, some in of_joints.items():
        j = r.mechanism.joints[joint].links[1]
        into = {a.link: motion.power(a) for a in some}
        through[joint] = np.stack([-into[r.mechanism.joints[joint].links[0]], into[j]], axis=-1)
        for a in some:
            carry(a, into[a.link])
    for a in (*effort_actions(r), *(a for a in full_actions(r) if a.kind not in ("joint", "effort"))):
        power = motion.power(a)
        carry(a, power)
        sources[a.of] = sources.get(a.of, 0.0) + power
    meshes = {n: _rolling(r, motion, n) for n in r.joints if r.mechanism.joints[n].TOOTHED}
    return PowerFlow(r, sources, through, carried, meshes)


class _Motion:
    """Velocities of the links of a result."""

    def __init__(self, r: Result) -> None:
        self.r, self.at = r, state(r)
        self.g = r.compiled.layout.algebra
        self.links = (*r.links, GROUND)

    def spin(self, link: str) -> Array:
        """Angular velocity (P,), in space (P, 3)."""
        w = self.at.moving.twist[:, self.links.index(link), self.g.d :]
        return w if self.g.d == 3 else w[:, 0]

    def velocity(self, link: str, place: Array) -> Array:
        """Velocity (P, d) of the point of a link at a place (P, d)."""
        k = self.links.index(link)
        twist = self.at.moving.twist[:, k, :]
        arm = place - self.r.compiled.origin - self.at.pose.point[:, k, :]
        return np.asarray(twist[:, : self.g.d] + self.g.spin(twist[:, self.g.d :], arm))

    def power(self, a: Action) -> Array:
        """Power (P,) of an action on its link."""
        return a.power(self.velocity(a.link, a.at), self.spin(a.link))


def _rolling(r: Result, motion: _Motion, joint: str) -> Array:
    """Power (P,) that teeth transmit in the frame in which the axes of both wheels are fixed, on the driving side."""
    from dalembert.analysis.methods.applied_forces import link_place

    described = r.mechanism.joints[joint]
    centers = [
        link_place(r, link, u)
        for link, u in zip(described.links, r.mechanism.joint_points(joint), strict=True)
    ]
    some = {a.link: a for a in full_actions(r) if a.kind == "joint" and a.of == joint}
    frame = _carrier(r, motion, joint, centers)
    powers = []
    for link, center in zip(described.links, centers, strict=True):
        moment, spin = some[link].moment(center), motion.spin(link) - frame
        powers.append(np.abs((moment * spin).sum(axis=-1) if spin.ndim == 2 else moment * spin))
    return np.asarray(np.max(powers, axis=0))


def _carrier(r: Result, motion: _Motion, joint: str, centers: list[Array]) -> Array:
    """Angular velocity of that frame: that of the line of centres, in space of the axes too."""
    described: Any = r.mechanism.joints[joint]
    links = described.links
    line = centers[1] - centers[0]
    rate = motion.velocity(links[1], centers[1]) - motion.velocity(links[0], centers[0])
    square = (line * line).sum(axis=-1)
    if motion.g.d == 2:
        return np.asarray((line[:, 0] * rate[:, 1] - line[:, 1] * rate[:, 0]) / square)
    axes = [
        r.rotation_array[:, r.links.index(link)].reshape(-1, 3, 3) @ np.array(frame[2])
        if link != GROUND
        else np.broadcast_to(np.array(frame[2]), line.shape)
        for link, frame in zip(links, described.frames, strict=True)
    ]
    rows = [_skew(line), *map(_skew, axes)]
    right = [rate, *(np.cross(motion.spin(link), a) for link, a in zip(links, axes, strict=True))]
    matrix, b = np.concatenate(rows, axis=1), np.concatenate(right, axis=1)
    return np.array([np.linalg.lstsq(m, v, rcond=None)[0] for m, v in zip(matrix, b, strict=True)])


def _skew(v: Array) -> Array:
    """Matrices (P, 3, 3) with w -> w x v."""
    z = np.zeros(len(v))
    return np.stack([z, v[:, 2], -v[:, 1], -v[:, 2], z, v[:, 0], v[:, 1], -v[:, 0], z], axis=-1).reshape(
        -1, 3, 3
    )
