"""A program as C text: for the CUDA compiler (one thread per design and position, or per design) and for any C
compiler.

The text is the same for both; without ``__CUDACC__`` a loop replaces the threads.
"""

from __future__ import annotations

from collections.abc import Callable

from dalembert.kernel.emit.reductions import FARTHEST, PLACED, SUMS, TIE, Slots, width
from dalembert.kernel.graph import Node
from dalembert.kernel.program import CODES, Program

HEAD = """\
#ifdef __CUDACC__
#define ENTRY extern "C" __global__
#define FIRST ((long long)blockIdx.x * blockDim.x + threadIdx.x)
#define STRIDE ((long long)gridDim.x * blockDim.x)
#else
#include <math.h>
#define ENTRY
#define FIRST 0
#define STRIDE 1
#endif
#ifndef REAL
#define REAL double
#endif
#define SIGN(x) ((REAL)((x) > 0) - (REAL)((x) < 0))
#define POSITIVE(x) ((REAL)((x) > 0))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))
"""

_BINARY = {"add": "+", "sub": "-", "mul": "*"}
_CALLS = {
    "abs": "fabs",
    "atan2": "atan2",
    "sign": "SIGN",
    "positive": "POSITIVE",
    "max": "LARGER",
    "min": "SMALLER",
}


def statement(node: Node, name: Callable[[Node], str]) -> str:
    """One operation as a declaration."""
    assert node.a is not None
    a = name(node.a)
    if node.op in _BINARY:
        assert node.b is not None
        right = f"{a} {_BINARY[node.op]} {name(node.b)}"
    elif node.op == "inv":
        right = f"1 / {a}"
    elif node.op == "rsqrt":
        right = f"1 / sqrt({a})"
    elif node.op in ("neg", "detach"):
        right = f"-{a}" if node.op == "neg" else a
    else:
        rest = "" if node.b is None else f", {name(node.b)}"
        right = f"{_CALLS.get(node.op, node.op)}({a}{rest})"
    return f"const REAL t{node.index} = {right};"


def names(program: Program) -> Callable[[Node], str]:
    """Expression of each node: constants in brackets, inputs by their arrays, the others by number."""

    def name(node: Node) -> str:
        if node.op == "const":
            return f"((REAL){node.value!r})"
        if node.op == "number":
            return f"v[{program.places[node.index]}]"
        if node.op == "common":
            return f"m[{program.places[node.index]}]"
        if node.op == "channel":
            return f"c[{program.places[node.index]}]"
        return f"t{node.index}"

    return name


def lines(nodes: list[Node], name: Callable[[Node], str], indent: str) -> str:
    return "\n".join(indent + statement(n, name) for n in nodes)


def flags(program: Program, name: Callable[[Node], str], indent: str) -> str:
    """Declaration of ``here``, the status code of this position."""
    m, code = program.flags, CODES

    def below(nodes: tuple[Node, ...], numbers: bool = True) -> str:
        tests = [f"{name(n)} < 0" if numbers else f"!({name(n)} >= 0)" for n in nodes]
        return f"({' || '.join(tests) or '0'})"

    out = [
        f"int here = {below(m.open)} ? {code['open']} : {below(m.doubt, False)} ? {code['doubt']} : 0;",
        f"int rest = {below(m.rest)}, jam = 0, locked = {below(m.turned)};",
        f"int doubt = {below(m.slips, False)};",
    ]
    if m.seldom:
        single = f"{below(m.unsure, False)} && {below(m.sure, False)}"
        out += [
            f"if (!here && !rest && ({below(m.unsure, False)} || locked)) {{",
            lines(program.seldom, name, "  "),
            f"  const int single = {single};",
            f"  doubt = doubt || single || (locked && {below(m.still, False)});",
            f"  locked = locked && {below(m.locked) if m.locked else '1'};",
            "  if (single) {",
            lines(program.rare, name, "    "),
            f"    jam = {below(m.jam)};",
            "  }",
            "}",
        ]
    tests = [("rest",) * 2, ("jam",) * 2, ("doubt",) * 2, (below(m.contact), "contact"), ("locked",) * 2]
    tests += [(below(m.slope, False), "slope"), (below(m.outside), "outside")]
    then = "".join(f"{test} ? {code[mark]} : " for test, mark in tests)
    out.append(f"if (!here) here = {then}0;")
    return "\n".join(indent + line for line in "\n".join(out).splitlines())


