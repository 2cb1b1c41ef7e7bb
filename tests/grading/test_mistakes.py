"""Typical mistakes: the wrong figure is made by solving the wrong problem, rounded as a student writes, and named."""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.grading.answer_sheet import figures
from dalembert.grading.wrong.wrong_problems import WrongProblems
from dalembert.model.files.model_files import read_file
from tests.tiers import tiers

LBF, INCH = 4.4482216152605, 0.0254
NORTON, ROCKER, SLIDER, GRAVITY = (
    "four_bar",
    "seed-002-3-four-link-three-forces",
    "seed-002-5-slider-crank-force-on-rod",
    "seed-003-norton-11-3-gravity",
)
Change = Callable[[dict[str, Any]], None]


def tree(name: str) -> dict[str, Any]:
    return dict(read_file((cases() | examples())[name])[0])


def solved(name: str, change: Change | None = None) -> Any:
    wrong = deepcopy(tree(name))
    if change is not None:
        change(wrong)
    wrong.pop("answers", None)
    return da.solve(da.mechanism(wrong))


def rounded(value: float) -> float:
    return float(f"{value:.4g}")


def effort(r: Any) -> str:
    return f"{rounded(float(r.effort(r.drives[0])[0]))} N*m"


def force(r: Any, joint: str) -> str:
    x, y = r.reaction(joint)[0]
    return f"{rounded(math.hypot(x, y))} N @ {math.degrees(math.atan2(y, x)):.2f} deg"


def named(name: str, quantity: str, of: str, value: str, **more: Any) -> str:
    answer = da.Answer(quantity=quantity, of=of, value=value, **more)
    verdict = da.check_answers(da.load((cases() | examples())[name]), [answer])[0]
    assert not verdict.right
    return verdict.mistake


def put(*path: str, value: Any) -> Change:
    def change(wrong: dict[str, Any]) -> None:
        at = wrong
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = value

    return change


def without(*path: str) -> Change:
    def change(wrong: dict[str, Any]) -> None:
        at = wrong
        for key in path[:-1]:
            at = at[key]
        del at[path[-1]]

    return change


def scaled_inertia(forces: float, couples: float) -> Change:
    """Masses and moments of inertia of Norton's links scaled."""

    def change(wrong: dict[str, Any]) -> None:
        for link, weight, inertia in (("crank", 1.5, 0.4), ("coupler", 7.7, 1.5), ("rocker", 5.8, 0.8)):
            wrong["links"][link] |= {"weight": weight * forces, "inertia": inertia * couples}

    return change


def other_mode(wrong: dict[str, Any]) -> None:
    wrong["assembly"] = {"coupler": -60, "rocker": -100}


def of_effort(name: str, change: Change) -> tuple[str, str, str, str]:
    r = solved(name, change)
    return name, "effort", r.drives[0], effort(r)


def of_joint(name: str, joint: str, change: Change) -> tuple[str, str, str, str]:
    return name, "reaction", joint, force(solved(name, change), joint)


def turned(name: str, joint: str, matrix: list[list[float]]) -> tuple[str, str, str, str]:
    x, y = np.array(matrix) @ solved(name).reaction(joint)[0]
    return (
        name,
        "reaction",
        joint,
        f"{rounded(math.hypot(x, y))} N @ {math.degrees(math.atan2(y, x)):.2f} deg",
    )


def in_link_axes() -> tuple[str, str, str, str]:
    x, y = solved(NORTON).reaction("B", axes="link")[0]
    return NORTON, "reaction", "B", f"{math.hypot(x, y):.4g} N @ {math.degrees(math.atan2(y, x)):.2f} deg"


