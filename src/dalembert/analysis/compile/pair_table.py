"""Joints in space as rows, by the model's table of pairs. Local axes are x, y, z; those of docs/theory.md 2.2.

A new pair is a row of ``PAIRS`` and nothing here. One that blocks one turn only does so between a direction of i and
one of j, as a pin in a slot does: with x blocked, y of i and z of j stay at a right angle.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from dalembert.algebra import space
from dalembert.analysis.compile.plane_rows import RowBuilder, numbers, signed_radii
from dalembert.arrays import Array, Tree
from dalembert.core.layout import Along, Angle, Gearing, Helix, Meet, Perpendicular
from dalembert.core.position.first_pose_space import Hinge
from dalembert.model.joints.pairs import AXES, Pair
from dalembert.model.joints.plane_joints import Gear, Joint
from dalembert.model.quantities.values import Vector


class Geometry(NamedTuple):
    """A joint in space at its two links: points (3,) and local axes (3, 3), a row each, in link axes."""

    ui: Array
    uj: Array
    on_i: Array
    on_j: Array


def geometry(joint: Any, ui: Array, uj: Array) -> Geometry:
    """Points and local axes; of a universal joint y is the pin of i and z that of j."""
    on_i, on_j = (np.array(f) for f in joint.frames)
    if joint.pair.pins:
        on_i = _with_pin(on_i[2], 1, on_j[2])
        on_j = _with_pin(on_j[2], 2, on_i[1])
    return Geometry(ui, uj, on_i, on_j)


def _with_pin(pin: Array, place: int, other: Array) -> Array:
    """Local axes with a pin at y (1) or z (2), and the other one's components, made square, at the other place."""
    across = other - (other @ pin) * pin
    if np.linalg.norm(across) < 0.1:
        across = np.eye(3)[np.abs(pin).argmin()]
        across = across - (across @ pin) * pin
    across /= np.linalg.norm(across)
    y, z = (pin, across) if place == 1 else (across, pin)
    return np.array([np.cross(y, z), y, z])


def add_constraints(
    rows: RowBuilder, index: int, joint: Any, ends: tuple[int, int], at: Geometry, split: bool = False
) -> None:
    """Rows of a joint's constraints: forces along local axes of i, then moments.

    ``split`` gives a joint that holds its point three rows along its axes, which friction reads, rather than one of
    three along ground's.
    """
    pair = joint.pair
    if pair.threaded:
        for axis in (1, 2):
            rows.add(Along, index, ends, ui=at.ui, uj=at.uj, axis=at.on_i[axis], pitch=0.0)
        about = _about(at, 0)
        pitch = -joint.lead / (2 * np.pi)
        rows.add(
            Helix, index, ends, ui=at.ui, uj=at.uj, pitch=pitch, count=rows.next_counted_angle(), **about
        )
    elif pair.forces == AXES and not split:
        rows.add(Meet, index, ends, ui=at.ui, uj=at.uj)
    else:
        for axis in (AXES.index(name) for name in pair.forces):
            rows.add(Along, index, ends, ui=at.ui, uj=at.uj, axis=at.on_i[axis], pitch=0.0)
    for name in pair.moments:
        a, p = _moment(pair, AXES.index(name), at)
        rows.add(Perpendicular, index, ends, a=a, p=p)


def reaction_rows(joint: Joint, first: int) -> dict[str, int]:
    """Row of each reaction, Fx to Mz, of a joint whose first constraint is given and whose point is split; T, the
    tangential force of teeth."""
    if joint.wheels:
        return {"T": first}
    pair = joint.pair
    forces = "yzx" if pair.threaded else pair.forces
    names = [*(f"F{axis}" for axis in forces), *(f"M{axis}" for axis in pair.moments)]
    return {name: first + k for k, name in enumerate(names)}


def tooth_columns(joint: Gear, at: Geometry) -> Tree:
    """Numbers of a mesh; directions, signs and cones are those of the first pose (``core.gear_rows.mesh_wheels``)."""
    ri, rj = signed_radii(joint)
    axes: Tree = {"ai": at.on_i[2], "aj": at.on_j[2], "bi": at.on_i[0], "bj": at.on_j[0]}
    unknown: Tree = {"direction": np.zeros(3), "cone": np.array([1.0, 0.0]), "ki": np.nan, "kj": np.nan}
    sizes: Tree = {"ri": ri, "rj": rj, "helix": joint.helix_angle, "outward": 1.0}
    return {"ui": at.ui, "uj": at.uj, **axes, **sizes, **unknown}


def add_gear(rows: RowBuilder, index: int, joint: Gear, ends: tuple[int, int], at: Geometry) -> None:
    """The row of a mesh."""
    count = (rows.next_counted_angle(), rows.next_counted_angle())
    rows.add(Gearing, index, ends, count=count, **tooth_columns(joint, at))


