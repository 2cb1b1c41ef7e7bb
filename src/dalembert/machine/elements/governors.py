"""Governors: speed over the height of the sleeve, sensitiveness, stability, effort and power.

At rest in the turning plane every load but the centrifugal ones asks for the force F at the sleeve, with which
F = W^2 dJ/dh / 2 (J the moment of inertia about the axis, h the height): F is known from the speed alone. Where W^2
grows with J the governor is stable; where it has an extreme it is isochronous.

Source: Bevan, The Theory of Machines, chapter 13; docs/theory.md 10.7.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.answer import Drawn, Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Flags, Tree
from dalembert.core.constraints import rates, system
from dalembert.core.elements.turning_frame import centrifugal
from dalembert.errors import ModelError
from dalembert.model import Mechanism, ModelOrPath, Schedule, as_mechanism
from dalembert.printing import Part, TextTable, number
from dalembert.units import quantity
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

RPM = math.pi / 30
UNKNOWN = "unknown"
SHOWN = 12
"""Positions that are printed."""


@dataclass(frozen=True, eq=False)
class Governor(Labelled, Drawn):
    """Speeds (P,) over positions of a governor, SI.

    height (P,): slide of the sleeve, m; radius (P,): distance of the heaviest pull's mass centre from the axis, m;
    interval (P, 2): speeds at which friction holds it; sleeve_force (P,): F, what all loads but the centrifugal ones
    ask for at the sleeve, N; stable (P,); isochronous: positions of the drive at which the speed has an extreme.

    >>> import dalembert as da
    >>> g = da.governor(da.porter_governor())
    >>> g.speed.shape == g.height.shape, bool(g.stable.all())
    (True, True)
    """

    result: Result = field(repr=False)
    drive: str
    sleeve: str
    height: Array = field(repr=False)
    radius: Array = field(repr=False)
    speed: Array = field(repr=False)
    interval: Array = field(repr=False)
    sleeve_force: Array = field(repr=False)
    stable: Flags = field(repr=False)
    isochronous: tuple[float, ...]
    pull: Array = field(repr=False)

    @property
    def described(self) -> Any:
        """The description of the governor."""
        return self.result.mechanism

    @property
    def sensitiveness(self) -> float:
        """(N_2 - N_1) / N_m of the ends of the range, without friction."""
        ends = self.speed[[0, -1]]
        return float(np.ptp(ends) / ends.mean())

    @property
    def range_with_friction(self) -> tuple[float, float]:
        """Lowest and highest speed, rad/s, at which the sleeve begins to move somewhere."""
        return float(np.nanmin(self.interval)), float(np.nanmax(self.interval))

    @property
    def lift(self) -> float:
        """Way of the sleeve over the range, m."""
        return float(np.ptp(self.height))

    def effort(self, change: float = 0.01) -> Array:
        """Mean force (P,), N, on a held sleeve while the speed changes by a part: F (c + c^2 / 2)."""
        return self.sleeve_force * (change + change**2 / 2)

    def book_effort(self, change: float = 0.01) -> Array:
        """The book's effort c F (P,), N: of a Porter governor with equal arms c (m + M) g."""
        return self.sleeve_force * change

    def lift_for(self, change: float = 0.01) -> Array:
        """Way of the sleeve (P,), m, when the speed rises by a part; NaN where that is beyond the range."""
        order = np.argsort(self.speed)
        to = np.interp(
            (1 + change) * self.speed, self.speed[order], self.height[order], left=np.nan, right=np.nan
        )
        return np.where(self.stable, np.abs(to - self.height), np.nan)

    def power(self, change: float = 0.01) -> Array:
        """Effort times lift (P,), J; NaN where the range ends before."""
        return self.effort(change) * self.lift_for(change)

    def book_power(self, change: float = 0.01) -> Array:
        """The book's power 4 c^2 / (1 + 2 c) F h (P,), J, with the height h = 2 F / (m W^2) of equal arms."""
        force = self.sleeve_force
        return 4 * change**2 / (1 + 2 * change) * force * (2 * force / self.pull)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Position, height, radius, speeds, force at the sleeve, effort and power for one per cent."""
        r = self.result
        yield Column(
            f"drive.{self.drive}", drive_kinds(r, self.drive)["position"], r.drive_position(self.drive)
        )
        yield Column("height", "length", self.height)
        yield Column("radius", "length", self.radius)
        for name, values in (("", self.speed), (".low", self.interval[:, 0]), (".high", self.interval[:, 1])):
            yield Column(f"turning_speed{name}", "angular_speed", values)
        yield Column("sleeve_force", "force", self.sleeve_force)
        yield Column("effort", "force", self.effort())
        yield Column("power", "energy", self.power())

    def record(self, to: Scale) -> Tree:
        """Sensitiveness, lift, range of speeds, isochronous places."""
        low, high = self.range_with_friction
        kind = drive_kinds(self.result, self.drive)["position"]
        out = {
            "sensitiveness": self.sensitiveness,
            "lift": float(to("length", self.lift)),
            "lowest": float(to("angular_speed", low)),
            "highest": float(to("angular_speed", high)),
            "isochronous": [float(to(kind, x)) for x in self.isochronous],
        }
        return {"governor": out}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Speeds over the height, and what follows from them."""
        to, count = self.scale(units), len(self.speed)
        shown = sorted({*np.linspace(0, count - 1, min(SHOWN, count)).round().astype(int).tolist()})
        kind = drive_kinds(self.result, self.drive)["position"]
        place, rows = self.result.drive_position(self.drive), []
        friction = not np.array_equal(self.interval[:, 0], self.interval[:, 1], equal_nan=True)
        for k in shown:
            ends = [number(x / RPM, 5) for x in self.interval[k]] if friction else []
            lengths = [number(float(to("length", x[k])), 5) for x in (self.height, self.radius)]
            cells = [number(float(to(kind, place[k])), 5), *lengths, number(self.speed[k] / RPM, 6), *ends]
            force = [number(float(to("force", x[k])), 5) for x in (self.sleeve_force, self.effort())]
            rows.append([*cells, *force, "yes" if self.stable[k] else "no"])
        length, ends = to.text("length"), ["low\nrpm", "high\nrpm"] if friction else []
        heads = [
            f"{self.drive}\n{to.text(kind)}",
            f"height\n{length}",
            f"radius\n{length}",
            "speed\nrpm",
            *ends,
        ]
        heads += [f"sleeve F\n{to.text('force')}", f"effort, 1 %\n{to.text('force')}", "stable\n"]
        yield TextTable(heads, rows, 1)
        first, last = (number(self.speed[k] / RPM, 6) for k in (0, -1))
        lift = f"{number(float(to('length', self.lift)), 5)} {length}"
        yield f"From {first} to {last} rpm over a lift of {lift}: sensitiveness {number(self.sensitiveness, 5)}."
        if friction:
            low, high = (number(x / RPM, 6) for x in self.range_with_friction)
            yield f"With friction the sleeve begins to move at {low} rpm and at {high} rpm."
        for x in self.isochronous:
            yield f"Isochronous at {number(float(to(kind, x)))} {to.text(kind)} of {self.drive}: beyond it unstable."
        middle = count // 2
        exact, book = (float(to("force", x[middle])) for x in (self.effort(), self.book_effort()))
        unit = to.text("force")
        yield f"Effort for 1 % in the middle: {number(exact)} {unit} exactly, {number(book)} {unit} by the book's c F."

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """Speed over the height, with both ends of what friction holds."""
        from dalembert.views.machine.governor_view import governor_scene

        return [governor_scene(self, notation)]


