"""`solve --method`: contributions of a superposition, powers of virtual work, as text."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.joint_friction import unknown_names
from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.analysis.methods.superposition import directions, with_sum
from dalembert.analysis.output.summary.printed_units import Printed, print_scale, significant
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind, unknown_kinds
from dalembert.answer.column import UnitChoice
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.printing import number, remainder, round_components, table, tables, with_unit, wrap
from dalembert.units import KINDS

if TYPE_CHECKING:
    from dalembert.analysis import Result
    from dalembert.analysis.methods.superposition import Superposition
    from dalembert.analysis.methods.virtual_work import VirtualWork


def superposition_text(result: Result, units: UnitChoice) -> str:
    """Every effort, unknown load and joint force by source, at the first solved position."""
    from dalembert.analysis.methods.superposition import superposition

    parts, to, k = superposition(result), print_scale(result, units), _first(result)
    if not parts.sources:
        return f"Superposition\n\n{NOTHING_ACTS}: all forces are 0."
    groups = _quantities(parts, k)
    of_each = [quantity for group in groups for quantity in group]
    floor = _rounding(result, [(kind, values[:-1]) for _, values, kind in of_each if kind != "angle"])
    rows = [
        [source, *(_part(to, kind, float(values[n]), floor) for _, values, kind in of_each)]
        for n, source in enumerate([*parts.sources, "sum"])
    ]
    heads = ["source", *(f"{name}\n[{to.text(kind)}]" for name, _, kind in of_each)]
    split = tables(heads, rows, 1, together=[len(group) for group in groups])
    gap = float(np.nanmax(parts.gap, initial=0.0))
    words = f"Joint forces are those on j. They sum to the total within {remainder(gap, 1)} of the largest."
    where = f" at position {k + 1} of {len(result.status)}" if len(result.status) > 1 else ""
    return f"Superposition{where}\n\n{split}\n\n{wrap(words)}"


def _rounding(result: Result, quantities: list[tuple[str, Array]]) -> dict[str, float]:
    """Force and moment below which a part is nothing but rounding, beside the largest of both."""
    length = result.compiled.layout.length
    largest = max(
        (float(np.abs(v).max()) / (1.0 if kind == "force" else length) for kind, v in quantities), default=0.0
    )
    return {"force": NOTHING * largest, "moment": NOTHING * largest * length}


NOTHING_ACTS = "No given load, weight or inertia acts"

NOTHING = 1e-12
"""Part of the largest below which a number is rounding."""


def _part(to: Printed, kind: str, value: float, floor: dict[str, float]) -> str:
    """A part in the reader's unit; rounding is 0, and the direction of nothing a dash."""
    if kind == "angle":
        return number(to(kind, value), 5) if math.isfinite(value) else "-"
    return number(value * to(kind, 1.0) if abs(value) > floor[kind] else 0.0, 5)


Quantity = tuple[str, Array, str]
"""Name, the parts (S,) of a number with their sum behind them, and its kind."""


def _quantities(parts: Superposition, k: int) -> list[list[Quantity]]:
    """Every number that is split, at a position: the efforts and unknown loads, then joint by joint."""
    r = parts.result
    efforts = [(d, parts.efforts[:, k, n], drive_kinds(r, d)["effort"]) for n, d in enumerate(r.drives)]
    efforts += [(u, parts.loads[:, k, n], load_kind(r, u)) for n, u in enumerate(r.unknown_loads)]
    out = [[(name, with_sum(values), kind) for name, values, kind in efforts]]
    for n, joint in enumerate(r.joints):
        force, moment = with_sum(parts.force[:, k, n]), with_sum(parts.moment[:, k, n])
        out.append([(f"{joint} {axis}", force[:, c], "force") for c, axis in zip_axes(force)])
        out[-1].append((f"|{joint}|", magnitude(force), "force"))
        if force.shape[-1] == 2:
            out[-1].append((f"dir. {joint}", directions(force), "angle"))
        if moment.ndim == 1 and np.any(moment):
            out[-1].append((f"{joint} m", moment, "moment"))
        elif moment.ndim == 2 and np.any(moment):
            out[-1] += [(f"{joint} m{axis}", moment[:, c], "moment") for c, axis in zip_axes(moment)]
    return [group for group in out if group]


