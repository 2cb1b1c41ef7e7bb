"""How well the closure equations hold: what is left of the joints' and drives' conditions at each position."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.freedoms import whole_pose
from dalembert.core.closure import gap

if TYPE_CHECKING:
    from dalembert.analysis.result import Result


def closure_gap(r: Result) -> NDArray[Any]:
    """Largest gap of the closure equations (P,), m; angles count as arcs of the mechanism's characteristic length.

    >>> import dalembert as da
    >>> bool(closure_gap(da.kinematics(da.four_bar())).max() < 1e-12)
    True
    """
    found = gap(r.compiled.layout, whole_pose(r), r.compiled.targets)
    return np.asarray(np.abs(found).max(axis=-1, initial=0.0))
