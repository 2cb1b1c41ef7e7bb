/** Curves over the cycle with a cursor, polar diagrams, and polygons of forces. */

import { bounds, canvas, roundUp, ScaleBar } from "./board";
import type { Chart, Curve, Data, Polygon, Rows } from "./data";
import { curve } from "./items";
import type { Kernel } from "./kernel";
import { label, Placer } from "./labels";
import { whole } from "./motion";
import { Arrow, attr, figures, html, letters, make, path, type Point, pointer, say, set, short, width } from "./svg";

const LEFT = 16, TOP = 5, LOW = 8, LINE = 4;

/** A round step between numbers, so that about `count` of them are in a span. */
function step(span: number, count: number): number {
  const raw = span / count || 1, power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((s) => s * power >= raw) ?? 10);
}

/** The same for degrees: fractions of a turn, or turns. */
function turnStep(span: number, count: number): number {
  return [1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360].find((s) => s >= span / count) ?? 360 * step(span / 360, count);
}

/** The multiples of a step between two numbers. */
function ticks(low: number, high: number, by: number): number[] {
  const first = Math.ceil(low / by - 1e-9), count = Math.floor(high / by + 1e-9) - first + 1;
  return Array.from({ length: Math.max(count, 0) }, (_, k) => (first + k) * by);
}

/** ``update``: the present place, with ``cycle`` all that is drawn of the cycle too; ``parts``: that alone, a part at a
 * time. */
export interface View { update(cycle: boolean): void; parts?(): Generator<void> }

export interface Cursor { time(): number; seek(t: number): void; pick(curve: Curve): void; picked(): Curve | undefined }

