"""Machines written in a way that says too little, and what a compiled analysis cannot do: whole sentences."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.analysis.friction.fixed_point import contacts_in_motion
from dalembert.bundled import cases
from dalembert.errors import AnalysisError, ModelError
from dalembert.model import loads, tree_text
from dalembert.model.library import bennett, in_line_engine, rccc, spherical_four_bar, v_engine
from dalembert.saving import check_new_folder, new_folder
from tests.elements.test_brakes import BAND, BRAKES, SHOE
from tests.elements.test_one_way import FILE as CLUTCH
from tests.model.parts import FOUR_BAR
from tests.model.test_wrong import RSSR

PIN, MOTION = (
    "B:  {type: pin, links: [coupler, rocker]}",
    "position: 60 deg, speed: 25 rad/s, acceleration: -40 rad/s^2",
)
CONE = "cone: {type: cone, links: [ground, disc], at: O, radii: [50, 60], force: "


TURNING = """links:
  ground: {points: {O: [0.3, 0]}}
  rod: {points: {O: [0, 0]}, mass: 2, center: [0.5, 0], inertia: 0.1}
joints: {O: {type: pin, links: [ground, rod], friction: {coefficient: 0.1, radius: 0.01}}}
turning: {axis: y, speed: unknown}
drives: {O: {position: -40 deg, effort: 0}}
gravity: [0, -9.81]
"""
HELD = """links: {ground: {points: {O: [0, 0], P: [1, 0]}}, rod: {points: {O: [0, 0], P: [1, 0]}}}
joints: {O: {type: pin, links: [ground, rod]}, P: {type: slot, links: [ground, rod]}}
"""


def changed(text: str, *changes: tuple[str, str]) -> da.Mechanism:
    """The machine of a file with other words in it."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return loads(text)


def three_clutched() -> da.Mechanism:
    """Two one-way clutches on one shaft, the link of one of them driven."""
    return changed(
        CLUTCH,
        ("joints:\n", "  three: {points: {O: [0, 0]}, inertia: 0.8 kg*m^2}\njoints:\n"),
        ("  K:", "  C: {type: pin, links: [ground, three], at: O}\n  K2: {type: one_way, links: [one, three], at: O, "
                 "free: ccw}\n  K:"),
        ("drives: {A: {position: 0, speed: 10 rad/s}}",
         "drives: {A: {position: 0, speed: 10 rad/s}, B: {position: 0, speed: 5 rad/s}}"),
    )  # fmt: skip


def compiled(m: da.Mechanism, *outputs: str, **options: Any) -> Any:
    return da.compile(m, ["links.crank.weight"], list(outputs) or None, **options)


REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "a drive of one of two freedoms": (
        lambda: changed(
            FOUR_BAR,
            (PIN, "B: {type: slot, links: [coupler, rocker]}"),
            ("  O2: {position", "  B: {position"),
        ),
        "text:25: drive 'B' does not say which freedom of its joint it prescribes: slide or turn; write freedom: slide",
    ),
    "a drive of a weld": (
        lambda: changed(
            FOUR_BAR,
            (PIN, "B: {type: weld, links: [coupler, rocker]}"),
            ("  O2: {position", "  B: {position"),
        ),
        "text:25: drive 'B' drives joint 'B', a weld without a freedom to prescribe; drive another joint",
    ),
    "a band whose lever slides": (
        lambda: da.statics(changed(BAND, ("L: {type: pin,", "L: {type: slider,"))),
        "text:10: joint 'band': the angle of the band on the drum is not clear; write wrap: 270 deg",
    ),
    "a band inside its drum": (
        lambda: da.statics(changed(BAND, ("radius: 120", "radius: 317"))),
        "text:10: joint 'band': an end of the band is inside the drum; move it out",
    ),
    "a lining on neither side": (
        lambda: da.statics(changed(SHOE, ("P: [0, 212]", "P: [-50, 112]"))),
        "text:10: joint 'S': on which side of its point the lining lies is not clear; write side: left or side: right",
    ),
    "an unknown force without friction": (
        lambda: da.statics(
            changed(
                BRAKES,
                (
                    CONE + "100, half_angle: 12, friction: {coefficient: 0.2}}",
                    CONE + "unknown, half_angle: 12}",
                ),
            )
        ),
        "text:22: joint 'cone' has an unknown force and no friction; give it friction: {coefficient: 0.3}",
    ),
    "a brake that does not rub": (
        lambda: da.statics(changed(SHOE, (",\n      friction: {coefficient: 0.9}}", "}"))).brake("S"),
        "joint 'S' has no friction here; give it friction: {coefficient: 0.3}",
    ),
    "one of two clutches would hold": (
        lambda: da.statics(three_clutched()),
        "text:11: 1 of the clutches K2 and K would hold, and which of them depends on the motion; drive the links of "
        "the others too, or let forces move them (simulate)",
    ),
    "a known effort with a start": (
        lambda: da.statics(
            changed(FOUR_BAR, (MOTION + "}", "position: 60 deg, effort: 3}\nstart: {O2: {position: 60}}"))
        ),
        "text:24: 1 drive effort is given but no load is unknown; make 1 load unknown (`value: unknown` with a "
        "direction) or leave the efforts out; the motion that forces give it from its start is that of `dalembert "
        "simulate`",
    ),
    "friction in motion of a machine at rest": (
        lambda: contacts_in_motion(da.statics(da.load(cases()["seed-002-7d-engine-at-rest"])), 0),
        "the machine is at rest here: the senses of friction are not given; give the drive a speed",
    ),
    "the friction of a slot in space": (
        lambda: da.lifted(
            changed(
                FOUR_BAR, (PIN, "B: {type: slot, links: [coupler, rocker], friction: {coefficient: 0.1}}")
            )
        ),
        "friction of joint 'B', a slot, is not lifted; leave it out, or switch it off with friction: {enabled: false}",
    ),
    "turned axes of sums in space": (
        lambda: da.solution(da.solve(da.rssr()), along=0.3),
        "axes of sums are turned in the plane only; leave along out",
    ),
    "a reduced reaction in the link's axes": (
        lambda: compiled(loads(FOUR_BAR), "reaction.A", reduce="peak")([[1.0]]).reaction("A", axes="link"),
        'a reduced reaction has ground axes only; leave axes="link" out',
    ),
    "a reaction in the joint's axes of a batch": (
        lambda: compiled(loads(FOUR_BAR), "reaction.A")([[1.0]]).reaction("A", axes="joint"),
        "unknown axes 'joint'; use ground or link",
    ),
    "shaking by a drive from outside": (
        lambda: compiled(changed(FOUR_BAR, (MOTION, MOTION + ", by: outside")), "shaking_force"),
        "the shaking force with drive 'O2' by: outside is not compiled; use da.shaking",
    ),
    "positions where speeds change": (
        lambda: compiled(changed(FOUR_BAR, (MOTION, "position: [60, 70], speed: [1 rad/s, 2 rad/s]")))(
            [[1.0]], positions=[[0.1]]
        ),
        "the drives' speeds change along the file's positions; leave positions out",
    ),
    "a table of too many points": (
        lambda: compiled(
            changed(
                FOUR_BAR,
                (
                    "value: 120}",
                    f"value: {{against: links.crank.angle, x: {[k / 9 for k in range(1026)]}, y: {[1] * 1026}}}}}",
                ),
            )
        ),
        "text:1: a table of 1026 points is not compiled against 'links.crank.angle'; give it at most 1025, or use "
        "da.dynamics, da.statics or da.sweep",
    ),
    "a start that varies": (
        lambda: da.compile(
            changed(FOUR_BAR, (MOTION + "}", MOTION + "}\nstart: {O2: {position: 60}}")),
            ["start.O2.position"],
        ),
        "text:26: 'start.O2.position' is of a motion under forces; compile one: da.compile_motion",
    ),
    "an unknown speed of turning with friction": (
        lambda: da.compile(loads(TURNING), ["links.rod.mass"]),
        "text:5: with friction an unknown speed of turning cannot be compiled; give the speed and read the effort, or "
        "use da.statics",
    ),
    "a place by the value of no drive": (
        lambda: da.draw.mechanism(da.statics(loads(HELD)), at="3 deg"),
        "the mechanism has no drive to name a position by; give the number of the position",
    ),
    "torsion of a section of numbers": (
        lambda: da.Section(area=1e-4, modulus=1e-6, inertia=1e-8).torsion,
        "a section given by its numbers has no torsion or biaxial bending properties; give a rectangle, a circle, a "
        "tube or an I",
    ),
    "a path into a number": (
        lambda: da.four_bar().with_values({"links.crank.mass.x": 3}),
        "the path 'links.crank.mass.x' goes into a single value; leave out its end",
    ),
    "an FMI version of no unit": (
        lambda: da.convert("examples/four_bar.yaml", "four.json", fmi="2.0"),
        "fmi 2.0 is for a file .fmu, not four.json; leave it out",
    ),
    "a format of texts": (lambda: loads("{}", "xml"), "unknown format 'xml'; use yaml, json or toml"),
    "too long a text": (
        lambda: loads("#" + "x" * 1_000_001),
        "text:1: the file has more than 1000000 characters; give large tables fewer points",
    ),
    "an alias as a key": (
        lambda: loads("links: {a: &x {mass: 1}}\n*x : 3\n"),
        "text:2: an alias cannot be a key; write the key",
    ),
    "throws of an engine": (
        lambda: v_engine(cylinders=4, throws=[0]),
        "v_engine: the number of throws is 1, that of pairs of cylinders 2; give one a pair",
    ),
    "a rod as long as the crank": (
        lambda: in_line_engine(crank=0.1, rod=0.1),
        "the rod of 0.1 m is no longer than the crank of 0.1 m; give a longer rod",
    ),
    "a crank that stays": (
        lambda: da.five_bar(sweep=(0.3, 0.3)),
        "five_bar: the sweep of the crank begins where it ends; give two different angles",
    ),
    "an axis of no length": (
        lambda: da.rssr(axis=(0.0, 0.0, 0.0)),
        "rssr: axis has no direction; give one component other than 0",
    ),
    **{
        f"a slide passed at {offset}": (
            partial(da.inverted_slider_crank, ground=0.1, crank=0.12, offset=offset),
            f"inverted_slider_crank: the crank pin passes O4 at 0.02 m, not farther than the slide's offset of {shown} "
            "m; let ground and crank differ by more, or take a smaller offset",
        )
        for offset, shown in ((-0.03, "0.03"), (0.03, "0.03"), (-0.02, "0.02"))
    },
    "a dimension of no template": (
        lambda: da.rssp(axis=(0, 0, 1)),
        "rssp has no dimension 'axis'; choose among crank, rod, guide, direction, load, slider_mass, mass_per_length, "
        "speed, sweep, positions",
    ),
    "a number beside a parameter": (
        lambda: loads("parameters: {r: 2 kg, w: 3 r}\nlinks: {a: {mass: r}}"),
        "text:1: parameter 'w': '3 r' has a number beside 'r'; write 3*r",
    ),
    "a parameter named as a unit": (
        lambda: loads("parameters: {m: 2 kg}\nlinks: {a: {mass: m}}"),
        "text:1: parameter 'm': its name is that of a unit; call it otherwise, for example m_1",
    ),
    "a start that is a number": (
        lambda: changed(FOUR_BAR, ("loads:", "start: 3\nloads:")),
        "text:27: start: a start has a position and a speed by drive; write start: {O2: {position: 60 deg, speed: 0}}",
    ),
    "a dwell beyond the turn": (
        lambda: changed(
            FOUR_BAR,
            (MOTION, "law: {over: A2, segments: [{to: 90, in: 360 deg, by: cycloidal}, {dwell: rest}]}"),
        ),
        "text:25: item 2 of segments of law of drive 'O2': the segments fill 360 deg before this dwell: nothing of the "
        "turn is left; leave it out, or shorten the others",
    ),
    "a table times a mass": (
        lambda: changed(
            FOUR_BAR, ("value: 120}", "value: {against: O2, x: [0, 90], y: [1, 2], times: 3 kg}}")
        ),
        "text:29: times of value of load 'T_4': the values times this are not a moment; a pressure times an area is a "
        "force, for example",
    ),
    **{
        f"a motor switched by {off}": (
            partial(
                changed,
                FOUR_BAR,
                (
                    MOTION + "}",
                    f"motor: {{stall: 20, no_load: 10 rad/s, off: {off}}}}}\nstart: {{O2: {{position: 60}}}}",
                ),
            ),
            f"text:25: off of motor of drive 'O2': {shown} says neither when, nor where, nor at which speed; write "
            "0.5 s, 90 deg or 300 rpm",
        )
        for off, shown in (("3 kg", "'3 kg'"), ("[1]", "[1]"))
    },
    **{
        f"a sweep of {build.__name__} to {end}": (
            partial(build, sweep=(0.0, end)),
            f"{build.__name__}: sweep_end is {end}; give a finite value",
        )
        for build in (bennett, rccc, spherical_four_bar)
        for end in (math.inf, math.nan)
    },
    **{
        f"twists {one} and {two} from {start}": (
            partial(bennett, twists=(one, two), start=start),
            f"bennett: twists {one} and {two}, start {start} degrees; give two different twists and a start, all below "
            "180 degrees",
        )
        for one, two, start in ((190, 40, 90), (40, 180, 90), (40, 40, 90), (40, 70, 180))
    },
}
"""What is asked, and the sentence that refuses it."""


