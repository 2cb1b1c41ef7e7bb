"""Units: exact factors against pint, kinds, and what is refused."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dalembert.errors import ModelError
from dalembert.unit_names import SYMBOLS, unit
from dalembert.units import KINDS, Units, file_units, quantity, text

REGISTRY: Any = pint.UnitRegistry()
NOT_IN_PINT = {
    "Nm": "N*m",
    "Nmm": "N*mm",
    "kNm": "kN*m",
    "lbm": "pound",
    "blob": "lbf*s^2/in",
    "ozf": "ounce_force",
    "kgf": "kilogram_force",
    "kp": "kilogram_force",
    "RPM": "rpm",
    "rps": "turn/s",
    "%": "0.01",
    "rev": "revolution",
    "sec": "second",
    "hr": "hour",
}


@pytest.mark.parametrize("name", SYMBOLS)
def test_every_symbol_is_what_pint_says(name: str) -> None:
    size = REGISTRY.Quantity(1.0, "") * REGISTRY(NOT_IN_PINT.get(name, name))
    size = size.to_root_units()
    symbol = SYMBOLS[name]
    grams = 1000.0 ** symbol.dimension[1]
    assert symbol.si(1.0) * grams == pytest.approx(float(size.magnitude), rel=1e-15)
    powers = {str(key): value for key, value in size.unit_items()}
    bases = ("meter", "gram", "second", "radian")
    assert tuple(powers.get(base, 0) for base in bases) == symbol.dimension


SAID = {
    ("1500 rpm", "angular_speed"): 1500 * math.pi / 30,
    ("1 rev/s", "angular_speed"): 2 * math.pi,
    ("60deg", "angle"): math.pi / 3,
    ("60°", "angle"): math.pi / 3,
    ("127 mm", "length"): 0.127,
    ("\u22123 mm", "length"): -0.003,
    ("0.4 lbf*in*s^2", "inertia"): 0.4 * 4.4482216152605 * 0.0254,
    ("3 kg m²", "inertia"): 3.0,
    ("1 blob", "mass"): 4.4482216152605 / 0.0254,
    ("1 slug", "mass"): 4.4482216152605 / 0.3048,
    ("2 lb", "mass"): 2 * 0.45359237,
    ("12 N-m", "moment"): 12.0,
    ("12 N·m", "moment"): 12.0,
    ("12 N.m", "moment"): 12.0,
    ("12 N m", "moment"): 12.0,
    ("12 Nm", "moment"): 12.0,
    ("1 ft-lb", "moment"): 0.3048 * 4.4482216152605,
    ("1 lb-in", "moment"): 0.0254 * 4.4482216152605,
    ("1 kip-ft", "moment"): 304.8 * 4.4482216152605,
    ("5 N/(m/s)", "damping"): 5.0,
    ("5 N*s/m", "damping"): 5.0,
    ("2 N*m", "torsion_stiffness"): 2.0,
    ("2 N*m/deg", "torsion_stiffness"): 360 / math.pi,
    ("3 furlong", "length"): 3 * 201.1684,
    ("1e3 mm", "length"): 1.0,
    ("3", "length"): 3.0,
    ("0.5", "number"): 0.5,
    ("0.3 %", "number"): 0.003,
    ("-9.81 m*s^-2", "acceleration"): -9.81,
}


@pytest.mark.parametrize(("value", "kind"), SAID)
def test_a_text_is_worth(value: str, kind: str) -> None:
    assert quantity(value, kind) == pytest.approx(
        SAID[value, kind], rel=1e-5 if "furlong" in value else 4e-16
    )


@pytest.mark.parametrize(
    ("value", "kind", "says"),
    [
        ("1 1/2 in", "length", "'1 1/2 in' is not one number; write a decimal: 1.5 in for 1 1/2 in"),
        ("1/2 in", "length", "'1/2 in' is not one number; write a decimal: 1.5 in for 1 1/2 in"),
        ("1,5 mm", "length", "'1,5 mm' has a decimal comma; write '1.5 mm'"),
        ("1,500 mm", "length", "'1,500 mm' has a comma; write '1.500 mm', or '1500 mm' for thousands"),
        (
            "1.5 lb",
            "force",
            "'1.5 lb' is a mass, but a force is needed; lb is a mass: write lbf (lbf is the force, lbm the mass)",
        ),
        ("3 degC", "length", "unknown unit 'degC'; did you mean 'deg'?"),
        ("3 V", "length", "unknown unit 'V'; units of length: m, meter, metre, mm, cm, dm, um, µm, ..."),
        (
            "5 tonf",
            "force",
            "unknown unit 'tonf'; units of force: N, newton, mN, kN, MN, lbf, kip, ozf, ...",
        ),
        ("3 V", "pressure", "unknown unit 'V'; write one, for example '6 N/mm^2'"),
        ("3 MM", "length", "unknown unit 'MM'; did you mean 'mm'?"),
        (
            "3 N/(m",
            "stiffness",
            "'N/(m' is not a unit: a bracket is not closed; write one such as lbf*in*s^2",
        ),
        ("3 m)", "length", "'m)' is not a unit: unexpected ')'; write one such as lbf*in*s^2"),
        ("inf", "length", "'inf' is not a length; write one, for example '127 mm'"),
        ("1e999 m", "length", "'1e999 m' is not a finite number; write a finite one"),
        (math.nan, "length", "nan is not a finite number; write a finite one"),
        (10**400, "length", "a number of 401 digits is too large; write a number below 1e300"),
        ("", "length", "'' is not a length; write one, for example '127 mm'"),
        (False, "length", "false is not a length; write one, for example '127 mm'"),
    ],
)
def test_what_is_no_quantity(value: object, kind: str, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        quantity(value, kind)
    assert str(caught.value) == says


@pytest.mark.parametrize(("value", "kind", "si"), [
    ("1 dyne", "force", 1e-5), ("2 hp", "power", 2 * 550 * 0.3048 * 4.4482216152605),
    ("1 stone", "mass", 14 * 0.45359237), ("1 arcminute", "angle", math.pi / 10800),
    ("3 fortnight", "time", 3 * 14 * 86400), ("1 knot", "speed", 1852 / 3600),
    ("1 psi", "pressure", 4.4482216152605 / 0.0254**2), ("1 erg", "moment", 1e-7),
])  # fmt: skip
def test_a_unit_that_pint_knows_is_worth(value: str, kind: str, si: float) -> None:
    assert quantity(value, kind) == pytest.approx(si, rel=1e-14)


def test_electric_units_are_none_of_mechanics() -> None:
    """One of them even has a root of a length."""
    for name in ("ampere", "statcoulomb", "kelvin"):
        with pytest.raises(ModelError, match=f"^unknown unit '{name}'; "):
            unit(name)


def test_a_unit_has_sixty_characters_at_most() -> None:
    assert unit("m" + " " * 59) == unit("m")
    with pytest.raises(ModelError) as caught:
        unit("m" + " " * 60)
    assert str(caught.value) == f"'m{' ' * 55}... is not a unit; write one such as lbf*in*s^2"


def test_bare_numbers_take_the_product_of_the_files_units() -> None:
    units = file_units({"length": "in", "force": "lbf", "mass": "blob"})
    inch, lbf = 0.0254, 4.4482216152605
    worth = {"moment": lbf * inch, "inertia": lbf * inch, "stiffness": lbf / inch, "damping": lbf / inch}
    worth |= {"speed": inch, "acceleration": inch, "angle": math.pi / 180, "time": 1.0, "mass": lbf / inch}
    for kind, one in worth.items():
        assert quantity(1, kind, units) == pytest.approx(one, rel=4e-16)
        assert quantity(f"1 {units.text(kind)}", kind) == pytest.approx(one, rel=4e-16)


def test_units_left_out_are_si_and_degrees() -> None:
    assert quantity(3, "moment", file_units({"force": "kN"})) == 3000.0
    assert quantity(180, "angle", file_units({})) == math.pi
    assert quantity(2, "angle") == 2.0


@pytest.mark.parametrize("kind", ["angular_speed", "angular_acceleration"])
def test_a_bare_angular_speed_is_refused_in_a_file_only(kind: str) -> None:
    assert quantity(3, kind) == 3.0
    with pytest.raises(ModelError, match="without a unit; write rad/s"):
        quantity(3, kind, Units())


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(sorted(KINDS)))
def test_written_numbers_read_back_to_the_last_bit(number: float, kind: str) -> None:
    assert quantity(text(number, kind), kind, Units(length="in")) == number


@given(st.floats(-1e9, 1e9), st.sampled_from(["in", "lbf*in", "deg", "blob*in^2", "rpm"]))
def test_to_si_and_back(number: float, name: str) -> None:
    assert unit(name).of_si(unit(name).si(number)) == pytest.approx(number, rel=1e-15)


@given(st.text(max_size=20))
def test_any_text_is_a_unit_or_a_model_error(name: str) -> None:
    with suppress(ModelError):
        unit(name)


def test_brackets_of_a_unit_are_read_four_deep() -> None:
    assert unit("N/" + "(" * 4 + "m" + ")" * 4) == unit("N/m")
    with pytest.raises(ModelError, match=r"is not a unit: expected a name, not '\('"):
        unit("N/" + "(" * 5 + "m" + ")" * 5)
