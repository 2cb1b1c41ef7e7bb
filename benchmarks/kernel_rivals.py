"""One four-bar cycle by other means, each as its users would write it: nanoseconds a position, and lines they write
(ours with the description of the mechanism; the numbers themselves are counted for nobody).

Every rival answers the same question: the input torque (and what comes with it) of the four-bar of linkages.py at 720
positions, at constant drive rates. Those that are not installed are left out and named. Answers are compared with
da.dynamics in the same run, and each row prints its difference; one that differs by more than 5 % does not solve the
task and is left out by name.

    python benchmarks/kernel_rivals.py
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Callable
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from benchmarks.kernel import nanoseconds
from benchmarks.linkages import FOUR_BAR, four_bar

import dalembert as da

COUNT = 720
ANOTHER = 0.05
"""Difference of the torque, over the largest one, from which on a row does not solve the same task."""
N = list(FOUR_BAR.values())


def closed_form(n: Any, c: Any, s: Any, sqrt: Any) -> Any:
    """Torque of one position, or of arrays of them: the textbook's formulas."""
    a, b, r, gx, gy, m2, x2, y2, i2, m3, x3, y3, i3, m4, x4, y4, i4, fx, fy, px, py, t4, w2, al2 = n
    ax, ay = a * c, a * s
    dx, dy = gx - ax, gy - ay
    d2 = dx * dx + dy * dy
    t = 0.5 * ((b * b - r * r) / d2 + 1)
    h = sqrt(b * b / d2 - t * t)
    ex, ey = t * dx - h * dy, t * dy + h * dx
    sx, sy = ex - dx, ey - dy
    c3, s3, c4, s4 = ex / b, ey / b, sx / r, sy / r
    det = ex * sy - ey * sx
    vx, vy = -w2 * ay, w2 * ax
    w3, w4 = -(vx * sx + vy * sy) / det, -(vx * ex + vy * ey) / det
    ux, uy = -al2 * ay - w2 * w2 * ax, al2 * ax - w2 * w2 * ay
    qx, qy = ux - w3 * w3 * ex + w4 * w4 * sx, uy - w3 * w3 * ey + w4 * w4 * sy
    al3, al4 = -(qx * sx + qy * sy) / det, -(qx * ex + qy * ey) / det
    g2x, g2y = x2 * c - y2 * s, x2 * s + y2 * c
    g3x, g3y = x3 * c3 - y3 * s3, x3 * s3 + y3 * c3
    g4x, g4y = x4 * c4 - y4 * s4, x4 * s4 + y4 * c4
    f2x, f2y = m2 * (-al2 * g2y - w2 * w2 * g2x), m2 * (al2 * g2x - w2 * w2 * g2y)
    a3x, a3y = m3 * (ux - al3 * g3y - w3 * w3 * g3x), m3 * (uy + al3 * g3x - w3 * w3 * g3y)
    f4x, f4y = m4 * (-al4 * g4y - w4 * w4 * g4x), m4 * (al4 * g4x - w4 * w4 * g4y)
    p3x, p3y = px * c3 - py * s3, px * s3 + py * c3
    k3 = i3 * al3 + g3x * a3y - g3y * a3x - (p3x * fy - p3y * fx)
    k4 = i4 * al4 + g4x * f4y - g4y * f4x - t4
    bx, by = -(k3 * sx + k4 * ex) / det, -(k3 * sy + k4 * ey) / det
    return i2 * al2 + g2x * f2y - g2y * f2x + ax * (a3y - fy + by) - ay * (a3x - fx + bx)


def timed(call: Callable[[], object], repeat: int) -> float:
    call()
    found = []
    for _ in range(repeat):
        start = perf_counter()
        call()
        found.append(perf_counter() - start)
    return median(found) / COUNT * 1e9


def lines(function: Callable[..., Any]) -> int:
    import inspect

    return sum(1 for line in inspect.getsource(function).splitlines() if line.strip() and '"""' not in line)


