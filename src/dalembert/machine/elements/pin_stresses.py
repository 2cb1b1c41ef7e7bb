"""Bolts of pin joints: shear in their planes, pressure on eye and cheeks, bending.

A fork: V = F/2 in each plane, tau = V/A on the average and 4/3 of it in the middle; p = F/(d t_eye), F/(2 d t_cheek);
M = (F/2) (t_cheek/2 + gap + t_eye/4). Two plates: M = F (t_1/2 + gap + t_2/2)/2. A stack: in each plane the sum of the
forces before it, as vectors, and the sum of their moments.

Source: Budynas and Nisbett, Shigley's Mechanical Engineering Design, chapter 8; docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import permutations
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.answer.answer import Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree, first_largest
from dalembert.errors import ModelError
from dalembert.model.joints.elements.pin_keys import PinSize
from dalembert.printing import Part, TextTable, number
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SAMPLES = 25
"""Places between two links of a bolt where its moment is drawn."""
MOST = 6
"""Links of a stack up to which every order is tried."""


@dataclass(frozen=True, eq=False)
class PinStresses(Labelled):
    """Stresses of a bolt (P,), Pa, and its bending moment (P,), N m; NaN of what the file does not size.

    force (P,): the joint's, of a stack the largest shear, N. shear: mean in the plane that carries most; peak_shear: in
    its middle, 4/3 of it; eye_pressure, cheek_pressure: over the projected areas; bending: M over the section's
    modulus. planes (P, n): shear force in each plane of a stack. best: the order of a stack with the least bending.
    pressures: link -> bearing pressure on it (P,), Pa, where its thickness is given.

    >>> import dalembert as da
    >>> m = da.slider_crank().with_values({"joints.A.pin": {"diameter": "20 mm", "eye": "20 mm", "cheeks": "10 mm"}})
    >>> b = da.pin(da.dynamics(m), "A")
    >>> b.force.shape, bool((b.peak_shear >= b.shear).all())
    ((72,), True)
    """

    result: Result = field(repr=False)
    joint: str
    size: PinSize = field(repr=False)
    force: Array = field(repr=False)
    shear: Array = field(repr=False)
    eye_pressure: Array = field(repr=False)
    cheek_pressure: Array = field(repr=False)
    moment: Array = field(repr=False)
    planes: Array = field(repr=False)
    best: tuple[str, ...] = ()
    pressures: Mapping[str, Array] = field(default_factory=dict, repr=False)

    @property
    def described(self) -> Any:
        """The description of what was analysed."""
        return self.result.mechanism

    @property
    def peak_shear(self) -> Array:
        """Largest shear stress (P,), Pa, in the middle of the section."""
        return self.shear * 4 / 3

    @property
    def bending(self) -> Array:
        """Bending stress (P,), Pa: 32 M / (pi d^3)."""
        return self.moment * 32 / (math.pi * self.size.diameter**3)

    @property
    def equivalent(self) -> Array:
        """The larger of bending and sqrt(3) times the peak shear (P,), Pa: they are not in one fibre."""
        return np.asarray(np.fmax(self.bending, math.sqrt(3) * self.peak_shear))

    @property
    def safety(self) -> Array:
        """Yield stress over ``equivalent`` (P,)."""
        with np.errstate(all="ignore"):
            return np.asarray((self.size.yield_stress or math.nan) / self.equivalent)

    @property
    def pressure_safety(self) -> Array:
        """Allowed pressure over the largest on a link (P,); NaN without either."""
        limit = self.size.allowed_pressure or math.nan
        largest = [np.full(len(self.force), math.nan), *self.pressures.values()]
        with np.errstate(all="ignore"):
            return np.asarray(limit / np.fmax.reduce(largest))

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Force, stresses, moment."""
        yield Column(f"force.{self.joint}", "force", self.force)
        for name in ("shear", "peak_shear", "eye_pressure", "cheek_pressure", "bending"):
            values = getattr(self, name)
            if np.isfinite(values).any():
                yield Column(f"{name}.{self.joint}", "pressure", values)
        for link, values in self.pressures.items() if self.size.stack else ():
            yield Column(f"pressure_{link}.{self.joint}", "pressure", values)
        yield Column(f"moment.{self.joint}", "moment", self.moment)

    def record(self, to: Scale) -> Tree:
        """Largest values over the positions."""
        return {"pin": {"joint": self.joint, "best_order": list(self.best), **{
            c.name.split(".")[0]: float(to(c.kind, np.nanmax(c.values))) for c in self.columns()
        }}}  # fmt: skip

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Largest values, and the best order of a stack."""
        to = self.scale(units)
        rows = []
        for c in self.columns():
            k = first_largest(c.values)
            largest = number(float(to(c.kind, c.values[k])))
            rows.append([c.name.split(".")[0].replace("_", " "), largest, to.text(c.kind), str(k + 1)])
        yield TextTable([f"bolt of {self.joint}", "largest", "unit", "no."], rows, 1)
        if np.isfinite(self.safety).any():
            yield f"Safety against yielding {number(float(np.nanmin(self.safety)), 4)}: bending, or shear by von Mises."
        if np.isfinite(self.pressure_safety).any():
            yield f"Safety of the pressure {number(float(np.nanmin(self.pressure_safety)), 4)}."
        if self.best:
            yield f"Least bending with the links in the order {', '.join(self.best)}."


def pin(r: Result, joint: str) -> PinStresses:
    """Shear, pressure and bending of the bolt of a joint with ``pin``, at every position.

    Raises ModelError for a joint without it, and for a stack that does not name the links of its bolt.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"A": [0, 0], "B": [1, 0]}}, "eye": {"points": {"A": [0, 0], "B": [1, 0]}}}
    >>> size = {"diameter": "30 mm", "eye": "40 mm", "cheeks": "22 mm", "gap": "1 mm"}
    >>> joints = {"A": {"type": "pin", "links": ["ground", "eye"], "pin": size}}
    >>> joints["B"] = {"type": "slot", "links": ["ground", "eye"]}
    >>> loads = {"F": {"type": "force", "on": "eye", "at": "B", "value": [60000, 0]}}
    >>> x = da.pin(da.statics(da.mechanism({"links": links, "joints": joints, "loads": loads})), "A")
    >>> round(float(x.moment[0]), 6), round(float(x.eye_pressure[0] / 1e6), 6)
    (660.0, 50.0)
    """
    if joint not in r.joints:
        raise ModelError(f"unknown joint {joint!r}", closest(joint, list(r.joints)))
    size: PinSize | None = getattr(r.mechanism.joints[joint], "pin", None)
    if size is None:
        raise ModelError(f"joint {joint!r} has no pin", "give it pin: {diameter: 20 mm}", ("joints", joint))
    area = math.pi * size.diameter**2 / 4
    nothing = np.full(len(r.status), np.nan)
    if size.stack is not None:
        forces = _forces_on(r, joint, size.stack)
        planes, moments = _along(forces, np.array(size.layers))
        most = planes.max(axis=1)
        best = _best(forces, size) if len(size.stack) <= MOST else ()
        thick = size.thicknesses or ()
        pressures: dict[str, Array] = {}
        for k, (link, t) in enumerate(zip(size.stack, thick, strict=False)):
            pressure = np.hypot(*forces[:, k].T) / (size.diameter * t)
            pressures[link] = np.fmax(pressure, pressures.get(link, 0.0))
        greatest = moments.max(axis=1)
        return PinStresses(
            r, joint, size, most, most / area, nothing, nothing, greatest, planes, best, pressures
        )
    force = np.hypot(*r.reaction(joint).T)
    each, eye, cheek = force / size.planes, size.eye, size.cheeks
    arm = math.nan
    if eye and cheek:
        arm = cheek / 2 + size.gap + eye / 4 if size.planes == 2 else (cheek / 2 + size.gap + eye / 2) / 2
    i, j = r.mechanism.joints[joint].links
    pressures = {j: force / (size.diameter * eye)} if eye else {}
    pressures |= {i: each / (size.diameter * cheek)} if cheek else {}
    return PinStresses(
        pressures=pressures,
        result=r,
        joint=joint,
        size=size,
        force=force,
        shear=each / area,
        eye_pressure=force / (size.diameter * eye) if eye else nothing,
        cheek_pressure=each / (size.diameter * cheek) if cheek else nothing,
        moment=each * arm,
        planes=np.stack([each] * size.planes, axis=1),
    )


def _forces_on(r: Result, joint: str, stack: tuple[str, ...]) -> Array:
    """Forces (P, n, 2) of the bolt on the layers of a stack: of all pins at the place of this one. A link with several
    layers, a fork, shares its force evenly among them."""
    m = r.mechanism
    at = [set(zip(j.links, j.point_names(n), strict=True)) for n, j in m.joints.items()]
    names = list(m.joints)
    shared, value = {joint}, at[names.index(joint)]
    for _ in names:
        new = {n for n, ends in zip(names, at, strict=True) if ends & value and m.joints[n].hinge}
        shared |= new
        value = set().union(*(at[names.index(n)] for n in shared))
    links = {link for n in shared for link in m.joints[n].links}
    if links != {*stack}:
        what = (
            f"the bolt of {joint!r} carries {', '.join(sorted(links))}, and its stack is {', '.join(stack)}"
        )
        raise ModelError(what, "name each of them", ("joints", joint, "pin", "stack"))
    force = {link: np.zeros((len(r.status), 2)) for link in stack}
    for n in shared:
        for link in m.joints[n].links:
            force[link] = force[link] + r.reaction(n, on=link)
    return np.stack([force[link] / stack.count(link) for link in stack], axis=1)


def moment_along(x: PinStresses, k: int) -> tuple[Array, Array]:
    """Places along the bolt (N,), m, and the bending moment (N,), N m, at position k; empty without thicknesses."""
    size = x.size
    if size.stack is not None:
        places = np.array(size.layers)
        shear = np.cumsum(_forces_on(x.result, x.joint, size.stack)[k], axis=0)[:-1]
        part = np.linspace(0, 1, SAMPLES)
        start, s, m = np.zeros(2), [places[:1]], [np.zeros(1)]
        for n, v in enumerate(shear):
            d = (places[n + 1] - places[n]) * part
            s.append(places[n] + d)
            m.append(np.hypot(*(start + d[:, None] * v).T))
            start = start + d[-1] * v
        return np.concatenate(s), np.concatenate(m)
    if not (size.eye and size.cheeks):
        return np.zeros(0), np.zeros(0)
    each, top = float(x.planes[k, 0]), float(x.moment[k])
    if size.planes == 1:
        ends = (size.cheeks + size.eye) / 2 + size.gap
        return np.array([0.0, ends / 2, ends]), np.array([0.0, top, 0.0])
    lead = size.cheeks / 2 + size.gap
    u = np.linspace(0, size.eye, SAMPLES)
    inner = each * lead + each * u - each / size.eye * u**2
    return np.concatenate([[0.0], lead + u, [2 * lead + size.eye]]), np.concatenate([[0.0], inner, [0.0]])


def _along(forces: Array, places: Array) -> tuple[Array, Array]:
    """Shear force in each plane (P, n - 1), and bending moment at each layer (P, n)."""
    shear = np.cumsum(forces, axis=1)[:, :-1]
    moment = np.cumsum(shear * np.diff(places)[:, None], axis=1)
    moment = np.concatenate([np.zeros_like(moment[:, :1]), moment], axis=1)
    return np.hypot(*np.moveaxis(shear, -1, 0)), np.hypot(*np.moveaxis(moment, -1, 0))


def _best(forces: Array, size: PinSize) -> tuple[str, ...]:
    """The order with the least largest moment, the layers kept."""
    assert size.stack is not None
    every = [order for order in permutations(range(len(size.stack))) if order[0] < order[-1]]
    orders = [*{tuple(size.stack[k] for k in order): order for order in every}.values()]
    places = np.array(size.layers)
    largest = [float(np.nanmax(_along(forces[:, order], places)[1])) for order in orders]
    return tuple(size.stack[k] for k in orders[first_largest(-np.array(largest))])
