"""Critical speeds of a shaft: the speeds at which it whirls as it bends under the smallest unbalance.

K y = w^2 M y by finite elements, with Dunkerley's sum 1/w^2 = sum 1/w_i^2 of each mass alone, which is low, and
Rayleigh's w^2 = g sum m y / sum m y^2 by the deflection y under the weights, which is high, beside it.

Source: Budynas and Nisbett, Shigley's Mechanical Engineering Design, section 7-6; docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.output.summary.printed_units import print_scale
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.machine.link_axes import LinkAxes
from dalembert.machine.members.end_conditions import carrying_joints
from dalembert.machine.members.mass_along import mass_layout
from dalembert.machine.shafts.beam_elements import Beam, BeamModel, PointMass, SpreadMass, beam_model
from dalembert.machine.shafts.shaft_pieces import ShaftPiece, shaft_pieces
from dalembert.printing import Part, TextTable, number
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.machine.members.straight_members import Straight
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

ELEMENTS = 64
"""Elements of a shaft; half as many are a check."""
G = 9.80665


@dataclass(frozen=True, eq=False)
class CriticalSpeeds(Labelled, Drawn, Worked):
    """Critical speeds of a link, lowest first: ``speeds`` (S,), rad/s, with their ``shapes`` (S, N) at ``places`` (N,).

    ``whirl`` (S,): of forward whirl with the gyroscopic couples of the masses, ``speeds`` without. dunkerley, rayleigh:
    the lowest by the books' formulas, rad/s. sag (N,): deflection under the weights across the shaft, m. supports:
    joint -> place. ``change``: relative difference of the lowest with half of the elements.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"A": [0, 0], "B": [0.8, 0]}}}
    >>> section = {"circle": "25 mm", "elasticity": "207 GPa"}
    >>> links["shaft"] = {"points": {"A": [0, 0], "B": [0.8, 0], "C": [0.3, 0]}, "section": section}
    >>> links["gear"] = {"points": {"C": [0, 0]}, "mass": 16}
    >>> types = {"A": "pin", "B": "slot"}
    >>> joints = {name: {"type": types[name], "links": ["ground", "shaft"]} for name in types}
    >>> joints["C"] = {"type": "weld", "links": ["shaft", "gear"]}
    >>> c = da.critical_speeds(da.statics(da.mechanism({"links": links, "joints": joints})), "shaft")
    >>> c.speeds.round(1).tolist()    # rad/s
    [162.7]
    """

    result: Result = field(repr=False)
    link: str
    beam: Beam = field(repr=False)
    supports: dict[str, float]
    masses: dict[str, PointMass] = field(repr=False)
    speeds: Array
    whirl: Array = field(repr=False)
    places: Array = field(repr=False)
    shapes: Array = field(repr=False)
    sag: Array = field(repr=False)
    dunkerley: float
    rayleigh: float
    change: float

    ROWS = "speeds"

    @property
    def described(self) -> Any:
        """The description of what was analysed."""
        return self.result.mechanism

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Critical speeds, without and with gyroscopic couples."""
        yield Column(f"critical_speed.{self.link}", "angular_speed", self.speeds)
        yield Column(f"critical_speed.{self.link}.whirl", "angular_speed", self.whirl)

    def record(self, to: Scale) -> Tree:
        """The book's formulas beside the lowest, and what the shaft carries."""
        return {
            "shaft": {
                "link": self.link,
                "dunkerley": to("angular_speed", self.dunkerley),
                "rayleigh": to("angular_speed", self.rayleigh),
                "sag": to("length", float(np.abs(self.sag).max())),
                "supports": {name: to("length", s) for name, s in self.supports.items()},
                "masses": {name: to("mass", p.mass) for name, p in self.masses.items()},
                "change": self.change,
            }
        }

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Critical speeds in rpm, the books' formulas, the masses."""
        to = print_scale(self.result, units)
        rpm = 30 / math.pi
        rows = [
            [str(k + 1), number(w * rpm, 6), number(f * rpm, 6)]
            for k, (w, f) in enumerate(zip(self.speeds, self.whirl, strict=True))
        ]
        yield TextTable([f"critical speed\nof {self.link}", "rpm\n", "forward whirl\nrpm"], rows)
        low, high = (number(w * rpm, 6) for w in (self.dunkerley, self.rayleigh))
        yield (
            f"Dunkerley {low} rpm (low), Rayleigh {high} rpm (high). With half of the elements the lowest differs by "
            f"{self.change:.1g}."
        )
        carried = sum(p.mass for p in self.beam.points)
        along = sum(m.density * (m.end - m.start) for m in self.beam.spread)
        yield TextTable(
            ["mass on the shaft", to.text("mass"), f"at {to.text('length')}"],
            [[n, to.number("mass", p.mass), to.number("length", p.place)] for n, p in self.masses.items()]
            + ([["along the shaft", to.number("mass", along), "-"]] if along else []),
        )
        held = ", ".join(f"{n} at {to.quantity('length', s)}" for n, s in self.supports.items())
        sag = to.quantity("length", float(np.abs(self.sag).max()))
        yield (
            f"Held at {held}, rigidly. Largest sag under {to.quantity('mass', carried + along)} across it: {sag}. "
            "Shear, damping and the flexibility of bearings are neglected: a soft bearing lowers the speeds."
        )

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The shaft to scale with its bearings and masses, and its shape at each critical speed."""
        from dalembert.views.machine.shaft_view import shaft_scene
        from dalembert.views.notation import Notation as Usual

        return [shaft_scene(self, notation or Usual())]


def critical_speeds(r: Result, link: str, count: int = 3) -> CriticalSpeeds:
    """Critical speeds of a link as a shaft: one straight member with a section and its Young's modulus.

    A stepped shaft is several such links, welded end to end in one line, each with a section; any of them names it. Its
    bearings are its joints, at their places along it; a weld to another link clamps it. Its masses are the shaft's mass
    along it (`mass_along: uniform` or `shape`) and links welded to it that have no other joint. Raises ModelError for a
    link of several members, for one that is not held, and for one with mass whose place along it is not given.

    >>> import dalembert as da
    >>> tube = {"circle": "50 mm", "elasticity": "210 GPa"}
    >>> shaft = {"points": {"A": [0, 0], "B": [1, 0]}, "mass": 15.4, "center": [0.5, 0]}
    >>> shaft |= {"section": tube, "mass_along": "uniform"}
    >>> links = {"ground": {"points": {"A": [0, 0], "B": [1, 0]}}, "shaft": shaft}
    >>> joints = {n: {"type": kind, "links": ["ground", "shaft"]} for n, kind in (("A", "pin"), ("B", "slot"))}
    >>> speeds = da.critical_speeds(da.statics(da.mechanism({"links": links, "joints": joints})), "shaft").speeds
    >>> speeds.round(1)                                      # pi^2 sqrt(E I / (m L^3)), then 4, 9 times
    array([ 638.4, 2553.5, 5745.4])
    """
    if link not in r.mechanism.links:
        raise ModelError(f"unknown link {link!r}", closest(link, list(r.mechanism.links)))
    section = r.mechanism.links[link].section
    where = ("links", link)
    if section is None or section.elasticity is None:
        what = f"link {link!r} has no section with elasticity"
        raise ModelError(what, "give section: {circle: 50 mm, elasticity: 210 GPa}", where)
    pieces = shaft_pieces(r, link)
    masses, spread, placed = _carried(r, pieces)
    joints, length = r.mechanism.joints, pieces[-1].ends[1]
    supports = {n: s for n, s in placed.items() if n in joints and not joints[n].wheels}
    clamps = [s for n, s in supports.items() if not joints[n].freedoms]
    pins = [s for n, s in supports.items() if joints[n].freedoms]
    if not clamps and len({round(s / length, 9) for s in pins}) < 2:
        names = ", ".join(supports) or "no joint"
        raise ModelError(f"shaft {link!r} is held at {names} alone", "give it two bearings, or a weld", where)
    steps = [(p.ends[1], p.stiffness) for p in pieces]
    beam = Beam(length, steps, pins, clamps, [*masses.values()], spread)
    return _solved(r, link, beam, supports, masses, count)


def _solved(
    r: Result, link: str, beam: Beam, supports: dict[str, float], masses: dict[str, PointMass], count: int
) -> CriticalSpeeds:
    fine, coarse = beam_model(beam, ELEMENTS), beam_model(beam, ELEMENTS // 2)
    plain = replace(fine, tilting=_plain_tilting(beam))
    speeds, shapes = plain.modes(plain.carried + plain.tilting, count)
    if not len(speeds):
        what = f"shaft {link!r} carries no mass away from its bearings"
        remedy = "give its mass with mass_along: uniform, or weld links with mass to it"
        raise ModelError(what, remedy, ("links", link))
    check, _ = coarse.modes(coarse.carried + beam_model(_without_spin(beam), ELEMENTS // 2).tilting, 1)
    whirl, _ = fine.modes(fine.carried + fine.tilting, count)
    whirl = np.concatenate([whirl, np.full(max(0, len(speeds) - len(whirl)), np.inf)])[: len(speeds)]
    low, high, sag = _by_the_books(fine)
    return CriticalSpeeds(
        result=r,
        link=link,
        beam=beam,
        supports=supports,
        masses=masses,
        speeds=speeds,
        whirl=whirl,
        places=fine.nodes,
        shapes=(shapes[::2] / np.abs(shapes[::2]).max(axis=0)).T,
        sag=sag,
        dunkerley=low,
        rayleigh=high,
        change=float(abs(check[0] / speeds[0] - 1)),
    )


def _without_spin(beam: Beam) -> Beam:
    """The same without gyroscopic couples."""
    points = [replace(p, polar=0.0) for p in beam.points]
    return replace(beam, points=points, spread=[replace(m, polar=0.0) for m in beam.spread])


def _plain_tilting(beam: Beam) -> Array:
    """Inertia of tilting masses that do not spin."""
    return beam_model(_without_spin(beam), ELEMENTS).tilting


def _by_the_books(model: BeamModel) -> tuple[float, float, Array]:
    """Dunkerley's and Rayleigh's speed, rad/s, and the deflection (N,) under the weights, without tilting."""
    beam = model.beam
    alone = [replace(beam, points=[p], spread=[]) for p in beam.points if p.mass > 0]
    alone += [replace(beam, points=[], spread=beam.spread)] if beam.spread else []
    squares = 0.0
    for part in alone:
        one = beam_model(part, ELEMENTS)
        first, _ = one.modes(one.carried, 1)
        squares += float(1 / first[0] ** 2) if len(first) else 0.0
    across = np.tile([1.0, 0.0], len(model.nodes))
    y = model.pushed(G * model.carried @ across)
    moved = float(y @ model.carried @ y)
    rayleigh = math.sqrt(G * float(across @ model.carried @ y) / moved) if moved else math.inf
    return 1 / math.sqrt(squares) if squares else math.inf, rayleigh, -y[::2]


def _own_mass(r: Result, link: str, e: Straight) -> tuple[dict[str, PointMass], list[SpreadMass]]:
    """The link's mass along it, and bodies of its shape beside it."""
    m = r.mechanism
    if not m.mass(link):
        return {}, []
    if m.links[link].mass_along == "lumped":
        raise ModelError(
            f"the mass of shaft {link!r} has no place along it",
            "write mass_along: uniform or shape, or give masses as links welded to it",
            ("links", link),
        )
    layout = mass_layout(m, link, (e,))
    points = {}
    for k, x in enumerate(layout.lumps):
        name = link if len(layout.lumps) == 1 else f"{link} {k + 1}"
        points[name] = PointMass(float(e.foot(x.center)[0]), x.mass, *_about(x.inertia, e))
    pieces = [SpreadMass(p.start, p.end, p.density, *_about(p.inertia, e)) for p in layout.pieces]
    return points, pieces


