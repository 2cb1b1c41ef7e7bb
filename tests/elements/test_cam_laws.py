"""Laws of cams on random machines, beside oracles that share nothing with the program: envelopes, driven followers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.arrays import Array
from tests.elements.random_cams import Case
from tests.tiers import over, over_seeds


def turned(angle: Array | float, u: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * u[..., 0] - s * u[..., 1], s * u[..., 0] + c * u[..., 1]], axis=-1)


def law_of(case: Case, m: da.Mechanism, th: Array) -> Array:
    """Lift and its derivatives over the cam's turn, which is over its drive or against it."""
    sign = -1.0 if case.sense == "cw" else 1.0
    s = m.joints["F"].profile.segments.programme.curve.at(np.mod(sign * th, 2 * math.pi))  # type: ignore[union-attr]
    return np.stack([s[0], sign * s[1], s[2]])


def with_driven_follower(case: Case, r: Any) -> Any:
    """The machine without its cam, the follower driven by the law."""
    tree, th = case.frame(), r.schedule.position[:, 0]
    s, first, second = law_of(case, r.mechanism, th)
    w, a = case.speeds
    start = r.freedom("Q", "turn" if case.swings else "slide")[0][0] - s[0]
    kinds = ("rad", "rad/s", "rad/s^2") if case.swings else ("m", "m/s", "m/s^2")
    values = (start + s, first * w, second * w * w + first * a)
    keys = ("position", "speed", "acceleration")
    turns = tree["drives"]["O"]
    turns["position"] = [f"{x!r} rad" for x in th.tolist()]
    tree["drives"]["Q"] = {
        key: [f"{x!r} {unit}" for x in part.tolist()]
        for key, part, unit in zip(keys, values, kinds, strict=True)
    }
    return da.dynamics(
        da.mechanism(tree | {"assembly": {"follower": math.degrees(float(r.angle("follower")[0]))}})
    )


@over_seeds((0, 1, 2, 3, 4, 38), range(5, 200))  # 38: an offset of 0.1 mm, which is no measure of the cam
def test_a_cam_is_a_follower_driven_by_its_law(seed: int) -> None:
    """Motion; the power that the cam gives the follower is that of its drive; the cam's drive pays for it."""
    case = Case(seed)
    r = da.dynamics(da.mechanism(case.tree()))
    assert r.ok.all()
    other = with_driven_follower(case, r)
    for link in ("cam", "follower"):
        for read in ("position", "angle", "speed", "acceleration", "center_acceleration"):
            ours, theirs = getattr(r, read)(link), getattr(other, read)(link)
            assert ours == pytest.approx(theirs, rel=1e-9, abs=1e-9 * max(1.0, float(np.abs(ours).max())))
    rate = r.freedom("Q", "turn" if case.swings else "slide")[1]
    given = other.effort("Q") * rate
    arm = turned(r.angle("follower"), np.array(r.mechanism.joint_points("F")[1]))
    point = r.velocity("follower") + r.speed("follower")[:, None] * np.stack([-arm[:, 1], arm[:, 0]], axis=-1)
    force, moment = r.reaction("F", on="follower"), r.moment_array[:, r.joints.index("F")]
    power = (force * point).sum(axis=1) + moment * r.speed("follower")
    scale = float(np.abs(r.force_array).max()) * 0.1 * float(np.abs(case.speeds[0]))
    assert power == pytest.approx(given, abs=1e-10 * scale)
    assert r.effort("O") * case.speeds[0] == pytest.approx(
        other.effort("O") * case.speeds[0] + given, abs=1e-10 * scale
    )
    assert r.residual.max() < 1e-12
    assert np.abs(r.power_balance).max() < 1e-12


def envelope(case: Case, c: Any, th: Array) -> Array:
    """Outline of the cam by the envelope of the follower's places in its axes, from central differences."""
    motion, step = c.motion, 1e-5
    sense = -1.0 if case.sense == "cw" else 1.0

    def place(t: Array) -> tuple[Array, Array]:
        y = motion.height(t)
        at, angle = motion.placed(y)
        return turned(-sense * t, at), angle - sense * t

    at, angle = place(th)
    (ahead, after), (behind, before) = place(th + step), place(th - step)
    way = (ahead - behind) / (2 * step)
    if not case.flat:
        aside = np.stack([-way[:, 1], way[:, 0]], axis=-1) / np.hypot(*way.T)[:, None]
        outward = np.where((aside * at).sum(axis=1) > 0, 1.0, -1.0)
        radius = 0.0 if case.follower == "knife" else case.follower["roller"]
        return at - radius * outward[:, None] * aside
    # lines n . x = h: also n' . x = h'
    normals, heights = [], []
    face = motion.shape.normal
    for p, a in ((ahead, after), (at, angle), (behind, before)):
        n = turned(a, np.broadcast_to(face, p.shape))
        normals.append(n)
        heights.append((n * p).sum(axis=1))
    n, slope = normals[1], (normals[0] - normals[2]) / (2 * step)
    h, rise = heights[1], (heights[0] - heights[2]) / (2 * step)
    return np.linalg.solve(np.stack([n, slope], axis=1), np.stack([h, rise], axis=1)[..., None])[..., 0]


