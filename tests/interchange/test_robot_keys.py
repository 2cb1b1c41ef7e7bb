"""Keys of MJCF, SDFormat and URDF one by one: an arm that has them all, against MuJoCo; loops, couplings and notes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes, read_foreign
from dalembert.model.description import mechanism
from tests.interchange.written_files import FILES

ARM = FILES / "arm_of_every_key.xml"
ACCELERATIONS = {
    "yaw": 0.5, "quill turn": -1.2, "quill slide": 0.7, "pin slide": 0.9,
    "pin turn": -0.4, "bend": 1.5, "feed": -0.8, "twist": 2.0,
}  # fmt: skip
"""Of each actuator, in the order of the joints."""


def driven(m: da.Mechanism, loads: tuple[str, ...] | None = None, still: bool = False) -> da.Mechanism:
    """The arm with its accelerations, with some of its loads; still: its drives counted from the drawn position."""
    tree: Any = m.to_tree()
    for name, drive in tree["drives"].items():
        unit = "m" if drive["freedom"].startswith("slide") else "rad"
        drive["acceleration"] = f"{ACCELERATIONS[name]} {unit}/s^2"
        drive |= {"position": f"0 {unit}"} if still else {}
    if loads is not None:
        tree["loads"] = {name: tree["loads"][name] for name in loads}
    return mechanism(tree)


def efforts(m: da.Mechanism, **options: Any) -> list[float]:
    r = da.dynamics(driven(m, **options))
    return [r.effort(name)[0] for name in ACCELERATIONS]


def in_mujoco(path: Path) -> Any:
    """MuJoCo's inverse dynamics of a file at its keyframe."""
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    joint = {model.actuator(k).name: model.actuator(k).trnid[0] for k in range(model.nu)}
    place = {name: model.jnt_dofadr[joint[name]] for name in ACCELERATIONS}
    for name, value in ACCELERATIONS.items():
        data.qacc[place[name]] = value
    mujoco.mj_inverse(model, data)
    return [data.qfrc_inverse[place[name]] for name in ACCELERATIONS], data


def test_the_efforts_of_an_arm_with_every_key_are_those_of_mujoco(tmp_path: Path) -> None:
    """Defaults, frames, every way to turn, every solid, springs, dampers, references and tendons; written again too."""
    m, lost = read_foreign(ARM)
    theirs, data = in_mujoco(ARM)
    assert efforts(m) == pytest.approx(theirs, rel=1e-11)
    r = da.kinematics(m)
    for link in ("turret", "arm", "hand", "finger"):
        assert r.position(link)[0] == pytest.approx(data.body(link).xpos, abs=1e-14)
    assert r.point("link_5", "tip")[0] == pytest.approx(data.site("tip").xpos, abs=1e-14)
    assert [note.partition(": ")[2] for note in lost] == [
        "surfaces (<geom>), with contact between them",
        "law of actuator 'quill turn' (position)",
        "tendon 'slack band'",
    ]
    assert {name: joint.type for name, joint in m.joints.items()} == {
        "yaw": "revolute", "quill": "cylindrical", "pin": "slotted_cylinder", "bend": "revolute",
        "feed": "prismatic", "twist": "revolute", "link_5 weld": "weld",
    }  # fmt: skip
    content, lost = foreign_bytes(m, "x.xml")
    (tmp_path / "x.xml").write_bytes(content)
    assert in_mujoco(tmp_path / "x.xml")[0] == pytest.approx(theirs, rel=1e-6)  # least masses of its own
    assert efforts(read_foreign(tmp_path / "x.xml")[0]) == pytest.approx(theirs, rel=1e-6)
    assert lost == [
        text.format(k)
        for k in (1, 2)
        for text in (
            "link 'finger {}' without mass has 1e-09 kg: MuJoCo refuses 0",
            "the inertia of link 'finger {}' is larger by 1e-12 kg m2: MuJoCo refuses 0",
        )
    ]


def chained(folder: Path) -> Path:
    """The arm without joints of two freedoms: coordinates that do not begin at 0."""
    text = ARM.read_text(encoding="utf-8")
    for name, ref in (("quill.turn", "10"), ("pin.slide", "0.01")):
        text = text.replace(f'<joint name="{name}"', f'<joint name="{name}" ref="{ref}"')
    (folder / "chained.xml").write_text(text, encoding="utf-8")
    return folder / "chained.xml"


def test_coordinates_that_do_not_begin_at_0_are_those_of_mujoco(tmp_path: Path) -> None:
    path = chained(tmp_path)
    assert efforts(read_foreign(path)[0]) == pytest.approx(in_mujoco(path)[0], rel=1e-11)


