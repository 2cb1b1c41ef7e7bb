"""Mass, centre and inertia from shapes, against integrals by points, books and other shapes."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.algebra import space
from dalembert.errors import DalembertError, ModelError
from dalembert.model import Box, Cylinder, Link, SlenderBar, Sphere, StlMesh, Tube, load
from dalembert.model.links.sections import Section
from dalembert.model.links.shapes import ShapePart
from dalembert.model.links.stl_solids import MeshFile

STEEL = 7850.0
POINTS = {"A": (0.1, -0.2, 0.3), "B": (0.4, 0.2, 0.3)}


def properties(*shapes: ShapePart, **keys: Any) -> tuple[float, np.ndarray, np.ndarray]:
    link = Link(points=POINTS, shape=shapes if len(shapes) > 1 else shapes[0], **keys)
    m = da.Mechanism(space="space", links={"ground": Link(), "part": link})
    return m.mass("part"), np.array(m.center("part")), np.array(m.inertia("part"))


def integrated(inside: Any, low: Any, high: Any, count: int = 120) -> tuple[float, np.ndarray, np.ndarray]:
    """Volume, centre and inertia by the middles of small cubes: good to the surface's share of them."""
    axes = [np.linspace(a, b, count + 1)[:-1] + (b - a) / (2 * count) for a, b in zip(low, high, strict=True)]
    p = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    p = p[inside(p)]
    volume = len(p) * np.prod((np.array(high) - low) / count)
    center = p.mean(axis=0)
    r = p - center
    inertia = volume * ((r**2).sum() / len(r) * np.eye(3) - r.T @ r / len(r))
    return float(volume), center, inertia


def across(p: np.ndarray, a: np.ndarray, n: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    along = (p - a) @ n
    return along, np.linalg.norm(p - a - along[:, None] * n, axis=1)


AXIS = np.array([0.6, 0.8, 0.0])


def in_tube(inner: float, outer: float) -> Any:
    def inside(p: np.ndarray) -> np.ndarray:
        along, away = across(p, np.array(POINTS["A"]), AXIS)
        return (along > 0) & (along < 0.5) & (away > inner) & (away < outer)

    return inside


def in_box(p: np.ndarray) -> np.ndarray:
    own = (p - [0.1, 0.0, 0.2]) @ np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1.0]]).T
    return (np.abs(own) < np.array([0.3, 0.2, 0.1]) / 2).all(axis=1)


ROUND: Any = ((-0.1, -0.4, 0.1), (0.6, 0.4, 0.5))
SHAPES: list[Any] = [
    (Cylinder(between=("A", "B"), radius=0.15, density=STEEL), in_tube(-1, 0.15), *ROUND),
    (Tube(between=("A", "B"), radii=(0.1, 0.15), density=STEEL), in_tube(0.1, 0.15), *ROUND),
    (
        Sphere(radius=0.2, center=(0.1, 0, 0), density=STEEL),
        lambda p: np.linalg.norm(p - [0.1, 0, 0], axis=1) < 0.2,
        (-0.1, -0.2, -0.2),
        (0.3, 0.2, 0.2),
    ),
    (
        Box(size=(0.3, 0.2, 0.1), center=(0.1, 0, 0.2), axes={"x": (0.8, -0.6, 0), "z": (0, 0, 1)}, density=STEEL),
        in_box,
        (-0.2, -0.25, 0.1),
        (0.4, 0.25, 0.3),
    ),
]  # fmt: skip


@pytest.mark.parametrize("case", SHAPES, ids=lambda case: case[0].type)
def test_a_shape_is_the_integral_over_its_volume(case: Any) -> None:
    shape, inside, low, high = case
    mass, center, inertia = properties(shape)
    volume, middle, integral = integrated(inside, np.array(low), np.array(high))
    size = np.abs(integral).max()
    assert mass == pytest.approx(STEEL * volume, rel=0.01)
    assert center == pytest.approx(middle, abs=1e-3)
    assert inertia == pytest.approx(STEEL * integral, abs=0.015 * STEEL * size)


