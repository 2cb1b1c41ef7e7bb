"""A description with symbols instead of the numbers that vary, and of the loads that change along the motion."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from dalembert.analysis.batch.tracing.traced_parameters import Channel, symbol_functions
from dalembert.analysis.batch.tracing.traced_tables import table_function
from dalembert.analysis.result.number_kinds import ANY, kind_in_file
from dalembert.arrays import Numeric, Tree
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, Scalar
from dalembert.model import Mechanism
from dalembert.model.paths import ancestors, parameter_name, reached, set_value, value_at, with_dependents
from dalembert.model.quantities.dependent_numbers import parameters_of, with_new
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.parameters import values_of
from dalembert.model.quantities.values import Vector
from dalembert.model.quantities.vectors import length, unit

DRIVEN = ("position", "law", "range")
"""Keys of a drive that are given when a kernel is called."""


PLACING = ("period",)
"""Data that determine where the points of a table are."""

SHAPES = ("segments", "tangent", "arcs", "points")
"""Keys of a cam's profile from which its curve is computed before the kernel is compiled."""


@dataclass(frozen=True)
class VariedNumber:
    """One number of a description: its path and its value, SI."""

    path: str
    value: float
    parameter: bool = False
    """True if it is a parameter of the file, on which others depend."""

    @property
    def keys(self) -> list[str]:
        return ["parameters", self.path] if self.parameter else self.path.split(".")


def numbers(m: Mechanism, vary: Iterable[str]) -> tuple[VariedNumber, ...]:
    """The numbers behind dotted paths, vectors as their components `.0`, `.1`, matrices `.0.1`."""
    out: list[VariedNumber] = []
    for path in vary:
        name = parameter_name(path, m.parameters, m.keys())
        if name:
            out.append(_parameter(m, name))
            continue
        value = value_at(m, path.split("."))
        if value is None:
            _refuse_absent(m, path, path.split("."))
        _refuse_law(m, path)
        _refuse_followed(m, path)
        out += _numbers(path, value)
    refuse_twofold(m, out)
    double = next((n.path for k, n in enumerate(out) if n.path in {o.path for o in out[:k]}), None)
    if double:
        raise ModelError(f"{double!r} is varied twice", "name it once")
    return tuple(out)


def _parameter(m: Mechanism, name: str) -> VariedNumber:
    """A parameter, if what follows from it may vary."""
    for path in reached(m, name):
        keys = path.split(".")
        if keys[0] == "drives" and keys[2] in DRIVEN:
            what = f"{name!r} sets {'.'.join(keys[:3])!r}, which cannot vary from design to design"
            raise ModelError(what, "give the positions when you call the kernel", keys)
        if keys[0] in ("loads", "drives") and (keys[-1] in PLACING or keys[-2] == "x"):
            what = f"{name!r} moves the points of the table {'.'.join(keys[:3])!r} along the motion"
            raise ModelError(f"{what}, and cannot vary", "leave it out, or write an expression", keys)
        _refuse_law(m, path)
        _refuse_followed(m, path)
    return VariedNumber(name, float(m.parameters[name].value), parameter=True)


def may_vary(m: Mechanism, name: str) -> bool:
    """True if a parameter may vary: it does not determine a drive's position."""
    try:
        _parameter(m, name)
    except ModelError:
        return False
    return True


def refuse_twofold(m: Mechanism, varied: list[VariedNumber]) -> None:
    """Raise ModelError for a number that follows from a parameter given beside it."""
    for parameter in (n for n in varied if n.parameter):
        followers = set(reached(m, parameter.path))
        for n in varied:
            value = m.parameters[n.path].value if n.parameter else None
            if n.path in followers or parameter.path in ancestors(parameters_of(value), m.parameters):
                what = f"{n.path!r} follows from the parameter {parameter.path!r}, and both vary"
                raise ModelError(what, "leave one of them out", n.keys)


def _refuse_law(m: Mechanism, path: str) -> None:
    keys = path.split(".")
    if keys[0] == "drives" and len(keys) > 1 and m.drives[keys[1]].law is not None and keys[-1] != "effort":
        raise ModelError(f"{path!r} follows from the drive's law of motion", "leave it out, or the law", keys)


