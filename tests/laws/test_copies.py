"""Copies of parts of a mechanism: as written out by hand, turned and mirrored, with every kind of joint and load."""

from __future__ import annotations

import random
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model import read_text
from tests.random_mechanisms import random_case
from tests.tiers import tiers

EXAMPLES = Path(__file__).parents[2] / "examples"


def whole_copied(tree: Any, **how: Any) -> tuple[Any, Any]:
    """The answers of a mechanism, and of it with a copy of all that moves beside it."""
    tree = {**tree, "gravity": "none"}
    moving = [name for name in tree["links"] if name != "ground"]
    copied = da.mechanism({**tree, "copies": [{"of": moving, "names": ["b"], **how}]})
    return da.dynamics(da.mechanism(tree), method="careful"), da.dynamics(copied, method="careful")


@pytest.mark.parametrize("seed", tiers([*range(5), 66], range(5, 66), range(67, 600)))
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_copy_of_all_has_the_answers_turned_or_mirrored(mirrored: bool, seed: int) -> None:
    angle = np.random.default_rng(seed).uniform(-3, 3)
    how = {"mirror" if mirrored else "phase": {"ground": f"{angle!r} rad"}}
    one, both = whole_copied(random_case(seed).tree, count=2, **how)
    turn, side = angle * (2 if mirrored else 1), -1 if mirrored else 1
    image = np.array([[np.cos(turn), -side * np.sin(turn)], [np.sin(turn), side * np.cos(turn)]])
    size = np.nanmax(np.abs(one.force_array), initial=1.0)
    for drive in one.drives:
        rows = one.compiled.layout.freedoms.angular[one.compiled.layout.driven]
        sign = side if rows[one.drives.index(drive)] else 1
        for result in (drive, f"{drive}_b"):
            wanted = one.effort(drive) * (sign if result != drive else 1)
            assert both.effort(result) == pytest.approx(wanted, rel=1e-7, abs=1e-7 * size)
    for joint in one.joints:
        on = one.mechanism.joints[joint].links[1]
        there = on if on == "ground" else f"{on}_b"
        wanted = one.reaction(joint, on) @ image.T
        assert both.reaction(f"{joint}_b", there) == pytest.approx(wanted, rel=1e-7, abs=1e-7 * size)


ENGINE = (EXAMPLES / "engine.yaml").read_text(encoding="utf-8").partition("# The exact values")[0]
FOUR = """
copies:
  - {of: [rod, piston], phase: {crank: [0, 180, 180, 0]}, shift: [0, 540, 180, 360]}
"""


def test_an_in_line_four_is_that_written_out_by_hand() -> None:
    by_hand = da.loads(ENGINE).to_tree()
    by_hand["links"]["crank"]["points"] |= {"A_2": ["-45 mm", 0], "A_3": ["-45 mm", 0], "A_4": ["45 mm", 0]}
    for k, later in ((2, 540), (3, 180), (4, 360)):
        by_hand["links"] |= {f"{name}_{k}": by_hand["links"][name] for name in ("rod", "piston")}
        by_hand["joints"] |= {
            f"A_{k}": {"type": "pin", "links": ["crank", f"rod_{k}"], "at": [f"A_{k}", "A"]},
            f"B_{k}": {"type": "pin", "links": [f"rod_{k}", f"piston_{k}"], "at": "B"},
            f"cylinder_{k}": by_hand["joints"]["cylinder"] | {"links": ["ground", f"piston_{k}"]},
        }
        gas = by_hand["loads"]["gas"]
        by_hand["loads"][f"gas_{k}"] = gas | {
            "on": f"piston_{k}",
            "value": gas["value"] | {"shift": f"{later} deg"},
        }
        by_hand["assembly"] |= {f"rod_{k}": 0, f"piston_{k}": 0}
    a, b = da.dynamics(da.loads(ENGINE + FOUR)), da.dynamics(da.mechanism(by_hand))
    assert a.effort("O2") == pytest.approx(
        b.effort("O2"), rel=1e-12, abs=1e-12 * np.abs(b.effort("O2")).max()
    )
    for joint in b.joints:
        assert a.reaction(joint) == pytest.approx(b.reaction(joint), rel=1e-12, abs=1e-9)


def test_an_expression_is_shifted_and_names_the_copys_own_coordinates() -> None:
    machine, _, _ = ENGINE.partition("loads:")
    value = "100*sin(O2) - 20*joints.cylinder.slide + links.rod.angle kN"
    load = f"loads: {{gas: {{type: force, on: piston, at: B, direction: 180, value: {value}}}}}"
    m = da.loads(f"{machine}{load}\n{FOUR}assembly: {{rod: 0, piston: 0}}")
    late = f"(O2 - {float(np.radians(540))!r})"
    assert m.loads["gas_2"].value.text == f"100*sin({late}) - 20*joints.cylinder_2.slide + links.rod_2.angle"
    assert m.loads["gas_2"].value.unit == "kN"


