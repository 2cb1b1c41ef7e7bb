"""A spatial four-bar RSSR over a cycle: dalembert's Python call against multibody programs, one thread, same run.

Method. All are asked for the driving torque of the same crank-rocker with masses, inertias and gravity at the same
positions, at a steady speed. dalembert's kernel (``da.compile``) answers 100 designs of other numbers at once, all
reactions and the torque, positions with them; its time is that of the call over the positions. dalembert is called as
a user calls it on a description already loaded (``da.dynamics(m)``, which gives all reactions too), after one warming
call. Pinocchio, MuJoCo and Drake compute trees: their users open the loop at one ball, close it by Newton's method
with the programs' Jacobians position by position (from the position before), and find the torque and the three forces
of the cut from the programs' inverse dynamics: the same few lines around each of them. Exudyn simulates: its user
holds the crank's speed, starts from consistent velocities (ours) and reads the torque of the constraint, one implicit
step a position; only its solver is timed, and its torque is as good as the step. Their torques are compared with ours
first. Medians of wall and of processor time over the repeats, in turns; those not installed are named.

    python benchmarks/rssr.py [--repeat 15]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from collections.abc import Callable  # noqa: E402
from statistics import median  # noqa: E402
from time import perf_counter, process_time  # noqa: E402
from typing import Any  # noqa: E402

import numpy as np  # noqa: E402

COUNT = 720
SPEED, GRAVITY = 18.0, np.array([0.0, 0.0, -9.80665])
P, A, B, C = (np.array(p) for p in ([0.0, 0, 0], [0.1, 0, 0], [0.4, 0.1, 0.3], [0.4, 0.1, 0.0]))
CRANK_AXIS, ROCKER_AXIS = np.array([0.0, 0, 1]), np.array([0.1, 1.0, 0.05]) / np.sqrt(1.0125)
ROD = (B - A) / np.linalg.norm(B - A)
MASS = {"crank": 1.2, "rod": 0.9, "rocker": 1.7}
CENTER = {"crank": np.array([0.03, 0.01, 0.02]), "rod": (A + B) / 2, "rocker": np.array([0.41, 0.1, 0.12])}
INERTIA = {
    "crank": np.diag([0.002, 0.003, 0.004]),
    "rod": 0.012 * (np.eye(3) - (1 - 1e-9) * np.outer(ROD, ROD)),  # thin: its idle spin plays no part
    "rocker": np.diag([0.01, 0.012, 0.005]),
}


def description(count: int) -> dict[str, Any]:
    """As drawn: all links' axes in ground's."""

    def link(name: str, **points: Any) -> dict[str, Any]:
        made = {"mass": MASS[name], "center": CENTER[name].tolist(), "inertia": INERTIA[name].tolist()}
        return made | {"points": {k: p.tolist() for k, p in points.items()}}

    return {
        "space": "space",
        "gravity": GRAVITY.tolist(),
        "links": {
            "ground": {"points": {"O": P.tolist(), "C": C.tolist()}},
            "crank": link("crank", O=P, A=A),
            "rod": link("rod", A=A, B=B),
            "rocker": link("rocker", C=C, B=B),
        },
        "joints": {
            "O": {"type": "revolute", "links": ["ground", "crank"], "axis": CRANK_AXIS.tolist()},
            "A": {"type": "spherical", "links": ["crank", "rod"]},
            "B": {"type": "spherical", "links": ["rod", "rocker"]},
            "C": {"type": "revolute", "links": ["ground", "rocker"], "axis": ROCKER_AXIS.tolist()},
        },
        "drives": {"O": {"position": {"from": 0, "to": 360, "count": count}, "speed": f"{SPEED} rad/s"}},
    }


class Tree:
    """A program's open tree: crank, rod, rocker, the ball B open; coordinates of its own, 5 speeds."""

    def home(self) -> None:
        """Stand as drawn."""
        raise NotImplementedError

    def put(self, turn: float) -> None:
        """Turn the crank to a position, the rest as it is."""
        raise NotImplementedError

    def gap(self) -> tuple[Any, Any]:
        """B of the rod less B of the rocker (3,), and its Jacobian (3, 5)."""
        raise NotImplementedError

    def add(self, dq: Any) -> None:
        """Move by small displacements (5,)."""
        raise NotImplementedError

    def drift(self, v: Any) -> Any:
        """Second rate of the gap (3,) at speeds v and no accelerations."""
        raise NotImplementedError

    def inverse(self, v: Any, a: Any) -> Any:
        """Generalised forces (5,) of a motion."""
        raise NotImplementedError


