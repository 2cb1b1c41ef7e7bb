"""Balance, rotors, the book's series and checks of motions at the limits of what they tell apart."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert import bundled
from dalembert.analysis.output.rounding import PART, sizes
from dalembert.machine.balance.comparison import values_of
from dalembert.machine.balance.cone_programme import ConeSolution
from dalembert.machine.balance.counterweights import counterweights
from dalembert.machine.balance.mass_columns import mass_columns
from dalembert.machine.balance.rotors import RotorBalance
from dalembert.machine.motion.energies import DOUBT, MotionChecks
from tests.machine.test_engines import shaft_with_masses

UNKNOWN: Any = None


@pytest.mark.parametrize(
    ("planes", "reach"),
    [
        ((0.1, 0.4), 0.4),
        ((0.4, 0.1), 0.4),
        ((-0.2, 0.5), 0.7),
        ((0.5, -0.2), 0.7),
        ((-0.5, -0.1), 0.5),
        ((-0.1, -0.5), 0.5),
    ],
)
def test_what_a_rotor_has_left_counts_at_the_farthest_place_of_its_planes(
    planes: tuple[float, float], reach: float
) -> None:
    """The larger of the force and the couple over that distance, beside both corrections."""

    def left(force: complex, couple: complex, moment: tuple[float, float] = (0.3, 0.2)) -> float:
        both = np.array(moment)
        return RotorBalance(
            UNKNOWN, "shaft", planes, (0j, 0j), both, both, both, both, "x", (force, couple), UNKNOWN, UNKNOWN
        ).residual

    assert left(0j, 3e-3 + 4e-3j) == pytest.approx(5e-3 / reach / 0.5)
    assert left(-3e-3 + 4e-3j, 1e-4j) == pytest.approx(5e-3 / 0.5)
    assert left(1.0, 1.0, (0.0, 0.0)) == 0.0
    assert left(0j, 1e-3, (0.0, 0.2)) == pytest.approx(1e-3 / reach / 0.2)


FOUR_BAR = {
    "ground": {"points": {"O2": [0, 0], "O4": [0.2, 0]}},
    "crank": {"points": {"O2": [0, 0], "A": [0.05, 0]}, "mass": 1, "center": [0.02, 0], "inertia": 1e-3},
    "coupler": {"points": {"A": [0, 0], "B": [0.2, 0]}, "mass": 2, "center": [0.1, 0.02], "inertia": 1e-2},
    "rocker": {"points": {"O4": [0, 0], "B": [0.12, 0]}, "mass": 1, "center": [0.05, 0], "inertia": 2e-3},
}


@pytest.mark.parametrize("order", [["crank", "coupler", "rocker"], ["rocker", "coupler", "crank"]])
def test_a_missing_counterweight_belongs_on_a_link_with_a_pivot_in_whatever_order_they_are_written(
    order: list[str],
) -> None:
    """One on the coupler would do as well, but not one on the crank alone."""
    pins = {
        "O2": ["ground", "crank"],
        "A": ["crank", "coupler"],
        "B": ["coupler", "rocker"],
        "O4": ["ground", "rocker"],
    }
    m = da.mechanism(
        {
            "links": {name: FOUR_BAR[name] for name in ("ground", *order)},
            "joints": {name: {"type": "pin", "links": links} for name, links in pins.items()},
            "drives": {"O2": {"position": {"from": 0, "to": 330, "count": 12}, "speed": "10 rad/s"}},
            "assembly": {"coupler": "40 deg", "rocker": "90 deg"},
        }
    )
    assert da.balance(m, ["crank"]).missing() == ["rocker"]
    assert da.balance(m, {"crank": {}, "coupler": {"radius": 0.5, "mass": 500}}).complete
    assert da.balance(m, ["rocker"]).missing() == ["crank"]


INCLINED = """
links:
  ground: {points: {O: [0.3, -0.1], C: [%r, %r]}}
  crank: {points: {O: [0, 0], A: [0.05, 0]}, mass: 0}
  rod: {points: {A: [0, 0], B: [0.2, 0]}, mass: 0.4, center: [0.05, 0], inertia: 1e-3}
  piston: {points: {B: [0, 0]}, mass: 0.6}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [C, B], direction: %r}
