"""Laws of belts and chains on random drives; their limit by belt elements one by one."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import Action, full_actions
from dalembert.analysis.methods.elements.belt_strands import pulls_of
from dalembert.errors import ModelError
from dalembert.model.library import template_text
from dalembert.pages.page_data import page_data
from dalembert.pages.sweep import with_cycle
from tests.elements.random_elements import FAMILIES
from tests.elements.written_machines import Written
from tests.pages.test_page_data import run_page
from tests.tiers import over

KEYS = ("tension", "tensioner", "tight", "slack")


def random_drive(seed: int) -> dict[str, Any]:
    """Two wheels and a belt at any angle, the second wheel on the ground or on a cart that moves."""
    draw = np.random.default_rng(seed)
    r1, r2 = draw.uniform(0.03, 0.2, 2)
    distance, angle = (r1 + r2) * draw.uniform(1.3, 4), draw.uniform(-math.pi, math.pi)
    key, moves = KEYS[seed % 4], seed % 3 == 0
    belt = {
        "type": "belt",
        "links": ["small", "big"],
        "at": ["A", "B"],
        "radii": [r1, r2],
        "crossed": bool(seed % 2),
        key: draw.uniform(3000, 5000),  # more than any torque below asks for
        "mass_per_length": draw.uniform(0, 0.5),
    }
    away = [distance * math.cos(angle), distance * math.sin(angle)]
    tree = {
        "gravity": "standard",
        "links": {
            "ground": {"points": {"A": [0, 0], "B": away}},
            "small": {"points": {"A": [0, 0]}, "inertia": draw.uniform(0.01, 0.1), "mass": 2.0},
            "big": {"points": {"B": [0, 0]}, "inertia": draw.uniform(0.1, 0.5), "mass": 5.0},
        },
        "joints": {"A": {"type": "pin", "links": ["ground", "small"]}, "belt": belt},
        "drives": {
            "A": {
                "position": {"from": 0, "to": 50, "count": 3},
                "speed": f"{draw.uniform(5, 30)} rad/s",
                "acceleration": f"{draw.uniform(-40, 40)} rad/s^2",
            }
        },
        "loads": {"work": {"type": "couple", "on": "big", "value": draw.uniform(-10, 10)}},
    }
    if not moves:
        tree["joints"]["B"] = {"type": "pin", "links": ["ground", "big"]}
        return tree
    tree["links"]["cart"] = {"points": {"B": [0, 0]}, "mass": 3.0}
    slide = {"type": "slider", "links": ["ground", "cart"], "at": ["B", "B"]}
    tree["joints"] |= {
        "slide": slide | {"direction": math.degrees(angle) + draw.uniform(-80, 80)},
        "B": {"type": "pin", "links": ["cart", "big"]},
    }
    tree["drives"]["slide"] = {
        "position": {"from": 0, "to": 0.02, "count": 3},
        "speed": 0.3,
        "acceleration": 0.4,
    }
    return tree


def read(tree: dict[str, Any]) -> da.Mechanism:
    return da.mechanism(tree)


@over(2, 200)
def test_torques_and_pulls_close(seed: int) -> None:
    tree = random_drive(seed)
    r = da.dynamics(read(tree))
    assert set(r.status) == {"ok"}
    b, belt = r.belt("belt"), tree["joints"]["belt"]
    work = tree["loads"]["work"]["value"]
    torque = -work + tree["links"]["big"]["inertia"] * np.asarray(r.acceleration("big"))
    np.testing.assert_allclose(b.torque[:, 1], torque, atol=1e-9)
    np.testing.assert_allclose(np.abs(torque) / belt["radii"][1], b.tight - b.slack, atol=1e-8)
    key, value = next((k, belt[k]) for k in KEYS if k in belt)
    sums = {"tension": (b.tight + b.slack) / 2, "tight": b.tight, "slack": b.slack}
    sums["tensioner"] = b.tight + b.slack - 2 * b.centrifugal
    np.testing.assert_allclose(sums[key], value, rtol=1e-12)
    rim = np.abs(b.speed) if "slide" not in tree["drives"] else b.speed
    assert np.allclose(b.centrifugal, belt["mass_per_length"] * rim**2)
    if "slide" not in tree["drives"]:
        power = b.torque[:, 0] * r.speed("small") + b.torque[:, 1] * r.speed("big")
        np.testing.assert_allclose(power, 0, atol=1e-9 * np.abs(b.torque[:, 0] * r.speed("small")).max())


@over(2, 200)
def test_causes_are_superposed_unless_the_pull_follows_the_torque(seed: int) -> None:
    r = da.dynamics(read(random_drive(seed)))
    if KEYS[seed % 4] in ("tension", "tensioner"):
        assert da.superposition(r).gap.max() < 1e-11
    else:
        with pytest.raises(ModelError, match=r"the pull of a belt with a given strand follows \|T1 - T2\|"):
            da.superposition(r)


@over(1, 100)
def test_wheels_turn_as_the_strands_let_them(seed: int) -> None:
    """Speeds against differences of the angles, and against the strands' lengths wound on and off."""
    tree = random_drive(seed)
    h = 1e-5
    angles = []
    for side in (-1, 1):
        moved = random_drive(seed)
        for name, drive in moved["drives"].items():
            speed = float(str(drive["speed"]).split()[0])
            step = h * side * (math.degrees(speed) if name == "A" else speed)
            drive["position"] = {"from": 0, "to": step, "count": 2}
        angles.append(da.kinematics(read(moved)).angle("big")[1])
    first = da.kinematics(read(tree))
    assert (angles[1] - angles[0]) / (2 * h) == pytest.approx(first.speed("big")[0], rel=1e-6)


