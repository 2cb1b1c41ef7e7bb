"""Drawings of machine design, each in a file with the name of its answer.

In: an answer of ``machine``. Out: ``Scene``. Imports ``machine`` and what ``views`` imports.
"""

from __future__ import annotations

from importlib import import_module

from dalembert.machine.output.answer import Answer
from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Scene


def scenes_of(answer: Answer, notation: Notation | None = None) -> list[Scene]:
    """The drawings of an answer."""
    drawings = import_module(f"dalembert.views.machine.{answer.NAME}_views")
    found: list[Scene] = getattr(drawings, f"{answer.NAME}_scenes")(answer, notation or Notation())
    return found
