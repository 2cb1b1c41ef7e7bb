"""Bolts: a stack of links against sums by hand, limits between one and two planes, wrong files."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.machine.elements.pin_stresses import moment_along

FORK = {"diameter": "30 mm", "eye": "40 mm", "cheeks": "22 mm", "gap": "1 mm"}


def hung(pin: dict[str, Any], second: dict[str, Any] | None = None) -> da.Mechanism:
    """Two bars from the ground meet in A, where a third link hangs with a load."""
    points = {"P": [-1, 1], "Q": [1, 2], "A": [0, 0]}
    links = {
        "ground": {"points": points},
        "left": {"points": {"P": [-1, 1], "A": [0, 0]}},
        "right": {"points": {"Q": [1, 2], "A": [0, 0]}},
        "hook": {"points": {"A": [0, 0], "H": [0, -1]}, "mass": 1, "center": [0, -1]},
    }
    joints: dict[str, Any] = {
        "P": {"type": "pin", "links": ["ground", "left"]},
        "Q": {"type": "pin", "links": ["ground", "right"]},
        "A": {"type": "pin", "links": ["left", "right"], "pin": pin},
        "B": {"type": "pin", "links": ["right", "hook"], "at": "A"},
    }
    if second:
        joints["B"]["pin"] = second
    drives = {"B": {"position": 0}}
    loads = {"F": {"type": "force", "on": "hook", "at": "A", "value": [300, -5000]}}
    tree = {
        "links": links,
        "joints": joints,
        "drives": drives,
        "loads": loads,
        "assembly": {"left": 0, "right": 0},
    }
    return da.mechanism(tree)


def test_a_stack_has_the_sums_of_the_forces_before() -> None:
    stack = {"diameter": "20 mm", "stack": ["left", "hook", "right"], "layers": ["0 mm", "18 mm", "40 mm"]}
    r = da.statics(hung(stack))
    x = da.pin(r, "A")
    left = r.reaction("A", on="left")[0]
    hook = r.reaction("B", on="hook")[0]
    assert x.planes[0] == pytest.approx([np.hypot(*left), np.hypot(*(left + hook))], rel=1e-12)
    moments = [np.hypot(*(0.018 * left)), np.hypot(*(0.040 * left + 0.022 * hook))]
    assert x.moment[0] == pytest.approx(max(moments), rel=1e-12)
    assert moments[1] > 0.01 * moments[0]  # the bars do not close the moment: the last link takes the rest
    orders = {}
    for order in (["left", "hook", "right"], ["left", "right", "hook"], ["hook", "left", "right"]):
        orders[tuple(order)] = da.pin(da.statics(hung({**stack, "stack": order})), "A").moment[0]
    assert orders[x.best] == pytest.approx(min(orders.values()), rel=1e-12)
    assert "Least bending with the links in the order" in x.text()


def test_the_ends_of_a_stack_agree_with_the_other_joint_of_the_point() -> None:
    stack = {"diameter": "20 mm", "stack": ["left", "hook", "right"], "layers": [0, 0.018, 0.04]}
    x, y = (da.pin(da.statics(hung(stack, stack)), joint) for joint in ("A", "B"))
    assert x.planes == pytest.approx(y.planes, rel=1e-12)


def test_a_fork_in_a_stack_shares_its_force_between_its_layers() -> None:
    """Two forks about an eye: half of each link's force in each of its layers."""
    forked: dict[str, Any] = {"diameter": "20 mm", "stack": ["left", "right", "hook", "right", "left"]}
    forked |= {"layers": [0, 0.012, 0.03, 0.048, 0.06], "thicknesses": [0.01, 0.01, 0.02, 0.01, 0.01]}
    r = da.statics(hung(forked))
    x = da.pin(r, "A")
    left, hook = r.reaction("A", on="left")[0], r.reaction("B", on="hook")[0]
    right = -left - hook
    halves = [np.hypot(*(left / 2)), np.hypot(*((left + right) / 2))]
    assert x.planes[0] == pytest.approx([*halves, *halves[::-1]], rel=1e-9)
    middle = 0.03 * left / 2 + 0.018 * right / 2
    assert x.moment[0] == pytest.approx(max(np.hypot(*middle), 0.012 * halves[0]), rel=1e-9)
    assert x.pressures["right"][0] == pytest.approx(np.hypot(*right) / 2 / 0.02 / 0.01, rel=1e-9)
    assert sorted(x.best) == sorted(forked["stack"])


def test_one_plane_has_twice_the_shear_of_two() -> None:
    one, two = (da.pin(da.statics(hung({**FORK, "planes": n})), "A") for n in (1, 2))
    assert one.shear == pytest.approx(2 * two.shear, rel=1e-12)
    assert one.eye_pressure == pytest.approx(two.eye_pressure, rel=1e-12)
    assert one.moment == pytest.approx(one.force * (0.011 + 0.001 + 0.02) / 2, rel=1e-12)
    strong = da.pin(da.statics(hung({**FORK, "yield_stress": "355 MPa"})), "A")
    assert strong.safety[0] == pytest.approx(
        355e6 / max(strong.bending[0], 3**0.5 * strong.peak_shear[0]), rel=1e-12
    )


