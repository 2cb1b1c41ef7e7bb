"""`dalembert shake`, `balance`, `flywheel`, `simulate`: machine design on top of the analysis."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from dalembert.cli.answer_files import NO_LABELLED, LabelledOutputs
from dalembert.cli.options import (
    AS_GIVEN,
    AS_IN_FILE,
    Changes,
    ModelFile,
    Of,
    Positions,
    numeric,
    several,
    target,
    with_help,
)
from dalembert.errors import ModelError
from dalembert.progress import progress

if TYPE_CHECKING:
    from dalembert.analysis import Result
    from dalembert.model import Mechanism


def computed(find: Callable[[], Any], m: Mechanism) -> Any:
    """The answer; errors name the place in the model file."""
    try:
        return find()
    except ModelError as error:
        raise error.at_source(m.source) from None


def cycle_of(file: Path, of: Of, out: LabelledOutputs) -> Result:
    """The analysis of a file, over a full turn where it has one position; what cannot be written is refused first."""
    from dalembert.analysis import solve
    from dalembert.machine.whole_cycle import over_a_turn

    out.check(file)
    m = of.load(file)
    return solve(m, static=of.static, positions=over_a_turn(m, of.positions))


def answer(result: Result, find: Callable[[Result], Any], out: LabelledOutputs, **choice: Any) -> Any:
    """Compute, write and print an answer from an analysis."""
    made = computed(lambda: find(result), result.mechanism)
    out.deliver(made, **choice)
    return made


def number_of(r: Result, text: str | None, kind: str, option: str, key: str) -> float | None:
    """Value of an option, in the units of the file; raises ArgumentError outside the bounds of its key."""
    from dalembert.bounds import BOUNDS
    from dalembert.errors import ArgumentError
    from dalembert.units import file_units, quantity

    if text is None:
        return None
    try:
        value = quantity(text, kind, file_units(r.mechanism.units))
    except ModelError as error:
        raise ArgumentError(f"--{option}: {error.what}", error.remedy) from None
    if not BOUNDS[key].allows(value):
        raise ArgumentError(f"--{option} is {text}", BOUNDS[key].remedy_for(value))
    return value


def shake(
    file: ModelFile,
    /,
    *,
    about: Annotated[
        str | None,
        target(
            'Point about which moments are taken: a joint or point of the ground, or "[x, y]" '
            "(default: its first joint)."
        ),
    ] = None,
    links: Annotated[list[str] | None, several("Links to include, one or more (default: all).")] = None,
    orders: Annotated[int, numeric("orders", "Highest order of the harmonics.")] = 4,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Shaking force and moment that the machine of FILE exerts on its foundation, with harmonics."""
    import numpy as np

    from dalembert.machine.shaking import shaking

    result = cycle_of(file, of, out)
    m = result.mechanism
    made = answer(result, lambda r: shaking(r, _point(m, about), links), out, orders=orders)
    if np.isfinite(made.force).all():
        return 0
    from dalembert.analysis.output.summary.printed_answer import problems_text
    from dalembert.analysis.output.summary.printed_units import print_scale

    print(problems_text(result, print_scale(result, "file")), file=sys.stderr)
    return 1


SHAKE = """Examples:
  dalembert shake engine.yaml
  dalembert shake engine.yaml --about O2 --orders 6 --drawing shaking.svg
  dalembert shake four_bar.yaml --links coupler rocker --csv shaking.csv"""


