"""Sources of the spread of an output: each number's contribution, worst case, numbers without effect.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.batch.batch_result import NUMBERED, among
from dalembert.analysis.batch.over_positions import PLACES
from dalembert.arrays import Array
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.optimization.cycle_expressions import has_reductions
from dalembert.studies.sampling import DesignPlan
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.studies.design_study import Study

CORNERS = 12
"""Numbers of which all corners are tried; of more, that of the signs of the derivatives."""
STEP = 1e-3
"""Part of the standard deviation that a difference goes."""
SAMPLE = 256
"""Designs among which the place of a peak is compared."""
OFTEN = 0.01
"""Share of designs above which a moving peak is reported."""


class Contributions(NamedTuple):
    """Shares of the variance by path, the standard deviation, SI, of sobol the total shares too, and what to mind."""

    shares: dict[str, float]
    sigma: float
    total: dict[str, float]
    note: str


class CourseContributions(NamedTuple):
    """The same at every position (P,): standard deviation, SI, mean of the sampled designs, shares and total shares of
    the variance by path (NaN without scatter), and the samples in which some position has no value."""

    output: str
    sigma: Array
    mean: Array
    shares: dict[str, Array]
    total: dict[str, Array]
    lost: int


class WorstCase(NamedTuple):
    """The largest value, SI, the corner that has it, and what was assumed."""

    value: float
    at: dict[str, float]
    assumed: str


class ResponseCurve(NamedTuple):
    """An output along one number, or over two: paths, their values, and the output's (first[, second]), SI."""

    output: str
    paths: tuple[str, ...]
    axes: tuple[Array, ...]
    values: Array


def contributions(study: Study, output: str, by: str, designs: int) -> Contributions:
    """Implementation of `Study.contributions`."""
    if by not in ("linear", "sobol"):
        raise ModelError(f"unknown method of contributions {by!r}", "use linear or sobol")
    require("samples", designs, "designs")
    _check(study, output)
    return _linear(study, output) if by == "linear" else _sobol(study, output, designs)


def _check(study: Study, output: str) -> None:
    if study.plan.mixing is not None:
        raise ModelError("shares of correlated numbers are not defined", "leave the correlation out")
    _check_output(study, output)


def _check_output(study: Study, output: str) -> None:
    if study.plan.table is not None:
        raise ModelError("a table says no spread", "give vary= spreads")
    if output not in study.outputs:
        raise ModelError(
            f"{output!r} is not an output of the study", f"the outputs are {', '.join(study.outputs)}"
        )
    if study.reduce in (None, "envelope", *PLACES) and not has_reductions(output):
        raise ModelError(
            f"reduced by {study.reduce} it is not a single number", 'use reduce="peak", "rms", "mean"'
        )


def _answers(study: Study, output: str, values: Array) -> Array:
    """One number a design (design,)."""
    size = max(1, study.block_size())
    parts = (np.ascontiguousarray(values[k : k + size]) for k in range(0, len(values), size))
    numbers = np.concatenate([study.engine.block(part)[output] for part in parts])
    if numbers.ndim > 1:
        raise ModelError(
            f"{output} has {numbers[0].size} numbers a design", "ask for a scalar, as reaction.A.magnitude"
        )
    return numbers


def _middle(study: Study) -> Array:
    """The centre of each spread."""
    return np.array([sum(s.ends) / 2 for s in study.plan.spreads])


def slopes(study: Study, output: str) -> Array:
    """Derivatives of an output with respect to the numbers at the middle: central differences of tiny steps."""
    middle, sigma = _middle(study), np.array([s.sigma for s in study.plan.spreads])
    steps = np.diag(STEP * sigma)
    both = _answers(study, output, np.concatenate([middle + steps, middle - steps]))
    high, low = np.split(both, 2)
    return np.asarray((high - low) / np.where(sigma > 0, 2 * STEP * sigma, 1.0))


def _linear(study: Study, output: str) -> Contributions:
    """Shares (slope times standard deviation) squared, and whether they can be trusted."""
    sigma = np.array([s.sigma for s in study.plan.spreads])
    parts = (slopes(study, output) * sigma) ** 2
    total = float(parts.sum())
    shares = parts / total if total > 0 else parts
    return Contributions(
        dict(zip(study.paths, shares.tolist(), strict=True)),
        total**0.5,
        {},
        _trust(study, output, total**0.5),
    )


