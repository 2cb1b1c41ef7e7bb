"""Residual of the closure equations: of the joints' and drives' conditions at each position.

Mechanics: docs/theory.md 3.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.position.newton import gap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def closure_gap(r: Result) -> Array:
    """Largest gap of the closure equations (P,), m; angles count as arcs of the mechanism's characteristic length.

    >>> import dalembert as da
    >>> bool(closure_gap(da.kinematics(da.four_bar())).max() < 1e-12)
    True
    """
    gaps = gap(r.compiled.layout, full_pose(r), r.compiled.targets)
    return np.asarray(np.abs(gaps).max(axis=-1, initial=0.0))
