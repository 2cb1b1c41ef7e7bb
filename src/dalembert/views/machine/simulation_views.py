"""A motion under forces over time: speeds, efforts, energies."""

from __future__ import annotations

import numpy as np

from dalembert.machine.motion.simulation import Simulation
from dalembert.model.drives.drives import SLIDE, TURN
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Scene


def simulation_scenes(s: Simulation, notation: Notation) -> list[Scene]:
    """Speed and effort of each drive, and the energies, over time."""
    shown = Shown(s.result, notation)
    x, label = s.time / shown.size("time"), f"Time in {shown.unit('time')}"
    out = []
    for k, drive in enumerate(s.drives):
        kinds = TURN if s.result.mechanism.drives[drive].turns else SLIDE
        for what, values in (("speed", s.speed(drive)), ("effort", s.applied[:, k])):
            unit = shown.unit(kinds[what])
            curve = {what: values / shown.size(kinds[what])}
            title = f"{what.capitalize()} of {drive}"
            out.append(curves_scene(x, curve, label, f"{what.capitalize()} in {unit}", title))
    energies = {"kinetic": s.kinetic, "potential": s.potential - s.potential[0]}
    energies |= {f"work of {name}": w for name, w in s.works.items()}
    size = shown.size("energy")
    series = {name: e / size for name, e in energies.items() if np.abs(e).max() > 0}
    if series:
        out.append(curves_scene(x, series, label, f"Energy in {shown.unit('energy')}", "Energies and works"))
    return out
