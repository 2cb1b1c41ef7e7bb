"""What is printed of a study: designs, extremes and shares, in the units of the model file, against da.dynamics."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.studies.output.study_text import (
    contributions_text,
    design_text,
    extreme_rows,
    output_rows,
    summary,
)

M = da.loads(
    """
units: {length: mm, mass: g, force: N, moment: N*mm}
links:
  ground: {points: {O2: [0, 0], O4: [300, 0]}}
  crank: {points: {O2: [0, 0], A: [90, 0]}, mass: 180, center: [45, 0]}
  coupler: {points: {A: [0, 0], B: [280, 0]}, mass: 600, center: [140, 0]}
  rocker: {points: {O4: [0, 0], B: [220, 0]}, mass: 450, center: [110, 0]}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives: {O2: {position: {from: 0, to: 240, count: 3}, speed: 20 rad/s}}
assembly: {coupler: 50, rocker: 100}
"""
)
VARY = {"links.crank.mass": "± 1 %", "links.ground.points.O4.0": "299..302 mm", "links.coupler.mass": "± 5 %"}


@pytest.fixture(scope="module")
def study() -> Any:
    return da.study(M, VARY, ["effort.O2", "reaction.A.magnitude"], designs=32, seed=5)


def effort(numbers: dict[str, float]) -> float:
    return float(np.abs(da.dynamics(M.with_values(numbers)).effort("O2")).max())


def table_of(text: str) -> list[list[str]]:
    head, line, *rows = text.splitlines()
    assert set(line) == {"-"}
    assert len(line) == max(map(len, [head, *rows]))
    return [row.split() for row in (head, *rows)]


def test_a_design_is_printed_in_the_units_of_its_file(study: Any) -> None:
    numbers = study.design(3)
    unit = {
        "links.coupler.mass": (1e3, "g"),
        "links.ground.points.O4.0": (1e3, "mm"),
        "links.crank.mass": (1e3, "g"),
    }
    text = design_text(study, 3)
    assert table_of(text) == [
        ["number", "design", "3", "unit"],
        *([path, f"{x * unit[path][0]:.12g}", unit[path][1]] for path, x in numbers.items()),
    ]
    names = [line[: len("links.ground.points.O4.0")] for line in text.splitlines()[2:]]
    assert [name.rstrip() for name in names] == [*VARY]  # on the left; the numbers end in one column
    assert len({len(line.rsplit(" ", 1)[0].rstrip()) for line in text.splitlines()[2:]}) == 1


def test_extremes_are_the_designs_of_the_least_and_the_greatest(study: Any) -> None:
    """Each with its numbers beside those of the file; the output is computed anew for all three."""
    r = study.run()
    every = [effort(study.design(n)) for n in range(32)]
    best, worst = int(np.argmin(every)), int(np.argmax(every))
    assert (r.best("effort.O2"), r.worst("effort.O2")) == (best, worst)
    designs = [{"links.crank.mass": 0.18, "links.ground.points.O4.0": 0.3, "links.coupler.mass": 0.6}]
    designs += [study.design(n) for n in (best, worst)]
    units = dict(zip(VARY, ("g", "mm", "g"), strict=True))
    rows = [[path, units[path], *(f"{1e3 * d[path]:.6g}" for d in designs)] for path in VARY]
    assert extreme_rows(r, "effort.O2") == [
        *rows,
        ["effort.O2", "N*mm", *(f"{1e3 * effort(d):.6g}" for d in designs)],
    ]
    heads, lines = output_rows(r)
    assert heads[:4] == ["output", "unit", "mean", "sigma"]
    assert heads[-2:] == ["least (design)", "greatest (design)"]
    assert lines[0][:4] == ["effort.O2", "N*mm", f"{1e3 * np.mean(every):.5g}", f"{1e3 * np.std(every):.5g}"]
    assert lines[0][-2:] == [f"{1e3 * every[n]:.5g} ({n})" for n in (best, worst)]
    assert "effort.O2" in summary(r)


def test_shares_are_printed_the_largest_first_with_the_worst_case(study: Any) -> None:
    """Sigma by slopes and sigmas of the spreads; of all corners the worst."""
    spreads = study.plan.spreads
    middle = {path: float(np.mean(s.ends)) for path, s in zip(VARY, spreads, strict=True)}
    slopes = []
    for path, s in zip(VARY, spreads, strict=True):
        step = 1e-4 * s.sigma
        both = [effort({**middle, path: middle[path] + way * step}) for way in (1, -1)]
        slopes.append((both[0] - both[1]) / (2 * step) * s.sigma)
    total = float(np.hypot.reduce(slopes))
    shares = {path: (x / total) ** 2 for path, x in zip(VARY, slopes, strict=True)}
    worst = max(
        effort(dict(zip(VARY, corner, strict=True))) for corner in product(*(s.ends for s in spreads))
    )
    first, _ = contributions_text(study, "linear").split("\n\n")
    title, *rest = first.splitlines()
    assert title == (
        f"effort.O2 (linear): sigma {1e3 * total:.5g} N*mm; worst case {1e3 * worst:.5g} N*mm (the largest of all 8 "
        "corners; interior points are not searched)"
    )
    order = sorted(shares, key=lambda path: -shares[path])
    assert table_of("\n".join(rest)) == [
        ["number", "share", "of", "the", "variance"],
        *([path, f"{shares[path]:.2%}"] for path in order),
    ]
    sobol = contributions_text(study, "sobol").split("\n\n")[0].splitlines()
    found = study.contributions("effort.O2", "sobol")
    assert (
        " ".join(table_of("\n".join(sobol[1:5]))[0]) == "number share of the variance with its interactions"
    )
    lead = max(found.shares, key=lambda path: found.shares[path])
    assert sobol[3].split() == [lead, f"{found.shares[lead]:.2%}", f"{found.total[lead]:.2%}"]
