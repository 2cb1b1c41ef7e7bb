"""Joints with several freedoms as chains of joints with one, with links without mass between them."""

from __future__ import annotations

import numpy as np

from dalembert.errors import ModelError
from dalembert.interchange.joint_coordinates import coordinates, link_velocity, rates, values
from dalembert.interchange.link_graph import Connection, LinkGraph, LinkPart, plain_name
from dalembert.interchange.placements import along, placement, turned
from dalembert.interchange.spanning_tree import SpanningTree, spanning_tree

WHOLE = ("gear", "weld", "revolute", "spherical", "prismatic", "screw")
"""Kinds that are not chains."""

KINDS = {"slide": ("prismatic", "x"), "hinge": ("revolute", "z"), "ball": ("spherical", "x")}
"""Kind of a coordinate -> its joint and the local axis that lies along it."""


def cuttable_tree(graph: LinkGraph) -> SpanningTree:
    """A tree whose loops close at pins, balls, welds or gears where they can: others that are cut become chains."""
    while True:
        tree = spanning_tree(graph)
        chains = [joint for joint in tree.cut if joint.kind not in WHOLE]
        if not chains:
            return tree
        for joint in chains:
            split(graph, joint)


def split(graph: LinkGraph, joint: Connection) -> None:
    """Replace a joint by a chain of joints with one freedom each; raises ModelError for a driven one."""
    if joint.name in {drive.joint for drive in graph.drives.values()}:
        what = f"joint {joint.name!r}, a driven {joint.kind}, would become a chain of joints"
        raise ModelError(what, "drive a pin or a slide")
    if joint.more.get("damping"):
        graph.lose(f"damping of {joint.name!r}")
    one, at, speeds = coordinates(joint.kind), values(graph, joint), rates(graph, joint)
    link, here = joint.links[0], joint.places[0]
    spin = graph.links[link].spin if link in graph.links else np.zeros(3)
    slid = np.zeros(3)
    del graph.joints[joint.name]
    for k, coordinate in enumerate(one):
        kind, main = KINDS[coordinate.kind]
        axes = placement(np.eye(3) if coordinate.kind == "ball" else along(main, coordinate.axis), [0, 0, 0])
        name = plain_name(f"{joint.name} {coordinate.freedom}", graph.joints)
        if k == len(one) - 1:
            places = (here @ axes, joint.places[1] @ axes)
            graph.joints[name] = Connection(name, kind, (link, joint.links[1]), places, line=joint.line)
            return
        world = graph.place(link) @ here
        step = coordinate.axis * at[k]
        if coordinate.kind == "slide":
            moved = placement(np.eye(3), step)
        else:
            moved = placement(turned(coordinate.axis, at[k]), [0, 0, 0])
        rate = world[:3, :3] @ coordinate.axis * speeds[k]
        slid, spin = (slid + rate, spin) if coordinate.kind == "slide" else (slid, spin + rate)
        middle = plain_name(f"{joint.name} {coordinate.freedom}", graph.links)
        place = world @ moved
        velocity = link_velocity(graph, joint.links[0], place[:3, 3]) + slid
        graph.links[middle] = LinkPart(middle, place, line=joint.line, velocity=velocity, spin=spin)
        graph.joints[name] = Connection(name, kind, (link, middle), (here @ axes, axes), line=joint.line)
        link, here = middle, np.eye(4)
