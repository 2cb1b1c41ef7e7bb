"""A trace's graph: what is folded into one node, decisions by the file's numbers, values and derivatives."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.kernel.derivatives import gradients
from dalembert.kernel.doubts import largest, unheld
from dalembert.kernel.graph import CONSTANT, DESIGN, POSITION, Graph, is_zero, node, trace_array, unit_value
from dalembert.kernel.operations import not_negative


def inputs(*values: float) -> tuple[Any, ...]:
    """A graph and numbers of a design with these nominal values."""
    graph = Graph()
    return graph, *(graph.input("number", f"n{k}", v) for k, v in enumerate(values))


def value(graph: Graph, *nodes: Any) -> list[float]:
    return [float(v) for v in graph.evaluate(nodes, {})]


def test_sums_and_products_that_change_nothing_are_no_nodes() -> None:
    g, x = inputs(2.0)
    assert x + 0 is x
    assert 0 + x is x
    assert x - 0 is x
    assert x - x is g.zero
    assert x * 1 is x
    assert 1 * x is x
    assert x * 0 is g.zero
    assert 0 / x is g.zero
    assert x / 1 is x
    below = -x
    assert -below is x
    assert len(g.nodes) == 4  # 0, 1, x, -x
    assert (0 - x, x * -1, -1 * x) == (-x,) * 3
    assert (x + g.zero, g.zero + x, x - g.zero, x * g.one, g.one * x) == (x,) * 5
    assert (g.zero - x, x * g.zero, g.zero * x) == (-x, g.zero, g.zero)
    pair = np.array([x, g.one], object)
    assert (x + pair).tolist() == [x + x, x + 1]
    assert (g.one & pair).tolist() == [x, g.one]
    assert x.arctan2(2.0) is x.arctan2(g.constant(2))


def test_signs_move_outwards_and_orders_are_one() -> None:
    g, x, y = inputs(2.0, 3.0)
    assert x + y is y + x
    assert x * y is y * x
    assert x - y is not y - x
    assert x + -y is x - y
    assert -x + y is y - x
    assert x - -y is x + y
    assert -x - y is -(x + y)
    assert -x * y is -(x * y)
    assert x * -y is -(x * y)
    assert -x * -y is x * y
    assert x / 2 is x * 0.5
    assert 1 / -x is -(1 / x)
    assert y / x is y * (1 / x)
    assert g.make("mul", x, y) is x * y
    each = value(g, x + y, x - y, y - x, x * y, -(x * y), x / 2, y / x, 5 - x, 5 / x)
    assert each == [5, -1, 1, 6, -6, 1, 1.5, 3, 2.5]


def test_constants_are_computed_at_once() -> None:
    (g,) = inputs()
    two, three = g.constant(2), g.constant(3.0)
    assert two is g.constant(2.0)
    for found, number in (
        (two + three, 5), (two - three, -1), (two * three, 6), (three / two, 1.5), (-three, -3), (two.sqrt(), 2**0.5),
        (abs(-three), 3), (three.arctan2(two), math.atan2(3, 2)), (two.larger(3), 3), (two.sin(), math.sin(2)),
    ):  # fmt: skip
        assert found is g.constant(number)
        assert found.level == CONSTANT
    zero, below = g.constant(0.0), g.constant(-0.0)
    assert zero is g.zero
    assert below is not g.zero
    assert math.copysign(1.0, below.value) == -1.0
    assert g.constant(-0.0) is below
    assert g.constant(1.0) is g.one


def test_what_is_not_negative_needs_no_size() -> None:
    g, x, y = inputs(-2.0, 3.0)
    square = x * x
    assert abs(-x) is abs(x)
    assert (-x).cos() is x.cos()
    assert (-x).sin() is not x.sin()
    assert abs(square) is square
    assert abs(abs(x)) is abs(x)
    assert square.sqrt() is abs(x)
    assert (x * y).sqrt().op == "sqrt"
    assert (1 / x.sqrt()).op == "rsqrt"
    assert (1 / x.sqrt()).a is x
    assert (-square).positive() is g.zero
    assert (-x).positive() is not g.zero
    assert square.larger(0) is square
    assert x.larger(0) is not x
    assert square.larger(1) is not square
    assert abs(square + abs(y)) is square + abs(y)
    assert abs(square * x).op == "abs"
    assert abs(1 / square) is 1 / square
    assert abs(square + 1) is square + 1
    assert abs(square + -1).op == "abs"
    for sure in (square, abs(x), x.positive(), x.larger(square), square.larger(x), g.zero, (y * y).sqrt()):
        assert not_negative(sure)
    for unsure in (x, -square, x.sin(), square + x, x + square, g.constant(-1), x.larger(y), 1 / x):
        assert not not_negative(unsure)


def test_powers_are_products_and_roots() -> None:
    g, x = inputs(2.5)
    assert x**0 is g.one
    assert x**1 is x
    assert x**2 is x * x
    assert x**0.5 is x.sqrt()
    assert x**-2 is 1.0 / (x * x)
    powers = [3, 16, 1.5, 0.25, 2.625, -0.75, -16]
    assert value(g, *(x**p for p in powers)) == pytest.approx([2.5**p for p in powers], rel=1e-14)
    for power in (16.5, -17):
        with pytest.raises(TypeError, match=f"a traced value to the power {power}"):
            x**power


def test_flags_and_truths() -> None:
    """A node is true unless it is the constant 0; a number only where it is a constant."""
    g, x, y = inputs(2.0, -3.0)
    assert x
    assert g.one
    assert not g.zero
    assert float(g.constant(2.5)) == 2.5
    with pytest.raises(TypeError, match="a traced value is not a number"):
        float(x)
    flags = x.positive(), y.positive()
    both = [a & b for a in flags for b in flags]
    assert value(g, *both, *(~f for f in flags)) == [1, 0, 0, 0, 0, 1]
    assert flags[0] & True is flags[0]
    assert flags[0] & False is g.zero
    assert value(g, y.sign(), x.sign(), x.rint(), (x * 1.3).rint(), x.tan()) == [-1, 1, 2, 3, math.tan(2)]
    assert x.conjugate() is x
    assert repr(x) == f"number#{x.index}"


def test_decisions_are_by_the_file_s_numbers_and_remembered() -> None:
    """Which of two numbers is larger is part of the program; along the motion there is no such decision."""
    g, x, y = inputs(2.0, 3.0)
    assert x < y
    assert y > x
    assert not x > y
    assert x <= 2.0
    assert x >= 2.0
    assert not x < 2.0
    assert not x >= 2.5
    assert x.sin() < 1.0
    assert g.constant(2) < 3.0  # of constants there is nothing to remember
    margins = [y - x, y - x, y - x, 2 - x, x - 2, x - 2, 2.5 - x, 1 - x.sin()]
    assert g.decisions == margins
    assert min(value(g, *g.decisions)) == 0.0
    assert g.evaluate([g.decisions[0]], {x.index: 4.0}) == [
        -1.0
    ]  # below zero where another design decides otherwise
    along = g.input("channel", "c", np.array([1.0, 5.0]))
    with pytest.raises(TypeError, match="a traced value that changes along the motion has no truth"):
        assert along > 2.0
    assert (x.level, along.level, (x + along).level, (x * y).level) == (
        DESIGN,
        POSITION,
        DESIGN | POSITION,
        DESIGN,
    )
    more = g.input("number", "again", 7.0)
    assert (x.value, y.value, along.value, more.value) == (0, 1, 0, 2)
    assert g.input("common", "of all", 1.0).value == 0
    assert g.names[more.index] == "again"


def test_a_program_has_what_its_outputs_need_in_an_order_in_which_it_can_be_computed() -> None:
    g, x, y = inputs(2.0, 3.0)
    unused = x.sin() * 4.0
    product = x * y
    out = product - x
    assert g.order([out]) == [x, y, product, out]
    assert g.order([out], {product.index: 6.0}) == [x, out]
    assert g.order([out, unused])[-1] is out
    assert value(g, out) == [4.0]
    assert g.evaluate([out], {x.index: np.array([1.0, 5.0])})[0].tolist() == [2.0, 10.0]
    assert value(g, out) == [4.0]  # other numbers leave the file's as they are


def test_nodes_are_replaced_and_folded_again() -> None:
    g, x, y = inputs(2.0, 3.0)
    out, other = (x + y) * x.cos(), (x - y).arctan2(x.larger(y))
    (zero,) = g.substitute([out], {x.index: g.zero})
    assert zero is y  # (0 + y) cos 0
    first, second = g.substitute([out, other], {x.index: y})
    assert second is g.substitute([other], {x.index: y})[0]
    assert value(g, first, second) == pytest.approx([6 * math.cos(3), math.atan2(0, 3)])
    assert g.substitute([x], {x.index: y}) == [y]
    assert g.substitute([y], {x.index: y}) == [y]
    sides = x / y, -x, abs(x), g.without_gradient(x)
    for a, b in zip(
        g.substitute(sides, {x.index: y}), (y / y, -y, abs(y), g.without_gradient(y)), strict=True
    ):
        assert a is b


def test_what_is_known_to_be_equal_is_used_from_then_on() -> None:
    g, x, y = inputs(2.0, 3.0)
    product, size = x * y, x.sin()
    g.assume_equal(product, y)
    g.assume_equal(size, x)
    g.assume_equal(x, y)  # an input is no operation: nothing to replace
    g.assume_equal(product, 3.0)
    assert x * y is y
    assert x.sin() is x
    assert x + y is not y


def test_constants_have_no_gradient_to_lose() -> None:
    g, x = inputs(2.0)
    assert g.without_gradient(g.one) is g.one
    held = g.without_gradient(x)
    assert held.op == "detach"
    assert value(g, held) == [2.0]
    assert gradients(g, [held * x], [x]) == [[held]]
    assert node(g, x) is x
    assert node(g, 4.0) is g.constant(4)
    found = trace_array(g, np.array([[1, 2], [x, 0.0]], object))
    assert found.shape == (2, 2)
    assert found.ravel().tolist() == [g.one, g.constant(2), x, g.zero]
    assert [unit_value(v) for v in (1.0, -1.0, 0.5, g.one, -g.one, x, g.zero)] == [1, -1, 0, 1, -1, 0, 0]
    assert [is_zero(v) for v in (0.0, 1.0, g.zero, g.one, x)] == [True, False, True, False, False]


ONE = {
    "neg": (lambda x: -x, lambda x: -1.0),
    "inv": (lambda x: 1 / x, lambda x: -1 / x**2),
    "sqrt": (lambda x: x.sqrt(), lambda x: 0.5 / x**0.5),
    "rsqrt": (lambda x: 1 / x.sqrt(), lambda x: -0.5 * x**-1.5),
    "abs": (abs, np.sign),
    "sin": (lambda x: x.sin(), np.cos),
    "cos": (lambda x: x.cos(), lambda x: -np.sin(x)),
    "sign": (lambda x: x.sign(), lambda x: 0.0),
    "positive": (lambda x: x.positive(), lambda x: 0.0),
    "rint": (lambda x: x.rint(), lambda x: 0.0),
}
TWO = {
    "add": (lambda x, y: x + y, lambda x, y: (1, 1)),
    "sub": (lambda x, y: x - y, lambda x, y: (1, -1)),
    "mul": (lambda x, y: x * y, lambda x, y: (y, x)),
    "atan2": (lambda x, y: x.arctan2(y), lambda x, y: (y / (x * x + y * y), -x / (x * x + y * y))),
    "max": (
        lambda x, y: x.larger(y),
        lambda x, y: ((1, 0), (0, 1), (0.5, 0.5))[0 if x > y else 1 if x < y else 2],
    ),
}


@pytest.mark.parametrize("many", [False, True])
@pytest.mark.parametrize(("x0", "y0"), [(0.7, 1.9), (1.9, 0.7), (1.3, 1.3)])
def test_every_operation_has_its_derivatives_by_both_modes(many: bool, x0: float, y0: float) -> None:
    """One output of two inputs goes backwards, of many outputs forwards; each through an inner function, so that there
    is a chain, and once more beside it, so that there is a sum."""
    g, x, y = inputs(x0, y0)
    inner, slope = x * x, 2 * x0
    made, exact = [], []
    for f, d in ONE.values():
        made.append(f(inner) * y + x)
        exact.append((d(x0**2) * slope * y0 + 1, value(g, f(inner))[0]))
    for f, d in TWO.values():
        a, b = d(x0**2, y0)
        made.append(f(inner, y) * 3.0)
        exact.append((3 * a * slope, 3 * b))
        a, b = d(y0, x0**2)
        made.append(f(y, inner))
        exact.append((b * slope, a))
    rows = gradients(g, made, [x, y]) if many else [gradients(g, [out], [x, y])[0] for out in made]
    for row, wanted in zip(rows, exact, strict=True):
        assert value(g, *row) == pytest.approx(list(wanted), rel=1e-12)


def test_an_operation_without_a_derivative_is_refused_and_none_asks_for_none() -> None:
    g, x, y = inputs(0.3, 0.4)
    with pytest.raises(ValueError, match="no derivative of min"):
        gradients(g, [g.binary("min", x, y)], [x, y])
    assert gradients(g, [x, y], []) == [[], []]
    assert gradients(g, [y.sin()], [x, x]) == [[g.zero, g.zero]]
    assert gradients(g, [y.sin(), y], [x]) == [[g.zero], [g.zero]]
    assert gradients(g, [x, y], [x]) == [[g.one], [g.zero]]


def test_the_largest_size_of_some_nodes() -> None:
    g, x, y = inputs(-5.0, 3.0)
    assert value(g, largest(g, np.array([[x, y], [y, g.one]], object))) == [5.0]
    assert largest(g, np.zeros(0, object)) is g.zero
    layout: Any = type("Layout", (), {"length": 2.0, "wrench_scale": np.array([1.0, 1.0, 0.5])})
    spins = np.array([g.zero, x], object)
    w = np.array([[10.0, 0.0, 0.0], [0.0, 0.0, -90.0]])
    (left,) = unheld(g, layout, spins, w)  # 1e-7 of 45 N and 2 m
    assert value(g, left) == pytest.approx([9e-6 - 5.0])
    assert unheld(g, layout, np.zeros(0), w) == []
