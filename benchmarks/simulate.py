"""A four-bar and a slider-crank under gravity and a given torque, here and in two simulators: time at equal accuracy.

Every program integrates the same motion, as its users would write it, on one thread of one process, again and again
with finer steps (here: tolerances). The error is that of the crank's angle at the end, in radians, against this
program's own motion at its tightest tolerance, which is compared with scipy's LSODA on the closed-form equation first.
Models are built outside the clock everywhere, and the motion alone is asked for, with the drives' speeds and
accelerations. Beside it: da.simulate with its checks and all joint forces at the instants of the answer, as when it is
printed; and the model built anew each time, here and in Exudyn (here, the machine code of a structure stays). The other
programs have the coarse steps too that reach an accuracy soonest. Medians of runs taken in turns.

At the end machines whose joints rub, with friction in machine code and without.

    python benchmarks/simulate.py [seconds simulated, "rubbing" or "designs"]
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from math import asin, atan2, cos, pi, sin
from pathlib import Path
from statistics import median
from time import perf_counter, process_time
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

import dalembert as da
from dalembert.bundled import examples
from dalembert.machine.motion.coded.coded_motion import CodedState
from dalembert.studies.motion_engines import SimulationEngine, SimulationPlan, make_motion_engine

SECONDS, G, TORQUE, BEGIN, SPEED, REPEAT, TURN = 1.0, 9.80665, 0.4, pi / 3, 30.0, 5, 0.03
A, B, C, D = 0.05, 0.15, 0.12, 0.2
LINKS = {"crank": (A, 1.0, 0.0, 0.02), "rod": (B, 1.2, 0.07, 0.003), "rocker": (C, 0.8, 0.06, 0.004)}
"""Length, mass, centre from the first point and inertia about it of each link; the piston has a mass alone."""
PISTON = 0.9
KINDS = ("", "with checks", "and model")


def model(four_bar: bool) -> Any:
    links: dict[str, Any] = {"ground": {"points": {"O2": [0, 0], "O4": [D, 0]}}}
    ends = {"crank": ("O2", "A"), "rod": ("A", "B"), "rocker": ("O4", "B")}
    for name, (length, mass, center, inertia) in LINKS.items():
        points = {ends[name][0]: [0, 0], ends[name][1]: [length, 0]}
        links[name] = {"points": points, "mass": mass, "center": [center, 0], "inertia": inertia}
    joints: dict[str, Any] = {"O2": {"type": "pin", "links": ["ground", "crank"]}}
    joints["A"] = {"type": "pin", "links": ["crank", "rod"]}
    if four_bar:
        joints["B"] = {"type": "pin", "links": ["rod", "rocker"]}
        joints["O4"] = {"type": "pin", "links": ["ground", "rocker"]}
    else:
        links["rocker"] = {"points": {"B": [0, 0]}, "mass": PISTON}
        joints["B"] = {"type": "pin", "links": ["rod", "rocker"]}
        joints["S"] = {
            "type": "slider",
            "links": ["ground", "rocker"],
            "at": ["O2", "B"],
            "direction": "0 deg",
        }
    three, four = angles(BEGIN, four_bar)
    return da.mechanism(
        {
            "gravity": "standard",
            "links": links,
            "joints": joints,
            "drives": {"O2": {"effort": f"{TORQUE} N*m"}},
            "start": {"O2": {"position": f"{BEGIN} rad", "speed": f"{SPEED} rad/s"}},
            "assembly": {"rod": f"{three} rad", "rocker": f"{four} rad"},
        }
    )


def angles(q: float, four_bar: bool) -> tuple[float, float]:
    """Turns of rod and rocker; 0 of a piston."""
    if not four_bar:
        return -asin(A * sin(q) / B), 0.0
    x, y = D - A * cos(q), -A * sin(q)
    far = np.hypot(x, y)
    three = atan2(y, x) + float(np.arccos((B * B + far * far - C * C) / (2 * B * far)))
    return three, atan2(A * sin(q) + B * sin(three), A * cos(q) + B * cos(three) - D)


def energies(q: float, four_bar: bool) -> tuple[float, float]:
    """Inertia reduced to the crank, and potential energy, by the vector loop."""
    three, four = angles(q, four_bar)
    turn, e3, e4 = A * np.exp(1j * q), np.exp(1j * three), np.exp(1j * four)
    last = -C * 1j * e4 if four_bar else -1.0
    rows = np.array([[(B * 1j * e3).real, np.real(last)], [(B * 1j * e3).imag, np.imag(last)]])
    w3, w4 = np.linalg.solve(rows, [-(1j * turn).real, -(1j * turn).imag])
    m3, c3, i3 = LINKS["rod"][1:]
    m4, c4, i4 = LINKS["rocker"][1:]
    inertia = LINKS["crank"][3] + i3 * w3**2 + m3 * abs(1j * turn + c3 * 1j * w3 * e3) ** 2
    height = m3 * (turn + c3 * e3).imag
    if not four_bar:
        return float(inertia + PISTON * w4**2), float(G * height)
    return float(inertia + (i4 + m4 * c4**2) * w4**2), float(G * (height + m4 * c4 * e4.imag))


def reference(four_bar: bool, seconds: float) -> float:
    """Angle at the end by LSODA on J q'' + J' q'^2 / 2 + V' = T, slopes by differences of order 8."""
    step = 0.01
    weights = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280]) / step

    def rate(_: float, y: Any) -> list[float]:
        around = np.array([energies(y[0] + k * step, four_bar) for k in range(-4, 5)])
        slopes = weights @ around
        return [y[1], (TORQUE - slopes[0] * y[1] ** 2 / 2 - slopes[1]) / around[4, 0]]

    known = solve_ivp(rate, (0, seconds), [BEGIN, SPEED], method="LSODA", rtol=1e-12, atol=1e-12)
    return float(known.y[0, -1])