@pytest.mark.parametrize("name", REFUSED)
def test_what_says_too_little_is_refused_with_the_remedy(name: str) -> None:
    ask, says = REFUSED[name]
    with pytest.raises(ModelError) as refused:
        ask()
    assert str(refused.value) == says


def test_the_forces_on_a_link_of_an_open_linkage_are_refused_with_its_reason() -> None:
    r = da.solve(da.four_bar().with_values({"links.coupler.points.B.0": 0.01}), positions=2)
    assert r.status[0] == "not_assembled"
    with pytest.raises(AnalysisError) as refused:
        da.wrench.on(r, "coupler", at=1)
    assert str(refused.value) == f"position 1: {r.reasons[0]}"


LACKING: dict[str, tuple[str, Callable[[], Any], str]] = {
    "TOML": (
        "tomli_w",
        lambda: tree_text(da.four_bar().to_tree(), "toml"),
        "TOML is written by the package tomli-w; install it: pip install tomli-w",
    ),
    "casadi": (
        "casadi",
        lambda: da.compile(da.four_bar(), ["links.coupler.mass"], ["effort.O2"]).to_casadi(),
        "casadi is not installed; pip install 'dalembert[fast]'",
    ),
}


@pytest.mark.parametrize("name", LACKING)
def test_a_package_that_lacks_is_named(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    package, ask, says = LACKING[name]
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ModelError) as refused:
        ask()
    assert str(refused.value) == says


