"""What a worked solution says: which sections and sentences there are, and their figures against the answer."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import actions
from dalembert.bundled import examples
from dalembert.cli import check_command, main
from dalembert.cli.method_text import superposition_text, virtual_work_answer
from dalembert.reports.formula import latex, plain
from dalembert.reports.sections import friction, given
from dalembert.reports.sections.equilibrium_equations import link_equations
from dalembert.reports.sections.methods import cycle
from dalembert.reports.sections.motion import inertia_shares
from dalembert.reports.sections.sources import superposition
from dalembert.reports.sheet import Equations, Heading, Paragraph, ReportSheet, SheetTable
from dalembert.reports.working import working
from dalembert.views import charts, draw
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Scene
from tests.friction.engines import engine, engine_by_hand
from tests.methods.space_machines import MACHINES
from tests.methods.test_drawn_alike import LARGE, SMALL, Seen, plane_machine
from tests.methods.test_space_friction_drawings import solved as rubbing
from tests.space.test_gears import Z, pair, wheel


@pytest.fixture(autouse=True)
def without_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are not looked at here."""
    for name in ("free_body", "lines_of_action", "force_polygon", "force_chain", "displaced_inertia"):
        monkeypatch.setattr(draw, name, lambda *a, **k: Scene(()))
    for name in ("velocity_polygon", "acceleration_polygon", "instant_centers", "mechanism"):
        monkeypatch.setattr(draw, name, lambda *a, **k: Scene(()))
    monkeypatch.setattr(charts, "effort_chart", lambda *a, **k: [])
    monkeypatch.setattr(charts, "reaction_charts", lambda *a, **k: [])
    monkeypatch.setattr(given, "stated_picture", lambda *a: Scene(()))
    monkeypatch.setattr(friction, "friction_pictures", lambda *a: [])
    monkeypatch.setattr(Canvas, "label", lambda *a, **k: None)


def words(sheet: ReportSheet) -> str:
    return " ".join(b.text for b in sheet.blocks if isinstance(b, (Paragraph, Heading)))


def table(sheet: ReportSheet, head: str) -> SheetTable:
    (found,) = (b for b in sheet.blocks if isinstance(b, SheetTable) and head in b.heads)
    return found


def lines(sheet: ReportSheet) -> list[str]:
    """Equations as they are printed."""
    some = [w for b in sheet.blocks if isinstance(b, Equations) for w in b.lines]
    return [" = ".join(plain(t).strip() for t in (w.letters, w.numbers, w.result) if t) for w in some]


def figures(text: str) -> list[float]:
    return [float(x.replace("−", "-")) for x in re.findall(r"−?\d[\d.]*", text)]


def test_the_law_of_a_guide_and_what_friction_costs() -> None:
    """Of the engine at 50 deg: by hand, and in shares of the power put in."""
    r = da.statics(engine(mu=0.2, guide=0.05))
    sheet = working(r, methods=())
    hand = engine_by_hand(mu=0.2, half=0.05)
    (law,) = (t for t in lines(sheet) if t.startswith("F_f14 = "))
    letters, numbers, result = law.split(" = ")[1:]
    assert letters == "μ_guide S_guide"
    assert figures(numbers) == pytest.approx([0.07, hand.lower + hand.upper], rel=1e-3)
    assert figures(result)[0] == pytest.approx(0.07 * (hand.lower + hand.upper), rel=1e-3)
    lost = table(sheet, "of the input power")
    assert lost.total
    assert lost.caption == "Power lost to friction at this position"
    power = {row[0]: float(row[1]) for row in lost.rows}
    assert power.pop("sum") == pytest.approx(sum(power.values()), rel=2e-3)
    assert power == pytest.approx(
        {n: float(r.power_lost(n)[0]) for n in "OAB"} | {"guide": float(r.power_lost("guide")[0])}, rel=1e-3
    )
    put_in = max(float(r.effort("O")[0]), sum(power.values()) - float(r.effort("O")[0]))
    for name, _, share in lost.rows:
        total = sum(power.values()) if name == "sum" else power[name]
        assert figures(share)[0] == pytest.approx(100 * total / put_in, abs=0.06)
    found = da.efficiency(r)
    (said,) = re.findall(r"Efficiency, without inertia: (.*?)\.(?: |$)", words(sheet) + " ")
    expected = [100 * float(x[0]) for x in (found.forward, found.reverse) if math.isfinite(x[0])]
    assert figures(said)[: len(expected)] == pytest.approx(expected, abs=0.06)


