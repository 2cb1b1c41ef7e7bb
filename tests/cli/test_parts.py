"""Parts of the command line by themselves: ways to a pose, whole numbers, what is rounding, long tables."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import method_text
from dalembert.cli.documents.draw_command import _enough
from dalembert.cli.documents.position_argument import _at_last_position, _path_to
from dalembert.cli.method_text import NOTHING, _rounding, fixed_point_text
from dalembert.cli.options import integer
from dalembert.model.library import TEMPLATES
from tests.friction.engines import pushed_slider


@pytest.mark.parametrize("at", ["60.5 deg", "-95 deg", "190 deg", "400 deg"])
@pytest.mark.parametrize("template", ["four_bar", "rssr"])
def test_a_drawing_at_another_value_is_of_the_pose_that_leads_there(template: str, at: str) -> None:
    """In small steps from the file's own position, up or down, on its branch."""
    m = TEMPLATES[template].function()
    m = m.with_values({f"drives.{next(iter(m.drives))}.position": float(np.radians(60))})
    way = _path_to(m, at)
    assert way is not None
    assert np.abs(np.diff(way)).max() <= 0.05 + 1e-12
    assert (way[0], way[-1]) == pytest.approx((np.radians(60), np.radians(float(at.split()[0]))))
    followed = da.kinematics(m.with_values({f"drives.{next(iter(m.drives))}.position": way}))
    there = da.kinematics(_at_last_position(m, way))
    for link in followed.links:
        assert there.rotation(link)[0] == pytest.approx(followed.rotation(link)[-1], abs=1e-9)
        assert there.position(link)[0] == pytest.approx(followed.position(link)[-1], abs=1e-9)
        stated = getattr(there.mechanism.assembly[link], "position", None)
        assert stated is None or stated == pytest.approx(followed.position(link)[-1], abs=1e-9)


def test_whole_numbers_have_fifteen_digits_at_most() -> None:
    def read(text: str) -> int:
        return integer(1)(None, [SimpleNamespace(value=text)])

    assert read("9" * 15) == 10**15 - 1
    for text in ("9" * 16, "-1", "0", "1.0", "²"):
        with pytest.raises(ValueError, match="is not an integer of 1 or more"):
            read(text)


def test_rounding_is_judged_beside_the_largest_force_and_moment() -> None:
    result: Any = SimpleNamespace(compiled=SimpleNamespace(layout=SimpleNamespace(length=2.0)))
    found = _rounding(result, [("force", np.array([-3.0])), ("moment", np.array([8.0, -1.0]))])
    assert found == {"force": NOTHING * 4.0, "moment": NOTHING * 8.0}
    turned = _rounding(result, [("force", np.array([-3.0])), ("moment", np.array([-8.0, 1.0]))])
    assert turned == found


@pytest.mark.parametrize(("mu", "rows"), [(0.28, 24), (0.3, 25), (0.9, 242)])
def test_a_long_iteration_is_shortened_in_the_middle(mu: float, rows: int) -> None:
    """Up to 24 steps are printed, of more the first 21 and the last two; each with its change."""
    r = da.statics(pushed_slider(mu))
    every = [[f"{int(row[0])}", f"{row[-1]:.1e}"] for row in da.fixed_point(r).rows()]
    every[0][-1] = "-"
    assert len(every) == rows
    lines = [line.split() for line in fixed_point_text(r).splitlines()]
    first = next(k for k, line in enumerate(lines) if line[:1] == ["0"])
    printed = [[line[0], line[-1]] for line in lines[first : first + 24]]
    assert printed == (every if rows <= 24 else [*every[:21], ["...", "..."], *every[-2:]])


def test_a_file_of_one_position_that_moves_is_shown_over_a_turn() -> None:
    one, many = da.four_bar().with_values({"drives.O2.position": 1.0}), da.four_bar()
    assert _enough(one, 24) == 24
    found = (_enough(da.load(examples()[name]), 24) for name in ("truss", "balance_position"))
    assert [_enough(many, 24), *found] == [None] * 3


PRESS = """
links: {ground: {points: {O: [0, 0], P: [0.7, 0]}}, ram: {points: {P: [0, 0]}}, arm: {points: {O: [0, 0], A: [0, 0.3]}}}
joints:
  P: {type: slider, links: [ground, ram], direction: 0}
  O: {type: pin, links: [ground, arm]}
drives: {P: {position: 0}, O: {position: 20 deg}}
loads:
  F: {type: force, on: ram, at: P, value: [7, 3]}
  M: {type: couple, on: arm, value: 11}
"""


def test_printed_work_is_rounded_beside_the_largest_that_its_column_may_have(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Forces beside the largest load, couples beside it at the machine's length; at 1 m of a slide a link turns by
    1 m over that length, at 1 rad its points move by that length."""
    beside: list[float] = []
    cells = method_text._cells

    def recorded(values: np.ndarray, count: int, of: float) -> list[list[str]]:
        beside.append(of)
        return cells(values, count, of)

    monkeypatch.setattr(method_text, "_cells", recorded)
    r = da.statics(da.loads(PRESS))
    length = r.compiled.layout.length
    assert abs(length - 1) > 0.05
    method_text.virtual_work_answer(r, "SI")
    load = max(7.0, 11 / length)
    known = {"P": [load, load * length, 1.0, 1 / length, load]}
    known["O"] = [load, load * length, length, 1.0, load * length]
    assert beside == pytest.approx([x for drive in r.drives for x in known[drive]])


def test_a_superposition_has_the_moment_of_each_joint_beside_its_force() -> None:
    """A couple on the piston is held by the guide, the last joint."""
    tree = da.slider_crank(positions=1).to_tree()
    tree["loads"]["twist"] = {"type": "couple", "on": "piston", "value": "30 N*m"}
    tables = method_text.superposition_text(da.statics(da.mechanism(tree)), "SI").split("\n\n")[1:-1]
    heads = [table.splitlines()[0] for table in tables]
    assert [head.endswith("guide m") for head in heads] == [False, True]
    (row,) = (line.split() for line in tables[-1].splitlines() if line.startswith("twist"))
    assert float(row[-1]) == -30


def test_a_superposition_in_space_has_the_moments_of_each_joint_behind_its_force() -> None:
    r = da.dynamics(da.load(examples()["rssr"]), positions=2)
    heads = "".join(
        line for line in method_text.superposition_text(r, "SI").splitlines() if line.startswith("source")
    )
    named = re.findall(r"\|(\w+)\||(\w+) m([xyz])", heads)
    assert [one for one, _, _ in named if one] == list(r.joints)
    assert any(axis for *_, axis in named)
    last = ""
    for size, moment, _ in named:
        last = size or last
        assert moment in ("", last)
