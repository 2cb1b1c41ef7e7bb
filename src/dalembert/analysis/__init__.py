"""One question a file, Mechanism -> Result.

In: a ``Mechanism``, positions asked for. Out: a ``Result``, or a smaller answer. ``one_pass`` is the path
from the one to the other. Imports ``core``, ``kernel``, ``model``.
"""

from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import dynamics, kinematics, mobility, solve, statics

__all__ = ["Mobility", "Result", "dynamics", "kinematics", "mobility", "solve", "statics"]
