/** The drawing of a mechanism or of a free body: items, arrows at a stated scale, labels placed without overlaps. */

import type { Action, Data, Drawing, FreeBody, Item, Pair, Rate, Rows } from "./data";
import { action, item, Paper, type Part, type Shown } from "./items";
import { label, type Placed, Placer } from "./labels";
import { whole } from "./motion";
import type { Source } from "./source";
import { attr, figures, make, path, type Point, say, set, short, width } from "./svg";
import { type Layer, usually, type View } from "./view";

/** ``update``: the present place, with ``cycle`` the paths of points too; ``parts``: these alone, one at a time. ``need``: newtons per mm at which every force fits; ``fit``: new scales, with forces to that scale or another, and
 * with ``keep`` only where the drawing has left its paper. ``look``: the window of the view, else the fitted one, with
 * ``fitted`` metres per mm. ``on``: is a layer shown. */
export interface Board {
  svg: SVGSVGElement; paper: Paper;
  update(cycle: boolean): void; parts(): Generator<void>; fit(force?: number, keep?: boolean): void; need(): number; force(): number; resize(w: number, h: number): void;
  look(): void; fitted(): number; on(layer: Layer): boolean;
}

/** The layer of an action. */
const layerOf = (a: Action): Layer => (a.kind === "joint" || a.kind === "friction" ? "reactions" : a.kind === "inertia" ? "inertia" : "loads");

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

const rowsOf = (i: Item): Rows[] => (i.t === "hull" || i.t === "path" || i.t === "arc" ? i.p : i.t === "symbol" || i.t === "pair" ? [i.p] : []);

interface Wheel { p: Rows; reach(value: (row: number) => number): number }

/** Circles of a drawing that have the machine's size, as pitch circles. */
function wheelsOf(d: Drawing): Wheel[] {
  return d.items.flatMap((i): Wheel[] => {
    if (i.t === "circle") return [{ p: i.p, reach: (value) => Math.abs(value(i.r)) }];
    if (i.t === "pair" && i.size) return [{ p: i.p, reach: () => Math.max(...i.size!) }];
    const drawn = i.t === "symbol" && i.per_mm ? i.per_mm * Math.max(0, ...[...i.svg.matchAll(/ r="([\d.]+)"/g)].map((m) => +m[1])) : 0;
    return i.t === "symbol" && drawn ? [{ p: i.p, reach: () => drawn }] : [];
  });
}

/** Extent of a drawing's items over the cycle, in projected metres. */
function cycleBounds(paper: Paper, d: Drawing, wheels: Wheel[]): ReturnType<typeof bounds> {
  const k = paper.kernel, step = Math.max(1, Math.floor(k.count / 72)), points: Point[] = [], places = d.items.flatMap(rowsOf);
  for (let n = 0; n < k.count; n += step) {
    if (!k.good[n]) continue;
    const value = (r: number): number => k.value(r, n);
    for (const rows of places) points.push(paper.seen(rows, value));
    points.push(...rims(paper, wheels, value));
  }
  return bounds(points);
}

/** Opposite corners about each wheel. */
const rims = (paper: Paper, wheels: Wheel[], value: (row: number) => number): Point[] =>
  wheels.flatMap(({ p, reach }) => [-1, 1].map((side) => paper.seen(p, value).map((x) => x + side * reach(value)) as Point));

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
    attr(this.line, "visibility", known ? "visible" : "hidden");
    if (!known) return say(this.text, ""), x;
    const value = roundDown(26 * perMm), long = value / perMm, end = x + long, said = `${figures(value)} ${unit.unit}`;
    const tick = `M${short(x)} ${short(y - 1)}v2`;
    const close = this.arrow ? `M${short(end - 2.4)} ${short(y - 0.8)}L${short(end)} ${short(y)}L${short(end - 2.4)} ${short(y + 0.8)}` : `M${short(end)} ${short(y - 1)}v2`;
    attr(this.line, "d", tick + path([[x, y], [end, y]]) + close);
    say(set(this.text, { x: short(end + 1.4), y: short(y + 1) }), said);
    return end + 1.4 + width(said, 2.8);
  }
}

export function canvas(parent: Element, width: number, height: number, name: string): SVGSVGElement {
  return make("svg", parent, { viewBox: `${-width / 2} ${-height / 2} ${width} ${height}`, role: "group", "aria-label": name });
}

const MANY = 8;
/** Longest arrow of a velocity or an acceleration, mm. */
const RATE = 20;

