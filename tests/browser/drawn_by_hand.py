"""Any plane mechanism drawn from nothing in the studio, by mouse and typed values, by someone who has its numbers."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from typing import Any

import dalembert as da
from dalembert.studio.editing.sketch_pose import sketch_pose
from tests.browser.studio_tab import Studio

Point = tuple[float, float]
End = tuple[str, str]
GROUND = "ground"
SIZES = {"length": "m", "angle": "rad", "force": "N", "moment": "N*m"}
"""Units in which exact values are typed."""
ELSEWHERE = ("type", "links", "at", "direction", "angle", "radii", "radius")


def typed(x: float, kind: str) -> str:
    """A value with its unit, all digits."""
    return f"{float(x)!r} {SIZES[kind]}"


def vector(u: Any, kind: str = "length") -> str:
    return f"[{typed(u[0], kind)}, {typed(u[1], kind)}]"


@dataclass
class Frame:
    """A link's axes as they are drawn: the drawn origin and the turn of the drawn x axis, in the link's own axes."""

    origin: Point = (0.0, 0.0)
    turn: float = 0.0

    def point(self, u: Any) -> Point:
        x, y = self.direction((u[0] - self.origin[0], u[1] - self.origin[1]))
        return x, y

    def direction(self, u: Any) -> Point:
        if self.turn == 0:
            return float(u[0]), float(u[1])
        c, s = math.cos(self.turn), math.sin(self.turn)
        return c * u[0] + s * u[1], c * u[1] - s * u[0]


@dataclass
class Draughtsman:
    """Draws the mechanism ``m`` in a studio that is empty; ``names`` are those it gets there."""

    s: Studio
    m: Any
    ends: dict[End, End] = field(default_factory=dict)
    links: dict[str, str] = field(default_factory=lambda: {GROUND: GROUND})
    joints: dict[str, str] = field(default_factory=dict)
    frames: dict[str, Frame] = field(default_factory=lambda: {GROUND: Frame()})

    def __post_init__(self) -> None:
        self.placed = {**sketch_pose(self.m, {}).placed, GROUND: (0.0, 0.0, 0.0)}
        self.tree = self.m.to_tree()
        self.parts = self.m.model_dump(by_alias=True, exclude_unset=True)
        self.points = {(link, p): u for link in self.m.links for p, u in self.m.points(link).items()}
        places = [self.place(end) for end in self.points]
        low, high = ([f(p[k] for p in places) for k in (0, 1)] for f in (min, max))
        self.size = max(high[0] - low[0], high[1] - low[1]) or 0.1
        self.middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2)

    def place(self, end: End) -> Point:
        """Where a point is at the first position."""
        x, y, angle = self.placed[end[0]]
        u, v = self.points[end]
        return x + u * math.cos(angle) - v * math.sin(angle), y + u * math.sin(angle) + v * math.cos(angle)

    def draw(self) -> None:
        self.s.see(*self.middle, 330 / self.size)
        self.surroundings()
        for end in (e for e in self.points if e[0] == GROUND):
            self.ground(end)
        todo = [link for link in self.m.links if link != GROUND]
        while todo:
            done = next((x for x in todo if self.hold(x)), todo[0])
            todo.remove(done)
            self.link(done)
        for name in self.m.joints:
            if name not in self.joints:
                self.joint(name)
        for name in self.m.joints:
            self.joint_values(name)
        for link in self.m.links:
            self.mass(link)
        for name in self.m.drives:
            self.drive(name)
        for name in self.m.loads:
            self.load(name)

    # what is there

    def new(self, what: str, before: Any) -> list[str]:
        """Names of links, joints, loads or drives that were not there before."""
        known = {x["name"] for x in before[what]}
        return [x["name"] for x in self.s.drawing()[what] if x["name"] not in known]

    def aim(self, end: End, button: bool = False) -> None:
        """The mouse at a point; of several at one place, Page Down goes on to the one that is meant."""
        link, point = self.ends[end]
        at = self.s.point(link, point)
        self.s.page.mouse.move(*self.s.pixel(*at))
        here = [
            (x["name"], p)
            for x in self.s.drawing()["links"]
            for p, q in x["points"].items()
            if math.dist(q, at) * 330 / self.size < 1
        ]
        if here and here[0] != (link, point):
            for _ in range(40):
                self.s.page.keyboard.press("PageDown")
                if self.s.page.evaluate("[studio.hand.cursor.end?.link, studio.hand.cursor.end?.point]") == [
                    link,
                    point,
                ]:
                    return
            raise AssertionError((link, point))

    def tool(self, key: str) -> None:
        self.s.page.keyboard.press("Escape")
        self.s.page.keyboard.press(key)

    def click(self, end: End) -> None:
        self.aim(end)
        self.s.page.mouse.click(*self.s.pixel(*self.s.point(*self.ends[end])))

    def drag(self, key: str, first: End, second: End) -> None:
        """A joint from a point to a point; where only they lie at one place, one click joins them."""

        def act() -> None:
            self.click(first)
            if self.s.page.evaluate("studio.canvas.preview.childElementCount"):
                self.click(second)

        self.tool(key)
        self.s.changes(act)

    def values(self, kind: str, name: str, values: dict[str, str]) -> None:
        """Values typed under Part, of a part chosen in its list."""
        if not values:
            return
        page = self.s.page
        self.s.choose(kind, name)
        for key, value in values.items():
            box = page.locator(f".pane.part input[aria-label='{key}']")
            if not box.count():
                self.s.until(f"document.querySelector('.pane.part select option[value={key}]')")
                page.locator(f".pane.part select:has(option[value={key}])").select_option(key)
            if box.input_value() != value:
                box.fill(value)
                self.s.changes(lambda box=box: box.press("Enter"))  # type: ignore[misc]

    # links

    def ground(self, end: End) -> None:
        self.tool("x")
        before = set(self.s.drawing()["links"][0]["points"])
        for k, x in enumerate(self.points[end]):
            if k:
                self.s.page.keyboard.press("Tab")
            self.s.page.keyboard.type(typed(x, "length"))
        self.s.changes(lambda: self.s.page.keyboard.press("Enter"))
        (name,) = set(self.s.drawing()["links"][0]["points"]) - before
        self.ends[end] = GROUND, name

    def holds(self, link: str) -> list[tuple[End, End]]:
        """Points of a link that pins join to some that are drawn, and those."""
        pairs = []
        for name, joint in self.m.joints.items():
            if joint.type == "pin" and link in joint.links:
                k = joint.links.index(link)
                own, other = ((joint.links[i], joint.point_names(name)[i]) for i in (k, 1 - k))
                pairs += [(own, other)] if other in self.ends else []
        return pairs

    def hold(self, link: str) -> tuple[End, End] | None:
        return next(iter(self.holds(link)), None)

    def link(self, link: str) -> None:
        held = self.hold(link)
        own = [end for end in self.points if end[0] == link]
        first = held[0] if held else own[0]
        if self.block(link, held):
            return
        others = [e for e in own if math.dist(self.points[e], self.points[first]) > 1e-9 * self.size]
        a = self.points[first]
        others.sort(key=lambda e: abs(self.points[e][1] - a[1]) > 0 or self.points[e][0] < a[0])
        second = others[0] if others else None
        b = self.points[second] if second else (a[0] + 0.15 * self.size, a[1])
        turn = 0.0 if b[1] == a[1] and b[0] > a[0] else math.atan2(b[1] - a[1], b[0] - a[0])
        self.frames[link] = Frame((float(a[0]), float(a[1])), turn)
        closes = next((pair[1] for pair in self.holds(link) if pair[0] == second), None)
        self.bar(
            link, first, second, (held and held[1], closes), math.dist(a, b), self.placed[link][2] + turn
        )
        for end in own:
            if end not in self.ends:
                self.point(end)

    def bar(self, link: str, first: End, second: End | None, to: Any, long: float, angle: float) -> None:
        """A bar from what it is pinned to, or from a free place; its far end too may be pinned."""
        s, before, (start, close) = self.s, self.s.drawing(), to
        self.tool("b")
        if start:
            self.click(start)
        at = self.place(first)
        s.page.keyboard.down("Control")  # no snapping: what is typed counts
        if not start:
            s.page.mouse.click(*s.pixel(*at))
        if not close:
            s.page.mouse.move(*s.pixel(at[0] + long * math.cos(angle), at[1] + long * math.sin(angle)))
        s.page.keyboard.up("Control")
        if close:
            self.aim(close)
        s.page.keyboard.type(typed(long, "length"))
        s.page.keyboard.press("Tab")
        s.page.keyboard.type(f"{math.degrees(angle):.9f}")
        s.changes(lambda: s.page.keyboard.press("Enter"))
        (name,) = self.new("links", before)
        self.links[link] = name
        points = list(next(x for x in self.s.drawing()["links"] if x["name"] == name)["points"])
        self.ends[first] = name, points[0]
        if second:
            self.ends[second] = name, points[1]
        at_links = {frozenset(x["links"]): x["name"] for x in self.s.drawing()["joints"]}
        for own, other in ((first, start), (second, close)):
            if other and own:
                self.joints[self.joint_of(own, other)] = at_links[frozenset((name, self.ends[other][0]))]

    def joint_of(self, *ends: End) -> str:
        return next(
            name
            for name, j in self.m.joints.items()
            if {*zip(j.links, j.point_names(name), strict=True)} == set(ends) and j.type in ("pin", "weld")
        )

    def point(self, end: End) -> None:
        """One more point of a link, by typed coordinates and a click on the link's first bar."""
        s, name = self.s, self.links[end[0]]
        before = set(next(x for x in self.s.drawing()["links"] if x["name"] == name)["points"])
        s.choose("links", name)
        self.tool("p")
        for k, x in enumerate(self.frames[end[0]].point(self.points[end])):
            if k:
                s.page.keyboard.press("Tab")
            s.page.keyboard.type(typed(x, "length"))
        s.changes(lambda: s.page.keyboard.press("Enter"))
        (new,) = set(next(x for x in self.s.drawing()["links"] if x["name"] == name)["points"]) - before
        self.ends[end] = name, new

    def block(self, link: str, held: Any) -> bool:
        """The block that the slider tool makes: a link of one point, pinned to and sliding on links that are drawn."""
        own = [e for e in self.points if e[0] == link]
        mine = [n for n, j in self.m.joints.items() if link in j.links]
        slides = [n for n in mine if self.m.joints[n].type == "slider"]
        guide = self.m.joints[slides[0]].links[0] if slides else ""
        if (
            not held
            or len(own) > 1
            or len(mine) != 2
            or not slides
            or guide not in self.links
            or guide == link
        ):
            return False
        before = self.s.drawing()
        self.frames[link] = Frame()
        self.guided(slides[0], held[1], "s")
        (self.links[link],) = self.new("links", before)
        self.ends[own[0]] = self.links[link], self.ends[held[1]][1]
        joints = {x["name"]: x["type"] for x in self.s.drawing()["joints"]}
        for name in self.new("joints", before):
            self.joints[slides[0] if joints[name] == "slider" else self.joint_of(own[0], held[1])] = name
        return True

    # joints

    def joint(self, name: str) -> None:
        joint = self.m.joints[name]
        first, second = zip(joint.links, joint.point_names(name), strict=True)
        before = self.s.drawing()
        if joint.type in ("pin", "weld"):
            self.drag({"pin": "i", "weld": "w"}[joint.type], first, second)
        elif joint.type in ("slider", "slot"):
            self.guided(name, second, "l" if joint.type == "slider" else "o")
        else:
            key = {"gear": "g", "belt": "e", "circular_slot": "a", "rolling": "r", "cam": "j"}[joint.type]
            self.drag(key, *((second, first) if key in "ar" else (first, second)))
        (self.joints[name],) = self.new("joints", before)

    def guided(self, name: str, end: End, key: str) -> None:
        """A slider or slot drawn from a point; the guide's point and direction are then typed."""
        s, joint = self.s, self.m.joints[name]
        guide, path = joint.links[0], joint.point_names(name)[0]
        drawn = self.links[guide]
        points = next(x for x in self.s.drawing()["links"] if x["name"] == drawn)["points"]
        if guide != GROUND and len(points) == 2 and not self.along(name):
            self.extra(guide)
        known = set(points)
        self.tool(key)
        self.aim(end)
        s.page.mouse.click(*s.pixel(*s.point(*self.ends[end])))
        angle = self.placed[guide][2] + joint.direction
        if guide != GROUND:
            self.aim((guide, path))
        s.page.keyboard.type(f"{math.degrees(angle):.9f}")
        s.changes(lambda: s.page.keyboard.press("Enter"))
        new = [
            p
            for p in next(x for x in self.s.drawing()["links"] if x["name"] == drawn)["points"]
            if p not in known
        ]
        for p in new:
            s.place(drawn, p, vector(self.frames[guide].point(self.points[guide, path])))

    def along(self, name: str) -> bool:
        """True if a bar's own line is the guide: its first point and its own direction."""
        joint = self.m.joints[name]
        guide, path = joint.links[0], joint.point_names(name)[0]
        u, turn = (
            self.frames[guide].point(self.points[guide, path]),
            joint.direction - self.frames[guide].turn,
        )
        return math.hypot(*u) < 1e-12 and abs(math.remainder(turn, 2 * math.pi)) < 1e-12

    def extra(self, link: str) -> None:
        """A third point, with which a link is no bar."""
        s = self.s
        s.choose("links", self.links[link])
        self.tool("p")
        s.page.keyboard.type("0.01 m")
        s.page.keyboard.press("Tab")
        s.page.keyboard.type(typed(0.1 * self.size, "length"))
        s.changes(lambda: s.page.keyboard.press("Enter"))

    def joint_values(self, name: str) -> None:
        joint, part = self.m.joints[name], self.tree["joints"][name]
        i, j = (self.frames[link] for link in joint.links)
        values: dict[str, str] = {}
        if joint.type in ("slider", "slot", "rolling"):
            turn = math.remainder(joint.direction - i.turn, 2 * math.pi)
            if joint.type != "rolling" or joint.radii is None:
                values["direction"] = typed(turn, "angle")
        if joint.type == "slider":
            values["angle"] = typed(math.remainder(joint.angle + j.turn, 2 * math.pi), "angle")
        if joint.type == "weld":
            values["angle"] = typed(math.remainder(joint.angle - i.turn + j.turn, 2 * math.pi), "angle")
        if getattr(joint, "radii", None):
            values["radii"] = vector(joint.radii)
        if isinstance(getattr(joint, "radius", None), float):
            values["radius"] = typed(joint.radius, "length")
        values |= {key: flow(x) for key, x in part.items() if key not in ELSEWHERE and x is not None}
        if "friction" in values and joint.type == "belt":
            values["friction"] = flow({"coefficient": float(joint.grip.coefficient)})
        for key, unit in (("tension", "N"), ("mass_per_length", "kg/m"), ("efficiency", "")):
            if key in values:  # a parameter's number
                values[key] = f"{float(getattr(joint, key))!r} {unit}".strip()
        zero = [key for key in ("direction", "angle") if values.get(key) in ("0.0 rad", "-0.0 rad")]
        written = next(x for x in self.s.drawing()["joints"] if x["name"] == self.joints[name])["written"]
        self.values(
            "joints", self.joints[name], {k: x for k, x in values.items() if k not in zero or k in written}
        )

    # the rest

    def mass(self, link: str) -> None:
        if link == GROUND or not self.m.mass(link):
            return
        values = {"mass": f"{float(self.m.mass(link))!r} kg"}
        center = self.frames[link].point(self.m.center(link))
        if center != (0.0, 0.0):
            values["center"] = vector(center)
        if self.m.links[link].inertia:
            values["inertia"] = f"{float(self.m.inertia(link))!r} kg*m^2"
        self.values("links", self.links[link], values)

    def surroundings(self) -> None:
        """Gravity, and what stands in the text alone."""
        s, g = self.s, self.m.gravity
        if g is not None:
            s.choose("", "")
            box = s.page.locator(".pane.part input[aria-label=gravity]")
            box.fill(g if isinstance(g, str) else f"[{float(g[0])!r} m/s^2, {float(g[1])!r} m/s^2]")
            s.changes(lambda: box.press("Enter"))
        if self.tree.get("friction"):
            s.write(f"\nfriction: {flow(self.tree['friction'])}\n")

    def drive(self, name: str) -> None:
        s, part, joint = self.s, self.parts["drives"][name], self.m.drive_joint(name)
        freedom = self.m.drives[name].freedom
        i, j = (self.frames[link] for link in self.m.joints[joint].links)
        kind, off = ("angle", j.turn - i.turn) if freedom == "turn" else ("length", 0.0)
        drawn = self.joints[joint]
        s.choose("joints", drawn)
        s.page.keyboard.press("Escape")
        several = len(self.m.joints[joint].freedoms) > 1
        drives = f"Drive its {freedom}" if several else "Drive it"
        s.changes(lambda: s.page.click(f".pane.part button:text-is('{drives}')"))
        values = {"position": positions(part["position"], kind, off)}
        for key, unit in (("speed", "/s"), ("acceleration", "/s^2")):
            if part.get(key):
                values[key] = each(part[key], SIZES[kind] + unit)
        if part.get("effort") is not None:
            values["effort"] = typed(part["effort"], "moment" if freedom == "turn" else "force")
        self.values("drives", drawn, values)

    def load(self, name: str) -> None:
        s, load, part = self.s, self.m.loads[name], self.parts["loads"][name]
        before, value = self.s.drawing(), part.get("value")
        values: dict[str, str] = {}
        if load.type == "couple":
            s.choose("links", self.links[load.on])
            self.tool("m")
            s.page.keyboard.type(typed(value, "moment"))
            s.changes(lambda: s.page.keyboard.press("Enter"))
        elif load.type == "force":
            end = (load.on, load.at)
            self.tool("f")
            self.aim(end)
            s.page.mouse.click(*s.pixel(*s.point(*self.ends[end])))
            turn = self.frames[load.on].turn if part.get("axes") == "link" else 0.0
            s.page.keyboard.type("100" if isinstance(value, tuple) else "100 N")
            s.changes(lambda: s.page.keyboard.press("Enter"))
            if isinstance(value, tuple):
                values["value"] = vector(Frame(turn=turn).direction(value), "force")
            else:
                values["direction"] = typed(part["direction"] - turn, "angle")
                values["value"] = value if isinstance(value, str) else self.table(name, value)
            values |= {key: self.links.get(part[key], part[key]) for key in ("axes", "by") if key in part}
        else:
            a, b = self.m.load_points(name)
            ends = [
                next(e for e, u in self.points.items() if e[0] == one[0] and u == one[1]) for one in (a, b)
            ]
            self.span({"spring": "k", "damper": "n"}[load.type], ends)
            values = {
                k: flow(x) for k, x in self.tree["loads"][name].items() if k not in ("type", "between") and x
            }
        (new,) = self.new("loads", before)
        self.values("loads", new, values)

    def table(self, name: str, value: Any) -> str:
        """A force of one number, or by a table over a drive's turn."""
        if not isinstance(value, dict):
            return typed(value, "force")
        written = dict(self.tree["loads"][name]["value"])
        against = self.joints[self.m.drive_joint(written.pop("against"))]
        columns = f"against: {against}, x: {each(value['x'], 'rad')}, y: {each(value['y'], 'N')}"
        more = "".join(f", {key}: {flow(x)}" for key, x in written.items() if key not in ("x", "y"))
        return "{" + columns + more + "}"

    def span(self, key: str, ends: list[End]) -> None:
        s = self.s
        self.tool(key)
        for k, end in enumerate(ends):
            self.aim(end)
            at = s.pixel(*s.point(*self.ends[end]))
            if k == 0:
                s.page.mouse.click(*at)
            else:
                s.changes(lambda at=at: s.page.mouse.click(*at))  # type: ignore[misc]


def flow(x: object) -> str:
    """A value as one types it in a field."""
    return x if isinstance(x, str) else json.dumps(x)


def each(x: Any, unit: str) -> str:
    """A number or a list of them with a unit."""
    return (
        f"[{', '.join(each(one, unit) for one in x)}]"
        if isinstance(x, (list, tuple))
        else f"{float(x)!r} {unit}"
    )


def positions(x: Any, kind: str, off: float) -> str:
    if isinstance(x, (int, float)):
        return typed(x + off, kind)
    if isinstance(x, dict):
        return f"{{from: {typed(x['start'] + off, kind)}, to: {typed(x['stop'] + off, kind)}, count: {x['count']}}}"
    return each([one + off for one in x], SIZES[kind])


def answers(m: Any) -> list[float]:
    """Every effort that is not given and every unknown load over the positions, in the order of the file."""
    r = da.dynamics(m)
    found = [r.effort(drive) for drive, part in m.drives.items()]
    found += [
        r.unknown_load(name) for name, load in m.loads.items() if getattr(load, "value", 0) == "unknown"
    ]
    return [float(x) for array in found for x in array.ravel()]
