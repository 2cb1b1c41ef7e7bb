/** The drawing: links, joints, loads and drives of the state as SVG. It holds no mechanics. */

import { type Drawing, type DrawnJoint, type DrawnLink, type DrawnLoad, figures, type Picked, type Point } from "./state";
import { Window } from "./view";

const NS = "http://www.w3.org/2000/svg";
type Attributes = Record<string, string | number | undefined>;

/** A new element of a drawing. */
export function make(parent: Element, tag: string, attributes: Attributes = {}, text?: string): SVGElement {
  const el = document.createElementNS(NS, tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== undefined) el.setAttribute(name, String(value));
  if (text !== undefined) el.textContent = text;
  parent.append(el);
  return el;
}
const d = (points: Point[], close = false): string => points.map((p, k) => `${k ? "L" : "M"}${p[0].toFixed(1)} ${p[1].toFixed(1)}`).join("") + (close ? "Z" : "");
const along = (p: Point, angle: number, far: number, aside = 0): Point => [p[0] + far * Math.cos(angle) + aside * Math.sin(angle), p[1] - far * Math.sin(angle) + aside * Math.cos(angle)];

/** Distance of a place from a chain of points. */
function away(p: Point, chain: Point[]): number {
  let least = chain.length ? Math.hypot(p[0] - chain[0][0], p[1] - chain[0][1]) : Infinity;
  for (let k = 1; k < chain.length; k++) {
    const [a, b] = [chain[k - 1], chain[k]], u = [b[0] - a[0], b[1] - a[1]], t = ((p[0] - a[0]) * u[0] + (p[1] - a[1]) * u[1]) / (u[0] * u[0] + u[1] * u[1] || 1);
    const s = Math.min(Math.max(t, 0), 1);
    least = Math.min(least, Math.hypot(p[0] - a[0] - s * u[0], p[1] - a[1] - s * u[1]));
  }
  return least;
}

