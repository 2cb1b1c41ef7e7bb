"""Entries into ranges behind a gap: by closed forms, else by Newton and a search.

Meshing and rolling wheels are held while closed forms place the links, then turned into their phase.

Mechanics: docs/theory.md 3.2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Final, Literal, NamedTuple, Protocol

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.constraints import measure, stack_rows
from dalembert.core.factor import displacement, displacements
from dalembert.core.layout import Layout, Pose
from dalembert.core.position.assembly_modes import on_sides
from dalembert.core.position.assur_groups import DiagonalBlock, groups, on_independent_rows, senses
from dalembert.core.position.assur_plan import PlacementPlan, plan
from dalembert.core.position.dyads import sides
from dalembert.core.position.first_pose_plane import Guess, held_wheels, phase_rows, with_rows
from dalembert.core.position.newton import CLOSED, close_loops, displace, distance, gap
from dalembert.core.position.path_parameter import PathSamples

SAME = 1e-6
"""Distance over characteristic length, or turn, below which two modes are the same."""

BETWEEN = 8
"""Subdivisions of the step between two positions in the search for a gap."""

STEADY = 1e-6
"""Change of a wheel's turn per turn of a drive, from pose to pose, below which its train is driven."""

MOST_GAPS = 64
"""Largest number of entries behind gaps that no closed form locates."""

SAMPLED = 36
"""Largest number of positions at once where an entry is sought; a range that lies between them is not met."""

NOWHERE: Final = "nowhere"

Entry = tuple[int, Pose]
"""Index of a position in the list, and its pose."""

Known = Callable[[], tuple[Pose, Flags]]
"""Poses (P, L+1, ...) of the positions, and flags (P,) for those reached so far."""


class Ways(Protocol):
    """Source of a linkage's assembly modes (``Guess``, ``PoseGuess``)."""

    @property
    def stated(self) -> Array | None:
        """Given angles of the links (L+1,), NaN where unknown; None in space."""

    def every(self, layout: Layout, target: Array) -> Any:
        """All modes at a target (K + D,), poses (M, L+1, ...) in ``pose``; None where the linkage does not close."""


def entries(
    layout: Layout, first: Pose, along: PathSamples, now: Known, search: Ways | None
) -> Iterator[Entry]:
    """Poses at positions not reached, one in each range of them, with every group on the first pose's side."""
    held = _hold_wheels(layout, _spread(along, *now()))
    group_plan = plan(held.layout)
    if group_plan is not None and group_plan.closed:
        return _closed_form_entries(layout, held, group_plan, first, along, now()[1], search)
    return _sought(layout, held, first, along, now, search)


class Held(NamedTuple):
    """A layout without phases: its remaining rows (K',), and wheels (H,) held instead of the others.

    A wheel is held at the angle to which the drives turn it, by its rates (H, D), from a known pose with the drives at
    ``drives`` (D,). The rates are those of a driven train, constant over all known poses; 0 where only its phase turns
    it.
    """

    layout: Layout
    kept: Ints
    turn: Array
    drives: Array
    rates: Array

    def targets(self, target: Array) -> Array:
        """Targets (P, K' + H + D) by those with phases (P, K + D)."""
        drives = target[:, target.shape[1] - len(self.drives) :]
        angles = self.turn + (drives - self.drives) @ self.rates.T
        return np.concatenate([target[:, self.kept], angles, drives], axis=1)


def _hold_wheels(layout: Layout, poses: Pose) -> Held:
    """The layout with wheels held instead of their phases, where it has any; never in space."""
    count, phased = layout.constraints.count, phase_rows(layout.constraints)
    kept = np.setdiff1d(np.arange(count), phased)
    here = measure(layout.algebra, layout.stack, poses.at(0))
    if not phased.size or layout.algebra.d != 2:
        return Held(layout, np.arange(count), np.zeros(0), here[count:], np.zeros((0, len(here) - count)))
    free = with_rows(layout, kept, [])
    stood = Guess(poses.turn[0], poses.point[0])
    held = held_wheels(layout, free, np.concatenate([here[kept], here[count:]]), phased, stood)
    one = np.eye(len(here))[count:] * layout.row_scale[count:, None]
    each = [
        displacements(layout, stack_rows(layout, poses.at(slice(k, k + 1))), one)[0]
        for k in range(len(poses.turn))
    ]
    rates = np.reshape(each, (len(each), len(one), layout.links, -1))[:, :, held, -1]
    rates = np.where(np.ptp(rates, axis=0) <= STEADY * (1 + np.abs(rates[0])), rates[0], 0.0).T
    return Held(with_rows(layout, kept, held), kept, poses.turn[0, held], here[count:], rates)


