"""Bearings: equivalent load and life in closed form, catalogue ratings of the books, pressure, choice, bad input."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from tests.machine.cranks import crank_machine
from tests.tiers import over

SHAFT = """
units: {{length: mm, angle: rad}}
links:
  ground: {{points: {{O: [0, 0]}}}}
  shaft: {{points: {{O: [0, 0]}}, mass: 0}}
joints:
  O: {{type: pin, links: [ground, shaft], bearing: {bearing}}}
drives:
  O: {{position: {{from: 0, to: {turn}, count: 72}}, speed: 300 rpm}}
loads:
  F: {{type: force, on: shaft, at: O, value: [{load}, 0]}}
"""


def shaft(load: str, bearing: str = "{rating: 12 kN}") -> Any:
    return da.dynamics(da.loads(SHAFT.format(load=load, bearing=bearing, turn=2 * math.pi)))


@over(4, 200)
def test_pressure_and_life_against_sums_of_ones_own(seed: int) -> None:
    """By the angles of the links, not by their rates: a finer cycle, and differences of the relative angle."""
    m = crank_machine(seed, 360)
    rating = {"rating": 3000.0, "diameter": 0.02, "length": 0.03}
    r = da.dynamics(m.with_values({"joints.A.bearing": rating}))
    b = da.bearing(r, "A")
    force = np.hypot(*r.reaction("A").T)
    assert np.allclose(b.pressure, force / 6e-4)
    phi = np.unwrap(r.angle("rod") - r.angle("crank"))
    turned = np.abs(np.diff(np.append(phi, phi[0] + 2 * np.pi * round((phi[-1] - phi[0]) / (2 * np.pi)))))
    mean = (force + np.roll(force, -1)) / 2
    own = ((mean**3 * turned).sum() / turned.sum()) ** (1 / 3)
    assert b.equivalent == pytest.approx(own, rel=2e-3)
    period = 2 * np.pi / abs(r.drive_speed("O")[0])
    assert b.hours == pytest.approx(b.turns / (turned.sum() / 2 / np.pi) * period / 3600, rel=2e-3)
    assert b.mean_pv == pytest.approx(float((b.pressure * 0.01 * np.abs(b.rate)).mean()), rel=1e-9)


@pytest.mark.parametrize(
    ("units", "of_pressure", "of_pv"),
    [
        ("{length: mm, angle: rad}", ("N/mm^2", 1e6), ("MPa*m/s", 1e6)),
        ("{angle: rad}", ("MPa", 1e6), ("MPa*m/s", 1e6)),
        (
            "{length: in, force: lbf, angle: rad}",
            ("lbf/in^2", 6894.757293168361),
            ("lbf/in^2*ft/min", 35.02536704929527),
        ),
    ],
)
def test_pressure_and_pv_are_printed_in_usual_units(
    units: str, of_pressure: tuple[str, float], of_pv: tuple[str, float]
) -> None:
    text = SHAFT.format(load="9000 N", bearing="{diameter: 20 mm, length: 15 mm}", turn=2 * math.pi)
    t = da.bearings(da.dynamics(da.loads(text.replace("{length: mm, angle: rad}", units))))
    said, b = str(t), t.loads["O"]
    assert f" {of_pressure[0]} " in said
    assert f" {of_pv[0]}" in said
    row = next(line.split() for line in said.splitlines() if line.startswith("O ") and len(line.split()) == 4)
    sizes = b.pressure.max() / of_pressure[1], b.pv.max() / of_pv[1], b.mean_pv / of_pv[1]
    assert [float(cell) for cell in row[1:]] == pytest.approx(sizes, rel=1e-5)


def test_a_couple_across_the_axis_is_printed() -> None:
    """That of a crank whose pin is in the plane of its bearing is what bends it there, out of that plane."""
    r = da.dynamics(da.load(examples()["rssr"]))
    t = da.bearings(r)
    bent = da.member_forces(r, "crank").at(0.0)["bending y"]
    assert t.loads["O"].couple == pytest.approx(np.abs(bent), rel=1e-9)
    said = " ".join(str(t).split())
    assert "O (629.005 N*mm), C (519.761 N*mm): a couple across the axis" in said
    assert da.bearings(da.dynamics(da.four_bar())).loads["O2"].tilting == 0


def test_a_bearing_in_space_has_axial_factors() -> None:
    m, joint = da.rssr(), "O"
    values = {"gravity": [0.0, -9.8, -3.0], f"joints.{joint}.bearing": {"rating": 5000.0}}
    r = da.dynamics(m.with_values(values))
    b = da.bearing(r, joint)
    assert b.axial.max() > 1
    assert math.isnan(b.equivalent)
    assert f"{joint}, C: an axial force, and no axial_factor" in str(da.bearings(r))
    factors = {"rating": 5000.0, "radial_factor": 0.56, "axial_factor": 1.5, "diameter": 0.02, "length": 0.03}
    b = da.bearing(da.dynamics(r.mechanism.with_values({f"joints.{joint}.bearing": factors})), joint)
    assert np.allclose(b.load, np.maximum(b.radial, 0.56 * b.radial + 1.5 * b.axial))
    assert math.isfinite(b.hours)
    assert np.allclose(b.result[f"pressure.{joint}"], b.radial / 6e-4)


def test_pressure_is_an_output_of_compiled_analyses() -> None:
    """With the bearing's own size as a varied number; nothing need turn for it."""
    sized = da.slider_crank(crank=0.05, rod=0.2).with_values(
        {"joints.A.bearing": {"diameter": 0.02, "length": 0.015}}
    )
    r = da.statics(
        sized.with_values({"loads": {"F": {"type": "force", "on": "rod", "at": "B", "value": [900.0, 50.0]}}})
    )
    assert np.allclose(r["pressure.A"], np.hypot(*r.reaction("A").T) / 3e-4)
    k = da.compile(sized, vary=["joints.A.bearing.diameter"], outputs=["pressure.A"], derivatives=True)
    wide, force = k([[0.04]]), np.hypot(*da.dynamics(sized).reaction("A").T)
    assert np.allclose(wide.value("pressure.A")[0], force / 6e-4)
    assert np.allclose(wide.gradient("pressure.A")[0, :, 0], -force / 6e-4 / 0.04)
    with pytest.raises(ModelError, match=r"there is no output 'pressure.B'; did you mean 'pressure.A'"):
        da.compile(sized, outputs=["pressure.B"])


