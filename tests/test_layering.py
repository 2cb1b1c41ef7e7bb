"""Rooms, and which way imports point between them (algebra <- core <- kernel, analysis <- views <- report)."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

import dalembert
from tests.sources import statements, tree

PACKAGE = Path(dalembert.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))
ROOMS = sorted({path.parent for path in MODULES} - {PACKAGE})
MOST = 15
"""Entries of a room: about a dozen."""

BASE = {
    "arrays",
    "bounds",
    "errors",
    "wording",
    "printing",
    "unit_names",
    "units",
    "saving",
    "bundled",
    "progress",
}
ANALYSIS = BASE | {"answer", "algebra", "core", "kernel", "model", "analysis"}
SHOWN = ANALYSIS - {"core", "kernel"} | {"wrench", "machine", "optimization"}
MAY_IMPORT = {
    **{name: set[str]() for name in ("arrays", "errors", "wording", "printing", "bundled", "progress")},
    **dict.fromkeys(("bounds", "saving", "unit_names", "units"), BASE),
    "answer": BASE | {"answer"},
    "algebra": {"arrays", "algebra"},
    "core": {"arrays", "algebra", "core"},
    "core.position": {"arrays", "algebra", "core"},
    "core.friction": {"arrays", "algebra", "core"} - {"core.position"},
    "kernel": {"arrays", "algebra", "core", "kernel"},
    "kernel.emit": {"arrays", "kernel"},
    "model": BASE | {"model"},
    "analysis": ANALYSIS,
    "analysis.result": ANALYSIS | {"machine"},  # Result.harmonics asks for the shaking force
    "analysis.methods.elements": ANALYSIS | {"machine"},  # Result.cylinder asks for the critical load
    "analysis.output": BASE | {"answer", "algebra", "model", "analysis"},
    "grading": BASE | {"answer", "core", "model", "analysis", "machine", "grading"},
    "wrench": BASE | {"answer", "algebra", "model", "analysis", "wrench"},
    "machine": ANALYSIS | {"machine"},
    "optimization": ANALYSIS - {"core", "kernel"} | {"machine", "optimization"},
    "views": SHOWN | {"views"},
    "views.symbols": SHOWN | {"views.paper", "views.space", "views.symbols"},
    "reports": SHOWN | {"views", "reports"},
    "notebook": SHOWN | {"views", "notebook"},
    "pages": SHOWN | {"", "core", "kernel", "views", "pages"},
    "studio": SHOWN | {"", "core", "kernel", "grading", "views", "reports", "pages", "studio"},
    "exams": SHOWN | {"grading", "views", "reports", "exams"},
    "studies": SHOWN | {"", "kernel", "views", "reports", "studies"},  # designs are drawn in machine code
    "cli": SHOWN | {"", "grading", "views", "reports", "pages", "exams", "studies", "studio", "cli"},
    "interchange": ANALYSIS | {"", "interchange"},  # its version is in what it writes
    "__init__": SHOWN | {"grading", "views", "reports", "pages", "exams", "studies"},
    "__main__": {"cli"},
}
"""Room (or file beside them) -> rooms that its files may import, with the rooms inside these; a room that is not named
here has the rule of the room it is in. '' is the package itself, for its version."""

FACADES = {
    "answer.answer",
    "analysis.methods.elements.element_answers",
    "analysis.methods.solved.solution_by_steps",
    "analysis.methods.on_paper",
    "analysis.result.result",
    "analysis.methods.power_flow",
    "machine.elements.governors",
    "machine.output.machine_answer",
    "machine.shaking",
    "machine.flywheel.flywheels",
    "machine.members.member_table",
    "machine.bearings.bearing_table",
    "machine.motors.motor_choice",
    "machine.elements.cam_design",
    "machine.elements.pin_table",
    "machine.design_numbers",
    "machine.shafts.critical_speeds",
    "machine.motion.simulation",
    "machine.balance.balancing",
    "machine.balance.rotors",
    "model.description",
    "model.files.conversion",
    "model.files.model_files",
    "views.paper.scene",
    "analysis.batch.batch_result",
    "analysis.batch.compiled_kernel",
    "machine.members.member_forces",
    "wrench.system",
    "analysis.batch.design_sweep",
    "studies.design_study",
    "studies.study_result",
    "optimization.optimum",
    "optimization.pareto_front",
    "optimization.synthesis",
    "grading.marking.grade",
}
"""Result, Mechanism, Scene, Kernel, Sweep, Study, StudyResult, System, and the answers of `machine`, which print
and draw themselves: their methods call what is built on them, by imports inside the methods. So do the quantities of
`machine` that a result has by name."""
SHOWING = {"notebook", "pages", "views", "reports", "interchange"}
"""What they call to show themselves, and to read and write other programs' files."""


