"""Random mechanisms followed far from the pose they are drawn in: the branch is that of a march in small steps."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.oracles.reading import Array, Tree
from tests.oracles.space import natural, random_drawn
from tests.tiers import tiers

POSITIONS, SUBSTEPS = 25, 5


def widened(seed: int, count: int) -> Tree:
    """The drives over up to 1.5 rad or 0.25 m, in equal steps."""
    tree, _, _ = random_drawn.mechanism(seed)
    rng = np.random.default_rng([7, seed])
    for drive in tree["drives"].values():
        start, unit = drive["position"]["from"].split()
        end = float(start) + rng.uniform(-1, 1) * (1.5 if unit == "rad" else 0.25)
        drive["position"] = {"from": f"{start} {unit}", "to": f"{end} {unit}", "count": count}
    return tree


def followed(tree: Tree) -> list[Array]:
    """Coordinates (4 L, 3) step by step, until a step is long, does not close or comes near a singular pose."""
    whole = natural.Machine(tree)
    q, path = random_drawn.laid(whole, tree)[None], []
    for k in range(whole.count):
        m = natural.at_position(tree, whole, k)
        after, gap = natural.closed(m, q, 1e-9)
        _, J, _, _ = natural.system(m.rows, after, 0 * after)
        values = np.linalg.svd(J[0], compute_uv=False)
        if not gap < 1e-12 or np.max(np.abs(after - q)) > 0.25 or values[-1] < 3e-3 * values[0]:
            break
        q = after
        path.append(q[0])
    return path


@pytest.mark.parametrize("seed", tiers([], range(8), range(8, 20)))
def test_positions_are_on_the_branch_drawn(seed: int) -> None:
    r = da.kinematics(da.mechanism(widened(seed, POSITIONS)))
    tree = widened(seed, (POSITIONS - 1) * SUBSTEPS + 1)
    path = np.array(followed(tree)[::SUBSTEPS])
    m = natural.Machine(tree)
    for k, link in enumerate(m.links[1:], 1):
        position, rotation = r.position(link)[: len(path)], r.rotation(link)[: len(path)]
        np.testing.assert_allclose(position, path[:, 4 * k], rtol=0, atol=1e-10)
        axes = np.swapaxes(path[:, 4 * k + 1 : 4 * k + 4], 1, 2)
        np.testing.assert_allclose(rotation, axes, rtol=0, atol=1e-10)