def _refuse_followed(m: Mechanism, path: str) -> None:
    """Refuse numbers from which others in the description were computed: of a cam's curve, of a cylinder, of guides of
    ropes."""
    keys = path.split(".")
    if leads_rope(m, path):
        what = f"the direction of the parallel strands of a rope follows from {path!r}, which cannot vary"
        raise ModelError(what, "leave it out, or write parallel: 90 deg of the rope", keys)
    if keys[0] == "joints" and keys[2:3] == ["profile"] and keys[3] in SHAPES:
        what = f"the curve of cam {keys[1]!r} is computed from {path!r} before the kernel, so that number cannot vary"
        raise ModelError(what, "vary its base or its roller, or solve each design by da.sweep", keys)
    c = m.drives[keys[1]].cylinder if keys[2:3] == ["cylinder"] and keys[1] in m.drives else None
    if c is None:
        return
    if c.mass is not None and keys[3] in ("mass", "closed", "stroke", "barrel_length"):
        what = f"the masses of barrel and rod follow from {path!r}, which cannot vary"
        raise ModelError(what, f"vary links.{keys[1]}_barrel.mass and links.{keys[1]}_rod.mass", keys)
    if c.known_force is not None and keys[3] in ("bore", "rod", "cap_pressure", "rod_pressure"):
        what = f"the known effort of {keys[1]} follows from {path!r}, which cannot vary"
        raise ModelError(what, f"vary drives.{keys[1]}.effort", keys)


def leads_rope(m: Mechanism, path: str) -> bool:
    """True if a path names a guide whose direction a rope with parallel strands takes over."""
    keys = path.split(".")
    if keys[0] != "joints" or keys[2:] != ["direction"]:
        return False
    link = m.joints[keys[1]].links[1]
    ropes = (rope for rope in m.ropes.values() if rope.parallel is True)
    return any(point.round[0] == link for rope in ropes for point in rope.through)


def of_motion(path: str) -> bool:
    """True if a path names an initial value of a motion under forces, or a number of a motor."""
    keys = path.split(".")
    return keys[0] == "start" or keys[2:3] == ["motor"]


def _numbers(path: str, value: object) -> list[VariedNumber]:
    keys = path.split(".")
    if keys[0] == "drives" and len(keys) > 2 and keys[2] in DRIVEN:
        raise ModelError(
            f"{path!r} cannot vary from design to design",
            "give the positions when you call the kernel",
            keys,
        )
    if of_motion(path):
        raise ModelError(f"{path!r} is of a motion under forces", "compile one: da.compile_motion", keys)
    if keys[0] == "drives" and isinstance(value, tuple):
        raise ModelError(
            f"{path!r} is a list along the motion",
            "vary single speeds, or vary their scale in the units",
            keys,
        )
    if isinstance(value, (bool, str)):
        raise ModelError(
            f"{path!r} is {value!r}, not a number", "give it a number in the description first", keys
        )
    if isinstance(value, (int, float)):
        return [VariedNumber(path, float(value))]
    if isinstance(value, tuple) and all(isinstance(x, (int, float)) for x in value):
        return [VariedNumber(f"{path}.{k}", float(x)) for k, x in enumerate(value)]
    if keys[-1] == "inertia" and isinstance(value, tuple):  # what stands twice varies once
        return [
            VariedNumber(f"{path}.{i}.{j}", float(row[j])) for i, row in enumerate(value) for j in range(i, 3)
        ]
    raise ModelError(
        f"{path!r} is not a number", "name a number, or a vector of numbers, of the description", keys
    )


SAME = {"mass": ("weight", "shape"), "weight": ("mass", "shape"), "center": ("shape",), "inertia": ("shape",)}
"""Key of a link -> the keys that may give the same in its place."""


def _refuse_absent(m: Mechanism, path: str, keys: list[str]) -> None:
    """Say which key gives what a path asks for and does not have."""
    others = SAME.get(keys[-1], ()) if keys[0] == "links" and len(keys) == 3 else ()
    part = m.links[keys[1]] if others else None
    alternative = next(
        (o for o in others if getattr(part, "shapes" if o == "shape" else o) not in (None, ())), ""
    )
    place = ".".join([*keys[:-1], alternative])
    what = f"{path!r} has no number: the file gives {place!r}" if alternative else f"{path!r} has no number"
    remedy = {"": f"give {keys[-1]} a value in the model file first", "shape": f"vary a number below {place}"}
    raise ModelError(what, remedy.get(alternative, f"vary {place}"), keys)


def number_kinds(m: Mechanism, numbers: Sequence[VariedNumber]) -> tuple[str, ...]:
    """Kind of each number, from `units.KINDS`: by the unit that a saved file writes for it."""
    written = [n for n in numbers if not n.parameter]
    tree = with_numbers(m, written, [ANY] * len(written)).to_tree() if written else {}
    return tuple(
        kind_in_file(tree, n.keys) if not n.parameter else m.parameters[n.path].kind or "number"
        for n in numbers
    )


def geometric(m: Mechanism, path: str) -> bool:
    """True if the number at a path, or a value that depends on a parameter, places joints."""
    return any(_places_joints(place.split(".")) for place in reached(m, path))


