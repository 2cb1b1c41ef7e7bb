"""The commands and their options; each is a few lines that call something else."""

from __future__ import annotations

from cyclopts import App, CycloptsError

from dalembert import __version__

app = App(name="dalembert", version=__version__, help_formatter="plain", help_format="plaintext")


@app.command
def solve(file: str) -> int:
    """Solve FILE."""
    return 0


def command_line_error(error: CycloptsError) -> str:
    """The sentence for a wrong command line."""
    return f"dalembert: {error}"
