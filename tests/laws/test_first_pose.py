"""First poses: groups of links placed one after another, in every assembly mode."""

from __future__ import annotations

import math
from functools import cache
from typing import Any, cast

import numpy as np
import pytest
from benchmarks.linkages import chain, pin

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.positions import first_position
from dalembert.arrays import Array
from dalembert.bundled import cases, examples
from dalembert.core.layout import Meet
from dalembert.core.position import first_pose_plane
from dalembert.core.position.assur_plan import plan
from dalembert.core.position.first_pose_space import PoseGuess
from dalembert.core.position.newton import gap
from tests.random_mechanisms import Drawing, pose_array, random_case, tree
from tests.random_mechanisms.groups import driven, dyad, single, welded
from tests.tiers import nth, over


@pytest.mark.parametrize("groups", [24, 49])
def test_a_long_chain_closes_at_its_first_position(groups: int) -> None:
    """Every rocker on the side of its rod that the file's angles state; Newton from a few starts finds none."""
    m = chain(groups, positions=1)
    r = da.kinematics(m)
    assert r.ok.all()
    turn = np.array([r.angle(f"rocker{k}")[0] - r.angle(f"rod{k}")[0] for k in range(groups)])
    ends = [r.point(f"{link}{k}", f"B{k}")[0] for k in range(groups) for link in ("rod", "rocker")]
    np.testing.assert_allclose(ends[::2], ends[1::2], atol=1e-9)
    assert (np.sin(turn) > 0).all()


def test_a_slide_belongs_to_a_group_in_closed_form() -> None:
    m = da.load(examples()["quick_return"])
    way = plan(compile_mechanism(m, m.schedule()).layout)
    assert way is not None
    assert way.closed


@pytest.mark.parametrize(
    ("name", "groups", "modes"),
    [
        ("four_bar", "4p 2p 2a", 1),
        ("inverted_slider_crank", "4p 2p 1a/", 1),
        ("watt_1", "4p 2p 2a 4p 2a", 1),
        ("stephenson_2", "4p 4p 2p4a*", 1),
        ("scotch_yoke", "3p 1p", 1),
        ("press_with_flywheel", "2p 2p 2p1a", 2),
        ("five_bar", "4p 2p 2p2a", 1),
        ("v_engine", "2p 4p 2p1a 2p1a", 2**2),
        ("radial_engine", "3p 10p 1a 1p 2p1a 2p1a 2p1a 2p1a", 2**5),
        ("excavator", "4p 2p2a//* 4p 2p2a//* 6p 2p2a//* 2p 2a", None),
        ("scissor_lift", "4p 2a 4p 2a 4p 2a 2p 1a/", 2**4),
    ],
)
def test_links_are_placed_group_by_group(name: str, groups: str, modes: int | None) -> None:
    """Places and angles that are found together, / for each slide that turns with them, * where there is no closed
    form; and in how many ways the groups close where the file leaves it open, two for each dyad."""
    m = getattr(da, name)() if hasattr(da, name) else da.load(examples()[name])
    c = compile_mechanism(m, m.schedule(1))
    way = plan(c.layout)
    assert way is not None
    found = [
        f"{len(g.link) or ''}{'p' * bool(len(g.link))}{len(g.turning) or ''}{'a' * bool(g.turning)}"
        f"{'/' * g.sliding}{'*' * (not g.closed)}"
        for g in way.groups
    ]
    assert " ".join(found) == groups
    ways = c.guess.modes(c.layout, c.targets[0])
    assert ways is not None
    assert modes is None or len(ways.pose.turn) == modes


def test_an_assembly_with_the_crank_says_at_which_position_it_stands() -> None:
    """A shaper whose crank closes in two ranges, on another branch in each: as given at 125 deg, or as found first."""
    m = da.load(examples()["quick_return"]).with_values(
        {"links.ground.points.O2": (-0.205, -0.163), "links.crank.points.O2": (0.199, 0.171)}
    )
    stated = {"block": 1.73, "lever": 1.73, "rod": 3.2, "ram": 0.0}
    r = da.kinematics(m.with_values({"assembly": stated | {"crank": math.radians(125)}}))
    assert np.flatnonzero(r.ok).tolist() == list(range(23, 51))
    assert r.angle("lever")[25] == pytest.approx(1.73, abs=0.02)
    assert math.remainder(r.angle("rod")[25] - 3.2, math.tau) == pytest.approx(0, abs=0.02)
    for open_ in (stated, stated | {"crank": math.radians(125.1)}):
        first = da.kinematics(m.with_values({"assembly": open_}))
        assert np.flatnonzero(first.ok).tolist() == list(range(2, 22))


