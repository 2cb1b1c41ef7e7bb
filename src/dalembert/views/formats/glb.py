"""A mechanism in motion as a glTF 2.0 binary (.glb): a node per link, its solids as meshes, its poses as an animation.

Lengths are in metres. In space a root node turns the machine's z into glTF's y; planar mechanisms have y up already.
Written from the standard (Khronos 2021) without a library: a header, a chunk of JSON and a chunk of numbers.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dalembert.algebra import space
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.saving import new_file
from dalembert.views.formats.themes import SOLIDS
from dalembert.views.space.link_solids import ROD, link_solids, nodes, pose, shape_solids
from dalembert.views.space.triangles import TriangleMesh, join_meshes, mesh

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


FRAMES = 30
"""Positions per second where no speed gives the duration of the motion."""

SIZE = 110.0
"""Length of the machine in millimetres of symbols: they have the same relative size as in pictures."""

FLOAT, SHORT, INTEGER = 5126, 5123, 5125
DTYPES = {FLOAT: "<f4", SHORT: "<u2", INTEGER: "<u4"}
KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
VERTICES, INDICES = 34962, 34963
UPRIGHT = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
"""Quaternion that turns z upwards to y upwards."""


@dataclass(frozen=True)
class SolidModel:
    """A glTF document and its numbers; ``save`` writes .glb."""

    document: Tree = field(repr=False)
    numbers: bytes = field(repr=False)

    def to_glb(self) -> bytes:
        """Bytes of the file."""
        text = json.dumps(self.document, separators=(",", ":"), ensure_ascii=False).encode("utf-8")
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self.numbers), b"BIN\0") + self.numbers
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def save(self, path: str | Path, overwrite: bool = False) -> None:
        """Writes .glb."""
        target = Path(path)
        if target.suffix.lower() != ".glb":
            raise ModelError(f"{target.name}: solid models cannot be written in this format", "use .glb")
        with new_file(target, overwrite) as temporary:
            temporary.write_bytes(self.to_glb())


def solid_model(r: Result) -> SolidModel:
    """Links as solids, moving through all positions that have a pose; without loads and springs."""
    k = np.flatnonzero(np.isfinite(r.point_array).all(axis=(1, 2)))
    if not len(k):
        raise ModelError("no position has a pose to show", "see the reasons: dalembert solve")
    size = _extent(r, k) / SIZE
    w = _Writer()
    materials = {role: n for n, role in enumerate(MATERIALS)}
    links = [GROUND, *r.links]
    solids = link_solids(r, size)
    document_nodes: list[Tree] = []
    meshes: list[Tree] = []
    for link in links:
        by_role: dict[str, list[TriangleMesh]] = {}
        for s in [*solids[link], *shape_solids(r, link, size)]:
            role = "thread" if s.role == "hatch" else s.role
            by_role.setdefault(role, []).append(mesh(s, ROD * size))
        turn, at = pose(r, link, int(k[0]))
        node: Tree = {
            "name": link,
            "translation": _list(at),
            "rotation": _list(_quaternions(turn[None])[0]),
        }
        if by_role:
            node["mesh"] = len(meshes)
            parts = [w.primitive(join_meshes(some), materials[role]) for role, some in by_role.items()]
            meshes.append({"name": link, "primitives": parts})
        document_nodes.append(node)
    root: Tree = {"name": r.mechanism.title or "mechanism", "children": list(range(len(links)))}
    root |= {"rotation": UPRIGHT} if r.mechanism.dimension == 3 else {}
    document: Tree = {
        "asset": {"version": "2.0", "generator": "dalembert"},
        "scene": 0,
        "scenes": [{"nodes": [len(links)]}],
        "nodes": [*document_nodes, root],
        "meshes": meshes,
        "materials": [_material(role) for role in MATERIALS],
    }
    if len(k) > 1:
        document["animations"] = [_animation(r, k, links, w)]
    document |= {
        "accessors": w.accessors,
        "bufferViews": w.views,
        "buffers": [{"byteLength": len(w.numbers)}],
    }
    return SolidModel(document, bytes(w.numbers))


def times(r: Result, k: Array) -> Array:
    """Times of some positions, s: from a law, from the first drive's positions and speeds, else evenly spaced."""
    if r.schedule.time is not None:
        return np.asarray(r.schedule.time[k] - r.schedule.time[k[0]])
    if r.drives:
        place, speed = r.drive_position(r.drives[0])[k], r.drive_speed(r.drives[0])[k]
        step, mean = np.diff(place), (speed[1:] + speed[:-1]) / 2
        if bool((step * mean > 0).all()):
            return np.concatenate([[0.0], np.cumsum(step / mean)])
    return np.arange(len(k)) / FRAMES


