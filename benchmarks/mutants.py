"""Faults put into the sources one at a time, by rule and seed: how many of them do the default tests notice?

Method. A mutant is one change at one place (`mutations.py`): + for -, < for >, min for max, two arguments exchanged,
another constant, a guard or a statement left out, an index off by one, `not`, minus or abs dropped. In each package a
kind of change is drawn, then a place for it. Which default tests run which statement is measured once, by a mark
before every statement, and kept in build/mutants. Then every mutant meets the tests that run its statement, in a
process forked from one that has imported everything: the fastest first, the nth instance of a test as if it took n
times as long, until one fails, or for --limit seconds. What runs on import (constants, tables, defaults) is imported
anew, and meets the tests of the statements that say its name. No test can know an equivalent mutant: those in
`equivalent_mutants.toml`, each with its reason, do not count.

    python benchmarks/mutants.py [--count 340] [--seed 1] [--package core ...] [--at views/charts.py:55 ...]
    python benchmarks/mutants.py --again     # those that are not killed yet, against the tests of now
"""

from __future__ import annotations

import os
import sys

os.environ |= {"CI": "1", "OPENBLAS_NUM_THREADS": "1"}  # random tests repeat themselves; one thread
sys.dont_write_bytecode = True

import argparse  # noqa: E402
import ast  # noqa: E402
import builtins  # noqa: E402
import gc  # noqa: E402
import importlib  # noqa: E402
import json  # noqa: E402
import re  # noqa: E402
import resource  # noqa: E402
import signal  # noqa: E402
import tempfile  # noqa: E402
import tomllib  # noqa: E402
import traceback  # noqa: E402
from collections import Counter  # noqa: E402
from collections.abc import Callable  # noqa: E402
from hashlib import sha256  # noqa: E402
from importlib.machinery import PathFinder, SourceFileLoader  # noqa: E402
from pathlib import Path  # noqa: E402
from time import process_time  # noqa: E402
from types import CodeType, FunctionType  # noqa: E402
from typing import Any  # noqa: E402

import numpy as np  # noqa: E402
import pytest  # noqa: E402
from mutations import PACKAGES, SOURCE, Mutant, at_lines, drawn, mutants, mutated, statements  # noqa: E402

ROOT = SOURCE.parents[1]
BUILD = ROOT / "build" / "mutants"
MEASURED, VERDICTS, NOW = BUILD / "tests.json", BUILD / "verdicts.jsonl", "now-"
HITS = bytearray(100_000)
ALIVE, KILLED = 0, 1
INSTANCES, SPENT = 6, 30.0
"""Of every test instances are measured and run in an order drawn by their names: so many, and then more until they have
taken so many seconds of the processor. A long written list of quick rows is whole; a law on seeds is a sample."""


class Loader(SourceFileLoader):
    """Loads the product's modules, with a mark before every statement or with one mutant in."""

    marks: dict[str, int] | None = None
    mutant: Mutant | None = None

    def get_code(self, fullname: str) -> CodeType:
        path = Path(self.path)
        if Loader.mutant and Loader.mutant.path == path:
            return compile(mutated(Loader.mutant), path, "exec")
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for key, body, statement in statements(path, tree) if Loader.marks is not None else ():
            mark = ast.parse(f"__hits__[{Loader.marks.setdefault(key, len(Loader.marks))}] = 1").body[0]
            for node in ast.walk(mark):
                ast.copy_location(node, statement)
            body.insert(body.index(statement), mark)
        return compile(tree, path, "exec")


class Finder(PathFinder):
    @classmethod
    def find_spec(cls, fullname: str, path: Any = None, target: Any = None) -> Any:
        ours = fullname.partition(".")[0] == "dalembert"
        spec = PathFinder.find_spec(fullname, path, target) if ours else None
        if spec is not None and spec.origin:
            spec.loader = Loader(fullname, spec.origin)
        return spec


def import_everything() -> None:
    """So that what is imported late is there before the first fork."""
    for path in sorted(SOURCE.rglob("*.py")):
        if path.stem != "__main__":
            importlib.import_module(
                ".".join(path.relative_to(SOURCE.parent).with_suffix("").parts).removesuffix(".__init__")
            )


