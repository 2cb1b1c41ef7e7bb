/** Paths of points of links that the reader has chosen: coupler curves. */

import type { Board } from "./board";
import { curve } from "./items";
import type { Kernel } from "./kernel";
import type { Material } from "./material";
import { make, set, short } from "./svg";
import type { View } from "./view";

export function tracers(b: Board, material: Material, kernel: Kernel, view: View): (all: boolean) => void {
  const layer = make("g", null, { class: "tracers" });
  b.svg.querySelector("g")!.before(layer);
  const drawn: { line: SVGPathElement; dot: SVGCircleElement }[] = [];
  return (all) => {
    const known = view.tracers.filter((p) => material.links.includes(p.link));
    while (drawn.length > known.length) for (const el of Object.values(drawn.pop()!)) el.remove();
    known.forEach((p, k) => {
      const link = material.links.indexOf(p.link), fresh = !drawn[k];
      drawn[k] ??= { line: make("path", layer, { class: "l-trace", style: "fill:none" }), dot: make("circle", layer, { class: "l-trace tracer", r: 1.1, "data-item": `tracer:${k}` }) };
      if (all || fresh) drawn[k].line.setAttribute("d", curve(kernel, (n) => material.on(b.paper, link, p.u, n), true));
      const [x, y] = b.paper.of(...b.paper.project(material.place(link, p.u)));
      set(drawn[k].dot, { cx: short(x), cy: short(y) });
    });
  };
}
