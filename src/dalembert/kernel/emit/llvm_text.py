"""A program as LLVM text: one vector instruction each, several positions (or designs) side by side.

Two forms. ``grid``: lanes are neighbouring positions of one design, values that do not change with the position are
computed before the loop. ``pairs``: lanes are unrelated (design, position) pairs.
"""

from __future__ import annotations

from dalembert.kernel.emit.elementary_functions import elementary
from dalembert.kernel.emit.llvm_builder import ModuleText, operations
from dalembert.kernel.emit.marks import latch, store_code
from dalembert.kernel.emit.reductions import Reductions, Slots
from dalembert.kernel.graph import POSITION
from dalembert.kernel.program import Program

WIDE = '"min-legal-vector-width"="512" "prefer-vector-width"="512" alignstack(64) "stackrealign"'
"""Attribute for full registers on processors where LLVM would use only half of them."""


def head(t: ModuleText, program: Program) -> dict[int, str]:
    """Constants by node."""
    return {n.index: t.splat(n.value) for n in program.constants}


def _design(t: ModuleText, program: Program, names: dict[int, str], reductions: Reductions | None) -> None:
    """Everything up to the loop over the positions: one iteration per design, with the values common to its
    positions."""
    lanes = t.lanes
    t.lines.append(
        "define void @run(ptr noalias readonly %values, ptr noalias readonly %path, ptr noalias %out, "
        "ptr noalias %code, i64 %numbers, i64 %channels, i64 %designs, i64 %blocks) " + WIDE + " {"
    )
    t.lines.append("entry:")
    t.put("%odd = or i64 %blocks, 1")  # rows an odd number of vectors apart share no cache sets
    t.put(f"%row = mul i64 %odd, {lanes}")
    t.put(f"%line = mul i64 %channels, {lanes}")
    t.put("%tail = mul i64 %blocks, %line")
    t.put("%common = getelementptr inbounds double, ptr %path, i64 %tail")
    if reductions:
        t.put(f"%sheet = add i64 {reductions.width}, 0")
    else:
        t.put(f"%sheet = mul i64 %row, {len(program.outputs)}")
    t.put("br label %design")
    t.lines.append("design:")
    t.put("%d = phi i64 [ 0, %entry ], [ %dnext, %done ]")
    t.put("%dv = mul i64 %d, %numbers")
    t.put("%mine = getelementptr inbounds double, ptr %values, i64 %dv")
    for n in program.inputs:
        if not n.level & POSITION:
            base = "%mine" if n.op == "number" else "%common"
            names[n.index] = t.broadcast(t.load(base, program.places[n.index], vector=False))
    operations(t, program.design, names)
    t.put("%ds = mul i64 %d, %sheet")
    t.put("%page = getelementptr inbounds double, ptr %out, i64 %ds")
    t.put("%dc = mul i64 %d, %row")
    t.put("%marks = getelementptr inbounds i8, ptr %code, i64 %dc")
    t.put("br label %start")
    t.lines += ["start:", "  br label %loop", "loop:"]


