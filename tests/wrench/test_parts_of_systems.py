"""Names, kinds and places that parts of force systems keep, and every limit of what counts as nothing."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import AnalysisError, ModelError
from dalembert.units import Units
from dalembert.wrench import Axis, Couple, Force, System, parallel_center
from dalembert.wrench.balance_check import balance, list_components
from dalembert.wrench.reading import cosines, direction, number, vector
from dalembert.wrench.system_files import Moment, ToAxes, VectorForm


def test_every_way_to_make_a_force_keeps_its_name_and_its_kind() -> None:
    mm = {"length": "mm", "force": "kN"}
    along = Force.along(3, [10, 20, 30], [40, 60, 30], "P", mm, "weight")
    assert (along.name, along.kind) == ("P", "weight")
    assert along.at == pytest.approx([0.01, 0.02, 0.03])
    assert along.vector == pytest.approx([1800, 2400, 0])
    directed = Force.directed(3, [2, -1, 2], [10, 20, 30], "Q", mm, "effort")
    assert (directed.name, directed.kind) == ("Q", "effort")
    assert directed.vector == pytest.approx([2000, -1000, 2000])
    assert directed.at == pytest.approx([0.01, 0.02, 0.03])
    angles = Force.by_angles(3, ["60 deg", "45 deg", "120 deg"], [10, 20, 30], "R", mm)
    assert (angles.name, angles.kind) == ("R", "load")
    assert angles.vector == pytest.approx([1500, 1500 * math.sqrt(2), -1500])
    assert angles.at == pytest.approx([0.01, 0.02, 0.03])
    raised = Force.by_elevation(3, "30 deg", "60 deg", [10, 20, 30], "S", mm)
    assert raised.vector == pytest.approx([750 * math.sqrt(3), 750, 1500 * math.sqrt(3)])
    assert (raised.name, raised.at[2]) == ("S", pytest.approx(0.03))
    assert np.degrees(angles.angles) == pytest.approx([60, 45, 120])


def test_a_moved_force_and_its_couple_keep_name_and_kind() -> None:
    f = Force([3, -4], at=[5, 2], name="P", kind="joint")
    force, couple = f.moved([1, 7])
    assert (force.name, force.kind, force.at.tolist()) == ("P", "joint", [1, 7])
    assert (couple.name, couple.kind, couple.moment) == ("P", "joint", 4 * -4 - -5 * 3)
    back = -f
    assert (back.vector.tolist(), back.at.tolist(), back.name, back.kind) == ([-3, 4], [5, 2], "P", "joint")
    c = -Couple([1, 2, -3], "M", "effort")
    assert (c.vector.tolist(), c.name, c.kind, c.dimension) == ([-1, -2, 3], "M", "effort", 3)
    assert c.size == pytest.approx(math.sqrt(14))
    assert Couple.of_forces(f, [1, 7], "pair").name == "pair"
    assert Couple.of_forces(f, [1, 7]).moment == -1.0
    assert (Couple(-2.5).dimension, Couple([-2.5]).moment, Couple(-2.5).size) == (2, -2.5, 2.5)
    assert Couple("[1 N*m, 2 kN*m, 3 N*mm]").vector == pytest.approx([1, 2000, 0.003])
    assert Couple([2], units={"force": "kN", "length": "mm"}).moment == pytest.approx(2.0)
    assert (f.moment(), f.moment([1, 1])) == (-26, -19)
    assert f.arm([0, 0]) == pytest.approx(5.2)
    assert f.projection("90 deg") == pytest.approx(-4)
    assert f.angle == pytest.approx(math.atan2(-4, 3))
    assert f.line.foot([5, 2]) == pytest.approx([5, 2])


def test_parts_without_a_name_are_numbered_by_their_letter() -> None:
    s = System(Force([1, 2]), Couple(3), Force([3, 4], name="P"), Force([5, 6]), Couple(4, "T"), Couple(5))
    assert s.names == ("F1", "M1", "P", "F3", "T", "M3")
    assert [type(part).__name__ for part in s] == ["Force", "Couple", "Force", "Force", "Couple", "Couple"]
    assert (len(s.forces), len(s.couples), len(s)) == (3, 3, 6)
    assert s["P"] is s.parts[2]
    both = s + System(Couple(7, "U")) + Force([1, 1], name="Q")
    assert both.names[-2:] == ("U", "Q")
    assert (-s).resultant.tolist() == [-9, -12]
    assert (-s).moment() == -12.0
    with pytest.raises(ModelError, match="the system has no part 'W'; choose among P, T"):
        s["W"]


def test_a_changed_system_keeps_title_units_and_points() -> None:
    s = System(
        Force([3, 4], at=[1, 2]), title="bar", source="book", units={"length": "mm"}, points={"A": [1, 2]}
    )
    for other in (-s, s + Couple(2), s.seen("A", "front")):
        assert (other.title, other.source, other.units.length) == ("bar", "book", "mm")
        assert other.point("A").tolist() == [1, 2]
    assert (s.seen("A", "front").about, s.seen("A", "front").camera) == ("A", "front")
    assert (s.about, s.camera) == (None, "isometric")
    assert s.point("[1000, 2000]").tolist() == [1, 2]  # a text is in the system's units
    assert s.point([1000, 2000]).tolist() == [1000, 2000]
    assert (s.point_name("A"), s.point_name([1, 2]), s.point_name([1, 3])) == ("A", "A", "O")
    assert s.point_name([0, 0], "A") == "O"
    assert s.point_name([0, 0], "O", "O") == "P"
    assert s.point_name([0, 0], "B", "C") == "B"
    with pytest.raises(ModelError, match="the system has no point 'B'"):
        s.point("B")


def test_the_middle_and_the_length_are_of_the_points_of_application() -> None:
    s = System(Force([1, 2], at=[0, 0]), Force([3, 4], at=[6, 1]), Force([3, 4], at=[3, -7]), Couple(9))
    assert s.middle == pytest.approx([3, -2])
    assert s.length == pytest.approx(10)
    alone = System(Couple([1, 2, 3]))
    assert (alone.middle.tolist(), alone.length) == ([0, 0, 0], 0.0)
    assert alone.scales() == pytest.approx((0.0, 14**0.5))
    assert alone.kind() == "couple"
    assert alone.moment([7, 8, 9]).tolist() == [1, 2, 3]


@pytest.mark.parametrize(
    ("force", "moment", "holds", "said"),
    [
        ([0.0, 2.0], [3.0], True, "In equilibrium: 0.5 of the largest force is left."),
        ([0.0, 2.1], [3.0], False, "the moments about the middle balance, the forces do not"),
        ([0.0, 2.0], [-3.1], False, "the forces balance, the moments do not"),
        ([1.5, -2.0], [-3.1], False, "neither forces nor moments balance"),
    ],
)
def test_what_balances_is_told_by_the_parts_of_the_largest(
    force: list[float], moment: list[float], holds: bool, said: str
) -> None:
    """A half is allowed: of the largest force, 4 N, and of the largest moment, 6 N m."""
    missing = () if holds else (Couple(1.5),)
    at = np.array([1.0, 2.0])
    sums = balance((np.array(force), np.array(moment)), at, (4.0, 6.0), 0.5, missing, Units())
    assert sums.holds is holds
    assert sums.residual == pytest.approx(max(math.hypot(*force) / 4, abs(moment[0]) / 6))
    more = "" if holds else "Not in equilibrium: "
    end = "" if holds else ". A couple of 1.5 N*m is missing."
    assert sums.sentence == f"{more}{said}{end}"
    assert (sums.moment.tolist(), sums.at is at, sums.missing) == (moment, True, missing)


def test_what_is_left_of_nothing_is_nothing_or_endless() -> None:
    none, some = np.zeros(2), np.array([0.0, 1.0])
    assert balance((none, np.zeros(1)), none, (0.0, 0.0), 0.5, (), Units()).residual == 0.0
    parts = (Force([0, -1], at=[2, 0]), Couple(-2.0))
    endless = balance((some, np.zeros(1)), none, (0.0, 0.0), 0.5, parts, Units())
    assert endless.residual == math.inf
    assert endless.sentence.endswith(
        ". A force of [0, -1] N on the line through [2, 0] m and a couple of -2 N*m are missing."
    )


def test_components_are_listed_with_their_unit() -> None:
    assert list_components(np.array([1234.567, -0.5]), "force", Units()) == "[1234.6, -0.5] N"
    assert list_components(np.array([3.0]), "moment", Units(length="mm")) == "3000 N*mm"
    assert list_components(np.array([1e-15, 2.0]), "length", Units()) == "[0, 2] m"
    assert list_components(np.array([-2e6, 5e5, 0.0]), "force", Units()) == "[-2, 0.5, 0] MN"


def test_the_centre_of_parallel_forces_of_either_sense() -> None:
    """30 N down at 1, 10 N up at 5: the centre is beyond the larger, at (30 - 50)/20."""
    forces = [Force([0, -30], at=[1, 2]), Force([0, 10], at=[5, 6])]
    assert parallel_center(System(*forces)) == pytest.approx([-1, 0])
    assert parallel_center(System(*forces[::-1])) == pytest.approx([-1, 0])
    with pytest.raises(AnalysisError, match="not parallel"):
        parallel_center(System(Couple(1.0)))


# what a reader writes


def test_numbers_and_vectors_in_units() -> None:
    kips = {"force": "kN", "length": "mm"}
    assert number(2, "force", kips) == 2000.0
    assert number("2", "force", kips) == 2000.0
    assert number("2 N", "force", kips) == 2.0
    assert number(np.float64(2), "length", kips) == 0.002
    assert number("90", "angle") == pytest.approx(math.pi / 2)
    assert number(90, "angle") == 90.0
    assert vector("[1, 2, 30]", "length", kips).tolist() == [0.001, 0.002, 0.03]
    assert vector("2 @ 90", "force", kips) == pytest.approx([0, 2000], abs=1e-9)
    assert vector(np.array([1, 2]), "length", kips).tolist() == [0.001, 0.002]
    assert vector((1, "2 m"), "length", kips).tolist() == [0.001, 2.0]
    for size, kind in ((1e60, "force"), (-1e60, "length"), (9.9e119, "moment"), (-9.9e119, "moment")):
        assert number(size, kind) == size
    for size, kind in ((1.1e60, "force"), (-1.1e60, "length"), (1.1e120, "moment"), (-1.1e120, "moment")):
        with pytest.raises(ModelError, match="is too large; write a number below 1e"):
            number(size, kind)
    with pytest.raises(ModelError, match="a vector has 4 components where 2 or 3 are needed"):
        vector([1, 2, 3, 4], "force")
    with pytest.raises(ModelError, match="a vector has 1 components where 2 or 3 are needed"):
        vector([1], "force")
    with pytest.raises(ModelError, match="a vector has 3 components where 2 are needed"):
        vector("[1, 2, 3]", "force", dimension=2)
    for text in ("[1, 2", "1, 2]"):
        with pytest.raises(ModelError, match="is not a vector; write"):
            vector(text, "force")


def test_what_has_been_read_cannot_be_changed() -> None:
    for some in (vector([1, 2], "force"), vector("1 @ 2", "force"), direction("30 deg"), direction([3, 4])):
        with pytest.raises(ValueError, match="read-only"):
            some[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        Axis([0, 1], [1, 2]).foot([3, 3])[0] = 1.0


def test_a_direction_is_an_angle_or_a_vector() -> None:
    assert direction(math.pi / 6) == pytest.approx([math.sqrt(3) / 2, 0.5])
    assert direction(np.float64(math.pi / 6), 2) == pytest.approx([math.sqrt(3) / 2, 0.5])
    assert direction("30", 2) == pytest.approx([math.sqrt(3) / 2, 0.5])
    assert direction("[3, -4]") == pytest.approx([0.6, -0.8])
    assert direction("7 @ 30") == pytest.approx([math.sqrt(3) / 2, 0.5])
    assert direction([2, -1, 2], 3) == pytest.approx([2 / 3, -1 / 3, 2 / 3])
    with pytest.raises(ModelError, match="30 is not a direction in space"):
        direction(30, 3)


@pytest.mark.parametrize(
    ("off", "fits"), [(0.0099, True), (0.0101, False), (-0.0099, True), (-0.0101, False)]
)
def test_direction_cosines_fit_to_a_hundredth(off: float, fits: bool) -> None:
    angles = [math.pi / 3, math.pi / 3, math.acos(-math.sqrt(0.5 + off))]
    if fits:
        found = cosines(angles)
        assert found @ found == pytest.approx(1.0, rel=1e-14)
        assert found == pytest.approx(np.cos(angles) / math.sqrt(1 + off))
    else:
        with pytest.raises(ModelError, match=f"add to {1 + off:.4g}, not to 1"):
            cosines(angles)


def test_a_line_has_a_foot_and_a_crossing_of_each_coordinate() -> None:
    line = Axis.through([1, 2, 3], [3, 1, 5])
    assert line.direction == pytest.approx([2 / 3, -1 / 3, 2 / 3])
    assert line.foot([3, 4, 2]) == pytest.approx([1, 2, 3])  # (2, 2, -1) is across the line
    assert line.distance([3, 4, 2]) == pytest.approx(3)
    assert line.crossing(x="5000 mm").tolist() == pytest.approx([5, 0, 7])
    assert line.crossing(y=1.5) == pytest.approx([2, 1.5, 4])
    for wrong in ({"x": 1, "y": 2}, {"w": 1}, {}):
        with pytest.raises(ModelError, match="a line is cut at one of x, y, z; write for example"):
            line.crossing(**wrong)
    assert Axis([100, 200], [0, 5], {"length": "mm"}).point == pytest.approx([0.1, 0.2])
    assert Axis([100, 200], 0.5).direction == pytest.approx([math.cos(0.5), math.sin(0.5)])


def test_values_of_a_file_have_their_forms_in_its_schema() -> None:
    assert VectorForm().json_schema() == Moment().json_schema() == {"type": ["number", "string", "array"]}
    assert ToAxes().json_schema() == {"type": "array", "minItems": 3, "maxItems": 3}


# free bodies as systems


def test_a_position_without_an_answer_has_no_free_body() -> None:
    m = da.load(examples()["four_bar"]).with_values({"links.crank.points.A": [0.3, 0.0]})
    r = da.dynamics(m, positions=36)
    bad = r.status.index("not_assembled") + 1
    with pytest.raises(AnalysisError, match=f"^position {bad}: The linkage does not close"):
        da.wrench.on(r, "coupler", at=bad)
    with pytest.raises(ModelError, match="no link is named; name some of crank, coupler, rocker"):
        da.wrench.on(r)
    with pytest.raises(ModelError, match="unknown link 'coupla'; did you mean 'coupler'"):
        da.wrench.on(r, "coupla")
    with pytest.raises(ModelError, match=r"a motion without forces; take one of da\.dynamics or da\.statics"):
        da.wrench.on(da.kinematics(da.load(examples()["four_bar"])), "coupler")


def test_a_free_body_has_its_joints_as_points_and_a_worked_solution() -> None:
    r: Any = da.dynamics(da.load(examples()["four_bar"]), positions=5)
    s = da.wrench.on(r, "coupler", at=3)
    assert s.title == "coupler, position 3"
    assert list(s.points) == ["A", "B"]
    assert s.point("B") == pytest.approx(r.point("coupler", "B")[2])
    assert s.forces[1].name == "F_B"
    assert s.forces[1].at == pytest.approx(r.point("coupler", "B")[2])
    text = str(da.report(s))
    assert s.sheet() is not None
    assert "coupler, position 3" in text
    record = s.record(lambda kind, value: value)["system"]  # type: ignore[arg-type]
    assert record["kind"] == s.kind() == "zero"
    assert record["equilibrium"]["holds"]
    assert "central_axis" not in record


def test_a_record_has_the_axis_of_a_force_or_a_wrench() -> None:
    s = System(Force([0, 0, 5], at=[1, 2, 0]), Couple([0, 0, 15]))
    record = s.record(lambda kind, value: value)["system"]  # type: ignore[arg-type]
    assert record["kind"] == "wrench"
    assert record["resultant"].tolist() == [0, 0, 5]
    assert record["moment_at_origin"].tolist() == [10, -5, 15]
    axis = record["central_axis"]
    assert (axis["moment"], axis["pitch"]) == (pytest.approx(15), pytest.approx(3))
    assert axis["point"] == pytest.approx([1, 2, 0])
    assert axis["direction"].tolist() == [0, 0, 1]
    couple = System(Couple(3.0)).record(lambda kind, value: value)["system"]  # type: ignore[arg-type]
    assert (couple["kind"], "central_axis" in couple) == ("couple", False)
