"""The blocks of a study computed: on threads, or on the workers of a dask scheduler; stored, and resumed."""

from __future__ import annotations

import hashlib
import os
import pickle
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any

import numpy as np

from dalembert.analysis.batch.batch_result import CODES
from dalembert.arrays import Array, Ints, Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.kernel.parallel_runs import cores
from dalembert.model.files.rewriting import text_of
from dalembert.studies.block_engines import Block
from dalembert.studies.design_study import Study
from dalembert.studies.store import FIELDS, Store, StoredArray, ledger_row
from dalembert.studies.store_folder import unwritable
from dalembert.studies.study_result import StudyResult
from dalembert.units import KINDS

IN_MEMORY = 2 << 30
"""Bytes of a study that is not stored."""
IN_FLIGHT = 4
"""Blocks that wait at a dask worker's thread at most."""
CHANGED = {
    "model": "the mechanism has changed since",
    "study": "what is varied, drawn or asked for has changed since",
    "program": "this version of dalembert, or this kind of processor, computes it differently",
}
"""Print that differs -> its sentence."""

Progress = Callable[[int, int], object] | None


def run_study(
    study: Study,
    target: str | os.PathLike[str] | None,
    threads: int | None,
    scheduler: Any,
    progress: Progress,
    check: bool,
) -> StudyResult:
    """Implementation of `Study.run`."""
    require("threads", threads)
    if target is None:
        memory = InMemory(study)
        _compute(study, memory, range(memory.blocks), threads, scheduler, progress)
        return StudyResult(study, memory.arrays, memory.rows, memory.block)
    store = Store(target)
    with store.locked():
        try:
            block = _opened(study, store)
            ledger = store.ledger()
            todo = []
            for b, row in enumerate(ledger):
                if row[0] and check and not store.sound(b, block, study.count, row):
                    store.forget(b)
                    row[0] = 0
                todo += [] if row[0] else [b]
            _compute(study, _Target(store, block, study.count), todo, threads, scheduler, progress)
        except store.place.errors as error:
            raise unwritable(store, error) from None
        left = int((store.ledger()[:, 0] == 0).sum())
        if left:
            raise ModelError(f"{left} blocks of {store} are missing after the run", "resume it")
    return StudyResult(study, store.arrays, store.ledger(), block)


def _opened(study: Study, store: Store) -> int:
    """The store, created if it does not exist, checked if it does; designs of a block."""
    if not store.exists():
        store.create(attributes(study), study.count, study.block_size(), layout(study), study.plan.table)
    known = store.open()
    for key, sentence in CHANGED.items():
        if known["prints"][key] != study.prints[key]:
            raise ModelError(
                f"{store}: {sentence}, and results would be mixed",
                "name another store, or go back to what it was",
            )
    store.place.sweep()
    block = int(known["block"])
    if known["designs"] > study.count:
        raise ModelError(
            f"{store} has {known['designs']} designs, but {study.count} are requested",
            "request at least as many, or name another store",
        )
    if known["designs"] < study.count or store.arrays["status"].shape[0] != study.count:
        store.resize(study.count, block)
    return block


def attributes(study: Study) -> Tree:
    """Description in a store: the model file, the study, its fingerprint, units by path."""
    from dalembert import __version__

    m = study.mechanism
    units = {path: KINDS[kind].si for path, kind in study.number_kinds.items()}
    return {
        "dalembert": __version__,
        "title": m.title,
        "model": text_of(
            m, "yaml", os.devnull
        ),  # a folder where no column is: what files hold is written out
        "study": study.tree(),
        "prints": study.prints,
        "units": units,
        "one_by_one_because": study.why_slow,
    }


def layout(study: Study) -> dict[str, StoredArray]:
    """The arrays of a store, from a block of one design."""
    probe, _ = study.block(0, 1)
    kinds, out, along = study.kinds, {}, "position" if study.motion is None else "instant"
    for name in study.outputs:
        shape = probe[name].shape[1:]
        names = [] if study.reduce or not shape else [along]
        rest = shape[len(names) :]
        if study.reduce == "envelope" and shape:
            rest, last = rest[:-1], ["side"]
        else:
            last = []
        names += [f"component_{size}" if size != study.mechanism.dimension else "component" for size in rest]
        about = {"units": KINDS[kinds[name]].si, "reduce": study.reduce or "none"}
        out[name] = StoredArray(shape, "f8", (*names, *last), about)
    flags = {"flag_values": list(range(len(CODES))), "flag_meanings": " ".join(CODES)}
    out["status"] = StoredArray(probe["status"].shape[1:], "u1", (along,) * (probe["status"].ndim - 1), flags)
    for path in study.paths if study.keep else ():
        out[path] = StoredArray((), "f8", (), {"units": "SI"})
    return out


