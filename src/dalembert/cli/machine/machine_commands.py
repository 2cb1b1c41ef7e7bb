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
    Force,
    ModelFile,
    Positions,
    Static,
    Theme,
    target,
    with_help,
)
from dalembert.cli.options import output as output_to
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis import Result
    from dalembert.machine.output.answer import Answer
    from dalembert.model import Mechanism


@Parameter(name="*")
@dataclass(frozen=True)
class Outputs:
    """What an answer is written to."""

    json: Annotated[
        Path | None, target("Write everything as JSON to this file; - prints it, and nothing else.")
    ] = None
    csv: Annotated[
        Path | None, target("Write a table, one row a position; - prints it, and nothing else.")
    ] = None
    xlsx: Annotated[Path | None, target("Write a workbook: the table, and what is printed.")] = None
    drawing: Annotated[Path | None, with_help("Draw it to this file: .svg, .pdf, .png or .dxf.")] = None
    report: Annotated[
        Path | None, with_help("Write the worked solution to this file: .pdf, .html, .tex or .txt.")
    ] = None
    units: Annotated[
        Literal["si", "file"] | None,
        with_help("Units of what is printed (default: those of the file) and written (default: si)."),
    ] = None
    theme: Theme = "light"
    force: Force = False

    def check(self, file: Path) -> None:
        """Refused before the work, not behind it."""
        from dalembert.cli.solve_command import check_targets

        targets = {name: getattr(self, name) for name in ("json", "csv", "xlsx", "drawing", "report")}
        check_targets(file, targets, self.force)

    def deliver(self, m: Mechanism, find: Callable[[], Any], **choice: Any) -> Any:
        """Find, print and write an answer of ``machine``, with a choice of what is printed."""
        from dalembert.machine.output import written
        from dalembert.saving import new_file

        try:
            answer = find()
        except ModelError as error:
            raise error.at_source(m.source) from None
        units: Literal["SI", "file"] = "file" if self.units == "file" else "SI"
        silent = False
        for path, write in ((self.json, written.write_json), (self.csv, written.write_csv)):
            if str(path) == "-":
                write(answer, sys.stdout, units)
                silent = True
            elif path is not None:
                with (
                    new_file(path, self.force) as new,
                    open(new, "w", encoding="utf-8", newline="") as stream,
                ):
                    write(answer, stream, units)
        if self.xlsx is not None:
            with new_file(self.xlsx, self.force) as new:
                written.write_workbook(answer, new, units)
        if not silent:
            print(answer.text("SI" if self.units == "si" else "file", **choice))
        if self.drawing is not None or self.report is not None:
            self._draw(answer)
        for path in (self.json, self.csv, self.xlsx, self.drawing, self.report):
            if path is not None and str(path) != "-":
                print(f"Written: {path}", file=sys.stderr)
        return answer

    def _draw(self, answer: Answer) -> None:
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
        from dalembert.cli.model_argument import load_model
        from dalembert.machine.whole_cycle import over_a_turn

        self.check(file)
        m = load_model(file, self.changes)
        return solve(m, static=self.static, positions=over_a_turn(m, self.positions))


AS_ASKED = Analysis()


def shake(
    file: ModelFile,
    /,
    *,
    about: Annotated[
        str | None,
        target(
            'Point to take moments about: a joint or point of the ground, or "[x, y]"; default its first joint.'
        ),
    ] = None,
    links: Annotated[
        list[str] | None, Parameter(negative=(), help="Links to count, one or more (default: all).")
    ] = None,
    orders: Annotated[int, Parameter(help="Highest order of the harmonics.")] = 4,
    out: Analysis = AS_ASKED,
) -> int:
    """Shaking force and moment of FILE: what the machine exerts on its foundation, and the harmonics."""
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
        float | None, Parameter(name="--Cs", help="Fluctuation of speed to allow: (greatest - least) / mean.")
    ] = None,
    inertia: Annotated[
        str | None, with_help("Inertia of a flywheel that is there, such as 3.5kg*m^2.")
    ] = None,
    out: Analysis = AS_ASKED,
) -> int:
    """Flywheel of FILE: energy curve, inertia from Cs or back, and the exact speed over the cycle."""
    from dalembert.machine.flywheel import flywheels
    from dalembert.units import file_units, quantity

    result = out.of(file)
    given = None if inertia is None else quantity(inertia, "inertia", file_units(result.mechanism.units))
    out.deliver(result.mechanism, lambda: flywheels.flywheel(result, None, cs, given))
    return 0


