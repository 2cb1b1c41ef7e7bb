"""Three tasks of design: `da.optimize` and `da.synthesize` beside scipy's differential evolution on models in numpy.

Method. Each task is solved by dalembert from random starts (its programs are compiled within the time), and twice by
differential evolution (scipy, vectorized) on a model of the same machine written by hand in numpy, which is first
compared with `da.dynamics` for one design; then by pylinkage's particle swarm where it is installed and can state the
task. Every rival's best design is analysed by `da.dynamics` in the same run: its row has our value of that design and
the difference, and a difference of more than 0.2 % ends the run. All in one run, one after the other.

torque    Norton's four-bar 11-3 over a turn: ground pivot O4, coupler point B, a counterweight on the coupler; least
          peak torque while the transmission angle stays above 33 degrees.
shaking   a slider-crank at 3,000 rpm: counterweights on crank and rod; least peak shaking force.
path      a four-bar whose coupler point passes 10 points that a known four-bar made, at its crank angles; then 10
          at angles that are not told.

    python -m benchmarks.optimize [--starts 1000] [--figures docs/figures]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import differential_evolution
from tests.optimization.test_optimize import TORQUE, norton
from tests.optimization.test_synthesize import MODEL, VARY, made

import dalembert as da
from dalembert.reports.machine_sections.optimum_section import optimum_scenes
from dalembert.views.paper.diagrams import polar_scene
from dalembert.views.paper.scene import stack_scenes

TURN = np.radians(np.arange(72) * 5.0)
INCH, POUND = 0.0254, 4.4482216152605
BROKEN = 1e3
"""What a design costs whose loop does not close, over the usual size."""


def four_bar(q: Any, crank: Any, b: Any, turned: Any, rocker: Any, ground: Any) -> Any:
    """Angles of coupler axis and rocker (closed form, coupler above), places of A and B, and sin^2 of transmission."""
    a = crank * np.exp(1j * q)
    d = ground - a
    reach = np.abs(d)
    cos = (b**2 + reach**2 - rocker**2) / (2 * b * reach)
    with np.errstate(invalid="ignore"):
        line = np.angle(d) + np.arccos(cos)  # of A to B
    joint = a + b * np.exp(1j * line)
    return line - turned, np.angle(joint - ground), a, joint


TORQUE_BOX = [(17, 21), (-2, 2), (13, 17), (-2, 2), (0, 10), (-15, 15), (-15, 15)]


def torque_numpy(x: Any) -> Any:
    """Peak torque (N m) by virtual work, of designs (number, design); derivatives over the turn by Fourier series."""
    x = np.atleast_2d(np.asarray(x, float).T).T
    o4, b = (x[0] + 1j * x[1])[:, None], (x[2] + 1j * x[3])[:, None]
    crank, coupler, rocker = 3 * np.exp(1j * np.pi / 6), 9 * np.exp(1j * np.pi / 4), 5.0
    speed, g = 25.0, 386.0
    c, r, a, _ = four_bar(TURN, 5.0, np.abs(b), np.angle(b), 10.0, o4)
    weight = x[4][:, None]
    parts = [  # weight, place, inertia, angle
        (1.5, crank * np.exp(1j * TURN) + 0 * c, 0.4, TURN + 0 * c),
        (7.7, a + coupler * np.exp(1j * c), 1.5, c),
        (5.8, o4 + rocker * np.exp(1j * r), 0.8, r),
        (weight, a + (x[5] + 1j * x[6])[:, None] * np.exp(1j * c), 0.0, c),
    ]
    power = np.zeros(c.shape)
    for w, place, inertia, angle in parts:
        v, acc = turning(place, speed)
        turn, rate = (part.imag for part in turning(np.exp(1j * (angle)), speed, log=True))
        power = power + (w / g * acc * np.conj(v)).real + inertia * rate * turn
    at_p = a + (coupler + 3 * np.exp(1j * np.radians(100))) * np.exp(1j * c)
    power = power - (80 * np.exp(-1j * np.radians(30)) * np.conj(turning(at_p, speed)[0])).real
    power = power - 120 * turning(np.exp(1j * r), speed, log=True)[0].imag
    peak = np.abs(power / speed).max(axis=1) * INCH * POUND
    across = np.abs(np.sin(c + np.angle(b) - r)).min(axis=1)
    lacks = np.maximum(0.0, np.sin(np.radians(33)) - across)
    return np.where(np.isfinite(peak) & np.isfinite(lacks), peak + 1e4 * lacks**2 + 1e2 * lacks, BROKEN)


def turning(f: Any, speed: float, log: bool = False) -> tuple[Any, Any]:
    """First and second time derivative of a function over the turn; with ``log`` those of its logarithm."""
    n = np.fft.fftfreq(TURN.size, 1 / TURN.size)
    with np.errstate(invalid="ignore", divide="ignore"):
        spectrum = np.fft.fft(f, axis=-1)
        first, second = (np.fft.ifft(spectrum * (1j * n * speed) ** k, axis=-1) for k in (1, 2))
        return (first / f, second / f - (first / f) ** 2) if log else (first, second)


SLIDER = """
units: {angle: rad}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.05, 0]}, mass: 2 kg, center: [0.02, 0], inertia: 0}
  rod: {points: {A: [0, 0], B: [0.2, 0]}, mass: 1 kg, center: [0.06, 0], inertia: 0}
  piston: {points: {B: [0, 0]}, mass: 0.8 kg}
  on_crank: {points: {W: [0, 0]}, mass: 0, center: [0, 0], inertia: 0}
  on_rod: {points: {V: [0, 0]}, mass: 0, center: [0, 0], inertia: 0}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  cylinder: {type: slider, links: [ground, piston], at: [O, B], direction: 0}
  W: {type: weld, links: [crank, on_crank], at: [O, W]}
  V: {type: weld, links: [rod, on_rod], at: [A, V]}