/** ``W``: width in mm. */
export function chart(parent: Element, data: Data, kernel: Kernel, c: Chart, cursor: Cursor, W: number): View & { figure: Element; parts(): Generator<void>; resize(W: number): void } {
  const figure = html("figure", parent, { class: "chart" }), unit = data.units[c.kind];
  html("figcaption", figure, {}, `${c.title}, ${unit.unit}`);
  const names = data.views.charts.flatMap((x) => x.curves.map((one) => width(one.name, 3)));
  const H = Math.max(44, TOP + LOW + LINE * c.curves.length), svg = canvas(figure, W, H, c.title), h = H - TOP - LOW, y0 = -H / 2 + TOP;
  let w = 0, x0 = 0;
  const grid = make("path", svg, { class: "l-grid", style: "fill:none" }), axis = make("path", svg, { class: "l-axis", style: "fill:none" });
  const scale = make("g", svg), lines = c.curves.map((x) => make("path", svg, { class: `l-${x.role}`, style: "fill:none" }));
  const now = make("path", svg, { class: "cursor" }), dots = c.curves.map((x) => make("circle", svg, { class: `l-${x.role}-h`, r: 0.9 }));
  const last = Math.max(kernel.count - 1, 1), least = data.noise[c.kind as "force"] ?? 0;
  const keys = c.curves.map((x, k) => {
    const t = make("text", svg, { class: `l-${x.role}-t key`, "font-size": 3, y: y0 + 3 + LINE * k, tabindex: 0, role: "button" });
    letters(t, x.name, 3);
    make("title", t).textContent = "show what lowers its peak";
    t.addEventListener("click", () => cursor.pick(x));
    t.addEventListener("keydown", (e) => e.key === "Enter" && cursor.pick(x));
    return t;
  });
  const value = (x: Curve, k: number): number => {
    const v = kernel.value(x.row, k) / unit.size;
    return Math.abs(v) * unit.size < least ? 0 : v;
  };
  let low = NaN, high = NaN, by = 1, resized = true;
  const at = (k: number): number => x0 + (k / last) * w, up = (v: number): number => y0 + h - ((v - low) / (high - low)) * h;

  /** From tick to tick, so that the scale is constant while curves move a little; true if it has changed. */
  function* rescale(): Generator<void, boolean> {
    let [l, u] = [Infinity, -Infinity];
    for (const x of c.curves) {
      for (let k = 0; k < kernel.count; k++)
        if (kernel.good[k]) {
          const v = value(x, k), w = kernel.reverses(k) ? kernel.onceAfter(() => value(x, k)) : v;
          l = Math.min(l, v, w);
          u = Math.max(u, v, w);
        }
      yield;
    }
    if (!(l <= u)) [l, u] = [0, 1];
    if (l > 0 && l < 0.4 * u) l = 0;
    if (u < 0 && u > 0.4 * l) u = 0;
    if (u - l < 1e-9 * Math.max(Math.abs(u), Math.abs(l), 1e-9)) [l, u] = [Math.min(l, 0), Math.max(u, 0) || 1];
    by = step(u - l, 4);
    [l, u] = [Math.floor(l / by + 1e-9) * by, Math.ceil(u / by - 1e-9) * by];
    if (l === low && u === high && !resized) return false;
    [low, high, resized] = [l, u, false];
    return true;
  }

  function drawScale(): void {
    const drive = data.drives[0];
    const say = (text: string, x: number, y: number, anchor: string) =>
      (make("text", scale, { class: "l-note-t", "font-size": 2.6, "text-anchor": anchor, x, y }).textContent = text);
    scale.replaceChildren();
    let lattice = "";
    for (const m of ticks(low, high, by)) {
      lattice += `M${x0} ${short(up(m))}h${w}`;
      say(figures(m, 5), x0 - 1.2, up(m) + 0.9, "end");
    }
    if (drive) {
      const [from, to] = [0, last].map((k) => kernel.position(drive.name, k) / drive.size);
      for (const m of ticks(Math.min(from, to), Math.max(from, to), (drive.unit === "°" ? turnStep : step)(Math.abs(to - from), 6))) {
        const x = x0 + ((m - from) / (to - from || 1)) * w;
        lattice += `M${short(x)} ${y0}v${h}`;
        say(figures(m, 5) + (drive.unit === "°" ? "°" : ""), x, y0 + h + 3.4, "middle");
      }
      say(`${drive.name}, ${drive.unit}`, x0 + w, y0 + h + 6.6, "end");
    }
    attr(grid, "d", lattice);
    attr(axis, "d", `M${x0} ${y0}v${h}` + (low < 0 && high > 0 ? `M${x0} ${short(up(0))}h${w}` : ""));
  }

  function resize(wide: number): void {
    W = wide;
    [w, x0] = [W - LEFT - Math.min(Math.max(...names) + 4, 0.3 * W), -W / 2 + LEFT];
    svg.setAttribute("viewBox", `${-W / 2} ${-H / 2} ${W} ${H}`);
    keys.forEach((t) => t.setAttribute("x", short(x0 + w + 2)));
    resized = true;
  }
  resize(W);
  const move = (e: PointerEvent) => cursor.seek(((pointer(svg, e)[0] - x0) / w) * last);
  svg.addEventListener("pointerdown", (e) => {
    if ((e.target as Element).closest(".key")) return;
    svg.setPointerCapture(e.pointerId);
    move(e);
  });
  svg.addEventListener("pointermove", (e) => e.buttons && svg.hasPointerCapture(e.pointerId) && move(e));
  function* parts(): Generator<void> {
    if (yield* rescale()) drawScale();
    for (const [n, line] of lines.entries()) {
      yield;
      attr(line, "d", curve(kernel, (k) => [at(k), up(value(c.curves[n], k))]));
    }
  }
  return {
    figure, resize, parts,
    update(cycle) {
      if (cycle) whole(parts());
      const x = short(at(Math.min(cursor.time(), last)));
      attr(now, "d", `M${x} ${y0}v${h}`);
      c.curves.forEach((one, n) => {
        const y = kernel.solved ? up(kernel.here[one.row] / unit.size) : NaN, seen = Number.isFinite(y);
        set(dots[n], { visibility: seen ? "visible" : "hidden", ...(seen && { cx: x, cy: short(y) }) });
        keys[n].classList.toggle("picked", cursor.picked() === one);
      });
    },
  };
}

const largestForce = (kernel: Kernel, { f }: { f?: Rows }): number => kernel.largest((k) => Math.hypot(kernel.value(f![0], k), kernel.value(f![1], k)));

/** The largest of some forces, computed once for each cycle. */
export function largestOf(kernel: Kernel, some: { f?: Rows }[]): () => number {
  let cycle = -1, most = 0;
  return () => {
    if (cycle !== kernel.cycles) [cycle, most] = [kernel.cycles, Math.max(...some.map((c) => largestForce(kernel, c)))];
    return most;
  };
}

/** Share of the largest force below which that of a joint is rounding. */
const ROUNDING = 1e-11;

