"""One copy of links: what hangs on them and acts on them, with the copy's names and places."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.files.copies.images import Image
from dalembert.model.links.link import GROUND
from dalembert.model.quantities.coordinates import SPEED
from dalembert.units import quantity

Path = tuple[str | int, ...]


class Copying:
    """One copy being made."""

    def __init__(self, tree: Tree, of: list[str], image: Image, copied: dict[Path, Path], path: Path) -> None:
        self.tree, self.of, self.image, self.copied, self.path = tree, of, image, copied, path
        self.joints = {
            n: j for n, j in self.items("joints") if {str(i) for i in _list(j.get("links"))} & set(of)
        }
        self.drives = {n: d for n, d in self.items("drives") if str(d.get("joint", n)) in self.joints}
        self.shifted = False

    def items(self, section: str) -> list[tuple[str, Any]]:
        found = self.tree.get(section)
        pairs = found.items() if isinstance(found, Mapping) else ()
        return [(str(n), value) for n, value in pairs if isinstance(value, Mapping)]

    def run(self) -> None:
        """Add everything that is copied."""
        links = dict(self.items("links"))
        for name in self.of:
            self.add("links", name, self.link(links.get(name, {})))
        for name, joint in self.joints.items():
            self.add("joints", name, self.joint(name, joint))
        for name, drive in self.drives.items():
            self.add("drives", name, self.drive(name, drive))
        for name, load in self.items("loads"):
            if self.comes_along(load):
                self.add("loads", name, self.load(load))
        assembly: Any = self.tree.get("assembly")
        for name, pose in list(assembly.items()) if isinstance(assembly, Mapping) else ():
            if str(name) in self.of and f"{name}{self.image.ending}" not in assembly:
                self.pose(assembly, str(name), pose)
        if self.image.shift and not self.shifted:
            what = "none of its loads goes by a drive that stays, to be shifted"
            raise ModelError(what, "leave shift out", ("shift",))

    def add(self, section: str, name: str, value: object) -> None:
        new = f"{name}{self.image.ending}"
        if new in {str(other) for other in self.tree[section]}:
            what = f"its {section[:-1]} {new!r} is there already"
            raise ModelError(what, "give the copies other names: names: [...]")
        self.tree[section][new] = value
        self.copied[section, new] = self.path

    def link(self, link: Tree) -> Tree:
        if not self.image.mirrored:
            return link
        new, at = dict(link), self.image.components
        points = link.get("points")
        if isinstance(points, Mapping):
            new["points"] = {n: self.place(p) for n, p in points.items()}
        if "center" in link:
            new["center"] = at(link["center"])
        shapes = link.get("shape", [])
        for shape in shapes if isinstance(shapes, list) else [shapes]:
            if "file" in shape:
                what = "a mesh is not mirrored"
                raise ModelError(what, "give mass, center and inertia in place of its shape")
        flipped = [{**s, **({"center": at(s["center"])} if "center" in s else {})} for s in _list(shapes)]
        return new | ({"shape": flipped} if shapes else {})

    def place(self, place: object) -> object:
        """A point of a mirrored link."""
        if not isinstance(place, Mapping):
            return self.image.components(place)
        new = {**place, **({"at": self.image.components(place["at"])} if "at" in place else {})}
        return new | {key: self.image.angle(place[key]) for key in ("turn", "mirror") if key in place}

    def point(self, link: str, point: str) -> str:
        """A point that the copy hangs on: its own, or that of the image of a link that stays."""
        if link in self.of or link not in self.image.phase:
            return point
        new, owner = f"{point}{self.image.ending}", self.tree["links"].get(link)
        points = owner.get("points", {}) if isinstance(owner, dict) else {}
        if not isinstance(points, dict):
            return point  # what is wrong with it is said where it is read
        path: Path = ("links", link, "points", new)
        if new in points and path not in self.copied:
            what = f"link {link!r} has a point {new!r} already"
            raise ModelError(what, "give the copies other names: names: [...]")
        about = self.image.about if self.image.about in points else ""
        how = {"mirror" if self.image.mirrored else "turn": f"{self.image.phase[link]!r} rad"}
        placed = {"from": point, **how, **({"about": about} if about else {})}
        self.tree["links"][link] = (
            {**owner, "points": {**points, new: placed}} if isinstance(owner, dict) else owner
        )
        self.copied[path] = self.path
        return new

    def joint(self, name: str, joint: Tree) -> Tree:
        links, at = [str(link) for link in _list(joint.get("links"))], joint.get("at", name)
        points = [str(p) for p in at] if isinstance(at, list) else [str(at)] * len(links)
        here = [self.point(link, p) for link, p in zip(links, points, strict=False)]
        if joint.get("type") not in ("pin", "gear"):
            self.require_mirrors(name, *links)
        i, j = (self.image.offset(link) if link not in self.of else 0.0 for link in (*links, "", "")[:2])
        new = {
            **joint,
            "links": [f"{link}{self.image.ending}" if link in self.of else link for link in links],
            "at": here,
        }
        if "direction" in joint:
            wheel = math.pi if self.image.mirrored and joint.get("type") == "rolling" else 0.0
            new["direction"] = self.image.angle(joint["direction"], i + wheel)
        slides = joint.get("type") == "slider"
        if "angle" in joint or (slides and j) or (joint.get("type") == "weld" and i != j):
            new["angle"] = self.image.angle(joint.get("angle", 0), (0.0 if slides else i) - j)
        return new

    def require_mirrors(self, name: str, *links: str) -> None:
        """A reflected copy needs the line on every link that says a direction."""
        for link in links if self.image.mirrored else ():
            if link not in self.of and link not in self.image.phase:
                remedy = f"write mirror: {{{link}: 90 deg}}, the angle of the line in its axes"
                raise ModelError(f"{name!r} does not say how link {link!r} is mirrored", remedy, ("mirror",))

    def between(self, joint: str) -> float:
        """What the angle of a copied joint's j against its i has more than that of the image."""
        links = [str(link) for link in _list(self.joints[joint].get("links"))]
        i, j = (0.0 if link in self.of else self.image.offset(link) for link in (*links, "", "")[:2])
        return i - j

    def drive(self, name: str, drive: Tree) -> Tree:
        joint = str(drive.get("joint", name))
        new = {**drive, **({"joint": f"{joint}{self.image.ending}"} if "joint" in drive else {})}
        if "effort" in drive:
            new["effort"] = self.going_by(drive["effort"])
        if self.slides(joint, drive):
            return new
        offset = self.between(joint)
        if "position" in drive:
            new["position"] = self.positions(drive["position"], offset)
        if isinstance(drive.get("law"), Mapping):
            new["law"] = self.positions(drive["law"], offset)
        for key in ("speed", "acceleration", "effort"):
            if key in drive:
                new[key] = self.image.opposite(new[key])
        return new

    def slides(self, joint: str, drive: Tree) -> bool:
        return (
            str(drive.get("freedom", "slide" if self.joints[joint].get("type") == "slider" else ""))
            == "slide"
        )

    def positions(self, value: object, offset: float) -> object:
        """Angles of a drive: one, a list, a range, a law."""
        if isinstance(value, Mapping):
            ends = ("from", "to", "position")
            return {k: self.positions(v, offset) if k in ends else v for k, v in value.items()}
        if isinstance(value, list):
            return [self.image.angle(x, offset) for x in value]
        return value if value == "unknown" else self.image.angle(value, offset)

    def comes_along(self, load: Tree) -> bool:
        ends = {str(end).split(".")[0] for end in _list(load.get("between"))}
        return (
            str(load.get("on")) in self.of
            or bool(ends & set(self.of))
            or str(load.get("joint")) in self.joints
        )

    def load(self, load: Tree) -> Tree:
        new, image = dict(load), self.image
        if "between" in load:
            pairs = (str(end).partition(".") for end in _list(load["between"]))
            new["between"] = [
                f"{a}{image.ending if a in self.of else ''}.{self.point(a, p)}" for a, _, p in pairs
            ]
        if "joint" in load:
            joint = str(load["joint"])
            free = {"free_angle": image.angle(load.get("free_angle", 0), self.between(joint))}
            return (
                new
                | {"joint": f"{joint}{image.ending}"}
                | (free if load.get("type") == "torsion_spring" else {})
            )
        if "on" not in load:
            return new
        new["on"] = f"{load['on']}{image.ending}"
        if not isinstance(load.get("at", ""), str) or "@" in load.get("at", ""):
            new["at"] = image.components(load["at"])
        follows = load.get("axes") == "link"
        if load.get("type") == "force" and not follows:
            self.require_mirrors(str(load["on"]), GROUND)
        offset = 0.0 if follows else image.offset(GROUND)
        if "direction" in load:
            new["direction"] = image.angle(load["direction"], offset)
        if "value" in load:
            new["value"] = self.going_by(load["value"])
            if load.get("type") == "couple":
                new["value"] = image.opposite(new["value"])
            elif "direction" not in load:
                new["value"] = image.components(new["value"], offset, "force")
        return new

    def going_by(self, value: object) -> object:
        """A value that goes by a drive, later by the shift; by a copied joint, link or drive: by the copy's."""
        if isinstance(value, list):
            return [self.going_by(item) for item in value]
        if isinstance(value, Mapping) and "expression" in value:
            return {**value, "expression": self.going_by(value["expression"])}
        if isinstance(value, Mapping):
            return self.table(value)
        if not isinstance(value, str):
            return value
        names = {**dict.fromkeys(self.staying(), self.shift_text), **dict(self.copy_names())}
        return re.sub(
            r"(?<![\w.])[^\W\d]\w*(?:\.\w+\.\w+|\.speed)?(?![\w.(])",
            lambda m: names[m[0]](m[0]) if m[0] in names else m[0],
            value,
        )

    def staying(self) -> list[str]:
        return [
            name
            for name, _ in self.items("drives")
            if name not in self.drives and ("drives", name) not in self.copied
        ]

    def shift_text(self, drive: str) -> str:
        self.shifted = True
        return f"({drive} - {self.image.shift!r})" if self.image.shift else drive

    def copy_names(self) -> Iterator[tuple[str, Callable[[str], str]]]:
        """Coordinates of what is copied, as the copy's: turned and reflected back."""
        end, side = self.image.ending, self.image.side

        def turn(new: str, offset: float) -> Callable[[str], str]:
            plain = side == 1 and offset == 0
            return lambda _: new if plain else f"({side}*({new} - {offset!r}))"

        for name, drive in self.drives.items():
            joint = str(drive.get("joint", name))
            yield (
                name,
                turn(f"{name}{end}", self.between(joint))
                if not self.slides(joint, drive)
                else turn_free(f"{name}{end}"),
            )
            rate = f"{name}{end}{SPEED}"
            yield f"{name}{SPEED}", turn_free(rate) if self.slides(joint, drive) else turn(rate, 0.0)
        for name in self.joints:
            yield f"joints.{name}.turn", turn(f"joints.{name}{end}.turn", self.between(name))
            yield f"joints.{name}.slide", turn_free(f"joints.{name}{end}.slide")
        for name in self.of:
            yield f"links.{name}.angle", turn(f"links.{name}{end}.angle", self.image.offset(GROUND))

    def table(self, value: Mapping[str, object]) -> Mapping[str, object]:
        drives = [name for name, _ in self.items("drives")]
        against = str(value.get("against", drives[0] if len(drives) - len(self.drives) == 1 else ""))
        new = dict(self.copy_names()).get(against)
        if new is not None:
            said = new(against)
            if "(" in said:
                what = f"a table against {against!r} is turned or mirrored with it"
                raise ModelError(what, "write that load as an expression")
            return {**value, "against": said}
        if against not in self.staying() or not self.image.shift:
            return value
        self.shifted = True
        kind = "length" if self.image.rules.freedoms.get(against) == "slide" else "angle"
        own = quantity(value.get("shift", 0), kind, self.image.rules.units)
        return {
            **value,
            "against": against,
            "shift": f"{own + float(str(self.image.shift))!r} {'m' if kind == 'length' else 'rad'}",
        }

    def pose(self, assembly: Tree, name: str, pose: object) -> None:
        """The copy's approximate angle; where the ground's image is turned a position is left out."""
        offset = self.image.offset(GROUND)
        if self.image.mirrored and GROUND not in self.image.phase:
            return
        if isinstance(pose, list) and len(pose) == 3 and (offset or self.image.mirrored):
            pose = pose[2]
        assembly[f"{name}{self.image.ending}"] = (
            pose if isinstance(pose, list) else self.image.angle(pose, offset)
        )
        self.copied["assembly", f"{name}{self.image.ending}"] = self.path


def turn_free(new: str) -> Callable[[str], str]:
    """A coordinate that is the same in the copy's image."""
    return lambda _: new


def _list(value: object) -> list[Any]:
    return list(value) if isinstance(value, (list, tuple)) else [value] if isinstance(value, Mapping) else []