drives: {O: {position: {from: 0, to: 360 deg, count: 72}, speed: 3000 rpm}}
assembly: {rod: 0}
"""
SHAKING = {
    "links.on_crank.mass": (0.0, 4.0),
    "links.on_crank.center": ("[-0.06 m, -0.06 m]", "[0.06 m, 0.06 m]"),
    "links.on_rod.mass": (0.0, 1.0),
    "links.on_rod.center": ("[-0.06 m, -0.03 m]", "[0.06 m, 0.03 m]"),
}
SHAKING_BOX = [(0, 4), (-0.06, 0.06), (-0.06, 0.06), (0, 1), (-0.06, 0.06), (-0.03, 0.03)]


def torque_by_dynamics(x: Any) -> float:
    """What `torque_numpy` gives of a design, from an analysis of ours."""
    start = four_bar(TURN[:1], 5.0, abs(x[2] + 1j * x[3]), np.angle(x[2] + 1j * x[3]), 10.0, x[0] + 1j * x[1])
    r = da.dynamics(
        norton().with_values(
            {
                "links.ground.points.O4": (x[0] * INCH, x[1] * INCH),
                "links.coupler.points.B": (x[2] * INCH, x[3] * INCH),
                "links.cw.weight": x[4] * POUND,
                "links.cw.center": (x[5] * INCH, x[6] * INCH),
                "assembly": {"coupler": float(start[0][0]), "rocker": float(start[1][0])},
            }
        )
    )
    lacks = max(0.0, np.sin(np.radians(33)) - np.sin(r["transmission.B"]).min())
    return float(np.abs(r["effort.O2"]).max() + 1e4 * lacks**2 + 1e2 * lacks)


def shaking_by_dynamics(x: Any) -> float:
    """What `shaking_numpy` gives of a design, from an analysis of ours."""
    on_crank = {"links.on_crank.mass": x[0], "links.on_crank.center": (x[1], x[2])}
    on_rod = {"links.on_rod.mass": x[3], "links.on_rod.center": (x[4], x[5])}
    r = da.dynamics(da.loads(SLIDER).with_values(on_crank | on_rod))
    return float(np.linalg.norm(r["shaking_force"], axis=1).max())


def shaking_numpy(x: Any) -> Any:
    """Peak shaking force (N), of designs (number, design)."""
    x = np.atleast_2d(np.asarray(x, float).T).T
    speed, a = 3000 * 2 * np.pi / 60, 0.05 * np.exp(1j * TURN)
    rod = np.sqrt(1 - (a.imag / 0.2) ** 2) - 1j * a.imag / 0.2
    own = 2 * 0.4 * a + (a + 0.06 * rod) + 0.8 * (a + 0.2 * rod).real
    moved = own + (x[0] * (x[1] + 1j * x[2]))[:, None] * np.exp(1j * TURN)
    moved = moved + x[3][:, None] * (a + (x[4] + 1j * x[5])[:, None] * rod)
    return np.abs(turning(moved, speed)[1]).max(axis=1)


PATH_BOX = [(-0.1, 0.1)] * 2 + [(0.15, 0.45), (-0.15, 0.15), (0.05, 0.2), (0.15, 0.45), (0, 0.3), (0, 0.25)]
PATH_BOX += [(0.12, 0.4)]
KNOWN = tuple(da.compile(made(), list(VARY)).nominal.tolist())
CRANK = np.radians(np.arange(10) * 36.0)


def path_points(x: Any, crank: Any = CRANK) -> Any:
    """Points of the coupler (design, angle) as complex numbers, of designs (number, design)."""
    x = np.atleast_2d(np.asarray(x, float).T).T[..., None]
    o2, o4 = x[0] + 1j * x[1], x[2] + 1j * x[3]
    c, _, a, _ = four_bar(crank, x[4], x[5], 0.0, x[8], o4 - o2)
    return o2 + a + (x[6] + 1j * x[7]) * np.exp(1j * c)


WANTED = path_points(np.array(KNOWN))[0]
SIZE = float(np.hypot(np.ptp(WANTED.real), np.ptp(WANTED.imag)))


def our_path(x: Any, count: int) -> Any:
    """Points of the coupler of a design by `da.kinematics`."""
    start = four_bar(CRANK[:1], x[4], x[5], 0.0, x[8], x[2] - x[0] + 1j * (x[3] - x[1]))
    of = {"O2": (x[0], x[1]), "O4": (x[2], x[3])}
    changed: dict[str, Any] = {f"links.ground.points.{name}": place for name, place in of.items()}
    for path, value in zip(list(VARY)[2:], (x[4], x[5], (x[6], x[7]), x[8]), strict=True):
        changed[path] = value
    changed["assembly"] = {"coupler": float(start[0][0]), "rocker": float(start[1][0])}
    points = da.kinematics(da.loads(MODEL).with_values(changed), positions=count)["point.coupler.P"]
    return points[:, 0] + 1j * points[:, 1]


def path_by_kinematics(x: Any) -> float:
    """What `path_numpy` gives of a design, from an analysis of ours."""
    return float(np.sqrt((np.abs(our_path(x, len(CRANK)) - WANTED) ** 2).mean()) / SIZE)


def path_numpy(x: Any) -> Any:
    """Rms distance from the points over their spread."""
    off = np.sqrt((np.abs(path_points(x) - WANTED) ** 2).mean(axis=-1)) / SIZE
    return np.where(np.isfinite(off), off, BROKEN)


UNTIMED = np.sort(np.random.default_rng(3).uniform(0, 2 * np.pi, 10))
"""Angles of the crank that are not told."""
FREE = path_points(np.array(KNOWN), UNTIMED)[0]


def untimed_numpy(x: Any) -> Any:
    """Rms distance of points, over their spread, from the path, 180 chords; their order is not asked for."""
    return off_chords(path_points(x, np.radians(np.arange(180) * 2.0)))


def untimed_by_kinematics(x: Any) -> float:
    """What `untimed_numpy` gives of a design, from an analysis of ours."""
    return float(off_chords(our_path(x, 180)))


def off_chords(path: Any) -> Any:
    """Rms distance of the wanted points from closed paths (..., point)."""
    chord = np.roll(path, -1, axis=-1) - path
    near = []
    for point in FREE:
        part = np.clip(((point - path) * np.conj(chord)).real / np.abs(chord) ** 2, 0, 1)
        near.append(np.abs(point - path - part * chord).min(axis=-1))
    off = np.sqrt((np.stack(near) ** 2).mean(axis=0)) / np.hypot(np.ptp(FREE.real), np.ptp(FREE.imag))
    return np.where(np.isfinite(off), off, BROKEN)


def evolution(
    name: str, of: Callable[[Any], Any], box: list[Any], size: int, steps: int, ours: Callable[[Any], float]
) -> None:
    """Two runs of scipy's differential evolution."""
    for seed in (1, 2):
        begun = time.perf_counter()
        found = differential_evolution(
            of,
            box,
            popsize=size,
            maxiter=steps,
            seed=seed,
            tol=1e-10,
            vectorized=True,
            updating="deferred",
            polish=False,
        )
        row(
            name,
            f"scipy DE on numpy, seed {seed}",
            time.perf_counter() - begun,
            found.nfev * size * len(box),
            found.fun,
            ours(found.x),
        )


