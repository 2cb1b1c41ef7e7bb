/** The motion of the linkage from the present pose: that pose is closed again after each change of numbers, and
 * followed over the full cycle; so the assembly mode is known, and stays that of the present pose. */

import { Branches } from "./branches";
import type { Data, SketchData } from "./data";
import type { Program } from "./program";
import { Between, placedPose, posed, turnOf, wrap } from "./poses";
import { copied, type Pose, Sketch, Trail } from "./sketch";

/** Functions of the kernel that the motion needs. */
export interface Closing {
  /** The drives at a place of the cycle. */
  drives(t: number): number[];
  /** Sets the inputs of the known motion at every position, and evaluates all; true where it closes. */
  closes(): Uint8Array;
  /** True if it closes at one place, on the branches used where nothing is reached. */
  closesAt(t: number): boolean;
  /** The links' poses at a position in the kernel: rows of `sketch.poses`. */
  posed(k: number): number[][];
  /** The largest place of the cycle, and whether only listed positions are places. */
  readonly end: number;
  readonly stepped: boolean;
}

/** A pose and the numbers to which it belongs. */
interface Held { values: Float64Array; t: number; pose: Pose }

/** Subdivisions of the step between two positions in the search for a gap. */
const BETWEEN = 8;
/** Positions that are followed one by one; of more only some, with interpolation between them. */
const STATIONS = 120;
/** Largest move of a link from frame to frame that is made at once; fractions of a change that are tried. */
const REACH = 0.3, SMALLEST = 2 ** -7;

export class Motion {
  readonly sketch: Sketch;
  readonly data: SketchData;
  /** Poses of the positions that are reached, null of others. */
  poses: (Pose | null)[];
  readonly branches: Branches;
  private readonly count: number;
  private readonly first: Held;
  private held: Held;
  private base: { place: number; pose: Pose };
  private loose: { t: number; pose: Pose } | null = null;
  /** The numbers of the last accepted pose. */
  private seen: Float64Array | null = null;
  private readonly phases: number[];
  private readonly phasesAtFirst: number[];
  private readonly weakest: string;

  constructor(data: Data, private readonly kernel: Closing, closure: Program, shown: Program, private readonly values: Float64Array, private readonly inputs: (name: string) => Float64Array) {
    const s = (this.data = data.sketch);
    this.sketch = new Sketch(s, closure);
    this.count = data.kernel.count;
    this.poses = Array<Pose | null>(this.count).fill(null);
    this.branches = new Branches(s, data.drives.map((d) => d.name), kernel, shown, values, inputs, this.count);
    this.phases = s.rows.flatMap((r, k) => (r.kind === "phase" ? [k] : []));
    const [point, rotation, turn] = [s.pose.point, s.pose.rotation, s.pose.turn].map((x) => Float64Array.from(x));
    this.first = { values: Float64Array.from(data.numbers, (n) => n.value), t: s.place, pose: { point, rotation, turn } };
    this.sketch.values = this.first.values;
    this.phasesAtFirst = this.phases.map((row) => this.sketch.measure(row, this.first.pose));
    this.held = this.first;
    this.base = { place: s.place, pose: this.first.pose };
    this.weakest = weakest(s);
    this.home();
  }

  /** The file's pose and numbers. */
  private home(): void {
    this.hold(this.phasesAtFirst);
    this.held = this.first;
    this.base = { place: this.first.t, pose: this.first.pose };
    [this.seen, this.loose] = [null, null];
  }

  private hold(phases: number[]): void {
    this.phases.forEach((row, k) => this.inputs(`phase ${row}`).fill((this.sketch.hold[row] = phases[k])));
  }

  /** After all numbers were replaced at once: the pose is the file's, or that of the numbers of an assembly. */
  assume(assembly: number[] | null): void {
    this.home();
    if (!assembly) return;
    const stated = posed(this.data, this.held.pose, assembly), { sketch } = this;
    sketch.values = this.values;
    sketch.count(this.phases, false);
    for (const place of [...this.data.places, ...Array(this.count).keys()]) {
      const guess = this.wound(stated, this.kernel.drives(place));
      const pose = sketch.close(guess, this.kernel.drives(place));
      if (!pose || this.turned(pose, guess) > 1e-6) continue;
      this.held = { values: this.values.slice(), t: place, pose };
      this.hold(this.phases.map((row) => sketch.measure(row, pose)));
      break;
    }
    sketch.count(this.phases, true);
  }

