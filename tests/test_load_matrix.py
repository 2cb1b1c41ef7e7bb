"""Loads by everything that they may depend on, in every analysis, against closed forms of a slider-crank.

A force F along the guide, on a block of mass m at s(q), asks the crank for the effort (m a - F) ds/dq: virtual work.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da
from dalembert.pages.page_data import page_data
from tests.engine.comparing import counted
from tests.pages.test_page_data import run_page, series
from tests.tiers import tiers

R, L, M, J, SPEED = 0.05, 0.2, 3.0, 0.4, 20.0

Known = dict[str, Any]
"""What a load may go by at states: time t, crank q and w, slide s and v, rod f and fw, pin A's turn a and aw."""


def slide(q: Any, r: float = R) -> tuple[Any, Any, Any]:
    """The block's place and its first two derivatives by the crank's angle."""
    n, c = r * np.sin(q), r * np.cos(q)
    w = np.sqrt(L * L - n * n)
    return c + w, -n - n * c / w, -c - (c * c - n * n) / w - (n * c) ** 2 / w**3


def state(t: Any, q: Any, w: Any, r: float = R) -> Known:
    f, by = -np.arcsin(r * np.sin(q) / L), -r * np.cos(q) / np.sqrt(L * L - (r * np.sin(q)) ** 2)
    s, ds, _ = slide(q, r)
    rates = {"w": w, "v": ds * w, "fw": by * w, "aw": (by - 1) * w}
    return {"t": t, "q": q, "s": s, "f": f, "a": f - q, **rates}


def broken(x: Any, y: Any) -> Callable[[Any], Any]:
    return lambda at: np.interp(at, x, y)


def spline(x: Any, y: Any) -> Any:
    from scipy.interpolate import CubicSpline

    return CubicSpline(x, y, bc_type="not-a-knot")


SLIDES, FORCES = [0.14, 0.19, 0.22, 0.26], [40.0, 10.0, 60.0, -20.0]
OVER_SLIDE = {"against": "slide.G", "x": SLIDES, "y": FORCES}
SHORT = {"against": "slide.G", "x": [0.16, 0.2, 0.24], "y": [40.0, 90.0, 20.0]}
OVER_TURN = {"against": "angle.rod", "x": ["-20 deg", "-4 deg", "20 deg"], "y": [5.0, 30.0, -10.0]}
RODS = np.radians([-20, -4, 20])
OVER_SPEED = {"against": "slide.G.speed", "x": ["-3 m/s", "0 m/s", "3 m/s"], "y": [-40.0, 0.0, 90.0]}
TIMED = {"against": "time", "x": [0, 0.1, 0.5, 9], "y": [10.0, 50.0, -20.0, 3.0]}
CRANKS = np.radians([0, 90, 200, 360])
TURNED = {"against": "O", "x": [0, 90, 200], "y": [5.0, 30.0, -10.0], "periodic": True}

