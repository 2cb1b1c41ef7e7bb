"""Contacts that only push: when they are lost, by hand; in kernels and analyses alike; what is refused."""

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError

G = 9.80665


def crate(acceleration: float, **keys: object) -> Any:
    """A crate of 40 kg on a floor that brakes; centre 0.6 m up, 0.25 m from both ends."""
    floor = {
        "type": "slider",
        "links": ["ground", "crate"],
        "at": ["O", "F"],
        "contact": "pushes",
        "friction": {"guide": [0.25, 0.25], "coefficient": 0},
    }
    return da.mechanism(
        {
            "gravity": "standard",
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "crate": {"points": {"F": [0, 0]}, "mass": 40, "center": [0, 0.6], "inertia": 3},
            },
            "joints": {"floor": floor | keys},
            "drives": {"floor": {"position": 0, "speed": "10 m/s", "acceleration": acceleration}},
        }
    )


def test_a_braked_crate_tips_about_its_front_end() -> None:
    """m g 0.25 = m a 0.6 at the limit; both sides of it, and the ends' forces from moments."""
    limit = G * 0.25 / 0.6
    for a, status in ((-limit * (1 - 1e-6), "ok"), (-limit * (1 + 1e-6), "contact_lost")):
        r = da.dynamics(crate(a))
        assert r.status == (status,)
        assert np.isnan(r.reaction("floor")).all() == (status != "ok")
        assert np.isfinite(r.acceleration("crate")).all()
    assert "floor would have to pull with 0.000" in str(r.reasons[0])
    assert "it tips, its rear end lifts off" in str(r.reasons[0])
    assert "its front end lifts off" in str(da.dynamics(crate(5.0)).reasons[0])
    c = da.dynamics(crate(-3)).contact("floor")
    ahead = 40 * (G / 2 + 3 * 0.6 / 0.5)
    assert (c.ahead, c.behind) == (pytest.approx([ahead]), pytest.approx([40 * G - ahead]))
    assert c.lift_factor == pytest.approx(math.sqrt(limit / 3))
    assert c.lift_speed == pytest.approx(10 * math.sqrt(limit / 3))
    assert da.dynamics(crate(-30, contact="holds")).status == ("ok",)


def test_the_acceleration_that_tips_is_that_of_the_positions_that_accelerate() -> None:
    """With a dwell behind the stroke: at either end of the stroke the crate tips from the same acceleration on."""
    rise = {"segments": [{"to": 0.02, "in": 0.1, "by": "parabolic"}, {"dwell": 0.1}], "count": 9}
    m = da.mechanism(crate(0).to_tree() | {"drives": {"floor": {"law": rise}}})
    r = da.dynamics(m)
    assert {0.0, 8.0} == set(np.abs(r.drive_acceleration("floor")).round(9))
    assert r.contact("floor").lift_acceleration == pytest.approx(G * 0.25 / 0.6)


def loop(speed: float, **keys: object) -> Any:
    """A point in a circular track of 0.5 m, led round by an arm in which it slides: v^2/R against g."""
    track = {"type": "circular_slot", "links": ["ground", "ball"], "at": ["O", "P"], "radius": 0.5}
    return da.mechanism(
        {
            "gravity": "standard",
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "arm": {"points": {"O": [0, 0]}},
                "ball": {"points": {"P": [0, 0]}, "mass": 0.2},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "arm"]},
                "guide": {"type": "slider", "links": ["arm", "ball"], "at": ["O", "P"]},
                "track": track | keys,
            },
            "drives": {"O": {"position": {"from": 0, "to": 360, "count": 24}, "speed": f"{speed} rad/s"}},
            "assembly": {"ball": [0.5, 0, 0]},
        }
    )


