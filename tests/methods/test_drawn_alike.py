"""A mechanism turned by half a turn, mirrored or in larger units is drawn turned, mirrored, the same."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from copy import deepcopy
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

import dalembert as da
from dalembert.views.paper import lettering
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arc, Arrow, Circle, Group, Item, Line, Polygon, Scene, Text
from tests.methods.space_machines import MACHINES
from tests.methods.test_solid_models import File

UNEVEN = ("support", "ground", "hatch")
"""What stands below a place, however the rest is turned."""

ONE_SIDED = ("spring", "center-dark")
"""Symbols that are not their own mirror images."""

CLIPPED = ("construction", "line-of-action", "faint")
"""Lines without ends of their own, drawn as far as the rest reaches."""

PREFERRED = "preferred"
"""A label's direction."""


class Seen:
    """How a mechanism is seen: turned by half a turn, mirrored, or in another unit of length or force."""

    def __init__(self, turn: bool = False, mirror: bool = False, uneven: tuple[str, ...] = ()) -> None:
        self.uneven = uneven or (*UNEVEN, *(ONE_SIDED if mirror else ()))
        self.across = -1.0 if turn else 1.0
        self.up = self.across * (-1.0 if mirror else 1.0)
        self.half, self.sign = (180.0 if turn else 0.0), (-1.0 if mirror else 1.0)

    def place(self, x: float, y: float) -> list[float]:
        """A vector in ground axes."""
        return [self.across * x, self.up * y]

    def own(self, x: float, y: float) -> list[float]:
        """A vector in a link's axes."""
        return [x, self.sign * y]

    def direction(self, degrees: float) -> float:
        """An angle from a direction of the ground."""
        return self.sign * degrees + self.half


def plane_machine(s: Seen, friction: bool = False, **units: str) -> Any:
    """A slider-crank that drives a slotted arm and, by wheels, a pinion, with every load there is."""
    own, place = s.own, s.place
    rub: dict[str, Any] = {"friction": {"coefficient": 0.15, "radius": 0.03}} if friction else {}
    slide = {"friction": {"coefficient": 0.1, "guide": [0.05, 0.05]}} if friction else {}
    return da.mechanism(
        {
            "units": {"angle": "deg"} | units,
            "gravity": place(0.7, -9.6),
            "links": {
                "ground": {
                    "points": {
                        "O": place(0.01, 0.02),
                        "P": place(0.12, -0.25),
                        "S": place(-0.1, 0.25),
                        "V": place(-0.16, 0.02),
                    }
                },
                "crank": {
                    "points": {"O": own(0, 0), "A": own(0.12, 0.01)},
                    "mass": 2,
                    "center": own(0.04, 0.015),
                    "inertia": 0.01,
                },
                "rod": {
                    "points": {"A": own(0, 0), "B": own(0.4, 0.02), "C": own(0.15, 0.1)},
                    "mass": 3,
                    "center": own(0.2, 0.03),
                    "inertia": 0.05,
                },
                "block": {
                    "points": {"B": own(0, 0), "D": own(0.06, 0.03)},
                    "mass": 1,
                    "center": own(0.01, 0.02),
                },
                "arm": {
                    "points": {"P": own(0, 0), "E": own(0.2, 0.03)},
                    "mass": 1.5,
                    "center": own(0.1, 0.01),
                    "inertia": 0.02,
                },
                "pinion": {"points": {"V": own(0, 0)}, "mass": 0.5, "inertia": 0.001},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "crank"], **rub},
                "A": {"type": "pin", "links": ["crank", "rod"], **rub},
                "B": {"type": "pin", "links": ["rod", "block"]},
                "guide": {
                    "type": "slider",
                    "links": ["ground", "block"],
                    "at": ["O", "B"],
                    "direction": s.direction(10),
                    **slide,
                },
                "P": {"type": "pin", "links": ["ground", "arm"]},
                "C": {"type": "slot", "links": ["arm", "rod"], "at": ["P", "C"]},
                "V": {"type": "pin", "links": ["ground", "pinion"]},
                "mesh": {
                    "type": "gear",
                    "links": ["crank", "pinion"],
                    "at": ["O", "V"],
                    "radii": [0.1, 0.07],
                    "pressure_angle": 20 if friction else 0,
                },
            },
            "drives": {
                "O": {
                    "position": s.direction(50),
                    "speed": f"{s.sign * 6} rad/s",
                    "acceleration": f"{s.sign * 20} rad/s^2",
                }
            },
            "loads": {
                "F": {"type": "force", "on": "rod", "at": "C", "value": place(-80, -35)},
                "H": {"type": "force", "on": "arm", "at": "E", "value": own(-20, 15), "axes": "link"},
                "T": {"type": "couple", "on": "pinion", "value": s.sign * 9},
                "K": {
                    "type": "spring",
                    "between": ["ground.S", "rod.C"],
                    "stiffness": 300,
                    "free_length": 0.1,
                },
                "Z": {"type": "damper", "between": ["ground.S", "block.D"], "damping": 40},
            },
            "assembly": {"rod": s.direction(-10), "arm": s.direction(95), "pinion": s.direction(0)},
        }
    )