TABLE = "name, C [kN], C0 [kN], d [mm]\n6202, 7.8, 3.55, 15\n6205, 14, 7.8, 25\n6204, 12.7, 6.55, 20\n"


def test_the_smallest_that_is_enough_is_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "m.yaml").write_text(SHAFT.format(load="1898", bearing="{rating: 12 kN}", turn=2 * math.pi))
    (tmp_path / "b.csv").write_text(TABLE)
    arguments = ["bearings", str(tmp_path / "m.yaml"), "--hours", "5000", "--table", str(tmp_path / "b.csv")]
    outputs = [
        x for kind in ("json", "csv", "xlsx", "report") for x in (f"--{kind}", str(tmp_path / f"o.{kind}"))
    ]
    outputs[-1] = str(tmp_path / "o.txt")
    assert main([*arguments, *outputs]) == 0
    said = capsys.readouterr().out
    assert "6204" in said
    assert "6202" not in said
    read = json.loads((tmp_path / "o.json").read_text())["bearings"]["O"]
    assert read["chosen"] == "6204"
    assert read["rating_needed"] == pytest.approx(1898 * 90 ** (1 / 3))
    assert "radial force O [N]" in (tmp_path / "o.csv").read_text()
    book = openpyxl.load_workbook(tmp_path / "o.xlsx")
    assert book["positions"]["C1"].value == "radial force O [N]"
    assert book["positions"]["C2"].value == pytest.approx(1898)
    assert any("6204" in row for row in book["answer"].values)
    assert "L_10 = ((C)/(P))^e 10^6" in (tmp_path / "o.txt").read_text()
    assert main([*arguments, "--factor", "2"]) == 0
    assert "none is enough" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("bearing", "said"),
    [
        (
            "{kind: ball}",
            "the bearing has no rating; give rating: 12 kN, or diameter: 20 mm and length: 15 mm",
        ),
        ("{diameter: 20 mm}", "the bearing has no length; give"),
        ("{rating: -3 kN}", "positive"),
    ],
)
def test_a_bearing_without_rating_or_size_has_its_line(bearing: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    file.write_text(SHAFT.format(load="1", bearing=bearing, turn=1))
    with pytest.raises(ModelError, match=r"m\.yaml:7: ") as error:
        da.load(file)
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("7.8, 3.55", "-7.8, 3.55", r"b\.csv:2: C is not positive; give a positive number"),
        ("3.55, 15", "3.55", r"b\.csv:2: 3 columns where the first row has 4"),
        ("14,", "much,", r"b\.csv:3: 'much' in column 'C' is no finite number"),
        ("d [mm]", "D [mm]", r"b\.csv:1: the column 'd' is not in its head"),
        ("C [kN]", "C [mm]", r"b\.csv:1: "),
    ],
)
def test_a_bad_row_of_a_table_has_its_line(old: str, new: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "b.csv").write_text(TABLE.replace(old, new))
    with pytest.raises(ModelError, match=said):
        da.bearings(shaft("1898"), hours=5000, table=tmp_path / "b.csv")


def test_what_has_no_life_is_refused() -> None:
    r = shaft("1898", "{diameter: 20 mm, length: 10 mm}")
    with pytest.raises(ModelError, match="the bearing of 'O' has no rating; give rating: 12 kN"):
        _ = da.bearing(r, "O").turns
    with pytest.raises(ModelError, match="a bearing is chosen by its life"):
        da.bearings(r, table="none.csv")
    with pytest.raises(ModelError, match="the time of each position is not known"):
        da.bearing(da.dynamics(r.mechanism.with_values({"drives.O.speed": 0.0})), "O")
    engine = da.dynamics(da.in_line_engine(cylinders=1))
    with pytest.raises(ModelError, match="joint 'cylinder_1' does not turn about one axis"):
        da.bearing(engine, "cylinder_1")
