"""One equation for the motions of many designs.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from dalembert.analysis.batch.tracing.course import in_mode_of
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.result import Result
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

    @cached_property
    def _start(self) -> Result:
        prescribed = actuation(self.mechanism)[0]
        return at_schedule(prescribed, prescribed.schedule(), False)

    def in_mode(self, m: Mechanism) -> Mechanism:
        """A design in the assembly mode of the file where its motion begins; as it is where it begins elsewhere."""
        if m.assembly:
            return m
        return m.model_copy(update={"assembly": in_mode_of(actuation(m)[0], self._start).assembly})
