"""What is not read and what is not written: each with its sentence, at its place."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import DalembertError, ModelError
from dalembert.interchange.file_formats import foreign_bytes, is_foreign, read_foreign
from dalembert.interchange.sketches.dxf_skeletons import join_shapes
from dalembert.interchange.sketches.plane_sketch import PlaneSketch, sketch_tree
from dalembert.interchange.xml_tree import parse
from tests.approved.commands import BROKEN
from tests.interchange.test_adams import ARM, arm

ADAMS = {
    "constraint create joint revolute joint_name = .M.P j_marker_name = .M.ground.j": "has no i_marker_name; give",
    "part modify rigid_body name_and_position part_name = .M.ground location = 1, 0, 0": "the ground part is moved",
    "part modify rigid_body mass_properties part_name = .M.leg mass = 1": "there is no part 'leg'; make it first",
    "marker create marker_name = .M.k": "'.M.k' is not a marker; write .model.part.marker",
    "constraint create joint revolute joint_name = .M.P i_marker_name = .M.arm.q j_marker_name = .M.ground.j": (
        "there is no marker '.M.arm.q'; make it first"
    ),
    "marker create marker_name = .M.arm.p, .M.arm.q": "marker_name has 2 values; give one",
    "marker create marker_name = .M.arm.p location = 1, inf, 0": "location has not 3 finite numbers; give 3",
    "marker create marker_name = .M.arm.p location = 1, 0": "location has not 3 finite numbers; give 3",
    "marker create marker_name = .M.arm.p location = 1, x, 0": "location: 'x' is not a number; write numbers",
    "constraint create motion_generator motion_name = .M.N joint_name = .M.Q function = \"1\"": "there is no joint 'Q'",
    "constraint create motion_generator motion_name = .M.N joint_name = .M.O type_of_freedom = translational "
    'function = "1"': "joint 'O' has no such freedom; write another type_of_freedom",
    "constraint modify motion_generator motion_name = .M.motion_O time_derivative = acceleration": (
        "a motion given by its acceleration is not read; give displacement or velocity"
    ),
    'constraint modify motion_generator motion_name = .M.motion_O function = "x"': "the function 'x' is not read",
    "constraint modify motion_generator motion_name = .M.motion_O function = \"sqrt(time)\"": (
        "the function 'sqrt(time)' is not read"
    ),
    "force create direct single_component_force single_component_force_name = .M.F i_marker_name = .M.arm.i "
    'j_marker_name = .M.ground.j type_of_freedom = translational function = "1"': (
        "a force between two parts along the line of their markers is not read"
    ),
    "force create direct single_component_force single_component_force_name = .M.F i_marker_name = .M.arm.i "
    'j_marker_name = .M.ground.j action_only = on type_of_freedom = translational function = "time"': (
        "a force that changes with time is not read; write its value"
    ),
}  # fmt: skip


@pytest.mark.parametrize("line", ADAMS)
def test_commands_of_adams_are_refused_at_their_line(line: str, tmp_path: Path) -> None:
    with pytest.raises(ModelError) as refused:
        arm(tmp_path, f"{ARM}{line}\n")
    assert ADAMS[line] in str(refused.value)


def test_a_motion_by_its_speed_begins_where_it_is_said_and_a_marker_relative_to_another(
    tmp_path: Path,
) -> None:
    """30 deg before it turns at 0.5 rad/s; the arm's marker lies 1 mm along another that is turned by 30 deg."""
    text = ARM.replace(
        'motion_O function = "10D + 0.5*", "time + 2*TIME**2"',
        'motion_O time_derivative = velocity displacement_ic = 30 function = "0.5"',
    )
    near = "marker create marker_name = .M.arm.k location = 1, 0, 0 orientation = 0, 0, 0 relative_to = .M.arm.i\n"
    m, _ = arm(tmp_path, text + near)
    assert m.drives["O"].position == pytest.approx(0.5235987755982988)
    assert m.drives["O"].speed == 0.5
    assert m.points("arm")["k"] == pytest.approx([1e-3 * 0.75**0.5, 5e-4, 0])
    mass = "part modify rigid_body mass_properties"
    lost = arm(
        tmp_path,
        "".join(
            x for x in text.splitlines(True) if "of the arm" not in x and mass not in x and "ixx" not in x
        ),
    )[1]
    assert lost[0].endswith("part 'arm' has no mass properties: no mass")


SLIDER = """
links: {ground: {points: {P: [1 m, 0]}}, block: {points: {P: [0, 0], Q: [1 m, 0]}}}
joints: {P: {type: slider, links: [ground, block]}}
drives: {P: {position: 0 m}}
"""


def moved(**changes: Any) -> da.Mechanism:
    tree: Any = da.four_bar(positions=1).to_tree()
    for key, value in changes.items():
        tree[key] = value
    return da.Mechanism.model_validate(tree)


def forward(m: da.Mechanism) -> bytes:
    return foreign_bytes(m, "x.fmu", forward=True)[0]


