"""Joint forces: the largest of each joint with its position, efforts, and polar diagrams."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind
from dalembert.arrays import Array, first_largest
from dalembert.reports.design.verdict import (
    DesignContext,
    DesignPart,
    DesignVerdict,
    most_place,
    not_judged,
    put_used,
    together,
)
from dalembert.views import charts
from dalembert.views.paper.scene import Scene

NOTHING = 1e-9
"""Part of the largest joint force below which another is rounding."""


def force_part(c: DesignContext) -> Iterator[DesignPart]:
    """Tables of maxima, charts of the efforts, a polar diagram for each joint."""
    part, r = DesignPart("Joint forces"), c.r
    plane = r.mechanism.dimension == 2
    heads = [
        "Joint",
        "Links",
        "Largest force",
        "At",
        *["Direction"] * plane,
        "Smallest",
        "Largest moment",
        "At",
    ]
    put_used(part.sheet, heads, _joint_rows(c), _caption(c))
    put_used(part.sheet, ["Drive or load", "Largest", "At", "Smallest", "At"], _effort_rows(c))
    several = [j for j in r.joints if not r.unique(j).all() and np.isfinite(r.residual).any()]
    if several:
        part.verdicts.append(
            not_judged(together(several), "not unique: they depend on the links' elasticity")
        )
    elif r.joints and r.ok.any():
        part.verdicts.append(DesignVerdict("reactions are unique", "ok"))
    others = [j for j in r.joints if j not in several]
    unknown = [j for j in others if not np.isfinite(r.reaction(j)).all(axis=-1).any()]
    if unknown:
        sentence = "not known at any position" if r.ok.any() else "no position has an answer"
        part.verdicts.append(not_judged(", ".join(unknown), sentence))
    part.sheet.figure(*_pictures(c))
    yield part


def _caption(c: DesignContext) -> str:
    force, moment = c.shown.unit("force"), c.shown.unit("moment")
    return f"Forces on the second link, in ground axes, in {force}; moments about the joint in {moment}"


def _joint_rows(c: DesignContext) -> list[list[str]]:
    rows, r, plane = [], c.r, c.r.mechanism.dimension == 2
    floor = NOTHING * float(np.nanmax(np.abs(r.force_array), initial=0.0))
    for joint in r.joints:
        sides = [magnitude(side.reaction(joint)) for side in r.sides]
        force = np.fmax.reduce(sides)
        if not np.isfinite(force).any():
            continue
        k = most_place(force)
        side = r.sides[first_largest(np.array([s[k] for s in sides]))]
        cells = [
            joint,
            " – ".join(r.mechanism.joints[joint].links),
            c.number("force", _above(float(force[k]), floor)),
        ]
        cells.append(c.at(k) or "–")
        if plane:
            x, y = side.reaction(joint)[k]
            cells.append(f"{c.notation.direction(float(x), float(y))}°" if force[k] > floor else "–")
        cells.append(c.number("force", _above(float(np.nanmin(force)), floor)))
        moments = np.fmax.reduce([_size(s.reaction_moment(joint)) for s in r.sides])
        n = most_place(moments)
        some = bool(moments[n] > floor * r.compiled.layout.length)
        cells += [c.number("moment", float(moments[n])), c.at(n) or "–"] if some else ["–", "–"]
        rows.append(cells)
    return rows


def _above(value: float, floor: float) -> float:
    return value if value > floor else 0.0


def _size(moments: Array) -> Array:
    return np.abs(moments) if moments.ndim == 1 else np.asarray(magnitude(moments))


def _effort_rows(c: DesignContext) -> list[list[str]]:
    r, rows = c.r, []
    named = [(f"effort {d}", f"effort.{d}", drive_kinds(r, d)["effort"]) for d in r.drives]
    named += [(f"power {d}", f"power.{d}", "power") for d in r.drives]
    named += [(f"load {u}", f"load.{u}", load_kind(r, u)) for u in r.unknown_loads]
    for label, name, kind in named:
        values = np.stack([side[name] for side in r.sides])
        if not np.isfinite(values).any() or not np.nan_to_num(values).any():
            continue
        high, low = np.fmax.reduce(values), np.fmin.reduce(values)
        k, n = first_largest(high), first_largest(-low)
        rows.append([label, *_extreme(c, kind, high[k], k), *_extreme(c, kind, low[n], n)])
    return rows


def _extreme(c: DesignContext, kind: str, value: float, k: int) -> list[str]:
    return [c.text(kind, value), c.at(k) or "–"]


def _pictures(c: DesignContext) -> list[Scene]:
    """Efforts over the cycle, then a polar diagram of each joint; in space the sizes over the cycle."""
    r, out = c.r, list[Scene]()
    sizes = {j: float(np.nanmax(magnitude(r.reaction(j)), initial=0.0)) for j in r.joints}
    known = [j for j, size in sizes.items() if size > NOTHING * max(sizes.values())]
    if len(r.status) < 3 or not r.drives:
        return out
    out += charts.effort_chart(r, c.notation)
    if not known:
        return out
    out += charts.reaction_charts(r, c.notation)
    if r.mechanism.dimension == 2:
        out += [charts.polar_chart(r, [joint], "ground", c.notation) for joint in known]
    return out
