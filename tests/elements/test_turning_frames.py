"""A plane that turns: centrifugal forces against forces written out, energies, loads by the speed, wrong files."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import dalembert as da
from tests.random_mechanisms import random_case
from tests.tiers import over_seeds

RPM = math.pi / 30


def turned(seed: int, speed: object = "7 rad/s") -> dict[str, Any]:
    """A random mechanism in a plane that turns about a random line, some links of it bars."""
    rng = np.random.default_rng(seed)
    made = dict(random_case(seed).tree)
    made["gravity"] = "none"
    links = {}
    for k, (name, link) in enumerate(made["links"].items()):
        some = dict(link)
        if name != "ground" and some.get("mass") and k % 2:
            some.pop("center", None), some.pop("inertia", None)
            some["shape"] = {"type": "box", "size": [0.3, 0.1, 0.02], "center": [0.07, -0.02]}
        links[name] = some
    turning = {"axis": float(rng.uniform(-90, 90)), "at": rng.uniform(-1, 1, 2).tolist(), "speed": speed}
    return {**made, "links": links, "turning": turning}


def axes(m: da.Mechanism) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors along the axis and outward."""
    e = np.array([math.cos(m.turning.axis), math.sin(m.turning.axis)])
    return e, np.array([e[1], -e[0]])


def written(m: da.Mechanism, r: da.Result, square: float) -> dict[str, Any]:
    """Centrifugal forces and couples of the first position as loads: of a box four points of its mass (Gauss)."""
    _, n = axes(m)
    loads = {}
    for link in r.links:
        mass = m.mass(link)
        if not mass:
            continue
        inside = [(0.0, 0.0)]
        if m.links[link].shapes:
            inside = [(sx * 0.15 / 3**0.5, sy * 0.05 / 3**0.5) for sx in (1, -1) for sy in (1, -1)]
        for k, (u, v) in enumerate(inside):
            at = np.add(m.center(link), (u, v))
            c, s = r.rotation_array[0, r.links.index(link)]
            place = r.point_array[0, r.links.index(link)] + _turn(c, s, at - _origin(m, r, link))
            place = place + r.compiled.origin
            pull = mass / len(inside) * square * float((place - np.array(m.turning.at)) @ n) * n
            loads[f"pull {link} {k}"] = {
                "type": "force",
                "on": link,
                "at": at.tolist(),
                "value": pull.tolist(),
            }
    return loads


def _turn(c: float, s: float, u: np.ndarray) -> np.ndarray:
    return np.array([c * u[0] - s * u[1], s * u[0] + c * u[1]])


def _origin(m: da.Mechanism, r: da.Result, link: str) -> np.ndarray:
    return np.array(r.compiled.layout.reference[r.links.index(link)])


@over_seeds((2,), range(3, 200))
def test_centrifugal_forces_are_those_written_out_as_loads(seed: int) -> None:
    made = turned(seed)
    m = da.mechanism(made)
    r = da.dynamics(m)
    plain = {k: v for k, v in made.items() if k != "turning"}
    loads = {**plain.get("loads", {}), **written(m, r, 49.0)}
    other = da.dynamics(da.mechanism({**plain, "loads": loads}))
    size = float(np.abs(other.force_array[0]).max())
    for a, b in ((r.force_array, other.force_array), (r.moment_array, other.moment_array)):
        assert a[0] == pytest.approx(b[0], abs=1e-9 * size)
    assert r.effort_array[0] == pytest.approx(other.effort_array[0], abs=1e-9 * size)
    assert da.virtual_work(r).gap.max() < 1e-9
    quick, careful = r, da.dynamics(m, method="careful")
    assert quick.effort_array == pytest.approx(careful.effort_array, abs=1e-9 * size)


@over_seeds((0, 2), range(3, 200))
def test_an_effort_met_by_the_speed_is_that_of_the_speed(seed: int) -> None:
    """The effort at a speed, given back: the speed comes out, in the analyses and in machine code."""
    made = turned(seed)
    r = da.statics(da.mechanism(made))
    drive = r.drives[seed % len(r.drives)]
    drives = {n: {**d, "position": float(r.drive_position(n)[0])} for n, d in made["drives"].items()}
    drives = {
        n: {**d, "position": f"{d['position']} {'rad' if da.mechanism(made).drives[n].turns else 'm'}"}
        for n, d in drives.items()
    }
    unit = "N*m" if da.mechanism(made).drives[drive].turns else "N"
    drives[drive]["effort"] = f"{float(r.effort(drive)[0])!r} {unit}"
    asked = {**made, "drives": drives, "turning": {**made["turning"], "speed": "unknown"}}
    m = da.mechanism(asked)
    for method in ("auto", "careful"):
        found = da.statics(m, method=method)  # type: ignore[arg-type]
        if found.status[0] == "no_balance":  # some drives move no mass across the axis
            assert not math.isfinite(found.turning_speed[0]) or found.turning_speed[0] < 1e-3
            return
        if "gear" in {j.type for j in m.joints.values()}:  # |F_t| makes two speeds of one effort
            again = da.statics(
                da.mechanism(made).with_values({"turning.speed": float(found.turning_speed[0])})
            )
            assert again.effort(drive)[0] == pytest.approx(r.effort(drive)[0], rel=1e-7)
            return
        assert found.turning_speed[0] == pytest.approx(7.0, rel=1e-7)
        size = float(np.abs(r.force_array[0]).max())
        assert found.force_array[0] == pytest.approx(r.force_array[0], abs=1e-7 * size)


