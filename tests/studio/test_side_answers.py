"""What a tab may ask beside the page: other assembly modes, equilibrium positions, the share of each load."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

import dalembert as da
from dalembert.model.files.model_files import loads, read_text
from dalembert.studio.document import Document
from dalembert.studio.editing.gestures import gesture
from dalembert.studio.problems import problem_text
from dalembert.studio.side_answers import assembly_modes, resting_positions, shares
from dalembert.studio.solver import ASKED, Question, answered


def off(a: dict[str, list[float]], b: dict[str, tuple[float, float, float]]) -> float:
    """Largest difference of two poses of the same links."""
    return max(
        max(math.dist(a[k][:2], b[k][:2]), abs(math.remainder(a[k][2] - b[k][2], 2 * math.pi))) for k in a
    )


@pytest.mark.parametrize(("name", "count"), [("four_bar", 2), ("engine", 2), ("quick_return", 2)])
def test_each_assembly_mode_can_be_taken(name: str, count: int) -> None:
    text = problem_text("example", name)
    modes = assembly_modes(loads(text))["modes"]
    assert len(modes) == count
    assert [mode["here"] for mode in modes] == [True] + [False] * (count - 1)
    for mode in modes:
        assert all(mode["svg"][theme].startswith("<svg") for theme in ("light", "dark"))
        d = Document(text)
        d.do(gesture({"op": "pose", "links": mode["links"], "drives": {}}))
        assert d.reading.sketch is not None
        assert d.reading.sketch.closed
        assert off(mode["links"], d.reading.sketch.placed) < 1e-9
        assert assembly_modes(loads(d.text))["modes"][0]["links"].keys() == mode["links"].keys()
        assert off(mode["links"], assembly_modes(loads(d.text))["modes"][0]["links"]) < 1e-9


def test_a_mechanism_rests_where_its_drive_needs_no_effort() -> None:
    text = problem_text("example", "four_bar")
    m, (tree, _) = loads(text), read_text(text)
    resting = resting_positions(m, tree)
    assert [row["stability"] for row in resting["rows"]] == ["stable", "unstable"]
    for row in resting["rows"]:
        here = da.statics(m.with_values({"drives.O2.position": row["position"]}))
        assert abs(here.effort("O2")[0]) < 1e-9 * np.abs(here.force_array).max()
    hung = problem_text("example", "bucket")
    assert "No position of cylinder" in resting_positions(loads(hung), read_text(hung)[0])["sentence"]


def test_the_shares_of_the_loads_add_up() -> None:
    r = da.dynamics(loads(problem_text("example", "four_bar")))
    told = shares(r)
    assert told["sources"][:2] == ["F_P", "T_4"]
    effort, *rest = told["rows"]
    assert effort["name"] == "effort of O2"
    assert effort["sum"] == pytest.approx(243.2376, abs=1e-4)
    assert sum(effort["values"]) == pytest.approx(effort["sum"])
    force = [row["sum"] * 4.4482216152605 for row in rest]
    assert np.allclose(force, r.force_array[0].ravel(), rtol=1e-9)


def test_every_question_of_a_tab_is_answered_or_refused_with_a_sentence(tmp_path: object) -> None:
    asked = Question("modes", problem_text("example", "gear_train"), "yaml", "m.yaml")
    for ask in sorted(ASKED - {"report", "design", "page", "check"}):
        answer = json.loads(json.dumps(answered(asked._replace(ask=ask))))
        assert ("error" in answer) == (ask == "superposition"), ask
    for ask, said in (("modes", "of the plane"), ("equilibria", "of the plane")):
        space = asked._replace(ask=ask, text=problem_text("example", "rssr"))
        assert said in answered(space)["error"]


@pytest.mark.long
def test_the_design_report_is_that_of_the_command(tmp_path: object) -> None:
    asked = Question("design", problem_text("example", "four_bar"), "yaml", "m.yaml")
    told = answered(asked)
    assert told["ending"] == "html"
