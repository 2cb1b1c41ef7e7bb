"""Every problem with one thing wrong, beside the same made by hand: other data solved anew, or virtual work."""

from __future__ import annotations

import math
from collections import defaultdict
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.grading.wrong.misread_geometry import misread_geometry
from dalembert.grading.wrong.wrong_problems import WrongProblems
from tests.grading.test_fair_marks import MODEL

MORE = MODEL.replace(
    "  T_4:", "  Q: {type: force, on: rocker, at: B, value: 300 @ 200}\n  T_4:"
).replace("center: [50, 0]", "center: [50, 15]")  # fmt: skip
BINARY = {"crank": "O2 A", "coupler": "A B", "rocker": "B O4"}  # near and far, in the order of the joints
LENGTHS = {"halved: stroke for crank": 0.5, "doubled: crank for stroke": 2.0}
LENGTHS |= {"ten times too small": 0.1, "ten times too large": 10.0}
FACTORS = {"is ten times too large": 10.0, "is ten times too small": 0.1}
MORE_FACTORS = FACTORS | {
    "has an area with the diameter as radius, or pi d^2": 4.0, "has an area too small by 4": 0.25,
    "is too large by 1000": 1e3, "is too small by 1000": 1e-3,
}  # fmt: skip
AT = {"F": "P", "Q": "B"}
FORCES = {
    name: size * np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    for name, size, angle in (("F", 800.0, 330), ("Q", 300.0, 200))
}
Efforts = dict[str, list[float]]


def across(v: Any) -> Any:
    return np.array([-v[1], v[0]])


def cross(a: Any, b: Any) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


