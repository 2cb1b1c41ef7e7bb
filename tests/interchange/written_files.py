"""Mechanisms written for another program and read back, with the same drives and no loads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da
from dalembert.interchange.file_formats import foreign_bytes, read_foreign
from dalembert.model.description import mechanism

FILES = Path(__file__).parent / "files"


def in_space(m: da.Mechanism) -> da.Mechanism:
    """The mechanism as the formats have it."""
    return m if m.space == "space" else da.lifted(m)


def driven_alike(m: da.Mechanism, like: da.Mechanism, drawn: bool) -> da.Mechanism:
    """A mechanism with the drives of another at their first position, without loads; drawn: counted from there."""
    tree: Any = m.to_tree()
    result = da.kinematics(like)
    tree["loads"], tree["answers"], tree["drives"] = {}, [], {}
    for name, drive in like.drives.items():
        joint = like.drive_joint(name)
        freedom = drive.freedom or like.joints[joint].freedoms[0]
        values = [
            float(of(name)[0])
            for of in (result.drive_position, result.drive_speed, result.drive_acceleration)
        ]
        unit = "m" if freedom.startswith("slide") else "rad"
        tree["drives"][name] = {
            "joint": joint,
            "freedom": freedom,
            "position": f"{0.0 if drawn else values[0]!r} {unit}",
            "speed": f"{values[1]!r} {unit}/s",
            "acceleration": f"{values[2]!r} {unit}/s^2",
        }
    return mechanism(tree)


def read_back(m: da.Mechanism, path: Path) -> tuple[da.Mechanism, list[str]]:
    """The mechanism of the file that is written, and what is not kept."""
    content, lost = foreign_bytes(m, path)
    path.write_bytes(content)
    return read_foreign(path)[0], lost


def largest_difference(m: da.Mechanism, back: da.Mechanism, drawn: bool = False) -> float:
    """Of the efforts of the first position, over the largest, or over the largest moment where all are 0."""
    space = in_space(m)
    ours, theirs = (da.dynamics(driven_alike(x, space, d)) for x, d in ((space, False), (back, drawn)))
    efforts = np.array([[r.effort(name)[0] for name in space.drives] for r in (ours, theirs)])
    size = float(np.abs(efforts[0]).max()) or float(np.nanmax(np.abs(ours.moment_array)))
    return float(np.abs(efforts[0] - efforts[1]).max() / size)
