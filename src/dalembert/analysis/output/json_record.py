"""The JSON answer of the model file's contract (section 6), made position by position."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.compile.torsion_turns import count_turns, two_directions
from dalembert.analysis.friction.joint_friction import bears_on_faces, guide_contact, joints_at_limit
from dalembert.analysis.output.columns import (
    BY_FRICTION,
    CHECKS,
    ELEMENTS,
    GIVEN,
    MOTION,
    Entry,
    bounds,
    entries,
    friction_joints,
    least_norms,
)
from dalembert.analysis.output.summary.printed_shapes import shape_record
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.number_kinds import in_plane, unknown_kinds
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.answer.column import Scale, UnitChoice, nan_to_none
from dalembert.answer.record import VERSION
from dalembert.arrays import Array, Tree

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def head(result: Result, units: UnitChoice = "SI", axes: Axes = "ground") -> Tree:
    """Part that precedes the positions: title, units, assumptions, mobility."""
    to = result.scale(units)
    mobility = result.mobility
    return {
        "dalembert": VERSION,
        "title": result.mechanism.title,
        "units": to.names(),
        "reaction_axes": axes,
        "friction": not result.assumptions["friction"].startswith("off"),
        "assumptions": dict(result.assumptions),
        "mobility": None
        if mobility is None
        else {
            "freedoms": mobility.freedoms,
            "drives": mobility.drives,
            "redundant": mobility.redundant,
            "redundant_joints": list(mobility.redundant_joints),
            **({} if in_plane(result) else {"passive": list(mobility.passive)}),
        },
        "assembly_mode": result.mode,
        "joints": {
            name: dict(zip(("by", "on"), result.mechanism.joints[name].links, strict=True))
            for name in result.joints
        },
        **_counts(result, to),
        **({"mass_properties": shapes} if (shapes := shape_record(result, to)) else {}),
    }


def _counts(result: Result, to: Scale) -> Tree:
    """Counts of the turns of torsion springs for which full turns matter."""
    c, turns = result.compiled, count_turns(result.compiled, full_pose(result))
    counts = {
        n.spring: {
            "joint": c.freedoms[c.forcing.resistances.row[n.place]][0],
            "freedom": c.freedoms[c.forcing.resistances.row[n.place]][1],
            "within_half_a_turn_of": float(to("angle", n.near)),
            "stated": n.stated,
            "two_readings": two_directions(c, n, turns[n.spring]),
        }
        for n in c.counts
    }
    return {"counted_turns": counts} if counts else {}


def position_records(
    result: Result, units: UnitChoice = "SI", axes: Axes = "ground", others: bool = False
) -> Iterator[Tree]:
    """One mapping a position, made a block at a time; ``others`` seeks the other solutions of friction."""
    fields = _fields(result, result.scale(units), axes)
    sought = _other_solutions(result, result.scale(units)) if others else {}
    for part in result.blocks(len(result.status)):
        groups = _transpose({name: lists(part) for name, lists in fields.items()})
        yield from (
            _with_others(_record(result, k, group), sought.get(k))
            for k, group in enumerate(groups, part.start)
        )


Lists = Callable[[slice], list[object]]


Fields = dict[tuple[str, ...], Lists]
"""Keys down the record -> its values of some positions, as lists with None for NaN."""


def _fields(result: Result, to: Scale, axes: Axes) -> Fields:
    """All possible fields of a record."""
    numbers, kinds = _numbers(to), unknown_kinds(result)
    out = _of(to, entries(result, GIVEN))
    if result.after is not None:
        out |= _side_fields(result, to, axes)
    out |= _force_fields(result, to, axes)
    if result.ends and result.mechanism.turning is not None:
        speeds = numbers("angular_speed", result.turning_interval)
        out["turning_speed",] = _ranges(out["turning_speed",], speeds, result.status)
    for name, kind in kinds.items() if result.ends else ():
        word = "effort" if name in result.drives else "load"
        out[word, name] = _ranges(out[word, name], numbers(kind, result.interval(name)), result.status)
        out["holding", name] = _holding_ranges(numbers(kind, result.holding(name)), result.holding(name))
    for name, ends in zip(kinds, result.ends, strict=False):
        for which, end in zip(("low", "high"), ends, strict=True):
            out |= _under(_force_fields(end, to, axes, BY_FRICTION[2:]), "ends", name, which)
            out["ends", name, which, "at_limit"] = _limits(end)
    out |= _of(to, entries(result, (*ELEMENTS, *MOTION)))
    for spring, turn in count_turns(result.compiled, full_pose(result)).items():
        out["spring_turns", spring] = numbers("angle", turn)
    return out | _of(to, entries(result, CHECKS))


def _of(to: Scale, some: Iterable[Entry]) -> Fields:
    numbers = _numbers(to)
    return {q.keys: numbers(q.kind, q.values) for q in some}


def _under(some: Fields, *keys: str) -> Fields:
    return {(*keys, *path): lists for path, lists in some.items()}


def _side_fields(result: Result, to: Scale, axes: Axes) -> Fields:
    """Everything just after reversals, and the low and the high of both sides."""
    behind = result.sides[1]
    after = _force_fields(behind, to, axes) | _of(to, entries(behind, CHECKS))
    numbers = _numbers(to)
    ends = {(e.rate, *e._replace(rate="").keys): numbers(e.kind, e.values) for e in bounds(result, axes)}
    return _under(after, "after") | ends


def _force_fields(result: Result, to: Scale, axes: Axes, words: Sequence[str] = BY_FRICTION) -> Fields:
    """Efforts, unknown loads, reactions, and what friction does in them."""
    numbers = _numbers(to)
    out = _of(to, entries(result, words, axes))
    for e in least_norms(result, axes):
        out["least_norm", e.word, e.thing] = numbers(e.kind, e.values)
    for joint in result.joints if axes == "joint" else ():
        of_force, of_moment = (result.joint_axes(joint, moment) for moment in (False, True))
        out["joint_axes", joint, "force"] = numbers("number", of_force)
        if not np.array_equal(of_force, of_moment, equal_nan=True):
            out["joint_axes", joint, "moment"] = numbers("number", of_moment)
    for joint in friction_joints(result):
        if bears_on_faces(result, joint):
            contact = guide_contact(result, joint)
            out["contact", joint, "mode"] = _words(contact.mode)
            out["contact", joint, "lower"] = numbers("force", contact.lower)
            out["contact", joint, "upper"] = numbers("force", contact.upper)
    return out


def _numbers(to: Scale) -> Callable[[str, Array], Lists]:
    """A kind and SI values -> some positions' values in the reader's unit."""

    def numbers(kind: str, values: Array) -> Lists:
        scaled = to(kind, values)
        return lambda part: nan_to_none(scaled[part])

    return numbers


def _words(words: tuple[str, ...]) -> Lists:
    return lambda part: [word or None for word in words[part]]


def _limits(end: Result) -> Lists:
    """Joints whose friction is at its limit, position by position."""
    return lambda part: [list(joints_at_limit(end, k)) for k in range(*part.indices(len(end.status)))]


def _ranges(single: Lists, ends: Lists, status: tuple[str, ...]) -> Lists:
    """The number, or `[low, high]` where friction leaves it open."""

    def lists(part: slice) -> list[object]:
        rows = zip(single(part), ends(part), status[part], strict=True)
        return [both if word == "at_rest" else number for number, both, word in rows]

    return lists


def _holding_ranges(ends: Lists, values: Array) -> Lists:
    """`[low, high]`, null where unbounded; None where it is not computed."""
    unsought = np.asarray(np.isnan(values).all(axis=-1))
    return lambda part: [None if no else both for both, no in zip(ends(part), unsought[part], strict=True)]


def _transpose(lists: dict[tuple[str, ...], list[object]]) -> Iterator[dict[tuple[str, ...], object]]:
    for row in zip(*lists.values(), strict=True):
        yield dict(zip(lists, row, strict=True))


def _record(result: Result, position: int, values: dict[tuple[str, ...], object]) -> Tree:
    status, reason = result.status[position], result.reasons[position]
    record: Tree = {"status": status}
    if reason is not None:
        record["reason"] = reason
    if result.stability is not None and result.stability[position] is not None:
        record["stability"] = result.stability[position]
    reverses = bool(result.reverses[position])
    if result.friction is not None:
        record["friction"] = _solution(result, position)
    if reverses and result.after is not None and result.friction is not None:
        record["after"] = {"friction": _solution(result.after, position)}
    for path, value in values.items():
        if path[0] in ("ends", "holding") and (status != "at_rest" or value is None):
            continue
        if path[0] in SIDES and not reverses:
            continue
        place = record
        for key in path[:-1]:
            place = place.setdefault(key, {})
        place[path[-1]] = value
    return record


SIDES = ("after", "low", "high")
"""Keys of a position where contacts reverse: what holds just after, and the low and the high of both sides."""


def _solution(result: Result, position: int) -> Tree:
    """Certainty of the branch: det(A + J) / det(A), whether another exists, and the scale at which it jams."""
    f = result.friction
    assert f is not None
    determinant, critical = nan_to_none(np.array([f.determinant[position], f.critical[position]]))
    if result.status[position] == "at_rest":
        determinant = None
    return {
        "determinant_ratio": determinant,
        "only_solution": bool(f.single[position]),
        "critical_scale": critical,
    }


def _other_solutions(result: Result, to: Scale) -> dict[int, list[Tree]]:
    """Other solutions from `--other-solutions` at each position where they were sought."""
    from dalembert.analysis.friction.other_solutions import every_other_solution

    kinds = unknown_kinds(result)
    return {
        k: [
            {
                group: {
                    name: float(to(kinds[name], v))
                    for name, v in s.unknowns.items()
                    if (name in result.drives) == drive
                }
                for group, drive in (("effort", True), ("load", False))
            }
            | {"determinant_ratio": s.determinant}
            for s in solutions
        ]
        for k, solutions in every_other_solution(result).items()
    }


def _with_others(record: Tree, others: list[Tree] | None) -> Tree:
    if others is not None:
        record["friction"]["other_solutions"] = others
    return record
