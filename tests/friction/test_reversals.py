"""Positions where contacts of a moving machine reverse: the numbers just before and just after them."""

from __future__ import annotations

import csv
import io
import json
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.output.summary.printed_answer import checks_text
from dalembert.cli import main
from dalembert.grading.file_answers import check
from dalembert.reports.working import working
from dalembert.views.charts import effort_chart, polar_chart, reaction_charts, stepped_series
from tests.friction import four_stroke
from tests.friction.engines import engine
from tests.friction.four_stroke import FILE
from tests.friction.rough import rough_tree
from tests.random_space import tree as random_tree
from tests.space.rough import drawing, roughened
from tests.tiers import over_seeds

ASIDE = 1e-3


def by_hand(theta: float) -> list[four_stroke.Found]:
    """Just before and just after a crank angle."""
    return [four_stroke.forces(theta, four_stroke.senses(theta + side)) for side in (-ASIDE, ASIDE)]


def off(r: Any, k: int, found: four_stroke.Found) -> float:
    """Largest difference of a result at a position from the hand equations."""
    largest = max(np.linalg.norm(f) for f in found.force.values())
    apart = [np.max(np.abs(r.reaction(j)[k] - f)) for j, f in found.force.items()]
    return float(max(*apart, abs(r.effort("O")[k] - found.torque) / four_stroke.R) / largest)


def test_the_hand_equations_hold_where_nothing_reverses() -> None:
    r = da.dynamics(four_stroke.engine())
    for k in (3, 11, 30, 50, 140):
        theta = float(r.drive_position("O")[k])
        assert off(r, k, four_stroke.forces(theta, four_stroke.senses(theta))) < 1e-9


def test_both_sides_of_the_dead_centres_by_hand() -> None:
    """The guide reverses where the rod stands upright, B where the crank lies."""
    r = da.dynamics(four_stroke.engine(), strict=True)
    places = np.flatnonzero(r.reverses)
    assert places.tolist() == [0, 18, 36, 54, 72, 90, 108, 126]
    assert r.ok.all()
    for k in places:
        before, after = by_hand(float(r.drive_position("O")[k]))
        assert off(r, k, before) < 1e-9
        assert off(r.before, k, before) < 1e-9
        assert off(r.after, k, after) < 1e-9
        assert off(r.after, k, before) > 1e-6


def test_a_curve_has_the_sides_of_a_reversal_in_the_order_of_the_list() -> None:
    """Through the dead centre at 90 deg, twice the same position, on, and back to it against the motion."""
    r = da.dynamics(four_stroke.engine(tuple(np.radians([90.0, 90.0, 107.0, 119.0, 90.0]))))
    assert r.reverses.tolist() == [True, True, False, False, True]
    (before, after), k = (side.effort("O") for side in r.sides), 0
    assert before[k] != pytest.approx(after[k], rel=1e-3)
    there = [before[0], after[0], before[1], after[1], before[2], before[3]]
    assert stepped_series(r, lambda side: side.effort("O")).tolist() == [*there, after[4], before[4]]


def test_the_largest_values_take_reversals_in(capsys: pytest.CaptureFixture[str]) -> None:
    m = four_stroke.engine()
    r = da.dynamics(m)
    peak = max(np.linalg.norm(found.force["B"]) for found in by_hand(np.pi / 2))
    assert peak == pytest.approx(41859.3, abs=0.05)
    assert r.worst("reaction", "B") == (pytest.approx(peak, rel=1e-9), 0)
    assert main(["solve", str(FILE)]) == 0
    said = capsys.readouterr().out
    (line,) = [line for line in said.splitlines() if line.startswith("|F| B")]
    assert line.split() == ["|F|", "B", "N", "41859.3", "90", "deg", "*", "199.2", "525", "deg"]
    assert "* one side of a reversal" in said
    assert "at rest" not in said


# limits, on random mechanisms

TINY = 1e-6


