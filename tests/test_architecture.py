"""docs/architecture.md says what happens: its functions are entered in its order, its floors have its lines."""

from __future__ import annotations

import ast
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import dalembert

PACKAGE = Path(dalembert.__file__).parent
ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
ROUTE = re.compile(r"```python\n(.*?)```\n+\| function .*?\n\| ---.*?\n(.*?)\n\n", re.DOTALL)
ROW = re.compile(r"\| `([\w.]+)` \| `([\w/]+\.py)` \|")
ROUTES = [(code, ROW.findall(rows)) for code, rows in ROUTE.findall(PAGE)]
FLOORS = re.findall(r"^\| [\w ,]+ \| (`[\w`, ]+) \| ([\d,]+) \|$", PAGE, re.MULTILINE)
RECORDER = """
import json, sys
codes, package = json.load(sys.stdin)
def record(frame, event, _):
    name = frame.f_code.co_filename.replace("\\\\", "/")
    if event == "call" and name.startswith(package):
        entered[frame.f_code.co_qualname, name[len(package):]] = True
for code in codes:
    entered = {}
    sys.setprofile(record)
    exec(code, {})
    sys.setprofile(None)
    print("route", json.dumps(list(entered)))
"""
"""Run in a process of its own: programs that this one keeps would be met a second time."""


@pytest.fixture(scope="module")
def entered(tmp_path_factory: pytest.TempPathFactory) -> list[list[tuple[str, str]]]:
    """Functions of each route, in the order in which they are entered first."""
    codes = [code for code, _ in ROUTES]
    for folder in ("examples", "cases"):
        codes = [code.replace(f'"{folder}/', f'"{(ROOT / folder).as_posix()}/') for code in codes]
    ran = subprocess.run(
        [sys.executable, "-c", RECORDER],
        input=json.dumps([codes, f"{PACKAGE.as_posix()}/"]),
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path_factory.mktemp("routes"),
    )
    lines = [line.partition(" ")[2] for line in ran.stdout.splitlines() if line.startswith("route ")]
    return [[(name, file) for name, file in json.loads(line)] for line in lines]


def defined(path: Path) -> set[str]:
    """Qualified names of the functions of a file."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    inside = [(f"{c.name}.", c.body) for c in tree.body if isinstance(c, ast.ClassDef)]
    bodies = [("", tree.body), *inside]
    return {prefix + f.name for prefix, body in bodies for f in body if isinstance(f, ast.FunctionDef)}


def test_the_page_is_read() -> None:
    assert [len(rows) for _, rows in ROUTES] == [18, 8, 11, 11, 12, 12]
    assert len(FLOORS) == 14


def test_its_functions_exist() -> None:
    named = [(name, file) for _, rows in ROUTES for name, file in rows]
    named += re.findall(r"`(\w+)` in\s+`([\w/]+\.py)`", PAGE)
    assert len(named) == 75
    assert [f"{file}: {name}" for name, file in named if name not in defined(PACKAGE / file)] == []


@pytest.mark.long
@pytest.mark.parametrize("route", range(6))
def test_its_calls_take_its_routes(route: int, entered: list[list[tuple[str, str]]]) -> None:
    rank = {pair: k for k, pair in enumerate(entered[route])}
    rows = ROUTES[route][1]
    assert [f"{file}: {name}" for name, file in rows if (name, file) not in rank] == []
    order = [rank[name, file] for name, file in rows]
    assert [rows[k] for k in range(1, len(rows)) if order[k] < order[k - 1]] == []


def test_its_floors_have_its_lines() -> None:
    rooms = []
    for names, lines in FLOORS:
        of_floor = re.findall(r"\w+", names)
        rooms += of_floor
        files = [p for name in of_floor for p in (PACKAGE / name).rglob("*.py")]
        counted = sum(len(p.read_text(encoding="utf-8").splitlines()) for p in files)
        assert counted == pytest.approx(int(lines.replace(",", "")), rel=0.15), names
    folders = {p.name for p in PACKAGE.iterdir() if (p / "__init__.py").exists()}
    assert sorted(rooms) == sorted(folders)