  private turned(a: Pose, b: Pose): number {
    const [p, q] = this.data.dimension === 2 ? [a.turn, b.turn] : [a.rotation, b.rotation];
    return p.reduce((most, x, k) => Math.max(most, Math.abs(x - q[k])), 0);
  }

  /** True if the motion of the present numbers is known. */
  get current(): boolean {
    return !!this.seen?.every((x, k) => x === this.values[k]);
  }

  /** Closes the present pose for the present numbers, and follows the motion from it, unless that has been done. */
  private update(): void {
    if (!this.current) whole(this.updating());
  }

  /** The same a part at a time; the numbers are those of the first part in all. */
  *updating(): Generator<void> {
    this.seen = null;
    const { t, pose } = this.reclose() ? this.held : { t: this.base.place, pose: null };
    this.poses.fill(null);
    if (pose) yield* this.follow(t, pose);
    yield* this.settle(pose ?? this.base.pose, t);
    this.seen = this.values.slice();
  }

  /** The present pose for other numbers: at once, else in small steps of the change; false if it does not close. */
  private reclose(): boolean {
    const to = this.values, drives = this.kernel.drives(this.held.t), { sketch } = this;
    if (this.loose) {
      sketch.values = to;
      const pose = sketch.close(this.loose.pose, this.kernel.drives(this.loose.t), REACH);
      if (pose) this.held = { values: to.slice(), t: this.loose.t, pose };
      this.loose = null;
      if (pose) return true;
    }
    const from = this.held.values;
    let part = 1, done = 0;
    while (done < 1) {
      const next = Math.min(1, done + part), mixed = to.map((x, k) => (next === 1 ? x : from[k] + next * (x - from[k])));
      sketch.values = mixed;
      const pose = sketch.close(this.held.pose, drives, REACH);
      if (pose) {
        this.held = { values: mixed, t: this.held.t, pose };
        [done, part] = [next, Math.min(1, 2 * part)];
      } else if ((part /= 2) < SMALLEST) return false;
    }
    return true;
  }

  /** Fills in the positions that the motion from a pose reaches, in both directions, and around if the list is a
   * cycle. */
  private *follow(t: number, pose: Pose): Generator<void> {
    const { course, cycle } = this.data, n = this.count, start = this.along(t), from = this.kernel.drives(t);
    const up = yield* this.march(new Trail(pose, from), Math.ceil(start), 1, null);
    const down = yield* this.march(new Trail(pose, from), Math.floor(start), -1, null);
    if (!cycle || this.phases.length) return;
    if (up && this.poses[course[n - 1]]) yield* this.march(up, 0, 1, cycle);
    if (down && this.poses[course[0]]) yield* this.march(down, n - 1, -1, cycle);
  }

  /** Place of the cycle along the course: an integer at a listed position, else halfway between two. */
  private along(t: number): number {
    const { course } = this.data;
    if (Number.isInteger(t) && t < this.count) return course.indexOf(t);
    const ordered = course.every((k, i) => k === i), x = this.kernel.drives(t)[0];
    return (ordered ? Math.ceil(t) : course.findIndex((k) => this.kernel.drives(k)[0] > x)) - 0.5;
  }

  /** From position to position of the course; the trail at its end, null at a dead centre. */
  private *march(trail: Trail, from: number, sign: number, cycle: number[] | null): Generator<void, Trail | null> {
    const { course } = this.data, n = this.count, skip = this.data.dimension === 2 ? Math.ceil(n / STATIONS) : 1;
    const more = (cycle ?? []).map((c) => sign * (cycle!.length > 1 ? c : Math.abs(c))), turns = this.counts((row) => more[this.data.drives.indexOf(row)] ?? 0);
    const drives = (k: number): number[] => this.kernel.drives(course[k]).map((x, d) => x + (more[d] ?? 0));
    const put = (k: number, pose: Pose): void => {
      if (!cycle) this.poses[course[k]] = pose;
      else this.poses[course[k]] = { point: pose.point, rotation: pose.rotation, turn: pose.turn.map((x, link) => x - turns[link]) };
    };
    for (let k = from; k >= 0 && k < n; ) {
      if (cycle && this.poses[course[k]]) return null;
      const before = trail.pose, had = trail.drives;
      this.sketch.values = this.values;
      let next = Math.min(Math.max(k + sign * (skip - 1), 0), n - 1);
      if (next !== k && !this.sketch.walk(trail, drives(next))) {
        trail = new Trail(before, had);
        next = k;
      }
      if (next === k && !this.sketch.walk(trail, drives(k))) return null;
      for (let m = k; m !== next; m += sign) put(m, new Between(before, trail.pose, had, trail.drives, drives(m)));
      put(next, trail.pose);
      k = next + sign;
      yield;
    }
    return trail;
  }

