/** Beyond the drawing: derivatives as arrows, a cloud of tolerances, undo, the state in the address, files. */

import type { Board } from "./board";
import type { Curve, Data, End, Rows } from "./data";
import type { Gate } from "./gate";
import type { Kernel } from "./kernel";
import { Arrow, figures, make, plain, set } from "./svg";
import { readView, type View, viewEntries } from "./view";

/** At each joint, point and mass centre the direction in which moving it lowers the peak of a curve. */
export class Gradients {
  on = false;
  private readonly arrows: { p: Rows; ends: End[]; arrow: Arrow }[];
  constructor(private readonly b: Board, private readonly data: Data, private readonly kernel: Kernel) {
    const layer = make("g", b.svg, { class: "gradient" });
    const movable = data.gradient ? data.handles.flatMap((h) => ("ends" in h && h.ends.length ? [h] : [])) : [];
    this.arrows = movable.map((h) => ({ p: h.p, ends: h.ends, arrow: new Arrow(layer, "acceleration", `lower the peak by ${h.name}`) }));
  }
  /** The largest size of a curve over the cycle, and in words where it is. */
  peak(curve: Curve): { k: number; size: number; where: string } {
    const k = this.kernel, of = (n: number): number => Math.abs(k.value(curve.row, n)), size = k.largest(of);
    const peak = Math.max(0, k.good.findIndex((good, n) => good > 0 && of(n) === size));
    return { k: peak, size, where: k.count > 1 ? ` at ${standing(this.data, k, peak)}` : "" };
  }
  update(curve: Curve | undefined): void {
    const g = this.data.gradient, k = this.kernel, place = curve && g ? g.curves.indexOf(curve.row) : -1;
    if (!this.on || place < 0 || !g || !curve || !k.solved) return this.arrows.forEach((a) => a.arrow.set([0, 0], [0, 0]));
    const peak = this.peak(curve).k;
    const slope = k.gradient(place, peak), down = -Math.sign(k.value(curve.row, peak)) || 1;
    const by = new Map(g.numbers.map((n, i) => [n, slope[i]]));
    const vectors = this.arrows.map(({ ends }) => {
      const v = this.b.paper.axes[0].map(() => 0);
      for (const e of ends)
        e.axes.forEach((axis, c) => axis.forEach((r, i) => (v[i] += down * k.here[r] * (by.get(e.n[c]) ?? 0))));
      return this.b.paper.project(v);
    });
    const longest = Math.max(...vectors.map((v) => Math.hypot(...v)), 1e-300);
    this.arrows.forEach(({ p, arrow }, n) => {
      const [x, y] = this.b.paper.point(p), [dx, dy] = vectors[n];
      arrow.set([x, y], [x + (14 * dx) / longest, y - (14 * dy) / longest], 0.5);
    });
  }
}

/** Where the drives stand at a place of the cycle: 'O2 = 60°'. */
export const standing = (data: Data, kernel: Kernel, t: number): string =>
  data.drives.map((d) => `${d.name} = ${figures(kernel.position(d.name, t) / d.size, 5)}${d.unit === "°" ? "" : " "}${d.unit}`).join(", ");

