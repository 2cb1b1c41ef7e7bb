"""An expression that is put into a file of other units says its own: read again, it is worth the same."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import dalembert as da
from dalembert.arrays import Array
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


LAW = """
links: {ground: {points: {S: [0, 0]}}, b: {points: {S: [0, 0]}}}
joints: {S: {type: slider, links: [ground, b]}}
drives: {S: {law: {expression: TEXT, duration: 2 s, count: 9}}}
"""


@pytest.mark.parametrize(("text", "rates"), [
    ("10 mm - 3 mm/(1 + time/(1 s))", lambda t: (10e-3 - 3e-3 / (1 + t), 3e-3 / (1 + t) ** 2, -6e-3 / (1 + t) ** 3)),
    ("3 mm - 2*(1 mm*time/(1 s))", lambda t: (3e-3 - 2e-3 * t, -2e-3 + 0 * t, 0 * t)),
    ("1 m/(2 - time/(4 s))", lambda t: (4 / (8 - t), 4 / (8 - t) ** 2, 8 / (8 - t) ** 3)),
    ("-(5 mm)*sin(time*2/(1 s)) - 1 mm",
     lambda t: (-5e-3 * np.sin(2 * t) - 1e-3, -1e-2 * np.cos(2 * t), 2e-2 * np.sin(2 * t))),
    ("(1 + time/(1 s))^2.5*1 mm - (time/(2 s))^3*1 m",
     lambda t: (1e-3 * (1 + t) ** 2.5 - t**3 / 8, 2.5e-3 * (1 + t) ** 1.5 - 3 * t**2 / 8,
                3.75e-3 * (1 + t) ** 0.5 - 6 * t / 8)),
])  # fmt: skip
def test_a_law_by_an_expression_has_its_exact_rates(
    text: str, rates: Callable[[Array], tuple[Array, ...]]
) -> None:
    r = da.kinematics(da.loads(LAW.replace("TEXT", text)))
    assert r.time == pytest.approx(np.linspace(0, 2, 9))
    for rate, wanted in zip(("", "speed", "acceleration"), rates(np.linspace(0, 2, 9)), strict=True):
        assert r.drive("S", rate) == pytest.approx(wanted, rel=1e-12, abs=1e-15)  # type: ignore[arg-type]
