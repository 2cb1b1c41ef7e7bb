"""Systems of units: every kind of bare number, in seconds, milliseconds, minutes; kinds with a unit of their own."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import dalembert as da
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.model import json_schema, loads
from dalembert.unit_names import unit
from dalembert.units import ALSO_CALLED, BASES, KINDS, Units, file_units, quantity
from dalembert.views.paper.scene import Text
from tests.model.test_units import NOT_IN_PINT, REGISTRY

PRODUCTS = {
    "length": "L", "angle": "A", "time": "T", "mass": "M", "force": "F", "number": "1",
    "moment": "F * L", "inertia": "M * L**2", "speed": "L / T", "acceleration": "L / T**2",
    "jerk": "L / T**3", "angular_jerk": "A / T**3",
    "angular_speed": "A / T", "angular_acceleration": "A / T**2", "stiffness": "F / L", "damping": "F * T / L",
    "torsion_stiffness": "F * L", "torsion_damping": "F * L * T", "density": "M / L**3", "line_density": "M / L",
    "area": "L**2",
    "power": "F * L / T", "energy": "F * L", "pressure": "F / L**2", "pressure_speed": "F / L / T",
    "volume": "L**3",
    "flow": "L**3 / T",
    "section_modulus": "L**3", "second_moment": "L**4",
}  # fmt: skip
"""What a bare number of each kind is, by hand; a torsional one is one per radian."""
SYSTEMS = [
    dict(zip(BASES, names.split(), strict=True))
    for names in (
        "m N kg s rad",
        "mm kN g ms deg",
        "in lbf blob min rev",
        "ft kip lbm h mrad",
        "cm N t ms rad",
    )
]


@pytest.mark.parametrize("system", SYSTEMS, ids=lambda system: " ".join(system.values()))
@pytest.mark.parametrize("kind", KINDS)
def test_a_bare_number_is_the_product_that_a_hand_calculation_has(kind: str, system: dict[str, str]) -> None:
    units = file_units(system)
    sizes = {
        name[0].upper(): REGISTRY(NOT_IN_PINT.get(system[name], system[name])).to_base_units()
        for name in BASES
    }
    expected = eval(PRODUCTS[kind], {}, sizes)
    size = 3.0 * getattr(expected, "magnitude", expected)
    assert units.unit(kind).si(3.0) == pytest.approx(size, rel=1e-14)
    assert units.unit(kind).of_si(units.unit(kind).si(3.0)) == pytest.approx(3.0, rel=1e-15)
    if kind != "number":
        named = unit(units.text(kind))
        assert named.si(3.0) == pytest.approx(size, rel=1e-14)
        assert named.dimension == units.unit(kind).dimension
    if not units.refuses_bare(kind):
        assert quantity(3, kind, units) == quantity("3", kind, units) == pytest.approx(size, rel=1e-14)


MACHINE = """
units: {{length: {L}, force: {F}, mass: {M}, time: {T}, angle: rad}}
gravity: [0, {g!r}]
links:
  ground: {{points: {{O: [0, 0], S: [0, 0], W: [0, {l!r}]}}}}
  arm: {{points: {{O: [0, 0], A: [{l!r}, 0]}}, mass: {m!r}, inertia: {i!r}}}
joints: {{O: {{type: pin, links: [ground, arm], damping: {ct!r}}}}}
drives: {{O: {{law: {{type: harmonic, from: 0, to: 1, duration: {t!r}, count: 4}}}}}}
loads:
  k: {{type: spring, between: [ground.W, arm.A], stiffness: {k!r}, free_length: {l!r}}}
  c: {{type: damper, between: [ground.W, arm.A], damping: {c!r}}}
  kt: {{type: torsion_spring, joint: O, stiffness: {kt!r}}}
  q: {{type: couple, on: arm, value: {q!r}}}
  v: {{type: couple, on: arm, value: "{q!r}*sin(O)"}}
  p: {{type: force, on: arm, at: A, value: [{p!r}, 0]}}
"""
"""A machine with every kind of bare number; below, its numbers in SI and the product of units of each."""
SI = {
    "l": 0.4,
    "m": 3.0,
    "i": 0.2,
    "t": 0.7,
    "k": 900.0,
    "c": 40.0,
    "kt": 7.0,
    "ct": 0.6,
    "q": 5.0,
    "p": 80.0,
    "g": -9.0,
}
KIND_OF = {
    "l": "length", "m": "mass", "i": "inertia", "t": "time", "k": "stiffness", "c": "damping",
    "kt": "torsion_stiffness", "ct": "torsion_damping", "q": "moment", "p": "force", "g": "acceleration",
}  # fmt: skip


def machine(system: dict[str, str]) -> da.Mechanism:
    sizes = {
        name[0].upper(): REGISTRY(NOT_IN_PINT.get(system[name], system[name])).to_base_units().magnitude
        for name in BASES
    }
    numbers = {name: value / eval(PRODUCTS[KIND_OF[name]], {}, sizes) for name, value in SI.items()}
    return loads(MACHINE.format(**{name[0].upper(): text for name, text in system.items()}, **numbers))


@pytest.mark.parametrize("system", SYSTEMS[1:], ids=lambda system: " ".join(system.values()))
def test_one_machine_in_any_units_needs_one_torque(system: dict[str, str]) -> None:
    expected, found = (da.dynamics(machine(units)) for units in (SYSTEMS[0], system))
    assert found.effort("O") == pytest.approx(expected.effort("O"), rel=1e-12)
    assert abs(expected.effort("O")).max() > 1


OWN = "units: {length: mm, torque: N*m, angular_speed: rpm, stiffness: N/m, density: kg/m^3, power: kW}"
BAR = """
links: {ground: {points: {O: [0, 0], P: [9, 0]}}, bar: {points: {O: [0, 0], P: [100, 0]},
  shape: {type: cylinder, between: [O, P], radius: 5, density: 7850}}}