@over(1, 60)
def test_numbers_of_kernels_are_those_of_analyses_and_slopes_those_of_differences(seed: int) -> None:
    m, paths = read(random_drive(seed)), [f"joints.belt.{KEYS[seed % 4]}", "joints.belt.radii.1"]
    kernel = da.compile(m, vary=paths, derivatives=True)
    belt: Any = m.joints["belt"]
    at = [getattr(belt, KEYS[seed % 4]), belt.radii[1]]
    answer, r = kernel([at]), da.dynamics(m)
    scale = np.abs(r.effort_array).max()
    np.testing.assert_allclose(answer.effort("A")[0], r.effort("A"), atol=1e-11 * scale)
    for k, value in enumerate(at):
        step = 1e-5 * value
        sides = [da.dynamics(m.with_values({paths[k]: value + s * step})).effort("A") for s in (-1, 1)]
        slope = answer.gradient("effort.A")[0, :, k]
        np.testing.assert_allclose(
            slope, (sides[1] - sides[0]) / (2 * step), rtol=1e-5, atol=1e-6 * scale / value
        )


@over(1, 100)
def test_the_other_sense_of_the_torque_exchanges_both_strands(seed: int) -> None:
    tree = random_drive(4 * seed + 1)  # with fixed centres but each third
    belt = tree["joints"]["belt"]
    value = next(belt.pop(k) for k in KEYS if k in belt)
    forth, back = (
        da.statics(
            read(tree | {"joints": tree["joints"] | {"belt": belt | {"tension": value}}, "loads": load})
        )
        for load in ({"w": {"type": "couple", "on": "big", "value": x}} for x in (7.0, -7.0))
    )
    f, b = forth.belt("belt"), back.belt("belt")
    np.testing.assert_allclose(f.tight, b.tight, rtol=1e-9)
    np.testing.assert_allclose(f.torque, -b.torque, atol=1e-9)
    np.testing.assert_allclose(f.tight - value, value - f.slack, rtol=1e-9)


@over(1, 100)
def test_it_slips_just_above_what_its_friction_holds(seed: int) -> None:
    tree = random_drive(seed)
    belt = tree["joints"]["belt"]
    belt["groove"] = 34.0 if seed % 2 else 60.0
    needed = float(np.max(da.dynamics(read(tree)).belt("belt").slip_coefficient))
    for factor, status in ((1 + 1e-6, {"ok"}), (1 - 1e-6, {"ok", "slips"})):
        belt["friction"] = {"coefficient": 0.001, "static": needed * factor}
        r = da.dynamics(read(tree))
        assert {*r.status} <= status
        assert ("slips" in r.status) == (factor < 1)
        assert np.isfinite(r.belt("belt").slip_coefficient).all()