FLYWHEEL = """Examples:
  dalembert flywheel engine.yaml --Cs 0.02
  dalembert flywheel press.yaml --inertia 12kg*m^2 --drawing speed.svg --report flywheel.pdf"""


def balance(
    file: ModelFile,
    /,
    *,
    on: Annotated[
        list[str],
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Links that get a counterweight, each with its bounds: crank, or "
            "crank:radius=80mm,mass=2kg,moment=...,place=X/Y,x=FROM/TO,disc=DENSITY/THICKNESS/RADIUS,at=POINT.",
        ),
    ],
    least: Annotated[
        Literal["rms", "max"], with_help("Make the rms value least (default), or the greatest.")
    ] = "rms",
    of: Annotated[
        str,
        with_help(
            "What: force (default), moment, torque, or a sum of parts of what was: force=1,torque=0.5."
        ),
    ] = "force",
    about: Annotated[str | None, target("Point to take moments about, as for shake.")] = None,
    output: Annotated[
        Path | None, output_to("Write the model file with the counterweights here: .yaml, .json, .toml.")
    ] = None,
    positions: Positions = None,
    changes: Changes = AS_IN_FILE,
    out: Outputs = NO_OUTPUTS,
) -> int:
    """Counterweights on links of FILE that leave least shaking, within bounds, proved best."""
    from dalembert.cli.machine.counterweight_argument import bounds_of, sum_of
    from dalembert.cli.model_argument import load_model
    from dalembert.machine.balance.balancing import balance as balanced
    from dalembert.saving import check_new

    out.check(file)
    if output is not None:
        check_new(output, out.force)
    m = load_model(file, changes)
    weights = dict(bounds_of(m, text) for text in on)
    found = out.deliver(m, lambda: balanced(m, weights, least, sum_of(of), _point(m, about), positions))
    if output is not None:
        found.mechanism.save(output, out.force)
        print(f"Written: {output}", file=sys.stderr)
    return 0


BALANCE = """Examples:
  dalembert balance four_bar.yaml --on crank rocker
  dalembert balance four_bar.yaml --on crank:radius=60mm,mass=3kg rocker --least max --of force=1,torque=0.5
  dalembert balance engine.yaml --on crank --output balanced.yaml --drawing balance.svg"""


def simulate(
    file: ModelFile,
    /,
    *,
    until: Annotated[
        list[str],
        Parameter(
            consume_multiple=True,
            negative=(),
            help='When it ends: a time (2s), or a condition ("O2.speed = 0 rad/s"); the first of several.',
        ),
    ],
    event: Annotated[
        list[str] | None,
        Parameter(negative=(), help='Condition to note when it is met: "O2.position = 90 deg".'),
    ] = None,
    count: Annotated[
        int, Parameter(help="Instants in the answer, evenly in time, besides the events.")
    ] = 201,
    tolerance: Annotated[float | None, with_help("Relative error of a step (default: 1e-12).")] = None,
    changes: Changes = AS_IN_FILE,
    out: Outputs = NO_OUTPUTS,
) -> int:
    """Motion of FILE under forces: motors, loads, springs and friction, with every joint force."""
    from dalembert.cli.model_argument import load_model
    from dalembert.machine.motion import simulation

    out.check(file)
    m = load_model(file, changes)
    small = tolerance or simulation.TOLERANCE
    found = out.deliver(m, lambda: simulation.simulate(m, until, None, event or (), count, tolerance=small))
    return 1 if found.ended.startswith("stopped") else 0


SIMULATE = """Examples:
  dalembert simulate press.yaml --until 2s --drawing speed.svg
  dalembert simulate press.yaml --until 10s "O2.speed = 30 rad/s" --csv motion.csv
  dalembert simulate crane.yaml --until 1s --event "O2.position = 90 deg" --json -"""


COMMANDS: dict[Callable[..., int], str] = {
    shake: SHAKE,
    balance: BALANCE,
    flywheel: FLYWHEEL,
    simulate: SIMULATE,
}
"""Each with its examples."""


def _point(m: Mechanism, about: str | None) -> str | Sequence[float] | None:
    """A vector in the units of the file, or a name."""
    if about is None or not about.lstrip().startswith("["):
        return about
    from dalembert.model.part import Reading
    from dalembert.model.paths import as_in_file
    from dalembert.model.quantities.values import vector

    return vector(as_in_file(about), "length", Reading(m.units.of_texts(), dimension=m.dimension))
