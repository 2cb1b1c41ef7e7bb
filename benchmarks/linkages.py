"""Linkages of the benchmarks: a four-bar with everything loaded, and chains of a crank and two-link groups."""

from __future__ import annotations

from typing import Any

import dalembert as da

FOUR_BAR = {
    "links.crank.points.A.0": 0.1,
    "links.coupler.points.B.0": 0.32,
    "links.rocker.points.B.0": 0.25,
    "links.ground.points.O4.0": 0.3,
    "links.ground.points.O4.1": 0.02,
    "links.crank.mass": 1.5,
    "links.crank.center.0": 0.02,
    "links.crank.center.1": 0.01,
    "links.crank.inertia": 0.01,
    "links.coupler.mass": 2.5,
    "links.coupler.center.0": 0.13,
    "links.coupler.center.1": 0.06,
    "links.coupler.inertia": 0.05,
    "links.rocker.mass": 2.0,
    "links.rocker.center.0": 0.1,
    "links.rocker.center.1": 0.01,
    "links.rocker.inertia": 0.03,
    "loads.P.value.0": 69.0,
    "loads.P.value.1": -40.0,
    "links.coupler.points.P.0": 0.1,
    "links.coupler.points.P.1": 0.12,
    "loads.T.value": 12.0,
    "drives.O2.speed": 25.0,
    "drives.O2.acceleration": -40.0,
}
"""The 24 numbers of the four-bar, in the order of hand.c; all of them vary."""


def pin(i: str, j: str, at: list[str] | None = None) -> dict[str, Any]:
    return {"type": "pin", "links": [i, j]} | ({"at": at} if at else {})


def four_bar(positions: int = 720) -> Any:
    """Crank, coupler and rocker with masses, a force on the coupler and a couple on the rocker."""
    v = FOUR_BAR

    def link(name: str, **points: list[float]) -> dict[str, Any]:
        own = {k: v[f"links.{name}.{k}"] for k in ("mass", "inertia")}
        return own | {"points": points, "center": [v[f"links.{name}.center.0"], v[f"links.{name}.center.1"]]}

    tree = {
        "links": {
            "ground": {"points": {"O2": [0, 0], "O4": [0.3, 0.02]}},
            "crank": link("crank", O2=[0, 0], A=[0.1, 0]),
            "coupler": link("coupler", A=[0, 0], B=[0.32, 0], P=[0.1, 0.12]),
            "rocker": link("rocker", O4=[0, 0], B=[0.25, 0]),
        },
        "joints": {
            "O2": pin("ground", "crank"),
            "A": pin("crank", "coupler"),
            "B": pin("coupler", "rocker"),
            "O4": pin("ground", "rocker"),
        },
        "drives": {
            "O2": {
                "position": {"from": 0, "to": 360, "count": positions},
                "speed": "25 rad/s",
                "acceleration": "-40 rad/s^2",
            }
        },
        "loads": {
            "P": {"type": "force", "on": "coupler", "at": "P", "value": [69, -40]},
            "T": {"type": "couple", "on": "rocker", "value": 12},
        },
        "assembly": {"coupler": 20, "rocker": 70},
    }
    return da.mechanism(tree)


def chain(groups: int, positions: int = 720) -> Any:
    """A crank and ``groups`` two-link groups, each hung on the rocker before it: 2 + 2 groups links with the ground."""
    links: dict[str, Any] = {
        "ground": {"points": {"O": [0, 0]}},
        "crank": {"points": {"O": [0, 0], "A0": [0.1, 0]}, "mass": 1, "center": [0.05, 0], "inertia": 0.01},
    }
    joints = {"O": pin("ground", "crank")}
    loads: dict[str, Any] = {}
    before, where = "crank", (0.0, 0.0)
    for k in range(groups):
        where = (where[0] + 0.3, 0.02 * (k % 2))
        links["ground"]["points"][f"G{k}"] = list(where)
        rod, rocker = f"rod{k}", f"rocker{k}"
        mass = {"mass": 1 + 0.1 * k, "inertia": 0.02}
        links[rod] = mass | {"points": {f"A{k}": [0, 0], f"B{k}": [0.3, 0]}, "center": [0.14, 0]}
        links[rocker] = mass | {
            "points": {f"G{k}": [0, 0], f"B{k}": [0.22, 0], f"A{k + 1}": [0.22, 0]},
            "center": [0.1, 0],
        }
        joints[f"A{k}"] = pin(before, rod)
        joints[f"B{k}"] = pin(rod, rocker)
        joints[f"G{k}"] = pin("ground", rocker)
        loads[f"T{k}"] = {"type": "couple", "on": rocker, "value": 3}
        before = rocker
    drive = {
        "position": {"from": 0, "to": 360, "count": positions},
        "speed": "10 rad/s",
        "acceleration": "5 rad/s^2",
    }
    guess = {f"rocker{k}": 90 for k in range(groups)} | {f"rod{k}": 30 for k in range(groups)}
    tree = {"links": links, "joints": joints, "drives": {"O": drive}, "loads": loads, "assembly": guess}
    return da.mechanism(tree)
