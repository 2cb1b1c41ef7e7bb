"""Every kind of two-link group, joint and load with large changes of all numbers; statuses where there is no answer."""

from __future__ import annotations

import copy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import CODES
from dalembert.analysis.batch.careful_path import _schedule
from dalembert.analysis.batch.tracing.kernel_inputs import _carry_sign_forward
from dalembert.studies.block_engines import AnalysisEngine, make_engine
from tests.kernel.comparing import changed, difference, every_number, general
from tests.kernel.machines import KINDS, four_bar, four_bar_tree

TOLERANCE = 1e-10
MODELS = Path(__file__).parents[1] / "machine" / "models"


@pytest.mark.parametrize("kind", KINDS)
def test_kinds_of_groups(kind: str) -> None:
    m = KINDS[kind]()
    k = da.compile(m, vary=every_number(m))
    values = np.stack([k.nominal, changed(k, 1, shape=0.03), changed(k, 2, shape=0.03)])
    r = k(values)
    assert r.redone == 0
    assert r.ok[0].all()
    assert max(difference(k, r, d, general(m, k, values[d])) for d in range(3)) < TOLERANCE


def test_every_load() -> None:
    m = four_bar()
    k = da.compile(m, vary=[*every_number(m), "gravity"][:-1])
    values = np.stack([changed(k, seed, shape=0.03) for seed in range(3)])
    r = k(values)
    assert max(difference(k, r, d, general(m, k, values[d])) for d in range(3)) < TOLERANCE


def test_statics_and_motion() -> None:
    """Without inertia, and quantities of the links."""
    m = four_bar()
    outputs = [
        "angle.rocker",
        "angle.coupler.speed",
        "angle.rocker.acceleration",
        "point.coupler.P",
        "point.coupler.P.velocity",
    ]
    outputs += ["point.coupler.center.acceleration", "point.rocker.origin", "effort.O2", "residual"]
    r, g = da.compile(m, outputs=outputs, static=True)(), da.statics(m)
    assert np.abs(r.angle("rocker")[0] - g.angle("rocker")).max() < 1e-12
    assert np.abs(r.speed("coupler")[0] - g.speed("coupler")).max() < 1e-10
    assert np.abs(r.acceleration("rocker")[0] / g.acceleration("rocker") - 1).max() < 1e-9
    assert np.abs(r.point("coupler", "P")[0] - g.point("coupler", "P")).max() < 1e-12
    assert np.abs(r.point_velocity("coupler", "P")[0] - g.point_velocity("coupler", "P")).max() < 1e-11
    assert np.abs(r.center_acceleration("coupler")[0] - g.center_acceleration("coupler")).max() < 1e-8
    assert np.abs(r.position("rocker")[0] - g.position("rocker")).max() < 1e-12
    assert np.abs(r.effort("O2")[0] - g.effort("O2")).max() < 1e-10 * np.abs(g.effort("O2")).max()
    assert r.value("residual").max() < 1e-13


def test_known_effort_and_unknown_load() -> None:
    tree = four_bar_tree()
    tree["drives"]["O2"]["effort"] = "2 + cos(O2)"
    tree["loads"]["T"]["value"] = "unknown"
    m = da.mechanism(tree)
    k = da.compile(m, vary=["links.coupler.mass", "loads.F.value"])
    r, g = k(), da.dynamics(m)
    assert (
        np.abs(r.unknown_load("T")[0] - g.unknown_load("T")).max() < 1e-10 * np.abs(g.unknown_load("T")).max()
    )


