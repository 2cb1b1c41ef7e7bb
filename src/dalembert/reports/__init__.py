"""The worked solution of a result: a sheet of text, formulas, tables and drawings, and its writers.

In: a ``Result``, or a force system. Out: a ``Report``: ``da.report(r).save("engine.pdf")``. Imports
``analysis``, ``views``, ``wrench``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dalembert.answer.answer import Worked
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation

FORMATS = (".pdf", ".html", ".tex", ".txt")


class Report:
    """A worked solution, ready to be written or shown in a notebook."""

    def __init__(self, sheet: ReportSheet) -> None:
        self.sheet = sheet

    def to_bytes(self, kind: str) -> bytes:
        """The report as `pdf`, `html`, `tex` or `txt`."""
        if kind in ("pdf", "html"):
            from dalembert.reports.writers.typst_writer import typst_bytes

            check_format(Path(f"report.{kind}"))
            return typst_bytes(self.sheet, kind)
        if kind == "tex":
            from dalembert.reports.writers.latex_writer import latex_text

            return latex_text(self.sheet).encode()
        from dalembert.reports.writers.plain_writer import plain_text

        return plain_text(self.sheet).encode()

    def save(self, path: str | Path, overwrite: bool = False) -> None:
        """Write .pdf, .html, .tex or .txt."""
        from dalembert.saving import new_file

        target = Path(path)
        check_format(target)
        written = self.to_bytes(target.suffix.lower()[1:])
        with new_file(target, overwrite) as temporary:
            temporary.write_bytes(written)

    def __str__(self) -> str:
        return self.to_bytes("txt").decode()

    def _repr_html_(self) -> str:
        return self.to_bytes("html").decode()


def check_format(path: Path) -> None:
    """Raises ModelError where the file's ending is no format of reports, or what writes that is not installed."""
    from dalembert.errors import ModelError
    from dalembert.saving import check_installed

    ending = path.suffix.lower()
    if ending not in FORMATS:
        what = f"{path.name}: reports cannot be written in this format"
        raise ModelError(what, f"use one of {' '.join(FORMATS)}")
    if ending in (".pdf", ".html"):
        check_installed("typst", f"writing {ending[1:].upper()}", "report")


def report(
    r: Worked,
    at: Any = None,
    methods: Any = None,
    notation: Notation | None = None,
    about: str | tuple[float, ...] = "",
    begin: str = "",
    along: Any = 0,
    design: bool = False,
) -> Report:
    """The worked solution of one position of a result, of a force system of `da.wrench`, or of any other answer
    that has one (`da.shaking`, `da.flywheel`, `da.optimize`, `da.study`), with ``notation`` alone; ModelError of
    anything else.

    ``methods``: some of `steps`, `matrix`, `graphical` (in the plane), `superposition`, `virtual-work`; all by default.
    ``about``: a joint, or a point (m), to take moments about where this is possible; an unknown one is a ModelError.
    ``begin``: the link to begin with; ``along``: angle of the first axis of the sums of forces (`30 deg`). Of a force
    system ``at`` is the point to take moments about (m), and methods do not apply.

    ``design``: the design report of the machine instead, with a verdict and its margin for all that the file has data
    for; ``at`` is then the position that is drawn (default: that of the largest effort).

    >>> import dalembert as da
    >>> sheet = report(da.statics(da.four_bar()), at=1)
    >>> type(sheet).__name__
    'Report'
    """
    import reprlib

    from dalembert.analysis.result.result import Result
    from dalembert.errors import ModelError
    from dalembert.wrench import System

    if isinstance(r, System):
        from dalembert.reports.sections.force_system_solution import force_system_sheet

        return Report(force_system_sheet(r, r.about if at is None else at, notation))
    if not isinstance(r, Result):
        if not hasattr(r, "sheet"):
            raise ModelError(
                f"there is no worked solution of {type(r).__name__} {reprlib.repr(r)}",
                "give a result of da.solve, or another answer that has .report()",
            )
        return Report(r.sheet(notation))
    if design:
        from dalembert.reports.design.design_report import design_sheet

        return Report(design_sheet(r, at, notation))
    from dalembert.analysis.methods.solved.step_choice import read_choice
    from dalembert.reports.report_context import METHODS
    from dalembert.reports.working import working
    from dalembert.wording import closest

    for method in methods or ():
        if method not in METHODS:
            raise ModelError(f"unknown method {method!r}", closest(str(method), list(METHODS)))
    return Report(working(r, at, tuple(methods or METHODS), notation, read_choice(r, begin, about, along)))