CRANK = 0
"""Place of the crank's speed."""


def cycle(tree: Tree, turns: Any) -> Any:
    """Torque at every position, as a user of such a program would find it."""
    free, out = [k for k in range(5) if k != CRANK], np.empty(len(turns))
    tree.home()
    for n, turn in enumerate(turns):
        tree.put(turn)
        for _ in range(20):
            gap, j = tree.gap()
            dq = np.zeros(5)
            dq[free] = np.linalg.lstsq(j[:, free], -gap, rcond=None)[0]
            tree.add(dq)
            if abs(dq).max() < 1e-9:
                break
        _, j = tree.gap()
        v, a = np.zeros(5), np.zeros(5)
        v[CRANK] = SPEED
        v[free] = np.linalg.lstsq(j[:, free], -j[:, CRANK] * SPEED, rcond=None)[0]
        a[free] = np.linalg.lstsq(j[:, free], -tree.drift(v), rcond=None)[0]
        force = tree.inverse(v, a)
        cut = np.linalg.lstsq(j[:, free].T, force[free], rcond=None)[0]
        out[n] = force[CRANK] - j[:, CRANK] @ cut
    return out


class Pinocchio(Tree):
    def __init__(self) -> None:
        import pinocchio as pin

        self.pin, model = pin, pin.Model()
        model.gravity.linear = GRAVITY
        turn, ball = pin.JointModelRevoluteUnaligned, pin.JointModelSpherical()
        crank = model.addJoint(0, turn(CRANK_AXIS), pin.SE3(np.eye(3), P), "O")
        rod = model.addJoint(crank, ball, pin.SE3(np.eye(3), A - P), "A")
        rocker = model.addJoint(0, turn(ROCKER_AXIS), pin.SE3(np.eye(3), C), "C")
        for joint, name, origin in ((crank, "crank", P), (rod, "rod", A), (rocker, "rocker", C)):
            inertia = pin.Inertia(MASS[name], CENTER[name] - origin, INERTIA[name])
            model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
        self.ends = [
            model.addFrame(pin.Frame(name, joint, pin.SE3(np.eye(3), B - at), pin.FrameType.OP_FRAME))
            for name, joint, at in (("rod B", rod, A), ("rocker B", rocker, C))
        ]
        self.model, self.data = model, model.createData()

    def home(self) -> None:
        self.q = self.pin.neutral(self.model)

    def put(self, turn: float) -> None:
        self.q[0] = turn

    def gap(self) -> tuple[Any, Any]:
        pin, axes = self.pin, self.pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pin.computeJointJacobians(self.model, self.data, self.q)
        pin.updateFramePlacements(self.model, self.data)
        a, b = (pin.getFrameJacobian(self.model, self.data, end, axes)[:3] for end in self.ends)
        p, r = (self.data.oMf[end].translation for end in self.ends)
        return p - r, a - b

    def add(self, dq: Any) -> None:
        self.q = self.pin.integrate(self.model, self.q, dq)

    def drift(self, v: Any) -> Any:
        pin, axes = self.pin, self.pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pin.forwardKinematics(self.model, self.data, self.q, v, np.zeros(5))
        a, b = (
            pin.getFrameClassicalAcceleration(self.model, self.data, end, axes).linear for end in self.ends
        )
        return a - b

    def inverse(self, v: Any, a: Any) -> Any:
        return self.pin.rnea(self.model, self.data, self.q, v, a).copy()


def _text(values: Any) -> str:
    return " ".join(f"{x:.17g}" for x in values)


