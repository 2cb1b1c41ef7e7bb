"""The shaking force worked out at the position where it is greatest, and over the cycle."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from dalembert.errors import ModelError
from dalembert.machine.harmonics import Harmonics
from dalembert.machine.output.written import greatest
from dalembert.machine.shaking import Shaking
from dalembert.printing import remainder
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.machine.shaking_views import shaking_scenes
from dalembert.views.notation import Notation, Shown

SIGNS = {"inertia": "-sum m_{i} a_{i}", "weight": "sum W_{i}", "external": "sum F_{i}"}
"""Part of the shaking force -> how it is made of the links' own."""


def shaking_section(sheet: Sheet, s: Shaking, notation: Notation) -> None:
    """The sums link by link, both ways, the harmonics, the drawings."""
    k = greatest(s.force)[1]
    shown = Shown(s.result, notation, k)
    sheet.heading("Shaking force and moment")
    whose = "The machine exerts on the ground" if s.whole else f"{', '.join(s.links)} exert on all else"
    sheet.text(
        f"{whose} what it takes from weights and loads less the rate of its momentum. Moments are about "
        f"{s.about}. Worked out at position {k + 1} of {len(s.force)}, where the force is greatest."
    )
    _inertia_table(sheet, s, shown, k)
    found = {
        name: w for name, w in s.parts.items() if np.any(np.nan_to_num(w[0])) or np.any(np.nan_to_num(w[1]))
    }
    sheet.equations([*_sums(s, shown, k, found), *_moments(s, shown, k, found)])
    known = s.residual[np.isfinite(s.residual)]
    if len(known):
        sheet.text(
            "The reactions of the joints, drives, springs and dampers add up to the same within "
            f"{remainder(float(known.max()))} of the largest force, over all positions."
        )
    if len(s.force) > 2 and s.result.drives:
        _over_the_cycle(sheet, s, shown, notation)


def _inertia_table(sheet: Sheet, s: Shaking, shown: Shown, k: int) -> None:
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
    sheet.table(
        heads,
        rows,
        f"Mass in {units[0]}, acceleration of the centre in {units[1]}, inertia force in {units[2]}",
    )


def _sums(s: Shaking, shown: Shown, k: int, found: Mapping[str, object]) -> list[Working]:
    unit = f'"{shown.unit("force")}"'
    letters = " + ".join(SIGNS[name] for name in found) or "0"
    out = []
    for c, axis in enumerate("xyz"[: s.force.shape[1]]):
        numbers = " + ".join(_bracket(shown.number("force", float(s.parts[name][0][k, c]))) for name in found)
        result = f"{shown.number('force', float(s.force[k, c]))} {unit}"
        out.append(Working(f"F_{{s{axis}}} = {letters}", numbers, result))
    return out


def _moments(s: Shaking, shown: Shown, k: int, found: Mapping[str, object]) -> list[Working]:
    unit, many = f'"{shown.unit("moment")}"', s.moment.ndim > 1
    out = []
    for c, axis in enumerate("xyz" if many else [""]):
        at = (k, c) if many else k
        numbers = " + ".join(_bracket(shown.number("moment", float(s.parts[name][1][at]))) for name in found)
        letters = " + ".join(f"M_{{{name}}}" for name in found)
        out.append(
            Working(
                f"M_{{s{axis}}} = {letters}", numbers, f"{shown.number('moment', float(s.moment[at]))} {unit}"
            )
        )
    return out


def _bracket(number: str) -> str:
    return f"({number})" if number.startswith("−") else number


def _over_the_cycle(sheet: Sheet, s: Shaking, shown: Shown, notation: Notation) -> None:
    try:
        harmonic_rows(sheet, s.harmonics(4), shown, "force")
    except ModelError as error:
        sheet.text(f"No harmonics: {error}.")
    sheet.figure(*shaking_scenes(s, notation))


def harmonic_rows(sheet: Sheet, h: Harmonics, shown: Shown, kind: str) -> None:
    """Amplitudes and phases of a vector's components, order by order."""
    floor, rows = 1e-12 * float(h.amplitude.max(initial=0.0)), []
    for k, order in enumerate(h.order):
        cells = []
        for size, phase in zip(h.amplitude[k], h.phase[k], strict=True):
            cells += [
                shown.number(kind, float(size), floor),
                shown.notation.degrees(phase if size > floor else 0.0),
            ]
        rows.append([f"{order:g}", *cells])
    heads = [
        x for axis in "xyz"[: h.amplitude.shape[1]] for x in (f"{axis} in {shown.unit(kind)}", "phase °")
    ]
    period = "one turn" if h.turns == 1 else f"{h.turns} turns"
    sheet.table(
        ["Order", *heads],
        rows,
        f"Harmonics over {period}: amplitude and phase of each order, a cos(k q − phase)",
    )
