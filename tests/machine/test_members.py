"""Forces inside links: a link cut in two and welded, rates along the member, ends, scaling, closed forms."""

from __future__ import annotations

import json
import math
from contextlib import suppress
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import full_actions, on_link
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.machine.members.link_balance import LinkBalance
from dalembert.machine.members.link_balance import acting as acting_on
from dalembert.machine.members.mass_along import mass_layout
from dalembert.machine.members.member_table import member_table
from dalembert.printing import number, remainder
from dalembert.views.machine.member_views import member_scenes
from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Line
from tests.random_mechanisms import random_case
from tests.random_space import random_case as random_in_space
from tests.random_space import tree as tree_in_space
from tests.tiers import nth, over

ARM = """
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.6, 0]}, mass: 2, center: [0.3, 0], inertia: 0.06, mass_along: uniform,
        section: {rectangle: [20 mm, 40 mm], yield_stress: 250 MPa}}
joints:
  O: {type: pin, links: [ground, arm]}
drives:
  O: {position: 0, speed: 100 rad/s, acceleration: 500 rad/s^2}
"""
"""STR-3."""


def uniform(tree: Any, link: str, f: Any, d: int) -> None:
    """Make a link a slender bar along its member, in the description."""
    (curve,) = f.curves
    e, acting = curve.member, tree["links"][link]
    middle, mass = e.start + e.along * e.length / 2, 3.0
    for key in ("weight", "shape"):
        acting.pop(key, None)
    acting |= {"mass": mass, "center": [float(x) for x in middle[:d]], "mass_along": "uniform"}
    acting["inertia"] = bar_inertia(e.along, e.length, mass, d)


def bar_inertia(t: Any, length: float, mass: float, d: int) -> Any:
    own = mass * length**2 / 12 * (np.eye(3) - np.outer(t, t))
    return float(own[2, 2]) if d == 2 else [[float(x) for x in row] for row in (own + own.T) / 2]


def cut_and_weld(m: Any, link: str, slender: bool) -> bool:
    """Whether a link could be cut in two: then the weld's reaction on the near part is N, V, M there."""
    d, tree = m.dimension, m.to_tree()
    f = da.member_forces(da.dynamics(m), link)
    if len(f.curves) != 1:
        return False
    if slender:
        uniform(tree, link, f, d)
    m = da.mechanism(tree)
    r = da.dynamics(m)
    f, acting = da.member_forces(r, link), LinkBalance(r, link, acting_on(r))
    e = f.curves[0].member
    feet = {
        a.of: e.foot(acting.place(a))[0]
        for a in on_link(full_actions(r), link)
        if a.kind in ("joint", "load", "spring", "damper")
    }
    some = np.sort(np.concatenate([*feet.values(), [0.0, e.length, float(e.foot(acting.center)[0])]]))
    gap = int(np.argmax(np.diff(some)))
    s = float(0.4 * some[gap] + 0.6 * some[gap + 1])
    far = {name for name, places in feet.items() if (places > s).all()}
    if some[gap + 1] - some[gap] < 0.02 * e.length or any((feet[n] > s).any() for n in feet.keys() - far):
        return False
    split(tree, link, e, s, far, bool(e.foot(acting.center)[0] > s), slender, d)
    welded = da.dynamics(da.mechanism(tree))
    weld = "Weld cut"
    force, couple = welded.reaction(weld, link), welded.reaction_moment(weld, link)
    turn = acting.rotation
    there = [np.einsum("kj,pij,pi->pk", e.axes, turn, wide(v)) for v in (force, couple)]
    expected = np.concatenate([there[0] * [1, -1, 1], there[1]], axis=1)
    found = f.curves[0].at(s)[:, 0]
    length = r.compiled.layout.length
    size = max(float(np.nanmax(np.abs(a.force), initial=1e-9)) for a in full_actions(r))
    size = max(size, *(float(np.nanmax(np.abs(a.couple), initial=0.0)) / length for a in full_actions(r)))
    gaps = np.abs(found - expected) / [1, 1, 1, length, length, length]
    assert np.nanmax(gaps, initial=0.0) < 1e-8 * size, (link, s, found, expected)
    assert (np.isnan(found) <= np.isnan(expected)).all()
    assert np.nanmax(f.residual, initial=0.0) < 1e-9
    return True


def wide(v: Any) -> Any:
    """Forces (P, 2) and couples (P,) of the plane with three components."""
    if v.ndim == 1:
        return np.stack([0 * v, 0 * v, v], axis=-1)
    return v if v.shape[1] == 3 else np.concatenate([v, 0 * v[:, :1]], axis=1)


