"""MJCF, URDF, SDFormat: files of others are read or refused with a sentence; what is written gives the same numbers."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import NotKept, foreign_bytes, read_foreign
from dalembert.interchange.link_graph import inertia_matrix
from dalembert.interchange.xml_tree import parse
from dalembert.model.description import mechanism
from tests import random_mechanisms, random_space
from tests.interchange.written_files import FILES, driven_alike, in_space, largest_difference, read_back
from tests.tiers import over, tiers

REFUSED = re.compile(
    "not lifted|be lifted|of no solid|no equality|its wheels|axes are not parallel|blocked|chain of joints|second link"
    "|drives the joint|have no teeth"
)
"""Reasons for which a mechanism has no MJCF file; a driven universal joint comes back as two revolutes."""

READ = {
    "jdotv_connect_2d.xml": (4, 5, 2),
    "jdotv_connect_3d.xml": (2, 2, 5),
    "equality_site.xml": (3, 3, 3),
    "multiple_constraints.xml": (6, 6, 5),
    "actuator_slider_crank.xml": (3, 3, 3),
    "four_bar.sdf": (3, 3, 3),
    "four_bar_loop.sdf": (3, 4, 1),
    "four_bar_weld.sdf": (4, 4, 4),
    "5bar_linkage.urdf": (7, 8, 3),
    "robot_delta.urdf": (15, 18, 5),
    "talos_like.urdf": (17, 18, 7),
}
"""Moving links, joints and freedoms of each stored file that is read."""


@pytest.mark.parametrize("name", READ)
def test_files_of_others_are_read(name: str) -> None:
    m, lost = read_foreign(FILES / name)
    links, joints, _ = READ[name]
    assert (len({*m.links} - {"ground"}), len(m.joints)) == (links, joints)
    assert lost


@pytest.mark.parametrize(
    "name",
    tiers(
        [name for name in READ if READ[name][0] < 5],
        ["multiple_constraints.xml", "5bar_linkage.urdf"],
        ["robot_delta.urdf", "talos_like.urdf"],
    ),
)
def test_their_freedoms_are_counted_by_rank(name: str) -> None:
    with pytest.raises(ModelError, match=f"the mechanism has {READ[name][2]} degrees? of freedom and"):
        da.mobility(read_foreign(FILES / name)[0])


def test_a_coupling_without_wheels_is_refused_at_its_line() -> None:
    with pytest.raises(ModelError, match=r"armature_equivalence\.xml:35: .*the axes are one line"):
        read_foreign(FILES / "armature_equivalence.xml")
    with pytest.raises(ModelError, match=r"robotiq_c2_model\.urdf:136: .*a parallelogram does this"):
        read_foreign(FILES / "robotiq_c2_model.urdf")


@pytest.mark.parametrize("suffix", [".xml", ".sdf"])
@pytest.mark.parametrize("name", tiers(["four_bar"], ["rssr", "quick_return"]))
def test_written_and_read_back_gives_the_same_effort(name: str, suffix: str, tmp_path: Path) -> None:
    m = da.load(examples()[name])
    back, lost = read_back(m, tmp_path / f"x{suffix}")
    assert lost
    assert largest_difference(m, back, suffix == ".sdf") < 1e-12


def test_another_mass_is_another_effort(tmp_path: Path) -> None:
    m = da.load(examples()["four_bar"])
    back, _ = read_back(m.with_values({"links.coupler.weight": "7.8 lbf"}), tmp_path / "x.xml")
    assert 1e-4 < largest_difference(m, back) < 0.1


@over(0, 20)
def test_random_mechanisms_come_back_from_mjcf(seed: int, tmp_path: Path) -> None:
    """Poses, speeds and forces of the tree and of its loops, where MJCF has the joints."""
    plane = random_mechanisms.tree(random_mechanisms.random_mechanism(seed, links=(4, 8), loads=False))
    trees = (plane, random_space.tree(random_space.random_case(seed)))
    for k, tree in enumerate(trees):
        m = mechanism(tree)
        try:
            back, lost = read_back(m, tmp_path / f"{k}.xml")
            damped = any(note.startswith("damping") for note in lost)
            difference = 0.0 if damped else largest_difference(m, back)
        except ModelError as error:
            difference = 0.0 if REFUSED.search(str(error)) else np.inf
        assert difference < 1e-8


def test_a_urdf_is_the_tree(tmp_path: Path) -> None:
    """Masses and principal inertias are kept; the loop is cut, which is said."""
    m = da.load(examples()["rssr"])
    back, lost = read_back(m, tmp_path / "x.urdf")
    assert any("closes a loop" in note for note in lost)
    assert {"crank", "rod", "rocker"} <= set(back.links)
    for name in ("crank", "rod", "rocker"):
        assert back.mass(name) == pytest.approx(m.mass(name), rel=1e-15)
        ours, theirs = (np.linalg.eigvalsh(inertia_matrix(x.inertia(name))) for x in (m, back))
        assert np.allclose(ours, theirs, rtol=1e-12)


def test_convert_says_what_is_not_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "x.xml"
    assert main(["convert", str(examples()["four_bar"]), str(target)]) == 0
    said = capsys.readouterr()
    assert "not kept: load 'F_P' (force): MJCF cannot state forces" in said.err
    assert said.out == f"Written: {target}\n"
    assert main(["convert", str(target), "-o", str(tmp_path / "y.yaml")]) == 0
    assert da.load(tmp_path / "y.yaml").joints.keys() == {"O2", "A", "B", "O4"}
    assert main(["convert", str(examples()["four_bar"]), str(tmp_path / "z.xml"), "--strict"]) == 2
    assert not (tmp_path / "z.xml").exists()
    assert main(["convert", str(examples()["four_bar"])]) == 2


def test_load_and_save_warn(tmp_path: Path) -> None:
    m = da.load(examples()["rssr"])
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        m.save(tmp_path / "x.xml")
        da.load(FILES / "5bar_linkage.urdf")
    assert {w.category for w in said} == {NotKept}
    texts = " ".join(str(w.message) for w in said)
    assert "x.xml: not kept: load 'resistance'" in texts
    assert "the root link 'built' is ground" in texts


BOMB = b'<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><mujoco>&b;</mujoco>'


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (BOMB, "declares a document type"),
        (b"<mujoco>" + b"<a>" * 200 + b"</a>" * 200 + b"</mujoco>", "too many elements"),
        (b"<mujoco>" + b"<a>" * 199 + b"</a>" * 199 + b"</mujoco>", "no moving link"),
        (b"<mujoco>" + b" " * 5_000_000 + b"</mujoco>", "more than 5000000 bytes"),
        (b"<mujoco><worldbody></mujoco>", "not XML: mismatched tag"),
        (b"<robot/>", "<robot> is not MJCF"),
        (b"<mujoco><include file='x.xml'/></mujoco>", "<include> has no counterpart"),
        (
            b"<mujoco><worldbody><body><joint axis='0 0 0'/></body></worldbody></mujoco>",
            "axis of a joint is 0",
        ),
        (b"<mujoco><worldbody><body pos='1 2'/></worldbody></mujoco>", "pos of <body> has 2 numbers; give 3"),
        (b"<mujoco><worldbody><body pos='1 2 nan'/></worldbody></mujoco>", "not finite"),
        (
            b"<mujoco><worldbody><body name='b'><geom mesh='m'/></body></worldbody></mujoco>",
            "comes from its mesh 'm'; give its body an <inertial>",
        ),
    ],
)
def test_bad_files_are_refused_with_file_and_line(content: bytes, words: str, tmp_path: Path) -> None:
    (tmp_path / "bad.xml").write_bytes(content)
    with pytest.raises(ModelError, match=r"bad\.xml:1: ") as refused:
        read_foreign(tmp_path / "bad.xml")
    assert words in str(refused.value)


def test_drawings_in_comments_are_no_error() -> None:
    """XML allows no two hyphens there; other programs read them, and lines are counted on."""
    assert parse(b"<a>\n<!-- ---\n--- -->\n<b/></a>", "x").parts[0].line == 4


NAMED = {
    "MJCF": "x.xml",
    "MuJoCo": "x.xml",
    "SDF": "x.sdf",
    "URDF": "x.urdf",
    "asmt": "x.asmt",
    "Ondsel": "x.asmt",
}
"""Words for formats in remedies."""


@pytest.mark.long
def test_every_bundled_problem_is_written_or_refused() -> None:
    """A format that a remedy recommends writes the problem."""
    counts = {True: 0, False: 0}
    for path in list(examples().values()) + list(cases().values())[::6]:
        m = da.load(path)
        for name in ("x.xml", "x.asmt"):
            try:
                content, _ = foreign_bytes(m, name)
                counts[True] += content.startswith((b"<?xml", b"OndselSolver"))
            except ModelError as error:
                counts[False] += bool(REFUSED.search(str(error)))
                for word in NAMED:
                    if word in error.remedy:
                        foreign_bytes(m, NAMED[word])
    assert counts[True] > 40 > 30 > counts[False] > 4


def test_positions_and_speeds_of_the_keyframe(tmp_path: Path) -> None:
    """Drives come back at the file's first position, with its speed."""
    m = da.load(examples()["four_bar"])
    back, _ = read_back(m, tmp_path / "x.xml")
    assert float(back.drives["O2"].position) == pytest.approx(np.pi / 3, rel=1e-14)  # type: ignore[arg-type]
    assert driven_alike(back, in_space(m), False).drives.keys() == {"O2"}
