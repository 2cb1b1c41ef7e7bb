"""Laws of brakes and clutches on random ones, an oracle by quadrature, verdicts from both sides, messages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions, on_link
from dalembert.errors import ModelError
from dalembert.model import read_file
from tests.tiers import nth, tiers

HERE = Path(__file__).parent
BRAKES = (HERE / "brakes.yaml").read_text(encoding="utf-8")
WRONG: list[dict[str, Any]] = read_file(HERE / "wrong_brakes.yaml")[0]["brakes"]


@pytest.mark.parametrize("case", [pytest.param(case, id=str(k)) for k, case in enumerate(WRONG)])
def test_a_wrong_brake_is_told_where_and_what(case: dict[str, str]) -> None:
    assert case["old"] in BRAKES
    with pytest.raises(ModelError) as caught:
        da.statics(da.loads(BRAKES.replace(case["old"], case["new"], 1), name="brakes.yaml"))
    assert str(caught.value) == case["says"]


@pytest.mark.parametrize("arc", ["from: 0, to: 180", "from: -70, to: 110, pressure: cosine"])
def test_a_lining_may_reach_to_where_its_pressure_ends(arc: str) -> None:
    """The pressure there is 0, so that the torque is that of a lining a little shorter."""
    ends = arc.replace("180", "179.999").replace("-70", "-69.999").replace("110", "109.999")
    here, near = (da.statics(da.loads(BRAKES.replace("from: 15, to: 120", a))) for a in (arc, ends))
    assert near.effort("O")[0] == pytest.approx(here.effort("O")[0], rel=1e-8) != 0


def test_a_drum_may_have_its_axis_anywhere_in_its_own_axes() -> None:
    moved = BRAKES.replace("drum:   {points: {O: [0, 0]}}", "drum:   {points: {O: [30, 20]}}")
    assert moved != BRAKES
    here, there = (da.statics(da.loads(text)) for text in (BRAKES, moved))
    assert abs(here.effort("O")[0]) > 100
    assert there.effort("O") == pytest.approx(here.effort("O"), rel=1e-9)
    for joint in here.joints:
        assert there.reaction(joint) == pytest.approx(here.reaction(joint), abs=1e-6)


def random_shoe(seed: int, **changes: Any) -> dict[str, Any]:
    """A drum and a long shoe pinned beside it, turned and mirrored at will."""
    rng = np.random.default_rng(seed)
    radius, internal = float(rng.uniform(0.05, 0.3)), bool(rng.integers(2))
    far = radius * float(rng.uniform(0.6, 0.95) if internal else rng.uniform(1.1, 1.6))
    turn, side = float(rng.uniform(-3, 3)), float(rng.choice([-1.0, 1.0]))
    begin = float(rng.uniform(0, 0.8))
    pin = far * np.array([np.cos(turn), np.sin(turn)])
    way = pin / far
    off = side * np.array([-way[1], way[0]])
    known = {
        "mu": float(rng.uniform(0.05, 0.3)),
        "begin": begin,
        "end": begin + float(rng.uniform(0.4, 1.8)),
        "internal": internal,
        "radius": radius,
        "width": 0.04,
        "pin": pin,
        "side": side,
        "speed": float(rng.choice([-5.0, 5.0])),
        "at": pin - 1.7 * far * way + 0.3 * radius * off,
        "pressure": "pinned",
    } | changes
    push = off if internal else -off
    return {"force": 1000 * float(rng.uniform(0.5, 2)) * push} | known


def model(s: dict[str, Any]) -> Any:
    """The mechanism of a random shoe."""
    shoe = {
        "type": "shoe",
        "links": ["drum", "shoe"],
        "at": ["O", "Q"],
        "radius": s["radius"],
        "width": s["width"],
    }
    shoe |= {
        "internal": s["internal"],
        "from": f"{s['begin']!r} rad",
        "to": f"{s['end']!r} rad",
        "friction": {"coefficient": s["mu"]},
    }
    shoe |= {"side": "left" if s["side"] > 0 else "right", "pressure": s["pressure"]}
    points = {"Q": [0, 0], "P": list(s["at"] - s["pin"])}
    links = {
        "ground": {"points": {"O": [0, 0], "Q": list(s["pin"])}},
        "drum": {"points": {"O": [0, 0]}},
        "shoe": {"points": points},
    }
    joints = {
        "O": {"type": "pin", "links": ["ground", "drum"]},
        "Q": {"type": "pin", "links": ["ground", "shoe"]},
    }
    loads = {"F": {"type": "force", "on": "shoe", "at": "P", "value": list(map(float, s["force"]))}}
    drives = {"O": {"position": 0, "speed": f"{s['speed']} rad/s"}}
    return da.mechanism(
        {"links": links, "joints": joints | {"S": shoe}, "drives": drives, "loads": loads, "gravity": "none"}
    )


def by_quadrature(s: dict[str, Any]) -> tuple[float, float] | None:
    """Amplitude p_m and torque on the drum, by sums over the lining; None where it lifts off."""
    x, weight = np.polynomial.legendre.leggauss(60)
    th = (s["begin"] + s["end"]) / 2 + (s["end"] - s["begin"]) / 2 * x
    area = s["radius"] * s["width"] * (s["end"] - s["begin"]) / 2 * weight
    p = np.sin(th) / np.sin(np.clip(np.pi / 2, s["begin"], s["end"]))
    if not s["begin"] <= np.pi / 2 <= s["end"]:
        p = np.sin(th) / max(np.sin(s["begin"]), np.sin(s["end"]))
    line = np.arctan2(s["pin"][1], s["pin"][0])
    out = np.stack([np.cos(line + s["side"] * th), np.sin(line + s["side"] * th)])
    across = np.stack([-out[1], out[0]])
    on_shoe = out * (-1 if s["internal"] else 1) * p * area
    rubbing = s["mu"] * np.sign(s["speed"]) * across * p * area  # the drum drags the shoe with it
    arm = s["radius"] * out - s["pin"][:, None]
    moment = [(arm[0] * f[1] - arm[1] * f[0]).sum() for f in (on_shoe, rubbing)]
    load = np.subtract(s["at"], s["pin"])
    wanted = -(load[0] * s["force"][1] - load[1] * s["force"][0])
    size = wanted / sum(moment)
    torque = -s["radius"] * (across * rubbing).sum()
    return (float(size), float(size * torque)) if size > 0 else None


@pytest.mark.parametrize("seed", tiers(range(12), range(12, 200)))
def test_a_long_shoe_is_the_sum_of_its_pressures(seed: int) -> None:
    s = random_shoe(seed)
    r, oracle = da.statics(model(s)), by_quadrature(s)
    if oracle is None:
        assert r.status == ("contact_lost",) or r.status == ("jammed",)
        return
    if r.status == ("jammed",):
        assert r.brake("S").locking_coefficient < s["mu"]
        return
    assert r.status[0] in ("ok", "self_locking")
    assert r.shoe("S").pressure[0] == pytest.approx(oracle[0], rel=1e-9)
    assert r.effort("O")[0] == pytest.approx(-oracle[1], rel=1e-9)
    assert r.residual[0] < 1e-12
    assert r.power_balance[0] < 1e-12
    for link in r.links:
        parts = on_link(actions(r), link)
        assert np.abs(sum(a.force for a in parts)).max() < 1e-9 * np.abs(s["force"]).max()
        assert np.abs(sum(a.moment(np.zeros((1, 2))) for a in parts)).max() < 1e-9 * np.abs(s["force"]).max()


def presses(seed: int) -> bool:
    """True of a lining that stays on and does not grab, short ones at its middle neither."""
    s = random_shoe(seed, mu=0.1)
    middle = (s["begin"] + s["end"]) / 2
    short = s | {"begin": middle - 0.02, "end": middle + 0.02}
    return all(da.statics(model(one)).status == ("ok",) for one in (s, short))


@pytest.mark.parametrize("seed", tiers(range(3), range(3, 100)))
def test_torque_and_force_scale_together_and_mirror(seed: int) -> None:
    s = random_shoe(nth(seed, presses), mu=0.1)
    torque = da.statics(model(s)).effort("O")[0]
    assert da.statics(model(s | {"force": 3 * s["force"]})).effort("O")[0] == pytest.approx(
        3 * torque, rel=1e-12
    )
    flip = np.array([1.0, -1.0])
    changes = {name: s[name] * flip for name in ("pin", "at", "force")}
    mirrored = s | changes | {"side": -s["side"], "speed": -s["speed"]}
    assert da.statics(model(mirrored)).effort("O")[0] == pytest.approx(-torque, rel=1e-12)
    rubbed = [abs(da.statics(model(s | {"mu": mu})).effort("O")[0]) / mu for mu in (1e-4, 1e-5)]
    assert rubbed[0] == pytest.approx(rubbed[1], rel=1e-3)


@pytest.mark.parametrize("seed", tiers(range(2), range(2, 40)))
def test_a_short_lining_is_a_point(seed: int) -> None:
    s = random_shoe(nth(seed, presses), mu=0.1)
    middle = (s["begin"] + s["end"]) / 2
    off = []
    for half in (0.02, 0.01):
        r = da.statics(model(s | {"begin": middle - half, "end": middle + half}))
        angle = np.arctan2(s["pin"][1], s["pin"][0]) + s["side"] * middle
        out = np.array([np.cos(angle), np.sin(angle)])
        normal = (-1 if s["internal"] else 1) * out
        drag = s["mu"] * np.sign(s["speed"]) * np.array([-out[1], out[0]])
        arm, load = s["radius"] * out - s["pin"], np.subtract(s["at"], s["pin"])
        total = normal + drag
        wanted = -(load[0] * s["force"][1] - load[1] * s["force"][0])
        size = wanted / (arm[0] * total[1] - arm[1] * total[0])
        off.append(abs(r.brake("S").torque[0] / (s["mu"] * size * s["radius"]) - 1))
    assert off[1] < 1e-3
    assert off[0] == pytest.approx(4 * off[1], rel=0.05, abs=1e-9)


def test_it_grabs_from_its_locking_coefficient_on() -> None:
    m = da.loads(BRAKES)
    least = da.statics(m).brake("S").locking_coefficient
    below, above = (
        da.statics(m.with_values({"joints.S.friction.coefficient": f * least})) for f in (0.999, 1.001)
    )
    assert below.status == ("ok",)
    assert below.brake("S").self_energising[0] > 500
    assert above.status == ("jammed",)


SHOE = """
units: {length: mm, mass: kg, force: N, moment: N*m}
links:
  ground: {points: {O: [0, 0], Q: [50, -112]}}
  drum: {points: {O: [0, 0]}}
  right: {points: {Q: [0, 0], P: [0, 212]}}
