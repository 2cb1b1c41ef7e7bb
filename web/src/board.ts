/** The drawing of a mechanism or of a free body: items, arrows at a stated scale, labels placed without overlaps. */

import type { Data, Drawing, FreeBody, Item, Pair, Rows } from "./data";
import { action, item, Paper, type Part, type Shown } from "./items";
import type { Kernel } from "./kernel";
import { label, type Placed, Placer } from "./labels";
import { figures, make, path, type Point, set, short, width } from "./svg";

/** ``need``: newtons per mm at which every force fits; ``fit``: new scales, with forces to that scale or another. */
export interface Board {
  svg: SVGSVGElement; paper: Paper; names: boolean;
  update(cycle: boolean): void; fit(force?: number): void; need(): number; force(): number; resize(w: number, h: number): void;
}

const ROUND = [1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];

/** The next round number: 1, 1.25, 1.5, 2 ... times a power of ten. */
export function roundUp(x: number): number {
  if (!(x > 0) || !Number.isFinite(x)) return 1;
  const power = 10 ** Math.floor(Math.log10(x) + 1e-12);
  return power * (ROUND.find((r) => r * power >= x * (1 - 1e-12)) ?? 10);
}

/** The round number below: 1, 2 or 5 times a power of ten. */
function roundDown(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x) + 1e-12);
  return power * ([5, 2].find((r) => r * power <= x * (1 + 1e-12)) ?? 1);
}

/** Low and high ends of some points to the right and up; null without points. */
export function bounds(points: Point[]): { x: Point; y: Point } | null {
  const span = (some: number[]): Point => [Math.min(...some), Math.max(...some)];
  const x = span(points.map((p) => p[0])), y = span(points.map((p) => p[1]));
  return Number.isFinite(x[0] + x[1] + y[0] + y[1]) ? { x, y } : null;
}

const rowsOf = (i: Item): Rows[] => (i.t === "hull" || i.t === "path" ? i.p : i.t === "symbol" || i.t === "pair" ? [i.p] : []);

/** Extent of a drawing's items over the cycle, in projected metres. */
function cycleBounds(paper: Paper, d: Drawing): ReturnType<typeof bounds> {
  const k = paper.kernel, step = Math.max(1, Math.floor(k.count / 72)), points: Point[] = [];
  for (const rows of d.items.flatMap(rowsOf))
    for (let n = 0; n < k.count; n += step) if (k.good[n]) points.push(paper.seen(rows, (r) => k.value(r, n)));
  return bounds(points);
}

const inSpace = (d: Drawing): boolean => d.items.some((i) => i.t === "pair");

/** A scale bar for a round number of a unit: true at any zoom and in any print. */
export class ScaleBar {
  private readonly line: SVGPathElement;
  private readonly text: SVGTextElement;
  constructor(parent: Element, private readonly arrow = false) {
    const g = make("g", parent, { class: "scale" });
    this.line = make("path", g, { class: "l-axis", style: "fill:none" });
    this.text = make("text", g, { class: "l-note-t", "font-size": 2.8 });
  }
  /** Draws from the left end at a place: ``size`` of SI per mm, in a unit; returns the right end. */
  set([x, y]: Point, size: number, unit: { unit: string; size: number }): number {
    const perMm = size / unit.size, known = perMm > 0 && Number.isFinite(perMm);
    this.line.setAttribute("visibility", known ? "visible" : "hidden");
    this.text.textContent = "";
    if (!known) return x;
    const value = roundDown(26 * perMm), long = value / perMm, end = x + long, said = `${figures(value)} ${unit.unit}`;
    const tick = `M${short(x)} ${short(y - 1)}v2`;
    const close = this.arrow ? `M${short(end - 2.4)} ${short(y - 0.8)}L${short(end)} ${short(y)}L${short(end - 2.4)} ${short(y + 0.8)}` : `M${short(end)} ${short(y - 1)}v2`;
    this.line.setAttribute("d", tick + path([[x, y], [end, y]]) + close);
    set(this.text, { x: short(end + 1.4), y: short(y + 1) }).textContent = said;
    return end + 1.4 + width(said, 2.8);
  }
}

export function canvas(parent: Element, width: number, height: number, name: string): SVGSVGElement {
  return make("svg", parent, { viewBox: `${-width / 2} ${-height / 2} ${width} ${height}`, role: "group", "aria-label": name });
}

