"""Everything a page needs of one mechanism, as data: see ``web/src/data.ts`` for its form."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import version

import numpy as np

from dalembert.analysis.batch.batch_result import CODES, NUMBERED
from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.tracing.symbolic_model import geometric
from dalembert.analysis.batch.tracing.traced_analysis import trace_analysis
from dalembert.analysis.compile.contacts import friction_on
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.result import Result
from dalembert.arrays import Tree
from dalembert.errors import STATUSES, ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.emit.wasm.module import LANES
from dalembert.kernel.graph import Node
from dalembert.model import Mechanism
from dalembert.pages.boards import Boards
from dalembert.pages.inputs import (
    channel_fields,
    drive_fields,
    handles,
    number_fields,
    numbers_of,
    only_at_positions,
)
from dalembert.pages.messages.number_reading import limits, reading, sign_sentences
from dalembert.pages.messages.position_sentences import position_sentences
from dalembert.pages.modules import module
from dalembert.pages.rows import NodeRows
from dalembert.pages.saved_text import template
from dalembert.pages.sketch_data import page_pose, pose_result, posed_rows, sketch_data
from dalembert.pages.space_boards import SpaceBoards
from dalembert.pages.sweep import file_place, with_cycle
from dalembert.pages.symbolic_result import symbolic_actions, symbolic_result
from dalembert.views.formats.svg import rule
from dalembert.views.formats.themes import THEMES

FORMAT = "dalembert-page/1"
OPERATIONS = 3000
"""Largest number of operations of all derivatives; about 10 kB of page."""
UNDECIDED = (
    "The numbers may be inaccurate: a dead centre is near, an acceleration jumps, or friction may jam. "
    "Check with dalembert solve."
)
ALWAYS = (
    "text",
    "note",
    "title",
    "axis",
    "grid",
    "leader",
    "construction",
    "line-of-action",
    "gap",
    "mark",
    "faint",
    "acceleration",
)
"""Roles that the page itself draws."""


def page_data(m: Mechanism, static: bool = False, quick: bool = False) -> Tree:
    """The data of a page; raises ModelError for features of the analyses alone.

    static: leave inertia out. quick: without the derivatives that show what lowers a peak, and without the text to be
    saved, which a studio has itself: half of the work.
    """
    file, m = m, with_cycle(m)
    inertia = m.has_speeds and not static
    k = _kernel(m, inertia)
    r = symbolic_result(k)
    known = at_schedule(m, k.trace.course.schedule, inertia)
    pose = page_pose(k)
    rows, shown = (
        NodeRows(k.trace.catalogue.graph, r),
        NodeRows(k.trace.catalogue.graph, pose_result(r, pose)),
    )
    b = _boards(known, rows, k)
    views, dragged, drives = _posed(b, k)
    _posed(b.at_pose(shown, symbolic_actions(shown.r, k)), k)
    at_pose = posed_rows(rows, shown, pose)
    views |= _solved(b, views["bodies"])
    names, channels = k.trace.catalogue.graph.names, []
    beside = NodeRows(rows.graph, r, rows.nodes, rows.places)  # the same rows, without drawings
    limited, sentences = limits(m, k, beside), position_sentences(known, k, beside)
    program = plain(k, rows.nodes)
    data: Tree = {
        "format": FORMAT,
        "version": version("dalembert"),
        "title": m.title or "A mechanism",
        "source": m.source_text,
        "units": _units(b, views),
        "noise": _noise(b),
        "kernel": module(program, len(k.trace.course.schedule.position)),
        "numbers": number_fields(b, k),
        "limits": limited,
        "reading": reading() | {"signs": sign_sentences()},
        "template": [] if quick else template(m, k),
        "drives": drives,
        "start": file_place(file, m),
        "handles": dragged,
        "views": views,
        "statuses": _statuses(),
        "sentences": sentences,
        "assumptions": known.assumptions,
        "style": style(b.items.roles),
    }
    gradient = _gradient(k, b, dragged, views["charts"]) if not quick else None
    if gradient is not None:
        data["gradient"] = gradient["fields"]
        channels = gradient["channels"]
    channels = list(dict.fromkeys([*program.inputs_in_use("channel"), *channels]))
    data["sketch"] = sketch_data(k, rows, shown, pose, at_pose, {names[n.index] for n in channels})
    inputs, more = k.trace.inputs.named, data["sketch"]["shown"]["channels"]
    channels = list(
        dict.fromkeys([*channels, *(inputs["channel", n] for n in more if ("channel", n) in inputs)])
    )
    data["channels"] = channel_fields(k, names, channels)
    data["only_at_positions"] = only_at_positions(k, names, channels)
    return data


def _boards(known: Result, rows: NodeRows, k: Kernel) -> Boards:
    kind = SpaceBoards if known.mechanism.dimension == 3 else Boards
    return kind(known, rows, symbolic_actions(rows.r, k))


def _posed(b: Boards, k: Kernel) -> tuple[Tree, list[Tree], list[Tree]]:
    """The drawings with handles and drives, which the page also shows at a pose that does not close."""
    views: Tree = {"mechanism": b.mechanism(), "bodies": b.links_apart()}
    b.angles()
    return views, handles(b, k), drive_fields(b)


def _solved(b: Boards, bodies: Sequence[Tree]) -> Tree:
    """The contents that need a solved position."""
    return {
        "bodies": b.free_bodies(bodies),
        "polygons": b.polygons(),
        "charts": b.charts(),
        "table": b.table(),
        "rates": b.rates(),
    }


def _kernel(m: Mechanism, inertia: bool) -> Kernel:
    """The kernel with every number free that can be traced; no machine code is compiled."""
    free = numbers_of(m)
    sided = friction_on(m) and bool(m.schedule().moves.any())
    try:
        try:
            trace = trace_analysis(m, free, inertia, sided=sided, followed=True)
        except ModelError:
            if m.dimension == 2:
                raise
            fixed = [path for path in free if not geometric(m, path)]
            trace = trace_analysis(m, fixed, inertia, sided=sided, followed=True)
    except ModelError as error:
        raise error.at_source(m.source) from None
    return Kernel(m, trace, (), None, False, LANES)


def _gradient(k: Kernel, b: Boards, dragged: Sequence[Tree], charts: Sequence[Tree]) -> Tree | None:
    """Derivatives of the curves by the draggable numbers, at one position; as many as fit."""
    wanted = sorted({n for h in dragged for end in h.get("ends", ()) for n in end["n"]})
    curves = [curve["row"] for chart in charts for curve in chart["curves"]]
    inputs = [k.number_nodes[n] for n in wanted]
    rows, nodes = list[int](), list[Node]()
    for row in curves if wanted else ():
        more = [*nodes, *gradients(b.rows.graph, [b.rows.nodes[row]], inputs)[0]]
        if len(b.rows.graph.order(more)) > OPERATIONS:
            break
        rows, nodes = [*rows, row], more
    if not nodes:
        return None
    program = plain(k, nodes, marked=False)
    fields = module(program, LANES) | {"curves": rows, "numbers": wanted}
    return {"fields": fields, "channels": program.inputs_in_use("channel")}


def _noise(b: Boards) -> Tree:
    """Forces and moments at rounding level next to the largest force of the cycle."""
    with np.errstate(all="ignore"):
        sizes = [np.nan_to_num(np.abs(a.force)).max(initial=0.0) for a in b.numbered]
    force = 1e-12 * float(max(sizes, default=0.0))
    return {"force": force, "moment": force * b.known.compiled.layout.length}


def _units(b: Boards, views: Tree) -> Tree:
    """Unit of each displayed kind, and its size."""
    kinds = {"length", "force", "moment", *(x["kind"] for x in (*views["charts"], *views["table"]))}
    kinds |= {"speed", "acceleration"} if views["rates"] else set()
    return {kind: {"unit": b.shown.unit(kind), "size": b.shown.size(kind)} for kind in sorted(kinds)}


def _statuses() -> list[Tree]:
    """For each status code its status, sentence and remedy, and whether the position has numbers."""
    out = list[Tree]()
    for mark, status in enumerate(CODES):
        known = STATUSES.get(status)
        sentence = (
            UNDECIDED if known is None else "" if not mark else f"{known.sentence} {known.remedy}".strip()
        )
        out.append({"status": status, "sentence": sentence, "numbered": mark in NUMBERED})
    return out


def style(used: set[str]) -> Tree:
    """CSS of the roles in use, by theme."""
    themes = {theme: THEMES[theme] for theme in ("light", "dark")}
    return {
        theme: "".join(rule("l", role, looks[role]) for role in sorted((used | set(ALWAYS)) & set(looks)))
        for theme, looks in themes.items()
    }
