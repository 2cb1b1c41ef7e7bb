"""Links that only two balls hold: what counts as held, and where the line that they may spin about moves in them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da

Tree = dict[str, Any]


def sliding_rod(guide_on_rod: bool, drives: Tree) -> Tree:
    """A rod from a ball on the ground to a ball in a straight guide, which is the rod's or the ground's."""
    ends = ["rod", "ground"] if guide_on_rod else ["ground", "rod"]
    guide = {"type": "sphere_in_cylinder", "links": ends, "axis": [0.48, 0.6, 0.64], "at": ["G", "G"]}
    return {
        "space": "space",
        "links": {
            "ground": {"points": {"O": [0, 0, 0], "G": [0.3, 0.9, 0.2]}},
            "crank": {"points": {"O": [0, 0, 0], "A": [0.2, 0.1, 0.1]}},
            "rod": {"points": {"A": [0.2, 0.1, 0.1], "G": [0.3, 0.9, 0.2]}},
        },
        "joints": {
            "O": {"type": "revolute", "links": ["ground", "crank"], "axis": [0.1, 0.2, 1.0]},
            "A": {"type": "spherical", "links": ["crank", "rod"]},
            "guide": guide,
        },
        "drives": drives,
        "loads": {"T": {"type": "couple", "on": "crank", "value": [1.0, 2.0, 3.0]}},
    }


@pytest.mark.parametrize("guide_on_rod", [True, False])
def test_a_rod_with_its_own_guide_closes_too(guide_on_rod: bool) -> None:
    """Turning it about the line of its points, where that is not the line of the balls, would open it."""
    turn = {"O": {"position": {"from": 0, "to": 40, "count": 9}, "speed": "1 rad/s"}}
    r = da.dynamics(da.mechanism(sliding_rod(guide_on_rod, turn)))
    assert set(r.status) == {"ok"}, r.problems()
    assert r.mobility is not None
    assert r.mobility.passive == ("rod",)
    link = "rod" if guide_on_rod else "ground"
    axis = np.array([0.48, 0.6, 0.64])
    axes = r.rotation("rod") @ axis if guide_on_rod else np.tile(axis, (9, 1))
    own, other = r.point("rod", "G"), np.array([0.3, 0.9, 0.2])
    away = other - own
    off = away - np.sum(away * axes, -1, keepdims=True) * axes
    assert np.max(np.abs(off)) < 1e-12, link


def test_a_driven_slide_does_not_stop_the_spin() -> None:
    slide = {
        "guide": {"freedom": "slide", "position": {"from": 0, "to": "0.1 m", "count": 5}, "speed": "1 m/s"}
    }
    r = da.dynamics(da.mechanism(sliding_rod(False, slide)))
    assert set(r.status) == {"ok"}, r.problems()
    assert r.mobility is not None
    assert r.mobility.passive == ("rod",)


def test_a_driven_turn_does() -> None:
    both = {
        "O": {"position": {"from": 0, "to": 20, "count": 3}, "speed": "1 rad/s"},
        "spin": {"joint": "A", "freedom": "turn", "axis": [0.1, 0.8, 0.1], "position": "0 deg"},
    }
    r = da.dynamics(da.mechanism(sliding_rod(False, both)))
    assert set(r.status) == {"ok"}, r.problems()
    assert r.mobility is not None
    assert r.mobility.passive == ()


def test_a_ball_in_a_guide_is_driven_in_both_its_slide_and_its_turn() -> None:
    """The turn's axis belongs to its own drive, whichever drive of the joint comes first."""
    guide = {"type": "sphere_in_cylinder", "links": ["ground", "ball"], "axis": [0, 0, 1], "at": ["O", "O"]}
    made = {
        "space": "space",
        "links": {
            "ground": {"points": {"O": [0, 0, 0], "P": [1, 0, 0]}},
            "ball": {"points": {"O": [0, 0, 0], "P": [1, 0, 0]}, "mass": 1.0, "inertia": [1.0, 1.0, 1.0]},
        },
        "joints": {
            "guide": guide,
            "hold": {"type": "sphere_between_planes", "links": ["ground", "ball"], "axis": [0, 1, 0], "at": ["P", "P"]},
            "rest": {"type": "sphere_between_planes", "links": ["ground", "ball"], "axis": [0, 0, 1], "at": ["P", "P"]},
        },
        "drives": {
            "lift": {"joint": "guide", "freedom": "slide", "position": "0 m", "speed": "0.5 m/s"},
            "roll": {"joint": "guide", "freedom": "turn", "axis": [1, 0, 0], "position": "30 deg", "speed": "2 rad/s"},
        },
    }  # fmt: skip
    r = da.dynamics(da.mechanism(made))
    assert set(r.status) == {"ok"}, r.problems()
    assert r.freedom("guide", "turn")[0] == pytest.approx(np.radians(30))
    assert r.freedom("guide", "slide")[1] == pytest.approx(0.5)
    assert r.speed("ball")[0, 0] == pytest.approx(2.0)


def test_the_turn_of_a_ball_does_not_depend_on_the_axes_that_its_links_are_described_in() -> None:
    """A direction of i is seen from one with the same components in the joint's axes, not in the links'."""
    turn = np.array([[0.0, -1.0, 0.0], [0.6, 0.0, -0.8], [0.8, 0.0, 0.6]])
    efforts = []
    for r in (np.eye(3), turn):

        def local(v: Any, r: Any = r) -> list[float]:
            return list(map(float, r.T @ np.array(v)))

        axes = {"i": {"x": local([1, 0, 0]), "z": local([0, 0, 1])}, "j": {"x": [1, 0, 0], "z": [0, 0, 1]}}
        upside = {"i": {"x": local([0, 1, 0]), "z": local([0, 0, 1])}, "j": {"x": [0, 1, 0], "z": [0, 0, 1]}}
        inertia = r.T @ np.diag([1.0, 2.0, 2.5]) @ r
        made = {
            "space": "space",
            "links": {
                "ground": {"points": {"O": [0, 0, 0], "P": [1, 0.2, 0]}},
                "arm": {"points": {"O": [0, 0, 0], "P": local([1, 0.2, 0])}, "mass": 1.0,
                        "center": local([0.5, 0.5, 0.1]), "inertia": ((inertia + inertia.T) / 2).tolist()},
            },
            "joints": {
                "O": {"type": "spherical", "links": ["arm", "ground"], "axes": axes},
                "P": {"type": "sphere_in_cylinder", "links": ["arm", "ground"], "axes": upside, "at": ["P", "P"]},
            },
            "drives": {
                "O": {"freedom": "turn", "axis": local([1.0, 0.2, 0.3]), "position": "10 deg", "speed": "2 rad/s"},
            },
            "assembly": {"arm": _pose(r)},
        }  # fmt: skip
        result = da.dynamics(da.mechanism(made))
        assert set(result.status) == {"ok"}, result.problems()
        efforts.append(float(result.effort("O")[0]))
    assert efforts[0] == pytest.approx(efforts[1], rel=1e-11)


def _pose(r: Any) -> Tree:
    w = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    angle = float(np.degrees(np.arctan2(np.linalg.norm(w), np.trace(r) - 1)))
    return {"position": [0, 0, 0], "axis": w.tolist() if angle else [0, 0, 1], "angle": angle}
