"""Free bodies, superposition, virtual work, equilibria, unknown loads and what is refused, in space."""

from __future__ import annotations

import copy
import json
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.grading.file_answers import check
from tests.oracles.space.machines import EXAMPLES
from tests.space.machines import oracle, rssr
from tests.tiers import crossed, tiers


@crossed("name, solve", EXAMPLES, [da.statics, da.dynamics])
def test_free_bodies_balance(name: str, solve: Any) -> None:
    r = solve(oracle(name))
    everything = actions(r)
    largest = max(np.abs(a.force).max() for a in everything)
    for link in r.links:
        some = [a for a in everything if a.link == link]
        middle = r.center(link)
        assert np.abs(sum(a.force for a in some)).max() < 1e-13 * largest
        moment = np.abs(sum(a.moment(middle) for a in some)).max()
        assert moment < 1e-12 * largest * r.compiled.layout.length


@crossed("name, solve", EXAMPLES, [da.statics, da.dynamics])
def test_superposition_and_virtual_work_give_the_same(name: str, solve: Any) -> None:
    r = solve(oracle(name))
    assert np.max(da.superposition(r).gap) < 1e-12
    assert np.max(da.virtual_work(r).gap) < 1e-12


def test_parts_of_a_superposition_are_the_loads_alone() -> None:
    m = oracle("rsur")
    parts = da.superposition(da.statics(m))
    alone = m.with_values({"gravity": None, "loads": {"F0 rod": m.loads["F0 rod"]}})
    r = da.statics(alone)
    assert parts.effort("O")["F0 rod"] == pytest.approx(r.effort("O"), abs=1e-12)
    for joint in r.joints:
        assert parts.reaction(joint)["F0 rod"] == pytest.approx(r.reaction(joint), abs=1e-11)
        assert parts.reaction_moment(joint)["F0 rod"] == pytest.approx(r.reaction_moment(joint), abs=1e-11)


def test_a_link_as_a_force_system_is_in_equilibrium() -> None:
    r = da.dynamics(oracle("double_cardan"))
    for link in r.links:
        system = da.wrench.on(r, link, at=3)
        assert system.dimension == 3
        assert system.equilibrium().holds


def test_classes_and_order_of_solution() -> None:
    """Without weight the rod between two balls is a two-force link; without it rod and rocker go together."""
    m = rssr(gravity=None)
    r = da.statics(m)
    found = da.members(r)
    assert found["rod"].kind == "two-force"
    along = r.point("rod", "B") - r.point("rod", "A")
    pull = (r.reaction("B", on="rod") * along).sum(axis=1) / np.linalg.norm(along, axis=1)
    assert found["rod"].tension == pytest.approx(pull)
    steps = [step.why for step in da.order_of_solution(r)]
    assert steps == [
        "rocker: 6 equations, 6 unknowns in the line of rod, C",
        "crank: 6 equations, 6 unknowns in O, torque O",
    ]
    whole = [step.why for step in da.order_of_solution(da.dynamics(rssr()))]
    assert whole == [
        "rod and rocker together: 11 equations, 11 unknowns in A, B, C",
        "crank: 6 equations, 6 unknowns in O, torque O",
    ]


# unknowns


@pytest.mark.parametrize(
    "load",
    [
        {"type": "couple", "on": "rocker", "direction": [1, 2, -1], "value": "unknown"},
        {"type": "couple", "on": "rocker", "direction": [1, 2, -1], "axes": "link", "value": "unknown"},
        {"type": "force", "on": "rod", "at": "B", "direction": [1, 2, -1], "value": "unknown"},
        {
            "type": "force",
            "on": "rod",
            "at": "center",
            "direction": [3, 2, 1],
            "axes": "link",
            "value": "unknown",
        },
    ],
)
def test_an_unknown_load_balances_the_given_effort(load: dict[str, Any]) -> None:
    tree = rssr(**{"drives.O.position": (0.4, 1.0, 3.0)}).to_tree()
    tree["drives"]["O"]["effort"] = "0.3 N*m"
    tree["loads"] = {"F": load}
    r = da.dynamics(da.mechanism(tree))
    assert r.ok.all()
    assert np.max(da.virtual_work(r).gap) < 1e-12
    assert np.max(da.superposition(r).gap) < 1e-12
    for k, value in enumerate(r.unknown_load("F")):
        known = copy.deepcopy(tree)
        del known["drives"]["O"]["effort"]
        known["loads"]["F"]["value"] = f"{float(value)!r} {'N' if load['type'] == 'force' else 'N*m'}"
        again = da.dynamics(da.mechanism(known))
        assert again.effort("O")[k] == pytest.approx(0.3, rel=1e-9)


