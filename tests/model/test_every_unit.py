"""Every kind of quantity and every unit with its exact factor and dimension; what is written, and what is refused."""

from __future__ import annotations

import math
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.unit_names import ONE, SYMBOLS, Unit, unit
from dalembert.units import BASES, KINDS, PER_RADIAN, TextUnits, Units, check_unit, file_units, quantity, text
from dalembert.wording import closest, nearest, quote_value

INCH, POUND, G = 0.0254, 0.45359237, 9.80665
LBF = POUND * G
NAMED: dict[str, tuple[float, tuple[int, int, int, int]]] = {
    "m meter metre": (1, (1, 0, 0, 0)),
    "mm": (1e-3, (1, 0, 0, 0)),
    "cm": (1e-2, (1, 0, 0, 0)),
    "dm": (0.1, (1, 0, 0, 0)),
    "um µm μm": (1e-6, (1, 0, 0, 0)),
    "km": (1e3, (1, 0, 0, 0)),
    "in inch inches": (INCH, (1, 0, 0, 0)),
    "ft foot feet": (12 * INCH, (1, 0, 0, 0)),
    "yd": (36 * INCH, (1, 0, 0, 0)),
    "N newton": (1, (1, 1, -2, 0)),
    "mN": (1e-3, (1, 1, -2, 0)),
    "kN": (1e3, (1, 1, -2, 0)),
    "MN": (1e6, (1, 1, -2, 0)),
    "lbf": (LBF, (1, 1, -2, 0)),
    "kip": (1e3 * LBF, (1, 1, -2, 0)),
    "ozf": (LBF / 16, (1, 1, -2, 0)),
    "kgf kp": (G, (1, 1, -2, 0)),
    "Nm J": (1, (2, 1, -2, 0)),
    "Nmm": (1e-3, (2, 1, -2, 0)),
    "kNm": (1e3, (2, 1, -2, 0)),
    "kg": (1, (0, 1, 0, 0)),
    "g gram": (1e-3, (0, 1, 0, 0)),
    "t tonne": (1e3, (0, 1, 0, 0)),
    "lbm lb": (POUND, (0, 1, 0, 0)),
    "slug": (LBF / (12 * INCH), (0, 1, 0, 0)),
    "blob": (LBF / INCH, (0, 1, 0, 0)),
    "s sec second": (1, (0, 0, 1, 0)),
    "ms": (1e-3, (0, 0, 1, 0)),
    "min minute": (60, (0, 0, 1, 0)),
    "h hr hour": (3600, (0, 0, 1, 0)),
    "rad radian radians": (1, (0, 0, 0, 1)),
    "mrad": (1e-3, (0, 0, 0, 1)),
    "deg ° degree degrees": (math.pi / 180, (0, 0, 0, 1)),
    "rev turn": (2 * math.pi, (0, 0, 0, 1)),
    "rpm RPM": (math.pi / 30, (0, 0, -1, 1)),
    "rps": (2 * math.pi, (0, 0, -1, 1)),
    "Hz": (1, (0, 0, -1, 0)),
    "W": (1, (2, 1, -3, 0)),
    "kW": (1e3, (2, 1, -3, 0)),
    "%": (1e-2, (0, 0, 0, 0)),
}


def test_every_unit_has_its_factor_and_dimension() -> None:
    names = {name: worth for several, worth in NAMED.items() for name in several.split()}
    assert names.keys() == SYMBOLS.keys()
    for name, (size, dimension) in names.items():
        assert unit(name).si(1.0) == pytest.approx(size, rel=4e-16), name
        assert unit(name).of_si(size) == pytest.approx(1.0, rel=4e-16), name
        assert unit(f"kg*{name}^2/{name}^3").dimension == tuple(
            (0, 1, 0, 0)[k] - d for k, d in enumerate(dimension)
        )


