"""A file as a command wants it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from pathlib import Path

    from dalembert.cli.options import Changes
    from dalembert.model import Mechanism


def load_model(file: Path, changes: Changes) -> Mechanism:
    """The mechanism of a file, with what the command line says otherwise."""
    from dalembert.model import load
    from dalembert.model.paths import unused_parameters

    m = load(file)
    for name in unused_parameters(m):
        line = f":{m.source.line(('parameters', name))}" if m.source else ""
        print(f"{file}{line}: note: nothing in the file uses the parameter {name!r}", file=sys.stderr)
    m = with_settings(m, changes.set or ())
    return m.with_values({"friction.enabled": False}) if changes.no_friction else m


def with_settings(m: Mechanism, settings: Sequence[str]) -> Mechanism:
    """The mechanism with the values of options `--set NAME=VALUE`; raises ModelError that names the option."""
    values: dict[str, object] = {}
    for said in settings:
        path, equals, value = (part.strip() for part in said.partition("="))
        if not (path and equals and value):
            raise ModelError(f"--set {said} says no value", "write NAME=VALUE, for example --set r=50mm")
        if path in values:
            raise ModelError(f"--set gives {path!r} twice", "leave one of them out")
        values[path] = {"true": True, "false": False}.get(value, value)
    try:
        return m.with_values(values) if values else m
    except ModelError as error:
        raise ModelError(f"--set {' --set '.join(settings)}: {error.what}", error.remedy) from None
