"""An output of one design over the instants of its motion.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import numpy as np

from dalembert.analysis.batch.over_positions import reduce_positions
from dalembert.arrays import Array


def over_instants(reduce: str | None, values: Array, time: Array, count: int) -> Array:
    """Values (T, ...) at instants (T,), reduced: greatest ones with those of events, else at ``count`` even instants
    from start to end; but for those that are not known, as dry friction leaves them open at rest.

    >>> over_instants("peak", np.array([1.0, np.nan, -3.0]), np.array([0.0, 0.5, 1.0]), 2)
    array(3.)
    """
    known = np.isfinite(values).reshape(len(values), -1).all(axis=1)
    if reduce == "final":
        return np.asarray(values[-1])
    known |= not known.any()  # of none that are known the shape
    end, values, time = time[-1], values[known], time[known]
    if reduce not in ("peak", "envelope"):
        at, shape = np.linspace(0.0, end, count), values.shape[1:]
        columns = [np.interp(at, time, x) for x in values.reshape(len(values), -1).T]
        values = np.stack(columns, axis=-1).reshape(-1, *shape)
    return values if reduce is None else reduce_positions(reduce, values)