def swarm(name: str) -> None:
    """pylinkage's particle swarm on its own simulation, the linkage made for each design; only of the path."""
    try:
        import pylinkage as pl
        from pylinkage.optimization import particle_swarm
    except ImportError:
        print("pylinkage is not installed")
        return

    best: list[tuple[float, ...]] = [(BROKEN,)]

    def linkage(x: Any) -> Any:
        step = float(CRANK[1])
        crank = pl.Crank(pl.Ground(x[0], x[1]), x[4], angular_velocity=step, initial_angle=-step)
        at = four_bar(CRANK[:1], x[4], x[5], 0.0, x[8], complex(x[2] - x[0], x[3] - x[1]))[3][0]
        o4 = pl.Ground(x[2], x[3])
        b = pl.RRRDyad(crank.output, o4, x[5], x[8], x[0] + at.real, x[1] + at.imag)
        p = pl.FixedDyad(crank.output, b, float(np.hypot(x[6], x[7])), float(np.arctan2(x[7], x[6])))
        return pl.Linkage([crank.anchor, o4, crank, b, p])

    def off(_: Any, x: Any, __: Any) -> float:
        try:
            found = [places[-1] for places in linkage(x).step(iterations=len(CRANK))]
        except (pl.UnbuildableError, ValueError):
            return BROKEN
        places = np.array([complex(*place) for place in found])
        value = float(np.sqrt((np.abs(places - WANTED) ** 2).mean()) / SIZE)
        best.append(min(best.pop(), (value, *map(float, x))))
        return value

    check("path by pylinkage", 1.0 + off(None, KNOWN, None), 1.0)
    ends = tuple(zip(*PATH_BOX, strict=True))
    for run in (1, 2):
        best[:] = [(BROKEN,)]
        begun = time.perf_counter()
        particle_swarm.particle_swarm_optimization(
            off, linkage(KNOWN), dimensions=9, bounds=ends, order_relation=min, verbose=False
        )
        row(
            name,
            f"pylinkage {pl.__version__} PSO, run {run}",
            time.perf_counter() - begun,
            20_000,
            best[0][0],
            path_by_kinematics(np.array(best[0][1:])),
        )


