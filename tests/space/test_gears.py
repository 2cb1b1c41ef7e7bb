"""Gears in space against the formulas of machine design: spur, helical, bevel and crossed wheels, planets."""

from __future__ import annotations

from math import atan2, cos, radians, sin, tan
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model.description import mechanism

TORQUE, ALPHA = 10.0, radians(20)


def pair(a: dict[str, Any], b: dict[str, Any], load: list[float], **gear: Any) -> da.Mechanism:
    """Two wheels in fixed bearings: centre, axis and radius of each; a couple on b, a driven."""
    axes = {"i": {"z": a["axis"]}, "j": {"z": b["axis"]}}
    radii = [a["radius"], b["radius"]]
    joints: dict[str, Any] = {
        "A": {"type": "revolute", "links": ["ground", "a"], "axis": a["axis"]},
        "B": {"type": "revolute", "links": ["ground", "b"], "axis": b["axis"]},
        "G": {"type": "gear", "links": ["a", "b"], "at": ["A", "B"], "axes": axes, "radii": radii, **gear},
    }
    links = {
        "ground": {"points": {"A": a["at"], "B": b["at"]}},
        "a": {"points": {"A": [0, 0, 0]}},
        "b": {"points": {"B": [0, 0, 0]}, "inertia": 0.002},
    }
    drive = {
        "position": {"from": 0, "to": 1080, "count": 13},
        "speed": "10 rad/s",
        "acceleration": "4 rad/s^2",
    }
    return mechanism(
        {
            "space": "space",
            "links": links,
            "joints": joints,
            "drives": {"A": drive},
            "loads": {"T": {"type": "couple", "on": "b", "value": load}},
        }
    )


def wheel(at: list[float], axis: list[float], radius: float) -> dict[str, Any]:
    return {"at": at, "axis": axis, "radius": radius}


Z = [0.0, 0.0, 1.0]


@pytest.mark.parametrize("helix", [0.0, 15.0, -25.0])
def test_spur_and_helical_wheels(helix: float) -> None:
    """F_t = T / r; F_r = F_t tan(alpha_n) / cos(beta); F_a = F_t tan(beta)."""
    m = pair(wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], Z, 0.1), [0, 0, -TORQUE], helix_angle=helix)
    r = da.dynamics(m)
    assert set(r.status) == {"ok"}
    assert r.speed("b") == pytest.approx(np.tile([0, 0, -5.0], (13, 1)))
    tangential = -(TORQUE - 0.002 * 2) / 0.1
    beta = radians(helix)
    expected = [abs(tangential) * tan(ALPHA) / cos(beta), tangential, -tangential * tan(beta)]
    assert r.reaction("G", on="b") == pytest.approx(np.tile(expected, (13, 1)))
    assert r.effort("A") == pytest.approx(np.full(13, 0.05 * tangential))


def test_a_wheel_away_from_its_bearing_along_the_shaft() -> None:
    """Efforts and tooth forces are those of one at its bearing, wherever its link is described from."""
    m = pair(wheel([0, 0, 0], Z, 0.05), wheel([0.14, 0, 0.01], Z, 0.09), [0, 0, -TORQUE], helix_angle=15)
    tree = m.to_tree()
    for link, joint, arm in (("a", "A", 0.02), ("b", "B", -0.03)):
        x, y, z = (float(str(c).split()[0]) for c in tree["links"]["ground"]["points"][joint])  # m
        tree["links"]["ground"]["points"][joint] = [x, y, z - arm]
        tree["links"][link]["points"] = {joint: [0.2, 0.1, 0.3], f"W{joint}": [0.2, 0.1, 0.3 + arm]}
    tree["joints"]["G"]["at"] = ["WA", "WB"]
    here, there = da.dynamics(m), da.dynamics(mechanism(tree))
    assert set(there.status) == {"ok"}
    for joint in m.joints:
        assert there.reaction(joint) == pytest.approx(here.reaction(joint), abs=1e-9)
    assert there.effort("A") == pytest.approx(here.effort("A"))
    assert there.speed("b") == pytest.approx(here.speed("b"))


