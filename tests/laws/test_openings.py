"""What is said of a linkage that does not close: the gap as a length or an angle, with its unit and the joint."""

import math
import re

import numpy as np
import pytest

import dalembert as da

TOTAL = re.compile(r"remain ([\d.e-]+) (mm|deg) (apart|out of line) in total, (equally|mostly) at \w+")


def reason(tree: dict, count: int | None = None) -> str:  # type: ignore[type-arg]
    found = da.kinematics(da.Mechanism(**tree), positions=count).reasons[-1]
    assert found is not None
    return found


def pins(*rows: tuple[str, str, str]) -> dict[str, object]:
    return {name: {"type": "pin", "links": [i, j]} for name, i, j in rows}


def four_bar(crank: float, coupler: float, rocker: float, ground: float, degrees: float) -> dict[str, object]:
    return {
        "units": {"length": "mm"},
        "links": {
            "ground": {"points": {"O": [0, 0], "C": [ground / 1000, 0]}},
            "crank": {"points": {"O": [0, 0], "A": [crank / 1000, 0]}},
            "coupler": {"points": {"A": [0, 0], "B": [coupler / 1000, 0]}},
            "rocker": {"points": {"C": [0, 0], "B": [rocker / 1000, 0]}},
        },
        "joints": pins(
            ("O", "ground", "crank"),
            ("A", "crank", "coupler"),
            ("B", "coupler", "rocker"),
            ("C", "ground", "rocker"),
        ),
        "drives": {"O": {"position": math.radians(degrees)}},
    }


@pytest.mark.parametrize("seed", range(10))
def test_the_sum_of_the_gaps_is_what_the_links_are_too_short(seed: int) -> None:
    """Least squares stretches coupler and rocker along the line from A to C, all joints by the same."""
    rng = np.random.default_rng(seed)
    crank, coupler, rocker, ground, angle = (
        *rng.uniform(20, 100, 3),
        rng.uniform(250, 400),
        rng.uniform(0, 360),
    )
    distance = math.hypot(
        crank * math.cos(math.radians(angle)) - ground, crank * math.sin(math.radians(angle))
    )
    said = reason(four_bar(crank, coupler, rocker, ground, angle))
    found = TOTAL.search(said)
    assert found is not None, said
    assert (found[2], found[3]) == ("mm", "apart")
    assert float(found[1]) == pytest.approx(distance - coupler - rocker, rel=0.05)
    assert found[4] == "equally"


def test_the_whole_sentence_in_the_units_of_the_file() -> None:
    assert reason(four_bar(60, 60, 60, 200, 180)) == (
        "The linkage does not close at O = 180 deg: the points of its joints remain 140 mm apart in total, equally at "
        "O, A, B, C. Change a length or the assembly, or give O another range."
    )


def test_guides_across_each_other_are_out_of_line_by_an_angle() -> None:
    tree = {
        "links": {
            "ground": {"points": {"O": [0, 0], "G": [0, 0]}},
            "crank": {"points": {"O": [0, 0], "H": [0, 0]}},
        }
        | {"block": {"points": {"G": [0, 0], "H": [0, 0]}}},
        "joints": pins(("O", "ground", "crank"))
        | {"G": {"type": "slider", "links": ["ground", "block"], "direction": 0.0}}
        | {"H": {"type": "slider", "links": ["crank", "block"], "direction": 0.0}},
        "drives": {"O": {"position": math.radians(30)}},
    }
    said = reason(tree)
    assert "the axes of its joints remain 30 deg out of line in total" in said
    assert "apart" not in said
    assert "Change a direction or the assembly" in said


def test_axes_in_space_are_out_of_line_by_the_angle_itself() -> None:
    """Two hinges on one shaft, 40 deg to each other: not the sine of the angle that is left at each."""
    tilted = [math.sin(math.radians(40)), 0, math.cos(math.radians(40))]
    tree = {
        "space": "space",
        "links": {
            "ground": {"points": {"A": [0, 0, 0], "B": [0, 0, 0]}},
            "shaft": {"points": {"A": [0, 0, 0], "B": [0, 0, 0]}},
        },
        "joints": {
            "A": {"type": "revolute", "links": ["ground", "shaft"], "axis": [0, 0, 1]},
            "B": {
                "type": "revolute",
                "links": ["ground", "shaft"],
                "axes": {"i": {"z": [0, 0, 1]}, "j": {"z": tilted}},
            },
        },
    }
    found = TOTAL.search(reason(tree))
    assert found is not None
    assert found[2] == "deg"
    assert float(found[1]) == pytest.approx(40, rel=0.01)