@pytest.mark.parametrize(
    ("crank", "rocker", "angle"),
    [(0.1, 0.1, 0), (0.2, 0.2, 80), pytest.param(0.25, 0.2, 80, marks=pytest.mark.long)],
)
def test_statuses(crank: float, rocker: float, angle: float) -> None:
    """A parallelogram at its change points, and linkages that do not close all round."""
    tree = copy.deepcopy(four_bar_tree(36))
    tree["links"]["ground"]["points"]["O4"] = [0.3, 0]
    tree["links"]["crank"]["points"]["A"] = [crank, 0]
    tree["links"]["coupler"]["points"]["B"] = [0.3 if crank == 0.1 else 0.25, 0]
    tree["links"]["rocker"]["points"]["B"] = [rocker, 0]
    tree["drives"]["O2"]["position"] = {"from": 60, "to": 420, "count": 36}
    tree["assembly"] = {"coupler": 0 if crank == 0.1 else 20, "rocker": angle or 60}
    m = da.mechanism(tree)
    k = da.compile(m, vary=["links.coupler.points.B", "links.coupler.mass"])
    values = np.stack([k.nominal, k.nominal * [0.99, 1, 1], k.nominal * [1, 1, 2]])
    r = k(values)
    for d in range(3):
        g = general(m, k, values[d])
        assert tuple(r.status[d]) == g.status
        assert difference(k, r, d, g) < 1e-9


def test_reactions_on_either_link() -> None:
    """As the general executor has them, in both kinds of axes; the mean changes its sign, a size does not."""
    m = da.bucket(positions=4)
    joint, (i, j) = "cylinder", m.joints["cylinder"].links
    outputs = [f"reaction.{joint}", f"reaction_moment.{joint}"]
    r, g = da.compile(m, outputs=[*outputs, f"angle.{i}", f"angle.{j}"])(), da.dynamics(m)
    mean, peak, both = (da.compile(m, outputs=outputs, reduce=how)() for how in ("mean", "peak", "envelope"))
    for on in (None, i, j):
        for axes in ("ground", "link"):
            expected = g.reaction(joint, on=on, axes=axes)
            assert r.reaction(joint, on, axes)[0] == pytest.approx(expected, rel=1e-9)
        assert r.reaction_moment(joint, on)[0] == pytest.approx(g.reaction_moment(joint, on=on), rel=1e-9)
        assert mean.reaction(joint, on)[0] == pytest.approx(g.reaction(joint, on=on).mean(axis=0), rel=1e-9)
        assert peak.reaction(joint, on)[0] == pytest.approx(np.abs(g.reaction(joint)).max(axis=0), rel=1e-9)
    assert both.reaction(joint, j)[0] == pytest.approx(both.reaction(joint)[0])
    with pytest.raises(da.ModelError, match=f"the envelope is that of the force on '{j}'"):
        both.reaction(joint, i)
    with pytest.raises(da.ModelError, match=f"joint '{joint}' does not act on 'boom'; it joins {i} and {j}"):
        r.reaction(joint, "boom")


def test_a_design_keeps_its_own_speeds() -> None:
    """At as many positions as it has itself all of them, at others the first."""
    drive = {
        "position": [0, 10, 20],
        "speed": ["1 rad/s", "2 rad/s", "4 rad/s"],
        "acceleration": ["3 rad/s^2", "2 rad/s^2", "1 rad/s^2"],
    }
    m = da.mechanism(da.four_bar().to_tree() | {"drives": {"O2": drive}})
    for count, speeds in ((3, [1, 2, 4]), (4, [1] * 4)):
        own = m.schedule()
        asked = replace(own, position=np.zeros((count, 1)))
        found = _schedule(m, asked)
        assert found.speed[:, 0] == pytest.approx(speeds)
        assert found.acceleration[:, 0] == pytest.approx(
            own.acceleration[: 3 if count == 3 else 1, 0] * np.ones(count)
        )


def test_a_way_of_closing_holds_where_both_coincide() -> None:
    """Of a dead centre the way is that before it, at the beginning the first that there is."""
    found = _carry_sign_forward(np.array([0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 1.0]))
    assert found.tolist() == [1, 1, 1, 1, -1, -1, -1, 1]


def test_lengths_choose_the_motion_only_where_it_passes_change_points() -> None:
    """A parallelogram of another length may go on as the other linkage; of another mass it does not."""
    parallelogram = da.four_bar(ground=0.3, crank=0.1, coupler=0.3, rocker=0.1, sweep=(0.3, 3.6), positions=6)
    for m, told in ((parallelogram, [False, True, False]), (da.four_bar(positions=6), None)):
        k = da.compile(m, vary=["links.ground.points.O4.0", "links.rocker.mass"])
        changes = k.may_change_branch(k.nominal * np.array([[1, 1], [1.001, 1], [1, 1.1]]))
        assert (changes if changes is None else changes.tolist()) == told


