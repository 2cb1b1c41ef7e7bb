"""Balancing: books, smallest circles, right angles, dual values, other optimisers, the machine analysed anew."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import lsq_linear, minimize

import dalembert as da
from dalembert.answer.column import Scale
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.machine.balance.cone_programme import minimise
from dalembert.printing import number
from tests.machine.cranks import crank_machine
from tests.random_space import random_case as random_in_space
from tests.random_space import tree as tree_in_space
from tests.tiers import nth, over

FOUR_BAR = """
links:
  ground: {points: {O2: [0, 0], O4: [0.4, 0]}}
  crank: {points: {O2: [0, 0], A: [0.1, 0]}, mass: 1, center: [0.05, 0]}
  coupler: {points: {A: [0, 0], B: [0.35, 0]}, mass: 2, center: [0.15, 0.02]}
  rocker: {points: {O4: [0, 0], B: [0.3, 0]}, mass: 1.5, center: [0.1, 0]}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives:
  O2: {position: {from: 0, to: 360, count: 72}, speed: 10 rad/s}
assembly: {coupler: 40, rocker: 90}
"""


@pytest.fixture(scope="module")
def four_bar() -> Any:
    return da.loads(FOUR_BAR)


def test_full_force_balance_of_a_four_bar(four_bar: Any) -> None:
    """Berkof and Lowen 1969: the residual of least squares is 0, and the moment the same about every point."""
    b = da.balance(four_bar, ["crank", "rocker"])
    assert b.complete
    assert b.residual < 1e-12
    moments = [da.shaking(b.after.result, about=point).moment for point in ((0, 0), (3.0, -2.0))]
    assert np.abs(moments[0] - moments[1]).max() < 1e-10
    assert da.balance(four_bar, ["crank"]).missing() == ["rocker"]


def test_least_squares_of_a_crank_balance_half_of_what_goes_to_and_fro(four_bar: Any) -> None:
    m = da.slider_crank(crank=0.05, rod=0.12).with_values(
        {"links.rod.mass": 0.7, "links.rod.center": [0.04, 0]}
    )
    drive = next(iter(m.drives))
    m = m.with_values({f"drives.{drive}.speed": 100.0})
    b = da.balance(m, ["crank"], positions=90)
    turning = m.mass("crank") * m.center("crank")[0] + 0.7 * (2 / 3) * 0.05
    going = (m.mass("piston") + 0.7 / 3) * 0.05
    assert b.numbers[0, 1] == pytest.approx(-(turning + going / 2), rel=1e-9)


def smallest_circle(points: Any) -> tuple[complex, float]:
    """Centre and radius of the smallest circle round points, by all pairs and triples."""
    best: tuple[complex, float] = (0j, math.inf)
    n = len(points)
    for i in range(n):
        for j in range(i):
            centres = [(points[i] + points[j]) / 2]
            for k in range(j):
                a, b, c = points[i], points[j], points[k]
                d = 2 * ((b - a).conjugate() * (c - a)).imag
                if abs(d) > 1e-12 * abs(b - a) * abs(c - a):
                    centres.append(a + 1j * ((b - a) * abs(c - a) ** 2 - (c - a) * abs(b - a) ** 2) / d)
            for z in centres:
                radius = float(np.abs(points - z).max())
                if radius < best[1]:
                    best = z, radius
    return best


def test_the_least_peak_of_one_crank_is_a_smallest_circle() -> None:
    r = da.dynamics(crank_machine(5, count=18).with_values({"gravity": None}))
    s = da.shaking(r)
    force = s.parts["inertia"][0] @ [1, 1j]
    turned = force * np.exp(-1j * r.angle("crank")) / r.speed("crank") ** 2
    centre, radius = smallest_circle(turned)
    b = da.balance(r, {"crank": {"radius": 0.2}}, least="max")
    assert complex(*b.numbers[0, 1:3]) == pytest.approx(-centre, abs=1e-7 * abs(centre))
    assert b.sizes()["force"][1] == pytest.approx(radius * r.speed("crank")[0] ** 2, rel=1e-9)
    assert b.gap < 1e-9


def test_boxes_are_those_of_a_bounded_least_squares_solver(four_bar: Any) -> None:
    bounds = {"crank": {"x": (-0.1, 0.1), "y": (0.0, 0.0)}, "rocker": {"x": (-0.3, 0.0), "y": (-0.05, 0.05)}}
    b = da.balance(four_bar, bounds)
    r = b.result
    columns = []
    for link, moment in (("crank", 0), ("crank", 1), ("rocker", 0), ("rocker", 1)):
        u = (
            (1j * r.acceleration(link) - r.speed(link) ** 2)
            * np.exp(1j * r.angle(link))
            * (1j if moment else 1)
        )
        columns.append(np.concatenate([-u.real, -u.imag]))
    low, high = np.array([-0.1, -1e-12, -0.3, -0.05]), np.array([0.1, 1e-12, 0.0, 0.05])
    s = lsq_linear(np.stack(columns, 1), -b.before.force.T.ravel(), (low, high), method="bvls", tol=1e-14)
    assert b.numbers[:, 1:3].ravel() == pytest.approx(s.x, abs=1e-7)


@over(4, 200)
def test_no_other_counterweights_leave_less(seed: int) -> None:
    """Least squares at right angles to the columns, or a dual value as large; the linear model is the machine."""
    m = crank_machine(seed, count=18)
    bounds = {
        "crank": {"radius": 0.1, "mass": 2.0},
        "last": {"radius": 0.15, "mass": 1.5, "at": "C" if seed % 2 == 0 else "B"},
    }
    rng = np.random.default_rng(seed)
    for least in ("rms", "max"):
        of = {"force": 1.0, "moment": float(rng.uniform(0, 1)), "torque": float(rng.uniform(0, 1))}
        b = da.balance(m, bounds, least=least, of=of)
        assert b.gap < 1e-8
        assert b.residual < 1e-9
        mass, x, y, inertia = b.numbers.T
        radius = np.array([0.1, 0.15])
        assert (x**2 + y**2 <= mass * inertia * (1 + 1e-7) + 1e-12).all()
        assert (inertia <= radius**2 * mass * (1 + 1e-7) + 1e-12).all()
        assert (mass <= np.array([2.0, 1.5]) * (1 + 1e-7)).all()
        others = b.problem.predict("force", b.numbers.ravel())
        assert others == pytest.approx(b.after.parts["inertia"][0], abs=1e-8 * np.abs(b.before.force).max())


@pytest.mark.parametrize(
    ("least", "of"), [("rms", "force"), ("max", "force"), ("max", {"force": 1, "moment": 2})]
)
def test_external_loads_are_no_part_of_what_is_balanced(least: Any, of: Any) -> None:
    """No counterweight balances a load: with one of 200 kN the counterweights are those without it."""
    m = crank_machine(2, count=18).with_values({"loads": {}})
    loaded = m.with_values(
        {"loads": {"press": {"type": "force", "on": "rod", "at": "B", "value": [-2e5, "1e4*sin(O)"]}}}
    )
    bounds = {"crank": {"radius": 0.1, "mass": 50.0}, "last": {"radius": 0.2, "mass": 50.0}}
    free, b = (da.balance(x, bounds, least, of) for x in (m, loaded))
    assert b.numbers == pytest.approx(free.numbers, rel=1e-5, abs=1e-9)
    assert (b.value, b.bound) == pytest.approx((free.value, free.bound), rel=1e-7)
    assert b.sizes()["force"] == pytest.approx(free.sizes()["force"], rel=1e-5)
    said = " ".join(str(b).split())
    assert "No counterweight changes the external loads, press: at most 2002" in said
    assert "external" not in str(free).replace("external loads.", "")


BY_CENTRE = """
gravity: standard
links:
  ground: {points: {O: [0, 0], S: [1, 0]}}
  crank: {points: {O: [0, 0], A: [0.2, 0], P: {from: center, at: [0.01, 0.02]}, Q: {from: P, at: [0.1, 0]}}, MASS}
  rod: {points: {C: [0, 0], R: [1, 0]}, mass: 0.4, center: [0.6, 0]}
