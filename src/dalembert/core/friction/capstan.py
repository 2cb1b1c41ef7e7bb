"""The capstan equation: tensions of a band, rope or belt that slips on a drum.

Mechanics: docs/theory.md 6.1.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.core.branchless import above, tangent, tanh, where


def capstan(mu: Array, wrap: Array, blocks: Array) -> Array:
    """Difference of the two tensions of a slipping band over their mean, 2 (R - 1) / (R + 1).

    R = exp(mu wrap) is their ratio (Euler-Eytelwein), with n blocks of wrap/n each ((1 + mu tan b) / (1 - mu tan b))^n,
    b = wrap/2n. Both are hyperbolic tangents: 2 tanh(mu wrap/2) and 2 tanh(n artanh(mu tan b)). 2, all of the tension,
    where mu tan b is not below 1: then a block grips at any tension.
    """
    out = np.array(np.broadcast_arrays(tanh(mu * wrap * 0.5), wrap)[0])
    for e in np.flatnonzero(blocks):
        steep = mu[..., e] * tangent(wrap[..., e] / (2 * blocks[e]))
        grip = ~above(-steep, -1.0)
        part = steep = where(grip, 1.0, steep)
        for _ in range(int(blocks[e]) - 1):
            part = (part + steep) / (1.0 + part * steep)
        out[..., e] = part
    return np.asarray(2.0 * out)
