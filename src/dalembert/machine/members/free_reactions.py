"""What acts on the links of a machine, and which of it equilibrium leaves open.

Mechanics: docs/theory.md 5.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import (
    Action,
    effort_actions,
    joint_actions,
    state,
    unknown_load_actions,
    whole_actions,
)
from dalembert.core.equilibrium import shifts, statement
from dalembert.core.linear import PseudoInverse

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

COMBINATIONS = 3
"""Combinations of the free reactions, drawn at random: what is not unique is zero in all of them never."""


class Acting(NamedTuple):
    """All actions on the links, with least-norm reactions; and reactions and efforts that balance by themselves."""

    known: tuple[Action, ...]
    free: list[tuple[Action, ...]]


def acting(r: Result) -> Acting:
    """Actions, and some of the free ones where not every reaction is unique."""
    least = replace(r, unique_array=None, unique_unknowns=None, unique_in=None)
    out = Acting(whole_actions(least), [])
    if r.unique_array is None:
        return out
    c, s = r.compiled, state(r)
    zero = np.zeros((len(r.status), c.layout.links, c.layout.algebra.n))
    forces = statement(c.layout, c.known, s.pose, s.rows, s.solver, zero).forces
    assert isinstance(forces, PseudoInverse)
    free = forces.null @ np.random.default_rng(0).normal(size=(forces.null.shape[-1], COMBINATIONS))
    shift, _ = shifts(c.layout, s.pose, s.rows, free)
    force, moment = np.split(shift, [c.layout.algebra.d], axis=-2)
    first, asked = c.layout.constraints.count, c.known.asked
    last = first + int(asked.sum())
    for k in range(COMBINATIONS):
        effort = np.zeros_like(r.effort_array)
        effort[:, asked] = free[:, first:last, k]
        way = replace(
            least,
            force_array=force[..., k],
            moment_array=moment[..., k].reshape(r.moment_array.shape),
            effort_array=effort,
            load_array=free[:, last:, k],
        )
        out.free.append((*joint_actions(way, split=False), *effort_actions(way), *unknown_load_actions(way)))
    return out
