"""Terms of the equilibrium equations of a link: each action in letters and in numbers.

Moments of a force F with the arm R about an axis a are R_b F_c - R_c F_b, with a, b, c in the order x, y, z.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, drive_wrench, unit_load
from dalembert.analysis.output.rounding import least
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.reaction_components import Component, components, remainder
from dalembert.arrays import Array
from dalembert.views.notation import Shown, along, load_sign

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

AXES = "xyz"
PARALLEL = 1e-12
"""A direction cosine, or its difference to 1, below this is rounding."""

Signed = tuple[bool, str]
"""True if a term has a minus before it, and the term."""


class About(NamedTuple):
    """The point that moments are taken about: its name and place (metres)."""

    name: str
    place: Array


class EquationTerm(NamedTuple):
    """One term of one equation: in letters, with numbers, its value in the reader's units."""

    letters: Signed
    numbers: Signed
    value: float


class EquationSetting(NamedTuple):
    """Setting of the equations: the reader's notation, their axes (d, d) a row each, the point of the moments; sizes in
    SI below which a force, a moment and an arm are rounding."""

    r: Result
    k: int
    shown: Shown
    axes: Array
    about: About
    floors: tuple[float, float, float]

    def vector(self, size: float, v: Array, floor: int) -> list[float]:
        """Components of a vector along the axes, in units of a size; rounding is 0."""
        return [float(x) / size if abs(x) > self.floors[floor] else 0.0 for x in self.axes @ v]

    def arm(self, at: Array) -> list[float]:
        """From the point of the moments to a place, in the unit that makes moments of forces."""
        return self.vector(self.shown.arm, at - np.asarray(self.about.place), 2)

    def number(self, value: float) -> str:
        """As the reader writes it."""
        return self.shown.notation.number(value)


class Term(Protocol):
    """Contribution of an action to the sums of forces along an axis, and of moments about one."""

    def force(self, axis: int) -> list[EquationTerm]: ...

    def moment(self, axis: int) -> list[EquationTerm]: ...


def join_signed(parts: list[Signed]) -> str:
    """Terms with their signs between them."""
    out = ""
    for n, (minus, text) in enumerate(parts):
        out += ("−" if minus else "") + text if n == 0 else f" {'−' if minus else '+'} {text}"
    return out or "0"


def join_numbers(texts: list[str]) -> str:
    """Numbers as text with their signs between them."""
    return join_signed([(text.startswith("−"), text.removeprefix("−")) for text in texts])


def setting(r: Result, link: str, k: int, shown: Shown, about: About) -> EquationSetting:
    """Setting in ground axes or in those of the link, as in the reader's notation."""
    axes = np.eye(r.mechanism.dimension) if shown.notation.axes == "ground" else r.rotation(link)[k].T
    return EquationSetting(r, k, shown, axes, about, floors(r, k))


def floors(r: Result, k: int) -> tuple[float, float, float]:
    """Sizes below which a force (N), a moment (N m) and a length (m) are rounding."""
    floor = least(r, k)
    return floor["force"], floor["moment"], floor["length"]


def terms(s: EquationSetting, some: tuple[Action, ...]) -> list[Term]:
    """Terms of the actions on one link; in space an unknown with a fixed direction is separate."""
    if s.r.mechanism.dimension == 2:
        plain = [ActionVector(s, a, a.force[s.k], a.couple[s.k, None]) for a in some]
        return [v for v in plain if v.counts]
    return [term for a in some for term in _in_space(s, a)]


def _in_space(s: EquationSetting, a: Action) -> list[Term]:
    if a.kind == "effort" and not a.source:
        kind = drive_kinds(s.r, a.of)["effort"]
        mine = s.r.mechanism.joints[_joint(s.r, a.of)].links[1] == a.link
        force, couple = (
            v[s.k] * (1 if mine else -1) for v in drive_wrench(s.r, a.of, np.ones(len(s.r.status)))
        )
        return [UnknownLine(s, s.shown.effort(a), float(s.r.effort(a.of)[s.k]), kind, force, couple, a)]
    if a.of in s.r.unknown_loads and a.kind == "load":
        force, couple = (v[s.k] for v in unit_load(s.r, s.r.unknown_loads.index(a.of)))
        kind = "force" if force.any() else "moment"
        return [UnknownLine(s, load_sign(a.of), float(s.r.unknown_load(a.of)[s.k]), kind, force, couple, a)]
    if a.kind != "joint":
        return [ActionVector(s, a, a.force[s.k], a.couple[s.k])]
    return _reaction(s, a)


