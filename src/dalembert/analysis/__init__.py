"""One question a file, Mechanism -> Result."""

from dalembert.analysis.mobility import Mobility, mobility
from dalembert.analysis.result import Result
from dalembert.analysis.solve import dynamics, kinematics, solve, statics

__all__ = ["Mobility", "Result", "dynamics", "kinematics", "mobility", "solve", "statics"]