joints:
  O: {type: pin, links: [ground, crank]}
  C: {type: pin, links: [crank, rod], at: [center, C]}
  S: {type: slot, links: [ground, rod], at: [S, R]}
drives: {O: {position: {from: 0, to: 360, count: 24}, speed: 10 rad/s}}
assembly: {rod: 60}
loads:
  F: {type: force, on: crank, at: center, value: [3, 4]}
  G: {type: force, on: crank, at: P, value: [3, 4]}
  H: {type: force, on: crank, at: Q, value: [3, 4]}
  K: {type: spring, between: [ground.S, crank.center], stiffness: 50, free_length: 0.2}
"""


@pytest.mark.parametrize("mass", ["mass: 1", "weight: 9", "shape"])
def test_points_loads_and_joints_at_a_mass_centre_stay_where_they_are(mass: str, tmp_path: Path) -> None:
    """A counterweight moves the mass centre of its link, not what the file places by it: also in the file written."""
    text = BY_CENTRE.replace("MASS", f"{mass}, center: [0.1, 0.02], inertia: 0.01")
    if mass == "shape":
        bar = "shape: {type: bar, between: [O, A], density: 8000, area: 0.0005}, mass_along: shape, members: [[O, A]]"
        text = BY_CENTRE.replace("MASS", bar).replace("{from: center, at: [0.01, 0.02]}", "[0.11, 0.02]")
    m = da.loads(text)
    b = da.balance(m, {"crank": {"radius": 0.1, "mass": 3.0}}, of={"force": 1, "torque": 1})
    assert b.numbers[0, 0] > 0.5
    assert b.residual < 1e-12
    after = b.after.result.mechanism
    assert after.center("crank") != m.center("crank")
    assert [after.point("crank", p) for p in "PQ"] == [
        pytest.approx(m.point("crank", p), abs=1e-15) for p in "PQ"
    ]
    after.save(tmp_path / "b.yaml")
    again = da.dynamics(da.load(tmp_path / "b.yaml"), positions=24)
    assert again.effort("O") == pytest.approx(b.after.result.effort("O"), abs=1e-9)


def test_the_sentences_on_full_balance_are_those_of_the_inertia(four_bar: Any) -> None:
    pull = {"type": "force", "on": "rocker", "at": "B", "value": [1000.0, 0.0]}
    b = da.balance(four_bar.with_values({"loads": {"pull": pull}}), ["crank", "rocker"])
    assert b.complete
    assert b.missing() == []
    assert "The force is balanced completely" in str(b)
    record: Any = b.record(Scale(None))
    assert record["balance"]["complete"] is True
    heads = [c.name for c in b.columns()]
    assert {"before.inertia_force.x", "after.inertia_force.x", "after.shaking_force.x"} <= {*heads}


def test_friction_is_the_difference_of_the_re_analysis() -> None:
    """Other weights, other joint forces, other friction: said where there is friction, and only there."""
    rough = FOUR_BAR.replace("O2: {type: pin,", "O2: {type: pin, friction: {coefficient: 0.1, radius: 0.05},")
    for file, rubs in ((FOUR_BAR, False), (rough, True)):
        b = da.balance(da.dynamics(da.loads(file)), ["crank", "rocker"])
        assert ("the balance takes friction as it was without them" in str(b)) == rubs
        assert (b.residual > 1e-9) == rubs


@pytest.mark.parametrize("least", ["rms", "max"])
def test_a_sum_is_a_part_of_the_sum_before(least: Any) -> None:
    """Without any counterweight all is left: the value of a weighted sum is then 1, and 95 % is less than before."""
    of = {"force": 1.0, "torque": 0.5, "moment": 0.25}
    b = da.balance(crank_machine(2, count=18), {"crank": {"radius": 0.01, "mass": 0.01}}, least, of)
    k = ("rms", "max").index(least)
    sides = [
        {name: w * b.sizes(after)[name][k] / b.sizes(False)[name][k] for name, w in of.items()}
        for after in (False, True)
    ]
    before, after = (np.hypot.reduce([*x.values()]) if least == "rms" else sum(x.values()) for x in sides)
    assert b.value == pytest.approx(after / before, rel=1e-9)
    assert 0.9 < b.bound <= b.value < 1
    assert f"{100 * b.value:.3f}"[:5] in str(b)
    main, other = zip(*b.trade_off("torque", 3), strict=True)
    assert max(main) <= 1 + 1e-9
    assert max(other) <= 1 + 1e-6


def test_what_was_not_there_before_is_no_part_of_a_sum() -> None:
    """A rotor without unbalance, and one whose force passes through the point of moments."""
    still = da.balance(
        crank_machine(2, count=18).with_values(
            {f"links.{link}.{key}": 0 for link in ("crank", "rod", "last") for key in ("mass", "inertia")}
        ),
        ["crank"],
    )
    assert still.complete
    assert still.missing() == []
    assert "There was no force to balance: no counterweight is needed." in " ".join(str(still).split())
    assert all(p.mass == 0 for p in still.placed.values())


def test_a_link_without_mass_may_need_the_counterweight(four_bar: Any) -> None:
    """Of a slider-crank with a rod without mass the rod's counterweight carries the piston's mass to the crank pin."""
    m = da.slider_crank(crank=0.05, rod=0.2).with_values({"links.rod.mass": 0, "links.rod.inertia": 0})
    b = da.balance(m, ["crank"])
    assert b.missing() == ["rod"]
    assert "a counterweight is missing on rod" in " ".join(str(b).split())
    assert da.balance(m, {"crank": {}, "rod": {"at": "A", "mass": 50, "radius": 0.1}}).value < 1e-6


def test_least_squares_leave_what_is_at_right_angles_to_all_columns(four_bar: Any) -> None:
    b = da.balance(four_bar, ["crank"])
    u = b.problem.columns["force"][:, :, 1:3].reshape(-1, 2)
    rest = b.after.force.ravel()
    assert np.abs(u.T @ rest).max() < 1e-10 * np.linalg.norm(u) * np.linalg.norm(rest)


def test_the_cone_method_agrees_with_a_general_one() -> None:
    rng = np.random.default_rng(3)
    y, c = rng.normal(size=(20, 2)), rng.normal(size=(20, 2, 3))
    g, h = np.zeros((21, 4, 4)), np.zeros((21, 4))
    g[:20, 0, 3], g[:20, 1:3, :3], h[:20, 1:3] = -1.0, -c, y
    g[20, 1:, :3], h[20, 0] = -np.eye(3), 0.2  # |x| <= 0.2
    found = minimise(np.array([0.0, 0, 0, 1]), g, h)
    assert found.gap < 1e-10
    general = minimize(
        lambda x: x[3], [0, 0, 0, 10.0], method="SLSQP", options={"ftol": 1e-14, "maxiter": 500},
        constraints=[
            {"type": "ineq", "fun": lambda x: x[3] ** 2 - ((y + c @ x[:3]) ** 2).sum(1)},
            {"type": "ineq", "fun": lambda x: 0.04 - (x[:3] ** 2).sum()},
        ],
    )  # fmt: skip
    assert found.primal == pytest.approx(general.fun, rel=1e-6)


def test_a_trade_off_gains_one_for_the_other(four_bar: Any) -> None:
    b = da.balance(four_bar, {"crank": {"mass": 3}, "rocker": {"mass": 3}})
    pairs = np.array(b.trade_off("torque", 5))
    assert (np.diff(pairs[:, 0]) > 0).all()
    assert (np.diff(pairs[:, 1]) < 0).all()


def test_discs_and_places(four_bar: Any) -> None:
    disc = da.balance(four_bar, {"crank": {"disc": (7800.0, 0.02, 0.05)}, "rocker": None})
    p = disc.placed["crank"]
    assert p.moment <= 7800 * 0.02 * math.pi * 0.05**3 * (1 + 1e-9)
    assert p.radius is not None
    assert p.mass == pytest.approx(7800 * 0.02 * math.pi * p.radius**2)
    assert np.hypot(*p.center) == pytest.approx(p.radius)
    assert p.inertia == pytest.approx(p.mass * p.radius**2 / 2)
    placed = da.balance(four_bar, {"crank": {"place": (-0.05, 0.0)}}).placed["crank"]
    assert placed.center.tolist() == [-0.05, 0.0]
    assert placed.mass > 0
    shaped = four_bar.with_values({"links.crank.mass": None})
    assert da.balance(shaped, ["crank", "rocker"]).complete


def test_a_plane_machine_lifted_into_space_gets_the_same_counterweights(four_bar: Any) -> None:
    """Its reactions are not unique there, which balancing does not ask for; a disc has its tensor about the axis."""
    bounds = {"crank": {"radius": 0.1, "mass": 2.0}, "rocker": {"radius": 0.15, "mass": 1.5}}
    lifted = da.lifted(four_bar)
    assert set(da.dynamics(lifted).status) == {"redundant"}
    for least in ("rms", "max"):
        of = {"force": 1.0, "moment": 0.6, "torque": 0.4}
        a, b = (da.balance(m, bounds, least=least, of=of) for m in (four_bar, lifted))  # type: ignore[arg-type]
        assert b.value == pytest.approx(a.value, rel=1e-8)
        assert b.numbers[:, :3] == pytest.approx(a.numbers[:, :3], abs=1e-6)
        assert b.numbers[:, 4:6].sum(axis=1) == pytest.approx(a.numbers[:, 3], abs=1e-7)
        assert b.residual < 1e-12
    p = da.balance(lifted, {"crank": {"disc": (7800.0, 0.02, 0.05)}, "rocker": None}).placed["crank"]
    assert p.radius is not None
    assert np.diag(p.inertia) == pytest.approx(p.mass * p.radius**2 * np.array([0.25, 0.25, 0.5]))


def moving_in_space(seed: int) -> Any:
    """A random mechanism in space at five positions of its drives."""
    m = da.mechanism(tree_in_space(random_in_space(seed)))
    s, values = m.schedule(), {}
    for k, name in enumerate(s.names):
        values[f"drives.{name}.position"] = [float(s.position[0, k] + 0.02 * i) for i in range(5)]
        values[f"drives.{name}.speed"] = float(s.speed[0, k])
        values[f"drives.{name}.acceleration"] = float(s.acceleration[0, k])
    return da.dynamics(m.with_values(values))


def moves(seed: int) -> bool:
    """Whether it gets so far."""
    return bool(np.isfinite(moving_in_space(seed).acceleration_array).all())


@over(1, 200)
def test_in_space_no_others_leave_less_and_the_machine_is_what_was_promised(seed: int) -> None:
    r = moving_in_space(nth(seed, moves))
    links, rng = r.links[:2] if seed % 2 else r.links[-2:], np.random.default_rng(seed)
    free = {link: {"radius": 0.3, "mass": 2.0} for link in links}
    placed = {link: {"place": tuple(rng.uniform(-0.3, 0.3, 3)), "mass": 3.0} for link in links}
    whole = {"force": 1.0, "moment": 0.5} | ({"torque": 0.3} if r.drives else {})
    for bounds, of in ((free, {"force": 1.0}), (placed, whole)):
        for least in ("rms", "max"):
            b = da.balance(r, bounds, least=least, of=of)  # type: ignore[arg-type]
            assert b.gap < 1e-8
            assert b.residual < 1e-9
            assert bounds is placed or all(p.moment <= 0.3 * p.mass + 1e-7 for p in b.placed.values())
            assert b.numbers[:, 0].max() < 3.0 * (1 + 1e-6)


def test_an_rssr_is_balanced_by_its_crank_and_rocker(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, drawing = str(examples()["rssr"]), tmp_path / "b.svg"
    on = ["--on", "crank", "rocker:radius=60mm"]
    assert main(["balance", file, *on, "--drawing", str(drawing), "--report", str(tmp_path / "b.txt")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "The force is balanced completely: the moment is the same about every point" in said
    assert "Magnitude of the shaking force" in drawing.read_text()
    at = ["--on", "rod:place=10mm/0/-60mm,mass=0.1kg", "crank:x=-0.01kg*m/0,y=0/0,mass=1kg", "--of", "moment"]
    assert main(["balance", file, *at, "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)["balance"]["counterweights"]
    assert found["rod"]["center"] == pytest.approx([0.01, 0.0, -0.06])
    assert found["crank"]["angle"] is None
    free = ["--on", "rod:radius=60mm,mass=0.1kg", "--of", "moment"]
    assert main(["balance", file, *free]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "its link does not turn about a fixed axis; give its place: place: (x, y, z)" in said


WRONG = [
    ({"arm": {}}, {}, "'arm' is not a moving link that can carry a counterweight"),
    ({"crank": {"radios": 1}}, {}, "counterweight on crank: unknown bound 'radios'"),
    ({"crank": {"radius": -1.0}}, {}, "counterweight on crank: radius is -1; give a number above 0"),
    (
        {"crank": {}, "rocker": {}},
        {"of": "torque"},
        "its mass and inertia matter here, but its mass has no bound",
    ),
    ({"crank": {}}, {"of": "power"}, "'power' is not an objective"),
    ({"crank": {"x": (1.0, 0.0)}}, {}, "the range of x is empty"),
    ({"crank": {"place": (1.0, 0.0, 0.0)}}, {}, "a place has 2 coordinates"),
    ({}, {}, "no link is to have a counterweight"),
    ({"crank": {}}, {"least": "least"}, "least is 'least'"),
    ({"crank": {}}, {"least": "rms effort.B"}, "'effort.B' cannot be balanced; choose among shaking_force"),
]


@pytest.mark.parametrize("quantity", ["shaking_force", "shaking_moment", "effort"])
@pytest.mark.parametrize("word", ["rms", "peak"])
def test_an_aim_is_named_as_in_every_other_place(four_bar: Any, word: str, quantity: str) -> None:
    (drive,) = four_bar.drives
    name = f"effort.{drive}" if quantity == "effort" else quantity
    b = da.balance(four_bar, {"crank": {"mass": 3}}, least=f"{word} {name}")
    short = {"shaking_force": "force", "shaking_moment": "moment", "effort": "torque"}[quantity]
    assert (
        b.value
        == da.balance(four_bar, {"crank": {"mass": 3}}, "rms" if word == "rms" else "max", short).value
    )
    if quantity != "shaking_moment":
        left, before = (da.dynamics(m, positions=72)[name] for m in (b.mechanism, four_bar))
        size = (lambda v: np.sqrt((v**2).mean())) if word == "rms" else (lambda v: np.abs(v).max())
        sizes = [size(np.linalg.norm(v.reshape(len(v), -1), axis=1)) for v in (left, before)]
        assert sizes[0] / sizes[1] == pytest.approx(b.value, rel=1e-9)


@pytest.mark.parametrize(("weights", "options", "sentence"), WRONG)
def test_bounds_that_mean_nothing_are_refused(
    four_bar: Any, weights: Any, options: Any, sentence: str
) -> None:
    with pytest.raises(ModelError, match=sentence):
        da.balance(four_bar, weights, **options)


def test_the_command_prints_draws_and_writes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, balanced, record = tmp_path / "four_bar.yaml", tmp_path / "balanced.yaml", tmp_path / "b.json"
    file.write_text(FOUR_BAR)
    arguments = ["--on", "crank", "rocker:radius=200mm", "--output", str(balanced), "--json", str(record)]
    assert main(["balance", str(file), *arguments, "--report", str(tmp_path / "b.txt")]) == 0
    said = capsys.readouterr().out
    assert "The force is balanced completely" in said
    assert json.loads(record.read_text())["balance"]["complete"] is True
    left = da.shaking(da.dynamics(da.load(balanced))).force
    assert np.abs(left).max() < 1e-9
    assert "F = −m a_A" in (tmp_path / "b.txt").read_text()
    engine = str(examples()["engine"])
    assert (
        main(
            [
                "balance",
                engine,
                "--on",
                "crank:disc=7800kg/m^3/20mm/80mm",
                "--least",
                "max",
                "--positions",
                "72",
            ]
        )
        == 0
    )
    assert "counterweight is missing on rod" in " ".join(capsys.readouterr().out.split())
    assert main(["balance", str(file), "--on", "crank:radius"]) == 2
    assert "write --on crank:radius=80mm,mass=2kg" in capsys.readouterr().err


def last(b: da.Balance) -> str:
    return " ".join(b.text().split("\n\n")[-1].split())


def test_a_yoke_is_balanced_by_half_and_no_more() -> None:
    """What goes to and fro is A = m r w^2; least is left with half of it turning against the pin: A / sqrt 2."""
    m = da.scotch_yoke()
    b = da.balance(m, ["crank"])
    yoke, crank = 1.5 * 0.06, 0.12 * 0.03
    assert b.placed["crank"].moment == pytest.approx(crank + yoke / 2, rel=1e-9)
    assert abs(b.placed["crank"].angle or 0) == pytest.approx(math.pi, rel=1e-12)
    part = yoke / math.sqrt(2) / math.hypot(yoke + crank, crank)
    assert (b.value, b.bound) == pytest.approx((part, part), rel=1e-9)
    percent = number(100 * part)
    assert re.sub(r"agrees to \S+\.$", "", last(b)) == (
        f"Least rms force: {percent} % of the unbalanced value. No counterweights within the bounds leave less than "
        f"{percent} % (dual value). Full force balance is impossible: some link has no path to ground through turning "
        "joints. Check: re-analysis with the counterweights "
    )
    assert b.missing() == []


def test_a_rotor_without_an_inertia_force_is_told_so() -> None:
    text = """
