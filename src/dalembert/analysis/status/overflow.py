"""Where numbers are too large for the arithmetic: said, with what they are of, in place of infinities."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_status import arc
from dalembert.arrays import Array, Flags, Ints

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import Forces


def fast(twist: Array, acceleration: Array) -> Flags:
    """Links (P, L) whose rates, their squares or their accelerations are no numbers."""
    return np.asarray(~(np.isfinite(twist * twist) & np.isfinite(acceleration)).all(axis=-1))


def strong(f: Forces) -> Flags:
    """Joints (P, joints) whose reactions are no numbers."""
    moment = f.moment.reshape(*f.force.shape[:2], -1)
    return np.asarray(~(np.isfinite(f.force).all(axis=-1) & np.isfinite(moment).all(axis=-1)))


def not_finite(f: Forces) -> Flags:
    """Positions (P,) where a reaction, an effort, a load or what checks them is no number."""
    single = (f.effort, f.load, f.residual[:, None], f.power_balance[:, None])
    return np.asarray(strong(f).any(axis=1) | ~np.isfinite(np.concatenate(single, axis=1)).all(axis=1))


def overflow_sentence(c: Compiled, what: str, names: tuple[str, ...], found: Flags, run: Ints) -> str:
    """Of which links or joints numbers overflow; of none, what checks them."""
    of = ", ".join(
        name for name, bad in zip(names, np.atleast_1d(found[run].any(axis=0)), strict=True) if bad
    )
    whose = f"The {what} of {of} exceed" if of else f"The {what} or the powers they are checked by exceed"
    return (
        f"{whose} 1.8e308{arc(c, run)}, the largest number there is (SI). A speed, mass, length or load, or its unit, "
        "is probably wrong by many powers of ten: correct it."
    )
