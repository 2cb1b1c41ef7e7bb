"""Share links of PMKS+, and the text of the first PMKS, as plane linkages.

A link holds numbers in base 64 with three decimals; its last character is a checksum of the length.
"""

from __future__ import annotations

import json
import math
import re
from itertools import takewhile

from dalembert.errors import ModelError
from dalembert.interchange.link_graph import plain_name
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint, SketchMass
from dalembert.model import GROUND

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
SLIDER, INPUT, FIXED, WELDED = range(4)
"""Bits of a joint's flags."""

UNITS = {"0": 0.0254, "1": 0.01, "2": 1.0}
"""Unit of length of a link: inch, centimetre, metre."""

FORCES = {"0": (4.4482216152605, 0.45359237), "1": (1.0, 1.0)}
"""Unit of force of a link, and of mass: lbf and lbm, N and kg."""

LONGEST = 20_000
"""Characters of a link."""


def whole(text: str) -> int:
    """An integer of base 64; a leading 0 is the minus sign.

    >>> whole("10"), whole("0A"), whole("0")
    (64, -10, 0)
    """
    sign = -1 if text[:1] == "0" else 1
    value = 0
    for letter in text.removeprefix("0"):
        value = 64 * value + DIGITS.index(letter)
    return sign * value


def decimal(text: str) -> float:
    """A number with three decimals."""
    return whole(text) / 1000


def bits(letter: str, count: int) -> list[bool]:
    """Flags of one character, the first the lowest bit."""
    value = DIGITS.index(letter)
    return [bool(value >> k & 1) for k in range(count)]


def read_pmks(content: bytes, file: str) -> PlaneSketch:
    """The linkage of a file with one PMKS+ link, or with the text of the first PMKS (`ground,input,R,100,100,...`)."""
    text = content.decode("utf-8", "replace").strip()
    links = re.findall(r"\?([0-9A-Za-z_\-.,]+)", text)
    try:
        if text.startswith("{"):
            return _first_json(text)
        if "\nground," in f"\n{text}" or text.startswith("mech="):
            return _first_pmks(text)
        if len(links) != 1:
            what = f"the file has {len(links)} links of PMKS+"
            one = "give one: app.pmksplus.com/?...; the name of a model file ends with .yaml, .json or .toml"
            raise ModelError(what, one, (), file, 1)
        if len(links[0]) > LONGEST:
            what = f"the link of PMKS+ has more than {LONGEST} characters"
            raise ModelError(what, "leave joints out", (), file, 1)
        return _link(links[0].strip())
    except ModelError as error:
        raise error if error.file else error.at_line(file, error.line or 1) from None
    except (ValueError, IndexError, KeyError, TypeError, StopIteration) as error:
        raise ModelError(
            f"the linkage of PMKS is not complete: {error}", "copy all of it", (), file, 1
        ) from None


def _groups(text: str) -> tuple[list[str], list[list[str]]]:
    """Head of a link, and its groups: joints, links, forces."""
    *head, rest = text[:-1].split(".", 4)
    groups: list[list[str]] = [[]]
    for part in rest.split("."):
        if part == "":
            groups.append([])
        else:
            groups[-1].append(part)
    return head, [*groups, [], [], []][:3]


