"""Copies of parts of a mechanism: as written out by hand, turned and mirrored, with every kind of joint and load."""

from __future__ import annotations

import math
import random
from copy import deepcopy
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import dalembert as da
from dalembert.model import read_text
from tests.random_mechanisms import Drawing, Rigid, mirrored, random_case, tree
from tests.tiers import crossed, tiers

EXAMPLES = Path(__file__).parents[2] / "examples"


class Like(NamedTuple):
    """How an image differs: angles of links are side times those of the original plus an angle."""

    side: int = 1
    turn: float = 0.0

    def back(self, name: str, more: float) -> str:
        """A coordinate of the image as that of the original."""
        return f"({self.side}*({name} - ({more!r})))"

    def between(self, i: str, j: str) -> float:
        return self.turn * ((i == "ground") - (j == "ground"))


def changing_loads(d: Drawing, like: Like) -> dict[str, Any]:
    """Loads of a drawing that depend on its angles, slides and drives, written out by hand for its image."""
    rng = np.random.default_rng(d.seed)
    links = [name for name in d.poses if name != "ground"]
    k, n = (links[int(rng.integers(len(links)))] for _ in range(2))
    a, b, c, e = rng.uniform(-9, 9, 4).tolist()
    angle = like.back(f"links.{k}.angle", like.turn)
    force = [f"({a!r}*{angle})", f"({b!r}*cos({angle}) + {c!r})"]
    cos, sin = math.cos(like.turn), math.sin(like.turn)
    both = [
        f"{cos!r}*{force[0]} - {like.side * sin!r}*{force[1]}",
        f"{sin!r}*{force[0]} + {like.side * cos!r}*{force[1]}",
    ]
    x = d.poses[n][2] + np.array([-0.9, -0.3, 0.2, 1.0])
    y, shift = rng.uniform(-5, 5, 4), 0.1
    at = like.side * (x + shift) + like.turn - shift
    order = np.argsort(at)
    table = {
        "against": f"links.{n}.angle",
        "x": [f"{v!r} rad" for v in at[order].tolist()],
        "y": (like.side * y)[order].tolist(),
        "shift": f"{shift} rad",
        "interpolate": ("linear", "cubic")[d.seed % 2],
    }
    found = {
        "E": {"type": "couple", "on": n, "value": f"{like.side * e!r}*{angle}"},
        "V": {"type": "force", "on": k, "at": "center", "value": both if like.turn else force},
        "T": {"type": "couple", "on": k, "value": table},
    }
    for name, j in d.joints.items():
        kind = {"pin": "turn", "slider": "slide", "slot": "slide"}.get(j.type)
        if kind:
            own = f"joints.{name}.{kind}"
            used = like.back(own, like.between(j.i, j.j)) if kind == "turn" else own
            found[f"Q{name}"] = {"type": "couple", "on": k, "value": f"{like.side}*({a!r}*{used})"}
    for name, q in d.drives.items():
        j = d.joints[q.joint]
        used = like.back(name, like.between(j.i, j.j)) if q.freedom == "turn" else name
        value = {"expression": f"{like.side}*({b!r}*sin(3*{used}))", "unit": "N*m"}
        found[f"D{name}"] = {"type": "couple", "on": n, "value": value}
    return found


def with_changing_loads(d: Drawing, like: Like | None = None) -> Any:
    """The tree of a drawing, or of its image, with changing loads and without gravity."""
    like = like or Like()
    made = tree(mirrored(d) if like.side < 0 else d, motion=Rigid(like.turn))
    return {**made, "gravity": "none", "loads": made["loads"] | changing_loads(d, like)}


def solved(made: Any) -> da.Result:
    return da.dynamics(da.mechanism(made), method="careful")


def last_alone(made: Any) -> Any:
    drives = {n: {**q, "position": q["position"][-1:]} for n, q in made["drives"].items()}
    return {**made, "drives": drives}


