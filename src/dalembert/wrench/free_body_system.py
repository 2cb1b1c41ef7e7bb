"""The force system on links of a solved mechanism: its free body at one position, as a `System`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, actions
from dalembert.analysis.result.position_lookup import PositionChoice, has_forces, position_at
from dalembert.errors import STATUSES, AnalysisError, ModelError
from dalembert.wording import closest
from dalembert.wrench.forces import Couple, Force
from dalembert.wrench.system import System

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def on(r: Result, *links: str, at: PositionChoice = None) -> System:
    """Everything that acts on a link at a position, or on several links as one body: N, N m, m, ground axes.

    Reactions (F_A and M_A in joint A), loads, weights, efforts and, in dynamics, D'Alembert's inertia forces: a system
    in equilibrium, its joints as points. Joints between the links named are inside and left out. ``at`` is a position
    by its number from 1, or a value of the first drive; by default the first solved one. Where reactions are not
    unique, the system has the least-norm ones, and where contacts reverse, those just before (for just after, give
    ``r.after``); the title says so. Raises AnalysisError where the position has no answer.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> rod = da.wrench.on(da.dynamics(da.load(examples()["four_bar"])), "coupler")
    >>> [part.name for part in rod], rod.equilibrium().holds
    (['F_A', 'F_B', 'F_P', 'inertia force of coupler', 'inertia couple of coupler'], True)
    """
    for link in links:
        if link not in r.links:
            raise ModelError(f"unknown link {link!r}", closest(link, list(r.links)))
    if not links:
        raise ModelError("no link is named", f"name some of {', '.join(r.links)}")
    k = position_at(r, at)
    if not has_forces(r, k):
        raise AnalysisError(f"position {k + 1}: {r.reasons[k] or STATUSES[r.status[k]].sentence}")
    outside = [a for a in actions(r) if a.link in links and a.by not in links]
    if not all(np.isfinite(a.force[k]).all() for a in outside):
        raise ModelError("this result is a motion without forces", "take one of da.dynamics or da.statics")
    title = " and ".join(links) + (f", position {k + 1}" if len(r.status) > 1 else "")
    title += ", least-norm reactions" if r.status[k] == "redundant" else ""
    title += ", just before contacts reverse" if r.reverses[k] else ""
    parts = [part for a in outside for part in _parts(a, k)]
    points = {a.of: a.at[k] for a in outside if a.kind == "joint"}
    return System(*parts, title=title, units=r.mechanism.units, points=points)


def _parts(a: Action, k: int) -> list[Force | Couple]:
    """An action at position k as a force and a couple, those that are not zero; a joint's force always."""
    name = a.source or {"effort": f"effort of {a.of}", "friction": f"friction in {a.of}"}.get(a.kind, a.of)
    letters = ("F_", "M_") if a.kind == "joint" else ("", "")
    couple = np.atleast_1d(a.couple[k])
    out: list[Force | Couple] = []
    if a.force[k].any() or a.kind == "joint":
        out.append(Force(a.force[k], a.at[k], letters[0] + name, a.kind))
    if couple.any():
        out.append(Couple(couple, letters[1] + name, a.kind))
    return out
