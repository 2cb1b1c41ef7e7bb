"""Reactions of a result in any axes: ground's, those of the link acted on, in space the joint's.

A wrench is (force, moment about the joint's point on j): three numbers in the plane, six in space.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, get_args

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.pair_table import local_axes
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.answer.column import Axes as Axes
from dalembert.arrays import Array, Flags
from dalembert.core.equilibrium import shifts, unique
from dalembert.core.gear_rows import gearings, wheel_axes
from dalembert.core.layout import ConstraintRows, Pose
from dalembert.errors import ModelError
from dalembert.wording import closest, quote_value

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.result import Result

PARTS = (slice(0, 3), slice(3, 6))
"""Force and moment of a wrench in space."""

PLACES = ("i", "j", "joint")
"""Axes other than ground's in which uniqueness is known: of both links of each joint, and the joint's."""


def in_axes(c: Compiled, pose: Pose, shift: Array) -> Iterator[Array]:
    """Changes (P, joints, 6, X) of the reactions in the axes of link i, of link j, and of the joint."""
    rows = c.layout.constraints
    ends = {int(k): (int(i), int(j)) for k, i, j in zip(rows.joint, *rows.ends, strict=True) if k >= 0}
    for place in PLACES:
        turned = np.empty_like(shift)
        for k in range(c.layout.joints):
            for part in PARTS:
                axes = _axes(c, k, pose, place, ends.get(k, (0, 0)), part is PARTS[1])
                turned[:, k, part] = axes @ shift[:, k, part]
        yield turned


class Uniqueness(NamedTuple):
    """Uniqueness by statics alone: components (P, joints, n) of reactions, other unknowns (P, X - K), and in space
    components (P, joints, 3, 6) in the axes of ``PLACES``."""

    reactions: Array | None
    others: Array | None
    inside: Array | None


def uniqueness(c: Compiled, pose: Pose, rows: ConstraintRows, free: Array | None) -> Uniqueness:
    """Uniqueness from the projector (P, X, X) on free multipliers; all unique where it is empty."""
    if free is None:
        return Uniqueness(None, None, None)
    shift, others = shifts(c.layout, pose, rows, free)
    inside = [unique(turned) for turned in in_axes(c, pose, shift)] if c.geometries else []
    return Uniqueness(unique(shift), others, np.stack(inside, axis=-2) if inside else None)


def _axes(c: Compiled, k: int, pose: Pose, place: str, ends: tuple[int, int], moment: bool = False) -> Array:
    """Axes (P, 3, 3), a row each, in ground axes, from the poses of all links."""
    i, j = (pose.rotation[..., end, :] for end in ends)
    if place == "joint" and c.mechanism.joints[c.joints[k]].wheels:
        rows = c.layout.constraints
        f, mesh = next(
            (f, m) for f in gearings(c.layout) for m, row in enumerate(f.row) if rows.joint[row] == k
        )
        return np.asarray(wheel_axes(c.layout.algebra, f, pose)[..., mesh, :, :])
    if place == "joint":
        return local_axes(c.mechanism.joints[c.joints[k]], c.geometries[k], i, j, moment)
    r = i if place == "i" else j
    return np.swapaxes(r.reshape((*r.shape[:-1], 3, 3)), -1, -2)


def axes_of(result: Result, joint: str, place: str, moment: bool = False) -> Array:
    """Axes (P, 3, 3), a row each, in ground axes, of a joint in space: of its link "i" or "j", or of the "joint".

    Those of its ``moment`` are others in one pair only (``pairs.local_axes``).
    """
    c = result.compiled
    if not c.geometries:
        raise ModelError("a planar joint has no local axes", "use those of ground or of the link")
    index = {name: k for k, name in enumerate(c.links)} | {"ground": len(c.links)}
    i, j = (index[name] for name in c.mechanism.joints[joint].links)
    return _axes(c, c.joints.index(joint), full_pose(result), place, (i, j), moment)


def wrench(result: Result, joint: str, on: str | None, axes: Axes, least: bool = False) -> Array:
    """Wrench of a joint on one of its links (P, n), default on j, NaN in components that are not unique.

    ``least`` gives least-norm numbers in their places.
    """
    g, k = result.compiled.layout.algebra, result.joints.index(joint)
    by = result.mechanism.joints[joint].links[0]
    moment = result.moment_array[..., k, None] if g.d == 2 else result.moment_array[..., k, :]
    total = (-1.0 if on == by else 1.0) * np.concatenate([result.force_array[..., k, :], moment], axis=-1)
    if g.d == 2:
        kept = total if least else np.where(result.unique(joint), total, np.nan)
        return to_axes(result, joint, on, axes, kept)
    total = to_axes(result, joint, on, axes, total)
    return total if least else np.where(unique_in(result, joint, _place(axes, by, on)), total, np.nan)


def _place(axes: Axes, by: str, on: str | None) -> str:
    """The place that axes are of: the ground, the joint, its link i or its link j; ModelError for other words."""
    if axes not in get_args(Axes):
        raise ModelError(f"unknown axes {quote_value(axes)}", closest(axes, list(get_args(Axes))))
    return axes if axes != "link" else "i" if on == by else "j"


def to_axes(result: Result, joint: str, on: str | None, axes: Axes, values: Array) -> Array:
    """A force (P, d) or wrench (P, n) of a joint on one of its links, default on j, from ground axes to others."""
    by, to = result.mechanism.joints[joint].links
    place = _place(axes, by, on)
    if place == "ground":
        return values
    if result.compiled.layout.algebra.d == 2:
        return _link_rotation(result, on or to, values) if place != "joint" else axes_of(result, joint, place)
    parts = np.split(values, values.shape[-1] // 3, axis=-1)
    turns = [axes_of(result, joint, place, bool(moment)) for moment in range(len(parts))]
    turned = [(turn @ part[..., None])[..., 0] for turn, part in zip(turns, parts, strict=True)]
    return np.concatenate(turned, axis=-1)


def unique_in(result: Result, joint: str, place: str) -> Flags:
    """True for components (P, n) of a joint's wrench that statics alone determines, in the axes of a place."""
    k = result.joints.index(joint)
    if result.unique_array is None:
        return np.ones((*result.force_array.shape[:-2], result.compiled.layout.algebra.n), bool)
    if place == "ground" or result.unique_in is None:
        return np.asarray(result.unique_array[..., k, :])
    return np.asarray(result.unique_in[..., k, PLACES.index(place), :])


def _link_rotation(result: Result, link: str, values: Array) -> Array:
    if link == "ground":
        return values
    force = plane.unrotate(plane.rotation(result.angle(link)), values[..., :2])
    return np.concatenate([force, values[..., 2:]], axis=-1)


def force_and_moment(wrench: Array) -> tuple[Array, Array]:
    """Force (..., d) and moment (...) or (..., 3) of wrenches (..., n)."""
    return (wrench[..., :2], wrench[..., 2]) if wrench.shape[-1] == 3 else (wrench[..., :3], wrench[..., 3:])