@pytest.mark.parametrize(
    ("suffix", "loads", "damped"),
    [(".sdf", ("spring yaw", "spring quill_turn"), True), (".urdf", (), True), (".cmd", (), False)],
)
def test_the_arm_comes_back(suffix: str, loads: tuple[str, ...], damped: bool, tmp_path: Path) -> None:
    """Its efforts from each format, with the loads and the damping that the format has; URDF has no gravity either."""
    tree: Any = driven(read_foreign(chained(tmp_path))[0], loads).to_tree()
    if suffix == ".urdf":
        tree["gravity"] = [0.0, 0.0, -9.81]
    if not damped:
        for joint in tree["joints"].values():
            joint.pop("damping", None)
    m = mechanism(tree)
    content, _ = foreign_bytes(m, f"x{suffix}")
    (tmp_path / f"x{suffix}").write_bytes(content)
    back: Any = read_foreign(tmp_path / f"x{suffix}")[0].to_tree()
    assert len(back.get("loads", {})) == len(loads)
    if suffix == ".cmd":
        assert {d["joint"]: d for d in back["drives"].values()} == {
            d["joint"]: d for d in tree["drives"].values()
        }
    back["drives"] = tree["drives"]
    theirs = efforts(mechanism(back), still=suffix == ".sdf")
    assert theirs == pytest.approx(efforts(m), rel=1e-11)


def mjcf(inside: str, more: str = "") -> str:
    """A file with one body on a hinge, what is in it, and what stands beside the tree."""
    body = f"<body name='b'><joint name='j'/><geom size='1'/>{inside}</body>"
    ball = "<body name='c'><joint type='ball' name='k'/><geom size='1'/></body>"
    return f"<mujoco><worldbody>{body}{ball}</worldbody>{more}</mujoco>"


def equality(part: str) -> str:
    return mjcf("", f"<equality>{part}</equality>")


def sdf(inside: str) -> str:
    return f"<sdf><model name='m'><link name='a'/><link name='b'/>{inside}</model></sdf>"


def sdf_joint(kind: str, inside: str) -> str:
    return sdf(f"<joint name='j' type='{kind}'><parent>world</parent><child>a</child>{inside}</joint>")


def urdf(inside: str) -> str:
    return f"<robot><link name='a'/><link name='b'/><link name='c'/>{inside}</robot>"


def urdf_joint(kind: str, inside: str = "", more: str = "") -> str:
    first = f"<joint name='j' type='{kind}'><parent link='a'/><child link='b'/>{inside}</joint>"
    return urdf(f"{first}<joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint>{more}")


