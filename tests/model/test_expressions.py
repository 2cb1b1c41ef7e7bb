"""Expressions: a fixed grammar, evaluated over arrays, printed back; never executed."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dalembert import dynamics
from dalembert.errors import ModelError
from dalembert.model import Expression, loads
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.dimensions import EITHER, dimension, kind_of_dimension, phrase, si_unit
from dalembert.model.quantities.expression_trees import (
    ARGUMENTS,
    Apply,
    NameNode,
    NumberNode,
    Tree,
    evaluate,
    expression_text,
)
from dalembert.model.quantities.expressions import CONSTANTS, parse_expression
from dalembert.model.quantities.parameters import read_parameters
from dalembert.model.quantities.varying import value_at, varying, varying_tree
from dalembert.units import Units

VALUES = {
    "500*sin(O2)": 500 * math.sin(0.7),
    "-O2^2": -(0.7**2),
    "-O2**2 + 1": 1 - 0.7**2,
    "2^3^2": 512.0,
    "2^-1": 0.5,
    "(1 + 2)*3 - 4/8": 8.5,
    "1 - 2 - 3": -4.0,
    "8/4/2": 1.0,
    "--3": 3.0,
    "atan2(1, -1)": 3 * math.pi / 4,
    "max(O2, min(3, 0.1))": 0.7,
    "abs(-2)*sqrt(9) + sign(-5)": 5.0,
    "log(exp(2)) + tan(0) + acos(1) + asin(0) + atan(0) + cos(0)": 3.0,
    "pi*1e-3": math.pi / 1000,
    "\u22122*O2": -1.4,
    "θ + slide_2": 5.0,
    "max(1, O2, 2.5, 2) - min(O2, 3, 0.5)": 2.0,
    "3*(O2 > 0.7) + 5*(O2 >= 0.7) + 7*(O2 < 0.7) + 11*(O2 <= 0.7)": 16.0,
    "(2*O2 > 1)*(1 < O2 + 1)": 1.0,
}


@pytest.mark.parametrize("text", VALUES)
def test_an_expression_is_worth(text: str) -> None:
    drives = {"O2": 0.7, "θ": 2.0, "slide_2": 3.0}
    assert Expression(text).at(drives) == pytest.approx(VALUES[text], rel=1e-15)


@pytest.mark.parametrize("text", ["1e3*O2", "2e-3*sin(O2)", "1.5E+3*O2", ".5e1/O2", "2e3-O2", "3e2^2"])
def test_a_number_with_an_exponent_begins_an_expression_too(text: str) -> None:
    found = varying(text, "force", ReadingRules(Units(force="kN")))
    assert isinstance(found, Expression)
    assert found.at({"O2": 0.7}) == pytest.approx(
        1000 * eval(text.replace("^", "**"), {"sin": math.sin, "O2": 0.7})
    )


@pytest.mark.parametrize("text", ["1e3 N", "1e3N", "-2.5e-1 kN", "12 N", "4e2"])
def test_a_quantity_is_no_expression(text: str) -> None:
    assert isinstance(varying(text, "force", ReadingRules(Units())), float)


@pytest.mark.parametrize("name", [*ARGUMENTS, *CONSTANTS])
def test_no_drive_has_a_name_that_expressions_know_but_links_joints_and_loads_may(name: str) -> None:
    links = f"links: {{ground: {{points: {{{name}: [0, 0]}}}}, {name}: {{points: {{{name}: [0, 0]}}}}}}"
    joints = f"joints: {{{name}: {{type: pin, links: [ground, {name}]}}}}"
    loads_ = f"loads: {{{name}: {{type: couple, on: {name}, value: 2*O*pi}}}}"
    drive = f"{{joint: {name}, position: 1 rad}}"
    named = "{" + ", ".join([links, joints, loads_]) + ", drives: {"
    assert loads(f"{named}O: {drive}}}}}").loads[name].moment({"O": 1.0}) == pytest.approx(2 * math.pi)  # type: ignore[union-attr]
    with pytest.raises(ModelError, match=f"drive '{name}' has the name of a"):
        loads(f"{named}{name}: {drive}}}}}")


KILONEWTONS = ReadingRules(Units(force="kN"), freedoms={"O": "turn", "S": "slide", "t": "turn"})
AT = {"O": 0.5, "S": 0.1, "t": 2.0, "time": 0.01}
LBF = 4.4482216152605

WITH_UNITS = {
    "800 lbf*sin(2*O)": 800 * LBF * math.sin(1.0),
    "sin(O)*(40 N + 2 N)": 42 * math.sin(0.5),
    "-20 N/mm^2*1963 mm^2": -39260.0,
    "50 N*sin(20*time)": 50 * math.sin(0.2),
    "50 N*sin(20*time + 1)": 50 * math.sin(1.2),
    "50*sin(time/(0.05 s))": 50e3 * math.sin(0.2),
    "40 N*min(O, 2, 3)": 20.0,
    "max(1 N, 2 N, 60 N*O)": 30.0,
    "40 N/m*S": 4.0,
    "40 N*(S > 99 mm)": 40.0,
    "40 N*(S > 101 mm)": 0.0,
    "3 N*2*t": 12.0,
    "2*sin(O) N": 2 * math.sin(0.5),  # as ever: one unit behind it all
    "2*sin(O) + 3 N": 2 * math.sin(0.5) + 3,
    "2*sin(O) + 3": 1e3 * (2 * math.sin(0.5) + 3),
}


@pytest.mark.parametrize("text", WITH_UNITS)
def test_any_number_may_have_a_unit(text: str) -> None:
    found = varying(text, "force", KILONEWTONS)
    assert value_at(found, AT) == pytest.approx(WITH_UNITS[text], rel=1e-14)
    if isinstance(found, Expression):
        again = varying(varying_tree(found, "force"), "force", KILONEWTONS)
        assert value_at(again, AT) == value_at(found, AT)


PARTLY = {
    "40 N*S": "'40 N*S' is a moment, but a force is needed; check it, and the units of its parameters",
    "40 N*(S > 90)": "'(S > 90)' cannot be evaluated: S is a length, and 90 is a plain number; only quantities "
    "of one kind are compared",
    "40 N*sin(O) + 2": "'40 N*sin(O) + 2' cannot be evaluated: 40 N*sin(O) is a force, and 2 is a plain number; "
    "only quantities of one kind are added",
    "40 N*sin(2*O": "'40 N*sin(2*O': the bracket '(' at column 9 is never closed; write ')' where it ends",
    "2*(O": "'2*(O': the bracket '(' at column 3 is never closed; write ')' where it ends",
    "40 N*(3 sin(O))": "'40 N*(3 sin(O))' has a number beside 'sin'; write 3*sin(...)",
    "1 1/2 kN": "'1 1/2 kN' is not one number; write a decimal: 1.5 in for 1 1/2 in",
}


@pytest.mark.parametrize("text", PARTLY)
def test_why_an_expression_with_units_is_refused(text: str) -> None:
    with pytest.raises(ModelError) as caught:
        varying(text, "force", KILONEWTONS)
    assert str(caught.value) == PARTLY[text]


LENGTH, FORCE, ANGLE = (1, 0, 0, 0), (1, 1, -2, 0), (0, 0, 0, 1)
NAMED = {"r": LENGTH, "F": FORCE, "a": ANGLE, "phi": EITHER, "n": (0, 0, 0, 0), "T": (0, 0, 1, 0)}
DIMENSIONS: dict[str, tuple[float, float, float, float | None] | str] = {
    "F/r": (0, 1, -2, 0), "r*phi": (1, 0, 0, None), "phi/a": EITHER, "T^-2": (0, 0, -2, 0),
    "sqrt(r^2)": LENGTH, "(r^0.1*r^0.2)^10": (3, 0, 0, 0), "r^0.9995": (0.9995, 0, 0, 0), "sqrt(a)": (0, 0, 0, 0.5),
    "r*a + r": (1, 0, 0, None), "r + r*a": (1, 0, 0, None), "r + r*phi": LENGTH,
    "phi + a": ANGLE, "a - phi": ANGLE, "abs(r)": LENGTH,
    "0 + r": LENGTH, "r - 0": LENGTH, "max(0, r)": LENGTH, "(r < 2*r)": (0, 0, 0, 0),
    "atan2(r, 2*r)": ANGLE, "acos(r/r)": ANGLE, "sin(a)": (0, 0, 0, 0), "exp(n)": (0, 0, 0, 0),
    "sign(F)": (0, 0, 0, 0), "20*time + 1": EITHER, "min(1, 20*time)": EITHER, "cos(3*time)": (0, 0, 0, 0),
    "20*time + a": EITHER,
    "20*time + r": "20*time is a time, and r is a length; only quantities of one kind are added",
    "20*T + 1": "20*T is a time, and 1 is a plain number; only quantities of one kind are added",
    "time*T - 1": "time*T is in s^2, and 1 is a plain number; only quantities of one kind are subtracted",
    "min(r, F)": "r is a length, and F is a force; only quantities of one kind are compared",
    "n + a": "n is a plain number, and a is an angle; only quantities of one kind are added; "
    "a number of radians is written with its unit, 0.5 rad",
    "a - n": "a is an angle, and n is a plain number; only quantities of one kind are subtracted; "
    "a number of radians is written with its unit, 0.5 rad",
    "sin(r)": "r is a length; sin needs a plain number or an angle; divide by a quantity of the same kind",
    "cos(T)": "T is a time; cos needs a plain number or an angle; divide by a quantity of the same kind",
}  # fmt: skip


@pytest.mark.parametrize("text", DIMENSIONS)
def test_the_dimension_of_an_expression(text: str) -> None:
    tree, expected = parse_expression(text, [*NAMED, "time"])[0], DIMENSIONS[text]
    if isinstance(expected, tuple):
        assert dimension(tree, NAMED | {"time": (0, 0, 1, 0)}) == expected
    else:
        with pytest.raises(ModelError) as caught:
            dimension(tree, NAMED | {"time": (0, 0, 1, 0)})
        assert str(caught.value) == f"'{text}' cannot be evaluated: {expected}"


@pytest.mark.parametrize("text", ["w + v/r", "v/r + w"])
def test_an_angular_speed_and_a_speed_over_a_radius_add_in_either_order(text: str) -> None:
    m = loads(f"""
