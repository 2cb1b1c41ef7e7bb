"""What keeps a set of values out, at each limit from both sides; and that every set is drawn once."""

from __future__ import annotations

import random
from itertools import islice
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.exams.asked import ExpectedValue, blanks, figure, key_value, requested_quantities, stated_value
from dalembert.exams.candidates import (
    ASIDE,
    CLEAR,
    SMALL,
    Candidate,
    Unfit,
    _beside,
    candidate,
    difference,
    figure_size,
)
from dalembert.exams.choices import Choices
from dalembert.exams.exam_folder import _strange, check_folder
from dalembert.exams.variants import _draws, _Pool
from dalembert.model import Answer


@pytest.fixture(scope="module")
def solved() -> tuple[Any, Any, Any]:
    m = da.four_bar().with_values({"drives.O2.position": 1.0, "loads.torque.value": 7.0})
    r = da.dynamics(m)
    return m, r, requested_quantities(r, ["effort.O2", "reaction.A"], None)


def made(
    solved: tuple[Any, Any, Any], scale: float = 1.0, mistakes: dict[str, float] | None = None
) -> Candidate:
    m, r, asked = solved
    figures = tuple(f._replace(value=f.value * scale) for f in (figure(r, a) for a in asked))
    return Candidate({}, m, r, figures, mistakes or {})


def test_the_size_of_a_figure_and_how_far_another_one_is(solved: tuple[Any, Any, Any]) -> None:
    effort, force = made(solved).figures
    assert figure_size(force) == pytest.approx(float(np.hypot(*force.value)))
    assert difference(effort, effort.value * 1.25) == pytest.approx(0.25)
    assert difference(force, -force.value) == pytest.approx(2.0)


@pytest.mark.parametrize(("part", "which"), [(0.99 * SMALL, 0), (1.01 * SMALL, None)])
def test_a_figure_is_near_zero_beside_its_usual_size(
    part: float, which: int | None, solved: tuple[Any, Any, Any]
) -> None:
    one = made(solved)
    sizes = [figure_size(f) for f in one.figures]
    assert one.near_zero([sizes[0] / part, sizes[1]]) == which
    assert one.near_zero([sizes[0], sizes[1] / part]) == (None if which is None else 1)
    angle = one.figures[0]._replace(kind="angle")
    bare = Candidate({}, one.mechanism, one.result, (angle,), {})
    assert bare.near_zero([sizes[0] / part]) is None


@pytest.mark.parametrize(
    ("scale", "same"), [(1.0049, True), (0.9951, True), (1.0051, False), (0.9949, False)]
)
def test_figures_are_those_of_another_within_the_tolerance(
    scale: float, same: bool, solved: tuple[Any, Any, Any]
) -> None:
    assert made(solved).same(made(solved, scale), 0.005) is same
    one, other = made(solved), made(solved)
    moved = Candidate({}, one.mechanism, one.result, (one.figures[0], made(solved, scale).figures[1]), {})
    assert other.same(moved, 0.005) is same


def test_a_mistake_is_clear_or_hidden_by_tolerances(solved: tuple[Any, Any, Any]) -> None:
    one = made(solved, mistakes={"a": CLEAR * 1.01, "b": CLEAR * 0.99, "c": 1.01, "d": 0.99, "e": 1.0})
    assert one.clear == ["a"]
    assert one.hidden(["f", "e", "d", "c", "b", "a"]) == ["d", "e", "f"]


def test_a_mistake_is_usual_where_most_show_it(solved: tuple[Any, Any, Any]) -> None:
    pool = _Pool(solved[0], solved[2], 0.005, False)
    for k, scale in enumerate((1.0, 2.0, 3.0, 10.0)):
        mistakes = {"all": 9.0, "half": 9.0 * (k < 2), "most": 9.0 * (k < 3)}
        pool.tried.append(made(solved, scale, mistakes))
    sizes, often = pool._usual()
    assert often == ["all", "most"]
    assert sizes == pytest.approx([2.5 * figure_size(f) for f in made(solved).figures])
    assert pool.sound(9) == pool.tried[:3]  # the last hides what most show
    pool._sound = None
    assert pool.sound(2) == pool.tried[:2]