def _link(text: str) -> PlaneSketch:
    head, (joints, links, forces) = _groups(text)
    clockwise, has_gravity = bits(head[0][-1], 2)
    rpm = whole(head[2].split(",")[0])
    sketch = PlaneSketch("PMKS+ linkage", gravity=has_gravity)
    length, force, mass_unit = UNITS[head[3][0]], *FORCES[head[3][2:3] or "1"]
    sketch.lost.append(f"coordinates of a link are rounded to 0.001 of its unit, {1e5 * length:.3g} um")
    members: dict[str, list[str]] = {}
    for part in links:
        key, name, mass, inertia, x, y, *rest = part[2:].split(",")
        link = plain_name(name or key, sketch.masses)
        members[link] = [*takewhile(bool, rest[1:])]
        sketch.masses[link] = SketchMass(
            decimal(mass) * mass_unit,
            decimal(inertia) * mass_unit * length**2,
            decimal(x) * length,
            decimal(y) * length,
        )
    if any(m.mass == mass_unit for m in sketch.masses.values()):
        sketch.lost.append("masses and inertias of 1 may be ones that nobody set")
    for part in joints:
        flags = bits(part[0], 5)
        key, name, x, y, angle = part[1:].split(",")[:5]
        on = ([GROUND] if flags[FIXED] else []) + [link for link, ends in members.items() if key in ends]
        joint = SketchJoint(plain_name(name or key, {}), decimal(x) * length, decimal(y) * length, on)
        if flags[SLIDER]:
            joint.slides_along = decimal(angle)
        if flags[INPUT]:
            unit = length if flags[SLIDER] else math.pi / 30
            joint.speed = (-1 if clockwise else 1) * rpm * unit
        if flags[WELDED]:
            raise ModelError(f"joint {name!r} is welded", "join its links into one in PMKS+")
        sketch.joints.append(joint)
    for part in forces:
        rows = part[1:].split(",")
        if len(rows) < 8:
            continue
        x0, y0, x1, y1, size = map(decimal, rows[3:8])
        arrow = math.hypot(x1 - x0, y1 - y0)
        keys = set(rows[1])
        on_link = rows[1] if rows[1] in members else next(n for n, its in members.items() if keys <= set(its))
        fx, fy = (size * force * d / arrow if arrow else 0.0 for d in (x1 - x0, y1 - y0))
        sketch.forces[plain_name(rows[2], sketch.forces)] = (on_link, x0 * length, y0 * length, fx, fy)
    return sketch


def _first_json(text: str) -> PlaneSketch:
    """The file of the first PMKS: joints with X, Y, TypeOfJoint, Angle (degrees), Links; the driven one; its rpm."""
    tree = json.loads(text)
    sketch = PlaneSketch(str(tree.get("Name", "PMKS linkage")))
    sketch.lost.append("lengths have no unit in the file: taken as metres")
    for number, part in enumerate(tree["Joints"]):
        kind, x, y = part["TypeOfJoint"], float(part["X"]), float(part["Y"])
        if kind not in ("R", "P"):
            raise ValueError(f"a joint {kind} has no counterpart here; use R and P")
        on = sorted((_link_name(str(link)) for link in part["Links"]), key=lambda link: link != GROUND)
        joint = SketchJoint(f"J{number + 1}", x, y, on)
        joint.slides_along = math.radians(float(part["Angle"])) if kind == "P" else None
        sketch.joints.append(joint)
    sketch.joints[int(tree.get("DrivingIndex", 0))].speed = float(tree.get("InputSpeed", 0.0)) * math.pi / 30
    return sketch


def _link_name(text: str) -> str:
    return GROUND if text == GROUND else plain_name(text, {})


def _first_pmks(text: str) -> PlaneSketch:
    """Lines `link,link,R,x,y[,angle],flags` of the first PMKS; the first joint is driven."""
    sketch = PlaneSketch("PMKS linkage")
    sketch.lost.append("lengths have no unit in the file: taken as metres")
    for number, line in enumerate(text.splitlines(), 1):
        words = [word.strip() for word in line.split(",")]
        kind = next((k for k, word in enumerate(words) if word in ("R", "P", "RP", "G")), None)
        if kind is None:
            continue
        if words[kind] not in ("R", "P"):
            raise ModelError(f"a joint {words[kind]} has no counterpart", "use R and P", line=number)
        x, y, angle = (float(word) for word in [*words[kind + 1 :], "0"][:3] if not word.isalpha())
        on = sorted((_link_name(word) for word in words[:kind]), key=lambda w: w != GROUND)
        joint = SketchJoint(f"J{len(sketch.joints) + 1}", x, y, on, line=number)
        joint.slides_along = math.radians(angle) if words[kind] == "P" else None
        sketch.joints.append(joint)
    if sketch.joints:
        sketch.joints[0].speed = 0.0
    return sketch
