"""Cams as a file has them: what is refused, files, drawings, friction, contacts, jumps, copies."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.elements.point_profiles import _spline
from dalembert.errors import ModelError
from dalembert.machine.elements import cam_files
from dalembert.machine.elements.cam_files import outline
from dalembert.machine.elements.hertz_contact import LineContact
from dalembert.model import read_file
from dalembert.model.joints.elements.cam_profiles import CamPoints
from dalembert.model.library import template_text
from dalembert.pages.page_data import page_data
from dalembert.views.paper.scene import Arrow, Circle, Polygon
from tests.elements.random_cams import Case
from tests.elements.test_cam_cases import sliding
from tests.tiers import crossed, tiers

RISE = [{"to": "20 mm", "in": "90 deg", "by": "cycloidal"}, {"dwell": "40 deg"}]
FULL = [*RISE, {"to": 0, "in": "110 deg", "by": "polynomial345"}, {"dwell": "rest"}]
TURN = {"position": {"from": 0, "to": 360, "count": 36}, "speed": "20 rad/s"}


def machine(follower: Any = "knife", segments: Any = None, **more: Any) -> dict[str, Any]:
    """A cam by lift, its follower sliding upwards, with a mass and a load."""
    profile = {"base": "40 mm", "segments": FULL if segments is None else segments} | more.pop("profile", {})
    load = {"P": {"type": "force", "on": "stem", "at": "F", "value": [0, -300]}}
    tree = sliding(follower, profile, drive=dict(TURN), stem={"mass": 0.5}, loads=load)
    tree["joints"]["F"] |= more
    return tree


WRONG: list[tuple[dict[str, Any], str]] = [
    (
        machine(segments=[*RISE, {"to": 0, "in": "200 deg", "by": "cycloidal"}]),
        "segments of profile of joint 'F': the segments fill 330 deg; add {dwell: rest}",
    ),
    (
        machine(segments=[*RISE, {"to": "1 mm", "in": "110 deg", "by": "cycloidal"}, {"dwell": "rest"}]),
        "segments of profile of joint 'F': the lift ends at 0.001 m; let it return: end with {to: 0, in: ..., by: ...}",
    ),
    (
        machine(profile={"prime": "50 mm"}),
        "profile of joint 'F': both base and prime are given; give base, the least radius of the cam, or prime, that "
        "of the roller's centre",
    ),
    (
        machine(profile={"eccentric": "5 mm", "radius": "20 mm"}),
        "profile of joint 'F': it has segments and eccentric; give one of segments, eccentric, arcs, tangent, points",
    ),
    (
        machine({"roller": "8 mm"}, friction={"coefficient": 0.1}),
        "friction of joint 'F': a roller rolls on the cam and does not rub; leave friction out, or let the roller be a "
        "link with friction in its pin",
    ),
    (machine({"roller": 0}), "roller of follower of joint 'F': 0 is not positive; write a positive one"),
    (
        machine(contact="pulls"),
        "contact of joint 'F': a cam pushes its follower, it does not pull it; leave contact out, or write contact: "
        "holds for a roller in a groove",
    ),
    (machine(face="10 deg"), "face of joint 'F': a knife has no face; leave it out"),
]


def written(keys: dict[str, Any]) -> dict[str, Any]:
    """The machine with other keys of its cam."""
    tree = machine(keys.pop("follower", "knife"), keys.pop("segments", None))
    tree["joints"]["F"] |= keys
    return tree


ROWS: Any = read_file(Path(__file__).with_name("wrong_cams.yaml"))[0]["cams"]
WRONG += [(written(row["keys"]), row["says"]) for row in ROWS]


@pytest.mark.parametrize(("tree", "says"), WRONG)
def test_a_wrong_cam_is_told_where_and_what(tree: dict[str, Any], says: str) -> None:
    with pytest.raises(ModelError) as error:
        da.mechanism(tree)
    assert str(error.value) == says


def refused(tree: dict[str, Any]) -> str:
    with pytest.raises(ModelError) as error:
        da.dynamics(da.mechanism(tree))
    return str(error.value)


def test_what_does_not_fit_the_machine() -> None:
    """An offset beyond the base circle, a follower without a carrier, lifts of the wrong kind."""
    far = machine()
    far["links"]["ground"]["points"]["O2"] = [0.045, 0]
    far["joints"]["guide"]["at"] = ["O2", "F"]
    assert refused(far) == (
        "cam 'F': the offset is 45 mm, and the radius at lift 0 40 mm; make the base circle larger than the offset"
    )
    angles = machine(segments=[{"to": "20 deg", "in": "90 deg", "by": "cycloidal"}, *FULL[1:]])
    assert refused(angles) == (
        "cam 'F': its lift is an angle, and its follower slides in joint 'guide'; write lifts as lengths: "
        "{to: 25 mm, ...}"
    )
    loose = machine()
    loose["links"]["slide"] = {"points": {"O": [0, 0]}}
    loose["joints"]["guide"]["links"] = ["slide", "stem"]
    loose["joints"]["weld"] = {"type": "weld", "links": ["ground", "slide"], "at": "O"}
    assert refused(loose).startswith(
        "cam 'F': its profile is a lift, and no link carries both cam and follower; pin"
    )


@pytest.mark.parametrize("follower", [{"roller": "0.03"}, "flat"])
def test_a_cam_is_undercut_from_its_least_base_on(follower: Any) -> None:
    """Just below it is refused with the place and the remedy; just above it is not."""
    large = da.mechanism(machine(follower, profile={"base": "120 mm"}))
    least = da.cam(large, "F").least_base
    assert da.dynamics(large.with_values({"joints.F.profile.base": least * (1 + 1e-6)})).residual.max() < 1e-9
    with pytest.raises(
        ModelError, match=r"cam 'F' is undercut from .* deg of its turn: .*; take a base radius from"
    ):
        da.dynamics(large.with_values({"joints.F.profile.base": least * (1 - 1e-3)}))


def test_a_cam_is_saved_and_read() -> None:
    for tree in (
        machine({"roller": "8 mm"}),
        machine("flat", face_width="12 mm", elasticity="206 GPa", friction={"coefficient": 0.1}),
        sliding("knife", {"tangent": {"base": 0.03, "lift": 0.01, "half_angle": "60 deg"}}, drive=TURN),
        sliding({"roller": 0.01}, {"points": {"angle": [0, 90, 180, 270], "radius": [0.05] * 4}}, drive=TURN),
        Case(3).tree(),  # whose lift is an angle, also where every number of the file is bare
        Case(3).tree() | {"units": {"length": "mm", "angle": "rad"}},
    ):
        m = da.mechanism(tree)
        assert da.mechanism(m.to_tree()) == m
        assert da.loads(str(m)) == m


@pytest.mark.parametrize("past", [-1e-3, 1e-3])
def test_the_nose_of_a_tangent_cam_has_a_radius(past: float) -> None:
    """base + lift - lift / (1 - cos half) is 0 at lift = base (1 - cos half) / cos half."""
    half = math.radians(50)
    lift = 0.03 * (1 / math.cos(half) - 1) * (1 + past)
    tangent = {"base": 0.03, "lift": lift, "half_angle": f"{half!r} rad"}
    tree = sliding("knife", {"tangent": tangent}, drive=TURN)
    if past < 0:
        assert da.cam(da.mechanism(tree), "F").nose_radius == pytest.approx(0.03e-3)
        return
    with pytest.raises(ModelError, match=r"the nose would have a radius of -0\.03 mm; make the base circle"):
        da.mechanism(tree)
    for angle, refused in (("90 deg", True), ("89 deg", False)):
        tangent |= {"lift": 0.01, "half_angle": angle}
        assert ("the half angle is not below 90 deg" in refusal(tree)) == refused


def refusal(tree: Any) -> str:
    try:
        da.statics(da.mechanism(tree))
    except ModelError as error:
        return str(error)
    return ""


def test_a_swinging_face_touches_base_circles_between_two_radii() -> None:
    """Its line is as far from the pivot in every position; the pivot is 120 mm from the cam's axis."""
    tree = Case(5).tree()
    profile = tree["joints"]["F"]["profile"]
    profile["base"] = 0.5
    least, most = map(float, re.findall(r"between ([\d.]+) mm and ([\d.]+) mm", refusal(tree))[0])
    assert most - least == pytest.approx(240, abs=1e-3) or (least == 0 and 120 <= most < 240)
    for base in (least, most):
        for side in (-1e-3, 1e-3):
            profile["base"] = base * (1 + side) * 1e-3
            outside = base > 0 and (side > 0) == (base == most)
            assert ("does not touch a base circle of" in refusal(tree)) == outside


