"""Gradients of reductions: a peak's at the position where it stands, a mean's inside the kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.batch import reduction
from dalembert.kernel.graph import CONSTANT

if TYPE_CHECKING:
    from dalembert.analysis.batch.course import Course
    from dalembert.analysis.batch.runner import Runner

Array = NDArray[Any]


def slopes(
    runner: Runner,
    values: Array,
    course: Course,
    found: dict[str, range],
    parts: dict[tuple[int, str], Array],
    places: dict[tuple[int, str], Array],
    count: int,
    threads: int | None,
) -> dict[str, Array]:
    """Gradients (design[, component][, side of the envelope], number) of every reduced output."""
    k, out = runner.k, {}
    nodes_of = [n for nodes in k.nodes.values() for n in nodes]
    flat = len(nodes_of)
    for name, nodes in found.items():
        each = []
        for m in nodes:
            if k.reduce in ("peak", "envelope"):
                each.append(_active(runner, values, course, m, places, threads))
            elif nodes_of[m].level == CONSTANT:
                each.append(np.zeros((len(values), len(k.trace.numbers))))
            else:
                first = flat + m * len(k.trace.numbers)
                total = np.stack([parts[first + n, "sum"] for n in range(len(k.trace.numbers))], axis=-1)
                each.append(_mean(k.reduce, parts, m, total / count, count))
        out[name] = each[0] if len(each) == 1 else np.stack(each, axis=1)
    return out


def _mean(reduce: str, parts: dict[tuple[int, str], Array], m: int, total: Array, count: int) -> Array:
    if reduce == "mean":
        return total
    part = reduction.PARTS[reduce][0]
    size = reduction.finished(reduce, [parts[m, part]], count)[:, None]
    with np.errstate(all="ignore"):
        return np.asarray(total / size if reduce == "rms" else total / size**7)


def _active(
    runner: Runner,
    values: Array,
    course: Course,
    m: int,
    places: dict[tuple[int, str], Array],
    threads: int | None,
) -> Array:
    """Gradient of one component at the positions where its reduction stands."""
    k = runner.k
    program, machine, _ = runner.machine("gradient")
    columns, common = runner.inputs(program, course)
    flat, n = sum(len(nodes) for nodes in k.nodes.values()), len(k.trace.numbers)
    sides = []
    for part in reduction.located(k.reduce):
        place = places[m, part]
        place = np.where(np.isfinite(place) & (place < len(columns)), place, 0).astype(int)
        out, _ = runner.at_pairs(program, machine, values, columns[place], common, threads)
        rate = out[:, flat + m * n : flat + (m + 1) * n]
        sides.append(np.sign(out[:, m])[:, None] * rate if part == "argpeak" else rate)
    return sides[0] if k.reduce == "peak" else np.stack(sides, axis=1)
