/** The compiled analysis of the page: rows of numbers over the cycle and at one place of it. */

import type { Channel, Data, Pair, Table } from "./data";
import { Motion, whole } from "./motion";
import { Program, series } from "./program";
import type { Pose } from "./sketch";
import type { Source } from "./source";

/** Status code of a position that does not close, or that the motion does not reach. */
const OPEN = 1;
/** Positions that are judged in one part of a cycle. */
const SOME = 90;
/** Numbers beyond this, SI, are reported as the cause of an overflow. */
const ABSURD = 1e60;

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

export class Kernel implements Source {
  /** Outputs over the positions: number k of row r is at r * row + k; the status codes are the last row. */
  readonly rows: Float64Array;
  readonly row: number;
  readonly count: number;
  /** Outputs at one place, by row; the status code last. */
  readonly here: Float64Array;
  /** The same just after contacts reverse there; elsewhere equal. */
  readonly hereAfter: Float64Array;
  /** Outputs over the positions just after reversals; ``here`` and ``rows`` are just before them. */
  readonly after: Float64Array;
  /** The channel of the side of reversals; -1 without friction. */
  private readonly side: number;
  /** True if every output is a number at the place, right or not. */
  finite = true;
  coarse = false;
  /** How many cycles were computed. */
  cycles = 0;
  /** 1 at each position that has numbers. */
  readonly good: Uint8Array;
  /** Reason why the analyses refuse the mechanism with these numbers; then no position has numbers. */
  refused = "";
  /** True if the cycle continues from its last position to its first. */
  readonly cyclic: boolean;
  readonly values: Float64Array;
  readonly positions: Map<string, Float64Array>;
  /** The present pose and the motion from it. */
  readonly motion: Motion;
  /** For a linkage that does not close: joints whose two points are apart, with these places. */
  open: { joint: string; p: number[]; q: number[] }[] = [];
  private read: Float64Array;
  private later: Float64Array;
  private readonly channels: Map<string, { values: Float64Array; pieces?: Pieces; drive: string }>;
  private followed: { name: string; channel: number }[];
  private readonly known: Map<string, number>;
  /** Rows of the forces of joints. */
  private readonly forces: number[];

  private constructor(private readonly data: Data, private readonly whole: Program, private readonly one: Program, closure: Program, shown: Program, private readonly slope?: Program) {
    this.count = data.kernel.count;
    this.row = data.kernel.row;
    this.values = whole.values;
    this.values.set(data.numbers.map((n) => n.value));
    this.rows = whole.out;
    this.good = new Uint8Array(this.count);
    this.here = new Float64Array(data.kernel.outputs + 1);
    this.hereAfter = new Float64Array(data.kernel.outputs + 1);
    this.side = data.kernel.channels.indexOf("side");
    this.after = this.side < 0 ? this.rows : this.rows.slice();
    [this.read, this.later] = [this.rows, this.after];
    this.positions = new Map(data.drives.map((d) => [d.name, series(d.position)]));
    this.channels = new Map(data.channels.map((c: Channel) => [c.name, {
      values: series(c.values), pieces: c.table && new Pieces(c.table), drive: c.table ? c.table.drive : c.name.replace(/^position /, ""),
    }]));
    const given = new Set([...data.sketch.branches, ...data.sketch.known]);
    this.forces = data.views.mechanism.arrows.flatMap((a) => (a.kind === "joint" && a.t === "force" ? a.f : []));
    this.followed = data.kernel.channels.flatMap((name, channel) => (given.has(name) || name.startsWith("phase ") ? [{ name, channel }] : []));
    this.known = new Map(data.sketch.known.map((name, k) => [name, data.sketch.branches.length + k]));
    data.kernel.channels.forEach((name, k) => {
      const c = this.channels.get(name)!.values;
      for (let p = 0; p < this.row; p++) whole.path[k * this.row + p] = c[Math.min(p, this.count - 1)];
    });
    if (this.side >= 0) whole.path.fill(-1, this.side * this.row, (this.side + 1) * this.row);
    const all = (name: string): Float64Array => this.channels.get(name)?.values ?? new Float64Array(this.count);
    this.motion = new Motion(data, this, closure, shown, this.values, all);
    this.cyclic = !data.only_at_positions && data.drives.some((d) => d.turns && this.isWholeTurn(d.name));
  }

  static async create(data: Data): Promise<Kernel> {
    const n = data.numbers.length;
    const [whole, here, closure, shown, slope] = await Promise.all([
      Program.create(data.kernel, n), Program.create(data.kernel, n), Program.create(data.sketch.closure, n), Program.create(data.sketch.shown, n), data.gradient ? Program.create(data.gradient, n) : undefined,
    ]);
    return new Kernel(data, whole, here, closure, shown, slope);
  }

