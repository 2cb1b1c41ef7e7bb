"""Single faults in the sources: which there are, and some of them drawn by rule and seed; `mutants.py` runs them."""

from __future__ import annotations

import ast
import random
from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator
from copy import copy
from dataclasses import dataclass
from hashlib import sha256
from math import sqrt
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src" / "dalembert"
PACKAGES = {
    "grading": "grading/ cli/answers_commands.py cli/check_command.py",
    "units": "units.py printing.py unit_names.py wording.py",
    **{
        p: f"{p}/"
        for p in (
            *("algebra", "core", "kernel", "model", "analysis", "wrench", "machine", "optimization"),
            *("views", "reports", "pages", "notebook", "exams", "studies", "cli"),
            *("answer", "interchange", "studio"),
        )
    },
}
"""Where each package's files are; a file belongs to the first package that names it."""

OTHER: dict[type[ast.AST], tuple[str, type[ast.AST]]] = {
    ast.Add: ("sum", ast.Sub), ast.Sub: ("sum", ast.Add),
    ast.Mult: ("product", ast.Div), ast.Div: ("product", ast.Mult),
    ast.Lt: ("order", ast.Gt), ast.Gt: ("order", ast.Lt), ast.LtE: ("order", ast.GtE), ast.GtE: ("order", ast.LtE),
    ast.Eq: ("equal", ast.NotEq), ast.NotEq: ("equal", ast.Eq), ast.Is: ("equal", ast.IsNot),
    ast.IsNot: ("equal", ast.Is), ast.In: ("equal", ast.NotIn), ast.NotIn: ("equal", ast.In),
    ast.And: ("logic", ast.Or), ast.Or: ("logic", ast.And),
}  # fmt: skip
EDGE = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
_PAIRS = "min max", "sin cos", "any all", "argmin argmax", "minimum maximum", "floor ceil", "zeros ones"
EXCHANGED = {a: b for pair in _PAIRS for a, b in (pair.split(), pair.split()[::-1])}
SYMMETRIC = {"isinstance", "dist", "hypot", "isclose", "allclose", "add", "gcd", "min", "max"}
SYMMETRIC |= {"minimum", "maximum"}
"""Calls whose first two arguments may be exchanged (or never are)."""
SILENT = {"repr", "frozen", "strict", "slots", "kw_only", "copy"}
"""Arguments that say how a record is made or prints itself: no number depends on them."""


@dataclass(frozen=True)
class Mutant:
    path: Path
    package: str
    kind: str
    which: int  # among the places of its file
    line: int
    before: str
    after: str
    statement: str  # key of the statement whose tests it meets
    names: tuple[str, ...]  # where it runs on import: what it binds

    again: int  # how many of the same text stand before it

    @property
    def key(self) -> str:
        again = f" ({self.again + 1})" if self.again else ""
        return f"{self.path.relative_to(SOURCE).as_posix()}: {self.before} -> {self.after}{again}"


