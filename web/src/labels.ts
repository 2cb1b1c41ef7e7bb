/** Places of texts: each takes the best of some places around its anchor, away from texts and lines placed before. */

import { letters, type Point, place, text, width } from "./svg";

type Box = [number, number, number, number];
export interface Placed { el: SVGTextElement; text: string; size: number; bold: boolean; choice: number }
export interface Wanted { label: Placed; anchors: Point[]; away?: Point; leave?: number }

const WAYS: Point[] = [[1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [-1, 0], [0, 1]];
const REACH = [1, 1.9, 3, 4.5];

export function label(parent: Element, role: string, said: string, size: number): Placed {
  return { el: text(parent, role, said, size), text: said, size, bold: role === "title", choice: -1 };
}

/** Gives a label another text. */
export function say(l: Placed, text: string): void {
  if (l.text === text) return;
  l.text = text;
  letters(l.el, text, l.size);
}

/** Places texts one after the other; lines and boxes to avoid are given first. */
export class Placer {
  private texts: Box[] = [];
  private discs: Box[] = [];
  private lines: [Point, Point][] = [];
  constructor(private readonly bounds: Box) {}
  line(a: Point, b: Point): void {
    this.lines.push([a, b]);
  }
  disc(at: Point, r: number): void {
    this.discs.push([at[0] - r, at[1] - r, at[0] + r, at[1] + r]);
  }
  put(w: Wanted): void {
    const l = w.label, wide = width(l.text, l.size, l.bold) + 0.5, high = 1.1 * l.size + (l.text.includes("_") ? 0.3 * l.size : 0), leave = w.leave ?? 1.2;
    const long = w.away ? Math.hypot(...w.away) || 1 : 1;
    let best = Infinity, chosen = 0, box: Box = [0, 0, 0, 0];
    const each = WAYS.length * REACH.length, attempt = (n: number): void => {
      const [ax, ay] = w.anchors[Math.floor(n / each)], [wx, wy] = WAYS[n % WAYS.length];
      let cost = 0.12 * (n % each) + 0.2 * Math.floor(n / each) - (n === l.choice ? 0.4 : 0);
      if (w.away) cost += 1.2 * (1 - (wx * w.away[0] + wy * w.away[1]) / (Math.hypot(wx, wy) * long));
      if (cost >= best) return;
      const r = leave * REACH[Math.floor((n % each) / WAYS.length)], cx = ax + wx * (r + wide / 2), cy = ay + wy * (r + high / 2);
      const b: Box = [cx - wide / 2, cy - high / 2, cx + wide / 2, cy + high / 2];
      if ((cost += this.cost(b, best - cost)) < best) (best = cost), (chosen = n), (box = b);
    };
    const count = w.anchors.length * each;
    if (l.choice >= 0 && l.choice < count) attempt(l.choice); // mostly the best again: the others are then soon out
    for (let n = 0; n < count; n++) if (n !== l.choice) attempt(n);
    l.choice = chosen;
    this.texts.push(box);
    place(l.el, (box[0] + box[2]) / 2, box[1] + 0.91 * l.size);
  }
  /** What a box covers; of one that covers too much only that it does. */
  private cost(b: Box, enough: number): number {
    const [l, t, r, d] = this.bounds;
    let cost = b[0] < l || b[1] < t || b[2] > r || b[3] > d ? 60 : 0;
    for (const o of this.texts) {
      const common = overlap(b, o);
      if (common > 0) cost += 60 + 5 * common;
    }
    for (const o of this.discs) {
      const common = overlap(b, o);
      if (common > 0) cost += 8 + common;
    }
    for (const [p, q] of this.lines) {
      if (cost >= enough) return cost;
      if (crosses(b, p, q)) cost += 6;
    }
    return cost;
  }
}

function overlap(a: Box, b: Box): number {
  const dx = Math.min(a[2], b[2]) - Math.max(a[0], b[0]), dy = Math.min(a[3], b[3]) - Math.max(a[1], b[1]);
  return dx > 0 && dy > 0 ? dx * dy : 0;
}

/** True if a line crosses a box (Liang and Barsky). */
function crosses(b: Box, p: Point, q: Point): boolean {
  if (Math.max(p[0], q[0]) < b[0] || Math.min(p[0], q[0]) > b[2] || Math.max(p[1], q[1]) < b[1] || Math.min(p[1], q[1]) > b[3]) return false;
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
