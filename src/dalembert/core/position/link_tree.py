"""Links placed joint by joint from the ground: what a joint says of two links' angles and points.

Mechanics: docs/theory.md 3.1."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.layout import Along, Distance, Layout, Meet, Mesh, Turn


def extend_tree(
    placed: set[int], edges: list[PointEdge], place: Callable[[PointEdge], None], one: bool = False
) -> bool:
    """Places links across edges with one placed end; True if any was placed."""
    any_ = False
    for edge in edges:
        if (edge.i in placed) != (edge.j in placed):
            place(edge)
            placed |= {edge.i, edge.j}
            any_ = True
            if one:
                break
    return any_


class PointEdge(NamedTuple):
    """A joint between a point of link i and one of link j."""

    i: int
    j: int
    ui: Array
    uj: Array
    axis: Array | None  # in i's axes, of a coordinate kept at its target
    row: int
    far: float = 0.0  # distance of the points, where the row holds it


class Edges(NamedTuple):
    """Joints that fix a relative angle, and those between points: pins, and others."""

    turns: list[tuple[int, int, int]]  # link i, link j, stacked row
    pins: list[PointEdge]
    others: list[PointEdge]


def edges_of(layout: Layout) -> Edges:
    """The joints and drives of a layout that place one link from another."""
    turns: list[tuple[int, int, int]] = []
    pins: list[PointEdge] = []
    slides: list[PointEdge] = []
    place = {int(f): layout.constraints.count + k for k, f in enumerate(layout.driven)}
    for rows, where in ((layout.constraints, None), (layout.freedoms, place)):
        for f in rows.families:
            first = f.row.reshape(len(f.i), -1)[:, 0]
            for k, (i, j, row) in enumerate(zip(f.i.tolist(), f.j.tolist(), first.tolist(), strict=True)):
                if where is not None:
                    if row not in where:
                        continue
                    row = where[row]
                if isinstance(f, Turn):
                    turns.append((i, j, row))
                elif isinstance(f, Meet):
                    pins.append(PointEdge(i, j, f.ui[k], f.uj[k], None, row))
                elif isinstance(f, Along) and where is None and not f.pitch[k]:
                    slides.append(PointEdge(i, j, f.ui[k], f.uj[k], f.axis[k], row))
                elif isinstance(f, Mesh) and f.touches:
                    slides.append(PointEdge(i, j, f.ui[k], f.uj[k], None, row, float(f.ri[k] + f.rj[k])))
                elif isinstance(f, Distance | CamRow):
                    slides.append(PointEdge(i, j, f.ui[k], f.uj[k], None, row, np.nan))
    return Edges(turns, pins, slides)


def turns(target: Array, given: Array, angles: Array, edges: Edges) -> Array:
    """Angles (S, L+1): ground and given ones, spread over the joints that fix relative angles, then the free ones.

    Later starts deviate more and more from the given angles.
    """
    turn = np.full(angles.shape, np.nan)
    turn[:, -1] = 0.0
    spread_turns(turn, target, edges)
    known = np.isfinite(given)
    further = np.linspace(0, 1, len(turn))[:, None]
    spread = np.where(known, np.nan_to_num(given) + angles * further, angles)
    tied = np.unique([link for edge in edges.turns for link in edge[:2]]).astype(np.intp)
    alone = np.isnan(turn[0])
    alone[tied] = False
    turn[:, alone] = spread[:, alone]
    for k in tied[np.argsort(~known[tied], kind="stable")]:
        if np.isnan(turn[0, k]):
            turn[:, k] = spread[:, k]
            spread_turns(turn, target, edges)
    return turn


def spread_turns(turn: Array, target: Array, edges: Edges) -> None:
    """Fills in angles (S, L+1), in place, that follow from known ones across joints that fix a relative angle."""
    grown = True
    while grown:
        grown = False
        for i, j, row in edges.turns:
            if np.isnan(turn[0, i]) != np.isnan(turn[0, j]) and np.isfinite(target[row]):
                known, new, sign = (i, j, 1.0) if np.isnan(turn[0, j]) else (j, i, -1.0)
                turn[:, new] = turn[:, known] + sign * target[row]
                grown = True


def arms_of(layout: Layout, edges: Edges, rotation: Array) -> tuple[Array, Array]:
    """Arms (S, K + D, 2) on links i and j of each edge, by its row."""
    every = [*edges.pins, *edges.others]
    ri, rj = np.zeros((2, len(rotation), layout.stack.count, layout.algebra.d))
    if every:
        i, j, ui, uj, _, row, _ = zip(*every, strict=True)
        ri[:, row] = layout.algebra.rotate(rotation[:, i], np.array(ui))
        rj[:, row] = layout.algebra.rotate(rotation[:, j], np.array(uj))
    return ri, rj


def offset_of(g: Algebra, edge: PointEdge, target: Array, rotation: Array, slides: Array) -> Array | float:
    """Vector from the point of i to that of j (S, 2): along a slide, or at a distance (1 m on a cam)."""
    if edge.axis is not None:
        across = g.rotate(rotation[:, edge.i], edge.axis)
        along = -plane.across(across)
        return np.asarray(across * target[edge.row] + along * slides[:, edge.row, None])
    if edge.far:
        far = (target[edge.row] or 1.0) if np.isnan(edge.far) else edge.far
        return np.asarray(far * g.rotation(np.pi / 2 * slides[:, edge.row] / np.abs(slides).max()))
    return 0.0


def place_link(edge: PointEdge, offset: Array | float, point: Array, ri: Array, rj: Array) -> None:
    """Places one of the two links of an edge from the other."""
    if np.isnan(point[0, edge.j, 0]):
        point[:, edge.j] = point[:, edge.i] + ri[:, edge.row] + offset - rj[:, edge.row]
    else:
        point[:, edge.i] = point[:, edge.j] + rj[:, edge.row] - offset - ri[:, edge.row]