@pytest.mark.parametrize("seed", tiers([*range(3), 66], range(3, 33), [*range(33, 66), *range(67, 600)]))
@pytest.mark.parametrize("side", [1, -1])
def test_a_copy_of_all_has_the_answers_of_the_image_and_of_what_is_written_out_by_hand(
    side: int, seed: int
) -> None:
    angle = np.random.default_rng(seed).uniform(-3, 3)
    d, turn = random_case(seed).drawing, angle * (2 if side < 0 else 1)
    one = with_changing_loads(d)
    how = {"mirror" if side < 0 else "phase": {"ground": f"{angle!r} rad"}, "count": 2}
    copied = {**one, "copies": [{"of": [n for n in d.poses if n != "ground"], "names": ["b"], **how}]}
    original, both, hand = map(solved, (one, copied, with_changing_loads(d, Like(side, turn))))
    phased = any(j.type in ("gear", "rolling") for j in d.joints.values())  # of the list's first position
    late = both if phased else solved(last_alone(copied))
    image = np.array([[np.cos(turn), -side * np.sin(turn)], [np.sin(turn), side * np.cos(turn)]])
    size = max(np.nanmax(np.abs(original.force_array), initial=1.0), np.nanmax(np.abs(original.effort_array)))
    for drive in original.drives:
        sign = side if d.drives[drive].freedom == "turn" else 1
        assert both.effort(drive) == pytest.approx(original.effort(drive), rel=1e-7, abs=1e-7 * size)
        for found in (both.effort(f"{drive}_b"), hand.effort(drive)):
            assert found == pytest.approx(sign * original.effort(drive), rel=1e-7, abs=1e-7 * size)
        assert late.effort(f"{drive}_b")[-1] == pytest.approx(both.effort(f"{drive}_b")[-1], abs=1e-7 * size)
    for joint in original.joints:
        on = original.mechanism.joints[joint].links[1]
        wanted = original.reaction(joint, on) @ image.T
        there = on if on == "ground" else f"{on}_b"
        for force in (both.reaction(f"{joint}_b", there), hand.reaction(joint, on)):
            assert force == pytest.approx(wanted, rel=1e-7, abs=1e-7 * size)


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


PARAMETERS = """
units: {length: mm}
parameters: {th: 33 deg, p: 20 N, r: 100 mm, k: 2}
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: r @ th, B: [r + 5 mm, 5 mm - r/4]}, mass: 1, center: [r/2, k]}
joints: {O: {type: pin, links: [ground, arm], stops: {from: -th, to: 3*th}}}
drives: {O: {position: [20, 25, 30*k]}}
loads:
  F: {type: force, on: arm, at: A, value: 10 @ th}
  G: {type: force, on: arm, at: [r/2, 5 mm - r], value: [p, 2*p*sin(O)]}
  H: {type: force, on: arm, at: B, value: [3*sin(O), 4]}
  C: {type: couple, on: arm, value: 5 N*m + p*r*sin(O)}
  T: {type: couple, on: arm, value: {x: [0, 90], y: [1, 5], times: k}}
copies: [{of: [arm], HOW}]
"""


@pytest.mark.parametrize("turned", [0, 90, 180, 270, 37])
@pytest.mark.parametrize("side", [1, -1])
def test_what_follows_from_parameters_still_does_in_a_copy(side: int, turned: int) -> None:
    how = f"mirror: {{ground: {turned}}}" if side < 0 else f"phase: {{ground: [0, {turned}]}}"
    m = da.loads(PARAMETERS.replace("HOW", how))
    for changed in (m, m.with_values({"th": "12 deg", "p": 7.0, "k": 1.5})):
        r = da.statics(changed)
        assert r.effort("O_2") == pytest.approx(side * r.effort("O"), rel=1e-12)
        sizes = (np.hypot(*r.reaction(joint).T) for joint in ("O_2", "O"))
        assert next(sizes) == pytest.approx(next(sizes), rel=1e-12)
        stops = (changed.joints[name].stops for name in ("O", "O_2"))
        assert [s.greatest - s.least for s in stops] == pytest.approx(
            [4 * changed.parameters["th"].value] * 2
        )


