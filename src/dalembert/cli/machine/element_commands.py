"""`dalembert cam`: machine elements by themselves."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from dalembert.cli.answer_files import NO_LABELLED, LabelledOutputs
from dalembert.cli.machine.machine_commands import computed
from dalembert.cli.options import AS_IN_FILE, Changes, ModelFile, target, with_help
from dalembert.errors import ArgumentError, ModelError

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def cam(
    file: ModelFile,
    /,
    *,
    joint: Annotated[str | None, with_help("The cam (default: the first).")] = None,
    outline: Annotated[
        Path | None, target("Write the outline 1:1 in the file's unit: .dxf, or .csv with angle and radius.")
    ] = None,
    tolerance: Annotated[str, target("Largest error of the outline, e.g. 2um (default: 1um).")] = "1 um",
    cutter: Annotated[
        str | None, target("Radius of a cutter, e.g. 6mm, whose path is written beside the outline.")
    ] = None,
    changes: Changes = AS_IN_FILE,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Geometry of a cam of FILE: lift, pressure angle, curvature, least size, outline for manufacture."""
    from dalembert.machine.elements.cam_design import cam as cam_of
    from dalembert.model.joints.elements.cams import Cam

    out.check(file)
    m = changes.load(file)
    name = joint or next((n for n, j in m.joints.items() if isinstance(j, Cam)), None)
    if name is None:
        raise ModelError("the mechanism has no cam", "add a joint of type: cam").at_source(m.source)
    made = computed(lambda: cam_of(m, name), m)
    if outline is not None:
        sizes = _length(m, tolerance, "tolerance"), cutter and _length(m, cutter, "cutter")
        computed(lambda: made.save(outline, tolerance=sizes[0], cutter=sizes[1], overwrite=out.force), m)
    computed(lambda: out.deliver(made), m)
    return 0


def _length(m: Mechanism, text: str, option: str) -> float:
    """A positive length of an option, in the units of the file where it has none."""
    from dalembert.units import file_units, quantity

    try:
        value = quantity(text, "length", file_units(m.units))
    except ModelError as error:
        raise ArgumentError(f"--{option}: {error.what}", error.remedy) from None
    if not value > 0:
        raise ArgumentError(f"--{option} is {text}", "give a positive length")
    return value


CAM = """Examples:
  dalembert cam valve.yaml
  dalembert cam valve.yaml --drawing cam.svg --outline cam.dxf --cutter 6mm
  dalembert cam valve.yaml --set joints.F.profile.base=35mm --csv lift.csv"""

COMMANDS = {cam: CAM}
"""Each with its examples."""
