"""The page of a mechanism that is not finished: links and joints as a program of their poses, and what is missing.

The page pulls the links by it; the forces come with the offer that finishes the mechanism, whose page is inside.
"""

from __future__ import annotations

import base64
import json
import math
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from importlib.metadata import version
from typing import Any, TypeVar

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.methods.applied_forces import link_place
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.overflow import size_sentence
from dalembert.arrays import Array, Tree
from dalembert.core.constraints import measure
from dalembert.core.layout import Pose
from dalembert.core.position.first_pose_plane import phase_rows
from dalembert.core.rank import Rank, rank
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph
from dalembert.kernel.program import Program
from dalembert.kernel.sketch_program import PARTS, PoseInputs, pose_inputs, sketch
from dalembert.model import GROUND, Mechanism
from dalembert.model.files.model_files import loads
from dalembert.model.files.rewriting import text_of
from dalembert.model.files.splicing import splice
from dalembert.pages.boards import names, whole
from dalembert.pages.mechanism_items import Items
from dalembert.pages.modules import module
from dalembert.pages.page_data import page_data, style
from dalembert.pages.rows import NodeRows
from dalembert.pages.sketch_data import solver_data
from dalembert.pages.symbolic_result import SymbolicResult
from dalembert.pages.unfinished.sketch_offers import offers, unrooted
from dalembert.views.notation import Notation, Shown
from dalembert.views.plane.mechanism_view import full_frame

R = TypeVar("R", bound=Result)

FORMAT = "dalembert-sketch/1"
INSIDE = 12
"""Pages of offers inside a page, at most."""


def page_or_sketch(m: Mechanism, static: bool = False, inside: int = INSIDE) -> Tree:
    """The data of the live page, or of a sketch where the mechanism is not finished; raises what neither can show."""
    try:
        return page_data(m, static)
    except ModelError as error:
        found = unfinished(m)
        if found is None:
            raise
        return found.data(error, static, inside)


class SketchItems(Items):
    """Links as bars and plates between all of their named points."""

    def outline(self, link: str) -> list[list[int]]:
        """Rows of a link's points."""
        named = [self.rows.place(link, u) for u in self.mechanism.points(link).values()]
        return [*super().outline(link), *named]


def acting(d: SketchItems, name: str) -> Iterator[Tree]:
    """The arrow of a force whose components are plain numbers."""
    m, rows = d.mechanism, d.rows
    load: Any = m.loads[name]
    value, way = getattr(load, "value", None), getattr(load, "direction", None)
    if load.ON != "point" or load.unknown:
        return
    if type(value) is float and type(way) is float:
        value = (value * math.cos(way), value * math.sin(way))
    if not isinstance(value, tuple) or not all(type(x) is float for x in value):
        return
    x, y = rows.unit_vectors(load.on if load.axes == "link" else GROUND)
    d.roles.add("load")
    yield {
        "t": "force", "role": "load", "of": name, "kind": "load", "link": load.on, "name": name,
        "p": rows.place(load.on, point_of(m, load.on, load.at)),
        "f": rows.vector(value[0] * a + value[1] * b for a, b in zip(x, y, strict=True)),
    }  # fmt: skip


def free_points(d: SketchItems) -> list[Tree]:
    """Names of points that are in no joint."""
    m = d.mechanism
    taken = {pair for name, j in m.joints.items() for pair in zip(j.links, j.point_names(name), strict=True)}
    return [
        {"text": point, "p": d.rows.place(link, m.point(link, point)), "role": "title", "kind": "joint"}
        for link, part in m.links.items()
        for point in part.points
        if (link, point) not in taken
    ]