class Session:
    """Pytest collects, then gives its tests to ``work`` instead of running them."""

    def __init__(self, work: Callable[[Session, dict[str, Any]], None]) -> None:
        self.work, self.failed = work, False

    def pytest_runtest_logreport(self, report: Any) -> None:
        self.failed |= report.failed

    pytest_collectreport = pytest_runtest_logreport

    def pytest_runtestloop(self, session: Any) -> bool:
        session.config._tmp_path_factory.getbasetemp()  # one folder, made before the first fork
        self.work(self, {item.nodeid: item for item in session.items})
        return True

    def fails(self, item: Any, seconds: float) -> bool:
        """Whether a test fails; longer than so many seconds of the processor, and this process ends."""
        self.failed = False
        signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
        item.ihook.pytest_runtest_protocol(item=item, nextitem=None)
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        return self.failed


def collect(work: Callable[[Session, dict[str, Any]], None], *arguments: str) -> int:
    with tempfile.TemporaryDirectory() as folder:
        options = [
            *("-o", "addopts=--doctest-modules --import-mode=importlib", "-m", "not long and not exhaustive"),
            *("-p", "no:terminal", "-p", "no:cacheprovider", "-p", "no:xdist", "-s"),
            *("-o", "tmp_path_retention_policy=none"),
            *("-W", "ignore::pytest.PytestAssertRewriteWarning"),  # what the studio imports is a plugin too
        ]
        return int(pytest.main([*options, f"--basetemp={folder}/t", *arguments], plugins=[Session(work)]))


def forked(work: Callable[[], int], quiet: bool = True) -> int:
    """What a function returns in a process of its own; -signal if it was ended by one."""
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    try:
        for stream in range(3) if quiet else ():
            os.dup2(os.open(os.devnull, os.O_RDWR), stream)
        os._exit(work())
    except BaseException:
        traceback.print_exc()
        os._exit(KILLED)


def shared(some: list[Any], processes: int, work: Callable[[list[Any]], None]) -> None:
    """A list's parts worked on side by side."""
    children = []
    for k in range(processes):
        if not (child := os.fork()):
            work(some[k::processes])
            os._exit(0)
        children.append(child)
    for child in children:
        os.waitpid(child, 0)


# Which tests run which statements


def measure(processes: int) -> None:
    """Seconds of every default test and the statements it runs, anew where the test's file is another."""
    known = json.loads(MEASURED.read_text()) if MEASURED.exists() else {"keys": [], "tests": {}}
    table, marks = known["tests"], {key: k for k, key in enumerate(known["keys"])}
    Loader.marks, builtins.__hits__ = marks, HITS  # type: ignore[attr-defined]
    import_everything()

    def work(session: Session, items: dict[str, Any]) -> None:
        stamps = {p: sha256(p.read_bytes()).hexdigest()[:12] for p in {i.path for i in items.values()}}
        kept = {n: row for n, row in table.items() if n in items and row["stamp"] == stamps[items[n].path]}
        wanted = sorted(items.keys() - kept.keys(), key=lambda n: sha256(n.encode()).digest())
        modules = [m for n, m in sys.modules.items() if n.partition(".")[0] in ("tests", "dalembert")]
        caches = [f for m in modules for f in vars(m).values() if hasattr(f, "cache_clear")]

        def part(some: list[str]) -> None:
            ran, spent = Counter[str](), Counter[str]()
            for node, row in kept.items():
                ran[test_of(node)] += 1
                spent[test_of(node)] += row["seconds"]
            with (BUILD / f"part-{os.getpid()}.jsonl").open("w") as out:
                for item in (items[node] for node in some):
                    test = test_of(item.nodeid)
                    if ran[test] >= INSTANCES and spent[test] > SPENT:
                        continue
                    for cache in caches:
                        cache.cache_clear()
                    HITS[:] = bytes(len(HITS))
                    start = process_time()
                    session.fails(item, 600)
                    hits = np.packbits(np.frombuffer(HITS, np.uint8)[: len(marks)]).tobytes().hex()
                    row = {"stamp": stamps[item.path], "seconds": process_time() - start, "ran": hits}
                    ran[test] += 1
                    spent[test] += row["seconds"]
                    out.write(json.dumps([item.nodeid, row | {"failed": session.failed}]) + "\n")

        sys.stderr.write(f"measuring {len(wanted)} of {len(items)} tests\n")
        shared(wanted, processes, part)
        for path in BUILD.glob("part-*.jsonl"):
            kept.update(map(json.loads, path.read_text().splitlines()))
            path.unlink()
        MEASURED.write_text(json.dumps({"keys": list(marks), "tests": kept}))

    collect(work, "--every-quick")


def test_of(node: str) -> str:
    """A test's name without that of its instance."""
    return node.partition("[")[0]


