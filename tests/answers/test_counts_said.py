"""Counts of freedoms, drives and loads in words, wheels that do not fit, modes and ranges: one of each, and many."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.analysis import degree_of_freedom as dof
from dalembert.analysis import positions
from dalembert.analysis.batch.tracing import kernel_inputs
from dalembert.analysis.status import statuses
from dalembert.errors import ModelError
from tests.answers.test_status_sentences import JOINTS, compiled

NAN, ADVICE = math.nan, "or constrain the links that can still move: "


def said(call: Any, *given: Any) -> tuple[str, str, tuple[Any, ...]]:
    with pytest.raises(ModelError) as raised:
        call(*given)
    return raised.value.what, raised.value.remedy, raised.value.path


@pytest.mark.parametrize(
    ("of", "sentence"),
    [
        (dof.Mobility(1, 0, 0, ()), "mobility 1, driven by no drive, no redundant constraint"),
        (
            dof.Mobility(3, 2, 1, ("A", "B")),
            "mobility 3, driven by 2 drives, 1 redundant constraint among joints A, B",
        ),
        (
            dof.Mobility(0, 1, 2, ("A",), ("rod", "strut")),
            "mobility 0, driven by 1 drive, 2 redundant constraints among joints A; rod and strut could spin between "
            "ball joints: no spin",
        ),
    ],
)
def test_mobility_is_said_with_its_numbers(of: dof.Mobility, sentence: str) -> None:
    assert of.sentence == str(of) == sentence


FREE = SimpleNamespace(
    links=("crank", "rod", "ram"),
    freedoms=(("A", "turn"), ("B", "turn"), ("B", "slide")),
    schedule=SimpleNamespace(names=("O", "S")),
)


def ranked(loose: Any = (), free: Any = ()) -> Any:
    return SimpleNamespace(
        loose=np.array([n in loose for n in FREE.links]),
        free=np.array([k in free for k in range(len(FREE.freedoms))]),
    )


@pytest.mark.parametrize(
    ("freedoms", "drives", "of", "counts", "remedy"),
    [
        (0, 1, ranked(), "no degree of freedom and 1 drive", "remove 1 drive of O, S"),
        (1, 3, ranked(), "1 degree of freedom and 3 drives", "remove 2 drives of O, S"),
        (
            1,
            0,
            ranked(("rod",), (0,)),
            "1 degree of freedom and no drive",
            f"add 1 drive at one of A (turn), {ADVICE}rod",
        ),
        (
            3,
            1,
            ranked(("rod", "ram"), (0, 2)),
            "3 degrees of freedom and 1 drive",
            f"add 2 drives at some of A (turn), B (slide), {ADVICE}rod, ram",
        ),
        (2, 1, ranked(("rod",)), "2 degrees of freedom and 1 drive", f"add 1 drive, {ADVICE}rod"),
        (
            1,
            1,
            ranked(("ram",), (1,)),
            "1 degree of freedom and 1 drive",
            f"add 1 drive at one of B (turn), {ADVICE}ram",
        ),
    ],
)
def test_drives_that_are_not_as_many_as_freedoms_are_refused(
    freedoms: int, drives: int, of: Any, counts: str, remedy: str
) -> None:
    found = said(dof.check_drives, FREE, of, dof.Mobility(freedoms, drives, 0, ()))
    assert found == (f"the mechanism has {counts}", remedy, ("drives",) if drives else ("joints",))


def test_as_many_drives_as_freedoms_are_right_and_six_freedoms_are_named() -> None:
    dof.check_drives(FREE, ranked(), dof.Mobility(2, 2, 0, ()))  # type: ignore[arg-type]
    many: Any = SimpleNamespace(**(vars(FREE) | {"freedoms": tuple((n, "turn") for n in "ABCDEFGH")}))
    of = SimpleNamespace(loose=np.array([True, False, False]), free=np.ones(8, bool))
    remedy = said(dof.check_drives, many, of, dof.Mobility(8, 1, 0, ()))[1]
    assert "A (turn), B (turn), C (turn), D (turn), E (turn), F (turn), or" in remedy


def knowns(requested: list[bool], loads: tuple[str, ...], start: Any = None, names: Any = ("O",)) -> Any:
    return SimpleNamespace(
        known=SimpleNamespace(requested=np.array(requested, bool)),
        unknown_loads=loads,
        mechanism=SimpleNamespace(start=start),
        schedule=SimpleNamespace(names=names),
    )


MAKE = "unknown (`value: unknown` with a direction) or leave the efforts out"


@pytest.mark.parametrize(
    ("c", "what", "remedy", "path"),
    [
        (
            knowns([False, True], ()),
            "1 drive effort is given but no load is unknown",
            f"make 1 load {MAKE}",
            ("drives",),
        ),
        (
            knowns([False] * 3, ("F",), {"O": 1}),
            "3 drive efforts are given but 1 load is unknown",
            f"make 2 loads {MAKE}; the motion that forces give it from its start is that of `dalembert simulate`",
            ("drives",),
        ),
        (
            knowns([True], ("F",)),
            "1 load is unknown but no drive effort is given",
            "give the effort of 1 drive or the values of the loads",
            ("loads", "F"),
        ),
        (
            knowns([True, False], ("F", "G", "H")),
            "3 loads are unknown but 1 drive effort is given",
            "give the effort of 2 drives or the values of the loads",
            ("loads", "F"),
        ),
        (
            knowns([], ("F",), names=()),
            "1 load is unknown but no drive effort is given",
            "a structure holds any load: leave out the joint in whose place the load is to hold, and give the freedom "
            "that this leaves a drive with `effort: 0`",
            ("loads", "F"),
        ),
    ],
)
def test_given_efforts_are_as_many_as_unknown_loads(c: Any, what: str, remedy: str, path: Any) -> None:
    assert said(dof.check_knowns, c) == (what, remedy, path)


def test_one_effort_for_one_load_is_right() -> None:
    for requested, loads in (([True], ()), ([False], ("F",)), ([False, True, False], ("F", "G"))):
        assert dof.check_knowns(knowns(requested, loads)) is None  # type: ignore[func-returns-value]


# wheels


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_gears_are_at_the_sum_of_their_radii_within_a_part_of_it(sign: float) -> None:
    part = positions.MESH * 0.3
    positions._check_mesh("G", 0.3 + sign * 0.9 * part, 0.5, -0.2)
    distance = 0.3 + sign * 1.2 * part
    what, remedy, path = said(positions._check_mesh, "G", distance, 0.5, -0.2)
    assert what == f"gear 'G': centres {distance:.6g} m apart, but pitch radii 0.5 m and 0.2 m need 0.3 m"
    assert remedy == "change the radii or move a centre"
    assert path == ("joints", "G")


@pytest.mark.parametrize(("ri", "rj"), [(0.2, -0.3), (0.2, 0.3), (-0.2, 0.3)])
def test_wheels_of_a_belt_do_not_touch(ri: float, rj: float) -> None:
    positions._check_belt("V", 0.51, ri, rj)
    for distance in (0.5, 0.4):
        what, remedy, path = said(positions._check_belt, "V", distance, ri, rj)
        assert what == f"belt 'V': centres {distance:.6g} m apart, but its wheels need more than 0.5 m"
        assert (remedy, path) == ("make a wheel smaller or move a centre", ("joints", "V"))


def misfit(scale: float, gap: float, inside: float, internal: bool = False) -> Any:
    c: Any = SimpleNamespace(
        joints=("A", "G"),
        layout=SimpleNamespace(constraints=SimpleNamespace(joint=np.array([0, 0, 1]))),
        mechanism=SimpleNamespace(joints={"G": SimpleNamespace(internal=internal)}),
    )
    rows = [np.array([x]) for x in (2, scale, gap, inside)]
    return positions._check_misfit(c, rows)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("scale", "gap", "words"),
    [
        (0.02, 0.0, "radii 2.00% too small, 0.00% of them apart"),
        (-0.02, 0.001, "radii 2.00% too large, 0.10% of them apart"),
        (0.0, 0.03, "3.00% of them apart"),
        (-1e-9, 0.03, "3.00% of them apart"),
    ],
)
def test_pitch_circles_that_do_not_touch_say_how_far(scale: float, gap: float, words: str) -> None:
    what, _, path = said(misfit, scale, gap, 1.0)
    assert what == f"gear 'G': the pitch circles do not touch ({words})"
    assert path == ("joints", "G")


def test_a_wheel_is_within_the_other_or_beside_it_as_the_file_says() -> None:
    for inside, internal in ((1.0, True), (-1.0, False), (0.0, True), (0.0, False)):
        assert misfit(0.0, 0.0, inside, internal) is None
    assert said(misfit, 0.0, 0.0, 1.0, False) == (
        "gear 'G': one wheel lies within the other",
        "write internal: true",
        ("joints", "G", "internal"),
    )
    assert said(misfit, 0.0, 0.0, -1.0, True) == (
        "gear 'G': one wheel lies beside the other",
        "leave internal out, or move a centre",
        ("joints", "G", "internal"),
    )


def test_a_motion_of_millions_of_turns_is_a_slip_of_the_unit() -> None:
    c = compiled()
    c.schedule.position = np.array([[0.0, 0.0], [3e9, 0.1], [0.0, -4e9]])
    along: Any = SimpleNamespace(s=np.array([0.0, 1.0, 1e9]), order=np.array([0, 2, 1]))
    what, remedy, path = said(positions._refuse_endless, c, along)
    assert what == "drive 'S' goes from -4e+12 mm to 100 mm between two positions"
    assert remedy.startswith("check the position and its unit; ")
    assert path == ("drives", "S", "position")
    for s in ([0.0], [0.0, 1.0], [0.0, positions.FARTHEST]):
        along.s = np.array(s)
        assert positions._refuse_endless(c, along) is None  # type: ignore[func-returns-value]
    along.s = np.array([0.0, NAN])
    with pytest.raises(ModelError):
        positions._refuse_endless(c, along)


def test_a_first_position_far_from_the_drawing_is_a_slip_of_the_unit() -> None:
    c = compiled()
    c.layout.length = 0.5
    far = positions.FARTHEST
    for first, name in (([1.0, 0.6 * far], "S"), ([-1.1 * far, 0.4 * far], "O"), ([NAN, 0.0], "O")):
        c.schedule.position = np.array([first])
        what, _, path = said(positions._refuse_far, c)
        assert what.startswith(f"drive '{name}' begins at ")
        assert what.endswith(", and is at 0 as drawn")
        assert path == ("drives", name, "position")
    c.schedule.position = np.array([[far, -0.5 * far]])
    assert positions._refuse_far(c) is None  # type: ignore[func-returns-value]


def modes(turns: list[list[float]], by: str) -> str | None:
    turn = np.radians(np.array([[*row, 0.0] for row in turns]))
    pose = SimpleNamespace(turn=turn)
    c: Any = SimpleNamespace(geometries=(), links=("a", "b", "c", "d", "e")[: len(turns[0])])
    return positions.mode_sentence(c, SimpleNamespace(pose=pose, chosen_by=by))  # type: ignore[arg-type]


def test_a_mode_is_said_by_the_angles_that_differ_with_up_to_four_others() -> None:
    assert modes([[1.0, 2.0]], "given") is None
    assert modes([[1.0, 2.0]], "drawn") is None
    assert modes([[10.0, 20.0]], "open") == (
        "assembly mode a 10.00 deg, b 20.00 deg (the angles in the file's assembly do not decide)"
    )
    two = modes([[10.0, 20.0], [10.0, -30.0]], "nearest")
    assert two == (
        "assembly mode b 20.00 deg (nearest to the file's assembly); other modes (the file's `assembly` chooses): "
        "b -30.00 deg"
    )
    five = modes([[float(k)] for k in range(5)], "search") or ""
    assert five.endswith("a 1.00 deg | a 2.00 deg | a 3.00 deg | a 4.00 deg")
    seven = modes([[float(k)] for k in range(7)], "search") or ""
    assert seven.endswith("a 3.00 deg | a 4.00 deg and 2 more")
    wide = modes([[1.0, 2, 3, 4, 5], [6.0, 7, 8, 9, 10]], "search") or ""
    assert "assembly mode a 1.00 deg, b 2.00 deg, c 3.00 deg, d 4.00 deg (from a search)" in wide


def test_ranges_beyond_a_gap_are_said_by_their_entries() -> None:
    c = compiled()
    ranges = positions._ranges
    assert ranges(c, SimpleNamespace(entered=())) is None  # type: ignore[arg-type]
    tail = "beyond a gap in which the linkage does not close, and cannot be reached from the first pose: beyond it (at "
    ends = ") every group of links keeps its branch"
    one = ranges(c, SimpleNamespace(entered=(1,)))  # type: ignore[arg-type]
    assert one == f"a range is {tail}O = 30 deg and S = 200 mm{ends}"
    many = ranges(c, SimpleNamespace(entered=(0, 2) * (positions.NAMED // 2) + (1, 1))) or ""  # type: ignore[arg-type]
    assert many.startswith(f"{positions.NAMED + 2} ranges are {tail}O = 0 deg and S = 100 mm, ")
    assert many.endswith(f", 2 more{ends}")


# balance


def unbalanced(**more: Any) -> str:
    known = SimpleNamespace(requested=np.array([False, True]), effort=np.zeros((3, 2)))
    c = compiled(known=known, **({"passive": (), "contacts": None} | more))
    c.mechanism.joints = {"A": JOINTS["A"]}
    return statuses.no_balance_sentence(c, np.array([1, 2]))


def test_no_balance_says_what_cannot_balance_what() -> None:
    assert unbalanced(unknown_loads=()) == "The loads have no equilibrium here."
    plain = "The unknown F cannot balance the given effort of O: it has no power here"
    assert unbalanced() == f"{plain}."
    c = compiled(
        passive=(), known=SimpleNamespace(requested=np.array([False, True]), effort=np.zeros((3, 2)))
    )
    c.mechanism.joints = {"A": JOINTS["A"]}
    for moves, more in (
        ([False, True, False], ", and the friction that it causes does not balance it either"),
        (
            [True, False, False],
            ", and friction at rest may have any value within its limits. Give the drive a speed",
        ),
    ):
        c.schedule.moves = np.array(moves)
        assert statuses.no_balance_sentence(c, np.array([1, 2])) == f"{plain}{more}."
    text = (
        "The loads have no equilibrium here: they turn rod or strut about the line of two ball joints, {}. "
        "Replace one of them by a universal joint, or move the mass centre onto the line."
    )
    assert unbalanced(passive=("rod", "strut")) == text.format("which no force prevents")
    assert unbalanced(passive=("rod", "strut"), contacts=1) == text.format("more than friction holds")


def test_redundant_constraints_are_one_or_several() -> None:
    for count, words in ((1, "1 constraint is"), (2, "2 constraints are")):
        followed: Any = SimpleNamespace(mobility=dof.Mobility(1, 1, count, ("A", "B")))
        assert statuses._redundant_sentence(followed) == (
            f"{words} redundant among joints A, B: reactions that are not unique are left out, their least-norm values "
            "given beside."
        )


def test_the_sign_of_a_branch_is_carried_over_positions_where_both_are_one() -> None:
    carry = kernel_inputs._carry_sign_forward
    assert carry(np.array([0.0, 0.0, -1.0, 0.0, 1.0, 0.0])).tolist() == [-1.0, -1.0, -1.0, -1.0, 1.0, 1.0]
    assert carry(np.array([1.0, 0.0, -1.0])).tolist() == [1.0, 1.0, -1.0]
