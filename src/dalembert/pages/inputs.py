"""Inputs that a reader of the page may change: the drive, every number of the description, and draggable points."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.tracing.symbolic_model import leads_rope, may_vary, number_kinds
from dalembert.analysis.methods.applied_forces import link_place
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array, Tree
from dalembert.kernel.graph import Node
from dalembert.model import GROUND, Mechanism
from dalembert.model.quantities.dependent_numbers import Dependent
from dalembert.model.quantities.parameters import Parameter
from dalembert.model.quantities.tables import Table
from dalembert.pages.boards import Boards
from dalembert.pages.messages.number_reading import required_of
from dalembert.views.notation import pretty


def numbers_of(m: Mechanism) -> list[str]:
    """Paths of the numbers that a reader may change: parameters, geometry, masses, loads, friction, speeds."""
    independent = (name for name, p in m.parameters.items() if not isinstance(p.value, Dependent))
    free = [name for name in independent if may_vary(m, name)]
    return free + [path for path, value in _candidates(m) if _plain(value) and not _follows(m, path)]


def _candidates(m: Mechanism) -> Iterator[tuple[str, object]]:
    for name, link in m.links.items():
        yield from ((f"links.{name}.points.{p}", m.point(name, p)) for p in link.points)
        if name != GROUND and m.mass(name):
            yield from (
                (f"links.{name}.{key}", getattr(link, key)) for key in ("mass", "weight", "center", "inertia")
            )
    for name, joint in m.joints.items():
        friction = getattr(joint, "friction", None) if m.friction.enabled else None
        yield from (
            (f"joints.{name}.friction.{k}", getattr(friction, k, None)) for k in ("coefficient", "radius")
        )
        if m.dimension == 2:
            yield f"joints.{name}.direction", getattr(joint, "direction", None)
    for name, load in m.loads.items():
        if not load.unknown:
            keys = (
                "value",
                *(("direction",) if m.dimension == 2 else ()),
                "stiffness",
                "free_length",
                "free_angle",
                "damping",
                "force",
            )
            yield from ((f"loads.{name}.{key}", getattr(load, key, None)) for key in keys)
    if m.friction.enabled:
        yield "friction.coefficient", m.friction.coefficient
    for name, d in m.drives.items():
        if d.law is None:
            rates = [
                (f"drives.{name}.{key}", getattr(d, key)) for key in ("speed", "acceleration") if d.moves
            ]
            yield from (one for one in rates if isinstance(one[1], float))


def _plain(value: object) -> bool:
    """True for a number or vector that no parameter sets."""
    if isinstance(value, tuple):
        return bool(value) and all(map(_plain, value))
    return isinstance(value, float) and not isinstance(value, Dependent)


def _sources(m: Mechanism, values: Iterable[object]) -> list[str]:
    """The parameters, none of them an expression of others, on which some values depend."""
    out: list[str] = []
    for value in values:
        for name in sorted(value.names) if isinstance(value, Dependent) else ():
            stated = m.parameters[name].value
            out += _sources(m, [stated]) if isinstance(stated, Dependent) else [name]
    return list(dict.fromkeys(out))


def _follows(m: Mechanism, path: str) -> bool:
    """True if another number determines this one, or it cannot vary: weight beside mass, a point relative to another,
    a shape's inertia, the direction of a guide that a rope takes."""
    keys = path.split(".")
    if keys[0] != "links":
        return leads_rope(m, path)
    link: Any = m.links[keys[1]]
    if keys[2] == "points":
        return not isinstance(link.points[keys[3]], tuple)
    return getattr(link, "shape", None) is not None


AXES, WORDS = ("x", "y", "z"), {"center": "mass centre"}


def label(path: str) -> str:
    """A path as text for the reader: 'crank: point A, x'."""
    group, name, *rest = path.split(".")
    words = [AXES[int(w)] if w.isdigit() else WORDS.get(w, w.replace("_", " ")) for w in rest]
    if words[:1] == ["points"]:
        words = [f"point {words[1]}", *words[2:]]
    if group == "friction":
        return "friction: coefficient"
    return f"{name}: {', '.join(words)}" if words else name


def number_fields(b: Boards, k: Kernel) -> list[Tree]:
    """Every number with its path, label, SI value, unit and size of that unit."""
    out, m = list[Tree](), b.known.mechanism
    for n, kind in zip(k.trace.numbers, number_kinds(m, k.trace.numbers), strict=True):
        if n.path in m.parameters:
            out.append(_parameter_field(n.path, n.value, m.parameters[n.path]))
            continue
        out.append(
            {
                "path": n.path,
                "label": label(n.path),
                "value": n.value,
                "unit": b.shown.unit(kind),
                "size": b.shown.size(kind),
                "kind": kind,
            }
            | required_of(m, n.path)
        )
    return out