class Mujoco(Tree):
    def __init__(self) -> None:
        import mujoco

        def body(name: str, at: Any, origin: Any, joint: str, inner: str = "") -> str:
            i = INERTIA[name]
            full = _text([i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])
            center = _text(CENTER[name] - origin)
            end = f'<site name="{name}B" pos="{_text(B - origin)}"/>' if name != "crank" else ""
            mass = f'<inertial pos="{center}" mass="{MASS[name]}" fullinertia="{full}"/>'
            return f'<body name="{name}" pos="{_text(at)}">{mass}{joint}{end}{inner}</body>'

        rod = body("rod", A - P, A, '<joint type="ball"/>')
        crank = body("crank", P, P, f'<joint type="hinge" axis="{_text(CRANK_AXIS)}"/>', rod)
        rocker = body("rocker", C, C, f'<joint type="hinge" axis="{_text(ROCKER_AXIS)}"/>')
        option = f'<option gravity="{_text(GRAVITY)}"/><compiler boundmass="0"/>'
        self.mj = mujoco
        self.model = mujoco.MjModel.from_xml_string(
            f"<mujoco>{option}<worldbody>{crank}{rocker}</worldbody></mujoco>"
        )
        self.data = mujoco.MjData(self.model)
        self.sites = [self.model.site(f"{name}B").id for name in ("rod", "rocker")]
        self.bodies = [self.model.body(name).id for name in ("rod", "rocker")]
        self.jac = np.zeros((2, 3, 5))

    def home(self) -> None:
        self.mj.mj_resetData(self.model, self.data)

    def put(self, turn: float) -> None:
        self.data.qpos[0] = turn

    def gap(self) -> tuple[Any, Any]:
        self.mj.mj_kinematics(self.model, self.data)
        self.mj.mj_comPos(self.model, self.data)
        for k, site in enumerate(self.sites):
            self.mj.mj_jacSite(self.model, self.data, self.jac[k], None, site)
        p, r = (self.data.site_xpos[site] for site in self.sites)
        return p - r, self.jac[0] - self.jac[1]

    def add(self, dq: Any) -> None:
        self.mj.mj_integratePos(self.model, self.data.qpos, dq, 1.0)

    def drift(self, v: Any) -> Any:
        self.data.qvel[:] = v
        self.mj.mj_fwdPosition(self.model, self.data)
        self.mj.mj_fwdVelocity(self.model, self.data)
        for k, (site, link) in enumerate(zip(self.sites, self.bodies, strict=True)):
            self.mj.mj_jacDot(self.model, self.data, self.jac[k], None, self.data.site_xpos[site], link)
        return (self.jac[0] - self.jac[1]) @ v

    def inverse(self, v: Any, a: Any) -> Any:
        self.data.qacc[:] = a
        self.mj.mj_inverse(self.model, self.data)
        return self.data.qfrc_inverse.copy()


