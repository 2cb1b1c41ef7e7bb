"""Speeds of a plane that turns: given, or those at which the effort of a drive is the one given.

Without friction the effort is linear in the square of the speed, and virtual work gives it. With friction it is linear
piece by piece: secants find it; at rest two, at which the drive is about to move in either direction.
Mechanics: docs/theory.md 4.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import Check, arc
from dalembert.analysis.result.force_arrays import Friction, SolvedForces
from dalembert.arrays import Array, Flags, Ints
from dalembert.core.elements.turning_frame import centrifugal, turning_square
from dalembert.core.equilibrium import Known, LinkMotions
from dalembert.core.forcing import Forcing, TurningFrame, WrenchSource
from dalembert.core.layout import Layout, Pose

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled

STEPS = 40
"""Secants after which the last square of the speed is accepted: the residual decides."""

CLOSE = 1e-15
"""Relative change of the square of the speed that is rounding."""


def solves_speed(c: Compiled) -> bool:
    """True if the speed of a turning frame is unknown."""
    return c.forcing.turning is not None and c.forcing.turning.driven >= 0


Solve = Callable[[Forcing, Mapping[str, WrenchSource]], SolvedForces]
"""Forces under loads, and their wrenches by kind."""


def at_speed(
    solve: Solve,
    layout: Layout,
    known: Known,
    forcing: Forcing,
    pose: Pose,
    moving: LinkMotions,
    sources: Mapping[str, WrenchSource],
) -> SolvedForces:
    """Forces; where the speed of a turning frame is unknown that at which the given effort moves the machine, at rest
    with friction both ends of the interval that holds it, and in ``square`` the speed without friction."""
    frame = forcing.turning
    if frame is None or frame.driven < 0:
        return solve(forcing, sources)
    bare = turning_square(layout, forcing, pose, moving.virtual, sources)
    s = _Squares(solve, layout, forcing, pose, sources, np.broadcast_to(bare, (len(pose.point),)))
    base = s.forces(s.bare)
    if base.friction is None and not forcing.separation.any():
        return _given(base._replace(square=s.bare), frame)
    open_: Flags = np.zeros(len(s.bare), bool)
    if base.friction is not None and base.ends:
        open_ = np.asarray(base.friction.open.any(axis=-1))
    moved = np.where(open_, s.bare, s.square(lambda f: f.effort[:, frame.driven]))
    out, ends = s.forces(moved), list(base.ends)
    first = 2 * int(known.requested[: frame.driven].sum())
    for k in range(first, first + 2) if ends else ():
        square = np.where(open_, s.square(lambda f, k=k: f.ends[k].effort[:, frame.driven]), moved)  # type: ignore[misc]
        ends[k] = s.forces(square).ends[k]._replace(square=square)
    ends = [end if end.square is not None else end._replace(square=s.bare) for end in ends]
    out = out._replace(square=moved, ends=tuple(_given(end, frame) for end in ends))
    return _given(out._replace(friction=_without_range(out.friction, first // 2)), frame)


def _without_range(friction: Friction | None, unknown: int) -> Friction | None:
    """Friction without what depends on a power or a range of the effort that is given."""
    if friction is None:
        return None
    held = friction.holding.copy()
    held[:, unknown] = np.nan
    return friction._replace(locked=np.zeros_like(friction.locked), holding=held)


def _given(f: SolvedForces, frame: TurningFrame) -> SolvedForces:
    """Forces with the given effort instead of the one that the computed speed meets but for rounding."""
    effort = f.effort.copy()
    known = np.isfinite(effort[:, frame.driven])
    effort[known, frame.driven] = frame.effort[known]
    return f._replace(effort=effort)


MET = 1e-9
"""Part of the efforts by which one may differ from the one given."""


class _Squares:
    """Squares of the speed at which an effort is the one given."""

    def __init__(
        self,
        solve: Solve,
        layout: Layout,
        forcing: Forcing,
        pose: Pose,
        sources: Mapping[str, WrenchSource],
        bare: Array,
    ) -> None:
        assert forcing.turning is not None
        self.solve, self.layout, self.forcing, self.pose = solve, layout, forcing, pose
        self.frame, self.sources, self.bare = forcing.turning, sources, bare

    def forces(self, square: Array) -> SolvedForces:
        """Forces at squares (P,) of the speed."""
        frame = replace(self.frame, square=square, driven=-1)
        turning = centrifugal(self.layout, self.forcing.inertia, frame, self.pose, square)
        return self.solve(replace(self.forcing, turning=frame), {**self.sources, "turning": turning})

    def square(self, read: Callable[[SolvedForces], Array]) -> Array:
        """Squares (P,) at which what is read is the given effort, NaN where none exists."""
        a, b = self.bare, self.bare * 1.01
        fa = read(self.forces(a)) - self.frame.effort
        for _ in range(STEPS):
            fb = read(self.forces(b)) - self.frame.effort
            step = np.where(fb == fa, 0.0, fb * (b - a) / np.where(fb == fa, 1.0, fb - fa))
            size = np.abs(b * (fb - fa)) + np.abs(self.frame.effort * (b - a))
            met = np.abs(fb * (b - a)) <= MET * size
            a, fa, b = b, fb, b - step
            if (~(np.abs(step) > CLOSE * np.abs(b))).all():
                break
        return np.where(met | (step == 0), b, np.nan)


NO_SPEED = (
    "No speed of turning gives {drive} its effort{arc}: the centrifugal forces {why}. Change the range of the motion, "
    "the loads or the effort."
)


def speed_checks(c: Compiled, f: SolvedForces) -> list[Check]:
    """Positions that no real speed balances."""
    squares = [s.square for s in (f, *f.ends) if s.square is not None]
    if not squares:
        return []
    worst = np.min(squares, axis=0)

    def sentence(run: Ints) -> str:
        frame = c.forcing.turning
        assert frame is not None
        pulls = (np.isfinite(worst[run]) & (worst[run] < 0)).any()
        why = "would have to pull towards the axis" if pulls else "have no power here"
        return NO_SPEED.format(drive=c.schedule.names[frame.driven], arc=arc(c, run), why=why)

    return [("no_balance", ~(worst >= 0) | ~np.isfinite(worst), sentence)]


def with_speed(c: Compiled, square: Array | None) -> Compiled:
    """The mechanism with the speed of its frame that was solved for."""
    frame = c.forcing.turning
    if square is None or frame is None:
        return c
    return replace(c, forcing=replace(c.forcing, turning=replace(frame, square=square, driven=-1)))
