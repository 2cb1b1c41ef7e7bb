"""Deflections against integrals of the moment; critical speeds against influence numbers, series and a book."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial

import dalembert as da
from dalembert.machine.shafts.beam_elements import _bent, _moved, _tilted
from tests.elements.test_pins import hung
from tests.tiers import tiers

SHAFT = """
title: Shaft with two gears, Budynas and Nisbett, Shigley's Mechanical Engineering Design, example 7-5
units: {length: in, force: lbf}
gravity: standard
links:
  ground: {points: {A: [0, 0], B: [31, 0]}}
  shaft:
    points: {A: [0, 0], B: [31, 0], C: [7, 0], D: [20, 0]}
    section: {circle: 1, elasticity: 30e6 lbf/in^2}
  gear_1: {points: {C: [0, 0]}, weight: 35 lbf}
  gear_2: {points: {D: [0, 0]}, weight: 55 lbf}
joints:
  A: {type: pin, links: [ground, shaft]}
  B: {type: slot, links: [ground, shaft]}
  C: {type: weld, links: [shaft, gear_1]}
  D: {type: weld, links: [shaft, gear_2]}
"""
STIFFNESS = 210e9 * np.pi / 64 * 0.03**4


def test_the_shaft_of_a_book() -> None:
    """Printed: influence numbers 2.061e-4, 3.534e-4, 2.224e-4 in/lbf, y 0.01945 and 0.02722 in; 1192 and 1150 rpm."""
    r = da.statics(da.loads(SHAFT))
    sag = da.member_forces(r, "shaft").deflection().members[0].at([7 * 0.0254, 20 * 0.0254])[0, :, 0]
    np.testing.assert_allclose(-sag / 0.0254, [0.01945, 0.02722], atol=1e-5)  # 5e-6, and 90 lbf times 5e-8
    c = da.critical_speeds(r, "shaft")
    assert c.rayleigh * 30 / np.pi == pytest.approx(1192, abs=0.5)
    assert c.dunkerley * 30 / np.pi == pytest.approx(1150, abs=1)
    assert c.dunkerley < c.speeds[0] < c.rayleigh
    d11, d22, d12, g = 2.061e-4, 3.534e-4, 2.224e-4, 386.1
    mass = np.array([35, 55]) / g
    exact = 1 / np.sqrt(np.linalg.eigvals(np.array([[d11, d12], [d12, d22]]) * mass))
    np.testing.assert_allclose(np.sort(exact), c.speeds, rtol=5e-4)
    assert "Dunkerley 1149.38 rpm (low), Rayleigh 1191.74 rpm (high)" in c.text()
    assert len(c.draw().items) > 10


def beam(rng: np.random.Generator, spread: bool) -> tuple[da.Mechanism, Any]:
    """A beam on two bearings, overhanging, with forces, couples and an even mass; and its numbers."""
    a, b = np.sort(rng.uniform(0, 1, 2)) + np.array([0.0, 0.3])
    length = b + rng.uniform(0, 0.5)
    at, force = rng.uniform(0, length, 3), rng.normal(size=3) * 1000
    mass = float(rng.uniform(5, 20)) if spread else 0.0
    points = {"L": [0, 0], "R": [length, 0], "A": [a, 0], "B": [b, 0]} | {
        f"P{k}": [x, 0] for k, x in enumerate(at)
    }
    shaft: Any = {"points": points, "section": {"circle": "30 mm", "elasticity": "210 GPa"}}
    shaft |= {"members": [["L", "R"]], "mass": mass, "center": [length / 2, 0], "mass_along": "uniform"}
    tree = {
        "gravity": [0, -9.81],
        "links": {"ground": {"points": {"A": [a, 0], "B": [b, 0]}}, "shaft": shaft},
        "joints": {
            "A": {"type": "pin", "links": ["ground", "shaft"]},
            "B": {"type": "slot", "links": ["ground", "shaft"]},
        },
        "loads": {
            f"F{k}": {"type": "force", "on": "shaft", "at": f"P{k}", "value": [0, float(f)]}
            for k, f in enumerate(force)
        },
    }
    return da.mechanism(tree), (a, b, length, at, force, mass)


@pytest.mark.parametrize("seed", tiers(range(3), range(3, 20)))
def test_deflection_is_the_double_integral_of_the_moment(seed: int) -> None:
    """By Macaulay's brackets: E I v'' = sum F <x - a>, which knows nothing of pieces."""
    rng = np.random.default_rng(seed)
    m, (a, b, length, at, force, mass) = beam(rng, spread=True)
    r = da.statics(m)
    load = mass * 9.81 / length
    right = (-(force * (at - a)).sum() + mass * 9.81 * (length / 2 - a)) / (b - a)
    left = mass * 9.81 - force.sum() - right
    x = np.linspace(0, length, 41)

    def bracket(start: float, power: int) -> Any:
        return np.maximum(x - start, 0.0) ** power

    v = -load * x**4 / 24 + left * bracket(a, 3) / 6 + right * bracket(b, 3) / 6
    v = v + sum(f * bracket(s, 3) / 6 for s, f in zip(at, force, strict=True))

    def at_place(p: float) -> float:
        y = -load * p**4 / 24 + left * max(p - a, 0) ** 3 / 6 + right * max(p - b, 0) ** 3 / 6
        return float(y + sum(f * max(p - s, 0) ** 3 / 6 for s, f in zip(at, force, strict=True)))

    on = np.array([at_place(a), at_place(b)])
    v = (v - on[0] - (on[1] - on[0]) * (x - a) / (b - a)) / STIFFNESS
    d = da.member_forces(r, "shaft").deflection()
    np.testing.assert_allclose(d.members[0].at(x)[0, :, 0], v, atol=1e-9 * np.abs(v).max())
    assert d.largest >= np.abs(v).max() * (1 - 1e-10)  # places are rounded to 1e-12 of the length
    assert d.largest <= np.abs(v).max() * 1.02
    slopes = d.members[0].slope(np.array([a, b]))[0, :, 0]
    np.testing.assert_allclose(np.abs(slopes), [d.slopes()[n][0] for n in "AB"], rtol=1e-9)
    step = 1e-5
    ends = d.members[0].at(np.array([a + step, a]))[0, :, 0]
    assert (ends[0] - ends[1]) / step == pytest.approx(slopes[0], rel=1e-3, abs=1e-7)


