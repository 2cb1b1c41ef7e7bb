"""Parts of answers that few machines have: columns, sentences and numbers, each from its closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da
from dalembert.answer.column import Scale, plain
from dalembert.answer.equality import equal
from dalembert.errors import AnalysisError
from dalembert.machine.bearings.compiled_life import life_expression
from dalembert.machine.elements.pin_stresses import moment_along
from dalembert.machine.flywheel.legendre_panels import resolve
from dalembert.printing import number
from tests.elements.test_pins import FORK, hung

GEARS = """
links:
  ground: {points: {O: [0, 0], P: [0.15, 0]}}
  a: {points: {O: [0, 0]}, inertia: 0.1}
  b: {points: {P: [0, 0]}, inertia: 0.2}
joints:
  O: {type: pin, links: [ground, a]}
  P: {type: pin, links: [ground, b]}
  G: {type: gear, links: [a, b], at: [O, P], radii: [0.05, 0.1], contact: pushes, flank: FLANK}
drives: {O: {effort: "2 - 4*time"}}
start: {O: {position: 0, speed: 0}}
"""


def paragraphs(text: str) -> list[str]:
    return [" ".join(part.split()) for part in text.split("\n\n")]


@pytest.mark.parametrize(("flank", "lost"), [("left", slice(3, 5)), ("right", slice(0, 2))])
def test_teeth_that_change_flank_are_said_to_be_computed_without_backlash(flank: str, lost: slice) -> None:
    """(J_a + J_b/4) a = 2 - 4 t: half of J_b a/2 over the radius is what the teeth give, until 0.5 s on one flank."""
    s = da.simulate(da.loads(GEARS.replace("FLANK", flank)), "1 s", count=5)
    status = np.full(5, "ok", object)
    status[lost] = "contact_lost"
    assert list(s.result.status) == status.tolist()
    t = s.time
    assert s.acceleration("O") == pytest.approx((2 - 4 * t) / 0.15, abs=1e-9)
    tangential = 0.2 * s.acceleration("O") / 2 / 0.1
    size = np.hypot(*s.result.reaction("G").T)
    held = status == "ok"
    assert size[held] == pytest.approx(np.abs(tangential[held]) / math.cos(math.radians(20)), abs=1e-9)
    assert np.isnan(size[~held]).all()
    angles = np.degrees(s.position("O")[lost])
    first, last = (number(float(x), 6) for x in angles[[0, -1]])
    assert paragraphs(s.text())[-2:] == [
        f"instants {lost.start + 1}-{lost.stop}: G would have to pull with 13.3333 N between {first} deg and {last} "
        "deg of O: the teeth change flank. This contact only pushes; write contact: holds if it carries forces in both "
        "directions.",
        "The motion is computed without backlash, as if these contacts held: after that it is not exact.",
    ]


def test_power_of_a_motor_is_that_of_its_shaft() -> None:
    text = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, inertia: 2}}
joints: {O: {type: pin, links: [ground, wheel]}}
drives: {O: {motor: {stall: 10 N*m, no_load: 300 rad/s, ratio: 5, inertia: 0.01, efficiency: 0.8}}}
start: {O: {position: 0, speed: 0}}
"""
    s = da.simulate(da.loads(text), "1 s", count=5)
    use = s.motor["O"]
    assert use.speed == pytest.approx(5 * s.speed("O"))
    assert use.torque == pytest.approx(10 * (1 - use.speed / 300), rel=1e-9)
    assert use.power == pytest.approx(use.torque * use.speed, rel=1e-12)
    rotor = 0.01 * 5 * s.acceleration("O") * use.speed
    wheel = 2 * s.acceleration("O") * s.speed("O")
    assert use.power == pytest.approx(rotor + wheel + use.loss, rel=1e-9, abs=1e-9)
    assert use.loss == pytest.approx(0.25 * wheel, rel=1e-9, abs=1e-9)


