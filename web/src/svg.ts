/** SVG elements, texts with subscripts, arrows. Millimetres of paper, y down. */

export type Point = [number, number];
const SVG = "http://www.w3.org/2000/svg";

type Attributes = Record<string, string | number>;

/** Gives an element an attribute; one that it has is left alone, for the browser would draw it anew. */
export function attr(el: Element, name: string, value: string): void {
  if (el.getAttribute(name) !== value) el.setAttribute(name, value);
}

/** Gives an element its text, if it has another one. */
export function say(el: Element, text: string): void {
  if (el.textContent !== text) el.textContent = text;
}

/** Gives an element attributes, and returns it. */
export function set<E extends Element>(el: E, attributes: Attributes): E {
  for (const name in attributes) attr(el, name, String(attributes[name]));
  return el;
}

export function make<K extends keyof SVGElementTagNameMap>(name: K, parent: Element | null, attributes: Attributes = {}): SVGElementTagNameMap[K] {
  const out = set(document.createElementNS(SVG, name), attributes);
  parent?.append(out);
  return out;
}

export function html<K extends keyof HTMLElementTagNameMap>(name: K, parent: Element | null, attributes: Attributes = {}, text = ""): HTMLElementTagNameMap[K] {
  const out = set(document.createElement(name), attributes);
  if (text) out.textContent = text;
  parent?.append(out);
  return out;
}

/** Millimetres beyond which nothing is drawn farther out: SVG's numbers end long before those of a machine. */
const FAR = 1e6;

/** To a hundredth; by whole numbers, for toFixed takes twice as long. */
export function short(x: number): string {
  const n = Math.round(100 * Math.min(Math.abs(x), FAR)), whole = Math.floor(n / 100), rest = n % 100, sign = x < 0 && n ? "-" : "";
  return sign + whole + (rest ? (rest < 10 ? ".0" : ".") + rest : "");
}

/** A number to some figures, with a real minus. */
export const figures = (x: number, digits = 4): string => (Number.isFinite(x) ? String(+x.toPrecision(digits)).replace("-", "−") : "–");

export function path(points: Point[], closed = false): string {
  return points.length ? "M" + points.map(([x, y]) => short(x) + " " + short(y)).join("L") + (closed ? "Z" : "") : "";
}

export function place(el: Element, x: number, y: number): void {
  attr(el, "transform", `translate(${short(x)} ${short(y)})`);
}

/** Where a pointer is, in the units of a drawing. */
export function pointer(svg: SVGSVGElement, e: { clientX: number; clientY: number }): Point {
  const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM()!.inverse());
  return [p.x, p.y];
}

/** Put a text into an element, what stands in `_{...}` as small letters below. */
export function letters(el: Element, text: string, size: number): void {
  el.replaceChildren();
  let low = false;
  for (const part of text.split(/(_\{[^}]*\})/)) {
    if (!part) continue;
    const sub = part.startsWith("_{"), span = make("tspan", el, sub ? { "font-size": 0.7 * size } : {});
    span.textContent = sub ? part.slice(2, -1) : part;
    if (sub !== low) span.setAttribute("dy", String((sub ? 0.25 : -0.25) * size));
    low = sub;
  }
}

/** Signs without their marks, for lists and names: F_{12} gives F12. */
export const plain = (text: string): string => text.replace(/_\{([^}]*)\}/g, "$1");

let measure: CanvasRenderingContext2D | null = null;
const widths = new Map<string, number>();

/** Width in mm of a text of a size; subscripts are smaller. */
export function width(text: string, size: number, bold = false): number {
  const key = `${bold}${text}`;
  let found = widths.get(key);
  if (found === undefined) {
    measure ??= document.createElement("canvas").getContext("2d")!;
    measure.font = `${bold ? "bold " : ""}100px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif`;
    found = 0;
    for (const part of text.split(/(_\{[^}]*\})/)) {
      const sub = part.startsWith("_{");
      found += (measure.measureText(sub ? part.slice(2, -1) : part).width / 100) * (sub ? 0.7 : 1);
    }
    widths.set(key, found);
  }
  return found * size;
}

export function text(parent: Element, role: string, said: string, size: number, anchor = "middle"): SVGTextElement {
  const out = make("text", parent, { class: `l-${role}-t`, "font-size": size, "text-anchor": anchor });
  letters(out, said, size);
  return out;
}

/** A straight arrow; its head is smaller where it is short. */
export class Arrow {
  readonly g: SVGGElement;
  private readonly shaft: SVGPathElement;
  private readonly head: SVGPathElement;
  constructor(parent: Element, role: string, name = "") {
    this.g = make("g", parent);
    if (name) make("title", this.g).textContent = plain(name);
    this.shaft = make("path", this.g, { class: `l-${role}`, style: "fill:none" });
    this.head = make("path", this.g, { class: `l-${role}-h` });
  }
  /** Draw it; nothing where it is shorter than `least` mm. */
  set(tail: Point, tip: Point, least = 0.3): boolean {
    const dx = tip[0] - tail[0], dy = tip[1] - tail[1], length = Math.hypot(dx, dy);
    const shown = length > least && Number.isFinite(length);
    attr(this.g, "display", shown ? "inline" : "none");
    if (!shown) return false;
    const ux = dx / length, uy = dy / length, size = Math.min(3, 0.75 * length), side = 0.3 * size;
    const base: Point = [tip[0] - size * ux, tip[1] - size * uy];
    attr(this.shaft, "d", path([tail, [tip[0] - 0.8 * size * ux, tip[1] - 0.8 * size * uy]]));
    attr(this.head, "d", path([tip, [base[0] - side * uy, base[1] + side * ux], [base[0] + side * uy, base[1] - side * ux]], true));
    return true;
  }
}

export function hull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (a: Point, b: Point, c: Point) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (some: Point[]): Point[] => {
    const out: Point[] = [];
    for (const p of some) {
      while (out.length > 1 && turn(out[out.length - 2], out[out.length - 1], p) <= 0.01) out.pop();
      out.push(p);
    }
    return out;
  };
  return [...half(sorted).slice(0, -1), ...half(sorted.reverse()).slice(0, -1)];
}