ARGUMENTS = (
    "const REAL *values, const REAL *path, const REAL *m, REAL *out, unsigned char *code, "
    "long long numbers, long long channels, long long designs, long long positions"
)


def grid(program: Program) -> str:
    """Entry ``grid``: values (design, number), path (position, channel), out (design, output, position)."""
    name = names(program)
    stores = "\n".join(
        f"    out[(d * {len(program.outputs)} + {k}) * positions + p] = {name(n)};"
        for k, n in enumerate(program.outputs)
    )
    return (
        HEAD
        + f"""
ENTRY void grid({ARGUMENTS})
{{
  for (long long at = FIRST; at < designs * positions; at += STRIDE) {{
    const long long d = at / positions, p = at % positions;
    const REAL *v = values + d * numbers, *c = path + p * channels;
{lines(program.design, name, "    ")}
{lines(program.position, name, "    ")}
{stores}
{flags(program, name, "    ")}
    code[at] = (unsigned char)here;
  }}
}}
"""
    )


def emit_reduced(program: Program, slots: Slots) -> str:
    """Entry ``reduced`` of the C text: one design after the other, out (design, slot)."""
    name = names(program)
    starts, updates, stores, slot = [], [], [], 0
    for s, (k, p) in enumerate(slots):
        x = name(program.outputs[k])
        starts.append(f"    REAL a{s} = {_start(p)};")
        if p in SUMS:
            power = x
            for _ in range(SUMS[p]):
                power = f"({power}) * ({power})"
            updates.append(f"      a{s} += {power};")
        else:
            size = f"fabs({x})" if p.endswith("peak") else x
            how = "<" if p.endswith("min") else ">"
            updates.append(f"      if ({size} {how} a{s}) a{s} = {size};")
            if p in PLACED:
                more = f"h{s} - {size}" if p.endswith("min") else f"{size} - h{s}"
                starts.append(f"    REAL h{s} = {FARTHEST[p[3:]]!r}, w{s} = 0;")
                updates.append(
                    f"      if ({more} > {TIE!r} * fabs(h{s})) {{ h{s} = {size}; w{s} = (REAL)p; }}"
                )
        stores.append(f"    out[d * {width(slots)} + {slot}] = a{s};")
        slot += 1
        if p in PLACED:
            stores.append(f"    out[d * {width(slots)} + {slot}] = w{s};")
            slot += 1
    design, position = lines(program.design, name, "    "), lines(program.position, name, "      ")
    return (
        HEAD
        + f"""
ENTRY void reduced({ARGUMENTS})
{{
  for (long long d = FIRST; d < designs; d += STRIDE) {{
    const REAL *v = values + d * numbers;
    int mark = 0;
{chr(10).join(starts)}
{design}
    for (long long p = 0; p < positions; ++p) {{
      const REAL *c = path + p * channels;
{position}
{chr(10).join(updates)}
{flags(program, name, "      ")}
      mark = !mark ? here : !here ? mark : SMALLER(mark, here);
    }}
{chr(10).join(stores)}
    code[d] = (unsigned char)mark;
  }}
}}
"""
    )


def _start(primitive: str) -> str:
    kind = primitive.removeprefix("arg")
    return {"peak": "-1", "min": "(REAL)INFINITY", "max": "-(REAL)INFINITY"}.get(kind, "0")


def function(program: Program, name: str, comment: str) -> str:
    """A self-contained C function of one position: values, drives' quantities, outputs; returns the status code."""
    write = names(program)
    comment = "\n".join(f" * {line}".rstrip() for line in comment.splitlines())
    body = lines([*program.design, *program.position], write, "  ")
    stores = "\n".join(f"  out[{k}] = {write(n)};" for k, n in enumerate(program.outputs))
    return f"""/*
{comment}
 */
#include <math.h>
#define REAL double
#define SIGN(x) ((REAL)((x) > 0) - (REAL)((x) < 0))
#define POSITIVE(x) ((REAL)((x) > 0))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))

int {name}(const double *v, const double *c, double *out)
{{
{body}
{stores}
{flags(program, write, "  ")}
  return here;
}}
"""
