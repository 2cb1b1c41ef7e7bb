"""A cam under its follower on whatever carries both: rates against differences, contact, outline, and no carrier."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.elements.cam_limits import worst_radius
from dalembert.analysis.compile.elements.cam_motion import CamMotion, cam_motion, outline, outline_motion
from dalembert.errors import ModelError
from tests.elements.test_cam_cases import sliding
from tests.elements.test_cams import TURN
from tests.elements.test_cams import machine as lifted

DISC = {"eccentric": "6 mm", "radius": "25 mm"}


def disc(follower: Any, swings: bool = False, **cam: Any) -> da.Mechanism:
    """A disc under a follower that slides upwards, or on a lever to the right of it."""
    tree = sliding(follower, DISC, drive=dict(TURN), stem={"mass": 0.5})
    tree["joints"]["F"] |= cam
    if swings:
        tree["links"]["ground"]["points"]["P"] = [0.08, 0.01]
        tree["links"]["stem"] = {"points": {"P": [0, 0], "F": [-0.075, 0.004]}, "mass": 0.5}
        tree["joints"]["guide"] = {"type": "pin", "links": ["ground", "stem"], "at": ["P", "P"]}
    return da.mechanism(tree)


def by_lift(follower: Any, sense: str) -> da.Mechanism:
    tree = lifted(follower, profile={"sense": sense})
    tree["links"]["ground"]["points"]["O2"] = [0.011, 0]
    tree["joints"]["guide"]["at"] = ["O2", "F"]
    return da.mechanism(tree)


MACHINES = {
    "a roller on a disc": lambda: disc({"roller": "7 mm"}),
    "a face on a disc": lambda: disc("flat"),
    "a roller on a lever on a disc": lambda: disc({"roller": "7 mm"}, True),
    "a face on a lever on a disc": lambda: disc("flat", True),
    "an offset roller by its lift": lambda: by_lift({"roller": "7 mm"}, "ccw"),
    "an offset roller the other way": lambda: by_lift({"roller": "7 mm"}, "cw"),
}
TURNS = np.array([0.2, 0.9, 1.3, 2.6, 3.3, 4.0, 5.7])


@pytest.mark.parametrize("name", MACHINES)
def test_rates_of_a_follower_are_those_of_differences(name: str) -> None:
    c = cam_motion(MACHINES[name](), "F")
    h = 1e-4
    y = [c.height(TURNS + k * h) for k in (-2, -1, 0, 1, 2)]
    here = c.at(TURNS)
    assert here.y == pytest.approx(y[2], abs=1e-15)
    assert here.slope == pytest.approx((y[0] - 8 * y[1] + 8 * y[3] - y[4]) / (12 * h), abs=1e-10)
    assert here.bend == pytest.approx(
        (-y[0] + 16 * y[1] - 30 * y[2] + 16 * y[3] - y[4]) / (12 * h * h), abs=1e-6
    )
    third = (c.at(TURNS + h).bend - c.at(TURNS - h).bend) / (2 * h)
    if c.joint.profile.segments is None:
        assert c.jerk(TURNS) == pytest.approx(third, rel=1e-6, abs=1e-9)
    else:
        assert c.jerk(TURNS) == pytest.approx(third, rel=1e-5, abs=1e-7)
    step = (c.at(TURNS + h).point - c.at(TURNS - h).point) / (2 * h)
    moved = np.hypot(*step.T)
    assert np.abs(here.normal[:, 0] ** 2 + here.normal[:, 1] ** 2 - 1).max() < 1e-12
    assert np.hypot(*here.way.T) == pytest.approx(np.ones(len(TURNS)), rel=1e-12)
    size = np.hypot(*c.carrier.arm) if c.carrier.swings else 1.0
    assert moved == pytest.approx(np.abs(here.slope) * size, rel=1e-6, abs=1e-9)


def center(c: CamMotion, turns: Any) -> Any:
    """The disc's centre on the carrier."""
    at = c.joint.profile.start + c.sense * turns
    return 0.006 * np.stack([np.cos(at), np.sin(at)], axis=-1)


@pytest.mark.parametrize("name", [n for n in MACHINES if "disc" in n])
def test_a_follower_touches_a_disc_along_the_line_to_its_centre(name: str) -> None:
    c = cam_motion(MACHINES[name](), "F")
    here, middle = c.at(TURNS), center(c, TURNS)
    away = here.point - middle
    if c.joint.flat:
        assert (away * here.normal).sum(axis=-1) == pytest.approx(np.full(len(TURNS), 0.025), abs=1e-14)
        across = np.stack([-here.normal[:, 1], here.normal[:, 0]], axis=-1)
        assert here.place == pytest.approx((away * across).sum(axis=-1), abs=1e-12)
        radius = 0.025
    else:
        radius = 0.025 + c.joint.follower.roller
        assert np.hypot(*away.T) == pytest.approx(np.full(len(TURNS), radius), rel=1e-12)
        assert here.normal == pytest.approx(away / radius, abs=1e-12)
        assert not here.place.any()
    assert c.curvature(TURNS, here) == pytest.approx(np.full(len(TURNS), 1 / radius), rel=1e-9)
    assert worst_radius(c, TURNS) == pytest.approx(np.full(len(TURNS), 0.025), rel=1e-9)


