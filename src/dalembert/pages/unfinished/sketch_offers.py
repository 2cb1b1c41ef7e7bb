"""Additions that finish an unfinished mechanism, as changes of its text: a pivot on the ground, a joint, a drive."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.arrays import Array
from dalembert.core.rank import Rank
from dalembert.model import GROUND, Mechanism
from dalembert.model.files.source import Path
from dalembert.model.files.splicing import REMOVED, splice

MOST = 6
"""Offers of one kind at most."""
TOGETHER = 1e-3
"""Distance of points that count as one place, over the size of the mechanism."""

Places = Mapping[tuple[str, str], Array]
"""Link and point -> its place, m."""


@dataclass(frozen=True)
class Offered:
    """A step towards a finished mechanism: its kind ("joint", "ground", "drive", "leave out"), what it does, the text
    with it."""

    kind: str
    said: str
    text: str


def offers(
    m: Mechanism, c: Compiled, ranked: Rank, measures: Array, places: Places, text: str
) -> list[Offered]:
    """Steps for a mechanism at a pose; ``measures`` (F,): the values of its freedoms; ``text``: its YAML."""
    free = unrooted(m)
    steps = [*_joints(m, places, c.layout.length)]
    if free:
        steps += _pivots(m, places, free)
    elif ranked.freedoms < len(m.drives):
        steps += [("leave out", f"leave out drive {name}", {("drives", name): REMOVED}) for name in m.drives]
    else:
        steps += _drives(m, c, ranked, measures)
    return [Offered(kind, said, splice(text, "yaml", values)) for kind, said, values in steps]


Step = tuple[str, str, dict[Path, object]]


def unrooted(m: Mechanism) -> set[str]:
    """Links that no chain of joints leads to the ground."""
    rooted, grew = {GROUND}, True
    while grew:
        more = {link for j in m.joints.values() if rooted & set(j.links) for link in j.links}
        grew, rooted = not more <= rooted, rooted | more
    return set(m.links) - rooted


def _taken(m: Mechanism) -> set[tuple[str, str]]:
    """Points that are in a joint."""
    return {pair for name, j in m.joints.items() for pair in zip(j.links, j.point_names(name), strict=True)}


def _joints(m: Mechanism, places: Places, length: float) -> Iterator[Step]:
    """Points of two links in one place, or of one name, that no joint holds together."""
    taken, count = _taken(m), 0
    joined = [set(j.links) for j in m.joints.values()]
    for one, two in itertools.combinations([p for p in places if p not in taken], 2):
        near = np.linalg.norm(places[one] - places[two]) < TOGETHER * length
        if one[0] == two[0] or {one[0], two[0]} in joined or not (near or one[1] == two[1]):
            continue
        count += 1
        if count > MOST:
            return
        yield "joint", f"pin {one[1]} of {one[0]} to {two[1]} of {two[0]}", _pin(m, one, two)


def _pivots(m: Mechanism, places: Places, free: set[str]) -> Iterator[Step]:
    """Points of links that hang free, each as a pivot on the ground where it is."""
    taken = _taken(m)
    ends = sorted((p for p in places if p[0] in free), key=lambda p: p in taken)
    for link, point in ends[:MOST]:
        x, y = places[link, point].tolist()
        names = m.links[GROUND].points if GROUND in m.links else {}
        name = _new(point, names)
        fixed: dict[Path, object] = {("links", GROUND, "points", name): [f"{x:.6g} m", f"{y:.6g} m"]}
        yield "ground", f"fix {point} of {link} to the ground", fixed | _pin(m, (GROUND, name), (link, point))


def _drives(m: Mechanism, c: Compiled, ranked: Rank, measures: Array) -> Iterator[Step]:
    """Freedoms of joints that still move, those on the ground first."""
    moving = [k for k in np.flatnonzero(ranked.free).tolist() if c.freedoms[k][0] not in m.drives]
    moving.sort(key=lambda k: GROUND not in m.joints[c.freedoms[k][0]].links)
    for k in moving[:MOST]:
        joint, freedom = c.freedoms[k]
        turns = bool(c.layout.freedoms.angular[k])
        at = f"{np.degrees(measures[k]):.6g} deg" if turns else f"{measures[k]:.6g} m"
        more = {} if len(m.joints[joint].freedoms) == 1 else {"freedom": freedom}
        yield "drive", f"drive the {freedom} of {joint}", {("drives", joint): {"position": at} | more}


def _pin(m: Mechanism, one: tuple[str, str], two: tuple[str, str]) -> dict[Path, object]:
    name = _new(two[1], m.joints)
    at = {} if one[1] == two[1] == name else {"at": [one[1], two[1]]}
    return {("joints", name): {"type": "pin", "links": [one[0], two[0]]} | at}


def _new(name: str, known: object) -> str:
    """The name, or with the next number where it is taken."""
    more = (f"{name}_{k}" for k in itertools.count(2))
    return next(x for x in itertools.chain([name], more) if x not in known)  # type: ignore[operator]
