"""Critical load of a column of two sections, as a cylinder is: its barrel, then its rod.

Mechanics: docs/theory.md 10.11. Source: Timoshenko and Gere, Theory of Elastic Stability, section 2.14.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

STEPS = 256
"""Steps of the search from the load of the weaker section all along to that of the stronger one: the least root lies
between them."""


def _pinned(l1: float, l2: float, e1: float, e2: float) -> Callable[[Any], Any]:
    def sine_form(p: Any) -> Any:
        k1, k2 = np.sqrt(p / e1), np.sqrt(p / e2)
        return np.sin(k1 * l1) * np.cos(k2 * l2) / k1 + np.cos(k1 * l1) * np.sin(k2 * l2) / k2

    return sine_form


def _clamped_free(l1: float, l2: float, e1: float, e2: float) -> Callable[[Any], Any]:
    def sine_form(p: Any) -> Any:
        k1, k2 = np.sqrt(p / e1), np.sqrt(p / e2)
        return k2 * np.cos(k1 * l1) * np.cos(k2 * l2) - k1 * np.sin(k1 * l1) * np.sin(k2 * l2)

    return sine_form


def _clamped_pinned(l1: float, l2: float, e1: float, e2: float) -> Callable[[Any], Any]:
    """E I y'' + P y = R (L - x), R the lateral force at the pin."""

    def determinant(p: Any) -> Any:
        k1, k2, length = np.sqrt(p / e1), np.sqrt(p / e2), l1 + l2
        s1, c1, s2, c2 = np.sin(k1 * l1), np.cos(k1 * l1), np.sin(k2 * l2), np.cos(k2 * l2)
        # R/P = 1: barrel y = (L - x) - L cos k1 x + sin k1 x / k1; rod, z = L - x: y = z + C sin k2 z
        deflection, slope = -length * c1 + s1 / k1, length * k1 * s1 + c1
        return deflection * k2 * c2 + slope * s2

    return determinant


FORMS = {("pin", "pin"): _pinned, ("fixed", "free"): _clamped_free, ("fixed", "pin"): _clamped_pinned}
FACTORS = {("pin", "pin"): 1.0, ("fixed", "free"): 2.0, ("fixed", "pin"): math.pi / 4.493409457909064}
"""K of the length K L of a column of one section."""


def euler(length: float, stiffness: float, ends: tuple[str, str]) -> float:
    """Critical load of a column of one section, N; ``stiffness`` is E I."""
    return math.pi**2 * stiffness / (FACTORS[ends] * length) ** 2


def critical_load(l1: float, l2: float, e1: float, e2: float, ends: tuple[str, str]) -> float:
    """Critical load, N, of parts of lengths l1 and l2, m, and flexural stiffnesses e1 and e2, N m2.

    >>> round(critical_load(1.0, 1.0, 2.0, 2.0, ("pin", "pin")), 9) == round(math.pi**2 / 2, 9)
    True
    """
    from scipy.optimize import brentq

    if l1 <= 0 or l2 <= 0:
        return euler(l1 + l2, e1 if l2 <= 0 else e2, ends)
    low, high = (euler(l1 + l2, e, ends) for e in sorted((e1, e2)))
    if high - low <= 1e-14 * high:
        return low
    form = FORMS[ends](l1, l2, e1, e2)
    loads = np.concatenate([[low * (1 - 1e-9)], np.geomspace(low, high, STEPS)[1:-1], [high * (1 + 1e-9)]])
    signs = np.sign(form(loads))
    first = int(np.flatnonzero(signs[1:] != signs[:-1])[0])
    return float(brentq(form, loads[first], loads[first + 1], xtol=1e-300, rtol=9e-16))
