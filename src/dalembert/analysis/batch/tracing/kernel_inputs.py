"""Inputs of the kernel along the positions: drives, changing loads, and the known motion where it is needed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from dalembert.analysis.batch.tracing.branches import Branch, place_on_branch
from dalembert.analysis.batch.tracing.course import PositionPath, contact_keys
from dalembert.analysis.batch.tracing.traced_parameters import is_shifted, is_table, traced, varies
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.compile.pose_loads import SPEED, TIME
from dalembert.analysis.result.joint_freedoms import turns_off
from dalembert.arrays import Array, Ints, Numeric, Tree
from dalembert.core.constraints import measure
from dalembert.kernel.graph import POSITION, Graph, Node, Scalar
from dalembert.kernel.trace import Drives
from dalembert.model import Mechanism


@dataclass
class Inputs:
    """The inputs of a trace, each with the function that computes it for a course: channels (P,), common ones a number.

    followed: the motion is followed where the program runs, so that every branch, which `branches` lists, is an input.
    """

    graph: Graph
    course: PositionPath
    followed: bool = False
    branches: list[Branch] = field(default_factory=list)
    sources: dict[Node, Callable[[PositionPath], Numeric]] = field(default_factory=dict)
    named: dict[tuple[str, str], Node] = field(default_factory=dict)
    varying: Tree = field(default_factory=dict)
    motion: Drives = field(init=False)

    def make(self, kind: str, name: str, value: Callable[[PositionPath], Numeric]) -> Node:
        """An input, made once."""
        if (kind, name) not in self.named:
            node = self.graph.input(kind, name, value(self.course))
            self.named[kind, name], self.sources[node] = node, value
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
                symbol = getattr(symbolic.drives[name], rate)
                steady = np.ptp(getattr(self.course.schedule, rate)[:, k]) == 0
                value = getattr(self.course.schedule, rate)[0, k]
                node = symbol if isinstance(symbol, Node) else self.graph.constant(value) if steady else None
                columns[rate].append(self._drive(kind, name, rate, k) if node is None else node)
        result = Drives(*(np.array(column, object) for column in columns.values()))
        if kind == "channel":
            self.motion = result
        return result

    def known(self) -> Tree:
        """Time, positions and speeds of the drives by the names that changing quantities have for them."""
        names, s = self.course.schedule.names, self.course.schedule
        out = dict(zip(names, self.motion.position, strict=True))
        out |= dict(zip((name + SPEED for name in names), self.motion.speed, strict=True))
        return out | ({} if s.clock is None else {TIME: self.time()})

    def inside(self, varying: Any) -> bool:
        """True if a changing quantity depends on something that a design's numbers may move."""
        timed = TIME in varying.names and self.course.schedule.time is None
        return timed or is_shifted(varying) or any("." in name for name in varying.names)

    def _drive(self, kind: str, name: str, what: str, k: int) -> Node:
        return self.make(kind, f"{what} {name}", lambda c: _one(kind, c, getattr(c.schedule, what)[:, k]))

    def _derivative(self, kind: str, f: str, name: str, k: int, ufunc: np.ufunc) -> Node:
        return self.make(kind, f"{f} {name}", lambda c: _one(kind, c, ufunc(c.schedule.position[:, k])))

    def load(self, name: str, varying: Any) -> Node:
        """A load that changes with the drives."""
        if varies(varying) and is_table(varying) and self.inside(varying):
            self.varying[name] = varying
            return self.make("channel", name, partial(_constant, value=0.0))
        if varies(varying):
            node: Node = traced(name, varying, self.graph, self.load)
            return node
        self.varying[name] = varying
        return self.make(
            "channel",
            name,
            lambda c: np.broadcast_to(varying.at(c.going_by(varying.names)), (len(c.schedule.position),)),
        )

    def time(self) -> Node:
        """Time, of a law of motion, or as the first drive of constant speed has it."""
        s = self.course.schedule
        if s.time is None and s.count == 1:
            return self.graph.zero
        if s.time is None and s.clock is not None and s.began is not None:
            k = int(np.argmax((s.speed != 0).any(axis=0)))
            clock: Node = (self.motion.position[k] - float(s.began[k])) / self.motion.speed[k]
            return clock
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
        self, c: Compiled, what: str, of: Callable[[PositionPath], dict[tuple[str, str], Array]]
    ) -> Array:
        def one(key: tuple[str, str]) -> Node:
            name = " ".join((f"known {what}", *key))
            return self.make("channel", name, lambda c: of(c).get(key, np.zeros(len(c.schedule.position))))

        return np.array([one(key) for key in contact_keys(c)], object)

    def turns(self, c: Compiled) -> tuple[Compiled, dict[int, Node]]:
        """The mechanism with full turns of its torsion springs as inputs, and for each such turn, by freedom, how far
        it may differ from the known motion before the count changes."""
        resistances, margins = c.forcing.resistances, {}
        turns = np.array([self.graph.zero] * len(resistances.row), object)
        for n in self.course.counted.counts:
            k = n.place
            turns[k] = self.make("channel", f"counted turns of {n.spring}", partial(_turns, place=k))
            margin = self.make("channel", f"counted margin of {n.spring}", partial(_margin, place=k))
            margins[int(resistances.row[k])] = margin
        forcing = replace(c.forcing, resistances=replace(resistances, turns=turns))
        return replace(c, forcing=forcing), margins

    def whole_turns(self, c: Compiled, row: int) -> Numeric:
        """Value added to the measured value of a freedom, so that it is counted as in a result."""
        resistances = c.forcing.resistances
        for n in self.course.counted.counts:
            if resistances.row[n.place] == row:
                counted: Scalar = resistances.turns[n.place]
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

        def along(c: PositionPath) -> Array:
            signs = _carry_sign_forward(self._signs(c, kind, plus, minus, a, b))
            return np.broadcast_to(signs, (len(c.schedule.position),))

        sign = self.make("channel", f"sense {a} {b} {len(self.named)}", along)
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
        self, c: PositionPath, kind: str, plus: tuple[Scalar, ...], minus: tuple[Scalar, ...], a: int, b: int
    ) -> Array:
        values = {} if c is self.course else {n.index: f(c) for n, f in self.sources.items()}
        nodes = [n if isinstance(n, Node) else self.graph.constant(n) for n in (*plus, *minus)]
        both = np.array(np.broadcast_arrays(*self.graph.evaluate(nodes, values)))
        known = place_on_branch(c.pose, len(plus), a, b)
        if kind == "common":
            known = known[:, [c.first]]
        off = [np.linalg.norm(one - known, axis=0) for one in np.split(both.reshape(2 * len(plus), -1), 2)]
        gain = np.nan_to_num(off[1] - off[0])
        return np.where(np.abs(gain) > 1e-5 * np.nanmax(np.abs(known)), np.sign(gain), 0.0)


