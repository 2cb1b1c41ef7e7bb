"""`dalembert wrench`: a force system by itself, worked out, drawn and written."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from dalembert.cli.answer_files import NO_DRAWN, DrawnOutputs
from dalembert.cli.options import Set, set_values, target, with_help

EXAMPLES = """Examples:
  dalembert wrench plate.yaml
  dalembert wrench plate.yaml --about A --drawing plate.svg
  dalembert wrench box.yaml --camera front --report box.pdf
  dalembert wrench plate.yaml --set "forces.F.value=800 @ 60"

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
    camera: Annotated[
        Literal["isometric", "front", "side", "top"], with_help("View direction of a spatial system.")
    ] = "isometric",
    set: Set = None,  # noqa: A002
    out: DrawnOutputs = NO_DRAWN,
) -> int:
    """Reduce the force system of FILE: resultant, moments, central axis, equilibrium."""
    from dalembert.wrench import load

    out.check(file)
    out.deliver(load(file, set_values(set or ())).seen(about, camera), figures=out.figures)
    return 0


COMMANDS = {wrench: EXAMPLES}
"""Function of the command -> the examples under its help."""
