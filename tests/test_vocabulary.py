"""One word for one thing, and small pieces (STYLE), read from the sources."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import dalembert
from tests.sources import statements, tree

PACKAGE = Path(dalembert.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))

VAGUE = {"util", "utils", "helper", "helpers", "manager", "handler", "data", "misc", "common", "tools"}
OTHER_WORDS = {
    "body": "link",
    "bodies": "links",
    "bar": "link",
    "bars": "links",
    "pivot": "joint",
    "linkage_pair": "joint",
    "kinematic_pair": "joint",
    "actuator": "drive",
    "degree_of_freedom": "freedom",
    "dof": "freedom",
}
LONGEST_FILE, LONGEST_FUNCTION = 400, 60

Function = ast.FunctionDef | ast.AsyncFunctionDef
FUNCTION = (ast.FunctionDef, ast.AsyncFunctionDef)


def test_modules_say_what_they_hold() -> None:
    names = {part.removesuffix(".py") for path in MODULES for part in path.relative_to(PACKAGE).parts}
    assert not names & VAGUE


def named(path: Path) -> Iterator[str]:
    """Public names: of classes, functions, their arguments, and fields and constants."""
    for node in statements(path):
        if isinstance(node, (*FUNCTION, ast.ClassDef)) and not node.name.startswith("_"):
            yield node.name
            if isinstance(node, FUNCTION):
                yield from (a.arg for a in [*node.args.args, *node.args.kwonlyargs, *node.args.posonlyargs])
            else:
                yield from (
                    f.target.id
                    for f in node.body
                    if isinstance(f, ast.AnnAssign) and isinstance(f.target, ast.Name)
                )


def test_one_word_for_one_thing() -> None:
    words = [(path.name, name, OTHER_WORDS.get(name.lower())) for path in MODULES for name in named(path)]
    assert len(words) > 5000
    assert [f"{file}: {name}: say {word}" for file, name, word in words if word] == []


def length(function: Function) -> int:
    """Lines of a function, its docstring left out: figures and examples do not make code long."""
    first = function.body[0]
    lines = (function.end_lineno or 0) - function.lineno + 1
    return lines - ((first.end_lineno or 0) - first.lineno + 1 if ast.get_docstring(function) else 0)


def test_nobody_asks_for_the_type_of_a_joint_or_load() -> None:
    """Their classes say what they do, tables by type how they look."""
    asked = re.compile(r"\.type (==|!=|in|not in) ")
    found = [path.name for path in MODULES if asked.search(path.read_text(encoding="utf-8"))]
    assert not found


def test_pieces_are_small() -> None:
    lines = {path.name: path.read_text(encoding="utf-8").count("\n") for path in MODULES}
    assert {name: count for name, count in lines.items() if count > LONGEST_FILE} == {}
    functions = [(path.name, n) for path in MODULES for n in statements(path) if isinstance(n, FUNCTION)]
    assert len(functions) > 3000
    assert [f"{file}: {f.name}" for file, f in functions if length(f) > LONGEST_FUNCTION] == []


def test_modules_say_what_they_are() -> None:
    assert [path.name for path in MODULES if tree(path).body and not ast.get_docstring(tree(path))] == []


def test_cited_sections_of_the_theory_are_there() -> None:
    theory = (PACKAGE.parents[1] / "docs" / "theory.md").read_text(encoding="utf-8")
    sections = set(re.findall(r"^#+ (\d+(?:\.\d+)?)\b", theory, re.MULTILINE))
    cited = [
        n for p in MODULES for n in re.findall(r"theory\.md (\d+(?:\.\d+)?)", p.read_text(encoding="utf-8"))
    ]
    assert len(sections) > 30
    assert len(cited) > 25
    assert set(cited) <= sections