def ours(four_bar: bool, seconds: float) -> dict[str, Callable[[], float]]:
    m = model(four_bar)

    def way(kind: str, tolerance: float) -> Callable[[], float]:
        def run() -> float:
            of = model(four_bar) if kind == "and model" else m
            s = da.simulate(of, seconds, count=2, tolerance=tolerance)
            if kind == "with checks":
                assert max(s.energy_residual, s.law_residual, s.closure) < 1
            return float(s.position("O2")[-1])

        return run

    tolerances = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
    return {f"da.simulate{k and ' '}{k}, {t:.0e}": way(k, t) for k in KINDS for t in tolerances}


MUJOCO = """
<mujoco>
  <compiler angle="radian"/>
  <option gravity="0 -9.80665 0" timestep="{step}" integrator="{integrator}" tolerance="0" solver="Newton"/>
  <worldbody>
    <body name="crank">
      <joint name="O2" axis="0 0 1"/>{crank}
      <body name="rod" pos="{a} 0 0">
        <joint name="A" axis="0 0 1"/>{rod}
      </body>
    </body>
    <body name="rocker" pos="{place} 0 0">{joint}{rocker}</body>
  </worldbody>
  <equality>
    <connect site1="B3" site2="B4" solref="{reference} 1" solimp="0.9999 0.9999 0.001"/>
  </equality>
  <actuator><motor joint="O2"/></actuator>
</mujoco>
"""


JOINTS = {True: '<joint name="O4" axis="0 0 1"/>', False: '<joint name="O4" type="slide" axis="1 0 0"/>'}


def inertial(name: str, mass: float, center: float, inertia: float, site: str) -> str:
    i = max(inertia, 1e-9)
    return (
        f'<inertial pos="{center} 0 0" mass="{mass}" diaginertia="{i} {i} {i}"/>'
        f'<site name="{name}" pos="{site} 0 0"/>'
    )


def mujoco_ways(four_bar: bool, seconds: float) -> dict[str, Callable[[], float]]:
    """The loop is closed by an equality constraint, as stiff as the step bears (solref of two steps)."""
    import mujoco

    def way(step: float, integrator: str) -> Callable[[], float]:
        (_, m2, c2, i2), (_, m3, c3, i3), (_, m4, c4, i4) = LINKS.values()
        three, four = angles(BEGIN, four_bar)
        text = MUJOCO.format(
            step=step,
            integrator=integrator,
            reference=2 * step,
            a=A,
            place=D if four_bar else 0.0,
            joint=JOINTS[four_bar],
            crank=inertial("A2", m2, c2, i2, str(A)),
            rod=inertial("B3", m3, c3, i3, str(B)),
            rocker=inertial("B4", *((m4, c4, i4, str(C)) if four_bar else (PISTON, 0.0, 0.0, "0"))),
        )
        m = mujoco.MjModel.from_xml_string(text)
        d = mujoco.MjData(m)
        w3, w4 = rates(BEGIN, four_bar)
        piston = A * cos(BEGIN) + B * cos(three)
        steps = round(seconds / step)

        def run() -> float:
            mujoco.mj_resetData(m, d)
            d.qpos[:] = BEGIN, three - BEGIN, four if four_bar else piston
            d.qvel[:] = SPEED, w3 - SPEED, w4
            d.ctrl[0] = TORQUE
            mujoco.mj_step(m, d, steps)
            return float(d.qpos[0])

        return run

    return {
        f"MuJoCo, {integrator}, {step * 1e6:g} us": way(step, integrator)
        for integrator in ("Euler", "RK4")
        for step in (1e-2, 2e-3, 1e-3, 2e-4, 5e-5)
    }


