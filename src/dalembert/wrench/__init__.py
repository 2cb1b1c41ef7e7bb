"""Force systems without a mechanism, in the plane and in space: ``da.wrench``.

Forces at points and couples form a `System`. It gives its resultant, its moment about a point or an axis, the force and
couple at any point, its central axis, and whether it is in equilibrium. Numbers are SI and radians, texts carry their
units.

In: forces and couples at points. Out: sums, axes, verdicts. Imports ``algebra``, ``model``, ``analysis``.

>>> import dalembert as da
>>> w = da.wrench
>>> s = w.System(w.Force("600 @ 60 N", at=["200 mm", 0]), w.Force([0, -400], at=[0.5, 0]), w.Couple("-20 N*m"))
>>> s.resultant.round(1), round(s.moment([0, 0]), 2)
(array([300. , 119.6]), -116.08)
>>> s.central_axis().axis.crossing(y=0).round(4)         # where the resultant's line cuts the x axis
array([-0.9704,  0.    ])
"""

from dalembert.wrench.arrangements import arrangement as arrangement
from dalembert.wrench.arrangements import concurrency as concurrency
from dalembert.wrench.arrangements import parallel_center as parallel_center
from dalembert.wrench.balance_check import ForceSums as ForceSums
from dalembert.wrench.forces import Axis as Axis
from dalembert.wrench.forces import Couple as Couple
from dalembert.wrench.forces import Force as Force
from dalembert.wrench.forces import components as components
from dalembert.wrench.free_body_system import on as on
from dalembert.wrench.system import CentralAxis as CentralAxis
from dalembert.wrench.system import ForceCouple as ForceCouple
from dalembert.wrench.system import System as System
from dalembert.wrench.system_files import load as load
from dalembert.wrench.system_files import loads as loads
