"""Random machines whose joints rub: slider-cranks, four-bars, pendulums, stacked blocks, carts and six-bars."""

from __future__ import annotations

from typing import Any

import numpy as np

KINDS = 6
Tree = dict[str, Any]


class _Machine:
    """Links, joints, drives and their starts, by random numbers."""

    def __init__(self, seed: int) -> None:
        self.r = np.random.default_rng(seed)
        self.links: Tree = {"ground": {"points": {"O": [0, 0]}}}
        self.joints: Tree = {}
        self.drives: Tree = {}
        self.start: Tree = {}
        self.more: Tree = {}

    def between(self, low: float, high: float) -> float:
        return float(self.r.uniform(low, high))

    def link(
        self, name: str, points: Tree, length: float, inertia: tuple[float, float] = (0.06, 0.3)
    ) -> None:
        inertia_ = self.between(*inertia) * length**2
        center = [length * self.between(0.3, 0.7), 0]
        self.links[name] = {
            "points": points,
            "mass": self.between(0.5, 3),
            "center": center,
            "inertia": inertia_,
        }

    def block(self, name: str, point: str) -> None:
        self.links[name] = {"points": {point: [0, 0]}, "mass": self.between(0.5, 4)}

    def _friction(self, turns: bool) -> Tree:
        if self.r.random() < 0.15:
            return {}
        friction: Tree = {"coefficient": self.between(0.02, 0.3)}
        if self.r.random() < 0.4:
            friction["static"] = friction["coefficient"] * self.between(1, 1.6)
        return {"friction": friction | ({"radius": f"{self.between(5, 40)} mm"} if turns else {})}

    def pin(self, name: str, one: str, two: str, at: str = "") -> None:
        self.joints[name] = (
            {"type": "pin", "links": [one, two]} | ({"at": at} if at else {}) | self._friction(True)
        )

    def slide(self, name: str, one: str, two: str, at: list[str], direction: float) -> None:
        slider = {"type": "slider", "links": [one, two], "at": at, "direction": f"{direction} deg"}
        self.joints[name] = slider | self._friction(False)

    def drive(self, joint: str) -> float:
        """Forces move it, from rest or not; where it begins, rad or m."""
        slides, which = self.joints[joint]["type"] == "slider", self.r.random()
        effort = self.between(-3, 3) if which < 0.4 else 0.0
        self.drives[joint] = {"effort": f"{effort} {'N' if slides else 'N*m'}"}
        if 0.4 <= which < 0.7 and not slides:
            stall, no_load = f"{self.between(1, 6)} N*m", f"{self.between(5, 30)} rad/s"
            self.drives[joint] = {"motor": {"stall": stall, "no_load": no_load}}
        speed = self.between(-15, 15) if self.r.random() < 0.7 else 0.0
        position = self.between(-0.1, 0.1) if slides else self.between(0, 2 * np.pi)
        units = ("m", "m/s") if slides else ("rad", "rad/s")
        rates = position, speed / 10 if slides else speed
        self.start[joint] = {
            n: f"{x} {u}" for n, x, u in zip(("position", "speed"), rates, units, strict=True)
        }
        return position


def machine(seed: int) -> Tree:
    """The tree of a model file; its kind is the seed's remainder."""
    m = _Machine(seed)
    (_crank, _crank, _pendulums, _blocks, _cart, _crank)[seed % KINDS](m, seed % KINDS)
    return {
        "gravity": "standard",
        "links": m.links,
        "joints": m.joints,
        "drives": m.drives,
        "start": m.start,
        **m.more,
    }


def _crank(m: _Machine, kind: int) -> None:
    """A slider-crank, a four-bar, or one that moves a slider by a bar on its coupler."""
    crank, rod = m.between(0.04, 0.07), m.between(0.18, 0.3)
    m.link("crank", {"O": [0, 0], "A": [crank, 0]}, crank, (3.0, 10.0))
    m.pin("O", "ground", "crank")
    m.pin("A", "crank", "rod")
    m.link("rod", {"A": [0, 0], "B": [rod, 0], "C": [rod / 2, 0.02]}, rod)
    pin = crank * np.exp(1j * m.drive("O"))
    if kind == 0:
        m.block("ram", "B")
        m.pin("B", "rod", "ram")
        m.slide("G", "ground", "ram", ["O", "B"], 0)
        turn = -np.arcsin(pin.imag / rod)
        m.more = {"assembly": {"rod": f"{turn} rad", "ram": f"{turn} rad"}}
        work = {"type": "force", "on": "ram", "at": "B", "by": "ground", "direction": "0 deg"}
        m.more["loads"] = {"work": {**work, "value": f"{m.between(-30, 30)} N"}}
        return
    rocker, ground = rod - m.between(0.02, 0.06), rod - m.between(0.0, 0.02)
    far = ground - pin
    turn = np.angle(far) + np.arccos((rod**2 + abs(far) ** 2 - rocker**2) / (2 * rod * abs(far)))
    end = pin + rod * np.exp(1j * turn) - ground
    m.links["ground"]["points"]["Q"] = [ground, 0]
    m.link("rocker", {"Q": [0, 0], "B": [rocker, 0]}, rocker)
    m.pin("B", "rod", "rocker")
    m.pin("Q", "ground", "rocker")
    m.more = {"assembly": {"rod": f"{turn} rad", "rocker": f"{np.angle(end)} rad"}}
    if kind == 5:
        m.link("bar", {"C": [0, 0], "E": [0.5, 0]}, 0.5)
        m.block("block", "E")
        m.pin("C", "rod", "bar")
        m.pin("E", "bar", "block")
        m.slide("H", "ground", "block", ["O", "E"], 20)
        m.more["assembly"] |= {"bar": "10 deg", "block": "20 deg"}


def _pendulums(m: _Machine, _: int) -> None:
    """Two or three pendulums, one hung on the other."""
    before, at = "ground", "O"
    for k in range(int(m.r.integers(2, 4))):
        length = m.between(0.2, 0.5)
        m.link(f"p{k}", {at: [0, 0], f"P{k}": [length, 0]}, length)
        m.pin(f"J{k}", before, f"p{k}", at)
        m.drive(f"J{k}")
        before, at = f"p{k}", f"P{k}"


def _blocks(m: _Machine, _: int) -> None:
    """Two or three blocks, one on the other, on a spring."""
    before = "ground"
    for k in range(int(m.r.integers(2, 4))):
        m.block(f"b{k}", "O")
        m.slide(f"S{k}", before, f"b{k}", ["O", "O"], m.between(-5, 5))
        m.drive(f"S{k}")
        before = f"b{k}"
    m.links["ground"]["points"]["W"] = [-0.6, 0.01]
    spring = {"type": "spring", "between": ["ground.W", "b0.O"], "free_length": "0.5 m"}
    m.more = {"loads": {"spring": {**spring, "stiffness": f"{m.between(20, 400)} N/m"}}}


def _cart(m: _Machine, _: int) -> None:
    """A pendulum on a cart."""
    m.block("cart", "O")
    m.slide("S", "ground", "cart", ["O", "O"], 0)
    m.drive("S")
    m.link("pendulum", {"O": [0, 0], "P": [0.3, 0]}, 0.3)
    m.pin("J", "cart", "pendulum", "O")
    m.drive("J")
