"""Flags of a program as LLVM text: lanes that do not close, are in doubt, at rest, or self-locking."""

from __future__ import annotations

from dalembert.kernel.emit.llvm_builder import ModuleText, operations
from dalembert.kernel.graph import Node
from dalembert.kernel.program import CODES, Program


def latch(program: Program) -> str:
    """The last block of the loop over the positions."""
    return "%settled" if program.flags.seldom else "%loop"


def bits(t: ModuleText, program: Program, names: dict[int, str]) -> dict[str, str]:
    """Lane masks of each flag that can occur."""
    flags = program.flags
    tests = (
        ("open", flags.open, "olt"),
        ("doubt", flags.doubt, "ult"),
        ("rest", flags.rest, "olt"),
        ("contact", flags.contact, "olt"),
        ("outside", flags.outside, "olt"),
        ("slope", flags.slope, "ult"),
    )
    out = {name: _any(t, nodes, names, how) for name, nodes, how in tests}
    out["locked"] = _any(t, flags.turned, names, "olt")
    slips = _any(t, flags.slips, names, "ult")
    if flags.seldom:
        slips, out["jam"], out["locked"] = _seldom(t, program, names, slips, out["locked"], out["rest"])
    for certain in ("rest", "jam"):
        if getattr(flags, certain):
            slips = _but(t, slips, out[certain])
    if flags.slips or flags.seldom:
        out["doubt"] = t.let(f"or {t.bit} {out['doubt']}, {slips}")
    return {name: out[name] for name in flags.names}


def _but(t: ModuleText, a: str, b: str) -> str:
    """Lanes of a without those of b."""
    every = "true" if t.lanes == 1 else "<" + ", ".join(["i1 true"] * t.lanes) + ">"
    return t.let(f"and {t.bit} {a}, {t.let(f'xor {t.bit} {b}, {every}')}")


def _seldom(
    t: ModuleText, program: Program, names: dict[int, str], slips: str, turned: str, rest: str
) -> tuple[str, str, str]:
    """Lanes in doubt, jammed and self-locking. Rarely needed flags are in a separate block, skipped where no lane needs
    them (no lane at rest does); the proof of a jam is in another block behind it."""
    flags, none = program.flags, _none(t)
    unsure = _any(t, flags.unsure, names, "ult")
    asking = t.let(f"or {t.bit} {unsure}, {turned if flags.locked else none}")
    asks = some(t, _but(t, asking, rest))
    t.put(f"br i1 {asks}, label %ask, label %settled")
    t.lines.append("ask:")
    inside = dict(names)
    operations(t, program.seldom, inside)
    single = t.let(f"and {t.bit} {unsure}, {_any(t, flags.sure, inside, 'ult')}")
    still = t.let(f"and {t.bit} {turned}, {_any(t, flags.still, inside, 'ult')}")
    locked = turned
    if flags.locked:
        locked = t.let(f"and {t.bit} {turned}, {_any(t, flags.locked, inside, 'olt')}")
    more = t.let(f"or {t.bit} {single}, {still}")
    t.put(f"br i1 {some(t, single)}, label %prove, label %settled")
    t.lines.append("prove:")
    operations(t, program.rare, inside)
    jam = t.let(f"and {t.bit} {single}, {_any(t, flags.jam, inside, 'olt')}")
    t.put("br label %settled")
    t.lines.append("settled:")
    before = none if flags.locked else turned

    def joined(loop: str, ask: str, prove: str) -> str:
        return t.let(f"phi {t.bit} [ {loop}, %loop ], [ {ask}, %ask ], [ {prove}, %prove ]")

    locking, more, jam = joined(before, locked, locked), joined(none, more, more), joined(none, none, jam)
    return t.let(f"or {t.bit} {slips}, {more}"), jam, locking


def _none(t: ModuleText) -> str:
    return "false" if t.lanes == 1 else "zeroinitializer"


def _any(t: ModuleText, nodes: tuple[Node, ...], names: dict[int, str], how: str) -> str:
    result = None
    for node in nodes:
        bad = t.compare(how, names[node.index], t.splat(0.0))
        result = bad if result is None else t.let(f"or {t.bit} {result}, {bad}")
    return result or _none(t)


def some(t: ModuleText, bit: str) -> str:
    """True if any lane has the bit."""
    if t.lanes == 1:
        return bit
    return t.let(f"call i1 @llvm.vector.reduce.or.v{t.lanes}i1({t.bit} {bit})")


def store_code(t: ModuleText, program: Program, names: dict[int, str], place: str) -> None:
    """Stores the status code of each lane."""
    kind = "i8" if t.lanes == 1 else f"<{t.lanes} x i8>"

    def spelled(k: int) -> str:
        return str(k) if t.lanes == 1 else "<" + ", ".join([f"i8 {k}"] * t.lanes) + ">"

    code = spelled(0)
    for name, bit in reversed(bits(t, program, names).items()):
        code = t.let(f"select {t.bit} {bit}, {kind} {spelled(CODES[name])}, {kind} {code}")
    t.put(f"store {kind} {code}, ptr {place}, align 1")
