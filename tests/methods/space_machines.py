"""Mechanisms in space that drawings are tested on, as trees."""

from __future__ import annotations

from typing import Any

import dalembert as da

Tree = dict[str, Any]

RSSR: Tree = {
    "title": "Spatial four-bar linkage RSSR",
    "space": "space",
    "units": {"length": "mm"},
    "gravity": "standard",
    "links": {
        "ground": {"points": {"A": [0, 0, 0], "D": [300, 100, 0]}},
        "crank": {
            "points": {"A": [0, 0, 0], "B": [80, 0, 0]},
            "mass": 0.5,
            "center": [30, 0, 0],
            "inertia": [100, 200, 300],
        },
        "coupler": {
            "points": {"B": [0, 0, 0], "C": [220, 100, 200]},
            "mass": 0.8,
            "center": [110, 50, 100],
            "inertia": 1000,
        },
        "rocker": {
            "points": {"D": [0, 0, 0], "C": [0, 0, 200]},
            "mass": 0.7,
            "center": [0, 0, 100],
            "inertia": [2000, 2000, 100],
        },
    },
    "joints": {
        "A": {"type": "revolute", "links": ["ground", "crank"], "axis": [0, 0, 1]},
        "B": {"type": "spherical", "links": ["crank", "coupler"]},
        "C": {"type": "spherical", "links": ["coupler", "rocker"]},
        "D": {"type": "revolute", "links": ["ground", "rocker"], "axis": [0, 1, 0]},
    },
    "drives": {"A": {"position": {"from": 0, "to": 360, "count": 36}, "speed": "10 rad/s"}},
    "loads": {"F_P": {"type": "force", "on": "rocker", "at": "C", "value": [-20, 10, 5]}},
}

SHAFT: Tree = {
    "title": "Shaft on two bearings with an eccentric mass",
    "space": "space",
    "units": {"length": "mm"},
    "gravity": "standard",
    "links": {
        "ground": {"points": {"A": [0, 0, 0], "B": [400, 0, 0]}},
        "shaft": {
            "points": {"A": [0, 0, 0], "B": [400, 0, 0], "K": [150, 0, 60]},
            "mass": 4,
            "center": [160, 0, 5],
            "inertia": [[1e4, 0, 2000], [0, 5e4, 0], [2000, 0, 5e4]],
        },
    },
    "joints": {
        "A": {"type": "spherical", "links": ["ground", "shaft"]},
        "B": {"type": "sphere_in_cylinder", "links": ["ground", "shaft"], "axis": [1, 0, 0]},
    },
    "drives": {"A": {"axis": [1, 0, 0], "position": {"from": 0, "to": 360, "count": 24}, "speed": "900 rpm"}},
    "loads": {"F_K": {"type": "force", "on": "shaft", "at": "K", "value": [30, 0, 40], "axes": "link"}},
}

HOOKE: Tree = {
    "title": "Hooke joint between two shafts",
    "space": "space",
    "units": {"length": "mm"},
    "links": {
        "ground": {"points": {"O": [-200, 0, 0], "E": [187.93852415718, 68.40402866513, 0]}},
        "input": {"points": {"O": [-200, 0, 0], "U": [0, 0, 0]}},
        "output": {"points": {"U": [0, 0, 0], "E": [200, 0, 0]}, "mass": 12, "inertia": [120000, 0, 0]},
    },
    "joints": {
        "O": {
            "type": "revolute",
            "links": ["ground", "input"],
            "axes": {"i": {"z": [1, 0, 0], "x": [0, 1, 0]}, "j": {"z": [1, 0, 0], "x": [0, 1, 0]}},
        },
        "U": {
            "type": "universal",
            "links": ["input", "output"],
            "axes": {"i": {"z": [0, 1, 0]}, "j": {"z": [0, 0, 1]}},
        },
        "E": {
            "type": "sphere_in_cylinder",
            "links": ["ground", "output"],
            "axes": {"i": {"x": [0.9396926207859084, 0.3420201433256687, 0]}, "j": {"x": [1, 0, 0]}},
        },
    },
    "drives": {"O": {"position": {"from": 0, "to": 360, "count": 24}, "speed": "500 rpm"}},
    "assembly": {"output": {"position": [0, 0, 0], "axis": [0, 0, 1], "angle": 20.0}},
}

PRESS: Tree = {
    "title": "Screw press",
    "space": "space",
    "units": {"length": "mm"},
    "gravity": "standard",
    "links": {
        "ground": {"points": {"N": [0, 0, 300], "G": [120, 0, 150]}},
        "spindle": {
            "points": {"N": [0, 0, 300], "H": [0, 150, 380], "K": [0, 0, 150], "T": [0, 0, 380]},
            "mass": 6,
            "center": [0, 0, 260],
            "inertia": [2e4, 2e4, 1e4],
        },
        "ram": {
            "points": {"K": [0, 0, 150], "G": [120, 0, 150], "P": [0, 0, 100]},
            "mass": 10,
            "center": [0, 0, 130],
        },
    },
    "joints": {
        "N": {"type": "screw", "links": ["ground", "spindle"], "axis": [0, 0, 1], "lead": 12},
        "K": {"type": "spherical", "links": ["spindle", "ram"]},
        "G": {"type": "prismatic", "links": ["ground", "ram"], "axis": [0, 0, 1]},
    },
    "drives": {"N": {"freedom": "turn", "position": {"from": 0, "to": 720, "count": 24}, "speed": "60 rpm"}},
    "loads": {"F_P": {"type": "force", "on": "ram", "at": "P", "value": [0, 0, 5000]}},
}

SLIDER_CRANK: Tree = {
    "title": "Spatial slider-crank RSUP",
    "space": "space",
    "gravity": "standard",
    "links": {
        "ground": {"points": {"O": [0, 0.1, 0.12], "S": [0, 0, 0]}},
        "crank": {"points": {"O": [0, 0, 0], "A": [0, 0, 0.08]}, "mass": 0.12, "center": [0, 0, 0.04]},
        "rod": {
            "points": {"A": [0, 0, 0], "B": [0.3, 0, 0]},
            "mass": 0.5,
            "center": [0.15, 0, 0],
            "inertia": [4e-4, 4e-3, 4e-3],
        },
        "slider": {"points": {"B": [0, 0, 0]}, "mass": 2},
    },
    "joints": {
        "O": {"type": "revolute", "links": ["ground", "crank"], "axis": [1, 0, 0]},
        "A": {"type": "spherical", "links": ["crank", "rod"]},
        "B": {
            "type": "universal",
            "links": ["slider", "rod"],
            "axes": {"i": {"z": [1, 0, 0]}, "j": {"z": [0, 1, 0]}},
        },
        "S": {"type": "prismatic", "links": ["ground", "slider"], "at": ["S", "B"], "axis": [1, 0, 0]},
    },
    "drives": {"O": {"position": {"from": 0, "to": 360, "count": 24}, "speed": "60 rpm"}},
    "assembly": {
        "crank": {"position": [0, 0.1, 0.12]},
        "rod": {"position": [0, 0.1, 0.2], "axis": [-0.457, 0.8657, -0.2044], "angle": 54.643},
        "slider": {"position": [0.2, 0, 0]},
    },
}

MACHINES = {"rssr": RSSR, "shaft": SHAFT, "hooke": HOOKE, "press": PRESS, "slider_crank": SLIDER_CRANK}


def solved(name: str, **changes: Any) -> Any:
    """A machine solved with inertia, some of its keys changed."""
    return da.dynamics(da.Mechanism.model_validate(MACHINES[name] | changes))


__all__ = ["MACHINES", "solved"]
