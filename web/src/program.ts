/** WebAssembly programs of the page, each with room for its inputs and outputs. */

import type { Module, Series } from "./data";

export function bytes(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

export function series(given: Series): Float64Array {
  if (typeof given === "string") return new Float64Array(bytes(given).buffer);
  const step = (given.to - given.from) / Math.max(given.count - 1, 1);
  return Float64Array.from({ length: given.count }, (_, k) => (k === given.count - 1 ? given.to : given.from + k * step));
}

export async function inflate(text: string): Promise<ArrayBuffer> {
  const stream = new Blob([bytes(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

type Run = (values: number, path: number, out: number, blocks: number) => void;

/** One WebAssembly program with room for its inputs and outputs. */
export class Program {
  readonly values: Float64Array;
  readonly path: Float64Array;
  readonly out: Float64Array;
  readonly row: number;
  private readonly places: number[] = [];
  private constructor(private readonly run: Run, memory: WebAssembly.Memory, readonly module: Module, numbers: number) {
    this.row = module.row;
    const sizes = [numbers, module.channels.length * module.row, (module.outputs + 1) * module.row];
    let end = module.heap;
    for (const size of sizes) {
      this.places.push(end);
      end = (end + 8 * size + 15) & ~15;
    }
    if (end > memory.buffer.byteLength) memory.grow(Math.ceil((end - memory.buffer.byteLength) / 65536));
    [this.values, this.path, this.out] = sizes.map((n, k) => new Float64Array(memory.buffer, this.places[k], n));
  }
  static async create(m: Module, numbers: number): Promise<Program> {
    const { instance } = await WebAssembly.instantiate(await inflate(m.wasm));
    const { memory, run } = instance.exports as unknown as { memory: WebAssembly.Memory; run: Run };
    return new Program(run, memory, m, numbers);
  }
  call(positions: number): void {
    this.run(this.places[0], this.places[1], this.places[2], Math.ceil(positions / 2));
  }
  /** One input at both of the first places, for a call of one position; or one for each. */
  put(channel: number, x: number, other = x): void {
    this.path[channel * this.row] = x;
    this.path[channel * this.row + 1] = other;
  }
  /** An output at position k. */
  at(output: number, k = 0): number {
    return this.out[output * this.row + k];
  }
}