class Drake(Tree):
    def __init__(self) -> None:
        from pydrake.math import RigidTransform
        from pydrake.multibody import plant as mbp
        from pydrake.multibody import tree as mbt

        self.t, plant = mbt, mbp.MultibodyPlant(0.0)
        plant.mutable_gravity_field().set_gravity_vector(GRAVITY)
        world, bodies = plant.world_frame(), {}
        for name, origin in (("crank", P), ("rod", A), ("rocker", C)):
            about = mbt.RotationalInertia(*np.diag(INERTIA[name]), *INERTIA[name][[0, 0, 1], [1, 2, 2]])
            spatial = mbt.SpatialInertia.MakeFromCentralInertia(MASS[name], CENTER[name] - origin, about)
            bodies[name] = plant.AddRigidBody(name, spatial)
        foot = plant.AddFrame(mbt.FixedOffsetFrame("C", world, RigidTransform(C)))
        knuckle = plant.AddFrame(
            mbt.FixedOffsetFrame("A", bodies["crank"].body_frame(), RigidTransform(A - P))
        )
        plant.AddJoint(mbt.RevoluteJoint("O", world, bodies["crank"].body_frame(), CRANK_AXIS))
        plant.AddJoint(mbt.BallRpyJoint("rod", knuckle, bodies["rod"].body_frame()))
        plant.AddJoint(mbt.RevoluteJoint("rocker", foot, bodies["rocker"].body_frame(), ROCKER_AXIS))
        plant.Finalize()
        self.plant, self.context, self.world = plant, plant.CreateDefaultContext(), world
        self.ends = [(bodies["rod"].body_frame(), B - A), (bodies["rocker"].body_frame(), B - C)]
        self.none = mbt.MultibodyForces(plant)
        self.v = self.t.JacobianWrtVariable.kV

    def home(self) -> None:
        self.plant.SetPositions(self.context, np.zeros(5))

    def put(self, turn: float) -> None:
        q = self.plant.GetPositions(self.context)
        q[0] = turn
        self.plant.SetPositions(self.context, q)

    def gap(self) -> tuple[Any, Any]:
        p, r = (
            self.plant.CalcPointsPositions(self.context, frame, at, self.world)[:, 0]
            for frame, at in self.ends
        )
        a, b = (
            self.plant.CalcJacobianTranslationalVelocity(
                self.context, self.v, frame, at, self.world, self.world
            )
            for frame, at in self.ends
        )
        return p - r, a - b

    def add(self, dq: Any) -> None:
        q = self.plant.GetPositions(self.context)
        self.plant.SetPositions(self.context, q + self.plant.MapVelocityToQDot(self.context, dq))

    def drift(self, v: Any) -> Any:
        self.plant.SetVelocities(self.context, v)
        a, b = (
            self.plant.CalcBiasTranslationalAcceleration(
                self.context, self.v, frame, at, self.world, self.world
            )[:, 0]
            for frame, at in self.ends
        )
        return a - b

    def inverse(self, v: Any, a: Any) -> Any:
        self.none.SetZero()
        self.plant.CalcForceElementsContribution(self.context, self.none)
        return self.plant.CalcInverseDynamics(self.context, a, self.none)


class Exudyn:
    """A simulation of one turn with the crank's speed held: joints as constraints, generalized-alpha steps."""

    def __init__(self, motion: Any) -> None:
        import exudyn as exu
        from exudyn import utilities as eu

        self.system = mbs = exu.SystemContainer().AddSystem()
        ground, bodies = mbs.CreateGround(), {}
        for name, mass in MASS.items():
            bodies[name] = mbs.CreateRigidBody(
                inertia=eu.RigidBodyInertia(mass=mass, inertiaTensor=INERTIA[name]),
                referencePosition=CENTER[name],
                initialVelocity=motion.center_velocity(name)[0],
                initialAngularVelocity=motion.speed(name)[0],
                gravity=GRAVITY,
                nodeType=exu.NodeType.RotationEulerParameters,
            )
        mbs.CreateSphericalJoint(itemNumbers=[bodies["crank"], bodies["rod"]], position=A)
        mbs.CreateSphericalJoint(itemNumbers=[bodies["rod"], bodies["rocker"]], position=B)
        mbs.CreateRevoluteJoint(itemNumbers=[ground, bodies["crank"]], position=P, axis=CRANK_AXIS)
        mbs.CreateRevoluteJoint(itemNumbers=[ground, bodies["rocker"]], position=C, axis=ROCKER_AXIS)
        node = mbs.GetObject(bodies["crank"])["nodeNumber"]
        turn = mbs.AddMarker(eu.MarkerNodeRotationCoordinate(nodeNumber=node, rotationCoordinate=2))
        still = mbs.AddNode(eu.NodePointGround())
        base = mbs.AddMarker(eu.MarkerNodeCoordinate(nodeNumber=still, coordinate=0))
        held = eu.CoordinateConstraint(markerNumbers=[base, turn], offset=SPEED, velocityLevel=True)
        torque = exu.OutputVariableType.Force
        self.sensor = mbs.AddSensor(
            eu.SensorObject(
                objectNumber=mbs.AddObject(held),
                outputVariableType=torque,
                storeInternal=True,
                writeToFile=False,
            )
        )
        mbs.Assemble()
        self.settings = exu.SimulationSettings()
        steps = self.settings.timeIntegration
        steps.numberOfSteps, steps.endTime, steps.verboseMode = COUNT, 2 * np.pi / SPEED, 0
        self.settings.solution.file.write = False
        self.settings.solution.sensors.writePeriod = steps.endTime / COUNT

    def torque(self) -> Any:
        self.turn()
        return -self.system.GetSensorStoredData(self.sensor)[:COUNT, 1]

    def turn(self) -> None:
        self.system.SolveDynamic(self.settings)


