"""One-way clutches and ratchets: held, freewheeling, refused, in motions under forces, and wrong keys."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.result.named_quantities import quantity
from dalembert.model.library import template_text
from dalembert.reports.design.element_parts import element_parts
from dalembert.reports.design.verdict import DesignContext
from dalembert.views.notation import Notation
from tests.tiers import over, over_seeds

FILE = """units: {length: mm, mass: kg, force: N, moment: N*m, angle: rad}
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, inertia: 1.5 kg*m^2}
  two: {points: {O: [0, 0]}, inertia: 0.8 kg*m^2}
joints:
  A: {type: pin, links: [ground, one], at: O}
  B: {type: pin, links: [ground, two], at: O}
  K: {type: one_way, links: [one, two], at: O, free: ccw}
drives: {A: {position: 0, speed: 10 rad/s}}
loads: {T: {type: couple, on: two, value: -120}}
"""
BOTH = FILE.replace("10 rad/s}", "10 rad/s}, B: {position: 0, speed: SPEED rad/s}")


def test_it_holds_one_way() -> None:
    m = da.loads(FILE)
    for method in ("auto", "careful"):
        r = da.statics(m, method=method)  # type: ignore[arg-type]
        assert r.status == ("ok",)
        assert r.effort("A")[0] == pytest.approx(120)
        assert r.reaction_moment("K")[0] == pytest.approx(120)
        assert r.speed("two")[0] == pytest.approx(10)
    lost = da.statics(m.with_values({"loads.T.value": 50}))
    assert lost.status == ("contact_lost",)
    assert lost.reasons[0] == (
        "K would have to hold with 50 N*m in its free sense at A = 0 rad: two runs ahead of one, and the drives do not "
        "say how fast. Drive both links, or let forces move them (simulate)."
    )
    k = da.compile(m, vary=["loads.T.value"], outputs=["effort.A"])
    assert k([[-7.0], [7.0]]).status[:, 0].tolist() == ["ok", "contact_lost"]
    assert da.loads(str(m)) == m


def test_what_it_pushes_with_is_a_couple_in_every_unit() -> None:
    """120 N m are 1200 N dm."""
    r = da.dynamics(da.loads(FILE.replace("moment: N*m", "moment: N*dm").replace("-120", "-1200")))
    assert quantity(r, "normal.K").kind == "moment"
    assert r["normal.K"][0] == pytest.approx(120)
    rows = [line.split() for line in r.text().splitlines()]
    k = rows.index(["contact", "least", "couple", "greatest", "lost", "from"])
    assert (rows[k + 1], rows[k + 3]) == (["N*dm", "N*dm"], ["K", "1200", "1200"])
    (contacts,) = [
        part for part in element_parts(DesignContext(r, 0, Notation())) if part.title == "Contacts"
    ]
    assert [(v.item, v.state, v.value) for v in contacts.verdicts] == [
        ("contact K", "ok", "least couple 1200 N·dm")
    ]


def test_it_freewheels_where_drives_turn_both_links() -> None:
    r = da.statics(da.loads(BOTH.replace("SPEED", "14")))
    assert r.status == ("freewheels",)
    assert r.reaction_moment("K")[0] == 0
    assert (r.effort("A")[0], r.effort("B")[0]) == pytest.approx((0, 120))
    assert r.reasons[0] == (
        "K freewheels at A = 0 rad and B = 0 rad: two turns ahead of one with 4 rad/s, and the clutch carries no "
        "couple."
    )
    with pytest.raises(da.ModelError) as caught:
        da.statics(da.loads(BOTH.replace("SPEED", "4"), name="k.yaml"))
    assert str(caught.value) == (
        "k.yaml:9: joint 'K' is turned in the sense that it blocks at A = 0 rad and B = 0 rad, with 6 rad/s; "
        "reverse a drive, or leave one out: then the joint holds"
    )
    mirrored = BOTH.replace("free: ccw", "free: cw").replace("SPEED", "4").replace("-120", "120")
    assert da.statics(da.loads(mirrored)).status == ("freewheels",)


def test_rollers_that_do_not_grip_slip() -> None:
    rollers = "free: ccw, rollers: {count: 6, radius: 40, wedge: 7 deg, coefficient: MU}"
    at = {
        mu: da.statics(da.loads(FILE.replace("free: ccw", rollers.replace("MU", mu))))
        for mu in ("0.0611", "0.0612")
    }
    assert [r.status[0] for r in at.values()] == ["slips", "ok"]
    assert at["0.0611"].reasons[0] == (
        "The rollers of K do not grip: they need a coefficient of friction of 0.06116, the tangent of half their "
        "wedge, and have 0.0611. Make the wedge narrower."
    )


def moved(kind: str, seed: int) -> tuple[da.Simulation, Any]:
    rng = np.random.default_rng(seed)
    size, pace, start = rng.uniform(6, 14), rng.uniform(1, 4), rng.uniform(5, 20)
    text = FILE.replace("one_way", kind).replace(
        "{position: 0, speed: 10 rad/s}", "{motor: {stall: 20 N*m, no_load: 30 rad/s}}"
    )
    text = text.replace("}}\nloads", "}, B: {effort: 0}}\nloads").replace(
        "-120", f'"-3 - {size}*sin({pace}*time)"'
    )
    text += f"start: {{A: {{position: 0, speed: 0}}, B: {{position: 0, speed: {start} rad/s}}}}\n"
    return da.simulate(da.loads(text), until="4 s"), rng


@over(quick=2, whole=100)
def test_in_a_motion_it_pushes_and_never_turns_back(seed: int) -> None:
    s, _ = moved("one_way", seed)
    slip, couple = s.speed("B") - s.speed("A"), s.joint_stop_force["K"]
    small = 1e-8 * float(np.abs(s.speed("B")).max())
    assert slip.min() > -small
    assert couple.min() > -1e-9
    assert np.abs(couple * slip).max() < 1e-6
    assert s.energy_residual < 1e-8
    assert s.law_residual < 1e-8
    torque = 20 * (1 - s.speed("A") / 30) - 1.5 * s.acceleration("A")
    inner = ~np.isin(s.time, [e.time for e in s.events])
    assert couple[inner] == pytest.approx(torque[inner], abs=1e-7)


@over_seeds((67,), range(40))  # 67 passes a tooth and falls back on it within one step
def test_a_ratchet_engages_at_its_teeth_with_an_impact(seed: int) -> None:
    s, _ = moved("ratchet, teeth: 12", seed)
    pitch = 2 * np.pi / 12
    for e in s.events:
        if "strikes" in e.sentence:
            k = int(np.argmin(np.abs(s.time - e.time)))
            teeth = (s.position("B") - s.position("A"))[k] / pitch
            assert teeth == pytest.approx(round(teeth), abs=1e-7)
            assert e.lost > 0
    assert s.energy_residual < 1e-8
    assert s.joint_stop_force["K"].min() > -1e-9
    least = np.maximum.accumulate(np.floor((s.position("B") - s.position("A")) / pitch + 1e-9)) * pitch
    assert ((s.position("B") - s.position("A")) - least).min() > -1e-7  # never back behind a tooth


HOIST = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, inertia: 0.5}}
joints:
  B: {type: pin, links: [ground, wheel], at: O}
  K: {type: ratchet, links: [ground, wheel], at: O, free: FREE, teeth: 12, angle: ANGLE deg}
drives: {B: {effort: EFFORT}}
start: {B: {position: START deg, speed: SPEED rad/s}}
"""


