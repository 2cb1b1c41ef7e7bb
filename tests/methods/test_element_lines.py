"""Reports on screws, belts, chains and friction circles: their equations and verdicts have the numbers of the laws."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases
from dalembert.model.library import template
from dalembert.reports.design.design_report import design_sheet
from dalembert.reports.design.element_parts import element_parts
from dalembert.reports.design.given_parts import stated
from dalembert.reports.design.power_parts import balance_part
from dalembert.reports.design.verdict import DesignContext
from dalembert.reports.sections.terms import about
from dalembert.reports.sheet import Equations, Paragraph, SheetTable, Working


def lines(r: da.Result) -> list[Working]:
    """All equations of a report."""
    return [line for b in da.report(r).sheet.blocks if isinstance(b, Equations) for line in b.lines]


def changed(name: str, *path: str, **keys: Any) -> Any:
    """A template with other keys at a path, those without a value left out."""
    tree: Any = template(name).to_tree()
    part = tree
    for key in path:
        part = part[key]
    part |= keys
    for key in [k for k, v in keys.items() if v is None]:
        del part[key]
    return da.mechanism(tree)


def jack(speed: str, mu: float) -> da.Result:
    screw = template("screw_jack").to_tree()["drives"]["S"]["screw"]
    screw = screw | {"friction": {"coefficient": mu}, "collar": {"radius": "0.025 m", "coefficient": mu}}
    return da.solve(changed("screw_jack", "drives", "S", position=0, speed=speed, screw=screw))


@pytest.mark.parametrize(
    ("speed", "mu", "letters"),
    [
        ("5 mm/s", 0.12, "eta = frac(F_{12,d} l; 2 pi M)"),
        ("-5 mm/s", 0.005, "eta = frac(2 pi M; F_{12,d} l)"),
        ("-5 mm/s", 0.12, "eta = 0"),
    ],
)
def test_the_efficiency_of_a_jack_is_the_work_gained_over_the_work_spent(
    speed: str, mu: float, letters: str
) -> None:
    """Lifting the screw works on the load; let down, the load on the screw; with much friction both are spent."""
    r = jack(speed, mu)
    (line,) = [x for x in lines(r) if x.letters.startswith("eta")]
    assert line.letters == letters
    a = r.screw("S")
    if letters == "eta = 0":
        assert (line.numbers, line.result) == ("", '"as the load gives work too"')
        assert float(a.efficiency[0]) == 0
        return
    gain = abs(float(a.force[0])) * 0.006 / (2 * math.pi * abs(float(a.torque[0])))
    eta = gain if speed[0] != "-" else 1 / gain
    assert 0 < eta < 1
    assert float(line.result) == pytest.approx(eta, rel=5e-4)


WRAP = math.pi - 2 * math.asin((0.18 - 0.06) / 0.5)
"""Wrap of the small wheel of the belt drive."""


@pytest.mark.parametrize("friction", [None, {"coefficient": 0.3}])
def test_a_belt_needs_the_friction_of_eytelwein(friction: Any) -> None:
    r = da.solve(changed("belt_drive", "joints", "belt", friction=friction), positions=1)
    belt = r.belt("belt")
    last = [x for x in lines(r) if "mu" in x.letters][-1]
    tight, slack = float(belt.tight[0]), float(belt.slack[0])
    speed = abs(float(belt.speed[0]))
    rubbed = 0.2 * speed**2
    needed = math.log((tight - rubbed) / (slack - rubbed)) / WRAP
    number, words = re.fullmatch(r"([\d.]+) (.*)", last.result).groups()  # type: ignore[union-attr]
    assert float(number) == pytest.approx(needed, rel=5e-4)
    assert words == ('"that it needs; it has 0.3000"' if friction else '"that it needs"')
    (verdict,) = [v for part in element_parts(DesignContext(r, 0, da.Notation())) for v in part.verdicts]
    assert (verdict.item, verdict.value) == ("belt, slip", f"tight {tight:.3f} N, slack {slack:.3f} N")
    if friction:
        assert (verdict.state, verdict.margin) == ("ok", pytest.approx(0.3 / needed, rel=1e-9))
    else:
        assert (verdict.state, verdict.remark) == ("not judged", "it has no friction")


def test_a_chain_cannot_slip_and_has_no_equation_of_it() -> None:
    m = changed("belt_drive", "joints", "belt", chain=True, friction=None, mass_per_length=None, tension=None)
    found = lines(da.solve(m, positions=1))
    names = [x.letters for x in found]
    assert not [x for x in names if "mu" in x]
    at = names.index("T_{1}")
    assert [(x.letters, x.result) for x in found[at : at + 2]] == [("T_{1}", '83.33 "N"'), ("T_{2}", '0 "N"')]


@pytest.mark.parametrize(("a", "b"), [(30, 60), (60, 30), (40, 40)])
def test_a_tangent_has_the_larger_circle_first(a: int, b: int) -> None:
    """The sine of its angle with the line of the pins is the sum of their radii over the length, of 1250 mm."""
    m = da.load(cases()["seed-002-7a-engine-friction-circles"])
    r = da.dynamics(
        m.with_values({"joints.A.friction.radius": f"{a} mm", "joints.B.friction.radius": f"{b} mm"})
    )
    (line,) = [x for x in lines(r) if "arcsin" in x.letters]
    first, second = ("A", "B") if a >= b else ("B", "A")
    assert line.letters == f"beta_{{3}} = arcsin (frac(r_{{{first}}} + r_{{{second}}}; AB))"
    radii = {n: float(da.friction_circles(r, n).radii[0]) for n in "AB"}
    numbers = [float(x) for x in re.findall(r"\d+\.\d+", line.numbers)]
    assert numbers == pytest.approx([radii[first], radii[second], 1.25], rel=5e-4)
    turn = math.degrees(math.asin((radii["A"] + radii["B"]) / 1.25))
    assert float(line.result.split()[0]) == pytest.approx(turn, abs=6e-4)


@pytest.mark.parametrize(
    ("turn", "speed", "smooth"), [(20, 1, ""), (110, -1, ""), (200, 1, ""), (290, 1, "A"), (140, -1, "B")]
)
def test_the_tangent_has_the_direction_of_the_rods_force(turn: int, speed: float, smooth: str) -> None:
    """From the line of the pins by the angle of the friction circles, whichever way the machine turns; of a smooth pin
    the circle is a point. The words say on which sides of the line the circles are touched."""
    m = da.load(cases()["seed-002-7a-engine-friction-circles"])
    values: dict[str, Any] = {"drives.O.position": math.radians(turn), "drives.O.speed": speed}
    r = da.dynamics(m.with_values(values | ({f"joints.{smooth}.friction.radius": 0.0} if smooth else {})))
    found = lines(r)
    (k,) = [n for n, x in enumerate(found) if "arcsin" in x.letters]
    span = r.point("rod", "B")[0] - r.point("rod", "A")[0]
    along = math.degrees(math.atan2(span[1], span[0]))
    turned, line = float(found[k].result.split()[0]), found[k + 1]
    sign = -1 if "−" in line.letters else 1
    assert turned >= 0
    assert line.letters == f"theta_{{AB}} {'−' if sign < 0 else '+'} beta_{{3}}"
    numbers = [
        float(x.replace("−", "-")) for x in re.findall(r"−?\d+\.\d+", line.numbers.replace("deg − ", "deg "))
    ]
    assert numbers == pytest.approx([along, turned], abs=6e-3)
    total = float(line.result.replace("−", "-").split()[0])
    assert total == pytest.approx(along + sign * turned, abs=6e-3)
    x, y = r.reaction("A", on="rod")[0]
    assert math.remainder(total - math.degrees(math.atan2(y, x)), 180) == pytest.approx(0, abs=6e-3)


@pytest.mark.parametrize(
    ("count", "said"), [(1, "1, 1 of them solved"), (5, "5, 5 of them solved, from 0° to 288°")]
)
def test_a_design_report_says_its_positions(count: int, said: str) -> None:
    sheet = design_sheet(da.dynamics(da.four_bar(), positions=count))
    rows = [row for b in sheet.blocks if isinstance(b, SheetTable) for row in b.rows]
    assert [row[1] for row in rows if row[0] == "Positions"] == [said]


def test_counterweights_are_put_on_links_with_a_mass_that_turn_about_the_ground() -> None:
    """A slider-crank of which only the rod and the piston have a mass."""
    tree: Any = da.slider_crank(crank=0.05, rod=0.2).to_tree()
    del tree["links"]["crank"]["mass"], tree["links"]["crank"]["inertia"]
    r = da.dynamics(da.mechanism(tree), positions=8)
    said = "no link with a mass turns about the ground, where a counterweight is put"
    with pytest.raises(da.ModelError, match=f"^{said}$"):
        list(balance_part(DesignContext(r, 0, da.Notation())))


@pytest.mark.parametrize(
    ("place", "axis", "index"),
    [
        ("A", "x", "Ax"),
        ("AB", "y", "ABy"),
        ("piston", "x", "piston,x"),
        ("piston", "", "piston"),
        ("O2b", "z", "O2b,z"),
    ],
)
def test_an_axis_stands_behind_a_place_by_a_comma_where_it_is_a_word(
    place: str, axis: str, index: str
) -> None:
    assert about(place, axis) == index


def test_values_of_a_description_are_stated_with_their_units() -> None:
    """A parameter by its value, a length as written in another unit, what is no quantity as it is."""
    tree: Any = da.four_bar(positions=1).to_tree() | {"parameters": {"w": "25 mm"}}
    tree["links"]["crank"]["section"] = {"rectangle": ["w", "2 cm"], "elasticity": "206 GPa"}
    c = DesignContext(da.dynamics(da.mechanism(tree)), 0, da.Notation())
    assert [stated(c, x) for x in ("w", "20e-3 m", "2 apples", 3)] == ["0.025 m", "0.02 m", "2 apples", "3"]
    assert stated(c, {"plate_size": ["w", "0.02 m"]}) == "plate size [0.025 m, 0.02 m]"
    assert stated(c, [{"a": "w"}, "1 m"]) == "[a 0.025 m; 1 m]"
    assert stated(c, [{"a": "w"}, {"b": "1 m"}]) == "[a 0.025 m; b 1 m]"


@pytest.mark.parametrize("hinges", [2, 3])
def test_all_unknowns_of_a_system_solved_as_one_are_listed(hinges: int) -> None:
    """A flap on hinges in a row, of which each carries five numbers, and a torque: three abreast, none left out."""
    points = {f"H{k}": [0, 0, 0.5 * k] for k in range(hinges)}
    flap = {"points": points, "mass": 3, "center": [0.4, 0, 0.5], "inertia": [0.1, 0.2, 0.3]}
    m = da.mechanism(
        {
            "space": "space",
            "gravity": [0, -9.81, 0],
            "links": {"ground": {"points": points}, "flap": flap},
            "joints": {
                h: {"type": "revolute", "links": ["ground", "flap"], "axis": [0, 0, 1]} for h in points
            },
            "drives": {"H0": {"position": 0.3}},
        }
    )
    blocks = da.report(da.statics(m)).sheet.blocks
    count = 5 * hinges + 1
    said = f"All links: 6 equations with {count} unknowns, assembled from those above and solved as one."
    assert [b.text for b in blocks if isinstance(b, Paragraph) and "solved as one" in b.text] == [said]
    (table,) = [b for b in blocks if isinstance(b, SheetTable) and list(b.heads) == ["Unknown", "Value"] * 3]
    names = [cell for column in (0, 2, 4) for row in table.rows if (cell := row[column])]
    assert len(set(names)) == len(names) == count
    assert all(bool(row[c]) is bool(row[c + 1]) for row in table.rows for c in (0, 2, 4))


TAPPET = """units: {length: mm, mass: kg, force: N}
links: {ground: {points: {O: [0, 0]}}, cam: {points: {O: [0, 0]}}, stem: {points: {F: [0, 0]}, mass: 0.5}}
joints:
  O: {type: pin, links: [ground, cam]}
  guide: {type: slider, links: [ground, stem], at: [O, F], direction: 90}
  F: {type: cam, links: [cam, stem], at: [O, F], follower: flat, contact: pushes,
      profile: {base: 30, segments: [{to: 10, in: 90, by: cycloidal}, {to: 0, in: 90, by: cycloidal}, {dwell: rest}]}}