def test_what_is_counted_adds_up() -> None:
    """A reversal is solved, beside a position that a rod shorter than the crank does not reach."""
    r = da.dynamics(
        engine(position=["20 deg", "0 deg", "10 deg", "90 deg"]).with_values(
            {"links.crank.points.A": [1.3, 0]}
        )
    )
    assert r.status == ("ok", "reversal", "ok", "not_assembled")
    assert "3 of 4 positions solved in full; 1 without an answer" in " ".join(checks_text(r).split())


def moved(tree: Any, times: Any) -> Any:
    """The mechanism at times of its motion at constant accelerations; time 0 first, which sets the phase of wheels."""
    out = {**tree, "drives": {}}
    t = np.array([0.0, *times])
    for name, drive in tree["drives"].items():
        turns = isinstance(drive["speed"], str)
        v, a = (float(str(drive[key]).split()[0]) for key in ("speed", "acceleration"))
        way = v * t + a * t * t / 2
        position = drive["position"][0] + (np.degrees(way) if turns else way)
        rate = [f"{x!r} rad/s" if turns else float(x) for x in (v + a * t).tolist()]
        out["drives"][name] = {**drive, "position": position.tolist(), "speed": rate}
    return da.mechanism(out)


def crossing(tree: Any, span: float = 0.4, count: int = 25) -> float | None:
    """A time at which the rate of some contact passes through zero, to the last digit."""
    times = np.linspace(-span, span, count)
    r = da.statics(moved(tree, times))
    if r.friction is None:
        return None
    rate = r.friction.rate[1:]
    known = np.isfinite(r.force_array).all(axis=(1, 2))[1:]
    contacts = r.compiled.contacts
    group = np.arange(contacts.count) if contacts.group is None else contacts.group
    alone = (group[:, None] == group).sum(axis=1) == 1  # a slip of several parts hardly ever vanishes
    turns = (rate[1:] * rate[:-1] < 0) & (known[1:] & known[:-1])[:, None] & alone & ~contacts.fixed
    if not turns.any():
        return None
    k, e = (int(n) for n in np.argwhere(turns)[0])
    (a, b), (f, g) = times[k : k + 2], rate[k : k + 2, e]
    for _ in range(8):
        if f == g or abs(b - a) < 1e-15:
            break
        a, b, f = b, b - g * (b - a) / (g - f), g
        if not abs(b) < span:
            return None
        g = da.statics(moved(tree, [b])).friction.rate[1, e]
    return float(b)


def plane(seed: int) -> Any:
    return rough_tree(seed, 0.3, (2, 8))


def space(seed: int) -> Any:
    return roughened(random_tree(drawing(seed)), seed, 0.3)


def reversing(trees: Any, seed: int) -> tuple[Any, float]:
    """The first of the random mechanisms of a seed in which some contact reverses, with numbers on a side, and when."""
    for other in range(seed, seed + 100_000, 1000):
        tree = trees(other)
        time = crossing(tree)
        if time is None:
            continue
        r = da.dynamics(moved(tree, [time]))
        if r.reverses[1] and any(np.isfinite(side.force_array[1]).all() for side in r.sides):
            return tree, time
    raise AssertionError("none of a hundred mechanisms reverses")


@over_seeds([6], range(200), block=4)
def test_both_sides_are_the_limits_of_the_positions_around(seed: int) -> None:
    """Extrapolated from two positions near by; these have one number each, however small a rate is there."""
    check_limits(*reversing(plane, seed))


@over_seeds([2], range(100), block=3)
def test_both_sides_are_the_limits_in_space(seed: int) -> None:
    check_limits(*reversing(space, seed))