  /** Further turns of links, radians, so that rows that hold an angle reach their targets; in space of the relative
   * turns that the drives' rows count. */
  private counts(more: (row: number) => number): Float64Array {
    const { data } = this, out = new Float64Array(this.held.pose.turn.length), known = new Set([data.links.length]);
    if (data.dimension !== 2) {
      for (const row of data.drives) {
        const { count } = data.rows[row];
        if (count !== undefined) out[count] += more(row);
      }
      return out;
    }
    const left = new Set(data.rows.flatMap((r, k) => (r.angular && (r.kind === "constraint" || data.drives.includes(k)) ? [k] : [])));
    while (left.size) {
      const next = [...left].find((k) => data.rows[k].ends.some((link) => known.has(link)));
      if (next === undefined) {
        known.add(data.rows[[...left][0]].ends[0]);
        continue;
      }
      const [i, j] = data.rows[next].ends;
      if (!known.has(j)) out[j] = (out[i] ?? 0) + more(next);
      else if (!known.has(i)) out[i] = (out[j] ?? 0) - more(next);
      known.add(i).add(j);
      left.delete(next);
    }
    return out;
  }

  /** Branches at all positions, the first pose of the file, and the positions behind gaps. */
  private *settle(pose: Pose, t: number): Generator<void> {
    this.spread(this.branches.read(pose, t));
    yield;
    let closes = this.kernel.closes();
    yield;
    const first = this.firstOf(closes), begin = first < 0 ? null : this.poses[first] ?? this.enter(first, pose);
    if (begin) {
      if (!this.poses[first]) yield* this.follow(first, begin);
      this.base = { place: first, pose: this.exact(first) ?? begin };
      if (this.poses.every((q) => q)) {
        this.branches.model = this.branches.read(begin, first);
        return; // nothing is left to which it would apply
      }
      this.spread(this.branches.read(begin, first));
      closes = this.kernel.closes();
      yield;
      yield* this.behind(closes);
    }
    this.spread(this.branches.model);
    yield;
    this.kernel.closes();
  }

  private spread(model: Float64Array): void {
    this.branches.spread(model, this.poses, this.base.pose);
  }

  /** The pose of a position to rounding; with many positions, those between stations are only near it. */
  private exact(k: number): Pose | null {
    this.sketch.values = this.values;
    return this.poses[k] && this.sketch.close(this.poses[k], this.kernel.drives(k), 0.05);
  }

  private firstOf(closes: Uint8Array): number {
    const good = (k: number): boolean => this.poses[k] !== null || closes[k] > 0;
    return this.data.places.find(good) ?? closes.findIndex((_, k) => good(k));
  }

