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


def numbers(name: str, values: ArrayLike) -> Array:
    """An array of floats; refused is what would lose a part: imaginary parts, units, masks, text, truths."""
    if type(values) is np.ndarray and values.dtype == float:
        return values
    if hasattr(values, "units") and hasattr(values, "magnitude"):
        raise ModelError(f"{name} carry units", "give plain numbers, in SI and radians")
    if np.ma.is_masked(values):
        raise ModelError(
            f"{name} are masked in places", "give numbers everywhere, or leave those designs out"
        )
    try:
        array = np.asarray(values)
        what = KINDS.get(array.dtype.kind) or _strange(array)
        result = np.zeros(0) if what else np.asarray(array, float)
    except OverflowError:
        raise ModelError(f"{name} are too large for the arithmetic", "give numbers below 1.8e308") from None
    except (TypeError, ValueError):
        what = "not all numbers"
    if what:
        raise ModelError(f"{name} are {what}", "give an array of real numbers, in SI and radians")
    return result


def targets(out: Array | Mapping[str, Array], shapes: dict[str, tuple[int, ...]]) -> dict[str, Array]:
    """Arrays that receive the results, by name; a single array belongs to a single result."""
    arrays = out if isinstance(out, Mapping) else {next(iter(shapes)): out}
    if set(arrays) != set(shapes):
        raise ModelError(
            f"out= is for {', '.join(arrays)}, and there are results of {', '.join(shapes)}",
            "give an array of each by its name",
        )
    for name, shape in shapes.items():
        array = arrays[name]
        if not isinstance(array, np.ndarray) or array.dtype != float or not array.flags.writeable:
            raise ModelError(f"out= of {name} is not a writable array of floats", f"give np.empty({shape})")
        if array.shape != shape:
            raise ModelError(f"out= of {name} has shape {array.shape}", f"give one of shape {shape}")
    if len({id(array) for array in arrays.values()}) < len(arrays):
        raise ModelError("out= uses one array for several results", "give a separate array for each")
    return {name: np.asarray(arrays[name]) for name in shapes}


def design_values(
    values: ArrayLike | Mapping[str, ArrayLike] | None, names: Sequence[str], nominal: Array
) -> Array:
    """Designs (design, number); a single design may be a list, as may many of one number."""
    if isinstance(values, Mapping):
        values = _named_values(values, names, nominal)
    designs = nominal if values is None else numbers("values", values)
    if designs.ndim < 2:
        designs = designs.reshape(-1, 1) if len(names) == 1 else designs.reshape(1, -1)
    if designs.ndim != 2 or designs.shape[1] != len(names):
        raise ModelError(
            f"values of shape {np.shape(np.asarray(values))} do not fit {len(names)} numbers",
            "give (design, number) in the order of .numbers",
        )
    return designs


def _named_values(values: Mapping[str, ArrayLike], names: Sequence[str], nominal: Array) -> Array:
    """Designs (design, number) from numbers by name, each one value or one for each design; the others nominal."""
    for name in values:
        if name not in names:
            raise ModelError(f"the kernel does not vary {name!r}", closest(name, list(names)))
    by_name = {name: np.atleast_1d(numbers(name, of)) for name, of in values.items()}
    counts = {len(of) for of in by_name.values()} - {1}
    if len(counts) > 1 or any(of.ndim > 1 for of in by_name.values()):
        shapes = ", ".join(f"{name} of shape {of.shape}" for name, of in by_name.items())
        raise ModelError(f"values do not fit each other: {shapes}", "give one value, or one for each design")
    columns = [by_name.get(name, of) for name, of in zip(names, nominal, strict=True)]
    return np.stack(np.broadcast_arrays(*map(np.atleast_1d, columns)), axis=-1)


def drive_values(m: Mechanism, positions: int | ArrayLike) -> Array:
    """Values of the drives: the given ones, or those of a given number of positions."""
    if isinstance(positions, (int, float, np.number)) or (
        isinstance(positions, np.ndarray) and not positions.ndim
    ):
        return m.schedule(positions).position  # type: ignore[arg-type]  # refuses what is no count
    return numbers("positions", positions)


def check_positions(positions: Array, schedule: Schedule) -> None:
    """Raise ModelError for positions that are none of the file's drives."""
    drives = len(schedule.names)
    if not np.isfinite(positions).all():
        raise ModelError("positions are not all finite", "give numbers that are")
    if positions.ndim != 2 or positions.shape[1] != drives or not len(positions):
        raise ModelError(
            f"positions of shape {positions.shape} do not fit {drives} drive(s)", "give (position, drive)"
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
    wanted = target if isinstance(target, Mapping) else {next(iter(shapes)): target}
    if set(wanted) != set(shapes):
        raise ModelError(
            f"target= is for {', '.join(wanted)}, and there are outputs {', '.join(shapes)}",
            "give an array of each by its name",
        )
    out = {}
    for name, shape in shapes.items():
        values = numbers(f"targets of {name}", wanted[name])
        if values.shape not in (shape, shape[:1] if shape[1] == 1 else shape):
            full = shape if shape[1] > 1 else shape[:1]
            raise ModelError(f"target= of {name} has shape {values.shape}", f"give one of shape {full}")
        if not np.isfinite(values).all():
            raise ModelError(f"targets of {name} are not all finite", "leave those positions out: positions=")
        out[name] = values.reshape(shape)
    return out


def _strange(array: Array) -> str:
    """Kinds of items in a list that are not real numbers; empty if all are."""
    if array.dtype != object:
        return ""
    kinds = [x for x in array.ravel() if isinstance(x, bool | np.bool_) or not isinstance(x, Real | Decimal)]
    return "" if not kinds else "complex" if isinstance(kinds[0], complex) else "not all numbers"


def lanes_here() -> int:
    """Values side by side on this processor; raises ModelError without a compiler."""
    try:
        from dalembert.kernel.emit.machine_code import host_lanes

        return host_lanes()
    except ImportError:
        raise ModelError("compiling needs llvmlite", "pip install 'dalembert[fast]'") from None
