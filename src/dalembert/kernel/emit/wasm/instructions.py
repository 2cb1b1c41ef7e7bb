"""WebAssembly's binary format, as far as a program needs it: numbers, sections, and instructions on two lanes (f64x2).

Source: WebAssembly Core Specification 2.0, section 5 (binary format).
"""

from __future__ import annotations

import struct
from collections.abc import Sequence


def unsigned(n: int) -> bytes:
    """An unsigned number in groups of seven bits (LEB128)."""
    out = b""
    while n > 0x7F:
        out, n = out + bytes([n & 0x7F | 0x80]), n >> 7
    return out + bytes([n])


def signed(n: int) -> bytes:
    """A signed number in groups of seven bits (LEB128)."""
    out = b""
    while not -64 <= n < 64:
        out, n = out + bytes([n & 0x7F | 0x80]), n >> 7
    return out + bytes([n & 0x7F])


def section(kind: int, *items: bytes) -> bytes:
    """A section of a module: a list of items."""
    content = unsigned(len(items)) + b"".join(items)
    return bytes([kind]) + unsigned(len(content)) + content


def text(name: str) -> bytes:
    """A name."""
    return unsigned(len(name)) + name.encode()


def lanes(opcode: int) -> bytes:
    """An instruction on two lanes."""
    return b"\xfd" + unsigned(opcode)


def get(local: int) -> bytes:
    """Instruction that pushes a local on the stack."""
    return b"\x20" + unsigned(local)


def put(local: int) -> bytes:
    """Instruction that pops a local from the stack."""
    return b"\x21" + unsigned(local)


def integer(n: int) -> bytes:
    """Instruction that pushes an i32 on the stack."""
    return b"\x41" + signed(n)


def call(function: int) -> bytes:
    return b"\x10" + unsigned(function)


ADD, SUB, MUL, DIV = lanes(0xF0), lanes(0xF1), lanes(0xF2), lanes(0xF3)
ABS, NEG, SQRT, NEAREST, PMIN, PMAX = (
    lanes(0xEC),
    lanes(0xED),
    lanes(0xEF),
    lanes(0x94),
    lanes(0xF6),
    lanes(0xF7),
)
EQUAL, LESS, GREATER, AT_LEAST = lanes(0x47), lanes(0x49), lanes(0x4A), lanes(0x4C)
NOT, AND, AND_NOT, OR, XOR, SELECT, ANY_TRUE = (lanes(k) for k in (0x4D, 0x4E, 0x4F, 0x50, 0x51, 0x52, 0x53))
SHIFT_LEFT, SHIFT_RIGHT, EQUAL_INTEGERS = lanes(0xCB), lanes(0xCD), lanes(0xD6)
IF, LOOP, END = b"\x04\x40", b"\x03\x40", b"\x0b"
ADD_INTEGERS, SUB_INTEGERS, REPEAT_IF = b"\x6a", b"\x6b", b"\x0d\x00"


def load(place: int) -> bytes:
    """Both lanes from an address on the stack and an offset in bytes."""
    return lanes(0x00) + b"\x03" + unsigned(place)


def load_both(place: int) -> bytes:
    """One number into both lanes."""
    return lanes(0x0A) + b"\x03" + unsigned(place)


def store(place: int) -> bytes:
    """Both lanes to an address below them on the stack and an offset in bytes."""
    return lanes(0x0B) + b"\x03" + unsigned(place)


class Constants:
    """Numbers and bit patterns from address 0 on; each is loaded into both lanes where it is used."""

    def __init__(self) -> None:
        self.places: dict[bytes, int] = {}

    def number(self, x: float) -> bytes:
        return self._load(struct.pack("<d", x))

    def integer(self, x: int) -> bytes:
        return self._load(struct.pack("<Q", x))

    def _load(self, data: bytes) -> bytes:
        return integer(0) + load_both(self.places.setdefault(data, 8 * len(self.places)))


class Function:
    """A function being written: a value is the code that pushes it on the stack; kept values are in locals."""

    def __init__(self, parameters: int, constants: Constants) -> None:
        self.first = self.count = parameters
        self.code: list[bytes] = []
        self.number, self.integer = constants.number, constants.integer

    def put(self, *code: bytes) -> None:
        self.code += code

    def keep(self, value: bytes) -> bytes:
        """The value, computed here and read from a local wherever it is used."""
        if len(value) <= 3 and value[:1] == b"\x20":
            return value
        self.put(value, put(self.count))
        self.count += 1
        return get(self.count - 1)

    def change(self, kept: bytes, value: bytes) -> None:
        """Assigns a new value to a kept one."""
        self.put(value, b"\x21" + kept[1:])

    def choose(self, test: bytes, a: bytes, b: bytes) -> bytes:
        """a where the test holds, else b."""
        return a + b + test + SELECT

    def polynomial(self, coefficients: Sequence[float], z: bytes) -> bytes:
        """By Horner's rule, the highest power first."""
        total = self.number(coefficients[0])
        for x in coefficients[1:]:
            total = total + z + MUL + self.number(x) + ADD
        return total

    def definition(self) -> bytes:
        """Definition in the module: its locals, all of two lanes, and its code."""
        kept = self.count - self.first
        held = (b"\x01" + unsigned(kept) + b"\x7b" if kept else b"\x00") + b"".join(self.code) + END
        return unsigned(len(held)) + held