def test_an_even_beam_and_a_heavy_disc() -> None:
    """A clamped bar has (1.8751 / L)^2 sqrt(E I / m'); with a disc at its end it has the speeds of the end's influence
    numbers, and with the gyroscopic couple of I_p = 2 I_d it whirls faster."""
    bar = da.loads("""
space: space
gravity: none
links:
  ground: {points: {O: [0, 0, 0]}}
  bar: {points: {O: [0, 0, 0], T: [600 mm, 0, 0]}, section: {circle: 30 mm, elasticity: 210 GPa}}
  disc: {points: {T: [0, 0, 0]}, mass: 8 kg, inertia: [0.08, 0.04, 0.04]}
joints:
  O: {type: weld, links: [ground, bar]}
  T: {type: weld, links: [bar, disc]}
""")
    length, m = 0.6, 8.0
    c = da.critical_speeds(da.statics(bar), "bar", 2)
    d, half, turn = length**3 / 3, length**2 / 2, length
    influence = np.array([[d, half], [half, turn]]) / STIFFNESS
    for found, tilting in ((c.speeds, 0.04), (c.whirl, 0.04 - 0.08)):
        squares = np.linalg.eigvals(influence @ np.diag([m, tilting])).real
        expected = np.sort(1 / np.sqrt(squares[squares > 0]))
        np.testing.assert_allclose(found[: len(expected)], expected, rtol=1e-9)
        assert np.isinf(found[len(expected) :]).all()
    assert c.whirl[0] > c.speeds[0]
    even = da.loads("""
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  bar: {points: {O: [0, 0], T: [1, 0]}, mass: 10, center: [0.5, 0], mass_along: uniform,
        section: {circle: 30 mm, elasticity: 210 GPa}}
joints: {O: {type: weld, links: [ground, bar]}}
""")
    c = da.critical_speeds(da.statics(even), "bar", 2)
    roots = np.array([1.875104068711961, 4.694091132974175])
    np.testing.assert_allclose(c.speeds, roots**2 * np.sqrt(STIFFNESS / 10), rtol=1e-6)
    assert 0 < c.change < 1e-6