@pytest.mark.parametrize(
    ("free", "angle", "start", "speed", "tooth"),
    [
        ("ccw", 0, 10, 2, 60),  # up to 10 deg + 1 rad, and back
        ("ccw", 7, 10, 2, 67),
        ("ccw", -20, 10, 2, 40),
        ("ccw", 10, 10, 2, 40),
        ("cw", 7, 10, -2, -23),
        ("ccw", 10, 10, 0, 10),
        ("ccw", 11, 10, 0, -19),
        ("cw", 11, 10, 0, 11),
    ],
)
def test_a_wheel_falls_back_on_the_last_tooth_that_it_has_passed(
    free: str, angle: float, start: float, speed: float, tooth: float
) -> None:
    """0.5 kg m2 under 1 N m: the work of the fall is lost at the tooth."""
    way = 1 if free == "ccw" else -1
    text = HOIST.replace("FREE", free).replace("ANGLE", str(angle)).replace("EFFORT", f"{-way}")
    s = da.simulate(da.loads(text.replace("START", str(start)).replace("SPEED", str(speed))), "5 s", count=2)
    fall = way * (math.radians(start - tooth)) + speed**2 / 4
    assert np.degrees(s.position("B")[-1]) == pytest.approx(tooth, abs=1e-9)
    assert s.ended.startswith("at rest from")
    assert sum(np.nan_to_num(e.lost) for e in s.events) == pytest.approx(fall, rel=1e-7, abs=1e-12)