MISTAKES: dict[str, tuple[Callable[[], tuple[str, str, str, str]], str]] = {
    "effort: action for reaction": (
        lambda: (NORTON, "effort", "O2", "-243.2 lbf*in"),
        "action mistaken for reaction",
    ),
    "joint: action for reaction": (lambda: turned(NORTON, "A", [[-1, 0], [0, -1]]), "action mistaken for reaction"),
    "angle from the other axis": (lambda: turned(NORTON, "A", [[0, 1], [1, 0]]), "from the other axis"),
    "angle clockwise": (lambda: turned(NORTON, "A", [[1, 0], [0, -1]]), "clockwise"),
    "wrong joint": (lambda: of_joint_of(NORTON, "A", "B"), "this is joint B"),
    "link axes": (in_link_axes, "along and across link rocker"),
    "inertia left out": (lambda: of_effort(NORTON, scaled_inertia(0, 0)), "static answer"),
    "inertia couples left out": (lambda: of_effort(NORTON, scaled_inertia(1, 0)), "inertia couples are left out"),
    "inertia forces left out": (lambda: of_effort(NORTON, scaled_inertia(0, 1)), "inertia forces are left out"),
    "weight for mass": (lambda: of_effort(NORTON, scaled_inertia(386, 1)), "weight is mistaken for mass"),
    "g in feet": (lambda: of_effort(NORTON, scaled_inertia(12, 1)), "g is in ft/s2"),
    "inertia in lb ft s2": (lambda: of_effort(NORTON, scaled_inertia(1, 12)), "moments of inertia are in the wrong"),
    "one inertia couple left out": (
        lambda: of_effort(NORTON, put("links", "rocker", "inertia", value=0)),
        "inertia couple of rocker is left out",
    ),
    "inches for feet": (lambda: (NORTON, "effort", "O2", "20.27 lbf*in"), "inches and feet"),
    "pounds for newtons": (lambda: (NORTON, "reaction", "A", "34.80 lbf @ -139.68 deg"), "pounds and newtons"),
    "gravity left out": (lambda: of_effort(GRAVITY, put("gravity", value="none")), "gravity is left out"),
    "gravity where there is none": (
        lambda: of_effort(NORTON, put("gravity", value="standard")),
        "gravity is counted",
    ),
    "other assembly mode": (lambda: of_effort(ROCKER, other_mode_of(ROCKER)), "other assembly mode"),
    "other assembly mode, a joint": (lambda: of_joint(NORTON, "A", other_mode), "other assembly mode"),
    "a load left out": (lambda: of_effort(ROCKER, without("loads", "F3")), "load F3 is left out"),
    "a couple the other way": (lambda: of_effort(NORTON, put("loads", "T_4", "value", value=-120)), "T_4 has the"),
    "moment arm": (lambda: of_effort(NORTON, put("loads", "F_P", "at", value="B")), "moment arm of F_P"),
    "moment arm to the centre": (
        lambda: of_effort(NORTON, put("loads", "F_P", "at", value="center")),
        "moment arm of F_P",
    ),
    "load's angle from the other axis": (
        lambda: of_effort(NORTON, put("loads", "F_P", "value", value="80 @ 120")),
        "angle of F_P is counted from the other axis",
    ),
    "load's angle in link axes": (
        lambda: of_effort(NORTON, put("loads", "F_P", "axes", value="link")),
        "F_P is counted in link axes",
    ),
    "acceleration left out": (
        lambda: of_effort(NORTON, put("drives", "O2", "acceleration", value="0 rad/s^2")),
        "acceleration of drive O2 is left out",
    ),
    "acceleration the other way": (
        lambda: of_effort(NORTON, put("drives", "O2", "acceleration", value="40 rad/s^2")),
        "acceleration of drive O2 has the wrong sense",
    ),
    "rpm for rad/s": (
        lambda: of_effort(NORTON, put("drives", "O2", "speed", value="25 rpm")),
        "speed of drive O2",
    ),
    "inertia about the pin": (
        lambda: of_effort(NORTON, put("links", "rocker", "inertia", value=0.8 + 5.8 / 386 * 25)),
        "moment of inertia of rocker is taken about",
    ),
    "mass centre on the wrong side": (
        lambda: of_effort(NORTON, put("links", "coupler", "center", value="9 @ -45")),
        "mass centre of coupler is on the wrong side",
    ),
}  # fmt: skip


def of_joint_of(name: str, asked: str, found: str) -> tuple[str, str, str, str]:
    return name, "reaction", asked, force(solved(name), found)


def other_mode_of(name: str) -> Change:
    def change(wrong: dict[str, Any]) -> None:
        links = [n for n in wrong["links"] if n != "ground"]
        wrong["assembly"] = {links[1]: -70, links[2]: -110}

    return change


def outcome(name: str) -> tuple[bool, str]:
    make, words = MISTAKES[name]
    found = named(*make())
    return words in found, found


@pytest.mark.parametrize("names", tiers([list(MISTAKES)[::4]], [list(MISTAKES)]), ids=len)
def test_most_of_the_typical_mistakes_are_named(names: list[str]) -> None:
    """At least 23 of 25; these are 30."""
    missed = {name: found for name in names for ok, found in [outcome(name)] if not ok}
    assert len(MISTAKES) >= 25
    assert len(missed) <= 2, missed


def test_right_figures_are_right() -> None:
    answers = figures({"efforts": {"O2": "243.2 lbf*in"}, "reactions": {"A": "154.8 lbf @ -139.68 deg"}})
    found = da.check_answers(da.load(examples()["four_bar"]), answers)
    assert all(v.right for v in found)


