"""Random numbers in machine code: Philox by counter, and the inverse of the normal distribution.

Every operation is rounded as written, with no fast-math flags: the bits are the same for any number of lanes.

Philox4x64 of ten rounds: Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC11 (2011); the bits
are those of numpy's. The inverse of the normal distribution: z = (u - 1/2) Q(w) with w = -log(4 u (1 - u)), the form of
Giles, Approximating the erfinv function, GPU Computing Gems 2 (2012), Q interpolated at Chebyshev's points; from w =
5.5, a share of 0.001 either side, the outer fractions of Wichura, Algorithm AS 241, Applied Statistics 37 (1988).
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from dalembert.arrays import Array
from dalembert.kernel.emit.llvm_builder import ModuleText, number
from dalembert.kernel.emit.llvm_text import WIDE
from dalembert.kernel.emit.machine_code import Machine, compile_module, host_lanes
from dalembert.kernel.emit.marks import some
from dalembert.kernel.memory import aligned_array


def table(text: str) -> tuple[float, ...]:
    """Coefficients, the highest power first."""
    return tuple(map(float, text.split()))


WORDS = 4
"""Numbers that Philox makes per count."""
MULTIPLIERS = (0xD2E7470EE14C6C93, 0xCA5A826395121157)
STEPS = (0x9E3779B97F4A7C15, 0xBB67AE8584CAA73B)
"""Increments of Philox's two keys from round to round."""
ROUNDS = 10
HALF = 2**32 - 1
"""The lower half of a word."""
ROOT = 0x3FE6A09E667F3BCD
"""The bits of sqrt(1/2)."""
EDGE = 5.5
"""Value of w from which the outer fractions are used."""
MIDDLE = table(
    """
    -1.0572923247016331e-19 -2.2651388454304477e-19 1.1099401124039523e-17 -1.5745388091383548e-17
    -5.472445561706105e-16 3.2104435770354874e-15 9.867875630601752e-15 -2.092224808835726e-13
    6.989839669564112e-13 6.4474735974993335e-12 -7.253663031469432e-11 9.438804268531924e-11
    3.150490668621405e-09 -2.343399560963167e-08 -2.3247710436174393e-08 1.3659973404902491e-06
    -7.26576260052936e-06 -2.6830609259502155e-05 0.0005913287025615762 -0.0029375532687511167
    -0.01424389041086376 0.6910703319945046 4.420236526686814
    """
)
"""Q in powers of w - EDGE / 2, to 2e-17."""
OUTER = table(
    """
    7.74545014278341407640e-4 2.27238449892691845833e-2 2.41780725177450611770e-1 1.27045825245236838258
    3.64784832476320460504 5.76949722146069140550 4.63033784615654529590 1.42343711074968357734
    1.05075007164441684324e-9 5.47593808499534494600e-4 1.51986665636164571966e-2 1.48103976427480074590e-1
    6.89767334985100004550e-1 1.67638483018380384940 2.05319162663775882187 1.0
    2.01033439929228813265e-7 2.71155556874348757815e-5 1.24266094738807843860e-3 2.65321895265761230930e-2
    2.96560571828504891230e-1 1.78482653991729133580 5.46378491116411436990 6.65790464350110377720
    2.04426310338993978564e-15 1.42151175831644588870e-7 1.84631831751005468180e-5 7.86869131145613259100e-4
    1.48753612908506148525e-2 1.36929880922735805310e-1 5.99832206555887937690e-1 1.0
    """
)
FRACTIONS = (1.6, OUTER[:8], OUTER[8:16]), (5.0, OUTER[16:24], OUTER[24:])
"""Numerator and denominator in powers of sqrt(-log p) minus a number, with p the smaller of u and 1 - u; the second
from 5 on."""
LOGARITHM = table(
    """
    1.479819860511658591e-01 1.531383769920937332e-01 1.818357216161805012e-01 2.222219843214978396e-01
    2.857142874366239149e-01 3.999999999940941908e-01 6.666666666666735130e-01
    """
)
"""fdlibm's, of log((1 + s)/(1 - s))/s - 2 in powers of s^2."""
FIELDS = 8
"""64-bit words of a row, which defines the distribution of one number: two keys of Philox; low, width, a, b and a
normal flag, for a value a + b x, where x is low + width u with u uniform, or the normal score of that; one word is
unused."""


