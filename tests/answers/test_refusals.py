"""What an answer is asked in vain: the sentence says what is wrong, and what there is."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import gettempdir, mkdtemp
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.errors import ModelError
from dalembert.grading.marking.key import read_key
from dalembert.grading.marking.rubric import read_rubric
from dalembert.model.library import template


@cache
def at(name: str, positions: int = 3) -> Any:
    """A template, an example or a case, at some positions."""
    if name in (some := cases() | examples()):
        return da.solve(da.load(some[name]))
    return da.solve(template(name), positions=positions)


def changed(name: str, **values: Any) -> da.Mechanism:
    return template(name).with_values({key.replace("__", "."): value for key, value in values.items()})


@cache
def compiled(**options: Any) -> Any:
    return da.compile(da.four_bar(), ["links.coupler.mass"], ["effort.O2"], **options)([[1.0], [2.0]])


def with_friction(friction: dict[str, Any]) -> da.Mechanism:
    """A slider-crank whose guide rubs."""
    tree = da.slider_crank().to_tree()
    tree["joints"]["guide"]["friction"] = friction
    return da.mechanism(tree)


def with_assembly(m: da.Mechanism, near: dict[str, Any]) -> da.Mechanism:
    return da.mechanism(m.to_tree() | {"assembly": near})


def keyed(text: str) -> Path:
    path = Path(mkdtemp()) / "key.json"
    path.write_text(text, encoding="utf-8")
    return path


EFFORT = {"quantity": "effort", "of": "O2", "value": 243.2376, "unit": "lbf*in"}


def in_folder(files: dict[str, str]) -> Path:
    """A new folder with files."""
    folder = Path(mkdtemp())
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def class_table(decisions: str | None = None, **more: Any) -> Any:
    """The marks of two students by a table, with cells decided by a second one."""
    folder = in_folder({"class.csv": "student,effort.O2\nAnn,243.2\nBo,1\n", "read.csv": decisions or ""})
    decide = None if decisions is None else folder / (decisions if decisions == "read.xlsx" else "read.csv")
    return da.grade(folder / "class.csv", [EFFORT], decide=decide, **more)


def checked(**keys: Any) -> Any:
    return da.check_answers(at(BAR).mechanism, [da.Answer(**keys)])


RUBS, BAR, BEAM = "seed-002-7a-engine-friction-circles", "four_bar", "st-09-beam-on-a-strut"
REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "an unknown interval": (
        lambda: at("seed-002-7d-engine-at-rest").interval("guide"),
        "'guide' is not an unknown effort or load; the unknowns are O",
    ),
    "bearings without friction": (
        lambda: da.friction_circles(at("slider_crank"), "A"),
        "this result has no friction; give a joint `friction`, and do not switch it off",
    ),
    "efficiency without friction": (
        lambda: da.efficiency(at("slider_crank")),
        "this result has no friction; give a joint `friction`, and do not switch it off",
    ),
    "a brake of an unknown joint": (
        lambda: at("block_brake").brake("linning"),
        "unknown joint 'linning'; did you mean 'lining'?",
    ),
    "a brake of a pin": (
        lambda: at("block_brake").brake("L"),
        "joint 'L' is a pin, not a brake or clutch; choose among lining",
    ),
    "a brake of a machine without": (
        lambda: at(BAR).brake("A"),
        "joint 'A' is a pin, not a brake or clutch; add a shoe, band or disc",
    ),
    "a belt of a pin": (lambda: at("belt_drive").belt("bell"), "'bell' is not a belt; did you mean 'belt'?"),
    "a belt of a machine without": (
        lambda: at(BAR).belt("A"),
        "'A' is not a belt; add a joint of type: belt",
    ),
    "a contact of a pin": (
        lambda: at("disc_cam").contact("O"),
        "the contact of joint 'O' both pushes and pulls; choose among F",
    ),
    "a rope of a joint": (lambda: at("hoist").rope("ropes"), "'ropes' is not a rope; did you mean 'rope'?"),
    "a rope of a machine without": (
        lambda: at(BAR).rope("A"),
        "'A' is not a rope; add a joint of type: rope",
    ),
    "a clutch of a joint": (
        lambda: at("ratchet").one_way("A"),
        "joint 'A' is neither a one-way clutch nor a ratchet; the only one is 'K'",
    ),
    "a clutch of a machine without": (
        lambda: at(BAR).one_way("A"),
        "joint 'A' is neither a one-way clutch nor a ratchet; write type: one_way",
    ),
    "a screw of a drive": (
        lambda: at("screw_jack").screw("lifts"),
        "drive 'lifts' has no screw; the only one is 'S'",
    ),
    "a screw of a machine without": (
        lambda: at(BAR).screw("O2"),
        "drive 'O2' has no screw; write screw: {...} of a drive that slides",
    ),
    "a contact of a joint that holds": (
        lambda: at(BAR).contact("A"),
        "the contact of joint 'A' both pushes and pulls; write contact: pushes",
    ),
    "a contact of an unknown joint": (
        lambda: at("disc_cam").contact("x"),
        "unknown joint 'x'; the only one is 'F'",
    ),
    "an unknown link": (
        lambda: at(BAR).position("coupled"),
        "unknown link 'coupled'; choose among crank, coupler, rocker",
    ),
    "an unknown quantity": (
        lambda: at(BAR)["efforts.O2"],
        "unknown quantity 'efforts.O2'; did you mean 'effort.O2'?",
    ),
    "an unknown effort": (lambda: at(BAR).effort("O4"), "unknown drive 'O4'; choose among O2"),
    "a joint on another link": (
        lambda: at(BAR).reaction("A", on="rocker"),
        "joint 'A' does not act on 'rocker'; it joins crank and coupler",
    ),
    "unknown axes": (
        lambda: at(BAR).reaction("A", axes="links"),
        "unknown axes 'links'; did you mean 'link'?",
    ),
    "an unknown freedom": (
        lambda: at(BAR).freedom("A", "slide"),
        "joint 'A' has no freedom 'slide'; there is: turn of A",
    ),
    "a freedom of an unknown joint": (
        lambda: at(BAR).freedom("Q", "turn"),
        "joint 'Q' has no freedom 'turn'; there is: no such joint, or none free",
    ),
    "a transmission angle": (
        lambda: at("slider_crank")["transmission.O2"],
        "unknown quantity 'transmission.O2'; did you mean 'transmission.B'?",
    ),
    "a position beyond the last": (
        lambda: da.draw.mechanism(at(BAR), at=9),
        "position 9 does not exist; this result has 1 position, numbered from 1",
    ),
    "superposition with friction": (
        lambda: da.superposition(at(RUBS)),
        (
            "superposition is refused: with dry friction the forces do not add, because it depends on "
            "|F|; leave friction out with --no-friction, or use --method matrix"
        ),
    ),
    "lifting what is in space": (
        lambda: da.lifted(da.rssr()),
        "the mechanism is already in space; lift a planar one",
    ),
    "lifting to another pin": (
        lambda: da.lifted(da.four_bar(), become={"A": "screw"}),
        "a pin cannot become 'screw'; write cylindrical or spherical",
    ),
    "drawing an unknown link": (
        lambda: da.draw.free_body(at(BAR), "coupled"),
        "unknown link 'coupled'; did you mean 'coupler'?",
    ),
    "drawing an unknown joint": (
        lambda: da.draw.joint("pinn"),
        (
            "unknown joint 'pinn' in space; choose among weld, revolute, prismatic, screw, "
            "cylindrical, universal, spherical, plane, sphere_between_planes, sphere_in_cylinder, "
            "cylinder_between_planes, slotted_sphere, ..."
        ),
    ),
    "a theme": (
        lambda: da.draw.mechanism(at(BAR)).save("x.svg", theme="drak"),
        "unknown theme 'drak'; choose light or dark or print",
    ),
    "an ending of a drawing": (
        lambda: da.draw.mechanism(at(BAR)).save("x.jpg"),
        "x.jpg: drawings are not written as .jpg; use .svg, .pdf, .png or .dxf",
    ),
    "an ending of an animation": (
        lambda: da.draw.animation(at(BAR)).save("x.mp4"),
        "an animation needs two positions; ask for more: positions=36, or --positions 36",
    ),
    "a solid without a position": (
        lambda: da.draw.solid_model(da.solve(changed(BAR, links__coupler__points__B__0=0.01), positions=2)),
        "no position has a pose to show; see the reasons: dalembert solve",
    ),
    "derivatives that were not compiled": (
        lambda: compiled().gradient("effort.O2"),
        "no derivatives were compiled; compile with derivatives=True",
    ),
    "an unknown joint of a batch": (
        lambda: compiled().reaction("Q"),
        "unknown joint 'Q'; the joints are O2, A, B, O4",
    ),
    "positions that vary": (
        lambda: da.compile(da.four_bar(), ["drives.O2.position"], ["effort.O2"]),
        (
            "'drives.O2.position' cannot vary from design to design; give the positions when you call "
            "the kernel"
        ),
    ),
    "a word that varies": (
        lambda: da.compile(da.four_bar(), ["joints.A.type"], ["effort.O2"]),
        "'joints.A.type' is 'pin', not a number; give it a number in the description first",
    ),
    "a name of a C function": (
        lambda: da.compile(da.four_bar(), []).to_c("2nd"),
        "'2nd' is not a valid name for a C function; use letters, digits and single _, a letter first",
    ),
    "C of a reduced analysis": (
        lambda: da.compile(da.four_bar(), [], ["effort.O2"], reduce="peak").to_c(),
        "a reduced analysis cannot be exported; compile it without reduce",
    ),
    "lifting a spherical pin that is driven": (
        lambda: da.lifted(da.four_bar(), become={"O2": "spherical"}),
        "the turn of joint 'O2' is driven or damped; make it cylindrical",
    ),
    "lifting faces of a guide": (
        lambda: da.lifted(with_friction({"coefficient": 0.1, "half_height": 0.01})),
        "the faces of guide 'guide' make a couple, which is not lifted; leave half_height out",
    ),
    "lifting a constant friction": (
        lambda: da.lifted(with_friction({"force": 3.0})),
        "the constant friction of guide 'guide' is not lifted; leave force out",
    ),
    "lifting a brake": (
        lambda: da.lifted(template("block_brake")),
        (
            "joint 'lining': a shoe joint has no counterpart that could be lifted; lift a mechanism of "
            "pins, sliders, slots, welds and gears"
        ),
    ),
    "an effort that is given too": (
        lambda: da.solve(changed(BAR, drives__O2__effort=3.0)),
        (
            "1 drive effort is given but no load is unknown; make 1 load unknown (`value: unknown` "
            "with a direction) or leave the efforts out"
        ),
    ),
    "a pose of a link in space": (
        lambda: da.solve(with_assembly(da.four_bar(), {"coupler": {"angle": 1}})),
        (
            "assembly gives link 'coupler' a pose in space, but the mechanism is planar; give an "
            "angle, or [x, y, angle]"
        ),
    ),
    "an angle of a link in space": (
        lambda: da.solve(with_assembly(da.rssr(), {"rod": 30})),
        (
            "assembly gives link 'rod' a planar pose, but the mechanism is in space; write {position: "
            "[0, 0, 0], axis: [0, 0, 1], angle: 30 deg}"
        ),
    ),
    "a file of marks that is no list": (
        lambda: read_key(keyed("{")),
        "key.json:1: the key is not JSON; write a list of figures",
    ),
    "a file of marks with words": (
        lambda: read_key(keyed('["effort"]')),
        "'effort' is not a figure of the key; write its quantity",
    ),
    "marks that are no mapping": (
        lambda: read_rubric([1, 2], None),
        "the rubric is not a mapping; write marks: {effort: 4, reaction: 2}",
    ),
    "a class that is nowhere": (
        lambda: da.grade(in_folder({}) / "class", [EFFORT]),
        "class: file not found; name a folder of answers, or a table",
    ),
    "a workbook that is nowhere": (
        lambda: da.grade(in_folder({}) / "class.xlsx", [EFFORT]),
        "class.xlsx: file not found; name a folder of answers, or a table",
    ),
    "cells decided in a workbook that is nowhere": (
        lambda: class_table(decisions="read.xlsx"),
        "read.xlsx: file not found; name a table (.csv, .xlsx)",
    ),
    "cells decided in a table without rows": (
        lambda: class_table(""),
        "read.csv:1: the table has no rows; write a heading and one row per figure",
    ),
    "a class without sheets": (
        lambda: da.grade(in_folder({"notes.txt": "", ".hidden.csv": ""}), [EFFORT]),
        "FOLDER has no answer files; their names end in .yaml, .yml, .json, .toml, .csv, .xlsx",
    ),
    "a workbook that is none": (
        lambda: da.grade(in_folder({"class.xlsx": "student"}) / "class.xlsx", [EFFORT]),
        "class.xlsx: the file is not a workbook; save it as .xlsx or CSV",
    ),
    "a decision without its value": (
        lambda: class_table("student,figure\nAnn,effort.O2\n"),
        "read.csv:2: the row has no value; the columns are student, figure and value",
    ),
    "a decision on an unknown student": (
        lambda: class_table("student,figure,value\nAn,effort.O2,3\n"),
        "read.csv:2: unknown student 'An'; there are Ann, Bo",
    ),
    "a decision on an unknown figure": (
        lambda: class_table("student,figure,value\nAnn,effort.O2,3\nAnn,effort.O,3\n"),
        "read.csv:3: unknown figure 'effort.O' on the sheet of Ann; there are effort.O2",
    ),
    "a column that is not in the table": (
        lambda: class_table(columns={"Answer 1": "effort.O2"}),
        "class.csv:1: unknown column 'Answer 1'; the columns are 'student', 'effort.O2'",
    ),
    "a variant of two files": (
        lambda: read_key(
            [EFFORT | {"variant": v, "file": f} for v, f in (("1", "a.yaml"), ("01", "b.yaml"))]
        ),
        "the key:2: variant '01' has two files; it had 'a.yaml'",
    ),
    "a tolerance below nothing": (
        lambda: checked(quantity="effort", of="O2", value="3 N*m", tolerance="-1 N*m"),
        "'-1 N*m' is below 0; write one of 0 or more, for example 3 %",
    ),
    "the energy that a flywheel stores at no drive": (
        lambda: checked(quantity="energy_fluctuation", of="O4", value="3 J"),
        "unknown drive 'O4'; the only one is 'O2'",
    ),
    "a figure at a position of a structure": (
        lambda: da.check_answers(
            da.load(cases()[BEAM]), [da.Answer(quantity="reaction", of="A", value="3 N", at="2 m")]
        ),
        "the mechanism has no drive to name a position by; number the position: at: 1",
    ),
    "marks of no number": (
        lambda: read_rubric({"marks": 4}, None),
        "marks is not a mapping; write marks: {NAME: NUMBER}",
    ),
}
"""What is asked, and the sentence that refuses it."""


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_asked_in_vain_is_told_why(name: str) -> None:
    ask, says = REFUSED[name]
    with pytest.raises(ModelError) as refused:
        ask()
    said = re.sub(rf"{gettempdir()}/\w+/", "", str(refused.value))
    assert re.sub(rf"{gettempdir()}/\w+", "FOLDER", said) == says
