"""Harmonics of an output by its name, taken from the columns that all writers share."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.columns import columns
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.harmonics import Harmonics, harmonics
from dalembert.machine.shaking import shaking
from dalembert.machine.whole_cycle import turning_angle
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def harmonics_of(r: Result, of: str, orders: int | Sequence[float] = 4) -> Harmonics:
    """Harmonics of the shaking force or moment, or of a column of the outputs, over the first drive's turns."""
    return harmonics(_values(r, of), turning_angle(r), orders)


def _values(r: Result, of: str) -> Array:
    """Values (P,) or, of a name without its component, (P, d)."""
    if of in ("shaking", "shaking force", "shaking moment"):
        found = shaking(r)
        return found.moment if of == "shaking moment" else found.force
    named = {c.name: c.values for c in columns(r)}
    if of in named:
        return named[of]
    vector = [named[f"{of} {axis}"] for axis in "xyz" if f"{of} {axis}" in named]
    if not vector:
        raise ModelError(f"no output is named {of!r}", closest(of, ["shaking", "shaking moment", *named]))
    return np.stack(vector, axis=-1)
