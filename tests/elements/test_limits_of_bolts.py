"""Bolts at their limits: sums of vectors along a stack, every order of its links, the curve of the moment, safeties."""

from __future__ import annotations

import math
from itertools import permutations
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.machine.elements.pin_stresses import _along, _best, moment_along
from dalembert.model.joints.elements.pin_keys import PinSize
from dalembert.printing import number
from tests.elements.test_pins import FORK, hung

STACK: dict[str, Any] = {"diameter": "20 mm", "stack": ["left", "hook", "right"], "layers": [0, 0.018, 0.04]}
FORCES = np.array([[[3.0, -1], [-7, 2], [1.5, 4], [2.5, -5]], [[2.0, 5], [1, -3], [-4, 6], [1, -8]]])
PLACES = np.array([0.01, 0.013, 0.02, 0.037])


def test_shears_and_moments_along_a_bolt_are_sums_of_vectors() -> None:
    """By hand: in a plane all forces before it, at a layer each of these times its distance."""
    shear, moment = _along(FORCES, PLACES)
    for k, forces in enumerate(FORCES):
        for n in range(3):
            assert shear[k, n] == pytest.approx(np.hypot(*forces[: n + 1].sum(axis=0)), rel=1e-12)
        for n in range(4):
            each = [f * (PLACES[n] - x) for f, x in zip(forces[:n], PLACES, strict=False)]
            assert moment[k, n] == pytest.approx(np.hypot(*np.sum(each, axis=0)) if each else 0.0, abs=1e-15)
    assert (shear.shape, moment[:, 0].tolist()) == ((2, 3), [0.0, 0.0])


@pytest.mark.parametrize("which", [[0], [1], [0, 1]])
def test_the_best_order_of_a_bolt_is_that_of_all_orders_tried(which: list[int]) -> None:
    """The largest moment over all positions, layers kept; of both directions along the bolt one is tried."""
    names = ("a", "b", "c", "d")
    size = PinSize(diameter=0.02, stack=names, layers=tuple(PLACES.tolist()))
    forces = FORCES[which]
    largest = {
        order: max(float(_along(forces[[k]][:, order], PLACES)[1].max()) for k in range(len(forces)))
        for order in permutations(range(4))
    }
    found = _best(forces, size)
    order = tuple(names.index(n) for n in found)
    assert sorted(found) == [*names]
    assert order[0] < order[-1]
    assert largest[order] == min(x for o, x in largest.items() if o[0] < o[-1])
    assert min(largest.values()) < 0.9 * largest[0, 1, 2, 3]


def test_of_orders_that_bend_alike_the_first_is_kept() -> None:
    size = PinSize(diameter=0.02, stack=("a", "b", "c"), layers=(0, 0.01, 0.02))
    assert _best(np.array([[[0.0, 0], [0, 0], [0, 0]]]), size) == ("a", "b", "c")
    unknown = np.array([[[1.0, 0], [-1, 0], [0, 0]], [[np.nan, 0], [1, 0], [0, 0]]])
    assert sorted(_best(unknown, size)) == ["a", "b", "c"]


def test_the_moment_of_a_stack_is_drawn_between_its_layers() -> None:
    r = da.statics(hung(STACK))
    x = da.pin(r, "A")
    places, moment = moment_along(x, 0)
    left, hook = r.reaction("A", on="left")[0], r.reaction("B", on="hook")[0]
    exact = [np.hypot(*(left * s + hook * max(0.0, s - 0.018))) for s in places]
    assert moment == pytest.approx(np.array(exact), rel=1e-9, abs=1e-12)
    assert len(places) == 51
    assert places[1:26] == pytest.approx(np.linspace(0, 0.018, 25))
    assert places[26:] == pytest.approx(np.linspace(0.018, 0.04, 25))
    assert (places[0], moment[0]) == (0.0, 0.0)


@pytest.mark.parametrize("planes", [1, 2])
def test_the_moment_of_a_fork_is_that_of_an_even_pressure_in_its_eye(planes: int) -> None:
    """Of two plates a triangle; of a fork F/2 up to the eye, from which F/t of the eye is taken on the way."""
    x = da.pin(da.statics(hung({**FORK, "planes": planes})), "A")
    places, moment = moment_along(x, 0)
    force = float(x.force[0])
    if planes == 1:
        assert places == pytest.approx([0, 0.016, 0.032])
        assert moment == pytest.approx([0, force * 0.016, 0])
        return
    assert places[[0, 1, -2, -1]] == pytest.approx([0, 0.012, 0.052, 0.064])
    assert np.diff(places[1:-1]) == pytest.approx(np.full(24, 0.04 / 24))
    u = places[1:-1] - 0.012
    assert moment[1:-1] == pytest.approx(force / 2 * places[1:-1] - force / 0.04 * u**2 / 2)
    assert moment[[0, 1, 13, -2, -1]] == pytest.approx(force * np.array([0, 0.006, 0.011, 0.006, 0]))


def test_shear_alone_and_bending_alone_decide_on_a_bolt() -> None:
    """A short thick bolt is sheared, a long thin one is bent; of an unknown bending the shear is left."""
    short = {"diameter": "60 mm", "eye": "10 mm", "cheeks": "6 mm", "yield_stress": "300 MPa"}
    long = {**short, "diameter": "12 mm", "gap": "9 mm"}
    for size, sheared in ((short, True), (long, False), ({"diameter": "12 mm"}, True)):
        x = da.pin(da.statics(hung(size)), "A")
        d = x.size.diameter
        shear = math.sqrt(3) * 4 / 3 * x.force[0] / 2 / (math.pi * d**2 / 4)
        bend = x.moment[0] / (math.pi * d**3 / 32)
        assert x.equivalent == pytest.approx([shear if sheared else bend], rel=1e-12)
        if "yield_stress" in size:
            assert bool(shear > 1.1 * bend) is sheared
            assert x.safety == pytest.approx(300e6 / x.equivalent, rel=1e-12)
        else:
            assert np.isnan(x.safety).all()
        assert np.isnan(x.pressure_safety).all()