def test_pressures_and_the_drawn_moment_of_a_stack() -> None:
    """Each link presses by the force on it over d t; the drawn moment has its peak at the largest of the layers."""
    stack = {"diameter": "20 mm", "stack": ["left", "hook", "right"], "layers": [0, 0.018, 0.04]}
    stack |= {"thicknesses": ["10 mm", "16 mm", "12 mm"], "allowed_pressure": "60 MPa"}
    r = da.statics(hung(stack))
    x = da.pins(r).bolts["A"]
    force = [*r.reaction("A", on="left")[0]], [*r.reaction("B", on="hook")[0]]
    third = -np.sum(force, axis=0)
    expected = [np.hypot(*f) / 0.02 / t for f, t in zip((*force, third), (0.01, 0.016, 0.012), strict=True)]
    assert [x.pressures[n][0] for n in ("left", "hook", "right")] == pytest.approx(expected, rel=1e-9)
    assert x.pressure_safety[0] == pytest.approx(60e6 / max(expected), rel=1e-9)
    for size in (stack, FORK, {**FORK, "planes": 1}):
        one = da.pin(da.statics(hung(size)), "A")
        assert moment_along(one, 0)[1].max() == pytest.approx(one.moment[0], rel=1e-3)
    assert "hook" in da.pins(r).text()
    assert len(da.pins(r).draw().items) > 10


@pytest.mark.parametrize("apart", [4, 8, 9, 10, 11, 18])
def test_the_names_of_the_layers_are_written_beside_each_other(apart: int) -> None:
    stack = {
        "diameter": "20 mm",
        "stack": ["left", "right", "hook", "right", "left"],
        "thicknesses": [0.003] * 5,
    }
    scene = da.pins(da.statics(hung(stack | {"layers": [f"{apart * k} mm" for k in range(5)]}))).draw()
    names = [t for t in scene.texts() if t.text.startswith(("left", "right", "hook"))]
    boxes = sorted((round(t.at[1], 6), t.box[0], t.box[2]) for t in names)
    assert len(boxes) == 5
    for (row, _, end), (next_row, start, _) in pairwise(boxes):
        assert row != next_row or end < start


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"eye": "40 mm"}, "the key 'diameter' is missing in pin of joint 'A'; write diameter: ..."),
    ({"diameter": 0}, "diameter of pin of joint 'A': 0 is not positive; write a positive one"),
    (
        {**FORK, "stack": ["left"]},
        "a stack needs the places of its links; write stack: [one, two, three] and layers",
    ),
    (
        {**FORK, "stack": ["left", "hook"], "layers": [1, 0]},
        "the layers do not increase; write them from one end",
    ),
    (
        {"diameter": 0.02, "stack": ["left", "hook"], "layers": [0, 0.01], "thicknesses": [0.01, 0.012]},
        "links 1 and 2 of the stack overlap",
    ),
    ({**FORK, "thicknesses": [0.01]}, "thicknesses are those of a stack; write eye and cheeks"),
    ({**FORK, "stack": ["left"], "layers": [1]}, "1 links and 1 layers do not go together; give each link"),
]


@pytest.mark.parametrize(("pin", "says"), WRONG)
def test_a_wrong_bolt_is_refused(pin: dict[str, Any], says: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        hung(pin)
    assert says in str(refused.value)


def test_a_stack_names_the_links_of_its_bolt() -> None:
    r = da.statics(hung({**FORK, "stack": ["left", "right"], "layers": [0, 0.02]}))
    with pytest.raises(
        da.ModelError, match="the bolt of 'A' carries hook, left, right, and its stack is left, right"
    ):
        da.pin(r, "A")
    with pytest.raises(da.ModelError, match="joint 'P' has no pin; give it pin"):
        da.pin(r, "P")


def test_positions_without_an_answer_leave_the_largest_of_the_others() -> None:
    """A crank so long that the linkage does not close all round: the table has the largest moment of the rest."""
    tree = da.load(examples()["four_bar"]).to_tree()
    tree["joints"]["A"]["pin"] = FORK
    tree["drives"]["O2"] |= {"position": {"from": 0, "to": 330, "count": 12}}
    r = da.dynamics(da.mechanism(tree).with_values({"links.crank.points.A": (0.25, 0.0)}))
    assert set(r.status) == {"ok", "not_assembled"}
    table = da.pins(r)
    largest = float(np.nanmax(table.bolts["A"].force)) * (0.011 + 0.001 + 0.02 / 2) / 2
    inches = largest / (4.4482216152605 * 0.0254)
    row = next(line.split() for line in table.text().splitlines() if line.startswith("A  "))
    assert float(row[7]) == pytest.approx(inches, rel=2e-4)