def governor(
    m: ModelOrPath,
    range: Any = None,  # noqa: A002
    drive: str | None = None,
    sleeve: str | None = None,
    count: int = 61,
) -> Governor:
    """The speeds of a governor over a range of positions of its drive, and what follows from them.

    ``range``: two positions, SI or texts with units; default the drive's `range`, or from its first to its last
    position. ``sleeve``: the slider whose slide is the height; default the first. The drive's effort is the one given,
    or 0. Raises ModelError without `turning`, and AnalysisError where a position has no answer.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> g = da.governor(da.load(cases()["gov-12-porter-governor-with-friction"]))
    >>> round(g.sensitiveness, 6), bool(g.stable.all()), [round(x / 0.10471975512, 1) for x in g.range_with_friction]
    (0.143594, True, [171.7, 210.2])
    """
    m = as_mechanism(m)
    name = governor_drive(m, drive)
    positions = np.linspace(*limits(m, name, range), count)
    requested = at_rest(m, name)
    r = statics_at(requested, name, positions)
    lost = next(
        (text for text, ok in zip(r.reasons, np.isfinite(r.turning_speed), strict=True) if not ok), None
    )
    if lost is not None:
        raise ModelError(
            f"the governor has no speed in part of its range: {lost}", "change the range", ("turning",)
        )
    joint = _sleeve(m, sleeve)
    slopes = _Slopes(r, name, joint)
    speed = r.turning_speed
    change = np.gradient(speed**2, positions) * slopes.inertia
    heavy = int(np.argmax(np.abs(slopes.pulls).max(axis=0)))
    radius = np.abs(slopes.out[:, heavy])
    return Governor(
        result=r,
        drive=name,
        sleeve=joint,
        height=r.drive_position(name) if not joint else r.freedom(joint, "slide")[0],
        radius=radius,
        speed=speed,
        interval=r.turning_interval,
        sleeve_force=np.abs(speed**2 * slopes.inertia / slopes.height),
        stable=np.asarray(change > 0),
        isochronous=_isochronous(requested, name, positions, speed),
        pull=float(slopes.masses[np.abs(slopes.out).max(axis=0) > 1e-9 * radius.max()].sum()) * speed**2,
    )


