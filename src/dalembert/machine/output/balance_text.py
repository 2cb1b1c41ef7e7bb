"""Printed form of counterweights."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.printing import Part, TextTable, number, remainder, round_components, wrap

if TYPE_CHECKING:
    from dalembert.machine.balance.balancing import Balance
    from dalembert.machine.balance.comparison import Comparison

AGREES = 1e-6
"""Largest difference, over the values before, of a re-analysis that agrees."""


def balance_parts(b: Balance, to: Printed) -> Iterator[Part]:
    """The counterweights, what is left of force, moment and torque, and the proof."""
    length, mass = to.text("length"), to.text("mass")
    rows = []
    for link, p in b.placed.items():
        center = map(number, round_components([float(to("length", v)) for v in p.center]))
        angle = [] if p.angle is None else [turned(p.angle) if p.moment else "-"]
        size = "-" if p.radius is None else to.number("length", p.radius)
        moment = to.number("mass", to("length", p.moment))
        rows.append([link, moment, *angle, to.number("mass", p.mass), *center, size])
    plane = b.problem.dimension == 2
    heads = ["counterweight\non link", f"m r\n{mass}*{length}", *["angle\ndeg"] * plane, f"mass\n{mass}"]
    places = ("centre x", "y", "disc radius") if plane else ("centre x", "y", "z", "disc radius")
    yield TextTable([*heads, *(f"{x}\n{length}" for x in places)], rows)
    both = "Angles and centres in link axes; m r and its angle" if plane else "Centres in link axes; m r"
    yield f"{both} from the link's base point."
    yield comparison_table(b, to)
    yield proof(b)


def turned(angle: float) -> str:
    """An angle in degrees; half a turn back is half a turn on."""
    degrees = round(math.degrees(angle), 9)
    return number(180.0 if degrees == -180 else degrees, 5)


def comparison_table(b: Comparison, to: Printed) -> TextTable:
    """Rms and greatest value of each quantity before and after, and their ratio."""
    after, rows = b.sizes(), []
    for name, sizes in b.sizes(after=False).items():
        kind = b.kind(name)
        called = "drive force" if name == "torque" and kind == "force" else name
        for what, was, left in zip(("rms", "greatest"), sizes, after[name], strict=True):
            old = was if was > b.before.floor(kind) else 0.0
            new = left if left > max(1e-12 * was, b.before.floor(kind)) else 0.0
            share = number(100 * new / old, 4) + " %" if old else "-"
            rows.append([f"{what} {called}", to.quantity(kind, old), to.quantity(kind, new), share])
    note = f"Moment about {b.before.about}. Force and moment are those of inertia, without weights and external loads."
    if b.before.outside:
        most = to.quantity("force", greatest(b.before.parts["external"][0])[0])
        note += (
            f" No counterweight changes the external loads, {', '.join(b.before.outside)}: at most {most}."
        )
    return TextTable(["", "before", "after", "left"], rows, note=wrap(note))


def proof(b: Balance) -> str:
    """Objective, proof of optimality, and obstacles to full force balance."""
    counted = b.problem.weighted(b.least, b.of)
    what = " + ".join(f"{'' if w == 1 else f'{w:g} '}{name}" for name, w in b.of.items() if w)
    if not counted:
        return f"There was no {' and no '.join(b.of)} to balance: no counterweight is needed."
    text = f"Least {'rms' if b.least == 'rms' else 'greatest'} {what}: {_percent(b.value)} of the unbalanced value. "
    text += f"No counterweights within the bounds leave less than {_percent(b.bound)} (dual value). "
    zero = [name for name, w in b.of.items() if w and name not in counted]
    text += f"The {' and the '.join(zero)}, 0 before, did not count. " if zero else ""
    if not b.before.parts["inertia"][0].any():
        text += "The inertia force is zero without counterweights. "
    elif b.complete:
        text += "The force is balanced completely: the moment is the same about every point. "
    elif b.missing():
        text += f"For complete force balance a counterweight is missing on {', '.join(b.missing())}. "
    elif b.only_bounds:
        text += "Without bounds the force would be balanced completely. "
    else:
        text += "Full force balance is impossible: some link has no path to ground through turning joints. "
    rubs = "" if b.result.friction is None else "; the balance takes friction as it was without them"
    if not rubs and not b.residual <= AGREES:
        what = f"re-analysis with the counterweights differs by {remainder(b.residual)} of the values before"
        return f"{text}Check failed: {what}; do not use these numbers."
    return f"{text}Check: re-analysis with the counterweights agrees to {remainder(b.residual)}{rubs}."


def _percent(part: float) -> str:
    return f"{number(100 * part if part > 1e-12 else 0.0)} %"
