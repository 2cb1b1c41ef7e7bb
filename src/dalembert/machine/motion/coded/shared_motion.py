"""One equation for the motions of many designs.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from dalembert.machine.motion.actuation import actuation
from dalembert.machine.motion.equation import Equation
from dalembert.machine.motion.equation_trace import equation_of_design, shared_equation
from dalembert.model import Mechanism


@dataclass(frozen=True)
class SharedMotion:
    """The common part of the motions of many designs: the equation for any numbers at the paths ``vary``."""

    mechanism: Mechanism
    vary: tuple[str, ...]

    @cached_property
    def _paths(self) -> tuple[str, ...]:
        """Those in the equation: starts and what acts on drives are not."""
        return tuple(path for path in self.vary if path.split(".")[0] not in ("drives", "start"))

    @cached_property
    def _equation(self) -> Equation | None:
        return shared_equation(actuation(self.mechanism)[0], self._paths)

    def equation_of(self, prescribed: Mechanism) -> Equation | None:
        """The equation of a design; None where it needs a separate one."""
        return self._equation and equation_of_design(self._equation, prescribed, self._paths)