def casadi_ways(q: Any, expected: Any) -> dict[str, tuple[float, float]]:
    import casadi as ca

    x = ca.SX.sym("q")
    f = ca.Function("f", [x], [closed_form(N, ca.cos(x), ca.sin(x), ca.sqrt)])
    mapped = f.map(len(q))
    out = {
        "casadi, virtual machine": (timed(lambda: mapped(q), 50), off(np.array(mapped(q)).ravel(), expected))
    }
    if shutil.which("gcc"):
        with tempfile.TemporaryDirectory() as folder:
            code = ca.CodeGenerator("f.c", {"with_header": False})
            code.add(mapped)
            code.generate(folder + "/")
            options = ["-O3", "-march=native", "-shared", "-fPIC", "-o", f"{folder}/f.so", "-lm"]
            subprocess.run(["gcc", f"{folder}/f.c", *options], check=True)
            compiled = ca.external(mapped.name(), f"{folder}/f.so")
            found = np.array(compiled(q)).ravel()
            out["casadi, its C through gcc"] = timed(lambda: compiled(q), 200), off(found, expected)
    return out


def numba_loop(q: Any, expected: Any) -> tuple[float, float]:
    import numba

    inner = numba.njit(fastmath=True)(closed_form)

    @numba.njit(fastmath=True)
    def cycle(n: Any, c: Any, s: Any, out: Any) -> None:
        for k in range(len(c)):
            out[k] = inner(n, c[k], s[k], np.sqrt)

    n, c, s, out = tuple(N), np.cos(q), np.sin(q), np.empty(len(q))
    seconds = timed(lambda: cycle(n, c, s, out), 300)
    return seconds, off(out, expected)


def numpy_arrays(q: Any, expected: Any) -> tuple[float, float]:
    c, s = np.cos(q), np.sin(q)
    return timed(lambda: closed_form(N, c, s, np.sqrt), 200), off(closed_form(N, c, s, np.sqrt), expected)


def numpy_batched(q: Any, expected: Any) -> tuple[float, float]:
    """Newton's and Euler's equations of the three links as a 9 x 9 system a position, solved as one stack."""
    a, b, r, gx, gy, m2, x2, y2, i2, m3, x3, y3, i3, m4, x4, y4, i4, fx, fy, px, py, t4, w2, al2 = N

    def cycle() -> Any:
        q2 = q % (2 * np.pi)
        ax, ay = a * np.cos(q2), a * np.sin(q2)
        d, phi = np.hypot(gx - ax, gy - ay), np.arctan2(gy - ay, gx - ax)
        q3 = phi + np.arccos((b * b + d * d - r * r) / (2 * b * d))
        ex, ey = b * np.cos(q3), b * np.sin(q3)
        q4 = np.arctan2(ay + ey - gy, ax + ex - gx)
        sx, sy = r * np.cos(q4), r * np.sin(q4)
        loop = np.array([[-ey, sy], [ex, -sx]]).transpose(2, 0, 1)

        def rates(x: Any, y: Any) -> Any:
            return np.linalg.solve(loop, np.stack([-x, -y], axis=1)[..., None])[..., 0].T

        w3, w4 = rates(-w2 * ay, w2 * ax)
        ux, uy = -al2 * ay - w2**2 * ax, al2 * ax - w2**2 * ay
        al3, al4 = rates(ux - w3**2 * ex + w4**2 * sx, uy - w3**2 * ey + w4**2 * sy)

        def center(x: float, y: float, angle: Any, w: Any, al: Any, ux: Any, uy: Any) -> Any:
            cx, cy = x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)
            return cx, cy, ux - al * cy - w**2 * cx, uy + al * cx - w**2 * cy

        c2x, c2y, a2x, a2y = center(x2, y2, q2, w2, al2, 0, 0)
        c3x, c3y, a3x, a3y = center(x3, y3, q3, w3, al3, ux, uy)
        c4x, c4y, a4x, a4y = center(x4, y4, q4, w4, al4, 0, 0)
        jx, jy = px * np.cos(q3) - py * np.sin(q3), px * np.sin(q3) + py * np.cos(q3)
        matrix, right = np.zeros((len(q), 9, 9)), np.zeros((len(q), 9))  # O2, A, B, O4 (x, y), torque
        for row, plus, minus in ((0, 0, 2), (3, 2, 4), (6, 4, 6)):
            matrix[:, [row, row + 1], [plus, plus + 1]] = 1
            matrix[:, [row, row + 1], [minus, minus + 1]] = -1
        for row, at, x, y, sign in (
            (2, 0, -c2x, -c2y, 1),
            (2, 2, ax - c2x, ay - c2y, -1),
            (5, 2, -c3x, -c3y, 1),
            (5, 4, ex - c3x, ey - c3y, -1),
            (8, 4, sx - c4x, sy - c4y, 1),
            (8, 6, -c4x, -c4y, -1),
        ):
            matrix[:, row, at], matrix[:, row, at + 1] = -sign * y, sign * x
        matrix[:, 2, 8] = 1
        right[:, 0], right[:, 1], right[:, 2] = m2 * a2x, m2 * a2y, i2 * al2
        right[:, 3], right[:, 4] = m3 * a3x - fx, m3 * a3y - fy
        right[:, 5] = i3 * al3 - ((jx - c3x) * fy - (jy - c3y) * fx)
        right[:, 6], right[:, 7], right[:, 8] = m4 * a4x, m4 * a4y, i4 * al4 - t4
        return np.linalg.solve(matrix, right[..., None])[:, 8, 0]

    return timed(cycle, 30), off(cycle(), expected)