SECTION = "section: {circle: 1, elasticity: 30e6 lbf/in^2}"
GEARS = re.search(r"  gear_1: .*\n  gear_2: .*\n", SHAFT)[0]  # type: ignore[index]
WELDS = re.search(r"  C: .*\n  D: .*\n", SHAFT)[0]  # type: ignore[index]
MASSLESS = (
    "shaft 'shaft' carries no mass away from its bearings; give its mass with mass_along: uniform, or weld links with "
    "mass to it"
)
WRONG: list[tuple[dict[str, str], str]] = [
    (
        {SECTION: "section: {circle: 1}"},
        "link 'shaft' has no section with elasticity; give section: {circle: 50 mm, elasticity: 210 GPa}",
    ),
    (
        {"  B: {type: slot, links: [ground, shaft]}\n": "", "welded": "drives: {A: {position: 0}}\n"},
        "shaft 'shaft' is held at A alone; give it two bearings, or a weld",
    ),
    (
        {SECTION: f"weight: 10 lbf\n    {SECTION}"},
        "the mass of shaft 'shaft' has no place along it; write mass_along: uniform or shape, or give masses as links "
        "welded to it",
    ),
    (
        {SECTION: f"{SECTION}\n    members: [[A, C], [C, B]]"},
        "link 'shaft' has several members, and a shaft is one line; name its ends: members: [A, B]",
    ),
    ({GEARS: "", WELDS: ""}, MASSLESS),
    ({", weight: 35 lbf": "", ", weight: 55 lbf": ""}, MASSLESS),
    ({", weight: 35 lbf": "", "D: [20, 0]": "D: [31, 0]"}, MASSLESS),
]


@pytest.mark.parametrize(("changes", "says"), WRONG)
def test_what_a_shaft_needs(changes: dict[str, str], says: str) -> None:
    text = f"{SHAFT}welded"
    for old, new in {**changes, "welded": changes.get("welded", "")}.items():
        assert old in text
        text = text.replace(old, new)
    with pytest.raises(da.ModelError) as refused:
        da.critical_speeds(da.statics(da.loads(text)), "shaft")
    assert re.sub(r"^text:\d+: ", "", str(refused.value)) == says


def test_a_disc_that_only_tilts_swings_on_its_shaft() -> None:
    """In the middle of a span it turns against k = 12 E I / l, and is not carried: its weight is none."""
    text = SHAFT.replace(GEARS, "  gear_1: {points: {C: [0, 0]}, inertia: 0.1 kg*m^2}\n").replace(
        "7, 0", "15.5, 0"
    )
    c = da.critical_speeds(da.statics(da.loads(re.sub(r"\n  D: .*", "", text))), "shaft")
    inch, pound = 0.0254, 4.4482216152605
    stiff = 12 * 30e6 * pound / inch**2 * np.pi / 64 * inch**4 / (31 * inch)
    assert c.speeds == pytest.approx([np.sqrt(stiff / 0.1)], rel=1e-9)
    assert (c.dunkerley, c.rayleigh, np.abs(c.sag).max()) == (np.inf, np.inf, 0.0)
    assert "Dunkerley - rpm (low), Rayleigh - rpm (high)." in c.text()