def room(path: Path) -> str:
    """The room of a file, dots between rooms: the file itself beside all rooms."""
    parts = path.relative_to(PACKAGE).parts
    return ".".join(parts[:-1]) or path.stem


def within(name: str, rooms: set[str]) -> bool:
    return any(name == each or (each and name.startswith(f"{each}.")) for each in rooms)


@cache
def imported(path: Path) -> list[tuple[str, tuple[str, ...]]]:
    """Modules of this package that a file imports anywhere in it, and the names it takes from each."""
    found = []
    for node in statements(path):
        if isinstance(node, ast.Import):
            found += [(alias.name, ()) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: relative import"
            found.append((node.module or "", tuple(alias.name for alias in node.names)))
    return [(name, names) for name, names in found if name.split(".")[0] == "dalembert"]


def inside(module: str, names: tuple[str, ...]) -> set[str]:
    """Modules of the package behind one import, without its name: `from dalembert.core import rank` is core.rank."""
    found = {f"{module}.{name}" for name in names}
    taken = {name if _file(name) else module for name in found} if found else {module}
    return {name.removeprefix("dalembert").removeprefix(".") for name in taken}


def _file(module: str) -> Path | None:
    place = PACKAGE.joinpath(*module.split(".")[1:])
    return next((p for p in (place.with_suffix(".py"), place / "__init__.py") if p.is_file()), None)


def rule(name: str) -> set[str]:
    """What a room may import: its own rule, or that of the room it is in."""
    while name not in MAY_IMPORT:
        name = name.rpartition(".")[0]
        assert name
    return MAY_IMPORT[name]


def forbidden(path: Path) -> list[str]:
    """What a file imports that its room may not."""
    inner = ".".join(path.relative_to(PACKAGE).with_suffix("").parts)
    allowed = rule(room(path)) | (SHOWING if inner in FACADES else set())
    taken = {name for module, names in imported(path) for name in inside(module, names)}
    return [f"{inner} imports {name}" for name in sorted(taken) if not within(name, allowed)]


@pytest.mark.long
def test_imports_point_one_way() -> None:
    assert [each for path in MODULES for each in forbidden(path)] == []


def test_only_compile_reads_the_description_for_the_core() -> None:
    """Elsewhere in analysis a file that imports the core takes no more than the types of the description."""
    for path in (PACKAGE / "analysis").rglob("*.py"):
        modules = dict(imported(path))
        numeric = any(name.startswith("dalembert.core") for name in modules)
        if room(path).startswith("analysis.compile") or not numeric:
            modules = {}
        described = [name for name in modules if name.startswith("dalembert.model.")]
        assert not described, f"{path.name} imports the core and {described}"
        assert set(modules.get("dalembert.model", ())) <= {"GROUND", "Mechanism", "Schedule"}, path.name


def at_load(path: Path) -> list[tuple[str, tuple[str, ...]]]:
    """Imports at the head of a file: without those for hints and those inside functions."""
    found = [n for n in tree(path).body if isinstance(n, ast.ImportFrom)]
    return [
        (n.module or "", tuple(a.name for a in n.names))
        for n in found
        if n.module and n.module.startswith("dalembert")
    ]


def test_no_module_needs_itself() -> None:
    """No circle among the modules, imports for hints and inside functions counted, but for those of the facades."""
    graph = {}
    for path in MODULES:
        name = (
            ".".join(path.relative_to(PACKAGE).with_suffix("").parts)
            .removesuffix("__init__")
            .removesuffix(".")
        )
        taken = (at_load if name in FACADES else imported)(path)
        graph[name] = {one for module, names in taken for one in inside(module, names)} - {name}
    while True:
        leaves = {name for name, needs in graph.items() if not needs & graph.keys()}
        if not leaves:
            break
        graph = {name: needs for name, needs in graph.items() if name not in leaves}
    while True:  # what only leads to a circle is none
        needed = set().union(*graph.values()) if graph else set()
        kept = {name: needs for name, needs in graph.items() if name in needed}
        if len(kept) == len(graph):
            break
        graph = kept
    assert not graph


def test_a_room_can_be_overlooked() -> None:
    entries = {
        place: [
            p
            for p in place.iterdir()
            if p.suffix == ".py" or (p.name != "elements" and (p / "__init__.py").exists())
        ]  # the rooms of machine elements are not counted in theirs
        for place in ROOMS
    }
    assert {p.name: len(some) - 1 for p, some in entries.items() if len(some) - 1 > MOST} == {}


def test_a_room_says_what_comes_in_and_what_goes_out() -> None:
    said = {p: ast.get_docstring(tree(p / "__init__.py")) or "" for p in ROOMS}
    assert [p.name for p, text in said.items() if not ("In:" in text and "Out:" in text)] == []


def test_no_two_files_have_one_name() -> None:
    counted = Counter(path.stem for path in MODULES if path.stem not in ("__init__", "__main__"))
    assert not [name for name, count in counted.items() if count > 1]


TWICE = {"Couple"}
"""Public in two rooms: ``da.Couple`` is a load of a model, ``da.wrench.Couple`` a free vector."""


@pytest.mark.long
def test_no_two_classes_have_one_name() -> None:
    classes = [n for path in MODULES for n in ast.walk(tree(path)) if isinstance(n, ast.ClassDef)]
    assert {name for name, count in Counter(n.name for n in classes).items() if count > 1} == TWICE


HEAVY = (
    "numpy",
    "scipy",
    "pandas",
    "xarray",
    "pint",
    "pydantic",
    "ruamel",
    "rich",
    "cyclopts",
    "matplotlib",
    "casadi",
)


def loaded_by(code: str, names: tuple[str, ...]) -> set[str]:
    """Which of these packages a fresh interpreter has loaded behind some code."""
    watch = f"{code}\nimport sys; print('\\n' + ' '.join(n for n in {names!r} if n in sys.modules))"
    done = subprocess.run([sys.executable, "-c", watch], capture_output=True, text=True, check=True)
    return set(done.stdout.splitlines()[-1].split())


def test_the_version_is_printed_without_anything_heavy() -> None:
    assert loaded_by("from dalembert.cli import main\nmain(['--version'])", HEAVY) == set()


def test_help_loads_no_arrays() -> None:
    code = "from dalembert.cli import main\nmain(['--help'])"
    assert loaded_by(code, ("numpy", "scipy", "pydantic", "ruamel", "pint", "pandas", "xarray")) == set()


def test_solving_a_file_loads_nothing_it_does_not_need() -> None:
    code = "from dalembert.bundled import examples\nfrom dalembert.cli import main\n"
    code += "main(['solve', str(examples()['four_bar'])])"
    names = ("scipy", "pandas", "xarray", "pint", "matplotlib", "openpyxl", "rich", "cyclopts.help")
    assert loaded_by(code, names) == set()


def test_public_names_are_there_and_described() -> None:
    names = {name for name in dalembert.__all__ if not name.startswith("_")}
    assert len(names) > 100
    assert [name for name in sorted(names) if not getattr(dalembert, name).__doc__] == []
    assert names <= set(dir(dalembert))


def public(init: Path) -> set[str]:
    """Names that a package lists, or imports as themselves."""
    package = import_module(".".join(init.relative_to(PACKAGE.parent).parent.parts))
    taken = [a for node in statements(init) for a in getattr(node, "names", ())]
    return {*getattr(package, "__all__", ()), *(a.name for a in taken if getattr(a, "asname", "") == a.name)}


def test_no_function_of_a_package_has_the_name_of_one_of_its_modules() -> None:
    """Whichever is imported last would take the name: `'module' object is not callable`."""
    names = [(init.parent, name) for init in PACKAGE.rglob("__init__.py") for name in public(init)]
    assert len(names) > 200
    assert [name for folder, name in names if (folder / f"{name}.py").exists()] == [
        "draw"
    ]  # the module itself


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(AttributeError, match="module 'dalembert' has no attribute 'dynamic'"):
        dalembert.dynamic  # noqa: B018
