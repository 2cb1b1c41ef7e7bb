"""Mass along members: a thick link cut anywhere and welded, by its shape, in the plane and in space."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.machine.members import member_forces as inside
from dalembert.machine.members.member_table import member_table
from tests.tiers import over

SHAFT = """
space: space
gravity: none
links:
  ground: {points: {A: [0, 0, 0], B: [0, 0, 1]}}
  shaft: {points: {A: [0, 0, 0], B: [0, 0, 1]}, mass_along: shape, members: [[A, B]],
          shape: {type: cylinder, between: [A, B], radius: 50 mm, density: 7850 kg/m^3}}
joints: {A: {type: revolute, links: [ground, shaft], axis: [0, 0, 1]}}
drives: {A: {position: 0, speed: 0, acceleration: 100 rad/s^2}}
"""


def test_torsion_falls_evenly_along_a_shaft() -> None:
    """J alpha (1 - s/L), J = m r^2 / 2: no steps."""
    f = da.member_forces(da.dynamics(da.loads(SHAFT)), "shaft")
    couple = 7850 * np.pi * 0.05**4 / 2 * 100
    for s in (0, 0.25, 0.5, 0.75, 1):
        assert f.at(s)["torsion"][0] == pytest.approx(-couple * (1 - s), abs=1e-12 * couple)
    assert f.residual.max() < 1e-14


@pytest.mark.parametrize("ends", ["A, B", "B, A"])
def test_a_solid_lies_along_its_member_whichever_of_its_ends_is_first(ends: str) -> None:
    """A cylinder of 0.6 m on a bar of 1 m, from either of its ends: J alpha up to its beginning, then less."""
    text = SHAFT.replace("between: [A, B]", f"between: [{', '.join(x + '_' for x in ends.split(', '))}]")
    text = text.replace("shaft: {points: {", "shaft: {points: {A_: [0, 0, 0.3], B_: [0, 0, 0.9], ")
    f = da.member_forces(da.dynamics(da.loads(text)), "shaft")
    couple = 0.6 * 7850 * np.pi * 0.05**4 / 2 * 100
    for s, share in ((0, 1), (0.2, 1), (0.45, 0.75), (0.6, 0.5), (0.9, 0), (1, 0)):
        assert f.at(s)["torsion"][0] == pytest.approx(-couple * share, abs=1e-12 * couple)
    assert f.residual.max() < 1e-14


@pytest.mark.parametrize("turned", [False, True])
def test_each_rod_of_a_stepped_bar_lies_on_its_piece(turned: bool) -> None:
    """Weight beyond a place, as the shear there: rods of 0.4 m and 0.6 m, in either order."""
    rods = [
        f"{{type: cylinder, between: [{x}], radius: {r}, density: 7850}}"
        for x, r in (("O, A", 0.03), ("A, B", 0.02))
    ]
    text = f"""
gravity: standard
links:
  ground: {{points: {{O: [0, 0]}}}}
  bar: {{points: {{O: [0, 0], A: [0.4, 0], B: [1, 0]}}, members: [[O, A], [A, B]], mass_along: shape,
        shape: [{", ".join(rods[::-1] if turned else rods)}]}}
