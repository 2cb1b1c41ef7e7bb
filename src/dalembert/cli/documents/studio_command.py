"""`dalembert studio`: a mechanism drawn with the mouse in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dalembert.cli.options import flag, with_help
from dalembert.saving import check_installed

EXAMPLES = """Examples:
  dalembert studio
  dalembert studio four_bar.yaml
  dalembert studio four_bar.yaml --no-browser --port 8080"""


def studio(
    file: Annotated[
        Path | None, with_help("Model file, existing or new (default: a new mechanism.yaml).")
    ] = None,
    /,
    *,
    port: Annotated[int, with_help("Port of the server (default: any free one).")] = 0,
    no_browser: Annotated[bool, flag("Print the address and open no browser.")] = False,
) -> int:
    """Draw a mechanism with the mouse, and see its forces: opens FILE in a browser, on this machine only."""
    check_installed("starlette", "the studio", "studio")
    check_installed("uvicorn", "the studio", "studio")
    check_installed("websockets", "the studio", "studio")
    from dalembert.studio.launch import run

    run(file, port, not no_browser)
    return 0


COMMANDS = {studio: EXAMPLES}
"""Function of the command -> the examples under its help."""
