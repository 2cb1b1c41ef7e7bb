"""The oracle mechanisms in space: numbers for the hand solution beside the tree for the product.

Link axes lie skew to the joints' axes and mass properties are full, so that no convention can be left out unseen.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.oracles.reading import Array
from tests.oracles.space import rods, shafts, spinning
from tests.oracles.space.moving import frame
from tests.oracles.space.parts import (
    Example,
    driven,
    hinge,
    inertia,
    joint,
    link,
    plain,
    skew,
    slender,
    tree,
    turning,
)
from tests.oracles.space.statics import Body, Hinge

CRANK = Hinge(
    (0.0, 0.0, 0.0), frame((0, 0.2, 1), (1, 0, 0)), (0.01, 0.02, 0.0), frame((0.1, 0, 1), (1, 0.3, 0))
)
ROCKER = Hinge(
    (0.1, 0.35, 0.05), frame((1, 0.3, 0.1), (0, 1, 0)), (0.0, 0.01, 0.02), frame((0.1, 1, 0), (1, 0.3, 0))
)
SLIDER = Hinge(
    (0.05, 0.1, 0.05), frame((0.1, 0.1, 1), (1, 0.2, 0.1)), (0, 0.01, 0.02), frame((0.1, 1, 0), (1, 0.3, 0))
)
ROD_A = np.array([0.01, 0.02, 0.03])
ROD_B = ROD_A + 0.4 * np.array([2.0, 3.0, 6.0]) / 7.0
FOLLOWER_PIN, ROD_PIN = np.array([0.2, 1.0, 0.3]), np.cross((0.3, 0.1, 1.0), ROD_B - ROD_A)


def rod_machine(name: str, slides: bool, pinned: bool) -> Example:
    """RSSR, RSSP or, with a universal joint at the follower, RSUR, RSUP."""
    follower = SLIDER if slides else ROCKER
    follower_b = (0.02, 0.03, -0.01) if slides else (0.22, 0.02, 0.11)
    pins = (ROD_PIN, FOLLOWER_PIN) if pinned else (None, None)
    bodies = _rod_bodies(pinned)
    m = rods.RodMachine(CRANK, follower, slides, (0.09, 0.0, 0.03), ROD_A, ROD_B, follower_b, bodies, *pins)
    turn = turning(10.0, 370.0, 9.0, -14.0)
    links = {
        "ground": {"points": {"O": plain(CRANK.at_i), "F": plain(follower.at_i)}},
        "crank": link(bodies["crank"], O=CRANK.at_j, A=m.crank_a),
        "rod": link(bodies["rod"], A=ROD_A, B=ROD_B),
        "follower": link(bodies["follower"], F=follower.at_j, B=follower_b),
    }
    joints = {
        "O": hinge("revolute", "ground", "crank", CRANK),
        "A": joint("spherical", "crank", "rod"),
        "B": joint("universal", "follower", "rod", z=(FOLLOWER_PIN, ROD_PIN))
        if pinned
        else joint("spherical", "follower", "rod"),
        "F": hinge("prismatic" if slides else "revolute", "ground", "follower", follower),
    }
    return Example(
        name,
        tree(links, joints, {"O": driven(10.0, 370.0, turn)}, rods.solve(m, turn)),
        lambda dynamic: rods.solve(m, turn, dynamic),
    )


def _rod_bodies(pinned: bool) -> dict[str, Body]:
    """With spheres at both ends nothing may turn the rod about its own line."""
    middle = 0.4 * ROD_A + 0.6 * ROD_B
    pull = ((0.3 * ROD_A + 0.7 * ROD_B, np.array([12.0, -20.0, 9.0])),)
    push = (((0.1, 0.0, 0.05), np.array([-30.0, 25.0, 40.0])),)
    return {
        "crank": Body(1.0, (0.03, 0.01, 0.02), inertia(1, 0.004)),
        "rod": Body(2.0, middle + np.array([0.02, 0.01, -0.015]), inertia(3, 0.03), pull)
        if pinned
        else Body(2.0, middle, slender(ROD_B - ROD_A, 0.02), pull),
        "follower": Body(1.5, (0.05, 0.06, 0.01), inertia(2, 0.03), push, (np.array([1.0, 2.0, -3.0]),)),
    }


def _input_shaft(n: Array, at: Any) -> tuple[Hinge, Array, Array]:
    """Its bearing, and in its own axes the joint's centre 0.3 m on and a pin across it."""
    own = skew(11)
    first = Hinge(at, frame(n, (0.1, 0.2, 1.0)), (0.02, -0.01, 0.03), own)
    return first, np.asarray(first.at_j) + 0.3 * own[:, 2], own @ [np.cos(0.4), np.sin(0.4), 0.0]


