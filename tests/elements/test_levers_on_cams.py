"""Levers on cams given by their form, beside linkages in closed form; what cannot be made, and its least sizes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.elements import cam_limits
from dalembert.analysis.compile.elements.cam_motion import outline
from dalembert.arrays import Array
from dalembert.errors import ModelError
from tests.elements.test_cam_cases import sliding
from tests.elements.test_cams import FULL, TURN, machine
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
        return np.asarray(np.arctan2(-to[:, 1], -to[:, 0]) + math.pi + side * between - along)
    normal = FACE + math.pi / 2 if kind == "flat" else along
    outward = np.array([-ARM[1], ARM[0]]) * side
    if kind != "flat":
        normal = math.atan2(outward[1], outward[0])
    elif outward @ [math.cos(normal), math.sin(normal)] < 0:
        normal += math.pi
    height = float(ARM @ [math.cos(normal), math.sin(normal)])
    return np.asarray(np.arctan2(-to[:, 1], -to[:, 0]) - side * np.arccos((RADIUS - height) / far) - normal)


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


RISE = [{"to": "10 deg", "in": "90 deg", "by": "cycloidal"}, *FULL[1:]]
TWO = {
    "points": {"angle": list(range(0, 360, 30)), "radius": [0.05, 0.05, 0.04, *[0.05] * 5, 0.03, *[0.05] * 3]}
}
POINTS = {"points": {"angle": [0, 60, 90, 120, 180, 270], "radius": [0.05, 0.05, 0.02, 0.05, 0.05, 0.05]}}


def loose(tree: dict[str, Any]) -> dict[str, Any]:
    """The stem slides on a link that is not the one to which the cam is pinned."""
    tree["links"]["slide"] = {"points": {"O": [0, 0]}}
    tree["joints"]["guide"]["links"] = ["slide", "stem"]
    tree["joints"]["weld"] = {"type": "weld", "links": ["ground", "slide"], "at": "O"}
    return tree


def arcs(*rows: tuple[list[float], float, float]) -> dict[str, Any]:
    return {"arcs": [{"center": c, "radius": r, "to": f"{to} deg"} for c, r, to in rows]}


def hollow() -> dict[str, Any]:
    """A round cam of 40 mm with a hollow about [70, 0], rounded at both ends by 10 mm."""
    blend = 0.03 * np.exp(1j * math.pi / 6)
    across = 0.07 - blend
    begin = math.degrees(np.angle(blend + 0.01 * across / abs(across)))
    parts = (
        (0.07, 0.01 - abs(across), begin),
        (blend, 0.01, 30),
        (0, 0.04, 330),
        (blend.conjugate(), 0.01, -begin),
    )
    return arcs(*(([z.real, z.imag], r, to % 360) for z, r, to in parts))


@pytest.mark.parametrize("roller", [0.005, 0.036])
def test_a_roller_in_a_hollow_arc_is_on_the_outline(roller: float) -> None:
    """Its centre is as high as the roller on each place of the outline puts it."""
    m = da.mechanism(sliding({"roller": roller}, hollow(), drive=TURN))
    edge = outline(da.mechanism(sliding("knife", hollow(), drive=TURN)), "F", 8001)
    r = da.kinematics(m)
    at = edge[:, 0] + 1j * edge[:, 1]
    for th, height in zip(r.angle("cam"), r.freedom("guide", "slide")[0], strict=True):
        turned = at * np.exp(1j * th)
        near = turned[np.abs(turned.real) < roller]
        assert height == pytest.approx((near.imag + np.sqrt(roller**2 - near.real**2)).max(), abs=1e-7)


UNFIT: dict[str, tuple[Callable[[], Any], str]] = {
    "a face whose direction nothing gives": (
        lambda: loose(sliding("flat", DISC, drive=TURN)),
        "cam 'F': no link carries both cam and follower, which would give the direction of the face; write face: its "
        "direction in the follower's axes, the cam on its right",
    ),
    "a face along the motion": (
        lambda: machine("flat", face="0 deg"),
        "cam 'F': the face is along the motion of the follower, which does not lift it; turn the face",
    ),
    "a face through the axis": (
        lambda: lever("flat", {"base": 0.03, "segments": RISE}, arm=[0, 0]),
        "cam 'F': the face passes through the follower's axis, and its direction is not given; write face: its "
        "direction in the follower's axes",
    ),
    "a lift in mm of a lever": (
        lambda: lever("knife", {"base": 0.03, "segments": FULL}),
        "cam 'F': its lift is a length, and its follower swings in joint 'Q'; write lifts as angles, with their unit: "
        "{to: 20 deg, ...}",
    ),
    "a lever too short": (
        lambda: lever("knife", {"base": 0.03, "segments": RISE}, arm=[-0.05, 0]),
        "cam 'F': an arm of 50 mm about an axis 120.416 mm away does not reach a radius of 30 mm; take an arm between "
        "90.4159 mm and 150.416 mm",
    ),
    "a lever too long": (
        lambda: lever("knife", {"base": 0.03, "segments": RISE}, arm=[-0.2, 0]),
        "cam 'F': an arm of 200 mm about an axis 120.416 mm away does not reach a radius of 30 mm; take an arm between "
        "90.4159 mm and 150.416 mm",
    ),
    "a face on a tangent cam": (
        lambda: sliding(
            "flat", {"tangent": {"base": 0.03, "lift": 0.01, "half_angle": "60 deg"}}, drive=TURN
        ),
        "cam 'F': a flat face does not move on the flanks of a tangent cam, and jumps from end to end; take a roller",
    ),
    "arcs apart": (
        lambda: sliding("knife", arcs(([0, 0], 0.03, 90), ([0, 0], 0.031, 360)), drive=TURN),
        "cam 'F': at 90 deg one arc ends at 30 mm and the next begins at 31 mm; let them meet",
    ),
    "arcs with a corner": (
        lambda: sliding(
            "knife", arcs(([0, 0], 0.03, 90), ([0.003, 0], math.hypot(0.003, 0.03), 270)), drive=TURN
        ),
        "cam 'F': at 90 deg the tangents of two arcs differ by 5.71 deg; put the centres and the point where they meet "
        "on one line",
    ),
    "a face on a hollow of points": (
        lambda: sliding("flat", POINTS, drive=TURN),
        "cam 'F': it is hollow at 85 deg, where a flat face does not reach it; take a roller or a knife edge",
    ),
    "a roller in a hollow of points": (
        lambda: sliding({"roller": 0.001}, POINTS, drive=TURN),
        "cam 'F': the roller does not fit the hollow at 90 deg, of radius 0.9848 mm; make the roller smaller than that",
    ),
    "a roller in a hollow arc": (
        lambda: sliding({"roller": 0.037}, hollow(), drive=TURN),
        "cam 'F': the roller does not fit the hollow at 0 deg, of radius 36.5 mm; make the roller smaller than that",
    ),
    "a face on a hollow arc": (
        lambda: sliding("flat", hollow(), drive=TURN),
        "cam 'F': a flat face does not reach its hollow arcs; take a roller or a knife edge",
    ),
    "a roller in the sharper of two hollows": (
        lambda: sliding({"roller": 0.05}, TWO, drive=TURN),
        "cam 'F': the roller does not fit the hollow at 240 deg, of radius 3.096 mm; make the roller smaller than that",
    ),
}


@pytest.mark.parametrize("name", UNFIT)
def test_a_cam_that_its_follower_cannot_follow_is_told_why(name: str) -> None:
    tree, says = UNFIT[name]
    with pytest.raises(ModelError) as refused:
        da.dynamics(da.mechanism(tree()))
    assert str(refused.value) == says


def test_a_lift_that_no_base_makes_room_for() -> None:
    """The arm reaches no larger circle, and the face turns faster than the cam."""
    for follower, steep in (("flat", "60 deg"), ({"roller": 0.03}, "100 deg")):
        segments = [{"to": steep, "in": "90 deg", "by": "cycloidal"}, *FULL[1:]]
        c = da.cam(da.mechanism(lever(follower, {"base": 0.03, "segments": segments})), "F")
        assert (c.least_base, math.isnan(c.least_base_at)) == (math.inf, True)


def test_a_base_is_no_smaller_than_the_offset_leaves_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a small lift the roller's centre needs the offset for its circle, and nothing else."""
    monkeypatch.setattr(cam_limits, "PLACES", 73)
    tree = machine(
        {"roller": "5 mm"}, segments=[{"to": "0.2 mm", "in": "90 deg", "by": "cycloidal"}, *FULL[1:]]
    )
    tree["links"]["ground"]["points"]["E"] = [-0.03, 0]
    tree["joints"]["guide"]["at"] = ["E", "F"]
    c = da.cam(da.mechanism(tree), "F")
    assert c.least_base == pytest.approx(0.025, rel=1e-9)
