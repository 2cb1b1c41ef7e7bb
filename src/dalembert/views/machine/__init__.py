"""Drawings of machine design: shaking forces, balance, flywheels, motion under forces, members.

In: an answer of ``machine``. Out: ``Scene``. Imports ``machine`` and what ``views`` imports.
"""

from __future__ import annotations

from typing import Any

from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Scene


def scenes_of(answer: Any, notation: Notation | None = None) -> list[Scene]:
    """The drawings of an answer, by what it is."""
    from dalembert.machine.balance.balancing import Balance
    from dalembert.machine.flywheel.flywheels import Flywheel
    from dalembert.machine.members.member_table import MemberTable
    from dalembert.machine.motion.simulation import Simulation
    from dalembert.views.machine.balance_views import balance_scenes
    from dalembert.views.machine.flywheel_views import flywheel_scenes
    from dalembert.views.machine.member_views import member_scenes
    from dalembert.views.machine.shaking_views import shaking_scenes
    from dalembert.views.machine.simulation_views import simulation_scenes

    if isinstance(answer, Balance):
        return balance_scenes(answer, notation)
    if isinstance(answer, Flywheel):
        return flywheel_scenes(answer, notation)
    if isinstance(answer, Simulation):
        return simulation_scenes(answer, notation)
    if isinstance(answer, MemberTable):
        return member_scenes(answer, notation)
    return shaking_scenes(answer, notation)
