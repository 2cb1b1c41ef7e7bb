"""Limits of brakes, of planes that turn, of power that goes round and of freedoms: by integrals and by hand."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane
from dalembert.analysis.degree_of_freedom import Mobility, check_drives, check_knowns
from dalembert.analysis.methods.power_flow import MORE, PowerFlow
from dalembert.core.elements.rope_bends import bend_factor
from dalembert.core.elements.turning_frame import centrifugal, second_moment, turning_square
from dalembert.core.forcing import TurningFrame, WrenchSource
from dalembert.core.layout import Pose
from dalembert.core.rank import Rank
from dalembert.errors import ModelError
from dalembert.model import Shoe
from dalembert.model.space_checks import ROUNDED, impossible

PI = math.pi


def shoe(**keys: Any) -> Shoe:
    return Shoe.model_validate(
        {"type": "shoe", "links": ("drum", "lever"), "at": ("O", "Q"), "radius": 0.15} | keys
    )


@pytest.mark.parametrize("pressure", ["pinned", "cosine"])
@pytest.mark.parametrize(
    ("begin", "end"), [(0.0, 2.2), (0.3, 1.2), (1.8, 3.0), (0.5, PI), (PI / 2, 2.0), (0.4, PI / 2)]
)
def test_a_long_lining_presses_as_the_sum_of_its_parts(pressure: str, begin: float, end: float) -> None:
    """Integrals of p/p_m by small steps: sin th over its largest, or the cosine from the middle; resultant, torque."""
    s = shoe(**{"from": begin, "to": end, "pressure": pressure, "width": 0.03})
    angle = begin + (np.arange(4000) + 0.5) * (end - begin) / 4000
    p = np.sin(angle) if pressure == "pinned" else np.cos(angle - (begin + end) / 2)
    step = (end - begin) / 4000
    along, across, rim = ((p * x).sum() * step for x in (np.cos(angle), np.sin(angle), 1.0))
    assert s.parts == pytest.approx((along, across), rel=1e-6, abs=1e-7)
    assert s.rim == pytest.approx(rim, rel=1e-6)
    size = math.hypot(along, across)
    assert s.friction_arm == pytest.approx(0.15 * rim / size, rel=1e-6)
    for internal, sign in ((False, 1.0), (True, -1.0)):
        for side in (1.0, -1.0):
            inner = shoe(**{"from": begin, "to": end, "pressure": pressure, "internal": internal})
            found = inner.load_direction(side)
            assert found == pytest.approx(
                (sign * along / size, sign * side * across / size), rel=1e-6, abs=1e-7
            )
    peak = p.max() if pressure == "pinned" else 1.0
    assert s.peak == pytest.approx(peak, abs=1e-3)
    assert s.area == pytest.approx(0.03 * 0.15 * size / s.peak, rel=1e-6)
    assert s.lining_area == pytest.approx((end - begin) * 0.15 * 0.03)


def test_a_lining_at_a_point_presses_there() -> None:
    s = shoe()
    assert (s.parts, s.rim, s.peak, s.half, s.middle, s.lining_area) == ((1.0, 0.0), 1.0, 1.0, 0.0, 0.0, 0.0)
    assert s.load_direction(1.0) == (1.0, 0.0)
    assert s.friction_arm == 0.15
    assert math.isnan(s.area)
    assert math.isnan(shoe(to=1.0).area)
    assert s.reach == 0.15


@pytest.mark.parametrize(
    ("keys", "fits"),
    [
        ({"from": 0.0, "to": PI}, True),
        ({"from": -1e-6, "to": 1.0}, False),
        ({"from": 0.5, "to": PI + 1e-6}, False),
        ({"from": 1.0, "to": 1.0}, False),
        ({"from": 1.0, "to": 0.5}, False),
        ({"from": 1.0, "to": 1.001}, True),
        ({"from": -1.0, "to": 2.1, "pressure": "cosine"}, True),
        ({"from": -1.0, "to": 2.2, "pressure": "cosine"}, False),
        ({"from": 0.5}, False),
        ({"from": 0.0}, True),
        ({"from": 0.0, "to": 6.3, "pressure": "cosine"}, False),
    ],
)
def test_a_lining_lies_where_it_can_press(keys: dict[str, Any], fits: bool) -> None:
    if fits:
        assert shoe(**keys).begin == keys["from"]
    else:
        with pytest.raises(ModelError):
            shoe(**keys)


def test_a_pinned_lining_that_is_too_long_is_told_at_the_end_that_is_beyond() -> None:
    for begin, end, key in ((-1e-6, 1.0, "from"), (0.0, PI + 1e-6, "to"), (0.5, PI + 1e-6, "to")):
        with pytest.raises(ModelError, match="presses from 0 to 180 deg") as said:
            shoe(**{"from": begin, "to": end})
        assert said.value.path[-1] == key


def test_no_body_has_an_inertia_above_the_sum_of_the_others() -> None:
    for off, bad in ((0.0, False), (0.9 * ROUNDED, False), (1.2 * ROUNDED, True)):
        high = 3.0 / (1 - off)
        assert impossible((1.0, high, 2.0)) is bad
        assert impossible(((1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, high))) is bad
    assert not impossible(5.0)
    assert impossible((0.0, 0.0, 1.0))
    assert not impossible((0.0, 1.0, 1.0))
    assert impossible(((2.0, 2.5, 0.0), (2.5, 2.0, 0.0), (0.0, 0.0, 3.0)))  # -0.5, 4.5 and 3


def flow(sources: dict[str, list[float]], links: dict[str, list[float]], **more: Any) -> PowerFlow:
    """Powers of sources and links, with those through joints and meshes."""
    every = (sources, more.get("through", {}), links, more.get("meshes", {}))
    numbers = [{n: np.array(v) for n, v in some.items()} for some in every]
    count = len(next(iter(sources.values())))
    return PowerFlow(SimpleNamespace(status=("ok",) * count), *numbers)  # type: ignore[arg-type]


def test_power_goes_round_where_a_link_carries_more_than_is_put_in() -> None:
    f = flow(
        {"motor": [100.0, -20.0, 0.0], "load": [-90.0, 50.0, 0.0]},
        {"a": [100 * (1 + 0.9e-9), 80.0, 0.0], "b": [30.0, 10.0, 0.0]},
        through={"A": [[10.0, 8.0], [5.0, 5.0], [0.0, 0.0]]},
    )
    assert f.input.tolist() == [100.0, 50.0, 0.0]
    assert f.output.tolist() == [90.0, 20.0, 0.0]
    assert f.lost.tolist() == [2.0, 0.0, 0.0]
    assert f.circulating.tolist() == [0.0, 30.0, 0.0]
    assert f.rolling.tolist() == [0.0, 0.0, 0.0]
    teeth = flow({"motor": [100.0]}, {"a": [100.0]}, meshes={"g": [40.0], "h": [70.0]})
    assert teeth.rolling.tolist() == [70.0]
    over = flow({"motor": [100.0]}, {"a": [100 * (1 + 1.1e-9)]})
    assert over.circulating == pytest.approx([1.1e-7])
    assert pytest.approx(1e-9) == MORE - 1


def frame(axis: tuple[float, float], square: float, moments: Any, driven: int = -1) -> TurningFrame:
    """A plane that turns about a line, with an effort of 0.75 given where its speed is not."""
    numbers = (np.array(x, float) for x in (axis, [0.5, -0.25], [square], moments, [0.75]))
    return TurningFrame(*numbers, driven)  # type: ignore[arg-type]


@pytest.mark.parametrize("axis", [(0.0, 1.0), (1.0, 0.0), (0.6, -0.8)])
def test_what_turns_with_a_plane_is_pulled_outward_as_the_sum_of_its_points(
    axis: tuple[float, float],
) -> None:
    """Three points of a link, anywhere: m W^2 x each; force, moment about the link's reference, second moment."""
    rng = np.random.default_rng(3)
    mass, at = np.array([1.0, 2.0, 0.5]), rng.normal(size=(3, 2))
    total = mass.sum()
    center = mass @ at / total
    off = at - center
    moments = [
        [(mass * off[:, 0] ** 2).sum(), (mass * off[:, 1] ** 2).sum(), (mass * off[:, 0] * off[:, 1]).sum()]
    ]
    inertia: Any = SimpleNamespace(mass=np.array([total]), center=center[None])
    turns = SimpleNamespace(angular=np.array([True]))
    layout: Any = SimpleNamespace(links=1, algebra=plane, length=1.0, freedoms=turns, driven=np.array([0]))
    turn = np.array([0.7, 0.0])
    pose = Pose(np.array([[1.5, -0.5], [0.0, 0.0]]), turn, plane.rotation(turn))
    f = frame(axis, 9.0, moments)
    found = centrifugal(layout, inertia, f, pose, f.square).wrench[0, 0]
    c, s = math.cos(0.7), math.sin(0.7)
    arms = at @ np.array([[c, s], [-s, c]])
    outward = np.array([axis[1], -axis[0]])
    x = (pose.point[0] + arms - f.at) @ outward
    forces = 9.0 * (mass * x)[:, None] * outward
    moment = (arms[:, 0] * forces[:, 1] - arms[:, 1] * forces[:, 0]).sum()
    assert found == pytest.approx([*forces.sum(axis=0), moment])
    assert second_moment(layout, inertia, f, pose) == pytest.approx((mass * x * x).sum())
    assert turning_square(layout, SimpleNamespace(turning=f), pose, np.zeros(0), {}) is f.square  # type: ignore[arg-type]
    twist = np.array([[[0.3, -0.4, 0.9], [0.0, 0.0, 0.0]]])
    load = WrenchSource(np.array([0]), np.array([[2.0, -5.0, 1.5]]))
    driven = frame(axis, math.nan, moments, 0)
    forcing: Any = SimpleNamespace(turning=driven, inertia=inertia)
    (square,) = turning_square(layout, forcing, pose, twist, {"force": load, "turning": load})
    power = load.wrench[0] @ twist[0, 0] + square / 9.0 * found @ twist[0, 0] + 0.75
    assert power == pytest.approx(0.0, abs=1e-12)


