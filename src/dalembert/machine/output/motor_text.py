"""Printed form of the choice of a motor."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.machine.whole_cycle import sampled
from dalembert.printing import Part, TextTable, number, round_components

if TYPE_CHECKING:
    from dalembert.machine.motors.motor_choice import MotorChoice


def _no_least(c: MotorChoice) -> str:
    """Why no ratio has the least torque."""
    if not np.any(c.effort):
        inertial = c.motor_inertia and np.any(c.acceleration)
        reason = (
            "only the motor's acceleration needs torque: the lower the ratio, the less"
            if inertial
            else "the motor needs no torque either"
        )
        return f"The drive needs no effort; {reason}."
    return (
        "Torque falls as the ratio rises, because the motor does not accelerate: the ratio "
        "is limited only by the motor's speed."
    )


ENOUGH = {None: "-", True: "yes", False: "no"}


def motor_parts(c: MotorChoice, to: Printed) -> Iterator[Part]:
    """Requirement of the drive, and the motor behind each ratio."""
    kinds = drive_kinds(c.result, c.drive)
    rows = []
    for name in ("effort", "speed", "acceleration", "power"):
        values, kind = getattr(c, name), kinds.get(name, name)
        most, k = greatest(values)
        mean = round_components([c.mean(values)], most)[0]
        numbers = [to.number(kind, x) for x in (most, c.rms(values), mean)]
        rows.append([name, to.text(kind), numbers[0], where(c.result, to, k), *numbers[1:]])
    yield TextTable([f"drive {c.drive}", "unit", "greatest", "at", "rms", "mean"], rows, 2)
    yield sampled(c.result, c.sampling())
    kind = "inertia" if kinds["effort"] == "moment" else "mass"
    low, high = (to.quantity(kind, float(x)) for x in (c.inertia.min(), c.inertia.max()))
    yield f"Inertia of all links reduced to {c.drive}: {low} to {high}, mean {to.quantity(kind, c.mean(c.inertia))}."
    rows = []
    for name, n in c.needs.items():
        cells = [number(n.ratio), *(to.number("moment", x) for x in (n.rms, n.torque))]
        rotor = c.motor_inertia * n.ratio**2
        share = number(float(np.mean(c.inertia)) / rotor, 4) if rotor else "-"
        rows.append([name, *cells, to.number("angular_speed", n.speed), share, ENOUGH[n.enough]])
    moment, rate = to.text("moment"), to.text("angular_speed")
    heads = ["gear\n", "ratio\n", f"rms torque\n{moment}", f"greatest\n{moment}", f"speed\n{rate}"]
    yield TextTable([*heads, "inertia, links\n/ motor", "enough\n"], rows)
    if c.least_rms() is None:
        yield _no_least(c)
    by = {"each position with the motor's curve": c.curve, "the rms torque with the rated torque": c.rated}
    limits = " and ".join(what for what, value in by.items() if value is not None)
    judged = f"The column `enough` compares {limits}."
    yield judged if limits else "The column `enough` needs a motor curve or a rated torque; neither is given."
