"""Engines by the general mechanism: closed forms, the books' harmonics, couples, firing orders; rotors."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from tests.machine.closed_forms import crank_points, shaking_of, turn


def test_a_radial_engine_of_three() -> None:
    m = da.radial_engine(cylinders=3, crank=0.06, rod=0.24, piston_mass=1.0, speed=80 * math.pi)
    lines = [2 * math.pi * k / 3 for k in range(3)]
    expected = sum(
        shaking_of([(1.0, crank_points(turn(576), 0.06, 0.24, b)[1])], 80 * math.pi) for b in lines
    )
    assert da.shaking(da.dynamics(m)).force == pytest.approx(expected[::8], abs=1e-9 * 7105)


def order(m: Any, k: int, of: str = "force") -> float:
    return float(np.abs(da.shaking(da.dynamics(m)).harmonics([k], of).amplitude).max())


def test_what_engines_in_line_leave() -> None:
    four, six = da.in_line_engine(), da.in_line_engine(cylinders=6)
    single = da.in_line_engine(cylinders=1)
    assert order(four, 1) < 1e-8
    assert order(four, 2) == pytest.approx(4 * order(single, 2))
    assert order(four, 2, "couple") < 1e-8
    assert max(order(six, k) for k in (1, 2, 4)) < 1e-8
    assert max(order(six, k, "couple") for k in (1, 2)) < 1e-8
    assert order(six, 6) == pytest.approx(6 * order(single, 6), rel=1e-6)
    assert da.engine_series(da.dynamics(six)).loss == pytest.approx(1.0, abs=1e-6)  # all that is left
    three = da.in_line_engine(cylinders=3)
    assert order(three, 1) < 1e-8
    arm = abs(sum(z * np.exp(2j * math.pi * k / 3) for z, k in ((-0.09, 0), (0, 2), (0.09, 1))))
    r = da.dynamics(three)
    going = (0.45 + 0.2) * 0.045 * (100 * math.pi) ** 2
    along = da.shaking(r).harmonics([1], "couple").amplitude[0]
    assert along[1] == pytest.approx(going * arm + 0.4 * 0.045 * (100 * math.pi) ** 2 * arm, rel=1e-6)


def test_firing_orders_set_throws_and_gas() -> None:
    m = da.in_line_engine(firing_order=(1, 2, 4, 3), gas=1e4)
    points = m.points("crank")
    assert [points[f"A_{k}"][0] > 0 for k in (1, 2, 3, 4)] == [True, False, False, True]
    r = da.dynamics(m)
    torque = r.effort("O")
    assert np.allclose(torque, np.roll(torque, 36), rtol=1e-9, atol=1e-6)  # four times in two turns
    assert da.shaking(r).parts["external"][0].max() == 0
    with pytest.raises(ModelError, match=r"firing order \(1, 1, 2, 3\) of 4 cylinders"):
        da.in_line_engine(firing_order=(1, 1, 2, 3))
    with pytest.raises(ModelError, match="3 cylinders are not pairs"):
        da.v_engine(cylinders=3)


def test_the_text_has_both_series() -> None:
    said = str(da.shaking(da.dynamics(da.in_line_engine())))
    assert "4 cylinders, by the book's two harmonics: its force is off by 4.61 %" in said.replace("\n", " ")
    one = str(da.shaking(da.dynamics(da.slider_crank())))
    assert "1 cylinder, by the book's two harmonics: its force is off by 0.51 %" in one.replace("\n", " ")


def test_a_couple_needs_a_place() -> None:
    with pytest.raises(
        ModelError, match="unknown shaking quantity 'couple'; use force, moment, or couple, for which"
    ):
        da.shaking(da.dynamics(da.v_engine(), positions=12)).harmonics(1, "couple")


def test_a_place_belongs_to_the_plane() -> None:
    with pytest.raises(ModelError, match="a place along the normal is for planar mechanisms only"):
        da.loads("space: space\nlinks: {ground: {}, a: {place: 1}}")


def test_a_rotor_in_two_planes_leaves_its_bearings_alone() -> None:
    m = da.rotating_shaft().with_values({"gravity": None})
    fast = da.dynamics(m)
    found = da.balance_rotor(m, (0.05, 0.45), (0.04, 0.06))
    after = da.dynamics(found.mechanism)
    bearings = [j for j, joint in m.joints.items() if "ground" in joint.links]
    size = max(float(np.abs(fast.reaction(j)).max()) for j in bearings)
    assert size > 1
    assert max(float(np.abs(after.reaction(j)).max()) for j in bearings) < 1e-9 * size
    assert np.abs(after.effort(after.drives[0])).max() < 1e-9 * size
    with pytest.raises(ModelError, match="give two planes"):
        da.balance_rotor(m, (0.1, 0.1), (0.04, 0.06))
    with pytest.raises(ModelError, match=r"use da\.balance"):
        da.balance_rotor(da.four_bar(), (0.1, 0.2), (0.04, 0.06))


SHAFT = """
space: space
units: {length: mm}
links:
  ground: {points: {S: [0, 0, 0], E: [0, 0, 900]}}
  shaft: {points: {S: [0, 0, 0], E: [0, 0, 900], %s}}
