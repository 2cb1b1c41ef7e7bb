"""Checks that springs have a direction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import arc
from dalembert.analysis.status.closure_failure import quantity_text
from dalembert.arrays import Flags, Ints
from dalembert.core.forcing import away, pushes_at_zero_length

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.core.layout import Pose


def find_undefined_springs(c: Compiled, pose: Pose) -> Flags:
    """Preloaded springs (P, k) whose ends coincide, so that their force has no direction."""
    springs = c.forcing.springs
    short = away(c.layout, springs, pose) <= 0
    return np.asarray(short & pushes_at_zero_length(springs))


def undefined_sentence(c: Compiled, undefined: Flags, run: Ints) -> str:
    """Sentence on the springs that have no direction, with their force."""
    names = list(c.mechanism.loads_on("span"))
    pushed = np.flatnonzero(undefined[run].any(axis=0))
    springs = c.forcing.springs
    push = springs.stiffness * springs.free_length - springs.force
    figures = " and ".join(f"{names[k]} ({quantity_text(c, 'force', abs(float(push[k])))})" for k in pushed)
    many, compressed = len(pushed) > 1, bool((springs.force[pushed] == 0).all())
    verb = f"push{'' if many else 'es'}" if (push[pushed] > 0).all() else f"pull{'' if many else 's'}"
    return (
        f"The ends of spring{'s' * many} {figures} coincide{arc(c, run)}: "
        f"{'compressed to' if compressed else 'of'} no length, {'they' if many else 'it'} {verb} in no direction, and "
        "just before and after in opposite ones. Step over this position, "
        f"{'move' if compressed else 'or move'} an end off the other's path{', or give no free_length' * compressed}."
    )
