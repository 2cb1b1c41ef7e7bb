"""Given data that only a design needs: sections, bolts, bearings, cylinders, motors, as the file states them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from dalembert.reports.design.verdict import DesignContext
from dalembert.reports.sheet import ReportSheet
from dalembert.units import KINDS, NUMBER

KEYS = {
    "links": ("section", "members", "effective_length"),
    "joints": ("pin", "bearing", "stiffness", "follower", "profile"),
    "drives": ("cylinder", "motor", "screw", "law"),
}
"""Section of a model file -> keys of its parts that are shown."""
PLAIN = (
    *("length", "angle", "time", "mass", "force", "moment", "pressure", "speed", "angular_speed", "area"),
    *("section_modulus", "second_moment", "inertia", "stiffness", "power", "flow"),
)
OF_UNIT = {KINDS[kind].si: kind for kind in PLAIN}
"""SI unit -> the kind that is shown for it."""
STATED = re.compile(rf"({NUMBER}) (\S+)")


def given_parts(sheet: ReportSheet, c: DesignContext) -> None:
    """The position that is drawn, and a table of these data, in the reader's units."""
    if len(c.r.status) > 1:
        sheet.text(
            f"Motion of the drives, loads and drawing: at {c.at(c.k)}, of {len(c.r.status)} positions."
        )
    tree = c.r.mechanism.to_tree()
    rows = [
        (name, key.replace("_", " "), stated(c, value[key]))
        for section, keys in KEYS.items()
        for name, value in tree.get(section, {}).items()
        for key in keys
        if isinstance(value, Mapping) and key in value
    ]
    sheet.table(["Part", "Data", "Value"], rows, words=True)


def stated(c: DesignContext, value: object) -> str:
    """A value of a description as text: `rectangle [12 mm, 40 mm], yield stress 235 MPa`."""
    if isinstance(value, Mapping):
        return ", ".join(f"{str(k).replace('_', ' ')} {stated(c, v)}" for k, v in _pairs(value))
    if isinstance(value, (list, tuple)):
        inner = "; " if any(isinstance(v, Mapping) for v in value) else ", "
        return f"[{inner.join(stated(c, v) for v in value)}]"
    if (parameter := c.r.mechanism.parameters.get(str(value))) and parameter.kind:
        return c.text(parameter.kind, float(parameter.value))
    matched = STATED.fullmatch(str(value))
    if matched is None or matched[2] not in OF_UNIT:
        return str(value)
    return c.text(OF_UNIT[matched[2]], float(matched[1]))


def _pairs(value: Mapping[str, object]) -> Iterator[tuple[str, object]]:
    """Keys and values, without long lists of numbers."""
    for key, inner in value.items():
        long = isinstance(inner, (list, tuple)) and len(inner) > 12
        yield key, f"{len(inner)} values" if long else inner  # type: ignore[arg-type]
