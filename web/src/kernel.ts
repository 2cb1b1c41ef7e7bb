/** The compiled analysis of the page: rows of numbers over the cycle and at one place of it. */

import type { Channel, Data, Module, Pair, Series, Table } from "./data";

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
class Program {
  readonly values: Float64Array;
  readonly path: Float64Array;
  readonly out: Float64Array;
  readonly row: number;
  private readonly places: number[] = [];
  private constructor(private readonly run: Run, memory: WebAssembly.Memory, m: Module, numbers: number) {
    this.row = m.row;
    const sizes = [numbers, m.channels.length * m.row, (m.outputs + 1) * m.row];
    let end = m.heap;
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
}

/** A table of the file, exact between its points. */
class Pieces {
  private readonly breaks: Float64Array;
  private readonly pieces: Float64Array;
  constructor(private readonly table: Table) {
    this.breaks = series(table.breaks);
    this.pieces = series(table.pieces);
  }
  at(position: number): number {
    const { breaks, pieces } = this, n = breaks.length - 1, { period, order } = this.table;
    const low = breaks[0];
    const x = period ? low + ((((position - low) % period) + period) % period) : Math.min(Math.max(position, low), breaks[n]);
    let a = 0, b = n - 1;
    while (a < b) {
      const c = (a + b + 1) >> 1;
      if (breaks[c] <= x) a = c;
      else b = c - 1;
    }
    let value = 0;
    for (let k = 0; k < order; k++) value = value * (x - breaks[a]) + pieces[k * n + a];
    return value;
  }
}

export class Kernel {
  /** Outputs over the positions: number k of row r stands at r * row + k; the marks are the last row. */
  readonly rows: Float64Array;
  readonly row: number;
  readonly count: number;
  /** Outputs at one place, by row; the mark last. */
  readonly here: Float64Array;
  /** Whether every output is a number there, right or not. */
  finite = true;
  /** 1 at each position that has numbers. */
  readonly good: Uint8Array;
  /** Whether the cycle goes on from its last position to its first. */
  readonly cyclic: boolean;
  readonly values: Float64Array;
  readonly positions: Map<string, Float64Array>;
  private readonly channels: Map<string, { values: Float64Array; pieces?: Pieces; drive: string }>;

  private constructor(private readonly data: Data, private readonly whole: Program, private readonly one: Program, private readonly slope?: Program) {
    this.count = data.kernel.count;
    this.row = data.kernel.row;
    this.values = whole.values;
    this.values.set(data.numbers.map((n) => n.value));
    this.rows = whole.out;
    this.good = new Uint8Array(this.count);
    this.here = new Float64Array(data.kernel.outputs + 1);
    this.positions = new Map(data.drives.map((d) => [d.name, series(d.position)]));
    this.channels = new Map(data.channels.map((c: Channel) => [c.name, {
      values: series(c.values), pieces: c.table && new Pieces(c.table), drive: c.table ? c.table.drive : c.name.replace(/^position /, ""),
    }]));
    data.kernel.channels.forEach((name, k) => {
      const c = this.channels.get(name)!.values;
      for (let p = 0; p < this.row; p++) whole.path[k * this.row + p] = c[Math.min(p, this.count - 1)];
    });
    this.cyclic = !data.only_at_positions && data.drives.some((d) => d.turns && this.closes(d.name));
  }

  static async create(data: Data): Promise<Kernel> {
    const n = data.numbers.length;
    const [whole, here, slope] = await Promise.all([
      Program.create(data.kernel, n), Program.create(data.kernel, n), data.gradient ? Program.create(data.gradient, n) : undefined,
    ]);
    return new Kernel(data, whole, here, slope);
  }

  private closes(drive: string): boolean {
    const q = this.positions.get(drive)!;
    if (q.length < 8) return false;
    const turn = ((q[q.length - 1] - q[0]) * q.length) / (q.length - 1) / (2 * Math.PI);
    return Math.abs(turn) > 0.5 && Math.abs(turn - Math.round(turn)) < 1e-6;
  }

  /** Largest place of the cycle that can be asked for. */
  get end(): number {
    return this.cyclic ? this.count : this.count - 1;
  }

  /** The drive's position at a place t of the cycle, between two positions in proportion. */
  position(drive: string, t: number): number {
    const q = this.positions.get(drive)!, [k, s] = this.split(t);
    if (s === 0 || q.length < 2) return q[k];
    const next = k + 1 < q.length ? q[k + 1] : this.closes(drive) ? q[k] + (q[1] - q[0]) : q[0];
    return q[k] + s * (next - q[k]);
  }

  private split(t: number): Pair {
    const k = Math.min(Math.floor(t), this.count - 1);
    return t >= this.count ? [0, 0] : [k, t - k];
  }

  private input(name: string, t: number): number {
    const c = this.channels.get(name)!, [k, s] = this.split(t);
    if (name.startsWith("position ")) return this.position(name.slice(9), t);
    if (c.pieces && s !== 0) return c.pieces.at(this.position(c.drive, t));
    const next = c.values[k + 1 < this.count ? k + 1 : 0];
    return s === 0 ? c.values[k] : c.values[k] + s * (next - c.values[k]);
  }

  /** All positions with the numbers as they are. */
  cycle(): void {
    this.whole.call(this.count);
    for (let k = 0; k < this.count; k++) this.good[k] = +this.numbered(this.markAt(k));
  }

  /** One place t of the cycle, 0 to `end`. */
  at(t: number): void {
    this.load(this.one, this.data.kernel.channels, t);
    this.one.values.set(this.values);
    this.one.call(1);
    this.finite = true;
    for (let r = 0; r < this.here.length; r++) {
      this.here[r] = this.one.out[r * this.one.row];
      if (!Number.isFinite(this.here[r])) this.finite = false;
    }
  }

  /** The same for other numbers, into `out`; what `at` loaded before stands. */
  other(values: Float64Array, out: Float64Array): void {
    this.one.values.set(values);
    this.one.call(1);
    for (let r = 0; r < out.length; r++) out[r] = this.one.out[r * this.one.row];
  }

  /** Derivatives of a curve (its place among those of the gradient) by the numbers of the gradient, at a position. */
  gradient(curve: number, position: number): Float64Array {
    const g = this.data.gradient!, p = this.slope!;
    this.load(p, g.channels, position);
    p.values.set(this.values);
    p.call(1);
    const n = g.numbers.length;
    return Float64Array.from({ length: n }, (_, k) => p.out[(curve * n + k) * p.row]);
  }

  private load(p: Program, names: string[], t: number): void {
    names.forEach((name, k) => {
      p.path[k * p.row] = p.path[k * p.row + 1] = this.input(name, t);
    });
  }

  /** Whether a mark is one of positions that have numbers. */
  numbered(mark: number): boolean {
    return this.data.statuses[mark].numbered;
  }

  get mark(): number {
    return this.here[this.here.length - 1];
  }

  get solved(): boolean {
    return this.numbered(this.mark);
  }

  /** The mark of a position. */
  markAt(k: number): number {
    return this.rows[this.rows.length - this.row + k];
  }

  value(row: number, k: number): number {
    return this.rows[row * this.row + k];
  }

  /** The largest of something over the positions that have numbers. */
  largest(of: (k: number) => number): number {
    let most = 0;
    for (let k = 0; k < this.count; k++) if (this.good[k]) most = Math.max(most, of(k));
    return most;
  }
}
