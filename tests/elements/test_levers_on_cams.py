"""Levers on cams given by their form, beside linkages in closed form; what cannot be made, and its least sizes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.arrays import Array
from tests.elements.test_cam_cases import sliding
from tests.elements.test_cams import TURN
from tests.tiers import crossed

E, RADIUS, ROLLER = 0.012, 0.04, 0.005
AXIS, ARM = np.array([0.12, 0.01]), np.array([-0.1, 0.03])
DISC = {"eccentric": E, "radius": RADIUS}
FACE = 10 * math.pi / 180
FOLLOWERS: dict[str, tuple[Any, dict[str, Any]]] = {
    "knife": ("knife", {}),
    "roller": ({"roller": ROLLER}, {}),
    "flat": ("flat", {"face": f"{FACE!r} rad"}),
    "face along its arm": ("flat", {}),
}


def lever(follower: Any, profile: dict[str, Any], **more: Any) -> dict[str, Any]:
    """A cam under a lever that is pinned at the right of it."""
    ends = ["lever", "ground"] if more.pop("turned", False) else ["ground", "lever"]
    cam = {"type": "cam", "links": ["cam", "lever"], "at": ["O", "F"], "follower": follower}
    return {
        "links": {
            "ground": {"points": {"O": [0, 0], "Q": AXIS.tolist()}},
            "cam": {"points": {"O": [0, 0]}},
            "lever": {"points": {"Q": [0, 0], "F": more.pop("arm", ARM.tolist())}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "cam"]},
            "Q": {"type": "pin", "links": ends},
            "F": cam | {"profile": profile} | more,
        },
        "drives": {"O": {"position": {"from": 0, "to": 360, "count": 9}, "speed": "20 rad/s"}},
    }


def lever_angle(kind: str, side: float, turn: Array) -> Array:
    """Angle of a lever that goes out as it turns counter-clockwise (side 1), or clockwise: a four-bar's rocker, whose
    coupler is the radius, or a face as far from the disc's centre."""
    to = E * np.stack([np.cos(turn), np.sin(turn)], axis=-1) - AXIS
    far, along = np.hypot(*to.T), math.atan2(ARM[1], ARM[0])
    if kind in ("knife", "roller"):
        rod, arm = RADIUS + (ROLLER if kind == "roller" else 0.0), float(np.hypot(*ARM))
        between = np.arccos((arm**2 + far**2 - rod**2) / (2 * arm * far))
        return np.arctan2(-to[:, 1], -to[:, 0]) + math.pi + side * between - along
    normal = FACE + math.pi / 2 if kind == "flat" else along
    outward = np.array([-ARM[1], ARM[0]]) * side
    if kind != "flat":
        normal = math.atan2(outward[1], outward[0])
    elif outward @ [math.cos(normal), math.sin(normal)] < 0:
        normal += math.pi
    height = float(ARM @ [math.cos(normal), math.sin(normal)])
    return np.arctan2(-to[:, 1], -to[:, 0]) - side * np.arccos((RADIUS - height) / far) - normal


@crossed("kind, turned, sense, assembled", FOLLOWERS, [False, True], ["ccw", "cw"], [None, 1.0, -1.0])
def test_a_lever_on_a_disc_is_the_rocker_of_a_four_bar(
    kind: str, turned: bool, sense: str, assembled: float | None
) -> None:
    """Its lift over the cam's turn, in both senses, from whichever end of its pin it is counted, and on the side on
    which its file assembles it; a face is on the one on which its freedom lifts it."""
    follower, more = FOLLOWERS[kind]
    held = {} if follower == "flat" else {"contact": "holds"}
    tree = lever(follower, DISC | {"sense": sense}, turned=turned, **more, **held)
    side = -1.0 if turned else 1.0
    if assembled is not None:
        tree["assembly"] = {"lever": f"{assembled} rad"}
        side = side if follower == "flat" else assembled
    m = da.mechanism(tree)
    c, turn, step = da.cam(m, "F"), np.linspace(0.1, 6.1, 25), 1e-3
    up, sign = (-1.0 if turned else 1.0), (-1.0 if sense == "cw" else 1.0)
    a, b, o, d, e = (up * lever_angle(kind, side, sign * (turn + k * step)) for k in (-2, -1, 0, 1, 2))
    around = up * lever_angle(kind, side, np.linspace(0, 2 * math.pi, 200001))
    lowest = around.min() if up * side > 0 else around.max()
    lift = c.lift(turn)
    assert lift[0] == pytest.approx(o - lowest, abs=1e-10)
    assert lift[1] == pytest.approx((a - 8 * b + 8 * d - e) / (12 * step), abs=1e-10)
    assert lift[2] == pytest.approx((-a + 16 * b - 30 * o + 16 * d - e) / (12 * step**2), abs=2e-8)
    assert np.hypot(*(c.profile(turn) - [E, 0]).T) == pytest.approx(np.full(25, RADIUS), rel=1e-12)
    assert c.profile_radius(turn) == pytest.approx(np.full(25, RADIUS), rel=1e-9)
    assert (math.isnan(c.least_base), math.isnan(c.least_base_at)) == (True, True)
    r = da.kinematics(m)
    moved = np.mod(r.angle("lever") - lever_angle(kind, side, r.angle("cam")) + 1, 2 * math.pi) - 1
    assert moved == pytest.approx(np.zeros(9), abs=1e-12)
    if "contact" in held or assembled is None:
        answer = da.dynamics(m).contact("F").pressure_angle
        assert answer == pytest.approx(c.pressure_angle(sign * r.angle("cam")), abs=1e-10)


@pytest.mark.parametrize("direction", [90, 270])
@pytest.mark.parametrize("assembled", [[0, -0.05, 0], [0, 0.05, 0], 0.0])
def test_a_stem_is_on_the_side_of_the_cam_on_which_it_is_assembled(direction: int, assembled: Any) -> None:
    """The centre of the roller by the law of cosines; below the cam the disc pushes it down as it pushed it up."""
    tree = sliding({"roller": ROLLER}, DISC, drive=TURN, assembly={"stem": assembled})
    tree["links"]["ground"]["points"]["E"] = [0, 0.06]
    tree["joints"]["guide"] |= {"at": ["E", "F"], "direction": direction}
    tree["joints"]["F"]["contact"] = "holds"
    m = da.mechanism(tree)
    r, c = da.dynamics(m), da.cam(m, "F")
    side = 1.0 if assembled == 0.0 or assembled[1] > 0 else -1.0
    th, rod = r.angle("cam"), RADIUS + ROLLER
    height = E * np.sin(th) + side * np.sqrt(rod**2 - (E * np.cos(th)) ** 2)
    assert r.point("stem", "F")[:, 1] == pytest.approx(height, abs=1e-12)
    up = side if direction == 90 else -side
    assert c.lift(th)[0] == pytest.approx(up * (side * height - (rod - E)), abs=1e-10)
    lean = side * np.arcsin(E * np.cos(th) / rod)
    assert c.pressure_angle(th) == pytest.approx(lean, abs=1e-10)
    assert r.contact("F").pressure_angle == pytest.approx(lean, abs=1e-10)
