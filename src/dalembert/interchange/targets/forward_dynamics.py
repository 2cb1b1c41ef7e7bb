"""A mechanism that forces move, as a unit with states: efforts in, positions and speeds of the drives as states.

effort(q, u, a) = M(q) a + h(q, u), of which the compiled analysis gives h, and M as its exact derivative; the unit
solves for the accelerations a. Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.batch.kernel_export import plain
from dalembert.errors import ModelError
from dalembert.interchange.targets.target_variables import (
    RATES,
    TargetFunction,
    TargetVariable,
    kernel_of,
    slides,
    target_function,
)
from dalembert.interchange.targets.unit_variables import UnitLayout, UnitVariable, places
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.emit import c_text
from dalembert.model import Mechanism
from dalembert.model.drives.drives import Drive
from dalembert.model.drives.starting import Start

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel

IGNORED = ("motor", "brake", "stops", "law", "range")
"""Keys of a drive besides an effort: the importer does their work, through the effort."""


def forward_unit(m: Mechanism, name: str) -> tuple[Kernel, TargetFunction, UnitLayout, list[str]]:
    """The kernel, its function ``NAME_position``, the unit's variables, and what is not kept, a line each.

    Raises ModelError for dry friction, an unknown load, and a drive that is prescribed beside one that forces move.
    """
    _refuse(m)
    k = kernel_of(m.model_copy(update={"drives": _steady(m), "start": {}, "answers": ()}))
    if k.trace.catalogue.compiled.contacts is not None:
        problem = "a unit with states has no dry friction: contacts that stick and slip are events"
        raise ModelError(problem, "write friction: off, or simulate it here", ("friction",))
    f = target_function(k, f"{name}_position")
    variables = [UnitVariable(_effort(m, drive), "input") for drive in m.drives]
    variables += [UnitVariable(v, "input") for v in f.inputs if not v.name.startswith("drive.")]
    variables += [UnitVariable(v, "parameter") for v in f.parameters]
    variables += _motion(m, len(variables))
    variables += [UnitVariable(v, "output") for v in f.outputs]
    reference = {v.of.name: i + 1 for i, v in enumerate(variables)}
    source, labels = _accelerating(k, name)
    found = [
        f"drive.{x.removeprefix('position ')}.position" if x.startswith("position ") else x for x in labels
    ]
    channels, sizes = tuple(reference[x] for x in found), tuple(_size(m, drive) for drive in m.drives)
    layout = UnitLayout(tuple(variables), *places(f, variables), source, channels, sizes)
    return k, f, layout, _left_out(m)


def _refuse(m: Mechanism) -> None:
    moved = [n for n, d in m.drives.items() if n in m.start or d.motor is not None or d.effort is not None]
    led = [n for n in m.drives if n not in moved]
    if moved and led:
        raise ModelError(
            f"forces move drive {moved[0]!r}, but drive {led[0]!r} is prescribed, which no unit with states has",
            f"write a start for {led[0]!r} too, or leave out what moves {moved[0]!r}",
            ("drives", led[0]),
        )
    if not m.drives:
        raise ModelError("no drive could be a state", "write a drive for each freedom", ("drives",))
    unknown = next((n for n, load in m.loads.items() if load.unknown), None)
    if unknown:
        problem = f"load {unknown!r} is unknown, but forces move the machine"
        raise ModelError(problem, "give it a value", ("loads", unknown, "value"))


def _steady(m: Mechanism) -> Mapping[str, Drive]:
    """The drives, all prescribed where they start; their speed is any that is not 0."""
    none = dict.fromkeys(("effort", *IGNORED)) | {"brake": 0.0, "speed": 1.0, "acceleration": 0.0}
    return {n: d.model_copy(update={**none, "position": _start(m, n).position}) for n, d in m.drives.items()}


def _start(m: Mechanism, drive: str) -> Start:
    """Position and speed of a drive at the start: of ``start``, else the first of the drive."""
    if drive in m.start:
        return m.start[drive]
    schedule = m.schedule()
    k = schedule.names.index(drive)
    return Start(float(schedule.position[0, k]), float(schedule.speed[0, k]))


def _effort(m: Mechanism, drive: str) -> TargetVariable:
    """The input; it begins with the effort of the file, if that is a number."""
    known = m.drives[drive].effort
    kind = "force" if slides(m, drive) else "moment"
    return TargetVariable(f"drive.{drive}.effort", kind, known if isinstance(known, float) else 0.0, 0)


def _motion(m: Mechanism, before: int) -> list[UnitVariable]:
    """Positions and speeds, which are the states, then accelerations; ``before`` variables stand before them."""
    out: list[UnitVariable] = []
    for order, rate in enumerate(RATES):
        for drive in m.drives:
            start = getattr(_start(m, drive), rate, 0.0)
            of = TargetVariable(f"drive.{drive}.{rate}", RATES[rate][slides(m, drive)], start, 0)
            integral = before + len(out) + 1 - len(m.drives) if order else None
            out.append(UnitVariable(of, "output", rate != "acceleration", integral))
    return out


def _accelerating(k: Kernel, name: str) -> tuple[str, list[str]]:
    """C of ``NAME_terms(v, c, out)``: h (D,) then M (D, D); and the names of its channels."""
    graph, drives = k.trace.catalogue.graph, list(k.mechanism.drives)
    numbers = dict(zip(k.numbers, k.number_nodes, strict=True))
    rates = [numbers[f"drives.{drive}.acceleration"] for drive in drives]
    effort = [n for drive in drives for n in k.trace.catalogue.nodes(f"effort.{drive}")]
    mass = [n for row in gradients(graph, effort, rates) for n in row]
    for i, drive in enumerate(drives):
        if mass[i * (len(drives) + 1)] is graph.zero:
            raise ModelError(f"forces that move {drive!r} move no mass", "give its links masses", ("links",))
    terms = graph.substitute([*effort, *mass], dict.fromkeys((n.index for n in rates), graph.zero))
    program = plain(k, terms)
    labels = [graph.names[n.index] for n in program.inputs_in_use("channel")]
    return c_text.function(
        program, f"{name}_terms", "Efforts at no acceleration, then the mass matrix."
    ), labels


def _size(m: Mechanism, drive: str) -> float:
    """Reference of its position in steps: 1 rad, or the largest distance of two points of a link."""
    if not slides(m, drive):
        return 1.0
    at = [np.array(list(m.points(name).values()), float) for name, link in m.links.items() if link.points]
    return max((float(np.ptp(x, axis=0).max()) for x in at), default=0.0) or 1.0


def _left_out(m: Mechanism) -> list[str]:
    out = [f"{what} of drive {n!r}" for n, d in m.drives.items() for what in IGNORED if getattr(d, what)]
    out += [f"effort of drive {n!r}, which varies" for n, d in m.drives.items() if hasattr(d.effort, "at")]
    return out + [f"stops of joint {n!r}" for n, j in m.joints.items() if getattr(j, "stops", None)]