class _Target:
    """Target of the finished blocks of a stored study."""

    def __init__(self, store: Store, block: int, count: int) -> None:
        self.store, self.block, self.count = store, block, count

    def put(self, b: int, arrays: Block, ms: float) -> None:
        self.store.put(b, self.block, self.count, arrays, ms)


class InMemory:
    """The same for one that is kept in memory."""

    def __init__(self, study: Study) -> None:
        self.block, self.count = study.block_size(), study.count
        probe, _ = study.block(0, 1)
        size = self.count * sum(a.nbytes for a in probe.values())
        if size > IN_MEMORY:
            raise ModelError(
                f"the results take {size / 2**30:.1f} GB", "give run() the name of a store on disk"
            )
        self.arrays: dict[str, Array] = {
            name: np.empty((self.count, *a.shape[1:]), a.dtype) for name, a in probe.items()
        }
        self.blocks = -(-self.count // self.block)
        self.rows: Ints = np.zeros((self.blocks, len(FIELDS)), np.int64)

    def put(self, b: int, arrays: Block, ms: float) -> None:
        for name, values in arrays.items():
            self.arrays[name][b * self.block : b * self.block + len(values)] = values
        self.rows[b] = ledger_row(arrays, ms)


def _compute(
    study: Study,
    target: _Target | InMemory,
    todo: Sequence[int],
    threads: int | None,
    scheduler: Any,
    progress: Progress,
) -> None:
    """Compute blocks and put them where they go."""
    done = study.count - sum(_length(study, target.block, b) for b in todo)

    def tell(b: int) -> None:
        nonlocal done
        done += _length(study, target.block, b)
        if progress is not None:
            progress(done, study.count)

    if scheduler is not None:
        _on_dask(study, target, todo, scheduler, tell)
    elif todo:
        _on_threads(study, target, todo, threads or cores(), tell)


def _length(study: Study, block: int, b: int) -> int:
    return min((b + 1) * block, study.count) - b * block


def _on_threads(
    study: Study, target: _Target | InMemory, todo: Sequence[int], threads: int, tell: Callable[[int], None]
) -> None:
    halt = threading.Event()
    _ = study.prints  # compiles what the blocks need, once

    def work(b: int) -> int:
        if not halt.is_set():
            first = b * target.block
            target.put(b, *study.block(first, first + _length(study, target.block, b)))
        return b

    rest = iter(todo)
    with ThreadPoolExecutor(threads) as pool:
        try:
            pending = {pool.submit(work, b) for b in _some(rest, threads + 1)}
            while pending:
                finished, pending = wait(pending, return_when=FIRST_COMPLETED)
                for one in finished:
                    tell(one.result())
                pending |= {pool.submit(work, b) for b in _some(rest, len(finished))}
        except BaseException:  # Ctrl-C too: the blocks under way are finished and kept
            halt.set()
            raise


def _some(rest: Iterator[int], count: int) -> list[int]:
    """The next few, and none lost."""
    return [b for _ in range(count) if (b := next(rest, None)) is not None]


def _on_dask(
    study: Study, target: _Target | InMemory, todo: Sequence[int], scheduler: Any, tell: Callable[[int], None]
) -> None:
    """The same blocks on the workers of a dask scheduler; they come back here and are stored here."""
    from dalembert.saving import check_installed

    check_installed("distributed", "a study on a scheduler", "study")
    from distributed import Client, as_completed

    connected = isinstance(scheduler, str)
    try:
        client = Client(scheduler, set_as_default=False) if connected else scheduler
    except (OSError, ValueError) as error:
        raise ModelError(
            f"no dask scheduler answers at {scheduler}: {error}", "start one: dask scheduler"
        ) from None
    try:
        spec, program = pickle.dumps(study), study.prints["program"]
        rest = iter(todo)

        def send(b: int) -> Any:
            first = b * target.block
            stop = first + _length(study, target.block, b)
            return client.submit(compute_block, spec, program, b, first, stop, pure=False)

        width = IN_FLIGHT * max(1, sum(client.nthreads().values()))
        waiting = as_completed([send(b) for b in _some(rest, width)], loop=client.loop)
        for future in waiting:
            b, arrays, ms = future.result()
            target.put(b, arrays, ms)
            tell(b)
            future.release()
            for more in _some(rest, 1):
                waiting.add(send(more))
    finally:
        if connected:
            client.close()


_known: dict[bytes, Study] = {}
_one = threading.Lock()


def compute_block(spec: bytes, program: str, b: int, start: int, stop: int) -> tuple[int, Block, float]:
    """One block on a worker, which compiles each study once; refused where its program gives other bits."""
    key = hashlib.sha256(spec).digest()
    with _one:
        if key not in _known:
            study: Study = pickle.loads(spec)
            if study.prints["program"] != program:
                raise ModelError(
                    "a worker's processor or version of dalembert computes this study differently",
                    "start workers of one kind, or give lanes=, the same on all",
                )
            _known.clear()  # of other studies
            _known[key] = study
        study = _known[key]
    return b, *study.block(start, stop)
