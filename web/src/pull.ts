/** Dragging a link, or a joint of it, turns the mechanism: the place of the cycle at which the held point is nearest. */

import type { Board } from "./board";
import type { Data } from "./data";
import { FINGER, hits, identity, NEAR } from "./hits";
import type { Kernel } from "./kernel";
import type { Material } from "./material";
import { type Point, pointer } from "./svg";

export interface Seek { seek(t: number): void; time(): number }

/** Share of the cycle that one move of the pointer may pass over. */
const REACH = 1 / 10;

/** The moving link of a part, by number; -1 of the ground, and of what no link carries. */
export function linkOf(data: { sketch: Pick<Data["sketch"], "links" | "rows"> }, item: string | undefined): number {
  if (!item) return -1;
  const { kind, name } = identity(item), { links, rows } = data.sketch;
  if (kind === "link" || kind === "center") return links.indexOf(name);
  const ends = kind === "joint" ? rows.find((r) => r.joint === name)?.ends : undefined;
  return ends?.find((k) => k < links.length) ?? -1;
}

/** The first part under a pointer that a moving link carries, as its number; -1 without one. */
export function heldLink(svg: SVGSVGElement, e: PointerEvent, of: (item: string) => number): number {
  for (const { kind, name } of hits(svg, e.clientX, e.clientY, e.pointerType === "touch" ? FINGER : NEAR)) {
    const link = of(`${kind}:${name}`);
    if (link >= 0) return link;
  }
  return -1;
}

export function pull(b: Board, data: Data, kernel: Kernel, material: Material, seek: Seek): void {
  if (kernel.count < 2) return;
  let link = -1, u: number[] = [];
  b.svg.addEventListener("pointerdown", (e) => {
    link = e.button === 0 ? heldLink(b.svg, e, (item) => linkOf(data, item)) : -1;
    if (link < 0) return;
    b.svg.setPointerCapture(e.pointerId);
    u = material.local(b.paper, link, pointer(b.svg, e));
  });
  b.svg.addEventListener("pointermove", (e) => {
    if (link >= 0 && b.svg.hasPointerCapture(e.pointerId)) seek.seek(nearest(pointer(b.svg, e)));
  });
  const up = (): void => void (link = -1);
  b.svg.addEventListener("pointerup", up);
  b.svg.addEventListener("pointercancel", up);

  /** The nearest place of the path between positions that are reached, not far from the present one. */
  function nearest(p: Point): number {
    const { count, cyclic } = kernel, t = seek.time(), reach = Math.max(3, Math.ceil(count * REACH));
    let best = t, away = Infinity;
    const known = new Map<number, Point | null>(), at = (k: number): Point | null => {
      if (!known.has(k)) known.set(k, kernel.motion.poses[k] ? material.on(b.paper, link, u, k) : null);
      return known.get(k)!;
    };
    for (let k = Math.floor(t) - reach; k <= Math.floor(t) + reach; k++) {
      if (!cyclic && (k < 0 || k + 1 >= count)) continue;
      const [i, j] = [k, k + 1].map((n) => ((n % count) + count) % count), [from, to] = [at(i), at(j)];
      if (!from || !to) continue;
      const d = [to[0] - from[0], to[1] - from[1]], long = d[0] ** 2 + d[1] ** 2 || 1;
      const s = Math.min(Math.max(((p[0] - from[0]) * d[0] + (p[1] - from[1]) * d[1]) / long, 0), 1);
      const miss = Math.hypot(p[0] - from[0] - s * d[0], p[1] - from[1] - s * d[1]) + 1e-3 * Math.abs(k + s - t);
      if (miss < away) [best, away] = [k + s, miss];
    }
    return cyclic ? ((best % count) + count) % count : best;
  }
}
