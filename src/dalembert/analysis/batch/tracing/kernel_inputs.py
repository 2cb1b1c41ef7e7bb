"""Inputs of the kernel along the positions: drives, changing loads, and the known motion where it is needed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from dalembert.analysis.batch.over_positions import is_cycle
from dalembert.analysis.batch.tracing.branches import Branch, place_on_branch
from dalembert.analysis.batch.tracing.traced_parameters import traced, varies
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.compile.pose_loads import TIME, counted_coordinates
from dalembert.analysis.engine.quick_pass import quick_answer
from dalembert.analysis.positions import Positions, positions
from dalembert.analysis.result.joint_freedoms import turns_off
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.overflow import size_sentence
from dalembert.arrays import Array, Ints, Numeric, Tree
from dalembert.core.constraints import measure
from dalembert.core.friction.contact_equations import bearing
from dalembert.core.layout import Pose
from dalembert.errors import ModelError
from dalembert.kernel.graph import POSITION, Graph, Node, Scalar
from dalembert.kernel.trace import Drives
from dalembert.model import Mechanism, Schedule


@dataclass(frozen=True)
class Course:
    """The mechanism with the file's numbers at a list of positions, followed when its motion is needed.

    With the ``result`` of the general executor, which may be of another design, its motion is that of the result.
    """

    mechanism: Mechanism
    schedule: Schedule
    result: Result | None = None
    target: Mapping[str, Array] | None = None
    """Values that each output is compared with (position, component)."""

    def with_target(self, target: Mapping[str, Array]) -> Course:
        """The same course, as far as it is followed."""
        found = copy(self)
        found.__dict__["target"] = target
        return found

    @cached_property
    def compiled(self) -> Compiled:
        return compile_mechanism(self.mechanism, self.schedule)

    @cached_property
    def followed(self) -> Positions:
        beyond = size_sentence(self.compiled)
        if beyond is not None:
            raise ModelError(beyond, "", ("links",))
        with np.errstate(all="ignore"):
            found = quick_answer(self.compiled, inertia=True, forces=False)
        return found if isinstance(found, Positions) else positions(self.compiled)

    @cached_property
    def cycle(self) -> bool:
        """True if its positions form a cycle; raises ModelError where they are not even."""
        drives = [self.mechanism.drives[name].turns for name in self.schedule.names]
        return is_cycle(self.schedule.position, drives)

    @cached_property
    def pose(self) -> Pose:
        """Its poses, NaN where it does not close."""
        if self.result is not None:
            return _poses_with_ground(self.result)
        path = self.followed.path
        assert path is not None
        lost = ~path.reached
        parts = [a.copy() for a in path.pose]
        for a in parts:
            a[lost] = np.nan
        return Pose(*parts)

    @cached_property
    def first(self) -> int:
        """The first position that closes."""
        if self.result is not None:
            return int(np.argmax(np.isfinite(self.pose.point).all(axis=(1, 2))))
        path = self.followed.path
        return int(np.argmax(path.reached)) if path is not None else 0

    def going_by(self, names: Iterable[str]) -> Tree:
        """Variables (P,) that a changing quantity depends on: drives, time, and the pose, the motion being known."""
        found: Tree = {name: self.schedule.position[:, k] for k, name in enumerate(self.schedule.names)}
        if TIME in names and TIME not in found and self.schedule.time is None:
            raise ModelError(
                "a load depends on time, but no times are given for these positions",
                "leave the positions out",
            )
        by_pose = [name for name in names if "." in name]
        at = counted_coordinates(self.compiled, self.counted, self.pose, by_pose) if by_pose else {}
        at = {name: np.where(np.isfinite(values), values, values[self.first]) for name, values in at.items()}
        return {TIME: self.schedule.time, **found, **at}

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
        """Sense (P,) of each contact where it reverses in the result, 0 where its rate gives it."""
        f = None if self.result is None else self.result.friction
        if self.result is None or f is None:
            return {}
        sense = np.where(f.reversing, f.sense, 0.0)
        return dict(zip(contact_keys(self.result.compiled), sense.T, strict=True))

    @property
    def counted(self) -> Compiled:
        """The mechanism with the full turns of its torsion springs counted along its motion."""
        return self.followed.compiled if self.result is None else self.result.compiled

    def at(self, positions: Array) -> Course:
        """Another list of positions, at the same speeds and accelerations."""
        count = len(positions)
        rates = [np.repeat(a[:1], count, axis=0) for a in (self.schedule.speed, self.schedule.acceleration)]
        schedule = replace(
            self.schedule, position=positions, speed=rates[0], acceleration=rates[1], time=None
        )
        return Course(self.mechanism, schedule)


@dataclass
class Inputs:
    """The inputs of a trace, each with the function that computes it for a course: channels (P,), common ones a number.

    followed: the motion is followed where the program runs, so that every branch, which `branches` lists, is an input.
    """

    graph: Graph
    course: Course
    followed: bool = False
    branches: list[Branch] = field(default_factory=list)
    found: dict[Node, Callable[[Course], Numeric]] = field(default_factory=dict)
    named: dict[tuple[str, str], Node] = field(default_factory=dict)
    varying: Tree = field(default_factory=dict)

    def make(self, kind: str, name: str, value: Callable[[Course], Numeric]) -> Node:
        """An input, made once."""
        if (kind, name) not in self.named:
            node = self.graph.input(kind, name, value(self.course))
            self.named[kind, name], self.found[node] = node, value
        return self.named[kind, name]

    def drives(self, symbolic: Mechanism, kind: str = "channel") -> Drives:
        """The drives' values; those that stay constant along the file's positions are constants of the trace."""
        names = self.course.schedule.names
        angular = self.course.compiled.layout.freedoms.angular[self.course.compiled.layout.driven]
        columns: dict[str, list[Node]] = {k: [] for k in ("q", "cos", "sin", "speed", "acceleration")}
        for k, name in enumerate(names):
            q = self._drive(kind, name, "position", k)
            columns["q"].append(q)
            for f, ufunc in (("cos", np.cos), ("sin", np.sin)):
                columns[f].append(
                    self._derivative(kind, f, name, k, ufunc) if angular[k] else self.graph.zero
                )
            for rate in ("speed", "acceleration"):
                given = getattr(symbolic.drives[name], rate)
                steady = np.ptp(getattr(self.course.schedule, rate)[:, k]) == 0
                value = getattr(self.course.schedule, rate)[0, k]
                node = given if isinstance(given, Node) else self.graph.constant(value) if steady else None
                columns[rate].append(self._drive(kind, name, rate, k) if node is None else node)
        return Drives(*(np.array(column, object) for column in columns.values()))

    def _drive(self, kind: str, name: str, what: str, k: int) -> Node:
        return self.make(kind, f"{what} {name}", lambda c: _one(kind, c, getattr(c.schedule, what)[:, k]))

    def _derivative(self, kind: str, f: str, name: str, k: int, ufunc: np.ufunc) -> Node:
        return self.make(kind, f"{f} {name}", lambda c: _one(kind, c, ufunc(c.schedule.position[:, k])))

    def load(self, name: str, varying: Any) -> Node:
        """A load that changes with the drives."""
        if varies(varying):
            found: Node = traced(name, varying, self.graph, self.load)
            return found
        self.varying[name] = varying
        return self.make(
            "channel",
            name,
            lambda c: np.broadcast_to(varying.at(c.going_by(varying.names)), (len(c.schedule.position),)),
        )

    def time(self) -> Node:
        """Time, of a law of motion."""
        return self.make("channel", TIME, lambda c: c.going_by((TIME,))[TIME])

    def path(self, kind: str) -> Callable[[str, int], Node]:
        """Quantities of the known motion."""

        def quantity(what: str, which: int) -> Node:
            return self.make(
                kind, f"known {what} {which}", lambda c: _one(kind, c, _known_quantity(c, what, which))
            )

        return quantity

    def slips(self, c: Compiled) -> Array:
        """Friction of each contact in a known solution; none where a radius or height of that design is zero."""
        return self._by_contact(c, "slip", lambda known: known.slips)

    def reversals(self, c: Compiled) -> Array:
        """Sense of each contact where it reverses in a known solution, else 0."""
        return self._by_contact(c, "reversal", lambda known: known.reversals)

    def side(self) -> Node:
        """1 just after reversals; -1, put in its place, just before."""
        return self.make("channel", "side", lambda c: np.ones(len(c.schedule.position)))

    def _by_contact(
        self, c: Compiled, what: str, of: Callable[[Course], dict[tuple[str, str], Array]]
    ) -> Array:
        def one(key: tuple[str, str]) -> Node:
            name = " ".join((f"known {what}", *key))
            return self.make("channel", name, lambda c: of(c).get(key, np.zeros(len(c.schedule.position))))

        return np.array([one(key) for key in contact_keys(c)], object)

    def turns(self, c: Compiled) -> tuple[Compiled, dict[int, Node]]:
        """The mechanism with full turns of its torsion springs as inputs, and for each such turn, by freedom, how far
        it may differ from the known motion before the count changes."""
        own, margins = c.forcing.resistances, {}
        turns = np.array([self.graph.zero] * len(own.row), object)
        for n in self.course.counted.counts:
            k = n.place
            turns[k] = self.make("channel", f"counted turns of {n.spring}", partial(_turns, place=k))
            margin = self.make("channel", f"counted margin of {n.spring}", partial(_margin, place=k))
            margins[int(own.row[k])] = margin
        forcing = replace(c.forcing, resistances=replace(own, turns=turns))
        return replace(c, forcing=forcing), margins

    def whole_turns(self, c: Compiled, row: int) -> Numeric:
        """Value added to the measured value of a freedom, so that it is counted as in a result."""
        own = c.forcing.resistances
        for n in self.course.counted.counts:
            if own.row[n.place] == row:
                counted: Scalar = own.turns[n.place]
                return counted
        name = "joints.{}.{}".format(*c.freedoms[row])
        if name in self.course.counted.pose_turns:
            return self.pose_turns(name)
        if row in c.layout.driven or not c.layout.freedoms.angular[row]:
            return 0.0
        return self.make("common", f"whole turns of freedom {row}", partial(_turns_off, row=row))

    def pose_turns(self, name: str) -> Numeric:
        """Whole turns of an angle that a load depends on, 0 where none are counted."""
        if name not in self.course.counted.pose_turns:
            return 0.0
        return self.make("channel", f"counted turns of {name}", partial(_pose_turns, name=name))

    def signs(self, plus: tuple[Scalar, ...], minus: tuple[Scalar, ...], a: int, b: int) -> Scalar:
        """Sign of the rotation of link b against link a in the known motion: 1 or -1, or an input if it changes."""
        kind = "channel" if any(n.level & POSITION for n in plus if isinstance(n, Node)) else "common"
        signs = self._signs(self.course, kind, plus, minus, a, b)
        if not self.followed and ((signs >= 0).all() or (signs <= 0).all()):
            return 1.0 if signs.sum() >= 0 else -1.0

        def along(c: Course) -> Array:
            found = _carry_sign_forward(self._signs(c, kind, plus, minus, a, b))
            return np.broadcast_to(found, (len(c.schedule.position),))

        sign = self.make("channel", f"way {a} {b} {len(self.named)}", along)
        self.branches.append(Branch(sign, plus, minus, a, b))
        return sign

    def phases(self, known: Array, rows: Ints) -> Array:
        """Targets (K,) of meshing and rolling wheels that are inputs, those of the known motion here."""
        out = known.astype(object)
        for row in rows:
            along = partial(_constant, value=float(known[row]))
            out[row] = self.make("channel", f"phase {row}", along)
        return out

    def _signs(
        self, c: Course, kind: str, plus: tuple[Scalar, ...], minus: tuple[Scalar, ...], a: int, b: int
    ) -> Array:
        values = {} if c is self.course else {n.index: f(c) for n, f in self.found.items()}
        nodes = [n if isinstance(n, Node) else self.graph.constant(n) for n in (*plus, *minus)]
        ways = np.array(np.broadcast_arrays(*self.graph.evaluate(nodes, values)))
        known = place_on_branch(c.pose, len(plus), a, b)
        if kind == "common":
            known = known[:, [c.first]]
        off = [np.linalg.norm(way - known, axis=0) for way in np.split(ways.reshape(2 * len(plus), -1), 2)]
        gain = np.nan_to_num(off[1] - off[0])
        return np.where(np.abs(gain) > 1e-5 * np.nanmax(np.abs(known)), np.sign(gain), 0.0)


def target_values(course: Course, output: str, component: int) -> Array:
    """Values (P,) that one component of an output is compared with."""
    if course.target is None:
        return np.zeros(len(course.schedule.position))
    return np.asarray(course.target[output][:, component])


def _constant(course: Course, value: float) -> Array:
    """The same value at every position (P,)."""
    return np.full(len(course.schedule.position), value)


def _turns(course: Course, place: int) -> Array:
    """Contribution of the full turns to the turn of a torsion spring (P,)."""
    c = course.counted
    turns = c.forcing.resistances.turns
    return turns[:, place] if turns.ndim > 1 else np.zeros(len(c.schedule.position))


def _turns_off(course: Course, row: int) -> float:
    """Whole turns by which a freedom is counted less than measured, so that it begins within half a turn of 0."""
    return turns_off(
        measure(course.compiled.layout.algebra, course.compiled.layout.freedoms, course.pose)[:, row]
    )


def _pose_turns(course: Course, name: str) -> Array:
    """Contribution of the full turns to an angle that a load depends on (P,)."""
    return course.counted.pose_turns.get(name, np.zeros(len(course.schedule.position)))


def _margin(course: Course, place: int) -> Array:
    """Margin (P,) by which that turn may differ where it is counted; 0 where it was not."""
    c = course.counted
    return next((n.margin for n in c.counts if n.place == place), np.zeros(len(c.schedule.position)))


def contact_keys(c: Compiled) -> list[tuple[str, str]]:
    """Joint and kind of each contact, numbered from the second of a kind in a joint on."""
    keys: list[tuple[str, str]] = []
    for k, kind in zip(c.contacts.joint, c.contacts.kind, strict=True) if c.contacts is not None else ():
        same = sum(joint == c.joints[k] and name.split()[0] == kind for joint, name in keys)
        keys.append((c.joints[k], f"{kind} {same + 1}" if same else kind))
    return keys


def _poses_with_ground(result: Result) -> Pose:
    """Poses of a result, with those of the ground."""
    point = np.pad(result.point_array, ((0, 0), (0, 1), (0, 0)))
    return Pose(point, *result.compiled.layout.algebra.with_ground(result.turn_array, result.rotation_array))


def _one(kind: str, c: Course, column: Array) -> Numeric:
    return column if kind == "channel" else column[c.first]


def _carry_sign_forward(signs: Array) -> Array:
    """Sign of the position before, where both branches coincide."""
    places = np.maximum.accumulate(np.where(signs != 0, np.arange(len(signs)), -1))
    first = signs[np.argmax(signs != 0)]
    return np.where(places >= 0, signs[np.maximum(places, 0)], first)


def _known_quantity(c: Course, what: str, which: int) -> Array:
    """One quantity of the known motion (P,)."""
    if what.startswith("line"):
        angle = _line_angle(c, which)
        return np.cos(angle) if what.endswith("cos") else np.sin(angle) if what.endswith("sin") else angle
    pose = c.pose
    kind, _, component = what.partition(" ")
    if component.isdigit():
        return np.asarray(getattr(pose, kind)[:, which, int(component)])
    columns = {
        "x": (pose.point, 0),
        "y": (pose.point, 1),
        "turn cos": (pose.rotation, 0),
        "turn sin": (pose.rotation, 1),
    }
    if what == "turn":
        return np.asarray(pose.turn[:, which])
    array, place = columns[what]
    return np.asarray(array[:, which, place])


def _line_angle(c: Course, row: int) -> Array:
    """Angle of the line of centres of a mesh, full turns counted as the mesh counts them."""
    from dalembert.core.layout import Mesh

    followed = c.followed.compiled
    for f in followed.layout.stack.families:
        if isinstance(f, Mesh) and row in f.row:
            k = int(np.flatnonzero(f.row == row)[0])
            ri, rj = float(f.ri[k]), float(f.rj[k])
            turned = ri * c.pose.turn[:, f.i[k]] + rj * c.pose.turn[:, f.j[k]]
            return np.asarray((turned - followed.target[row]) / (ri + rj))
    raise KeyError(row)
