"""The command `dalembert`: arguments in, text and an exit status out; the packages below do the work.

In: a command line. Out: text, files, an exit status. Imports everything but ``core`` and ``kernel``.
"""

from __future__ import annotations

import gc
import io
import os
import sys
import warnings

from dalembert import __version__

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

NAMED = dict.fromkeys(("--json", "--csv", "--xlsx", "--netcdf"), "-")
NAMED |= dict.fromkeys(("--output", "-o"), "/dev/stdout")
"""Option with a value -> what it is given for the value -; a - by itself is standard input."""
NO_ANSWER, WRONG_INPUT, INTERRUPTED = 1, 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0, 1, 2, or 130 when interrupted.

    >>> main(["--version"])
    0.1.0
    0
    """
    if arguments is None:
        _spare_the_collector()
        _write_any_text()
        arguments = sys.argv[1:]
    try:
        status = _run(list(arguments))
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return _interrupted()
    except BrokenPipeError:
        _let_go()
        return 0
    except RuntimeError as error:  # an interrupt while a class is made is the cause of another error
        if not isinstance(error.__cause__, KeyboardInterrupt):
            raise
        return _interrupted()
    except OSError as error:
        _let_go()
        print(f"standard output: {(error.strerror or str(error)).lower()}", file=sys.stderr)
        return WRONG_INPUT


def _interrupted() -> int:
    """The exit status; Python would end by the signal instead if it came within `exec`, by which dataclasses are made,
    unless another one has ended well since."""
    exec("")
    return INTERRUPTED


def _let_go() -> None:
    """Let the last flush of an output that takes no more go nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def _write_any_text() -> None:
    """Pipes and files take UTF-8, as from Python 3.15 on; an encoding that somebody asked for writes what it lacks as
    \\u03b1."""
    for stream in (sys.stdout, sys.stderr):
        if not isinstance(stream, io.TextIOWrapper):
            continue
        if "PYTHONIOENCODING" in os.environ or stream.isatty():
            stream.reconfigure(errors="backslashreplace")
        else:
            stream.reconfigure(encoding="utf-8")


def _spare_the_collector() -> None:
    """Exempts imported objects, which live until the command ends, from garbage collection, which would take a fifth of
    its time."""
    import atexit

    gc.set_threshold(200_000)
    atexit.register(gc.freeze)


def _run(arguments: list[str]) -> int:
    if arguments == ["--version"]:  # before the parser is imported, which takes longer than all the rest
        print(__version__)
        return 0
    from cyclopts import CycloptsError

    from dalembert.cli.app import command_line, command_line_error, overview
    from dalembert.errors import AnalysisError, DalembertError
    from dalembert.saving import DATA_FOLDER

    arguments, folder = _data_folder(arguments)
    first = arguments[0] if arguments else "--help"
    if first in ("--help", "-h"):
        print(overview())
        return 0
    token = DATA_FOLDER.set(folder)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _note
            status = command_line(first)(
                _name_streams(arguments), exit_on_error=False, print_error=False, result_action="return_value"
            )
    except CycloptsError as error:
        return _refuse(command_line_error(error, arguments))
    except AnalysisError as error:
        _refuse(str(error))
        return NO_ANSWER
    except DalembertError as error:
        return _refuse(str(error))
    except BrokenPipeError:
        raise
    except OSError as error:
        if error.filename is None:  # of a stream that is open: standard output
            raise
        return _refuse(f"{error.filename}: {(error.strerror or str(error)).lower()}")
    finally:
        DATA_FOLDER.reset(token)
    return int(status or 0)


def _note(message: Warning | str, *where: object, **more: object) -> None:
    """A warning as a line, as of what a file of another program says that is not kept."""
    print(f"note: {message}", file=sys.stderr)


def _data_folder(arguments: list[str]) -> tuple[list[str], str]:
    """The arguments without `--data FOLDER`, which every command takes, and the folder."""
    for k, argument in enumerate(arguments):
        option, sign, value = argument.partition("=")
        if option == "--data" and (sign or arguments[k + 1 :]):
            rest = arguments[k + 1 :] if sign else arguments[k + 2 :]
            return [*arguments[:k], *rest], value or arguments[k + 1]
    return arguments, ""


def _name_streams(arguments: list[str]) -> list[str]:
    """The arguments with a name for standard input and output: the parser would take a lone - for an option."""
    named = []
    for previous, argument in zip(["", *arguments], arguments, strict=False):
        option, _, value = argument.partition("=")
        if argument == "-":
            named.append(NAMED.get(previous, "/dev/stdin"))
        else:
            named.append(f"{option}={NAMED[option]}" if value == "-" and option in NAMED else argument)
    return named


def _refuse(sentence: str) -> int:
    sys.stdout.flush()
    print(sentence, file=sys.stderr)
    return WRONG_INPUT