def rates(q: float, four_bar: bool) -> tuple[float, float]:
    """Speeds of rod and rocker (piston) at the start, by the loop."""
    three, four = angles(q, four_bar)
    e3, v = 1j * B * np.exp(1j * three), 1j * A * SPEED * np.exp(1j * q)
    last = -1j * C * np.exp(1j * four) if four_bar else -1.0 + 0j
    w3, w4 = np.linalg.solve([[e3.real, last.real], [e3.imag, last.imag]], [-v.real, -v.imag])
    return float(w3), float(w4)


def exudyn_ways(four_bar: bool, seconds: float) -> dict[str, Callable[[], float]]:
    """Rigid bodies of the plane and revolute joints, generalised alpha, as its own example of a slider-crank."""
    import exudyn as exu
    from exudyn import utilities as eu

    three, four = angles(BEGIN, four_bar)
    w3, w4 = rates(BEGIN, four_bar)
    pin, end = A * np.exp(1j * BEGIN), A * np.exp(1j * BEGIN) + B * np.exp(1j * three)
    (_, m2, c2, i2), (_, m3, c3, i3), (_, m4, c4, i4) = LINKS.values()
    poses = {
        "crank": (m2, c2, i2, 0j, BEGIN, 0j, SPEED),
        "rod": (m3, c3, i3, pin, three, 1j * SPEED * pin, w3),
        "rocker": (m4, c4, i4, D + 0j, four, 0j, w4)
        if four_bar
        else (PISTON, 0.0, 1e-9, end, 0.0, w4 + 0j, 0.0),
    }

    def way(step: float) -> Callable[[], float]:
        mbs = exu.SystemContainer().AddSystem()
        ground = mbs.AddObject(eu.ObjectGround())
        body, nodes = {}, {}
        for name, (mass, c, inertia, place, turn, v, w) in poses.items():
            g = c * np.exp(1j * turn)
            at, rate = place + g, v + 1j * w * g
            nodes[name] = mbs.AddNode(
                eu.NodeRigidBody2D(
                    referenceCoordinates=[at.real, at.imag, turn], initialVelocities=[rate.real, rate.imag, w]
                )
            )
            body[name] = mbs.AddObject(eu.RigidBody2D(mass=mass, inertia=inertia, nodeNumber=nodes[name]))
            heavy = mbs.AddMarker(eu.MarkerBodyPosition(bodyNumber=body[name]))
            mbs.AddLoad(eu.Force(markerNumber=heavy, loadVector=[0, -mass * G, 0]))

        def marker(name: str, x: float) -> Any:
            number, offset = (ground, 0.0) if name == "ground" else (body[name], poses[name][1])
            return mbs.AddMarker(eu.MarkerBodyPosition(bodyNumber=number, localPosition=[x - offset, 0, 0]))

        def joint(one: tuple[str, float], two: tuple[str, float]) -> None:
            mbs.AddObject(eu.RevoluteJoint2D(markerNumbers=[marker(*one), marker(*two)]))

        joint(("ground", 0.0), ("crank", 0.0))
        joint(("crank", A), ("rod", 0.0))
        joint(("rod", B), ("rocker", C if four_bar else 0.0))
        if four_bar:
            joint(("ground", D), ("rocker", 0.0))
        else:
            still = mbs.AddMarker(
                eu.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(eu.NodePointGround()), coordinate=0)
            )
            for k in (1, 2):
                own = mbs.AddMarker(eu.MarkerNodeCoordinate(nodeNumber=nodes["rocker"], coordinate=k))
                mbs.AddObject(eu.CoordinateConstraint(markerNumbers=[still, own]))
        turned = mbs.AddMarker(eu.MarkerBodyRigid(bodyNumber=body["crank"]))
        mbs.AddLoad(eu.Torque(markerNumber=turned, loadVector=[0, 0, TORQUE]))
        mbs.Assemble()
        settings = exu.SimulationSettings()
        settings.timeIntegration.numberOfSteps = round(seconds / step)
        settings.timeIntegration.endTime = seconds
        settings.timeIntegration.verboseMode = 0
        settings.timeIntegration.newton.useModifiedNewton = True
        settings.timeIntegration.generalizedAlpha.spectralRadius = 1.0 if four_bar else 0.9
        settings.timeIntegration.generalizedAlpha.useIndex2Constraints = True
        settings.timeIntegration.generalizedAlpha.useNewmark = True
        settings.solution.file.write = False

        def run() -> float:
            mbs.SolveDynamic(settings)
            return float(mbs.GetNodeOutput(nodes["crank"], exu.OutputVariableType.Coordinates)[2]) + BEGIN

        return run

    steps = (1e-2, 4e-3, 2e-3, 1e-3, 2e-4, 5e-5)
    alone = {f"Exudyn, {step * 1e6:g} us": way(step) for step in steps}
    return alone | {f"Exudyn and model, {step * 1e6:g} us": lambda s=step: way(s)() for step in steps}


