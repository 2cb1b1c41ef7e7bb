"""Limits of belts and ropes as margins, below zero where one slips or hangs slack; the careful path then answers.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.elements import belt_pulls, strand_rows
from dalembert.core.elements.belt_pulls import BeltPulls
from dalembert.core.friction.capstan import capstan
from dalembert.core.layout import Layout, Pose

LEAST = 1e-9
"""Part of the tight strand's tension that counts as rounding."""


@dataclass(frozen=True)
class RopeGrips:
    """Wheels (W,) that ropes turn by friction: strands before and behind, way and turns as in ``strand_rows.wraps``,
    and the coefficient at rest."""

    before: Ints
    after: Ints
    way: Ints
    turns: Array
    coefficient: Array


def belt_margins(layout: Layout, pulls: BeltPulls | None, pose: Pose, twist: Array, x: Array) -> Array:
    """Margins (..., k) of belts, from multipliers x (..., K): of slip, or of slackness where no friction is given."""
    f = belt_pulls.belts(layout)
    if f is None or pulls is None:
        return np.zeros(0)
    difference = x[..., f.row]
    size = np.abs(difference)
    net = belt_pulls.net_sum(pulls, belt_pulls.belt_speed(layout, f, pose, twist), difference)
    wraps = belt_pulls.wraps(layout, f, pose)
    least = [capstan(pulls.grip + 0 * net, wraps[..., k, :], np.zeros(len(f.row))) for k in (0, 1)]
    out = []
    for k in range(len(f.row)):
        grips = [s[..., k] for s in least] if pulls.gripped[k] else [2.0]
        out += [s * net[..., k] / 2 - size[..., k] + LEAST * np.abs(net[..., k]) for s in grips]
    return np.stack(out, axis=-1)


def rope_margins(layout: Layout, grips: RopeGrips | None, pose: Pose, x: Array) -> Array:
    """Margins (..., S + W) of the strands of ropes, and of the wheels that they turn."""
    f = strand_rows.strands(layout)
    if f is None or grips is None:
        return np.zeros(0)
    tension = x[..., f.row]
    loose = tension + LEAST * np.abs(tension).sum(axis=-1, keepdims=True)
    if not grips.before.size:
        return np.asarray(loose)
    wrap = strand_rows.wraps(layout.algebra, f, pose, grips.before, grips.after, grips.way, grips.turns)
    strength = capstan(grips.coefficient + 0 * wrap, wrap, np.zeros(len(grips.way)))
    a, b = tension[..., grips.before], tension[..., grips.after]
    holds = strength * (a + b) / 2 - np.abs(a - b) + LEAST * np.abs(a + b)
    return np.concatenate([loose, holds], axis=-1)