def row(
    name: str, method: str, seconds: float, calls: object, value: float, own: float | None = None
) -> None:
    """A line of the table; of a rival with our value of its design, which has to be the same."""
    judged = "" if own is None else f"{own:.6g}, {abs(value - own):.1e} off"
    print(f"| {name} | {method} | {seconds:.2f} | {calls} | {value:.6g} | {judged} |", flush=True)
    if own is not None:
        check(f"{name} by {method}", value, own)


def check(name: str, mine: float, own: float) -> None:
    """Both models have the same machine; a distance from a path is a share of its size."""
    if not abs(mine - own) <= 2e-3 * abs(own) + 1e-6:
        raise SystemExit(f"{name}: the model in numpy gives {mine}, da.dynamics {own}")


def best_torque(starts: int) -> da.Optimum:
    m = norton()
    before = float(np.abs(da.dynamics(m)["effort.O2"]).max())
    check("torque", float(torque_numpy([19, 0, 15, 0, 0, 0, 0])[0]), before)
    for count in (40, starts):
        begun = time.perf_counter()
        best = da.optimize(m, TORQUE, "peak effort.O2", "transmission.B >= 33 deg", starts=count)
        seconds = time.perf_counter() - begun
        said = f"da.optimize, {best.found} of {best.polished} best alike (before: {before:.3f})"
        row("torque, N m", said, seconds, best.started, best.value)
    evolution("torque, N m", torque_numpy, TORQUE_BOX, 15, 300, torque_by_dynamics)
    return best


