"""Pressure of two cylinders in line contact.

Source: Hertz, J. reine angew. Math. 92 (1881); Johnson, Contact Mechanics, section 4.2. Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from dalembert.errors import ModelError


@dataclass(frozen=True)
class LineContact:
    """Half width of the contact, m, and greatest pressure, Pa."""

    half_width: float
    pressure: float


def hertz_line(
    force: float,
    width: float,
    radii: tuple[float, float],
    elasticity: float | tuple[float, float] = 206e9,
    poisson: float | tuple[float, float] = 0.3,
) -> LineContact:
    """Half width sqrt(4 N R/(pi b E*)) and pressure sqrt(N E*/(pi b R)) of two cylinders pressed together, SI.

    1/R = 1/r1 + 1/r2 (a hollow one negative, a plane infinite), 1/E* = sum (1 - nu^2)/E of both. Raises ModelError for
    a width or force that is not positive, and for a hollow that is not wider than what lies in it.

    >>> x = hertz_line(1800, 0.016, (0.045, 0.012))
    >>> round(x.half_width * 1e6, 3), round(x.pressure / 1e6, 2)
    (109.495, 654.09)
    """
    moduli = elasticity if isinstance(elasticity, tuple) else (elasticity,) * 2
    ratios = poisson if isinstance(poisson, tuple) else (poisson,) * 2
    if not (force >= 0 and width > 0 and min(moduli) > 0):
        raise ModelError("force, width and elasticity of a contact must be positive", "give them in SI")
    sharp = sum(0.0 if math.isinf(r) else 1 / r for r in radii)
    if sharp <= 0:
        raise ModelError(
            "the contact is hollow and not wider than what lies in it", "make the radius in it smaller"
        )
    stiff = 1 / sum((1 - nu * nu) / e for e, nu in zip(moduli, ratios, strict=True))
    half = math.sqrt(4 * force / (sharp * math.pi * width * stiff))
    return LineContact(half, math.sqrt(force * stiff * sharp / (math.pi * width)))