def grid(program: Program, lanes: int, reduce: Slots = (), past_cache: bool = False) -> str:
    """Function over designs and blocks of positions: see ``Machine``. ``past_cache``: results bypass the cache; large
    ones then take half the time, as memory is not read before it is overwritten."""
    t = ModuleText(lanes)
    names = head(t, program)
    channels = [n for n in program.inputs if n.level & POSITION]
    reductions = Reductions(t, program, reduce) if reduce else None
    _design(t, program, names, reductions)
    t.put(f"%b = phi i64 [ 0, %start ], [ %bnext, {latch(program)} ]")
    if reductions:
        reductions.phis()
    t.put("%bl = mul i64 %b, %line")
    t.put("%here = getelementptr inbounds double, ptr %path, i64 %bl")
    t.put(f"%at = mul i64 %b, {lanes}")
    for n in channels:
        names[n.index] = t.load("%here", program.places[n.index] * lanes)
    operations(t, program.position, names)
    if reductions:
        reductions.update(names)
    else:
        for k, node in enumerate(program.outputs):
            offset = t.let(f"mul i64 %row, {k}")
            t.store(names[node.index], "%page", t.let(f"add i64 {offset}, %at"), past_cache)
        store_code(t, program, names, t.let("getelementptr inbounds i8, ptr %marks, i64 %at"))
    t.put("%bnext = add nuw i64 %b, 1")
    t.put("%more = icmp ult i64 %bnext, %blocks")
    t.put("br i1 %more, label %loop, label %done")
    t.lines.append("done:")
    if reductions:
        reductions.store()
    t.put("%dnext = add nuw i64 %d, 1")
    t.put("%again = icmp ult i64 %dnext, %designs")
    t.put("br i1 %again, label %design, label %exit")
    t.lines += [
        "exit:",
        *["  fence seq_cst"] * past_cache,
        "  ret void",
        "}",
        *["!0 = !{i32 1}"] * past_cache,
    ]
    return module(t, program, reductions.declarations() if reductions else [])


def pairs(program: Program, lanes: int) -> str:
    """Function over blocks of (design, position) pairs: see ``Machine``."""
    t = ModuleText(lanes)
    names = head(t, program)
    t.lines.append(
        "define void @run(ptr noalias readonly %values, ptr noalias readonly %path, ptr noalias %out, "
        "ptr noalias %code, i64 %numbers, i64 %channels, i64 %designs, i64 %blocks) " + WIDE + " {"
    )
    t.lines.append("entry:")
    t.put(f"%row = mul i64 %numbers, {lanes}")
    t.put(f"%line = mul i64 %channels, {lanes}")
    t.put("%tail = mul i64 %blocks, %line")
    t.put("%common = getelementptr inbounds double, ptr %path, i64 %tail")
    t.put("br label %loop")
    t.lines.append("loop:")
    t.put(f"%b = phi i64 [ 0, %entry ], [ %bnext, {latch(program)} ]")
    t.put("%bv = mul i64 %b, %row")
    t.put("%mine = getelementptr inbounds double, ptr %values, i64 %bv")
    t.put("%bl = mul i64 %b, %line")
    t.put("%here = getelementptr inbounds double, ptr %path, i64 %bl")
    for n in program.inputs:
        if n.op == "common":
            names[n.index] = t.broadcast(t.load("%common", program.places[n.index], vector=False))
        else:
            names[n.index] = t.load(
                "%here" if n.op == "channel" else "%mine", program.places[n.index] * lanes
            )
    operations(t, program.design, names)
    operations(t, program.position, names)
    t.put(f"%bo = mul i64 %b, {len(program.outputs) * lanes}")
    t.put("%page = getelementptr inbounds double, ptr %out, i64 %bo")
    for k, node in enumerate(program.outputs):
        t.store(names[node.index], "%page", k * lanes)
    t.put(f"%bc = mul i64 %b, {lanes}")
    store_code(t, program, names, t.let("getelementptr inbounds i8, ptr %code, i64 %bc"))
    t.put("%bnext = add nuw i64 %b, 1")
    t.put("%more = icmp ult i64 %bnext, %blocks")
    t.put("br i1 %more, label %loop, label %exit")
    t.lines += ["exit:", "  ret void", "}"]
    return module(t, program)


def module(t: ModuleText, program: Program, declared: list[str] | None = None) -> str:
    """The function with the elementary functions it calls."""
    used = {n.op for n in program.order}
    needed = {"sqrt": 1, "fabs": 1, "rint": 1, "fma": 3, "copysign": 2}
    declared = [*(declared or []), *(t.declare(*one) for one in needed.items())]
    if t.lanes > 1:
        declared.append(f"declare i1 @llvm.vector.reduce.or.v{t.lanes}i1({t.bit})")
    return "\n".join([*declared, *elementary(t.lanes, used), *t.lines]) + "\n"