def test_without_friction_nothing_is_said_of_it() -> None:
    r = da.statics(da.load(examples()["four_bar"]))
    assert "Friction" not in [b.text for b in working(r, methods=()).blocks if isinstance(b, Heading)]


def test_what_has_no_mass_has_no_mass_centre() -> None:
    rows = {row[0]: row for row in table(working(da.statics(engine()), methods=()), "Mass").rows}
    assert {row[2:4] for row in rows.values()} == {("massless", "–")}
    norton = table(working(da.statics(da.load(examples()["four_bar"])), methods=()), "Mass").rows
    assert [figures(row[2]) for row in norton] == [
        pytest.approx([m], rel=1e-3) for m in (1.5 / 386, 7.7 / 386, 5.8 / 386)
    ]


def test_a_position_without_an_answer_has_its_reason_only() -> None:
    tree = engine().to_tree()
    tree["drives"] = {"guide": {"position": 1.55, "speed": "1 m/s"}}
    tree["assembly"] = {"crank": 0, "rod": 0}
    r = da.kinematics(da.mechanism(tree))
    assert r.status == ("singular",)
    sheet = working(r)
    assert sheet.blocks[-2:] == [Heading("No answer"), Paragraph(f"singular: {r.reasons[0]}")]
    assert "Checks" not in words(sheet)


@cache
def space(name: str) -> Any:
    return da.dynamics(da.Mechanism.model_validate(MACHINES[name]))


@pytest.mark.parametrize(
    ("name", "said", "unsaid"),
    [
        (
            "rssr",
            ["The 18 coordinates of the 3 links satisfy", "In this order: "],
            ["Teeth", "pitch circles"],
        ),
        ("shaft", ["The 6 coordinates of the link satisfy", "All at once: "], ["Teeth", "pitch circles"]),
    ],
)
def test_the_motion_and_order_in_space(name: str, said: list[str], unsaid: list[str]) -> None:
    found = words(working(space(name), 3, methods=("matrix",)))
    assert all(part in found for part in said), found
    assert not any(part in found for part in unsaid)


def test_wheels_in_space_are_named_and_press_with_one_force() -> None:
    r = da.statics(
        pair(wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], Z, 0.1), [0, 0, -9.0]).with_values(
            {"drives.A.position": 0.3}
        )
    )
    found = words(working(r, methods=("matrix",)))
    assert "The pitch circles of G tie the turns of their wheels." in found
    assert "Teeth press with one force, along their line of pressure" in found
    plane = words(working(da.statics(da.load(examples()["gear_train"])), methods=("matrix",)))
    assert "Teeth press" not in plane


@pytest.mark.parametrize(("count", "there"), [(7, False), (8, True)])
def test_a_cycle_has_eight_positions(count: int, there: bool) -> None:
    r = da.statics(da.load(examples()["four_bar"]), positions=count)
    sheet = working(r, methods=())
    assert ("Over the cycle" in words(sheet)) == there
    if there:
        rows = {row[0]: row for row in table(sheet, "Largest").rows}
        assert list(rows) == ["effort O2", *(f"joint {n}" for n in r.joints)]
        for n in r.joints:
            value, where = r.worst("reaction", n)
            assert figures(rows[f"joint {n}"][1])[0] == pytest.approx(value / 4.4482216152605, rel=1e-3)
            assert rows[f"joint {n}"][2] == str(where + 1)