Signature = tuple[str, str, str]
"""Kind of primitive, role and name."""


def geometry(scene: Scene, s: Seen) -> dict[Signature, list[Any]]:
    """The numbers of all strokes about their middle, as they would stand in a drawing of the machine as it is."""
    items = [i for i in scene.flat() if i.role not in s.uneven and getattr(i, "anchor", LABEL) == LABEL]
    straight = [
        p
        for i in items
        if not isinstance(i, (Arc, Text)) and i.role not in (*CLIPPED, PREFERRED)
        for p in places(i)
    ]
    middle = np.add(np.min(straight, axis=0), np.max(straight, axis=0)) / 2
    out: dict[Signature, list[Any]] = {}
    for i in items:
        numbers = (np.array(places(i)) - middle) * (s.across, s.up)
        if isinstance(i, (Line, Polygon)):
            numbers = np.array(sorted(numbers.round(6).tolist()))
        if i.role in CLIPPED and len(numbers) == 2 and math.dist(*numbers) > 1e-6:
            numbers = np.array(infinite(*numbers))
        if isinstance(i, (Circle, Arc)):
            numbers = np.append(numbers, i.radius)
        if isinstance(i, Arc):
            numbers = np.append(numbers, s.sign * (i.end - i.start))
        out.setdefault(
            (type(i).__name__, i.role, getattr(i, "of", getattr(i, "text", "").replace("−", ""))), []
        ).append(numbers.ravel())
    return out


def infinite(a: Any, b: Any) -> tuple[float, float, float]:
    """A line without ends: twice its angle, by cosine and sine, and its distance from the middle."""
    (x, y), length = np.subtract(b, a), math.dist(a, b)
    return (x * x - y * y) / length**2, 2 * x * y / length**2, abs(a[0] * b[1] - a[1] * b[0]) / length


def places(item: Item) -> Any:
    """Where a primitive is; of an arc only its centre, as it goes round where there is room."""
    if isinstance(item, (Circle, Arc, Text)):
        return [item.at if isinstance(item, Text) else item.center]
    return [item.tail, item.head] if isinstance(item, Arrow) else item.points


def same(a: dict[Signature, list[Any]], b: dict[Signature, list[Any]]) -> None:
    """Fails with what stands in one of two drawings only."""
    apart: list[Any] = []
    for key in a.keys() | b.keys():
        left = list(b.get(key, []))
        for numbers in a.get(key, []):
            near = [
                k for k, n in enumerate(left) if n.shape == numbers.shape and abs(n - numbers).max() < 2e-3
            ]
            apart += [] if near else [(key, numbers)]
            left = [n for k, n in enumerate(left) if [k] != near[:1]]
        apart += [(key, numbers, "otherwise") for numbers in left]
    assert apart == []


def panels(scene: Scene) -> Iterator[Scene]:
    """A drawing's parts, each about its own middle."""
    groups = [i for i in scene.items if isinstance(i, Group)]
    for group in groups:
        yield from panels(Scene(group.items, group.name))
    if not groups:
        yield scene


LABEL = "label"
"""How texts are anchored that would stand where there is room."""