BOSSED = """
gravity: standard
links:
  ground: {points: {A: [0, 0], B: [1, 0]}}
  shaft: {points: {A: [0, 0], B: [1, 0], C: [0.3, 0], D: [0.6, 0]}, members: [[A, B]], mass_along: shape,
          section: {circle: 0.05, elasticity: 210e9},
          shape: [{type: cylinder, between: [A, B], radius: 0.025, density: 7850}SPHERES]}
  ballsLINKS
joints:
  A: {type: pin, links: [ground, shaft]}
  B: {type: slot, links: [ground, shaft]}
"""


@pytest.mark.parametrize("balls", [{"C": 0.1}, {"C": 0.1, "D": 0.12}])
def test_balls_on_a_shaft_swing_alike_as_its_shape_and_as_links(balls: dict[str, float]) -> None:
    own, links, welds = "", "", ""
    for (name, radius), x in zip(balls.items(), (0.3, 0.6), strict=False):
        sphere = f"{{type: sphere, center: [%g, 0], radius: {radius}, density: 7850}}"
        own += f", {sphere % x}"
        links += f"  ball_{name}: {{points: {{{name}: [0, 0]}}, shape: [{sphere % 0}]}}\n"
        welds += f"  {name}: {{type: weld, links: [shaft, ball_{name}]}}\n"
    text = BOSSED.replace("  ballsLINKS\n", "")
    one = da.critical_speeds(da.statics(da.loads(text.replace("SPHERES", own))), "shaft")
    text = BOSSED.replace("SPHERES", "").replace("  ballsLINKS\n", links) + welds
    other = da.critical_speeds(da.statics(da.loads(text)), "shaft")
    assert one.speeds == pytest.approx(other.speeds, rel=1e-9)
    assert (one.dunkerley, one.rayleigh) == pytest.approx((other.dunkerley, other.rayleigh), rel=1e-9)
    said = [" ".join(line.split()) for line in one.text().splitlines()]
    for k, (radius, x) in enumerate(zip(balls.values(), ("0.3", "0.6"), strict=False)):
        name = "shaft" if len(balls) == 1 else f"shaft {k + 1}"
        assert f"{name} {7850 * 4 / 3 * np.pi * radius**3:.6g} {x}" in said
    assert f"along the shaft {7850 * np.pi * 0.025**2:.6g} -" in said


def test_a_notch_lowers_the_safety_where_it_is() -> None:
    """A crank that bends to and fro: a notch factor of 2 at its root halves the safety, at its tip not."""
    section: Any = {"rectangle": ["20 mm", "40 mm"], "ultimate": "600 MPa", "endurance": "250 MPa"}
    m = da.slider_crank(crank=0.05, rod=0.2).with_values({"links.crank.section": section})

    def safety(notch: Any) -> float:
        changed = m.with_values({"links.crank.section": {**section, "notch": notch}})
        value = da.member_forces(da.dynamics(changed), "crank").stress().fatigue().safety
        assert value is not None
        return value

    whole, root, tip = safety(2), safety({"O2": 2}), safety({"A": 2})
    plain = safety(1)
    assert (plain / whole, plain / root) == pytest.approx((2, 2), rel=1e-9)
    assert plain / tip < 1.9
    with pytest.raises(da.ModelError, match="notch at an unknown point 'Z'"):
        safety({"Z": 2})
    with pytest.raises(da.ModelError, match=r"a notch factor of 0\.5 is below 1; write K_f"):
        safety(0.5)


STEPPED = """
gravity: standard
links:
  ground: {points: {A: [0, 0], B: [0.7, 0]}}
  thick: {points: {A: [0, 0], S: [0.3, 0]}, section: {circle: 40 mm, elasticity: 210 GPa}}
  thin: {points: {S: [0, 0], T: [0.4, 0]}, section: {circle: THIN, elasticity: 210 GPa}, members: [[S, T]]}
  disc: {points: {DISC: [0, 0]}, mass: 10}
joints:
  A: {type: KIND, links: [ground, thick]}
  S: {type: weld, links: [thick, thin]}
  DISC: {type: weld, links: [HOLDS, disc]}
"""


