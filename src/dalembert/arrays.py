"""Array type aliases; each docstring states the shapes of its arrays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
"""Numbers; while an analysis is traced, symbols in their place."""

Ints = NDArray[np.intp]
"""Places and counts."""

Flags = NDArray[np.bool_]
"""Yes or no."""

Index = int | slice | Ints | Flags | None
"""Selection of items along one axis; None adds an axis."""

Numeric = Any
"""One number or an array of them; while an analysis is traced, symbols in their place."""

Tree = dict[str, Any]
"""Keys and values, as JSON, YAML and TOML have them."""

Arrays = TypeVar("Arrays")
"""An array, or a NamedTuple of arrays and of such records over the same positions."""


TIE, ROUNDING = 1e-9, 1e-13
"""Share of an extreme, and of the largest size, within which values are equally large."""


def first_largest(values: Array) -> int:
    """The place of the largest of some numbers, NaN left out: of equally large ones the first, whatever their rounding.

    >>> first_largest(np.array([1.0, 3 - 1e-13, np.nan, 3.0])), first_largest(np.array([1.0, np.inf]))
    (1, 1)
    >>> first_largest(-np.array([3.0, 2.0, 1e10]))
    1
    """
    each = np.ravel(values)
    largest = np.abs(each[np.isfinite(each)]).max(initial=0.0)
    extreme = np.nanmax(each)
    near = ROUNDING * largest + (TIE * abs(extreme) if np.isfinite(extreme) else 0.0)
    return int(np.argmax(each >= extreme - near))


def at(arrays: Arrays, where: object) -> Arrays:
    """An array, or a record of arrays, at some positions."""
    record: Any = arrays
    make: Callable[..., Arrays] = type(arrays)
    result: Arrays = make(*(at(a, where) for a in record)) if isinstance(record, tuple) else record[where]
    return result


def put(arrays: Arrays, where: object, part: Arrays) -> Arrays:
    """A copy of an array, or of a record of arrays, with other values at some positions."""
    record: Any = arrays
    make: Callable[..., Arrays] = type(arrays)
    values: Any = part
    if isinstance(record, tuple):
        result: Arrays = make(*(put(a, where, b) for a, b in zip(record, values, strict=True)))
        return result
    out: Any = np.array(record)
    out[where] = values
    return out  # type: ignore[no-any-return]