def chooses_motion(m: Mechanism, path: str, flips: bool) -> bool:
    """True if a number decides which motion a design has: through `assembly`, with change points through the geometry
    too."""
    assembly = any(place.startswith("assembly.") for place in reached(m, path))
    return assembly or (flips and geometric(m, path))


def _places_joints(keys: list[str]) -> bool:
    loads = {"damping", "friction", "efficiency"}  # of a joint: it stands where it stood
    return "points" in keys[2:3] or (keys[0] == "joints" and not loads & set(keys[2:]))


def with_numbers(
    m: Mechanism, where: Iterable[VariedNumber], values: Iterable[Scalar], symbols: Functions | None = None
) -> Mechanism:
    """The description with other numbers, or symbols, in their places; not checked again.

    symbols: the functions of expressions for symbols, where the values are such.
    """
    pairs = list(zip(where, values, strict=True))
    changed = {number.path: value for number, value in pairs if number.parameter}
    if changed:
        new = values_of(m.parameters, changed, symbols)
        m = with_dependents(m, lambda leaf: with_new(leaf, new, symbols), None)
        parameters = {name: replace(p, value=new[name]) for name, p in m.parameters.items()}
        m = m.model_copy(update={"parameters": parameters})
    for number, value in pairs:
        if not number.parameter:
            m = set_value(m, number.keys, value)
    return m


@dataclass(frozen=True)
class SymbolicForce:
    """A force whose components, of an unknown one per unit of it, are symbols."""

    ON: ClassVar = "point"
    on: str
    at: str | Vector
    axes: str
    components: tuple[Scalar, ...]
    unknown: bool = False
    by: str | None = None

    def force(self, drives: object) -> tuple[Scalar, ...]:
        return self.components


def symbolic(m: Mechanism, where: tuple[VariedNumber, ...], graph: Graph, channel: Channel) -> Mechanism:
    """The description on symbols; ``channel(name, varying)`` gives the input of a load that changes with the drives."""
    nodes = [graph.input("number", n.path, n.value) for n in where]
    try:
        s = with_numbers(m, where, nodes, symbol_functions(graph))
    except TypeError as error:
        raise ModelError(
            f"an expression of parameters cannot be compiled: {error}", "use the analyses"
        ) from None
    if not m.g_override and any(isinstance(g, Node) for g in s.gravity_vector):
        s = s.model_copy(update={"g_override": length(s.gravity_vector)})
    loads = {name: _load(name, load, channel) for name, load in s.loads.items()}
    drives = {
        name: d.model_copy(update={"effort": _value(f"drives.{name}.effort", d.effort, channel)})
        for name, d in s.drives.items()
    }
    return s.model_copy(update={"loads": loads, "drives": drives})


def _value(name: str, value: Numeric, channel: Channel) -> Numeric:
    """A number or symbol itself, else the input for its value along the motion."""
    return channel(name, value) if hasattr(value, "at") else value  # an input, or traced from some


def _load(name: str, load: Any, channel: Channel) -> object:
    def node(value: Any) -> Any:
        if isinstance(value, tuple):
            return tuple(_value(f"loads.{name}.value.{k}", v, channel) for k, v in enumerate(value))
        return _value(f"loads.{name}.value", value, channel)

    if load.ON == "link" and not load.unknown:
        return load.model_copy(update={"value": node(load.value)})
    if load.ON != "point":
        return load
    if isinstance(load.value, tuple):
        return SymbolicForce(load.on, load.at, load.axes, node(load.value), by=load.by)
    size = 1.0 if load.unknown else node(load.value)
    components = tuple(size * x for x in _direction(load.direction))
    return SymbolicForce(load.on, load.at, load.axes, components, load.unknown, load.by)


def _direction(value: Scalar | Vector) -> tuple[Scalar, ...]:
    if isinstance(value, Node):
        return value.cos(), value.sin()
    if isinstance(value, tuple):
        return unit(value)
    return unit_vector(value)


def functions(graph: Graph) -> Tree:
    """The functions of expressions for nodes."""

    def node(x: Scalar) -> Node:
        return x if isinstance(x, Node) else graph.constant(x)

    def one(op: str) -> Callable[[Scalar], Node]:
        return lambda x: graph.unary(op, node(x))

    def two(op: str) -> Callable[[Scalar, Scalar], Node]:
        return lambda x, y: graph.binary(op, node(x), node(y))

    out: dict[str, Callable[..., Node]] = {
        name: one(name) for name in ("sin", "cos", "tan", "asin", "acos", "sqrt", "exp", "log", "abs", "sign")
    }
    out |= {name: two(name) for name in ("atan2", "min", "max")}
    out |= {"atan": lambda x: graph.binary("atan2", node(x), graph.one), "table": table_function(graph)}
    return out
