/** Closing and following a linkage: Newton on the rows of the sketch program. This file contains no code for
 * types of joints. Coordinates of a step: lengths over `length`, and angles (in space turns about the axes). */

import type { SketchData, SketchRow } from "./data";
import type { Program } from "./program";

export interface Pose { point: Float64Array; rotation: Float64Array; turn: Float64Array }
export interface Step { pose: Pose; first: number; rest: number }

/** Residual of a row, over `length`, at which a pose closes; and the rounding level. */
export const OPEN = 1e-9;
const CLOSED = 1e-12;
/** Longest displacement of one step; damping, which gives the least displacement with redundant rows. */
export const LONGEST = 0.25;
const DAMPING = 1e-13, LEAST = 1e-9;
/** Stiffness of the other joints relative to the opened one. */
const STIFF = 1e5;
/** Search for gaps: stiffness of drives relative to joints, and initial rotation of the links, radians. */
const HELD = 1e3, ASIDE = 0.05;
/** Relative size of pivots that count as zero: a pose closed to 1e-12 has the root of this error at a change point. */
const FLAT = 1e-5;

/** What the solver needs of the data. */
export type Rigid = Pick<SketchData, "dimension" | "length" | "links" | "order" | "rows" | "entries" | "turns" | "drives">;

type Entry = [column: number, output: number, scale: number];

export const copied = (q: Pose): Pose => ({ point: q.point.slice(), rotation: q.rotation.slice(), turn: q.turn.slice() });

export class Sketch {
  /** Targets of the rows, and the rows in use. */
  readonly hold: Float64Array;
  protected readonly active: Uint8Array;
  protected readonly weight: Float64Array;
  protected readonly missing: Float64Array;
  private readonly byRow: Entry[][];
  protected readonly place: number[];
  protected readonly first: Int32Array;
  protected readonly start: Int32Array;
  protected readonly matrix: Float64Array;
  protected readonly right: Float64Array;
  private readonly inputs: [keyof Pose, number][];
  protected readonly n: number;
  protected readonly size: number;

  constructor(readonly data: Rigid, private readonly program: Program) {
    const n = (this.n = data.dimension === 2 ? 3 : 6), rows = data.rows;
    this.size = n * data.links.length;
    this.place = data.links.map((_, k) => data.order.indexOf(k));
    this.hold = new Float64Array(rows.length);
    this.missing = new Float64Array(rows.length);
    this.weight = new Float64Array(rows.length).fill(1);
    this.active = Uint8Array.from(rows, (r, k) => +(r.kind !== "freedom" || data.drives.includes(k)));
    this.inputs = program.module.channels.map((name) => {
      const [, part, k] = name.split(" ");
      return [part as keyof Pose, +k];
    });
    this.byRow = rows.map(() => []);
    for (let e = 0; e < data.entries.length; e += 3) {
      const [row, column, output] = data.entries.slice(e, e + 3), c = column % n, link = (column - c) / n;
      const scale = (c < data.dimension ? data.length : 1) * (rows[row].angular ? 1 : 1 / data.length);
      this.byRow[row].push([n * this.place[link] + c, output, scale]);
    }
    for (const r of this.byRow) r.sort((a, b) => a[0] - b[0]);
    [this.first, this.start] = this.profile();
    this.matrix = new Float64Array(this.start[this.size]);
    this.right = new Float64Array(this.size);
  }

  /** First column of each row of J^T J, and where its entries begin. */
  private profile(): [Int32Array, Int32Array] {
    const first = Int32Array.from({ length: this.size }, (_, k) => k - (k % this.n)), start = new Int32Array(this.size + 1);
    for (const r of this.byRow) for (const [column] of r) first[column] = Math.min(first[column], r[0][0]);
    for (let k = 0; k < this.size; k++) start[k + 1] = start[k] + k - first[k] + 1;
    return [first, start];
  }

  set values(all: Float64Array) {
    this.program.values.set(all);
  }