def _shaft(seed: int, length: float) -> shafts.Shaft:
    own, start = skew(seed), np.array([0.01, 0.02, -0.03])
    return shafts.Shaft(own[:, 2], own[:, 0], start, start + length * own[:, 2])


def hooke(name: str, with_cross: bool) -> Example:
    """Hooke's joint, its shafts 34 degrees apart, with a massive cross or as one universal joint."""
    line = np.array([np.cos(0.6), np.sin(0.6) * np.sin(0.5), np.sin(0.6) * np.cos(0.5)])
    first, center, pin = _input_shaft(np.array([1.0, 0.0, 0.0]), (-0.3, 0.0, 0.0))
    output = _shaft(12, 0.25)
    own = skew(13)
    bodies = {
        "input": Body(3.0, (0.02, 0.01, 0.05), inertia(4, 0.02)),
        "output": Body(
            2.0, (0.03, 0.02, -0.02), inertia(5, 0.05), (((0.1, 0, 0.1), (20.0, 5, -30)),), (-8.0 * line,)
        ),
    }
    if with_cross:
        bodies["cross"] = Body(0.4, (0.004, -0.002, 0.003), inertia(6, 0.001))
    m = shafts.Hooke(first, center, pin, line, output, bodies, (own[:, 0], own[:, 1]) if with_cross else None)
    turn = turning(0.0, 360.0, 12.0, 25.0)
    answer = shafts.hooke(m, turn)
    links = {
        "ground": {"points": {"O": plain(first.at_i), "E": plain(answer.reactions["E"].at[0])}},
        "input": link(bodies["input"], O=first.at_j, U=center, P1=center),
        "output": link(bodies["output"], U=output.joint, P2=output.joint, E=output.bearing),
    }
    joints = {"O": hinge("revolute", "ground", "input", first)}
    if with_cross:
        links["cross"] = link(bodies["cross"], P1=(0, 0, 0), P2=(0, 0, 0))
        joints["P1"] = joint("revolute", "input", "cross", z=(pin, own[:, 0]))
        joints["P2"] = joint("revolute", "cross", "output", z=(own[:, 1], output.pin))
    else:
        joints["U"] = joint("universal", "input", "output", z=(pin, output.pin))
    joints["E"] = joint("sphere_in_cylinder", "ground", "output", x=(line, output.axis))
    drives = {"O": driven(0.0, 360.0, turn)}
    return Example(name, tree(links, joints, drives, answer), lambda dynamic: shafts.hooke(m, turn, dynamic))


def double_cardan() -> Example:
    """Three shafts in space, no plane and no phase that would make the speeds equal."""
    along = np.array([np.cos(0.5), np.sin(0.5), 0.0])
    line = np.array([np.cos(0.4), -0.3 * np.sin(0.4), np.sqrt(0.91) * np.sin(0.4)])
    first, center, pin = _input_shaft(np.array([1.0, 0.0, 0.0]), (-0.3, 0.0, 0.0))
    middle, output = _shaft(14, 0.4), _shaft(15, 0.2)
    middle_pin = np.cos(0.9) * middle.pin + np.sin(0.9) * np.cross(middle.axis, middle.pin)
    bodies = {
        "input": Body(3.0, (0.02, 0.01, 0.05), inertia(4, 0.02)),
        "middle": Body(1.2, (0.05, 0.1, -0.02), inertia(7, 0.02), (((0.1, 0.0, 0.1), (4.0, -15.0, 10.0)),)),
        "output": Body(2.0, (0.03, 0.02, -0.02), inertia(5, 0.05), (), (np.array([-9.0, 2.0, 3.0]),)),
    }
    m = shafts.DoubleCardan(
        first, center, pin, along, middle, middle_pin, line, output, bodies, sides=(1, -1)
    )
    turn = turning(0.0, 360.0, 12.0, 25.0)
    answer = shafts.double_cardan(m, turn)
    links = {
        "ground": {"points": {"O": plain(first.at_i), "E": plain(answer.reactions["E"].at[0])}},
        "input": link(bodies["input"], O=first.at_j, U1=center),
        "middle": link(bodies["middle"], U1=middle.joint, U2=middle.bearing),
        "output": link(bodies["output"], U2=output.joint, E=output.bearing),
    }
    joints = {
        "O": hinge("revolute", "ground", "input", first),
        "U1": joint("universal", "input", "middle", z=(pin, middle.pin)),
        "U2": joint("universal", "middle", "output", z=(middle_pin, output.pin)),
        "E": joint("cylindrical", "ground", "output", x=(line, output.axis)),
    }
    drives = {"O": driven(0.0, 360.0, turn)}
    return Example(
        "double_cardan",
        tree(links, joints, drives, answer),
        lambda dynamic: shafts.double_cardan(m, turn, dynamic),
    )


