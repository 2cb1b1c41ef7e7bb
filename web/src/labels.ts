/** Places of texts: each takes the best of some places round its anchor, away from texts and lines placed before. */

import { type Point, place, text, width } from "./svg";

type Box = [number, number, number, number];
export interface Placed { el: SVGTextElement; text: string; size: number; bold: boolean; choice: number }
export interface Wanted { label: Placed; anchor: Point; away?: Point; leave?: number }

const WAYS: Point[] = [[1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [-1, 0], [0, 1]];
const REACH = [1, 1.9, 3];

export function label(parent: Element, role: string, said: string, size: number): Placed {
  return { el: text(parent, role, said, size), text: said, size, bold: role === "title", choice: -1 };
}

/** Puts texts one after the other; lines and boxes to keep free are told first. */
export class Placer {
  private boxes: Box[] = [];
  private lines: [Point, Point][] = [];
  constructor(private readonly bounds: Box) {}
  line(a: Point, b: Point): void {
    this.lines.push([a, b]);
  }
  disc(at: Point, r: number): void {
    this.boxes.push([at[0] - r, at[1] - r, at[0] + r, at[1] + r]);
  }
  put(w: Wanted): void {
    const { label: l, anchor } = w, wide = width(l.text, l.size, l.bold), high = l.size;
    const leave = w.leave ?? 1.2;
    let best = Infinity, chosen = 0, box: Box = [0, 0, 0, 0];
    for (let n = 0; n < WAYS.length * REACH.length; n++) {
      const [wx, wy] = WAYS[n % 8], r = leave * REACH[n >> 3];
      const cx = anchor[0] + wx * (r + wide / 2), cy = anchor[1] + wy * (r + high / 2);
      const b: Box = [cx - wide / 2, cy - high / 2, cx + wide / 2, cy + high / 2];
      let cost = 0.12 * n - (n === l.choice ? 0.4 : 0);
      if (w.away) cost += 1.2 * (1 - (wx * w.away[0] + wy * w.away[1]) / (Math.hypot(wx, wy) * (Math.hypot(...w.away) || 1)));
      cost += this.cost(b);
      if (cost < best) (best = cost), (chosen = n), (box = b);
    }
    l.choice = chosen;
    this.boxes.push(box);
    place(l.el, (box[0] + box[2]) / 2, (box[1] + box[3]) / 2 + 0.36 * l.size);
  }
  private cost(b: Box): number {
    let cost = 0;
    for (const o of this.boxes) {
      const dx = Math.min(b[2], o[2]) - Math.max(b[0], o[0]), dy = Math.min(b[3], o[3]) - Math.max(b[1], o[1]);
      if (dx > 0 && dy > 0) cost += 12 + dx * dy;
    }
    for (const [p, q] of this.lines) if (crosses(b, p, q)) cost += 6;
    const [l, t, r, d] = this.bounds;
    if (b[0] < l || b[1] < t || b[2] > r || b[3] > d) cost += 20;
    return cost;
  }
}

/** Whether a line goes through a box (Liang and Barsky). */
function crosses(b: Box, p: Point, q: Point): boolean {
  let t0 = 0, t1 = 1;
  const d = [q[0] - p[0], q[1] - p[1]];
  for (let axis = 0; axis < 2; axis++) {
    if (Math.abs(d[axis]) < 1e-9) {
      if (p[axis] < b[axis] || p[axis] > b[axis + 2]) return false;
      continue;
    }
    const u = (b[axis] - p[axis]) / d[axis], v = (b[axis + 2] - p[axis]) / d[axis];
    t0 = Math.max(t0, Math.min(u, v));
    t1 = Math.min(t1, Math.max(u, v));
  }
  return t0 < t1;
}