def test_formulas_of_the_books() -> None:
    """Meriam and Kraige, Dynamics, table D/4."""
    m, r, length = 3.0, 0.2, 0.5
    _, _, rod = properties(SlenderBar(length=length, axis=(1, 0, 0)), mass=m)
    assert rod.diagonal() == pytest.approx([0, m * length**2 / 12, m * length**2 / 12])
    _, _, cylinder = properties(Cylinder(length=length, radius=r), mass=m)
    sideways = m * r**2 / 4 + m * length**2 / 12
    assert cylinder.diagonal() == pytest.approx([sideways, sideways, m * r**2 / 2])
    _, _, ball = properties(Sphere(radius=r), mass=m)
    assert ball.diagonal() == pytest.approx([2 / 5 * m * r**2] * 3)
    _, _, block = properties(Box(size=(0.1, 0.2, 0.3)), mass=m)
    assert block.diagonal() == pytest.approx([m * 0.13 / 12, m * 0.10 / 12, m * 0.05 / 12])
    _, _, shell = properties(Tube(length=length, radii=(r * (1 - 1e-9), r)), mass=m)
    assert shell[2, 2] == pytest.approx(m * r**2)


def test_a_turned_shape_has_the_turned_inertia() -> None:
    turn = space.matrix(space.exp(np.array([0.3, -0.7, 0.5])))
    x, _, z = turn.T
    box = {"size": (0.1, 0.2, 0.3), "density": STEEL}
    _, _, straight = properties(Box(**box))
    _, _, turned = properties(Box(**box, axes={"x": tuple(x), "z": tuple(z)}))
    assert turned == pytest.approx(turn @ straight @ turn.T, abs=1e-13)
    _, _, upright = properties(Cylinder(length=0.5, radius=0.1, density=STEEL))
    _, _, leaning = properties(Cylinder(length=0.5, radius=0.1, axis=tuple(5 * z), density=STEEL))
    assert leaning == pytest.approx(turn @ upright @ turn.T, abs=1e-12)


def test_two_halves_are_the_whole() -> None:
    whole = properties(Box(size=(0.4, 0.2, 0.1), center=(0.2, 0, 0), density=STEEL))
    half = {"size": (0.2, 0.2, 0.1), "density": STEEL}
    halves = properties(Box(center=(0.1, 0, 0), **half), Box(center=(0.3, 0, 0), **half))
    for one, other in zip(whole, halves, strict=True):
        assert np.asarray(other) == pytest.approx(np.asarray(one))


def test_a_tube_filled_with_another_material() -> None:
    tube = Tube(length=0.5, radii=(0.1, 0.15), density=STEEL)
    core = Cylinder(length=0.5, radius=0.1, density=1000)
    mass, center, inertia = properties(tube, core)
    parts = properties(tube), properties(core)
    assert mass == pytest.approx(sum(p[0] for p in parts))
    assert center == pytest.approx([0, 0, 0])
    assert inertia == pytest.approx(sum(p[2] for p in parts))


@pytest.mark.parametrize("keys", [{"mass": 5.0}, {"weight": 5.0 * 9.80665}])
def test_a_given_mass_is_spread_evenly(keys: dict[str, float]) -> None:
    shapes = Box(size=(0.4, 0.2, 0.1)), Sphere(radius=0.1, center=(0.5, 0, 0))
    mass, center, inertia = properties(*shapes, **keys)
    dense = properties(*(shape.model_copy(update={"density": 2.0}) for shape in shapes))
    assert mass == pytest.approx(5.0)
    assert center == pytest.approx(dense[1])
    assert inertia == pytest.approx(dense[2] * 5.0 / dense[0])


def test_a_shape_in_the_plane_gives_the_inertia_about_the_plane_s_normal() -> None:
    rod = Link(
        points={"A": (0, 0), "B": (0.3, 0.4)}, shape=Cylinder(between=("A", "B"), radius=0.01, density=STEEL)
    )
    disk = Link(points={"O": (0, 0)}, shape=Cylinder(length=0.02, radius=0.1, center=(0.1, 0), density=STEEL))
    m = da.Mechanism(links={"ground": Link(), "rod": rod, "disk": disk})
    assert m.center("rod") == pytest.approx((0.15, 0.2))
    assert m.inertia("rod") == pytest.approx(m.mass("rod") * (3 * 0.01**2 + 0.25) / 12)
    assert m.mass("disk") == pytest.approx(STEEL * math.pi * 0.01 * 0.02)
    assert m.center("disk") == pytest.approx((0.1, 0.0))
    assert m.inertia("disk") == pytest.approx(m.mass("disk") * 0.1**2 / 2)
    assert m.point("rod", "center") == m.links["rod"].point("center")


