"""Corners and jumps of loads and efforts: along a segment of a motion each part is on one side, until an event.

`sign`, `abs`, `min`, `max` and the points of a linear table switch where something passes zero. On one side all is
smooth, a little beyond the corner too, so that a step that meets one keeps its accuracy.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.model.quantities.coordinates import TIME
from dalembert.model.quantities.expression_trees import COMPARISONS, Apply, Functions, nodes, numpy_functions
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.tables import FAR, Table

SWITCHING = ("sign", "abs", "min", "max", *COMPARISONS)
"""Functions of expressions that have a corner or a jump."""
Sides = dict[int, float]
"""Side of each switch, by its order in the expression."""


def has_corners(value: object) -> bool:
    """True if a quantity has corners; those of a table over time are met as instants."""
    if isinstance(value, Expression):
        return any(isinstance(n, Apply) and n.function in SWITCHING for n in nodes(value.tree))
    return isinstance(value, Table) and value.interpolate == "linear" and value.against != TIME


def sided(switch: Callable[[Any], Any]) -> dict[str, Callable[..., Any]]:
    """The functions that have corners, on one side: ``switch(x)`` is 1 or -1 (0 at an unresolved jump).

    >>> sided(lambda x: -1.0)["abs"](0.25)
    -0.25
    """

    def chosen(s: Any, x: Any, y: Any) -> Any:
        return y + (s + 1.0) / 2 * (x - y)

    return {
        "sign": switch,
        "abs": lambda x: switch(x) * x,
        "max": lambda x, y: chosen(switch(x - y), x, y),
        "min": lambda x, y: chosen(-switch(x - y), x, y),
    }


@dataclass
class Sided:
    """A load or effort (``what``) whose switches are each on one of the ``sides``: a sign, of a table the piece."""

    value: Expression | Table
    what: str = ""
    sides: Sides = field(default_factory=dict)
    switches: list[float] = field(default_factory=list)

    def again(self) -> Sided:
        """The same for another motion, its sides not yet known."""
        return Sided(self.value, self.what)

    def at(self, known: Mapping[str, Any]) -> float:
        """The value, every switch on its side, which is that of the first evaluation; ``switches`` are as they are."""
        self.switches = []
        if isinstance(self.value, Table):
            return self._of_table(self.value, known)
        with np.errstate(all="ignore"):
            number = float(self.value.at(known, self._functions))
        return number if np.isfinite(number) else float(self.value.at(known))  # which says what is wrong

    def switch(self, k: int, known: Mapping[str, Any]) -> float:
        """Value that passes zero where a switch changes to its other side."""
        self.at(known)
        return self.switches[k]

    def flip(self, k: int, side: float) -> None:
        """Go over to another side of one switch: of a table to the piece before or behind."""
        if isinstance(self.value, Table):
            self.sides[0] += 1.0 if k else -1.0
        else:
            self.sides[k] = side

    @property
    def beyond(self) -> bool:
        """True past an end of a table that does not repeat."""
        if not isinstance(self.value, Table) or self.value.period is not None or 0 not in self.sides:
            return False
        return self.sides[0] in (0, len(self._pieces[0]) - 2)

    def side(self, k: int) -> float:
        """The side of one switch: 0 not known; in a table it is always within its piece."""
        return 1.0 if isinstance(self.value, Table) else self.sides[k]

    def words(self, k: int, known: Mapping[str, Any]) -> tuple[str | tuple[str, float], ...]:
        """Sentence of an event at which a switch has gone over; empty: no event."""
        return ()

    @property
    def _functions(self) -> Functions:
        return {**numpy_functions(), **sided(self._switch)}

    def _switch(self, x: Any) -> float:
        k = len(self.switches)
        self.switches.append(float(x))
        return self.sides.setdefault(k, float(np.sign(x)))

    def _of_table(self, table: Table, known: Mapping[str, Any]) -> float:
        breaks, (slope, first) = self._pieces
        count, period = len(breaks) - 1, table.period or 0.0
        place = float(known[table.against]) - table.shift
        if 0 not in self.sides:
            turn = np.floor((place - breaks[0]) / period) if period else 0.0
            piece = int(np.searchsorted(breaks, place - turn * period, "right")) - 1
            self.sides[0] = turn * count + min(max(piece, 0), count - 1)
        turn, piece = divmod(int(self.sides[0]), count) if period else (0, int(self.sides[0]))
        low, high = breaks[piece : piece + 2] + turn * period
        self.switches = [place - low, high - place]
        return float(first[piece] + slope[piece] * (place - low)) * table.times

    @cached_property
    def _pieces(self) -> tuple[Array, Array]:
        assert isinstance(self.value, Table)
        breaks, (slope, first) = self.value.pieces()
        if self.value.period is not None:
            return breaks, np.stack([slope, first])
        low, high, held = breaks[0], breaks[-1], self.value.outside != "zero"
        last = first[-1] + slope[-1] * (high - breaks[-2])
        far = FAR * (high - low)
        breaks = np.concatenate([[low - far], breaks, [high + far]])
        return breaks, np.stack([np.pad(slope, 1), np.concatenate([[held * first[0]], first, [held * last]])])