def is_listed(seed: int) -> bool:
    """True if a random mechanism has several positions, and no wheels, whose phase is that of the first."""
    d = random_case(seed).drawing
    return not any(j.type in ("gear", "rolling") for j in d.joints.values()) and len(listed(seed).status) > 1


@cache
def listed(seed: int) -> da.Result:
    return da.dynamics(da.mechanism(random_case(seed).tree))


@over(4, 400)
def test_the_pose_of_any_position_as_assembly_gives_the_same_answers(seed: int) -> None:
    seed = nth(seed, is_listed)
    made, r = random_case(seed).tree, listed(seed)
    k = 1 + seed % (len(r.status) - 1)
    places = {
        link: [*(f"{float(x)!r} m" for x in r.position(link)[k]), f"{float(r.angle(link)[k])!r} rad"]
        for link in r.links
    }
    s = da.dynamics(da.mechanism({**made, "assembly": places}))
    assert s.status == r.status
    size = max(np.nanmax(np.abs(r.force_array), initial=1e-9), np.nanmax(np.abs(r.effort_array), initial=0.0))
    assert np.nanmax(np.abs(s.point_array - r.point_array)) < 1e-8
    if not any(
        load["type"].startswith("torsion") for load in made["loads"].values()
    ):  # they count turns from it
        assert np.nanmax(np.abs(s.force_array - r.force_array)) < 1e-7 * size
        assert np.nanmax(np.abs(s.effort_array - r.effort_array), initial=0.0) < 1e-7 * size


WHEEL = """
units: {length: mm}
links:
  ground: {points: {P: [500, 50]}}
  wheel: {points: {C: [0, 0], R: [100, 0]}, mass: 1}
  body: {points: {C: [0, 0], S: [900, 0]}, mass: 3}
  rear: {points: {C: [0, 0]}}
joints:
  W: {type: rolling, links: [ground, wheel], at: [P, C], radius: 200, direction: 30}
  V: {type: rolling, links: [ground, rear], at: [P, C], radius: 200, direction: 30}
  C: {type: pin, links: [wheel, body]}
  S: {type: pin, links: [body, rear], at: [S, C]}
drives: {W: {position: POSITION}}
"""


@pytest.mark.parametrize(
    ("position", "assembly", "along"),
    [
        (0, "", 0.0),
        (140, "", 0.0),
        (140, "assembly: {wheel: 0}", 0.0),
        ("[50, 140]", "", 0.0),
        (140, "assembly: {wheel: [573.205, 323.205, 140]}", 0.2),
    ],
)
def test_a_wheel_that_nothing_else_holds_stands_over_its_point(
    position: object, assembly: str, along: float
) -> None:
    """A cart on a slope: its first wheel 200 mm from the point of the line, across it, or where it is put."""
    r = da.statics(da.loads(WHEEL.replace("POSITION", str(position)) + assembly))
    e = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)])
    wanted = [0.5, 0.05] + along * e + 0.2 * np.array([-e[1], e[0]])
    assert r.center("wheel")[0] == pytest.approx(wanted, abs=1e-6 if along else 1e-12)
    assert r.center("rear")[0] == pytest.approx(r.center("wheel")[0] + 0.9 * e, abs=1e-12)


def test_wheels_turn_where_their_links_do_not_close_at_angle_0() -> None:
    """A pinion drives a rocker that can reach no angle near 0: its coupler would have to be 0.3 m long."""
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0], "R": [0.3, 0], "P": [0.36, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [0.1, 0]}},
                "coupler": {"points": {"A": [0, 0], "B": [0.25, 0]}},
                "rocker": {"points": {"R": [0, 0], "B": [0.1, 0]}},
                "pinion": {"points": {"P": [0, 0]}},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "crank"]},
                "A": {"type": "pin", "links": ["crank", "coupler"]},
                "B": {"type": "pin", "links": ["coupler", "rocker"]},
                "R": {"type": "pin", "links": ["ground", "rocker"]},
                "P": {"type": "pin", "links": ["ground", "pinion"]},
                "teeth": {
                    "type": "gear",
                    "links": ["rocker", "pinion"],
                    "at": ["R", "P"],
                    "radii": [0.04, 0.02],
                },
            },
            "drives": {"P": {"position": 0}},
        }
    )
    r = da.kinematics(m)
    assert r.ok.all()
    assert np.linalg.norm(r.point("coupler", "B") - r.point("rocker", "B")) < 1e-9


