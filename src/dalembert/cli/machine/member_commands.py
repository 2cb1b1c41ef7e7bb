"""`dalembert members`, `bearings`, `motor`: what links and joints have to bear, and what is chosen by it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dalembert.cli.machine.machine_commands import AS_ASKED, Analysis, number_of
from dalembert.cli.options import ModelFile, several, with_help


def members(
    file: ModelFile,
    /,
    *,
    links: Annotated[list[str] | None, several("Links, one or more (default: all with a length).")] = None,
    out: Analysis = AS_ASKED,
) -> int:
    """Axial force, shear and bending moment inside links of FILE; stress, safety and buckling of their sections."""
    from dalembert.machine.members.member_table import member_table

    return out.answer(out.of(file), lambda r: member_table(r, links))


MEMBERS = """Examples:
  dalembert members press.yaml
  dalembert members press.yaml --links rod --drawing rod.svg --report rod.pdf
  dalembert members press.yaml --set "links.rod.section={circle: 30 mm, yield_stress: 250 MPa}" """


def bearings(
    file: ModelFile,
    /,
    *,
    joints: Annotated[list[str] | None, several("Joints, one or more (default: all that turn).")] = None,
    hours: Annotated[float | None, with_help("Life to be had, in hours.")] = None,
    table: Annotated[
        Path | None, with_help("Bearings to choose from: a text file with columns name, C, C0, d.")
    ] = None,
    factor: Annotated[float, with_help("The load is taken so many times (default: 1).")] = 1.0,
    safety: Annotated[float, with_help("C0 over the largest load, at least (default: 1).")] = 1.0,
    out: Analysis = AS_ASKED,
) -> int:
    """Pressure, PV, equivalent load and life of the bearings of FILE; the smallest of a table that lives so long."""
    from dalembert.machine.bearings.bearing_table import bearings as bearing_table

    return out.answer(out.of(file), lambda r: bearing_table(r, joints, hours, table, factor, safety))


BEARINGS = """Examples:
  dalembert bearings press.yaml
  dalembert bearings press.yaml --hours 20000 --table bearings.csv --factor 1.2
  dalembert bearings press.yaml --joints A B --set "joints.A.bearing={rating: 12 kN}" --report bearings.pdf"""


def motor(
    file: ModelFile,
    /,
    *,
    drive: Annotated[str | None, with_help("The drive (default: the first).")] = None,
    inertia: Annotated[str, with_help("The motor's own inertia, such as 0.002kg*m^2.")] = "0",
    ratio: Annotated[
        float | None, with_help("Gear ratio, speed of the motor over that of the drive.")
    ] = None,
    efficiency: Annotated[float, with_help("Of the gear (default: 1).")] = 1.0,
    curve: Annotated[
        Path | None, with_help("Greatest torque of the motor: a text file with columns speed, torque.")
    ] = None,
    rated: Annotated[str | None, with_help("Torque that may last, such as 3N*m, against the rms.")] = None,
    out: Analysis = AS_ASKED,
) -> int:
    """Torque, speed and power that a drive of FILE asks for, and the gear ratio with which its motor needs least."""
    from dalembert.machine.motors import motor_choice

    result = out.of(file)
    own, lasting = number_of(result, inertia, "inertia") or 0.0, number_of(result, rated, "moment")
    choice = drive, own, ratio, efficiency, curve, lasting
    return out.answer(result, lambda r: motor_choice.motor(r, *choice))


MOTOR = """Examples:
  dalembert motor press.yaml
  dalembert motor press.yaml --inertia 0.002kg*m^2 --ratio 8 --efficiency 0.95
  dalembert motor press.yaml --inertia 0.002kg*m^2 --curve motor.csv --rated 3N*m --report motor.pdf"""

COMMANDS = {members: MEMBERS, bearings: BEARINGS, motor: MOTOR}
"""Each with its examples."""
