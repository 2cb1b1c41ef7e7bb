"""Printed form of the shaking force and moment."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.errors import ModelError
from dalembert.machine.harmonics import Harmonics, harmonics
from dalembert.machine.output.balance_text import turned
from dalembert.machine.output.sizes_over_cycle import greatest, rms
from dalembert.printing import Part, TextTable, number, remainder, round_components, wrap

if TYPE_CHECKING:
    from dalembert.machine.shaking import Shaking


def shaking_parts(s: Shaking, to: Printed, orders: int | Sequence[float] = 4) -> Iterator[Part]:
    """Greatest, mean and rms values, their parts, and the harmonics where the positions are a period."""
    whose = "The machine" if s.whole else f"{', '.join(s.links)}"
    what = "on the ground" if s.whole else "on everything else"
    yield f"{whose} {what}: force, and moment about {s.about}, in ground axes."
    yield _values(s, to)
    if s.outside:
        yield (
            f"External: {', '.join(s.outside)}. A load is external unless `by: ground` says that its opposite acts on "
            "the ground, as gas does on a cylinder's head."
        )
    yield from _harmonic_tables(s, to, orders)
    yield from _engine(s, to)
    known = s.residual[np.isfinite(s.residual)]
    yield (
        f"Computed from momentum; the sum of the reactions agrees to {remainder(float(known.max()))}."
        if len(known)
        else "Computed from momentum alone, as the reactions have no value here."
    )


def _values(s: Shaking, to: Printed) -> Part:
    """One position: components. Several: greatest size with its place, mean and rms, of the total and its parts."""
    r, d, single = s.result, s.result.mechanism.dimension, len(s.result.status) == 1
    named = [("shaking force", "force", s.force), ("shaking moment", "moment", s.moment)]
    named += [] if s.couple is None else [("shaking couple", "moment", s.couple)]
    for name, (force, moment) in s.parts.items():
        named += [(f"  {name}", "force", force), (f"  {name}", "moment", moment)]
    rows = []
    for name, kind, values in named:
        size, k = greatest(values)
        if not size > s.floor(kind):
            continue
        components = np.atleast_1d(values[0] if single else values.mean(axis=0))
        cells = [to.number(kind, v if abs(v) > s.floor(kind) else 0.0) for v in components]
        if not single:
            cells = [to.number(kind, size), where(r, to, k), to.number(kind, rms(values)), *cells]
        rows.append([name, to.text(kind), *cells, *[""] * (d - len(components))])
    axes = list("xyz"[:d])
    heads = axes if single else ["greatest", "at", "rms", *(f"mean {a}" for a in axes)]
    if rows:
        return TextTable(["", "unit", *heads], rows, 2)
    are = "are zero" if np.isfinite(s.force).all() else "have no value"
    return f"Force and moment on {'the ground' if s.whole else 'everything else'} {are}."


def _harmonic_tables(s: Shaking, to: Printed, orders: int | Sequence[float]) -> list[Part]:
    if not s.result.drives or len(s.result.status) < 3:
        return []
    try:
        some = ("force", "moment", *(["couple"] if s.couple is not None else []))
        series = {kind: s.harmonics(orders, kind) for kind in some}
    except ModelError as error:
        return [f"No harmonics: {error}."]
    shown = {kind: h for kind, h in series.items() if np.any(h.amplitude > s.floor(kind))}
    turns, drive = series["force"].turns, s.result.drives[0]
    period = "a turn" if turns == 1 else f"{turns} turns"
    heading = f"Harmonics over {period} of {drive}: amplitude, and phase in deg (a cos(k q - phase))"
    return [heading, *(_harmonic_table(kind, h, to, s.floor(kind)) for kind, h in shown.items())]


def _engine(s: Shaking, to: Printed) -> list[Part]:
    """For an engine, the two textbook harmonics beside the exact ones."""
    from dalembert.machine.balance.engine_series import engine_series

    r = s.result
    if r.mechanism.dimension == 3 or not s.whole or not any(part.any() for part in s.parts["inertia"]):
        return []
    try:
        e = engine_series(r)
        angle = r.drive_position(r.drives[0])
        both = [("force", "force", e.exact.parts["inertia"][0], e.force)]
        both += [] if s.couple is None else [("couple", "moment", s.couple, e.couple)]
        rows = []
        for name, kind, *sides in both:
            exact, book = (harmonics(v, angle, [1, 2, 4, 6]) for v in sides)
            sizes = np.abs([exact.forward, exact.backward, book.forward, book.backward])
            sizes[sizes <= s.floor(kind)] = 0.0
            for order, row in zip(exact.order, sizes.T if sizes.any() else (), strict=False):
                rows.append([f"{name} {to.text(kind)}", number(order), *(to.number(kind, v) for v in row)])
    except ModelError:
        return []
    heads = ["inertia", "order", "exact: with", "against", "book: with", "against"]
    note = f"{len(e.cylinders)} cylinder{'s' * (len(e.cylinders) > 1)}, by the book's two harmonics: "
    if greatest(e.exact.parts["inertia"][0])[0] <= s.floor("force"):
        note += "no inertia force is left."
    else:
        note += f"its force is off by {number(100 * e.loss, 3)} % of the largest at most."
    return [TextTable(heads, rows, note=wrap(note))]


def _harmonic_table(name: str, h: Harmonics, to: Printed, floor: float) -> TextTable:
    """Amplitude and phase of each order, of vectors by component, in the plane also the parts that turn."""
    kind = "force" if name == "force" else "moment"
    floor = max(floor, 1e-12 * float(np.max(h.amplitude, initial=0.0)))
    amplitude, phase = (np.reshape(v, (len(h.order), -1)) for v in (h.amplitude, h.phase))
    turning = amplitude.shape[1] == 2
    axes = "xyz"[: amplitude.shape[1]] if h.amplitude.ndim > 1 else ("",)
    heads = ["order", *(x for axis in axes for x in (f"{name} {axis}\n{to.text(kind)}", "phase"))]
    rows = []
    for k, order in enumerate(h.order):
        row = [number(order)]
        for a, angle in zip(amplitude[k], phase[k], strict=True):
            row += [to.number(kind, a), _phase(angle, order)] if a > floor else ["0", "-"]
        for part in (h.forward, h.backward) if turning else ():
            row.append(to.number(kind, abs(part[k])) if abs(part[k]) > floor else "0")
        rows.append(row)
    note = f"Aliasing check: using every other position changes the amplitudes by at most {_off(h.aliasing, kind, to)}."
    note = note if math.isfinite(h.aliasing) else "Too few positions to check aliasing."
    return TextTable([*heads, *(["with it", "against"] if turning else [])], rows, note=note)


def _off(aliasing: float, kind: str, to: Printed) -> str:
    """A change with its unit; 0 has none."""
    size = remainder(float(to(kind, aliasing)))
    return size if size == "0" else f"{size} {to.text(kind)}"


def _phase(phase: float, order: float) -> str:
    """Phase; for the mean, which has a sign, 0 or 180; half a turn back is half a turn on."""
    return turned(math.radians(round_components([math.degrees(phase)], 1.0)[0])) if order or phase else "0"