@pytest.mark.parametrize(("stated", "angle"), [({}, 0.0), ({"wheel": 33}, 33.0)])
def test_in_every_way_of_closing_a_wheel_stands_as_stated(stated: dict[str, float], angle: float) -> None:
    """A planet on a rocker: the teeth have no phase of their own at the first position, so each way is found once."""
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0], "R": [0.3, 0]}},
                "crank": {"points": {"O": [0, 0], "A": [0.1, 0]}},
                "coupler": {"points": {"A": [0, 0], "B": [0.25, 0]}},
                "rocker": {"points": {"R": [0, 0], "B": [0.2, 0]}},
                "wheel": {"points": {"B": [0, 0]}, "mass": 1, "center": [0.1, 0.05]},
                "sun": {"points": {"R": [0, 0]}},
            },
            "joints": {
                "O": pin("ground", "crank"),
                "A": pin("crank", "coupler"),
                "B": pin("coupler", "rocker"),
                "R": pin("ground", "rocker"),
                "axle": pin("rocker", "wheel", ["B", "B"]),
                "fixed": {"type": "weld", "links": ["ground", "sun"], "at": ["R", "R"]},
                "teeth": {"type": "gear", "links": ["sun", "wheel"], "at": ["R", "B"], "radii": [0.12, 0.08]},
            },
            "drives": {"O": {"position": 40}},
            "assembly": stated,
        }
    )
    c = compile_mechanism(m, m.schedule())
    found = c.guess.modes(c.layout, c.targets[0])
    assert found is not None
    turn = dict(zip(c.links, found.pose.turn.T, strict=False))
    span = 0.3 - 0.1 * np.exp(1j * np.radians(40))
    at_r = np.arccos((0.2**2 + abs(span) ** 2 - 0.25**2) / (2 * 0.2 * abs(span)))
    ways = np.angle(-span) + np.array([1, -1]) * at_r
    assert np.sort(turn["rocker"]) == pytest.approx(np.sort(np.angle(np.exp(1j * ways))))
    assert turn["wheel"] == pytest.approx([np.radians(angle)] * 2)


def trammel(size: float, **stated: float) -> Compiled:
    """A rod between blocks on two slides across each other; its angle is that of cos -0.6."""
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "a": {"points": {"A": [0, 0]}},
                "b": {"points": {"B": [0, 0]}},
                "rod": {"points": {"A": [0, 0], "B": [0.5 * size, 0]}},
            },
            "joints": {
                "x": {"type": "slider", "links": ["ground", "a"], "at": ["O", "A"]},
                "y": {"type": "slider", "links": ["ground", "b"], "at": ["O", "B"], "direction": 90},
                "A": pin("a", "rod"),
                "B": pin("b", "rod"),
            },
            "drives": {"x": {"position": 0.3 * size}},
            "assembly": stated,
        }
    )
    return compile_mechanism(m, m.schedule())


def test_where_the_angles_are_right_the_first_start_closes() -> None:
    """Whatever is assumed of the slides: at given angles they are the solution of linear equations."""
    c = trammel(1.0, rod=np.degrees(np.arccos(-0.6)))
    start = c.guess.start(c.layout, c.targets[0])
    assert gap(c.layout, start.at(None), c.targets[:1]) == pytest.approx(0, abs=1e-14)
    assert start.point[c.links.index("b")] == pytest.approx([0, 0.4])


