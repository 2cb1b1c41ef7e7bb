/** Paths of points of links that the reader has chosen: coupler curves. */

import type { Board } from "./board";
import { curve } from "./items";
import type { Kernel } from "./kernel";
import type { Material } from "./material";
import { attr, make, set, short } from "./svg";
import type { View } from "./view";

export function tracers(b: Board, material: Material, kernel: Kernel, view: View): { update(all: boolean): void; parts(): Generator<void> } {
  const layer = make("g", null, { class: "tracers" });
  b.svg.querySelector("g")!.before(layer);
  const drawn: { line: SVGPathElement; dot: SVGCircleElement }[] = [];
  const known = (): View["tracers"] => view.tracers.filter((p) => material.links.includes(p.link));
  const path = (p: View["tracers"][number]): string => curve(kernel, (n) => material.on(b.paper, material.links.indexOf(p.link), p.u, n), true);
  function* parts(): Generator<void> {
    for (const [k, p] of known().entries()) {
      if (drawn[k]) attr(drawn[k].line, "d", path(p));
      yield;
    }
  }
  function update(all: boolean): void {
    const some = known();
    while (drawn.length > some.length) for (const el of Object.values(drawn.pop()!)) el.remove();
    some.forEach((p, k) => {
      const link = material.links.indexOf(p.link), fresh = !drawn[k];
      drawn[k] ??= { line: make("path", layer, { class: "l-trace", style: "fill:none" }), dot: make("circle", layer, { class: "l-trace tracer", r: 1.1, "data-item": `tracer:${k}` }) };
      if (all || fresh) attr(drawn[k].line, "d", path(p));
      const [x, y] = b.paper.of(...b.paper.project(material.place(link, p.u)));
      set(drawn[k].dot, { cx: short(x), cy: short(y) });
    });
  }
  return { update, parts };
}
