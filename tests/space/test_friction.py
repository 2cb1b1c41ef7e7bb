"""Friction in space: the plane's answers in a lifted mechanism, and formulas of machine design."""

from __future__ import annotations

from math import atan, atan2, cos, hypot, pi, sin, sqrt, tan
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.core.friction.rod_spin import STEEPEST, solve_spins
from dalembert.model.description import mechanism
from dalembert.reports.working import working
from tests.space.printed import lines

PIN = {"coefficient": 0.2, "radius": "8 mm"}


def rubbed(m: da.Mechanism, guide: dict[str, Any] | None = None) -> da.Mechanism:
    """The mechanism with friction in every pin and slider."""
    tree = m.to_tree()
    for joint in tree["joints"].values():
        joint["friction"] = PIN if joint["type"] == "pin" else guide
    return mechanism(tree)


def body(joint: dict[str, Any], load: list[float], couple: list[float], **drives: Any) -> da.Result:
    """Statics of one body held by a joint P, loaded at the joint's point."""
    loads = {
        "F": {"type": "force", "on": "body", "at": "P", "value": load},
        "M": {"type": "couple", "on": "body", "value": couple},
    }
    links = {"ground": {"points": {"P": [0, 0, 0]}}, "body": {"points": {"P": [0, 0, 0]}}}
    tree = {"space": "space", "links": links, "joints": {"P": {"links": ["ground", "body"], **joint}}}
    return da.statics(mechanism({**tree, "drives": drives, "loads": loads}))


@pytest.mark.parametrize(
    ("m", "guide"),
    [
        (da.four_bar(), None),
        (da.slider_crank(crank=0.05, rod=0.2), {"coefficient": 0.15}),
        (da.slider_crank(crank=0.05, rod=0.2), {"coefficient": 0.15, "guide": ["20 mm", "30 mm"]}),
    ],
)
def test_as_in_the_plane(m: da.Mechanism, guide: dict[str, Any] | None) -> None:
    """A ball and a pin that may slide, in place of two pins, feel the same friction while all stays in the plane."""
    plane = da.dynamics(rubbed(m, guide))
    r = da.dynamics(da.lifted(rubbed(m, guide), {}, {"A": "spherical", "B": "cylindrical"}))
    assert r.status == plane.status
    drive = plane.drives[0]
    largest = np.nanmax(np.abs(plane.effort(drive)))
    assert r.effort(drive) == pytest.approx(plane.effort(drive), abs=1e-10 * largest, nan_ok=True)
    for joint in plane.joints:
        size = np.nanmax(np.abs(plane.reaction(joint)))
        assert r.reaction(joint)[:, :2] == pytest.approx(plane.reaction(joint), abs=1e-10 * size, nan_ok=True)
        assert r.reaction_moment(joint)[:, 2] == pytest.approx(
            plane.reaction_moment(joint), abs=1e-10 * size, nan_ok=True
        )
        assert r.power_lost(joint) == pytest.approx(plane.power_lost(joint), rel=1e-9, nan_ok=True)
    assert np.nanmax(r.power_balance) < 1e-9


@pytest.mark.parametrize("thread", [0.0, 15.0])
@pytest.mark.parametrize("lead", [6e-3, -6e-3])
def test_screw_jack(lead: float, thread: float) -> None:
    """Raising W takes W r tan(lambda + phi'), lowering W r tan(lambda - phi'); at rest any torque between holds it."""
    radius, mu, weight = 11e-3, 0.12, 5000.0
    climb, rub = atan2(abs(lead), 2 * pi * radius), atan(mu / cos(thread * pi / 180))
    friction = {"coefficient": mu, "radius": radius, "thread_angle": f"{thread} deg"}
    joint = {"type": "screw", "axis": [0, 0, 1], "lead": lead, "friction": friction}
    side = 1.0 if lead > 0 else -1.0
    found = [
        body(
            joint,
            [0, 0, -weight],
            [0, 0, 0],
            P={"freedom": "turn", "position": 0, "speed": f"{side * w} rad/s"},
        )
        for w in (1, -1, 0)
    ]
    up, down = weight * radius * tan(climb + rub), weight * radius * tan(climb - rub)
    assert side * found[0].effort("P") == pytest.approx([up])
    assert side * found[1].effort("P") == pytest.approx([down])
    assert sorted(side * found[2].interval("P")[0]) == pytest.approx([down, up])
    assert found[1].status == ("self_locking",)
    assert found[0].power_balance[0] < 1e-12