def test_ring_wheel() -> None:
    """The pinion inside turns the same way and is pushed towards the centre."""
    m = pair(wheel([0, 0, 0], Z, 0.15), wheel([0.1, 0, 0], Z, 0.05), [0, 0, -TORQUE], internal=True)
    r = da.statics(m)
    assert r.speed("b")[0] == pytest.approx([0, 0, 30.0])
    tangential = TORQUE / 0.05
    assert r.reaction("G", on="b")[0] == pytest.approx([-tangential * tan(ALPHA), tangential, 0.0])


@pytest.mark.parametrize("sense", [1.0, -1.0], ids=["away from the apex", "towards it"])
@pytest.mark.parametrize("shaft", [60.0, 90.0, 110.0])
def test_bevel_wheels(shaft: float, sense: float) -> None:
    """Whichever way the first axis points.

    Of a straight bevel wheel with cone angle d: axial F_t tan(alpha) sin(d), radial F_t tan(alpha) cos(d).
    """
    ra, rb, sigma = 0.04, 0.07, radians(shaft)
    da_ = atan2(sin(sigma), rb / ra + cos(sigma))
    apex = ra / tan(da_)
    contact = np.array([ra, 0.0, -apex])
    axis = np.array([sin(sigma), 0.0, -cos(sigma)])
    center = (contact @ axis) * axis
    first = wheel([0, 0, -apex], [0, 0, sense], ra)
    m = pair(first, wheel(center.tolist(), axis.tolist(), rb), (TORQUE * axis).tolist())
    r = da.statics(m)
    force = r.reaction("G", on="a")[0]
    tangential = TORQUE / rb
    assert abs(force[1]) == pytest.approx(tangential)
    assert force[0] == pytest.approx(-tangential * tan(ALPHA) * cos(da_))  # away from b: towards the axis
    assert force[2] == pytest.approx(-tangential * tan(ALPHA) * sin(da_))  # away from the apex
    assert abs(r.speed("b")[0] @ axis) == pytest.approx(10 * ra / rb)
    assert abs(r.effort("A")[0]) == pytest.approx(TORQUE * ra / rb)


def test_worm() -> None:
    """A worm of lead angle g turns its wheel by r tan(g) / R, without losses its torque is that part of the wheel's.

    Right-hand threads go against the worm's axis as it turns about it, and take along the teeth of the wheel below.
    """
    lead = radians(10)
    m = pair(
        wheel([0, 0, 0.1], [1.0, 0, 0], 0.02),
        wheel([0, 0, 0], [0, 1.0, 0], 0.08),
        [0, TORQUE, 0],
        helix_angle=80,
    )
    r = da.statics(m)
    ratio = 0.02 * tan(lead) / 0.08
    assert r.speed("b")[0] == pytest.approx([0, -10 * ratio, 0])
    assert r.effort("A") == pytest.approx(np.full(13, TORQUE * ratio))
    along_worm = TORQUE / 0.08
    force = r.reaction("G", on="a")[0]
    assert force[0] == pytest.approx(along_worm)
    assert abs(force[1]) == pytest.approx(along_worm * tan(lead))
    assert abs(force[2]) == pytest.approx(along_worm / cos(lead) * tan(ALPHA))


