"""Belts with idlers: tensions by a hand-written equilibrium, wheels that take torque, motions, messages."""

from __future__ import annotations

import math
from random import Random
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.tiers import over_seeds

FILE = """units: {length: mm, force: N, mass: kg, moment: N*m, angle: deg}
links:
  ground: {points: {A: [0, 0], B: [500, 0], L: [150, 240], D: [260, -150]}}
  motor: {points: {A: [0, 0]}, inertia: 0.01 kg*m^2}
  fan: {points: {B: [0, 0]}, inertia: 0.2 kg*m^2}
  pump: {points: {D: [0, 0]}, inertia: 0.03 kg*m^2}
  arm: {points: {L: [0, 0], I: [100, -170], W: [300, 0]}}
joints:
  A: {type: pin, links: [ground, motor]}
  B: {type: pin, links: [ground, fan]}
  D: {type: pin, links: [ground, pump]}
  L: {type: pin, links: [ground, arm]}
  belt: {type: belt, links: [motor, fan], at: [A, B], radii: [60, 120], friction: {coefficient: 0.4}, idlers: [
    {at: arm.I, radius: 30, strand: left}, {at: pump.D, radius: 50, strand: right, side: inside}]}
drives: {A: {position: 0, speed: -100 rad/s}}
loads:
  fan: {type: couple, on: fan, value: 15}
  pump: {type: couple, on: pump, value: 5}
  weight: {type: force, on: arm, at: W, value: [0, -200]}
assembly: {arm: 0}
"""


def between(a: Any, b: Any) -> np.ndarray:
    """Unit vector of the line that passes circles (x, y, r) on their left where r > 0, on their right where r < 0."""
    d = np.subtract(b[:2], a[:2])
    angle = math.atan2(d[1], d[0]) - math.asin((a[2] - b[2]) / math.hypot(*d))
    return np.array([math.cos(angle), math.sin(angle)])


@over_seeds([3, 40], range(200))
def test_tensions_by_the_equilibrium_of_every_wheel(seed: int) -> None:
    """The arm's moment gives the tension of its strand, each wheel's torque the next one's."""
    rng = Random(seed)
    radii = [rng.uniform(0.04, 0.09), rng.uniform(0.06, 0.14)]
    idler, push, torque = rng.uniform(0.015, 0.04), rng.uniform(100, 400), rng.uniform(-4, 4)
    angle, inside = rng.uniform(-10, 10), rng.random() < 0.4
    tree = da.loads(FILE).to_tree()
    tree["joints"]["belt"] |= {
        "radii": [f"{r} m" for r in radii],
        "idlers": [{"at": "arm.I", "radius": f"{idler} m", "strand": "left"}],
    }
    del tree["links"]["pump"], tree["joints"]["D"], tree["loads"]["pump"]
    tree["loads"]["fan"]["value"] = f"{torque} N*m"
    tree["loads"]["weight"]["value"] = [0, f"{-push if not inside else push} N"]
    if inside:
        tree["joints"]["belt"]["idlers"][0]["side"] = "inside"
        tree["links"]["ground"]["points"]["L"] = [150, 310]
    tree["assembly"]["arm"] = angle
    m = da.mechanism(tree)
    r = da.statics(m)
    assert r.status == ("ok",)
    turn = math.radians(angle)
    arm = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    pivot = np.array([0.15, 0.31 if inside else 0.24])
    center, end = pivot + arm @ [0.1, -0.17], arm @ [0.3, 0.0]
    wheels = [(0, 0, radii[0]), (*center, idler if inside else -idler), (0.5, 0, radii[1])]
    u = [between(wheels[0], wheels[1]), between(wheels[1], wheels[2]), between(wheels[2], wheels[0])]
    bend = u[1] - u[0]
    lever = center - pivot
    upper = -(end[0] * (push if inside else -push)) / (lever[0] * bend[1] - lever[1] * bend[0])
    lower = upper + torque / radii[1]
    b = r.rope("belt")
    assert b.tension.min() > 0
    assert b.tension[0] == pytest.approx([upper, upper, lower], rel=1e-9)
    assert r.effort("A")[0] == pytest.approx(-torque * radii[0] / radii[1], rel=1e-9, abs=1e-9)
    shaft = upper * u[0] - lower * u[2]
    assert r.belt("belt").shaft_force[0] == pytest.approx(math.hypot(*shaft), rel=1e-9)
    assert r.reaction("A", on="motor")[0] == pytest.approx(-shaft, rel=1e-9)


