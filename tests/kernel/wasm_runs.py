"""A kernel's WebAssembly run by wasmtime, and how far it is from the machine code of the same kernel."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from dalembert.analysis.batch.kernel_export import WasmModule, wasm_channels


def run_wasm(module: WasmModule, values: Any, path: Any) -> Any:
    """Outputs and, last, marks (output, row) of one design."""
    wasmtime = pytest.importorskip("wasmtime")
    store = wasmtime.Store(wasmtime.Engine())
    exports = wasmtime.Instance(store, wasmtime.Module(store.engine, module.code), []).exports(store)
    memory, places, end = exports["memory"], [], module.heap
    blocks = [np.ravel(values), np.ravel(path), np.zeros((len(module.outputs) + 1) * module.row)]
    for block in blocks:
        places.append(end)
        end += -(-8 * len(block) // 16) * 16
    memory.grow(store, max(0, -(-(end - memory.data_len(store)) // 65536)))
    for block, place in zip(blocks, places, strict=True):
        memory.write(store, block.astype("<f8").tobytes(), place)
    exports["run"](store, *places, module.row // 2)
    return np.frombuffer(memory.read(store, places[2], end), "<f8")[: len(blocks[2])].reshape(-1, module.row)


def distance(k: Any, values: Any = None) -> tuple[float, int, int]:
    """Of one design: the greatest difference over the largest output, marks that differ, and numbers compared."""
    count = len(k.trace.course.schedule.position)
    module = k.to_wasm()
    values = k.nominal if values is None else values
    r = k(values, redo=False)
    out = run_wasm(module, values, wasm_channels(k, module.row))[:, :count]
    native = np.concatenate([np.moveaxis(a[0].reshape(count, -1), 1, 0) for a in r.arrays.values()])
    right = r.code[0] == 0
    off = np.abs(native - out[: len(native)])[:, right]
    size = np.abs(native[:, right]).max(initial=0.0)
    return (
        (off.max(initial=0.0) / size if size else 0.0),
        int((out[-1] != r.code[0]).sum()),
        native[:, right].size,
    )