drives: {O: {position: {from: 10, to: 370, count: 12}, speed: 40 rad/s}}
assembly: {rod: %r, piston: [%r, %r, 0]}
units: {angle: rad}
"""


def inclined(turn: float, aside: float) -> Any:
    """An engine whose cylinder is turned by an angle, and moved aside."""
    u, v = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
    place, guess = np.array([0.3, -0.1]) + aside * v, np.array([0.3, -0.1]) + 0.24 * u + aside * v
    text = INCLINED % (*place.tolist(), turn, turn, *guess.tolist())
    text = text.replace("from: 10, to: 370", f"from: {turn + 0.2!r}, to: {turn + 0.2 + 2 * np.pi!r}")
    return da.dynamics(da.loads(text))


@pytest.mark.parametrize("turn", [0.5, 0.25 * np.pi, 2.2, -2.0])
def test_an_inclined_cylinder_has_the_series_of_a_level_one(turn: float) -> None:
    """Its force is turned with it; a line that misses the crank on either side, by more than rounding, has none."""
    c, s = np.cos(turn), np.sin(turn)
    force = da.engine_series(inclined(turn, 0.0)).force
    level = da.engine_series(inclined(0.0, 0.0)).force
    assert force == pytest.approx(level @ np.array([[c, s], [-s, c]]), abs=1e-9 * np.abs(level).max())
    assert da.engine_series(inclined(turn, 1e-10)).force == pytest.approx(force, abs=1e-6)
    for aside in (4e-10, -4e-10):
        with pytest.raises(da.ModelError, match=r"the line of piston passes the crank by 4e-10 m"):
            da.engine_series(inclined(turn, aside))


@pytest.mark.parametrize(
    ("gaps", "balance", "closure", "said"),
    [
        ([0.0, DOUBT, DOUBT], DOUBT, 2 * DOUBT, ""),
        ([0.0, 2 * DOUBT, DOUBT], DOUBT, 0, "at 0.25 s accelerations"),
        ([3 * DOUBT, DOUBT, 2 * DOUBT], DOUBT, 0, "at 0 s and 1 more accelerations"),
        ([3 * DOUBT, 4 * DOUBT, 2 * DOUBT], DOUBT, 0, "at 0 s and 2 more accelerations"),
        ([0.0, 0.0, 0.0], 1.1 * DOUBT, 0, "the energy balance has a gap of 1e-05 of the largest energy"),
        ([0.0, 0.0, 0.0], 0.0, 2.1 * DOUBT, "the loops are open by up to 2e-05 m or rad"),
    ],
)
def test_a_motion_is_in_doubt_beyond_the_limit_of_its_checks(
    gaps: list[float], balance: float, closure: float, said: str
) -> None:
    """Of loops beside the machine's length, 2 m here."""
    gap, layout = np.array(gaps), SimpleNamespace(length=2.0)
    checks = SimpleNamespace(
        law_gap=gap, law_residual=gap.max(), energy_residual=balance, time=np.array([0.0, 0.25, 0.5])
    )
    checks.closure = closure
    checks.free_result = SimpleNamespace(compiled=SimpleNamespace(layout=layout))
    doubt: Any = MotionChecks.doubt
    found = doubt.fget(checks)
    assert found.startswith(said)
    assert bool(found) is bool(said)


