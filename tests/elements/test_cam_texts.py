"""What is printed of a cam, each number from its closed form."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.printing import number
from tests.elements.test_cam_cases import sliding
from tests.elements.test_cams import TURN
from tests.elements.test_cams import machine as cam_machine

HEAD = "Cam F: %s slides on ground.\n\n"


def lines(c: da.CamDesign) -> list[list[str]]:
    """The rows of the table, their cells without the blanks between."""
    table = c.text().split("\n\n")[1].splitlines()[2:]
    return [[cell for cell in row.split("  ") if cell.strip()] for row in table]


def cells(*row: object) -> list[str]:
    return [x if isinstance(x, str) else number(float(x)) for x in row]  # type: ignore[arg-type]


def stripped(rows: list[list[str]]) -> list[list[str]]:
    return [[cell.strip() for cell in row] for row in rows]


@pytest.mark.long
def test_a_harmonic_cam_prints_its_steepest_place_its_nose_and_where_its_acceleration_jumps() -> None:
    """y = 48 mm + h/2 (1 - cos(pi x)): tan of the pressure angle is y'/y, the nose y^2/(y - y'')."""
    up = {"to": "20 mm", "in": "90 deg", "by": "harmonic"}
    segments = [up, {"dwell": "40 deg"}, {**up, "to": 0, "in": "110 deg"}, {"dwell": "rest"}]
    c = da.cam(da.mechanism(cam_machine({"roller": "8 mm"}, segments=segments)), "F", count=91)
    angles = []
    for turn in (math.pi / 2, math.radians(110)):
        x = np.linspace(0, 1, 100_001)
        y, slope = 0.048 + 0.01 * (1 - np.cos(math.pi * x)), 0.01 * math.pi / turn * np.sin(math.pi * x)
        k = int(np.argmax(slope / y))
        angles.append((math.degrees(math.atan2(slope[k], y[k])), math.degrees(turn * x[k])))
    nose = 0.068**2 / (0.068 + 0.01 * 4)
    assert c.text().startswith(HEAD % "a roller")
    rows = stripped(lines(c))
    assert rows[0] == cells("lift", 0.02, "m", 90.0, "deg")
    assert [*rows[1][:3], rows[1][4]] == cells("pressure angle, rising", angles[0][0], "deg", "deg")
    assert float(rows[1][3]) == pytest.approx(angles[0][1], abs=1e-3)
    assert rows[2] == cells("pressure angle, returning", angles[1][0], "deg")
    assert rows[3] == cells("least convex radius", nose, "m", 90.0, "deg")
    assert c.text().endswith("\n\nThe acceleration jumps at 0, 90, 130, 240 deg.")


def test_a_hollow_cam_prints_the_largest_cutter() -> None:
    """Of a cycloidal rise from a small base: the outline's least hollow radius at the places of the answer."""
    up = {"to": "30 mm", "in": "60 deg", "by": "cycloidal"}
    segments = [up, {**up, "to": 0}, {"dwell": "rest"}]
    c = da.cam(da.mechanism(cam_machine({"roller": "8 mm"}, segments=segments)), "F", count=91)
    outline = c.profile(c.turn)
    (row,) = [row for row in stripped(lines(c)) if "hollow" in row[0]]
    assert [row[0], row[2]] == ["largest cutter radius in hollows", "m"]
    step = 1e-5
    sides = [c.profile(c.turn + way * step) for way in (-1, 0, 1)]
    first, second = (sides[2] - sides[0]) / (2 * step), (sides[2] - 2 * outline + sides[0]) / step**2
    # seen by the follower the cam goes by clockwise: what is hollow has a positive curvature
    curved = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.hypot(*first.T) ** 3
    assert float(row[1]) == pytest.approx(1 / curved.max(), rel=1e-4)  # second differences
    assert "acceleration jumps" not in c.text()


