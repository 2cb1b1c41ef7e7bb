"""Parts at rest beside elastic stops of joints, whose forces change what friction holds.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import joint_stops
from dalembert.machine.motion.rest.standstill import at_state
from dalembert.machine.motion.rest.sticking import StickState
from dalembert.machine.motion.stops.stop_loads import loads_of_stops
from dalembert.model import Mechanism


class ElasticRestState(StickState):
    """A motion whose tests of rest include the forces of joints' elastic stops."""

    def loaded_model(self, t: float, q: Array, u: Array) -> Mechanism:
        """The mechanism with the forces of joints' elastic stops as loads."""
        if not self.elastic_joints:
            return self.m
        force, terms = np.zeros((2, len(joint_stops(self.m)))), self.equation(t, q, u)
        for j, x in self.elastic_forces(terms).items():
            force[:, j] = x
        if not force.any():
            return self.m
        r = at_state(self.m, self.acting.position, t, q, u, 0.0 * u)
        loads = loads_of_stops(r, list(joint_stops(self.m)), force, lambda values: float(values[-1]))
        return self.m.model_copy(update={"loads": {**self.m.loads, **loads}})
