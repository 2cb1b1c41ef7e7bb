"""Force systems as a tool of their own, in the plane and in space: ``da.wrench``.

Forces at points and couples make a `System`; ask it for its resultant, its moment about a point or an axis, the force
and couple at any point, its central axis, and whether it is in equilibrium. Numbers are SI and radians, texts carry
their units.

In: forces and couples at points. Out: sums, axes, verdicts. Imports ``algebra``, ``model``, ``analysis``.

>>> import dalembert as da
>>> w = da.wrench
>>> s = w.System(w.Force("600 @ 60 N", at=["200 mm", 0]), w.Force([0, -400], at=[0.5, 0]), w.Couple("-20 N*m"))
>>> s.resultant.round(1), round(s.moment([0, 0]), 2)
(array([300. , 119.6]), -116.08)
>>> s.central_axis().axis.crossing(y=0).round(4)         # where the resultant's line cuts the x axis
array([-0.9704,  0.    ])
"""

from dalembert.wrench.arrangements import arrangement, concurrency, parallel_center
from dalembert.wrench.balance_check import Balance
from dalembert.wrench.forces import Axis, Couple, Force, components
from dalembert.wrench.free_body_system import on
from dalembert.wrench.system import CentralAxis, ForceCouple, System
from dalembert.wrench.system_files import load, loads

__all__ = [
    "Axis",
    "Balance",
    "CentralAxis",
    "Couple",
    "Force",
    "ForceCouple",
    "System",
    "arrangement",
    "components",
    "concurrency",
    "load",
    "loads",
    "on",
    "parallel_center",
]
