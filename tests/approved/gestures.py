"""What gestures of the studio write: of each the lines that it changes, or the sentence that refuses it."""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable, Iterator
from typing import Any

from dalembert.bundled import examples
from dalembert.errors import ModelError
from dalembert.model.files.rewriting import text_of
from dalembert.studio.document import EMPTY, Document
from dalembert.studio.editing.gestures import gesture
from tests.approved.foreign_files import rounded
from tests.approved.read_out import model

At = tuple[float, float]


def end(place: At | str, d: Document) -> dict[str, Any]:
    """A place, or a point of a link (``link.point``) where it is drawn."""
    if not isinstance(place, str):
        return {"at": place}
    link, _, point = place.partition(".")
    found = next((x for x in d.reading.drawing["links"] if x["name"] == link), {"points": {}})
    return {"at": found["points"].get(point, (0.0, 0.0)), "link": link, "point": point}


def steps(d: Document, asked: list[tuple[str, dict[str, Any]]]) -> Iterator[str]:
    """Each gesture and what it changes; `first`, `second`, `where` and `ends` are places."""
    for op, keys in asked:
        full = {k: end(x, d) if k in ("first", "second", "where") else x for k, x in keys.items()}
        if "ends" in keys:
            full["ends"] = [end(x, d) for x in keys["ends"]]
        before = d.text.splitlines()
        yield f"{op} {json.dumps(keys)}"
        try:
            d.do(gesture({"op": op, **full}))
        except ModelError as error:
            yield f"  refused: {error}"
            assert d.text.splitlines() == before
        changed = difflib.unified_diff(before, d.text.splitlines(), n=0, lineterm="")
        yield from (f"  {line}" for line in changed if line[:3] not in ("---", "+++") and line[:2] != "@@")
        if d.reading.error:
            yield f"  line {d.reading.line}: {d.reading.error}"


def shown(d: Document) -> Iterator[str]:
    """The drawing that a tab gets, a line for each part."""
    for key, value in d.reading.drawing.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            yield f"{key}:"
            yield from (f"  {json.dumps(part)}" for part in value)
        else:
            yield f"{key}: {json.dumps(value)}"


def told(text: str, form: str, asked: list[tuple[str, dict[str, Any]]]) -> Callable[[], str]:
    def made() -> str:
        d = Document(text, form)
        out = list(steps(d, asked))
        return rounded("\n".join([*out, "", d.text, *shown(d)]), 1e-7) + "\n"

    return made


