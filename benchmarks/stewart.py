"""A Stewart platform over 1,000 poses: all six leg forces by a dalembert kernel and by multibody programs, one thread.

Method. Six legs of two links (universal joint, driven slide, ball) carry a platform: 13 moving links, 18 joints. It
moves along a closed path; the legs' lengths, rates and second rates are those of that path. dalembert's kernel
(``da.compile``) is given the lengths, closes the loops itself and returns the six forces; its time is that of the
call, compiled before. Pinocchio and MuJoCo compute trees: their users open the six balls, close them by Newton's
method with the programs' Jacobians from the pose before, and find the forces from the programs' inverse dynamics and
the Jacobian of the cuts. Each is timed twice: so, and with all poses known beforehand, as a user has them who moves
the platform rather than the legs. Their forces are compared with ours first. Medians over the repeats, in turns;
those not installed are named.

    python benchmarks/stewart.py [--repeat 7]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from collections.abc import Callable  # noqa: E402
from statistics import median  # noqa: E402
from time import perf_counter  # noqa: E402
from typing import Any  # noqa: E402

import numpy as np  # noqa: E402

COUNT, LEGS, GRAVITY = 1000, range(6), np.array([0.0, 0.0, -9.80665])
FEET = [np.array([np.cos(a), np.sin(a), 0.0]) for a in np.radians([-10, 10, 110, 130, 230, 250])]
CORNERS = [np.array([np.cos(a), np.sin(a), 0.0]) / 2 for a in np.radians([-50, 50, 70, 170, 190, 290])]
MASS = {"platform": 20.0, "lower": 2.0, "upper": 1.0}
INERTIA = {"platform": np.array([1.0, 1.0, 1.8]), "lower": np.full(3, 0.02), "upper": np.full(3, 0.01)}
MIDDLE = 0.3
"""Distance of the mass centres of a leg's two links from its ends."""


def path(t: Any) -> Any:
    """Lengths (..., 6) of the legs at a time."""
    t = np.asarray(t)[..., None]
    place = np.concatenate([0.1 * np.sin(t), 0.08 * np.cos(2 * t), 1 + 0.1 * np.sin(t + 0.3)], axis=-1)
    turn = np.concatenate([0.15 * np.sin(t), 0.2 * np.sin(t + 1), 0.1 * np.sin(2 * t)], axis=-1)
    corner = np.stack([np.array(CORNERS) @ _rotation(w).T for w in turn.reshape(-1, 3)])
    corner = corner.reshape(*turn.shape[:-1], 6, 3)
    return np.linalg.norm(place[..., None, :] + corner - np.array(FEET), axis=-1)


def _rotation(w: Any) -> Any:
    """A rotation by its vector (Rodrigues)."""
    size = np.linalg.norm(w) + 1e-300
    k = np.cross(np.eye(3), w / size)
    return np.eye(3) - np.sin(size) * k + (1 - np.cos(size)) * k @ k


TIMES, STEP = np.linspace(0, 2 * np.pi, COUNT, endpoint=False), 1e-3
LENGTH = path(TIMES)
RATE = (path(TIMES + STEP) - path(TIMES - STEP)) / (2 * STEP)
SECOND = (path(TIMES + STEP) - 2 * LENGTH + path(TIMES - STEP)) / STEP**2


class Drawn:
    """As drawn: the platform level, a metre up; each leg's axis and the two pins of its universal joint."""

    def __init__(self) -> None:
        self.centre = np.array([0.0, 0.0, 1.0])
        self.corner = [self.centre + p for p in CORNERS]
        self.length = np.array([np.linalg.norm(p - b) for p, b in zip(self.corner, FEET, strict=True)])
        self.axis = [(p - b) / size for p, b, size in zip(self.corner, FEET, self.length, strict=True)]
        self.first = [np.cross(d, [0, 0, 1]) / np.linalg.norm(np.cross(d, [0, 0, 1])) for d in self.axis]
        self.second = [np.cross(d, u) for d, u in zip(self.axis, self.first, strict=True)]


DRAWN = Drawn()