@pytest.mark.parametrize("ending", tiers(["csv"], ["dxf"]))
def test_the_outline_of_a_file_moves_the_follower_as_the_cam_does(tmp_path: Path, ending: str) -> None:
    """Within twice the tolerance."""
    m = da.mechanism(machine({"roller": "8 mm"}))
    path = tmp_path / f"cam.{ending}"
    da.cam(m, "F").save(path, tolerance=1e-6, cutter=0.005)
    tree = machine({"roller": "8 mm"})
    tree["joints"]["F"]["profile"] = {"points": {"file": str(path)}}
    ours, theirs = (da.kinematics(x).freedom("guide", "slide")[0] for x in (m, da.mechanism(tree)))
    assert np.abs(ours - theirs).max() < 2e-6


@pytest.mark.parametrize(("tolerance", "finer"), [(1e-4, False), (1e-6, True), (1e-7, True)])
def test_no_chord_of_an_outline_is_farther_from_it_than_the_tolerance(tolerance: float, finer: bool) -> None:
    c = da.cam(da.mechanism(machine({"roller": "8 mm"})), "F")
    turns = outline(c, tolerance)
    ends = np.append(turns, turns[0] + 2 * np.pi)
    part = np.linspace(0, 1, 9)[1:-1, None]
    between = c.profile(((1 - part) * ends[:-1] + part * ends[1:]).ravel()).reshape(7, -1, 2)
    a, b = c.profile(turns), c.profile(np.mod(ends[1:], 2 * np.pi))
    along = (b - a) / np.hypot(*(b - a).T)[:, None]
    away = between - a
    off = np.abs(away[..., 0] * along[:, 1] - away[..., 1] * along[:, 0]).max()
    assert off <= tolerance
    assert [len(turns) > 180, bool(off > tolerance / 5)] == [finer] * 2  # no more corners than it needs