def changes(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """Every change of one node: its kind, and the node in its place."""
    match node:
        case ast.BinOp(op=op) | ast.AugAssign(op=op) | ast.BoolOp(op=op) if type(op) in OTHER and not _text(
            node
        ):
            yield OTHER[type(op)][0], _with(node, op=OTHER[type(op)][1]())
        case ast.Compare(ops=[op]) if type(op) in OTHER:
            yield OTHER[type(op)][0], _with(node, ops=[OTHER[type(op)][1]()])
            if type(op) in EDGE and any(_whole(x) for x in (node.left, *node.comparators)):
                yield "edge", _with(node, ops=[EDGE[type(op)]()])
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            yield "minus" if isinstance(node.op, ast.USub) else "not", node.operand
        case ast.Constant(value=bool()):
            yield "truth", _with(node, value=not node.value)
        case ast.Constant(value=int()):
            yield "number", _with(node, value=node.value + 1)
        case ast.Constant(value=float() as x):
            yield "number", _with(node, value=x * (1e6 if x < 1e-4 else 2) or 1.0)
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=args):
            if name in EXCHANGED:
                field = "id" if isinstance(node.func, ast.Name) else "attr"
                yield "function", _with(node, func=_with(node.func, **{field: EXCHANGED[name]}))
            if (
                len(args) > 1
                and not any(isinstance(a, ast.Starred) for a in args[:2])
                and name not in SYMMETRIC
            ):
                yield "arguments", _with(node, args=[args[1], args[0], *args[2:]])
            if name in ("abs", "absolute", "sorted", "reversed") and len(args) == 1:
                yield "abs", args[0]
        case ast.If(orelse=[]):
            yield "guard", _with(node, test=ast.Constant(False))
        case ast.IfExp():
            yield "guard", node.body
        case ast.Expr(value=ast.Call()) | ast.Assign(targets=[ast.Subscript()]):
            yield "statement", ast.Pass()
        case ast.Slice():
            for end in ("lower", "upper"):
                if (old := getattr(node, end)) is not None and not isinstance(old, ast.Constant):
                    yield "index", _with(node, **{end: ast.BinOp(old, ast.Add(), ast.Constant(1))})


def _with(node: ast.AST, **fields: object) -> ast.AST:
    out = copy(node)
    for name, value in fields.items():
        setattr(out, name, value)
    return out


def _whole(node: ast.AST) -> bool:
    """A whole number, or a length: where < and <= differ."""
    number = isinstance(node, ast.Constant) and type(node.value) is int
    return number or (isinstance(node, ast.Call) and ast.unparse(node.func) == "len")


def _text(node: ast.AST) -> bool:
    return any(isinstance(n, ast.JoinedStr) or type(getattr(n, "value", 0)) is str for n in ast.walk(node))


def _silent(tree: ast.Module) -> set[int]:
    """Nodes without a part in any answer: annotations, decorators, what is imported for types only."""
    out: set[int] = set()
    for node in ast.walk(tree):
        rest = [
            getattr(node, "annotation", None),
            getattr(node, "returns", None),
            *getattr(node, "decorator_list", []),
        ]
        if isinstance(node, ast.keyword) and node.arg in SILENT:
            rest += [node]
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            rest += [node]
        out |= {id(inner) for r in rest if r is not None for inner in ast.walk(r)}
    return out


Place = tuple[ast.AST, str, int | None]
"""A node's parent, the field, and where in it."""


def _places(tree: ast.Module) -> list[tuple[Place, str, ast.AST]]:
    """Every change of a file: where, its kind, what stands there then."""
    silent, out = _silent(tree), []
    for parent in ast.walk(tree):
        for field, value in ast.iter_fields(parent):
            children = enumerate(value) if isinstance(value, list) else [(None, value)]
            for k, child in children:
                if isinstance(child, ast.AST) and id(child) not in silent:
                    out += [((parent, field, k), kind, new) for kind, new in changes(child)]
    return out


def _put(place: Place, new: ast.AST) -> ast.AST:
    """Put a node there; the old one."""
    parent, field, k = place
    held = getattr(parent, field)
    old = held if k is None else held[k]
    ast.copy_location(new, old)
    if k is None:
        setattr(parent, field, new)
    else:
        held[k] = new
    return old


def mutated(mutant: Mutant) -> ast.Module:
    tree = ast.parse(mutant.path.read_text(encoding="utf-8"))
    place, _, new = _places(tree)[mutant.which]
    _put(place, new)
    return ast.fix_missing_locations(tree)


def statements(path: Path, tree: ast.Module) -> Iterator[tuple[str, list[ast.stmt], ast.stmt]]:
    """Every statement in a function: a key that does not know its line, the list it stands in, and itself."""

    def inside(node: ast.AST, name: str, within: bool) -> Iterator[tuple[str, list[ast.stmt], ast.stmt]]:
        for field, value in ast.iter_fields(node):
            for child in list(value) if isinstance(value, list) else ():
                if not isinstance(child, ast.stmt | ast.excepthandler | ast.match_case):
                    continue
                text = (
                    field == "body" and isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant)
                )
                if within and isinstance(child, ast.stmt) and not text:
                    yield f"{path.relative_to(SOURCE).as_posix()}:{name}: {header(child)}", value, child
                if isinstance(child, ast.FunctionDef | ast.ClassDef):
                    yield from inside(child, f"{name}.{child.name}", isinstance(child, ast.FunctionDef))
                else:
                    yield from inside(child, name, within)

    yield from inside(tree, "", False)