class Tests:
    """The tests of each statement, as measured."""

    def __init__(self) -> None:
        known = json.loads(MEASURED.read_text())
        rows = [(n, row) for n, row in known["tests"].items() if not row["failed"]]
        self.keys, self.nodes = known["keys"], [n for n, _ in rows]
        self.seconds = [row["seconds"] for _, row in rows]
        self.ran = np.zeros((len(rows), len(self.keys)), bool)
        for k, (_, row) in enumerate(rows):
            bits = np.unpackbits(np.frombuffer(bytes.fromhex(row["ran"]), np.uint8))[: len(self.keys)]
            self.ran[k, : len(bits)] = bits

    def of(self, mutant: Mutant) -> list[int]:
        """Tests that run a mutant's statement; of one written since, its function, file or folder; on import, what
        says its names."""
        file = mutant.path.relative_to(SOURCE).as_posix()
        patterns = [
            *(rf"\b{name}\b" for name in mutant.names),
            f"^{re.escape(file)}:",
            f"^{mutant.path.parent.name}/",
        ]
        if mutant.statement in self.keys:
            patterns = [f"^{re.escape(mutant.statement)}$"]
        elif mutant.statement:
            patterns.insert(0, f"^{re.escape(mutant.statement.partition(': ')[0])}:")
        for pattern in patterns:
            columns = [k for k, key in enumerate(self.keys) if re.search(pattern, key)]
            if (found := np.flatnonzero(self.ran[:, columns].any(axis=1))).size:
                return list(found)
        return []

    def __call__(self, mutant: Mutant, limit: float) -> list[tuple[str, float]]:
        """The fastest first, the nth instance of a test as if it took n times as long, up to a limit of seconds."""
        again: Counter[str] = Counter()
        turns = []
        for k in sorted(self.of(mutant), key=self.seconds.__getitem__):
            again[test := test_of(self.nodes[k])] += 1
            turns.append((again[test] * self.seconds[k], self.seconds[k], self.nodes[k]))
        total = np.cumsum([seconds for _, seconds, _ in sorted(turns)])
        return [(node, s) for (_, s, node), t in zip(sorted(turns), total, strict=True) if t - s < limit]


# Mutants among their tests


def met(session: Session, items: dict[str, Any], tests: list[tuple[str, float]]) -> int:
    """Whether some test notices; the file NOW tells which it was."""
    resource.setrlimit(resource.RLIMIT_AS, (12 << 30,) * 2)
    for node, seconds in tests:
        (BUILD / f"{NOW}{os.getppid()}").write_text(node)
        if session.failed or (node in items and session.fails(items[node], 10 + 10 * seconds)):
            return KILLED
    return ALIVE


def written(mutant: Mutant, tests: list[tuple[str, float]], status: int) -> None:
    """A line of the verdicts, and of what is seen meanwhile."""
    now = BUILD / f"{NOW}{os.getpid()}"
    how = "alive" if status == ALIVE else "too slow" if status < 0 else "killed"
    row = {
        "key": mutant.key,
        "package": mutant.package,
        "kind": mutant.kind,
        "line": mutant.line,
        "verdict": how,
    }
    row |= {"tests": len(tests), "by": now.read_text() if now.exists() and status else ""}
    now.unlink(missing_ok=True)
    with VERDICTS.open("a") as out:
        out.write(json.dumps(row) + "\n")
    if status == ALIVE:
        sys.stderr.write(f"alive: {mutant.path}:{mutant.line} ({mutant.kind}, {len(tests)} tests)\n")
        sys.stderr.write("    - {}\n    + {}\n".format(*apart(mutant.before, mutant.after)))


def apart(before: str, after: str, room: int = 60) -> list[str]:
    """Two texts without most of what they share at their ends."""
    first, last = shared_length(before, after), shared_length(before[::-1], after[::-1])
    return [
        t[max(0, first - room) :][: len(t) - max(0, first - room) - max(0, last - room)]
        for t in (before, after)
    ]


def shared_length(a: str, b: str) -> int:
    return next((k for k, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b)))


def exchange(mutant: Mutant, functions: dict[CodeType, list[FunctionType]]) -> None:
    """The code of a mutant's module put into the functions that are there."""
    tree = ast.parse(mutant.path.read_text(encoding="utf-8"))
    pairs = [(compile(tree, mutant.path, "exec"), compile(mutated(mutant), mutant.path, "exec"))]
    for old, new in pairs:
        inner = [[c for c in code.co_consts if isinstance(c, CodeType)] for code in (old, new)]
        pairs += [(a, b) for a, b in zip(*inner, strict=False) if a.co_name == b.co_name]
        for function in functions.get(old, []) if old != new else ():
            function.__code__ = new


