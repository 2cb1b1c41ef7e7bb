"""`dalembert doctor`: what is installed, what is missing and how to get it, and whether it works."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import gettempdir

from dalembert.cli.check_command import installation
from dalembert.cli.installation.installed_packages import EXTRAS, PackageState, packages
from dalembert.cli.installation.self_test import outcomes

NOT_INSTALLED = "dalembert runs from its sources and is not installed, so its packages cannot be listed."


def doctor() -> int:
    """Report what is installed, which extras are missing and how to get them, and run a one-second self-test."""
    print(installation())
    print("\n".join(["", *(f"{what}: {where}" for what, where in folders().items())]))
    states = packages()
    old = [state for state in states if state.is_too_old or not (state.installed or state.extra)]
    print("\n" + (extras_text(states) if states else NOT_INSTALLED))
    if remedies := list(missing_extras(states)):
        print("\nMissing extras are optional. To get one:", *remedies, sep="\n  ")
    print()
    wrong = False
    for name, problem in outcomes():
        print(f"{'FAILED' if problem else 'ok'}: {name}{f': {problem}' if problem else ''}", flush=True)
        wrong |= bool(problem)
    for state in old:
        found = f"{state.installed} is too old" if state.installed else "is missing"
        print(f"FAILED: {state.name} {found}; pip install '{state.name}>={state.lowest}'")
    good = not (wrong or old)
    print(f"\n{'This installation works' if good else 'This installation has faults'}; ", end="")
    print("`dalembert validate` compares it with every bundled published problem.")
    return 0 if good else 1


def folders() -> dict[str, str]:
    """Folders that dalembert uses. Compiled programs are kept in memory, so it has no folder for them."""
    import dalembert
    from dalembert.bundled import folder

    temporary = Path(gettempdir())
    state = "" if os.access(temporary, os.W_OK) else " (cannot be written)"
    return {
        "Python": sys.executable,
        "Program": str(Path(dalembert.__file__).parent),
        "Bundled problems": str(folder("cases")),
        "Temporary files": f"{temporary}{state}",
        "Compiled programs": "in memory only; nothing is cached on disk",
    }


def extras_text(states: list[PackageState]) -> str:
    """Two lines for each extra: its state with its purpose, and its packages with their versions."""
    lines = []
    for extra, purpose in EXTRAS.items():
        needed = [state for state in states if state.extra == extra]
        if not needed:
            continue
        complete = all(state.installed and not state.is_too_old for state in needed)
        lines.append(f"{extra or 'core':<10}{'complete' if complete else 'MISSING':<10}{purpose}")
        lines.append(20 * " " + ", ".join(f"{s.name} {s.installed or 'missing'}" for s in needed))
    return "\n".join(lines)


def missing_extras(states: list[PackageState]) -> Iterator[str]:
    """The command that installs each extra of which a package is missing or too old."""
    for extra in filter(None, EXTRAS):
        if any(s.extra == extra and (s.is_too_old or not s.installed) for s in states):
            yield f"pip install 'dalembert[{extra}]'"


COMMANDS = {doctor: "Examples:\n  dalembert doctor\n  dalembert doctor > installation.txt"}
"""Function of the command -> the examples under its help."""