parameters: {{v: 2 m/s, r: 0.1 m, w: 3 rad/s}}
links: {{ground: {{points: {{O: [0, 0]}}}}, bar: {{points: {{O: [0, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, bar]}}}}
drives: {{O: {{position: 0, speed: {text}}}}}
""")
    assert m.drives["O"].speed == pytest.approx(23, rel=1e-15)


@pytest.mark.parametrize(
    ("powers", "said"),
    [
        (EITHER, ("number", "", "a plain number")),
        (None, ("number", "", "a plain number")),
        (ANGLE, ("angle", "rad", "an angle")),
        (FORCE, ("force", "N", "a force")),
        ((0, 0, -1, None), ("angular_speed", "rad/s", "an angular speed")),
        ((0, 0, -1, 1), ("angular_speed", "rad/s", "an angular speed")),
        ((1, 0, 0, 1), ("length", "m", "in m*rad")),
        ((-1, 0, 0, 0), (None, "1/m", "in 1/m")),
        ((-2, 1, 0.5, 2), (None, "kg*s^0.5*rad^2/m^2", "in kg*s^0.5*rad^2/m^2")),
    ],
)
def test_words_for_a_dimension(
    powers: tuple[float, float, float, float | None] | None, said: tuple[str | None, str, str]
) -> None:
    assert (kind_of_dimension(powers), si_unit(powers), phrase(powers)) == said


def test_an_expression_with_its_unit_as_a_key_sees_parameters_and_units() -> None:
    inches = Units(length="in", force="lbf")
    parameters = read_parameters({"cut": 50, "r": "3 in"}, inches, {})
    rules = ReadingRules(inches, freedoms={"O": "turn"}, parameters=parameters)
    found = varying({"expression": "cut*(1+sign(r - 12 in*sin(O)))/2", "unit": "N"}, "force", rules)
    assert [float(value_at(found, {"O": angle})) for angle in (0.25, 0.26)] == pytest.approx([50, 0])
    with pytest.raises(ModelError, match="'in' is a length, but a force is needed"):
        varying({"expression": "cut*sin(O)", "unit": "in"}, "force", rules)


def test_a_copy_of_a_load_with_units_turns_as_that_of_one_without() -> None:
    text = """
dalembert: 1
links: {ground: {points: {O: [0, 0], Q: [1, 0]}}, crank: {points: {O: [0, 0], A: [0.1, 0]}, mass: 1}}
joints: {O: {type: pin, links: [ground, crank]}}
drives: {O: {position: 20 deg}}
loads: {F: {type: force, on: crank, at: A, value: [VALUE, 0]}}
copies: [{of: [crank], phase: {ground: [0, 60]}}]
"""
    with_units, without = (
        loads(text.replace("VALUE", value)) for value in ("40 N*sin(2*O) + 3 N", "40*sin(2*O) + 3")
    )
    drives = {"O": 0.3, "O_2": 0.4}
    for name in without.loads:
        forces = [m.loads[name].force(drives) for m in (with_units, without)]  # type: ignore[union-attr]
        assert forces[0] == pytest.approx(forces[1], rel=1e-14)


SHORT = {
    "2*slide.B": "2*joints.B.slide",
    "40 N*turn.A": "40 N*joints.A.turn",
    "sin(angle.rod) - drive.O": "sin(links.rod.angle) - O",
    "{against: slide.B, x: [0 m, 1 m], y: [0, 5]}": "{against: joints.B.slide, x: [0 m, 1 m], y: [0, 5]}",
    "{against: angle.rod, x: [-90, 90], y: [0, 5]}": "{against: links.rod.angle, x: [-90, 90], y: [0, 5]}",
}
SLIDER_CRANK = """
units: {length: m, angle: deg}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.05, 0]}, mass: 2}
  rod: {points: {A: [0, 0], B: [0.2, 0]}, mass: 0.5}
  piston: {points: {B: [0, 0]}, mass: 0.8}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  C: {type: pin, links: [rod, piston], at: B}
  B: {type: slider, links: [ground, piston], at: [O, B], direction: 0}
