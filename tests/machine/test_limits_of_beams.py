"""Beams of shafts, loads of bearings, lines of links, and who may have a flywheel, at their limits."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.bearings.bearing_load import BearingLoad
from dalembert.machine.bearings.catalogue import CatalogueBearing, choose
from dalembert.machine.flywheel.turning_moment import _only_drive, _steady_speed
from dalembert.machine.harmonics import harmonics
from dalembert.machine.members.straight_members import _line, straight
from dalembert.machine.shafts.beam_elements import Beam, PointMass, SpreadMass, beam_model
from dalembert.machine.shafts.critical_speeds import _about, _by_the_books, _matrix, _without_spin
from dalembert.model.joints.bearing_keys import Bearing

UNKNOWN: Any = None
BEAM = Beam(
    2.0,
    [(0.5, 7.0), (2.0, 90.0)],
    [0.0, 1.75],
    [],
    [PointMass(0.8, 3.0, 0.2, 0.5), PointMass(1.2, 0.0, 0.1, 0.3)],
    [SpreadMass(0.25, 1.0, 4.0, 0.02, 0.03)],
)


def test_elements_of_a_beam_end_where_something_begins() -> None:
    few = BEAM.nodes(0)
    assert few == pytest.approx([0, 0.25, 0.5, 0.8, 1.0, 1.2, 1.75, 2.0])
    many = BEAM.nodes(8)
    assert {*few.round(9)} <= {*many.round(9)}
    assert np.diff(many).max() <= 0.25 + 1e-12
    assert len(many) == 8 + sum(int(8 * h / 2) for h in np.diff(few))
    clamped = Beam(2.0, [(2.0, 1.0)], [], [0.3, 1.5])
    assert clamped.nodes(0) == pytest.approx([0, 0.3, 1.5, 2])
    assert [BEAM.stiffness_at(s) for s in (0.0, 0.5, 0.51, 2.0, 2.5)] == [7, 7, 90, 90, 90]


def test_a_beam_in_elements_has_its_mass_stiffness_and_supports() -> None:
    """Moved as a whole it has all its mass and no stiffness; tilted as a whole the moment of its mass."""
    model = beam_model(BEAM, 8)
    x, n = model.nodes, 2 * len(model.nodes)
    across, tilt = np.zeros(n), np.zeros(n)
    across[::2] = 1.0
    tilt[::2], tilt[1::2] = x, 1.0
    assert across @ model.carried @ across == pytest.approx(3 + 4 * 0.75)
    assert across @ model.carried @ tilt == pytest.approx(3 * 0.8 + 4 * 0.75 * 0.625)
    spread = 4 * (1.0**3 - 0.25**3) / 3
    assert tilt @ model.carried @ tilt == pytest.approx(3 * 0.64 + spread)
    assert tilt @ model.tilting @ tilt == pytest.approx(-0.3 - 0.2 - 0.01 * 0.75)
    assert np.abs(model.stiffness @ across).max() < 1e-6
    assert np.abs(model.stiffness @ tilt).max() < 1e-6
    held = sorted({*range(n)} - {*model.free.tolist()})
    assert [x[k // 2] for k in held] == pytest.approx([0.0, 1.75])
    assert all(k % 2 == 0 for k in held)
    clamped = beam_model(Beam(2.0, [(2.0, 1.0)], [1.5], [0.0]), 4)
    held = sorted({*range(2 * len(clamped.nodes))} - {*clamped.free.tolist()})
    assert held[:2] == [0, 1]
    assert len(held) == 3


@pytest.mark.parametrize(("place", "force"), [(2.0, 3.0), (0.5, -4.0)])
def test_a_cantilever_of_two_stiffnesses_bends_as_by_hand(place: float, force: float) -> None:
    """The integral of M x over both parts: E I is 7 up to 0.5 m and 90 behind it."""
    beam = Beam(2.0, [(0.5, 7.0), (2.0, 90.0)], [], [0.0], [PointMass(place, 1.0)])
    model = beam_model(beam, 4)
    load = np.zeros(2 * len(model.nodes))
    k = int(np.argmin(np.abs(model.nodes - place)))
    load[2 * k] = force
    found = model.pushed(load)
    first, second = min(0.5, place), place

    def moment(a: float, b: float) -> float:
        return (place - a) ** 3 / 3 - (place - b) ** 3 / 3

    exact = force * (moment(0, first) / 7 + moment(first, second) / 90)
    assert found[2 * k] == pytest.approx(exact)


def test_speeds_by_the_books_add_the_masses_one_by_one() -> None:
    """Dunkerley's of single masses; Rayleigh's by the sag under all weights; without spin nothing is polar."""
    steps = [(2.0, 90.0)]
    points = [PointMass(0.8, 3.0), PointMass(1.5, 5.0), PointMass(1.0, 0.0, 0.5)]
    beam = Beam(2.0, steps, [0.0, 2.0], [], points)
    low, high, sag = _by_the_books(beam_model(beam, 8))

    def flexibility(a: float, b: float) -> float:
        a, b = sorted((a, b))
        return a * (2 - b) * (4 - a**2 - (2 - b) ** 2) / (6 * 90 * 2)

    each = [m * flexibility(a, a) for m, a in ((3, 0.8), (5, 1.5))]
    assert low == pytest.approx(1 / math.sqrt(sum(each)), rel=1e-6)
    y = [9.80665 * (3 * flexibility(a, 0.8) + 5 * flexibility(a, 1.5)) for a in (0.8, 1.5)]
    exact = math.sqrt(9.80665 * (3 * y[0] + 5 * y[1]) / (3 * y[0] ** 2 + 5 * y[1] ** 2))
    assert high == pytest.approx(exact, rel=1e-6)
    assert sag.min() < 0
    assert -sag.max() == pytest.approx(0, abs=1e-12)
    still = _without_spin(BEAM)
    assert [p.polar for p in (*still.points, *still.spread)] == [0, 0, 0]  # type: ignore[attr-defined]
    assert [p.diametral for p in (*still.points, *still.spread)] == [0.2, 0.1, 0.02]  # type: ignore[attr-defined]
    with_line = Beam(2.0, steps, [0.0, 2.0], [], [], [SpreadMass(0.0, 2.0, 4.0)])
    low, high, _ = _by_the_books(beam_model(with_line, 16))
    even = math.pi**2 / 4 * math.sqrt(90 / 4)
    assert low == pytest.approx(even, rel=1e-5)
    assert high == pytest.approx(even, rel=2e-3)
    none = Beam(2.0, steps, [0.0, 2.0], [], [PointMass(0.8, 0.0)])
    assert _by_the_books(beam_model(none, 4))[:2] == (math.inf, math.inf)


def test_inertia_about_a_shaft_is_that_of_its_line() -> None:
    e = straight(("A", "B"), np.zeros(3), np.array([0, 3.0, 0]))
    assert _about(np.diag([2.0, 7, 5]), e) == (3.5, 7.0)
    assert _matrix(4.0).tolist() == np.diag([4.0] * 3).tolist()
    assert _matrix([1.0, 2, 3]).tolist() == np.diag([1.0, 2, 3]).tolist()
    assert _matrix(np.ones((3, 3))).tolist() == [[1.0] * 3] * 3


def load(
    radial: Any, rate: Any, bearing: Any = None, axial: Any = 0.0, couple: Any = 0.0, time: Any = 1.0
) -> BearingLoad:
    count = len(radial)
    r: Any = SimpleNamespace(compiled=SimpleNamespace(layout=SimpleNamespace(length=0.5)))
    rows = (np.broadcast_to(np.array(x, float), count) for x in (radial, axial, couple, rate, time))
    return BearingLoad(r, "A", bearing, *rows)


def test_a_bearing_of_steady_numbers_has_their_life() -> None:
    b = load([300.0, 500], [4.0, -2], Bearing(rating=12e3, static_rating=6e3), time=[1.0, 3.0])
    turned = np.array([4.0, 6.0])
    mean = ((np.array([300.0, 500]) ** 3 * turned).sum() / 10) ** (1 / 3)
    assert b.equivalent == pytest.approx(mean)
    assert b.speed == pytest.approx(2.5)
    assert b.turns == pytest.approx(1e6 * (12e3 / mean) ** 3)
    assert b.hours == pytest.approx(b.turns * 2 * math.pi / 2.5 / 3600)
    assert b.static_safety == 12.0
    assert b.swings
    assert not load([300.0, 500], [4.0, 0.0]).swings
    assert not load([300.0, 500], [-4.0, 0.0]).swings
    rollers = load([300.0, 500], [4.0, -2], Bearing(rating=12e3, kind="roller"), time=[1.0, 3.0])
    assert rollers.exponent == pytest.approx(10 / 3)
    assert rollers.static_safety is None
    assert load([1.0], [1.0]).exponent == 3.0
    wanted = b.rating_for(5000.0, 1.2)
    assert wanted == pytest.approx(1.2 * mean * (5000 * 3600 * 2.5 / 2 / math.pi / 1e6) ** (1 / 3))


def test_a_bearing_without_load_or_turn_has_no_end_or_no_number() -> None:
    full = Bearing(rating=12e3, static_rating=6e3)
    none = load([0.0, 0.0], [4.0, -2], full)
    assert (none.equivalent, none.turns, none.hours, none.static_safety) == (
        0.0,
        math.inf,
        math.inf,
        math.inf,
    )
    still = load([3.0, 5.0], [0.0, 0.0], full)
    assert math.isnan(still.equivalent)
    assert still.hours == math.inf
    assert load([0.0, 0.0], [0.0, 0.0], full).equivalent == 0.0


@pytest.mark.parametrize(("part", "thrust"), [(0.9e-9, False), (1.1e-9, True)])
def test_a_thrust_counts_beyond_rounding_where_no_factor_is_given(part: float, thrust: bool) -> None:
    b = load([300.0, 500], [4.0, 2], axial=[0.0, 500 * part])
    assert bool(np.isnan(b.load).all()) is thrust
    factors = Bearing(rating=1.0, radial_factor=0.56, axial_factor=1.5)
    given = load([300.0, 500], [4.0, 2], factors, axial=[100.0, 20.0])
    assert given.load == pytest.approx([0.56 * 300 + 150, 500])
    tilted = load([300.0, 500], [4.0, 2], couple=[0.0, 250 * part])
    assert tilted.tilting == (pytest.approx(250 * part) if thrust else 0.0)


def test_the_smallest_row_that_is_enough_is_chosen_by_bore_then_by_rating() -> None:
    b = load([500.0], [4.0], Bearing(diameter="20 mm", length="10 mm", rating=1.0))
    need = b.rating_for(1000.0, 1.5)
    rows = [
        CatalogueBearing("small", 9 * need, 9e9, 0.0199),
        CatalogueBearing("weak", 0.999 * need, 9e9, 0.02),
        CatalogueBearing("soft", 9 * need, 0.999 * 2 * 1.5 * 500, 0.02),
        CatalogueBearing("strong", 9 * need, 9e9, 0.02),
        CatalogueBearing("just", need, 2 * 1.5 * 500, 0.02 * (1 - 0.9e-9)),
        CatalogueBearing("lighter", 2 * need, 9e9, 0.025),
    ]
    assert choose(b, rows, 1000.0, 1.5, 2.0) == rows[4]
    assert choose(b, rows[:4] + rows[5:], 1000.0, 1.5, 2.0) == rows[3]
    assert 2 * need == choose(b, [rows[3], rows[3]._replace(name="less", C=2 * need)], 1000.0, 1.5, 2.0).C  # type: ignore[union-attr]
    assert choose(b, rows[:3], 1000.0, 1.5, 2.0) is None


def link(points: dict[str, Any]) -> Any:
    m: Any = SimpleNamespace(links={"ground": None, "rod": None}, points=lambda name: points)
    return m


def test_a_member_of_a_line_of_joints_begins_at_the_first_of_its_named_points() -> None:
    """Of one named point, or none, at the first joint."""
    low, high = np.array([0.5, 0.0, 0.0]), np.array([2.0, 0.0, 0.0])
    for joints in ([low, high], [high, low]):
        one = _line(link({"A": (2.0, 0.0)}), "rod", np.array(joints))
        assert one.start.tolist() == pytest.approx(joints[0].tolist())
        assert one.ends == (("A", "end") if joints[0] is high else ("start", "A"))
        two = _line(link({"B": (2.0, 0.0), "A": (-1.0, 0.0)}), "rod", np.array(joints))
        assert (two.ends, two.length) == (("B", "A"), pytest.approx(3.0))  # type: ignore[comparison-overlap]
        aside = _line(link({"A": (-9.0, 1.0)}), "rod", np.array(joints))
        assert (aside.ends, aside.length) == (("start", "end"), pytest.approx(1.5))  # type: ignore[comparison-overlap]
    with pytest.raises(da.ModelError, match="has no length: its points are none"):
        _line(link({}), "rod", np.zeros((2, 3)))


def turning(speed: Any, acceleration: Any = 0.0, drives: Any = ("O",), turns: bool = True) -> Any:
    speed = np.array(speed, float)
    return SimpleNamespace(
        drives=drives, unknown_loads=(), drive_speed=lambda name: speed,
        drive_acceleration=lambda name: np.broadcast_to(acceleration, speed.shape),
        compiled=SimpleNamespace(known=SimpleNamespace(requested=np.ones(1, bool))),
        mechanism=SimpleNamespace(drives={n: SimpleNamespace(turns=turns) for n in drives}),
    )  # fmt: skip


def test_a_flywheel_is_that_of_one_drive_that_turns_steadily() -> None:
    assert _only_drive(turning([3.0]), None) == _only_drive(turning([3.0]), "O") == "O"
    for r, drive, said in (
        (turning([3.0]), "P", "unknown drive 'P'"),
        (turning([3.0], drives=("O", "P")), None, "needs a machine with one drive"),
        (turning([3.0], turns=False), None, "drive 'O' slides, and a flywheel turns"),
    ):
        with pytest.raises(da.ModelError, match=said):
            _only_drive(r, drive)
    assert _steady_speed(turning([-3.0, -3.0]), "O") == -3.0
    for wrong in (
        turning([0.0, 0.0]),
        turning([3.0, 3.1]),
        turning([3.0, 3.0], 0.1),
        turning([3.0, 3.0], -0.1),
    ):
        with pytest.raises(da.ModelError, match="does not turn at constant speed"):
            _steady_speed(wrong, "O")


def test_parts_of_a_vector_turn_with_the_drive_or_against_it() -> None:
    """3 e^(i(q + 0.4)) + 2 e^(-i(q - 0.7)) + (1 - 2i): each its own coefficient."""
    q = np.arange(12) * math.pi / 6
    z = 3 * np.exp(1j * (q + 0.4)) + 2 * np.exp(-1j * (q - 0.7)) + 1 - 2j
    found = harmonics(np.stack([z.real, z.imag], axis=1), q, 2)
    assert found.forward == pytest.approx([1 - 2j, 3 * np.exp(0.4j), 0])
    assert found.backward == pytest.approx([0, 2 * np.exp(0.7j), 0])
    assert found.amplitude[0] == pytest.approx([1, 2])
    with pytest.raises(da.ModelError, match="only a vector in the plane has parts that turn"):
        _ = harmonics(z.real, q, 2).forward
    with pytest.raises(da.ModelError, match="11 values are given for 12 positions"):
        harmonics(z.real[1:], q, 2)
    with pytest.raises(da.ModelError, match="position 3 has no value"):
        harmonics(np.where(np.arange(12) >= 2, np.nan, 1.0), q, 2)


ROD_IN_TWO = """
links:
  ground: {points: {O: [0, 0], D: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  rod: {points: {A: [0, 0], S: [0.15, 0]}, mass: 2, center: [0.075, 0], SECTION}
  end: {points: {S: [0, 0], B: [0.25, 0]}, mass: 3, center: [0.125, 0], SECTION}
  ram: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  S: {type: weld, links: [rod, end]}
  B: {type: pin, links: [end, ram]}
  D: {type: slider, links: [ground, ram], at: [D, B]}
drives: {D: {position: POSITIONS}}
""".replace("SECTION", "mass_along: uniform, section: {circle: 20 mm, elasticity: 210 GPa}")


def test_a_shaft_is_as_long_whichever_positions_close() -> None:
    """Its pieces are placed at the first position that has a pose; without any there is nothing to say."""

    def answered(positions: str) -> da.Result:
        return da.statics(da.loads(ROD_IN_TWO.replace("POSITIONS", positions)))

    closed, late, never = (answered(x) for x in ("[0.45]", "[0.7, 0.45]", "[0.7, 0.8]"))
    assert late.status == ("not_assembled", closed.status[0])
    speeds = da.critical_speeds(closed, "end").speeds
    assert da.critical_speeds(late, "end").speeds == pytest.approx(speeds)
    assert da.critical_speeds(late, "rod").supports == pytest.approx({"A": 0.0, "B": 0.4})
    with pytest.raises(da.ModelError, match="no position has a pose of link 'rod'; see the reasons"):
        da.critical_speeds(never, "rod")
    for name in ("rod", "end"):
        assert np.isnan(never[f"bearing_slope.{name}"]).all()
        assert np.isnan(late[f"bearing_slope.{name}"]).tolist() == [True, False]
