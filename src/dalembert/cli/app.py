"""The table of the commands, and what is said where a command line is wrong."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from cyclopts import (
    App,
    CycloptsError,
    MissingArgumentError,
    Parameter,
    UnknownCommandError,
    UnusedCliTokensError,
)

from dalembert import __version__
from dalembert.cli import (
    answers_commands,
    check_command,
    describe_commands,
    draw_command,
    page_command,
    solve_command,
    variants_command,
    wrench_command,
)
from dalembert.cli.machine import machine_commands, member_commands
from dalembert.cli.studies import optimize_command, study_commands
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


COMMANDS: dict[Callable[..., int], str] = {
    solve_command.solve: solve_command.EXAMPLES,
    **draw_command.COMMANDS,
    **check_command.COMMANDS,
    **answers_commands.COMMANDS,
    **describe_commands.COMMANDS,
    wrench_command.wrench: wrench_command.EXAMPLES,
    variants_command.variants: variants_command.EXAMPLES,
    page_command.page: page_command.EXAMPLES,
    **machine_commands.COMMANDS,
    **member_commands.COMMANDS,
    optimize_command.optimize: optimize_command.OPTIMIZE,
}
"""Function of each command -> the examples under its help; its name is the function's."""

for command, its_examples in COMMANDS.items():
    app.command(command, help_epilogue=its_examples)
app.command(study_commands.study)


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