def test_couples_of_an_engine_are_columns() -> None:
    """Sums of z k x F over the links, of a three-cylinder engine."""
    r = da.dynamics(da.in_line_engine(cylinders=3), positions=24)
    s = da.shaking(r)
    of = {c.name: c for c in s.columns()}
    couple = np.zeros((24, 2))
    for link in r.links:
        force = -r.mechanism.mass(link) * r.center_acceleration(link)
        couple += r.mechanism.links[link].place * np.stack([-force[:, 1], force[:, 0]], -1)
    largest = np.abs(couple).max()
    assert largest > 1
    assert of["shaking_couple.x"].values == pytest.approx(couple[:, 0], abs=1e-9 * largest)
    assert of["shaking_couple.y"].values == pytest.approx(couple[:, 1], abs=1e-9 * largest)
    assert [of[f"shaking_couple.{axis}"].kind for axis in "xy"] == ["moment", "moment"]
    assert "shaking_couple.x" not in [c.name for c in da.shaking(da.dynamics(da.slider_crank())).columns()]


def test_a_life_is_compiled_where_all_positions_last_as_long() -> None:
    """Not at rest, nor where times differ, nor of links that turn alike, nor in space."""
    m = da.four_bar(positions=8).with_values(
        {"joints.A.bearing": {"rating": "12 kN"}, "joints.O2.bearing": {"rating": 9e3}}
    )
    r = da.dynamics(m)
    turned = "abs(angle.coupler.speed - angle.crank.speed)"
    size = f"{2e6 * math.pi!r}*joints.A.bearing.rating^3.0"
    assert life_expression(r, "A") == f"{size}/mean(reaction.A.magnitude^3.0*{turned})"
    assert life_expression(r, "O2").endswith("*abs(angle.crank.speed - 0))")
    assert life_expression(da.statics(m.with_values({"drives.O2.speed": 0})), "A") == ""
    uneven = m.with_values({"drives.O2.position": [0.0, 0.1, 0.5, 2.0]})
    assert life_expression(da.dynamics(uneven), "A") == ""
    space = da.rssr(positions=8)
    joint = next(n for n, j in space.joints.items() if getattr(j, "hinge", False))
    rated = space.with_values({f"joints.{joint}.bearing": {"rating": 9e3}})
    assert life_expression(da.dynamics(rated), joint) == ""


def test_what_is_too_rough_has_no_flywheel() -> None:
    with pytest.raises(AnalysisError) as refused:
        resolve(lambda q: np.sin(1e7 * q * q), np.linspace(0, 2 * np.pi, 13))
    assert str(refused.value) == (
        "the effort is too rough over the cycle: over 10000 pieces do not resolve it"
    )


def test_a_flywheel_of_a_given_inertia_has_no_other_in_its_record() -> None:
    r = da.dynamics(da.slider_crank(), positions=24)
    one, other = (
        f.record(Scale(None))["flywheel"] for f in (da.flywheel(r, inertia=2.0), da.flywheel(r, Cs=0.05))
    )
    assert one["for_Cs"] is None
    assert other["for_Cs"]["Cs"] == pytest.approx(0.05, rel=1e-9)
    assert one["exact"]["inertia"] == 2.0


def test_what_is_left_is_nothing_where_there_was_nothing() -> None:
    """A rotor that is balanced; only bounds, none, are in the way, and no counterweight is missing."""
    b = da.balance(
        da.loads(
            "links: {ground: {points: {O: [0, 0]}}, rotor: {points: {O: [0, 0]}, mass: 2, inertia: 0.3}}\n"
            "joints: {O: {type: pin, links: [ground, rotor]}}\n"
            "drives: {O: {position: {from: 0, to: 360, count: 12}, speed: 20 rad/s}}"
        ),
        ["rotor"],
    )
    assert (b.complete, b.only_bounds, b.missing(), b.placed["rotor"].mass) == (True, True, [], 0.0)


def test_a_counterweight_leaves_what_is_at_the_mass_centre_where_it_is() -> None:
    """Under a name that no point has yet."""
    tree = da.four_bar(positions=12).to_tree()
    tree["links"]["crank"]["points"]["center_before"] = [0.01, 0.02]
    spring = {
        "type": "spring",
        "between": ["ground.O4", "crank.center"],
        "stiffness": 300,
        "free_length": 0.1,
    }
    tree["loads"] = {"S": spring}
    m = da.mechanism(tree)
    b = da.balance(m, {"crank": da.Counterweight(radius=0.1, mass=5.0)})
    assert b.placed["crank"].mass > 0
    after = b.mechanism
    assert after.loads["S"].between == (("ground", "O4"), ("crank", "center_before_"))  # type: ignore[union-attr]
    assert after.links["crank"].points["center_before_"] == pytest.approx(m.center("crank"))
    assert after.links["crank"].points["center_before"] == pytest.approx((0.01, 0.02))
    assert da.dynamics(after)["load.S"] == pytest.approx(da.dynamics(m)["load.S"], rel=1e-12)