PENDULUM: dict[str, Any] = {
    "space": "space",
    "gravity": "standard",
    "links": {
        "ground": {"points": {"O": [0, 0, 0]}},
        "arm": {"points": {"O": [0, 0, 0]}, "mass": 2, "center": [0.3, 0, 0]},
    },
    "joints": {"O": {"type": "revolute", "links": ["ground", "arm"], "axis": [0, 1, 1]}},
    "drives": {"O": {"position": "unknown", "effort": 0}},
}


def test_equilibria_of_a_pendulum_on_an_inclined_axis() -> None:
    r = da.solve(da.mechanism(PENDULUM))
    assert r.drive_position("O") == pytest.approx([np.pi / 2, 3 * np.pi / 2], abs=1e-12)
    assert r.stability == ("stable", "unstable")
    assert r.center("arm")[0] == pytest.approx([0, 0.3 / np.sqrt(2), -0.3 / np.sqrt(2)], abs=1e-12)
    assert r.reaction_moment("O")[0] == pytest.approx([2 * 9.80665 * 0.3 / np.sqrt(2), 0, 0])
    records = r.to_dict()["positions"]
    assert [record["stability"] for record in records] == ["stable", "unstable"]
    assert len(records[0]["rotation"]["arm"]) == 3


@pytest.mark.parametrize(
    ("sense", "found"), [(1, [np.pi / 3, 2 * np.pi / 3]), pytest.param(-1, [], marks=pytest.mark.long)]
)
def test_a_jump_through_the_given_effort_is_no_equilibrium(sense: int, found: list[float]) -> None:
    """The weight needs -w cos q, and w/2 is given that changes its sense at 2 rad."""
    tree = copy.deepcopy(PENDULUM)
    w = 2 * 9.80665 * 0.3 / np.sqrt(2)
    tree["drives"]["O"] |= {"effort": f"{sense * w / 2}*sign(O - 2) N*m", "range": [0, 180]}
    r = da.solve(da.mechanism(tree))
    assert r.drive_position("O")[np.isfinite(r.effort("O"))] == pytest.approx(found, abs=1e-12)


def test_an_effort_that_nothing_balances_has_no_numbers() -> None:
    tree = copy.deepcopy(PENDULUM)
    tree["drives"]["O"]["effort"] = 100
    r = da.solve(da.mechanism(tree))
    assert r.status == ("no_balance",)
    record = json.loads(json.dumps(r.to_dict(), allow_nan=False))["positions"][0]
    assert record["reaction"]["O"] == [None, None, None]
    assert record["rotation"]["arm"] == [[None] * 3] * 3


def test_equilibria_of_a_spring_in_a_loop_are_stationary_energy() -> None:
    """The sprung spatial four-bar rests where the energy of spring and weights is stationary."""
    tree = rssr().to_tree()
    tree["drives"]["O"] = {"position": "unknown", "effort": 0}
    tree["loads"] = {
        "coil": {"type": "torsion_spring", "joint": "C", "stiffness": "3 N*m/rad", "free_angle": "0.2 rad"}
    }
    r = da.solve(da.mechanism(tree))
    assert r.ok.all()

    def energy(q: Any) -> Any:
        moved = da.kinematics(da.mechanism(tree).with_values({"drives": {"O": da.Drive(position=q)}}))
        heights = sum(r.mechanism.mass(link) * 9.80665 * moved.center(link)[:, 2] for link in r.links)
        return heights + 1.5 * (moved.freedom("C", "turn")[0] - 0.2) ** 2

    h = 1e-4
    for q, kind in zip(r.drive_position("O"), r.stability or (), strict=True):
        low, here, high = energy((q - h, q, q + h))
        assert abs(high - low) / (2 * h) < 1e-6
        assert (high - 2 * here + low > 0) == (kind == "stable")


# resistances in turns


def sprung(**loads: Any) -> Any:
    tree = copy.deepcopy(EXAMPLES["double_cardan"].tree)
    tree["drives"]["O"]["position"] = {"from": 10, "to": 730, "count": 1441}
    tree["gravity"] = "none"
    tree["loads"] = loads
    return tree