@over(6, 200)
def test_the_outline_is_the_envelope_of_the_follower(seed: int) -> None:
    case = Case(seed)
    c = da.cam(da.mechanism(case.tree()), "F")
    joins = np.array([0.0, *c.joins, 2 * math.pi])
    th = np.linspace(0.05, 6.2, 60)
    th = th[np.abs(th[:, None] - joins).min(axis=1) > 1e-3]
    assert c.profile(th) == pytest.approx(envelope(case, c, th), abs=2e-9)


@over(3, 60)
def test_the_lift_of_a_design_is_the_law(seed: int) -> None:
    """With its derivatives."""
    case = Case(seed)
    m = da.mechanism(case.tree())
    c, th = da.cam(m, "F"), np.linspace(0.01, 6.2, 50)
    s = m.joints["F"].profile.segments.programme.curve.at(th)  # type: ignore[union-attr]
    for order in range(4):
        assert c.lift(th)[order] == pytest.approx(s[order], abs=1e-9 * float(np.abs(s[order]).max()))


@over(3, 60)
def test_curvature_and_pressure_angle_are_those_of_the_outline(seed: int) -> None:
    """By differences of the outline, and of the follower's place of contact."""
    case, step = Case(seed), 1e-4
    c = da.cam(da.mechanism(case.tree()), "F")
    joins = np.array([0.0, *c.joins, 2 * math.pi])
    th = np.linspace(0.05, 6.2, 60)
    th = th[np.abs(th[:, None] - joins).min(axis=1) > 2e-3]
    p, q, o = c.profile(th + step), c.profile(th - step), c.profile(th)
    v, a = (p - q) / (2 * step), (p - 2 * o + q) / step**2
    sense = -1.0 if case.sense == "cw" else 1.0
    curvature = -sense * (v[:, 0] * a[:, 1] - v[:, 1] * a[:, 0]) / np.hypot(*v.T) ** 3
    known = np.hypot(*v.T) > 1e-3
    assert (1 / c.profile_radius(th))[known] == pytest.approx(curvature[known], rel=1e-4, abs=1e-3)


def disc(flat: bool, seed: int) -> dict[str, Any]:
    """A disc under a roller, or a flat face, that slides."""
    case = Case(3 * (2 * seed) + (2 if flat else 1))
    tree = case.tree()
    tree["joints"]["F"]["profile"] = {"eccentric": 0.012, "radius": 0.05}
    return tree


@over(2, 40)
def test_an_eccentric_disc_is_a_crank_with_a_rod(seed: int) -> None:
    """In motion and in force: crank e, rod R + r."""
    tree = disc(False, seed)
    r = da.dynamics(da.mechanism(tree))
    radius = 0.05 + tree["joints"]["F"]["follower"]["roller"]
    tree["links"]["rod"] = {"points": {"A": [0, 0], "F": [radius, 0]}}
    tree["links"]["cam"]["points"]["A"] = [0.012, 0]
    tree["joints"]["A"] = {"type": "pin", "links": ["cam", "rod"]}
    tree["joints"]["F"] = {"type": "pin", "links": ["rod", "follower"]}
    tip = r.position("follower")[0] - r.mechanism.joint_points("O")[0]
    angle = math.degrees(math.atan2(*(tip - turned(r.angle("cam")[0], np.array([0.012, 0.0])))[::-1]))
    other = da.dynamics(da.mechanism(tree | {"assembly": {"rod": angle}}))
    scale = float(np.abs(r.force_array).max())
    for joint in ("O", "Q", "F"):
        on = r.mechanism.joints[joint].links[1]
        assert np.abs(r.reaction(joint, on) - other.reaction(joint, on)).max() < 1e-9 * scale
    assert r.effort("O") == pytest.approx(other.effort("O"), abs=1e-9 * scale)
