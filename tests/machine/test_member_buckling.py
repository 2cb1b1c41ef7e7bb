"""Buckling: K by the joints against beam elements, stepped columns, Johnson's limit, both axes, what is printed."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.machine.members.column_loads import critical_load
from dalembert.machine.members.member_table import member_table
from tests.tiers import over, tiers

PI = np.pi
WELDED = float(PI / brentq(lambda x: np.tan(x) - x, 4.4, 4.6))
"""K of one welded and one pinned end: tan x = x."""


def beam(x: float) -> tuple[Any, Any]:
    """Matrices of int v''^2 and int v'^2 of one element of length x, of v and v' at its ends."""
    top = [[12, 6 * x, -12, 6 * x], [6 * x, 4 * x * x, -6 * x, 2 * x * x]]
    low = [[-12, -6 * x, 12, -6 * x], [6 * x, 2 * x * x, -6 * x, 4 * x * x]]
    first = [[36, 3 * x, -36, 3 * x], [3 * x, 4 * x * x, -3 * x, -x * x]]
    last = [[-36, -3 * x, 36, -3 * x], [3 * x, -x * x, -3 * x, 4 * x * x]]
    return np.array([*top, *low]) / x**3, np.array([*first, *last]) / 30 / x


def elements(lengths: Any, stiffness: Any, fixed: list[int], cuts: int) -> float:
    """Least critical load of spans by beam elements (v, slope); ``fixed``: variables 2 n, 2 n + 1 of node n held."""
    size = np.repeat(np.array(lengths) / cuts, cuts)
    count = 2 * (len(size) + 1)
    bend, sway = np.zeros((2, count, count))
    for k, (x, stiff) in enumerate(zip(size, np.repeat(stiffness, cuts), strict=True)):
        at = np.ix_(*(2 * [range(2 * k, 2 * k + 4)]))
        b, g = beam(x)
        bend[at] += stiff * b
        sway[at] += g
    held = {2 * cuts * (i // 2) + i % 2 for i in fixed}
    some = [i for i in range(count) if i not in held]
    largest = eigh(sway[np.ix_(some, some)], bend[np.ix_(some, some)], eigvals_only=True)[-1]
    return float(1 / largest)


@over(6, 400)
def test_critical_loads_of_random_columns_are_those_of_beam_elements(seed: int) -> None:
    """One to four spans of any stiffness, any nodes held; the error of elements of length h goes with h^4."""
    rng = np.random.default_rng(seed)
    spans = int(rng.integers(1, 5))
    lengths, stiffness = rng.uniform(0.2, 1, spans), 10 ** rng.uniform(-1, 1, spans)
    while True:
        fixed = [i for i in range(2 * spans + 2) if rng.random() < 0.4]
        sway = sum(i % 2 == 0 for i in fixed)
        if sway > 1 or (sway == 1 and any(i % 2 for i in fixed)):
            break
    free = np.eye(2 * spans + 2)[:, [i for i in range(2 * spans + 2) if i not in fixed]]
    coarse, fine = (elements(lengths, stiffness, fixed, n) for n in (12, 24))
    assert critical_load(lengths, [stiffness], free) == pytest.approx((16 * fine - coarse) / 15, rel=2e-7)


COLUMN = """
gravity: none
links:
  ground: {{points: {{O: [0, 0], T: [1, 0]}}}}
  beam: {{points: {{O: [0, 0], T: [1, 0]}}, section: {{rectangle: [20 mm, 30 mm], elasticity: 210 GPa}}}}
  block: {{points: {{T: [0, 0]}}}}
