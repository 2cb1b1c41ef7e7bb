"""Laws of ropes: energy on random tackles, tangents far away, the capstan by elements, what a rope may not do."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.tiers import over


def random_tackle(seed: int, parallel: bool = False) -> dict[str, Any]:
    """A block on two to five strands below a beam, hauled by a hand; wheels of any size, exact tangents."""
    draw = np.random.default_rng(seed)
    wheels = int(draw.integers(1, 5))
    beam, block = {"P": [-1.0, -1.0]}, {}
    through: list[Any] = ["hand.h"]
    for k in range(wheels):
        beam[f"U{k}"] = [float(k), float(draw.uniform(-0.1, 0.1))]
        block[f"B{k}"] = [k + 0.5, float(draw.uniform(-0.1, 0.1))]
        through.append({"round": f"ground.U{k}", "radius": draw.uniform(0.05, 0.2), "side": "left"})
        through.append({"round": f"block.B{k}", "radius": draw.uniform(0.05, 0.2), "side": "right"})
    beam["E"], rope = [float(wheels), 0.0], {"type": "rope", "through": [*through, "ground.E"]}
    slide = {"type": "slider", "direction": -90, "angle": 90}
    return {
        "gravity": "standard",
        "links": {
            "ground": {"points": beam},
            "block": {"points": block, "mass": draw.uniform(100, 900), "center": [1, -0.3]},
            "hand": {"points": {"h": [0, 0]}},
        },
        "joints": {
            "lift": slide | {"links": ["ground", "block"], "at": ["U0", "B0"]},
            "pull": slide | {"links": ["ground", "hand"], "at": ["P", "h"]},
            "rope": rope | ({"parallel": True} if parallel else {}),
        },
        "drives": {
            "pull": {"position": {"from": 0, "to": 0.4, "count": 3}, "speed": 0.5, "acceleration": 0.7},
        },
        "assembly": {"block": [0.5, -2.0, 0]},
    }


@over(1, 150)
def test_a_rope_does_no_work(seed: int) -> None:
    """Pull times its way is the rise of the load and of its kinetic energy; every strand has one tension."""
    tree = random_tackle(seed)
    m = da.mechanism(tree)
    r = da.dynamics(m, method="careful")
    assert set(r.status) == {"ok"}
    v, a = r.center_velocity("block")[:, 1], r.center_acceleration("block")[:, 1]
    mass = tree["links"]["block"]["mass"]
    np.testing.assert_allclose(r.effort("pull") * 0.5, mass * (9.80665 + a) * v, rtol=1e-9)
    tension = r.rope("rope").tension
    np.testing.assert_allclose(tension, tension[:, :1] * np.ones_like(tension), rtol=1e-9)
    np.testing.assert_allclose(da.virtual_work(r).effort, r.effort_array, rtol=1e-9)
    np.testing.assert_allclose(da.dynamics(m).effort_array, r.effort_array, rtol=1e-9)
    assert da.superposition(r).gap.max() < 1e-11
    kernel = da.compile(m, vary=["links.block.mass", "joints.rope.through.1.radius"])
    answer = kernel([[mass, tree["joints"]["rope"]["through"][1]["radius"]]])
    np.testing.assert_allclose(answer.effort("pull")[0], r.effort("pull"), rtol=1e-9)


@over(1, 100)
def test_the_length_stays(seed: int) -> None:
    """Speeds and accelerations against differences of positions; the length by an independent sum."""
    tree = random_tackle(seed)
    tree["drives"]["pull"]["position"] = [0.0, 1e-4, 2e-4]
    r = da.kinematics(da.mechanism(tree))
    y = r.center("block")[:, 1]
    assert (y[2] - y[0]) / 2e-4 * 0.5 == pytest.approx(r.center_velocity("block")[1, 1], rel=1e-7)
    drift = (y[2] - 2 * y[1] + y[0]) / 1e-8 * 0.25 + (y[2] - y[0]) / 2e-4 * 0.7
    assert drift == pytest.approx(r.center_acceleration("block")[1, 1], rel=1e-4, abs=1e-6)
    lengths = [length(tree, r, k) for k in range(3)]
    assert np.ptp(lengths) < 1e-11


def length(tree: dict[str, Any], r: da.Result, k: int) -> float:
    """Strands and arcs of the rope by plane geometry: each strand is tangent to circles on its left or right."""
    places, radii = [], []
    for item in tree["joints"]["rope"]["through"]:
        link, point = (item if isinstance(item, str) else item["round"]).split(".")
        u = np.array(tree["links"][link]["points"][point])
        at = u if link == "ground" else r.position(link)[k] + u
        places.append(at)
        side = 0.0 if isinstance(item, str) else item["radius"] * (1 if item["side"] == "left" else -1)
        radii.append(side)
    total, before = 0.0, None
    for a, b, ra, rb in zip(places, places[1:], radii, radii[1:], strict=False):
        line = math.dist(a, b)
        angle = math.atan2(*(b - a)[::-1]) - math.asin((ra - rb) / line)
        total += math.sqrt(line**2 - (ra - rb) ** 2)
        if before is not None:
            total += abs(ra) * (math.copysign(1, ra) * (before - angle) % (2 * math.pi))
        before = angle
    return total


@over(1, 30)
def test_distant_blocks_have_parallel_strands(seed: int) -> None:
    """Tangents tend to the parallel strands of books with the distance; the tackle's efficiency is theirs."""
    tree, books = random_tackle(seed), random_tackle(seed, parallel=True)
    tree["links"]["ground"]["points"]["P"][1] = -1e3
    tree["assembly"]["block"][1] = -1e3
    for each in (tree, books):
        each["joints"]["rope"]["efficiency"] = 0.93
        each["drives"]["pull"] = {"position": 0, "speed": 0.5}
        for k, item in enumerate(each["joints"]["rope"]["through"][1:-1]):
            item["radius"] = 0.1 + 0.01 * k
    near, far = da.statics(da.mechanism(books)), da.statics(da.mechanism(tree))
    assert far.effort("pull")[0] == pytest.approx(near.effort("pull")[0], rel=1e-4)
    count = len(books["joints"]["rope"]["through"]) - 2
    weight = tree["links"]["block"]["mass"] * 9.80665
    pull = weight * (1 - 0.93) / (0.93 * (1 - 0.93**count))
    assert near.effort("pull")[0] == pytest.approx(pull, rel=1e-12)


