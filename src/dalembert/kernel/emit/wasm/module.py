"""A program as one module: its function ``run`` evaluates blocks of two positions, all in one memory.

``run(values, path, out, blocks)`` takes addresses in bytes of the exported ``memory``: values (number), path (channel,
row), out (output, row) with the status code of each position (``CODES``) as one more output. ``row`` is fixed when the
module is made, so that every load and store has an immediate address. Constants start at address 0; memory above the
heap's address is free. The module has no imports.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence

from dalembert.kernel.emit.wasm.elementary import FUNCTIONS
from dalembert.kernel.emit.wasm.instructions import (
    ABS,
    ADD,
    ADD_INTEGERS,
    AND,
    AND_NOT,
    ANY_TRUE,
    AT_LEAST,
    DIV,
    END,
    GREATER,
    IF,
    LESS,
    LOOP,
    MUL,
    NEAREST,
    NEG,
    NOT,
    OR,
    PMAX,
    PMIN,
    REPEAT_IF,
    SQRT,
    SUB,
    SUB_INTEGERS,
    Constants,
    Function,
    call,
    get,
    integer,
    load,
    load_both,
    put,
    section,
    store,
    text,
    unsigned,
)
from dalembert.kernel.graph import Node
from dalembert.kernel.program import CODES, Program

LANES = 2

ONE: dict[str, Callable[[Function, bytes], bytes]] = {
    "neg": lambda f, a: a + NEG,
    "abs": lambda f, a: a + ABS,
    "sqrt": lambda f, a: a + SQRT,
    "rint": lambda f, a: a + NEAREST,
    "inv": lambda f, a: f.number(1.0) + a + DIV,
    "rsqrt": lambda f, a: f.number(1.0) + a + SQRT + DIV,
    "detach": lambda f, a: a,
    "positive": lambda f, a: a + f.number(0.0) + GREATER + f.number(1.0) + AND,
}
"""Operations of one argument, each used once."""
TWO: dict[str, Callable[[bytes, bytes], bytes]] = {
    "add": lambda a, b: a + b + ADD,
    "sub": lambda a, b: a + b + SUB,
    "mul": lambda a, b: a + b + MUL,
    "max": lambda a, b: b + a + PMAX,
    "min": lambda a, b: b + a + PMIN,
}
"""Operations of two arguments."""


class Module:
    """One program being written: ``values`` holds the code of each node by its index."""

    def __init__(self, program: Program, row: int) -> None:
        self.program, self.row = program, row
        self.constants = Constants()
        used = {n.op for n in program.order}
        self.functions = {op: k + 1 for k, op in enumerate(op for op in FUNCTIONS if op in used)}
        self.run = Function(4, self.constants)
        self.values = {n.index: self.run.number(n.value) for n in program.constants}
        self.kept = self._kept()

    def _kept(self) -> set[int]:
        """Nodes that need a local: used more than once, or in another part of the code than where they are computed."""
        p = self.program
        parts = {n.index: k for k, part in enumerate((p.design, p.position, p.seldom, p.rare)) for n in part}
        uses = Counter(x.index for n in p.order for x in (n.a, n.b) if x is not None)
        wanted = {n.index for n in (*p.outputs, *p.flags.always)}
        uses.update(n.index for n in (*p.outputs, *p.flags.always, *p.flags.seldom, *p.flags.jam))
        kept = {index for index, count in uses.items() if count > 1}
        for n in p.order:
            kept |= {
                x.index for x in (n.a, n.b) if x is not None and parts.get(x.index) != parts.get(n.index)
            }
        return kept | {n.index for n in p.design if n.index in wanted}

    def compute(self, nodes: Iterable[Node]) -> None:
        """Code of operations."""
        f = self.run
        for n in nodes:
            assert n.a is not None
            a, b = self.values[n.a.index], b"" if n.b is None else self.values[n.b.index]
            if n.op in self.functions:
                value = a + b + call(self.functions[n.op])
            else:
                value = TWO[n.op](a, b) if n.op in TWO else ONE[n.op](f, a)
            self.values[n.index] = f.keep(value) if n.index in self.kept else value

    def below(self, nodes: Sequence[Node], numbers: bool = True) -> bytes:
        """Lanes where some node is negative, or (``numbers`` False) NaN."""
        zero = self.run.number(0.0)
        tests = [self.values[n.index] + zero + (LESS if numbers else AT_LEAST + NOT) for n in nodes]
        return b"".join(tests) + OR * (len(tests) - 1) if tests else zero

    def flags(self) -> bytes:
        """The status code of each lane."""
        f, m = self.run, self.program.flags
        lanes = {"open": self.below(m.open), "rest": f.keep(self.below(m.rest))}
        lanes["contact"] = self.below(m.contact)
        lanes |= {"outside": self.below(m.outside), "slope": self.below(m.slope, False)}
        slips, locked = self.below(m.slips, False), f.keep(self.below(m.turned))
        if m.seldom:
            slips, lanes["jam"], locked = self._seldom(f.keep(slips), locked, lanes["rest"])
        for certain in ("rest", "jam"):
            if getattr(m, certain) and certain in lanes:
                slips = slips + lanes[certain] + AND_NOT
        lanes.setdefault("jam", f.number(0.0))
        lanes |= {"doubt": self.below(m.doubt, False) + slips + OR, "locked": locked}
        code = f.number(0.0)
        for name in reversed(m.names):
            code = f.choose(lanes[name], f.number(float(CODES[name])), code)
        return code

    def _seldom(self, slips: bytes, turned: bytes, rest: bytes) -> tuple[bytes, bytes, bytes]:
        """Lanes in doubt, jammed and self-locking; rarely needed flags are skipped where no lane needs them."""
        f, m = self.run, self.program.flags
        unsure = f.keep(self.below(m.unsure, False))
        asking = unsure + turned + OR if m.locked else unsure
        jam, more = f.keep(f.number(0.0)), f.keep(f.number(0.0))
        locked = f.keep(f.number(0.0)) if m.locked else turned
        f.put(asking, *((rest, AND_NOT) if m.rest else ()), ANY_TRUE, IF)
        self.compute(self.program.seldom)
        single = f.keep(unsure + self.below(m.sure, False) + AND)
        f.change(more, single + turned + self.below(m.still, False) + AND + OR)
        if m.locked:
            f.change(locked, turned + self.below(m.locked) + AND)
        f.put(single, ANY_TRUE, IF)
        self.compute(self.program.rare)
        f.change(jam, single + self.below(m.jam) + AND)
        f.put(END, END)
        return slips + more + OR, jam, locked

    def loop(self) -> bytes:
        """The function over all blocks of positions."""
        f, p = self.run, self.program
        values, path, out, blocks = range(4)
        for n in p.inputs:
            if n.op == "number":
                self.values[n.index] = f.keep(get(values) + load_both(8 * p.places[n.index]))
        self.compute(p.design)
        f.put(LOOP)
        for n in p.inputs:
            if n.op == "channel":
                self.values[n.index] = f.keep(get(path) + load(8 * self.row * p.places[n.index]))
        self.compute(p.position)
        for k, n in enumerate(p.outputs):
            f.put(get(out), self.values[n.index], store(8 * self.row * k))
        flags = self.flags()
        f.put(get(out), flags, store(8 * self.row * len(p.outputs)))
        for at in (path, out):
            f.put(get(at), integer(8 * LANES), ADD_INTEGERS, put(at))
        f.put(get(blocks), integer(1), SUB_INTEGERS, b"\x22", unsigned(blocks), REPEAT_IF, END)
        return f.definition()

    def assemble(self) -> tuple[bytes, int]:
        """The module and the first free address of its memory."""
        codes, kinds = [self.loop()], [0]
        for op in self.functions:
            arguments = 2 if op == "atan2" else 1
            f = Function(arguments, self.constants)
            f.put(FUNCTIONS[op](f, *(get(k) for k in range(arguments))))
            codes.append(f.definition())
            kinds.append(arguments)
        types = (b"\x60\x04\x7f\x7f\x7f\x7f\x00", b"\x60\x01\x7b\x01\x7b", b"\x60\x02\x7b\x7b\x01\x7b")
        data = b"".join(self.constants.places)
        parts = (
            section(1, *types),
            section(3, *(unsigned(k) for k in kinds)),
            section(5, b"\x00" + unsigned(1 + len(data) // 65536)),
            section(7, text("run") + b"\x00\x00", text("memory") + b"\x02\x00"),
            section(10, *codes),
            section(11, b"\x00\x41\x00\x0b" + unsigned(len(data)) + data),
        )
        return b"\0asm\1\0\0\0" + b"".join(parts), -(-len(data) // 64) * 64


def emit_wasm(program: Program, row: int) -> tuple[bytes, int]:
    """The module of a program without common inputs, for rows of ``row`` numbers (even), and the address of its
    heap."""
    if row % LANES or row <= 0:
        raise ValueError(f"a row of {row} numbers is not a multiple of {LANES}")
    return Module(program, row).assemble()