def stepped(**words: str) -> str:
    """The text of a shaft of two sections."""
    text = STEPPED
    for word, new in words.items():
        text = text.replace(word, new)
    return text


@pytest.mark.parametrize("name", ["thick", "thin"])
@pytest.mark.parametrize("ends", ["[[S, T]]", "[[T, S]]"])
def test_a_cantilever_of_two_sections(name: str, ends: str) -> None:
    """By hand: y = P int (L - s)^2/(E I) ds, w = sqrt(P/(m y)); whichever of its pieces is named."""
    text = stepped(THIN="25 mm", DISC="T", KIND="weld", HOLDS="thin").replace("[[S, T]]", ends)
    c = da.critical_speeds(da.statics(da.loads(text)), name)
    thick, thin = (210e9 * np.pi / 64 * d**4 for d in (0.04, 0.025))
    ease = (0.7**3 - 0.4**3) / (3 * thick) + 0.4**3 / (3 * thin)
    assert c.speeds[0] == pytest.approx(1 / np.sqrt(10 * ease), rel=1e-8)
    assert np.abs(c.sag).max() == pytest.approx(10 * 9.80665 * ease, rel=1e-8)


def test_a_shaft_cut_in_two_is_the_same_shaft() -> None:
    """Of one section, with bearings on both pieces and a mass at the cut."""
    text = stepped(THIN="40 mm", DISC="D", KIND="pin", HOLDS="thick").replace(
        "S: [0.3, 0]}", "S: [0.3, 0], D: [0.2, 0]}"
    )
    text = text.replace("T: [0.4, 0]", "B: [0.4, 0]").replace("[[S, T]]", "[[S, B]]")
    text += "  B: {type: slot, links: [ground, thin]}\n"
    one = """
links:
  ground: {points: {A: [0, 0], B: [0.7, 0]}}
  shaft: {points: {A: [0, 0], B: [0.7, 0], D: [0.2, 0]}, section: {circle: 40 mm, elasticity: 210 GPa}}
  disc: {points: {D: [0, 0]}, mass: 10}
joints:
  A: {type: pin, links: [ground, shaft]}
  B: {type: slot, links: [ground, shaft]}
  D: {type: weld, links: [shaft, disc]}
gravity: standard
"""
    cut, whole = (da.critical_speeds(da.statics(da.loads(x)), n) for x, n in ((text, "thin"), (one, "shaft")))
    assert cut.speeds[0] == pytest.approx(whole.speeds[0], rel=1e-8)
    assert cut.supports == pytest.approx(whole.supports)


def test_pieces_that_leave_a_gap_are_refused() -> None:
    text = stepped(THIN="25 mm", DISC="T", KIND="weld", HOLDS="thin")
    text = text.replace("S: [0, 0], T: [0.4, 0]", "S: [0, 0], U: [0.1, 0], T: [0.4, 0]").replace(
        "[[S, T]]", "[[U, T]]"
    )
    r = da.statics(da.loads(text))
    with pytest.raises(da.ModelError, match="links 'thick' and 'thin' of a shaft do not meet end to end"):
        da.critical_speeds(r, "thick")
    with pytest.raises(da.ModelError, match="unknown link 'thik'; did you mean 'thick'"):
        da.critical_speeds(r, "thik")


