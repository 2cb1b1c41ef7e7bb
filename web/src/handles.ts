/** What can be taken hold of: joints, points, mass centres, tips of loads, directions, and the driven link. */

import type { Board } from "./board";
import type { Data, End, Handle, Pair, Rows } from "./data";
import type { Kernel } from "./kernel";
import { make, type Point } from "./svg";

export interface Hold { changed(): void; finished(numbers: number[]): void; seek(t: number): void; time(): number }

export function handles(b: Board, data: Data, kernel: Kernel, hold: Hold, perMm: () => number): () => void {
  const layer = make("g", b.svg, { class: "handles" });
  const updates = data.handles.map((h) => handle(layer, b, h, kernel, hold, perMm));
  drive(b, data, kernel, hold);
  return () => kernel.finite && updates.forEach((f) => f());
}

/** Where a number of a point in axes comes to stand, if its place is (x, y) on the ground. */
function set(kernel: Kernel, end: End, held: number[], x: number, y: number): void {
  const [ox, oy, c, s] = held;
  kernel.values[end.n[0]] = c * (x - ox) + s * (y - oy);
  kernel.values[end.n[1]] = c * (y - oy) - s * (x - ox);
}

const held = (kernel: Kernel, e: End): number[] => [...e.at, ...e.e].map((r) => kernel.here[r]);

/** Parameters that bring a joint as near to a place as they can: Gauss and Newton's steps, damped, by differences. */
function follow(kernel: Kernel, p: Rows, by: number[], x: number, y: number): void {
  const u = kernel.values, out = new Float64Array(kernel.here.length), trial = u.slice();
  const miss = (): Pair | null => {
    kernel.other(trial, out);
    const d: Pair = [x - out[p[0]], y - out[p[1]]];
    return Number.isFinite(d[0] + d[1]) ? d : null;
  };
  for (let pass = 0; pass < 4; pass++) {
    trial.set(u);
    const now = miss();
    if (!now) return;
    const slopes = by.map((n) => {
      const step = 1e-6 * (Math.abs(u[n]) || 1);
      trial[n] = u[n] + step;
      const then = miss();
      trial[n] = u[n];
      return then ? [(now[0] - then[0]) / step, (now[1] - then[1]) / step] : [0, 0];
    });
    const scale = by.map((n) => Math.abs(u[n]) || 1);
    let a = 0, b = 0, c = 0;
    slopes.forEach(([sx, sy], k) => (a += (sx * scale[k]) ** 2, b += sx * sy * scale[k] ** 2, c += (sy * scale[k]) ** 2));
    const damp = 1e-9 * (a + c) + 1e-300, det = (a + damp) * (c + damp) - b * b;
    const l = [((c + damp) * now[0] - b * now[1]) / det, ((a + damp) * now[1] - b * now[0]) / det];
    for (let part = 1; part > 0.05; part /= 2) {
      by.forEach((n, k) => (trial[n] = u[n] + part * scale[k] ** 2 * (slopes[k][0] * l[0] + slopes[k][1] * l[1])));
      const then = miss();
      if (then && Math.hypot(...then) < Math.hypot(...now)) {
        by.forEach((n) => (u[n] = trial[n]));
        break;
      }
    }
  }
}

function numbers(h: Handle): number[] {
  if ("by" in h && h.by) return h.by;
  if (h.kind === "load") return [...(h.components ?? []), ...[h.size, h.direction].filter((n) => n !== undefined)];
  return h.kind === "direction" ? [h.direction] : h.ends.flatMap((e) => e.n);
}

