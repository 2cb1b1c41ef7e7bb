"""Motor, flywheel, shaking force and balance of a design report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dalembert.errors import ModelError
from dalembert.machine.balance.balancing import balance
from dalembert.machine.flywheel.flywheels import flywheel
from dalembert.machine.harmonics import whole_turns
from dalembert.machine.motors.motor_choice import MotorChoice, motor
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.machine.shaking import shaking
from dalembert.model import GROUND
from dalembert.reports.design.answers_on_sheets import put_answer
from dalembert.reports.design.verdict import (
    DesignContext,
    DesignPart,
    DesignVerdict,
    judged,
    not_judged,
    tightest_place,
)

USUAL = 0.05
"""Cs of the flywheel that is proposed: of presses and machine tools 0.02 to 0.2 (Norton, Design of Machinery, 11)."""
NOTHING = 1e-9
"""Part of the rms force below which what counterweights leave is rounding."""
LIGHT = 1e-6
"""Part of the machine's mass, times the square of its size, that does not count as a flywheel."""


def motor_part(c: DesignContext) -> Iterator[DesignPart]:
    """Motor that each drive needs, and whether the file's motor provides it."""
    m, part = c.r.mechanism, DesignPart("Motor")
    requested = [d for d in c.r.drives if m.drives[d].effort is None and m.drives[d].cylinder is None]
    if not requested:
        return
    known = [d for d in requested if m.drives[d].motor is not None]
    for drive in known or requested[:1]:
        choice = motor(c.r, drive)
        part.verdicts += list(_motor(c, choice))
        put_answer(part.sheet, choice, c)
    rest = [d for d in requested if d not in known]
    if rest:
        part.verdicts.append(not_judged(", ".join(rest), "the file has no motor for it"))
    yield part


def _motor(c: DesignContext, choice: MotorChoice) -> Iterator[DesignVerdict]:
    need = choice.needs.get("given") or choice.needs["direct"]
    if choice.curve is None:
        return
    torque, allowed = np.abs(choice.torque(need.ratio)), choice.allowed(need.ratio)
    with np.errstate(divide="ignore", invalid="ignore"):
        margin = np.where(np.isnan(allowed), 0.0, allowed / torque)
    k = tightest_place(margin)
    value = c.text("moment", float(torque[k]))
    remark = "" if margin[k] >= 1 else "at the prescribed motion; see the start-up for that of the motor"
    yield judged(
        f"torque of the motor of {choice.drive} at its speed", float(margin[k]), value, c.at(k), remark
    )
    rms = c.text("moment", need.rms)
    yield not_judged(f"rms torque of the motor of {choice.drive}", "the file has no rated torque", rms)


def flywheel_part(c: DesignContext) -> Iterator[DesignPart]:
    """Fluctuation of energy, that of the speed with the links alone, and a flywheel for a usual Cs."""
    part, m = DesignPart("Flywheel"), c.r.mechanism
    f = flywheel(c.r, Cs=USUAL)
    reason = "the file gives no limit of the speed fluctuation"
    part.verdicts.append(not_judged("fluctuation of energy", reason, c.text("energy", f.size.energy)))
    mass = sum(m.mass(link) for link in c.r.links) or 1.0
    alone = flywheel(c.r, inertia=LIGHT * mass * c.r.compiled.layout.length**2).exact
    if alone is not None:
        part.verdicts.append(not_judged("Cs with the links alone", reason, f"{alone.fluctuation:.4g}"))
    if f.exact_size is not None:
        value = c.text("inertia", f.exact_size.inertia)
        part.verdicts.append(not_judged(f"flywheel for Cs = {USUAL:g}", f"a proposal; {reason}", value))
    put_answer(part.sheet, f, c)
    yield part


def shaking_part(c: DesignContext) -> Iterator[DesignPart]:
    """Force and moment on the foundation."""
    s, part = shaking(c.r), DesignPart("Shaking force")
    for item, kind, values in (("force", "force", s.force), (f"moment about {s.about}", "moment", s.moment)):
        size, k = greatest(values)
        if size > s.floor(kind):
            reason = "the file has no limit of the foundation"
            part.verdicts.append(not_judged(f"{item} on the ground", reason, c.text(kind, size), c.at(k)))
    if part.verdicts:
        put_answer(part.sheet, s, c)
        yield part


def balance_part(c: DesignContext) -> Iterator[DesignPart]:
    """Counterweights over whole turns, on links that turn about the ground, and what they leave of inertia."""
    r, m = c.r, c.r.mechanism
    if not r.inertia or not np.nan_to_num(shaking(r).parts["inertia"][0]).any():
        return
    links = {
        next(n for n in j.links if n != GROUND) for j in m.joints.values() if j.hinge and GROUND in j.links
    }
    some = [link for link in r.links if link in links and m.mass(link)]
    if not some:
        raise ModelError("no link with a mass turns about the ground, where a counterweight is put", "")
    if not m.drives[r.drives[0]].turns:
        raise ModelError(f"counterweights are for a machine that turns, and drive '{r.drives[0]}' slides", "")
    if len(r.status) > 1:
        whole_turns(r.drive_position(r.drives[0]))
    b = balance(m, some, positions=len(r.status) if len(r.status) > 1 else None)
    part = DesignPart("Balance")
    left = b.value if b.value > NOTHING else 0.0
    value = f"{100 * left:.3g} % of the rms force"
    reason = f"a proposal for {', '.join(some)}; the file has no limit"
    part.verdicts.append(not_judged("inertia force left by counterweights", reason, value))
    put_answer(part.sheet, b, c)
    yield part