joints: {{{joints}}}
drives: {{{drives}}}
loads: {{F: {{type: force, on: {on}, at: T, value: [-12 kN, 0]}}}}
"""
GUIDED = "friction: {coefficient: 0, guide: [30 mm, 30 mm]}"
ENDS = {  # joint at O, joint at T, drives, K in the plane, K across it
    "weld, nothing": ("type: weld", "", "", 2, 2),
    "driven pin, nothing": ("type: pin", "", "O: {position: 0}", 2, 2),
    "pin, slot along": ("type: pin", "type: slot, direction: 0", "", 1, 1),
    "weld, slot along": ("type: weld", "type: slot, direction: 0", "", WELDED, WELDED),
    "weld, slot across": ("type: weld", "type: slot, direction: 90 deg", "", 2, WELDED),
    "weld, slider along": ("type: weld", "type: slider, direction: 0", "", WELDED, WELDED),
    "weld, guided slider along": ("type: weld", f"type: slider, direction: 0, {GUIDED}", "", 0.5, WELDED),
    "weld, guided slider across": (
        "type: weld",
        f"type: slider, direction: 90 deg, {GUIDED}, angle: -90 deg",
        "",
        1,
        WELDED,
    ),
    "weld, weld": ("type: weld", "type: weld", "", 0.5, 0.5),
    "weld, pin": ("type: weld", "type: pin", "", WELDED, WELDED),
}


@pytest.mark.parametrize("name", ENDS)
def test_effective_lengths_follow_from_the_joints(name: str) -> None:
    """The books' cases, each as a mechanism; a slider without the length of its guide holds no angle."""
    low, high, drives, in_plane, across = ENDS[name]
    joints = f"O: {{{low}, links: [ground, beam]}}"
    if high:
        joints += f", T: {{{high}, links: [ground, beam]}}"
    text = COLUMN.format(joints=joints, drives=drives, on="beam").replace(
        "  block: {points: {T: [0, 0]}}\n", ""
    )
    b = da.member_forces(da.statics(da.loads(text)), "beam").buckling()
    assert b.effective_length == pytest.approx((in_plane, across), rel=1e-9)
    each = [
        PI**2 * 210e9 * x / k**2 for x, k in ((0.02 * 0.03**3 / 12, in_plane), (0.03 * 0.02**3 / 12, across))
    ]
    assert b.critical == pytest.approx(min(each), rel=1e-9)
    assert b.plane == int(np.argmin(each))


SECTIONS: list[dict[str, Any]] = [
    {"circle": 0.03},
    {"tube": [0.03, 0.036]},
    {"rectangle": [0.02, 0.045]},
    {"rectangle": [0.05, 0.006]},
    {"I": [0.06, 0.05, 0.004, 0.006]},
    {"area": 4e-4, "modulus": 2e-6, "inertia": 3e-8},
]


