"""Balancing worked out: what each counterweight does."""

from __future__ import annotations

from dalembert.machine.balance.balancing import Balance
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.notation import Shown


def balance_section(sheet: Sheet, b: Balance, shown: Shown) -> None:
    """In letters the columns of a counterweight."""
    sheet.heading("Balance")
    where = "with m x and m y about its base point A, on a link at the angle $theta$, adds to the shaking force, in "
    where, letters = where + "complex numbers,", "(i alpha - omega^{2}) e^{i theta} (m x + i m y)"
    if b.problem.dimension == 3:
        where = "at r from its base point A adds to the shaking force"
        letters = "m (alpha times r) - m (omega times (omega times r))"
    sheet.text(f"A counterweight of mass m {where} a sum that is linear in its mass numbers:")
    sheet.equations([Working(f"F = -m a_{{A}} - {letters}")])
    sheet.text(
        "So the least squares, or the least greatest value, over all positions is a convex problem with one answer."
    )
