"""The commands and their options; each is a few lines that call something else."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import App, CycloptsError, MissingArgumentError, Parameter

from dalembert import __version__
from dalembert.cli import systems
from dalembert.cli.options import Every, Flag, Output, Target

OK, SOME_NOT_OK = 0, 1

app = App(
    name="dalembert",
    version=__version__,
    help="Force analysis of mechanisms: a model file in, motion, reactions and driving efforts out.",
    help_format="plaintext",
    help_formatter="plain",
    default_parameter=Parameter(show_default=False),
    suppress_keyboard_interrupt=False,
    help_epilogue="""Examples:
  dalembert examples four_bar -o four_bar.yaml
  dalembert solve four_bar.yaml
  dalembert solve four_bar.yaml --positions 72 --csv four_bar.csv
  dalembert solve --help

Exit status: 0 all positions solved; 1 some position is not; 2 the file or the command line is wrong.""",
)


@app.command(
    help_epilogue="""Examples:
  dalembert solve four_bar.yaml
  dalembert solve four_bar.yaml --static --units si
  dalembert solve four_bar.yaml --positions 360 --csv turn.csv --xlsx turn.xlsx
  dalembert solve four_bar.yaml --json - --units file"""
)
def solve(
    file: Path,
    /,
    *,
    static: Flag = False,
    positions: int | None = None,
    json: Target = None,
    csv: Target = None,
    xlsx: Path | None = None,
    netcdf: Path | None = None,
    method: Literal["matrix", "superposition", "virtual-work", "fixed-point"] = "matrix",
    units: Literal["si", "file"] | None = None,
    axes: Literal["ground", "link"] = "ground",
    no_friction: Flag = False,
    every: Every = False,
    force: Flag = False,
) -> int:
    """Solve FILE and print drives, efforts, reactions and motion, in the units of the file.

    Parameters
    ----------
    file
        Model file: YAML, JSON or TOML.
    static
        Leave inertia out, even where the file has speeds.
    positions
        Number of positions over the range of the drives, instead of the file's own count.
    json
        Write the JSON answer to this file; - prints it, and nothing else.
    csv
        Write a table, one row a position; - prints it, and nothing else.
    xlsx
        Write a workbook.
    netcdf
        Write labelled arrays for xarray and other readers of netCDF.
    method
        How the forces are found; fixed-point shows the taught iteration of friction at the first position.
    units
        Units of what is printed (default: those of the file) and written (default: si).
    axes
        Axes of the reactions: ground, or the link they act on.
    no_friction
        Leave friction out.
    every
        Print every position, however many.
    force
        Overwrite files that exist.
    """
    from dalembert.cli.solving import Wanted, solved

    wanted = Wanted(json, csv, xlsx, netcdf, units, axes, every, force)
    return solved(file, wanted, static=static, positions=positions, method=method, friction=not no_friction)


@app.command(
    help_epilogue="""Examples:
  dalembert draw four_bar.yaml -o four_bar.svg
  dalembert draw four_bar.yaml --view force-polygons --at 60deg -o polygons.pdf
  dalembert draw four_bar.yaml --view charts --positions 72 -o charts.png"""
)
def draw(
    file: Path,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"])],
    view: Literal[
        "mechanism", "free-bodies", "force-polygons", "motion", "charts", "superposition", "animation", "all"
    ] = "all",
    at: str | None = None,
    positions: int | None = None,
    static: Flag = False,
    theme: Literal["light", "dark", "print"] = "light",
    names: Flag = False,
    no_friction: Flag = False,
    force: Flag = False,
) -> int:
    """Draw FILE to scale: the mechanism, free bodies, force polygons, charts.

    Parameters
    ----------
    file
        Model file.
    output
        File to write; its ending names the format: .svg, .pdf, .png, .dxf; .gif or .webp for an animation.
    view
        What to draw.
    at
        The position: its number from 1, or a value of the first drive such as 60deg; the first by default.
    positions
        Number of positions over the range of the drives, instead of the file's own count.
    static
        Leave inertia out, even where the file has speeds.
    theme
        Colours for light paper, for a dark screen, or black and white for print.
    names
        Write links by their names, not by number.
    no_friction
        Leave friction out.
    force
        Overwrite a file that exists.
    """
    from dalembert.cli.drawing import drawn

    return drawn(file, output, view, at, positions, static, theme, names, force, not no_friction)


@app.command(
    help_epilogue="""Examples:
  dalembert report four_bar.yaml -o four_bar.pdf
  dalembert report four_bar.yaml -o four_bar.html --method virtual-work --names
  dalembert report engine.yaml -o engine.tex --at 60deg --units si --decimals 2"""
)
def report(
    file: Path,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"])],
    at: str | None = None,
    positions: int | None = None,
    static: Flag = False,
    method: list[Literal["matrix", "graphical", "superposition", "virtual-work"]] | None = None,
    units: Literal["si", "file"] = "file",
    axes: Literal["ground", "link"] = "ground",
    names: Flag = False,
    on_by: Flag = False,
    letter: str = "F",
    figures: int = 4,
    decimals: int | None = None,
    clockwise: Flag = False,
    about: str = "",
    no_friction: Flag = False,
    force: Flag = False,
) -> int:
    """Write the worked solution of FILE, step by step, with its drawings.

    Parameters
    ----------
    file
        Model file.
    output
        File to write; its ending names the format: .pdf, .html, .tex or .txt.
    at
        The position: its number from 1, or a value of the first drive such as 60deg; the first by default.
    positions
        Number of positions over the range of the drives, instead of the file's own count.
    static
        Leave inertia out, even where the file has speeds.
    method
        Methods to show, one or more (default: all).
    units
        Units of the numbers: the file's (default) or si.
    axes
        Axes of components: ground, or the link acted on.
    names
        Write links by their names, not by number.
    on_by
        Write F_ij for the force on i by j; without it, by i on j.
    letter
        Letter of the joint forces: F or G.
    figures
        Significant figures.
    decimals
        Decimals, in place of significant figures.
    clockwise
        Count moments positive clockwise.
    about
        Joint to take moments about, where a link has it.
    no_friction
        Leave friction out.
    force
        Overwrite a file that exists.
    """
    from dalembert.cli.drawing import reported
    from dalembert.views.notation import Notation

    notation = Notation(
        links="name" if names else "number",
        order="on-by" if on_by else "by-on",
        letter=letter,
        units="SI" if units == "si" else "file",
        figures=figures,
        decimals=decimals,
        torque=-1 if clockwise else 1,
        axes=axes,
    )
    return reported(file, output, at, positions, static, method, notation, about, force, not no_friction)


@app.command(
    help_epilogue="""Examples:
  dalembert check four_bar.yaml
  dalembert check problems/ --all"""
)
def check(*files: Path, every: Every = False, no_friction: Flag = False) -> int:
    """Compare the answers that stand in model files with what is computed.

    Parameters
    ----------
    files
        Model files, or folders of them.
    every
        Print every answer of many files, not only one line a file and what disagrees.
    no_friction
        Leave friction out.
    """
    from dalembert.cli.checking import checked

    return checked(files, every=every, friction=not no_friction)


@app.command(
    name="check-answers",
    help_epilogue="""Examples:
  dalembert check-answers four_bar.yaml mine.yaml
  dalembert check-answers four_bar.yaml --interactive

