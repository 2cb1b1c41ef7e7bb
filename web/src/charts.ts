/** Curves over the cycle with a cursor, polar diagrams, and polygons of forces. */

import { canvas, roundUp } from "./board";
import type { Chart, Curve, Data, Polygon } from "./data";
import type { Kernel } from "./kernel";
import { label, Placer } from "./labels";
import { Arrow, html, letters, make, path, type Point, short, width } from "./svg";

const W = 120, H = 52, LEFT = 16, TOP = 5, LOW = 8;

/** Round steps between two numbers, about `count` of them. */
export function ticks(low: number, high: number, count: number): number[] {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw || 1));
  const step = power * ([1, 2, 5, 10].find((s) => s * power >= raw) ?? 10), out: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-12) + 1e-9 * step; k++) out.push(k * step);
  return out;
}

export const figures = (x: number, digits = 4): string => (Number.isFinite(x) ? String(+x.toPrecision(digits)).replace("-", "−") : "–");

export interface View { update(cycle: boolean): void; band?(of: string, low: Float64Array | null, high?: Float64Array): void }

export function chart(parent: Element, data: Data, kernel: Kernel, c: Chart, time: () => number,
                      seek: (t: number) => void, pick: (curve: Curve) => void, picked: () => Curve | undefined): View {
  const figure = html("figure", parent, { class: "chart" }), unit = data.units[c.kind] ?? { unit: "", size: 1 };
  html("figcaption", figure, {}, `${c.title}, ${unit.unit}`);
  const right = Math.min(Math.max(...c.curves.map((x) => width(x.name, 3))) + 4, 36);
  const svg = canvas(figure, W, H, c.title), w = W - LEFT - right, h = H - TOP - LOW, x0 = -W / 2 + LEFT, y0 = -H / 2 + TOP;
  const grid = make("path", svg, { class: "l-grid", style: "fill:none" }), axis = make("path", svg, { class: "l-axis", style: "fill:none" });
  const scale = make("g", svg), lines = c.curves.map((x) => make("path", svg, { class: `l-${x.role}`, style: "fill:none" }));
  const cursor = make("path", svg, { class: "cursor" }), dots = c.curves.map((x) => make("circle", svg, { class: `l-${x.role}-h`, r: 0.9 }));
  const drive = data.drives[0], last = Math.max(kernel.count - 1, 1);
  const keys = c.curves.map((x, k) => {
    const t = make("text", svg, { class: `l-${x.role}-t key`, "font-size": 3, x: x0 + w + 2, y: y0 + 3 + 4 * k, tabindex: 0, role: "button" });
    letters(t, x.name, 3);
    make("title", t).textContent = "show what lowers its peak";
    t.addEventListener("click", () => pick(x));
    t.addEventListener("keydown", (e) => e.key === "Enter" && pick(x));
    return t;
  });
  const least = data.noise[c.kind as "force"] ?? 0, value = (x: Curve, k: number): number => {
    const v = kernel.value(x.row, k);
    return Math.abs(v) < least ? 0 : v;
  };
  let y = (v: number): number => v;
  const at = (k: number): number => x0 + (k / last) * w;

  function scaled(): void {
    let low = Infinity, high = -Infinity;
    for (const x of c.curves)
      for (let k = 0; k < kernel.count; k++)
        if (kernel.good(k)) {
          const v = value(x, k) / unit.size;
          low = Math.min(low, v);
          high = Math.max(high, v);
        }
    if (!(low <= high)) [low, high] = [0, 1];
    if (low > 0 && low < 0.4 * high) low = 0;
    if (high < 0 && high > 0.4 * low) high = 0;
    if (high - low < 1e-9 * Math.max(Math.abs(high), 1e-9)) [low, high] = [Math.min(low, 0), Math.max(high, 0) || 1];
    const marks = ticks(low, high, 4), pad = 0.04 * (high - low);
    [low, high] = [low - pad, high + pad];
    y = (v) => y0 + h - ((v / unit.size - low) / (high - low)) * h;
    scale.replaceChildren();
    let lattice = "";
    for (const m of marks) {
      lattice += `M${x0} ${short(y(m * unit.size))}h${w}`;
      make("text", scale, { class: "l-note-t", "font-size": 2.6, "text-anchor": "end", x: x0 - 1.2, y: y(m * unit.size) + 0.9 }).textContent = figures(m, 5);
    }
    if (drive) {
      const q = [0, last].map((k) => kernel.position(drive.name, k) / drive.size);
      for (const m of ticks(Math.min(...q), Math.max(...q), 5)) {
        const x = x0 + ((m - q[0]) / (q[1] - q[0] || 1)) * w;
        lattice += `M${short(x)} ${y0}v${h}`;
        make("text", scale, { class: "l-note-t", "font-size": 2.6, "text-anchor": "middle", x, y: y0 + h + 3.4 }).textContent = figures(m, 5) + (drive.unit === "°" ? "°" : "");
      }
      make("text", scale, { class: "l-note-t", "font-size": 2.6, "text-anchor": "end", x: x0 + w, y: y0 + h + 6.6 }).textContent = `${drive.name}, ${drive.unit}`;
    }
    grid.setAttribute("d", lattice);
    axis.setAttribute("d", `M${x0} ${y0}v${h}` + (low < 0 && high > 0 ? `M${x0} ${short(y(0))}h${w}` : ""));
    lines.forEach((line, n) => line.setAttribute("d", run((k) => at(k), (k) => y(value(c.curves[n], k)))));
  }

  function run(fx: (k: number) => number, fy: (k: number) => number): string {
    let d = "", pen = false;
    for (let k = 0; k < kernel.count; k++) {
      if (kernel.good(k)) d += `${pen ? "L" : "M"}${short(fx(k))} ${short(fy(k))}`;
      pen = kernel.good(k);
    }
    return d;
  }

  const move = (e: PointerEvent) => {
    const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM()!.inverse());
    seek(((p.x - x0) / w) * last);
  };
  svg.addEventListener("pointerdown", (e) => {
    if ((e.target as Element).closest(".key")) return;
    svg.setPointerCapture(e.pointerId);
    move(e);
  });
  svg.addEventListener("pointermove", (e) => e.buttons && svg.hasPointerCapture(e.pointerId) && move(e));
  return {
    update(cycle) {
      if (cycle) scaled();
      const t = Math.min(time(), last);
      cursor.setAttribute("d", `M${short(at(t))} ${y0}v${h}`);
      c.curves.forEach((x, n) => {
        dots[n].setAttribute("visibility", kernel.solved ? "visible" : "hidden");
        if (kernel.solved) {
          dots[n].setAttribute("cx", short(at(t)));
          dots[n].setAttribute("cy", short(y(kernel.here[x.row])));
        }
        keys[n].classList.toggle("picked", picked() === x);
      });
    },
  };
}

