"""Free bodies' equations: letters, numbers, results; the whole matrix equation."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.actions import Action, actions, joint_place, on_link, slide_direction
from dalembert.report.sheet import Matrix, Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

MOST = 15
"""Unknowns of a matrix equation that is printed whole."""


class About(NamedTuple):
    """The point that moments are taken about: its name and place (metres)."""

    name: str
    place: Any


def moment_point(r: Result, link: str, k: int, wanted: str = "") -> About:
    """A joint of one's choice if the link has it, else the mass centre, else the first joint."""
    joints = [name for name, d in r.mechanism.joints.items() if link in d.links]
    if wanted in joints:
        return About(wanted, joint_place(r, wanted)[k])
    if r.mechanism.mass(link) or not joints:
        return About("G", r.center(link)[k])
    return About(joints[0], joint_place(r, joints[0])[k])


def link_equations(
    r: Result, link: str, k: int, shown: Shown, wanted: str = ""
) -> tuple[list[Working], About]:
    """Sums of forces along x and y and of moments, each in letters, with numbers, and its value."""
    about = moment_point(r, link, k, wanted)
    terms = [_Term(r, a, k, shown, about) for a in on_link(actions(r), link)]
    terms = [t for t in terms if t.counts]
    lines = []
    for axis in (0, 1):
        used = [t for t in terms if t.forced]
        letters = " + ".join(t.component(axis) for t in used) or "0"
        numbers = _joined([t.force[axis] for t in used], shown)
        total = math.fsum(t.force[axis] for t in used)
        lines.append(_line(f"sum F_{{{'xy'[axis]}}}", letters, numbers, total, terms, shown, "force"))
    letters = _signed([part for t in terms for part in t.moment_letters()])
    numbers = _signed([part for t in terms for part in t.moment_numbers()])
    total = math.fsum(t.moment for t in terms)
    lines.append(_line(f"sum M_{{{about.name}}}", letters, numbers, total, terms, shown, "moment"))
    return lines, about


def _line(
    left: str, letters: str, numbers: str, total: float, terms: list[_Term], shown: Shown, kind: str
) -> Working:
    largest = max((t.size(kind) for t in terms), default=0.0)
    shown_total = shown.notation.number(0.0 if abs(total) < 1e-9 * largest else total)
    return Working(f"{left}: quad {letters} = 0", f'{numbers} = {shown_total} "{shown.unit(kind)}"')


def _joined(values: list[float], shown: Shown) -> str:
    return _signed([(v < 0, shown.notation.number(abs(v))) for v in values])


def _signed(parts: list[tuple[bool, str]]) -> str:
    """Terms with their signs between them."""
    out = ""
    for n, (minus, text) in enumerate(parts):
        out += ("−" if minus else "") + text if n == 0 else f" {'−' if minus else '+'} {text}"
    return out or "0"


