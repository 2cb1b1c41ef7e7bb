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


def compares(block: list[ast.stmt]) -> bool:
    """Whether it asserts something that neither an `if` nor a `continue` before it can pass by."""
    for s in block:
        match s:
            case ast.Assert() | ast.Expr(value=ast.Call()):  # a function that compares
                return True
            case ast.With() if compares(s.body) or "raises" in ast.unparse(s.items[0]):
                return True
            case ast.For() | ast.While() | ast.Try() if compares(s.body):
                return True
            case ast.If() if compares(s.body) and compares(s.orelse):
                return True
            case ast.If() if any(isinstance(n, ast.Continue) for n in ast.walk(s)) and not compares(s.body):
                return False
    return False


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_no_test_compares_under_a_condition_only(path: Path) -> None:
    tests = [
        f for f in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(f, ast.FunctionDef)
    ]
    asserting = [f for f in tests if any(isinstance(n, ast.Assert) for n in ast.walk(f))]
    assert [f.name for f in asserting if f.name.startswith("test_") and not compares(f.body)] == []


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_no_test_returns_before_it_has_compared(path: Path) -> None:
    """Draw until the condition holds (`tiers.nth`) instead."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    tests = [f for f in ast.walk(tree) if isinstance(f, ast.FunctionDef) and f.name.startswith("test_")]
    assert [f.name for f in tests if returns_early(f)] == []
