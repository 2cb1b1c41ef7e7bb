"""The shaking force worked out at the position where it is greatest, and over the cycle."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.output.sizes_over_cycle import greatest
from dalembert.machine.shaking import Shaking
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views.notation import Shown

SIGNS = {"inertia": "-sum m_{i} a_{i}", "weight": "sum W_{i}", "external": "sum F_{i}"}
"""Part of the shaking force -> its sum over the links' forces."""


def shaking_section(sheet: ReportSheet, s: Shaking, shown: Shown) -> None:
    """The sums link by link at the position where the force is greatest."""
    k = greatest(s.force)[1]
    shown = Shown(s.result, shown.notation, k)
    sheet.heading("Shaking force and moment")
    whose = (
        "The machine exerts on the ground" if s.whole else f"{', '.join(s.links)} exert on everything else"
    )
    sheet.text(
        f"{whose} what it takes from weights and loads less the rate of its momentum. Moments are about "
        f"{s.about}. Worked out at position {k + 1} of {len(s.force)}, where the force is greatest."
    )
    _inertia_table(sheet, s, shown, k)
    nonzero = [name for name, w in s.parts.items() if any(np.nan_to_num(x).any() for x in w)]
    sheet.equations(_sums(s.force[k], {n: s.parts[n][0][k] for n in nonzero}, "F", SIGNS, shown))
    moments = {name: f"M_{{{name}}}" for name in nonzero}
    sheet.equations(_sums(s.moment[k], {n: s.parts[n][1][k] for n in nonzero}, "M", moments, shown))


def _inertia_table(sheet: ReportSheet, s: Shaking, shown: Shown, k: int) -> None:
    """Mass, acceleration of the centre and inertia force of each link."""
    r, axes = s.result, "xyz"[: s.result.mechanism.dimension]
    rows = []
    for link in s.links if r.inertia else ():
        mass, a = r.mechanism.mass(link), r.center_acceleration(link)[k]
        if mass:
            cells = [shown.number("acceleration", float(x)) for x in a]
            cells += [shown.number("force", -mass * float(x)) for x in a]
            rows.append([shown.heading(link), shown.number("mass", mass), *cells])
    heads = ["Link", "$m$", *(f"$a_{{{x}}}$" for x in axes), *(f"$-m a_{{{x}}}$" for x in axes)]
    units = [shown.unit(kind) for kind in ("mass", "acceleration", "force")]
    caption = f"Mass in {units[0]}, acceleration of the centre in {units[1]}, inertia force in {units[2]}"
    sheet.table(heads, rows, caption)


def _sums(
    total: Array, parts: dict[str, Array], sign: str, letters: dict[str, str], shown: Shown
) -> list[Working]:
    """Each component of a sum over its parts."""
    kind = "force" if sign == "F" else "moment"
    out, terms = [], " + ".join(letters[name] for name in parts) or "0"
    for c, value in enumerate(np.atleast_1d(total)):
        some = [shown.number(kind, float(np.atleast_1d(part)[c])) for part in parts.values()]
        numbers = " + ".join(f"({n})" if n.startswith("−") else n for n in some)
        axis = "xyz"[c] if np.ndim(total) else ""
        result = f'{shown.number(kind, float(value))} "{shown.unit(kind)}"'
        out.append(Working(f"{sign}_{{s{axis}}} = {terms}", numbers, result))
    return out
