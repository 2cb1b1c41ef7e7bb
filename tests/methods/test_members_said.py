"""Members, their reasons in words, the power through them, and names of quantities taken apart."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.members import Member, Share, _tension
from dalembert.analysis.methods.power_flow import PowerFlow, _skew
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result import named_quantities as named
from dalembert.analysis.result import transmission_lines as lines
from dalembert.analysis.result.link_motion import place_of
from dalembert.errors import ModelError
from dalembert.printing import TextTable

NAN = math.nan


def member(kind: str, forces: Any = ("A", "B"), couples: Any = (), circles: Any = ()) -> Member:
    return Member("rod", kind, tuple(forces), tuple(couples), None, tuple(circles))


TANGENT = "both forces lie on one common tangent of the friction circles at A, B"
ONE_LINE = (
    "both forces lie on one line, which touches the friction circle at A and passes the other pin's centre"
)


@pytest.mark.parametrize(
    ("of", "touching"),
    [
        (member("two-force"), ""),
        (member("two-force", circles="AB"), TANGENT),
        (member("two-force", circles="A"), ONE_LINE),
        (member("three-force", "ABC", circles="A"), "the reaction touches the friction circle at A"),
        (
            member("three-force", "ABC", circles="ABC"),
            "each reaction touches the friction circles at A, B, C",
        ),
        (
            member("three-force", ["A", "B", "F"], circles="AB"),
            "not a two-force member, as F acts too: each reaction touches the friction circles at A, B, "
            "on different lines",
        ),
        (
            member("general", ["A", "weight", "B", "F"], ["A", "T"], "AB"),
            "not a two-force member, as weight and F and torque A and T act too: each reaction touches the "
            "friction circles at A, B, on different lines",
        ),
        (member("general", "AB", ["T"], "AB"), "each reaction touches the friction circles at A, B"),
    ],
)
def test_friction_circles_say_how_the_lines_of_reactions_lie(of: Member, touching: str) -> None:
    assert of.touching == touching
    if touching:
        assert of.sentence.endswith(f"; {touching}")


@pytest.mark.parametrize(
    ("of", "sentence"),
    [
        (member("zero-force"), "rod: zero-force member (nothing in A, B; no couple)"),
        (member("zero-force", ()), "rod: zero-force member (nothing in no joint; no couple)"),
        (member("two-force"), "rod: two-force member (forces: A, B; no couple)"),
        (member("general", (), ["T", "O"]), "rod: general member (forces: no force; couples: T, O)"),
    ],
)
def test_a_member_says_which_forces_and_couples_it_has(of: Member, sentence: str) -> None:
    assert of.sentence == sentence


def test_the_pull_of_a_two_force_member_is_from_its_first_point_to_its_second() -> None:
    ends: Any = [
        SimpleNamespace(at=np.array([[0.0, 1.0]] * 3), force=None),
        SimpleNamespace(
            at=np.array([[4.0, 4.0]] * 3), force=np.array([[8.0, 6.0], [-8.0, -6.0], [-3.0, 4.0]])
        ),
    ]
    assert _tension(ends).tolist() == [10.0, -10.0, 0.0]
    pulled = Member("rod", "two-force", ("A", "B"), (), np.array([10.0, -10.0, 0.0, NAN]))
    assert [pulled.state(k) for k in range(4)] == ["tension", "compression", "", ""]
    assert member("general").state(0) == ""


def test_a_share_of_inertia_is_over_the_whole() -> None:
    assert Share("O", "effort", 8.0, 6.0).share == 0.75
    assert Share("O", "effort", 0.0, 6.0).share == 0.0


# power


def flow(**more: Any) -> PowerFlow:
    """Two positions of a machine with a motor, a load, a joint that loses, and a mesh."""
    ends = {"A": ("ground", "crank"), "G": ("crank", "gear")}
    joints = {name: SimpleNamespace(links=links) for name, links in ends.items()}
    result: Any = SimpleNamespace(
        status=("ok", "ok"), mechanism=SimpleNamespace(units={"length": "m"}, joints=joints)
    )
    values: dict[str, Any] = {
        "sources": {"O": [9.0, -2.0], "F": [-6.0, 5.0], "weight": [-1.0, 1.0]},
        "through": {"A": [[0.0, 0.0], [2.0, 2.0]], "G": [[8.0, 6.0], [-3.0, -7.0]]},
        "links": {"crank": [12.0, 3.0], "gear": [5.0, 7.0]},
        "meshes": {"G": [30.0, 4.0]},
    } | more
    parts = {word: {n: np.array(of) for n, of in some.items()} for word, some in values.items()}
    return PowerFlow(result, **parts)


def test_power_in_and_out_is_by_the_sign_of_its_sources() -> None:
    f = flow()
    assert f.input.tolist() == [9.0, 6.0]
    assert f.output.tolist() == [7.0, 2.0]
    assert f.lost.tolist() == [2.0, 4.0]
    assert f.rolling.tolist() == [30.0, 4.0]
    assert f.circulating.tolist() == [3.0, 1.0]
    still = flow(links={"crank": [9.0, 6.0 * (1 + 2e-9)]}, meshes={})
    assert still.rolling.tolist() == [0.0, 0.0]
    assert still.circulating == pytest.approx([0.0, 1.2e-8], rel=1e-3)


def test_columns_of_power_are_named_by_source_link_mesh_and_joint() -> None:
    found = {c.name: (c.kind, np.asarray(c.values).tolist()) for c in flow().columns()}
    assert list(found) == [
        *("source.O", "source.F", "source.weight", "link.crank", "link.gear", "rolling.G"),
        *("out_of_i.A", "into_j.A", "out_of_i.G", "into_j.G"),
        *("input", "output", "lost", "circulating"),
    ]
    assert {kind for kind, _ in found.values()} == {"power"}
    assert found["out_of_i.G"][1] == [8.0, -3.0]
    assert found["into_j.G"][1] == [6.0, -7.0]
    assert found["link.gear"][1] == [5.0, 7.0]
    assert found["lost"][1] == [2.0, 4.0]
    assert flow().record(Printed(None)) == {
        "power_flow": {"input": 9.0, "output": 7.0, "lost": 2.0, "rolling": 30.0, "circulating": 3.0}
    }


def test_printed_power_is_that_of_the_first_position() -> None:
    sources, joints, links, circulates, rolls = flow().contents("SI")
    assert isinstance(sources, TextTable)
    assert isinstance(joints, TextTable)
    assert isinstance(links, TextTable)
    assert sources.rows == [["O", "9"], ["F", "-6"], ["weight", "-1"]]
    assert sources.heads == ["source", "puts in\nW"]
    assert joints.rows == [["G", "crank", "gear", "8", "6", "2", "30"]]
    assert links.rows == [["crank", "12"], ["gear", "5"]]
    assert circulates == "Power circulates: crank carries 1.333 times the power that is put in."
    assert rolls == "The teeth of G roll with 3.333 times the power that is put in, and lose a part of that."
    quiet = flow(links={"crank": [9.0, 3.0], "gear": [0.0, 1.0]}, meshes={"G": [9.0, 0.0]})
    parts = list(quiet.contents("SI"))
    assert len(parts) == 3
    assert isinstance(parts[2], TextTable)
    assert parts[2].rows == [["crank", "9"]]
    plain = list(flow(links={}, meshes={}, sources={"O": [9.0, 0.0], "F": [8e-12, 0.0]}).contents("file"))
    assert isinstance(plain[0], TextTable)
    assert plain[0].rows == [["O", "9"], ["F", "0"]]
    assert isinstance(plain[1], TextTable)
    assert plain[1].rows[0][-1] == "-"


def test_a_skew_matrix_makes_the_velocity_of_an_arm() -> None:
    w, v = np.array([[2.0, -3.0, 5.0]]), np.array([[7.0, 11.0, -13.0]])
    assert (_skew(v)[0] @ w[0]).tolist() == np.cross(w[0], v[0]).tolist()


# names


def test_components_of_vectors_and_matrices_are_by_letters() -> None:
    vector = np.array([[3.0, -4.0], [5.0, 12.0]])
    parts = dict(named.components(vector))
    assert list(parts) == ["x", "y", "magnitude", "direction"]
    assert parts["y"].tolist() == [-4.0, 12.0]
    assert parts["magnitude"].tolist() == [5.0, 13.0]
    assert parts["direction"] == pytest.approx([math.atan2(-4, 3), math.atan2(12, 5)])
    matrix = np.arange(18.0).reshape(2, 3, 3)
    parts = dict(named.components(matrix))
    assert list(parts) == [a + b for a in "xyz" for b in "xyz"]
    assert parts["yz"].tolist() == [5.0, 14.0]
    space = dict(named.components(np.array([[2.0, 3.0, 6.0]])))
    assert list(space) == ["x", "y", "z", "magnitude"]
    assert space["magnitude"].tolist() == [7.0]
    assert dict(named.components(np.array([1.0, 2.0]))) == {}
    assert list(dict(named.components(np.array([1.0, 2.0]), 0))) == ["x", "y", "magnitude", "direction"]
    assert named.component(vector, "") is vector
    for values, name, sentence in (
        (vector, "reaction.A.z", "reaction.A has no component 'z'"),
        (np.array([1.0]), "x", "a number has no component 'x'"),
    ):
        with pytest.raises(ModelError) as raised:
            named.component(values, name[-1], name)
        assert raised.value.what == sentence


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("reaction.A", ("reaction", "A", "", "")),
        ("reaction.A.x", ("reaction", "A", "", "x")),
        ("angle.coupler.speed", ("angle", "coupler", "speed", "")),
        ("point.coupler.B.velocity.y", ("point", "coupler.B", "velocity", "y")),
        ("shaking_force.x", ("shaking_force", "", "", "x")),
        ("shaking_force", ("shaking_force", "", "", "")),
        ("shaking_force.size", None),
        ("reaction.Q", None),
        ("reaction.A.x.y", None),
        ("reaction.A.1x", None),
        ("nothing.A", None),
    ],
)
def test_a_name_is_a_word_a_thing_a_rate_and_a_component(name: str, parts: Any) -> None:
    r = da.statics(da.four_bar(positions=2))
    assert named.split_name(r, name) == (None if parts is None else named.QuantityName(*parts))


def test_paths_of_a_file_are_found_in_an_expression() -> None:
    m = da.four_bar(positions=2)
    text = "2*links.coupler.mass - x.links.rod.mass + loads.torque.value/joints.Q.at.0"
    assert named.file_paths(m, text) == ["links.coupler.mass", "loads.torque.value", "joints.Q.at.0"]
    r = da.statics(m)
    assert r["2*links.coupler.mass"] == pytest.approx([1.2, 1.2])
    for name, sentence in (
        (
            "1*links.coupler.center",
            "'links.coupler.center' is not a single number; name one, as links.coupler.center.0 of a vector",
        ),
        (
            "1*reaction.A",
            "reaction.A is a vector; an expression needs numbers; write reaction.A.x or reaction.A.magnitude",
        ),
    ):
        with pytest.raises(ModelError) as raised:
            r[name]
        assert str(raised.value) == sentence
    with pytest.raises(ModelError) as raised:
        place_of(("A", "B"), "C", "joint")
    assert str(raised.value) == "unknown joint 'C'; choose among A, B"
    with pytest.raises(ModelError, match="choose among none"):
        place_of((), "C", "joint")
    assert place_of(("A", "B"), "B", "joint") == 1


# transmission


def line(slides: bool = False) -> lines.LinkLine:
    return lines.LinkLine("rod", np.zeros(2), slides)


def test_a_transmission_angle_is_acute() -> None:
    a = np.array([[2.0, 0.0], [2.0, 0.0], [3.0, 4.0], [1.0, 0.0]])
    b = np.array([[3.0, 3.0], [-3.0, 3.0], [4.0, -3.0], [-1.0, -1e-3]])
    angles = np.degrees(lines.transmission_angle(a, b, (line(), line())))
    assert angles == pytest.approx([45.0, 45.0, 90.0, math.degrees(math.atan(1e-3))])


def test_a_closure_margin_is_the_least_way_to_stretched_or_folded() -> None:
    a, b = np.array([[3.0, 0.0]] * 3), np.array([[0.0, 4.0], [-3.9, 0.5], [4.0, 0.5]])
    d = np.linalg.norm(a - b, axis=1)
    two = np.linalg.norm(b, axis=1)
    expected = np.minimum(3 + two - d, d - np.abs(3 - two))
    assert lines.closure_margin(a, b, (line(), line())) == pytest.approx(expected)
    assert expected[0] == 2.0
    unit = np.array([[0.6, 0.8]])
    arm = np.array([[5.0, -10.0]])
    margin = math.hypot(5, 10) - 5.0
    assert lines.closure_margin(unit, arm, (line(True), line())) == pytest.approx([margin])
    assert lines.closure_margin(arm, unit, (line(), line(True))) == pytest.approx([margin])
    with pytest.raises(ModelError) as raised:
        lines.closure_margin(unit, unit, (line(True), line(True)))
    assert str(raised.value) == (
        "a pin between two links that slide has no closure margin; take its transmission angle"
    )


def test_lines_of_a_pin_go_to_the_other_joints_of_its_links() -> None:
    m = da.four_bar(positions=2)
    assert lines.transmission_names(m) == ["A", "B"]
    first, second = lines.transmission_lines(m, "B")
    at, far = np.array(m.joint_points("B")[0]), np.array(m.joint_points("A")[1])
    assert (first.link, second.link) == ("coupler", "rocker")
    assert first.along == pytest.approx(far - at)
    back = np.array(m.joint_points("O4")[m.joints["O4"].links.index("rocker")])
    assert second.along == pytest.approx(back - np.array(m.joint_points("B")[1]))
    with pytest.raises(ModelError) as raised:
        lines.transmission_lines(m, "O2")
    assert raised.value.what == "'O2' has no transmission angle"
    guided = da.slider_crank()
    assert lines.transmission_names(guided) == ["A", "B"]
    _, slide = lines.transmission_lines(guided, "B")
    assert (slide.link, slide.slides) == ("ground", True)
    assert slide.along == pytest.approx([0.0, 1.0])
    single = da.mechanism(
        {
            "links": {"ground": {"points": {"O": [0, 0]}}, "rod": {"points": {"O": [0, 0]}}},
            "joints": {"O": {"type": "pin", "links": ["ground", "rod"]}},
        }
    )
    with pytest.raises(ModelError) as raised:
        lines.transmission_lines(single, "O")
    assert raised.value.remedy == "it needs a pin between two moving links of a planar mechanism"