LOADS: dict[str, tuple[object, Callable[[Known], Any]]] = {
    "number": (40.0, lambda k: 40.0 + 0 * k["q"]),
    "drive": ("40*sin(O)", lambda k: 40 * np.sin(k["q"])),
    "parameter": ("push*cos(O)", lambda k: 30 * np.cos(k["q"])),
    "angle": ("40 N*sin(angle.rod)", lambda k: 40 * np.sin(k["f"])),
    "turn": ("15*turn.A", lambda k: 15 * k["a"]),
    "slide": ("900 N/m*slide.G", lambda k: 900 * k["s"]),
    "largest": ("max(300*slide.G, 60, 55)", lambda k: np.maximum(300 * k["s"], 60.0)),
    "compared": ("40*(slide.G > 0.2)", lambda k: 40.0 * (k["s"] > 0.2)),
    "table": (TURNED, lambda k: np.interp(k["q"] % (2 * np.pi), CRANKS, [5, 30, -10, 5])),
    "time": ("50*sin(20*time)", lambda k: 50 * np.sin(20 * k["t"])),
    "time with a unit": ("50 N*sin(time/(0.05 s))", lambda k: 50 * np.sin(k["t"] / 0.05)),
    "table over time": (TIMED, lambda k: np.interp(k["t"], TIMED["x"], TIMED["y"])),
    "drive speed": ("-0.1*O.speed^2", lambda k: -0.1 * k["w"] ** 2),
    "drive speed by its quantity": ("-2 N*s*drive.O.speed", lambda k: -2 * k["w"]),
    "slide speed": ("-30 N*s/m*slide.G.speed", lambda k: -30 * k["v"]),
    "turn speed": ("2*turn.A.speed", lambda k: 2 * k["aw"]),
    "angle speed": ("3*angle.rod.speed*slide.G", lambda k: 3 * k["fw"] * k["s"]),
    "sign of a speed": ("-25*sign(slide.G.speed)", lambda k: -25 * np.sign(k["v"])),
    "cut one way": ("push*(slide.G.speed > 0)", lambda k: 30.0 * (k["v"] > 0)),
    "table over slide": (OVER_SLIDE, lambda k: broken(SLIDES, FORCES)(k["s"])),
    "cubic over slide": ({**OVER_SLIDE, "interpolate": "cubic"}, lambda k: spline(SLIDES, FORCES)(k["s"])),
    "table over angle": (OVER_TURN, lambda k: broken(RODS, OVER_TURN["y"])(k["f"])),
    "periodic over turn": (
        {**TURNED, "against": "turn.A"},
        lambda k: np.interp(k["a"] % (2 * np.pi), CRANKS, [5, 30, -10, 5]),
    ),
    "table times parameter": (
        {**OVER_SLIDE, "y": ["20 kPa", "80 kPa", "10 kPa", "5 kPa"], "times": "push*(1 cm^2/(1 N))"},
        lambda k: broken(SLIDES, [60.0, 240.0, 30.0, 15.0])(k["s"]),
    ),
    "table of a parameter": (
        {**OVER_SLIDE, "y": [40, "push", 60, -20]},
        lambda k: broken(SLIDES, [40.0, 30.0, 60.0, -20.0])(k["s"]),
    ),
    "shifted by a parameter": (
        {**OVER_SLIDE, "shift": "late"},
        lambda k: broken(np.array(SLIDES) + 0.003, FORCES)(k["s"]),
    ),
    "held outside": ({**SHORT, "outside": "hold"}, lambda k: broken(SHORT["x"], SHORT["y"])(k["s"])),
    "refused outside": (SHORT, lambda k: broken(SHORT["x"], SHORT["y"])(k["s"])),
    "zero outside": (
        {**SHORT, "outside": "zero"},
        lambda k: np.interp(k["s"], SHORT["x"], SHORT["y"], left=0, right=0),
    ),
    "table over a speed": (OVER_SPEED, lambda k: broken([-3, 0, 3], [-40, 0, 90])(k["v"])),
}
PARAMETERS = {"push": "30 N", "late": "3 mm"}
VARY = ["links.block.mass", "links.crank.points.A.0"]


def crank(name: str, forces: bool = False, count: int = 24) -> da.Mechanism:
    """The machine with a load; moved by forces, or at constant speed round its turn."""
    load = {"type": "force", "on": "block", "at": "B", "direction": 0, "value": LOADS[name][0]}
    drive = {"position": {"from": 5, "to": 365, "count": count}, "speed": f"{SPEED} rad/s"}
    tree = {
        "parameters": {k: v for k, v in PARAMETERS.items() if re.search(rf"\b{k}\b", json.dumps(load))},
        "links": {
            "ground": {"points": {"O": [0, 0]}},
            "crank": {"points": {"O": [0, 0], "A": [R, 0]}, "inertia": J},
            "rod": {"points": {"A": [0, 0], "B": [L, 0]}},
            "block": {"points": {"B": [0, 0]}, "mass": M},
        },
        "joints": {
            "O": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "rod"]},
            "B": {"type": "pin", "links": ["rod", "block"]},
            "G": {"type": "slider", "links": ["ground", "block"], "at": ["O", "B"], "direction": 0},
        },
        "drives": {"O": {"position": 5} if forces else drive},
        "assembly": {"rod": 0, "block": 0},
        "loads": {"F": load},
    }
    start = {"start": {"O": {"position": 5, "speed": f"{SPEED} rad/s"}}} if forces else {}
    return da.mechanism({**tree, **start})


def effort(name: str, q: Any, m: float = M, r: float = R, inertia: bool = True) -> Any:
    """The crank's effort at positions, in closed form."""
    _, first, second = slide(q, r)
    force = LOADS[name][1](state((q - np.radians(5)) / SPEED, q, SPEED, r))
    return ((m * second * SPEED**2 if inertia else 0.0) - force) * first


def near(found: Any, wanted: Any, rel: float = 1e-9) -> None:
    size = np.abs(wanted).max()
    assert found == pytest.approx(wanted, rel=rel, abs=rel * size)


def analysed(name: str, static: bool) -> None:
    run, m = (da.statics, crank(name)) if static else (da.dynamics, crank(name))
    with counted() as ways:
        results = [run(m, method="careful"), run(m), run(m)]
    for r in results:
        near(r["effort.O"], effort(name, r["drive.O"], inertia=not static))
        assert set(r.status) == statuses(name)
    assert ways[-1] in ("all", "forces")


def statuses(name: str) -> set[str]:
    """Statuses of the positions of a turn."""
    return {"ok", "outside_table"} if name == "refused outside" else {"ok"}


def statics(name: str) -> None:
    analysed(name, static=True)


def dynamics(name: str) -> None:
    analysed(name, static=False)