def zip_axes(vectors: Array) -> list[tuple[int, str]]:
    """Number and name of each component of vectors (..., d)."""
    return list(enumerate("xyz"[: vectors.shape[-1]]))


def virtual_work_answer(result: Result, units: UnitChoice) -> tuple[Result, str]:
    """The answer without reactions, and the power of every load at unit speed of each drive."""
    from dalembert.analysis.methods.virtual_work import virtual_work

    if not result.drives:
        raise ModelError(
            "virtual work needs a drive, and this structure does not move",
            "leave --method out",
        )
    work, to, k = virtual_work(result), print_scale(result, units), _first(result)
    blocks = _all_powers(work, k, to)
    if result.status[k] == "at_rest":
        blocks = []
        for name, pair in zip(unknown_names(result), result.ends, strict=True):
            for which, end in zip(("low", "high"), pair, strict=True):
                at_end = virtual_work(end)
                known = bool(np.isfinite(at_end.effort[k]).all())
                blocks.append(f"At the {which} end of {name}:" + ("" if known else " no value"))
                blocks += _all_powers(at_end, k, to) if known else []
    if result.reverses[k]:
        behind = _all_powers(virtual_work(result.sides[1]), k, to)
        blocks = ["Just before the reversal:", *blocks, "Just after it:", *behind]
    where = f" at position {k + 1} of {len(result.status)}" if len(result.status) > 1 else ""
    return work.answer, "\n\n".join([f"Virtual work{where}", *blocks, *_agreement(work)])


def _agreement(work: VirtualWork) -> list[str]:
    """Agreement of the matrix answer with virtual work."""
    words = []
    if not work.independent:
        words.append(
            "The work of friction contains the reactions of the matrix answer: with friction virtual work checks "
            "that answer; it is not an independent solution."
        )
    if np.isfinite(work.gap).any():
        gap = remainder(float(np.nanmax(work.gap)), 1)
        words.append(
            f"No reaction appears. The solution of the equations agrees within {gap}."
            if work.independent
            else f"They agree within {gap}."
        )
    return [wrap(" ".join(words))] if words else []


def _all_powers(work: VirtualWork, k: int, to: Printed) -> list[str]:
    return [_powers(work, n, k, to) for n in range(len(work.result.drives))]


HEADS = ["load", "force x", "y", "couple", "moves x", "y", "turns", "work"]
SPACE_HEADS = [
    *("load", "force x", "force y", "force z", "couple x", "couple y", "couple z"),
    *("moves x", "moves y", "moves z", "turns x", "turns y", "turns z", "work"),
]


def _powers(work: VirtualWork, drive: int, k: int, to: Printed) -> str:
    r = work.result
    name = r.drives[drive]
    angular = drive_kinds(r, name)["effort"] == "moment"
    kind = "moment" if angular else "force"
    effort_text = with_unit(float(to(kind, significant(r, kind, work.effort[:, drive])[k])), to.text(kind))
    effort = f"Effort that balances the work: {name} = {effort_text}"
    if not work.actions:
        return f"{NOTHING_ACTS}.\n\n{effort}"
    unit = "rad" if angular else to.text("length")
    per = to("length", 1.0) if angular else 1.0
    length = r.compiled.layout.length
    reach = 1.0 if angular else 1 / length  # the turn that moves a link's ends by its length, or the drive's
    force = np.array([a.force[k] for a in work.actions])
    couple = np.array([a.couple[k] for a in work.actions])
    load = max(_largest(force), _largest(couple) / length)
    columns = (
        (force, to("force", 1.0), load),
        (couple, to("moment", 1.0), load * length),
        (work.velocity[:, k, drive], per, reach * length),
        (work.spin[:, k, drive], 1.0 if angular else 1 / to("length", 1.0), reach),
        (work.power[:, k, drive], to(kind, 1.0), load * reach * length),
    )
    numbers = [
        _cells(values * factor, len(work.actions), least * factor) for values, factor, least in columns
    ]
    rows = [[a.source, *(x for part in numbers for x in part[n])] for n, a in enumerate(work.actions)]
    power, factor, least = columns[-1]
    total = float(power.sum()) * factor
    heads = HEADS if r.mechanism.dimension == 2 else SPACE_HEADS
    rows.append(["sum", *[""] * (len(heads) - 2), number(round_components([total], least * factor)[0])])
    units = f"forces in {to.text('force')}, couples in {to.text('moment')}, moves in {to.text('length')}"
    return (
        f"1 {unit} of {name}: {units}, turns in rad\n\n"
        f"{table(heads, rows) if heads is HEADS else tables(heads, rows, 1)}\n\n{effort}"
    )


