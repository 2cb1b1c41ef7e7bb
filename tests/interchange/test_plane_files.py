"""PMKS, PMKS+, pylinkage, DXF and FreeCAD: joints are where the files have them, and the linkages run."""

from __future__ import annotations

import io
import json
import math
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import read_foreign
from tests.interchange.written_files import FILES

LINKS = dict(
    line.split(None, 1)
    for line in (FILES / "links.txt").read_text(encoding="utf-8").splitlines()
    if line[0] != "#"
)


@pytest.mark.parametrize(
    ("name", "links", "joints"),
    [("4-Bar", 3, 4), ("Watt_I", 5, 7), ("Stephenson_III", 5, 7), ("Slider_Crank", 3, 4), ("Force", 3, 4)],
)
def test_share_links_of_pmks_plus(name: str, links: int, joints: int, tmp_path: Path) -> None:
    (tmp_path / "x.pmks").write_text(LINKS[name], encoding="utf-8")
    m, lost = read_foreign(tmp_path / "x.pmks")
    assert (len(m.links) - 1, len(m.joints)) == (links, joints)
    assert re.search("rounded to 0.001", lost[0])
    r = da.dynamics(m)
    assert r.status == ("ok",)
    assert da.mobility(m).freedoms == 1
    assert np.isfinite(r.effort_array).all()


def test_numbers_of_a_link(tmp_path: Path) -> None:
    """`Force` has its crank from (0, 0) to (fk, 1Jz) in base 64 and thousandths, a force on the coupler."""
    (tmp_path / "x.pmks").write_text(LINKS["Force"], encoding="utf-8")
    m, _ = read_foreign(tmp_path / "x.pmks")
    b = ((41 * 64 + 46) / 1e5, ((1 * 64 + 19) * 64 + 61) / 1e5)
    assert m.points("Crank")["b"] == pytest.approx((math.hypot(*b), 0), abs=1e-12)
    assert math.tan(float(da.kinematics(m).angle("Crank")[0])) == pytest.approx(b[1] / b[0], rel=1e-12)
    assert m.mass("Coupler") == 1.0
    assert m.loads["F1"].on == "Coupler"  # type: ignore[union-attr]


@pytest.mark.parametrize("name", ["4bar1.pmks", "4bar1.txt"])
def test_both_files_of_the_first_pmks_say_the_same(name: str) -> None:
    m, _ = read_foreign(FILES / name)
    r = da.kinematics(m)
    assert r.point("coupler", "J3")[0] == pytest.approx([400, 480], abs=1e-9)
    assert r.point("coupler", "J5")[0] == pytest.approx([500, 125], abs=1e-9)
    assert [joint.links[0] for joint in m.joints.values()] == ["ground", "input", "coupler", "ground"]
    assert m.points("output")["J4"] == pytest.approx([0, 0]), "a link begins on the ground"


@pytest.mark.parametrize("name", ["fourbar.json", "fourbar_long.json", "slider_crank.json"])
def test_pylinkage_has_its_joints_where_they_are(name: str) -> None:
    tree = json.loads((FILES / name).read_text(encoding="utf-8"))
    m, lost = read_foreign(FILES / name)
    r = da.kinematics(m)
    assert r.status == ("ok",)
    for joint in tree["joints"]:
        key = joint["id"].replace(".", "_")
        link = next(link for link in m.links if link != "ground" and key in m.points(link))
        assert r.point(link, key)[0] == pytest.approx(joint["position"], abs=1e-12)
    assert any("rad a step" in note for note in lost)


def test_model_files_in_json_are_not_taken_for_it(tmp_path: Path) -> None:
    m = da.four_bar()
    m.save(tmp_path / "x.json")
    assert da.load(tmp_path / "x.json") == m
    (tmp_path / "y.json").write_text('{"links": [{"id": "a"}], "joints": []}', encoding="utf-8")
    with pytest.raises(ModelError, match=r"y\.json:1: this is not a file of pylinkage"):
        da.load(tmp_path / "y.json")


SHAPES = {
    "GROUND": [[(0, 0)], [(300, 0)]],
    "crank": [[(0, 0), (0, 100)]],
    "coupler": [[(0, 100), (250, 200)]],
    "rocker": [[(300, 0), (250, 200)]],
    "DRIVE": [[(0, 0)]],
}
"""A four-bar, millimetres: a point is a circle."""


def checked(m: da.Mechanism) -> None:
    r = da.kinematics(m)
    assert r.status == ("ok",)
    assert len(m.joints) == 4
    assert len(m.drives) == 1
    lengths = sorted(math.dist(*list(m.points(link).values())[:2]) for link in m.links if link != "ground")
    assert lengths == pytest.approx([0.1, math.hypot(0.05, 0.2), math.hypot(0.25, 0.1)], abs=1e-12)
    assert float(r.drive_position(r.drives[0])[0]) == pytest.approx(math.pi / 2)


