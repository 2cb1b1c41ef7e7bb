"""Drawings of machine design.

In: an answer of ``machine``. Out: ``Scene``. Imports ``machine`` and what ``views`` imports.
"""

from __future__ import annotations

from importlib import import_module

from dalembert.machine.output.answer import Answer
from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Scene

OWN = {"member": "member_views", "shaking": "shaking_views"}
"""Modules of the answers that do not show charts over the cycle."""


def scenes_of(answer: Answer, notation: Notation | None = None) -> list[Scene]:
    """The drawings of an answer."""
    drawings = import_module(f"dalembert.views.machine.{OWN.get(answer.NAME, 'cycle_views')}")
    found: list[Scene] = getattr(drawings, f"{answer.NAME}_scenes")(answer, notation or Notation())
    return found
