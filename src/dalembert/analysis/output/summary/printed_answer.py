"""Printed form of the answer: assumptions, one position in full or many in a table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.joint_friction import NO_END, reversing_joints
from dalembert.analysis.output.columns import reactions
from dalembert.analysis.output.summary.printed_belts import belt_tables
from dalembert.analysis.output.summary.printed_brakes import brake_parts
from dalembert.analysis.output.summary.printed_contacts import contact_parts
from dalembert.analysis.output.summary.printed_elements import element_parts
from dalembert.analysis.output.summary.printed_friction import (
    branch_note,
    efficiency_note,
    friction_table,
    open_text,
)
from dalembert.analysis.output.summary.printed_in_space import (
    NOT_UNIQUE,
    space_link_tables,
    space_reaction_tables,
)
from dalembert.analysis.output.summary.printed_series import MORE, position_tables, where
from dalembert.analysis.output.summary.printed_shapes import shape_parts
from dalembert.analysis.output.summary.printed_turning import turning_text
from dalembert.analysis.output.summary.printed_units import (
    Printed,
    motion_only,
    print_scale,
    significant,
    without_reactions,
)
from dalembert.analysis.result.number_kinds import drive_kinds, in_plane, load_kind, unknown_kinds
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.answer.column import UnitChoice
from dalembert.arrays import Array
from dalembert.errors import SOLVED
from dalembert.printing import Part, TextTable, number, remainder, round_components, with_unit, wrap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def answer_text(
    result: Result, units: UnitChoice = "file", axes: Axes = "ground", every: bool = False
) -> str:
    """The complete answer as text."""
    parts = [heading(result), *answer_parts(result, units, axes, every)]
    return "\n\n".join(str(part) for part in parts if part)


def answer_parts(
    result: Result, units: UnitChoice = "file", axes: Axes = "ground", every: bool = False, more: str = MORE
) -> list[Part]:
    """Parts under the heading, in order: tables, and sentences that may be empty; ``more`` says where all positions
    are."""
    to = print_scale(result, units)
    parts: list[Part] = []
    if len(result.status) == 1:
        parts += _one(result, to, axes)
    else:
        parts += position_tables(result, to, axes, every, more)
    parts += [*contact_parts(result, to), *element_parts(result, to), *shape_parts(result, to)]
    parts += [reversals_text(result, to), problems_text(result, to)]
    return [*parts, wrap(branch_note(result)), checks_text(result)]


def heading(result: Result) -> str:
    """Title, source, what was assumed, mobility, assembly mode."""
    m = result.mechanism
    assumed = ", ".join(f"{name} {value}" for name, value in result.assumptions.items())
    lines = [m.title, m.source_text, f"Assumptions: {assumed}"]
    if result.mobility is not None:
        lines.append(_sentence(result.mobility.sentence))
    if result.mode:
        lines.append(_sentence(result.mode))
    return "\n".join(wrap(line, "  ") for line in lines if line)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


# one position


def _one(result: Result, to: Printed, axes: Axes) -> Iterator[Part]:
    status = result.status[0]
    if result.drives:
        yield _drive_table(result, to)
    if status == "not_assembled":
        return
    yield turning_text(result)
    yield _holding_text(result, to)
    if result.unknown_loads:
        yield _load_table(result, to)
    friction_known = result.friction is not None and result.friction.known(0)
    if status == "at_rest" and result.ends:
        yield from _ends(result, to, axes)
    elif result.joints and not without_reactions(result):
        for side, words in zip(result.sides, ("Just before:", "Just after:"), strict=False):
            yield from [words] if result.reverses[0] else []
            yield from _reactions(side, to, axes)
            yield from belt_tables(side, to)
            if friction_known:
                yield friction_table(side, to)
            yield from brake_parts(side, to)
    if status != "at_rest" and friction_known:
        yield wrap(efficiency_note(result))
    if result.links:
        yield from [_link_table(result, to)] if in_plane(result) else space_link_tables(result, to)


def _drive_table(result: Result, to: Printed) -> TextTable:
    rows = []
    for drive in result.drives:
        kinds = drive_kinds(result, drive)
        values = {
            "position": result.drive_position(drive),
            "speed": result.drive_speed(drive),
            "acceleration": result.drive_acceleration(drive),
            "effort": significant(result, kinds["effort"], result.effort(drive)),
        }
        if motion_only(result):
            del values["effort"]
        cells = [with_unit(float(to(kinds[n], v[0])), to.text(kinds[n]), 7) for n, v in values.items()]
        if drive in unknown_kinds(result):
            cells[-1] = open_text(result, drive, to) or cells[-1]
        rows.append([drive, *cells, *([result.stability[0] or "-"] if result.stability else [])])
    heads = [
        "drive",
        "position",
        "speed",
        "acceleration",
        *([] if motion_only(result) else ["effort"]),
        *(["stability"] if result.stability else []),
    ]
    return TextTable(heads, rows, 1)


def _holding_text(result: Result, to: Printed) -> str:
    """Drives that hold a link in a train of gears that turns, with their torque; empty without such."""
    m, s = result.mechanism, result.schedule
    if motion_only(result) or not any(joint.TOOTHED for joint in m.joints.values()) or not s.speed.any():
        return ""
    out = []
    for k, drive in enumerate(result.drives):
        kind, effort = drive_kinds(result, drive)["effort"], result.effort(drive)[0]
        if not s.speed[:, k].any() and not s.acceleration[:, k].any() and np.isfinite(effort):
            link = m.joints[m.drive_joint(drive)].links[1]
            out.append(f"{drive} holds {link} with {with_unit(float(to(kind, effort)), to.text(kind))}.")
    return wrap(" ".join(out))


def _load_table(result: Result, to: Printed) -> TextTable:
    def value(name: str) -> str:
        if text := open_text(result, name, to):
            return text
        kind = load_kind(result, name)
        return with_unit(
            float(to(kind, significant(result, kind, result.unknown_load(name)[0]))), to.text(kind)
        )

    rows = [[name, value(name)] for name in result.unknown_loads]
    return TextTable(["unknown load", "value"], rows)


def _ends(result: Result, to: Printed, axes: Axes) -> Iterator[Part]:
    """Reactions at both ends of each unknown that friction leaves open."""
    for name, ends in zip(unknown_kinds(result), result.ends, strict=True):
        for which, end, value in zip(("low", "high"), ends, result.interval(name)[0], strict=True):
            if not np.isfinite(value):
                yield f"At the {which} end of {name} {NO_END}."
                continue
            yield f"At the {which} end of {name}:"
            yield from _reactions(end, to, axes)


def _reactions(result: Result, to: Printed, axes: Axes) -> Iterator[Part]:
    if in_plane(result):
        return _reaction_tables(result, to, axes)
    sized = [
        r._replace(
            force=significant(result, "force", r.force[0]),
            moment=significant(result, "moment", r.moment[0]),
        )
        for r in reactions(result, axes)
    ]
    return space_reaction_tables(sized, to, axes)


def _reaction_tables(result: Result, to: Printed, axes: Axes) -> Iterator[Part]:
    force, moment, angle = to.text("force"), to.text("moment"), to.text("angle")
    heads = ["joint", "by i", "on j", f"F_ij x\n{force}", f"F_ij y\n{force}", f"|F_ij|\n{force}"]
    heads += [f"direction\n{angle}", f"moment\n{moment}"]
    rows, least = [], []
    for r in reactions(result, axes):
        f, m = significant(result, "force", r.force[0]), significant(result, "moment", r.moment[0])
        rows.append([r.joint, r.by, r.on, *_wrench(f, float(m), to)])
        if r.least_norm is not None and np.isfinite(r.least_norm[0]).any():
            least.append([r.joint, r.by, r.on, *_wrench(r.least_norm[0, :2], r.least_norm[0, 2], to)])
    where = "ground axes" if axes == "ground" else "the axes of link j"
    note = f"F_ij is the force by link i on link j, in {where}; moments about the joint's point on j."
    yield TextTable(heads, rows, 3, wrap(note))
    if least:
        yield from (NOT_UNIQUE, TextTable(heads, least, 3))


def _wrench(force: Array, moment: float, to: Printed) -> list[str]:
    """x, y, magnitude, direction, moment as text."""
    x, y = round_components(to("force", force))
    size = float(np.hypot(x, y))
    direction = float(to("angle", np.arctan2(y, x))) if size else 0.0
    return [number(v) for v in (x, y, size, direction, float(to("moment", moment)))]


def _largest(values: Array) -> float:
    return float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 0.0


def _link_table(result: Result, to: Printed) -> TextTable:
    def of_all(question: Callable[[str], Array]) -> Array:
        return np.array([np.atleast_1d(question(link)[0]) for link in result.links])

    columns = [
        (["angle"], "angle", of_all(result.angle)),
        (["ang. speed"], "angular_speed", of_all(result.speed)),
        (["ang. acc."], "angular_acceleration", of_all(result.acceleration)),
        (["center x", "center y"], "length", of_all(result.center)),
        (["acc. x", "acc. y"], "acceleration", of_all(result.center_acceleration)),
    ]
    heads, cells = ["link"], [[link] for link in result.links]
    for names, kind, values in columns:
        heads += [f"{name}\n{to.text(kind)}" for name in names]
        size = 1.0 if kind == "angle" else _largest(values)
        for row, vector in zip(cells, values, strict=True):
            row += [number(float(v), 5) for v in to(kind, np.array(round_components(vector, size)))]
    return TextTable(heads, cells, 1, "The acceleration is that of the mass center.")


# what did not work, and how far the rest can be trusted


def problems_text(result: Result, to: Printed) -> str:
    """Runs of positions that are not ok, with their sentence."""
    lines = []
    for which, status, sentence in result.problems():
        stated = any(f"{text} {d}" in sentence for d in result.drives for text in ("of", "at"))
        at = "" if stated else _range(result, to, which)
        place = "" if len(result.status) == 1 else f" position{'s' if '-' in which else ''} {which}{at}:"
        lines.append(wrap(f"{status}:{place} {sentence}", "  "))
    return "\n".join(lines)


def _range(result: Result, to: Printed, which: str) -> str:
    if len(result.drives) != 1:
        return ""
    ends: Sequence[str] = [where(result, to, int(k) - 1) for k in which.split("-")]
    return f" ({result.drives[0]} {' to '.join(ends)})"


NOT_IN_FULL = {
    "redundant": "solved but for the reactions that are not unique",
    "self_locking": "solved, self-locking",
    "outside_table": "solved, with a table at its end",
    "at_rest": "solved to an interval",
}
"""Statuses that come with an answer all the same, in the words that count them."""


def _count(result: Result) -> str:
    """Number of solved positions, and the outcome of the others."""
    many, solved = len(result.status), int(result.ok.sum())
    if many == 1:
        return ""
    if solved == many:
        return f"{solved} of {many} positions solved"
    answered = np.isfinite(result.power_balance) | np.isfinite(result.effort_array).any(axis=-1)
    outcomes = [
        NOT_IN_FULL[s] if s in NOT_IN_FULL and (known or s == "at_rest") else "without an answer"
        for s, known in zip(result.status, answered, strict=True)
        if s not in SOLVED
    ]
    others = "; ".join(f"{outcomes.count(words)} {words}" for words in dict.fromkeys(outcomes))
    return f"{solved} of {many} positions solved in full; {others}"


def checks_text(result: Result) -> str:
    """Number of solved positions, and their worst residual and power balance."""
    checks = [
        (n, v[np.isfinite(v)])
        for n, v in (("residual", result.residual), ("power balance", result.power_balance))
    ]
    shown = ", ".join(
        f"{name} {remainder(float(np.abs(values).max()), 1)}" for name, values in checks if values.size
    )
    count = _count(result)
    between = "; " if ";" in count else ", "
    return wrap(_sentence(between.join(filter(None, (count, shown)))) + ".") if count or shown else ""


MOST_NAMED = 8
"""Reversals that are named one by one."""


def reversals_text(result: Result, to: Printed) -> str:
    """Reversing contacts with their positions, and how they are shown; the sentence itself for a single position."""
    places = np.flatnonzero(result.reverses)
    if not places.size or len(result.status) == 1:
        return wrap(result.reasons[0] or "", "  ") if places.size and result.ok[0] else ""
    by_joints: dict[str, list[str]] = {}
    for k in places:
        by_joints.setdefault(", ".join(reversing_joints(result, int(k))), []).append(
            where(result, to, int(k))
        )
    parts = [
        f"{joints} at {', '.join(at[:MOST_NAMED])}"
        + (f" and {len(at) - MOST_NAMED} more" if at[MOST_NAMED:] else "")
        for joints, at in by_joints.items()
    ]
    words = "the first line gives the values just before, the line below it those just after"
    if "reversal" in result.status:
        return wrap(f"Reversal of {'; '.join(parts)}: friction changes sense; {words}.", "  ")
    return wrap(f"Jump of the acceleration in {'; '.join(parts)}: {words}.", "  ")