EXAMPLES = {
    "number": 0.15,
    "length": 0.127,
    "angle": math.pi / 3,
    "time": 0.5,
    "mass": 1.5,
    "force": 80,
    "moment": 12,
    "inertia": 0.02,
    "speed": 0.2,
    "acceleration": 9.81,
    "angular_speed": 25,
    "angular_acceleration": -40,
    "jerk": 50,
    "angular_jerk": 200,
    "stiffness": 2000,
    "damping": 30,
    "torsion_stiffness": 50,
    "torsion_damping": 0.2,
    "density": 7850,
    "line_density": 0.4,
    "area": 2e-4,
    "section_modulus": 4e-6,
    "second_moment": 12e-8,
    "power": 2000,
    "energy": 20,
    "pressure": 6e6,
    "pressure_speed": 1e6,
    "volume": 0.4e-3,
    "flow": 20e-3 / 60,
}
POWERS = {
    "length": (1, 0, 0, 0),
    "force": (1, 1, -2, 0),
    "mass": (0, 1, 0, 0),
    "time": (0, 0, 1, 0),
    "angle": (0, 0, 0, 1),
}
SIZES = {
    "length": ("cm", 1e-2),
    "force": ("kN", 1e3),
    "mass": ("g", 1e-3),
    "time": ("min", 60.0),
    "angle": ("rev", 2 * math.pi),
}


def test_every_kind_has_the_dimension_of_its_units() -> None:
    """That of its SI unit, that of its example, and that of the product of the file's units, a torsion's per radian."""
    assert EXAMPLES.keys() == KINDS.keys()
    of_file = file_units({base: name for base, (name, _) in SIZES.items()})
    for name, kind in KINDS.items():
        if kind.si:
            assert check_unit(kind.si, name) == unit(kind.si)
            assert unit(kind.si).dimension == kind.dimension, name
            assert quantity(f"3 {kind.si}", name) == 3.0
        assert quantity(kind.example, name) == pytest.approx(EXAMPLES[name], rel=1e-15), name
        product = [sum(POWERS[base][k] * n for base, n in kind.file.items()) for k in range(4)]
        product[3] -= name in PER_RADIAN
        assert tuple(product) == kind.dimension, name
        size = math.prod(SIZES[base][1] ** n for base, n in kind.file.items())
        assert of_file.unit(name).si(1.0) == pytest.approx(size, rel=1e-14), name
        if not of_file.refuses_bare(name):
            assert quantity("2", name, of_file) == pytest.approx(2 * size, rel=1e-14), name


def test_a_kind_is_phrased_and_written() -> None:
    refused = {
        "moment": "'3 kg' is a mass, but a moment is needed; write one, for example '12 N*m'",
        "number": "'3 kg' is a mass, but a plain number is needed; write one, for example 0.15",
        "flow": "'3 kg' is a mass, but a flow is needed; write one, for example '20 l/min'",
    }
    for kind, says in refused.items():
        with pytest.raises(ModelError) as caught:
            quantity("3 kg", kind)
        assert str(caught.value) == says
    assert text(2.5, "number") == "2.5"
    assert text(-0.0, "flow") == "-0.0 m^3/s"


