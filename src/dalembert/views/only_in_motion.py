"""What only a motion has, refused where nothing moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

STILL = "draw the mechanism, its free bodies or force polygons"


def refuse_structure(r: Result, what: str) -> None:
    """Raise ModelError for a structure."""
    if not r.drives:
        raise ModelError(f"{what} shows a motion, and a structure has none", STILL)


def refuse_still(r: Result, what: str) -> None:
    """Raise ModelError for a structure, equilibria or a single position, with what was asked for in the message."""
    refuse_structure(r, what)
    if r.stability is not None:
        raise ModelError(f"{what} shows a motion, and here are equilibrium positions", STILL)
    closed = int(np.isfinite(r.point_array).all(axis=(1, 2)).sum())
    if closed < 2 <= len(r.status):
        many = f"{closed} of {len(r.status)} positions closes" if closed else "no position closes"
        raise ModelError(f"{what} needs two positions, and {many}", "see why: dalembert solve")
    if closed < 2:
        raise ModelError(f"{what} needs two positions", "ask for more: positions=36, or --positions 36")