def _reaction(s: EquationSetting, a: Action) -> list[Term]:
    """A joint's reaction: three components along the axes as one vector, the others one by one."""
    some, out = components(s.r, a, s.k, s.axes), list[Term]()
    rest = remainder(a, s.k, some)
    for turning in (False, True):
        mine = [c for c in some if c.turning is turning]
        out += [_line(s, a, c) for c in mine if c.in_joint_axes]
        if any(not c.in_joint_axes for c in mine):
            force, couple = (
                sum((c.value * v for c, v in zip(mine, part, strict=True)), np.zeros(3))
                for part in ([c.force for c in mine], [c.couple for c in mine])
            )
            out.append(ActionVector(s, a, force, couple, "moment" if turning else "force"))
    if np.abs(rest[0]).max() > s.floors[0] or np.abs(rest[1]).max() > s.floors[1]:
        out.append(ActionVector(s, replace(a, kind="damper"), *rest))
    return out


def _line(s: EquationSetting, a: Action, c: Component) -> UnknownLine:
    sign = s.shown.joint_moment(a.of, a.link) if c.turning else s.shown.symbol(a)
    kind = "moment" if c.turning else "force"
    return UnknownLine(s, along(sign, c.axis) if c.axis else sign, c.value, kind, c.force, c.couple, a)


class ActionVector:
    """An action by its components along all axes, in the reader's units.

    ``unknown``: force or moment of a joint, whose components are written where they are zero too.
    """

    def __init__(self, s: EquationSetting, a: Action, force: Array, couple: Array, unknown: str = "") -> None:
        self.s, self.action, self.unknown = s, a, unknown
        self.plane = s.r.mechanism.dimension == 2
        self.sign = s.shown.symbol(a)
        self.values = s.vector(s.shown.size("force"), force, 0)
        self.arm = s.arm(a.at[s.k])
        if self.plane:
            self.couple = [s.shown.value("moment", float(couple[0]))]
            self.forced = bool((np.abs(a.force) > s.floors[0]).any()) or a.kind == "joint"
        else:
            self.couple = s.vector(s.shown.size("moment"), couple, 1)
            self.forced = bool(force.any()) or unknown == "force"

    @property
    def turned(self) -> bool:
        """In the plane: whether it has a couple to speak of. Where moments are shown clockwise, the factor is
        negative."""
        return abs(self.couple[0]) > self.s.floors[1] * abs(self.s.shown.value("moment", 1.0))

    @property
    def counts(self) -> bool:
        """In the plane: whether there is anything to write."""
        return self.forced or self.turned

    def force(self, axis: int) -> list[EquationTerm]:
        """Its component, where there is one."""
        value = self.values[axis]
        if not self.forced or not (self.plane or self.unknown or value):
            return []
        return [
            EquationTerm((False, along(self.sign, AXES[axis])), (value < 0, self.s.number(abs(value))), value)
        ]

    def moment(self, axis: int) -> list[EquationTerm]:
        """Moments of its components, and its couple."""
        b, c = (axis + 1) % 3, (axis + 2) % 3
        return [*self._lever(b, c, 1), *self._lever(c, b, -1), *self._couple(axis)]

    def _lever(self, arm: int, component: int, sense: int) -> list[EquationTerm]:
        """R_b F_c, with its sign in the plane as the reader counts moments."""
        value, minus = self.values[component], sense * self.s.shown.notation.torque < 0
        if not self.forced or not self.arm[arm] or not (self.plane or self.unknown or value):
            return []
        place, number = place_of(self.s, self.action), self.s.number
        letters = f"R_{{{about(place, AXES[arm])}}} {along(self.sign, AXES[component])}"
        product = (-1 if minus else 1) * self.arm[arm] * value
        return [
            EquationTerm((minus, letters), (minus, f"({number(self.arm[arm])})({number(value)})"), product)
        ]

    def _couple(self, axis: int) -> list[EquationTerm]:
        value = self.couple[0 if self.plane else axis]
        has_couple = self.turned if self.plane else value or self.unknown == "moment"
        if not has_couple:
            return []
        sign = self.s.shown.turning_symbol(self.action)
        letters = sign if self.plane else along(sign, AXES[axis])
        return [EquationTerm((False, letters), (value < 0, self.s.number(abs(value))), value)]


