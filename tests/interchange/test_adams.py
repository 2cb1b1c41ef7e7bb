"""Command files of Adams View: what is written comes back with the same forces; others' are read or refused."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes, read_foreign
from dalembert.interchange.placements import body_313, to_body_313, turned
from tests.interchange.test_ondsel import FILES as BUNDLED
from tests.interchange.written_files import FILES, in_space, read_back
from tests.tiers import tiers

KEPT_ELSE = re.compile(r"\d+ of \d+ positions: the file has the first|published answers|the name '.*")
"""Notes of what does not change the forces of the first position."""


def compare(m: da.Mechanism, path: Path) -> list[str]:
    """Write and read back: joint forces of the same joints and efforts agree to 1e-9; returns what is not kept."""
    back, lost = read_back(m, path)
    space = in_space(m)
    ours, theirs = da.dynamics(space), da.dynamics(back)
    alike = [j for j in space.joints if j in back.joints and back.joints[j].type == space.joints[j].type]
    forces = np.array([[r.reaction(j)[0] for j in alike] for r in (ours, theirs)])
    efforts = np.array([[r.effort(d)[0] for d in space.drives] for r in (ours, theirs)])
    assert alike
    assert np.array_equal(*np.isnan(forces))
    largest = max(float(np.nanmax(np.abs(part), initial=0.0)) for part in (forces, efforts))
    assert largest > 0
    for first, second in (forces, efforts):
        assert np.nanmax(np.abs(first - second), initial=0.0) < 1e-9 * largest
    return lost


@pytest.mark.parametrize(
    "name",
    tiers(
        ["four_bar", "inverted_slider_crank", "rssr", "rccc"],
        ["excavator", "watt_1", "stephenson_2", "five_bar", "scotch_yoke", "truss", "screw_jack"],
        ["bennett", "spherical_four_bar", "hexapod", "rssp", "hooke_joint", "slider_crank"],
    ),
)
def test_bundled_mechanisms_come_back(name: str, tmp_path: Path) -> None:
    lost = compare(da.load(BUNDLED[name]), tmp_path / "x.cmd")
    assert not [note for note in lost if not KEPT_ELSE.fullmatch(note)]


SCREW = """
space: space
gravity: [1, 2, -9.81 m/s^2]
links:
  ground: {points: {O: [0, 0, 0]}}
  "nut 1": {points: {O: [0, 0, 0], P: [0.1, 0.2, 0]}, mass: 2, center: [0.1, 0, 0],
    inertia: [[0.02, 0.001, 0.002], [0.001, 0.03, 0.003], [0.002, 0.003, 0.025]]}
joints:
  S: {type: screw, links: [ground, "nut 1"], at: O, axis: [0.3, -0.2, 1], lead: 0.02}
drives:
  S: {freedom: turn, position: 0.3 rad, speed: 5 rad/s, acceleration: 7 rad/s^2}
loads:
  pull: {type: force, on: "nut 1", at: P, value: [30, -40, 50]}
  push: {type: force, on: "nut 1", at: center, value: 25, direction: [1, 1, 0], axes: link}
  twist: {type: couple, on: "nut 1", value: [3, 4, -5]}
  spun: {type: couple, on: "nut 1", value: [1, 2, -1], axes: link}
  wave: {type: couple, on: "nut 1", value: "0*cos(S)", direction: [1, 0, 0]}
