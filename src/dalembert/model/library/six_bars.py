"""What the six-bar linkages have in common: most of them start with a four-bar O2 A B O4."""

from __future__ import annotations

from dalembert.arrays import Tree
from dalembert.model.library.compass import Points, angle, meet, vector_at
from dalembert.model.library.tree_parts import Point, pin, positive


def check_six_bar(template: str, mass_per_length: float, mass_per_area: float, **lengths: float) -> None:
    positive(template, **lengths)
    positive(template, "kg/m", mass_per_length=mass_per_length)
    positive(template, "kg/m2", mass_per_area=mass_per_area)


def four_bar_points(turn: float, ground: float, crank: float, coupler: float, rocker: float) -> Points:
    a, o4 = vector_at(crank, turn), complex(ground)
    return {"A": a, "B": meet(a, ("coupler", coupler), o4, ("rocker", rocker)), "O2": 0j, "O4": o4}


def on_link(start: complex, end: complex, local: complex) -> complex:
    """A point of the link from start to end, given in its own axes."""
    return start + local * (end - start) / abs(end - start)


def ground_link(**points: Point) -> Tree:
    return {"points": {"O2": [0.0, 0.0]} | {name: list(point) for name, point in points.items()}}


def four_pins() -> Tree:
    return {
        "O2": pin("ground", "crank"),
        "A": pin("crank", "coupler"),
        "B": pin("coupler", "rocker"),
        "O4": pin("ground", "rocker"),
    }


def output_pins(driver: str) -> Tree:
    return {
        "C": pin(driver, "second_coupler"),
        "D": pin("second_coupler", "output"),
        "O6": pin("ground", "output"),
    }


def angles(at: Points, **links: str | tuple[str, str]) -> dict[str, float]:
    return {link: angle(at, *ends) for link, ends in links.items()}
