"""Joints written for other programs, one by one: screws, turned pins with springs, welds, and what is not kept."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes, read_foreign
from dalembert.interchange.link_graph import Connection, inertia_matrix
from dalembert.interchange.robots.mjcf_geoms import combined
from dalembert.interchange.robots.urdf_writer import steps
from tests.interchange.test_ondsel import SCREW
from tests.interchange.written_files import largest_difference, read_back
from tests.space.test_gears import pair, wheel

Z, Y = [0, 0, 1], [0, 1, 0]
PINS = {"i": {"z": Z}, "j": {"z": Y}}
BODY: dict[str, Any] = {
    "points": {"O": [0, 0, 0], "Q": [1, 0, 0]},
    "mass": 2,
    "center": [0.3, 0.1, 0],
    "inertia": [0.01, 0.02, 0.025],
}


def joint(kind: str, i: str, j: str, **keys: Any) -> dict[str, Any]:
    return (
        {"type": kind, "links": [i, j], "at": "O"}
        | ({} if "axes" in keys or kind == "weld" else {"axis": Z})
        | keys
    )


def drives(of: str, **positions: Any) -> dict[str, Any]:
    return {name: {"joint": of, "freedom": name, "position": at} for name, at in positions.items()}


def machine(joints: dict[str, Any], moved: dict[str, Any], loads: Any = None, **bodies: Any) -> da.Mechanism:
    """A body `a`, and others, on joints with all their freedoms driven."""
    ground = {"points": BODY["points"]}
    links = {"ground": ground, "a": BODY} | bodies
    tree = {"space": "space", "gravity": [0, 0, -9.81], "links": links, "joints": joints, "drives": moved}
    return da.mechanism(tree | {"loads": loads or {}})


SPRING = {"type": "torsion_spring", "joint": "W", "stiffness": 3, "free_angle": "0.5 rad"}
TURN = {"W": {"position": "0.2 rad", "speed": "3 rad/s", "acceleration": "5 rad/s^2"}}


@pytest.mark.parametrize("suffix", [".xml", ".sdf", ".cmd"])
@pytest.mark.parametrize("sense", [1, -1])
def test_a_screw_comes_back(suffix: str, sense: int, tmp_path: Path) -> None:
    """SDFormat writes it from the ground on and at its drawn place: a drive then goes the other way from 0."""
    m = da.loads(SCREW.replace("[ground, nut]", "[nut, ground]") if sense < 0 else SCREW)
    back, _ = read_back(m, tmp_path / f"x{suffix}")
    assert back.joints["S"].lead == pytest.approx(0.02, rel=1e-15)  # type: ignore[union-attr]
    turned = suffix == ".sdf" and sense < 0
    like = (
        m if not turned else da.loads(SCREW.replace("0.3 rad", "-0.3 rad").replace("5 rad/s,", "-5 rad/s,"))
    )
    if turned:
        like = like.with_values({"drives.S.acceleration": "-7 rad/s^2"})
        ours, theirs = (float(da.dynamics(x).effort("S")[0]) for x in (m, like))
        assert theirs == pytest.approx(-ours, rel=1e-12)
    assert largest_difference(like, back, drawn=suffix == ".sdf") < 1e-14


def test_a_screw_of_ondsel_is_a_cylindrical_joint_with_a_thread() -> None:
    text = " ".join(foreign_bytes(da.loads(SCREW), "x.asmt")[0].decode().split())
    ends = "MarkerI /Assembly/S MarkerJ /Assembly/nut/S"
    assert f"Joints CylindricalJoint Name S {ends} ScrewJoint Name S thread {ends} pitch 0.02 Motions" in text


@pytest.mark.parametrize("suffix", [".xml", ".sdf"])
@pytest.mark.parametrize("damping", [{}, {"turn": 2}])
@pytest.mark.parametrize("links", [("ground", "a"), ("a", "ground")])
def test_a_pin_with_a_spring_and_damping_comes_back(
    suffix: str, damping: Any, links: tuple[str, str], tmp_path: Path
) -> None:
    """Whichever link is named first. MJCF turns the axis round with the links, SDFormat begins at the drawn place."""
    m = machine({"W": joint("revolute", *links, axis=Y, damping=damping)}, TURN, {"S": SPRING})
    back, lost = read_back(m, tmp_path / f"x{suffix}")
    assert len(lost) == 1
    sense = -1 if suffix == ".sdf" and links[0] == "a" else 1
    at = {"position": 0.0 if suffix == ".sdf" else 0.2, "speed": 3.0 * sense, "acceleration": 5.0 * sense}
    tree: Any = back.to_tree()
    units = zip(at.items(), ("rad", "rad/s", "rad/s^2"), strict=True)
    tree["drives"] = {"W": {"joint": "W", "freedom": "turn"} | {k: f"{v} {unit}" for (k, v), unit in units}}
    ours, theirs = da.dynamics(m), da.dynamics(da.mechanism(tree))
    assert theirs.center("a")[0] == pytest.approx(ours.center("a")[0], abs=1e-15)
    assert sense * theirs.effort("W")[0] == pytest.approx(ours.effort("W")[0], rel=1e-12)


def test_a_universal_joint_with_a_slide_on_it_comes_back_from_sdformat(tmp_path: Path) -> None:
    """Both its pins, the damping of the slide, and every point, with the link before its name."""
    joints = {
        "U": joint("universal", "ground", "a", axes=PINS),
        "S": joint("prismatic", "a", "b", at="Q", axis=[1, 2, 0], damping={"slide": 4}),
    }
    moved = {
        "U1": {"joint": "U", "freedom": "turn1", "position": "0.3 rad", "speed": "2 rad/s"},
        "U2": {"joint": "U", "freedom": "turn2", "position": "-0.4 rad", "speed": "1 rad/s"},
        "S": {"position": "0.1 m", "speed": "0.5 m/s"},
    }
    m = machine(joints, moved, {"F": {"type": "force", "on": "b", "at": "O", "value": [1, 0, 0]}}, b=BODY)
    back, lost = read_back(m, tmp_path / "x.sdf")
    assert lost == [
        *(f"drive {name!r}: SDFormat prescribes no motion" for name in moved),
        "load 'F' (force): SDFormat cannot state forces",
    ]
    points = {f"{link}_{name}": (float(name == "Q"), 0, 0) for link in ("ground", "a", "b") for name in "OQ"}
    for link in ("ground", "a", "b"):
        own = {n: at for n, at in points.items() if n.startswith(link)}
        for name, at in own.items():
            assert back.points(link)[name] == pytest.approx(at, abs=1e-14)
    bare = da.Mechanism.model_validate(m.to_tree() | {"loads": {}})
    ends = {"U 1": ("ground", "U cross"), "U 2": ("U cross", "a"), "S": ("a", "b")}
    assert {name: j.links for name, j in back.joints.items()} == ends
    tree: Any = back.to_tree()
    tree["drives"] = {
        "U1": {"joint": "U 1", "position": "0 rad", "speed": "2 rad/s"},
        "U2": {"joint": "U 2", "position": "0 rad", "speed": "1 rad/s"},
        "S": {"position": "0 m", "speed": "0.5 m/s"},
    }
    ours, theirs = da.dynamics(bare), da.dynamics(da.mechanism(tree))
    for name in moved:
        assert theirs.effort(name)[0] == pytest.approx(ours.effort(name)[0], rel=1e-9), name


def test_a_second_weld_is_an_equality(tmp_path: Path) -> None:
    m = machine({"W": joint("weld", "ground", "a"), "V": joint("weld", "ground", "a", at="Q")}, {})
    text = foreign_bytes(m, "x.xml")[0].decode()
    assert '<weld name="V" site1="ground.V" site2="a.V"/>' in text
    back, lost = read_back(m, tmp_path / "x.xml")
    assert ([j.type for j in back.joints.values()], lost) == (["weld"] * 2, [])
    assert back.joint_points("V") == ((1, 0, 0), (1, 0, 0))


def test_loads_of_adams_come_back_at_their_points(tmp_path: Path) -> None:
    """A force at three lengths, one at the mass centre, a couple; the link that a force is by is not kept."""
    loads = {
        "F": {"type": "force", "on": "a", "by": "ground", "at": [0.5, 0.1, 0.2], "value": [1, 2, 3]},
        "G": {"type": "force", "on": "a", "at": "center", "value": [0, 20, 0]},
        "C": {"type": "couple", "on": "a", "value": [0, 0, 2]},
    }
    m = machine({"P": joint("revolute", "ground", "a")}, {"P": {"position": 0.3}}, loads)
    back, lost = read_back(m, tmp_path / "x.cmd")
    assert lost == ["by of load 'F'"]
    ours, theirs = da.dynamics(m), da.dynamics(back)
    assert theirs.effort("P")[0] == pytest.approx(ours.effort("P")[0], rel=1e-12)
    for name in ("reaction", "reaction_moment"):
        a, b = (getattr(r, name)("P")[0] for r in (ours, theirs))
        assert b == pytest.approx(a, rel=1e-12, abs=1e-13)


TWO = {"W": joint("universal", "ground", "a", axes=PINS)}
LOST: dict[str, tuple[da.Mechanism, str, list[str]]] = {}


def _lost(
    name: str, suffixes: str, joints: Any, moved: Any, notes: list[str], loads: Any = None, **more: Any
) -> None:
    for suffix in suffixes.split():
        LOST[f"{name}{suffix}"] = machine(joints, moved, loads, **more), suffix, notes


_lost(
    "screw",
    ".xml",
    {"W": joint("screw", "ground", "a", lead=0.02, damping={"turn": 2, "slide": 3})},
    drives("W", turn=0.2),
    [],
)
_lost(
    "screw",
    ".sdf .cmd .asmt",
    {"W": joint("screw", "ground", "a", lead=0.02, damping={"turn": 2, "slide": 3})},
    drives("W", turn=0.2),
    ["damping of 'W'"],
)
_lost(
    "universal",
    ".sdf",
    {"W": joint("universal", "ground", "a", axes=PINS, damping={"turn1": 2})},
    drives("W", turn1=0.2, turn2=0.1),
    ["damping of 'W'"],
)
_lost(
    "spring of a universal",
    ".sdf",
    TWO,
    drives("W", turn1=0.2, turn2=0.1),
    ["load 'S' (torsion_spring): SDFormat has one spring for a pin, and for no other joint"],
    {"S": SPRING | {"freedom": "turn1"}},
)
_lost(
    "two springs",
    ".sdf",
    {"W": joint("revolute", "ground", "a")},
    TURN,
    ["load 'T' (torsion_spring): SDFormat has one spring for a pin, and for no other joint"],
    {"S": SPRING, "T": SPRING | {"free_angle": 1}},
)
_lost(
    "two springs",
    ".xml",
    {"W": joint("revolute", "ground", "a")},
    TURN,
    ["load 'T' (torsion_spring): MJCF cannot state forces"],
    {"S": SPRING, "T": SPRING | {"free_angle": 1}},
)
_lost(
    "loop",
    ".xml",
    {
        "P": joint("revolute", "ground", "a"),
        "R": joint("revolute", "ground", "b"),
        "W": joint("revolute", "a", "b", damping=2),
    },
    {"P": {"position": 0}, "R": {"position": 0}},
    ["damping of 'W', where a loop is closed"],
    b=BODY,
)
_lost(
    "screw",
    ".urdf",
    {"W": joint("screw", "ground", "a", lead=0.02)},
    drives("W", turn=0.2),
    ["thread of 'W': URDF has its turn and its slide, each by itself"],
)
_lost("chain", ".cmd .asmt", {"W": joint("plane", "ground", "a", damping={"turn": 2}),
                              "V": joint("cylindrical", "ground", "a")},
      {"V": {"freedom": "turn", "position": 0}}, ["damping of 'W'"])  # fmt: skip


@pytest.mark.parametrize("name", LOST)
def test_damping_and_springs_that_are_not_kept_are_said(name: str) -> None:
    m, suffix, notes = LOST[name]
    others = ("drive ", "acceleration of drive", "the name ", "positions: URDF", "gravity: that of")
    assert [note for note in foreign_bytes(m, f"x{suffix}")[1] if not note.startswith(others)] == notes


GA, GB = ("ground", "a"), ("ground", "b")
NOT_WRITTEN: dict[str, tuple[da.Mechanism, str, str]] = {
    "an inertia of no solid": (
        machine(
            {"P": joint("revolute", "ground", "a")},
            {"P": {"position": 0}},
            a=BODY | {"center": [0, 0, 0], "inertia": [0.1, 0.1, 0.3]},
        ),
        ".xml",
        "link 'a': principal inertias 0.1, 0.1, 0.3 are of no solid, and MuJoCo refuses them; "
        "let none exceed the sum of the others",
    ),
    "a loop of slides": (
        machine(
            {k: joint("prismatic", *ends) for k, *ends in (("P", *GA), ("R", *GB), ("W", "a", "b"))},
            {"P": {"position": 0}, "R": {"position": 0}},
            b=BODY,
        ),
        ".xml",
        "the loop would be cut at 'W', a prismatic joint, which no equality of MJCF has; "
        "add a pin or a ball to the loop",
    ),
    "another blocked turn": (
        machine(
            {"B": joint("slotted_sphere", "ground", "a", blocked="y", axes={"i": {"x": Z}, "j": {"x": Z}})},
            drives("B", turn1=0, turn2=0),
        ),
        ".xml",
        "joint 'B': a slotted_sphere joint with another blocked turn is not written; "
        "turn its axes so that x is blocked",
    ),
    "a driven joint of two freedoms": (
        machine({"B": joint("cylindrical", "ground", "a")}, drives("B", turn=0, slide=0)),
        ".sdf",
        "joint 'B', a driven cylindrical, would become a chain of joints; drive a pin or a slide",
    ),
    "a gear": (
        da.lifted(da.load(examples()["gear_train"])),
        ".sdf",
        "gear 'sun_mesh': SDFormat's gearbox has no teeth and is not written; leave it out",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", NOT_WRITTEN)
def test_a_joint_that_is_not_written_says_why(name: str) -> None:
    m, suffix, said = NOT_WRITTEN[name]
    with pytest.raises(ModelError) as refused:
        foreign_bytes(m, f"x{suffix}")
    assert str(refused.value) == said


@pytest.mark.parametrize(("rule", "masses"), [("true", (2, 2)), ("false", (3, 0)), ("auto", (3, 2))])
def test_masses_are_of_inertials_or_of_geoms(rule: str, masses: tuple[float, float], tmp_path: Path) -> None:
    """A box of 1 m3 with 2 kg/m3, beside an inertial of 3 kg. A second dot in the file's name says nothing."""
    solid = '<geom type="box" size="0.5 0.5 0.5" density="2"/>'
    given = '<inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/>'
    bodies = [
        f'<body name="{n}"><joint type="hinge"/>{more}{solid}</body>' for n, more in (("a", given), ("b", ""))
    ]
    inside = f'<compiler inertiafromgeom="{rule}"/><worldbody>{"".join(bodies)}</worldbody>'
    (tmp_path / "arm.v2.xml").write_text(f"<mujoco>{inside}</mujoco>", encoding="utf-8")
    m, _ = read_foreign(tmp_path / "arm.v2.xml")
    assert (m.mass("a"), m.mass("b")) == pytest.approx(masses)
    moments = [2 / 6 if mass == 2 else float(mass == 3) for mass in masses]  # of a cube; as given; of nothing
    for link, moment in zip("ab", moments, strict=True):
        assert inertia_matrix(m.inertia(link)) == pytest.approx(moment * np.eye(3), abs=1e-15)