function handle(layer: Element, b: Board, h: Handle, kernel: Kernel, hold: Hold, perMm: () => number): () => void {
  const names = { joint: "joint", point: "point", center: "", load: "force", direction: "direction of" };
  const said = `${names[h.kind]} ${h.name}`.trim();
  const dot = make("circle", layer, {
    class: `handle ${h.kind}`, r: h.kind === "joint" ? 2.6 : 2, tabindex: 0, role: "slider", "aria-label": `move ${said}`,
    "aria-valuetext": said, "aria-valuenow": 0, "data-kind": h.kind, "data-name": h.name,
  });
  make("title", dot).textContent = `drag ${said}`;
  const paper = b.paper, v = kernel.here;
  let start: number[][] = [], moving = false;

  const where = (): Point => {
    const p = paper.point(h.p);
    if (h.kind === "load") return [p[0] + v[h.f[0]] / perMm(), p[1] - v[h.f[1]] / perMm()];
    if (h.kind === "direction") return [p[0] + 16 * v[h.along[0]], p[1] - 16 * v[h.along[1]]];
    return p;
  };
  const begin = () => {
    start = "ends" in h ? h.ends.map((e) => held(kernel, e)) : [h.e.map((r) => v[r])];
    moving = true;
  };
  const to = (at: Point) => {
    const [x, y] = paper.metres(at);
    if ("by" in h && h.by) follow(kernel, h.p, h.by, x, y);
    else if ("ends" in h) h.ends.forEach((e, k) => set(kernel, e, start[k], x, y));
    else {
      const [c, s] = start[0], p = paper.point(h.p), gx = at[0] - p[0], gy = p[1] - at[1];
      const local: Point = [c * gx + s * gy, c * gy - s * gx];
      if (h.kind === "direction") kernel.values[h.direction] = near(Math.atan2(local[1], local[0]), kernel.values[h.direction]);
      else if (h.components) h.components.forEach((n, k) => (kernel.values[n] = local[k] * perMm()));
      else turnLoad(h, local);
    }
    hold.changed();
  };
  const turnLoad = (h: Handle & { kind: "load" }, local: Point) => {
    const u = kernel.values, size = Math.hypot(...local) * perMm(), sign = Math.sign(u[h.size!]) || 1;
    if (h.direction !== undefined) {
      u[h.direction] = near(Math.atan2(sign * local[1], sign * local[0]), u[h.direction]);
      u[h.size!] = sign * size;
    } else {
      const p = [v[h.f[0]], v[h.f[1]]], [c, s] = start[0], way = [c * p[0] + s * p[1], c * p[1] - s * p[0]];
      const long = Math.hypot(...way) || 1;
      u[h.size!] = (sign * (local[0] * way[0] + local[1] * way[1]) * perMm()) / long;
    }
  };
  const finish = () => {
    if (moving) hold.finished(numbers(h));
    moving = false;
  };
  dot.addEventListener("pointerdown", (e) => {
    e.stopPropagation();
    dot.setPointerCapture(e.pointerId);
    begin();
  });
  dot.addEventListener("pointermove", (e) => moving && to(point(b, e)));
  dot.addEventListener("pointerup", finish);
  dot.addEventListener("pointercancel", finish);
  dot.addEventListener("keydown", (e) => {
    const step: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (!step[e.key]) return;
    e.preventDefault();
    e.stopPropagation();
    begin();
    const at = where(), by = e.shiftKey ? 5 : 1;
    to([at[0] + by * step[e.key][0], at[1] + by * step[e.key][1]]);
    finish();
  });
  return () => {
    if (h.kind === "direction" && moving) return;
    const [x, y] = where();
    dot.setAttribute("visibility", Number.isFinite(x + y) ? "visible" : "hidden");
    dot.setAttribute("cx", x.toFixed(2));
    dot.setAttribute("cy", y.toFixed(2));
  };
}

/** The same angle, within half a turn of another. */
const near = (angle: number, other: number): number => angle - 2 * Math.PI * Math.round((angle - other) / (2 * Math.PI));

function point(b: Board, e: PointerEvent): Point {
  const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(b.svg.getScreenCTM()!.inverse());
  return [p.x, p.y];
}

/** Dragging the driven link takes the drive along. */
function drive(b: Board, data: Data, kernel: Kernel, hold: Hold): void {
  const d = data.drives[0];
  if (!d || kernel.count < 2) return;
  let from = 0, base = 0, turning = false;
  const measure = (e: PointerEvent): number => {
    const p = point(b, e), o = b.paper.point(d.p);
    return d.turns ? Math.atan2(o[1] - p[1], p[0] - o[0]) : 0;
  };
  b.svg.addEventListener("pointerdown", (e) => {
    const link = (e.target as Element).closest<SVGElement>("[data-link]");
    if (!link || link.dataset.link !== d.link || !d.turns) return;
    b.svg.setPointerCapture(e.pointerId);
    [from, base, turning] = [measure(e), hold.time(), true];
  });
  b.svg.addEventListener("pointermove", (e) => {
    if (!turning) return;
    const step = (kernel.position(d.name, kernel.count - 1) - kernel.position(d.name, 0)) / (kernel.count - 1);
    const now = measure(e);
    let t = base + near(now - from, 0) / step;
    if (kernel.cyclic) t = ((t % kernel.count) + kernel.count) % kernel.count;
    [from, base] = [now, t];
    hold.seek(t);
  });
  b.svg.addEventListener("pointerup", () => (turning = false));
}
