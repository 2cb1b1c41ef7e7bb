"""Corner cases in space: screws far from zero, ring wheels, steep helices, marks beside friction, lifted springs."""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model.description import mechanism
from tests.space.test_gears import TORQUE, Z, pair, wheel
from tests.tiers import crossed, tiers

LEAD = 5e-3


def nut(lead: float, freedom: str, position: list[str], **more: Any) -> da.Result:
    """A nut on a screw along x, pushed back by 100 N."""
    tree = {
        "space": "space",
        "links": {"ground": {"points": {"P": [0, 0, 0]}}, "nut": {"points": {"P": [0, 0, 0]}}},
        "joints": {"P": {"type": "screw", "links": ["ground", "nut"], "axis": [1, 0, 0], "lead": lead}},
        "drives": {"P": {"freedom": freedom, "position": position}},
        "loads": {"F": {"type": "force", "on": "nut", "at": "P", "value": [-100, 0, 0]}},
        **more,
    }
    return da.statics(mechanism(tree))


@crossed("lead, turns, assembled", [LEAD, -LEAD], [[3.25, 20], [-3.25, -20], [-2.4, 7.1]], [False, True])
def test_a_screw_starts_many_turns_from_zero(lead: float, turns: list[float], assembled: bool) -> None:
    """Slide is lead times turns, whichever is driven, as drawn or from a given pose; work is the same."""
    slide = lead * np.array(turns)
    pose = {"position": [float(slide[0]), 0, 0], "axis": [1, 0, 0], "angle": f"{360 * turns[0]} deg"}
    given = {"assembly": {"nut": pose}} if assembled else {}
    by_slide = nut(lead, "slide", [f"{x} m" for x in slide], **given)
    by_turn = nut(lead, "turn", [f"{360 * x} deg" for x in turns], **given)
    for r in (by_slide, by_turn):
        assert r.status == ("ok", "ok")
        assert r.position("nut")[:, 0] == pytest.approx(slide)
        angle = np.arctan2(r.rotation("nut")[:, 2, 1], r.rotation("nut")[:, 1, 1])
        assert np.cos(angle - 2 * pi * np.array(turns)) == pytest.approx([1, 1])
    assert by_slide.effort("P") == pytest.approx([100, 100])
    assert by_turn.effort("P") == pytest.approx(np.full(2, 100 * lead / (2 * pi)))


def test_a_screw_of_no_lead() -> None:
    with pytest.raises(da.ModelError, match="lead of joint 'P': a screw of lead 0 does not advance"):
        nut(0.0, "turn", ["0 deg"])


def ring_bevel(shaft: float, small: float, large: float) -> tuple[dict[str, Any], dict[str, Any]]:
    """A pinion about z and a ring wheel around it, with their apex in the origin."""
    sigma = radians(shaft)
    cone = atan2(sin(sigma), large / small - cos(sigma))
    contact = small / sin(cone) * np.array([sin(cone), 0, cos(cone)])
    axis = np.array([-sin(sigma), 0, cos(sigma)])
    center = (contact @ axis) * axis
    return wheel([0, 0, contact[2]], Z, small), wheel(center.tolist(), axis.tolist(), large)


@pytest.mark.parametrize("shaft", [0.0, 10.0, 40.0])
def test_a_pinion_in_a_ring_is_pushed_to_its_own_axis(shaft: float) -> None:
    """Separation on the pinion is normal to the cones, from the ring's teeth to the pinion's axis, whichever is i."""
    if shaft:
        pinion, ring = ring_bevel(shaft, 0.04, 0.07)
    else:
        pinion, ring = wheel([0, 0, 0], Z, 0.04), wheel([-0.03, 0, 0], Z, 0.07)
    tangential = TORQUE / 0.07
    load = (TORQUE * np.array(ring["axis"])).tolist()
    first = da.statics(pair(pinion, ring, load, internal=True))
    load = (0.04 * tangential * np.array(pinion["axis"])).tolist()
    second = da.statics(pair(ring, pinion, load, internal=True))
    for r, name in ((first, "a"), (second, "b")):
        force = r.reaction("G", on=name)[0]
        assert abs(force[1]) == pytest.approx(tangential)
        assert force[0] < 0
        assert np.hypot(force[0], force[2]) == pytest.approx(tangential * np.tan(radians(20)))
        assert force[2] == pytest.approx(0.0) if not shaft else force[2] > 0


