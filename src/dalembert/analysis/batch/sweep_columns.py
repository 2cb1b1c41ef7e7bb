"""The numbers of a sweep as columns, a row a position of each design, and as labelled arrays."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.column import WORD, Column, Scale, parts
from dalembert.arrays import Tree

if TYPE_CHECKING:
    from dalembert.analysis.batch.design_sweep import Sweep


def sweep_columns(s: Sweep) -> Iterator[Column]:
    """Number of design and position, what is varied, drives, status, quantities, reason."""
    count, rows = s.status.shape[-1], s.status.size
    yield Column("design", WORD, np.repeat(np.arange(rows // count) + 1, count))
    yield Column("position", WORD, np.tile(np.arange(count) + 1, rows // count))
    grid = np.indices(s.shape).reshape(len(s.shape), -1)
    for k, (path, of) in enumerate(s.labels.items()):
        values = np.array(of.values, float if isinstance(of.values[0], float) else object)
        kind = WORD if values.dtype == object else of.kind
        yield Column(path, kind, np.repeat(values[grid[0 if s.together else k]], count))
    for k, drive in enumerate(s.nominal.drives):
        kind = drive_kinds(s.nominal, drive)["position"]
        yield Column(f"drive.{drive}", kind, s.answers.drives[..., k].reshape(-1))
    yield Column("status", WORD, s.status.reshape(-1))
    for before, arrays in (("", s.answers.arrays), ("after.", s.answers.after)):
        for name, values in arrays.items():
            flat = values.reshape((rows, *values.shape[s.status.ndim :]))
            for part, numbers in parts(flat):
                yield Column(f"{before}{name}{part}", s.kinds[name], numbers)
    yield Column("reason", WORD, s.answers.reasons.reshape(-1))


def sweep_arrays(s: Sweep, to: Scale) -> tuple[Tree, Tree]:
    """Quantities over the values of the paths, position and component, and coordinates."""
    over_designs = ("design",) if s.together else s.paths
    data: Tree = {"status": ((*over_designs, "position"), s.status.astype(str))}
    for name, values in s.answers.arrays.items():
        rest = ("component", "link_axis")[: values.ndim - len(s.shape) - 1]
        over = (*over_designs, "position", *rest)
        data[name] = (over, to(s.kinds[name], values), {"units": to.text(s.kinds[name])})
    names: Tree = {"position": np.arange(1, s.status.shape[-1] + 1)}
    names["component"] = list("xyz"[: s.mechanism.dimension])
    for path, labels in s.labels.items():
        shown = to(labels.kind, np.array(labels.values)) if labels.unit else list(labels.values)
        names[path] = ("design" if s.together else path, shown, {"units": to.text(labels.kind)})
    for k, drive in enumerate(s.nominal.drives):
        kind = drive_kinds(s.nominal, drive)["position"]
        values = to(kind, s.answers.drives[..., k])
        names[f"drive_{drive}"] = ((*over_designs, "position"), values, {"units": to.text(kind)})
    return data, names