ARM = """
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.1, 0]}, mass: 1, center: [0.05, 0], inertia: 0.01}
joints: {O: {type: pin, links: [ground, arm]STOPS}}
drives: {O: {DRIVE}}
start: {O: {position: 10 deg, speed: 0.5 rad/s}}
copies: [{of: [arm], COPY: {ground: ANGLE}}]
"""
LET_GO = {
    "motor: {stall: 2 N*m, no_load: 30 rad/s}": "",
    "motor: {stall: 2 N*m, no_load: 30 rad/s, off: 100 deg}": "",
    "motor: {stall: 2 N*m, no_load: 30 rad/s, on: 12 deg, off: 9 rad/s}": "",
    "motor: {stall: 2 N*m, no_load: 30 rad/s, off: 0.1 s}": "",
    "motor: {curve: {speed: [-5 rad/s, 3 rad/s, 300 rpm], torque: [3, 2, -1]}}, brake: 0.1 N*m": "",
    "effort: 0.5*cos(O) - 0.01*O.speed, stops: {from: -10 deg, to: 40 deg, restitution: 0.3}": "",
    "effort: 0.5 N*m": ", stops: {from: -10 deg, to: 40 deg}",
    "effort: 0.6 N*m": ", stops: {from: -10 deg, to: 14 deg, stiffness: 50 N*m/rad, damping: 0.2}",
    "effort: 0.5": ", stops: {to: 30 deg, restitution: 0.5}",
}


@crossed("drive, copy", LET_GO, ["mirror: 0", "mirror: 35", "phase: [0, 90]"])
def test_a_copy_moves_under_forces_as_its_image(drive: str, copy: str) -> None:
    """Motors with their switches, brakes, stops of drives and joints, and the start."""
    how, _, angle = copy.partition(": ")
    text = ARM.replace("DRIVE", drive).replace("STOPS", LET_GO[drive])
    s = da.simulate(da.loads(text.replace("COPY", how).replace("ANGLE", angle)), 0.5)
    side, turn = (-1, math.radians(2 * float(angle))) if how == "mirror" else (1, math.radians(90))
    value, rate, _ = s.result.freedom("O", "turn")
    new, new_rate, _ = s.result.freedom("O_2", "turn")
    assert new == pytest.approx(side * value + turn, abs=1e-8)
    assert new_rate == pytest.approx(side * rate, abs=1e-7)
    switched = [e.words[0] for e in s.events if e.name.startswith("motor")]
    of_copy = [words.replace("O_2", "O") for words in switched if "O_2" in words]
    assert of_copy == [words for words in switched if "O_2" not in words]


ROD = """
links:
  ground: {points: {O: [0, 0], S: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  rod: {points: {A: [0, 0], B: [0.4, 0]}}
  piston: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [S, B]}
drives: {O: {position: POSITION, speed: 1 rad/s}}
loads: {C: {type: couple, on: crank, value: 3*links.rod.angle}}
assembly: {rod: 0, piston: 0OWN}
copies: [{of: [crank, rod, piston], HOW}]
"""


@pytest.mark.parametrize(
    "how", ["mirror: {ground: 90}", "phase: {ground: [0, 180]}", "phase: {ground: [0, 90]}"]
)
def test_whole_turns_of_a_copys_angle_are_the_images_in_every_list_of_positions(how: str) -> None:
    """3 N m/rad times the rod's angle, asin(0.1/0.4 sin 60 deg), on a crank that nothing else loads."""
    side = -1 if "mirror" in how else 1
    wanted = {q: 3 * math.asin(0.25 * math.sin(math.radians(q))) for q in (60, 180, 300)}
    assert wanted[60] == pytest.approx(0.65470354, abs=1e-8)
    for positions in ([60], [300], [300, 60], [60, 180, 300]):
        text = ROD.replace("HOW", how).replace("POSITION", str(positions))
        for method in ("auto", "careful"):
            r = da.statics(da.loads(text.replace("OWN", "")), method=method)
            assert r.effort("O") == pytest.approx([wanted[q] for q in positions], abs=1e-12)
            assert r.effort("O_2") == pytest.approx([side * wanted[q] for q in positions], abs=1e-12)
        own = {"mirror": 180 + 360, "phase": 180 - 360}[how[: how.index(":")]] - 90 * ("90]" in how)
        r = da.statics(da.loads(text.replace("OWN", f", rod_2: {own}")))
        turned = side * 2 * math.pi  # its own assembly is one turn off
        assert r.effort("O_2") == pytest.approx([side * wanted[q] + 3 * turned for q in positions], abs=1e-12)