/** The force in each joint as a curve about a pole: its tip over the cycle, and at the present position. */
export function polar(parent: Element, kernel: Kernel, c: Curve, most: () => number, unit: { unit: string; size: number }): View & { figure: Element; parts(): Generator<void> } {
  const figure = html("figure", parent, { class: "polar" }), size = 66, [fx, fy] = c.f!;
  const caption = html("figcaption", figure), svg = canvas(figure, size, size, `polar diagram of joint ${c.name}`);
  make("path", svg, { class: "l-grid", style: "fill:none", d: "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0" });
  const line = make("path", svg, { class: `l-${c.role}`, style: "fill:none" }), arrow = new Arrow(svg, "joint-force", c.name);
  let perMm = 1, zero = false;
  function* parts(): Generator<void> {
    const all = most();
    yield;
    const largest = largestForce(kernel, c);
    zero = !(largest > ROUNDING * all);
    set(svg, { display: zero ? "none" : "inline" });
    const outer = roundUp(largest / unit.size), said = `Joint ${c.name}: ${zero ? "no force at any position" : `circles of ${figures(outer / 2)} and ${figures(outer)} ${unit.unit}`}`;
    say(caption, said);
    if (zero) return;
    perMm = (outer / 30) * unit.size;
    attr(line, "d", curve(kernel, (k) => [kernel.value(fx, k) / perMm, -kernel.value(fy, k) / perMm], true));
  }
  return {
    figure, parts,
    update(cycle) {
      if (cycle) whole(parts());
      arrow.set([0, 0], kernel.solved && !zero ? [kernel.here[fx] / perMm, -kernel.here[fy] / perMm] : [0, 0]);
    },
  };
}

/** Forces of links head to tail, with shared forces drawn once; the remaining gap is drawn. */
export function polygon(parent: Element, data: Data, kernel: Kernel, title: string, links: Polygon[]): View & { figure: HTMLElement } {
  const figure = html("figure", parent, { class: "polygon" }), w = 110, h = 80, unit = data.units.force;
  const caption = html("figcaption", figure, {}, title), svg = canvas(figure, w, h, title), lettered = make("g", svg), met = new Set<string>();
  const chains = links.map(({ sides }) => {
    const shared = sides.find((s) => s.kind === "joint" && met.has(s.of));
    for (const s of sides) if (s.kind === "joint") met.add(s.of);
    const drawn = sides.filter((s) => s !== shared).map((s) => ({ s, arrow: new Arrow(svg, s.role, s.name), name: label(lettered, s.role, s.name, 3) }));
    return { shared, drawn };
  });
  const gap = make("path", svg, { class: "l-gap", style: "fill:none" }), bar = new ScaleBar(svg, true);
  return {
    figure,
    update() {
      attr(svg, "visibility", kernel.solved ? "visible" : "hidden");
      if (!kernel.solved) return;
      const v = kernel.here, heads = new Map<string, Point>(), all: Point[] = [], gaps: [Point, Point][] = [];
      const placed = chains.flatMap(({ shared, drawn }) => {
        const low = bounds(all)?.y[1] ?? 0, tail = heads.get(shared?.of ?? "");
        let at: Point = tail ?? [0, low];
        const ends = (f: number[]): Point => [at[0] + v[f[0]], at[1] - v[f[1]]];
        const first = at;
        if (shared) at = ends(shared.f);
        const out = drawn.map((d) => {
          const from = at;
          at = ends(d.s.f);
          if (d.s.kind === "joint" && !heads.has(d.s.of)) heads.set(d.s.of, at);
          all.push(from, at);
          return { ...d, from, to: at };
        });
        gaps.push([first, at]);
        return out;
      });
      const b = bounds(all) ?? { x: [0, 0], y: [0, 0] };
      const none = !(Math.max(b.x[1] - b.x[0], b.y[1] - b.y[0]) > 1000 * data.noise.force);
      say(caption, none ? `${title}: no forces` : title);
      svg.toggleAttribute("hidden", none);
      if (none) return;
      const perMm = roundUp(Math.max((b.x[1] - b.x[0]) / (w * 0.6), (b.y[1] - b.y[0]) / (h * 0.6)) / unit.size) * unit.size;
      const on = ([x, y]: Point): Point => [(x - (b.x[0] + b.x[1]) / 2) / perMm, (y - (b.y[0] + b.y[1]) / 2) / perMm];
      const placer = new Placer([-w / 2, -h / 2, w / 2, h / 2 - 4]);
      for (const { from, to } of placed) placer.line(on(from), on(to));
      for (const { arrow, name, from, to } of placed) {
        const [p, q] = [on(from), on(to)], shown = arrow.set(p, q), mid: Point = [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
        attr(name.el, "visibility", shown ? "visible" : "hidden");
        if (shown) placer.put({ label: name, anchors: [mid], away: mid, leave: 0.9 });
      }
      attr(gap, "d", gaps.map(([p, q]) => path([on(p), on(q)])).join(""));
      bar.set([-w / 2 + 2, h / 2 - 2.6], perMm, unit);
    },
  };
}
