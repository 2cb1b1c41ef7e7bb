"""Results of many designs, with the numbers just after reversals where any occur."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from dalembert.arrays import Array, Flags


@dataclass
class Sides:
    """Marks, outputs and their derivatives by name; ``after``: the same numbers but those just after reversals."""

    code: NDArray[np.uint8]
    arrays: dict[str, Array]
    rates: dict[str, Array]
    after: dict[str, Array] = field(default_factory=dict)
    after_rates: dict[str, Array] = field(default_factory=dict)

    @property
    def finite(self) -> bool:
        """True if all numbers are finite."""
        return all(np.isfinite(a).all() for of in (self.arrays, self.rates) for a in of.values())

    def open_after(self) -> None:
        """Begin with the numbers just before."""
        if not self.after:
            self.after = {name: array.copy() for name, array in self.arrays.items()}
            self.after_rates = {name: rate.copy() for name, rate in self.rates.items()}

    def blank(self, lost: Flags) -> None:
        """Replaces numbers by NaN where unsolved."""
        for arrays in (self.arrays, self.rates, self.after, self.after_rates):
            for array in arrays.values():
                if array.dtype.kind == "f":
                    array[lost] = np.nan
