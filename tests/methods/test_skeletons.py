"""DXF of the skeleton: read back by ezdxf, every point where the analysis has it, in the file's unit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples

ezdxf = pytest.importorskip("ezdxf")
UNIT = {"mm": (4, 0.001), "in": (1, 0.0254)}


@pytest.mark.parametrize(("name", "unit"), [("toggle_press", "mm"), ("four_bar", "in"), ("rssr", "mm")])
def test_points_are_where_the_analysis_has_them(name: str, unit: str, tmp_path: Path) -> None:
    r = da.kinematics(da.load(examples()[name]))
    da.draw.skeleton(r, at=1).save(tmp_path / "s.dxf")
    document = ezdxf.readfile(tmp_path / "s.dxf")
    assert not document.audit().has_errors
    number, size = UNIT[unit]
    assert document.units == number
    drawn = document.modelspace()
    for link in r.links:
        expected = [r.point(link, n)[0] / size for n in r.mechanism.points(link)]
        found = [[*p.dxf.location] for p in drawn.query(f'POINT[layer=="{link}"]')]
        flat = np.zeros((len(expected), 3))
        flat[:, : r.mechanism.dimension] = expected
        np.testing.assert_allclose(found, flat, atol=1e-8)
        ends = {
            tuple(np.round(e, 6))
            for line in drawn.query(f'LINE[layer=="{link}"]')
            for e in (line.dxf.start, line.dxf.end)
        }
        if len(expected) > 1:
            assert ends
            assert ends <= {tuple(np.round(p, 6) + 0.0) for p in found}
    assert {t.dxf.text for t in drawn.query('TEXT[layer=="joints"]')} == {*r.joints}


def test_a_bar_of_three_joints_is_two_lines_and_a_plate_a_triangle() -> None:
    lift = da.draw.skeleton(da.kinematics(da.load(examples()["scissor_lift"])))
    assert len(lift.lines["left_1"]) == 2
    tree = da.four_bar().to_tree()
    tree["links"]["coupler"]["points"]["P"] = [0.1, 0.1]
    tree["links"]["hook"] = {"points": {"P": [0, 0], "Q": [0.1, 0]}}
    tree["joints"]["P"] = {"type": "weld", "links": ["coupler", "hook"]}
    bones = da.draw.skeleton(da.kinematics(da.mechanism(tree)))
    assert (len(bones.lines["coupler"]), len(bones.lines["crank"])) == (3, 1)


def test_layers_have_names_that_dxf_allows(tmp_path: Path) -> None:
    bones = da.draw.skeleton(da.kinematics(da.four_bar()))
    odd = type(bones)({"a/b": {}, "a:b": {}, "joints": {}}, {}, {}, {}, "mm", 0.001)
    assert [*odd.layers().values()] == ["a_b", "a_b_", "joints_"]
    with pytest.raises(da.ModelError, match=r"s\.svg: a skeleton is a DXF file; end its name in \.dxf"):
        bones.save(tmp_path / "s.svg")


def test_solve_prints_what_a_shape_weighs() -> None:
    """A rod: pi r^2 L rho; about its centre m (3 r^2 + L^2) / 12 across it and m r^2 / 2 along it."""
    r = da.dynamics(da.load(examples()["rssr"]))
    radius, length, density = 0.008, 0.09, 7850.0
    mass = np.pi * radius**2 * length * density
    rocker = r.to_dict()["mass_properties"]["rocker"]
    assert rocker["mass"] == pytest.approx(mass, rel=1e-12)
    across, along = mass * (3 * radius**2 + length**2) / 12, mass * radius**2 / 2
    np.testing.assert_allclose(rocker["inertia"], np.diag([across, across, along]), atol=1e-18)
    assert rocker["center"] == pytest.approx([0, 0, 0.045])
    assert "shape of" in r.text()
    assert "98.1567" in r.text()