def test_an_outline_that_cannot_be_written_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cam_files, "MOST", 697)
    c = da.cam(da.mechanism(machine({"roller": "8 mm"})), "F")
    for options, said in (
        ({"tolerance": 0.0}, "the tolerance 0 is not positive"),
        ({"tolerance": -1e-6}, "the tolerance -1e-06 is not positive"),
        ({"tolerance": float("nan")}, "the tolerance nan is not positive"),
        ({"tolerance": 2e-7}, "a tolerance of 2e-07 m needs more than 697 points"),
    ):
        with pytest.raises(ModelError, match=said):
            c.save(tmp_path / "cam.csv", **options)
    assert not list(tmp_path.iterdir())


STEEL, BRONZE = (206e9, 0.3), (110e9, 0.34)


@pytest.mark.parametrize(("radii", "one", "two"), [
    ((0.045, 0.012), STEEL, STEEL), ((0.045, 0.012), STEEL, BRONZE), ((0.012, 0.045), BRONZE, STEEL),
    ((0.03, np.inf), STEEL, BRONZE), ((0.012, -0.045), STEEL, BRONZE),
])  # fmt: skip
def test_line_contact_is_that_of_hertz(radii: Any, one: Any, two: Any) -> None:
    """The pressure, half an ellipse over the width, carries the force; the bodies meet where it ends."""
    force, width = 1800.0, 0.016
    x = da.hertz_line(force, width, radii, (one[0], two[0]), (one[1], two[1]))
    assert x.pressure * np.pi / 2 * x.half_width * width == pytest.approx(force, rel=1e-12)
    soft = (1 - one[1] ** 2) / one[0] + (1 - two[1] ** 2) / two[0]
    flattened = 2 * x.pressure * soft / x.half_width  # change of curvature under half an ellipse of pressure
    assert flattened == pytest.approx(1 / radii[0] + 1 / radii[1], rel=1e-12)


