"""The equations of several links as one: A x = b, unknowns with their values, knowns on the right."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import (
    Action,
    actions,
    drive_wrench,
    joint_place,
    normal_direction,
    on_link,
    unit_load,
)
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.reaction_components import components
from dalembert.arrays import Array
from dalembert.reports.sections.equilibrium_equations import moment_point
from dalembert.reports.sections.terms import About, floors
from dalembert.reports.sheet import Matrix
from dalembert.views.notation import Shown, along, load_sign

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

MOST = 15
"""Largest number of unknowns of a matrix equation that is printed in full."""


class Unknown(NamedTuple):
    """One unknown number: its sign, value (SI), kind, and the action of one unit of it on links: force, couple, place.

    ``of``: kinds and names of the actions it represents.
    """

    sign: str
    value: float
    kind: str
    on: dict[str, tuple[Array, Array]]
    place: Array
    of: tuple[tuple[str, str], ...]


def matrix_equation(
    r: Result,
    k: int,
    shown: Shown,
    wanted: str = "",
    links: tuple[str, ...] = (),
    some: list[Unknown] | None = None,
    following: Mapping[str, int] = MappingProxyType({}),
) -> Matrix | None:
    """A x = b of all links, or some with ``some`` unknowns, about their moment points, knowns on the right.

    ``following``: links of which the moments about one axis follow from their other equations, and that axis.
    None where it is too large or not square, and with friction, which is not linear in the unknowns.
    """
    wrapped = any(joint.WRAPPED for joint in r.mechanism.joints.values())
    if r.friction is not None or r.compiled.forcing.follows_reactions or wrapped:
        return None
    links = links or r.links
    unknown = unknowns(r, k, shown) if some is None else some
    n = 3 if r.mechanism.dimension == 2 else 6
    if len(unknown) > MOST or len(unknown) != n * len(links) - len(following):
        return None
    per = {kind: shown.value(kind, 1.0) for kind in ("force", "moment")}
    number, everything = shown.notation.number, actions(r)
    least = dict(zip(("force", "moment"), floors(r, k), strict=False))
    rows, right = [], []
    for link in links:
        about = moment_point(r, link, k, wanted)
        known = _known_actions(everything, unknown, link, k, about)
        columns = [_column(u, link, about) for u in unknown]
        for axis in range(n):
            if axis >= 3 and axis - 3 == following.get(link):
                continue
            # rows in the reader's units: force rows per force, moment rows per moment
            kind = "force" if axis < r.mechanism.dimension else "moment"
            row_unit = per[kind]
            cells = [c[axis] * row_unit / per[u.kind] for c, u in zip(columns, unknown, strict=True)]
            largest = max(map(abs, cells), default=0.0)
            rows.append(tuple(number(c) if abs(c) > 1e-9 * largest else "0" for c in cells))
            floor = 10 * least["force" if n == 3 else kind]
            right.append(number(-known[axis] * row_unit if abs(known[axis]) > floor else 0.0))
    values = tuple(number(u.value * per[u.kind] if abs(u.value) > least[u.kind] else 0.0) for u in unknown)
    return Matrix(tuple(rows), tuple(u.sign for u in unknown), tuple(right), values)


def _known_actions(
    everything: tuple[Action, ...], some: list[Unknown], link: str, k: int, about: About
) -> list[float]:
    """Forces and moments on a link of what is not among the unknowns."""
    taken = {of for u in some for of in u.of}
    place = np.asarray(about.place)[None]
    known = [a for a in on_link(everything, link) if (a.kind, a.of) not in taken]
    force = sum((a.force[k] for a in known), np.zeros(place.shape[-1]))
    moment = sum((np.atleast_1d(a.moment(np.broadcast_to(place, a.at.shape))[k]) for a in known), np.zeros(1))
    moment = moment + np.zeros(2 * place.shape[-1] - 3)
    return [*map(float, force), *map(float, moment)]


def _column(u: Unknown, link: str, about: About) -> list[float]:
    """Force and moment of one unit of an unknown on a link."""
    d = len(about.place)
    if link not in u.on:
        return [0.0] * (3 if d == 2 else 6)
    (force, couple), arm = u.on[link], np.asarray(u.place) - np.asarray(about.place)
    if d == 2:
        turned = float(couple) + arm[0] * force[1] - arm[1] * force[0]
        return [float(force[0]), float(force[1]), float(turned)]
    return [*map(float, force), *map(float, couple + np.cross(arm, force))]


def unknowns(r: Result, k: int, shown: Shown) -> list[Unknown]:
    """Components of every joint force on j, then efforts and unknown loads; signs as in the equations."""
    reaction = _plane_reaction if r.mechanism.dimension == 2 else _reaction
    out = [u for joint in r.joints for u in reaction(r, joint, k, shown)]
    return [*out, *_efforts(r, k, shown), *_loads(r, k)]


def _plane_reaction(r: Result, joint: str, k: int, shown: Shown) -> list[Unknown]:
    described, out = r.mechanism.joints[joint], []
    i, j = described.links
    sign, place, of = shown.reaction(joint, j), joint_place(r, joint)[k], (("joint", joint),)
    force, moment = r.least_norm(joint)[k, :2], float(r.least_norm(joint)[k, 2])
    axes: list[tuple[str, Array]] = []
    rows = r.compiled.layout.constraints
    turning = rows.angular[rows.joint == r.joints.index(joint)]
    if (~turning).sum() == 2:
        axes = [("x", np.array([1.0, 0.0])), ("y", np.array([0.0, 1.0]))]
    elif described.apart:
        axes = [("n", normal_direction(r, joint)[k])]
    none, zero = np.zeros(()), np.zeros(2)
    for letter, e in axes:
        on = {j: (e, none), i: (-e, none)}
        out.append(Unknown(along(sign, letter), float(force @ e), "force", on, place, of))
    if turning.any():
        on = {j: (zero, none + 1.0), i: (zero, none - 1.0)}
        out.append(Unknown(shown.joint_moment(joint, j), moment, "moment", on, place, of))
    return out


def _reaction(r: Result, joint: str, k: int, shown: Shown) -> list[Unknown]:
    i, j = r.mechanism.joints[joint].links
    a = next(a for a in actions(r) if (a.kind, a.of, a.link) == ("joint", joint, j))
    out = []
    for c in components(r, a, k, np.eye(3)):
        sign = (shown.joint_moment if c.turning else shown.reaction)(joint, j)
        on = {j: (c.force, c.couple), i: (-c.force, -c.couple)}
        kind = "moment" if c.turning else "force"
        name = along(sign, c.axis) if c.axis else sign
        out.append(Unknown(name, c.value, kind, on, joint_place(r, joint)[k], (("joint", joint),)))
    return out


def _efforts(r: Result, k: int, shown: Shown) -> list[Unknown]:
    out = []
    for a in actions(r):
        joint = r.mechanism.drives[a.of].joint or a.of if a.kind == "effort" else ""
        if a.kind != "effort" or a.source or a.link != r.mechanism.joints[joint].links[1]:
            continue
        force, couple = (v[k] for v in drive_wrench(r, a.of, np.ones(len(r.status))))
        on = {a.link: (force, couple), a.by or "ground": (-force, -couple)}
        kind, place = drive_kinds(r, a.of)["effort"], joint_place(r, joint)[k]
        out.append(Unknown(shown.effort(a), float(r.effort(a.of)[k]), kind, on, place, (("effort", a.of),)))
    return out


def _loads(r: Result, k: int) -> list[Unknown]:
    out = []
    for n, name in enumerate(r.unknown_loads):
        force, couple = (v[k] for v in unit_load(r, n))
        a = next(a for a in actions(r) if a.kind == "load" and a.of == name)
        kind = "force" if force.any() else "moment"
        on = {a.link: (force, couple)}
        out.append(
            Unknown(load_sign(name), float(r.unknown_load(name)[k]), kind, on, a.at[k], (("load", name),))
        )
    return out