def test_cylinder_that_slides_and_turns() -> None:
    """The friction lies along the slip: it takes mu N v / V of the force and mu N R w R / V of the couple."""
    mu, radius, v, w = 0.3, 0.02, 0.05, 4.0
    friction = {"coefficient": mu, "radius": radius, "circle": "tan"}
    joint = {"type": "cylindrical", "axis": [1, 0, 0], "friction": friction}
    slide = {"joint": "P", "freedom": "slide", "position": 0, "speed": f"{v} m/s"}
    turn = {"joint": "P", "freedom": "turn", "position": 0, "speed": f"{w} rad/s"}
    r = body(joint, [0, 30, -40], [0, 0, 0], slide=slide, turn=turn)
    slip = hypot(v, radius * w)
    assert r.effort("slide") == pytest.approx([mu * 50 * v / slip])
    assert r.effort("turn") == pytest.approx([mu * 50 * radius * radius * w / slip])
    assert r.power_lost("P") == pytest.approx([mu * 50 * slip])


@pytest.mark.parametrize("kind", ["sin", "tan"])
def test_journal_of_two_ends_and_collar(kind: str) -> None:
    """Each end of the bearing carries its part of the force and of the couple; the collar the force along the axis."""
    mu, radius, collar, behind, ahead = 0.25, 0.015, 0.03, 0.04, 0.1
    friction = {
        "coefficient": mu,
        "radius": radius,
        "circle": kind,
        "guide": [behind, ahead],
        "thrust_radius": collar,
    }
    joint = {"type": "revolute", "axis": [0, 0, 1], "friction": friction}
    r = body(joint, [100, 20, -60], [3, -5, 0], P={"position": "30 deg", "speed": "2 rad/s"})
    # reactions F = -load, M = -couple; ends N1 at -behind, N2 at ahead: N1 + N2 = F, M = z x (ahead N2 - behind N1)
    force, moment = np.array([-100.0, -20.0]), np.array([-3.0, 5.0])
    about = np.array([moment[1], -moment[0]])
    last = (about + behind * force) / (behind + ahead)
    near = force - last
    arm = radius * (sin(atan(mu)) if kind == "sin" else mu)
    torque = arm * (np.linalg.norm(near) + np.linalg.norm(last)) + mu * collar * 60
    assert r.effort("P") == pytest.approx([torque])
    assert r.reaction_moment("P")[0] == pytest.approx([-3, 5, -torque])


def test_a_collar_alone() -> None:
    """A thrust bearing: mu R_t |F_z|, whatever is across the axis; drawn and worked out like any."""
    friction = {"coefficient": 0.12, "thrust_radius": 0.03}
    joint = {"type": "revolute", "axis": [0, 0, 1], "friction": friction}
    r = body(joint, [400.0, -200.0, -900.0], [0, 0, 0], P={"position": 0, "speed": "3 rad/s"})
    assert abs(r.friction_moment("P")[0, 2]) == pytest.approx(0.12 * 0.03 * 900)
    assert r.power_lost("P")[0] == pytest.approx(3 * 0.12 * 0.03 * 900)
    assert da.draw.view(r, "all").items
    assert "R_t" in da.report(r).to_bytes("txt").decode()
    with pytest.raises(da.ModelError, match="has a guide, and no radius of the journal in it"):
        body({**joint, "friction": {**friction, "guide": [0.1, 0.1]}}, [0, 0, 0], [0, 0, 0])


def test_guide_of_two_ends_in_a_prismatic_joint() -> None:
    """A couple twice as large as the force times the guide's length: both ends bear, each with its own force."""
    mu = 0.2
    joint = {"type": "prismatic", "axis": [1, 0, 0], "friction": {"coefficient": mu, "guide": [0.05, 0.05]}}
    r = body(joint, [0, 10, 0], [0, 0, 4], P={"position": 0, "speed": "1 m/s"})
    # N1 + N2 = -10 across, 0.05 (N2 - N1) = -4
    assert r.effort("P") == pytest.approx([mu * (abs(-5 + 40) + abs(-5 - 40))])


def test_ball_joint_turned_about_a_slanted_axis() -> None:
    """The couple is r |F| against the relative angular velocity."""
    mu, radius = 0.3, 0.02
    friction = {"coefficient": mu, "radius": radius}
    tree = {
        "space": "space",
        "links": {
            "ground": {"points": {"P": [0, 0, 0], "Q": [0.3, 0.2, 0.1]}},
            "body": {"points": {"P": [0, 0, 0], "Q": [0.3, 0.2, 0.1]}},
        },
        "joints": {
            "P": {"type": "spherical", "links": ["ground", "body"], "friction": friction},
            "Q": {"type": "sphere_in_cylinder", "links": ["ground", "body"], "axis": [3, 2, 1]},
        },
        "drives": {"P": {"axis": [3, 2, 1], "position": 0, "speed": "2 rad/s"}},
        "loads": {"F": {"type": "force", "on": "body", "at": "P", "value": [10, -20, 5]}},
    }
    r = da.statics(mechanism(tree))
    axis = np.array([3.0, 2.0, 1.0]) / sqrt(14)
    force = r.reaction("P")[0]
    couple = radius * sin(atan(mu)) * np.linalg.norm(force)
    assert r.reaction_moment("P")[0] == pytest.approx(-couple * axis)
    assert r.effort("P") == pytest.approx([couple])
    law = [w for w in lines(working(r)) if w.letters.startswith(("r_{P}", "S_{P}", "|M_{f", "M_{f"))]
    vector = ", ".join(f"{x:.4g}".replace("-", "−") for x in -couple * axis)
    size = float(np.linalg.norm(force))
    assert [(w.letters, w.result) for w in law] == [
        ("r_{P} = R_{P} sin (arctan mu_{P})", f'{radius * sin(atan(mu)):.6f} "m"'),
        ("S_{P}", f'{size:.2f} "N"'),
        ("|M_{f12,P}| = r_{P} S_{P}", f'{couple:.4f} "N·m"'),
        ("M_{f12,P}", f'({vector}) "N·m, ground axes"'),
    ]