drives: {O: {position: {from: 0, to: 360, count: 6}, speed: 9 rad/s}}
loads: {F: {type: force, on: piston, at: B, direction: 180, value: VALUE}}
COPIES
"""


@pytest.mark.parametrize(
    "copies", ["", "copies: [{of: [rod, piston], phase: {crank: [0, 90], ground: [0, 90]}}]"]
)
@pytest.mark.parametrize("short", SHORT)
def test_a_load_may_use_the_names_of_quantities(short: str, copies: str) -> None:
    text = SLIDER_CRANK.replace("COPIES", copies)
    brief, full = (dynamics(loads(text.replace("VALUE", value))) for value in (short, SHORT[short]))
    assert np.isfinite(full.effort("O")).all()
    assert brief.effort("O") == pytest.approx(full.effort("O"), rel=1e-12, abs=1e-12)
    none = dynamics(loads(text.replace("VALUE", "0"))).effort("O")
    assert np.abs(full.effort("O") - none).max() > 1e-3


def test_over_arrays_of_any_shape() -> None:
    angle = np.linspace(0, 6, 12).reshape(3, 4)
    assert np.array_equal(
        Expression("2*sin(O2)^2 + 1", "kN").at({"O2": angle}), 1000 * (2 * np.sin(angle) ** 2 + 1)
    )


class Traced:
    """A value of another kind: what is done to it, as text."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __mul__(self, other: Any) -> Traced:
        return Traced(f"({self.text} * {getattr(other, 'text', other)})")

    def __rmul__(self, other: Any) -> Traced:
        return Traced(f"({other} * {self.text})")

    def __truediv__(self, other: Any) -> Traced:
        return Traced(f"({self.text} / {other})")