class _Term:
    """One action in the equations of its link, in the reader's units and axes."""

    def __init__(self, r: Result, a: Action, k: int, shown: Shown, about: About) -> None:
        self.action, self.shown = a, shown
        self.symbol = shown.symbol(a)
        turn = np.array(0.0 if shown.notation.axes == "ground" else float(r.angle(a.link)[k]))
        axes = plane.rotation(turn)
        force, arm = plane.unrotate(axes, a.force[k]), plane.unrotate(axes, a.at[k] - np.asarray(about.place))
        scale = abs(shown.value("force", 1.0))
        length = shown.value("length", 1.0)
        largest = float(np.nanmax(np.abs(r.force_array[k]), initial=0.0))
        self.force = [float(f) * scale if abs(f) > 1e-10 * largest else 0.0 for f in force]
        self.arm = [float(x) * length if abs(x) > 1e-9 * r.compiled.layout.length else 0.0 for x in arm]
        self.couple = shown.value("moment", float(a.couple[k]))
        self.forced = bool(a.force.any()) or a.kind == "joint"
        self.turned = abs(self.couple) > 1e-12 * max(abs(self.couple), largest * scale, 1e-300)

    @property
    def counts(self) -> bool:
        return self.forced or self.turned

    @property
    def moment(self) -> float:
        x, y = self.arm
        turn = self.shown.notation.torque
        return self.couple + turn * (x * self.force[1] - y * self.force[0])

    def size(self, kind: str) -> float:
        if kind == "force":
            return max(map(abs, self.force))
        return max(abs(self.couple), abs(self.arm[0] * self.force[1]), abs(self.arm[1] * self.force[0]))

    def component(self, axis: int) -> str:
        """F_{12} along x is F_{12x}."""
        head, _, index = self.symbol.partition("_{")
        return f"{head}_{{{index.rstrip('}')}{',' if ',' in index else ''}{'xy'[axis]}}}"

    def place(self) -> str:
        """Index of the arm: the joint, the load's own index, or G."""
        a = self.action
        if a.kind in ("joint", "friction"):
            return a.of
        if a.kind in ("load", "spring", "damper"):
            return self.symbol.partition("_{")[2].rstrip("}") or a.of
        return "G"

    def moment_letters(self) -> list[tuple[bool, str]]:
        out = []
        place = self.place()
        turn = self.shown.notation.torque < 0
        x, y = self.arm
        if self.forced and x:
            out.append((turn, f"R_{{{place}x}} {self.component(1)}"))
        if self.forced and y:
            out.append((not turn, f"R_{{{place}y}} {self.component(0)}"))
        if self.turned:
            a = self.action
            out.append((False, self.shown.joint_moment(a.of, a.link) if a.kind == "joint" else self.symbol))
        return out

    def moment_numbers(self) -> list[tuple[bool, str]]:
        out, number = [], self.shown.notation.number
        x, y = self.arm
        turn = self.shown.notation.torque < 0
        if self.forced and x:
            out.append((turn, f"({number(x)})({number(self.force[1])})"))
        if self.forced and y:
            out.append((not turn, f"({number(y)})({number(self.force[0])})"))
        if self.turned:
            out.append((self.couple < 0, number(abs(self.couple))))
        return out


class _Unknown(NamedTuple):
    """One unknown number: its sign, value (SI), kind, and what one unit of it does to links: force, couple, place."""

    sign: str
    value: float
    kind: str
    on: dict[str, tuple[Any, float]]
    place: Any


def matrix_equation(r: Result, k: int, shown: Shown, wanted: str = "") -> Matrix | None:
    """A x = b of all links about their moment points, knowns on the right.

    None where it is too large or not square, and with friction, which is not linear in the unknowns.
    """
    if r.friction is not None:
        return None
    unknowns = _unknowns(r, k, shown)
    if len(unknowns) > MOST or len(unknowns) != 3 * len(r.links) or r.compiled.forcing.separation.any():
        return None
    length, force, moment = (abs(shown.value(kind, 1.0)) for kind in ("length", "force", "moment"))
    per = {"force": force, "moment": moment}
    number = shown.notation.number
    rows, right = [], []
    everything = actions(r)
    for link in r.links:
        about = moment_point(r, link, k, wanted)
        known = _known(everything, unknowns, link, k, about)
        for axis in range(3):
            cells = [_coefficient(u, link, axis, about) for u in unknowns]
            # rows in the reader's units: force rows per force, moment rows per moment
            row_unit = moment if axis == 2 else force
            shown_cells = [c * row_unit / per[u.kind] for c, u in zip(cells, unknowns, strict=True)]
            largest = max(map(abs, shown_cells), default=0.0)
            rows.append(tuple(number(c) if abs(c) > 1e-9 * largest else "0" for c in shown_cells))
            value = -known[axis] * row_unit
            right.append(number(value if abs(value) > 1e-9 * _largest(r, k, force) else 0.0))
    values = tuple(f"{number(u.value * per[u.kind])}" for u in unknowns)
    assert length > 0
    return Matrix(tuple(rows), tuple(u.sign for u in unknowns), tuple(right), values)


