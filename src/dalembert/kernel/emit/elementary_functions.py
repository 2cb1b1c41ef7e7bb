"""Sine, cosine, the angle of a vector, exp, 1/x and 1/sqrt(x) for several lanes at once, as LLVM text, to an ulp or
two.

Arguments are reduced by pi/2 in three parts (Cody and Waite), the polynomials are those of fdlibm and cephes. They
carry no fast-math flags: the reduction depends on the order of its subtractions. With AVX-512 the two inverses start
from the processor's estimates of 14 bits: the divider takes 16 cycles for 1/x and 40 for 1/sqrt(x), they take 4 and 5.
"""

from __future__ import annotations

from dalembert.kernel.emit.llvm_builder import ModuleText
from dalembert.kernel.emit.machine_code import host_lanes

SINE = (
    1.58969099521155010221e-10,
    -2.50507602534068634195e-08,
    2.75573137070700676789e-06,
    -1.98412698298579493134e-04,
    8.33333333332248946124e-03,
    -1.66666666666666324348e-01,
)
COSINE = (
    -1.13596475577881948265e-11,
    2.08757232129817482790e-09,
    -2.75573143513906633035e-07,
    2.48015872894767294178e-05,
    -1.38888888888741095749e-03,
    4.16666666666666019037e-02,
)
HALF_PI = (1.5707963267341256, 6.0771005063039660e-11, 2.0222662487959506e-21)
ATAN_P = (
    -8.750608600031904122785e-1,
    -1.615753718733365076637e1,
    -7.500855792314704667340e1,
    -1.228866684490136173410e2,
    -6.485021904942025371773e1,
)
ATAN_Q = (
    1.0,
    2.485846490142306297962e1,
    1.650270098316988542046e2,
    4.328810604912902668951e2,
    4.853903996359136964868e2,
    1.945506571482613964425e2,
)
EXP_P = (1.26177193074810590878e-4, 3.02994407707441961300e-2, 9.99999999999999999910e-1)
EXP_Q = (3.00198505138664455042e-6, 2.52448340349684104192e-3, 2.27265548208155028766e-1, 2.0)
LN2_HIGH, LN2_LOW = 6.93145751953125e-1, 1.42860682030941723212e-6
FARTHEST = 745.2
"""Argument from which on e^x is infinite, and e^-x zero."""


def elementary(lanes: int, used: set[str]) -> list[str]:
    """Definitions of the functions in use."""
    lines: list[str] = []
    for op, name, odd in (("sin", "sine", 0), ("cos", "cosine", 1)):
        if used & {op, "tan"}:
            lines += _circular(lanes, name, odd)
    lines += _exponential(lanes) if "exp" in used else []
    lines += _angle(lanes) if "atan2" in used else []
    inverses = [name for op, name in (("inv", "reciprocal"), ("rsqrt", "inverse_root")) if op in used]
    for name in inverses:
        lines += (
            _emit_estimate(lanes, name)
            if lanes in (8, 16) and host_lanes() == 8
            else _emit_division(lanes, name)
        )
    return lines


def _emit_division(lanes: int, name: str) -> list[str]:
    """1/x or 1/sqrt(x) by the processor's division."""
    t = ModuleText(lanes)
    t.lines.append(f"define internal {t.kind} @{name}({t.kind} %x) alwaysinline {{")
    below = "%x" if name == "reciprocal" else t.intrinsic("sqrt", "%x")
    value = t.exact("fdiv", t.splat(1.0), below)
    return [*t.lines, f"  ret {t.kind} {value}", "}"]


def _emit_estimate(lanes: int, name: str) -> list[str]:
    """1/x or 1/sqrt(x) from an estimate y: with e = 1 - x y, or 1 - x y^2, the series of y/(1 - e), y/sqrt(1 - e)."""
    t, kind = ModuleText(lanes), "rcp14" if name == "reciprocal" else "rsqrt14"
    declared = f"declare <8 x double> @{_ESTIMATE}{kind}.pd.512(<8 x double>, <8 x double>, i8)"
    t.lines += [declared, f"define internal {t.kind} @{name}({t.kind} %x) alwaysinline {{"]
    y = _estimate(t, kind, "%x")
    argument = "%x" if name == "reciprocal" else t.exact("fmul", "%x", y)
    e = t.fma(t.let(f"fneg {t.kind} {argument}"), y, t.splat(1.0))
    if name == "reciprocal":
        value = t.fma(y, t.fma(e, t.fma(e, e, e), e), y)
    else:
        value = t.fma(t.exact("fmul", y, e), t.horner((0.3125, 0.375, 0.5), e), y)
    return [*t.lines, f"  ret {t.kind} {value}", "}"]


_ESTIMATE = "llvm.x86.avx512."


def _estimate(t: ModuleText, kind: str, x: str) -> str:
    """The instruction for eight lanes, twice for sixteen."""

    def places(first: int, count: int) -> str:
        return f"<{count} x i32> <" + ", ".join(f"i32 {k}" for k in range(first, first + count)) + ">"

    def eight(x: str) -> str:
        zero, wide = "<8 x double> zeroinitializer", "<8 x double>"
        return t.let(f"call {wide} @{_ESTIMATE}{kind}.pd.512({wide} {x}, {zero}, i8 -1)")

    if t.lanes == 8:
        return eight(x)
    halves = [eight(t.let(f"shufflevector {t.kind} {x}, {t.kind} poison, {places(k, 8)}")) for k in (0, 8)]
    return t.let(f"shufflevector <8 x double> {halves[0]}, <8 x double> {halves[1]}, {places(0, 16)}")


