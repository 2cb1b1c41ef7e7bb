"""Forces of three mechanisms against MuJoCo, from the MJCF files that dalembert writes; numbers of one run compared.

Method. Each mechanism is written as ``dalembert convert`` does (the four-bar and the engine lifted into space), loaded
by MuJoCo, and put at every position: qpos of the tree from dalembert's poses (the equalities must then be closed), qvel
and qacc from MuJoCo's own Jacobians of the loops and their rates (mj_jac, mj_jacDot) with the drive's speed and
acceleration.
Then, in three ways:

- tree: ``mj_inverse`` with the equalities off gives the generalised forces of the tree, to which the loads are added
  (``mj_applyFT``); loop forces and the driving torque are the solution of ``S e + J^T f = tau``. This is exact.
- forward: dalembert's torque is applied, and ``mj_forward`` computes accelerations and the loops' forces from its soft
  constraints (impedance 0.9999, as the file has it). Its loop forces are as good as that.
- mj_inverse on the closed model finds loop forces from the error of the acceleration, which a right motion does not
  have: its torque is not the driving torque, and is printed to show that.

    python benchmarks/cross_check.py [--markdown]
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da
from dalembert.interchange.file_formats import foreign_bytes
from dalembert.interchange.joint_chains import cuttable_tree
from dalembert.interchange.link_graph import drawn_graph
from dalembert.interchange.robots.mjcf_writer import branch_values

EXAMPLES = Path(__file__).parents[1] / "examples"
NAMES = ("four_bar", "engine", "rssr")


@dataclass
class Differences:
    """Largest differences over the positions, each over the largest value of its kind."""

    closed: float = 0.0
    """Distance of the loops' sites, metres."""
    motion: float = 0.0
    """Residual of the loops' second rates with the tree's accelerations."""
    torque: float = 0.0
    force: float = 0.0
    soft_force: float = 0.0
    soft_motion: float = 0.0
    closed_torque: float = 0.0
    """Torque of mj_inverse on the closed model against the driving torque."""
    positions: int = 0
    scales: dict[str, float] = field(default_factory=dict)


