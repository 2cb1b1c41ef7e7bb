"""Joints of a description as rows for the core: constraints, freedoms by name, contacts, and the first guess."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from dalembert.algebra import plane, space
from dalembert.analysis.compile import pair_table
from dalembert.analysis.compile import plane_rows as table
from dalembert.analysis.compile.contacts import KINDS as PLANE_FRICTION
from dalembert.analysis.compile.contacts import Kinds, contacts, has_friction
from dalembert.analysis.compile.elements.brake_contacts import add_brake, brake_place
from dalembert.analysis.compile.elements.cam_joints import add_cam, follower_at_rest
from dalembert.analysis.compile.load_arrays import joint_resistances
from dalembert.analysis.compile.space_contacts import KINDS as SPACE_FRICTION
from dalembert.arrays import Array, Ints
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Idle, Layout, Pose, Rows
from dalembert.core.position.first_pose_plane import Guess
from dalembert.core.position.first_pose_space import PoseGuess
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.assembly import SpacePose
from dalembert.model.joints.pairs import AXES
from dalembert.model.joints.plane_joints import Joint
from dalembert.model.quantities.values import Vector


class _Joints:
    """Rows and names of all joints: what both kinds have in common."""

    def __init__(
        self,
        m: Mechanism,
        drives: tuple[str, ...],
        index: dict[str, int],
        reference: Array,
        at: Mapping[str, tuple[Vector, Vector]],
    ) -> None:
        self.m, self.drives, self.index, self.reference = m, drives, index, reference
        links = len(index) - 1
        self.constraints = table.RowBuilder(links, m.dimension)
        self.freedoms = table.RowBuilder(links, m.dimension)
        self.names: list[tuple[str, str]] = []
        self.ends: list[tuple[int, int]] = []
        self.arms: list[tuple[Any, ...]] = []
        self.geometries: tuple[pair_table.Geometry, ...] = ()
        self.shapes: dict[int, Any] = {}  # of machine elements
        for k, (name, joint) in enumerate(m.joints.items()):
            ends = (index[joint.links[0]], index[joint.links[1]])
            ui, uj = (np.subtract(u, reference[e]) for u, e in zip(at[name], ends, strict=True))
            self.ends.append(ends)
            self.arms.append((ui, uj))
            self.add(k, name, joint)
        self.passive = self.add_passive()

    def add(self, k: int, name: str, joint: Joint) -> None:
        """The rows of one joint."""
        raise NotImplementedError

    def compliance(self, fixed: Rows) -> Array | None:
        """Compliance of each constraint, 0 where it is rigid; None where no joint has a stiffness."""
        yielding = {k: j.stiffness for k, j in enumerate(self.m.joints.values()) if j.stiffness is not None}
        if not yielding:
            return None
        out = np.zeros(fixed.count)
        for k, stiffness in yielding.items():
            for row, kind, axis, share in self.reactions(k, np.flatnonzero(fixed.joint == k), fixed):
                value = getattr(stiffness, kind)
                if value is not None:
                    out[row] += share**2 / (value[axis] if isinstance(value, tuple) else value)
        return out

    def reactions(self, k: int, rows: Ints, fixed: Rows) -> Iterator[tuple[int, str, int, float]]:
        """Each row of a joint, force or moment, its local axis, and how much of it a unit of the row is."""
        for row in rows:
            yield int(row), "moment" if fixed.angular[row] else "force", 0, 1.0

    def contacts_of(
        self,
        fixed: Rows,
        at: Sequence[object],
        kinds: Kinds,
        places: Callable[[Joint, int], Mapping[Any, int]],
    ) -> Contacts | None:
        """The contacts of the joints with friction, of a table of those that can have it."""
        damping = joint_resistances(self.m, self.names)
        return contacts(self.m, fixed, self.ends, at, self.arms, damping, kinds, places)

    def add_passive(self) -> tuple[str, ...]:
        """Rows that hold freedoms which move nothing else; the names of their links."""
        return ()


ELEMENTS: dict[str, Callable[..., Any]] = {"cam": add_cam}
"""Planar joints whose constraints depend on other joints of their links."""


PLACES: dict[str, Callable[..., Any]] = {"cam": follower_at_rest}
"""Joints that say where link j is about: its angle, and the place of its point."""


def _nowhere(m: Mechanism, name: str) -> None:
    """Nothing."""


class PlaneJoints(_Joints):
    """Planar joints."""

    def add(self, k: int, name: str, joint: Joint) -> None:
        """The rows of one joint."""
        element = ELEMENTS.get(joint.type)
        if joint.BRAKES:
            place = brake_place(self.m, name, self.index, self.reference, self.arms[k])
            add_brake(self.constraints, k, self.ends[k], place)
            self.arms[k] = place
            return
        if element is not None:
            rows = self.freedoms if joint.gaps else self.constraints
            self.shapes[k] = element(rows, self.m, k, name, self.ends[k], self.arms[k])
        else:
            table.add_constraints(self.constraints, k, joint, self.ends[k], *self.arms[k])
            table.add_freedom(self.freedoms, k, joint, self.ends[k], *self.arms[k])
        self.names += [(name, freedom) for freedom in joint.freedoms]

    def contacts(self, fixed: Rows) -> Contacts | None:
        """The contacts of the joints with friction."""
        at = [(*arms, self.shapes[k]) if k in self.shapes else arms for k, arms in enumerate(self.arms)]
        return self.contacts_of(fixed, at, PLANE_FRICTION, lambda _, first: {0: first, 1: first + 1})

    def guess(self) -> Guess:
        """Angles and places of the links that the file gives."""
        m, index, reference = self.m, self.index, self.reference
        turn, point = np.full(len(index), np.nan), np.full((len(index), 2), np.nan)
        for link, pose in m.assembly.items():
            k = index[link]
            if isinstance(pose, float):
                turn[k] = pose
                continue
            if not isinstance(pose, tuple):
                raise ModelError(
                    "a pose in space means nothing in the plane", "give an angle", ("assembly", link)
                )
            x, y, angle = pose
            turn[k] = angle
            arm = plane.rotate(plane.rotation(np.array(angle)), reference[k])
            point[k] = np.array([x, y]) + arm - reference[-1]
        for n, (name, joint) in enumerate(m.joints.items()):
            standing = PLACES.get(joint.type, _nowhere)(m, name)
            if standing is not None and joint.links[1] not in m.assembly:
                k = index[joint.links[1]]
                turn[k] = standing[0]
                arm = plane.rotate(plane.rotation(turn[k]), self.arms[n][1])
                point[k] = np.array(standing[1]) - arm - reference[-1]
        return Guess(turn, point)


class SpaceJoints(_Joints):
    """Joints in space."""

    def add(self, k: int, name: str, joint: Any) -> None:
        """The rows of one joint."""
        if joint.wheels:
            at = pair_table.Geometry(*self.arms[k], *(np.array(axes) for axes in joint.frames))
            self.geometries += (at,)
            self.constraints.counted = max(self.freedoms.counted, self.constraints.counted)
            pair_table.add_gear(self.constraints, k, joint, self.ends[k], at)
            self.freedoms.counted = self.constraints.counted
            return
        at = pair_table.geometry(joint, *self.arms[k])
        self.geometries += (at,)
        split = has_friction(self.m, joint) or joint.stiffness is not None
        pair_table.add_constraints(self.constraints, k, joint, self.ends[k], at, split)
        axes = (d.axis for key, d in self.m.drives.items() if self.m.drive_joint(key) == name)
        axis = next((axis for axis in axes if axis is not None), None)
        self.freedoms.counted = max(self.freedoms.counted, self.constraints.counted)
        freedoms = pair_table.add_freedom(self.freedoms, k, joint, self.ends[k], at, axis)
        self.constraints.counted = self.freedoms.counted
        self.names += [(name, freedom) for freedom in freedoms]

    def add_passive(self) -> tuple[str, ...]:
        """Links that can spin about the line of their two ball joints: set to no spin."""
        driven = {self.m.drive_joint(name) for name, drive in self.m.drives.items() if drive.turns}
        links = []
        for link, number in self.index.items():
            ends = [
                (name, joint, joint.links.index(link))
                for name, joint in self.m.joints.items()
                if link in joint.links
            ]
            balls = [joint.ball and name not in driven for name, joint, _ in ends]
            if link == "ground" or len(ends) != 2 or not all(balls):
                continue
            a, b = (np.asarray(self.m.joint_points(name)[side]) for name, _, side in ends)
            if np.linalg.norm(b - a) == 0:
                raise ModelError(
                    f"the two ball joints of link {link!r} have their centres in one point",
                    "place them apart",
                    ("joints", ends[1][0]),
                )
            line = (b - a) / np.linalg.norm(b - a)
            pose = self.m.assembly.get(link)
            drawn = space.IDENTITY
            if isinstance(pose, SpacePose):
                drawn = space.rotation(np.array(pose.angle), pose.axis)
            # a ball in a guide of the link moves in it, and the line with it
            stands = all(not joint.slides or side == 1 for _, joint, side in ends)
            self.constraints.add(
                Idle, -1, (len(self.index) - 1, number), p=line, drawn=drawn, stands=float(stands)
            )
            links.append(link)
        return tuple(links)

    def reactions(self, k: int, rows: Ints, fixed: Rows) -> Iterator[tuple[int, str, int, float]]:
        """Each row of a joint, force or moment, its local axis, and how much of it a unit of the row is."""
        joint: Any = list(self.m.joints.values())[k]
        if joint.wheels:
            yield from super().reactions(k, rows, fixed)
            return
        for name, row in pair_table.reaction_rows(joint, int(rows[0])).items():
            yield row, "force" if name[0] == "F" else "moment", AXES.index(name[1]), 1.0
            if joint.pair.threaded and name == "Fx":  # the thread's couple goes with its force
                yield row, "moment", 0, joint.lead / (2 * np.pi)

    def contacts(self, fixed: Rows) -> Contacts | None:
        """The contacts of the joints with friction."""
        return self.contacts_of(fixed, self.geometries, SPACE_FRICTION, pair_table.reaction_rows)

    def guess(self) -> PoseGuess:
        """Poses of the links that the file gives, and how the joints place the others."""
        count = len(self.index)
        rotation, point = np.full((count, 9), np.nan), np.full((count, 3), np.nan)
        axis, angle = np.zeros((count, 3)), np.append(np.full(count - 1, np.nan), 0.0)
        for link, pose in self.m.assembly.items():
            if not isinstance(pose, SpacePose):
                raise ModelError(
                    "a pose in space needs a position, an axis and an angle",
                    "write {position: [0, 0, 0], axis: [0, 0, 1], angle: 30 deg}",
                    ("assembly", link),
                )
            k = self.index[link]
            rotation[k] = space.rotation(np.array(pose.angle), pose.axis)
            axis[k], angle[k] = np.array(pose.axis) / np.linalg.norm(pose.axis), pose.angle
            point[k] = (
                np.array(pose.position) + space.rotate(rotation[k], self.reference[k]) - self.reference[-1]
            )
        hinges = []
        for k, (name, joint) in enumerate(self.m.joints.items()):
            if joint.wheels:
                continue
            drives = {
                str(self.m.drives[d].freedom or "turn"): n
                for n, d in enumerate(self.drives)
                if self.m.drive_joint(d) == name
            }
            hinges.append(pair_table.hinge(joint, self.ends[k], self.geometries[k], drives))
        return PoseGuess(rotation, point, tuple(hinges), axis, angle)


def stated_poses(layout: Layout, links: Sequence[str], pose: Pose) -> dict[str, Any]:
    """A pose (L+1, ...) as an ``assembly`` states it: of the origins of the links, in ground's axes."""
    g, out = layout.algebra, dict[str, Any]()
    origin = pose.point - g.rotate(pose.rotation, layout.reference) + layout.reference[-1]
    for k, link in enumerate(links):
        x = tuple(origin[k].tolist())
        if g.d == 2:
            out[link] = (*x, float(pose.turn[k]))
            continue
        from scipy.spatial.transform import Rotation

        turn = Rotation.from_matrix(pose.rotation[k].reshape(3, 3)).as_rotvec()
        angle = float(np.linalg.norm(turn))
        out[link] = SpacePose(x, tuple(turn / angle) if angle else (0.0, 0.0, 1.0), angle)
    return out
