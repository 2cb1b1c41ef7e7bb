"""Named parameters: expressions of them anywhere in a file, their dimensions, new values, and texts that keep them."""

import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model import loads
from dalembert.model.description import mechanism
from dalembert.model.files.conversion import convert
from dalembert.model.files.model_files import load
from dalembert.model.quantities.parameters import Parameter

ENGINE = """\
title: Engine
units: {length: mm}
parameters:
  r: {value: 45 mm, about: crank radius, range: [30 mm, 60 mm]}
  area: pi*bore^2/4
  bore: 80 mm
  l: 150
  p: 2 MPa
  rho: 2 kg/m
  n: 25 Hz
  tilt: 10 deg
links:
  ground: {points: {O: [0, 0]}}
  crank:
    points: {O: [0, 0], A: [r, 0], Q: r + 5 mm @ 2*tilt}   # the radius of the crank
    mass: rho*r
    center: r/2 @ 30
    inertia: rho*r^3/12
  rod: {points: {A: [0, 0], B: [l, 0]}, mass: 0.3, center: {x}, inertia: 600}
  piston: {points: {B: [0, 0]}, mass: 0.3 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod], friction: {coefficient: tan(tilt/4), radius: r/5}}
  B: {type: pin, links: [rod, piston]}
  guide: {type: slider, links: [ground, piston], at: [O, B]}
drives:
  O: {position: {from: tilt, to: 370, count: 12}, speed: 2*pi*n}
loads:
  gas: {type: force, on: piston, at: B, value: p*area @ 180}
  drag: {type: force, on: piston, at: B, value: "0.1*p*area*sin(O)", direction: tilt}
  table: {type: couple, on: crank, value: {against: O, x: [0, 180], y: [p*area*r/9, 0], periodic: true}}
assembly: {rod: 0, piston: 0}
""".replace("{x}", "[l/2, 0]")
M = loads(ENGINE, name="engine.yaml")


def test_any_quantity_is_an_expression() -> None:
    area = np.pi * 0.08**2 / 4
    crank = M.links["crank"]
    assert crank.points["A"] == (0.045, 0.0)
    assert crank.points["Q"] == pytest.approx((0.05 * np.cos(np.pi / 9), 0.05 * np.sin(np.pi / 9)))
    assert crank.center == pytest.approx((0.0225 * np.cos(np.pi / 6), 0.01125))
    assert M.links["rod"].points["B"] == (0.15, 0.0)  # a plain number where a length is needed is in mm
    assert (M.mass("crank"), M.drives["O"].speed) == pytest.approx((0.09, 50 * np.pi))
    assert M.drives["O"].position.start == pytest.approx(np.pi / 18)
    assert M.joints["A"].friction.coefficient == pytest.approx(np.tan(np.pi / 72))
    assert M.loads["gas"].value == pytest.approx(2e6 * area)
    assert M.loads["drag"].value.at({"O": 0.5}) == pytest.approx(2e5 * area * np.sin(0.5))
    assert M.loads["table"].value.y[0] == pytest.approx(2e6 * area * 0.005)


def test_what_a_slider_shows() -> None:
    r = M.parameters["r"]
    assert (r.value, r.unit, r.about, r.range, r.in_unit(), r.kind) == (
        0.045, "mm", "crank radius", (0.03, 0.06), 45, "length",
    )  # fmt: skip
    assert (M.parameters["area"].unit, M.parameters["n"].unit, M.parameters["l"].unit) == ("mm^2", "Hz", "")


def test_new_values_are_those_of_a_file_with_them() -> None:
    new = M.with_values({"r": "50 mm", "tilt": 0.3, "bore": "3 in"})
    text = ENGINE.replace("45 mm", "50 mm").replace("10 deg", "0.3 rad").replace("80 mm", "3 in")
    again = loads(text)
    assert all(getattr(new, k) == getattr(again, k) for k in ("links", "joints", "drives", "loads"))
    assert new.with_values({"r": 0.045, "tilt": "10 deg", "parameters.bore": "80 mm"}) == M


def test_a_value_by_its_own_path_is_a_number_from_then_on() -> None:
    new = M.with_values({"links.crank.mass": 1.0}).with_values({"rho": "3 kg/m", "r": 0.05})
    assert new.mass("crank") == 1.0
    assert new.links["crank"].inertia == pytest.approx(3 * 0.05**3 / 12)
    assert "bore" in M.parameters
    assert set(M.with_values({"loads.gas.value": 0, "loads.drag.value": 1, "loads.table.value": 2}).parameters) == {
        "r", "l", "rho", "n", "tilt",
    }  # fmt: skip
    with_more = M.with_values({"links.piston.mass": "rho*l*2 mm"})  # an expression given later
    assert with_more.with_values({"rho": 4.0}).mass("piston") == pytest.approx(2 * with_more.mass("piston"))


