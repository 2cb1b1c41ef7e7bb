"""GLB files, read as the standard says: chunks, accessors, poses; and by another program's reader."""

from __future__ import annotations

import json
import struct
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.algebra import space
from dalembert.bundled import examples
from dalembert.views.space.link_solids import pose
from dalembert.views.space.triangles import mesh
from dalembert.views.symbols.pair_symbols import SYMBOLS, symbol
from tests.methods.space_machines import MACHINES, solved

PLANE = ["four_bar", "engine", "quick_return", "gear_train", "truss"]
NAMES = [*MACHINES, *PLANE]
each = pytest.mark.parametrize("name", NAMES)
SIZES = {5126: 4, 5123: 2, 5125: 4}
COUNTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


def result(name: str) -> Any:
    if name in MACHINES:
        return solved(name)
    m = da.load(examples()[name])
    return da.solve(m, positions=36 if m.drives else None)


class File:
    """A .glb file taken apart."""

    def __init__(self, content: bytes) -> None:
        magic, version, length = struct.unpack_from("<4sII", content)
        assert (magic, version, length) == (b"glTF", 2, len(content))
        size, kind = struct.unpack_from("<I4s", content, 12)
        assert kind == b"JSON"
        assert size % 4 == 0
        self.tree = json.loads(content[20 : 20 + size])
        binary, kind = struct.unpack_from("<I4s", content, 20 + size)
        assert kind == b"BIN\0"
        assert 28 + size + binary == len(content)
        self.numbers = content[28 + size :]
        assert self.tree["buffers"] == [{"byteLength": binary}]

    def values(self, n: int) -> Any:
        a = self.tree["accessors"][n]
        view = self.tree["bufferViews"][a["bufferView"]]
        width = COUNTS[a["type"]]
        assert view["byteOffset"] % 4 == 0
        assert view["byteLength"] == a["count"] * width * SIZES[a["componentType"]]
        assert view["byteOffset"] + view["byteLength"] <= len(self.numbers)
        dtype = {5126: "<f4", 5123: "<u2", 5125: "<u4"}[a["componentType"]]
        found = np.frombuffer(self.numbers, dtype, a["count"] * width, view["byteOffset"]).reshape(-1, width)
        if "min" in a:
            assert found.min(axis=0) == pytest.approx(a["min"], rel=1e-6)
            assert found.max(axis=0) == pytest.approx(a["max"], rel=1e-6)
        return found

    def channel(self, node: str, path: str) -> tuple[Any, Any]:
        """Times and values of a node's motion."""
        motion = self.tree["animations"][0]
        names = [n["name"] for n in self.tree["nodes"]]
        target = {"node": names.index(node), "path": path}
        sampler = motion["samplers"][next(c["sampler"] for c in motion["channels"] if c["target"] == target)]
        return self.values(sampler["input"])[:, 0], self.values(sampler["output"])


@each
def test_the_file_is_as_the_standard_says(name: str) -> None:
    r = result(name)
    file = File(da.draw.solid_model(r).to_glb())
    tree = file.tree
    assert [n["name"] for n in tree["nodes"][:-1]] == ["ground", *r.links]
    assert tree["nodes"][-1]["children"] == list(range(len(r.links) + 1))
    for part in tree["meshes"]:
        for primitive in part["primitives"]:
            points = file.values(primitive["attributes"]["POSITION"])
            normals = file.values(primitive["attributes"]["NORMAL"])
            triangles = file.values(primitive["indices"])[:, 0].reshape(-1, 3)
            assert len(points) == len(normals)
            assert triangles.max() < len(points)
            assert np.linalg.norm(normals, axis=1) == pytest.approx(np.ones(len(normals)), abs=1e-5)
            assert 0 <= primitive["material"] < len(tree["materials"])
    used = {a["bufferView"] for a in tree["accessors"]}
    assert used == set(range(len(tree["bufferViews"])))


@each
def test_links_move_as_computed(name: str) -> None:
    r = result(name)
    file = File(da.draw.solid_model(r).to_glb())
    if "animations" not in file.tree:
        assert not r.drives
        return
    for link in r.links:
        t, at = file.channel(link, "translation")
        clock, q = file.channel(link, "rotation")
        assert (np.diff(t) > 0).all()
        assert t[0] == 0.0
        assert clock == pytest.approx(t)
        assert np.linalg.norm(q, axis=1) == pytest.approx(np.ones(len(q)), abs=1e-6)
        assert (np.sum(q[1:] * q[:-1], axis=1) > 0).all()
        for k in range(len(r.status)):
            turn, origin = pose(r, link, k)
            w, axis = 2 * np.arctan2(np.linalg.norm(q[k, :3]), q[k, 3]), q[k, :3]
            found = space.exp(axis / max(float(np.linalg.norm(axis)), 1e-30) * w)
            assert found == pytest.approx(turn.ravel(), abs=1e-6)
            assert at[k] == pytest.approx(origin, abs=1e-6)