def test_an_eccentric_disc_under_a_face_touches_it_as_far_aside_as_its_eccentricity() -> None:
    disc = {"eccentric": "5 mm", "radius": "20 mm"}
    c = da.cam(da.mechanism(sliding("flat", disc, drive=dict(TURN), stem={"mass": 0.5})), "F")
    assert c.text().startswith(HEAD % "a flat face")
    assert stripped(lines(c)) == [
        cells("lift", 0.01, "m", 90.0, "deg"),
        cells("pressure angle, rising", 0.0, "deg", 0.0, "deg"),
        cells("pressure angle, returning", 0.0, "deg"),
        cells("least convex radius", 0.02, "m", 0.0, "deg"),
        cells("half width of the face", 0.005, "m"),
    ]
    assert np.isnan([c.largest_roller, c.least_base, c.least_base_at]).all()


def test_a_cam_that_presses_nowhere_has_no_hertzian_pressure() -> None:
    tree = cam_machine({"roller": "8 mm"})
    tree["loads"]["P"]["value"] = [0, 3000]
    c = da.cam(da.mechanism(tree), "F")
    assert (c.force < 0).all()
    with pytest.raises(da.ModelError) as refused:
        c.hertz(0.01)
    assert str(refused.value) == (
        "no force presses the follower on cam 'F' at any position; give force, or a spring that keeps it on: spring_for"
    )


@pytest.mark.parametrize("unit", ["mm", "m", "in"])
def test_files_of_a_cam_have_its_outline_and_the_cutter_beside_it(unit: str, tmp_path: Path) -> None:
    """The cutter's centre is its radius away along the normal; by angle, counter-clockwise, each once."""
    tree = cam_machine({"roller": "8 mm"}) | {"units": {"length": unit}}
    tree["links"]["ground"]["points"]["top"] = [0, "1 m"]
    c = da.cam(da.mechanism(tree), "F")
    size = {"mm": 1e3, "m": 1.0, "in": 1 / 0.0254}[unit]
    c.save(tmp_path / "cam.csv", tolerance=1e-5, cutter=0.006)
    head, *rows = (tmp_path / "cam.csv").read_text().splitlines()
    names = [f"radius [{unit}]", f"x [{unit}]", f"y [{unit}]", f"cutter.x [{unit}]", f"cutter.y [{unit}]"]
    assert head.split(",") == ["angle [deg]", *names]
    angle, radius, x, y, *center = np.array([[float(cell) for cell in row.split(",")] for row in rows]).T
    assert (np.diff(angle) > 0).all()
    assert 0 <= angle[0] < angle[-1] < 360
    assert np.stack([x, y]) == pytest.approx(
        radius * np.stack([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    )
    outline = np.stack([x, y], -1) / size
    away = np.stack(center, -1) / size - outline
    assert np.hypot(*away.T) == pytest.approx(0.006, rel=1e-9)
    assert ((away * outline).sum(axis=1) > 0).all()
    along = np.roll(outline, -1, axis=0) - np.roll(outline, 1, axis=0)
    normal = np.abs((away * along).sum(axis=1)) / 0.006 / np.hypot(*along.T)
    assert np.median(normal) < 1e-3  # chords of an outline to 0.01 mm
    c.save(tmp_path / "cam.dxf", tolerance=1e-5, cutter=0.006)
    import ezdxf

    drawing = ezdxf.readfile(tmp_path / "cam.dxf")  # type: ignore[attr-defined]
    assert drawing.header["$INSUNITS"] == {"mm": 4, "m": 6, "in": 1}[unit]
    lines = {line.dxf.layer: line for line in drawing.modelspace()}
    assert {name: line.closed for name, line in lines.items()} == {"cam": True, "cutter": True}
    found = {name: np.array(line.get_points("xy")) for name, line in lines.items()}
    order = np.argsort(np.mod(np.degrees(np.arctan2(*found["cam"].T[::-1])), 360))
    assert len(order) >= len(x)
    kept = {tuple(np.round(row, 9)) for row in found["cam"][order]}
    assert {tuple(np.round(row, 9)) for row in outline * size} <= kept
    assert np.hypot(*(found["cutter"] - found["cam"]).T) == pytest.approx(0.006 * size, rel=1e-9)
