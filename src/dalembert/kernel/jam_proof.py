"""A certificate of jamming by Farkas' lemma: weights that prove the equations unsolvable.

Friction of known senses z = -s S has S = S(y0 + K S) >= 0 with K = -H s. S(y) >= e . y for every slope e of S, so any
weights w >= 0 require of a solution

    sum_a w_a e_a . y0_a + sum_b d_b S_b <= 0    with d_b = sum_a w_a e_a . K_ab - w_b

If no d_b is negative and the first sum is positive, no solution exists. A negative d_b is first transferred to the
other contacts by S_b <= |y0_b| + sum_c |K_bc| S_c. Slopes and weights are those along which friction would grow without
bound: S and w after a few multiplications by K and its transpose. The proof is valid for any choice of them.

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.branchless import larger
from dalembert.core.friction.contact_equations import ContactResponse, Contacts, bearing, slope
from dalembert.kernel.graph import Graph, Node, trace_array

TIMES = 3
"""Multiplications by K and by its transpose; twelve prove hardly more."""

MARGIN = 1e-9
"""Margin by which a sum must be positive, relative to its terms."""

LEAST = 1e-30
"""Replacement for 1 - |K_bb| where that is not positive."""


def lever(h: Array, ball: Flags) -> Array:
    """Bound (E, E) of the change of S with each z, from H (3, E, E) without signs: a length is at most 0.586 of the
    larger of its components and 0.415 of both."""
    first, second, third = np.abs(h)
    force = _length(first, second)
    length = _length(force, third) if ball.any() else force
    return np.where(ball[:, None], length, larger(force, third))


def _length(a: Array, b: Array) -> Array:
    return np.asarray(0.586 * larger(a, b) + 0.415 * (a + b))


def jams(graph: Graph, contacts: Contacts, r: ContactResponse, sense: Array) -> Node:
    """Negative where a block of contacts is proved to have no solution; from the response with H after z."""
    contacts, y0, k = _without_signed(graph, contacts, r.y, -r.h * sense)
    s: Array = trace_array(graph, np.ones(y0.shape[1]))
    for _ in range(TIMES):
        y = (k @ s[:, None])[..., 0]
        e, s = slope(contacts, y, np.asarray(graph.zero, object))
    pull = trace_array(graph, (e[..., None] * k).sum(axis=0))  # e_a . K_ab
    w = trace_array(graph, np.ones(len(s)))
    for _ in range(TIMES):
        w = trace_array(graph, larger(w @ pull, 0.0))
    return _prove(graph, w, w @ pull, (e * y0).sum(axis=0), bearing(contacts, y0), lever(k, contacts.ball))


def _without_signed(graph: Graph, contacts: Contacts, y: Array, k: Array) -> tuple[Contacts, Array, Array]:
    """The problem without the contacts whose S has a sign: their S = y is linear and is substituted."""
    signed = contacts.signed
    y, k = trace_array(graph, y), trace_array(graph, k)
    for a in np.flatnonzero(signed):
        row, column = k[0, a].copy(), k[:, :, a].copy()
        over = 1.0 / (1.0 - row[a])
        row[a] = graph.zero
        y = y + column * (over * y[0, a])
        k = k + column[:, :, None] * (over * row)
        k[:, :, a] = graph.zero
    kept = np.flatnonzero(~signed)
    contacts = replace(contacts, signed=signed[kept], ball=contacts.ball[kept])
    return contacts, trace_array(graph, y[:, kept]), trace_array(graph, k[:, kept][:, :, kept])


def _prove(graph: Graph, w: Array, pulled: Array, loads: Array, size: Array, bound: Array) -> Node:
    """Negative where the inequality of the weights has no solution. NaN proves nothing: the maximum of zero and NaN is
    NaN."""
    zero = trace_array(graph, np.zeros(len(w)))
    d = trace_array(graph, pulled - (1 + MARGIN) * w)
    diagonal = np.diag(bound)
    lacking = larger(zero, -d) / larger(np.full(len(w), LEAST), 1.0 - diagonal)
    rest = larger(d, zero) - lacking @ (bound - np.diag(diagonal))
    sum_ = (w * loads).sum() - (lacking * size).sum() - MARGIN * (w * size).sum()
    proved: Any = trace_array(graph, sum_).item().positive()
    for x in trace_array(graph, rest):
        proved = proved * ~((-x).positive())
    return -proved  # type: ignore[no-any-return]
