"""Keys that a part of a mechanism of the plane may have, with what they mean: what the studio offers to add."""

from __future__ import annotations

from functools import cache
from typing import Any

from dalembert.arrays import Tree
from dalembert.model.drives.drives import Drive
from dalembert.model.joints.joint_part import JointPart, kinds_of
from dalembert.model.links.link import Link
from dalembert.model.part import LoadPart

DRAWN = frozenset(("type", "links", "at", "points", "on", "between", "joint"))
"""Keys that say what a part belongs to: changed by drawing."""


@cache
def part_keys() -> Tree:
    """Section -> type of the part, empty where it has none -> key -> its meaning.

    >>> part_keys()["joints"]["circular_slot"]["radius"]
    "of the slot's middle line about i's point, a length"
    >>> list(part_keys()["drives"][""])[:2]
    ['freedom', 'position']
    """
    return {
        "links": {"": _keys(Link)},
        "joints": {
            k.model_fields["type"].default: _keys(k) for k in kinds_of(JointPart) if 2 in k.DIMENSIONS
        },
        "loads": {k.model_fields["type"].default: _keys(k) for k in kinds_of(LoadPart)},
        "drives": {"": _keys(Drive)},
    }


def _keys(part: Any) -> dict[str, str]:
    fields = part.model_fields.items()
    return {
        f.alias or name: f.description or ""
        for name, f in fields
        if name not in DRAWN
        and "space" not in (f.description or "")[:9]
        and "refused" not in (f.description or "")
    }
