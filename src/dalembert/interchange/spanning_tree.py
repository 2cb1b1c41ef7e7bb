"""A tree of links from ground, and the joints that are cut: slides and slots stay, pins and balls are cut."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

from dalembert.interchange.link_graph import Connection, LinkGraph, flipped
from dalembert.model import GROUND

LAST = {"spherical": 2, "revolute": 1}
"""Kinds that may be cut -> how soon; gears are never branches."""


@dataclass(frozen=True)
class SpanningTree:
    """Joints in the order in which links are reached, each from the link before; those that are cut."""

    branches: tuple[Connection, ...]
    """The first link of each is ground or a link reached before."""
    turned: frozenset[str]
    """Names of joints whose links changed places: their turns and slides change their signs."""
    cut: tuple[Connection, ...]


def spanning_tree(graph: LinkGraph) -> SpanningTree:
    """The tree whose cut joints are pins and balls where that is possible, else short chains from ground (Prim).

    Drives stay in the tree, so that their coordinates exist.
    """
    driven = {drive.joint for drive in graph.drives.values()}
    order = {name: k for k, name in enumerate(graph.joints)}
    by_link: dict[str, list[Connection]] = {}
    for joint in graph.joints.values():
        if joint.kind != "gear":
            for link in joint.links:
                by_link.setdefault(link, []).append(joint)
    depth, used, branches, turned = {GROUND: 0}, set(), [], set()
    waiting: list[tuple[int, int, int, str]] = []

    def reach(link: str) -> None:
        for joint in by_link.get(link, ()):
            rank = 0 if joint.name in driven else LAST.get(joint.kind, 0)
            heapq.heappush(waiting, (rank, depth[link], order[joint.name], joint.name))

    reach(GROUND)
    while waiting:
        joint = graph.joints[heapq.heappop(waiting)[3]]
        ends = [link in depth for link in joint.links]
        if joint.name in used or all(ends):
            continue
        used.add(joint.name)
        if not ends[0]:
            joint = flipped(joint)
            turned.add(joint.name)
        branches.append(joint)
        depth[joint.links[1]] = depth[joint.links[0]] + 1
        reach(joint.links[1])
    cut = tuple(joint for joint in graph.joints.values() if joint.name not in used)
    return SpanningTree(tuple(branches), frozenset(turned), cut)
