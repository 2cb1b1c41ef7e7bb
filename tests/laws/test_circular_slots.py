"""A pin in a circular slot beside a light link from the slot's centre to the pin, which is the same mechanism."""

from __future__ import annotations

import math
import re
from copy import deepcopy
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.reports.sections.kinematics import acceleration_lines, loops, velocity_lines
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.scene import Circle, Polygon
from dalembert.views.space.link_solids import link_solids
from dalembert.views.space.solids import Ring
from tests.oracles.agreement import disagreement, worst
from tests.random_mechanisms import random_case
from tests.random_mechanisms.groups import ROUND
from tests.tiers import nth, over


def slots(tree: dict[str, Any]) -> list[str]:
    return [name for name, joint in tree["joints"].items() if joint["type"] == "circular_slot"]


def with_rods(tree: dict[str, Any]) -> dict[str, Any]:
    """The tree with a link and two pins in place of each circular slot."""
    made = deepcopy(tree)
    for name in slots(tree):
        joint = made["joints"].pop(name)
        (i, j), (center, pin), rod = joint["links"], joint["at"], f"rod of {name}"
        made["links"][rod] = {"points": {"C": [0, 0], "P": [joint["radius"], 0]}}
        made["joints"][f"{name} C"] = {"type": "pin", "links": [i, rod], "at": [center, "C"]}
        made["joints"][name] = {"type": "pin", "links": [rod, j], "at": ["P", pin]}
    return made


def has_slots(seed: int) -> bool:
    return bool(slots(random_case(ROUND + seed).tree))


def slotted_tree(seed: int) -> dict[str, Any]:
    """A random mechanism with circular slots, their pins not damped."""
    tree = deepcopy(random_case(ROUND + nth(seed, has_slots)).tree)
    for name in slots(tree):
        tree["joints"][name].pop("damping", None)
    return tree


def rod_angles(r: Any, tree: dict[str, Any]) -> dict[str, float]:
    """Degrees of the lines from the slots' centres to their pins at the first position."""
    out = {}
    for name in slots(tree):
        joint = r.mechanism.joints[name]
        center, pin = (
            np.asarray(u) if link == "ground" else r.position(link)[0] + r.rotation(link)[0] @ u
            for link, u in zip(joint.links, r.mechanism.joint_points(name), strict=True)
        )
        out[f"rod of {name}"] = math.degrees(math.atan2(*(pin - center)[::-1]))
    return out


@over(6, 62)
def test_every_number_is_that_of_the_lagrange_oracle(seed: int) -> None:
    """Damping in the slots' turns too."""
    case = random_case(ROUND + nth(seed, has_slots))
    r = da.dynamics(da.mechanism(case.tree))
    quantity, size = worst(disagreement(r, case.answer))
    assert size < 1e-9, quantity


@over(6, 62)
def test_a_circular_slot_is_a_light_link_from_its_center(seed: int) -> None:
    """Motion, efforts and reactions, the slot's being that of the link on its pin."""
    tree = slotted_tree(seed)
    r = da.dynamics(da.mechanism(tree))
    rods = with_rods(tree)
    rods["assembly"] |= rod_angles(r, tree)
    other = da.dynamics(da.mechanism(rods))
    assert r.ok.all()
    assert other.ok.all()
    scale = float(np.abs(r.force_array).max())
    for link in r.links:
        for read in ("position", "angle", "speed", "acceleration"):
            ours, theirs = getattr(r, read)(link), getattr(other, read)(link)
            assert ours == pytest.approx(theirs, rel=1e-10, abs=1e-10 * max(1.0, float(np.abs(ours).max())))
    for joint in r.joints:
        on = r.mechanism.joints[joint].links[1]
        assert np.abs(r.reaction(joint, on) - other.reaction(joint, on)).max() < 1e-10 * scale
    for drive in r.drives:
        assert np.abs(r.effort(drive) - other.effort(drive)).max() < 1e-10 * scale


def guided_bar(moving: bool = False, **slot: Any) -> dict[str, Any]:
    """A crank that moves a bar whose end runs in a circular slot of the ground, or of a link on a pin of its own."""
    owner = "plate" if moving else "ground"
    links = {
        "ground": {"points": {"O": [0, 0], "C": [0.2, 0.1], "Q": [0.3, 0.3]}},
        "crank": {"points": {"O": [0, 0], "A": [0.05, 0]}},
        "bar": {"points": {"A": [0, 0], "P": [0.25, 0]}, "mass": 1, "center": [0.1, 0.05], "inertia": 0.01},
    }
    joints = {
        "O": {"type": "pin", "links": ["ground", "crank"]},
        "A": {"type": "pin", "links": ["crank", "bar"]},
        "P": {"type": "circular_slot", "links": [owner, "bar"], "at": ["C", "P"], "radius": 0.15, **slot},
    }
    drives = {"O": {"position": {"from": 0, "to": 360, "count": 12}, "speed": "10 rad/s"}}
    if moving:
        links["plate"] = {"points": {"C": [0.2, 0.1], "Q": [0.3, 0.3]}, "mass": 2, "inertia": 0.02}
        joints["Q"] = {"type": "pin", "links": ["ground", "plate"]}
        drives["Q"] = {"position": {"from": 0, "to": 11, "count": 12}, "speed": "1 rad/s"}
    tree = {"links": links, "joints": joints, "drives": drives, "gravity": "standard"}
    return tree | {"assembly": {"bar": 0}}


