"""Replacing a value deep in a frozen description, by its path."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.part import Part, ReadingRules
from dalembert.model.quantities.dependent_numbers import Dependent, parameters_of
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.parameters import Parameter, Parameters
from dalembert.model.quantities.tables import Table
from dalembert.wording import closest


def replace_value(
    part: object, keys: Sequence[str], value: object, rules: ReadingRules, walked: tuple[str, ...] = ()
) -> Any:
    """The part with the value at the path replaced; raises ModelError where the path does not exist."""
    key, rest = keys[0], keys[1:]
    here = (*walked, key)
    if isinstance(part, Part):
        name = _field(part, key, here)
        inner = replace_value(_by_keys(part, key, name), rest, value, rules, here) if rest else value
        return _rebuilt(part, name, inner, rules, here)
    if isinstance(part, Mapping):
        if rest or not isinstance(part, Written):
            _require_known(key, list(part), here)
        new = {**part, key: replace_value(part[key], rest, value, rules, here) if rest else value}
        return Written(new) if isinstance(part, Written) else new
    if isinstance(part, tuple):
        _require_known(key, [str(i) for i in range(len(part))], here)
        items = list(part)
        items[int(key)] = replace_value(items[int(key)], rest, value, rules, here) if rest else value
        return _mirror(tuple(items), keys) if walked[-1:] == ("inertia",) else tuple(items)
    raise ModelError(
        f"the path {'.'.join([*here, *rest])!r} goes into a single value", "leave out its end", walked
    )


class Written(dict[str, object]):
    """A value as a file writes it, whose keys are checked where it is read again."""


def _by_keys(part: Part, key: str, name: str) -> Any:
    """A field in the form of a file where its value has keys: stops, a motor, a start, a range."""
    value = getattr(part, name)
    if name == "start":  # read anew last, when it is known which parameters are used
        return {k: Written(start.keys) for k, start in value.items()}
    inner = value.values() if isinstance(value, Mapping) else (value,)
    if any(isinstance(x, (Part, Table, Expression)) or not dataclasses.is_dataclass(x) for x in inner):
        return value
    tree = part.model_dump(mode="json", by_alias=True, include={name}).get(key)
    if not isinstance(tree, Mapping):
        return value
    return {k: Written(v) for k, v in tree.items()} if isinstance(value, Mapping) else Written(tree)


Leaf = float | Expression
"""A number, or a quantity that changes along the motion, which follows from parameters."""


PLAIN = (float, str, bool, int, type(None))
"""Types of values that cannot depend on parameters."""


def dependents(part: object, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Leaf]]:
    """Path and value of everything in a description that follows from its parameters."""
    if isinstance(part, Dependent) or (isinstance(part, Expression) and part.parameters):
        yield path, part
    for key, value in _inside(part):
        if type(value) not in PLAIN:
            yield from dependents(value, (*path, key))


def with_dependents(
    part: Any, change: Callable[[Any], Any], rules: ReadingRules | None, walked: tuple[str, ...] = ()
) -> Any:
    """The part with `change` of each value that follows from parameters; checked by the rules, if there are any."""
    if isinstance(part, (Dependent, Expression)):
        return change(part)
    new = {}
    for key, value in _inside(part):
        changed = with_dependents(value, change, rules, (*walked, key))
        if changed is not value:
            new[key] = changed
    if not new:
        return part
    if isinstance(part, Mapping):
        return {**part, **new}
    if isinstance(part, tuple):
        return tuple(new.get(str(i), value) for i, value in enumerate(part))
    if not isinstance(part, Part):
        return dataclasses.replace(part, **new)
    if rules is None or not walked:
        return part.model_copy(update={_field(part, key, walked): value for key, value in new.items()})
    try:
        return type(part).model_validate({**fields(part), **new}, context=rules)
    except ModelError as error:
        where = (*walked, *error.path)
        raise ModelError(f"{'.'.join(walked)}: {error.what}", error.remedy, where) from None


def parameter_name(path: str, parameters: Parameters, others: Sequence[str]) -> str:
    """The parameter that a path names: `r`, `parameters.r` or `parameters.r.value`; empty for another path.

    Raises ModelError for a single word that is neither a parameter nor one of the others, which are a file's keys.
    """
    keys = path.split(".")
    if parameters and len(keys) == 1 and path not in (*parameters, *others):
        raise ModelError(f"unknown parameter {path!r}", closest(path, list(parameters)), ("parameters",))
    name = keys[1] if keys[0] == "parameters" and len(keys) > 1 else keys[0]
    complete = keys in ([name], ["parameters", name], ["parameters", name, "value"])
    if keys[0] == "parameters" and not (complete and name in parameters):
        raise ModelError(
            f"the path {path!r} names no parameter's value", closest(name, list(parameters)), ("parameters",)
        )
    return name if complete and name in parameters else ""


def used_parameters(m: object, parameters: Parameters) -> dict[str, Parameter]:
    """The parameters that something in a description follows from, and those that these follow from."""
    used = (
        ancestors((name for _, leaf in dependents(m) for name in parameters_of(leaf)), parameters)
        if parameters
        else set()
    )
    return {name: p for name, p in parameters.items() if name in used}


def ancestors(names: Iterable[str], parameters: Parameters) -> set[str]:
    """The parameters named, and all that these follow from."""
    waiting, result = set(names), set[str]()
    while waiting:
        result |= waiting
        waiting = {name for known in waiting for name in parameters_of(parameters[known].value)} - result
    return result


def reached(m: Any, path: str) -> list[str]:
    """Paths of everything that follows from a parameter; of another path itself."""
    if path not in m.parameters:
        return [path]
    return [
        ".".join(keys) for keys, leaf in dependents(m) if path in ancestors(parameters_of(leaf), m.parameters)
    ]


def unused_parameters(m: Any) -> list[str]:
    """The parameters that nothing in the description uses."""
    used = used_parameters(m, m.parameters)
    return [name for name in m.parameters if name not in used]


@lru_cache(maxsize=64)
def _keys(kind: type[Part]) -> list[tuple[str, str]]:
    """Keys of a part and their fields, without the parameters themselves."""
    return [(field.alias or name, name) for name, field in kind.model_fields.items() if name != "parameters"]


def _inside(part: object) -> Iterable[tuple[str, object]]:
    """Keys and values of what may have numbers in it."""
    if isinstance(part, Part):
        return [(key, getattr(part, name)) for key, name in _keys(type(part))]
    if isinstance(part, Mapping):
        return part.items()
    if isinstance(part, tuple):
        return [(str(i), value) for i, value in enumerate(part)]
    if dataclasses.is_dataclass(part) and not isinstance(part, (type, Expression)):
        return [(field.name, getattr(part, field.name)) for field in dataclasses.fields(part)]
    return ()


WORDS = ("title", "source", "why")
"""Keys of texts that are not values."""


def as_in_file(value: object, key: str = "") -> object:
    """A value with each text that is a list or a mapping as a file would have it: its numbers are texts too."""
    if isinstance(value, Mapping):
        return {key: as_in_file(item, key) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [as_in_file(item) for item in value]
    if not isinstance(value, str) or key in WORDS or not value.lstrip().startswith(("[", "{")):
        return value
    from dalembert.model.files.yaml_text import read

    try:
        return _texts(read(value)[0])
    except ModelError as error:
        raise ModelError(error.what, error.remedy) from None


def _texts(value: object) -> object:
    if isinstance(value, list):
        return [_texts(item) for item in value]
    if isinstance(value, Mapping):
        return {str(key): _texts(item) for key, item in value.items()}
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return repr(value) if number else value


def _mirror(rows: tuple[tuple[Numeric, ...], ...], keys: Sequence[str]) -> tuple[tuple[Numeric, ...], ...]:
    """A matrix of inertia after one of its products was replaced, in both of its places."""
    if len(keys) < 2 or keys[0] == keys[1]:
        return rows
    i, j = int(keys[0]), int(keys[1])
    other = (*rows[j][:i], rows[i][j], *rows[j][i + 1 :])
    return (*rows[:j], other, *rows[j + 1 :])


def latest(earlier: Mapping[str, object], new: Mapping[str, object]) -> dict[str, object]:
    """Changes by path, each with what replaced it last; what lies within a value given later is gone."""
    kept = {
        path: value
        for path, value in earlier.items()
        if not any(path == new or path.startswith(f"{new}.") for new in new)
    }
    return {**kept, **new}


def fields(part: Part) -> dict[str, object]:
    """Its keys and values, from which an equal part can be made."""
    return {field.alias or name: getattr(part, name) for name, field in type(part).model_fields.items()}


def _field(part: Part, key: str, here: tuple[str, ...]) -> str:
    names = {field.alias or name: name for name, field in type(part).model_fields.items()}
    _require_known(key, list(names), here)
    return names[key]


def _require_known(key: str, choices: list[str], here: tuple[str, ...]) -> None:
    if key not in choices:
        where = f" in {'.'.join(here[:-1])}" if here[:-1] else ""
        raise ModelError(
            f"path {'.'.join(here)!r}: {key!r} does not exist{where}",
            closest(key, choices),
            here[:-1],
        )


def _rebuilt(part: Part, name: str, inner: object, rules: ReadingRules, here: tuple[str, ...]) -> Part:
    """The part with one field replaced; the complete mechanism is rebuilt once, by its method."""
    if len(here) == 1:
        return part.model_copy(update={name: inner})
    key = type(part).model_fields[name].alias or name
    keys = {**fields(part), **dict.fromkeys(part.replaced_by(name, inner)), key: inner}
    try:
        return type(part).model_validate(keys, context=rules)
    except ModelError as error:
        raise ModelError(
            f"{'.'.join(here[:-1])}: {error.what}", error.remedy, (*here[:-1], *error.path)
        ) from None


def value_at(part: object, keys: Sequence[str], walked: tuple[str, ...] = ()) -> Any:
    """The value at a path; raises ModelError where there is none."""
    if not keys:
        return part
    here = (*walked, keys[0])
    if isinstance(part, Part):
        return value_at(getattr(part, _field(part, keys[0], here)), keys[1:], here)
    if isinstance(part, Mapping):
        _require_known(keys[0], list(part), here)
        return value_at(part[keys[0]], keys[1:], here)
    if isinstance(part, tuple):
        _require_known(keys[0], [str(i) for i in range(len(part))], here)
        return value_at(part[int(keys[0])], keys[1:], here)
    if isinstance(part, Table) and list(keys) == ["times"]:
        return part.times
    entries = getattr(part, "keys", None)  # of a motor, of a start
    if isinstance(entries, dict) and len(keys) == 1:
        _require_known(keys[0], list(entries), here)
        return entries[keys[0]]
    raise ModelError(
        f"the path {'.'.join([*here, *keys[1:]])!r} goes into a single value", "leave out its end", walked
    )


def set_value(part: Any, keys: Sequence[str], value: Any, walked: tuple[str, ...] = ()) -> Any:
    """The part with any value at an existing path, unchecked; the value may be a symbol."""
    if not keys:
        return value
    here = (*walked, keys[0])
    if isinstance(part, Part):
        name = _field(part, keys[0], here)
        return part.model_copy(update={name: set_value(getattr(part, name), keys[1:], value, here)})
    if isinstance(part, Mapping):
        _require_known(keys[0], list(part), here)
        return {**part, keys[0]: set_value(part[keys[0]], keys[1:], value, here)}
    if isinstance(part, Table):
        return dataclasses.replace(part, times=value)
    if hasattr(part, "with_key"):
        return part.with_key(keys[0], value)
    index = int(keys[0])
    changed = (*part[:index], set_value(part[index], keys[1:], value, here), *part[index + 1 :])
    return _mirror(changed, keys) if walked[-1:] == ("inertia",) else changed
