"""Counts the full turns of torsion springs, and of angles that loads depend on, independently of the list of positions.

A turn of a joint or a link that no drive determines is counted with the drives at their `assembly` values, else at 0.
At that position it is within half a turn of the value of `assembly`, the angle of j less that of i as written, or of 0
where neither link's is given. From this position it is followed through the motion. Where wheels that mesh or roll
determine it, it is counted at the first position, where their phase is set. A copy is counted as the image of its
original, at the drives' positions of the image.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dalembert.algebra import space
from dalembert.analysis.compile.compiled_mechanism import Compiled, Count
from dalembert.analysis.compile.copied_angles import Counted, copied_angle
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Array, Ints
from dalembert.core.constraints import measure
from dalembert.core.geometry import arm
from dalembert.core.layout import Angle, Pose
from dalembert.core.position.first_pose_plane import Guess
from dalembert.core.position.first_pose_space import ALONG, PoseGuess
from dalembert.core.position.motion_path import Path
from dalembert.core.position.whole_turns import (
    Way,
    phase_freedoms,
    phase_links,
    rigid_turns,
    straight_path,
    whole_turns,
)
from dalembert.errors import ModelError
from dalembert.model.quantities.coordinates import is_speed, parts

FARTHEST = 1e4
"""Longest path to the position where turns are counted, in radians or characteristic lengths."""

MANY = 200
"""Positions up to which, with several drives, each has a separate path to the position where turns are counted."""

DOUBTFUL = np.radians(20)
"""An angle this near to half a turn from what it is counted by could as well be meant a turn further."""


def wound(c: Compiled, first: tuple[int, Pose], path: Path) -> Compiled:
    """The mechanism with the full turns of its torsion springs and of the angles that its loads depend on, ``first``
    being the first position and its pose."""
    loads, rows = c.mechanism.loads_on("turn"), c.forcing.resistances.row
    names = list(loads)
    springs = [
        k for k, load in enumerate(loads.values()) if load.FORCE == "spring" and _open(c, int(rows[k]))
    ]
    of_loads = {name: angle for name in c.pose_names if (angle := _angle_of(c, name)) is not None}
    of_loads = {name: angle for name, angle in of_loads.items() if _open(c, angle)}
    if not (springs or of_loads) or not path.reached.any():
        return c
    counting = _Counting(c, first, path)
    turns = np.zeros((len(path.reached), len(rows)))
    counts = []
    for k in springs:
        turns[:, k], count = counting.offset_and_count(names[k], k, int(rows[k]))
        counts.append(count)
    resistances = replace(c.forcing.resistances, turns=turns)
    pose_turns = {name: counting.offset_and_count(name, -1, angle)[0] for name, angle in of_loads.items()}
    forcing = replace(c.forcing, resistances=resistances)
    return replace(c, forcing=forcing, counts=tuple(counts), pose_turns=pose_turns)


def _angle_of(c: Compiled, name: str) -> Counted | None:
    """The angle that a coordinate of a load names; None of a length and a speed."""
    kind, of, which = parts(name) or ("", "", "")
    if is_speed(name):
        return None
    if kind == "links":
        return of
    row = c.freedoms.index((of, which))
    return row if c.layout.freedoms.angular[row] else None


def _ends(c: Compiled, angle: Counted) -> tuple[int, int]:
    """Links i and j of an angle."""
    if isinstance(angle, str):
        return c.layout.links, c.links.index(angle)
    i, j = (int(end[angle]) for end in c.layout.freedoms.ends)
    return i, j


def _open(c: Compiled, angle: Counted) -> bool:
    """True if neither a drive nor constraints determine an angle."""
    if angle in c.layout.driven:
        return False
    i, j = _ends(c, angle)
    together = rigid_turns(c.layout)
    return bool(together[i] != together[j])


class _Counting:
    """Positions at which the turns of one mechanism are counted."""

    def __init__(self, c: Compiled, first: tuple[int, Pose], path: Path) -> None:
        self.c, self.path, (self.place, self.first) = c, path, first
        g, self.freedoms = c.layout.algebra, c.layout.freedoms
        self.guess = _stated_pose(c)
        stated = measure(g, self.freedoms, self.guess)[c.layout.driven]
        self.wanted = np.where(np.isfinite(stated), stated, 0.0)
        self.phased = phase_freedoms(c.layout, self.first)
        self.ways: dict[tuple[int, bytes], Way] = {}
        self.pieces = self._pieces()

    def _pieces(self) -> list[Ints]:
        """Positions that are counted together: those of a stretch. With several drives, paths on either side of a
        singular place may count turns differently, so every position has a separate path, if there are not too many."""
        path = self.path
        if len(self.wanted) > 1 and path.reached.sum() <= MANY:
            return [np.array([k]) for k in np.flatnonzero(path.reached)]
        numbers = np.unique(path.stretch[path.reached])
        return [np.flatnonzero(path.reached & (path.stretch == n)) for n in numbers]

    def offset_and_count(self, what: str, k: int, angle: Counted) -> tuple[Array, Count]:
        """Number of turns that the count adds to an angle at each position (P,), and how it was made."""
        path, with_phase = self.path, self._has_phase(angle)
        turns, margin = np.zeros((2, len(path.reached)))
        for number, mask in reversed(list(enumerate(self.pieces))):  # the first is told of
            wanted, near, stated = self._where(what, angle, number, mask)
            end = self._at_first() if with_phase else self._end(what, number, mask, wanted)
            phi = self._value(end, angle)
            counts = whole_turns(phi, np.array(near))
            turns[mask] = -2 * np.pi * counts
            margin[mask] = np.pi - abs(phi + turns[mask] - near)
        at = None if with_phase else wanted
        return turns, Count(what, k, near, stated, at, end.met, margin)

    def _where(self, what: str, angle: Counted, number: int, mask: Ints) -> tuple[Array, float, bool]:
        """The drives' positions where an angle is counted, and what it is counted by: of a copy the image's."""
        image = copied_angle(self.c, angle)
        if image is not None:
            wanted, near, stated = self._where(what, image.original, number, mask)
            return image.drives(self.c, wanted), image.alike.side * near + image.offset, stated
        end = self._at_first() if self._has_phase(angle) else self._end(what, number, mask, self.wanted)
        return self.wanted, *self._near(angle, end.pose)

    def _has_phase(self, angle: Counted) -> bool:
        if isinstance(angle, str):
            return bool(phase_links(self.c.layout, self.first)[self.c.links.index(angle)])
        return bool(self.phased[angle])

    def _value(self, end: Way, angle: Counted) -> Array:
        return np.asarray(
            end.pose.turn[self.c.links.index(angle)] if isinstance(angle, str) else end.phi[angle]
        )

    def _at_first(self) -> Way:
        phi = measure(self.c.layout.algebra, self.freedoms, self.first)
        return Way(self.first, phi, True)

    def _end(self, what: str, number: int, where: Ints, wanted: Array) -> Way:
        """Position where the motion of a piece comes nearest to the drives' positions at which turns are counted."""
        key = (number, wanted.tobytes())
        if key not in self.ways:
            c = self.c
            scale = np.where(c.layout.freedoms.angular[c.layout.driven], 1.0, c.layout.length)
            distances = np.abs((c.schedule.position[where] - wanted) / scale).max(axis=1, initial=0.0)
            self._refuse_endless(what, float(distances.min()))
            targets = np.concatenate([c.target, wanted])
            order = where[np.argsort(distances, kind="stable")]
            for k in dict.fromkeys(
                (order[0], order[-1])
            ):  # from the farthest too: the nearest may stand at the end itself
                self.ways[key] = straight_path(c.layout, self.path.pose.at(k), c.targets[k], targets)
                if self.ways[key].met:
                    break
        return self.ways[key]

    def _refuse_endless(self, of: str, distance: float) -> None:
        if distance > FARTHEST:
            heading = of if "." in of else f"torsion spring {of!r}"
            what = (
                f"{heading}: its turns are counted from {_drives(self.c, self.wanted)} on, and the "
                f"positions are {distance:.3g} rad or link lengths away"
            )
            raise ModelError(what, f"check their unit; {FARTHEST:.0e} of them can be followed", ("drives",))

    def _near(self, row: Counted, actual: Pose) -> tuple[float, bool]:
        """Reference value of the count of a turn, at a pose of the motion; whether the file gives it."""
        c, guess = self.c, self.guess
        if isinstance(row, str):
            stated = float(guess.turn[c.links.index(row)])
            return (stated, True) if np.isfinite(stated) else (0.0, False)
        ends = [int(end[row]) for end in self.freedoms.ends]
        known = [bool(np.isfinite(guess.rotation[k]).all()) for k in ends]
        if not any(k != c.layout.links and here for k, here in zip(ends, known, strict=True)):
            return 0.0, False
        g, turn = c.layout.algebra, actual.turn
        rotation = np.where(np.isfinite(guess.rotation), guess.rotation, actual.rotation)
        if g.d == 2:  # a link that is not named, nor settled by drives, is within half a turn of 0
            together = rigid_turns(c.layout)
            free = together != together[-1]
            turn = turn - 2 * np.pi * np.where(free, whole_turns(turn, np.array(0.0)), 0.0)
            mixed = Pose(actual.point, np.where(np.isfinite(guess.turn), guess.turn, turn), rotation)
        else:
            mixed = _as_written(c, Pose(actual.point, turn, rotation))
        return float(measure(g, self.freedoms, mixed)[row]), True


