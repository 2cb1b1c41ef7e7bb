"""A quantity of a result by its name, as `da.compile` names its outputs: ``effort.O2``, ``reaction.A.x``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.output.columns import drive_kinds, load_kind
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.links.link import CENTER
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


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


READ: dict[str, tuple[str, str, Read]] = {
    "effort": ("drives", "", _of("effort")),
    "load": ("unknown_loads", "", _of("unknown_load")),
    "reaction": ("joints", "force", _of("reaction")),
    "magnitude": ("joints", "force", _magnitude),
    "moment": ("joints", "moment", _of("reaction_moment")),
    "power_lost": ("joints", "power", _of("power_lost")),
    "drive": ("drives", "", _of("drive_position")),
    "angle": ("links", "angle", _of("angle")),
    "rotation": ("links", "number", _of("rotation")),
    "speed": ("links", "angular_speed", _of("speed")),
    "acceleration": ("links", "angular_acceleration", _of("acceleration")),
    "position": ("links", "length", _of("position")),
    "velocity": ("links", "speed", _of("velocity")),
    "center": ("links", "length", _of("center")),
    "center_velocity": ("links", "speed", _of("center_velocity")),
    "center_acceleration": ("links", "acceleration", _of("center_acceleration")),
    "point": ("points", "length", _of_point("point")),
    "point_velocity": ("points", "speed", _of_point("point_velocity")),
    "point_acceleration": ("points", "acceleration", _of_point("point_acceleration")),
    "residual": ("", "number", lambda r, _: r.residual),
    "power_balance": ("", "number", lambda r, _: r.power_balance),
}
"""First word of a name -> what it is asked of, its kind (a drive's or load's own where it is empty), how it is read."""


def _things(r: Result, of: str) -> list[str]:
    """What there is to ask about."""
    if of == "points":
        links = r.mechanism.links
        return [f"{link}.{point}" for link in r.links for point in (*links[link].points, CENTER)]
    return list(getattr(r, of)) if of else [""]


def quantity_names(r: Result) -> list[str]:
    """Every name there is, without components.

    >>> import dalembert as da
    >>> quantity_names(da.statics(da.four_bar()))[:3]
    ['effort.O2', 'reaction.O2', 'reaction.A']
    """
    plane = r.mechanism.dimension == 2
    left_out = ("rotation" if plane else "angle", *(() if r.friction else ("power_lost",)))
    return [
        f"{word}.{thing}".rstrip(".")
        for word, (of, _, _) in READ.items()
        if word not in left_out
        for thing in _things(r, of)
    ]


def quantity(r: Result, name: str) -> Quantity:
    """The quantity of a name; of a vector a component behind a dot: x, y, z, magnitude.

    >>> import dalembert as da
    >>> r = da.statics(da.four_bar())
    >>> quantity(r, "reaction.A.x").kind, quantity(r, "reaction.A").values.shape
    ('force', (72, 2))
    """
    word, *rest = str(name).split(".")
    if word in READ:
        of, kind, read = READ[word]
        many = 2 if of == "points" else 1 if of else 0
        thing, parts = ".".join(rest[:many]), rest[many:]
        if thing in _things(r, of) and len(parts) < 2:
            if not kind:
                kinds = drive_kinds(r, thing) if of == "drives" else {"load": load_kind(r, thing)}
                kind = kinds["position" if word == "drive" else word]
            return Quantity(kind, _component(name, read(r, thing), parts))
    raise ModelError(f"there is no quantity {name!r}", closest(str(name), quantity_names(r)))


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