def test_the_text_keeps_its_author_s_expressions() -> None:
    new = M.with_values({"r": "50 mm", "links.crank.mass": "2 kg"})
    assert str(new) == ENGINE.replace("value: 45 mm", "value: 50 mm").replace("mass: rho*r", "mass: 2 kg")


@pytest.mark.parametrize("form", ["yaml", "toml", "json"])
def test_every_format_keeps_parameters(form: str, tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(ENGINE)
    convert(tmp_path / "a.yaml", tmp_path / f"b.{form}")
    changed = load(tmp_path / f"b.{form}").with_values({"r": "50 mm"})
    changed.save(tmp_path / f"c.{form}")
    assert load(tmp_path / f"c.{form}") == M.with_values({"r": 0.05})
    for m in (M, changed):
        assert mechanism(json.loads(json.dumps(m.to_tree()))) == m
        assert mechanism(m.to_tree()).with_values({"r": 0.06}) == m.with_values({"r": 0.06})
    assert pickle.loads(pickle.dumps(M)).with_values({"r": 0.05}) == changed


def test_in_python() -> None:
    m = da.Mechanism(
        parameters={"r": "45 mm"},
        links={
            "ground": {"points": {"O": (0, 0)}},
            "arm": {"points": {"O": (0, 0), "A": ("2*r", 0)}, "mass": 1},
        },
        joints={"O": {"type": "pin", "links": ("ground", "arm")}},
        drives={"O": {"position": 1.0}},
    )
    assert m.with_values({"r": 0.05}).links["arm"].points["A"] == (0.1, 0.0)
    alone = da.Link(points=dict(m.links["arm"].points))  # taken by itself it follows from nothing
    assert type(alone.points["A"][0]) is float


WRONG = {
    "r: 45 mm|q: r + p|mass: q": "engine.yaml:5: parameter 'q': 'r + p' cannot be evaluated: r is a length, and p is a "
    "pressure; only quantities of one kind are added",
    "p: 1 N|mass: r": "engine.yaml:16: mass of link 'crank': 'r' is a length, but a mass is needed; check it, and the "
    "units of its parameters",
    "a: 2*b|b: a/2|mass: a": "engine.yaml:5: parameter 'a': it follows from itself: a from b from a; give one of them "
    "a value",
    "q: bor/2|mass: q": "engine.yaml:5: parameter 'q': 'bor/2' uses 'bor', which is not a parameter; "
    "did you mean 'bore'?",
    "O: 2|mass: O": "engine.yaml:5: parameter 'O': its name is that of a drive; call it otherwise, for example O_1",
    "sin: 2|mass: sin": "engine.yaml:5: parameter 'sin': its name is that of a function; call it otherwise, for "
    "example sin_1",
    "kg: 2|mass: kg": "engine.yaml:5: parameter 'kg': its name is that of a unit; call it otherwise, for example kg_1",
    "gravity: 2|mass: gravity": "engine.yaml:5: parameter 'gravity': its name is that of a key of the file; call it "
    "otherwise, for example gravity_1",
    "q: 2 kg|mass: rho*r": None,
    "q: 2|mass: rh*r": "engine.yaml:16: mass of link 'crank': 'rh*r' uses 'rh', which is not a parameter; did you mean "
    "'rho'?",
    "q: 2|mass: 2 q": "engine.yaml:16: mass of link 'crank': '2 q' has a number beside 'q'; write 2*q",
    "q: 1/0|mass: q": "engine.yaml:5: parameter 'q': the expression '1/0' has no finite value anywhere; change it, or "
    "what it follows from",
    "q: {value: 3 kg, ranges: 2}|mass: q": "engine.yaml:5: parameter 'q': unknown key 'ranges'; did you "
    "mean 'range'?",
    "q: {value: 3 kg, range: [2 kg, 1 kg]}|mass: q": "engine.yaml:5: parameter 'q': a range is two increasing values; "
    "write range: [1.5 kg, 6 kg]",
    "q: sqrt(r)|mass: rho*q^2": None,
    "q: max(0, rho - 1 kg/m)|mass: q*theta*r": "engine.yaml:16: mass of link 'crank': 'q*theta*r' uses 'theta', which "
    "is not a parameter; choose among r, q, area, bore, l, p, rho, n, tilt",
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_file_is_told_where_and_what(case: str) -> None:
    *new, mass = case.split("|")
    lines = [f"  {line}\n" for line in new if line.split(":")[0] not in M.parameters]
    text = ENGINE.replace("  area:", f"{''.join(lines)}  area:", 1).replace("mass: rho*r", mass)
    says = WRONG[case]
    if says is None:
        assert loads(text).mass("crank") == pytest.approx(0.09)
        return
    says = says.replace(":16:", f":{16 + len(lines)}:")
    with pytest.raises(ModelError) as caught:
        loads(text, name="engine.yaml")
    assert str(caught.value).splitlines()[0] == says


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"r": "3 kg"}, "'3 kg' is a mass, but a length is needed"),
        ({"rr": 3}, "unknown parameter 'rr'; choose among r, "),
        ({"parameters.x": 3}, "names no parameter's value"),
        ({"parameters": 3}, "the path 'parameters' names no parameter's value"),
        ({"rho": -1.0}, "links.crank: mass: -0.045 is negative"),
        ({"r": "l/0"}, "has no finite value"),
        ({"bore": "area/2"}, "it follows from itself: area from bore from area"),
        ({"r": float("nan")}, "nan"),
    ],
)
def test_a_wrong_value_is_refused(values: dict[str, object], says: str) -> None:
    with pytest.raises(ModelError) as caught:
        M.with_values(values)
    assert says in str(caught.value)


