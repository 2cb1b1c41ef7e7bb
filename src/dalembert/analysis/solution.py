"""The analyses: kinematics, statics, dynamics of a description over its positions, and its mobility."""

from __future__ import annotations

from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.equilibria import equilibria
from dalembert.analysis.friction.friction_status import refuse_friction
from dalembert.analysis.one_pass import Method, at_schedule
from dalembert.analysis.result.result import Result
from dalembert.errors import AnalysisError, ModelError
from dalembert.model import Mechanism


def kinematics(m: Mechanism, positions: int | None = None, strict: bool = False) -> Result:
    """Positions, velocities and accelerations; no forces (efforts and reactions are NaN)."""
    return _analyse(m, positions, strict, inertia=True, forces=False)


def statics(
    m: Mechanism, positions: int | None = None, strict: bool = False, method: Method = "auto"
) -> Result:
    """Joint forces and efforts without inertia; springs, weights and, at the drives' speeds, dampers act.

    ``method="careful"`` solves every position by itself, as is done anyway where something is in doubt: slower, and
    what the usual way is checked against.
    """
    return _analyse(m, positions, strict, inertia=False, forces=True, method=method)


def dynamics(
    m: Mechanism, positions: int | None = None, strict: bool = False, method: Method = "auto"
) -> Result:
    """Joint forces and efforts that keep the prescribed motion, by D'Alembert: A x + w - inertia = 0.

    ``method`` as in `statics`.
    """
    return _analyse(m, positions, strict, inertia=True, forces=True, method=method)


def solve(m: Mechanism, static: bool = False, positions: int | None = None, strict: bool = False) -> Result:
    """What the command ``dalembert solve`` does: with inertia when the file has speeds, unless ``static``."""
    if static or not m.has_speeds:
        return statics(m, positions, strict)
    return dynamics(m, positions, strict)


def _analyse(
    m: Mechanism, count: int | None, strict: bool, inertia: bool, forces: bool, method: Method = "auto"
) -> Result:
    try:
        schedule = m.schedule(count)
        if schedule.unknown is not None:
            refuse_friction(m)
            result = equilibria(m, schedule, inertia)
        else:
            result = at_schedule(m, schedule, inertia, forces, method)
    except ModelError as error:
        raise error.at_source(m.source) from None
    if strict and not result.ok.all():
        raise AnalysisError("; ".join(f"position {which}: {text}" for which, _, text in result.problems()))
    return result


def mobility(m: Mechanism) -> Mobility:
    """Freedoms, drives and redundant constraints of a mechanism, by the rank of its constraints where it first closes.

    Raises ModelError where it closes nowhere, and where drives and freedoms do not match.

    >>> from dalembert.model.library import four_bar
    >>> mobility(four_bar()).freedoms
    1
    """
    result = kinematics(m)
    if result.mobility is None:
        raise ModelError(str(result.reasons[0]), "", ("assembly",)).at_source(m.source)
    return result.mobility
