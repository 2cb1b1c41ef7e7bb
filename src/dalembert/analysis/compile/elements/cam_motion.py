"""A cam that turns by itself under its follower, on the link that carries both: lift, normals and curves over a turn.

The follower's motion out from the cam's axis is y: the height of its point along the slide, or its turn. Axes are those
of the carrier, from the cam's axis, as for ``CamCarrier``; cam axes where a name says so.

Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.elements.cam_shapes import CamCarrier, CamShape, cam_shape
from dalembert.arrays import Array
from dalembert.core.elements import cam_rows
from dalembert.core.elements.cam_curves import SNAP, TURN, lift
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.layout import Pose
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.joints.elements.cams import Cam

STEP = 1e-4
"""Half of the turn over which the jerk is the change of the second derivative, where no law of the lift gives it."""


class CamPlace(NamedTuple):
    """A cam at turns (N,): y and its derivatives; the follower's point (N, 2), the normal on it, the direction in which
    the place of contact moves, and where a face touches, from its point along the face."""

    y: Array
    slope: Array
    bend: Array
    point: Array
    normal: Array
    way: Array
    place: Array


@dataclass(frozen=True, eq=False)
class CamMotion:
    """A cam of a mechanism on its carrier."""

    joint: Cam
    shape: CamShape
    center: Array  # (2,) the cam's point from its axis, in its axes at turn 0

    @property
    def carrier(self) -> CamCarrier:
        assert self.shape.carrier is not None
        return self.shape.carrier

    @cached_property
    def row(self) -> CamRow:
        """The row of the cam, link 0, and its follower, link 1, about the cam's axis and the follower's point."""
        numbers = {k: np.array([v]) for k, v in self.shape.numbers.items()}
        zero, none = np.zeros(1, np.intp), np.zeros((1, 2))
        return CamRow(row=zero, i=zero, j=zero + 1, ui=self.center[None], uj=none, **numbers)

    @cached_property
    def sense(self) -> float:
        """1 where the lift follows the cam's turn counter-clockwise, else -1."""
        return -1.0 if self.joint.profile.sense == "cw" else 1.0

    @cached_property
    def joins(self) -> Array:
        """Turns (n,) of the cam, in its sense, at which pieces of its lift join, increasing in a turn from 0."""
        starts = self.shape.curve[:, 0]
        if self.joint.profile.segments is None:  # over directions in the cam's axes
            turns = [self._turn_of(float(x)) for x in starts]
            starts = np.array(turns)
        value = np.unique(np.round(np.mod(starts, TURN), 14))
        return np.asarray(value[(value > 1e-9) & (value < TURN - 1e-9)])

    def turns(self, count: int) -> Array:
        """Even turns (N,) with those of the joints of pieces."""
        even = np.linspace(0.0, TURN, count)
        near = np.abs(even[:, None] - np.array([*self.joins, np.inf])).min(axis=1) < 1e-6
        return np.sort([*even[~near], *self.joins])

    def _turn_of(self, direction: float) -> float:
        """The turn, in the cam's sense, at which the row reads its lift at a direction of the cam's axes."""
        turns, read = self._scanned
        off = np.mod(read - direction + np.pi, TURN) - np.pi
        turn = turns[[int(np.argmin(np.abs(off)))]]
        for _ in range(60):
            off = np.mod(self._read(turn) - direction + np.pi, TURN) - np.pi
            turn = turn + self.sense * off
            if abs(float(off[0])) < 1e-15:
                break
        return float(turn[0])

    @cached_property
    def _scanned(self) -> tuple[Array, Array]:
        """Evenly spaced turns, and the directions that the row reads at them."""
        turns = np.linspace(0.0, TURN, 121)
        return turns, self._read(turns)

    def _read(self, turns: Array) -> Array:
        """Direction in the cam's axes at which the row reads its lift."""
        y = self.height(turns)
        pose, _ = self._pose(turns, y)
        t = cam_rows.touch(plane, self.row, pose)
        return np.asarray((self.row.sense * (t.follower.turn[0] - self._beta(t, pose)))[..., 0])

    def _beta(self, t: cam_rows.Touch, pose: Pose) -> Array:
        if self.joint.flat:
            return np.asarray(pose.turn[..., [1]] - pose.turn[..., [0]])
        return np.asarray(np.arctan2(t.line[..., 1], t.line[..., 0]) - pose.turn[..., [0]])

    # poses

    @property
    def middle(self) -> float:
        """y of a follower at about half its lift."""
        law = self.joint.profile.segments
        return self._start() + (0.0 if law is None else max(map(abs, law.targets), default=0.0) / 2)

    def placed(self, y: Array) -> tuple[Array, Array]:
        """The follower's point (N, 2) and its angle (N,) at y (N,)."""
        on = self.carrier
        if on.swings:
            angle = on.sign * y
            arm = plane.rotate(plane.rotation(angle), on.arm)
            return on.at + arm, angle
        way = on.way / np.hypot(*on.way)
        aside = on.at - way * (way @ on.at)
        return aside + y[:, None] * way, np.full(len(y), float(on.turn))

    def _pose(self, turns: Array, y: Array) -> tuple[Pose, Array]:
        """Poses of cam and follower, and the rate (N, 3) of the follower over y."""
        at, angle = self.placed(y)
        turn = np.stack([self.joint.profile.start + self.sense * turns, angle], axis=-1)
        point = np.stack([np.zeros_like(at), at], axis=-2)
        on = self.carrier
        rate = np.zeros((len(y), 3))
        if on.swings:
            rate[:, :2], rate[:, 2] = on.sign * plane.across(at - on.at), on.sign
        else:
            rate[:, :2] = on.way
        return Pose(point, turn, plane.rotation(turn)), rate

    def height(self, turns: Array) -> Array:
        """y (N,) where the follower touches the cam; raises ModelError where it does not."""
        law = self.joint.profile.segments
        y = np.full(len(turns), self._start())
        if law is not None:
            y = y + np.abs(law.programme.curve.at(np.mod(turns + SNAP, TURN))[0])
        for _ in range(50):
            pose, rate = self._pose(turns, y)
            gap = cam_rows.measure(plane, self.row, pose)[:, 0]
            step = gap / self._slope(pose, rate)
            if np.abs(step).max(initial=0.0) <= 1e-14 * (1 + np.abs(y).max(initial=0.0)):
                return np.asarray(y - step)
            y = y - np.clip(step, -0.2 * self._size, 0.2 * self._size)
        if not np.abs(gap).max() <= 1e-9 * self._size:
            raise ModelError("the follower does not stay on the cam over a turn", "see its joints' places")
        return y

    @cached_property
    def _size(self) -> float:
        """A length, or an angle, that is large for y."""
        return 1.0 if self.carrier.swings else abs(float(self.shape.base)) + _mean_radius(self.shape.curve)

    def _start(self) -> float:
        """y of a follower on the base circle, or of one that is about on a cam given by its form."""
        on, shape = self.carrier, self.shape
        base = float(shape.base)
        if self.joint.profile.segments is None:
            radius = _mean_radius(shape.curve)
            if not on.swings:
                return radius
            return _swing_start(self, radius)
        if not on.swings:
            return base
        if self.joint.flat:
            return float(on.sign * (shape.gamma + self.joint.profile.start) + base)
        toward = np.arctan2(-on.at[1], -on.at[0])
        return float(on.sign * (toward - np.arctan2(on.arm[1], on.arm[0])) + base)

    def _slope(self, pose: Pose, rate: Array) -> Array:
        """Change (N,) of the gap with y."""
        on_i, on_j = np.zeros((2, len(rate), 1, 3))
        cam_rows.wrench(plane, self.row, pose, on_i, on_j)
        return np.asarray((on_j[:, 0] * rate).sum(axis=-1))

    def at(self, turns: Array, before: bool = False) -> CamPlace:
        """The cam at turns (N,) in its sense; at a joint of pieces behind it, or just ``before``."""
        turns = self._beside(np.atleast_1d(np.asarray(turns, float)), -1.0 if before else 1.0)
        y = self.height(turns)
        pose, rate = self._pose(turns, y)
        on_i, on_j = np.zeros((2, len(y), 1, 3))
        cam_rows.wrench(plane, self.row, pose, on_i, on_j)
        by_y = (on_j[:, 0] * rate).sum(axis=-1)
        slope = -self.sense * on_i[:, 0, 2] / by_y
        twist = np.zeros((len(y), 2, 3))
        twist[:, 0, 2], twist[:, 1] = self.sense, rate * slope[:, None]
        inward = (pose.point[:, 1] - self.carrier.at) * (slope * slope)[:, None] * float(self.carrier.swings)
        bent = cam_rows.drift(plane, self.row, pose, twist)[:, 0] - (on_j[:, 0, :2] * inward).sum(axis=-1)
        bend = -bent / by_y
        normal = cam_rows.normal(plane, self.row, pose)[:, 0]
        place = cam_rows.contact_place(plane, self.row, pose)[:, 0]
        touching = pose.point[:, 1] - place[:, None] * plane.across(normal)
        way = rate[:, :2].copy()
        if self.carrier.swings:
            way = self.carrier.sign * plane.across(touching - self.carrier.at)
        way = way / np.hypot(*way.T)[:, None]
        return CamPlace(y, slope, bend, pose.point[:, 1], normal, way, place)

    def _beside(self, turns: Array, side: float) -> Array:
        """The turns, those at joints of pieces just beside them."""
        inner = np.mod(turns[:, None] - np.array([0.0, *self.joins]) + np.pi, TURN) - np.pi
        near = np.abs(inner).min(axis=1) <= SNAP
        return np.where(near, turns + 3 * SNAP * side, turns)

    def jerk(self, turns: Array) -> Array:
        """Third derivative (N,) of y."""
        law = self.joint.profile.segments
        if law is not None:
            return np.asarray(lift_sign(self) * law.programme.curve.at(np.mod(turns + SNAP, TURN))[3])
        return np.asarray((self.at(turns + STEP).bend - self.at(turns - STEP).bend) / (2 * STEP))

    def in_cam(self, turns: Array, vector: Array) -> Array:
        """Vectors (N, 2) of the carrier's axes in those of the cam."""
        return np.asarray(
            plane.rotate(plane.rotation(-self.joint.profile.start - self.sense * turns), vector)
        )

    def curvature(self, turns: Array, place: CamPlace) -> Array:
        """Curvature (N,) of the curve of a point follower in the cam, of the cam itself under a face: > 0 convex."""
        on, y1, y2 = self.carrier, place.slope, place.bend
        n = place.normal
        if self.joint.flat:
            rate = self.sense if not on.swings else self.sense - on.sign * y1  # of the cam against the normal
            if not on.swings:
                along = n @ (on.way / np.hypot(*on.way))
                first, second, bent = along * y1, along * y2, 0.0 * y1
            else:
                turn, bent = on.sign * y1, on.sign * y2
                aside = plane.across(n) @ on.at
                first, second = aside * turn, aside * bent - (n @ on.at) * turn * turn
            height = (n * place.point).sum(axis=-1)
            with np.errstate(divide="ignore"):
                return np.asarray(1.0 / (height + (second * rate + first * bent) / rate**3))
        if on.swings:
            arm = place.point - on.at
            v = on.sign * plane.across(arm) * y1[:, None]
            a = on.sign * plane.across(arm) * y2[:, None] - arm * (y1 * y1)[:, None]
        else:
            v, a = on.way * y1[:, None], on.way * y2[:, None]
        w = self.sense
        a = a - 2 * w * plane.across(v) - place.point
        v = v - w * plane.across(place.point)
        return np.asarray(-w * plane.cross(v, a)[:, 0] / np.hypot(*v.T) ** 3)


