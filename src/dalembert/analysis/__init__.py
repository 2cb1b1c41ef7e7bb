"""One question a file, Mechanism -> Result."""

from dalembert.analysis.degree_of_freedom import Mobility, mobility
from dalembert.analysis.result import Result
from dalembert.analysis.solution import dynamics, kinematics, solve, statics

__all__ = ["Mobility", "Result", "dynamics", "kinematics", "mobility", "solve", "statics"]