@pytest.fixture(autouse=True)
def labels_in_the_middle(monkeypatch: pytest.MonkeyPatch) -> None:
    """Labels stand amid the places that they belong to, with a line in the direction that they prefer."""

    def label(self: Canvas, text: str, *near: Any, prefer: float | None = None, **more: Any) -> None:
        x, y = np.mean(near, axis=0)
        self.add(Text((x, y), text, anchor=LABEL))
        if prefer is not None and " = 0 " not in text:
            self.add(Line(((x, y), (x + math.cos(prefer), y + math.sin(prefer))), PREFERRED))

    monkeypatch.setattr(Canvas, "label", label)
    monkeypatch.setattr(lettering, "_extent", lambda text: (float(len(text)), 0.56))
    monkeypatch.setattr(Text, "box", property(lambda self: (*self.at, *self.at)))


def views(r: Any) -> Iterator[Scene]:
    """Drawings of the plane at one position, all but that of the chain, whose polygons stand one below the other."""
    d = da.draw
    yield from (
        d.mechanism(r, forces=True),
        d.velocity_polygon(r),
        d.acceleration_polygon(r),
        d.instant_centers(r),
    )
    for link in r.links:
        yield d.free_body(r, link)
    for link in ("rod", "block"):
        yield from (
            f(r, link) for f in (d.components, d.force_polygon, d.lines_of_action, d.displaced_inertia)
        )


@pytest.mark.parametrize("s", [Seen(turn=True), Seen(mirror=True)], ids=["turned", "mirrored"])
def test_a_plane_machine_turned_or_mirrored(s: Seen) -> None:
    first, other = (da.dynamics(plane_machine(x, friction=True)) for x in (Seen(), s))
    for scene, again in zip(views(first), views(other), strict=True):
        for a, b in zip(panels(scene), panels(again), strict=True):
            same(geometry(a, Seen(uneven=s.uneven)), geometry(b, s))


SMALL, LARGE = {"length": "mm", "force": "mN"}, {"length": "km", "force": "kN"}
"""Kilograms and seconds are of one system with each of them."""


def words(scene: Scene) -> list[str]:
    """All words, as with small units."""
    some = " ".join(t.text.replace("km", "mm").replace("kN", "mN") for t in scene.texts())
    return re.sub(r"closure gap \S+", "", some).split()


def strokes(scene: Scene) -> Any:
    """Where strokes and labels are."""
    return np.array([p for i in scene.flat() if getattr(i, "anchor", LABEL) == LABEL for p in places(i)])


def test_a_plane_machine_in_larger_units() -> None:
    """The same numbers in units of which one is a million of another make the same drawings."""
    first, other = (da.dynamics(plane_machine(Seen(), friction=True, **units)) for units in (SMALL, LARGE))
    for scene, again in zip(views(first), views(other), strict=True):
        assert words(again) == words(scene)
        assert strokes(again) == pytest.approx(strokes(scene), abs=1e-6)


def space_machine(name: str, units: dict[str, str]) -> Any:
    """One of the machines in space with its bare numbers in other units; gravity as a number."""
    tree = MACHINES[name] | {
        "units": units,
        "gravity": [0, 0, -9810] if "gravity" in MACHINES[name] else "none",
    }
    return da.dynamics(da.mechanism(deepcopy(tree)))


def space_views(r: Any) -> Iterator[Scene]:
    yield da.draw.mechanism(r, at=3, forces=True)
    yield da.draw.charts(r)
    yield from (da.draw.free_body(r, link, at=3) for link in r.links)


@pytest.mark.parametrize("name", ["rssr", "shaft"])
def test_a_machine_in_space_in_larger_units(name: str) -> None:
    first, other = (space_machine(name, units) for units in (SMALL, LARGE))
    for scene, again in zip(space_views(first), space_views(other), strict=True):
        assert words(again) == words(scene)
        a, b = strokes(scene), strokes(again)  # what is equally far may come in another order
        assert max(cKDTree(a).query(b)[0].max(), cKDTree(b).query(a)[0].max()) < 1e-6
    files = [File(da.draw.solid_model(r).to_glb()) for r in (first, other)]
    meshes = [[p for m in f.tree["meshes"] for p in m["primitives"]] for f in files]
    for a, b in zip(*meshes, strict=True):
        small, large = (f.values(p["attributes"]["POSITION"]) for f, p in zip(files, (a, b), strict=True))
        assert large / 1e6 == pytest.approx(small, abs=1e-6 * float(np.abs(small).max()))
