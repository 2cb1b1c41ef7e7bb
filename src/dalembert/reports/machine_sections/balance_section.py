"""Balancing worked out: what each counterweight does."""

from __future__ import annotations

from dalembert.machine.balance.balancing import Balance
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.notation import Shown


def balance_section(sheet: Sheet, b: Balance, shown: Shown) -> None:
    """In letters the columns of a counterweight."""
    sheet.heading("Balance")
    sheet.text(
        "A counterweight of mass m with m x and m y about its base point A, on a link at the angle $theta$, adds to "
        "the shaking force, in complex numbers, a sum that is linear in its mass numbers:"
    )
    letters = "F = -m a_{A} - (i alpha - omega^{2}) e^{i theta} (m x + i m y)"
    sheet.equations([Working(letters)])
    sheet.text(
        "So the least squares, or the least greatest value, over all positions is a convex problem with one answer."
    )