def test_a_plane_machine_of_shapes_is_that_of_their_numbers() -> None:
    plain = da.slider_crank(crank=0.05, rod=0.2)
    points = plain.links["rod"].points
    shaped = plain.with_values(
        {"links.rod": Link(points=points, shape=Cylinder(between=tuple(points), radius=0.01, density=STEEL))}
    )
    numbers = Link(
        points=points, mass=shaped.mass("rod"), center=shaped.center("rod"), inertia=shaped.inertia("rod")
    )
    drive = plain.drives.keys().__iter__().__next__()
    given = da.dynamics(plain.with_values({"links.rod": numbers})).effort(drive)
    assert da.dynamics(shaped).effort(drive) == pytest.approx(given, rel=1e-13)
    k = da.compile(
        shaped, vary=["links.rod.shape.radius", "links.rod.shape.density"], outputs=[f"effort.{drive}"]
    )
    for radius, density in ((0.01, STEEL), (0.02, 1000.0)):
        changed = shaped.with_values({"links.rod.shape.radius": radius, "links.rod.shape.density": density})
        compiled = k(np.array([[radius, density]])).effort(drive)[0]
        assert compiled == pytest.approx(da.dynamics(changed).effort(drive), rel=1e-10)


# meshes


def box_mesh(path: Path, size: tuple[float, float, float] = (1.0, 2.0, 3.0)) -> Any:
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.box(size)
    mesh.apply_translation((10, 0, 0))
    mesh.export(path)
    return mesh


FILE = """space: space
units: {length: mm}
links:
  ground: {}
  part:
    points: {O: [0, 0, 0]}
    shape: {type: mesh, file: parts/box.stl, density: 7850 kg/m^3}
"""


def test_a_mesh_stands_beside_the_model_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "parts").mkdir()
    box_mesh(tmp_path / "parts" / "box.stl")
    (tmp_path / "model.yaml").write_text(FILE)
    monkeypatch.chdir(tmp_path / "parts")
    m = load(tmp_path / "model.yaml")
    own = properties(Box(size=(1e-3, 2e-3, 3e-3), center=(0.01, 0, 0), density=STEEL))
    assert m.mass("part") == pytest.approx(own[0])
    assert m.center("part") == pytest.approx(own[1])
    assert np.array(m.inertia("part")) == pytest.approx(own[2], abs=1e-18)
    m.save(tmp_path / "again.yaml")
    assert load(tmp_path / "again.yaml") == m
    inches = m.with_values({"links.part.shape.unit": 0.0254})
    assert inches.mass("part") == pytest.approx(m.mass("part") * 25.4**3)
    assert np.array(inches.inertia("part")) == pytest.approx(np.array(m.inertia("part")) * 25.4**5)


