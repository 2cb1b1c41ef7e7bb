"""Laws of motion of prescribed drives, piece by piece: their acceleration may jump where two pieces join.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.motion.equation import StoppedError
from dalembert.model.drives.expression_laws import ExpressionLaw
from dalembert.model.drives.laws import Law, Rise, TimeTable
from dalembert.model.drives.programmes import Programme


@dataclass
class PrescribedLaw:
    """A drive's law over time; ``end``: of the piece that a motion is on, behind which it is not looked."""

    drive: str
    law: Law
    end: float = np.inf

    def __post_init__(self) -> None:
        if isinstance(self.law, Programme) and self.law.over:
            raise ModelError(
                f"the law of drive {self.drive!r} is over another drive, and forces move the machine",
                "write it over time, or prescribe all drives",
                ("drives", self.drive, "law"),
            )

    @cached_property
    def joints(self) -> Array:
        """Instants at which two pieces join, those of one period where it repeats."""
        if isinstance(self.law, Programme):
            return np.asarray(self.law.curve.times)
        if isinstance(self.law, Rise):
            return np.array([0.0, self.law.duration])
        return np.asarray(self.law.time) if isinstance(self.law, TimeTable) else np.zeros(0)

    @property
    def period(self) -> float:
        """Time after which it repeats; infinite where it does not."""
        return float(np.ptp(self.joints)) if getattr(self.law, "periodic", False) else np.inf

    def next_joint(self, t: float) -> float:
        """The first joint after a time."""
        turn = np.floor((t - self.joints[0]) / self.period) * self.period if np.isfinite(self.period) else 0.0
        every = np.concatenate([self.joints + turn, self.joints[1:] + turn + self.period])
        later = every[every > t * (1 + 1e-14)]
        return float(later.min(initial=np.inf))

    def at(self, t: float) -> Array:
        """Position, speed and acceleration; at the end of the piece those before it."""
        law, before, x = self.law, t >= self.end, min(t, self.end)
        if isinstance(law, Programme):
            return np.asarray(law.curve.at(x, before=before)[:3])
        if isinstance(law, Rise):
            return self._of_rise(law, x, before)
        if isinstance(law, ExpressionLaw):
            return law.at(x)
        if not self.joints[0] <= x <= self.joints[-1] and np.isinf(self.period):
            raise StoppedError(f"the law of {self.drive} ends at {self.joints[-1]:g} s")
        return np.asarray(law.at(x))

    @staticmethod
    def _of_rise(law: Rise, t: float, before: bool) -> Array:
        if 0 <= t < law.duration or (before and t <= law.duration):
            return np.array([float(x[0]) for x in law.at(np.array([t / law.duration]))])
        return np.array([law.start if t < 0 else law.stop, 0.0, 0.0])