def _largest(r: Result, k: int, force: float) -> float:
    return float(np.nanmax(np.abs(r.force_array[k]), initial=0.0)) * force


def _known(
    everything: tuple[Action, ...], unknowns: list[_Unknown], link: str, k: int, about: About
) -> tuple[float, float, float]:
    place = np.asarray(about.place)[None]
    some = [a for a in on_link(everything, link) if a.kind not in ("joint", "effort") or a.source]
    some = [a for a in some if a.of not in {u.sign for u in unknowns}]
    force = sum((a.force[k] for a in some), np.zeros(2))
    moment = math.fsum(float(a.moment(np.broadcast_to(place, a.at.shape))[k]) for a in some)
    return float(force[0]), float(force[1]), moment


def _coefficient(u: _Unknown, link: str, axis: int, about: About) -> float:
    if link not in u.on:
        return 0.0
    force, couple = u.on[link]
    if axis < 2:
        return float(force[axis])
    arm = np.asarray(u.place) - np.asarray(about.place)
    return float(couple + arm[0] * force[1] - arm[1] * force[0])


def _unknowns(r: Result, k: int, shown: Shown) -> list[_Unknown]:
    """Components of every joint force on j, then efforts; signs as in the equations."""
    out: list[_Unknown] = []
    zero = np.zeros(2)
    for joint in r.joints:
        described = r.mechanism.joints[joint]
        i, j = described.links
        sign, place = shown.reaction(joint, j), joint_place(r, joint)[k]
        head, _, index = sign.partition("_{")
        force, moment = r.least_norm(joint)[k, :2], float(r.least_norm(joint)[k, 2])
        axes: list[tuple[str, Any]] = []
        if described.type in ("pin", "weld", "rolling"):
            axes = [("x", np.array([1.0, 0.0])), ("y", np.array([0.0, 1.0]))]
        elif described.type in ("slider", "slot"):
            e = slide_direction(r, joint)[k]
            axes = [("n", np.array([-e[1], e[0]]))]
        for letter, e in axes:
            name = f"{head}_{{{index.rstrip('}')}{letter}}}"
            out.append(_Unknown(name, float(force @ e), "force", {j: (e, 0.0), i: (-e, 0.0)}, place))
        if described.type in ("slider", "weld"):
            name = shown.joint_moment(joint, j)
            out.append(_Unknown(name, moment, "moment", {j: (zero, 1.0), i: (zero, -1.0)}, place))
    return out + _efforts(r, k, shown)


def _efforts(r: Result, k: int, shown: Shown) -> list[_Unknown]:
    out = []
    for a in actions(r):
        if a.kind != "effort" or a.source or a.link != r.mechanism.joints[_joint(r, a.of)].links[1]:
            continue
        turning = not a.force.any()
        other = a.by or "ground"
        place = joint_place(r, _joint(r, a.of))[k]
        e = np.zeros(2) if turning else slide_direction(r, _joint(r, a.of))[k]
        unit = 1.0 if turning else 0.0
        value = float(r.effort(a.of)[k])
        kind = "moment" if turning else "force"
        on = {a.link: (e, unit), other: (-e, -unit)}
        out.append(_Unknown(shown.symbol(a), value, kind, on, place))
    for a in actions(r):
        if a.of in r.unknown_loads:
            out.append(_unknown_load(r, a, k))
    return out


def _unknown_load(r: Result, a: Action, k: int) -> _Unknown:
    value = float(r.unknown_load(a.of)[k])
    force = a.force[k] / value if value else np.zeros(2)
    turning = not a.force.any()
    kind = "moment" if turning else "force"
    return _Unknown(a.of, value, kind, {a.link: (force, 1.0 if turning else 0.0)}, a.at[k])


def _joint(r: Result, drive: str) -> str:
    return r.mechanism.drives[drive].joint or drive