  /** True if some rows are in use. */
  count(rows: number[], on: boolean): void {
    for (const row of rows) this.active[row] = +on;
  }

  private evaluate(q: Pose): void {
    this.inputs.forEach(([part, k], channel) => this.program.put(channel, q[part][k]));
    this.program.call(1);
  }

  /** Residual of each row, over `length`; the largest of those in use. */
  gap(q: Pose): number {
    this.evaluate(q);
    let most = 0;
    this.data.rows.forEach((r, k) => {
      let x = this.hold[k] - this.program.at(r.value);
      if (r.period !== undefined) x -= this.program.at(r.period) * Math.round(x / this.program.at(r.period));
      this.missing[k] = r.angular ? x : x / this.data.length;
      if (this.active[k]) most = Number.isFinite(x) ? Math.max(most, Math.abs(this.missing[k])) : Infinity;
    });
    return most;
  }

  /** What is missing in each row with the drives at some positions. */
  misses(q: Pose, drives: number[]): Float64Array {
    this.drive(drives);
    this.gap(q);
    return this.missing;
  }

  /** The measure of a row at a pose. */
  measure(row: number, q: Pose): number {
    this.evaluate(q);
    return this.program.at(this.data.rows[row].value);
  }

  /** The largest gap of each joint at a pose, metres. */
  gaps(q: Pose): Map<string, number> {
    const found = new Map<string, number>();
    this.gap(q);
    this.data.rows.forEach((r, k) => {
      if (r.kind === "constraint" && !r.angular) found.set(r.joint, Math.hypot(found.get(r.joint) ?? 0, this.missing[k] * this.data.length));
    });
    return found;
  }

  /** (J^T W J + damping I) dq = J^T W missing at the pose last evaluated; the size of dq. */
  private solve(damping: number): number {
    this.fill(damping);
    return this.answer();
  }

  /** The system of the rows in use. */
  protected fill(damping: number): void {
    const { matrix, right, first, start, size, program } = this;
    matrix.fill(0);
    right.fill(0);
    for (let k = 0; k < size; k++) matrix[start[k] + k - first[k]] = damping;
    this.byRow.forEach((r, row) => {
      if (!this.active[row]) return;
      const w = this.weight[row];
      for (let a = 0; a < r.length; a++) {
        const [ca, oa, sa] = r[a], ja = w * sa * program.at(oa);
        right[ca] += ja * this.missing[row];
        for (let b = 0; b <= a; b++) matrix[start[ca] + r[b][0] - first[ca]] += ja * r[b][2] * program.at(r[b][1]);
      }
    });
  }

  /** Solves it; the largest component of the step, which stands in `right`. */
  protected answer(): number {
    this.cholesky();
    let most = 0;
    for (const x of this.right) most = Math.max(most, Math.abs(x));
    return Number.isFinite(most) ? most : Infinity;
  }

  /** Within the profile; the solution takes the place of the right side. */
  private cholesky(): void {
    const { matrix, right, first, start, size } = this;
    for (let i = 0; i < size; i++) {
      const fi = first[i], si = start[i] - fi;
      for (let j = fi; j <= i; j++) {
        const fj = first[j], sj = start[j] - fj;
        let x = matrix[si + j];
        for (let k = Math.max(fi, fj); k < j; k++) x -= matrix[si + k] * matrix[sj + k];
        matrix[si + j] = i === j ? Math.sqrt(Math.max(x, 1e-30)) : x / matrix[sj + j];
      }
      let y = right[i];
      for (let k = fi; k < i; k++) y -= matrix[si + k] * right[k];
      right[i] = y / matrix[si + i];
    }
    for (let i = size - 1; i >= 0; i--) {
      const si = start[i] - first[i], x = (right[i] /= matrix[si + i]);
      for (let k = first[i]; k < i; k++) right[k] -= matrix[si + k] * x;
    }
  }

