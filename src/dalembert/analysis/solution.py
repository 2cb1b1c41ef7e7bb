"""The analyses: kinematics, statics, dynamics of a description over its positions, and its mobility."""

from __future__ import annotations

from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.equilibria import equilibria
from dalembert.analysis.friction.friction_status import refuse_friction
from dalembert.analysis.one_pass import Method, at_schedule
from dalembert.analysis.result.result import Result
from dalembert.errors import AnalysisError, ModelError
from dalembert.model import AtPositions, ModelOrPath, as_mechanism


def kinematics(m: ModelOrPath, positions: AtPositions = None, strict: bool = False) -> Result:
    """Positions, velocities and accelerations; no forces (efforts and reactions are NaN).

    ``positions``, here and in the other analyses: how many, or values of the drives (P,) or (P, D), SI, instead of the
    file's. ``strict``: raise AnalysisError where a position has no answer.

    >>> import dalembert as da
    >>> da.kinematics(da.four_bar(), positions=[0.1, 0.2])["drive.O2"]
    array([0.1, 0.2])
    """
    return _analyse(m, positions, strict, inertia=True, forces=False)


def statics(
    m: ModelOrPath, positions: AtPositions = None, strict: bool = False, method: Method = "auto"
) -> Result:
    """Joint forces and efforts without inertia; springs, weights and, at the drives' speeds, dampers act.

    ``method="careful"`` solves every position separately, as is always done where a position is in doubt: slower, used
    to check the usual method.

    >>> import dalembert as da
    >>> statics(da.four_bar()).effort("O2").shape
    (72,)
    """
    return _analyse(m, positions, strict, inertia=False, forces=True, method=method)


def dynamics(
    m: ModelOrPath, positions: AtPositions = None, strict: bool = False, method: Method = "auto"
) -> Result:
    """Joint forces and efforts that keep the prescribed motion, by D'Alembert: A x + w - inertia = 0.

    ``method`` as in `statics`.

    >>> from dalembert.bundled import examples
    >>> r = dynamics(examples()["four_bar"])
    >>> round(float(r.effort("O2")[0]), 4)    # N m
    27.4822
    """
    return _analyse(m, positions, strict, inertia=True, forces=True, method=method)


def solve(
    m: ModelOrPath, static: bool = False, positions: AtPositions = None, strict: bool = False
) -> Result:
    """Solution as by the command ``dalembert solve``: with inertia when the file has speeds, unless ``static``.

    >>> from dalembert.bundled import examples
    >>> solve(examples()["four_bar"]).status
    ('ok',)
    """
    m = as_mechanism(m)
    if static or not m.has_speeds:
        return statics(m, positions, strict)
    return dynamics(m, positions, strict)


def _analyse(
    m: ModelOrPath, positions: AtPositions, strict: bool, inertia: bool, forces: bool, method: Method = "auto"
) -> Result:
    m = as_mechanism(m)
    try:
        schedule = m.schedule(positions)
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


def mobility(m: ModelOrPath) -> Mobility:
    """Freedoms, drives and redundant constraints of a mechanism, by the rank of its constraints where it first closes.

    Raises ModelError where it closes nowhere, and where drives and freedoms do not match.

    >>> from dalembert.model.library import four_bar
    >>> mobility(four_bar()).freedoms
    1
    """
    m = as_mechanism(m)
    result = kinematics(m)
    if result.mobility is None:
        raise ModelError(str(result.reasons[0]), "", ("assembly",)).at_source(m.source)
    return result.mobility