def test_a_figure_out_of_the_blue_is_not_explained() -> None:
    assert named(NORTON, "effort", "O2", "199.77 lbf*in") == "none of the usual mistakes explains it"


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_text("{efforts: {O2: -243.2}, reactions: {B: 87.41 @ -89.14}}", encoding="utf-8")
    assert main(["check-answers", str(examples()["four_bar"]), str(mine)]) == 1
    out = capsys.readouterr().out
    assert "effort of O2: the sense is opposite: action mistaken for reaction." in out
    assert out.endswith("1 of 2 right.\n")


def verdict(quantity: str, of: str, value: Any, **more: Any) -> Any:
    answer = da.Answer(quantity=quantity, of=of, value=value, **more)
    (found,) = da.check_answers(da.load(examples()["four_bar"]), [answer])
    return found


@pytest.mark.parametrize(
    ("value", "right"),
    [
        ("155 @ 220 deg", True),  # 154.805 lbf at 220.322 deg
        ("154.8 lbf @ -139.68 deg", True),
        ("-155 @ 40 deg", False),  # the same arrow, but no magnitude is negative
        ("155 @ 220.0 deg", False),  # four digits that are not those of the direction
        ("155 @ 221 deg", False),
        ("160 @ 220 deg", False),
        ("2e2 @ 220 deg", False),
        ([-118, -100], True),  # -118.026, -100.172
        ([-120, -100], False),
    ],
)
def test_the_digits_written_decide_what_rounding_is_forgiven(value: Any, right: bool) -> None:
    assert verdict("reaction", "A", value).right is right


@pytest.mark.parametrize("seed", tiers(range(2), range(2, 14), range(14, 30)))
def test_a_figure_rounded_to_three_digits_and_whole_degrees_is_right(seed: int) -> None:
    rng = np.random.default_rng(seed)
    m = da.four_bar().with_values({"drives.O2.position": float(rng.uniform(0, 6)), "loads.torque.value": 7.0})
    force = da.dynamics(m).reaction("B")[0]
    size, angle = float(np.hypot(*force)), math.degrees(math.atan2(force[1], force[0]))
    polar = da.Answer(quantity="reaction", of="B", value=f"{size:.3g} N @ {angle:.0f} deg")
    cartesian = da.Answer(quantity="reaction", of="B", value=[f"{c:.3g} N" for c in force])
    direction = da.Answer(quantity="reaction", of="B", component="direction", value=f"{angle % 360:.0f} deg")
    far = da.Answer(quantity="reaction", of="B", value=f"{1.02 * size:.3g} N @ {angle:.0f} deg")
    found = da.check_answers(m, [polar, cartesian, direction, far])
    assert [v.right for v in found] == [True, True, True, False]


def test_a_stated_tolerance_is_the_only_one() -> None:
    assert not verdict("reaction", "A", "155 @ 220 deg", tolerance="0.1 %").right
    assert verdict("effort", "O2", "250", tolerance="5 %").right


def test_a_figure_nearly_right_is_called_close() -> None:
    found = verdict("effort", "O2", "240 lbf*in")
    assert (found.right, found.mistake) == (False, "close: rounded too early, or a small slip")
    assert verdict("reaction", "A", "155 @ 221 deg").computed == "154.805 @ 220.322"


def test_a_single_number_for_a_force_is_its_magnitude() -> None:
    found = da.check_answers(
        da.load(examples()["four_bar"]), figures({"reactions": {"A": 155, "B": "87.4 lbf"}})
    )
    assert [v.right for v in found] == [True, True]


def test_a_sheet_says_once_at_which_position_its_figures_are() -> None:
    m = da.load(examples()["engine"])
    r = da.dynamics(m)
    sheet = {"at": 3, "mobility": 1, "efforts": {n: f"{float(r.effort(n)[2])!r} N*m" for n in r.drives}}
    read = figures(sheet)
    assert [a.at for a in read] == [None, *([3] * len(r.drives))]
    assert all(v.right for v in da.check_answers(m, read))
    with pytest.raises(da.ModelError, match="positions; say which: at: 1, or at: 60 deg"):
        da.check_answers(m, figures({k: v for k, v in sheet.items() if k != "at"}))


@pytest.mark.parametrize(
    ("tree", "said"),
    [
        (
            {"effort": 3},
            r"effort needs names, of the things that the figures belong to; write effort: \{NAME: 3\}",
        ),
        ([3], "the answers are neither a mapping nor a list of mappings; write efforts: "),
        ([{"quantity": "effort", "of": "O2"}, 3], "the answers are neither a mapping nor a list of mappings"),
        (None, "the answers are neither a mapping nor a list of mappings"),
        ({"forces": {"A": 3}}, "unknown quantity 'force'"),
    ],
)
def test_answers_that_cannot_be_read(tree: Any, said: str) -> None:
    with pytest.raises(da.ModelError, match=said):
        figures(tree)


