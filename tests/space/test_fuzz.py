"""Mutated files and changed trees in space: refused with their line, or answered honestly."""

from __future__ import annotations

import json
import random
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.output.summary.printed_answer import answer_text
from dalembert.bundled import examples
from dalembert.core.position import newton
from dalembert.model import loads, tree_text
from tests.laws.mutations import mutated as changed
from tests.model.test_fuzz import loaded, mutated
from tests.oracles.space.machines import EXAMPLES
from tests.tiers import tiers

TEXT = (Path(__file__).parents[1] / "model" / "rssr.yaml").read_text(encoding="utf-8")


@cache
def texts() -> dict[str, str]:
    tree = loads(TEXT).to_tree()
    return {"yaml": TEXT, "json": tree_text(tree, "json"), "toml": tree_text(tree, "toml")}


def read(seed: int) -> None:
    draw = random.Random(seed)
    form = draw.choice(sorted(texts()))
    found = loaded(mutated(texts()[form], draw), form)
    if isinstance(found, da.ModelError):
        assert str(found).startswith("file:")
        assert found.line > 0
    else:
        assert loads(tree_text(found.to_tree())) == found


@pytest.mark.parametrize("block", tiers([0], range(1, 6), range(6, 40)))
def test_a_mutated_file_is_a_mechanism_or_a_model_error(block: int) -> None:
    for seed in range(250 * block, 250 * (block + 1)):
        read(seed)


@cache
def bases() -> tuple[dict[str, Any], ...]:
    """The oracles' mechanisms at three positions, with shapes, springs and damped turns in some."""
    trees = [deepcopy(example.tree) for example in EXAMPLES.values()]
    trees += [loads(TEXT).to_tree(), da.load(examples()["rssr"]).to_tree()]
    for tree in trees:
        tree.pop("answers", None)
        for drive in tree["drives"].values():
            if isinstance(drive.get("position"), dict):
                drive["position"]["count"] = 3
    return tuple(trees)


def answered(seed: int) -> None:
    try:
        r = da.solve(da.mechanism(changed(bases()[seed % len(bases())], seed)))
    except da.ModelError as error:
        assert error.what  # noqa: PT017
        return
    for axes in ("ground", "joint") if r.mechanism.dimension == 3 else ("ground", "link"):
        json.dumps(r.to_dict(axes=axes), allow_nan=False)  # type: ignore[arg-type]
    assert answer_text(r)
    for k, status in enumerate(r.status):
        if status == "ok":
            assert r.residual[k] < 1e-6
            assert abs(r.power_balance[k]) < 1e-6
            assert all(np.isfinite(r.least_norm(joint)[k]).all() for joint in r.joints)
            assert all(np.isfinite(r.rotation(link)[k]).all() for link in r.links)
        else:
            assert r.reasons[k]


@pytest.mark.parametrize("block", tiers([0], range(1, 12), range(12, 160)))
def test_a_changed_tree_is_refused_or_answered_honestly(block: int) -> None:
    for seed in range(50 * block, 50 * (block + 1)):
        answered(seed)


@pytest.mark.parametrize(("name", "joint"), [("rssr", "C"), ("four_bar", "A")])
def test_a_drive_too_many_is_named_by_as_many_iterations_as_one_position_takes(
    name: str, joint: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Found by a changed tree: drives that nothing closes with were laid although they were left out."""
    tree, steps, step, taken = da.load(examples()[name]).to_tree(), list[int](), newton.step, set[int]()

    def counted(layout: Any, pose: Any, gap: Any) -> Any:
        steps.append(len(gap))
        return step(layout, pose, gap)

    tree.pop("answers", None)
    (drive,) = tree["drives"]
    monkeypatch.setattr(newton, "step", counted)
    for last in (0, 40):
        position = {"from": "100 deg", "to": f"{100 + last} deg", "count": 1 + last}
        tree["drives"] = {drive: {"position": position}, joint: {"position": "100 deg"}}
        steps.clear()
        with pytest.raises(da.ModelError) as caught:
            da.solve(da.mechanism(tree))
        says = f"the mechanism has 1 degree of freedom and 2 drives; remove 1 drive of {drive}, {joint}"
        assert str(caught.value) == says
        taken.add(sum(steps))
    assert len(taken) == 1
    assert taken != {0}