def test_tensions_change_where_a_wheel_takes_torque() -> None:
    """Clockwise from the motor's wheel: over the idler, round the fan, round the pump, and back."""
    m = da.loads(FILE)
    for method in ("auto", "careful"):
        r = da.statics(m, method=method)  # type: ignore[arg-type]
        assert r.status == ("ok",)
        rope, b = r.rope("belt"), r.belt("belt")
        first, second, third, last = rope.tension[0]
        assert first == pytest.approx(second, rel=1e-12)
        assert third - second == pytest.approx(15 / 0.12)
        assert last - third == pytest.approx(5 / 0.05)
        assert r.effort("A")[0] == pytest.approx(-(15 / 0.12 + 5 / 0.05) * 0.06)
        assert (b.tight[0], b.slack[0]) == pytest.approx((last, first))
        assert b.torque[0] == pytest.approx([(last - first) * 0.06, -15])
        ratios = (third / second, last / third, last / first)
        needed = max(math.log(x) / rope.wrap[0, k] for x, k in zip(ratios, (1, 2, 3), strict=True))
        assert b.slip_coefficient[0] == pytest.approx(needed)
    assert da.loads(str(m)) == m
    assert "strand  tension" in str(r)


def test_a_belt_slips_on_the_wheel_that_holds_it_least() -> None:
    """Just below the coefficient that it needs and just above; in a V groove it needs less."""
    r = da.statics(da.loads(FILE))
    needed = r.belt("belt").slip_coefficient[0]
    for part, status in ((1 - 1e-6, "slips"), (1 + 1e-6, "ok")):
        text = FILE.replace("coefficient: 0.4", f"coefficient: {float(needed * part)!r}")
        assert da.statics(da.loads(text)).status == (status,)
        grooved = text.replace("radii: [60, 120]", "radii: [60, 120], groove: 38")
        assert da.statics(da.loads(grooved)).status == ("ok",)
    slipping = da.statics(da.loads(FILE.replace("coefficient: 0.4", "coefficient: 0.05")))
    assert slipping.reasons[0].startswith(
        f"Belt belt needs {needed:.4g}, has 0.05: it slips on pump at A = 0 deg"
    )
    kernel = da.compile(da.loads(FILE), vary=["loads.fan.value"], outputs=["effort.A"])
    answer = kernel([[15.0], [60.0]])
    heavy = da.statics(da.loads(FILE.replace("value: 15", "value: 60")))
    assert answer.status[:, 0].tolist() == ["ok", *heavy.status]
    assert answer.effort("A")[0, 0] == pytest.approx(r.effort("A")[0])


def test_the_motion_of_wheels_on_one_belt() -> None:
    """All wheels turn by one belt's speed: effort and run-up are those of the inertia seen from the motor."""
    seen = 0.01 + 0.2 * (60 / 120) ** 2 + 0.03 * (60 / 50) ** 2
    m = da.loads(FILE.replace("speed: -100 rad/s", "speed: -100 rad/s, acceleration: -20 rad/s^2"))
    r = da.dynamics(m)
    still = da.statics(m)
    assert r.effort("A")[0] - still.effort("A")[0] == pytest.approx(-20 * seen)
    assert r.speed("pump")[0] == pytest.approx(-100 * 60 / 50)
    free = FILE.replace("drives: {A: {position: 0, speed: -100 rad/s}}", "drives: {A: {effort: -20}}")
    free += "start: {A: {position: 0, speed: -100 rad/s}}\n"
    s = da.simulate(da.loads(free), until="0.2 s")
    run = (-20 + (15 / 0.12 + 5 / 0.05) * 0.06) / seen
    assert s.result.speed("motor")[-1] == pytest.approx(-100 + 0.2 * run, rel=1e-9)


WRONG = [
    ("crossed: true", "a crossed belt has no idlers"),
    (
        "tension: 300",
        "tension is given beside idlers, of which one gives the tension by its weight or spring",
    ),
]


@pytest.mark.parametrize(("key", "says"), WRONG)
def test_what_a_belt_with_idlers_may_not_say(key: str, says: str) -> None:
    with pytest.raises(ModelError, match="text:13") as error:
        da.loads(FILE.replace("radii: [60, 120]", f"radii: [60, 120], {key}"))
    assert says in str(error.value)


def test_some_idler_must_be_on_a_link_that_moves() -> None:
    with pytest.raises(
        ModelError, match="belt 'belt': none of its idlers is on a link that moves with it"
    ) as error:
        da.statics(da.loads(FILE.replace("arm.I", "ground.L")))
    assert "put one on an arm or a slide, with a weight or a spring" in str(error.value)