"""


def test_a_screw_with_forces_and_couples(tmp_path: Path) -> None:
    assert compare(da.loads(SCREW), tmp_path / "x.cmd") == [
        "the name 'nut 1', which is 'nut_1' in the file",
        "load 'wave' (couple): its value changes or is unknown",
    ]


def test_another_force_is_another_effort(tmp_path: Path) -> None:
    m = da.loads(SCREW)
    path = tmp_path / "x.cmd"
    path.write_bytes(foreign_bytes(m, path)[0].replace(b'"70.71067811865476"', b'"71"'))
    back = read_foreign(path)[0]
    first, second = (da.dynamics(x).effort("S")[0] for x in (m, back))
    assert abs(second / first - 1) > 1e-6


def test_what_has_no_counterpart_is_not_written() -> None:
    with pytest.raises(ModelError, match="gear 'sun_mesh': the gears of Adams have no teeth"):
        foreign_bytes(da.load(BUNDLED["gear_train"]), "x.cmd")
    with pytest.raises(ModelError, match="drive 'A': a motion of Adams drives no spherical joint"):
        foreign_bytes(da.load(BUNDLED["rotating_shaft"]), "x.cmd")


def test_313_angles() -> None:
    """Of any rotation, and of those whose z axes are one line."""
    rng = np.random.default_rng(0)
    rotations = [turned(rng.normal(size=3), angle) for angle in rng.uniform(-4, 4, 50)]
    rotations += [turned((0, 0, 1), 2.0), turned((1, 2, 0), np.pi), np.eye(3)]
    for rotation in rotations:
        assert np.allclose(body_313(to_body_313(rotation)), rotation, rtol=0, atol=1e-14)


PLANE = """
gravity: [0, -9.80665 m/s^2]
units: {length: mm, inertia: kg*mm^2}
links:
  ground: {points: {A: [0, 0], D: [300, 0]}}
  crank: {points: {A: [-50, 0], B: [50, 0]}, mass: 0.5, center: [0, 0], inertia: 416.67}
  coupler: {points: {B: [-100, -100], C: [100, 100]}, mass: 0.5, center: [0, 0], inertia: 2604.17}
  rocker: {points: {D: [0, -100], C: [0, 100]}, mass: 0.5, center: [0, 0], inertia: 1666.67}
joints:
  A: {type: pin, links: [ground, crank]}
  B: {type: pin, links: [crank, coupler]}
  C: {type: pin, links: [coupler, rocker]}
  D: {type: pin, links: [ground, rocker]}
drives: {A: {position: 0, speed: 360 deg/s}}
assembly: {coupler: 0, rocker: 0}
"""


def test_a_four_bar_of_others_has_the_forces_of_the_same_in_the_plane() -> None:
    m, lost = read_foreign(FILES / "four_bar_a.cmd")
    assert lost[1:] == ["line 204: simulations"]
    ours, theirs = da.dynamics(da.loads(PLANE)), da.dynamics(m)
    assert theirs.effort("motion_crank")[0] == pytest.approx(ours.effort("A")[0], rel=1e-9)


def test_a_pendulum_of_others_hangs_where_it_was_turned_to() -> None:
    m, lost = read_foreign(FILES / "pendulum.cmd")
    assert len(lost) == 1
    assert "no center_of_mass_marker" in lost[0]
    assert m.points("link")["tip_mkr"] == pytest.approx([0, -0.2, 0])
    assert m.gravity_vector == pytest.approx([0, -9.80665, 0])
    assert m.assembly["link"].angle == pytest.approx(np.pi / 4)
    with pytest.raises(ModelError, match="has 1 degree of freedom and no drive"):
        da.kinematics(m)


def test_a_coupler_of_others_is_refused_at_its_line() -> None:
    with pytest.raises(
        ModelError, match=r"gear_coupler\.cmd:147: a coupler, which is a ratio of two freedoms"
    ):
        read_foreign(FILES / "gear_coupler.cmd")


ARM = """! an arm on a pin
model create model_name = M
part create rigid_body name_and_position part_name = .M.arm location = 0, 0, 0 orientation = 0, 0, 0
marker create marker_name = .M.arm.cm location = 3, 4, 0 orientation = 0, 0, 0
marker create marker_name = .M.arm.i location = 0, 0, 0 orientation = 30D, 0, 0
marker create marker_name = .M.ground.j location = 0, 0, 0 orientation = 0, 0, 0
part modify rigid_body mass_properties part_name = .M.ARM mass = 2 &
   ! of the arm
   center_of_mass_marker = .M.arm.cm ixx = 1 iyy = 1 izz = 1
constraint create joint revolute joint_name = .M.O i_marker_name = .M.arm.i j_marker_name = .M.ground.j
constraint create motion_generator motion_name = .M.motion_O joint_name = .M.O &
   type_of_freedom = rotational function = ""