class HeldBar:
    """A bar on the ground by random joints at two or three places; what they hold, by a table of its own."""

    def __init__(self, rng: Any, d: int) -> None:
        self.rng, self.d = rng, d
        t, self.length = rng.normal(size=d), rng.uniform(0.5, 2)
        self.t = t / np.linalg.norm(t)
        self.section = SECTIONS[rng.integers(len(SECTIONS))] | {"elasticity": 2e11}
        inner = [float(x) for x in rng.uniform(0.2, 0.8, rng.integers(0, 2))]
        self.places = [x for x in (0.0, *inner, 1.0) if rng.random() < 0.85] or [0.0]
        self.joints = {f"J{k}": self.joint(x) for k, x in enumerate(self.places)}

    def axes(self) -> Any:
        """Rows t, y, z of the bar: y is t turned about the z axis."""
        t = np.array([*self.t, 0.0])[:3]
        y = np.cross([0, 0, 1], t) / np.linalg.norm(np.cross([0, 0, 1], t))
        return np.array([t, y, np.cross(t, y)])

    def joint(self, place: float) -> dict[str, Any]:
        kinds = ("weld", "pin", "slot", "slider", "guided") if self.d == 2 else tuple(HOLDS)
        kind, angle = str(self.rng.choice(kinds)), float(self.rng.uniform(-180, 180))
        out: dict[str, Any] = {"kind": kind, "angle": np.radians(angle)}
        if self.d == 2:
            key = {"type": {"guided": "slider"}.get(kind, kind)}
            if kind in ("slot", "slider", "guided"):
                key["direction"] = f"{angle} deg"
            if key["type"] == "slider":
                key["angle"] = f"{-angle} deg"
            if kind == "guided":
                key["friction"] = {"coefficient": 0.0, "guide": [0.02, 0.02]}
            return out | {"key": key}
        axis = self.rng.normal(size=3) if self.rng.random() < 0.7 else np.array([*self.t])
        out["axis"] = axis / np.linalg.norm(axis)
        key = {"type": kind}
        return out | {
            "key": key | ({} if kind in ("weld", "spherical") else {"axis": [float(x) for x in axis]})
        }

    def tree(self) -> dict[str, Any]:
        points = {f"J{k}": [float(v) for v in self.t * x * self.length] for k, x in enumerate(self.places)}
        ends = {"A": [0.0] * self.d, "B": [float(v) for v in self.t * self.length]}
        bar = {"points": ends | points, "members": [["A", "B"]], "section": self.section}
        joints = {n: j["key"] | {"links": ["ground", "bar"]} for n, j in self.joints.items()}
        out = {"links": {"ground": {"points": ends | points}, "bar": bar}, "joints": joints}
        out["loads"] = {
            "F": {"type": "force", "on": "bar", "at": "B", "value": [float(-1e3 * x) for x in self.t]}
        }
        return out | ({"space": "space"} if self.d == 3 else {})

    def held(self, loosely: bool) -> list[tuple[float, Any]]:
        """(place, row (6,)) of displacement and rotation of the bar that a joint holds."""
        out = []
        for x, j in zip(self.places, self.joints.values(), strict=True):
            if self.d == 2:
                n = [-np.sin(j["angle"]), np.cos(j["angle"]), 0, 0, 0, 0]
                both = [[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]]
                turn = [0, 0, 0, 0, 0, 1]
                rows = {"weld": [*both, turn], "pin": both, "slot": [n], "guided": [n, turn]}
                rows["slider"] = [n, turn] if loosely else [n]
                out += [(x, np.array(row, float)) for row in rows[j["kind"]]]
            else:
                along = np.outer(j["axis"], j["axis"])
                for part, which in enumerate(HOLDS[j["kind"]]):
                    basis = {"all": np.eye(3), "none": np.zeros((0, 3)), "across": np.eye(3) - along}[which]
                    for v in basis:
                        row = np.zeros(6)
                        row[3 * part : 3 * part + 3] = v
                        out.append((x, row))
        return out

    def across(self, nodes: Any, count: int) -> list[Any]:
        """Of the plane, across it: places are held, the angle by welds, or by what holds the bar alone."""
        rows = []
        for x, j in zip(self.places, self.joints.values(), strict=True):
            clamped = j["kind"] == "weld" or len(self.places) == 1
            n = int(np.argmin(np.abs(nodes - x * self.length)))
            rows += [np.eye(4 * count + 2)[2 * count + 2 * n + i] for i in range(1 + clamped)]
        return rows

    def critical(self, cuts: int, loosely: bool = False) -> float:
        """By beam elements in both planes, with a shift and a twist along the axis; 0 if it moves without bending."""
        marks = sorted({0.0, 1.0, *self.places})
        parts = [np.full(cuts, (b - a) * self.length / cuts) for a, b in pairwise(marks)]
        size = np.concatenate(parts)
        nodes, count = np.concatenate([[0.0], np.cumsum(size)]), len(size) + 1
        about = [2e11 * x for x in second_moments(self.section)]
        bend, sway = np.zeros((2, 4 * count + 2, 4 * count + 2))
        for p in range(2):
            for k, x in enumerate(size):
                at = np.ix_(*(2 * [2 * count * p + 2 * k + np.arange(4)]))
                b, g = beam(x)
                bend[at] += about[p] * b
                sway[at] += g
        axes, rows = self.axes(), self.across(nodes, count) if self.d == 2 else []
        for place, row in self.held(loosely):
            n = int(np.argmin(np.abs(nodes - place * self.length)))
            v, w = axes @ row[:3], axes @ row[3:]
            out = np.zeros(4 * count + 2)
            out[-2], out[-1], out[2 * n], out[2 * n + 1] = v[0], w[0], v[1], w[2]
            out[2 * count + 2 * n], out[2 * count + 2 * n + 1] = v[2], -w[1]
            rows.append(out)
        return least_load(bend, sway, np.array(rows), min(about) / self.length**2)