class ByHand:
    """Efforts of the mistakes of a four-bar, by sentence."""

    def __init__(self, m: da.Mechanism) -> None:
        self.m, self.r = m, da.dynamics(m)
        self.effort, self.speed = float(self.r.effort("O2")[0]), float(self.r.drive_speed("O2")[0])
        self.out: Efforts = defaultdict(list)

    def anew(self, words: str, values: dict[str, Any]) -> None:
        """Of the machine with other data; NaN where it cannot be assembled."""
        self.out[words].append(float(da.dynamics(self.m.with_values(values)).effort("O2")[0]))

    def adds(self, words: str, *some: tuple[str, Any, Any, float]) -> None:
        """By virtual work of what acts besides: link, force, its place, couple."""
        power = sum(
            float(np.dot(f, self.velocity(link, at))) + couple * self.turn(link, "speed")
            for link, f, at, couple in some
        )
        self.out[words].append(self.effort - power / self.speed)

    def turn(self, link: str, what: str) -> float:
        return float(self.r[f"angle.{link}.{what}"][0])

    def place(self, link: str, point: str) -> Any:
        return self.r[f"point.{link}.{point}"][0]

    def velocity(self, link: str, at: Any) -> Any:
        away = np.subtract(at, self.place(link, "center"))
        return self.r[f"point.{link}.center.velocity"][0] + self.turn(link, "speed") * across(away)

    def acceleration(self, link: str) -> Any:
        return self.r[f"point.{link}.center.acceleration"][0]

    def inertia(self, link: str) -> tuple[str, Any, Any, float]:
        a, turning = self.acceleration(link), self.turn(link, "acceleration")
        at = self.place(link, "center")
        return link, -self.m.mass(link) * a, at, -self.m.inertia(link) * turning

    # the mistakes

    def data(self) -> None:
        gravity = np.array(self.m.gravity_vector)
        if not gravity.any():
            self.anew("gravity is counted, and the problem has none", {"gravity": "standard"})
        for name, acts in (("F", "coupler"), ("Q", "rocker")):
            for point in [*self.m.points(acts), "center"]:
                if point != AT[name]:
                    words = f"the moment arm of {name} is wrong: the load is applied at {point}"
                    self.anew(words, {f"loads.{name}.at": point})
            self.anew(f"the direction of {name} is counted in link axes", {f"loads.{name}.axes": "link"})
            x, y = FORCES[name]
            slips = {"from the other axis": (y, x), "clockwise": (x, -y), "from the negative x axis": (-x, y)}
            for slip, value in slips.items():
                self.anew(f"the angle of {name} is counted {slip}", {f"loads.{name}.value": value})
        speed, acceleration = self.speed, float(self.r.drive_acceleration("O2")[0])
        for words, part in {"is left out": 0.0, "has the wrong sense": -1.0}.items():
            self.anew(
                f"the acceleration of drive O2 {words}", {"drives.O2.acceleration": part * acceleration}
            )
        for words, value in {
            ": rad/s mistaken for rpm": speed * 30 / math.pi,
            ": rpm mistaken for rad/s": speed * math.pi / 30,
            ": rpm only divided by 60, revolutions per second mistaken for rad/s": speed / (2 * math.pi),
            " is left out": 0.0,
        }.items():
            self.anew(f"the speed of drive O2{words}", {"drives.O2.speed": value})
        for g in (9.81, 9.8, 10.0) if gravity.any() else ():
            words = f"g is taken as {g:g} m/s^2, not 9.80665 m/s^2"
            self.anew(words, {"gravity": (gravity / np.hypot(*gravity) * g).tolist()})
        self.anew("this is the other assembly mode", {"assembly": {"coupler": -1.2, "rocker": -1.6}})

    def links(self) -> None:
        m = self.m
        for link in BINARY:
            center, points = np.array(m.center(link)), m.points(link)
            for name, p in points.items():
                about = m.inertia(link) + m.mass(link) * float(np.hypot(*(p - center))) ** 2
                words = f"the moment of inertia of {link} is taken about {name}, not its mass centre"
                self.anew(words, {f"links.{link}.inertia": about})
                self.anew(f"the mass centre of {link} is placed at {name}", {f"links.{link}.center": p})
            if center[1]:
                moved = {f"links.{link}.center": (center[0], -center[1])}
                self.anew(f"the mass centre of {link} is on the wrong side of it", moved)
                moved = {f"links.{link}.center": (float(np.hypot(*center)), 0.0)}
                self.anew(f"the angle of the mass centre of {link} is left out", moved)
            for words, factor in FACTORS.items():
                mass, inertia = (factor * float(x) for x in (m.mass(link), m.inertia(link)))
                self.anew(f"the mass of {link} {words}", {f"links.{link}.mass": mass})
                self.anew(f"the moment of inertia of {link} {words}", {f"links.{link}.inertia": inertia})
            self.adds(
                f"only the inertia of {link} is counted",
                *((k, -f, at, -c) for k, f, at, c in map(self.inertia, set(BINARY) - {link})),
            )
        for one, two in combinations(BINARY, 2):
            for words, of, key in (("masses", m.mass, "mass"), ("moments of inertia", m.inertia, "inertia")):
                values = {f"links.{one}.{key}": of(two), f"links.{two}.{key}": of(one)}
                self.anew(f"the {words} of {one} and {two} are exchanged", values)

    def loads(self) -> None:
        couple = float(self.m.loads["T_4"].value)
        for words, factor in MORE_FACTORS.items():
            for name in ("F", "Q"):
                self.anew(f"load {name} {words}", {f"loads.{name}.value": tuple(factor * FORCES[name])})
            self.anew(f"load T_4 {words}", {"loads.T_4.value": factor * couple})
        for name, f in FORCES.items():
            self.anew(f"the x component of {name} is left out", {f"loads.{name}.value": (0.0, f[1])})
            self.anew(f"the y component of {name} is left out", {f"loads.{name}.value": (f[0], 0.0)})
            angle, size = math.degrees(math.atan2(f[1], f[0])) % 360, float(np.hypot(*f))
            value = {f"loads.{name}.value": (size * math.cos(angle), size * math.sin(angle))}
            self.anew(f"the direction of {name}: degrees are mistaken for radians", value)
        both = {"loads.F.value": tuple(FORCES["Q"]), "loads.Q.value": tuple(FORCES["F"])}
        self.anew("loads F and Q are exchanged", both)
        axes = {"loads.F.axes": "link", "loads.Q.axes": "link"}
        self.anew("the directions of all loads are counted in link axes", axes)

    def moments(self) -> None:
        acting = [("F", "coupler", FORCES["F"], self.place("coupler", "P"))]
        acting += [("Q", "rocker", FORCES["Q"], self.place("rocker", "B"))]
        for link in BINARY:
            at, mass = self.place(link, "center"), self.m.mass(link)
            acting += [(f"inertia force of {link}", link, -mass * self.acceleration(link), at)]
            if any(self.m.gravity_vector):
                acting += [(f"weight of {link}", link, mass * np.array(self.m.gravity_vector), at)]
        wrong = []
        for name, link, f, at in acting:
            for joint in BINARY[link].split():
                moment = cross(at - self.place(link, joint), f)
                if not (name == "Q" and joint == "B"):
                    words = f"the moment of {name} about {joint}"
                    self.adds(f"{words} is left out", (link, (0, 0), at, -moment))
                    self.adds(f"{words} has the wrong sign", (link, (0, 0), at, -2 * moment))
            first = self.place(link, next(iter(self.m.points(link))))
            wrong.append((link, (0, 0), at, 2 * float((at - first)[1] * f[0])))
        self.adds("the moments of all loads have a wrong sign: x Fy + y Fx for x Fy - y Fx", *wrong)
        weights = [
            (k, self.m.mass(k) * np.array(self.m.gravity_vector) * (1 / 9.80665 - 1), self.place(k, "center"), 0.0)
            for k in BINARY
        ]  # fmt: skip
        if any(self.m.gravity_vector):
            self.adds("masses in kg are mistaken for weights in N: g is missing", *weights)

    def accelerations(self) -> None:
        for link, joints in BINARY.items():
            mass, at, a = self.m.mass(link), self.place(link, "center"), self.acceleration(link)
            w, alpha = self.turn(link, "speed"), self.turn(link, "acceleration")
            own, of, places = (
                self.inertia(link),
                dict[str, Any](),
                [self.place(link, j) for j in joints.split()],
            )

            def taken(words: str, new: Any, of_link: Any = (link, mass, at, a)) -> None:
                k, m, p, old = of_link
                sentence = f"the acceleration of the mass centre of {k} is taken {words}"
                self.adds(sentence, (k, -m * (new - old), p, 0.0))

            for joint, place in zip(joints.split(), places, strict=True):
                q = at - place
                of[joint] = a + w * w * q - alpha * across(q)
                taken(f"as that of {joint}", of[joint])
                if joint not in ("O2", "O4"):
                    taken(f"without that of {joint}", a - of[joint])
                taken(f"without the normal part relative to {joint}", a + w * w * q)
                taken(f"without the tangential part relative to {joint}", a - alpha * across(q))
            taken("as the mean of " + " and ".join(of), sum(of.values()) / 2)
            for axis, sign in (("x", np.array([-1, 1])), ("y", np.array([1, -1]))):
                taken(f"with the wrong sign in {axis}", a * sign)
                taken(f"without its {axis} component", a * (sign + 1) / 2)
            line = places[1] - places[0]
            second = float((at - places[0]) @ line / (line @ line))
            for words, part in (
                ("as two masses at its joints, without the correction couple", second),
                ("half and half at its joints", 0.5),
            ):
                lumps = [
                    (link, -mass * share * of[j], place, 0.0)
                    for j, place, share in zip(of, places, (1 - part, part), strict=True)
                ]
                without = (link, -own[1], own[2], -own[3])
                self.adds(f"the mass of {link} is taken {words}", without, *lumps)

    def geometry(self) -> None:
        now = float(self.r.drive_position("O2")[0])
        for words, angle in (
            ("is counted from the other side: its angle has the wrong sign", -now),
            ("is counted from the other dead centre", math.pi - now),
            ("is counted from the other dead centre, turned by 180 deg", math.pi + now),
            ("is counted from the other axis", math.pi / 2 - now),
            *(("is misread by 10 deg", now + math.radians(x)) for x in (10, -10)),
            *(("is misread by 20 deg", now + math.radians(x)) for x in (20, -20)),
        ):
            self.anew(f"the position of O2 {words}", {"drives.O2.position": angle})
        points = {"crank": ["center"], "coupler": ["P", "center"], "rocker": ["center"]}
        far = {k: joints.split()[1] for k, joints in BINARY.items()}
        place = {k: [np.array(self.m.points(k)[n]) for n in BINARY[k].split()] for k in BINARY}
        size = {k: float(np.hypot(*(b - a))) for k, (a, b) in place.items()}

        def stretched(link: str, factor: float) -> dict[str, Any]:
            a, b = place[link]
            return {f"links.{link}.points.{far[link]}": tuple(a + factor * (b - a))}

        for link, some in points.items():
            for point in some:
                what = f"the mass centre of {link}" if point == "center" else f"point {point} of {link}"
                path = f"links.{link}.center" if point == "center" else f"links.{link}.points.{point}"
                x, y = self.m.center(link) if point == "center" else self.m.points(link)[point]
                if x != size[link] / 2:
                    self.anew(f"{what} is measured from the other end", {path: (size[link] - x, y)})
                if y:
                    self.anew(f"the offset of {what} is left out", {path: (x, 0.0)})
                    self.anew(f"the offset of {what} is on the wrong side", {path: (x, -y)})
        for one, two in combinations(BINARY, 2):
            values = stretched(one, size[two] / size[one]) | stretched(two, size[one] / size[two])
            self.anew(f"the lengths of {one} and {two} are exchanged", values)
        for link in BINARY:
            for words, factor in LENGTHS.items():
                self.anew(f"the length of {link} is {words}", stretched(link, factor))


