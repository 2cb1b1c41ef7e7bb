"""Answers beside the page's: the other assembly modes, equilibrium positions, and the share of each load."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.methods.applied_forces import link_angle, link_place
from dalembert.analysis.methods.superposition import superposition
from dalembert.analysis.result.number_kinds import drive_kinds, load_kind
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import statics
from dalembert.arrays import Array, Tree
from dalembert.core.position.first_pose_plane import Guess, without_phase
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.description import mechanism
from dalembert.pages.sweep import with_cycle
from dalembert.pages.unfinished.sketch_page import at_rest
from dalembert.views.formats.svg import svg_text
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame, fit_frame
from dalembert.views.plane.mechanism_view import draw_links, unit_size
from dalembert.views.plane.outline import link_points

MOST = 32
"""Assembly modes, or equilibrium positions, at most."""
WIDTH, HEIGHT = 44.0, 33.0
"""Of a thumbnail, mm."""
IN_SPACE = "use the command line for one in space"


def assembly_modes(m: Mechanism) -> Tree:
    """Every assembly mode at the first position: a thumbnail, the links' poses, and whether it is the file's."""
    c = compile_mechanism(m, m.schedule())
    if not isinstance(c.guess, Guess):
        raise ModelError("assembly modes are drawn for mechanisms of the plane", IN_SPACE)
    chosen = c.first_modes if np.isfinite(c.first_target).all() else None
    if chosen is None:
        what = "the linkage does not close at the first position, or no drive gives it"
        raise ModelError(what, "close it, and drive it at a position")
    nothing = Guess(np.full_like(c.guess.turn, np.nan), np.full_like(c.guess.point, np.nan))
    every = nothing.every(*without_phase(c.layout, c.first_target, c.guess, hold=True))
    poses = [chosen.pose.at(0)]
    poses += [every.pose.at(k) for k in range(len(every.pose.turn))] if every else []
    bare = m.model_copy(update={"drives": {}, "loads": {}})
    still = replace(compile_mechanism(bare, bare.schedule()), mechanism=m)
    results = distinct(c, [at_rest(Result, still, pose) for pose in poses])[:MOST]
    places = np.concatenate([p for r in results for p in outline(r)])
    frame = fit_frame(places, WIDTH, HEIGHT, unit_size(results[0], "length"))
    return {
        "modes": [
            {"svg": thumbnails(r, frame), "links": link_poses(r, 0), "here": not k}
            for k, r in enumerate(results)
        ]
    }


def distinct(c: Compiled, results: Sequence[Result]) -> list[Result]:
    """Results of one position each whose links lie differently."""
    out = list[Result]()
    for r in results:
        near = 1e-6 * c.layout.length
        if all(_apart(r, other) > near for other in out):
            out.append(r)
    return out


def _apart(r: Result, other: Result) -> float:
    """Largest distance between the places of a point in two results."""
    return max(float(np.abs(a - b).max()) for a, b in zip(outline(r), outline(other), strict=True))


def outline(r: Result) -> list[Array]:
    """The points of each link (n, 2), its mass centre among them."""
    points = ([*link_points(r, link, 0).values(), tuple(r.center(link)[0])] for link in r.links)
    return [np.array(p, float).reshape(-1, 2) for p in points]


def thumbnails(r: Result, frame: PaperFrame) -> Tree:
    """The drawing of a pose as SVG, by theme."""
    canvas = Canvas()
    draw_links(canvas, r, 0, frame)
    scene = canvas.scene(heading=False, least=0.0)
    return {theme: svg_text(scene, theme) for theme in ("light", "dark")}


def link_poses(r: Result, k: int) -> Tree:
    """Origin and angle of each link at a position, as the gesture ``pose`` takes them."""
    at = {link: (*link_place(r, link, np.zeros(2))[k], link_angle(r, link)[k]) for link in r.links}
    return {link: [float(x) for x in pose] for link, pose in at.items()}


def resting_positions(m: Mechanism, written: Mapping[str, Any]) -> Tree:
    """Positions of the first drive at which the mechanism is in equilibrium without its effort, within a turn, or
    within the travel that its page shows. ``written``: the tree of the file."""
    if m.dimension == 3:
        raise ModelError("equilibrium positions are sought for mechanisms of the plane", IN_SPACE)
    if not m.drives:
        raise ModelError("equilibrium positions are sought along a drive", "add a drive where it moves")
    name, drive = next(iter(m.drives.items()))
    r = statics(m if drive.unknown else mechanism(_released(m, written, name), m.source))
    kind = drive_kinds(r, name)["position"]
    shown = Shown(r, Notation())
    rows = [
        {
            "position": float(q),
            "shown": f"{shown.number(kind, float(q))} {shown.unit(kind)}",
            "stability": stable,
            "links": link_poses(r, k),
        }
        for k, (q, stable) in enumerate(zip(r.drive_position(name), r.stability or (), strict=False))
        if r.ok[k]
    ]
    return {
        "drive": name,
        "count": len(rows),
        "rows": rows[:MOST],
        "sentence": next((reason for reason in r.reasons if reason), "") or "",
    }


def _released(m: Mechanism, written: Mapping[str, Any], name: str) -> Tree:
    """The tree with a drive whose position is unknown and that has no effort."""
    tree = deepcopy(dict(written))
    drive = tree["drives"][name] = dict(tree["drives"][name] or {})
    for key in ("speed", "acceleration", "law", "efficiency", "motor"):
        drive.pop(key, None)
    drive |= {"position": "unknown", "effort": 0}
    if not m.drives[name].turns and "range" not in drive:
        travel = with_cycle(m).schedule().position[:, 0]
        drive["range"] = [f"{float(x)!r} m" for x in (travel.min(), travel.max())]
    return tree


def shares(r: Result) -> Tree:
    """The part of each load in every effort, unknown load and joint force at the first position, with units; the sum
    of the parts is the answer. Raises ModelError where forces do not add."""
    if not r.ok.any():
        raise ModelError("no position is solved", "look at the sentence below the drawing")
    parts, k, shown, rows = superposition(r), int(np.argmax(r.ok)), Shown(r, Notation()), list[Tree]()

    def add(name: str, kind: str, by_source: Mapping[str, Array]) -> None:
        values = [float(x[k]) / shown.size(kind) for x in by_source.values()]
        rows.append({"name": name, "unit": shown.unit(kind), "values": values, "sum": float(sum(values))})

    for drive in r.drives:
        add(f"effort of {drive}", drive_kinds(r, drive)["effort"], parts.effort(drive))
    for name in r.unknown_loads:
        add(name, load_kind(r, name), parts.unknown_load(name))
    for joint in r.joints:
        on = r.mechanism.joints[joint].links[1]
        for axis, letter in enumerate("xyz"[: r.mechanism.dimension]):
            force = {source: f[:, axis] for source, f in parts.reaction(joint).items()}
            add(f"{joint} on {on}, {letter}", "force", force)
    return {"sources": list(parts.sources), "rows": rows, "gap": float(parts.gap[k]), "position": k}
