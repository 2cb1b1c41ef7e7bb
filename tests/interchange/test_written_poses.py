"""The tree of an MJCF file and its keyframe, moved as MuJoCo moves it: links are where they are and turn as they do."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import dalembert as da
from dalembert.arrays import Array
from dalembert.bundled import examples
from dalembert.interchange.file_formats import foreign_bytes
from dalembert.interchange.targets.target_variables import TargetFunction, TargetVariable
from dalembert.interchange.targets.unit_variables import UnitVariable, places
from tests.interchange.test_written_joints import PINS, Z, drives, joint, machine


def numbers(text: str | None) -> Array:
    return np.array([float(word) for word in (text or "").split()])


def placed(rotation: Array, at: Array) -> Array:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = rotation, at
    return out


def turned(q: Array) -> Array:
    """By a unit quaternion: v + 2 u x (w v + u x v)."""
    w, u = q[0] / np.linalg.norm(q), q[1:] / np.linalg.norm(q)
    return np.array([v + 2 * np.cross(u, w * v + np.cross(u, v)) for v in np.eye(3)]).T


def about(axis: Array, angle: float) -> Array:
    return turned(np.array([np.cos(angle / 2), *(np.sin(angle / 2) * axis / np.linalg.norm(axis))]))


class MovedTree:
    """The bodies of a file; joints take their numbers from the keyframe in their order."""

    def __init__(self, text: str) -> None:
        self.root = ElementTree.fromstring(text)
        key: Any = self.root.find("keyframe/key")
        self.qpos, self.qvel = numbers(key.get("qpos")), numbers(key.get("qvel"))

    def poses(self, later: float) -> dict[str, Array]:
        """World placement of each body, a time later at the keyframe's rates."""
        self.q = self.v = 0
        out: dict[str, Array] = {}
        for body in self.root.findall("worldbody/body"):
            self._body(body, np.eye(4), out, later)
        assert (self.q, self.v) == (len(self.qpos), len(self.qvel))
        return out

    def _body(self, body: Any, above: Array, out: dict[str, Array], later: float) -> None:
        pose = above @ placed(turned(numbers(body.get("quat"))), numbers(body.get("pos")))
        for part in body.findall("joint"):
            anchor = placed(np.eye(3), numbers(part.get("pos")))
            pose = pose @ anchor @ self._step(part, later) @ np.linalg.inv(anchor)
        out[body.get("name")] = pose
        for child in body.findall("body"):
            self._body(child, pose, out, later)

    def _step(self, part: Any, later: float) -> Array:
        if part.get("type") == "ball":
            q, w = self.qpos[self.q : self.q + 4], self.qvel[self.v : self.v + 3]
            self.q, self.v = self.q + 4, self.v + 3
            return placed(turned(q) @ about(w, float(np.linalg.norm(w)) * later), np.zeros(3))
        value, axis = self.qpos[self.q] + later * self.qvel[self.v], numbers(part.get("axis"))
        self.q, self.v = self.q + 1, self.v + 1
        if part.get("type") == "slide":
            return placed(np.eye(3), axis * value)
        return placed(about(axis, float(value)), np.zeros(3))


CROSS = drives("W", turn1="0.2 rad", turn2="0.5 rad")
for drive, rate in zip(CROSS.values(), ("3 rad/s", "-7 rad/s"), strict=True):
    drive["speed"] = rate
SLID: dict[str, Any] = {
    "slide": {"joint": "W", "freedom": "slide", "position": 0.3, "speed": "2 m/s"},
    "turn": {"joint": "W", "freedom": "turn", "position": "0.7 rad", "speed": "-5 rad/s"},
}
TILTED = {"i": {"x": [3, 0, 4], "z": [-4, 0, 3]}, "j": {"x": [0, 1, 0], "z": [0, 0, 1]}}


def ball_in_axes() -> da.Mechanism:
    """The spatial four-bar at 40 deg, its first ball in other axes on both links."""
    tree: Any = da.load(examples()["rssr"]).to_tree()
    tree["joints"]["A"]["axes"] = {"i": {"x": [0, 1, 0], "z": Z}, "j": {"x": Z, "z": [1, 0, 0]}}
    tree["drives"]["O"]["position"] = "40 deg"
    return da.mechanism(tree)


def away(kind: str, *links: str, moved: Any, **keys: Any) -> da.Mechanism:
    """A joint away from the origins of its links."""
    m: Any = machine({"W": joint(kind, *links, **keys)}, moved).to_tree()
    m["links"]["a"]["points"]["O"] = [0.1, -0.2, 0.3]
    m["links"]["ground"]["points"]["O"] = [1, 2, 3]
    return da.mechanism(m)


MOVED = {
    "universal": lambda: away("universal", "ground", "a", moved=CROSS, axes=PINS),
    "universal from its far side": lambda: away("universal", "a", "ground", moved=CROSS, axes=PINS),
    "cylindrical": lambda: away("cylindrical", "ground", "a", moved=SLID, axes=TILTED),
    "cylindrical from its far side": lambda: away("cylindrical", "a", "ground", moved=SLID, axes=TILTED),
    "screw from its far side": lambda: away(
        "screw", "a", "ground", moved={"turn": SLID["turn"]}, axes=TILTED, lead=0.02
    ),
    "ball in axes of its own": ball_in_axes,
    "hinges": lambda: da.load(examples()["four_bar"]),
}


@pytest.mark.parametrize("name", MOVED)
def test_a_tree_of_mujoco_is_where_the_mechanism_is(name: str) -> None:
    """Also its speeds and angular velocities, by differences of the keyframe moved on by its rates."""
    m = MOVED[name]()
    tree = MovedTree(foreign_bytes(m, "x.xml")[0].decode())
    r = da.kinematics(m if m.space == "space" else da.lifted(m))
    step = 1e-6
    now, before, after = (tree.poses(t) for t in (0.0, -step, step))
    assert set(now) == set(r.links)
    for link, pose in now.items():
        assert pose[:3, :3] == pytest.approx(r.rotation(link)[0], abs=1e-12)
        assert pose[:3, 3] == pytest.approx(r.position(link)[0], abs=1e-12)
        rate = (after[link] - before[link]) / (2 * step)
        spin = rate[:3, :3] @ pose[:3, :3].T
        assert rate[:3, 3] == pytest.approx(r.velocity(link)[0], abs=1e-7)
        assert [spin[2, 1], spin[0, 2], spin[1, 0]] == pytest.approx(r.speed(link)[0], abs=1e-6)


def test_a_unit_finds_its_numbers_and_channels_in_the_order_of_the_function() -> None:
    """An input with a place below 0 is a number too, at -1 - place. References count the unit's variables."""

    def variable(name: str, place: int) -> TargetVariable:
        return TargetVariable(name, "length", 0.0, place)

    inputs = (variable("d", 2), variable("b", -1), variable("e", 0), variable("c", -4))
    parameters = (variable("f", 2), variable("a", 1))
    f = TargetFunction("", inputs, parameters, ())
    unit = [UnitVariable(v, "input") for v in (*parameters, *inputs)]
    assert places(f, unit) == ((4, 2, 1, 6), (5, 3))
