/** Beside the drawing: curves, polar diagrams, the free body and polygons of a chosen link, numbers. */

import { type Board, board } from "./board";
import { chart, type Cursor, largestOf, polar, polygon, type View as Drawn } from "./charts";
import type { Data } from "./data";
import type { Kernel } from "./kernel";
import { answersPanel, equations, type Numbers } from "./panels";
import { html } from "./svg";
import type { Tabs } from "./tabs";
import type { View } from "./view";

/** ``fit``: new scales for the free bodies; ``resize``: the charts to a column width in pixels. */
export interface Results extends Drawn { parts(): Generator<void>; bodies: Board[]; choose(link: string | undefined): boolean; fit(): void; resize(pixels: number): void }

/** Pixels per mm of a chart: letters stay readable at any width of the column. */
const PIXELS = 4.6;
const chartWidth = (pixels: number): number => Math.min(Math.max(pixels / PIXELS, 72), 140);

const open = (e: Element): boolean => !e.closest<HTMLElement>("[role=tabpanel]")?.hidden && (e.closest("details")?.open ?? true);

export function results(tabs: Tabs, data: Data, kernel: Kernel, cursor: Cursor, view: View, again: () => void): Results {
  const { charts, bodies, polygons } = data.views, always: ReturnType<typeof chart>[] = [], closable: { box: Element; view: Drawn | Numbers; link?: number }[] = [];
  /** What is drawn of the cycle, and the figures that are in sight. */
  const cyclic: { figure: Element; parts(): Generator<void> }[] = [], seen = new Set<Element>();
  const sight = new IntersectionObserver((all) => all.forEach((e) => (e.isIntersecting ? seen.add(e.target) : seen.delete(e.target))));
  function followed<V extends (typeof cyclic)[number]>(view: V): V {
    cyclic.push(view);
    sight.observe(view.figure);
    return view;
  }
  const curves = kernel.count > 1 ? tabs.add("Curves", "forces and efforts over the cycle") : null;
  for (const c of curves ? charts : []) always.push(followed(chart(curves!, data, kernel, c, cursor, 120)));
  const polars = kernel.count > 2 ? charts.flatMap((c) => c.curves).filter((c) => c.f) : [];
  if (curves && polars.length) {
    html("h2", curves, {}, "Polar diagrams");
    const most = largestOf(kernel, [...polars, ...data.views.mechanism.arrows.filter((a) => a.t === "force")]);
    for (const c of polars) closable.push({ box: curves, view: followed(polar(curves, kernel, c, most, data.units.force)) });
  }
  const body = tabs.add("Forces", "free bodies, their equations, and force polygons"), select = html("select", body, { "aria-label": "link" });
  const boards = bodies.map((b, link) => {
    html("option", select, { value: link }, `${b.title}${b.member && `, ${b.member} member`}`);
    const box = html("div", body, { class: "body" }), drawn = board(box, kernel, b, b.about, 110, 100, data.units, `free body of ${b.title}`, view);
    closable.push({ box, view: drawn, link }, { box, view: equations(box, data, kernel, b), link });
    return drawn;
  });
  if (polygons.links.length) {
    polygons.links.forEach((p, link) => {
      const view = polygon(body, data, kernel, `Force polygon of link ${p.title}`, [p]);
      closable.push({ box: view.figure, view, link });
    });
    const order = polygons.chain.map((k) => polygons.links[k]);
    closable.push({ box: body, view: polygon(body, data, kernel, `In the order of solution: ${order.map((p) => p.title).join(" → ")}`, order) });
  }
  const numbers = tabs.add("Numbers", "the numbers of this position");
  closable.push({ box: numbers, view: answersPanel(numbers, data, kernel) });
  const named = (): void => void (view.body = bodies[+select.value]?.link ?? "");
  const choose = (link: string | undefined): boolean => {
    const k = bodies.findIndex((b) => b.link === link);
    if (k >= 0) select.value = String(k);
    named();
    return k >= 0;
  };
  select.addEventListener("change", () => (named(), again()));
  choose(view.body);
  function fit(): void {
    for (const b of boards) b.fit();
    const force = Math.max(0, ...boards.map((b) => b.need())); // one scale for all: action and reaction are equally long
    for (const b of boards) b.fit(force || undefined);
  }
  return {
    bodies: boards, fit, choose,
    *parts() {
      for (const view of cyclic) if (seen.has(view.figure)) yield* view.parts();
    },
    resize: (pixels) => always.forEach((c) => c.resize(chartWidth(pixels))),
    update(cycle) {
      for (const v of always) if (open(curves!)) v.update(cycle);
      for (const { box, view, link } of closable) {
        if (link !== undefined) (box as HTMLElement).hidden = link !== +select.value;
        if ((link === undefined || link === +select.value) && open(box)) view.update(cycle);
      }
    },
  };
}
