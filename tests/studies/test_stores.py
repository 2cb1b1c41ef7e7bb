"""What can happen to a store: killed, cut, flipped, deleted, full, locked, changed: a sentence or an exact repair."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import CODES
from dalembert.bundled import examples
from dalembert.studies import Study, StudyResult
from dalembert.studies.running import compute_block
from dalembert.studies.store import Store, checksum, ledger_row
from tests.tiers import tiers

DESIGNS = 20_000
FILE = f"""
study: 1
model: {examples()["four_bar"]}
vary: {{links.coupler.weight: ± 5 %, links.rocker.weight: uniform ± 5 %}}
outputs: [effort.O2, reaction.A.magnitude]
designs: {DESIGNS}
seed: 3
"""


def drawn(**options: object) -> Study:
    vary = {"links.coupler.weight": "± 5 %", "links.rocker.weight": "uniform ± 5 %"}
    m = da.load(examples()["four_bar"])
    return da.study(
        m, vary, ["effort.O2", "reaction.A.magnitude"], **{"designs": DESIGNS, "seed": 3, **options}
    )


@pytest.fixture(scope="module")
def study() -> Study:
    return drawn()


@pytest.fixture(scope="module")
def finished(study: Study, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("study") / "whole.zarr"
    study.run(path)
    return path


@pytest.fixture
def store(finished: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(finished, tmp_path / "s.zarr"))


def same(a: Path, b: Path) -> bool:
    """Every chunk of outputs and statuses, byte by byte; the ledger but for its times."""
    one, other = StudyResult.open(a), StudyResult.open(b)
    one.ledger[:, 1] = other.ledger[:, 1] = 0
    files = [
        [p.relative_to(root) for p in sorted(root.rglob("c/*")) if "ledger" not in p.parts] for root in (a, b)
    ]
    bits = [
        [(root / p).read_bytes() for p in names if (root / p).is_file()]
        for root, names in zip((a, b), files, strict=True)
    ]
    return np.array_equal(one.ledger, other.ledger) and files[0] == files[1] and bits[0] == bits[1]


def flip(chunk: Path) -> None:
    data = bytearray(chunk.read_bytes())
    data[len(data) // 2] ^= 1
    chunk.write_bytes(data)


def cut(chunk: Path) -> None:
    chunk.write_bytes(chunk.read_bytes()[: chunk.stat().st_size // 2])


@pytest.mark.parametrize("array", ["effort.O2", "status", "ledger"])
@pytest.mark.parametrize("damage", [flip, cut, Path.unlink])
def test_a_damaged_chunk_is_computed_again(
    study: Study, store: Path, finished: Path, array: str, damage: object
) -> None:
    chunk = store / array / "c" / ("1/0" if array == "ledger" else "1")
    damage(chunk)  # type: ignore[operator]
    counted: list[int] = []
    study.run(store, progress=lambda done, of: counted.append(done))
    assert len(counted) == 1, "one block"
    assert same(store, finished)


@pytest.mark.parametrize("array", ["effort.O2", "status"])
@pytest.mark.parametrize("damage", [flip, cut, Path.unlink])
def test_a_damaged_chunk_is_not_shown(store: Path, finished: Path, array: str, damage: object) -> None:
    damage(store / array / "c" / "1")  # type: ignore[operator]
    left, whole = StudyResult.open(store), StudyResult.open(finished)
    lost = slice(left.block, 2 * left.block)
    assert not left.done[lost].any()
    assert left.done.sum() == DESIGNS - left.block
    assert np.isnan(left["effort.O2"][lost]).all()
    assert np.array_equal(left["effort.O2"][left.done], whole["effort.O2"][left.done])
    assert (left.status[lost] == "").all()


def test_attributes_that_are_none_of_a_study_are_said(store: Path) -> None:
    group = store / "zarr.json"
    group.write_text(group.read_text().replace('"spreads"', '"spread"'))
    with pytest.raises(da.ModelError, match=r"s\.zarr is not a readable study: 'spreads'; run it again"):
        StudyResult.open(store)


def test_a_finished_study_is_not_computed_again(study: Study, store: Path) -> None:
    counted: list[int] = []
    study.run(store, progress=lambda done, of: counted.append(done))
    assert not counted


@pytest.mark.parametrize(("before", "again"), [(8192, 3), (9000, 3), (12_288, 2), (16_500, 1)])
def test_a_store_with_more_designs_computes_what_is_new(
    before: int, again: int, finished: Path, tmp_path: Path
) -> None:
    """Blocks of 4,096: a last one that was full is kept, another one is done again, once."""
    path, counted = tmp_path / "s.zarr", list[tuple[int, int]]()
    first = drawn(designs=before).run(path)
    assert first.block == 4096
    r = drawn().run(path, threads=1, progress=lambda done, of: counted.append((done, of)))
    assert len(counted) == again
    assert counted[-1] == (DESIGNS, DESIGNS)
    whole = StudyResult.open(finished)
    assert len(r["effort.O2"]) == DESIGNS
    assert np.array_equal(r["effort.O2"], whole["effort.O2"])
    assert r.counts() == whole.counts() == {"ok": DESIGNS}
    assert len(r.ledger) == -(-DESIGNS // 4096)
    drawn(designs=before).run(tmp_path / "t.zarr")
    again = drawn().run(tmp_path / "t.zarr", check=False)  # what the ledger says is believed
    assert np.array_equal(again["effort.O2"], whole["effort.O2"])


@pytest.mark.parametrize("field", [0, 2, 3])
def test_a_ledger_that_says_other_than_its_block_is_not_believed(
    field: int, study: Study, store: Path, finished: Path
) -> None:
    """Its checksum, or how many designs have which status."""
    kept = Store(store)
    kept.open()
    row = kept.ledger()[2]
    row[field] += 1
    kept.arrays["ledger"][2] = row
    counted: list[int] = []
    study.run(store, progress=lambda done, of: counted.append(done))
    assert counted == [DESIGNS]
    assert same(store, finished)


def test_a_checksum_is_that_of_every_array_in_the_order_of_their_names() -> None:
    a, b = np.array([1.0, 2.0]), np.array([3], np.uint8)
    both = zlib.crc32(b.tobytes(), zlib.crc32(a.tobytes())) + 1
    assert checksum({"a": a, "b": b}) == checksum({"b": b, "a": a}) == both
    assert checksum({"a": a[::-1], "b": b}) == zlib.crc32(b.tobytes(), zlib.crc32(a[::-1].tobytes())) + 1
    row = ledger_row({"status": np.array([0, 2, 2, 1], np.uint8)}, 6.6)
    assert row[1:].tolist() == [7, 1, 1, 2, *[0] * (len(CODES) - 3)]


def test_half_written_files_are_swept(study: Study, store: Path, finished: Path) -> None:
    (store / "effort.O2" / "c" / "1.abcd.partial").write_bytes(b"half")
    study.run(store)
    assert same(store, finished)


def test_a_second_run_is_refused_while_one_writes(study: Study, store: Path) -> None:
    with (
        Store(store).locked(),
        pytest.raises(
            da.ModelError,
            match=rf"s\.zarr is being written by process {os.getpid()} on .* since .*; wait for it",
        ),
    ):
        study.run(store)


@pytest.mark.parametrize(
    "how",
    [
        {"draw": "factorial"},
        {"draw": "latin"},
        {"draw": {"stroke": ["50 mm", "60 mm"]}},
        {"reduce": None, "keep": True},
    ],
)
def test_a_store_knows_its_study(how: dict[str, object], tmp_path: Path) -> None:
    vary = {"stroke": "50..60 mm in 3"} if how.get("draw") == "factorial" else {"stroke": "range"}
    s = da.study(da.load(examples()["pump"]), vary, ["effort.O", "reaction.A"], **{"designs": 5, **how})
    found = s.run(tmp_path / "s")
    again = StudyResult.open(tmp_path / "s").study.run(tmp_path / "s")
    assert np.array_equal(found["reaction.A"], again["reaction.A"])
    assert again.study.prints == s.prints


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        ({"seed": 4}, "what is varied, drawn or asked for has changed since, and results would be mixed"),
        ({"reduce": "rms"}, "what is varied, drawn or asked for has changed since"),
        ({"lanes": 2}, "what is varied, drawn or asked for has changed since"),
        ({"designs": 100}, "has 20000 designs, but 100 are requested; request at least as many"),
    ],
)
def test_a_changed_study_is_refused(store: Path, changed: dict[str, object], sentence: str) -> None:
    with pytest.raises(da.ModelError, match=sentence):
        drawn(**changed).run(store)


def test_a_changed_mechanism_is_refused_and_another_title_is_not(study: Study, store: Path) -> None:
    m = study.mechanism
    other = replace(study, mechanism=m.with_values({"loads.T_4.value": "1 N*m"}), cache={})
    with pytest.raises(
        da.ModelError, match=r"s\.zarr: the mechanism has changed since, and results would be mixed"
    ):
        other.run(store)
    replace(study, mechanism=m.with_values({"title": "Another"})).run(store)


def test_another_program_is_refused(store: Path) -> None:
    changed = Store(store)
    prints = changed.open()["prints"]
    changed.group.attrs["prints"] = {**prints, "program": "0123456789abcdef"}
    with pytest.raises(
        da.ModelError, match="this version of dalembert, or this kind of processor, computes it differently"
    ):
        drawn().run(store)


def test_a_worker_of_another_kind_is_refused(study: Study) -> None:
    import pickle

    with pytest.raises(
        da.ModelError, match="a worker's processor or version of dalembert computes this study differently"
    ):
        compute_block(pickle.dumps(study), "0123456789abcdef", 0, 0, 10)


def test_what_is_no_study_is_left_alone(study: Study, tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("precious")
    with pytest.raises(da.ModelError, match="exists and is not a study; give another name"):
        study.run(tmp_path)
    with pytest.raises(da.ModelError, match=r"nothing: file not found"):
        StudyResult.open(tmp_path / "nothing")
    assert [p.name for p in tmp_path.iterdir() if p.suffix != ".lock"] == ["mine.txt"]


def test_a_disk_that_takes_no_more_is_said_and_what_is_there_is_kept(
    study: Study, tmp_path: Path, finished: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = Store.put

    full = [True]

    def put(self: Store, b: int, *rest: object) -> object:
        if b == 2 and full:
            raise OSError(28, "No space left on device")
        return whole(self, b, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(Store, "put", put)
    sentence = "cannot be written: no space left on device; finished blocks are kept: make room, and resume"
    with pytest.raises(da.ModelError, match=sentence):
        study.run(tmp_path / "s.zarr", threads=1)
    full.clear()
    left = StudyResult.open(tmp_path / "s.zarr")
    assert 0 < left.done.sum() < DESIGNS
    assert np.isnan(left["effort.O2"][~left.done]).all()
    study.run(tmp_path / "s.zarr")
    assert same(tmp_path / "s.zarr", finished)


def test_an_interruption_finishes_the_blocks_under_way(study: Study, tmp_path: Path, finished: Path) -> None:
    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study.run(tmp_path / "s.zarr", threads=2, progress=stop)
    left = StudyResult.open(tmp_path / "s.zarr")
    assert 0 < left.done.sum() < DESIGNS
    assert not list((tmp_path / "s.zarr").rglob("*.partial"))
    study.run(tmp_path / "s.zarr")
    assert same(tmp_path / "s.zarr", finished)


def test_xarray_opens_it(finished: Path, study: Study) -> None:
    xarray = pytest.importorskip("xarray")
    with xarray.open_zarr(finished, consolidated=False) as found:
        assert found["effort.O2"].dims == ("design",)
        assert found["effort.O2"].attrs["units"] == "N*m"
        assert np.array_equal(found["effort.O2"].values, StudyResult.open(finished)["effort.O2"])
        assert found.attrs["units"]["links.coupler.weight"] == "N"
    labelled = StudyResult.open(finished).to_xarray()
    assert np.array_equal(labelled["links.coupler.weight"].values, study.plan.values(0, DESIGNS)[:, 0])


KILLED = """
import os, random, signal, sys, time
from dalembert.studies.store import Store, checksum, ledger_row
from dalembert.studies.study_file import load_study
put = Store.put
def late(self, *rest):
    time.sleep(0.02)
    row = put(self, *rest)
    time.sleep(0.02)
