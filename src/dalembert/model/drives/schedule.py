"""The positions of all drives together: ranges advance together, single values combine with any."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.model.drives.drives import Drive, Range
from dalembert.model.drives.programmes import Programme
from dalembert.model.drives.written_programmes import MOST
from dalembert.wording import closest, quote_value

Motion = tuple[Any, Any, Any, Any]
"""Time, if a law says it, position, speed and acceleration of a drive: arrays, lists or single numbers."""


@dataclass(frozen=True)
class Schedule:
    """Motion of the drives, position by position.

    position, speed, acceleration: (positions, drives), SI and radians; an unknown position is NaN
    after:   (positions, drives) accelerations just after, where that of a law jumps; None where none does
    time:    (positions,) of a law of motion, else None
    parts:   (positions, contacts) of friction's limit at contacts without a rate, where it is known; else NaN, None
    unknown: the drive whose position is unknown, and the `range` in which it is sought
    """

    names: tuple[str, ...]
    position: Array
    speed: Array
    acceleration: Array
    time: Array | None = None
    unknown: str | None = None
    range: tuple[float, float] | None = None
    parts: Array | None = None
    began: Array | None = None
    """Positions (drives,) at time 0; None for the first."""
    after: Array | None = None

    @property
    def clock(self) -> Array | None:
        """Time (positions,): of a law, or of the first drive that moves, at a constant speed, from where it began; 0 of
        one position; None where it is not known."""
        import numpy as np

        driven = np.flatnonzero((self.speed != 0).any(axis=0))
        if self.time is not None or not driven.size:
            return np.zeros(1) if self.time is None and self.count == 1 else self.time
        k = int(driven[0])
        if np.ptp(self.speed[:, k]) or self.acceleration[:, k].any():
            return np.zeros(1) if self.count == 1 else None
        first = self.position[0] if self.began is None else self.began
        return np.asarray((self.position[:, k] - first[k]) / self.speed[0, k])

    @property
    def jumps(self) -> Flags:
        """True (positions, drives) where the acceleration that a drive's law prescribes jumps."""
        import numpy as np

        if self.after is None:
            return np.zeros(self.acceleration.shape, bool)
        return np.asarray(self.after != self.acceleration)

    @property
    def just_after(self) -> Schedule:
        """The motion with the accelerations just after jumps of the laws."""
        return self if self.after is None else replace(self, acceleration=self.after, after=None)

    @property
    def count(self) -> int:
        """The number of positions."""
        return len(self.position)

    @property
    def moves(self) -> Flags:
        """True at the positions (positions,) where the machine moves: some drive has a speed, or all are at rest only
        to reverse between two positions where they move."""
        import numpy as np

        moving: Flags = (self.speed != 0).any(axis=1)
        turning = np.zeros_like(moving)
        turning[1:-1] = moving[:-2] & moving[2:] & (self.acceleration != 0).any(axis=1)[1:-1]
        return np.asarray(moving | turning)


AtPositions = int | Sequence[Any] | Array | None
"""A number of positions, or the drives' values (position,) or (position, drive), SI; None for those of the file."""


def schedule(drives: Mapping[str, Drive], positions: AtPositions = None) -> Schedule:
    """The drives' positions; a count replaces those of ranges and laws, or steps a lone turn round; values replace all.

    Raises ModelError where counts disagree, and for a count that is not an integer.
    """
    import numpy as np

    count: int | None = None
    if isinstance(positions, (int, float, np.number)):
        count = positions = _whole_number(positions)
        drives = _step_full_turn(drives, positions)
    elif positions is not None:
        drives = _with_positions(drives, positions)
    size = _count(drives, count)
    columns = _columns(drives, size, before=True)
    position, speed, acceleration = _arrays(columns, size)
    after = acceleration
    if any(isinstance(drive.law, Programme) for drive in drives.values()):
        after = _arrays(_columns(drives, size, before=False), size)[2]
    unknown = _unknown(drives)
    span = (drives[unknown].range or (0.0, 2 * math.pi)) if unknown else None
    return Schedule(
        names=tuple(drives),
        position=position,
        speed=speed,
        acceleration=acceleration,
        time=_time(columns),
        unknown=unknown,
        range=span,
        began=position[0],
        after=after if (after != acceleration).any() else None,
    )


