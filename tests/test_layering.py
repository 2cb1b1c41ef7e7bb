"""Imports point one way (DESIGN: algebra <- core <- kernel, analysis <- views <- report), read from the sources."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import dalembert

PACKAGE = Path(dalembert.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))

BASE = {"errors", "wording", "printing", "symbols", "units", "saving", "bundled"}
ANALYSIS = BASE | {"algebra", "core", "kernel", "model", "analysis"}
MAY_IMPORT = {
    "errors": set(),
    "wording": set(),
    "printing": set(),
    "bundled": set(),
    "saving": BASE,
    "symbols": BASE,
    "units": BASE,
    "algebra": {"algebra"},
    "core": {"algebra", "core"},
    "kernel": {"algebra", "core", "kernel"},
    "model": BASE | {"model"},
    "analysis": ANALYSIS,
    "wrench": BASE | {"algebra", "model", "analysis", "wrench"},
    "views": ANALYSIS - {"core", "kernel"} | {"wrench", "views"},
    "report": ANALYSIS - {"core", "kernel"} | {"wrench", "views", "report"},
    "study": ANALYSIS | {"study"},
    "web": ANALYSIS | {"views", "report", "study", "web"},
    "cli": ANALYSIS - {"core", "kernel"} | {"", "wrench", "views", "report", "study", "web", "cli"},
    "__init__": ANALYSIS | {"wrench", "views", "report", "study"},
    "__main__": {"cli"},
}
"""Part of the package -> the parts it may import; '' is the package itself, for its version."""


def layer(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported(path: Path) -> list[tuple[str, tuple[str, ...]]]:
    """Modules of this package that a file imports anywhere in it, and the names it takes from each."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += [(alias.name, ()) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: relative import"
            found.append((node.module or "", tuple(alias.name for alias in node.names)))
    return [(name, names) for name, names in found if name.split(".")[0] == "dalembert"]


def parts(module: str, names: tuple[str, ...]) -> set[str]:
    """Parts of the package behind one import: `from dalembert import analysis` is one of analysis."""
    inside = module.split(".")[1:2]
    if inside:
        return set(inside)
    return {name if (PACKAGE / name).is_dir() or (PACKAGE / f"{name}.py").is_file() else "" for name in names}


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_imports_point_one_way(path: Path) -> None:
    allowed = MAY_IMPORT[layer(path)]
    for module, names in imported(path):
        assert parts(module, names) <= allowed, f"{layer(path)} imports {module}"


COMPILING = ("compile.py", "jointing.py", "loads.py", "pairs.py")
"""The files that know both a description and the core."""


def test_only_compile_reads_the_description_for_the_core() -> None:
    """Elsewhere in analysis a file that imports the core takes no more than the types of the description."""
    for path in (PACKAGE / "analysis").glob("*.py"):
        modules = dict(imported(path))
        if path.name in COMPILING or not any(name.startswith("dalembert.core") for name in modules):
            continue
        inside = [name for name in modules if name.startswith("dalembert.model.")]
        assert not inside, f"{path.name} imports the core and {inside}"
        assert set(modules.get("dalembert.model", ())) <= {"Mechanism", "Schedule"}, path.name


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


def test_importing_the_package_loads_nothing_heavy() -> None:
    assert loaded_by("import dalembert", HEAVY) == set()


def test_help_loads_no_arrays() -> None:
    code = "from dalembert.cli import main\nmain(['--help'])"
    assert loaded_by(code, ("numpy", "scipy", "pydantic", "ruamel", "pint", "pandas", "xarray")) == set()


def test_solving_a_file_loads_nothing_it_does_not_need() -> None:
    code = "from dalembert.bundled import examples\nfrom dalembert.cli import main\n"
    code += "main(['solve', str(examples()['four_bar'])])"
    assert loaded_by(code, ("scipy", "pandas", "xarray", "pint", "matplotlib", "openpyxl")) == set()


@pytest.mark.parametrize("name", [name for name in dalembert.__all__ if not name.startswith("_")])
def test_public_names_are_there_and_described(name: str) -> None:
    assert getattr(dalembert, name).__doc__
    assert name in dir(dalembert)


def test_no_function_of_a_package_has_the_name_of_one_of_its_modules() -> None:
    """Whichever is imported last would take the name: `'module' object is not callable`."""
    called = {}
    for init in PACKAGE.rglob("__init__.py"):
        package = import_module(".".join(init.relative_to(PACKAGE.parent).parent.parts))
        for name in getattr(package, "__all__", ()):
            called[f"{package.__name__}.{name}"] = (init.parent / f"{name}.py").exists()
    assert len(called) > 150
    assert [name for name, clash in called.items() if clash] == ["dalembert.views.draw"]  # the module itself


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(AttributeError, match="module 'dalembert' has no attribute 'dynamic'"):
        dalembert.dynamic  # noqa: B018
