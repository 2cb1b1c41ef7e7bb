"""The command `dalembert`: arguments in, text and an exit status out; all work is done by the packages below."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

OK, SOME_NOT_OK, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0, 1, 2, or 130 when interrupted.

    >>> main(["--version"])
    0.1.0
    0
    """
    try:
        status = _run(list(sys.argv[1:] if arguments is None else arguments))
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # nobody reads: let exit flush in peace
        return OK


def _run(arguments: list[str]) -> int:
    from dalembert.cli.app import app, command_line_error
    from dalembert.errors import DalembertError

    try:
        from cyclopts import CycloptsError

        try:
            status = app(arguments, exit_on_error=False, print_error=False, result_action="return_value")
        except CycloptsError as error:
            print(command_line_error(error), file=sys.stderr)
            return WRONG_INPUT
    except DalembertError as error:
        print(error, file=sys.stderr)
        return WRONG_INPUT
    return int(status or OK)
