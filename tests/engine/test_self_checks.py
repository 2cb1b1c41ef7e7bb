"""Every check of an answer shown a wrong one: it speaks from its limit on, and is silent below."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis import one_pass
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.engine import first_way, quick_pass, structures, walk
from dalembert.analysis.engine.flat_numbers import flat_numbers
from dalembert.analysis.engine.kept_program import TracedOutputs
from dalembert.analysis.positions import FARTHEST, positions
from dalembert.analysis.status.statuses import UNBALANCED, statuses
from dalembert.core.position.assembly_modes import NEAR
from dalembert.core.rank import singular_below
from tests.engine.comparing import counted
from tests.friction.rough import cycle

COUNT = 6


def answered(m: Any) -> str:
    with counted() as ways:
        da.dynamics(m)
    return ways[0]


@pytest.fixture(params=["all", "forces"])
def answer(request: pytest.FixtureRequest) -> tuple[Any, str]:
    """A mechanism, and what programs answer of it."""
    m = da.four_bar(positions=COUNT) if request.param == "all" else cycle("four_bar", COUNT)
    assert answered(m) == request.param
    return m, request.param


@pytest.mark.parametrize(("part", "sure"), [(0.99, True), (1.01, False), (np.nan, False), (np.inf, False)])
def test_a_residual_is_believed_up_to_its_limit(
    part: float, sure: bool, answer: tuple[Any, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """At one position of many; all are then the careful path's, or that one is."""
    m, way = answer

    def balance(k: Any, layout: Any, out: Any) -> Any:
        residual = np.zeros(out.shape[1])
        residual[3] = part * UNBALANCED
        return residual, np.zeros(out.shape[1])

    monkeypatch.setattr(TracedOutputs, "balance", balance)
    assert (answered(m) == way) is sure
    assert da.dynamics(m).ok.all()