def test_other_positions() -> None:
    m = four_bar(12)
    k = da.compile(m)
    q = np.linspace(0.3, 2.0, 40)
    r = k(positions=q)
    tree = four_bar_tree()
    tree["drives"]["O2"]["position"] = np.degrees(q).tolist()
    g = da.dynamics(da.mechanism(tree))
    assert np.abs(r.effort("O2")[0] - g.effort("O2")).max() < 1e-10 * np.abs(g.effort("O2")).max()


def test_refusals() -> None:
    m = da.four_bar()
    for text, arguments in (
        ("unknown output 'torque.O2'", {"outputs": ["torque.O2"]}),
        ("unknown reduction 'largest'", {"reduce": "largest"}),
        ("'masss' does not exist in links.crank", {"vary": ["links.crank.masss"]}),
        ("'title' is 'Four-bar linkage', not a number", {"vary": ["title"]}),
        ("the place of a peak has no derivative", {"reduce": "argpeak", "derivatives": True}),
    ):
        with pytest.raises(da.ModelError, match=text):
            da.compile(m, **arguments)
    k = da.compile(m, vary=["links.crank.mass"], outputs=["effort.O2"])
    with pytest.raises(da.ModelError, match="do not fit 1 number"):
        k(np.zeros((3, 2)))
    with pytest.raises(da.ModelError, match="was not compiled"):
        k().reaction("A")


CALLS: list[tuple[str, dict[str, Any]]] = [
    ("values are text", {"values": [["heavy"]]}),
    ("positions are text", {"positions": ["half a turn"]}),
    ("positions are not all finite", {"positions": [0.0, np.nan]}),
    ("positions of shape (0, 1) do not fit 1 drive(s)", {"positions": []}),
    ("threads=0 is not a number of threads; give 1 or more", {"threads": 0}),
    ("unknown device 'gpu'; use cpu or cuda", {"device": "gpu"}),
]


@pytest.mark.parametrize(("sentence", "arguments"), CALLS)
def test_calls_that_are_refused(sentence: str, arguments: dict[str, Any]) -> None:
    k = da.compile(da.four_bar(), vary="links.coupler.mass", outputs="reaction.A")
    with pytest.raises(da.ModelError) as refusal:
        k(**arguments)
    assert sentence in str(refusal.value)


def test_more_refusals() -> None:
    m = da.four_bar()
    for text, arguments in (
        ("unknown output 'residual.A'", {"outputs": ["residual.A"]}),
        ("lanes=0 is not a number of lanes", {"lanes": 0}),
    ):
        with pytest.raises(da.ModelError, match=text):
            da.compile(m, **arguments)
    lawful = m.to_tree() | {
        "drives": {"O2": {"law": {"type": "cycloidal", "from": 0, "to": 90, "duration": 0.5, "count": 9}}}
    }
    with pytest.raises(da.ModelError, match=r"'drives\.O2\.speed' follows from the drive's law of motion"):
        da.compile(da.mechanism(lawful), vary=["drives.O2.speed"])
    k = da.compile(m, outputs=["reaction.A", "angle.coupler"])
    with pytest.raises(da.ModelError, match="unknown axes 'joint'; use ground or link"):
        k().reaction("A", axes="joint")
    pytest.importorskip("casadi")
    with pytest.raises(da.ModelError, match="'1 x' is not a valid name for a casadi Function"):
        k.to_casadi("1 x")


@pytest.mark.parametrize("reduce", [None, "peak", "mean"])
def test_no_designs_and_designs_without_a_number(reduce: str | None) -> None:
    """Of no designs there are no answers; a number that is none fails its design alone, whatever it is of."""
    k = da.compile(
        da.four_bar(), vary=["links.coupler.mass"], outputs=["effort.O2"], reduce=reduce, derivatives=True
    )
    none = k(np.zeros((0, 1)))
    assert none.effort("O2").shape[0] == none.gradient("effort.O2").shape[0] == 0
    assert none.problems() == []
    r = k([[1.0], [np.nan], [np.inf]])
    assert [which for which, status, _ in r.problems() if status == "failed"] == [1, 2]
    assert np.isfinite(r.effort("O2")[0]).all()
    assert np.isnan(r.effort("O2")[1:]).all()
    assert np.isnan(r.gradient("effort.O2")[1:]).all()


