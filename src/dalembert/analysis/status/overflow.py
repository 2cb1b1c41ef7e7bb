"""Numbers that are too large for the arithmetic: reported by quantity instead of infinities."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import link_spans
from dalembert.analysis.friction.friction_status import arc
from dalembert.arrays import Array, Flags, Ints

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces


LONGEST = 1e150
"""Distances between joints (m) above which their squares and products overflow; below the reciprocal they vanish."""


SURE = (1e10 / LONGEST, LONGEST / 1e10)
"""Mean lengths at which no link comes near them."""


def size_sentence(c: Compiled) -> str | None:
    """Sentence on links whose squared lengths the arithmetic cannot represent; None where it can."""
    if SURE[0] < c.layout.length < SURE[1]:
        return None
    m = c.mechanism
    spans = link_spans(m, {name: m.joint_points(name) for name in m.joints})
    long = [link for link, span in spans.items() if not span <= LONGEST]
    if (not long and max(spans.values(), default=0.0) * LONGEST >= 1) or not any(spans.values()):
        return None
    which = long or [link for link, span in spans.items() if span > 0]
    limit = f"more than {LONGEST:g} m" if long else f"less than {1 / LONGEST:g} m"
    return (
        f"The joints of {', '.join(which)} are {limit} apart: the squares of such lengths exceed the range of "
        "numbers. A coordinate, or its unit, is probably wrong by many powers of ten: correct it."
    )


def fast(twist: Array, acceleration: Array) -> Flags:
    """True for links (P, L) whose rates, their squares or their accelerations are not finite."""
    return np.asarray(~(np.isfinite(twist * twist) & np.isfinite(acceleration)).all(axis=-1))


def strong(f: SolvedForces) -> Flags:
    """True for joints (P, joints) whose reactions are not finite."""
    moment = f.moment.reshape(*f.force.shape[:2], -1)
    return np.asarray(~(np.isfinite(f.force).all(axis=-1) & np.isfinite(moment).all(axis=-1)))


def not_finite(f: SolvedForces) -> Flags:
    """True at positions (P,) where a reaction, an effort, a load or a check is not finite."""
    single = (f.effort, f.load, f.residual[:, None], f.power_balance[:, None])
    return np.asarray(strong(f).any(axis=1) | ~np.isfinite(np.concatenate(single, axis=1)).all(axis=1))


OVERFLOW = (
    "{whose} exceed 1.8e308{arc}, the largest number there is (SI). A speed, mass, length or load, or its unit, "
    "is probably wrong by many powers of ten: correct it."
)
OF, CHECKS = "The {what} of {names}", "The {what} or the powers they are checked by"
RATES, FORCES = "rates or accelerations", "forces"


def overflow_sentence(c: Compiled, what: str, names: tuple[str, ...], overflows: Flags, run: Ints) -> str:
    """Sentence on the links or joints whose numbers overflow; if none, on the checks that do."""
    of = ", ".join(
        name for name, bad in zip(names, np.atleast_1d(overflows[run].any(axis=0)), strict=True) if bad
    )
    whose = OF.format(what=what, names=of) if of else CHECKS.format(what=what)
    return OVERFLOW.format(whose=whose, arc=arc(c, run))