def second_moments(section: dict[str, Any]) -> tuple[float, float]:
    """For bending along y, and along z."""
    (kind, size), *_ = section.items()
    if kind == "rectangle":
        return size[0] * size[1] ** 3 / 12, size[1] * size[0] ** 3 / 12
    if kind == "I":
        h, b, web, flange = size
        return (b * h**3 - (b - web) * (h - 2 * flange) ** 3) / 12, (
            2 * flange * b**3 + (h - 2 * flange) * web**3
        ) / 12
    if kind == "area":
        return section["inertia"], section["inertia"]
    i, o = (0.0, size) if kind == "circle" else size
    return PI / 64 * (o**4 - i**4), PI / 64 * (o**4 - i**4)


def least_load(bend: Any, sway: Any, rows: Any, size: float) -> float:
    """Least P of bend x = P sway x where rows x = 0, of the size given; 0 where some x bends nothing but sways."""
    _, values, right = np.linalg.svd(rows)
    free = right[int((values > 1e-9).sum()) :].T
    bend, sway = (free.T @ m @ free for m in (bend / size, sway))
    scale, turn = np.linalg.eigh(bend + sway)
    some = scale > 1e-9 * scale[-1] * 1e-6
    white = turn[:, some] / np.sqrt(scale[some])
    share = float(np.linalg.eigvalsh(white.T @ bend @ white)[0])
    return size * share / (1 - share) if share > 1e-6 else 0.0


HOLDS = {  # displacements, rotations
    "weld": ("all", "all"),
    "revolute": ("all", "across"),
    "prismatic": ("across", "all"),
    "cylindrical": ("across", "across"),
    "spherical": ("all", "none"),
}
"""Of joints in space about or along their axis."""


def check_held_bar(seed: int, d: int) -> str:
    """The critical load of a random bar is that of beam elements, or it is refused as loose; how it was."""
    bar = HeldBar(np.random.default_rng(seed), d)
    try:
        r = da.statics(da.mechanism(bar.tree()))
    except da.ModelError:
        return "no mechanism"
    if r.status[0] == "not_assembled" or not np.isfinite(r.point_array).all():
        return "no mechanism"
    oracle = bar.critical(12) or bar.critical(12, loosely=True)
    if not oracle:
        with pytest.raises(da.ModelError, match="without bending"):
            da.member_forces(r, "bar").buckling()
        return "loose"
    b = da.member_forces(r, "bar").buckling()
    assert b.critical == pytest.approx(oracle, rel=2e-4), (seed, bar.joints)
    return b.ends[0]


@pytest.mark.parametrize("seed", tiers(range(4), range(4, 40), range(40, 600)))
@pytest.mark.parametrize("d", [2, 3])
def test_random_joints_hold_a_bar_as_beam_elements_have_it(d: int, seed: int) -> None:
    check_held_bar(seed, d)


CYLINDER = """
gravity: none
links:
  ground: {{points: {{A: [0, 0]}}}}
  barrel: {{points: {{A: [0, 0], E: [0.6, 0]}}, members: [[A, E]], section: {barrel}}}
  rod: {{points: {{P: [0, 0], B: [0.65, 0]}}, members: [[{rod}]], section: {{circle: 45 mm, elasticity: 206 GPa}}}}
joints:
  A: {{type: {foot}, links: [ground, barrel]}}
  C: {{type: slider, links: [barrel, rod], at: [A, P]}}
  {head}
drives: {{C: {{position: {{from: 0.05, to: {last}, count: 6}}}}}}
loads: {{F: {{type: force, on: rod, at: B, value: [-60 kN, 0]}}}}
"""
SLOT = "B: {type: slot, links: [ground, rod], at: [A, B]}"
TUBE = "{tube: [80 mm, 95 mm], elasticity: 206 GPa}"
STEPPED = {"barrel": TUBE, "rod": "P, B", "foot": "pin", "head": SLOT, "last": 0.55}


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("clamped", [False, True])
def test_barrel_and_rod_are_one_stepped_column(clamped: bool, turned: bool) -> None:
    """At each length the least root of tan(k1 L1)/k1 + tan(k2 L2)/k2 = 0, or tan(k1 L1) tan(k2 L2) = k2 / k1."""
    keys = STEPPED | ({"foot": "weld", "head": ""} if clamped else {}) | ({"rod": "B, P"} if turned else {})
    table = member_table(da.statics(da.loads(CYLINDER.format(**keys))))
    b = table.buckling["rod"]
    assert b is table.buckling["barrel"]
    assert b.links == ("barrel", "rod")
    barrel, rod = (206e9 * PI / 64 * x for x in (0.095**4 - 0.08**4, 0.045**4))
    first, steps = 0.6, np.linspace(0.05, 0.55, 6) + 0.05
    for found, second in zip(b.criticals, steps, strict=True):

        def f(p: float, second: float = float(second)) -> float:
            a, b = np.sqrt(p / barrel), np.sqrt(p / rod)
            (s1, c1), (s2, c2) = ((np.sin(x), np.cos(x)) for x in (a * first, b * second))
            return float(a * s1 * s2 - b * c1 * c2 if clamped else b * s1 * c2 + a * c1 * s2)

        assert f(found * (1 - 1e-9)) * f(found * (1 + 1e-9)) < 0
        signs = np.sign([f(p) for p in np.linspace(found * 1e-3, found * 0.999, 400)])
        assert (signs == signs[0]).all()
    assert b.position == 5
    assert b.safety == pytest.approx(b.criticals[5] / 60e3, rel=1e-12)