def test_matrices_of_an_element_are_integrals_of_its_cubic_shapes() -> None:
    """N'' N'', N N and N' N' along an element of length h, times 1, 420 and 30, and h^3, 1/h and h."""
    h = 0.7
    shapes = [Polynomial(c) for c in ((1, 0, -3, 2), (0, h, -2 * h, h), (0, 0, 3, -2), (0, 0, -h, h))]

    def integrals(order: int) -> list[list[float]]:
        some = [shape.deriv(order) if order else shape for shape in shapes]
        return [[float((a * b).integ()(1.0)) for b in some] for a in some]

    assert _bent(h) == pytest.approx(np.array(integrals(2)))
    assert _moved(h) == pytest.approx(420 * np.array(integrals(0)))
    assert _tilted(h) == pytest.approx(30 * np.array(integrals(1)))


def test_a_beam_measured_from_other_supports_differs_by_a_straight_line() -> None:
    """One joint: from the tangent at it; both, in either order: from their chord."""
    m, (a, b, length, *_) = beam(np.random.default_rng(3), spread=True)
    f = da.member_forces(da.statics(m), "shaft")
    x = np.linspace(0, length, 41)
    (chord,) = f.deflection().members
    v, slope = (of(x)[0, :, 0] for of in (chord.at, chord.slope))
    for name, at in (("A", a), ("B", b)):
        d = f.deflection(supports=[name])
        (one,) = d.members
        turned = chord.slope(at)[0, 0, 0]
        largest = np.abs(v).max()
        assert one.at(x)[0, :, 0] == pytest.approx(v - turned * (x - at), rel=1e-9, abs=1e-12 * largest)
        assert one.slope(x)[0, :, 0] == pytest.approx(slope - turned, rel=1e-9, abs=1e-12)
        assert (one.supports, d.slopes()[name].tolist()) == ((name,), [0.0])
        assert d.largest == pytest.approx(np.abs(v - turned * (x - at)).max(), rel=0.02)
    (back,) = f.deflection(supports=["B", "A"]).members
    assert back.supports == ("B", "A")
    assert back.at(x) == pytest.approx(chord.at(x), rel=1e-9, abs=1e-12 * np.abs(v).max())


def test_two_joints_at_one_place_give_a_tangent() -> None:
    """Three bars meet in a pin: the chord of their two joints there has no direction."""
    tree = hung({"diameter": "30 mm"}).to_tree()
    tree["links"]["right"]["points"]["M"] = [0.4, 0.8]
    tree["loads"]["N"] = {"type": "force", "on": "right", "at": "M", "value": [200, -100]}
    section = {"circle": 0.03, "elasticity": 210e9}
    f = da.member_forces(da.statics(da.mechanism(tree)), "right")
    x = np.linspace(0, np.sqrt(5), 9)
    both, one, default = (f.deflection(section, supports=s).members[0] for s in ("AB", "A", ()))
    assert (both.supports, one.supports, default.supports) == (("A",), ("A",), ("B",))  # B is driven
    assert np.abs(one.at(x)).max() > 1e-5
    assert both.at(x).tolist() == one.at(x).tolist()
    assert default.at(x) == pytest.approx(one.at(x), rel=1e-9, abs=1e-15)


def test_the_arms_of_a_bent_cantilever_are_each_measured_from_where_they_begin() -> None:
    """F1 L^3 / 3 E I of the far arm; of the near one the far arm's force and couple, F2 L^3 / 3 - F1 a L^2 / 2."""
    text = """
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [1, 0], P: [1, 0.5]}, members: [[O, A], [A, P]],
        section: {rectangle: [20 mm, 40 mm], elasticity: 200 GPa}}
joints: {O: {type: weld, links: [ground, arm]}}
loads: {F: {type: force, on: arm, at: P, value: [300 N, 50 N]}}
"""
    d = da.member_forces(da.statics(da.loads(text)), "arm").deflection()
    bend = 200e9 * 0.02 * 0.04**3 / 12
    near, far = (50 / 3 - 300 * 0.5 / 2) / bend, -300 * 0.5**3 / 3 / bend
    assert [e.curve.name for e in d.members] == ["O-A", "A-P"]
    assert [float(e.at(e.curve.member.length)[0, 0, 0]) for e in d.members] == pytest.approx(
        [near, far], rel=1e-12
    )
    assert [float(e.slope(e.curve.member.length)[0, 0, 0]) for e in d.members] == pytest.approx(
        [(50 / 2 - 300 * 0.5) / bend, -300 * 0.5**2 / 2 / bend], rel=1e-12
    )
    assert d.member == ("O-A",)
    assert d.largest == pytest.approx(-near, rel=1e-12)
    assert d.place.tolist() == [1.0]


