"""Stores at an address: as those in folders, bit by bit; a lease in place of the lock, attributes last in place of a
rename."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.studies import Study, StudyResult, object_store
from dalembert.studies.object_store import Objects
from dalembert.studies.store import Store
from tests.studies.test_stores import KILLED
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


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Study:
    from dalembert.studies.study_file import load_study

    path = tmp_path_factory.mktemp("address") / "s.yaml"
    path.write_text(FILE)
    return load_study(path)


@pytest.fixture(scope="module")
def answers(study: Study, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Of a store in a folder, byte by byte."""
    path = tmp_path_factory.mktemp("folder") / "s.zarr"
    study.run(path)
    return chunks_of({str(p.relative_to(path)): p.read_bytes() for p in path.rglob("*") if p.is_file()})


def chunks_of(objects: dict[str, bytes]) -> dict[str, bytes]:
    return {key: data for key, data in objects.items() if "/c/" in key and "ledger" not in key}


@pytest.fixture
def address() -> Iterator[str]:
    name = f"memory://studies/{time.time_ns()}/s.zarr"
    yield name
    kept = Objects(name).objects
    kept.remove(kept.keys(""))


def stored(address: str) -> dict[str, bytes]:
    place = Objects(address)
    keys = place.objects.keys(f"{place.name}/")
    return {key.removeprefix(f"{place.name}/"): place.objects.read(key) or b"" for key in keys}


def test_the_same_bits_as_in_a_folder(study: Study, address: str, answers: dict[str, bytes]) -> None:
    pytest.importorskip("xarray")
    import xarray

    r = study.run(address)
    assert chunks_of(stored(address)) == answers
    with xarray.open_zarr(address, consolidated=False) as found:
        assert np.array_equal(found["effort.O2"].values, r["effort.O2"])
    more = StudyResult.open(address).study.extended(DESIGNS + 5000).run(address)
    assert np.array_equal(more["effort.O2"], study.extended(DESIGNS + 5000).run()["effort.O2"])
    assert [
        k for k in Objects(address).objects.keys("") if not k.startswith(("s.zarr/", "s.zarr.lock/"))
    ] == []