def draw(rows: Array, start: int, stop: int, lanes: int | None = None) -> Array:
    """Values (design, number) of designs ``start`` to ``stop``; each number takes u from a separate row of Philox.

    It is (r + 1/2)/2^53 of the first 53 bits r of a word, strictly between 0 and 1.
    """
    machine = _machine(True, lanes or 2 * host_lanes())
    first, tile = start // WORDS, WORDS * machine.lanes
    tiles = max(1, -(-(stop - WORDS * first) // tile))
    out = aligned_array((tiles * tile, len(rows)))
    machine(rows, out, out, out, (len(rows), first, 0, tiles))
    return out[start - WORDS * first :][: stop - start]


def quantiles(rows: Array, shares: Array, lanes: int | None = None) -> Array:
    """Quantiles (design, number) at probabilities u (number, design) of all designs."""
    machine = _machine(False, lanes or 2 * host_lanes())
    count, tile = shares.shape[1], WORDS * machine.lanes
    tiles = max(1, -(-count // tile))
    padded, out = np.full((len(rows), tiles * tile), 0.5), aligned_array((tiles * tile, len(rows)))
    padded[:, :count] = shares
    machine(rows, padded, out, out, (len(rows), 0, tiles * tile, tiles))
    return out[:count]


@cache
def _machine(drawn: bool, lanes: int) -> Machine:
    return compile_module(_module(drawn, lanes), lanes)


def _module(drawn: bool, lanes: int) -> str:
    """Fills the designs tile by tile, and each tile number by number: from Philox's four words, or from four vectors of
    given u."""
    t = ModuleText(lanes)
    t.lines += [
        "define void @run(ptr noalias readonly %rows, ptr noalias readonly %shares, ptr noalias %out, ptr %none, "
        f"i64 %numbers, i64 %first, i64 %length, i64 %tiles) {WIDE} {{",
        "entry:",
        "  br label %tile",
        "tile:",
        "  %c = phi i64 [ 0, %entry ], [ %cnext, %filled ]",
        f"  %c0 = mul i64 %c, {lanes}",
        "  %c1 = add i64 %c0, %first",
        "  %count = add i64 %c1, 1",
        f"  %design = mul i64 %c, {WORDS * lanes}",
        "  %place = mul i64 %design, %numbers",
        "  %page = getelementptr inbounds double, ptr %out, i64 %place",
        "  br label %number",
        "number:",
        "  %j = phi i64 [ 0, %tile ], [ %jnext, %known ]",
        f"  %j0 = mul i64 %j, {FIELDS}",
        "  %row = getelementptr inbounds double, ptr %rows, i64 %j0",
    ]
    if drawn:
        shares = [_share(t, word) for word in _philox(t)]
    else:
        t.lines += ["  br label %drawn", "drawn:"]
        line = t.let("add i64 %design, " + t.let("mul i64 %j, %length"))
        shares = [t.load("%shares", t.let(f"add i64 {line}, {w * lanes}")) for w in range(WORDS)]
    low, width, a, b = (t.broadcast(t.load("%row", k, vector=False)) for k in (2, 3, 4, 5))
    flat = [t.exact("fadd", low, t.exact("fmul", u, width)) for u in shares]
    normal = t.let(f"fcmp une double {t.load('%row', 6, vector=False)}, {number(0.0)}")
    t.put(f"br i1 {normal}, label %bell, label %known")
    t.lines.append("bell:")
    scores = [t.call("score", u) for u in flat]
    t.lines += ["  br label %known", "known:"]
    known = [_phi(t, (x, "drawn"), (z, "bell")) for x, z in zip(flat, scores, strict=True)]
    for w, x in enumerate(known):
        value = t.exact("fadd", a, t.exact("fmul", b, x))
        for lane in range(lanes):
            _store_number(t, value, lane, WORDS * lane + w if drawn else w * lanes + lane)
    t.lines += [
        "  %jnext = add nuw i64 %j, 1",
        "  %more = icmp ult i64 %jnext, %numbers",
        "  br i1 %more, label %number, label %filled",
        "filled:",
        "  %cnext = add nuw i64 %c, 1",
        "  %again = icmp ult i64 %cnext, %tiles",
        "  br i1 %again, label %tile, label %exit",
        "exit:",
        "  ret void",
        "}",
    ]
    declared = [t.declare(name, count) for name, count in (("sqrt", 1), ("minnum", 2), ("fma", 3))]
    declared.append(f"declare i1 @llvm.vector.reduce.or.v{lanes}i1({t.bit})" if lanes > 1 else "")
    return "\n".join([*declared, *_score(lanes), *t.lines]) + "\n"


def _phi(t: ModuleText, *branches: tuple[str, str]) -> str:
    return t.let(f"phi {t.kind} " + ", ".join(f"[ {value}, %{block} ]" for value, block in branches))


def _store_number(t: ModuleText, value: str, lane: int, design: int) -> None:
    one = value if t.lanes == 1 else t.let(f"extractelement {t.kind} {value}, i32 {lane}")
    place = t.let("add i64 %j, " + t.let(f"mul i64 %numbers, {design}"))
    t.put(
        f"store double {one}, ptr {t.let(f'getelementptr inbounds double, ptr %page, i64 {place}')}, align 8"
    )


def _philox(t: ModuleText) -> list[str]:
    """Four words of each lane, whose counts follow ``%count``."""
    lanes = "0" if t.lanes == 1 else "<" + ", ".join(f"i64 {k}" for k in range(t.lanes)) + ">"
    zero = t.integer("and", lanes, 0)
    words = [t.integer("add", t.broadcast("%count", "i64"), lanes), zero, zero, zero]
    keys = [t.let(f"bitcast double {t.load('%row', k, vector=False)} to i64") for k in (0, 1)]
    t.lines += ["  br label %round", "round:", "  %r = phi i64 [ 0, %number ], [ %rnext, %round ]"]
    now = [f"%w{k}" for k in range(WORDS)]
    for k, word in enumerate(words):
        t.put(f"%w{k} = phi {t.whole} [ {word}, %number ], [ %next{k}, %round ]")
    for k, key in enumerate(keys):
        t.put(f"%k{k} = phi i64 [ {key}, %number ], [ %key{k}, %round ]")
    products = [_product(t, now[2 * k], MULTIPLIERS[k]) for k in (0, 1)]
    for k, (high, low) in enumerate(reversed(products)):
        mixed = t.integer("xor", high, now[2 * k + 1])
        t.put(f"%next{2 * k} = xor {t.whole} {mixed}, {t.broadcast(f'%k{k}', 'i64')}")
        t.put(f"%next{2 * k + 1} = or {t.whole} {low}, {zero}")
        t.put(f"%key{k} = add i64 %k{k}, {STEPS[k]}")
    t.lines += [
        "  %rnext = add nuw i64 %r, 1",
        f"  %further = icmp ult i64 %rnext, {ROUNDS}",
        "  br i1 %further, label %round, label %drawn",
        "drawn:",
    ]
    return [f"%next{k}" for k in range(WORDS)]


def _product(t: ModuleText, x: str, by: int) -> tuple[str, str]:
    """High and low word of a product, from products of half words."""
    low, high = t.integer("and", x, HALF), t.integer("lshr", x, 32)
    a, b = by & HALF, by >> 32
    first = t.integer("mul", low, a)
    middle = t.integer("add", t.integer("mul", low, b), t.integer("lshr", first, 32))
    other = t.integer("add", t.integer("mul", high, a), t.integer("and", middle, HALF))
    bottom = t.integer("or", t.integer("shl", other, 32), t.integer("and", first, HALF))
    top = t.integer("add", t.integer("mul", high, b), t.integer("lshr", middle, 32))
    return t.integer("add", top, t.integer("lshr", other, 32)), bottom


def _share(t: ModuleText, word: str) -> str:
    """A number strictly between 0 and 1, from the first 53 bits of a word."""
    value = t.let(f"uitofp {t.whole} {t.integer('lshr', word, 11)} to {t.kind}")
    share = t.exact("fmul", t.exact("fadd", value, t.splat(0.5)), t.splat(2.0**-53))
    return t.intrinsic("minnum", share, t.splat(1 - 2.0**-53))


def _logarithm(t: ModuleText, y: str) -> str:
    """-log y: y = 2^k m with m from sqrt(1/2) to sqrt(2), log m = 2 artanh s, s = (m - 1)/(m + 1)."""
    bits = t.integer("sub", t.let(f"bitcast {t.kind} {y} to {t.whole}"), ROOT)
    k = t.let(f"sitofp {t.whole} {t.integer('ashr', bits, 52)} to {t.kind}")
    m = t.integer("add", t.integer("and", bits, 2**52 - 1), ROOT)
    f = t.exact("fsub", t.let(f"bitcast {t.whole} {m} to {t.kind}"), t.splat(1.0))
    s = t.exact("fdiv", f, t.exact("fadd", f, t.splat(2.0)))
    z = t.exact("fmul", s, s)
    log = t.fma(t.exact("fmul", t.horner(LOGARITHM, z), z), s, t.exact("fadd", s, s))
    return t.fma(k, t.splat(-math.log(2)), t.let(f"fneg {t.kind} {log}"))


def _score(lanes: int) -> list[str]:
    """The function from probabilities to normal scores; where no lane is near 0 or 1 the outer fractions are
    skipped."""
    t = ModuleText(lanes)
    t.lines += [f"define internal {t.kind} @score({t.kind} %u) noinline {WIDE} {{", "entry:"]
    one, four, half = (t.splat(x) for x in (1.0, 4.0, 0.5))
    w = _logarithm(t, t.exact("fmul", "%u", t.exact("fsub", four, t.exact("fmul", four, "%u"))))
    middle = t.exact(
        "fmul", t.exact("fsub", "%u", half), t.horner(MIDDLE, t.exact("fsub", w, t.splat(EDGE / 2)))
    )
    far = t.compare("ogt", w, t.splat(EDGE))
    t.put(f"br i1 {some(t, far)}, label %outer, label %merged")
    t.lines.append("outer:")
    upper = t.compare("ogt", "%u", half)
    p = t.select(upper, t.exact("fsub", one, "%u"), "%u")
    r = t.intrinsic("sqrt", _logarithm(t, p))
    near, away = (
        t.exact("fdiv", *(t.horner(of, t.exact("fsub", r, t.splat(origin))) for of in fraction))
        for origin, *fraction in FRACTIONS
    )
    size = t.select(t.compare("ogt", r, t.splat(FRACTIONS[1][0])), away, near)
    size = t.select(t.compare("ogt", p, t.splat(0.0)), size, t.splat(math.inf))
    outer = t.select(far, t.select(upper, size, t.let(f"fneg {t.kind} {size}")), middle)
    t.lines += ["  br label %merged", "merged:"]
    score = _phi(t, (middle, "entry"), (outer, "outer"))
    return [*t.lines, f"  ret {t.kind} {score}", "}"]
