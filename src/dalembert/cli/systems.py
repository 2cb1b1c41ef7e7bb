"""`dalembert wrench`: a force system by itself, worked out, drawn and written."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Literal

from dalembert.cli.options import Flag

EXAMPLES = """Examples:
  dalembert wrench plate.yaml
  dalembert wrench plate.yaml --about A --drawing plate.svg
  dalembert wrench box.yaml --view front --report box.pdf

A file: {units: {length: mm}, points: {A: [200, 0]}, forces: {F: {value: 600 @ 90, at: A}}, couples: {M: 5 N*m}}"""


def wrench(
    file: Path,
    /,
    *,
    about: str | None = None,
    drawing: Path | None = None,
    report: Path | None = None,
    view: Literal["isometric", "front", "side", "top"] = "isometric",
    theme: Literal["light", "dark", "print"] = "light",
    units: Literal["si", "file"] = "file",
    figures: int = 4,
    force: Flag = False,
) -> int:
    """Reduce the force system of FILE: resultant, moments, central axis, equilibrium.

    Parameters
    ----------
    file
        File of forces and couples, in the plane or in space.
    about
        Point to take moments about: a name of the file's points, or "[x, y]" (default: the origin).
    drawing
        Draw it to this file: .svg, .pdf, .png or .dxf.
    report
        Write the worked solution to this file: .pdf, .html, .tex or .txt.
    view
        Side from which a system in space is drawn.
    theme
        Colours for light paper, for a dark screen, or black and white for print.
    units
        Units of the numbers: the file's (default) or si.
    figures
        Significant figures.
    force
        Overwrite files that exist.
    """
    from dalembert.report import report as worked_out
    from dalembert.saving import check_new
    from dalembert.views import draw
    from dalembert.wrench import load

    for target in (drawing, report):
        if target is not None:
            check_new(target, force)
    system = load(file)
    notation = draw.Notation(units="SI" if units == "si" else "file", figures=figures)
    sheet = worked_out(system, about, notation=notation)
    if drawing is not None:
        draw.force_system(system, about, notation, view).save(drawing, force, theme)
    if report is not None:
        sheet.save(report, force)
    print(sheet, end="")
    for target in (drawing, report):
        if target is not None:
            print(f"Written: {target}", file=sys.stderr)
    return 0