  /** The pose after a part of the step. */
  protected moved(q: Pose, part: number): Pose {
    const { n, data, right } = this, d = data.dimension, out = copied(q);
    data.links.forEach((_, k) => {
      const at = n * this.place[k];
      for (let c = 0; c < d; c++) out.point[d * k + c] += part * data.length * right[at + c];
      if (d === 2) {
        out.turn[k] += part * right[at + 2];
        out.rotation[2 * k] = Math.cos(out.turn[k]);
        out.rotation[2 * k + 1] = Math.sin(out.turn[k]);
      } else turnMatrix(out.rotation, 9 * k, part * right[at + 3], part * right[at + 4], part * right[at + 5]);
    });
    if (data.turns.length) {
      this.evaluate(out);
      data.turns.forEach((output, k) => (out.turn[k] = this.program.at(output)));
    }
    return out;
  }

  /** Newton from a pose: the pose that closes, the size of the first step and of all later ones; null where none is met. */
  correct(q: Pose, reach = Infinity, passes = 12, damping = LEAST): Step | null {
    let size = this.gap(q), first = 0, rest = 0;
    for (let pass = 0; pass < passes; pass++) {
      if (size <= CLOSED) return { pose: q, first, rest };
      if (!Number.isFinite(size)) return null;
      const step = this.solve(damping);
      if (pass) rest += step;
      else first = step;
      if (!(first + rest <= reach)) return null;
      const next = this.moved(q, Math.min(1, LONGEST / step)), left = this.gap(next);
      if (left <= OPEN && left > 0.5 * size) return { pose: left < size ? next : q, first, rest }; // rounding
      [q, size] = [next, left];
    }
    return size <= OPEN ? { pose: q, first, rest } : null;
  }

  /** The largest displacement between two poses: radians, or lengths over `length`. */
  apart(a: Pose, b: Pose): number {
    let most = 0;
    a.point.forEach((x, k) => (most = Math.max(most, Math.abs(x - b.point[k]) / this.data.length)));
    const [p, q] = this.data.dimension === 2 ? [a.turn, b.turn] : [a.rotation, b.rotation];
    p.forEach((x, k) => (most = Math.max(most, Math.abs(x - q[k]))));
    return most;
  }

  private drive(to: number[]): void {
    this.data.drives.forEach((row, k) => (this.hold[row] = to[k]));
  }

  /** The pose nearest to another, with the drives at some positions. */
  close(q: Pose, drives: number[], reach = Infinity): Pose | null {
    this.drive(drives);
    return this.correct(q, reach, 40)?.pose ?? null;
  }

  /** From one position of the drives to another on one branch, in steps that are halved where the correction is large
   * beside the way; null where no step is small enough: a dead centre. */
  walk(trail: Trail, to: number[]): Pose | null {
    const from = trail.drives, way = Math.max(...to.map((x, k) => Math.abs(x - from[k])), 0);
    if (way === 0) return trail.pose;
    let part = 1, done = 0;
    while (done < 1) {
      const next = done + part > 1 - 1e-12 ? 1 : done + part;
      const drives = to.map((x, k) => (next === 1 ? x : from[k] + next * (x - from[k])));
      const q = this.stride(trail, drives, (next - done) * way);
      if (q) {
        trail.add(q, drives, (next - done) * way);
        done = next;
        part = Math.min(1, 2 * part);
      } else if ((part /= 2) < 2 ** -14) return null;
    }
    return trail.pose;
  }

  /** One step, from a guess along the last stations, or along the tangent. */
  private stride(trail: Trail, drives: number[], way: number): Pose | null {
    this.drive(drives);
    const guess = this.data.dimension === 2 ? trail.ahead(way) : null;
    if (guess) {
      const found = this.correct(guess, 0.5, 12, DAMPING), travel = this.apart(guess, trail.pose);
      if (found && found.first + found.rest <= 0.1 * travel + 1e-7) return found.pose;
    }
    const found = this.correct(trail.pose, 0.6, 10, trail.stations > 1 ? DAMPING : LEAST);
    return found && found.first <= 0.5 && found.rest <= 0.15 * found.first + 1e-9 && !(guess && found.first > 3 * this.apart(guess, trail.pose) + 1e-6) ? found.pose : null;
  }

