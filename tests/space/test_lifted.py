"""Every plane problem in space: the same efforts and forces in its plane, three redundant constraints a loop."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples

FILES = {**examples(), **cases()}


def _plane(path: Path) -> da.Mechanism | None:
    """A file that can be lifted, its friction switched off."""
    m = da.load(path)
    if m.space != "plane" or any(drive.unknown for drive in m.drives.values()):
        return None
    if any(joint.type == "rolling" for joint in m.joints.values()):
        return None
    if any(getattr(joint, "friction", None) for joint in m.joints.values()):
        m = m.with_values({"friction.enabled": False})
    return m


def _loops(m: da.Mechanism) -> int:
    """Independent closed loops of the graph of links and joints; a mesh closes none that could be redundant."""
    joints = [joint for joint in m.joints.values() if joint.type != "gear"]
    group = {name: name for name in m.links}

    def root(name: str) -> str:
        return name if group[name] == name else root(group[name])

    for joint in joints:
        group[root(joint.links[0])] = root(joint.links[1])
    parts = len({root(name) for name in m.links})
    return len(joints) - len(m.links) + parts


@pytest.mark.parametrize("name", FILES)
def test_a_plane_mechanism_in_space(name: str) -> None:
    m = _plane(FILES[name])
    if m is None:
        return
    solve: Any = da.dynamics if m.has_speeds else da.statics
    count = 3 if m.drives and all(isinstance(d.position, da.Range) for d in m.drives.values()) else None
    plane, space = solve(m, positions=count), solve(da.lifted(m), positions=count)
    good = np.array([status == "ok" for status in plane.status])
    known = (plane.force_array, plane.effort_array)
    scale = max((float(np.abs(a[np.isfinite(a)]).max(initial=0.0)) for a in known), default=0.0) or 1.0
    for drive in plane.drives:
        assert space.effort(drive)[good] == pytest.approx(plane.effort(drive)[good], abs=1e-10 * scale)
    for load in plane.unknown_loads:
        assert space.unknown_load(load)[good] == pytest.approx(
            plane.unknown_load(load)[good], abs=1e-10 * scale
        )
    for joint in plane.joints:
        here, there = plane.reaction(joint)[good], space.reaction(joint)[good, :2]
        assert there == pytest.approx(here, abs=1e-10 * scale, nan_ok=True)
    assert space.mobility is not None
    assert space.mobility.redundant == 3 * _loops(m)
    assert space.mobility.freedoms == plane.mobility.freedoms  # type: ignore[union-attr]


def test_a_pin_that_slides_and_one_that_turns_any_way_make_a_loop_determinate() -> None:
    m = da.four_bar()
    space = da.dynamics(da.lifted(m, {"coupler": 0.02}, {"A": "spherical", "B": "cylindrical"}))
    assert set(space.status) == {"ok"}
    assert space.effort("O2") == pytest.approx(da.dynamics(m).effort("O2"), rel=1e-10)


def test_a_crank_pin_beside_its_bearing_bends_it() -> None:
    """The pin force F at a height h above the bearing's middle is a couple -h x F on the crank there."""
    m = da.load(examples()["four_bar"])
    height = dict.fromkeys(("A", "B", "coupler", "rocker"), 0.05)
    r = da.statics(da.lifted(m, height, {"A": "spherical", "B": "cylindrical"}))
    pin = da.statics(m).reaction("A", on="crank")
    expected = 0.05 * np.stack([pin[:, 1], -pin[:, 0]], axis=1)
    assert r.reaction_moment("O2", on="crank")[:, :2] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("offsets", "become", "says"),
    [
        ({"nobody": 0.1}, {}, "there is no link or joint 'nobody' to offset"),
        ({}, {"nobody": "spherical"}, "'nobody' is no pin that could become spherical"),
    ],
)
def test_what_cannot_be_lifted(offsets: dict[str, float], become: dict[str, Any], says: str) -> None:
    with pytest.raises(da.ModelError, match=says):
        da.lifted(da.four_bar(), offsets, become)