joints:
  O: {type: pin, links: [ground, drum]}
  Q: {type: pin, links: [ground, right]}
  S: {type: shoe, links: [drum, right], at: [O, Q], radius: 150, width: 32, internal: true, from: 0, to: 126,
      friction: {coefficient: 0.9}}
drives: {O: {position: 0, speed: -20 rad/s}}
loads: {F: {type: force, on: right, at: P, value: [2281.2, 0]}}
"""


def test_what_is_said_where_it_grabs_and_where_it_lifts() -> None:
    smooth = "[ground, right], friction: {coefficient: 0, radius: 9}}"
    for text in (SHOE, SHOE.replace("[ground, right]}", smooth)):
        assert da.statics(da.loads(text)).reasons == (
            "S: the brake grabs at O = 0 deg: from mu = 0.8283 on it holds any torque (now 0.9).",
        )
    lifted = da.statics(da.loads(SHOE.replace("[2281.2, 0]", "[-2281.2, 0]").replace("0.9", "0.3")))
    assert lifted.status == ("contact_lost",)
    assert lifted.reasons[0] == (
        "S would have to pull with 2979.96 N at O = 0 deg: the lining lifts off the drum. "
        "Reverse the actuating force, or the sense in which the drum turns."
    )


BAND = """
units: {length: mm, mass: kg, force: N, moment: N*m}
links:
  ground: {points: {O: [0, 0], L: [-100, -300]}}
  drum: {points: {O: [0, 0]}}
  lever: {points: {L: [0, 0], B: [150, 0], P: [600, 0]}}