def _animation(r: Result, k: Array, links: list[str], w: _Writer) -> Tree:
    """Translation and rotation of every moving link; a motion that returns to its start is closed."""
    moving = [link for link in links if link != GROUND]
    t = times(r, k)
    poses = {link: [pose(r, link, int(n)) for n in k] for link in moving}
    places = {link: np.array([at for _, at in some]) for link, some in poses.items()}
    turns = {link: _quaternions(np.array([turn for turn, _ in some])) for link, some in poses.items()}
    if _comes_round(r, places, turns):
        t = np.append(t, t[-1] + t[1] - t[0])
        places = {link: np.concatenate([p, p[:1]]) for link, p in places.items()}
        turns = {link: _smooth(np.concatenate([q, q[:1]])) for link, q in turns.items()}
    clock = w.accessor(t[:, None].astype("<f4"), None, limits=True)
    samplers: list[Tree] = []
    channels: list[Tree] = []
    for link in moving:
        for path, values in (("translation", places[link]), ("rotation", turns[link])):
            channels.append({"sampler": len(samplers), "target": {"node": links.index(link), "path": path}})
            out = w.accessor(values.astype("<f4"), None)
            samplers.append({"input": clock, "output": out, "interpolation": "LINEAR"})
    return {"name": "motion", "samplers": samplers, "channels": channels}


def _comes_round(r: Result, places: dict[str, Array], turns: dict[str, Array]) -> bool:
    """True if the step from the last position to the first is like the others and completes a full turn."""
    if not r.drives or len(r.status) < 8:
        return False
    angle = r.drive_position(r.drives[0])
    if not r.compiled.layout.freedoms.angular[r.compiled.layout.driven[0]]:
        return False
    turned = (angle[-1] - angle[0]) * len(angle) / (len(angle) - 1) / (2 * np.pi)
    if abs(turned - round(float(turned))) > 1e-6 or round(float(turned)) == 0:
        return False
    for p, q in ((places[link], turns[link]) for link in places):
        jump, step = np.linalg.norm(p[0] - p[-1]), np.linalg.norm(np.diff(p, axis=0), axis=1).max()
        spin, least = np.abs(q[0] @ q[-1]), np.abs((q[1:] * q[:-1]).sum(axis=1)).min()
        if jump > 1.5 * step + 1e-12 or spin < least - 0.5 * (1 - least) - 1e-12:
            return False
    return True


def _quaternions(turns: Array) -> Array:
    """Unit quaternions (n, 4) of matrices (n, 3, 3), each with the sign nearest to the previous one."""
    return _smooth(space.quaternion(turns.reshape(-1, 9)))


def _smooth(q: Array) -> Array:
    sign = np.sign((q[1:] * q[:-1]).sum(axis=1))
    return np.concatenate([q[:1], q[1:] * np.cumprod(np.where(sign == 0, 1.0, sign))[:, None]])


def _extent(r: Result, k: Array) -> float:
    """Longer side of the box that contains all nodes at all times."""
    some = k[np.unique(np.linspace(0, len(k) - 1, 24).astype(int))]
    places = []
    for link in (GROUND, *r.links):
        for n in some if link != GROUND else some[:1]:
            turn, at = pose(r, link, int(n))
            places += [turn @ u + at for u in nodes(r, link).values()]
    return float(np.ptp(np.array(places), axis=0).max()) or 1.0


class _Writer:
    """Numbers in one buffer, with glTF's description of each part of it."""

    def __init__(self) -> None:
        self.numbers = bytearray()
        self.views: list[Tree] = []
        self.accessors: list[Tree] = []

    def accessor(self, values: Array, target: int | None, kind: int = FLOAT, limits: bool = False) -> int:
        """Index of a new accessor of values (n, c)."""
        written = np.ascontiguousarray(values, DTYPES[kind])
        view: Tree = {"buffer": 0, "byteOffset": len(self.numbers), "byteLength": written.nbytes}
        self.views.append(view | ({"target": target} if target else {}))
        self.numbers += written.tobytes() + b"\0" * (-written.nbytes % 4)
        accessor: Tree = {
            "bufferView": len(self.views) - 1,
            "componentType": kind,
            "count": len(written),
            "type": KINDS[written.shape[1]],
        }
        if limits:
            accessor |= {"min": _list(written.min(axis=0)), "max": _list(written.max(axis=0))}
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def primitive(self, m: TriangleMesh, material: int) -> Tree:
        """A mesh of one material."""
        kind = SHORT if len(m.points) < 65535 else INTEGER
        return {
            "attributes": {
                "POSITION": self.accessor(m.points, VERTICES, limits=True),
                "NORMAL": self.accessor(m.normals, VERTICES),
            },
            "indices": self.accessor(m.triangles.reshape(-1, 1), INDICES, kind),
            "material": material,
        }


MATERIALS = (*SOLIDS, "guide", "thread", "shape")
"""Roles of solids, one material each."""

SEEN_THROUGH = ("guide", "shape")


def _material(role: str) -> Tree:
    colour = SOLIDS[role][1] if role in SOLIDS else "#6b7785"
    red, green, blue = (int(colour[n : n + 2], 16) / 255 for n in (1, 3, 5))
    seen = {
        "baseColorFactor": [*(_linear(c) for c in (red, green, blue)), 0.3 if role in SEEN_THROUGH else 1.0]
    }
    out: Tree = {
        "name": role,
        "pbrMetallicRoughness": seen | {"metallicFactor": 0.1, "roughnessFactor": 0.7},
    }
    return out | ({"alphaMode": "BLEND", "doubleSided": True} if role in SEEN_THROUGH else {})


def _linear(c: float) -> float:
    """Linear intensity of an sRGB component, IEC 61966-2-1."""
    return round(c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4, 5)


def _list(values: Array) -> list[float]:
    return [float(v) for v in values]