def test_friction_in_the_pin_at_the_center_is_that_of_the_slot() -> None:
    """As the refusal says: along the slot mu times the normal force, against the pin's motion."""
    tree = with_rods(guided_bar())
    tree["joints"]["P C"]["friction"] = {"coefficient": 0.2, "radius": 0.15}
    r = da.dynamics(da.mechanism(tree | {"assembly": {"bar": 0, "rod of P": 130}}))
    assert r.ok.all()
    turn = r.angle("rod of P")
    out, along = (np.stack([np.cos(turn + x), np.sin(turn + x)], -1) for x in (0.0, np.pi / 2))
    force = r.reaction("P", "bar")
    normal, friction = (force * out).sum(-1), (force * along).sum(-1)
    assert np.abs(friction) == pytest.approx(0.2 * np.abs(normal), rel=1e-9)
    assert (friction * r.speed("rod of P") < 0).all()


def test_what_a_circular_slot_has_not() -> None:
    with pytest.raises(ModelError, match=r"with the slot's radius, is the slot's$"):
        da.mechanism(guided_bar(friction={"coefficient": 0.2}))
    with pytest.raises(ModelError, match=r"joint 'P': a circular_slot joint has no counterpart"):
        da.lifted(da.mechanism(guided_bar()))
    with pytest.raises(ModelError, match=r"the freedom of joint 'P', a circular_slot, is turn"):
        da.mechanism(guided_bar() | {"drives": {"P": {"freedom": "slide2", "position": 1}}})


@pytest.mark.parametrize("moving", [False, True])
def test_a_circular_slot_is_drawn_about_its_center(moving: bool) -> None:
    """Its edges on both sides of its middle line, its pin on that line and between its ends; in solids a ring."""
    r = da.dynamics(da.mechanism(guided_bar(moving)))
    k = 4
    scene = da.draw.mechanism(r, at=k + 1)
    per_mm = scene.scales["length"]
    (slot,) = (item for item in scene.items if isinstance(item, Polygon) and item.role == "block")
    pins = [item.center for item in scene.items if isinstance(item, Circle) and item.role == "pin"]
    pin = min(pins, key=lambda p: min(math.dist(p, q) for q in slot.points))
    center = r.position("plate")[k] + r.rotation("plate")[k] @ [0.2, 0.1] if moving else np.array([0.2, 0.1])
    at = r.position("bar")[k] + r.rotation("bar")[k] @ [0.25, 0.0]
    middle = np.array(pin) - (at - center) / per_mm
    far = [math.dist(p, middle) for p in slot.points]
    assert min(far) == pytest.approx(0.15 / per_mm - 1.6, abs=0.05)
    assert max(far) == pytest.approx(0.15 / per_mm + 1.6, abs=0.05)
    owner = "plate" if moving else "ground"
    (ring,) = (s for s in link_solids(r, 0.003)[owner] if isinstance(s, Ring))
    assert ring.radius == 0.15
    assert ring.center[:2] == pytest.approx([0.2, 0.1])


def test_a_circular_slot_closes_its_loop_in_the_report() -> None:
    """Its radius is a side of the loop, with a rate of its own; its reaction one unknown of the equations."""
    r = da.dynamics(da.mechanism(guided_bar(True)))
    (loop,) = loops(r, 4)
    assert "R,P" in [side.name for side in loop.sides]
    for order in (velocity_lines, acceleration_lines):
        lines = order(loop, Shown(r, Notation(), 4))
        assert [re.search(r"= (\S+) \"", line.numbers).group(1) for line in lines] == ["0", "0"]  # type: ignore[union-attr]
    text = da.report(r, at=5).to_bytes("txt").decode()
    assert "circular_slot, radius 0.1500 m" in text
    assert re.search(r"^F_\d\dx .* F_\d\dn ", text, re.MULTILINE)


def test_a_kernel_has_the_radius_of_a_circular_slot_as_input() -> None:
    m = da.mechanism(guided_bar(True))
    k = da.compile(m, ["joints.P.radius"])
    for radius in (0.15, 0.16):
        r = da.dynamics(m.with_values({"joints.P.radius": radius}))
        assert k([[radius]]).effort("O")[0] == pytest.approx(r.effort("O"), rel=1e-10)


def test_where_angles_fit_two_modes_the_given_places_decide() -> None:
    """A block that slides on a link of known angle, and in a circular slot: its angle is the same in both modes."""
    case = random_case(36_006)
    r = da.dynamics(da.mechanism(case.tree))
    x, y, _ = case.tree["assembly"]["L10"]
    assert r.position("L10")[0] == pytest.approx([x, y], abs=1e-9)
    assert worst(disagreement(r, case.answer))[1] < 1e-9
