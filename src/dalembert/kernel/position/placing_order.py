"""Order in which links can be placed, and the effect of redundant rows on it.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

import numpy as np

from dalembert.core.constraints import dense, stack_rows
from dalembert.core.layout import Layout, Pose
from dalembert.core.position.assur_groups import independent_rows
from dalembert.kernel.elimination import components, maximum_matching
from dalembert.kernel.graph import Graph, Node

UNDETERMINED = "the positions are not determined by the drives"


def dependent_rows(graph: Graph, layout: Layout, known: Pose) -> frozenset[int]:
    """Stacked rows that are dependent on previous ones, in the file's motion."""
    s = layout.stack
    rows = stack_rows(layout, known)
    ends = np.stack([rows.on_i, rows.on_j])
    nodes = [x if type(x) is Node else graph.constant(x) for x in ends.ravel()]
    sampled = np.array(np.broadcast_arrays(*graph.evaluate(nodes, {})), float)
    on_i, on_j = np.moveaxis(sampled.reshape(*ends.shape, -1), -1, 1)
    j = dense(layout, rows._replace(on_i=on_i, on_j=on_j)) * layout.row_scale[:, None] * layout.column_scale
    held = (j != 0).any(axis=(0, 1)).sum()
    kept = np.zeros(0, np.intp)
    for one in j[np.isfinite(j).all(axis=(1, 2))]:
        independent = independent_rows(one, np.arange(s.count))
        kept = max(kept, independent, key=len)
        if len(kept) == held:
            break
    return frozenset(range(s.count)) - set(kept.tolist())


def blocks(ends: dict[int, set[int]], n: int, dependent: frozenset[int]) -> list[list[int]]:
    """Parts that can only be placed together, those without unplaced dependencies first, from the parts ``ends`` of
    each row, -1 the ground.

    Links that a redundant row could hold instead of others are placed at once with all their rows, except links held by
    one joint, which never fails.
    """
    free = {row: of - {-1} for row, of in ends.items()}
    wants = {
        row: {n * b + c for b in of for c in range(n)} for row, of in free.items() if row not in dependent
    }
    match, parts = maximum_matching(wants), set().union(*free.values())
    if len(match) < n * len(parts):
        raise ValueError(UNDETERMINED)
    needs: dict[int, set[int]] = {}
    holders: dict[int, set[int]] = {}
    for row, column in match.items():
        part = column // n
        needs[part] = needs.get(part, set()) | free[row] - {part}
        holders[part] = holders.get(part, set()) | ends[row] - {part}
    for row in dependent & ends.keys():
        tied = [b for b in free[row] if len(holders[b]) > 1]
        for b in tied:
            tied += [other for other in needs[b] if other not in tied and len(holders[other]) > 1]
        for b in tied:
            needs[b] = needs[b] | set(tied)
    return [sorted(block) for block in components(needs)]
