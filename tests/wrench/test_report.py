"""The worked solution of a force system: what stands in it, for every kind of system, in every format."""

from __future__ import annotations

from pathlib import Path

import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.wrench import Couple, Force, System
from tests.wrench.random_systems import DIMENSIONS, SEEDS, random_system

PLATE = System(
    Force([40, 0], at=[-7, 0]),
    Force([0, 50], at=[-5, 4]),
    Force("60 @ 135", at=[-7, 4]),
    Force("80 @ 30", at=[0, 0]),
    Couple(140),
)


def test_a_plate() -> None:
    text = str(da.report(PLATE))
    for line in (
        "Plane, 4 forces and 1 couple",
        "F_3    −42.43  42.43  60.00  135.00   −7.000  4.000",
        "R_x = Σ F_x = 40.00 + 0 − 42.43 + 69.28 = 66.86 N",
        "θ (tan θ = R_y / R_x) = 63.21 °",
        "F_3   −7.000  4.000  −42.43  42.43  −127.3",
        "M_1   –       –      –       –      140.0",
        "d = M_O / R = −237.3 / 148.3 = −1.600 m",
        "x R_y − y R_x = M_O: 132.4 x − 66.86 y = −237.3",
        "from all parts M = 525.5, from R and M at O by M_O + (O − P) × R: 525.5",
        "A force of [−66.856, −132.43] N on the line",
    ):
        assert line in text.replace("\n", " ") or line in text, line


def test_moments_about_another_point() -> None:
    text = str(da.report(PLATE, at=["-7 m", 0]))
    assert "About O at (−7.000, 0) m" in text
    assert "F_4   7.000  0      69.28   40.00  280.0" in text
    assert "it cuts y = 0 at x = 5.208 m" in text.replace("\n", " ")


def test_a_box() -> None:
    box = System(
        Force.along("20 kN", [0, 0, 0], [8, 4, 4]),
        Force.along("10 kN", [8, 0, 0], [8, 4, 0]),
        Force([0, 0, "30 kN"], at=[0, 4, 0]),
        units={"force": "kN"},
    )
    text = str(da.report(box))
    for line in (
        "R · M_O = 16.33 · 120.0 + 18.16 · 0 + 38.16 · 80.00 = 5013 kN²·m",
        "M = R · M_O / R = 110.6 kN·m",
        "p = M / R = 2.441 m",
        "r = R × M_O / R^2 = (0.7078, 1.594, −1.062) m",
        "it cuts the plane z = 0 at (1.162, 2.100, 0) m",
    ):
        assert line in text.replace("\n", " "), line


@pytest.mark.parametrize("d", DIMENSIONS)
@pytest.mark.parametrize("seed", SEEDS)
def test_the_check_at_another_point_agrees(seed: int, d: int) -> None:
    text = " ".join(str(da.report(random_system(seed, d))).split())
    check = text[text.index("from all parts M = ") :]
    first = check.removeprefix("from all parts M = ").partition(", from R")[0]
    assert f"× R: {first} N·m" in check


def test_every_kind() -> None:
    pair = System(Force([5, 0]), Force([-5, 0], at=[0, 2]))
    assert "The force is zero: the system is a couple" in str(da.report(pair))
    assert "A couple of −10 N·m is missing." in str(da.report(pair))
    assert "perpendicular: the system is a single force" in str(
        da.report(System(Force([0, 0, 5], at=[1, 1, 0])))
    )
    rod = da.wrench.on(da.dynamics(da.load(examples()["four_bar"])), "coupler")
    text = str(da.report(rod))
    assert "Both are zero: the system is in equilibrium." in text
    assert "R_x = Σ F_x = −118.0 − 1.310 + 69.28 + 50.05 = 0 lbf" in text
    assert "Space, 0 forces and 1 couple" in str(da.report(System(Couple([1, 0, 0]))))


@pytest.mark.parametrize("kind", ["pdf", "html", "tex", "txt"])
def test_every_format(kind: str, tmp_path: Path) -> None:
    target = tmp_path / f"plate.{kind}"
    da.report(PLATE).save(target)
    assert target.stat().st_size > 1000
