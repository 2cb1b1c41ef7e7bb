"""The program of the joints: what constraints miss at any pose, and its derivatives against differences."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.positions import positions
from dalembert.arrays import Array
from dalembert.bundled import cases, examples
from dalembert.core.layout import Layout, Pose
from dalembert.kernel.graph import Graph
from dalembert.kernel.sketch_program import (
    PoseInputs,
    Sketch,
    elimination_order,
    origins,
    pose_inputs,
    sketch,
)
from tests.tiers import sampled

FILES = {**cases(), **examples()}
QUICK = ["four_bar", "quick_return", "gear_train", "rssr", "scissor_lift"]
ASKED = {"balance_position", "vw-02-drum-with-spring-and-weight", "gov-11-watt-governor"}
"""Their positions are asked for."""
STEP = 1e-6


def values(s: Sketch, graph: Graph, at: dict[int, Any]) -> Array:
    return np.array([np.ravel(x)[0] for x in graph.evaluate(s.outputs, at)], float)


def displaced(layout: Layout, like: Pose, pose: PoseInputs, dq: Array) -> dict[int, Any]:
    """Values of the inputs after displacements (L, n) of the origins of the links' axes."""
    g = layout.algebra
    turn, rotation = g.rotate_links(like.turn, like.rotation, dq[None, :, g.d :])
    moved = (
        (pose.point, origins(layout, like)[0] + dq[:, : g.d]),
        (pose.rotation, rotation[0, :-1]),
        (pose.turn, turn[0, : layout.links] if g.d == 2 else turn[0]),
    )
    return {n.index: x for nodes, new in moved for n, x in zip(nodes.ravel(), np.ravel(new), strict=True)}


@pytest.mark.parametrize("name", sampled(QUICK, set(FILES) - ASKED))
def test_rows_close_and_entries_are_their_derivatives(name: str) -> None:
    m = da.load(FILES[name])
    if any(j.BRAKES for j in m.joints.values()):
        pytest.xfail("the row of a lining or a band keeps its first pose: its entries are no derivatives")
    found = positions(compile_mechanism(m, m.schedule()))
    assert found.path is not None
    layout = found.compiled.layout
    like = found.path.pose.at([int(np.argmax(found.path.reached))])
    graph = Graph()
    pose = pose_inputs(graph, layout, layout, like)
    s = sketch(graph, layout, found.compiled.target, pose, set())
    here = values(s, graph, {})
    rows = [r for k, r in enumerate(s.rows) if k not in layout.constraints.idle]
    assert (
        max((abs(here[r.value]) for r in rows if r.kind == "constraint"), default=0.0) < 1e-9 * layout.length
    )
    jacobian = np.zeros((len(s.rows), layout.links, layout.algebra.n))
    for row, column, output in s.entries:
        jacobian[row].flat[column] = here[output]
    for where in np.ndindex(jacobian.shape[1:]):
        dq = np.zeros(jacobian.shape[1:])
        dq[where] = STEP
        ends = [values(s, graph, displaced(layout, like, pose, sign * dq)) for sign in (1, -1)]
        for k, r in enumerate(s.rows):
            change = ends[0][r.value] - ends[1][r.value]
            if r.period is not None:  # the line of centres may lie where its angle jumps
                change -= here[r.period] * np.round(change / here[r.period])
            if k not in layout.constraints.idle:
                assert change / (2 * STEP) == pytest.approx(jacobian[k][where], abs=1e-7)


def test_every_link_has_its_place_in_the_order_of_elimination() -> None:
    m = da.load(FILES["scissor_lift"])
    layout = compile_mechanism(m, m.schedule()).layout
    assert sorted(elimination_order(layout)) == list(range(layout.links))
