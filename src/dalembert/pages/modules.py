"""A program as WebAssembly, with the data that the page needs to call it."""

from __future__ import annotations

import base64
import zlib

from dalembert.arrays import Tree
from dalembert.kernel.emit.wasm.module import LANES, emit_wasm
from dalembert.kernel.program import Program


def module(program: Program, count: int) -> Tree:
    """Module of a program for a number of positions."""
    row = count + count % LANES
    code, heap = emit_wasm(program, row)
    names = program.graph.names
    return {
        "wasm": base64.b64encode(zlib.compress(code, 9)).decode(),
        "heap": heap,
        "row": row,
        "count": count,
        "outputs": len(program.outputs),
        "channels": [names[n.index] for n in program.inputs_in_use("channel")],
    }
