"""Equilibrium check of a force system, and the missing forces if it fails."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array
from dalembert.printing import number, round_components
from dalembert.units import Units
from dalembert.wrench.forces import Couple, Force
from dalembert.wrench.reading import read_only


@dataclass(frozen=True, eq=False)
class ForceSums:
    """Sums of forces (N) and of moments (N m) about ``at`` (m), and their largest ratio to the applied forces.

    ``residual`` is the larger of |sum of forces| / largest force and |sum of moments| / (largest force x length).
    """

    holds: bool
    residual: float
    force: Array
    moment: Array
    at: Array
    missing: tuple[Force | Couple, ...]
    sentence: str


def balance(
    sums: tuple[Array, Array],
    at: Array,
    scales: tuple[float, float],
    tolerance: float,
    missing: tuple[Force | Couple, ...],
    units: Units,
) -> ForceSums:
    """The check of equilibrium of a system with these sums of forces, and of moments about ``at``.

    ``scales``: the largest force and moment; ``missing``: the parts that would bring it to equilibrium.

    >>> from dalembert.wrench import Force, System
    >>> System(Force([0, 10]), Force([0, -10], at=[2, 0])).equilibrium().sentence
    'Not in equilibrium: the forces balance, the moments do not. A couple of 20 N*m is missing.'
    """
    force, moment = sums
    parts = _part(force, scales[0]), _part(moment, scales[1])
    residual = max(parts)
    holds = residual <= tolerance
    if holds:
        sentence = f"In equilibrium: {residual:.1g} of the largest force is left."
    else:
        sentence = f"Not in equilibrium: {_which(parts, tolerance)}. {_missing(missing, units)}"
    return ForceSums(holds, residual, force, read_only(moment), at, missing, sentence)


def _part(sum_of: Array, scale: float) -> float:
    size = math.hypot(*sum_of)
    return size / scale if scale > 0 else 0.0 if size == 0 else np.inf


def _which(parts: tuple[float, float], tolerance: float) -> str:
    force, moment = (part <= tolerance for part in parts)
    if force:
        return "the forces balance, the moments do not"
    if moment:
        return "the moments about the middle balance, the forces do not"
    return "neither forces nor moments balance"


def _missing(parts: tuple[Force | Couple, ...], units: Units) -> str:
    parts_text = " and ".join(_describe(part, units) for part in parts)
    return f"{parts_text[0].upper()}{parts_text[1:]} {'is' if len(parts) == 1 else 'are'} missing."


def _describe(part: Force | Couple, units: Units) -> str:
    if isinstance(part, Couple):
        return f"a couple of {list_components(part.vector, 'moment', units)}"
    place = list_components(part.at, "length", units)
    return f"a force of {list_components(part.vector, 'force', units)} on the line through {place}"


def list_components(values: Array, kind: str, units: Units) -> str:
    """Components with their unit, five figures: `[3, 4] N`; large ones in the unit used in tables.

    >>> list_components(np.array([3.0, 4.0]), "force", Units(force="kN"))
    '[0.003, 0.004] kN'
    >>> list_components(np.array([-8e6, 0.0]), "force", Units())
    '[-8, 0] MN'
    """
    from dalembert.analysis.output.summary.printed_units import scale_for

    to = scale_for(units, {kind: float(np.abs(values).max(initial=0.0))})
    shown = [number(float(to(kind, v)), 5) for v in round_components(values)]
    numbers, unit = shown[0] if len(shown) == 1 else f"[{', '.join(shown)}]", to.text(kind)
    return f"{numbers}{'*' if unit.startswith('10^') else ' '}{unit}"