def compiled(name: str) -> None:
    k = da.compile(crank(name), VARY, outputs=["effort.O"], derivatives=True)
    for m, r in ((M, R), (4.0, 0.0523)):
        found = k([[m, r]], redo=False)
        assert set(np.ravel(found.status)) == statuses(name)
        assert not found.redone
        q = angles()
        near(found.value("effort.O")[0], effort(name, q, m, r), 1e-8)
        slope = found.gradient("effort.O")[0]
        near(slope[:, 0], effort(name, q, m + 1, r) - effort(name, q, m, r), 1e-8)
        h = 1e-7
        by = (effort(name, q, m, r + h) - effort(name, q, m, r - h)) / (2 * h)
        smooth = np.abs(effort(name, q, m, r + h) + effort(name, q, m, r - h) - 2 * effort(name, q, m, r))
        smooth = smooth < 1e-8 * np.abs(by).max()  # no corner between the two
        assert smooth.sum() > 18
        near(slope[smooth, 1], by[smooth], 1e-5)


def angles(count: int = 24) -> Any:
    return np.radians(5 + 360 / count * np.arange(count))


def page(name: str) -> None:
    data = json.loads(json.dumps(page_data(crank(name))))
    position = next(c["values"] for c in data["channels"] if c["name"] == "position O")
    wanted = np.abs(effort(name, series(position, data["kernel"]["count"])))
    off = np.abs(np.abs(run_page(data)) - wanted).max(axis=1)
    assert np.nanmin(off) < 1e-8 * wanted.max()


def study(name: str) -> None:
    vary = {VARY[0]: (2, 4), VARY[1]: (0.045, 0.0523)}
    found = da.study(crank(name), vary, ["effort.O"], designs=6, reduce="rms").run()
    assert set(found.status) == {max(statuses(name))}
    for n, value in enumerate(found["effort.O"]):
        m, r = found.study.design(n).values()
        assert value == pytest.approx(np.sqrt(np.mean(effort(name, angles(), m, r) ** 2)), rel=1e-7)


def optimize(name: str) -> None:
    box = {VARY[0]: (2, 4), VARY[1]: (0.045, 0.0523)}
    best = da.optimize(crank(name), box, "rms effort.O", starts=4)
    m, r = best.mechanism.links["block"].mass, best.mechanism.links["crank"].points["A"][0]
    mean = np.mean(effort(name, angles(), m, r) ** 2)
    assert best.value == pytest.approx(np.sqrt(mean), rel=1e-7)
    assert best.feasible


def simulate(name: str) -> None:
    s = da.simulate(crank(name, forces=True), "0.4 s", count=21)
    assert set(s.result.status) == statuses(name)
    assert s.time[-1] == pytest.approx(0.4)

    def rate(t: float, y: Any) -> Any:
        _, first, second = slide(y[0])
        force = LOADS[name][1](state(t, y[0], y[1]))
        return y[1], (force - M * second * y[1] ** 2) * first / (J + M * first**2)

    even = np.linspace(0, 0.4, 21)
    wanted = solve_ivp(
        rate, (0, 0.4), [np.radians(5), SPEED], t_eval=even, rtol=1e-9, atol=1e-10, max_step=2e-3
    )
    at = np.searchsorted(s.time, even - 1e-9)
    near(s["drive.O"][at], wanted.y[0], 2e-6)
    near(s["drive.O.speed"][at], wanted.y[1], 2e-5)


def flywheel(name: str) -> None:
    fine = np.radians(np.linspace(5, 365, 40001))
    asked = effort(name, fine)
    for count in (36, 144):
        r = da.dynamics(crank(name, count=count))
        energy = np.cumsum(asked - asked.mean()) * (fine[1] - fine[0])
        assert da.flywheel(r, Cs=0.05).size.energy == pytest.approx(np.ptp(energy), rel=0.02)


def report(name: str) -> None:
    assert len(str(da.report(da.dynamics(crank(name, count=3))))) > 100


ANALYSES = (statics, dynamics, compiled, page, study, optimize, simulate, flywheel, report)

QUICK = {
    "sign of a speed": (dynamics, compiled, simulate),
    "slide speed": (statics, optimize, page, flywheel),
}
QUICK |= {
    "time": (compiled, optimize),
    "table of a parameter": (compiled, page),
    "table over a speed": (compiled,),
}
QUICK |= {
    "cubic over slide": (study, simulate),
    "periodic over turn": (page,),
    "angle speed": (report, study),
}
CELLS = {f"{name}: {of.__name__}": of in QUICK.get(name, ()) for name in LOADS for of in ANALYSES}


@pytest.mark.parametrize("cell", tiers([c for c in CELLS if CELLS[c]], [c for c in CELLS if not CELLS[c]]))
def test_a_load_is_its_closed_form(cell: str) -> None:
    name, _, of = cell.partition(": ")
    next(analysis for analysis in ANALYSES if analysis.__name__ == of)(name)