@dataclass(frozen=True)
class Unfinished:
    """A mechanism at the pose (L+1, ...) in which its sketch begins."""

    mechanism: Mechanism
    compiled: Compiled
    pose: Pose

    def data(self, error: ModelError, static: bool, inside: int) -> Tree:
        """The data of its page; ``inside``: how many pages of offers may be in it."""
        m, text, graph = self.mechanism, _text(self.mechanism), Graph()
        graph.input("number", "", 0.0)  # a program has at least one number
        c = replace(self.compiled, mechanism=m)
        pose = pose_inputs(graph, c.layout, c.layout, self.pose.at(None))
        rows = NodeRows(graph, at_rest(SymbolicResult, c, pose.core))
        known = self.result
        items = SketchItems(rows.r, known, rows, full_frame(known, 0, 120.0, 90.0))
        drawn = self._drawn(items)
        ranked = driven_rank(m, c, self.pose)
        steps = offers(m, c, ranked, self.measures, self.places, text)
        units = Shown(known, Notation())
        kinds = ("length", "angle", "force", "moment")
        return {
            "format": FORMAT,
            "version": version("dalembert"),
            "title": m.title or "A mechanism",
            "units": {kind: {"unit": units.unit(kind), "size": units.size(kind)} for kind in kinds},
            "style": style(items.roles),
            "sketch": self._solved(graph, pose),
            **drawn,
            "shown": module(Program(graph, tuple(rows.nodes)), 1),
            "missing": {
                "sentence": f"{error.what}; {error.remedy}" if error.remedy else error.what,
                "offers": _with_pages([asdict(step) for step in steps], static, inside),
            },
            "text": _with_places(m, text, c.links),
        }

    def _solved(self, graph: Graph, pose: PoseInputs) -> Tree:
        """The solver's program and the pose in which it begins."""
        c = self.compiled
        phased = set(phase_rows(c.layout.constraints).tolist())
        s = sketch(graph, c.layout, c.target, pose, phased)
        begin = {
            part: [float(graph.nominal[n.index][0]) for n in getattr(pose, part).ravel()] for part in PARTS
        }
        closure = module(Program(graph, tuple(s.outputs)), 1)
        return solver_data(c, c.layout, s) | {"drives": [], "closure": closure, "pose": begin}

    def _drawn(self, d: SketchItems) -> Tree:
        """Items, names, and the rows of links, of their points, and of joints that may be apart."""
        m, links, rows = self.mechanism, self.compiled.links, d.rows
        labels = [*names(d, Shown(self.result, Notation())), *free_points(d)]
        drawing: Tree = {"per_mm": d.frame.per_mm, "middle": list(d.frame.middle), "force": 1.0}
        drawing["arrows"] = [arrow for name in m.loads for arrow in acting(d, name)]
        ends = [(link, point) for link in links for point in m.links[link].points]
        return {
            "views": {"mechanism": drawing | {"items": whole(d), "labels": labels}},
            "poses": [[*rows.place(link, (0.0, 0.0)), *np.ravel(rows.axes(link)).tolist()] for link in links],
            "points": [{"link": x, "point": p, "p": rows.place(x, m.point(x, p))} for x, p in ends],
            "gaps": [_gap(rows, name) for name, j in m.joints.items() if not j.apart and not j.wheels],
        }

    @property
    def result(self) -> Result:
        """The pose as a result without forces."""
        return at_rest(Result, replace(self.compiled, mechanism=self.mechanism), self.pose)

    @property
    def measures(self) -> Array:
        """Values of the joints' freedoms (F,)."""
        freedoms = self.compiled.layout.freedoms
        if not freedoms.count:
            return np.zeros(0)
        return np.asarray(measure(self.compiled.layout.algebra, freedoms, self.pose))

    @property
    def places(self) -> dict[tuple[str, str], Array]:
        """The place of each named point of a link."""
        m, r = self.mechanism, self.result
        out = dict[tuple[str, str], Array]()
        for link, part in m.links.items():
            for point in part.points:
                u = np.asarray(m.point(link, point))
                out[link, point] = u if link == GROUND else np.asarray(link_place(r, link, u))[0]
        return out


