"""LLVM text line by line: values, vectors, operations of a trace.

A ``Text`` writes one module; its lanes are the elements of a vector.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence

from dalembert.kernel.graph import Node

FAST = "reassoc nsz arcp contract"
"""Fast-math flags: NaN stays NaN, infinity infinity."""


def number(x: float) -> str:
    """A constant in LLVM's hexadecimal form."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', x))[0]:016X}"


class ModuleText:
    """Lines of one module, with the vector type and constants spelled out."""

    def __init__(self, lanes: int) -> None:
        self.lanes, self.lines = lanes, []
        self.kind = "double" if lanes == 1 else f"<{lanes} x double>"
        self.bit = "i1" if lanes == 1 else f"<{lanes} x i1>"
        self.whole = "i64" if lanes == 1 else f"<{lanes} x i64>"
        self.suffix = "f64" if lanes == 1 else f"v{lanes}f64"
        self.count = 0

    lines: list[str]

    def put(self, line: str) -> None:
        self.lines.append("  " + line)

    def let(self, expression: str) -> str:
        """A new value."""
        self.count += 1
        name = f"%t{self.count}"
        self.put(f"{name} = {expression}")
        return name

    def splat(self, x: float) -> str:
        if self.lanes == 1:
            return number(x)
        return "<" + ", ".join([f"double {number(x)}"] * self.lanes) + ">"

    def broadcast(self, scalar: str, of: str = "double") -> str:
        """A scalar in every lane."""
        if self.lanes == 1:
            return scalar
        kind, zeros = f"<{self.lanes} x {of}>", f"<{self.lanes} x i32> zeroinitializer"
        one = self.let(f"insertelement {kind} poison, {of} {scalar}, i32 0")
        return self.let(f"shufflevector {kind} {one}, {kind} poison, {zeros}")

    def load(self, base: str, offset: int | str, vector: bool = True) -> str:
        place = self.let(f"getelementptr inbounds double, ptr {base}, i64 {offset}")
        return self.let(f"load {self.kind if vector else 'double'}, ptr {place}, align 8")

    def store(self, value: str, base: str, offset: int | str, past_cache: bool = False) -> None:
        place = self.let(f"getelementptr inbounds double, ptr {base}, i64 {offset}")
        how = f"align {min(8 * self.lanes, 64)}, !nontemporal !0" if past_cache else "align 8"
        self.put(f"store {self.kind} {value}, ptr {place}, {how}")

    def operation(self, node: Node, a: str, b: str | None) -> str:
        return _OPERATIONS[node.op](self, a, b or "")

    def binary(self, op: str, a: str, b: str) -> str:
        return self.let(f"{op} {FAST} {self.kind} {a}, {b}")

    def exact(self, op: str, a: str, b: str) -> str:
        """An operation rounded as written, whatever its neighbours."""
        return self.let(f"{op} {self.kind} {a}, {b}")

    def fma(self, a: str, b: str, c: str) -> str:
        return self.intrinsic("fma", a, b, c)

    def horner(self, coefficients: Sequence[float], z: str) -> str:
        """A polynomial, its highest power first."""
        total = self.splat(coefficients[0])
        for c in coefficients[1:]:
            total = self.fma(total, z, self.splat(c))
        return total

    def integer(self, op: str, a: str, b: str | int) -> str:
        """An operation on 64-bit integers, one of which may be the same in every lane."""
        if isinstance(b, int):
            b = str(b) if self.lanes == 1 else "<" + ", ".join([f"i64 {b}"] * self.lanes) + ">"
        return self.let(f"{op} {self.whole} {a}, {b}")

    def call(self, name: str, *arguments: str) -> str:
        typed = ", ".join(f"{self.kind} {a}" for a in arguments)
        return self.let(f"call {self.kind} @{name}({typed})")

    def intrinsic(self, name: str, *arguments: str) -> str:
        return self.call(f"llvm.{name}.{self.suffix}", *arguments)

    def declare(self, name: str, arguments: int = 1) -> str:
        """Declaration of an intrinsic."""
        return f"declare {self.kind} @llvm.{name}.{self.suffix}({', '.join([self.kind] * arguments)})"

    def select(self, test: str, a: str, b: str) -> str:
        return self.let(f"select {self.bit} {test}, {self.kind} {a}, {self.kind} {b}")

    def compare(self, how: str, a: str, b: str) -> str:
        return self.let(f"fcmp {how} {self.kind} {a}, {b}")


def _sign(t: ModuleText, a: str, _: str) -> str:
    one = t.intrinsic("copysign", t.splat(1.0), a)
    return t.select(t.compare("oeq", a, t.splat(0.0)), t.splat(0.0), one)


_OPERATIONS: dict[str, Callable[[ModuleText, str, str], str]] = {
    "add": lambda t, a, b: t.binary("fadd", a, b),
    "sub": lambda t, a, b: t.binary("fsub", a, b),
    "mul": lambda t, a, b: t.binary("fmul", a, b),
    "inv": lambda t, a, b: t.call("reciprocal", a),
    "rsqrt": lambda t, a, b: t.call("inverse_root", a),
    "neg": lambda t, a, b: t.let(f"fneg {t.kind} {a}"),
    "sqrt": lambda t, a, b: t.intrinsic("sqrt", a),
    "abs": lambda t, a, b: t.intrinsic("fabs", a),
    "rint": lambda t, a, b: t.intrinsic("rint", a),
    "sign": _sign,
    "positive": lambda t, a, b: t.select(t.compare("ogt", a, t.splat(0.0)), t.splat(1.0), t.splat(0.0)),
    "sin": lambda t, a, b: t.call("sine", a),
    "cos": lambda t, a, b: t.call("cosine", a),
    "tan": lambda t, a, b: t.exact("fdiv", t.call("sine", a), t.call("cosine", a)),
    "exp": lambda t, a, b: t.call("exponential", a),
    "atan2": lambda t, a, b: t.call("angle", a, b),
    "max": lambda t, a, b: t.select(t.compare("ogt", a, b), a, b),
    "detach": lambda t, a, b: a,
}


def operations(t: ModuleText, nodes: list[Node], names: dict[int, str]) -> None:
    """Emits nodes in order; ``names`` holds the value of each by its index."""
    for node in nodes:
        assert node.a is not None
        b = None if node.b is None else names[node.b.index]
        names[node.index] = t.operation(node, names[node.a.index], b)