Store.put = late
study = load_study(sys.argv[1])
study.prints
for seed in sys.argv[3:]:
    child = os.fork()
    if not child:
        study.run(f"{sys.argv[2]}/{seed}.zarr", threads=2)
        os._exit(0)
    time.sleep(random.Random(int(seed)).uniform(0.0, 0.5))
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
"""
"""Runs that write slowly, each killed at a random moment: before the first block, between, behind the last."""


@pytest.mark.parametrize("seeds", tiers([], [range(2)], [range(2, 100), range(100, 300)]))
def test_killed_runs_are_resumed_bit_by_bit(
    seeds: range, study: Study, finished: Path, tmp_path: Path
) -> None:
    (tmp_path / "s.yaml").write_text(FILE, encoding="utf-8")
    names = [str(tmp_path / "s.yaml"), str(tmp_path), *map(str, seeds)]
    subprocess.run([sys.executable, "-c", KILLED, *names], check=True)
    for seed in seeds:
        target = tmp_path / f"{seed}.zarr"
        study.run(target)
        assert same(target, finished), seed


ELSEWHERE = """
import importlib.abc, os, sys, types
class Missing(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name in ("fcntl", "resource", "pwd", "grp", "termios"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
fcntl = None
if sys.argv[3] == "windows":
    import fcntl
    import subprocess  # asks for msvcrt to know the system
    windows = sys.modules["msvcrt"] = types.ModuleType("msvcrt")
    windows.LK_NBLCK = 2
    def locking(file, mode, count):
        assert (mode, count, os.lseek(file, 0, os.SEEK_CUR)) == (2, 1, 1 << 20)
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    windows.locking = locking
for name in ("fcntl", "resource", "pwd", "grp", "termios"):
    sys.modules.pop(name, None)
sys.meta_path.insert(0, Missing())
for name in ("sched_getaffinity", "sysconf", "fork", "getuid", "geteuid", "statvfs"):
    if hasattr(os, name):
        delattr(os, name)

import dalembert as da
from dalembert.studies.store import Store
from dalembert.studies.study_file import load_study
study, target = load_study(sys.argv[1]), sys.argv[2]
def stop(done, of):
    raise KeyboardInterrupt
try:
    study.run(target, threads=2, progress=stop)
except KeyboardInterrupt:
    print(0 < da.StudyResult.open(target).done.sum() < study.count)
if sys.argv[3] == "windows":
    with Store(target).locked():
        try:
            study.run(target)
        except da.ModelError as error:
            print(f"is being written by process {os.getpid()} on " in str(error))
study.run(target)
"""
"""Without what only POSIX systems have: a stored study that is stopped and resumed."""


@pytest.mark.parametrize("system", tiers(["windows"], ["no locks"]))
def test_a_study_is_stored_where_there_is_no_posix(system: str, finished: Path, tmp_path: Path) -> None:
    (tmp_path / "s.yaml").write_text(FILE, encoding="utf-8")
    command = [sys.executable, "-c", ELSEWHERE, str(tmp_path / "s.yaml"), str(tmp_path / "s.zarr"), system]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split() == ["True"] * (2 if system == "windows" else 1)
    assert same(tmp_path / "s.zarr", finished)