def _circular(lanes: int, name: str, shift: int) -> list[str]:
    """sin(x), or cos(x) = sin(x + pi/2): the quadrant is increased by one."""
    t = ModuleText(lanes)
    t.lines.append(f"define internal {t.kind} @{name}({t.kind} %x) alwaysinline {{")
    n = t.intrinsic("rint", t.exact("fmul", "%x", t.splat(0.6366197723675814)))
    minus = t.let(f"fneg {t.kind} {n}")
    r = "%x"
    for part in HALF_PI:
        r = t.fma(minus, t.splat(part), r)
    z = t.exact("fmul", r, r)
    sine = t.fma(t.exact("fmul", t.horner(SINE, z), z), r, r)
    z2 = t.exact("fmul", z, z)
    cosine = t.fma(t.horner(COSINE, z), z2, t.fma(z, t.splat(-0.5), t.splat(1.0)))
    quadrant = t.let(f"fptosi {t.kind} {n} to {t.whole}")
    if shift:
        quadrant = t.integer("add", quadrant, 1)
    swapped, negative = (t.integer("icmp ne", t.integer("and", quadrant, k), 0) for k in (1, 2))
    value = t.select(swapped, cosine, sine)
    value = t.select(negative, t.let(f"fneg {t.kind} {value}"), value)
    return [*t.lines, f"  ret {t.kind} {value}", "}"]


def _angle(lanes: int) -> list[str]:
    """atan2(y, x): the smaller over the larger, reduced once more at tan(pi/8)."""
    t = ModuleText(lanes)
    t.lines.append(f"define internal {t.kind} @angle({t.kind} %y, {t.kind} %x) alwaysinline {{")
    ax, ay = t.intrinsic("fabs", "%x"), t.intrinsic("fabs", "%y")
    steep = t.compare("ogt", ay, ax)
    large, small = t.select(steep, ay, ax), t.select(steep, ax, ay)
    safe = t.select(t.compare("oeq", large, t.splat(0.0)), t.splat(1.0), large)
    q = t.exact("fdiv", small, safe)
    upper = t.compare("ogt", q, t.splat(0.4142135623730950))
    folded = t.exact("fdiv", t.exact("fsub", q, t.splat(1.0)), t.exact("fadd", q, t.splat(1.0)))
    q = t.select(upper, folded, q)
    z = t.exact("fmul", q, q)
    ratio = t.exact("fdiv", t.exact("fmul", t.horner(ATAN_P, z), z), t.horner(ATAN_Q, z))
    a = t.fma(ratio, q, q)
    a = t.select(upper, t.exact("fadd", a, t.splat(0.7853981633974483)), a)
    a = t.select(steep, t.exact("fsub", t.splat(1.5707963267948966), a), a)
    left = t.compare("olt", "%x", t.splat(0.0))
    a = t.select(left, t.exact("fsub", t.splat(3.141592653589793), a), a)
    signed = t.intrinsic("copysign", a, "%y")
    return [*t.lines, f"  ret {t.kind} {signed}", "}"]


def _exponential(lanes: int) -> list[str]:
    """2^n e^r with |r| <= log(2)/2 and e^r as a quotient of polynomials; 2^n as two factors, as one may overflow."""
    t = ModuleText(lanes)
    t.lines.append(f"define internal {t.kind} @exponential({t.kind} %x) alwaysinline {{")
    inside = t.compare("olt", t.intrinsic("fabs", "%x"), t.splat(FARTHEST))
    x = t.select(inside, "%x", t.splat(0.0))
    n = t.intrinsic("rint", t.exact("fmul", x, t.splat(1.4426950408889634)))
    minus = t.let(f"fneg {t.kind} {n}")
    r = t.fma(minus, t.splat(LN2_LOW), t.fma(minus, t.splat(LN2_HIGH), x))
    z = t.exact("fmul", r, r)
    p = t.exact("fmul", t.horner(EXP_P, z), r)
    ratio = t.exact("fdiv", p, t.exact("fsub", t.horner(EXP_Q, z), p))
    value = t.fma(ratio, t.splat(2.0), t.splat(1.0))
    half = t.intrinsic("rint", t.exact("fmul", n, t.splat(0.5)))
    for power in (half, t.exact("fsub", n, half)):
        total = t.integer("shl", t.integer("add", t.let(f"fptosi {t.kind} {power} to {t.whole}"), 1023), 52)
        value = t.exact("fmul", value, t.let(f"bitcast {t.whole} {total} to {t.kind}"))
    beyond = t.select(
        t.compare("olt", "%x", t.splat(0.0)), t.splat(0.0), t.exact("fmul", "%x", t.splat(float("inf")))
    )
    value = t.select(inside, value, beyond)
    return [*t.lines, f"  ret {t.kind} {value}", "}"]