@pytest.mark.parametrize("wrong", [
    {"force": -1.0}, {"force": np.nan}, {"width": 0.0}, {"width": -1.0}, {"width": np.nan},
    {"elasticity": 0.0}, {"elasticity": -1.0}, {"elasticity": (206e9, 0.0)}, {"elasticity": (-1.0, 206e9)},
    {"radii": (0.02, -0.02)}, {"radii": (0.02, -0.01)}, {"radii": (np.inf, np.inf)},
])  # fmt: skip
def test_contacts_that_are_none_are_refused(wrong: dict[str, Any]) -> None:
    right: dict[str, Any] = {"force": 0.0, "width": 0.016, "radii": (0.02, -0.0201)}
    assert da.hertz_line(**right) == LineContact(0.0, 0.0)
    said = "hollow and not wider" if "radii" in wrong else "must be positive"
    with pytest.raises(ModelError, match=said):
        da.hertz_line(**right | wrong)


@pytest.mark.long
def test_points_are_met_by_a_face_and_by_a_roller_as_the_disc_they_are_from() -> None:
    e, radius = 0.012, 0.04
    angle = np.linspace(0, 360, 121)[:-1]
    b = np.radians(angle)
    r = e * np.cos(b) + np.sqrt(radius**2 - (e * np.sin(b)) ** 2)
    points = {"points": {"angle": angle.tolist(), "radius": r.tolist()}}
    for follower in ("knife", {"roller": 0.01}, "flat"):
        disc, cut = (
            da.dynamics(da.mechanism(sliding(follower, p, drive=TURN, stem={"mass": 1})))
            for p in ({"eccentric": e, "radius": radius}, points)
        )
        for order, close in enumerate((1e-8, 1e-5, 5e-3)):
            ours, theirs = (x.freedom("guide", "slide")[order] for x in (cut, disc))
            assert ours == pytest.approx(theirs, abs=close * float(np.abs(theirs).max()))


def test_a_contact_is_lost_where_it_would_pull() -> None:
    tree = machine({"roller": "8 mm"})
    tree["loads"]["P"]["value"] = [0, -2]
    r = da.dynamics(da.mechanism(tree))
    assert "contact_lost" in r.status
    held = machine({"roller": "8 mm"}, contact="holds")
    held["loads"]["P"]["value"] = [0, -2]
    c = da.cam(da.mechanism(held), "F")
    assert (c.force < 0).any()
    assert len(c.changes) in (2, 4)
    speed = da.cam(da.mechanism(tree), "F").lift_speed
    for factor, lost in ((0.999, False), (1.001, True)):
        tree["drives"]["O"]["speed"] = f"{factor * speed} rad/s"
        assert ("contact_lost" in da.dynamics(da.mechanism(tree)).status) is lost


@pytest.mark.parametrize("seed", [1, 3, 5])
def test_a_contact_that_nothing_loads_is_not_lost_by_rounding(seed: int) -> None:
    """In a dwell without weight every force is rounding, whatever mass, speed, direction and place; where the follower
    slows down the contact is lost. A compiled program says the same."""
    rng = np.random.default_rng(seed)
    at, towards = rng.uniform(-1, 1, 2).tolist(), float(rng.uniform(0, 360))
    drive = TURN | {"speed": f"{10 ** rng.uniform(-1, 3)} rad/s"}
    tree = sliding(
        {"roller": "8 mm"},
        {"base": "40 mm", "segments": FULL},
        drive=drive,
        stem={"mass": 10 ** rng.uniform(-3, 4)},
    )
    tree["links"]["ground"]["points"]["O"] = at
    tree["joints"]["guide"]["direction"] = towards
    m = da.mechanism(tree)
    r = da.dynamics(m)
    falls = r.freedom("guide", "slide")[2] < -1e-9 * np.abs(r.freedom("guide", "slide")[2]).max()
    assert 0 < falls.sum() < len(falls)
    assert [s == "contact_lost" for s in r.status] == falls.tolist()
    assert da.compile(m, ["links.stem.mass"])([[m.links["stem"].mass]]).status.ravel().tolist() == list(
        r.status
    )


def test_a_spring_keeps_the_least_force() -> None:
    """The stiffness with a preload, and the softest spring, both at their limit."""
    tree = machine({"roller": "8 mm"}, contact="holds")
    tree["loads"] = {}
    tree["drives"]["O"]["speed"] = "60 rad/s"
    c = da.cam(da.mechanism(tree), "F")
    free = c.spring_for(least=20.0)
    stiffness, preload = c.spring_for(preload=50.0, least=20.0)
    spring = {"type": "spring", "between": ["ground.top", "stem.F"], "stiffness": stiffness}
    spring["free_length"] = 1 - 0.048 + preload / stiffness
    r = da.dynamics(da.mechanism(tree | {"loads": {"S": spring}}))
    assert da.cam(r.mechanism, "F").force.min() == pytest.approx(20.0, abs=1e-6)
    assert free[1] + free[0] * 0.02 <= 50.0 + c.spring_for(preload=50.0, least=20.0)[0] * 0.02 + 1e-9