drives: {O: {position: {from: 0, to: 180, count: 37}, speed: SPEED rad/s}}
loads: {S: {type: force, on: stem, at: F, value: [0, -60]}}
"""


@pytest.mark.parametrize(("speed", "holds"), [(20, True), pytest.param(90, False, marks=pytest.mark.long)])
def test_a_flat_tappet_is_judged_by_its_curvature_and_its_least_force(speed: int, holds: bool) -> None:
    """No undercut where base, lift and its second derivative by the turn are positive together: s is cycloidal."""
    r = da.solve(da.loads(TAPPET.replace("SPEED", str(speed))))
    found = [v for part in element_parts(DesignContext(r, 0, da.Notation())) for v in part.verdicts]
    base, contact = found
    x, beta, h = np.linspace(0, 1, 200_001), math.pi / 2, 0.01
    lift, second = (
        h * (x - np.sin(2 * math.pi * x) / (2 * math.pi)),
        h * 2 * math.pi / beta**2 * np.sin(2 * math.pi * x),
    )
    least = float((-(lift + second)).max())
    assert base.item == "base radius of F, no undercut"
    assert base.margin == pytest.approx(0.03 / least, rel=1e-6)
    assert (base.state, base.value) == ("ok", f"least {1000 * least:.4f} mm")
    turn = np.arange(37) * 5.0
    rise, fall = (np.interp(some, np.degrees(x * beta), second) for some in (turn, turn - 90))
    push = 60 + 0.5 * np.where(turn <= 90, rise, -fall) * speed**2
    assert bool((push > 0).all()) is holds
    assert (contact.item, contact.state) == ("contact F", "ok" if holds else "exceeded")
    k = int(push.argmin())
    assert contact.value == f"least normal force {push[k]:.4f} N"
    assert contact.at.endswith(f"(no. {k + 1})")


@pytest.mark.parametrize("speed", [20, -20])
def test_the_torque_of_a_clutch_is_given_by_its_size(speed: float) -> None:
    """Either way round, at the position where it is largest."""
    r = da.solve(changed("plate_clutch", "drives", "A", speed=f"{speed} rad/s"), positions=1)
    (name,) = (n for n, j in r.mechanism.joints.items() if j.BRAKES)
    verdict = next(
        v
        for part in element_parts(DesignContext(r, 0, da.Notation()))
        for v in part.verdicts
        if v.item == f"torque of {name}"
    )
    assert float(verdict.value.split()[0]) == pytest.approx(abs(float(r.brake(name).torque[0])), rel=1e-4)
