"""Running a machine over many designs: in parts, on several threads, with progress, and stopping when asked to."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.kernel.emit.machine_code import Machine, aligned_array, to_blocks
from dalembert.kernel.program import Program

Progress = Callable[[int, int], object]

WORK = 400_000
"""Positions of one part: about two milliseconds, long against a call, short against a person's patience."""
LEAST = 40_000
"""Positions below which a part is not worth its call."""


def part_size(count: int, positions: int, threads: int | None) -> int:
    """Designs of one part: few enough that every thread has several, so that none waits long for the last."""
    share = -(-count // (4 * (threads or cores())))
    return min(max(1, WORK // positions), max(share, LEAST // positions))


def path_array(columns: Array, common: Array, lanes: int, weighted: bool) -> tuple[Array, int]:
    """Channels (P, C) in blocks, with a last one that is 0 beyond the last position, and the common inputs behind
    them; and the number of blocks."""
    count = len(columns)
    blocks = -(-count // lanes)
    out = to_blocks(columns, lanes).reshape(blocks, columns.shape[1], lanes)
    if weighted:
        weight = (np.arange(blocks * lanes) < count).astype(float).reshape(blocks, 1, lanes)
        out = np.concatenate([out, weight], axis=1)
    whole = aligned_array((out.size + len(common),))
    whole[: out.size], whole[out.size :] = out.ravel(), common
    return whole, blocks


def row_length(blocks: int, lanes: int) -> int:
    """Numbers from one output to the next in the results of a grid: an odd number of vectors."""
    return (blocks | 1) * lanes


def run_grid(
    machine: Machine,
    program: Program,
    values: Array,
    path: tuple[Array, int],
    channels: int,
    out: Array,
    code: Array,
    threads: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Fill ``out`` and ``code`` (design, ...), design by design over all blocks of positions."""
    data, blocks = path

    def part(which: slice) -> None:
        mine = np.ascontiguousarray(values[which], float)
        counts = (mine.shape[1], channels, len(mine), blocks)
        machine(mine, data, out[which], code[which], counts)

    in_parts(part, len(values), part_size(len(values), blocks * machine.lanes, threads), threads, progress)


PAIR = 16
"""What a pair costs in positions of a grid: its numbers and its results are put in order around the call."""


def run_pairs(
    machine: Machine,
    program: Program,
    values: Array,
    columns: Array,
    common: Array,
    out: Array,
    code: Array,
    threads: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Fill ``out`` (pair, output) and ``code`` (pair,) from values (pair, number) and channels (pair, channel)."""
    lanes = machine.lanes

    def part(which: slice) -> None:
        mine = to_blocks(np.asarray(values[which], float), lanes)
        path, blocks = path_array(columns[which], common, lanes, weighted=False)
        found = aligned_array((blocks, len(program.outputs), lanes))
        marks = np.empty((blocks, lanes), np.uint8)
        counts = (values.shape[1], columns.shape[1], 0, blocks)
        machine(mine, path, found, marks, counts)
        count = len(out[which])
        out[which] = found.swapaxes(1, 2).reshape(-1, len(program.outputs))[:count]
        code[which] = marks.ravel()[:count]

    in_parts(part, len(values), part_size(len(values), PAIR, threads), threads, progress)


def in_parts(
    part: Callable[[slice], None], count: int, step: int, threads: int | None, progress: Progress | None
) -> None:
    """Call ``part`` on slices of ``count`` things; an interruption leaves after the parts under way."""
    parts = [slice(k, min(k + step, count)) for k in range(0, count, step)]
    workers = min(threads or cores(), len(parts))
    if workers <= 1:
        done = 0
        for piece in parts:
            part(piece)
            done += piece.stop - piece.start
            if progress is not None:
                progress(done, count)
        return
    _on_threads(part, iter(parts), workers, count, progress)


def _on_threads(
    part: Callable[[slice], None], parts: Iterator[slice], workers: int, count: int, progress: Progress | None
) -> None:
    stop, done = threading.Event(), 0
    with ThreadPoolExecutor(workers) as pool:
        pending: dict[Any, slice] = {}
        try:
            while True:
                while len(pending) < 2 * workers and (piece := next(parts, None)) is not None:
                    pending[pool.submit(_unless, stop, part, piece)] = piece
                if not pending:
                    return
                for future in wait(pending, return_when=FIRST_COMPLETED).done:
                    future.result()
                    piece = pending.pop(future)
                    done += piece.stop - piece.start
                if progress is not None:
                    progress(done, count)
        except BaseException:
            stop.set()
            raise


def _unless(stop: threading.Event, part: Callable[[slice], None], piece: slice) -> None:
    if not stop.is_set():
        part(piece)


def cores() -> int:
    """Cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
