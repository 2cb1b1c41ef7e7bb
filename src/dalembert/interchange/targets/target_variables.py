"""Variables of a mechanism that runs elsewhere: inputs, parameters and outputs of one position, with their units."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.errors import ModelError
from dalembert.units import KINDS

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel
    from dalembert.model import Mechanism

RATES = {"position": ("angle", "length"), "speed": ("angular_speed", "speed")}
RATES |= {"acceleration": ("angular_acceleration", "acceleration")}
"""Quantity of a drive -> its kind where it turns, and where it slides."""


@dataclass(frozen=True)
class TargetVariable:
    """A variable: its name, kind of quantity, value at the start in SI, and place among the function's arguments."""

    name: str
    kind: str
    start: float
    place: int

    @property
    def unit(self) -> str:
        """Its SI unit."""
        return KINDS[self.kind].si


@dataclass(frozen=True)
class TargetFunction:
    """A C function of one position, and what its arguments are.

    inputs are arguments of ``v`` (negative places: -1 - place) or ``c``; parameters are arguments of ``v``.
    """

    source: str
    inputs: tuple[TargetVariable, ...]
    parameters: tuple[TargetVariable, ...]
    outputs: tuple[TargetVariable, ...]


def kernel_of(m: Mechanism) -> Kernel:
    """A kernel of a mechanism in which the speeds and accelerations of its drives vary."""
    from dalembert.analysis.batch.compiled_kernel import compile as compile_kernel

    vary = []
    for name, drive in m.drives.items():
        for rate in ("speed", "acceleration"):
            if m.has_speeds and not drive.law and np.ndim(getattr(drive, rate)) == 0:
                vary.append(f"drives.{name}.{rate}")
    return compile_kernel(m, vary)


def target_function(k: Kernel, name: str) -> TargetFunction:
    """The C function of a kernel with its variables; raises ModelError for inputs that no other program can give."""
    from dalembert.analysis.batch.kernel_export import c_source, plain
    from dalembert.analysis.result.named_quantities import read
    from dalembert.analysis.result.number_kinds import written_kind

    if k.derivatives:
        raise ModelError("a kernel with derivatives is not written", "compile it without derivatives")
    source, program, course = c_source(k, name), plain(k), k.trace.course
    inputs, parameters = [], []
    outputs: list[TargetVariable] = []
    for place, path in enumerate(k.numbers):
        head, drive, rate = [*path.split("."), "", ""][:3]
        if head == "drives" and rate in RATES:
            kind = RATES[rate][slides(k.mechanism, drive)]
            inputs.append(TargetVariable(f"drive.{drive}.{rate}", kind, float(k.nominal[place]), -1 - place))
        else:
            kind = written_kind(k.mechanism, path)
            parameters.append(TargetVariable(path, kind, float(k.nominal[place]), place))
    for place, node in enumerate(program.inputs_in_use("channel")):
        label = program.graph.names[node.index]
        start = float(np.ravel(k.trace.inputs.sources[node](course))[0])
        inputs.append(_channel(k.mechanism, label, start, place))
    for output, nodes in k.nodes.items():
        quantity = read(k.trace.catalogue, output)
        kind = quantity.kind if quantity else "number"
        letters = ("x", "y", "z") if len(nodes) <= 3 else tuple(f"[{i + 1}]" for i in range(len(nodes)))
        for i in range(len(nodes)):
            part = "" if len(nodes) == 1 else letters[i]
            full = f"{output}{part}" if part.startswith("[") else f"{output}.{part}" if part else output
            outputs.append(TargetVariable(full, kind, 0.0, len(outputs)))
    return TargetFunction(source, tuple(inputs), tuple(parameters), tuple(outputs))


def slides(m: Mechanism, drive: str) -> bool:
    """True if a drive prescribes a slide."""
    freedom = m.drives[drive].freedom or m.joints[m.drive_joint(drive)].freedoms[0]
    return freedom.startswith("slide")


def _channel(m: Mechanism, label: str, start: float, place: int) -> TargetVariable:
    """The variable of a quantity along the motion: of a drive, the time, or the value of a load."""
    what, _, of = label.partition(" ")
    if what in RATES and of in m.drives:
        return TargetVariable(f"drive.{of}.{what}", RATES[what][slides(m, of)], start, place)
    if what == "time" or label == "time":
        raise ModelError("a load depends on time", "give it by a drive, or as a number that varies")
    if label.startswith("loads."):
        name = label.split(".")[1]
        kind = "force" if name in m.loads and m.loads[name].ON == "point" else "moment"
        return TargetVariable(label, kind, start, place)
    raise ModelError(
        f"{label!r} is computed outside the program, which no other program does", "leave it out"
    )


def structured(name: str) -> str:
    """A name by FMI's structured convention: parts that are not identifiers are quoted.

    >>> structured("reaction.joint-1.x"), structured("point.rod.center[1]")
    ("reaction.'joint-1'.x", 'point.rod.center[1]')
    """
    parts = []
    for part in name.split("."):
        plain_part = re.fullmatch(r"[A-Za-z_]\w*(\[\d+\])?", part, re.ASCII)
        escaped = part.replace("\\", "\\\\").replace("'", "\\'")
        parts.append(part if plain_part else f"'{escaped}'")
    return ".".join(parts)


def identifier(title: str) -> str:
    """A C identifier like a title.

    >>> identifier("Four-bar linkage, dynamic")
    'Four_bar_linkage_dynamic'
    """
    name = re.sub(r"\W+", "_", title, flags=re.ASCII).strip("_")[:40] or "mechanism"
    return name if name[0].isalpha() else f"m_{name}"