/** ``units``: the reader's, for round scales; ``rates``: velocities and accelerations that can be shown. */
export function board(parent: Element, kernel: Source, d: Drawing & { middle?: Pair }, about: FreeBody["about"] | null,
                      w: number, h: number, units: Data["units"], name: string, view: View, rates: Rate[] = []): Board {
  const size = { length: units.length.size, force: units.force.size };
  const svg = canvas(parent, w, h, name), paper = new Paper(kernel, d.per_mm, units, inSpace(d) ? view.camera : null);
  const cyclic: Part[] = [], live: Part[] = [], many = d.labels.filter((l) => l.kind === "joint").length > MANY;
  const on = (layer: Layer): boolean => (about && layer !== "values" ? true : view.shown[layer] ?? usually(layer, many));
  let perMm = d.force, fitted: NonNullable<View["window"]> = { perMm: d.per_mm, middle: d.middle ?? [0, 0] };
  if (d.middle) paper.middle = d.middle;
  const traced = make("g", svg), drawn = make("g", svg), acting = make("g", svg), lettered = make("g", svg);
  for (const i of d.items) (i.t === "trace" ? cyclic : live).push(item(i.t === "trace" ? traced : drawn, i, paper));
  const arrows: { a: Shown; layer: Layer }[] = d.arrows.map((a) => ({ a: action(acting, a, paper, () => perMm, about ?? undefined), layer: layerOf(a) }));
  const long = new ScaleBar(lettered), strong = new ScaleBar(lettered, true), forces = d.arrows.filter((a) => a.t === "force");
  const speeds = (rates.length ? (["velocities", "accelerations"] as const) : []).map((layer) => {
    const kind = layer === "velocities" ? "speed" : "acceleration", role = layer === "velocities" ? "velocity" : "acceleration", sign = role[0];
    const scale = { layer, unit: units[kind], rows: rates.map((r) => (sign === "v" ? r.v : r.a)), perMm: NaN, bar: new ScaleBar(lettered, true) };
    rates.forEach((r, k) => {
      const shown: Action = { t: "force", role, of: r.of[1], kind: role, link: "", name: `${sign}_{${r.of[0] === "center" ? `G ${r.of[1]}` : r.of[1]}}`, p: r.p, f: scale.rows[k] };
      arrows.push({ a: action(acting, shown, paper, () => scale.perMm, undefined, kind), layer });
    });
    return scale;
  });
  const names: { l: Placed; p: Rows; q?: Rows }[] =
    d.labels.map((l) => ({ l: label(lettered, l.role, l.text, l.kind === "joint" ? 3.8 : 3.3), p: l.p, q: l.q }));
  const wheels = wheelsOf(d), step = Math.max(1, Math.floor(kernel.count / 72));

  const centre = (b: NonNullable<ReturnType<typeof bounds>>): Pair => [(b.x[0] + b.x[1]) / 2, (b.y[0] + b.y[1]) / 2];

  /** Extent of a free body: its points, points of application of forces, its wheels. */
  const corners = about ? [...about, ...d.arrows.map((a) => a.p), ...d.items.flatMap((i) => (i.t === "symbol" ? [i.p] : []))] : [];
  function extent(value: (row: number) => number): ReturnType<typeof bounds> {
    return bounds([...corners.map((p) => paper.seen(p, value)), ...rims(paper, wheels, value)]);
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
  function fit(force?: number, keep = false): void {
    const spans = about ? poses().map(({ b }) => b) : [cycleBounds(paper, d, wheels)].filter((b) => b !== null);
    const room = about ? [46, 40] : [w - Math.max(0.22 * w, 34), h - Math.max(0.22 * h, 30)];
    const wide = Math.max(0, ...spans.flatMap((b) => [(b.x[1] - b.x[0]) / room[0], (b.y[1] - b.y[0]) / room[1]]));
    const stays = keep && spans.length > 0 && suits(spans[0], wide);
    if (!stays && !about && spans.length) fitted.middle = centre(spans[0]);
    if (!stays && wide > 0) fitted.perMm = roundUp(wide / size.length) * size.length;
    perMm = force ?? need();
    if (!stays && !about && spans.length) reach(spans[0]);
    for (const s of speeds) {
      const most = kernel.largest((k) => Math.max(0, ...s.rows.map((f) => Math.hypot(...f.map((r) => kernel.value(r, k))))));
      s.perMm = most > 0 ? roundUp(most / RATE / s.unit.size) * s.unit.size : NaN;
    }
    look();
  }

  /** Makes room for arrows that would end beyond the paper: the middle moves, and where that is not enough the scale. */
  function reach(b: NonNullable<ReturnType<typeof bounds>>): void {
    const ends: [Point, Point][] = [[[b.x[0], b.y[0]], [0, 0]], [[b.x[1], b.y[1]], [0, 0]]], acting = forces.filter((a) => on(layerOf(a)));
    for (let k = 0; k < kernel.count; k += step) {
      const value = (r: number): number => kernel.value(r, k);
      for (const { p, f } of kernel.good[k] ? acting : []) ends.push([paper.seen(p, value), paper.seen(f, value)]);
    }
    const room: [Point, Point] = [[w / 2 - 8, w / 2 - 8], [h / 2 - 12, h / 2 - 8]]; // below there are the scales
    for (let tries = 0; tries < 9; tries++) {
      const spans = [0, 1].map((c) => ends.map(([at, f]) => at[c] / fitted.perMm + f[c] / perMm).filter(Number.isFinite)).map((x) => [Math.min(...x), Math.max(...x)]);
      if (spans.every(([low, high], c) => high - low <= room[c][0] + room[c][1])) {
        fitted.middle = spans.map(([low, high], c) => Math.min(Math.max(fitted.middle[c] / fitted.perMm, high - room[c][1]), low + room[c][0]) * fitted.perMm) as Pair;
        return;
      }
      fitted.perMm = roundUp((1.01 * fitted.perMm) / size.length) * size.length;
    }
  }

  /** True if the drawing still lies on its paper, and is not much smaller than that. */
  function suits(b: NonNullable<ReturnType<typeof bounds>>, wide: number): boolean {
    const within = (span: Point, middle: number, room: number): boolean => Math.max(...span.map((x) => Math.abs(x - middle))) < fitted.perMm * room;
    return wide > 0.5 * fitted.perMm && within(b.x, fitted.middle[0], w / 2 - 8) && within(b.y, fitted.middle[1], h / 2 - 10);
  }

  function look(): void {
    const window = about ? fitted : view.window ?? fitted;
    paper.perMm = window.perMm;
    if (!about) paper.middle = [...window.middle];
  }

  /** The bars at the lower edge, in as many lines as they need. */
  function scales(): void {
    const bars: [ScaleBar, number, { unit: string; size: number }][] = [
      [long, paper.perMm, units.length], [strong, forces.length ? perMm : NaN, units.force],
      ...speeds.map((s): [ScaleBar, number, { unit: string; size: number }] => [s.bar, on(s.layer) && !about ? s.perMm : NaN, s.unit])];
    let [x, y] = [-w / 2 + 2, h / 2 - 2.6];
    for (const [bar, per, unit] of bars) {
      if (x > -w / 2 + 2 && x + 46 > w / 2) [x, y] = [-w / 2 + 2, y - 5];
      const end = bar.set([x, y], per, unit);
      if (end > x) x = end + 5;
    }
  }

  function placeLabels(): void {
    const placer = new Placer([-w / 2, -h / 2, w / 2, h / 2 - 6]), inside = ([x, y]: Point): boolean => Math.abs(x) < w / 2 && Math.abs(y) < h / 2;
    for (const part of [...live, ...arrows.map((x) => x.a)]) part.mark?.(placer);
    for (const { l, p, q } of names) {
      const a = paper.point(p), b = q ? paper.point(q) : a;
      const seen = (on("names") || (!!q && view.shown.names === undefined)) && inside([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
      attr(l.el, "visibility", seen ? "visible" : "hidden");
      if (!seen) continue;
      const anchors = (q ? [0.5, 0.35, 0.65] : [0]).map((t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])] as Point);
      placer.put({ label: l, anchors, away: q ? undefined : a, leave: q ? 0.8 : 1.3 });
    }
    for (const { a } of arrows) {
      const at = kernel.solved ? a.anchor() : null;
      if (!at || !inside(at[0])) attr(a.label.el, "visibility", "hidden");
      else placer.put({ label: a.label, anchors: at.slice(0, -1), away: at[at.length - 1], leave: 0.9 });
    }
  }

  function* parts(): Generator<void> {
    for (const p of cyclic) {
      p.update();
      yield;
    }
  }

  return {
    svg, paper, parts, fit, need, look, on, force: () => perMm, fitted: () => fitted.perMm,
    resize(wide, high) {
      [w, h] = [wide, high];
      svg.setAttribute("viewBox", `${-w / 2} ${-h / 2} ${w} ${h}`);
    },
    update(cycle) {
      paper.values = on("values");
      set(traced, { display: on("traces") ? "inline" : "none" });
      if (cycle) whole(parts());
      set(acting, { visibility: kernel.solved ? "visible" : "hidden" });
      scales();
      if (!kernel.finite) return; // the last pose stays, greyed
      if (about) paper.middle = centre(extent((r) => kernel.here[r]) ?? { x: [0, 0], y: [0, 0] });
      for (const part of live) part.update();
      for (const { a, layer } of arrows) on(layer) ? a.update() : a.hide();
      placeLabels();
    },
  };
}