def test_torsion_springs_wind_up_over_several_turns() -> None:
    """An undriven shaft that turns twice: effort is the slope of the springs' energy, whole turns included."""
    tree = sprung(
        coil={"type": "torsion_spring", "joint": "E", "stiffness": 3, "free_angle": 20},
        one={"type": "torsion_spring", "joint": "U1", "freedom": "turn1", "stiffness": 2},
        two={"type": "torsion_spring", "joint": "U1", "freedom": "turn2", "stiffness": 5},
    )
    r = da.statics(da.mechanism(tree))
    shaft, one, two = (r.freedom(*of)[0] for of in (("E", "turn"), ("U1", "turn1"), ("U1", "turn2")))
    assert shaft[-1] - shaft[0] == pytest.approx(4 * np.pi, rel=0.01)
    assert np.abs(np.diff(shaft)).max() < 0.05
    energy = 1.5 * (shaft - np.radians(20)) ** 2 + one**2 + 2.5 * two**2
    q = r.drive_position("O")
    slope = (8 * (energy[3:-1] - energy[1:-3]) - (energy[4:] - energy[:-4])) / (12 * (q[1] - q[0]))
    assert r.effort("O")[2:-2] == pytest.approx(slope, abs=1e-5 * np.abs(slope).max())


def test_damping_of_joints_takes_the_power_that_the_drive_gives() -> None:
    tree = sprung(loss={"type": "torsion_damper", "joint": "U1", "freedom": "turn2", "damping": 0.7})
    tree["joints"]["U1"]["damping"] = {"turn1": 0.3, "turn2": 0.2}
    tree["joints"]["E"]["damping"] = {"slide": 4, "turn": 0.1}
    r = da.statics(da.mechanism(tree))
    rates = {
        of: r.freedom(*of)[1] for of in (("U1", "turn1"), ("U1", "turn2"), ("E", "slide"), ("E", "turn"))
    }
    coefficients = dict(zip(rates, (0.3, 0.9, 4.0, 0.1), strict=True))
    lost = sum(coefficients[of] * rate**2 for of, rate in rates.items())
    assert r.effort("O") * r.drive_speed("O") == pytest.approx(lost, rel=1e-11)
    assert np.max(r.power_balance) < 1e-14
    assert da.superposition(r).sources == ("loss", "damping of U1", "damping of E")
    assert np.max(da.virtual_work(r).gap) < 1e-12


# answers of a file, and a student's


ANSWERS: list[dict[str, Any]] = [
    {"quantity": "reaction", "of": "C", "axes": "joint", "at": 5},
    {"quantity": "moment", "of": "C", "axes": "link", "at": 5},
    {"quantity": "moment", "of": "C", "by": "rocker", "component": "y", "at": 5},
    {"quantity": "reaction", "of": "A", "component": "z", "extreme": "maxabs"},
    {"quantity": "reaction", "of": "A", "component": "magnitude", "extreme": "max"},
    {"quantity": "rotation", "of": "rod", "at": 5},
    {"quantity": "speed", "of": "rod", "at": 5},
    {"quantity": "speed", "of": "rod", "axes": "link", "at": 5},
    {"quantity": "point_acceleration", "of": "rod.B", "at": 5},
    {"quantity": "center_velocity", "of": "rod", "axes": "link", "at": 5},
    {"quantity": "turn_acceleration", "of": "C", "at": 5},
]