def unfinished(m: Mechanism) -> Unfinished | None:
    """The mechanism as a sketch where its freedoms are not its drives or it does not close; None where it is finished,
    in space, or of a size whose squares overflow."""
    if m.dimension != 2:
        return None
    bare = m.model_copy(update={"drives": {}, "loads": {}})
    try:
        c = compile_mechanism(bare, bare.schedule())
        if not c.links or size_sentence(c) is not None:
            return None
        pose = _first_pose(m, c)
    except ModelError:
        return None
    closed = pose is not None
    if pose is None:
        pose = c.guess.start(c.layout, c.target)
    ranked = driven_rank(m, c, pose)
    if closed and ranked.freedoms == len(m.drives) and not ranked.loose.any():
        return None
    return Unfinished(m, c, pose)


def driven_rank(m: Mechanism, c: Compiled, pose: Pose) -> Rank:
    """Freedoms at a pose, and what still moves with the drives at rest."""
    driven = m.model_copy(update={"loads": {}})
    try:
        layout = compile_mechanism(driven, driven.schedule()).layout if m.drives else c.layout
    except ModelError:
        layout = c.layout
    return rank(layout, pose)


def _first_pose(m: Mechanism, c: Compiled) -> Pose | None:
    """The pose of the mechanism's first position, else one of its joints alone; None if neither closes."""
    tries: list[Callable[[], Compiled]] = [lambda: c]
    if m.drives:
        driven = m.model_copy(update={"loads": {}})
        tries.insert(0, lambda: compile_mechanism(driven, driven.schedule()))
    for make in tries:
        try:
            one = make()
            found = one.first_modes if np.isfinite(one.first_target).all() else None
        except ModelError:
            continue
        if found is not None:
            return found.pose.at(0)
    return None


def at_rest(kind: type[R], c: Compiled, pose: Pose) -> R:
    """A result of one position at a pose (L+1, ...), at rest and without forces."""
    moving, joints = slice(0, len(c.links)), len(c.joints)
    still, nothing = np.zeros((1, len(c.links), 3)), np.zeros((1, 0))
    return kind(
        compiled=c,
        inertia=False,
        mobility=None,
        mode=None,
        status=("ok",),
        reasons=(None,),
        point_array=pose.point[None, moving],
        turn_array=pose.turn[None, moving],
        rotation_array=pose.rotation[None, moving],
        twist_array=still,
        acceleration_array=still,
        force_array=np.zeros((1, joints, 2)),
        moment_array=np.zeros((1, joints)),
        effort_array=nothing,
        load_array=nothing,
        residual=np.zeros(1),
        power_balance=np.zeros(1),
    )


def _gap(rows: NodeRows, name: str) -> Tree:
    """The rows of both places of a joint."""
    m = rows.r.mechanism
    p, q = (rows.place(link, u) for link, u in zip(m.joints[name].links, m.joint_points(name), strict=True))
    return {"joint": name, "p": p, "q": q}


def _with_pages(steps: Sequence[Tree], static: bool, inside: int) -> list[Tree]:
    """Offers, with the data of the page that each leads to as far as they find room; without those that are refused."""
    out = list[Tree]()
    for step in steps:
        try:
            after = loads(step["text"])
            share = max(0, (inside - len(steps)) // len(steps))
            data = page_or_sketch(after, static, share) if len(out) < inside else None
        except ModelError:
            continue
        out.append(step | ({} if data is None else {"page": packed(data)}))
    return out


def packed(data: Tree) -> str:
    """Data of a page, compressed, as text."""
    return base64.b64encode(zlib.compress(json.dumps(data, separators=(",", ":")).encode(), 9)).decode()


def _text(m: Mechanism) -> str:
    if m.source is not None and m.source.form == "yaml" and m.source.text:
        return m.source.text.removeprefix("\ufeff")
    return text_of(m, "yaml")


def _with_places(m: Mechanism, text: str, links: Sequence[str]) -> str:
    """The text with @@k@@ at the places of the poses' numbers: x, y (m), angle (rad) of each link in turn."""
    free = unrooted(m)
    for k, link in enumerate(links):
        angle = f"@@{3 * k + 2}@@ rad"
        place = [f"@@{3 * k}@@ m", f"@@{3 * k + 1}@@ m", angle] if link in free else angle
        text = splice(text, "yaml", {("assembly", link): place})
    return text
