"""A file as a command wants it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from dalembert.model import Mechanism


def load_model(file: Path, friction: bool) -> Mechanism:
    """The mechanism of a file, with its friction or without."""
    from dalembert.model import load

    m = load(file)
    return m if friction else m.with_values({"friction.enabled": False})
