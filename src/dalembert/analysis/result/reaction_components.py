"""In space: the unknown components of joints' reactions, as the table of pairs names them, and how many there are.

A joint that carries all three forces (or moments) has them along any axes; one that carries fewer has them along its
local axes, marked by a prime: x'. A screw's force along its axis brings its couple with it; the teeth of a gear press
along one line. Mechanics: docs/theory.md 2.2.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import Action
from dalembert.analysis.result.reaction_axes import axes_of
from dalembert.arrays import Array
from dalembert.model.joints.pairs import AXES

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class Component(NamedTuple):
    """One unknown number of a reaction at a position.

    turning: a moment; axis: its letter, with a prime along the joint's axes, empty of a gear; force, couple (3,): of
    one unit of it on the link acted on, at the joint's place, ground axes; value: N or N m.
    """

    turning: bool
    axis: str
    force: Array
    couple: Array
    value: float

    @property
    def in_joint_axes(self) -> bool:
        """True if it has a fixed direction, and is not one of three along any axes."""
        return self.axis not in AXES or not self.axis


def unknown_count(r: Result, joint: str) -> int:
    """Number of constraints of a joint, equal to the number of unknown components of its reaction."""
    return int((r.compiled.layout.constraints.joint == r.joints.index(joint)).sum())


def components(r: Result, a: Action, k: int, axes: Array) -> tuple[Component, ...]:
    """The unknown components of a joint's action on a link at position k; three of a kind along ``axes`` (3, 3)."""
    described: Any = r.mechanism.joints[a.of]
    if described.wheels:
        size = math.hypot(*a.force[k])
        unit = a.force[k] / size if size else np.zeros(3)
        return (Component(False, "", unit, np.zeros(3), size),)
    pair, out = described.pair, []
    for turning, letters, vector in ((False, pair.forces, a.force[k]), (True, pair.moments, a.couple[k])):
        full = letters == AXES and not pair.threaded
        rows = axes if full else axes_of(r, a.of, "joint", turning)[k]
        for letter in letters:
            e = rows[AXES.index(letter)]
            force, couple = (np.zeros(3), e) if turning else (e, np.zeros(3))
            if pair.threaded and not turning and letter == "x":
                couple = -described.lead / (2 * math.pi) * e
            name = letter if full else f"{letter}'"
            out.append(Component(turning, name, force, couple, float(vector @ e)))
    return tuple(out)


def remainder(a: Action, k: int, some: tuple[Component, ...]) -> tuple[Array, Array]:
    """Force and couple (3,) of a joint's action that no unknown component makes: damping within the reaction."""
    force = a.force[k] - sum((c.value * c.force for c in some), np.zeros(3))
    couple = a.couple[k] - sum((c.value * c.couple for c in some), np.zeros(3))
    return force, couple
