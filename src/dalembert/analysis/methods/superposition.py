"""Superposition: every reaction and effort split by what causes it (docs/theory.md 5.2).

A x + w = 0 is linear in w, so the answer to a sum of wrenches is the sum of the answers, each computed with the same
factored A. Dry friction and the separating force of gear teeth depend on magnitudes, and are refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, State, known_actions, state
from dalembert.analysis.methods.belt_tensions import belt_tensions
from dalembert.analysis.result.reaction_axes import force_and_moment
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.core.elements.belt_pulls import BeltPulls
from dalembert.core.equilibrium import balance, reactions, relative
from dalembert.core.forcing import WrenchSource, total_wrench
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def with_sum(parts: Array) -> Array:
    """Parts (S, ...) with their sum as one more behind them (S + 1, ...)."""
    return np.concatenate([parts, parts.sum(axis=0, keepdims=True)])


def directions(parts: Array) -> Array:
    """Angles (S,) of planar forces (S, 2), rad; nan of one that is only rounding beside the largest.

    >>> np.rad2deg(directions(np.array([[0.0, 2.0], [-3.0, -1e-17], [0.0, 0.0]]))).tolist()
    [90.0, 180.0, nan]
    """
    size = np.hypot(*parts.T)
    x, y = np.where(np.abs(parts) > 1e-12 * size[:, None], parts, 0.0).T
    return np.asarray(np.where(size > 1e-12 * size.max(initial=0.0), np.arctan2(y, x), np.nan))


@dataclass(frozen=True, eq=False)
class Superposition(Compared):
    """Parts of the answer, one per source, that sum to the total; ``sources`` is the order of the arrays' first
    axis."""

    result: Result = field(repr=False)
    sources: tuple[str, ...]
    force: Array = field(repr=False)  # (S, P, joints, d) on j
    moment: Array = field(repr=False)  # (S, P, joints), in space (S, P, joints, 3)
    efforts: Array = field(repr=False)  # (S, P, D)
    loads: Array = field(repr=False)  # (S, P, U)

    def effort(self, drive: str) -> dict[str, Array]:
        """Part of a drive's effort (P,) by source."""
        k = self.result.drives.index(drive)
        return dict(zip(self.sources, self.efforts[..., k], strict=True))

    def reaction(self, joint: str, on: str | None = None) -> dict[str, Array]:
        """Part of a joint's force (P, d) by source, ground axes, on ``on`` (default j)."""
        k, sign = self.result._joint(joint, on)
        kept, _ = force_and_moment(self.result.unique(joint))
        return {
            s: np.where(kept, sign * f, np.nan)
            for s, f in zip(self.sources, self.force[:, :, k], strict=True)
        }

    def reaction_moment(self, joint: str, on: str | None = None) -> dict[str, Array]:
        """Part of a joint's moment about j's point (P,), in space (P, 3), by source, on ``on`` (default j)."""
        k, sign = self.result._joint(joint, on)
        _, kept = force_and_moment(self.result.unique(joint))
        return {
            s: np.where(kept, sign * m, np.nan)
            for s, m in zip(self.sources, self.moment[:, :, k], strict=True)
        }

    def unknown_load(self, name: str) -> dict[str, Array]:
        """Part of an unknown load (P,) by source."""
        k = self.result.unknown_loads.index(name)
        return dict(zip(self.sources, self.loads[..., k], strict=True))

    @property
    def gap(self) -> Array:
        """Largest difference between the sum of the parts and the total (P,), over the largest part."""
        r = self.result
        size = len(r.status)
        out, largest = np.zeros(size), np.zeros(size)
        length = r.compiled.layout.length
        for parts, total, scale in (
            (self.force, r.force_array, 1.0),
            (self.moment, r.moment_array, 1 / length),
            (self.efforts, r.effort_array, 1 / length),
            (self.loads, r.load_array, 1.0),
        ):
            rest = tuple(range(1, total.ndim))
            gap = np.abs(parts.sum(axis=0) - total).max(axis=rest, initial=0.0)
            biggest = np.abs(parts).max(axis=(0, *(k + 1 for k in rest)), initial=0.0)
            out, largest = np.maximum(out, gap * scale), np.maximum(largest, biggest * scale)
        return relative(out, largest)

    def case(self, *sources: str) -> Result:
        """The answer to some sources alone, the others taken away: a sub-case."""
        which = [self.sources.index(s) for s in sources]
        return replace(
            self.result,
            force_array=self.force[which].sum(axis=0),
            moment_array=self.moment[which].sum(axis=0),
            effort_array=self.efforts[which].sum(axis=0),
            load_array=self.loads[which].sum(axis=0),
        )


