"""The bolts of all joints with a `pin`: shear, pressure on each link, bending, safety."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import print_scale
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree, first_largest
from dalembert.errors import ModelError
from dalembert.machine.elements.pin_stresses import PinStresses, pin
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene


@dataclass(frozen=True, eq=False)
class PinTable(Labelled, Drawn, Worked):
    """Bolts by joint.

    >>> import dalembert as da
    >>> m = da.slider_crank().with_values({"joints.A.pin": {"diameter": "20 mm", "eye": "20 mm", "cheeks": "10 mm"}})
    >>> list(da.pins(da.dynamics(m)).bolts)
    ['A']
    """

    result: Result = field(repr=False)
    bolts: dict[str, PinStresses]

    @property
    def described(self) -> Any:
        """The description of what was analysed."""
        return self.result.mechanism

    def basis(self) -> dict[str, str]:
        """Title, source and assumptions."""
        return super().basis() | self.result.assumptions

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The drives' positions, and force, stresses and moment of each bolt."""
        r = self.result
        for drive in r.drives:
            yield Column(f"drive.{drive}", drive_kinds(r, drive)["position"], r.drive_position(drive))
        for x in self.bolts.values():
            yield from x.columns()

    def record(self, to: Scale) -> Tree:
        """Largest values of each bolt."""
        return {"pins": {joint: x.record(to)["pin"] for joint, x in self.bolts.items()}}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Largest stresses of each bolt with their positions, pressures of the links, safeties."""
        to = print_scale(self.result, units)

        def most(values: Array) -> list[str]:
            if not np.isfinite(values).any():
                return ["-", ""]
            k = first_largest(values)
            return [number(float(to("pressure", values[k])), 4), where(self.result, to, k)]

        def least(values: Array) -> str:
            return number(float(np.nanmin(values)), 4) if np.isfinite(values).any() else "-"

        unit = to.text("pressure")
        rows, pressed = [], []
        for joint, x in self.bolts.items():
            force = to.number("force", float(np.nanmax(x.force)))
            diameter = to.number("length", x.size.diameter)
            bend = [number(float(to("moment", v)), 4) if np.isfinite(v) else "-" for v in (_top(x.moment),)]
            cells = [*most(x.peak_shear), *bend, *most(x.bending), least(x.safety)]
            rows.append([joint, diameter, str(x.planes.shape[1]), force, *cells])
            for link, values in x.pressures.items():
                limit = (x.size.allowed_pressure or np.nan) / values
                pressed.append([joint, link, *most(values), least(limit)])
        heads = ["bolt\nof", f"d\n{to.text('length')}", "shear\nplanes", f"force\n{to.text('force')}"]
        heads += [f"peak shear\n{unit}", "where\n", f"moment\n{to.text('moment')}"]
        yield TextTable([*heads, f"bending\n{unit}", "where\n", "safety,\nyield"], rows)
        if pressed:
            yield TextTable(["bolt\nof", "link\n", f"pressure\n{unit}", "where\n", "safety\n"], pressed, 2)
        yield (
            "Force of a stack: the largest shear. Forces act in the middle of each link, which bends a bolt more than "
            "its fit does; in a fork the eye's pressure is even. Yield: bending, or peak shear by von Mises."
        )
        yield from (
            f"{joint}: least bending with the links in the order {', '.join(x.best)}."
            for joint, x in self.bolts.items()
            if x.best and x.best not in (x.size.stack, (x.size.stack or ())[::-1])
        )

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """Each bolt along its axis to scale with its links, and its bending moment where that is largest."""
        from dalembert.views.machine.pin_view import pin_scene
        from dalembert.views.notation import Notation as Usual

        return [pin_scene(x, notation or Usual()) for x in self.bolts.values()]


def _top(values: Array) -> float:
    return float(np.nanmax(values)) if np.isfinite(values).any() else np.nan


def pins(r: Result, joints: Iterable[str] | None = None) -> PinTable:
    """The bolts of joints, by default of all with `pin`; raises ModelError where there is none.

    >>> import dalembert as da
    >>> size = {"diameter": "20 mm", "eye": "30 mm", "cheeks": "15 mm", "yield_stress": "355 MPa"}
    >>> m = da.slider_crank(crank=0.05, rod=0.2).with_values({"joints.A.pin": size})
    >>> table = da.pins(da.dynamics(m))
    >>> list(table.bolts), bool(table.bolts["A"].safety.min() > 1)
    (['A'], True)
    """
    named = [n for n, j in r.mechanism.joints.items() if getattr(j, "pin", None) is not None]
    names = named if joints is None else [joints] if isinstance(joints, str) else list(joints)
    if not names:
        raise ModelError(
            "no joint has a bolt", "add pin: {diameter: 20 mm, eye: 30 mm, cheeks: 15 mm} to a joint"
        )
    return PinTable(r, {name: pin(r, name) for name in names})
