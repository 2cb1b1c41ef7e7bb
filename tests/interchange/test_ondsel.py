"""Efforts and joint forces against OndselSolver, from the .asmt files that are written: it reads and solves them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.arrays import Array
from dalembert.bundled import examples
from dalembert.errors import ModelError
from dalembert.interchange.file_formats import foreign_bytes
from tests.interchange.written_files import driven_alike, in_space
from tests.tiers import tiers

NAME = "/Assembly/"
FILES = {p.stem: p for p in (Path(da.__file__).parent / "model" / "library" / "files").glob("*.yaml")}
FILES |= examples()


def solved(m: da.Mechanism) -> dict[tuple[str, str], list[float]]:
    """Series of OndselSolver by item and quantity, from the first instant on."""
    pyondsel = pytest.importorskip("pyondsel.solve")
    out = pyondsel.solve_asmt(foreign_bytes(m, "x.asmt")[0].decode())
    series: dict[tuple[str, str], list[float]] = {}
    item = ""
    for line in out.partition("TimeSeries\n")[2].splitlines()[2:]:
        head, _, rest = line.partition("\t")
        if head.endswith("Series"):
            item = rest.removeprefix(NAME)
        else:
            series[item, head] = [float(x) for x in rest.split("\t")[1:] if x.strip()]
    return series


def wrench(series: dict[tuple[str, str], list[float]], item: str, kind: str) -> Array:
    """Force (F) or moment (T) on i of a joint or motion at the first instant, in ground axes."""
    return np.array([series[item, f"{kind}{axis}onI"][0] for axis in "XYZ"])


@pytest.mark.parametrize(
    "name",
    tiers(
        ["four_bar"],
        ["rssr", "hexapod", "excavator", "engine", "spherical_four_bar", "rccc", "double_cardan", "boom"],
    ),
)
def test_efforts_and_forces_are_those_of_ondsel(name: str) -> None:
    m = in_space(da.load(FILES[name]))
    m = driven_alike(m, m, drawn=False)
    r, series = da.dynamics(m), solved(m)
    forces = {joint: r.reaction(joint)[0] for joint in m.joints}
    largest = max(np.nanmax(np.abs(f)) for f in forces.values())
    compared = 0
    for joint, force in forces.items():
        unique = ~np.isnan(force)
        if (joint, "FXonI") in series:  # others are chains there
            assert np.abs(wrench(series, joint, "F") + force)[unique].max() < 1e-12 * largest
            compared += int(unique.sum())
    assert compared > 4
    size = largest * max(1.0, float(np.abs(r.position(next(iter(r.links)))).max()))
    for drive in m.drives:
        item = f"motion {drive}" if drive in m.joints else drive
        freedom = m.drives[drive].freedom or m.joints[m.drive_joint(drive)].freedoms[0]
        theirs = np.linalg.norm(wrench(series, item, "F" if freedom.startswith("slide") else "T"))
        assert abs(abs(r.effort(drive)[0]) - theirs) < 1e-12 * size


SCREW = """
space: space
gravity: [0, 0, -9.81 m/s^2]
links:
  ground: {points: {O: [0, 0, 0]}}
  nut: {points: {O: [0, 0, 0]}, mass: 2, center: [0.1, 0, 0], inertia: [0.01, 0.02, 0.03]}
joints:
  S: {type: screw, links: [ground, nut], at: O, axis: [0, 0, 1], lead: 0.02}
drives:
  S: {freedom: turn, position: 0.3 rad, speed: 5 rad/s, acceleration: 7 rad/s^2}
"""


@pytest.mark.long
def test_a_screw() -> None:
    m = da.loads(SCREW)
    r, series = da.dynamics(m), solved(m)
    assert wrench(series, "motion S", "T")[2] == pytest.approx(-float(r.effort("S")[0]), rel=1e-12)
    assert series["nut", "Z"][0] == pytest.approx(0.3 * 0.02 / (2 * np.pi), rel=1e-12)
    assert series["nut", "VZ"][0] == pytest.approx(5 * 0.02 / (2 * np.pi), rel=1e-12)


@pytest.mark.long
def test_a_slider_on_a_turning_link_is_where_ondsel_is_wrong() -> None:
    """Its speeds are right, its accelerations are not: the lever's by the closed form is ours."""
    m = in_space(da.load(FILES["quick_return"]))
    r, series = da.dynamics(m), solved(driven_alike(m, m, drawn=False))
    speed = 40 * 2 * np.pi / 60
    place, velocity, acceleration = (
        np.array(v) for v in ([0.1, 0.2], [0, 0.1 * speed], [-0.1 * speed**2, 0])
    )
    square, turn = place @ place, place[0] * velocity[1]
    exact = (-place[1] * acceleration[0] * square - 2 * turn * (place @ velocity)) / square**2
    assert r.acceleration("lever")[0][2] == pytest.approx(exact, rel=1e-12)
    assert series["lever", "OmegaZ"][0] == pytest.approx(turn / square, rel=1e-12)
    assert abs(series["lever", "AlphaZ"][0] / exact - 1) > 0.01


def test_what_is_not_written() -> None:
    m = da.load(examples()["four_bar"])
    content, lost = foreign_bytes(m, "x.asmt")
    assert content.startswith(b"OndselSolver\nAssembly\n\tNotes\n")
    assert lost[0] == "load 'F_P' (force): only gravity is written to .asmt"
    with pytest.raises(ModelError, match="gear 'sun_mesh': the gears of OndselSolver have no teeth"):
        foreign_bytes(da.load(examples()["gear_train"]), "x.asmt")


@pytest.mark.parametrize("speed", [10.0, -10.0, 0.0])
def test_a_simulation_lasts_a_turn_in_either_sense_or_a_second(speed: float) -> None:
    m = da.four_bar(positions=1).with_values({"drives.O2.speed": speed})
    lines = [line.strip() for line in foreign_bytes(m, "x.asmt")[0].decode().splitlines()]
    ends = [float(lines[lines.index(key) + 1]) for key in ("tstart", "tend", "hmax")]
    turn = 2 * np.pi / 10 if speed else 1.0
    assert ends == pytest.approx([0, turn, turn])