def rotor() -> Example:
    """A shaft whose inertia is skew to its axis and whose centre is off it."""
    near = Hinge((0.2, -0.1, 0.3), frame((0.2, 1.0, 0.1), (1, 0, 0.2)), (0.02, 0.01, -0.04), skew(16))
    far = np.asarray(near.at_j) + 0.5 * near.frame_j[:, 2]
    center = np.asarray(near.at_j) + 0.2 * near.frame_j[:, 2] + np.array([0.01, 0.004, -0.006])
    push = ((center + np.array([0.0, 0.05, 0.0]), np.array([40.0, -10.0, 25.0])),)
    body = Body(12.0, center, inertia(8, 0.4), push, (np.array([1.0, -3.0, 2.0]),))
    m = spinning.Rotor(near, far, body)
    turn = turning(0.0, 360.0, 120.0, 60.0)
    answer = spinning.rotor(m, turn)
    links = {
        "ground": {"points": {"A": plain(near.at_i), "B": plain(answer.reactions["B"].at[0])}},
        "rotor": link(body, A=near.at_j, B=far),
    }
    axes = (near.frame_i[:, 2], near.frame_j[:, 2])
    joints = {
        "A": hinge("spherical", "ground", "rotor", near),
        "B": joint("sphere_in_cylinder", "ground", "rotor", x=axes),
    }
    drives = {"A": {"freedom": "turn", "axis": plain(axes[0]), **driven(0.0, 360.0, turn)}}
    return Example(
        "rotor", tree(links, joints, drives, answer), lambda dynamic: spinning.rotor(m, turn, dynamic)
    )


def chain(name: str, count: int) -> Example:
    """Revolutes in series, each driven: two are a disk on an arm, three a gyroscope in gimbals."""
    names = ["arm", "ring", "disk"][:count]
    hinges = {}
    for k, n in enumerate(names):
        axes = frame(skew(20 + k)[:, 0], (0.3, 1, 0.2))
        hinges[n] = Hinge((0.1 + 0.1 * k, 0.05 * k, 0.2), axes, (0.02, 0.01, 0.03 * k), skew(30 + k))
    bodies = {
        n: Body(2.0 + k, (0.05, 0.02 * k, 0.1), inertia(40 + k, 0.1), (((0.1, 0, 0), (5.0 * k, 20.0, -3)),))
        for k, n in enumerate(names)
    }
    ranges = [(0.0, 360.0), (20.0, 380.0), (10.0, 370.0)][:count]
    turns = [
        turning(*r, w, a) for r, w, a in zip(ranges, (3.0, -20.0, 60.0), (4.0, 30.0, -50.0), strict=False)
    ]
    m = spinning.Chain(hinges, bodies)
    links: dict[str, Any] = {"ground": {"points": {"J1": plain(hinges["arm"].at_i)}}}
    joints: dict[str, Any] = {}
    for k, n in enumerate(names):
        behind = {f"J{k + 2}": hinges[names[k + 1]].at_i} if k + 1 < count else {}
        links[n] = link(bodies[n], **{f"J{k + 1}": hinges[n].at_j}, **behind)
        joints[f"J{k + 1}"] = hinge("revolute", names[k - 1] if k else "ground", n, hinges[n])
    drives = {f"J{k + 1}": driven(*r, turn) for k, (r, turn) in enumerate(zip(ranges, turns, strict=True))}
    return Example(
        name,
        tree(links, joints, drives, spinning.chain(m, turns)),
        lambda dynamic: spinning.chain(m, turns, dynamic),
    )


EXAMPLES = {
    example.name: example
    for example in (
        rod_machine("rssr", False, False), rod_machine("rsur", False, True), rod_machine("rssp", True, False),
        rod_machine("rsup", True, True), hooke("hooke", False), hooke("hooke_with_cross", True), double_cardan(),
        rotor(), chain("disk_on_arm", 2), chain("gyroscope", 3),
    )
}  # fmt: skip
