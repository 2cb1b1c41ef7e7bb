"""Tests of the tests, read from their sources: none passes without having compared anything."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tests.sources import inner, statements

FILES = sorted(Path(__file__).parent.rglob("test_*.py"))

BLOCKS = ("body", "orelse", "finalbody")


def blocks(function: ast.FunctionDef) -> Iterator[list[ast.stmt]]:
    for node in (function, *inner(function)):
        handlers = getattr(node, "handlers", [])
        parts = (getattr(one, part, None) for one in (node, *handlers) for part in BLOCKS)
        yield from (part for part in parts if part)


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
            case ast.If() if any(isinstance(n, ast.Continue) for n in inner(s)) and not compares(s.body):
                return False
    return False


@cache
def written() -> list[tuple[str, ast.FunctionDef]]:
    """Every test with the name of its file."""
    functions = [(p.name, f) for p in FILES for f in statements(p) if isinstance(f, ast.FunctionDef)]
    return [(f"{file}: {f.name}", f) for file, f in functions if f.name.startswith("test_")]


@pytest.mark.long
def test_no_test_compares_under_a_condition_only() -> None:
    asserting = [(at, f) for at, f in written() if any(isinstance(n, ast.Assert) for n in inner(f))]
    assert len(asserting) > 1400
    assert [at for at, f in asserting if not compares(f.body)] == []


def test_no_test_returns_before_it_has_compared() -> None:
    """Draw until the condition holds (`tiers.nth`) instead."""
    assert [at for at, f in written() if returns_early(f)] == []


def test_what_is_left_to_the_long_tests_is_a_test() -> None:
    here = Path(__file__).parent
    for name in (here / "left_to_long.txt").read_text(encoding="utf-8").splitlines():
        file, _, test = name.partition("[")[0].rpartition("::")
        assert f"def {test}(" in (here.parent / file).read_text(encoding="utf-8"), name