def test_an_even_shaft_has_as_many_critical_speeds_as_are_asked_for() -> None:
    """pi^2 n^2 sqrt(E I/(m L^3)): the 36th is 1296 times the first; those of elements are a little higher."""
    shaft: Any = {
        "points": {"A": [0, 0], "B": [1, 0]},
        "mass": 15.4,
        "center": [0.5, 0],
        "mass_along": "uniform",
    }
    shaft["section"] = {"circle": "50 mm", "elasticity": "210 GPa"}
    tree = {
        "links": {"ground": {"points": {"A": [0, 0], "B": [1, 0]}}, "shaft": shaft},
        "joints": {
            n: {"type": kind, "links": ["ground", "shaft"]} for n, kind in (("A", "pin"), ("B", "slot"))
        },
    }
    c = da.critical_speeds(da.statics(da.mechanism(tree)), "shaft", count=36)
    n = np.arange(1, 37)
    exact = np.pi**2 * n**2 * np.sqrt(210e9 * np.pi / 64 * 0.05**4 / 15.4)
    assert len(c.speeds) == 36
    assert (c.speeds[:4] / exact[:4]) == pytest.approx([1] * 4, rel=1e-5)  # of cubic elements
    assert (c.speeds >= exact * (1 - 1e-9)).all()
    assert c.speeds[-1] / exact[-1] < 1.2


IN_SPACE = """
space: space
links:
  ground: {points: {A: [0, 0, 0], B: [1, 0, 0]}}
  shaft: {points: {A: [0, 0, 0], B: [1, 0, 0], C: [0.4, 0, 0]}, section: {circle: 40 mm, elasticity: 210 GPa},
          members: [[A, B]]}
  disc: {points: {C: [0, 0, 0]}, mass: 20, inertia: %s}
joints:
  A: {type: spherical, links: [ground, shaft]}
  B: {type: slotted_sphere, links: [ground, shaft], axis: [1, 0, 0]}
  C: {type: weld, links: [shaft, disc]}
"""


@pytest.mark.parametrize(
    "inertia",
    [
        "[0.8, 0.4, 0.4]",
        "[[0.8, 0, 0], [0, 0.4, 0], [0, 0, 0.4]]",
        "[[0.8, 0, 0], [0, 0.3, 0.05], [0, 0.05, 0.5]]",
    ],
)
def test_a_disc_between_bearings_tilts_and_whirls(inertia: str) -> None:
    """Influence numbers a^2 b^2, a b (b - a) and a^2 - a b + b^2 over 3 E I l; whirl has J_d - J_p, here below zero."""
    c = da.critical_speeds(da.statics(da.loads(IN_SPACE % inertia)), "shaft")
    a, b, stiff = 0.4, 0.6, 210e9 * np.pi / 64 * 0.04**4
    across = a * b * (b - a)
    influence = np.array([[a**2 * b**2, across], [across, a**2 - a * b + b**2]]) / (3 * stiff)
    for found, tilting in ((c.speeds, 0.4), (c.whirl, 0.4 - 0.8)):
        squares = np.linalg.eigvals(influence @ np.diag([20.0, tilting]))
        known = np.sort(1 / np.sqrt(squares[squares > 0]))
        assert found[: len(known)] == pytest.approx(known, rel=1e-9)
        assert np.isinf(found[len(known) :]).all()
