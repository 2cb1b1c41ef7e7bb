"""Curves of motors in text files: columns speed and torque."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

from dalembert.errors import ModelError
from dalembert.model.drives.motors import MotorCurve
from dalembert.model.part import ReadingRules
from dalembert.model.quantities.column_files import read_quantities
from dalembert.units import Units


def read_curve(file: str | Path, units: Units | None = None) -> MotorCurve:
    """The curve; numbers whose head names no unit are in these (default SI). Raises ModelError with file and line."""
    kinds = {"speed": "angular_speed", "torque": "moment"}
    columns, lines = read_quantities(file, kinds, ReadingRules(units))
    for (a, b), line in zip(pairwise(columns["speed"]), lines[1:], strict=True):
        if not a < b:
            what = "speeds of the curve must increase: this one is not greater than the one before"
            raise ModelError(what, "give each speed once, rising", (), str(file), line)
    return MotorCurve(tuple(columns["speed"]), tuple(columns["torque"]))
