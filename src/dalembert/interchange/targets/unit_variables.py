"""Variables of a functional mock-up unit in the order of their references, and where its C functions find them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from dalembert.interchange.targets.target_variables import TargetFunction, TargetVariable


@dataclass(frozen=True)
class UnitVariable:
    """A variable with its causality; a state begins at ``start``, a derivative has the reference of its state."""

    of: TargetVariable
    causality: str
    is_state: bool = False
    derivative_of: int | None = None

    @property
    def initial(self) -> str | None:
        """FMI's word for its value at the start; None of an input."""
        if self.causality == "input":
            return None
        return "exact" if self.is_state or self.causality == "parameter" else "calculated"


@dataclass(frozen=True)
class UnitLayout:
    """Variables (references from 1 on; 0 is the time), and references of the function's numbers and channels.

    Of forward dynamics: ``terms``, the C of another function, references of its channels, and nominal positions of the
    drives (D,).
    """

    variables: tuple[UnitVariable, ...]
    numbers: tuple[int, ...]
    channels: tuple[int, ...]
    terms: str = ""
    term_channels: tuple[int, ...] = ()
    nominal: tuple[float, ...] = ()

    def references(self, causality: str) -> list[int]:
        """References of the variables of a causality."""
        return [k + 1 for k, v in enumerate(self.variables) if v.causality == causality]

    @property
    def state_references(self) -> list[int]:
        """References of the states."""
        return [k + 1 for k, v in enumerate(self.variables) if v.is_state]

    @property
    def known(self) -> list[UnitVariable]:
        """The variables before the first that is computed."""
        return [v for v in self.variables if v.initial != "calculated"]


def layout_of(f: TargetFunction) -> UnitLayout:
    """A unit without states: outputs are functions of the inputs at the same instant."""
    variables = [UnitVariable(v, "input") for v in f.inputs]
    variables += [UnitVariable(v, "parameter") for v in f.parameters]
    variables += [UnitVariable(v, "output") for v in f.outputs]
    return UnitLayout(tuple(variables), *places(f, variables))


def places(f: TargetFunction, variables: Sequence[UnitVariable]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """References of the numbers and of the channels of a function, in their order; they are found by name."""
    reference = {v.of.name: k + 1 for k, v in enumerate(variables)}
    numbers = {v.place: reference[v.name] for v in f.parameters}
    numbers |= {-1 - v.place: reference[v.name] for v in f.inputs if v.place < 0}
    channels = {v.place: reference[v.name] for v in f.inputs if v.place >= 0}
    return tuple(numbers[k] for k in sorted(numbers)), tuple(channels[k] for k in sorted(channels))