def test_beside_a_position_the_drive_is_a_little_before_and_behind(solved: tuple[Any, Any, Any]) -> None:
    m, r, _ = solved
    sizes = _beside(r, 0, "O2", False)
    own = []
    for step in (-ASIDE["turn"], 0.0, ASIDE["turn"]):
        s = da.dynamics(
            m.with_values(
                {"drives.O2.position": 1.0 + step, "assembly": {k: float(r.angle(k)[0]) for k in r.links}}
            )
        )
        own.append(max(float(np.hypot(*s.reaction(j)[0])) for j in s.joints))
    assert sizes == pytest.approx(own)


@pytest.mark.parametrize("static", [False, True])
def test_beside_each_position_of_a_turn_it_is_on_the_same_branch_at_its_speed(static: bool) -> None:
    """Crossed, and faster and faster: the middle one of the three is the position itself."""
    turn = np.arange(8) * np.pi / 4 + 0.1
    tree = da.four_bar(positions=1).to_tree() | {"assembly": {"coupler": "-60 deg", "rocker": "-100 deg"}}
    m = da.mechanism(tree).with_values({"loads.torque.value": 3.0})
    rates = {"speed": [5.0 + k for k in range(8)], "acceleration": [3.0 * k for k in range(8)]}
    m = m.with_values({"drives.O2": {"position": turn.tolist(), **rates}})
    r = da.statics(m) if static else da.dynamics(m)
    for k in range(8):
        largest = max(float(np.hypot(*r.reaction(j)[k])) for j in r.joints)
        assert _beside(r, k, "O2", static)[1] == pytest.approx(largest, rel=1e-7)


def test_what_is_not_sound_is_left_out_with_its_reason(solved: tuple[Any, Any, Any]) -> None:
    m, _, asked = solved
    with pytest.raises(Unfit, match="the problem cannot be solved: "):
        candidate(m, {"links.crank.mass": "-1 kg"}, asked)
    with pytest.raises(Unfit, match=r"cannot|close|assembled"):
        candidate(m, {"links.coupler.points.B": [0.02, 0.0]}, asked)
    good = candidate(m, {"loads.torque.value": 9.0}, asked, near=0.005)
    wide = candidate(m, {"loads.torque.value": 9.0}, asked, near=0.01)
    assert good.mistakes.keys() == wide.mistakes.keys()
    for name, by in good.mistakes.items():
        assert wide.mistakes[name] == pytest.approx(by / 2)
    (opposite,) = (by for name, by in good.mistakes.items() if name.startswith("the sense is opposite"))
    assert opposite == pytest.approx(2 / 0.005)


def test_every_set_of_values_is_drawn_once_in_an_order_of_the_seed() -> None:
    choices = [Choices("a", (1, 2, 3)), Choices("b", (4, 5)), Choices("c", (6, 7, 8, 9))]
    drawn = [tuple(v.values()) for v in _draws(choices, 24, random.Random(5))]
    assert len(set(drawn)) == len(drawn) == 24
    assert {x for x, _, _ in drawn} == {1, 2, 3}
    assert drawn != sorted(drawn)
    few = [tuple(v.values()) for v in islice(_draws(choices, 24, random.Random(5)), 7)]
    assert few == drawn[:7]
    firsts = [next(_draws(choices, 24, random.Random(seed)))["c"] for seed in range(400)]
    assert np.bincount(firsts)[6:].min() > 70  # each equally likely


def test_a_key_names_the_file_of_each_variant() -> None:
    m = da.mechanism(
        {
            "title": "An arm",
            "links": {"ground": {"points": {"O": [0, 0]}}, "arm": {"points": {"O": [0, 0], "P": [2, 0]}}},
            "joints": {"O": {"type": "weld", "links": ["ground", "arm"]}},
            "loads": {"F": {"type": "force", "on": "arm", "at": "P", "value": 100, "direction": "30 deg"}},
        }
    )
    vary = {"loads.F.value": [100.0 * 1.02**k for k in range(6)]}
    some = da.variants(m, vary, count=3, seed=1, ask=["reaction.O"])
    assert [v.name for v in some] == ["01", "02", "03"]
    assert repr(some) == f"<3 variants of {some[0].mechanism.title!r}, seed 1>"
    rows = some.key("problems")
    assert (rows[0]["variant"], rows[0]["file"]) == ("01", "problems/01.yaml")
    assert some.key()[0]["file"] == "01.yaml"
    assert [v.name for v in some[1:3]] == ["02", "03"]


