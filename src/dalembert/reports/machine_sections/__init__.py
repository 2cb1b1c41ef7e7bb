"""Sections of the worked solution for answers of machine design, in letters and numbers.

In: an answer of ``machine``, a notation. Out: a ``Sheet``. Imports ``machine``, ``views``.
"""

from __future__ import annotations

from typing import Any

from dalembert.reports.sheet import Sheet
from dalembert.views.notation import Notation


def machine_sheet(answer: Any, notation: Notation | None = None) -> Sheet:
    """The worked solution of an answer, by what it is."""
    from dalembert.machine.balance.balancing import Balance
    from dalembert.machine.flywheel.flywheels import Flywheel
    from dalembert.machine.members.member_table import MemberTable
    from dalembert.machine.motion.simulation import Simulation
    from dalembert.reports.machine_sections.balance_section import balance_section
    from dalembert.reports.machine_sections.flywheel_section import flywheel_section
    from dalembert.reports.machine_sections.member_section import member_section
    from dalembert.reports.machine_sections.shaking_section import shaking_section
    from dalembert.reports.machine_sections.simulation_section import simulation_section

    m = answer.result.mechanism
    sheet = Sheet(m.title or "Machine", m.source_text)
    if isinstance(answer, Balance):
        balance_section(sheet, answer, notation or Notation())
    elif isinstance(answer, Flywheel):
        flywheel_section(sheet, answer, notation or Notation())
    elif isinstance(answer, Simulation):
        simulation_section(sheet, answer, notation or Notation())
    elif isinstance(answer, MemberTable):
        member_section(sheet, answer, notation or Notation())
    else:
        shaking_section(sheet, answer, notation or Notation())
    return sheet