def test_over_values_of_another_kind() -> None:
    found = Expression("3*sin(O2)", "N").at({"O2": Traced("a")}, {"sin": lambda x: Traced(f"sin {x.text}")})
    assert found.text == "(((3.0 * sin a) * 1.0) / 1.0)"


def trees() -> st.SearchStrategy[Tree]:
    leaves = st.floats(0, 1e6).map(NumberNode) | st.sampled_from(["a", "b"]).map(NameNode)
    return st.recursive(
        leaves,
        lambda inner: (
            st.builds(
                lambda f, a, b: Apply(f, (a, b)), st.sampled_from(["+", "-", "*", "/", "max"]), inner, inner
            )
            | st.builds(lambda f, a: Apply(f, (a,)), st.sampled_from(["-", "sin", "abs"]), inner)
            | st.builds(lambda a, n: Apply("^", (a, NumberNode(float(n)))), inner, st.integers(0, 16))
        ),
        max_leaves=15,
    )


@given(trees())
def test_what_is_printed_parses_to_the_same_tree(tree: Tree) -> None:
    assert parse_expression(expression_text(tree)) == (tree, "")


@given(st.text("ab12+-*/^() .,e_sin[]'\"\\;:=<>!&|~%@", max_size=30))
def test_any_text_is_an_expression_or_a_model_error(text: str) -> None:
    with suppress(ModelError):
        Expression(text).at({"a": 0.5, "b": np.array([1.0, -2.0])})


