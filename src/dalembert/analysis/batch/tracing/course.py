"""The mechanism at a list of positions, followed when its motion is needed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.analysis.batch.over_positions import is_cycle
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.compile.joint_rows import stated_poses
from dalembert.analysis.compile.pose_loads import SPEED, TIME, counted_coordinates, parts
from dalembert.analysis.engine.quick_pass import quick_answer
from dalembert.analysis.positions import Positions, positions
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.overflow import size_sentence
from dalembert.arrays import Array, Tree
from dalembert.core.friction.contact_equations import bearing
from dalembert.core.layout import Pose
from dalembert.core.position.first_pose_plane import phase_rows
from dalembert.core.position.first_pose_space import PoseGuess
from dalembert.errors import ModelError
from dalembert.model import Mechanism, Schedule


@dataclass(frozen=True)
class PositionPath:
    """The mechanism with the file's numbers at a list of positions, followed when its motion is needed.

    With the ``result`` of the general executor, which may be of another design, its motion is that. ``inertia``: of the
    analysis that is traced beside it, whose kept program then gives the motion too.
    """

    mechanism: Mechanism
    schedule: Schedule
    result: Result | None = None
    inertia: bool = True
    target: Mapping[str, Array] | None = None
    """Target of each output (position, component)."""

    def with_target(self, target: Mapping[str, Array]) -> PositionPath:
        """The same course, as far as it is followed."""
        value = copy(self)
        value.__dict__["target"] = target
        return value

    @cached_property
    def compiled(self) -> Compiled:
        return compile_mechanism(self.mechanism, self.schedule)

    @cached_property
    def followed(self) -> Positions:
        beyond = size_sentence(self.compiled)
        if beyond is not None:
            raise ModelError(beyond, "", ("links",))
        with np.errstate(all="ignore"):
            value = quick_answer(self.compiled, self.inertia, forces=False)
        return value if isinstance(value, Positions) else positions(self.compiled)

    @cached_property
    def cycle(self) -> bool:
        """True if its positions are periodic; raises ModelError where they are not even."""
        drives = [self.mechanism.drives[name].turns for name in self.schedule.names]
        return is_cycle(self.schedule.position, drives)

    @cached_property
    def pose(self) -> Pose:
        """Its poses, NaN where it does not close."""
        if self.result is not None:
            return full_pose(self.result)
        path = self.followed.path
        assert path is not None
        lost = ~path.reached
        parts = [a.copy() for a in path.pose]
        for a in parts:
            a[lost] = np.nan
        return Pose(*parts)

    def in_mode(self, m: Mechanism) -> Mechanism:
        """A design in the assembly mode of this one."""
        return in_mode(m, self.followed.compiled, self.pose.at(0), self.schedule)

    @cached_property
    def first(self) -> int:
        """The first position that closes."""
        if self.result is not None:
            return int(np.argmax(np.isfinite(self.pose.point).all(axis=(1, 2))))
        path = self.followed.path
        return int(np.argmax(path.reached)) if path is not None else 0

    def going_by(self, names: Iterable[str]) -> Tree:
        """Variables (P,) that a changing quantity depends on: drives, time, and the pose, the motion being known."""
        out: Tree = {name: self.schedule.position[:, k] for k, name in enumerate(self.schedule.names)}
        out |= {name + SPEED: self.schedule.speed[:, k] for k, name in enumerate(self.schedule.names)}
        clock = self.schedule.clock
        if TIME in names and clock is None:
            raise ModelError(
                "a load depends on time, but no times are given for these positions",
                "leave them out, or give a drive a constant speed instead of a law",
            )
        by_pose = [name for name in names if parts(name)]
        at = counted_coordinates(self.compiled, self.counted, self.pose, by_pose) if by_pose else {}
        at = {name: np.where(np.isfinite(values), values, values[self.first]) for name, values in at.items()}
        return {TIME: clock, **out, **at}

    @cached_property
    def slips(self) -> dict[tuple[str, str], Array]:
        """Friction z (P,) of each contact of the result, by joint and kind: c z is its force or couple."""
        f = None if self.result is None else self.result.friction
        if self.result is None or f is None:
            return {}
        c = self.result.compiled
        assert c.contacts is not None
        z = np.nan_to_num(-f.sense * bearing(c.contacts, f.argument))
        return dict(zip(contact_keys(c), z.T, strict=True))

    @cached_property
    def reversals(self) -> dict[tuple[str, str], Array]:
        """Sense (P,) of each contact where it reverses in the result, 0 where its rate determines it."""
        f = None if self.result is None else self.result.friction
        if self.result is None or f is None:
            return {}
        sense = np.where(f.reversing, f.sense, 0.0)
        return dict(zip(contact_keys(self.result.compiled), sense.T, strict=True))

    @property
    def counted(self) -> Compiled:
        """The mechanism with the full turns of its torsion springs counted along its motion."""
        return self.followed.compiled if self.result is None else self.result.compiled

    def at(self, positions: Array) -> PositionPath:
        """Another list of positions, at the same speeds and accelerations."""
        count = len(positions)
        rates = [np.repeat(a[:1], count, axis=0) for a in (self.schedule.speed, self.schedule.acceleration)]
        schedule = replace(
            self.schedule, position=positions, speed=rates[0], acceleration=rates[1], time=None, after=None
        )
        return PositionPath(self.mechanism, schedule, inertia=self.inertia)


def contact_keys(c: Compiled) -> list[tuple[str, str]]:
    """Joint and kind of each contact, numbered from the second of a kind in a joint on."""
    keys: list[tuple[str, str]] = []
    for k, kind in zip(c.contacts.joint, c.contacts.kind, strict=True) if c.contacts is not None else ():
        same = sum(joint == c.joints[k] and name.split()[0] == kind for joint, name in keys)
        keys.append((c.joints[k], f"{kind} {same + 1}" if same else kind))
    return keys


def in_mode_of(m: Mechanism, nominal: Result, positions: Any = None) -> Mechanism:
    """A design in the assembly mode of another one's analysis; as it is where it begins at other positions."""
    schedule = m.schedule(positions)
    if not np.array_equal(schedule.position[:1], nominal.schedule.position[:1]):
        return m
    return in_mode(m, nominal.compiled, full_pose(nominal, 0), schedule)


def in_mode(m: Mechanism, like: Compiled, pose: Pose, schedule: Schedule) -> Mechanism:
    """A design with the assembly mode of another, whose links have a pose (L+1, ...) at the first position of both.

    As it is where its file states an assembly, where phases or turns are counted from the first pose, and in space
    where a bar between balls may spin, whose drawn pose is that without spin, or the design does not close at that
    position.
    """
    constraints = like.layout.constraints
    if m.assembly or not np.isfinite(pose.point).all() or like.counts:
        return m
    if phase_rows(constraints).size or constraints.idle.size:
        return m
    kept = m.model_copy(update={"assembly": stated_poses(like.layout, like.links, pose)})
    if m.dimension == 2:
        return kept
    c = compile_mechanism(kept, schedule)
    assert isinstance(c.guess, PoseGuess)
    return kept if c.guess.closes(c.layout, c.targets[0]) else m
