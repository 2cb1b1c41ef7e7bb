"""What a drawing's forces cannot be taken for: those that are not unique, and those that are not known."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


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
    """Whether a link's reactions have numbers at a position, be it those of least norm."""
    return all(bool(np.isfinite(r.least_norm(n)[k]).all()) for n in on_one(r, link))


def on_one(r: Result, link: str) -> list[str]:
    """The joints of a link."""
    return [name for name in r.joints if link in r.mechanism.joints[name].links]