/** The force in each joint as a curve about a pole: its tip over the cycle, and where it is now. */
export function polar(parent: Element, kernel: Kernel, c: Curve, unit: { unit: string; size: number }): View {
  const figure = html("figure", parent, { class: "polar" }), size = 66;
  const caption = html("figcaption", figure, {}, `Joint ${c.name}`), svg = canvas(figure, size, size, `polar diagram of joint ${c.name}`);
  const grid = make("path", svg, { class: "l-grid", style: "fill:none" }), line = make("path", svg, { class: `l-${c.role}`, style: "fill:none" });
  const arrow = new Arrow(svg, "joint-force", c.name);
  let perMm = 1;
  return {
    update(cycle) {
      const [fx, fy] = c.f!;
      if (cycle) {
        let most = 0;
        for (let k = 0; k < kernel.count; k++) if (kernel.good(k)) most = Math.max(most, Math.hypot(kernel.value(fx, k), kernel.value(fy, k)));
        perMm = roundUp(most / 28 / unit.size) * unit.size || unit.size;
        let d = "", pen = false;
        for (let k = 0; k < kernel.count; k++) {
          if (kernel.good(k)) d += `${pen ? "L" : "M"}${short(kernel.value(fx, k) / perMm)} ${short(-kernel.value(fy, k) / perMm)}`;
          pen = kernel.good(k);
        }
        line.setAttribute("d", d + (kernel.cyclic && d && !d.slice(1).includes("M") ? "Z" : ""));
        grid.setAttribute("d", "M-30 0H30M0 -30V30M15 0A15 15 0 1 0 -15 0A15 15 0 1 0 15 0M30 0A30 30 0 1 0 -30 0A30 30 0 1 0 30 0");
        caption.textContent = `Joint ${c.name}: 1 mm = ${figures(perMm / unit.size)} ${unit.unit}`;
      }
      const v = kernel.here;
      arrow.set([0, 0], kernel.solved ? [v[fx] / perMm, -v[fy] / perMm] : [0, 0]);
    },
  };
}

/** Forces of one link head to tail; the gap left over is drawn. */
export function polygon(parent: Element, data: Data, kernel: Kernel, p: Polygon): View & { figure: HTMLElement } {
  const figure = html("figure", parent, { class: "polygon" }), w = 110, h = 80, unit = data.units.force;
  html("figcaption", figure, {}, `Force polygon of link ${p.title}`);
  const svg = canvas(figure, w, h, `force polygon of link ${p.title}`), lettered = make("g", svg);
  const arrows = p.sides.map((s) => new Arrow(svg, s.role, s.name)), names = p.sides.map((s) => label(lettered, s.role, s.name, 3));
  const gap = make("path", svg, { class: "l-gap", style: "fill:none" }), note = make("text", svg, { class: "l-note-t", "font-size": 2.8, x: -w / 2 + 2, y: h / 2 - 2 });
  return {
    figure,
    update() {
      svg.setAttribute("visibility", kernel.solved ? "visible" : "hidden");
      if (!kernel.solved) return;
      const v = kernel.here, ends: Point[] = [[0, 0]];
      for (const s of p.sides) {
        const [x, y] = ends[ends.length - 1], f = s.t === "force" ? s.f : [0, 0];
        ends.push([x + v[f[0]], y - v[f[1]]]);
      }
      const xs = ends.map((e) => e[0]), ys = ends.map((e) => e[1]);
      const [l, r, t, b] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
      const perMm = roundUp(Math.max((r - l) / (w * 0.6), (b - t) / (h * 0.6)) / unit.size) * unit.size;
      const places = ends.map(([x, y]) => [(x - (l + r) / 2) / perMm, (y - (t + b) / 2) / perMm] as Point);
      const placer = new Placer([-w / 2, -h / 2, w / 2, h / 2 - 4]);
      for (let k = 0; k + 1 < places.length; k++) placer.line(places[k], places[k + 1]);
      arrows.forEach((a, k) => {
        const shown = a.set(places[k], places[k + 1]);
        names[k].el.setAttribute("visibility", shown ? "visible" : "hidden");
        if (!shown) return;
        const mid: Point = [(places[k][0] + places[k + 1][0]) / 2, (places[k][1] + places[k + 1][1]) / 2];
        placer.put({ label: names[k], anchors: [mid], away: mid, leave: 0.9 });
      });
      gap.setAttribute("d", path([places[0], places[places.length - 1]]));
      note.textContent = `1 mm = ${figures(perMm / unit.size)} ${unit.unit}`;
    },
  };
}
