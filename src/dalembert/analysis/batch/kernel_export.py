"""A compiled analysis outside Python: a C function of one position, CUDA text, a casadi Function."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.batch.tracing.symbolic_model import functions
from dalembert.analysis.compile.pose_loads import TIME
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.kernel.emit import c_text
from dalembert.kernel.emit.wasm.module import LANES, emit_wasm
from dalembert.kernel.graph import Node
from dalembert.kernel.program import KernelFlags, Program
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.expressions import Expression

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel


def plain(
    k: Kernel,
    nodes: list[Node] | None = None,
    marked: bool = True,
    without: frozenset[str] = frozenset(),
    known: Functions | None = None,
) -> Program:
    """The program with the drives' quantities as inputs: cosines and expressions are computed inside.

    nodes: outputs other than the requested ones. marked: with the checks of the outputs. without: operations whose
    expressions remain inputs. known: functions of expressions other than the graph's.
    """
    graph, inputs = k.trace.catalogue.graph, k.trace.inputs
    places: dict[int, Node] = {}
    names = k.trace.course.schedule.names
    raw = {n: inputs.named["channel", f"position {n}"] for n in names}
    raw |= {TIME: inputs.time()} if without else {}  # of a motion under forces
    for (kind, name), node in inputs.named.items():
        what, _, of = name.partition(" ")
        if kind == "channel" and what in ("cos", "sin") and of in raw:
            places[node.index] = raw[of].cos() if what == "cos" else raw[of].sin()
        elif isinstance(inputs.varying.get(name), Expression) and inputs.varying[name].names <= raw.keys():
            value = inputs.varying[name].at(raw, known or functions(graph))
            value = value if isinstance(value, Node) else graph.constant(value)
            if not any(n.op in without for n in graph.order([value])):
                places[node.index] = value
        elif kind == "common" or (what == "counted" and np.ptp(inputs.sources[node](k.trace.course)) == 0):
            places[node.index] = graph.constant(np.ravel(inputs.sources[node](k.trace.course))[0])
    program = k.program(k.flat) if nodes is None else k.program(nodes, len(nodes))
    program = program if marked else Program(graph, program.outputs)
    groups = [program.outputs, *(getattr(program.flags, f.name) for f in fields(KernelFlags))]
    substituted = iter(graph.substitute([n for group in groups for n in group], places))
    outputs, *flags = (tuple(next(substituted) for _ in group) for group in groups)
    return Program(graph, outputs, KernelFlags(*flags))


_LETTERS = "use letters, digits and single _, a letter first"


def _refuse_reduced(k: Kernel) -> None:
    if k.reduce is not None:
        raise ModelError("a reduced analysis cannot be exported", "compile it without reduce")


def c_source(k: Kernel, name: str) -> str:
    """Self-contained C of one position."""
    _refuse_reduced(k)
    if not re.fullmatch(r"[A-Za-z_]\w*", name):
        raise ModelError(f"{name!r} is not a valid name for a C function", _LETTERS)
    program = plain(k)
    return c_text.function(program, name, _comment(k, program, name))


def _comment(k: Kernel, program: Program, name: str) -> str:
    graph = program.graph
    numbers = [f"v[{i}] = {path}" for i, path in enumerate(k.numbers)]
    inputs = [f"c[{i}] = {graph.names[n.index]}" for i, n in enumerate(program.inputs_in_use("channel"))]
    outputs = [f"out[{i}] = {what}" for i, what in enumerate(output_names(k))]
    title = k.mechanism.title or "A mechanism"
    heading = f"{title}: {name}(v, c, out) at one position, SI and radians; made by dalembert."
    result = (
        "Returns 0; 1 where the linkage does not close; 2 where the numbers may be poor (near a dead centre, or "
        "friction may jam or have several solutions);"
    )
    more = (
        "3 where friction leaves an interval (a contact at rest); 7 where it jams; "
        "9 where it is self-locking (the numbers hold)."
    )
    return "\n".join([heading, result, more, *numbers, *inputs, *outputs])


def output_names(k: Kernel) -> list[str]:
    """One name a number that the program gives."""
    parts = {
        name: [name] if len(nodes) == 1 else [f"{name}.{i}" for i in range(len(nodes))]
        for name, nodes in k.nodes.items()
    }
    out = [p for names in parts.values() for p in names]
    if k.derivatives:
        out += [f"d {p} / d {n}" for names in parts.values() for p in names for n in k.numbers]
    return out


@dataclass(frozen=True)
class WasmModule:
    """A program of a mechanism as WebAssembly: ``run(values, path, out, blocks)`` in its exported ``memory``.

    ``run`` takes addresses in bytes: values (number), path (channel, row), out (output, row), all f64, the status code
    of each position as one more output after the others (0: ok, else an index of ``STATUS_CODES``); blocks: half of the
    positions, rounded up. Memory is free from ``heap`` on; rows are ``row`` positions apart. SI and radians.
    """

    code: bytes = field(repr=False)
    heap: int
    row: int
    numbers: tuple[str, ...]
    channels: tuple[str, ...]
    outputs: tuple[str, ...]


def wasm_module(k: Kernel, row: int | None) -> WasmModule:
    """The plain program as WebAssembly."""
    _refuse_reduced(k)
    count = len(k.trace.course.schedule.position) if row is None else row
    program = plain(k)
    row = count + count % LANES
    code, heap = emit_wasm(program, row)
    channels = tuple(program.graph.names[n.index] for n in program.inputs_in_use("channel"))
    return WasmModule(code, heap, row, k.numbers, channels, tuple(output_names(k)))


def wasm_channels(k: Kernel, row: int) -> Array:
    """Content of ``path`` (channel, row) for the file's positions; the last is repeated to fill the row."""
    course, channels = k.trace.course, k.trace.inputs.sources
    count = len(course.schedule.position)
    nodes = plain(k).inputs_in_use("channel")
    values = [np.broadcast_to(np.asarray(channels[n](course), float), count) for n in nodes]
    return np.array([np.pad(a, (0, row - count), mode="edge") for a in values]).reshape(len(nodes), row)


def casadi_function(k: Kernel, name: str) -> Any:
    """casadi Function of (values, inputs)."""
    _refuse_reduced(k)
    try:
        from dalembert.kernel.emit import casadi_function

        sizes = [(re.sub(r"\W+", "_", n).strip("_"), len(nodes)) for n, nodes in k.nodes.items()]
        return casadi_function.function(plain(k), name, len(k.numbers), sizes)
    except ImportError:
        raise ModelError("casadi is not installed", "pip install 'dalembert[fast]'") from None
    except RuntimeError:
        raise ModelError(f"{name!r} is not a valid name for a casadi Function", _LETTERS) from None