@pytest.mark.parametrize("gravity", ["standard", "none"])
def test_every_mistake_is_the_problem_with_that_made_by_hand(gravity: str) -> None:
    m = da.loads(MORE.replace("gravity: standard", f"gravity: {gravity}"))
    hand = ByHand(m)
    every = hand.data, hand.moments, hand.links, hand.loads, hand.accelerations, hand.geometry
    for make in every if gravity == "standard" else every[:2]:
        make()
    found: Efforts = defaultdict(list)
    for order, sentence, solution in WrongProblems(hand.r):
        if order > 1 and (gravity == "standard" or sentence in hand.out or "gravity" in sentence):
            r = solution()
            found[sentence].append(math.nan if r is None else float(r.effort("O2")[0]))
    assert found.keys() ^ hand.out.keys() == set()
    for words, some in hand.out.items():
        assert found[words] == pytest.approx(some, rel=1e-8, abs=1e-8 * abs(hand.effort), nan_ok=True), words


def test_one_part_left_out_is_the_sum_of_its_parts_left_out() -> None:
    """Of every link with inertia its force and its couple, which the sentence of the link is for."""
    r = da.dynamics(da.loads(MORE))
    found = {p.sentence: float(p.solution().effort("O2")[0]) for p in WrongProblems(r) if p.order == 1}
    whole = float(r.effort("O2")[0])
    for link in BINARY:
        parts = [found[f"the inertia {kind} of {link} is left out"] - whole for kind in ("force", "couple")]
        assert found[f"the inertia of {link} is left out"] - whole == pytest.approx(sum(parts), rel=1e-9)
    light = da.dynamics(da.loads(MORE).with_values({"links.crank.mass": 0.0, "links.crank.inertia": 0.0}))
    words = {p.sentence for p in WrongProblems(light) if "inertia of" in p.sentence and p.order == 1}
    assert words == {f"the inertia of {link} is left out" for link in ("coupler", "rocker")}