def test_a_figure_is_the_value_asked_for(solved: tuple[Any, Any, Any]) -> None:
    _, r, asked = solved
    effort, force = (figure(r, a) for a in asked)
    assert isinstance(effort, ExpectedValue)
    assert (effort.kind, force.kind) == ("moment", "force")
    assert effort.value == pytest.approx(r.effort("O2")[0])
    assert force.value == pytest.approx(r.reaction("A")[0])


def test_what_is_asked_for_where_nothing_is_named() -> None:
    """Efforts, unknown loads and reactions that are not zero throughout; of many positions the one named."""
    arm = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"O": [0, 0], "Q": [0, 1]}},
            "arm": {"points": {"O": [0, 0], "P": [2, 0]}},
            "idle": {"points": {"Q": [0, 0], "R": [1, 0]}},
        },
        "joints": {
            "O": {"type": "pin", "links": ["arm", "ground"]},
            "Q": {"type": "pin", "links": ["ground", "idle"]},
        },
        "drives": {"O": {"position": ["0 deg", "20 deg", "40 deg"]}, "Q": {"position": "0 deg"}},
        "loads": {"F": {"type": "force", "on": "arm", "at": "P", "value": [0, -100]}},
    }
    r = da.statics(da.mechanism(arm))

    def rows(asked: Any) -> list[tuple[Any, ...]]:
        return [(a.quantity, a.of, a.on, a.by, a.at, a.extreme) for a in asked]

    efforts = [("effort", d, None, None, 1, None) for d in ("O", "Q")]
    force = ("reaction", "O", "arm", None, 1, None)
    assert rows(requested_quantities(r, [], None)) == [*efforts, force]
    assert rows(requested_quantities(r, ["efforts"], "2")) == [(*e[:4], 2, None) for e in efforts]
    assert rows(requested_quantities(r, ["reactions", "reactions"], None)) == [force]
    by = {"quantity": "reaction", "of": "O", "by": "arm"}
    assert rows(requested_quantities(r, [by], 3)) == [("reaction", "O", "ground", None, 3, None)]
    assert rows(requested_quantities(r, [{**by, "by": "ground", "extreme": "max"}], 3))[0][2:] == (
        *("arm", None, None),
        "max",
    )
    assert rows(requested_quantities(r, ["reaction.Q"], None))[0][:3] == ("reaction", "Q", "idle")
    one = da.statics(r.mechanism.with_values({"drives.O.position": "20 deg"}))
    assert {a.at for a in requested_quantities(one, [], None)} == {None}
    for ask, said in (
        ("torque.O", "unknown quantity 'torque'"),
        ("effort", "does not say of what; write"),
    ):
        with pytest.raises(da.ModelError, match=f"--ask {ask}.*{said}"):
            requested_quantities(r, [ask], None)


_DEG, _XYZ = ("direction", "°"), tuple((name, "mm") for name in "xyz")
_THREE = tuple((f"row {k}", "mm") for k in (1, 2, 3))
_ROWS = [["1000.0" if k == row else "0.0" for k in range(3)] for row in range(3)]


@pytest.mark.parametrize(
    ("value", "key", "stated", "blank"),
    [
        (2.5, "2500.0", "2500.0 mm", (("", "mm"),)),
        ([-3.0, 4.0], "5000.0 @ 126.86989764584", "5000.0 @ 126.86989764584 mm", (("size", "mm"), _DEG)),
        ([1.0, 0.0, -2.0], "[1000.0, 0.0, -2000.0]", ["1000.0 mm", "0.0 mm", "-2000.0 mm"], _XYZ),
        (np.eye(3), f"[{', '.join('[' + ', '.join(x) + ']' for x in _ROWS)}]", None, _THREE),
    ],
)
def test_a_figure_in_a_key_and_its_blanks(value: Any, key: str, stated: object, blank: object) -> None:
    """Millimetres; all digits; vectors in the plane by size and direction."""
    found = ExpectedValue("length", np.array(value))
    units = da.four_bar().with_values({"units": {"length": "mm", "force": "N"}}).units
    assert key_value(found, units) == key
    assert stated_value(found, units) == stated
    assert blanks(Answer(quantity="point", of="rod.P"), found, units) == blank