@pytest.mark.parametrize(
    ("at", "internal", "says"),
    [
        (0.05, False, "gear 'G': one wheel lies within the other; write internal: true"),
        (0.15, True, "gear 'G': one wheel lies beside the other; leave internal out, or move a centre"),
        (0.0, True, "gear 'G': the pitch circles do not touch"),
    ],
)
def test_wheels_within_and_beside_each_other(at: float, internal: bool, says: str) -> None:
    m = pair(wheel([0, 0, 0], Z, 0.05), wheel([at, 0, 0], Z, 0.1), [0, 0, TORQUE], internal=internal)
    with pytest.raises(da.ModelError, match=says):
        da.statics(m)


@pytest.mark.parametrize("helix", tiers([10.0, -20.0], [20.0, 25.0]))
def test_crossed_helical_wheels_up_to_steep_ones(helix: float) -> None:
    """omega_j / omega_i = r_i cos(b_i) / (r_j cos(b_j)) with b_i + b_j the angle of the axes; followed over turns."""
    shaft, beta = radians(60), radians(helix)
    m = pair(
        wheel([0, 0, 0], [1.0, 0, 0], 0.05),
        wheel([0, 0, 0.15], [cos(shaft), sin(shaft), 0], 0.1),
        [0, 0, 0],
        helix_angle=helix,
    )
    r = da.kinematics(m)
    assert set(r.status) == {"ok"}
    ratio = 0.05 * cos(beta) / (0.1 * cos(shaft + beta))
    assert np.linalg.norm(r.speed("b"), axis=1) == pytest.approx(np.full(13, 10 * ratio))
    turned = np.trace(r.rotation("b"), axis1=1, axis2=2)
    assert turned == pytest.approx(1 + 2 * np.cos(ratio * r.drive_position("A")), abs=1e-6)


def test_a_gear_with_stiffness_in_a_determinate_train() -> None:
    wheels = wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], Z, 0.1)
    rigid = da.statics(pair(*wheels, [0, 0, TORQUE]))
    soft = da.statics(pair(*wheels, [0, 0, TORQUE], stiffness={"force": 1e6}))
    assert soft.effort("A") == pytest.approx(rigid.effort("A"))


def door(friction: bool) -> da.Mechanism:
    """A door on two hinges on a slanted line, and a sledge beside it."""
    hinge = {"type": "revolute", "links": ["ground", "door"], "axis": [0, 0.6, 0.8]}
    guide: dict[str, Any] = {"type": "prismatic", "links": ["ground", "sledge"], "axis": [1, 0, 0]}
    points = {"A": [0, 0, 0], "B": [0, 0.6, 0.8]}
    return mechanism(
        {
            "space": "space",
            "gravity": "standard",
            "links": {
                "ground": {"points": {**points, "S": [0, 0, 0]}},
                "door": {"points": points, "mass": 20, "center": [0.4, 0.1, 0.5]},
                "sledge": {"points": {"S": [0, 0, 0]}, "mass": 3},
            },
            "joints": {
                "A": hinge,
                "B": hinge,
                "S": {**guide, **({"friction": {"coefficient": 0.1}} if friction else {})},
            },
            "drives": {
                "A": {"position": [10, 50], "speed": "1 rad/s"},
                "S": {"position": [0, 0.2], "speed": "1 m/s"},
            },
        }
    )