def judged(text: str, section: str, **more: Any) -> Any:
    """Buckling of the beam of a column with a section."""
    m = da.loads(text.replace("{rectangle: [20 mm, 30 mm], elasticity: 210 GPa}", section))
    return da.member_forces(da.statics(m), "beam").buckling(**more)


FREE = COLUMN.format(joints="O: {type: weld, links: [ground, beam]}", drives="", on="beam")
FREE = FREE.replace("  block: {points: {T: [0, 0]}}\n", "")


def test_the_formula_changes_where_euler_is_half_the_yield_stress() -> None:
    """Both sides of S_y / 2: Johnson's parabola touches Euler's curve there, with the same slope."""
    section = "{{circle: 20 mm, elasticity: 210 GPa, yield_stress: {} Pa}}"
    area, euler = PI / 4 * 0.02**2, PI**2 * 210e9 * PI / 64 * 0.02**4 / 4
    limit = 2 * euler / area
    for share in (1 + 1e-3, 1 - 1e-3, 0.5, 0.1):
        b = judged(FREE, section.format(limit * share))
        short = area * limit * share * (1 - limit * share * area / 4 / euler)
        assert b.formula == ("Euler" if share > 1 else "Johnson")
        assert b.critical == pytest.approx(euler if share > 1 else short, rel=1e-9)
        assert b.slenderness == pytest.approx(400, rel=1e-9)
        assert (b.slenderness < PI * np.sqrt(2 * 210e9 / (limit * share))) == (share < 1)
        assert b.critical <= euler * (1 + 1e-12)  # equal to rounding above the change
        assert b.critical < area * limit * share


@pytest.mark.parametrize(("b", "h", "plane"), [(0.02, 0.0201, 1), (0.0201, 0.02, 0), (0.02, 0.02, 0)])
def test_a_column_bends_about_its_weaker_axis(b: float, h: float, plane: int) -> None:
    """As long in both planes: about the axis of the lesser I; held at the head in the plane: across it."""
    found = judged(FREE, f"{{rectangle: [{b}, {h}], elasticity: 210 GPa}}")
    low, high = sorted((b, h))
    assert found.plane == plane
    assert found.critical == pytest.approx(PI**2 * 210e9 * high * low**3 / 12 / 4, rel=1e-9)


@pytest.mark.parametrize(("ratio", "plane"), [(1.999, 0), (2.001, 1)])
def test_the_strong_axis_decides_where_its_length_is_the_greater(ratio: float, plane: int) -> None:
    """A crank on its shaft, K = 2 in its plane and 1 across it: as strong both ways where h = 2 b."""
    head = "T: {type: pin, links: [beam, block]}, S: {type: slider, links: [ground, block], at: T, direction: 90 deg}"
    text = COLUMN.format(
        joints="O: {type: pin, links: [ground, beam]}, " + head, drives="O: {position: 0}", on="block"
    )
    found = judged(text, f"{{rectangle: [20 mm, {20 * ratio} mm], elasticity: 210 GPa}}")
    assert found.effective_length == pytest.approx((2, 1), rel=1e-9)
    assert (found.plane, found.ends) == (plane, (("fixed", "free"), ("pinned", "pinned"))[plane])


