"""One variant of a problem as a record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


@dataclass(frozen=True)
class Variant:
    """One variant: its name (01, 02, ...), the values drawn, its problem with the right answers, its result."""

    name: str
    values: Mapping[str, object]
    mechanism: Mechanism
    result: Result
    key: tuple[dict[str, object], ...]