@pytest.mark.parametrize(("mu", "wrap", "speed"), [(0.3, 2.5, 0.0), (0.3, 2.5, 40.0), (0.7, 2.9, 20.0)])
def test_the_limit_is_that_of_ten_thousand_elements(mu: float, wrap: float, speed: float) -> None:
    """Each element of a belt of 0.4 kg/m is in equilibrium on the wheel, its rubbing at the limit."""
    gamma = (math.pi - wrap) / 2
    radius, distance, tension = 0.1, 1.0, 900.0
    other = radius + distance * math.sin(gamma)
    belt = {"type": "belt", "links": ["a", "b"], "at": ["A", "B"], "radii": [radius, other], "tight": tension}
    tree = {
        "links": {
            "ground": {"points": {"A": [0, 0], "B": [distance, 0]}},
            "a": {"points": {"A": [0, 0]}},
            "b": {"points": {"B": [0, 0]}},
        },
        "joints": {
            "A": {"type": "pin", "links": ["ground", "a"]},
            "B": {"type": "pin", "links": ["ground", "b"]},
            "belt": belt | {"mass_per_length": 0.4, "friction": {"coefficient": mu}},
        },
        "drives": {"A": {"position": 0, "speed": f"{speed / radius} rad/s"}},
    }
    b = da.statics(read(tree)).belt("belt")
    least = min(b.wrap)
    count, t = 10_000, tension
    for _ in range(count):  # 2 (T - m v^2) sin(d/2) presses, in the middle of its element
        half = least / count / 2
        normal = 2 * (t - 0.4 * speed**2) * math.sin(half) / (1 + mu * math.tan(half))
        t -= mu * normal
    assert b.limit.slack[0] == pytest.approx(t, rel=1e-7)


@over(1, 40)
def test_friction_elsewhere_counts_what_follows_the_torque(seed: int) -> None:
    """The pull of a belt with a given strand as a contact, beside a pin with a trace of friction."""
    tree = random_drive(4 * seed + 2 + seed % 2)
    plain = da.dynamics(read(tree))
    tree["joints"]["A"]["friction"] = {"radius": 0.01, "coefficient": 1e-13}
    rubbed = da.dynamics(read(tree))
    scale = np.abs(plain.force_array).max()
    np.testing.assert_allclose(rubbed.force_array, plain.force_array, atol=1e-9 * scale)
    np.testing.assert_allclose(rubbed.effort_array, plain.effort_array, atol=1e-9 * scale)


@over(1, 40)
def test_millimetres_and_a_moved_machine_have_the_same_forces(seed: int) -> None:
    tree = random_drive(3 * seed + 1)
    r = da.dynamics(read(tree))
    for point in tree["links"]["ground"]["points"].values():
        point[0] += 100.0
    moved = da.dynamics(read(tree))
    scale = np.abs(r.force_array).max()
    np.testing.assert_allclose(moved.force_array, r.force_array, atol=1e-9 * scale)
    m = da.loads(str(read(tree)))
    assert m == read(tree)


WRONG = [
    (
        "tension: 300, tight: 400",
        "tension and tight are both given, and each gives the sum of the tensions; keep one",
    ),
    ("crossed: false", "its tension is missing: the torque gives the difference of both strands only"),
    ("slack: 0, chain: true, crossed: true", "a chain cannot be crossed"),
    ("chain: true, friction: {coefficient: 0.3}", "a chain holds by its teeth and has no friction"),
    ("chain: true, groove: 38", "a chain holds by its teeth and has no groove"),
    ("tension: 300, groove: 200", "the groove is wider than 180 deg"),
    ("tension: -3", "-3 is negative"),
    ("tension: 300, friction: {static: 0.3}", "the friction of joint 'belt' has no coefficient"),
]
FILE = """
links:
  ground: {points: {A: [0, 0], B: [0.3, 0]}}
  a: {points: {A: [0, 0]}}
  b: {points: {B: [0, 0]}}
joints:
  A: {type: pin, links: [ground, a]}
  B: {type: pin, links: [ground, b]}
  belt: {type: belt, links: [a, b], at: [A, B], radii: [0.1, 0.1], KEYS}
drives: {A: {position: 0, speed: 100 rpm}}
loads: {w: {type: couple, on: b, value: -5}}
"""


