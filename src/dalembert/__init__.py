"""Force analysis of mechanisms: motion, reactions, driving efforts, friction, and how they were found.

>>> import dalembert as da
>>> da.__version__
'0.1.0'
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from dalembert.errors import STATUSES, AnalysisError, DalembertError, ModelError

if TYPE_CHECKING:
    from dalembert.analysis import Result, dynamics, kinematics, mobility, solve, statics
    from dalembert.model import Mechanism, load, loads, mechanism

__version__ = "0.1.0"

_HOME = {
    "Mechanism": "model",
    "Result": "analysis",
    "dynamics": "analysis",
    "kinematics": "analysis",
    "load": "model",
    "loads": "model",
    "mechanism": "model",
    "mobility": "analysis",
    "solve": "analysis",
    "statics": "analysis",
}
"""Public name -> the package it is imported from when it is first asked for."""

__all__ = [
    "STATUSES",
    "AnalysisError",
    "DalembertError",
    "Mechanism",
    "ModelError",
    "Result",
    "__version__",
    "dynamics",
    "kinematics",
    "load",
    "loads",
    "mechanism",
    "mobility",
    "solve",
    "statics",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