def in_functions(some: list[Mutant], tests: dict[str, list[tuple[str, float]]], processes: int) -> None:
    """Mutants in functions: everything is imported once."""
    import_everything()

    def work(session: Session, items: dict[str, Any]) -> None:
        functions: dict[CodeType, list[FunctionType]] = {}
        gc.unfreeze()  # what tests/conftest.py has frozen is no object that the collector lists
        for f in gc.get_objects():
            if isinstance(f, FunctionType) and f.__code__.co_filename.startswith(str(SOURCE)):
                functions.setdefault(f.__code__, []).append(f)
        gc.freeze()
        assert functions

        def part(mine: list[Mutant]) -> None:
            for m in mine:
                run = lambda m=m: exchange(m, functions) or met(session, items, tests[m.key])  # type: ignore[misc]  # noqa: E731
                written(m, tests[m.key], forked(run))

        shared(some, processes, part)

    collect(work)


def on_import(some: list[Mutant], tests: dict[str, list[tuple[str, float]]], processes: int) -> None:
    """Mutants in what runs on import: imported anew, with the files of a few tests first."""
    for module in ("scipy.sparse.linalg", "scipy.optimize", "pydantic", "ruamel.yaml", "pint", "sympy"):
        importlib.import_module(module)

    def fresh(m: Mutant, few: list[tuple[str, float]]) -> int:
        Loader.mutant, status = m, [KILLED]
        files = sorted({node.partition("::")[0] for node, _ in few})

        def work(session: Session, items: dict[str, Any]) -> None:
            status[0] = met(session, items, few)

        collect(work, *files)
        return status[0]

    def part(mine: list[Mutant]) -> None:
        for m in mine:
            status, mets = ALIVE, tests[m.key]
            for few in (mets[:25], mets[25:]):
                status = status or (forked(lambda few=few, m=m: fresh(m, few)) if few else ALIVE)  # type: ignore[misc]
            written(m, mets, status)

    shared(some, processes, part)


def table(rows: list[dict[str, Any]], same: dict[str, str]) -> str:
    """Mutants, killed, equivalent and the share of each package."""
    out = ["package     mutants  killed  equivalent  alive  killed of those that count"]
    for package in [*PACKAGES, "all"]:
        mine = [r for r in rows if package in (r["package"], "all")]
        equivalent = sum(r["key"] in same and r["verdict"] == "alive" for r in mine)
        alive = sum(r["verdict"] == "alive" for r in mine) - equivalent
        share = 1 - alive / max(1, len(mine) - equivalent)
        out.append(
            f"{package:10} {len(mine):8} {len(mine) - alive - equivalent:7} {equivalent:11} {alive:6} {share:10.1%}"
        )
    return "\n".join(out)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=340)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--package", choices=list(PACKAGES), nargs="+")
    parser.add_argument("--at", nargs="+", metavar="FILE:LINE", help="instead: every change of these lines")
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--measure-only", action="store_true")
    asked = parser.parse_args()
    BUILD.mkdir(parents=True, exist_ok=True)
    os.chdir(ROOT)
    sys.path.insert(0, str(SOURCE.parent))
    os.environ["PYTHONPATH"] = str(SOURCE.parent)
    sys.meta_path.insert(0, Finder)
    forked(lambda: measure(asked.processes) or 0, quiet=False)
    if asked.measure_only:
        return
    same = tomllib.loads((Path(__file__).parent / "equivalent_mutants.toml").read_text(encoding="utf-8"))
    rows = [json.loads(line) for line in VERDICTS.read_text().splitlines()] if asked.again else []
    named = {SOURCE / key.partition(": ")[0] for key in same}
    if gone := same.keys() - {m.key for path in named if path.exists() for m in mutants(path, "")}:
        sys.stderr.write("equivalent_mutants.toml names what is no mutant: " + "; ".join(sorted(gone)) + "\n")
    some = at_lines(asked.at) if asked.at else drawn(asked.count, asked.seed, asked.package)
    every = {m.key: m for m in some}
    rows = [r for r in rows if r["key"] in every and (r["verdict"] != "alive" or r["key"] in same)]
    some = [m for key, m in every.items() if key not in {r["key"] for r in rows}]
    VERDICTS.write_text("".join(json.dumps(r) + "\n" for r in rows))
    tests = Tests()
    meets = {m.key: tests(m, asked.limit) for m in some}
    del tests
    forked(lambda: in_functions([m for m in some if m.statement], meets, asked.processes) or 0, quiet=False)
    on_import([m for m in some if not m.statement], meets, asked.processes)
    print(table([json.loads(line) for line in VERDICTS.read_text().splitlines()], same))


if __name__ == "__main__":
    main()
