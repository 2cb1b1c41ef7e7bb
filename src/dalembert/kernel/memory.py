"""Memory of results: aligned with cache lines, reused if large, and limited by the available memory."""

from __future__ import annotations

import ctypes
import math
import os
from contextlib import suppress
from typing import Any, ClassVar

import numpy as np

from dalembert.arrays import Array

LINE = 64
"""Bytes of a line of the cache."""
FRESH = 1 << 17
"""Bytes of a result above which its memory comes from the system page by page."""
LARGE = 1 << 22
"""Bytes of a result that does not fit into any cache."""
KEPT = 1 << 28
"""Largest number of bytes kept for the next results."""


class _Pages:
    """Memory of a result. When released, it is kept for the next result of about its size: getting fresh pages takes
    three times as long as computing their contents."""

    waiting: ClassVar[dict[int, Array]] = {}

    def __init__(self, size: int) -> None:
        fits = (key for key, kept in list(self.waiting.items()) if size <= kept.size <= 2 * size)
        kept = self.waiting.pop(next(fits, 0), None)
        self.whole, self.again = np.empty(size) if kept is None else kept, kept is not None
        self.__array_interface__ = self.whole.__array_interface__

    def __del__(self) -> None:
        self.waiting[id(self.whole)] = self.whole
        for key in list(self.waiting):
            if sum(kept.nbytes for kept in list(self.waiting.values())) > KEPT:
                self.waiting.pop(key, None)


def result_array(shape: tuple[int, ...]) -> tuple[Array, bool]:
    """An uninitialized array, aligned with a cache line: a register stored across two lines takes twice as long; and a
    flag for large arrays whose pages have been used before."""
    count = math.prod(shape)
    size, again = count + LINE // 8, False
    if 8 * count < FRESH:
        buffer = np.empty(size)
    else:
        pages = _Pages(size)
        buffer, again = np.asarray(pages), pages.again and 8 * count >= LARGE
    first = -address(buffer) % LINE // 8
    return buffer[first : first + count].reshape(shape), again


def aligned_array(shape: tuple[int, ...]) -> Array:
    """An uninitialized array, aligned with a cache line."""
    return result_array(shape)[0]


def address(array: Any) -> int:
    """Address of an array's first byte."""
    try:  # several times as fast
        return ctypes.addressof(ctypes.c_char.from_buffer(array))
    except (TypeError, ValueError):  # not to be written to, or empty
        start: int = array.__array_interface__["data"][0]
        return start


def available() -> float:
    """Bytes that a result may take: free or reclaimable memory, on Linux, within a container's limit; elsewhere the
    total, infinite where the system does not report it."""
    free_bytes = math.inf
    with suppress(AttributeError, ValueError, OSError):  # not on Windows; not every system knows the names
        free_bytes = float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    free = _read("/proc/meminfo").get("MemAvailable:")
    limit = _read("/sys/fs/cgroup/memory.max", "limit").get("limit")
    if limit is not None:
        used = _read("/sys/fs/cgroup/memory.current", "used").get("used", 0)
        limit += _read("/sys/fs/cgroup/memory.stat").get("inactive_file", 0) - used
    return min(free_bytes, math.inf if free is None else 1024 * free, math.inf if limit is None else limit)


def _read(path: str, name: str = "") -> dict[str, int]:
    """Numbers by name in a file of lines; a single number gets the given name."""
    try:
        with open(path, encoding="ascii") as file:
            rows = [f"{name} {line}".split() for line in file]
    except OSError:
        return {}
    return {row[0]: int(row[1]) for row in rows if len(row) > 1 and row[1].isdigit()}
