"""Friction in compiled analyses: nanoseconds a position against the same mechanism without, steps, what is redone.

Method. One thread; both programs, all efforts and reactions, run in turns in one process on data in the cache; medians
of 200 calls and their ratio. Steps: Newton's, as the compiler unrolled them, the largest of the blocks. Redone: of
designs whose numbers all change at random (friction's and the loads by up to 30 %, geometry by 2 %) over 360 positions,
the share of positions and of designs that go to the general executor. The first rows are the classic engine, whole
turns between its dead centres.

    python benchmarks/kernel_friction.py [--designs 2000]
"""

from __future__ import annotations

import argparse
import resource
from statistics import median
from time import process_time
from typing import Any

import numpy as np
from benchmarks.friction import LIBRARY, engine, rough
from benchmarks.kernel import runs, timed
from tests.kernel.comparing import every_number

import dalembert as da
from dalembert.analysis.batch.tracing.symbolic_model import geometric
from dalembert.kernel import friction_trace


def steps(m: Any) -> int:
    """Newton's steps that the compiler unrolls."""
    counted: list[int] = []
    block, correction = friction_trace._newton, friction_trace.correction

    def newton(*given: Any) -> Any:
        counted.append(0)
        return block(*given)

    def counting(*given: Any) -> Any:
        counted[-1] += 1
        return correction(*given)

    friction_trace._newton, friction_trace.correction = newton, counting  # type: ignore[attr-defined]
    try:
        da.compile(m)
    finally:
        friction_trace._newton, friction_trace.correction = block, correction  # type: ignore[attr-defined]
    return max(counted)


def seconds(m: Any, repeat: int = 3) -> float:
    """Processor time of compiling: tracing and machine code."""
    found = []
    for _ in range(repeat):
        start = process_time()
        da.compile(m)
        found.append(process_time() - start)
    return median(found)


def redone(m: Any, designs: int) -> tuple[float, float]:
    """Share of positions and of designs in doubt."""
    k = da.compile(m, vary=every_number(m))
    rng = np.random.default_rng(1)
    size = np.array([0.02 if geometric(m, n) else 0.3 for n in k.numbers])
    r = k(k.nominal * (1 + size * rng.uniform(-1, 1, (designs, len(size)))), redo=False)
    doubt = r.code == 2
    return float(doubt.mean()), float(doubt.any(axis=1).mean())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--designs", type=int, default=2000)
    designs = parser.parse_args().designs
    mechanisms = {"engine": engine(360, None), "engine, guide 50 mm": engine(360, "50 mm")}
    mechanisms |= {name: rough(name, 360) for name in LIBRARY.split()}
    print(
        "                        contacts   ns a position    ratio  steps   operations    compile      redone"
    )
    print(
        "                                 without    with                without  with    ms   positions  designs"
    )
    for name, tree in mechanisms.items():
        m = da.mechanism(tree)
        smooth = m.with_values({"friction.enabled": False})
        k, plain = da.compile(m), da.compile(smooth)
        (call, count), (other, _) = runs(k), runs(plain)
        with_, without = (t * 1e9 for t in timed(call, other))
        with_, without = with_ / count, without / runs(plain)[1]
        took = seconds(m) * 1e3
        contacts = k.trace.catalogue.compiled.contacts
        positions, whole = redone(m, designs)
        count = contacts.count if contacts else 0
        print(
            f"{name:24s} {count:5d} {without:9.1f} {with_:8.1f} {with_ / without:8.2f} {steps(m):5d} "
            f"{plain.program(plain.flat).size:9d} {k.program(k.flat).size:6d} {took:6.0f} "
            f"{positions:10.1e} {whole:8.1e}"
        )
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"largest memory of the process {memory:.0f} MiB")


if __name__ == "__main__":
    main()