def best_shaking(starts: int) -> da.Optimum:
    m = da.loads(SLIDER)
    before = float(np.linalg.norm(da.dynamics(m)["shaking_force"], axis=1).max())
    check("shaking", float(shaking_numpy([0, 0, 0, 0, 0, 0])[0]), before)
    for words, some in (("crank", list(SHAKING)[:2]), ("crank and rod", list(SHAKING))):
        begun = time.perf_counter()
        vary = {path: SHAKING[path] for path in some}
        best = da.optimize(m, vary, "peak shaking_force.magnitude", starts=starts)
        said = f"da.optimize, {words} (before: {before:.1f})"
        row("shaking, N", said, time.perf_counter() - begun, best.started, best.value)
    evolution("shaking, N", shaking_numpy, SHAKING_BOX, 15, 300, shaking_by_dynamics)
    return best


def best_path(starts: int) -> da.Synthesis:
    m = da.loads(MODEL)
    targets = {"point.coupler.P": np.stack([WANTED.real, WANTED.imag], axis=1)}
    begun = time.perf_counter()
    found = da.synthesize(m, VARY, targets, starts=starts)
    said = f"da.synthesize, {found.exact} of {found.started} exact"
    row("path, rms/size", said, time.perf_counter() - begun, found.started, found.error)
    evolution("path, rms/size", path_numpy, PATH_BOX, 17, 1000, path_by_kinematics)
    swarm("path, rms/size")
    untimed_path(starts)
    return found


def untimed_path(starts: int) -> None:
    """A path whose timing is free."""
    targets = {"point.coupler.P": np.stack([FREE.real, FREE.imag], axis=1)}
    begun = time.perf_counter()
    found = da.synthesize(da.loads(MODEL), VARY, targets, starts=starts, timing="free")
    said = f"da.synthesize, {found.exact} of {found.started} exact"
    row("free path, rms/size", said, time.perf_counter() - begun, found.started, found.error)
    evolution("free path, rms/size", untimed_numpy, PATH_BOX, 15, 300, untimed_by_kinematics)


def figures(folder: Path, torque: da.Optimum, shaking: da.Optimum, path: da.Synthesis) -> None:
    """Pictures for the guide."""
    for name, best in (("torque", torque), ("shaking", shaking)):
        scene = stack_scenes(optimum_scenes(best), width=0.0, title=f"Least peak {best.aim.of}")
        scene.save(folder / f"optimized_{name}.svg", overwrite=True)
    r = da.kinematics(path.mechanism)
    marks = [(k, str(k + 1)) for k in range(len(CRANK))]
    made = polar_scene(
        {"P": r["point.coupler.P"]}, "m", "The coupler point at ten angles of the crank", labels=marks
    )
    scene = stack_scenes([made, da.draw.mechanism(r, 2)], title="Four-bar through ten points")
    scene.save(folder / "synthesized_path.svg", overwrite=True)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--starts", type=int, default=1000)
    arguments.add_argument("--figures", type=Path)
    given = arguments.parse_args()
    print(
        "| task | method | s | starts or calls | best | ours of it |\n| --- | --- | --- | --- | --- | --- |"
    )
    found = best_torque(given.starts), best_shaking(given.starts), best_path(given.starts)
    if given.figures is not None:
        figures(given.figures, *found)


if __name__ == "__main__":
    main()