class UnknownLine:
    """In space: one unknown number along a fixed direction, in the reader's units."""

    def __init__(
        self, s: EquationSetting, sign: str, value: float, kind: str, force: Array, couple: Array, a: Action
    ) -> None:
        self.s, self.sign, self.action = s, sign, a
        floor = s.floors[0 if kind == "force" else 1]
        self.value = s.shown.value(kind, value if abs(value) > floor else 0.0)
        self.cosines = _remove_noise(s.axes @ force)
        self.arm = s.arm(a.at[s.k])
        turning = _remove_noise(s.axes @ couple)
        arm = s.shown.arm if kind == "force" else 1.0
        self.turning = [t / arm for t in turning]

    def force(self, axis: int) -> list[EquationTerm]:
        """Its part along an axis."""
        return self._part(self.cosines[axis])

    def moment(self, axis: int) -> list[EquationTerm]:
        """Its part about an axis: by its arms where it lies along one, else by one figure."""
        b, c = (axis + 1) % 3, (axis + 2) % 3
        straight = max(map(abs, self.cosines)) == 1
        if not straight:
            lever = self.arm[b] * self.cosines[c] - self.arm[c] * self.cosines[b]
            least = PARALLEL * max(map(abs, self.arm))
            return self._part(lever + self.turning[axis] if abs(lever) > least else self.turning[axis])
        return [*self._lever(b, c, 1), *self._lever(c, b, -1), *self._part(self.turning[axis])]

    def _lever(self, arm: int, component: int, sense: int) -> list[EquationTerm]:
        factor = sense * self.cosines[component]
        if not factor or not self.arm[arm]:
            return []
        place, number = place_of(self.s, self.action), self.s.number
        letters = f"R_{{{about(place, AXES[arm])}}} {self.sign}"
        numbers = f"({number(self.arm[arm])})({number(self.value)})"
        return [
            EquationTerm((factor < 0, letters), (factor < 0, numbers), factor * self.arm[arm] * self.value)
        ]

    def _part(self, factor: float) -> list[EquationTerm]:
        """A factor times the unknown; a factor of 1 is not written."""
        if not factor:
            return []
        number = self.s.number
        if abs(factor) == 1:
            value = factor * self.value
            return [EquationTerm((factor < 0, self.sign), (value < 0, number(abs(value))), value)]
        size = number(abs(factor))
        letters, numbers = f"{size} {self.sign}", f"({size})({number(self.value)})"
        return [EquationTerm((factor < 0, letters), (factor < 0, numbers), factor * self.value)]


def _remove_noise(v: Array) -> list[float]:
    """Direction cosines, or components in metres a unit, without rounding."""
    out = [0.0 if abs(x) < PARALLEL else float(x) for x in v]
    return [float(np.sign(x)) if abs(abs(x) - 1) < PARALLEL else x for x in out]


def about(place: str, axis: str) -> str:
    """Index of a place and an axis: Ax, but piston,x."""
    return f"{place}{',' if len(place) > 2 and axis else ''}{axis}"


def place_of(s: EquationSetting, a: Action) -> str:
    """Index of the arm: the joint, the point of a load by its name, else the load's index, or G."""
    if a.kind in ("joint", "friction") or a.of in s.r.joints:
        return a.of
    if a.kind == "effort":
        return _joint(s.r, a.of)
    if a.kind in ("load", "spring", "damper"):
        spot = getattr(s.r.mechanism.loads.get(a.of), "at", None)
        if isinstance(spot, str):
            return "G" if spot == "center" else spot
        return s.shown.symbol(a).partition("_{")[2].rstrip("}") or a.of
    return "G"


def _joint(r: Result, drive: str) -> str:
    return r.mechanism.drives[drive].joint or drive
