"""Solids within closed surfaces, read from STL files with the package trimesh."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from pydantic import ValidationInfo

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.part import reading
from dalembert.model.quantities.values import JsonSchema, ValueField, check_sign, value_text
from dalembert.saving import check_installed
from dalembert.unit_names import unit
from dalembert.units import KINDS, quantity
from dalembert.wording import quote_value

LARGEST = 50_000_000
"""Bytes of a mesh."""


@dataclass(frozen=True)
class MeshFile:
    """A mesh's path as it is written, and the folder it is relative to."""

    written: str
    folder: str = ""

    @property
    def path(self) -> Path:
        """Path of the file."""
        return Path(self.folder) / self.written


class MeshFileValue(ValueField):
    """The path of an .stl file, relative to the model file."""

    def read(self, value: object, info: ValidationInfo) -> MeshFile:
        if isinstance(value, MeshFile):
            return value
        if not isinstance(value, str) or not value.lower().endswith(".stl"):
            raise ModelError(
                f"{quote_value(value)} is not an STL file", "name one, for example file: rod.stl"
            )
        return MeshFile(value, reading(info).folder)

    def write(self, value: MeshFile) -> object:
        return value.written

    def json_schema(self) -> JsonSchema:
        return {"type": "string"}


class MeshUnit(ValueField):
    """A unit of length, or a length: what 1 in the file is."""

    def read(self, value: object, info: ValidationInfo) -> float:
        units = reading(info).units
        if value is None:
            return quantity(1, "length", units)
        named = isinstance(value, str) and value[:1].isalpha()
        if named and unit(str(value)).dimension == KINDS["length"].dimension:
            value = f"1 {value}"
        return check_sign(quantity(value, "length", units), value, "positive")

    def write(self, value: float) -> object:
        return value_text(value, "length")


def mesh_solid(file: MeshFile) -> tuple[float, Array, Array]:
    """Volume, centre (3,) and inertia (3, 3) about it at a density of 1, in the unit of length of the mesh."""
    check_installed("trimesh", "a mesh", "cad")
    try:
        state = os.stat(file.path)
    except (OSError, ValueError):
        problem = f"file {file.written!r} does not exist"
        raise ModelError(problem, "check the name; it is relative to the model file") from None
    if not file.path.is_file() or state.st_size > LARGEST:
        what = "is not an ordinary file" if not file.path.is_file() else f"has more than {LARGEST} bytes"
        raise ModelError(f"the mesh {file.written!r} {what}", "name an STL file of a coarser mesh")
    return _read(file, state.st_mtime_ns)


@lru_cache(maxsize=64)
def _read(file: MeshFile, changed: int) -> tuple[float, Array, Array]:
    """Read once as long as the file stays as it is."""
    import trimesh

    try:
        mesh = trimesh.load_mesh(file.path, file_type="stl")
    except Exception as error:  # the package raises errors of many kinds for a file that is no mesh
        problem = f"the mesh {file.written!r} cannot be read: {error}"
        raise ModelError(problem, "export it again as STL") from None
    if not len(mesh.faces):  # those with a corner that is no number are left out
        what = f"the mesh {file.written!r} has no triangle whose corners are all numbers"
        raise ModelError(what, "export it again as STL")
    if not mesh.is_watertight or not mesh.is_winding_consistent:
        what = f"the surface of the mesh {file.written!r} is not closed, so it has no volume"
        raise ModelError(what, "close its holes, or give mass, center and inertia")
    if mesh.volume < 0:
        mesh.invert()
    middle = np.array(mesh.center_mass, float)
    mesh.density = 1.0
    return float(mesh.volume), middle, np.array(mesh.moment_inertia, float)