def test_a_given_factor_overrides_the_joints(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of the file or asked for; printed with what it gives, in JSON and CSV."""
    both, text = FREE.replace("section:", "effective_length: [0.8, 1.5], section:"), str
    found = judged(both, "{circle: 20 mm, elasticity: 210 GPa}")
    assert (found.effective_length, found.ends) == ((0.8, 1.5), ("given", "given"))
    assert found.critical == pytest.approx(PI**3 * 210e9 * 0.02**4 / 64 / 1.5**2, rel=1e-12)
    assert judged(both, "{circle: 20 mm, elasticity: 210 GPa}", ends=0.5).effective_length == (0.5, 0.5)
    assert da.loads(both).to_tree()["links"]["beam"]["effective_length"] == [0.8, 1.5]
    file = tmp_path / "column.yaml"
    for content, factors, ends in ((both, [0.8, 1.5], "given"), (FREE, [2.0, 2.0], "fixed-free")):
        file.write_text(content, encoding="utf-8")
        paths = tmp_path / "a.json", tmp_path / "a.csv"
        assert (
            main(["members", text(file), "--json", text(paths[0]), "--csv", text(paths[1]), "--force"]) == 0
        )
        assert ends in capsys.readouterr().out
        record = json.loads(paths[0].read_text(encoding="utf-8"))["members"]["beam"]["buckling"]
        assert record["effective_length"] == pytest.approx(factors, rel=1e-9)
        head, row, *_ = paths[1].read_text(encoding="utf-8").splitlines()
        table = dict(zip(head.split(","), row.split(","), strict=True))
        assert float(table["effective_length.beam.across"]) == pytest.approx(factors[1], rel=1e-9)
        assert float(table["critical_load.beam [N]"]) == pytest.approx(record["critical"], rel=1e-12)


def test_the_printed_column_names_its_ends() -> None:
    """The column of the books, welded below and free above: a quarter of what it carries between pins."""
    text = FREE.replace(
        "{rectangle: [20 mm, 30 mm], elasticity: 210 GPa}", "{circle: 20 mm, elasticity: 210 GPa}"
    )
    printed = str(member_table(da.statics(da.loads(text))))
    row = next(line for line in printed.splitlines() if "fixed-free" in line)
    assert row.split() == ["beam", "12000", "4069.6", "0.3391", "Euler", "2", "2", "fixed-free"]
    assert "under a force of constant direction" in " ".join(printed.split())


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ((", elasticity: 210 GPa", ""), "the section of 'beam' has no elasticity; give elasticity: 210 GPa"),
        (("section:", "members: [[O, M], [M, T]], section:"), "members O-M, M-T of 'beam' are one frame"),
    ],
)
def test_what_is_not_judged_is_named_with_its_reason(change: tuple[str, str], reason: str) -> None:
    text = FREE.replace("T: [1, 0]}, section", "M: [0.5, 0], T: [1, 0]}, section").replace(*change)
    table = member_table(da.statics(da.loads(text)))
    assert table.not_judged["beam"].startswith(reason)
    assert not table.buckling
    assert f"Buckling of beam is not judged: {reason}" in " ".join(str(table).split())


def test_factors_of_several_members_are_given_by_their_names() -> None:
    """The longer half decides: K = 1.2 over 0.6 m beside 2 over 0.4 m."""
    bent = "members: [[O, M], [M, T]], effective_length: {O-M: 1.2, M-T: [2, 0.1]}, section:"
    text = FREE.replace("T: [1, 0]}, section", "M: [0.6, 0], T: [1, 0]}, section").replace("section:", bent)
    found = judged(text, "{circle: 20 mm, elasticity: 210 GPa}")
    assert (found.member, found.effective_length) == ("M-T", (2, 0.1))
    assert found.critical == pytest.approx(PI**3 * 210e9 * 0.02**4 / 64 / 0.8**2, rel=1e-12)


def test_without_compression_there_is_no_safety() -> None:
    """Pulled, or not loaded: the critical load is printed, with no safety; a bar bent beside it says so."""
    for force, bent in (("[12 kN, 0]", False), ("[0, 0]", False), ("[-12 kN, 5 N]", True)):
        text = FREE.replace("[-12 kN, 0]", force)
        table = member_table(da.statics(da.loads(text)))
        b = table.buckling["beam"]
        assert np.isinf(b.safety) == (not bent)
        assert b.two_force == (not bent)
        assert ("bent as well" in str(table)) == bent


def test_goodman_leaves_out_a_mean_in_compression() -> None:
    """The mean from both sides of zero: in tension it costs safety, in compression it does not."""
    text = FREE.replace("elasticity: 210 GPa", "ultimate: 400 MPa, endurance: 200 MPa").replace(
        "weld, links: [ground, beam]}", "slider, links: [ground, beam], at: [O, O]}"
    )
    text = text.replace("drives: {}", "drives: {O: {position: {from: 0, to: 1, count: 2}}}")
    for low, high in ((-12e3, 12e3), (-12e3, 14e3), (-14e3, 12e3)):
        value = f"[{{against: O, x: [0, 1], y: [{low}, {high}]}}, 0]"
        found = (
            da.member_forces(da.statics(da.loads(text.replace("[-12 kN, 0]", value))), "beam")
            .stress()
            .fatigue()
        )
        mean, swing = (high + low) / 2 / 6e-4, (high - low) / 2 / 6e-4
        assert (found.mean, found.amplitude) == pytest.approx((mean, swing), rel=1e-9, abs=1e-6)
        assert found.safety == pytest.approx(1 / (swing / 200e6 + max(mean, 0) / 400e6), rel=1e-9)


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("0", "0 is not positive"),
        ("[1, 2, 3]", "a list of 3 is not an effective length; write a factor, or [in the plane, across it]"),
        ("{}", "no member has an effective length; write effective_length: {A-B: 2}"),
        ("{A-B: 1}", "'A-B' is not one of its members; the only one is 'O-T'"),
    ],
)
def test_a_wrong_factor_has_its_line_and_remedy(value: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "column.yaml"
    file.write_text(
        FREE.replace("section:", f"members: [[O, T]], effective_length: {value}, section:"), encoding="utf-8"
    )
    with pytest.raises(da.ModelError, match=r"column.yaml:5: ") as error:
        da.load(file)
    assert said in str(error.value)


def test_an_unknown_load_holds_its_point() -> None:
    """The knee of a toggle press, held by the force that is sought: both its links are between pins."""
    bar = {"rectangle": (0.02, 0.03), "elasticity": 210e9}
    m = da.load(examples()["toggle_press"]).with_values(
        {f"links.{n}.section": bar for n in ("upper", "lower")}
    )
    table = member_table(da.dynamics(m))
    assert [b.effective_length for b in table.buckling.values()] == [pytest.approx((1, 1), rel=1e-9)] * 2
    assert "moves across with other links" not in str(table)


def test_a_crank_says_that_the_push_on_it_turns() -> None:
    """Its end goes with the rod; a column that is free has no such sentence."""
    bar = {"rectangle": (0.02, 0.03), "elasticity": 210e9}
    table = member_table(
        da.dynamics(da.load(examples()["engine"]).with_values({"links.crank.section": bar}), positions=8)
    )
    assert table.buckling["crank"].effective_length == pytest.approx((2, 1), rel=1e-9)
    assert "crank: a joint at an end moves across with other links" in " ".join(str(table).split())


def test_a_dead_centre_leaves_a_crank_loose() -> None:
    """Driven by its slider: in line with the rod nothing holds the knee."""
    text = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.2, 0]}, section: {circle: 20 mm, elasticity: 210 GPa}}
  rod: {points: {A: [0, 0], B: [0.5, 0]}}
  ram: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, ram]}
  S: {type: slider, links: [ground, ram], at: [O, B]}
drives: {S: {position: 0.7}}
"""
    table = member_table(da.statics(da.loads(text)))
    assert table.not_judged["crank"].startswith("'crank' can move without bending at position 1")
    assert critical_load([1.0], [[1.0]], np.eye(4)[:, 1:]) == 0


def test_barrel_and_rod_that_do_not_reach_each_other_are_not_judged() -> None:
    table = member_table(da.statics(da.loads(CYLINDER.format(**STEPPED | {"last": 0.7}))))
    assert not table.buckling
    said = "'barrel' and 'rod' do not reach each other at position 6; let their members overlap: members: [[A, B]]"
    assert table.not_judged == {"barrel and rod": said}


def test_three_stages_of_a_telescope_are_not_judged() -> None:
    """Nor is any two of them taken for the column."""
    third = (
        "  top: {points: {Q: [0, 0], D: [0.5, 0]}, section: {circle: 30 mm, elasticity: 206 GPa}}\njoints:"
    )
    text = CYLINDER.format(**STEPPED | {"head": "D: {type: slot, links: [ground, top], at: [A, D]}"})
    text = text.replace("joints:", third).replace(
        "drives: {C:", "  T: {type: slider, links: [rod, top], at: [P, Q]}\ndrives: {T: {position: 0.6}, C:"
    )
    table = member_table(da.statics(da.loads(text.replace("on: rod, at: B", "on: top, at: D"))))
    assert not table.buckling
    assert [*table.not_judged] == ["barrel and rod and top"]


@pytest.mark.parametrize("turned", [False, True])
def test_a_cylinder_in_space_is_that_of_the_plane(turned: bool) -> None:
    """Balls at its ends, a prismatic joint inside, along any line."""
    plane = member_table(da.statics(da.loads(CYLINDER.format(**STEPPED)))).buckling["rod"]
    m = da.loads(CYLINDER.format(**STEPPED))
    tree, t = m.to_tree(), np.array([1, 2, -2]) / 3
    for name, link in tree["links"].items():
        link["points"] = {n: [float(v) for v in m.point(name, n)[0] * t] for n in link["points"]}
    axis = [float(x) for x in (-t if turned else t)]
    tree["space"] = "space"
    tree["joints"] = {"C": {"type": "prismatic", "links": ["barrel", "rod"], "at": ["A", "P"], "axis": axis}}
    tree["joints"]["A"] = {"type": "spherical", "links": ["ground", "barrel"]}
    tree["joints"]["B"] = {
        "type": "slotted_sphere_in_cylinder",
        "links": ["ground", "rod"],
        "at": ["A", "B"],
        "axis": axis,
    }
    tree["drives"]["C"]["position"] = {
        "from": -0.05 if turned else 0.05,
        "to": -0.55 if turned else 0.55,
        "count": 6,
    }
    tree["loads"]["F"]["value"] = [
        float(60e3 * x) for x in (t if turned else -t)
    ]  # turned round, it lies along -t
    b = member_table(da.statics(da.mechanism(tree))).buckling["rod"]
    assert b.criticals == pytest.approx(plane.criticals, rel=1e-9)
    assert b.safety == pytest.approx(plane.safety, rel=1e-9)


def test_a_stress_that_does_not_change_has_no_amplitude_nor_a_place_that_rounding_chooses() -> None:
    """The rod is pressed evenly at every position, with figures that differ in their last digits."""
    table = member_table(da.statics(da.loads(CYLINDER.format(**STEPPED))))
    rod, barrel = (table.stress[name].fatigue() for name in ("rod", "barrel"))
    even = -60e3 / (PI / 4 * 0.045**2)
    assert (rod.place, rod.amplitude, rod.sampling) == (0.65 / 128, 0.0, 0.0)  # of equal ones the first
    assert rod.mean == pytest.approx(even, rel=1e-12)
    pressed = -60e3 / (PI / 4 * (0.095**2 - 0.08**2))
    assert (barrel.mean, barrel.amplitude) == pytest.approx((pressed / 2, -pressed / 2), rel=1e-12)
    said = " ".join(table.text().split())
    assert "with every other position they differ by 0 % at most (barrel)." in said
    assert "barrel, rod: one stepped column, K with EI of the weaker part over the full length." in said
