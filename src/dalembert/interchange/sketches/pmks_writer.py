"""Share links of PMKS+ from a plane mechanism of pins and sliders on the ground."""

from __future__ import annotations

import math
import string

from dalembert.errors import ModelError
from dalembert.interchange.sketches.drawn_sketch import sketch_of, sliding_blocks
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, SketchJoint
from dalembert.interchange.sketches.pmks_links import DIGITS, FIXED, INPUT, SLIDER
from dalembert.model import GROUND, Mechanism

ADDRESS = "app.pmksplus.com/?"
KEYS = string.ascii_uppercase + string.ascii_lowercase
"""Keys of joints, one letter each; a link's key is those of its joints."""

CHECKS = string.digits + string.ascii_uppercase + string.ascii_lowercase
CENTIMETRES_NEWTONS = "101"
"""Units of length, angle and force."""

COLOURS = ("c5cae9", "303e9f", "0d125a", "b2dfdb", "26a69a", "00695c")


def digits_of(number: float) -> str:
    """An integer, rounded, in base 64; a leading 0 is the minus sign.

    >>> digits_of(64), digits_of(-10.2), digits_of(0)
    ('10', '0A', '0')
    """
    value = abs(round(number))
    text = ""
    while value or not text:
        value, digit = divmod(value, 64)
        text = DIGITS[digit] + text
    return f"0{text}" if round(number) < 0 else text


def write_pmks(m: Mechanism) -> tuple[bytes, list[str]]:
    """A file with one share link, and what of the mechanism is not in it."""
    sketch = sketch_of(m, "PMKS+")
    if len(sketch.joints) > len(KEYS):
        raise ModelError(
            f"a link of PMKS+ holds {len(KEYS)} joints, not {len(sketch.joints)}", "leave some out"
        )
    driven = [joint for joint in sketch.joints if joint.speed is not None]
    if len(driven) > 1:
        sketch.lost.append("all drives but the first: PMKS+ has one")
    speed = driven[0].speed or 0.0 if driven else 0.0
    turns = driven and driven[0].slides_along is None
    rpm = abs(speed) * 30 / math.pi if turns else abs(speed) * 100
    if abs(rpm - round(rpm)) > 1e-9:
        sketch.lost.append(f"speed {rpm:.6g} {'rpm' if turns else 'cm/s'}: PMKS+ has whole numbers")
    flags = DIGITS[(speed < 0) + 2 * sketch.gravity + 8 + 16]
    head = f"0{flags}.{thousandths(1.0)}.{digits_of(rpm)},0.{CENTIMETRES_NEWTONS}."
    keys = {joint.name: KEYS[k] for k, joint in enumerate(sketch.joints)}
    joints = "".join(f"{_joint(joint, keys, driven[:1])}." for joint in sketch.joints)
    links = "".join(f"{text}." for text in _links(sketch, keys))
    text = f"{head}{joints}.{links}.{_forces(sketch, keys)}.N"
    sketch.lost.append(
        "coordinates, masses and forces beyond 0.01 mm, 1 g and 0.001 N: a link of PMKS+ is rounded"
    )
    return f"{ADDRESS}{text}{CHECKS[len(text) % len(CHECKS)]}\n".encode(), sketch.lost


def thousandths(number: float) -> str:
    """A number with three decimals."""
    return digits_of(number * 1000)


def _name(text: str) -> str:
    return text.replace(",", "_").replace(".", "_")


def _joint(joint: SketchJoint, keys: dict[str, str], driven: list[SketchJoint]) -> str:
    flags = 0
    for bit, is_set in {
        SLIDER: joint.slides_along is not None,
        INPUT: joint in driven,
        FIXED: GROUND in joint.links,
    }.items():
        flags |= is_set << bit
    place = f"{thousandths(joint.x * 100)},{thousandths(joint.y * 100)}"
    angle = math.remainder(joint.slides_along or 0.0, 2 * math.pi)
    return f"{DIGITS[flags]}{keys[joint.name]},{_name(joint.name)},{place},{thousandths(angle)}"


def _links(sketch: PlaneSketch, keys: dict[str, str]) -> list[str]:
    """Real links, and pistons: links of a pin and a slider at one place."""
    out, blocks = [], sliding_blocks(sketch, "PMKS+")
    for number, (link, mass) in enumerate(sketch.masses.items()):
        kind, colour = ("P", "") if link in blocks else ("R", COLOURS[number % len(COLOURS)])
        key = "".join(keys[joint.name] for joint in sketch.joints if link in joint.links)
        numbers = (mass.mass, mass.inertia * 1e4, mass.x * 100, mass.y * 100)
        values = ",".join(map(thousandths, numbers))
        out.append(f"Y{kind}{key},{_name(link)},{values},{colour},{','.join(key)},,")
    return out


def _forces(sketch: PlaneSketch, keys: dict[str, str]) -> str:
    """Forces, each as an arrow as long as the linkage, so that its direction is kept."""
    size = max((abs(c) for joint in sketch.joints for c in (joint.x, joint.y)), default=0.0) or 1.0
    out = ""
    for number, (name, (link, x, y, fx, fy)) in enumerate(sketch.forces.items(), 1):
        value = math.hypot(fx, fy)
        ends = (x, y, x + size * fx / (value or 1.0), y + size * fy / (value or 1.0))
        places = ",".join(thousandths(100 * c) for c in ends)
        key = "".join(keys[joint.name] for joint in sketch.joints if link in joint.links)
        out += f"2F{number},{key},{_name(name)},{places},{thousandths(value)}."
    return out
