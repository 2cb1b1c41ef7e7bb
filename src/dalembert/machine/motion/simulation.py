"""`da.simulate`: the motion of a machine under forces, with every joint force along it.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.output.columns import columns
from dalembert.analysis.result.link_motion import place_of
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.column import Axes, Column, Scale
from dalembert.answer.named_answer import NamedAnswer, counted
from dalembert.arrays import Array, Tree
from dalembert.bounds import BOUNDS, text_of
from dalembert.errors import ArgumentError, ModelError
from dalembert.machine.elements.brake_heat import BrakeHeat
from dalembert.machine.motion.actuation import Actuation, actuation, joint_stops, read_start
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.coordinates.pieces import analysis_along, instants, integrate
from dalembert.machine.motion.energies import MotionChecks
from dalembert.machine.motion.integration import Integration
from dalembert.machine.motion.occurrences import Event, Words, read_end, say
from dalembert.machine.motion.stepping import Limits
from dalembert.machine.motion.stops.contact_answer import OpenedMotion
from dalembert.machine.motion.stops.opened_contacts import opened
from dalembert.machine.motion.stops.stop_loads import stop_effort, with_stop_loads
from dalembert.machine.motion.stops.watched_quantities import watched_kind
from dalembert.machine.motors.motor_use import WithMotors
from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.model import Mechanism, ModelOrPath, Schedule, as_mechanism
from dalembert.model.drives.drives import kind_of

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene

TOLERANCE = 1e-12
"""Relative tolerance of the integration."""


@dataclass(frozen=True, repr=False, eq=False)
class Simulation(BrakeHeat, WithMotors, MotionChecks, NamedAnswer, MachineAnswer):
    """A motion under forces: ``result`` has every joint force at the instants ``time`` (T,), s.

    ``applied`` (T, D): effort in each drive's freedom, brakes and stops included; ``stop_force`` (T, D): force of the
    stop on which it rests. ``works``: J since the start, (T,), by name. ``kinetic``, ``potential`` (T,). Checks:
    ``energy_residual``, the gap of the energy balance over the largest energy; ``law_gap`` (T,), of the efforts of the
    computed motion, prescribed, over the largest, ``law_residual`` its largest; and ``closure``, of the loops, m or
    rad. Joint forces and checks are computed when they are first needed; printed and written answers have them.

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2)
    >>> start = {"O2": {"position": "30 deg", "speed": "20 rad/s"}}
    >>> s = da.simulate(m, until="10 ms", count=3, start=start)
    >>> s.status, s.time.tolist()
    ('ended', [0.0, 0.005, 0.01])
    """

    ROW = "instant"

    schedule: Schedule = field(repr=False)
    works: Mapping[str, Array]
    events: tuple[Event, ...]
    ending: Words
    prescribed: Mechanism = field(repr=False)
    moves: Actuation = field(repr=False)
    given: Array = field(repr=False)  # applied, where that is no joint force: else NaN
    pushed: Array = field(repr=False)  # efforts on what rests on a stop, else NaN
    on_joints: Array = field(repr=False)  # stops of joints, (T, J, 2)
    status: str = "ended"
    """``ended`` by a time or a condition; ``not_met``: its conditions are not, within the limits or as it is at rest
    for good; ``stopped`` if the motion cannot go on, ``interrupted`` by Ctrl-C: ``ended`` says why and when."""
    motion: Result | None = field(repr=False, default=None)  # poses and rates where other freedoms have led
    evaluations: int = field(repr=False, default=0)
    opened: OpenedMotion | None = field(repr=False, default=None)
    curves: tuple[str, ...] = field(repr=False, default=())
    """Quantities that its drawings show besides: ``dataclasses.replace(s, curves=("reaction.A", "slide.guide"))``."""

    @cached_property
    def _loaded(self) -> tuple[Result, dict[str, Array]]:
        m, schedule = self.prescribed, self.schedule
        if self.opened is not None:
            m, schedule = self.opened.mechanism, self.opened.schedule
        if self.motion is None:
            result = at_schedule(m, schedule, inertia=True)
        else:
            result = analysis_along(m, schedule, self.motion)
        return with_stop_loads(result, self.on_joints, self.pushed, self.moves)

    @property
    def free_result(self) -> Result:
        """The analysis in which the gaps of contacts are separate freedoms."""
        return self._loaded[0]

    @cached_property
    def result(self) -> Result:  # type: ignore[override]  # the analysis along the computed motion
        r, stops = self._loaded
        if self.opened is None:
            return r
        return self.opened.of_description(r, self.prescribed, self.schedule, self.efforts, stops)

    @property
    def normals(self) -> Mapping[str, Array]:
        """Normal force (T,) of each contact that only pushes or pulls, N."""
        return (
            {}
            if self.opened is None
            else self.opened.normals(self.free_result, self.efforts, self._loaded[1])
        )

    @property
    def gaps(self) -> Mapping[str, Array]:
        """Gap (T,) of each contact that only pushes or pulls, m."""
        return {} if self.opened is None else self.opened.gaps(self.free_result)

    @property
    def joint_stop_force(self) -> Mapping[str, Array]:
        """Forces of stops of joints (T,), by joint, positive as its freedom; loads in ``result``."""
        return self._loaded[1]

    @property
    def time(self) -> Array:
        """Instants (T,), s."""
        assert self.schedule.time is not None
        return self.schedule.time

    @cached_property
    def efforts(self) -> Array:
        """Effort in the freedom of each drive and gap (T, D), N m or N."""
        required = np.where(np.isnan(self.given), self.free_result.effort_array, self.given)
        held = stop_effort(
            self.free_result, self.pushed, 0 * self.moves.brake
        )  # with what a brake takes of it
        return np.where(np.isnan(self.pushed), required, self.pushed + held)

    @property
    def applied(self) -> Array:
        """Effort in each drive's freedom (T, D), N m or N."""
        return self.efforts[:, : len(self.drives)]

    @cached_property
    def stop_force(self) -> Array:
        """Forces of stops (T, D): of rigid ones the part that friction and brakes do not hold at rest."""
        held = stop_effort(self.free_result, self.pushed, self.moves.brake)[:, : len(self.drives)]
        return held + self.moves.elastic_forces(self.schedule)

    @property
    def ended(self) -> str:
        """By what it ended."""
        return say(self.ending)

    @property
    def drives(self) -> tuple[str, ...]:
        """Names of the drives."""
        return self.schedule.names

    def position(self, drive: str) -> Array:
        """Position of a drive (T,), rad or m, full turns counted."""
        return self.schedule.position[:, place_of(self.drives, drive, "drive")]

    def speed(self, drive: str) -> Array:
        """Speed of a drive (T,), rad/s or m/s."""
        return self.schedule.speed[:, place_of(self.drives, drive, "drive")]

    def acceleration(self, drive: str) -> Array:
        """Acceleration of a drive (T,), rad/s2 or m/s2."""
        return self.schedule.acceleration[:, place_of(self.drives, drive, "drive")]

    @property
    def mechanism(self) -> Mechanism:
        """The description with the motion that was computed."""
        return self.prescribed

    @property
    def codes(self) -> Array:
        """Statuses (T,) of the joint forces at the instants."""
        return self.result.codes

    def __len__(self) -> int:
        return len(self.time)

    @property
    def extent(self) -> str:
        """Number of instants."""
        return counted(len(self), self.ROW)

    @property
    def outcome(self) -> str:
        """By what it ended, without the joint forces."""
        return f"{self.status} {self.ended}"

    def _further(self) -> dict[str, Column]:
        """Columns that are not quantities of the result: applied efforts, stops, works and energies, by name."""
        return {c.name: c for c in self._columns_of_motion()}

    def keys(self) -> list[str]:
        """Names of the quantities of ``result``, and of applied efforts, stops, works and energies."""
        return list(dict.fromkeys([*self.result.keys(), *self._further()]))

    def __getitem__(self, name: str) -> Array:
        """A quantity by its name, at the instants, SI."""
        further = self._further()
        return further[name].values if name in further else self.result[name]

    def both_sides(self, name: str) -> list[Array]:
        """A quantity, and where contacts reverse also its values just after."""
        return [self[name]] if name in self._further() else self.result.both_sides(name)

    def event(self, name: str) -> list[Event]:
        """Events whose name or sentence begins so, or whose sentence has a word that does."""
        return [e for e in self.events if e.name.startswith(name) or f" {name}" in f" {e.sentence}"]

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Time, all numbers of the result, works and energies."""
        yield from columns(self.result, axes)
        yield from self._columns_of_motion()

    def _columns_of_motion(self) -> Iterator[Column]:
        for k, drive in enumerate(self.drives):
            kind = drive_kinds(self.result, drive)["effort"]
            yield Column(f"applied_effort.{drive}", kind, self.applied[:, k])
            if self.stop_force[:, k].any():
                yield Column(f"stop_force.{drive}", kind, self.stop_force[:, k])
        stops = zip(self.joint_stop_force.items(), joint_stops(self.free_result.mechanism), strict=True)
        for (joint, force), (_, freedom) in stops:
            if force.any() and not freedom.startswith("gap"):
                yield Column(f"stop_force.{joint}", kind_of(freedom, "effort"), force)
        for word, kind, of in (("normal", "force", self.normals), ("gap", "length", self.gaps)):
            yield from (Column(f"{word}.{name}", kind, values) for name, values in of.items())
        yield from (Column(f"energy.work.{name}", "energy", values) for name, values in self.works.items())
        yield Column("energy.kinetic", "energy", self.kinetic)
        yield Column("energy.potential", "energy", self.potential)

    def record(self, to: Scale) -> Tree:
        """Events, the end and the checks."""
        return {
            "ended": say(self.ending, to),
            "status": self.status,
            "events": [self._event(e, to) for e in self.events],
            "energy_residual": self.energy_residual,
            "law_residual": self.law_residual,
            "closure": self.closure,
            "doubt": self.doubt,
        }

    def _event(self, e: Event, to: Scale) -> Tree:
        known = {"time": float(np.asarray(to("time", e.time))), "name": e.name, "sentence": say(e.words, to)}
        return known | ({} if np.isnan(e.lost) else {"lost": float(np.asarray(to("energy", e.lost)))})

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.simulation_text import simulation_parts

        return simulation_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.cycle_views import simulation_scenes

        return simulation_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.design_sections import simulation_section

        simulation_section(sheet, self, shown)


def simulate(
    m: ModelOrPath,
    until: str | float | Sequence[str | float],
    start: Mapping[str, object] | None = None,
    events: Sequence[str] = (),
    count: int = 201,
    tolerance: float = TOLERANCE,
    steps: int = Limits.steps,
    progress: Callable[[int, int], None] | None = None,
) -> Simulation:
    """Motion under forces: motors, given efforts, loads, weights, springs, dampers and dry friction.

    (V^T M V) u' + h(q, u) = tau for the drives that ``start`` releases; the others stay prescribed. ``until``: a time
    (``"2 s"``, or seconds), a condition such as ``"O2.speed = 0 rad/s"`` or ``"O2.position = 90 deg"``, or several, the
    first ends it. Without a time, a motion also ends where its conditions are not met within ``steps`` steps of the
    integration (a radian at least counts as one), or 1e5 s: its ``status`` is ``not_met``. Ctrl-C ends it with the
    motion so far, ``interrupted``. ``start``: instead of the file's, ``{"O2": {"position": "60 deg", "speed": 0}}``.
    ``events``: conditions that are recorded. ``count``: instants in the answer, evenly in time, besides the events;
    without a time the steps of the integration. ``progress``: called with (instants reached, their count). Dry friction
    sticks and releases, without smoothing. Raises ModelError for a model that forces cannot move. Hairer, Norsett,
    Wanner, Solving ODEs I, II.5 (DOP853).

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2)
    >>> s = da.simulate(m, until="0.5 s", start={"O2": {"position": "30 deg", "speed": "20 rad/s"}})
    >>> bool(s.energy_residual < 1e-9), bool(s.law_residual < 1e-9)
    (True, True)
    """
    return motion_of(as_mechanism(m), until, start, events, count, tolerance, steps, progress=progress)


def motion_of(
    m: Mechanism,
    until: str | float | Sequence[str | float],
    start: Mapping[str, object] | None = None,
    events: Sequence[str] = (),
    count: int = 201,
    tolerance: float = TOLERANCE,
    steps: int = Limits.steps,
    shared: SharedMotion | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Simulation:
    """The motion of ``simulate``; of one design of many by the equation that they have ``shared``."""
    try:
        m = m if shared is None else shared.in_mode(m)
        prescribed, moves = actuation(m, read_start(m, start))
        whole, acting = opened(prescribed, moves) or (prescribed, moves)
        if shared is not None and acting is moves:
            acting.equation = shared.equation_of(whole)
        end, conditions = read_end(m, until, events, lambda name: watched_kind(whole, acting, name))
        check_choices(count, tolerance)
        if isinstance(steps, bool) or not isinstance(steps, int) or steps < 1:
            raise ModelError(f"{steps!r} is not a number of steps", "ask for 1 or more")
        times = np.linspace(0.0, end, count)[1:] if np.isfinite(end) else None
        run = Integration(whole, acting, end, times, conditions, tolerance, Limits(steps))
        run.progress = progress
        acting.equation = None  # the run has it; an answer can be pickled
        pieces = integrate(run)
    except ModelError as error:
        raise error.at_source(m.source) from None
    return _answer(m, prescribed, pieces)


def check_choices(count: int, tolerance: float) -> None:
    """Raise ModelError for a number of instants or a tolerance out of range."""
    if not BOUNDS["instants"].allows(count):
        what = f"instants={text_of(count)} is out of range"
        raise ArgumentError(what, f"use 2 to {BOUNDS['instants'].high}")
    if not BOUNDS["step error"].allows(tolerance):
        what = f"the tolerance {text_of(tolerance)} is not between 1e-14 and 1e-3"
        raise ArgumentError(what, "leave it out: 1e-12")


def _answer(m: Mechanism, prescribed: Mechanism, pieces: list[Integration]) -> Simulation:
    """The computed motion."""
    run = pieces[-1]
    if not run.rows:
        what = f"the motion cannot begin: {say(run.ended)}"
        raise ModelError(what, "start elsewhere, or with another speed", ("start",))
    (t, q, u, a, applied, works, on_stop, stops, parts), motion = instants(pieces)
    acting = pieces[0].acting
    every, contacts = acting.names, acting.contacts
    names = [*every, "brakes", "loads", "dampers", "friction"]
    named = {
        name: w
        for name, w in zip(names, works.T, strict=True)
        if name in m.drives or (name not in every and w.any())
    }
    if run.losses:
        named["impacts"] = -np.array([sum(lost for when, lost in run.losses if when <= x) for x in t])
    ending, schedule = (
        run.ended or ("at ", ("time", t[-1])),
        Schedule(every, q, u, a, t, parts=parts if run.equation.dry else None),
    )
    opened_motion = OpenedMotion(pieces[0].m, schedule, contacts) if contacts else None
    own, count = schedule, len(prescribed.drives)
    if contacts:
        own = replace(schedule, names=every[:count], position=q[:, :count], speed=u[:, :count])
        own = replace(own, acceleration=a[:, :count])
    return Simulation(
        own,
        named,
        tuple(run.events),
        ending,
        prescribed,
        acting,
        applied,
        on_stop,
        stops,
        run.status,
        motion,
        sum(piece.evaluations for piece in pieces),
        opened_motion,
    )