def python_loop(q: Any, expected: Any) -> tuple[float, float]:
    from math import cos, sin, sqrt

    def cycle() -> list[float]:
        return [closed_form(N, cos(x), sin(x), sqrt) for x in q]

    return timed(cycle, 20), off(np.array(cycle()), expected)


def mujoco_inverse(q: Any, expected: Any) -> tuple[float, float]:
    """Inverse dynamics of the open chains, the pin's force from its Jacobian: mj_inverse alone leaves the force of a
    closed loop to its soft constraint, which is zero in a motion that keeps the constraint."""
    import mujoco

    a, b, r, gx, gy = N[:5]
    m2, x2, y2, i2, m3, x3, y3, i3, m4, x4, y4, i4 = N[5:17]
    fx, fy, px, py, t4 = N[17:22]

    def body(mass: float, x: float, y: float, inertia: float) -> str:
        return (
            f'<inertial pos="{x} {y} 0" mass="{mass}" diaginertia="{inertia / 2} {inertia / 2} {inertia}"/>'
        )

    sites = f'<site name="B3" pos="{b} 0 0"/><site name="P" pos="{px} {py} 0"/>'
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option gravity="0 0 0"/><worldbody>
      <body name="crank"><joint name="q2" axis="0 0 1"/>{body(m2, x2, y2, i2)}
        <body name="coupler" pos="{a} 0 0"><joint name="q3" axis="0 0 1"/>{body(m3, x3, y3, i3)}{sites}</body></body>
      <body name="rocker" pos="{gx} {gy} 0"><joint name="q4" axis="0 0 1"/>{body(m4, x4, y4, i4)}
        <site name="B4" pos="{r} 0 0"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    motion = da.kinematics(four_bar(len(q)))

    def relative(what: str) -> Any:
        crank, coupler, rocker = (getattr(motion, what)(link) for link in ("crank", "coupler", "rocker"))
        return np.stack([crank, coupler - crank, rocker], axis=1)

    place, rate, second = relative("angle"), relative("speed"), relative("acceleration")
    jacobians = np.empty((3, 3, 3))
    ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, name) for name in ("B3", "B4", "P")]
    out = np.empty(len(q))

    def cycle() -> None:
        for k in range(len(q)):
            data.qpos[:], data.qvel[:], data.qacc[:] = place[k], rate[k], second[k]
            mujoco.mj_inverse(model, data)
            for j, site in zip(jacobians, ids, strict=True):
                mujoco.mj_jacSite(model, data, j, None, site)
            j3, j4, jp = jacobians[:, :2]
            tau = data.qfrc_inverse - jp.T @ [fx, fy] - [0, 0, t4]
            force = np.linalg.solve((j3 - j4)[:, 1:].T, tau[1:])
            out[k] = tau[0] - (j3 - j4)[:, 0] @ force

    return timed(cycle, 20), off(out, expected)


