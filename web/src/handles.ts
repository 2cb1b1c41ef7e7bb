/** Draggable handles: joints, points, mass centres, tips of loads, directions. */

import type { Board } from "./board";
import type { Data, End, Handle, Rows } from "./data";
import type { Paper } from "./items";
import type { Kernel } from "./kernel";
import { make, type Point, pointer, set, short } from "./svg";

export interface Hold { changed(): void; finished(): void }

export function handles(b: Board, data: Data, kernel: Kernel, hold: Hold): () => void {
  const layer = make("g", b.svg, { class: "handles" });
  const updates = data.handles.map((h) => handle(layer, b, h, kernel, hold));
  return () => kernel.finite && updates.forEach((f) => f());
}

const dot = (a: readonly number[], b: readonly number[]): number => a.reduce((t, x, k) => t + x * b[k], 0);

/** Unit vectors of a link at a pose, and its origin. */
interface Held { axes: number[][]; at: number[] }

/** Parameters that bring a joint as near to a place on paper as possible: damped Gauss-Newton steps, by differences. */
function follow(kernel: Kernel, paper: Paper, p: Rows, by: number[], [x, y]: Point): void {
  const u = kernel.values, out = new Float64Array(kernel.here.length), trial = u.slice();
  const miss = (): Point | null => {
    kernel.other(trial, out);
    const at = paper.seen(p, (r) => out[r]), d: Point = [x - at[0], y - at[1]];
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

function handle(layer: Element, b: Board, h: Handle, kernel: Kernel, hold: Hold): () => void {
  const names = { joint: "joint", point: "point", center: "", load: "force", direction: "direction of" };
  const said = `${names[h.kind]} ${h.name}`.trim();
  const knob = make("circle", layer, {
    class: `handle ${h.kind}`, r: h.kind === "joint" ? 2.6 : 2, tabindex: 0, role: "slider", "aria-label": `move ${said}`,
    "aria-valuetext": said, "aria-valuenow": 0, "data-kind": h.kind, "data-name": h.name,
    "data-item": h.kind === "center" ? `center:${h.name.split(":")[0]}` : `${h.kind}:${h.name}`,
  });
  make("title", knob).textContent = `drag ${said}`;
  const paper = b.paper, u = kernel.values, here = (rows: Rows): number[] => rows.map((r) => kernel.here[r]);
  let held: Held[] = [], place: number[] = [], from: Point = [0, 0], acting: number[] = [], middle: number[] = [], grip: Point = [0, 0], moving = false;

  const where = (): Point => {
    const p = paper.point(h.p), way = "f" in h ? paper.here(h.f) : "along" in h ? paper.here(h.along) : [0, 0];
    const long = h.kind === "direction" ? 16 : 1 / b.force();
    return [p[0] + long * way[0], p[1] - long * way[1]];
  };
  const begin = () => {
    const one = (axes: Rows[], at: Rows): Held => ({ axes: axes.map(here), at: here(at) });
    held = "ends" in h ? h.ends.map((e) => one(e.axes, e.at)) : [one(h.axes, h.p)];
    [place, from, acting, moving] = [here(h.p), where(), "f" in h ? here(h.f) : [], true];
    middle = "about" in h && h.about ? here(h.about) : [];
  };
  /** Displacement of the handle, in the plane of the paper, metres. */
  const went = (at: Point): number[] => paper.vector([at[0] - from[0], at[1] - from[1]]);
  const to = (at: Point) => {
    if ("by" in h && h.by) follow(kernel, paper, h.p, h.by, paper.metres(at));
    else if ("ends" in h) move(h.ends, round(went(at)));
    else if (h.kind === "direction") {
      const p = paper.point(h.p), way = [at[0] - p[0], p[1] - at[1]], [x, y] = held[0].axes.map((axis) => dot(axis, way));
      u[h.direction] = near(Math.atan2(y, x), u[h.direction]);
    } else turnLoad(h, went(at).map((x, k) => acting[k] + (x / paper.perMm) * b.force()));
    hold.changed();
  };
  /** Displacement of a wheel's centre that must keep its distance from another's. */
  const round = (by: number[]): number[] => {
    if (!("about" in h) || !h.about) return by;
    const c = middle, arm = place.map((x, k) => x - c[k]), far = arm.map((x, k) => x + by[k]), size = Math.hypot(...arm) / (Math.hypot(...far) || 1);
    return far.map((x, k) => c[k] + size * x - place[k]);
  };
  /** Moves the point in each of its links, which stay in place. */
  const move = (ends: End[], by: number[]) =>
    ends.forEach((e, k) => {
      const arm = place.map((x, c) => x + by[c] - held[k].at[c]);
      e.n.forEach((n, c) => (u[n] = dot(held[k].axes[c], arm)));
    });
  const turnLoad = (h: Handle & { kind: "load" }, force: number[]) => {
    const local = held[0].axes.map((axis) => dot(axis, force));
    if (h.components) return h.components.forEach((n, k) => (u[n] = local[k]));
    const sign = Math.sign(u[h.size!]) || 1;
    if (h.direction !== undefined) {
      u[h.direction] = near(Math.atan2(sign * local[1], sign * local[0]), u[h.direction]);
      u[h.size!] = sign * Math.hypot(...local);
    } else u[h.size!] = (sign * dot(force, acting)) / (Math.hypot(...acting) || 1);
  };
  const finish = () => {
    if (moving) hold.finished();
    moving = false;
  };
  knob.addEventListener("pointerdown", (e) => {
    if (e.button !== 0) return;
    e.stopPropagation();
    knob.setPointerCapture(e.pointerId);
    begin();
    const p = pointer(b.svg, e);
    grip = [from[0] - p[0], from[1] - p[1]];
  });
  knob.addEventListener("pointermove", (e) => {
    const p = pointer(b.svg, e);
    if (moving) to([p[0] + grip[0], p[1] + grip[1]]);
  });
  knob.addEventListener("pointerup", finish);
  knob.addEventListener("pointercancel", finish);
  knob.addEventListener("keydown", (e) => {
    const step: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (!step[e.key]) return;
    e.preventDefault();
    e.stopPropagation();
    begin();
    const by = e.shiftKey ? 5 : 1;
    to([from[0] + by * step[e.key][0], from[1] + by * step[e.key][1]]);
    finish();
  });
  return () => {
    if (h.kind === "direction" && moving) return;
    const [x, y] = where();
    set(knob, { visibility: Number.isFinite(x + y) ? "visible" : "hidden", cx: short(x), cy: short(y) });
  };
}

/** The same angle, within half a turn of another. */
const near = (angle: number, other: number): number => angle - 2 * Math.PI * Math.round((angle - other) / (2 * Math.PI));