  private isWholeTurn(drive: string): boolean {
    const q = this.positions.get(drive)!;
    if (q.length < 8) return false;
    const turn = ((q[q.length - 1] - q[0]) * q.length) / (q.length - 1) / (2 * Math.PI);
    return Math.abs(turn) > 0.5 && Math.abs(turn - Math.round(turn)) < 1e-6;
  }

  /** Largest place of the cycle that can be requested. */
  get end(): number {
    return this.cyclic ? this.count : this.count - 1;
  }

  /** The drive's position at a place t of the cycle, between two positions in proportion. */
  position(drive: string, t: number): number {
    const q = this.positions.get(drive)!, [k, s] = this.split(t);
    if (s === 0 || q.length < 2) return q[k];
    const next = k + 1 < q.length ? q[k + 1] : this.isWholeTurn(drive) ? q[k] + (q[1] - q[0]) : q[0];
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

  /** All positions with the present numbers; those that the motion does not reach are flagged. */
  cycle(): void {
    whole(this.cycling());
  }

  /** The same a part at a time, of the numbers of the first part, while the present ones may change. */
  *parts(): Generator<void> {
    const { values } = this, mine = values.slice(), now = values.slice(), steps = this.cycling();
    for (let done = false; !done; ) {
      now.set(values);
      values.set(mine);
      done = !!steps.next().done;
      values.set(now);
      yield;
    }
  }

  private *cycling(): Generator<void> {
    if (this.motion.current) this.closes();
    else yield* this.motion.updating();
    if (this.side >= 0) this.bothSides();
    const last = this.rows.length - this.row;
    let k = 0;
    const value = (r: number): number => this.rows[r * this.row + k];
    for (; k < this.count; k++) {
      if (k % SOME === 0) yield;
      this.rows[last + k] = this.motion.poses[k] ? this.judged(this.rows[last + k], value) : OPEN;
      this.good[k] = +this.numbered(this.markAt(k));
    }
    this.cycles++;
  }

  /** Evaluates all positions with the inputs of the motion; true where it closes. */
  closes(): Uint8Array {
    for (const { name, channel } of this.followed) this.whole.path.set(this.channels.get(name)!.values, channel * this.row);
    this.whole.call(this.count);
    return Uint8Array.from({ length: this.count }, (_, k) => +(this.markAt(k) !== OPEN));
  }

  /** Numbers just after reversals of contacts; status codes of positions where they differ from those just before. */
  private bothSides(): void {
    const { path, out } = this.whole, from = this.side * this.row, before = out.slice();
    path.fill(1, from, from + this.row);
    this.whole.call(this.count);
    this.after.set(out);
    out.set(before);
    path.fill(-1, from, from + this.row);
    const last = out.length - this.row;
    for (let k = 0; k < this.count; k++) out[last + k] = this.between(out[last + k], this.after[last + k], (r) => out[r * this.row + k] === this.after[r * this.row + k]);
  }

  /** The status code of a position from those just before and just after, and whether a row is equal on both sides. */
  private between(before: number, after: number, same: (row: number) => boolean): number {
    if (before !== after) return this.numbered(before) ? after : before;
    const reverses = this.numbered(before) && !this.here.every((_, r) => r === this.here.length - 1 || same(r));
    return reverses && before === 0 ? this.marked("reversal") : before;
  }

  /** A status code, or that of an overflow, where some row is not finite because of extreme numbers. */
  private judged(mark: number, value: (row: number) => number): number {
    const still = this.data.statuses[mark]?.status === "contact_lost" && this.forces.every((r) => Math.abs(value(r)) <= this.data.noise.force);
    if (still) return 0; // a force of zero has no sense
    if (mark === OPEN || (!this.numbered(mark) && this.data.statuses[mark].status !== "undecided")) return mark;
    const absurd = this.numbered(mark) || this.values.some((x) => Math.abs(x) > ABSURD);
    for (let r = 0; absurd && r < this.here.length - 1; r++) if (!Number.isFinite(value(r))) return this.marked("overflow");
    return mark;
  }

  private marked(status: string): number {
    return this.data.statuses.findIndex((s) => s.status === status);
  }

  closesAt(t: number): boolean {
    this.run(t, null, this.motion.branches.model);
    return this.one.at(this.here.length - 1) !== OPEN;
  }

  posed(k: number): number[][] {
    return this.data.sketch.poses.map((rows) => rows.map((row) => this.value(row, k)));
  }

  get stepped(): boolean {
    return this.data.only_at_positions;
  }

  drives(t: number): number[] {
    return this.data.drives.map((d) => this.position(d.name, t));
  }

  /** One place t of the cycle, 0 to `end`; if the linkage does not close, the present pose is drawn, open at a
   * joint. */
  at(t: number): void {
    const pose = this.coarse ? this.motion.near(t) : this.motion.at(t), { here } = this;
    this.run(t, pose, pose ? this.motion.branches.read(pose, t) : this.motion.branches.model);
    for (let r = 0; r < here.length; r++) [here[r], this.hereAfter[r]] = [this.one.at(r), this.one.at(r, 1)];
    const last = here.length - 1, reverses = this.side >= 0 ? this.between(here[last], this.hereAfter[last], (r) => here[r] === this.hereAfter[r]) : here[last];
    here[last] = this.judged(reverses, (r) => here[r]);
    if (!pose) here[here.length - 1] = OPEN;
    this.open = [];
    if (!pose || !here.every(Number.isFinite)) this.stretch(pose ?? this.motion.stretched(t), t);
    this.finite = this.data.sketch.drawn.every((r) => Number.isFinite(here[r]));
  }

  /** Drawn rows of a pose that need not close. */
  private stretch(pose: Pose, t: number): void {
    const { sketch } = this.data, p = this.motion.branches.look(pose, t, this.motion.branches.model), first = sketch.branches.length + sketch.known.length;
    sketch.drawn.forEach((row, k) => (this.here[row] = p.at(first + k)));
    const at = (rows: number[]): number[] => rows.map((r) => p.at(r));
    const gaps = sketch.gaps.map((g) => ({ joint: g.joint, p: at(g.p), q: at(g.q) })), size = gaps.map((g) => Math.hypot(...g.p.map((x, k) => x - g.q[k])));
    const seen = Math.max(1e-6 * sketch.length, 0.02 * Math.max(...size));
    this.open = gaps.filter((_, k) => size[k] > seen);
  }

  /** The single-position program at a place, with its branches and the known quantities of the pose. */
  private run(t: number, pose: Pose | null, branch: Float64Array): void {
    this.feed(this.one, this.data.kernel.channels, t, pose, branch);
    this.one.values.set(this.values);
    this.one.call(1);
  }

  private feed(p: Program, names: string[], t: number, pose: Pose | null, branch: Float64Array): void {
    const found = pose && this.data.sketch.known.length ? this.motion.branches.look(pose, t, branch) : null;
    names.forEach((name, k) => {
      const b = this.data.sketch.branches.indexOf(name), known = this.known.get(name);
      if (name === "side") return p.put(k, -1, 1);
      p.put(k, b >= 0 ? branch[b] : known !== undefined ? found?.at(known) ?? NaN : this.input(name, t));
    });
  }

  /** The same for other numbers, into `out`, on the branches that `at` has loaded. */
  other(values: Float64Array, out: Float64Array): void {
    this.one.values.set(values);
    this.one.call(1);
    for (let r = 0; r < out.length; r++) out[r] = this.one.at(r);
  }

  /** Derivatives of a curve (its index among those of the gradient) by the numbers of the gradient, at a position. */
  gradient(curve: number, position: number): Float64Array {
    const g = this.data.gradient!, p = this.slope!;
    const pose = this.motion.poses[position];
    this.feed(p, g.channels, position, pose, Float64Array.from(this.motion.branches.of, (of) => of[position]));
    p.values.set(this.values);
    p.call(1);
    const n = g.numbers.length;
    return Float64Array.from({ length: n }, (_, k) => p.at(curve * n + k));
  }

  /** True for a status code of positions that have numbers. */
  numbered(mark: number): boolean {
    return !this.refused && this.data.statuses[mark].numbered;
  }

  /** The present numbers and pose, for a later restore. */
  state(): Float64Array {
    return Float64Array.from([...this.values, ...this.motion.state()]);
  }

  restore(state: Float64Array): void {
    const n = this.values.length;
    this.values.set(state.subarray(0, n));
    this.motion.restore([...state.subarray(n)]);
  }

  get mark(): number {
    return this.here[this.here.length - 1];
  }

  get solved(): boolean {
    return this.numbered(this.mark);
  }

  /** The status code of a position. */
  markAt(k: number): number {
    return this.rows[this.rows.length - this.row + k];
  }

  value(row: number, k: number): number {
    return this.read[row * this.row + k];
  }

  /** True if contacts reverse at a position. */
  reverses(k: number): boolean {
    return this.side >= 0 && this.data.statuses[this.markAt(k)].status === "reversal";
  }

  /** A value computed just after reversals. */
  onceAfter<T>(of: () => T): T {
    [this.read, this.later] = [this.later, this.read];
    try {
      return of();
    } finally {
      [this.read, this.later] = [this.later, this.read];
    }
  }

  /** The largest value over the positions that have numbers, on both sides of reversals. */
  largest(of: (k: number) => number): number {
    let most = 0;
    for (let k = 0; k < this.count; k++) if (this.good[k]) most = Math.max(most, of(k), this.reverses(k) ? this.onceAfter(() => of(k)) : 0);
    return most;
  }
}
