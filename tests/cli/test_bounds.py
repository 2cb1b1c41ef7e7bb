"""Numbers out of their bounds are refused at the option, from Python and the command line alike, before any work."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bounds import BOUNDS, LARGEST, SMALLEST, require
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.cli.machine.counterweight_argument import bounds_of as counterweight
from dalembert.errors import ArgumentError, ModelError

NAN, INF = math.nan, math.inf


@pytest.mark.parametrize("key", BOUNDS)
def test_each_bound_holds_from_both_sides(key: str) -> None:
    low, high, ends, whole = BOUNDS[key][1:]
    allows = BOUNDS[key].allows
    step = 1 if whole else None
    for end, inside, taken in ((low, 1, ends[0]), (high, -1, ends[1])):
        near = int(end) if whole else end
        within = near + inside if step else math.nextafter(near, inside * INF) if near else inside * SMALLEST
        beyond = (
            near - inside if step else math.nextafter(near, -inside * INF) if near else -inside * SMALLEST
        )
        assert allows(near) is taken
        assert allows(within)
        assert allows(np.int64(within) if whole else np.float64(within))
        assert not allows(beyond)
    for bad in (NAN, INF, -INF, "1", None, True, np.bool_(True), [1]):
        assert not allows(bad)
    assert whole or not allows(1e-70)
    with pytest.raises(ArgumentError, match="give "):
        require(key, 10 * LARGEST if not whole else 2.5)


@cache
def engine() -> Any:
    bearing = {"joints.A.bearing": {"rating": "12 kN"}}
    return da.dynamics(da.slider_crank(crank=0.05, rod=0.2).with_values(bearing), positions=12)


@cache
def four_bar() -> Any:
    return da.four_bar(ground=0.4, crank=0.1, coupler=0.35, rocker=0.3)


@cache
def study() -> Any:
    return da.study(four_bar(), {"links.crank.mass": "uniform ± 5 %"}, ["effort.O2"], designs=8)


@cache
def studied() -> Any:
    return study().run()


@cache
def forces() -> Any:
    return da.wrench.System(da.wrench.Force([1, 2]), da.wrench.Force([3, 2], at=[1, 0]))


def variants(**options: Any) -> Any:
    return da.variants(four_bar(), {"links.crank.mass": "[1 kg, 2 kg]"}, **options)


def optimize(**options: Any) -> Any:
    return da.optimize(four_bar(), {"links.crank.mass": (0.1, 1.0)}, "peak effort.O2", **options)


def weights(**bound: Any) -> Any:
    return da.balance(four_bar(), {"crank": bound})


POSITIVE = (0, -3, NAN, INF, 1e200, 1e-200, "x", True)
WHOLE = (-1, 2.5, NAN, INF, 1e300, "x", True)
CALLS: dict[str, tuple[Callable[[Any], Any], tuple[Any, ...]]] = {
    "hours": (lambda v: da.bearings(engine(), hours=v), POSITIVE),
    "factor": (lambda v: da.bearings(engine(), hours=10, factor=v), POSITIVE),
    "safety": (lambda v: da.bearings(engine(), safety=v), POSITIVE),
    "hours ": (lambda v: da.bearing(engine(), "A").rating_for(v), POSITIVE),
    "reliability": (lambda v: da.bearing(engine(), "A").rating_for(9, 1, v, (0.02, 4.4, 1.5)), (0, 1, -1, 2, NAN)),
    "theta - x0 of weibull": (lambda v: da.bearing(engine(), "A").rating_for(9, 1, 0.9, (0, v, 1.5)), POSITIVE),
    "efficiency": (lambda v: da.motor(engine(), efficiency=v), (0, -1, 1.5, math.nextafter(1, 2), NAN, INF)),
    "ratio": (lambda v: da.motor(engine(), ratio=v), POSITIVE),
    "ratio ": (lambda v: da.motor(engine()).need(v), POSITIVE),
    "motor inertia": (lambda v: da.motor(engine(), inertia=v), POSITIVE[1:]),
    "rated torque": (lambda v: da.motor(engine(), rated=v), POSITIVE),
    "Cs": (lambda v: da.flywheel(engine(), Cs=v), (0, -1, 2, 3, NAN, INF)),
    "inertia": (lambda v: da.flywheel(engine(), inertia=v), POSITIVE),
    "energy": (lambda v: da.flywheel_size(v, 20, Cs=0.02), (-1, NAN, INF, 1e200)),
    "pulse": (lambda v: da.flywheel_size([v, 1], 20, Cs=0.02), (NAN, INF, 1e200)),
    "speed": (lambda v: da.flywheel_size(1, v, Cs=0.02), (NAN, INF, 1e200)),
    "radius of gyration": (lambda v: da.flywheel_size(1, 20, Cs=0.02).mass(v), POSITIVE),
    "thickness": (lambda v: da.flywheel_size(1, 20, Cs=0.02).disc(7200, thickness=v), POSITIVE),
    "height": (lambda v: da.flywheel_size(1, 20, Cs=0.02).rim(7200, 0.5, height=v), POSITIVE),
    "radius": (lambda v: da.balance_rotor(da.rotating_shaft(), (0.1, 0.4), (v, 0.1)), POSITIVE),
    "plane": (lambda v: da.balance_rotor(da.rotating_shaft(), (v, 0.4), (0.1, 0.1)), (NAN, INF, 1e200, "x")),
    "orders": (lambda v: da.shaking(engine()).harmonics(v), WHOLE),
    "order": (lambda v: da.shaking(engine()).harmonics([v]), (-1, NAN, INF, "x")),
    "about": (lambda v: da.shaking(engine(), about=(v, 0)), (NAN, INF, "x")),
    "counterweight on crank: mass": (lambda v: weights(mass=v), POSITIVE),
    "counterweight on crank: place": (lambda v: weights(place=(v, 0.1)), (NAN, INF, 1e300, "x")),
    "counterweight on crank: x": (lambda v: weights(x=(0, v)), (NAN, INF, 1e300, "x")),
    "counterweight on crank: thickness": (lambda v: weights(disc=(7800, v, 0.1)), POSITIVE),
    "the weight of force": (lambda v: da.balance(four_bar(), ["crank"], of={"force": v}), (-1, NAN, INF, "x")),
    "count": (lambda v: da.balance(four_bar(), ["crank"]).trade_off("torque", v), (0, *WHOLE)),
    "distance of the bearings": (
        lambda v: da.gyroscopic(da.dynamics(da.rotating_shaft()), "shaft").bearing_force(v), POSITIVE),
    "designs": (lambda v: da.study(four_bar(), {"links.crank.mass": "± 5 %"}, ["effort.O2"], designs=v), (0, *WHOLE)),
    "seed": (lambda v: da.study(four_bar(), {"links.crank.mass": "± 5 %"}, ["effort.O2"], seed=v), WHOLE),
    "design": (lambda v: study().design(v), WHOLE),
    "designs ": (lambda v: study().extended(v), (0, *WHOLE)),
    "threads": (lambda v: study().run(threads=v), (0, *WHOLE)),
    "designs  ": (lambda v: study().contributions("effort.O2", "sobol", v), (0, 1, *WHOLE)),
    "count ": (lambda v: study().response("effort.O2", "links.crank.mass", count=v), (0, 1, 1001, *WHOLE)),
    "bins": (lambda v: studied().histogram("effort.O2", v), (0, *WHOLE)),
    "percentile": (lambda v: studied().percentiles("effort.O2", (v,)), (-1, 100.1, NAN, "x")),
    "some": (lambda v: studied().failed(v), WHOLE),
    "starts": (lambda v: optimize(starts=v), (0, *WHOLE)),
    "seed ": (lambda v: optimize(starts=1, seed=v), WHOLE),
    "count  ": (lambda v: variants(count=v), (0, 1001, *WHOLE)),
    "seed  ": (lambda v: variants(count=1, seed=v), WHOLE),
    "tolerance": (lambda v: forces().equilibrium(tolerance=v), (-1, 1.1, NAN, INF, "x")),
    "tolerance ": (lambda v: da.wrench.arrangement(forces(), v), (-1, 1.1, NAN, INF, "x")),
    "length": (lambda v: forces().kind(length=v), (-1, NAN, INF, 1e300, "x")),
}  # fmt: skip
"""Name of a number in the message -> a function that takes it, and values that mean nothing."""


@pytest.mark.parametrize("name", CALLS)
def test_a_function_refuses_what_means_nothing(name: str) -> None:
    call, bad = CALLS[name]
    for value in bad:
        with pytest.raises(ModelError, match="; give ") as refused:
            call(value)
        assert str(refused.value).startswith(f"{name.strip()} is "), value


OPTIONS = [
    ("bearings", "hours", "-3", "invalid value for --hours: '-3' is not allowed; give a number above 0"),
    ("bearings", "hours", "nan", "'nan' is not allowed; give a finite number above 0"),
    ("bearings", "hours", "many", "invalid value for --hours: 'many' is not allowed; give a number above 0"),
    ("bearings", "factor", "-2", "invalid value for --factor: '-2' is not allowed; give a number above 0"),
    ("bearings", "safety", "0", "invalid value for --safety: '0' is not allowed; give a number above 0"),
    ("motor", "efficiency", "1.5", "'1.5' is not allowed; give a number above 0, at most 1"),
    ("motor", "ratio", "1e99", "'1e99' is not allowed; give a number above 0, of a size from 1e-60 to 1e+60"),
    ("motor", "inertia", "-3kg*m^2", "--inertia is -3kg*m^2; give 0 or a number above 0"),
    ("motor", "rated", "0", "--rated is 0; give a number above 0"),
    ("motor", "rated", "3kg", "--rated: '3kg' is a mass, but a moment is needed"),
    ("flywheel", "Cs", "3", "invalid value for --Cs: '3' is not allowed; give a number above 0 and below 2"),
    ("flywheel", "inertia", "-3kg*m^2", "--inertia is -3kg*m^2; give a number above 0"),
    ("shake", "orders", "-3", "--orders: '-3' is not allowed; give a whole number from 0 to 1000000"),
    ("shake", "orders", "2.5", "invalid value for --orders: '2.5' is not allowed; give a whole number"),
    ("simulate --until 1s", "count", "1", "--count: '1' is not allowed; give a whole number from 2 to"),
    ("simulate --until 1s", "tolerance", "0", "--tolerance: '0' is not allowed; give a number from 1e-14"),
    ("balance --on crank", "of", "force=inf", "the weight of force is inf; give 0 or a finite number above 0"),
    ("balance --planes 50mm,450mm", "radii", "0mm", "radius is 0; give a number above 0"),
    ("balance --planes 50mm,450mm", "radii", "-1mm", "radius is -0.001; give a number above 0"),
    ("balance --radii 40mm", "planes", "50mm,50mm", "both planes are at 0.05 m; give two planes apart"),
    ("variants --vary loads.F.value=[1,2] -o x", "count", "0", "'0' is not allowed; give a whole number from 1 to"),
    ("variants --vary loads.F.value=[1,2] -o x", "seed", "-1", "invalid value for --seed: '-1' is not allowed; give a"),
    ("variants --vary loads.F.value=[1,2] -o x", "tolerance", "-3%", "'-3%' is not a tolerance in percent"),
]  # fmt: skip


@pytest.mark.parametrize(("command", "option", "value", "sentence"), OPTIONS)
def test_an_option_refuses_what_means_nothing(
    command: str, option: str, value: str, sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = examples()["four_bar" if "balance" in command else "engine"]
    if "planes" in command + option:
        file = tmp_path / "shaft.yaml"
        da.rotating_shaft().save(file)
    name, *rest = command.split()
    assert main([name, str(file), *rest, f"--{option}", value]) == 2
    said = capsys.readouterr()
    assert sentence in said.err
    assert ".yaml:" not in said.err  # no line of the file is wrong
    assert said.out == ""


@pytest.mark.parametrize(
    ("text", "disc"),
    [
        ("7800kg/m^3/20mm/80mm", (7800.0, 0.02, 0.08)),
        ("7.8g/cm^3/20mm/80mm", (7800.0, 0.02, 0.08)),
        ("0.3lb/in^3/1in/3in", (0.3 * 0.45359237 / 0.0254**3, 0.0254, 0.0762)),
        ("7800/0.02/0.08", (7800.0, 0.02, 0.08)),
        ("7800kg/m^3/20mm", None),
        ("7800/0.02", None),
        ("7800", None),
    ],
)
def test_a_disc_is_a_density_with_any_unit_a_thickness_and_a_radius(text: str, disc: Any) -> None:
    m = da.four_bar()
    if disc is None:
        with pytest.raises(da.ModelError, match=f"{re.escape(text)}: a disc is density/thickness/radius"):
            counterweight(m, f"crank:disc={text}")
    else:
        link, bounds = counterweight(m, f"crank:disc={text}")
        assert (link, bounds) == ("crank", {"disc": pytest.approx(disc)})
