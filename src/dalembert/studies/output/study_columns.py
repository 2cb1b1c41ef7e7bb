"""The designs of a study as columns that are read by blocks: only the block being written is in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from dalembert.answer.column import WORD, Column
from dalembert.arrays import Array
from dalembert.studies.study_result import StudyResult


@dataclass(frozen=True)
class ByBlocks:
    """Numbers of many designs, read by slices."""

    count: int
    read: Callable[[int, int], Array]

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, rows: slice) -> Array:
        return self.read(*rows.indices(self.count)[:2])


def study_columns(r: StudyResult) -> Iterator[Column]:
    """Numbers, status and outputs."""
    count, kinds = r.study.count, r.study.number_kinds
    values = lru_cache(maxsize=1)(r.study.plan.values)
    for j, path in enumerate(r.study.paths):
        yield Column(path, kinds[path], ByBlocks(count, lambda a, b, j=j: values(a, b)[:, j]))  # type: ignore[misc]
    yield Column("status", WORD, r.status)
    for name in r.study.outputs:
        for place in np.ndindex(*r.arrays[name].shape[1:]):
            head = ".".join([name, *(str(k + 1) for k in place)])
            yield Column(head, r.kinds[name], ByBlocks(count, _reader(r, name, place)))


def _reader(r: StudyResult, name: str, place: tuple[int, ...]) -> Callable[[int, int], Array]:
    return lambda start, stop: np.asarray(np.moveaxis(r.arrays[name][start:stop], 0, -1)[place])
