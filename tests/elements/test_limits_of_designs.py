"""Governors, springs of followers, contacts, brakes and clearances at their limits, by formulas in the hand."""

from __future__ import annotations

import math
import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.elements import cam_files, follower_spring
from dalembert.machine.elements.brake_heat import BrakeHeat
from dalembert.machine.elements.cam_files import outline
from dalembert.machine.elements.follower_spring import spring_for
from dalembert.machine.elements.governors import Governor, _isochronous
from dalembert.machine.elements.turning_equilibria import _extrapolated
from tests.elements.test_cams import machine as cam_machine
from tests.elements.test_governors import PORTER
from tests.elements.test_pins import hung

UNKNOWN: Any = None


def governor(speed: Any, height: Any, interval: Any = None, stable: Any = None) -> Governor:
    """A governor of speeds at heights; of its forces only that at the sleeve and the pull are told."""
    speed, height = np.array(speed, float), np.array(height, float)
    ends = np.stack([speed, speed], axis=1) if interval is None else np.array(interval, float)
    force, pull = 100.0 + 10 * np.arange(len(speed)), 500.0 + 0 * speed
    holds = np.ones(len(speed), bool) if stable is None else np.array(stable)
    return Governor(UNKNOWN, "O", "S", height, height, speed, ends, force, holds, (), pull)


def test_every_number_of_a_governor_is_that_of_its_formula() -> None:
    g = governor([20, 22, 25], [0.1, 0.15, 0.18], [[19, 21], [21, np.nan], [24, 26.5]])
    assert g.sensitiveness == pytest.approx(5 / 22.5)
    assert g.range_with_friction == (19, 26.5)
    assert g.lift == pytest.approx(0.08)
    for change, given in ((0.01, {}), (0.04, {"change": 0.04})):
        assert g.effort(**given) == pytest.approx(g.sleeve_force * ((1 + change) ** 2 - 1) / 2)
        assert g.book_effort(**given) == pytest.approx(g.sleeve_force * change)
        high = 2 * g.sleeve_force / 500  # of equal arms
        assert g.book_power(**given) == pytest.approx(
            4 * change**2 / (1 + 2 * change) * g.sleeve_force * high
        )
        lift = [change * 20 / 2 * 0.05, change * 22 / 3 * 0.03, np.nan]
        np.testing.assert_allclose(g.lift_for(**given), lift, rtol=1e-9)
        np.testing.assert_allclose(g.power(**given), g.effort(**given) * lift, rtol=1e-9)


def test_the_lift_of_a_governor_ends_with_its_range_and_is_that_of_stable_places() -> None:
    """A speed that falls over the height is no less known; at an end of the range the lift is all that is left."""
    falling = governor([25, 20], [0.1, 0.2], stable=[True, False])
    np.testing.assert_allclose(falling.lift_for(0.01), [np.nan, np.nan])
    np.testing.assert_allclose(falling.lift_for(-0.2), [0.1, np.nan])
    np.testing.assert_allclose(falling.lift_for(-0.1), [0.05, np.nan])
    up = governor([20, 25], [0.1, 0.2])
    np.testing.assert_allclose(up.lift_for(0.25), [0.1, np.nan])
    np.testing.assert_allclose(up.lift_for(0.2500001), [np.nan, np.nan])
    np.testing.assert_allclose(up.lift_for(0.0), [0.0, 0.0])
    np.testing.assert_allclose(up.lift_for(-0.2), [np.nan, 0.1])


def test_differences_with_steps_that_halve_leave_no_term_below_the_eighth_power() -> None:
    for power, left in ((2, 0.0), (4, 0.0), (6, 0.0)):
        rows = [3.0 + 7 * (0.4 / 2**k) ** power for k in range(4)]
        assert _extrapolated(rows) == pytest.approx(3.0 + left, abs=1e-12)
    rows = [3.0 + (1 / 2**k) ** 8 for k in range(4)]
    assert abs(_extrapolated(rows) - 3.0) == pytest.approx(2.0**-12, rel=1e-9)


