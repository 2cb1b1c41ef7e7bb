"""Charts read back from the paper: every point of every curve, by the axes' own labels, is the number it stands for."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.model.drives.motors import MotorCurve
from dalembert.views.charts import chart_scenes
from dalembert.views.paper.diagrams import SIZE
from dalembert.views.paper.scene import Line, Polygon, Scene
from tests.approved.printed import jumps, rubs

LBF, LBF_IN = 4.4482216152605, 0.1129848290276167
Curves = dict[str, Any]


@cache
def result(name: str, positions: int = 24) -> Any:
    return da.dynamics(da.load(examples()[name]), positions=positions)


class Chart:
    """A chart as a reader has it: labels, and curves and levels by their names in the legend."""

    def __init__(self, scene: Scene) -> None:
        lines = [i for i in scene.items if isinstance(i, Line)]
        notes = [t for t in scene.texts() if t.role == "note"]
        x = self.scale({t.at[0]: t.text for t in notes if t.at[1] == -3.2})
        y = self.scale({t.at[1]: t.text for t in notes if t.at[0] == -1.5 and t.anchor == "end"})
        legend = {t.at[1]: t.text for t in scene.texts() if t.at[0] == SIZE[0] + 11.5}
        roles = {line.role: legend[line.points[0][1]] for line in lines if line.points[0][0] == SIZE[0] + 3.0}
        self.labels = tuple(
            next(t.text for t in notes if t.at == at) for at in ((SIZE[0] / 2, -7.6), (-1.5, SIZE[1] + 4.2))
        )
        self.curves: Curves = {}
        for line in lines:
            if line.role in roles and line.points[0][0] <= SIZE[0]:
                at = np.array(line.points)
                self.curves[roles[line.role]] = np.stack([x(at[:, 0]), y(at[:, 1])])

    @staticmethod
    def scale(ticks: dict[float, str]) -> Any:
        values = {at: float(text.replace("−", "-")) for at, text in ticks.items()}
        a, b = min(values), max(values)
        assert a < b
        for at, value in values.items():
            assert value == pytest.approx(
                np.interp(at, [a, b], [values[a], values[b]]), abs=1e-9 * abs(values[b])
            )
        return lambda at: values[a] + (at - a) * (values[b] - values[a]) / (b - a)


def check(scene: Scene, labels: tuple[str, str], x: Any, known: Curves) -> None:
    """Every curve, at least so far as it is known; of whole turns the beginning is drawn once more."""
    chart = Chart(scene)
    assert chart.labels == labels
    assert list(chart.curves) == list(known)
    off = max(float(np.nanmax(np.abs(curve))) for curve in known.values())
    for name, curve in known.items():
        places, values = chart.curves[name]
        if np.ndim(curve) == 0:
            np.testing.assert_allclose(values, [curve, curve], atol=1e-6 * off)
            continue
        assert len(values) in (len(curve), len(curve) + 1)
        np.testing.assert_allclose(places[: len(x)], x, atol=1e-6 * np.abs(x).max())
        np.testing.assert_allclose(values[: len(curve)], curve, atol=1e-6 * off, err_msg=name)
        assert values[-1] == pytest.approx(curve[-1 if len(values) == len(curve) else 0], abs=1e-6 * off)


def path(scene: Scene, role: str = "curve-1") -> Any:
    """A hodograph's points in the unit of its circles."""
    line = max(
        (i for i in scene.items if isinstance(i, Line) and i.role == role), key=lambda i: len(i.points)
    )
    return np.array(line.points) * scene.scales["force"]


def components(v: Any) -> Curves:
    return dict(zip("xyz", v.T, strict=False)) | {"magnitude": np.linalg.norm(v, axis=1)}