def _columns(drives: Mapping[str, Drive], size: int, before: bool) -> dict[str, Motion]:
    """The motion of each drive; where its acceleration jumps, just after it or ``before`` it."""
    alone = {name: _motion(drive, size, before) for name, drive in drives.items() if not _master(drive)}
    return _with_followers(drives, alone, before)


def _arrays(columns: Mapping[str, Motion], size: int) -> Array:
    """Position, speed and acceleration (3, positions, drives)."""
    import numpy as np

    motion = np.empty((3, size, len(columns)))
    for k, column in enumerate(columns.values()):
        for row, values in zip(motion, column[1:], strict=True):
            row[:, k] = values
    return motion


def _whole_number(count: object) -> int:
    """A number of positions; True and 72.0 are none."""
    from numbers import Integral

    if isinstance(count, bool) or not isinstance(count, Integral):
        raise ModelError(
            f"positions={count} is not an integer", "give a number of positions, or a list of values"
        )
    return int(count)


def _with_positions(drives: Mapping[str, Drive], values: Sequence[Any] | Array) -> Mapping[str, Drive]:
    """The drives at given values, SI."""
    import numpy as np

    what = "give a list of numbers, one for each position and drive"
    try:
        table = np.asarray(values, float)
    except (TypeError, ValueError):
        raise ModelError(f"positions are {quote_value(values)}, not numbers", what) from None
    count = len(drives)
    flat = table.ndim == 1 and count and table.size % count == 0
    if not table.size or not (flat or (table.ndim == 2 and table.shape[1] == count)):
        raise ModelError(
            f"positions of shape {table.shape} do not fit {count} drive(s)", "give (position, drive)"
        )
    if not np.isfinite(table).all():
        raise ModelError("positions are not finite", what)
    for name, drive in drives.items():
        if drive.law is not None or drive.unknown:
            why = "follows a law, which gives its positions" if drive.law else "has its position computed"
            raise ModelError(f"drive {name!r} {why}", "leave positions out", ("drives", name))
    columns = table.reshape(-1, count).T.tolist()
    return {
        name: drive.model_copy(update={"position": tuple(column)})
        for (name, drive), column in zip(drives.items(), columns, strict=True)
    }


def _step_full_turn(drives: Mapping[str, Drive], positions: int) -> Mapping[str, Drive]:
    """The drives, a lone turn of one value stepped round a full turn."""
    if not 1 <= positions <= MOST:
        raise ModelError(f"positions={positions} is out of range", f"use 1 to {MOST}")
    if positions == 1 or any(drive.counts() for drive in drives.values()):
        return drives
    sought = [name for name, drive in drives.items() if drive.unknown]
    if sought or not drives:
        why = (
            f"the positions of drive {sought[0]!r} are computed within its range"
            if sought
            else "a structure has no drive"
        )
        what = f"positions={positions} cannot be used: {why}"
        raise ModelError(what, "leave the number out", ("drives",))
    turning = [name for name, drive in drives.items() if drive.turns]
    if len(turning) != 1:
        raise ModelError(
            f"positions={positions} needs one drive that turns, not {len(turning)} ({', '.join(turning) or 'none'})",
            "give one drive its steps in the file: position: {from: 0 deg, to: 360 deg, count: 72}",
            ("drives",),
        )
    drive = drives[turning[0]]
    start = float(drive.position)  # type: ignore[arg-type]
    turn = Range(start, start + 2 * math.pi, positions)
    return {**drives, turning[0]: drive.model_copy(update={"position": turn})}


