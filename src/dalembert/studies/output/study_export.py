"""All designs of a study in one file."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from dalembert.errors import ModelError
from dalembert.saving import check_new, new_file
from dalembert.studies.study_result import StudyResult
from dalembert.units import KINDS


def export_study(r: StudyResult, path: Path, overwrite: bool = False) -> None:
    """Writes numbers, status and outputs of the computed designs, SI, as .csv or netCDF."""
    check_new(path, overwrite)
    if path.suffix.lower() not in (".csv", ".nc"):
        raise ModelError(f"{path.name}: a study is exported as .csv or .nc", "name a file that ends so")
    if path.suffix.lower() == ".nc":
        with new_file(path, overwrite) as temporary:
            r.to_xarray().to_netcdf(temporary, engine="h5netcdf")
        return
    with new_file(path, overwrite) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(
            ["design", *r.study.paths, "status", *(h for name in r.study.outputs for h in _heads(r, name))]
        )
        status = r.status
        for b in np.flatnonzero(r.ledger[:, 0]):
            start, stop = int(b) * r.block, min((int(b) + 1) * r.block, r.study.count)
            outputs = [
                np.asarray(r.arrays[name][start:stop]).reshape(stop - start, -1) for name in r.study.outputs
            ]
            values, found = (
                r.study.plan.values(start, stop).tolist(),
                np.concatenate(outputs, axis=1).tolist(),
            )
            for k, (numbers, answers) in enumerate(zip(values, found, strict=True)):
                writer.writerow([start + k, *numbers, status[start + k], *answers])


def _heads(r: StudyResult, name: str) -> list[str]:
    """A column's head of each number that a design has of an output."""
    unit = KINDS[r.kinds[name]].si
    shown = f" [{unit}]" if unit else ""
    shape = r.arrays[name].shape[1:]
    return [".".join([name, *(str(k + 1) for k in place)]) + shown for place in np.ndindex(*shape)]
