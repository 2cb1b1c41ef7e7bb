"""The table of the commands, the overview, and the messages for a wrong command line.

A command's room is imported when it is called, and so is the part of cyclopts that prints help, which takes longer
than reading a model: the overview is printed here.
"""

from __future__ import annotations

import re
import shutil
import textwrap
from collections.abc import Iterable
from importlib import import_module
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
from dalembert.wording import closest

HELP = "Force analysis of mechanisms: a model file in, motion, reactions and driving efforts out."
EPILOGUE = """Examples:
  dalembert examples four_bar -o four_bar.yaml
  dalembert solve four_bar.yaml
  dalembert solve four_bar.yaml --positions 72 --csv four_bar.csv
  dalembert solve --help
  dalembert --version

With --data FOLDER, any command also accepts tables of FILE in FOLDER, not only in the folder of FILE.

Exit status: 0 all positions solved; 1 some positions are not; 2 the file or the command line is wrong."""

GROUPS: dict[str, dict[str, tuple[str, ...]]] = {
    "Solve and show": {
        "solve_command": ("solve",),
        "documents.draw_command": ("draw",),
        "documents.report_command": ("report",),
        "documents.page_command": ("page",),
        "documents.studio_command": ("studio",),
        "wrench_command": ("wrench",),
    },
    "Create and check model files": {
        "describe_commands": ("new", "examples", "convert", "schema", "joints"),
        "check_command": ("check", "validate"),
    },
    "Machine design": {
        "machine.machine_commands": ("simulate", "shake", "balance", "flywheel"),
        "machine.member_commands": ("members", "pins", "bearings", "shaft", "motor"),
        "machine.element_commands": ("cam",),
    },
    "Many designs": {
        "studies.study_commands": ("study",),
        "studies.optimize_command": ("optimize",),
    },
    "Teach": {
        "variants_command": ("variants",),
        "answers_commands": ("check-answers", "grade"),
    },
    "This installation": {
        "installation.doctor_command": ("doctor",),
        "installation.completion_command": ("completion",),
    },
}
"""Heading in the help -> module of `dalembert.cli` -> its commands; the module's `COMMANDS` has their functions."""
FIELD_WORDS = {
    "shake": "shaking harmonics vibration foundation",
    "balance": "counterweight counterweights rotor",
    "members": "stress stresses bending buckling fatigue",
    "bearings": "pins life pv",
    "motor": "gear torque",
    "cam": "cams follower valve",
    "simulate": "motion run",
    "solve": "analyse analyze statics kinematics dynamics forces",
    "studio": "sketch editor mouse gui",
    "draw": "plot chart charts picture",
    "new": "template templates",
    "doctor": "install installation extras packages diagnose",
}
"""Command -> words of the field that its name does not resemble."""
MODULES = {name: module for modules in GROUPS.values() for module, names in modules.items() for name in names}
"""Command -> module."""


class HelpLayout:
    """The layout of a command's --help, imported where it is printed."""

    def __call__(self, console: Any, options: Any, panel: Any) -> None:
        self.__getattr__("__call__")(console, options, panel)

    def __getattr__(self, name: str) -> Any:
        from dalembert.cli.help_layout import Hanging

        return getattr(Hanging(), name)


def command_line(first: str) -> App:
    """The parser of a command line that begins with the word `first`: of that command, or of all."""
    app = App(
        name="dalembert",
        version=__version__,
        help_format="plaintext",
        help_formatter=HelpLayout(),
        default_parameter=Parameter(show_default=False),
        suppress_keyboard_interrupt=False,
    )
    for name in [first] if first in MODULES else MODULES:
        module, command = _command(name)
        if isinstance(command, App):
            app.command(command)
        else:
            app.command(command, help_epilogue=module.COMMANDS[command])
    return app


def _command(name: str) -> tuple[Any, Any]:
    """A command's module, and its function, or its App with subcommands."""
    module = import_module(f"dalembert.cli.{MODULES[name]}")
    return module, getattr(module, name.replace("-", "_"))


def overview() -> str:
    """Text of `dalembert --help`: every command with the first sentence of its help."""
    width = min(shutil.get_terminal_size().columns, 100)
    text = ["Usage: dalembert COMMAND", "", *_paragraphs([HELP], width)]
    for heading, modules in GROUPS.items():
        text += ["", f"{heading}:"]
        for name in (name for names in modules.values() for name in names):
            _, command = _command(name)
            sentence = (
                command.help if isinstance(command, App) else (command.__doc__ or "").partition("\n\n")[0]
            )
            text += textwrap.wrap(
                f"{name}: {' '.join(sentence.split())}",
                width,
                initial_indent="  ",
                subsequent_indent="      ",
                break_on_hyphens=False,
            )
    return "\n".join([*text, "", *_paragraphs(EPILOGUE.splitlines(), width)])


def _paragraphs(lines: Iterable[str], width: int) -> list[str]:
    return [part for line in lines for part in textwrap.wrap(line, width) or [""]]


def command_line_error(error: CycloptsError, arguments: list[str]) -> str:
    """The sentence for a wrong command line, and where to read more."""
    first = arguments[0] if arguments else ""
    command = f" {first}" if first in MODULES else ""
    what = _report_error(error, first)
    return f"dalembert: {what}{' See' if what.endswith('?') else '; see'} `dalembert{command} --help`"


def _report_error(error: CycloptsError, first: str) -> str:
    if isinstance(error, UnknownCommandError):
        if first in MODULES:  # the command exists, its subcommand does not
            return f"{first} has no such subcommand"
        meant = next((name for name, words in FIELD_WORDS.items() if first.lower() in words.split()), first)
        return f"unknown command {first!r}; {closest(meant, list(MODULES))}"
    if isinstance(error, UnusedCliTokensError):
        return (
            f"{' '.join(error.unused_tokens or ())!r} is an unexpected argument; quote arguments with spaces"
        )
    missing = isinstance(error, MissingArgumentError) and re.search(r"parameter (\S+) requires", str(error))
    sentence = f"{first} needs {missing[1]}" if missing else str(error).strip().rstrip(".")
    return sentence[:1].lower() + sentence[1:]
