"""Quantities by their names: which there are, what a name is made of, its value, and expressions of such names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.methods.elements.cylinder_quantities import cylinders
from dalembert.analysis.methods.elements.screw_torques import screws
from dalembert.analysis.result.link_motion import ORIGIN
from dalembert.analysis.result.number_kinds import written_kind
from dalembert.analysis.result.quantity_catalogue import (
    CATALOGUE,
    FREEDOMS,
    HasQuantities,
    QuantityReading,
    bearing_areas,
    magnitude,
)
from dalembert.analysis.result.quantity_expressions import (
    check_reductions,
    check_units,
    kind_of,
    parse_quantity,
)
from dalembert.analysis.result.transmission_lines import ground_points, transmission_names
from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.machine.design_numbers import things_of
from dalembert.model.links.link import CENTER
from dalembert.model.paths import value_at
from dalembert.model.quantities.expression_trees import REDUCTIONS, Tree, evaluate, names_in, numpy_functions
from dalembert.model.quantities.parameters import Parameters
from dalembert.units import KINDS
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

SIZED = ("masses", "sections", "elastic", "fatigued", "rated", "bolted", "clear")
"""Things of machine design."""
BOUNDS = ("low", "high")
COMPONENTS = ("x", "y", "z", "magnitude", "direction")
SECTIONS = ("links", "joints", "drives", "loads")
"""Sections of a file whose numbers an expression may name by path."""


class Quantity(NamedTuple):
    """Values over the positions, SI: numbers (P,), vectors (P, d) or matrices, of a kind of ``units.KINDS``."""

    kind: str
    values: Array


def things(r: HasQuantities, of: str) -> list[str]:
    """The things that a word can be asked of, by name."""
    m = r.mechanism
    if of == "points":
        return [
            f"{link}.{p}" for link in r.links for p in dict.fromkeys((*m.links[link].points, CENTER, ORIGIN))
        ]
    if of in FREEDOMS:
        return [joint for joint, freedom in r.compiled.freedoms if freedom == of]
    if of == "loads":
        return [*r.unknown_loads, *(n for n in m.loads if n not in r.unknown_loads)]
    if of == "placed":
        return [""] if any(m.links[link].place for link in r.links) else []
    if of == "times":
        return [] if getattr(r, "time", None) is None else [""]
    if of == "frames":
        return [] if m.turning is None else [""]
    if of == "contacts":
        pushing = r.compiled.pushing
        return [] if pushing is None else list(dict.fromkeys(r.joints[k] for k in pushing.joint))
    if of == "guides":
        return [n for n in r.joints if getattr(getattr(m.joints[n], "friction", None), "guide", None)]
    if of == "hinges":
        return transmission_names(m)
    if of == "pressed":
        return [*bearing_areas(r), *cylinders(m)]
    if of == "screws":
        return list(screws(m))
    if of == "cylinders":
        return list(cylinders(m))
    if of == "fixed points":
        return ["", *ground_points(m)]
    if of in SIZED:
        return things_of(m, r.links, of)
    return list(getattr(r, of)) if of else [""]


def names_of(r: HasQuantities, compiled: bool = False, words: Iterable[str] = CATALOGUE) -> list[str]:
    """Every name without components, those with a rate behind those without."""
    return [
        ".".join(filter(None, (word, thing, rate)))
        for word in words
        if CATALOGUE[word].exists(r, compiled)
        for thing in things(r, CATALOGUE[word].of)
        for rate in CATALOGUE[word].rates
        if not (rate in BOUNDS and compiled)
        and not (r.mechanism.dimension == 3 and (word, rate) == ("angle", ""))
    ]


def solved_names(r: HasQuantities, words: Iterable[str], compiled: bool = False) -> list[str]:
    """The names of some words, of the loads those that are solved for."""
    known = {f"load.{load}" for load in r.mechanism.loads if load not in r.unknown_loads}
    return [
        n for n in names_of(r, compiled, words) if n.removesuffix(".low").removesuffix(".high") not in known
    ]


def quantity_names(r: Result) -> list[str]:
    """Every name of a result, without components; bounds and friction where there is friction.

    >>> import dalembert as da
    >>> quantity_names(da.statics(da.four_bar()))[:3]
    ['effort.O2', 'load.torque', 'reaction.O2']
    """
    hidden = [] if r.friction else [word for word, row in CATALOGUE.items() if row.friction]
    hidden += ["rotation"] if r.mechanism.dimension == 2 else []
    names = names_of(r, words=[word for word in CATALOGUE if word not in hidden])
    return [n for n in names if r.friction or n.rpartition(".")[2] not in BOUNDS]


class QuantityName(NamedTuple):
    """A name taken apart; the component is empty for a number or a complete vector."""

    word: str
    thing: str
    rate: str
    component: str

    @property
    def reading(self) -> QuantityReading:
        """Its row of the catalogue."""
        return CATALOGUE[self.word].rates[self.rate]

    def kind(self, r: Any) -> str:
        """The kind of its value, a key of ``units.KINDS``."""
        if self.component == "direction":
            return "angle"
        kind = self.reading.kind
        return kind if isinstance(kind, str) else kind(r, self.thing)


def split_name(r: HasQuantities, name: str) -> QuantityName | None:
    """The parts of a name, the longest thing that fits; None if it is not a quantity of this mechanism."""
    word, _, rest = name.partition(".")
    if word not in CATALOGUE:
        return None
    row = CATALOGUE[word]
    for thing in sorted(things(r, row.of), key=len, reverse=True):
        if thing and rest != thing and not rest.startswith(f"{thing}."):
            continue
        behind = rest[len(thing) :].strip(".").split(".") if rest != thing else []
        rate = behind.pop(0) if behind and behind[0] in row.rates else ""
        component = behind.pop(0) if behind else ""
        fits = component.isidentifier() if thing else component in COMPONENTS
        if not behind and rate in row.rates and (fits or not component):
            return QuantityName(word, thing, rate, component)
    return None


def read(r: Any, name: str) -> Quantity | None:
    """The quantity of a single name, of a component of it, or None; nodes where ``r`` is a compiled analysis."""
    parts = split_name(r, name)
    if parts is None:
        return None
    if not _leading(r) and (parts.rate in BOUNDS or not CATALOGUE[parts.word].compiled):
        what = f"{name} is not compiled"
        raise ModelError(
            what, "use da.dynamics, da.sweep, da.study or da.optimize, which analyse designs one by one"
        )
    values = np.asarray(parts.reading.read(r, parts.thing))
    return Quantity(parts.kind(r), component(values, parts.component, name, _leading(r)))


def _leading(r: Any) -> int:
    """Leading axes of its values: the positions of a result, none of a compiled analysis."""
    return 1 if hasattr(r, "status") else 0


def component(values: Array, part: str, name: str = "", leading: int = 1) -> Array:
    """A component of vectors (..., d) or matrices (..., 3, 3): x, magnitude, in the plane direction, xx; or all."""
    if not part:
        return values
    known = dict(components(values, leading))
    if part not in known:
        what = name.rpartition(".")[0] or "a number"
        raise ModelError(f"{what} has no component {part!r}", closest(part, list(known)))
    return known[part]


def components(values: Array, leading: int = 1) -> Iterator[tuple[str, Array]]:
    """Names and values of what a quantity is made of; of a vector its size and, in the plane, its direction too."""
    rank = values.ndim - leading
    for place in np.ndindex(values.shape[leading:]) if rank else ():
        yield "".join("xyz"[k] for k in place), values[(..., *place)]
    if rank == 1:
        yield "magnitude", np.asarray(magnitude(values))
    if rank == 1 and values.shape[-1] == 2:
        yield "direction", np.asarray(np.arctan2(values[..., 1], values[..., 0]))


def quantity(r: Result, name: str) -> Quantity:
    """The quantity of a name, of one component of it, or of an expression of such.

    >>> import dalembert as da
    >>> r = da.statics(da.four_bar())
    >>> quantity(r, "reaction.A.x").kind, quantity(r, "reaction.A").values.shape
    ('force', (72, 2))
    >>> quantity(r, "max(abs(effort.O2), 3 N*m)").kind
    'moment'
    """
    single = read(r, str(name))
    if single is not None:
        return single
    value, kind = evaluated(r, str(name), quantity_names(r), cycle_functions(), "quantity")
    return Quantity(kind, np.broadcast_to(np.asarray(value, float), (len(r.status),)).copy())


def cycle_functions() -> Mapping[str, Any]:
    """Functions of expressions, and the reductions over the positions."""
    from dalembert.analysis.batch.over_positions import reduce_cycle

    return {**numpy_functions(), **{word: partial(reduce_cycle, word) for word in REDUCTIONS}}


def evaluated(
    r: Any, text: str, names: Sequence[str], functions: Mapping[str, Any], what: str = "output"
) -> tuple[Numeric, str]:
    """Value and kind of an expression of quantities and parameters, on numbers or on nodes."""
    parameters: Parameters = r.mechanism.parameters
    tree = quantity_tree(r, text, names, what)
    check_reductions(tree, functions)
    parts = {name: _number(r, name, names) for name in names_in(tree)}
    known = {
        n: parameters[n].dimension if n in parameters else KINDS[q.kind].dimension if q.kind else None
        for n, q in parts.items()
    }
    check_units(tree, known, parameters)
    with np.errstate(all="ignore"):
        value = evaluate(tree, {name: q.values[()] for name, q in parts.items()}, functions)
    return value, kind_of(tree, lambda name: parts[name].kind, parameters) or "number"


def quantity_tree(r: HasQuantities, text: str, names: Sequence[str], what: str = "quantity") -> Tree:
    """The tree of an expression of quantities, also the bounds of those without friction, parameters and numbers of
    the file."""
    bounds = [
        f"{name}.{end}" for name in names for end in BOUNDS if end in CATALOGUE[name.partition(".")[0]].rates
    ]
    known = [*names, *bounds, *r.mechanism.parameters, *file_paths(r.mechanism, text)]
    return parse_quantity(text, known, what)


def file_paths(m: Mechanism, text: str) -> list[str]:
    """Paths of numbers of the file that an expression names: ``links.rod.mass``."""
    known = sorted((re.escape(n) for s in SECTIONS for n in getattr(m, s)), key=len, reverse=True)
    section, name = "|".join(SECTIONS), "|".join([*known, r"\w+"])
    return re.findall(rf"(?<![\w.])(?:{section})\.(?:{name})(?:\.\w+)+", text)


def _file_number(r: Any, path: str) -> Quantity:
    """A number of the file by its path, a node where it varies; nodes are of no kind."""
    value = value_at(r.mechanism, path.split("."))
    if value is None:
        raise ModelError(f"{path!r} has no number", "give it a value in the model file first")
    if isinstance(value, (bool, str)) or np.shape(value) or hasattr(value, "at"):
        raise ModelError(f"{path!r} is not a single number", f"name one, as {path}.0 of a vector")
    kind = written_kind(r.mechanism, path) if _leading(r) else ""
    return Quantity(kind, np.asarray(value))


def _number(r: Any, name: str, names: Sequence[str]) -> Quantity:
    part = read(r, name)
    if part is None and name in r.mechanism.parameters:
        parameter = r.mechanism.parameters[name]
        return Quantity(parameter.kind or "number", np.asarray(parameter.value))
    if part is None and name.split(".")[0] in SECTIONS:
        return _file_number(r, name)
    if part is None:
        raise ModelError(f"unknown quantity {name!r}", closest(name, list(names)))
    if part.values.ndim > _leading(r):
        raise ModelError(
            f"{name} is a vector; an expression needs numbers", f"write {name}.x or {name}.magnitude"
        )
    return part