def test_charts_of_a_machine_in_the_plane() -> None:
    r = result("four_bar")
    charts = {s.title: s for s in chart_scenes(r)}
    x, effort = np.degrees(r.drive_position("O2")), r.effort("O2") / LBF_IN
    mean = f"mean of O2: {effort.mean():.1f}".replace("-", "−")
    (named,) = (name for name in Chart(charts["Drive effort"]).curves if name.startswith("mean"))
    assert float(named.rpartition(" ")[2].replace("−", "-")) == pytest.approx(effort.mean(), rel=1e-3), mean
    check(charts["Drive effort"], ("O2 in °", "Torque in lbf·in"), x, {"O2": effort, named: effort.mean()})
    forces = {j: np.linalg.norm(r.reaction(j), axis=1) / LBF for j in r.joints}
    check(charts["Joint forces"], ("O2 in °", "Joint force in lbf"), x, forces)
    heads = {"O2": "2 crank", "A": "3 coupler", "B": "4 rocker", "O4": "4 rocker"}
    for joint, link in heads.items():
        check(
            charts[f"Joint {joint}: force on link {link}"],
            ("O2 in °", "Force in lbf"),
            x,
            components(r.reaction(joint) / LBF),
        )
        for axes, whose in (("ground", "ground axes"), ("link", "the link's axes")):
            drawn = path(charts[f"Joint {joint} on link {link}, {whose}"])
            on = r.mechanism.joints[joint].links[1]
            known = r.reaction(joint, on=on, axes=axes) / LBF
            np.testing.assert_allclose(drawn[:-1], known, atol=1e-6 * np.abs(known).max())
            np.testing.assert_array_equal(drawn[-1], drawn[0])
    shaken = da.shaking(r).force / LBF
    np.testing.assert_allclose(
        path(charts["Shaking force on the ground"])[:-1], shaken, atol=1e-6 * np.abs(shaken).max()
    )


def test_charts_of_a_machine_in_space() -> None:
    """Components in the joint's axes; what is rounding has no chart."""
    r = result("rssr")
    charts = {s.title: s for s in chart_scenes(r)}
    x = np.degrees(r.drive_position("O"))
    force = {j: r.reaction(j) for j in r.joints}
    moment = {j: r.reaction_moment(j) * 1e3 for j in r.joints}
    check(
        charts["Joint forces"],
        ("O in °", "Joint force in N"),
        x,
        {j: np.linalg.norm(v, axis=1) for j, v in force.items()},
    )
    turned = {j: np.linalg.norm(v, axis=1) for j, v in moment.items() if np.abs(v).max() > 1e-6}
    assert set(turned) == {"O", "C"}
    check(charts["Joint moments"], ("O in °", "Joint moment in N·mm"), x, turned)
    for joint in r.joints:
        link = {"O": "2 crank", "A": "3 rod", "B": "4 rocker", "C": "4 rocker"}[joint]
        title = f"Joint {joint}: {{}} on link {link}, joint's axes"
        own = r.reaction(joint, axes="joint")
        check(charts[title.format("force")], ("O in °", "Force in N"), x, components(own))
        assert (title.format("moment") in charts) == (joint in turned)
        if joint in turned:
            own = r.reaction_moment(joint, axes="joint") * 1e3
            check(charts[title.format("moment")], ("O in °", "Moment in N·mm"), x, components(own))
    check(
        charts["Shaking force on the ground"],
        ("O in °", "Force in N"),
        x,
        components(da.shaking(r).force),
    )