def pinocchio_constrained(q: Any, expected: Any) -> tuple[float, float]:
    """Rigid constraint at B, torque from the joint-space inverse dynamics and the constraint's Jacobian."""
    import pinocchio as pin

    a, b, r, gx, gy = N[:5]
    m2, x2, y2, i2, m3, x3, y3, i3, m4, x4, y4, i4 = N[5:17]
    fx, fy, px, py, t4 = N[17:22]
    model = pin.Model()
    model.gravity = pin.Motion.Zero()

    def add(
        parent: int, place: list[float], mass: float, x: float, y: float, inertia: float, name: str
    ) -> int:
        joint = model.addJoint(parent, pin.JointModelRZ(), pin.SE3(np.eye(3), np.array(place)), name)
        inertia3 = pin.Inertia(mass, np.array([x, y, 0.0]), np.diag([inertia / 2, inertia / 2, inertia]))
        model.appendBodyToJoint(joint, inertia3, pin.SE3.Identity())
        return int(joint)

    crank = add(0, [0, 0, 0], m2, x2, y2, i2, "q2")
    coupler = add(crank, [a, 0, 0], m3, x3, y3, i3, "q3")
    rocker = add(0, [gx, gy, 0], m4, x4, y4, i4, "q4")
    at = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    frames = [
        model.addFrame(pin.Frame(n, j, pin.SE3(np.eye(3), np.array([x, y, 0.0])), pin.FrameType.OP_FRAME))
        for n, j, x, y in (("B3", coupler, b, 0.0), ("B4", rocker, r, 0.0), ("P", coupler, px, py))
    ]
    data = model.createData()
    motion = da.kinematics(four_bar(len(q)))
    columns = []
    for what in ("angle", "speed", "acceleration"):
        of_crank, of_coupler, of_rocker = (getattr(motion, what)(n) for n in ("crank", "coupler", "rocker"))
        columns.append(np.stack([of_crank, of_coupler - of_crank, of_rocker], axis=1))
    out = np.empty(len(q))

    def cycle() -> None:
        for k in range(len(q)):
            place, rate, second = (c[k] for c in columns)
            tau = pin.rnea(model, data, place, rate, second)
            pin.computeJointJacobians(model, data, place)
            pin.updateFramePlacements(model, data)
            j3, j4, jp = (pin.getFrameJacobian(model, data, f, at)[:2] for f in frames)
            tau = tau - jp.T @ [fx, fy] - [0, 0, t4]
            force = np.linalg.solve((j3 - j4)[:, 1:].T, tau[1:])
            out[k] = tau[0] - (j3 - j4)[:, 0] @ force

    return timed(cycle, 10), off(out, expected)


