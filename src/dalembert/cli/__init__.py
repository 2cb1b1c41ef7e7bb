"""The command `dalembert`: arguments in, text and an exit status out; the packages below do the work."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

NO_ANSWER, WRONG_INPUT, INTERRUPTED = 1, 2, 130


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
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # nobody reads any more: let the last flush go nowhere
        return 0


def _run(arguments: list[str]) -> int:
    from cyclopts import CycloptsError

    from dalembert.cli.app import app, command_line_error
    from dalembert.errors import AnalysisError, DalembertError

    try:
        status = app(arguments, exit_on_error=False, print_error=False, result_action="return_value")
    except CycloptsError as error:
        return _refused(command_line_error(error, arguments))
    except AnalysisError as error:
        _refused(str(error))
        return NO_ANSWER
    except DalembertError as error:
        return _refused(str(error))
    except BrokenPipeError:
        raise
    except OSError as error:
        return _refused(f"{error.filename}: {(error.strerror or str(error)).lower()}")
    return int(status or 0)


def _refused(sentence: str) -> int:
    sys.stdout.flush()
    print(sentence, file=sys.stderr)
    return WRONG_INPUT