The file of answers: {efforts: {O2: 243 lbf*in}, reactions: {A: 155 @ 220 deg}}, or a list as in a model file.""",
)
def check_answers(
    file: Path,
    answers: Path | None = None,
    /,
    *,
    interactive: Flag = False,
    static: Flag = False,
    no_friction: Flag = False,
) -> int:
    """Compare your own figures with what is computed, and name the mistake that explains a difference.

    Parameters
    ----------
    file
        Model file.
    answers
        File of your figures.
    interactive
        Ask for them one by one.
    static
        Leave inertia out, even where the file has speeds.
    """
    from dalembert.cli.grading import graded

    return graded(file, answers, interactive, static, not no_friction)


@app.command(help_epilogue="Examples:\n  dalembert validate\n  dalembert validate > qualification.txt")
def validate() -> int:
    """Qualify this installation: solve every bundled published problem and compare all answers."""
    from dalembert.cli.checking import validated

    return validated()


@app.command(help_epilogue="Examples:\n  dalembert schema > dalembert.schema.json")
def schema(*, output: Output = None, force: Flag = False) -> int:
    """Print the JSON schema of the model file, for editors that complete and check.

    Parameters
    ----------
    output
        Write it to this file.
    force
        Overwrite a file that exists.
    """
    from dalembert.cli.describing import schema_text

    return emitted(schema_text(), output, force)


@app.command(
    help_epilogue="""Examples:
  dalembert new
  dalembert new slider_crank -o engine.yaml"""
)
def new(template: str = "", /, *, output: Output = None, force: Flag = False) -> int:
    """Begin a model file from a template; without a name, list the templates.

    Parameters
    ----------
    template
        Name of the template.
    output
        Write it to this file; without it, it is printed.
    force
        Overwrite a file that exists.
    """
    from dalembert.cli.describing import template_file, template_list

    return emitted(template_file(template) if template else template_list(), output, force)


@app.command(help_epilogue="Examples:\n  dalembert convert four_bar.yaml -o four_bar.json")
def convert(
    file: Path, /, *, output: Annotated[Path, Parameter(name=["--output", "-o"])], force: Flag = False
) -> int:
    """Write a model file in another format: .yaml, .json or .toml.

    Parameters
    ----------
    file
        Model file.
    output
        File to write; its ending names the format.
    force
        Overwrite a file that exists.
    """
    from dalembert.cli.describing import converted

    return converted(file, output, force)


@app.command(
    help_epilogue="""Examples:
  dalembert examples
  dalembert examples four_bar -o four_bar.yaml"""
)
def examples(name: str = "", /, *, output: Output = None, force: Flag = False) -> int:
    """Bundled problems: list them, print one, or copy one to a file.

    Parameters
    ----------
    name
        Name of the example; without one, they are listed.
    output
        Write it to this file; without it, it is printed.
    force
        Overwrite a file that exists.
    """
    from dalembert.cli.describing import example_list, example_text

    return emitted(example_text(name) if name else example_list(), output, force)


app.command(systems.wrench, help_epilogue=systems.EXAMPLES)


def emitted(text: str, output: Path | None, force: bool) -> int:
    """Text to a new file, or printed."""
    from dalembert.saving import new_file

    if output is None or str(output) == "-":
        print(text.rstrip("\n"))
        return OK
    with new_file(output, force) as temporary:
        temporary.write_text(text, encoding="utf-8")
    print(f"Written: {output}")
    return OK


def command_line_error(error: CycloptsError, arguments: list[str]) -> str:
    """The sentence for a wrong command line, and where to read more."""
    asked: Any = arguments[0] if arguments else ""
    missing = isinstance(error, MissingArgumentError) and re.search(r"parameter (\S+) requires", str(error))
    said = f"{asked} needs {missing[1]}" if missing else str(error).strip().removesuffix(", ...").rstrip(".")
    command = f" {asked}" if asked in app and not asked.startswith("-") else ""
    return f"dalembert: {said[:1].lower() + said[1:]}; see `dalembert{command} --help`"