@pytest.mark.parametrize("asked", ANSWERS, ids=lambda a: f"{a['quantity']}-{a.get('axes', 'ground')}")
def test_answers_of_a_file(asked: dict[str, Any]) -> None:
    m = rssr()
    r = da.dynamics(m)
    readings: dict[str, Any] = {
        "reaction": lambda: r.reaction(asked["of"], axes=asked.get("axes", "ground")),
        "moment": lambda: r.reaction_moment(
            asked["of"], on="ground" if "by" in asked else None, axes=asked.get("axes", "ground")
        ),
        "rotation": lambda: r.rotation(asked["of"]),
        "speed": lambda: r.speed(asked["of"]),
        "point_acceleration": lambda: r.point_acceleration("rod", "B"),
        "center_velocity": lambda: r.center_velocity("rod"),
        "turn_acceleration": lambda: r.freedom("C", "turn")[2],
    }
    values = np.asarray(readings[asked["quantity"]]())
    if asked.get("axes") == "link" and asked["quantity"] in ("speed", "center_velocity"):
        values = np.einsum("pij,pi->pj", r.rotation("rod"), values)
    if "component" in asked:
        c = asked["component"]
        values = np.linalg.norm(values, axis=1) if c == "magnitude" else values[:, "xyz".index(c)]
    k = 4 if "at" in asked else int(np.argmax(np.abs(values)))
    unit = {
        "reaction": " N",
        "moment": " N*m",
        "rotation": "",
        "speed": " rad/s",
        "turn_acceleration": " rad/s^2",
    }
    text = unit.get(asked["quantity"], " m/s" if asked["quantity"] == "center_velocity" else " m/s^2")

    def written(value: Any) -> Any:
        return (
            [written(v) for v in value]
            if np.ndim(value)
            else f"{float(value)!r}{text}"
            if text
            else float(value)
        )

    right = {**asked, "value": written(values[k])}
    wrong = {**asked, "value": written(values[k] * 1.01)}
    tree = m.to_tree() | {"answers": [right, wrong]}
    rows = check(da.mechanism(tree))
    assert [row.ok for row in rows] == [True, False]
    assert (
        rows[0].published.count("[")
        == rows[0].computed.count("[")
        == (0, 1, 3)[min(np.ndim(values[k]), 2)] + (np.ndim(values[k]) == 2)
    )


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (
            {"quantity": "angle", "of": "rod", "at": 1, "value": 1},
            "link 'rod' has no single angle in space; ask its rotation",
        ),
        (
            {"quantity": "reaction", "of": "A", "at": 1, "component": "direction", "value": 1},
            "unknown component 'direction'; choose among x, y, z, magnitude",
        ),
        (
            {"quantity": "rotation", "of": "rod", "at": 1, "component": "x", "value": 1},
            "a rotation has no component 'x'; give all of it, a row each",
        ),
        (
            {"quantity": "reaction", "of": "A", "at": 1, "value": [1, 2]},
            "a vector has 2 components where 3 are needed; write [x, y, z]",
        ),
        (
            {"quantity": "speed", "of": "rod", "at": 1, "axes": "joint", "value": [1, 2, 3]},
            "joint axes mean nothing for the speed of rod; leave them out",
        ),
    ],
)
def test_answers_that_mean_nothing_in_space(answer: dict[str, Any], says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        check(da.mechanism(rssr().to_tree() | {"answers": [answer]}))
    assert str(caught.value) == says


@pytest.mark.parametrize("which", tiers([], [0, 1, 2]))
def test_slips_in_a_students_figures_are_named(which: int) -> None:
    m = rssr()
    r = da.dynamics(m)
    force = r.reaction("O")[0]
    mine = [
        da.Answer(quantity="effort", of="O", at=1, value=float(-r.effort("O")[0])),
        da.Answer(quantity="reaction", of="O", at=1, value=[float(x) for x in force[[1, 0, 2]]]),
        da.Answer(quantity="effort", of="O", at=1, value=float(da.statics(m).effort("O")[0])),
    ]
    tree = m.to_tree() | {"units": {}}
    says = [
        "the sense is opposite: action mistaken for reaction",
        "x and y are exchanged",
        "may be: inertia is left out: this is the static answer, or the speed of drive O is left out, "
        "or only the inertia of crank is counted",
    ]
    (verdict,) = da.check_answers(da.mechanism(tree), [mine[which]])
    assert verdict.mistake == says[which]


# what is for the plane only


@pytest.mark.parametrize(
    ("ask", "says"),
    [
        (
            lambda r: da.displaced_inertia(r, "rod"),
            "the displaced inertia force is for planar mechanisms, ",
        ),
        (lambda r: r.angle("rod"), "link 'rod' has no single angle in space; ask its rotation"),
    ],
)
def test_what_is_for_the_plane_only_is_refused(ask: Any, says: str) -> None:
    r = da.dynamics(rssr(**{"drives.O.position": 0.0}))
    with pytest.raises(da.ModelError) as caught:
        ask(r)
    assert says in str(caught.value)


def test_the_commands_refuse_with_one_line(capsys: pytest.CaptureFixture[str], tmp_path: Any) -> None:
    assert main(["report", str(examples()["rssr"]), "-o", str(tmp_path / "r.txt"), "--clockwise"]) == 2
    found = capsys.readouterr().err
    assert "moments cannot be counted clockwise in space" in found
    assert "Traceback" not in found
