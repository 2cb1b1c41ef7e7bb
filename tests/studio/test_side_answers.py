"""What a tab may ask beside the page: other assembly modes, equilibrium positions, the share of each load."""

from __future__ import annotations

import base64
import json
import math
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from threading import Event, Thread

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import AnalysisError, ModelError
from dalembert.model.files.model_files import loads, read_text
from dalembert.studio.access import Access
from dalembert.studio.document import Document
from dalembert.studio.editing.gestures import gesture
from dalembert.studio.problems import problem_text
from dalembert.studio.side_answers import assembly_modes, resting_positions, shares
from dalembert.studio.solver import _ASKED, ASKED, Question, Solver, _serve, answered, written
from dalembert.studio.tab_messages import sentence
from tests.approved.commands import BROKEN


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
    assert all(off(modes[0]["links"], mode["links"]) > 0.01 for mode in modes[1:])
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


def test_a_block_on_a_spring_rests_within_its_travel() -> None:
    """k (0.4 m - s) = m g with k = 10 g kg/m: at 0.3 m, which is sought between the ends of the drive's positions."""
    text = """
gravity: standard
links: {ground: {points: {O: [0, 0]}}, block: {points: {B: [0, 0]}, mass: 1}}
joints: {S: {type: slider, links: [ground, block], at: [O, B], direction: 90}}
drives: {S: {position: [0.1 m, 0.2 m, 0.5 m], speed: 1 m/s}}
loads: {k: {type: spring, between: [ground.O, block.B], stiffness: 98.0665 N/m, free_length: 0.4 m}}
"""
    (row,) = resting_positions(loads(text), read_text(text)[0])["rows"]
    assert (row["position"], row["stability"]) == (pytest.approx(0.3), "stable")


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


def test_the_shares_of_an_unknown_load_are_its_own() -> None:
    """A couple that holds 3 N m at the crank against a force: each in proportion, and none where nothing is solved."""
    tree = da.four_bar(positions=1).to_tree()
    tree["drives"]["O2"] |= {"position": 1.0, "effort": 3.0}
    tree["loads"] = {
        "F": {"type": "force", "on": "coupler", "at": "B", "value": [50, -20]},
        "T": {"type": "couple", "on": "rocker", "value": "unknown"},
    }
    m = da.mechanism(tree)
    told = shares(da.statics(m))
    row = next(row for row in told["rows"] if row["name"] == "T")
    by = dict(zip(told["sources"], row["values"], strict=True))
    alone = {
        "F": da.statics(m.with_values({"drives.O2.effort": 0.0})),
        "effort of O2": da.statics(m.with_values({"loads.F.value": [0.0, 0.0]})),
    }
    assert row["unit"] == "N·m"
    assert {name: by[name] for name in by if abs(by[name]) > 1e-12} == pytest.approx(
        {name: float(r.unknown_load("T")[0]) for name, r in alone.items()}, rel=1e-9
    )
    assert row["sum"] == pytest.approx(float(da.statics(m).unknown_load("T")[0]), rel=1e-9)
    with pytest.raises(
        da.ModelError, match=r"^no position is solved; look at the sentence below the drawing$"
    ):
        shares(da.statics(m.with_values({"links.coupler.points.B.0": 0.01})))


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (ModelError("it is wrong", "mend it", (), "m.yaml", 3), "it is wrong; mend it"),
        (ModelError("it is wrong"), "it is wrong"),
        (AnalysisError("position 1: jammed"), "position 1: jammed"),
        (ZeroDivisionError("x"), "the studio failed (ZeroDivisionError); please report what you did"),
    ],
)
def test_an_error_is_told_without_its_file(error: Exception, said: str) -> None:
    assert sentence(error) == said


@pytest.mark.parametrize(
    ("host", "origin", "socket", "said"),
    [
        ("127.0.0.1:80", "", False, ""),
        ("localhost:80", "http://127.0.0.1:80", True, ""),
        ("127.0.0.1:80", "", True, "the origin of the page is missing"),
        ("127.0.0.1:80", "http://else", False, "pages of 'http://else' may not speak to this server"),
        ("else:80", "http://else:80", True, "this server is 127.0.0.1:80, not 'else:80'"),
        ("", "", False, "this server is 127.0.0.1:80, not ''"),
    ],
)
def test_who_may_speak_to_the_studio(host: str, origin: str, socket: bool, said: str) -> None:
    headers = {k: v for k, v in (("host", host), ("origin", origin)) if v}
    assert Access(80).refused(headers, socket) == said


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


