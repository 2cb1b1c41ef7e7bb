"""Notebook displays: tables with units, the status of the positions, a drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.column import Scale
from dalembert.notebook.html_card import card
from dalembert.printing import Part, TextTable, number, with_unit

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel
    from dalembert.analysis.result.result import Result
    from dalembert.model import AtPositions, Mechanism
    from dalembert.views.paper.scene import Scene

MOST_DRAWN = 60
"""Links of a mechanism that is drawn beside its tables; a larger one is drawn on request."""
MOST_POSITIONS = 2000
"""Positions along which a card's drawing traces points."""


def result_html(r: Result) -> str:
    """Title, assumptions, tables, statuses as sentences, and the mechanism."""
    from dalembert.analysis.output.summary.printed_answer import answer_parts, heading
    from dalembert.views import draw

    _, *lines = heading(r).replace("\n  ", " ").split("\n") if r.mechanism.title else ("", heading(r))
    drawn = [] if _large(r.mechanism) or len(r.status) > MOST_POSITIONS else [lambda: draw.mechanism(r)]
    return card(
        r.mechanism.title or "Result", *lines, *answer_parts(r, more="to_dataframe() has every one"), *drawn
    )


def _large(m: Mechanism) -> bool:
    return len(m.links) > MOST_DRAWN


def mechanism_html(m: Mechanism) -> str:
    """Links with mass properties, joints, drives and loads, and the drawing at the first position."""
    to = Scale(m.units)
    heads = ["link", *(f"{n}\n{to.text(k)}" for n, k in (("mass", "mass"), ("center", "length")))]
    links = TextTable(
        [*heads, f"inertia\n{to.text('inertia')}", "points"], [_link(m, n, to) for n in m.links], 1
    )
    joints = TextTable(
        ["joint", "type", "links"], [[n, j.type, ", ".join(j.links)] for n, j in m.joints.items()], 3
    )
    parts: list[Part] = [m.source_text, links, joints]
    if m.drives:
        parts.append(
            TextTable(["drive", "of joint", "from", "to", "positions"], [_drive(m, n) for n in m.drives], 2)
        )
    if m.parameters:
        known = [[n, f"{p.in_unit():.6g} {p.unit}".strip(), p.about] for n, p in m.parameters.items()]
        parts.insert(1, TextTable(["parameter", "value", "what it is"], known, 3))
    if m.loads:
        parts.append(TextTable(["load", "type"], [[n, load.type] for n, load in m.loads.items()], 2))
    return card(m.title or "Mechanism", *parts, *([] if _large(m) else [m.draw]))


def _link(m: Mechanism, link: str, to: Scale) -> list[str]:
    center = ", ".join(number(float(to("length", c)), 4) for c in m.center(link))
    inertia = np.asarray(m.inertia(link) or 0.0, float)
    size = float(to("inertia", inertia)) if inertia.ndim == 0 else float("nan")
    shown = number(size, 4) if inertia.ndim == 0 else "matrix"
    if not m.mass(link):
        center = ""
    return [link, number(float(to("mass", m.mass(link))), 4), center, shown, ", ".join(m.points(link))]


def _drive(m: Mechanism, name: str) -> list[str]:
    schedule, to = m.schedule(), Scale(m.units)
    kind = "angle" if m.drives[name].turns else "length"
    path = to(kind, schedule.position[:, list(schedule.names).index(name)])
    ends = [with_unit(float(end), to.text(kind)) for end in path[[0, -1]]]
    return [name, m.drive_joint(name), *ends, str(len(path))]


def first_pose(m: Mechanism, positions: AtPositions = None) -> Scene:
    """The mechanism drawn at its first position that closes, with the paths of its points."""
    from dalembert.analysis import kinematics
    from dalembert.views import draw

    return draw.mechanism(kinematics(m, positions))


def kernel_html(k: Kernel) -> str:
    """The varied numbers with their values in the description, the outputs, and the requests for them."""
    numbers = TextTable(
        ["number", "as described, SI"], [[p, number(v)] for p, v in zip(k.numbers, k.nominal, strict=True)]
    )
    about = [
        f"positions: {len(k.trace.course.schedule.position)}",
        "with inertia" if k.trace.inertia else "static",
        f"reduced over them: {k.reduce}" if k.reduce else "values at every position",
        *(["exact derivatives"] if k.derivatives else []),
        f"{k.lanes} values side by side",
    ]
    outputs = f"Outputs: {', '.join(k.outputs)}."
    return card(f"Kernel of {k.mechanism.title or 'a mechanism'}", "; ".join(about) + ".", numbers, outputs)
