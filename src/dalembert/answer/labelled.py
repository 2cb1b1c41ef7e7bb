"""An answer as labelled arrays: xarray and netCDF."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.column import WORD, Axes, Scale, UnitChoice
from dalembert.arrays import Tree
from dalembert.saving import check_installed

if TYPE_CHECKING:
    import xarray

    from dalembert.answer.answer import Answer, Labelled


def column_arrays(answer: Answer, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
    """An array over the rows of each column, with its unit; and the numbers of the rows."""
    row, some = answer.ROWS[:-1], list(answer.columns(axes))
    data: Tree = {}
    for c in some:
        values = np.asarray(c.values[:])
        shown = np.where(values == None, "", values).astype(str) if c.kind == WORD else values  # noqa: E711
        data[c.name] = (row, to(c.kind, shown), {"units": to.text(c.kind) or "1"})
    return data, {row: np.arange(len(some[0].values)) + answer.FIRST}


def dataset(answer: Labelled, units: UnitChoice, axes: Axes) -> xarray.Dataset:
    """The arrays of an answer with what they rest on."""
    check_installed("xarray", "a dataset")
    import xarray

    data, coordinates = answer.labelled(answer.scale(units), axes)
    return xarray.Dataset(data, coords=coordinates, attrs=answer.basis() | {"reaction_axes": axes})
