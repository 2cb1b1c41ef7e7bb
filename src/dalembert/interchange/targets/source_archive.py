"""A zip of sources: plain C with header, example and Makefile, and a WebAssembly module with a typed loader."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

from dalembert.interchange.targets.source_fmu import zipped
from dalembert.interchange.targets.target_variables import (
    TargetFunction,
    identifier,
    kernel_of,
    target_function,
)

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel
    from dalembert.model import Mechanism

ROW = 128
"""Positions of one call of the WebAssembly module; the loader calls it as often as needed."""


def write_sources(m: Mechanism) -> tuple[bytes, list[str]]:
    """The archive of a mechanism whose inputs are position, speed and acceleration of the drives."""
    return sources_bytes(kernel_of(m)), [
        "the motion: position, speed and acceleration of the drives are inputs"
    ]


def sources_bytes(k: Kernel) -> bytes:
    """NAME.c, NAME.h, example.c, Makefile; NAME.mjs and NAME.d.mts for browsers and Node."""
    name = identifier(k.mechanism.title)
    function = target_function(k, name)
    return zipped(
        {
            f"{name}.c": _tidied(function.source),
            f"{name}.h": _header(function, name),
            "example.c": _example(function, name),
            "Makefile": _makefile(name),
            f"{name}.mjs": _loader(k, name),
            f"{name}.d.mts": _types(k),
        }
    )


def _tidied(source: str) -> str:
    names = ("REAL", "SIGN", "POSITIVE", "LARGER", "SMALLER")
    return source.rstrip() + "\n\n" + "".join(f"#undef {name}\n" for name in names)


def _arguments(f: TargetFunction) -> tuple[list[tuple[int, str, str]], list[tuple[int, str, str]]]:
    """Place, name and unit of each number of v, and of each quantity of c."""
    rows = [(v.place if v in f.parameters else -1 - v.place, v) for v in (*f.inputs, *f.parameters)]
    numbers = [(p, v.name, v.unit) for p, v in rows if v in f.parameters or v.place < 0]
    channels = [(v.place, v.name, v.unit) for v in f.inputs if v.place >= 0]
    return sorted(numbers), sorted(channels)


def _header(f: TargetFunction, name: str) -> str:
    numbers, channels = _arguments(f)
    guard, upper = f"{name.upper()}_H", name.upper()
    starts = {v.name: v.start for v in (*f.inputs, *f.parameters)}

    def listed(letter: str, rows: list[tuple[int, str, str]]) -> list[str]:
        return [f" *   {letter}[{p}] = {what}{f', {unit}' if unit else ''}" for p, what, unit in rows]

    outs = [(v.place, v.name, v.unit) for v in f.outputs]
    lines = [
        "/* One position of a mechanism, SI and radians. Made by dalembert.",
        " * Returns 0 where solved; 9 where it is self-locking, and the numbers hold; other values: no answer,",
        " * 1 the linkage does not close, 2 doubtful, 3 at rest, 7 jammed, 14 outside a table, 15 a contact is lost.",
        *listed("v", numbers),
        *listed("c", channels),
        *listed("out", outs),
        " */",
        f"#ifndef {guard}",
        f"#define {guard}",
        f"#define {upper}_NUMBERS {len(numbers)}",
        f"#define {upper}_CHANNELS {len(channels)}",
        f"#define {upper}_OUTPUTS {len(outs)}",
        f"#define {upper}_V {{{', '.join(repr(starts[what] + 0.0) for _, what, _ in numbers) or '0'}}}",
        f"#define {upper}_C {{{', '.join(repr(starts[what] + 0.0) for _, what, _ in channels) or '0'}}}",
        "#ifdef __cplusplus",
        'extern "C" {',
        "#endif",
        f"int {name}(const double *v, const double *c, double *out);",
        "#ifdef __cplusplus",
        "}",
        "#endif",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def _example(f: TargetFunction, name: str) -> str:
    upper = name.upper()
    names = ", ".join(f'"{v.name} {v.unit}"' for v in f.outputs)
    return f"""/* Prints every output at the file's first position. */
#include "{name}.h"
#include <stdio.h>