joints: {O: {type: pin, links: [ground, bar], damping: 0.5}}
drives: {O: {position: 90, speed: 1500}}
loads:
  q: {type: couple, on: bar, value: 2}
  e: {type: couple, on: bar, value: 2*O}
  s: {type: spring, between: [ground.P, bar.P], stiffness: 300}
  t: {type: torsion_spring, joint: O, stiffness: 4}
"""


def test_a_kind_with_a_unit_of_its_own() -> None:
    m = loads(OWN + BAR)
    same = loads(
        "units: {length: mm}"
        + BAR.replace("value: 2}", "value: 2 N*m}").replace("2*O", "2*O N*m").replace("1500", "1500 rpm")
        .replace("stiffness: 300", "stiffness: 300 N/m").replace("stiffness: 4", "stiffness: 4 N*m/rad")
        .replace("0.5", "0.5 N*m*s/rad").replace("7850", "7850 kg/m^3")
    )  # fmt: skip
    assert m.model_copy(update={"units": same.units}) == same
    assert da.dynamics(m).effort("O") == pytest.approx(da.dynamics(same).effort("O"))
    printed = str(da.dynamics(m))
    effort = re.search(r"(\S+) N\*m", printed)
    assert effort is not None
    assert float(effort[1]) == pytest.approx(da.dynamics(same).effort("O")[0], rel=1e-5)
    assert "1500 rpm" in printed
    assert loads(str(m)) == m
    assert loads(str(m.model_copy())) == m


@pytest.mark.parametrize(
    ("units", "says"),
    [
        (
            "{moment: N*m, torque: N*mm}",
            "units gives moment twice: N*m and, as torque, N*mm; leave one of them out",
        ),
        ("{torque: N}", "'N' is a force, but a moment is needed; write one, for example '12 N*m'"),
        ("{pressure: N*m}", "'N*m' is a moment, but a pressure is needed; write one, for example '6 N/mm^2'"),
        ("{momentt: N*m}", "units has no key 'momentt'; did you mean 'moment'?"),
        ("{number: m}", "units has no key 'number'"),
        ("{stiffness: 3}", "3 is not a unit; write N/m, for example"),
    ],
)
def test_units_that_contradict_or_do_not_fit(units: str, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        loads(f"title: x\nunits: {units}\nlinks: {{a: {{}}}}", name="a.yaml")
    assert str(caught.value).startswith("a.yaml:2: ")
    assert says in str(caught.value)


def test_the_same_unit_under_both_names_and_every_kind_is_taken() -> None:
    assert file_units({"moment": "N*m", "torque": "N*m"}) == file_units({"torque": "N*m"})
    keys = json_schema()["properties"]["units"]["properties"]
    for name in keys:
        kind = ALSO_CALLED.get(name, name)
        assert file_units({name: KINDS[kind].si}).unit(kind) == unit(KINDS[kind].si)
    assert set(keys) == {*KINDS, *ALSO_CALLED} - {"number"}
    assert Units().own("moment") == ""


@pytest.mark.parametrize(("unit", "head"), [("N", "MN"), ("lbf", "10^6 lbf")])
def test_large_numbers_have_a_common_power_with_their_unit(
    unit: str, head: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In what is printed and drawn, never `-7.30402e+06 to -4.52185e+06`; files keep the unit stated."""
    path, table = tmp_path / "press.yaml", tmp_path / "press.csv"
    path.write_text(f"""
units: {{length: mm, force: {unit}}}
links: {{ground: {{points: {{O: [0, 0]}}}}, arm: {{points: {{O: [0, 0], A: [100, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, arm]}}}}
drives: {{O: {{position: {{from: 0, to: 40, count: 3}}}}}}
loads: {{F: {{type: force, on: arm, at: A, value: [0, -7304020]}}}}
""")
    assert main(["solve", str(path), "--csv", str(table), "--units", "file"]) == 0
    text = capsys.readouterr().out
    assert "e+0" not in text
    assert re.search(rf"\|F\| O +{re.escape(head)} +7\.30402 ", text)
    assert "7304020" in table.read_text()
    texts = [
        item.text for item in da.draw.mechanism(da.statics(da.load(path))).flat() if isinstance(item, Text)
    ]
    assert any(("7.304" in text and "MN" in text) or "7.304·10⁶ lbf" in text for text in texts)


def test_pressures_and_powers_of_a_file_have_their_own_units() -> None:
    m = loads("""
units: {length: mm, torque: N*m, pressure: MPa, power: kW}
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0]}}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: 0}}
loads:
  T: {type: couple, on: arm, value: 3}
  F: {type: force, on: arm, at: O, direction: 0, value: {x: [0, 90], y: [2, 4], times: 50 cm^2}}
""")
    assert m.loads["T"].value == 3.0
    assert m.loads["F"].value.at({"O": 0.0}) == pytest.approx(2e6 * 50e-4, rel=1e-15)
    assert (m.units.text("power"), m.units.text("moment")) == ("kW", "N*m")