@pytest.mark.parametrize(("keys", "says"), WRONG)
def test_what_a_belt_may_not_say(keys: str, says: str) -> None:
    with pytest.raises(ModelError, match="text:9") as error:
        da.loads(FILE.replace("KEYS", keys))
    assert says in str(error.value)


def test_wheels_may_not_touch() -> None:
    with pytest.raises(ModelError) as error:
        da.statics(da.loads(FILE.replace("KEYS", "tension: 300").replace("0.3, 0", "0.19, 0")))
    assert str(error.value) == (
        "text:9: belt 'belt': centres 0.19 m apart, but its wheels need more than 0.2 m; "
        "make a wheel smaller or move a centre"
    )


@pytest.mark.parametrize(("keys", "status"), [("chain: true", "ok"), ("chain: true, tension: 24", "slack")])
def test_a_chain_does_not_push(keys: str, status: str) -> None:
    r = da.statics(da.loads(FILE.replace("KEYS", keys)))
    assert r.status == (status,)
    b = r.belt("belt")
    assert b.tight[0] - b.slack[0] == pytest.approx(50)
    if status == "slack":
        assert r.reasons == (
            "The slack strand of chain belt would have to push with 1 N at A = 0 deg. "
            "Raise its tension, or lower the load.",
        )


def test_a_slipping_belt_says_what_it_needs_and_from_where() -> None:
    r = da.statics(da.loads(FILE.replace("KEYS", "tension: 300, friction: {coefficient: 0.05}")))
    assert r.status == ("slips",)
    needed = math.log(325 / 275) / math.pi
    torque = 0.1 * 600 * math.tanh(0.05 * math.pi / 2)
    assert r.reasons == (
        f"Belt belt needs {needed:.4g}, has 0.05; slips from {torque:.6g} N*m on, at the wheel of a at A = 0 deg. "
        "Raise its tension, its wrap or its coefficient, or lower the load.",
    )


def wrapped(r: da.Result) -> list[Action]:
    """The actions of belts and ropes on their wheels."""
    return [a for a in full_actions(r) if a.kind == "joint" and r.mechanism.joints[a.of].WRAPPED]


@pytest.mark.parametrize("family", ["belt", "idler", "tackle"])
def test_a_free_body_shows_what_the_equations_have(family: str) -> None:
    """The pulls of the strands, where they touch a wheel, have the force and the moment of the joint."""
    seen = 0
    for seed in range(6):
        r = da.dynamics(da.mechanism(FAMILIES[family](seed, Written())[0]))
        for a in wrapped(r) if r.ok.all() else ():
            pulls, size = pulls_of(r, r, a), np.abs(a.force).max()
            if getattr(r.mechanism.joints[a.of], "direction", None) is None:  # not drawn parallel to others
                assert max(np.abs(pull.couple).max() for pull in pulls) < 1e-12 * size
            assert np.allclose(sum(pull.force for pull in pulls), a.force, rtol=0, atol=1e-12 * size)
            assert np.allclose(sum(pull.moment(a.at) for pull in pulls), a.couple, rtol=0, atol=1e-12 * size)
            seen += len(pulls)
    assert seen > 8


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("torque", ["15 N*m", "-15 N*m", "15*cos(A) N*m"])
def test_pulls_are_tensions_less_the_centrifugal_one(crossed: bool, torque: str) -> None:
    tree = da.belt_drive(torque="15 N*m").to_tree()
    tree["joints"]["belt"]["crossed"] = crossed
    tree["loads"]["work"]["value"] = torque
    r = da.dynamics(da.mechanism(tree))
    b, turns = r.belt("belt"), "cos" in torque
    for a in wrapped(r):
        pulls = {pull.part: np.hypot(*pull.force.T) for pull in pulls_of(r, r, a)}
        assert set(pulls) == ({"left", "right"} if turns else {"tight", "slack"})
        assert np.allclose(np.maximum(*pulls.values()), b.tight - b.centrifugal)
        if not turns:
            assert np.allclose(pulls["slack"], b.slack - b.centrifugal)