int main(void)
{{
  static const char *names[] = {{{names}}};
  const double v[] = {upper}_V, c[] = {upper}_C;
  double out[{upper}_OUTPUTS];
  int i, status = {name}(v, c, out);
  printf("status %d\\n", status);
  if (status != 0 && status != 9) return 1;
  for (i = 0; i < {upper}_OUTPUTS; ++i) printf("%.17g  %s\\n", out[i], names[i]);
  return 0;
}}
"""


def _makefile(name: str) -> str:
    return f"""CFLAGS = -O2 -std=c99 -Wall
example: example.o {name}.o
\t$(CC) $(LDFLAGS) -o $@ $^ -lm
{name}.o example.o: {name}.h
clean:
\trm -f example *.o
"""


def _loader(k: Kernel, name: str) -> str:
    module = k.to_wasm(ROW)
    code = base64.b64encode(module.code).decode()
    return f"""// Positions of a mechanism, SI and radians, as WebAssembly. Made by dalembert; types: {name}.d.mts.
export const numbers = {_quoted(module.numbers)};
export const channels = {_quoted(module.channels)};
export const outputs = {_quoted(module.outputs)};
const nominal = {[float(x) for x in k.nominal]!r};
const ROW = {module.row}, HEAP = {module.heap};
const CODE = "{code}";

export async function load() {{
  const bytes = Uint8Array.from(atob(CODE), (letter) => letter.charCodeAt(0));
  const {{ instance }} = await WebAssembly.instantiate(bytes);
  const {{ memory, run }} = instance.exports;
  const sizes = [numbers.length, channels.length * ROW, (outputs.length + 1) * ROW];
  const places = [];
  let end = HEAP;
  for (const size of sizes) {{
    places.push(end);
    end += Math.ceil((8 * size) / 16) * 16;
  }}
  const missing = Math.ceil((end - memory.buffer.byteLength) / 65536);
  if (missing > 0) memory.grow(missing);
  const [values, path, out] = places.map((place, k) => new Float64Array(memory.buffer, place, sizes[k]));

  return function solve(rows, given = {{}}) {{
    for (const key of Object.keys(given))
      if (!numbers.includes(key)) throw new RangeError(`unknown number ${{key}}; use ${{numbers.join(", ")}}`);
    numbers.forEach((key, k) => (values[k] = given[key] ?? nominal[k]));
    const count = rows.length;
    const answer = {{ status: new Uint8Array(count) }};
    for (const key of outputs) answer[key] = new Float64Array(count);
    for (let first = 0; first < count; first += ROW) {{
      const part = Math.min(ROW, count - first);
      channels.forEach((_, j) => {{
        for (let p = 0; p < ROW; ++p) path[j * ROW + p] = rows[first + Math.min(p, part - 1)][j];
      }});
      run(...places, Math.ceil(part / 2));
      for (let p = 0; p < part; ++p) {{
        const code = out[outputs.length * ROW + p];
        answer.status[first + p] = code;
        outputs.forEach((key, k) => (answer[key][first + p] = code === 0 || code === 9 ? out[k * ROW + p] : NaN));
      }}
    }}
    return answer;
  }};
}}
"""


def _types(k: Kernel) -> str:
    module = k.to_wasm(ROW)

    def union(names: tuple[str, ...]) -> str:
        return " | ".join(_quoted((name,))[1:-1] for name in names) or "never"

    return f"""/** A number of the mechanism, in SI and radians. */
export type NumberName = {union(module.numbers)};
/** An output at each position. */
export type OutputName = {union(module.outputs)};
export const numbers: readonly NumberName[];
/** What each row of a call gives, in this order. */
export const channels: readonly string[];
export const outputs: readonly OutputName[];
/** Outputs of each position, NaN where status is neither 0 nor 9 (self-locking). */
export type Answer = Record<OutputName, Float64Array> & {{ status: Uint8Array }};
/** Rows of channels; numbers that are not given have the values of the file. */
export type Solve = (rows: readonly ArrayLike<number>[], given?: Partial<Record<NumberName, number>>) => Answer;
export function load(): Promise<Solve>;
"""


def _quoted(names: tuple[str, ...]) -> str:
    import json

    return json.dumps(list(names))
