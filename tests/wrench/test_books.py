"""Problems of books: printed figures, to half their last digit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dalembert.wrench import Axis, Couple, Force, System, parallel_center


def test_beer_johnston_two_cables() -> None:
    """Beer, Johnston et al., Vector Mechanics for Engineers, 8th ed., problem 2.96: resultant of two tensions."""
    ab = Force.along("765 N", [0, 0, 0], ["-600 mm", "360 mm", "270 mm"])
    ac = Force.along("510 N", [0, 0, 0], ["-600 mm", "320 mm", "-510 mm"])
    assert ab.vector.round(1).tolist() == [-612.0, 367.2, 275.4]
    assert ac.vector.round(1).tolist() == [-360.0, 192.0, -306.0]
    r = System(ab, ac).central_axis()
    whole = Force(r.force)
    assert whole.size == pytest.approx(1121.80, abs=0.005)
    assert np.degrees(whole.angles).round(1).tolist() == [150.1, 60.1, 91.6]


def test_beer_johnston_cube() -> None:
    """Beer, Johnston et al., Sample Problem 3.5: M_A = aP/sqrt 2 (1, 1, 1), about AG -aP/sqrt 6."""
    a, p = 2.0, 3.0
    force = Force.directed(p, [0, 1, -1], at=[a, -a, 0])
    assert force.moment() == pytest.approx(a * p / math.sqrt(2) * np.ones(3))
    assert force.moment(Axis.through([0, 0, 0], [1, 0, 0])) == pytest.approx(a * p / math.sqrt(2))
    assert force.moment(Axis.through([0, 0, 0], [a, -a, -a])) == pytest.approx(-a * p / math.sqrt(6))


def test_beer_johnston_bracket() -> None:
    """Beer, Johnston et al., Sample Problem 3.10: three cables on a bracket, reduced at A."""
    s = System(
        Force([300, -600, 200], at=[0.075, 0, 0.050]),
        Force([1000 / math.sqrt(2), 0, -1000 / math.sqrt(2)], at=[0.075, 0, -0.050]),
        Force([600, 1200 * math.cos(math.radians(30)), 0], at=[0.100, -0.100, 0]),
    )
    found = s.reduced()
    assert found.force.round().tolist() == [1607.0, 439.0, -507.0]
    assert found.couple.round(2).tolist() == [30.0, 17.68, 118.92]


def test_meriam_plate() -> None:
    """Meriam, Kraige, Engineering Mechanics: Statics, Sample Problem 2/9: four forces and a couple on a plate."""
    s = System(
        Force([40, 0], at=[-7, 0]),
        Force([0, 50], at=[-5, 4]),
        Force("60 @ 135", at=[-7, 4]),
        Force("80 @ 30", at=[0, 0]),
        Couple(140),
    )
    found = s.central_axis()
    assert s.resultant.round(1).tolist() == [66.9, 132.4]
    assert Force(s.resultant).size == pytest.approx(148.3, abs=0.05)
    assert math.degrees(Force(s.resultant).angle) == pytest.approx(63.2, abs=0.05)
    assert s.moment([0, 0]) == pytest.approx(-237, abs=0.5)
    assert found.axis.distance([0, 0]) == pytest.approx(1.600, abs=0.005)
    assert found.axis.crossing(y=0)[0] == pytest.approx(-1.792, abs=0.005)


def test_hibbeler_slab() -> None:
    """Hibbeler, Engineering Mechanics: Statics: four columns on a slab, F_1 = 8 kN, F_2 = 9 kN."""
    columns = {(6, 8): 12, (22, 0): 8, (26, 20): 6, (0, 20): 9}
    s = System(*(Force([0, 0, f"-{size} kN"], at=[x, y, 0]) for (x, y), size in columns.items()))
    assert s.resultant.tolist() == [0, 0, -35000]
    assert parallel_center(s).round(2).tolist() == [11.54, 11.31, 0]
    assert s.central_axis().axis.crossing(z=0).round(2).tolist() == [11.54, 11.31, 0]


def test_kirsanov_screw() -> None:
    """Kirsanov, Reshebnik: teoreticheskaya mekhanika, reduction to a screw: all figures as fractions."""
    s = System(
        Force([0, 0, 3], at=[0, 3, 0]), Force([0, -5, 0], at=[1, 0, 0]), Force([0, 1, 0], at=[0, 0, 4])
    )
    found = s.central_axis()
    assert s.resultant.tolist() == [0, -4, 3]
    assert s.moment().tolist() == [5, 0, -5]
    assert found.moment == pytest.approx(-3)
    assert found.pitch == pytest.approx(-0.6)
    assert found.axis.crossing(z=0) == pytest.approx([0.8, 5 / 3, 0])


def test_wrench_on_a_box() -> None:
    """A solved example at transtutors.com (wrench resultant): forces 20, 10 and 30 kN on the edges of a box."""
    s = System(
        Force.along("20 kN", [0, 0, 0], [8, 4, 4]),
        Force.along("10 kN", [8, 0, 0], [8, 4, 0]),
        Force([0, 0, "30 kN"], at=[0, 4, 0]),
    )
    found = s.central_axis()
    assert np.linalg.norm(found.force) == pytest.approx(45312.2, abs=0.5)
    assert found.axis.crossing(z=0)[:2] == pytest.approx([1.162, 2.100], abs=0.0015)
    assert found.moment == pytest.approx(110581, abs=60)  # its direction cosines have four figures
    assert found.axis.direction.round(3).tolist() == [0.36, 0.401, 0.842]