def test_bevel_differential() -> None:
    """Half the sum of the side wheels' turns is the carrier's; a planet shares the torque equally."""
    x, z, r = [1.0, 0.0, 0.0], Z, 0.05
    mesh = {"type": "gear", "radii": [r, r], "axes": {"i": {"z": z}, "j": {"z": x}}}
    points = {"left": [0, 0, -r], "right": [0, 0, r], "planet": [r, 0, 0]}
    joints = {
        "left": {"type": "revolute", "links": ["ground", "left"], "axis": z},
        "right": {"type": "revolute", "links": ["ground", "right"], "axis": z},
        "carrier": {"type": "revolute", "links": ["ground", "carrier"], "axis": z},
        "planet": {"type": "revolute", "links": ["carrier", "planet"], "axis": x},
        "low": {**mesh, "links": ["left", "planet"], "at": ["left", "planet"]},
        "high": {**mesh, "links": ["right", "planet"], "at": ["right", "planet"]},
    }
    m = mechanism(
        {
            "space": "space",
            "links": {
                "ground": {
                    "points": {"left": points["left"], "right": points["right"], "carrier": [0, 0, 0]}
                },
                "left": {"points": {"left": [0, 0, 0]}},
                "right": {"points": {"right": [0, 0, 0]}},
                "carrier": {"points": {"carrier": [0, 0, 0], "planet": points["planet"]}},
                "planet": {"points": {"planet": [0, 0, 0]}, "inertia": [1e-3, 2e-3, 2e-3], "mass": 0.3},
            },
            "joints": joints,
            "drives": {
                "left": {"position": {"from": 0, "to": 360, "count": 9}, "speed": "7 rad/s"},
                "right": {"position": {"from": 0, "to": 720, "count": 9}, "speed": "3 rad/s"},
            },
            "loads": {"T": {"type": "couple", "on": "carrier", "value": [0, 0, -8.0]}},
        }
    )
    r = da.dynamics(m)
    assert set(r.status) == {"ok"}
    assert r.speed("carrier") == pytest.approx(np.tile([0, 0, 5.0], (9, 1)))
    turned = np.arctan2(r.rotation("carrier")[:, 1, 0], r.rotation("carrier")[:, 0, 0])
    half = (r.drive_position("left") + r.drive_position("right")) / 2
    assert np.cos(turned - half) == pytest.approx(np.ones(9))
    assert r.effort("left") == pytest.approx(np.full(9, 4.0))
    assert r.effort("right") == pytest.approx(np.full(9, 4.0))


def test_wheels_that_do_not_touch() -> None:
    m = pair(wheel([0, 0, 0], Z, 0.05), wheel([0.16, 0, 0], Z, 0.1), [0, 0, TORQUE])
    with pytest.raises(da.ModelError, match="gear 'G': the pitch circles do not touch"):
        da.statics(m)


@pytest.mark.parametrize("helix", [0.0, 25.0])
def test_components_in_the_axes_of_the_mesh_are_steady(helix: float) -> None:
    """Radial, tangential, axial: they stay with the line of centres, whatever the wheels' turn and the links' axes."""
    m = pair(wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], Z, 0.1), [0, 0, -TORQUE], helix_angle=helix)
    r = da.statics(m)
    assert np.ptp(r.rotation("a"), axis=0).max() > 1.9
    tangential, beta = TORQUE / 0.1, radians(helix)
    expected = [tangential * tan(ALPHA) / cos(beta), -tangential, tangential * tan(beta)]
    assert r.reaction("G", on="b", axes="joint") == pytest.approx(np.tile(expected, (13, 1)))
    assert r.joint_axes("G") == pytest.approx(np.tile(np.eye(3), (13, 1, 1)), abs=1e-9)


def test_axes_of_a_mesh_go_with_the_carrier() -> None:
    """A planet on a ring wheel's inside: x from the planet's axis to the pitch point, on the line of centres."""
    x = {"type": "revolute", "axis": Z}
    m = mechanism(
        {
            "space": "space",
            "links": {
                "ground": {"points": {"O": [0, 0, 0]}},
                "arm": {"points": {"O": [0, 0, 0], "P": [0.1, 0, 0]}},
                "planet": {"points": {"P": [0, 0, 0]}},
            },
            "joints": {
                "O": {**x, "links": ["ground", "arm"]},
                "P": {**x, "links": ["arm", "planet"]},
                "G": {
                    "type": "gear",
                    "links": ["ground", "planet"],
                    "at": ["O", "P"],
                    "axis": Z,
                    "radii": [0.15, 0.05],
                }
                | {"internal": True},
            },
            "drives": {"O": {"position": {"from": 0, "to": 360, "count": 9}, "speed": "1 rad/s"}},
            "loads": {"T": {"type": "couple", "on": "planet", "value": [0, 0, 3.0]}},
        }
    )
    r = da.statics(m)
    line = r.point("planet", "P") / 0.1
    assert r.joint_axes("G")[:, 0] == pytest.approx(line, abs=1e-9)
    force = r.reaction("G", axes="joint")
    assert force == pytest.approx(np.tile(force[0], (9, 1)))
    assert abs(force[0, 1]) == pytest.approx(3.0 / 0.05)
    assert np.linalg.norm(force, axis=-1) == pytest.approx(np.linalg.norm(r.reaction("G"), axis=-1))