def test_a_follower_heavy_enough_needs_no_spring() -> None:
    tree = machine({"roller": "8 mm"})  # its load presses with 300 N
    c = da.cam(da.mechanism(tree), "F")
    assert c.force.min() > 250.0
    assert c.spring_for(least=200.0) == c.spring_for(preload=0.0, least=200.0) == (0.0, 0.0)


@pytest.mark.parametrize("sense", ["ccw", "cw"])
def test_a_flat_face_is_as_wide_as_the_follower_is_fast(sense: str) -> None:
    """Its contact is ds/dq aside: most in the cycloidal rise, 2 h over its angle, on either side by the sense."""
    c = da.cam(da.mechanism(machine("flat", profile={"base": "80 mm", "sense": sense})), "F")
    assert c.face_half_width == pytest.approx(2 * 0.02 / math.radians(90), rel=1e-9)


def disc_aside(offset: float, sense: str) -> Any:
    """A disc of 50 mm, 12 mm off its axis, under a roller of 8 mm whose guide is offset from the axis."""
    profile = {"eccentric": 0.012, "radius": 0.05, "sense": sense}
    tree = sliding({"roller": 0.008}, profile, drive=dict(TURN))
    tree["links"]["ground"]["points"]["E"] = [offset, 0]
    tree["joints"]["guide"]["at"] = ["E", "F"]
    return da.mechanism(tree)


@pytest.mark.parametrize("sense", ["ccw", "cw"])
@pytest.mark.parametrize("offset", [0.02, -0.045])
def test_an_eccentric_disc_lifts_a_roller_beside_its_axis(offset: float, sense: str) -> None:
    """y = e sin q + sqrt((R + r)^2 - (offset - e cos q)^2), at one turn as at many."""
    c = da.cam(disc_aside(offset, sense), "F")
    way = 1 if sense == "ccw" else -1

    def height(q: Any) -> Any:
        return way * 0.012 * np.sin(q) + np.sqrt(0.058**2 - (offset - 0.012 * np.cos(q)) ** 2)

    q = np.linspace(0, 2 * np.pi, 7)
    least = float(height(np.linspace(0, 2 * np.pi, 100_001)).min())
    assert c.lift(q)[0] == pytest.approx(height(q) - least, abs=1e-9)
    assert [float(c.lift(x)[0]) for x in q] == pytest.approx((height(q) - least).tolist(), abs=1e-9)


@pytest.mark.parametrize("offset", [0.047, -0.08])
def test_a_roller_that_misses_the_disc_over_a_part_of_a_turn_is_refused(offset: float) -> None:
    """From R + r - e = 46 mm on."""
    with pytest.raises(ModelError) as refused:
        da.cam(disc_aside(offset, "ccw"), "F").lift(0.0)
    assert str(refused.value) == "the follower does not stay on the cam over a turn; see its joints' places"


def test_friction_of_a_knife_edge_is_against_its_slip() -> None:
    """mu N along the tangent; the drive pays what is lost."""
    r = da.dynamics(da.mechanism(machine("knife", friction={"coefficient": 0.2})))
    smooth = da.dynamics(da.mechanism(machine("knife")))
    assert set(r.status) <= {"ok", "self_locking"}
    n = da.cam(smooth.mechanism, "F")
    force, normal = r.reaction("F", "stem"), np.array([n.motion.at(n.turns_of(r)).normal]).reshape(-1, 2)
    along = (force * normal).sum(axis=1)
    across = force[:, 0] * normal[:, 1] - force[:, 1] * normal[:, 0]
    assert np.abs(across) == pytest.approx(0.2 * along, rel=1e-9)
    assert (across < 0).all()  # the cam turns counter-clockwise under the edge and drags it along
    assert np.abs(r.power_balance).max() < 1e-12