def exudyn_steps(q: Any, expected: Any) -> tuple[float, float]:
    """A simulation of one turn at the crank's speed, one implicit step a position; its solver's time. The crank of a
    simulation cannot have an acceleration at a constant speed: its torque is compared with ours without one."""
    import exudyn as exu
    from exudyn import utilities as eu

    a, b, r, gx, gy = N[:5]
    m2, x2, y2, i2, m3, x3, y3, i3, m4, x4, y4, i4 = N[5:17]
    fx, fy, px, py, t4 = N[17:22]
    motion = da.kinematics(four_bar(len(q)))
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(eu.ObjectGround())
    bodies = {}
    masses = (("crank", m2, x2, y2, i2), ("coupler", m3, x3, y3, i3), ("rocker", m4, x4, y4, i4))
    for name, mass, x, y, inertia in masses:
        angle, rate = motion.angle(name)[0], motion.speed(name)[0]
        c, v = motion.center(name)[0], motion.center_velocity(name)[0]
        node = mbs.AddNode(eu.NodeRigidBody2D(referenceCoordinates=[*c, angle], initialVelocities=[*v, rate]))
        bodies[name] = mbs.AddObject(eu.RigidBody2D(mass=mass, inertia=inertia, nodeNumber=node)), node, x, y

    def marker(name: str, x: float, y: float) -> Any:
        body, _, cx, cy = bodies[name]
        return mbs.AddMarker(eu.MarkerBodyRigid(bodyNumber=body, localPosition=[x - cx, y - cy, 0]))

    def fixed(x: float, y: float) -> Any:
        return mbs.AddMarker(eu.MarkerBodyRigid(bodyNumber=ground, localPosition=[x, y, 0]))

    for one, two in (
        (fixed(0.0, 0.0), marker("crank", 0, 0)),
        (marker("crank", a, 0), marker("coupler", 0, 0)),
        (marker("coupler", b, 0), marker("rocker", r, 0)),
        (fixed(gx, gy), marker("rocker", 0, 0)),
    ):
        mbs.AddObject(eu.RevoluteJoint2D(markerNumbers=[one, two]))
    angle = mbs.AddMarker(eu.MarkerNodeCoordinate(nodeNumber=bodies["crank"][1], coordinate=2))
    base = mbs.AddMarker(eu.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(eu.NodePointGround()), coordinate=0))
    speed = N[22]
    mbs.AddLoad(eu.Force(markerNumber=marker("coupler", px, py), loadVector=[fx, fy, 0]))
    mbs.AddLoad(eu.Torque(markerNumber=marker("rocker", 0, 0), loadVector=[0, 0, t4]))
    drive = mbs.AddObject(
        eu.CoordinateConstraint(
            markerNumbers=[base, angle],
            offset=speed,
            velocityLevel=True,
        )
    )
    torque = mbs.AddSensor(
        eu.SensorObject(
            objectNumber=drive, storeInternal=True, outputVariableType=exu.OutputVariableType.Force
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps, settings.timeIntegration.endTime = len(q), 2 * np.pi / speed
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.5 * settings.timeIntegration.endTime / len(q)

    def cycle() -> None:
        mbs.SolveDynamic(settings)

    seconds, found = timed(cycle, 3), mbs.GetSensorStoredData(torque)
    later = (found[:, 0] * speed > 1) & (found[:, 0] * speed < 6)  # behind what the start sets ringing
    steady = da.dynamics(four_bar(len(q)).with_values({"drives.O2.acceleration": 0.0})).effort("O2")
    return seconds, off(-found[later, 1], np.interp(found[later, 0] * speed, q, steady))


def off(found: Any, expected: Any) -> float:
    return float(np.abs(found - expected).max() / np.abs(expected).max())


def main() -> None:
    m = four_bar(COUNT)
    k = da.compile(m, vary=list(FOUR_BAR), outputs=["effort.O2"])
    g = da.dynamics(m)
    q, expected = g.schedule.position[:, 0], g.effort("O2")
    rows: list[tuple[str, float, float, int]] = []
    size, described = lines(closed_form), lines(four_bar)
    rows.append(
        (
            "da.compile, machine code (torque)",
            nanoseconds(k),
            off(k().effort("O2")[0], expected),
            described + 3,
        )
    )
    rows.append(
        ("da.compile, a call of k()", timed(k, 200), off(k().effort("O2")[0], expected), described + 3)
    )
    rows.append(("da.dynamics (everything)", timed(lambda: da.dynamics(m), 5), 0.0, described + 2))
    ways: list[tuple[str, Callable[..., Any], int]] = [
        ("numba, closed form in a loop", numba_loop, size + 8),
        ("numpy, closed form over arrays", numpy_arrays, size + 2),
        ("numpy, batched 9 x 9 solve", numpy_batched, lines(numpy_batched)),
        ("python, closed form in a loop", python_loop, size + 2),
        ("mujoco, mj_inverse and Jacobians", mujoco_inverse, lines(mujoco_inverse)),
        ("pinocchio, rnea and Jacobians", pinocchio_constrained, lines(pinocchio_constrained)),
        ("exudyn, one turn in time", exudyn_steps, lines(exudyn_steps)),
    ]
    try:
        rows += [(name, *found, size + 4) for name, found in casadi_ways(q, expected).items()]
    except ImportError:
        print("casadi is not installed")
    for name, way, count in ways:
        try:
            rows.append((name, *way(q, expected), count))
        except ImportError as error:
            print(f"{name}: {error}")
        except Exception as error:  # a rival's interface may have changed; say so and go on
            print(f"{name}: {type(error).__name__}: {error}")
    print(f"{'':36s} {'ns a position':>13s} {'lines':>6s}  difference of the torque")
    for row in [row for row in rows if not row[2] <= ANOTHER]:
        print(f"{row[0]}: left out, its torque differs by {row[2]:.0e} of the largest")
        rows.remove(row)
    for name, seconds, difference, count in sorted(rows, key=lambda row: row[1]):
        print(f"{name:36s} {seconds:13.1f} {count:6d}  {difference:.0e}")


if __name__ == "__main__":
    main()
