"""The language of Adams View's command files: commands with keys, as text and from text.

A command is words, then ``key = value, value``; ``!`` begins a comment, ``&`` joins the next line, quotes hold
functions of time. Nothing is executed: macros, conditions and expressions are refused with their line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from dalembert.errors import ModelError
from dalembert.model.drives.expression_laws import ExpressionLaw
from dalembert.model.quantities.expressions import Expression
from dalembert.units import quantity

LARGEST = 2_000_000
"""Bytes of a file."""

INSTANTS = (0.0, 0.37, 1.9)
"""Times at which the acceleration of a function is the same, if it is a polynomial of second degree at most."""

UNITS = {
    "length": {
        "meter": "m",
        "millimeter": "mm",
        "mm": "mm",
        "centimeter": "cm",
        "cm": "cm",
        "inch": "in",
        "foot": "ft",
    },
    "force": {"newton": "N", "knewton": "kN", "pound_force": "lbf"},
    "mass": {"kilogram": "kg", "kg": "kg", "gram": "g", "pound_mass": "lbm"},
    "time": {"second": "s", "sec": "s", "millisecond": "ms", "minute": "min"},
    "angle": {"degrees": "deg", "deg": "deg", "radians": "rad", "rad": "rad"},
}
"""Words of Adams for units -> ours."""

REFUSED = {
    "macro": "a macro",
    "if": "a condition",
    "for": "a loop of commands",
    "while": "a loop of commands",
    "file": "a file to be read",
    "part create flexible_body": "a flexible part",
    "part create fe_part": "a flexible part",
    "part create point_mass": "a point mass",
    "contact": "a contact",
    "constraint create complex_joint coupler": "a coupler, which is a ratio of two freedoms without teeth,",
    "constraint create complex_joint gear": "a gear without teeth",
    "constraint create primitive_joint": "a primitive constraint",
    "constraint create higher_pair_contact": "a cam without a profile in the file",
    "force create element_like": "a spring, bushing, beam or friction",
    "force create direct": "a force of several components",
    "ude": "an element defined by a user",
}
"""Beginnings of commands that are refused -> what they make."""

NOTED = {
    "simulation": "simulations",
    "measure": "measures",
    "output_control": "requests",
    "sensor": "sensors",
    "variable": "variables",
    "data_element": "data elements",
    "part create rigid_body initial_velocity": "initial velocities",
}
"""Beginnings of commands that are left out -> their name in a note."""

LOOKS = (
    *("view", "color", "geometry", "group", "interface", "undo", "material", "plugin", "list_info"),
    *("defaults attributes", "defaults model", "analysis", "executive_control"),
    *(f"{part} attributes" for part in ("model", "part", "marker", "constraint", "force", "entity")),
)
"""Beginnings of commands that neither move anything nor force it."""

KINDS = {
    "revolute": "revolute",
    "prismatic": "translational",
    "cylindrical": "cylindrical",
    "spherical": "spherical",
    "weld": "fixed",
    "screw": "screw",
}
"""Our joint type -> that of the format; others become chains of these."""

ENDS = "joint_name i_marker_name j_marker_name pitch"
FUNCTION = "type_of_freedom function"
KEYS = {
    "model create": "model_name title",
    "defaults units": " ".join([*UNITS, "coordinate_system_type orientation_type"]),
    "defaults coordinate_system": "default_coordinate_system",
    "marker create": "marker_name location orientation relative_to",
    "part create rigid_body name_and_position": "part_name location orientation relative_to",
    "part create rigid_body mass_properties": "part_name mass center_of_mass_marker inertia_marker ixx iyy izz "
    "ixy izx iyz material_type",
    **{f"constraint create joint {kind}": ENDS for kind in KINDS.values()},
    "constraint create motion_generator": f"motion_name joint_name time_derivative displacement_ic {FUNCTION}",
    "force create direct single_component_force": "single_component_force_name i_marker_name j_marker_name "
    f"action_only {FUNCTION}",
    "force create body gravitational": "gravity_field_name "
    + " ".join(f"{a}_component_gravity" for a in "xyz"),
}
"""Commands that are read -> their keys."""

TOKEN = re.compile(r'"(?P<quoted>[^"]*)"|(?P<mark>[=,])|(?P<word>[^\s=,"()]+)|(?P<odd>[("])')


@dataclass
class Command:
    """A command: its words, ``modify`` as ``create``, its keys in small letters, its first line."""

    head: str
    keys: dict[str, list[str]]
    line: int
    file: str

    def error(self, what: str, remedy: str) -> ModelError:
        """A message at its line."""
        return ModelError(what, remedy, (), self.file, self.line)

    def text(self, key: str, default: str | None = None) -> str:
        """The value of a key; an error where it is left out and has no default."""
        if key not in self.keys and default is None:
            raise self.error(f"{self.head} has no {key}", f"give {key}")
        words = self.keys.get(key, [default or ""])
        if len(words) != 1 and key != "function":
            raise self.error(f"{key} has {len(words)} values", "give one")
        return "".join(words)

    def number(self, key: str) -> float:
        """One number, 0 where it is left out."""
        return self.numbers(key, 1)[0] if key in self.keys else 0.0

    def numbers(self, key: str, count: int, degrees: float = 1.0) -> list[float]:
        """Numbers of a key; ``degrees``: radians of an angle without a D behind it."""
        out = []
        for word in self.keys.get(key, []):
            scale = degrees
            if degrees != 1.0 or key == "orientation":
                scale = np.pi / 180 if word[-1:] in "dD" else degrees
                word = word.rstrip("dD")
            try:
                out.append(float(word) * scale)
            except ValueError:
                raise self.error(
                    f"{key}: {word!r} is not a number", "write numbers, not expressions"
                ) from None
        if len(out) != count or not np.isfinite(out).all():
            raise self.error(f"{key} has not {count} finite numbers", f"give {count}")
        return out


def read_commands(content: bytes, file: str) -> Iterator[Command]:
    """The commands of a file, without comments, lines that end with & joined."""
    if len(content) > LARGEST:
        raise ModelError(f"the file has more than {LARGEST} bytes", "leave meshes out", (), file, 1)
    joined, first = "", 0
    for k, raw in enumerate(content.decode("utf-8", "replace").splitlines(), 1):
        bare = re.sub(r'("[^"]*")|!.*', lambda m: m[1] or "", raw).strip()
        if bare:
            first = first if joined else k
            joined += bare.removesuffix("&") + " "
        if bare and not bare.endswith("&"):
            yield _command(joined, first, file)
            joined = ""
    if joined:
        yield _command(joined, first, file)


def _command(text: str, line: int, file: str) -> Command:
    """One command: words, then keys with the values behind their equal signs."""
    tokens = list(TOKEN.finditer(text))
    marks = {k for k, token in enumerate(tokens) if token["mark"] == "="}
    first = max(min(marks, default=len(tokens) + 1) - 1, 0)
    words = " ".join(token[0] for token in tokens[:first]).lower()
    made = Command(re.sub(r"\bmodify\b", "create", words), {}, line, file)
    key = ""
    for k, token in enumerate(tokens[first:], first):
        if token["odd"] and made.head in KEYS:
            what = f"{key} is an expression, or a text without an end"
            raise made.error(what, "write its value: nothing is computed here")
        if k + 1 in marks:
            key = token[0].lower()
            made.keys[key] = []
        elif not token["mark"]:
            made.keys.setdefault(key, []).append(token[0] if token["quoted"] is None else token["quoted"])
    if made.keys.get("active", ["on"]) != ["on"]:
        raise made.error("a part of the model that is switched off (active) is not read", "delete it")
    return made


def begins(words: str, beginning: str) -> bool:
    """True if a command begins with these words."""
    return words == beginning or words.startswith(f"{beginning} ")


def note_of(command: Command) -> str | None:
    """Note on a command that is left out, "" for nothing, None for one that is read; raises for others."""
    head = command.head
    for beginning, what in NOTED.items():
        if begins(head, beginning):
            return what
    if any(begins(head, beginning) for beginning in LOOKS):
        return ""
    if head not in KEYS:
        for beginning, what in REFUSED.items():
            if begins(head, beginning):
                remedy = "leave it out, and describe it in the model file that comes out"
                raise command.error(f"{what} ({beginning}) is not read", remedy)
        what = f"the command {head[:60]!r} is not read"
        raise command.error(what, "commands are not abbreviated; docs/formats.md says what is read")
    for key in command.keys:
        if key not in (*KEYS[head].split(), "adams_id", "comments"):
            raise command.error(
                f"the key {key} of {head} is not read", f"write {KEYS[head].replace(' ', ', ')}"
            )
    return None


def units_of(command: Command) -> dict[str, float]:
    """The default units that a command sets, in SI."""
    for key, only in (("orientation_type", "body313"), ("coordinate_system_type", "cartesian")):
        if command.text(key, only).lower() != only:
            raise command.error(f"{key} is {command.text(key)}", f"write {only}")
    units = {}
    for kind in UNITS.keys() & command.keys:
        word = command.text(kind).lower()
        if word not in UNITS[kind]:
            raise command.error(f"unknown unit {word!r}", f"write {', '.join(UNITS[kind])}")
        units[kind] = quantity(f"1 {UNITS[kind][word]}", kind, None)
    return units


def of_time(command: Command, scale: float, unit_of_time: float) -> tuple[list[float], bool]:
    """Value, rate and second derivative at time 0 of a function of time, and whether these are all of it.

    scale: the unit of its value; a D behind a number means degrees. Raises ModelError for any other function.
    """
    text = command.text("function").strip()
    plain = re.sub(r"(?i)(?<![\w.])((?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)d\b", r"(\1*pi/180)", text).lower()
    try:
        with np.errstate(all="ignore"):
            at = ExpressionLaw(Expression(plain)).at(INSTANTS)
    except (ModelError, ValueError, KeyError, TypeError):
        at = np.array([[np.nan]])
    if not np.isfinite(at[:, 0]).all():
        what = f"the function {text[:60]!r} is not read" if text else "there is no function"
        raise command.error(what, "write a function of time by + - * / ** and sin, cos, exp, sqrt") from None
    spread = np.abs(at[2] - at[2, 0]).max(initial=0.0)
    whole = bool(spread <= 1e-12 * np.abs(at[2]).max(initial=0.0))
    return [float(x) * scale / unit_of_time**k for k, x in enumerate(at[:, 0])], whole


MODEL = "mechanism"
"""Name of a model that is written."""


class CommandText:
    """Commands as text, and the names that are taken in the model (part "") and in each part."""

    def __init__(self) -> None:
        self.lines = ["! written by dalembert: metres, newtons, kilograms, seconds, degrees"]
        self.names: dict[str, set[str]] = {}

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"

    def add(self, command: str, keys: dict[str, str]) -> None:
        """A command, a key a line."""
        self.lines.append("  &\n".join([command, *(f"   {key} = {value}" for key, value in keys.items())]))

    def name(self, part: str, text: str) -> str:
        """A name of letters, digits and underscores that nothing else of the part, or of the model, has."""
        taken = self.names.setdefault(part, set())
        plain = re.sub(r"[^A-Za-z0-9_]", "_", text)
        plain = plain if re.match("[A-Za-z]", plain) else f"_{plain}"
        out, k = plain, 2
        while out.lower() in taken:
            out, k = f"{plain}_{k}", k + 1
        taken.add(out.lower())
        if out != text:
            self.lines.append(f"! {out} is {text!r}")
        return out