def test_the_gap_of_a_programme_is_relative_to_1_or_to_the_size_of_its_value() -> None:
    """Whichever of both is the greater, and of whichever sign."""
    for primal, dual, gap in (
        (-5, -4, 0.2),
        (-5, -6, 0.2),
        (5, 4, 0.2),
        (0.5, 0.25, 0.25),
        (-0.5, -0.25, 0.25),
    ):
        for sign in (1.0, -1.0):
            assert ConeSolution(np.zeros(1), sign * primal, sign * dual, 0.0).gap == pytest.approx(gap)


CRANK = da.slider_crank(crank=0.05, rod=0.2).with_values(
    {"links.crank.mass": 6.0, "links.crank.center": (0.04, 0.0)}
)


@pytest.mark.parametrize(
    ("bounds", "mass"),
    [
        ({"mass": 0.5}, 0.5),
        ({"mass": 2.0, "moment": 0.05}, 1.0),
        ({"mass": 0.5, "moment": 0.05}, 0.5),
    ],
)
def test_a_counterweight_at_a_place_is_as_heavy_as_mass_and_moment_allow(bounds: Any, mass: float) -> None:
    """50 mm behind the axis of a crank of 6 kg that leans out by 40 mm: it would have to be 4.8 kg at least."""
    b = da.balance(CRANK, {"crank": {"place": (-0.05, 0.0), **bounds}}, positions=12)
    assert b.placed["crank"].mass == pytest.approx(mass, abs=1e-7)
    assert b.placed["crank"].moment == pytest.approx(0.05 * mass, abs=1e-8)
    assert b.residual < 1e-9


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(
    ("low", "high", "found"), [(0.0, 0.1, 0.1), (-0.02, 0.1, 0.1), (-0.1, 0.02, 0.02), (0.05, 0.1, 0.1)]
)
def test_the_moment_of_a_counterweight_ends_at_its_range(
    low: float, high: float, found: float, side: float
) -> None:
    """A crank of 6 kg leans out by 40 mm, on either side: more than 0.1 kg m would be good against it."""
    m = CRANK.with_values({"links.crank.center": (-0.04 * side, 0.0)})
    span = (low, high) if side > 0 else (-high, -low)
    b = da.balance(m, {"crank": {"x": span}}, positions=12)
    p = b.placed["crank"]
    assert p.mass * p.center == pytest.approx([found * side, 0.0], abs=1e-7)


def test_what_needs_no_counterweight_has_none_of_any_number() -> None:
    m = CRANK.with_values({"links.crank.center": (0.0, 0.0), "links.rod.mass": 0.0, "links.piston.mass": 0.0})
    b = da.balance(m, {"crank": {"radius": 0.1, "mass": 5}}, positions=12)
    assert not b.numbers.any()
    assert (b.placed["crank"].mass, b.placed["crank"].moment, b.residual) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("direction", [0, 180])
@pytest.mark.parametrize("crank", [0.0, math.pi])
def test_a_mass_on_a_piston_has_the_force_of_its_acceleration_at_any_single_place(
    crank: float, direction: int
) -> None:
    """-(1 +- r / l) r w^2 in line, for the unit mass; no torque there; and half-way m v a / w."""
    text = INCLINED % (0.3, -0.1, math.radians(direction), math.radians(direction), 0, 0)
    way = math.cos(math.radians(direction))
    text = text.replace("piston: [0, 0, 0]", f"piston: [{0.3 + 0.24 * way}, -0.1, 0]")
    for turned in (crank, crank + 1.0, crank - 1.0):
        place = f"position: {turned + math.radians(direction)!r}"
        r = da.dynamics(da.loads(re.sub(r"position: {.*?}", place, text)))
        columns = mass_columns(r, counterweights(r.mechanism, ["piston"]), np.zeros(3), "O").of
        v, a = (rate[0] * np.array([way, 0.0]) for rate in r.freedom("S", "slide")[1:])
        force = columns["force"].reshape(2, -1)[:, 0]
        assert force == pytest.approx(-a, abs=1e-9)
        assert columns["torque"].ravel()[0] == pytest.approx((v @ a + v[1] * 9.80665) / 40, abs=1e-9)
        if turned == crank:
            assert a[0] == pytest.approx(-way * 0.05 * 1600 * (math.cos(crank) + 0.25), rel=1e-9)


