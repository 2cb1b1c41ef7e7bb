"""Graphs of links between formats: placements, coordinates with their rates, trees, gears of ratios, names, XML."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.interchange import xml_tree
from dalembert.interchange.couplings import coupled_wheels
from dalembert.interchange.joint_coordinates import coordinates, link_velocity, rates, values
from dalembert.interchange.link_graph import (
    Connection,
    DrivenFreedom,
    LinkGraph,
    LinkPart,
    _drive,
    _joint,
    _link,
    _point,
    _pose,
    flipped,
    inertia_matrix,
    plain_name,
    relative,
    tree_of,
)
from dalembert.interchange.placements import clean, inverse, placement, turned
from dalembert.interchange.spanning_tree import spanning_tree
from dalembert.interchange.xml_text import XmlText, digits
from dalembert.interchange.xml_tree import Element, parse

AT: Any = Element("mimic", {}, 17, "arm.urdf")
HERE = placement(turned([1, 2, 3], 0.7), [0.3, -0.2, 0.5])
THERE = placement(turned([-2, 1, 1], -0.4), [-0.1, 0.6, 0.2])


def hinge(name: str, links: tuple[str, str], at: Any, axis: Any = (0, 0, 1)) -> Connection:
    """A pin whose axes are at a place of the first link."""
    side = np.eye(3) if tuple(axis) == (0, 0, 1) else turned([1, 0, 0], math.pi)
    return Connection(name, "revolute", links, (placement(side, at), placement(side, [0, 0, 0])))


def two_hinges(at: Any, axis: Any = (0, 0, 1), second: str = "ground") -> LinkGraph:
    graph = LinkGraph()
    graph.links = {
        "a": LinkPart("a", placement(np.eye(3), [0.1, 0.2, 0.3])), "b": LinkPart("b", placement(np.eye(3), at)),
    }  # fmt: skip
    graph.joints = {
        "A": hinge("A", ("ground", "a"), [0.1, 0.2, 0.3]), "B": hinge("B", (second, "b"), at, axis),
    }  # fmt: skip
    return graph


@pytest.mark.parametrize(
    ("ratio", "axis", "radii", "internal"),
    [
        (-2.0, (0, 0, 1), (1.0, 0.5), False),
        (-0.5, (0, 0, 1), (0.5, 1.0), False),
        (2.0, (0, 0, -1), (1.0, 0.5), False),
        (3.0, (0, 0, 1), (2.25, 0.75), True),
        (0.25, (0, 0, 1), (0.5, 2.0), True),
        (-1.0, (0, 0, 1), (0.75, 0.75), False),
    ],
)
def test_a_ratio_of_two_turns_is_a_gear_between_their_axes(
    ratio: float, axis: Any, radii: Any, internal: bool
) -> None:
    """The axes are 1.5 m apart: outside both radii fill it, inside their difference does."""
    graph = two_hinges([1.0, 1.4, 0.8], axis)
    gear = coupled_wheels(graph, ("A", "turn"), ("B", "turn"), ratio, AT)
    assert (gear.kind, gear.links, gear.line) == ("gear", ("a", "b"), 17)
    assert gear.more["radii"] == pytest.approx(list(radii))
    assert gear.more.get("internal", False) is internal
    centres = [graph.place(link) @ place for link, place in zip(gear.links, gear.places, strict=True)]
    assert centres[0][:3, 3] == pytest.approx([0.1, 0.2, 0.8]), "in the plane of the other wheel"
    assert centres[1][:3, 3] == pytest.approx([1.0, 1.4, 0.8])


@pytest.mark.parametrize(
    ("why", "at", "axis", "carrier", "ratio", "freedom"),
    [
        ("only two turns make a gear", [1.0, 1.4, 0.8], (0, 0, 1), "ground", -2.0, "slide"),
        ("only two turns make a gear", [1.0, 1.4, 0.8], (0, 0, 1), "ground", 0.0, "turn"),
        ("the axes are not on one link", [1.0, 1.4, 0.8], (0, 0, 1), "a", -2.0, "turn"),
        (
            "the axes are one line, and no two wheels on it mesh",
            [0.1, 0.2 + 0.9e-9, 0.8],
            (0, 0, 1),
            "ground",
            -2.0,
            "turn",
        ),
        (
            "equal wheels that turn in one sense do not mesh (a parallelogram does this)",
            [1.0, 1.4, 0.8],
            (0, 0, 1),
            "ground",
            1.0,
            "turn",
        ),
        (
            "equal wheels that turn in one sense do not mesh (a parallelogram does this)",
            [1.0, 1.4, 0.8],
            (0, 0, -1),
            "ground",
            -1.0,
            "turn",
        ),
    ],
)
def test_a_ratio_without_pitch_circles_is_refused(
    why: str, at: Any, axis: Any, carrier: str, ratio: float, freedom: str
) -> None:
    for leader, follower in ((freedom, "turn"), ("turn", freedom)):
        with pytest.raises(ModelError) as refused:
            coupled_wheels(two_hinges(at, axis, carrier), ("A", leader), ("B", follower), ratio, AT)
        said = f"joints 'A' and 'B' are coupled in the ratio {ratio:g}: {why}"
        assert refused.value.what == said
        assert refused.value.remedy == "leave the coupling out, or draw the wheels or rods that make it"
        assert (refused.value.line, refused.value.file) == (17, "arm.urdf")


def test_axes_are_parallel_within_a_millionth() -> None:
    for tilt, fits in ((1.3e-3, True), (1.5e-3, False)):  # 1 - cos: 0.85e-6 and 1.1e-6
        graph = two_hinges([1.0, 1.4, 0.8])
        b = graph.joints["B"]
        leaning = placement(turned([1, 0, 0], tilt), b.places[0][:3, 3])
        graph.joints["B"] = Connection("B", "revolute", b.links, (leaning, b.places[1]))
        call = lambda g=graph: coupled_wheels(g, ("A", "turn"), ("B", "turn"), -2.0, AT)  # noqa: E731
        if fits:
            assert call().kind == "gear"
        else:
            with pytest.raises(ModelError, match="the axes are not parallel"):
                call()


# coordinates


@pytest.mark.parametrize(
    ("kind", "count"),
    [
        ("revolute", 1),
        ("prismatic", 1),
        ("cylindrical", 2),
        ("universal", 2),
        ("spherical", 1),
        ("plane", 3),
        ("weld", 0),
        ("gear", 0),
    ],
)
def test_coordinates_and_their_rates_are_those_of_the_placement(kind: str, count: int) -> None:
    """Of a moving pair: the coordinates of a later pose are those of now and their rates times the time."""
    some = coordinates(kind)
    assert len(some) == count
    assert [c.kind for c in some] == sorted((c.kind for c in some), key=["slide", "hinge", "ball"].index)
    if not count or some[-1].kind == "ball":
        return_value = some[-1].axis if some else np.zeros(3)
        assert not return_value.any()
    else:
        wanted = [0.3 + 0.2 * k for k in range(count)]
        speeds = [1.5 - 0.8 * k for k in range(count)]
        step = 1e-6
        graph, joint = posed(some, wanted, kind)
        assert values(graph, joint) == pytest.approx(wanted, abs=1e-12)
        later, _ = posed(some, [q + step * v for q, v in zip(wanted, speeds, strict=True)], kind)
        a, b = graph.links["b"].place, later.links["b"].place
        w = (b[:3, :3] - a[:3, :3]) @ a[:3, :3].T / step
        spin, velocity = np.array([w[2, 1], w[0, 2], w[1, 0]]), (b[:3, 3] - a[:3, 3]) / step
        graph.links["b"] = LinkPart("b", a, velocity=velocity, spin=spin)
        assert rates(graph, joint) == pytest.approx(speeds, abs=1e-5)


def posed(some: Any, q: list[float], kind: str) -> tuple[LinkGraph, Connection]:
    """Two links with a joint at coordinates: slides in i, the first turn in i, the second in j."""
    slid = sum((x * c.axis for x, c in zip(q, some, strict=True) if c.kind == "slide"), np.zeros(3))
    rotation = np.eye(3)
    for x, c in zip(q, some, strict=True):
        rotation = rotation @ turned(c.axis, x) if c.kind == "hinge" else rotation
    graph = LinkGraph()
    graph.links = {"a": LinkPart("a", HERE), "b": LinkPart("b")}
    joint = Connection("J", kind, ("a", "b"), (THERE, HERE))
    graph.links["b"] = LinkPart("b", HERE @ THERE @ placement(rotation, slid) @ inverse(HERE))
    return graph, joint


def test_a_point_of_a_link_moves_with_it() -> None:
    graph = LinkGraph()
    graph.links = {
        "a": LinkPart("a", HERE, velocity=np.array([1.0, 2.0, 3.0]), spin=np.array([0.0, 0.0, 5.0]))
    }
    assert link_velocity(graph, "a", HERE[:3, 3] + [0.2, 0.1, 0.7]) == pytest.approx([0.5, 3.0, 3.0])
    assert not link_velocity(graph, "ground", np.ones(3)).any()


def test_a_placement_and_its_inverse() -> None:
    assert inverse(HERE) @ HERE == pytest.approx(np.eye(4), abs=1e-15)
    joint = Connection("J", "weld", ("ground", "a"), (HERE, THERE))
    graph = LinkGraph(links={"a": LinkPart("a", HERE)})
    assert relative(graph, joint) == pytest.approx(THERE)
    back = flipped(joint)
    assert (back.links, back.places[0] is THERE, back.places[1] is HERE) == (("a", "ground"), True, True)
    assert clean(np.array([2.0, -1.9e-14, 2.1e-14, -2.0])) == [2.0, 0.0, 2.1e-14, -2.0]
    assert clean(np.array([])) == []


# the tree of a model file


def test_parts_of_a_graph_are_parts_of_a_file() -> None:
    solid = np.array([[2.0, 0.1, 0.0], [0.1, 3.0, 0.0], [0.0, 0.0, 4.0]])
    link = LinkPart("a", mass=5.0, center=np.array([1.0, 2.0, 3.0]), inertia=solid)
    assert _link(link, {"P": [0]}) == {
        "points": {"P": [0]}, "mass": 5.0, "center": [1, 2, 3], "inertia": solid.tolist(),
    }  # fmt: skip
    assert _link(LinkPart("a", inertia=np.diag([1.0, 2.0, 3.0])), {})["inertia"] == [1, 2, 3]
    assert _link(LinkPart("a"), {}) == {"points": {}}
    lean = solid.copy()
    lean[0, 1] = 0.3
    assert _link(LinkPart("a", inertia=lean), {})["inertia"][0][1] == pytest.approx(0.2)
    assert _drive(DrivenFreedom("J", "turn", 0.5, 2.0, -3.0)) == {
        "joint": "J", "freedom": "turn", "position": 0.5, "speed": "2.0 rad/s", "acceleration": "-3.0 rad/s^2",
    }  # fmt: skip
    assert _drive(DrivenFreedom("J", "slide", 0.5, 2.0, -3.0)) == {
        "joint": "J", "freedom": "slide", "position": 0.5, "speed": "2.0 m/s", "acceleration": -3.0,
    }  # fmt: skip
    assert _drive(DrivenFreedom("J", "turn")) == {"joint": "J", "freedom": "turn", "position": 0.0}
    pose = _pose(placement(turned([0, 0, 2], 0.6), [1, 2, 3]))
    assert (pose["position"], pose["axis"], pose["angle"]) == ([1, 2, 3], [0, 0, 1], pytest.approx(0.6))
    bare = (np.eye(4), placement(np.eye(3), [1, 2, 3]))
    for kind, key in (("revolute", "axis"), ("weld", ""), ("spherical", ""), ("prismatic", "axes")):
        tree = _joint(Connection("J", kind, ("a", "b"), bare, {"lead": 3}), ["P", "Q"])
        assert tree.keys() == {"type", "links", "at", "lead", *([key] if key else [])}
        assert (tree["at"], tree["links"]) == (["P", "Q"], ["a", "b"])
    axes = _joint(Connection("J", "weld", ("a", "b"), (HERE, np.eye(4))), ["P", "Q"])["axes"]
    assert axes["i"] == {"x": pytest.approx(HERE[:3, 0]), "z": pytest.approx(HERE[:3, 2])}
    assert axes["j"] == {"x": [1, 0, 0], "z": [0, 0, 1]}
    assert _joint(Connection("J", "gear", ("a", "b"), bare), ["P", "Q"])["axes"]["j"] == {"z": [0, 0, 1]}
    points: Any = {"P": [1.0, 2.0, 3.0]}
    assert _point(points, "J", np.array([1.0, 2.0, 3.0 + 0.9e-15])) == "P"
    assert _point(points, "P", np.array([1.0, 2.5, 3.0])) == "P_2"
    assert points["P_2"] == [1.0, 2.5, 3.0]
    assert [inertia_matrix(v).tolist() for v in (None, 2)] == [
        np.zeros((3, 3)).tolist(),
        (2 * np.eye(3)).tolist(),
    ]
    assert inertia_matrix([1, 2, 3]).tolist() == np.diag([1.0, 2.0, 3.0]).tolist()
    assert inertia_matrix(solid).tolist() == solid.tolist()
    graph = LinkGraph("T", "S", links={"a": link}, gravity=(0.0, 0.0, 0.0))
    assert (tree_of(graph)["gravity"], tree_of(graph)["title"]) == ("none", "T")
    graph.gravity = (0.0, -9.81, 0.0)
    assert tree_of(graph)["gravity"] == [0.0, -9.81, 0.0]
    graph.lose("x")
    graph.lose("x")
    graph.lose("x", 3)
    assert graph.lost == ["x", "line 3: x"]


def test_names_of_other_programs_become_free_names() -> None:
    for text, taken, name in (
        ("a.b@c/d", {}, "a_b_c_d"),
        ("", {}, "part"),
        ("  ", {}, "part"),
        ("a", {"a": 1}, "a_2"),
        ("a", {"a": 1, "a_2": 1}, "a_3"),
        ("ground", {}, "ground_link"),
        ("ground", {"ground": 1}, "ground_2"),
        ("a\tb", {}, "a_b"),
        (" x ", {}, "x"),
    ):
        assert plain_name(text, taken) == name


def test_loops_are_cut_at_balls_then_pins_and_never_at_drives() -> None:
    def tree(kinds: str, driven: str = "") -> Any:
        names = {"p": "revolute", "s": "spherical", "t": "prismatic"}
        graph = LinkGraph(links={n: LinkPart(n) for n in "abc"})
        ends = [("ground", "a"), ("a", "b"), ("b", "c"), ("c", "ground")]
        for k, (letter, links) in enumerate(zip(kinds, ends, strict=True)):
            graph.joints[f"J{k}"] = Connection(f"J{k}", names[letter], links, (np.eye(4), np.eye(4)))
        graph.drives = {"d": DrivenFreedom(driven, "turn")} if driven else {}
        return spanning_tree(graph)

    assert [j.name for j in tree("pspp").cut] == ["J1"]
    assert [j.name for j in tree("ppsp").cut] == ["J2"]
    assert [j.name for j in tree("pppt").cut] == ["J2"]
    four = tree("pppp")
    assert [j.name for j in four.branches] == ["J0", "J3", "J1"]
    assert [j.name for j in four.cut] == ["J2"]
    assert four.turned == {"J3"}
    assert [j.links for j in four.branches] == [("ground", "a"), ("ground", "c"), ("a", "b")]
    assert [j.name for j in tree("pppp", "J2").cut] == ["J1"]
    assert [j.name for j in tree("ssss", "J1").cut] != ["J1"]


# XML


def test_xml_is_written_element_by_element() -> None:
    text = XmlText("a -- b")
    text.begin("a", x=1, y=None)
    text.add("b", class_="c", z='"q"')
    text.add("d", "1 < 2")
    text.begin("e")
    text.end()
    text.end()
    assert str(text) == (
        '<?xml version="1.0"?>\n<!-- a - - b -->\n<a x="1">\n  <b class="c" z=\'"q"\'/>\n'
        "  <d>1 &lt; 2</d>\n  <e>\n  </e>\n</a>\n"
    )
    assert str(XmlText()) == '<?xml version="1.0"?>\n'
    assert (digits(3), digits([-0.0, 0.1, 1e-20])) == ("3.0", "0.0 0.1 1e-20")


def test_numbers_of_an_element_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    root = parse(b"<a x='1 2 3' y='4'>\n<b>5 6</b><b/>\n<c><b/></c></a>", "m.xml")
    b, *_ = root.all("b")
    assert (root.vector("x", 3), root.number("y"), root.number("z", 7.0)) == ([1, 2, 3], 4, 7)
    assert (root.vector("z", 2, [8.0, 9.0]), b.numbers(b.text, (1, 2)), b.line) == ([8, 9], [5, 6], 2)
    assert [e.tag for e in root.walk()] == ["a", "b", "b", "c", "b"]
    assert [e.tag for e in root.all("c", "b")] == ["b", "b", "c"]
    assert (root.first("c").tag, root.first("d"), root.get("q"), root.get("q", "r")) == ("c", None, "", "r")  # type: ignore[union-attr]
    for text, count, said in (
        ("1 2", 3, "w has 2 numbers; give 3"),
        ("1 2 3", (1, 2), "w has 3 numbers; give 1 or 2"),
        ("1 x", 2, "w: '1 x' is not a list of numbers; write numbers"),
        ("1e61", 1, "w: '1e61' is not finite; write finite numbers"),
        ("nan", 1, "w: 'nan' is not finite; write finite numbers"),
        ("1 " * 5001, 0, "w has too many numbers; give a shorter list"),
    ):
        with pytest.raises(ModelError) as refused:
            b.numbers(text, count, "w")  # type: ignore[arg-type]
        assert f"{refused.value.what}; {refused.value.remedy}" == said
        assert refused.value.line == 2
    assert b.numbers("-1e60 1e60") == [-1e60, 1e60]
    assert len(b.numbers("1 " * 5000)) == 5000
    with pytest.raises(ModelError, match="<a> has no z; give z"):
        root.number("z")
    deep = b"<a>" * 3 + b"</a>" * 3
    monkeypatch.setattr(xml_tree, "DEEPEST", 3)
    monkeypatch.setattr(xml_tree, "MOST", 3)
    assert parse(deep, "m").tag == "a"
    for key in ("DEEPEST", "MOST"):
        with monkeypatch.context() as one:
            one.setattr(xml_tree, key, 2)
            with pytest.raises(ModelError, match="the file has too many elements; split it"):
                parse(deep, "m")
    monkeypatch.setattr(xml_tree, "LARGEST", len(deep))
    parse(deep, "m")
    with pytest.raises(ModelError, match=rf"the file has more than {len(deep)} bytes; leave meshes out"):
        parse(deep + b" ", "m")
    with pytest.raises(ModelError, match="the file is not XML: mismatched tag; save it again") as wrong:
        parse(b"<a>\n</b>", "m")
    assert wrong.value.line == 2
    with pytest.raises(
        ModelError, match=r"the file declares a document type or an entity; leave <!DOCTYPE> out"
    ):
        parse(b"<!DOCTYPE a><a/>", "m")
    assert parse(b"<!-- a\n-- b -->\n<a/>", "m").line == 3