constraint modify motion_generator motion_name = .M.motion_O function = "10D + 0.5*", "time + 2*TIME**2"
force create body gravitational gravity_field_name = gravity y_component_gravity = -9810
"""


def arm(tmp_path: Path, text: str) -> tuple[da.Mechanism, list[str]]:
    """The mechanism of a text, and what is not kept."""
    path = tmp_path / "arm.cmd"
    path.write_text(text)
    return read_foreign(path)


def test_motions_by_position_and_by_speed_in_other_units(tmp_path: Path) -> None:
    m, lost = arm(tmp_path, ARM)
    assert not lost
    r = da.dynamics(m)
    pose = np.deg2rad(10) + np.arctan2(4, 3) - np.deg2rad(30)
    moment = 2 * 9.81 * 0.005 * np.cos(pose) + (1e-6 + 2 * 0.005**2) * 4
    assert r.effort("O")[0] == pytest.approx(moment, rel=1e-12)
    speed = ARM.replace("motion_O function", "motion_O time_derivative = velocity function")
    speed = speed.replace('"10D + 0.5*", "time + 2*TIME**2"', '"0.5E-3 + 4.0e-6*time"')
    other, lost = arm(tmp_path, speed.replace("M\n", "M\ndefaults units time = millisecond length = mm\n", 1))
    assert not lost
    drive = other.drives["O"]
    assert (drive.position, drive.speed, drive.acceleration) == pytest.approx((np.deg2rad(30), 0.5, 4.0))
    assert other.gravity_vector[1] == pytest.approx(-9810e3)


@pytest.mark.parametrize("angle", ["30D", "30d", "0.5235987755982988"])
def test_an_angle_with_a_d_is_in_degrees_also_in_a_file_in_radians(angle: str, tmp_path: Path) -> None:
    text = ARM.replace("M\n", "M\ndefaults units angle = radians length = mm\n", 1)
    m, lost = arm(tmp_path, text.replace("orientation = 30D", f"orientation = {angle}"))
    assert not lost
    right = da.dynamics(arm(tmp_path, ARM)[0])
    assert da.dynamics(m).effort("O") == pytest.approx(right.effort("O"), rel=1e-12)


def test_a_motion_with_more_than_an_acceleration_is_kept_at_its_beginning(tmp_path: Path) -> None:
    text = ARM.replace('"10D + 0.5*", "time + 2*TIME**2"', '"0.2 + 0.1*sin(5*time)"')
    m, lost = arm(tmp_path, text)
    assert lost == ["line 13: the motion '.M.motion_O' after time 0"]
    assert m.drives["O"].speed == pytest.approx(0.5)


WRONG = {
    "macro create macro_name = x": "a macro (macro) is not read",
    'if condition = (! db_exists(".x"))': "a condition (if) is not read",
    "part create flexible_body name_and_position flexible_body_name = .M.f": "a flexible part",
    "contact create contact_name = .M.c": "a contact (contact) is not read",
    "force create element_like translational_spring_damper spring_damper_name = .M.s": "a spring, bushing",
    "force create direct general_force general_force_name = .M.s": "a force of several components",
    "marker modify marker_name = .M.arm.i location = (LOC_GLOBAL({0, 0, 0}))": "location is an expression",
    "constraint attributes constraint_name = .M.O active = off": "switched off",
    "file command read file_name = more.cmd": "a file to be read (file) is not read",
    "mar cre marker_name = .M.arm.k": "the command 'mar cre' is not read",
    "marker create marker_name = .M.arm.k along_axis_orientation = .M.ground.j": "the key along_axis_orientation",
    "marker create marker_name = .M.leg.k": "'.M.leg.k' names no part of M",
    "defaults units length = inch": "units change behind the first part",
    "marker modify marker_name = .M.arm.i location = 0, 1": "location has not 3 finite numbers",
    "marker modify marker_name = .M.arm.i location = 0, 1, x": "'x' is not a number",
    "part modify rigid_body mass_properties part_name = .M.arm ixy = 1": "products of inertia",
    "part create rigid_body name_and_position part_name = .M.leg\n"
    "part create rigid_body mass_properties part_name = .M.leg material_type = .M.steel": "the mass of 'leg' follows",
    "constraint create joint hooke joint_name = .M.H": "the command 'constraint create joint hooke' is not read",
    "constraint create joint screw joint_name = .M.T i_marker_name = .M.arm.i j_marker_name = .M.ground.j pitch = 1": ""
    "a screw joint of Adams holds no axis",
    'constraint modify motion_generator motion_name = .M.motion_O function = "STEP(time,0,0,1,1)"': "function 'STEP",
    'constraint modify motion_generator motion_name = .M.motion_O function = ""': "there is no function",
    "model create model_name = N": "the file makes two models",
    "marker create marker_name = .M.arm.k location = 1, 0, 0 relative_to = .M.leg": "there is no part 'leg'; make",
    "marker create marker_name = .M.arm.far location = 1, 0, 0\n"
    "part modify rigid_body mass_properties part_name = .M.arm mass = 1 center_of_mass_marker = .M.arm.i "
    "inertia_marker = .M.arm.far ixx = 1 iyy = 1 izz = 1": "the inertia marker is not at the mass centre; put it at",
    "part create rigid_body name_and_position part_name = .M.leg\n"
    "marker create marker_name = .M.leg.i\n"
    "force create direct single_component_force single_component_force_name = .M.F i_marker_name = .M.arm.i "
    "j_marker_name = .M.leg.i type_of_freedom = translational action_only = on function = 1": (
        "its direction turns with a third part; fix J to ground or the part"
    ),
}


@pytest.mark.parametrize("line", WRONG)
def test_what_is_not_read_is_refused_at_its_line(line: str, tmp_path: Path) -> None:
    last = f"{ARM}{line}".count("\n") + 1
    with pytest.raises(ModelError, match=rf"arm\.cmd:{last}: .*{re.escape(WRONG[line])}"):
        arm(tmp_path, f"{ARM}{line}\n")


@pytest.mark.parametrize(
    ("unit", "sentence"),
    [
        ("length = furlong", "unknown unit 'furlong'; write meter, millimeter"),
        ("orientation_type = body123", "orientation_type is body123; write body313"),
    ],
)
def test_units_that_are_not_read(unit: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=rf"arm\.cmd:3: {sentence}"):
        arm(tmp_path, ARM.replace("M\n", f"M\ndefaults units {unit}\n", 1))


def test_a_file_without_a_model_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"arm\.cmd:1: the file makes no model of Adams"):
        arm(tmp_path, "! nothing\n")


def test_markers_are_in_the_axes_of_the_coordinate_system_that_is_set(tmp_path: Path) -> None:
    """An arm that lies 7 mm along x: its markers are in ground axes, or in its own; one of the two is said."""
    text = ARM.replace(
        "location = 0, 0, 0 orientation = 0, 0, 0\nmarker",
        "location = 7, 0, 0 orientation = 0, 0, 0\nmarker",
        1,
    )
    axes = "axes of parts: without default_coordinate_system markers are in ground axes"
    m, lost = arm(tmp_path, text)
    assert lost == [axes]
    assert m.center("arm") == pytest.approx([-4e-3, 4e-3, 0])
    own = "defaults coordinate_system default_coordinate_system = .M.arm\n"
    m, lost = arm(tmp_path, text.replace("marker create", f"{own}marker create", 1))
    assert lost == []
    assert m.center("arm") == pytest.approx([3e-3, 4e-3, 0])


def test_a_part_may_have_the_name_of_its_model(tmp_path: Path) -> None:
    named = (
        ARM.replace("part_name = .M.arm", "part_name = M", 1)
        .replace(".M.arm", ".M.M")
        .replace(".M.ARM", ".m")
    )
    m, lost = arm(tmp_path, named)
    assert lost == []
    assert list(m.links) == ["ground", "M"]
    assert da.dynamics(m).effort("O") == pytest.approx(da.dynamics(arm(tmp_path, ARM)[0]).effort("O"))


@pytest.mark.parametrize(
    ("order", "function", "whole"),
    [
        ("displacement", "0.2 - 0.3*time**2*(sin(time)**2 + cos(time)**2)", True),
        ("displacement", "0.2 - 0.3*time**3", False),
        ("displacement", "0.2 - 0.3*(time + 1)**3/(time + 1)", True),  # a parabola, with rounding
        ("displacement", "0.3*(time + 1)**3/(time + 1) - 0.2", True),
        ("displacement", "0.2 + 0.3*time**2 - 1e-8*time**3", False),
        ("displacement", "0.2 + 1e-14*time**3", False),
        ("velocity", "0.5 - 0.1*time", True),
        ("velocity", "0.5 - 0.1*time**2", False),
        ("velocity", "0.5 + 0.1*time**2", False),
    ],
)
def test_a_motion_slowed_down_is_kept_as_one_that_is_sped_up(
    order: str, function: str, whole: bool, tmp_path: Path
) -> None:
    by = "" if order == "displacement" else f"time_derivative = {order} "
    text = ARM.replace('function = "10D + 0.5*", "time + 2*TIME**2"', f'{by}function = "{function}"')
    assert arm(tmp_path, text)[1] == ([] if whole else ["line 13: the motion '.M.motion_O' after time 0"])