@pytest.mark.parametrize("reduce", ["rms", "norm8"])
def test_what_is_always_zero_has_slope_zero(reduce: str) -> None:
    k = da.compile(
        da.four_bar(),
        vary=["links.coupler.mass"],
        outputs=["reaction_moment.A"],
        reduce=reduce,
        derivatives=True,
    )
    assert (k().gradient("reaction_moment.A") == 0).all()


@pytest.mark.long
def test_what_redundant_constraints_leave_open_is_refused_with_its_reason() -> None:
    """A second coupler at the same pins: the effort, the frame's forces and the motion are those of the first alone."""
    tree = four_bar_tree()
    one = da.dynamics(da.mechanism(tree))
    tree["links"]["bar"] = {"points": {"A": [0, 0], "B": [0.32, 0]}}
    tree["joints"]["A2"] = {"type": "pin", "links": ["crank", "bar"], "at": ["A", "A"]}
    tree["joints"]["B2"] = {"type": "pin", "links": ["bar", "rocker"], "at": ["B", "B"]}
    m = da.mechanism(tree)
    k = da.compile(m, ["links.bar.points.B.0"], derivatives=True)
    assert k.outputs == ("effort.O2", "reaction.O2", "reaction.O4")
    r = k([[0.32], [0.33]])
    assert r.ok[0].all()
    assert not r.ok[1].any()
    assert r.effort("O2")[0] == pytest.approx(one.effort("O2"), rel=1e-10)
    assert r.reaction("O4")[0] == pytest.approx(one.reaction("O4"), rel=1e-10)
    with pytest.raises(
        da.ModelError, match=r"reaction.A2.magnitude cannot be compiled: constraints are redundant"
    ):
        da.compile(m, outputs=["reaction.A2.magnitude", "angle.rocker.speed"])
    _same_where_redundant(m)


@pytest.mark.parametrize(("coefficient", "status"), [(0.385, "self_locking"), (9.0, "jammed")])
def test_a_joint_that_shares_its_load_is_not_compiled_where_friction_locks(
    coefficient: float, status: str
) -> None:
    """The lever of a brake on two pins at one place; the drum turns so that the shoe holds it, or locks."""
    tree = da.load(MODELS / "block-brake-with-a-short-shoe.yaml").to_tree()
    tree["joints"]["twin"] = {"type": "pin", "links": ["ground", "lever"], "at": ["L", "L"]}
    tree["joints"]["S"]["friction"]["coefficient"] = coefficient
    tree["drives"]["D"]["speed"] = "5 rad/s"
    tree["loads"]["put"] = {"type": "couple", "on": "drum", "value": 12.0}
    m, path = da.mechanism(tree), "loads.P.value.1"
    assert da.dynamics(m).status == (status,)
    assert da.compile(m, [path]).outputs == ("effort.D", "reaction.D", "reaction.S")
    for of in ("L", "twin"):
        with pytest.raises(da.ModelError, match=rf"2\*reaction.{of}.x cannot be compiled: constraints are"):
            da.compile(m, [path], [f"2*reaction.{of}.x"])


def _same_where_redundant(m: da.Mechanism) -> None:
    """A kernel and both engines of a study give the status of their outputs, analyses and sweeps of all joints."""
    path, outputs = "links.coupler.mass", ("effort.O2", "reaction.O4")
    mass = float(da.compile(m, [path]).nominal[0])
    assert set(da.solve(m).status) == {"redundant"}
    s = da.sweep(m, {path: [mass]}, outputs=list(outputs))
    assert set(s.status.ravel()) == {"redundant"}
    compiled = make_engine(m, [path], outputs, None, False, None)
    general = AnalysisEngine(m, (path,), outputs, None, False, None, "")
    blocks = [engine.block(np.array([[mass]])) for engine in (compiled, general)]
    for block in blocks:
        assert (block["status"] == 0).all()
    for name in outputs:
        assert blocks[1][name] == pytest.approx(blocks[0][name], rel=1e-9)
        assert s[name] == pytest.approx(blocks[0][name], rel=1e-9)
    open_ = AnalysisEngine(m, (path,), ("effort.O2", "reaction.A"), None, False, None, "").block(
        np.array([[mass]])
    )
    assert (open_["status"] == CODES.index("redundant")).all()
    assert np.isnan(open_["reaction.A"]).all()