ROD = """units: {length: m}
gravity: standard
links: {ground: {points: {O: [0, 0]}}, rod: {points: {O: [0, 0]}, mass: 2, center: [0.3, 0]}}
joints: {O: {type: pin, links: [ground, rod]}}
drives: {O: {position: -40 deg}}
turning: {axis: y, speed: 8 rad/s}
"""

WRONG = yaml.safe_load(Path(__file__).with_name("wrong_turning.yaml").read_text("utf-8"))


@pytest.mark.parametrize("case", WRONG, ids=lambda case: case["new"])
def test_a_wrong_file_is_refused_at_its_line(case: dict[str, str]) -> None:
    assert case["old"] in ROD
    with pytest.raises(da.ModelError) as refused:
        da.loads(ROD.replace(case["old"], case["new"]))
    assert str(refused.value).split(": ", 1)[1] == case["says"]


def test_what_has_no_answer_says_why() -> None:
    """A rod above its pin falls inwards: no speed holds it."""
    asked = ROD.replace("speed: 8 rad/s", "speed: unknown")
    r = da.statics(da.loads(asked.replace("-40 deg", "[40 deg, -40 deg]")))
    assert r.status == ("no_balance", "ok")
    assert r.reasons[0] == (
        "No speed of turning gives O its effort at O = 40 deg: the centrifugal forces would have to pull towards the "
        "axis. Change the range of the motion, the loads or the effort."
    )
    assert np.isnan(r.turning_speed[0])
    assert np.isnan(r.effort_array[0]).all()
    assert r.turning_speed[1] ** 2 == pytest.approx(9.80665 / 0.3 / math.sin(math.radians(40)), rel=1e-12)
    with pytest.raises(da.ModelError, match="the speed of turning is unknown, and forces move the machine"):
        da.simulate(da.loads(asked.replace("-40 deg", "-40 deg, effort: 0")), until="1 s")
    with pytest.raises(da.ModelError, match="a plane that turns is not lifted"):
        da.lifted(da.loads(ROD))
    with pytest.raises(da.ModelError, match="the plane of this mechanism does not turn"):
        _ = da.statics(da.four_bar()).turning_speed


@pytest.mark.parametrize("lean", [60, 120])
def test_gravity_is_along_an_axis_that_leans(lean: float) -> None:
    text, c, s = (
        ROD.replace("axis: y", f"axis: {lean} deg"),
        math.cos(math.radians(lean)),
        math.sin(math.pi / 3),
    )
    assert da.statics(da.loads(text.replace("gravity: standard", f"gravity: [{-9 * c}, {-9 * s}]"))).ok.all()
    with pytest.raises(da.ModelError, match="gravity is not along the axis of turning"):
        da.loads(text.replace("gravity: standard", f"gravity: [{9 * c}, {-9 * s}]"))


def test_centrifugal_forces_of_rounding_have_no_power() -> None:
    """A rod along the axis, but for the rounding of its angle, and one straight out; a hair off both have a speed."""
    asked = ROD.replace("speed: 8 rad/s", "speed: unknown")
    m = da.loads(asked.replace("-40 deg", "[-90 deg, -180 deg, -89.999 deg, -0.001 deg]"))
    b = da.compile(m, ["links.rod.mass"], ["reaction.O"], lanes=1)
    answers = [da.statics(m), da.statics(m), da.statics(m, method="careful")]
    for status in (*(r.status for r in answers), tuple(b([[1.0]]).status[0])):
        assert status == ("no_balance", "no_balance", "ok", "ok")
    assert "the centrifugal forces have no power here" in str(answers[0].reasons[0])
    assert np.isfinite(answers[0].turning_speed).tolist() == [False, False, True, True]


def test_energy_in_the_turning_plane_is_constant() -> None:
    m = da.loads(ROD.replace("-40 deg", "-40 deg, effort: 0"))
    s = da.simulate(m, until="1 s")
    assert np.ptp(s.kinetic + s.potential) < 1e-9 * np.ptp(s.kinetic)


def test_machine_code_has_the_speed_and_its_slopes() -> None:
    m = da.loads(ROD.replace("speed: 8 rad/s", "speed: unknown"))
    k = da.compile(m, vary=["links.rod.center.0"], outputs=["turning_speed", "reaction.O"], derivatives=True)
    found = k([[0.3], [0.5]])
    assert found["turning_speed"][:, 0] == pytest.approx(
        np.sqrt(9.80665 / np.array([0.3, 0.5]) / math.sin(math.radians(40))), rel=1e-12
    )
    slope = found.gradient("turning_speed")
    assert np.ravel(slope) == pytest.approx(
        -found["turning_speed"][:, 0] / 2 / np.array([0.3, 0.5]), rel=1e-12
    )