BOLLARD = """
links: {ground: {points: {P: [0, 0], Q: [1.0, 0.3]}}, load: {points: {L: [0, 0]}}, hand: {points: {H: [0, 0]}}}
joints:
  down: {type: slider, links: [ground, load], at: [P, L], direction: -90}
  out: {type: slider, links: [ground, hand], at: [Q, H], direction: 20}
  rope: {type: rope, through: [load.L, {round: ground.P, radius: 0.1, side: left, turns: TURNS, friction: MU}, hand.H]}
drives: {out: {position: {from: 0, to: 1, count: 3}, speed: SPEED}}
loads: {W: {type: force, on: load, at: L, value: [0, -2000]}}
assembly: {load: [0, -1, 0]}
"""


@pytest.mark.parametrize(("mu", "turns", "speed"), [(0.2, 0, 0.1), (0.2, 1, -0.1), (0.5, 0, 0.1)])
def test_a_rope_slides_round_a_wheel_element_by_element(mu: float, turns: int, speed: float) -> None:
    """Its wrap changes as the hand moves: the pull is that of ten thousand elements, each at its limit."""
    text = BOLLARD.replace("TURNS", str(turns)).replace("MU", str(mu)).replace("SPEED", str(speed))
    r = da.statics(da.loads(text))
    rope = r.rope("rope")
    assert set(r.status) == {"ok"}
    for k in range(3):
        tension, wrap = rope.tension[k, 0], rope.wrap[k, 0]
        half = wrap / 20_000
        grip = mu * math.tan(half)  # of 2 T sin(d/2), in the middle of an element
        step = (1 + grip) / (1 - grip)
        other = tension * step ** (10_000 if speed > 0 else -10_000)
        assert rope.tension[k, 1] == pytest.approx(other, rel=1e-6)
    down = math.asin(0.1 / -r.position("load")[0][1])
    assert rope.wrap[0, 0] < math.pi - down + 2 * math.pi * turns
    assert np.ptp(rope.wrap) > 0.01


@pytest.mark.parametrize("static", [0.2, 0.35])
def test_at_rest_the_pull_lies_between_both_limits(static: float) -> None:
    text = (
        BOLLARD.replace("TURNS", "0")
        .replace("SPEED", "0")
        .replace("MU", f"{{coefficient: 0.2, static: {static}}}")
    )
    r = da.statics(da.loads(text))
    assert set(r.status) == {"at_rest"}
    for end, sign in zip(r.ends[0], (-1, 1), strict=True):
        rope = end.rope("rope")
        ratio = rope.tension[:, 1] / rope.tension[:, 0]
        np.testing.assert_allclose(np.log(ratio), sign * static * rope.wrap[:, 0], rtol=1e-9)


