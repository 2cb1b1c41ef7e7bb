/** What lies under a pointer, by kind and name; the chosen part. */

import type { Identity } from "./view";

/** Of parts in one place the lower comes first. */
const RANK: Record<string, number> = { joint: 0, point: 0, tracer: 0, center: 1, load: 1, direction: 1, link: 4, trace: 5 };
/** Pixels around a pointer within which a part is hit; more for a finger. */
export const NEAR = 6, FINGER = 14;

export const identity = (item: string): Identity => {
  const k = item.indexOf(":");
  return { kind: item.slice(0, k), name: item.slice(k + 1) };
};
export const same = (a: Identity | null, b: Identity | null): boolean => !!a && !!b && a.kind === b.kind && a.name === b.name;

/** Parts near a place of the window, the nearest first, all of those that lie there. */
export function hits(svg: SVGSVGElement, x: number, y: number, reach = NEAR): Identity[] {
  const root = svg.getRootNode() as Document | ShadowRoot, found = new Map<string, number>();
  [0, 0.5, 1].forEach((part, ring) => {
    for (let k = 0; k < (ring ? 8 : 1); k++) {
      const angle = (k * Math.PI) / 4;
      for (const el of root.elementsFromPoint(x + part * reach * Math.cos(angle), y + part * reach * Math.sin(angle))) {
        const item = svg.contains(el) && el.closest<SVGElement>("[data-item]")?.dataset.item;
        if (item && !found.has(item)) found.set(item, 2 * ring + (RANK[identity(item).kind] ?? 2));
      }
    }
  });
  return [...found].sort((a, b) => a[1] - b[1]).map(([item]) => identity(item));
}

/** Marks every part of an identity. */
export function mark(svg: SVGSVGElement, chosen: Identity | null): void {
  svg.querySelectorAll(".chosen").forEach((el) => el.classList.remove("chosen"));
  if (chosen) svg.querySelectorAll(`[data-item="${CSS.escape(`${chosen.kind}:${chosen.name}`)}"]`).forEach((el) => el.classList.add("chosen"));
}