def superposition(r: Result) -> Superposition:
    """Every reaction, effort and unknown load of a result split by source.

    Sources are each load by its name, `weight of LINK`, `inertia force of LINK`, `inertia couple of LINK`, each spring
    and damper, `damping of JOINT`, `tension of BELT` and given efforts. Raises ModelError where the answer is not
    linear in them.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> parts = da.superposition(da.dynamics(da.load(examples()["four_bar"])))
    >>> f"{float(sum(parts.effort('O2').values())[0]):.4f} N m, gap below 1e-11: {bool(parts.gap.max() < 1e-11)}"
    '27.4822 N m, gap below 1e-11: True'
    """
    refuse_nonlinear(r)
    at = state(r)
    known = known_actions(r, at)
    sources = tuple(dict.fromkeys(a.source for a in known))
    parts = [_solve_under(r, at, _total(r, [a for a in known if a.source == s])) for s in sources]
    for k, drive in enumerate(r.drives):
        if not r.compiled.known.requested[k]:
            sources = (*sources, f"effort of {drive}")
            parts.append(_solve_under(r, at, _total(r, []), drive=k))
    for name, pulls, source in belt_tensions(r, at):
        w = total_wrench(r.compiled.layout, source)
        sources = (*sources, f"tension of {name}")
        parts.append(_solve_under(r, at, np.broadcast_to(w, (len(r.status), *w.shape[1:])), belts=pulls))
    if not parts:
        return _nothing(r)
    return Superposition(r, sources, *(np.stack(p) for p in zip(*parts, strict=True)))


def forces_of(r: Result, first: str) -> tuple[Array, Array, Array, Array]:
    """Forces, moments, efforts and unknown loads of the sources whose names begin with a word, alone."""
    refuse_nonlinear(r)
    at = state(r)
    return _solve_under(r, at, _total(r, [a for a in known_actions(r, at) if a.source.startswith(first)]))


def refuse_nonlinear(r: Result) -> None:
    """Forces that depend on other forces' magnitudes do not add."""
    if not r.assumptions.get("friction", "off").startswith("off"):
        raise ModelError(
            "superposition is refused: with dry friction the forces do not add, because it depends on |F|",
            "leave friction out with --no-friction, or use --method matrix",
        )
    if r.compiled.forcing.belts is not None and r.compiled.forcing.belts.share.any():
        raise ModelError(
            "superposition is refused: the pull of a belt with a given strand follows |T1 - T2|, which does not add",
            "use --method matrix, or give the belt's tension or tensioner",
        )
    if r.compiled.forcing.separation.any():
        raise ModelError(
            "superposition is refused: the separating force of gear teeth depends on |F|, so the parts do not add",
            "use --method matrix, or set pressure_angle: 0 deg",
        )


def _total(r: Result, some: list[Action]) -> Array:
    """Wrench of some actions on each moving link (P, L, n), about the reference points."""
    count, g = len(r.status), r.compiled.layout.algebra
    index = {name: k for k, name in enumerate(r.links)} | {"ground": len(r.links)}
    wrenches = np.zeros((count, len(some), g.n))
    for k, a in enumerate(some):
        link = index[a.link]
        about = np.zeros(g.d) if link == len(r.links) else r.point_array[:, link, :]
        wrenches[:, k, : g.d] = a.force
        wrenches[:, k, g.d :] = a.moment(about + r.compiled.origin).reshape((count, g.n - g.d))
    return total_wrench(
        r.compiled.layout, WrenchSource(np.array([index[a.link] for a in some], np.intp), wrenches)
    )


def _solve_under(
    r: Result, at: State, w: Array, drive: int | None = None, belts: BeltPulls | None = None
) -> tuple[Array, Array, Array, Array]:
    """Forces, moments, efforts and unknown loads for wrenches w alone, or for one given effort alone."""
    c = r.compiled
    effort = np.where(c.known.requested, np.nan, 0.0) * np.ones_like(c.known.effort)
    if drive is not None:
        effort[:, drive] = c.known.effort[:, drive]
    with np.errstate(all="ignore"):
        known = replace(c.known, effort=effort)
        equilibrium = balance(
            c.layout, replace(c.forcing, belts=belts), known, at.pose, at.moving, at.rows, at.solver, w
        )
        force, couple = reactions(c.layout, at.pose, at.rows, equilibrium)
    return force, couple if c.layout.algebra.d == 3 else couple[..., 0], equilibrium.effort, equilibrium.load


def changed_by(r: Result, added: Sequence[Action]) -> Result:
    """The answer with some forces and couples more on its links, whatever the motion; ``refuse_nonlinear`` first.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> r = da.dynamics(da.load(examples()["four_bar"]))
    >>> bool((changed_by(r, []).force_array == r.force_array).all())
    True
    """
    with np.errstate(all="ignore"):  # no number where a point or a motion has none
        parts = _solve_under(r, state(r), _total(r, list(added)))
    names = ("force_array", "moment_array", "effort_array", "load_array")
    return replace(r, **{name: getattr(r, name) + part for name, part in zip(names, parts, strict=True)})


def _nothing(r: Result) -> Superposition:
    shapes = (r.force_array, r.moment_array, r.effort_array, r.load_array)
    return Superposition(r, (), *(np.zeros((0, *a.shape)) for a in shapes))