def test_a_lifted_linkage_is_compiled_as_far_as_it_is_determined() -> None:
    """Each loop in planes is redundant three times; with a constraint freed the kernel has the analyses' reactions."""
    heights, plane = {"coupler": "20 mm"}, da.four_bar(positions=4)
    sentence = (
        "reaction.A and reaction_moment.A cannot be compiled: constraints are redundant, and statics alone does not "
        "determine it; leave it out, free a constraint, or use da.dynamics, which shows the unique reactions"
    )
    with pytest.raises(da.ModelError) as refused:
        da.compile(da.lifted(plane, heights), outputs=["reaction.A", "reaction_moment.A", "effort.O2"])
    assert str(refused.value) == sentence
    other = da.lifted(plane, heights)
    lifted = da.compile(other, ["links.crank.points.A.0"])
    assert lifted.outputs == ("effort.O2",)
    many = lifted([lifted.nominal, 1.1 * lifted.nominal])
    assert many.ok.all()
    assert many.effort("O2")[0] == pytest.approx(da.dynamics(plane).effort("O2"), rel=1e-9)
    longer = da.dynamics(other.with_values({"links.crank.points.A.0": 1.1 * lifted.nominal[0]}))
    assert many.effort("O2")[1] == pytest.approx(longer.effort("O2"), rel=1e-9)
    marked = da.dynamics(da.lifted(plane, heights))
    assert set(marked.status) == {"redundant"}
    assert not marked.unique("A").all()
    freed = da.lifted(plane, heights, {"B": "spherical", "O4": "cylindrical"})
    k = da.compile(freed, outputs=["reaction.A", "reaction_moment.A", "effort.O2"])
    r, wanted = k([k.nominal]), da.dynamics(freed, method="careful")
    assert r.ok.all()
    assert r.reaction("A")[0] == pytest.approx(wanted.reaction("A"), rel=1e-10, abs=1e-9)
    assert r.effort("O2")[0] == pytest.approx(marked.effort("O2"), rel=1e-9)


def test_no_motion_leads_through_lines_that_are_parallel() -> None:
    """A block in a guide and in a slot of a disc, whose line turns by a quarter: a guide between both lines is parallel
    to the slot on the way, and the block would have to pass through infinity; turned by half a turn it is the same."""
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0], "G": [0.1, 0.05]}},
                "disc": {"points": {"O": [0, 0]}},
                "block": {"points": {"F": [0, 0]}, "mass": 1.0},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "disc"]},
                "guide": {
                    "type": "slider",
                    "links": ["ground", "block"],
                    "at": ["G", "F"],
                    "direction": "30 deg",
                },
                "slot": {
                    "type": "slot",
                    "links": ["disc", "block"],
                    "at": ["O", "F"],
                    "direction": "-90 deg",
                },
            },
            "drives": {"O": {"position": ["0 deg", "90 deg"], "speed": "1 rad/s"}},
        }
    )
    path = "joints.guide.direction"
    beyond, reached = [135, 100, -30, 150], [30, 45, -150, 200, 210]
    values = np.radians([*beyond, *reached])
    b = da.compile(m, [path], ["reaction.slot"], lanes=1)(values[:, None])
    assert b.status[: len(beyond)].tolist() == [["ok", "not_assembled"]] * len(beyond)
    assert b.ok[len(beyond) :].all()
    for k, value in enumerate(values):
        r = da.dynamics(m.with_values({path: float(value)}))
        assert list(r.status) == list(b.status[k])
        assert b.value("reaction.slot")[k] == pytest.approx(r.reaction("slot"), nan_ok=True, abs=1e-12)
    assert (
        da.compile(m, [path], ["reaction.slot"], "peak")(values[:, None]).ok.tolist()
        == [False] * 4 + [True] * 5
    )
