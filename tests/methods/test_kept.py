"""What an answer computes once: the motion and the forces on its links; and what travels with a pickle."""

import pickle
from dataclasses import fields, replace

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods import applied_forces
from dalembert.bundled import examples


def test_a_report_solves_the_motion_of_an_answer_once(monkeypatch: pytest.MonkeyPatch) -> None:
    answers, motion = [], applied_forces.motion
    monkeypatch.setattr(applied_forces, "motion", lambda *given: answers.append(given[1]) or motion(*given))
    r = da.dynamics(da.load(examples()["four_bar"]))
    da.report(r).to_bytes("txt")
    mine = [pose for pose in answers if pose.point.shape == answers[0].point.shape]
    assert len(mine) == len({pose.point.tobytes() for pose in mine})


def test_a_changed_copy_computes_its_own() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    force = [a.force for a in applied_forces.actions(r) if a.kind == "joint"]
    twice = applied_forces.actions(replace(r, force_array=2 * r.force_array))
    assert np.stack([a.force for a in twice if a.kind == "joint"]) == pytest.approx(2 * np.stack(force))


@pytest.mark.parametrize("name", ["four_bar", "rssr", "scissor_lift"])
def test_an_answer_is_pickled_without_what_it_keeps(name: str) -> None:
    r = da.dynamics(da.load(examples()[name]))
    text = str(r)
    read = pickle.loads(pickle.dumps(r))
    assert set(vars(read)) == {f.name for f in fields(r)} < set(vars(r))
    assert str(read) == text
