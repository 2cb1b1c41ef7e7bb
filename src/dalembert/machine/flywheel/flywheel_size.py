"""From the fluctuation of energy to a flywheel and back: I = dE / (C_s w^2), and the ring or disc that has it.

Mechanics: docs/theory.md 10.3.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from dalembert.bounds import require
from dalembert.errors import ModelError


@dataclass(frozen=True)
class FlywheelSize:
    """Fluctuation of energy dE (J), mean speed w (rad/s), C_s = (w_max - w_min) / w, and inertia I (kg m2).

    ``pulses``: the areas between the curve and its mean, in order, J. w is the mean of the greatest and least speed.

    >>> import dalembert as da
    >>> f = da.flywheel_size(1200.0, speed=50, Cs=0.05)
    >>> round(f.inertia, 6)    # dE = I C_s w^2
    9.6
    """

    energy: float
    speed: float
    fluctuation: float
    inertia: float
    pulses: tuple[float, ...] = ()

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest speed, rad/s."""
        half = abs(self.speed) * self.fluctuation / 2
        return abs(self.speed) - half, abs(self.speed) + half

    def mass(self, radius_of_gyration: float) -> float:
        """Mass, kg, at a radius of gyration, m: I / k^2."""
        require("radius of gyration", radius_of_gyration)
        return self.inertia / radius_of_gyration**2

    def disc(
        self, density: float, radius: float | None = None, thickness: float | None = None
    ) -> tuple[float, float]:
        """Radius and thickness, m, of a solid disc of a density, kg/m3, one of them given: I = pi rho t R^4 / 2."""
        if (radius is None) == (thickness is None):
            raise ModelError("a disc is sized by its radius or its thickness", "give one of them")
        for name, size in (("density", density), ("radius", radius), ("thickness", thickness)):
            require(name, size)
        half = math.pi * density / 2
        if radius is not None:
            return radius, self.inertia / (half * radius**4)
        assert thickness is not None
        return (self.inertia / (half * thickness)) ** 0.25, thickness

    def rim(
        self, density: float, radius: float, breadth: float | None = None, height: float | None = None
    ) -> float:
        """Side of a rim's section, m: its height from its breadth (along the axis), or the reverse.

        I = rho 2 pi R b h (R^2 + h^2 / 4) about the axis, with R the rim's mean radius, exact for the rectangle.
        """
        if (breadth is None) == (height is None):
            raise ModelError("a rim is sized by the breadth or the height of its section", "give one of them")
        for name, size in (
            ("density", density),
            ("radius", radius),
            ("breadth", breadth),
            ("height", height),
        ):
            require(name, size)
        round_ = 2 * math.pi * density * radius
        if height is not None and height > 2 * radius:
            raise ModelError(
                f"a rim {height:.4g} m high reaches beyond its axis", "give less height or more radius"
            )
        if height is not None:
            return self.inertia / (round_ * height * (radius**2 + height**2 / 4))
        assert breadth is not None
        wanted = self.inertia / (round_ * breadth)  # h^3 / 4 + R^2 h: a cubic of one root
        turned = math.asinh(0.75 * math.sqrt(3) * wanted / radius**3) / 3
        side = 4 * radius / math.sqrt(3) * math.sinh(turned)
        if side > 2 * radius:
            raise ModelError(
                f"the rim would be {side:.4g} m high about a mean radius of {radius:.4g} m",
                "give more breadth or radius",
            )
        return side


def flywheel_size(
    energy: float | Sequence[float],
    speed: float,
    Cs: float | None = None,
    inertia: float | None = None,
) -> FlywheelSize:
    """The flywheel for a fluctuation of energy (J) or for pulses (J, in order over the period), by C_s or inertia.

    dE is the greatest less the least of the running sum of the pulses. w: mean of the greatest and least speed, rad/s.

    >>> f = flywheel_size([200.73, -261.05, 153.88, -92.02], speed=50, Cs=0.05)
    >>> round(f.energy, 2), round(f.inertia, 4)
    (261.05, 2.0884)
    """
    pulses = () if isinstance(energy, (int, float, str)) else tuple(energy)
    for pulse in pulses:
        require("pulse", pulse)
    for name, value in (("mean speed", speed), ("Cs", Cs), ("flywheel inertia", inertia)):
        require(name, value, name.split()[-1])
    if (Cs is None) == (inertia is None):
        raise ModelError(
            "a flywheel needs either Cs or its inertia", "give one of them: Cs=0.02 or inertia=3.5"
        )
    pulses = tuple(float(pulse) for pulse in pulses)
    sums = [0.0, *accumulate(pulses)]
    fluctuation = energy if isinstance(energy, (int, float)) else max(sums) - min(sums)
    require("energy", fluctuation)
    square = speed**2
    if not square:
        raise ModelError(f"a flywheel at {speed:g} rad/s keeps no energy", "give the mean speed")
    if Cs is not None:
        return FlywheelSize(fluctuation, speed, Cs, fluctuation / (Cs * square), pulses)
    assert inertia is not None
    return FlywheelSize(fluctuation, speed, fluctuation / (inertia * square), inertia, pulses)