@pytest.mark.parametrize(
    ("value", "kind", "says"),
    [
        ("3 m^2*kg^3/s", "length", "'3 m^2*kg^3/s' is in m^2*kg^3*s^-1, but a length is needed"),
        ("3 m*rad^2", "length", "'3 m*rad^2' is in m*rad^2, but a length is needed"),
        (
            "3 Hz",
            "angular_speed",
            "'3 Hz' is in s^-1, but an angular speed is needed; Hz and 1/s do not say whether turns or "
            "radians are counted: write rev/s, rpm or rad/s",
        ),
        (
            "3 1/s",
            "angular_speed",
            "'3 1/s' is in s^-1, but an angular speed is needed; Hz and 1/s do not say whether",
        ),
        (
            "3 lb*in",
            "moment",
            "'3 lb*in' is in m*kg, but a moment is needed; lb is a mass: write lbf*in (lbf is the force, lbm the "
            "mass)",
        ),
        ("3 lb", "length", "'3 lb' is a mass, but a length is needed; write one, for example '127 mm'"),
        (
            "80 N at 30",
            "force",
            "'80 N at 30' is not one number; a size and a direction are written 80 N @ 30",
        ),
        (
            "80∠30 deg",
            "force",
            "'80∠30 deg' is not one number; a size and a direction are written 80 @ 30 deg",
        ),
        ("1,23,4 m", "length", "'1,23,4 m' has a decimal comma; write '1.23,4 m'"),
        ("1,2345 m", "length", "'1,2345 m' has a decimal comma; write '1.2345 m'"),
        ("3 4 m", "length", "'3 4 m' is not one number; write a decimal: 1.5 in for 1 1/2 in"),
        (None, "angle", "nothing is not an angle; write one, for example '60 deg'"),
        ("five", "number", "'five' is not a plain number; write one, for example 0.15"),
        ("-1e308 km", "length", "'-1e308 km' is not a finite number; write a finite one"),
        (-(10**309), "mass", "a number of 310 digits is too large; write a number below 1e300"),
    ],
)
def test_a_text_that_is_no_quantity_of_its_kind(value: object, kind: str, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        quantity(value, kind)
    assert str(caught.value).startswith(says)


def test_bare_numbers_in_texts_and_by_themselves() -> None:
    of_file = Units(length="mm", angle="rad")
    assert quantity(5, "length", of_file) == quantity("5", "length", of_file) == 0.005
    in_texts = of_file.of_texts()
    assert isinstance(in_texts, TextUnits)
    assert (quantity(5, "length", in_texts), quantity("5", "length", in_texts)) == (5.0, 0.005)
    assert quantity(0, "angular_speed", of_file) == 0.0
    with pytest.raises(ModelError, match=r"^'5' is an angular acceleration without a unit; write rad/s"):
        quantity("5", "angular_acceleration", in_texts)
    assert quantity(5, "angular_acceleration", in_texts) == 5.0


def test_units_of_torsion_follow_the_stated_moment() -> None:
    units = file_units({"length": "mm", "time": "ms", "torque": "N*m", "work": "kN*m"})
    assert units.derived == (("moment", "N*m"), ("energy", "kN*m"))
    assert (units.text("moment"), units.text("energy"), units.text("power")) == ("N*m", "kN*m", "N*mm/ms")
    assert (units.text("torsion_stiffness"), units.text("torsion_damping")) == ("N*m", "N*m*ms")
    assert units.unit("torsion_damping").si(1.0) == pytest.approx(1e-3)
    stated = file_units({"torsion_stiffness": "N*m/deg", "moment": "kN*m"})
    assert (stated.text("torsion_stiffness"), stated.text("torsion_damping")) == ("N*m/deg", "kN*m*s")
    assert units.tree() == {
        "length": "mm",
        "force": "N",
        "mass": "kg",
        "time": "ms",
        "angle": "deg",
        "moment": "N*m",
        "energy": "kN*m",
    }
    assert file_units({"angular_speed": "rpm"}).refuses_bare("angular_speed") is False
    assert [Units().refuses_bare(kind) for kind in ("angular_speed", "angular_acceleration", "speed")] == [
        True,
        True,
        False,
    ]
    assert Units(time="N*s^2/m").text("acceleration") == "m/(N*s^2/m)^2"
    assert Units().text("number") == ""
    assert Units().text("flow") == "m^3/s"
    assert Units().text("pressure_speed") == "N/m/s"


@pytest.mark.parametrize(
    ("tree", "says", "at"),
    [
        ("mm", "units are 'mm', not a mapping; write units: {length: mm, force: N}", ()),
        ({"lenght": "mm"}, "units has no key 'lenght'; did you mean 'length'?", ("lenght",)),
        ({"number": "1"}, "units has no key 'number'; choose among length, force, mass", ("number",)),
        ({"length": 3}, "3 is not a unit; write m, for example", ("length",)),
        (
            {"torque": "N"},
            "'N' is a force, but a moment is needed; write one, for example '12 N*m'",
            ("torque",),
        ),
        (
            {"moment": "N*m", "torque": "kN*m"},
            "units gives moment twice: N*m and, as torque, kN*m; leave one of them out",
            ("torque",),
        ),
    ],
)
def test_units_of_a_file_that_cannot_be(tree: Any, says: str, at: tuple[str, ...]) -> None:
    with pytest.raises(ModelError) as caught:
        file_units(tree)
    assert f"{caught.value.what}; {caught.value.remedy}".startswith(says)
    assert caught.value.path == at
    assert file_units({"moment": "N*m", "torque": "N*m"}).derived == (("moment", "N*m"),)
    assert BASES == ("length", "force", "mass", "time", "angle")


@pytest.mark.parametrize(
    ("name", "size", "dimension"),
    [
        ("1/s", 1, (0, 0, -1, 0)),
        ("1/(ms*cm)", 1e5, (-1, 0, -1, 0)),
        ("kg/(cm/ms)^2", 1e-2, (-2, 1, 2, 0)),
        ("kg/cm/ms^2", 1e8, (-1, 1, -2, 0)),
        ("cm^-3", 1e6, (-3, 0, 0, 0)),
        ("cm^- 3", 1e6, (-3, 0, 0, 0)),
        ("mm^6", 1e-18, (6, 0, 0, 0)),
        ("kN m^2 ms", 1.0, (3, 1, -1, 0)),
        ("N·mm²/s³", 1e-6, (3, 1, -5, 0)),
        ("N**2", 1, (2, 2, -4, 0)),
        ("in-lb", INCH * LBF, (2, 1, -2, 0)),
        ("lb-ft", 12 * INCH * LBF, (2, 1, -2, 0)),
        ("(N*(m/s))", 1, (2, 1, -3, 0)),
    ],
)
def test_a_product_of_units(name: str, size: float, dimension: tuple[int, ...]) -> None:
    assert unit(name).si(1.0) == pytest.approx(size, rel=1e-14)
    assert unit(name).dimension == dimension


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("N*", "'N*' is not a unit: a name is missing"),
        ("*N", "'*N' is not a unit: expected a name, not '*'"),
        ("1", "'1' is not a unit: expected a name, not '1'"),
        ("N^0", "'N^0' is not a unit: a power must be an integer from -6 to 6; write s^2, s^-1"),
        ("N^7", "'N^7' is not a unit: a power must be an integer from -6 to 6"),
        ("N^", "'N^' is not a unit: a power must be"),
        ("N^-", "'N^-' is not a unit: a power must be"),
        ("N^1.5", "'N^1.5' is not a unit: unexpected '.'"),
        ("N m)", "'N m)' is not a unit: unexpected ')'"),
        ("(N", "'(N' is not a unit: a bracket is not closed"),
        ("N*foo", "unknown unit 'foo' in 'N*foo'; did you mean 'foot'?"),
        ("xyz", "unknown unit 'xyz'; choose among m, meter, metre, mm, cm, dm, um, µm, ..."),
        ("N & m", "'N & m' is not a unit: unexpected '&'; write one such as lbf*in*s^2"),
    ],
)
def test_what_is_no_unit(name: str, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        unit(name)
    assert str(caught.value).startswith(says)


def test_units_times_powers_of_each_other() -> None:
    a, b = Unit(3.0, 5.0, (1, 0, 2, 0)), Unit(7.0, 2.0, (0, 1, -1, 3))
    assert a.times(b) == Unit(21.0, 10.0, (1, 1, 1, 3))
    assert a.times(b, -2) == Unit(12.0, 245.0, (1, -2, 4, -6))
    assert ONE.times(a, 3) == Unit(27.0, 125.0, (3, 0, 6, 0))
    assert (a.si(10.0), a.of_si(6.0)) == (6.0, 10.0)


@pytest.mark.parametrize(
    ("value", "quoted"),
    [
        ({}, "a mapping"),
        ([], "an empty list"),
        ((1,), "a list"),
        (None, "nothing"),
        (True, "true"),
        (2.50, "2.5"),
        (10**15, "1000000000000000"),
        (10**15 + 1, "a number of 16 digits"),
        (-(10**15) - 1, "a number of 16 digits"),
        (10**16, "a number of 17 digits"),
        (10**20 - 1, "a number of 20 digits"),
        (-(10**20), "a number of 21 digits"),
        ("a" * 58, "'" + "a" * 58 + "'"),
        ("a" * 59, "'" + "a" * 56 + "..."),
        ("it's", '"it\'s"'),
    ],
)
def test_a_value_as_it_is_quoted(value: object, quoted: str) -> None:
    assert quote_value(value) == quoted


def test_what_is_meant_by_a_name() -> None:
    assert nearest("ROD", ["crank", "rod"]) == "rod"
    assert nearest("rdo", ["rod", "crank"]) == "rod"
    assert nearest("cnark", ["crank"]) == "crank"
    assert nearest("ab", ["Ab", "AB"]) == "Ab"
    assert nearest("xy", ["crank", "rod"]) == ""
    assert closest("xy", []) == "there is none"
    assert closest("xy", ["rod"]) == "the only one is 'rod'"
    assert closest("xy", ["rod", "pin"]) == "choose among rod, pin"
    assert closest("xy", ["rod", "pin", "cam"], 2) == "choose among rod, pin, ..."
    assert closest("xy", ["rod", "pin", "cam"], 3) == "choose among rod, pin, cam"
    many = [f"n{k}" for k in range(13)]
    assert closest("xy", many) == f"choose among {', '.join(many[:12])}, ..."
    assert closest("xy", many[:12]) == f"choose among {', '.join(many[:12])}"
