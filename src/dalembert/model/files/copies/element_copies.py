"""Copies of machine elements: what carries a cam, where a shoe is closed."""

from __future__ import annotations

from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.links.link import GROUND


def carrier(c: Any, name: str, links: list[str]) -> float:
    """Angle of the image of the link that carries a cam and its follower, which are both copied."""
    if links[0] not in c.of or links[-1] not in c.of:
        what = f"cam {name!r} is copied without its {'cam' if links[0] not in c.of else 'follower'}"
        raise ModelError(what, "copy both links, or write the joint out", ("of",))
    ends = [j.get("links") for j in c.joints.values()]
    others = (pair for pair in ends if isinstance(pair, (list, tuple)) and links[0] in pair)
    bearing = next((o for pair in others for o in pair if o not in c.of), None)
    return c.image.offset(str(bearing)) if bearing is not None else 0.0


def seat(c: Any, name: str, links: list[str], joint: Tree, new: Tree) -> None:
    """A copied shoe is closed at the image of the angle at which the original is, 0 where none is given."""
    c.require_mirrors(name, GROUND)
    if c.image.mirrored and "side" in joint:
        new["side"] = {"left": "right", "right": "left"}.get(joint["side"], joint["side"])
    known = c.tree.setdefault("assembly", {})
    if links[-1] in c.of and links[-1] not in known:
        c.pose(known, links[-1], 0)