  /** Where nothing closes: the pose with the least gaps, all of it in one joint as far as that can be. */
  loosen(q: Pose, drives: number[], joint: string): Pose {
    return this.least(q, drives, (r) => (r.joint === joint && r.kind === "constraint" ? 1 : STIFF), 60);
  }

  /** The least gaps of all joints, from a pose whose links are turned a little: links in one line would stay in it. */
  open(q: Pose, drives: number[]): { pose: Pose; gaps: { joint: string; length: number; angle: number }[] } {
    const { n, right, data } = this, d = data.dimension, found = new Map<string, [number, number]>();
    right.fill(0);
    data.links.forEach((_, k) => {
      for (let c = d; c < n; c++) right[n * this.place[k] + c] = ASIDE * Math.cos(k * (n - d) + c - d);
    });
    const least = this.least(this.moved(q, 1), drives, (r) => (r.kind === "freedom" ? HELD * HELD : 1), 300, Infinity, 1);
    this.gap(least);
    data.rows.forEach((r, k) => {
      if (r.kind === "freedom" || !r.joint) return;
      const [length, angle] = found.get(r.joint) ?? [0, 0], x = this.missing[k];
      found.set(r.joint, r.angular ? [length, Math.hypot(angle, x)] : [Math.hypot(length, x * data.length), angle]);
    });
    return { pose: least, gaps: [...found].map(([joint, [length, angle]]) => ({ joint, length, angle })) };
  }

  /** What the joints of a pose leave free: how many freedoms, and with the drives at rest the links and joints that
   * still move. By elimination with full pivots. */
  mobility(q: Pose): { freedoms: number; links: string[]; joints: SketchRow[] } {
    const { data, size, n } = this, of = (k: number): number[] => {
      const out = Array<number>(size).fill(0);
      for (const [column, output, scale] of this.byRow[k]) out[column] = scale * this.program.at(output);
      return out;
    };
    this.evaluate(this.correct(q, Infinity, 60)?.pose ?? q);
    const rows = data.rows.map((r, k) => ({ r, k, j: of(k) })), held = rows.filter(({ r }) => r.kind !== "freedom");
    const driven = rows.filter(({ k }) => data.drives.includes(k)), idle = nullSpace([...held, ...driven].map(({ j }) => [...j]), size);
    const moves = (j: number[]): boolean => idle.some((v) => Math.abs(v.reduce((t, x, c) => t + x * j[c], 0)) > 1e-6);
    return {
      freedoms: nullSpace(held.map(({ j }) => [...j]), size).length,
      links: data.links.filter((_, k) => idle.some((v) => v.slice(n * this.place[k], n * this.place[k] + n).some((x) => Math.abs(x) > 1e-6))),
      joints: rows.flatMap(({ r, j }) => (r.kind === "freedom" && moves(j) ? [r] : [])),
    };
  }

  /** Damped least squares of what is missing, by weights of the rows. */
  private least(q: Pose, drives: number[], weight: (r: SketchRow) => number, passes: number, longest = LONGEST, damping = 1e-3): Pose {
    this.drive(drives);
    this.data.rows.forEach((r, k) => (this.weight[k] = weight(r)));
    const miss = (): number => this.missing.reduce((t, x, k) => t + (this.active[k] ? this.weight[k] * x * x : 0), 0);
    let now = (this.gap(q), miss());
    for (let pass = 0; pass < passes && damping < 1e8; pass++) {
      const step = this.solve(damping), next = this.moved(q, Math.min(1, longest / step));
      const open = this.gap(next), then = Number.isFinite(open) ? miss() : Infinity;
      if (then < now) {
        const small = now - then < 1e-12 * now;
        [q, now, damping] = [next, then, Math.max(damping / 4, 1e-9)];
        if (small) break;
      } else {
        damping *= 8;
        this.gap(q);
      }
    }
    this.weight.fill(1);
    return q;
  }
}

