/** Parts of a mechanism as SVG elements that follow the kernel's rows: symbols placed, hulls, traces, arrows. */

import type { Action, Item, Pair } from "./data";
import type { Kernel } from "./kernel";
import { label, type Placed, type Placer } from "./labels";
import { Arrow, hull, make, path, plain, type Point, short } from "./svg";

/** From metres to paper, about a middle that may move. */
export class Paper {
  middle: Point = [0, 0];
  constructor(readonly kernel: Kernel, public perMm: number) {}
  point(at: Pair): Point {
    return this.of(this.kernel.here[at[0]], this.kernel.here[at[1]]);
  }
  of(x: number, y: number): Point {
    return [(x - this.middle[0]) / this.perMm, (this.middle[1] - y) / this.perMm];
  }
  metres(p: Point): Point {
    return [this.middle[0] + p[0] * this.perMm, this.middle[1] - p[1] * this.perMm];
  }
}

/** What brings an element up to date, and what it asks labels to keep free. */
export interface Part { update(): void; mark?(placer: Placer): void }

export function item(parent: Element, i: Item, paper: Paper): Part {
  const k = paper.kernel, v = k.here;
  if (i.t === "symbol") {
    const g = make("g", parent, i.per_mm ? { class: "span" } : {});
    g.innerHTML = i.svg;
    return {
      update() {
        const [x, y] = paper.point(i.p);
        const size = i.per_mm ? ` scale(${(i.per_mm / paper.perMm).toFixed(4)})` : "";
        const turn = i.e ? ` rotate(${short((-Math.atan2(v[i.e[1]], v[i.e[0]]) * 180) / Math.PI)})` : "";
        g.setAttribute("transform", `translate(${short(x)} ${short(y)})${turn}${size}`);
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
        g.setAttribute("transform", `translate(${short(ax)} ${short(ay)}) rotate(${short(turn)}) scale(${(long / i.length).toFixed(4)} 1)`);
      },
      mark: (placer) => placer.line(paper.point(i.p[0]), paper.point(i.p[1])),
    };
  }
  if (i.t === "circle") {
    const c = make("circle", parent, { class: `l-${i.role}` });
    return {
      update() {
        const [x, y] = paper.point(i.p);
        c.setAttribute("cx", short(x));
        c.setAttribute("cy", short(y));
        c.setAttribute("r", short(Math.abs(v[i.r]) / paper.perMm));
      },
    };
  }
  const line = make("path", parent, { class: `l-${i.role}`, style: "fill:none" });
  if (i.t === "trace") return { update: () => line.setAttribute("d", trace(k, paper, i.p[0])) };
  const corners = (): Point[] => i.p.map((p) => paper.point(p));
  const mark = (placer: Placer) => {
    const c = i.t === "hull" ? hull(corners()) : corners();
    for (let n = 0; n + 1 < c.length; n++) placer.line(c[n], c[n + 1]);
    if (c.length > 2) placer.line(c[c.length - 1], c[0]);
  };
  if (i.t === "path") return { update: () => line.setAttribute("d", path(corners())), mark };
  line.dataset.link = i.link;
  return {
    update() {
      const c = hull(corners()), area = c.length > 2;
      line.setAttribute("class", area ? "l-link-area" : "l-link");
      line.setAttribute("style", area ? "" : "fill:none");
      line.setAttribute("d", path(area ? c : corners(), area));
    },
    mark,
  };
}

/** The way of a point over the cycle, broken where there is no answer. */
function trace(k: Kernel, paper: Paper, p: Pair): string {
  let d = "", pen = false;
  for (let c = 0; c <= k.count; c++) {
    const n = c < k.count ? c : 0;
    if (!k.good(n) || (c === k.count && !k.cyclic)) {
      pen = false;
      continue;
    }
    const [x, y] = paper.of(k.value(p[0], n), k.value(p[1], n));
    d += `${pen ? "L" : "M"}${short(x)} ${short(y)}`;
    pen = true;
  }
  return d;
}

/** ``anchor``: places where the label may stand, the best first, and last the way that it had better go. */
export interface Shown extends Part { label: Placed; anchor(): Point[] | null }

/** A force as an arrow from its point, or to it where it pushes inwards; a couple as a curved arrow. */
export function action(parent: Element, a: Action, paper: Paper, perMm: () => number, about?: Pair[]): Shown {
  return a.t === "force" ? force(parent, a, paper, perMm, about) : couple(parent, a, paper);
}

function force(parent: Element, a: Action & { t: "force" }, paper: Paper, perMm: () => number, about?: Pair[]): Shown {
  const v = paper.kernel.here, arrow = new Arrow(parent, a.role, a.name), l = label(parent, a.role, a.name, 3.4);
  let tail: Point = [0, 0], tip: Point = [0, 0], free: Point = [0, 0], shown = false;
  return {
    label: l,
    update() {
      const p = paper.point(a.p), s = perMm(), d: Point = [v[a.f[0]] / s, -v[a.f[1]] / s];
      let inward = false;
      if (about && about.length > 1) {
        const some = about.map((r) => paper.point(r));
        const mean = [0, 1].map((c) => some.reduce((t, q) => t + q[c], 0) / some.length);
        inward = d[0] * (mean[0] - p[0]) + d[1] * (mean[1] - p[1]) > 1e-9;
      }
      [tail, tip] = inward ? [[p[0] - d[0], p[1] - d[1]], p] : [p, [p[0] + d[0], p[1] + d[1]]];
      free = inward ? tail : tip;
      shown = arrow.set(tail, tip);
      l.el.setAttribute("visibility", shown ? "visible" : "hidden");
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

function couple(parent: Element, a: Action & { t: "couple" }, paper: Paper): Shown {
  const v = paper.kernel.here, g = make("g", parent), l = label(parent, a.role, a.name, 3.4);
  make("title", g).textContent = plain(a.name);
  make("path", g, { class: `l-${a.role}`, style: "fill:none", d: "M4.17 1.94A4.6 4.6 0 1 0 -4.17 1.94" });
  make("path", g, { class: `l-${a.role}-h`, d: "M-4.17 2.9L-5.6 -0.1L-3 0.3Z" });
  let shown = false;
  return {
    label: l,
    update() {
      const [x, y] = paper.point(a.p), m = v[a.m];
      shown = Number.isFinite(m) && Math.abs(m) > 1e-9;
      g.setAttribute("display", shown ? "inline" : "none");
      l.el.setAttribute("visibility", shown ? "visible" : "hidden");
      g.setAttribute("transform", `translate(${short(x)} ${short(y)}) scale(${m < 0 ? -1 : 1} 1)`);
    },
    mark(placer) {
      if (shown) placer.disc(paper.point(a.p), RADIUS * 0.7);
    },
    anchor() {
      const [x, y] = paper.point(a.p);
      return shown ? [[x, y - RADIUS], [0, -1]] : null;
    },
  };
}
