/** Drawing without a mouse: arrows move a cross, Page Up and Page Down go from point to point, Enter clicks, Space presses and lets go. */

import { type Canvas, make } from "./canvas";
import { type Drawing, type End, ends, type Point } from "./state";

const ARROWS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Pixels within which a place is at a point. */
export const NEAR = 13;

/** All points, those of one place one after the other. */
function places(d: Drawing): (End & { at: Point })[] {
  const all = [...ends(d)], place = (p: Point): number => all.findIndex((one) => Math.hypot(one.at[0] - p[0], one.at[1] - p[1]) < 1e-6 + 1e-6 * Math.hypot(...p));
  return all.map((one, k) => ({ one, k: [place(one.at), k] })).sort((a, b) => a.k[0] - b.k[0] || a.k[1] - b.k[1]).map(({ one }) => one);
}

export class Cursor {
  /** The point that was gone to: of several at one place, it is the one that is meant. */
  end: (End & { at: Point }) | null = null;
  private at: Point = [0, 0];
  private held = false;
  private readonly cross: SVGElement;

  constructor(private readonly canvas: Canvas, private readonly said: (text: string) => void) {
    const { svg } = canvas;
    svg.setAttribute("tabindex", "0");
    this.cross = make(svg, "path", { class: "cursor" });
    svg.addEventListener("pointermove", (e) => {
      if (!e.isTrusted) return;
      this.cross.removeAttribute("d");
      const { left, top } = svg.getBoundingClientRect();
      this.at = this.canvas.window.metres(e.clientX - left, e.clientY - top);
      if (this.end && this.far(this.end.at) > NEAR) this.end = null;
    });
  }
  private far(p: Point): number {
    return Math.hypot(p[0] - this.at[0], p[1] - this.at[1]) * this.canvas.window.scale;
  }

  /** A key of the cursor; false for others. */
  key(e: KeyboardEvent, d: Drawing, busy: boolean): boolean {
    const arrow = ARROWS[e.key], page = { PageDown: 1, PageUp: -1 }[e.key];
    if (arrow) {
      const step = this.canvas.window.step(d.units.length.size, 7) * (e.shiftKey ? 5 : 1);
      this.go([this.at[0] + arrow[0] * step, this.at[1] + arrow[1] * step]);
    } else if (page) {
      const all = places(d);
      if (!all.length) return true;
      const near = all.findIndex((one) => this.far(one.at) < NEAR), now = this.end ? all.findIndex((one) => one.link === this.end!.link && one.point === this.end!.point) : near;
      this.end = all[(Math.max(now, page > 0 ? -1 : 0) + page + all.length) % all.length];
      this.go(this.end.at);
      this.said(`${this.end.point} of ${this.end.link}`);
    } else if (e.key === " ") {
      this.held = busy && this.held;
      this.send(this.held ? "pointerup" : "pointerdown");
      this.held = !this.held;
    } else if (e.key === "Enter") {
      this.send("pointerdown");
      this.send("pointerup");
      this.held = false;
    } else return false;
    return true;
  }
  private go(to: Point): void {
    this.at = to;
    if (this.end && this.far(this.end.at) > NEAR) this.end = null;
    const { window, svg } = this.canvas, { width, height } = svg.getBoundingClientRect(), [x, y] = window.px(to);
    const by = [x, y].map((p, k) => Math.min(0, p - 20) + Math.max(0, p - [width, height][k] + 20));
    if (by[0] || by[1]) window.pan(-by[0], -by[1]);
    this.send("pointermove");
    const [u, v] = window.px(to);
    this.cross.setAttribute("d", `M${u - 12} ${v}h24M${u} ${v - 12}v24`);
  }
  private send(type: string): void {
    const { window, svg } = this.canvas, box = svg.getBoundingClientRect(), [x, y] = window.px(this.at);
    svg.dispatchEvent(new PointerEvent(type, { clientX: box.left + x, clientY: box.top + y, pointerId: -1, buttons: type === "pointerdown" || (type === "pointermove" && this.held) ? 1 : 0, bubbles: true }));
  }
}
