"""One variant of a problem as a record, and the rows of a key."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

Progress = Callable[[str, int, int], None]
"""Told of what is done, how many are done, and how many there are to be."""


@dataclass(frozen=True)
class Variant:
    """One variant: its name (01, 02, ...), the values drawn, its problem with the right answers, its result."""

    name: str
    values: Mapping[str, object]
    mechanism: Mechanism
    result: Result
    key: tuple[dict[str, object], ...]


def key_rows(found: Sequence[Variant], folder: str) -> list[dict[str, object]]:
    """A row an asked figure, with the file of its variant in a folder."""
    start = f"{folder}/" if folder else ""
    return [{"variant": v.name, "file": f"{start}{v.name}.yaml", **row} for v in found for row in v.key]