@pytest.mark.parametrize(
    ("path", "strange"),
    [
        *((p, "") for p in ("variants.json", "key.csv", "key.json", "problems", "solutions/01.html")),
        *((p, "") for p in ("problems/01.yaml", "problems/parts/box.STL", "answers/12.csv")),
        *((p, p) for p in ("notes.txt", "problems/a.yaml", "problems/01.txt", "answers/01.yaml")),
        *(
            (p, p)
            for p in ("key/01.csv", "questions/parts/01.pdf", "problems/parts/notes.txt", "answers/b.stl")
        ),
    ],
)
def test_what_is_strange_in_a_folder_of_variants(path: str, strange: str, tmp_path: Any) -> None:
    (tmp_path / "variants.json").write_text("{}")
    (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / path).mkdir(exist_ok=True) if path == "problems" else (tmp_path / path).touch()
    found = _strange(tmp_path)
    assert bool(found) == bool(strange)
    assert strange.startswith(found)
    (tmp_path / "variants.json").unlink()
    left = sorted(p.name for p in tmp_path.iterdir())
    assert not left or _strange(tmp_path) == left[0]


def test_beside_a_position_only_where_drives_are_numbers(solved: tuple[Any, Any, Any]) -> None:
    """Where one of two drives follows a law, no place beside it is looked at; in space all of a force counts."""
    two = da.load(examples()["two_drives"])
    r = da.solve(two)
    assert len(_beside(r, 0, r.drives[0], False)) == 3
    text = examples()["two_drives"].read_text(encoding="utf-8")
    law = "{law: {type: harmonic, from: 120, to: 95, duration: 1 s, count: 5}}"
    s = da.solve(da.loads(text.replace("{position: [120, 115, 105, 90, 95]}", law)))
    assert s.ok.all()
    assert _beside(s, 1, r.drives[0], False) == []
    m = da.load(examples()["rssr"])
    space = da.dynamics(m, positions=4)
    sizes = _beside(space, 1, "O", False)
    largest = max(float(np.linalg.norm(space.reaction(j)[1])) for j in space.joints)
    assert sizes[1] == pytest.approx(largest, rel=1e-6)
    with pytest.raises(da.ModelError, match="seed"):
        da.variants(solved[0], {"loads.torque.value": [7.0, 8.0, 9.0]}, count=1, seed=-1)


def test_a_mistake_counts_at_the_position_that_is_asked(solved: tuple[Any, Any, Any]) -> None:
    """Of a figure at one position and a largest one: every position is solved wrongly, each figure at its own."""
    m = da.four_bar(positions=5)
    r = da.dynamics(m)
    asked = requested_quantities(r, [{"quantity": "effort", "of": "O2", "extreme": "max"}, "effort.O2"], 3)
    both = candidate(m, {}, asked)
    k = int(np.argmax(r.effort("O2")))
    assert [float(f.value) for f in both.figures] == pytest.approx([r.effort("O2")[k], r.effort("O2")[2]])
    alone = [candidate(m, {}, [a]).mistakes for a in asked]
    for sentence in both.mistakes:
        assert both.mistakes[sentence] == pytest.approx(max(x.get(sentence, 0.0) for x in alone))
    (half,) = (v for s, v in alone[1].items() if s.startswith("the sense is opposite"))
    assert half > CLEAR


def test_beside_a_position_without_forces_nothing_grows() -> None:
    """A linkage without masses and loads: neither a size nor its growth says anything."""
    still = {
        f"links.{link}.{key}": 0.0 for link in ("crank", "coupler", "rocker") for key in ("mass", "inertia")
    }
    m = da.four_bar(positions=1).with_values(still | {"loads.torque.value": 0.0})
    assert _beside(da.dynamics(m), 0, "O2", False) == []
    assert len(_beside(da.dynamics(m.with_values({"loads.torque.value": 1.0})), 0, "O2", False)) == 3


@pytest.mark.parametrize("ask", [(), ["efforts"], ["reactions"]])
def test_at_rest_both_ends_of_an_effort_are_asked_and_no_reaction(ask: list[str]) -> None:
    r = da.solve(da.load(cases()["seed-002-7d-engine-at-rest"]))
    assert [(a.quantity, a.of) for a in requested_quantities(r, ask, None)] == [
        ("effort_low", "O"),
        ("effort_high", "O"),
    ]


