"""Variables of a changing quantity besides the drives: time, a link's angle, a freedom of a joint."""

from __future__ import annotations

import re
from collections.abc import Mapping

from dalembert.errors import ModelError
from dalembert.model.quantities.expressions import long_name, long_names
from dalembert.model.quantities.values import name
from dalembert.wording import quote_value

TIME = "time"
SPEEDS = {"turn": "angular_speed", "slide": "speed"}
EXAMPLES = "a drive, time, links.NAME.angle, joints.NAME.slide or joints.NAME.turn"


SPEED = ".speed"
"""Behind the name of a drive or a coordinate: its speed."""


def coordinate_name(value: object) -> str:
    """A drive's name, `time`, or the path of a coordinate, which `slide.G` and `angle.rod` name too."""
    if not isinstance(value, str) or "." not in value:
        return name(value)
    path = path_of(value)
    if "." in path.removesuffix(SPEED) and not parts(path):
        raise ModelError(f"{quote_value(value)} is nothing that a table can be against", f"write {EXAMPLES}")
    return path


def path_of(value: str) -> str:
    """The path of a coordinate by the name of its quantity; any other name as it is.

    >>> path_of("slide.G"), path_of("drive.O-4"), path_of("turn.A.speed"), path_of("time")
    ('joints.G.slide', 'O-4', 'joints.A.turn.speed', 'time')
    """
    word, _, rest = value.partition(".")
    thing, rate = (rest.removesuffix(SPEED), SPEED) if rest.endswith(SPEED) else (rest, "")
    short = re.fullmatch(r"angle|drive|(?:slide|turn)[12]?", word) and thing and "." not in thing
    return long_name(word, thing) + rate if short else value


def quantity_name(path: str) -> str:
    """The name of a coordinate as a quantity: the inverse of `path_of`.

    >>> quantity_name("joints.G.slide"), quantity_name("links.rod.angle.speed"), quantity_name("O.speed")
    ('slide.G', 'angle.rod.speed', 'O.speed')
    """
    value = parts(path)
    return f"{value[2]}.{value[1]}{SPEED if is_speed(path) else ''}" if value else path


def parts(path: str) -> tuple[str, str, str] | None:
    """The parts of `links.NAME.angle` and `joints.NAME.FREEDOM`, or of their speed; None of another name.

    >>> parts("links.rod.angle"), parts("joints.A.turn.speed"), parts("O2.speed")
    (('links', 'rod', 'angle'), ('joints', 'A', 'turn'), None)
    """
    keys = (path.removesuffix(SPEED) if path.count(".") == 3 else path).split(".")
    if len(keys) != 3 or (keys[0], keys[2] == "angle") not in (("links", True), ("joints", False)):
        return None
    return keys[0], keys[1], keys[2]


def going_by(text: str) -> dict[str, str]:
    """Time and the coordinates that an expression may use, with what each is: a turn, a slide, its speed, or time.

    >>> going_by("p*sin(links.rod.angle)*(slide.G.speed > 0)")
    {'time': 'time', 'links.rod.angle': 'turn', 'joints.G.slide.speed': 'slide speed'}
    """
    paths = re.findall(r"[^\W\d]\w*\.\w+\.\w+(?:\.speed\b)?", long_names(text))
    known = {path: names[2].rstrip("12").replace("angle", "turn") for path in paths if (names := parts(path))}
    return {TIME: TIME} | {path: f"{of} speed" if is_speed(path) else of for path, of in known.items()}


def is_speed(path: str) -> bool:
    """True if a name is the speed of a drive or of a coordinate.

    >>> [is_speed(path) for path in ("O.speed", "joints.G.slide.speed", "joints.speed.slide", "links.speed.angle")]
    [True, True, False, False]
    """
    return path.endswith(SPEED) and path.count(".") in (1, 3)


def along_of(path: str, freedoms: Mapping[str, str]) -> str:
    """Kind of a coordinate: an angle, a length, a speed of these or a time; empty where that is not known."""
    coordinate = parts(path)
    freedom = freedoms.get(path.removesuffix(SPEED) if is_speed(path) else path) or (
        coordinate[2] if coordinate else ""
    )
    if freedom:
        kind = "slide" if freedom.startswith("slide") else "turn"
        return {"slide": "length", "turn": "angle"}[kind] if not is_speed(path) else SPEEDS[kind]
    return "time" if path == TIME else ""