def _stated_pose(c: Compiled) -> Pose:
    """The poses (L+1, ...) that `assembly` states, NaN where it states none; angles as written."""
    g, guess = c.layout.algebra, c.guess
    point = guess.point.copy()
    point[-1] = 0.0
    if isinstance(guess, Guess):
        unstated = [k for k, link in enumerate(c.links) if link not in c.mechanism.assembly]
        turn = guess.turn.copy()
        turn[unstated] = point[unstated] = np.nan
        turn[-1] = 0.0
        return Pose(point, turn, g.rotation(turn))
    rotation = guess.rotation.copy()
    rotation[-1] = space.IDENTITY
    count = max((int(np.max(f.count)) + 1 for f in c.layout.counted), default=0)
    return _as_written(c, Pose(point, np.zeros(count), rotation))


def _as_written(c: Compiled, pose: Pose) -> Pose:
    """A pose in space with the turns of its joints as the angles of its links about their axes are written."""
    turn = np.zeros_like(pose.turn)
    raw = measure(c.layout.algebra, c.layout.freedoms, pose._replace(turn=turn))
    for f in c.layout.freedoms.families:
        if not isinstance(f, Angle):
            continue
        axes = arm(c.layout.algebra, pose, f.i, f.a)
        for row, place, i, j, axis in zip(f.row, f.count, f.i, f.j, axes, strict=True):
            (angle_i, turns_i), (angle_j, turns_j) = (_about(c, int(link), axis) for link in (i, j))
            both = angle_j - angle_i
            turn[place] = np.nan_to_num(both if np.isfinite(both) else raw[row] + turns_j - turns_i)
    return pose._replace(turn=turn)