def _largest(values: Array) -> float:
    return float(np.nan_to_num(np.abs(values)).max(initial=0.0))


def _cells(values: Array, count: int, beside: float) -> list[list[str]]:
    """Numbers of some actions, those that are nothing but rounding beside the largest, or beside a size, as 0."""
    rows = np.reshape(values, (count, -1)).tolist()
    largest = max(_largest(values), beside)
    return [[number(x, 5) for x in round_components(row, largest)] for row in rows]


def _first(result: Result) -> int:
    """The first solved position."""
    good = np.flatnonzero(result.ok)
    return int(good[0]) if len(good) else 0


MOST_STEPS = 24
"""Steps of the textbook iteration that are printed."""


def fixed_point_text(result: Result) -> str:
    """The textbook iteration at the first position: unknowns and friction at each step, and its rate."""
    from dalembert.analysis.friction.fixed_point import fixed_point

    table = fixed_point(result)
    kinds = unknown_kinds(result)
    heads = ["step", *(f"{name}\n{KINDS[kinds[name]].si}" for name in table.unknowns)]
    heads += [f"friction\n{name}" for name in table.friction] + ["change"]
    every = [[f"{row[0]:.0f}", *(number(v, 8) for v in row[1:-1]), f"{row[-1]:.1e}"] for row in table.rows()]
    every[0][-1] = "-"
    rows = every
    if len(every) > MOST_STEPS:
        rows = [*every[: MOST_STEPS - 3], ["..."] * len(heads), *every[-2:]]
    end = "converges" if table.arrived else "has not converged"
    words = (
        f"The textbook iteration {end} after {table.steps} steps; each step leaves {table.rate:.3g} of the change. "
        "Friction on j in N or N*m; solve, set friction from these reactions, solve again."
    )
    return f"{tables(heads, rows, 1)}\n{wrap(words)}"


def other_solutions_text(result: Result, units: UnitChoice) -> str:
    """Solutions of friction's equations beside the physical one, where that is not proved to be the only one."""
    from dalembert.analysis.friction.other_solutions import SOUGHT, every_other_solution

    others, to, kinds = every_other_solution(result), print_scale(result, units), unknown_kinds(result)
    if not any(others.values()):
        proved = "proved not to exist" if not others else "none detected"
        if not any(s in SOUGHT for s in result.status):
            proved = "searched only where the senses of friction are given, at no position of this result"
        return wrap(f"Other solutions of friction: {proved}.")
    heads = ["other solutions\nat position", *(f"{name}\n{to.text(kind)}" for name, kind in kinds.items())]
    heads.append("determinant\nratio")
    rows = [
        [str(k + 1), *(number(float(to(kinds[n], v))) for n, v in s.unknowns.items()), number(s.determinant)]
        for k, some in others.items()
        for s in some
    ]
    words = (
        "The physical solution, above, is continued from no friction and has a positive determinant ratio."
    )
    return f"{tables(heads, rows, 1)}\n{wrap(words)}"
