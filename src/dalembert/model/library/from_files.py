"""Templates that are commented model files with parameters: each is a function of them, its dimensions."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from inspect import Parameter as Argument
from inspect import Signature
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library import closures
from dalembert.model.library.compass import angle, start_points
from dalembert.model.library.tree_parts import finite, positive
from dalembert.model.paths import with_dependents
from dalembert.model.quantities.dimensions import si_unit
from dalembert.model.quantities.parameters import Parameter, Parameters, read_parameters
from dalembert.units import Units
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.model import Mechanism

_ARGUMENT = re.compile(r"^  (\w+): +\{value: (.+?), about: (.+)\}$", re.MULTILINE)
_GROUP = re.compile(r"(\w+)_(x|y|z|1|2|start|end|first|last)")
UNITS = Units(length="mm")
"""Units of the files."""
POSITIVE = ("kg", "kg/m", "kg/m^2", "m")
"""Units of dimensions that are sizes, which must be greater than 0 if the file's value is."""


def file_text(name: str) -> str:
    """The text of a template's file."""
    from importlib.resources import files

    return (files(__package__) / "files" / f"{name}.yaml").read_text(encoding="utf-8")


def template_function(name: str) -> Callable[..., Mechanism]:
    """The function of a template's dimensions; its signature and its explanation are those of the file."""
    text = file_text(name)

    def build(**values: Any) -> Mechanism:
        return from_template(name, **values)

    arguments: dict[str, Any] = {}
    explained = []
    for parameter, value, about in _ARGUMENT.findall(text):
        group, default = _group(parameter), value.strip()
        arguments[group] = (*arguments.get(group, ()), default) if group != parameter else default
        explained.append(f"    {parameter}: {about} (default {default})")
    arguments["positions"] = int(re.findall(r"count: (\d+)", text)[0])
    keyword = Argument.KEYWORD_ONLY
    build.__signature__ = Signature(  # type: ignore[attr-defined]
        [Argument(n, keyword, default=default) for n, default in arguments.items()]
    )
    build.__name__ = build.__qualname__ = name
    build.__module__ = __package__
    build.__doc__ = _explanation(name, text, explained)
    return build


def _explanation(name: str, text: str, explained: list[str]) -> str:
    """Explanation from the head of the file, and its parameters."""
    head = re.search(r"^(# .*?)\n#\n# Solve it", text, re.MULTILINE | re.DOTALL)
    assert head is not None
    words = re.sub(r"^# ?", "", head[1], flags=re.MULTILINE)
    return "\n".join(
        [
            words,
            "",
            "Numbers are SI, angles of `sweep` radians and other angles degrees; texts carry their unit. A point or a",
            "range (`NAME_x`, `NAME_y`; `NAME_start`, `NAME_end`) is one argument `NAME`. It is the file of",
            f"`dalembert new {name}`.",
            "",
            *explained,
            "    positions: over the range of the drive",
            "",
            ">>> import dalembert as da",
            f">>> da.{name}(positions=3).schedule().count",
            "3",
        ]
    )


def _group(parameter: str) -> str:
    """The argument that a parameter belongs to: `load` for `load_x`."""
    match = _GROUP.fullmatch(parameter)
    return match[1] if match else parameter


@lru_cache(maxsize=32)
def _tree(name: str) -> Tree:
    from dalembert.model.files.model_files import read_text

    tree: Tree = read_text(file_text(name), "yaml", name)[0]
    return tree


@lru_cache(maxsize=32)
def _parameters_of(name: str) -> Parameters:
    return read_parameters(_tree(name)["parameters"], UNITS, {})