def test_what_is_mirrored_has_its_answers_mirrored() -> None:
    """Half a press, whose ram is in the line: its links push the ram evenly."""
    half = """
units: {length: mm}
links:
  ground: {points: {O: [-200, 0], C: [0, 0]}}
  crank: {points: {O: [0, 0], A: [80, 0]}, mass: 1, center: [30, 5]}
  link: {points: {A: [0, 0], B: [250, 0]}, mass: 2, center: [100, 10], inertia: 900 kg*mm^2}
  ram: {points: {B: [30, 0], C: [0, 0]}, mass: 8}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, link]}
  B: {type: pin, links: [link, ram], damping: 2}
  guide: {type: slider, links: [ground, ram], at: C, direction: 90, angle: -90}
drives: {guide: {position: {from: 150, to: 220, count: 4}, speed: 1 m/s}}
loads:
  F: {type: force, on: ram, at: C, value: [0, -100]}
  T: {type: couple, on: crank, value: 3*sin(guide) N*m}
  k: {type: spring, between: [ground.O, link.B], stiffness: 20}
  t: {type: torsion_spring, joint: O, stiffness: 4, free_angle: 10}
assembly: {crank: 45, link: 50, ram: 0}
"""
    copies = "copies: [{of: [crank, link], mirror: {ground: 90, ram: 90}, names: [right]}]\n"
    one, both = da.dynamics(da.loads(half)), da.dynamics(da.loads(half + copies))
    assert both.mechanism.point("ground", "O_right") == pytest.approx((0.2, 0.0), abs=1e-15)
    assert both.mechanism.point("ram", "B_right") == pytest.approx((-0.03, 0.0), abs=1e-15)
    for joint, on in (("O", "crank"), ("A", "link")):
        assert both.reaction(f"{joint}_right", f"{on}_right") == pytest.approx(
            one.reaction(joint, on) * [-1, 1], rel=1e-8
        )
    assert both.reaction("guide")[:, 0] == pytest.approx(0 * one.effort("guide"), abs=1e-8)
    alone = da.dynamics(
        da.loads(half).with_values(
            {f"links.{n}.mass": 0.0 for n in ("crank", "link")}
            | {
                "links.link.inertia": 0.0,
                "loads.T.value": 0.0,
                "loads.k.stiffness": 0.0,
                "loads.t.stiffness": 0.0,
                "joints.B.damping": 0.0,
            }
        )
    )
    assert both.effort("guide") - alone.effort("guide") == pytest.approx(
        2 * (one.effort("guide") - alone.effort("guide")), rel=1e-8
    )


def test_a_v_engine_is_a_mirrored_cylinder_on_the_same_crank() -> None:
    """Its effort is that of either cylinder alone, the crank being balanced and at a constant speed."""

    def inclined(by: int, shift: int = 0) -> str:
        text = ENGINE.replace("direction: 0}", f"direction: {by}}}").replace(
            "direction: 180 ", f"direction: {by + 180} "
        )
        text = text.replace("periodic: 720 deg", f"periodic: 720 deg\n      shift: {shift}")
        return text.replace("{rod: 0, piston: 0}", f"{{rod: {by}, piston: {by}}}")

    m = da.loads(f"{inclined(60)}\ncopies: [{{of: [rod, piston], mirror: 90, shift: 420}}]\n")
    assert m.joints["cylinder_2"].direction == pytest.approx(np.radians(120), rel=1e-14)
    both, one, other = (da.dynamics(v) for v in (m, da.loads(inclined(60)), da.loads(inclined(120, 420))))
    assert both.effort("O2") == pytest.approx(one.effort("O2") + other.effort("O2"), rel=1e-9, abs=1e-9)


def test_planets_are_a_step_apart() -> None:
    m = da.loads("""
links:
  ground: {points: {S: [0, 0]}}
  sun: {points: {S: [0, 0]}}
  carrier: {points: {S: [0, 0], P: [0.06, 0]}}
  planet: {points: {P: [0, 0]}, mass: 1}
joints:
  S: {type: pin, links: [ground, carrier]}
  W: {type: pin, links: [ground, sun], at: S}
  P: {type: pin, links: [carrier, planet]}
drives: {S: {position: 0}, W: {position: 0}, P: {position: 10}}
copies: [{of: [planet], count: 3, phase: {carrier: 120}, about: S}]
""")
    points = np.array([m.point("carrier", p) for p in ("P", "P_2", "P_3")])
    assert points.sum(axis=0) == pytest.approx([0, 0], abs=1e-16)
    assert [float(np.degrees(m.drives[d].position)) for d in ("P", "P_2", "P_3")] == pytest.approx(
        [10, 130, 250]
    )


