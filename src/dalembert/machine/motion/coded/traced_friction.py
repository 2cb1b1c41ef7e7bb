"""Accelerations and dry friction together, as nodes: the equations of ``dry_friction``, solved by the kernel's unrolled
Newton's method.

Accepted where the fixed-point map is proved to be a contraction, so that the solution is the only one, and the last
step is small; elsewhere the accelerations are NaN, and the steps in numpy decide.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    argument,
    bearing,
    sign,
    strength,
    with_strength,
)
from dalembert.kernel.friction_trace import trace_slip
from dalembert.kernel.graph import Graph, Node, trace_array
from dalembert.kernel.program import KernelFlags
from dalembert.machine.motion.rest.dry_friction import Linear, side_margins

SURE = 1e-300
"""Factor of a root that is added: of a negative number it makes the sum no number, of a positive one it changes
nothing."""
Solve = Callable[[Array, Array], Array]
"""Solution of a positive system for several right sides."""


class TracedMotion(NamedTuple):
    """Accelerations and efforts required (D,), friction c z of the contacts (E,), their ``margins`` (2K,); of the
    independent ones (O,) the margin of those that stick, and friction as a part of its limit."""

    a: Array
    effort: Array
    cz: Array
    margins: Array
    room: Array
    part: Array


def traced_senses(contacts: Contacts, own: Ints, rates: Array, chosen: Array) -> Array:
    """Part of each contact (E,) in the direction of its slip, as ``DryFriction.senses``."""
    alone = (contacts.group == contacts.group[:, None]).sum(axis=0) == 1
    sense = np.array(sign(contacts, rates * contacts.reckoned, alone), object)
    sense[own] = chosen
    return np.where(contacts.fixed, -1.0, sense[contacts.leader])


def traced_motion(
    graph: Graph,
    contacts: Contacts,
    own: Ints,
    f: Linear,
    known: tuple[Array, Array, Array, Array],
    sense: Array,
    stuck: Array | None,
    solve: Solve,
    still: Node | None = None,
) -> TracedMotion:
    """The motion from what is ``known``: accelerations (D,) of the prescribed drives, 0 of the ``free`` ones, efforts
    less those that no acceleration needs (D,), inertia (D, D), and which are free; ``stuck`` (O,): 1 of own contacts
    that stick, None where none may; ``still``: 1 where all take their coefficients at rest."""
    a, less, mass, free = known
    a = np.array(a, object)
    right = np.column_stack([less - mass @ a, -f.push])[free]
    ease, change = solve(mass[np.ix_(free, free)], right), np.zeros_like(f.push)
    a[free], change[free] = ease[:, 0], ease[:, 1:]
    r = ContactResponse(f.drift - f.push.T @ a, -f.push.T @ change, f.y + f.ahead @ a, f.h + f.ahead @ change)
    part, held = r, np.zeros(contacts.count)
    if stuck is not None:
        held[own] = 1.0
        held = trace_array(graph, held)
        held[own] = stuck
        part, sense = _sticking(r, held, own, solve), (1.0 - held) * sense
    c = trace_array(graph, strength(contacts, 1.0, sense=sense))
    if still is not None:
        c = c + still * (strength(contacts, 1.0, True, sense) - c)
    z, _, flags = trace_slip(graph, contacts, with_strength(part, c), trace_array(graph, sense), fixed=True)
    cz = (1.0 - held) * c * z
    if stuck is not None:  # the force that keeps the rate of its rate at 0
        needed = -(r.x + (r.change @ cz[:, None])[:, 0])
        cz = cz + held * _held(r, held, own, solve)(needed)
    a, sure = a + (change @ cz[:, None])[:, 0], _sure(graph, flags)
    a[free] = [x + SURE * (sure - 0.5).sqrt() for x in a[free]]
    effort = mass @ a + (f.push @ cz[:, None])[:, 0]
    margins = side_margins(contacts, argument(r, cz))
    return TracedMotion(
        a, effort, cz, margins, *_rooms(contacts, own, r, c, cz, sense, held, stuck is not None)
    )


def _rooms(
    contacts: Contacts,
    own: Ints,
    r: ContactResponse,
    c: Array,
    cz: Array,
    sense: Array,
    held: Array,
    sticks: bool,
) -> tuple[Array, Array]:
    """Margin of the independent contacts that stick, and friction as a part of its limit."""
    if not sticks:
        return np.zeros(0, object), sense[own]
    size = np.array([abs(x) for x in bearing(contacts, argument(r, cz))], object)
    room = held * (strength(contacts, 1.0, True) * size - np.array([abs(x) for x in cz], object))
    least = c * size
    some = np.array([x.positive() for x in least], object)
    return room[own], (sense - held * cz / (some * least + (1.0 - some)))[own]


def _held(r: ContactResponse, held: Array, own: Ints, solve: Solve) -> Callable[[Array], Array]:
    """Friction of the contacts that are held, from what is needed of the rates of their rates; 0 of the others."""
    k = held[own]
    matrix = k[:, None] * r.change[np.ix_(own, own)] * k + np.diag(1.0 - k)

    def forces(needed: Array) -> Array:
        out = np.zeros((len(held), *needed.shape[1:]), object)
        right = (k * needed[own].T).T
        out[own] = solve(matrix, right.reshape(len(own), -1)).reshape(right.shape)
        return (held * out.T).T

    return forces


def _sticking(r: ContactResponse, held: Array, own: Ints, solve: Solve) -> ContactResponse:
    """The response where friction of those held keeps their rates at 0: it follows from the others'."""
    forces, others = _held(r, held, own, solve), 1.0 - held
    all_ = forces(np.column_stack([-r.x, -r.change * others]))
    base, by = all_[:, 0], all_[:, 1:]
    return ContactResponse(r.x, r.change, r.y + (r.h @ base[:, None])[..., 0], r.h * others + r.h @ by)


def _sure(graph: Graph, flags: KernelFlags) -> Node:
    """1 where the solution is the only one and reached, else 0."""

    def all_of(nodes: tuple[Node, ...]) -> Node:
        out = graph.one
        for n in nodes:
            out = out * n.positive()
        return out

    single = all_of(flags.unsure).larger(all_of(flags.sure)) if flags.unsure and flags.sure else graph.one
    return all_of(flags.slips) * single
