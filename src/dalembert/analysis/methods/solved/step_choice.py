"""Choices of the reader for the steps: the link to begin with, the point of moments, the axes of the sums."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.units import file_units, quantity
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class Choice:
    """The link to begin with, the joint or point (m) to take moments about, the angle of the first axis (rad)."""

    begin: str = ""
    about: str | tuple[float, ...] = ""
    along: float = 0.0


def read_choice(
    r: Result, begin: str = "", about: str | tuple[float, ...] = "", along: float | str = 0
) -> Choice:
    """A choice with known names; ModelError, with the nearest, for others."""
    if begin and begin not in r.links:
        raise ModelError(f"unknown link {begin!r} to begin with", closest(begin, list(r.links)))
    if isinstance(about, str):
        if about and about not in r.joints:
            raise ModelError(f"unknown joint {about!r} to take moments about", closest(about, list(r.joints)))
    else:
        about = tuple(float(x) for x in about)
        if len(about) != r.mechanism.dimension:
            raise ModelError(
                f"a point to take moments about has {r.mechanism.dimension} coordinates, not {len(about)}",
                "give them in metres",
            )
    angle = quantity(along, "angle", file_units(r.mechanism.units)) if along else 0.0
    if angle and r.mechanism.dimension == 3:
        raise ModelError("axes of sums are turned in the plane only", "leave along out")
    return Choice(begin, about, angle)
