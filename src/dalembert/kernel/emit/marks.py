"""Flags of a program as LLVM text: lanes that do not close, are in doubt, at rest, or self-locking."""

from __future__ import annotations

from dalembert.kernel.emit.llvm_builder import Text, operations
from dalembert.kernel.graph import Node
from dalembert.kernel.program import CODES, Program


def latch(program: Program) -> str:
    """The last block of the loop over the positions."""
    return "%settled" if program.marks.seldom else "%loop"


def bits(t: Text, program: Program, names: dict[int, str]) -> dict[str, str]:
    """Lane masks of each flag that can occur."""
    marks = program.marks
    asked = (
        ("open", marks.open, "olt"),
        ("doubt", marks.doubt, "ult"),
        ("rest", marks.rest, "olt"),
        ("outside", marks.outside, "olt"),
        ("slope", marks.slope, "ult"),
    )
    out = {name: _any(t, nodes, names, how) for name, nodes, how in asked}
    out["locked"] = _any(t, marks.turned, names, "olt")
    slips = _any(t, marks.slips, names, "ult")
    if marks.seldom:
        slips, out["jam"], out["locked"] = _seldom(t, program, names, slips, out["locked"], out["rest"])
    for certain in ("rest", "jam"):
        if getattr(marks, certain):
            slips = _but(t, slips, out[certain])
    if marks.slips or marks.seldom:
        out["doubt"] = t.let(f"or {t.bit} {out['doubt']}, {slips}")
    return {name: out[name] for name in marks.names}


def _but(t: Text, a: str, b: str) -> str:
    """Lanes of a without those of b."""
    every = "true" if t.lanes == 1 else "<" + ", ".join(["i1 true"] * t.lanes) + ">"
    return t.let(f"and {t.bit} {a}, {t.let(f'xor {t.bit} {b}, {every}')}")


def _seldom(
    t: Text, program: Program, names: dict[int, str], slips: str, turned: str, rest: str
) -> tuple[str, str, str]:
    """Lanes in doubt, jammed and self-locking. Rarely needed flags are in a separate block, skipped where no lane needs
    them (no lane at rest does); the proof of a jam is in another block behind it."""
    marks, none = program.marks, _none(t)
    unsure = _any(t, marks.unsure, names, "ult")
    asking = t.let(f"or {t.bit} {unsure}, {turned if marks.locked else none}")
    asks = some(t, _but(t, asking, rest) if marks.rest else asking)
    t.put(f"br i1 {asks}, label %ask, label %settled")
    t.lines.append("ask:")
    inside = dict(names)
    operations(t, program.seldom, inside)
    single = t.let(f"and {t.bit} {unsure}, {_any(t, marks.sure, inside, 'ult')}")
    still = t.let(f"and {t.bit} {turned}, {_any(t, marks.still, inside, 'ult')}")
    locked = turned
    if marks.locked:
        locked = t.let(f"and {t.bit} {turned}, {_any(t, marks.locked, inside, 'olt')}")
    more = t.let(f"or {t.bit} {single}, {still}")
    t.put(f"br i1 {some(t, single)}, label %prove, label %settled")
    t.lines.append("prove:")
    operations(t, program.rare, inside)
    jam = t.let(f"and {t.bit} {single}, {_any(t, marks.jam, inside, 'olt')}")
    t.put("br label %settled")
    t.lines.append("settled:")
    before = none if marks.locked else turned

    def joined(loop: str, ask: str, prove: str) -> str:
        return t.let(f"phi {t.bit} [ {loop}, %loop ], [ {ask}, %ask ], [ {prove}, %prove ]")

    found, more, jam = joined(before, locked, locked), joined(none, more, more), joined(none, none, jam)
    return t.let(f"or {t.bit} {slips}, {more}"), jam, found


def _none(t: Text) -> str:
    return "false" if t.lanes == 1 else "zeroinitializer"


def _any(t: Text, nodes: tuple[Node, ...], names: dict[int, str], how: str) -> str:
    found = None
    for node in nodes:
        bad = t.compare(how, names[node.index], t.splat(0.0))
        found = bad if found is None else t.let(f"or {t.bit} {found}, {bad}")
    return found or _none(t)


def some(t: Text, bit: str) -> str:
    """True if any lane has the bit."""
    if t.lanes == 1:
        return bit
    return t.let(f"call i1 @llvm.vector.reduce.or.v{t.lanes}i1({t.bit} {bit})")


def store_code(t: Text, program: Program, names: dict[int, str], place: str) -> None:
    """Stores the status code of each lane."""
    kind = "i8" if t.lanes == 1 else f"<{t.lanes} x i8>"

    def spelled(k: int) -> str:
        return str(k) if t.lanes == 1 else "<" + ", ".join([f"i8 {k}"] * t.lanes) + ">"

    code = spelled(0)
    for name, bit in reversed(bits(t, program, names).items()):
        code = t.let(f"select {t.bit} {bit}, {kind} {spelled(CODES[name])}, {kind} {code}")
    t.put(f"store {kind} {code}, ptr {place}, align 1")