HOSTILE = [
    "__import__('os').system('true')",
    "().__class__.__bases__[0].__subclasses__()",
    "O2.__class__",
    "O2.real",
    "open(O2)",
    "eval(O2)",
    "exec(O2)",
    "lambda: 1",
    "[x for x in (1,)]",
    "O2 if O2 else 1",
    "O2 := 3",
    "O2 == 1",
    "O2 and 1",
    "'a'*9",
    "9**9**9",
    "9^9^9^9",
    "2**1000000",
    "1e400",
    "O2[0]",
    "{1}",
    "f'{O2}'",
    "sin(O2)(1)",
    "sin(sin)",
    "__O2__",
    "sin O2",
    "2 O2",
    "O2; O2",
    "O2\nimport os",
    "(" * 500 + "O2" + ")" * 500,
    "-" * 900 + "1",
    "sin(" * 200 + "O2" + ")" * 200,
    "1" + "+1" * 400,
    "2^" * 300 + "1",
    "a" * 5000,
    "",
    "()",
    "*",
    "sin()",
    "max(1)",
]


@pytest.mark.parametrize("text", HOSTILE)
def test_a_hostile_text_is_refused(text: str) -> None:
    with pytest.raises(ModelError):
        Expression(text)


def test_the_grammar_is_named() -> None:
    with pytest.raises(ModelError) as caught:
        Expression("O2.real")
    assert str(caught.value) == (
        "'O2.real': unexpected '.real' at the end; an expression is made of numbers, names of drives "
        "and parameters, pi, + - * / ^, brackets, comparisons in brackets and sin cos tan asin acos atan atan2 sqrt "
        "exp log abs sign min max"
    )


def test_where_it_has_no_value() -> None:
    with pytest.raises(ModelError) as caught:
        Expression("sqrt(O2)").at({"O2": np.array([1.0, 0.0, -0.5])})
    assert str(caught.value) == (
        "the expression 'sqrt(O2)' has no finite value at O2 = -0.5; change it, or the range of the drive"
    )


def test_an_unknown_drive() -> None:
    with pytest.raises(
        ModelError, match="an expression uses 'O3', which is not a drive; the only one is 'O2'"
    ):
        evaluate(NameNode("O3"), {"O2": 1.0}, {})