def _moment(pair: Pair, about: int, at: Geometry) -> tuple[Array, Array]:
    """Directions a of i and p of j whose right angle blocks the turn about a local axis: p x a points along it."""
    after, last = (about + 1) % 3, (about + 2) % 3
    if len(pair.turns) == 1:  # the shared axis of j stays across the third axis of i
        shared = AXES.index(pair.turns)
        third = 3 - shared - about
        sign = 1.0 if third == last else -1.0
        return sign * at.on_i[third], at.on_j[shared]
    if len(pair.turns) == 2:
        first, second = (AXES.index(name) for name in pair.turns)
        sign = -1.0 if first == after else 1.0
        return sign * at.on_i[first], at.on_j[second]
    return at.on_i[last], at.on_j[after]


def _about(at: Geometry, axis: int) -> Tree:
    """Angle of j's local axes to i's about an axis both share."""
    after = (axis + 1) % 3
    return {"a": at.on_i[axis], "b": at.on_i[after], "p": at.on_j[after]}


def add_freedom(
    rows: RowBuilder,
    index: int,
    joint: Joint,
    ends: tuple[int, int],
    at: Geometry,
    axis: Vector | None = None,
) -> list[str]:
    """Rows of a joint's freedoms; the names of those it has, that of a sphere only about a drive's ``axis``."""
    pair, names = joint.pair, []
    for name in joint.freedoms:
        if name.startswith("slide"):
            along = at.on_i[AXES.index(pair.slides[int(name[5:] or 1) - 1] if pair.slides else "x")]
            rows.add(Along, index, ends, ui=at.ui, uj=at.uj, axis=along, pitch=0.0)
        elif pair.ball:
            if axis is None:
                continue
            rows.add(
                Angle,
                index,
                ends,
                count=rows.next_counted_angle(),
                **_about_vector(np.asarray(axis, float), at),
            )
        elif name == "turn2":
            first, second = (AXES.index(k) for k in pair.turns)
            # seen from j, i's first axis turns the other way about j's second one
            a, p = -at.on_j[second], at.on_i[first]
            rows.add(Angle, index, ends[::-1], count=rows.next_counted_angle(), a=a, b=at.on_j[first], p=p)
        elif name == "turn1":
            first, second = (AXES.index(k) for k in pair.turns)
            a, p = at.on_i[first], at.on_j[second]
            rows.add(Angle, index, ends, count=rows.next_counted_angle(), a=a, b=at.on_i[second], p=p)
        else:
            rows.add(
                Angle, index, ends, count=rows.next_counted_angle(), **_about(at, AXES.index(pair.turns))
            )
        names.append(name)
    return names


def _about_vector(axis: Array, at: Geometry) -> Tree:
    """Angle about any axis of i, of directions with the same components in the joint's local axes of both links: across
    the axis and the local axis farthest from it, so that it does not matter in which axes a link is described."""
    a = at.on_i @ (axis / np.linalg.norm(axis))
    b = np.cross(a, np.eye(3)[np.abs(a).argmin()])
    b /= np.linalg.norm(b)
    return {"a": at.on_i.T @ a, "b": at.on_i.T @ b, "p": at.on_j.T @ b}


def hinge(joint: Any, ends: tuple[int, int], at: Geometry, drives: dict[str, int]) -> Hinge:
    """Rule by which the joint places one link from the other; ``drives`` are the drives' numbers by freedom."""
    pair = joint.pair
    names = [n for n in joint.freedoms if n.startswith("slide") and pair.slides]
    turning = (
        ["turn"]
        if len(pair.turns) == 1
        else ["turn1", "turn2"]
        if len(pair.turns) == 2
        else [""] * len(pair.turns)
    )
    driven = tuple(drives.get(name, -1) for name in [*names, *turning])
    return Hinge(
        *ends,
        at.ui,
        at.uj,
        numbers(at.on_i.T.ravel()),
        numbers(at.on_j.T.ravel()),
        tuple(AXES.index(k) for k in pair.slides),
        tuple(AXES.index(k) for k in pair.turns),
        driven,
        AXES.index(pair.turns) if len(pair.turns) == 1 else -1,
        *((joint.lead / (2 * np.pi), drives.get("slide", -1)) if pair.threaded else ()),
    )


def local_axes(joint: Joint, at: Geometry, on_i: Array, on_j: Array, moment: bool = False) -> Array:
    """The joint's local axes at poses of its links (..., 3, 3), a row each, in ground axes; rotations (..., 9) given.

    They are those of i, but where a turn is blocked between a direction of i and one of j: both, and their normal. A
    slotted sphere in a cylinder has them for its moment only; its forces keep to the cylinder.
    """
    pair = joint.pair
    if len(pair.turns) == 2 and (moment or pair.slides != "x"):
        first, second = (AXES.index(name) for name in pair.turns)
        n, p = space.rotate(on_i, at.on_i[first]), space.rotate(on_j, at.on_j[second])
        third = 3 - first - second
        axes = np.empty((*n.shape[:-1], 3, 3), np.result_type(n, p))
        axes[..., first, :], axes[..., second, :] = n, p
        axes[..., third, :] = space.cross(n, p) * (1.0 if (second - first) % 3 == 1 else -1.0)
        return axes
    return np.stack([space.rotate(on_i, e) for e in at.on_i], axis=-2)
