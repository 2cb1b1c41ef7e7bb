/** Beside the drawing: curves, the free body and polygons of a chosen link, polar diagrams, numbers. */

import { type Board, board } from "./board";
import { chart, type Cursor, polar, polygon, type View } from "./charts";
import type { Data } from "./data";
import type { Kernel } from "./kernel";
import { answersPanel, equations, type Numbers, panel } from "./panels";
import { html } from "./svg";

/** ``fit``: new scales for the free bodies; ``resize``: the charts to a column width in pixels. */
export interface Results extends View { bodies: Board[]; choose(link: string | undefined): void; fit(): void; resize(pixels: number): void }

/** Pixels per mm of a chart: letters stay readable at any width of the column. */
const PIXELS = 4.6;
const chartWidth = (pixels: number): number => Math.min(Math.max(pixels / PIXELS, 72), 140);

const open = (e: Element): boolean => e.closest("details")?.open ?? true;

export function results(side: Element, data: Data, kernel: Kernel, cursor: Cursor, again: () => void): Results {
  const { charts, bodies, polygons } = data.views, always: ReturnType<typeof chart>[] = [], closable: { box: Element; view: View | Numbers; link?: number }[] = [];
  if (kernel.count > 1) for (const c of charts) always.push(chart(side, data, kernel, c, cursor, 120));
  const body = panel(side, "Free body", true), select = html("select", body, { "aria-label": "link" });
  const boards = bodies.map((b, link) => {
    html("option", select, { value: link }, `${b.title}${b.member && `, ${b.member} member`}`);
    const box = html("div", body, { class: "body" }), drawn = board(box, kernel, b, b.about, 110, 100, data.units, `free body of ${b.title}`);
    closable.push({ box, view: drawn, link }, { box, view: equations(box, data, kernel, b), link });
    return drawn;
  });
  if (polygons.links.length) {
    const box = panel(side, "Force polygon"), chain = panel(side, "Force polygons of the chain");
    polygons.links.forEach((p, link) => {
      const view = polygon(box, data, kernel, `Force polygon of link ${p.title}`, [p]);
      closable.push({ box: view.figure, view, link });
    });
    const order = polygons.chain.map((k) => polygons.links[k]);
    closable.push({ box: chain, view: polygon(chain, data, kernel, `In the order of solution: ${order.map((p) => p.title).join(" → ")}`, order) });
  }
  const polars = kernel.count > 2 ? charts.flatMap((c) => c.curves).filter((c) => c.f) : [];
  if (polars.length) {
    const box = panel(side, "Polar diagrams");
    for (const c of polars) closable.push({ box, view: polar(box, kernel, c, data.units.force) });
  }
  const numbers = panel(side, "Numbers of this position");
  closable.push({ box: numbers, view: answersPanel(numbers, data, kernel) });
  select.addEventListener("change", again);
  function fit(): void {
    for (const b of boards) b.fit();
    const force = Math.max(0, ...boards.map((b) => b.need())); // one scale for all: action and reaction are equally long
    for (const b of boards) b.fit(force || undefined);
  }
  return {
    bodies: boards, fit,
    resize: (pixels) => always.forEach((c) => c.resize(chartWidth(pixels))),
    choose(link) {
      const k = bodies.findIndex((b) => b.link === link);
      if (k >= 0) select.value = String(k);
      again();
    },
    update(cycle) {
      for (const v of always) v.update(cycle);
      for (const { box, view, link } of closable) {
        if (link !== undefined) (box as HTMLElement).hidden = link !== +select.value;
        if ((link === undefined || link === +select.value) && open(box)) view.update(cycle);
      }
    },
  };
}