def test_charts_of_shaking_and_its_harmonics() -> None:
    r = result("four_bar")
    s = da.shaking(r)
    polar, parts, moment, bars = s.drawings()
    x, force = np.degrees(r.drive_position("O2")), s.force / LBF
    np.testing.assert_allclose(path(polar)[:-1], force, atol=1e-6 * np.abs(force).max())
    check(parts, ("O2 in °", "Force in lbf"), x, components(force))
    check(moment, ("O2 in °", "Moment in lbf·in"), x, {"moment": s.moment / LBF_IN})
    assert moment.title == f"Shaking moment about {s.about}"
    spectrum = np.fft.rfft(force, axis=0) / len(force)
    sizes = 2 * np.abs(spectrum[1:7])
    np.testing.assert_allclose(bars.numbers["amplitude"], sizes, rtol=1e-9)
    scale = Chart.scale({t.at[1]: t.text for t in bars.texts() if t.at[0] == -1.5 and t.anchor == "end"})
    for c in range(2):
        drawn = [i.points for i in bars.items if isinstance(i, Polygon) and i.role == f"curve-{c + 1}"]
        np.testing.assert_allclose([scale(p[2][1]) for p in drawn], sizes[:, c], rtol=1e-6)
        for k, points in enumerate(drawn):
            left = (k + 0.15 + 0.35 * c) * 84.0 / 6
            assert [p[0] for p in points] == pytest.approx([left, left + 4.9, left + 4.9, left])
            assert (points[0][1], points[3][1]) == (0.0, points[2][1])
    orders = {t.at[0]: t.text for t in bars.texts() if t.at[1] == -3.2}
    assert orders == {(k + 0.5) * 14.0: str(k + 1) for k in range(6)}
    texts = {t.text for t in bars.texts()}
    assert {"order", "Amplitude in lbf", "x", "y", "Harmonics of the force"} <= texts


@pytest.mark.parametrize(("turns", "sense"), [(25.0, 1.0), (-25.0, 1.0), (25.0, -1.0)])
def test_charts_of_a_motor_and_its_drive(turns: float, sense: float) -> None:
    """What its curve allows is drawn up to its fastest speed, whichever sense of turning it is given for."""
    r = da.dynamics(da.load(examples()["four_bar"]).with_values({"drives.O2.speed": turns}), positions=24)
    points = sorted([(0.0, 900.0 * sense), (200.0 * sense, 300.0 * sense)])
    curve = MotorCurve(*zip(*points, strict=True))
    c = da.motor(r, inertia=0.002, ratio=3.0, curve=curve)
    x = np.degrees(r.drive_position("O2"))
    scenes = {s.title: s for s in c.drawings()}
    speed = r.drive_speed("O2")
    check(scenes["Effort of O2"], ("O2 in °", "Effort in lbf·in"), x, {"effort": r.effort("O2") / LBF_IN})
    check(scenes["Speed of O2"], ("O2 in °", "Speed in rad/s"), x, {"speed": speed})
    check(
        scenes["Power of O2"], ("O2 in °", "Power in lbf·in/s"), x, {"power": r.effort("O2") * speed / LBF_IN}
    )
    for name, need in c.needs.items():
        (title,) = (t for t in scenes if t.startswith(f"Motor, {name}: ratio"))
        assert float(title.rpartition(" ")[2]) == pytest.approx(need.ratio, rel=1e-3)
        n = need.ratio
        torque = r.effort("O2") / n + 0.002 * n * r.drive_acceleration("O2")
        allowed = np.interp(n * np.abs(speed), [0.0, 200.0], [900.0, 300.0], right=np.nan)
        known = {"torque": torque / LBF_IN}
        if np.isfinite(allowed).all():
            known["allowed"] = allowed / LBF_IN
        else:
            assert need.enough is False
        check(scenes[title], ("O2 in °", "Torque in lbf·in"), x, known)


@pytest.mark.parametrize("turns", [25.0, -25.0])
def test_charts_of_a_flywheel(turns: float) -> None:
    steady = da.load(examples()["four_bar"]).with_values(
        {"drives.O2.speed": turns, "drives.O2.acceleration": 0.0}
    )
    r = da.dynamics(steady, positions=72)
    f = da.flywheel(r, Cs=0.02)
    turning, energy, *speeds = f.drawings()
    x, torque = np.degrees(r.drive_position("O2")), r.effort("O2") / LBF_IN
    labels = ("O2 in °", "Torque in lbf·in")
    check(turning, labels, x, {"effort": torque, "mean": np.full_like(torque, torque.mean())})
    check(energy, ("O2 in °", "Energy in lbf·in"), x, {"E": f.energy / LBF_IN})
    for scene in speeds:
        chart = Chart(scene)
        assert chart.labels == ("O2 in °", "Speed off its mean in %")
        for name, (places, values) in chart.curves.items():
            s = f.exact if name == "book's flywheel" else f.exact_size
            known = 100 * (np.interp(np.radians(places[:-1]), s.angle, s.speed) / abs(f.size.speed) - 1)
            np.testing.assert_allclose(values[:-1], known, atol=1e-6)