def test_asked_one_by_one(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """An empty line skips one; the end of the input ends the questions."""
    given = iter(["243", "", "-118, -100"])

    def answered(question: str) -> str:
        try:
            return next(given)
        except StopIteration:
            raise EOFError from None

    monkeypatch.setattr("builtins.input", answered)
    assert main(["check-answers", str(examples()["four_bar"]), "--interactive"]) == 0
    assert capsys.readouterr().out.endswith("2 of 2 right.\n")


def test_every_wrong_part_is_that_part_times_its_factor() -> None:
    """Parts by solving without gravity, without moments of inertia, without inertia: no superposition."""
    heavy = da.mechanism({k: v for k, v in tree(NORTON).items() if k != "answers"} | {"gravity": "standard"})
    light = heavy.with_values({"gravity": "none"})
    points = light.with_values({f"links.{name}.inertia": 0.0 for name in ("crank", "coupler", "rocker")})
    efforts = [float(r.effort("O2")[0]) for r in map(da.dynamics, (heavy, light, points))]
    whole, rest = efforts[0], float(da.statics(light).effort("O2")[0])
    weights, couples, forces = -np.diff([*efforts, rest])
    g = heavy.g / 0.0254
    taken = "weight is mistaken for mass: inertia"
    factors = {
        "inertia is left out: this is the static answer": (forces + couples, [0.0]),
        "the inertia couples are left out": (couples, [0.0]),
        "the inertia forces are left out": (forces, [0.0]),
        "inertia forces and couples act along the accelerations, not against them": (
            forces + couples,
            [-1.0],
        ),
        "the inertia couples have the sense of the accelerations, not against them": (couples, [-1.0]),
        "the inertia forces have the sense of the accelerations, not against them": (forces, [-1.0]),
        f"{taken} forces are too large by g = {g:.5g} in/s^2": (forces, [g]),
        f"{taken} is too large by g = {g:.5g} in/s^2": (forces + couples, [g]),
        f"{taken} forces are too large by g = {9.80665:.5g} m/s2": (forces, [9.80665]),
        f"{taken} is too large by g = {9.80665:.5g} m/s2": (forces + couples, [9.80665]),
        "g is in ft/s2 where lengths are inches: the masses are too large by 12": (forces, [12.0]),
        "g is in in/s2 where lengths are feet: the masses are too small by 12": (forces, [1 / 12]),
        "the moments of inertia are in the wrong unit of length: a factor of 12": (couples, [12.0, 1 / 12]),
        "the moments of inertia are in the wrong unit of length: a factor of 144": (couples, [1 / 144]),
        "gravity is left out": (weights, [0.0]),
        "the weights act upwards": (weights, [-1.0]),
    }
    found: dict[str, list[float]] = {}
    for order, sentence, solution in WrongProblems(da.dynamics(heavy)):
        r = solution()
        if order > 1:
            break
        found.setdefault(sentence, []).append(float(r.effort("O2")[0]))
    for sentence, (part, some) in factors.items():
        assert found.pop(sentence) == pytest.approx([whole + (f - 1) * part for f in some], rel=1e-9), (
            sentence
        )
    assert found
    assert all(words.endswith(("is left out", "has the wrong sense")) for words in found)


@pytest.mark.parametrize(
    ("gravity", "offered"),
    [
        ("standard", ["9.8066 m/s^2"]),
        ([0, -9.81], ["9.81 m/s^2"]),
        ([0, -1.62], ["1.62 m/s^2", "9.8066 m/s2"]),
        ([0, -24.8], ["24.8 m/s^2", "9.8066 m/s2"]),
    ],
)
def test_mass_is_taken_for_weight_by_the_files_gravity_and_by_that_of_the_earth(
    gravity: str | list[float], offered: list[str]
) -> None:
    r = da.dynamics(da.four_bar().with_values({"gravity": gravity}))
    said = [words for _, words, _ in WrongProblems(r) if "inertia is too large by g" in words]
    assert [words.partition(" = ")[2] for words in said] == offered


def test_gravity_is_offered_where_there_is_none() -> None:
    counted = "gravity is counted, and the problem has none"
    made = {k: v for k, v in tree(NORTON).items() if k != "answers"}
    for gravity, offered in (("none", True), ("standard", False), ([0, -9.81], False)):
        r = da.dynamics(da.mechanism(made | {"gravity": gravity}))
        assert any(words == counted for _, words, _ in WrongProblems(r)) is offered
