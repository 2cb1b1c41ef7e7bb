"""Parameters in the kernel: values are those of the analyses, derivatives exact through every expression of them."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import ModelError
from tests.kernel.test_derivatives import differences
from tests.random_mechanisms import random_case, tree
from tests.tiers import tiers

PARAMETERS = {
    "size": {"value": "1.3 m", "about": "a length that all points are proportional to"},
    "stretch": "max(sqrt(size/(1.3 m)), 1e-3)*cos(lean)/cos(2 deg)",
    "lean": "2 deg",
    "weight": "2 kg",
    "heavy": "weight/(2 kg)*stretch^2",
    "push": {"value": "5 N", "range": ["1 N", "9 N"]},
}
FACTORS = {
    "m": "stretch",
    "kg": "heavy",
    "kg*m^2": "heavy*stretch^2",
    "N": "(push/(5 N))*atan2(size, 1.3 m)/(pi/4)",
}


def parametrised(value: Any, path: tuple[str, ...] = ()) -> Any:
    """A description's tree with each length, mass and force multiplied by an expression of parameters."""
    if isinstance(value, dict):
        return {key: parametrised(inner, (*path, key)) for key, inner in value.items()}
    if isinstance(value, list):
        return [parametrised(inner, path) for inner in value]
    match = re.fullmatch(r"(-?[\d.e+-]+) (m|kg|kg\*m\^2|N)", value) if isinstance(value, str) else None
    return f"{value}*{FACTORS[match[2]]}" if match and path[0] in ("links", "joints", "loads") else value


@pytest.mark.parametrize("seed", tiers(range(1, 2), range(2, 9), range(9, 60)))
def test_random_mechanisms(seed: int) -> None:
    plain = da.mechanism(tree(random_case(seed).drawing))
    m = da.mechanism({**parametrised(plain.to_tree()), "parameters": PARAMETERS})
    drive = next(iter(m.drives))
    output = f"effort.{drive}"
    np.testing.assert_allclose(
        da.dynamics(m).effort(drive), da.dynamics(plain).effort(drive), rtol=1e-9, atol=1e-9
    )
    k = da.compile(m, vary=["size", "lean", "weight", "push"], outputs=[output], derivatives=True)
    other = k.nominal * [1.01, 0.7, 1.1, 0.9]
    named = dict(zip(k.numbers, other.tolist(), strict=True))
    expected = da.dynamics(m.with_values(named)).effort(drive)
    found = k([other]).value(output)[0]
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-10 * np.nanmax(np.abs(expected)))
    exact = k().gradient(output)[0]
    for n, name in enumerate(k.numbers):
        slope, rounding = differences(k, output, n, 1e-4)
        right = np.isfinite(exact[:, n])
        assert right.any()
        off = np.abs(slope - exact[:, n])[right].max()
        assert off <= 1e-6 * np.abs(exact[right, n]).max() + rounding, name


LOADS = """
units: {length: mm}
parameters: {r: 45 mm, a: 0.3, c: 2 kN/m, T: 3 N*m, b: 20 deg, mu: 0.1, turns: 300 rpm}
links:
  ground: {points: {O: [0, 0], C: [300, 0]}}
  crank: {points: {O: [0, 0], A: r @ b}, mass: 2 kg}
  rod: {points: {A: [0, 0], B: [4*r, 0]}, mass: 3 kg, center: 2*r @ b/9, inertia: 0.01 kg*m^2*(r/(45 mm))^3}
  block: {points: {B: [0, 0]}, mass: 1 kg}
joints:
  O: {type: pin, links: [ground, crank], damping: T/(100 rad/s)}
  A: {type: pin, links: [crank, rod], friction: {coefficient: mu, radius: r/8}}
  B: {type: pin, links: [rod, block]}
  guide: {type: slider, links: [ground, block], at: [O, B]}
drives:
  O: {position: {from: 5, to: 365, count: 12}, speed: turns}
loads:
  spring: {type: spring, between: [ground.C, block.B], stiffness: c, free_length: 3*r}
  table: {type: couple, on: crank, value:
    {against: O, x: [0, 120, 240], y: [T, 0.4*T, 1 N*m], interpolate: cubic, periodic: true}}
  closed: {type: couple, on: crank, value: {against: O, x: [0, 180, 360], y: [T, 0, T], periodic: true}}
  gas: {type: couple, on: rod, value: {against: O, x: [0, 180], y: [1, 0], times: 2*T, periodic: true}}
  pose: {type: force, on: block, at: B, value: -c*joints.guide.slide/9, direction: 0}
  wave: {type: couple, on: rod, value: "T*(1 + a*exp(-a)*sin(O)^2*min(a, cos(O) + 3)) - 0.2 N*m*exp(cos(O))"}
  bare: {type: force, on: block, at: B, direction: b, value: "100*a*tan(O/9) + 3"}
assembly: {rod: 0, block: 0}
gravity: [0, -9.81*a/0.3]
"""


