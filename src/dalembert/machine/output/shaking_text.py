"""The shaking force and moment as a person reads them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.columns import UnitChoice
from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed, print_scale
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.harmonics import Harmonics
from dalembert.machine.output.written import greatest, rms
from dalembert.printing import number, remainder, round_components, table, tables, wrap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.machine.shaking import Shaking


def heading(r: Result) -> str:
    """Title, source and what the numbers rest on."""
    said = [
        f"{key} {value}" for key, value in r.assumptions.items() if key in ("gravity", "inertia", "friction")
    ]
    lines = [r.mechanism.title, r.mechanism.source_text, wrap(f"Assumptions: {', '.join(said)}")]
    return "\n".join(line for line in lines if line)


def shaking_text(s: Shaking, units: UnitChoice = "file", orders: int | Sequence[float] = 4) -> str:
    """Greatest, mean and rms values, their parts, and the harmonics where the positions are a period."""
    r, to = s.result, print_scale(s.result, units)
    whose = "The machine" if s.whole else f"{', '.join(s.links)}"
    what = "on the ground" if s.whole else "on all else"
    blocks = [heading(r), wrap(f"{whose} {what}: force, and moment about {s.about}, in ground axes.")]
    blocks += [_values(s, to), *_harmonic_tables(s, to, orders), _check(s)]
    return "\n\n".join(blocks)


def _values(s: Shaking, to: Printed) -> str:
    """One position: components. Several: greatest size with its place, mean and rms, of the whole and its parts."""
    r, single = s.result, len(s.result.status) == 1
    rows = []
    for name, (force, moment) in {"shaking": (s.force, s.moment), **s.parts}.items():
        for kind, values in (("force", force), ("moment", moment)):
            shown = np.asarray(to(kind, values))
            sizes = [number(x) for x in round_components(np.ravel(shown[0]), 1e-9 * _scale(s, kind, to))]
            if single:
                parts = [*sizes, *[""] * (r.mechanism.dimension - len(sizes))]
            else:
                size, k = greatest(shown)
                mean = np.atleast_1d(shown.mean(axis=0))
                parts = [number(size), where(r, to, k) if size else "-", number(rms(shown))]
                parts += [number(x) for x in round_components(mean, 1e-6 * _scale(s, kind, to))]
                parts += [""] * (r.mechanism.dimension - len(mean))
            if np.nan_to_num(shown).any():
                rows.append([f"{name} {kind}" if name == "shaking" else f"  {name}", to.text(kind), *parts])
    axes = ["x", "y", "z"][: r.mechanism.dimension]
    heads = axes if single else ["greatest", "at", "rms", *(f"mean {a}" for a in axes)]
    return tables(["", "unit", *heads], rows, 2) if rows else "Nothing acts on the ground."


def _scale(s: Shaking, kind: str, to: Printed) -> float:
    which = ("force", "moment").index(kind)
    sizes = [greatest(w[which])[0] for w in ((s.force, s.moment), *s.parts.values())]
    return float(to(kind, max(sizes)))


def _harmonic_tables(s: Shaking, to: Printed, orders: int | Sequence[float]) -> list[str]:
    if not s.result.drives or len(s.result.status) < 3:
        return []
    try:
        found = {kind: s.harmonics(orders, kind) for kind in ("force", "moment")}
    except ModelError as error:
        return [wrap(f"No harmonics: {error}.")]
    out = []
    for kind, h in found.items():
        if np.any(h.amplitude > 0):
            out.append(harmonic_table(f"{kind}\n{to.text(kind)}", h, float(to(kind, 1.0))))
    turns = next(iter(found.values())).turns
    period = "a turn" if turns == 1 else f"{turns} turns"
    drive = s.result.drives[0]
    return [f"Harmonics over {period} of {drive}: amplitude, and phase in deg (a cos(k q - phase))", *out]


def harmonic_table(head: str, h: Harmonics, factor: float = 1.0) -> str:
    """Amplitude and phase of each order, of vectors by component, in the plane also the parts that turn."""
    floor = 1e-12 * float(np.max(h.amplitude, initial=0.0))
    names = [""] if h.amplitude.ndim == 1 else list("xyz"[: h.amplitude.shape[1]])
    heads = ["order", *(f"{head.split(chr(10))[0]} {n}\n{head.split(chr(10))[-1]}\tphase" for n in names)]
    heads = [x for part in heads for x in part.split("\t")]
    turning = len(names) == 2
    heads += ["with it", "against"] if turning else []
    rows = []
    for k, order in enumerate(h.order):
        row = [number(order)]
        for c in range(len(names)):
            a, phase = (float(np.reshape(v, (len(h.order), -1))[k, c]) for v in (h.amplitude, h.phase))
            row += [
                number(factor * a if a > floor else 0.0),
                _phase(phase, order) if a > floor else "-",
            ]
        for part in (h.forward, h.backward) if turning else ():
            row.append(number(factor * float(abs(part[k])) if abs(part[k]) > floor else 0.0))
        rows.append(row)
    text = table(heads, rows)
    if not math.isfinite(h.aliasing):
        return f"{text}\nToo few positions to tell their aliasing."
    return f"{text}\nEvery other position left out changes them by {remainder(factor * h.aliasing)} at most."


def _phase(phase: float, order: float) -> str:
    """Of the mean, which has a sign, 0 or 180."""
    return number(round_components([math.degrees(phase)], 1.0)[0], 5) if order or phase else "0"


def _check(s: Shaking) -> str:
    known: Array = s.residual[np.isfinite(s.residual)]
    if not len(known):
        return "The reactions have no value here: the momentum alone says it."
    return wrap(
        f"By momentum, without any reaction; by the reactions the same within {remainder(float(known.max()))}."
    )
