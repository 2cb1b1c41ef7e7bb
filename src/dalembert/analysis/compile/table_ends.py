"""Loads and efforts by tables that end before some position."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from dalembert.arrays import Array
from dalembert.model import Mechanism
from dalembert.model.load_types import Directed
from dalembert.model.quantities.tables import Table


@dataclass(frozen=True)
class Beyond:
    """A table of a load or effort (``what``), and the places (P,) at which it is read."""

    what: str
    table: Table
    at: Array


def beyond_ends(m: Mechanism, known: Mapping[str, Array]) -> tuple[Beyond, ...]:
    """Tables that refuse some position of what they are against, where that is known."""
    requested = ((what, table, known.get(table.against)) for what, table in _tables(m))
    return tuple(
        Beyond(what, table, at) for what, table, at in requested if at is not None and table.beyond(at).any()
    )


def _tables(m: Mechanism) -> Iterator[tuple[str, Table]]:
    for name, load in m.loads.items():
        if isinstance(load, Directed):
            yield from ((f"load {name!r}", value) for value in load.varying if isinstance(value, Table))
    for name, drive in m.drives.items():
        if isinstance(drive.effort, Table):
            yield f"effort of drive {name!r}", drive.effort
