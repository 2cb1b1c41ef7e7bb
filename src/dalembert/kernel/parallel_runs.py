"""Running a machine over many designs: in parts, on several threads, with progress and interruption."""

from __future__ import annotations

import math
import os
from collections import deque
from collections.abc import Callable, Iterator
from threading import Thread

import numpy as np

from dalembert.arrays import Array
from dalembert.kernel.emit.machine_code import Machine, to_blocks
from dalembert.kernel.memory import aligned_array

Progress = Callable[[int, int], object]

Store = Callable[[slice, Array], object]
"""Receiver of the results of some of the designs."""

WORK = 400_000
"""Positions of one part: about two milliseconds, long compared with a call, short for a user."""
LEAST = 40_000
"""Positions below which a separate part does not pay."""


def part_size(count: int, positions: int, threads: int | None) -> int:
    """Designs of one part: few enough that every thread has several, so that none waits long for the last."""
    if count * positions <= min(LEAST, WORK):
        return max(1, count)
    share = -(-count // (4 * (threads or cores())))
    return min(max(1, WORK // positions), max(share, LEAST // positions))


def path_array(columns: Array, common: Array, lanes: int, weighted: bool) -> tuple[Array, int]:
    """Channels (P, C) in blocks, the last one padded with 0, followed by the common inputs; and the number of
    blocks."""
    count = len(columns)
    blocks = -(-count // lanes)
    out = to_blocks(columns, lanes).reshape(blocks, columns.shape[1], lanes)
    if weighted:
        weight = (np.arange(blocks * lanes) < count).astype(float).reshape(blocks, 1, lanes)
        out = np.concatenate([out, weight], axis=1)
    channels = aligned_array((out.size + len(common),))
    channels[: out.size], channels[out.size :] = out.ravel(), common
    return channels, blocks


def row_length(blocks: int, lanes: int) -> int:
    """Numbers between the results of consecutive outputs of a grid: an odd number of vectors."""
    return (blocks | 1) * lanes


CACHE = 1 << 19
"""Bytes of results that stay in the cache until they are stored elsewhere."""


def run_grid(
    machine: Machine,
    values: Array,
    path: tuple[Array, int],
    channels: int,
    into: Array | tuple[tuple[int, ...], Store],
    code: Array,
    threads: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Fills ``into`` and ``code`` (design, ...), design by design over all blocks of positions. ``into`` may also be
    the shape of one design's results and their receiver: they then pass through the cache, a few designs at a time."""
    data, blocks = path

    def run(which: slice, out: Array) -> None:
        mine = np.ascontiguousarray(values[which], float)
        machine(mine, data, out, code[which], (mine.shape[1], channels, len(mine), blocks))

    def through_cache(which: slice) -> None:
        shape, store = into
        designs = max(1, min(which.stop - which.start, CACHE // (8 * math.prod(shape))))
        few = aligned_array((designs, *shape))
        for k in range(which.start, which.stop, designs):
            piece = slice(k, min(k + designs, which.stop))
            run(piece, few)
            store(piece, few[: piece.stop - k])

    part = through_cache if isinstance(into, tuple) else lambda which: run(which, into[which])
    in_parts(part, len(values), part_size(len(values), blocks * machine.lanes, threads), threads, progress)


PAIR = 16
"""Cost of a pair in positions of a grid: its numbers and results are reordered around the call."""


def run_pairs(
    machine: Machine,
    values: Array,
    columns: Array,
    common: Array,
    out: Array,
    code: Array,
    threads: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Fills ``out`` (pair, output) and ``code`` (pair,) from values (pair, number) and channels (pair, channel)."""
    lanes = machine.lanes

    def part(which: slice) -> None:
        mine = to_blocks(np.asarray(values[which], float), lanes)
        path, blocks = path_array(columns[which], common, lanes, weighted=False)
        results = aligned_array((blocks, out.shape[1], lanes))
        flags = np.empty((blocks, lanes), np.uint8)
        counts = (values.shape[1], columns.shape[1], 0, blocks)
        machine(mine, path, results, flags, counts)
        count = len(out[which])
        out[which] = results.swapaxes(1, 2).reshape(-1, out.shape[1])[:count]
        code[which] = flags.ravel()[:count]

    in_parts(part, len(values), part_size(len(values), PAIR, threads), threads, progress)


def run_designs(
    machine: Machine,
    values: Array,
    columns: Array,
    common: Array,
    outputs: int,
    threads: int | None = None,
    progress: Progress | None = None,
) -> tuple[Array, Array]:
    """Results (design, output, position) and codes (design, position) of every design (design, number) at a few
    positions (position, channel): the lanes are designs, and so are neighbours in memory."""
    lanes, count = machine.lanes, len(values)
    wide = -(-count // lanes) * lanes
    out, code = aligned_array((outputs, len(columns), wide)), np.empty((len(columns), wide), np.uint8)
    step = part_size(count, PAIR * len(columns), threads)
    step = min(-(-step // lanes) * lanes, max(lanes, CACHE // (8 * outputs) // lanes * lanes))

    def part(which: slice) -> None:
        mine = to_blocks(np.asarray(values[which], float), lanes)
        place = slice(which.start, which.start + len(mine) * lanes)
        results, flags = aligned_array((len(mine), outputs, lanes)), np.empty((len(mine), lanes), np.uint8)
        counts = (values.shape[1], columns.shape[1], 0, len(mine))
        for k, row in enumerate(columns):
            same = np.broadcast_to(row[None, :, None], (len(mine), len(row), lanes))
            path = aligned_array((same.size + len(common),))
            path[: same.size], path[same.size :] = same.ravel(), common
            machine(mine, path, results, flags, counts)
            out[:, k, place].reshape(outputs, len(mine), lanes)[:] = results.swapaxes(0, 1)
            code[k, place] = flags.ravel()

    in_parts(part, count, step, threads, progress)
    return out[..., :count].transpose(2, 0, 1), code[:, :count].T


def in_parts(
    part: Callable[[slice], None], count: int, step: int, threads: int | None, progress: Progress | None
) -> None:
    """Calls ``part`` on slices of ``count`` items, in this thread and in others, and ``progress`` in this thread; on an
    interruption or an error it returns after the parts that are running."""
    if 0 < count <= step:
        part(slice(0, count))
        if progress is not None:
            progress(count, count)
        return
    parts = deque(slice(k, min(k + step, count)) for k in range(0, count, step))
    done = [0] * (1 if len(parts) < 2 else min(threads or cores(), len(parts)))
    failed: list[BaseException] = []

    def left() -> Iterator[slice]:
        while not failed:
            try:
                yield parts.popleft()
            except IndexError:
                return

    def work(who: int) -> None:
        try:
            for piece in left():
                part(piece)
                done[who] += piece.stop - piece.start
                if progress is not None and who == 0:
                    progress(sum(done), count)
        except BaseException as error:
            failed.append(error)

    others = [Thread(target=work, args=(who,)) for who in range(1, len(done))]
    for thread in others:
        thread.start()
    work(0)
    for thread in others:
        thread.join()
    if failed:
        raise failed[0]
    if others and progress is not None:
        progress(count, count)


def cores() -> int:
    """Cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
