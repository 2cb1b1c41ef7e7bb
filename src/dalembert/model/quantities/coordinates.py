"""Variables of a changing quantity besides the drives: time, a link's angle, a freedom of a joint."""

from __future__ import annotations

import re
from collections.abc import Mapping

from dalembert.errors import ModelError
from dalembert.model.quantities.expressions import long_name, long_names
from dalembert.model.quantities.values import name
from dalembert.wording import quote_value

TIME = "time"
EXAMPLES = "a drive, time, links.NAME.angle, joints.NAME.slide or joints.NAME.turn"


SPEED = ".speed"
"""Behind a drive's name: its speed, by which efforts of drives may go."""


def coordinate_name(value: object) -> str:
    """A drive's name, `time`, or the path of a coordinate, which `slide.G` and `angle.rod` name too."""
    if not isinstance(value, str) or "." not in value:
        return name(value)
    path = path_of(value)
    if "." in path and not parts(path):
        raise ModelError(f"{quote_value(value)} is nothing that a table can be against", f"write {EXAMPLES}")
    return path


def path_of(value: str) -> str:
    """The path of a coordinate by the name of its quantity; any other name as it is.

    >>> path_of("slide.G"), path_of("drive.O-4"), path_of("time")
    ('joints.G.slide', 'O-4', 'time')
    """
    word, _, thing = value.partition(".")
    short = re.fullmatch(r"angle|drive|(?:slide|turn)[12]?", word) and thing and "." not in thing
    return long_name(word, thing) if short else value


def parts(path: str) -> tuple[str, str, str] | None:
    """The parts of `links.NAME.angle` and `joints.NAME.FREEDOM`; None of another name.

    >>> parts("links.rod.angle"), parts("O2")
    (('links', 'rod', 'angle'), None)
    """
    found = path.split(".")
    if len(found) != 3 or (found[0], found[2] == "angle") not in (("links", True), ("joints", False)):
        return None
    return found[0], found[1], found[2]


def going_by(text: str) -> dict[str, str]:
    """Time and the coordinates that an expression may use, with what each is: a turn, a slide, or time.

    >>> going_by("p*sin(links.rod.angle)")
    {'time': 'time', 'links.rod.angle': 'turn'}
    """
    found = re.findall(r"[^\W\d]\w*\.\w+\.\w+", long_names(text))
    return {TIME: TIME} | {path: "slide" if ".slide" in path else "turn" for path in found if parts(path)}


def along_of(path: str, freedoms: Mapping[str, str]) -> str:
    """Kind of a variable: angle, length or time; empty where it is not known."""
    if path in freedoms:
        return "length" if freedoms[path].startswith("slide") else "angle"
    found = parts(path)
    if found:
        return "length" if found[2].startswith("slide") else "angle"
    return "time" if path == TIME else ""