def description() -> dict[str, Any]:
    """As drawn: all links' axes in ground's."""

    def link(kind: str, center: Any, points: Any) -> dict[str, Any]:
        made = {"mass": MASS[kind], "center": center.tolist(), "inertia": INERTIA[kind].tolist()}
        return made | {"points": {name: p.tolist() for name, p in points.items()}}

    d = DRAWN
    feet = {f"B{k}": FEET[k] for k in LEGS}
    links = {"ground": {"points": {name: b.tolist() for name, b in feet.items()}}}
    links["platform"] = link("platform", d.centre, {f"P{k}": d.corner[k] for k in LEGS})
    joints: dict[str, Any] = {}
    drives = {}
    for k in LEGS:
        foot, top, e = FEET[k], d.corner[k], d.axis[k]
        links[f"lower{k}"] = link("lower", foot + MIDDLE * e, {f"B{k}": foot})
        links[f"upper{k}"] = link("upper", top - MIDDLE * e, {f"P{k}": top})
        pins = {"i": {"z": d.first[k].tolist()}, "j": {"z": d.second[k].tolist()}}
        joints[f"U{k}"] = {"type": "universal", "links": ["ground", f"lower{k}"], "at": f"B{k}", "axes": pins}
        slide = {"type": "prismatic", "links": [f"lower{k}", f"upper{k}"], "axis": e.tolist()}
        joints[f"leg{k}"] = slide | {"at": [f"B{k}", f"P{k}"]}
        joints[f"P{k}"] = {"type": "spherical", "links": [f"upper{k}", "platform"]}
        given = (LENGTH[:, k], RATE[:, k], SECOND[:, k])
        names = ("position", "speed", "acceleration")
        drives[f"leg{k}"] = {name: tuple(a.tolist()) for name, a in zip(names, given, strict=True)}
    return {"space": "space", "gravity": GRAVITY.tolist(), "links": links, "joints": joints, "drives": drives}


class Tree:
    """A program's open tree of 24 speeds, the platform's balls open; ``slides``: places of the legs' speeds."""

    slides: list[int]

    def home(self) -> None:
        """Stand as drawn."""
        raise NotImplementedError

    def put(self, lengths: Any) -> None:
        """Slide the legs to lengths, the rest as it is."""
        raise NotImplementedError

    def stand(self) -> Any:
        """The coordinates as they are, to be given back to ``stand_at``."""
        raise NotImplementedError

    def stand_at(self, q: Any) -> None:
        """Take coordinates."""
        raise NotImplementedError

    def gap(self) -> tuple[Any, Any]:
        """Ends of the legs less corners of the platform (18,), and its Jacobian (18, 24)."""
        raise NotImplementedError

    def add(self, dq: Any) -> None:
        """Move by small displacements (24,)."""
        raise NotImplementedError

    def drift(self, v: Any) -> Any:
        """Second rate of the gap (18,) at speeds v and no accelerations."""
        raise NotImplementedError

    def inverse(self, v: Any, a: Any) -> Any:
        """Generalised forces (24,) of a motion."""
        raise NotImplementedError


def close(tree: Tree, lengths: Any, free: list[int]) -> None:
    """Newton's method from the pose before."""
    tree.put(lengths)
    for _ in range(20):
        gap, j = tree.gap()
        dq = np.zeros(24)
        dq[free] = np.linalg.solve(j[:, free], -gap)
        tree.add(dq)
        if abs(dq).max() < 1e-9:
            return


def cycle(tree: Tree, known: list[Any] | None = None) -> tuple[Any, list[Any]]:
    """Forces of the legs (1000, 6) as a user of such a program would find them, and the poses met."""
    free, out, poses = [k for k in range(24) if k not in tree.slides], np.empty((COUNT, 6)), []
    tree.home()
    for n in range(COUNT):
        if known is None:
            close(tree, LENGTH[n], free)
            poses.append(tree.stand())
        else:
            tree.stand_at(known[n])
        _, j = tree.gap()
        v, a = np.zeros(24), np.zeros(24)
        v[tree.slides], a[tree.slides] = RATE[n], SECOND[n]
        inverse = np.linalg.inv(j[:, free])
        v[free] = -inverse @ (j[:, tree.slides] @ RATE[n])
        a[free] = -inverse @ (j[:, tree.slides] @ SECOND[n] + tree.drift(v))
        force = tree.inverse(v, a)
        out[n] = force[tree.slides] - j[:, tree.slides].T @ (inverse.T @ force[free])
    return out, poses


