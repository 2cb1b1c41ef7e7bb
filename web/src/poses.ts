/** Poses made from numbers: between two others, of an assembly, of links placed by name. */

import type { SketchData } from "./data";
import { copied, type Pose } from "./sketch";

/** An angle between half a turn back and half a turn on. */
export const wrap = (x: number): number => x - 2 * Math.PI * Math.round(x / (2 * Math.PI));

/** A pose between two others, in proportion to the drives; for planar links. Its arrays are made when they are read. */
export class Between implements Pose {
  private readonly part: number;
  constructor(private readonly a: Pose, private readonly b: Pose, from: number[], to: number[], at: number[]) {
    const d = to.findIndex((x, k) => x !== from[k]);
    this.part = d < 0 ? 1 : (at[d] - from[d]) / (to[d] - from[d]);
  }
  /** One number of it. */
  value(of: keyof Pose, k: number): number {
    if (of !== "rotation") return this.a[of][k] + this.part * (this.b[of][k] - this.a[of][k]);
    const turn = this.value("turn", k >> 1);
    return k & 1 ? Math.sin(turn) : Math.cos(turn);
  }
  private all(of: keyof Pose): Float64Array {
    return this.a[of].map((_, k) => this.value(of, k));
  }
  get point(): Float64Array { return this.all("point"); }
  get rotation(): Float64Array { return this.all("rotation"); }
  get turn(): Float64Array { return this.all("turn"); }
}

/** Links rotated by the numbers of an assembly; in space they are also placed. */
export function posed(s: SketchData, like: Pose, assembly: number[]): Pose {
  const q = copied(like);
  s.links.forEach((name, k) => {
    if (s.dimension === 2) {
      const t = (q.turn[k] = assembly[k] - (s.counted[name] ?? 0));
      [q.rotation[2 * k], q.rotation[2 * k + 1]] = [Math.cos(t), Math.sin(t)];
      return;
    }
    const [x, y, z, a, b, c, angle] = assembly.slice(7 * k, 7 * k + 7), one = Math.hypot(a, b, c) || 1;
    q.point.set([x, y, z], 3 * k);
    q.rotation.set(matrixOf([a / one, b / one, c / one], angle), 9 * k);
  });
  return q;
}

/** Links placed by name; others as they are. */
export function placedPose(s: Pick<SketchData, "links" | "dimension">, like: Pose, placing: Record<string, number[]>): Pose {
  const q = copied(like);
  s.links.forEach((name, k) => {
    const at = placing[name], d = s.dimension;
    if (at?.length !== (d === 2 ? 3 : 12) || !at.every(Number.isFinite)) return;
    q.point.set(at.slice(0, d), d * k);
    if (d === 3) return q.rotation.set(at.slice(3), 9 * k);
    q.turn[k] = at[2];
    q.rotation.set([Math.cos(at[2]), Math.sin(at[2])], 2 * k);
  });
  return q;
}

function matrixOf([x, y, z]: number[], angle: number): number[] {
  const c = Math.cos(angle), s = Math.sin(angle), v = 1 - c;
  return [c + v * x * x, v * x * y - s * z, v * x * z + s * y, v * x * y + s * z, c + v * y * y, v * y * z - s * x, v * x * z - s * y, v * y * z + s * x, c + v * z * z];
}

/** Axis and angle of a rotation matrix. */
export function turnOf(r: Float64Array): number[] {
  const v = [r[7] - r[5], r[2] - r[6], r[3] - r[1]], sin = Math.hypot(...v), cos = r[0] + r[4] + r[8] - 1;
  if (sin > 1e-6) return [...v.map((x) => x / sin), Math.atan2(sin, cos)];
  if (cos > 0) return [0, 0, 1, 0];
  const k = [0, 1, 2].reduce((a, b) => (r[4 * b] > r[4 * a] ? b : a)), column = [0, 1, 2].map((i) => r[3 * i + k] + (i === k ? 1 : 0));
  const size = Math.hypot(...column);
  return [...column.map((x) => x / size), Math.PI];
}
