"""Balancing worked out: what each counterweight does, the numbers found, what is left, the proof."""

from __future__ import annotations

from dalembert.machine.balance.balancing import Balance
from dalembert.machine.output.balance_text import comparison_rows, proof
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.machine.balance_views import balance_scenes
from dalembert.views.notation import Notation, Shown


def balance_section(sheet: Sheet, b: Balance, notation: Notation) -> None:
    """In letters the columns of a counterweight, in numbers the counterweights and both sides."""
    shown = Shown(b.result, notation)
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
    rows, unit = [], f"{shown.unit('mass')}·{shown.unit('length')}"
    for link, p in b.placed.items():
        moment = p.moment / shown.size("mass") / shown.size("length")
        cells = [shown.notation.number(moment), shown.notation.degrees(p.angle), shown.number("mass", p.mass)]
        rows.append([shown.heading(link), *cells, *(shown.number("length", float(x)) for x in p.center)])
    heads = ["Link", f"$m r$ in {unit}", "angle °", f"$m$ in {shown.unit('mass')}"]
    sheet.table(
        [*heads, *(f"${x}$ in {shown.unit('length')}" for x in "xy")], rows, "Counterweights, in link axes"
    )
    sheet.table(
        ["", "Before", "After", "Left"], comparison_rows(b, shown.text), f"Moment about {b.before.about}"
    )
    sheet.text(proof(b))
    sheet.figure(*balance_scenes(b, notation))