UNKNOWN = {"T": {"type": "couple", "on": "rocker", "value": "unknown"}}
WRITTEN: dict[str, Callable[[], Any]] = {
    "x.abc: .abc is not written; use .xml, .mjcf, .sdf": lambda: foreign_bytes(da.four_bar(), "x.abc"),
    "x: no suffix is not written": lambda: foreign_bytes(da.four_bar(), "x"),
    "x.txt: .txt is not written": lambda: foreign_bytes(da.four_bar(), "x.txt"),
    "x.asmt: .asmt is not read; use .xml": lambda: read_foreign("x.asmt"),
    "nowhere.xml: file not found": lambda: read_foreign("nowhere.xml"),
    "position 1 has no pose to write: The linkage does not close": lambda: foreign_bytes(da.loads(BROKEN), "x.pmks"),
    "position 1 has no pose to write: No pose of the linkage": lambda: foreign_bytes(da.loads(BROKEN), "x.xml"),
    "link 'block': a sliding link of PMKS+ has one pin, at its slider": lambda: foreign_bytes(
        da.loads(SLIDER), "x.pmks"
    ),
    "the driver of pylinkage turns a crank on the ground": lambda: foreign_bytes(
        moved(drives={"A": {"position": "unknown", "effort": 0}}, gravity=[0, -9.81]), "x.pylinkage.json"
    ),
    "FMI 4.0 is not written; use 2.0 or 3.0": lambda: foreign_bytes(da.four_bar(), "x.fmu", version="4.0"),
    "no drive could be a state; write a drive for each freedom": lambda: forward(moved(drives={})),
    "load 'T' is unknown, but forces move the machine; give it a value": lambda: forward(moved(loads=UNKNOWN)),
    "forces move drive 'O2', but drive 'O5' is prescribed": lambda: forward(
        da.five_bar().model_copy(update={"start": {"O2": da.five_bar().schedule()}})
    ),
    "forces that move 'O2' move no mass; give its links masses": lambda: forward(
        moved(links={
            name: {k: v for k, v in link.items() if k == "points"}
            for name, link in da.four_bar().to_tree()["links"].items()
        })
    ),
}  # fmt: skip


@pytest.mark.parametrize("sentence", WRITTEN)
def test_what_is_not_written_says_why(sentence: str) -> None:
    with pytest.raises(DalembertError) as refused:
        WRITTEN[sentence]()
    assert sentence in str(refused.value)


def test_files_that_are_too_large_or_no_files(tmp_path: Path) -> None:
    (tmp_path / "x.xml").mkdir()
    with pytest.raises(ModelError, match=r"the file cannot be read: .*; check its name and permissions"):
        read_foreign(tmp_path / "x.xml")
    for suffix, size in ((".cmd", 2_000_001), (".dxf", 5_000_001), (".xml", 10_000_001)):
        path = tmp_path / f"large{suffix}"
        path.write_bytes(b" " * size)
        with pytest.raises(ModelError, match=f"the file has more than {size - 1} bytes; leave"):
            read_foreign(path)
    for name, content, size, words in (
        ("x.mjcf", b"<mujoco/>", 5_000_000, "the mechanism has no moving link"),
        ("x.cmd", b"", 2_000_000, "the file makes no model of Adams"),
        ("x.dxf", b"", 5_000_000, "the file is not DXF"),
        ("x.pmks", b"x", 10_000_000, "the file has 0 links of PMKS"),
        ("y.pmks", b"?".ljust(20_001, b"0"), 0, "the linkage of PMKS is not complete"),
        ("z.pmks", b"?".ljust(20_002, b"0"), 0, "the link of PMKS. has more than 20000 characters"),
    ):
        (tmp_path / name).write_bytes(content.ljust(size))
        with pytest.raises(ModelError, match=words):
            read_foreign(tmp_path / name)
    for place in ([1e70, 0], [0, -1e70]):
        position = {"id": "a", "type": "ground", "position": place}
        (tmp_path / "x.json").write_text(json.dumps({"joints": [position], "links": []}))
        with pytest.raises(ModelError, match="a position is not finite; write finite numbers"):
            read_foreign(tmp_path / "x.json")