def check_limits(tree: Any, time: float) -> None:
    beside = [time + side * step for side in (-1, 1) for step in (TINY, 2 * TINY)]
    r = da.dynamics(moved(tree, [time, *beside]))
    assert r.reverses.tolist() == [False, True, False, False, False, False]
    assert r.ok[1] == (r.status[1] == "reversal")
    worse = {"jammed", "self_locking"} & set(r.status[2:])
    assert r.status[1] == "reversal" or r.status[1] in worse
    largest = np.nanmax(np.abs(r.force_array[1:])) * max(1.0, r.compiled.layout.length)
    for side, (near, far) in ((r.before, (2, 3)), (r.after, (4, 5))):
        for values in (side.force_array, side.moment_array, side.effort_array, side.friction.moment):
            limit = 2 * values[near] - values[far]
            assert np.array_equal(np.isnan(values[1]), np.isnan(limit))
            assert np.nan_to_num(np.abs(values[1] - limit)).max(initial=0.0) < 1e-7 * largest
        balanced = np.maximum(side.residual[1], side.power_balance[1]) <= 1e-9  # a jammed side has neither
        assert balanced == np.isfinite(side.force_array[1]).all()


DEAD_CENTRE = """
units: {{length: mm}}
links:
  ground: {{points: {{O: [0, 0], G: [0, 0]}}}}
  crank: {{points: {{O: [0, 0], A: [100, 0]}}}}
  rod: {{points: {{A: [0, 0], B: [300, 0]}}}}
  piston: {{points: {{B: [0, 0]}}}}
joints:
  O: {{type: pin, links: [ground, crank], friction: {{radius: 20}}}}
  A: {{type: pin, links: [crank, rod], friction: {{radius: 20}}}}
  B: {{type: pin, links: [rod, piston], friction: {{radius: 20}}}}
  G: {{type: slider, links: [ground, piston], at: [G, B], friction: {{}}}}
friction: {{coefficient: 0.1}}
drives: {{O: {{position: [0, 1], speed: {way} rad/s}}}}
loads:
  M: {{type: couple, on: crank, value: {couple} N*m}}
  F: {{type: force, on: piston, at: B, value: [{force}, 0]}}
assembly: {{rod: 0}}
"""
"""A couple drives the crank with 530.7 N mm, friction asks for 530.03 on one side of the dead centre, 531.44 on the
other, whichever of these the force on the piston makes the first."""


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize(("force", "side"), [(100, "after"), (-100, "before")])
def test_a_machine_locks_itself_on_one_side_of_a_reversal(way: int, force: int, side: str) -> None:
    r = da.statics(da.loads(DEAD_CENTRE.format(way=way, couple=way * 0.5307, force=force)))
    assert [float(s.effort("O")[0]) * way < 0 for s in r.sides] == [side == "after", side == "before"]
    value = abs(getattr(r, side).effort("O")[0]) * 1e3
    assert r.problems()[0] == (
        "1",
        "self_locking",
        f"Self-locking at O = 0 deg, just {side} contacts reverse: the load cannot drive the machine against its "
        f"friction; O needs {way * value:.6g} N*mm and without friction {-way * 530.7:.6g} N*mm.",
    )


# what is written and drawn


def test_json_has_both_sides_and_their_low_and_high() -> None:
    r = da.dynamics(four_stroke.engine())
    positions = json.loads(json.dumps(r.to_dict(), allow_nan=False))["positions"]
    before, after = by_hand(np.pi / 2)
    (first, second) = positions[:2]
    assert "after" not in second
    assert first["status"] == "reversal"
    assert "guide reverses at O = 90 deg" in first["reason"]
    for key, found in ((first, before), (first["after"], after)):
        assert key["effort"]["O"] == pytest.approx(found.torque, rel=1e-9)
        assert key["reaction"]["guide"] == pytest.approx(found.force["guide"], rel=1e-7)
        assert key["residual"] < 1e-12
        assert key["friction"]["determinant_ratio"] > 0
    ends = sorted([before.torque, after.torque])
    assert [first[key]["effort"]["O"] for key in ("low", "high")] == pytest.approx(ends, rel=1e-9)
    for axis in range(2):
        ends = sorted([before.force["guide"][axis], after.force["guide"][axis]])
        found = [first[key]["reaction"]["guide"][axis] for key in ("low", "high")]
        assert found == pytest.approx(ends, rel=1e-7)
    lost = [first[key]["power_lost"]["B"] for key in ("low", "high")]
    assert lost == sorted(float(side.power_lost("B")[0]) for side in r.sides)


