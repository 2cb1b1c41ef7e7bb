"""Answers that are read by the names of quantities: of one analysis, of many designs, of a motion."""

from __future__ import annotations

from collections import Counter
from typing import ClassVar, NamedTuple

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array, first_largest
from dalembert.errors import DalembertError, ModelError


class Peak(NamedTuple):
    """The largest magnitude of a quantity, SI, and its place: ``r[name][place]``, ``r.status[place]``.

    A place is a number from 0 (of a position, design or instant), or several where there are several axes.
    """

    value: float
    place: int | tuple[int, ...]


class NamedAnswer(Compared):
    """Answer with quantities by name; a class gives ``keys``, ``__getitem__`` and ``codes``.

    >>> import dalembert as da
    >>> r = da.statics(da.four_bar())
    >>> len(r), "effort.O2" in r, "effort.O9" in r, r.keys()[0]
    (72, True, False, 'effort.O2')
    >>> place = r.peak("reaction.A").place
    >>> r["reaction.A.magnitude"][place] == r.peak("reaction.A").value
    np.True_
    """

    ROW: ClassVar[str] = "position"
    __iter__ = None  # an answer is not a sequence of its rows

    def keys(self) -> list[str]:
        """Names of its quantities, without components: `reaction.A`, not `reaction.A.x`."""
        raise NotImplementedError

    def __getitem__(self, name: str) -> Array:
        raise NotImplementedError

    @property
    def codes(self) -> Array:
        """Statuses along the axes that its quantities begin with, the rows first."""
        raise NotImplementedError

    def both_sides(self, name: str) -> list[Array]:
        """A quantity, and where contacts reverse also its values just after."""
        after = getattr(self, "after", None)
        return [self[name]] if after is None else [self[name], after[name]]

    def __contains__(self, name: object) -> bool:
        """True if the answer has a quantity of this name, components and expressions included."""
        if not isinstance(name, str):
            return False
        try:
            return name in self.keys() or self[name] is not None
        except DalembertError:
            return False

    def __len__(self) -> int:
        """Number of rows: positions, designs or instants."""
        return int(np.shape(self.codes)[0])

    def __bool__(self) -> bool:
        return True  # an answer without rows is an answer

    def peak(self, name: str) -> Peak:
        """Largest magnitude of a quantity over all rows and positions, SI, of a vector its length, with its place.

        Values just before and just after a reversal both count; positions without an answer do not. Raises ModelError
        for a name that it does not have, and where no position has a value.
        """
        rank = np.ndim(self.codes)
        sizes = np.fmax.reduce([_sizes(values, rank) for values in self.both_sides(name)])
        if not np.isfinite(sizes).any():
            raise ModelError(f"{name} has no value at any {self.ROW}", "see status")
        place = np.unravel_index(first_largest(sizes), sizes.shape)
        where = tuple(map(int, place))
        return Peak(float(np.nanmax(sizes)), where[0] if len(where) == 1 else where)

    def _ipython_key_completions_(self) -> list[str]:
        return self.keys()

    @property
    def subject(self) -> str:
        """Subject of the answer, for its one-line representation."""
        m = self.mechanism  # type: ignore[attr-defined]
        return repr(m.title or "a mechanism")

    @property
    def extent(self) -> str:
        """Numbers of rows, and of positions of each."""
        rows, *rest = np.shape(self.codes)
        return " of ".join([counted(rows, self.ROW), *(counted(n, "position") for n in rest)])

    @property
    def outcome(self) -> str:
        """Counts by status."""
        counts = Counter(np.ravel(np.asarray(self.codes, object)).tolist())
        return ", ".join(f"{n:,} {status}" for status, n in counts.items())

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.subject}: {self.extent}, {self.outcome}>"


def counted(n: int, what: str) -> str:
    """A number of things.

    >>> counted(1, "design"), counted(2000, "design")
    ('1 design', '2,000 designs')
    """
    return f"{n:,} {what}{'' if n == 1 else 's'}"


def _sizes(values: Array, rank: int) -> Array:
    """Magnitudes along the leading axes."""
    if values.ndim <= rank:
        return np.abs(values)
    return np.asarray(np.sqrt((values**2).sum(axis=tuple(range(rank, values.ndim)))))