def test_skeletons_without_links_ground_or_pins(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    path = tmp_path / "x.dxf"
    path.write_text("no drawing")
    with pytest.raises(ModelError, match=r"x\.dxf:1: the file is not DXF: .*; save it as ASCII DXF"):
        read_foreign(path)
    drawing = ezdxf.new(units=0)
    space = drawing.modelspace()
    space.add_point((0, 0), {"layer": "GROUND"})
    drawing.saveas(path)
    with pytest.raises(ModelError, match="the drawing has no lines that would be links; draw links as lines"):
        read_foreign(path)
    space.add_lwpolyline([(0, 0), (0, 100)], dxfattribs={"layer": "crank"})
    space.add_polyline2d([(0, 100), (250, 200), (100, 200)], dxfattribs={"layer": "coupler"})
    space.add_line((300, 0), (250, 200), {"layer": "rocker"})
    space.add_circle((300, 0), 5, {"layer": "GROUND"})
    space.add_line((900, 0), (950, 0), {"layer": "SLIDE"})
    drawing.saveas(path)
    m, lost = read_foreign(path)
    assert lost == [
        "the drawing has no unit: taken as millimetres",
        "a line of layer SLIDE at (0.9, 0) m with no pin on it",
    ]
    assert [len(m.points(link)) for link in ("crank", "coupler", "rocker")] == [2, 3, 2]
    assert m.points("crank")["P2"] == pytest.approx((0.1, 0))
    sketch = PlaneSketch("loose")
    join_shapes(sketch, [("crank", [(0.0, 0.0), (1.0, 0.0)]), ("rod", [(1.0, 0.0), (2.0, 1.0)])])
    with pytest.raises(ModelError, match="no joint is on the ground; fix at least one joint"):
        sketch_tree(sketch, "x.dxf")


def test_a_document_of_freecad_with_other_shapes_and_construction_lines(tmp_path: Path) -> None:
    def line(x: int, y: int, u: int, v: int, construction: int = 0) -> str:
        ends = f'<LineSegment StartX="{x}" StartY="{y}" EndX="{u}" EndY="{v}"/>'
        return (
            f'<Geometry type="Part::GeomLineSegment"><Construction value="{construction}"/>{ends}</Geometry>'
        )

    def sketch(label: str, inside: str) -> str:
        named = f'<Property name="Label"><String value="{label}"/></Property>'
        listed = f'<Property name="Geometry"><GeometryList>{inside}</GeometryList></Property>'
        return f'<Object name="Sketch"><Properties>{named}{listed}</Properties></Object>'

    arc = '<Geometry type="Part::GeomArcOfCircle"><ArcOfCircle/></Geometry>'
    ground = '<Geometry><GeomPoint X="0" Y="0"/></Geometry><Geometry><GeomPoint X="300" Y="0"/></Geometry>'
    bars = [line(0, 0, 0, 100), line(0, 100, 250, 200), line(250, 200, 300, 0), line(0, 0, 900, 900, 1), arc]
    text = f'<Document><ObjectData><Object name="Body"/>{sketch("GROUND", ground)}{sketch("bars", "".join(bars))}'
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        archive.writestr("Document.xml", f"{text}</ObjectData></Document>")
    (tmp_path / "x.FCStd").write_bytes(out.getvalue())
    m, lost = read_foreign(tmp_path / "x.FCStd")
    assert lost == ["Part::GeomArcOfCircle of sketch 'bars'"]
    assert set(m.links) == {"ground", "bars 1", "bars 2", "bars 3"}
    assert sorted(m.points("bars 2").values()) == [(0.0, 0.0), pytest.approx((0.0725**0.5, 0.0))]


def test_what_a_sketch_does_not_keep() -> None:
    """One driver, the standard gravity or none, no friction and no other position."""
    m = da.load(examples()["two_drives"])
    tree: Any = m.to_tree() | {"gravity": [0, "-1.62 m/s^2"]}
    for joint in tree["joints"].values():
        joint["friction"] = {"coefficient": 0.1, "radius": "5 mm"}
    for drive in tree["drives"].values():
        drive["speed"] = "1 rad/s"
    rough = da.Mechanism.model_validate(tree | {"friction": {"enabled": True}})
    lost = foreign_bytes(rough, "x.pmks")[1]
    for note in (
        "gravity of 0, -1.62 m/s2: PMKS+ has the standard one, down, or none",
        "dry friction",
        "all drives but the first: PMKS+ has one",
    ):
        assert note in lost
    assert "all drives but one: pylinkage has one driver" in foreign_bytes(m, "x.pylinkage.json")[1]
    assert "dry friction" in foreign_bytes(rough, "x.sdf")[1]
    still = da.four_bar(positions=1)
    assert not [note for note in foreign_bytes(still, "x.pmks")[1] if "positions" in note]


@pytest.mark.parametrize("content", [b"", b"<mujoco><worldbody>", b"<mujoco></worldbody>"])
def test_a_file_that_breaks_off_is_no_xml(content: bytes) -> None:
    with pytest.raises(ModelError) as refused:
        parse(content, "x.xml")
    words = "mismatched tag" if b"/" in content else "no element found"
    assert str(refused.value) == f"x.xml:1: the file is not XML: {words}; save it again"


def test_a_json_file_is_a_linkage_of_others_if_its_links_are_a_list(tmp_path: Path) -> None:
    """Up to a million bytes; what is too large for it, cut, or not a file is read as a model file."""
    path = tmp_path / "x.json"
    for content, foreign in (
        (b'{"links": []}', True),
        (b'{"links": []}'.ljust(1_000_000), True),
        (b'{"links": []}'.ljust(1_000_001), False),
        (b'{"links": {}}', False),
        (b'[{"links": []}]', False),
        (b'{"links": [', False),
        (b"[" * 100_000, False),
    ):
        path.write_bytes(content)
        assert is_foreign(path) is foreign
    assert not is_foreign(tmp_path)
    assert not is_foreign(tmp_path / "nowhere.json")
    (tmp_path / "folder.json").mkdir()
    assert not is_foreign(tmp_path / "folder.json")
    assert is_foreign("nowhere.URDF")