def split(tree: Any, link: str, e: Any, s: float, far: set[str], heavy: bool, slender: bool, d: int) -> None:
    """The description with the part beyond s as a link of its own, welded on."""
    near = tree["links"][link]
    other = json.loads(json.dumps(near))
    tree["links"]["Far part"] = other
    place = e.start + s * e.along
    for acting, low, high in ((near, 0.0, s), (other, s, e.length)):
        acting["points"]["Weld cut"] = [float(x) for x in place[:d]]
        if slender:
            mass = 3.0 * (high - low) / e.length
            acting |= {"mass": mass, "center": [float(x) for x in (e.start + (low + high) / 2 * e.along)[:d]]}
            acting["inertia"] = bar_inertia(e.along, high - low, mass, d)
    if not slender:
        light = near if heavy else other
        for key in ("mass", "weight", "inertia", "shape"):
            light.pop(key, None)
    tree["joints"]["Weld cut"] = {"type": "weld", "links": [link, "Far part"]}
    for name, joint in tree["joints"].items():
        if name in far:
            joint["links"] = ["Far part" if n == link else n for n in joint["links"]]
    for name, load in tree.get("loads", {}).items():
        if name in far and load.get("on") == link:
            load["on"] = "Far part"
        if name in far and "between" in load:
            load["between"] = [b.replace(f"{link}.", "Far part.") for b in load["between"]]
    if link in tree.get("assembly", {}):
        tree["assembly"]["Far part"] = tree["assembly"][link]


def check_cuts(m: Any, first: int, most: int = 1) -> int:
    """Cut some links, the first by its number; how many could be."""
    done, links = 0, [n for n in m.links if n != "ground"]
    for k in range(len(links)):
        link = links[(first + k) % len(links)]
        if any(j.wheels for j in m.joints.values() if link in j.links):
            continue
        with suppress(da.ModelError):  # no line through its joints
            done += cut_and_weld(m, link, slender=bool((first + done) % 2))
        if done == most:
            break
    return done


def check_rates(f: Any) -> None:
    """Derivatives are the load, M' = V; a joint's force is what the member begins or ends with."""
    for curve in f.curves:
        low, high, c = curve.edges[:, :-1], curve.edges[:, 1:], curve.cubics
        acting = LinkBalance(f.result, f.link, acting_on(f.result))
        member = f.curves.index(curve)
        mass = mass_layout(f.result.mechanism, f.link, [c.member for c in f.curves]).pieces
        density = sum(p.density for p in mass if p.member == member)
        c0, c1 = (density * v @ curve.member.axes.T for v in acting.distributed(curve.member))
        for t in (0.2, 0.7):
            s = low + t * (high - low)
            powers = s[..., None, None] ** np.arange(4)
            value = (c * powers).sum(axis=-1)
            slope = (c[..., 1:] * np.arange(1, 4) * powers[..., :3]).sum(axis=-1)
            q = c0[:, None, :] - c1[:, None, :] * s[..., None]
            expected = [-q[..., 0], q[..., 1], -q[..., 2], 0 * s, value[..., 2], value[..., 1]]
            size = np.nanmax(np.abs(value), initial=1.0)
            for k, rate in enumerate(expected):
                there = (high > low) & np.isfinite(rate) & np.isfinite(slope[..., k])
                assert (
                    np.abs((slope[..., k] - rate)[there]).max(initial=0.0) < 1e-9 * size / curve.member.length
                )


def test_rates_along_a_member_are_the_load_and_the_shear() -> None:
    tree = da.load(examples()["four_bar"]).to_tree()
    tree["links"]["coupler"]["mass_along"] = "uniform"
    r = da.dynamics(da.mechanism(tree))
    f = da.member_forces(r, "coupler")
    check_rates(f)
    near, far = f.at(0.0), f.at(f.curves[0].member.length)
    e = f.curves[0].member.along[:2]
    for joint, found, sign in (("A", near, -1), ("B", far, 1)):
        force = np.einsum("pij,pi->pj", r.rotation("coupler"), r.reaction(joint, "coupler"))
        assert np.allclose(sign * force @ e, found["axial"], rtol=1e-12, atol=1e-9)
        assert np.allclose(-sign * force @ [-e[1], e[0]], found["shear"], rtol=1e-12, atol=1e-9)
        assert np.abs(found["bending"]).max() < 1e-12


def test_extremes_are_exact_and_scale_with_units() -> None:
    r = da.dynamics(da.load(examples()["engine"]), positions=24)
    f = da.member_forces(r, "rod")
    (curve,) = f.curves
    fine = curve.at(np.linspace(0, curve.member.length, 2001))
    for of, k in (("axial", 0), ("shear", 1), ("bending", 5)):
        least, _, most, _ = curve.extremes(of)
        assert (fine[:, 1:-1, k].max(axis=1) <= most + 1e-12 * np.abs(most).max()).all()
        assert (fine[:, 1:-1, k].min(axis=1) >= least - 1e-12 * np.abs(most).max()).all()
    a, b = (da.member_forces(da.dynamics(da.loads(t)), "arm").stress() for t in (ARM, IN_INCHES))
    assert a.largest == pytest.approx(b.largest, rel=1e-12)