def measured(ways: dict[str, Callable[[], float]], known: float) -> dict[str, tuple[float, float]]:
    """Median seconds and error (rad) of each, in turns; short ones are repeated within theirs."""
    errors = {name: abs(way() - known) for name, way in ways.items()}
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(REPEAT):
        for name, way in ways.items():
            start, count = perf_counter(), 0
            while perf_counter() - start < TURN:
                way()
                count += 1
            times[name].append((perf_counter() - start) / count)
    return {name: (median(t), errors[name]) for name, t in times.items()}


def main() -> None:
    if sys.argv[1:] in (["rubbing"], ["designs"]):
        {"rubbing": rubbing, "designs": designs}[sys.argv[1]]()
        return
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else SECONDS
    for four_bar in (True, False):
        title = "Four-bar" if four_bar else "Slider-crank"
        finest = float(da.simulate(model(four_bar), seconds, count=2, tolerance=1e-13).position("O2")[-1])
        gap = abs(finest - reference(four_bar, seconds))
        print(
            f"\n{title}, {seconds:g} s, {(finest - BEGIN) / (2 * pi):.1f} turns; LSODA's differs by {gap:.1e} rad"
        )
        ways: dict[str, Callable[[], float]] = {}
        for family in (ours, mujoco_ways, exudyn_ways):
            try:
                ways |= family(four_bar, seconds)
            except ImportError as error:
                print(f"left out: {error}")
        found = measured(ways, finest)
        for name, (time, error) in found.items():
            print(f"{name:36} {time * 1e3:10.2f} ms {error:10.1e} rad")
        compare(found)
        many(four_bar)
    rubbing()
    flywheels()


RUBBING = {"A": {"coefficient": 0.1, "radius": 0.01}, "S": {"coefficient": 0.1}}
"""Friction of two joints of the slider-crank."""


def rubbing() -> None:
    """Dry friction: the press of the guide, and the slider-crank with two joints that rub, against the same without
    friction and against friction solved in numpy at each state; and 16 designs of the press as a study takes them."""
    press = da.load(Path(__file__).parents[1] / "docs" / "press.yaml")
    crank = model(False)
    joints = {f"joints.{name}.friction": friction for name, friction in RUBBING.items()}
    rough = da.mechanism(crank.model_dump(mode="json")).with_values(joints)
    smooth = press.with_values({f"joints.{name}.friction": None for name in press.joints})
    print("\ndry friction, CPU time |  machine code      numpy   ratio | frictionless | events, largest gap")
    for name, m, free, until in (
        ("press, 8 s", press, smooth, 8.0),
        ("slider-crank, 1 s", rough, crank, 1.0),
    ):
        coded, solved, bare = (
            _seconds(partial(da.simulate, of, until, count=201), fast)
            for of, fast in ((m, True), (m, False), (free, True))
        )
        gap = max(
            (abs(a.time - b.time) for a, b in zip(coded[1].events, solved[1].events, strict=True)), default=0
        )
        print(
            f"{name:22} | {1e3 * coded[0]:10.1f} ms {1e3 * solved[0]:7.0f} ms {solved[0] / coded[0]:6.0f}x | "
            f"{1e3 * bare[0]:9.1f} ms | {len(coded[1].events)}, {gap:.0e} s"
        )
    designs()


