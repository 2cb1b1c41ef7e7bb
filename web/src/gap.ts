/** Gap of a linkage that does not close: a dashed line between the two places of a joint, with its length. */

import type { Board } from "./board";
import type { Data } from "./data";
import { figures, make, path, set, short, text } from "./svg";

/** ``open``: the joints of the present pose that miss, with both places. */
export interface Gaps { readonly open: { joint: string; p: number[]; q: number[] }[] }

export function gapMarks(b: Board, data: Pick<Data, "units">, kernel: Gaps): () => void {
  const layer = make("g", b.svg, { class: "gaps", "pointer-events": "none" }), { unit, size } = data.units.length;
  let drawn = "";
  return () => {
    const open = kernel.open.map((g) => {
      const [p, q] = [g.p, g.q].map((x) => b.paper.of(...b.paper.project(x)));
      return { p, q, said: `${g.joint} is open by ${figures(Math.hypot(...g.p.map((x, k) => x - g.q[k])) / size, 3)} ${unit}` };
    });
    const now = JSON.stringify(open);
    if (now === drawn) return;
    drawn = now;
    layer.replaceChildren();
    for (const { p, q, said } of open) {
      make("path", layer, { class: "l-gap", d: path([p, q]), style: "fill:none" });
      const [dx, dy] = [q[0] - p[0], q[1] - p[1]], long = Math.hypot(dx, dy) || 1, right = dy < 0 ? -1 : 1;
      const label = text(layer, "gap", said, 3.3, "start");
      set(label, { x: short((p[0] + q[0]) / 2 + (right * 4 * dy) / long + 2), y: short((p[1] + q[1]) / 2 - (right * 4 * dx) / long + 1) });
    }
  };
}