def _trust(study: Study, output: str, linear: float) -> str:
    """Reasons why the linear answer misleads: the peak is at another position in other designs, or the spread
    differs."""
    plan = DesignPlan(study.paths, study.plan.spreads, "random", SAMPLE, study.plan.seed)
    values = plan.values(0, SAMPLE)
    answers = _answers(study, output, values)
    sampled = float(np.nanstd(answers))
    comparison = f"the linear standard deviation is {linear:.4g}, of {SAMPLE} designs {sampled:.4g} (SI)"
    peak = study.reduce == "peak" and output not in study.end_kinds and not has_reductions(output)
    if peak and (jump := _jump(study, output, values)):
        return f'{jump}: {comparison}; use by="sobol"'
    if np.isfinite(sampled) and abs(sampled - linear) > 0.25 * max(sampled, linear):
        return f'it is not linear: {comparison}; use by="sobol"'
    return ""


def _jump(study: Study, output: str, values: Array) -> str:
    """Position of the peak where it is not that of most designs, and in how many; empty where this is rare."""
    places = _places(study, output, values)
    often, times = np.unique(places[np.isfinite(places)], return_counts=True)
    first = often[times.argmax()] if len(often) else 0.0
    off = np.abs(often - first)
    away = np.minimum(off, study.engine.positions - off) > 1
    if times[away].sum() <= OFTEN * len(values):
        return ""
    other = int(often[away][times[away].argmax()]) + 1
    share = times[away].sum() / len(values)
    along = "positions" if study.motion is None else "instants"
    return f"the peak jumps between {along} {int(first) + 1} and {other} (in {share:.0%} of {len(values)} designs)"


def _places(study: Study, output: str, values: Array) -> Array:
    """Position of the peak of each design, from 0."""
    return study.engine_for((output,), "argpeak").block(values)[output]


def _sobol_rows(study: Study, n: int) -> Array:
    """Numbers of n * (numbers + 2) designs: two samples A and B, then A with each column of B."""
    d = len(study.paths)
    if n & (n - 1):
        raise ModelError(f"the number of designs, {n}, is not a power of two", "use 4096, for example")
    both = DesignPlan(
        tuple(f"{path} {half}" for half in "AB" for path in study.paths),
        study.plan.spreads * 2,
        "sobol",
        n,
        study.plan.seed,
    ).values(0, n)
    a, b = both[:, :d], both[:, d:]
    mixed = []
    for j in range(d):
        ab = a.copy()
        ab[:, j] = b[:, j]
        mixed.append(ab)
    return np.concatenate([a, b, *mixed])


def _indices(y: Array) -> tuple[Array, Array, Array]:
    """First and total indices (number, ...) and the variance (...) of centred answers (2 + number, design, ...)."""
    fa, fb, fab = y[0], y[1], y[2:]
    variance = y[:2].var(axis=(0, 1))
    with np.errstate(all="ignore"):
        first = (fb * (fab - fa)).mean(axis=1) / variance
        total = ((fa - fab) ** 2).mean(axis=1) / (2 * variance)
    return first, total, variance


def _sobol(study: Study, output: str, designs: int) -> Contributions:
    """First-order and total Sobol indices (Saltelli 2010, Jansen 1999), from designs * (numbers + 2) designs."""
    d, n = len(study.paths), designs
    y = _answers(study, output, _sobol_rows(study, n)).reshape(d + 2, n)
    good = np.isfinite(y).all(axis=0)
    if good.sum() < 2:
        raise ModelError(f"hardly a design has a value of {output}", "make the spreads smaller")
    y = y[:, good] - y[:2, good].mean()
    first, total, spread = _indices(y)
    variance = float(spread)
    if not variance > 0:
        first, total = 0 * y[2:].mean(axis=1), 0 * y[2:].mean(axis=1)
    lost = int((~good).sum())
    note = f"{lost} of {n} rows left out, in which some design has no value" if lost else ""
    named = (dict(zip(study.paths, of.tolist(), strict=True)) for of in (first, total))
    return Contributions(next(named), variance**0.5, next(named), note)


