"""Mobility by rank: freedoms, drives, redundant constraints, and what to do when they do not match.

Mechanics: docs/theory.md 3.4.
"""

from __future__ import annotations

from dataclasses import dataclass

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.core.layout import Pose
from dalembert.core.rank import Rank, rank, well_driven
from dalembert.errors import ModelError


@dataclass(frozen=True)
class Mobility:
    """Freedoms of the mechanism, how many drives it has, redundant constraints and the joints they are in.

    ``passive`` are links whose spin moves nothing else; it is not counted.

    >>> import dalembert as da
    >>> da.mobility(da.four_bar()).freedoms
    1
    """

    freedoms: int
    drives: int
    redundant: int
    redundant_joints: tuple[str, ...]
    passive: tuple[str, ...] = ()

    @property
    def sentence(self) -> str:
        """Mobility in words.

        >>> Mobility(1, 1, 0, ()).sentence
        'mobility 1, driven by 1 drive, no redundant constraint'
        """
        drives = _count(self.drives, "drive") if self.drives else "no drive"
        more = _count(self.redundant, "redundant constraint")
        where = f" among joints {', '.join(self.redundant_joints)}" if self.redundant else ""
        spin = (
            f"; {' and '.join(self.passive)} could spin between ball joints: no spin" if self.passive else ""
        )
        return f"mobility {self.freedoms}, driven by {drives}, {more}{where}{spin}"

    def __str__(self) -> str:
        return self.sentence


def mobility_at(c: Compiled, pose: Pose, special: bool = False) -> Mobility:
    """Mobility at a pose; refused with the counts and names where drives and freedoms do not match.

    A ``special`` pose may be a dead centre, where a right drive moves nothing: then only the counts must match.
    """
    drives = len(c.schedule.names)
    if well_driven(c.layout, pose):
        return Mobility(c.layout.unknowns - c.layout.constraints.count, drives, 0, (), c.passive)
    ranked = rank(c.layout, pose)
    at = c.layout.constraints.joint[ranked.repeated]
    joints = tuple(dict.fromkeys(c.joints[k] for k in at[at >= 0])) if ranked.redundant else ()
    result = Mobility(ranked.freedoms, drives, ranked.redundant, joints, c.passive)
    if not (special and ranked.freedoms == drives):
        check_drives(c, ranked, result)
    return result


COUNTS = "the mechanism has {freedoms} and {drives}"
ADD = "add {drives}{where}, or constrain the links that can still move: {loose}"
NAMED = 6
"""Freedoms that are named at most."""


def check_drives(c: Compiled, ranked: Rank, mobility: Mobility) -> None:
    """Drives must equal freedoms."""
    missing = mobility.freedoms - mobility.drives
    path = ("drives",) if mobility.drives else ("joints",)
    counts = COUNTS.format(
        freedoms=_count(mobility.freedoms, "degree of freedom", "degrees of freedom"),
        drives=_count(mobility.drives, "drive"),
    )
    if missing < 0:
        names = ", ".join(c.schedule.names)
        raise ModelError(counts, f"remove {_count(-missing, 'drive')} of {names}", path)
    if missing > 0 or ranked.loose.any():
        loose = ", ".join(name for name, moves in zip(c.links, ranked.loose, strict=True) if moves)
        free = [f"{j} ({kind})" for (j, kind), moves in zip(c.freedoms, ranked.free, strict=True) if moves]
        where = f" at {'one' if missing <= 1 else 'some'} of {', '.join(free[:NAMED])}" if free else ""
        remedy = ADD.format(drives=_count(max(missing, 1), "drive"), where=where, loose=loose)
        raise ModelError(counts, remedy, path)


def check_knowns(c: Compiled) -> None:
    """Checks the given efforts and unknown loads: one given effort for every unknown load."""
    known_efforts = int((~c.known.requested).sum())
    unknown = len(c.unknown_loads)
    if known_efforts == unknown:
        return
    efforts = _count(known_efforts, "drive effort") + (" is" if known_efforts <= 1 else " are") + " given"
    loads = _count(unknown, "load") + (" is" if unknown <= 1 else " are") + " unknown"
    if known_efforts > unknown:
        more = _count(known_efforts - unknown, "load")
        remedy = f"make {more} unknown (`value: unknown` with a direction) or leave the efforts out"
        if c.mechanism.start:
            remedy += "; the motion that forces give it from its start is that of `dalembert simulate`"
        raise ModelError(f"{efforts} but {loads}", remedy, ("drives",))
    remedy = f"give the effort of {_count(unknown - known_efforts, 'drive')} or the values of the loads"
    if not c.schedule.names:
        remedy = (
            "a structure holds any load: leave out the joint in whose place the load is to hold, and give the freedom "
            "that this leaves a drive with `effort: 0`"
        )
    raise ModelError(f"{loads} but {efforts}", remedy, ("loads", c.unknown_loads[0]))


def _count(number: int, noun: str, plural: str = "") -> str:
    """'1 drive', '2 drives', 'no drive'."""
    if number == 0:
        return f"no {noun}"
    return f"{number} {(plural or f'{noun}s') if number > 1 else noun}"
