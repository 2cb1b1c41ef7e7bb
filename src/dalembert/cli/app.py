"""The commands and their options; each is a few lines that call something else."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import (
    App,
    CycloptsError,
    MissingArgumentError,
    Parameter,
    UnknownCommandError,
    UnusedCliTokensError,
)

from dalembert import __version__
from dalembert.cli import answers_commands, page_command, variants_command, wrench_command
from dalembert.cli.machine import machine_commands, member_commands
from dalembert.cli.options import (
    AS_IN_FILE,
    AS_USUAL,
    At,
    Changes,
    Force,
    ModelFile,
    Names,
    NewFile,
    Positions,
    ReactionAxes,
    Seen,
    Set,
    Static,
    Style,
    Theme,
    flag,
    output,
    target,
    with_help,
)
from dalembert.cli.studies import optimize_command, study_commands
from dalembert.progress import progress
from dalembert.wording import closest


class HelpLayout:
    """The layout of --help, imported where help is printed: cyclopts' part of it takes as long as reading a model."""

    def __call__(self, console: Any, options: Any, panel: Any) -> None:
        self.__getattr__("__call__")(console, options, panel)

    def __getattr__(self, name: str) -> Any:
        from dalembert.cli.help_layout import Hanging

        return getattr(Hanging(), name)


