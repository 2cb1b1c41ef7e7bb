"""Sentences for positions outside a load's table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Flags, Ints
from dalembert.model.quantities.coordinates import quantity_name
from dalembert.units import file_units

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled


def outside(c: Compiled) -> Flags:
    """True (P,) at positions outside some table."""
    flags = np.zeros(len(c.schedule.position), bool)
    for b in c.beyond:
        flags |= b.table.beyond(b.at)
    return flags


def outside_sentence(c: Compiled, run: Ints) -> str:
    """Tables that end before these positions, and the largest distance beyond an end."""
    units, out = file_units(c.mechanism.units), []
    for b in c.beyond:
        kind, low, high = b.table.along, b.table.x[0] + b.table.shift, b.table.x[-1] + b.table.shift
        far = np.maximum(low - b.at[run], b.at[run] - high)
        if b.table.beyond(b.at[run]).any():
            first, last, here = (
                units.unit(kind).of_si(float(x)) for x in (low, high, b.at[run][far.argmax()])
            )
            name, text = quantity_name(b.table.against), units.text(kind)
            covers = (
                f"its table covers {name} = {first:.6g}..{last:.6g} {text}, here {name} = {here:.6g} {text}"
            )
            out.append(f"{b.what}: {covers}; the value at the end was used")
    return ". ".join(out)[:1].upper() + ". ".join(out)[1:] + "."
