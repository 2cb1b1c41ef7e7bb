"""Shaking before and after masses are added: the common part of all balancing answers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.answer import Remade
from dalembert.answer.column import Axes, Column, Scale
from dalembert.arrays import Array, Tree
from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.machine.output.sizes_over_cycle import greatest, rms
from dalembert.machine.shaking import Shaking

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


class Comparison(MachineAnswer, Remade):
    """An answer with shaking ``before`` and ``after``; of force and moment the parts of inertia are compared."""

    before: Shaking
    after: Shaking

    @property
    def mechanism(self) -> Mechanism:
        """The description with the added masses in its links' masses, centres and inertias."""
        return self.after.result.mechanism

    def kind(self, name: str) -> str:
        """Kind of a quantity: the torque of a drive that slides is a force."""
        drives, m = self.before.result.drives, self.before.result.mechanism
        slides = name == "torque" and bool(drives) and not m.drives[drives[0]].turns
        return "force" if name == "force" or slides else "moment"

    def sizes(self, after: bool = True) -> dict[str, tuple[float, float]]:
        """Rms and greatest value of force, moment and torque, before or after."""
        values = values_of(self.after if after else self.before)
        return {name: (rms(v), greatest(v)[0]) for name, v in values.items()}

    def sizes_record(self, to: Scale) -> Tree:
        """The same of both by name, in the units of a scale."""
        out: Tree = {"before": {}, "after": {}}
        for side, by_name in out.items():
            for name, both in self.sizes(side == "after").items():
                sizes = (to(self.kind(name), size) for size in both)
                by_name[name] = dict(zip(("rms", "max"), sizes, strict=True))
        return out

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Force, moment and torque before and after, over the positions."""
        yield from self.drive_columns()
        for name, s in (("before", self.before), ("after", self.after)):
            shaking = (c for c in s.columns() if c.name.startswith(("shaking", "inertia")))
            yield from (c._replace(name=f"{name}.{c.name}") for c in shaking)
            for drive in s.result.drives:
                yield Column(
                    f"{name}.effort.{drive}",
                    "moment" if s.result.mechanism.drives[drive].turns else "force",
                    s.result.effort(drive),
                )


def balanced_drive(r: Result) -> str | None:
    """The first drive, whose effort moves added masses too; none where an effort is given and a load moves them."""
    every = not r.unknown_loads and r.compiled.known.requested.all()
    return r.drives[0] if r.drives and every else None


def values_of(s: Shaking) -> dict[str, Array]:
    """Force and moment of inertia, which added masses are to make small, and the effort of the first drive if any.

    No added mass changes a load from outside, so neither that nor the weights are part of what is to be least. Values
    that are rounding beside the forces of the machine are 0.
    """
    r = s.result
    drive = balanced_drive(r)
    torque = {} if drive is None else {"torque": r.effort(drive)}
    out = dict(zip(("force", "moment"), s.parts["inertia"], strict=True)) | torque
    return {name: v if np.abs(v).max(initial=0.0) > s.floor(name) else 0 * v for name, v in out.items()}