def test_a_bolt_prints_its_largest_stresses_and_its_safeties() -> None:
    sizes = {**FORK, "allowed_pressure": "60 MPa", "yield_stress": "300 MPa"}
    r = da.statics(hung(sizes))
    x = da.pin(r, "A")
    force = float(np.hypot(*r.reaction("A")[0]))
    d, eye, cheek, gap = 0.03, 0.04, 0.022, 0.001
    shear = force / 2 / (math.pi * d**2 / 4)
    bend = force / 2 * (cheek / 2 + gap + eye / 4)
    rows = {
        "force": (force, "N"),
        "shear": (shear, "N/m^2"),
        "peak shear": (4 / 3 * shear, "N/m^2"),
        "eye pressure": (force / d / eye, "N/m^2"),
        "cheek pressure": (force / 2 / d / cheek, "N/m^2"),
        "bending": (32 * bend / math.pi / d**3, "N/m^2"),
        "moment": (bend, "N*m"),
    }
    head, *more = x.text().split("\n\n")
    lines = [row.split() for row in head.splitlines()[2:]]
    assert lines == [[*name.split(), number(value), unit, "1"] for name, (value, unit) in rows.items()]
    worst = max(32 * bend / math.pi / d**3, math.sqrt(3) * 4 / 3 * shear)
    pressure = max(force / d / eye, force / 2 / d / cheek)
    assert more == [
        f"Safety against yielding {number(300e6 / worst, 4)}: bending, or shear by von Mises.",
        f"Safety of the pressure {number(60e6 / pressure, 4)}.",
    ]


def test_a_bolt_of_its_diameter_alone_has_shear_alone() -> None:
    r = da.statics(hung({"diameter": "20 mm"}))
    x = da.pin(r, "A")
    assert [of.tolist() for of in moment_along(x, 0)] == [[], []]
    assert [c.name for c in x.columns()] == ["force.A", "shear.A", "peak_shear.A", "moment.A"]
    shear = number(float(x.peak_shear[0] / 1e6), 4)
    row = da.pins(r).text().splitlines()[5].split()
    assert row == ["A", "0.02", "2", number(float(x.force[0])), shear, "0", "deg", "-", "-", "-"]


def test_columns_of_a_stack_are_pressures_by_link() -> None:
    stack = {"diameter": "20 mm", "stack": ["left", "hook", "right"], "layers": [0, 0.018, 0.04]}
    x = da.pin(da.statics(hung({**stack, "thicknesses": [0.01, 0.016, 0.012]})), "A")
    of = {c.name: c for c in x.columns()}
    names = [f"pressure_{link}.A" for link in ("left", "hook", "right")]
    assert [*of] == ["force.A", "shear.A", "peak_shear.A", "bending.A", *names, "moment.A"]
    for link, name in zip(("left", "hook", "right"), names, strict=True):
        assert (of[name].kind, of[name].values.tolist()) == ("pressure", x.pressures[link].tolist())


def test_numbers_of_numpy_are_plain_in_a_record() -> None:
    made = plain(
        {"n": np.int64(3), "b": np.bool_(True), "x": (1.5, np.nan), "y": np.array([np.inf, 2.0]), "t": "a"}
    )
    assert made == {"n": 3, "b": True, "x": [1.5, None], "y": [None, 2.0], "t": "a"}
    assert [type(made[key]) for key in "nb"] == [int, bool]


def test_values_of_different_types_are_not_equal() -> None:
    assert equal([1, {"a": np.array([1.0, np.nan])}], [1, {"a": np.array([1.0, np.nan])}])
    for a, b in (
        (1, 1.0),
        ([1], (1,)),
        (np.array([1]), np.array([1.0])),
        (np.zeros(2), np.zeros((2, 1))),
        ({"a": 1}, {"b": 1}),
        ([1, 2], [1]),
        ("a", ["a"]),
    ):
        assert not equal(a, b)
        assert not equal(b, a)