def test_tables_have_low_and_high_of_every_quantity_that_friction_changes() -> None:
    r = da.dynamics(four_stroke.engine())
    text = io.StringIO()
    r.to_csv(text, units="SI")
    heads, *rows = list(csv.reader(io.StringIO(text.getvalue())))
    assert len(rows) == 144
    assert all(rows[0])
    named = [h for h in heads if h.split(" [")[0].split(".")[2:3] in (["low"], ["high"])]
    assert len(named) == 2 * (1 + 4 * 3 + 4 * 4 + 1)  # the last: power
    before, after = by_hand(np.pi / 2)

    def cell(name: str, k: int) -> float:
        return float(rows[k][heads.index(name)])

    values = [cell(f"reaction.B.{word}y [N]", 0) for word in ("", "low.", "high.")]
    y = [found.force["B"][1] for found in (before, after)]
    assert values == pytest.approx([y[0], min(y), max(y)], rel=1e-9)
    assert min(y) < max(y)
    assert "effort.O.low [N*m]" in heads
    for head in heads:
        if ".low" in head:
            places = [heads.index(head.replace(".low", word)) for word in ("", ".low", ".high")]
            one = [len({row[n] for n in places}) == 1 for row in rows]
            assert all(np.array(one)[~r.reverses]), head


def test_arrays_have_low_and_high() -> None:
    pytest.importorskip("xarray")
    r = da.dynamics(four_stroke.engine())
    data = r.to_xarray()
    low, high = data["effort_low"].values[:, 0], data["effort_high"].values[:, 0]
    assert (low < high).tolist() == r.reverses.tolist()
    assert np.array_equal(np.minimum(*(side.effort("O") for side in r.sides)), low)
    assert np.array_equal(np.maximum(*(side.effort("O") for side in r.sides)), high)
    assert data["reaction_high"].dims == data["reaction"].dims
    assert data["reaction_high"].attrs == data["reaction"].attrs


def test_charts_draw_the_jump() -> None:
    """One line without a gap, through both numbers of a reversal in the order in which they are passed."""
    r = da.dynamics(four_stroke.engine())
    torque = stepped_series(r, lambda side: side.effort("O"))
    assert len(torque) == 152
    assert torque[:3].tolist() == [*(side.effort("O")[0] for side in r.sides), r.effort("O")[1]]
    (scene,) = effort_chart(r)
    (curve,) = [
        line for line in scene.items if getattr(line, "role", "") == "curve-1" and len(line.points) > 2
    ]
    assert len(curve.points) == 152
    assert curve.points[0][0] == curve.points[1][0]
    assert curve.points[0][1] > curve.points[1][1]
    sizes = [np.hypot(*side.reaction("B")[0]) for side in r.sides]
    assert reaction_charts(r)[0].numbers["B"][:2] == pytest.approx(sizes, rel=1e-12)
    (scene,) = effort_chart(
        da.dynamics(four_stroke.engine().with_values({"drives.O.speed": -four_stroke.SPEED}))
    )
    (curve,) = [
        line for line in scene.items if getattr(line, "role", "") == "curve-1" and len(line.points) > 2
    ]
    assert len(curve.points) == 152


def test_drawings_and_the_worked_solution_show_both_sides() -> None:
    r = da.dynamics(four_stroke.engine((np.radians(90), np.radians(95))))
    said = [text.text for text in da.draw.mechanism(r, at=1).texts()]
    words = [text for text in said if text.startswith("Just ")]
    assert [w.split(" the reversal of ")[0] for w in words] == ["Just before", "Just after"]
    assert "guide" in words[0]
    assert len(da.draw.free_body(r, "piston", at=1).arrows()) > len(
        da.draw.free_body(r, "piston", at=2).arrows()
    )
    sheet = working(r, at=1)
    assert "Just after the reversal" in str(sheet)


