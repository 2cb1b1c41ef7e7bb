/** The drawing of a mechanism or of a free body: items, arrows at a stated scale, labels that keep out of the way. */

import type { Data, Drawing, FreeBody, Pair, Rows } from "./data";
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

/** Height in mm of a drawing of some width whose cycle finds room in it. */
export function heightFor(kernel: Kernel, d: Drawing, w: number): number {
  const rows = d.items.flatMap((i) => (i.t === "hull" || i.t === "path" ? i.p : i.t === "symbol" || i.t === "pair" ? [i.p] : []));
  const paper = new Paper(kernel, 1), low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const p of rows)
    for (let k = 0; k < kernel.count; k++)
      if (kernel.good(k)) paper.seen(p, (r) => kernel.value(r, k)).forEach((x, c) => ((low[c] = Math.min(low[c], x)), (high[c] = Math.max(high[c], x))));
  const reach = [high[0] - low[0], high[1] - low[1]];
  const aspect = reach[1] / reach[0];
  return Number.isFinite(aspect) ? Math.min(Math.max(w * aspect * 1.05, 96), 150) : 120;
}

export function canvas(parent: Element, width: number, height: number, name: string): SVGSVGElement {
  return make("svg", parent, { viewBox: `${-width / 2} ${-height / 2} ${width} ${height}`, role: "group", "aria-label": name });
}

/** ``units``: the reader's, for round scales. */
export function board(parent: Element, kernel: Kernel, d: Drawing & { middle?: Pair }, about: FreeBody["about"] | null,
                      w: number, h: number, units: Data["units"], name: string): Board {
  const size = { length: units.length.size, force: units.force.size };
  const svg = canvas(parent, w, h, name), paper = new Paper(kernel, d.per_mm);
  const cyclic: Part[] = [], live: Part[] = [], arrows: Shown[] = [], names: { l: Placed; p: Rows; q?: Rows }[] = [];
  let perMm = d.force;
  if (d.middle) paper.middle = d.middle;
  const drawn = make("g", svg), acting = make("g", svg), lettered = make("g", svg);
  for (const i of d.items) (i.t === "trace" ? cyclic : live).push(item(drawn, i, paper));
  for (const a of d.arrows) arrows.push(action(acting, a, paper, () => perMm, about ?? undefined));
  for (const l of d.labels) names.push({ l: label(lettered, l.role, l.text, l.kind === "joint" ? 3.8 : 3.3), p: l.p, q: l.q });
  const note = make("text", lettered, { class: "l-note-t", "font-size": 2.8, x: -w / 2 + 2, y: h / 2 - 2 });
  const bounds: [number, number, number, number] = [-w / 2, -h / 2, w / 2, h / 2 - 4];
  const span = (some: number[]): Point => [Math.min(...some), Math.max(...some)];

  function centre(): void {
    if (!about) return;
    const seen = about.map((r) => paper.here(r)), [x0, x1] = span(seen.map((p) => p[0])), [y0, y1] = span(seen.map((p) => p[1]));
    if (Number.isFinite(x0 + x1 + y0 + y1)) paper.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
  }

  /** Scales anew: the whole cycle finds room, the largest force is as long as it was. */
  function fit(): void {
    const xs: number[] = [], ys: number[] = [];
    const points = about ?? d.items.flatMap((i) => (i.t === "hull" || i.t === "path" ? i.p : i.t === "symbol" || i.t === "pair" ? [i.p] : []));
    const step = Math.max(1, Math.floor(kernel.count / 72));
    for (const p of points)
      for (let k = 0; k < kernel.count; k += about ? kernel.count : step)
        if (about || kernel.good(k)) {
          const [x, y] = about ? paper.here(p) : paper.seen(p, (r) => kernel.value(r, k));
          xs.push(x);
          ys.push(y);
        }
    if (xs.length) {
      const [x0, x1] = span(xs), [y0, y1] = span(ys), room = about ? [46, 40] : [w * 0.76, h * 0.74];
      const need = Math.max((x1 - x0) / room[0], (y1 - y0) / room[1]) || d.per_mm;
      if (!about) paper.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
      paper.perMm = roundUp(need / size.length) * size.length;
    }
    let most = 0;
    for (const a of d.arrows)
      if (a.t === "force")
        for (let k = 0; k < kernel.count; k++) if (kernel.good(k)) most = Math.max(most, Math.hypot(...a.f.map((r) => kernel.value(r, k))));
    if (most > 0) perMm = roundUp(most / (about ? 26 : 22) / size.force) * size.force;
  }

  const out: Board = {
    svg, paper, fit, force: () => perMm, names: d.labels.filter((l) => l.kind === "joint").length <= 8,
    update(cycle) {
      if (cycle) cyclic.forEach((p) => p.update());
      acting.setAttribute("visibility", kernel.solved ? "visible" : "hidden");
      if (!kernel.finite) return; // the last pose stays, greyed
      centre();
      live.forEach((p) => p.update());
      arrows.forEach((p) => p.update());
      const placer = new Placer(bounds);
      live.forEach((p) => p.mark?.(placer));
      arrows.forEach((p) => p.mark?.(placer));
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
      note.textContent = `1 mm = ${+(paper.perMm / size.length).toPrecision(4)} ${units.length.unit}, ${+(perMm / size.force).toPrecision(4)} ${units.force.unit}`;
    },
  };
  return out;
}
