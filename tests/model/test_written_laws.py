"""An expression that is put into a file of other units says its own: read again, it is worth the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import dalembert as da
from dalembert.cli.documents.position_argument import _pose

ARM = """
units: {{force: {unit}, angle: rad}}
links: {{ground: {{points: {{O: [0, 0]}}}}, arm: {{points: {{O: [0, 0], P: [2, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, arm]}}}}
drives: {{O: {{position: [0, 1, 2]}}}}
loads:
  F: {{type: force, on: arm, at: P, direction: 1.5, value: {value}}}
"""


@pytest.mark.parametrize(
    "law", ["8 + 3*sin(O)", "(8 + 3*sin(O)) lbf", "8 + 3*sin(O) kN", "{expression: 8 + 3*sin(O), unit: lbf}"]
)
@pytest.mark.parametrize(("own", "other"), [("kN", "kN"), ("kN", "lbf"), ("N", "kN"), ("lbf", "N")])
def test_a_law_of_another_file_keeps_its_worth(law: str, own: str, other: str, tmp_path: Path) -> None:
    (tmp_path / "own.yaml").write_text(ARM.format(unit=own, value=3))
    source = da.loads(ARM.format(unit=other, value=law))
    m = da.load(tmp_path / "own.yaml").with_values({"loads.F": source.loads["F"]})
    effort = da.statics(m).effort("O")
    np.testing.assert_allclose(effort, da.statics(source).effort("O"), rtol=1e-12)
    m.save(tmp_path / "new.yaml")
    np.testing.assert_allclose(da.statics(da.load(tmp_path / "new.yaml")).effort("O"), effort, rtol=1e-12)
    again = da.mechanism(m.to_tree())
    np.testing.assert_allclose(da.statics(again).effort("O"), effort, rtol=1e-12)


def test_a_drive_of_a_joint_that_slides_and_turns_says_which() -> None:
    text = """
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0]}}}
joints: {O: {type: slot, links: [ground, arm], direction: 0}}
drives: {O: {position: 0.1}}
"""
    said = (
        "drive 'O' does not say which freedom of its joint it prescribes: slide or turn; write freedom: slide"
    )
    with pytest.raises(da.ModelError, match=said):
        da.loads(text)


def test_the_pose_of_a_link_that_is_not_turned_has_an_axis() -> None:
    """An assembly says any axis where the angle is 0; a turned link is put back where it was."""
    text = """
space: space
links: {ground: {points: {O: [0, 0, 0]}}, arm: {points: {O: [0, 0, 0], P: [1, 0, 0]}}}
joints: {O: {type: KIND, links: [ground, arm], axis: [0, 1, 2]}}
drives: {O: {position: [0, 0.4, AT]}}
"""
    for kind, at in (("prismatic", "0.7"), ("revolute", "40"), ("revolute", "-170")):
        r = da.kinematics(da.loads(text.replace("KIND", kind).replace("AT", at)))
        pose = _pose(r, "arm")
        assert isinstance(pose, dict)
        axis, angle = np.array(pose["axis"]), pose["angle"]
        assert np.linalg.norm(axis) > 0
        np.testing.assert_allclose(pose["position"], r.position("arm")[-1])
        own = np.asarray(r.rotation("arm")[-1]).reshape(3, 3)
        turned = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis)).as_matrix()
        np.testing.assert_allclose(turned, own, atol=1e-12)
    flat = da.kinematics(da.four_bar(positions=5))
    assert _pose(flat, "rocker") == flat.angle("rocker")[-1]