links: {ground: {points: {O: [0, 0]}}, rotor: {points: {O: [0, 0]}, mass: 2, inertia: 0.3}}
joints: {O: {type: pin, links: [ground, rotor]}}
drives: {O: {position: {from: 0, to: 360, count: 12}, speed: 20 rad/s, acceleration: 30 rad/s^2}}
"""
    b = da.balance(
        da.loads(text), {"rotor": da.Counterweight(radius=0.1, mass=3)}, of={"force": 1, "moment": 1}
    )
    assert b.sizes(after=False)["moment"] == pytest.approx([9.0, 9.0])
    assert last(b) == (
        "Least rms force + moment: 100 % of the unbalanced value. No counterweights within the bounds leave less than "
        "100 % (dual value). The force, 0 before, did not count. The inertia force is zero without counterweights. "
        "Check: re-analysis with the counterweights agrees to 0."
    )


def test_a_counterweight_on_a_link_that_stands_still_balances_nothing() -> None:
    text = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, mass: 2, center: [0.1, 0], inertia: 0.3},
        idle: {points: {O: [0, 0], Q: [0.3, 0]}, mass: 1, center: [0.2, 0]}}
joints: {O: {type: pin, links: [ground, wheel]}, I: {type: pin, links: [ground, idle], at: O}}
drives: {O: {position: {from: 0, to: 360, count: 12}, speed: 20 rad/s}, I: {position: 30}}
"""
    m = da.loads(text)
    b = da.balance(m, {"idle": da.Counterweight(radius=0.1, mass=3)})
    assert (b.placed["idle"].mass, b.value, b.bound) == (0.0, pytest.approx(1), pytest.approx(1))
    assert b.missing() == ["wheel"]
    both = da.balance(
        m, {"idle": da.Counterweight(radius=0.1, mass=3), "wheel": da.Counterweight(radius=0.3, mass=9)}
    )
    assert both.placed["idle"].mass == 0.0
    assert both.placed["wheel"].moment == pytest.approx(0.2, rel=1e-9)
    assert both.complete