def test_a_joint_known_at_some_positions_is_in_the_cycle() -> None:
    m = da.load(examples()["four_bar"]).with_values({"links.coupler.points.B": [0.0, 0.14]})
    r = da.statics(m, positions=24)
    assert 0 < sum(s == "ok" for s in r.status) < 24
    from dalembert.reports.report_context import METHODS, ReportContext
    from dalembert.views.notation import Notation, Shown

    sheet = ReportSheet("t")
    cycle(sheet, ReportContext(r, 0, Shown(r, Notation(), 0), METHODS, "", Notation()))
    assert [row[0] for row in table(sheet, "Largest").rows][1:] == [f"joint {n}" for n in r.joints]


@pytest.mark.parametrize(("part", "left"), [(1e-5, 1.0), (-1e-5, -1.0), (1e-11, 0.0)])
def test_a_sum_of_forces_that_is_not_zero_says_what_is_left(part: float, left: float) -> None:
    """Of reactions that are too large by a part, that part of the inertia forces; less than rounding is 0."""
    from dalembert.views.notation import Notation, Shown

    r = da.dynamics(da.load(examples()["four_bar"]), positions=1)
    wrong = replace(r, force_array=r.force_array * (1 + part))
    some, _ = link_equations(wrong, "rocker", 0, Shown(wrong, Notation(), 0))
    inertia = (
        next(a for a in actions(r) if (a.kind, a.link) == ("inertia", "rocker")).force[0] / 4.4482216152605
    )
    for line, force in zip(some, inertia, strict=False):
        total = line.numbers.rpartition(" = ")[2].partition(" ")[0].replace("−", "-")
        assert float(total) == pytest.approx(-left * 1e-5 * force, rel=1e-3)


def test_the_forces_of_eight_joints_are_split_and_the_rest_is_named() -> None:
    from dalembert.reports.report_context import ReportContext
    from dalembert.views.notation import Notation, Shown

    r, sheet = da.solve(da.load(examples()["truss"])), ReportSheet("t")
    superposition(sheet, ReportContext(r, 0, Shown(r, Notation(), 0)))
    shown = [h for b in sheet.blocks if isinstance(b, SheetTable) for h in b.heads if h.startswith("$|F")]
    assert len(shown) == 8
    assert Paragraph("Only the first 8 of 11 joints are shown.") in sheet.blocks


@pytest.mark.parametrize(("speed", "verdict"), [(25.0, "must not be neglected"), (0.5, "could be neglected")])
def test_whether_inertia_could_be_left_out(speed: float, verdict: str) -> None:
    m = da.load(examples()["four_bar"]).with_values({"drives.O2.speed": speed, "drives.O2.acceleration": 0.0})
    r = da.dynamics(m)
    sheet = working(r, methods=())
    (said,) = re.findall(
        r"Inertia (must not be neglected|could be neglected): it accounts for up to (\S+) ?% of", words(sheet)
    )
    assert said[0] == verdict
    assert float(said[1]) == pytest.approx(100 * max(s.share for s in inertia_shares(r)), rel=0.05)


@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_cylindrical_bearing_rubs_by_the_size_of_each_part(speed: float) -> None:
    """The share around the axis is that of a size, whichever way it turns."""
    r = rubbing("rccc") if speed > 0 else None
    if r is None:
        m = rubbing("rccc").mechanism
        r = da.dynamics(m.with_values({"drives.O.speed": -float(rubbing("rccc").drive_speed("O")[0])}))
    some = [t for t in lines(working(r, 2, methods=())) if re.match(r"M_f\S* = .*p_t", t)]
    assert some
    for text in some:
        _, letters, numbers, _ = text.split(" = ")
        assert "|p_t|" in letters
        assert numbers.count("−") == letters.count("−")


def test_one_contact_has_no_number() -> None:
    r = rubbing("rccc")
    names = {t.split(" = ")[0] for t in lines(working(r, 2, methods=())) if t.startswith("S_")}
    for joint in r.joints:
        own = {n for n in names if re.fullmatch(rf"S_{joint}(,\d)?", n)}
        assert own in (set(), {f"S_{joint}"}, {f"S_{joint},1", f"S_{joint},2"})
    assert any("," not in n for n in names)