def test_the_strength_of_a_bent_rope_is_one_without_ropes() -> None:
    none: Any = SimpleNamespace(constraints=SimpleNamespace(families=[]))
    pose: Any = None
    mu = np.array([0.3, 0.0])
    assert bend_factor(none, pose, mu, np.zeros((2, 2), int), np.ones(2), np.full(2, PI)).tolist() == [
        1.0,
        1.0,
    ]


def counted(freedoms: int, drives: int, loose: list[bool], free: list[bool]) -> str:
    names = tuple(f"d{k}" for k in range(drives))
    c: Any = SimpleNamespace(
        schedule=SimpleNamespace(names=names),
        links=("a", "b"),
        freedoms=[(f"J{k}", "turn") for k in range(len(free))],
    )
    ranked = Rank(freedoms, 0, np.zeros(0, bool), np.array(loose), np.array(free))
    try:
        check_drives(c, ranked, Mobility(freedoms, drives, 0, ()))
    except ModelError as error:
        return f"{error.what} | {error.remedy}"
    return ""


def test_drives_are_as_many_as_freedoms() -> None:
    assert counted(1, 1, [False, False], [False]) == ""
    assert counted(2, 2, [False, False], [False]) == ""
    assert counted(1, 2, [False, False], [False]) == (
        "the mechanism has 1 degree of freedom and 2 drives | remove 1 drive of d0, d1"
    )
    none = counted(0, 2, [False, False], [False])
    assert none.endswith("no degree of freedom and 2 drives | remove 2 drives of d0, d1")
    assert counted(1, 0, [True, False], [True, False]) == (
        "the mechanism has 1 degree of freedom and no drive | add 1 drive at one of J0 (turn), "
        "or constrain the links that can still move: a"
    )
    two = counted(2, 0, [True, True], [True, True])
    assert (
        "add 2 drives at some of J0 (turn), J1 (turn), or constrain the links that can still move: a, b"
        in two
    )
    wrong_place = counted(1, 1, [False, True], [False, True])
    assert wrong_place.endswith(
        "add 1 drive at one of J1 (turn), or constrain the links that can still move: b"
    )
    many = counted(1, 0, [True, True], [True] * 8)
    assert "at one of J0 (turn), J1 (turn), J2 (turn), J3 (turn), J4 (turn), J5 (turn), or" in many
    assert "add 1 drive, or constrain" in counted(1, 0, [True, False], [])


