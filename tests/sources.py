"""Sources that tests read: each file is parsed once in a process, and only statements are walked."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def statements(path: Path) -> list[ast.stmt]:
    """Every statement of a file: classes, functions, imports, assertions, wherever they are."""
    return list(inner(tree(path)))


def inner(node: ast.AST) -> Iterator[ast.stmt]:
    """Every statement inside a node, without the expressions that make most of a tree.

    >>> [type(s).__name__ for s in inner(ast.parse("try: pass\\nexcept E:\\n  if a: import b\\nelse: f = 1"))]
    ['Try', 'Pass', 'If', 'Import', 'Assign']
    """
    for part in ("body", "handlers", "cases", "orelse", "finalbody"):
        some = getattr(node, part, ())
        for each in some if isinstance(some, list | tuple) else ():
            if isinstance(each, ast.stmt):
                yield each
            yield from inner(each)
