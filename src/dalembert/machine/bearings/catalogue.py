"""A table of bearings as a maker prints it, a text file with columns name, C, C0, d; and the row that is enough."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from dalembert.errors import ModelError
from dalembert.machine.bearings.bearing_load import BearingLoad
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.column_files import read_quantities
from dalembert.units import Units

KINDS = {"C": "force", "C0": "force", "d": "length"}


class CatalogueBearing(NamedTuple):
    """A bearing: dynamic and static rating, N, and bore, m."""

    name: str
    C: float
    C0: float
    d: float


def catalogue(file: str | Path, units: Units | None = None) -> list[CatalogueBearing]:
    """The rows of a table; numbers whose head names no unit are in these (default SI).

    Raises ModelError with file and line for what is missing, no number or not positive.
    """
    columns, lines = read_quantities(file, KINDS, ReadingRules(units), "name")
    for name in KINDS:
        for value, line in zip(columns[name], lines, strict=True):
            if value <= 0:
                raise ModelError(f"{name} is not positive", "give a positive number", (), str(file), line)
    return [
        CatalogueBearing(*row)
        for row in zip(*(columns[name] for name in CatalogueBearing._fields), strict=True)
    ]


def choose(
    load: BearingLoad, rows: list[CatalogueBearing], hours: float, factor: float = 1.0, safety: float = 1.0
) -> CatalogueBearing | None:
    """The smallest bearing, by bore, then by rating, that lives so long; None where none does.

    Its C is at least ``rating_for`` the hours, C0 ``safety`` times the largest load, d the pin's diameter.
    """
    needed = load.rating_for(hours, factor), safety * factor * float(load.load.max())
    bore = (load.bearing.diameter if load.bearing else None) or 0.0
    enough = [
        row for row in rows if needed[0] <= row.C and needed[1] <= row.C0 and row.d >= bore * (1 - 1e-9)
    ]
    return min(enough, key=lambda row: (row.d, row.C), default=None)