@pytest.mark.parametrize(
    ("way", "row", "value"),
    [
        ("all", "closure", -1e-300),
        ("all", "closure", np.nan),
        ("all", "twist", np.nan),
        ("forces", "margin", -1e-300),
        ("forces", "margin", np.nan),
        ("forces", "twist", np.nan),
        ("forces", "twist", np.inf),
    ],
)
def test_an_output_that_says_doubt_is_heard(
    way: str, row: str, value: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At the last position of several."""
    m = da.four_bar(positions=COUNT) if way == "all" else cycle("four_bar", COUNT)
    assert answered(m) == way
    evaluate = TracedOutputs.run.func  # type: ignore[attr-defined]

    def run(k: Any) -> Any:
        program = evaluate(k)

        def doubting(values: Any, out: Any, **how: Any) -> None:
            program(values, out, **how)
            if row in k.nodes:
                assert k.nodes[row].size
                out[k.rows[row].start, -1] = value

        return doubting

    monkeypatch.setattr(TracedOutputs, "run", property(run))
    assert answered(m) != way


def found_of(m: Any) -> tuple[Any, Any, Any]:
    """Positions, motion and forces of a mechanism as the careful path has them."""
    followed = positions(compile_mechanism(m, m.schedule()))
    assert followed.path is not None
    moved, forces = one_pass._blocks(followed.compiled, followed.path.pose, True, True)
    return followed, moved, forces


def with_one(array: Any, value: float, place: Any = 2) -> Any:
    out = np.array(array)
    out[place] = value
    return out


LIMIT = singular_below(compile_mechanism(m := da.four_bar(positions=COUNT), m.schedule()).layout)
WRONG: dict[str, tuple[Callable[[Any, Any], Any], str]] = {
    "all is well": (lambda v, f: (v, f), "ok"),
    "residual below": (lambda v, f: (v, f._replace(residual=with_one(f.residual, 0.99e-6))), "ok"),
    "residual above": (lambda v, f: (v, f._replace(residual=with_one(f.residual, 1.01e-6))), "no_balance"),
    "no residual": (lambda v, f: (v, f._replace(residual=with_one(f.residual, np.nan))), "overflow"),
    "forces held": (lambda v, f: (v, f._replace(rcond=with_one(f.rcond, LIMIT * 1.01))), "ok"),
    "forces not held": (lambda v, f: (v, f._replace(rcond=with_one(f.rcond, LIMIT * 0.99))), "no_balance"),
    "rates held": (lambda v, f: (v._replace(rcond=with_one(v.rcond, LIMIT * 1.01)), f), "ok"),
    "dead centre": (lambda v, f: (v._replace(rcond=with_one(v.rcond, LIMIT * 0.99)), f), "singular"),
    "no condition": (lambda v, f: (v._replace(rcond=with_one(v.rcond, np.nan)), f), "singular"),
    "no rates": (
        lambda v, f: (v._replace(acceleration=with_one(v.acceleration, np.inf, (2, 1, 0))), f),
        "overflow",
    ),
    "no force": (lambda v, f: (v, f._replace(force=with_one(f.force, np.inf, (2, 1, 0)))), "overflow"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_position_has_the_status_of_what_is_wrong_with_it(name: str) -> None:
    """And no other position; the sentence is there just where the status is not ok."""
    change, status = WRONG[name]
    followed, moved, forces = found_of(da.four_bar(positions=COUNT))
    moved, forces = change(moved, forces)
    found, reasons = statuses(followed, moved.twist, moved.acceleration, moved.rcond, forces, True, True)
    assert found == ("ok", "ok", status, "ok", "ok", "ok")
    assert [bool(x) for x in reasons] == [s != "ok" for s in found]


def test_each_run_of_positions_has_the_sentence_of_its_first() -> None:
    followed, moved, forces = found_of(da.four_bar(positions=COUNT))
    moved = moved._replace(rcond=with_one(moved.rcond, 0.0, [0, 1, 4]))
    found, reasons = statuses(followed, moved.twist, moved.acceleration, moved.rcond, forces, True, True)
    assert [s == "singular" for s in found] == [True, True, False, False, True, False]
    at = ["O2 = 0 deg", "O2 = 0 deg", "", "", "O2 = 240 deg", ""]
    assert [
        (r or "")[: len("Dead centre or change point at ") + len(a)] for r, a in zip(reasons, at, strict=True)
    ] == [a and f"Dead centre or change point at {a}" for a in at]
    assert (
        statuses(followed, moved.twist, moved.acceleration, moved.rcond + 1, forces, False, True)[0]
        == ("ok",) * COUNT
    )


def test_forces_that_nobody_asks_for_are_not_judged() -> None:
    followed, moved, forces = found_of(da.four_bar(positions=COUNT))
    bad = forces._replace(residual=forces.residual + 1)
    v = moved.twist, moved.acceleration, moved.rcond
    assert set(statuses(followed, *v, bad, True, True)[0]) == {"no_balance"}
    assert set(statuses(followed, *v, bad, False, True)[0]) == {"ok"}


def test_a_key_knows_the_size_of_a_machine() -> None:
    """Small numbers are told from nothing by it: a machine ten times as large has a program of its own."""
    m = da.four_bar()
    points = {f"links.{k}.points.{p}": [30 * x for x in m.point(k, p)] for k in m.links for p in m.points(k)}
    keys = {flat_numbers(compile_mechanism(x, x.schedule(1))).key[0] for x in (m, m.with_values(points))}
    assert len(keys) == 2


@pytest.mark.parametrize(
    ("parts", "whole"),
    [
        ([0.0, 1.0], True),
        ([0.0, walk.TURN * 0.99], True),
        ([0.0, walk.TURN * 1.01], False),
        ([0.0, 0.9, 1.8, 2.7, 3.6, 4.5, 5.4, 6.3], True),
        ([0.0, -0.9, -1.8, -2.7, -3.6, -4.5], True),
    ],
)
def test_turns_are_counted_by_steps_up_to_a_limit(parts: list[float], whole: bool) -> None:
    """Of a link whose cosine and sine are given; it starts two turns on."""
    angle = np.array(parts)
    k = _Turning(1)
    out = np.stack([np.full(len(angle), np.nan), np.cos(angle), np.sin(angle)])
    way = walk.Walk(np.arange(len(angle)), np.zeros((0, 1)), np.zeros(0, np.intp))
    assert walk.count_turns(k, out, way, np.array([4 * np.pi])) is whole  # type: ignore[arg-type]
    if whole:
        np.testing.assert_allclose(out[0], angle + 4 * np.pi)


class _Turning:
    """What the count of turns asks of a program: rows of turns and of rotations, and which links are free."""

    def __init__(self, links: int) -> None:
        self.rows = {"turn": slice(0, links), "rotation": slice(links, 3 * links)}
        self.free, self.fixed = np.arange(links), np.zeros(links, bool)
        self.squares = 1


@pytest.mark.parametrize(
    ("squares", "steady"),
    [
        ([4.0, 1.01], True),
        ([4.0, 0.99], False),
        ([1.01, 4.0], True),
        ([0.99, 4.0], False),
        ([4.0, 4.0, 0.5], False),
    ],
)
def test_what_vanishes_at_a_dead_centre_changes_by_less_than_it_is(
    squares: list[float], steady: bool
) -> None:
    way = walk.Walk(np.arange(len(squares)), np.zeros((0, 1)), np.zeros(0, np.intp))
    assert walk.is_steady(_Turning(1), np.array([squares]), way) is steady  # type: ignore[arg-type]


@pytest.mark.parametrize(("part", "followed"), [(0.99, True), (1.01, False)])
def test_a_motion_is_looked_at_as_far_as_that_can_be_done(part: float, followed: bool) -> None:
    m = da.four_bar().with_values({"drives.O2.position": (-0.5, 0.0, part * FARTHEST)})
    c = compile_mechanism(m, m.schedule())
    assert (walk.walk_through(c, FARTHEST) is not None) is followed
    step = part * FARTHEST / (walk.MOST * (0.999 if followed else 1.001))
    near = walk.walk_through(compile_mechanism(m := _two(0.5), m.schedule()), 0.5 / (walk.MOST + 2) / part)
    assert (near is not None) is followed
    assert step > 0


def _two(far: float) -> Any:
    return da.four_bar().with_values({"drives.O2.position": (0.0, far)})


def test_first_poses_are_remembered_up_to_a_number(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())
    for k in range(first_way.REMEMBERED + 3):
        da.dynamics(da.four_bar(positions=2).with_values({"drives.O2.position": (0.1 + 0.01 * k, 0.2)}))
    (program,) = (k for k in structures.STRUCTURES.found.values() if isinstance(k, structures.KeptProgram))
    assert len(program.known) == 3
    assert quick_pass.BLOCK == structures.BLOCK


def test_moments_are_compared_with_forces_by_the_length() -> None:
    """Of the plane's rows those of moments of joints, and the last of each link's loads, which is its couple."""
    c = compile_mechanism(da.four_bar(), da.four_bar().schedule(3))
    ready = structures.ready(c, True)
    assert ready is not None
    k = ready.program
    loads = k.nodes["loads"]
    forces, moments = k.nodes["force"].size, k.nodes["moment"].size
    assert k.moments.tolist() == [False] * forces + [True] * moments + [False, False, True] * (
        loads.size // 3
    )


@pytest.mark.parametrize(("part", "known"), [(0.99, True), (1.01, False)])
def test_given_angles_choose_a_mode_up_to_their_largest_error(
    part: float, known: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those of two links off by 0.6 and 0.8 of it: beyond it a search decides, to the same pose."""
    at, choose, chosen = {"drives.O2.position": 0.9}, first_way._by_known_angles, list[Any]()

    def by_known_angles(*of: Any) -> Any:
        chosen.append(choose(*of))
        return chosen[-1]

    monkeypatch.setattr(first_way, "_by_known_angles", by_known_angles)
    monkeypatch.setattr(structures, "STRUCTURES", structures.Structures())
    m = da.four_bar().with_values(at)
    right = {link: float(da.statics(m).angle(link)[0]) for link in ("coupler", "rocker")}
    off = {"coupler": 0.6 * part * NEAR, "rocker": -0.8 * part * NEAR}
    r = da.statics(m.with_values({f"assembly.{n}": x + off[n] for n, x in right.items()}))
    assert (chosen[-1] is not None) is known
    assert {n: r.angle(n)[0] for n in right} == pytest.approx(right)


def test_of_the_kept_programs_those_not_used_longest_go_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(structures, "KEPT", 3)
    kept = structures.Structures()
    for key in "abc":
        kept.put(key, None)
    assert kept.get("a") == (True, None)
    kept.put("d", None)
    assert [*kept.found] == ["c", "a", "d"]
    assert kept.size == 3