@pytest.mark.parametrize("way", [1, -1])
def test_a_clutch_without_teeth_holds_where_it_has_come_to_rest(way: int) -> None:
    """After 1 s and 1 rad, without an impact."""
    text = HOIST.replace("ratchet", "one_way").replace(", teeth: 12, angle: ANGLE deg", "")
    text = text.replace("FREE", "ccw" if way > 0 else "cw").replace("EFFORT", f"{-way}")
    s = da.simulate(da.loads(text.replace("START", "10").replace("SPEED", f"{2 * way}")), "5 s", count=2)
    assert s.position("B")[-1] == pytest.approx(math.radians(10) + way, rel=1e-9)
    assert s.ended == "at rest from 1 s on"
    assert [(e.name, e.sentence) for e in s.events] == [("rest", "K holds")]
    text = text.replace("START", "10").replace("SPEED", "0")
    later = text.replace(f"effort: {-way}", f"effort: {{expression: {way}*(time - 2 s)*1 N*m/s}}")
    s = da.simulate(da.loads(later), "5 s", count=2)
    assert s.speed("B")[-1] == pytest.approx(9 * way, rel=1e-9)
    said = [(e.name, e.sentence, e.time) for e in s.events]
    assert said == [("rest", "K holds", 0.0), ("start", "K turns freely", pytest.approx(2.0, rel=1e-9))]


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("free: ccw", "free: left", "free of joint 'K': 'left' is not a valid value; choose among ccw, cw"),
        (", free: ccw", "", "the key 'free' is missing in joint 'K'"),
        ("type: one_way", "type: ratchet", "the key 'teeth' is missing in joint 'K'"),
        (
            "free: ccw",
            "free: ccw, rollers: {count: 6}",
            "the key 'radius' is missing in rollers of joint 'K'",
        ),
    ],
)
def test_wrong_clutches_are_told(old: str, new: str, says: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(FILE.replace(old, new), name="k.yaml")
    assert says in str(caught.value)
    assert str(caught.value).startswith("k.yaml:9: ")


BESIDE = {  # what brakes the driven link, and the torque that it takes
    "band": (
        """  L: {type: pin, links: [ground, lever]}
  S: {type: band, links: [two, lever], around: O, radius: 200, ends: [ground.L, lever.B], wrap: 180 deg,
      friction: {coefficient: 0.3}}
""",
        100.0 * (1 - np.exp(-0.3 * np.pi)),
    ),
    "plates": (
        """  L: {type: weld, links: [ground, lever]}
  S: {type: disc, links: [ground, two], at: O, radii: [80, 120], force: 3000, friction: {coefficient: 0.3}}
""",
        0.3 * 3000 * 0.1,
    ),
    "rope": (
        """  L: {type: slider, links: [ground, lever], direction: -90 deg, angle: 90 deg}
  S: {type: rope, through: [{round: two.O, radius: 200, side: left}, lever.L]}
""",
        20.0,
    ),
}


@pytest.mark.parametrize("name", BESIDE)
def test_it_holds_beside_brakes_and_ropes(name: str) -> None:
    joints, torque = BESIDE[name]
    text = FILE.replace("{O: [0, 0]}}\n  one", "{O: [0, 0], L: [200, -300]}}\n  one")
    text = text.replace("joints:\n", "  lever: {points: {L: [0, 0], B: [-200, 0], P: [-1000, 0]}}\njoints:\n")
    text = text.replace("drives:", f"{joints}drives:")
    r = da.statics(
        da.loads(text.replace("loads: {", "loads: {P: {type: force, on: lever, at: P, value: [0, -100]}, "))
    )
    assert r.status == ("ok",)
    assert r.effort("A")[0] == pytest.approx(120 + torque)


def test_a_ratchet_beside_a_rope_moves_under_forces() -> None:
    """A rope is counted with its strands and pulleys: what a torque on the shaft lifts, and what it lets down."""
    tree = da.loads(template_text("ratchet")).to_tree()
    tree["start"] = {"A": {"position": 0, "speed": "20 rpm"}}
    inertia = 0.05 + 0.4 + 120 * 0.1**2
    for torque in (200.0, 100.0):
        tree["drives"]["A"] = {"effort": f"{torque} N*m"}
        s = da.simulate(da.mechanism(tree), "0.05 s", count=3)
        assert s.acceleration("A")[0] == pytest.approx((torque - 120 * 9.80665 * 0.1) / inertia, rel=1e-9)
