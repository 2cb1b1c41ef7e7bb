"""A quantity of a result by its name, as `da.compile` names its outputs: ``effort.O2``, ``reaction.A.x``."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.output.columns import OF_LINKS, OF_POINTS, drive_kinds, load_kind
from dalembert.analysis.result.quantity_expressions import check_units, kind_of, parse_quantity
from dalembert.analysis.result.transmission_lines import (
    Line,
    OfLines,
    closure_margin,
    ground_points,
    transmission_angle,
    transmission_lines,
    transmission_names,
)
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.model.links.link import CENTER
from dalembert.model.quantities.expressions import evaluate, names_in, numpy_functions
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


class Quantity(NamedTuple):
    """Values over the positions, SI: numbers (P,), vectors (P, d) or matrices, of a kind of ``units.KINDS``."""

    kind: str
    values: Array


Read = Callable[["Result", str], Array]


def _of(method: str) -> Read:
    """What a method of a result answers about one name."""
    return lambda r, of: np.asarray(getattr(r, method)(of))


def _of_point(method: str) -> Read:
    return lambda r, of: np.asarray(getattr(r, method)(*of.split(".", 1)))


def _magnitude(r: Result, joint: str) -> Array:
    return np.asarray(np.linalg.norm(r.reaction(joint), axis=-1))


def _hinge(value: OfLines) -> Read:
    """What is made of the two lines of a hinge."""

    def read(r: Result, of: str) -> Array:
        lines = transmission_lines(r.mechanism, of)
        return np.asarray(value(_turned(r, lines[0]), _turned(r, lines[1]), lines))

    return read


def _turned(r: Result, line: Line) -> Array:
    if line.link == GROUND:
        return np.broadcast_to(line.along, (len(r.status), 2))
    return plane.rotate(plane.rotation(r.angle(line.link)), line.along)


def _pressure(r: Result, joint: str) -> Array:
    """Force across the axis over the projected area."""
    from dalembert.analysis.friction.bearing_ends import bearing_axis

    force = r.reaction(joint)
    if r.mechanism.dimension == 3:
        axis = bearing_axis(r, joint)
        force = force - (force * axis).sum(axis=1, keepdims=True) * axis
    return np.asarray(np.linalg.norm(force, axis=-1) / bearing_areas(r)[joint])


def _shaking(part: str) -> Read:
    def read(r: Result, about: str) -> Array:
        from dalembert.machine.shaking import shaking

        return np.asarray(getattr(shaking(r, about or None), part))

    return read


READ: dict[str, tuple[str, str, Read]] = {
    "effort": ("drives", "", _of("effort")),
    "load": ("unknown_loads", "", _of("unknown_load")),
    "reaction": ("joints", "force", _of("reaction")),
    "magnitude": ("joints", "force", _magnitude),
    "moment": ("joints", "moment", _of("reaction_moment")),
    "power_lost": ("joints", "power", _of("power_lost")),
    "drive": ("drives", "", _of("drive_position")),
    "power": ("drives", "power", lambda r, of: r.effort(of) * r.drive_speed(of)),
    "transmission": ("hinges", "angle", _hinge(transmission_angle)),
    "closure": ("hinges", "length", _hinge(closure_margin)),
    "pressure": ("sized bearings", "pressure", _pressure),
    "shaking": ("", "force", _shaking("force")),
    "shaking_moment": ("fixed points", "moment", _shaking("moment")),
    **{word: ("links", kind, _of(word)) for word, kind in OF_LINKS.items()},
    **{word: ("points", kind, _of_point(word)) for word, kind in OF_POINTS.items()},
    "residual": ("", "number", lambda r, _: r.residual),
    "power_balance": ("", "number", lambda r, _: r.power_balance),
}
"""First word of a name -> what it is asked of, its kind (a drive's or load's own where it is empty), how it is read."""


class Named(Protocol):
    """What has names to ask about: a result, or what is compiled."""

    @property
    def mechanism(self) -> Mechanism: ...
    @property
    def links(self) -> tuple[str, ...]: ...
    @property
    def joints(self) -> tuple[str, ...]: ...
    @property
    def drives(self) -> tuple[str, ...]: ...
    @property
    def unknown_loads(self) -> tuple[str, ...]: ...


def things(r: Named, of: str) -> list[str]:
    """What there is to ask about."""
    if of == "points":
        links = r.mechanism.links
        return [f"{link}.{point}" for link in r.links for point in (*links[link].points, CENTER)]
    if of == "hinges":
        return transmission_names(r.mechanism)
    if of == "sized bearings":
        return list(bearing_areas(r))
    if of == "fixed points":
        return ["", *ground_points(r.mechanism)]
    return list(getattr(r, of)) if of else [""]


def bearing_areas(r: Named) -> dict[str, Any]:
    """Projected area of each bearing with a diameter and a length; where a number varies, a node."""
    bearings = {name: getattr(r.mechanism.joints[name], "bearing", None) for name in r.joints}
    return {name: b.area for name, b in bearings.items() if b is not None and b.area is not None}


def names_of(r: Named, words: Iterable[str]) -> list[str]:
    """Every name that begins with one of some words, without components."""
    return [f"{word}.{thing}".rstrip(".") for word in words for thing in things(r, READ[word][0])]


def quantity_names(r: Result) -> list[str]:
    """Every name there is, without components.

    >>> import dalembert as da
    >>> quantity_names(da.statics(da.four_bar()))[:3]
    ['effort.O2', 'reaction.O2', 'reaction.A']
    """
    plane = r.mechanism.dimension == 2
    left_out = ("rotation" if plane else "angle", *(() if r.friction else ("power_lost",)))
    return names_of(r, [word for word in READ if word not in left_out])


def quantity(r: Result, name: str) -> Quantity:
    """The quantity of a name; of a vector a component behind a dot: x, y, z, magnitude; or an expression of such.

    >>> import dalembert as da
    >>> r = da.statics(da.four_bar())
    >>> quantity(r, "reaction.A.x").kind, quantity(r, "reaction.A").values.shape
    ('force', (72, 2))
    >>> quantity(r, "max(abs(effort.O2), 3 N*m)").kind
    'moment'
    """
    found = _find_quantity(r, str(name))
    if found is not None:
        return found
    tree = parse_quantity(str(name), quantity_names(r), "quantity")
    parts = {n: _scalar(r, n) for n in names_in(tree)}
    check_units(tree, lambda n: parts[n].kind)
    with np.errstate(all="ignore"):
        value = evaluate(tree, {n: q.values for n, q in parts.items()}, numpy_functions())
    return Quantity(
        kind_of(tree, lambda n: parts[n].kind) or "number",
        np.broadcast_to(np.asarray(value, float), (len(r.status),)).copy(),
    )


def _scalar(r: Result, name: str) -> Quantity:
    found = _find_quantity(r, name)
    if found is None:
        raise ModelError(f"there is no quantity {name!r}", closest(name, quantity_names(r)))
    if found.values.ndim > 1:
        raise ModelError(
            f"{name} is a vector, and an expression is of numbers", f"write {name}.x or {name}.magnitude"
        )
    return found


def _find_quantity(r: Result, name: str) -> Quantity | None:
    """The quantity of a single name, or of a component; None where there is none."""
    word, _, behind = name.partition(".")
    if word not in READ:
        return None
    of, _, read = READ[word]
    whole, _, part = behind.rpartition(".")
    tries = [(behind, []), (whole, [part])] if part.isidentifier() else [(behind, [])]
    for thing, parts in tries:
        if thing in things(r, of):
            return Quantity(kind_of_name(r, f"{word}.{thing}"), _component(name, read(r, thing), parts))
    return None


def kind_of_name(r: Any, name: str) -> str:
    """The kind of the quantity of a name without a component, of what has ``Named``'s names and is compiled."""
    word, _, thing = name.partition(".")
    of, kind, _ = READ[word]
    if kind:
        return kind
    kinds = drive_kinds(r, thing) if of == "drives" else {"load": load_kind(r, thing)}
    return kinds["position" if word == "drive" else word]


def _component(name: str, values: Array, asked: list[str]) -> Array:
    if not asked:
        return values
    there = dict(zip("xyz", values.T, strict=False)) if values.ndim == 2 else {}
    if values.ndim == 2:
        there["magnitude"] = np.linalg.norm(values, axis=-1)
    if asked[0] not in there:
        whole = name.rpartition(".")[0]
        raise ModelError(f"{whole} has no component {asked[0]!r}", closest(asked[0], list(there)))
    return np.asarray(there[asked[0]])