def test_zero_has_no_sign() -> None:
    beam = da.loads("""
    links: {ground: {points: {A: [0, 0], B: [2, 0]}}, beam: {points: {A: [0, 0], B: [2, 0], C: [1, 0]}}}
    joints:
      A: {type: pin, links: [ground, beam]}
      B: {type: slot, links: [ground, beam]}
    loads: {F: {type: force, on: beam, at: C, value: [0, -30]}}
    """)
    sheet = working(da.statics(beam), methods=("matrix",))
    assert any(re.search(r"\b0\b", t) or " 0 " in t for t in lines(sheet))
    assert not any(re.search(r"[−-] ?0(?![.\d])", t) for t in lines(sheet)), lines(sheet)


def test_a_lone_quote_is_a_letter() -> None:
    assert plain('c "ab"').split() == ["c", "ab"]
    assert plain('"') == '"'
    assert latex('"') == '"'


def without_units(text: str) -> list[str]:
    """Words as with small units, without what rounding leaves."""
    text = re.sub(r"gravity \[.*?\]( m/s2 \([^)]*\))?", "gravity", " ".join(text.split()))
    text = re.sub(r"balance: 0|\d(\.\d)?e-\d\d", "rest", text).replace("balance: rest", "rest")
    return text.replace("km", "mm").replace("kN", "mN").split()


def said(r: Any) -> list[str]:
    """Everything that is printed of a result's methods."""
    alone = [] if r.friction is not None else [superposition_text(r, "file")]
    return [str(da.report(r)), virtual_work_answer(r, "file")[1], *alone]


@pytest.mark.parametrize("friction", [False, True])
def test_the_same_words_are_printed_in_larger_units(friction: bool) -> None:
    small, large = (da.dynamics(plane_machine(Seen(), friction, **units)) for units in (SMALL, LARGE))
    for text, other in zip(said(small), said(large), strict=True):
        assert without_units(other) == without_units(text)


def test_superposition_prints_every_part_and_their_sum() -> None:
    """In the file's units or SI; of several positions the first that has an answer."""
    m = da.load(examples()["four_bar"])
    for r, where in ((da.dynamics(m), ""), (da.dynamics(m, positions=3), " at position 1 of 3")):
        parts = da.superposition(r)
        for units, force, moment in (("file", 4.4482216152605, 4.4482216152605 * 0.0254), ("SI", 1.0, 1.0)):
            title, _, *rows = superposition_text(r, units).split("\n")
            assert title == f"Superposition{where}"
            printed: dict[str, list[float]] = {}
            for name, *numbers in (re.split(r"  +", row) for row in rows):
                if name in (*parts.sources, "sum"):
                    printed.setdefault(name, []).extend(math.nan if x == "-" else float(x) for x in numbers)
            assert list(printed) == [*parts.sources, "sum"]
            xy = np.concatenate([parts.force[:, 0], parts.force[:, 0].sum(axis=0, keepdims=True)]) / force
            effort = np.append(parts.efforts[:, 0, 0], parts.efforts[:, 0, 0].sum()) / moment
            for n, numbers in enumerate(printed.values()):
                size, angle = np.hypot(*xy[n].T), np.arctan2(*xy[n].T[::-1])
                angle = angle if units == "SI" else np.degrees(angle)
                angle = np.where(size > 1e-9 * np.hypot(*xy.T).max(), angle, math.nan)
                row = np.column_stack([xy[n], size, angle]).ravel()
                assert numbers == pytest.approx([effort[n], *row], rel=1e-4, abs=1e-9, nan_ok=True)


