"""Reductions over the positions inside the kernel: one number per design instead of one per position."""

from __future__ import annotations

import sys

from dalembert.kernel.emit.llvm_builder import ModuleText, number
from dalembert.kernel.emit.marks import bits, latch, some
from dalembert.kernel.program import CODES, Program

PLACED = ("argpeak", "argmin", "argmax")
"""Reductions with the position, which is a second number: of equal values, whatever their rounding, the first."""

TIE = 1e-12
"""Share of a value within which another is equal: rounding, and less than a curve falls beside its peak in one step of
a million."""

SUMS = {"sum": 0, "square": 1, "power8": 3}
"""Sums of the values to the powers 1, 2, 8: number of squarings for each."""

_START = {"min": float("inf"), "max": float("-inf"), "peak": -1.0}
FARTHEST = {"min": sys.float_info.max, "max": -sys.float_info.max, "peak": -1.0}
"""The extreme before the first position; the value at the place that is kept, which is subtracted, is finite."""

Slots = tuple[tuple[int, str], ...]
"""Output index and reduction of each slot: peak, min, max, with arg before them, or a sum."""


def width(slots: Slots) -> int:
    """Numbers stored per design."""
    return sum(2 if p in PLACED else 1 for _, p in slots)


class Reductions:
    """Accumulators of every output, one vector each, and of the status codes; combined across the lanes at the end."""

    def __init__(self, t: ModuleText, program: Program, slots: Slots) -> None:
        self.t, self.program, self.slots = t, program, slots
        self.weighted = any(p in SUMS for _, p in slots)
        self.width = width(slots)

    def phis(self) -> None:
        t = self.t
        for s, (_, p) in enumerate(self.slots):
            start = t.splat(_START.get(p.removeprefix("arg"), 0.0))
            t.put(f"%acc{s} = phi {t.kind} [ {start}, %start ], [ %new{s}, {latch(self.program)} ]")
            for name, first in (("held", FARTHEST[p[3:]]), ("place", 0.0)) if p in PLACED else ():
                new = f"[ %new{name}{s}, {latch(self.program)} ]"
                t.put(f"%{name}{s} = phi {t.kind} [ {t.splat(first)}, %start ], {new}")
        none = "false" if t.lanes == 1 else "zeroinitializer"
        for name in self.program.flags.names:
            t.put(f"%any{name} = phi {t.bit} [ {none}, %start ], [ %new{name}, {latch(self.program)} ]")

    def update(self, names: dict[int, str]) -> None:
        t = self.t
        weight = None
        if self.weighted:
            last = t.let("sub i64 %channels, 1")
            weight = t.load("%here", t.let(f"mul i64 {last}, {t.lanes}"))
        for s, (k, p) in enumerate(self.slots):
            self._one(s, p, names[self.program.outputs[k].index], weight)
        for name, value in bits(t, self.program, names).items():
            t.put(f"%new{name} = or {t.bit} %any{name}, {value}")

    def _one(self, s: int, p: str, x: str, weight: str | None) -> None:
        t, acc = self.t, f"%acc{s}"
        if p in SUMS:
            for _ in range(SUMS[p]):
                x = t.binary("fmul", x, x)
            assert weight is not None
            term = t.binary("fmul", x, weight)
            t.put(f"%new{s} = fadd reassoc nsz contract {t.kind} {acc}, {term}")
            return
        if p.endswith("peak"):
            x = t.intrinsic("fabs", x)
        test = t.compare("olt" if p.endswith("min") else "ogt", x, acc)
        t.put(f"%new{s} = select {t.bit} {test}, {t.kind} {x}, {t.kind} {acc}")
        if p in PLACED:
            test = self.beyond("ogt", p, x, f"%held{s}")
            for name, value in (("held", x), ("place", self.place())):
                t.put(f"%new{name}{s} = select {t.bit} {test}, {t.kind} {value}, {t.kind} %{name}{s}")

    def place(self) -> str:
        """Number of the position in each lane."""
        t = self.t
        if t.lanes == 1:
            return t.let("uitofp i64 %at to double")
        iota = "<" + ", ".join(f"double {number(float(k))}" for k in range(t.lanes)) + ">"
        base = t.broadcast(t.let("uitofp i64 %at to double"))
        return t.let(f"fadd {t.kind} {base}, {iota}")

    def store(self) -> None:
        t, slot = self.t, 0
        for s, (_, p) in enumerate(self.slots):
            how = "fadd" if p in SUMS else "fmin" if p.endswith("min") else "fmax"
            value = self.across(f"%new{s}", how)
            t.put(f"store double {value}, ptr {self.address(slot)}, align 8")
            slot += 1
            if p in PLACED:
                value = self.first(p, f"%newheld{s}", f"%newplace{s}", value)
                t.put(f"store double {value}, ptr {self.address(slot)}, align 8")
                slot += 1
        one = self.mark()
        place = t.let("getelementptr inbounds i8, ptr %code, i64 %d")
        t.put(f"store i8 {one}, ptr {place}, align 1")

    def address(self, slot: int) -> str:
        return self.t.let(f"getelementptr inbounds double, ptr %page, i64 {slot}")

    def across(self, x: str, how: str) -> str:
        """One number from all lanes."""
        t = self.t
        if t.lanes == 1:
            return x
        start = "double -0.0, " if how == "fadd" else ""
        return t.let(f"call reassoc nsz double @llvm.vector.reduce.{how}.{t.suffix}({start}{t.kind} {x})")

    def beyond(self, how: str, p: str, x: str, held: str) -> str:
        """Test that a value is an extreme beside another by more than rounding ("ogt"), or is not ("ule")."""
        t = self.t
        more = t.exact("fsub", *((held, x) if p.endswith("min") else (x, held)))
        return t.compare(how, more, t.exact("fmul", t.intrinsic("fabs", held), t.splat(TIE)))

    def first(self, p: str, held: str, place: str, extreme: str) -> str:
        """The first position at which the extreme occurs."""
        t = self.t
        if t.lanes == 1:
            return place
        test = self.beyond("ule", p, t.broadcast(extreme), held)
        return self.across(t.select(test, place, t.splat(1e300)), "fmin")

    def mark(self) -> str:
        """The first status code that is not 0."""
        t, code = self.t, "0"
        for name in reversed(self.program.flags.names):
            code = t.let(f"select i1 {some(t, f'%new{name}')}, i8 {CODES[name]}, i8 {code}")
        return code

    def declarations(self) -> list[str]:
        t = self.t
        if t.lanes == 1:
            return []
        out = [f"declare double @llvm.vector.reduce.{how}.{t.suffix}({t.kind})" for how in ("fmin", "fmax")]
        return [*out, f"declare double @llvm.vector.reduce.fadd.{t.suffix}(double, {t.kind})"]