/** A thousand machines whose points lie about those of this one, drawn as dots. */
export class Cloud {
  on = false;
  part = 0.005;
  private readonly draws: Float64Array[];
  private readonly out: Float64Array;
  private readonly numbers: number[];
  readonly canvas: HTMLCanvasElement;
  constructor(parent: Element, private readonly b: Board, data: Data, private readonly kernel: Kernel, private readonly places: Rows[]) {
    this.numbers = data.numbers.flatMap((n, k) => (/\.points\./.test(n.path) || n.path.endsWith(".center.0") || n.path.endsWith(".center.1") ? [k] : []));
    this.canvas = document.createElement("canvas");
    this.canvas.className = "cloud";
    this.canvas.setAttribute("aria-hidden", "true");
    parent.append(this.canvas);
    this.out = new Float64Array(kernel.here.length);
    let seed = 12345;
    const uniform = () => ((seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) + 0.5) / 4294967296;
    const normal = () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
    this.draws = Array.from({ length: 1000 }, () => Float64Array.from({ length: this.numbers.length }, normal));
  }
  /** Spread of a curve at this place over the machines: mean, standard deviation; null where it is off. */
  update(row: number | undefined): { mean: number; sigma: number } | null {
    const c = this.canvas;
    c.hidden = !this.on;
    if (!this.on) return null;
    const box = this.b.svg.getBoundingClientRect();
    const dots = window.devicePixelRatio || 1, [w, h] = [Math.round(box.width * dots), Math.round(box.height * dots)];
    if (c.width !== w || c.height !== h) (c.width = w), (c.height = h);
    const g = c.getContext("2d")!, view = this.b.svg.viewBox.baseVal, scale = Math.min(w / view.width, h / view.height);
    g.clearRect(0, 0, w, h);
    g.fillStyle = "rgba(122,47,160,.25)";
    const k = this.kernel, nominal = k.values.slice(), sigma = (this.part * this.reach()) / 3, trial = nominal.slice();
    let sum = 0, squares = 0, count = 0;
    for (const draw of this.draws) {
      this.numbers.forEach((n, i) => (trial[n] = nominal[n] + sigma * draw[i]));
      k.other(trial, this.out);
      if (!k.numbered(this.out[this.out.length - 1])) continue;
      for (const p of this.places) {
        const [px, py] = this.b.paper.of(...this.b.paper.seen(p, (r) => this.out[r]));
        g.fillRect((px - view.x) * scale + (w - view.width * scale) / 2, (py - view.y) * scale + (h - view.height * scale) / 2, dots, dots);
      }
      if (row !== undefined) (sum += this.out[row]), (squares += this.out[row] ** 2), count++;
    }
    k.other(nominal, this.out);
    const mean = sum / (count || 1);
    return count ? { mean, sigma: Math.sqrt(Math.max(squares / count - mean * mean, 0)) } : null;
  }
  private reach(): number {
    return this.b.svg.viewBox.baseVal.width * 0.5 * this.b.paper.perMm;
  }
}

/** Numbers as they were, to go back to. */
export class History {
  private past: Float64Array[] = [];
  private future: Float64Array[] = [];
  private now: Float64Array;
  constructor(private readonly kernel: Kernel, private readonly gate: Gate) {
    this.now = kernel.state();
  }
  note(): void {
    if (this.kernel.values.every((x, k) => x === this.now[k])) return;
    this.past.push(this.now);
    if (this.past.length > 500) this.past.shift();
    this.future = [];
    this.now = this.kernel.state();
  }
  go(back: boolean): boolean {
    const from = back ? this.past : this.future, to = back ? this.future : this.past, next = from.pop();
    if (!next) return false;
    to.push(this.now);
    this.now = next;
    this.kernel.restore(next);
    this.gate.accept(this.kernel.values);
    return true;
  }
  get can(): [boolean, boolean] {
    return [this.past.length > 0, this.future.length > 0];
  }
}

/** The numbers that are not those of the file, by path, and with them the assembly of the first position. */
export function changes(data: Data, kernel: Kernel): Record<string, number> {
  const found = data.numbers.flatMap((n, k): [string, number][] => (kernel.values[k] === n.value ? [] : [[n.path, kernel.values[k]]]));
  const pose = found.length ? kernel.motion.assembly() : [];
  return Object.fromEntries([...found, ...pose.map((x, k) => [data.sketch.assembly[k], x])]);
}

/** The changed numbers, the place of the cycle and the view as text for an address. */
export function fragment(data: Data, kernel: Kernel, view: View): string {
  const said = new URLSearchParams({ t: String(+view.t.toFixed(4)) });
  for (const [name, text] of viewEntries(view)) said.set(name, text);
  for (const [path, x] of Object.entries(changes(data, kernel))) said.set(path, String(x));
  return said.toString();
}