def _closed_form_entries(
    layout: Layout,
    held: Held,
    group_plan: PlacementPlan,
    first: Pose,
    along: PathSamples,
    known: Flags,
    search: Ways | None,
) -> Iterator[Entry]:
    """Entries where groups in closed form close on the first pose's sides: the middle of each range not yet reached.

    Each range is behind a detected gap; where no gap is, the march stopped at a place that it could not pass.
    """
    turn = np.full(layout.links + 1, np.nan) if search is None or search.stated is None else search.stated
    reached = known[along.order]
    part = np.arange(BETWEEN) / BETWEEN
    s = np.append((along.s[:-1, None] + np.diff(along.s)[:, None] * part).ravel(), along.s[-1])
    listed = np.arange(len(s)) % BETWEEN == 0
    settled = np.zeros(len(s), bool)  # reached, or between two that are: no range ends there
    settled[:-1] = np.repeat(reached[:-1] & reached[1:], BETWEEN)
    settled[listed] = reached
    unsettled = np.flatnonzero(~settled)
    targets = np.concatenate([along.target(x) for x in s[unsettled]])
    which, poses = on_sides(held.layout, group_plan, held.targets(targets), first, turn)
    if held.layout is not layout:
        good, poses = _turn_wheels(layout, group_plan, poses, targets[which])
        which = which[good]
    closes = settled.copy()
    closes[unsettled[which]] = True
    pose = dict(zip(unsettled[which].tolist(), range(len(which)), strict=True))
    for run in np.split(np.arange(len(s)), np.flatnonzero(np.diff(closes)) + 1):
        places = run[listed[run]]
        if closes[run[0]] and places.size and not settled[run].any():
            middle = int(places[len(places) // 2])
            yield int(along.order[middle // BETWEEN]), poses.at(pose[middle])


def _turn_wheels(layout: Layout, group_plan: PlacementPlan, held: Pose, targets: Array) -> tuple[Ints, Pose]:
    """Indices of the poses (P, L+1, ...) with held wheels that close, every group on its side, once the wheels are in
    phase, and the poses."""
    missing = gap(layout, held, targets)
    with np.errstate(all="ignore"):  # at once, however far: a phase is linear in its wheel's angle
        dq = displacement(layout, stack_rows(layout, held), missing)
    pose = displace(layout, held, dq.reshape(len(targets), layout.links, layout.algebra.n))
    pose, open_ = close_loops(layout, pose, targets)
    nothing = np.full((len(targets), targets.shape[1]), np.nan)
    with np.errstate(all="ignore"):
        same = sides(group_plan, pose.turn, pose.point, nothing) == sides(
            group_plan, held.turn, held.point, nothing
        )
    good = np.flatnonzero((open_ <= CLOSED * layout.length) & same.all(axis=1))
    return good, pose.at(good)


class Fast(NamedTuple):
    """Data for the search of entries: a layout with a fast solver, without phases, its groups and their senses (G,)."""

    layout: Layout
    held: Held
    kinds: list[DiagonalBlock]
    sense: Array


def _sought(
    layout: Layout, held: Held, first: Pose, along: PathSamples, now: Known, search: Ways | None
) -> Iterator[Entry]:
    """Entries computed by Newton from the known poses, or by a search, on the first pose's sides."""
    kinds = groups(layout, _spread(along, *now()))
    if not kinds:
        return
    sense, tried = senses(layout, kinds, first.at(None)), np.zeros(len(along.s), bool)
    fast, never = Fast(on_independent_rows(layout, first), held, kinds, sense), np.zeros(len(along.s), bool)
    for _ in range(MOST_GAPS):
        missing = along.order[~(now()[1] | tried)[along.order]]
        guess = _spread(along, *now())
        for k in missing[np.unique(np.linspace(0, len(missing) - 1, min(len(missing), SAMPLED)).astype(int))]:
            target = along.target(along.at(int(k)))[0]
            entry = _entry(layout, fast, target, guess, None if never[k] else search)
            if isinstance(entry, Pose):
                break
            never[k] |= entry is NOWHERE
        else:
            return
        tried[k] = True
        yield int(k), entry


def _spread(along: PathSamples, pose: Pose, reached: Flags) -> Pose:
    """A few of the known poses, spread over the course."""
    good = along.order[reached[along.order]]
    return pose.at(good[np.linspace(0, len(good) - 1, min(len(good), 24)).astype(int)])


def _entry(
    layout: Layout, fast: Fast, target: Array, guess: Pose, search: Ways | None
) -> Pose | Literal["nowhere"] | None:
    """A pose at one target with the groups' given senses: from the nearest known pose that converges, else the only
    mode that a search finds; NOWHERE where it finds none. In space the number of turns of meshing wheels is unknown."""
    pose, _ = close_loops(fast.layout, guess, np.broadcast_to(target, (len(guess.point), len(target))).copy())
    fits = _fitting(layout, fast, pose, target, 0.0)
    if fits.any():
        return pose.at(np.flatnonzero(fits)[np.argmin(distance(layout, pose, guess)[fits])])
    if search is None or phase_rows(fast.held.layout.constraints).size:
        return None
    modes = search.every(fast.held.layout, fast.held.targets(target[None])[0])
    if modes is None:
        return NOWHERE
    pose, _ = close_loops(
        fast.layout, modes.pose, np.broadcast_to(target, (len(modes.pose.point), len(target))).copy()
    )
    pose = pose.at(np.flatnonzero(_fitting(layout, fast, pose, target, 0.5)))
    one = len(pose.point) > 0 and bool((distance(layout, pose, pose.at(slice(0, 1))) <= SAME).all())
    return pose.at(0) if one else None


def _fitting(layout: Layout, fast: Fast, pose: Pose, target: Array, least: float) -> Flags:
    """Poses (P, L+1, ...) that meet a target with all rows, their groups' senses as given."""
    missing = np.abs(gap(layout, pose, np.broadcast_to(target, (len(pose.point), len(target))))).max(axis=1)
    same = senses(layout, fast.kinds, pose) * fast.sense >= least
    return np.asarray((missing <= CLOSED * layout.length) & same.all(axis=1))