def test_accelerations_that_jump_have_two_numbers() -> None:
    """Inertia forces before and behind a harmonic rise, in results, kernels and texts."""
    harmonic = [RISE[0] | {"by": "harmonic"}, *FULL[1:]]
    m = da.mechanism(machine({"roller": "8 mm"}, harmonic))
    r = da.dynamics(m)
    at = [k for k, s in enumerate(r.status) if s == "jump"]
    assert at == [0, 9]
    assert r.after is not None
    bend = 0.02 / 2 * (math.pi / (math.pi / 2)) ** 2 * 400
    jump = [side.freedom("guide", "slide")[2][at] for side in r.sides]
    assert np.array(jump) == pytest.approx(np.array([[0, -bend], [bend, 0]]), abs=1e-9)
    assert "jumps at O = 90 deg" in str(r.reasons[9])
    k = da.compile(m, ["links.stem.mass"], ["reaction.F"])
    answer = k([[0.5]])
    assert answer.status[0][9] == "jump"
    for side, both in zip(r.sides, answer.both_sides("reaction.F"), strict=True):
        assert both[0] == pytest.approx(side.reaction("F"), abs=1e-9 * 300)
    assert set(da.statics(m).status) == {"ok"}
    assert "Jump of the acceleration in F at 0 deg, 90 deg" in r.text()


@pytest.mark.long
def test_a_groove_pushes_with_one_wall_and_conjugate_discs_with_both() -> None:
    """m s'' w^2 / cos(phi) changes its sign half-way; both discs differ by it while their preload keeps them on."""
    tree = machine({"roller": "8 mm"})
    tree["joints"]["F"]["contact"] = "holds"
    tree.pop("loads")
    groove = da.dynamics(da.mechanism(tree)).contact("F")
    assert groove.walls is not None
    assert groove.walls[0] - groove.walls[1] == pytest.approx(groove.force)
    assert groove.walls.min(axis=0) == pytest.approx(0)
    assert groove.changes is not None
    assert math.degrees(groove.changes[0]) == pytest.approx(45, abs=1e-7)
    largest = float(np.abs(groove.force).max())
    for part, off in ((0.3, True), (0.49, True), (0.51, False)):
        tree["joints"]["F"]["preload"] = part * largest
        r = da.dynamics(da.mechanism(tree))
        pair = r.contact("F")
        assert pair.walls is not None
        assert pair.changes is not None
        assert pair.walls[0] - pair.walls[1] == pytest.approx(pair.force)
        on = pair.walls.min(axis=0) > 0
        assert pair.walls.sum(axis=0)[on] == pytest.approx(2 * part * largest)
        assert pair.walls.min() >= 0
        assert bool(pair.changes.size) == (not on.all()) == off
        assert ("A disc of F comes off or on near O = " in r.text()) == off
    tree["joints"]["F"]["contact"] = "pushes"
    with pytest.raises(
        da.ModelError, match="preload of joint 'F': a preload is that of two rollers on conjugate"
    ):
        da.mechanism(tree)


def test_a_copied_cam_is_the_cam_of_the_copied_machine() -> None:
    """Turned by 40 deg, and in the mirror; arcs in the mirror are refused."""
    tree = machine({"roller": "8 mm"}) | {
        "copies": [{"of": ["cam", "stem"], "phase": {"ground": 40}, "count": 2}]
    }
    r = da.dynamics(da.mechanism(tree))
    assert r.effort("O_2") == pytest.approx(r.effort("O"), abs=1e-9)
    tree["copies"] = [{"of": ["cam", "stem"], "mirror": {"ground": 25}}]
    r = da.dynamics(da.mechanism(tree))
    assert r.effort(r.drives[1]) == pytest.approx(-r.effort("O"), abs=1e-9)
    tree["joints"]["F"]["profile"] = {
        "points": {"angle": [0, 90, 180, 270], "radius": [0.05, 0.06, 0.05, 0.05]}
    }
    with pytest.raises(ModelError, match="the arcs or points of a cam are not mirrored; write that cam out"):
        da.mechanism(tree)
    tree["copies"] = [{"of": ["stem"], "phase": {"ground": 40}, "count": 2}]
    with pytest.raises(
        ModelError, match="cam 'F' is copied without its cam; copy both links, or write the joint out"
    ):
        da.mechanism(tree)


