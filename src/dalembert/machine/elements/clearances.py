"""Errors of points by the clearance of pins: a journal lies against its bearing where the joint's force presses it.

e = -c F / |F| is the place of j's centre against i's for a radial clearance c and a force F on j; a point moves by S e
with S its derivative by an offset of the joint, to the first order. Without knowing the force |S| c is the worst case.
A joint between two-force links so acts as a massless link of length c (Chakraborty's and Earles' model).

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import print_scale
from dalembert.analysis.plane_only import refuse_space
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.solution import kinematics
from dalembert.answer.answer import Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice, parts
from dalembert.arrays import Array, Tree, first_largest
from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.printing import Part, TextTable, number
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

STEP = 1e-6
"""Offset of a joint for its derivative, over the mechanism's size."""
FLOATS = 1e-9
"""Part of a joint's largest force below which its journal is pressed nowhere."""


@dataclass(frozen=True, eq=False)
class ClearanceError(Labelled):
    """Error of a point by clearances (P, 2), m, where the forces press the journals; NaN where one is pressed nowhere.

    ``worst`` (P, 2): the largest in x and in y whatever the directions. ``of``: joint -> its part of ``by_force``.

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2)
    >>> x = da.clearance_error(da.dynamics(m), "piston", "B", {"A": 1e-5, "B": 1e-5})
    >>> list(x.of), x.by_force.shape
    (['A', 'B'], (72, 2))
    """

    result: Result = field(repr=False)
    link: str
    point: str
    clearances: dict[str, float]
    by_force: Array = field(repr=False)
    worst: Array = field(repr=False)
    of: dict[str, Array] = field(repr=False)
    single: dict[str, Array] = field(repr=False)

    @property
    def described(self) -> Any:
        """The description of what was analysed."""
        return self.result.mechanism

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The drives' positions, and both errors."""
        r = self.result
        for drive in r.drives:
            yield Column(f"drive.{drive}", drive_kinds(r, drive)["position"], r.drive_position(drive))
        name = f"play.{self.link}.{self.point}"
        for of, values in ((name, self.by_force), (f"{name}.worst", self.worst)):
            for part, component in parts(values):
                yield Column(f"{of}{part}", "length", component)

    def record(self, to: Scale) -> Tree:
        """Clearances, and the largest parts by joint."""
        return {
            "clearance": {
                n: {
                    "clearance": to("length", c),
                    "largest": to("length", float(np.nanmax(np.hypot(*self.of[n].T)))),
                }
                for n, c in self.clearances.items()
            }
        }

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """The largest error by force and at worst, and each joint's part."""
        to = print_scale(self.result, units)
        unit, rows = to.text("length"), []
        for name, c in self.clearances.items():
            size, worst = np.hypot(*self.of[name].T), np.hypot(*self.single[name].T)
            known = np.isfinite(size).any()
            k = first_largest(size) if known else 0
            shown = number(float(to("length", size[k])), 4) if known else "-"
            at = where(self.result, to, k) if known else "-"
            rows.append(
                [name, to.number("length", c), shown, at, number(float(to("length", worst.max())), 4)]
            )
        heads = [
            "clearance\nof",
            f"radial\n{unit}",
            f"error by force\n{unit}",
            "where\n",
            f"at worst\n{unit}",
        ]
        yield TextTable(heads, rows)
        for k, axis in enumerate("xy"):
            low, high = (float(f(self.by_force[:, k])) for f in (np.nanmin, np.nanmax))
            both = f"{number(float(to('length', low)), 4)} to {number(float(to('length', high)), 4)} {unit}"
            most = number(float(to("length", self.worst[:, k].max())), 4)
            yield f"{self.link}.{self.point} in {axis}: {both} by the forces, at worst {most} {unit} to either side."


def clearance_error(
    r: Result, link: str, point: str, clearances: Mapping[str, float] | None = None
) -> ClearanceError:
    """Error of a point by the radial clearances of pins, by default the `clearance` of each pin of the file.

    Raises ModelError in space, for joints that are not pins, and where no pin has a clearance.

    >>> import dalembert as da
    >>> x = da.clearance_error(da.dynamics(da.slider_crank(crank=0.05, rod=0.2)), "piston", "B", {"A": 1e-5, "B": 1e-5})
    >>> bool((abs(x.by_force[:, 0]) <= x.worst[:, 0] * (1 + 1e-9)).all()), x.worst.shape
    (True, (72, 2))
    """
    m = r.mechanism
    refuse_space(m, "an error by clearances", "write the joint's offset as points")
    r.point(link, point)
    named = {n: float(getattr(j, "clearance", 0.0)) for n, j in m.joints.items()}
    known = {n: c for n, c in named.items() if c} if clearances is None else dict(clearances)
    if not known:
        raise ModelError("no pin has a clearance", "give one: joints: {A: {type: pin, clearance: 0.05 mm}}")
    for name in known:
        if name not in m.joints:
            raise ModelError(f"unknown joint {name!r}", closest(name, [*m.joints]))
        if not hasattr(m.joints[name], "clearance"):
            raise ModelError(f"joint {name!r} is not a pin", "give clearances of pins", ("joints", name))
    count = len(r.status)
    by_force, worst = np.zeros((count, 2)), np.zeros((count, 2))
    of, single = {}, {}
    for name, c in known.items():
        slope = derivative(r, link, point, name)
        force = r.reaction(name)
        size = np.hypot(*force.T)
        with np.errstate(all="ignore"):
            toward = np.where((size > FLOATS * np.nanmax(size))[:, None], -force / size[:, None], np.nan)
        of[name] = np.einsum("pij,pj->pi", slope, c * toward)
        single[name] = c * np.linalg.norm(slope, axis=2)
        by_force, worst = by_force + of[name], worst + single[name]
    return ClearanceError(r, link, point, known, by_force, worst, of, single)


def derivative(r: Result, link: str, point: str, joint: str) -> Array:
    """Derivative (P, 2, 2) of a point's place by the offset of j's centre from i's of a joint, both in ground axes."""
    m, h = r.mechanism, STEP * r.compiled.layout.length
    i = m.joints[joint].links[0]
    turn = np.tile(np.eye(2), (len(r.status), 1, 1)) if i == GROUND else r.rotation(i)
    columns = []
    for k in (0, 1):
        ends = [_moved(m, joint, [s * h if n == k else 0.0 for n in (0, 1)]) for s in (1, -1)]
        high, low = (kinematics(e, r.schedule.position).point(link, point) for e in ends)
        columns.append((high - low) / (2 * h))
    local = np.stack(columns, axis=-1)  # by offsets in i's axes
    return np.asarray(np.einsum("pik,pjk->pij", local, turn))


def _moved(m: Mechanism, joint: str, offset: list[float]) -> Mechanism:
    """The mechanism with a joint's centre on i moved in i's axes; other joints and loads at it stay."""
    described = m.joints[joint]
    i, name = described.links[0], described.point_names(joint)[1]
    place = tuple(a + b for a, b in zip(m.joint_points(joint)[0], offset, strict=True))
    moved = joint
    while moved in m.links[i].points:
        moved += "_"
    link = m.links[i].model_copy(update={"points": {**m.links[i].points, moved: place}})
    new = described.model_copy(update={"at": (moved, name)})
    return m.model_copy(update={"links": {**m.links, i: link}, "joints": {**m.joints, joint: new}})