REFUSED = {
    ".xml": [
        (mjcf("", "<compiler settotalmass='3'/>"), "settotalmass changes masses; write the masses themselves"),
        (mjcf("<site name='s' class='x'/>"), "unknown class 'x'; name a <default> of the file"),
        (mjcf("<joint type='bolt'/>"), "unknown type of joint 'bolt'; use hinge, slide, ball or free"),
        (mjcf("<geom type='box' size='1 2'/>"), "a geom of type box has 2 sizes; give 3"),
        (mjcf("<geom type='cylinder' size='1' fromto='1 1 1 1 1 1'/>"), "needs a size and two different ends"),
        (mjcf("<geom type='capsule' fromto='1 1 1 1 1 2'/>"), "a geom with fromto needs a size"),
        (mjcf("<geom size='x'/>"), "'x' is not a list of numbers; write numbers"),
        (mjcf(f"<geom size='{'1 ' * 5000}1'/>"), "has too many numbers; give a shorter list"),
        (mjcf(f"<body pos='{'1 ' * 5000}'/>"), "pos of <body> has 5000 numbers; give 3"),
        (mjcf("<body pos='0 -2e60 0'/>"), "is not finite; write finite numbers"),
        (mjcf("<body><inertial pos='0 0 0'/></body>"), "<inertial> has no mass; give mass"),
        (equality("<connect body1='x' anchor='0 0 0'/>"), "unknown body 'x'; name a body of the file"),
        (equality("<connect body1='b'/>"), "<connect> has no anchor; give anchor"),
        (equality("<connect site1='x' site2='y'/>"), "unknown site 'x'; name a site of the file"),
        (equality("<tendon tendon1='x'/>"), "an equality <tendon> has no counterpart; use connect, weld or joint"),
        (equality("<joint joint1='x'/>"), "a joint that is a ball or does not exist; name hinges or slides"),
        (equality("<joint joint1='j' joint2='k'/>"), "only two turns make a gear"),
        (equality("<joint joint1='j' joint2='x'/>"), "a joint that is a ball or does not exist"),
        (equality("<joint joint1='j' joint2='j' polycoef='0 1 2'/>"), "a ratio that changes has no counterpart"),
        (
            mjcf(
                "<body><joint name='l'/><geom size='1'/></body>",
                "<equality><joint joint1='j' joint2='l'/></equality>",
            ),
            "the axes are not on one link",
        ),
    ],
    ".sdf": [
        ("<mujoco/>", "<mujoco> is not SDFormat; an SDFormat file begins with <sdf>"),
        ("<sdf/>", "the file has 0 models; give a file with one <model>"),
        ("<sdf><model/><world><model/></world></sdf>", "the file has 2 models"),
        (sdf("<include/>"), "<include> has no counterpart; write its links into the model"),
        (sdf("<static>1</static>"), "<static> has no counterpart"),
        ("<sdf><model placement_frame='a'/></sdf>", "placement_frame is not read; give the model a <pose>"),
        (sdf("<frame name='f' attached_to='x'/>"), "frame 'x' is attached to no link"),
        (sdf("<frame name='f' attached_to='f'/>"), "frame 'f' is attached to no link; name a link of the model"),
        (sdf("<frame name='f'><pose relative_to='x'/></frame>"), "unknown frame 'x'; name a link, joint or frame"),
        (sdf("<frame name='f'><pose relative_to='f'/></frame>"), "the place of 'f' depends on itself"),
        (sdf("<joint name='j' type='ball'><child>a</child></joint>"), "<joint> has no <parent>; name its parent"),
        (sdf_joint("gearbox", ""), "a gearbox joint has no counterpart; use revolute, continuous, prismatic, ball"),
        (sdf_joint("revolute", ""), "a revolute joint needs an <axis>; give its direction, <xyz>"),
        (sdf_joint("universal", "<axis/>"), "a universal joint needs an <axis2>"),
        (sdf_joint("revolute", "<axis><xyz>0 0 0</xyz></axis>"), "the axis of a joint is 0; give its direction"),
        (sdf_joint("screw", "<axis/><thread_pitch>0</thread_pitch>"), "screw 'j' has no pitch"),
        (
            sdf("<link name='c'><inertial><pose relative_to='a'/></inertial></link>"),
            "the pose of an <inertial> is relative to its link; leave relative_to out",
        ),
    ],
    ".urdf": [
        ("<robot xmlns:xacro='x'><xacro:macro/></robot>", "this is a xacro file, not URDF; expand it first"),
        ("<sdf/>", "<sdf> is not URDF; a URDF file begins with <robot>"),
        ("<robot><link name='a'/></robot>", "the file has one link and no joint; give joints"),
        (urdf(""), "3 links have no parent; leave one root link"),
        (urdf("<joint name='j' type='fixed'><child link='b'/></joint>"), "joint 'j' has no <parent>; name its"),
        (urdf_joint("fixed").replace("parent link='a'", "parent link='x'", 1), "unknown link 'x'; name a <link>"),
        (urdf_joint("fixed").replace("child link='c'", "child link='b'"), "link 'b' has two parents"),
        (urdf_joint("hook"), "a hook joint has no counterpart; use revolute, continuous, prismatic, fixed"),
        (urdf_joint("revolute", "<axis xyz='0 0 0'/>"), "the axis of a joint is 0; give its direction"),
        (urdf_joint("revolute", "<mimic joint='x'/>"), "unknown joint 'x'; name a joint of the file"),
        (
            urdf_joint("revolute", "", "<link name='d'/><joint name='l' type='revolute'><origin xyz='0 1 0'/>"
            "<parent link='a'/><child link='d'/><axis xyz='0 1 0'/><mimic joint='j'/></joint>"),
            "joints 'j' and 'l' are coupled in the ratio 1: the axes are not parallel",
        ),
    ],
}  # fmt: skip


@pytest.mark.parametrize(
    ("suffix", "text", "words"),
    [pytest.param(s, *row, id=f"{s[1:]}-{k}") for s, rows in REFUSED.items() for k, row in enumerate(rows)],
)
def test_what_a_mechanism_cannot_have_is_refused_at_its_line(
    suffix: str, text: str, words: str, tmp_path: Path
) -> None:
    path = tmp_path / f"bad{suffix}"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as refused:
        read_foreign(path)
    assert str(refused.value).startswith(f"{path}:1: ")
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("loops", "words"),
    [
        ("closed_loop: [[j, k]]\ntype: []", "closed_loop and type are not lists of one length"),
        ("closed_loop: [[j, k]]\ntype: [2d]", "loop ['j', 'k'] of type 2d is not supported; use 3d or 6d"),
        ("closed_loop: [[j]]\ntype: [3d]", "loop ['j'] of type 3d is not supported"),
        ("closed_loop: [[j, x]]\ntype: [3d]", "the robot has no joint or link 'x' that would be the end of a loop"),
        ("#" + "x" * 100_000, "the file of loops is too large; give pairs of frames"),
        ("closed_loop: [[j]]\ntype: [3d]".ljust(100_000), "loop ['j'] of type 3d is not supported"),
    ],
)  # fmt: skip
def test_loops_beside_a_robot_are_refused(loops: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "x.urdf").write_text(urdf_joint("revolute"), encoding="utf-8")
    (tmp_path / "x.loops.yaml").write_text(loops, encoding="utf-8")
    with pytest.raises(ModelError) as refused:
        read_foreign(tmp_path / "x.urdf")
    assert str(refused.value).startswith(f"{tmp_path / 'x.loops.yaml'}:1: {words}")