def test_what_is_more_usual_is_tried_first() -> None:
    """A position counted from elsewhere before one misread by tens of degrees, and lengths that are exchanged."""
    orders = [
        (x.order, x.sentence.removeprefix("the position of O2 "))
        for x in misread_geometry(da.statics(da.four_bar(positions=1)))
    ]
    position = [order for order, words in orders if words.startswith("is ")]
    assert position == [2] * 4 + [3] * 4
    assert {
        order for order, words in orders if "exchanged" in words or words.startswith("the length of")
    } == {3}


def test_links_of_three_joints_are_misread_by_their_first_two() -> None:
    """Lengths by the first two joints of a link, in the order of the file; none of one joint or of the ground."""
    r = da.solve(da.load(examples()["scissor_lift"]))
    m, first = r.mechanism, dict[str, float]()
    for link in m.links:
        at = [
            np.array(p)
            for name, joint in m.joints.items()
            for k, p in zip(joint.links, m.joint_points(name), strict=True)
            if k == link
        ]
        if link != "ground" and len(at) > 1 and np.hypot(*(at[1] - at[0])) > 1e-9:
            first[link] = float(np.hypot(*(at[1] - at[0])))
    assert {"left_1", "right_3"} <= first.keys()
    misread = {x.sentence: x.values for x in misread_geometry(r)}
    halved = {k.removeprefix("the length of ").removesuffix(" is halved: stroke for crank") for k in misread}
    assert halved & m.links.keys() == first.keys()
    assert not any(words.startswith("the position") for words in misread)  # of many positions
    for one, two in combinations(first, 2):
        words = f"the lengths of {one} and {two} are exchanged"
        assert (words in misread) is not math.isclose(first[one], first[two], rel_tol=1e-9)
