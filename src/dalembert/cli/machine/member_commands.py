"""`dalembert members`, `pins`, `bearings`, `shaft`, `motor`: loads of links and joints, and what is chosen by them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dalembert.cli.answer_files import NO_LABELLED, LabelledOutputs
from dalembert.cli.machine.machine_commands import answer, cycle_of, number_of
from dalembert.cli.options import AS_GIVEN, ModelFile, Of, numeric, several, target, with_help
from dalembert.errors import ModelError


def members(
    file: ModelFile,
    /,
    *,
    links: Annotated[
        list[str] | None, several("Links to analyse, one or more (default: all with a length).")
    ] = None,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Axial force, shear and bending moment inside links of FILE; stress, safety and buckling of their sections."""
    from dalembert.machine.members.member_table import member_table

    answer(cycle_of(file, of, out), lambda r: member_table(r, links), out)
    return 0


MEMBERS = """Examples:
  dalembert members press.yaml
  dalembert members press.yaml --links rod --drawing rod.svg --report rod.pdf
  dalembert members press.yaml --set "links.rod.section={circle: 30 mm, yield_stress: 250 MPa}"
  dalembert members press.yaml --set links.rod.effective_length=1.2"""


def bearings(
    file: ModelFile,
    /,
    *,
    joints: Annotated[
        list[str] | None, several("Joints to analyse, one or more (default: all that turn).")
    ] = None,
    hours: Annotated[float | None, numeric("hours", "Required life in hours.")] = None,
    table: Annotated[
        Path | None, with_help("Table of bearings: a text file with columns name, C, C0, d.")
    ] = None,
    factor: Annotated[float, numeric("factor", "Load factor (default: 1).")] = 1.0,
    safety: Annotated[float, numeric("safety", "Minimum static safety factor C0/P0 (default: 1).")] = 1.0,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Pressure, PV, equivalent load and life of the bearings of FILE; the smallest one in a table that
    reaches the required life."""
    from dalembert.machine.bearings.bearing_table import bearings as bearing_table

    answer(cycle_of(file, of, out), lambda r: bearing_table(r, joints, hours, table, factor, safety), out)
    return 0


BEARINGS = """Examples:
  dalembert bearings press.yaml
  dalembert bearings press.yaml --hours 20000 --table bearings.csv --factor 1.2
  dalembert bearings press.yaml --joints A B --set "joints.A.bearing={rating: 12 kN}" --report bearings.pdf"""


def pins(
    file: ModelFile,
    /,
    *,
    joints: Annotated[
        list[str] | None, several("Joints to analyse, one or more (default: all with a pin).")
    ] = None,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Shear, bearing pressure on each link, bending and safety of the bolts of FILE."""
    from dalembert.machine.elements.pin_table import pins as pin_table

    answer(cycle_of(file, of, out), lambda r: pin_table(r, joints), out)
    return 0


PINS = """Examples:
  dalembert pins press.yaml
  dalembert pins press.yaml --joints A --set "joints.A.pin={diameter: 20 mm, eye: 30 mm, cheeks: 15 mm}"
  dalembert pins press.yaml --drawing pins.svg --report pins.pdf"""


def shaft(
    file: ModelFile,
    /,
    *,
    link: Annotated[
        str | None, with_help("The shaft (default: the first link with an elastic section).")
    ] = None,
    count: Annotated[int, numeric("count", "Number of critical speeds (default: 3).")] = 3,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Critical speeds of a shaft of FILE with the masses on it, and Dunkerley's and Rayleigh's estimates."""
    from dalembert.machine.shafts.critical_speeds import critical_speeds

    r = cycle_of(file, of, out)
    links = r.mechanism.links
    elastic = [n for n in r.links if (s := links[n].section) is not None and s.elasticity is not None]
    if link is None and not elastic:
        remedy = "add section: {circle: 50 mm, elasticity: 210 GPa} to a link"
        raise ModelError("no link has a section with elasticity", remedy).at_source(r.mechanism.source)
    answer(r, lambda r: critical_speeds(r, elastic[0] if link is None else link, count), out)
    return 0


SHAFT = """Examples:
  dalembert shaft rotor.yaml --static
  dalembert shaft rotor.yaml --static --link spindle --count 5 --drawing spindle.svg"""


def motor(
    file: ModelFile,
    /,
    *,
    drive: Annotated[str | None, with_help("The drive (default: the first).")] = None,
    inertia: Annotated[
        str | None,
        target("Inertia of the motor, e.g. 0.002kg*m^2 (default: that of the drive's motor, or 0)."),
    ] = None,
    ratio: Annotated[float | None, numeric("ratio", "Gear ratio: motor speed over drive speed.")] = None,
    efficiency: Annotated[
        float | None,
        numeric("efficiency", "Efficiency of the gear (default: that of the drive's motor, or 1)."),
    ] = None,
    curve: Annotated[
        Path | None, with_help("Torque limit of the motor: a text file with columns speed, torque.")
    ] = None,
    rated: Annotated[
        str | None, target("Continuous torque rating, e.g. 3N*m, compared with the rms torque.")
    ] = None,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Torque, speed and power required by a drive of FILE, and the gear ratio that minimises motor torque."""
    from dalembert.machine.motors import motor_choice

    result = cycle_of(file, of, out)
    rotor = number_of(result, inertia, "inertia", "inertia", "motor inertia")
    lasting = number_of(result, rated, "moment", "rated", "rated torque")
    choice = drive, rotor, ratio, efficiency, curve, lasting
    answer(result, lambda r: motor_choice.motor(r, *choice), out)
    return 0


MOTOR = """Examples:
  dalembert motor press.yaml
  dalembert motor press.yaml --inertia 0.002kg*m^2 --ratio 8 --efficiency 0.95
  dalembert motor press.yaml --inertia 0.002kg*m^2 --curve motor.csv --rated 3N*m --report motor.pdf"""

COMMANDS = {members: MEMBERS, pins: PINS, bearings: BEARINGS, shaft: SHAFT, motor: MOTOR}
"""Each with its examples."""