def designs() -> None:
    """Designs of the press as a study takes them, 2 s each, with the peak of a joint force over instants and events:
    side by side in machine code, and one after the other by da.simulate with one equation; one thread."""
    press = da.load(Path(__file__).parents[1] / "docs" / "press.yaml")
    paths, names = ("mu", "links.ram.mass"), ("time", "O.speed", "reaction.A.magnitude")
    plan = SimulationPlan((2.0,))
    many = make_motion_engine(press, paths, names, "peak", plan)
    alone = SimulationEngine(press, paths, names, "peak", False, None, "", plan)
    values = np.random.default_rng(1).uniform(0.9, 1.1, (256, 2)) * [0.08, 60.0]
    few, ratios, times = values[:4], [], []
    many.block(few), alone.block(few)
    for _ in range(REPEAT):
        start = process_time()
        found = many.block(values)
        middle = process_time()
        known = alone.block(few)
        each = (middle - start) / len(values), (process_time() - middle) / len(few)
        ratios.append(each[1] / each[0])
        times.append(each)
    gaps = [np.abs(found[n][: len(few)] / known[n] - 1).max() for n in names]
    side, one = (1e3 * median(x) for x in zip(*times, strict=True))
    print(
        f"a design of the press, 2 s: {side:.2f} ms of {len(values)} side by side, {one:.0f} ms alone, "
        f"{median(ratios):.0f}x; largest difference {max(gaps):.0e}; status {set(found['status'].tolist())}"
    )


def _seconds(run: Callable[[], Any], fast: bool) -> tuple[float, Any]:
    """Median CPU time of a motion whose equation is known, and the motion; without machine code for friction if not
    ``fast``."""
    machine = CodedState.machine
    if not fast:
        CodedState.machine = lambda state, t, y: None  # type: ignore[method-assign]
    try:
        answer, times = run(), []
        for _ in range(REPEAT if fast else 1):
            start = process_time()
            run()
            times.append(process_time() - start)
    finally:
        CodedState.machine = machine  # type: ignore[method-assign]
    return median(times), answer


def flywheels() -> None:
    """The flywheel of the bundled engine in the plane, and lifted into space, where its reactions are redundant."""
    plane = da.load(examples()["engine"])
    results = {
        name: da.dynamics(m, positions=72) for name, m in (("plane", plane), ("space", da.lifted(plane)))
    }
    size = da.flywheel(results["plane"], Cs=0.02).exact_size
    print()
    for name, r in results.items():

        def way(r: Any = r) -> float:
            return float(da.flywheel(r, Cs=0.02).exact_size.inertia)

        ((time, error),) = measured({"": way}, size.inertia).values()
        print(
            f"da.flywheel, engine, {name:23} {time * 1e3:10.2f} ms, {error / size.inertia:.1e} off the plane's"
        )


def many(four_bar: bool) -> None:
    """Designs with masses, torque and speed changed by up to 20 %, peak of a joint force over 201 instants each."""
    vary = ["links.rod.mass", "links.rocker.mass", "drives.O2.effort", "start.O2.speed"]
    k = da.compile_motion(model(four_bar), 1.0, vary, ["reaction.A.magnitude"], "peak", tolerance=1e-8)
    values = k.nominal * np.random.default_rng(1).uniform(0.8, 1.2, (2048, 4))
    times = []
    for _ in range(REPEAT):
        start = perf_counter()
        r = k(values, threads=1)
        times.append(perf_counter() - start)
    turns = float((r.position[:, 0] - BEGIN).sum() / (2 * pi))
    print(
        f"da.compile_motion, tolerance 1e-08, {len(values)} designs: {turns / median(times):,.0f} turns a second a core"
    )


def compare(found: dict[str, tuple[float, float]]) -> None:
    """For each accuracy, the fastest of each program that reaches it."""
    programs = ("da.simulate,", "da.simulate with checks,", "da.simulate and model,")
    rivals = {"MuJoCo,": 0, "Exudyn,": 0, "Exudyn, / with checks": 1, "Exudyn and model,": 2}
    print(
        "reached, rad | ms: motion, with checks, and model | times as long: MuJoCo, Exudyn, / with checks, and model"
    )
    for most in (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8):

        def best(who: str, most: float = most) -> float:
            return min((t for n, (t, e) in found.items() if n.startswith(who) and e <= most), default=np.inf)

        own = [best(who) for who in programs]
        ratios = [best(who.split(" /")[0]) / own[k] for who, k in rivals.items()]
        said = [f"{x:8.1f}" if np.isfinite(x) else "       -" for x in ratios]
        print(f"{most:12.0e} | {' '.join(f'{1e3 * t:8.2f}' for t in own)} | {' '.join(said)}")


if __name__ == "__main__":
    main()
