"""What springs need besides their numbers: a direction."""

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


def undefined_sentence(c: Compiled, found: Flags, run: Ints) -> str:
    """Which springs have no direction, and how hard they push."""
    names = list(c.mechanism.loads_on("span"))
    pushed = np.flatnonzero(found[run].any(axis=0))
    springs = c.forcing.springs
    figures = " and ".join(
        f"{names[k]} ({quantity_text(c, 'force', float(springs.stiffness[k] * springs.free_length[k]))})"
        for k in pushed
    )
    many = len(pushed) > 1
    return (
        f"The ends of spring{'s' * many} {figures} coincide{arc(c, run)}: compressed to no length, "
        f"{'they push' if many else 'it pushes'} in no direction, and just before and after in opposite ones. "
        "Step over this position, move an end off the other's path, or give no free_length."
    )