class ClosedModel:
    """A mechanism's MJCF file in MuJoCo, its sites of closed loops, and the rows of its drive."""

    def __init__(self, m: da.Mechanism) -> None:
        import mujoco

        self.mj = mujoco
        self.mechanism = m if m.space == "space" else da.lifted(m)
        content, self.lost = foreign_bytes(m, "model.xml")
        self.text = content.decode()
        self.model = mujoco.MjModel.from_xml_string(self.text)
        self.data = mujoco.MjData(self.model)
        equal = range(self.model.neq)
        self.pairs = [(self.model.eq_obj1id[k], self.model.eq_obj2id[k]) for k in equal]
        self.names = [self.model.equality(k).name for k in equal]
        self.drive = int(self.model.jnt_dofadr[self.model.actuator_trnid[0, 0]])
        self.tree = cuttable_tree(drawn_graph(da.kinematics(self.mechanism, positions=1), 0))

    def put(self, result: da.Result, k: int) -> None:
        """The pose of a position of index k."""
        graph = drawn_graph(result, k)
        waiting, numbers = [j for j in reversed(self.tree.branches) if j.links[0] == "ground"], []
        while waiting:
            joint = waiting.pop()
            numbers += branch_values(graph, joint, joint.name in self.tree.turned)[0]
            waiting += [j for j in reversed(self.tree.branches) if j.links[0] == joint.links[1]]
        self.data.qpos[:] = numbers
        self.data.qvel[:] = 0
        self.mj.mj_fwdPosition(self.model, self.data)

    def loops(self) -> tuple[Any, Any]:
        """Gaps (3 L,) between the sites of the loops, and their Jacobian (3 L, nv)."""
        gaps, rows = [], []
        for a, b in self.pairs:
            jacobians = np.zeros((2, 3, self.model.nv))
            for jacobian, site in zip(jacobians, (a, b), strict=True):
                self.mj.mj_jacSite(self.model, self.data, jacobian, None, site)
            gaps.append(self.data.site_xpos[a] - self.data.site_xpos[b])
            rows.append(jacobians[0] - jacobians[1])
        return np.concatenate(gaps), np.concatenate(rows)

    def loop_rates(self) -> Any:
        """Rates of that Jacobian, (3 L, nv)."""
        self.mj.mj_fwdVelocity(self.model, self.data)
        rows = []
        for pair in self.pairs:
            rates = np.zeros((2, 3, self.model.nv))
            for rate, site in zip(rates, pair, strict=True):
                at, link = self.data.site_xpos[site], self.model.site_bodyid[site]
                self.mj.mj_jacDot(self.model, self.data, rate, None, at, link)
            rows.append(rates[0] - rates[1])
        return np.concatenate(rows)

    def spin_rows(self, result: da.Result, k: int) -> tuple[Any, Any, Any]:
        """A link between two balls has no spin about their line: its row, rate of change, and right-hand side.

        The spin is idle: it is set to dalembert's, about the axis between the link's balls.
        """
        rows, speeds, rates = [], [], []
        balls = [name for name, joint in self.mechanism.joints.items() if joint.ball]
        for link in result.links:
            own = [name for name in balls if link in self.mechanism.joints[name].links]
            if len(own) != 2:
                continue
            ends = []
            for name in own:
                joint = self.mechanism.joints[name]
                ends.append(self.mechanism.joint_points(name)[joint.links.index(link)])
            line = result.rotation(link)[k] @ (np.array(ends[1]) - np.array(ends[0]))
            line /= np.linalg.norm(line)
            spin, jacobian, change = (
                result.speed(link)[k],
                np.zeros((3, self.model.nv)),
                np.zeros((3, self.model.nv)),
            )
            number = self.model.body(link).id
            self.mj.mj_jacBody(self.model, self.data, None, jacobian, number)
            self.mj.mj_jacDot(self.model, self.data, None, change, self.data.xpos[number], number)
            rows.append(line @ jacobian)
            speeds.append(line @ spin)
            rates.append(line @ (result.acceleration(link)[k] - change @ self.data.qvel))
        return np.array(rows).reshape(-1, self.model.nv), speeds, rates

    def rates(self, result: da.Result, k: int) -> float:
        """Puts qvel and qacc from the loops' Jacobians; returns the residual of the second rates."""
        speed, acceleration = (
            float(of(result.drives[0])[k]) for of in (result.drive_speed, result.drive_acceleration)
        )
        driven = np.zeros((1, self.model.nv))
        driven[0, self.drive] = 1
        _, rows = self.loops()
        spin, speeds, _ = self.spin_rows(result, k)
        known = np.concatenate([np.zeros(len(rows)), [speed], speeds])
        self.data.qvel[:] = np.linalg.lstsq(np.concatenate([rows, driven, spin]), known, rcond=None)[0]
        change = self.loop_rates() @ self.data.qvel
        spin, _, rates = self.spin_rows(result, k)
        matrix, right = np.concatenate([rows, driven, spin]), np.concatenate([-change, [acceleration], rates])
        self.data.qacc[:] = np.linalg.lstsq(matrix, right, rcond=None)[0]
        size = max(1.0, float(np.abs(right).max()))
        return float(np.abs(matrix @ self.data.qacc - right).max()) / size

    def loads(self, result: da.Result, k: int) -> Any:
        """Generalised forces of the mechanism's loads."""
        out = np.zeros(self.model.nv)
        for link in result.links:
            for action in da.forces_on(result, link)["applied"]:
                if action.of not in self.mechanism.loads:
                    continue
                force, couple, at = (np.array(x[k], float) for x in (action.force, action.couple, action.at))
                number = self.model.body(link).id
                self.mj.mj_applyFT(self.model, self.data, force, couple, at, number, out)
        return out