def header(statement: ast.AST) -> str:
    """A statement on one line, without the statements in it."""
    return ast.unparse(statement).partition(":\n")[0].replace("\n", " ")


def mutants(path: Path, package: str) -> Iterator[Mutant]:
    """Every mutant of a file, in order."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    owner, around = {}, {}
    for key, _, statement in statements(path, tree):  # inner ones come later
        owner |= dict.fromkeys(map(id, ast.walk(statement)), key)
    for statement in (n for n in ast.walk(tree) if isinstance(n, ast.stmt)):
        around |= dict.fromkeys(map(id, ast.walk(statement)), statement)
    same: Counter[tuple[str, str]] = Counter()
    for which, (place, kind, new) in enumerate(_places(tree)):
        parent, field, k = place
        node = getattr(parent, field) if k is None else getattr(parent, field)[k]
        statement = around[id(node)]
        before = header(statement)
        _put(place, new)
        after = header(statement if statement is not node else new)
        _put(place, node)
        names = () if id(node) in owner else _bound(tree, node)
        if before != after:
            stands = (node.lineno, before, after, owner.get(id(node), ""), names, same[before, after])
            yield Mutant(path, package, kind, which, *stands)
            same[before, after] += 1


def _bound(tree: ast.Module, node: ast.AST) -> tuple[str, ...]:
    """Names that the statements around a node bind, the innermost first."""
    out: list[str] = []
    for outer in ast.walk(tree):
        if isinstance(outer, ast.stmt) and any(inner is node for inner in ast.walk(outer)):
            targets = getattr(outer, "targets", [getattr(outer, "target", None)])
            names = [n.id for t in targets if t is not None for n in ast.walk(t) if isinstance(n, ast.Name)]
            out = [*names, *([outer.name] if hasattr(outer, "name") else []), *out]
    return tuple(out)


def at_lines(places: Iterable[str]) -> list[Mutant]:
    """Every mutant of some lines, "views/charts.py:55"."""
    lines = [(SOURCE / file, int(line)) for file, _, line in (place.partition(":") for place in places)]
    return [m for path, line in lines for m in mutants(path, path.parent.name) if m.line == line]


def drawn(count: int, seed: int, only: Collection[str] | None = None) -> list[Mutant]:
    """Mutants of packages: more of a larger one, by the root of its size; a kind first, then a place for it.

    Places are shuffled by a hash of what they say, so that a change elsewhere in the sources changes no other mutant.
    """
    taken: set[Path] = set()
    every: dict[str, dict[str, list[Mutant]]] = {}
    for package, where in PACKAGES.items():
        kinds: dict[str, list[Mutant]] = defaultdict(list)
        for path in sorted(
            p for w in where.split() for p in SOURCE.glob(w if w.endswith(".py") else f"{w}**/*.py")
        ):
            if path not in taken:
                taken.add(path)
                for m in mutants(path, package):
                    kinds[m.kind].append(m)
        for some in kinds.values():
            some.sort(key=lambda m: sha256(f"{seed} {m.key}".encode()).digest())
        every[package] = kinds
    size = {p: sqrt(sum(map(len, kinds.values()))) for p, kinds in every.items()}
    out = []
    for package, kinds in every.items():
        rng, wanted = random.Random(f"{seed} {package}"), round(count * size[package] / sum(size.values()))
        for _ in range(wanted if only is None or package in only else 0):
            kind = rng.choice(sorted(k for k in kinds if kinds[k]))
            out.append(kinds[kind].pop())
    return out
