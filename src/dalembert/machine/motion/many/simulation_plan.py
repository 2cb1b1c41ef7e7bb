"""Settings of the motion of each design, ``simulate: {until: 2 s, start: ...}`` of a study or an optimization.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Tree
from dalembert.errors import ModelError, errors_at
from dalembert.machine.motion.actuation import read_start
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.occurrences import read_end
from dalembert.machine.motion.simulation import Simulation, check_choices, motion_of
from dalembert.model import Mechanism
from dalembert.model.part import check_keys
from dalembert.units import quantity as read_quantity

KEYS = ("until", "start", "count", "tolerance")


@dataclass(frozen=True)
class SimulationPlan:
    """Settings of the simulation of each design: its end, number of instants, tolerance."""

    until: tuple[str | float, ...]
    count: int = 201
    tolerance: float = 1e-9

    def of(self, m: Mechanism, shared: SharedMotion | None = None) -> Simulation:
        """The motion of one design, with all its events."""
        return motion_of(m, self.until, count=self.count, tolerance=self.tolerance, shared=shared)

    def tree(self) -> Tree:
        """In plain values."""
        return {"until": list(self.until), "count": self.count, "tolerance": self.tolerance}

    def __str__(self) -> str:
        ends = " or ".join(u if isinstance(u, str) else f"{u:g} s" for u in self.until)
        return f"each simulated until {ends}, {self.count} instants"


def read_motion(m: Mechanism, tree: object) -> tuple[Mechanism, SimulationPlan]:
    """Settings in ``simulate:`` of a study; the mechanism with its start."""
    with errors_at("simulate"):
        if not isinstance(tree, Mapping) or "until" not in tree:
            raise ModelError("the motion does not say until when", "write simulate: {until: 2 s}")
        check_keys(tree, list(KEYS))
        until, count, tolerance = tree["until"], tree.get("count", 201), tree.get("tolerance", 1e-9)
        several = (until,) if isinstance(until, (str, int, float)) else tuple(until)
        with errors_at("until"):
            end, _ = read_end(m, several, ())
            if not np.isfinite(end):
                raise ModelError("a motion whose condition is never met has no end", "add a time: [5 s, ...]")
        with errors_at("start"):
            if starts := read_start(m, tree.get("start")):
                m = m.with_values({"start": {**m.start, **starts}})
        with errors_at("count"):
            check_choices(count, 1e-9)
        with errors_at("tolerance"):
            check_choices(2, error := read_quantity(tolerance, "number"))
    return m, SimulationPlan(several, count, error)
