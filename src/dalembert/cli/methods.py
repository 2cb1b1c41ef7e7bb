"""`solve --method`: contributions of a superposition, powers of virtual work, as text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.columns import UnitChoice, drive_kinds, load_kind
from dalembert.cli.answer import Printed, printed
from dalembert.cli.text import number, table

if TYPE_CHECKING:
    from dalembert.analysis import Result


def superposition_text(result: Result, units: UnitChoice) -> str:
    """Every effort, unknown load and joint force by source, at the first solved position."""
    from dalembert.analysis.superposition import superposition

    parts, to, k = superposition(result), printed(result, units), _first(result)
    rows = []
    for n, source in [*enumerate(parts.sources), (None, "sum")]:
        row = [str(source)]
        for _, values, kind in _quantities(parts, to):
            column = values[:, k] if n is None else values[n : n + 1, k]
            row.append(number(float(np.sum(column)) * to(kind, 1.0), 5))
        rows.append(row)
    heads = [f"{name}\n[{to.text(kind)}]" for name, _, kind in _quantities(parts, to)]
    gap = float(np.nanmax(parts.gap, initial=0.0))
    words = f"Joint forces are those on j. The parts sum to the whole within {gap:.1e} of the largest."
    where = f" at position {k + 1} of {len(result.status)}" if len(result.status) > 1 else ""
    return f"Superposition{where}\n\n{_split(['source', *heads], rows)}\n\n{words}"


def _split(heads: list[str], rows: list[list[str]]) -> str:
    """Six columns of numbers at a time."""
    blocks = []
    for start in range(1, len(heads), 6):
        part = [0, *range(start, min(start + 6, len(heads)))]
        blocks.append(table([heads[n] for n in part], [[row[n] for n in part] for row in rows]))
    return "\n\n".join(blocks)


def _quantities(parts: Any, to: Printed) -> list[tuple[str, Any, str]]:
    """Name, values (S, P) and kind of every number that is split."""
    r = parts.result
    out = [(d, parts.efforts[..., n], drive_kinds(r, d)["effort"]) for n, d in enumerate(r.drives)]
    out += [(u, parts.loads[..., n], load_kind(r, u)) for n, u in enumerate(r.unknown_loads)]
    for n, joint in enumerate(r.joints):
        out += [(f"{joint} {axis}", parts.force[..., n, c], "force") for c, axis in enumerate("xy")]
        if np.any(parts.moment[..., n]):
            out.append((f"{joint} m", parts.moment[..., n], "moment"))
    return out


def virtual_work_answer(result: Result, units: UnitChoice) -> tuple[Result, str]:
    """The answer without reactions, and the power of every load at unit speed of each drive."""
    from dalembert.analysis.virtual_work import virtual_work

    found, to, k = virtual_work(result), printed(result, units), _first(result)
    blocks = [_powers(found, n, k, to) for n in range(len(result.drives))]
    gap = float(np.nanmax(found.gap, initial=0.0))
    words = f"No reaction appears. The matrix answer agrees within {gap:.1e}."
    where = f" at position {k + 1} of {len(result.status)}" if len(result.status) > 1 else ""
    return found.answer, "\n\n".join([f"Virtual work{where}", *blocks, words])


def _powers(found: Any, drive: int, k: int, to: Printed) -> str:
    r = found.result
    name = r.drives[drive]
    angular = drive_kinds(r, name)["effort"] == "moment"
    kind = "moment" if angular else "force"
    unit = "1 rad" if angular else "1 m"
    rows = []
    for a, v, w, p in zip(found.actions, found.velocity, found.spin, found.power, strict=True):
        speed, force = v[k, drive], a.force[k]
        per = to("length", 1.0) if angular else 1.0
        cells = [force[0] * to("force", 1.0), force[1] * to("force", 1.0), a.couple[k] * to("moment", 1.0)]
        moved = [speed[0] * per, speed[1] * per, w[k, drive] * (1.0 if angular else 1 / to("length", 1.0))]
        rows.append([a.source, *(number(float(x), 5) for x in [*cells, *moved, p[k, drive] * to(kind, 1.0)])])
    total = float(found.power[:, k, drive].sum()) * to(kind, 1.0)
    rows.append(["sum", *[""] * 6, number(total, 6)])
    effort = f"{name} = {number(float(found.effort[k, drive]) * to(kind, 1.0))} {to.text(kind)}"
    length = to.text("length") if angular else "1"
    heads = ["load", "force x", "y", "couple", "moves x", "y", "turns", "work"]
    return (
        f"{unit} of {name}: forces in {to.text('force')}, couples in {to.text('moment')}, moves in {length}\n\n"
        f"{table(heads, rows)}\n\nEffort that balances the work: {effort}"
    )


def _first(result: Result) -> int:
    """The first solved position."""
    good = np.flatnonzero(result.ok)
    return int(good[0]) if len(good) else 0
