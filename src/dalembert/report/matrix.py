"""The equations of several links as one: A x = b, unknowns with their values, knowns on the right."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.actions import Action, actions, joint_place, on_link, slide_direction
from dalembert.report.balance import moment_point
from dalembert.report.sheet import Matrix
from dalembert.report.terms import About
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

MOST = 15
"""Unknowns of a matrix equation that is printed whole."""


class _Unknown(NamedTuple):
    """One unknown number: its sign, value (SI), kind, and what one unit of it does to links: force, couple, place."""

    sign: str
    value: float
    kind: str
    on: dict[str, tuple[Any, float]]
    place: Any


def matrix_equation(r: Result, k: int, shown: Shown, wanted: str = "") -> Matrix | None:
    """A x = b of all links about their moment points, knowns on the right.

    None where it is too large or not square, and with friction, which is not linear in the unknowns.
    """
    if r.friction is not None:
        return None
    unknowns = _unknowns(r, k, shown)
    if len(unknowns) > MOST or len(unknowns) != 3 * len(r.links) or r.compiled.forcing.separation.any():
        return None
    length, force, moment = (abs(shown.value(kind, 1.0)) for kind in ("length", "force", "moment"))
    per = {"force": force, "moment": moment}
    number = shown.notation.number
    rows, right = [], []
    everything = actions(r)
    for link in r.links:
        about = moment_point(r, link, k, wanted)
        known = _known(everything, unknowns, link, k, about)
        for axis in range(3):
            cells = [_coefficient(u, link, axis, about) for u in unknowns]
            # rows in the reader's units: force rows per force, moment rows per moment
            row_unit = moment if axis == 2 else force
            shown_cells = [c * row_unit / per[u.kind] for c, u in zip(cells, unknowns, strict=True)]
            largest = max(map(abs, shown_cells), default=0.0)
            rows.append(tuple(number(c) if abs(c) > 1e-9 * largest else "0" for c in shown_cells))
            value = -known[axis] * row_unit
            right.append(number(value if abs(value) > 1e-9 * _largest(r, k, force) else 0.0))
    values = tuple(f"{number(u.value * per[u.kind])}" for u in unknowns)
    assert length > 0
    return Matrix(tuple(rows), tuple(u.sign for u in unknowns), tuple(right), values)


def _largest(r: Result, k: int, force: float) -> float:
    return float(np.nanmax(np.abs(r.force_array[k]), initial=0.0)) * force


def _known(
    everything: tuple[Action, ...], unknowns: list[_Unknown], link: str, k: int, about: About
) -> tuple[float, float, float]:
    place = np.asarray(about.place)[None]
    some = [a for a in on_link(everything, link) if a.kind not in ("joint", "effort") or a.source]
    some = [a for a in some if a.of not in {u.sign for u in unknowns}]
    force = sum((a.force[k] for a in some), np.zeros(2))
    moment = math.fsum(float(a.moment(np.broadcast_to(place, a.at.shape))[k]) for a in some)
    return float(force[0]), float(force[1]), moment


def _coefficient(u: _Unknown, link: str, axis: int, about: About) -> float:
    if link not in u.on:
        return 0.0
    force, couple = u.on[link]
    if axis < 2:
        return float(force[axis])
    arm = np.asarray(u.place) - np.asarray(about.place)
    return float(couple + arm[0] * force[1] - arm[1] * force[0])


def _unknowns(r: Result, k: int, shown: Shown) -> list[_Unknown]:
    """Components of every joint force on j, then efforts; signs as in the equations."""
    out: list[_Unknown] = []
    zero = np.zeros(2)
    for joint in r.joints:
        described = r.mechanism.joints[joint]
        i, j = described.links
        sign, place = shown.reaction(joint, j), joint_place(r, joint)[k]
        head, _, index = sign.partition("_{")
        force, moment = r.least_norm(joint)[k, :2], float(r.least_norm(joint)[k, 2])
        axes: list[tuple[str, Any]] = []
        if described.type in ("pin", "weld", "rolling"):
            axes = [("x", np.array([1.0, 0.0])), ("y", np.array([0.0, 1.0]))]
        elif described.type in ("slider", "slot"):
            e = slide_direction(r, joint)[k]
            axes = [("n", np.array([-e[1], e[0]]))]
        for letter, e in axes:
            name = f"{head}_{{{index.rstrip('}')}{letter}}}"
            out.append(_Unknown(name, float(force @ e), "force", {j: (e, 0.0), i: (-e, 0.0)}, place))
        if described.type in ("slider", "weld"):
            name = shown.joint_moment(joint, j)
            out.append(_Unknown(name, moment, "moment", {j: (zero, 1.0), i: (zero, -1.0)}, place))
    return out + _efforts(r, k, shown)


def _efforts(r: Result, k: int, shown: Shown) -> list[_Unknown]:
    out = []
    for a in actions(r):
        if a.kind != "effort" or a.source or a.link != r.mechanism.joints[_joint(r, a.of)].links[1]:
            continue
        turning = not a.force.any()
        other = a.by or "ground"
        place = joint_place(r, _joint(r, a.of))[k]
        e = np.zeros(2) if turning else slide_direction(r, _joint(r, a.of))[k]
        unit = 1.0 if turning else 0.0
        value = float(r.effort(a.of)[k])
        kind = "moment" if turning else "force"
        on = {a.link: (e, unit), other: (-e, -unit)}
        out.append(_Unknown(shown.symbol(a), value, kind, on, place))
    for a in actions(r):
        if a.of in r.unknown_loads:
            out.append(_unknown_load(r, a, k))
    return out


def _unknown_load(r: Result, a: Action, k: int) -> _Unknown:
    value = float(r.unknown_load(a.of)[k])
    force = a.force[k] / value if value else np.zeros(2)
    turning = not a.force.any()
    kind = "moment" if turning else "force"
    return _Unknown(a.of, value, kind, {a.link: (force, 1.0 if turning else 0.0)}, a.at[k])


def _joint(r: Result, drive: str) -> str:
    return r.mechanism.drives[drive].joint or drive
