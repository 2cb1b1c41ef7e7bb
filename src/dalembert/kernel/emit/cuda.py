"""The same program on an NVIDIA graphics card, through cupy: one thread per design and position, or per design."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.arrays import Array
from dalembert.kernel.emit import c_text
from dalembert.kernel.emit.reductions import Slots, width
from dalembert.kernel.parallel_runs import Progress
from dalembert.kernel.program import Program

PART = 1 << 24
"""Numbers of results of one part on the card: 128 MiB."""
THREADS = 128


def card() -> Any:
    """cupy, with a CUDA device; raises RuntimeError with the reason if none is available."""
    try:
        import cupy
    except ImportError:
        raise RuntimeError("cupy is not installed (pip install cupy-cuda12x)") from None
    try:
        count = cupy.cuda.runtime.getDeviceCount()
    except cupy.cuda.runtime.CUDARuntimeError as error:
        raise RuntimeError(f"no CUDA device is available ({error})") from None
    if not count:
        raise RuntimeError("no CUDA device is available")
    return cupy


def source(program: Program, slots: Slots) -> str:
    """The text that is compiled for the card."""
    return c_text.emit_reduced(program, slots) if slots else c_text.grid(program)


def run(
    program: Program,
    slots: Slots,
    values: Array,
    columns: Array,
    common: Array,
    progress: Progress | None = None,
) -> tuple[Array, NDArray[np.uint8]]:
    """Results (design, output, position) or (design, slot), and status codes, from channels (position, channel)."""
    cupy = card()
    entry = cupy.RawModule(code=source(program, slots)).get_function("reduced" if slots else "grid")
    designs, positions = len(values), len(columns)
    shape = (width(slots),) if slots else (len(program.outputs), positions)
    out = np.empty((designs, *shape))
    code = np.empty((designs,) if slots else (designs, positions), np.uint8)
    path, extra = cupy.asarray(columns), cupy.asarray(np.append(common, 0.0))
    step = max(1, PART // max(int(np.prod(shape)), values.shape[1], 1))
    for k in range(0, designs, step):
        mine = cupy.asarray(np.ascontiguousarray(values[k : k + step], float))
        count = len(mine)
        results, flags = cupy.empty((count, *shape)), cupy.empty((count, *code.shape[1:]), cupy.uint8)
        work = count if slots else count * positions
        counts = tuple(np.int64(n) for n in (values.shape[1], columns.shape[1], count, positions))
        entry((-(-work // THREADS),), (THREADS,), (mine, path, extra, results, flags, *counts))
        out[k : k + step], code[k : k + step] = cupy.asnumpy(results), cupy.asnumpy(flags)
        if progress is not None:
            progress(k + count, designs)
    return out, code