def test_links_are_laid_down_with_their_pins_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the fit of what is left over: a pin that two placed links have already may stay open."""
    monkeypatch.setattr(first_pose_plane, "FEW", 0)
    for links in (["a", "rod"], ["rod", "a"]):
        tree = trammel(1.0, rod=40.0).mechanism.to_tree()
        tree["links"]["rod"] = {
            "points": {"A": [0.1, 0.2], "B": [0.6, -0.1]},
            "mass": 1,
            "center": [0.3, 0.3],
        }
        tree["joints"]["A"]["links"], tree["joints"]["B"]["links"] = (
            links,
            ["b" if k == "a" else k for k in links],
        )
        m = da.mechanism(tree)
        c = compile_mechanism(m, m.schedule())
        missing = gap(c.layout, c.guess.start(c.layout, c.targets[0]).at(None), c.targets[:1])[0]
        pins = [f.row.ravel() for f in c.layout.stack.families if isinstance(f, Meet)]
        assert missing[np.concatenate(pins)] == pytest.approx(0, abs=1e-14)
        assert np.abs(missing).max() > 0.01


def test_starts_grow_with_the_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    starts: list[Array] = []
    own = first_pose_plane._closing
    monkeypatch.setattr(first_pose_plane, "plan", lambda layout: None)
    monkeypatch.setattr(first_pose_plane, "FEW", 0)
    monkeypatch.setattr(
        first_pose_plane, "_closing", lambda *given: [starts.append(given[1].point), own(*given)][1]
    )
    for size in (1.0, 1000.0):
        c = trammel(size)
        found = c.guess.modes(c.layout, c.targets[0])
        assert found is not None
        assert np.cos(found.pose.turn[:, c.links.index("rod")]) == pytest.approx([-0.6, -0.6])
    assert starts[1] == pytest.approx(1000 * starts[0])
    assert np.ptp(starts[0], axis=0).max() > 0.5


def described(seed: int) -> tuple[Drawing, Compiled]:
    """A drawing of groups that have closed forms, and its description without an assembly."""
    rng = np.random.default_rng(seed)
    steps = [dyad, dyad, dyad, single, driven, welded]
    while True:
        d = Drawing(seed=seed)
        driven(d, rng)
        while len(d.poses) < 6:
            steps[int(rng.integers(len(steps)))](d, rng)
        made = tree(d)
        del made["assembly"]
        m = da.mechanism(made)
        c = compile_mechanism(m, m.schedule())
        way = plan(c.layout)
        if way is not None and way.closed:
            return d, c


@over(15, 400)
def test_the_drawn_pose_is_one_of_the_ways_found(seed: int) -> None:
    """Whatever joints a group has: the lengths were read off that pose."""
    drawing, c = described(seed)
    found = c.guess.modes(c.layout, c.targets[0])
    assert found is not None
    drawn = pose_array(drawing)[0, 1:]
    arm = c.layout.algebra.rotate(found.pose.rotation, c.layout.reference)
    origin = found.pose.point - arm
    origin = origin[:, :-1] - origin[:, -1:]
    off = np.abs(origin - drawn[:, :2]).max(axis=(1, 2))
    turned = np.abs(np.exp(1j * found.pose.turn[:, :-1]) - np.exp(1j * drawn[:, 2])).max(axis=1)
    assert np.maximum(off, turned).min() < 1e-9


def test_starts_are_spread_evenly() -> None:
    """Angles over the whole turn, slides from -2 to 3 lengths."""
    angles, slides = first_pose_plane._spread(64, 4, 6)
    unit = np.concatenate([(angles + np.pi) / (2 * np.pi), (slides + 2) / 5], axis=1)
    assert (angles.shape, slides.shape) == ((64, 4), (64, 6))
    assert unit[0] == pytest.approx(0.5)
    assert unit.min() >= 0
    assert unit.max() <= 1
    gaps = np.diff(np.sort(np.concatenate([unit, [[0.0] * 10, [1.0] * 10]]), axis=0), axis=0)
    assert gaps.max() < 0.2


@pytest.mark.parametrize("position", [np.nan, np.inf])
def test_angles_do_not_follow_from_a_position_that_is_no_number(position: float) -> None:
    """They are left open; the search for them ends."""
    m = da.four_bar()
    c = compile_mechanism(m, m.schedule(1))
    target = c.first_target.copy()
    target[-1] = position
    assert isinstance(c.guess, first_pose_plane.Guess)
    turn = c.guess.angles(c.layout, target)
    crank = c.links.index("crank")
    assert np.isnan(turn[crank])
    assert np.isfinite(np.delete(turn, crank)).all()
    with np.errstate(all="ignore"):
        assert c.guess.modes(c.layout, target) is None


def test_links_whose_joints_coincide_have_a_status() -> None:
    m = da.load(cases()["seed-002-4a-four-link-couple-on-rocker"])
    assert da.solve(m.with_values({"links.coupler.points.C.0": 0.0})).status == ("not_assembled",)


PISTON = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}}
  rod: {points: {A: [0, 0], B: [0.25, 0]}}
  piston: {points: {B: [0, 0]}}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [O, B]}
drives: {S: {position: {from: 0.18 m, to: 0.34 m, count: 9}}}
assembly: {STATED}
"""


