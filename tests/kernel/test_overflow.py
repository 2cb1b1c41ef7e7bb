"""Wherever a number is not finite there is a status; what would lose a part of itself is not taken for a number."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert import bundled
from dalembert.analysis.batch.batch_result import CODES, first_mark
from tests.tiers import tiers

SPEEDS = [1.0, 1e20, 1e100, 1e153, 1e160, 1e300]


QUICK = [(None, True), ("peak", False), ("norm8", True)]
EACH = [
    (reduce, slopes)
    for reduce in (None, "peak", "mean", "rms", "envelope", "norm8")
    for slopes in (False, True)
]


@pytest.mark.parametrize("how", tiers(QUICK, [how for how in EACH if how not in QUICK]))
def test_no_status_is_ok_beside_what_is_no_number(how: tuple[str | None, bool]) -> None:
    """At speeds at which forces, or only their powers in a reduction, overflow."""
    reduce, derivatives = how
    k = da.compile(
        da.four_bar(),
        vary=["drives.O2.speed"],
        outputs=["effort.O2"],
        reduce=reduce,
        derivatives=derivatives,
        lanes=1,
    )
    r = k(SPEEDS)
    values = r.effort("O2").reshape(len(SPEEDS), -1)
    assert np.isfinite(values[:4]).all()
    assert np.isnan(values[4:]).all()
    status = r.status.reshape(len(SPEEDS), -1)
    assert set(status[:4].ravel()) == {"ok"}
    assert set(status[4:].ravel()) == {"overflow"}
    if derivatives:
        slopes = r.gradient("effort.O2").reshape(len(SPEEDS), -1)
        # nothing but inertia, as without weights, of the square of the speed; its mean over a turn is 0, and rounding
        speed, near = np.array(SPEEDS[1:4])[:, None], {"rel": 1e-9, "abs": 1e-12}
        scaled = values[1:4] / speed**2
        assert scaled == pytest.approx(np.repeat(scaled[:1], 3, axis=0), **near)
        assert slopes[1:4] / speed == pytest.approx(2 * scaled, **near)


@pytest.mark.parametrize("analysis", [da.kinematics, da.statics, da.dynamics])
def test_the_general_executor_says_so_too(analysis: Any) -> None:
    r = analysis(da.four_bar().with_values({"drives.O2.speed": 1e160}))
    assert set(r.status) == {"overflow"}
    assert np.isnan(r.acceleration_array).all()
    assert r.reasons[0] == (
        "The rates or accelerations of crank, coupler, rocker exceed 1.8e308 between 0 deg and 355 deg of O2, the "
        "largest number there is (SI). A speed, mass, length or load, or its unit, is probably wrong by many powers of "
        "ten: correct it."
    )


TOO_LONG = (
    "The joints of crank are more than 1e+150 m apart: the squares of such lengths exceed the range of numbers. A "
    "coordinate, or its unit, is probably wrong by many powers of ten: correct it."
)
CRANK = "links.crank.points.A.0"


@pytest.mark.parametrize("length", [1.01e150, 1e155, -1e155, 1e308])
def test_lengths_whose_squares_overflow(length: float) -> None:
    m = da.four_bar().with_values({CRANK: length})
    for analysis in (da.kinematics, da.statics, da.dynamics, da.solve):
        r = analysis(m)
        assert (set(r.status), set(r.reasons)) == ({"overflow"}, {TOO_LONG})
        assert np.isnan(r.effort("O2")).all()
        assert TOO_LONG[:40] in " ".join(str(r).split())  # it can be printed
    for ask in (lambda: da.mobility(m), lambda: da.compile(m, ["links.coupler.mass"]), lambda: da.page(m)):
        with pytest.raises(da.ModelError, match=r"joints of crank are more than 1e\+150 m apart"):
            ask()


def test_lengths_below_that_are_what_they_are() -> None:
    assert set(da.solve(da.four_bar().with_values({CRANK: 9.9e149})).status) == {"not_assembled"}


def test_lengths_whose_squares_vanish() -> None:
    numbers = {CRANK: 0.1, "links.coupler.points.B.0": 0.3, "links.rocker.points.B.0": 0.25}
    numbers["links.ground.points.O4.0"] = 0.35

    def scaled(by: float) -> da.Mechanism:
        return da.four_bar().with_values({path: by * value for path, value in numbers.items()})

    tiny = da.kinematics(scaled(1e-152))
    assert set(tiny.status) == {"overflow"}
    assert "are less than 1e-150 m apart" in str(tiny.reasons[0])
    for by in (1e-140, 1.0, 1e140):
        assert set(da.kinematics(scaled(by)).status) == {"ok"}


@pytest.mark.parametrize(("length", "status"), [(1e100, "not_assembled"), (1e160, "overflow")])
def test_answers_without_poses_in_space_are_printed(length: float, status: str) -> None:
    m = da.load(bundled.cases()["sp-05-hooke-joint-greatest-acceleration"])
    r = da.solve(m.with_values({"links.ground.points.E.2": length}))
    assert (set(r.status), status in str(r)) == ({status}, True)


def test_a_first_pose_in_space_that_is_too_far_from_the_drawing_is_refused() -> None:
    m = da.load(bundled.cases()["sp-05-hooke-joint-greatest-acceleration"])
    with pytest.raises(
        da.ModelError, match=r"drive 'O' begins at .* deg, and is at 0 as drawn; check the position"
    ):
        da.solve(m.with_values({"drives.O.position": 1e155}))


@pytest.mark.parametrize("reduce", [None, "peak"])
def test_one_design_that_overflows_is_lost_alone(reduce: str | None) -> None:
    k = da.compile(da.four_bar(), vary=[CRANK], outputs=["effort.O2"], reduce=reduce)
    lengths = [0.1, 1e155, np.inf, np.nan, 1e308, 0.11]
    found = k([[v] for v in lengths])
    status = ["ok", "overflow", "failed", "failed", "overflow", "ok"]
    assert [set(np.ravel(of)) for of in found.status] == [{of} for of in status]
    solved = np.isfinite(found.effort("O2")).reshape(len(lengths), -1).all(axis=1)
    assert solved.tolist() == [of == "ok" for of in status]


def test_a_sweep_over_a_length_that_overflows() -> None:
    s = da.sweep(da.four_bar(), {CRANK: [0.1, 1e155]})
    assert set(s.status[0]) == {"ok"}
    assert set(s.status[1]) == {"overflow"}


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan])
def test_a_description_has_no_infinite_numbers(value: float) -> None:
    with pytest.raises(da.ModelError, match=r"links\.crank: item 1 of point 'A': .* is not a finite number"):
        da.four_bar().with_values({CRANK: value})


def test_one_rate_that_overflows_is_enough() -> None:
    block = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"P": [0, 0]}, "mass": 1}},
        "joints": {"s": {"type": "slider", "links": ["ground", "block"], "at": ["O", "P"]}},
        "drives": {"s": {"position": 0, "speed": 1e160}},
    }
    assert da.kinematics(da.mechanism(block)).status == ("overflow",)


def test_forces_that_overflow_where_the_motion_does_not() -> None:
    m = da.four_bar().with_values({"links.coupler.inertia": 1e308})
    r = da.dynamics(m)
    assert set(r.status) == {"overflow"}
    assert str(r.reasons[0]).startswith("The forces of O2, A, B, O4 exceed 1.8e308")
    assert not np.isinf(r.force_array).any()


def test_a_derivative_without_a_value_has_a_status() -> None:
    """The size of a force that is nothing has a corner there: its number is right, it has no slope."""
    m = da.four_bar()
    nothing = {f"links.{n}.{what}": 0.0 for n in m.links if n != "ground" for what in ("mass", "inertia")}
    k = da.compile(
        m.with_values(nothing).model_copy(update={"loads": {}}),
        vary=["links.coupler.mass"],
        outputs=["reaction.A.magnitude"],
        derivatives=True,
        lanes=1,
    )
    r = k([[0.0], [1.0]])
    assert set(r.status[0]) == {"no_derivative"}
    assert (r.magnitude("A")[0] == 0).all()
    assert np.isnan(r.gradient("reaction.A.magnitude")[0]).all()
    assert set(r.status[1]) == {"ok"}
    assert np.isfinite(r.gradient("reaction.A.magnitude")[1]).all()
    assert r.problems()[0][:2] == (0, "no_derivative")


def test_what_has_no_number_marks_a_design_before_what_has() -> None:
    """One position without a number leaves the reduction none, whatever the others are."""
    locked, spring, flow = (CODES.index(s) for s in ("self_locking", "undefined_load", "overflow"))
    marks = np.array([[0, locked, spring], [flow, locked, 0], [0, locked, 0]], np.uint8)
    assert first_mark(marks).tolist() == [spring, flow, locked]


NUMBERS: list[tuple[str, Any]] = [
    ("are complex", np.array([[1 + 1j, 2]])),
    ("are complex", [[1.0, 2j]]),
    ("are text", [["1", "2"]]),
    ("are true and false", [[True, False]]),
    ("are not all numbers", [[None, 1.0]]),
    ("are not all numbers", np.array([[True, 2.0]], object)),
    ("are not all numbers", [[1.0, 2.0], [3.0]]),
    ("are times", np.array([[1, 2]], "m8[s]")),
    ("are too large for the arithmetic", [[10**400, 1]]),
    ("are masked in places", np.ma.masked_array([[1.0, 2.0]], mask=[[False, True]])),
]


@pytest.fixture(scope="module")
def bar() -> Any:
    return da.compile(da.four_bar(), vary=["links.coupler.mass", "links.crank.mass"], lanes=1)


@pytest.mark.parametrize(("what", "given"), NUMBERS)
def test_what_is_no_real_number_is_refused(bar: Any, what: str, given: Any) -> None:
    for name in ("values", "positions"):
        with pytest.raises(da.ModelError) as refusal:
            bar(**{name: given})
        assert str(refusal.value).startswith(f"{name} {what}; give")


def test_numbers_with_units_are_refused(bar: Any) -> None:
    pint = pytest.importorskip("pint")
    with pytest.raises(da.ModelError, match="values carry units; give plain numbers"):
        bar(pint.UnitRegistry().Quantity(np.array([[1.0, 2.0]]), "lb"))


@pytest.mark.parametrize(
    "given", [np.float32([[1, 2]]), [[1, 2]], [[Fraction(1), 2]], np.ma.masked_array([[1.0, 2.0]])]
)
def test_other_real_numbers_are_numbers(bar: Any, given: Any) -> None:
    assert bar(given).effort("O2") == pytest.approx(bar([[1.0, 2.0]]).effort("O2"))


def test_positions_that_do_not_fill_the_drives() -> None:
    with pytest.raises(da.ModelError, match=r"positions of shape \(3,\) do not fit 2 drive"):
        da.compile(da.five_bar(), lanes=1)(positions=[1.0, 2.0, 3.0])


def test_an_error_of_whoever_watches_is_no_error_of_the_device(bar: Any) -> None:
    def watched(done: int, of: int) -> None:
        raise RuntimeError("no more")

    with pytest.raises(RuntimeError, match="no more"):
        bar(progress=watched)