@pytest.mark.parametrize("follower", ["flat", "knife", {"roller": "7 mm"}])
@pytest.mark.parametrize("swings", [False, True])
def test_the_outline_of_a_disc_is_a_circle_about_its_centre(follower: Any, swings: bool) -> None:
    at = outline(disc(follower, swings), "F", 13)
    assert np.hypot(at[:, 0] - 0.006, at[:, 1]) == pytest.approx(np.full(len(at), 0.025), rel=1e-12)
    assert len(at) == 12 + swings  # with the turn at which the lever's piece begins
    around = np.unwrap(np.arctan2(at[:, 1], at[:, 0]))
    assert abs(around[-1] - around[0]) > 1.5 * math.pi


def loose(follower: Any, profile: dict[str, Any] | None = None, **cam: Any) -> da.Mechanism:
    """The follower slides in an arm that swings by itself, so that no link carries both."""
    tree = sliding(follower, profile or DISC, drive=dict(TURN), stem={"mass": 0.5})
    tree["links"]["ground"]["points"]["Q"] = [0.3, 0]
    tree["links"]["arm"] = {"points": {"Q": [0, 0], "F": [-0.3, 0]}}
    tree["joints"]["Q"] = {"type": "pin", "links": ["ground", "arm"]}
    tree["joints"]["guide"] = {"type": "slider", "links": ["arm", "stem"], "at": ["F", "F"], "direction": 90}
    tree["joints"]["F"] |= cam
    return da.mechanism(tree)


def said(call: Any, *given: Any) -> tuple[str, str, Any]:
    with pytest.raises(ModelError) as raised:
        call(*given)
    return raised.value.what, raised.value.remedy, raised.value.path


@pytest.mark.parametrize(
    ("follower", "cam"),
    [("knife", {}), ({"roller": "7 mm"}, {}), ("flat", {"face": "0 deg"}), ("flat", {"face": "35 deg"})],
)
def test_a_cam_without_a_carrier_has_its_outline_all_the_same(follower: Any, cam: dict[str, Any]) -> None:
    m = loose(follower, **cam)
    at = outline(m, "F", 13)
    assert np.hypot(at[:, 0] - 0.006, at[:, 1]) == pytest.approx(np.full(len(at), 0.025), rel=1e-9)
    c = outline_motion(m, "F")
    assert (c.carrier.link, c.carrier.swings, c.carrier.sign) == ("", False, 1.0)
    if follower == "flat":
        face = math.radians(float(cam["face"].split()[0]))
        assert c.shape.normal == pytest.approx([-math.sin(face), math.cos(face)])
    assert said(cam_motion, m, "F") == (
        "cam 'F': no link carries both cam and follower, so its lift over a turn is not defined",
        "pin the cam to the link on which the follower slides or swings",
        ("joints", "F"),
    )


def test_what_a_cam_without_a_carrier_needs_is_asked_for() -> None:
    assert said(outline_motion, loose("flat"), "F") == (
        "cam 'F': no link carries both cam and follower, which would give the direction of the face",
        "write face: its direction in the follower's axes, the cam on its right",
        ("joints", "F"),
    )
    law = {"base": "40 mm", "segments": lifted()["joints"]["F"]["profile"]["segments"]}
    what, remedy, path = said(outline_motion, loose("knife", law), "F")
    assert what == "cam 'F': its profile is a lift, and no link carries both cam and follower"
    assert remedy == (
        "pin the cam to a link, and let the follower slide or swing on the same one; or give the profile as "
        "eccentric, arcs or points"
    )
    assert path == ("joints", "F")


SLANTED = (0.5, -math.sqrt(0.75))


@pytest.mark.parametrize(
    ("face", "normal"),
    [(90, (1.0, 0.0)), (270, (1.0, 0.0)), (30, SLANTED), (210, SLANTED), (120, (math.sqrt(0.75), 0.5))],
)
def test_a_face_looks_out_whichever_way_its_direction_is_given(face: int, normal: Any) -> None:
    """In the axes of the stem, whose x axis is along the slide."""
    c = cam_motion(disc("flat", face=f"{face} deg"), "F")
    assert c.shape.normal == pytest.approx(normal, abs=1e-12)


@pytest.mark.parametrize("face", [0, 180])
def test_a_face_along_the_motion_of_its_follower_lifts_nothing(face: int) -> None:
    assert said(cam_motion, disc("flat", face=f"{face} deg"), "F") == (
        "cam 'F': the face is along the motion of the follower, which does not lift it",
        "turn the face",
        ("joints", "F", "face"),
    )