def test_every_place_of_a_parameter() -> None:
    """Polar points, springs, damping, friction, tables, expressions with drives, speeds, gravity."""
    m = da.loads(LOADS.replace("a*exp(-a)", "a"))
    k = da.compile(m, vary=["r", "a", "c", "T", "b", "mu", "turns"], outputs=["effort.O"], derivatives=True)
    other = k.nominal * [1.1, 0.9, 1.2, 0.7, 1.3, 0.8, 1.2]
    expected = da.dynamics(m.with_values(dict(zip(k.numbers, other.tolist(), strict=True)))).effort("O")
    np.testing.assert_allclose(k([other]).effort("O")[0], expected, rtol=1e-9)
    exact = k().gradient("effort.O")[0]
    for n, name in enumerate(k.numbers):
        slope, rounding = differences(k, "effort.O", n, 1e-4)
        assert np.abs(slope - exact[:, n]).max() <= 1e-6 * np.abs(exact[:, n]).max() + rounding, name


@pytest.mark.parametrize(
    ("vary", "says"),
    [
        (
            ["r", "links.crank.points.A"],
            "'links.crank.points.A.0' follows from the parameter 'r', and both vary",
        ),
        (["a", "T", "c", "a"], "'a' is varied twice"),
        (["x"], "unknown parameter 'x'"),
        (["a"], "exp of a number that varies is not compiled"),
    ],
)
def test_what_cannot_vary_is_told(vary: list[str], says: str) -> None:
    with pytest.raises(ModelError, match=re.escape(says)):
        da.compile(da.loads(LOADS), vary=vary)


def test_places_of_a_table_do_not_vary() -> None:
    text = LOADS.replace("x: [0, 180], y", "x: [b, 180], y").replace("a*exp(-a)", "a")
    with pytest.raises(ModelError, match=r"'b' moves the points of the table 'loads\.gas\.value'"):
        da.compile(da.loads(text), vary=["b"])


def test_positions_do_not_vary() -> None:
    text = LOADS.replace("from: 5,", "from: b/4,").replace("a*exp(-a)", "a")
    with pytest.raises(ModelError, match=r"'b' sets 'drives\.O\.position', which cannot vary"):
        da.compile(da.loads(text), vary=["b"])


def test_a_parameter_beside_a_plain_path_and_one_that_replaces_an_expression() -> None:
    m = da.load(examples()["pump"])
    k = da.compile(m, vary=["area", "links.rod.inertia"], outputs=["effort.O"])
    values = {"area": 0.002, "links.rod.inertia": 0.001}
    expected = da.dynamics(m.with_values(values)).effort("O")
    np.testing.assert_allclose(k([list(values.values())]).effort("O")[0], expected, rtol=1e-9)
    with pytest.raises(ModelError, match="'area' follows from the parameter 'bore', and both vary"):
        da.compile(m, vary=["area", "bore"])
    assert "pump" in k.to_c("pump")