def test_a_plate_without_its_partner_has_its_pressure_and_no_moment() -> None:
    for key, other, part in (("eye", "cheek_pressure", 1), ("cheeks", "eye_pressure", 2)):
        x = da.pin(da.statics(hung({"diameter": "20 mm", key: "15 mm", "allowed_pressure": "90 MPa"})), "A")
        link = "right" if key == "eye" else "left"
        assert {n: p[0] for n, p in x.pressures.items()} == pytest.approx(
            {link: x.force[0] / part / 0.02 / 0.015}
        )
        assert np.isnan(getattr(x, other)).all()
        assert np.isnan(x.moment).all()
        assert x.pressure_safety == pytest.approx(90e6 / x.pressures[link])
        assert [len(of) for of in moment_along(x, 0)] == [0, 0]


def swung(**more: Any) -> Any:
    """A four-bar that does not close all round, with a fork between crank and coupler."""
    tree = da.load(examples()["four_bar"]).to_tree()
    tree["joints"]["A"]["pin"] = {**FORK, **more}
    tree["drives"]["O2"] |= {"position": {"from": 0, "to": 330, "count": 12}}
    return da.dynamics(da.mechanism(tree).with_values({"links.crank.points.A": (0.25, 0.0)}))


def test_safeties_are_those_of_the_positions_with_an_answer() -> None:
    r = swung(yield_stress="300 MPa", allowed_pressure="60 MPa")
    x = da.pin(r, "A")
    lost = np.isnan(x.force)
    assert 0 < lost.sum() < 12
    assert np.isnan(x.safety).tolist() == np.isnan(x.pressure_safety).tolist() == lost.tolist()
    text = x.text()
    assert f"Safety against yielding {number(np.nanmin(x.safety), 4)}: bending" in text
    assert f"Safety of the pressure {number(np.nanmin(x.pressure_safety), 4)}." in text
    rows = {line.rsplit(None, 3)[0]: line.split()[-1] for line in text.splitlines() if line.startswith("eye")}
    assert [*rows.values()] == [str(int(np.nanargmax(x.force)) + 1)]
    record = x.record(r.scale("SI"))["pin"]
    assert record["moment"] == pytest.approx(np.nanmax(x.moment))
    assert (record["joint"], record["best_order"]) == ("A", [])
    plain = swung()
    assert "Safety" not in da.pin(plain, "A").text()


def test_the_table_of_bolts_has_the_least_safety_of_each_link() -> None:
    """A machine in inches and pounds; a dash where no limit is given."""
    inch, pound = 0.0254, 4.4482216152605
    for limits in ({"yield_stress": "300 MPa", "allowed_pressure": "60 MPa"}, {}):
        r = swung(**limits)
        x = da.pin(r, "A")
        first, second, *pressed = (
            line.split() for line in da.pins(r).text().splitlines() if line.startswith("A ")
        )
        numbers = (1.18110236, 2, np.nanmax(x.force) / pound, np.nanmax(x.peak_shear) / (pound / inch**2))
        assert [float(c) for c in first[1:5]] == pytest.approx(numbers, rel=2e-4)
        assert float(first[7]) == pytest.approx(np.nanmax(x.moment) / (pound * inch), rel=2e-4)
        assert float(first[8]) == pytest.approx(np.nanmax(x.bending) / (pound / inch**2), rel=2e-4)
        top = int(np.nanargmax(x.force))
        assert first[5:7] == first[9:11] == [number(30 * top), "deg"]
        assert second[-1] == (number(np.nanmin(x.safety), 4) if limits else "-")
        for link, row in zip(("coupler", "crank"), pressed, strict=True):
            most = np.nanmax(x.pressures[link])
            assert row[1] == link
            assert float(row[2]) == pytest.approx(most / (pound / inch**2), rel=2e-4)
            assert row[3:] == [number(30 * top), "deg", number(60e6 / most, 4) if limits else "-"]
        found = da.pins(r).record(r.scale("SI"))["pins"]["A"]
        assert found["moment"] == pytest.approx(np.nanmax(x.moment))


def test_the_order_of_a_stack_is_advised_where_another_one_bends_less() -> None:
    """Nothing is said where the bolt has the best order, in either direction along it."""
    best = da.pin(da.statics(hung(STACK)), "A").best
    said = f"A: least bending with the links in the order {', '.join(best)}."
    worse = [best[1], best[0], best[2]]
    for order, told in ((best, False), (best[::-1], False), (worse, True)):
        r = da.statics(hung({**STACK, "layers": [0, 0.02, 0.04], "stack": [*order]}))
        assert (said in da.pins(r).text()) is (told and da.pin(r, "A").best == best)
        assert ("least bending" in da.pins(r).text()) is told


def test_bolts_are_asked_for_by_name_or_all_at_once() -> None:
    r = da.statics(hung(STACK, STACK))
    assert [*da.pins(r).bolts] == ["A", "B"]
    assert [*da.pins(r, "B").bolts] == ["B"]
    assert [*da.pins(r, ["B", "A"]).bolts] == ["B", "A"]
    with pytest.raises(da.ModelError, match="unknown joint 'C'; choose among P, Q, A, B"):
        da.pin(r, "C")
    bare = da.statics(da.slider_crank())
    with pytest.raises(da.ModelError, match="no joint has a bolt; add pin"):
        da.pins(bare)
