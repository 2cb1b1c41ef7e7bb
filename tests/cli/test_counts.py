"""What is said of many positions where not all are solved in full."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from tests.cli.conftest import Run


def lifted(folder: Path) -> str:
    """A four-bar in space, three constraints too many, its effort known and a couple asked for."""
    m = da.lifted(da.four_bar(), {"coupler": "20 mm"})
    asked = {"drives.O2.effort": 5.0, "loads.torque.value": "unknown"}
    m.with_values(asked).save(folder / "lifted.yaml")
    return "lifted.yaml"


def test_redundant_positions_count_as_answered_but_for_what_is_not_unique(run: Run, folder: Path) -> None:
    printed = run("solve", lifted(folder), "--positions", "8").out
    last = " ".join(printed.split("\n\n")[-1].split())
    assert last.startswith(
        "0 of 8 positions solved in full; 8 solved but for the reactions that are not unique; residual "
    )
    assert max(map(len, printed.splitlines())) <= 80


def test_the_components_that_are_unique_stand_in_the_table(run: Run, folder: Path) -> None:
    printed = run("solve", lifted(folder), "--positions", "8").out
    assert "F O4 y" in printed
    for not_unique in ("F O4 z", "|F| O4", "M O4 x"):
        assert not_unique not in printed


def test_positions_without_an_answer_and_at_rest_are_counted(run: Run, folder: Path) -> None:
    text = (folder / "four_bar.yaml").read_text(encoding="utf-8")
    open_ = text.replace("A: [5, 0]", "A: [12, 0]").replace("60 deg", "{from: 60, to: 300, count: 13}")
    (folder / "open.yaml").write_text(open_, encoding="utf-8")
    assert "positions solved in full; 7 without an answer; residual" in run("solve", "open.yaml").out
    rest = text.replace("speed: 25 rad/s, acceleration: -40 rad/s^2", "speed: 0 rad/s").replace(
        "gravity:", "friction: {coefficient: 0.1}\ngravity:"
    )
    pin = "O4: {type: pin, links: [ground, rocker]"
    (folder / "rest.yaml").write_text(rest.replace(pin, pin + ", friction: {radius: 0.5}"), encoding="utf-8")
    assert "0 of 6 positions solved in full; 6 solved to an interval" in run(
        "solve", "rest.yaml", "--positions", "6"
    ).out.replace("\n", " ")


def test_a_printed_result_is_what_solve_prints(run: Run, folder: Path) -> None:
    m = da.load(folder / "four_bar.yaml")
    for positions in (None, 36):
        options = () if positions is None else ("--positions", str(positions))
        assert f"{da.dynamics(m, positions=positions)}\n" == run("solve", "four_bar.yaml", *options).out
    assert (
        repr(da.dynamics(m, positions=36)) == "<Result of 'Four-bar linkage, dynamic': 36 positions, 36 ok>"
    )


def test_a_printed_motion_has_no_columns_of_forces() -> None:
    for m in (da.four_bar(), da.rssr()):
        printed = str(da.kinematics(m, positions=6))
        assert "effort" not in printed
        assert "|F|" not in printed
        assert "rocker" in printed
    assert "angle rocker" in str(da.kinematics(da.four_bar(), positions=6))


def test_a_printed_mechanism_is_its_file() -> None:
    m = da.four_bar()
    assert da.loads(str(m)) == m
    assert repr(m) == "<Mechanism 'Four-bar linkage': 3 moving links, 4 joints, driven by O2>"
    assert str(da.mobility(m)) == "mobility 1, driven by 1 drive, no redundant constraint"


def test_a_lifted_mechanism_keeps_the_units_of_its_file(folder: Path) -> None:
    m = da.load(folder / "four_bar.yaml")
    assert da.lifted(m, {}).units == m.units


def test_standard_gravity_and_the_way_to_another_mode_are_said(run: Run, folder: Path) -> None:
    text = (
        (folder / "four_bar.yaml").read_text(encoding="utf-8").replace("gravity: none", "gravity: standard")
    )
    (folder / "heavy.yaml").write_text(text.split("assembly:")[0], encoding="utf-8")
    printed = " ".join(run("solve", "heavy.yaml").out.split())
    assert "gravity standard (9.80665 m/s2 along -y)" in printed
    assert "(from a search); other modes (the file's `assembly` chooses): coupler" in printed


def test_what_is_only_rounding_is_0_in_the_tables_of_methods(run: Run, folder: Path) -> None:
    """A crank straight down holds its weight without a torque; moves and turns of what stands are 0."""
    text = (
        (folder / "four_bar.yaml").read_text(encoding="utf-8").replace("gravity: none", "gravity: standard")
    )
    (folder / "heavy.yaml").write_text(text.replace("60 deg", "90 deg"), encoding="utf-8")
    for method in ("superposition", "virtual-work"):
        printed = run("solve", "heavy.yaml", "--static", "--method", method).out
        *tables, _ = printed.partition(f"{method.replace('-', ' ').capitalize()}\n")[2].split("\n\n")
        assert tables
        assert not any("e-" in part for part in tables), printed


def test_the_parts_of_superposition_add_up_as_printed(run: Run, folder: Path) -> None:
    printed = run("solve", "four_bar.yaml", "--method", "superposition").out.partition("Superposition")[2]
    tables = [part.splitlines() for part in printed.split("\n\n") if "---" in part]
    seen = ""
    for heads, _, _, *rows in tables:
        names = re.split(r"  +", heads)[1:]
        numbers = np.array([re.split(r"  +", row)[1:] for row in rows])
        for name, column in zip(names, numbers.T, strict=True):
            if re.fullmatch(r"O2|\w+ [xym]", name):
                some = column.astype(float)
                assert some[:-1].sum() == pytest.approx(some[-1], abs=1e-3 * np.abs(some).max())
                seen += name
            elif name.startswith("|"):
                n = names.index(name)
                x, y = numbers[:, n - 2 : n].astype(float).T
                assert np.hypot(x, y) == pytest.approx(column.astype(float), rel=1e-4)
                angle = [float(a) if a != "-" else 0.0 for a in numbers[:, n + 1]]
                assert np.degrees(np.arctan2(y, x)) == pytest.approx(angle, abs=0.01)
    assert seen == "O2O2 xO2 yA xA yB xB yO4 xO4 y"


def test_where_nothing_acts_methods_say_so(run: Run, folder: Path) -> None:
    bare = da.four_bar().with_values({f"links.{link}.mass": 0.0 for link in ("crank", "coupler", "rocker")})
    bare = bare.with_values(
        {f"links.{link}.inertia": 0.0 for link in ("crank", "coupler", "rocker")} | {"loads": {}}
    )
    bare.save(folder / "bare.yaml")
    for method in ("superposition", "virtual-work"):
        printed = run("solve", "bare.yaml", "--method", method)
        assert (printed.status, printed.err) == (0, "")
        assert "No given load, weight or inertia acts" in printed.out


def test_a_file_of_forces_is_no_mechanism(run: Run, folder: Path) -> None:
    (folder / "plate.yaml").write_text(
        "points: {A: [1, 2]}\nforces: {F: {value: 3 @ 4, at: A}}\n", encoding="utf-8"
    )
    ran = run("solve", "plate.yaml")
    assert ran.status == 2
    assert (
        ran.err
        == "plate.yaml:1: this is a file of forces and couples; use dalembert wrench, or da.wrench.load\n"
    )