def test_the_clock_is_that_of_the_drive() -> None:
    """A turn at 10 rad/s takes 2 pi / 10 s, and comes round to its start."""
    file = File(da.draw.solid_model(solved("rssr")).to_glb())
    t, at = file.channel("crank", "translation")
    assert t[-1] == pytest.approx(2 * np.pi / 10, rel=1e-6)
    assert at[-1] == pytest.approx(at[0])


def test_without_speeds_thirty_positions_a_second() -> None:
    r = da.kinematics(da.load(examples()["scissor_lift"]), positions=31)
    assert not r.drive_speed(r.drives[0]).any()
    t, _ = File(da.draw.solid_model(r).to_glb()).channel(r.links[0], "translation")
    assert t == pytest.approx(np.arange(31) / 30, abs=1e-6)


@each
def test_another_reader_agrees(name: str) -> None:
    """trimesh finds every link where it is at the first position."""
    trimesh = pytest.importorskip("trimesh")
    r = result(name)
    scene = trimesh.load(BytesIO(da.draw.solid_model(r).to_glb()), file_type="glb")
    upright = np.eye(4)
    if r.mechanism.dimension == 3:
        upright[:3, :3] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    for link in r.links:
        turn, at = pose(r, link, int(np.flatnonzero(np.isfinite(r.point_array).all(axis=(1, 2)))[0]))
        own = np.eye(4)
        own[:3, :3], own[:3, 3] = turn, at
        found, _ = scene.graph[link]
        assert found == pytest.approx(upright @ own, abs=1e-6)
    assert len(scene.geometry) >= len(r.links)


@pytest.mark.parametrize("kind", list(SYMBOLS))
def test_solids_look_outwards(kind: str) -> None:
    """Normals agree with the order of the corners."""
    found = symbol(kind)
    for s in [*found.on_i, *found.on_j]:
        m = mesh(s, 0.8)
        a, b, c = (m.points[m.triangles[:, k]] for k in range(3))
        across = np.cross(b - a, c - a)
        big = np.linalg.norm(across, axis=1) > 1e-9
        facing = np.sum(across * m.normals[m.triangles].mean(axis=1), axis=1)
        assert (facing[big] > 0).all(), type(s).__name__


def test_shapes_are_seen_through() -> None:
    """The crank's box of 60 x 20 x 10 mm, turned in its link; a cylinder between two points."""
    r = da.solve(da.load(examples()["rssr"]))
    file = File(da.draw.solid_model(r).to_glb())
    names = [m["name"] for m in file.tree["materials"]]
    assert file.tree["materials"][names.index("shape")]["alphaMode"] == "BLEND"
    for part in file.tree["meshes"]:
        found = [p for p in part["primitives"] if p["material"] == names.index("shape")]
        assert len(found) == (part["name"] != "ground")
        if part["name"] == "crank":
            points = file.values(found[0]["attributes"]["POSITION"])
            assert np.ptp(points, axis=0) == pytest.approx([0.06, 0.02, 0.01], abs=1e-7)
            assert (points.max(axis=0) + points.min(axis=0)) / 2 == pytest.approx([0.02, 0, 0], abs=1e-7)


def test_only_glb(tmp_path: Path) -> None:
    model = da.draw.solid_model(solved("hooke"))
    with pytest.raises(da.ModelError, match="solid models cannot be written in this format"):
        model.save(tmp_path / "a.obj")
    model.save(tmp_path / "a.glb")
    with pytest.raises(da.ModelError, match="exists"):
        model.save(tmp_path / "a.glb")


@pytest.mark.parametrize("count", [1, 2, 3])
def test_what_stands_still_has_no_animation(count: int) -> None:
    r = da.kinematics(da.four_bar(), positions=count)
    tree = File(da.draw.solid_model(r).to_glb()).tree
    assert ("animations" in tree) == (count > 1)


def test_the_command_writes_it(tmp_path: Path) -> None:
    from dalembert.cli import main

    path = tmp_path / "a.glb"
    assert main(["draw", str(examples()["four_bar"]), "-o", str(path)]) == 0
    assert File(path.read_bytes()).tree["animations"]