joints:
  O: {type: pin, links: [ground, drum]}
  L: {type: pin, links: [ground, lever]}
  band: {type: band, links: [drum, lever], around: O, radius: 120, width: 50, ends: [ground.L, lever.B],
         friction: {coefficient: 0.25}}
drives: {O: {position: 0, speed: 10 rad/s}}
loads: {P: {type: force, on: lever, at: P, value: [0, -100]}}
"""


def test_a_band_pulls_along_the_tangents() -> None:
    """Tangents of a circle by complex numbers; the lever by its moments."""
    end, start, radius = 50 - 300j, -100 - 300j, 120.0
    touch = [
        z * (radius / abs(z)) * np.exp(1j * s * np.arccos(radius / abs(z)))
        for z, s in ((start, -1), (end, 1))
    ]
    wrap = float(np.angle(touch[0] / touch[1]) % (2 * np.pi))
    pull = (touch[1] - end) / abs(touch[1] - end)
    tension = 100 * 600 / (150 * pull.imag)
    for speed, tight in (("10", tension), ("-10", tension * np.exp(0.25 * wrap))):
        r = da.statics(da.loads(BAND.replace("10 rad", f"{speed} rad")))
        found = r.band("band")
        assert found.wrap == pytest.approx(wrap, rel=1e-12)
        assert found.tight[0] == pytest.approx(tight, rel=1e-12)
        assert found.ratio[0] == pytest.approx(np.exp(0.25 * wrap), rel=1e-12)
        assert da.shaking(r, about="O").residual.max() < 1e-12


def test_a_torque_with_the_motion_has_no_balance() -> None:
    text = BAND.replace("speed: 10 rad/s", "speed: 10 rad/s, effort: -20").replace(
        "value: [0, -100]", "direction: -90, value: unknown"
    )
    r = da.statics(da.loads(text))
    assert r.status == ("no_balance",)
    assert r.reasons[0] == (
        "A brake gives no torque that helps the motion: the effort of O, -20 N*m at O = 0 deg, acts against it. "
        "Give it the sign of the speed, or reverse the speed."
    )
    found = da.statics(da.loads(text.replace("effort: -20", "effort: 20")))
    assert found.band("band").torque[0] == pytest.approx(20, rel=1e-12)


def test_faces_of_an_unknown_force_do_not_help_either() -> None:
    text = BRAKES.replace("force: 100, half_angle", "force: unknown, half_angle")
    text = text.replace(
        "U: {position: 0, speed: 5 rad/s}", "U: {position: 0, speed: 5 rad/s, effort: EFFORT}"
    )
    less, more = (da.statics(da.loads(text.replace("EFFORT", str(effort)))) for effort in (89, 91))
    assert less.status == ("no_balance",)
    assert more.status == ("self_locking",)
    lever = more.mechanism.joints["cone"].lever
    assert more.brake("cone").force[0] == pytest.approx(1.0 / (0.2 * lever), rel=1e-9)


@pytest.mark.parametrize("law", ["wear", "pressure"])
def test_faces_are_the_sums_of_their_pressures(law: str) -> None:
    disc = da.Disc(links=("a", "b"), radii=(0.05, 0.1), force=1, law=law, sector="100 deg")
    x, weight = np.polynomial.legendre.leggauss(40)
    r, w = 0.075 + 0.025 * x, 0.025 * weight
    p = 0.05 / r if law == "wear" else np.ones_like(r)
    angle = np.radians(100)
    force = (p * r * w).sum() * angle
    assert disc.force_area == pytest.approx(force, rel=1e-12)
    assert disc.friction_radius == pytest.approx((p * r * r * w).sum() * angle / force, rel=1e-12)
    assert disc.force_radius == pytest.approx(
        (p * r * r * w).sum() * 2 * np.sin(angle / 2) / force, rel=1e-12
    )


def test_a_round_pad_has_its_own_radius() -> None:
    pad = da.Disc(links=("a", "b"), button={"radius": 0.02, "at": 0.1}, force=1)
    x, weight = np.polynomial.legendre.leggauss(60)
    far = 0.02 * (1 + x) / 2
    turn = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    inverse = 1 / np.abs(0.1 + far[:, None] * np.exp(1j * turn))
    total = (inverse.mean(axis=1) * 2 * np.pi * far * weight * 0.01).sum()
    assert pad.friction_radius == pytest.approx(np.pi * 0.02**2 / total, rel=1e-9)
    assert pad.friction_radius == pytest.approx(0.1 * (1 - 0.2**2 / 8), rel=1e-3)
    assert pad.force_area == pytest.approx(0.08 * total, rel=1e-9)


def test_the_compiled_analysis_agrees_with_derivatives() -> None:
    m = da.loads(SHOE.replace("0.9", "0.32"))
    vary = ["joints.S.friction.coefficient", "joints.S.radius", "joints.S.to"]
    at = np.array([0.32, 0.15, 2.1])
    k = da.compile(m, vary=vary, derivatives=True)
    values = np.stack([at, *(at + s * d for d in 1e-6 * np.eye(3) for s in (1, -1))])
    answer = k(values)
    found = answer["effort.O"].ravel()
    careful = da.statics(m.with_values(dict(zip(vary, at, strict=True))), method="careful").effort("O")[0]
    assert found[0] == pytest.approx(careful, rel=1e-12)
    slopes = (found[1::2] - found[2::2]) / 2e-6
    exact = [answer.gradient("effort.O")[0, 0, n] for n in range(3)]
    assert exact == pytest.approx(slopes, rel=1e-6)


def test_drawn_pressure_is_that_of_the_lining() -> None:
    r = da.statics(da.loads(SHOE.replace("0.9", "0.32")))
    roles = [getattr(item, "role", "") for item in da.draw.mechanism(r).items]
    assert roles.count("line-of-action") == 9
    assert roles.count("pitch") == 1


@pytest.mark.parametrize(("copies", "torque"), [("mirror", -528.25546603), ("phase", -732.33747297)])
def test_a_copied_shoe_is_closed_where_the_original_is(copies: str, torque: float) -> None:
    """A mirrored one trails where the first leads; one turned by half a turn leads too."""
    how = {
        "mirror": "mirror: {ground: 90 deg, drum: 90 deg}",
        "phase": "count: 2, phase: {ground: 180, drum: 180}",
    }
    text = SHOE.replace("0.9", "0.32") + f"copies:\n  - {{of: [right], {how[copies]}}}\n"
    r = da.statics(da.loads(text))
    assert r.status == ("ok",)
    assert r.effort("O")[0] == pytest.approx(torque, rel=1e-9)


def test_a_band_is_not_copied() -> None:
    text = BAND + "copies:\n  - {of: [lever], mirror: {ground: 90 deg, drum: 90 deg}}\n"
    with pytest.raises(ModelError, match="'band' is a band, which is not copied; write the second one out"):
        da.loads(text)


def test_a_band_with_a_given_wrap_holds_its_lever_over_whole_turns_of_the_drum() -> None:
    """Its strands are taken across the line of its ends; the drum's turn does not move them."""
    m = da.loads(
        """units: {length: mm, mass: kg, force: N, moment: N*m, angle: deg}
links:
  ground: {points: {O: [0, 0], L: [-200, -300]}}
  drum: {points: {O: [0, 0]}}
  lever: {points: {L: [0, 0], B: [120, 0], F: [600, 0]}}
joints:
  O: {type: pin, links: [ground, drum]}
  L: {type: pin, links: [ground, lever]}
  S: {type: band, links: [drum, lever], around: O, radius: 200, wrap: 230, ends: [ground.L, lever.B],
      friction: {coefficient: 0.3}}
drives: {O: {position: {from: 0, to: 720, count: 37}, speed: 10 rad/s}}
loads: {F: {type: force, on: lever, at: F, value: [0, -150]}}
"""
    )
    r = da.statics(m)
    assert set(r.status) == {"ok"}
    assert r.angle("lever") == pytest.approx(np.zeros(37), abs=1e-12)
    assert r.effort("O") == pytest.approx(np.full(37, 750 * 0.2 * (1 - np.exp(-0.3 * np.radians(230)))))