def medians(ways: dict[str, Callable[[], Any]], repeat: int) -> dict[str, tuple[float, float]]:
    """Wall and processor time (ms) of each, in turns."""
    spent: dict[str, list[tuple[float, float]]] = {name: [] for name in ways}
    for _ in range(repeat):
        for name, way in ways.items():
            wall, cpu = perf_counter(), process_time()
            way()
            spent[name].append(((perf_counter() - wall) * 1e3, (process_time() - cpu) * 1e3))
    return {name: (median(w for w, _ in x), median(c for _, c in x)) for name, x in spent.items()}


DESIGNS = 100
FREE = (
    *("links.crank.points.A", "links.rocker.points.B", "links.ground.points.C", "joints.C.axis"),
    *(f"links.{name}.mass" for name in MASS),
    *("links.crank.center", "links.rocker.center", "drives.O.speed"),
)
"""What varies from design to design: 22 numbers, most of the geometry among them."""


def kernel(m: Any, expected: Any, repeat: int) -> None:
    """The compiled analysis of many designs, one thread."""
    import dalembert as da

    k = da.compile(m, vary=FREE)
    off = np.max(np.abs(k().effort("O") - expected)) / np.max(np.abs(expected))
    part = np.random.default_rng(1).uniform(-0.05, 0.05, (DESIGNS, len(k.numbers)))
    r = k(k.nominal * (1 + part), threads=1)
    found = medians({"kernel": lambda: k(r.values, threads=1)}, repeat)["kernel"][0]
    size, redone = k.program(k.flat).size, r.redone
    print(
        f"kernel: torque differs by {off:.1e} of the largest; {size} operations a position, {redone} designs redone"
    )
    print(f"kernel, {DESIGNS} designs: {found / DESIGNS / COUNT * 1e6:.0f} ns a position")


def main() -> None:
    import dalembert as da

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=15)
    repeat = parser.parse_args().repeat
    m = da.mechanism(description(COUNT))
    r = da.dynamics(m)
    assert all(r.ok), r.problems()
    expected, turns = r.effort("O"), 2 * np.pi * np.arange(COUNT) / COUNT
    kernel(m, expected, repeat)
    ways: dict[str, Callable[[], Any]] = {"dalembert": lambda: da.dynamics(m)}
    for kind in (Pinocchio, Mujoco, Drake):
        try:
            tree = kind()
        except ImportError as error:
            print(f"{kind.__name__}: left out, {error}")
            continue
        off = np.max(np.abs(cycle(tree, turns) - expected)) / np.max(np.abs(expected))
        print(f"{kind.__name__}: torque differs by {off:.1e} of the largest")
        ways[kind.__name__] = lambda tree=tree: cycle(tree, turns)  # type: ignore[misc]
    try:
        steps = Exudyn(r)
    except ImportError as error:
        print(f"Exudyn: left out, {error}")
    else:
        off = np.max(np.abs(steps.torque() - expected)) / np.max(np.abs(expected))
        print(f"Exudyn: torque differs by {off:.1e} of the largest, by its steps")
        ways["Exudyn"] = steps.turn
    print(f"{'':12}{'wall ms':>10}{'CPU ms':>10}{'CPU us a position':>20}")
    for name, (wall, cpu) in medians(ways, repeat).items():
        print(f"{name:12}{wall:10.1f}{cpu:10.1f}{cpu / COUNT * 1e3:20.1f}")


if __name__ == "__main__":
    main()
