"""What an optional package is needed for is refused where it lacks: by its name, with the line that installs it."""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import DalembertError
from dalembert.interchange.sketches.dxf_skeletons import read_dxf
from dalembert.model import StlMesh
from dalembert.model.links.stl_solids import MeshFile
from dalembert.studies.object_store import backend
from dalembert.studies.store import Store
from tests.answers.every_answer import made
from tests.exams.test_variants import bracket


def variants() -> Any:
    return da.variants(
        bracket(value=100, direction="30 deg"), {"loads.F.value": [80.0, 100.0]}, count=2, seed=1
    )


def mesh(folder: Path) -> StlMesh:
    (folder / "box.stl").write_text("solid box\nendsolid box\n")
    return StlMesh(file=MeshFile("box.stl", str(folder)), density=1)


LACKING: dict[str, tuple[str, str, Callable[[Path], Any], str]] = {
    "labelled arrays": ("xarray", "results", lambda _: made("Result").to_xarray(), "a dataset"),
    "netCDF": ("h5netcdf", "results", lambda p: made("Result").save(p / "a.nc"), "a netCDF file"),
    "frames": ("pandas", "results", lambda _: made("Result").to_dataframe(), "a DataFrame"),
    "workbooks": ("openpyxl", "results", lambda p: made("Flywheel").save(p / "a.xlsx"), "a workbook"),
    "meshes": ("trimesh", "cad", mesh, "a mesh"),
    "DXF": ("ezdxf", "cad", lambda p: made("Result").save(p / "a.dxf"), "writing DXF"),
    "skeletons": ("ezdxf", "cad", lambda _: read_dxf(b"", "a.dxf"), "A DXF skeleton"),
    "pictures": ("matplotlib", "plot", lambda p: made("Result").draw().save(p / "a.png"), "writing PNG"),
    "figures": ("matplotlib", "plot", lambda p: made("Result").draw().save(p / "a.pdf"), "writing PDF"),
    "reports": ("typst", "report", lambda p: made("Result").report().save(p / "a.html"), "writing HTML"),
    "printed reports": (
        "typst",
        "report",
        lambda p: made("Result").report().save(p / "a.pdf"),
        "writing PDF",
    ),
    "exams": ("typst", "report", lambda p: variants().save(p / "exam"), "writing question sheets"),
    "stores": ("zarr", "study", lambda p: Store(p / "store"), "a stored study"),
    "stores elsewhere": (
        "fsspec",
        "cloud",
        lambda _: backend("s3://runs", "s3://runs/a"),
        "a study at s3://runs/a",
    ),
    "widgets": ("anywidget", "notebook", lambda _: da.widget(da.load(examples()["four_bar"])), "a widget"),
}


@pytest.mark.parametrize("name", LACKING)
def test_what_needs_a_package_that_lacks_says_how_to_install_it(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package, extra, ask, what = LACKING[name]
    before = sorted(tmp_path.iterdir())
    made("Result")
    made("Flywheel")
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(DalembertError) as refused:
        ask(tmp_path)
    remedy = f"pip install 'dalembert[{extra}]'"
    assert str(refused.value) == f"{what} needs the package {package}, which is not installed; {remedy}"
    assert sorted(p for p in tmp_path.iterdir() if p.suffix != ".stl") == before


def test_the_line_that_installs_a_package_does() -> None:
    """Each extra that is named lists the package."""
    project = Path(__file__).parents[2] / "pyproject.toml"
    extras = tomllib.loads(project.read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    for package, extra, _, _ in LACKING.values():
        assert package in {re.split(r"[<>=]", one)[0] for one in extras[extra]}, package