WRONG = {
    "[{of: [rodd]}]": "unknown moving link 'rodd'; did you mean 'rod'?",
    "[{of: [rod, piston]}]": "does not say how many",
    "[{of: [rod, piston], count: 1}]": "does not say how many",
    "[{of: [], count: 2}]": "it says no links",
    "{of: [rod]}": "expected a list, not a mapping",
    "[{of: [rod, piston], count: 3, phase: {crank: [0, 180]}}]": "count is 3, but a list has 2 values",
    "[{of: [rod, piston], phase: {crank: [90, 180]}}]": "a list begins with 90, and the original stays",
    "[{of: [rod, piston], phase: {rod: [0, 180]}}]": "'rod' is not a link outside the copies",
    "[{of: [rod, piston], phase: {cranc: [0, 180]}}]": "'cranc' is not a link outside the copies; did you mean",
    "[{of: [rod, piston], phase: 180, count: 2}]": "180 does not say on which link",
    "[{of: [rod, piston], count: 2, phase: {crank: x}}]": "'x' is not an angle",
    "[{of: [rod, piston], count: 2, names: [b, c]}]": "1 names are needed",
    "[{of: [rod, piston], mirror: 90, phase: {crank: 90}}]": "it is both turned and mirrored",
    "[{of: [rod, piston], mirror: {crank: 90}}]": "'cylinder' does not say how link 'ground' is mirrored",
    "[{of: [rod], count: 2, shift: 90}]": "none of its loads depends on a drive that is not copied",
    "[{of: [piston, rod], count: 2, phases: 1}]": "unknown key 'phases'; did you mean 'phase'?",
    "[{of: [rod, piston], count: 2}, {of: [rod, piston], count: 2}]": "its link 'rod_2' already exists",
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
        f"four.yaml:{line}: mass of link 'rod': '0.6 m' is a length, but a mass is needed; "
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


def turned(v: Any, angle: float) -> list[float]:
    """A vector turned about z by an angle in degrees."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]]


def test_a_hexapod_of_copies_is_the_one_written_out() -> None:
    """Six legs written once, against the same six written one by one, and against the platform's equilibrium."""
    m = da.load(EXAMPLES / "hexapod.yaml")
    lower, upper = [0, 80, 120, 200, 240, 320], [0, 40, 120, 160, 240, 280]
    tree = da.load(EXAMPLES / "hexapod.yaml").to_tree()
    si = {"A": turned([0.4, 0, 0], 20), "B": turned([0.25, 0, 0], 40)}
    line = [*np.subtract(si["B"], si["A"])[:2], 0.5]
    si |= {"S": [-x / 3 for x in line], "barrel": [x / 3 for x in line]}
    tangent = (line[1], -line[0], 0)
    pin = np.cross(tangent, line)
    links: Any = {
        "ground": {"points": {}},
        "platform": {"mass": 30, "inertia": [1, 1, 2], "points": {"P": [0.1, 0, 0.05]}},
    }
    joints: Any = {}
    drives: Any = {}
    for k, (a, b) in enumerate(zip(lower, upper, strict=True)):
        links["ground"]["points"][f"A{k}"] = turned(si["A"], a)
        links["platform"]["points"][f"B{k}"] = turned(si["B"], b)
        links[f"barrel{k}"] = {
            "points": {"A": [0, 0, 0]},
            "mass": 4,
            "center": turned(si["barrel"], a),
            "inertia": 0.05,
        }
        center = turned(si["S"], a)
        links[f"rod{k}"] = {"points": {"B": [0, 0, 0]}, "mass": 1.5, "center": center, "inertia": 0.02}
        axes = {"i": {"z": turned(tangent, a)}, "j": {"z": turned(pin, a)}}
        joints[f"A{k}"] = {
            "type": "universal",
            "links": ["ground", f"barrel{k}"],
            "at": [f"A{k}", "A"],
            "axes": axes,
        }
        slide = {
            "type": "prismatic",
            "links": [f"barrel{k}", f"rod{k}"],
            "at": ["A", "B"],
            "axis": turned(line, a),
        }
        joints[f"S{k}"] = slide
        joints[f"B{k}"] = {"type": "spherical", "links": [f"rod{k}", "platform"], "at": ["B", f"B{k}"]}
        drives[f"S{k}"] = {"position": math.hypot(*line)}
    loads = {"work": {"type": "force", "on": "platform", "at": "P", "value": [300, 0, -1000]}}
    written = {"space": "space", "gravity": "standard", "links": links, "joints": joints, "drives": drives}
    r, out = da.statics(m), da.statics(da.mechanism({**written, "loads": loads}))
    assert tree["links"].keys() >= {"rod_6", "barrel_2"}
    names = ["S", *(f"S_{k}" for k in range(2, 7))]
    np.testing.assert_allclose(
        [r.effort(n)[0] for n in names], [out.effort(f"S{k}")[0] for k in range(6)], rtol=1e-7
    )
    balls = np.array([r.reaction("B" + n[1:], on="platform")[0] for n in names])
    at = np.array([r.point("platform", p)[0] for p in ("B", *(f"B_{k}" for k in range(2, 7)))])
    weight = np.array([0, 0, -30 * 9.80665])
    load, place = np.array([300.0, 0, -1000]), r.point("platform", "P")[0]
    center = r.center("platform")[0]
    np.testing.assert_allclose(balls.sum(axis=0), -(weight + load), atol=1e-8)
    moment = np.cross(at, balls).sum(axis=0) + np.cross(place, load) + np.cross(center, weight)
    np.testing.assert_allclose(moment, 0, atol=1e-8)


WRONG_IN_SPACE = [
    ("    phase: {ground", "    about: A\n    phase: {ground", "copies in space are turned about the z axis"),
    (
        "A: [base*cos(20 deg), base*sin(20 deg), 0]}",
        "A: {from: Q, at: [0, 1, 0]}, Q: [375.877, 135.808, 0]}",
        "placed from another one",
    ),
    (", platform: [0, 40, 120, 160, 240, 280]", ", platform: [0, 40]", "count is 2, but a list has 6 values"),
]


@pytest.mark.parametrize(("old", "new", "says"), WRONG_IN_SPACE)
def test_wrong_copies_in_space_are_refused_with_their_line(
    old: str, new: str, says: str, tmp_path: Path
) -> None:
    text = (EXAMPLES / "hexapod.yaml").read_text(encoding="utf-8")
    assert old in text
    (tmp_path / "h.yaml").write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(da.ModelError, match=rf"h\.yaml:\d+: copies 1: .*{says}"):
        da.load(tmp_path / "h.yaml")


RSSR = (
    (Path(__file__).parents[1] / "model" / "rssr.yaml").read_text(encoding="utf-8").partition("answers:")[0]
)
BAR = "{type: bar, between: [A, B], area: 50, density: 7850 kg/m^3}"
SHAPES = """[{type: sphere, radius: 15, center: [-10, 40, 20], density: 7850 kg/m^3},
    {type: cylinder, radius: 4, axis: [1, 2, 3], length: 60, center: [5, 6, 7], density: 2700 kg/m^3},
    {type: bar, between: [A, B], area: 50, density: 7850 kg/m^3},
    {type: box, size: [10, 60, 20], center: [3, 0, 9], density: 2 g/cm^3, axes: {x: [1, 1, 0], z: [0, 0, 1]}}]"""
MORE = """
  pull: {type: force, on: rod, at: [-10, 40, 30], value: [3, -4, 5]}
  twist: {type: couple, on: crank, value: [300, 200, -100]}
  along: {type: force, on: crank, at: A, axes: link, value: [3, 7, 5]}
"""
OF_ALL = "copies: [{of: [crank, rod, rocker], count: 2, phase: {ground: 35}}]\n"


def test_a_copy_in_space_turns_with_all_that_is_on_it() -> None:
    """Shapes of every kind, inertias, vectors of loads, axes and poses: its forces are those of the original turned."""
    text = RSSR.replace(BAR, SHAPES).replace("\n\nassembly", f"{MORE}\nassembly")
    text = text.replace(
        "axes: {i: {x: [1, 0, 0]}, j: {x: [1, 0, 0], z: [0, 0, 1]}}, damping", "axis: [1, 0, 0], damping"
    )
    r = da.dynamics(da.loads(text + OF_ALL))
    assert r.ok.all()
    angle = math.radians(35)
    turn = np.array(
        [[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1.0]]
    )
    for link in ("crank", "rod", "rocker"):
        assert r.center(f"{link}_2") == pytest.approx(r.center(link) @ turn.T, abs=1e-9)
    one, two = (np.array(r.mechanism.links[n].mass_properties().inertia) for n in ("rod", "rod_2"))
    assert two == pytest.approx(turn @ one @ turn.T, rel=1e-12, abs=1e-15)
    for joint in "OABC":
        on = r.mechanism.joints[joint].links[1]
        for read in (r.reaction, r.reaction_moment):
            one, two = read(joint, on), read(f"{joint}_2", f"{on}_2")
            assert np.abs(one).max() > 1e-3 or (read == r.reaction_moment and joint == "A")
            assert two == pytest.approx(one @ turn.T, rel=1e-6, abs=1e-7 * np.abs(one).max(initial=1.0))
    for drive in ("O", "slide of C"):
        assert r.effort(f"{drive}_2") == pytest.approx(r.effort(drive), rel=1e-6, abs=1e-9)
        assert np.abs(r.effort(drive)).max() > 1e-3


WRONG_ON_A_COPY = [
    (BAR, "{type: box, size: [1, 2, 3], density: 3 kg/m^3}", "a box without axes is not turned; give mass, center and "
     "inertia instead of its shape"),
    (BAR, "{type: mesh, file: a.stl, density: 3 kg/m^3}", "a mesh is not turned; give mass, center and inertia instead "
     "of its shape"),
    ("C: [0, 150, 0]}", "C: [0, 150, 0], C_2: [1, 2, 3]}", "link 'ground' has a point 'C_2' already; give the copies "
     "other names: names: [...]"),
    ("inertia: [10, 250, 255]", "inertia: ['10*k', 250, 255]", "an inertia that follows from parameters is not turned; "
     "give the copies a shape, or one number"),
    ("B: {type: universal", "G: {type: gear, at: [A, C], radii: [1, 2], axis: [0, 0, 1], links: [rod, rocker]}\n"
     "  B: {type: universal", "'G' is a gear or a band, which is not copied in space; write its copies out"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "says"), WRONG_ON_A_COPY)
def test_what_cannot_be_turned_in_space_is_refused(old: str, new: str, says: str) -> None:
    assert old in RSSR
    with pytest.raises(da.ModelError) as caught:
        da.loads(RSSR.replace(old, new) + OF_ALL + "parameters: {k: 1}\n", name="r.yaml")
    assert str(caught.value).endswith(says)
    assert "copies 1: " in str(caught.value)


def test_one_axis_in_links_turned_differently_is_refused() -> None:
    hinge = "A: {type: revolute, axis: [0, 0, 1], links"
    text = RSSR.replace("A: {type: spherical, links", hinge)
    text += "copies: [{of: [crank], count: 2, phase: {ground: 35, rod: 10}}]\n"
    with pytest.raises(da.ModelError) as caught:
        da.loads(text, name="r.yaml")
    assert str(caught.value).endswith(
        "copies 1: 'A' has one axis in links that are turned by different angles; give both links the same angle in "
        "phase, or write axes"
    )
