"""Rotors balanced in two planes: the unbalance of what turns about one axis, and the two corrections that end it.

With u the moments m r e^(i phi) about the axis and z along it, S = int u dm and T = int z u dm vanish with corrections
u_b = -(T - z_a S) / (z_b - z_a) and u_a = -S - u_b in planes z_a and z_b.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place, state
from dalembert.analysis.methods.inertia_couples import inertia_matrix
from dalembert.analysis.solution import kinematics
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.balance.counterweights import with_masses
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


@dataclass(frozen=True)
class RotorBalance:
    """Corrections in two planes: m r (2,), kg m, and angles (2,), rad, from an axis of the shaft across its own.

    ``unbalance``: S and T as complex numbers, kg m and kg m2. ``centers`` (2, 3), m, and ``masses`` (2,), kg: of the
    corrections at their radii, in the shaft link's axes.
    """

    mechanism_before: Mechanism = field(repr=False)
    shaft: str
    planes: tuple[float, float]
    unbalance: tuple[complex, complex]
    moment: Array
    angle: Array
    masses: Array
    centers: Array

    @property
    def mechanism(self) -> Mechanism:
        """The description with both corrections as point masses on the shaft."""
        masses = [(float(w), c, np.zeros((3, 3))) for w, c in zip(self.masses, self.centers, strict=True)]
        return with_masses(self.mechanism_before, {self.shaft: masses})


def balance_rotor(m: Mechanism, planes: tuple[float, float], radii: Sequence[float]) -> RotorBalance:
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
    if m.dimension == 2:
        raise ModelError(
            "two planes balance a rotor in space, and this one is in the plane", "use da.balance"
        )
    (a, b), (ra, rb) = planes, radii
    if not abs(b - a) > 0 or not min(ra, rb) > 0:
        raise ModelError(
            f"planes at {a:g} and {b:g} m, radii {ra:g} and {rb:g} m", "give two planes and two radii"
        )
    r = kinematics(m)
    shaft, origin, frame = _axes(r)
    moments = [_unbalance(r, link, origin, frame) for link in r.links]
    s, t = (sum(u[k] for u in moments) for k in (0, 1))
    at_b = -(t - a * s) / (b - a)
    found = np.array([-s - at_b, at_b])
    angle, size = np.angle(found), np.abs(found)
    radius = np.array([ra, rb])
    spots = np.stack([radius * np.cos(angle), radius * np.sin(angle), [a, b]], axis=-1)
    link = r.rotation(shaft)[0].T
    centers = (origin + spots @ frame - r.position(shaft)[0]) @ link.T
    unbalance = complex(s), complex(t)
    return RotorBalance(m, shaft, (a, b), unbalance, size, angle, size / radius, centers)


def _axes(r: Result) -> tuple[str, Array, Array]:
    """The shaft, a point of its axis, and rows x, y, z of a frame with z along it, ground axes."""
    if not r.drives or not r.ok.any():
        raise ModelError("a rotor has a drive that turns it", "drive its shaft")
    drive = r.mechanism.drives[r.drives[0]]
    joint = drive.joint or r.drives[0]
    i, j = r.mechanism.joints[joint].links
    shaft = j if i == GROUND else i
    speed = _unit_spin(r, shaft)
    for link in r.links:
        if np.abs(_unit_spin(r, link) - speed).max() > 1e-9:
            raise ModelError(f"{link} does not turn with {shaft}", "a rotor is what turns about one axis")
    z = speed / np.linalg.norm(speed)
    across = r.rotation(shaft)[0][:, int(np.argmin(np.abs(r.rotation(shaft)[0].T @ z)))]
    x = across - (across @ z) * z
    x = x / np.linalg.norm(x)
    return shaft, joint_place(r, joint)[0], np.stack([x, np.cross(z, x), z])


def _unit_spin(r: Result, link: str) -> Array:
    """Angular velocity (3,) at unit speed of the first drive."""
    return np.asarray(state(r).moving.virtual[0, 0, r.links.index(link), 3:])


def _unbalance(r: Result, link: str, origin: Array, frame: Array) -> tuple[complex, complex]:
    """S and T of one link: with the products of inertia about its centre in T."""
    m = r.mechanism
    mass, c = m.mass(link), frame @ (r.center(link)[0] - origin)
    turned = frame @ r.rotation(link)[0]
    products = turned @ inertia_matrix(r, link) @ turned.T
    u = complex(c[0], c[1])
    return mass * u, mass * c[2] * u - complex(products[0, 2], products[1, 2])
