"""Numbers of machine design by name, in aims, conditions, limits and answers: `mass`, `stress.rod`, `life.A`.

One function for each word, of a result and a name: a value at every position. Masses are compiled too, and stress and
buckling of links for which `not_compiled` gives no reason.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def things_of(m: Any, links: tuple[str, ...], of: str) -> list[str]:
    """The links or joints that a word can be asked of."""
    if of == "masses":
        return [*([] if "mass" in m.parameters else [""]), *links]
    if of in ("sections", "elastic", "fatigued"):
        parts = {n: m.links[n].section for n in links if m.links[n].section is not None}
        if of == "elastic":
            return [n for n, s in parts.items() if s.elasticity is not None]
        if of == "fatigued":
            return [n for n, s in parts.items() if s.endurance is not None and s.ultimate is not None]
        return [*parts]
    if of == "rated":
        bearings = {n: getattr(j, "bearing", None) for n, j in m.joints.items()}
        return [n for n, b in bearings.items() if b is not None and b.rating is not None]
    if of == "clear":
        clear = any(getattr(j, "clearance", 0.0) for j in m.joints.values())
        return [f"{link}.{p}" for link in links if clear for p in (*m.links[link].points, "center")]
    return [n for n, j in m.joints.items() if getattr(j, "pin", None) is not None]


def mass(r: Any, link: str) -> Numeric:
    """Mass of a link, or of all moving links, kg; a node where ``r`` is a compiled analysis."""
    total = sum((r.mechanism.mass(n) for n in ([link] if link else r.links)), start=0.0)
    return np.full(len(r.status), total) if hasattr(r, "status") else total


def _stress(r: Any, link: str) -> Numeric:
    """Greatest von Mises stress of a link, Pa; a node where ``r`` is a compiled analysis."""
    from dalembert.machine.members.compiled_members import compiled_stress
    from dalembert.machine.members.member_forces import member_forces

    if not hasattr(r, "status"):
        return compiled_stress(r, r.like, link)
    return member_forces(r, link).stress().equivalent


def _fatigue(r: Result, link: str) -> Array:
    """1 / n by Goodman's line of the worst fibre over the cycle."""
    from dalembert.machine.members.member_forces import member_forces

    safety = member_forces(r, link).stress().fatigue().safety
    return np.full(len(r.status), np.nan if safety is None else 1 / safety)


def _buckling(r: Any, link: str) -> Numeric:
    """Compression of a link over its critical load: 1 where it buckles; a node where ``r`` is a compiled analysis."""
    from dalembert.machine.members.buckling import utilisation
    from dalembert.machine.members.compiled_members import compiled_buckling
    from dalembert.machine.members.member_forces import member_forces

    if not hasattr(r, "status"):
        return compiled_buckling(r, r.like, link)
    return utilisation(member_forces(r, link))


def _deflection(r: Result, link: str) -> Array:
    """Greatest deflection along a link, m."""
    from dalembert.machine.members.member_forces import member_forces

    return member_forces(r, link).deflection().greatest


def _slope(r: Result, link: str) -> Array:
    """Greatest slope of a link in its bearings, rad; NaN without bearings."""
    from dalembert.machine.members.member_forces import member_forces

    slopes = member_forces(r, link).deflection().slopes()
    return np.max([*slopes.values()], axis=0) if slopes else np.full(len(r.status), np.nan)


def _life(r: Result, joint: str) -> Array:
    """L10 life of a rolling bearing, s."""
    from dalembert.machine.bearings.bearing_load import bearing

    return np.full(len(r.status), 3600 * bearing(r, joint).hours)


def _pin_stress(r: Result, joint: str) -> Array:
    """The larger of bending stress and sqrt(3) times the peak shear of a bolt, Pa."""
    from dalembert.machine.elements.pin_stresses import pin

    return pin(r, joint).equivalent


def _play(part: str) -> Callable[[Result, str], Array]:
    def read(r: Result, of: str) -> Array:
        from dalembert.machine.elements.clearances import clearance_error

        link, point = of.split(".", 1)
        return np.asarray(getattr(clearance_error(r, link, point), part))

    return read


def not_compiled(r: Result, word: str, of: str) -> str:
    """Why a number of machine design is not compiled; empty where it is, as all other quantities."""
    from dalembert.machine.members.compiled_members import factors, lacks

    if word not in ("stress", "buckling"):
        return "" if word not in READ else f"{word} is not compiled"
    why = lacks(r, of)
    if not why and word == "buckling":
        try:
            factors(r, of)
        except ModelError as error:
            return error.what
    return why


READ: dict[str, Callable[[Any, str], Numeric]] = {
    "stress": _stress,
    "fatigue": _fatigue,
    "buckling": _buckling,
    "deflection": _deflection,
    "bearing_slope": _slope,
    "life": _life,
    "pin_stress": _pin_stress,
    "play": _play("by_force"),
    "play.worst": _play("worst"),
}
"""Word -> its values over the positions (P,)."""