def flywheel(
    file: ModelFile,
    /,
    *,
    cs: Annotated[
        float | None,
        numeric("Cs", "Allowed coefficient of fluctuation of speed: (max - min) / mean.", "--Cs"),
    ] = None,
    inertia: Annotated[str | None, target("Inertia of an existing flywheel, e.g. 3.5kg*m^2.")] = None,
    of: Of = AS_GIVEN,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Flywheel of FILE: energy curve, inertia from Cs, or Cs from inertia, and the exact speed over the cycle."""
    from dalembert.machine.flywheel import flywheels

    result = cycle_of(file, of, out)
    existing = number_of(result, inertia, "inertia", "inertia", "flywheel inertia")
    answer(result, lambda r: flywheels.flywheel(r, None, cs, existing), out)
    return 0


FLYWHEEL = """Examples:
  dalembert flywheel engine.yaml --Cs 0.02
  dalembert flywheel press.yaml --inertia 12kg*m^2 --drawing speed.svg --report flywheel.pdf"""


def balance(
    file: ModelFile,
    /,
    *,
    on: Annotated[
        list[str] | None,
        several(
            "Links with a counterweight, each with its bounds: crank, or crank:radius=80mm,mass=2kg; also "
            "moment=..., place=X/Y, x=FROM/TO, disc=DENSITY/THICKNESS/RADIUS, at=POINT, without spaces."
        ),
    ] = None,
    planes: Annotated[
        str | None,
        target("Two planes of a rotor in space, along its axis from the driven joint: 50mm,450mm."),
    ] = None,
    radii: Annotated[
        str | None, target("Radii of the masses in these planes: 40mm,60mm, or one radius for both.")
    ] = None,
    least: Annotated[
        str,
        with_help(
            'Aim: "rms shaking_force" (default), "peak shaking_moment" (largest value), "rms effort.O2"; or rms or '
            "peak alone, with --of."
        ),
    ] = "rms",
    of: Annotated[
        str,
        with_help(
            "Objective: force (default), moment, torque, or a weighted sum of ratios to the unbalanced values: "
            "force=1,torque=0.5."
        ),
    ] = "force",
    about: Annotated[str | None, target("Point about which moments are taken, as for shake.")] = None,
    positions: Positions = None,
    changes: Changes = AS_IN_FILE,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Optimal counterweights on links of FILE within bounds, with a proof of optimality; rotors in two planes."""
    from dalembert.cli.machine.counterweight_argument import bounds_of, sum_of, two_planes
    from dalembert.machine.balance.balancing import balance as balanced
    from dalembert.machine.balance.rotors import balance_rotor

    out.check(file, ("model",))
    m = changes.load(file)
    if planes is not None or radii is not None:
        both = two_planes(m, planes or "", radii or "", on)
        out.deliver(computed(lambda: balance_rotor(m, *both), m))
        return 0
    if not on:
        remedy = "write --on crank rocker, or, for a rotor, --planes 50mm,450mm --radii 40mm"
        raise ModelError("the links for the counterweights are missing", remedy)
    weights = dict(bounds_of(m, text) for text in on)
    out.deliver(computed(lambda: balanced(m, weights, least, sum_of(of), _point(m, about), positions), m))
    return 0


BALANCE = """Examples:
  dalembert balance four_bar.yaml --on crank rocker
  dalembert balance four_bar.yaml --on crank:radius=60mm,mass=3kg rocker --least peak --of force=1,torque=0.5
  dalembert balance engine.yaml --on crank --output balanced.yaml --drawing balance.svg
  dalembert balance shaft.yaml --planes 50mm,450mm --radii 40mm"""


def simulate(
    file: ModelFile,
    /,
    *,
    until: Annotated[
        list[str],
        several('End of the motion: a time (2s), or a condition ("O2.speed = 0 rad/s"); the first one met.'),
    ],
    event: Annotated[
        list[str] | None,
        Parameter(
            name=["--event", "--events"],
            negative=(),
            help='Condition to record when it is met: "O2.position = 90 deg", "normal.wall = 0".',
        ),
    ] = None,
    curves: Annotated[
        list[str] | None,
        several("Further quantities to plot over time: reaction.A, slide.guide, normal.wall."),
    ] = None,
    count: Annotated[
        int, numeric("instants", "Number of equally spaced instants in the answer, besides the events.")
    ] = 201,
    tolerance: Annotated[
        float | None, numeric("step error", "Relative error of a step (default: 1e-12).")
    ] = None,
    steps: Annotated[
        int,
        numeric(
            "steps",
            "Limit on integration steps when --until gives no time.",
        ),
    ] = 10_000,
    changes: Changes = AS_IN_FILE,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Motion of FILE under forces: motors, loads, springs and friction, with every joint force."""
    from dalembert.analysis.result.named_quantities import quantity
    from dalembert.machine.motion import simulation

    out.check(file)
    m, small = changes.load(file), tolerance or simulation.TOLERANCE
    with progress(f"Simulating {file}") as step:

        def tell(done: int, instants: int) -> None:
            step(done, total=instants)

        made = computed(
            lambda: simulation.simulate(m, until, None, event or (), count, small, steps, tell), m
        )
    made = replace(made, curves=tuple(curves or ()))
    for name in made.curves:
        quantity(made.result, name)  # an unknown one is refused before anything is written
    out.deliver(made)
    return {"ended": 0, "interrupted": 130}.get(made.status, 1)


SIMULATE = """Examples:
  dalembert simulate press.yaml --until 2s --drawing speed.svg --curves reaction.A slide.guide
  dalembert simulate press.yaml --until 10s "O2.speed = 30 rad/s" --csv motion.csv
  dalembert simulate crane.yaml --until 1s --event "O2.position = 90 deg" --json -"""


COMMANDS = {shake: SHAKE, balance: BALANCE, flywheel: FLYWHEEL, simulate: SIMULATE}
"""Each with its examples."""


def _point(m: Mechanism, about: str | None) -> str | Sequence[float] | None:
    """A vector in the units of the file, or a name."""
    if about is None or not about.lstrip().startswith("["):
        return about
    from dalembert.model.part import ReadingRules
    from dalembert.model.paths import as_in_file
    from dalembert.model.quantities.values import vector

    return vector(as_in_file(about), "length", ReadingRules(m.units.of_texts(), dimension=m.dimension))