@pytest.mark.parametrize("axis", [1, -1])
def test_a_rotor_turns_about_its_axis_either_way(axis: int) -> None:
    """Two masses at 200 and 700 mm of 900: each plane takes its share by the lever, and at the same angles."""
    text = shaft_with_masses((2, 50, 30, 200), (3, 40, 140, 700)).replace(
        "axis: [0, 0, 1], p", f"axis: [0, 0, {axis}], p"
    )
    b = da.balance_rotor(da.loads(text), (0.1 * axis, 0.8 * axis), (0.05, 0.05))
    u = np.array([0.1 * np.exp(1j * np.radians(30 * axis)), 0.12 * np.exp(1j * np.radians(140 * axis))])
    near, far = u @ [6 / 7, 1 / 7], u @ [1 / 7, 6 / 7]
    assert b.zero == "x"
    assert b.moment == pytest.approx(np.abs([near, far]), rel=1e-9)
    assert np.exp(1j * b.angle) == pytest.approx(-np.array([near, far]) / np.abs([near, far]), rel=1e-9)
    assert b.residual < 1e-12


@pytest.mark.parametrize("axis", [1, -1])
def test_a_link_that_stands_still_is_no_part_of_a_rotor(axis: int) -> None:
    text = shaft_with_masses((2, 50, 30, 200)).replace("axis: [0, 0, 1], p", f"axis: [0, 0, {axis}], p")
    text = text.replace(
        "joints:\n",
        "  still: {points: {S: [0, 0, 0]}, mass: 1}\njoints:\n  still: {type: weld, links: [ground, still], at: S}\n",
    )
    with pytest.raises(da.ModelError, match="still does not turn with shaft"):
        da.balance_rotor(da.loads(text), (0.1, 0.8), (0.05, 0.05))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_gap_of_an_energy_balance_is_a_part_of_the_largest_energy(sign: float) -> None:
    """Gained 0, 3 and lost 2; work 0, 4 of -8 and of 12: 3 too much of 12."""
    kinetic, potential = np.array([1.0, 1.0, 4.0]), sign * np.array([5.0, 5.0, 3.0])
    works = {"F": sign * np.array([0.0, 2.0, -8.0]), "G": np.array([0.0, -2.0 * sign, 12.0 * sign])}
    checks = SimpleNamespace(_energies=(kinetic, potential), works=works, kinetic=kinetic)
    balance: Any = MotionChecks.energy_residual
    left = abs((3 - 2 * sign) - sign * 4)
    assert balance.func(checks) == pytest.approx(left / 12)
    still = SimpleNamespace(
        _energies=(np.zeros(2), np.zeros(2)), works={"F": np.zeros(2)}, kinetic=np.zeros(2)
    )
    assert balance.func(still) == 0.0


@pytest.mark.parametrize(
    ("off", "said"), [(2e-6, "Check failed"), (5e-7, "Check"), (math.nan, "Check failed")]
)
def test_counterweights_that_analysed_again_leave_something_else_are_in_doubt(off: float, said: str) -> None:
    b = da.balance(da.four_bar(), ["crank"], positions=8)
    lines = replace(b, residual=off).text().replace("\n", " ")
    assert re.findall(r"Check\w*(?: failed)?", lines) == [said]
    assert ("do not use these numbers" in lines) == (said == "Check failed")


def test_counterweights_in_a_plane_that_turns_are_refused() -> None:
    """They are pulled outward as well, and no column of the balance has that."""
    tree = da.four_bar().to_tree()
    assert da.balance(da.mechanism(tree), ["crank"], positions=4).residual < 1e-9
    with pytest.raises(da.ModelError, match="in a plane that turns are pulled outward too"):
        da.balance(da.mechanism(tree | {"turning": {"speed": "3 rad/s"}}), ["crank"], positions=4)


