"""Printed form of a motion under forces."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.rounding import sizes
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import first_largest
from dalembert.machine.motion.occurrences import say
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.printing import Part, TextTable, folded, number, remainder, round_components

if TYPE_CHECKING:
    from dalembert.machine.elements.brake_heat import StopHeat
    from dalembert.machine.motion.occurrences import Event
    from dalembert.machine.motion.simulation import Simulation

ROWS = 21
"""Instants that are printed."""


def simulation_parts(s: Simulation, to: Printed) -> Iterator[Part]:
    """The drives over time, events, works, greatest joint forces and the checks."""
    yield f"Motion under forces from 0 to {to.quantity('time', s.time[-1])}: {say(s.ending, to)}."
    yield _drives(s, to)
    events = _events(s, to)
    more = [f"... and {len(events) - ROWS} more"] if len(events) > ROWS else []
    if events:
        yield "\n".join(["Events", *events[:ROWS], *more])
    yield _works(s, to)
    heats = [_heat(name, h, to) for name, h in s.heat.items() if h.energy]
    if heats:
        yield "\n".join(heats)
    joints = _joints(s, to)
    if joints.rows:
        yield joints
    if s.normals:
        yield _contacts(s, to)
    yield (
        f"Checks: the energy balance holds within {remainder(s.energy_residual)} of the largest energy; the efforts "
        f"of the computed motion, prescribed, agree to {remainder(s.law_residual)}; the loops close "
        f"within {remainder(s.closure)} m."
    )
    if s.doubt:
        yield f"Check failed: {s.doubt}."
    # where forces move every drive, no load has to drive it
    natural = {"at_rest", "self_locking"} if s.moves.free.all() else {"at_rest"}
    problems = [row for row in s.result.problems() if row[1] not in natural]
    if problems:
        yield "\n".join(f"instants {which}: {sentence}" for which, _, sentence in problems)
    if any(code == "contact_lost" for _, code, _ in problems):
        yield "The motion is computed without backlash, as if these contacts held: after that it is not exact."
    if any(code in ("slips", "slack") for _, code, _ in problems):
        yield (
            "The motion is computed as if belts and ropes neither slipped nor hung slack: after that it is not that "
            "of the machine."
        )


def _drives(s: Simulation, to: Printed) -> TextTable:
    """Position, speed, acceleration and effort of each drive at even instants."""
    heads, columns = [f"time\n{to.text('time')}"], [to("time", s.time)]
    for k, drive in enumerate(s.drives):
        for what, kind in drive_kinds(s.result, drive).items():
            heads.append(f"{drive} {what}\n{to.text(kind)}")
            values = s.applied[:, k] if what == "effort" else getattr(s, what)(drive)
            columns.append(round_components(to(kind, values)))
    which = np.unique(np.linspace(0, len(s.time) - 1, ROWS).astype(int))
    rows = [[number(float(np.asarray(c)[n])) for c in columns] for n in which]
    return TextTable(heads, folded(rows), 0)


def _events(s: Simulation, to: Printed) -> list[str]:
    """A line for each event; where impacts and reversals follow one another, one for all of each drive or joint."""
    lines = []
    for swift, run in groupby(s.events, lambda e: e.name in ("impact", "landing", "reversal")):
        of: dict[tuple[str, str], list[Event]] = {}
        for e in run:
            of.setdefault((e.name, e.of if swift else str(id(e))), []).append(e)
        lines += [_line(several, to) for several in of.values()]
    return lines


def _line(several: list[Event], to: Printed) -> str:
    first, last = several[0], several[-1]
    sentence, when = say(first.words, to), to.quantity("time", first.time)
    if len(several) == 1:
        return f"at {when}: {sentence}"
    span = f"from {when} to {to.quantity('time', last.time)}: {len(several)} {first.name}s of {first.of}"
    if first.name not in ("impact", "landing"):
        return span
    lost = to.quantity("energy", sum(e.lost for e in several))
    return f"{span}, {lost} lost together; in the first, {sentence}"


def _works(s: Simulation, to: Printed) -> TextTable:
    """Energies at both ends, and what was given and taken between."""
    largest = max(float(np.abs(e).max()) for e in (s.kinetic, s.potential, *s.works.values()))

    def ends(*both: float) -> list[str]:
        return [to.number("energy", x) for x in round_components(both, largest)]

    rows = [[f"work of {name}", "", *ends(w[-1])] for name, w in s.works.items()]
    rows += [
        ["kinetic energy", *ends(*s.kinetic[[0, -1]])],
        ["potential energy", *ends(*s.potential[[0, -1]])],
    ]
    return TextTable([f"{to.text('energy')}", "start", "end"], rows)


def _heat(name: str, h: StopHeat, to: Printed) -> str:
    """Rubbing work of a brake, on its lining and in what it warms."""
    area = "" if np.isnan(h.per_area) else f", {h.per_area / 1e6:.4g} J/mm^2 of its lining"
    rise = "" if np.isnan(h.rise) else f"; its temperature rises by {h.rise:.4g} K if it keeps all the heat"
    return f"{name} turns {to.quantity('energy', h.energy)} into heat{area}{rise}."


def _joints(s: Simulation, to: Printed) -> TextTable:
    """Greatest force in each joint and when."""
    largest = {joint: greatest(s.result.reaction(joint)) for joint in s.result.joints}
    known = {joint: both for joint, both in largest.items() if np.isfinite(both[0])}
    beside = float(sizes(s.result)["force"].max())
    forces = round_components([f for f, _ in known.values()], beside)
    rows = [
        [n, to.number("force", f), to.number("time", s.time[k]) if f else ""]
        for (n, (_, k)), f in zip(known.items(), forces, strict=True)
    ]
    heads = ["joint", f"greatest force\n{to.text('force')}", f"at\n{to.text('time')}"]
    return TextTable(heads, rows)


def _contacts(s: Simulation, to: Printed) -> TextTable:
    """Greatest normal force of each contact and its widest gap."""
    rows, gaps = [], s.gaps
    for name, force in s.normals.items():
        gap = gaps[name]
        row = [name]
        for kind, values in (("force", force), ("length", gap)):
            k = first_largest(values) if np.isfinite(values).any() else 0
            row += [to.number(kind, values[k]), to.number("time", s.time[k])]
        rows.append(row)
    at, force_unit, length = (to.text(kind) for kind in ("time", "force", "length"))
    heads = [f"greatest normal force\n{force_unit}", f"at\n{at}", f"widest gap\n{length}", f"at\n{at}"]
    return TextTable(["contact", *heads], rows)