app = App(
    name="dalembert",
    version=__version__,
    help="Force analysis of mechanisms: a model file in, motion, reactions and driving efforts out.",
    help_format="plaintext",
    help_formatter=HelpLayout(),
    default_parameter=Parameter(show_default=False),
    suppress_keyboard_interrupt=False,
    help_epilogue="""Examples:
  dalembert examples four_bar -o four_bar.yaml
  dalembert solve four_bar.yaml
  dalembert solve four_bar.yaml --positions 72 --csv four_bar.csv
  dalembert solve --help

With --data FOLDER, tables of any command's FILE may be read from there too, not only beside it.

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
    file: ModelFile,
    /,
    *,
    static: Static = False,
    positions: Positions = None,
    json: Annotated[
        Path | None, target("Write the JSON answer to this file; - prints it, and nothing else.")
    ] = None,
    csv: Annotated[
        Path | None, target("Write a table, one row a position; - prints it, and nothing else.")
    ] = None,
    xlsx: Annotated[Path | None, target("Write a workbook.")] = None,
    netcdf: Annotated[
        Path | None, target("Write labelled arrays for xarray and other readers of netCDF.")
    ] = None,
    method: Annotated[
        Literal["matrix", "superposition", "virtual-work", "fixed-point"],
        with_help(
            "How the forces are found; fixed-point shows the taught iteration of friction at the first position."
        ),
    ] = "matrix",
    units: Annotated[
        Literal["si", "file"] | None,
        with_help("Units of what is printed (default: those of the file) and written (default: si)."),
    ] = None,
    axes: Annotated[
        ReactionAxes,
        with_help("Axes of the reactions: ground, the link they act on, in space the joint's own."),
    ] = "ground",
    changes: Changes = AS_IN_FILE,
    other_solutions: Annotated[
        bool,
        flag(
            "Seek the other solutions of friction's equations, where the physical one may not be the only one."
        ),
    ] = False,
    every: Annotated[bool, flag("Print every position, however many.", "--all")] = False,
    force: Force = False,
) -> int:
    """Solve FILE and print drives, efforts, reactions and motion, in the units of the file."""
    from dalembert.cli.solve_command import Wanted, solve_file

    wanted = Wanted(json, csv, xlsx, netcdf, units, axes, every, force, other_solutions)
    return solve_file(file, wanted, static=static, positions=positions, method=method, changes=changes)


@app.command(
    help_epilogue="""Examples:
  dalembert draw four_bar.yaml -o four_bar.svg
  dalembert draw four_bar.yaml --view force-polygons --at 60deg -o polygons.pdf
  dalembert draw four_bar.yaml --view charts --positions 72 -o charts.png
  dalembert draw four_bar.yaml --question -o question.svg"""
)
def draw(
    file: ModelFile,
    /,
    *,
    output: Annotated[
        Path,
        output(
            "File to write; its ending names the format: .svg, .pdf, .png, .dxf; .gif or .webp for an animation; "
            ".glb for a model in motion for 3-D viewers."
        ),
    ],
    view: Annotated[
        Literal[
            "mechanism",
            "free-bodies",
            "force-polygons",
            "motion",
            "friction",
            "teeth",
            "charts",
            "superposition",
            "animation",
            "all",
        ]
        | None,
        with_help(
            "What to draw; motion: velocity and acceleration polygons and instant centres; friction: circles, pins and "
            "guides; teeth: gears in mesh; charts: over a cycle; superposition: one load at a time; all: mechanism, "
            "free bodies, force polygons, charts (default: as many of these as one page holds)."
        ),
    ] = None,
    at: At = None,
    positions: Positions = None,
    static: Static = False,
    theme: Theme = "light",
    paper: Annotated[
        Literal["a4", "letter", "fit"] | None,
        with_help("Pages of a .pdf: a4 (default), letter, or fit: one as large as the drawing."),
    ] = None,
    camera: Seen = None,
    names: Names = False,
    question: Annotated[
        bool, flag("The mechanism with what is given alone: no efforts, no reactions, nothing computed.")
    ] = False,
    changes: Changes = AS_IN_FILE,
    force: Force = False,
) -> int:
    """Draw FILE to scale: the mechanism, free bodies, force polygons, charts."""
    from dalembert.cli.draw_command import draw_file, question_view

    which = question_view(view) if question else view
    with progress(f"Drawing {file}"):
        return draw_file(
            file, output, which, at, positions, static, theme, names, force, changes, camera, paper
        )


@app.command(
    help_epilogue="""Examples:
  dalembert report four_bar.yaml -o four_bar.pdf
  dalembert report four_bar.yaml -o four_bar.html --method virtual-work --names
  dalembert report rssr.yaml -o rssr.pdf --at 30deg
  dalembert report engine.yaml -o engine.tex --at 60deg --units si --decimals 2"""
)
def report(
    file: ModelFile,
    /,
    *,
    output: Annotated[Path, output("File to write; its ending names the format: .pdf, .html, .tex or .txt.")],
    at: At = None,
    positions: Positions = None,
    static: Static = False,
    method: Annotated[
        list[Literal["matrix", "graphical", "superposition", "virtual-work"]] | None,
        Parameter(
            negative=(), help="Methods to show, one or more (default: all); graphical is for the plane."
        ),
    ] = None,
    style: Style = AS_USUAL,
    about: Annotated[str, with_help("Joint to take moments about, where a link has it.")] = "",
    changes: Changes = AS_IN_FILE,
    force: Force = False,
) -> int:
    """Write the worked solution of FILE, step by step, with its drawings."""
    from dalembert.cli.draw_command import write_report

    with progress(f"Working out {file}"):
        return write_report(
            file, output, at, positions, static, method, style.notation(), about, force, changes
        )


@app.command(
    help_epilogue="""Examples:
  dalembert check four_bar.yaml
  dalembert check problems/ --all"""
)
def check(
    *files: Annotated[Path, with_help("Model files, or folders of them.")],
    every: Annotated[
        bool,
        flag("Print every answer of many files, not only one line a file and what disagrees.", "--all"),
    ] = False,
    changes: Changes = AS_IN_FILE,
) -> int:
    """Compare the answers that stand in model files with what is computed."""
    from dalembert.cli.check_command import check_files

    return check_files(files, every=every, changes=changes)


@app.command(
    name="check-answers",
    help_epilogue="""Examples:
  dalembert check-answers four_bar.yaml mine.yaml
  dalembert check-answers four_bar.yaml --interactive

The file of answers, or a list as in a model file:
  efforts: {O2: 243 lbf*in}
  reactions: {A: 155 @ 220 deg}
  tolerance: 3 %""",
)
def check_answers(
    file: ModelFile,
    answers: Annotated[Path | None, with_help("File of your figures.")] = None,
    /,
    *,
    interactive: Annotated[bool, flag("Ask for them one by one.")] = False,
    tolerance: Annotated[
        str | None,
        with_help(
            "Of figures that state none, as 3% for graphical work (default: 0.5 %, or the digits written)."
        ),
    ] = None,
    static: Static = False,
    changes: Changes = AS_IN_FILE,
) -> int:
    """Compare your own figures with what is computed, and name the mistakes that explain the differences."""
    return answers_commands.check_sheet(file, answers, interactive, static, changes, tolerance)


@app.command(help_epilogue="Examples:\n  dalembert validate\n  dalembert validate > qualification.txt")
def validate() -> int:
    """Qualify this installation: solve every bundled published problem and compare all answers."""
    from dalembert.cli.check_command import validate_cases

    return validate_cases()


@app.command(help_epilogue="Examples:\n  dalembert schema > dalembert.schema.json")
def schema(*, output: NewFile = None, force: Force = False) -> int:
    """Print the JSON schema of the model file, for editors that complete and check."""
    from dalembert.cli.describe_commands import schema_text, write_or_print

    return write_or_print(schema_text(), output, force)


@app.command(
    help_epilogue="""Examples:
  dalembert new
  dalembert new slider_crank -o engine.yaml"""
)
def new(
    template: Annotated[str, with_help("Name of the template.")] = "",
    /,
    *,
    output: NewFile = None,
    force: Force = False,
) -> int:
    """Begin a model file from a template; without a name, list the templates."""
    from dalembert.cli.describe_commands import start_file

    return start_file(template, output, force)


@app.command(help_epilogue="Examples:\n  dalembert convert four_bar.yaml -o four_bar.json")
def convert(
    file: ModelFile,
    /,
    *,
    output: Annotated[Path, output("File to write; its ending names the format.")],
    set: Set = None,  # noqa: A002
    force: Force = False,
) -> int:
    """Write a model file in another format: .yaml, .json or .toml."""
    from dalembert.cli.describe_commands import convert_file

    return convert_file(file, output, set or [], force)


@app.command(
    help_epilogue="""Examples:
  dalembert examples
  dalembert examples four_bar -o four_bar.yaml"""
)
def examples(
    name: Annotated[str, with_help("Name of the example; without one, they are listed.")] = "",
    /,
    *,
    output: NewFile = None,
    force: Force = False,
) -> int:
    """Bundled problems: list them, print one, or copy one to a file."""
    from dalembert.cli.describe_commands import example_copied

    return example_copied(name, output, force)


@app.command(
    help_epilogue="""Examples:
  dalembert joints
  dalembert joints -o joints.svg
  dalembert joints -o pictures"""
)
def joints(
    *,
    output: Annotated[
        Path | None,
        output("Draw them: all in one .svg, .pdf, .png or .dxf; without an ending, each in a folder."),
    ] = None,
    camera: Seen = None,
    theme: Theme = "light",
    force: Force = False,
) -> int:
    """Print the joints in space: what each leaves free, its own axes, and the reactions it carries along them."""
    from dalembert.cli.describe_commands import joints_shown

    return joints_shown(output, camera, theme, force)


app.command(wrench_command.wrench, help_epilogue=wrench_command.EXAMPLES)
app.command(answers_commands.grade, help_epilogue=answers_commands.GRADE)
app.command(variants_command.variants, help_epilogue=variants_command.EXAMPLES)
app.command(page_command.page, help_epilogue=page_command.EXAMPLES)
for computes, its_examples in (machine_commands.COMMANDS | member_commands.COMMANDS).items():
    app.command(computes, help_epilogue=its_examples)
app.command(study_commands.study)
app.command(optimize_command.optimize, help_epilogue=optimize_command.OPTIMIZE)


def command_line_error(error: CycloptsError, arguments: list[str]) -> str:
    """The sentence for a wrong command line, and where to read more."""
    asked = arguments[0] if arguments else ""
    command = f" {asked}" if asked in _commands() else ""
    return f"dalembert: {_report_error(error, asked)}; see `dalembert{command} --help`"


def _commands() -> list[str]:
    return [name for name in app if not name.startswith("-")]


def _report_error(error: CycloptsError, asked: str) -> str:
    if isinstance(error, UnknownCommandError):
        return f"there is no command {asked!r}; {closest(asked, _commands())}"
    if isinstance(error, UnusedCliTokensError):
        return f"{' '.join(error.unused_tokens or ())!r} is one too many; what has spaces stands in quotes"
    missing = isinstance(error, MissingArgumentError) and re.search(r"parameter (\S+) requires", str(error))
    sentence = f"{asked} needs {missing[1]}" if missing else str(error).strip().rstrip(".")
    return sentence[:1].lower() + sentence[1:]
