"""Functions that WebAssembly lacks, on two lanes: as in the LLVM form, but without fused products.

exp and log after cephes. Errors: sin, cos, exp, log one unit in the last place, atan2 two, tan, asin, acos three.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from dalembert.kernel.emit.elementary_functions import (
    ATAN_P,
    ATAN_Q,
    COSINE,
    EXP_P,
    EXP_Q,
    HALF_PI,
    LN2_HIGH,
    LN2_LOW,
    SINE,
)
from dalembert.kernel.emit.wasm.instructions import (
    ABS,
    ADD,
    AND,
    DIV,
    EQUAL,
    EQUAL_INTEGERS,
    GREATER,
    LESS,
    MUL,
    NEAREST,
    OR,
    PMAX,
    PMIN,
    SHIFT_LEFT,
    SHIFT_RIGHT,
    SQRT,
    SUB,
    XOR,
    Function,
    integer,
)

WHOLE = 2.0**52
"""Constant that, added to a smaller number, gives a sum with the number as an integer in its low bits."""
LOG_P = (
    1.01875663804580931796e-4,
    4.97494994976747001425e-1,
    4.70579119878881725854e0,
    1.44989225341610930846e1,
    1.79368678507819816313e1,
    7.70838733755885391666e0,
)
LOG_Q = (
    1.0,
    1.12873587189167450590e1,
    4.52279145837532221105e1,
    8.29875266912776603211e1,
    7.11544750618563894466e1,
    2.31251620126765340583e1,
)


def _circular(f: Function, x: bytes, quadrants: int) -> bytes:
    """sin(x + quadrants pi/2)."""
    n = f.keep(x + f.number(2 / math.pi) + MUL + NEAREST)
    r = x
    for part in HALF_PI:
        r = r + n + f.number(part) + MUL + SUB
    r = f.keep(r)
    z = f.keep(r + r + MUL)
    sine = f.polynomial(SINE, z) + z + MUL + r + MUL + r + ADD
    half = f.number(1.0) + z + f.number(0.5) + MUL + SUB
    cosine = f.polynomial(COSINE, z) + z + z + MUL + MUL + half + ADD
    q = f.keep(n + f.number(1.5 * WHOLE + quadrants) + ADD)
    odd = q + f.integer(1) + AND + f.integer(1) + EQUAL_INTEGERS
    minus = q + f.integer(2) + AND + integer(62) + SHIFT_LEFT
    return f.choose(odd, cosine, sine) + minus + XOR


def _sine(f: Function, x: bytes) -> bytes:
    return _circular(f, x, 0)


def _cosine(f: Function, x: bytes) -> bytes:
    return _circular(f, x, 1)


def _tangent(f: Function, x: bytes) -> bytes:
    return f.keep(_circular(f, x, 0)) + f.keep(_circular(f, x, 1)) + DIV


def _angle(f: Function, y: bytes, x: bytes) -> bytes:
    """atan2(y, x): the smaller over the larger, reduced once more at tan(pi/8)."""
    ax, ay = f.keep(x + ABS), f.keep(y + ABS)
    steep = f.keep(ay + ax + GREATER)
    large = f.keep(f.choose(steep, ay, ax))
    none = large + f.number(0.0) + EQUAL
    q = f.keep(f.choose(steep, ax, ay) + f.choose(none, f.number(1.0), large) + DIV)
    upper = f.keep(q + f.number(0.4142135623730950) + GREATER)
    q = f.keep(f.choose(upper, q + f.number(1.0) + SUB + q + f.number(1.0) + ADD + DIV, q))
    z = f.keep(q + q + MUL)
    a = f.polynomial(ATAN_P, z) + z + MUL + f.polynomial(ATAN_Q, z) + DIV + q + MUL + q + ADD
    a = f.keep(a + upper + f.number(math.pi / 4) + AND + ADD)
    a = f.keep(f.choose(steep, f.number(math.pi / 2) + a + SUB, a))
    a = f.choose(x + f.number(0.0) + LESS, f.number(math.pi) + a + SUB, a)
    return a + f.integer(1 << 63) + y + AND + OR


def _other_leg(f: Function, x: bytes) -> bytes:
    """sqrt(1 - x^2)."""
    return f.keep(f.number(1.0) + x + SUB + f.number(1.0) + x + ADD + MUL + SQRT)


def _arcsine(f: Function, x: bytes) -> bytes:
    return _angle(f, x, _other_leg(f, x))


def _arccosine(f: Function, x: bytes) -> bytes:
    return _angle(f, _other_leg(f, x), x)


def _exponential(f: Function, x: bytes) -> bytes:
    """2^n exp(r), the power of two in two factors so that the ends of the range are reached."""
    argument, x = x, f.keep(f.number(-746.0) + f.keep(f.number(710.0) + x + PMIN) + PMAX)
    n = f.keep(x + f.number(1 / math.log(2)) + MUL + NEAREST)
    r = f.keep(x + n + f.number(LN2_HIGH) + MUL + SUB + n + f.number(LN2_LOW) + MUL + SUB)
    z = f.keep(r + r + MUL)
    p = f.keep(f.polynomial(EXP_P, z) + r + MUL)
    value = f.number(1.0) + p + f.polynomial(EXP_Q, z) + p + SUB + DIV + f.number(2.0) + MUL + ADD
    half = f.keep(n + f.number(0.5) + MUL + NEAREST)
    rest = n + half + SUB

    def power(k: bytes) -> bytes:
        return k + f.number(WHOLE + 1023) + ADD + integer(52) + SHIFT_LEFT

    value += power(half) + MUL + power(rest) + MUL
    return f.choose(argument + argument + EQUAL, value, argument)


def _logarithm(f: Function, x: bytes) -> bytes:
    """log(m) + e log(2) with m in (sqrt(1/2), sqrt(2)); a number below the least normal one is scaled first."""
    small = f.keep(x + f.number(2.0**-1022) + LESS)
    y = f.keep(f.choose(small, x + f.number(2.0**54) + MUL, x))
    e = y + integer(52) + SHIFT_RIGHT + f.integer(0x4330000000000000) + OR + f.number(WHOLE + 1022) + SUB
    e = e + small + f.number(54.0) + AND + SUB
    m = f.keep(y + f.integer((1 << 52) - 1) + AND + f.integer(0x3FE0000000000000) + OR)
    low = f.keep(m + f.number(math.sqrt(0.5)) + LESS)
    e = f.keep(e + low + f.number(1.0) + AND + SUB)
    m = f.keep(f.choose(low, m + m + ADD, m) + f.number(1.0) + SUB)
    z = f.keep(m + m + MUL)
    p = m + z + MUL + f.polynomial(LOG_P, m) + MUL + f.polynomial(LOG_Q, m) + DIV
    p = p + e + f.number(2.121944400546905827679e-4) + MUL + SUB + z + f.number(0.5) + MUL + SUB
    value = f.keep(m + p + ADD + e + f.number(0.693359375) + MUL + ADD)
    endless = x + f.number(math.inf) + EQUAL
    value = f.choose(endless, x, value)
    value = f.choose(x + f.number(0.0) + GREATER, value, f.number(math.nan))
    return f.choose(x + f.number(0.0) + EQUAL, f.number(-math.inf), value)


def _sign(f: Function, x: bytes) -> bytes:
    """1, 0 or -1; NaN for NaN."""
    one = f.number(1.0)
    plus, minus = x + f.number(0.0) + GREATER + one + AND, x + f.number(0.0) + LESS + one + AND
    return f.choose(x + x + EQUAL, plus + minus + SUB, x)


FUNCTIONS: dict[str, Callable[..., bytes]] = {
    "sign": _sign,
    "sin": _sine,
    "cos": _cosine,
    "tan": _tangent,
    "atan2": _angle,
    "asin": _arcsine,
    "acos": _arccosine,
    "exp": _exponential,
    "log": _logarithm,
}
"""Functions of the module for operations that use their argument more than once."""
