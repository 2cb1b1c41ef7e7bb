/** Pulling a linkage by a point of a link: every step goes along the tangent and comes back to where all closes, so that
 * free parts follow and the assembly stays. No mechanics of joints: rows and derivatives come from the program. */

import type { Program } from "./program";
import { copied, LONGEST, OPEN, type Pose, type Rigid, Sketch } from "./sketch";

/** At the pointer; as near as any way leads; not yet there; joints that are not together. */
export type Where = "there" | "nearest" | "on the way" | "apart";
/** A point of a link in its axes, metres. */
export interface Grip { link: number; u: number[] }

/** Steps of one frame; stiffness of the joints beside the pull; damping at first, at least, at most. */
const STEPS = 12, STIFF = 1e6, FIRST = 1e-3, LEAST = 1e-5, MOST = 1e6;
/** Longest pull of a step; attempts at a step; weight of gaps while joints are apart, and how near a pose then closes. */
const PULL = 0.5, TRIES = 6, GAPS = 100, SHUT = 0.2;

export class Pulled extends Sketch {
  closed = false;
  /** How far the held point is from its target, over `length`. */
  away = 0;
  private damping = FIRST;

  constructor(data: Rigid, program: Program, public pose: Pose) {
    super(data, program);
    this.placed(pose);
  }

  /** Takes a pose; meshing wheels keep the phase in which they stand there. */
  placed(pose: Pose): void {
    this.data.rows.forEach((r, k) => r.kind === "phase" && (this.hold[k] = this.measure(k, pose)));
    this.pose = pose;
    this.damping = FIRST;
    this.closed = this.gap(pose) <= OPEN;
  }

  /** Holds a freedom where it is, or lets it go. */
  lock(row: number, on: boolean): void {
    this.active[row] = +on;
    this.hold[row] = this.measure(row, this.pose);
  }
  locked(row: number): boolean {
    return this.data.rows[row].kind === "freedom" && this.active[row] > 0;
  }

  /** The place of a held point, metres. */
  at({ link, u }: Grip, q = this.pose): number[] {
    const d = this.data.dimension, o = q.point.subarray(d * link, d * link + d);
    if (d === 2) {
      const [c, s] = q.rotation.subarray(2 * link, 2 * link + 2);
      return [o[0] + c * u[0] - s * u[1], o[1] + s * u[0] + c * u[1]];
    }
    const r = q.rotation.subarray(9 * link, 9 * link + 9);
    return [0, 1, 2].map((k) => o[k] + r[3 * k] * u[0] + r[3 * k + 1] * u[1] + r[3 * k + 2] * u[2]);
  }

  private far(grip: Grip, target: number[], q: Pose): number {
    return Math.hypot(...this.at(grip, q).map((x, k) => target[k] - x)) / this.data.length;
  }

  /** Adds the soft target: the held point goes by ``pull``, over `length`. */
  private pull(grip: Grip, q: Pose, pull: number[]): void {
    const { n, data, matrix, right, first, start } = this, d = data.dimension, at = n * this.place[grip.link];
    const arm = this.at(grip, q).map((x, k) => (x - q.point[d * grip.link + k]) / data.length);
    for (let a = 0; a < d; a++) {
      const row = Array<number>(n).fill(0), [i, j] = [(a + 1) % 3, (a + 2) % 3];
      row[a] = 1;
      if (d === 2) row[2] = a ? arm[0] : -arm[1];
      else [row[3 + i], row[3 + j]] = [arm[j], -arm[i]];
      for (let x = 0; x < n; x++) {
        if (!row[x]) continue;
        right[at + x] += row[x] * pull[a];
        for (let y = 0; y <= x; y++) matrix[start[at + x] + at + y - first[at + x]] += row[x] * row[y];
      }
    }
  }

  /** One frame of a pull; ``fine``: a distance over `length` that is not seen. Without a grip: joints come together. */
  frame(grip: Grip | null, target: number[], fine: number): Where {
    if (!this.closed) return this.gather(grip, target);
    if (!grip) return "there";
    this.away = this.far(grip, target, this.pose);
    for (let s = 0; s < STEPS; s++) {
      if (this.away < fine) return this.ended("there");
      const step = this.step(grip, target, fine);
      if (!step) return this.ended("nearest");
      const gain = this.away - this.far(grip, target, step);
      this.pose = step;
      this.away -= gain;
      if (gain < fine / 20) return this.ended(this.away < fine ? "there" : "nearest");
    }
    return "on the way";
  }

  private ended(where: Where): Where {
    this.damping = FIRST;
    return where;
  }

  /** A pose that closes and is nearer; null if no way leads nearer. */
  private step(grip: Grip, target: number[], fine: number): Pose | null {
    const { pose, data } = this, part = Math.min(1, PULL / this.away), p = this.at(grip), pull = p.map((x, k) => (part * (target[k] - x)) / data.length);
    for (let tries = 0; tries < TRIES; tries++) {
      this.gap(pose);
      this.weight.fill(STIFF);
      this.fill(this.damping);
      this.weight.fill(1);
      this.pull(grip, pose, pull);
      const size = this.answer();
      if (!(size >= fine / 10)) return null;
      const next = this.correct(this.moved(pose, Math.min(1, LONGEST / size)), 0.5 * Math.min(size, LONGEST) + 1e-9, 8)?.pose;
      if (next && this.far(grip, target, next) < this.away) {
        this.damping = Math.max(this.damping / 4, LEAST);
        return next;
      }
      this.damping = Math.min(this.damping * 8, MOST);
    }
    return null;
  }

  /** While joints are apart: least squares of their gaps and the pull, until a pose near by closes. */
  private gather(grip: Grip | null, target: number[]): Where {
    const miss = (q: Pose): number => {
      const open = this.gap(q), sum = this.missing.reduce((t, x, k) => t + (this.active[k] ? GAPS * x * x : 0), 0);
      return Number.isFinite(open) ? sum + (grip ? this.far(grip, target, q) ** 2 : 0) : Infinity;
    };
    let damping = Math.max(this.damping, 1e-2), now = miss(this.pose);
    for (let s = 0; s < STEPS && damping < 1e8; s++) {
      this.gap(this.pose);
      this.weight.fill(GAPS);
      this.fill(damping);
      this.weight.fill(1);
      if (grip) this.pull(grip, this.pose, this.at(grip).map((x, k) => (target[k] - x) / this.data.length));
      const size = this.answer(), next = this.moved(this.pose, Math.min(1, LONGEST / size)), then = miss(next);
      if (!(then < now)) {
        damping *= 4;
        continue;
      }
      const small = now - then < 1e-12 * now;
      [this.pose, now, damping] = [next, then, Math.max(damping / 3, 1e-9)];
      if (small) break;
    }
    this.damping = damping;
    const shut = this.correct(copied(this.pose), SHUT)?.pose;
    if (!shut) return "apart";
    this.placed(shut);
    return "on the way";
  }
}
