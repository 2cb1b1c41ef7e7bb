"""The motion under forces worked out: the equation that is integrated."""

from __future__ import annotations

from dalembert.machine.motion.occurrences import say
from dalembert.machine.motion.simulation import Simulation
from dalembert.reports.sheet import Sheet
from dalembert.views.notation import Shown


def simulation_section(sheet: Sheet, s: Simulation, shown: Shown) -> None:
    """What moves, and how its motion is found."""
    sheet.heading("Motion under forces")
    sheet.text(
        f"The speeds of {', '.join(s.drives)} follow from the efforts that act: the effort that a state asks for is "
        "the reduced inertia times the acceleration, and what is asked for without one. Between events this is "
        f"integrated step by step (Dormand and Prince, order 8). It ends {say(s.ending, shown.scale)}."
    )