def compared(m: da.Mechanism, positions: int | None = None) -> Differences:
    """Largest differences of a mechanism's motion, torque and loop forces against MuJoCo."""
    closed = ClosedModel(m)
    mj, model, data = closed.mj, closed.model, closed.data
    result = da.dynamics(closed.mechanism, positions)
    drive = result.drives[0]
    out = Differences(positions=len(result.status))
    torque = result.effort(drive)
    joints = [name.split(".")[0] for name in closed.names]
    forces = np.array([_on_first(closed, result, name) for name in joints])  # (loop, position, 3)
    out.scales = {"torque": float(np.abs(torque).max()), "force": float(np.abs(forces).max())}
    for k in range(out.positions):
        closed.put(result, k)
        gaps, rows = closed.loops()
        out.closed = max(out.closed, float(np.abs(gaps).max()))
        out.motion = max(out.motion, closed.rates(result, k))
        motion = data.qacc.copy()
        applied = closed.loads(result, k)
        model.opt.disableflags |= int(mj.mjtDisableBit.mjDSBL_EQUALITY)
        mj.mj_inverse(model, data)
        tau = data.qfrc_inverse - applied
        unit = np.eye(model.nv)[:, [closed.drive]]
        answer = np.linalg.lstsq(np.concatenate([unit, rows.T], axis=1), tau, rcond=None)[0]
        model.opt.disableflags &= ~int(mj.mjtDisableBit.mjDSBL_EQUALITY)
        out.torque = max(out.torque, abs(answer[0] - torque[k]) / out.scales["torque"])
        out.force = max(out.force, _off(answer[1:].reshape(-1, 3), forces[:, k], out.scales["force"]))
        mj.mj_inverse(model, data)
        wrong = data.qfrc_inverse[closed.drive] - applied[closed.drive]
        out.closed_torque = max(out.closed_torque, abs(wrong - torque[k]) / out.scales["torque"])
        data.qfrc_applied[:] = applied
        data.qfrc_applied[closed.drive] += torque[k]
        mj.mj_forward(model, data)
        size = max(1.0, float(np.abs(motion).max()))
        out.soft_motion = max(out.soft_motion, float(np.abs(data.qacc - motion).max()) / size)
        soft = data.efc_force[: 3 * len(closed.pairs)].reshape(-1, 3)
        out.soft_force = max(out.soft_force, _off(soft, forces[:, k], out.scales["force"]))
        data.qfrc_applied[:] = 0
    return out


def _on_first(closed: ClosedModel, result: da.Result, joint: str) -> Any:
    """Force (position, 3) of a loop's joint on its first link; 0 where a component across the plane is not unique."""
    i = closed.mechanism.joints[joint].links[0]
    return np.nan_to_num(result.reaction(joint, on=i))


def _off(theirs: Any, ours: Any, size: float) -> float:
    return float(np.abs(theirs - ours).max()) / size


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--markdown", action="store_true", help="as a table of Markdown")
    arguments = parser.parse_args()
    head = ["mechanism", "positions", "loop closed, m", "torque", "loop force", "mj_forward: loop force"]
    head += ["mj_forward: acceleration", "mj_inverse, loop closed: torque"]
    rows = [head]
    for name in NAMES:
        d = compared(da.load(EXAMPLES / f"{name}.yaml"), 72 if name == "engine" else 36)
        numbers = [d.closed, d.torque, d.force, d.soft_force, d.soft_motion, d.closed_torque]
        rows.append([name, str(d.positions), *(f"{x:.1e}" for x in numbers)])
    if arguments.markdown:
        rows.insert(1, ["---"] * len(head))
        print("\n".join("| " + " | ".join(row) + " |" for row in rows))
        return
    widths = [max(len(row[k]) for row in rows) for k in range(len(head))]
    for row in rows:
        print("  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)))


if __name__ == "__main__":
    main()