IN_INCHES = """
units: {length: in, mass: lbm}
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.6 m, 0]}, mass: 2 kg, center: [0.3 m, 0], inertia: 0.06 kg*m^2, members: [[O, A]],
        mass_along: uniform, section: {rectangle: [20 mm, 40 mm]}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: 0, speed: 100 rad/s, acceleration: 500 rad/s^2}}
"""


def test_fatigue_and_buckling_of_a_rod_in_the_hand() -> None:
    """A pendulum rod pushed and pulled: sigma = F/A, so that mean and amplitude are those of the force."""
    text = """
links:
  ground: {points: {O: [0, 0]}}
  slider: {points: {A: [0, 0]}}
  rod: {points: {A: [0, 0], B: [1, 0]}, section: {circle: 20 mm, elasticity: 200 GPa, yield_stress: 250 MPa,
        ultimate: 400 MPa, endurance: 200 MPa}}
joints:
  O: {type: slider, links: [ground, slider], at: [O, A], direction: 0}
  A: {type: weld, links: [slider, rod]}
drives: {O: {position: {from: 0, to: 1, count: 3}, speed: 1}}
loads: {F: {type: force, on: rod, at: B, value: [{against: O, x: [0, 0.5, 1], y: [20 kN, -10 kN, 5 kN]}, 0]}}
"""
    f = da.member_forces(da.dynamics(da.loads(text)), "rod")
    area = np.pi / 4 * 0.02**2
    s, b = f.stress(), f.buckling(ends=1.0)
    found = s.fatigue()
    assert s.largest == pytest.approx(20e3 / area, rel=1e-12)
    assert (found.mean, found.amplitude) == pytest.approx((5e3 / area, 15e3 / area), rel=1e-12)
    assert found.safety == pytest.approx(1 / (15e3 / area / 200e6 + 5e3 / area / 400e6), rel=1e-12)
    assert b.compression == pytest.approx(10e3, rel=1e-12)
    assert (b.formula, b.position) == ("Euler", 1)
    assert b.critical == pytest.approx(np.pi**2 * 200e9 * np.pi / 64 * 0.02**4, rel=1e-12)
    assert f.buckling().critical == pytest.approx(b.critical / 4, rel=1e-9)  # welded to the slider, free at B
    short = f.buckling({"circle": 0.2, "elasticity": 200e9, "yield_stress": 250e6}, ends=1.0)
    thin = (1 / 0.05) ** 2 * 250e6 / (4 * np.pi**2 * 200e9)
    assert short.formula == "Johnson"
    assert short.critical == pytest.approx(np.pi * 0.01 * 250e6 * (1 - thin), rel=1e-12)