FOUR_BAR: list[tuple[str, dict[str, Any]]] = [
    ("ground", {"where": (0.0, 0.0)}),
    ("ground", {"where": (0.09873, 0.00111), "x": "100", "y": "2,5 mm"}),
    ("ground", {"where": "ground.A"}),
    ("bar", {"ends": ["ground.A", (0.02, 0.03)], "length": "40", "angle": "60"}),
    ("bar", {"ends": ["link2.C", (0.13, 0.08)], "name": "rod"}),
    ("bar", {"ends": ["rod.D", "ground.B"]}),
    ("bar", {"ends": [(0.2, 0.1), (0.2, 0.1)]}),
    ("bar", {"ends": ["rod.D", "rod.D"], "length": "10"}),
    ("point", {"link": "rod", "at": (0.08, 0.12)}),
    ("point", {"link": "rod", "at": (0.08, 0.12), "x": "30", "y": "1 in"}),
    ("point", {"link": "rod", "at": (0.08, 0.12), "y": "-20"}),
    ("point", {"link": "rope", "at": (0.08, 0.12)}),
    ("length", {"link": "rod", "value": "90"}),
    ("length", {"link": "link2", "value": "45 mm"}),
    ("length", {"link": "link2", "value": "0"}),
    ("drive", {"joint": "A", "here": 1.0, "speed": "10"}),
    ("drive", {"joint": "A", "whole_turn": True, "speed": "120 rpm"}),
    ("drive", {"joint": "A", "position": "60"}),
    ("drive", {"joint": "Q"}),
    ("force", {"where": "rod.F", "vector": [30.0, -40.0]}),
    ("force", {"where": "rod.F", "value": "12,5 kN", "angle": "30"}),
    ("force", {"where": "rod.F", "value": "7", "angle": "0.5 rad"}),
    ("force", {"where": "ground.A", "value": "7"}),
    ("couple", {"link": "link3", "value": "3"}),
    ("couple", {"link": "link3"}),
    ("couple", {"link": "ground"}),
    ("spring", {"first": "ground.A", "second": "rod.F"}),
    ("damper", {"first": "ground.A", "second": "rod.F", "value": "5"}),
    ("spring", {"first": "rod.D", "second": "rod.F"}),
    ("move", {"link": "rod", "point": "D", "to": (0.14, 0.07)}),
    ("move", {"link": "rod", "point": "F", "to": (0.09, 0.1)}),
    ("move", {"link": "ground", "point": "B", "to": (0.11, 0.0)}),
    ("move", {"link": "link2", "point": "C", "to": (0.0, 0.05)}),
    ("move", {"link": "link2", "point": "C", "to": (0.0, 0.0)}),
    ("pose", {"links": {"link2": [0.0, 0.0, 1.2]}, "drives": {"A": 1.2}}),
    ("pose", {"links": {"link2": [0.0, 0.0, 1.2]}, "drives": {"A": 9.0}}),
    ("set", {"path": ["drives", "A", "position"], "value": "70 deg"}),
    ("pose", {"links": {"link2": [0.0, 0.0, 1.0]}, "drives": {"A": 1.0}}),
    ("set", {"path": ["links", "rod", "mass"], "value": "1,5"}),
    ("set", {"path": ["links", "rod", "mass"], "value": "1500 g"}),
    ("set", {"path": ["links", "rod", "center"], "value": "[45, 2,5 mm]"}),
    ("set", {"path": ["links", "rod", "mass"], "value": ""}),
    ("set", {"path": ["links", "rod", "center"], "value": None}),
    ("set", {"path": ["loads", "F1", "mass"], "value": "1"}),
    ("changes", {"values": {"links.rod.points.D.0": 0.0912345678912, "assembly.rod": 0.5}}),
    ("rename", {"kind": "links", "name": "rod", "to": "coupler"}),
    ("rename", {"kind": "links", "name": "ground", "to": "frame"}),
    ("rename", {"kind": "links", "name": "rod", "to": "bar"}),
    ("rename", {"kind": "points", "link": "coupler", "name": "D", "to": "Z"}),
    ("rename", {"kind": "points", "link": "coupler", "name": "D", "to": "Y"}),
    ("rename", {"kind": "points", "link": "coupler", "name": "Z", "to": "F"}),
    ("rename", {"kind": "points", "link": "coupler", "name": "F", "to": "P"}),
    ("rename", {"kind": "drives", "name": "A", "to": "motor"}),
    ("rename", {"kind": "joints", "name": "A", "to": "O"}),
    ("rename", {"kind": "joints", "name": "O", "to": "C"}),
    ("rename", {"kind": "loads", "name": "F1", "to": "pull"}),
    ("delete", {"kind": "loads", "name": "T1"}),
    ("delete", {"kind": "loads", "name": "T9"}),
    ("delete", {"kind": "points", "link": "coupler", "name": "Q"}),
    ("delete", {"kind": "points", "link": "coupler", "name": "P"}),
    ("delete", {"kind": "points", "link": "link3", "name": "B"}),
    ("delete", {"kind": "joints", "name": "C"}),
    ("delete", {"kind": "links", "name": "coupler"}),
]
GUIDES: list[tuple[str, dict[str, Any]]] = [
    ("bar", {"ends": [(0.0, 0.0), (0.1, 0.05)]}),
    ("bar", {"ends": [(0.3, 0.0), (0.3, 0.1)]}),
    ("bar", {"ends": [(0.4, 0.0), (0.5, 0.1)]}),
    ("ground", {"where": "link2.A"}),
    ("merge", {"first": "link2.B", "second": "link3.C"}),
    ("merge", {"first": "link2.B", "second": "link3.C"}),
    ("merge", {"first": "link2.B", "second": (0.0, 0.0)}),
    ("merge", {"first": "link2.B", "second": "link2.A"}),
    ("slider", {"where": "link3.D", "direction": 0.3}),
    ("slider", {"where": "link3.D", "guide": "link3"}),
    ("slider", {"where": (0.3, 0.1), "guide": "link4"}),
    ("slider", {"where": "link3.D", "guide": "rail"}),
    ("slide", {"where": "link4.F", "angle": "90"}),
    ("slide", {"where": "link4.F", "guide": "link2", "direction": 0.0}),
    ("point", {"link": "link4", "at": (0.45, 0.0)}),
    ("slot", {"where": "link2.B", "guide": "link4", "direction": 0.7}),
    ("bar", {"ends": [(0.6, 0.0), (0.7, 0.0)], "name": "wheel"}),
    ("bar", {"ends": [(0.6, 0.2), (0.8, 0.2)], "name": "other"}),
    ("gear", {"first": "wheel.O", "second": "other.Q", "ratio": 3.0}),
    ("gear", {"first": "wheel.O", "second": "wheel.P"}),
    ("drive", {"joint": "M", "here": 0.1, "freedom": "slide", "speed": "2 mm/s"}),
    ("drive", {"joint": "M", "here": 0.1, "freedom": "slide", "whole_turn": True}),
    ("drive", {"joint": "H", "here": 0.0123456789, "position": ""}),
    ("pose", {"links": {"link3": [0.1, 0.05, 1.5]}, "drives": {"H": 0.0213456789, "M": 0.2}}),
    ("drive", {"joint": "H", "position": "12 mm"}),
    ("pose", {"links": {"link3": [0.1, 0.05, 1.4]}, "drives": {"H": 0.0313456789}}),
    ("delete", {"kind": "drives", "name": "M"}),
    ("delete", {"kind": "drives", "name": "H"}),
]
JOINS: list[tuple[str, dict[str, Any]]] = [
    ("bar", {"ends": [(0.0, 0.0), (0.1, 0.0)], "name": "crank"}),
    ("ground", {"where": "crank.A"}),
    ("bar", {"ends": ["crank.B", (0.1, 0.1)], "name": "arm"}),
    ("bar", {"ends": [(0.3, 0.0), (0.35, 0.0)], "name": "wheel"}),
    ("ground", {"where": "wheel.D"}),
    ("ground", {"where": (0.3, 0.3)}),
    ("belt", {"first": "crank.A", "second": "wheel.D"}),
    ("delete", {"kind": "joints", "name": "H"}),
    ("belt", {"first": "crank.A", "second": "crank.B"}),
    ("belt", {"first": "crank.A", "second": "ground.A"}),
    ("cam", {"first": "wheel.D", "second": "arm.C"}),
    ("bar", {"ends": [(0.6, 0.1), (0.7, 0.2)], "name": "follower"}),
    ("ground", {"where": "follower.H"}),
    ("cam", {"first": "wheel.D", "second": "follower.I"}),
    ("delete", {"kind": "joints", "name": "J"}),
    ("bar", {"ends": [(0.2, 0.4), (0.2, 0.5)], "name": "tappet"}),
    ("slide", {"where": "tappet.J", "direction": 1.5707963}),
    ("cam", {"first": "crank.A", "second": "tappet.J"}),
    ("delete", {"kind": "joints", "name": "M"}),
    ("circular_slot", {"first": "arm.C", "second": "wheel.F"}),
    ("delete", {"kind": "joints", "name": "M"}),
    ("rolling", {"first": "wheel.F", "second": "tappet.K"}),
    ("delete", {"kind": "joints", "name": "M"}),
    ("weld", {"first": "crank.B", "second": "arm.B"}),
    ("weld", {"first": "crank.B", "second": (0.0, 0.0)}),
    ("cylinder", {"first": "ground.G", "second": "arm.C"}),
    ("pose", {"links": {"crank": [0.0, 0.0, 0.1]}, "drives": {"cylinder1": 0.25}}),
    ("delete", {"kind": "drives", "name": "cylinder1"}),
    ("cylinder", {"first": "ground.G", "second": "arm.C", "value": "2 in"}),
    ("delete", {"kind": "drives", "name": "cylinder1"}),
    ("spring", {"first": "ground.G", "second": "arm.C"}),
    ("damper", {"first": "ground.G", "second": "arm.C"}),
    ("rename", {"kind": "links", "name": "arm", "to": "lever"}),
    ("delete", {"kind": "points", "link": "lever", "name": "C"}),
    ("set", {"path": ["links", "follower", "points", "I", 1], "value": "-20"}),
    ("move", {"link": "follower", "point": "I", "to": (0.65, 0.2)}),
    ("set", {"path": ["parameters", "long"], "value": "100"}),
    ("set", {"path": ["links", "crank", "points", "B"], "value": ["long", 0]}),
    ("set", {"path": ["links", "crank", "points", "B", 0], "value": "long"}),
    ("move", {"link": "crank", "point": "B", "to": (0.11, 0.0)}),
]
RENAMES: list[tuple[str, dict[str, Any]]] = [
    ("rename", {"kind": "points", "link": "coupler", "name": "A", "to": "A2"}),
    ("rename", {"kind": "joints", "name": "B", "to": "knee"}),
    ("rename", {"kind": "joints", "name": "O2", "to": "motor"}),
    ("rename", {"kind": "loads", "name": "F_P", "to": "push"}),
    ("rename", {"kind": "links", "name": "rocker", "to": "lever"}),
    ("rename", {"kind": "points", "link": "lever", "name": "B", "to": "end"}),
    ("set", {"path": ["links", "crank", "mass"], "value": "2"}),
    ("couple", {"link": "crank", "value": "4"}),
    ("delete", {"kind": "links", "name": "coupler"}),
]
BLOCKS = """links:
  ground:
    points: {A: [0, 0], D: [1, 0]}
  crank:
    points: {A: [0, 0], B: [0.3, 0]}
  rod:
    points: {B: [0, 0], C: [1, 0]}
  lever:
    points: {D: [0, 0], C: [0.8, 0]}
joints:
  A:
    type: pin
    links: [ground, crank]
  B:
    type: pin
    links: [crank, rod]  # the crank's end
  C:
    type: pin
    links: [rod, lever]
  D:
    type: pin
    links: [ground, lever]
drives:
  A: {position: 60 deg, speed: 2 rad/s}
loads:
  T: {type: couple, on: lever, value: 3 + 2*sin(A) - angle.lever}
  K: {type: spring, between: [ground.D, rod.C], stiffness: 100, free_length: 0.2}
assembly: {rod: 20 deg, lever: 70 deg}
answers:
  - {quantity: effort, of: A, value: 1 N*m}
  - {quantity: reaction, of: C, on: lever, value: [1 N, 2 N]}
"""
IN_BLOCKS: list[tuple[str, dict[str, Any]]] = [
    ("rename", {"kind": "points", "link": "rod", "name": "B", "to": "tip"}),
    ("rename", {"kind": "points", "link": "rod", "name": "C", "to": "end"}),
    ("rename", {"kind": "joints", "name": "D", "to": "fulcrum"}),
    ("rename", {"kind": "joints", "name": "A", "to": "motor"}),
    ("rename", {"kind": "links", "name": "lever", "to": "rocker"}),
    ("rename", {"kind": "links", "name": "rod", "to": "coupler"}),
    ("delete", {"kind": "joints", "name": "C"}),
    ("delete", {"kind": "links", "name": "coupler"}),
    ("delete", {"kind": "drives", "name": "motor"}),
]