%sjoints:
  S: {type: spherical, links: [ground, shaft]}
  E: {type: sphere_in_cylinder, links: [ground, shaft], axis: [0, 0, 1]}
%sdrives:
  S: {freedom: turn, axis: [0, 0, 1], position: {from: 0, to: 360, count: 12}, speed: 100 rpm}
"""


def shaft_with_masses(*masses: tuple[float, float, float, float]) -> str:
    """Of kg, mm from the axis, degrees, and mm along the axis, each a link on a shaft without mass."""
    turned = [(m, r * math.cos(math.radians(a)), r * math.sin(math.radians(a)), z) for m, r, a, z in masses]
    points = [f"m{k}: [{x}, {y}, {z}]" for k, (_, x, y, z) in enumerate(turned)]
    links = [f"  m{k}: {{points: {{m{k}: [0, 0, 0]}}, mass: {m}}}\n" for k, (m, *_) in enumerate(turned)]
    joints = [f"  m{k}: {{type: weld, links: [shaft, m{k}]}}\n" for k in range(len(turned))]
    return SHAFT % (", ".join(points), "".join(links), "".join(joints))


def test_the_command_balances_four_masses_in_two_planes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Khurmi and Gupta, Theory of Machines, example 21.2, read off its drawings: 355 kg at 145 deg and 182.5 kg at
    12.6 deg, against the turn, where the exact angle of the first is 146.6."""
    file = tmp_path / "shaft.yaml"
    masses = ((200, 80, 0, 100), (300, 70, 45, 400), (400, 60, 115, 500), (200, 80, 235, 800))
    file.write_text(shaft_with_masses(*masses))
    asked = ["balance", str(file), "--planes", "200mm,600mm", "--radii", "100"]
    drawing, balanced = tmp_path / "r.svg", tmp_path / "balanced.yaml"
    assert main([*asked, "--drawing", str(drawing), "--output", str(balanced), "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)["rotor"]
    assert found["corrections"]["mass"] == pytest.approx([355, 182.5], rel=0.01)
    assert np.degrees(found["corrections"]["angle"]) == pytest.approx([-145, -12.6], abs=2)
    u = [m * r / 1e3 * np.exp(1j * math.radians(a)) for m, r, a, _ in masses]
    s, t = sum(u), sum(u_k * z / 1e3 for u_k, (*_, z) in zip(u, masses, strict=True))
    exact = [-(0.6 * s - t) / 0.4, -(t - 0.2 * s) / 0.4]
    assert found["corrections"]["moment"] == pytest.approx(np.abs(exact), rel=1e-12)
    assert found["corrections"]["angle"] == pytest.approx(np.angle(exact), abs=1e-12)
    assert [found["unbalance"][name] for name in ("force", "couple")] == pytest.approx([abs(s), abs(t)])
    assert found["after"]["force"]["max"] < 1e-9 * found["before"]["force"]["max"]
    assert "Magnitude of the shaking force" in drawing.read_text()
    assert da.shaking(da.dynamics(da.load(balanced)), about="S").moment.max() < 1e-6
    assert main([*asked, "--report", str(tmp_path / "r.txt")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Planes along the axis from S, in the sense in which the shaft turns" in said
    assert "Rotor balanced in two planes" in (tmp_path / "r.txt").read_text()
    for wrong in (asked[:4], asked[:2], [*asked, "--on", "shaft"]):
        assert main(wrong) == 2


@pytest.mark.parametrize("speed", [200.0, -200.0])
def test_the_books_series_is_that_of_its_formula(speed: float) -> None:
    """m r w^2 (cos q + l cos 2 q) of piston and the rod's end, the rest at the crank pin, at every position."""
    crank, rod, piston, bar = 0.05, 0.2, 0.6, 0.4
    m = da.slider_crank(crank=crank, rod=rod).with_values(
        {
            "drives.O2.speed": speed,
            "links.piston.mass": piston,
            "links.rod.mass": bar,
            "links.crank.mass": 0.0,
        }
    )
    r = da.dynamics(m, positions=36)
    e, q = da.engine_series(r), r.drive_position("O2")
    share = m.center("rod")[0] / rod
    going, turning = piston + bar * share, bar * (1 - share)
    x = crank * speed**2 * (going * (np.cos(q) + crank / rod * np.cos(2 * q)) + turning * np.cos(q))
    y = crank * speed**2 * turning * np.sin(q)
    assert e.force == pytest.approx(np.stack([x, y], axis=-1), abs=1e-9 * np.abs(x).max())
    root = np.sqrt(rod**2 - (crank * np.sin(turn(720))) ** 2)
    path = crank * np.cos(turn(720)) + root
    wave = np.fft.rfft(path)
    k = np.arange(len(wave))
    second = np.fft.irfft(-(k**2) * wave, 720)[::20]
    exact = -(speed**2) * going * second + crank * speed**2 * turning * np.cos(q)
    assert e.exact.parts["inertia"][0][:, 0] == pytest.approx(exact, abs=1e-8 * np.abs(x).max())
    off = np.abs(exact - x).max() / np.hypot(exact, y).max()
    assert e.loss == pytest.approx(off, rel=1e-6)


def test_what_the_series_leaves_out_falls_with_the_third_power_of_crank_over_rod() -> None:
    """Also while the crank is accelerated: of its terms none is missing and none has another sign."""
    off = []
    for rod in (0.5, 5.0):
        numbers = {"speed": 3.0, "acceleration": 70.0}
        m = da.slider_crank(crank=0.05, rod=rod).with_values(
            {f"drives.O2.{k}": v for k, v in numbers.items()}
        )
        m = m.with_values({"links.rod.mass": 0.4, "links.crank.mass": 0.0})
        e = da.engine_series(da.dynamics(m, positions=24))
        exact = e.exact.parts["inertia"][0]
        off.append(float(np.abs(e.force - exact).max() / np.abs(exact).max()))
    assert off[0] < 2e-4
    assert off[1] == pytest.approx(1e-3 * off[0], rel=0.01)


def test_a_balanced_rotor_and_a_pure_couple_have_true_sentences() -> None:
    """The unbalance left is compared with the corrections: S of a pure couple is rounding, and no measure."""
    m = da.rotating_shaft()
    once = da.balance_rotor(m, (0.05, 0.45), (0.04, 0.04))
    again = da.balance_rotor(once.mechanism, (0.05, 0.45), (0.04, 0.04))
    assert again.moment.sum() < 1e-9 * once.moment.sum()
    assert once.residual < 1e-12
    couple = da.loads(shaft_with_masses((2, 50, 30, 200), (2, 50, 210, 700)))
    b = da.balance_rotor(couple, (0.1, 0.8), (0.05, 0.05))
    assert abs(b.unbalance[0]) < 1e-15
    assert b.residual < 1e-12
    said = " ".join(str(b).split())
    assert "Recomputed with both corrections, the unbalance left is " in said
    level = da.balance_rotor(
        da.loads(shaft_with_masses((2, 50, 30, 200), (2, 50, 210, 200))), (0.1, 0.8), (0.05, 0.05)
    )
    assert not level.moment.any()
    assert "The rotor was balanced already: no correction is needed." in " ".join(str(level).split())


def test_a_toggle_whose_knee_swings_is_no_engine() -> None:
    r = da.dynamics(da.toggle_press())
    with pytest.raises(da.ModelError, match="the crank of ram, swings"):
        da.engine_series(r)
    assert "two harmonics" not in str(da.shaking(r))
    assert "4 cylinders" in str(
        da.shaking(da.dynamics(da.in_line_engine(cylinders=4, firing_order=(1, 3, 4, 2))))
    )


@pytest.mark.parametrize("offset", [0.01, -0.01])
def test_an_offset_piston_has_no_series(offset: float) -> None:
    r = da.dynamics(da.slider_crank(crank=0.05, rod=0.2, offset=offset), positions=4)
    with pytest.raises(da.ModelError, match=r"the line of piston passes the crank by 0\.01 m"):
        da.engine_series(r)


BOXER = """
links:
  ground: {points: {O: [0, 0]}}
  throw: {points: {O: [0, 0], A: [0.05, 0]}, mass: 2, center: [0.01, 0], inertia: 0.01}
  other: {points: {O: [0, 0], B: [-0.05, 0]}, mass: 2, center: [-0.01, 0], inertia: 0.01}
  rod_1: {points: {A: [0, 0], P: [0.2, 0]}, mass: 0.6, center: [0.06, 0], inertia: 0.003}
  rod_2: {points: {B: [0, 0], P: [0.2, 0]}, mass: SECOND, center: [0.06, 0], inertia: 0.003}
  piston_1: {points: {P: [0, 0]}, mass: 1}
  piston_2: {points: {P: [0, 0]}, mass: 1}
joints:
  O: {type: pin, links: [ground, throw]}
  W: {type: weld, links: WELDED, at: O}
  A: {type: pin, links: [throw, rod_1]}
  B: {type: pin, links: [other, rod_2]}
  P_1: {type: pin, links: [rod_1, piston_1], at: P}
  P_2: {type: pin, links: [rod_2, piston_2], at: P}
  G_1: {type: slider, links: [ground, piston_1], at: [O, P]}
  G_2: {type: slider, links: [ground, piston_2], at: [O, P]}
drives: {O: {position: {from: 0, to: 360, count: 36}, speed: 300 rad/s}}
assembly: {rod_2: 180, piston_1: [0.25, 0, 0], piston_2: [-0.25, 0, 0]}
"""


@pytest.mark.parametrize("welded", ["[throw, other]", "[other, throw]"])
def test_a_throw_welded_to_the_shaft_is_one_of_the_engine(welded: str) -> None:
    """Opposed cylinders on opposite throws leave no force; with a lighter rod, that of the part in its place."""
    m = da.loads(BOXER.replace("WELDED", welded).replace("SECOND", "0.6"))
    e = da.engine_series(da.dynamics(m))
    assert [(c.piston, c.rod, c.crank, c.pin, c.gudgeon, c.guide, c.axis) for c in e.cylinders] == [
        ("piston_1", "rod_1", "throw", "A", "P_1", "G_1", "O"),
        ("piston_2", "rod_2", "other", "B", "P_2", "G_2", "O"),
    ]
    assert np.abs(e.force).max() < 1e-9
    text = " ".join(da.shaking(e.exact.result).text().split())
    assert "2 cylinders, by the book's two harmonics: no inertia force is left." in text
    light = da.engine_series(da.dynamics(m.with_values({"links.rod_2.mass": 0.2})))
    q, pin, gudgeon = (
        turn(36),
        0.4 * 0.7,
        0.4 * 0.3,
    )  # what the lighter rod lacks, at its pin and at its gudgeon
    going = 0.05 * 300**2 * (np.cos(q) + 0.25 * np.cos(2 * q))
    expected = pin * 0.05 * 300**2 * np.stack([np.cos(q), np.sin(q)], -1)
    expected[:, 0] += gudgeon * going
    assert light.force == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


def test_the_table_of_harmonics_has_the_exact_ones_and_the_books() -> None:
    """Of four cylinders in line the first order is 0, but for rounding; the book has the second, and no fourth."""
    r = da.dynamics(da.in_line_engine())
    table = next(part for part in da.shaking(r).text().split("\n\n") if part.startswith("inertia  order"))
    rows = {int(row.split()[2]): [float(x) for x in row.split()[3:]] for row in table.splitlines()[2:6]}
    e = da.engine_series(r)
    q = r.drive_position("O")
    exact, book = (da.harmonics(v, q, [1, 2, 4, 6]) for v in (e.exact.parts["inertia"][0], e.force))
    assert list(rows) == [1, 2, 4, 6]
    for k, row in enumerate(rows.values()):
        sizes = [abs(h[k]) for h in (exact.forward, exact.backward, book.forward, book.backward)]
        assert row == pytest.approx(sizes, rel=1e-5, abs=1e-6)
    assert rows[1] == [0, 0, 0, 0]
    assert rows[4][:2] > rows[4][2:] == [0, 0]


def test_a_rod_without_length_has_no_series() -> None:
    pump = da.load(examples()["pump"]).with_values({"ratio": 0.0})
    with pytest.raises(
        da.ModelError, match="rod has no length; the book's series has the ratio of crank and rod"
    ):
        da.engine_series(da.dynamics(pump))