def test_a_solid_ellipsoid_has_its_mass_by_density(tmp_path: Path) -> None:
    """4/3 pi a b c; moments are a fifth of it times the squares of the half axes across. Of nothing there is none."""
    geom = '<geom type="ellipsoid" size="0.1 0.2 0.3" pos="1 2 3" density="500"/>'
    bodies = "".join(f'<body name="{n}"><joint type="hinge"/>{g}</body>' for n, g in (("a", geom), ("b", "")))
    (tmp_path / "x.xml").write_text(f"<mujoco><worldbody>{bodies}</worldbody></mujoco>", encoding="utf-8")
    m, _ = read_foreign(tmp_path / "x.xml")
    mass = 4 / 3 * math.pi * 0.006 * 500
    assert (m.mass("a"), m.center("a")) == (pytest.approx(mass), pytest.approx((1, 2, 3)))
    assert m.inertia("a") == pytest.approx([mass / 5 * s for s in (0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04)])
    assert (m.mass("b"), m.inertia("b")) == (0, 0)
    nothing = combined([])
    assert [np.shape(x) for x in nothing] == [(), (3,), (3, 3)]
    assert not any(np.any(x) for x in nothing)


@pytest.mark.parametrize("first", ["P", "B"])
def test_the_turn_of_a_ball_is_no_motor_of_mujoco(first: str) -> None:
    """A pin and a ball about one place; the drive of the ball turns about the pin's axis."""
    pair = {
        "P": joint("revolute", "ground", "a"),
        "B": {"type": "spherical", "links": ["ground", "a"], "at": "O"},
    }
    moved = {"B": {"joint": "B", "freedom": "turn", "position": 0, "axis": Z}}
    m = machine({name: pair[name] for name in (first, "B" if first == "P" else "P")}, moved)
    text, lost = foreign_bytes(m, "x.xml")
    assert lost == ["drive 'B', the turn of a ball about an axis"]
    assert b"<motor" not in text


