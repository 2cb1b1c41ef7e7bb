"""The packages that dalembert needs and those of its extras, from its metadata: installed, missing, too old."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from importlib.metadata import PackageNotFoundError, requires, version
from typing import NamedTuple

EXTRAS = {
    "": "always needed",
    "fast": "machine code: da.compile, sweeps, studies",
    "plot": "drawings as .pdf, .png, .gif, .webp",
    "report": "worked solutions as .pdf and .html",
    "results": "Excel, netCDF, pandas, xarray",
    "cad": "DXF drawings, masses from STL meshes",
    "notebook": "live mechanisms in Jupyter",
    "studio": "dalembert studio, the drawing board",
    "study": "studies of many designs, on several machines too",
    "cloud": "stores of studies in object storage",
}
"""Extra -> its purpose; a test compares them with those of the package."""


class PackageState(NamedTuple):
    """A package that an extra needs: its installed version, "" if it is missing, and the lowest that is supported."""

    extra: str
    name: str
    installed: str
    lowest: str

    @property
    def is_too_old(self) -> bool:
        """True if the installed version is below the lowest supported one."""
        return bool(self.installed) and _numbers(self.installed) < _numbers(self.lowest)


def packages() -> list[PackageState]:
    """State of every package of every extra; none where dalembert runs from its sources without being installed."""
    try:
        listed = requires("dalembert") or []
    except PackageNotFoundError:
        return []
    return [
        PackageState(extra, name, installed(name), lowest)
        for extra, name, lowest in _requirements(listed)
        if extra in EXTRAS and name != "dalembert"
    ]


def installed(name: str) -> str:
    """Version of a package, "" if it is missing."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _requirements(listed: Iterable[str]) -> Iterator[tuple[str, str, str]]:
    """Extra, package and lowest version of lines of metadata.

    >>> list(_requirements(["numpy>=2.0", "typst<0.16,>=0.15; extra == 'report'"]))
    [('', 'numpy', '2.0'), ('report', 'typst', '0.15')]
    """
    for line in listed:
        name = re.match(r"[\w.-]+", line)
        lowest, extra = re.search(r">=([\w.]+)", line), re.search(r"""extra == ['"]([\w-]+)['"]""", line)
        if name:
            yield extra[1] if extra else "", name[0], lowest[1] if lowest else ""


def _numbers(text: str) -> list[int]:
    """Leading numbers of a version, without zeros at the end.

    >>> _numbers("2.10.0rc1") < _numbers("2.10.1"), _numbers("2.0") == _numbers("2.0.0")
    (True, True)
    """
    parts = [int(n) for n in re.findall(r"\d+", re.match(r"[\d.]*", text)[0])]  # type: ignore[index]
    while parts and parts[-1] == 0:
        parts.pop()
    return parts