@pytest.mark.long
def test_a_cam_is_drawn_to_scale() -> None:
    """Outline, roller, normal force and pressure angle."""
    m = da.mechanism(machine({"roller": "8 mm"}))
    r, c = da.dynamics(m), da.cam(m, "F")
    scene = da.draw.mechanism(r, at=10)
    per_mm = scene.scales["length"]
    (outline,) = (i for i in scene.items if isinstance(i, Polygon) and i.role == "link-area")
    rollers = [i for i in scene.items if isinstance(i, Circle) and i.role == "block"]
    assert [i.radius * per_mm for i in rollers] == pytest.approx([0.008])
    near = min(math.dist(rollers[0].center, p) for p in outline.points) * per_mm
    assert near == pytest.approx(0.008, abs=2e-4)
    shown = c.drawings()[0]
    (arrow,) = (i for i in shown.items if isinstance(i, Arrow))
    assert arrow.length * shown.scales["force"] == pytest.approx(arrow.value)
    assert len(c.drawings()) == 8
    assert "pressure angle, rising" in c.text()


def test_sizes_of_a_cam_that_a_kernel_can_vary() -> None:
    m = da.disc_cam(positions=3)
    k = da.compile(m, vary=["joints.F.profile.base"], outputs=["effort.O"])
    larger = m.with_values({"joints.F.profile.base": 0.05})
    assert k([[0.05]]).effort("O")[0] == pytest.approx(da.dynamics(larger).effort("O"), rel=1e-9)
    text = da.loads(template_text("disc_cam"))
    with pytest.raises(ModelError) as caught:
        da.compile(text, vary=["rise"])
    assert "the curve of cam 'F' is computed from 'joints.F.profile.segments" in str(caught.value)
    assert "vary its base or its roller, or solve each design by da.sweep" in str(caught.value)


@crossed(
    "face, profile",
    [None, "8 deg", "190 deg"],
    [{"eccentric": "12 mm", "radius": "40 mm"}, {"base": "40 mm", "segments": FULL}],
)
def test_the_direction_of_a_guide_varies_in_a_kernel_and_on_a_page(face: str | None, profile: Any) -> None:
    load = {"P": {"type": "force", "on": "stem", "at": "F", "value": [0, -300]}}
    tree = sliding("flat", profile, drive=dict(TURN), stem={"mass": 0.5}, loads=load)
    tree["joints"]["F"] |= {"face": face} if face else {}
    m = da.mechanism(tree)
    kernel = da.compile(m, "joints.guide.direction", "effort.O")
    y = kernel([[1.5], [1.6]])
    for k, angle in enumerate((1.5, 1.6)):
        r = da.dynamics(m.with_values({"joints.guide.direction": angle}), method="careful")
        assert set(r.status) == {"ok"}
        assert y["effort.O"][k] == pytest.approx(r.effort("O"), rel=1e-9, abs=1e-12)
    assert "joints.guide.direction" in {one["path"] for one in page_data(m)["numbers"]}


def test_points_of_a_whole_turn_begin_and_end_with_one_radius() -> None:
    """Equal but for rounding, as a file has them: the curve is that of the first."""
    angle = np.linspace(0, 2 * np.pi, 13)
    radius = 0.03 + 0.01 * (1 - np.cos(angle))
    whole = CamPoints(tuple(angle), (*radius[:-1], radius[0] * (1 + 1e-10)))
    for p in (whole, CamPoints(tuple(angle[:-1]), tuple(radius[:-1]))):
        breaks, c = _spline(p)
        assert breaks == pytest.approx(angle)
        assert c[3] == pytest.approx(radius[:-1])
        last = np.polyval(c[:, -1], breaks[-1] - breaks[-2])
        assert last == pytest.approx(radius[0], abs=1e-15)


def test_walls_change_between_the_positions_of_a_law_where_those_of_a_speed_do() -> None:
    found = []
    for turn in (
        TURN,
        {"law": {"segments": [{"to": "350 deg", "in": "0.3 s", "by": "constant_speed"}], "count": 36}},
    ):
        tree = machine({"roller": "8 mm"})
        tree["joints"]["F"]["contact"] = "holds"
        tree["drives"]["O"] = turn
        tree.pop("loads")
        r = da.dynamics(da.mechanism(tree))
        found.append(r.contact("F").changes)
    assert r.schedule.time is not None
    assert found[0].size
    assert found[1] == pytest.approx(found[0], abs=1e-7)