def test_a_link_of_others_that_is_called_ground_gets_another_name(tmp_path: Path) -> None:
    ends = [
        f'<joint name="{n}" type="fixed"><parent link="base"/><child link="{n}"/></joint>'
        for n in ("ground", "a.b")
    ]
    links = [f'<link name="{n}"/>' for n in ("base", "ground", "a.b")]
    (tmp_path / "x.urdf").write_text(f"<robot>{''.join(links + ends)}</robot>", encoding="utf-8")
    m, lost = read_foreign(tmp_path / "x.urdf")
    assert list(m.links) == ["ground", "ground_link", "a_b"]
    assert lost[0] == "the root link 'base' is ground"


def test_more_elements_than_a_file_may_have_are_refused(tmp_path: Path) -> None:
    (tmp_path / "x.sdf").write_text("<sdf>" + "<a/>\n" * 100_000 + "</sdf>", encoding="utf-8")
    with pytest.raises(ModelError) as refused:
        read_foreign(tmp_path / "x.sdf")
    assert str(refused.value) == f"{tmp_path / 'x.sdf'}:100000: the file has too many elements; split it"


@pytest.mark.parametrize("shaft", [90.0, 60.0])
def test_bevel_wheels_have_no_ratio_of_parallel_hinges(shaft: float) -> None:
    """The wheels turn about z and about an axis at an angle to it, and touch at the circle of both."""
    turned = math.radians(shaft)
    cone = math.atan2(math.sin(turned), 0.07 / 0.04 + math.cos(turned))
    contact = np.array([0.04, 0.0, -0.04 / math.tan(cone)])
    axis = np.array([math.sin(turned), 0.0, -math.cos(turned)])
    first = wheel([0, 0, float(contact[2])], Z, 0.04)
    m = pair(first, wheel((contact @ axis * axis).tolist(), axis.tolist(), 0.07), [0, 0, 1])
    with pytest.raises(da.ModelError, match="gear 'G': its axes are not parallel; leave it out"):
        foreign_bytes(m, "x.xml")


def test_a_joint_from_j_to_i_has_its_coordinates_in_the_other_order() -> None:
    """A ball turns about x, y and z; its inverse is about -z, -y and -x."""
    eye = np.eye(4)
    joint = Connection("S", "spherical", ("a", "b"), (eye, eye))
    ahead, back = (steps(joint, flipped) for flipped in (False, True))
    assert [c.freedom for c in back] == [c.freedom for c in reversed(ahead)] == ["turn z", "turn y", "turn x"]
    assert [c.axis.tolist() for c in back] == [(-c.axis).tolist() for c in reversed(ahead)]