@pytest.mark.parametrize("template", ["belt_drive", "hoist"])
def test_a_page_has_the_same_pulls(template: str) -> None:
    m = da.loads(template_text(template))
    data, r = json.loads(json.dumps(page_data(m))), da.dynamics(with_cycle(m))
    out, seen = run_page(data), 0
    for body in data["views"]["bodies"]:
        mine = [x for x in body["arrows"] if x["kind"] == "joint" and r.mechanism.joints[x["of"]].WRAPPED]
        right = [pull for a in wrapped(r) if a.link == body["link"] for pull in pulls_of(r, r, a)]
        assert [x["t"] for x in mine] == ["force"] * len(right)
        for arrow, pull in zip(mine, right, strict=True):
            assert np.allclose(out[arrow["f"]].T, pull.force, rtol=1e-9)
            assert np.allclose(out[arrow["p"]].T, pull.at, rtol=0, atol=1e-12)
        seen += len(mine)
    assert seen >= 4


BELT = """units: {length: mm}
links:
  ground: {points: {A: [0, 0], B: [800, 0]}}
  one: {points: {A: [0, 0]}}
  two: {points: {B: [0, 0]}}
joints:
  A: {type: pin, links: [ground, one]}
  B: {type: pin, links: [ground, two]}
  belt: {type: belt, links: [one, two], at: [A, B], radii: [100, 250], tight: 128, friction: {coefficient: 0.3}}
drives: {A: {position: 0, speed: 3 rad/s}}
loads: {T: {type: couple, on: two, value: TORQUE N*m}}
"""


@pytest.mark.parametrize("torque", [-32, -16, 0, 16, 31, 32, 33])
def test_a_belt_whose_slack_strand_pulls_nothing_needs_more_than_any_coefficient(torque: float) -> None:
    """ln(T1/T2) over the wrap of the small wheel, without end where T2 is 0, or would push."""
    r = da.statics(da.loads(BELT.replace("TORQUE", str(torque))))
    slack = 128 - abs(torque) / 0.25
    assert r.belt("belt").slack == pytest.approx([slack], abs=1e-12)
    wrap = math.pi - 2 * math.asin(150 / 800)
    needed = math.log(128 / slack) / wrap if slack > 0 else math.inf
    assert r.belt("belt").slip_coefficient == pytest.approx([needed], rel=1e-12)
    if slack > 0 and needed <= 0.3:
        assert (r.status, r.reasons) == (("ok",), (None,))
        return
    most = 128 * (1 - math.exp(-0.3 * wrap)) * 100
    word = f"{needed:.4g}" if slack > 0 else "more than any coefficient"
    assert r.reasons == (
        f"Belt belt needs {word}, has 0.3; slips from {most:.6g} N*mm on, at the wheel of one at A = 0 deg. Raise its "
        "tension, its wrap or its coefficient, or lower the load.",
    )


@pytest.mark.parametrize("groove", [34.0, 60.0])
def test_a_groove_divides_the_coefficient_that_is_needed_by_its_sine(groove: float) -> None:
    """Euler's formula with the coefficient of the file, mu, in a groove of 2 beta: mu / sin(beta)."""
    tree = da.belt_drive().to_tree()
    flat = da.statics(da.mechanism(tree)).belt("belt")
    tree["joints"]["belt"]["groove"] = groove
    b, sine = da.statics(da.mechanism(tree)).belt("belt"), math.sin(math.radians(groove / 2))
    written = tree["joints"]["belt"]["friction"]["coefficient"]
    assert (b.coefficient, flat.coefficient) == pytest.approx((written, written), rel=1e-12)
    assert b.slip_coefficient == pytest.approx(flat.slip_coefficient * sine, rel=1e-12)
    assert b.tight == pytest.approx(flat.tight, rel=1e-12)
    assert b.limit is not None
    pressed = (b.limit.tight - b.centrifugal) / (b.limit.slack - b.centrifugal)
    assert pressed == pytest.approx(np.exp(b.coefficient / sine * b.wrap.min(axis=-1)), rel=1e-9)