/** Vectors that a matrix takes to zero, each with a largest component of 1. */
function nullSpace(m: number[][], size: number): number[][] {
  const columns = Array.from({ length: size }, (_, c) => c), pivots: number[] = [];
  const most = Math.max(0, ...m.flat().map(Math.abs));
  for (let p = 0; p < Math.min(m.length, size); p++) {
    let best = 0, row = p, column = p;
    for (let i = p; i < m.length; i++) for (let c = p; c < size; c++) if (Math.abs(m[i][columns[c]]) > best) [best, row, column] = [Math.abs(m[i][columns[c]]), i, c];
    if (!(best > FLAT * most)) break;
    [m[p], m[row]] = [m[row], m[p]];
    [columns[p], columns[column]] = [columns[column], columns[p]];
    const pivot = columns[p], lead = m[p][pivot];
    m[p] = m[p].map((x) => x / lead);
    for (let i = 0; i < m.length; i++) if (i !== p && m[i][pivot] !== 0) {
      const part = m[i][pivot];
      m[i] = m[i].map((x, c) => x - part * m[p][c]);
    }
    pivots.push(pivot);
  }
  return columns.slice(pivots.length).map((free) => {
    const v = Array<number>(size).fill(0);
    v[free] = 1;
    pivots.forEach((c, i) => (v[c] = -m[i][free]));
    const large = Math.max(...v.map(Math.abs));
    return v.map((x) => x / large);
  });
}

/** The last stations of a walk. */
export class Trail {
  private past: { pose: Pose; back: number }[] = [];
  stations = 1;
  constructor(public pose: Pose, public drives: number[]) {}
  add(pose: Pose, drives: number[], way: number): void {
    this.past = [{ pose: this.pose, back: 0 }, ...this.past].slice(0, 2).map((p) => ({ ...p, back: p.back + way }));
    [this.pose, this.drives] = [pose, drives];
    this.stations++;
  }
  /** The parabola through the last three stations, or the line through two, farther on. */
  ahead(way: number): Pose | null {
    const { past, pose } = this, [a, b] = past;
    if (!a || !(a.back > 0)) return null;
    const x = way, u = a.back, v = b?.back ?? 0, three = b !== undefined && v > u;
    const w = three ? [((x + u) * (x + v)) / (u * v), (x * (x + v)) / (u * (u - v)), (x * (x + u)) / (v * (v - u))] : [1 + x / u, -x / u, 0];
    const at = (part: "point" | "turn"): Float64Array =>
      pose[part].map((y, k) => w[0] * y + w[1] * a.pose[part][k] + (three ? w[2] * b.pose[part][k] : 0));
    const out = { point: at("point"), turn: at("turn"), rotation: pose.rotation.slice() };
    out.turn.forEach((t, k) => ([out.rotation[2 * k], out.rotation[2 * k + 1]] = [Math.cos(t), Math.sin(t)]));
    return out;
  }
}

/** A matrix, row by row from a place on, turned about an axis by the length of (x, y, z). */
function turnMatrix(r: Float64Array, at: number, x: number, y: number, z: number): void {
  const t = Math.hypot(x, y, z);
  if (t < 1e-300) return;
  const s = Math.sin(t) / t, c = (1 - Math.cos(t)) / (t * t), o = r.slice(at, at + 9);
  const m = [
    1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y,
    c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x,
    c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y),
  ];
  for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) r[at + 3 * i + j] = m[3 * i] * o[j] + m[3 * i + 1] * o[3 + j] + m[3 * i + 2] * o[6 + j];
}