def test_a_dxf_skeleton(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new(units=4)
    space = drawing.modelspace()
    for layer, shapes in SHAPES.items():
        for points in shapes:
            keys = {"layer": layer}
            space.add_circle(points[0], 5, keys) if len(points) == 1 else space.add_line(
                *points, dxfattribs=keys
            )
    space.add_text("a title")
    drawing.saveas(tmp_path / "x.dxf")
    m, lost = read_foreign(tmp_path / "x.dxf")
    checked(m)
    assert lost == ["TEXT entities"]
    assert set(m.links) == {"ground", "crank", "coupler", "rocker"}
    space.add_line((250, 200), (250, 200.001), {"layer": "SLIDE"})
    drawing.saveas(tmp_path / "y.dxf")
    assert any(joint.slides for joint in read_foreign(tmp_path / "y.dxf")[0].joints.values())


def document(shapes: dict[str, list[list[tuple[int, int]]]]) -> bytes:
    """A FreeCAD document with a sketch a layer."""
    parts = []
    for label, lines in shapes.items():
        inner = "".join(
            f'<Geometry><Circle CenterX="{p[0][0]}" CenterY="{p[0][1]}" Radius="5"/></Geometry>'
            if len(p) == 1
            else f'<Geometry><LineSegment StartX="{p[0][0]}" StartY="{p[0][1]}" EndX="{p[1][0]}" '
            f'EndY="{p[1][1]}"/></Geometry>'
            for p in lines
        )
        name = f'<Property name="Label"><String value="{label}"/></Property>'
        listed = f'<Property name="Geometry"><GeometryList>{inner}</GeometryList></Property>'
        parts.append(f'<Object name="Sketch"><Properties>{name}{listed}</Properties></Object>')
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("Document.xml", f"<Document><ObjectData>{''.join(parts)}</ObjectData></Document>")
    return out.getvalue()


def test_sketches_of_freecad(tmp_path: Path) -> None:
    (tmp_path / "x.FCStd").write_bytes(document(SHAPES))
    checked(read_foreign(tmp_path / "x.FCStd")[0])
    (tmp_path / "y.FCStd").write_bytes(document({"GROUND": [[(0, 0)]]}))
    with pytest.raises(ModelError, match="no sketch with lines"):
        read_foreign(tmp_path / "y.FCStd")


FIRST = "ground,input,R,0,0,0,tfff\ninput,coupler,R,1,2,0,tfff\n"


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        (
            "x.pmks",
            LINKS["4-Bar"].replace("GB,B", "OB,B"),
            ":1: joint 'B' is welded; join its links into one in PMKS+",
        ),
        (
            "x.txt",
            FIRST + "coupler,rocker,RP,1,1,0,tfff\n",
            ":3: a joint RP has no counterpart; use R and P",
        ),
        (
            "x.pmks",
            json.dumps({"Joints": [{"TypeOfJoint": "G", "X": 1, "Y": 2, "Links": ["ground", "input"]}]}),
            ":1: the linkage of PMKS is not complete: a joint G has no counterpart here; use R and P; copy all of it",
        ),
    ],
)
def test_joints_of_pmks_without_a_counterpart_are_refused(
    name: str, text: str, said: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as refused:
        read_foreign(tmp_path / name)
    assert str(refused.value) == f"{tmp_path / name}{said}"


def test_a_zip_bomb_is_refused(tmp_path: Path) -> None:
    """Thirty million bytes in thirty thousand: only as much is unpacked as a file may have."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("Document.xml", b" " * 30_000_000)
    (tmp_path / "x.FCStd").write_bytes(out.getvalue())
    with pytest.raises(ModelError, match="more than 5000000 bytes"):
        read_foreign(tmp_path / "x.FCStd")
    (tmp_path / "y.FCStd").write_bytes(b"no zip")
    with pytest.raises(
        ModelError, match=r"y\.FCStd:1: the file is not a FreeCAD document: .*; save it in FreeCAD as"
    ):
        read_foreign(tmp_path / "y.FCStd")


@pytest.mark.parametrize(
    "text", ["app.pmksplus.com/?0P.TY.K", "nothing", "{}", "app.pmksplus.com/?" + "A" * 30_000]
)
def test_what_is_no_linkage_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "x.pmks").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=r"x\.pmks:1: "):
        read_foreign(tmp_path / "x.pmks")


@pytest.mark.parametrize("off", [0.0, 30.0, -30.0])
@pytest.mark.parametrize("back", [False, True])
def test_a_slide_of_a_skeleton_holds_the_pin_that_is_on_it(off: float, back: bool, tmp_path: Path) -> None:
    """And no other, on whichever side of the line this lies."""
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new(units=4)
    space = drawing.modelspace()
    space.add_line((0, 0), (50, 0), {"layer": "crank"})
    space.add_line((50, 0), (200, 0), {"layer": "rod"})
    space.add_circle((0, 0), 5, {"layer": "GROUND"})
    ends = ((100, off), (300, off))
    space.add_line(*(ends[::-1] if back else ends), dxfattribs={"layer": "SLIDE"})
    drawing.saveas(tmp_path / "x.dxf")
    m, _ = read_foreign(tmp_path / "x.dxf")
    assert [joint.type for joint in m.joints.values()].count("slider") == (off == 0)