def lift_sign(c: CamMotion) -> float:
    """1 where the lift has the sign of y, outward, else -1."""
    return c.carrier.up


def _mean_radius(table: Array) -> float:
    """About the radius of a profile given by its form."""
    x = np.linspace(0.0, TURN, 24, endpoint=False)[:, None]
    return float(np.mean(lift(table[None], x)[0]))


def _swing_start(c: CamMotion, radius: float) -> float:
    """A turn of the follower at which its point is at a radius, or its face touches a circle of it."""
    on = c.carrier
    far, arm = float(np.hypot(*on.at)), float(np.hypot(*on.arm))
    if c.joint.flat:
        height = float(c.shape.normal @ on.arm)
        angle = -np.arccos(np.clip((radius - height) / far, -1, 1))
        turned = np.arctan2(on.at[1], on.at[0]) - np.arctan2(c.shape.normal[1], c.shape.normal[0])
        return float(on.sign * turned + angle)
    angle = np.arccos(np.clip((arm * arm + far * far - radius * radius) / (2 * arm * far), -1, 1))
    toward = np.arctan2(-on.at[1], -on.at[0]) - np.arctan2(on.arm[1], on.arm[0])
    return float(on.sign * toward + angle)


def cam_motion(m: Mechanism, name: str) -> CamMotion:
    """The motion of a cam on its carrier; raises ModelError where no link carries both."""
    joint = m.joints[name]
    assert isinstance(joint, Cam)
    shape = cam_shape(m, name)
    if shape.carrier is None:
        raise ModelError(
            f"cam {name!r}: no link carries both cam and follower, so its lift over a turn is not defined",
            "pin the cam to the link on which the follower slides or swings",
            ("joints", name),
        )
    axis = np.array(
        m.joint_points(shape.carrier.pin)[m.joints[shape.carrier.pin].links.index(joint.links[0])]
    )
    return CamMotion(joint, shape, np.array(m.joint_points(name)[0]) - axis)


def outline_motion(m: Mechanism, name: str) -> CamMotion:
    """The motion that gives a cam's outline: on its carrier, or of a follower that slides through its point."""
    joint: Any = m.joints[name]
    shape = cam_shape(m, name)
    if shape.carrier is not None:
        return cam_motion(m, name)
    turn = -math.atan2(shape.normal[1], shape.normal[0]) if joint.flat else 0.0
    carrier = CamCarrier("", "", "", False, np.zeros(2), np.array([1.0, 0.0]), 1.0, turn)
    return CamMotion(joint, replace(shape, carrier=carrier), np.zeros(2))


def outline(m: Mechanism, name: str, count: int = 181) -> Array:
    """Outline (N, 2) of a cam from its point, in its link's axes, m."""
    c = outline_motion(m, name)
    turns = c.turns(count)[:-1]
    p = c.at(turns)
    at = p.point - p.place[:, None] * plane.across(p.normal) - c.joint.follower.roller * p.normal
    return np.asarray(c.in_cam(turns, at) - c.center)
