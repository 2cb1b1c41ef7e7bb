"""`dalembert wrench`: a force system by itself, worked out, drawn and written."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Literal

from dalembert.cli.options import Drawing, Figures, Force, Report, Theme, target, with_help

EXAMPLES = """Examples:
  dalembert wrench plate.yaml
  dalembert wrench plate.yaml --about A --drawing plate.svg
  dalembert wrench box.yaml --camera front --report box.pdf

A file:
  units: {length: mm}
  points: {A: [200, 0]}
  forces: {F: {value: 600 @ 90, at: A}}
  couples: {M: 5 N*m}"""


def wrench(
    file: Annotated[Path, with_help("File of forces and couples, in the plane or in space.")],
    /,
    *,
    about: Annotated[
        str | None,
        target(
            'Point about which moments are taken: a point of the file, or "[x, y]" (default: the origin).'
        ),
    ] = None,
    drawing: Drawing = None,
    report: Report = None,
    camera: Annotated[
        Literal["isometric", "front", "side", "top"], with_help("View direction of a spatial system.")
    ] = "isometric",
    theme: Theme = "light",
    units: Annotated[
        Literal["si", "file"], with_help("Units of the numbers: file (default) or si.")
    ] = "file",
    figures: Figures = 4,
    force: Force = False,
) -> int:
    """Reduce the force system of FILE: resultant, moments, central axis, equilibrium."""
    from dalembert.reports import report as worked_out
    from dalembert.saving import check_new
    from dalembert.views import draw
    from dalembert.wrench import load

    for path in (drawing, report):
        if path is not None:
            check_new(path, force)
    system = load(file)
    notation = draw.Notation(units="SI" if units == "si" else "file", figures=figures)
    sheet = worked_out(system, about, notation=notation)
    if drawing is not None:
        draw.force_system(system, about, notation, camera).save(drawing, force, theme)
    if report is not None:
        sheet.save(report, force)
    print(sheet, end="")
    for path in (drawing, report):
        if path is not None:
            print(f"Written: {path}", file=sys.stderr)
    return 0


COMMANDS = {wrench: EXAMPLES}
"""Function of the command -> the examples under its help."""