def from_template(name: str, **values: object) -> Mechanism:
    """The mechanism of a template's file with other dimensions: numbers in SI, or texts with their unit.

    It has the numbers that follow from them; the parameters themselves are in the file, `template_text`. `assembly` is
    that of the first position. Raises ModelError where it has no such dimension, for one that is not positive, and
    where the linkage does not close along the range of its drive.

    >>> from_template("four_bar", crank="60 mm").links["crank"].points["A"]
    (0.06, 0.0)
    """
    from dalembert.model.description import mechanism

    file = _tree(name)
    entries, count = dict(file["parameters"]), values.pop("positions", None)
    known = _parameters_of(name)
    for argument, value in values.items():
        for parameter, item in _members(name, argument, value, entries):
            entries[parameter] = {
                **entries[parameter],
                "value": _text(name, parameter, item, known[parameter]),
            }
    parameters = read_parameters({k: v for k, v in entries.items() if isinstance(v, Mapping)}, UNITS, {})
    tree = {**file, "parameters": entries, "drives": dict(file["drives"])}
    for drive, keys in tree["drives"].items() if count is not None else ():
        if isinstance(keys.get("position"), Mapping):
            tree["drives"][drive] = {**keys, "position": {**keys["position"], "count": count}}
    angles = _first_angles(name, parameters)
    if angles is not None:
        tree["assembly"] = angles
    return _numbers(mechanism(tree))


def _numbers(m: Mechanism) -> Mechanism:
    """The description in SI with the numbers that its parameters give, without the last digits of rounding."""
    parts: Tree = {"drives": with_dependents(m.drives, float, None)}
    for key in ("links", "joints", "loads", *(("turning",) if m.turning else ())):
        parts[key] = with_dependents(getattr(m, key), lambda x: float(f"{x:.14g}"), None)
    if m.assembly:
        parts["assembly"] = with_dependents(m.assembly, float, None)
    return m.model_copy(update={**parts, "parameters": {}, "units": Units()})


def _members(
    name: str, argument: str, value: object, entries: Mapping[str, object]
) -> list[tuple[str, object]]:
    """The parameters that an argument gives, and their values."""
    arguments = {
        parameter: _group(parameter) for parameter, keys in entries.items() if isinstance(keys, Mapping)
    }
    members = [parameter for parameter, group in arguments.items() if group == argument]
    if not members:
        choices = [*dict.fromkeys(arguments.values()), "positions"]
        raise ModelError(f"{name} has no dimension {argument!r}", closest(argument, choices, 20))
    if members == [argument]:
        return [(argument, value)]
    if not isinstance(value, (tuple, list)) or len(value) != len(members):
        raise ModelError(
            f"{name}: {argument} is {value!r}, not {len(members)} values", f"give {argument} as (a, b)"
        )
    return list(zip(members, value, strict=True))


def _text(name: str, parameter: str, value: Any, default: Parameter) -> Any:
    """A value as in the file: a number of SI units; degrees for an angle that is not a range."""
    unit = si_unit(default.dimension)
    own = "deg" if unit == "rad" and "sweep" not in parameter else unit
    number = (
        read_parameters({parameter: value}, UNITS, {})[parameter].value if isinstance(value, str) else value
    )
    if not isinstance(number, (int, float)) or isinstance(number, bool):
        raise ModelError(f"{name}: {parameter} is {value!r}, not a number", f"give it in {own or 'numbers'}")
    if unit in POSITIVE and default.value > 0 and not parameter.endswith(("_x", "_y", "_z")):
        positive(name, unit, **{parameter: number})
    finite(name, **{parameter: number})
    if isinstance(value, str):
        return value
    return f"{float(value)!r} {own}"


def _first_angles(name: str, parameters: Parameters) -> dict[str, float] | None:
    """The links' angles at the start of the drive's range, in degrees, after the linkage was seen to close along it."""
    groups: dict[str, list[float]] = {}
    for parameter, p in parameters.items():
        groups.setdefault(_group(parameter), []).append(p.value)
    sizes = SimpleNamespace(**{n: v[0] if n in parameters else tuple(v) for n, v in groups.items()})
    try:
        closure = getattr(closures, name, lambda _: None)(sizes)
    except ModelError as error:
        colon = "" if error.what.startswith(("does not close", name)) else ":"
        raise ModelError(f"{name}{colon} {error.what.removeprefix(f'{name}: ')}", error.remedy) from None
    if closure is None:
        return None
    turn = closure.drive != "cylinder"
    at = start_points(name, closure.place, sizes.sweep if turn else sizes.strokes, closure.drive, turn)
    return {
        link: angle(at, *ends.split()) if isinstance(ends, str) else ends
        for link, ends in closure.angles.items()
    }
