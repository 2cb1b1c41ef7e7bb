"""Options that several commands share, each defined once: its type, its check and the sentence that --help prints."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.model import Mechanism
    from dalembert.views.notation import Notation


def integer(least: int, most: int | None = None) -> Callable[..., int]:
    """A reader of integers within limits."""

    def read(_: Any, tokens: Sequence[Any]) -> int:
        text = tokens[0].value
        number = int(text) if text.isascii() and text.isdigit() and len(text) < 16 else least - 1
        if number < least or (most is not None and number > most):
            limits = f"of {least} or more" if most is None else f"from {least} to {most}"
            raise ValueError(f"{text!r} is not an integer {limits}")
        return number

    return read


def bounded(key: str) -> Callable[..., Any]:
    """A reader of numbers within the bounds that functions of Python have too."""
    from dalembert.bounds import BOUNDS

    bound = BOUNDS[key]

    def read(_: Any, tokens: Sequence[Any]) -> int | float:
        text = tokens[0].value
        try:
            number: object = int(text) if bound.is_integer else float(text)
        except ValueError:
            number = text
        if not bound.allows(number):
            raise ValueError(f"{text!r} is not allowed; {bound.remedy_for(number)}")
        return number  # type: ignore[return-value]

    return read


def numeric(key: str, sentence: str, name: str | None = None) -> Parameter:
    """An option that takes a number within its bounds."""
    return Parameter(name=name, converter=bounded(key), allow_leading_hyphen=True, help=sentence)


def with_help(sentence: str) -> Parameter:
    """An option with its sentence."""
    return Parameter(help=sentence)


def several(sentence: str) -> Parameter:
    """An option that takes one word or more."""
    return Parameter(consume_multiple=True, negative=(), help=sentence)


def flag(sentence: str, name: str | None = None) -> Parameter:
    """An option without a value."""
    return Parameter(name=name, negative=(), help=sentence)


def output(sentence: str) -> Parameter:
    """The file to write, -o."""
    return Parameter(name=["--output", "-o"], help=sentence)


def target(sentence: str) -> Parameter:
    """An option that may begin with a hyphen: - for the screen, a negative number."""
    return Parameter(allow_leading_hyphen=True, help=sentence)


ModelFile = Annotated[Path, with_help("Model file: YAML, JSON or TOML; - is standard input.")]
NewFile = Annotated[Path | None, output("File to write (default: print).")]
Positions = Annotated[
    int | None,
    Parameter(
        converter=integer(1),
        allow_leading_hyphen=True,
        help="Number of positions over the range of the drives (default: as in the file).",
    ),
]
At = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="Position: a number (from 1), a value of the first drive such as 60deg, or an extreme of a "
        'quantity: "max effort.O2", "min transmission.B", "peak reaction.A" (largest magnitude); default: the first.',
    ),
]
Axes = Literal["ground", "link"]
ReactionAxes = Literal["ground", "link", "joint"]
Seen = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="In space: isometric (default), front, side, top, or azimuth and elevation of the view in degrees: 30,20.",
    ),
]
Drawing = Annotated[Path | None, with_help("Write a drawing: .svg, .pdf, .png or .dxf.")]
Report = Annotated[
    Path | None, with_help("Write the report or worked solution to this file: .pdf, .html, .tex or .txt.")
]
Units = Annotated[
    Literal["si", "file"] | None,
    with_help(
        "Units: si or file (default: file for text, drawings, reports, CSV and Excel; si for JSON and netCDF)."
    ),
]
Theme = Annotated[
    Literal["light", "dark", "print"],
    with_help("Colour theme: light, dark, or print (black and white)."),
]
Figures = Annotated[int, Parameter(converter=integer(1, 15), help="Significant figures.")]
Static = Annotated[bool, flag("Ignore inertia, even if the file has speeds.")]
NoFriction = Annotated[bool, flag("Ignore friction.")]
Set = Annotated[
    list[str] | None,
    Parameter(
        negative=(),
        help="Override a parameter or any number in the file: --set r=50mm --set links.rod.mass=2kg; repeatable.",
    ),
]
Names = Annotated[bool, flag("Show link names instead of numbers.")]
Force = Annotated[bool, flag("Overwrite existing files.")]


@Parameter(name="*")
@dataclass(frozen=True)
class Style:
    """Notation of a worked solution."""

    units: Units = None
    axes: Annotated[Axes, with_help("Axes of components: ground, or the link acted on.")] = "ground"
    names: Names = False
    on_by: Annotated[bool, flag("F_ij is the force on i by j (default: by i on j).")] = False
    letter: Annotated[Literal["F", "G"], with_help("Letter of the joint forces: F or G.")] = "F"
    figures: Figures = 4
    decimals: Annotated[
        int | None,
        Parameter(
            converter=integer(0, 15),
            allow_leading_hyphen=True,
            help="Decimals, instead of significant figures.",
        ),
    ] = None
    clockwise: Annotated[bool, flag("Count moments positive clockwise.")] = False

    def notation(self) -> Notation:
        """The same for the views."""
        from dalembert.views.notation import Notation

        return Notation(
            links="name" if self.names else "number",
            order="on-by" if self.on_by else "by-on",
            letter=self.letter,
            units="SI" if self.units == "si" else "file",
            figures=self.figures,
            decimals=self.decimals,
            torque=-1 if self.clockwise else 1,
            axes=self.axes,
        )


@Parameter(name="*")
@dataclass(frozen=True)
class Changes:
    """The description that is analysed, with numbers changed by options."""

    no_friction: NoFriction = False
    set: Set = None

    def load(self, file: Path) -> Mechanism:
        """The description with what the command line says otherwise."""
        from dalembert.model import load
        from dalembert.model.paths import unused_parameters

        m = load(file)
        for name in unused_parameters(m):
            line = f":{m.source.line(('parameters', name))}" if m.source else ""
            print(f"{file}{line}: note: nothing in the file uses the parameter {name!r}", file=sys.stderr)
        return self.changed(m)

    def changed(self, m: Mechanism) -> Mechanism:
        """A mechanism with what the command line says otherwise."""
        m = with_settings(m, self.set or ())
        return m.with_values({"friction.enabled": False}) if self.no_friction else m


def with_settings(m: Mechanism, settings: Sequence[str]) -> Mechanism:
    """The mechanism with the values of options `--set NAME=VALUE`; raises ModelError that names the option."""
    values = set_values(settings)
    try:
        return m.with_values(values) if values else m
    except ModelError as error:
        raise ModelError(f"--set {' --set '.join(settings)}: {error.what}", error.remedy) from None


def set_values(settings: Sequence[str]) -> dict[str, object]:
    """The values of options `--set NAME=VALUE` by name."""
    values: dict[str, object] = {}
    for setting in settings:
        path, equals, value = (part.strip() for part in setting.partition("="))
        if not (path and equals and value):
            raise ModelError(f"--set {setting} has no value", "write NAME=VALUE, for example --set r=50mm")
        if path in values:
            raise ModelError(f"--set gives {path!r} twice", "leave one of them out")
        values[path] = {"true": True, "false": False}.get(value, value)
    return values


@Parameter(name="*")
@dataclass(frozen=True)
class Steady(Changes):
    """The same, with or without inertia."""

    static: Static = False


@Parameter(name="*")
@dataclass(frozen=True)
class Of(Steady):
    """The same, at a number of positions."""

    positions: Positions = None


@Parameter(name="*")
@dataclass(frozen=True)
class OfAt(Of):
    """The same; one of its positions is shown."""

    at: At = None


AS_USUAL = Style()
AS_IN_FILE, AS_STATED, AS_GIVEN, AT_FIRST = Changes(), Steady(), Of(), OfAt()
