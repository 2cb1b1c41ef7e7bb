"""PMKS+ links and pylinkage files that are written: read back, and by pylinkage, whose own motion is compared."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes, read_foreign
from dalembert.interchange.sketches.pmks_links import decimal
from dalembert.interchange.sketches.pmks_writer import CHECKS, thousandths
from tests.tiers import tiers

FILES = cases() | examples()


def back(m: da.Mechanism, path: Path) -> tuple[da.Mechanism, list[str]]:
    """The mechanism that is read from the file that is written."""
    content, lost = foreign_bytes(m, path)
    path.write_bytes(content)
    return read_foreign(path)[0], lost


@pytest.mark.parametrize(
    "name",
    tiers(
        ["sc-08-horizontal-engine-with-given-friction", "4b-06-bevan-four-bar"],
        ["sc-12-vertical-steam-engine", "seed-002-3-four-link-three-forces", "seed-002-2-slider-crank-2kn"],
    ),
)
def test_a_link_of_pmks_plus_gives_the_same_effort_within_its_rounding(name: str, tmp_path: Path) -> None:
    """Also where the slide is vertical: angles of a link are in radians."""
    m = da.load(FILES[name])
    read, lost = back(m, tmp_path / "x.pmks")
    ours, theirs = (float(x.effort(next(iter(x.drives)))[0]) for x in map(da.dynamics, (m, read)))
    assert theirs == pytest.approx(ours, rel=1e-3)
    assert theirs != ours
    assert any("is rounded" in note for note in lost)


def test_numbers_and_the_checksum_of_a_link(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    for number in [0.0, -0.001, *rng.uniform(-900, 900, 20)]:
        assert decimal(thousandths(number)) == pytest.approx(number, abs=5.0001e-4)
    links = (Path(__file__).parent / "files" / "links.txt").read_text(encoding="utf-8").splitlines()[1:]
    written = foreign_bytes(da.load(examples()["four_bar"]), "x.pmks")[0].decode()
    for link in [*links, written]:
        text = link.split("?")[1].strip()
        assert text[-1] == CHECKS[(len(text) - 1) % 62]


@pytest.mark.parametrize(("unit", "metres", "newtons"), [("0", 0.0254, 4.4482216152605), ("2", 1.0, 1.0)])
def test_units_of_a_link(unit: str, metres: float, newtons: float, tmp_path: Path) -> None:
    text = foreign_bytes(da.load(examples()["four_bar"]), "x.pmks")[0].decode()
    (tmp_path / "x.pmks").write_text(text, encoding="utf-8")
    changed = text.replace(".101.", f".{unit}0{'0' if unit == '0' else '1'}.")
    (tmp_path / "y.pmks").write_text(changed, encoding="utf-8")
    x, y = (read_foreign(tmp_path / f"{name}.pmks")[0] for name in "xy")
    lengths = [math.hypot(*m.points("crank")["A"]) for m in (x, y)]
    assert lengths[1] == pytest.approx(lengths[0] * metres / 0.01)
    forces = [math.hypot(*m.loads["F_P"].value) for m in (x, y)]  # type: ignore[union-attr, misc]
    assert forces[1] == pytest.approx(forces[0] * newtons)


@pytest.mark.parametrize("name", tiers(["engine"], ["four_bar", "pump", "toggle_press"]))
def test_pylinkage_files_keep_every_joint(name: str, tmp_path: Path) -> None:
    m = da.load(examples()[name])
    read, lost = back(m, tmp_path / "x.pylinkage.json")
    ours, theirs = da.kinematics(m), da.kinematics(read)
    for joint in json.loads((tmp_path / "x.pylinkage.json").read_text(encoding="utf-8"))["joints"]:
        link = next(n for n in read.links if n != "ground" and joint["id"] in read.points(n))
        j = m.joints[joint["id"]].links[1]
        at = ours.point(j, m.joint_points(joint["id"])[1])[0]
        assert theirs.point(link, joint["id"])[0] == pytest.approx(at, abs=1e-12)
    assert any(note.startswith("masses, gravity and speeds") for note in lost)


@pytest.mark.parametrize("angle", [1.0, -2.5])
def test_a_driver_begins_at_the_angle_from_its_motor_to_its_other_joint(angle: float) -> None:
    m = da.four_bar(positions=1).with_values({"drives.O2.position": angle})
    links = json.loads(foreign_bytes(m, "x.pylinkage.json")[0])["links"]
    (driver,) = [link for link in links if link["type"] == "driver"]
    assert (driver["id"], driver["motor_joint"]) == ("crank", "O2")
    assert driver["initial_angle"] == pytest.approx(angle)


@pytest.mark.parametrize("rpm", [200.0, -200.0, 0.0, 12.5, -12.5, 13.7])
def test_a_link_has_the_sense_and_whole_turns_of_its_drive(rpm: float, tmp_path: Path) -> None:
    m = da.four_bar(positions=1).with_values({"drives.O2.speed": rpm * math.pi / 30})
    read, lost = back(m, tmp_path / "x.pmks")
    (drive,) = read.drives.values()
    assert float(drive.speed) * 30 / math.pi == pytest.approx(math.copysign(round(abs(rpm)), rpm), abs=1e-9)
    assert ("?0P." in (tmp_path / "x.pmks").read_text()) == (rpm < 0), "clockwise"
    whole = rpm == round(rpm)
    assert [note for note in lost if note.startswith("speed")] == (
        [] if whole else [f"speed {abs(rpm):g} rpm: PMKS+ has whole numbers"]
    )


def test_a_link_has_no_more_joints_than_letters() -> None:
    def cranks(count: int) -> da.Mechanism:
        names = [f"c{k}" for k in range(count)]
        tree: dict[str, Any] = {
            "links": {"ground": {"points": {n: [k, 0] for k, n in enumerate(names)}}}
            | {n: {"points": {n: [0, 0], f"t{n}": [1, 0]}} for n in names},
            "joints": {n: {"type": "pin", "links": ["ground", n]} for n in names},
            "drives": {n: {"position": 0} for n in names},
        }
        return da.mechanism(tree)

    assert foreign_bytes(cranks(52), "x.pmks")[0]
    with pytest.raises(ModelError, match=r"^a link of PMKS\+ holds 52 joints, not 53; leave some out$"):
        foreign_bytes(cranks(53), "x.pmks")


def test_names_of_joints_keep_their_letters(tmp_path: Path) -> None:
    tree: Any = da.four_bar(positions=1).to_tree()
    tree["joints"]["Öse"] = tree["joints"].pop("A") | {"at": "A"}
    text = foreign_bytes(da.mechanism(tree), "x.pylinkage.json")[0].decode()
    assert '"id": "Öse"' in text
    read, _ = back(da.mechanism(tree), tmp_path / "x.pylinkage.json")
    assert "Öse" in read.joints


@pytest.mark.parametrize("listed", [True, False])
def test_a_joint_of_pylinkage_is_on_the_ground_by_its_type_or_its_link(listed: bool, tmp_path: Path) -> None:
    tree = json.loads(foreign_bytes(da.load(examples()["four_bar"]), "x.pylinkage.json")[0])
    if not listed:
        tree["links"] = [link for link in tree["links"] if link["type"] != "ground"]
    (tmp_path / "x.pylinkage.json").write_text(json.dumps(tree), encoding="utf-8")
    m, _ = read_foreign(tmp_path / "x.pylinkage.json")
    assert {name for name, j in m.joints.items() if "ground" in j.links} == {"O2", "O4"}
    assert da.mobility(m).freedoms == 1


@pytest.mark.long
@pytest.mark.parametrize("name", ["four_bar", "engine"])
def test_pylinkage_moves_as_we_do(name: str) -> None:
    serialization = pytest.importorskip("pylinkage.mechanism.serialization")
    m = da.load(examples()[name])
    text = foreign_bytes(m, "x.pylinkage.json")[0]
    theirs = serialization.mechanism_from_dict(json.loads(text))
    names = [joint.id for joint in theirs.joints]
    start = float(da.kinematics(m).drive_position("O2")[0])
    angles = [start + 2 * math.pi / 100 * k for k in range(1, 31)]
    ours = da.kinematics(m, positions=angles)
    steps = [step for _, step in zip(angles, theirs.step(), strict=False)]
    for k, name_of in enumerate(names):
        j = m.joints[name_of].links[1]
        path = ours.point(j, m.joint_points(name_of)[1])
        assert np.abs(np.array([step[k] for step in steps], float) - path).max() < 1e-9


def test_what_a_sketch_cannot_have_is_refused() -> None:
    for suffix, program in ((".pmks", "PMKS+"), (".pylinkage.json", "pylinkage")):
        for name, words in {
            "quick_return": "joint 'slide': .* has pins and sliders on the ground, not a slider between lever and",
            "rssr": "has plane linkages, and this mechanism is in space",
        }.items():
            with pytest.raises(ModelError, match=words) as refused:
                foreign_bytes(da.load(examples()[name]), f"x{suffix}")
            assert re.search(re.escape(program), str(refused.value))
