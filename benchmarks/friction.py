"""Friction: Newton's iterations, and the time of a position against the same mechanism without friction.

Method. ``da.dynamics(m)`` is called on a loaded description at 720 positions of a whole turn, with friction and with
``friction: {enabled: false}``, in turns, after one warming call, one thread; medians of the time a position and their
ratio are printed, with the median and the worst number of Newton iterations, how many positions are proved to have one
solution, and the worst power balance. Mechanisms: the classic engine (circles of 28, 24 and 16 mm, the same with a
guide of 50 mm), and the bundled library with friction in every pin, guide and slot.

    python benchmarks/friction.py [--repeat 9] [--positions 720]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from statistics import median  # noqa: E402
from time import perf_counter  # noqa: E402
from typing import Any  # noqa: E402

import numpy as np  # noqa: E402

LIBRARY = """
    four_bar slider_crank inverted_slider_crank whitworth crank_shaper scotch_yoke watt_1 watt_2 stephenson_1
    stephenson_2 stephenson_3 toggle_press
"""
FRICTION: dict[str, dict[str, Any]] = {
    "pin": {"radius": "10 mm"},
    "slot": {"radius": "10 mm"},
    "slider": {"guide": ["40 mm", "60 mm"], "half_height": "10 mm"},
}


def engine(count: int, guide: str | None) -> dict[str, Any]:
    sliding: dict[str, Any] = {"coefficient": 0.07} | ({"guide": [guide, guide]} if guide else {})
    joints: dict[str, Any] = {
        name: {"type": "pin", "links": links, "friction": {"radius": radius}}
        for name, links, radius in (
            ("O", ["ground", "crank"], "70 mm"),
            ("A", ["crank", "rod"], "60 mm"),
            ("B", ["rod", "piston"], "40 mm"),
        )
    }
    joints["guide"] = {"type": "slider", "links": ["ground", "piston"], "at": ["O", "B"], "friction": sliding}
    return {
        "friction": {"coefficient": 0.4, "circle": "tan"},
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "crank": {"points": {"O": [0, 0], "A": [0.3, 0]}},
            "rod": {"points": {"A": [0, 0], "B": [1.25, 0]}},
            "piston": {"points": {"B": [0, 0]}},
        },
        "joints": joints,
        "drives": {"O": {"position": _turn(count), "speed": "1 rad/s"}},
        "loads": {"gas": {"type": "force", "on": "piston", "at": "B", "value": [-22089.3, 0]}},
        "assembly": {"rod": 0},
    }


def _turn(count: int) -> dict[str, Any]:
    """A whole turn that meets no dead centre."""
    return {"from": "0.13 deg", "to": "360.13 deg", "count": count}


def rough(template: str, count: int) -> dict[str, Any]:
    import dalembert as da

    tree: dict[str, Any] = getattr(da, template)().to_tree()
    tree["friction"] = {"coefficient": 0.1}
    for joint in tree["joints"].values():
        joint["friction"] = FRICTION[joint["type"]]
    for drive in tree["drives"].values():
        drive["position"] = _turn(count)
    return tree


def main() -> None:
    import dalembert as da

    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--repeat", type=int, default=9)
    parser.add_argument("--positions", type=int, default=720)
    given = parser.parse_args()
    count = given.positions
    mechanisms = {"engine": engine(count, None), "engine, guide 50 mm": engine(count, "50 mm")}
    mechanisms |= {name: rough(name, count) for name in LIBRARY.split()}
    print(
        "mechanism               contacts  without  with  ratio  iterations       proved  power    statuses"
    )
    print("                                  us/pos us/pos         median worst    single  balance")
    for name, tree in mechanisms.items():
        m = da.mechanism(tree)
        plain = m.with_values({"friction.enabled": False})
        times: dict[str, list[float]] = {"plain": [], "rough": []}
        for k in range(given.repeat + 1):
            for kind, which in (("plain", plain), ("rough", m)):
                start = perf_counter()
                r = da.dynamics(which)
                if k:
                    times[kind].append((perf_counter() - start) / count * 1e6)
        without, with_ = median(times["plain"]), median(times["rough"])
        f = r.friction
        assert f is not None
        statuses = {s: r.status.count(s) for s in dict.fromkeys(r.status)}
        print(
            f"{name:24s} {f.cz.shape[1]:6d} {without:8.1f} {with_:7.1f} {with_ / without:5.2f} "
            f"{np.median(f.iterations):6.0f} {f.iterations.max():6d} {f.single.mean():9.1%} "
            f"{np.nanmax(r.power_balance):9.1e}  {statuses}"
        )


if __name__ == "__main__":
    main()
