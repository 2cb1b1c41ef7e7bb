"""Tests of the tests, read from their sources: none passes without having compared anything."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

FILES = sorted(Path(__file__).parent.rglob("test_*.py"))


def blocks(function: ast.FunctionDef) -> Iterator[list[ast.stmt]]:
    for node in ast.walk(function):
        yield from (part for _, part in ast.iter_fields(node) if isinstance(part, list) and part)


def returns_early(function: ast.FunctionDef) -> bool:
    """A return that does not stand right behind an assertion."""
    for block in blocks(function):
        for before, statement in zip([None, *block], block, strict=False):
            if (
                isinstance(statement, ast.Return)
                and statement.value is None
                and not isinstance(before, ast.Assert)
            ):
                return True
    return False


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_no_test_returns_before_it_has_compared(path: Path) -> None:
    """Draw until the condition holds (`tiers.nth`) instead."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    tests = [f for f in ast.walk(tree) if isinstance(f, ast.FunctionDef) and f.name.startswith("test_")]
    assert [f.name for f in tests if returns_early(f)] == []