def test_the_methods_take_both_sides() -> None:
    r = da.dynamics(four_stroke.engine())
    work = da.virtual_work(r)
    assert np.max(work.gap) < 1e-10
    assert work.answer.after is not None
    assert np.max(np.abs(work.answer.after.effort("O") - r.after.effort("O"))) < 1e-9 * np.max(
        np.abs(r.effort("O"))
    )
    sides = [da.efficiency(side).lost for side in r.sides]
    assert da.efficiency(r).lost == pytest.approx(np.mean(sides), rel=1e-12)
    assert sides[0] != sides[1]
    assert r.interval("O")[0].tolist() == sorted(side.effort("O")[0] for side in r.sides)


def test_an_answer_may_be_of_either_side() -> None:
    """In a file and of a student; of an extreme the side that has it."""
    m = four_stroke.engine()
    r = da.dynamics(m)
    sides = [float(side.effort("O")[0]) for side in r.sides]
    right = [da.Answer(quantity="effort", of="O", at=1, value=f"{v!r} N*m") for v in sides]
    right += [da.Answer(quantity="effort_low", of="O", at=1, value=f"{min(sides)!r} N*m")]
    peak = [float(np.linalg.norm(side.reaction("B")[0])) for side in r.sides]
    right += [
        da.Answer(quantity="reaction", of="B", component="magnitude", extreme="max", value=f"{max(peak)!r} N")
    ]
    wrong = da.Answer(quantity="effort", of="O", at=1, value=f"{sum(sides) / 2!r} N*m", tolerance="0.001 %")
    rows = check(m.model_copy(update={"answers": (*right, wrong)}))
    assert [row.ok for row in rows] == [True, True, True, True, False]
    assert "guide reverses" in rows[-1].problem
    assert [v.right for v in da.check_answers(m, right)] == [True] * 4


def test_the_largest_of_a_fine_list_goes_to_that_of_the_reversal() -> None:
    """Just before the dead centre, where the largest value of all stands."""
    m = four_stroke.engine()
    peak, place = da.dynamics(m).worst("reaction", "B")
    assert place == 0
    off = []
    for step in (1.0, 0.1, 0.01):
        beside = [float(np.radians(90 + side * k * step)) for side in (-1, 1) for k in (1, 2)]
        off.append(peak - da.dynamics(four_stroke.engine(tuple(beside))).worst("reaction", "B")[0])
    assert off[0] > 5 * off[1] > 25 * off[2] > 0


def test_a_polar_chart_has_the_forces_on_its_own_link() -> None:
    """In ground axes on j; in the axes of the link that moves where j is the ground."""
    r = da.dynamics(four_stroke.engine())
    (curve,) = [line for line in polar_chart(r, ["B"]).items if getattr(line, "role", "") == "curve-1"]
    force = stepped_series(r, lambda side: side.reaction("B", on="piston"))
    drawn = np.array(curve.points[:-1])
    scale = np.linalg.norm(force[0]) / np.linalg.norm(drawn[0])
    assert np.max(np.abs(drawn * scale - force)) < 1e-9 * np.max(np.abs(force))


def with_bar(couple: float, position: Any = 0) -> Any:
    """The classic engine, beside it a bar that stays at rest on a pin with friction."""
    tree = engine(position=position).to_tree()
    tree["links"]["ground"]["points"] |= {"P": [0.5, 0.5], "Q": [0.8, 0.5]}
    tree["links"]["bar"] = {"points": {"P": [0, 0], "Q": [0.3, 0]}}
    tree["loads"]["on bar"] = {"type": "couple", "on": "bar", "value": couple}
    tree["joints"] |= {
        "P": {"type": "pin", "links": ["ground", "bar"], "friction": {"coefficient": 0.1, "radius": 0.01}},
        "Q": {"type": "slot", "links": ["ground", "bar"], "direction": 0.0},
    }
    return da.statics(da.mechanism(tree))