def test_powers_are_rounded_beside_what_acts_at_the_machines_length() -> None:
    """Of a very long crank with a large couple a small force is no rounding; of several the position is said."""
    crank = da.loads("""
    links: {ground: {points: {O: [0, 0]}}, crank: {points: {O: [0, 0], A: [1e6, 0]}}}
    joints: {O: {type: pin, links: [ground, crank]}}
    drives: {O: {position: 0}}
    loads:
      F: {type: force, on: crank, at: A, value: [0, 123]}
      T: {type: couple, on: crank, value: 1e9}
    """)
    found = virtual_work_answer(da.statics(crank), "SI")[1]
    (row,) = (line.split() for line in found.split("\n") if line.startswith("F "))
    assert [float(x) for x in row[1:3]] == [0.0, 123.0e-6]  # forces share the power of the large moment
    assert found.startswith("Virtual work\n")
    three = da.statics(crank.with_values({"drives.O.position": [0.0, 0.1, 0.2]}))
    assert virtual_work_answer(three, "SI")[1].startswith("Virtual work at position 1 of 3\n")


def test_of_inertia_off_the_diagonal_the_sign_is_said() -> None:
    minus = "off the diagonal J holds the products with a minus"
    for name, there in (("shaft", True), ("rssr", False)):
        captions = [
            b.caption for b in working(space(name), 3, methods=()).blocks if isinstance(b, SheetTable)
        ]
        assert any(minus in c for c in captions) == there


def test_moments_clockwise_are_of_the_plane() -> None:
    clockwise = da.Notation(torque=-1)
    with pytest.raises(da.ModelError, match="moments cannot be counted clockwise in space"):
        working(space("rssr"), 3, methods=(), notation=clockwise)
    assert working(da.statics(engine()), methods=(), notation=clockwise).blocks


@pytest.mark.parametrize(("angle", "there"), [("rad", False), ("deg", True)])
def test_rates_of_a_mesh_are_in_radians(angle: str, there: bool) -> None:
    tree = da.load(examples()["gear_train"]).to_tree()
    tree["units"] = {"length": "mm", "angle": angle, "angular_speed": "rad/s" if angle == "rad" else "deg/s"}
    tree["drives"]["sun_bearing"]["position"] = "10 deg"
    tree.pop("answers")
    sheet = working(da.dynamics(da.mechanism(tree)), methods=())
    meshes = [b.text for b in sheet.blocks if isinstance(b, Paragraph) and b.text.startswith("Mesh ")]
    assert len(meshes) == 2
    assert all((", rates in radians" in text) == there for text in meshes)


def test_every_part_of_superposition_in_space_has_one_column() -> None:
    sheet = working(space("rssr"), 3, methods=("superposition",))
    tables = [b for b in sheet.blocks if isinstance(b, SheetTable) and b.heads[0] == "Source"]
    heads = [head for b in tables for head in b.heads[1:]]
    assert len(heads) == len(set(heads)) >= 13
    assert all(b.total and b.rows[-1][0] == "sum" for b in tables)


def test_powers_in_space_are_those_of_a_moving_position() -> None:
    r = space("rssr")
    moving = working(r, 3, methods=("virtual-work",))
    powers = table(moving, "Power put in by")
    values = {row[0]: figures(row[1])[0] for row in powers.rows}
    assert values.pop("sum") == pytest.approx(0.0, abs=1e-6)
    assert set(values) >= {"drives", "loads", "inertia", "weights"}
    assert values["drives"] == pytest.approx(float(r.effort("A")[2] * r.drive_speed("A")[2]), rel=1e-3)


def test_joint_moments_in_space_are_split_too_and_gaps_are_of_solved_positions() -> None:
    heads = superposition_text(space("rssr"), "SI").split()
    assert {"mx", "my", "mz"} <= set(heads)
    m = da.load(examples()["four_bar"]).with_values({"links.coupler.points.B": [0.0, 0.14]})
    words = " ".join(virtual_work_answer(da.statics(m, positions=24), "SI")[1].split())
    assert "The solution of the equations agrees within " in words


@pytest.mark.parametrize("without", [False, True])
def test_files_are_checked_with_or_without_friction(without: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    monkeypatch.setattr(
        check_command, "_compare", lambda files, changes: (asked.append(changes.no_friction) or [], 0)
    )
    assert main(["check", str(examples()["four_bar"]), *(["--no-friction"] if without else [])]) == 0
    assert asked == [without]
