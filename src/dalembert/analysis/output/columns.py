"""The numbers of a result as columns and entries: each named, with its kind of unit; what its writers share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.result.link_motion import ORIGIN
from dalembert.analysis.result.named_quantities import things
from dalembert.analysis.result.number_kinds import in_plane, unknown_kinds
from dalembert.analysis.result.quantity_catalogue import CATALOGUE, FREEDOMS, QuantityReading, magnitude
from dalembert.analysis.result.reaction_axes import Axes, force_and_moment, to_axes
from dalembert.answer.column import Column, parts
from dalembert.arrays import Array
from dalembert.model.links.link import CENTER

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class JointReaction(NamedTuple):
    """Force (P, d) and moment (P,) or (P, 3) of a joint's i on its j, NaN if not unique; least norm (P, n)."""

    joint: str
    on: str
    by: str
    force: Array
    moment: Array
    least_norm: Array | None


def reactions(result: Result, axes: Axes = "ground") -> Iterator[JointReaction]:
    """The reaction of every joint on its j."""
    for joint in result.joints:
        by, on = result.mechanism.joints[joint].links
        force, moment = result.reaction(joint, on, axes), result.reaction_moment(joint, on, axes)
        least = None if result.unique(joint).all() else result.least_norm(joint, on, axes)
        yield JointReaction(joint, on, by, force, moment, least)


class Entry(NamedTuple):
    """A quantity of one thing, by the parts of its name (docs/quantities.md), with its kind and SI values (P, ...)."""

    word: str
    thing: str
    rate: str
    kind: str
    values: Array

    @property
    def name(self) -> str:
        """Its name, without a component."""
        return ".".join(filter(None, (self.word, self.thing, self.rate)))

    @property
    def keys(self) -> tuple[str, ...]:
        """Its keys in the JSON answer: a quantity with rates has its value under `value`."""
        rated = set(CATALOGUE[self.word].rates) - {"", "low", "high"}
        rate = self.rate or ("value" if rated else "")
        return tuple(filter(None, (self.word, *self.thing.split("."), rate)))


UNKNOWN = ("effort", "load")
BY_FRICTION = (
    *UNKNOWN,
    *("reaction", "reaction_moment", "friction_force", "friction_moment", "power", "power_lost"),
)
"""Quantities that jump where contacts reverse; of efforts and loads friction may leave an interval open."""
MOTION = (*FREEDOMS, "angle", "rotation", "point")
CHECKS = ("residual", "power_balance")
GIVEN = ("time", "drive", "turning_speed", "turning_torque")
"""Prescribed quantities, or ones that may be, as the speed of a turning frame."""

ELEMENTS = ("pressure", "flow", "screw_torque")
"""Quantities of drives that are machine elements; bearings have separate tables."""


def entries(
    result: Result, words: Sequence[str], axes: Axes = "ground", every: bool = False
) -> Iterator[Entry]:
    """The quantities of a result that begin with some words, reactions and friction in the axes asked for.

    Friction is that of the joints that have it, or, so that arrays are complete, of ``every`` joint.
    """
    rubbing = result.joints if every and result.friction is not None else friction_joints(result)
    for word in words:
        row = CATALOGUE[word]
        for thing in _written_things(result, word, rubbing):
            for rate, reading in row.rates.items():
                if rate in ("low", "high") or (rate == "" and word == "angle" and not in_plane(result)):
                    continue
                kind = reading.kind if isinstance(reading.kind, str) else reading.kind(result, thing)
                yield Entry(word, thing, rate, kind, _values(result, word, thing, reading, axes))


def _written_things(result: Result, word: str, rubbing: Sequence[str]) -> Sequence[str]:
    if word == "point":
        return [f"{link}.{point}" for link in result.links for point in (ORIGIN, CENTER)]
    if word == "load":
        return result.unknown_loads
    if word == "rotation" and in_plane(result):
        return ()
    if word in ELEMENTS:
        return [name for name in things(result, CATALOGUE[word].of) if name in result.drives]
    return rubbing if CATALOGUE[word].friction else things(result, CATALOGUE[word].of)


def _values(result: Result, word: str, thing: str, reading: QuantityReading, axes: Axes) -> Array:
    if word in ("reaction", "reaction_moment"):
        return np.asarray(getattr(result, word)(thing, axes=axes))
    if word in ("friction_force", "friction_moment"):
        return friction_in(result, thing, axes)[word == "friction_moment"]
    return np.asarray(reading.read(result, thing))


def least_norms(result: Result, axes: Axes) -> Iterator[Entry]:
    """The reactions of least norm of the joints whose reactions are not unique."""
    for r in reactions(result, axes):
        if r.least_norm is not None:
            force, moment = force_and_moment(r.least_norm)
            yield Entry("reaction", r.joint, "least_norm", "force", force)
            yield Entry("reaction_moment", r.joint, "least_norm", "moment", moment)


def bounds(result: Result, axes: Axes, every: bool = False) -> Iterator[Entry]:
    """Low and high of what friction leaves open at rest; where contacts reverse, of the numbers before and after."""
    words = BY_FRICTION if result.after is not None else UNKNOWN if result.ends else ()
    sides = [list(entries(side, words, axes, every)) for side in result.sides]
    for each in zip(*sides, strict=True):
        e, values = each[0], [one.values for one in each]
        ends = np.minimum.reduce(values), np.maximum.reduce(values)
        if e.word in UNKNOWN and e.thing in unknown_kinds(result):
            ends = tuple(result.interval(e.thing).T)
        for rate, end in zip(("low", "high"), ends, strict=True):
            yield e._replace(rate=rate, values=end)


def columns(result: Result, axes: Axes = "ground") -> Iterator[Column]:
    """Every number of a result: drives, efforts, unknown loads, reactions and their sizes, joints' slides and turns,
    links, points, residual, power balance; low and high of what friction leaves open."""
    for e in chain(
        entries(result, (*GIVEN, *BY_FRICTION), axes),
        least_norms(result, axes),
        entries(result, (*ELEMENTS, *MOTION, *CHECKS), axes),
        bounds(result, axes),
    ):
        for part, values in parts(e.values):
            yield Column(f"{e.name}{part}", e.kind, values)
        if e.name == f"reaction.{e.thing}":
            yield Column(f"{e.name}.magnitude", e.kind, np.asarray(magnitude(e.values)))


def friction_joints(result: Result) -> list[str]:
    """Joints with dry or viscous friction, where friction is on."""
    if result.friction is None:
        return []
    from dalembert.analysis.compile.load_arrays import joint_damping

    joints = result.mechanism.joints
    lossy = [n for n in result.joints for key in ("friction", "efficiency") if getattr(joints[n], key, None)]
    return [n for n in result.joints if n in lossy or joint_damping(joints[n])]


def friction_in(result: Result, joint: str, axes: Axes) -> tuple[Array, Array]:
    """Dry friction's force and moment in a joint, on j, in the axes of the reactions."""
    force, moment = result.friction_force(joint), result.friction_moment(joint)
    components = np.concatenate([force, moment.reshape((len(moment), -1))], axis=-1)
    return force_and_moment(to_axes(result, joint, None, axes, components))