@pytest.mark.parametrize("damage", ["flip", "cut", "delete", "ledger"])
def test_a_damaged_object_is_computed_again(
    damage: str, study: Study, address: str, answers: dict[str, bytes]
) -> None:
    study.run(address)
    kept, key = Objects(address).objects, "s.zarr/" + ("ledger/c/1/0" if damage == "ledger" else "status/c/1")
    data = kept.read(key)
    assert data is not None
    kept.remove([key])
    if damage in ("flip", "cut"):
        kept.write(key, data[: len(data) // 2] + (bytes([data[-1] ^ 1]) * 3 if damage == "flip" else b""))
    counted: list[int] = []
    study.run(address, progress=lambda done, of: counted.append(done))
    assert len(counted) == 1, "one block"
    assert chunks_of(stored(address)) == answers


@pytest.mark.parametrize("written", [1, 2, 4])
def test_a_half_made_store_is_none_and_is_made_anew(
    written: int, study: Study, address: str, answers: dict[str, bytes]
) -> None:
    study.run(address)
    kept = Objects(address).objects
    group = json.loads(kept.read("s.zarr/zarr.json") or b"")
    group["attributes"] = {"dalembert": group["attributes"]["dalembert"]}
    keys = [k for k in kept.keys("s.zarr/") if k.endswith("zarr.json")]
    kept.remove([k for k in kept.keys("s.zarr/") if k not in keys[-written:]])
    kept.write("s.zarr/zarr.json", json.dumps(group).encode())
    with pytest.raises(da.ModelError, match=r"memory://.*s\.zarr: file not found; dalembert study run"):
        StudyResult.open(address)
    study.run(address)
    assert chunks_of(stored(address)) == answers


def test_what_is_no_study_is_left_alone(study: Study, address: str) -> None:
    kept = Objects(address).objects
    others = (("mine.txt", b"precious"), ("zarr.json", b'{"attributes": {}}'), ("zarr.json", b'{"cut'))
    for key, data in ((f"s.zarr/{name}", data) for name, data in others):
        kept.write(key, data)
        with pytest.raises(da.ModelError, match=r"s\.zarr exists and is not a study; give another name"):
            study.run(address)
        assert kept.read(key) == data


def test_a_second_run_is_refused_with_its_holder_and_its_end(study: Study, address: str) -> None:
    sentence = (
        r"s\.zarr is being written by process \d+ on .* since .*, whose lease ends at \d\d:\d\d:\d\d if it is "
        "not renewed; wait for it, or end it; one that died is taken over after that time"
    )
    before = set(threading.enumerate())
    with Store(address).locked():
        (renewing,) = set(threading.enumerate()) - before
        assert renewing.daemon, "a process that dies does not wait for it"
        with pytest.raises(da.ModelError, match=sentence):
            study.run(address)
    study.run(address)  # let go


def test_a_lease_is_renewed_taken_over_when_it_has_ended_and_then_lost(
    study: Study, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(object_store, "LEASE", 0.2)
    dead, heir = Store(address), Store(address)
    with dead.locked():
        time.sleep(0.4)
        with pytest.raises(da.ModelError, match="whose lease ends"), heir.locked():
            raise AssertionError("it was renewed")
        lease = dead.place._lease  # type: ignore[union-attr]
        assert lease is not None
        lease._ended.set()  # as of a process that died
        lease._thread.join()
        time.sleep(0.25)
        with pytest.raises(da.ModelError, match="could not be renewed in time; finished blocks are kept"):
            dead.place.check()
        with heir.locked():
            heir.place.check()
            lease._ended.clear()
            lease._renew()
            with pytest.raises(da.ModelError, match=r"the lease of .* is process \d+ on .*'s now"):
                dead.place.check()
    study.run(address)


@pytest.mark.parametrize(
    ("address", "sentence"),
    [
        ("s3://bucket", "s3://bucket names no place for a store; write s3://bucket/pump.zarr"),
        ("zz://a/s.zarr", "zz://a/s.zarr: protocol not known: zz; fsspec knows memory://, file://, s3://"),
        (
            "memory://none/s.zarr",
            "memory://none/s.zarr: file not found; dalembert study run FILE creates one",
        ),
    ],
)
def test_an_address_that_is_none_is_said(
    address: str, sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["study", "show", address]) == 2
    assert sentence in capsys.readouterr().err


def test_what_serves_an_address_may_be_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(address: str) -> None:
        raise ImportError("Install s3fs to access S3")

    monkeypatch.setattr(object_store, "ByFsspec", refuse)
    monkeypatch.setattr(object_store, "find_spec", lambda name: None)
    with pytest.raises(
        da.ModelError, match=r"a study at s3://b/s\.zarr needs the package obstore, which is not inst"
    ):
        Objects("s3://b/s.zarr")


def test_the_commands_take_an_address(
    address: str, study: Study, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "s.yaml"
    file.write_text(FILE.replace(str(DESIGNS), "300"))
    assert main(["study", "run", str(file), "-o", address]) == 0
    assert main(["study", "run", str(file), "-o", address]) == 2
    assert f"{address} already exists; dalembert study resume {address}" in capsys.readouterr().err
    assert main(["study", "resume", address]) == main(["study", "resume", str(file), "-o", address]) == 0
    assert main(["study", "extend", address, "--designs", "400"]) == main(["study", "show", address]) == 0
    assert "400 of 400 designs" in capsys.readouterr().out
    assert main(["study", "design", address, "7", "-o", str(tmp_path / "d.yaml")]) == 0
    assert main(["study", "show", address, "--csv", str(tmp_path / "s.csv")]) == 0
    assert len((tmp_path / "s.csv").read_text().splitlines()) == 401


@pytest.mark.long
def test_a_report_of_an_address(address: str, study: Study, tmp_path: Path) -> None:
    study.run(address)
    assert main(["study", "show", address, "--report", str(tmp_path / "s.html")]) == 0


SHORT = "from dalembert.studies import object_store\nobject_store.LEASE = 0.3\n"
"""Leases that end soon after a kill."""


@pytest.mark.parametrize("seeds", tiers([], [range(30)]))
def test_killed_runs_are_taken_over_and_resumed_bit_by_bit(
    seeds: range, study: Study, answers: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(object_store, "LEASE", 0.3)
    (tmp_path / "s.yaml").write_text(FILE)
    names = [str(tmp_path / "s.yaml"), f"file://{tmp_path}", *map(str, seeds)]
    subprocess.run([sys.executable, "-c", SHORT + KILLED, *names], check=True)
    time.sleep(0.35)
    for seed in seeds:
        study.run(f"file://{tmp_path}/{seed}.zarr")
        assert chunks_of(stored(f"file://{tmp_path}/{seed}.zarr")) == answers, seed


class Kept:
    """obstore's functions on files of a folder."""

    class exceptions:
        BaseError = type("BaseError", (Exception,), {})
        AlreadyExistsError = type("AlreadyExistsError", (BaseError,), {})

    class Found:
        def __init__(self, data: bytes) -> None:
            self.data = data

        def bytes(self) -> bytes:
            return self.data

    store = SimpleNamespace(from_url=lambda address: Path(address.partition("://")[2]))

    def get(self, store: Path, key: str) -> Kept.Found:
        return self.Found((store / key).read_bytes())

    def put(self, store: Path, key: str, data: bytes, mode: str) -> None:
        if mode == "create" and (store / key).exists():
            raise self.exceptions.AlreadyExistsError
        (store / key).parent.mkdir(parents=True, exist_ok=True)
        (store / key).write_bytes(data)

    def delete(self, store: Path, key: str) -> None:
        (store / key).unlink()

    def list(self, store: Path, prefix: str) -> list[list[dict[str, str]]]:
        found = [str(p.relative_to(store)) for p in store.rglob("*") if p.is_file()]
        return [[{"path": path}] for path in found if path.startswith(prefix)]


@pytest.mark.parametrize("kind", ["memory", "file", "obstore"])
def test_objects_are_written_whole_once_and_listed(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each kind of store alike: none is there, created only once, overwritten, listed in order, removed twice."""
    monkeypatch.setitem(sys.modules, "obstore", Kept())
    address = f"memory://{time.time_ns()}" if kind == "memory" else f"file://{tmp_path}"
    kept = object_store.ByObstore(address) if kind == "obstore" else object_store.ByFsspec(address)
    assert (kept.read("a/2"), kept.keys("a/")) == (None, [])
    for key in ("a/2", "a/1", "b/1"):
        kept.write(key, key.encode(), new=True)
    with pytest.raises(FileExistsError):
        kept.write("a/1", b"other", new=True)
    assert kept.read("a/1") == b"a/1"
    kept.write("a/1", b"more")
    assert kept.read("a/1") == b"more"
    assert kept.keys("a/") == ["a/1", "a/2"]
    kept.remove(["a/9", "a/1"])
    assert (kept.read("a/1"), kept.keys("a/"), kept.read("b/1")) == (None, ["a/2"], b"b/1")
    assert issubclass(FileNotFoundError, kept.errors)
    if kind != "memory":
        assert sorted(p.name for p in tmp_path.rglob("*") if p.is_file()) == ["1", "2"]


def test_obstore_serves_a_cloud_without_its_package_of_fsspec(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(address: str) -> None:
        raise ImportError("Install s3fs to access S3")

    monkeypatch.setitem(sys.modules, "obstore", Kept())
    monkeypatch.setattr(object_store, "ByFsspec", missing)
    monkeypatch.setattr(object_store, "find_spec", lambda name: name == "obstore")
    assert isinstance(Objects("s3://b/s.zarr").objects, object_store.ByObstore)
    with pytest.raises(
        da.ModelError, match=r"needs a package \(install s3fs to access s3\), which is not inst.*; pip"
    ):
        Objects("hdfs://b/a/s.zarr")


def test_a_store_that_cannot_be_reached_is_said(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    place = Objects(address)
    for error, said in ((OSError("no route\nmore"), "no route"), (RuntimeError(), "RuntimeError")):

        def fail(key: str, error: Exception = error) -> bytes:
            raise error

        monkeypatch.setattr(place.objects, "read", fail)
        with pytest.raises(
            da.ModelError, match=f"cannot be reached: {said}; see the address, the credentials"
        ):
            place.exists()


def test_a_lease_that_another_run_creates_first_is_refused(address: str) -> None:
    kept = Objects(address).objects
    until = {"until": time.time() + 60, "who": "process 7 on host since noon", "token": "other"}

    class Late:
        """Another run writes the lease just before this one, in a store with or without exclusive creation."""

        def __init__(self, exclusive: bool) -> None:
            self.exclusive = exclusive

        def __getattr__(self, name: str) -> object:
            return getattr(kept, name)

        def write(self, key: str, data: bytes, new: bool = False) -> None:
            kept.write(key, json.dumps(until).encode())
            if self.exclusive:
                raise FileExistsError(key)

    for exclusive in (True, False):
        late: Any = Late(exclusive)
        with pytest.raises(
            da.ModelError, match="is being written by process 7 on host since noon, whose lease ends"
        ):
            object_store.Lease(address, late, "s.zarr.lock/")
        kept.remove(kept.keys("s.zarr.lock/"))
    kept.write("s.zarr.lock/00000004", b'{"cut')
    lease = object_store.Lease(address, kept, "s.zarr.lock/")
    lease.release()
    assert kept.keys("s.zarr.lock/") == ["s.zarr.lock/00000005"], (
        "the numbers go on behind a record that is cut"
    )
    assert float(json.loads(kept.read("s.zarr.lock/00000005") or b"")["until"]) < time.time()


def test_a_lease_is_tried_again_while_its_store_is_gone(
    address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is kept as long as it lasts, renewed when the store is back, and let go in silence where it is not."""
    monkeypatch.setattr(object_store, "LEASE", 1.6)
    kept = Objects(address).objects
    gone = list[int]()

    class Away:
        def __getattr__(self, name: str) -> object:
            return getattr(kept, name)

        def keys(self, prefix: str) -> list[str]:
            if gone:
                gone.append(1)
                raise OSError("no route")
            return kept.keys(prefix)

    lease = object_store.Lease(address, Away(), "s.zarr.lock/")  # type: ignore[arg-type]
    first = lease.until
    gone.append(1)
    time.sleep(0.55)
    assert (len(gone) > 1, lease.until, lease.lost) == (True, first, "")
    lease.check()
    gone.clear()
    time.sleep(0.55)
    lease.check()
    assert lease.until > first
    gone.append(1)
    lease.release()
    assert not lease._thread.is_alive()
    (key,) = kept.keys("s.zarr.lock/")
    assert json.loads(kept.read(key) or b"")["token"] == lease.token
