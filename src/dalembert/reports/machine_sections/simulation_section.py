"""The motion under forces in letters and numbers: the equation, the events, the balance of energy."""

from __future__ import annotations

import numpy as np

from dalembert.machine.motion.simulation import Simulation
from dalembert.reports.sheet import Sheet
from dalembert.views.machine.simulation_views import simulation_scenes
from dalembert.views.notation import Notation, Shown


def simulation_section(sheet: Sheet, s: Simulation, notation: Notation) -> None:
    """What moves, what happened when, and where the energy went."""
    shown = Shown(s.result, notation)
    sheet.heading("Motion under forces")
    sheet.text(
        f"The speeds of {', '.join(s.drives)} follow from the efforts that act: the effort that a state asks for is "
        "the reduced inertia times the acceleration, and what is asked for without one. Between events this is "
        f"integrated step by step (Dormand and Prince, order 8). It ends {s.ended}."
    )
    events = [[shown.number("time", e.time), e.sentence] for e in s.events]
    if events:
        sheet.table([f"time {shown.unit('time')}", "event"], events, "Events")
    rows = [[f"work of {name}", shown.number("energy", w[-1])] for name, w in s.works.items()]
    rows += [
        [f"{name} energy gained", shown.number("energy", e[-1] - e[0])]
        for name, e in (("kinetic", s.kinetic), ("potential", s.potential))
    ]
    sheet.table(["", f"{shown.unit('energy')}"], rows, "Works add up to the energy gained")
    sizes = {j: np.sqrt((s.result.reaction(j) ** 2).sum(axis=-1)) for j in s.result.joints}
    some = {j: size for j, size in sizes.items() if np.isfinite(size).any()}
    greatest = [
        [j, shown.number("force", np.nanmax(x)), shown.number("time", s.time[int(np.nanargmax(x))])]
        for j, x in some.items()
    ]
    heads = ["joint", f"force {shown.unit('force')}", f"at {shown.unit('time')}"]
    sheet.table(heads, greatest, "Greatest force in each joint")
    sheet.figure(*simulation_scenes(s, notation))