@pytest.mark.parametrize(("side", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_track_is_left_where_weight_and_centrifugal_force_say(side: str, sign: float) -> None:
    """Outside (left) the track pushes away from its centre with m (g sin - w^2 R), inside (right) towards it."""
    for speed in (1.0, 3.0, 5.0, 8.0):
        m = loop(speed, contact="pushes", side=side)
        r, angle = da.dynamics(m), np.arange(24) * math.pi / 12
        needed = sign * 0.2 * (G * np.sin(angle) - speed**2 * 0.5)
        lost = needed < -1e-9
        assert [s == "contact_lost" for s in r.status] == lost.tolist()
        c = r.contact("track")
        assert c.needed == pytest.approx(needed)
        assert np.isnan(c.force).tolist() == lost.tolist()
        holds = da.dynamics(loop(speed))
        for name in ("effort.O", "reaction.track.x", "reaction.guide.y"):
            assert r[name][~lost] == pytest.approx(holds[name][~lost])
            assert np.isnan(r[name][lost]).all()
        k = da.compile(m, vary=["links.ball.mass"], outputs=["effort.O", "reaction.track"])
        b = k([[0.2], [0.4]])
        assert (b.status == np.array(r.status)).all()
        assert b.value("effort.O")[0][~lost] == pytest.approx(r.effort("O")[~lost])


FOLLOWER = """
dalembert: 1
units: {length: mm, stiffness: N/mm}
links:
  ground: {points: {O: [0, 0], S: [0, 200]}}
  cam: {points: {O: [0, 0], C: [20, 0]}}
  roller: {points: {R: [0, 0]}}
  follower: {points: {R: [0, 0]}, mass: 1.5 kg}
joints:
  O: {type: pin, links: [ground, cam]}
  contact: {type: rolling, links: [cam, roller], at: [C, R], radii: [40, 10]}
  R: {type: pin, links: [follower, roller]}
  guide: {type: slider, links: [ground, follower], at: [O, R], direction: 90}
drives: {O: {position: [90, 180], speed: 300 rpm}}
loads: {k: {type: spring, between: [ground.S, follower.R], stiffness: 5, free_length: 180}}
"""


def test_a_follower_leaves_its_cam_at_a_speed() -> None:
    """At the top: spring 5 N/mm over 50 mm of 180, e w^2 R/(R + ...): the same speed from below and above, and both
    sides of it by the status."""
    m = da.loads(FOLLOWER)
    below, above = (da.dynamics(m.with_values({"drives.O.speed": f"{n} rpm"})) for n in (300, 900))
    limit = below.contact("contact").lift_speed
    assert above.contact("contact").lift_speed == pytest.approx(limit)
    assert above.status[0] == "contact_lost"
    for part, status in ((1 - 1e-6, "ok"), (1 + 1e-6, "contact_lost")):
        r = da.dynamics(m.with_values({"drives.O.speed": limit * part}))
        assert r.status[0] == status
    assert below.contact("contact").needed[0] == pytest.approx(208.5, rel=1e-3)
    assert math.isnan(da.statics(m).contact("contact").lift_factor)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"contact": "push"}, "unknown contact 'push'; did you mean 'pushes'"),
        (
            {"contact": {"restitution": 0.3}},
            "the contact does not say what it does; write contact: .pushes: true",
        ),
        (
            {"contact": {"pushes": "yes"}},
            "pushes is 'yes'; write pushes: true; of a slider also pushes: from below",
        ),
        (
            {"contact": {"pushes": True, "restitution": 1.5}},
            "restitution is 1.5; it is the speed after a landing",
        ),
        (
            {"contact": {"pushes": True, "restituton": 0.5}},
            "unknown key 'restituton' in contact of joint 'floor'; did you mean 'restitution'",
        ),
        ({"side": "right"}, "side is given without contact"),
    ],
)
def test_a_contact_that_makes_no_sense_is_refused(keys: dict[str, object], words: str) -> None:
    made = loop if "side" in keys else crate
    with pytest.raises(ModelError, match=words):
        made(0.0, **keys)


def test_a_contact_is_written_as_it_is_read() -> None:
    m = crate(0.0, contact="pulls", side="right")
    assert da.mechanism(m.model_dump(mode="json")) == m
    with pytest.raises(ModelError, match="both pushes and pulls; write contact: pushes"):
        da.dynamics(crate(0.0, contact="holds")).contact("floor")
    with pytest.raises(ModelError, match="unknown joint 'flor'; did you mean 'floor'"):
        da.dynamics(crate(0.0)).contact("flor")