def governor_drive(m: Mechanism, drive: str | None) -> str:
    if m.turning is None:
        raise ModelError(
            "the plane does not turn", "give it turning: {axis: y, speed: unknown}", ("turning",)
        )
    if drive is not None and drive not in m.drives:
        raise ModelError(f"unknown drive {drive!r}", closest(drive, list(m.drives)))
    known = [n for n, d in m.drives.items() if d.effort is not None]
    name = drive or next(iter([*known, *m.drives]), "")
    if not name:
        raise ModelError("no drive positions the governor", "drive the sleeve or an arm", ("drives",))
    return name


def limits(m: Mechanism, drive: str, ends: Any) -> tuple[float, float]:
    d = m.drives[drive]
    if ends is not None:
        low, high = (
            quantity(x, "angle" if d.turns else "length", None) if isinstance(x, str) else x for x in ends
        )
        return float(low), float(high)
    if d.range is not None:
        return d.range
    position = m.schedule().position[:, list(m.drives).index(drive)]
    if np.ptp(position) == 0:
        raise ModelError(f"drive {drive!r} has one position", "give range=(first, last)", ("drives", drive))
    return float(position[0]), float(position[-1])


def at_rest(m: Mechanism, drive: str, speed: float | str = UNKNOWN) -> Mechanism:
    """The mechanism with that speed of turning, its drives at rest, and one effort given or none."""
    assert m.turning is not None
    still = {"speed": 0.0, "acceleration": 0.0, "law": None, "range": None, "position": 0.0}
    efforts = {n: (d.effort or 0.0) if n == drive and speed == UNKNOWN else None for n, d in m.drives.items()}
    drives = {n: d.model_copy(update={**still, "effort": efforts[n]}) for n, d in m.drives.items()}
    return m.model_copy(update={"drives": drives, "turning": m.turning.model_copy(update={"speed": speed})})


def statics_at(m: Mechanism, drive: str, positions: Array, other: Array | None = None) -> Result:
    """Statics at positions of one drive, the others where they are first."""
    names = tuple(m.drives)
    at = (
        np.zeros((len(positions), len(names)))
        if other is None
        else np.repeat(other[None], len(positions), axis=0)
    )
    at[:, names.index(drive)] = positions
    return at_schedule(m, Schedule(names, at, np.zeros_like(at), np.zeros_like(at)), inertia=False)


def _sleeve(m: Mechanism, sleeve: str | None) -> str:
    sliders = [n for n, joint in m.joints.items() if joint.guides] if sleeve is None else [sleeve]
    if sleeve is not None and sleeve not in m.joints:
        raise ModelError(f"unknown joint {sleeve!r}", closest(sleeve, list(m.joints)))
    return sliders[0] if sliders else ""


class _Slopes:
    """dJ/dq / 2 and dh/dq (P,) of a result, and by link (P, L) the places out of the axis and the pulls per W^2."""

    def __init__(self, r: Result, drive: str, sleeve: str) -> None:
        at, c, k = state(r), r.compiled, r.drives.index(drive)
        frame, masses, g = c.forcing.turning, c.forcing.inertia, c.layout.algebra
        assert frame is not None
        unit = centrifugal(c.layout, masses, frame, at.pose, np.ones(1))
        v = at.moving.virtual[:, k]
        self.inertia = (unit.wrench * v[:, :-1]).sum(axis=(-2, -1))
        rows = system(g, c.layout.freedoms, at.pose)
        self.height = np.ones(len(v))
        if sleeve:
            self.height = rates(rows, v)[:, c.freedoms.index((sleeve, "slide"))]
        outward = np.array([frame.axis[1], -frame.axis[0]])
        self.masses: Array = masses.mass
        self.pulls = unit.wrench[..., :2] @ outward
        self.out = self.pulls / np.where(masses.mass > 0, masses.mass, np.inf)


def _isochronous(m: Mechanism, drive: str, positions: Array, speed: Array) -> tuple[float, ...]:
    """Positions at which the speed has an extreme inside the range."""
    from scipy.optimize import minimize_scalar

    steps = np.diff(speed)
    out = []
    for k in np.flatnonzero(steps[:-1] * steps[1:] < 0):
        sign = np.sign(steps[k])
        low, high = sorted((positions[k], positions[k + 2]))
        value = minimize_scalar(
            lambda q, sign=sign: -sign * float(statics_at(m, drive, np.array([q])).turning_speed[0]),
            bounds=(low, high),
            method="bounded",
            options={"xatol": 1e-9 * (high - low)},
        )
        out.append(float(value.x))
    return tuple(out)