def compiled(stated: str) -> Compiled:
    m = da.loads(PISTON.replace("STATED", stated))
    return compile_mechanism(m, m.schedule())


@pytest.mark.parametrize("which", [0, 3, 8])
@pytest.mark.parametrize("side", [1, -1])
def test_a_slide_is_sought_first_where_the_assembly_puts_it(which: int, side: int) -> None:
    """Angles of crank and rod by the law of cosines: exact, those of one position; a thousandth off, of none."""
    x = 0.18 + 0.02 * which
    q = side * math.acos((x * x + 0.01 - 0.0625) / (2 * x * 0.1))
    crank, rod = map(math.degrees, (q, math.atan2(-0.1 * math.sin(q), x - 0.1 * math.cos(q))))
    for stated in (
        f"crank: {crank!r}, rod: {rod!r}",
        f"crank: {crank!r}, rod: {rod!r}, piston: [{x!r}, 0, 0]",
    ):
        found = first_position(compiled(stated))
        assert found is not None
        assert (found[0], found[1].chosen_by) == (which, "given")
    for stated in (f"crank: {crank!r}, rod: {rod + 1e-3!r}", f"rod: {rod!r}", "piston: 0"):
        c = compiled(stated)
        assert np.isnan(first_pose_plane.stated_measures(c.layout, c.target, cast(Any, c.guess))).all()


def test_a_slide_that_is_driven_beside_a_turn_is_placed_without_an_assembly() -> None:
    """What the links leave open is sought without the drives, here beside a bar that is held at both ends."""
    at = {"A": [0, 0], "B": [2, 0]}
    pins = {n: {"type": "pin", "links": ["ground", k]} for n, k in (("A", "bar"), ("B", "bar"), ("C", "arm"))}
    guide = {"type": "slider", "links": ["ground", "block"], "at": "A", "direction": 0}
    m = da.mechanism({
        "links": {
            "ground": {"points": {**at, "C": [0, 1]}}, "bar": {"points": at},
            "arm": {"points": {"C": [0, 0], "Q": [1, 0]}}, "block": {"points": {"A": [0, 0]}},
        },
        "joints": {**pins, "D": guide}, "drives": {"C": {"position": "0.3 rad"}, "D": {"position": 0.1}},
    })  # fmt: skip
    r = da.kinematics(m)
    assert (r.angle("arm")[0], r.angle("bar")[0]) == pytest.approx((0.3, 0.0), abs=1e-12)
    assert r.point("block", "A")[0] == pytest.approx([0.1, 0.0], abs=1e-12)


def test_angles_that_do_not_decide_the_assembly_mode_say_so() -> None:
    """The crank's angle is its drive's, and the piston turns in no mode: both leave the rod open."""
    for stated in ("piston: 0", "piston: 0, crank: 60"):
        text = PISTON.replace("S: {position: {from: 0.18 m, to: 0.34 m, count: 9}}", "O: {position: 60}")
        mode = da.kinematics(da.loads(text.replace("STATED", stated))).mode
        assert mode is not None
        assert "the angles in the file's assembly do not decide); other modes" in mode
        assert da.kinematics(da.loads(text.replace("STATED", f"{stated}, rod: -20"))).mode is None


def test_every_mode_in_space_closes() -> None:
    """Those that random starts reach of a crank, a rod in two balls and a rocker, without what the file states."""
    tree = da.rssr().to_tree()
    tree.pop("assembly", None)
    m = da.mechanism(tree)
    c = compile_mechanism(m, m.schedule(4))
    assert isinstance(c.guess, PoseGuess)
    modes = c.guess.every(c.layout, c.targets[1])
    assert modes is not None
    assert np.abs(gap(c.layout, modes.pose, c.targets[1])).max() < 1e-9
    assert c.guess.closes(c.layout, c.targets[1])