def test_what_is_unique_does_not_depend_on_friction_elsewhere() -> None:
    """In the joint's axes the hinge's couple about its line is known, in ground's no component is."""
    for friction in (False, True):
        r = da.statics(door(friction))
        assert r.status == ("redundant", "redundant")
        moment = r.reaction_moment("A", axes="joint")
        assert np.isnan(moment[:, :2]).all()
        assert moment[:, 2] == pytest.approx([0, 0], abs=1e-9)
        assert np.isnan(r.reaction_moment("A")[:, 1:]).all()


@pytest.mark.parametrize(
    "load",
    [
        {"type": "spring", "stiffness": "1 kN/m", "free_length": "0.1 m"},
        {"type": "damper", "damping": "3 N*s/m"},
    ],
)
def test_springs_and_dampers_keep_their_length_when_links_are_set_apart(load: dict[str, Any]) -> None:
    tree = da.four_bar().to_tree()
    tree["loads"]["S"] = {**load, "between": ["ground.O2", "coupler.B"]}
    plane = mechanism(tree)
    space = da.lifted(plane, {"coupler": "200 mm"}, {"A": "spherical", "B": "cylindrical"})
    assert da.dynamics(space).effort("O2") == pytest.approx(da.dynamics(plane).effort("O2"), rel=1e-9)


def test_lifted_joints_keep_their_stiffness_and_pins_of_no_radius_have_no_friction() -> None:
    tree = da.four_bar().to_tree()
    tree["joints"]["A"]["stiffness"] = {"force": "2 kN/mm"}
    tree["joints"]["B"]["friction"] = {"coefficient": 0.1, "radius": 0}
    m = da.lifted(mechanism(tree))
    assert m.joints["A"].stiffness is not None
    assert m.joints["A"].stiffness.force == 2e6
    assert getattr(m.joints["B"], "friction", None) is None
    assert mechanism(m.to_tree()) == m


def crank_and_slide(position: list[str], driven: str = "S") -> da.Mechanism:
    """A slider-crank with a ball and a pin that may slide, its slide driven."""
    return mechanism(
        {
            "space": "space",
            "gravity": [0, -10, 0],
            "links": {
                "ground": {"points": {"O": [0, 0, 0], "S": [0, 0, 0]}},
                "crank": {"points": {"O": [0, 0, 0], "A": [0.1, 0, 0]}, "mass": 1, "center": [0.05, 0, 0]},
                "rod": {"points": {"A": [0, 0, 0], "B": [0.3, 0, 0]}},
                "slide": {"points": {"B": [0, 0, 0]}},
            },
            "joints": {
                "O": {"type": "revolute", "links": ["ground", "crank"], "axis": [0, 0, 1]},
                "A": {"type": "spherical", "links": ["crank", "rod"]},
                "B": {"type": "cylindrical", "links": ["rod", "slide"], "axis": [0, 0, 1]},
                "S": {"type": "prismatic", "links": ["ground", "slide"], "at": ["S", "B"], "axis": [1, 0, 0]},
            },
            "drives": {"S": {"position": position}},
        }
    )


def test_modes_found_by_search_keep_every_axis_of_a_slide() -> None:
    """Three right angles also hold where each axis lies along another one: no mode of a prismatic joint."""
    r = da.statics(crank_and_slide(["0.35 m"]))
    assert r.status == ("ok",)
    assert r.rotation("slide")[0] == pytest.approx(np.eye(3), abs=1e-9)
    assert r.mode is not None
    assert r.mode.count("|") == 0
    assert r.mode.count("deg") == 4


@pytest.mark.parametrize("positions", [["0.4 m", "0.39 m", "0.3 m"], ["0.2 m", "0.21 m", "0.3 m"]])
def test_a_first_position_at_a_dead_centre(positions: list[str]) -> None:
    """The motion is taken up beside it, on whichever side the linkage closes."""
    r = da.statics(crank_and_slide(positions))
    assert r.status == ("singular", "ok", "ok")
    x = np.array([0.39 if positions[0] == "0.4 m" else 0.21, 0.3])
    cosine = (0.1**2 + x**2 - 0.3**2) / (0.2 * x)
    assert r.rotation("crank")[1:, 0, 0] == pytest.approx(cosine)
