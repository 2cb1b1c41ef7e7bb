"""Laws of force systems on random ones, to 1e-12 of the largest force (times the largest arm)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import AnalysisError, ModelError
from dalembert.wrench import (
    Axis,
    Couple,
    Force,
    System,
    arrangement,
    components,
    concurrency,
    parallel_center,
)
from tests.wrench.random_systems import (
    DIMENSIONS,
    SEEDS,
    moment_by_terms,
    point,
    random_system,
    rotation,
    scales,
    turned,
)

EXACT = 1e-12
both = pytest.mark.parametrize("d", DIMENSIONS)
each = pytest.mark.parametrize("seed", SEEDS)


def close(a: Any, b: Any, scale: float, tolerance: float = EXACT) -> bool:
    return float(np.abs(np.asarray(a) - np.asarray(b)).max()) <= tolerance * scale


@both
@each
def test_moments_are_the_terms_summed(seed: int, d: int) -> None:
    s, at = random_system(seed, d), point(seed, d)
    assert close(s.moment(at), moment_by_terms(s, at), scales(s, at)[1])


@both
@each
def test_the_moment_of_the_whole_is_the_sum_of_the_parts(seed: int, d: int) -> None:
    s, at = random_system(seed, d), point(seed, d)
    parts = sum(np.asarray(f.moment(at)) for f in s.forces) + sum(np.asarray(c.moment) for c in s.couples)
    assert close(s.moment(at), parts, scales(s, at)[1])


@both
@each
def test_varignon(seed: int, d: int) -> None:
    """Forces through one point: the moment of their resultant there is the sum of theirs."""
    s, at, about = random_system(seed, d), point(seed, d), point(seed + 1, d)
    meeting = System(*(Force(f.vector, at) for f in s.forces))
    assert close(meeting.moment(about), Force(s.resultant, at).moment(about), scales(meeting, about)[1])


@both
@each
def test_reduction_anywhere_and_back(seed: int, d: int) -> None:
    s, a, b = random_system(seed, d), point(seed, d), point(seed + 1, d)
    there = s.reduced(a)
    scale = scales(s, b)[1] + scales(s, a)[1]
    assert close(there.moved(b).couple, s.moment(b), scale)
    assert close(there.moved(b).moved(a).couple, there.couple, scale)
    assert close(System(*there.parts).moment(b), s.moment(b), scale)


@each
def test_force_times_moment_does_not_depend_on_the_point(seed: int) -> None:
    s = random_system(seed, 3)
    values = [float(s.resultant @ s.moment(point(seed + k, 3))) for k in range(5)]
    assert close(
        values, values[0], float(np.linalg.norm(s.resultant)) * scales(s, point(seed, 3, 9.0))[1], 1e-11
    )


@each
def test_a_couple_is_free(seed: int) -> None:
    """A force and its opposite: the same moment about every point, that of `Couple.of_forces`."""
    for d in DIMENSIONS:
        f = random_system(seed, d).forces[0]
        other = point(seed, d)
        pair = System(f, Force(-f.vector, other))
        couple = Couple.of_forces(f, other)
        scale = scales(pair, point(seed + 1, d))[1]
        assert close(pair.moment(point(seed + 1, d)), couple.moment, scale)
        assert pair.kind() == "couple"


@both
@each
def test_a_force_slides_along_its_line(seed: int, d: int) -> None:
    s, about = random_system(seed, d), point(seed, d)
    slid = System(*(Force(f.vector, f.at + 2.0 * f.cosines) for f in s.forces), *s.couples)
    assert close(slid.moment(about), s.moment(about), scales(slid, about)[1])
    f, found = s.forces[0], np.linalg.norm(np.atleast_1d(s.forces[0].moment(about)))
    assert found == pytest.approx(f.size * f.arm(about), rel=1e-9)


@each
def test_the_moment_about_an_axis(seed: int) -> None:
    """The same at any point of the axis, the other sign the other way round, none for forces that meet it."""
    s, a, b = random_system(seed, 3), point(seed, 3), point(seed + 1, 3)
    axis, scale = Axis.through(a, b), scales(s, a)[1] + scales(s, b)[1]
    assert close(s.moment(axis), float(s.moment(b) @ axis.direction), scale)
    assert close(s.moment(Axis.through(b, a)), -s.moment(axis), scale)
    meets = Force.along(3.0, point(seed + 2, 3), a + 0.3 * (b - a))
    assert close(meets.moment(axis), 0.0, 3.0 * 30.0)


@each
def test_the_central_axis_has_the_least_moment(seed: int) -> None:
    """Found independently: |M_O - p x R| is least over p, a linear least-squares problem."""
    s = random_system(seed, 3)
    found, (rx, ry, rz) = s.central_axis(), s.resultant
    crossing = np.array([[0, rz, -ry], [-rz, 0, rx], [ry, -rx, 0]])  # p x R
    p = np.linalg.lstsq(crossing, s.moment([0, 0, 0]), rcond=None)[0]
    least = s.moment(p)
    scale = scales(s, found.axis.point)[1]
    assert close(np.linalg.norm(least), abs(found.moment), scale, 1e-10)
    assert found.axis.distance(p) <= 1e-10 * max(1.0, float(np.linalg.norm(p)))
    on_axis = s.moment(found.axis.point)
    assert close(np.cross(on_axis, found.axis.direction), 0.0, scale, 1e-10)
    assert close(on_axis @ found.axis.direction, found.moment, scale, 1e-10)
    assert found.pitch == pytest.approx(found.moment / float(np.linalg.norm(s.resultant)))
    assert s.kind() == "wrench"


@each
def test_in_the_plane_the_central_axis_is_the_line_of_the_resultant(seed: int) -> None:
    s = random_system(seed, 2)
    found = s.central_axis()
    alone, about = System(Force(s.resultant, found.axis.point)), point(seed, 2)
    assert close(alone.moment(about), s.moment(about), scales(s, about)[1] + scales(alone, about)[1])
    assert (found.moment, found.pitch, s.kind()) == (0.0, 0.0, "single force")


@each
def test_plane_equals_space_in_the_plane(seed: int) -> None:
    flat, about = random_system(seed, 2), point(seed, 2)
    spatial = System(
        *(Force([*f.vector, 0], [*f.at, 0]) for f in flat.forces),
        *(Couple([0, 0, c.moment]) for c in flat.couples),
    )
    assert close(spatial.moment([*about, 0]), [0, 0, flat.moment(about)], scales(flat, about)[1])
    assert spatial.kind() == flat.kind()
    assert close(spatial.central_axis().axis.point[:2], flat.central_axis().axis.point, 1.0)
    assert spatial.equilibrium().residual == pytest.approx(flat.equilibrium().residual, rel=1e-12)


@both
@each
def test_turning_the_whole_turns_the_answers(seed: int, d: int) -> None:
    s, about, shift = random_system(seed, d), point(seed, d), point(seed + 1, d)
    angle = 0.7 + seed
    plane = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    turn = plane if d == 2 else rotation(seed)
    other = turned(s, turn, shift)
    scale = scales(s, about)[1]
    assert close(other.resultant, turn @ s.resultant, scales(s, about)[0])
    before, after = np.atleast_1d(s.moment(about)), np.atleast_1d(other.moment(turn @ about + shift))
    assert close(after, before if d == 2 else turn @ before, scale)
    assert close(other.central_axis().moment, s.central_axis().moment, scale, 1e-11)
    assert other.central_axis().axis.distance(turn @ s.central_axis().axis.point + shift) < 1e-9
    assert other.kind() == s.kind()


@both
@each
def test_units_change_no_judgement(seed: int, d: int) -> None:
    """Any unit of force and of length: the same system, the same kind, the same residual."""
    s, small = random_system(seed, d), random_system(seed, d, 1e-150, 1e3)
    assert small.kind() == s.kind()
    assert arrangement(small) == arrangement(s)
    assert small.equilibrium().residual == pytest.approx(s.equilibrium().residual, rel=1e-9)
    whole, tiny = s + System(*s.equilibrant()), small + System(*small.equilibrant())
    assert (whole.kind(), tiny.kind()) == ("zero", "zero")


@both
@each
def test_the_equilibrant_makes_equilibrium(seed: int, d: int) -> None:
    s = random_system(seed, d)
    assert not s.equilibrium().holds
    balanced = s + System(*s.equilibrant())
    found = balanced.equilibrium()
    assert found.holds
    assert found.residual <= 1e-11
    assert found.missing == ()
    assert (s + -s).equilibrium().holds
    pure = s + Force(-s.resultant, point(seed, d))
    assert pure.kind() == "couple"
    assert pure.equilibrium().sentence.startswith(
        "Not in equilibrium: the forces balance, the moments do not."
    )
    with pytest.raises(AnalysisError, match="a central axis does not exist: the system is a couple"):
        pure.central_axis()


@both
@each
def test_far_from_the_origin_nothing_changes(seed: int, d: int) -> None:
    s = random_system(seed, d)
    away = System(*(Force(f.vector, f.at + 1e6) for f in s.forces), *s.couples)
    assert (away + System(*away.equilibrant())).equilibrium().residual < 1e-9
    assert away.kind() == s.kind()
    assert close(away.central_axis().axis.point - 1e6, s.central_axis().axis.point, 10.0, 1e-8)


@both
@each
def test_the_centre_of_parallel_forces_stays_when_they_turn(seed: int, d: int) -> None:
    rng = np.random.default_rng([seed, d, 3])
    sizes, places = rng.uniform(0.5, 2.0, 5) * [1, 1, 1, -1, 1], rng.normal(size=(5, d))
    centers, weights = [], sizes / sizes.sum()
    for _ in range(2):
        along = rng.normal(size=d)
        s = System(*(Force(f * along, at) for f, at in zip(sizes, places, strict=True)))
        assert arrangement(s) == "parallel"
        assert s.kind() == "single force"
        centers.append(parallel_center(s))
        assert s.central_axis().axis.distance(centers[-1]) < 1e-10
    assert close(centers[0], centers[1], 10.0)
    assert close(centers[0], weights @ places, 10.0)


@both
@each
def test_lines_that_meet(seed: int, d: int) -> None:
    s, meeting = random_system(seed, d), point(seed, d)
    through = System(*(Force(f.vector, meeting + 1.5 * f.vector) for f in s.forces))
    found = concurrency(through)
    assert found is not None
    assert close(found, meeting, 10.0, 1e-11)
    assert arrangement(through) == "concurrent"
    assert through.kind() == "single force"
    if len(s.forces) > 2 or d == 3:
        assert concurrency(s) is None
        assert arrangement(s) == "general"


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
@pytest.mark.parametrize(("part", "meet"), [(1e-11, True), (1e-7, False)])
def test_what_is_nothing_is_told_by_the_size_of_the_system(size: float, part: float, meet: bool) -> None:
    """Lines through one point, on one line or in one plane, of which one is off by a part of the system's length;
    forces that add to nothing but for a part of the largest. What has no size does not count."""
    off = np.array([0.0, part])
    none = Force([0, 0], size * off)
    two = [Force([0, -2], [size, 0]), Force([2, 0], [0, size])]
    through = System(none, *two, Force([1, 1], size * (off - 1)))
    assert (concurrency(through) is not None) == meet
    assert arrangement(through) == ("concurrent" if meet else "general")
    assert concurrency(System(none, two[0])) is None
    assert concurrency(System(*two)) == pytest.approx([size, size])
    along = System(
        none, Force([-1, 0], [0, 0]), Force([3, 0], -size * off - [size, 0]), Force([1, 0], [size / 9, 0])
    )
    assert arrangement(along) == ("collinear" if meet else "parallel")
    flat = [Force([*f.vector, 0], [*f.at, 0]) for f in (*two, Force([1, 1], [0, 5 * size]))]
    assert arrangement(System(*flat, Force([0, 1, 0], [0, 0, -part * size]))) == (
        "coplanar" if meet else "general"
    )
    for sign in (-size, size):
        none_left = System(none, Force([0, sign * (1 - part)], [size, 0]), Force([0, -sign], [3 * size, 0]))
        if meet:
            with pytest.raises(AnalysisError, match="add to zero"):
                parallel_center(none_left)
        else:
            assert parallel_center(none_left)[0] == pytest.approx(size * (2 + part) / part)


def test_lines_that_meet_far_away_meet_by_a_part_of_how_far() -> None:
    for off, meet in ((1e-7, True), (1e-4, False)):
        nearly = System(Force([1, 0]), Force([1000, -1], at=[0, 1]), Force([1000, 1], at=[0, off - 1]))
        assert (concurrency(nearly) is not None) == meet


def test_a_system_seen_in_a_mirror_is_of_the_same_arrangement() -> None:
    """However little the forces are off one plane; most of them lie on one side of their middle."""
    places = [(-10.0, 0.0), *((1.0 + 0.1 * k, 0.3 * k * k) for k in range(5))]
    found = []
    for off in np.logspace(-13, -6, 29):
        both = [
            System(*(
                Force([1, k * k - 3, 0], [sign * x, sign * y, off * (k == 2)]) for k, (x, y) in enumerate(places)
            ))
            for sign in (1, -1)
        ]  # fmt: skip
        assert arrangement(both[0]) == arrangement(both[1])
        found.append(arrangement(both[0]))
    assert list(dict.fromkeys(found)) == ["coplanar", "general"]


@each
def test_arrangements(seed: int) -> None:
    turn, shift = rotation(seed), point(seed, 3)
    flat = random_system(seed, 2)
    lifted = System(*(Force([*f.vector, 0], [*f.at, 0]) for f in flat.forces), Force([1, 2, 0], [9, 8, 0]))
    assert arrangement(turned(lifted, turn, shift)) == "coplanar"
    line = System(*(Force(k * shift, k * shift) for k in (1.0, 2.0, -0.5)))
    assert arrangement(line) == "collinear"
    assert arrangement(System(Couple(1.0))) == "no forces"


@both
@each
def test_components_on_oblique_axes_add_to_the_force(seed: int, d: int) -> None:
    f = random_system(seed, d).forces[0]
    axes = np.random.default_rng([seed, 5]).normal(size=(d, d))
    unit = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    found = components(f.vector, *axes)
    assert close(found @ unit, f.vector, float(np.abs(found).max()))
    square = np.linalg.qr(axes)[0]
    assert close(f.components(*square), [f.projection(e) for e in square], f.size)
    assert close(f.components(f.vector), [f.size], f.size)


@each
def test_every_way_to_write_a_force_is_the_same_force(seed: int) -> None:
    f = random_system(seed, 3).forces[0]
    again = [
        Force.directed(f.size, f.vector, f.at),
        Force.along(f.size, f.at, f.at + f.vector),
        Force.by_angles(f.size, [float(a) for a in f.angles], f.at),
        Force.by_elevation(
            f.size, math.atan2(f.vector[1], f.vector[0]), math.asin(f.vector[2] / f.size), f.at
        ),
    ]
    for one in again:
        assert close(one.vector, f.vector, f.size)
        assert close(one.at, f.at, 10.0)
    flat = random_system(seed, 2).forces[0]
    assert close(Force.directed(flat.size, flat.angle).vector, flat.vector, flat.size)
    assert close(Force(f"{flat.size!r} @ {math.degrees(flat.angle)!r}").vector, flat.vector, flat.size)


@each
def test_a_line_meets_a_plane_in_it(seed: int) -> None:
    """The coordinate asked for is that one to the last bit, the others lie on the line."""
    rng = np.random.default_rng(seed)
    axis = Axis(rng.normal(size=3), rng.normal(size=3))
    for k, name in enumerate("xyz"):
        wanted = float(rng.normal())
        place = axis.crossing(**{name: wanted})
        assert place[k] == wanted
        assert axis.distance(place) == pytest.approx(0.0, abs=1e-9)


def test_what_zero_is_judged_against() -> None:
    """The largest force, or the largest couple over the length, whichever is more, and that over the length."""
    box = [Force([3, 0], at=[0, 0]), Force([0, 4], at=[3, 4])]
    assert System(*box).length == 5.0
    assert System(*box).scales() == (4.0, 20.0)
    assert System(*box, Couple(50), Couple(-60)).scales() == (12.0, 60.0)
    assert System(*box, Couple(50), Couple(-60)).scales(length=100) == (4.0, 400.0)
    assert System(Force([3, 0], at=[1, 1]), Couple(5), Couple(-7)).scales() == (3.0, 7.0)


@pytest.mark.parametrize("part", [1e-10, 1e-8])
def test_what_is_nothing_unless_it_is_said(part: float) -> None:
    """A part of 1e-9 of the largest force, or moment."""
    pair = [
        Force([3, 0], at=[0, 1]),
        Force([-3, 0], at=[0, 1]),
        Force([0, 1], at=[0, 0]),
        Force([0, -1], at=[0, 0]),
    ]
    for odd in (Force([0, 3 * part], at=[0, 0]), Couple(3 * part)):
        s = System(*pair, odd)
        assert s.equilibrium().holds == (part < 1e-9)
        assert (s.kind() == "zero") == (part < 1e-9)


def test_answers_cannot_be_changed_by_accident() -> None:
    s = System(Force([3, 0], at=[0, 1]))
    for answer in (s.resultant, s.point([1, 2]), s.forces[0].vector):
        with pytest.raises(ValueError, match="read-only"):
            answer[0] = 1.0


def test_in_the_plane_a_line_meets_no_z() -> None:
    with pytest.raises(ModelError, match="a line is cut at one of x, y; write for example"):
        Axis([0, 1], [1, 1]).crossing(z=1)


def test_a_force_out_of_the_plane_of_its_axes() -> None:
    """However small or large the force: what is left counts beside it."""
    axes = ([1, 0, 0], [1, 1, 0])
    for size in (1e-6, 1.0, 1e6):
        assert components([size, 2 * size, 0], *axes) == pytest.approx([-size, 2 * size * math.sqrt(2)])
        assert len(components([size, 2 * size, 1e-12 * size], *axes)) == 2
        with pytest.raises(ModelError, match="the force does not lie in the axes' plane"):
            components([size, 2 * size, 1e-3 * size], *axes)