def test_charts_of_bearings() -> None:
    r = result("four_bar")
    t = da.bearings(r)
    scenes = {s.title: s for s in t.drawings()}
    x = np.degrees(r.drive_position("O2"))
    forces = {j: np.linalg.norm(r.reaction(j), axis=1) / LBF for j in t.loads}
    check(scenes["Radial force of the joints"], ("O2 in °", "Radial force in lbf"), x, forces)
    rates = {}
    for j in t.loads:
        i, k = r.mechanism.joints[j].links
        rates[j] = abs(r.speed(k) - (r.speed(i) if i != "ground" else 0.0))
    drawn = Chart(scenes["Turning of the joints"])
    assert drawn.labels == ("O2 in °", "Turning in rad/s")
    for j, (_, values) in drawn.curves.items():
        np.testing.assert_allclose(np.abs(values[:-1]), rates[j], atol=1e-6 * np.abs(rates[j]).max())
    for j in list(t.loads)[:2]:
        (title,) = (k for k in scenes if k.startswith(f"Joint {j} on") and "ground" in k)
        np.testing.assert_allclose(path(scenes[title])[:-1], r.reaction(j) / LBF, atol=1e-4)


@pytest.mark.parametrize("made", [rubs, jumps])
def test_what_has_two_sides_at_a_position_is_drawn_once_there(made: Any) -> None:
    """Answers of machine design have the numbers just before a reversal or a jump."""
    r = da.dynamics(made())
    assert r.after is not None
    assert "reversal" in r.status or "jump" in r.status
    choice = da.motor(r)
    _, values = Chart(choice.drawings()[0]).curves["effort"]
    before = r.before.effort(choice.drive)
    assert values == pytest.approx(before, abs=1e-6 * np.abs(before).max())
    if made is rubs:
        answers = da.bearings(r), da.balance(r, ["crank"])
        assert all(len(answer.drawings()) > 1 and str(da.report(answer)) for answer in answers)


def test_charts_of_a_motion_under_forces() -> None:
    text = """
    gravity: [0, -9.80665]
    links:
      ground: {points: {O: [0, 0]}}
      arm: {points: {O: [0, 0], P: [0.3, 0]}, mass: 2, center: [0.2, 0], inertia: 0.01}
    joints: {O: {type: pin, links: [ground, arm], damping: 0.02}}
    drives: {O: {effort: 1.5}}
    start: {O: {position: -60 deg, speed: 0}}
    """
    s = da.simulate(da.loads(text), 1.0, count=21)
    speed, effort, energies = s.drawings()
    assert [x.title for x in (speed, effort, energies)] == ["Speed of O", "Effort of O", "Energies and works"]
    labels = ("Time in s", "Speed in rad/s")
    check(speed, labels, s.time, {"speed": s.speed("O")})
    check(effort, ("Time in s", "Effort in N·m"), s.time, {"effort": np.full(21, 1.5)})
    q, w = s.position("O"), s.speed("O")
    height = 0.2 * (np.sin(q) - np.sin(q[0]))
    known = {"kinetic": 0.5 * (0.01 + 2 * 0.04) * w**2, "potential": 2 * 9.80665 * height}
    chart = Chart(energies)
    assert chart.labels == ("Time in s", "Energy in J")
    for name, curve in known.items():
        np.testing.assert_allclose(chart.curves[name][1], curve, atol=1e-6 * np.abs(curve).max())
    works = {name: values for name, (_, values) in chart.curves.items() if name.startswith("work of ")}
    np.testing.assert_allclose(sum(works.values()), known["kinetic"] + known["potential"], atol=1e-5)
    assert 1.5 * (q - q[0]) == pytest.approx(works["work of O"], abs=1e-5)