/** ``units``: the reader's, for round scales. */
export function board(parent: Element, kernel: Kernel, d: Drawing & { middle?: Pair }, about: FreeBody["about"] | null,
                      w: number, h: number, units: Data["units"], name: string): Board {
  const size = { length: units.length.size, force: units.force.size };
  const svg = canvas(parent, w, h, name), paper = new Paper(kernel, d.per_mm, inSpace(d));
  const cyclic: Part[] = [], live: Part[] = [];
  let perMm = d.force;
  if (d.middle) paper.middle = d.middle;
  const drawn = make("g", svg), acting = make("g", svg), lettered = make("g", svg);
  for (const i of d.items) (i.t === "trace" ? cyclic : live).push(item(drawn, i, paper));
  const arrows: Shown[] = d.arrows.map((a) => action(acting, a, paper, () => perMm, about ?? undefined));
  const names: { l: Placed; p: Rows; q?: Rows }[] =
    d.labels.map((l) => ({ l: label(lettered, l.role, l.text, l.kind === "joint" ? 3.8 : 3.3), p: l.p, q: l.q }));
  const long = new ScaleBar(lettered), strong = new ScaleBar(lettered, true), forces = d.arrows.filter((a) => a.t === "force");
  const step = Math.max(1, Math.floor(kernel.count / 72));

  function centre(b: ReturnType<typeof bounds>): void {
    if (b) paper.middle = [(b.x[0] + b.x[1]) / 2, (b.y[0] + b.y[1]) / 2];
  }

  /** Extent of a free body: its points, points of application of forces, its wheels. */
  const corners = about ? [...about, ...d.arrows.map((a) => a.p), ...d.items.flatMap((i) => (i.t === "symbol" ? [i.p] : []))] : [];
  const wheels = d.items.flatMap((i): { p: Rows; reach(value: (row: number) => number): number }[] => {
    if (i.t === "circle") return [{ p: i.p, reach: (value) => Math.abs(value(i.r)) }];
    const drawn = i.t === "symbol" && i.per_mm ? i.per_mm * Math.max(0, ...[...i.svg.matchAll(/ r="([\d.]+)"/g)].map((m) => +m[1])) : 0;
    return i.t === "symbol" && drawn ? [{ p: i.p, reach: () => drawn }] : [];
  });
  function extent(value: (row: number) => number): ReturnType<typeof bounds> {
    const rims = wheels.flatMap(({ p, reach }) => [-1, 1].map((side) => paper.seen(p, value).map((x) => x + side * reach(value)) as Point));
    return bounds([...corners.map((p) => paper.seen(p, value)), ...rims]);
  }

  /** The same at each of some positions. */
  function poses(): { k: number; b: NonNullable<ReturnType<typeof bounds>> }[] {
    return Array.from({ length: Math.ceil(kernel.count / step) }, (_, n) => n * step).flatMap((k) => {
      const b = kernel.good[k] ? extent((r) => kernel.value(r, k)) : null;
      return b ? [{ k, b }] : [];
    });
  }

  /** Newtons per mm: the largest force as long as the paper allows; in a free body every arrow ends within it. */
  function need(): number {
    const largest = kernel.largest((k) => Math.max(0, ...forces.map((a) => Math.hypot(...a.f.map((r) => kernel.value(r, k))))));
    let most = largest / (about ? 26 : Math.min(Math.max(0.18 * Math.min(w, 1.3 * h), 16), 40));
    for (const { k, b } of about ? poses() : [])
      for (const a of forces) {
        const value = (r: number) => kernel.value(r, k), at = paper.seen(a.p, value), f = paper.seen(a.f, value);
        [w / 2 - 9, h / 2 - 12].forEach((half, c) => {
          const middle = c ? (b.y[0] + b.y[1]) / 2 : (b.x[0] + b.x[1]) / 2, room = half - Math.abs(at[c] - middle) / paper.perMm;
          most = Math.max(most, Math.abs(f[c]) / Math.max(room, 4));
        });
      }
    return most > 0 ? roundUp(most / size.force) * size.force : perMm;
  }

  /** Fits the full cycle into the drawing. */
  function fit(force?: number): void {
    const spans = about ? poses().map(({ b }) => b) : [cycleBounds(paper, d)].filter((b) => b !== null);
    const room = about ? [46, 40] : [w - Math.max(0.22 * w, 34), h - Math.max(0.22 * h, 30)];
    const wide = Math.max(0, ...spans.flatMap((b) => [(b.x[1] - b.x[0]) / room[0], (b.y[1] - b.y[0]) / room[1]]));
    if (!about && spans.length) centre(spans[0]);
    if (wide > 0) paper.perMm = roundUp(wide / size.length) * size.length;
    perMm = force ?? need();
  }

  function placeLabels(): void {
    const placer = new Placer([-w / 2, -h / 2, w / 2, h / 2 - 6]);
    for (const part of [...live, ...arrows]) part.mark?.(placer);
    for (const { l, p, q } of names) {
      const on = out.names || !!q;
      l.el.setAttribute("visibility", on ? "visible" : "hidden");
      if (!on) continue;
      const a = paper.point(p), b = q ? paper.point(q) : a;
      const anchors = (q ? [0.5, 0.35, 0.65] : [0]).map((t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])] as Point);
      placer.put({ label: l, anchors, away: q ? undefined : a, leave: q ? 0.8 : 1.3 });
    }
    for (const a of arrows) {
      const at = kernel.solved ? a.anchor() : null;
      if (!at) a.label.el.setAttribute("visibility", "hidden");
      else placer.put({ label: a.label, anchors: at.slice(0, -1), away: at[at.length - 1], leave: 0.9 });
    }
  }

  const out: Board = {
    svg, paper, fit, need, force: () => perMm, names: d.labels.filter((l) => l.kind === "joint").length <= 8,
    resize(wide, high) {
      [w, h] = [wide, high];
      svg.setAttribute("viewBox", `${-w / 2} ${-h / 2} ${w} ${h}`);
    },
    update(cycle) {
      if (cycle) cyclic.forEach((p) => p.update());
      acting.setAttribute("visibility", kernel.solved ? "visible" : "hidden");
      const y = h / 2 - 2.6, end = long.set([-w / 2 + 2, y], paper.perMm, units.length);
      strong.set([end + 5, y], forces.length ? perMm : NaN, units.force);
      if (!kernel.finite) return; // the last pose stays, greyed
      if (about) centre(extent((r) => kernel.here[r]));
      for (const part of [...live, ...arrows]) part.update();
      placeLabels();
    },
  };
  return out;
}