def test_files_and_answers_to_download_are_those_of_the_text() -> None:
    """The page and the report as HTML; the published answers, each met; a static answer has no inertia."""
    asked = Question("check", problem_text("example", "rssr"), "yaml", "m.yaml")
    rows = answered(asked)["rows"]
    assert len(rows) == 6
    assert all(row["ok"] for row in rows)
    assert rows[3]["quantity"] == "effort of O, at 30 deg"
    assert rows[3]["published"].startswith("1045.39")
    assert rows[3]["computed"].startswith("1045.39")
    asked = asked._replace(text=problem_text("example", "four_bar"))
    for ask, word in (("page", "<title>Four-bar linkage, dynamic"), ("report", "Mobility 1, drives 1")):
        told = answered(asked._replace(ask=ask))
        assert told["ending"] == "html"
        assert word in base64.b64decode(told["file"]).decode()
    still = answered(asked._replace(ask="superposition", static=True))
    assert still["sources"] == ["F_P", "T_4"]


def test_friction_is_left_out_where_the_tab_says_so() -> None:
    text = problem_text("problem", "seed-002-7a-engine-friction-circles")
    asked = Question("superposition", text, "yaml", "m.yaml", friction=False)
    told = answered(asked)
    m = loads(text).with_values({"friction.enabled": False})
    r = da.solve(m)
    effort = next(row for row in told["rows"] if row["name"].startswith("effort"))
    assert effort["unit"] == "N·m"
    assert effort["sum"] == pytest.approx(r.effort(r.drives[0])[told["position"]], rel=1e-6)
    assert "error" in answered(asked._replace(friction=True))


def test_what_cannot_be_answered_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    no_drive = (
        "links: {a: {points: {A: [0, 0], B: [1, 0]}}}\njoints: {A: {type: pin, links: [ground, a], at: A}}\n"
    )
    no_drive = no_drive.replace("links: {", "links: {ground: {points: {A: [0, 0]}}, ", 1)
    asked = Question("equilibria", no_drive, "yaml", "m.yaml")
    assert "sought along a drive; add a drive where it moves" in answered(asked)["error"]
    assert (
        "the linkage does not close at the first position"
        in answered(asked._replace(ask="modes", text=BROKEN))["error"]
    )
    assert "links" in answered(asked._replace(ask="data", text="links: 3"))["missing"]

    def full(*_: object) -> None:
        raise MemoryError

    for fault, said in (
        (full, "too little memory"),
        (lambda *_: 1 // 0, "the analysis failed (ZeroDivisionError)"),
    ):
        monkeypatch.setitem(_ASKED, "modes", fault)
        assert said in answered(asked._replace(ask="modes"))["error"]


class Piped(Solver):
    """A solver whose process is a thread of this one."""

    def _connection(self) -> Connection:
        if self._pipe is None:
            self._pipe, there = Pipe()
            Thread(target=_serve, args=(there,)).start()
        return self._pipe


def test_the_process_of_a_solver_answers_until_its_pipe_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_limit_memory", "collect_rarely", "signal.signal"):
        monkeypatch.setattr(f"dalembert.studio.solver.{name}", lambda *_: None)
    asked = Question("modes", problem_text("example", "four_bar"), "yaml", "m.yaml")
    solver = Piped()
    for ask in ("modes", "nothing"):
        assert json.loads(solver.ask(asked._replace(ask=ask))) == json.loads(
            written(answered(asked._replace(ask=ask)))
        )
    held = Event()
    monkeypatch.setitem(_ASKED, "check", lambda *_: held.wait(20) or {})
    solver.seconds = 0.01
    late = json.loads(solver.ask(asked._replace(ask="check")))
    held.set()
    assert late["error"] == "no answer within 0.01 s; use fewer positions or a smaller mechanism"
    solver.seconds = 5.0
    assert len(json.loads(solver.ask(asked))["modes"]) == 2, "a new one is started"
    solver.close()


class Ended(Solver):
    """A solver whose process has ended."""

    def _connection(self) -> Connection:
        here, there = Pipe()
        there.close()
        return here


def test_a_process_that_ended_is_said() -> None:
    asked = Question("data", "", "yaml", "m.yaml")
    told = json.loads(Ended().ask(asked))
    assert told["missing"] == "the solver ended: out of memory; use fewer positions or a smaller mechanism"


SHORT = """
links:
  ground: {points: {O: [0, 0], C: [0, 0]}}
  crank: {points: {O: [0, 0], A: [2, 0]}}
  rod: {points: {A: [0, 0], B: [1, 0]}}
  block: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, block]}
  C: {type: slider, links: [ground, block], at: [C, B]}
drives: {O: {position: [90, 20, 10]}}
loads: {F: {type: force, on: block, at: B, value: [3, 0]}, T: {type: couple, on: crank, value: 2}}
assembly: {rod: -30}
"""


def test_shares_are_those_of_the_first_position_that_is_solved() -> None:
    """At 90 deg the rod is too short."""
    r = da.statics(loads(SHORT))
    assert r.status == ("not_assembled", "ok", "ok")
    effort = shares(r)["rows"][0]
    assert effort["sum"] == pytest.approx(r.effort("O")[1])
    assert -2.0 in effort["values"]