def test_a_ball_of_triangles_is_nearly_a_ball(tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    trimesh.creation.icosphere(subdivisions=5, radius=0.2).export(tmp_path / "ball.stl")
    mesh = StlMesh(file=MeshFile("ball.stl", str(tmp_path)), unit=1.0, density=STEEL)
    own, round_ = properties(mesh), properties(Sphere(radius=0.2, density=STEEL))
    assert own[0] == pytest.approx(round_[0], rel=1e-3)
    assert own[2] == pytest.approx(round_[2], abs=2e-3 * round_[2].max())


def test_meshes_that_are_no_solids(tmp_path: Path) -> None:
    mesh = box_mesh(tmp_path / "closed.stl")
    mesh.update_faces([k > 0 for k in range(len(mesh.faces))])
    mesh.export(tmp_path / "open.stl")
    (tmp_path / "text.stl").write_text("this is no mesh")
    (tmp_path / "folder.stl").mkdir()
    for name, says in {
        "open.stl": "the surface of the mesh 'open.stl' is not closed, so it has no volume; "
        "close its holes, or give mass, center and inertia",
        "text.stl": "the mesh 'text.stl' ",
        "folder.stl": "the mesh 'folder.stl' is not an ordinary file",
        "none.stl": "file 'none.stl' does not exist; check the name; it is relative to the model file",
    }.items():
        with pytest.raises(ModelError) as caught:
            StlMesh(file=MeshFile(name, str(tmp_path)), density=1)
        assert says in str(caught.value)


NOT_CLOSED = (
    "the surface of the mesh 'bad.stl' is not closed, so it has no volume; close its holes, or give mass, center "
    "and inertia"
)


@pytest.mark.parametrize("bad", ["nan", "inf"])
@pytest.mark.parametrize(
    ("every", "said"),
    [
        (False, NOT_CLOSED),
        (True, "the mesh 'bad.stl' has no triangle whose corners are all numbers; export it again as STL"),
    ],
)
def test_triangles_with_a_corner_nowhere_are_left_out(
    every: bool, said: str, bad: str, tmp_path: Path
) -> None:
    corners = {"000": "0 0 0", "100": "1 0 0", "010": "0 1 0", "001": f"0 0 {bad}"}
    corners = dict.fromkeys(corners, f"0 0 {bad}") if every else corners
    facets = ["".join(f"vertex {corners[c]}\n" for c in face) for face in FACES]
    loops = [f"facet normal 0 0 0\nouter loop\n{facet}endloop\nendfacet\n" for facet in facets]
    (tmp_path / "bad.stl").write_text(f"solid bad\n{''.join(loops)}endsolid bad\n")
    with pytest.raises(ModelError) as caught:
        StlMesh(file=MeshFile("bad.stl", str(tmp_path)), density=1)
    assert str(caught.value) == said


FACES = (("000", "010", "100"), ("000", "100", "001"), ("000", "001", "010"), ("100", "010", "001"))


@pytest.mark.parametrize("inside_out", [False, True])
@pytest.mark.parametrize(("unit", "size"), [
    ("", 1.0), (", unit: cm", 0.01), (", unit: 2 mm", 0.002), (", unit: in", 0.0254), (", unit: 3", 3.0),
])  # fmt: skip
def test_a_corner_of_a_cube_has_its_integrals(
    tmp_path: Path, inside_out: bool, unit: str, size: float
) -> None:
    """Also where the triangles of the file are all turned the wrong way; its unit has a number, or is one alone."""
    lines = ["solid corner"]
    for face in FACES:
        corners = [" ".join(corner) for corner in (face[::-1] if inside_out else face)]
        lines += [
            "facet normal 0 0 0",
            "outer loop",
            *(f"vertex {c}" for c in corners),
            "endloop",
            "endfacet",
        ]
    (tmp_path / "corner.stl").write_text("\n".join([*lines, "endsolid corner", ""]))
    shape = f"{{type: mesh, file: corner.stl, density: 1200{unit}}}"
    (tmp_path / "m.yaml").write_text(
        f"space: space\nunits: {{length: m}}\nlinks: {{ground: {{}}, a: {{shape: {shape}}}}}\n"
    )
    m = load(tmp_path / "m.yaml")
    assert m.mass("a") == pytest.approx(200 * size**3)
    assert m.center("a") == pytest.approx([size / 4] * 3)
    about = np.where(np.eye(3, dtype=bool), 3 / 40, 1 / 80) * 200 * size**5
    assert np.array(m.inertia("a")) == pytest.approx(about)


def test_without_the_package_the_message_says_how_to_install_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    box_mesh(tmp_path / "box.stl")
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(
        DalembertError, match=r"a mesh needs the package trimesh, .* pip install 'dalembert\[cad\]'"
    ):
        StlMesh(file=MeshFile("box.stl", str(tmp_path)), density=1)


def walls(*parts: tuple[float, float, float, float]) -> tuple[float, float, float]:
    """Area and second moments about y and z of rectangles from (z, y) to (z, y), by quadrature in 400 strips each."""
    area = second_y = second_z = 0.0
    for z0, y0, z1, y1 in parts:
        z, y = (a + (b - a) * (np.arange(400) + 0.5) / 400 for a, b in ((z0, z1), (y0, y1)))
        each = (z1 - z0) * (y1 - y0) / 400
        area, second_y, second_z = (
            area + 400 * each,
            second_y + each * (z**2).sum(),
            second_z + each * (y**2).sum(),
        )
    return area, second_y, second_z


def test_sections_are_integrals_over_their_area() -> None:
    """Second moments about both axes, the farthest fibres, the largest shear stress; tubes between two circles."""
    I = ("80 mm", "50 mm", "5 mm", "8 mm")  # noqa: E741
    sections = {
        Section(rectangle=("20 mm", "40 mm")): (walls((-0.01, -0.02, 0.01, 0.02)), (0.02, 0.01)),
        Section(I=I): (
            walls(
                (-0.025, 0.032, 0.025, 0.04), (-0.025, -0.04, 0.025, -0.032), (-0.0025, -0.032, 0.0025, 0.032)
            ),
            (0.04, 0.025),
        ),
    }
    for section, ((area, about_y, about_z), reach) in sections.items():
        assert section.area_of == pytest.approx(area)
        assert section.second_moments == pytest.approx((about_y, about_z), rel=1e-5)
        assert section.reach == pytest.approx(reach)
        assert not section.round
    assert Section(rectangle=("20 mm", "40 mm")).shear == pytest.approx((1.5 / 8e-4,) * 2)
    assert Section(I=I).shear == pytest.approx((1 / (0.005 * 0.064), 0.75 / (0.05 * 0.008)))
    for long, exact in (
        (1.0, 0.2082),
        (2.0, 0.2459),
        (10.0, 0.3123),
    ):  # Timoshenko; Roark's polynomial is within 0.2 %
        bar = Section(rectangle=(f"{10 * long} mm", "10 mm"))
        assert bar.torsion == pytest.approx(exact * long * 1e-6, rel=2e-3)
    r = np.linspace(0.012, 0.02, 4001)
    middle = (r[1:] + r[:-1]) / 2
    ring, full = Section(tube=("24 mm", "40 mm")), Section(circle="40 mm")
    second = float((np.pi * middle**3 * np.diff(r)).sum())
    assert ring.second_moments == pytest.approx((second, second), rel=1e-6)
    assert (ring.reach, full.reach, ring.round, full.round) == ((0.02, 0.02), (0.02, 0.02), True, True)
    assert ring.torsion == pytest.approx(2 * second / 0.02, rel=1e-6)
    assert full.shear == pytest.approx((4 / 3 / (np.pi * 4e-4),) * 2)
    moment = 2 / 3 * (0.02**3 - 0.012**3)  # of the half above the axis
    assert ring.shear == pytest.approx((moment / (second * 2 * 0.008),) * 2, rel=1e-6)
    given = Section(area="1 cm^2", modulus="2 cm^3", inertia="3 cm^4")
    found = (given.area_of, *given.second_moments, *given.reach, *given.shear)
    assert found == pytest.approx((1e-4, 3e-8, 3e-8, 0.015, 0.015, 15000.0, 15000.0))
    given_twice = {"rectangle": ("1 m", "2 m"), "circle": "1 m"}
    for keys, said in (
        ({}, "the section has no size"),
        (given_twice, "rectangle and circle give it twice"),
        ({"area": "1 m^2", "inertia": "1 m^4"}, "the section has no modulus"),
        ({"tube": ("2 m", "2 m")}, "the inner diameter is not smaller"),
        ({"I": ("2 m", "1 m", "1 m", "0.1 m")}, "web and flanges do not fit"),
        ({"I": ("2 m", "1 m", "0.1 m", "1 m")}, "web and flanges do not fit"),
    ):
        with pytest.raises(da.ModelError, match=said):
            Section(**keys)
    assert Section(tube=("1.99 m", "2 m")).area_of > 0
    assert Section(I=("2 m", "1 m", "0.99 m", "0.99 m")).area_of > 0
