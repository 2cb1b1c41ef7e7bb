"""Parts of a report in space: the count of constraints, turns, rates, inertia couples, and what is not unique."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.cli import method_text
from dalembert.interchange.placements import turned
from dalembert.reports.sections import matrix, sources
from dalembert.reports.sections.solution_steps import _listed
from dalembert.reports.sheet import Paragraph, ReportSheet, SheetTable
from dalembert.reports.space_sections import space_mobility, space_motion, space_reactions
from dalembert.views.notation import Figures, Notation

NAN = math.nan


def context(**r: Any) -> Any:
    shown: Any = Figures(None, Notation())
    shown.heading, shown.link = (lambda link: f"<{link}>"), (lambda link: link[0])
    shown.least = {"acceleration": 1e-6, "moment": 1e-6, "force": 1e-6}
    shown.reaction, shown.joint_moment = (lambda j, on: f"F_{{{j}}}"), (lambda j, on: f"M_{{{j}}}")
    return SimpleNamespace(r=SimpleNamespace(**r), k=1, shown=shown, notation=shown.notation, about="")


def rotations(*angles: float) -> Any:
    """Of a link: about an axis at position 1, none at position 0."""
    return lambda link: np.array([np.eye(3), turned([0, 3, 4], angles[0 if link == "a" else 1])])


def test_links_are_turned_about_an_axis_or_not_at_all() -> None:
    mass = {"a": 2.0, "b": 0.0}
    c = context(
        links=("a", "b"), rotation=rotations(0.5, 0.0), mechanism=SimpleNamespace(mass=mass.get),
        center=lambda link: np.array([[9.0, 9.0, 9.0], [0.1, -0.2, 0.3]]),
    )  # fmt: skip
    sheet = ReportSheet("")
    space_motion._orientations(sheet, c)
    (table,) = sheet.blocks
    assert isinstance(table, SheetTable)
    degrees = Figures(None, Notation()).text("angle", 0.5)
    assert table.heads == (
        "Link",
        "Turned by",
        "about x",
        "y",
        "z",
        "$G_{x}$ (m)",
        "$G_{y}$ (m)",
        "$G_{z}$ (m)",
    )
    assert table.rows == (
        ("<a>", degrees, "0", "0.6000", "0.8000", "0.1000", "−0.2000", "0.3000"),
        ("<b>", "none", "–", "–", "–", "–", "–", "–"),
    )
    assert table.caption == "Each link as turned from ground's axes about the axis shown, and its mass centre"


@pytest.mark.parametrize(
    ("speed", "acceleration", "moves"),
    [
        ([0, 0, 0], [0, 0, 0], False),
        ([0, 2, 0], [0, 0, 0], True),
        ([0, 0, 0], [0, 0, 3], True),
        ([0, 2, 0], [1, 0, 3], True),
    ],
)
def test_a_machine_moves_with_any_component_of_any_link(speed: Any, acceleration: Any, moves: bool) -> None:
    still = np.zeros((2, 3))

    def read(v: Any) -> Any:
        return lambda link: np.array([[9, 9, 9], v]) if link == "b" else still

    c = context(links=("a", "b"), speed=read(speed), acceleration=read(acceleration))
    assert space_motion._moves(c) is moves
    freedoms = [("A", "turn"), ("A", "slide_x")]
    c.r.compiled = SimpleNamespace(freedoms=freedoms)
    c.r.freedom = lambda joint, freedom: tuple(np.array([9.0, x]) for x in (0.5, 2.0, -3.0))
    sheet = ReportSheet("")
    space_motion.joint_values(sheet, c)
    (table,) = sheet.blocks
    assert isinstance(table, SheetTable)
    text = c.shown.text
    whole = (
        ("A", "turn", text("angle", 0.5), "2.000 rad/s", "−3.000 rad/s²"),
        ("A", "slide_x", "0.5000 m", "2.000 m/s", "−3.000 m/s²"),
    )
    assert table.rows == (whole if moves else tuple(row[:3] for row in whole))
    assert table.heads == ("Joint", "Freedom", "Value", "Rate", "Second rate")[: 5 if moves else 3]


def test_rates_of_links_and_of_their_mass_centres_have_their_units() -> None:
    mass = {"a": 2.0, "b": 0.0}

    def vector(x: float) -> Any:
        return lambda link: np.array([[9.0, 9.0, 9.0], [x, -x, 2 * x]])

    c = context(
        links=("a", "b"), mechanism=SimpleNamespace(mass=mass.get), speed=vector(1.0), acceleration=vector(2.0),
        center_velocity=vector(3.0), center_acceleration=vector(4.0),
    )  # fmt: skip
    sheet = ReportSheet("")
    space_motion._rates(sheet, c)
    turning, centres = sheet.blocks
    assert isinstance(turning, SheetTable)
    assert isinstance(centres, SheetTable)
    assert turning.heads[:2] == ("Link", "$omega_{x}$ (rad/s)")
    assert turning.heads[2:5] == ("$omega_{y}$", "$omega_{z}$", "$alpha_{x}$ (rad/s²)")
    assert centres.heads[1:5] == ("$v_{Gx}$ (m/s)", "$v_{Gy}$", "$v_{Gz}$", "$a_{Gx}$ (m/s²)")
    assert [row[0] for row in turning.rows] == ["<a>", "<b>"]
    assert centres.rows == (("<a>", "3.000", "−3.000", "6.000", "4.000", "−4.000", "8.000"),)


def test_an_inertia_couple_is_reversed_in_the_axes_of_the_link_and_turned_to_the_ground(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    t = SimpleNamespace(
        rate=np.array([[9.0] * 3, [1.0, -2.0, 3.0]]), gyroscopic=np.array([[9.0] * 3, [0.5, 0.25, -4.0]]),
        speed=np.array([[9.0] * 3, [1.0, 2.0, 3.0]]), acceleration=np.array([[9.0] * 3, [4.0, 5.0, -6.0]]),
    )  # fmt: skip
    monkeypatch.setattr(space_motion, "turning", lambda r, link: t)
    quarter = np.array([np.eye(3), [[0, -1, 0], [1, 0, 0], [0, 0, 1]]])
    c = context(rotation=lambda link: quarter)
    motion, rate, gyroscopic, total, ground = space_motion._couple(c, "rod")
    assert motion.letters == (
        'omega_{r\'} = (1.000, 2.000, 3.000) "rad/s", quad alpha_{r\'} = (4.000, 5.000, −6.000) "rad/s²"'
    )
    assert (rate.letters, rate.numbers) == ("J_{r} alpha_{r'}", "J_{r} (4.000, 5.000, −6.000)")
    assert rate.result == '(1.000, −2.000, 3.000) "N·m"'
    assert gyroscopic.numbers == "(1.000, 2.000, 3.000) times J_{r} (1.000, 2.000, 3.000)"
    assert gyroscopic.result == '(0.5000, 0.2500, −4.000) "N·m"'
    assert total.letters == "T_{Ir'} = −(J_{r} alpha_{r'} + omega_{r'} times J_{r} omega_{r'})"
    assert total.numbers == "−((1.000, −2.000, 3.000) + (0.5000, 0.2500, −4.000))"
    assert total.result == '(−1.500, 1.750, 1.000) "N·m, link axes"'
    assert ground.result == '(−1.750, −1.500, 1.000) "N·m, ground axes"'
    for size, count in ((0.9e-6, 0), (-1.1e-6, 5)):
        t.rate, t.gyroscopic = np.zeros((2, 3)), np.array([[9.0] * 3, [0.0, size, 0.0]])
        assert len(space_motion._couple(c, "rod")) == count


def test_an_inertia_force_has_its_components_and_its_size() -> None:
    c = context(
        mechanism=SimpleNamespace(mass=lambda link: 2.0),
        center_acceleration=lambda link: np.array([[9.0] * 3, [1.0, -2.0, 2.0]]),
    )
    (line,) = space_motion._force(c, "rod")
    assert (line.letters, line.numbers) == ("F_{Ir} = −m_{r} a_{Gr}", "−2.000 (1.000, −2.000, 2.000)")
    assert line.result == '(−2.000, 4.000, −4.000) "N, size 6.000 N"'
    for size, count in ((0.9e-6, 0), (-1.1e-6, 1)):
        c.r.center_acceleration = lambda link, size=size: np.array([[9.0] * 3, [0.0, size, 0.0]])
        assert len(space_motion._force(c, "rod")) == count
    c.r.mechanism.mass = lambda link: 0.0
    assert space_motion._force(c, "rod") == []


COUNTED = "the count alone is wrong by as many, and equilibrium alone does not settle all reactions."
SPUN = "could spin about the line of two ball joints, which moves nothing else: set to no spin."
RANK = "By rank: the matrix of the 16 constraints has the rank"


@pytest.mark.parametrize(
    ("freedoms", "drives", "redundant", "passive", "said"),
    [
        (
            1,
            1,
            0,
            (),
            f"{RANK} 17, so that 1 of 18 motions is left. No constraint is redundant. Mobility 1, 1 drive.",
        ),
        (
            2,
            0,
            1,
            ("a",),
            f"a {SPUN} {RANK} 15, so that 2 of 17 motions are left. 1 of the constraints is redundant, among joints "
            f"A, B: {COUNTED} Mobility 2, no drive.",
        ),
        (
            3,
            2,
            2,
            ("a", "b"),
            f"a and b {SPUN} {RANK} 13, so that 3 of 16 motions are left. 2 of the constraints are redundant, among "
            f"joints A, B: {COUNTED} Mobility 3, 2 drives.",
        ),
    ],
)
def test_the_rank_says_what_moves(
    freedoms: int, drives: int, redundant: int, passive: Any, said: str
) -> None:
    dof: Any = SimpleNamespace(
        freedoms=freedoms, drives=drives, redundant=redundant, redundant_joints=("A", "B"), passive=passive
    )
    assert " ".join(space_mobility._words(dof, 3, 16)) == said


def test_constraints_are_counted_joint_by_joint(monkeypatch: pytest.MonkeyPatch) -> None:
    pair = SimpleNamespace(reactions=("Fx", "My"), threaded=False)
    thread, teeth = (
        SimpleNamespace(reactions=("Fy",), threaded=True),
        SimpleNamespace(reactions=(), threaded=False),
    )
    joints = {
        n: SimpleNamespace(pair=p, type=t, links=("ground", "a"))
        for n, p, t in (("A", pair, "ball_slot"), ("B", thread, "screw"), ("C", teeth, "gear"))
    }
    counts = {"A": 9, "B": 5, "C": 1}
    monkeypatch.setattr(space_mobility, "unknown_count", lambda r, joint: counts[joint])
    dof = SimpleNamespace(freedoms=1, drives=1, redundant=0, redundant_joints=(), passive=("a",))
    c = context(
        joints=tuple(joints), links=("a", "b"), mobility=dof, mechanism=SimpleNamespace(joints=joints)
    )
    sheet = ReportSheet("")
    space_mobility.degrees_of_freedom(sheet, c)
    _, table, lines, _ = sheet.blocks
    assert isinstance(table, SheetTable)
    assert table.rows == (
        ("A", "ball slot", "<ground> – <a>", "$F_{x'}$, $M_{y'}$", "9"),
        ("B", "screw", "<ground> – <a>", "$F_{y'}$ ($M_{x'}$ with $F_{x'}$)", "5"),
        ("C", "gear", "<ground> – <a>", "the force of the teeth", "1"),
        ("sum", "", "", "", "15"),
    )
    assert table.total
    assert [(w.letters, w.numbers, w.result) for w in lines.lines] == [  # type: ignore[union-attr]
        ("F = 6 n − sum c", "6 cdot 2 − 15", "−3"), ('F − "spins"', "−3 − 1", "−4"),
    ]  # fmt: skip
    c.r.mobility = None
    sheet = ReportSheet("")
    space_mobility.degrees_of_freedom(sheet, c)
    assert sheet.blocks == []


def reactions(force: Any, moment: Any, known: Any, pair: Any, wheels: int = 0) -> Any:
    exact = np.where(known, [*force, *moment], NAN)
    joints = {"A": SimpleNamespace(pair=pair, wheels=wheels, links=("ground", "a"))}
    return context(
        joints=("A",),
        mechanism=SimpleNamespace(joints=joints),
        friction=None,
        assumptions={},
        unique_array=None,
        reaction=lambda j, on, axes: np.array([[9.0] * 3, exact[:3]]),
        reaction_moment=lambda j, on, axes: np.array([[9.0] * 3, exact[3:]]),
        least_norm=lambda j, on, axes: np.array([[9.0] * 6, [*force, *moment]]),
    )


def test_what_is_not_unique_stands_in_brackets_and_what_is_not_carried_is_a_dash() -> None:
    pair = SimpleNamespace(forces="xy", moments="z", threaded=False)
    c = reactions([3.0, -4.0, 0.0], [0.0, 0.5, 2.0], [True, False, True, True, True, True], pair)
    least = (1e-6, 1e-6, 1e-6)
    assert space_reactions._row(c, "A", "a", "ground", least) == [
        "A", "$F_{A}$", "3.000", "(−4.000)", "0", "(5.000)", "$M_{A}$", "0", "0.5000", "2.000", "2.062",
    ]  # fmt: skip
    assert space_reactions._row(c, "A", "a", "joint", least)[2:] == [
        "3.000", "(−4.000)", "–", "(5.000)", "$M_{A}$", "–", "0.5000", "2.000", "2.062",
    ]  # fmt: skip
    assert space_reactions.uniqueness(c).startswith(
        "Not unique, because equilibrium alone does not determine them: A ($F_{y'}$). Figures"
    )
    ball = SimpleNamespace(forces="xyz", moments="", threaded=False)
    for size, dashes in ((0.9e-6, True), (-1.1e-6, False)):
        c = reactions([3.0, -4.0, 0.0], [0.0, size, 0.0], [True] * 6, ball)
        assert (space_reactions._row(c, "A", "a", "ground", least)[6:] == ["–"] * 5) is dashes
    assert space_reactions.uniqueness(c) == "Every reaction is unique: equilibrium alone determines it."
    c.r.assumptions, c.r.unique_array = {"redundant reactions": "with equal stiffness"}, np.zeros(1)
    said = "Equilibrium alone does not determine all reactions; they are computed with equal stiffness."
    assert space_reactions.uniqueness(c) == said
    screw = SimpleNamespace(forces="yz", moments="yz", threaded=True)
    c = reactions([0.0] * 3, [0.0] * 3, [True] * 6, screw)
    assert space_reactions._carried_components(c, "A", 0) == (False, True, True)
    assert space_reactions._carried_components(c, "A", 1) == (True, True, True)
    assert (
        space_reactions._carried_components(reactions([0.0] * 3, [0.0] * 3, [True] * 6, ball, 2), "A", 1)
        == (True,) * 3
    )
    assert space_reactions._acting_link(c, "A") == "a"
    c.r.mechanism.joints["A"].links = ("a", "ground")
    assert space_reactions._acting_link(c, "A") == "a"


def test_an_unknown_load_of_one_component_is_a_force(monkeypatch: pytest.MonkeyPatch) -> None:
    some = {
        "P": (np.array([[9.0, 9.0], [0.0, 1.0]]), np.array([9.0, 0.0])),
        "T": (np.zeros((2, 2)), np.array([9.0, 1.0])),
    }
    acts = tuple(
        SimpleNamespace(kind="load", of=n, link="rod", at=np.array([[9.0, 9.0], [0.1, 0.2]])) for n in "TP"
    )
    monkeypatch.setattr(matrix, "actions", lambda r: acts)
    monkeypatch.setattr(matrix, "unit_load", lambda r, n: some["PT"[n]])
    r: Any = SimpleNamespace(
        unknown_loads=("P", "T"), unknown_load=lambda n: np.array([9.0, {"P": 3.0, "T": -4.0}[n]])
    )
    force, couple = matrix._loads(r, 1)
    assert (force.kind, force.value, force.of, list(force.place)) == (
        "force",
        3.0,
        (("load", "P"),),
        [0.1, 0.2],
    )
    assert (couple.kind, couple.value, couple.of) == ("moment", -4.0, (("load", "T"),))
    assert list(force.on["rod"][0]) == [0.0, 1.0]


def test_other_solutions_are_searched_where_the_senses_are_given(monkeypatch: pytest.MonkeyPatch) -> None:
    from dalembert.analysis.friction import other_solutions

    monkeypatch.setattr(method_text, "print_scale", lambda r, units: None)
    monkeypatch.setattr(method_text, "unknown_kinds", lambda r: {})
    sought = next(iter(other_solutions.SOUGHT))
    for others, status, said in (
        ({}, (sought, "singular"), "proved not to exist"), ({1: []}, ("singular", sought), "none detected"),
        ({}, ("singular",), "searched only where the senses of friction are given, at no position of this result"),
    ):  # fmt: skip
        monkeypatch.setattr(other_solutions, "every_other_solution", lambda r, others=others: others)
        text = method_text.other_solutions_text(SimpleNamespace(status=status), "file")  # type: ignore[arg-type]
        assert " ".join(text.split()) == f"Other solutions of friction: {said}."


def test_power_of_a_load_is_that_of_its_point_and_its_couple() -> None:
    a: Any = SimpleNamespace(
        link="rod", at=np.array([[9.0] * 3, [1.0, 2.0, 4.0]]), force=np.array([[9.0] * 3, [3.0, -1.0, 2.0]]),
        couple=np.array([[9.0] * 3, [0.5, 0.25, 1.0]]),
    )  # fmt: skip
    w, v, at = np.array([1.0, 2.0, 3.0]), np.array([0.1, 0.2, 0.3]), np.array([0.5, 0.5, 0.5])

    def read(x: Any) -> Any:
        return lambda link: np.array([[9.0] * 3, x])

    r: Any = SimpleNamespace(speed=read(w), velocity=read(v), position=read(at))
    power = a.force[1] @ (v + np.cross(w, a.at[1] - at)) + a.couple[1] @ w
    assert sources._power(r, a, 1) == pytest.approx(power)
    a.link = "ground"
    assert sources._power(r, a, 1) == 0.0
    assert [_listed(n) for n in ([1], [1, 2], [1, 2, 5])] == ["1", "1 and 2", "1, 2 and 5"]


def test_the_classes_of_links_say_what_friction_touches(monkeypatch: pytest.MonkeyPatch) -> None:
    from dalembert.reports.sections import methods

    def member(touching: str) -> Any:
        return SimpleNamespace(kind="couple", state=lambda k: "", touching=touching, forces=())

    monkeypatch.setattr(
        methods,
        "order_of_solution",
        lambda r, some: [SimpleNamespace(why="rod"), SimpleNamespace(why="crank")],
    )
    monkeypatch.setattr(methods.draw, "force_chain", lambda *a: "chain")
    for touching, said in (("tangent to A", ["With friction: <b>: tangent to A."]), ("", [])):
        monkeypatch.setattr(methods, "members", lambda r, t=touching: {"a": member(""), "b": member(t)})
        sheet = ReportSheet("")
        methods.graphical(sheet, context(links=("a",)))
        texts = [b.text for b in sheet.blocks if isinstance(b, Paragraph)]
        assert texts == [
            "Classes of the links. <a>: couple; <b>: couple.",
            *said,
            "Order of solution: rod; then crank.",
        ]