def test_a_contact_that_stays_at_rest_counts_where_it_carries_something() -> None:
    plain, idle, loaded = da.statics(engine(position=0)), with_bar(0.0), with_bar(3.0)
    assert (idle.status, loaded.status) == (("reversal",), ("at_rest",))
    for side, same in zip(idle.sides, plain.sides, strict=True):
        assert side.effort("O")[0] == pytest.approx(same.effort("O")[0], rel=1e-12)
    assert "No relative motion in" in loaded.reasons[0]


@pytest.mark.parametrize("load", [100.0, -100.0])
def test_a_contact_at_rest_that_carries_rounding_carries_nothing(load: float) -> None:
    """Beside a block that slides, pressed down or up: 0.1 + 0.2 - 0.3 N on the pin of a bar that is held."""
    parts = {
        f"F{k}": {"type": "force", "on": "bar", "at": "Q", "value": [f, 0]}
        for k, f in enumerate((0.1, 0.2, -0.3))
    }
    tree = {
        "links": {
            "ground": {"points": {"O": [0, 0], "P": [0.5, 0.5], "Q": [0.8, 0.5]}},
            "block": {"points": {"B": [0, 0]}},
            "bar": {"points": {"P": [0, 0], "Q": [0.3, 0]}},
        },
        "joints": {
            "floor": {
                "type": "slider",
                "links": ["ground", "block"],
                "at": ["O", "B"],
                "friction": {"coefficient": 0.2},
            },
            "P": {
                "type": "pin",
                "links": ["ground", "bar"],
                "friction": {"coefficient": 0.1, "radius": 0.01},
            },
            "Q": {"type": "slot", "links": ["ground", "bar"], "direction": 0.0},
        },
        "drives": {"floor": {"position": 0.1, "speed": 1}},
        "loads": {"load": {"type": "force", "on": "block", "at": "B", "value": [0, load]}} | parts,
    }
    r = da.statics(da.mechanism(tree))
    assert r.status == ("ok",)
    assert r.effort("floor") == pytest.approx([20.0])


def test_both_sides_are_one_where_nothing_reverses() -> None:
    """A contact that stays at rest and carries nothing leaves them their numbers."""
    r = with_bar(0.0, [50, 0, 60])
    assert r.status == ("ok", "reversal", "ok")
    assert np.isfinite(r.effort("O")).all()
    assert np.array_equal(r.after.effort("O")[::2], r.effort("O")[::2])
    assert np.array_equal(r.after.force_array[::2], r.force_array[::2])


def test_a_drive_that_turns_back_reverses_everything_and_one_that_stands_does_not() -> None:
    """Between two positions where it moves; at the end of a list, or without acceleration, the machine is at rest."""
    tree = engine(position=0).to_tree()
    drive = {"position": [48, 50, 48], "speed": ["1 rad/s", "0 rad/s", "-1 rad/s"]}
    for acceleration, status in (("-10 rad/s^2", "reversal"), ("0 rad/s^2", "at_rest")):
        tree["drives"]["O"] = {**drive, "acceleration": acceleration}
        r = da.statics(da.mechanism(tree))
        assert r.status[1] == status
    tree["drives"]["O"] = {
        "position": [48, 50],
        "speed": ["1 rad/s", "0 rad/s"],
        "acceleration": "-10 rad/s^2",
    }
    assert da.statics(da.mechanism(tree)).status == ("ok", "at_rest")
    turning = [float(da.statics(engine(speed=v)).effort("O")[0]) for v in (1.0, -1.0)]
    tree["drives"]["O"] = {**drive, "acceleration": "-10 rad/s^2"}
    assert [float(s.effort("O")[1]) for s in da.statics(da.mechanism(tree)).sides] == pytest.approx(
        turning, rel=1e-9
    )