WHEELS = """<mujoco><worldbody>
<body name="one"><joint name="crank" axis="0 0 1"/><geom size="0.01"/></body>
<body name="two" pos="0 0.3 0"><joint name="pinion" axis="0 0 {}"/><geom size="0.01"/></body>
</worldbody><equality><joint joint1="pinion" joint2="crank" {}/></equality>
<actuator><motor joint="crank"/></actuator><keyframe><key qvel="3 0"/></keyframe></mujoco>"""


@pytest.mark.parametrize(
    ("axis", "given", "ratio"),
    [
        (1, "polycoef='0 2'", 2),
        (1, "polycoef='0 -2 0 0'", -2),
        (1, "polycoef='0 0.5 0'", 0.5),
        (-1, "polycoef='0 2'", -2),
        (-1, "polycoef='0.3'", -1),
        (-1, "", -1),
    ],
)
def test_two_turns_in_a_ratio_are_wheels_of_that_ratio(
    axis: int, given: str, ratio: float, tmp_path: Path
) -> None:
    """One inside the other where both turn in one sense; numbers that are left out are 0 1 0 0 0."""
    (tmp_path / "x.xml").write_text(WHEELS.format(axis, given), encoding="utf-8")
    m, _ = read_foreign(tmp_path / "x.xml")
    r = da.kinematics(m)
    assert (r.speed("one")[0, 2], r.speed("two")[0, 2]) == pytest.approx((3, 3 * ratio))
    first, second = m.joints["gear pinion"].radii
    assert first / second == pytest.approx(abs(ratio))
    assert abs(first - second if ratio > 0 else first + second) == pytest.approx(0.3)


@pytest.mark.parametrize(("length", "kept"), [("0", 0.0), ("0.25", 0.25), ("-1", None), ("0.1 0.3", None)])
def test_a_tendon_of_one_length_is_a_spring(length: str, kept: float | None, tmp_path: Path) -> None:
    """Also one that pulls down to no length; one without a length of its own, or slack between two, is said."""
    tendon = f"<tendon><spatial name='t' stiffness='3' springlength='{length}'>"
    tendon += "<site site='a'/><site site='c'/></spatial></tendon>"
    body = "<body name='b'><joint type='free'/><geom size='1'/><site name='c' pos='0 2 0'/></body>"
    text = f"<mujoco><worldbody><site name='a' pos='0 0 1'/>{body}</worldbody>{tendon}</mujoco>"
    (tmp_path / "x.xml").write_text(text, encoding="utf-8")
    m, lost = read_foreign(tmp_path / "x.xml")
    springs: Any = m.loads
    assert {name: spring.free_length for name, spring in springs.items()} == (
        {} if kept is None else {"t": kept}
    )
    assert any("tendon 't'" in note for note in lost) == (kept is None)


PAIRS_OF_SITES = """<mujoco><worldbody>
<body name='a'><joint name='ja' axis='0 1 0'/><geom size='.1'/>
 <site name='a1' pos='1 0 0'/><site name='a2' pos='1 {} 0'/></body>
<body name='b' pos='2 0 0'><joint name='jb' axis='0 1 0'/><geom size='.1'/>
 <site name='b1' pos='-1 0 0'/><site name='b2' pos='-1 {} 0'/></body>
</worldbody><equality><connect name='h.1' site1='a1' site2='b1'/><connect name='h.2' site1='a2' site2='b2'/></equality>
</mujoco>"""


@pytest.mark.parametrize(
    ("apart", "kinds"),
    [
        ((1, 1), {"h_1": "revolute"}),
        ((1, 1.5), {"h_1": "spherical", "h_2": "spherical"}),
        ((1.5, 1), {"h_1": "spherical", "h_2": "spherical"}),
    ],
)
def test_two_balls_as_far_apart_on_both_bodies_are_a_hinge(
    apart: tuple[float, float], kinds: dict[str, str], tmp_path: Path
) -> None:
    (tmp_path / "x.xml").write_text(PAIRS_OF_SITES.format(*apart), encoding="utf-8")
    m, _ = read_foreign(tmp_path / "x.xml")
    assert {name: joint.type for name, joint in m.joints.items() if name[0] == "h"} == kinds
