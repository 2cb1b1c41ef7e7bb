"""Limits of drawings: motion without a moving drive; forces that are not unique, or unknown."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

STILL = "draw the mechanism, its free bodies or force polygons"


def refuse_structure(r: Result, what: str) -> None:
    """Raises ModelError for a structure."""
    if not r.drives:
        raise ModelError(f"{what} shows a motion, and a structure has none", STILL)


def refuse_still(r: Result, what: str) -> None:
    """Raises ModelError for a structure, equilibria or a single position, with the requested drawing in the message."""
    refuse_structure(r, what)
    if r.stability is not None:
        raise ModelError(f"{what} shows a motion, and here are equilibrium positions", STILL)
    closed = int(np.isfinite(r.point_array).all(axis=(1, 2)).sum())
    if closed < 2 <= len(r.status):
        many = f"{closed} of {len(r.status)} positions closes" if closed else "no position closes"
        raise ModelError(f"{what} needs two positions, and {many}", "see why: dalembert solve")
    if closed < 2:
        raise ModelError(f"{what} needs two positions", "ask for more: positions=36, or --positions 36")


def doubts(r: Result, k: int, joints: Iterable[str]) -> list[str]:
    """Notes on the reactions of some joints at a position, drawn with their least norm or not at all."""
    names = list(joints)
    known = [n for n in names if np.isfinite(r.least_norm(n)[k]).all()]
    free = [n for n in known if not r.unique(n)[k].all()]
    missing = [n for n in names if n not in known]
    notes = [f"Not unique, drawn with the least norm: the reactions of {', '.join(free)}."] if free else []
    if missing:
        notes.append(f"Not known ({r.status[k]}): the reactions of {', '.join(missing)}.")
    return notes


def has_reactions(r: Result, link: str, k: int) -> bool:
    """True if a link's reactions have values at a position, unique or of least norm."""
    return all(bool(np.isfinite(r.least_norm(n)[k]).all()) for n in on_one(r, link))


def on_one(r: Result, link: str) -> list[str]:
    """Joints of a link."""
    return [name for name in r.joints if link in r.mechanism.joints[name].links]
