"""Two joints that turn in a fixed ratio, as other programs couple them, as a gear on their axes."""

from __future__ import annotations

import numpy as np

from dalembert.errors import ModelError
from dalembert.interchange.link_graph import Connection, LinkGraph
from dalembert.interchange.placements import inverse, placement
from dalembert.interchange.xml_tree import Element

PARALLEL = 1e-6
"""Axes whose directions differ by less are parallel."""


def coupled_wheels(
    graph: LinkGraph, leader: tuple[str, str], follower: tuple[str, str], ratio: float, at: Element
) -> Connection:
    """A gear between the links that two hinges turn on one carrier: turn of the follower = ratio * turn of the leader.

    Raises ModelError with the line where no pair of pitch circles has that ratio: axes that are not parallel or are
    one line, or equal wheels that would turn in one sense.
    """
    first, second = graph.joints[leader[0]], graph.joints[follower[0]]
    words = f"joints {leader[0]!r} and {follower[0]!r} are coupled in the ratio {ratio:g}"

    def refused(why: str) -> ModelError:
        return at.error(f"{words}: {why}", "leave the coupling out, or draw the wheels or rods that make it")

    if leader[1] != "turn" or follower[1] != "turn" or not ratio:
        raise refused("only two turns make a gear")
    if first.links[0] != second.links[0]:
        raise refused("the axes are not on one link")
    carrier = first.links[0]
    a, b = first.places[0], second.places[0]
    za, zb, line = a[:3, 2], b[:3, 2], b[:3, 3] - a[:3, 3]
    same = float(za @ zb)
    if abs(abs(same) - 1) > PARALLEL:
        raise refused("the axes are not parallel")
    apart = line - za * (za @ line)
    distance = float(np.linalg.norm(apart))
    if distance < 1e-9:
        raise refused("the axes are one line, and no two wheels on it mesh")
    sense = ratio * np.sign(same)  # of the follower about the leader's axis
    if sense == 1:
        raise refused("equal wheels that turn in one sense do not mesh (a parallelogram does this)")
    inner = distance / abs(1 - 1 / sense) if sense > 0 else distance / (1 + 1 / abs(sense))
    radii = [inner, inner / abs(sense)]  # of the leader's and the follower's wheel
    foot = a[:3, 3] + za * (za @ line)  # the leader's centre in the plane of the follower's
    centers = (placement(a[:3, :3], foot), b)
    wheels = tuple(
        inverse(graph.place(joint.links[1])) @ graph.place(carrier) @ center
        for joint, center in zip((first, second), centers, strict=True)
    )
    more = {"radii": radii, **({"internal": True} if sense > 0 else {})}
    links = (first.links[1], second.links[1])
    return Connection("gear", "gear", links, (wheels[0], wheels[1]), more, at.line)
