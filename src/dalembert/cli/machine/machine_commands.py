"""`dalembert shake`, `balance`, `flywheel`, `simulate`: machine design on top of the analysis."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from dalembert.cli.options import (
    AS_IN_FILE,
    Changes,
    Drawing,
    Force,
    ModelFile,
    Positions,
    PrintedUnits,
    Report,
    Static,
    Theme,
    numeric,
    several,
    target,
    with_help,
)
from dalembert.cli.options import output as output_to
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis import Result
    from dalembert.machine.output.machine_answer import MachineAnswer
    from dalembert.model import Mechanism


@Parameter(name="*")
@dataclass(frozen=True)
class Outputs:
    """Files of an answer."""

    json: Annotated[Path | None, target("Write everything as JSON; - prints only the JSON.")] = None
    csv: Annotated[
        Path | None, target("Write a table (CSV), one row per position; - prints only the table.")
    ] = None
    xlsx: Annotated[Path | None, target("Write a workbook with the table and the printed answer.")] = None
    drawing: Drawing = None
    report: Report = None
    units: PrintedUnits = None
    theme: Theme = "light"
    force: Force = False

    @property
    def targets(self) -> dict[str, Path | None]:
        """Kind of file -> where it goes, - for the screen."""
        return {name: getattr(self, name) for name in ("json", "csv", "xlsx", "drawing", "report")}

    def load(self, file: Path, changes: Changes) -> Mechanism:
        """The description; what cannot be written is refused before the work, not behind it."""
        from dalembert.cli.model_argument import load_model
        from dalembert.cli.solve_command import check_targets

        check_targets(file, self.targets, self.force)
        return load_model(file, changes)

    def deliver(self, m: Mechanism, find: Callable[[], Any], model: Path | None = None, **choice: Any) -> Any:
        """Find, write and print an answer of ``machine``, with a choice of what is printed, and write its mechanism to
        the file ``model``. What is printed comes last: a pipe that closes early takes no file with it."""
        try:
            answer = find()
        except ModelError as error:
            raise error.at_source(m.source) from None
        units: Literal["SI", "file"] = "file" if self.units == "file" else "SI"
        self._save(answer, units)
        if model is not None:
            answer.mechanism.save(model, self.force)
        if str(self.json) == "-":
            answer.to_json(sys.stdout, units=units)
        elif str(self.csv) == "-":
            answer.to_csv(sys.stdout, units=units)
        else:
            print(answer.text("SI" if self.units == "si" else "file", **choice))
        for path in (*self.targets.values(), model):
            if path is not None and str(path) != "-":
                print(f"Written: {path}", file=sys.stderr)
        return answer

    def _save(self, answer: MachineAnswer, units: Literal["SI", "file"]) -> None:
        """Every file that is asked for."""
        for path, write in (
            (self.json, answer.to_json),
            (self.csv, answer.to_csv),
            (self.xlsx, answer.to_xlsx),
        ):
            if path is not None and str(path) != "-":
                write(path, self.force, units)
        if self.drawing is None and self.report is None:
            return
        from dalembert.reports import report
        from dalembert.views import draw

        notation = draw.Notation(units="SI" if self.units == "si" else "file")
        if self.drawing is not None:
            draw.machine(answer, notation).save(self.drawing, self.force, self.theme)
        if self.report is not None:
            report(answer, notation=notation).save(self.report, self.force)


NO_OUTPUTS = Outputs()


@Parameter(name="*")
@dataclass(frozen=True)
class Analysis(Outputs):
    """The analysis that an answer is found from, and what it is written to."""

    static: Static = False
    positions: Positions = None
    changes: Changes = AS_IN_FILE

    def of(self, file: Path) -> Result:
        """The analysis of a file, over a whole turn where it has one position."""
        from dalembert.analysis import solve
        from dalembert.machine.whole_cycle import over_a_turn

        m = self.load(file, self.changes)
        return solve(m, static=self.static, positions=over_a_turn(m, self.positions))

    def answer(self, result: Result, find: Callable[[Result], MachineAnswer]) -> int:
        """Find, write and print what is found from an analysis."""
        self.deliver(result.mechanism, lambda: find(result))
        return 0


AS_ASKED = Analysis()


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
    out: Analysis = AS_ASKED,
) -> int:
    """Shaking force and moment that the machine of FILE exerts on its foundation, with harmonics."""
    import numpy as np

    from dalembert.machine.shaking import shaking

    result = out.of(file)
    m = result.mechanism
    found = out.deliver(m, lambda: shaking(result, _point(m, about), links), orders=orders)
    if np.isfinite(found.force).all():
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
    out: Analysis = AS_ASKED,
) -> int:
    """Flywheel of FILE: energy curve, inertia from Cs, or Cs from inertia, and the exact speed over the cycle."""
    from dalembert.machine.flywheel import flywheels

    result = out.of(file)
    given = number_of(result, inertia, "inertia", "inertia", "flywheel inertia")
    return out.answer(result, lambda r: flywheels.flywheel(r, None, cs, given))


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
        Literal["rms", "max"], with_help("Minimise the rms (default) or the largest value.")
    ] = "rms",
    of: Annotated[
        str,
        with_help(
            "Objective: force (default), moment, torque, or a weighted sum of ratios to the unbalanced values: "
            "force=1,torque=0.5."
        ),
    ] = "force",
    about: Annotated[str | None, target("Point about which moments are taken, as for shake.")] = None,
    output: Annotated[
        Path | None, output_to("Write the model file with the counterweights here: .yaml, .json, .toml.")
    ] = None,
    positions: Positions = None,
    changes: Changes = AS_IN_FILE,
    out: Outputs = NO_OUTPUTS,
) -> int:
    """Optimal counterweights on links of FILE within bounds, with a proof of optimality; rotors in two planes."""
    from dalembert.cli.machine.counterweight_argument import bounds_of, sum_of, two_planes
    from dalembert.machine.balance.balancing import balance as balanced
    from dalembert.machine.balance.rotors import balance_rotor
    from dalembert.saving import check_new

    if output is not None:
        check_new(output, out.force)
    m = out.load(file, changes)
    if planes is not None or radii is not None:
        both = two_planes(m, planes or "", radii or "", on)
        out.deliver(m, lambda: balance_rotor(m, *both), output)
        return 0
    if not on:
        remedy = "write --on crank rocker, or of a rotor --planes 50mm,450mm --radii 40mm"
        raise ModelError("the links for the counterweights are missing", remedy)
    weights = dict(bounds_of(m, text) for text in on)
    out.deliver(m, lambda: balanced(m, weights, least, sum_of(of), _point(m, about), positions), output)
    return 0


BALANCE = """Examples:
  dalembert balance four_bar.yaml --on crank rocker
  dalembert balance four_bar.yaml --on crank:radius=60mm,mass=3kg rocker --least max --of force=1,torque=0.5
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
        Parameter(negative=(), help='Condition to record when it is met: "O2.position = 90 deg".'),
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
    out: Outputs = NO_OUTPUTS,
) -> int:
    """Motion of FILE under forces: motors, loads, springs and friction, with every joint force."""
    from dalembert.machine.motion import simulation

    m, small = out.load(file, changes), tolerance or simulation.TOLERANCE
    found = out.deliver(m, lambda: simulation.simulate(m, until, None, event or (), count, small, steps))
    return {"ended": 0, "interrupted": 130}.get(found.status, 1)


SIMULATE = """Examples:
  dalembert simulate press.yaml --until 2s --drawing speed.svg
  dalembert simulate press.yaml --until 10s "O2.speed = 30 rad/s" --csv motion.csv
  dalembert simulate crane.yaml --until 1s --event "O2.position = 90 deg" --json -"""


COMMANDS = {shake: SHAKE, balance: BALANCE, flywheel: FLYWHEEL, simulate: SIMULATE}
"""Each with its examples."""


def _point(m: Mechanism, about: str | None) -> str | Sequence[float] | None:
    """A vector in the units of the file, or a name."""
    if about is None or not about.lstrip().startswith("["):
        return about
    from dalembert.model.part import Reading
    from dalembert.model.paths import as_in_file
    from dalembert.model.quantities.values import vector

    return vector(as_in_file(about), "length", Reading(m.units.of_texts(), dimension=m.dimension))
