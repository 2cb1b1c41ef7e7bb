"""Descriptions in space: written and read back equal, changed by path, converted; doubtful inertias said."""

from __future__ import annotations

from pathlib import Path

import pytest

import dalembert as da
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.model import json_schema, load, loads, tree_text
from dalembert.model.space_checks import impossible, principal_inertias
from tests.tiers import tiers

FILE = Path(__file__).parent / "rssr.yaml"
TEXT = FILE.read_text(encoding="utf-8")


@pytest.mark.parametrize("form", ["yaml", "json", "toml"])
def test_what_is_written_reads_back_equal(form: str) -> None:
    m = loads(TEXT)
    assert loads(tree_text(m.to_tree(), form), form) == m


@pytest.mark.parametrize("suffix", tiers([".yaml"], [".json", ".toml"]))
def test_saved_and_converted_files_have_the_same_answer(tmp_path: Path, suffix: str) -> None:
    m = load(FILE)
    m.save(tmp_path / f"saved{suffix}")
    assert main(["convert", str(FILE), "-o", str(tmp_path / f"converted{suffix}")]) == 0
    force = da.dynamics(m).reaction("A")
    for name in ("saved", "converted"):
        other = load(tmp_path / f"{name}{suffix}")
        assert other == m
        assert da.dynamics(other).reaction("A") == pytest.approx(force, rel=1e-13)


def test_values_are_replaced_by_path() -> None:
    m = load(FILE)
    changed = m.with_values(
        {
            "links.crank.points.A.2": 0.01,
            "links.crank.inertia.0": 2e-5,
            "links.rocker.inertia.2.0": 0.0,
            "links.rod.shape.area": "60 mm^2",
            "joints.C.damping": {"turn": 0.1},
            "joints.O.axis.2": 2.0,
            "loads.push.direction": (0, 1, 0),
            "loads.coil.freedom": "turn1",
            "assembly.rod": m.assembly["rod"],
            "gravity.2": -1.0,
        }
    )
    assert changed.point("crank", "A") == (0.04, 0.0, 0.01)
    assert changed.inertia("crank") == (2e-5, 250e-6, 255e-6)
    assert changed.inertia("rocker") == ((1350e-6, 0.0, 0.0), (0.0, 1350e-6, 0.0), (0.0, 0.0, 20e-6))
    assert changed.mass("rod") == pytest.approx(m.mass("rod") * 1.2)
    assert changed.loads["coil"].freedom == "turn1"
    assert changed.gravity_vector == (0.0, 0.0, -1.0)


@pytest.mark.parametrize(
    ("path", "says"),
    [
        (
            "links.rod.shape.size",
            "path 'links.rod.shape.size': 'size' does not exist in links.rod.shape",
        ),
        (
            "links.rod.shape.0.area",
            "path 'links.rod.shape.0': '0' does not exist in links.rod.shape",
        ),
        ("links.crank.inertia.3", "'3' does not exist in links.crank.inertia"),
        ("joints.C.axes.j.y", "'y' does not exist in joints.C.axes.j"),
    ],
)
def test_paths_that_lead_nowhere(path: str, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        load(FILE).with_values({path: 1.0})
    assert says in str(caught.value)


def test_the_schema_knows_shapes_and_axes() -> None:
    schema = json_schema()
    kinds = {
        name: part["properties"]["type"].get("const", part["properties"]["type"].get("default"))
        for name, part in schema["$defs"].items()
        if "density" in part.get("properties", {})
    }
    assert sorted(kinds.values()) == ["bar", "box", "cylinder", "mesh", "sphere", "tube"]
    assert {"x", "z"} == schema["$defs"]["Frame"]["properties"].keys()
    assert schema["$defs"]["StatedAnswer"]["properties"]["axes"]["enum"] == ["ground", "link", "joint"]


def test_principal_values_of_a_matrix() -> None:
    assert principal_inertias(((5.0, 0.0, 0.0), (0.0, 2.0, 1.0), (0.0, 1.0, 2.0))) == pytest.approx((1, 3, 5))
    assert not impossible(((5.0, 0.0, 0.0), (0.0, 5.0, 0.0), (0.0, 0.0, 10.0)))
    assert impossible(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 2.1)))


@pytest.mark.long
def test_an_inertia_that_no_body_has_is_analysed_and_said() -> None:
    m = load(FILE).with_values(
        {"links.crank.inertia": (1e-4, 0, 0), "links.rocker.inertia": (1e-3, 1e-4, 1e-4)}
    )
    said = da.dynamics(m).assumptions
    assert said["inertia of crank and rocker"] == (
        "of no real body: one principal value exceeds the sum of the others"
    )
    for r in (da.statics(m), da.dynamics(load(FILE))):
        assert "inertia of crank and rocker" not in r.assumptions


@pytest.mark.parametrize(("times", "doubted"), [(1.0, False), (0.0, False), (1e-6, True), (1e6, True)])
def test_an_inertia_in_the_wrong_unit_is_said(times: float, doubted: bool) -> None:
    """kg m2 where the file has mm, or the other way round: a body a thousand times too small or too large."""
    space = load(FILE).with_values({"links.rocker.inertia": (times * 1e-3, times * 1e-3, 0.0)})
    flat = da.four_bar()
    plane = flat.with_values({"links.coupler.inertia": times * flat.inertia("coupler")})
    for m, link in ((space, "rocker"), (plane, "coupler")):
        said = da.dynamics(m, positions=1).assumptions
        assert [key for key, text in said.items() if text.endswith("check its unit")] == (
            [f"inertia of {link}"] if doubted else []
        )
