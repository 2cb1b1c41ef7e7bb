"""The example notebooks run in real Jupyter, in an empty folder, without a word on standard error."""

from __future__ import annotations

import ast
import json
import os
from pathlib import Path
from typing import Any

import pytest

import dalembert
from dalembert.bundled import folder
from tests.progress_lines import only_progress

NOTEBOOKS = sorted(folder("examples").glob("notebooks/*.ipynb"))
SHOWN = {"designer": 9, "student": 5, "teacher": 2, "tour": 11}
"""Notebook -> how many tables and pictures it shows at least."""


def cells(path: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return found


def test_there_is_one_for_each_user() -> None:
    assert {path.stem for path in NOTEBOOKS} == set(SHOWN)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_are_kept_without_outputs_and_use_public_names(path: Path) -> None:
    for cell in [cell for cell in cells(path) if cell["cell_type"] == "code"]:
        assert (cell["outputs"], cell["execution_count"]) == ([], None)
        for node in ast.walk(ast.parse("".join(cell["source"]))):
            if isinstance(node, ast.ImportFrom):
                assert node.module in ("pathlib", "tempfile", "dalembert.bundled")
            elif (
                isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "da"
            ):
                assert node.attr in dalembert.__all__


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")  # of the kernel's own packages
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run_in_jupyter(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import nbformat
    from nbclient import NotebookClient

    monkeypatch.setenv("PYTHONPATH", str(Path(dalembert.__file__).parents[1]))
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    work = tmp_path / "work"
    work.mkdir()
    book = nbformat.read(path, as_version=4)
    nbformat.validate(book)
    client = NotebookClient(
        book, timeout=600, kernel_name="python3", resources={"metadata": {"path": os.fspath(work)}}
    )
    client.execute()
    outputs = [o for cell in book.cells if cell.cell_type == "code" for o in cell.outputs]
    said = [o.text for o in outputs if o.output_type == "stream" and o.name == "stderr"]
    assert not [text for text in said if not only_progress(text)]
    kinds = {"text/html", "image/svg+xml", "image/png"}
    assert sum(1 for o in outputs if kinds & set(o.get("data", ()))) >= SHOWN[path.stem]
    assert list(work.iterdir()) == []
