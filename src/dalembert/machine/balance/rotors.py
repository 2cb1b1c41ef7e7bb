"""Rotors balanced in two planes: the unbalance of what turns about one axis, and the two corrections that end it.

With u the moments m r e^(i phi) about the axis and z along it, S = int u dm and T = int z u dm vanish with corrections
u_b = -(T - z_a S) / (z_b - z_a) and u_a = -S - u_b in planes z_a and z_b.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place, state
from dalembert.analysis.methods.inertia_couples import inertia_matrix
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.transmission_lines import ground_points
from dalembert.analysis.solution import dynamics
from dalembert.answer.column import Scale
from dalembert.arrays import Array, Tree
from dalembert.bounds import require
from dalembert.errors import ArgumentError, ModelError
from dalembert.machine.balance.comparison import Comparison
from dalembert.machine.balance.counterweights import with_masses
from dalembert.machine.shaking import Shaking, shaking
from dalembert.machine.whole_cycle import over_a_turn
from dalembert.model import GROUND, ModelOrPath, as_mechanism

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene


NOTHING = 1e-15
"""Part of the sizes of what adds up to the unbalance below which it is rounding."""


@dataclass(frozen=True, eq=False)
class RotorBalance(Comparison):
    """Corrections in two planes: m r (2,), kg m, and angles (2,), rad, from an axis of the shaft perpendicular to its
    axis of rotation.

    ``unbalance``: S and T as complex numbers, kg m and kg m2; ``left``: the same with the corrections. ``centers`` (2,
    3), m, and ``masses`` (2,), kg: those of the corrections at their radii, in the shaft link's axes. ``before``,
    ``after``: shaking without and with them, moments about the driven joint.

    >>> import dalembert as da
    >>> b = da.balance_rotor(da.rotating_shaft(), planes=(0.05, 0.45), radii=(0.04, 0.04))
    >>> b.masses.round(3).tolist()
    [0.234, 0.351]
    """

    result: Result = field(repr=False)
    shaft: str
    planes: tuple[float, float]
    unbalance: tuple[complex, complex]
    moment: Array
    angle: Array
    masses: Array
    centers: Array
    zero: str
    left: tuple[complex, complex]
    before: Shaking = field(repr=False)
    after: Shaking = field(repr=False)

    @property
    def residual(self) -> float:
        """Remaining S and T, over the greatest distance of a plane, relative to all their moments; 0 for a rotor that
        was already balanced."""
        reach = max(abs(z) for z in (*self.planes, self.planes[1] - self.planes[0]))
        left = max(abs(self.left[0]), abs(self.left[1]) / reach)
        return float(left / self.moment.sum()) if self.moment.any() else 0.0

    def record(self, to: Scale) -> Tree:
        """Its other numbers by name, in the units of a scale."""
        moment = to("mass", to("length", self.moment))
        corrections = {"plane": to("length", np.array(self.planes)), "mass": to("mass", self.masses)}
        corrections |= {
            "moment": moment,
            "angle": to("angle", self.angle),
            "center": to("length", self.centers),
        }
        out: Tree = {"shaft": self.shaft, "angle_from": self.zero, "corrections": corrections}
        for name, both in (("unbalance", self.unbalance), ("left", self.left)):
            out[name] = {
                "force": to("mass", to("length", abs(both[0]))),
                "couple": to("inertia", abs(both[1])),
            }
        return {"rotor": out | self.sizes_record(to)}

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.rotor_text import rotor_parts

        return rotor_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.cycle_views import rotor_scenes

        return rotor_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.design_sections import rotor_section

        rotor_section(sheet, self, shown)


def balance_rotor(m: ModelOrPath, planes: tuple[float, float], radii: Sequence[float]) -> RotorBalance:
    """Corrections of a rotor in space, in two planes (m along the driven joint's axis, from it) at radii (m).

    All moving links must turn with the first drive's joint. Angles count from the axis of the shaft's link that is
    most nearly across, about the axis of rotation. Raises ModelError for planes that coincide.

    >>> import dalembert as da
    >>> m = da.rotating_shaft()
    >>> found = da.balance_rotor(m, (0.1, 0.5), (0.05, 0.05))
    >>> again = da.balance_rotor(found.mechanism, (0.1, 0.5), (0.05, 0.05))
    >>> bool(np.abs(again.unbalance).max() < 1e-12 * np.abs(found.unbalance).max())
    True
    """
    m = as_mechanism(m)
    if m.dimension == 2:
        raise ModelError(
            "two planes balance a rotor in space, and this one is in the plane", "use da.balance"
        )
    for key, two in (("plane", planes), ("radius", radii)):
        for value in two:
            require(key, value)
        if len(two) != 2:
            raise ArgumentError(f"{len(two)} of two: {key}", "give one for each of the two planes")
    (a, b), radius = planes, np.array(radii, float)
    if a == b:
        raise ArgumentError(f"both planes are at {a:g} m", "give two planes apart: (0.05, 0.45)")
    r = dynamics(m, over_a_turn(m))
    shaft, joint, frame, zero = _axes(r)
    origin = joint_place(r, joint)[0]
    about = joint if joint in ground_points(m) else origin
    s, t = _unbalance(r, origin, frame)
    at_b = -(t - a * s) / (b - a)
    moments = np.array([-s - at_b, at_b])
    angle, size = np.angle(moments), np.abs(moments)
    angle = np.where(angle < 1e-12 - np.pi, angle + 2 * np.pi, angle)  # half a turn back is half a turn on
    spots = np.stack([radius * np.cos(angle), radius * np.sin(angle), [a, b]], axis=-1)
    centers = (origin + spots @ frame - r.position(shaft)[0]) @ r.rotation(shaft)[0]
    masses = size / radius
    points = [(float(w), c, np.zeros((3, 3))) for w, c in zip(masses, centers, strict=True)]
    after = at_schedule(with_masses(m, {shaft: points}), r.schedule, r.inertia)
    corrections = (a, b), (s, t), size, angle, masses, centers, zero, _unbalance(after, origin, frame)
    return RotorBalance(r, shaft, *corrections, shaking(r, about), shaking(after, about))


def _axes(r: Result) -> tuple[str, str, Array, str]:
    """The shaft, its driven joint, rows x, y, z of a frame with z along its axis, ground axes, and the link's axis that
    x is nearly."""
    if not r.drives or not r.ok.any():
        raise ModelError("a rotor needs a drive that turns it", "drive its shaft")
    joint = r.mechanism.drives[r.drives[0]].joint or r.drives[0]
    i, j = r.mechanism.joints[joint].links
    shaft = j if i == GROUND else i
    spins = state(r).moving.virtual[0, 0, :, 3:]  # at unit speed of the first drive
    speed = spins[r.links.index(shaft)]
    for link, link_spin in zip(r.links, spins, strict=False):
        if np.abs(link_spin - speed).max() > 1e-9:
            raise ModelError(f"{link} does not turn with {shaft}", "a rotor is what turns about one axis")
    z, turned = speed / np.linalg.norm(speed), r.rotation(shaft)[0]
    k = int(np.argmin(np.abs(turned.T @ z)))
    x = turned[:, k] - (turned[:, k] @ z) * z
    x = x / np.linalg.norm(x)
    return shaft, joint, np.stack([x, np.cross(z, x), z]), "xyz"[k]


def _unbalance(r: Result, origin: Array, frame: Array) -> tuple[complex, complex]:
    """S and T of all links, with the products of inertia about their centres in T."""
    out, sizes = np.zeros(2, complex), np.zeros(2)
    for link in r.links:
        mass, c, turned = (
            r.mechanism.mass(link),
            frame @ (r.center(link)[0] - origin),
            frame @ r.rotation(link)[0],
        )
        products = turned @ inertia_matrix(r, link) @ turned.T
        u = mass * complex(c[0], c[1])
        out += u, c[2] * u - complex(products[0, 2], products[1, 2])
        reach = float(np.abs(c).max()) + r.compiled.layout.length
        sizes += mass * reach, mass * reach**2 + np.abs(products).max()
    out = np.where(np.abs(out) > NOTHING * sizes, out, 0.0)
    return complex(out[0]), complex(out[1])