  /** The kernel's pose at a position, closed to rounding; turns counted near another pose's. A link whose angle is
   * taken from the known motion has none yet where nothing is reached: it starts as in the other pose. */
  private enter(k: number, near: Pose): Pose | null {
    const d = this.data.dimension, q = copied(near);
    let reach = 0.1;
    this.kernel.posed(k).forEach((rows, link) => {
      if (!rows.every(Number.isFinite)) {
        reach = Infinity;
        return;
      }
      for (let c = 0; c < d; c++) q.point[d * link + c] = rows[c];
      if (d === 2) {
        q.turn[link] += wrap(Math.atan2(rows[3], rows[2]) - q.turn[link]);
        [q.rotation[2 * link], q.rotation[2 * link + 1]] = [rows[2], rows[3]];
      } else for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) q.rotation[9 * link + 3 * i + j] = rows[3 + 3 * j + i];
    });
    if (![...q.point, ...q.rotation, ...q.turn].every(Number.isFinite)) return null;
    this.sketch.values = this.values;
    return this.sketch.close(this.wound(q, this.kernel.drives(k)), this.kernel.drives(k), reach);
  }

  /** The pose with the whole turns that its drives require, and with those that slides keep. */
  private wound(q: Pose, drives: number[]): Pose {
    const { data, sketch } = this, whole = (x: number): number => 2 * Math.PI * Math.round(x / (2 * Math.PI));
    const more = data.drives.map((row, d) => (data.rows[row].angular ? whole(drives[d] - sketch.measure(row, q)) : 0)), turns = this.counts((row) => more[this.data.drives.indexOf(row)] ?? 0);
    return { ...q, turn: q.turn.map((x, k) => x + turns[k]) };
  }

  /** Ranges behind a gap that no motion reaches, where every group of links closes on its former branch. */
  private *behind(closes: Uint8Array): Generator<void> {
    const { course } = this.data, reached = (k: number): boolean => this.poses[course[k]] !== null;
    for (let k = 0; k < this.count; k++) {
      if (reached(k) || !closes[course[k]]) continue;
      let end = k;
      while (end + 1 < this.count && !reached(end + 1) && closes[course[end + 1]] && !this.gapBetween(end)) end++;
      const low = k === 0 || !closes[course[k - 1]] && !reached(k - 1) || this.gapBetween(k - 1);
      const high = end === this.count - 1 || !reached(end + 1) || this.gapBetween(end);
      if (low && high) {
        const middle = course[(k + end) >> 1], pose = this.enter(middle, this.base.pose);
        if (pose) yield* this.follow(middle, pose);
      }
      k = end;
      yield;
    }
  }

  private gapBetween(k: number): boolean {
    const [a, b] = [this.data.course[k], this.data.course[k + 1]];
    for (let i = 1; i < BETWEEN; i++) if (!this.kernel.closesAt(a + (i / BETWEEN) * (b - a))) return true;
    return false;
  }

  /** The pose at any place of the cycle, null where the motion does not get. */
  at(t: number): Pose | null {
    this.update();
    const low = Math.floor(t) % this.count, part = t - Math.floor(t);
    const exact = part === 0 && this.count <= STATIONS ? this.poses[low] : null;
    let pose = exact;
    this.sketch.values = this.values;
    for (const k of [low, (low + 1) % this.count]) {
      const from = this.poses[k];
      if (pose || !from) continue;
      const near = this.sketch.close(from, this.kernel.drives(k), 0.05);
      const drives = this.nearDrives(k, t);
      pose = near && this.sketch.walk(new Trail(near, this.kernel.drives(k)), drives);
    }
    if (pose) [this.held, this.loose] = [{ values: this.values.slice(), t, pose }, null];
    return pose;
  }

  /** The same from the present pose alone, while the motion may still be that of other numbers. */
  near(t: number): Pose | null {
    if (!this.reclose()) return null;
    if (this.held.t === t) return this.held.pose;
    this.sketch.values = this.values;
    const pose = this.sketch.walk(new Trail(this.held.pose, this.kernel.drives(this.held.t)), this.nearDrives(this.held.t, t));
    if (pose) this.held = { values: this.values.slice(), t, pose };
    return pose;
  }

  /** The drives at a place, with turns counted as at a neighbouring position. */
  private nearDrives(k: number, t: number): number[] {
    const at = this.kernel.drives(t), from = this.kernel.drives(k);
    return at.map((x, d) => (this.data.cycle?.[d] ? from[d] + wrap(x - from[d]) : x));
  }

  /** The pose drawn at a place where the linkage does not close: the present pose, open at one joint. */
  stretched(t: number): Pose {
    this.sketch.values = this.values;
    const from = this.loose?.t === t ? this.loose.pose : this.nearest(t);
    this.loose = { t, pose: this.sketch.loosen(from, this.kernel.drives(t), this.weakest) };
    return this.loose.pose;
  }

  /** The pose with the least gaps of its joints at a place where the linkage does not close, and these gaps. */
  open(t: number): ReturnType<Sketch["open"]> {
    this.sketch.values = this.values;
    return this.sketch.open(this.nearest(t), this.kernel.drives(t));
  }

  private nearest(t: number): Pose {
    let best = this.held.pose, away = Infinity;
    this.poses.forEach((pose, k) => {
      if (pose && Math.abs(k - t) < away) [best, away] = [pose, Math.abs(k - t)];
    });
    return best;
  }

  /** Numbers of the first position for the file, in the order of `assembly`. */
  assembly(): number[] {
    this.update();
    const { links, dimension: d, counted } = this.data, { pose } = this.base;
    return links.flatMap((name, k) =>
      d === 2 ? [pose.turn[k] + (counted[name] ?? 0)]
        : [...pose.point.subarray(3 * k, 3 * k + 3), ...turnOf(pose.rotation.subarray(9 * k, 9 * k + 9))]);
  }

  /** Where the links are now, by name: origin and angle, in space origin and rotation. */
  placed(): Record<string, number[]> {
    const { links, dimension: d } = this.data, { pose } = this.held;
    return Object.fromEntries(links.map((name, k) =>
      [name, d === 2 ? [pose.point[2 * k], pose.point[2 * k + 1], pose.turn[k]] : [...pose.point.subarray(3 * k, 3 * k + 3), ...pose.rotation.subarray(9 * k, 9 * k + 9)]]));
  }

  /** Begins from links placed elsewhere: the place of the cycle at which the motion goes on, null if they do not close. */
  take(placing: Record<string, number[]>): number | null {
    const { data, sketch, kernel } = this, start = placedPose(data, this.first.pose, placing);
    this.home();
    sketch.values = this.values;
    sketch.count(this.phases, false);
    const measured = (q: Pose): number[] => data.drives.map((row) => sketch.measure(row, q));
    let from = measured(start), q = sketch.close(start, from, REACH);
    const t = q && this.placeOf(from);
    if (q && t !== null) {
      const to = kernel.drives(t).map((x, d) => (data.rows[data.drives[d]].angular ? from[d] + wrap(x - from[d]) : x));
      q = sketch.walk(new Trail(q, from), to);
      if (q) q = this.wound(q, kernel.drives(t));
    }
    if (q && t !== null) {
      this.held = { values: this.values.slice(), t, pose: q };
      this.hold(this.phases.map((row) => sketch.measure(row, q!)));
    }
    sketch.count(this.phases, true);
    return q && t !== null ? t : null;
  }

  /** The place of the cycle nearest to positions of the drives. */
  private placeOf(drives: number[]): number {
    const { kernel, data, count } = this, angular = data.drives.map((row) => data.rows[row].angular);
    const off = (t: number): number => Math.hypot(...kernel.drives(t).map((x, d) => (angular[d] ? wrap(x - drives[d]) : (x - drives[d]) / data.length)));
    let best = 0, away = Infinity;
    for (let k = 0; k < count; k++) if (off(k) < away) [best, away] = [k, off(k)];
    if (drives.length !== 1 || away < 1e-12 || kernel.stepped) return best;
    for (const [low, high] of [[best - 1, best], [best, best + 1], ...(best === 0 ? [[count - 1, count]] : [])]) {
      if (low < 0 || high > kernel.end) continue;
      const [a, b] = [low, high].map((t) => kernel.drives(t)[0]), near = angular[0] ? wrap : (x: number): number => x, part = near(drives[0] - a) / near(b - a);
      if (part >= 0 && part <= 1) return low + part;
    }
    return best;
  }

  /** Complete state of the present pose, for storage. */
  state(): number[] {
    this.update();
    const { t, pose } = this.held;
    return [t, ...pose.point, ...pose.rotation, ...pose.turn, ...this.phases.map((row) => this.sketch.hold[row])];
  }

  /** The stored pose, with the present numbers. */
  restore(state: number[]): void {
    const [t, ...rest] = state, pose = copied(this.held.pose);
    for (const part of ["point", "rotation", "turn"] as const) pose[part].set(rest.splice(0, pose[part].length));
    this.hold(rest);
    this.held = { values: this.values.slice(), t, pose };
    [this.seen, this.loose] = [null, null];
  }
}

/** All parts of something. */
export function whole(parts: Generator<void>): void {
  while (!parts.next().done);
}

/** The joint that is opened if the linkage does not close: between two moving links, if possible not driven. */
function weakest(s: SketchData): string {
  const moving = (row: { ends: readonly number[] }): number[] => row.ends.filter((link) => link < s.links.length);
  const driven = new Set(s.drives.flatMap((row) => moving(s.rows[row])));
  const rank = (name: string): number => {
    const links = moving(s.rows.find((r) => r.kind === "constraint" && r.joint === name) ?? { ends: [] });
    return links.length - (links.some((link) => driven.has(link)) ? 0.5 : 0);
  };
  return s.gaps.map((g) => g.joint).reduce((best, name) => (best && rank(best) >= rank(name) ? best : name), "");
}
