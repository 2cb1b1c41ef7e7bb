"""Templates: they load, are the same as their files, go through their whole range, and refuse bad dimensions."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from math import atan2, cos, pi, radians, sqrt
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis import solve, statics
from dalembert.core.position import motion_path
from dalembert.errors import ModelError
from dalembert.model import Mechanism, loads
from dalembert.model.library import (
    TEMPLATES,
    bennett,
    bevel_differential,
    bucket,
    crank_shaper,
    double_cardan,
    five_bar,
    four_bar,
    hooke_joint,
    inverted_slider_crank,
    rotating_shaft,
    rssp,
    rssr,
    scissor,
    slider_crank,
    spherical_four_bar,
    stephenson_2,
    template,
    template_text,
    toggle_press,
    watt_1,
    whitworth,
)
from dalembert.model.library.from_files import template_function
from tests.tiers import crossed

NAMES = list(TEMPLATES)
ROUGH = radians(1.0)
"""The files give rounded angles in `assembly`."""


def numbers(tree: Any, path: str = "") -> dict[str, Any]:
    """Path -> leaf of a tree."""
    if isinstance(tree, dict):
        return {k: v for key, item in tree.items() for k, v in numbers(item, f"{path}.{key}").items()}
    if isinstance(tree, (list, tuple)):
        return {k: v for i, item in enumerate(tree) for k, v in numbers(item, f"{path}.{i}").items()}
    return {path: tree}


def physics(m: Mechanism) -> dict[str, Any]:
    """What a mechanism says in SI, without its assembly and its units."""
    dump = m.model_dump()
    return numbers({key: dump[key] for key in ("title", "links", "joints", "drives", "loads")})


@pytest.mark.parametrize("name", NAMES)
def test_the_file_says_the_same_as_the_function(name: str) -> None:
    built, read = template(name), loads(template_text(name))
    ours, files = physics(built), physics(read)
    assert ours.keys() == files.keys()
    for path, value in ours.items():
        expected = (
            pytest.approx(value, rel=1e-9, abs=1e-15, nan_ok=True) if isinstance(value, float) else value
        )
        assert files[path] == expected, path
    assert read.gravity_vector == pytest.approx(built.gravity_vector)
    assert read.assembly.keys() == built.assembly.keys()
    for link, angle in built.assembly.items():
        assert read.assembly[link] == pytest.approx(angle, abs=ROUGH)


COUNTS = ("faces", "teeth")


@pytest.mark.parametrize("name", [name for name in NAMES if loads(template_text(name)).parameters])
def test_a_dimension_of_the_function_is_the_parameter_of_the_file(name: str) -> None:
    rng = np.random.default_rng(5)
    read = loads(template_text(name))
    signature = inspect.signature(TEMPLATES[name].function).parameters
    sizes = {
        key: f"{parameter.in_unit() * (1 + 0.02 * rng.random() * (key not in COUNTS)):.4g} {parameter.unit}"
        for key, parameter in read.parameters.items()
        if key in signature
    }
    ours, files = physics(TEMPLATES[name].function(**sizes)), physics(read.with_values(sizes))
    assert len(sizes) > 3
    assert ours.keys() == files.keys()
    for path, value in ours.items():
        expected = (
            pytest.approx(value, rel=1e-9, abs=1e-13, nan_ok=True) if isinstance(value, float) else value
        )
        assert files[path] == expected, path


@crossed("name, text", NAMES, [False, True])
def test_every_position_is_solved_and_the_motion_is_one(name: str, text: bool) -> None:
    """No position jumps into another assembly: links turn little from one position to the next, and come back."""
    m = loads(template_text(name)) if text else template(name)
    result = solve(m)
    assert set(result.status) == {"ok"}
    assert len(result.status) > 30
    assert np.nanmax(result.residual) < 1e-12
    assert np.nanmax(result.power_balance) < 1e-12
    assert result.mobility is not None
    assert result.mobility.freedoms == len(m.drives)
    assert result.mobility.redundant == 0
    for link in result.links:
        turn = np.swapaxes(result.rotation(link)[:-1], -1, -2) @ result.rotation(link)[1:]
        cosine = (np.trace(turn, axis1=-2, axis2=-1) - (m.dimension == 3)) / 2
        assert np.min(cosine) > cos(radians(25)), link


@pytest.mark.parametrize("name", NAMES)
def test_docstring_explains_every_dimension(name: str) -> None:
    function = TEMPLATES[name].function
    text = inspect.getdoc(function) or ""
    shared = {"positions", "mass_per_length", "mass_per_area"}
    for dimension in inspect.signature(function).parameters:
        words = dimension.replace("_mass", "")
        assert dimension in shared or f"`{dimension}`" in text or words in text, f"{name}: {dimension}"


def test_text_of_a_template_has_comments_and_stays_narrow() -> None:
    for name in NAMES:
        lines = template_text(name).splitlines()
        assert sum(line.lstrip().startswith("#") for line in lines) > 6
        assert max(map(len, lines)) <= 120


# dimensions that are asked for


def test_quick_return_has_its_time_ratio() -> None:
    """Crank 90 on ground 180: 240 degrees to work, 120 back; the stroke is 2 lever crank / ground."""
    r = solve(crank_shaper(positions=360))
    x = r.center("ram")[:, 0]
    assert x.max() - x.min() == pytest.approx(2 * 0.36 * 0.5, rel=1e-9)
    assert (np.argmax(x) - np.argmin(x)) % 360 == 120


def test_whitworth_has_its_time_ratio() -> None:
    r = solve(whitworth(positions=360))
    x = r.center("ram")[:, 0]
    assert x.max() - x.min() == pytest.approx(2 * 0.09, rel=1e-9)
    assert (np.argmax(x) - np.argmin(x)) % 360 == 240


def test_inverted_slider_crank_with_long_crank_turns_its_arm_right_round() -> None:
    r = solve(inverted_slider_crank(ground=0.06, crank=0.12, rocker=0.2, offset=0.03))
    assert set(r.status) == {"ok"}
    turns = np.unwrap(r.angle("rocker"))
    assert turns[-1] - turns[0] > 1.8 * pi


def test_offset_slider_crank_has_a_quick_return() -> None:
    r = solve(slider_crank(offset=0.03, positions=720))
    x = r.center("piston")[:, 0]
    assert x.max() - x.min() == pytest.approx(sqrt(0.3**2 - 0.03**2) - sqrt(0.18**2 - 0.03**2), rel=1e-4)


def test_a_rocker_can_be_swept_where_no_crank_goes_round() -> None:
    m = four_bar(
        ground=0.3, crank=0.2, coupler=0.2, rocker=0.2, sweep=(radians(30), radians(80)), positions=11
    )
    assert set(solve(m).status) == {"ok"}


def test_parallelogram_passes_its_change_points() -> None:
    r = solve(four_bar(ground=0.3, crank=0.1, coupler=0.3, rocker=0.1, positions=36))
    assert [k for k, status in enumerate(r.status) if status != "ok"] == [0, 18]
    assert {r.status[0], r.status[18]} == {"singular"}
    assert r.angle("coupler")[r.ok] == pytest.approx(0.0, abs=1e-9)


def test_five_bar_with_opposite_cranks_moves_on_the_line_of_symmetry() -> None:
    r = solve(five_bar(second_sweep=(pi, -pi)))
    assert r.point("coupler", "C")[:, 0] == pytest.approx(0.12, abs=1e-9)


@pytest.mark.parametrize("stages", [1, 2, 5])
@pytest.mark.parametrize("drive", ["slide", "turn"])
def test_scissor_is_lifted_by_its_formula(stages: int, drive: str) -> None:
    m = scissor(stages, drive=drive)
    r = solve(m)
    assert set(r.status) == {"ok"}
    alpha = r.angle("left_1")
    lifted = stages * (2000 + 60 * m.g) + stages**2 * 6 * m.g
    force = -lifted / np.tan(alpha)
    exact = force if drive == "slide" else -force * 1.2 * np.sin(alpha)
    assert r.effort("base_roller" if drive == "slide" else "base_pin") == pytest.approx(exact, rel=1e-10)
    assert r.position("platform")[:, 1] == pytest.approx(stages * 1.2 * np.sin(alpha), rel=1e-12)


def test_a_long_chain_takes_no_more_stations_than_a_short_one(monkeypatch: pytest.MonkeyPatch) -> None:
    march, stations = motion_path.march, []

    def counted(*given: Any) -> motion_path.March:
        stations.append(march(*given))
        return stations[-1]

    monkeypatch.setattr(motion_path, "march", counted)
    for stages in (5, 60):
        assert set(statics(scissor(stages, positions=7), method="careful").status) == {"ok"}
    short, long = (len(m.s) for m in stations)
    assert long <= short


@pytest.mark.exhaustive
def test_scissor_of_four_hundred_stages() -> None:
    m = scissor(400, positions=2)
    r = solve(m)
    assert set(r.status) == {"ok"}
    assert r.mobility is not None
    assert (r.mobility.freedoms, r.mobility.redundant) == (1, 0)
    alpha = np.array([atan2(0.336, 1.152), atan2(0.96, 0.72)])
    assert r.effort("base_roller") == pytest.approx(
        -(400 * (2000 + 60 * m.g) + 400**2 * 6 * m.g) / np.tan(alpha), rel=1e-9
    )


def test_bucket_closes_clockwise_against_the_digging_force() -> None:
    r = solve(bucket())
    assert np.all(np.diff(np.unwrap(r.angle("bucket"))) < 0)
    assert np.all(r.effort("cylinder") > 0)


def test_toggle_press_comes_near_to_straight_and_not_through() -> None:
    r = solve(toggle_press())
    lean = r.angle("upper") + pi / 2
    assert 0 < lean.min() < radians(5)
    assert lean.max() > radians(20)


# in space


def test_hooke_joint_turns_by_its_formula() -> None:
    r = solve(hooke_joint(angle=35.0))
    turn, slant = r.drive_position("I"), radians(35)
    expected = 10 * pi * cos(slant) / (1 - (np.sin(slant) * np.sin(turn)) ** 2)
    assert np.linalg.norm(r.speed("output"), axis=-1) == pytest.approx(expected, rel=1e-12)


def test_double_cardan_turns_evenly() -> None:
    r = solve(double_cardan())
    assert r.speed("output") == pytest.approx(np.tile([10 * pi, 0.0, 0.0], (72, 1)), abs=1e-9)


def test_differential_shares_the_torque_and_halves_the_sum() -> None:
    r = solve(bevel_differential())
    assert r.effort("left") == pytest.approx(-20.0)
    assert r.effort("right") == pytest.approx(-20.0)
    assert r.speed("carrier")[:, 2] == pytest.approx(20.0 * (1 + 1.2) / 2)


def test_rotating_shaft_pulls_at_its_bearings_by_the_rule() -> None:
    r = solve(rotating_shaft())
    spots = [(0.3, 0.05, 0.0, 0.2), (0.2, 0.08, 120.0, 0.45)]
    turn = r.drive_position("A")
    for bearing, share in (("A", lambda z: 1 - z / 0.6), ("B", lambda z: z / 0.6)):
        parts = [(m * rad * (100 * pi) ** 2 * share(z), turn + radians(angle)) for m, rad, angle, z in spots]
        expected = -np.stack(
            [sum(f * np.cos(at) for f, at in parts), sum(f * np.sin(at) for f, at in parts)], -1
        )
        assert r.reaction(bearing)[:, :2] == pytest.approx(expected, abs=1e-8)
    assert r.effort("A") == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("build", [bennett, spherical_four_bar])
def test_four_revolutes_move_as_the_determinate_loop(build: Callable[..., Mechanism]) -> None:
    r, four = solve(build()), solve(build(determinate=False))
    assert set(four.status) == {"redundant"}
    assert four.mobility is not None
    assert (four.mobility.freedoms, four.mobility.redundant) == (1, 3)
    for link in r.links:
        assert four.rotation(link) == pytest.approx(r.rotation(link), abs=1e-10)


# dimensions that do not go


BAD: list[tuple[Callable[[], Mechanism], str]] = [
    (
        lambda: four_bar(crank=-0.1),
        "four_bar: crank is -0.1 m, and must be greater than 0; give crank a finite value in m",
    ),
    (
        lambda: four_bar(rocker=float("nan")),
        "four_bar: rocker is nan m, and must be greater than 0; give rocker a finite value in m",
    ),
    (
        lambda: four_bar(crank=0.25, coupler=0.1),
        "four_bar does not close from 0 to 27 degrees of the crank: rocker 0.24 m is 0.09 m too long for coupler "
        "0.1 m to meet it; shorten the rocker or lengthen the coupler, or give the crank a smaller range",
    ),
    (
        lambda: four_bar(crank=0.2, coupler=0.2, rocker=0.2),
        "four_bar does not close from 105 to 255 degrees of the crank: coupler 0.2 m and rocker 0.2 m are 0.1 m "
        "too short to meet; lengthen the coupler or the rocker, or give the crank a smaller range",
    ),
    (
        lambda: four_bar(crank=0.06, coupler=0.66),
        "four_bar does not close from 0 to 360 degrees of the crank: coupler 0.66 m is 0.18 m too long for rocker "
        "0.24 m to meet it; shorten the coupler or lengthen the rocker, or give the crank a smaller range",
    ),
    (
        lambda: five_bar(ground=0.12, second_sweep=(pi, 3 * pi)),
        "five_bar does not close at 0 degrees of the crank: coupler and second coupler, both 0.24 m, lie on each other "
        "and are free to turn; shorten the coupler or lengthen the second coupler, or give the crank a smaller range",
    ),
    (
        lambda: slider_crank(crank=0.1, rod=0.12, offset=0.05),
        "slider_crank does not close from 225 to 315 degrees of the crank: rod 0.12 m is 0.03 m too short to reach "
        "the line of the slide; lengthen the rod, or give the crank a smaller range",
    ),
    (
        lambda: inverted_slider_crank(ground=0.1, crank=0.1),
        "inverted_slider_crank: the crank pin passes O4 at 0 m, not farther than the slide's offset of 0 m; "
        "let ground and crank differ by more, or take a smaller offset",
    ),
    (
        lambda: inverted_slider_crank(rocker=0.2),
        "inverted_slider_crank: the block goes out to 0.33 m from O4, and the rocker ends at 0.2 m; "
        "lengthen the rocker to 0.33 m or more",
    ),
    (
        lambda: whitworth(crank=0.05),
        "whitworth: the crank 0.05 m is not longer than the ground O2 O4 0.06 m, so the arm would not go round; "
        "lengthen the crank, or take the template crank_shaper",
    ),
    (
        lambda: crank_shaper(crank=0.2, lever=0.5),
        "crank_shaper: the crank 0.2 m is not shorter than the ground O2 O4 0.18 m, so the lever would not swing to "
        "and fro; shorten the crank, or take the template whitworth",
    ),
    (
        lambda: scissor(0),
        "scissor: stages is 0; it must be an integer of at least 1; for example scissor(3)",
    ),
    (
        lambda: scissor(2, widths=(1.3, 0.7)),
        "scissor: with the roller 1.3 m from the base pin, links of 1.2 m lie flat; "
        "give widths below 1.2 m, or longer links",
    ),
    (
        lambda: scissor(2, drive="pull"),
        'scissor: drive is \'pull\'; it is "slide" (the roller) or "turn" (the base pin)',
    ),
    (
        lambda: bucket(strokes=(0.6, 1.32)),
        "bucket does not close from 0.6 to 0.786 m of the cylinder: cylinder 0.6 m and rocker 0.42 m are 0.159 m "
        "too short to meet; lengthen the cylinder or the rocker, or give the cylinder a smaller range",
    ),
    (
        lambda: watt_1(upper_coupler=0.05),
        "watt_1 does not close from 0 to 118 degrees of the crank: upper rocker 0.18 m and upper coupler 0.05 m are "
        "0.0344 m too short to meet; lengthen the upper rocker or the upper coupler, or give the crank a smaller range",
    ),
    (
        lambda: rssr(rod=0.15),
        "rssr does not close from 220 to 234 degrees of the crank; change the rod or the rocker, or give the crank a "
        "smaller range",
    ),
    (
        lambda: rssp(direction=(0.0, 0.0, 0.0)),
        "rssp: direction has no direction; give one component other than 0",
    ),
    (
        lambda: bennett(twists=(40.0, 40.0)),
        "bennett: twists 40 and 40, start 90 degrees; give two different twists and a start, all below 180 degrees",
    ),
    (
        lambda: spherical_four_bar(arcs=(30.0, 20.0, 80.0, 30.0)),
        "spherical_four_bar does not close from 0 to 360 degrees of the crank; change the angles, or give the crank a "
        "smaller range",
    ),
    (
        lambda: hooke_joint(angle=90.0),
        "hooke_joint: angle is 90 degrees; give one between 0 and 90 degrees",
    ),
    (
        lambda: stephenson_2(rocker=0.9),
        "stephenson_2 does not close from 0 to 360 degrees of the crank: rocker 0.9 m misses the point E of the plate "
        "by 0.211 m; change the rocker or the ground, or give the crank a smaller range",
    ),
    (
        lambda: stephenson_2(rocker=0.7, sweep=(pi, 3 * pi)),
        "stephenson_2 does not close from 300 to 383 degrees of the crank: rocker 0.7 m misses the point E of the "
        "plate by 0.0138 m; change the rocker or the ground, or give the crank a smaller range",
    ),
]


@pytest.mark.parametrize(("build", "message"), BAD)
def test_bad_dimensions_are_refused_with_names_numbers_and_a_remedy(
    build: Callable[[], Mechanism], message: str
) -> None:
    with pytest.raises(ModelError) as caught:
        build()
    assert str(caught.value) == message


def test_unknown_template() -> None:
    with pytest.raises(ModelError, match=r"unknown template 'fourbar'; did you mean 'four_bar'\?"):
        template("fourbar")
    with pytest.raises(ModelError, match="unknown template 'zzz'; choose among four_bar, slider_crank"):
        template_text("zzz")


def test_bennett_is_determinate_unless_it_is_asked_to_be_overconstrained() -> None:
    assert set(da.dynamics(bennett(positions=4)).status) == {"ok"}
    assert set(da.dynamics(bennett(positions=4, determinate=False)).status) == {"redundant"}


WEDGE = """A wedge is pushed under a block in a guide and lifts its load; all three faces rub.

       | load |
       |__v___|     block in its guide
       |   __/|
  ____ |__/  /
 /___________    <- wedge
 ------------- floor

