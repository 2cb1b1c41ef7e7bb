"""A planar mechanism as one in space: every link in a separate plane, so that bearing moments can be computed."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.model.joints.plane_joints import Gear, Pin, Slider, Slot, Weld
from dalembert.model.paths import used_parameters, with_dependents
from dalembert.model.quantities.values import Vector
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

UP = [0.0, 0.0, 1.0]
Freed = Literal["cylindrical", "spherical"]


def lifted(
    m: ModelOrPath,
    offsets: Mapping[str, object] | None = None,
    become: Mapping[str, Freed] | None = None,
) -> Mechanism:
    """The planar mechanism in space, its plane as x and y.

    ``offsets`` are heights z of links (their points and mass centres; default 0) and of joints (the middle of the
    bearing; default halfway between its two links), in metres or as texts with units. Pins become revolutes, sliders
    prismatic joints, slots slotted cylinders. Each closed loop is then redundant three times; ``become`` names pins
    to be made cylindrical (free to slide along z) or spherical, so that all reactions follow from statics. A spring or
    damper between two links keeps halfway between their heights, and so its length. A joint's stiffness is the same
    along all its axes.

    Moments of inertia about axes in the plane do no work in a plane motion; half the planar one is written for both.
    Forces and efforts in the plane are those of the planar mechanism. Raises ModelError for what has no counterpart.

    >>> import dalembert as da
    >>> from dalembert.model.library import four_bar
    >>> m = da.lifted(four_bar(), {"coupler": "20 mm"}, {"B": "spherical", "O4": "cylindrical"})
    >>> da.mobility(m).sentence
    'mobility 1, driven by 1 drive, no redundant constraint'
    """
    m = as_mechanism(m)
    if m.space != "plane":
        raise ModelError("the mechanism is already in space", "lift a planar one", ("space",))
    if m.turning is not None:
        remedy = "leave turning out, and join the plane to ground by a revolute that is driven"
        raise ModelError("a plane that turns is not lifted", remedy, ("turning",))
    return _Lift(in_numbers(m), dict(offsets or {}), dict(become or {})).mechanism()


def in_numbers(m: Mechanism) -> Mechanism:
    """The mechanism with numbers where they follow from parameters; what changes along the motion keeps them."""
    plain: Mechanism = with_dependents(m, lambda leaf: float(leaf) if isinstance(leaf, float) else leaf, None)
    return plain.model_copy(update={"parameters": used_parameters(plain, m.parameters)})


class _Lift:
    """One mechanism being lifted."""

    def __init__(self, m: Mechanism, offsets: Tree, become: dict[str, Freed]) -> None:
        from dalembert.units import quantity

        self.m, self.become = m, become
        known = [*m.links, *m.joints]
        for name in offsets:
            if name not in known:
                raise ModelError(f"unknown link or joint {name!r} to offset", closest(name, known))
        for name, kind in become.items():
            if name not in m.joints or not m.joints[name].hinge:
                pins = [n for n, joint in m.joints.items() if joint.hinge]
                raise ModelError(f"{name!r} is not a pin that can become {kind}", closest(name, pins))
            if kind not in ("cylindrical", "spherical"):
                raise ModelError(f"a pin cannot become {kind!r}", "write cylindrical or spherical")
        heights = {name: quantity(value, "length", None) for name, value in offsets.items()}
        self.link = {name: heights.get(name, 0.0) for name in m.links}
        self.joint = {
            name: heights.get(name, sum(self.link[link] for link in joint.links) / 2)
            for name, joint in m.joints.items()
        }
        self.extra: dict[str, dict[str, list[float]]] = {name: {} for name in m.links}

    def mechanism(self) -> Mechanism:
        """The lifted mechanism."""
        from dalembert.model.description import mechanism
        from dalembert.model.drives.starting import StartValue

        m = self.m
        joints = {name: self._joint(name) for name in m.joints}
        loads = {name: self._load(name) for name in m.loads}
        tree = {
            "title": m.title,
            "source": m.source_text,
            "space": "space",
            "units": {"angle": "rad"},
            "gravity": [*m.gravity_vector, 0.0] if any(m.gravity_vector) else "none",
            "g": m.g,
            "parameters": {name: p.tree() for name, p in m.parameters.items()},
            "links": {name: self._link(name) for name in m.links},
            "joints": joints,
            "drives": {name: self._drive(name) for name in m.drives},
            "loads": loads,
            "friction": m.friction.model_dump(mode="json", exclude_none=True),
            "assembly": self._assembly(),
            "start": StartValue().write(m.start),
        }
        return mechanism(tree).model_copy(update={"units": m.units})

    def _at(self, vector: Vector, height: float) -> list[float]:
        return [float(vector[0]), float(vector[1]), height]

    def _link(self, name: str) -> Tree:
        m, z = self.m, self.link[name]
        points = {point: self._at(at, z) for point, at in m.points(name).items()} | self.extra[name]
        if name == "ground":
            return {"points": points}
        about = float(m.inertia(name) or 0.0)
        inertia = [about / 2, about / 2, about]
        return {
            "points": points,
            "mass": m.mass(name),
            "center": self._at(m.center(name), z),
            "inertia": inertia,
        }

    def _joint(self, name: str) -> Tree:
        joint = self.m.joints[name]
        made: Callable[..., Tree] | None = getattr(self, f"_{joint.type}", None)
        if made is None:
            what = f"joint {name!r}: a {joint.type} joint has no counterpart that could be lifted"
            raise ModelError(
                what, "lift a mechanism of pins, sliders, slots, welds and gears", ("joints", name)
            )
        at = [
            self._point(link, point, name, self.joint[name])
            for link, point in zip(joint.links, joint.point_names(name), strict=True)
        ]
        yields = joint.stiffness
        stiffness = {"stiffness": yields.model_dump(mode="json", exclude_none=True)} if yields else {}
        return {"links": list(joint.links), "at": at, **stiffness, **made(name, joint)}

    def _point(self, link: str, point: str, of: str, height: float) -> str:
        """A point of the link at the height of a joint or spring: the same point, or another one beside it."""
        if height == self.link[link]:
            return point
        name = f"{point} in {of}"
        while name in self.m.points(link):
            name += "'"
        place = self.m.center(link) if point == "center" else self.m.point(link, point)
        self.extra[link][name] = self._at(place, height)
        return name

    def _pin(self, name: str, joint: Pin) -> Tree:
        kind = self.become.get(name, "revolute")
        driven = any(self.m.drive_joint(d) == name for d in self.m.drives)
        if kind == "spherical" and (driven or joint.damping):
            raise ModelError(
                f"the turn of joint {name!r} is driven or damped", "make it cylindrical", ("joints", name)
            )
        damping = {"damping": {"turn": joint.damping}} if joint.damping else {}
        axis = {} if kind == "spherical" else {"axis": UP}
        return {"type": kind, **axis, **damping, **self._friction(name, joint)}

    def _slider(self, name: str, joint: Slider) -> Tree:
        damping = {"damping": {"slide": joint.damping}} if joint.damping else {}
        axes = {"i": _axes(joint.direction), "j": _axes(-joint.angle)}
        return {"type": "prismatic", "axes": axes, **damping, **self._friction(name, joint)}

    def _slot(self, name: str, joint: Slot) -> Tree:
        damping = {k: v for k, v in zip(("slide", "turn"), joint.damping, strict=True) if v}
        # j's x too, so that the turn is 0 where the links' own axes agree, as in the plane
        axes = {"i": _axes(joint.direction), "j": _axes(joint.direction)}
        self._refuse_friction(name, joint)
        return {"type": "slotted_cylinder", "axes": axes, **({"damping": damping} if damping else {})}

    def _weld(self, name: str, joint: Weld) -> Tree:
        return {"type": "weld", "axes": {"i": _axes(joint.angle), "j": _axes(0.0)}}

    def _refuse_friction(self, name: str, joint: Slot | Gear) -> None:
        if joint.friction is not None and self.m.friction.enabled:
            what = f"friction of joint {name!r}, a {joint.type}, is not lifted"
            raise ModelError(
                what, "leave it out, or switch it off with friction: {enabled: false}", ("joints", name)
            )

    def _friction(self, name: str, joint: Pin | Slider) -> Tree:
        """Friction of a pin or of a guide without faces at a height, which have the same meaning in space."""
        if joint.friction is None or getattr(joint.friction, "radius", None) == 0:
            return {}
        if getattr(joint.friction, "half_height", None):
            what = f"the faces of guide {name!r} make a couple, which is not lifted"
            raise ModelError(what, "leave half_height out", ("joints", name, "friction", "half_height"))
        if getattr(joint.friction, "force", None):
            what = f"the constant friction of guide {name!r} is not lifted"
            raise ModelError(what, "leave force out", ("joints", name, "friction", "force"))
        return {
            "friction": joint.friction.model_dump(mode="json", exclude={"half_height"}, exclude_none=True)
        }

    def _gear(self, name: str, joint: Gear) -> Tree:
        self._refuse_friction(name, joint)
        sizes = joint.model_dump(
            mode="json", include={"radii", "teeth", "module", "pressure_angle", "internal", "efficiency"}
        )
        return {
            "type": "gear",
            "axis": UP,
            **{key: value for key, value in sizes.items() if value is not None},
        }

    def _drive(self, name: str) -> Tree:
        tree = self.m.drives[name].model_dump(mode="json")
        joint = self.m.joints[self.m.drive_joint(name)]
        return {**tree, "freedom": self.m.drives[name].freedom or joint.freedoms[0]}

    def _load(self, name: str) -> Tree:
        load: Any = self.m.loads[name]
        tree = dict(load.model_dump(mode="json"))
        if load.ON == "point":
            if load.components is not None:
                tree["value"] = [*tree["value"], 0.0]
            elif load.direction is not None:
                tree["direction"] = [math.cos(load.direction), math.sin(load.direction), 0.0]
        elif load.ON == "link":
            tree["direction"] = UP
        elif load.ON == "span":
            height = sum(self.link[link] for link, _ in load.between) / 2
            ends = ((link, self._point(link, point, name, height)) for link, point in load.between)
            tree["between"] = [".".join(end) for end in ends]
        elif load.FORCE == "spring":
            tree["free_angle"] = load.free_angle - self._turn_offset(name)
        if isinstance(tree.get("at"), (list, tuple)):
            tree["at"] = self._at(load.at, self.link[load.on])
        return tree

    def _assembly(self) -> Tree:
        """Poses of the links where the plane mechanism first closes."""
        result, k = self._closing
        return {
            link: {
                "position": self._at(result.position(link)[k], 0.0),
                "axis": UP,
                "angle": float(result.angle(link)[k]),
            }
            for link in (result.links if k >= 0 else ())
        }

    @cached_property
    def _closing(self) -> tuple[Result, int]:
        """The plane mechanism's motion, and the first position where it closes, -1 for none."""
        from dalembert.analysis.solution import kinematics

        result = kinematics(self.m)
        closed = np.flatnonzero(np.isfinite(result.point_array).all(axis=(1, 2)))
        return result, int(closed[0]) if closed.size else -1

    def _turn_offset(self, load: str) -> float:
        """Contribution of the planar mechanism's count of full turns to the angle of a torsion spring between the
        links: in space they are counted where `assembly` has the links, as their angles are written in it."""
        result, k = self._closing
        c = result.compiled
        turns = (c.forcing.resistances.turns[k, n.place] for n in c.counts if n.spring == load)
        return float(next(turns, 0.0))


def _axes(angle: float) -> dict[str, list[float]]:
    """Local x at an angle in the plane, z across it."""
    return {"x": [math.cos(angle), math.sin(angle), 0.0], "z": UP}