def test_a_table_of_one_quantity_times_another() -> None:
    """What is said by a unit or by a parameter tells what the rest is."""
    for table in ("y: [0, 6], times: 2*area", "y: [p, 3*p], times: 10 mm^2", "y: [0, 1], times: p*area"):
        text = ENGINE.replace(
            "value: p*area @ 180",
            f"value: {{against: O, x: [0, 180], {table}, periodic: true}}, direction: 0",
        )
        m = loads(text)
        value = m.loads["gas"].value
        assert mechanism(m.to_tree()) == m
        expected = {"6": 6e6 * 2 * M.parameters["area"].value, "p": 60.0, "1": M.loads["gas"].value}
        assert value.at({"O": np.pi}) == pytest.approx(expected[table[4] if table[4] == "p" else table[7]])


def test_expressions_of_drives_alone_mean_what_they_meant() -> None:
    plain = ENGINE.replace('"0.1*p*area*sin(O)"', '"50*sin(O) + 100 N"')
    assert loads(plain).loads["drag"].value.at({"O": 0.5}) == pytest.approx(100 + 50 * np.sin(0.5))
    with pytest.raises(ModelError, match="only quantities of one kind"):
        loads(plain.replace("50*sin(O) + 100 N", "tilt*50*sin(O) + 100 N"))


def test_angles_and_numbers() -> None:
    drive = ENGINE.replace("speed: 2*pi*n", "speed: n")
    with pytest.raises(ModelError, match="say radians or turns: multiply by 1 rad"):
        loads(drive)
    with pytest.raises(ModelError, match="written with its unit"):
        loads(ENGINE.replace("direction: tilt", "direction: tilt + 0.5"))
    m = loads(ENGINE.replace("direction: tilt", "direction: tilt + pi/4"))
    assert m.loads["drag"].direction == pytest.approx(np.pi / 18 + np.pi / 4)


DEFAULTS = """
parameters:
  {w: 10 rad/s, b: 3 rad/s^2, slope: 20 deg, lean: 5 deg, drag: 2 N*s/m, rub: 0.3 N*m*s, far: 10 mm, high: 20 mm}
links:
  ground: {points: {O: [0, 0], C: [0, high]}}
  crank: {points: {O: [0, 0], A: [45 mm, 0]}, mass: 1 kg, center: [far, far]}
  rod: {points: {A: [0, 0], B: [150 mm, 0]}, mass: 1 kg}
  piston: {points: {B: [0, 0]}, mass: 1 kg}
joints:
  O: {type: pin, links: [ground, crank], damping: rub}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  C: {type: slider, links: [ground, piston], at: [C, B], direction: slope, angle: lean, damping: drag}
drives:
  O: {position: {from: 0, to: 360, count: 4}, speed: w, acceleration: b}
"""


def test_a_parameter_set_to_what_goes_without_saying_is_kept() -> None:
    """Where a value follows from a parameter it is not left out, be it 0."""
    m = da.loads(DEFAULTS)
    zero = m.with_values(dict.fromkeys(m.parameters, 0.0))
    assert list(zero.parameters) == list(m.parameters)
    for again in (da.loads(str(zero)), da.mechanism(zero.to_tree())):
        assert again.with_values({name: p.value for name, p in m.parameters.items()}).to_tree() == m.to_tree()


@pytest.mark.parametrize("text", ["2*30mm + 1cm", "2*30 mm + 1 cm", "2*30  mm+ 1cm", "0.07m", "7e1mm"])
def test_a_unit_stands_beside_its_number_or_behind_it(text: str) -> None:
    tree = da.four_bar().to_tree()
    tree["parameters"] = {"r": text}
    tree["links"]["crank"]["points"]["A"] = ["r", 0]
    assert da.mechanism(tree).links["crank"].points["A"][0] == pytest.approx(0.07, rel=1e-12)


def test_a_parameter_is_its_value_whatever_its_unit() -> None:
    length = (1, 0, 0, 0)
    assert Parameter(0.045, length, "mm") == Parameter(0.045, length, "m")
    assert Parameter(0.045, length, "mm") != Parameter(0.046, length, "mm")