class Pinocchio(Tree):
    def __init__(self) -> None:
        import pinocchio as pin

        self.pin, model, d = pin, pin.Model(), DRAWN
        model.gravity.linear = GRAVITY
        turn, slide = pin.JointModelRevoluteUnaligned, pin.JointModelPrismaticUnaligned
        still, self.ends, tops, slides = pin.SE3.Identity(), [], [], []

        def body(joint: int, kind: str, center: Any) -> None:
            model.appendBodyToJoint(joint, pin.Inertia(MASS[kind], center, np.diag(INERTIA[kind])), still)

        for k in LEGS:
            first = model.addJoint(0, turn(d.first[k]), pin.SE3(np.eye(3), FEET[k]), f"u{k}")
            lower = model.addJoint(first, turn(d.second[k]), still, f"v{k}")
            at = pin.SE3(np.eye(3), d.corner[k] - FEET[k])
            upper = model.addJoint(lower, slide(d.axis[k]), at, f"leg{k}")
            body(lower, "lower", MIDDLE * d.axis[k])
            body(upper, "upper", -MIDDLE * d.axis[k])
            tops.append(upper)
            slides.append(upper)
        platform = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3(np.eye(3), d.centre), "platform")
        body(platform, "platform", np.zeros(3))
        for k in LEGS:
            for joint, arm in ((tops[k], np.zeros(3)), (platform, CORNERS[k])):
                frame = pin.Frame(f"{joint} {k}", joint, pin.SE3(np.eye(3), arm), pin.FrameType.OP_FRAME)
                self.ends.append(model.addFrame(frame))
        self.model, self.data = model, model.createData()
        self.places = [model.joints[j].idx_q for j in slides]
        self.slides = [model.joints[j].idx_v for j in slides]

    def home(self) -> None:
        self.q = self.pin.neutral(self.model)

    def put(self, lengths: Any) -> None:
        self.q[self.places] = lengths - DRAWN.length

    def stand(self) -> Any:
        return self.q.copy()

    def stand_at(self, q: Any) -> None:
        self.q = q

    def gap(self) -> tuple[Any, Any]:
        pin, axes = self.pin, self.pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pin.computeJointJacobians(self.model, self.data, self.q)
        pin.updateFramePlacements(self.model, self.data)
        j = [pin.getFrameJacobian(self.model, self.data, end, axes)[:3] for end in self.ends]
        p = [self.data.oMf[end].translation for end in self.ends]
        gap = np.concatenate([a - b for a, b in zip(p[::2], p[1::2], strict=True)])
        return gap, np.concatenate([a - b for a, b in zip(j[::2], j[1::2], strict=True)])

    def add(self, dq: Any) -> None:
        self.q = self.pin.integrate(self.model, self.q, dq)

    def drift(self, v: Any) -> Any:
        pin, axes = self.pin, self.pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pin.forwardKinematics(self.model, self.data, self.q, v, np.zeros(24))
        a = [pin.getFrameClassicalAcceleration(self.model, self.data, end, axes).linear for end in self.ends]
        return np.concatenate([x - y for x, y in zip(a[::2], a[1::2], strict=True)])

    def inverse(self, v: Any, a: Any) -> Any:
        return self.pin.rnea(self.model, self.data, self.q, v, a).copy()


def _text(values: Any) -> str:
    return " ".join(f"{x:.17g}" for x in values)