def test_a_rod_between_two_balls_spins_as_their_friction_lets_it() -> None:
    """The balls' couples leave nothing about the rod's line; what goes in beyond no friction is lost."""
    free = da.load(examples()["rssr"])
    tree = free.to_tree()
    for name, mu in (("A", 0.1), ("B", 0.25), ("O", 0.05)):
        tree["joints"][name]["friction"] = {"coefficient": mu, "radius": "6 mm"}
    r, bare = da.dynamics(mechanism(tree)), da.dynamics(free)
    assert set(r.status) == {"ok"}
    line = r.point("rod", "B") - r.point("rod", "A")
    couple = sum(r.reaction_moment(name, on="rod") for name in "AB")
    assert np.abs((couple * line).sum(axis=1)).max() < 1e-10 * np.abs(couple).max() * np.abs(line).max()
    lost = sum(r.power_lost(name) for name in "ABO")
    assert all((r.power_lost(name) > 0).all() for name in "ABO")
    more = (r.effort("O") - bare.effort("O")) * r.drive_speed("O")
    assert lost == pytest.approx(more, rel=1e-9)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_spins_are_where_the_moments_about_the_rods_vanish(count: int) -> None:
    """Moments that fall with each rod's spin, less with the others'; a jump as friction has one; none that vanish."""
    rng, calls = np.random.default_rng(count), []
    root = rng.uniform(-1.5, 1.5, (5, count))
    others = np.eye(count) + 0.1 * rng.uniform(-1, 1, (count, count))

    def moment(phi: np.ndarray) -> np.ndarray:
        calls.append(phi)
        off = phi - root
        return -np.asarray((off + off**3) @ others)

    assert solve_spins(root.shape, moment) == pytest.approx(root, abs=1e-13)
    assert len(calls) < 80 * count

    def partly(phi: np.ndarray) -> np.ndarray:
        left = moment(phi)
        left[0, 0] = 1.0  # that rod turns whatever its spin
        return left

    found = solve_spins(root.shape, partly)
    assert found[1:] == pytest.approx(root[1:], abs=1e-13)
    assert (found[0, 0], *partly(found)[0, 1:]) == pytest.approx([0.0] * count, abs=1e-12)
    jump = solve_spins((5, 1), lambda phi: np.where(phi < root[:, :1], 2.0, -1.0))
    assert jump == pytest.approx(root[:, :1], abs=1e-13)
    for never in (lambda phi: 1 + 0 * phi, lambda phi: phi + STEEPEST, lambda phi: 0 * phi):
        assert solve_spins((5, 1), never).tolist() == [[0.0]] * 5


@pytest.mark.parametrize("speed", ["1 rad/s", "0 rad/s"])
def test_a_rod_that_friction_cannot_hold(speed: str) -> None:
    """A couple about the rod's line larger than both balls' friction has no equilibrium, at rest neither."""
    tree = da.load(examples()["rssr"]).to_tree()
    tree["drives"]["O"] |= {"speed": speed, "acceleration": "0 rad/s^2"}
    tree["joints"]["A"]["friction"] = {"coefficient": 0.1, "radius": "6 mm"}
    line = np.subtract(
        da.load(examples()["rssr"]).point("rod", "B"), da.load(examples()["rssr"]).point("rod", "A")
    )
    value = [f"{9.0 * x} N*m" for x in line]
    tree["loads"]["turning"] = {"type": "couple", "on": "rod", "axes": "link", "value": value}
    r = da.dynamics(mechanism(tree))
    assert set(r.status) == {"no_balance"}
    assert np.isnan(r.effort("O")).all()
    assert "more than friction holds" in str(r.reasons[0])


def test_what_is_refused() -> None:
    axes = {"i": {"z": [0, 0, 1]}, "j": {"z": [1, 0, 0]}}
    with pytest.raises(da.ModelError, match="friction of a universal joint is not analysed"):
        body({"type": "universal", "axes": axes, "friction": PIN}, [0, 0, 0], [0, 0, 0])
    with pytest.raises(da.ModelError, match="its friction needs the radius of its "):
        body({"type": "revolute", "axis": [0, 0, 1], "friction": {"coefficient": 0.1}}, [0, 0, 0], [0, 0, 0])
