"""Details of studies and of their stores: sizes of blocks, axes, locks of other systems, leftovers, what is printed."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.studies import Study, design_study, study_file
from dalembert.studies.output.study_text import summary
from dalembert.studies.output.study_views import response_scene
from dalembert.studies.spreads import Spread
from dalembert.studies.store_folder import BEHIND, Folder, this_run
from dalembert.studies.study_file import load_study
from tests.studies.test_motions import MODEL, WAY, run_up

M = da.four_bar(positions=3)
MASS = {"links.coupler.mass": "± 5 %"}


def study(vary: Any = None, outputs: Any = ("effort.O2",), **options: Any) -> Study:
    return da.study(M, MASS if vary is None else vary, list(outputs), **{"designs": 16, **options})


def test_numbers_are_idle_about_the_middle_of_their_spreads() -> None:
    """A coupler from 290 to 310 mm closes there, and half its width would not."""
    vary = {**MASS, "links.coupler.points.B.0": "290..310 mm"}
    assert study(vary, ["angle.rocker"]).idle() == ("links.coupler.mass",)
    assert study(vary, ["effort.O2"]).idle() == ()


def test_a_number_of_one_level_has_no_share() -> None:
    vary = {"links.coupler.mass": ["1 kg"], "links.rocker.mass": ["1 kg", "2 kg"]}
    found = study(vary, draw="factorial").contributions("effort.O2")
    assert found.shares == {"links.coupler.mass": 0.0, "links.rocker.mass": 1.0}
    assert found.sigma > 0


def test_a_spread_may_be_given_as_it_is_read() -> None:
    normal = Spread("normal", 1.0, 0.1)
    assert study({"links.coupler.mass": normal}).plan.spreads == (normal,)
    by_text = study({"links.coupler.mass": "normal 0.1 kg"}).plan.spreads
    assert by_text == (Spread("normal", M.mass("coupler"), 0.1),)


@pytest.mark.parametrize(("count", "size"), [(16, 16), (1000, 32), (10**4, 64), (10**8, None)])
def test_a_store_has_no_more_blocks_than_it_can_list(count: int, size: int | None) -> None:
    """Designs analysed one by one: 64 a block at most, unless that would be too many blocks."""
    s = da.study(
        M.with_values({"links.rocker.section": {"circle": 0.02, "elasticity": 2e11}}),
        MASS,
        ["deflection.rocker"],
        designs=count,
    )
    assert s.engine.why
    found = s.block_size()
    assert found.bit_count() == 1
    if size is None:
        assert count / found <= design_study.MOST_BLOCKS < 2 * count / found
    assert size in (None, found)


def test_axes_of_a_store_are_named(tmp_path: Path) -> None:
    """Both ends of an envelope are sides; components are those of a vector of the plane."""
    import zarr

    named = {
        "envelope": {"effort.O2": ("side",), "reaction.A": ("component", "side"), "status": ()},
        "peak": {"effort.O2": (), "reaction.A": ("component",), "status": ()},
        None: {"effort.O2": ("position",), "reaction.A": ("position", "component"), "status": ("position",)},
    }
    for reduce, axes in named.items():
        place = tmp_path / f"{reduce}.zarr"
        study(outputs=["effort.O2", "reaction.A"], reduce=reduce).run(place)
        group: Any = zarr.open_group(str(place))
        assert {name: group[name].metadata.dimension_names for name in axes} == {
            name: ("design", *of) for name, of in axes.items()
        }
        assert group["effort.O2"].attrs["reduce"] == (reduce or "none")
        assert (group["effort.O2"].attrs["units"], group["reaction.A"].attrs["units"]) == ("N*m", "N")


def test_axes_of_a_store_of_a_space_mechanism_are_named(tmp_path: Path) -> None:
    import zarr

    m = da.rssr(positions=3)
    joint = next(iter(m.joints))
    da.study(m, {"links.rod.mass": "± 5 %"}, [f"reaction.{joint}"], "envelope", designs=4).run(
        tmp_path / "s.zarr"
    )
    group: Any = zarr.open_group(str(tmp_path / "s.zarr"))
    array = group[f"reaction.{joint}"]
    assert (array.metadata.dimension_names, array.shape) == (("design", "component", "side"), (4, 3, 2))


def test_limits_are_printed_with_their_shares_and_capabilities() -> None:
    r = study(limits={"effort.O2": "< 5.17 N*m"}, designs=64).run()
    values = r["effort.O2"]
    share, cpk = (values < 5.17).mean(), (5.17 - values.mean()) / (3 * values.std())
    assert 0 < share < 1
    *_, heads, line, row = summary(r).splitlines()
    assert heads.split() == ["limit", "designs", "that", "keep", "it", "Cpk"]
    assert set(line) == {"-"}
    assert row.split() == ["effort.O2", "<", "5.17", "N*m", f"{share:.4%}", f"{cpk:.3f}"]


def test_columns_are_read_a_part_at_a_time() -> None:
    r = study(outputs=["effort.O2", "reaction.A"], designs=8).run()
    columns = {c.name: c.values for c in r.columns()}
    assert list(columns) == ["links.coupler.mass", "status", "effort.O2", "reaction.A.1", "reaction.A.2"]
    every = [r.study.plan.values(0, 8)[:, 0], r["effort.O2"], *r["reaction.A"].T]
    for name, values in zip((name for name in columns if name != "status"), every, strict=True):
        assert columns[name][2:5].tolist() == values[2:5].tolist()


def test_outputs_of_several_numbers_are_only_named() -> None:
    r = study(outputs=["effort.O2", "reaction.A"], reduce=None).run()
    assert summary(r).split("\n\n")[-1] == (
        "Several numbers a design, to be read in Python or by export: effort.O2, reaction.A"
    )
    mixed = summary(study(outputs=["effort.O2", "reaction.A"]).run())
    assert mixed.endswith("\n\nSeveral numbers a design, to be read in Python or by export: reaction.A")


OPEN = {"links.ground.points.O4.0": "10..11 m", "links.crank.mass": "± 1 %"}
REFUSED: dict[str, Callable[[], Any]] = {
    "motions under forces have no positions in common; use contributions": lambda: (
        run_up().contributions_along("time")
    ),
    "no design has a value of effort.O2; make the spreads smaller": lambda: response_scene(
        study(OPEN).run(), study(OPEN).response("effort.O2", *OPEN)
    ),
    "unknown output 'O2.sped'; did you mean 'O2.speed'?": lambda: da.study(
        da.loads(MODEL), {"torque": "± 1 %"}, ["O2.sped"], simulate=WAY
    ),
    'designs differ in the number of their equilibrium positions; reduce over them: reduce="peak"': lambda: (
        da.study(
            da.loads(BOB), {"links.bob.mass": "± 1 %"}, ["angle.bob"], reduce=None, static=True
        ).block_size()
    ),
}
BOB = """
gravity: standard
links: {ground: {points: {O: [0, 0]}}, bob: {points: {O: [0, 0]}, mass: 2, center: [0.5, 0]}}
joints: {O: {type: pin, links: [ground, bob]}}
drives: {O: {position: unknown, effort: 0, range: [-150, -30]}}
"""


@pytest.mark.parametrize("sentence", REFUSED)
def test_a_study_says_what_it_cannot_do(sentence: str) -> None:
    with pytest.raises(ModelError) as refused:
        REFUSED[sentence]()
    assert str(refused.value) == sentence


def test_a_table_that_is_too_large_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    M.save(tmp_path / "m.yaml")
    (tmp_path / "t.csv").write_text("links.coupler.mass [kg]\n1\n2\n")
    (tmp_path / "s.yaml").write_text("study: 1\nmodel: m.yaml\ntable: t.csv\noutputs: [effort.O2]\n")
    assert load_study(tmp_path / "s.yaml").count == 2
    monkeypatch.setattr(study_file, "LARGEST", 27)
    with pytest.raises(ModelError) as refused:
        load_study(tmp_path / "s.yaml")
    assert str(refused.value) == (
        f"{tmp_path / 's.yaml'}:3: {tmp_path / 't.csv'} is larger than 0 MB; leave designs out"
    )


def test_what_a_killed_run_left_beside_a_store_is_gone(tmp_path: Path) -> None:
    """A half-made folder of another study, and an empty folder at the place itself."""
    left = tmp_path / "s.zarr.new"
    (left / "reaction.A").mkdir(parents=True)
    (left / "reaction.A" / "zarr.json").write_text("{}")
    place = tmp_path / "s.zarr"
    place.mkdir()
    r = study().run(place)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.zarr", "s.zarr.lock"]
    assert sorted(path.name for path in place.iterdir()) == ["effort.O2", "ledger", "status", "zarr.json"]
    assert np.array_equal(r["effort.O2"], study().run()["effort.O2"])


def test_a_store_in_what_is_no_folder_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    place = tmp_path / "file" / "s.zarr"
    with pytest.raises(ModelError) as refused:
        study().run(place)
    assert str(refused.value) == (
        f"{place} cannot be written: file exists; finished blocks are kept: make room, and resume"
    )


class Windows:
    """Its locks of bytes: where they were asked for, and whether another process has one."""

    LK_NBLCK = 2

    def __init__(self, taken: bool) -> None:
        self.taken, self.asked = taken, list[tuple[int, int, int]]()

    def locking(self, file: int, mode: int, count: int) -> None:
        self.asked.append((os.lseek(file, 0, os.SEEK_CUR), mode, count))
        if self.taken:
            raise OSError("locked")


@pytest.fixture
def windows(monkeypatch: pytest.MonkeyPatch) -> Callable[[Any], Any]:
    def of(system: Any) -> Any:
        real = importlib.import_module
        monkeypatch.setitem(sys.modules, "fcntl", None)
        if system is None:
            monkeypatch.setitem(sys.modules, "msvcrt", None)
        else:
            monkeypatch.setattr(
                importlib, "import_module", lambda name: system if name == "msvcrt" else real(name)
            )
        return system

    return of


@pytest.mark.parametrize("system", [Windows(False), None])
def test_where_there_are_other_locks_a_byte_behind_the_text_is_locked(
    system: Any, tmp_path: Path, windows: Callable[[Any], Any]
) -> None:
    """None at all in a browser."""
    windows(system)
    with Folder(tmp_path / "s.zarr").locked():
        assert (tmp_path / "s.zarr.lock").read_text() == this_run()
    assert system is None or system.asked == [(BEHIND, Windows.LK_NBLCK, 1)]


def test_a_store_that_another_process_has_is_left_alone(
    tmp_path: Path, windows: Callable[[Any], Any]
) -> None:
    windows(Windows(True))
    for written, who in (("process 3 on moon", "process 3 on moon"), ("", "another process")):
        (tmp_path / "s.zarr.lock").write_text(written)
        with pytest.raises(ModelError) as refused, Folder(tmp_path / "s.zarr").locked():
            pass
        assert (
            str(refused.value) == f"{tmp_path / 's.zarr'} is being written by {who}; wait for it, or end it"
        )
        assert (tmp_path / "s.zarr.lock").read_text() == written


def test_one_by_one_motions_have_the_instants_of_their_plan() -> None:
    text = MODEL.replace("no_load: 60 rad/s}", "no_load: 60 rad/s, efficiency: 0.9}")
    s = da.study(da.loads(text), {"torque": "± 1 %"}, ["time"], simulate={**WAY, "count": 7}, designs=2)
    assert s.engine.why.endswith("has losses")
    assert s.engine.positions == 7


LEVEL = """
units: {angle: rad}
gravity: standard
parameters: {heavy: 2 kg, reach: 0.3 m, pull: 5 N*m}
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0]}, mass: heavy, center: [reach, 0]}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: [0, 1, 1.5707963267948966, 2.5]}}
loads: {F: {type: couple, on: arm, by: ground, value: -pull}}
"""


def test_shares_along_a_cycle_are_those_of_each_position() -> None:
    """T = m g c cos q + M: the weight's parts go with cos^2 q, where the arm hangs upright only M scatters."""
    vary = {"heavy": "uniform ± 10 %", "reach": "uniform ± 10 %", "pull": "normal 0.2 N*m"}
    s = da.study(da.loads(LEVEL), vary, ["effort.O"], designs=64, static=True)
    found = s.contributions_along("effort.O", 2048)
    turned = np.cos([0, 1, np.pi / 2, 2.5]) ** 2
    big, both, small = (
        (2 * 9.80665 * 0.3) ** 2 / 300 * turned,
        (2 * 9.80665 * 0.3) ** 2 / 300**2 * turned,
        0.04,
    )
    total = 2 * big + both + small
    assert found.output == "effort.O"
    assert found.lost == 0
    assert found.sigma == pytest.approx(np.sqrt(total), rel=3e-3)  # of 2048 designs
    assert found.mean == pytest.approx(2 * 9.80665 * 0.3 * np.cos([0, 1, np.pi / 2, 2.5]) + 5, abs=1e-2)
    for name, first, whole in (
        ("heavy", big, big + both),
        ("reach", big, big + both),
        ("pull", small, small),
    ):
        assert found.shares[name] == pytest.approx(first / total, abs=6e-3)
        assert found.total[name] == pytest.approx(whole / total, abs=6e-3)


def test_shares_along_a_cycle_leave_out_designs_that_do_not_close() -> None:
    """With the crank away from the rocker's pivot at 180 deg: a row is lost where either sample's coupler is short."""
    m = da.four_bar(positions=2)
    points = {n: m.links[n].points for n in ("ground", "crank", "rocker")}
    far, rocker = points["ground"]["O4"][0] + points["crank"]["A"][0], points["rocker"]["B"][0]  # type: ignore[index]
    least = far - rocker
    vary = {
        "links.coupler.points.B.0": f"{least - 0.02!r}..{least + 0.06!r} m",
        "links.coupler.mass": "± 5 %",
    }
    found = da.study(m, vary, ["effort.O2"], designs=64, static=True).contributions_along("effort.O2", 256)
    assert found.lost / 256 == pytest.approx(1 - 0.75**2, abs=0.02)  # of 256 designs
    assert np.isfinite(found.mean).all()
