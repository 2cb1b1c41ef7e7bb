/** Parts of a mechanism as SVG elements that follow the kernel's rows: symbols placed, hulls, traces, arrows. */

import type { Action, Couple, Data, Item, Rows } from "./data";
import { label, type Placed, type Placer, say } from "./labels";
import type { Source } from "./source";
import { Arrow, attr, figures, hull, make, path, plain, type Point, set, short } from "./svg";

const along = (axis: number[], rows: Rows, value: (row: number) => number): number => rows.reduce((t, r, k) => t + axis[k] * value(r), 0);

/** From metres to paper, about a movable centre; in space through a camera at an azimuth and an elevation. */
export class Paper {
  middle: Point = [0, 0];
  /** Unit vectors to the right, up and to the eye. */
  axes = [[1, 0], [0, 1]];
  /** Values beside the names of arrows. */
  values = false;
  /** ``camera``: azimuth and elevation of the eye, in space. */
  constructor(readonly kernel: Source, public perMm: number, readonly units: Data["units"], private readonly camera: [number, number] | null) {
    if (camera) this.turn(0, 0);
  }
  /** Changes the direction of view. */
  turn(across: number, up: number): void {
    const c = this.camera!;
    c[0] += across;
    c[1] = Math.min(Math.max(c[1] + up, -1.55), 1.55);
    const ca = Math.cos(c[0]), sa = Math.sin(c[0]), ce = Math.cos(c[1]), se = Math.sin(c[1]);
    this.axes = [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
  }
  /** Components of any vector to the right and up, in its unit. */
  seen(rows: Rows, value: (row: number) => number): Point {
    return rows.length < 3 ? [value(rows[0]), value(rows[1])] : [along(this.axes[0], rows, value), along(this.axes[1], rows, value)];
  }
  /** Nearness to the eye of a vector's tip. */
  depth(rows: Rows): number {
    return along(this.axes[2], rows, (r) => this.kernel.here[r]);
  }
  here(rows: Rows): Point {
    return this.seen(rows, (r) => this.kernel.here[r]);
  }
  point(at: Rows): Point {
    return this.of(...this.here(at));
  }
  /** Place of a point at position k. */
  pointAt(at: Rows, k: number): Point {
    return this.of(...this.seen(at, (r) => this.kernel.value(r, k)));
  }
  of(x: number, y: number): Point {
    return [(x - this.middle[0]) / this.perMm, (this.middle[1] - y) / this.perMm];
  }
  /** Projection of a vector of the machine. */
  project(v: number[]): Point {
    return this.seen(v.map((_, k) => k), (k) => v[k]);
  }
  /** A vector of the paper's plane, mm to the right and down, as one of the machine, metres. */
  vector(d: Point): number[] {
    return this.axes[0].map((x, k) => (d[0] * x - d[1] * this.axes[1][k]) * this.perMm);
  }
  metres(p: Point): Point {
    return [this.middle[0] + p[0] * this.perMm, this.middle[1] - p[1] * this.perMm];
  }
}

/** Updates of an element, and the areas that labels must avoid. */
export interface Part { update(): void; mark?(placer: Placer): void }

export function item(parent: Element, i: Item, paper: Paper): Part {
  const part = drawn(parent, i, paper);
  if (i.of) (parent.lastElementChild as SVGElement).dataset.item = i.of.join(":");
  return part;
}

function drawn(parent: Element, i: Item, paper: Paper): Part {
  const v = paper.kernel.here;
  if (i.t === "symbol") {
    const g = make("g", parent, i.per_mm ? { class: "span" } : {});
    g.innerHTML = i.svg;
    return {
      update() {
        const [x, y] = paper.point(i.p);
        const size = i.per_mm ? ` scale(${(i.per_mm / paper.perMm).toFixed(4)})` : "";
        const turn = i.e ? ` rotate(${short((-Math.atan2(v[i.e[1]], v[i.e[0]]) * 180) / Math.PI)})` : "";
        attr(g, "transform", `translate(${short(x)} ${short(y)})${turn}${size}`);
      },
      mark: (placer) => placer.disc(paper.point(i.p), 1.6),
    };
  }
  if (i.t === "span") {
    const g = make("g", parent, { class: "span" });
    g.innerHTML = i.svg;
    return {
      update() {
        const [[ax, ay], [bx, by]] = i.p.map((p) => paper.point(p));
        const long = Math.hypot(bx - ax, by - ay), turn = (Math.atan2(by - ay, bx - ax) * 180) / Math.PI;
        attr(g, "transform", `translate(${short(ax)} ${short(ay)}) rotate(${short(turn)}) scale(${(long / i.length).toFixed(4)} 1)`);
      },
      mark: (placer) => placer.line(paper.point(i.p[0]), paper.point(i.p[1])),
    };
  }
  if (i.t === "circle") {
    const c = make("circle", parent, { class: `l-${i.role}` });
    return {
      update() {
        const [x, y] = paper.point(i.p);
        set(c, { cx: short(x), cy: short(y), r: short(Math.abs(v[i.r]) / paper.perMm) });
      },
    };
  }
  if (i.t === "pair") return pair(parent, i, paper);
  const line = make("path", parent, { class: `l-${i.role}`, style: "fill:none" });
  if (i.t === "trace") return { update: () => attr(line, "d", curve(paper.kernel, (k) => paper.pointAt(i.p[0], k), true)) };
  if (i.t === "hull") line.dataset.link = i.link;
  if (i.t === "arc") return { update: () => attr(line, "d", arc(i.p.map((p) => paper.point(p)), i.ccw)) };
  let corners: Point[] = [], area = false;
  return {
    update() {
      const points = i.p.map((p) => paper.point(p)), round = i.t === "hull" ? hull(points) : points;
      area = i.t === "hull" && round.length > 2;
      corners = area ? round : points;
      if (i.t === "hull") set(line, { class: area ? "l-link-area" : "l-link", style: area ? "" : "fill:none" });
      attr(line, "d", path(corners, area));
    },
    mark(placer) {
      corners.forEach((c, n) => (n || area) && placer.line(corners.at(n - 1)!, c));
    },
  };
}

/** An arc about a centre from one point to another, counter-clockwise on paper or not. */
function arc([c, a, b]: Point[], ccw: boolean): string {
  const at = ([x, y]: Point): number => Math.atan2(c[1] - y, x - c[0]), turn = (at(b) - at(a)) * (ccw ? 1 : -1);
  const r = short(Math.hypot(a[0] - c[0], a[1] - c[1])), large = (turn + 4 * Math.PI) % (2 * Math.PI) > Math.PI;
  return `M${short(a[0])} ${short(a[1])}A${r} ${r} 0 ${+large} ${+!ccw} ${short(b[0])} ${short(b[1])}`;
}

/** A joint in space: a cylinder or a block along its axis, or a ball; with a size a wheel. */
function pair(parent: Element, i: Item & { t: "pair" }, paper: Paper): Part {
  const g = make("g", parent), look = i.size ? "link-area" : i.fixed ? "support" : "block";
  const side = make("path", g, { class: `l-${look}` }), end = make("path", g, { class: `l-${i.shape === "ball" || i.size ? look : "pin"}` });
  let half = i.shape === "block" ? 4.2 : 3.4, r = i.shape === "block" ? 2.2 : 1.7;
  return {
    update() {
      if (i.size) [r, half] = i.size.map((x) => +short(x / paper.perMm));
      const [x, y] = paper.point(i.p), [ex, ey] = paper.here(i.e), away = paper.depth(i.e);
      attr(g, "transform", `translate(${short(x)} ${short(y)}) rotate(${short((-Math.atan2(ey, ex) * 180) / Math.PI)})`);
      if (i.shape === "ball") return attr(side, "d", `M${r} 0A${r} ${r} 0 1 0 ${-r} 0A${r} ${r} 0 1 0 ${r} 0Z`);
      const long = half * Math.hypot(ex, ey), wide = r * Math.abs(away), near = away >= 0 ? long : -long;
      if (i.shape === "round") {
        attr(side, "d", `M${short(-long)} ${-r}L${short(long)} ${-r}A${short(wide)} ${r} 0 0 1 ${short(long)} ${r}L${short(-long)} ${r}A${short(wide)} ${r} 0 0 1 ${short(-long)} ${-r}Z`);
        attr(end, "d", `M${short(near + wide)} 0A${short(wide)} ${r} 0 1 0 ${short(near - wide)} 0A${short(wide)} ${r} 0 1 0 ${short(near + wide)} 0Z`);
      } else {
        attr(side, "d", `M${short(-long - wide)} ${-r}H${short(long + wide)}V${r}H${short(-long - wide)}Z`);
        attr(end, "d", `M${short(near - wide)} ${-r}H${short(near + wide)}V${r}H${short(near - wide)}Z`);
      }
    },
    mark(placer) {
      if (i.size) return;
      const [x, y] = paper.point(i.p), [ex, ey] = paper.here(i.e), long = i.shape === "ball" ? 0 : half;
      placer.disc([x, y], 2.4);
      placer.line([x - long * ex, y + long * ey], [x + long * ex, y - long * ey]);
    },
  };
}

/** Positions beyond which points are left out that a line through others passes within THIN mm, MOST in a row at most. */
const DENSE = 240, THIN = 0.04, MOST = 12;
/** While numbers are dragged, each of so many positions is drawn of a long curve. */
const COARSE = 3;

/** True if the points from one to another, without their ends, lie within THIN of the line between these. */
function straight(points: Float64Array, from: number, to: number): boolean {
  const x = points[2 * from], y = points[2 * from + 1], dx = points[2 * to] - x, dy = points[2 * to + 1] - y, long = dx * dx + dy * dy;
  for (let n = from + 1; n < to; n++) {
    const u = points[2 * n] - x, v = points[2 * n + 1] - y, along = u * dx + v * dy;
    if ((u * dy - v * dx) ** 2 > THIN * THIN * long || along < 0 || along > long) return false;
  }
  return true;
}

/** A curve over the cycle, with gaps where no answer exists; ``closed`` if the cycle continues from its end. */
export function curve(k: Source, at: (n: number) => Point, closed = false): string {
  const last = closed && k.cyclic ? k.count : k.count - 1, dense = k.count > DENSE, step = dense && k.coarse ? COARSE : 1;
  const ends = Math.ceil(last / step), points = new Float64Array(2 * ends + 2);
  let d = "", drawn = -1;
  const put = (c: number, pen = "L"): void => {
    d += `${pen}${short(points[2 * c])} ${short(points[2 * c + 1])}`;
    drawn = c;
  };
  for (let c = 0; c <= ends; c++) {
    const n = Math.min(c * step, last) % k.count, good = !!k.good[n];
    if (good) points.set(at(n), 2 * c);
    if (good && drawn < 0) put(c, "M");
    else if (drawn >= 0 && drawn < c - 1 && !(good && dense && c - drawn <= MOST && straight(points, drawn, c))) put(c - 1);
    if (!good) drawn = -1;
    else if (k.reverses(n)) {
      if (drawn < c) put(c);
      points.set(k.onceAfter(() => at(n)), 2 * c);
      put(c);
    }
  }
  if (drawn >= 0 && drawn < ends) put(ends);
  return d;
}

/** ``anchor``: possible places of the label, the best first, then its preferred direction; ``hide``: not drawn. */
export interface Shown extends Part { label: Placed; anchor(): Point[] | null; hide(): void }

/** The name of an arrow, on demand with its value. */
function named(l: Placed, name: string, size: number, kind: string, paper: Paper): void {
  const { unit, size: one } = paper.units[kind] ?? { unit: "", size: 1 };
  say(l, paper.values ? `${name} = ${figures(size / one)} ${unit}`.trim() : name);
}

/** A force as an arrow from its point, or to it where it pushes inwards; a couple as a curved arrow. */
export function action(parent: Element, a: Action, paper: Paper, perMm: () => number, about?: Rows[], unit = "force"): Shown {
  return a.t === "couple" ? couple(parent, a, paper) : arrow(parent, a, paper, perMm, about, unit);
}

/** An arrow as something that can be pointed at; a joint's force is told from the joint. */
const marked = (g: SVGGElement, a: Action): void => void (g.dataset.item = `${a.kind === "joint" ? "reaction" : a.kind}:${a.of}`);

/** Length in mm of the arrow of a moment in space: its size is printed, its axis drawn. */
const MOMENT = 13;

function arrow(parent: Element, a: Action, paper: Paper, perMm: () => number, about: Rows[] | undefined, unit: string): Shown {
  const first = new Arrow(parent, a.role, a.name), second = a.t === "force" ? null : new Arrow(parent, a.role);
  const rows = a.t === "force" ? a.f : a.m;
  const l = label(parent, a.role, a.name, 3.4);
  let tail: Point = [0, 0], tip: Point = [0, 0], free: Point = [0, 0], shown = false;
  for (const one of [first, second]) if (one) marked(one.g, a);
  return {
    label: l,
    hide() {
      shown = first.set([0, 0], [0, 0]);
      second?.set([0, 0], [0, 0]);
      attr(l.el, "visibility", "hidden");
    },
    update() {
      const p = paper.point(a.p), [fx, fy] = paper.here(rows);
      const whole = second ? Math.hypot(...rows.map((r) => paper.kernel.here[r])) / MOMENT || 1 : perMm();
      const d: Point = [fx / whole, -fy / whole];
      let inward = false;
      if (about && about.length > 1 && !second) {
        const some = about.map((r) => paper.point(r));
        const mean = [0, 1].map((c) => some.reduce((t, q) => t + q[c], 0) / some.length);
        inward = d[0] * (mean[0] - p[0]) + d[1] * (mean[1] - p[1]) > 1e-9;
      }
      [tail, tip] = inward ? [[p[0] - d[0], p[1] - d[1]], p] : [p, [p[0] + d[0], p[1] + d[1]]];
      free = inward ? tail : tip;
      shown = first.set(tail, tip);
      second?.set(tail, [tail[0] + 0.78 * (tip[0] - tail[0]), tail[1] + 0.78 * (tip[1] - tail[1])]);
      attr(l.el, "visibility", shown ? "visible" : "hidden");
      if (shown) named(l, a.name, Math.hypot(...rows.map((r) => paper.kernel.here[r])), second ? "moment" : unit, paper);
    },
    mark: (placer) => shown && placer.line(tail, tip),
    anchor() {
      if (!shown) return null;
      const other = free === tail ? tip : tail, way: Point = [free[0] - other[0], free[1] - other[1]];
      return [free, [free[0] - 0.35 * way[0], free[1] - 0.35 * way[1]], way];
    },
  };
}

const RADIUS = 4.6;

function couple(parent: Element, a: Couple, paper: Paper): Shown {
  const v = paper.kernel.here, g = make("g", parent), l = label(parent, a.role, a.name, 3.4);
  make("title", g).textContent = plain(a.name);
  make("path", g, { class: `l-${a.role}`, style: "fill:none", d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94" });
  make("path", g, { class: `l-${a.role}-h`, d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z" });
  let shown = false;
  marked(g, a);
  return {
    label: l,
    hide() {
      shown = false;
      attr(g, "display", "none");
      attr(l.el, "visibility", "hidden");
    },
    update() {
      const [x, y] = paper.point(a.p), m = v[a.m[0]];
      shown = Number.isFinite(m) && Math.abs(m) > 1e-9;
      attr(g, "display", shown ? "inline" : "none");
      attr(l.el, "visibility", shown ? "visible" : "hidden");
      attr(g, "transform", `translate(${short(x)} ${short(y)}) scale(${m < 0 ? -1 : 1} 1)`);
      if (shown) named(l, a.name, Math.abs(m), "moment", paper);
    },
    mark(placer) {
      if (shown) placer.disc(paper.point(a.p), RADIUS);
    },
    anchor() {
      const [x, y] = paper.point(a.p);
      return shown ? [[x, y - RADIUS], [x - RADIUS, y], [x + RADIUS, y], [x, y + RADIUS], [0, -1]] : null;
    },
  };
}
