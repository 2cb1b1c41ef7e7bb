"""Start-up of a design report: the machine released under its motors, from rest to its working speed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dalembert.machine.motion.simulation import simulate
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.reports.design.answers_on_sheets import put_answer
from dalembert.reports.design.verdict import DesignContext, DesignPart, DesignVerdict, not_judged

LONGEST = 5.0
"""Time within which a machine reaches its working speed, s."""
NEARLY = 0.9
"""Part of the working speed that counts as reached."""
INSTANTS, TOLERANCE = 101, 1e-8
BEYOND = 1 + 1e-6
"""Time limit of the second run over the end of the first: rounding does not decide which of the two ends it."""


def start_up_part(c: DesignContext) -> Iterator[DesignPart]:
    """The first drive with a motor, from rest at the file's start, or at its first position."""
    r, m = c.r, c.r.mechanism
    drive = next((d for d in r.drives if m.drives[d].motor is not None), None)
    if drive is None:
        if r.drives:
            yield DesignPart("Start-up", [not_judged("Start-up", "no drive of the file has a motor")])
        return
    curve = m.drives[drive].motor
    assert curve is not None
    working = float(np.nanmax(np.abs(r.drive_speed(drive)), initial=0.0))
    working = float(f"{NEARLY * (working or curve.at_drive.fastest):.6g}")  # as it is written below
    sign = -1.0 if np.nanmean(r.drive_speed(drive)) < 0 else 1.0
    unit = "rad/s" if m.drives[drive].turns else "m/s"
    until: list[str | float] = [LONGEST, f"{drive}.speed = {sign * working!r} {unit}"]
    start = None if m.start else {drive: {"position": float(r.drive_position(drive)[0]), "speed": 0.0}}
    s = simulate(m, until, start, count=INSTANTS, tolerance=TOLERANCE)
    if s.time[-1] < LONGEST / 4:  # few of the instants are before its end
        s = simulate(m, [BEYOND * float(s.time[-1]), *until[1:]], start, count=INSTANTS, tolerance=TOLERANCE)
    part, kind = DesignPart("Start-up"), "angular_speed" if unit == "rad/s" else "speed"
    speed, time = c.text(kind, working), c.text("time", float(s.time[-1]))
    reached = abs(float(s.speed(drive)[-1])) >= working * (1 - 1e-6)
    if reached:
        part.verdicts.append(DesignVerdict(f"{drive} reaches {speed}", "ok", f"in {time}"))
    else:
        final = c.text(kind, float(s.speed(drive)[-1]))
        remark = f"it has {final} after {time}"
        part.verdicts.append(DesignVerdict(f"{drive} reaches {speed}", "exceeded", remark=remark))
    largest = {j: greatest(s.result.reaction(j))[0] for j in s.result.joints}
    known = {j: f for j, f in largest.items() if np.isfinite(f)}
    if known:
        joint = max(known, key=lambda j: known[j])
        reason = "compare with the joint forces of the cycle"
        part.verdicts.append(
            not_judged(f"largest joint force, {joint}", reason, c.text("force", known[joint]))
        )
    if s.doubt:
        part.verdicts.append(DesignVerdict("check of the motion", "exceeded", remark=s.doubt))
    put_answer(part.sheet, s, c)
    yield part
