"""Reactions that equilibrium leaves open, shared so that the joints' elastic energy is least (Castigliano, Menabrea).

Every set of multipliers is one that balances plus any that load nothing; the energy sum F^2 / (2 k) + M^2 / (2 kappa)
of all joints is least for one of them.
"""

from __future__ import annotations

import numpy as np

from tests.oracles.reading import Array
from tests.oracles.space.natural import Machine, Natural, null_reactions

Wrenches = dict[str, tuple[Array, Array]]


def shared(m: Machine, found: Natural, stiffness: dict[str, tuple[float, float]]) -> Wrenches:
    """Forces and moments (P, 3) of all joints for their stiffness against force and moment."""
    out: dict[str, list[Array]] = {name: [] for name in stiffness}
    for p in range(len(found.q)):
        free = null_reactions(m, found.q[p : p + 1])
        balanced = {
            name: np.concatenate([found.forces[name][p], found.moments[name][p]]) for name in stiffness
        }
        unloaded = {name: np.concatenate([free.forces[name], free.moments[name]], -1) for name in stiffness}
        weight = np.concatenate([np.repeat(np.sqrt(1 / np.array(k)), 3) for k in stiffness.values()])
        A = weight[:, None] * np.concatenate([unloaded[name].T for name in stiffness])
        b = weight * np.concatenate([balanced[name] for name in stiffness])
        amounts = np.linalg.lstsq(A, -b, rcond=None)[0]
        for name in stiffness:
            out[name].append(balanced[name] + amounts @ unloaded[name])
    return {name: (np.array(both)[:, :3], np.array(both)[:, 3:]) for name, both in out.items()}
