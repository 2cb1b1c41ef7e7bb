"""Choices without branches, the same for numbers and for traced values; when constraints and drives fix every link."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.algebra import plane, space
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.core import branchless as b
from dalembert.core.geometry import point_motion, span, span_motion
from dalembert.core.layout import Pose
from dalembert.core.linear import SINGULAR
from dalembert.core.rank import is_rigid, singular_below, well_driven
from dalembert.kernel.graph import Graph, trace_array

A, B = np.array([-2.5, 0.0, 0.7, 3.0, 3.0]), np.array([1.0, 0.0, -0.7, 3.0, 2.0])


def in_numbers(f: Callable[..., Any], *given: Any) -> list[Any]:
    out = f(*given)
    return list(out) if isinstance(out, tuple) else [out]


def traced(f: Callable[..., Any], *given: Any) -> list[Any]:
    """The same from inputs of a graph, evaluated at the numbers."""
    graph = Graph()

    def inputs(x: Any) -> Any:
        if not isinstance(x, np.ndarray):
            return x
        flat = [graph.input("number", "x", float(v)) for v in x.ravel()]
        out = np.empty(x.size, object)
        out[:] = flat
        return out.reshape(x.shape)

    found = f(*map(inputs, given))
    parts = [np.asarray(part) for part in (found if isinstance(found, tuple) else (found,))]
    assert all(part.dtype == object for part in parts)
    return [
        np.array(graph.evaluate(trace_array(graph, part).ravel(), {}), float).reshape(part.shape)
        for part in parts
    ]


@pytest.mark.parametrize("how", [in_numbers, traced])
def test_choices_are_those_of_their_words(how: Callable[..., list[Any]]) -> None:
    for f, given, expected in (
        (b.above, (A, B), [0, 0, 1, 0, 1]),
        (b.above, (A, 0.5), [0, 0, 1, 1, 1]),
        (b.larger, (A, B), [1, 0, 0.7, 3, 3]),
        (b.larger, (A, 0.5), [0.5, 0.5, 0.7, 3, 3]),
        (b.sign, (A,), [-1, 0, 1, 1, 1]),
        (b.hypot, (A, B), np.hypot(A, B)),
        (b.root, (abs(A),), np.sqrt(abs(A))),
        (b.tangent, (A / 3,), np.tan(A / 3)),
        (b.tanh, (A,), np.tanh(A)),
        (lambda x, y: b.where(b.above(x, y), x, 7.0), (A, B), [7, 7, 0.7, 7, 3]),
        (lambda x, y: b.where(b.above(x, 0.0), x, y), (A, B), [1, 0, 0.7, 3, 3]),
        (lambda x, y: b.where(b.above(x, y) & ~b.above(x, 1.0), 1.0, 2.0), (A, B), [2, 2, 1, 2, 2]),
    ):
        (found,) = how(f, *given)
        assert np.asarray(found, float) == pytest.approx(np.array(expected, float), rel=1e-14), f


@pytest.mark.parametrize("how", [in_numbers, traced])
def test_a_unit_vector_is_shorter_where_the_vector_is_small(how: Callable[..., list[Any]]) -> None:
    x, y = np.array([3.0, 0.03, 0.0, -6.0]), np.array([4.0, 0.04, 0.0, 8.0])
    along, across, length = how(b.unit, x, y, np.full(4, 0.1))
    assert along == pytest.approx([0.6, 0.3, 0.0, -0.6])
    assert across == pytest.approx([0.8, 0.4, 0.0, 0.8])
    assert length[[0, 3]] == pytest.approx([5.0, 10.0])
    assert (length <= [5.0, 0.05, 0.0, 10.0] + 1e-12 * np.ones(4)).all()


@pytest.mark.parametrize("how", [in_numbers, traced])
def test_the_top_of_the_last_axes_is_no_less_than_zero(how: Callable[..., list[Any]]) -> None:
    values = np.array([[[-1.0, 5.0], [2.0, 3.0]], [[-4.0, -6.0], [-1.0, -2.0]]])
    assert how(lambda a: b.top(a, 2), values)[0].tolist() == [5, 0]
    assert how(lambda a: b.top(a, 1), values)[0].tolist() == [[5, 3], [0, 0]]
    assert how(lambda a: b.top(a, 3), values)[0].tolist() == 5


def test_one_component_keeps_its_sign_whatever_its_size() -> None:
    """Where a traced vector has a single component by its structure, nothing is divided."""
    graph = Graph()
    x = graph.input("number", "x", -1e-9)
    along, across, length = b.unit(np.array([x], object), np.array([graph.zero], object), np.array([1.0]))
    assert graph.evaluate([along.item(), across.item(), length.item()], {}) == [-1.0, 0.0, 1e-9]
    assert [b.any_traced(*some) for some in ((A, B), (A, np.array([x], object)), ())] == [False, True, False]


@pytest.mark.parametrize("g", [plane, space])
def test_a_span_and_its_rates_are_those_of_two_points_that_move(g: Any) -> None:
    """Against differences of the places along constant twists, in the plane and in space."""
    rng = np.random.default_rng(5)
    twist = rng.normal(size=(1, 3, g.n))
    f: Any = SimpleNamespace(
        i=np.array([0]), j=np.array([1]), ui=rng.normal(size=(1, g.d)), uj=rng.normal(size=(1, g.d))
    )
    start = rng.normal(size=(3, g.d))

    def at(t: float) -> Pose:
        point = start + t * twist[0, :, : g.d]
        turn, rotation = g.reference_rotation(1, 3)
        turned = g.rotate_links(turn, rotation, t * twist[..., g.d :][:, :-1])
        return Pose(point[None], *turned)

    def place(t: float) -> np.ndarray:
        return np.asarray(span(g, f, at(t))[0, 0])

    pi, pj = (start[k] + g.rotate(at(0.0).rotation[0, k], u[0]) for k, u in ((0, f.ui), (1, f.uj)))
    assert place(0.0) == pytest.approx(pj - pi)
    rate, second = (part[0, 0] for part in span_motion(g, f, at(0.0), twist))
    h = 1e-4
    assert rate == pytest.approx((place(h) - place(-h)) / (2 * h), rel=1e-6, abs=1e-6)
    assert second == pytest.approx((place(h) - 2 * place(0.0) + place(-h)) / h**2, rel=1e-5, abs=1e-5)
    v, a = point_motion(g, at(0.0), twist, np.array([2]), np.zeros((1, g.d)))
    assert v[0, 0] == pytest.approx(twist[0, 2, : g.d])
    assert not a.any()


def test_links_are_well_driven_where_they_are_fixed_exactly_once() -> None:
    """A lifted four-bar has more constraints than unknowns; at its dead centre an engine driven by its piston is fixed
    by none; long chains are worse conditioned by their size."""
    for m, rigid, well in (
        (da.four_bar(positions=1), True, True),
        (da.lifted(da.four_bar(positions=1)), True, False),
    ):
        r = da.kinematics(m)
        layout, pose = r.compiled.layout, full_pose(r, slice(None)).at(0)
        assert (is_rigid(layout, pose), well_driven(layout, pose)) == (rigid, well)
    pose = full_pose(da.kinematics(da.slider_crank(positions=1)), slice(None)).at(0)  # rod and crank in line
    tree = da.slider_crank(positions=1).to_tree()
    tree["drives"] = {"guide": {"freedom": "slide", "position": "300 mm"}}
    m = da.mechanism(tree)
    layout = compile_mechanism(m, m.schedule()).layout
    assert layout.square
    assert (is_rigid(layout, pose), well_driven(layout, pose)) == (False, False)
    assert singular_below(layout) == SINGULAR
    for links, part in ((10, 1), (40, 64)):
        assert singular_below(SimpleNamespace(links=links)) == pytest.approx(SINGULAR / part)  # type: ignore[arg-type]