Numbers are SI, angles of `sweep` radians and other angles degrees; texts carry their unit. A point or a
range (`NAME_x`, `NAME_y`; `NAME_start`, `NAME_end`) is one argument `NAME`. It is the file of
`dalembert new wedge`.

    slope: angle of the wedge (default 10 deg)
    coefficient: of friction on all three faces (default 0.18)
    mass: of load and block (default 400 kg)
    wedge_mass: of the wedge (default 0 kg)
    width: from the end of the wedge to the guide (default 100 mm)
    speed: of the wedge; negative draws it out (default 10 mm/s)
    sweep_start: first position of the wedge (default 0 mm)
    sweep_end: last one (default 100 mm)
    positions: over the range of the drive

>>> import dalembert as da
>>> da.wedge(positions=3).schedule().count
3"""


def test_a_template_of_a_file_is_a_function_of_its_parameters() -> None:
    made = template_function("wedge")
    assert (made.__name__, made.__qualname__) == ("wedge", "wedge")
    assert made.__doc__ == da.wedge.__doc__ == WEDGE
    assert (
        str(inspect.signature(made))
        == str(inspect.signature(da.wedge))
        == (
            "(*, slope='10 deg', coefficient='0.18', mass='400 kg', wedge_mass='0 kg', width='100 mm', "
            "speed='10 mm/s', sweep=('0 mm', '100 mm'), positions=41)"
        )
    )
    assert made(positions=3).schedule().count == 3


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"slop": "3 deg"}, "wedge has no dimension 'slop'; did you mean 'slope'?"),
        ({"sweep": 3}, "wedge: sweep is 3, not 2 values; give sweep as (a, b)"),
        ({"sweep": (1, 2, 3)}, "wedge: sweep is (1, 2, 3), not 2 values; give sweep as (a, b)"),
        ({"slope": None}, "wedge: slope is None, not a number; give it in deg"),
        ({"sweep": (0, None)}, "wedge: sweep_end is None, not a number; give it in m"),
        ({"coefficient": True}, "wedge: coefficient is True, not a number; give it in numbers"),
        (
            {"mass": float("inf")},
            "wedge: mass is inf kg, and must be greater than 0; give mass a finite value in kg",
        ),
        ({"slope": float("inf")}, "wedge: slope is inf; give a finite value"),
    ],
)
def test_a_wrong_dimension_of_a_template_is_named(values: Any, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        da.wedge(**values)
    assert str(caught.value) == says


@pytest.mark.parametrize(("part", "closes"), [(0.999, False), (1.001, True)])
def test_a_rod_reaches_the_line_of_its_slider_all_round(part: float, closes: bool) -> None:
    """The crank turns about z and the line is along x, 80 mm above: at a quarter turn it is hypot(60, 80) mm away."""
    sizes: dict[str, Any] = {"crank": 0.06, "rod": 0.1 * part, "guide": (0, 0, 0.08), "direction": (1, 0, 0)}
    if closes:
        assert set(da.statics(da.rssp(**sizes)).status) == {"ok"}
        return
    with pytest.raises(
        da.ModelError, match="does not close from 86 to 274 degrees of the crank; change the rod"
    ):
        da.rssp(**sizes)
