"""A result written out: tables (CSV, workbook, DataFrame) and labelled arrays (xarray, netCDF)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO, TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.output.columns import (
    BY_FRICTION,
    CHECKS,
    MOTION,
    Entry,
    Scale,
    UnitChoice,
    bounds,
    columns,
    entries,
    scale,
)
from dalembert.analysis.output.json_record import BLOCK, nan_to_none, to_dict, to_json, write_json
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.quantity_catalogue import CATALOGUE
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.saving import check_installed, new_file

if TYPE_CHECKING:
    import pandas
    import xarray

    from dalembert.analysis.result.result import Result

__all__ = [
    "headings",
    "rows",
    "to_csv",
    "to_dataframe",
    "to_dict",
    "to_json",
    "to_netcdf",
    "to_xarray",
    "to_xlsx",
    "write_csv",
    "write_json",
]


WORKBOOK_ROWS = 1_048_575
"""Rows of a worksheet, less its heading."""


# tables


def headings(
    result: Result, units: UnitChoice = "SI", axes: Axes = "ground"
) -> tuple[list[str], list[Array]]:
    """Names of the columns with their units, and the columns (P,)."""
    to = scale(result, units)
    named = [(c.name, to.text(c.kind), to(c.kind, c.values)) for c in columns(result, axes)]
    return [f"{name} [{unit}]" if unit else name for name, unit, _ in named], [values for *_, values in named]


def rows(result: Result, units: UnitChoice = "SI", axes: Axes = "ground") -> Iterator[list[object]]:
    """The heading, then one row a position: its number, status, every number (or None), reason."""
    names, arrays = headings(result, units, axes)
    yield ["position", "status", *names, "reason"]
    for start in range(0, len(result.status), BLOCK):
        lists = [nan_to_none(values[start : start + BLOCK]) for values in arrays]
        for k, numbers in enumerate(zip(*lists, strict=True), start):
            yield [k + 1, result.status[k], *numbers, result.reasons[k]]


def write_csv(result: Result, stream: IO[str], units: UnitChoice = "SI", axes: Axes = "ground") -> None:
    """Writes one row per position to an open text file; the field is empty where a value is missing."""
    import csv

    csv.writer(stream, lineterminator="\n").writerows(rows(result, units, axes))


def to_csv(
    result: Result,
    path: str | Path,
    overwrite: bool = False,
    units: UnitChoice = "SI",
    axes: Axes = "ground",
) -> None:
    """One row a position as a CSV file, units in the heading."""
    with new_file(path, overwrite) as temporary, open(temporary, "w", encoding="utf-8", newline="") as stream:
        write_csv(result, stream, units, axes)


def to_xlsx(
    result: Result,
    path: str | Path,
    overwrite: bool = False,
    units: UnitChoice = "SI",
    axes: Axes = "ground",
) -> None:
    """A workbook: positions, extremes, charts, what they rest on."""
    check_installed("openpyxl", "a workbook")
    from dalembert.analysis.output.workbook import write_workbook

    if len(result.status) > WORKBOOK_ROWS:
        raise ModelError(
            f"{len(result.status)} positions do not fit a worksheet of {WORKBOOK_ROWS} rows",
            "write CSV or netCDF",
        )
    with new_file(path, overwrite) as temporary:
        write_workbook(result, rows(result, units, axes), _about(result), temporary, units, axes)


def _about(result: Result) -> dict[str, str]:
    """Head of every table: title, source, assumptions, mobility."""
    m = result.mechanism
    about = {"title": m.title or "", "source": m.source_text or "", **result.assumptions}
    return about | {"mobility": result.mobility.sentence if result.mobility else ""}


def to_dataframe(
    result: Result,
    units: UnitChoice = "SI",
    axes: Axes = "ground",
    index: Literal["position", "drives"] = "position",
) -> pandas.DataFrame:
    """One row a position, one column a number, units in the names of the columns and by name in ``attrs["units"]``."""
    check_installed("pandas", "a DataFrame")
    import pandas

    names, arrays = headings(result, units, axes)
    frame = pandas.DataFrame(dict(zip(names, arrays, strict=True)))
    frame.insert(0, "status", list(result.status))
    frame.index = pandas.RangeIndex(1, len(frame) + 1, name="position")
    if index == "drives" and result.drives:
        frame = frame.set_index([n for n in names if re.fullmatch(r"drive\.[^.]*( \[.*)?", n)])
    units_of = {name: name.rpartition(" [")[2][:-1] if name.endswith("]") else "1" for name in names}
    frame.attrs.update(_about(result), units=units_of)
    return frame


# labelled arrays


def to_xarray(result: Result, units: UnitChoice = "SI", axes: Axes = "ground") -> xarray.Dataset:
    """Arrays over position, drive, joint, link and component, each with ``attrs["units"]``."""
    check_installed("xarray", "a dataset")
    import xarray

    to = scale(result, units)
    every = [
        *entries(result, ("time", "drive", *BY_FRICTION), axes, every=True),
        *entries(result, (*MOTION, *CHECKS)),
        *bounds(result, axes, every=True),
    ]
    data: Tree = {"status": ("position", np.array(result.status, dtype=str))}
    data |= _arrays(every, to) | _reaction_links(result)
    coordinates: Tree = {
        "position": np.arange(1, len(result.status) + 1),
        "component": list("xyz"[: result.mechanism.dimension]),
        "link_axis": [] if result.mechanism.dimension == 2 else list("xyz"),
    }
    for e in every:
        if e.thing and e.thing not in (names := coordinates.setdefault(_dimension(e.word), [])):
            names.append(e.thing)
    present: Tree = {name: names for name, names in coordinates.items() if len(names)}
    for drive in result.drives:  # so that a position is found by the value of a drive
        kind = drive_kinds(result, drive)["position"]
        values = to(kind, result.drive_position(drive))
        present[f"drive_{drive}"] = ("position", values, {"units": to.text(kind)})
    return xarray.Dataset(data, coords=present, attrs=_about(result) | {"reaction_axes": axes})


DIMENSIONS = {
    "drives": "drive_name",
    "unknown_loads": "load_name",
    "joints": "joint",
    "links": "link",
    "points": "link_point",
    "slide": "sliding_joint",
    "turn": "turning_joint",  # a dimension is not called as a variable over it
}
"""Things that a quantity belongs to -> their dimension."""


def _dimension(word: str) -> str:
    of = CATALOGUE[word].of
    return DIMENSIONS.get(of, f"{of}_joint")


def _arrays(some: Iterable[Entry], to: Scale) -> Tree:
    """Quantities of all things of a sort side by side; drives that turn and that slide differ in their units."""
    groups: dict[tuple[str, str], list[Entry]] = {}
    for e in some:
        groups.setdefault((e.word, e.rate), []).append(e)
    out: Tree = {}
    for (word, rate), each in groups.items():
        units = [to.text(e.kind) for e in each]
        unit = (
            units[0]
            if len(set(units)) == 1
            else f"of each {_dimension(word).removesuffix('_name')}: " + ", ".join(units)
        )
        values = [to(e.kind, e.values) for e in each]
        things = [_dimension(word)] if each[0].thing else []
        array = np.stack(values, axis=1) if things else values[0]
        over = ("position", *things, "component", "link_axis")[: array.ndim]
        out["_".join(filter(None, (word, rate)))] = (over, array, {"units": unit or "1"})
    return out


def _reaction_links(result: Result) -> Tree:
    """The link that each joint's reaction is on, and the one it is by."""
    links = [result.mechanism.joints[joint].links for joint in result.joints]
    if not links:
        return {}
    return {"reaction_on": ("joint", [j for _, j in links]), "reaction_by": ("joint", [i for i, _ in links])}


def to_netcdf(
    result: Result,
    path: str | Path,
    overwrite: bool = False,
    units: UnitChoice = "SI",
    axes: Axes = "ground",
) -> None:
    """The labelled arrays as a netCDF file."""
    check_installed("h5netcdf", "a netCDF file")
    dataset = to_xarray(result, units, axes)
    with new_file(path, overwrite) as temporary:
        dataset.to_netcdf(temporary, engine="h5netcdf")
