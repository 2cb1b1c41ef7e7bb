"""Validates kernel inputs: real floats only."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from decimal import Decimal
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import Mechanism, Schedule
from dalembert.wording import closest

KINDS = {
    "c": "complex",
    "b": "true and false",
    "U": "text",
    "S": "text",
    "m": "times",
    "M": "dates",
    "V": "records",
}
"""Content of arrays that are not of real numbers, by numpy's letter for it."""


def numbers(name: str, given: ArrayLike) -> Array:
    """An array of floats; refused is what would lose a part: imaginary parts, units, masks, text, truths."""
    if type(given) is np.ndarray and given.dtype == float:
        return given
    if hasattr(given, "units") and hasattr(given, "magnitude"):
        raise ModelError(f"{name} carry units", "give plain numbers, in SI and radians")
    if np.ma.is_masked(given):
        raise ModelError(
            f"{name} are masked in places", "give numbers everywhere, or leave those designs out"
        )
    try:
        array = np.asarray(given)
        what = KINDS.get(array.dtype.kind) or _strange(array)
        found = np.zeros(0) if what else np.asarray(array, float)
    except OverflowError:
        raise ModelError(f"{name} are too large for the arithmetic", "give numbers below 1.8e308") from None
    except (TypeError, ValueError):
        what = "not all numbers"
    if what:
        raise ModelError(f"{name} are {what}", "give an array of real numbers, in SI and radians")
    return found


def targets(out: Array | Mapping[str, Array], shapes: dict[str, tuple[int, ...]]) -> dict[str, Array]:
    """Arrays that receive the results, by name; a single array belongs to a single result."""
    given = out if isinstance(out, Mapping) else {next(iter(shapes)): out}
    if set(given) != set(shapes):
        raise ModelError(
            f"out= is for {', '.join(given)}, and there are results of {', '.join(shapes)}",
            "give an array of each by its name",
        )
    for name, shape in shapes.items():
        array = given[name]
        if not isinstance(array, np.ndarray) or array.dtype != float or not array.flags.writeable:
            raise ModelError(f"out= of {name} is not a writable array of floats", f"give np.empty({shape})")
        if array.shape != shape:
            raise ModelError(f"out= of {name} has shape {array.shape}", f"give one of shape {shape}")
    if len({id(array) for array in given.values()}) < len(given):
        raise ModelError("out= uses one array for several results", "give a separate array for each")
    return {name: np.asarray(given[name]) for name in shapes}


def design_values(
    values: ArrayLike | Mapping[str, ArrayLike] | None, names: Sequence[str], nominal: Array
) -> Array:
    """Designs (design, number); a single design may be a list, as may many of one number."""
    if isinstance(values, Mapping):
        values = _named_values(values, names, nominal)
    given = nominal if values is None else numbers("values", values)
    if given.ndim < 2:
        given = given.reshape(-1, 1) if len(names) == 1 else given.reshape(1, -1)
    if given.ndim != 2 or given.shape[1] != len(names):
        raise ModelError(
            f"values of shape {np.shape(np.asarray(values))} do not fit {len(names)} numbers",
            "give (design, number) in the order of .numbers",
        )
    return given


def _named_values(values: Mapping[str, ArrayLike], names: Sequence[str], nominal: Array) -> Array:
    """Designs (design, number) from numbers by name, each one value or one for each design; the others nominal."""
    for name in values:
        if name not in names:
            raise ModelError(f"the kernel does not vary {name!r}", closest(name, list(names)))
    given = {name: np.atleast_1d(numbers(name, of)) for name, of in values.items()}
    counts = {len(of) for of in given.values()} - {1}
    if len(counts) > 1 or any(of.ndim > 1 for of in given.values()):
        shapes = ", ".join(f"{name} of shape {of.shape}" for name, of in given.items())
        raise ModelError(f"values do not fit each other: {shapes}", "give one value, or one for each design")
    columns = [given.get(name, of) for name, of in zip(names, nominal, strict=True)]
    return np.stack(np.broadcast_arrays(*map(np.atleast_1d, columns)), axis=-1)


def drive_values(m: Mechanism, positions: int | ArrayLike) -> Array:
    """Values of the drives: the given ones, or those of a given number of positions."""
    if isinstance(positions, (int, float, np.number)) or (
        isinstance(positions, np.ndarray) and not positions.ndim
    ):
        return m.schedule(positions).position  # type: ignore[arg-type]  # refuses what is no count
    return numbers("positions", positions)


def check_positions(given: Array, schedule: Schedule) -> None:
    """Raise ModelError for positions that are none of the file's drives."""
    drives = len(schedule.names)
    if not np.isfinite(given).all():
        raise ModelError("positions are not all finite", "give numbers that are")
    if given.ndim != 2 or given.shape[1] != drives or not len(given):
        raise ModelError(
            f"positions of shape {given.shape} do not fit {drives} drive(s)", "give (position, drive)"
        )
    for rate in (schedule.speed, schedule.acceleration):
        if np.ptp(rate, axis=0).any():
            what = "the drives' speeds change along the file's positions"
            raise ModelError(what, "leave positions out", ("drives",))


def read_target(
    target: ArrayLike | Mapping[str, ArrayLike], shapes: dict[str, tuple[int, int]], reduce: str | None
) -> dict[str, Array]:
    """Values that outputs are compared with, by name (position, component); a single array belongs to a single
    output."""
    if reduce != "squares":
        raise ModelError("only squares are taken to a target", 'compile with reduce="squares"')
    given = target if isinstance(target, Mapping) else {next(iter(shapes)): target}
    if set(given) != set(shapes):
        raise ModelError(
            f"target= is for {', '.join(given)}, and there are outputs {', '.join(shapes)}",
            "give an array of each by its name",
        )
    out = {}
    for name, shape in shapes.items():
        found = numbers(f"targets of {name}", given[name])
        if found.shape not in (shape, shape[:1] if shape[1] == 1 else shape):
            whole = shape if shape[1] > 1 else shape[:1]
            raise ModelError(f"target= of {name} has shape {found.shape}", f"give one of shape {whole}")
        if not np.isfinite(found).all():
            raise ModelError(f"targets of {name} are not all finite", "leave those positions out: positions=")
        out[name] = found.reshape(shape)
    return out


def _strange(array: Array) -> str:
    """Kinds of items in a list that are not real numbers; empty if all are."""
    if array.dtype != object:
        return ""
    kinds = [x for x in array.ravel() if isinstance(x, bool | np.bool_) or not isinstance(x, Real | Decimal)]
    return "" if not kinds else "complex" if isinstance(kinds[0], complex) else "not all numbers"
