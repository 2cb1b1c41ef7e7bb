"""Shoes and bands on a drum: integrals of the pressure by quadrature, areas, ends, and what is refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from scipy.integrate import quad

from dalembert.errors import ModelError
from dalembert.model import Band, Shoe

DEG = math.pi / 180
ON = {"links": ("drum", "lever"), "at": ("O", "Q"), "radius": 0.15}


def integral(f: Callable[[float], float], begin: float, end: float) -> float:
    return float(quad(f, begin, end, epsabs=1e-13)[0])


@pytest.mark.parametrize(("begin", "end"), [(10, 126), (25, 70), (95, 150), (0, 180), (0, 90), (90, 140)])
def test_a_pinned_lining(begin: float, end: float) -> None:
    """p over the pressure at 90 deg is sin(th), th from j's point; the greatest pressure is where sin(th) is."""
    a, b = begin * DEG, end * DEG
    shoe = Shoe(**ON, width=0.03, begin=a, end=b)
    along = integral(lambda t: math.sin(t) * math.cos(t), a, b)
    across = integral(lambda t: math.sin(t) ** 2, a, b)
    size, rim = math.hypot(along, across), integral(math.sin, a, b)
    peak = 1.0 if begin <= 90 <= end else math.sin((end if end < 90 else begin) * DEG)
    assert shoe.parts == pytest.approx((along, across), abs=1e-12)
    assert shoe.rim == pytest.approx(rim, rel=1e-12)
    assert shoe.friction_arm == pytest.approx(0.15 * rim / size, rel=1e-12)
    assert shoe.area == pytest.approx(0.03 * 0.15 * size / peak, rel=1e-12)
    assert shoe.lining_area == pytest.approx(0.03 * 0.15 * (b - a), rel=1e-12)
    for side in (1.0, -1.0):
        wanted = (along / size, side * across / size)
        assert shoe.load_direction(side) == pytest.approx(wanted, abs=1e-12)
        inside = Shoe(**ON, begin=a, end=b, internal=True).load_direction(side)
        assert inside == pytest.approx((-wanted[0], -wanted[1]), abs=1e-12)


@pytest.mark.parametrize(("begin", "end"), [(-40, 60), (20, 110), (-90, 90)])
def test_a_lining_that_settles_has_a_cosine_of_pressure(begin: float, end: float) -> None:
    a, b = begin * DEG, end * DEG
    middle = (a + b) / 2
    shoe = Shoe(**ON, width=0.03, begin=a, end=b, pressure="cosine")
    along = integral(lambda t: math.cos(t - middle) * math.cos(t), a, b)
    across = integral(lambda t: math.cos(t - middle) * math.sin(t), a, b)
    rim = integral(lambda t: math.cos(t - middle), a, b)
    assert (shoe.middle, shoe.half) == pytest.approx((middle, (b - a) / 2), abs=1e-15)
    assert shoe.parts == pytest.approx((along, across), abs=1e-12)
    assert shoe.rim == pytest.approx(rim, rel=1e-12)
    assert shoe.peak == 1.0
    assert shoe.area == pytest.approx(0.03 * 0.15 * math.hypot(along, across), rel=1e-12)


def test_a_short_lining_presses_at_a_point() -> None:
    shoe = Shoe(**ON, width=0.03)
    assert (shoe.parts, shoe.rim, shoe.peak) == ((1.0, 0.0), 1.0, 1.0)
    assert (shoe.half, shoe.middle, shoe.lining_area) == (0.0, 0.0, 0.0)
    assert (shoe.friction_arm, shoe.reach) == (0.15, 0.15)
    assert shoe.load_direction(-1.0) == (1.0, 0.0)
    assert shoe.begin == 0.0
    assert shoe.internal is False
    assert shoe.contact.mode == "pushes"
    assert math.isnan(shoe.area)
    assert math.isnan(Shoe(**ON, begin=0.2, end=0.9).area)
    assert Shoe(**ON, begin=0.2, end=0.9).lining_area == 0.0


ORDER = "the lining ends where it begins, or before; make to larger than from"
PIN = (
    "a pinned lining presses from 0 to 180 deg of its pin only; give from and to in between, counted to the side on "
    "which the lining lies, or pressure: cosine"
)