def _parameter_field(name: str, value: float, p: Parameter) -> Tree:
    """A parameter, in the unit of its file."""
    size = value / p.in_unit() if p.in_unit() else 1.0 / p.in_unit(1.0)
    field: Tree = {"path": name, "label": name, "value": value, "unit": pretty(p.unit), "size": size}
    field["kind"] = p.kind or ("" if any(p.dimension) else "number")
    about: Tree = {"about": p.about} if p.about else {}
    return field | {"parameter": True} | about | ({"range": list(p.range)} if p.range else {})


def drive_fields(b: Boards) -> list[Tree]:
    """Each drive with its positions and the place of its joint."""
    out = []
    for name in b.known.drives:
        kind = drive_kinds(b.known, name)["position"]
        joint = b.known.mechanism.drive_joint(name)
        link = b.known.mechanism.joints[joint].links[1]
        out.append(
            {
                "name": name,
                "unit": b.shown.unit(kind),
                "size": b.shown.size(kind),
                "position": series(b.known.drive_position(name)),
                "turns": kind == "angle",
                "p": b.items.at(joint),
                "link": link,
            }
            | ({"along": b.rows.direction(joint)} if kind == "length" and b.d == 2 else {})
        )
    return out


def handles(b: Boards, k: Kernel) -> list[Tree]:
    """Draggable places: joints, mass centres, other points of links, tips of loads, directions of slides.

    ``n``: the indices of the numbers that change. ``at``, ``axes``: rows of the origin and unit vectors of their axes.
    """
    movable = _Handles(b, {n.path: i for i, n in enumerate(k.trace.numbers)})
    return [*movable.joints(), *movable.points(), *movable.loads(), *movable.directions()]


class _Handles:
    def __init__(self, b: Boards, places: dict[str, int]) -> None:
        self.b, self.places, self.m = b, places, b.rows.r.mechanism
        self.taken: set[str] = set()

    def _numbers(self, path: str) -> list[int] | None:
        if f"{path}.0" in self.places:
            return [self.places[f"{path}.{i}"] for i in range(self.b.d)]
        return None

    def _end(self, link: str, path: str) -> Tree | None:
        n = self._numbers(path)
        if n is None:
            return None
        return {"n": n, "at": self.b.rows.place(link, np.zeros(self.b.d)), "axes": self.b.rows.axes(link)}

    def joints(self) -> Iterator[Tree]:
        """A joint that only turns is moved without changing the pose: its points in both links change.

        A link that otherwise only slides, as a piston, keeps its point, so that its pin stays where it was in it.
        """
        for name, joint in self.m.joints.items():
            names = joint.point_names(name)
            paths = [f"links.{link}.points.{p}" for link, p in zip(joint.links, names, strict=True)]
            self.taken.update(paths)
            if joint.apart or joint.wheels or not joint.freedoms:
                continue
            held = zip(joint.links, names, strict=True)
            points = [x for link, point in held for x in self.b.known.mechanism.point(link, point)]
            sources = _sources(self.b.known.mechanism, points)
            if sources:
                by = [self.places[source] for source in sources if source in self.places]
                at = self.b.items.at(name)
                yield from [{"kind": "joint", "name": name, "p": at, "ends": [], "by": by}] if by else []
                continue
            point_paths = [
                (link, path)
                for link, path in zip(joint.links, paths, strict=True)
                if not self._slides(link, name)
            ]
            ends = [end for link, path in point_paths if (end := self._end(link, path))]
            about = {
                k: v
                for link, path in point_paths
                for k, v in self._wheels_about(link, path.split(".")[-1]).items()
            }
            if ends and len(about) < 2:
                handle: Tree = {"kind": "joint", "name": name, "p": self.b.items.at(name), "ends": ends}
                yield handle | ({"about": next(iter(about.values()))} if about else {})

    def _wheels_about(self, link: str, point: str) -> dict[tuple[float, ...], list[int]]:
        """Rows of the centres about which a point of a link moves, by their place: where it is the centre of a
        wheel, and the link holds the centre of another one in mesh with it, their distance stays."""
        out: dict[tuple[float, ...], list[int]] = {}
        mine = self._place(link, self.m_known.point(link, point))
        for name, joint in self.m.joints.items():
            if not joint.wheels:
                continue
            ends = zip(joint.links, self.m_known.joint_points(name), strict=True)
            centres = [self._place(wheel, u) for wheel, u in ends]
            others = [b for a, b in (centres, centres[::-1]) if np.allclose(a, mine, atol=1e-9)]
            for other, u in self.m_known.points(link).items():
                if other != point and any(np.allclose(self._place(link, u), b, atol=1e-9) for b in others):
                    out[u] = self.b.rows.place(link, self.m.point(link, other))
        return out

    @property
    def m_known(self) -> Mechanism:
        """The mechanism with the file's numbers."""
        return self.b.known.mechanism

    def _place(self, link: str, u: ArrayLike) -> Array:
        """Positions of a point of a link (P, d)."""
        with np.errstate(invalid="ignore"):
            return np.nan_to_num(link_place(self.b.known, link, np.asarray(u)))

    def _slides(self, link: str, hinge: str) -> bool:
        others = [j for n, j in self.m.joints.items() if link in j.links and n != hinge]
        return link != GROUND and bool(others) and all(j.apart for j in others)

    def points(self) -> Iterator[Tree]:
        for link, part in self.m.links.items():
            for point in part.points:
                path = f"links.{link}.points.{point}"
                end = None if path in self.taken else self._end(link, path)
                if end:
                    at = self.b.rows.place(link, self.m.point(link, point))
                    yield {"kind": "point", "name": f"{link}.{point}", "p": at, "ends": [end]}
            end = self._end(link, f"links.{link}.center")
            if end:
                at = self.b.rows.place(link, self.m.center(link))
                yield {"kind": "center", "name": f"{link}: mass centre", "p": at, "ends": [end]}

    def loads(self) -> Iterator[Tree]:
        """The tip of a force whose size and direction are numbers."""
        for a in self.b.actions:
            if a.kind != "load" or a.of not in self.m.loads or self.m.loads[a.of].ON != "point":
                continue
            load: Any = self.b.known.mechanism.loads[a.of]
            axes = self.b.rows.axes(load.on if load.axes == "link" else GROUND)
            more: Tree = {
                "kind": "load",
                "name": a.of,
                "p": self.b.rows.vector(a.at[0]),
                "f": self.b.rows.vector(a.force[0]),
            }
            pair, size = self._numbers(f"loads.{a.of}.value"), self.places.get(f"loads.{a.of}.value")
            turn = self.places.get(f"loads.{a.of}.direction")
            if pair:
                yield more | {"axes": axes, "components": pair}
            elif size is not None:
                yield more | {"axes": axes, "size": size} | ({} if turn is None else {"direction": turn})

    def directions(self) -> Iterator[Tree]:
        for name, joint in self.m.joints.items():
            place = self.places.get(f"joints.{name}.direction")
            if place is not None:
                yield {
                    "kind": "direction",
                    "name": name,
                    "p": self.b.rows.place(joint.links[0], self.m.joint_points(name)[0]),
                    "along": self.b.rows.direction(name),
                    "direction": place,
                    "axes": self.b.rows.axes(joint.links[0]),
                }