joints: {{O: {{type: pin, links: [ground, bar]}}}}
drives: {{O: {{position: 0}}}}
"""
    f = da.member_forces(da.statics(da.loads(text)), "bar")
    even = 7850 * 9.80665 * np.pi * np.array([0.03, 0.02]) ** 2
    first, second = (c.at([0.0, c.member.length / 2])[0] for c in f.curves)
    assert first[:, 1] == pytest.approx(
        [0.4 * even[0] + 0.6 * even[1], 0.2 * even[0] + 0.6 * even[1]], rel=1e-12
    )
    assert second[:, 1] == pytest.approx([0.6 * even[1], 0.3 * even[1]], rel=1e-12)
    assert first[0, 5] == pytest.approx(-(0.4 * 0.2 * even[0] + 0.6 * 0.7 * even[1]), rel=1e-12)
    assert f.residual.max() < 1e-14


class ThickBar:
    """A bar A-B of random solids on one or two turning joints, loaded at B; ``cut(s)``: the same of two, welded."""

    def __init__(self, rng: Any, d: int) -> None:
        self.rng, self.d = rng, d
        self.a, t = rng.uniform(-0.2, 0.2, d), rng.normal(size=d)
        self.t, self.length = t / np.linalg.norm(t), rng.uniform(0.3, 0.9)
        self.n = np.array([-self.t[1], self.t[0], *([0.0] * (d - 2))])
        self.n /= np.linalg.norm(self.n)
        self.radius = rng.uniform(0.02, 0.2) * self.length
        self.beyond = rng.uniform(0, 0.3, 2) * self.length if rng.random() < 0.5 else np.zeros(2)
        self.kind = rng.choice(["cylinder", "tube", "box"])
        self.balls = [(rng.uniform(-0.1, 1.1), rng.uniform(-0.2, 0.2)) for _ in range(rng.integers(0, 3))]
        self.motion = rng.uniform(-9, 9, (2, 2))
        self.load = rng.normal(size=d) * 50

    def at(self, s: float, off: float = 0.0) -> list[float]:
        return [float(x) for x in self.a + self.t * s + self.n * off]

    def solid(self, low: float, high: float) -> dict[str, Any]:
        """The bar between two distances from A."""
        r, size, middle = self.radius, float(high - low), self.at((low + high) / 2)
        if self.kind == "box":
            t, n = ([*map(float, v), 0.0][:3] for v in (self.t, self.n))
            if self.d == 2:  # of the plane's boxes the sides are along x and y
                return {"type": "box", "size": [size, 1.3 * r, r], "center": middle, "density": 900.0}
            box = {"type": "box", "size": [size, r, 1.7 * r], "center": middle, "density": 900.0}
            return box | {"axes": {"x": t, "z": [float(x) for x in np.cross(t, n)]}}
        ends = {"length": size, "axis": [float(x) for x in self.t], "center": middle, "density": 900.0}
        return (
            {"type": "tube", "radii": [r / 2, r]} | ends
            if self.kind == "tube"
            else {"type": "cylinder", "radius": r} | ends
        )

    def part(self, low: float, high: float, far: float) -> dict[str, Any]:
        """The link from low to high, as members from ``max(low, 0)`` to ``min(high, L)``."""
        shapes = [self.solid(low, high)]
        for place, off in self.balls:
            s = place * self.length
            if (far <= s) if low > 0 else (s < far):
                shapes.append(
                    {"type": "sphere", "center": self.at(s, off), "radius": 0.03, "density": 2000.0}
                )
        ends = {"A": self.at(0.0), "B": self.at(self.length), "C": self.at(far)}
        return {"points": ends, "mass_along": "shape", "members": [["A", "B"]], "shape": shapes}

    def tree(self) -> dict[str, Any]:
        if self.d == 2 and self.kind == "box":
            self.t, self.n = np.array([1.0, 0.0]), np.array([0.0, 1.0])
        low, high = -self.beyond[0], self.length + self.beyond[1]
        (w1, a1), (w2, a2) = self.motion.tolist()
        links = {"ground": {"points": {"A": self.at(0.0)}}, "bar": self.part(low, high, 9.0)}
        joints: dict[str, Any] = {"A": {"type": "pin", "links": ["ground", "bar"]}}
        drives = {"A": {"position": 0.7, "speed": f"{w1} rad/s", "acceleration": f"{a1} rad/s^2"}}
        if self.d == 3:
            links["hub"] = {"points": {"A": self.at(0.0)}}
            axes = [[float(x) for x in v] for v in self.rng.normal(size=(2, 3))]
            joints = {
                "P": {"type": "revolute", "links": ["ground", "hub"], "at": "A", "axis": axes[0]},
                "A": {"type": "revolute", "links": ["hub", "bar"], "at": "A", "axis": axes[1]},
            }
            drives["P"] = {"position": 0.3, "speed": f"{w2} rad/s", "acceleration": f"{a2} rad/s^2"}
        load = {"type": "force", "on": "bar", "at": "B", "value": [float(x) for x in self.load]}
        out = {"links": links, "joints": joints, "drives": drives, "loads": {"F": load}}
        return out | ({"space": "space"} if self.d == 3 else {})

    def cut(self, tree: Any, s: float) -> Any:
        """The description with the bar cut at s and welded, each part with its share of the mass."""
        tree = deepcopy(tree)
        low, high = -self.beyond[0], self.length + self.beyond[1]
        tree["links"]["bar"], tree["links"]["far"] = self.part(low, s, s), self.part(s, high, s)
        tree["joints"]["C"] = {"type": "weld", "links": ["bar", "far"]}
        tree["loads"]["F"]["on"] = "far"
        return tree


def check_thick_bar(seed: int, d: int) -> None:
    """N, V, T, M at any cut are the reaction of a weld there, to rounding."""
    bar = ThickBar(np.random.default_rng(seed), d)
    tree = bar.tree()
    r = da.dynamics(da.mechanism(tree))
    f = da.member_forces(r, "bar")
    (curve,) = f.curves
    turn = np.eye(3)
    turn[:d, :d] = r.rotation("bar")[0]
    assert f.residual.max() < 1e-12
    size = [
        np.abs(curve.at(np.linspace(0, 1, 9) * curve.member.length)[0, :, k]).max()
        for k in (slice(3), slice(3, 6))
    ]
    for s in bar.rng.uniform(0.02, 0.98, 3) * bar.length:
        welded = da.dynamics(da.mechanism(bar.cut(tree, float(s))))
        force, couple = (np.zeros(3), np.zeros(3))
        force[:d] = welded.reaction("C", "bar")[0]
        couple[-1 if d == 2 else slice(None)] = welded.reaction_moment("C", "bar")[0]
        axes = curve.member.axes @ turn.T
        expected = np.concatenate([axes @ force * [1, -1, 1], axes @ couple])
        gap = np.abs(curve.at(float(s))[0, 0] - expected)
        assert gap[:3].max() < 1e-12 * max(size) / min(1.0, bar.length), (seed, s)
        assert gap[3:].max() < 1e-12 * max(size), (seed, s)


@over(4, 300)
def test_a_thick_link_of_the_plane_cut_and_welded(seed: int) -> None:
    check_thick_bar(seed, 2)


@over(4, 300)
def test_a_thick_link_in_space_cut_and_welded(seed: int) -> None:
    check_thick_bar(seed, 3)


@pytest.mark.parametrize("wrong", ["reaction", "mass", "couple"])
def test_the_check_speaks_of_a_wrong_answer(wrong: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A reaction, the load along the member, or its rotary inertia, off by some per cent: no closure."""
    bar = ThickBar(np.random.default_rng(4), 3)
    r = da.dynamics(da.mechanism(bar.tree()))
    if wrong == "reaction":
        r = replace(r, force_array=r.force_array * 1.03)
    else:
        name = {"mass": "_add_mass", "couple": "_add_couple"}[wrong]
        right = getattr(inside, name)
        monkeypatch.setattr(
            inside, name, lambda cubics, edges, load, *a: right(cubics, edges, 1.03 * load, *a)
        )
    table = member_table(r, ["bar"])
    printed = " ".join(str(table).split())
    assert table.links["bar"].residual.max() > 1e-7
    assert "Check failed: forces and moments do not close on bar" in printed
    assert "Equilibrium of every link" not in printed


def test_what_carries_a_force_beside_a_member_is_named() -> None:
    """A load 0.2 m off the line by a bracket: named with its distance, in the file too; on the line nothing is."""
    text = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [1, 0], P: [0.5, OFF]}, members: [[O, A]]}
joints: {O: {type: weld, links: [ground, arm]}}
loads: {F: {type: force, on: arm, at: P, value: [0, 10 N]}}
"""
    for off, beside in (("0.2", {"F": 0.2}), ("9e-7", {}), ("2e-6", {"F": 2e-6})):
        table = member_table(da.statics(da.loads(text.replace("OFF", off))))
        assert table.links["arm"].brackets == pytest.approx(beside)
        assert (
            "Their brackets are assumed rigid and are not analysed" in " ".join(str(table).split())
        ) == bool(beside)
        assert ("brackets" in table.record(lambda kind, x: x)["members"]["arm"]) == bool(beside)