def test_the_command_writes_what_it_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(ARM, encoding="utf-8")
    assert (
        main(["members", str(file), "--json", str(tmp_path / "a.json"), "--csv", str(tmp_path / "a.csv")])
        == 0
    )
    assert "6000" in capsys.readouterr().out
    found = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["members"]["arm"]
    assert found["bending"]["largest"] == pytest.approx(-120, rel=1e-12)
    assert "stress.arm [N/m^2]" in (tmp_path / "a.csv").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("rectangle: [20 mm, 40 mm], ", "", "the section has no size; write one of rectangle"),
        ("rectangle: [20 mm, 40 mm]", "area: 8 cm^2", "the section has no modulus"),
        ("rectangle: [20 mm, 40 mm]", "circle: 20 mm, area: 8 cm^2", "give it twice"),
        ("mass_along: uniform", "mass_along: shape", "mass_along is by a shape, and there is none"),
        ("mass_along: uniform", "members: [[O, Q]]", "unknown point 'Q'"),
        ("mass_along: uniform", "members: [[O, A], [A, O]]", "the members close a ring"),
    ],
)
def test_what_is_wrong_has_its_line_and_remedy(old: str, new: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(ARM.replace(old, new), encoding="utf-8")
    with pytest.raises(da.ModelError, match=r"arm.yaml:[45]: ") as error:
        da.load(file)
    assert said in str(error.value)


def has_member(tree: Any) -> bool:
    """Whether a link of a machine is one straight member."""
    r = da.dynamics(da.mechanism(tree))
    for link in r.links:
        with suppress(da.ModelError):
            if not any(j.wheels for j in r.mechanism.joints.values() if link in j.links):
                return bool(da.member_forces(r, link))
    return False


def with_members(tree: Any) -> dict[str, Any]:
    """Forces inside the links of a machine that have one straight member, every other of them a slender bar."""
    tree = deepcopy(tree)
    m = da.mechanism(tree)
    for kind in range(2):
        r, found = da.dynamics(m), {}
        for link in r.links:
            if not any(j.wheels for j in m.joints.values() if link in j.links):
                with suppress(da.ModelError):  # no line through its joints
                    found[link] = da.member_forces(r, link)
        for link in [*found][::2] if not kind else []:
            uniform(tree, link, found[link], m.dimension)
        m = da.mechanism(tree)
    return found


def check_jumps(f: Any) -> dict[str, Any]:
    """N and V begin with, jump by and end with the force of a joint that is alone at its place: these forces (P, 3)."""
    r, link, (curve,) = f.result, f.link, f.curves
    e, acting = curve.member, LinkBalance(r, link, acting_on(r))
    feet = [(a, e.foot(acting.place(a))[0]) for a in acting.actions if a.kind not in ("weight", "inertia")]
    center, out = float(e.foot(acting.center)[0]), {}
    size = max(float(np.nanmax(np.abs(a.force), initial=1e-9)) for a in acting.actions)
    for a, at in feet:
        s, others = float(at[0]), [b[0] for x, b in feet if x is not a] + [center]
        if (
            a.kind != "joint"
            or not np.ptp(at) < 1e-9 * e.length
            or min(np.abs(np.array(others) - s)) < 1e-6 * e.length
        ):
            continue
        before, behind = (curve.at(s, side)[:, 0, :3] for side in ("before", "behind"))
        jump = (before - (0 if s == e.length else behind)) * [1, -1, 1]
        out[a.of] = np.einsum("pij,kj,pk->pi", acting.rotation, e.axes, jump)
        exact = wide(r.reaction(a.of, link))
        known = np.isfinite(jump).all(axis=1)
        assert np.abs(out[a.of] - exact)[known].max(initial=0.0) < 1e-9 * size, (link, a.of)
    return out


def check_members(tree: Any) -> int:
    """Rates and jumps of every member; both sides of a joint between two of them agree."""
    found = with_members(tree)
    sides: dict[str, list[Any]] = {}
    for f in found.values():
        check_rates(f)
        for joint, force in check_jumps(f).items():
            sides.setdefault(joint, []).append(force)
    size = max((np.nanmax(np.abs(x), initial=1e-9) for pair in sides.values() for x in pair), default=0.0)
    for a, b in (pair for pair in sides.values() if len(pair) == 2):
        assert np.nanmax(np.abs(a + b), initial=0.0) <= 1e-9 * size
    return len(found)


@over(1, 200, block=10)
def test_members_begin_and_end_with_the_reactions_and_change_by_their_load(seed: int) -> None:
    assert check_members(random_case(nth(seed, lambda n: has_member(random_case(n).tree))).tree) > 0


@over(1, 200, block=10)
def test_so_they_do_in_space(seed: int) -> None:
    some = nth(seed, lambda n: has_member(tree_in_space(random_in_space(n))))
    assert check_members(tree_in_space(random_in_space(some))) > 0


@over(2, 200)
def test_a_link_cut_in_two_and_welded_says_what_it_carries(seed: int) -> None:
    check_cuts(da.mechanism(random_case(seed).tree), seed)


@over(2, 200)
def test_so_it_does_in_space(seed: int) -> None:
    check_cuts(da.mechanism(tree_in_space(random_in_space(seed))), seed)


def test_a_link_that_carries_only_rounding_is_in_balance() -> None:
    """Its forces do not sum to nothing beside themselves, but do beside those of the mechanism."""
    r = da.dynamics(da.mechanism(tree_in_space(random_in_space(11010))))
    f = da.member_forces(r, "L7")
    most = max(float(np.abs(c.at(x)).max()) for c in f.curves for x in (0.0, c.member.length))
    assert 0 < most < 1e-25 < 1 < np.abs(r.force_array).max()
    assert f.residual.max() < 1e-9


def test_in_space_they_stand_along_the_axes_of_the_members() -> None:
    """Six inner forces of an RSSR: five panels, for no torsion is in it; what is not unique has the reason."""
    table = member_table(da.dynamics(da.load(examples()["rssr"])))
    scenes = member_scenes(table, Notation())
    titles = [s.title for s in scenes if "of crank" not in s.title and "O = " in s.title]
    assert [x.split(",")[0] for x in titles] == ["N", "V", "V_{z}", "M_{y}", "M"]
    notes = " ".join(text.text for text in scenes[3].texts())
    assert "M_{y}: 1 mm = 50 N·mm, + along z of its member" in notes
    tip, n = max((abs(f.largest("bending y")[0]), name) for name, f in table.links.items())
    assert any(number(1e3 * tip, 4) in text.text for text in scenes[3].texts()), n
    lifted = member_table(da.dynamics(da.lifted(da.load(examples()["four_bar"]))))
    said = " ".join(str(lifted).split())
    assert (
        "At position 1 these are not known: crank V_z, T, M_y; coupler V_z, T, M_y; rocker V_z, T, M_y."
        in said
    )


PISTON = """
links:
  ground: {points: {O: [0, 0]}}
  piston: {points: {A: [0, 0], P: [-0.05, 0], Q: [0.05, 0]}, members: [[P, Q]]}
joints:
  O: {type: slider, links: [ground, piston], at: [O, A], direction: 0,
      friction: {coefficient: 0.1, guide: [30 mm, 40 mm], half_height: 10 mm}}
drives: {O: {position: {from: 0, to: 1, count: 3}, speed: 1}}
loads: {F: {type: force, on: piston, at: Q, value: [0, 70 N]}}
"""


def test_a_piston_bears_at_the_two_ends_of_its_guide() -> None:
    """70 N at its end, S = 92 N: 81 N ahead, 11 N behind, and a couple of mu S h of the friction on the faces."""
    f = da.member_forces(da.statics(da.loads(PISTON)), "piston")
    places = [0.01, 0.02, 0.05, 0.05, 0.09, 0.095]
    shear = [f.at(s)["shear"][1] for s in places]
    assert shear == pytest.approx([0, 11, 11, 11, -70, -70], abs=1e-9)
    before, behind = f.at(0.05, side="before"), f.at(0.05, side="behind")
    bending = [x["bending"][1] for x in (before, behind, f.at(0.09))]
    assert bending == pytest.approx([0.33, 0.26, 0.7], rel=1e-9)
    assert f.residual.max() < 1e-12


def guided(tree: Any) -> tuple[Any, list[str]]:
    """The description with a length of the guide of each joint that can have one, which does not rub."""
    tree, some = deepcopy(tree), []
    for name, joint in tree["joints"].items():
        if joint["type"] in ("slider", "prismatic", "revolute"):
            friction = {"coefficient": 0.0, "guide": [0.03, 0.05]}
            joint["friction"] = friction | ({"radius": 0.01} if joint["type"] == "revolute" else {})
            some.append(name)
    return tree, some


def check_guides(tree: Any) -> None:
    """Beyond the ends of a guide it is as if all acted at its point; on both links its forces are opposite."""
    with_ends, names = guided(tree)
    plain, r = (da.dynamics(da.mechanism(t)) for t in (tree, with_ends))
    on = acting_on(r)[0]
    sums: dict[tuple[str, str], Any] = {}
    for a in (a for a in on if a.kind == "joint" and a.of in names):
        assert not np.nan_to_num(a.moment(a.at)).any() or not a.part
        sums[a.of, a.part] = sums.get((a.of, a.part), 0.0) + a.force
    size = max(float(np.nanmax(np.abs(a.force), initial=1e-9)) for a in on)
    assert all(np.nanmax(np.abs(total), initial=0.0) < 1e-9 * size for total in sums.values())
    for link in r.links:
        with suppress(da.ModelError):
            (old,), (new,) = (da.member_forces(x, link).curves for x in (plain, r))
            own = LinkBalance(r, link, [on])
            feet = [
                new.member.foot(own.place(x))[0] for x in own.actions if x.of in names and x.kind == "joint"
            ]
            carried = max(float(np.nanmax(np.abs(x.force), initial=0.0)) for x in own.actions)
            if not feet or carried < 1e-9 * size:  # what is left over of nothing is rounding
                continue
            assert np.nanmax(da.member_forces(r, link).residual, initial=0.0) < 1e-9
            places = np.linspace(0.001, 0.999, 41) * new.member.length
            ends = np.array(feet)
            beyond = (places > ends.max(axis=0)[:, None]) | (places < ends.min(axis=0)[:, None])
            gap = np.abs(old.at(places) - new.at(places)) / [
                *[size] * 3,
                *[size * r.compiled.layout.length] * 3,
            ]
            assert np.nanmax(gap[beyond], initial=0.0) < 1e-8


def has_guide(seed: int) -> bool:
    """Whether a random machine of the plane has a slider."""
    return bool(guided(random_case(seed).tree)[1])


def has_bearing(seed: int) -> bool:
    """Whether one in space has a joint with two ends."""
    return bool(guided(tree_in_space(random_in_space(seed)))[1])


@over(1, 100, block=10)
def test_ends_of_guides_of_random_machines_carry_what_their_point_did(seed: int) -> None:
    check_guides(random_case(nth(seed, has_guide)).tree)


@over(1, 100, block=10)
def test_so_do_ends_of_bearings_in_space(seed: int) -> None:
    check_guides(tree_in_space(random_in_space(nth(seed, has_bearing))))


def has_free_reactions(seed: int) -> bool:
    """Whether a machine of the plane can be lifted into space, and there has a member and free reactions."""
    with suppress(da.ModelError):
        tree = da.lifted(da.mechanism(random_case(seed).tree)).to_tree()
        return not da.dynamics(da.mechanism(tree)).unique(next(iter(tree["joints"]))).all() and has_member(
            tree
        )
    return False


@pytest.mark.parametrize("turn", [0.0, 0.7, -39.36])
def test_a_link_with_one_joint_has_no_member_of_rounding(turn: float) -> None:
    """Two places of one joint, its force's and its couple's, differ by rounding: no line, whatever the direction."""
    text = f"""
gravity: standard
links:
  ground: {{points: {{O: [0, 0]}}}}
  crank: {{points: {{O: [0, 0], A: [0.31, 0]}}}}
  rod: {{points: {{A: [0.1, 0]}}, mass: 2, center: [0.4, 0.1]}}
joints: {{O: {{type: pin, links: [ground, crank]}}, A: {{type: pin, links: [crank, rod]}}}}
drives: {{O: {{position: [{turn}, {turn + 50}]}}, A: {{position: [1.3, 71]}}}}
loads: {{C: {{type: couple, on: rod, value: 3}}}}
"""
    table = member_table(da.statics(da.loads(text)))
    assert [*table.links] == ["crank"]
    assert "link 'rod' has no length" in table.left_out["rod"]


def test_a_compression_of_rounding_is_none() -> None:
    """Across a lever pushed by a slide nothing presses along it: no safety of 1e19."""
    text = """
links:
  ground: {points: {P: [0, 0], O: [0.9, 0.1]}}
  lever: {points: {P: [0, 0], S: [0.8, 0]}, section: {rectangle: [20 mm, 10 mm], elasticity: 210 GPa}}
  crank: {points: {O: [0, 0], S: [0.17, 0]}}
joints:
  P: {type: pin, links: [ground, lever]}
  O: {type: pin, links: [ground, crank]}
  S: {type: slot, links: [lever, crank], at: [P, S]}
drives: {O: {position: {from: 0, to: 360, count: 16}}}
loads: {F: {type: force, on: lever, at: S, axes: link, value: [0, 100]}}
assembly: {lever: 5}
"""
    r = da.statics(da.loads(text))
    b = member_table(r).links["lever"].buckling()
    assert np.abs(r.reaction("S")).max() > 10
    assert (b.compressions == 0).all()
    assert b.safety == math.inf


def test_the_hint_names_the_points_of_the_link() -> None:
    text = ARM.replace("A: [0.6, 0]}", "A: [0.6, 0], B: [0, 0.2]}")
    text = text.replace("joints:", "  bob: {points: {B: [0, 0]}}\n  end: {points: {A: [0, 0]}}\njoints:")
    text = text.replace(
        "drives:", "  A: {type: weld, links: [arm, end]}\n  B: {type: weld, links: [arm, bob]}\ndrives:"
    )
    with pytest.raises(da.ModelError, match=r"members: \[\[O, A\], \[A, B\]\]"):
        da.member_forces(da.dynamics(da.loads(text)), "arm")


def test_what_is_unique_inside_links_does_not_go_by_the_stiffness_of_joints() -> None:
    check_unique(da.load(examples()["four_bar"]), 0)


@over(0, 12, block=2)
def test_so_it_is_of_random_machines(seed: int) -> None:
    seed = nth(seed, has_free_reactions)
    check_unique(da.mechanism(random_case(seed).tree), seed)


def check_unique(m: Any, seed: int) -> None:
    """Joints that yield, twice by other numbers: what stays the same is a number, what differs is none."""
    tree, rng = da.lifted(m).to_tree(), np.random.default_rng(seed)
    for name in set(tree["links"]) - {"ground"}:
        loads = tree.setdefault("loads", {})
        loads[f"{name} aside"] = {
            "type": "force",
            "on": name,
            "at": [0.1, 0.2, 0.3],
            "value": [3.0, 4.0, 5.0],
        }
        loads[f"{name} turns"] = {"type": "couple", "on": name, "value": [0.3, 0.4, 0.5]}
    found = [with_stiffness(tree, joints) for joints in (None, rng, rng)]
    told = 0
    for link in set(found[0]) & set(found[1]) & set(found[2]):
        length = found[0][link].curves[0].member.length
        rigid, *yielding = (f[link].curves[0].at(np.linspace(0.03, 0.97, 7) * length) for f in found)
        size = max(np.nanmax(np.abs(y), initial=1e-9) for y in yielding)
        gap = np.abs(yielding[0] - yielding[1]) / size
        known = np.isfinite(rigid)
        assert np.abs(rigid - yielding[0])[known].max(initial=0.0) < 1e-6 * size
        assert gap[known].max(initial=0.0) < 1e-6
        free = (~known & np.isfinite(gap)).any(axis=(0, 1))
        assert (gap.max(axis=(0, 1), where=~known & np.isfinite(gap), initial=0.0)[free] > 1e-9).all()
        told += int(np.isfinite(gap).any())
    assert told


def with_stiffness(tree: Any, rng: Any) -> dict[str, Any]:
    """Forces inside the links that are one member, joints yielding by random numbers or rigid."""
    tree = deepcopy(tree)
    for joint in tree["joints"].values() if rng else ():
        force, moment = rng.uniform(1e6, 9e6, 2)
        joint["stiffness"] = {"force": f"{force} N/m", "moment": f"{moment} N*m/rad"}
    r, out = da.dynamics(da.mechanism(tree)), {}
    for link in r.links:
        with suppress(da.ModelError):
            out[link] = da.member_forces(r, link)
    return out


def test_diagrams_stand_on_the_links_to_scale() -> None:
    """The arm's root: 6000 N and 120 N m drawn across it, and as numbers beside."""
    scene = da.draw.machine(member_table(da.dynamics(da.loads(ARM))))
    words = {text.text for text in scene.texts()}
    assert {"6000 N", "120.0 N·m"} <= {w.replace("−", "") for w in words}
    assert any("N: 1 mm = 500 N, + to the left of its member" in w for w in words)


@pytest.mark.parametrize("name", ["four_bar", "toggle_press", "rssr"])
def test_numbers_stand_beside_the_diagrams(name: str) -> None:
    """No middle of a number is inside the outline of a diagram, by the angle that the outline goes round it."""
    scenes = member_scenes(member_table(da.dynamics(da.load(examples()[name]), positions=6)), Notation())
    outlines = 0
    for scene in (s for s in scenes if "1 mm" in " ".join(t.text for t in s.texts())):
        for line in (
            i for i in scene.items if isinstance(i, Line) and i.role == "curve-1" and len(i.points) > 2
        ):
            ring = np.array([*line.points, line.points[0]]) @ [1, 1j]
            for text in scene.texts():
                away = ring - complex(*text.at)
                assert abs(np.angle(away[1:] / away[:-1]).sum()) < 1, text.text
            outlines += 1
    assert outlines > 1


TURNING = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], A: [0.5, 0]}, mass: 2, center: [0.25, 0], inertia: 0.04, mass_along: MASS}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: 30 deg}}
turning: {axis: y, speed: 8 rad/s}
"""


def test_in_a_plane_that_turns_a_lumped_mass_pulls_from_its_centre_on() -> None:
    """m w^2 r of the centre, along the arm m w^2 r cos(30 deg), and none beyond it; a mass along it is refused."""
    inner = da.member_forces(da.dynamics(da.loads(TURNING.replace("MASS", "lumped"))), "arm")
    pull = 2 * 8**2 * 0.25 * math.cos(math.radians(30))
    for s, axial, shear in ((0.1, pull * math.cos(math.radians(30)), pull / 2), (0.4, 0.0, 0.0)):
        at = inner.at(s)
        assert at["axial"][0] == pytest.approx(axial, abs=1e-9)
        assert abs(at["shear"][0]) == pytest.approx(shear, abs=1e-9)
    with pytest.raises(da.ModelError, match="lies along it, and in a plane that turns"):
        da.member_forces(da.dynamics(da.loads(TURNING.replace("MASS", "uniform"))), "arm")


def paragraphs(table: Any) -> list[str]:
    """What is printed behind title and assumptions, each paragraph on a line."""
    return [" ".join(part.split()) for part in table.text().split("\n\n")[1:]]


def test_a_machine_that_nothing_loads_is_told_so() -> None:
    text = "links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0], A: [1, 0]}}}"
    r = da.statics(
        da.loads(text + "\njoints: {O: {type: pin, links: [ground, arm]}}\ndrives: {O: {position: 0}}")
    )
    assert paragraphs(member_table(r)) == [
        "The links carry no internal forces.",
        "N tension +; the distance is from the first end of the member. Equilibrium of every link holds to 0.",
    ]


def test_positions_without_an_answer_say_why() -> None:
    """One of four, and the only one: then nothing is said of equilibrium either."""
    m = da.four_bar(positions=4).with_values({"links.coupler.points.B.0": 0.12})
    r = da.dynamics(m)
    assert r.status == ("ok", "ok", "not_assembled", "ok")
    said = paragraphs(member_table(r))
    assert said[1:-1] == [f"At position 3 forces inside links are not known: {r.reasons[2]}"]
    assert said[-1].startswith(
        "N tension +; the distance is from the first end of the member. Equilibrium of every"
    )
    lone = da.dynamics(m.with_values({"drives.O2.position": math.pi}))
    assert paragraphs(member_table(lone)) == [
        f"At position 1 forces inside links are not known: {lone.reasons[0]}",
        "N tension +; the distance is from the first end of the member.",
    ]
    for link in r.links:
        f = da.member_forces(r, link)
        assert np.isnan(f.residual).tolist() == [False, False, True, False]
        for place in (
            0.0,
            f.curve().member.length,
        ):  # at the far end nothing is beyond: no force, where all is known
            known = np.isfinite(f.curve().at(place)[:, 0])
            assert known.tolist() == [[True] * 6] * 2 + [[False] * 6] + [[True] * 6]


def test_a_link_that_carries_nothing_is_safe_without_limit() -> None:
    text = ARM.replace("speed: 100 rad/s, acceleration: 500 rad/s^2", "speed: 0")
    section = "rectangle: [20 mm, 40 mm], yield_stress: 250 MPa"
    full = f"{section}, elasticity: 206 GPa, endurance: 100 MPa, ultimate: 400 MPa"
    r = da.dynamics(da.loads(text.replace(section, full)))
    stress = da.member_forces(r, "arm").stress()
    assert (stress.largest, stress.safety, stress.fatigue().safety) == (0.0, math.inf, math.inf)
    assert da.member_forces(r, "arm").deflection().largest == 0.0
    assert paragraphs(member_table(r))[0] == "The links carry no internal forces."


def test_what_is_not_unique_inside_a_link_is_named_beside_what_is() -> None:
    """A bar between two pins: its axial force may be anything, F a b / L in the middle of it is known all the same."""
    text = """