def _about(inertia: Array, e: Straight) -> tuple[float, float]:
    """Moments of inertia about a diameter (the mean of two), and about the shaft's line."""
    t, y, z = (float(axis @ inertia @ axis) for axis in e.axes)
    return (y + z) / 2, t


def _carried(
    r: Result, pieces: list[ShaftPiece]
) -> tuple[dict[str, PointMass], list[SpreadMass], dict[str, float]]:
    """Masses at places and along a shaft of pieces, and the places of the joints that may hold it."""
    masses, spread, placed = dict[str, PointMass](), list[SpreadMass](), dict[str, float]()
    names = {p.link for p in pieces}
    for piece in pieces:
        points, carrying = _welded(r, piece.link, piece.member, names)
        own, along = _own_mass(r, piece.link, piece.member)
        for name, point in {**points, **own}.items():
            masses[name] = replace(point, place=piece.place(point.place))
        for m in along:
            start, end = sorted((piece.place(m.start), piece.place(m.end)))
            spread.append(replace(m, start=start, end=end))
        inside = {n for n, j in r.mechanism.joints.items() if set(j.links) <= names}
        placed |= {n: piece.place(s) for n, s in piece.joints.items() if n not in inside | {*carrying}}
    return masses, spread, placed


def _welded(r: Result, link: str, e: Straight, pieces: set[str]) -> tuple[dict[str, PointMass], list[str]]:
    """Links welded to the shaft that have no other joint, except its pieces, as masses, and their joints."""
    m, out = r.mechanism, dict[str, PointMass]()
    carrying = {n: other for n, other in carrying_joints(m, link).items() if other not in pieces}
    for other in carrying.values():
        local = LinkAxes(r, link)
        place = local.to_link(r.center(other) - r.position(link))[0]
        if m.dimension == 2:  # its inertia about the normal is about a diameter
            diametral, polar = float(m.inertia(other)), 0.0
        else:
            turned = local.rotation[0].T @ LinkAxes(r, other).rotation[0]
            diametral, polar = _about(turned @ _matrix(m.inertia(other)) @ turned.T, e)
        out[other] = PointMass(float(e.foot(place)[0]), m.mass(other), diametral, polar)
    return out, [*carrying]


def _matrix(inertia: Any) -> Array:
    """An inertia as a file gives it as a matrix (3, 3)."""
    known = np.asarray(inertia, float)
    return known if known.ndim == 2 else np.diag(known * np.ones(3))
