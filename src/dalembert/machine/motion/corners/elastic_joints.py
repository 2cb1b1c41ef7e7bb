"""Elastic stops of joints that no drive moves: their forces on the drives, at each state.

A force F in a joint's freedom x is n^T F on the drives, where n = dx/dq, and has the power F x'.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import Actuation, joint_stops
from dalembert.machine.motion.coded.acting_nodes import within
from dalembert.machine.motion.corners.elastic_stops import ElasticStops
from dalembert.machine.motion.equation import Terms
from dalembert.machine.motion.rest.standstill import ContactState
from dalembert.model import Mechanism
from dalembert.model.quantities.coordinates import SPEED


class ElasticState(ContactState):
    """A motion some of whose joints have elastic stops; ``turned``: their last positions, full turns counted."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.turned = dict[int, float]()
        for j, ((name, freedom), stops) in enumerate(joint_stops(m).items()):
            if stops.stiffness:
                what = f"the stop of joint {name!r}"
                self.elastic_joints[j] = ElasticStops(None, what, name=name, freedom=freedom, stops=stops)

    def joint_motion(self, j: int, terms: Terms) -> dict[str, float]:
        """Position and rate of such a joint by its name, full turns counted from the last state on."""
        elastic, (x, rate) = self.elastic_joints[j], terms.freedoms[j][:2].tolist()
        if elastic.freedom == "turn" and np.isfinite(x):
            last = self.turned.get(j, within(elastic.stops, x))
            x += 2 * np.pi * round((last - x) / (2 * np.pi))
            self.turned[j] = x
        return {elastic.name: x, elastic.name + SPEED: rate}

    def elastic_force(self, j: int, terms: Terms) -> float:
        """Force of a joint's elastic stop in its freedom, N m or N."""
        return self.elastic_joints[j].at(self.joint_motion(j, terms))

    def elastic_forces(self, terms: Terms) -> dict[int, float]:
        """Forces of all of them."""
        return {j: self.elastic_force(j, terms) for j in self.elastic_joints}

    def loaded_terms(self, t: float, q: Array, u: Array) -> Terms:
        """The terms with the forces of joints' elastic stops, on which friction depends."""
        terms = self.equation(t, q, u)
        if not self.elastic_joints:
            return terms
        forces = self.elastic_forces(terms)
        if self.equation.dry:
            return self.equation.pushed(forces, t, q, u)
        push = sum((x * terms.freedoms[j][3:] for j, x in forces.items()), np.zeros(self.d))
        power = sum(x * terms.freedoms[j][1] for j, x in forces.items())
        return terms._replace(effort=terms.effort - push, power=terms.power + np.array([power, 0.0]))