def target_values(course: PositionPath, output: str, component: int) -> Array:
    """Values (P,) that one component of an output is compared with."""
    if course.target is None:
        return np.zeros(len(course.schedule.position))
    return np.asarray(course.target[output][:, component])


def _constant(course: PositionPath, value: float) -> Array:
    """The same value at every position (P,)."""
    return np.full(len(course.schedule.position), value)


def _turns(course: PositionPath, place: int) -> Array:
    """Contribution of the full turns to the turn of a torsion spring (P,)."""
    c = course.counted
    turns = c.forcing.resistances.turns
    return turns[:, place] if turns.ndim > 1 else np.zeros(len(c.schedule.position))


def _turns_off(course: PositionPath, row: int) -> float:
    """Whole turns by which a freedom is counted less than measured, so that it begins within half a turn of 0."""
    return turns_off(
        measure(course.compiled.layout.algebra, course.compiled.layout.freedoms, course.pose)[:, row]
    )


def _pose_turns(course: PositionPath, name: str) -> Array:
    """Contribution of the full turns to an angle that a load depends on (P,)."""
    return course.counted.pose_turns.get(name, np.zeros(len(course.schedule.position)))


def _margin(course: PositionPath, place: int) -> Array:
    """Margin (P,) by which that turn may differ where it is counted; 0 where it was not."""
    c = course.counted
    return next((n.margin for n in c.counts if n.place == place), np.zeros(len(c.schedule.position)))


def _one(kind: str, c: PositionPath, column: Array) -> Numeric:
    return column if kind == "channel" else column[c.first]


def _carry_sign_forward(signs: Array) -> Array:
    """Sign of the position before, where both branches coincide."""
    places = np.maximum.accumulate(np.where(signs != 0, np.arange(len(signs)), -1))
    first = signs[np.argmax(signs != 0)]
    return np.where(places >= 0, signs[np.maximum(places, 0)], first)


def _known_quantity(c: PositionPath, what: str, which: int) -> Array:
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


def _line_angle(c: PositionPath, row: int) -> Array:
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