def saved(form: str) -> str:
    """The four-bar of the examples in a form."""
    return text_of(model("four_bar"), form)


LOADED = """links:
  ground: {points: {A: [0, 0], D: [1 m, 0]}}
  crank: {points: {A: [0, 0], B: [0.3 m, 0]}, mass: 2 kg, center: [0.1 m, 0]}
  rod: {points: {B: [0, 0], C: [1 m, 0]}, mass: 3 kg, center: [0.5 m, 0.1 m]}
  lever: {points: {D: [0, 0], C: [0.8 m, 0]}}
joints:
  A: {type: pin, links: [ground, crank]}
  B: {type: pin, links: [crank, rod]}
  C: {type: pin, links: [rod, lever]}
  D: {type: pin, links: [ground, lever]}
drives: {A: {position: 60 deg}}
loads:
  wound: {type: torsion_spring, joint: D, stiffness: 3 N*m/rad}
  K: {type: spring, between: [ground.D, rod.C], stiffness: 100 N/m, free_length: 0.2 m}
  F: {type: force, on: rod, at: C, value: 5 N @ 30 deg, axes: link}
  G: {type: force, on: rod, at: center, value: [3 N, -4 N]}
  H: {type: force, on: lever, at: [0.4 m, 0], value: unknown, direction: 90 deg}
  P: {type: force, on: lever, at: C, value: "3*sin(A)", direction: 45 deg}
assembly: {rod: 20 deg, lever: 70 deg}
"""


def drawn(text: str) -> Callable[[], str]:
    """What a tab draws of a text."""
    return lambda: rounded("\n".join(shown(Document(text))), 1e-7) + "\n"


def bundled(name: str) -> str:
    return examples()[name].read_text(encoding="utf-8")


GESTURES = {
    "drawn-loads": drawn(LOADED),
    "drawn-gear-train": lambda: drawn(bundled("gear_train"))(),
    "drawn-in-space": lambda: drawn(bundled("rssr"))(),
    "gestures-four-bar": told(EMPTY, "yaml", FOUR_BAR),
    "gestures-guides": told(EMPTY, "yaml", GUIDES),
    "gestures-joins": told(EMPTY, "yaml", JOINS),
    "gestures-blocks": told(BLOCKS, "yaml", IN_BLOCKS),
    **{
        f"gestures-{form}": (lambda form=form: told(saved(form), form, RENAMES)())
        for form in ("json", "toml")
    },
}
