"""Efforts by virtual power: no reaction, no matrix, positions in closed form.

For drive k, with every link's speed per unit speed of drive k alone,
effort_k = sum(m a . v_k + I alpha w_k) - sum(loads . v_k): what the drive must add.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.oracles.jets import Jet, Kinematics, jet
from tests.oracles.reading import Array, Machine, Tree, machine
from tests.oracles.wrenches import known


@dataclass(frozen=True)
class Motion:
    """Positions of the links (P, L, 3), their rates, and the efforts of the drives."""

    q: Array
    v: Array
    a: Array
    efforts: dict[str, Array]


def solve(tree: Tree, kinematics: Kinematics, inertia: bool = True) -> Motion:
    """``kinematics(*drives) -> {link: (x, y, angle)}`` in the drives' order, on jets."""
    m = machine(tree)
    driven = [Jet(d.position, d.speed, d.acceleration) for d in m.drives]
    q, v, a = _states(m, kinematics, driven)
    w = known(m, q, v, a if inertia else None)
    efforts = {}
    for k, drive in enumerate(m.drives):
        alone = [
            Jet(d.position, np.full_like(d.speed, float(n == k)), 0 * d.speed) for n, d in enumerate(m.drives)
        ]
        efforts[drive.name] = -np.sum(w * _states(m, kinematics, alone)[1], (1, 2))
    return Motion(q, v, a, efforts)


def _states(m: Machine, kinematics: Kinematics, driven: list[Jet]) -> list[Array]:
    poses = kinematics(*driven)
    state = np.zeros((3, len(m.drives[0].position), len(m.links), 3))
    for link, pose in poses.items():
        for k, part in enumerate(pose):
            j = jet(part)
            state[:, :, m.links.index(link), k] = np.stack(
                np.broadcast_arrays(j.x + 0 * driven[0].x, j.v, j.a)
            )
    return list(state)
