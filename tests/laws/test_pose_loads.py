"""Loads that depend on the position of the machine: as the same loads in numbers at each position, and as springs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model import Expression
from tests.random_mechanisms import random_case
from tests.random_space import random_case as random_in_space
from tests.random_space import tree as space_tree
from tests.tiers import tiers


def coordinates(m: da.Mechanism, r: Any) -> dict[str, Any]:
    """Every coordinate of a result by its name."""
    found = {
        f"joints.{n}.{f}": r.freedom(n, f)[0] for n, j in m.joints.items() if not j.ball for f in j.freedoms
    }
    plane = m.dimension == 2
    return found | ({f"links.{n}.angle": r.angle(n) for n in r.links} if plane else {})


def same(a: Any, b: Any) -> None:
    for x, y in (
        (a.effort_array, b.effort_array),
        (a.force_array, b.force_array),
        (a.moment_array, b.moment_array),
    ):
        assert x == pytest.approx(y, rel=1e-9, abs=1e-9 * np.nanmax(np.abs(b.force_array)), nan_ok=True)


def loaded(tree: Any, link: str, value: object) -> da.Mechanism:
    """The mechanism with one couple more."""
    axis = {"direction": [0, 0, 1]} if tree.get("space") == "space" else {}
    couple = {"type": "couple", "on": link, "value": value, **axis}
    return da.mechanism({**tree, "loads": {**tree.get("loads", {}), "by_pose": couple}})


@pytest.mark.parametrize("seed", tiers(range(4), range(4, 30), range(30, 400)))
@pytest.mark.parametrize("where", ["plane", "space"])
def test_a_load_that_goes_by_the_pose_is_its_value_there(where: str, seed: int) -> None:
    tree = random_case(seed).tree if where == "plane" else space_tree(random_in_space(seed))
    m = da.mechanism(tree)
    r = da.dynamics(m, method="careful")
    at = coordinates(m, r)
    link, names = (
        r.links[seed % len(r.links)],
        sorted(n for n in at if all(p.isidentifier() for p in n.split("."))),
    )
    one, other = (names[(seed * k) % len(names)] for k in (1, 3))
    text = f"2*sin({one}) - 3*{other}^2"
    found = da.dynamics(loaded(tree, link, text), method="careful")
    # at its own coordinates: an angle that a load reads is counted from the assembly, whole turns included
    values = np.ravel(Expression(text).at(coordinates(m, found)))
    for k, value in list(enumerate(values))[:: max(len(values) // 2, 1)]:
        alone = da.dynamics(loaded(tree, link, float(value)), method="careful")
        for mine, other_ in (
            (found.effort_array, alone.effort_array),
            (found.force_array, alone.force_array),
        ):
            size = np.nanmax(np.abs(alone.force_array[k]), initial=1e-3)
            assert mine[k] == pytest.approx(other_[k], rel=1e-8, abs=1e-8 * size, nan_ok=True)


SLIDER = {
    "links": {
        "ground": {"points": {"O": [0, 0]}},
        "crank": {"points": {"O": [0, 0], "A": [0.3, 0]}, "mass": 2, "inertia": 0.1},
        "rod": {"points": {"A": [0, 0], "B": [1, 0]}, "mass": 1, "center": [0.4, 0], "inertia": 0.2},
        "block": {"points": {"B": [0, 0]}, "mass": 3},
    },
    "joints": {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "A": {"type": "pin", "links": ["crank", "rod"]},
        "B": {"type": "pin", "links": ["rod", "block"]},
        "guide": {"type": "slider", "links": ["ground", "block"], "at": ["O", "B"], "direction": 0},
    },
    "drives": {"O": {"position": {"from": 10, "to": 370, "count": 36}, "speed": "9 rad/s"}},
    "assembly": {"rod": 0, "block": 0},
}
SPRING = {"type": "spring", "between": ["ground.O", "block.B"], "stiffness": 500, "free_length": 0.4}
PUSH = {"type": "force", "on": "block", "at": "B", "direction": 0, "value": "500*(0.4 - joints.guide.slide)"}
TURN = {"type": "torsion_spring", "joint": "A", "stiffness": 20, "free_angle": 0}
COUPLES = {
    "on_rod": {"type": "couple", "on": "rod", "value": "20*(links.crank.angle - links.rod.angle)"},
    "on_crank": {"type": "couple", "on": "crank", "value": "20*joints.A.turn"},
}


def machine(loads: Any, **more: Any) -> da.Mechanism:
    return da.mechanism({**SLIDER, **more, "loads": loads})


@pytest.mark.parametrize("method", ["auto", "careful"])
@pytest.mark.parametrize("rubs", [False, True])
def test_a_force_that_goes_by_a_slide_is_a_spring(method: Any, rubs: bool) -> None:
    joints = dict(SLIDER["joints"])
    if rubs:
        joints["guide"] = {**joints["guide"], "friction": {"coefficient": 0.1}}
    a, b = (machine({"F": load}, joints=joints) for load in (PUSH, SPRING))
    same(da.dynamics(a, method=method), da.dynamics(b, method=method))


def test_lifted_into_space_it_is_a_spring_too() -> None:
    found = [
        da.dynamics(da.lifted(machine({"F": load}), {}, {"A": "spherical", "B": "cylindrical"}))
        for load in (PUSH, SPRING)
    ]
    assert found[0].effort("O") == pytest.approx(found[1].effort("O"), rel=1e-9, abs=1e-9)


def test_couples_that_go_by_angles_are_a_torsion_spring() -> None:
    same(da.dynamics(machine(COUPLES)), da.dynamics(machine({"k": TURN})))


def test_a_table_against_an_angle_is_that_against_the_drive_that_turns_it() -> None:
    table = {"x": [0, 90, 200], "y": [1, 5, 2], "periodic": True}
    found = [
        da.dynamics(machine({"F": {**PUSH, "value": {**table, "against": against}}}))
        for against in ("O", "links.crank.angle", "joints.O.turn")
    ]
    same(found[1], found[0])
    same(found[2], found[0])


def test_equilibria_under_loads_that_go_by_the_pose() -> None:
    drives = {"O": {"position": "unknown", "effort": 0, "range": [10, 350]}}
    a, b = (da.statics(machine({"F": load}, drives=drives)) for load in (PUSH, SPRING))
    assert a.drive_position("O") == pytest.approx(b.drive_position("O"), rel=1e-9)
    assert a.stability == b.stability


def test_the_kernel_has_their_exact_derivatives() -> None:
    vary = ["links.rod.points.B.0", "links.crank.points.A.0", "links.rod.mass"]
    a, b = (
        da.compile(machine({"F": load}), vary, outputs=["effort.O"], derivatives=True)()
        for load in (PUSH, SPRING)
    )
    assert a.effort("O") == pytest.approx(b.effort("O"), rel=1e-10, abs=1e-9)
    assert a.gradient("effort.O") == pytest.approx(b.gradient("effort.O"), rel=1e-9, abs=1e-7)
    assert "joints" not in da.compile(machine({"F": PUSH}), vary, outputs=["effort.O"]).to_c()
    k = da.compile(
        machine({"F": {**PUSH, "value": {"against": "joints.guide.slide", "x": [0, 2], "y": [200, -800]}}}),
        vary[2:],
    )
    assert k().effort("O") == pytest.approx(b.effort("O"), rel=1e-10, abs=1e-9)
    positions = np.radians([[33.0], [77.0]])
    assert k(positions=positions).effort("O")[0] == pytest.approx(
        da.compile(machine({"F": SPRING}), vary[2:])(positions=positions).effort("O")[0], rel=1e-10
    )


def test_the_kernel_has_the_derivatives_of_a_table_over_what_a_number_moves() -> None:
    table = {"against": "joints.guide.slide", "x": [0, 2], "y": [200, -800], "times": 2}
    m, spring = machine({"F": {**PUSH, "value": table}}), machine({"F": {**SPRING, "stiffness": 1000}})
    vary = ["links.rod.points.B.0", "links.crank.points.A.0"]
    a, b = (da.compile(x, vary, outputs=["effort.O"], derivatives=True)() for x in (m, spring))
    assert a.gradient("effort.O") == pytest.approx(b.gradient("effort.O"), rel=1e-9, abs=1e-7)
    k = da.compile(m, ["loads.F.value.times"], outputs=["effort.O"], derivatives=True)()
    plain = da.statics(
        machine({"F": {**PUSH, "value": {**table, "times": 1}}}),
    ).effort("O")
    assert k.gradient("effort.O")[0, :, 0] == pytest.approx(plain, rel=1e-9, abs=1e-9)


def test_a_load_goes_by_the_time_of_a_law() -> None:
    law = {"type": "cycloidal", "from": 0, "to": 90, "duration": 2, "count": 21}
    drives = {"O": {"law": law}}
    m = machine({"F": {**PUSH, "value": "30*time"}}, drives=drives)
    times = m.schedule().time
    for k in (3, 17):
        constant = da.dynamics(machine({"F": {**PUSH, "value": float(30 * times[k])}}, drives=drives))
        assert da.dynamics(m).effort("O")[k] == pytest.approx(constant.effort("O")[k], rel=1e-12)
    table = {"against": "time", "x": [0, 2], "y": [0, 60]}
    same(da.dynamics(machine({"F": {**PUSH, "value": table}}, drives=drives)), da.dynamics(m))
    assert da.compile(m, ["links.rod.mass"])().effort("O")[0] == pytest.approx(
        da.dynamics(m).effort("O"), rel=1e-9
    )


REFUSED = {
    "links.rodd.angle": "load 'F' names the link 'rodd', which does not exist; did you mean 'rod'?",
    "links.ground.angle": "load 'F' uses 'links.ground.angle', which does not turn; write joints.NAME.turn",
    "joints.guid.slide": "load 'F' uses the joint 'guid', which does not exist; did you mean 'guide'?",
    "joints.guide.turn": "load 'F' uses 'joints.guide.turn', and the freedoms of that joint are slide; name one",
    "P.speed": "load 'F' uses 'P.speed', which is not a drive; the only one is 'O'",
    "links.rod.speed": "uses 'links.rod.speed', which is not a drive; the speed of an angle is angle.rod.speed",
    "joints.A.speed": "load 'F' uses 'joints.A.speed', and the freedoms of that joint are turn; name one",
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_load_cannot_go_by_is_refused(name: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        machine({"F": {**PUSH, "value": f"3*{name}"}})
    assert REFUSED[name] in str(caught.value)


def test_a_load_by_time_needs_a_law_or_a_speed() -> None:
    with pytest.raises(
        da.ModelError, match="depends on time, but no drive has a law of motion or a speed; give"
    ):
        machine({"F": {**PUSH, "value": "3*time"}}, drives={"O": {"position": [10, 20]}})


def test_an_effort_goes_by_drives_only() -> None:
    drives = {"O": {**SLIDER["drives"]["O"], "effort": "joints.guide.slide"}}
    with pytest.raises(da.ModelError, match="an effort depends on drives, their speeds and time"):
        machine({"F": {**PUSH, "value": "unknown"}}, drives=drives)


@pytest.mark.parametrize(
    "text", ["-50*slide.guide.speed", "9 N*s*turn.A.speed", "2*angle.rod.speed*angle.rod - O.speed"]
)
@pytest.mark.parametrize("copy", [{"mirror": 90}, {"count": 2, "phase": {"ground": [0, 90]}}])
def test_a_copy_has_loads_by_its_own_speeds(text: str, copy: Any) -> None:
    copies = [{"of": ["crank", "rod", "block"], **copy}]
    m = machine({"F": {**PUSH, "value": text}}, copies=copies)
    value: Any = m.loads["F_2"].value  # type: ignore[union-attr]
    assert all("_2" in name for name in value.names)
    r = da.dynamics(m)
    assert np.abs(r.effort("O_2")) == pytest.approx(np.abs(r.effort("O")), rel=1e-9, abs=1e-9)
