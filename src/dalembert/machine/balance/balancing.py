"""`da.balance`: counterweights that leave least of the shaking force, moment or torque, and the proof of it.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import dynamics
from dalembert.answer.column import Scale
from dalembert.arrays import Array, Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.machine.balance.balance_problem import BalanceProblem, Solved
from dalembert.machine.balance.comparison import Comparison, balanced_drive, values_of
from dalembert.machine.balance.counterweights import (
    Counterweight,
    Wanted,
    base_point,
    counterweights,
    with_masses,
)
from dalembert.machine.balance.mass_columns import mass_columns, numbers_of
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.machine.shaking import About, Shaking, shaking
from dalembert.machine.whole_cycle import over_a_turn, refuse_unknown
from dalembert.model import GROUND, AtPositions, Mechanism, ModelOrPath, as_mechanism
from dalembert.wording import quote_value

Least = Literal["rms", "max"]
QUANTITIES = ("force", "moment", "torque")
if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene

Of = str | Mapping[str, float]
COMPLETE = 1e-9
"""Relative force below which the balance is complete."""


@dataclass(frozen=True)
class PlacedWeight:
    """An optimal counterweight: mass (kg), centre (d,) and inertia about it (kg m2, in space (3, 3)), in link axes; m r
    (kg m) and in the plane its angle (rad) from the base point; radius of its disc, if it is one."""

    mass: float
    center: Array
    inertia: float | Array
    moment: float
    angle: float | None
    radius: float | None = None


@dataclass(frozen=True, eq=False)
class Balance(Comparison):
    """Counterweights by link, the remaining shaking, and the proof that no others leave less.

    ``before``, ``after``: shaking without and with them. ``numbers`` (W, N): of each m, m x, m y and I about its base
    point, in space (m, m x, m y, m z, int xx dm, yy, zz, xy, xz, yz). ``bound``: no counterweights within the bounds
    leave less than this part of the value of ``of`` before; ``value``: the part that these leave; their difference is
    the ``gap``. ``residual``: difference of a re-analysis with them.
    """

    result: Result = field(repr=False)
    weights: dict[str, Counterweight]
    least: Least
    of: dict[str, float]
    placed: dict[str, PlacedWeight]
    numbers: Array = field(repr=False)
    value: float
    bound: float
    before: Shaking = field(repr=False)
    after: Shaking = field(repr=False)
    residual: float
    problem: BalanceProblem = field(repr=False)

    @property
    def gap(self) -> float:
        """Largest possible improvement by other counterweights, relative to the value before."""
        return max(self.value - self.bound, 0.0)

    @property
    def complete(self) -> bool:
        """True if the inertia force is zero: full force balance."""
        before, after = (greatest(s.parts["inertia"][0])[0] for s in (self.before, self.after))
        return after <= max(COMPLETE * before, self.before.floor("force"))

    def trade_off(self, other: str, count: int = 9) -> list[tuple[float, float]]:
        """Pairs (of, other), parts of what they were before, none of which can be bettered in both.

        From the least of ``of`` to the least of the other, by weights cos and sin of even angles.
        """
        require("count", count)
        _wanted({other: 1.0}, self.result)
        out = []
        for angle in np.linspace(0.02, math.pi / 2 - 0.02, count):
            weights = {n: w * math.cos(angle) for n, w in self.of.items()}
            weights[other] = weights.get(other, 0.0) + math.sin(angle)
            solved = self.problem.solve(self.least, weights)
            out.append((self.problem.part(self.least, self.of, solved.parts), solved.parts[other]))
        return out

    @property
    def only_bounds(self) -> bool:
        """True if only their bounds prevent these counterweights from balancing the force completely."""
        return _force_left(self.result, [*self.weights]) < COMPLETE

    def missing(self) -> list[str]:
        """Links that also need a counterweight for full force balance; empty where it exists or is impossible."""
        if self.complete or self.only_bounds or _force_left(self.result, [*self.result.links]) >= COMPLETE:
            return []
        joints = self.result.mechanism.joints.values()
        held = {link for joint in joints if GROUND in joint.links for link in joint.links}
        needed = [link for link in self.result.links if link not in self.weights]
        for link in sorted(
            needed, key=lambda link: link in held
        ):  # a pivot on the ground is the first place for one
            fewer = [other for other in needed if other != link]
            needed = fewer if _force_left(self.result, [*self.weights, *fewer]) < COMPLETE else needed
        return needed

    def record(self, to: Scale) -> Tree:
        """Its other numbers by name, in the units of a scale."""
        kinds, weights = {"mass": "mass", "center": "length", "inertia": "inertia"}, dict[str, Tree]()
        for link, p in self.placed.items():
            weights[link] = {name: to(kind, getattr(p, name)) for name, kind in kinds.items()}
            weights[link]["moment"] = to("mass", to("length", p.moment))
            weights[link]["angle"] = None if p.angle is None else to("angle", p.angle)
        out: Tree = {
            "least": self.least,
            "of": self.of,
            "about": self.before.about,
            "complete": self.complete,
        }
        out["counterweights"] = weights
        out |= self.sizes_record(to) | {
            name: getattr(self, name) for name in ("value", "bound", "gap", "residual")
        }
        return {"balance": out | {"missing": self.missing()}}

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.balance_text import balance_parts

        return balance_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.cycle_views import balance_scenes

        return balance_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.design_sections import balance_section

        balance_section(sheet, self, shown)


def balance(
    m: ModelOrPath | Result,
    weights: Wanted,
    least: str = "rms",
    of: Of = "force",
    about: About = None,
    positions: AtPositions = None,
) -> Balance:
    """Counterweights on links that leave least of the shaking force, moment, torque, or a weighted sum, over the cycle.

    ``weights``: links, or by link the bounds of a `Counterweight`. ``least``: the aim, ``rms shaking_force``, or
    ``peak`` (or ``max``) for the greatest value over the positions, of ``shaking_force``, ``shaking_moment`` (about
    ``about``) or the effort of the first drive, ``effort.O2``. ``of``: the same quantities in short, `force`, `moment`
    or `torque`, where ``least`` is its first word alone; or weights of these, {"force": 1, "torque": 0.5}, each as a
    part of what it was before; rms values add up by their squares, greatest values as they are. Force and moment are
    those of inertia: weights and loads from outside do not count in them, as no counterweight balances a load, but in
    the torque. What was 0 before has no part and does not count.
    Convex and exact for all harmonics; a weight not needed is 0. Raises ModelError for bounds that mean nothing, and in
    a plane that turns.
    Berkof and Lowen, J. Eng. Ind. 91 (1969); Demeulenaere, Verschuure et al. (2004) for the convex form.

    >>> import dalembert as da
    >>> m = da.four_bar(ground=0.4, crank=0.1, coupler=0.35, rocker=0.3)
    >>> found = da.balance(m.with_values({"links.crank.mass": 1.0}), ["crank", "rocker"])
    >>> found.complete, bool(found.gap < 1e-9)
    (True, True)
    """
    r = m if isinstance(m, Result) else _over_a_cycle(as_mechanism(m), positions)
    if r.mechanism.turning is not None:
        what = "counterweights in a plane that turns are pulled outward too, which is not balanced"
        raise ModelError(what, "balance the mechanism without `turning`", ("turning",))
    least, of = _aim(least, of, r)
    wanted, allowed, before = _wanted(of, r), counterweights(r.mechanism, weights), shaking(r, about)
    base = {name: v.reshape(len(v), -1) for name, v in values_of(before).items()}
    refuse_unknown(r, "balancing needs every position", *base.values(), r.acceleration_array)
    columns = mass_columns(r, allowed, before.point, balanced_drive(r))
    problem = BalanceProblem(base, columns.of, tuple(allowed.items()), columns.axes)
    solved = problem.solve(least, wanted)
    numbers = solved.numbers.reshape(len(allowed), -1)
    placed = {link: _placed(r, link, w, p) for (link, w), p in zip(allowed.items(), numbers, strict=True)}
    masses = {link: [(p.mass, p.center, p.inertia)] for link, p in placed.items()}
    after = shaking(at_schedule(with_masses(r.mechanism, masses), r.schedule, r.inertia), about)
    off = _difference(after, solved, problem)
    proof = solved.value, solved.bound, before, after, off
    return Balance(r, allowed, least, wanted, placed, numbers, *proof, problem)


def _aim(least: str, of: Of, r: Result) -> tuple[Least, Of]:
    """Reduction and quantities of an aim such as `rms shaking_force`."""
    word, _, quantity = str(least).strip().partition(" ")
    if word not in ("rms", "max", "peak"):
        raise ModelError(
            f"least is {quote_value(least)}", "write rms or peak and a quantity: rms shaking_force"
        )
    drive = balanced_drive(r)
    short = {"shaking_force": "force", "shaking_moment": "moment"}
    short |= {} if drive is None else {f"effort.{drive}": "torque"}
    if quantity and quantity not in short:
        raise ModelError(f"{quantity!r} cannot be balanced", f"choose among {', '.join(short)}")
    reduction: Least = "rms" if word == "rms" else "max"
    return reduction, short[quantity] if quantity else of


def _over_a_cycle(m: Mechanism, positions: AtPositions) -> Result:
    return dynamics(m, over_a_turn(m, positions))


def _wanted(of: Of, r: Result) -> dict[str, float]:
    wanted = {of: 1.0} if isinstance(of, str) else dict(of)
    for name, weight in wanted.items():
        if name not in QUANTITIES:
            raise ModelError(f"{name!r} is not an objective", f"choose among {', '.join(QUANTITIES)}")
        require("weight", weight, f"the weight of {name}")
        if name == "torque" and balanced_drive(r) is None:
            raise ModelError("no drive has a torque that could be balanced", "balance force or moment")
    if not any(wanted.values()):
        raise ModelError("no objective to minimise is given", 'write of="force"')
    return wanted


def _difference(after: Shaking, solved: Solved, problem: BalanceProblem) -> float:
    """The linear prediction against the analysis with the counterweights, over the values before."""
    sizes, off = problem.sizes("max"), [0.0]
    for name, values in values_of(after).items():
        gap = values.reshape(len(values), -1) - problem.predict(name, solved.numbers)
        off.append(float(np.abs(gap).max()) / (sizes[name] or 1.0))
    return max(off)


def _placed(r: Result, link: str, w: Counterweight, p: Array) -> PlacedWeight:
    """The counterweight with these numbers: with mass 0, none."""
    d, numbers, base = r.mechanism.dimension, numbers_of(p), base_point(r.mechanism, link, w.at)
    mass, h, moment = float(p[0]), numbers.moment, float(np.linalg.norm(numbers.moment))
    s = numbers.second - np.outer(h, h) / mass if mass > 0 else np.zeros((3, 3))
    inertia = np.trace(s) * np.eye(3) - s
    center = base + (h[:d] / mass if mass > 0 else np.zeros(d))
    radius = w.disc_of(moment) if w.disc is not None else None
    angle = None if d == 3 else math.atan2(h[1], h[0]) if moment else 0.0
    return PlacedWeight(
        mass, center, max(float(np.trace(s)), 0.0) if d == 2 else inertia, moment, angle, radius
    )


def _force_left(r: Result, links: list[str]) -> float:
    """Part of the force that unbounded counterweights on some links leave, as light as may be far out."""
    unbounded = counterweights(r.mechanism, links)
    s = shaking(r)
    columns = mass_columns(r, unbounded, s.point, None).of["force"]
    if not greatest(s.parts["inertia"][0])[0] > s.floor("force"):
        return 0.0
    base = s.parts["inertia"][0].ravel()
    flat = columns.reshape(len(base), len(links), -1)[..., 1 : columns.shape[1] + 1].reshape(len(base), -1)
    scale = np.abs(flat).max(axis=0)
    counts = scale > 1e-12 * scale.max()
    flat = flat[:, counts] / scale[counts]
    left = base - flat @ np.linalg.lstsq(flat, base, rcond=1e-12)[0]
    return float(np.abs(left).max() / (np.abs(base).max() or 1.0))