/** Reads such a text into the page's numbers and its view. */
export function restore(kernel: Kernel, gate: Gate, view: View, said: string): void {
  const entries = new Map(new URLSearchParams(said.replace(/^#/, ""))), numbers: Record<string, number> = {};
  readView(view, entries);
  for (const [path, x] of entries) if (path !== "t" && !path.startsWith("~")) numbers[path] = x.trim() ? Number(x) : NaN;
  gate.change(numbers);
  const t = Number(entries.get("t") ?? NaN);
  if (Number.isFinite(t)) view.t = Math.min(Math.max(t, 0), kernel.end);
}

/** The model file as its author wrote it, with the numbers as they are and, if any has changed, the assembly as it is. */
export function modelText(data: Data, kernel: Kernel): string {
  const all = [...kernel.values, ...kernel.motion.assembly()], changed = data.numbers.map((n, k) => n.value !== kernel.values[k]), any = changed.includes(true);
  return data.template.map((part) => {
    if (typeof part === "string") return part;
    if (part.was !== undefined && !part.of?.some((n) => changed[n] ?? any)) return part.was;
    return part.now.map((x) => (typeof x === "string" ? x : String(all[x[0]] / x[1]))).join("");
  }).join("");
}

/** The curves over the cycle as a table, in the page's units. */
export function csvText(data: Data, kernel: Kernel): string {
  const cell = (s: string) => (/[",\n]/.test(s) || /^[=+\-@]/.test(s) ? `"${s.replace(/^([=+\-@])/, "'$1").replace(/"/g, '""')}"` : s);
  const curves = data.views.charts.flatMap((c) => c.curves.map((x) => ({ x, unit: data.units[c.kind] })));
  const head = [...data.drives.map((d) => `${d.name} [${d.unit}]`), "status", ...curves.map(({ x, unit }) => `${x.of} [${unit.unit}]`)];
  const lines = [head.map(cell).join(",")];
  for (let k = 0; k < kernel.count; k++) {
    const drives = data.drives.map((d) => kernel.positions.get(d.name)![k] / d.size);
    lines.push([...drives, data.statuses[kernel.markAt(k)].status, ...curves.map(({ x, unit }) => (kernel.good[k] ? kernel.value(x.row, k) / unit.size : ""))].join(","));
  }
  return lines.join("\n") + "\n";
}

export function svgText(svg: SVGSVGElement, style: string): string {
  const copy = svg.cloneNode(true) as SVGSVGElement, { width, height } = svg.viewBox.baseVal;
  copy.querySelectorAll(".handles, .overlay").forEach((g) => g.remove());
  set(copy, { xmlns: "http://www.w3.org/2000/svg", width: `${width}mm`, height: `${height}mm`, "font-family": "'DejaVu Sans', Arial, sans-serif" });
  const s = make("style", null);
  s.textContent = style;
  copy.prepend(s);
  return new XMLSerializer().serializeToString(copy);
}

/** Pixels per mm of a picture: 300 per inch. */
const DOTS = 300 / 25.4;

/** The drawing as pixels on white. */
export async function pngOf(svg: SVGSVGElement, style: string): Promise<Blob> {
  const { width, height } = svg.viewBox.baseVal, picture = new Image(), address = URL.createObjectURL(new Blob([svgText(svg, style)], { type: "image/svg+xml" }));
  try {
    picture.src = address;
    await picture.decode();
    const paper = document.createElement("canvas"), g = paper.getContext("2d")!;
    [paper.width, paper.height] = [Math.round(width * DOTS), Math.round(height * DOTS)];
    g.fillStyle = "#fff";
    g.fillRect(0, 0, paper.width, paper.height);
    g.drawImage(picture, 0, 0, paper.width, paper.height);
    return await new Promise((done, fail) => paper.toBlob((blob) => (blob ? done(blob) : fail(new Error("the picture is too large"))), "image/png"));
  } finally {
    URL.revokeObjectURL(address);
  }
}

export function save(name: string, text: string | Blob, type: string): void {
  const a = document.createElement("a");
  a.href = URL.createObjectURL(new Blob([text], { type }));
  a.download = name;
  a.click();
  setTimeout(() => URL.revokeObjectURL(a.href), 1000);
}

export const fileName = (title: string): string => plain(title).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "mechanism";