@pytest.mark.parametrize(
    ("needed", "per_unit", "lift", "preload", "found"),
    [
        # P + k s >= 10 on the base circle, 30 at the highest place
        ([10, 20, 30], [1, 1, 1], [0, 0.01, 0.02], 10.0, (1000, 10)),
        ([10, 20, 30], [1, 1, 1], [0, 0.01, 0.02], 20.0, (500, 20)),
        ([10, 20, 30], [1, 1, 1], [0, 0.01, 0.02], 40.0, (0, 40)),
        ([20, 40, 60], [2, 2, 2], [0, 0.01, 0.02], 10.0, (1000, 10)),
        ([10, 25, 30], [1, 1, 1], [0, 0.01, 0.02], 10.0, (1500, 10)),
        ([10, 25, 30], [1, 1, 1], [1e-11, 0.01, 0.02], 10.0, (1500, 10)),
        ([10, 25, 30], [1, 1, 1], [1e-6, 0.01, 0.02], 9.9, (1e5, 9.9)),
        ([-5, -4, -1], [1, 1, 1], [0, 0.01, 0.02], 0.0, (0, 0)),
    ],
)
def test_the_spring_of_a_follower_is_the_least_that_keeps_it_on(
    needed: Any, per_unit: Any, lift: Any, preload: float, found: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = tuple(np.array(x, float) for x in (needed, per_unit, lift))
    monkeypatch.setattr(follower_spring, "_linear", lambda c, least: told)
    assert spring_for(UNKNOWN, preload, 0.0) == pytest.approx(found, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("needed", "greatest"), [([10, 20, 30], 30), ([10, 45, 30], 45), ([10, 5, -3], 10), ([-5, -4, -1], 0)]
)
def test_the_softest_spring_has_the_force_of_the_place_that_needs_most(
    needed: Any, greatest: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    need, lift = np.array(needed, float), np.array([0, 0.01, 0.02])
    monkeypatch.setattr(follower_spring, "_linear", lambda c, least: (2 * need, 2 + 0 * need, lift))
    stiffness, preload = spring_for(UNKNOWN, None, 0.0)
    assert preload + 0.02 * stiffness == pytest.approx(greatest, abs=1e-9)
    assert (preload + stiffness * lift >= need - 1e-9).all()
    assert min(stiffness, preload) >= 0


@pytest.mark.parametrize(
    ("per_unit", "lift", "preload", "said"),
    [
        ([1, 0, 1], [0, 0.01, 0.02], 50.0, "no spring closes the cam"),
        ([1, 1, -1], [0, 0.01, 0.02], 50.0, "no spring closes the cam"),
        ([1, 1, 1], [0, 0.01, 0.02], 10 * (1 - 1e-11), "does not close the cam at rest, which needs 10"),
        ([1, 1, 1], [1e-11, 0.01, 0.02], 9.9, "the preload 9.9 does not close the cam at rest"),
    ],
)
def test_a_spring_that_does_not_close_its_cam_is_refused(
    per_unit: Any, lift: Any, preload: float, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = tuple(np.array(x, float) for x in ([10, 20, 30], per_unit, lift))
    monkeypatch.setattr(follower_spring, "_linear", lambda c, least: told)
    with pytest.raises(da.ModelError, match=said):
        spring_for(UNKNOWN, preload, 0.0)
    if preload < 10 and preload > 9.95:
        assert spring_for(UNKNOWN, 10 * (1 - 1e-13), 0.0)[0] == pytest.approx(1000)


def test_line_contacts_at_their_limits() -> None:
    """No force has no width; a hollow contact is one as long as it is wider than what lies in it."""
    none = da.hertz_line(0.0, 0.01, (0.02, 0.03))
    assert (none.half_width, none.pressure) == (0.0, 0.0)
    stiff = 206e9 / (2 * (1 - 0.09))
    for radii in ((0.02, math.inf), (math.inf, 0.02), (0.04, 0.04), (0.01, -0.02)):
        x = da.hertz_line(500.0, 0.01, radii)
        assert x.half_width == pytest.approx(math.sqrt(4 * 500 * 0.02 / (math.pi * 0.01 * stiff)))
        assert x.pressure == pytest.approx(2 * 500 / (math.pi * x.half_width * 0.01))
    near = da.hertz_line(500.0, 0.01, (0.02, -0.02000001))
    assert near.half_width > 100 * x.half_width
    for radii in ((0.02, -0.02), (0.02, -0.0199), (math.inf, math.inf), (math.inf, -0.1)):
        with pytest.raises(da.ModelError, match="hollow and not wider than what lies in it"):
            da.hertz_line(500.0, 0.01, radii)
    for wrong in ((-1e-9, 0.01), (500.0, 0.0), (500.0, -1e-9)):
        with pytest.raises(da.ModelError, match="must be positive"):
            da.hertz_line(*wrong, (0.02, 0.03))
    for moduli in ((0.0, 206e9), (206e9, -1.0)):
        with pytest.raises(da.ModelError, match="must be positive"):
            da.hertz_line(500.0, 0.01, (0.02, 0.03), moduli)
    one, two = da.hertz_line(500.0, 0.01, (0.02, 0.03), (206e9, 70e9), (0.3, 0.33)), 1 / 0.02 + 1 / 0.03
    both = 1 / ((1 - 0.09) / 206e9 + (1 - 0.33**2) / 70e9)
    assert one.pressure == pytest.approx(math.sqrt(500 * both * two / (math.pi * 0.01)))


class _Braked(BrakeHeat):
    """A motion of two joints, one of them a brake, whose dry losses are told."""

    def __init__(self, lost: dict[str, list[float]], work: float | None, part: Any) -> None:
        self.lost, self.part = lost, part
        self.works = {} if work is None else {"friction": np.array([0.0, work])}

    @property
    def time(self) -> Any:
        return np.array([0.0, 1.0, 3.0])

    @property
    def result(self) -> Any:
        parts = {"B": self.part, "P": SimpleNamespace(BRAKES=False)}
        return SimpleNamespace(
            mechanism=SimpleNamespace(joints=parts),
            joints=["B", "P"],
            power_lost=lambda name, kind: np.array(self.lost[name]),
        )


def test_the_heat_of_a_brake_is_its_share_of_the_work_of_friction() -> None:
    part = SimpleNamespace(BRAKES=True, heat=SimpleNamespace(per_kelvin=50.0), lining_area=0.02)
    lost = {"B": [2.0, 4.0, 0.0], "P": [1.0, np.nan, 1.0]}  # 3 + 4, and 1/2 + 1 J
    heat = _Braked(lost, -17.0, part).heat["B"]
    assert (heat.energy, heat.rise, heat.per_area) == pytest.approx((14.0, 0.28, 700.0))
    bare = _Braked(lost, -17.0, SimpleNamespace(BRAKES=True, heat=None, lining_area=None)).heat["B"]
    assert bare.energy == pytest.approx(14.0)
    assert math.isnan(bare.rise)
    assert math.isnan(bare.per_area)
    still = _Braked({"B": [0.0] * 3, "P": [0.0] * 3}, -1e-20, part).heat["B"]
    assert (still.energy, still.rise) == (0.0, 0.0)
    assert _Braked(lost, None, part).heat["B"].energy == 0.0
    small = {"B": [1e-3, 1e-3, 1e-3], "P": [0.0] * 3}
    assert _Braked(small, -3e-3, part).heat["B"].energy == pytest.approx(3e-3)
    assert _Braked(lost, -17.0, SimpleNamespace(BRAKES=False)).heat == {}


def porter(offset: float, *angles: float) -> da.Mechanism:
    """The Porter governor of the book, its lower arms so far off the axis: angles of O at both ends, first angles."""
    low, high, upper, lower = angles
    text = PORTER.replace("C: [1.5, 0]", f"C: [{offset}, 0]")
    text = re.sub(r"position: .*?]", f"position: [{low}, {high}]", text)
    return da.loads(re.sub("upper: -48, lower: -120", f"upper: {upper}, lower: {lower}", text))


def test_a_governor_on_the_other_side_of_its_axis_is_the_same() -> None:
    """Its ball is as far from the axis, and as fast, and pulls as much."""
    here, there = (
        da.governor(porter(*numbers), count=25)
        for numbers in ((1.5, -50, -30, -48, -120), (-1.5, -130, -150, -132, -60))
    )
    for name in ("speed", "height", "radius", "sleeve_force", "pull", "stable"):
        assert getattr(there, name) == pytest.approx(getattr(here, name), rel=1e-9)
    assert here.radius == pytest.approx(12 * 0.0254 * np.cos(np.radians(np.linspace(-50, -30, 25))))
    assert here.pull == pytest.approx(15 * 0.45359237 * here.speed**2)
    assert there.lift_for(0.02) == pytest.approx(here.lift_for(0.02), rel=1e-9, nan_ok=True)


def test_the_rows_of_a_governor_follow_its_range() -> None:
    table: Any = next(
        x for x in da.governor(porter(1.5, -50, -30, -48, -120)).contents() if not isinstance(x, str)
    )
    places = [float(row[0]) for row in table.rows]
    assert places == sorted(places)
    assert (len(places), places[0], places[-1]) == (12, -50, -30)


def test_speeds_that_stay_have_no_extreme() -> None:
    """Neither where they begin nor where they go on."""
    places = np.arange(5.0)
    for speed in ([1, 1, 2, 3, 4], [1, 2, 2, 3, 4], [5, 4, 4, 4, 3], [2, 2, 2, 2, 2]):
        assert _isochronous(UNKNOWN, "O", places, np.array(speed, float)) == ()


@pytest.mark.parametrize(("repeated", "tried"), [(["hook"], True), (["hook", "hook"], False)])
def test_orders_of_a_bolt_are_tried_up_to_six_layers(repeated: list[str], tried: bool) -> None:
    stack = ["left", "right", "hook", *repeated, "right", "left"]
    size = {"diameter": "20 mm", "stack": stack, "layers": [0.01 * k for k in range(len(stack))]}
    x = da.pin(da.statics(hung(size)), "A")
    assert (x.best != ()) is tried
    assert sorted(x.best) == (sorted(stack) if tried else [])
    assert x.force == pytest.approx(x.planes.max(axis=1), rel=1e-12)
    assert x.planes.min() < 0.9 * x.planes.max()
    assert x.shear == pytest.approx(x.planes.max(axis=1) / (math.pi * 0.01**2), rel=1e-12)


def test_the_places_of_an_outline_may_just_be_as_many(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first even ones, where a chord is off by more than nine tenths of the tolerance halved once more."""
    c = da.cam(da.mechanism(cam_machine({"roller": "8 mm"})), "F")
    turns = c.motion.turns(181)
    at, middle = c.profile(turns), c.profile((turns[1:] + turns[:-1]) / 2)
    off = float(np.hypot(*(middle - (at[1:] + at[:-1]) / 2).T).max())
    assert len(outline(c, off / 0.9 * 1.001)) == len(turns) - 1
    finer = off / 0.9 * 0.999
    monkeypatch.setattr(cam_files, "MOST", len(turns))
    assert len(outline(c, finer)) >= len(turns)
    monkeypatch.setattr(cam_files, "MOST", len(turns) - 1)
    with pytest.raises(da.ModelError, match=f"needs more than {len(turns) - 1} points"):
        outline(c, finer)
