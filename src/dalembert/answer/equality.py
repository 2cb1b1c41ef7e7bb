"""Equality of answers: by their fields, with arrays compared number by number and NaN equal to NaN."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass

import numpy as np

from dalembert.arrays import Tree


class Compared:
    """Record that is equal to another of its class with equal fields; those with ``compare=False`` do not count."""

    __hash__ = None  # type: ignore[assignment]  # its arrays have no hash

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return equal(self.compared(), other.compared())

    def compared(self) -> Tree:
        """Items that must be equal, by name."""
        return _compared_fields(self)


def equal(a: object, b: object) -> bool:
    """True if two values are the same: records by their fields, arrays and lists item by item, NaN as NaN.

    >>> equal({"x": np.array([1.0, np.nan])}, {"x": np.array([1.0, np.nan])})
    True
    >>> equal([1.0, float("nan")], [1.0, 2.0])
    False
    """
    if a is b:
        return True
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return _equal_arrays(a, np.asarray(b))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(equal(a[key], b[key]) for key in a)
    if isinstance(a, Sequence) and isinstance(b, Sequence) and not isinstance(a, (str, bytes)):
        return len(a) == len(b) and all(map(equal, a, b))
    if is_dataclass(a) and not isinstance(a, Compared):
        return equal(_compared_fields(a), _compared_fields(b))
    return bool(a == b or (a != a and b != b))


def _equal_arrays(a: np.ndarray, b: np.ndarray) -> bool:
    if a.dtype == object or a.dtype != b.dtype:
        return a.shape == b.shape and a.dtype == b.dtype and equal(a.tolist(), b.tolist())
    return np.array_equal(a, b, equal_nan=a.dtype.kind in "fc")


def _compared_fields(record: object) -> Tree:
    return {f.name: getattr(record, f.name) for f in fields(record) if f.compare}  # type: ignore[arg-type]