def course_contributions(study: Study, output: str, designs: int) -> CourseContributions:
    """Implementation of `Study.contributions_along`: Sobol's indices of each position from the same designs."""
    require("samples", designs, "designs")
    if study.motion is not None:
        raise ModelError("motions under forces have no positions in common", "use contributions")
    _check(study, output)
    if has_reductions(output):
        raise ModelError(f"{output!r} is one number of the cycle", "use contributions")
    engine = study.engine_for((output,), None)
    rows = _sobol_rows(study, designs)
    size = max(1, study.block_size())
    parts = [
        engine.block(np.ascontiguousarray(rows[k : k + size]))[output] for k in range(0, len(rows), size)
    ]
    y = np.concatenate(parts)
    if y.ndim != 2:
        raise ModelError(f"{output} is a vector", f"ask for {output}.x or {output}.magnitude")
    y = y.reshape(len(study.paths) + 2, designs, -1)
    good = np.isfinite(y).all(axis=(0, 2))
    if good.sum() < 2:
        raise ModelError(f"hardly a design has a value of {output}", "make the spreads smaller")
    y = y[:, good]
    mean = y[:2].mean(axis=(0, 1))
    first, total, variance = _indices(y - mean)
    named = (dict(zip(study.paths, of, strict=True)) for of in (first, total))
    return CourseContributions(output, np.sqrt(variance), mean, next(named), next(named), int((~good).sum()))


def worst_case(study: Study, output: str) -> WorstCase:
    """Implementation of `Study.worst_case`."""
    _check(study, output)
    ends = np.array([s.ends for s in study.plan.spreads])
    if len(ends) <= CORNERS:
        corners = np.array(list(product(*ends)))
        assumed = f"the largest of all {len(corners)} corners; interior points are not searched"
    else:
        up = slopes(study, output) >= 0
        corners = np.array([np.where(up, ends[:, 1], ends[:, 0])])
        assumed = "the output is monotonic in each number: one corner, chosen by the signs of the derivatives"
    answers = _answers(study, output, corners)
    lost = int((~np.isfinite(answers)).sum())
    if lost:
        assumed += f"; {lost} corners have no value"
    if lost == len(answers):
        raise ModelError(f"no corner has a value of {output}", "make the spreads smaller")
    k = int(np.nanargmax(answers))
    return WorstCase(float(answers[k]), dict(zip(study.paths, corners[k].tolist(), strict=True)), assumed)


def response(study: Study, output: str, paths: Sequence[str], count: int) -> ResponseCurve:
    """Implementation of `Study.response`."""
    _check_output(study, output)
    for path in paths:
        if path not in study.paths:
            raise ModelError(f"{path!r} does not vary", closest(path, list(study.paths)))
    require("values", count, "count")
    if len(paths) not in (1, 2) or len(set(paths)) < len(paths):
        raise ModelError(f"{len(paths)} numbers, {count} values of each", "ask for one or two different ones")
    places = [study.paths.index(path) for path in paths]
    axes = tuple(np.linspace(*study.plan.spreads[k].ends, count) for k in places)
    rows = np.repeat(_middle(study)[None], count ** len(paths), axis=0)
    for k, values in zip(places, np.meshgrid(*axes, indexing="ij"), strict=True):
        rows[:, k] = values.ravel()
    answers = _answers(study, output, rows).reshape((count,) * len(paths))
    return ResponseCurve(output, tuple(paths), axes, answers)


def idle(study: Study) -> tuple[str, ...]:
    """Implementation of `Study.idle`."""
    if study.plan.table is not None:
        low, high = study.plan.table.min(axis=0), study.plan.table.max(axis=0)
    else:
        low, high = np.array([s.ends for s in study.plan.spreads]).T
    middle = (low + high) / 2
    rows = [middle]
    for j in range(len(middle)):
        for end in (low, high):
            moved = middle.copy()
            moved[j] = end[j]
            rows.append(moved)
    block = study.engine.block(np.array(rows))
    out = []
    for j, path in enumerate(study.paths):
        same = all(
            np.array_equal(a[[0, 0]], a[1 + 2 * j : 3 + 2 * j], equal_nan=a.dtype != np.uint8)
            for a in block.values()
        )
        if same and among(np.ravel(block["status"])[:1], NUMBERED)[0]:
            out.append(path)
    return tuple(out)
