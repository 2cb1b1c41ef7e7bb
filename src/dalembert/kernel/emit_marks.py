"""Marks of a program as LLVM text: which lanes do not close, are in doubt, at rest, self-locking."""

from __future__ import annotations

from typing import Any

from dalembert.kernel.graph import Node
from dalembert.kernel.program import CODES, Program


def latch(program: Program) -> str:
    """The last block of the loop over the positions."""
    return "%told" if program.marks.locked else "%loop"


def bits(t: Any, program: Program, names: dict[int, str]) -> dict[str, str]:
    """Lanes of each mark that can occur; what is seldom asked stands in a block of its own, jumped over where no lane
    asks for it."""
    marks = program.marks
    asked = (("open", marks.open, "olt"), ("doubt", marks.doubt, "ult"), ("rest", marks.rest, "olt"))
    out = {name: _any(t, nodes, names, how) for name, nodes, how in asked}
    out["locked"] = _any(t, marks.turned, names, "olt")
    if marks.locked:
        turned = out["locked"]
        t.put(f"br i1 {some(t, turned)}, label %ask, label %told")
        t.lines.append("ask:")
        from dalembert.kernel.emit_llvm import operations

        inside = dict(names)
        operations(t, program.seldom, inside)
        doubt, locked = (
            t.let(f"and {t.bit} {turned}, {_any(t, nodes, inside, how)}")
            for nodes, how in ((marks.still, "ult"), (marks.locked, "olt"))
        )
        t.put("br label %told")
        t.lines.append("told:")
        none = _none(t)
        out["locked"] = t.let(f"phi {t.bit} [ {none}, %loop ], [ {locked}, %ask ]")
        more = t.let(f"phi {t.bit} [ {none}, %loop ], [ {doubt}, %ask ]")
        out["doubt"] = t.let(f"or {t.bit} {out['doubt']}, {more}")
    return {name: out[name] for name in marks.names}


def _none(t: Any) -> str:
    return "false" if t.lanes == 1 else "zeroinitializer"


def _any(t: Any, nodes: tuple[Node, ...], names: dict[int, str], how: str) -> str:
    found = None
    for node in nodes:
        bad = t.compare(how, names[node.index], t.splat(0.0))
        found = bad if found is None else t.let(f"or {t.bit} {found}, {bad}")
    return found or _none(t)


def some(t: Any, bit: str) -> str:
    """Whether some lane has it."""
    if t.lanes == 1:
        return bit
    return str(t.let(f"call i1 @llvm.vector.reduce.or.v{t.lanes}i1({t.bit} {bit})"))


def store_code(t: Any, program: Program, names: dict[int, str], place: str) -> None:
    """Store the mark of each lane."""
    kind = "i8" if t.lanes == 1 else f"<{t.lanes} x i8>"

    def spelled(k: int) -> str:
        return str(k) if t.lanes == 1 else "<" + ", ".join([f"i8 {k}"] * t.lanes) + ">"

    code = spelled(0)
    for name, bit in reversed(bits(t, program, names).items()):
        code = t.let(f"select {t.bit} {bit}, {kind} {spelled(CODES[name])}, {kind} {code}")
    t.put(f"store {kind} {code}, ptr {place}, align 1")