links:
  ground: {points: {A: [0, 0], B: [1, 0]}}
  bar: {points: {A: [0, 0], M: [0.4, 0], B: [1, 0]}, section: {rectangle: [0.02, 0.04], yield_stress: 250 MPa}}
joints: {A: {type: pin, links: [ground, bar]}, B: {type: pin, links: [ground, bar]}}
loads: {F: {type: force, on: bar, at: M, value: [100, -300]}}
"""
    r = da.statics(da.loads(text))
    t = member_table(r)
    assert (t.unknown, t.links["bar"].unknown()) == ({"1": r.reasons[0]}, {"1": ["axial"]})
    shear, bend = (t.links["bar"].largest(of) for of in ("shear", "bending"))
    assert [abs(shear[0]), abs(bend[0]), bend[2]] == pytest.approx(
        [300 * 0.6, 300 * 0.4 * 0.6, 0.4], rel=1e-12
    )
    assert math.isnan(t.stress["bar"].largest)
    assert paragraphs(t)[1:3] == [
        "At position 1 these are not known, nor the stress: bar N. 1 constraint is redundant among joints A, B.",
        "N tension +; the distance is from the first end of the member. Equilibrium of every link holds to "
        f"{remainder(float(t.links['bar'].residual[0]))}.",
    ]


@pytest.mark.parametrize("joints", [("A", "B"), ("B", "A")])
@pytest.mark.parametrize("points", [("A", "B"), ("B", "A"), ("A", "M", "B"), ("M", "B", "A")])
def test_a_member_begins_at_the_point_that_is_named_first(
    points: tuple[str, ...], joints: tuple[str, str]
) -> None:
    """In whichever order its joints are; of several on its line the outermost ones, from the side of the first."""
    places = {"A": [0, 0], "M": [0.4, 0], "B": [1, 0]}
    kinds = {"A": "pin", "B": "slot"}
    tree = {
        "links": {
            "ground": {"points": {"A": [0, 0], "B": [1, 0]}},
            "bar": {"points": {n: places[n] for n in points}},
        },
        "joints": {n: {"type": kinds[n], "links": ["ground", "bar"]} for n in joints},
    }
    (curve,) = da.member_forces(da.statics(da.mechanism(tree)), "bar").curves
    first = "A" if points.index("A") < points.index("B") else "B"
    assert curve.member.ends == ((first, "AB".replace(first, "")))
    assert curve.member.start.tolist() == [*places[first], 0]
    assert curve.member.along == pytest.approx([1 if first == "A" else -1, 0, 0])


@pytest.mark.parametrize("load", [-100.0, 500.0])
def test_a_post_that_is_only_pressed_has_its_diagram_too(load: float) -> None:
    """As one that is only pulled."""
    post = {"points": {"O": [0, 0], "P": [0, 0.5]}, "mass": 2.0, "center": [0, 0.4]}
    m = da.mechanism(
        {
            "gravity": [0, -9.81],
            "links": {"ground": {"points": {"O": [0, 0]}}, "post": post},
            "joints": {"O": {"type": "pin", "links": ["ground", "post"]}},
            "drives": {"O": {"position": [0]}},
            "loads": {"W": {"type": "force", "on": "post", "at": "P", "value": [0, load]}},
        }
    )
    scenes = member_scenes(member_table(da.statics(m)), Notation())
    assert [s.title for s in scenes] == ["N, axial, O = 0°", "N, axial of post"]
    (drawn,) = scenes[1].numbers.values()
    assert (min(drawn), max(drawn)) == pytest.approx(sorted((load - 19.62, load)))