def test_stops_of_a_joint_in_space_are_of_its_only_freedom() -> None:
    text = RSSR.replace("C: {type: cylindrical", "C: {type: cylindrical, stops: {from: 1}")
    with pytest.raises(ModelError) as refused:
        loads(text, name="r.yaml")
    assert str(refused.value) == (
        "r.yaml:17: stops of joint 'C': stops are of a joint with one freedom, and this one has slide, turn; let a "
        "drive of that freedom go, and give the stops to the drive"
    )
    with pytest.raises(ModelError) as refused:
        loads(RSSR.replace("A: {type: spherical", "A: {type: spherical, stops: {to: 10 deg}"), name="r.yaml")
    assert (
        refused.value.what
        == "stops of joint 'A': a ball turns about any axis, so no one position of it has stops"
    )


def test_folders_of_sheets_are_made_beside_what_is_there(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "a").write_text("mine")
    for name, says in {
        "none/sheets": f"cannot write {tmp_path}/none/sheets: folder {tmp_path}/none does not exist; create it, or "
        "name another",
        "file": f"{tmp_path}/file is a file; name a folder",
        "full": f"{tmp_path}/full has files; name another folder, or overwrite: --force, in Python overwrite=True",
    }.items():
        with pytest.raises(ModelError) as refused:
            check_new_folder(tmp_path / name, overwrite=False)
        assert str(refused.value) == says
    assert [check_new_folder(tmp_path / name, overwrite=True) for name in ("full", "new")] == [True, False]


def test_a_folder_is_replaced_whole_or_not_at_all(tmp_path: Path) -> None:
    folder = tmp_path / "sheets"
    folder.mkdir()
    (folder / "old").write_text("mine")

    def half() -> None:
        with new_folder(folder) as beside:
            (beside / "new").write_text("half")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        half()
    assert [p.name for p in tmp_path.rglob("*")] == ["sheets", "old"]
    with new_folder(folder) as beside:
        (beside / "new").write_text("whole")
    assert [p.name for p in tmp_path.rglob("*")] == ["sheets", "new"]