@pytest.mark.parametrize(
    ("keys", "says", "at"),
    [
        ({"from": 0.3}, "a lining has from without to; give both angles", "from"),
        ({"from": 0.3, "to": 0.3}, ORDER, "to"),
        ({"from": 0.3, "to": 0.2}, ORDER, "to"),
        ({"from": -0.1, "to": 0.2}, PIN, "from"),
        ({"from": 0.1, "to": 3.2}, PIN, "to"),
        (
            {"from": -0.1, "to": 3.1, "pressure": "cosine"},
            "a cosine of pressure ends 90 deg from its middle; make to smaller",
            "to",
        ),
        (
            {"from": 0.1, "to": 6.5, "pressure": "cosine"},
            "the lining is longer than the drum's circumference; make to smaller",
            "to",
        ),
    ],
)
def test_a_lining_that_cannot_be(keys: dict[str, Any], says: str, at: str) -> None:
    with pytest.raises(ModelError) as caught:
        Shoe(**ON, **keys)
    assert (f"{caught.value.what}; {caught.value.remedy}", caught.value.path) == (says, (at,))


AROUND = {"links": ("drum", "lever"), "around": "O", "radius": 0.2, "width": 0.05}


def test_the_area_of_a_band_is_that_of_its_angle() -> None:
    ends = ("ground.L", "lever.B")
    assert Band(**AROUND, ends=ends, wrap=4.0).lining_area == pytest.approx(4.0 * 0.2 * 0.05)
    blocks = Band(**AROUND, ends=ends, blocks={"count": 14, "angle": "15 deg"})
    assert blocks.wound == pytest.approx(210 * DEG, rel=1e-14)
    assert blocks.lining_area == pytest.approx(210 * DEG * 0.01, rel=1e-14)
    tangent = Band(**AROUND, ends=ends)
    assert (tangent.wound, tangent.lining_area) == (None, 0.0)


@pytest.mark.parametrize(
    ("ends", "point"),
    [(("ground.L", "lever.B"), "B"), (("lever.A", "ground.L"), "A"), (("lever.A", "lever.B"), "A")],
)
def test_a_band_is_at_its_first_end_on_the_lever(ends: tuple[str, str], point: str) -> None:
    band = Band(**AROUND, ends=ends)
    assert band.point_names("J") == ("O", point)
    at = [(end.split(".")[0], end.split(".")[1], ("ends", k), ("ends", k)) for k, end in enumerate(ends)]
    assert list(band.places("J")) == [("drum", "O", ("links", 0), ()), *at]


@pytest.mark.parametrize(
    ("keys", "says", "at"),
    [
        (
            {"ends": ("ground.L", "arm.B")},
            "no end of the band is on lever; write ends: [ground.L, lever.B]",
            ("ends",),
        ),
        (
            {"ends": ("arm.L", "lever.B")},
            "an end of the band is on arm; put it on ground or on lever",
            ("ends",),
        ),
        ({"at": "O"}, "a band has no `at`; write around: O and ends: [ground.L, lever.B]", ("at",)),
        (
            {"wrap": 3, "blocks": {"count": 14, "angle": 0.2}},
            "wrap is given beside blocks; leave it out: the blocks have it",
            ("wrap",),
        ),
        (
            {"ends": ("ground.L", "lever")},
            "item 2 of ends: 'lever' is not a point of a link; write link.point, as lever.B",
            ("ends", 1),
        ),
        (
            {"ends": ("ground.L",)},
            "ends: expected two points, not a list; write [ground.L, lever.B]",
            ("ends",),
        ),
        (
            {"ends": "ground.L"},
            "ends: expected two points, not 'ground.L'; write [ground.L, lever.B]",
            ("ends",),
        ),
        (
            {"blocks": {"count": 2.5, "angle": 0.2}},
            "count of blocks: the number of blocks is not an integer; write an integer",
            ("blocks", "count"),
        ),
    ],
)
def test_a_band_that_cannot_be(keys: dict[str, Any], says: str, at: tuple[Any, ...]) -> None:
    with pytest.raises(ModelError) as caught:
        Band(**AROUND | {"ends": ("ground.L", "lever.B")} | keys)
    error = caught.value
    assert (f"{error.what}; {error.remedy}", error.path) == (says, at)
