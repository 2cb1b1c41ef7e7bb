"""One copy of links in space: turned about the z axis of the links that stay, with its joints and loads.

The copy's points, directions and inertia are those of the original turned by the angle of ground's image, so that it
is placed as drawn with its axes parallel to ground's. A link that stays has its points turned by its angle.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.files.copies.copying import Copying, Path
from dalembert.model.links.link import GROUND
from dalembert.model.quantities.figures import unit_vector

TURNED = {"center": "length", "axis": "number"}
"""Vectors of a shape, and their kinds."""


class SpaceCopying(Copying):
    """One copy being made in space."""

    @property
    def turned(self) -> float:
        """Angle of the copied links, radians: that of ground's image, or of the first link that stays."""
        phase = self.image.phase
        return phase.get(GROUND, next(iter(phase.values()), 0.0))

    def angle_of(self, link: str) -> float:
        """Angle by which what touches a link is turned."""
        return self.turned if link in self.of else self.image.phase.get(link, 0.0)

    def vector(self, value: object, angle: float, kind: str = "length") -> object:
        """A vector [x, y, z] turned about z; other values as they are."""
        if not angle or not isinstance(value, list) or len(value) != 3:
            return value
        flat = self.image.components(value[:2], angle, kind)
        return [*flat, value[2]] if isinstance(flat, list) else value

    def link(self, link: Tree) -> Tree:
        angle = self.turned
        if not angle:
            return link
        new = dict(link)
        if isinstance(points := link.get("points"), Mapping):
            new["points"] = {n: self.spot(p, angle) for n, p in points.items()}
        if "center" in link:
            new["center"] = self.vector(link["center"], angle)
        if "inertia" in link:
            new["inertia"] = self.inertia(link["inertia"], angle)
        shapes = link.get("shape")
        if isinstance(shapes, list):
            new["shape"] = [self.shape(s, angle) for s in shapes]
        elif shapes is not None:
            new["shape"] = self.shape(shapes, angle)
        return new

    def spot(self, point: object, angle: float) -> object:
        """A point of a link, which may be placed from another one of it."""
        if isinstance(point, Mapping):
            return {**point, **({"at": self.vector(point["at"], angle)} if "at" in point else {})}
        return self.vector(point, angle)

    def shape(self, shape: object, angle: float) -> object:
        if not isinstance(shape, Mapping):
            return shape
        if "file" in shape or (shape.get("type") == "box" and "axes" not in shape and angle % (math.pi / 2)):
            what = "a mesh" if "file" in shape else "a box without axes"
            raise ModelError(f"{what} is not turned", "give mass, center and inertia instead of its shape")
        new = {k: self.vector(v, angle, TURNED[k]) if k in TURNED else v for k, v in shape.items()}
        if isinstance(axes := shape.get("axes"), Mapping):
            new["axes"] = {k: self.vector(v, angle, "number") for k, v in axes.items()}
        return new

    def inertia(self, value: object, angle: float) -> object:
        """One number as it is; principal values or a matrix as a matrix."""
        if not isinstance(value, list) or len(value) != 3:
            return value
        rows = [
            row if isinstance(row, list) else [row if j == i else 0 for j in range(3)]
            for i, row in enumerate(value)
        ]
        try:
            known = [[self.image.rules.quantity(x, "inertia") for x in row] for row in rows]
        except ModelError:
            return value
        if any(not isinstance(x, float | int) or type(x) not in (float, int) for row in known for x in row):
            what = "an inertia that follows from parameters is not turned"
            raise ModelError(what, "give the copies a shape, or one number")
        cos, sin = unit_vector(angle)
        turn = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]
        half = [[sum(turn[i][k] * known[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
        full = [[sum(half[i][k] * turn[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
        return [[f"{(full[min(i, j)][max(i, j)])!r} kg*m^2" for j in range(3)] for i in range(3)]

    def point(self, link: str, point: str) -> str:
        if link in self.of or not self.image.phase.get(link):
            return point
        new, owner = f"{point}{self.image.ending}", self.tree["links"].get(link)
        points = owner.get("points", {}) if isinstance(owner, Mapping) else {}
        path: Path = ("links", link, "points", new)
        if not isinstance(owner, Mapping) or not isinstance(points, Mapping) or point not in points:
            return point  # what is wrong with it is said where it is read
        if new in points and path not in self.copied:
            what = f"link {link!r} has a point {new!r} already"
            raise ModelError(what, "give the copies other names: names: [...]")
        if not isinstance(points[point], list):
            what = f"point {point!r} of link {link!r} is placed from another one"
            raise ModelError(what, "give it a vector, which copies turn", ("phase",))
        placed = self.vector(points[point], self.image.phase[link])
        self.tree["links"][link] = {**owner, "points": {**points, new: placed}}
        self.copied[path] = self.path
        return new

    def joint(self, name: str, joint: Tree) -> Tree:
        if "radii" in joint or "teeth" in joint or "ends" in joint:
            what = f"{name!r} is a gear or a band, which is not copied in space"
            raise ModelError(what, "write its copies out", ("joints", name))
        links, at = [str(n) for n in joint.get("links", ())], joint.get("at", name)
        points = [str(p) for p in at] if isinstance(at, list) else [str(at)] * len(links)
        new = {
            **joint,
            "links": [f"{n}{self.image.ending}" if n in self.of else n for n in links],
            "at": [self.point(link, p) for link, p in zip(links, points, strict=False)],
        }
        angles = [self.angle_of(n) for n in links]
        if len(angles) == 2 and "axis" in joint and joint.get("type") not in ("spherical", "weld"):
            if angles[0] != angles[1]:
                what = f"{name!r} has one axis in links that are turned by different angles"
                raise ModelError(what, "give both links the same angle in phase, or write axes", ("phase",))
            new["axis"] = self.vector(joint["axis"], angles[0], "number")
        if isinstance(axes := joint.get("axes"), Mapping) and len(angles) == 2:
            by = dict(zip("ij", angles, strict=True))
            new["axes"] = {
                end: {k: self.vector(v, by[end], "number") for k, v in part.items()}
                if end in by and isinstance(part, Mapping)
                else part
                for end, part in axes.items()
            }
        return new

    def between(self, joint: str) -> float:
        """0: a joint's local axes turn with it."""
        return 0.0

    def require_mirrors(self, name: str, *links: str) -> None:
        """Mirror images do not exist in space."""

    def slides(self, joint: str, drive: Tree) -> bool:
        return True  # all values of its drives stay

    def load(self, load: Tree) -> Tree:
        base: Any = dict(load)
        vectors = {k: base.pop(k) for k in ("direction", "value") if isinstance(base.get(k), list)}
        if isinstance(base.get("at"), list):
            vectors["at"] = base.pop("at")
        kinds = {"at": "length", "value": "moment" if load.get("type") == "couple" else "force"}
        new = super().load(base)
        for key, value in vectors.items():
            turned = self.vector(value, self.turned, kinds.get(key, "number"))
            new[key] = self.going_by(turned) if key == "value" else turned
        return new

    def pose(self, assembly: Tree, name: str, pose: object) -> None:
        if not isinstance(pose, Mapping):
            return
        new = dict(pose)
        for key, kind in (("position", "length"), ("axis", "number")):
            if key in pose:
                new[key] = self.vector(pose[key], self.turned, kind)
        assembly[f"{name}{self.image.ending}"] = new
        self.copied["assembly", f"{name}{self.image.ending}"] = self.path
