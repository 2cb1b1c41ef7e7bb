"""One copy of links: what hangs on them and acts on them, with the copy's names and places."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.files.copies.element_copies import carrier, seat
from dalembert.model.files.copies.images import Image
from dalembert.model.files.copies.likeness import Likeness
from dalembert.model.links.link import GROUND, Link
from dalembert.model.quantities.coordinates import SPEED, is_speed, parts, path_of
from dalembert.model.quantities.dependent_numbers import Dependent
from dalembert.model.quantities.expressions import long_names, parse_expression
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.values import vector
from dalembert.model.quantities.varying import has_units

Path = tuple[str | int, ...]

GUIDES = ("slider", "slot")
"""Joints with a direction in i's axes."""


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
        entries = self.tree.get(section)
        pairs = entries.items() if isinstance(entries, Mapping) else ()
        return [(str(n), value) for n, value in pairs if isinstance(value, Mapping)]

    def run(self) -> None:
        """Add everything that is copied."""
        self.refuse_ropes()
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
        for name, start in self.items("start"):
            if name in self.drives and f"{name}{self.image.ending}" not in self.tree["start"]:
                self.add("start", name, self.start(name, start))
        if self.image.shift and not self.shifted:
            what = "shift has no effect: none of its loads depends on a drive that is not copied"
            raise ModelError(what, "leave shift out", ("shift",))

    def refuse_ropes(self) -> None:
        """A rope that touches copied links is not copied with them."""
        for name, joint in self.items("joints"):
            points = [p.get("round") if isinstance(p, Mapping) else p for p in _list(joint.get("through"))]
            if {str(p).split(".")[0] for p in points} & set(self.of):
                what = f"rope {name!r} touches copied links, and ropes are not copied"
                raise ModelError(what, "write the copies of its links out", ("of",))

    def likeness(self) -> Likeness:
        """Relation of the copy to its original, except for links whose angle the file states itself."""
        end, image = self.image.ending, self.image
        alike = Likeness(
            image.side,
            {link: image.offset(link) for link in image.phase},
            *({f"{name}{end}": name for name in names} for names in (self.of, self.joints, self.drives)),
        )
        assembly = self.tree.get("assembly")
        stated = assembly if isinstance(assembly, Mapping) else {}
        ends = {f"{n}{end}": tuple(self.tree["joints"][f"{n}{end}"]["links"]) for n in self.joints}
        return alike.without((n for n in stated if ("assembly", n) not in self.copied), ends)

    def add(self, section: str, name: str, value: object) -> None:
        new = f"{name}{self.image.ending}"
        if new in {str(other) for other in self.tree[section]}:
            what = f"its {section[:-1]} {new!r} already exists"
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
                what = "a mesh cannot be mirrored"
                raise ModelError(what, "give mass, center and inertia instead of its shape")
        flipped = [s | {key: at(s[key]) for key in ("center", "axis") if key in s} for s in _list(shapes)]
        return new | ({"shape": flipped} if shapes else {})

    def place(self, place: object) -> object:
        """A point of a mirrored link."""
        if not isinstance(place, Mapping):
            return self.image.components(place)
        new = {**place, **({"at": self.image.components(place["at"])} if "at" in place else {})}
        return new | {key: self.image.angle(place[key]) for key in ("turn", "mirror") if key in place}

    def point(self, link: str, point: str) -> str:
        """Point that the copy is attached to: that of its link, or of the image of a link that is not copied."""
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
        if "ends" in joint:
            what = f"{name!r} is a band, which is not copied"
            raise ModelError(what, "write the second one out", ("joints", name))
        links, at = [str(link) for link in _list(joint.get("links"))], joint.get("at", name)
        points = [str(p) for p in at] if isinstance(at, list) else [str(at)] * len(links)
        here = [self.point(link, p) for link, p in zip(links, points, strict=False)]
        if joint.get("type") not in ("pin", "gear"):
            self.require_mirrors(name, *links)
        i, j = self.ends(links)
        new = {
            **joint,
            "links": [f"{link}{self.image.ending}" if link in self.of else link for link in links],
            "at": here,
        }
        rolls, slides = joint.get("type") == "rolling" and "radii" not in joint, joint.get("type") == "slider"
        if rolls or joint.get("type") in GUIDES:
            wheel = math.pi if self.image.mirrored and rolls else 0.0
            new["direction"] = self.image.angle(joint.get("direction", 0), i + wheel)
        if "angle" in joint or (slides and j) or (joint.get("type") == "weld" and i != j):
            new["angle"] = self.image.angle(joint.get("angle", 0), (0.0 if slides else i) - j)
        if joint.get("type") == "shoe":
            seat(self, name, links, joint, new)
        if "stops" in joint and joint.get("type") not in GUIDES:
            new["stops"] = self.image.interval(joint["stops"], self.between(name))
        if isinstance(joint.get("profile"), Mapping):
            new |= self.image.cam(joint, carrier(self, name, links) if "at" in joint else 0.0)
        return new

    def ends(self, links: list[str]) -> list[float]:
        """Angles of the images of i and j against them; 0 of a link that is copied, as its image is the copy."""
        return [0.0 if link in self.of else self.image.offset(link) for link in (*links, "", "")[:2]]

    def require_mirrors(self, name: str, *links: str) -> None:
        """A reflected copy needs the line on every link that says a direction."""
        for link in links if self.image.mirrored else ():
            if link not in self.of and link not in self.image.phase:
                remedy = f"write mirror: {{{link}: 90 deg}}, the angle of the line in its axes"
                raise ModelError(f"{name!r} does not say how link {link!r} is mirrored", remedy, ("mirror",))

    def between(self, joint: str) -> float:
        """Angle of a copied joint's j against its i minus that of the image."""
        links = [str(link) for link in _list(self.joints[joint].get("links"))]
        self.require_mirrors(joint, *links)
        i, j = self.ends(links)
        return i - j

    def drive(self, name: str, drive: Tree) -> Tree:
        joint, image = str(drive.get("joint", name)), self.image
        new = {**drive, **({"joint": f"{joint}{image.ending}"} if "joint" in drive else {})}
        if "effort" in drive:
            new["effort"] = self.going_by(drive["effort"])
        if self.slides(joint, drive):
            return new
        offset = self.between(joint)
        for key in ("position", "law"):
            if key in drive:
                new[key] = self.positions(drive[key], offset)
        for key in ("stops", "range"):
            if key in drive:
                new[key] = image.interval(drive[key], offset)
        if "motor" in drive:
            new["motor"] = image.motor(drive["motor"], offset)
        return new | {
            key: image.opposite(new[key]) for key in ("speed", "acceleration", "effort") if key in new
        }

    def start(self, name: str, start: Tree) -> Tree:
        """Start of the copied drive."""
        joint = str(self.drives[name].get("joint", name))
        if self.slides(joint, self.drives[name]):
            return start
        new = {**start, **({"speed": self.image.opposite(start["speed"])} if "speed" in start else {})}
        position = self.image.angle(start["position"], self.between(joint)) if "position" in start else None
        return new if position is None else new | {"position": position}

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
            new["joint"] = f"{joint}{image.ending}"
            if load.get("type") == "torsion_spring":
                new["free_angle"] = image.angle(load.get("free_angle", 0), self.between(joint))
            return new
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
            value = load["value"]
            if load.get("type") == "couple":
                value = image.opposite(value)
            elif "direction" not in load:
                value = image.components(value, offset, "force")
            new["value"] = self.going_by(value)
        return new

    def going_by(self, value: object) -> object:
        """A value that depends on a drive, later by the shift; on a copied joint, link or drive, on the copy's."""
        if isinstance(value, list):
            return [self.going_by(item) for item in value]
        if isinstance(value, Mapping) and "expression" in value:
            return {**value, "expression": self.going_by(value["expression"])}
        if isinstance(value, Mapping):
            return self.table(value)
        if not isinstance(value, str):
            return value
        size, at, angle = value.partition("@")
        rules = self.image.rules
        named = has_units(size, rules)
        try:
            rest = parse_expression(size, {*rules.parameters, *rules.freedoms} if named else None)[1]
        except ModelError:
            rest = ""
        body = size.rstrip().removesuffix(rest)
        names = re.sub(
            r"(?<![\w.])[^\W\d]\w*(?:\.\w+\.\w+(?:\.speed\b)?|\.speed)?(?![\w.(])",
            lambda m: self.renamed(m[0], named),
            long_names(body),
        )
        return names + size[len(body) :] + at + angle

    def renamed(self, name: str, dimensional: bool) -> str:
        """Name of an expression in the copy; ``dimensional``: in an expression of parameters."""
        image = self.coordinate(name)
        if image is not None:
            new, side, offset = image
            back = repr(offset) if not dimensional else f"{offset / math.pi!r}*pi"
            if is_speed(new) and not offset:
                return new if side == 1 else f"({side}*{new})"
            return new if side == 1 and not offset else f"({side}*({new} - {back}))"
        if name not in self.staying():
            return name
        self.shifted, shift = True, self.image.shift
        if not shift:
            return name
        of_turn = f"{shift / math.pi!r}*pi" if dimensional else repr(shift)
        return f"({name} - {f'{shift!r} m' if dimensional and self.slid(name) else of_turn})"

    def slid(self, drive: str) -> bool:
        """True if a drive that stays is a slide."""
        return self.image.rules.freedoms.get(drive) == "slide"

    def staying(self) -> list[str]:
        return [
            name
            for name, _ in self.items("drives")
            if name not in self.drives and ("drives", name) not in self.copied
        ]

    def coordinate(self, name: str) -> tuple[str, int, float] | None:
        """The copy's coordinate for one of the original, side times that of the original plus an offset."""
        end, side = self.image.ending, self.image.side
        drive, rate = name.removesuffix(SPEED), SPEED if name.endswith(SPEED) else ""
        kind, of, which = parts(name) or ("", "", "")
        if drive in self.drives:
            joint, new = str(self.drives[drive].get("joint", drive)), f"{drive}{end}{rate}"
            straight = self.slides(joint, self.drives[drive])
            return (new, 1, 0.0) if straight else (new, side, 0.0 if rate else self.between(joint))
        if kind == "joints" and of in self.joints:
            new = f"joints.{of}{end}.{which}{rate}"
            straight = which.startswith("slide")
            return (new, 1, 0.0) if straight else (new, side, 0.0 if rate else self.between(of))
        if kind == "links" and of in self.of:
            self.require_mirrors(name, GROUND)
            return f"links.{of}{end}.angle{rate}", side, 0.0 if rate else self.image.offset(GROUND)
        return None

    def table(self, value: Mapping[str, object]) -> Mapping[str, object]:
        against, image = path_of(str(value.get("against", ""))), self.image
        coordinate = self.coordinate(against)
        if coordinate is None and (against not in self.staying() or not image.shift):
            return value
        if coordinate is None:
            self.shifted = True
            kind = "length" if self.slid(against) else "angle"
            return {**value, "shift": image.plus(value.get("shift", 0), image.shift, kind)}
        new, side, offset = coordinate
        table = value if side == 1 else image.reversed_table(value)
        moved = {"shift": image.angle(value.get("shift", 0), offset)} if "shift" in value or offset else {}
        return {**table, "against": new, **moved}

    def pose(self, assembly: Tree, name: str, pose: object) -> None:
        """The copy's approximate angle and position."""
        if self.image.mirrored and GROUND not in self.image.phase:
            return
        new = f"{name}{self.image.ending}"
        listed = pose if isinstance(pose, list) and len(pose) == 3 else None
        angle = self.image.angle(listed[2] if listed else pose, self.image.offset(GROUND))
        place = self.position(listed[:2]) if listed else None
        assembly[new] = angle if place is None else [*place, angle]
        self.copied["assembly", new] = self.path

    def position(self, place: list[object]) -> list[object] | None:
        """The image of a position in ground axes; None where it follows from parameters."""
        image, ground = self.image, self.tree["links"].get(GROUND)
        points = ground.get("points", {}) if isinstance(ground, Mapping) else {}
        about = image.about if image.about in points else ""
        if not image.mirrored and not image.offset(GROUND):
            return place
        try:
            x, y = vector(place, "length", image.rules)
            a, b = (
                Link.model_validate({"points": points}, context=image.rules).point(about)
                if about
                else (0.0, 0.0)
            )
        except ModelError:
            return None
        if any(isinstance(value, Dependent) for value in (x, y, a, b)):
            return None
        cos, sin = unit_vector(image.offset(GROUND))
        x, y = x - a, image.side * (y - b)
        return [f"{a + cos * x - sin * y!r} m", f"{b + sin * x + cos * y!r} m"]


def _list(value: object) -> list[Any]:
    return list(value) if isinstance(value, (list, tuple)) else [value] if isinstance(value, Mapping) else []