def _count(drives: Mapping[str, Drive], positions: int | None) -> int:
    """The number of positions all drives agree on."""
    counts: dict[int, str] = {}
    for name, drive in drives.items():
        listed = [number for key, number in drive.counts().items() if isinstance(getattr(drive, key), tuple)]
        for number in listed or drive.counts().values():
            counts.setdefault(number if listed or positions is None else positions, name)
    if len(counts) > 1 or (positions is not None and counts and positions not in counts):
        text = " and ".join(f"{number} of drive {name!r}" for number, name in counts.items())
        requested = f", but positions={positions}" if positions is not None else ""
        raise ModelError(
            f"the numbers of positions differ: {text}{requested}",
            "drives advance together: give equal counts, or single values"
            if len(counts) > 1
            else "the list sets the count: leave the number out, or write {from, to, count}",
            ("drives", list(counts.values())[-1]),
        )
    return next(iter(counts), 1)


def _motion(drive: Drive, size: int, before: bool) -> Motion:
    """Time, position, speed and acceleration of one drive."""
    if isinstance(drive.law, Programme):
        return drive.law.motion(size, before)
    if drive.law is not None:
        return drive.law.motion(size)
    position: object = drive.position
    if isinstance(position, Range):
        position = _steps(position, size, drive.turns) if size > 1 else position.start
    elif isinstance(position, str):
        position = math.nan
    return None, position, drive.speed, drive.acceleration


def _master(drive: Drive) -> str:
    """The drive over whose position a law is; empty for none."""
    return drive.law.over if isinstance(drive.law, Programme) else ""


def _with_followers(drives: Mapping[str, Drive], known: dict[str, Motion], before: bool) -> dict[str, Motion]:
    """The motions of all drives, those over another one's position among them."""
    import numpy as np

    waiting = {name: _master(drive) for name, drive in drives.items() if name not in known}
    while ready := [name for name, master in waiting.items() if master in known]:
        for name in ready:
            law, master = drives[name].law, waiting.pop(name)
            assert isinstance(law, Programme)
            position, speed, acceleration = (np.asarray(x, float) for x in known[master][1:])
            motion = np.broadcast_arrays(position, speed, acceleration)
            known[name] = (known[master][0], *law.following(motion[0], motion[1], motion[2], before))
    for name, master in waiting.items():
        circle = master in drives
        raise ModelError(
            f"the law of drive {name!r} is over {quote_value(master)}, "
            + ("and they are over each other in a circle" if circle else "which is not a drive"),
            "let one of them depend on time" if circle else closest(master, [n for n in drives if n != name]),
            ("drives", name, "law", "over"),
        )
    return {name: known[name] for name in drives}


def _steps(span: Range, size: int, turns: bool) -> Array:
    import numpy as np

    turned = abs(span.stop - span.start) / (2 * math.pi)
    full = turns and turned > 0.5 and abs(turned - round(turned)) < 1e-9
    return np.linspace(span.start, span.stop, size, endpoint=not full)


def _time(columns: Mapping[str, Motion]) -> Array | None:
    """The time of the laws, which must agree."""
    import numpy as np

    times = {name: column[0] for name, column in columns.items() if column[0] is not None}
    first = next(iter(times), None)
    for name, time in times.items():
        if not np.allclose(time, times[first], rtol=1e-9, atol=0.0):  # type: ignore[index]
            what = f"the laws of drives {first!r} and {name!r} have different times"
            raise ModelError(what, "give them the same duration", ("drives", name, "law"))
    return times[first] if first is not None else None


def _unknown(drives: Mapping[str, Drive]) -> str | None:
    names = [name for name, drive in drives.items() if drive.unknown]
    if len(names) > 1:
        what = f"the positions of {len(names)} drives are unknown: {', '.join(names)}"
        raise ModelError(what, "leave one unknown, give the others", ("drives", names[1], "position"))
    return names[0] if names else None