def test_an_effort_that_is_given_is_not_balanced_nor_are_counterweights_judged_by_it() -> None:
    """A load is found from it: what counterweights need goes to the load."""
    tree = da.four_bar().to_tree()
    tree["drives"]["O2"]["effort"] = -3
    tree["loads"]["torque"]["value"] = "unknown"
    r = da.dynamics(da.mechanism(tree), positions=5)
    b = da.balance(r, ["crank", "rocker"])
    assert (b.complete, b.residual < 1e-9, list(b.sizes())) == (True, True, ["force", "moment"])
    assert "rms torque" not in b.text()
    assert b.draw().items
    for refused in (
        lambda: da.balance(r, ["crank"], of="torque"),
        lambda: b.trade_off("torque"),
        lambda: da.balance(r, ["crank"], least="rms effort.O2"),
    ):
        with pytest.raises(da.ModelError, match=r"no drive has a torque|'effort.O2' cannot be balanced"):
            refused()


@pytest.mark.parametrize(
    ("made", "drive", "link", "along"),
    [(da.bevel_differential, "right", "left", [0, 0, 1]), (da.scotch_yoke, "O2", "yoke", 90)],
)
def test_a_machine_that_has_no_forces_is_not_balanced(made: Any, drive: str, link: str, along: Any) -> None:
    """The unknown force has no power: no position has accelerations or forces."""
    tree = made().to_tree()
    tree["drives"][drive]["effort"] = 0
    put = {"type": "force", "on": link, "at": "center", "value": "unknown", "direction": along}
    tree["loads"] = {"put": put}
    r = da.dynamics(da.mechanism(tree))
    assert set(r.status) == {"no_balance"}
    with pytest.raises(
        da.AnalysisError, match=r"balancing needs every position; position 1: The unknown put"
    ):
        da.balance(r, [link])


def test_a_torque_of_rounding_is_none_and_nothing_is_left_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside the largest force of the machine times its length, from both sides of the limit."""
    r = da.dynamics(da.four_bar())
    limit = PART * sizes(r)["force"].max() * r.compiled.layout.length
    s = da.shaking(r)
    for size, counts in ((0.99 * limit, False), (1.01 * limit, True)):
        monkeypatch.setattr(type(r), "effort", lambda self, name, x=size: np.full(len(r.status), x))
        assert values_of(s)["torque"].any() == counts
        assert values_of(s)["force"].any()


def test_a_force_of_rounding_is_none_beside_that_of_the_mass_on_the_radius() -> None:
    """The only mass lies on its axis: 8e-34 N beside m L w^2, which it would have on the radius of its link."""
    tree = da.load(bundled.cases()["sp-07-hooke-joint-equal-speeds"]).to_tree()
    tree["links"]["output"]["mass"] = 0.5
    r = da.dynamics(da.mechanism(tree))
    at_rim = 0.5 * r.compiled.layout.length * np.abs(r.twist_array[..., 3:]).max() ** 2  # m L w^2
    assert da.shaking(r).floor("force") == pytest.approx(PART * at_rim)
    b = da.balance(r, ["output"])
    assert (b.residual, b.complete, b.placed["output"].mass) == (0.0, True, 0.0)


def test_loads_of_no_machine_are_no_swaying_couple() -> None:
    """A locomotive at rest, with a place beside the plane for its links and no load."""
    m = da.load(bundled.cases()["bal-3-inside-cylinder-locomotive"])
    still = m.with_values({"drives.O.speed": 0.0, "drives.O.position": [0.0, 1.0]})
    s = da.shaking(da.statics(still))
    assert s.couple is not None
    assert (s.couple.shape, s.couple.any()) == ((2, 2), False)
    assert "Force and moment on the ground are zero." in s.text()