def channel_fields(k: Kernel, names: dict[int, str], channels: list[Node]) -> list[Tree]:
    """Inputs of the kernel along the positions: values, and the segments of tables, so that the page also has exact
    values between the positions."""
    course, inputs = k.trace.course, k.trace.inputs
    count, out = len(course.schedule.position), []
    for n in channels:
        values = np.broadcast_to(np.asarray(inputs.sources[n](course), float), (count,))
        field: Tree = {"name": names[n.index], "values": series(values)}
        varying = inputs.varying.get(names[n.index])
        if isinstance(varying, Table):
            breaks, pieces = varying.everywhere()
            field["table"] = {
                "drive": varying.against,
                "breaks": floats(breaks),
                "pieces": floats(pieces),
                "order": len(pieces),
                "period": varying.period,
            }
        out.append(field)
    return out


JUMPS = ("counted", "speed", "acceleration", "known reversal")
"""Prefixes of channels that are valid at the listed positions only, where they jump."""


def only_at_positions(k: Kernel, names: dict[int, str], channels: list[Node]) -> bool:
    """True if the page may stop only at the listed positions, as some input is unknown in between."""
    course, readers = k.trace.course, k.trace.inputs.sources
    return any(
        names[n.index].startswith(JUMPS) and float(np.ptp(np.asarray(readers[n](course), float))) > 0
        for n in channels
    )


def series(values: Array) -> Tree | str:
    """Numbers along the positions: first, step and count if evenly spaced, else their bytes."""
    even = np.linspace(values[0], values[-1], len(values))
    if len(values) > 3 and np.abs(values - even).max() <= 4 * np.spacing(np.abs(values).max()):
        return {"from": float(values[0]), "to": float(values[-1]), "count": len(values)}
    return floats(values)


def floats(values: ArrayLike) -> str:
    """Numbers as text: their bytes, little endian."""
    return base64.b64encode(np.asarray(values, "<f8").tobytes()).decode()