WRONG = {
    "[{of: [rodd]}]": "no moving link 'rodd'; did you mean 'rod'?",
    "[{of: [rod, piston]}]": "does not say how many",
    "[{of: [rod, piston], count: 1}]": "does not say how many",
    "[{of: [], count: 2}]": "it says no links",
    "{of: [rod]}": "a mapping stands where a list is needed",
    "[{of: [rod, piston], count: 3, phase: {crank: [0, 180]}}]": "3 are asked for, and a list has 2",
    "[{of: [rod, piston], phase: {crank: [90, 180]}}]": "a list begins with 90, and the original stays",
    "[{of: [rod, piston], phase: {rod: [0, 180]}}]": "there is no link 'rod' that stays",
    "[{of: [rod, piston], phase: 180, count: 2}]": "180 does not say on which link",
    "[{of: [rod, piston], count: 2, phase: {crank: x}}]": "'x' is not an angle",
    "[{of: [rod, piston], count: 2, names: [b, c]}]": "1 names are needed",
    "[{of: [rod, piston], mirror: 90, phase: {crank: 90}}]": "it is both turned and mirrored",
    "[{of: [rod, piston], mirror: {crank: 90}}]": "'cylinder' does not say how link 'ground' is mirrored",
    "[{of: [rod], count: 2, shift: 90}]": "none of its loads goes by a drive that stays",
    "[{of: [piston, rod], count: 2, phases: 1}]": "there is no key 'phases'; did you mean 'phase'?",
    "[{of: [rod, piston], count: 2}, {of: [rod, piston], count: 2}]": "its link 'rod_2' is there already",
}


@pytest.mark.parametrize("copies", WRONG)
def test_a_wrong_copy_is_refused_at_its_line(copies: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        da.loads(f"{ENGINE}copies: {copies}\n", name="four.yaml")
    assert str(caught.value).startswith(f"four.yaml:{ENGINE.count(chr(10)) + 1}: ")
    assert WRONG[copies] in str(caught.value)
    assert caught.value.remedy


def test_errors_of_the_original_are_said_once_and_those_of_a_copy_at_its_line() -> None:
    line = ENGINE[: ENGINE.index("  rod: ")].count("\n") + 1
    with pytest.raises(da.ModelError) as caught:
        da.loads((ENGINE + FOUR).replace("mass: 0.6", "mass: 0.6 m"), name="four.yaml")
    assert str(caught.value).splitlines() == [
        f"four.yaml:{line}: mass of link 'rod': '0.6 m' is a length, and a mass is needed; "
        "write one, for example '1.5 kg'"
    ]


def test_copies_stay_in_a_file_that_is_saved_unless_they_differ(tmp_path: Path) -> None:
    m = da.loads(ENGINE + FOUR)
    heavier = m.with_values({"links.crank.mass": 5.0})
    heavier.save(tmp_path / "a.yaml")
    assert "copies:" in (tmp_path / "a.yaml").read_text()
    assert da.load(tmp_path / "a.yaml") == heavier
    other = m.with_values({"links.rod_3.mass": 0.7})
    other.save(tmp_path / "b.yaml")
    assert "copies:" not in (tmp_path / "b.yaml").read_text()
    assert da.load(tmp_path / "b.yaml") == other
    da.convert(tmp_path / "a.yaml", tmp_path / "c.json")
    assert da.load(tmp_path / "c.json") == heavier


@pytest.mark.parametrize("seed", range(3))
def test_a_file_with_copies_and_a_value_of_another_kind_is_read_or_refused(seed: int) -> None:
    tree, source = read_text(
        f"{ENGINE}{FOUR}  - {{of: [rod, piston], mirror: {{ground: 90, crank: 5}}, names: [m]}}\n"
    )
    rng, junk = random.Random(seed), [None, -1, "x", [], {}, True, "5 @ 3", [None], "unknown", 1e308]
    for _ in range(100):
        changed: Any = deepcopy(tree)
        part: Any = changed[rng.choice(["links", "joints", "drives", "loads", "copies", "assembly"])]
        while isinstance(part, (dict, list)) and part:
            key = rng.choice(list(part)) if isinstance(part, dict) else rng.randrange(len(part))
            if rng.random() < 0.4 or not isinstance(part[key], (dict, list)):
                part[key] = rng.choice(junk)
                break
            part = part[key]
        said = "text:"
        try:
            da.mechanism(changed, source)
        except da.ModelError as error:
            said = str(error)
        assert said.startswith("text:")