DRUM = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  wheel: {points: {O: [0, 0]}, inertia: 0.02}
  one: {points: {A: [0, 0]}, mass: 8}
  two: {points: {B: [0, 0]}, mass: 5}
joints:
  O: {type: pin, links: [ground, wheel]}
  a: {type: slider, links: [ground, one], at: [O, A], direction: -90}
  b: {type: slider, links: [ground, two], at: [O, B], direction: -90}
  rope: {type: rope, parallel: true, through: [one.A, {round: wheel.O, radius: 0.12, friction: MU}, two.B]}
drives: {a: {position: 0.5, speed: 1, acceleration: FAST}}
"""


@pytest.mark.parametrize(("factor", "status"), [(1 + 1e-6, "ok"), (1 - 1e-6, "slips")])
def test_a_wheel_slips_below_what_it_needs(factor: float, status: str) -> None:
    firm = da.dynamics(da.loads(DRUM.replace("MU", "1").replace("FAST", "2")))
    needed = float(firm.rope("rope").slip_coefficient[0])
    r = da.dynamics(da.loads(DRUM.replace("MU", f"{needed * factor!r}").replace("FAST", "2")))
    assert r.status == (status,)
    assert r.rope("rope").slip_coefficient[0] == pytest.approx(needed, rel=1e-12)
    assert np.isnan(r.effort("a")[0]) == (status == "slips")
    if status == "slips":
        assert r.reasons == (
            f"Rope rope needs {needed:.4g}, has {needed:.4g}: it slips on wheel at a = 0.5 m. "
            "Give it more turns or a greater coefficient, or lower the load.",
        )


@pytest.mark.parametrize(("fast", "status"), [(-7.67, "ok"), (-7.68, "slack")])
def test_a_rope_hangs_slack_where_it_would_have_to_push(fast: float, status: str) -> None:
    """Beyond 5 g/(5 + J/r^2) the falling mass no longer turns the wheel fast enough for the other strand."""
    r = da.dynamics(da.loads(DRUM.replace("MU", "9").replace("FAST", str(fast))))
    assert r.status == (status,)
    assert (r.rope("rope").tension[0, 0] < 0) == (status == "slack")


def test_a_rope_is_kept_as_it_is_written() -> None:
    m = da.mechanism(random_tackle(3))
    r = da.statics(m)
    assert da.loads(str(m)) == m
    assert r.mechanism.written == m
    assert da.loads(str(r.mechanism)) == m
    assert da.mechanism(m.to_tree()) == m
    assert [name for name in r.joints if name.startswith("rope")][:2] == ["rope_pulley_1", "rope_pulley_2"]


WRONG = [
    ("[load.L, {round: ground.P}, hand]", "'hand' is not a point of a link"),
    ("[load.L]", "a rope goes through two points at least"),
    ("[load.L, load.L]", "it touches only link 'load', which it cannot pull"),
    ("[load.L, ground.P, ground.P, hand.H]", "it goes from ground.P to the same point"),
    ("[load.L, {round: ground.P, radius: -0.1}, hand.H]", "-0.1 is negative"),
    ("[load.L, {round: ground.P, turns: 0.5}, hand.H]", "turns is not an integer"),
    ("[load.L, {round: ground.P, efficiency: 1.2}, hand.H]", "an efficiency is greater than 1"),
    ("[load.L, {round: ground.P, efficiency: 0.9, friction: 0.2}, hand.H]", "both are given"),
    ("[load.L, {round: ground.X}, hand.H]", "needs a point 'X' of link 'ground'"),
    ("[load.L, ground.P, {round: ground.Q}, hand.X]", "needs a point 'X' of link 'hand'"),
    (
        "[load.L, {round: ground.P, friction: {static: 0.2}}, hand.H]",
        "the friction of joint 'rope' has no coefficient",
    ),
    ("[load.L, {round: crane.P}, hand.H]", "names the link 'crane', which does not exist"),
]


@pytest.mark.parametrize(("through", "says"), WRONG)
def test_what_a_rope_may_not_say(through: str, says: str) -> None:
    text = BOLLARD.replace("SPEED", "0")
    given = text[text.index("through: ") + 9 : text.index("}\ndrives")]
    with pytest.raises(ModelError, match="text:6") as error:
        da.loads(text.replace(given, through))
    assert says in str(error.value)


def test_a_strand_within_its_wheel_asks_for_a_place() -> None:
    text = BOLLARD.replace("TURNS", "0").replace("MU", "0.2").replace("SPEED", "1").split("assembly")[0]
    with pytest.raises(ModelError) as error:
        da.statics(da.loads(text))
    assert str(error.value).startswith(
        "text:3: strand 'rope_1' is within its wheel at the first position; give its ends"
    )


def test_parallel_strands_need_one_direction() -> None:
    text = BOLLARD.replace("TURNS", "0").replace("MU", "0.2").replace("SPEED", "1")
    with pytest.raises(ModelError, match="the direction of its parallel strands is not clear"):
        da.statics(da.loads(text.replace("type: rope,", "type: rope, parallel: true,")))
    r = da.statics(da.loads(text.replace("type: rope,", "type: rope, parallel: 90 deg,")))
    np.testing.assert_allclose(r.rope("rope").wrap, math.pi)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("way", [1, -1])
def test_a_rope_over_a_fixed_wheel_has_the_ratio_of_its_wrap_on_either_side(mirrored: bool, way: int) -> None:
    """Strands that are not parallel, tangents by complex numbers; the rope is pulled over the wheel, and let back."""
    radius, mu, a, b, side = 0.1, 0.3, -0.4 - 0.3j, 0.5 - 0.6j, -1 if mirrored else 1
    wheel = {"round": "ground.O", "radius": radius, "friction": {"coefficient": mu}}
    wheel["side"] = "right" if mirrored else "left"
    places = {"O": [0, 0], "A": [side * a.real, a.imag], "B": [side * b.real, b.imag]}
    tree = {
        "links": {
            "ground": {"points": places},
            "a": {"points": {"P": [0, 0]}},
            "b": {"points": {"Q": [0, 0]}},
        },
        "joints": {
            "a": {
                "type": "slider",
                "links": ["ground", "a"],
                "at": ["A", "P"],
                "direction": "180 deg" if mirrored else 0,
            },
            "b": {"type": "slider", "links": ["ground", "b"], "at": ["B", "Q"], "direction": "90 deg"},
            "R": {"type": "rope", "through": ["a.P", wheel, "b.Q"]},
        },
        "drives": {"a": {"position": 0, "speed": way}},
        "loads": {"F": {"type": "force", "on": "b", "at": "Q", "value": [0, -200]}},
    }
    r = da.statics(da.mechanism(tree))
    towards = cmath.phase(-a) + math.asin(radius / abs(a))
    onwards = cmath.phase(b) - math.asin(radius / abs(b))
    wrap = (towards - onwards) % (2 * math.pi)
    pull = 200 / -math.sin(onwards) * math.exp(-way * mu * wrap)  # a goes towards the wheel, and b falls
    assert r.effort("a") == pytest.approx([-pull * math.cos(towards)], rel=1e-12)


HELD = """links:
  ground: {points: {C: [0, 0], G: [0.9, 2], S: [3, 2]}}
  arm: {points: {C: [0, 0], W: [1, 0], P: [1.5, 0]}}
  hand: {points: {S: [0, 0]}}
joints:
  C: {type: pin, links: [ground, arm]}
  S: {type: slider, links: [ground, hand], direction: 0}
  R: {type: rope, through: [ground.G, {round: arm.W, radius: 0.1, side: left}, hand.S]}
drives: {S: {position: 0}}
loads: {F: {type: force, on: arm, at: P, value: [0, -100]}}
assembly: {arm: 0}
"""


@pytest.mark.parametrize("coordinate", [0, 1])
def test_the_place_of_a_wheel_may_vary_along_one_axis(coordinate: int) -> None:
    """The other coordinate is a number: the wheel stays one that is not the arm's pin."""
    m, path = da.loads(HELD), f"links.arm.points.W.{coordinate}"
    values = np.array([[1.0], [1.05], [0.97]]) - coordinate
    found = da.compile(m, [path], ["effort.S"])(values).value("effort.S")[:, 0]
    each = [da.statics(m.with_values({path: float(v)})).effort("S")[0] for v in values[:, 0]]
    assert found == pytest.approx(each, rel=1e-10)
    assert np.ptp(each) > 1