def _about(c: Compiled, link: int, axis: Array) -> tuple[float, float]:
    """Angle of a link's stated pose about an axis, NaN where none is given, and the full turns written."""
    assert isinstance(c.guess, PoseGuess)
    angle, along = float(c.guess.angle[link]), float(np.dot(c.guess.axis[link], axis))
    if angle == 0.0:
        return 0.0, 0.0
    if not abs(along) > 1 - ALONG:
        return np.nan, 0.0
    turns = 2 * np.pi * float(whole_turns(np.array(angle), np.array(0.0)))
    return float(np.sign(along)) * angle, float(np.sign(along)) * turns


def _drives(c: Compiled, at: Array) -> str:
    """'O2 = 60 deg and s = 20 mm'."""
    angular = c.layout.freedoms.angular[c.layout.driven]
    kinds = ["angle" if turns else "length" for turns in angular]
    parts = zip(c.schedule.names, kinds, at, strict=True)
    return " and ".join(f"{n} = {quantity_text(c, kind, round(float(q), 12) + 0.0)}" for n, kind, q in parts)


def count_turns(c: Compiled, pose: Pose) -> dict[str, Array]:
    """Turn (P,) of each torsion spring that counts full turns."""
    values = measure(c.layout.algebra, c.layout.freedoms, pose) if c.counts else np.zeros(0)
    resistances = c.forcing.resistances
    return {n.spring: values[:, resistances.row[n.place]] + resistances.turns[:, n.place] for n in c.counts}


def count_notes(c: Compiled, pose: Pose) -> dict[str, str]:
    """Note on each of these turns: how it was counted, and where another full turn could be meant."""
    turns = count_turns(c, pose)
    return {
        _heading(c, n): _note(c, n, turns[n.spring]) for n in c.counts if np.isfinite(turns[n.spring]).any()
    }


def _heading(c: Compiled, n: Count) -> str:
    joint, freedom = c.freedoms[c.forcing.resistances.row[n.place]]
    return f"{freedom} of {joint} for {n.spring}"


def _note(c: Compiled, n: Count, turn: Array) -> str:
    k = int(np.argmax(np.isfinite(turn)))
    here = f" at {_drives(c, c.schedule.position[k])}" if c.schedule.names else ""
    near = f"{_angle(c, n.near)}{' of the assembly' if n.stated else ''}"
    if n.at is None:
        where = " at the first position, where its wheels have their phase"
    elif not c.schedule.names:
        where = ""
    elif n.met:
        where = f" at {_drives(c, n.at)}"
    else:
        where = f" where the motion towards {_drives(c, n.at)} ends"
    text = f"{_angle(c, turn[k])}{here}, counted to within half a turn of {near}{where}"
    if not two_directions(c, n, turn):
        return text
    others = " or ".join(_angle(c, turn[k] + step) for step in (-2 * np.pi, 2 * np.pi))
    return f"{text}; {others} could be meant too: the angles written in `assembly` choose"


def _angle(c: Compiled, value: float) -> str:
    return quantity_text(c, "angle", float(value) if abs(value) > 1e-12 else 0.0)  # not the rounding of 0


def two_directions(c: Compiled, n: Count, turn: Array) -> bool:
    """True if another full turn is as likely meant: deflected by more than half a turn, near the edge of the half turn
    where it is counted or away from it, or counted where the motion ends."""
    known = turn[np.isfinite(turn)]
    if not known.size:
        return False
    free = float(c.forcing.resistances.free[n.place])
    far = np.abs(known - free).max() > np.pi or np.abs(known - n.near).max() > np.pi
    edge = n.margin[np.isfinite(turn)].min() < DOUBTFUL
    return bool(far or edge or not n.met)
