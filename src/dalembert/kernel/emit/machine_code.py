"""Machine code for this processor: LLVM text compiled in memory, called without Python's lock."""

from __future__ import annotations

import ctypes
import platform
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.kernel.memory import address

LANES = {"AVX-512": 8, "AVX2": 4, "NEON": 2, "SSE2": 2, "none": 1}
"""Numbers a vector register holds."""


@cache
def _binding() -> Any:
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm


@cache
def host_lanes() -> int:
    """Lanes of the widest registers of this processor."""
    features = _binding().get_host_cpu_features()
    for name, key in (("AVX-512", "avx512f"), ("AVX2", "avx2")):
        if features.get(key, False):
            return LANES[name]
    return LANES["NEON"] if platform.machine() in ("aarch64", "arm64") else LANES["SSE2"]


@dataclass(frozen=True)
class Machine:
    """A compiled function that evaluates ``lanes`` values side by side.

    The function takes pointers to values, path, results and status codes, then the counts of numbers, channels, designs
    and blocks. grid: values (design, numbers), path (block, channel, lane), results (design, output, position).
    pairs: values (block, numbers, lane), path (block, channel, lane), results (block, output, lane).
    """

    lanes: int
    address: int
    engine: object = field(repr=False)
    text: str = field(repr=False)

    def __call__(
        self, values: Array, path: Array, out: Array, code: Array, counts: tuple[int, int, int, int]
    ) -> None:
        self.function(address(values), address(path), address(out), address(code), *counts)

    @cached_property
    def function(self) -> Callable[..., object]:
        """The function for ctypes: four addresses, four counts."""
        return ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4, *[ctypes.c_int64] * 4)(self.address)


PASSES = ("always_inliner", "instruction_combine", "reassociate", "new_gvn", "instruction_combine")
"""LLVM passes of level 3 that affect one straight list of instructions: a third of the time, code as fast within 2 %.
"""


LEVEL = 3
"""LLVM's level of optimization for machine code: numbers differ by rounding at most, and 0 takes half the time."""


@lru_cache(16)
def compile_module(text: str, lanes: int) -> Machine:
    """Machine code of one module, cached for the latest modules. An engine takes ownership of its target machine and
    destroys it, so each engine gets a separate one."""
    llvm = _binding()
    module = llvm.parse_assembly(text)
    module.triple = llvm.get_process_triple()
    target = llvm.Target.from_triple(module.triple).create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=LEVEL,
        codemodel="jitdefault",
    )
    module.data_layout = str(target.target_data)
    module.verify()
    passes = llvm.create_new_module_pass_manager()
    for name in PASSES:
        getattr(passes, f"add_{name}_pass")()
    passes.run(module, llvm.create_pass_builder(target, llvm.create_pipeline_tuning_options(speed_level=3)))
    engine = llvm.create_mcjit_compiler(module, target)
    engine.finalize_object()
    return Machine(lanes, engine.get_function_address("run"), engine, text)


def to_blocks(array: Array, lanes: int) -> Array:
    """(count, quantity) as (block, quantity, lane); the last block padded with the last row."""
    count = len(array)
    blocks = -(-count // lanes)
    padded = array[np.minimum(np.arange(blocks * lanes), count - 1)]
    return np.ascontiguousarray(padded.reshape(blocks, lanes, -1).swapaxes(1, 2))
