/** Where the drawing lies in its window: metres to pixels and back, zoom and pan. */

import type { Drawing, Point } from "./state";
import { ends } from "./state";

/** Pixels beyond which a place is drawn no farther out: far outside every window, and within what SVG can draw. */
const FAR = 1e6;
const near = (x: number): number => Math.min(Math.max(x, -FAR), FAR) || 0;
/** Least scale of a drawing that is fitted, pixels per metre: lengths of the window stay finite. */
const LEAST = 1e-100;

export class Window {
  scale = 2000;
  middle: Point = [0.05, 0.03];
  constructor(private readonly el: Element) {}
  private get size(): Point {
    const { width, height } = this.el.getBoundingClientRect();
    return [width || 600, height || 400];
  }
  px(p: Point): Point {
    const [w, h] = this.size;
    return [near(w / 2 + (p[0] - this.middle[0]) * this.scale), near(h / 2 - (p[1] - this.middle[1]) * this.scale)];
  }
  /** Pixels of a length. */
  long(metres: number): number {
    return near(Math.abs(metres) * this.scale);
  }
  metres(x: number, y: number): Point {
    const [w, h] = this.size;
    return [this.middle[0] + (x - w / 2) / this.scale, this.middle[1] - (y - h / 2) / this.scale];
  }
  zoom(by: number, x: number, y: number): void {
    const at = this.metres(x, y);
    this.scale = Math.min(Math.max(this.scale * by, 1e-2), 1e7);
    const now = this.metres(x, y);
    this.middle = [this.middle[0] + at[0] - now[0], this.middle[1] + at[1] - now[1]];
  }
  pan(dx: number, dy: number): void {
    this.middle = [this.middle[0] - dx / this.scale, this.middle[1] + dy / this.scale];
  }
  fit(d: Drawing): void {
    const all = [...ends(d)].map((e) => e.at).filter((at) => at.every(Number.isFinite));
    if (!all.length) return;
    const [x, y] = [0, 1].map((k) => [Math.min(...all.map((p) => p[k])), Math.max(...all.map((p) => p[k]))]);
    const [w, h] = this.size, span = Math.max((x[1] - x[0]) / (w - 130), (y[1] - y[0]) / (h - 130), 1e-6);
    this.middle = [x[0] / 2 + x[1] / 2, y[0] / 2 + y[1] / 2];
    this.scale = Math.min(Math.max(1 / span, LEAST), 0.3 / Math.max(1e-9, 0.15) * 1000);
  }
  /** Round step of the grid, m, and the length of the scale bar: units of a power of ten, times 1, 2 or 5. */
  step(unit: number, pixels: number): number {
    const rough = pixels / this.scale / unit, power = 10 ** Math.floor(Math.log10(rough)), lead = rough / power;
    return (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power * unit;
  }
}
