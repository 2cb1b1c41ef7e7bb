/** How a page is looked at: kept outside the page, so that other data can take its place without a change of view. */

import type { Pair } from "./data";

/** What can be pointed at: `kind` is link, joint, load, center, point, direction, trace, effort, inertia, weight... */
export interface Identity { kind: string; name: string; link?: string }
export const LAYERS = ["loads", "reactions", "inertia", "velocities", "accelerations", "names", "traces", "values", "digits"] as const;
export type Layer = (typeof LAYERS)[number];
/** A point of a link whose path is drawn, in the link's axes, metres. */
export interface Tracer { link: string; u: number[] }

export interface View {
  /** Place of the cycle; NaN: where the file begins. */
  t: number;
  /** Switches that were set; a layer without an entry is as the mechanism suggests. */
  shown: Partial<Record<Layer, boolean>>;
  /** Metres per mm of paper and the centre; null: the whole mechanism fits. */
  window: { perMm: number; middle: Pair } | null;
  /** Direction of view in space: azimuth and elevation, radians. */
  camera: Pair;
  chosen: Identity | null;
  /** The curve (`of`), the link of the free body, the tab. */
  curve: string; body: string; tab: string;
  /** Cycles of the animation in its usual time. */
  speed: number;
  /** Dragging a joint changes the mechanism, or turns it. */
  drag: "shape" | "turn";
  tracers: Tracer[];
}

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export const firstView = (): View => ({
  t: NaN, shown: {}, window: null, camera: [-Math.PI / 3, 0.45], chosen: null, curve: "", body: "", tab: "", speed: 1, drag: "shape", tracers: [],
});

/** What of a view differs from the first, as entries of an address; their names begin with "~", as no path does. */
export function viewEntries(v: View): [string, string][] {
  const out: [string, string][] = [], add = (name: string, text: string, usual = "") => text !== usual && out.push([`~${name}`, text]);
  const named = (on: boolean) => LAYERS.filter((l) => v.shown[l] === on).join(" ");
  add("show", named(true));
  add("hide", named(false));
  if (v.window) add("window", [v.window.perMm, ...v.window.middle].map((x) => +x.toPrecision(6)).join(" "));
  add("tab", v.tab);
  add("speed", String(v.speed), "1");
  add("drag", v.drag, "shape");
  add("trace", v.tracers.map((p) => [p.link, ...p.u.map((x) => +x.toPrecision(6))].join(" ")).join("; "));
  return out;
}

/** Reads such entries into a view; what cannot be read is left out. */
export function readView(v: View, entries: Map<string, string>): void {
  const of = (name: string): string => entries.get(`~${name}`) ?? "", numbers = (text: string): number[] => text.split(" ").map(Number);
  for (const [name, on] of [["show", true], ["hide", false]] as const)
    for (const layer of LAYERS) if (of(name).split(" ").includes(layer)) v.shown[layer] = on;
  const [perMm, x, y] = numbers(of("window"));
  if (perMm > 0 && Number.isFinite(perMm + x + y)) v.window = { perMm, middle: [x, y] };
  v.tab = of("tab");
  if (SPEEDS.includes(+of("speed"))) v.speed = +of("speed");
  if (of("drag") === "turn") v.drag = "turn";
  v.tracers = of("trace").split("; ").flatMap((one) => {
    const [link, ...rest] = one.split(" "), u = rest.map(Number);
    return u.length > 1 && u.every(Number.isFinite) ? [{ link, u }] : [];
  });
}

/** Which layers are shown before any switch is used; ``many``: names of so many joints would hide the drawing. */
export function usually(layer: Layer, many: boolean): boolean {
  return { loads: true, reactions: true, inertia: true, velocities: false, accelerations: false, names: !many, traces: true, values: false, digits: false }[layer];
}