def known(requested: list[bool], loads: int, start: bool = False, drives: int = 2) -> str:
    c: Any = SimpleNamespace(
        known=SimpleNamespace(requested=np.array(requested, bool)), unknown_loads=("P", "Q", "R")[:loads],
        mechanism=SimpleNamespace(start=start), schedule=SimpleNamespace(names=("d0", "d1")[:drives]),
    )  # fmt: skip
    try:
        check_knowns(c)
    except ModelError as error:
        return f"{error.what} | {error.remedy}"
    return ""


def test_a_given_effort_stands_for_every_unknown_load() -> None:
    assert known([True, True], 0) == known([False, True], 1) == known([False, False], 2) == ""
    assert known([False, True], 0).startswith(
        "1 drive effort is given but no load is unknown | make 1 load unknown (`value: unknown` with a direction)"
    )
    both = known([False, False], 0)
    assert both.startswith("2 drive efforts are given but no load is unknown | make 2 loads unknown")
    assert "simulate" in known([False, True], 0, True)
    assert "simulate" not in known([False, True], 0)
    assert known([True, True], 1) == (
        "1 load is unknown but no drive effort is given | give the effort of 1 drive or the values of the loads"
    )
    three = known([False, True], 3)
    assert three.startswith("3 loads are unknown but 1 drive effort is given | give the effort of 2 drives")
    assert "a structure holds any load" in known([], 1, drives=0)


def test_mobility_in_words() -> None:
    assert Mobility(0, 0, 0, ()).sentence == "mobility 0, driven by no drive, no redundant constraint"
    assert Mobility(2, 2, 1, ("A",)).sentence == (
        "mobility 2, driven by 2 drives, 1 redundant constraint among joints A"
    )
    assert Mobility(1, 1, 2, ("A", "B")).sentence.endswith("2 redundant constraints among joints A, B")
    assert Mobility(1, 1, 0, (), ("rod",)).sentence.endswith("; rod could spin between ball joints: no spin")