def test_an_answer_is_asked_as_it_is_and_where_there_is_no_force_nothing() -> None:
    tree: dict[str, Any] = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "arm": {"points": {"O": [0, 0], "P": [2, 0]}}},
        "joints": {"O": {"type": "weld", "links": ["ground", "arm"]}},
        "loads": {"F": {"type": "force", "on": "arm", "at": "P", "value": [3, 0]}},
    }
    r = da.statics(da.mechanism(tree))
    answer = Answer(quantity="moment", of="O", by="arm")
    (asked,) = requested_quantities(r, [answer, answer], None)
    assert asked == Answer(quantity="moment", of="O", on="ground")
    tree["loads"]["F"]["value"] = [0, 0]
    said = (
        "there is nothing to ask: no effort, no unknown load and no reaction; write effort.O2, reaction.A, "
    )
    with pytest.raises(da.ModelError, match=f"^{said}"):
        requested_quantities(da.statics(da.mechanism(tree)), (), None)


def test_beside_a_slide_the_force_counts_and_no_moment() -> None:
    """A guide's moment in N m is larger by far than its force in N, and is no part of it."""
    block: dict[str, Any] = {
        "gravity": "none",
        "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"B": [0, 0], "P": [0, 50]}}},
        "joints": {"guide": {"type": "slider", "links": ["ground", "block"], "at": ["O", "B"]}},
        "drives": {"guide": {"position": 0.4}},
        "loads": {"F": {"type": "force", "on": "block", "at": "P", "value": [-30, -4]}},
    }
    r = da.statics(da.mechanism(block))
    assert abs(float(r.reaction_moment("guide")[0])) == pytest.approx(1500)
    assert _beside(r, 0, "guide", True) == pytest.approx([4.0, 4.0, 4.0])


def test_reactions_that_are_rounding_or_not_unique_are_not_asked() -> None:
    """A bar held at both ends: along it nobody can say what each end carries; a bar without a load carries none."""
    held: dict[str, Any] = {
        "gravity": "none",
        "links": {
            "ground": {"points": {"A": [0, 0], "B": [2, 0], "C": [0, 1]}},
            "bar": {"points": {"A": [0, 0], "B": [2, 0], "P": [0.7, 0]}},
            "arm": {"points": {"C": [0, 0], "Q": [1, 0.3]}},
            "block": {"points": {"A": [0, 0]}},
        },
        "joints": {
            "A": {"type": "pin", "links": ["ground", "bar"]},
            "B": {"type": "pin", "links": ["bar", "ground"]},
            "C": {"type": "pin", "links": ["ground", "arm"]},
            "D": {"type": "slider", "links": ["ground", "block"], "at": "A", "direction": 0},
        },
        "drives": {"C": {"position": 0.3}, "D": {"position": 0.1}},
        "loads": {
            "F": {"type": "force", "on": "bar", "at": "P", "value": [0, -100]},
            "G": {"type": "force", "on": "arm", "at": "Q", "value": [7, 0]},
            "H": {"type": "force", "on": "arm", "at": "Q", "value": [-7, 3e-12]},
            "M": {"type": "couple", "on": "block", "value": 50},
        },
    }
    r = da.statics(da.mechanism(held))
    assert r.unique("A").any()
    assert not r.unique("A").all()
    assert 0 < float(np.hypot(*r.reaction("C")[0])) < 1e-10
    assert r.reaction_moment("D")[0] == pytest.approx(-50)  # and a guide that carries a couple alone no force
    assert [a.quantity for a in requested_quantities(r, [], None)] == ["effort", "effort"]
    large = da.statics(r.mechanism.with_values({"loads.H.value": [-7, 0.01]}))
    assert [a.of for a in requested_quantities(large, ["reactions"], None)] == ["C"]


def test_of_several_strange_files_the_first_by_its_name_is_said(tmp_path: Any) -> None:
    (tmp_path / "variants.json").write_text("{}")
    for k in range(30):
        (tmp_path / f"notes{(7 * k) % 30:02d}.txt").touch()
    with pytest.raises(da.ModelError, match=r"has notes00\.txt, which would be lost"):
        check_folder(tmp_path, overwrite=True)
    (tmp_path / "variants.json").unlink()
    with pytest.raises(da.ModelError, match=r"has notes00\.txt"):
        check_folder(tmp_path, overwrite=True)


def test_a_rotation_has_no_opposite_sense() -> None:
    m = da.load(examples()["rssr"]).with_values({"drives.O.position": "1 rad", "drives.O.speed": "0 rad/s"})
    rotation = requested_quantities(da.statics(m), [{"quantity": "rotation", "of": "rod"}], None)
    mistakes = candidate(m, {}, rotation, static=True).mistakes
    assert mistakes
    assert not any("sense is opposite" in sentence for sentence in mistakes)