class Mujoco(Tree):
    def __init__(self) -> None:
        import mujoco

        d, legs = DRAWN, ""

        def mass(kind: str, center: Any) -> str:
            tensor = _text(INERTIA[kind])
            return f'<inertial pos="{_text(center)}" mass="{MASS[kind]}" diaginertia="{tensor}"/>'

        for k in LEGS:
            pins = "".join(f'<joint type="hinge" axis="{_text(u[k])}"/>' for u in (d.first, d.second))
            upper = f'{mass("upper", -MIDDLE * d.axis[k])}<site name="top{k}"/>'
            slide = f'<joint name="leg{k}" type="slide" axis="{_text(d.axis[k])}"/>'
            inner = f'<body name="upper{k}" pos="{_text(d.corner[k] - FEET[k])}">{slide}{upper}</body>'
            legs += f'<body pos="{_text(FEET[k])}">{mass("lower", MIDDLE * d.axis[k])}{pins}{inner}</body>'
        corners = "".join(f'<site name="corner{k}" pos="{_text(CORNERS[k])}"/>' for k in LEGS)
        top = f"<freejoint/>{mass('platform', np.zeros(3))}{corners}"
        platform = f'<body name="platform" pos="{_text(d.centre)}">{top}</body>'
        option = f'<option gravity="{_text(GRAVITY)}"/><compiler boundmass="0"/>'
        self.mj = mujoco
        self.model = mujoco.MjModel.from_xml_string(
            f"<mujoco>{option}<worldbody>{legs}{platform}</worldbody></mujoco>"
        )
        self.data = mujoco.MjData(self.model)
        self.slides = [int(self.model.joint(f"leg{k}").dofadr[0]) for k in LEGS]
        self.places = [int(self.model.joint(f"leg{k}").qposadr[0]) for k in LEGS]
        self.sites = [(self.model.site(f"top{k}").id, self.model.site(f"corner{k}").id) for k in LEGS]
        self.bodies = [(self.model.body(f"upper{k}").id, self.model.body("platform").id) for k in LEGS]
        self.jac = np.zeros((2, 6, 3, 24))

    def home(self) -> None:
        self.mj.mj_resetData(self.model, self.data)

    def put(self, lengths: Any) -> None:
        self.data.qpos[self.places] = lengths - DRAWN.length

    def stand(self) -> Any:
        return self.data.qpos.copy()

    def stand_at(self, q: Any) -> None:
        self.data.qpos[:] = q

    def gap(self) -> tuple[Any, Any]:
        self.mj.mj_kinematics(self.model, self.data)
        self.mj.mj_comPos(self.model, self.data)
        for k, pair in enumerate(self.sites):
            for side, site in enumerate(pair):
                self.mj.mj_jacSite(self.model, self.data, self.jac[side, k], None, site)
        gap = [self.data.site_xpos[a] - self.data.site_xpos[b] for a, b in self.sites]
        return np.concatenate(gap), (self.jac[0] - self.jac[1]).reshape(18, 24)

    def add(self, dq: Any) -> None:
        self.mj.mj_integratePos(self.model, self.data.qpos, dq, 1.0)

    def drift(self, v: Any) -> Any:
        self.data.qvel[:] = v
        self.mj.mj_fwdPosition(self.model, self.data)
        self.mj.mj_fwdVelocity(self.model, self.data)
        for k, (pair, links) in enumerate(zip(self.sites, self.bodies, strict=True)):
            for side, (site, link) in enumerate(zip(pair, links, strict=True)):
                at = self.data.site_xpos[site]
                self.mj.mj_jacDot(self.model, self.data, self.jac[side, k], None, at, link)
        return (self.jac[0] - self.jac[1]).reshape(18, 24) @ v

    def inverse(self, v: Any, a: Any) -> Any:
        self.data.qacc[:] = a
        self.mj.mj_inverse(self.model, self.data)
        return self.data.qfrc_inverse.copy()


def rivals(expected: Any) -> dict[str, Callable[[], Any]]:
    """What is timed of the programs that are installed; their forces are compared with ours."""
    out: dict[str, Callable[[], Any]] = {}
    for name, make in (("pinocchio", Pinocchio), ("mujoco", Mujoco)):
        try:
            tree: Tree = make()
        except ImportError:
            print(f"{name} is not installed")
            continue
        forces, poses = cycle(tree)
        off = abs(forces - expected).max() / abs(expected).max()
        print(f"{name}: forces differ by {off:.1e} of the largest")
        assert off < 1e-6, name
        out[f"{name}, loops closed by Newton"] = lambda tree=tree: cycle(tree)
        out[f"{name}, poses known"] = lambda tree=tree, poses=poses: cycle(tree, poses)
    return out


def main(repeat: int) -> None:
    import dalembert as da

    m = da.mechanism(description())
    start = perf_counter()
    kernel = da.compile(m, outputs=[f"effort.leg{k}" for k in LEGS])
    answer = kernel([kernel.nominal], threads=1)
    print(
        f"dalembert: compiled in {perf_counter() - start:.1f} s, statuses {set(answer.status.ravel().tolist())}"
    )
    expected = np.stack([answer.effort(f"leg{k}")[0] for k in LEGS], axis=-1)
    runs = {"dalembert, loops closed too": lambda: kernel([kernel.nominal], threads=1)} | rivals(expected)
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(repeat):
        for name, run in runs.items():
            start = perf_counter()
            run()
            times[name].append(perf_counter() - start)
    ours = median(next(iter(times.values())))
    print(f"\n{'':34s}{'us a pose':>12s}{'ratio':>9s}")
    for name, found in times.items():
        print(f"{name:34s}{median(found) / COUNT * 1e6:12.2f}{median(found) / ours:9.0f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--repeat", type=int, default=7)
    main(parser.parse_args().repeat)
