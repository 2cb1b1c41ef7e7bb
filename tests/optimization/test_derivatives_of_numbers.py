"""Numbers with derivatives: sums, products, powers, functions and reductions over a cycle, beside their differences."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from dalembert.optimization.cycle_expressions import (
    RATES,
    Differentiated,
    call_end,
    cycle_functions,
    has_quantities,
    has_reductions,
    is_single,
    whole_call,
)

STEP = 1e-6
F = cycle_functions()
Expression = Callable[[Any, Any], Any]


def values(u: Any) -> tuple[Any, Any]:
    """Two quantities of one design at four positions, of two numbers."""
    a, b = u
    t = np.array([0.3, 0.5, 0.7, 0.9])
    return 0.5 * a * t + 0.1 * b, 0.2 + b * t * t - 0.1 * a


def differentiated(u: Any) -> tuple[Differentiated, Differentiated]:
    out = []
    for k in (0, 1):
        slopes = [(values(u + STEP * h)[k] - values(u - STEP * h)[k]) / (2 * STEP) for h in np.eye(2)]
        out.append(Differentiated(values(u)[k][None], np.stack(slopes, axis=-1)[None]))
    return out[0], out[1]


EXPRESSIONS: dict[str, Expression] = {
    "x + y": lambda x, y: x + y,
    "2 + x": lambda x, y: 2.0 + x,
    "x - y": lambda x, y: x - y,
    "2 - x": lambda x, y: 2.0 - x,
    "x - 2": lambda x, y: x - 2.0,
    "-x": lambda x, y: -x,
    "x y": lambda x, y: x * y,
    "3 x": lambda x, y: 3.0 * x,
    "x / y": lambda x, y: x / y,
    "2 / x": lambda x, y: 2.0 / x,
    "x / 2": lambda x, y: x / 2.0,
    "x^3": lambda x, y: x**3,
    "y^-2": lambda x, y: y**-2,
    "x^1": lambda x, y: x**1,
    "x^0 + y": lambda x, y: x**0 + y,
    "min(x, y)": lambda x, y: F["min"](x, y),
    "max(x, y)": lambda x, y: F["max"](x, y),
    "min(x, 0.4)": lambda x, y: F["min"](x, 0.4),
    "max(0.4, y)": lambda x, y: F["max"](0.4, y),
    "atan2(x, y)": lambda x, y: F["atan2"](x, y),
    "atan2(x - 0.4, -y)": lambda x, y: F["atan2"](x - 0.4, -y),
    "atan2(x, 2)": lambda x, y: F["atan2"](x, 2.0),
    **{f"{name}(x)": lambda x, y, name=name: F[name](x) for name in RATES},  # type: ignore[misc]
    **{
        f"{name}(x - 0.4)": lambda x, y, name=name: F[name](x - 0.4)
        for name in ("abs", "sin", "cos", "tan", "asin")
    },  # type: ignore[misc]
}


def of(expression: Expression, u: Any) -> Any:
    found = expression(*differentiated(u))
    return found if isinstance(found, Differentiated) else Differentiated(*found)


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_a_number_has_the_slope_of_its_differences(name: str) -> None:
    u = np.array([1.3, 0.7])
    found = of(EXPRESSIONS[name], u)
    for k, h in enumerate(np.eye(2)):
        high, low = (of(EXPRESSIONS[name], u + s * 1e-5 * h).value for s in (1, -1))
        slope = np.broadcast_to(found.slope[..., k], found.value.shape)
        assert slope == pytest.approx((high - low) / 2e-5, rel=1e-5, abs=1e-7)


KNOWN: dict[str, Callable[[Any, Any], Any]] = {
    "x - y": lambda x, y: x - y,
    "2 - x": lambda x, y: 2 - x,
    "2 / x": lambda x, y: 2 / x,
    "x / y": lambda x, y: x / y,
    "y^-2": lambda x, y: 1 / y**2,
    "x^0 + y": lambda x, y: 1 + y,
    "min(x, y)": lambda x, y: np.minimum(x, y),
    "max(0.4, y)": lambda x, y: np.maximum(y, 0.4),
    "atan2(x - 0.4, -y)": lambda x, y: np.arctan2(x - 0.4, -y),
    "abs(x - 0.4)": lambda x, y: np.abs(x - 0.4),
    "sqrt(x)": lambda x, y: np.sqrt(x),
    "log(x)": lambda x, y: np.log(x),
}


@pytest.mark.parametrize("name", KNOWN)
def test_a_number_has_its_value(name: str) -> None:
    x, y = values(np.array([1.3, 0.7]))
    assert of(EXPRESSIONS[name], np.array([1.3, 0.7])).value[0] == pytest.approx(KNOWN[name](x, y))


@pytest.mark.parametrize("name", RATES)
def test_the_rate_of_a_function_is_its_difference(name: str) -> None:
    for x in (0.3, 0.8):
        ends = [
            F[name](Differentiated(np.array([[x + s]]), np.ones((1, 1, 1)))).value[0, 0]
            for s in (STEP, -STEP)
        ]
        rate = float(np.asarray(RATES[name](np.array([x])))[0])
        assert rate == pytest.approx((ends[0] - ends[1]) / (2 * STEP), rel=1e-6, abs=1e-9)


CYCLE = np.array([1.0, -4.0, 2.0, 3.0])
REDUCED = {
    "peak": (4.0, [0, -1, 0, 0]),
    "mean": (0.5, [0.25] * 4),
    "greatest": (3.0, [0, 0, 0, 1]),
    "least": (-4.0, [0, 1, 0, 0]),
    "range": (7.0, [0, -1, 0, 1]),
    "final": (3.0, [0, 0, 0, 1]),
    "rms": (math.sqrt(7.5), list(CYCLE / 4 / math.sqrt(7.5))),
}


@pytest.mark.parametrize("word", REDUCED)
def test_a_reduction_has_one_value_and_the_slopes_of_the_positions_in_it(word: str) -> None:
    """Each position is a number of its own here; a second design has all with the other sign."""
    both = Differentiated(np.stack([CYCLE, 2 * CYCLE]), np.broadcast_to(np.eye(4), (2, 4, 4)))
    found = F[word](both)
    value, slope = REDUCED[word]
    assert found.value == pytest.approx(np.array([[value], [2 * value]]))
    assert found.slope[0] == pytest.approx(np.array([slope], float))
    assert found.slope.shape == (2, 1, 4)
    again = F[word](Differentiated(CYCLE[None], np.ones((1, 1, 1))))
    assert again.slope == pytest.approx(np.array([[[sum(slope)]]]))


def test_for_a_smooth_peak_the_eighth_norm_is_taken_and_no_other_reduction_changes() -> None:
    smooth, x = cycle_functions(smooth=True), Differentiated(CYCLE[None], np.eye(4)[None])
    assert smooth["peak"](x).value[0, 0] == pytest.approx((np.abs(CYCLE) ** 8).mean() ** 0.125)
    assert F["norm8"](x).value[0, 0] == pytest.approx((np.abs(CYCLE) ** 8).mean() ** 0.125)
    for word in REDUCED:
        if word != "peak":
            assert smooth[word](x).value[0, 0] == pytest.approx(REDUCED[word][0])


@pytest.mark.parametrize(
    ("text", "call", "inner"),
    [
        ("peak(effort.O)", "peak", "effort.O"),
        ("range( (a + b)*c )", "range", "(a + b)*c"),
        ("peak(a) + 1", "", ""),
        ("peak(a)*peak(b)", "", ""),
        ("1 + peak(a)", "", ""),
        ("peak(a", "", ""),
        ("mypeak(a)", "", ""),
        ("x.peak(a)", "", ""),
    ],
)
def test_a_text_may_be_one_reduction_and_nothing_else(text: str, call: str, inner: str) -> None:
    assert whole_call(text) == (call, inner)


def test_a_bracket_ends_where_as_many_are_closed() -> None:
    text = "peak((a)(b)) + (c)"
    assert call_end(text, 5) == 12
    assert call_end("peak((a)", 5) == 8
    assert call_end("peak(a))", 5) == 7


@pytest.mark.parametrize(
    ("text", "reductions", "quantities", "single"),
    [
        ("peak(effort.O) + 1", True, False, True),
        ("peak(effort.O)*effort.O", True, True, False),
        ("peak(effort.O) + mean(effort.O)", True, False, True),
        ("effort.O", False, True, False),
        ("life.A", False, False, True),
        ("life.A*effort.O", False, True, False),
        ("mass", False, False, True),
        ("links.rod.mass", False, False, False),
        ("2 m", False, False, False),
        ("range (slide.G)", True, False, True),
    ],
)
def test_what_an_expression_has_of_a_cycle_and_of_each_position(
    text: str, reductions: bool, quantities: bool, single: bool
) -> None:
    assert (has_reductions(text), has_quantities(text), is_single(text)) == (reductions, quantities, single)
