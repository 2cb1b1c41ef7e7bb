"""Result of an analysis: arrays with names, a status and a sentence for each position."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dalembert.analysis.methods.elements.element_answers import ElementAnswers
from dalembert.analysis.result.link_motion import LinkMotion, place_of
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import WORD, Axes, Column, Scale, UnitChoice
from dalembert.answer.named_answer import NamedAnswer
from dalembert.arrays import Array, Flags, Tree
from dalembert.errors import SOLVED, ModelError

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.degree_of_freedom import Mobility
    from dalembert.analysis.result.force_arrays import Friction
    from dalembert.analysis.result.position_lookup import PositionChoice
    from dalembert.answer.workbook import Tab
    from dalembert.machine.harmonics import Harmonics
    from dalembert.machine.shaking import Shaking
    from dalembert.model import Schedule
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.draw import View
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene


@dataclass(frozen=True, repr=False, eq=False)
class Result(LinkMotion, ElementAnswers, NamedAnswer, Labelled, Drawn, Worked):
    """Answer of one analysis over P positions (a leading axis design may precede position).

    Everything in SI and radians, vectors in ground axes. A reaction is exerted by a joint's other link on the requested
    link, at the joint's point on that link. NaN where unsolved; ``status`` and ``reasons`` give the reason. Where
    contacts reverse the numbers are those just before, and ``after`` is the complete result with those just after.

    >>> import dalembert as da
    >>> r = da.dynamics(da.four_bar())
    >>> r.effort("O2").shape, r.reaction("A", on="coupler").shape, set(r.status)
    ((72,), (72, 2), {'ok'})
    """

    compiled: Compiled = field(compare=False)
    inertia: bool
    mobility: Mobility | None
    mode: str | None
    status: tuple[str, ...]
    reasons: tuple[str | None, ...]
    point_array: Array  # (P, L, 2) links' reference points
    turn_array: Array  # (P, L) links' angles; in space (P, T) the followed relative ones
    rotation_array: Array  # (P, L, 2) cosine and sine; in space (P, L, 9) matrices
    twist_array: Array  # (P, L, 3); in space 6
    acceleration_array: Array  # (P, L, 3); in space 6
    force_array: Array  # (P, joints, 2) on j; in space 3
    moment_array: Array  # (P, joints); in space (P, joints, 3)
    effort_array: Array  # (P, D)
    load_array: Array  # (P, U)
    residual: Array
    power_balance: Array
    unique_array: Flags | None = None  # (P, joints, 3)
    unique_unknowns: Flags | None = None  # (P, D asked + U)
    unique_in: Flags | None = None  # in space (P, joints, 3, 6): AXES
    stability: tuple[str | None, ...] | None = None
    friction: Friction | None = None
    ends: tuple[tuple[Result, Result], ...] = ()
    after: Result | None = None

    def __getstate__(self) -> Tree:
        return {f.name: getattr(self, f.name) for f in fields(self)}  # without what is kept

    def _repr_html_(self) -> str:
        from dalembert.notebook.html_views import result_html

        return result_html(self)

    # by name, and drawn

    def __getitem__(self, name: str) -> Array:
        """A quantity by its name, SI: ``r["effort.O2"]``, ``r["reaction.A"]``, ``r["reaction.A.x"]``."""
        from dalembert.analysis.result.named_quantities import quantity

        return quantity(self, name).values

    def keys(self) -> list[str]:
        """Names of its quantities, without components."""
        from dalembert.analysis.result.named_quantities import quantity_names

        return quantity_names(self)

    @property
    def codes(self) -> Array:
        """Statuses (P,)."""
        return np.array(self.status, object)

    def compared(self) -> Tree:
        """Data that equal results share: the description, the requested motion, and all numbers."""
        return super().compared() | {"mechanism": self.mechanism, "schedule": self.schedule}

    def plot(
        self, *names: str, ax: Any = None, against: str | None = None, notation: Notation | None = None
    ) -> Any:
        """Curves of quantities over the cycle, ``r.plot("effort.O2")``: a Scene, or drawn on matplotlib's ``ax``.

        Of a vector all components and its size; against the first drive or a quantity. Without names the efforts.
        """
        from dalembert.notebook.plots import plot

        return plot(self, names, ax, against, notation)

    def polar(
        self, *joints: str, axes: Axes = "ground", ax: Any = None, notation: Notation | None = None
    ) -> Any:
        """Polar diagram of joint forces on each joint's j: a Scene, or drawn on matplotlib's ``ax``."""
        from dalembert.notebook.plots import polar

        return polar(self, joints, axes, ax, notation)

    def draw(
        self, view: View = "mechanism", at: PositionChoice = None, notation: Notation | None = None
    ) -> Scene:
        """A drawing: the mechanism, free-bodies, force-polygons, charts, motion or all; ``da.draw`` has them singly."""
        from dalembert.views import draw as drawings

        return drawings.view(self, view, at, notation)

    @property
    def schedule(self) -> Schedule:
        """Positions, speeds and accelerations of the drives."""
        return self.compiled.schedule

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints."""
        return self.compiled.joints

    @property
    def drives(self) -> tuple[str, ...]:
        """Names of the drives."""
        return tuple(self.schedule.names)

    @property
    def unknown_loads(self) -> tuple[str, ...]:
        """Names of the unknown loads."""
        return self.compiled.unknown_loads

    @cached_property
    def assumptions(self) -> dict[str, str]:
        """Assumptions behind the numbers, each as a phrase."""
        from dalembert.analysis.output.assumptions import assumptions

        return assumptions(self)

    @property
    def ok(self) -> Flags:
        """True where a position is solved, at a reversal for both sides of it."""
        return np.array([s in SOLVED for s in self.status])

    @property
    def reverses(self) -> Flags:
        """Positions with other numbers just before and just after: contacts reverse, or accelerations jump."""
        jumps = np.array([s == "jump" and self.after is not None for s in self.status], bool)
        alone = self.after is None or self.friction is None
        return jumps if alone else jumps | self.friction.reversing.any(axis=-1)  # type: ignore[union-attr]

    @property
    def sides(self) -> tuple[Result, ...]:
        """Two results, with the numbers just before reversals and just after; the result alone where there are none."""
        return (self,) if self.after is None else (replace(self, after=None), self.after)

    @property
    def before(self) -> Result:
        """The result with only the numbers just before reversals, as ``after`` has those just after."""
        return self.sides[0]

    def span(self, read: Callable[[Result], Array]) -> tuple[Array, Array]:
        """Low and high of what ``read`` takes from a result: just before and just after reversals, else one number."""
        from dalembert.analysis.result import outcome

        return outcome.span(self, read)

    def problems(self) -> list[tuple[str, str, str]]:
        """Runs of positions that are not ok: which ("3" or "3-7", counted from 1), status, sentence."""
        from dalembert.analysis.result import outcome

        return outcome.problems(self)

    # drives and unknown loads

    def drive_position(self, drive: str) -> Array:
        """Position of a drive (P,), rad or m."""
        return np.asarray(self.schedule.position[:, place_of(self.drives, drive, "drive")])

    def drive_speed(self, drive: str) -> Array:
        """Speed of a drive (P,), rad/s or m/s."""
        return np.asarray(self.schedule.speed[:, place_of(self.drives, drive, "drive")])

    def drive_acceleration(self, drive: str) -> Array:
        """Acceleration of a drive (P,), rad/s2 or m/s2."""
        return np.asarray(self.schedule.acceleration[:, place_of(self.drives, drive, "drive")])

    def effort(self, drive: str) -> Array:
        """Torque (N m) or force (N) of a drive on link j of its joint (P,), positive with the freedom."""
        k = place_of(self.drives, drive, "drive")
        return self._masked_unknown(self.effort_array[..., k], self._unknown_place(k))

    def unknown_load(self, name: str) -> Array:
        """Value of an unknown load (P,), N along its direction, or N m."""
        k = place_of(self.unknown_loads, name, "load")
        efforts = int(self.compiled.known.requested.sum())
        return self._masked_unknown(self.load_array[..., k], efforts + k)

    def _unknown_place(self, drive: int) -> int | None:
        requested = self.compiled.known.requested
        return int(requested[:drive].sum()) if requested[drive] else None

    def _masked_unknown(self, value: Array, place: int | None) -> Array:
        if self.unique_unknowns is None or place is None:
            return np.asarray(value)
        return np.where(self.unique_unknowns[..., place], value, np.nan)

    # reactions

    def reaction(self, joint: str, on: str | None = None, axes: Axes = "ground") -> Array:
        """Force of a joint on one of its links (P, d), default on j; NaN in components that are not unique.

        The other link as ``on`` only changes the sign. ``axes="link"`` gives components in the axes of the link acted
        on, in space ``axes="joint"`` in the joint's axes.
        """
        return self._wrench(joint, on, axes)[..., : self._d]

    def reaction_moment(self, joint: str, on: str | None = None, axes: Axes = "ground") -> Array:
        """Moment of a joint on one of its links about the joint's point on j: (P,), in space (P, 3)."""
        if self._d == 2:
            return self._wrench(joint, on, "ground")[..., 2]
        return self._wrench(joint, on, axes)[..., 3:]

    def unique(self, joint: str) -> Flags:
        """True for components of a joint's force and moment, in ground axes, that statics alone determines (P, n)."""
        from dalembert.analysis.result.reaction_axes import unique_in

        self._joint(joint, None)
        return unique_in(self, joint, "ground")

    def least_norm(self, joint: str, on: str | None = None, axes: Axes = "ground") -> Array:
        """Force and moment of a joint with the smallest sum of squares where they are not unique (P, n)."""
        return self._wrench(joint, on, axes, least=True)

    def _wrench(self, joint: str, on: str | None, axes: Axes, least: bool = False) -> Array:
        from dalembert.analysis.result.reaction_axes import wrench

        self._joint(joint, on)
        return wrench(self, joint, on, axes, least)

    def joint_axes(self, joint: str, moment: bool = False) -> Array:
        """In space: a joint's local axes x, y, z (P, 3, 3), a row each, in ground axes.

        Those of its ``moment`` are others in one joint only, the slotted sphere in a cylinder.
        """
        from dalembert.analysis.result.reaction_axes import axes_of

        self._joint(joint, None)
        return axes_of(self, joint, "joint", moment)

    def _joint(self, joint: str, on: str | None) -> tuple[int, float]:
        k = place_of(self.joints, joint, "joint")
        i, j = self.mechanism.joints[joint].links
        if on not in (None, i, j):
            raise ModelError(
                f"joint {joint!r} does not act on {on!r}", f"it joins {i} and {j}", ("joints", joint)
            )
        return k, -1.0 if on == i else 1.0

    # friction

    def friction_force(self, joint: str, on: str | None = None) -> Array:
        """Dry friction's part of a joint's force on one of its links (P, 2), default on j, ground axes."""
        k, sign = self._joint(joint, on)
        force = np.zeros_like(self.force_array) if self.friction is None else self.friction.force
        return sign * force[:, k]

    def friction_moment(self, joint: str, on: str | None = None) -> Array:
        """Dry friction's couple in a joint on one of its links (P,), in space (P, 3), default on j."""
        k, sign = self._joint(joint, on)
        moment = np.zeros_like(self.moment_array) if self.friction is None else self.friction.moment
        return sign * moment[:, k]

    def power_lost(self, joint: str, kind: Literal["dry", "viscous", "all"] = "all") -> Array:
        """Power that friction takes in a joint (P,), W."""
        from dalembert.analysis.friction import joint_friction

        self._joint(joint, None)
        return joint_friction.power_lost(self, joint, kind)

    def interval(self, name: str) -> Array:
        """Low and high end (P, 2) where motion impends, or one number twice; ``ends`` has the results of both."""
        from dalembert.analysis.friction import joint_friction

        return joint_friction.interval(self, name)

    def holding(self, name: str) -> Array:
        """Low and high (P, 2) of what friction can hold at rest for some history: ``interval`` or more; infinite where
        the contacts wedge and hold any value, NaN where it is not sought."""
        from dalembert.analysis.friction import joint_friction

        return joint_friction.holding(self, name)

    @property
    def time(self) -> Array | None:
        """Times (P,) of the positions, s, where the drives have a law of motion."""
        return self.schedule.time

    def freedom(self, joint: str, kind: str) -> tuple[Array, Array, Array]:
        """Value, rate and second rate of a joint's freedom `slide` or `turn`, each (P,)."""
        from dalembert.analysis.result.joint_freedoms import freedom_motion

        return freedom_motion(self, joint, kind)

    def shaking(self, about: str = "") -> Shaking:
        """Force and moment of the machine on its foundation, about a fixed point: `da.shaking`."""
        from dalembert.machine.shaking import shaking

        return shaking(self, about or None)

    def harmonics(self, of: str, orders: int | Sequence[float] = 4) -> Harmonics:
        """Harmonics over full turns of the first drive of a quantity: `effort.O2`, `reaction.A`, `shaking_force`."""
        from dalembert.machine.harmonics import harmonics
        from dalembert.machine.whole_cycle import turning_angle

        return harmonics(self[of], turning_angle(self), orders)

    def worst(self, quantity: Literal["effort", "reaction", "moment"], of: str) -> tuple[float, int]:
        """Largest magnitude over the positions, both sides of reversals counted, and the position (from 0) of it."""
        from dalembert.analysis.result import outcome

        return outcome.worst(self, quantity, of)

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Status, every number with its name and kind, and the reason of positions that are not ok."""
        from dalembert.analysis.output.columns import columns

        yield Column("status", WORD, self.codes)
        yield from columns(self, axes)
        yield Column("reason", WORD, np.array(self.reasons, object))

    def basis(self) -> dict[str, str]:
        """Title, source, assumptions and mobility."""
        return (
            super().basis() | self.assumptions | {"mobility": self.mobility.sentence if self.mobility else ""}
        )

    def head(self, units: UnitChoice = "SI", axes: Axes = "ground") -> Tree:
        """Part of the JSON answer that precedes the positions."""
        from dalembert.analysis.output.json_record import head

        return head(self, units, axes)

    def records(self, units: UnitChoice = "SI", axes: Axes = "ground", **choice: Any) -> Iterator[Tree]:
        """The positions of the JSON answer; ``others`` seeks the other solutions of friction."""
        from dalembert.analysis.output.json_record import position_records

        return position_records(self, units, axes, **choice)

    def labelled(self, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
        """Labelled arrays over position, drive, joint, link and component, and coordinates."""
        from dalembert.analysis.output.result_arrays import result_arrays

        return result_arrays(self, to, axes)

    def tabs(self, units: UnitChoice = "file", axes: Axes = "ground") -> Iterator[Tab]:
        """Positions, extremes, charts, and what the numbers rest on."""
        from dalembert.analysis.output.worksheets import result_tabs

        return result_tabs(self, units, axes)

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Sequence[Part]:
        """Tables, and sentences that may be empty."""
        from dalembert.analysis.output.summary.printed_answer import answer_parts

        return answer_parts(self, units, **choice)

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """Text that `dalembert solve` prints."""
        from dalembert.analysis.output.summary.printed_answer import answer_text

        return answer_text(self, units, **choice)

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """The worked solution of the first position; `da.report` has those of others."""
        from dalembert.reports.working import working

        return working(self, notation=notation)
