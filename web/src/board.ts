/** The drawing of a mechanism or of a free body: items, arrows at a stated scale, labels that keep out of the way. */

import type { Data, Drawing, FreeBody, Item, Pair, Rows } from "./data";
import { action, item, Paper, type Part, type Shown } from "./items";
import type { Kernel } from "./kernel";
import { label, type Placed, Placer } from "./labels";
import { make, type Point } from "./svg";

export interface Board { svg: SVGSVGElement; paper: Paper; names: boolean; update(cycle: boolean): void; fit(): void; force(): number }

const ROUND = [1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];

/** The next round number: 1, 1.25, 1.5, 2 ... times a power of ten. */
export function roundUp(x: number): number {
  if (!(x > 0) || !Number.isFinite(x)) return 1;
  const power = 10 ** Math.floor(Math.log10(x) + 1e-12);
  return power * (ROUND.find((r) => r * power >= x * (1 - 1e-12)) ?? 10);
}

/** Low and high ends of some points to the right and up; null where there is none. */
export function bounds(points: Point[]): { x: Point; y: Point } | null {
  const span = (some: number[]): Point => [Math.min(...some), Math.max(...some)];
  const x = span(points.map((p) => p[0])), y = span(points.map((p) => p[1]));
  return Number.isFinite(x[0] + x[1] + y[0] + y[1]) ? { x, y } : null;
}

const rowsOf = (i: Item): Rows[] => (i.t === "hull" || i.t === "path" ? i.p : i.t === "symbol" || i.t === "pair" ? [i.p] : []);

/** What a drawing's items span over the cycle, metres seen. */
function cycleBounds(paper: Paper, d: Drawing): ReturnType<typeof bounds> {
  const k = paper.kernel, step = Math.max(1, Math.floor(k.count / 72)), points: Point[] = [];
  for (const rows of d.items.flatMap(rowsOf))
    for (let n = 0; n < k.count; n += step) if (k.good[n]) points.push(paper.seen(rows, (r) => k.value(r, n)));
  return bounds(points);
}

const inSpace = (d: Drawing): boolean => d.items.some((i) => i.t === "pair");

/** Height in mm of a drawing of some width whose cycle finds room in it. */
export function heightFor(kernel: Kernel, d: Drawing, w: number): number {
  const b = cycleBounds(new Paper(kernel, 1, inSpace(d)), d), aspect = b ? (b.y[1] - b.y[0]) / (b.x[1] - b.x[0]) : NaN;
  return Number.isFinite(aspect) ? w * Math.min(Math.max(aspect * 1.05, 0.56), 0.9) : 0.7 * w;
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
  const note = make("text", lettered, { class: "l-note-t", "font-size": 2.8, x: -w / 2 + 2, y: h / 2 - 2 });

  function centre(b: ReturnType<typeof bounds>): void {
    if (b) paper.middle = [(b.x[0] + b.x[1]) / 2, (b.y[0] + b.y[1]) / 2];
  }

  /** Scales anew: the whole cycle finds room, the largest force is as long as it was. */
  function fit(): void {
    const b = about ? bounds(about.map((r) => paper.here(r))) : cycleBounds(paper, d);
    if (b) {
      const room = about ? [46, 40] : [w * 0.76, h * 0.74];
      const need = Math.max((b.x[1] - b.x[0]) / room[0], (b.y[1] - b.y[0]) / room[1]) || d.per_mm;
      centre(b);
      paper.perMm = roundUp(need / size.length) * size.length;
    }
    const most = Math.max(0, ...d.arrows.map((a) => (a.t === "force" ? kernel.largest((k) => Math.hypot(...a.f.map((r) => kernel.value(r, k)))) : 0)));
    if (most > 0) perMm = roundUp(most / (about ? 26 : 22) / size.force) * size.force;
  }

  function placeLabels(): void {
    const placer = new Placer([-w / 2, -h / 2, w / 2, h / 2 - 4]);
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
    svg, paper, fit, force: () => perMm, names: d.labels.filter((l) => l.kind === "joint").length <= 8,
    update(cycle) {
      if (cycle) cyclic.forEach((p) => p.update());
      acting.setAttribute("visibility", kernel.solved ? "visible" : "hidden");
      if (!kernel.finite) return; // the last pose stays, greyed
      if (about) centre(bounds(about.map((r) => paper.here(r))));
      for (const part of [...live, ...arrows]) part.update();
      placeLabels();
      note.textContent = `1 mm = ${+(paper.perMm / size.length).toPrecision(4)} ${units.length.unit}, ${+(perMm / size.force).toPrecision(4)} ${units.force.unit}`;
    },
  };
  return out;
}