/** Corners of the hull of some points, in order. */
function hull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (some: Point[]): Point[] => {
    const out: Point[] = [];
    for (const p of some) {
      while (out.length > 1) {
        const [a, b] = out.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return sorted.length < 3 ? sorted : [...half(sorted), ...half(sorted.reverse())];
}

export class Canvas {
  readonly svg: SVGSVGElement;
  readonly window: Window;
  readonly preview: SVGElement;
  private readonly layer: SVGElement;
  private readonly named = new Set<string>();
  private labels: { x: number; y: number; w: number }[] = [];

  constructor(parent: HTMLElement) {
    this.svg = make(parent, "svg", { class: "canvas", role: "img", "aria-label": "drawing of the mechanism" }) as SVGSVGElement;
    this.window = new Window(this.svg);
    this.layer = make(this.svg, "g");
    this.preview = make(this.svg, "g", { class: "preview" });
  }

  draw(drawing: Drawing, picked: Picked | null, misses: Map<string, Point> | null = null): void {
    this.layer.replaceChildren();
    this.labels = [];
    this.named.clear();
    if (drawing.space || !drawing.links) return;
    this.grid(drawing);
    const is = (kind: string, name: string): string => (picked?.kind === kind && picked.name === name ? " picked" : "");
    for (const j of drawing.joints) this.guide(j);
    for (const l of drawing.links) if (l.name !== "ground") this.link(l, is("links", l.name), drawing.links.filter((o) => o !== l && o.name !== "ground").map((o) => Object.values(o.points).map((p) => this.window.px(p))));
    for (const l of drawing.loads) if (l.between) this.span(l, is("loads", l.name));
    const ground = drawing.links.find((l) => l.name === "ground");
    const guided = new Set(drawing.joints.filter((j) => /slider|slot/.test(j.type)).map((j) => `${j.links[0]}.${j.at[0]}`));
    for (const [point, at] of Object.entries(ground?.points ?? {})) if (!guided.has(`ground.${point}`)) this.support(this.window.px(at));
    for (const j of drawing.joints) this.joint(j, is("joints", j.name));
    for (const l of drawing.links) for (const [name, at] of Object.entries(l.points)) this.point(l, name, at, drawing, picked);
    for (const v of drawing.drives) this.drive(drawing, v.joint, is("drives", v.name) || is("joints", v.joint));
    for (const l of drawing.loads) if (!l.between) this.load(l, drawing, is("loads", l.name));
    for (const [link, to] of misses ?? []) this.text(this.window.px(to), link, "gap");
    for (const j of drawing.joints)
      if (/pin|weld/.test(j.type) && Math.hypot(j.p[0] - j.q[0], j.p[1] - j.q[1]) * this.window.scale > 2) {
        const gap = Math.hypot(j.p[0] - j.q[0], j.p[1] - j.q[1]), u = drawing.units.length;
        make(this.layer, "path", { class: "gap", d: d([this.window.px(j.p), this.window.px(j.q)]) });
        this.text(this.window.px(j.q), `${j.name} open by ${figures(gap / u.size, 3)} ${u.unit}`, "gap");
      }
  }

  private grid(drawing: Drawing): void {
    const { width, height } = this.svg.getBoundingClientRect(), unit = drawing.units.length, step = this.window.step(unit.size, 28);
    const [x0, y1] = this.window.metres(0, 0), [x1, y0] = this.window.metres(width, height);
    const lines: Point[][] = [];
    // counted from the edge: so far out that a step is lost in rounding, the loop still ends
    const across = (from: number, to: number): number[] => Array.from({ length: Math.min(Math.ceil((to - from) / step), 500) }, (_, n) => (Math.ceil(from / step) + n) * step).filter((x) => x < to);
    for (const x of across(x0, x1)) lines.push([this.window.px([x, y0]), this.window.px([x, y1])]);
    for (const y of across(y0, y1)) lines.push([this.window.px([x0, y]), this.window.px([x1, y])]);
    make(this.layer, "path", { class: "grid", d: lines.map((l) => d(l)).join("") });
    const bar = this.window.step(unit.size, 90), y = height - 14;
    make(this.layer, "path", { class: "scale", d: d([[14, y - 4], [14, y], [14 + bar * this.window.scale, y], [14 + bar * this.window.scale, y - 4]]) });
    make(this.layer, "text", { x: 20 + bar * this.window.scale, y: y + 1, class: "scale" }, `${figures(bar / unit.size)} ${unit.unit}`);
  }

  private link(l: DrawnLink, picked: string, others: Point[][]): void {
    const points = Object.values(l.points).map((p) => this.window.px(p)), corners = hull(points);
    if (corners.length > 1) {
      const shape = d(corners, corners.length > 2);
      make(this.layer, "path", { class: `rim${picked}`, d: shape, "data-kind": "links", "data-name": l.name });
      make(this.layer, "path", { class: `link${picked}`, d: shape, "data-kind": "links", "data-name": l.name });
      const middle: Point = [0, 1].map((k) => corners.reduce((s, p) => s + p[k], 0) / corners.length) as Point;
      const [a, b] = corners, turn = Math.atan2(b[1] - a[1], b[0] - a[0]), w = 3.3 * l.name.length;
      const sides = [1, -1].map((k): Point => [k * Math.sin(turn), -k * Math.cos(turn)]);
      const free = (v: Point): number => Math.min(...others.map((o) => away([middle[0] + v[0] * (12 + w), middle[1] + v[1] * 16], o)), 60);
      const n = free(sides[0]) >= free(sides[1]) - 3 ? sides[0] : sides[1], side = Math.abs(n[0]) < 0.3 ? "middle" : n[0] > 0 ? "start" : "end";
      if (corners.length > 2) this.text(middle, l.name, "name");
      else this.text([middle[0] + 11 * n[0], middle[1] + 11 * n[1] + (n[1] > 0.3 ? 9 : n[1] < -0.3 ? 0 : 4)], l.name, "name", side);
    }
    if (l.center) {
      const [x, y] = this.window.px(l.center);
      make(this.layer, "path", { class: "center", d: `M${x - 4} ${y}h8M${x} ${y - 4}v8` });
    }
  }

  private support(p: Point): void {
    const [x, y] = p, w = 11;
    const hatch = [-10, -5, 0, 5, 10].map((k) => `M${x + k + 2} ${y + 15}l-5 6`).join("");
    make(this.layer, "path", { class: "support", d: `M${x} ${y}L${x - w + 2} ${y + 15}H${x + w - 2}ZM${x - w - 2} ${y + 15}H${x + w + 2}${hatch}` });
  }

  private guide(j: DrawnJoint): void {
    if (j.direction === undefined || !/slider|slot/.test(j.type)) return;
    const p = this.window.px(j.p), q = this.window.px(j.q), s = (q[0] - p[0]) * Math.cos(j.direction) - (q[1] - p[1]) * Math.sin(j.direction), far = 42;
    const aside = j.type === "slot" ? [-8, 8] : [10];
    for (const a of aside) make(this.layer, "path", { class: "guide", d: d([along(p, j.direction, Math.min(s, 0) - far, a), along(p, j.direction, Math.max(s, 0) + far, a)]) });
    if (j.type === "slider" && j.links[0] === "ground") {
      const marks: string[] = [];
      for (let k = Math.min(s, 0) - far; k < Math.max(s, 0) + far; k += 9) marks.push(d([along(p, j.direction, k, 10), along(p, j.direction, k - 5, 16)]));
      make(this.layer, "path", { class: "guide thin", d: marks.join("") });
    }
  }

  private joint(j: DrawnJoint, picked: string): void {
    const q = this.window.px(j.q), data = { "data-kind": "joints", "data-name": j.name };
    if (j.radii) for (const [at, r] of [[j.p, j.radii[0]], [j.q, j.radii[1]]] as const) {
      const [x, y] = this.window.px(at);
      make(this.layer, "circle", { class: `wheel${picked}`, cx: x, cy: y, r: this.window.long(r), ...data });
    }
    if (j.radius) {
      const [x, y] = this.window.px(j.type === "rolling" ? j.q : j.p);
      make(this.layer, "circle", { class: `wheel${picked}`, cx: x, cy: y, r: this.window.long(j.radius), ...data });
    }
    if (j.type === "slider") {
      const a = j.direction ?? 0, corners = ([[-13, -9], [13, -9], [13, 9], [-13, 9]] as Point[]).map(([u, v]) => along(q, a, u, v));
      make(this.layer, "path", { class: `block${picked}`, d: d(corners, true), ...data });
    }
  }

  private point(l: DrawnLink, name: string, at: Point, drawing: Drawing, picked: Picked | null): void {
    const [x, y] = this.window.px(at), joints = drawing.joints.filter((j) => j.links.some((link, k) => link === l.name && j.at[k] === name));
    const pinned = joints.find((j) => j.type === "pin" || j.type === "slot"), own = picked?.kind === "points" && picked.name === name && picked.link === l.name;
    const joint = pinned ?? joints[0], on = own || (picked?.kind === "joints" && joints.some((j) => j.name === picked.name));
    const weld = joints.some((j) => j.type === "weld");
    make(this.layer, "circle", { class: `pin${on ? " picked" : ""}${joints.length ? "" : " open"}${weld ? " weld" : ""}`, cx: x, cy: y, r: joints.length ? 5.5 : 3.5, "data-kind": joint ? "joints" : "points", "data-name": joint?.name ?? name, "data-link": l.name, "data-point": name });
    const said = pinned?.name ?? (joints.length ? undefined : name);
    const key = `${said} ${x.toFixed()} ${y.toFixed()}`;
    const far = joints.some((j) => drawing.drives.some((v) => v.joint === j.name)) ? 19 : 10;
    if (said && !this.named.has(key)) this.text([x - far, y - far / 2 - 3], said, "point", "end");
    this.named.add(key);
  }

  private drive(drawing: Drawing, joint: string, picked: string): void {
    const j = drawing.joints.find((one) => one.name === joint);
    if (!j) return;
    const p = this.window.px(j.q), data = { "data-kind": "joints", "data-name": joint };
    if (j.type === "slider") {
      const a = j.direction ?? 0;
      make(this.layer, "path", { class: `drive${picked}`, d: d([along(p, a, 18), along(p, a, 46)]), "marker-end": "url(#driven)", ...data });
      return;
    }
    const [x, y] = p, r = 17;
    make(this.layer, "path", { class: `drive${picked}`, d: `M${x + r} ${y}A${r} ${r} 0 1 0 ${x} ${y + r}`, "marker-end": "url(#driven)", ...data });
  }

  private load(l: DrawnLoad, drawing: Drawing, picked: string): void {
    if (!l.p) return;
    const p = this.window.px(l.p), data = { "data-kind": "loads", "data-name": l.name }, said = `${l.name} ${value(l, drawing)}`.trim();
    if (l.vector && Math.hypot(...l.vector) > 0) {
      const angle = Math.atan2(l.vector[1], l.vector[0]), tip = along(p, angle, 62);
      make(this.layer, "path", { class: "catch", d: d([along(p, angle, 8), tip]), ...data });
      make(this.layer, "path", { class: `force${picked}`, d: d([p, along(p, angle, 56)]), "marker-end": "url(#acting)", ...data });
      this.text([tip[0] + 6 * Math.sign(Math.cos(angle)), tip[1] - 8], said, "load", Math.cos(angle) < -0.2 ? "end" : "start");
    } else {
      const [x, y] = p, r = 24;
      make(this.layer, "path", { class: `force${picked}`, d: `M${x + r} ${y}A${r} ${r} 0 1 0 ${x} ${y + r}`, "marker-end": "url(#acting)", ...data });
      this.text([x - r - 4, y - r], said, "load", "end");
    }
  }

  private span(l: DrawnLoad, picked: string): void {
    const [a, b] = l.between!.map((p) => this.window.px(p)), angle = Math.atan2(a[1] - b[1], b[0] - a[0]), far = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const data = { "data-kind": "loads", "data-name": l.name }, at = (u: number, v: number): Point => along(a, angle, u * far, v);
    const zigzag: Point[] = [a, ...Array.from({ length: 9 }, (_, k) => at(0.2 + (0.6 * k) / 8, k === 0 || k === 8 ? 0 : k % 2 ? 7 : -7)), b];
    const damper = `${d([a, at(0.45, 0)])}${d([at(0.6, 8), at(0.35, 8), at(0.35, -8), at(0.6, -8)])}${d([at(0.5, 6), at(0.5, -6)])}${d([at(0.5, 0), b])}`;
    make(this.layer, "path", { class: "catch", d: d([a, b]), ...data });
    make(this.layer, "path", { class: `spring${picked}`, d: l.type === "damper" ? damper : d(zigzag), ...data });
    this.text(at(0.5, -16), l.name, "load");
  }

  /** A text that moves down where another one stands. */
  text(at: Point, said: string, role: string, anchor = "middle"): void {
    const w = 6.6 * said.length, x = anchor === "start" ? at[0] : anchor === "end" ? at[0] - w : at[0] - w / 2;
    let y = at[1];
    for (let k = 0; k < 6 && this.labels.some((b) => x < b.x + b.w && b.x < x + w && Math.abs(b.y - y) < 13); k++) y += 14;
    this.labels.push({ x, y, w });
    make(this.layer, "text", { x: at[0], y, class: `label ${role}`, "text-anchor": anchor }, said);
  }
}

/** A load's value as the file says it. */
function value(l: DrawnLoad, drawing: Drawing): string {
  const said = l.written?.value;
  if (said === undefined || said === l.name || typeof said === "object") return ""; // a parameter of the load's name
  const unit = l.type === "force" ? "force" : "moment";
  return typeof said === "number" ? `${figures(said)} ${drawing.units[unit].unit}` : String(said).split("@")[0].trim().replace(/^([-+.\deE]+)$/, `$1 ${drawing.units[unit].unit}`);
}
