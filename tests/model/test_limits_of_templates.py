"""Limits of templates and of what a file states: links that just meet, ranges that close in part, sizes in doubt."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from dalembert.errors import ModelError
from dalembert.model.gravity import gravity_doubt
from dalembert.model.joints.elements.cam_profiles import _from_drawing
from dalembert.model.library.compass import SAMPLES, TOUCHING, GapError, angle, meet, reach, start_points
from dalembert.model.library.engines import EVEN_FIRING, GAS
from dalembert.model.links.sections import Section
from dalembert.model.part import ReadingRules
from dalembert.units import file_units

ROD, ARM = ("rod", 3.0), ("arm", 2.0)


@pytest.mark.parametrize(
    ("distance", "says"),
    [
        (5.0, ""),
        (5 + 4e-9, ""),  # a billionth of both lengths is touching
        (5 + 6e-9, "rod 3 m and arm 2 m are 6e-09 m too short to meet"),
        (1.0, ""),
        (1 - 4e-9, ""),
        (1 - 6e-9, "rod 3 m is 6e-09 m too long for arm 2 m to meet it"),
        (6.0, "rod 3 m and arm 2 m are 1 m too short to meet"),
        (0.5, "rod 3 m is 0.5 m too long for arm 2 m to meet it"),
        (4.0, ""),
    ],
)
def test_two_links_meet_up_to_the_sum_and_from_the_difference_of_their_lengths(
    distance: float, says: str
) -> None:
    for first, second in ((ROD, ARM), (ARM, ROD)):
        for left in (True, False):
            a, b = 2 + 1j, 2 + 1j + distance * (0.6 + 0.8j)
            if says:
                with pytest.raises(GapError) as said:
                    meet(a, first, b, second, left)
                words = str(said.value)
                if "short" in says and first is ARM:
                    words = words.replace("arm 2 m and rod 3 m", "rod 3 m and arm 2 m")
                assert words == says
                assert said.value.size == pytest.approx(float(says.split(" m too")[0].split()[-1]))
                remedy = "lengthen the" if "short" in says else "shorten the rod or lengthen the arm"
                assert remedy in said.value.remedy
            else:
                p = meet(a, first, b, second, left)
                assert (abs(p - a), abs(p - b)) == pytest.approx((first[1], second[1]), abs=2e-8)
                across = ((p - a) / (b - a)).imag
                assert (
                    across == pytest.approx(0.0, abs=1e-8)
                    if abs(distance - 3) > 1.9
                    else (across > 0) == left
                )


def test_links_of_one_length_do_not_meet_at_one_point() -> None:
    both = ("rod", 2.0), ("arm", 2.0)
    for distance, meets in ((0.0, False), (3e-9, False), (5e-9, True), (1.0, True)):
        if meets:
            assert abs(meet(0, both[0], distance, both[1])) == pytest.approx(2.0)
        else:
            with pytest.raises(GapError, match="both 2 m, lie on each other and are free to turn"):
                meet(0, both[0], distance, both[1])


@pytest.mark.parametrize("direction", [0.0, 0.7, math.pi])
def test_a_link_reaches_a_line_up_to_its_length(direction: float) -> None:
    """From 3 m aside of a line with 5 m: 4 m ahead or behind; with 3 m and less a billionth of it just beside."""
    unit = complex(math.cos(direction), math.sin(direction))
    for side in (1, -1):
        a = (2 + 3j * side) * unit + 1
        assert reach(a, ("rod", 5.0), 1, direction) == pytest.approx(6 * unit + 1)
        assert reach(a, ("rod", 5.0), 1, direction, forward=False) == pytest.approx(-2 * unit + 1)
        assert reach(a, ("rod", 3.0 - 0.9 * 3 * TOUCHING), 1, direction) == pytest.approx(
            2 * unit + 1, abs=1e-6
        )
        with pytest.raises(GapError, match="too short to reach the line of the slide") as said:
            reach(a, ("rod", 3.0 - 1.2 * 3 * TOUCHING), 1, direction)
        assert said.value.size == pytest.approx(1.2 * 3 * TOUCHING, rel=1e-6)
        assert said.value.remedy == "lengthen the rod"


def opening(low: float, high: float) -> object:
    """A linkage that does not close between two values of its drive, worst in the middle of them."""

    def place(value: float) -> dict[str, complex]:
        if low <= value <= high:
            size = 1 - abs(value - (low + high) / 2)
            raise GapError(size, f"the rod is {size:.3f} m too short", "lengthen the rod")
        return {"A": complex(value)}

    return place


@pytest.mark.parametrize(
    ("gap", "sweep", "turn", "where"),
    [
        ((0.5, 1.0), (0.0, 3.6), False, "from 0.5 to 1 m"),
        ((0.5, 1.0), (3.6, 0.0), False, "from 0.5 to 1 m"),
        ((-9.0, 1.0), (0.0, 3.6), False, "from 0 to 1 m"),
        ((3.0, 9.0), (0.0, 3.6), False, "from 3 to 3.6 m"),
        ((1.995, 2.005), (0.0, 3.6), False, "at 2 m"),
        ((math.radians(29.9), math.radians(45.1)), (0.0, 2 * math.pi), True, "from 30 to 45 degrees"),
        ((math.radians(29.9), math.radians(45.1)), (2 * math.pi, 0.0), True, "from 30 to 45 degrees"),
        ((math.radians(89.9), math.radians(90.1)), (0.0, 2 * math.pi), True, "at 90 degrees"),
        ((5.0, 5.0), (5.0, 5.0), False, "at 5 m"),
    ],
)
def test_a_template_names_the_first_part_of_its_range_that_does_not_close(
    gap: tuple[float, float], sweep: tuple[float, float], turn: bool, where: str
) -> None:
    with pytest.raises(ModelError) as said:
        start_points("press", opening(*gap), sweep, "ram", turn)  # type: ignore[arg-type]
    assert str(said.value).startswith(f"press does not close {where} of the ram: the rod is ")
    assert "lengthen the rod, or give the ram a smaller range" in str(said.value)
    worst = float(str(said.value).split("the rod is ")[1].split()[0])
    middle = min(max(sum(gap) / 2, min(sweep)), max(sweep))
    assert worst == pytest.approx(1 - abs(middle - sum(gap) / 2), abs=0.01)


def test_a_template_begins_at_the_first_value_of_its_range() -> None:
    assert start_points("press", opening(8.0, 9.0), (2.0, 3.0))["A"] == 2.0  # type: ignore[arg-type]
    for sweep in ((math.nan, 1.0), (0.0, math.inf)):
        for turn, unit in ((True, "radians"), (False, "metres")):
            with pytest.raises(ModelError, match=f"is not finite; give two numbers in {unit}"):
                start_points("press", opening(8.0, 9.0), sweep, "ram", turn)  # type: ignore[arg-type]
    assert SAMPLES == 361
    points = {"A": 1 + 1j, "B": 1 + 2j, "C": 1 - 1j * 0.5, "D": 0 + 1j}
    assert [angle(points, "A", end) for end in "BCD"] == [90.0, -90.0, 180.0]


def test_the_gas_burns_once_in_two_turns_and_every_cylinder_fires_once() -> None:
    """The largest force 20 deg after the dead centre, falling until the valve opens; none while both strokes of
    exhaust and intake last; then compression, up to the force with which it begins."""
    degrees, force = GAS
    assert (degrees[0], degrees[-1]) == (0, 720)
    assert force[0] == force[-1]
    top = force.index(max(force))
    assert (degrees[top], force[top]) == (20, 1)
    assert list(force[top:8]) == sorted(force[top:8], reverse=True)
    assert {f for d, f in zip(degrees, force, strict=True) if 360 <= d <= 580} == {0}
    assert list(force[10:]) == sorted(force[10:])
    assert list(degrees) == sorted(set(degrees))
    for count, order in EVEN_FIRING.items():
        assert sorted(order) == list(range(1, count + 1))
        assert order[0] == 1


@pytest.mark.parametrize(
    ("size", "doubt"),
    [(1.01, False), (1.62, False), (24.8, False), (29.9, False), (30.1, True), (0.99, True)],
)
def test_gravity_is_that_of_a_moon_or_a_planet(size: float, doubt: bool) -> None:
    for vector in ((0.0, -size), (size, 0.0), (0.0, 0.6 * size, 0.8 * size)):
        assert bool(gravity_doubt(vector)) is doubt


def test_sections_have_the_numbers_of_the_handbooks() -> None:
    """An I of 100 x 60 with a web of 6 and flanges of 10 mm, by areas less the empty ones; circle and tube; a square in
    torsion 0.208 a^3, a strip a b^2 / 3."""
    i = Section(I=(0.1, 0.06, 0.006, 0.01))
    assert i.area_of == pytest.approx(2 * 60 * 10e-6 + 80 * 6e-6)
    about_y, about_z = i.second_moments
    assert about_z == pytest.approx((60 * 100**3 - 54 * 80**3) / 12 * 1e-12)
    assert about_y == pytest.approx((20 * 60**3 + 80 * 6**3) / 12 * 1e-12)
    assert i.reach == (0.05, 0.03)
    assert i.shear == pytest.approx((1 / 480e-6, 1.5 / 1200e-6))
    assert i.torsion == pytest.approx((2 * 60 * 10**3 + 80 * 6**3) / 3 / 10 * 1e-9)
    plate = Section(rectangle=(0.02, 0.04))
    assert plate.second_moments == pytest.approx((40 * 20**3 / 12e12, 20 * 40**3 / 12e12))
    assert plate.reach == (0.02, 0.01)
    assert plate.shear == pytest.approx((1.5 / 8e-4,) * 2)
    for sides, factor in (
        ((0.02, 0.02), 0.208),
        ((0.02, 0.04), 0.246),
        ((0.04, 0.02), 0.246),
        ((0.01, 0.1), 0.312),
    ):
        short, long = sorted(sides)
        assert Section(rectangle=sides).torsion == pytest.approx(factor * long * short**2, rel=3e-3)
    rod, tube = Section(circle=0.02), Section(tube=(0.018, 0.02))
    assert rod.second_moments == pytest.approx((math.pi * 20**4 / 64e12,) * 2)
    assert rod.shear == pytest.approx((4 / 3 / rod.area_of,) * 2)
    assert rod.torsion == pytest.approx(math.pi * 20**3 / 16e9)
    assert tube.area_of == pytest.approx(math.pi / 4 * (20**2 - 18**2) * 1e-6)
    assert tube.second_moments == pytest.approx((math.pi * (20**4 - 18**4) / 64e12,) * 2)
    assert Section(tube=(0.01999999, 0.02)).shear[0] * Section(
        tube=(0.01999999, 0.02)
    ).area_of == pytest.approx(2.0)
    assert rod.round
    assert tube.round
    assert not plate.round
    own = Section(area="3 cm^2", modulus="2 cm^3", inertia="5 cm^4")
    assert own.reach == pytest.approx((0.025, 0.025))
    assert own.shear == pytest.approx((1.5 / 3e-4,) * 2)
    with pytest.raises(ModelError, match="has no torsion"):
        _ = own.torsion


@pytest.mark.parametrize(
    ("keys", "fits"),
    [
        ({"tube": (0.02, 0.02)}, False),
        ({"tube": (0.0199, 0.02)}, True),
        ({"I": (0.1, 0.06, 0.06, 0.01)}, False),
        ({"I": (0.1, 0.06, 0.059, 0.01)}, True),
        ({"I": (0.1, 0.06, 0.006, 0.05)}, False),
        ({"I": (0.1, 0.06, 0.006, 0.049)}, True),
        ({"circle": 0.02, "notch": 1.0}, True),
        ({"circle": 0.02, "notch": 0.999}, False),
        ({"circle": 0.02, "tube": (0.01, 0.02)}, False),
        ({"area": 1e-4, "modulus": 1e-6}, False),
        ({}, False),
    ],
)
def test_a_section_is_hollow_and_has_one_size(keys: dict[str, object], fits: bool) -> None:
    if fits:
        assert Section(**keys).area_of > 0  # type: ignore[arg-type]
    else:
        with pytest.raises(ModelError):
            Section(**keys)  # type: ignore[arg-type]


def test_a_drawing_without_a_closed_outline_says_so(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new()
    drawing.modelspace().add_lwpolyline([(3, 0), (0, 4), (-5, 0)])
    path = str(tmp_path / "cam.dxf")
    drawing.saveas(path)
    rules = ReadingRules(file_units({"length": "mm"}))
    with pytest.raises(ModelError) as said:
        _from_drawing(path, rules)
    assert (
        str(said.value) == f"{path!r} has no closed polyline; draw the cam as one, about its axis at (0, 0)"
    )
    drawing.modelspace().add_lwpolyline([(3, 0), (0, 4), (-5, 0), (0, -2)], close=True)
    drawing.saveas(path)
    angles, radii = _from_drawing(path, rules)
    assert angles == pytest.approx([0.0, math.pi / 2, math.pi, 1.5 * math.pi])
    assert radii == pytest.approx([0.003, 0.004, 0.005, 0.002])
